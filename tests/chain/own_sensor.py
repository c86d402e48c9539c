#!/usr/bin/env python3
"""A sensor stage of one's own, pipelines/bins.py, in the place of glint-sensor: tests/chain/own_sensor.py BIN_DIR

It is held to what it says: its labels and its account agree with the truth, echoes that share a bin share a cell and no
others do, and a lone echo gets what glint-sensor gives it.
"""
import collections
import json
import math
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
sys.path.append(os.path.join(ROOT, "scripts"))
import glint  # noqa: E402

ENVIRONMENT = dict(os.environ, PATH=os.path.abspath(sys.argv[1]) + os.pathsep + os.environ["PATH"],
                   PYTHONDONTWRITEBYTECODE="1")
FRONT = "glint-traffic cut-in | glint-extract | glint-ideal --sensors srr24-pair --sections account"
BINS = "python3 pipelines/bins.py"


def run(command, text="", expected=0):
    done = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=ROOT, env=ENVIRONMENT, input=text,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == expected, f"{command}: {done.returncode}, not {expected}\n{done.stderr}"
    return done.stdout


def frames(text):
    return [glint.name_lost(json.loads(line)) for line in text.splitlines()]


def key(sensor, echo):
    return sensor, echo["object"], echo["reflector"], echo["path"]


def labels_and_account_agree_with_the_truth(ideal):
    told = run(f"{BINS} | glint-noise | glint-check", ideal)
    counts = [int(word) for word in told.split() if word.isdigit()]
    assert counts[0] == 201 and counts[1] > 500 and counts[2] == counts[3] > 1000, told


def a_label_that_is_not_of_its_echo_is_refused(ideal):
    spoilt = [json.loads(line) for line in run(f"{BINS} | glint-noise", ideal).splitlines()]
    part = next(target for frame in spoilt for target in frame["targets"])["contributors"][0]
    part["azimuth_rad"] += 1e-6
    run("glint-check", "\n".join(map(json.dumps, spoilt)) + "\n", expected=65)


def echoes_of_a_bin_share_a_cell_and_no_others_do(ideal, own):
    shared = 0
    for before, after in zip(frames(ideal), frames(own), strict=True):
        size = {one["name"]: (one["cell_range_m"], one["cell_range_rate_mps"]) for one in before["sensors"]["list"]}
        due = collections.defaultdict(set)
        for echo in before["echoes"]:
            of_range, of_rate = size[echo["sensor"]]
            due[echo["sensor"], echo["range_m"] // of_range, echo["range_rate_mps"] // of_rate].add(key(echo["sensor"], echo))
        found = [frozenset(key(cell["sensor"], one) for one in cell["members"]) for cell in after["cells"]]
        assert len(set(found)) == len(found) and set(found) <= set(map(frozenset, due.values())), after["frame"]
        weak = {key(group["sensor"], one) for group in after["lost"] if group["stage"] == "bins" for one in group["echoes"]}
        assert weak.isdisjoint(set().union(*found)) and weak.union(*found) == set().union(*due.values()), after["frame"]
        shared += sum(len(one) > 1 for one in found)
    assert shared > 100, shared


def a_lone_echo_gets_what_glint_sensor_gives_it(ideal, own):
    alone = 0
    for theirs, ours in zip(frames(run("glint-sensor", ideal)), frames(own), strict=True):
        cells = {key(cell["sensor"], cell["members"][0]): cell for cell in theirs["cells"] if len(cell["members"]) == 1}
        for cell in ours["cells"]:
            twin = cells.get(key(cell["sensor"], cell["members"][0])) if len(cell["members"]) == 1 else None
            for name in ("range_m", "range_rate_mps", "azimuth_rad", "amplitude", "sum_re", "delta_im") if twin else ():
                assert math.isclose(cell[name], twin[name], rel_tol=1e-9, abs_tol=1e-12), (ours["frame"], name, cell, twin)
            alone += twin is not None
    assert alone > 300, alone


def borders_of_the_grid_cut_targets_and_lose_few(ideal):
    """Scored against the original, as stages/README.md does it."""
    with tempfile.TemporaryDirectory() as folder:
        run(f"tee {folder}/ideal.jsonl | {BINS} | glint-noise >{folder}/own.jsonl", ideal)
        score = run(f"glint-sensor {folder}/ideal.jsonl | glint-noise | glint-score --truth - {folder}/own.jsonl --summary")
    for sensor in json.loads(score)["sensors"]:
        missed, false = sensor["missed_count"] / sensor["true_count"], sensor["false_count"] / sensor["listed_count"]
        assert missed < 0.02 < false < 0.1, sensor


def a_frame_without_echoes_is_refused():
    frame = {"version": 1, "scene": "s", "frame": 0, "time_s": 0, "interval_s": 0.1, "seed": "1", "ego": "e",
             "objects": [{"id": "e", "class": "car", "x_m": 0, "y_m": 0, "yaw_rad": 0, "vx_mps": 0, "vy_mps": 0, "yaw_rate_radps": 0}]}
    run(BINS, json.dumps(frame) + "\n", expected=65)


echoes = run(FRONT)
cells = run(BINS, echoes)
labels_and_account_agree_with_the_truth(echoes)
a_label_that_is_not_of_its_echo_is_refused(echoes)
echoes_of_a_bin_share_a_cell_and_no_others_do(echoes, cells)
a_lone_echo_gets_what_glint_sensor_gives_it(echoes, cells)
borders_of_the_grid_cut_targets_and_lose_few(echoes)
a_frame_without_echoes_is_refused()
print("own sensor: labels, account, bins and lone echoes are what pipelines/bins.py says")
