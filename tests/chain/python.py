#!/usr/bin/env python3
"""scripts/glint.py and scripts/tracker do what they say: python3 tests/chain/python.py BIN_DIR"""
import gzip
import json
import math
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
SCRIPTS = os.path.join(ROOT, "scripts")
sys.path.insert(0, SCRIPTS)
import glint  # noqa: E402

ENVIRONMENT = dict(os.environ, PATH=os.path.abspath(sys.argv[1]) + os.pathsep + os.environ["PATH"],
                   PYTHONPATH=SCRIPTS, PYTHONDONTWRITEBYTECODE="1")
EXACT = "glint-extract | glint-ideal --sensors corner77-every-frame | glint-sensor-perfect | glint-noise-none"
TURNING_FRAME = {
    "ego": "e", "origin_x_m": 500000.0, "origin_y_m": -20.0,
    "objects": [{"id": "e", "x_m": 3, "y_m": 4, "yaw_rad": math.pi / 2, "vx_mps": 0, "vy_mps": 10,
                 "yaw_rate_radps": 0.5}],
    "sensors": {"list": [{"name": "left", "mount_x_m": 2, "mount_y_m": 1, "mount_yaw_rad": math.pi / 2}]},
}
AHEAD = {"sensor": "left", "range_m": 10, "azimuth_rad": 0, "range_rate_mps": -1}


def shell(command, folder, **options):
    return subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, env=ENVIRONMENT, check=True,
                          capture_output=True, text=True, **options).stdout


def near(found, expected):
    assert all(math.isclose(*pair, abs_tol=1e-9) for pair in zip(found, expected)), (found, expected)


def places_are_in_the_system_that_is_asked_for(folder):
    near(glint.place(TURNING_FRAME, AHEAD, "sensor"), (10, 0))
    near(glint.place(TURNING_FRAME, AHEAD, "ego"), (2, 11))
    near(glint.place(TURNING_FRAME, AHEAD), (500000 + 3 - 11, -20 + 4 + 2))
    # The sensor moves by (-1, 9.5) m/s and looks along (-1, 0).
    near([glint.rate_over_ground(TURNING_FRAME, AHEAD)], [0])


def detections_are_placed_from_where_the_ego_was(folder):
    """As the quality of targets says, of a car in a bend whose radar has a latency."""
    with open(os.path.join(ROOT, "data/sensors/corner77.json"), encoding="utf-8") as file:
        suite = json.load(file)
    for sensor in suite["sensors"]:
        sensor["latency_s"] = 0.05
        sensor["antenna_table"] = os.path.abspath(os.path.join(ROOT, "data/antennas/corner77.csv"))
    scene = {"origin": "For tests.", "ego": "ego", "rate_hz": 25, "duration_s": 2, "objects": [
        {"id": "ego", "class": "car", "x_m": 0, "y_m": 0, "speed_mps": 12,
         "segments": [{"duration_s": 2, "yaw_rate_radps": 0.4}]},
        {"id": "other", "class": "car", "x_m": 20, "y_m": 12, "speed_mps": 3}]}
    for name, document in (("suite.json", suite), ("scene.json", scene)):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            json.dump(document, file)
    shell("glint-traffic ./scene.json | glint-extract | glint-ideal --sensors ./suite.json --sections quality"
          " | glint-sensor | glint-noise >late.jsonl", folder)
    seen = 0
    for frame in glint.frames(os.path.join(folder, "late.jsonl")):
        for target in frame["targets"]:
            told = target["quality"]
            assert math.dist(glint.place(frame, target), (told["x_world_m"], told["y_world_m"])) < 1e-3
            assert abs(glint.rate_over_ground(frame, target) - told["range_rate_over_ground_mps"]) < 1e-3
            seen += 1
    assert seen > 20, seen


def bad_input_is_told_without_a_trace(folder):
    good = shell(f"glint-traffic cut-in | {EXACT}", folder).splitlines()[0].encode() + b"\n"
    for bad, status, message in ((b"\n", 65, "bad.jsonl:2: "), (b"5\n", 65, "bad.jsonl:2: no member"),
                                 (b"\xff\n", 65, "bad.jsonl:2: 'utf-8' codec"), (good[:99], 65, "bad.jsonl:2: "),
                                 (b'{"scene":"s","seed":"1","frame":0,"time_s":0}\n', 65, "bad.jsonl:2: no sensors"),
                                 (good.replace(b'"time_s":0', b'"time_s":NaN'), 65, "bad.jsonl:2: NaN is no number"),
                                 (good.replace(b'"objects"', b'"extra"'), 65, "without its ego"), (None, 66, "No such file")):
        if bad is not None:
            with open(os.path.join(folder, "bad.jsonl"), "wb") as file:
                file.write(good + bad)
        done = subprocess.run([SCRIPTS + "/tracker", "bad.jsonl" if bad is not None else "nowhere.jsonl"], cwd=folder,
                              env=ENVIRONMENT, capture_output=True, text=True, check=False)
        assert done.returncode == status and message in done.stderr and "Traceback" not in done.stderr, (bad, done)
    with open(os.path.join(folder, "bad.jsonl.gz"), "wb") as file:
        file.write(gzip.compress(b"")[:10] + b"\xff" * 16)
    with open(os.path.join(folder, "good.jsonl"), "wb") as file:
        file.write(good)
    for command, status, message in (("tracker bad.jsonl.gz", 65, "bad.jsonl.gz:1: Error -3"),
                                     ("tracker good.jsonl >/dev/full", 74, "No space left")):
        done = subprocess.run(f"{SCRIPTS}/{command}", shell=True, cwd=folder, env=ENVIRONMENT, stderr=subprocess.PIPE,
                              text=True, check=False)
        assert done.returncode == status and message in done.stderr and "Traceback" not in done.stderr, done


