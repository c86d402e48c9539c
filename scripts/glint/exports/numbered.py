"""What layouts share that have a folder for each radar, with its scans by number."""
import math
import struct

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

    def __init__(self, layout, output):
        self.layout, self.output, self.sets, self.counts = layout, output, {}, {}

    def add(self, split, frame):
        for sensor, targets in scans_of(frame):
            self.scan(split, frame, sensor, targets)

    def scan(self, split, frame, sensor, targets):
        root, pose = word(sensor["name"]).lower() + self.inside, Pose(frame, sensor)
        labels = self.labels(frame, sensor, pose)
        if not self.takes(root, labels):
            return
        count, digits = self.counts.get(root, 0), self.layout["digits"]
        if count >= 10 ** digits:
            raise Fault(BAD_DATA, f"{frame.place}: scan {count} of {sensor['name']}; expected numbers of {digits} digits")
        self.counts[root], name = count + 1, f"{count:0{digits}}"
        self.sets.setdefault(f"{root}/ImageSets/{split}.txt", []).append(name + "\n")
        self.files(root, name, frame, sensor, targets, pose, "".join(text for text, _ in labels))
        self.output.boxes.writerows((f"{root}/{name}:{i + 1}", *identity(frame), box["id"], box["class"]) for i, (_, box) in enumerate(labels))

    def takes(self, root, labels):
        """Whether the layout has a place for a scan with these labels."""
        return True

    def close(self):
        for path, names in self.sets.items():
            self.output.write(path, "".join(names))
