#!/usr/bin/env python3
"""Sets of every kind of source are exported with every option of a plan, in every layout: tests/chain/export_pairs.py BIN_DIR [FROM:TO]

Any two values of any two factors meet in one set; each set is exported in all layouts. FROM:TO runs only these cases.
"""
import csv
import json
import os
import struct
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from scripts import ENVIRONMENT, ROOT, SCRIPTS  # noqa: E402
from glint.exports.streams import Scenes, frames_of, scans_of, streams_of  # noqa: E402
from pairs import covering  # noqa: E402

LAYOUTS = "nuscenes", "truckscenes", "openpcdet", "kitti", "vod"
RECORDED = {"licence": "MIT", "source": "glint"}
HIGHWAY = {"recording": ROOT + "/data/trajectories/highway.csv", "from_s": 0, "to_s": 0.6, "rate_hz": 10} | RECORDED
FACTORS = {
    "source": [HIGHWAY | {"egos": ["2"]}, HIGHWAY | {"egos": ["2", "3"]}, HIGHWAY | {"egos": ["2", "3"], "block_s": 0.3},
               {"recording": "./bridge.xml", "program": "glint-traffic-sumo", "egos": ["0", "1"], "options": "--class-map passenger=car"} | RECORDED,
               {"scenario": "two-vehicles", "program": "glint-traffic"}, {"scenario": "varied-cut-in", "scenes": [0, 2]},
               {"random": "sparse", "frames": 4, "options": "--roadside --draw-conditions"},
               {"random": "medium", "seconds": 0.4, "scenes": [0, 3], "rate_hz": 10, "options": "--roadside"}],
    "suite": ["corner77-four", "array77", "lrr77-full", "radarscenes77-full"],
    "sections": ["quality", "quality,visibility", "quality,visibility,account"],
    "vehicles": ["paper", "detailed", "surfaces"],
    "form": [{}, {"compression": "zstd"}, {"tables": True}, {"tables": True, "lines": "none"}, {"tables": True, "lines": "none", "compression": "zstd"}],
    "seeds": [{}, {"seeds": [1, 5]}],
    "frames_per_shard": [5, 1000]}
BRIDGE = {"0": (-60, 0, 0, 15, 0), "1": (-30, 0, 0, 15, 0), "2": (20, -40, 6, 0, 12), "3": (-45, 3.5, 0, 14, 0)}  # x, y, height, velocity


def bridge():
    """A road with a bridge over it, as SUMO writes it with heights."""
    steps = "".join(f'<timestep time="{i / 10:.2f}">' + "".join(
        f'<vehicle id="{name}" type="passenger" x="{x + vx * i / 10:.2f}" y="{y + vy * i / 10:.2f}" z="{z:.2f}" angle="{90 if vx else 0}" speed="{vx or vy}"/>'
        for name, (x, y, z, vx, vy) in BRIDGE.items()) + "</timestep>\n" for i in range(6))
    return f"<fcd-export>\n{steps}</fcd-export>\n"


def points_in(path, layout):
    """How many points a file has, by its length or its heading."""
    with open(path, "rb") as file:
        data = file.read()
    if layout == "openpcdet":
        return (len(data) - 10 - struct.unpack_from("<H", data, 8)[0]) / 24
    if layout in ("kitti", "vod"):
        return len(data) / 28
    return int(data.split(b"\nPOINTS ")[1].split(b"\n")[0])


def exported(folder, case):
    """Makes the set of a case; what is wrong with its exports is an AssertionError."""
    plan = {"name": "set", "origin": "For tests.", "sources": [case["source"]], "suites": [case["suite"]], "vehicles": case["vehicles"],
            "chain": f"glint-extract | glint-ideal --sensors {{suite}} --sections {case['sections']} | glint-sensor | glint-noise",
            "frames_per_shard": case["frames_per_shard"], "exports": [*LAYOUTS]} | case["form"] | case["seeds"]
    for name, text in ("plan.json", json.dumps(plan)), ("bridge.xml", bridge()):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    done = subprocess.run(["bash", "-c", f"{SCRIPTS}/dataset plan.json --out set && make -s -C set && {SCRIPTS}/check-set set"], cwd=folder,
                          env=ENVIRONMENT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    frames = [frame for _, frame in frames_of(streams_of(os.path.join(folder, "set"), ""), Scenes())]
    scenes = {(frame["scene"], frame["seed"]) for frame in frames}
    egos = len(case["source"].get("egos", "1"))
    assert len(scenes) >= egos * len(case["seeds"].get("seeds", "1")), scenes
    expected = {(frame["scene"], frame["seed"], frame["frame"], sensor["name"]): len(targets) for frame in frames for sensor, targets in scans_of(frame)}
    for layout in LAYOUTS:
        root, found = f"{folder}/set/exports/{layout}", {}
        with open(root + "/glint-scans.csv", encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file):
                found[row["scene"], row["seed"], int(row["frame"]), row["sensor"]] = int(row["points"])
                is_nan = layout == "nuscenes" and row["points"] == "0"  # a scan without targets is one point of NaN there
                assert points_in(os.path.join(root, row["path"]), layout) == int(row["points"]) + is_nan, row
        if layout == "openpcdet":  # it leaves out scans without a box
            assert found.items() <= expected.items(), layout
        else:
            assert found == expected, (layout, found.items() ^ expected.items())
    return len(expected)


def main():
    cases, scans = list(covering(FACTORS)), 0
    begin, end = map(int, sys.argv[2].split(":")) if sys.argv[2:] else (0, len(cases))
    for number, case in enumerate(cases[begin:end], begin):
        with tempfile.TemporaryDirectory() as folder:
            try:
                scans += exported(folder, case)
            except AssertionError:
                print(f"case {number}: {json.dumps(case)}", file=sys.stderr)
                raise
    assert scans > 100 or sys.argv[2:], scans
    print(f"ok       {end - begin} sets of pairs of options are exported in {len(LAYOUTS)} layouts: {scans} scans each")


main()
