#!/usr/bin/env python3
"""Prints each target of a list with the echoes that made it. glint pipelines/two-vehicles.sh | python3 pipelines/labels.py"""
import fileinput
import json
import math
import signal

signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # a reader such as head may have enough

for line in fileinput.input(encoding="utf-8"):
    frame = json.loads(line)
    print(f"{frame['time_s']:.2f} s")
    for target in frame["targets"]:
        echoes = sorted(target["contributors"], key=lambda echo: -echo["weight"])
        made_of = ", ".join(f"{100 * echo['weight']:.0f} % {echo['object']} {echo['reflector']}" for echo in echoes)
        print(f"{target['sensor']:>5} {target['range_m']:6.2f} m {math.degrees(target['azimuth_rad']):5.1f} deg"
              f" {target['range_rate_mps']:5.2f} m/s  {made_of}")
