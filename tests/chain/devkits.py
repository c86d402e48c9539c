#!/usr/bin/env python3
"""The devkits of nuScenes and TruckScenes do their whole job on what scripts/export writes: tests/chain/devkits.py BIN_DIR [TEST...]

They find a split, evaluate the truth as a result of detection and of tracking, and draw a radar's sample, by tests/support/devkits.py,
which is our own. Each failure of theirs that is known is planted once.
"""
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from scripts import ENVIRONMENT, SCRIPTS  # noqa: E402
import devkits  # noqa: E402
from devkits import Tables, as_predictions, in_box, rotated  # noqa: E402

FORMS = "nuscenes", "truckscenes"
EVERY_CLASS = {"car", "truck", "bus", "motorcycle", "bicycle", "pedestrian"}


def shell(command, folder):
    subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, env=ENVIRONMENT, check=True)


def exported(folder, form):
    """An export of two scenes, one of them a crossing with road users of all kinds; it is made once."""
    root = os.path.join(folder, form)
    if not os.path.exists(root):
        chain = "glint-extract | glint-ideal --sections quality,visibility --sensors corner77-four | glint-sensor | glint-noise"
        if not os.path.exists(os.path.join(folder, "two.jsonl")):
            shell(f"for name in intersection two-vehicles; do glint-traffic $name | awk 'NR % 4 == 1' | {chain}; done > two.jsonl", folder)
        subprocess.run([SCRIPTS + "/export", form, "--out", root, "--split", "val", "two.jsonl"], cwd=folder, env=ENVIRONMENT, check=True)
    return root


def planted(folder, form, table, change):
    """The tables of an export of which one was changed."""
    root = exported(folder, form) + "-planted"
    shutil.rmtree(root, ignore_errors=True)
    shutil.copytree(exported(folder, form), root)
    path = os.path.join(root, devkits.VERSIONS[form][0], table + ".json")
    with open(path, encoding="utf-8") as file:
        rows = json.load(file)
    with open(path, "w", encoding="utf-8") as file:
        json.dump(change(rows), file)
    return Tables(root, form)


def raises(kind, call, *arguments):
    try:
        call(*arguments)
    except kind as error:
        return str(error)
    raise AssertionError(f"no {kind.__name__}")


def detection_of(tables, change=lambda box: box):
    truth = tables.truth("glint_val")
    return tables.detection({token: [change(box) for box in boxes] for token, boxes in as_predictions(truth).items()}, "glint_val")


# --- what users do --------------------------------------------------------------------------------


def truth_with_points_is_detected_perfectly(folder):
    """Each class that is present has an average precision of 1 and no errors."""
    for form in FORMS:
        scores = detection_of(Tables(exported(folder, form), form))
        assert EVERY_CLASS <= scores.keys(), scores.keys()
        for name, score in scores.items():
            assert abs(score.pop("ap") - 1) < 1e-9 and all(error < 1e-9 for error in score.values()), (form, name, score)


def truth_with_points_is_tracked_perfectly(folder):
    tables = Tables(exported(folder, "nuscenes"), "nuscenes")
    scores = tables.tracking(as_predictions(tables.truth("glint_val", tracking=True)), "glint_val")
    assert scores.keys() == EVERY_CLASS and all(abs(score - 1) < 1e-9 for score in scores.values()), scores


def a_radar_is_drawn(folder):
    """Every sample, every radar: points lie in the boxes that count them, which have a colour each."""
    for form in FORMS:
        tables, drawn, counted = Tables(exported(folder, form), form), 0, 0
        for sample in tables.rows["sample"]:
            for channel in sample["data"].keys() - {tables.lidar}:
                points, boxes = tables.picture(sample["token"], channel)
                drawn += len(points)
                for row, centre, colour in boxes:
                    assert colour.startswith("hsl") and abs(centre[2] - row["size"][2] / 2) < 1e-6
                    pose = tables.of("ego_pose", tables.of("sample_data", sample["data"][tables.lidar])["ego_pose_token"])
                    places = [tuple(a + b for a, b in zip(rotated(pose["rotation"], point), pose["translation"])) for point, _ in points]
                    counted += sum(in_box(row, place) for place in places)
        total = sum(row["num_radar_pts"] for row in tables.rows["sample_annotation"])
        assert drawn > 1000 and 0.95 * total < counted <= total, (form, drawn, counted, total)  # folded rates are filtered


def a_lidar_sees_nothing(folder):
    """It has a row for each sample, with its time and the pose of its newest scan, all of one empty file."""
    for form in FORMS:
        tables = Tables(exported(folder, form), form)
        rows = [row for row in tables.rows["sample_data"] if row["modality"] == "lidar"]
        assert [row["sample_token"] for row in rows] == [row["token"] for row in tables.rows["sample"]]
        assert [row["timestamp"] for row in rows] == [row["timestamp"] for row in tables.rows["sample"]]
        assert {row["channel"] for row in rows} == {tables.lidar} and all(row["is_key_frame"] for row in rows)
        assert {os.path.getsize(os.path.join(tables.root, row["filename"])) for row in rows} == {0}
        mounts = {row["calibrated_sensor_token"] for row in rows}
        mount, = (tables.of("calibrated_sensor", token) for token in mounts)
        assert (mount["translation"], mount["rotation"], mount["camera_intrinsic"]) == ([0, 0, 0], [1, 0, 0, 0], [])


