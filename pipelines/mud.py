"""Mud on the bumper: echoes between two azimuths (radians) never reach the sensor.

Stands between glint-ideal and glint-sensor. Frames come as JSON lines on standard input and go
to standard output; every echo taken away is accounted for in `lost`, so that nothing vanishes
without a word.
"""
import json
import sys

low, high = float(sys.argv[1]), float(sys.argv[2])


def lose(frame, echoes):
    """Group the echoes by sensor, as the frame's account wants them."""
    groups = {}
    for echo in echoes:
        entry = {key: echo[key] for key in ("object", "reflector", "path", "range_m", "azimuth_rad")}
        groups.setdefault(echo["sensor"], []).append(entry)
    frame["lost"] += [
        {"sensor": sensor, "stage": "mud", "reason": "covered", "echoes": entries}
        for sensor, entries in groups.items()
    ]


for number, line in enumerate(sys.stdin, 1):
    frame = json.loads(line)
    if "echoes" not in frame:
        print(f"mud: line {number}: echoes: missing; expected behind glint-ideal", file=sys.stderr)
        sys.exit(65)
    hidden = [echo for echo in frame["echoes"] if low <= echo["azimuth_rad"] <= high]
    frame["echoes"] = [echo for echo in frame["echoes"] if echo not in hidden]
    if "account" in frame.get("sections", []):
        lose(frame, hidden)
    print(json.dumps(frame))
