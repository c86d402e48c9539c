#!/usr/bin/env python3
"""scripts/export writes what readers of nuScenes, TruckScenes, KITTI and View-of-Delft take: tests/chain/exports.py BIN_DIR [TEST...]

The readers here are our own, after what those of the sets assert, compute and filter. PCL reads the radar files as well,
where Debian's pcl-tools is installed.
"""
import contextlib
import csv
import filecmp
import glob
import gzip
import json
import math
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from scripts import ENVIRONMENT, ROOT, SCRIPTS, in_a_fork, members, shell  # noqa: E402
import glint  # noqa: E402
from glint.exports import arrays, processes, whole  # noqa: E402
from devkits import FIELDS, Tables, in_box, read_pcd, read_truckscenes  # noqa: E402
import signals  # noqa: E402
from sentences import prove  # noqa: E402

os.environ.update(ENVIRONMENT)
FORMATS = "nuscenes", "truckscenes", "kitti", "vod"
ALL = *FORMATS, "openpcdet"  # which leaves out scans without a box
QUALITY = {"snr_db": 20, "rcs_dbsm": 5.5, "range_sd_m": 0.1, "range_rate_sd_mps": 0.05, "azimuth_sd_rad": 0.01, "existence": 0.995,
           "range_rate_interval_mps": 97.3, "ambiguity_number": 0, "range_rate_over_ground_mps": 2.0} | {
               f"{axis}_{origin}_m": place for origin, places in {
                   "sensor": (10, 0), "centre": (12.25, 0), "rear_axle": (13.5, 0), "world": (12.25, 0)}.items() for axis, place in zip("xy", places)}


def export(folder, *words, status=0, **more):
    done = subprocess.run([os.path.join(SCRIPTS, "export"), *words], cwd=folder, env=ENVIRONMENT | more, capture_output=True, text=True, check=False)
    assert done.returncode == status, (words, done.returncode, done.stderr)
    assert "Traceback" not in done.stderr, done.stderr
    return done.stderr


def near(found, expected, within=1e-5):
    assert len(found) == len(expected) and all(abs(a - b) <= within for a, b in zip(found, expected)), (found, expected)


def save(folder, name, frames):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.writelines(json.dumps(frame) + "\n" for frame in frames)
    return name


def part(**members):
    return {"object": "other", "reflector": "rear", "path": "direct", "range_m": 10, "azimuth_rad": 0, "range_rate_mps": 0, "ercs": 1,
            "time_s": 0, "weight": 1} | members


def target(sensor="front", range_m=10, azimuth_rad=0, rate=-3, parts=None, **quality):
    return {"sensor": sensor, "range_m": range_m, "azimuth_rad": azimuth_rad, "range_rate_mps": rate, "amplitude_db": 10,
            "cell_range_m": range_m, "cell_azimuth_rad": azimuth_rad, "cell_range_rate_mps": rate, "cell_amplitude": 3, "cell_sum": 3, "effects": [],
            "contributors": parts or [part()], "quality": QUALITY | quality}


def body(name, x=0, y=0, yaw=0, vx=0, vy=0, kind="car", turn=0, size=(4.5, 1.8, 1.5)):
    return {"id": name, "class": kind, "x_m": x, "y_m": y, "yaw_rad": yaw, "vx_mps": vx, "vy_mps": vy, "yaw_rate_radps": turn,
            "length_m": size[0], "width_m": size[1], "height_m": size[2], "travelled_m": 0}


def frame_of(objects, targets, number=0, sensors=None, **members):
    """A frame by hand, whose radar looks ahead from the middle of the bumper, 0.4 m over the road."""
    sensors = sensors or [{}]
    listed = [{"name": "front", "mount_x_m": 2.25, "mount_y_m": 0, "mount_z_m": 0.4, "mount_yaw_rad": 0, "field_of_view_rad": math.pi / 2,
               "range_max_m": 100, "cell_range_m": 1, "cell_range_rate_mps": 1, "resolution_range_m": 1, "resolution_range_rate_mps": 1,
               "carrier_hz": 77e9, "measured": True} | one for one in sensors]
    return {"version": 1, "scene": "by-hand", "frame": number, "time_s": 0.1 * number, "interval_s": 0.1, "seed": "1", "ego": "ego",
            "objects": objects, "sensors": {"suite": "mine", "digest": "0123456789abcdef", "list": listed}, "targets": targets} | members


# --- readers --------------------------------------------------------------------------------------


def numbers(text):
    return [float(word) for word in text.split()]


def read_kitti(root, name, form="kitti"):
    """Points, labels by their cells, and the boxes in the sensor's axes: x, y, z of the middle, length, width, height, heading, as
    readers of KITTI compute them from the lines of the calibration."""
    beside = root if form == "kitti" else os.path.join(root, "..", "lidar")
    with open(f"{root}/training/velodyne/{name}.bin", "rb") as file:
        points = list(struct.iter_unpack("<7f", file.read()))
    with open(f"{root}/training/calib/{name}.txt", encoding="utf-8") as file:
        lines = [numbers(line.partition(":")[2]) for line in file]
    p2, rectified, (a, b, c, x, d, e, f, y, g, h, i, z) = lines[2], lines[4], lines[5]
    assert len(p2) == 12 and rectified == [1, 0, 0, 0, 1, 0, 0, 0, 1]
    labels, boxes = [], []
    with open(f"{beside}/training/label_2/{name}.txt", encoding="utf-8") as file:
        for line in file:
            cells = line.split()
            assert len(cells) == (15 if form == "kitti" else 16)
            labels.append([cells[0], *map(float, cells[1:])])
            height, width, length, px, py, pz, turn = labels[-1][8:15]
            px, py, pz = px - x, py - y, pz - z  # the inverse of a rotation is its transpose
            boxes.append((a * px + d * py + g * pz, b * px + e * py + h * pz, c * px + f * py + i * pz + height / 2, length, width, height,
                          -(math.pi / 2 + turn)))
    return points, labels, boxes, p2


def read_pose(root, name):
    """The camera in the world, as View-of-Delft's reader takes it."""
    with open(f"{root}/training/pose/{name}.json", encoding="utf-8") as file:
        lines = [json.loads(line) for line in file]
    assert lines[0]["odomToCamera"] == lines[1]["mapToCamera"] == lines[2]["UTMToCamera"]
    values = lines[0]["odomToCamera"]
    return [values[i:i + 4] for i in range(0, 16, 4)]


# --- numbers worked out by hand -------------------------------------------------------------------


def by_hand(folder, frames, form):
    """The exported folder of frames by hand."""
    out = f"{form}-{time.monotonic_ns()}"
    export(folder, form, "--out", out, save(folder, "hand.jsonl", frames))
    return os.path.join(folder, out)


