"""Writes the layouts of KITTI and View-of-Delft: for each sensor a folder of points, boxes, calibrations and poses by number."""
import functools
import math
import os

from glint.exports.numbered import Numbered, corners, packed, text_of
from glint.exports.streams import boxes, number, visibility

WIDTH, HEIGHT = 1936, 1216  # of the camera's picture, as View-of-Delft's
WIDEST_RAD = math.radians(160)  # field of view of the camera, at most
NEAR_M = 0.1  # boxes are cut there before they are projected
GOLDEN = (math.sqrt(5) - 1) / 2  # whose multiples lie far apart in [0, 1)
UNKNOWN = "occluded is 3, unknown, in {} of {} boxes: of objects out of view, and without --sections visibility of all"
OCCLUDED = {None: 3, 0: 2, 1: 1, 2: 1, 3: 0}  # by level of visibility


def picture(box, x, y, z, yaw, focal):
    """Left, top, right and bottom of a box in the picture of a camera in the sensor's place, and the share of it that is beyond
    the borders; None if it is not in the picture."""
    if x + (box["length_m"] + box["width_m"]) / 2 <= NEAR_M:  # wholly behind
        return None
    ahead, lefts = corners(box, x, y, yaw)
    if max(ahead) <= NEAR_M:
        return None
    depths = [one if one > NEAR_M else NEAR_M for one in ahead]
    near, far = min(depths), max(depths)
    across = [WIDTH / 2 - focal * left / depth for left, depth in zip(lefts, depths)]
    down = [HEIGHT / 2 - focal * up / depth for up in (z, z + box["height_m"]) for depth in (near, far)]
    first, last, highest, lowest = min(across), max(across), min(down), max(down)
    left, right = min(max(first, 0), WIDTH), min(max(last, 0), WIDTH)
    top, bottom = min(max(highest, 0), HEIGHT), min(max(lowest, 0), HEIGHT)
    share = (right - left) * (bottom - top) / ((last - first) * (lowest - highest))
    return (left, top, right, bottom, max(1 - share, 0)) if share > 0 else None


def focal_of(sensor):
    """The focal length in pixels of a camera in the radar's place that sees its field of view."""
    return number(WIDTH / 2 / math.tan(min(sensor["field_of_view_rad"], WIDEST_RAD) / 2), 6)


@functools.lru_cache
def calibration(focal):
    camera = f"{focal} 0 {WIDTH / 2} 0 0 {focal} {HEIGHT / 2} 0 0 0 1 0\n"
    return ("".join(f"P{i}: {camera}" for i in range(4)) + "R0_rect: 1 0 0 0 1 0 0 0 1\nTr_velo_to_cam: 0 -1 0 0 0 0 -1 0 1 0 0 0\n"
            "Tr_imu_to_velo: 1 0 0 0 0 1 0 0 0 0 1 0\n")


def world_of(pose):
    """The camera in the world as View-of-Delft's three matrices: its x is right, y down and z ahead."""
    c, s, back, x, y, z = map(number, (pose.c, pose.s, -pose.c, pose.x, pose.y, pose.z))
    matrix = f"[{s},0.0,{c},{x},{back},0.0,{s},{y},0.0,-1.0,0.0,{z},0.0,0.0,0.0,1.0]"
    return f'{{"odomToCamera":{matrix}}}\n{{"mapToCamera":{matrix}}}\n{{"UTMToCamera":{matrix}}}\n'


class Writer(Numbered):
    def __init__(self, layout, output, start):
        super().__init__(layout, output, start)
        self.inside, self.columns = "/radar" * ("beside" in layout), layout.get("columns", 7)
        self.turned_rad, self.digits = layout.get("turned_rad", (0, 0)), 9 if "turned_rad" in layout else 6

    def files(self, root, name, frame, sensor, targets, pose, labels):
        self.output.scan(f"{root}/training/velodyne/{name}.bin", packed(targets, self.columns, 0), frame, sensor, targets)
        self.output.write(f"{root}/training/label_2/{name}.txt", labels)
        self.output.write(f"{root}/training/calib/{name}.txt", calibration(focal_of(sensor)))
        self.output.write(f"{root}/training/pose/{name}.json", world_of(pose))

    def labels(self, frame, sensor, pose):
        """A line for each box in the picture, in the axes of the camera."""
        focal, levels, found = focal_of(sensor), visibility(frame, [sensor["name"]]), []
        for box in boxes(frame, sensor.get("age_s", 0)):
            x, y, heading = pose.of(box)
            if seen := picture(box, x, y, -pose.z, heading, focal):
                *cut, beyond = seen
                turn = math.remainder(-heading - math.pi / 2 + self.turn_rad(len(found)), math.tau)
                alpha = math.remainder(turn - math.atan2(-y, x), math.tau)
                cells = text_of((alpha, *cut, box["height_m"], box["width_m"], box["length_m"], -y, pose.z, x))
                found.append((" ".join((self.layout["classes"].get(box["class"], "Misc"), f"{beyond:.6f} {OCCLUDED[levels.get(box['id'])]}", cells,
                                        f"{number(turn, self.digits):.{self.digits}f}", *self.layout["behind"])) + "\n", box))
        self.output.count(UNKNOWN, sum(box["id"] not in levels for _, box in found), len(found))
        return found

    def turn_rad(self, i):
        """The angle by which box i of a scan is turned, so that no two have parallel sides; all are far apart, however many there are."""
        least, most = self.turned_rad
        return least + (most - least) * (i * GOLDEN % 1)

    def close(self):
        if self.layout.get("columns") == 7:
            self.output.note("points have 7 columns, of which time is 0: stock loaders of KITTI take 4, and get them by --columns 4")
        return super().close()

    @classmethod
    def finish(cls, layout, folder, parts):
        for root in super().finish(layout, folder, parts):
            os.symlink("training", folder.place(f"{root}/testing"))  # where readers look for the split test
            if "beside" in layout:  # boxes, poses and the camera belong to the lidar
                for name in ("ImageSets", "training/label_2", "training/pose", "training/calib"):
                    os.symlink("../" * name.count("/") + "../radar/" + name, folder.place(f"{os.path.dirname(root)}/{layout['beside']}/{name}"))
