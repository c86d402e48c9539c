"""Writes the layout that OpenPCDet has for data of one's own: for each radar a folder of points and boxes by number."""
import functools
import math

from glint.exports.numbered import Numbered, corners, packed, text_of
from glint.exports.streams import boxes

EMPTY = "{} of {} scans have no box and are left out: OpenPCDet takes no empty file of labels"
FIELDS = "x y z rcs v_r v_r_compensated"


def npy(targets):
    """A file of NumPy: an array of single precision with a row for each point."""
    columns = len(FIELDS.split())
    head = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({len(targets)}, {columns}), }}"
    head = f"{head:{-(len(head) + 11) % 64 + len(head)}}\n".encode()
    return b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head + packed(targets, columns)


def sees(sensor, x, y):
    """Whether a place in the radar's axes is in its field of view and range."""
    return math.hypot(x, y) <= sensor["range_max_m"] and abs(math.atan2(y, x)) <= sensor["field_of_view_rad"] / 2


def in_view(sensor, box, x, y, heading):
    """Whether the radar sees the middle or a corner of a box."""
    return sees(sensor, x, y) or any(map(functools.partial(sees, sensor), *corners(box, x, y, heading)))


class Writer(Numbered):
    def takes(self, labels):
        """Its loader takes no file of labels that is empty."""
        self.output.count(EMPTY, not labels, 1)
        return labels

    def labels(self, frame, sensor, pose):
        """A line for each box of a named class in view: x, y, z of its middle, length, width, height, heading and class."""
        found = []
        for box in boxes(frame, sensor.get("age_s", 0)):
            name, (x, y, heading) = self.layout["classes"].get(box["class"]), pose.of(box)
            if name and in_view(sensor, box, x, y, heading):
                cells = x, y, box["height_m"] / 2 - pose.z, box["length_m"], box["width_m"], box["height_m"], math.remainder(heading, math.tau)
                found.append((f"{text_of(cells)} {name}\n", box))
        return found

    def files(self, root, name, frame, sensor, targets, pose, labels):
        self.output.scan(f"{root}/points/{name}.npy", npy(targets), frame, sensor, targets)
        self.output.write(f"{root}/labels/{name}.txt", labels)

    @classmethod
    def finish(cls, layout, folder, parts):
        both = ({f"{root}/ImageSets/{split}.txt": [] for root in roots for split in ("train", "val")} for _, roots in parts)  # readers want both
        super().finish(layout, folder, [(nothing | sets, roots) for nothing, (sets, roots) in zip(both, parts)])