def an_approaching_car(folder, mirror=1):
    """A car 20 m ahead and 5 m to the left comes at 10 m/s; the ego drives at 20. Its detection is at 15 m ahead and, mirrored
    or not, 5 m to the side: r^2 = 250, and the rate is -30 x 15/r = -28.46; over ground it is -9.487. Along the line of sight
    vx = -30 x 15 x 15/250 = -27, vy = -9, compensated -9 and -3."""
    r, angle = math.sqrt(250), mirror * math.atan2(5, 15)
    objects = [body("ego", vx=20), body("other", x=19.5, y=mirror * 5, yaw=math.pi, vx=-10)]
    targets = [target(range_m=r, azimuth_rad=angle, rate=-450 / r, range_rate_over_ground_mps=-150 / r)]
    frames = [frame_of(objects, targets)]
    for form in ("nuscenes", "truckscenes"):
        tables = Tables(by_hand(folder, frames, form), form)
        point, = tables.points(tables.rows["sample_data"][0])
        if form == "nuscenes":
            # Deviations along and across are 0.1 and 0.158 m, 0.05 and 0.285 m/s. In x: 0.107 m (code 13), 0.102 m/s (12);
            # in y: 0.153 m (14), 0.270 m/s (16).
            near(point, (15, mirror * 5, 0, 2, 0, 5.5, -27, mirror * -9, -9, mirror * -3, 1, 3, 13, 14, 0, 1, 12, 16))
        else:
            near(point, (15, mirror * 5, 0, -27, mirror * -9, 0, 5.5))
        box, = tables.rows["sample_annotation"]
        near(box["translation"], (19.5, mirror * 5, 0.75))
        near(box["size"], (1.8, 4.5, 1.5))
        near(box["rotation"], (0, 0, 0, 1))
        assert box["category_name"] == "vehicle.car" and tables.of("attribute", box["attribute_tokens"][0])["name"] == "vehicle.moving"
        # The rear axle is 1.25 m behind the middle, and the radar 3.5 m ahead of it.
        near(tables.rows["calibrated_sensor"][0]["translation"], (3.5, 0, 0.4))
        near(tables.rows["ego_pose"][0]["translation"], (-1.25, 0, 0))
        near(tables.to_world(tables.rows["sample_data"][0], point), (17.25, mirror * 5, 0.4))
    for form, root, within in (("kitti", "front", 1e-6), ("vod", "front/radar", 1.1e-5)):  # its boxes are turned by 1e-5 and more
        place, name = os.path.join(by_hand(folder, frames, form), root), "000000" if form == "kitti" else "00000"
        points, labels, boxes, p2 = read_kitti(place, name, form)
        near(points[0], (15, mirror * 5, 0, 5.5, -28.460499, -9.486833, 0))
        # In the camera's axes the box is 5 m to the right of the mirrored, its bottom 0.4 m down, 17.25 m ahead; it faces us: ry = pi/2.
        near(labels[0][8:15], (1.5, 1.8, 4.5, mirror * -5, 0.4, 17.25, math.pi / 2), within)
        near(boxes[0][:6], (17.25, mirror * 5, 0.35, 4.5, 1.8, 1.5))
        near([math.cos(boxes[0][6]), math.sin(boxes[0][6])], (-1, 0), within)
        near([labels[0][3]], [math.pi / 2 - math.atan2(mirror * -5, 17.25)], within)
        # A camera of 90 degrees has 968 pixels for a slope of 1: the nearest corners are 15 m ahead, 4.1 and 5.9 m to the side.
        near([p2[0], p2[2], p2[6]], (968, 968, 608))
        left, right = 968 - 968 * 5.9 / 15, 968 - 968 * 4.1 / 19.5
        near(labels[0][4:8], (left, 608 - 968 * 1.1 / 15, right, 608 + 968 * 0.4 / 15) if mirror == 1 else
             (1936 - right, 608 - 968 * 1.1 / 15, 1936 - left, 608 + 968 * 0.4 / 15), 1e-4)
        assert labels[0][0] == "Car" and labels[0][1:3] == [0, 3]
        near(sum(read_pose(place, name), []), (0, 0, 1, 2.25, -1, 0, 0, 0, 0, -1, 0, 0.4, 0, 0, 0, 1))


def an_elevation_is_a_height(folder):
    """A point 12 m ahead, 5 to the left and 0.6 up, whose azimuth is that of a cone, comes by 12, 5 and 0.6 m/s. It is 1 m over
    the road, in the box of a car of 1.5 m; twice as far up it is above it."""
    objects = [body("ego"), body("other", x=14.25, y=5)]
    for up, count in (0.6, 1), (1.2, 0):
        r = math.sqrt(169 + up * up)
        high = target(range_m=r, azimuth_rad=math.asin(5 / r), rate=-r) | {"elevation_rad": math.asin(up / r)}
        frames = [frame_of(objects, [high])]
        for form, velocity in ("nuscenes", 6), ("truckscenes", 3):
            tables = Tables(by_hand(folder, frames, form), form)
            point, = tables.points(tables.rows["sample_data"][0])
            near(point[:3], (12, 5, up))
            near(point[velocity:velocity + 2], (-12, -5))
            assert tables.rows["sample_annotation"][0]["num_radar_pts"] == count
        near([point[5]], [-up])  # of TruckScenes
        for form, root in (("kitti", "front"), ("vod", "front/radar")):
            points = read_kitti(os.path.join(by_hand(folder, frames, form), root), "000000" if form == "kitti" else "00000", form)[0]
            near(points[0][:3], (12, 5, up))


def a_mirrored_scene_mirrors(folder):
    an_approaching_car(folder, mirror=-1)


def a_turning_ego(folder):
    """The ego faces north at (100, 50), drives at 10 m/s and turns left at 0.5 rad/s. Its radar sits 2.25 m ahead and 1 m to the
    left, and looks to the left: it moves at 9.5 m/s to the north and 1.125 to the west. It sees a post 8 m to the west at the
    rate -1.125, which stands, and a cyclist beside it who rides south at 4 m/s across the line of sight."""
    sensor = {"name": "side", "mount_y_m": 1, "mount_yaw_rad": math.pi / 2, "field_of_view_rad": 1.0}
    objects = [body("ego", 100, 50, math.pi / 2, vy=10, turn=0.5), body("post", 90.95, 52.25, kind="post", size=(0.1, 0.1, 1.0)),
               body("rider", 90, 53, -math.pi / 2, vy=-4, kind="bicycle", size=(1.8, 0.6, 1.7))]
    targets = [target("side", 8, 0, -1.125, [part(object="post")], range_rate_over_ground_mps=0),
               target("side", 9, math.atan2(-0.75, 9), -1.1, [part(object="rider")], range_rate_over_ground_mps=0.3)]
    frames = [frame_of(objects, targets, sensors=[sensor], origin_x_m=1000, origin_y_m=-500)]
    tables = Tables(by_hand(folder, frames, "nuscenes"), "nuscenes")
    data = tables.rows["sample_data"][0]
    post, rider = tables.points(data)
    near(post[:10], (8, 0, 0, 1, 0, 5.5, -1.125, 0, 0, 0))
    assert rider[3] == 1 and rider[4] == 1, "a rate over ground below 0.5 m/s stands"
    near(tables.to_world(data, post), (1091, -447.75, 0.4))
    near(tables.rows["ego_pose"][0]["translation"], (1100, -451.25, 0))
    near(tables.rows["ego_pose"][0]["rotation"], (math.sqrt(0.5), 0, 0, math.sqrt(0.5)))
    rows = {row["category_name"]: row for row in tables.rows["sample_annotation"]}
    near(rows["static.manmade"]["translation"], (1090.95, -447.75, 0.5))
    assert rows["static.manmade"]["num_radar_pts"] == 1 and rows["static.manmade"]["attribute_tokens"] == []
    near(rows["vehicle.bicycle"]["rotation"], (math.sqrt(0.5), 0, 0, -math.sqrt(0.5)))
    points, labels, boxes, _ = read_kitti(os.path.join(by_hand(folder, frames, "kitti"), "side"), "000000")
    near(points[0], (8, 0, 0, 5.5, -1.125, 0, 0))
    # West is ahead of the radar, south to its left: the cyclist is 9 m ahead, 0.75 m to the right, and faces left.
    near([*labels[1][8:14], abs(labels[1][14])], (1.7, 0.6, 1.8, 0.75, 0.4, 9, math.pi))
    near(boxes[1][:6], (9, -0.75, 0.45, 1.8, 0.6, 1.7))
    near([math.sin(boxes[1][6])], [1])
    assert [one[0] for one in labels] == ["Misc", "Cyclist"]


def codes_are_those_of_the_ars408(folder):
    """Deviations in m beside their codes, false alarms in per cent beside theirs, folded rates, and what moves how."""
    table = {0.004: 0, 0.0055: 1, 0.007: 2, 0.0095: 3, 0.012: 4, 0.048: 9, 0.05: 10, 0.13: 13, 0.47: 18, 1.0: 21, 2.1: 24, 9.9: 30, 10.5: 31, 80: 31}
    alarms = {1: 1, 0.76: 1, 0.74: 2, 0.4: 3, 0.2: 4, 0.05: 5, 0.005: 6, 0.0005: 7, 0: 7}
    targets = [target(range_sd_m=sd, azimuth_sd_rad=sd / 10, range_rate_sd_mps=sd, rate=0) for sd in table]
    targets += [target(existence=one) for one in alarms]
    targets += [target(ambiguity_number=one) for one in (-1, 0, 2)]
    targets += [target(range_rate_over_ground_mps=one) for one in (-0.6, -0.4, 0.4, 0.6)]
    tables = Tables(by_hand(folder, [frame_of([body("ego"), body("other", x=10)], targets)], "nuscenes"), "nuscenes")
    points = tables.points(tables.rows["sample_data"][0])
    assert [(one[12], one[13], one[16]) for one in points[:len(table)]] == [(code,) * 3 for code in table.values()]
    points = points[len(table):]
    assert [one[15] for one in points[:len(alarms)]] == [*alarms.values()]
    points = points[len(alarms):]
    assert [one[11] for one in points[:3]] == [1, 3, 1] and [one[3] for one in points[3:]] == [2, 1, 1, 0]


