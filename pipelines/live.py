#!/usr/bin/env python3
"""A simulator in the loop: each frame waits for the targets of the one before.

    python3 pipelines/live.py [glint]

A car that follows a slower one brakes by what its radar lists: four processes, or one under `glint`. Where one of
them fails, the list ends, and so does the drive, with its exit code.
"""
import contextlib
import json
import subprocess
import sys

CHAIN = ["glint-extract", "glint-ideal --sensors lrr77-every-frame", "glint-sensor", "glint-noise"]
SHAPE = {"class": "car", "length_m": 0, "width_m": 0, "height_m": 0, "travelled_m": 0}
AHEAD = {"y_m": 0, "yaw_rad": 0, "vy_mps": 0, "yaw_rate_radps": 0}

radar = []
for words in [["glint", "-c", " | ".join(CHAIN)]] if sys.argv[1:] else [stage.split() for stage in CHAIN]:
    radar.append(subprocess.Popen(words, text=True, stdin=radar[-1].stdout if radar else subprocess.PIPE,
                                  stdout=subprocess.PIPE))
for program in radar[:-1]:
    program.stdout.close()  # the next one has it, and alone: its end is told to the one before

ego, leader = {"id": "ego", "x_m": 0, "vx_mps": 30}, {"id": "leader", "x_m": 80, "vx_mps": 20}
with contextlib.suppress(BrokenPipeError), radar[0].stdin as frames:
    for number in range(400):
        frame = {"version": 0, "scene": "live", "frame": number, "time_s": 0.05 * number, "interval_s": 0.05,
                 "seed": "1", "ego": "ego", "objects": [one | SHAPE | AHEAD for one in (ego, leader)]}
        print(json.dumps(frame), file=frames, flush=True)
        line = radar[-1].stdout.readline()
        if not line:
            break
        targets = json.loads(line)["targets"]
        nearest = min(targets, key=lambda one: one["range_m"], default={"range_m": 250, "range_rate_mps": 0})
        wish_mps2 = 0.1 * (nearest["range_m"] - 1.8 * ego["vx_mps"]) + 0.6 * nearest["range_rate_mps"]
        ego["vx_mps"] += 0.05 * max(-6, min(2, wish_mps2))
        for car in (ego, leader):
            car["x_m"] += 0.05 * car["vx_mps"]
        if number % 40 == 0:
            print(f"{frame['time_s']:4.1f} s  {ego['vx_mps']:4.1f} m/s  {nearest['range_m']:4.1f} m")
sys.exit(max(abs(program.wait()) for program in radar))
