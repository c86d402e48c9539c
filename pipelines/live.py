#!/usr/bin/env python3
"""A simulator in the loop: a car that follows a slower one brakes by what its radar lists. python3 pipelines/live.py"""
import os
import sys
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scripts"))
import glint  # noqa: E402
CAR = {"class": "car", "y_m": 0, "yaw_rad": 0, "vy_mps": 0, "yaw_rate_radps": 0, "length_m": 0, "width_m": 0, "height_m": 0, "travelled_m": 0}
ego, leader = {"id": "ego", "x_m": 0, "vx_mps": 30, **CAR}, {"id": "leader", "x_m": 80, "vx_mps": 20, **CAR}
with glint.Loop("glint-extract | glint-ideal --sensors lrr77 | glint-sensor | glint-noise", interval_s=0.1) as radar:
    for number in range(200):
        targets = radar.step("ego", [ego, leader])
        nearest = min(targets, key=lambda one: one["range_m"], default={"range_m": 250, "range_rate_mps": 0})
        wish_mps2 = 0.1 * (nearest["range_m"] - 1.8 * ego["vx_mps"]) + 0.6 * nearest["range_rate_mps"]
        ego["vx_mps"] += 0.1 * max(-6, min(2, wish_mps2))
        for car in (ego, leader):
            car["x_m"] += 0.1 * car["vx_mps"]
        if number % 20 == 0:
            print(f"{0.1 * number:4.1f} s  {ego['vx_mps']:4.1f} m/s  {nearest['range_m']:4.1f} m")