# --- lists of the chain ---------------------------------------------------------------------------


LISTS = {  # a list with everything that a label may say
    "ghosts": "glint-traffic walled-road | glint-extract | glint-ideal --sensors lrr77-full --sections quality,visibility",
    "folded": "glint-traffic wet-road --sections quality | glint-extract | glint-ideal --sensors lrr77-full --effects=-interference,-rain,-fog",
    "merged": "glint-traffic two-vehicles | glint-extract | glint-ideal --sensors srr24-pair --sections quality,visibility",
    "clutter": "glint-traffic gravel | glint-extract | glint-ideal --sensors radarscenes77-full --sections quality",
    "moving": "glint-traffic wheels-and-limbs | glint-extract | glint-ideal --sensors radarscenes77-full --sections quality,visibility",
    "alarms": "glint-traffic open-road | glint-extract | glint-ideal --sensors lrr77-full --sections quality"}


def lists_of(folder):
    """The lists, and all of them in one stream, as scenes of one suite each."""
    for name, text in LISTS.items():
        if not os.path.exists(os.path.join(folder, name + ".jsonl")):
            shell(f"{text} | glint-sensor | glint-noise > {name}.jsonl", folder)
    return [name + ".jsonl" for name in LISTS]


def scans(frames):
    """Each scan in the order of the export: frame, sensor, targets."""
    for frame in frames:
        for sensor in frame["sensors"]["list"]:
            if sensor.get("measured", True):
                yield frame, sensor, [one for one in frame["targets"] if one["sensor"] == sensor["name"]]


