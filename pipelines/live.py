#!/usr/bin/env python3
"""A simulator in the loop: each frame waits for the targets of the one before.

    python3 pipelines/live.py [bash | glint]

A car that follows a slower one brakes by what its radar lists: four processes, or one under `glint`.
"""
import json
import subprocess
import sys

CHAIN = "glint-extract | glint-ideal --sensors lrr77-every-frame | glint-sensor | glint-noise"
SHAPE = {"class": "car", "length_m": 0, "width_m": 0, "height_m": 0, "travelled_m": 0}
AHEAD = {"y_m": 0, "yaw_rad": 0, "vy_mps": 0, "yaw_rate_radps": 0}

radar = subprocess.Popen([sys.argv[1] if len(sys.argv) > 1 else "bash", "-c", CHAIN], text=True,
                         stdin=subprocess.PIPE, stdout=subprocess.PIPE)
ego, leader = {"id": "ego", "x_m": 0, "vx_mps": 30}, {"id": "leader", "x_m": 80, "vx_mps": 20}
for number in range(400):
    frame = {"version": 0, "scene": "live", "frame": number, "time_s": 0.05 * number, "interval_s": 0.05,
             "seed": "1", "ego": "ego", "objects": [one | SHAPE | AHEAD for one in (ego, leader)]}
    print(json.dumps(frame), file=radar.stdin, flush=True)
    targets = json.loads(radar.stdout.readline())["targets"]
    nearest = min(targets, key=lambda one: one["range_m"], default={"range_m": 250, "range_rate_mps": 0})
    wish_mps2 = 0.1 * (nearest["range_m"] - 1.8 * ego["vx_mps"]) + 0.6 * nearest["range_rate_mps"]
    ego["vx_mps"] += 0.05 * max(-6, min(2, wish_mps2))
    for car in (ego, leader):
        car["x_m"] += 0.05 * car["vx_mps"]
    if number % 40 == 0:
        print(f"{frame['time_s']:4.1f} s  {ego['vx_mps']:4.1f} m/s  {nearest['range_m']:4.1f} m")
radar.stdin.close()
sys.exit(radar.wait())
