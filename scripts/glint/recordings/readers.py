"""Recordings of real radars: target lists, and boxes of the road users around.

In memory a recording is as data/measured/README.md has `recording.json`; each reader turns one layout of files into it.
Places and velocities of boxes are relative to the ego, x ahead and y left. Either figure of a level may be None, and the elevation.
"""
import glob
import itertools
import json
import math
import os
import re
import statistics
import struct
from collections import namedtuple

from glint import command_line
from glint.recordings import statics

Detection = namedtuple("Detection", "range_m azimuth_rad range_rate_mps snr_db rcs_dbsm elevation_rad", defaults=(None, None, None))
Box = namedtuple("Box", "id kind x_m y_m yaw_rad vx_mps vy_mps length_m width_m height_m")
Scan = namedtuple("Scan", "time_s detections boxes")
Radar = namedtuple("Radar", "x_m y_m yaw_rad carrier_hz")
Recording = namedtuple("Recording", "radar scans notes")  # notes: sentences on what the files lack

# Words of both data sets, by vehicle document. A rider is part of the two-wheeler.
CLASSES = {"car": "car", "van": "van", "truck": "truck", "truck/bus": "truck", "bus": "bus", "motorbike": "motorcycle",
           "motor": "motorcycle", "moped_scooter": "motorcycle", "bike": "bicycle", "bicycle": "bicycle",
           "cyclist": "bicycle", "pedestrian": "pedestrian"}
STANDING = {"post", "guardrail", "wall"}  # classes that are no road users
KINDS = STANDING | {"articulated_truck", *CLASSES.values()}
# Bounds of numbers, (-FARTHEST, FARTHEST) of others: glint's objects, and fields of view below 180 degrees.
BOUNDS = {"range_m": (0, 1e4), "azimuth_rad": (-1.55, 1.55), "elevation_rad": (-1.6, 1.6), "yaw_rad": (-10, 10), "carrier_hz": (1e9, 1e12), "time_s": (-1e11, 1e11),
          **dict.fromkeys(("length_m", "width_m", "height_m"), (0, 100)), **dict.fromkeys(("snr_db", "rcs_dbsm"), (-300, 300))}
FARTHEST = 1e4
MOST = 400  # scans, so that 39 lists of each fit into memory
ARTICULATED_M = 12  # longer trucks are articulated
LONGEST_GAP_S = 5  # between lists of one sequence
KITTI_INTERVAL_S = 0.1  # assumed, as that layout has no times
FOLLOWED_M = 4  # from scan to scan, of a box without an id: less than from one car to the next
BEYOND_M = 25  # the farthest box: how far detections of a dense list are kept


def read(folder):
    """The recording of a folder in one of three layouts; ends the program if it cannot be read."""
    for pattern, reader in (("recording.json", own), ("**/extrinsic_matrices.json", aimotive),
                            ("**/radar/**/velodyne", kitti), ("**/velodyne", kitti)):
        places = sorted(glob.glob(os.path.join(glob.escape(folder), pattern), recursive=True))
        for found in places[:1]:
            try:
                if len(places) > 1:
                    raise ValueError(f"{places[1]} is another sequence; expected one a folder")
                recording = reader(folder, found)
                check(recording.radar, recording.scans[:MOST])
            except StopIteration:
                command_line.fail(os.EX_DATAERR, f"{found}: expected a radar, and lists or calibration beside it")
            except KeyError as error:
                command_line.fail(os.EX_DATAERR, f"{found}: {error.args[0]!r} is missing, a member or the number of a file beside it")
            except (AttributeError, IndexError, TypeError, ValueError, OSError, OverflowError, RecursionError, struct.error) as error:
                command_line.fail(os.EX_DATAERR, f"{found}: {'' if isinstance(error, ValueError) else type(error).__name__ + ': '}{error}")
            scans = [scan._replace(boxes=[box for box in scan.boxes if box.kind in KINDS]) for scan in recording.scans[:MOST]]
            return recording._replace(scans=statics.retimed(recording.radar, scans), notes=recording.notes + lacks(scans) + [
                f"boxes of the class {kind} are left out" for kind in sorted(
                    {box.kind for scan in recording.scans for box in scan.boxes} - KINDS)] + (
                [f"scans after the first {MOST} are left out"] if len(recording.scans) > MOST else []))
    command_line.fail(os.EX_NOINPUT, f"{folder}: expected recording.json, extrinsic_matrices.json (aiMotive) or velodyne/ (KITTI)")


