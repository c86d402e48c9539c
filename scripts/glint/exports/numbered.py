"""What layouts share that have a folder for each radar, with its scans by number."""
import glint
from glint.exports.streams import identity, scans_of, word
from glint.sets.plan import BAD_DATA, Fault


def pose_of(frame, sensor):
    """Where a radar was in the world when it measured: x, y, height and yaw."""
    carrier = glint.ego(frame, sensor.get("age_s", 0))
    x, y = glint.to_world(frame, sensor["mount_x_m"], sensor["mount_y_m"], carrier)
    return x, y, sensor["mount_z_m"], carrier["yaw_rad"] + sensor["mount_yaw_rad"]


def seen_from(pose, box):
    """The middle of a box in the axes of a radar, x ahead and y left of it, and the heading there."""
    x, y, _, yaw = pose
    return *glint.turned(box["x_m"] - x, box["y_m"] - y, -yaw), box["yaw_rad"] - yaw


def corners(box, x, y, heading):
    """The corners of the outline of a box whose middle is at (x, y)."""
    for ahead, left in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        dx, dy = glint.turned(ahead * box["length_m"] / 2, left * box["width_m"] / 2, heading)
        yield x + dx, y + dy


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
        root, pose = word(sensor["name"]).lower() + self.inside, pose_of(frame, sensor)
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
