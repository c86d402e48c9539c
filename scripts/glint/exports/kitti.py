"""Writes the layouts of KITTI and View-of-Delft: for each sensor a folder of points, boxes, calibrations and poses by number."""
import math
import os
import struct

import glint
from glint.exports.streams import boxes, identity, line, number, scans_of, visibility, word
from glint.sets.plan import BAD_DATA, Fault

WIDTH, HEIGHT = 1936, 1216  # of the camera's picture, as View-of-Delft's
WIDEST_RAD = math.radians(160)  # field of view of the camera, at most
NEAR_M = 0.1  # boxes are cut there before they are projected
OCCLUDED = {None: 3, 0: 2, 1: 1, 2: 1, 3: 0}  # by level of visibility


def picture(box, x, y, z, yaw, focal):
    """Left, top, right and bottom of a box in the picture of a camera in the sensor's place, and the share of it that is beyond
    the borders; None if it is not in the picture."""
    seen = []
    for ahead, left in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        dx, dy = glint.turned(ahead * box["length_m"] / 2, left * box["width_m"] / 2, yaw)
        depth = max(x + dx, NEAR_M)
        seen += [(WIDTH / 2 - focal * (y + dy) / depth, HEIGHT / 2 - focal * up / depth, x + dx) for up in (z, z + box["height_m"])]
    whole = [of(one[axis] for one in seen) for of in (min, max) for axis in (0, 1)]
    left, top, right, bottom = cut = [min(max(one, 0), most) for one, most in zip(whole, (WIDTH, HEIGHT) * 2)]
    share = (right - left) * (bottom - top) / ((whole[2] - whole[0]) * (whole[3] - whole[1]))
    return (*cut, 1 - share) if share > 0 and max(one[2] for one in seen) > NEAR_M else None


class Writer:
    def __init__(self, layout, output):
        self.layout, self.output, self.sets, self.counts = layout, output, {}, {}

    def add(self, split, frame):
        for sensor, targets in scans_of(frame):
            root, digits = word(sensor["name"]).lower() + "/radar" * ("beside" in self.layout), self.layout["digits"]
            count = self.counts[root] = self.counts.get(root, -1) + 1
            if count >= 10 ** digits:
                raise Fault(BAD_DATA, f"{frame.place}: scan {count} of {sensor['name']}; expected numbers of {digits} digits")
            self.sets.setdefault(f"{root}/ImageSets/{split}.txt", []).append(f"{count:0{digits}}\n")
            self.scan(root, f"{count:0{digits}}", frame, sensor, targets)

    def scan(self, root, name, frame, sensor, targets):
        carrier, z = glint.ego(frame, sensor.get("age_s", 0)), sensor["mount_z_m"]
        x, y = glint.to_world(frame, sensor["mount_x_m"], sensor["mount_y_m"], carrier)
        yaw = carrier["yaw_rad"] + sensor["mount_yaw_rad"]
        focal = number(WIDTH / 2 / math.tan(min(sensor["field_of_view_rad"], WIDEST_RAD) / 2), 6)
        points = [(*glint.place(frame, one, "sensor"), glint.height(frame, one, "sensor"), one["quality"]["rcs_dbsm"], one["range_rate_mps"],
                   one["quality"]["range_rate_over_ground_mps"], 0) for one in targets]
        camera = f"{focal} 0 {WIDTH / 2} 0 0 {focal} {HEIGHT / 2} 0 0 0 1 0\n"
        c, s = math.cos(yaw), math.sin(yaw)  # the camera's x is right, y down and z ahead
        pose = [number(one) for one in (s, 0, c, x, -c, 0, s, y, 0, -1, 0, z, 0, 0, 0, 1)]
        self.output.scan(f"{root}/training/velodyne/{name}.bin", b"".join(struct.pack("<7f", *point) for point in points), frame, sensor, targets)
        self.output.write(f"{root}/training/label_2/{name}.txt", self.labels(f"{root}/{name}", frame, sensor, (x, y, z, yaw), focal))
        self.output.write(f"{root}/training/calib/{name}.txt", "".join(f"P{i}: {camera}" for i in range(4)) + "R0_rect: 1 0 0 0 1 0 0 0 1\n"
                          "Tr_velo_to_cam: 0 -1 0 0 0 0 -1 0 1 0 0 0\nTr_imu_to_velo: 1 0 0 0 0 1 0 0 0 0 1 0\n")
        self.output.write(f"{root}/training/pose/{name}.json", "".join(line({of: pose}) for of in ("odomToCamera", "mapToCamera", "UTMToCamera")))

    def labels(self, own, frame, sensor, pose, focal):
        """A line for each box in the picture, in the axes of the camera."""
        (x, y, z, yaw), levels, lines = pose, visibility(frame, [sensor["name"]]), []
        for box in boxes(frame, sensor.get("age_s", 0)):
            bx, by = glint.turned(box["x_m"] - x, box["y_m"] - y, -yaw)
            if seen := picture(box, bx, by, -z, box["yaw_rad"] - yaw, focal):
                turn = math.remainder(yaw - box["yaw_rad"] - math.pi / 2, math.tau)
                cells = (math.remainder(turn - math.atan2(-by, bx), math.tau), *seen[:4], box["height_m"], box["width_m"], box["length_m"],
                         -by, z, bx, turn)
                lines.append(" ".join([self.layout["classes"].get(box["class"], "Misc"), f"{seen[4]:.6f}", str(OCCLUDED[levels.get(box["id"])]),
                                       *(f"{number(one, 6):.6f}" for one in cells), *self.layout["behind"]]) + "\n")
                self.output.boxes.writerow((f"{own}:{len(lines)}", *identity(frame), box["id"], box["class"]))
        return "".join(lines)

    def close(self):
        for path, names in self.sets.items():
            self.output.write(path, "".join(names))
        for root in self.counts:
            root = os.path.join(self.output.folder, root)
            os.symlink("training", os.path.join(root, "testing"))  # where readers look for the split test
            if "beside" in self.layout:  # boxes, poses and the camera belong to the lidar
                os.makedirs(os.path.join(root, "..", self.layout["beside"], "training"))
                for name in ("ImageSets", "training/label_2", "training/pose", "training/calib"):
                    os.symlink("../" * name.count("/") + "../radar/" + name, os.path.join(root, "..", self.layout["beside"], name))