def the_ego_moves_as_its_poses_do(folder):
    """Velocity and acceleration of chassis and cabin are the differences of the poses, turned into the vehicle's axes; of a car that
    turns at a constant rate the acceleration to the left is speed times yaw rate."""
    scene = {"origin": "For tests.", "ego": "ego", "rate_hz": 50, "duration_s": 2, "objects": [
        {"id": "ego", "class": "car", "x_m": 0, "y_m": 0, "speed_mps": 12, "yaw_rad": 1, "segments": [{"duration_s": 2, "yaw_rate_radps": 0.3}]},
        {"id": "near", "class": "car", "x_m": 12, "y_m": 18, "speed_mps": 9}]}
    with open(os.path.join(folder, "turning.json"), "w", encoding="utf-8") as file:
        json.dump(scene, file)
    shell("glint-traffic ./turning.json | glint-extract | glint-ideal --sections quality --sensors corner77-every-frame | glint-sensor"
          f" | glint-noise > turning.jsonl; {SCRIPTS}/export truckscenes --out turning turning.jsonl", folder)
    tables = Tables(os.path.join(folder, "turning"), "truckscenes")
    poses = sorted({row["timestamp"]: row for row in tables.rows["ego_pose"]}.values(), key=lambda row: row["timestamp"])
    for name in ("ego_motion_chassis", "ego_motion_cabin"):
        rows = tables.rows[name]
        assert [row["timestamp"] for row in rows] == [row["timestamp"] for row in poses]
        for before, row, after, pose in zip(poses, rows[1:], poses[2:], poses[1:]):
            took_s = (after["timestamp"] - before["timestamp"]) / 1e6
            w, *axis = pose["rotation"]
            moved = rotated((w, *(-one for one in axis)), [(b - a) / took_s for a, b in zip(before["translation"], after["translation"])])
            assert math.dist(moved[:2], (row["vx"], row["vy"])) < 1e-3, (moved, row)
            assert abs(row["yaw_rate"] - 0.3) < 1e-9 and abs(math.remainder(row["yaw"] - devkits.yaw_of(pose["rotation"]), math.tau)) < 1e-8
        middle = rows[len(rows) // 2]
        assert abs(middle["ay"] - 0.3 * middle["vx"]) < 1e-3 and abs(middle["ax"] + 0.3 * middle["vy"]) < 1e-3, middle


def a_class_without_a_word_is_told(folder):
    """It is drawn in both devkits, and stderr says as what."""
    exported(folder, "nuscenes")
    shell("""grep two-vehicles two.jsonl | sed 's/"id":"left","class":"car"/"id":"left","class":"tractor"/' > tractor.jsonl""", folder)
    for form, name in ("nuscenes", "static.other"), ("truckscenes", "vehicle.other"):
        done = subprocess.run([SCRIPTS + "/export", form, "--out", form + "-tractor", "tractor.jsonl"], cwd=folder, env=ENVIRONMENT, check=True,
                              capture_output=True, text=True)
        assert f"export: objects of class tractor are {name}, as the layout has no word for them\n" in done.stderr, done.stderr
        tables = Tables(os.path.join(folder, form + "-tractor"), form)
        sample = tables.rows["sample"][0]
        points, boxes = tables.picture(sample["token"], "RADAR_FRONT_LEFT")
        assert points and {row["category_name"] for row, _, _ in boxes} == {"vehicle.car", name}
        assert {row["description"] for row in tables.rows["category"]} == {"car", "tractor"}


# --- failures that are known ----------------------------------------------------------------------


def splits_have_names_of_their_own(folder):
    """A name of the devkits' own splits has none of our scenes, and nothing is left to evaluate."""
    for form in FORMS:
        tables = Tables(exported(folder, form), form)
        assert tables.split("glint_val") == [row["name"] for row in tables.rows["scene"]]
        assert raises(ValueError, tables.truth, "val") == "Invalid box type: None"
        raises(KeyError, tables.truth, "glint_test")


def without_a_lidar_nothing_runs(folder):
    for form in FORMS:
        lidar = next(row["token"] for row in Tables(exported(folder, form), form).rows["sensor"] if row["modality"] == "lidar")
        of_it = {row["token"] for row in Tables(exported(folder, form), form).rows["calibrated_sensor"] if row["sensor_token"] == lidar}
        tables = planted(folder, form, "sample_data", lambda rows, of_it=of_it: [row for row in rows if row["calibrated_sensor_token"] not in of_it])
        raises(KeyError, detection_of, tables)
        sample = tables.rows["sample"][0]
        raises(KeyError, tables.picture, sample["token"], next(iter(sample["data"])))


def a_category_without_a_colour_is_not_drawn(folder):
    """Such as glint's own words; static.manmade has a colour in nuScenes alone."""
    for form, name, known in (*((form, "static_object.wall", False) for form in FORMS), ("nuscenes", "static.manmade", True), ("truckscenes", "static.manmade", False)):
        tables = planted(folder, form, "category", lambda rows, name=name: [row | {"name": name} for row in rows])
        sample = tables.rows["sample"][0]
        shown = sample["token"], next(channel for channel in sample["data"] if channel != tables.lidar)
        if known:
            tables.picture(*shown)
        else:
            raises(KeyError, tables.picture, *shown)


def a_second_or_unknown_attribute_is_refused(folder):
    for form in FORMS:
        tables = planted(folder, form, "sample_annotation", lambda rows: [row | {"attribute_tokens": row["attribute_tokens"] * 2} for row in rows])
        raises(ValueError, detection_of, tables)
        tables = planted(folder, form, "attribute", lambda rows: [row | {"name": "glint.car"} for row in rows])
        raises(AssertionError, detection_of, tables)


def truth_without_points_is_false(folder):
    """A prediction of a box that no radar saw counts as false, in detection and in tracking."""
    tables = Tables(exported(folder, "nuscenes"), "nuscenes")
    for tracking, score in (False, tables.detection), (True, tables.tracking):
        everything = {token: [*tables.boxes(token, tracking)] for token in tables.samples("glint_val")}
        scores = score(as_predictions(everything), "glint_val")
        values = [one if tracking else one["ap"] for one in scores.values()]
        assert min(values) < 0.9 and sum(values) / len(values) < 0.95, scores


def exchanged_members_are_errors(folder):
    """Length for width is an error of size alone, and a quaternion in another order one of yaw alone."""
    tables = Tables(exported(folder, "nuscenes"), "nuscenes")
    for change, wrong in ((lambda box: box | {"size": [box["size"][1], box["size"][0], box["size"][2]]}, "size"),
                          (lambda box: box | {"rotation": box["rotation"][1:] + box["rotation"][:1]}, "yaw"),
                          (lambda box: box | {"velocity": (0.0, 0.0)}, "velocity")):
        for name, score in detection_of(tables, change).items():
            errors = {key for key, value in score.items() if key != "ap" and value > 1e-6}
            assert abs(score["ap"] - 1) < 1e-9 and errors <= {wrong}, (name, score)
            assert errors or name not in ("car", "bicycle"), (name, score)
    short = as_predictions(tables.truth("glint_val"))
    short.popitem()
    raises(KeyError, tables.detection, short, "glint_val")


def a_cabin_without_motion_is_not_drawn(folder):
    for table in ("ego_motion_chassis", "ego_motion_cabin"):
        tables = planted(folder, "truckscenes", table, lambda rows: [])
        sample = tables.rows["sample"][0]
        raises(IndexError, tables.picture, sample["token"], next(channel for channel in sample["data"] if channel != tables.lidar))


def scenes_at_one_time_get_each_others_poses(folder):
    """TruckScenes finds a pose by its time among those of all scenes: ours follow each other, a second apart."""
    tables = Tables(exported(folder, "truckscenes"), "truckscenes")
    for sample in tables.rows["sample"]:
        tables.picture(sample["token"], next(channel for channel in sample["data"] if channel != tables.lidar))
    begins = [tables.of("sample", row["first_sample_token"])["timestamp"] for row in tables.rows["scene"]]
    tables = planted(folder, "truckscenes", "ego_pose", lambda rows: [row | {"timestamp": row["timestamp"] - (begins[1] - begins[0]) * (
        row["timestamp"] >= begins[1])} for row in rows])
    sample = tables.of("sample", tables.rows["scene"][1]["first_sample_token"])
    raises(AssertionError, tables.picture, sample["token"], next(channel for channel in sample["data"] if channel != tables.lidar))


def main():
    chosen = sys.argv[2:]
    with tempfile.TemporaryDirectory() as folder:
        for test in (truth_with_points_is_detected_perfectly, truth_with_points_is_tracked_perfectly, a_radar_is_drawn, a_lidar_sees_nothing,
                     the_ego_moves_as_its_poses_do, a_class_without_a_word_is_told, splits_have_names_of_their_own, without_a_lidar_nothing_runs,
                     a_category_without_a_colour_is_not_drawn, a_second_or_unknown_attribute_is_refused, truth_without_points_is_false,
                     exchanged_members_are_errors, a_cabin_without_motion_is_not_drawn, scenes_at_one_time_get_each_others_poses):
            if not chosen or test.__name__ in chosen:
                test(folder)
                print("ok      ", test.__name__.replace("_", " "), flush=True)


main()