def check(radar, scans):
    """Raises ValueError with path, value and expectation where a recording cannot be."""
    def expect(good, path, value, expected):
        if not good:
            raise ValueError(f"{path}: {value}; expected {expected}")

    rows = [("radar", radar._asdict()), *((f"scans[{i}]", {"time_s": scan.time_s}) for i, scan in enumerate(scans))]
    rows += [(f"scans[{i}].{part}[{k}]", one._asdict()) for i, scan in enumerate(scans) for part in ("detections", "boxes")
             for k, one in enumerate(getattr(scan, part))]
    for path, row in rows:
        for name, value in row.items():
            least, most = BOUNDS.get(name, (-FARTHEST, FARTHEST))
            if name in ("id", "kind"):
                expect(isinstance(value, str) and value.isprintable() and 0 < len(value) < 256, f"{path}.{name}", value, "a short word")
            elif value is not None or name not in ("snr_db", "rcs_dbsm", "elevation_rad"):
                expect(type(value) in (int, float) and least < value < most, f"{path}.{name}", value,
                       f"a number above {least:g} and below {most:g}")
        expect("snr_db" not in row or {row["snr_db"], row["rcs_dbsm"]} != {None}, path, row, "snr_db, rcs_dbsm or both")
    for i, scan in enumerate(scans):
        path, ids = f"scans[{i}]", [box.id for box in scan.boxes]
        expect(i == 0 or scan.time_s > scans[i - 1].time_s, f"{path}.time_s", scan.time_s, "a time after that of the scan before")
        expect(len({"ego", *ids}) > len(ids), f"{path}.boxes", ids, "an id for each, and none that is ego")
    for half in (scans[:len(scans) // 2], scans[len(scans) // 2:]):
        expect(len(half) >= 4, "scans", len(scans), "eight or more")
        expect(sum(len(scan.detections) for scan in half) >= 4, "detections of a half", "fewer than four", "four or more")


def is_dense(scans):
    """Are there detections with elevations, and road users? The radar is taken for an imaging one then."""
    return any(scan.boxes for scan in scans) and any(one.elevation_rad is not None for scan in scans for one in scan.detections)


def lacks(scans):
    found, detections = [], [one for scan in scans for one in scan.detections]
    if not any(scan.boxes for scan in scans):
        found.append("no boxes with ids: lag, inset, skill and the marginals of road users are left out")
    if any(one.snr_db is None for one in detections):
        found.append("no signal-to-noise ratio: the weakest tenth of the cross sections at a range stands for the threshold")
    if any(one.rcs_dbsm is None for one in detections):
        found.append("no cross section: " + ("levels fall with range as those of road users do, and are as strong" if is_dense(scans) else
                                             "40 dB a decade are assumed, and 0 dBsm at the threshold at the farthest range"))
    return found


def json_of(name):
    with open(name, encoding="utf-8") as file:
        return json.load(file)


def numbered(folder, pattern):
    """{number: name} of all files of a pattern in a folder and below."""
    found = glob.glob(os.path.join(glob.escape(folder), "**", pattern), recursive=True)
    return {int(re.findall(r"\d+", os.path.basename(name))[-1]): name for name in sorted(found)}


def class_of(word, length_m):
    kind = CLASSES.get(word.lower(), word)
    return "articulated_truck" if kind == "truck" and length_m > ARTICULATED_M else kind


def own(_, name):
    def row(of, told):
        if not set(told) <= set(of._fields):
            raise ValueError(f"{told}: expected no members but {', '.join(of._fields)}")
        return of(**told)

    told = json_of(name)
    scans = [Scan(scan["time_s"], [row(Detection, one) for one in scan["detections"]],
                  [row(Box, one | {"id": str(one["id"])}) for one in scan.get("boxes", []) if "id" in one]) for scan in told["scans"]]
    nameless = sum("id" not in one for scan in told["scans"] for one in scan.get("boxes", []))
    return Recording(row(Radar, told["radar"]), scans, [f"{nameless} boxes without id are left out"] * (nameless > 0))


def aimotive(folder, extrinsics):
    """A sequence of the aiMotive Multimodal Dataset, of the one radar that has both a matrix and lists."""
    prefix, matrices, boxes, scans = "RT_body_from_", json_of(extrinsics), numbered(folder, "frame_*.json"), []
    radars = [key for key in matrices if key.startswith(prefix) and numbered(folder, f"{key[len(prefix):]}_*.json")]
    radar = next(iter(radars))
    for number, name in numbered(folder, f"{radar[len(prefix):]}_*.json").items():
        captured = json_of(boxes[number])
        scans.append(Scan(float(captured["Timestamp"]) * 1e-9,
                          [Detection(one["range"], one["azimuth"], one["speed"], one["power"] - one["noise"],
                                     10 * math.log10(one["rcs"])) for one in json_of(name)["targets"]],
                          list(map(aimotive_box, captured["CapturedObjects"]))))
    matrix = matrices[radar]
    mount = Radar(matrix[0][3], matrix[1][3], math.atan2(matrix[1][0], matrix[0][0]), 77e9)
    expect_one_sequence(scans)
    return Recording(mount, scans, [f"other radars of the folder than {radar[len(prefix):]} are left out"] * (len(radars) > 1))


def expect_one_sequence(scans):
    for before, after in zip(scans, scans[1:]):
        if not 0 < after.time_s - before.time_s < LONGEST_GAP_S:
            raise ValueError(f"lists {after.time_s - before.time_s:.1f} s apart are of two sequences; expected one a folder")


def aimotive_box(told):
    def of(name, axes):
        return [told[f"{name} {axis}"] for axis in axes]

    w, x, y, z = of("BoundingBox3D Orientation Quat", "WXYZ")
    size = of("BoundingBox3D Extent", "XYZ")
    return Box(str(told["ObjectId"]), class_of(told["ObjectType"], size[0]), *of("BoundingBox3D Origin", "XY"),
               math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)), *of("Relative Velocity", "XY"), *size)