def read_table(root, name):
    with open(os.path.join(root, f"glint-{name}.csv"), encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def labels_survive(folder):
    """Every contributor of every target, of all lists and in all formats, stands beside its point; of every path, merged or not."""
    paths, merged = set(), 0
    files = lists_of(folder)
    for form in FORMATS:
        for name in files:
            root = os.path.join(folder, f"labels-{form}-{name}")
            export(folder, form, "--out", root, name)
            labels, rows = {}, read_table(root, "scans")
            for row in read_table(root, "labels"):
                labels.setdefault((row["path"], int(row["point"])), []).append(row)
            for row, (frame, sensor, targets) in zip(rows, scans(glint.frames(os.path.join(folder, name))), strict=True):
                assert (row["scene"], int(row["frame"]), row["sensor"], int(row["points"])) == (frame["scene"], frame["frame"], sensor["name"], len(targets))
                path = os.path.join(root, row["path"])
                points = read_pcd(path, False) if form == "nuscenes" else read_truckscenes(path) if form == "truckscenes" else \
                    list(struct.iter_unpack("<7f", open(path, "rb").read()))
                classes = {one["id"]: one["class"] for one in frame["objects"]}
                for i, (point, one) in enumerate(zip(points, targets, strict=True)):
                    x, y = one["range_m"] * math.cos(one["azimuth_rad"]), one["range_m"] * math.sin(one["azimuth_rad"])
                    near(point[:2], (x, y), 1e-4)
                    near([point[{"nuscenes": 5, "truckscenes": 6}.get(form, 3)]], [one["quality"]["rcs_dbsm"]], 1e-4)
                    found = [(it["object"], it["class"], it["reflector"], it["echo"], it["mirror"], it["number"], float(it["weight"]))
                             for it in labels.pop((row["path"], i))]
                    assert found == [(it["object"], classes.get(it["object"], ""), it["reflector"], it["path"], it.get("mirror", ""),
                                      str(it.get("number", "")), it["weight"]) for it in one["contributors"]], found
                    paths.update(it["path"] for it in one["contributors"])
                    merged += len({it["object"] for it in one["contributors"]}) > 1
            assert not labels
            shutil.rmtree(root)
    assert paths == {"direct", "wall_object", "object_wall", "wall_object_wall", "wheel", "limb", "clutter", "false_alarm"}, paths
    assert merged > 100, merged


def the_default_filter_keeps_the_valid_ones(folder):
    """Those whose range rate is not folded; the others are there without the filter."""
    lists_of(folder)
    kept = folded = empty = 0
    for name in ("folded.jsonl", "ghosts.jsonl"):
        root = os.path.join(folder, "filtered-" + name)
        export(folder, "nuscenes", "--out", root, name)
        for row, (_, _, targets) in zip(read_table(root, "scans"), scans(glint.frames(os.path.join(folder, name))), strict=True):
            valid = [i for i, one in enumerate(targets) if one["quality"]["ambiguity_number"] == 0]
            assert [one[4] for one in read_pcd(os.path.join(root, row["path"]))] == valid
            kept, folded, empty = kept + len(valid), folded + len(targets) - len(valid), empty + (not targets)
    assert kept > 500 and folded > 50 and empty > 5, (kept, folded, empty)


def every_token_resolves(folder):
    for form in ("nuscenes", "truckscenes"):
        root = os.path.join(folder, form)
        export(folder, form, "--out", root, *lists_of(folder))
        tables = Tables(root, form)
        tables.resolve()
        assert len(tables.rows["scene"]) == len(LISTS) and len(tables.rows["sample"]) > 300
        with open(os.path.join(tables.version, "splits.json"), encoding="utf-8") as file:
            assert json.load(file) == {"glint_train": [row["name"] for row in tables.rows["scene"]]}
        # Scenes do not overlap in time, as TruckScenes' reader finds poses by it.
        spans = sorted([min(times), max(times)] for times in ([data["timestamp"] for data in tables.rows["sample_data"] if tables.of(
            "sample", data["sample_token"])["scene_token"] == scene["token"]] for scene in tables.rows["scene"]))
        assert all(one[1] < other[0] for one, other in zip(spans, spans[1:]))
        poses = {row["timestamp"]: row for row in tables.rows["ego_pose"]}
        for data in tables.rows["sample_data"]:
            assert poses[data["timestamp"]]["translation"] == tables.of("ego_pose", data["ego_pose_token"])["translation"]


def points_in_boxes_are_counted(folder):
    """num_radar_pts is what a reader counts, over all sensors and without a filter."""
    root = os.path.join(folder, "counted")
    export(folder, "nuscenes", "--out", root, *lists_of(folder))
    tables, whole, seen = Tables(root, "nuscenes"), 0, 0
    for sample in tables.rows["sample"]:
        places = [tables.to_world(data, point) for data in (tables.of("sample_data", one) for name, one in sample["data"].items() if name != tables.lidar)
                  for point in tables.points(data)]
        for row in (tables.of("sample_annotation", one) for one in sample["anns"]):
            sure, possible = (sum(in_box(row, place, margin) for place in places) for margin in (-1e-4, 1e-4))
            assert sure <= row["num_radar_pts"] <= possible
            whole, seen = whole + row["num_radar_pts"], seen + (row["visibility_token"] != "")
    assert whole > 1000 and seen > 1000, (whole, seen)


def boxes_lie_on_their_detections(folder):
    """Lists of exact echoes, of radars with a latency, of a car that turns: each lies in the box of its object."""
    scene = {"origin": "For tests.", "ego": "ego", "rate_hz": 10, "duration_s": 3, "objects": [
        {"id": "ego", "class": "car", "x_m": 0, "y_m": 0, "speed_mps": 12, "segments": [{"duration_s": 3, "yaw_rate_radps": 0.3}]},
        {"id": "near", "class": "car", "x_m": 22, "y_m": 8, "speed_mps": 9, "yaw_rad": 0.4, "segments": [{"duration_s": 3, "yaw_rate_radps": 0.5}]},
        {"id": "far", "class": "truck", "x_m": 40, "y_m": 12, "yaw_rad": 2.0, "speed_mps": 6}]}
    save(folder, "turning.json", [scene])
    with open(ROOT + "/data/sensors/corner77-every-frame.json", encoding="utf-8") as file:
        suite = json.load(file)  # without heights, so that ranges are those in the plane
    for sensor in suite["sensors"]:
        sensor |= {"latency_s": 0.05, "antenna_table": ROOT + "/data/antennas/corner77.csv"}
    save(folder, "late.json", [suite])
    shell("glint-traffic ./turning.json | glint-extract | glint-ideal --sensors ./late.json --sections quality | glint-sensor-perfect"
          " | glint-noise-none > exact.jsonl", folder)
    frames, count = list(glint.frames(os.path.join(folder, "exact.jsonl"))), 0
    assert all(one["age_s"] == 0.05 for frame in frames for one in frame["sensors"]["list"])
    for form in FORMATS:
        root = os.path.join(folder, "exact-" + form)
        export(folder, form, "--out", root, "exact.jsonl")
        names = {row["box"]: row["object"] for row in read_table(root, "boxes")}
        tables = Tables(root, form) if form in FIELDS else None
        data = {row["filename"]: row for row in tables.rows["sample_data"]} if tables else {}
        for row, (_, _, targets) in zip(read_table(root, "scans"), scans(frames), strict=True):
            if tables:
                rows = {names[one["instance_token"]]: one for one in map(tables.by_token["sample_annotation"].get, tables.of(
                    "sample", data[row["path"]]["sample_token"])["anns"])}
                places = [tables.to_world(data[row["path"]], point) for point in tables.points(data[row["path"]])]
            else:
                place, name = row["path"].split("/training/velodyne/")
                points, _, boxes, _ = read_kitti(os.path.join(root, place), name[:-4], form)
                rows = {names[f"{place}/{name[:-4]}:{i + 1}"]: {"translation": box[:3], "size": (box[4], box[3], box[5]), "rotation": (
                    math.cos(box[6] / 2), 0, 0, math.sin(box[6] / 2))} for i, box in enumerate(boxes)}
                places = [point[:3] for point in points]
            for one, place in zip(targets, places, strict=True):
                label = one["contributors"][0]
                if label["path"] == "direct":
                    assert in_box(rows[label["object"]], place, 1e-3 if form == "vod" else 1e-4), (form, row["path"], label)  # turned boxes
                    count += 1
    assert count > 500, count


def lines_tables_and_sets_give_the_same_bytes(folder):
    """So do another run, and one that parses the lines as it finds no glint-tables; only the split of a set has another name."""
    shell("glint-traffic cut-in | glint-extract | glint-ideal --sensors radarscenes77-full --sections quality,visibility | glint-sensor"
          " | glint-noise | head -50 > list.jsonl; gzip -k list.jsonl; glint-tables tables list.jsonl; glint-tables --plain --part 3 plain list.jsonl", folder)
    for form in ALL:
        for i, name in enumerate(("list.jsonl", "list.jsonl", "list.jsonl.gz", "tables", "plain")):
            export(folder, form, "--out", f"{form}-{i}", name)
        export(folder, form, "--out", f"{form}-5", "list.jsonl", BUILD="nowhere")
        for i in range(1, 6):
            same(os.path.join(folder, f"{form}-0"), os.path.join(folder, f"{form}-{i}"))


def same(one, other):
    found = filecmp.dircmp(one, other)
    stack = [found]
    while stack:
        found = stack.pop()
        assert not (found.left_only or found.right_only or found.funny_files), (one, other, found.left_only, found.right_only)
        _, differ, errors = filecmp.cmpfiles(found.left, found.right, found.common_files, shallow=False)
        assert not differ and not errors, (one, other, differ)
        stack += found.subdirs.values()


def a_plan_names_exports(folder):
    """The set is the same without them; its splits are those of the exports, from lines and from tables."""
    plan = {"name": "set", "origin": "For tests.", "sources": [{"random": "medium", "seconds": 1, "scenes": [0, 6], "rate_hz": 10}],
            "chain": "glint-extract | glint-ideal --sensors {suite} --sections quality | glint-sensor | glint-noise", "suites": ["corner77-every-frame"],
            "frames_per_shard": 20, "splits": {"by": "scene", "shares": {"train": 0.5, "validation": 0.25, "test": 0.25}}}
    for name, members in (("lines", {}), ("zstd", {"compression": "zstd"}), ("tables", {"tables": True, "lines": "none"})):
        save(folder, name + ".json", [plan | members | {"exports": ["nuscenes", "vod"]}])
        shell(f"{SCRIPTS}/dataset {name}.json --out {name} && make -s -C {name} -j2 && {SCRIPTS}/check-set {name}", folder)
    same(f"{folder}/lines/exports", f"{folder}/tables/exports")
    same(f"{folder}/lines/exports", f"{folder}/zstd/exports")
    with open(f"{folder}/lines/exports/nuscenes/v1.0-trainval/splits.json", encoding="utf-8") as file:
        assert {split: len(scenes) for split, scenes in json.load(file).items()} == {"glint_train": 3, "glint_val": 1, "glint_test": 2}
    sets = f"{folder}/lines/exports/vod/corner_left/radar/ImageSets"
    assert {name: len(open(os.path.join(sets, name)).read().split()) for name in os.listdir(sets)} == {"train.txt": 30, "val.txt": 10, "test.txt": 20}
    export(folder, "nuscenes", "--out", "again", "lines")
    same(os.path.join(folder, "again"), f"{folder}/lines/exports/nuscenes")
    for damage in ("rm -r lines/exports/vod", "rm -r lines/exports/vod/corner_left", "echo > lines/exports/nuscenes/glint-boxes.csv",
                   "echo > lines/exports/vod/more", "rm lines/exports/vod/corner_left/radar/testing", "rm lines/exports/vod.sha256"):
        said = shell(f"{damage}; {SCRIPTS}/check-set lines && exit 1; test $? = 65", folder)
        assert re.match("exports/(vod|nuscenes): other files than its .sha256 says; make -C lines makes it again\n", said), (damage, said)
        shell(f"make -s -C lines && {SCRIPTS}/check-set lines", folder)
        same(f"{folder}/lines/exports", f"{folder}/tables/exports")
    for wrong, members in (("need the quality", {"chain": plan["chain"].replace(" --sections quality", "")}),
                           ("are made of tables of CSV", {"tables": "parquet", "lines": "none"}), ("'sim'; expected one of", {"exports": ["sim"]})):
        save(folder, "wrong.json", [plan | {"exports": ["kitti"]} | members])
        done = subprocess.run([SCRIPTS + "/dataset", "wrong.json", "--out", "wrong"], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, check=False)
        assert done.returncode == 65 and wrong in done.stderr, done.stderr


def cycles_make_sweeps(folder):
    """Of two radars one measures in every second frame: these are samples, and other scans sweeps of the next sample."""
    sensors = [{"name": "front"}, {"name": "rear", "mount_yaw_rad": math.pi}]
    objects = [body("ego", vx=1), body("other", x=12)]
    frames = [frame_of(objects, [target()], i, [sensors[0], sensors[1] | {"measured": i % 2 == 1}]) for i in range(5)]
    tables = Tables(by_hand(folder, frames, "nuscenes"), "nuscenes")
    tables.resolve()
    front = [row for row in tables.rows["sample_data"] if row["channel"] == "RADAR_FRONT"]
    first, second = (row["token"] for row in tables.rows["sample"])
    assert [(row["is_key_frame"], row["sample_token"]) for row in front] == [(False, first), (True, first), (False, second), (True, second), (False, second)]
    assert all({*row["data"]} == {"RADAR_FRONT", "RADAR_REAR", "LIDAR_TOP"} for row in tables.rows["sample"])
    never = [frame_of(objects, [], i, [sensors[0] | {"measured": i % 2 == 0}, sensors[1] | {"measured": i % 2 == 1}]) for i in range(4)]
    said = export(folder, "nuscenes", "--out", "never", save(folder, "never.jsonl", never), status=65)
    assert "no frame in which all sensors have a scan" in said


def a_sample_is_of_its_newest_scan(folder):
    """Radars of 30, 90 and 60 ms latency and a car at 10 m/s: time and boxes of the sample are those of 30 ms before the frame's time, where
    the car is 0.3 m behind its place at that time."""
    ages = {"a": 0.09, "b": 0.03, "c": 0.06}
    frames = [frame_of([body("ego"), body("other", x=12 + i, vx=10)], [], i + 1, [{"name": name, "age_s": age} for name, age in ages.items()]) for i in range(2)]
    for form in FIELDS:
        tables = Tables(by_hand(folder, frames, form), form)
        tables.resolve()
        for i, sample in enumerate(tables.rows["sample"]):
            times = {name: tables.of("sample_data", sample["data"][f"RADAR_{name.upper()}"])["timestamp"] for name in ages}
            assert sample["timestamp"] == times["b"] == times["a"] + 60_000 == times["c"] + 30_000, (form, sample, times)
            box, = (tables.of("sample_annotation", one) for one in sample["anns"])
            near(box["translation"], (11.7 + i, 0, 0.75))


# --- scenes ---------------------------------------------------------------------------------------


SOURCES = {  # options of the sources that make other scenes, seeds or times; how many scenes
    "two egos": ("glint-traffic highway.csv --ego 2,3 --to-s 0.4", 2), "all egos": ("glint-traffic highway.csv --ego all --to-s 0.2", 14),
    "times": ("glint-traffic highway.csv --ego 2 --from-s 1 --to-s 1.2 --radius-m 0", 1), "a rate": ("glint-traffic highway.csv --ego 2,3 --rate-hz 7 --to-s 0.5", 2),
    "a name and a seed": ("glint-traffic highway.csv --ego 2 --scene mine --seed 9 --to-s 0.3", 1),
    "scenes": ("glint-traffic varied-cut-in --scenes 3:5 --seed 2 | awk 'NR % 20 == 1'", 2),
    "snapshots": ("glint-traffic-random --frames 3 --first 7 --density sparse", 3),
    "moving": ("glint-traffic-random --seconds 0.2 --scenes 2:4 --rate-hz 10 --draw-conditions --roadside", 2)}


def every_option_of_a_source_is_exported(folder):
    """In every layout, from lines and from tables: all scans of all scenes, with their seeds."""
    shutil.copy(ROOT + "/data/trajectories/highway.csv", folder)
    os.chdir(folder)
    for name, (source, scenes) in SOURCES.items():
        shell(f"{source} | glint-extract | glint-ideal --sensors corner77-four --sections quality,visibility | glint-sensor | glint-noise > list.jsonl;"
              " glint-tables --plain tables list.jsonl", folder)
        expected = {}  # by scene and seed, as scenes follow each other in the order in which they begin
        for frame, sensor, targets in scans(glint.frames("list.jsonl")):
            expected.setdefault((frame["scene"], frame["seed"]), []).append((frame["frame"], sensor["name"], len(targets)))
        assert len(expected) == scenes, (name, [*expected])
        for form in FORMATS:
            for what in ("list.jsonl", "tables"):
                status, said = in_a_fork("export", [form, "--out", what + "-out", what])
                assert status == 0, (name, form, what, said)
            same("list.jsonl-out", "tables-out")
            found = {}
            for row in read_table("tables-out", "scans"):
                found.setdefault((row["scene"], row["seed"]), []).append((int(row["frame"]), row["sensor"], int(row["points"])))
            assert [*found.items()] == [*expected.items()], (name, form)
            if form in FIELDS:
                assert [row["name"] for row in Tables("tables-out", form).rows["scene"]] == [scene for scene, _ in expected]
            for what in ("list.jsonl-out", "tables-out"):
                shutil.rmtree(what)
        shutil.rmtree("tables")
    os.chdir(ROOT)


def parts_side_by_side_give_the_bytes_of_one(folder):
    """Whatever the number of jobs: names, times, titles and rows of a part follow those of the inputs before it. So does what stderr
    says. A scan keeps its number where OpenPCDet leaves out others."""
    objects = [body("ego", vx=1), body("other", x=12), body("apart", x=-30, kind="bus")]
    several = [frame_of(objects, [target()] * (number % 3), number, scene=name) for number in range(4) for name in ("a", "b")]
    inputs = {"egos": several, "alone": [frame_of(objects[:1], [target()], i, scene="alone") for i in range(5, 8)], "empty": [
        frame_of(objects, [], i, [{"measured": False}], scene="idle") for i in range(2)], "seed": [frame_of(objects, [target()], i, seed="2", scene="a")
                                                                                        for i in range(2)], "again": [frame_of(objects, [target()], scene="b", seed="3")]}
    for name, frames in inputs.items():
        save(folder, name + ".jsonl", frames)
    shell("glint-tables tables egos.jsonl", folder)
    plan = {"name": "set", "origin": "For tests.", "sources": [{"random": "medium", "seconds": 0.5, "scenes": [0, 6], "rate_hz": 10}], "frames_per_shard": 5,
            "chain": "glint-extract | glint-ideal --sensors {suite} --sections quality | glint-sensor | glint-noise", "suites": ["corner77-four"]}
    save(folder, "plan.json", [plan])
    shell(f"{SCRIPTS}/dataset plan.json --out set && make -s -C set", folder)
    names = "set", *(name + ".jsonl" for name in ("alone", "empty", "seed", "again"))
    for form, first, jobs in zip(ALL, ("egos.jsonl", "tables", "egos.jsonl", "tables", "egos.jsonl"), (2, 3, 20, 2, 3)):
        said = [export(folder, form, "-j", str(count), "--out", f"{form}-{count}", first, *names) for count in (1, jobs)]
        assert said[0] == said[1] and "1 of 12 scenes have no scan and are left out; the first is idle" in said[0], said
        same(f"{folder}/{form}-1", f"{folder}/{form}-{jobs}")
    openpcdet, kitti = ({(row["scene"], row["seed"], row["frame"], row["sensor"]): re.search(r"\d+", row["path"].rpartition("/")[2])[0]
                         for row in read_table(f"{folder}/{form}-1", "scans")} for form in ("openpcdet", "kitti"))
    assert 0 < len(openpcdet) < len(kitti) and openpcdet.items() <= kitti.items(), openpcdet


def a_part_that_fails_ends_all(folder):
    """With the message of the first frame that is wrong, as without parts; a scene that goes on in the next input is no fault."""
    frames = [frame_of([body("ego"), body("other", x=12)], [target()], i) for i in range(4)]
    other = [frame | {"scene": "other"} for frame in frames]
    for name, found in (("first", frames[:2]), ("second", frames[2:]), ("whole", frames), ("other", other), ("wrong", [other[0] | {"ego": "nobody"}]),
                        ("bare", [frames[0] | {"targets": [target() | {"quality": {}}]}]), ("twice", [other[0], other[0]])):
        save(folder, name + ".jsonl", found)
    for form in ALL:
        export(folder, form, "--out", form, "whole.jsonl", "other.jsonl")
        export(folder, form, "-j3", "--out", form + "-parts", "first.jsonl", "second.jsonl", "other.jsonl")
        same(f"{folder}/{form}", f"{folder}/{form}-parts")
        for words, wrong in ((("whole.jsonl", "wrong.jsonl", "other.jsonl", "wrong.jsonl"), "export: wrong.jsonl:1: "),
                             (("bare.jsonl", "twice.jsonl", "other.jsonl"), "export: bare.jsonl:1: targets[0].quality"),
                             (("whole.jsonl", "other.jsonl", "whole.jsonl"), "export: whole.jsonl:1: frame 0 of by-hand at 0 s; expected each scene once")):
            said = {export(folder, form, *jobs, "--out", "none", *words, status=65) for jobs in ((), ("-j2",), ("-j9",))}
            assert len(said) == 1 and said.pop().startswith(wrong), said
        assert "none.jsonl: No such file" in export(folder, form, "-j2", "--out", "none", "whole.jsonl", "none.jsonl", status=66)
        assert not glob.glob(folder + "/none*")
    assert "export: -j 0; expected FORMAT --out DIR" in export(folder, "vod", "-j0", "--out", "none", "whole.jsonl", status=64)


def a_process_that_is_ended_is_a_fault(folder):
    """With its exit status. Answers may be long, need no room in TMPDIR, and come in the order of the items, whatever else ends meanwhile.
    An interrupt ends all processes, and leaves none of their temporary files."""
    def work(size):
        time.sleep(0.2 / (1 + size))
        return "x" * size

    sizes, tempfile.tempdir = [0, 1 << 20, 5, 1 << 18], folder + "/none"
    with subprocess.Popen(["sleep", "0.05"]):
        assert processes.side_by_side(work, sizes, 2) == ["x" * size for size in sizes]
    tempfile.tempdir = None
    try:
        assert not processes.side_by_side(lambda number: number or os.kill(os.getpid(), signal.SIGKILL), (5, 0, 5), 2)
    except processes.Fault as fault:
        assert fault.code == 74 and str(fault) == "one of its processes ended with exit status -9", fault

    def wait(seconds):
        with tempfile.TemporaryDirectory(dir=folder):
            time.sleep(seconds)

    signal.signal(signal.SIGALRM, lambda *_: os.killpg(0, signal.SIGINT))
    signal.setitimer(signal.ITIMER_REAL, 0.5)
    group = os.getpgrp()
    os.setpgid(0, 0)
    try:
        assert not processes.side_by_side(wait, (60, 60, 60), 2)
    except KeyboardInterrupt:
        assert not os.listdir(folder)
    os.setpgid(0, group)


def processes_end_when_their_parent_is_killed(folder):
    """They leave none of their temporary files, and do not work on to the end of their items."""
    told, own_end = os.pipe()

    def work(_):
        with tempfile.TemporaryDirectory(dir=folder):
            os.write(own_end, b"begun ")
            time.sleep(60)
        os.write(own_end, b"at the end ")

    if (parent := os.fork()) == 0:
        processes.side_by_side(work, (0, 0, 0), 2)
        os._exit(0)
    os.close(own_end)
    assert os.read(told, 6) + os.read(told, 6) == b"begun begun "
    os.kill(parent, signal.SIGKILL)
    os.waitpid(parent, 0)
    assert os.read(told, 6) == b"" and not os.listdir(folder), os.listdir(folder)  # nobody holds the other end


def scenes_may_be_played_at_once(folder):
    """Frames of two scenes in turn, as those of two egos, give the bytes of one scene after the other; also without a last frame."""
    objects = [body("ego", vx=1), body("other", x=12)]
    for ends in (True, False):
        one, two = ([frame_of(objects, [target()], i, scene=name) | {"last": ends and i == 3} for i in range(first, 4)] for name, first in (("a", 0), ("b", 1)))
        save(folder, "after.jsonl", one + two)
        save(folder, "at-once.jsonl", sorted(one + two, key=lambda frame: (frame["frame"], frame["scene"])))
        for form in ALL:
            for name in ("after", "at-once"):
                export(folder, form, "--out", f"{form}-{name}-{ends}", name + ".jsonl")
            same(f"{folder}/{form}-after-{ends}", f"{folder}/{form}-at-once-{ends}")


def several_egos_are_exported_as_each_alone(folder):
    """The files of points of a shard in which two egos play at once are those of each ego's own export, in its order; so are boxes in
    the axes of radars."""
    shutil.copy(ROOT + "/data/trajectories/highway.csv", folder)
    chain = "glint-extract | glint-ideal --sensors corner77-four --sections quality,visibility | glint-sensor | glint-noise"
    for name, egos in (("both", "2,3"), ("2", "2"), ("3", "3")):
        shell(f"glint-traffic highway.csv --ego {egos} --to-s 0.4 | {chain} > {name}.jsonl", folder)
    for form in ALL:
        found = {}
        for name in ("both", "2", "3"):
            root = os.path.join(folder, f"{form}-{name}")
            export(folder, form, "--out", root, name + ".jsonl")
            for row in read_table(root, "scans"):
                label = row["path"] if form in FIELDS else re.sub(r"\.\w+$", ".txt", row["path"].replace("velodyne", "label_2").replace("points", "labels"))
                files = [pathlib.Path(root, path).read_bytes() for path in (row["path"], label)]
                found.setdefault((name == "both", row["scene"], row["sensor"]), []).append(files)
        together = {key[1:]: files for key, files in found.items() if key[0]}
        assert together == {key[1:]: files for key, files in found.items() if not key[0]} and len(together) == 8, form


def a_seed_makes_another_scene(folder):
    """Frames of seed 1 that go on with seed 2 are two scenes, in all tables, and readers tell them apart by name."""
    objects = [body("ego", vx=1), body("other", x=12)]
    frames = [frame_of(objects, [target()], i, seed=seed) for i, seed in enumerate("1122")]
    tables = Tables(by_hand(folder, frames, "nuscenes"), "nuscenes")
    tables.resolve()
    assert [(row["name"], row["nbr_samples"]) for row in tables.rows["scene"]] == [("by-hand", 2), ("by-hand/2", 2)]
    assert len(tables.rows["instance"]) == 2
    with open(os.path.join(tables.version, "splits.json"), encoding="utf-8") as file:
        assert json.load(file) == {"glint_train": ["by-hand", "by-hand/2"]}
    for form in FORMATS:
        root = by_hand(folder, frames, form)
        assert [(row["scene"], row["seed"]) for row in read_table(root, "scans")] == [("by-hand", seed) for seed in "1122"]
        assert {row["seed"] for row in read_table(root, "boxes")} == {"1", "2"}
    clash = [frames[0], frame_of(objects, [target()], scene="by-hand/2"), frames[2]]
    said = export(folder, "nuscenes", "--out", "clash", save(folder, "clash.jsonl", clash), status=65)
    assert "clash.jsonl:3: by-hand/2 would be the name of two scenes" in said, said


def a_scene_without_a_scan_is_told(folder):
    """It is in no layout, and stderr says so with its name."""
    objects = [body("ego", vx=1), body("other", x=12)]
    frames = [frame_of(objects, [target()]), *(frame_of(objects, [], i, [{"measured": False}], scene="idle") for i in range(2))]
    save(folder, "idle.jsonl", frames)
    for form in ALL:
        said = export(folder, form, "--out", form, "idle.jsonl")
        assert said.startswith("export: 1 of 2 scenes have no scan and are left out; the first is idle with seed 1, at idle.jsonl:2\n"), said


def a_plan_of_several_egos_is_exported(folder):
    """As it is from its lines; all scenes of all egos."""
    plan = {"name": "set", "origin": "For tests.", "suites": ["corner77-every-frame"], "frames_per_shard": 50, "exports": [*FORMATS],
            "chain": "glint-extract | glint-ideal --sensors {suite} --sections quality | glint-sensor | glint-noise",
            "sources": [{"recording": ROOT + "/data/trajectories/highway.csv", "egos": ["2", "3"], "licence": "MIT", "source": "glint", "from_s": 0,
                         "to_s": 1, "block_s": 0.5}]}
    save(folder, "egos.json", [plan])
    shell(f"{SCRIPTS}/dataset egos.json --out egos && make -s -C egos && {SCRIPTS}/check-set egos", folder)
    expected = {(frame["scene"], frame["frame"], sensor["name"]) for path in glob.glob(folder + "/egos/*/*/*.jsonl.gz")
                for frame, sensor, _ in scans(glint.frames(path))}
    assert len({scene for scene, _, _ in expected}) == 4
    for form in FORMATS:
        found = {(row["scene"], int(row["frame"]), row["sensor"]) for row in read_table(f"{folder}/egos/exports/{form}", "scans")}
        assert found == expected, form


def a_plan_that_cannot_be_exported_makes_no_folder(folder):
    """What a layout cannot hold is refused when the plan is tried, before a shard is made."""
    with open(ROOT + "/data/sensors/corner77-every-frame.json", encoding="utf-8") as file:
        suite = json.load(file)
    for sensor, name in zip(suite["sensors"], ("a-b", "a_b")):
        sensor |= {"name": name, "antenna_table": "corner77.csv"}
    shutil.copy(ROOT + "/data/antennas/corner77.csv", folder)
    save(folder, "alike.json", [suite])
    plan = {"name": "set", "origin": "For tests.", "suites": ["corner77-every-frame"], "frames_per_shard": 1000, "exports": ["vod"],
            "chain": "glint-extract | glint-ideal --sensors {suite} --sections quality | glint-sensor | glint-noise"}
    moving = {"random": "sparse", "seconds": 5000, "scenes": [0, 2]}
    for members, wrong in (({"sources": [moving]}, "/exports: vod: 166666 scans of corner_left; expected at most 100000, as names of its files have 5 digits"),
                           ({"sources": [moving | {"seconds": 1}], "suites": ["./alike.json"]}, "/exports: vod: the first frames of /sources/0 with alike: "
                            "export: list.jsonl:1: sensors: two would be A_B")):
        save(folder, "wrong.json", [plan | members])
        done = subprocess.run([SCRIPTS + "/dataset", "wrong.json", "--out", "wrong"], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, check=False)
        assert done.returncode == 65 and wrong in done.stderr and not os.path.exists(folder + "/wrong"), done.stderr


def what_nobody_measured_is_said(folder):
    """Once, on stderr: heights of points and radars, levels of visibility, and what the layout's document calls constant, which the
    page has, too. Where targets have an elevation, radars a height and boxes a visibility, nothing is said of them."""
    lacking = [frame_of([body("ego"), body("other", x=12)], [target(), target()], i) for i in range(2)]
    for frame in lacking:
        del frame["sensors"]["list"][0]["mount_z_m"]
    sightings = {"sensor": "front", "object": "other", "reflectors": 2, "in_range": 1, "in_view": 1, "visibility": "v80-100"}
    known = [frame_of([body("ego"), body("other", x=12)], [target() | {"elevation_rad": 0.01}], i, visibility=[sightings]) for i in range(2)]
    with open(ROOT + "/data/exports/README.md", encoding="utf-8") as file:
        page = " ".join(file.read().split())
    for form in ALL:
        with open(f"{ROOT}/data/exports/{form}.json", encoding="utf-8") as file:
            constants = [f"export: {text}" for text in json.load(file).get("constants", ())]
        said = [export(folder, form, "--out", f"{form}-{name}", save(folder, "hand.jsonl", frames)).splitlines() for name, frames in (
            ("lacking", lacking), ("known", known))]
        measured = ["export: z is 0 in 4 of 4 points: their radars measure no elevation",
                    "export: 0.5 m is taken as the height of radars that have no mount_z_m: front"]
        assert [line for line in said[0] if line in measured] == measured, said
        assert any("in 2 of 2 boxes" in line for line in said[0]) == (form != "openpcdet"), said
        assert [line for line in said[1] if "7 columns" not in line] == constants == [line for line in said[0] if line in constants], said
        assert all(text.replace("export: ", "") in page for text in constants), constants


# --- refusals -------------------------------------------------------------------------------------


def what_formats_cannot_hold_is_refused(folder):
    """With the place, the value and what is expected, and nothing is left behind."""
    good = frame_of([body("ego"), body("other", x=12)], [target()])

    def changed(**members):
        return [good | members]
    layout = json.load(open(ROOT + "/data/exports/kitti.json", encoding="utf-8")) | {"digits": 1}
    save(folder, "short.json", [layout])
    no_quality = [{key: value for key, value in target().items() if key != "quality"}]
    two = frame_of(good["objects"], [], sensors=[{"name": "a-b"}, {"name": "a_b"}])
    cases = [("nuscenes", changed(targets=no_quality), "hand.jsonl:1: targets[0].quality: missing; give glint-ideal --sections quality"),
             ("kitti", changed(objects=[body("ego"), body("other", size=(4, 2, 0))]), "objects[1].height_m: 0; expected a number in [0.001, 1e+06]; glint-extract"),
             ("vod", [{key: value for key, value in good.items() if key != "targets"}], "targets: missing; expected lists"),
             ("vod", [{key: value for key, value in good.items() if key != "objects"}], "objects: missing; leave out --sections -objects"),
             ("nuscenes", changed(targets=[target()] * 32769), "32769 targets of front at 1000000000000000 us; expected at most 32768"),
             ("nuscenes", [good, good | {"frame": 1, "time_s": 9.1e9}], "before 9007199254740992"),
             ("kitti", changed(targets=[target(rcs_dbsm=2e9)]), "expected an object of numbers"),
             ("nuscenes", [good, good | {"frame": 1, "time_s": 1e-9}], "hand.jsonl:2: 1e-09 s: 1 targets of front at 1000000000000000 us; expected at most 32768, 1 us"),
             ("kitti", changed(targets=[], sensors=frame_of([], [], sensors=[{"measured": False}])["sensors"]), "no frame in which a sensor has measured"),
             ("nuscenes", [good, good], "frame 0 of by-hand at 0 s; expected each scene once, with all of its frames in their order"),
             ("nuscenes", [good | {"last": True}, good | {"scene": "b"}, good | {"frame": 1, "time_s": 1}], "frame 1 of by-hand at 1 s; expected each scene once"),
             ("kitti", [good, good | {"seed": "2"}, good | {"frame": 1, "time_s": 1, "seed": "2"}, good | {"seed": "2"}], "hand.jsonl:4: frame 0 of by-hand at 0 s; expected each scene once"),
             ("nuscenes", [two], "two would be A_B"),
             ("./short.json", [good | {"frame": i, "time_s": i} for i in range(11)], "hand.jsonl:11: scan 10 of front; expected numbers of 1 digits")]
    for form, frames, wrong in cases:
        said = export(folder, form, "--out", "out", save(folder, "hand.jsonl", frames), status=65)
        assert wrong in said and said.startswith("export: ") and said.count("\n") == 1, (wrong, said)
        assert not [name for name in os.listdir(folder) if name.startswith("out")], os.listdir(folder)
    save(folder, "hand.jsonl", [good])
    for words, status, wrong in ((["nuscenes", "--out", "out", "--suite", "mine.json", "hand.jsonl"], 64, "unrecognized arguments: --suite"),
                                 (["vod", "--columns", "4", "--out", "out", "hand.jsonl"], 64, "--columns 4: vod has no such choice"),
                                 (["nuscenes", "--out", ".", "hand.jsonl"], 73, "is there already"),
                                 (["nuscenes", "--out", "no/out", "hand.jsonl"], 73, "--out 'no/out': is there already, or cannot be made"),
                                 (["nuscenes", "--out", "", "hand.jsonl"], 73, "--out ''"),
                                 (["nuscenes", "--out", "n" * 256, "hand.jsonl"], 73, "nnn"),
                                 (["kitti", "--out", "out", "--split", "../../../../out", "hand.jsonl"], 64, "--split: '../../../../out'; expected"),
                                 (["kitti", "--out", "out", "--split", "", "hand.jsonl"], 64, "--split: ''; expected"),
                                 (["nuscenes", "--out", "out", "nowhere.jsonl"], 66, "nowhere.jsonl"), (["mine", "--out", "out", "hand.jsonl"], 66, "mine.json"),
                                 (["kitti", "hand.jsonl"], 64, "--out"), (["kitti", "--out", "out"], 64, "inputs"), (["--sim"], 64, "expected FORMAT")):
        assert wrong in export(folder, *words, status=status), (words, wrong)
    export(folder, "kitti", "--out", "n" * 255, "hand.jsonl")
    save(folder, "nothing.jsonl", [])
    assert "the inputs have no frame" in export(folder, "vod", "--out", "out", "nothing.jsonl", status=65)
    with open(os.path.join(folder, "cut.jsonl.gz"), "wb") as file:
        file.write(gzip.compress(json.dumps(good).encode() + b"\n")[:-20])
    export(folder, "kitti", "--out", "out", "cut.jsonl.gz", status=65)
    assert not [name for name in os.listdir(folder) if name.startswith("out")], os.listdir(folder)


def spoil(record, path, value):
    """Gives the member at the path this value, or takes it away."""
    for key in path[:-1]:
        record = record[key]
    if value == "left out":
        del record[path[-1]]
    else:
        record[path[-1]] = value


def any_member_may_be_wrong(folder):
    """Each member of the second frame is left out or replaced: what is not written is refused in one line, with 65."""
    good = [frame_of([body("ego", vx=20), body("other", x=12)], [target(), target()], i, visibility=[
        {"sensor": "front", "object": "other", "reflectors": 2, "in_range": 1, "in_view": 1, "visibility": "v0-40"}]) for i in range(2)]
    os.chdir(folder)
    refused = 0
    for path in list(members(good[1])):
        for value in ("left out", None, "x", [1], 1e308):
            frames = json.loads(json.dumps(good))
            spoil(frames[1], path, value)
            save(folder, "wrong.jsonl", frames)
            for form in ("nuscenes", "kitti"):
                status, said = in_a_fork("export", [form, "--out", "out", "wrong.jsonl"])
                assert status == 0 or status == 65 and re.fullmatch(r"export: wrong\.jsonl:[12]: .*\n", said), (path, value, form, status, said)
                assert (status == 0) == os.path.exists("out")
                shutil.rmtree("out", ignore_errors=True)
                refused += status != 0
    os.chdir(ROOT)
    assert refused > 250, refused


def agree(read, line):
    """Whether what arrays give is what the line says, and has its optional members. A height of 0 is none, as in all tables."""
    if isinstance(read, dict):
        told = {name for name in arrays.OPTIONAL & line.keys() if (name, line[name]) != ("mount_z_m", 0)}
        return told <= read.keys() and all(agree(value, line[name]) for name, value in read.items() if name in line)
    return len(read) == len(line) and all(map(agree, read, line)) if isinstance(read, list) else read == line


def what_arrays_give_is_whole(folder):
    """A frame that is taken from arrays passes the look at its line, too, and is the same, whatever is wrong in one of its members."""
    good = frame_of([body("ego", vx=20), body("other", x=12)], [target() | {"elevation_rad": 0.1, "cell_elevation_rad": 0}, target()], origin_x_m=5,
                    origin_y_m=0, visibility=[{"sensor": "front", "object": "other", "reflectors": 2, "in_range": 1, "in_view": 1, "visibility": "v0-40"}])
    place, taken = os.path.join(folder, "one.jsonl"), 0
    for path in [None, *members(good)]:
        for value in ("left out", "", "x", {}, True, -1, 0, 1.5, 1e8) if path else ("as it is",):
            frame = glint.Frame(json.loads(json.dumps(good)))
            if path:
                spoil(frame, path, value)
            save(folder, "one.jsonl", [frame])
            with contextlib.suppress(arrays.NotWhole):
                read, = arrays.frames_of_arrays(place)
                frame.place = read.place
                assert agree(read, whole.checked(frame)), (path, value, read)
                taken += 1
            assert path or taken, "the frame as it is was not taken"
    assert taken > 100, taken


def any_member_of_a_layout_may_be_wrong(folder):
    """Each is left out or replaced: the document is refused, or the export is made."""
    save(folder, "hand.jsonl", [frame_of([body("ego"), body("other", x=12)], [target()])])
    os.chdir(folder)
    for form in ("nuscenes", "kitti", "openpcdet"):
        with open(f"{ROOT}/data/exports/{form}.json", encoding="utf-8") as file:
            good = json.load(file)
        for path in [(), *members(good)]:
            for value in ("left out", 0, "x", {"car": 0}):
                layout = {"": json.loads(json.dumps(good))}
                spoil(layout, ("", *path), value)
                save(folder, "layout.json", [layout.get("", [])])
                status, said = in_a_fork("export", ["./layout.json", "--out", "out", "hand.jsonl"])
                assert status == 0 or status == 65 and said.startswith("export: ./layout.json: /"), (form, path, value, status, said)
                assert status == 65 or path[:1] not in ((), ("layout",), ("point",), ("fields",), ("digits",)), (form, path, value)
                shutil.rmtree("out", ignore_errors=True)
    os.chdir(ROOT)


def each_table(folder):
    """Name, path and text of each table in the folder `good`. Each gets its text back before the next one's turn."""
    shell("glint-traffic two-vehicles | glint-extract | glint-ideal --sensors corner77-four --sections quality,visibility,account | glint-sensor"
          " | glint-noise > list.jsonl; head -3 list.jsonl | glint-tables --plain good", folder)
    os.chdir(folder)
    for name in ("frames", "objects", "scans", "detections", "contributors", "sightings", "lost"):
        path = os.path.join("good", name + ".csv")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        yield name, path, text
        save_text(path, text)
    assert in_a_fork("export", ["kitti", "--out", "out", "good"])[0] == 0
    os.chdir(ROOT)


def save_text(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def tables_that_are_no_tables(folder):
    """Cut, without a column, with words for numbers, or not there."""
    for name, path, text in each_table(folder):
        half = text[:len(text) // 2]
        for wrong in (half.rpartition(",")[0], half.replace("_key", "_kex", 1), text.replace("\n0", "\nzero", 1), "", text.split("\n")[0] + "\n", None):
            os.remove(path)
            if wrong is not None:
                save_text(path, wrong)
            status, said = in_a_fork("export", ["vod", "--out", "out", "good"])
            assert status in (65, 66) and re.fullmatch(r"export: .*good/.*\n", said), (name, wrong and wrong[-90:], status, said)


def tables_that_lost_rows(folder):
    """A row of any table that was lost, doubled or moved is refused with its table, be it the first, the last or another one, and
    so are rows that were cut, and many at once."""
    for name, path, text in each_table(folder):
        heading, *rows = text.splitlines(keepends=True)
        assert len(rows) >= 3, name
        wrong = {"reversed": rows[::-1], "cut": [rows[0].rpartition(",")[0] + "\n", *rows[1:]], "without a key": [rows[0][rows[0].index(","):], *rows[1:]],
                 "without its first half": rows[len(rows) // 2:], "without its last half": rows[:len(rows) // 2]}
        for i in (0, len(rows) // 2, len(rows) - 1):
            wrong[f"without row {i}"] = rows[:i] + rows[i + 1:]
            wrong[f"with row {i} twice"] = rows[:i + 1] + rows[i:]
            wrong[f"with row {i} twice and without the next"] = rows[:i + 1] + rows[i:i + 1] + rows[i + 2:]
        if name in ("sightings", "lost"):  # of a sensor that did not measure, they have no key
            del wrong["without a key"]
        for what, lines in wrong.items():
            if name == "lost" and what.endswith("the next"):  # echoes may be alike
                continue
            save_text(path, "".join([heading, *lines]))
            status, said = in_a_fork("export", ["kitti", "--out", "out", "good"])
            assert status == 65 and re.fullmatch(r"export: good/\w+\.csv(:\d+)?: .*\n", said), (name, what, status, said)


def killed_runs_leave_no_folder_of_the_name(folder):
    """Killed at any time, unless all of it is there; the next run removes what is left of them."""
    shell("glint-traffic cut-in | glint-extract | glint-ideal --sensors radarscenes77-full --sections quality | glint-sensor | glint-noise > list.jsonl", folder)
    begin = time.monotonic()
    export(folder, "nuscenes", "--out", "whole", "list.jsonl")
    took_s = time.monotonic() - begin
    for i in range(8):
        process = subprocess.Popen([SCRIPTS + "/export", "nuscenes", "--out", "killed", "list.jsonl"], cwd=folder, env=ENVIRONMENT)
        time.sleep(took_s * (i + 1) / 10)
        process.send_signal(signal.SIGKILL)
        if process.wait() == 0 or os.path.exists(os.path.join(folder, "killed")):
            same(os.path.join(folder, "whole"), os.path.join(folder, "killed"))
            shutil.rmtree(os.path.join(folder, "killed"))
    export(folder, "nuscenes", "--out", "killed", "list.jsonl")
    same(os.path.join(folder, "whole"), os.path.join(folder, "killed"))
    assert sorted(os.listdir(folder)) == ["killed", "list.jsonl", "whole"], os.listdir(folder)


def pcl_reads_the_radar_files(folder):
    if not shutil.which("pcl_convert_pcd_ascii_binary"):
        print("skipped  pcl_reads_the_radar_files: pcl-tools is not installed")
        return
    lists_of(folder)
    for form in FIELDS:
        root = os.path.join(folder, "pcl-" + form)
        export(folder, form, "--out", root, "clutter.jsonl")
        row = max(read_table(root, "scans"), key=lambda one: int(one["points"]))
        subprocess.run(["pcl_convert_pcd_ascii_binary", os.path.join(root, row["path"]), "text.pcd", "0"], cwd=folder, check=True, capture_output=True)
        with open(os.path.join(folder, "text.pcd"), encoding="utf-8") as file:
            lines = file.read().split("\n")
        assert lines[2] == "FIELDS " + FIELDS[form]
        points = read_pcd(os.path.join(root, row["path"]), False) if form == "nuscenes" else read_truckscenes(os.path.join(root, row["path"]))
        for line, point in zip(lines[11:], points):
            assert all(math.isclose(a, b, rel_tol=1e-5, abs_tol=1e-5) for a, b in zip(numbers(line), point, strict=True)), (line, point)
        assert len(points) == int(row["points"]) > 1


TESTS = [an_approaching_car, an_elevation_is_a_height, a_mirrored_scene_mirrors, a_turning_ego, codes_are_those_of_the_ars408,
         the_default_filter_keeps_the_valid_ones, every_token_resolves, points_in_boxes_are_counted, a_sample_is_of_its_newest_scan,
         boxes_lie_on_their_detections, labels_survive, cycles_make_sweeps, every_option_of_a_source_is_exported, parts_side_by_side_give_the_bytes_of_one,
         a_part_that_fails_ends_all, a_process_that_is_ended_is_a_fault, processes_end_when_their_parent_is_killed,
         scenes_may_be_played_at_once, several_egos_are_exported_as_each_alone,
         a_seed_makes_another_scene, a_scene_without_a_scan_is_told, a_plan_of_several_egos_is_exported, a_plan_that_cannot_be_exported_makes_no_folder,
         lines_tables_and_sets_give_the_same_bytes, a_plan_names_exports, what_nobody_measured_is_said, what_formats_cannot_hold_is_refused,
         any_member_may_be_wrong, what_arrays_give_is_whole, any_member_of_a_layout_may_be_wrong, tables_that_are_no_tables, tables_that_lost_rows,
         killed_runs_leave_no_folder_of_the_name, pcl_reads_the_radar_files]

signals.as_on_a_terminal()
prove(TESTS, sys.argv[2:])
