"""Writes the layout that OpenPCDet has for data of one's own: for each radar a folder of points and boxes by number."""
import array
import math
import sys

import glint
from glint.exports.numbered import Numbered, corners, seen_from
from glint.exports.streams import boxes, number, word

FIELDS = "x y z rcs v_r v_r_compensated"


def npy(count, values):
    """A file of NumPy: an array of single precision with a row for each point."""
    head = f"{{'descr': '<f4', 'fortran_order': False, 'shape': ({count}, {len(FIELDS.split())}), }}"
    head = f"{head:{-(len(head) + 11) % 64 + len(head)}}\n".encode()
    column = array.array("f", values)
    if sys.byteorder == "big":
        column.byteswap()
    return b"\x93NUMPY\x01\x00" + len(head).to_bytes(2, "little") + head + column.tobytes()


def values_of(frame, targets):
    for one in targets:
        quality = one["quality"]
        yield from glint.place(frame, one, "sensor")
        yield from (glint.height(frame, one, "sensor"), quality["rcs_dbsm"], one["range_rate_mps"], quality["range_rate_over_ground_mps"])


def in_view(sensor, box, x, y, heading):
    """Whether the middle or a corner of a box is in the radar's field of view and range."""
    return any(math.hypot(px, py) <= sensor["range_max_m"] and abs(math.atan2(py, px)) <= sensor["field_of_view_rad"] / 2
               for px, py in ((x, y), *corners(box, x, y, heading)))


class Writer(Numbered):
    def __init__(self, layout, output):
        super().__init__(layout, output)
        self.roots, self.empty = set(), 0

    def takes(self, root, labels):
        """Its loader takes no file of labels that is empty."""
        self.roots.add(root)
        self.empty += not labels
        return labels

    def labels(self, frame, sensor, pose):
        """A line for each box of a named class in view: x, y, z of its middle, length, width, height, heading and class."""
        found = []
        for box in boxes(frame, sensor.get("age_s", 0)):
            name, (x, y, heading) = self.layout["classes"].get(box["class"]), seen_from(pose, box)
            if name and in_view(sensor, box, x, y, heading):
                cells = (x, y, box["height_m"] / 2 - sensor["mount_z_m"], box["length_m"], box["width_m"], box["height_m"], math.remainder(heading, math.tau))
                found.append((" ".join([*(f"{number(one, 6):.6f}" for one in cells), name]) + "\n", box))
        return found

    def files(self, root, name, frame, sensor, targets, pose, labels):
        self.output.scan(f"{root}/points/{name}.npy", npy(len(targets), values_of(frame, targets)), frame, sensor, targets)
        self.output.write(f"{root}/labels/{name}.txt", labels)

    def close(self):
        for root in self.roots:  # readers want both
            for split in ("train", "val"):
                self.sets.setdefault(f"{root}/ImageSets/{split}.txt", [])
        if self.empty:
            self.output.note(f"{self.empty} of {self.empty + sum(self.counts.values())} scans have no box and are left out: OpenPCDet takes no empty "
                             "file of labels")
        super().close()
