"""What layouts share that have a folder for each radar, with its scans by number."""
import math
import struct
from collections import Counter

import glint
from glint.exports.streams import identity, scans_of, word
from glint.sets.plan import BAD_DATA, Fault


class Pose:
    """Where a radar was in the world when it measured: x, y, height and yaw."""

    def __init__(self, frame, sensor):
        carrier = glint.ego(frame, sensor.get("age_s", 0))
        self.x, self.y = glint.to_world(frame, sensor["mount_x_m"], sensor["mount_y_m"], carrier)
        self.z, self.yaw = sensor["mount_z_m"], carrier["yaw_rad"] + sensor["mount_yaw_rad"]
        self.c, self.s = math.cos(self.yaw), math.sin(self.yaw)

    def of(self, box):
        """The middle of a box in the radar's axes, x ahead and y left of it, and the heading there."""
        x, y = box["x_m"] - self.x, box["y_m"] - self.y
        return self.c * x + self.s * y, self.c * y - self.s * x, box["yaw_rad"] - self.yaw


def corners(box, x, y, heading):
    """x and y of the corners of the outline of a box whose middle is at (x, y)."""
    c, s, ahead, left = math.cos(heading), math.sin(heading), box["length_m"] / 2, box["width_m"] / 2
    ax, ay, lx, ly = ahead * c, ahead * s, left * -s, left * c
    return (x + ax + lx, x + ax - lx, x - ax + lx, x - ax - lx), (y + ay + ly, y + ay - ly, y - ay + ly, y - ay - ly)


def packed(targets, columns, *behind):
    """The first columns of points as bytes of single precision: x, y, z in the sensor's axes, RCS, range rate, the same over ground,
    and what stands behind them."""
    values = []
    for one in targets:
        range_m, quality = one["range_m"], one["quality"]
        x, y, z = glint.sight(one)
        values += (range_m * x, range_m * y, range_m * z, quality["rcs_dbsm"], one["range_rate_mps"], quality["range_rate_over_ground_mps"],
                   *behind)[:columns]
    return struct.pack(f"<{len(values)}f", *values)


def text_of(values):
    """Numbers with 6 decimals, never -0."""
    return ("%.6f " * len(values) % values).replace("-0.000000", "0.000000")[:-1]


class Numbered:
    """Numbers the scans of each radar. A layout has `labels`, which returns the boxes of a scan as pairs of a line and an object,
    and `files`, which writes what else a scan has."""
    inside = ""  # a folder in the radar's

    @staticmethod
    def starts(surveys):
        """For each part, how many scans of each radar come before it."""
        numbers = Counter()
        for scenes in surveys:
            yield Counter(numbers)
            numbers.update(scenes.scans)

    def __init__(self, layout, output, start):
        self.layout, self.output, self.numbers, self.sets, self.roots = layout, output, start, {}, {}

    def add(self, split, frame):
        for sensor, targets in scans_of(frame):
            self.scan(split, frame, sensor, targets)

    def scan(self, split, frame, sensor, targets):
        radar, digits, pose = word(sensor["name"]).lower(), self.layout["digits"], Pose(frame, sensor)
        number, root = self.numbers[radar], radar + self.inside
        if number >= 10 ** digits:
            raise Fault(BAD_DATA, f"{frame.place}: scan {number} of {sensor['name']}; expected numbers of {digits} digits")
        self.numbers[radar], self.roots[root] = number + 1, None
        labels = self.labels(frame, sensor, pose)
        if not self.takes(labels):
            return
        name = f"{number:0{digits}}"
        self.sets.setdefault(f"{root}/ImageSets/{split}.txt", []).append(name + "\n")
        self.files(root, name, frame, sensor, targets, pose, "".join(text for text, _ in labels))
        self.output.boxes.writerows((f"{root}/{name}:{i + 1}", *identity(frame), box["id"], box["class"]) for i, (_, box) in enumerate(labels))

    def takes(self, labels):
        """Whether the layout has a place for a scan with these labels."""
        return True

    def close(self):
        """What `finish` needs of this part."""
        return self.sets, self.roots

    @classmethod
    def finish(cls, layout, folder, parts):
        """Writes which numbers are in which split, when all parts are there; the folders of the radars."""
        names, roots = {}, {}
        for sets, of_part in parts:
            roots |= of_part
            for path, numbers in sets.items():
                names.setdefault(path, []).extend(numbers)
        for path, numbers in names.items():
            folder.write(path, "".join(numbers))
        return roots