def kitti(folder, clouds):
    """Labels in the camera's axes, and points: of seven floats in View-of-Delft, of eight in TJ4DRadSet. Only labels of a folder
    label_2_with_track_ids have ids, in the second column; TJ4DRadSet has none. Boxes move with the slope of their places over
    five scans."""
    names, place = numbered(clouds, "*.bin"), os.path.dirname(clouds)
    sizes = list(map(os.path.getsize, names.values()))
    of_eight = all(size % 32 == 0 for size in sizes) and any(size % 28 for size in sizes)
    matrices = numbered(place, "calib/*.txt") or numbered(folder, "calib/*.txt")
    labels = numbered(place, "label_2/*.txt") if of_eight else numbered(folder, "label_2_with_track_ids/*.txt")
    scans, tracks, boxes, unused = [], {}, [], itertools.count(1)
    for number, name in list(names.items())[:MOST + 1]:
        with open(name, "rb") as file:
            points = (points_of_eight if of_eight else points_of_seven)(file.read())
        scans.append(Scan(number * KITTI_INTERVAL_S, points, []))
        if number in labels:
            with open(matrices[number], encoding="utf-8") as calibration, open(labels[number], encoding="utf-8") as file:
                matrix = next([float(one) for one in line.split()[1:]] for line in calibration if line.startswith("Tr_velo"))
                told = [kitti_box(line.split(), matrix) for line in file]
            boxes = followed(told, boxes, unused) if of_eight else told
            for box in boxes:
                tracks.setdefault(box.id, {})[number * KITTI_INTERVAL_S] = box
    expect_one_sequence(scans)
    for scan in scans:
        for track in tracks.values():
            near = {then: one for then, one in track.items() if abs(then - scan.time_s) < 2.5 * KITTI_INTERVAL_S}
            if scan.time_s in near and len(near) > 1:
                vx, vy = (statistics.linear_regression(list(near), [getattr(one, axis) for one in near.values()]).slope
                          for axis in ("x_m", "y_m"))
                scan.boxes.append(near[scan.time_s]._replace(vx_mps=vx, vy_mps=vy))
    notes = [f"no times: an interval of {KITTI_INTERVAL_S} s is assumed"]
    if of_eight and tracks:
        reach_m = BEYOND_M + max(math.hypot(box.x_m, box.y_m) for track in tracks.values() for box in track.values())
        notes.append(f"detections beyond {reach_m:.0f} m, where no box is, are left out")
        scans = [scan._replace(detections=[one for one in scan.detections if one.range_m < reach_m]) for scan in scans]
    return Recording(Radar(0, 0, 0, 77e9), scans, notes)


def points_of_seven(data):
    """View-of-Delft: place, cross section, range rate, that over ground, and the scan, 0 for the present one."""
    return [Detection(math.hypot(x, y, z), math.atan2(y, x), rate, None, rcs)
            for x, y, z, rcs, rate, _, when in struct.iter_unpack("<7f", data) if when == 0]


def points_of_eight(data):
    """TJ4DRadSet: place, range rate, range, signal-to-noise ratio, and both angles in degrees, to the right and down."""
    return [Detection(range_m, math.atan2(y, x), rate, snr_db, None, math.atan2(z, math.hypot(x, y)))
            for x, y, z, rate, range_m, snr_db, _, _ in struct.iter_unpack("<8f", data)]


def followed(boxes, before, unused):
    """Boxes without ids: each gets that of the nearest box of the scan before, the nearest pair first, or an unused number."""
    pairs, ids = sorted((math.dist(one[2:4], other[2:4]), i, other.id) for i, one in enumerate(boxes) for other in before), {}
    for off_m, i, name in pairs:
        if off_m < FOLLOWED_M and i not in ids and name not in ids.values():
            ids[i] = name
    return [box._replace(id=ids[i] if i in ids else str(next(unused))) for i, box in enumerate(boxes)]


def kitti_box(words, matrix):
    """From the camera's axes, where y points down and a box stands on its place, to those of the radar."""
    height, width, length, *place, turn = map(float, words[8:15])
    away, ahead = [place[i] - matrix[4 * i + 3] for i in range(3)], (math.cos(turn), 0, -math.sin(turn))
    x, y, dx, dy = (sum(matrix[4 * i + axis] * of[i] for i in range(3)) for of in (away, ahead) for axis in (0, 1))
    return Box(words[1], class_of(words[0], length), x, y, math.atan2(dy, dx), 0, 0, length, width, height)
