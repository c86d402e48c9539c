#!/usr/bin/env python3
"""OpenPCDet's task on what scripts/export writes: load, filter, make infos, evaluate: tests/chain/toolboxes.py BIN_DIR [TEST...]

The clients here are our own, after what those programs assert, index and compute, and each fails where its original is known
to fail.
"""
import glob
import math
import os
import subprocess
import sys
import tempfile

import numpy

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPTS = os.path.join(ROOT, "scripts")
sys.path[:0] = [SCRIPTS, os.path.join(ROOT, "tests", "support")]
from rotated_overlap import LEAST_OVERLAP, average_precision, overlaps  # noqa: E402

ENVIRONMENT = dict(os.environ, PATH=os.path.abspath(sys.argv[1]) + os.pathsep + os.environ["PATH"], GLINT_DATA=ROOT + "/data")
OFF_M = 0.008, 0.006  # a centimetre, along no side of a box


def shell(command, folder):
    return subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, env=ENVIRONMENT, check=True, capture_output=True, text=True).stdout


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


TESTS = openpcdet_trains_and_evaluates, openpcdet_fails_where_it_is_known_to


def main():
    chosen = sys.argv[2:]
    for test in TESTS:
        if chosen and test.__name__ not in chosen:
            continue
        with tempfile.TemporaryDirectory() as folder:
            test(folder)
        print("ok      ", test.__name__.replace("_", " "), flush=True)


main()
