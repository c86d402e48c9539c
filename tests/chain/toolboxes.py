#!/usr/bin/env python3
"""What OpenPCDet and View-of-Delft do with what scripts/export writes: load, filter, evaluate: tests/chain/toolboxes.py BIN_DIR [TEST...]

The clients here are our own, after what those programs assert, index and compute, and each fails where its original is known
to fail.
"""
import glob
import json
import math
import os
import subprocess
import sys

import numpy

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from scripts import ENVIRONMENT, ROOT, SCRIPTS, shell  # noqa: E402
from glint.exports import kitti  # noqa: E402
from rotated_overlap import LEAST_OVERLAP, average_precision, overlaps  # noqa: E402
from sentences import prove  # noqa: E402

OFF_M = 0.008, 0.006  # a centimetre, along no side of a box


def export(folder, *words):
    done = subprocess.run([os.path.join(SCRIPTS, "export"), *words], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stderr


def list_of(folder):
    """Four corner radars at an intersection: more than 41 boxes of each class."""
    if not os.path.exists(os.path.join(folder, "list.jsonl")):
        shell("glint-traffic intersection | glint-extract | glint-ideal --sensors corner77-four --sections quality,visibility | glint-sensor"
              " | glint-noise > list.jsonl", folder)
    return "list.jsonl"


# --- OpenPCDet ------------------------------------------------------------------------------------

FEATURES = ["x", "y", "z", "rcs", "v_r", "v_r_compensated"]
TO_KITTI = {"Vehicle": "Car", "Pedestrian": "Pedestrian", "Cyclist": "Cyclist"}  # of its custom_dataset.yaml
RANGE = 0, -40, -3, 70.4, 40, 1


def infos_of(root, split):
    """As its own data sets are indexed: points with a column for each feature, boxes and names of each scan."""
    with open(f"{root}/ImageSets/{split}.txt", encoding="utf-8") as file:
        names = [line.strip() for line in file]
    infos = []
    for name in names:
        points = numpy.load(f"{root}/points/{name}.npy")
        assert points.dtype == numpy.float32 and points.shape[1:] == (len(FEATURES),), points.shape
        with open(f"{root}/labels/{name}.txt", encoding="utf-8") as file:
            cells = [line.strip().split(" ") for line in file]
        boxes = numpy.array([one[:-1] for one in cells], numpy.float32)
        assert boxes[:, 6].shape == (len(cells),)  # an array without a row has no columns
        infos.append({"name": name, "points": points, "boxes": boxes, "names": numpy.array([one[-1] for one in cells])})
    return infos


def points_in(info):
    """The points in each box, whose z is its middle."""
    found = []
    for x, y, z, length, width, height, heading in info["boxes"]:
        dx, dy, dz = (info["points"][:, :3] - (x, y, z)).T
        c, s = math.cos(heading), math.sin(heading)
        found.append(info["points"][(abs(c * dx + s * dy) < length / 2) & (abs(c * dy - s * dx) < width / 2) & (abs(dz) < height / 2)])
    return found


def filtered(info):
    """What training takes: points and boxes in the range of its configuration."""
    low, high = numpy.array(RANGE[:3]), numpy.array(RANGE[3:])
    points = info["points"][((info["points"][:, :2] >= low[:2]) & (info["points"][:, :2] <= high[:2])).all(1)]
    inside = ((info["boxes"][:, :3] >= low) & (info["boxes"][:, :3] <= high)).all(1)
    return points, info["boxes"][inside], info["names"][inside]


def evaluated(infos, predictions, score=0.9):
    """AP of each class of KITTI that truth has. A prediction is an array of boxes like those of its info, with their names."""
    for info in infos:
        assert [TO_KITTI[name] for name in info["names"]]
    result = {}
    for name in sorted({TO_KITTI[one] for info in infos for one in info["names"]}):
        scans = []
        for info, (boxes, names) in zip(infos, predictions, strict=True):
            truth = as_kitti(info["boxes"][[TO_KITTI[one] == name for one in info["names"]]])
            found = as_kitti(boxes[[TO_KITTI[one] == name for one in names]])
            scans.append((overlaps(found, truth), numpy.full(len(found), score), numpy.ones(len(truth), bool)))
        result[name] = average_precision(scans, LEAST_OVERLAP[name])
    return result


def as_kitti(boxes):
    """In the axes of a camera in the sensor's place: right, ahead, bottom, sizes, and the angle rotation_y."""
    x, y, z, length, width, height, heading = boxes.T.astype(float)
    return numpy.stack([-y, x, z - height / 2, length, width, height, -heading - math.pi / 2], 1)


def moved(infos):
    return [(info["boxes"] + numpy.array([*OFF_M, 0, 0, 0, 0, 0], numpy.float32), info["names"]) for info in infos]


def openpcdet_trains_and_evaluates(folder):
    """Every radar's scans give infos, boxes with points and a data base of boxes that have a point; truth that is a centimetre off
    has the score 100 in each class."""
    export(folder, "openpcdet", "--out", "custom", list_of(folder))
    for root in sorted(glob.glob(f"{folder}/custom/*/")):
        infos = infos_of(root, "train")
        assert not infos_of(root, "val") and len(infos) > 100
        assert sum(len(filtered(info)[1]) for info in infos) > 100
        counts = [len(one) for info in infos for one in points_in(info)]
        assert sum(count >= 1 for count in counts) > 100, counts
        assert evaluated(infos, moved(infos)) == dict.fromkeys(LEAST_OVERLAP, 100), (root, evaluated(infos, moved(infos)))


def openpcdet_fails_where_it_is_known_to(folder):
    """At an empty file of labels, two blanks, a class without a word of KITTI; equal boxes have no overlap, and of 40 boxes the
    score is 97.5 at most."""
    for name in ("ImageSets", "points", "labels"):
        os.mkdir(os.path.join(folder, name))
    save(folder, "ImageSets/train.txt", "000000\n")
    numpy.save(f"{folder}/points/000000.npy", numpy.zeros((0, len(FEATURES)), numpy.float32))
    for text, error in (("", IndexError), ("1 2 0  4 2 1.5 0 Vehicle\n", ValueError), ("1 2 0 4 2 1.5 0 Bus\n", KeyError)):
        save(folder, "labels/000000.txt", text)
        try:
            infos = infos_of(folder, "train")
            evaluated(infos, moved(infos))
        except error:
            continue
        raise AssertionError(text)
    angles = numpy.random.default_rng(1).uniform(-3, 3, 40)
    save(folder, "labels/000000.txt", "".join(f"{10 * i}.1 2.2 0 4 2 1.5 {angle:.6f} Vehicle\n" for i, angle in enumerate(angles)))
    infos = infos_of(folder, "train")
    assert evaluated(infos, moved(infos)) == {"Car": 97.5}
    assert evaluated(infos, [(info["boxes"], info["names"]) for info in infos])["Car"] < 50


def save(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


# --- KITTI ----------------------------------------------------------------------------------------


def stock_loaders_of_kitti_take_four_columns(folder):
    """With --columns 4 they read x, y, z and RCS of every scan. The seven columns of the default raise there, or are read wrong in
    silence where four divide their number; stderr says so."""
    said = [export(folder, "kitti", *words, "--out", f"kitti{i}", list_of(folder)) for i, words in enumerate(((), ("--columns", "4")))]
    assert ["--columns 4" in text for text in said] == [True, False], said
    raised = wrong = 0
    for path in sorted(glob.glob(f"{folder}/kitti0/*/training/velodyne/*.bin")):
        seven, four = (numpy.fromfile(one, numpy.float32) for one in (path, path.replace("kitti0", "kitti1")))
        assert numpy.array_equal(four.reshape(-1, 4), seven.reshape(-1, 7)[:, :4])
        try:
            wrong += len(seven.reshape(-1, 4)) != len(four) / 4
        except ValueError:
            raised += 1
    assert raised > 400 and wrong > 50, (raised, wrong)


# --- View-of-Delft --------------------------------------------------------------------------------

LEAST_OF_DELFT = {"Car": 0.5, "Pedestrian": 0.25, "Cyclist": 0.25}
LEAST_HEIGHT_PX = 40


def results_of(root, folder, scale=1.0):
    """Truth as predictions, in a folder of results; sizes are scaled."""
    os.makedirs(folder)
    for path in glob.glob(f"{root}/lidar/training/label_2/*.txt"):
        with open(path, encoding="utf-8") as file, open(os.path.join(folder, os.path.basename(path)), "w", encoding="utf-8") as out:
            for cells in map(str.split, file):
                sizes = [repr(scale * float(one)) for one in cells[8:11]]
                out.write(" ".join([cells[0], "-1", "-1", *cells[3:8], *sizes, *cells[11:15], "0.9"]) + "\n")
    return folder


def labels_of(path, name):
    """The boxes of a class: heights in the picture, and right, ahead, bottom, sizes, rotation_y."""
    with open(path, encoding="utf-8") as file:
        cells = [[float(one) for one in line.split()[1:]] for line in file if line.startswith(name + " ")]
    found = numpy.array(cells, float).reshape(-1, 15)
    return found[:, 6] - found[:, 4], found[:, [10, 12, 11, 9, 8, 7, 13]] * (1, 1, -1, 1, 1, 1, 1)


def delft(root, results, corridor=False):
    """AP of each class. Frames are those of the results; boxes of up to 40 pixels in the picture are ignored, and beside the
    corridor in the second pass."""
    scores = {}
    for name, least in LEAST_OF_DELFT.items():
        scans = []
        for path in sorted(glob.glob(os.path.join(results, "*.txt"))):
            (heights, truth), (found_heights, found) = (labels_of(one, name) for one in (
                f"{root}/lidar/training/label_2/{os.path.basename(path)}", path))
            is_counted, is_found = heights > LEAST_HEIGHT_PX, found_heights > LEAST_HEIGHT_PX
            if corridor:
                is_counted &= (abs(truth[:, 0]) <= 4) & (truth[:, 1] <= 25)
                is_found &= (abs(found[:, 0]) <= 4) & (found[:, 1] <= 25)
            scans.append((overlaps(found[is_found], truth), numpy.full(is_found.sum(), 0.9), is_counted))
        scores[name] = average_precision(scans, least)
    return scores


def delft_evaluates(folder):
    """Truth whose sizes are a hundredth smaller has the score 100 in each class, in both passes; truth given back as it is has
    a score, however low."""
    root = delft_lane(folder)
    for corridor in (False, True):
        found = delft(root, results_of(root, f"{folder}/smaller-{corridor}", 0.99), corridor)
        assert found == dict.fromkeys(LEAST_OF_DELFT, 100), found
    assert delft(root, results_of(root, f"{folder}/equal"))["Car"] < 50


def parallel_sides_divide_by_zero(_):
    """In rows of equal cars under many headings, where they are not turned; not where each is by an angle of its own."""
    with open(ROOT + "/data/exports/vod.json", encoding="utf-8") as file:
        layout = json.load(file)
    for angles in [0, 0], layout["turned_rad"]:
        turned, draw, failed = kitti.Writer(layout | {"turned_rad": angles}, None, {}), numpy.random.default_rng(2), 0
        for heading, x, y in zip(draw.uniform(-3, 3, 1000), draw.uniform(-20, 20, 1000), draw.uniform(10, 50, 1000)):
            row = [(round(x + 7 * i * math.cos(heading), 6), round(y - 7 * i * math.sin(heading), 6), -0.5, 4.5, 1.8, 1.5,
                    round(heading + turned.turn_rad(i), 9)) for i in range(5)]
            try:
                overlaps(row, row)
            except ZeroDivisionError:
                failed += 1
        assert (failed > 0) == (angles == [0, 0]), (angles, failed)


def delft_lane(folder, form="vod"):
    """The root of a radar behind cars, cyclists and people in a row each."""
    scenario = {"origin": "For tests.", "ego": "ego", "rate_hz": 20, "duration_s": 3, "objects": [
        {"id": "ego", "class": "car", "x_m": 0, "y_m": 0, "speed_mps": 5},
        *({"id": f"{kind}{i}", "class": kind, "x_m": 8 + 6 * i + 2 * k, "y_m": y, "speed_mps": 5} for i in range(3)
          for k, (kind, y) in enumerate((("car", 0), ("pedestrian", 2), ("bicycle", -2))))]}
    save(folder, "lane.json", json.dumps(scenario))
    shell("glint-traffic ./lane.json | glint-extract | glint-ideal --sensors lrr77 --sections quality | glint-sensor | glint-noise > list.jsonl", folder)
    export(folder, form, "--out", os.path.basename(form) + "-lane", "list.jsonl")
    return f"{folder}/{os.path.basename(form)}-lane/front"


def boxes_are_turned_by_different_angles(folder):
    """By 1e-5 to 1e-4 rad, and two boxes of a scan by angles that single precision tells apart."""
    export(folder, "kitti", "--out", "straight", list_of(folder))
    export(folder, "vod", "--out", "turned", list_of(folder))
    for path in glob.glob(f"{folder}/straight/*/training/label_2/*.txt"):
        name = os.path.basename(path)
        with open(path, encoding="utf-8") as one, open(path.replace("straight", "turned").replace(
                "/training", "/lidar/training").replace(name, name[1:]), encoding="utf-8") as other:
            pairs = [[float(line.split()[14]) for line in file] for file in (one, other)]
        turns = [math.remainder(b - a, math.tau) for a, b in zip(*pairs, strict=True)]
        assert all(0.9e-5 < turn < 1.01e-4 for turn in turns), turns
        assert all(b - a > 3e-7 for a, b in zip(sorted(turns), sorted(turns)[1:])), turns


prove((openpcdet_trains_and_evaluates, openpcdet_fails_where_it_is_known_to, stock_loaders_of_kitti_take_four_columns, delft_evaluates,
       parallel_sides_divide_by_zero, boxes_are_turned_by_different_angles), sys.argv[2:])