def scenes_of_two_seeds_share_no_tracks(folder):
    text = shell(f"glint-traffic cut-in | {EXACT}", folder)
    with open(os.path.join(folder, "two.jsonl"), "w") as file:
        file.write(text + text.replace('"seed":"1"', '"seed":"2"'))
    tracks = [[one["x_m"] for one in json.loads(line)["tracks"]]
              for line in shell(f"{sys.executable} {SCRIPTS}/tracker two.jsonl", folder).splitlines()]
    half = len(tracks) // 2
    assert any(tracks) and tracks[:half] == tracks[half:]


def what_stands_has_no_rate_over_ground(folder):
    scene = {"origin": "For tests.", "ego": "ego", "rate_hz": 10, "duration_s": 2, "objects": [
        {"id": "ego", "class": "car", "x_m": 0, "y_m": 0, "speed_mps": 9,
         "segments": [{"duration_s": 2, "acceleration_mps2": -2, "yaw_rate_radps": 0.4}]},
        {"id": "post", "class": "post", "x_m": 30, "y_m": 12, "speed_mps": 0},
        {"id": "other", "class": "post", "x_m": 25, "y_m": -9, "speed_mps": 0}]}
    with open(os.path.join(folder, "scene.json"), "w") as file:
        json.dump(scene, file)
    shell(f"glint-traffic ./scene.json | {EXACT} >exact.jsonl", folder)
    posts = {"post": (30, 12), "other": (25, -9)}
    seen = 0
    for frame in glint.frames(os.path.join(folder, "exact.jsonl")):
        columns = glint.detections(frame)
        for rate, x, y, name in zip(*(columns[key] for key in ("rate_over_ground_mps", "x_m", "y_m", "object"))):
            assert abs(rate) < 1e-6, rate
            assert math.dist((x, y), posts[name]) < 0.5, (name, x, y)
            seen += 1
    assert seen > 20, seen


def frames_are_read_from_files_of_both_kinds(folder):
    text = shell("glint-traffic cut-in", folder)
    with gzip.open(os.path.join(folder, "cut-in.jsonl.gz"), "wt") as file:
        file.write(text)
    expected = [json.loads(line) for line in text.splitlines()]
    assert list(glint.frames(os.path.join(folder, "cut-in.jsonl.gz"))) == expected
    broken = os.path.join(folder, "broken.jsonl")
    with open(broken, "w") as file:
        file.write(text[:text.index("\n") + 50])
    try:
        list(glint.frames(broken))
    except ValueError as error:
        assert f"{broken}:2:" in str(error), error
    else:
        raise AssertionError("a broken line was read")


def a_stage_that_changes_nothing_changes_no_byte_of_the_list(folder):
    with open(os.path.join(folder, "same.py"), "w") as file:
        file.write("import glint\n\nglint.stage(lambda frame: frame)\n")
    head = "glint-traffic cut-in | glint-extract | glint-ideal --sensors lrr77-every-frame"
    tail = "glint-sensor | glint-noise"
    assert shell(f"{head} | {sys.executable} same.py | {tail}", folder) == shell(f"{head} | {tail}", folder)


def columns_have_the_numbers_of_quality(folder):
    shell("glint-traffic cut-in | glint-extract | glint-ideal --sensors lrr77-every-frame --sections quality"
          " | glint-sensor | glint-noise >list.jsonl", folder)
    frame = next(glint.frames(os.path.join(folder, "list.jsonl")))
    columns = glint.detections(frame)
    assert list(columns["snr_db"]) == [one["quality"]["snr_db"] for one in frame["targets"]] != []


def workers_share_the_shards_of_a_set(folder):
    for number in range(5):
        os.makedirs(os.path.join(folder, "set", "train", "lrr77"), exist_ok=True)
        with gzip.open(os.path.join(folder, "set", "train", "lrr77", f"{number}.jsonl.gz"), "wt") as file:
            file.write(f'{{"frame":{number}}}\n')
    read = [[frame["frame"] for frame in glint.Shards(os.path.join(folder, "set"), "train", worker=one, workers=2)]
            for one in (0, 1)]
    assert read == [[0, 2, 4], [1, 3]], read


def the_tracker_follows_most_of_what_is_detected(folder):
    shell("glint-traffic cut-in | glint-extract | glint-ideal --sensors lrr77-every-frame | glint-sensor"
          " | glint-noise >list.jsonl", folder)
    score = json.loads(shell(f"{sys.executable} {SCRIPTS}/tracker list.jsonl | glint-score-tracks --tracks - list.jsonl"
                             " --objects detected --classes car,truck,van,motorcycle,articulated_truck --summary", folder))
    found = score["all"]
    assert found["pair_count"] >= 0.9 * found["true_count"], found
    assert found["false_count"] <= 0.4 * found["listed_count"], found
    assert found["position_m"]["mean"] < 2 and found["velocity_mps"]["mean"] < 1, found
    assert score["id_switches"] <= 8, score


def main():
    for test in (places_are_in_the_system_that_is_asked_for, what_stands_has_no_rate_over_ground,
                 frames_are_read_from_files_of_both_kinds, a_stage_that_changes_nothing_changes_no_byte_of_the_list,
                 columns_have_the_numbers_of_quality, detections_are_placed_from_where_the_ego_was,
                 bad_input_is_told_without_a_trace, scenes_of_two_seeds_share_no_tracks,
                 workers_share_the_shards_of_a_set, the_tracker_follows_most_of_what_is_detected):
        with tempfile.TemporaryDirectory() as folder:
            test(folder)
        print("ok      ", test.__name__.replace("_", " "))


main()
