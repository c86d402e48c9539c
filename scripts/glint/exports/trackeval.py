"""Writes the text of the MOTChallenge, which TrackEval and py-motmetrics read: a square for each object and each track."""
import json
import math
import os
import re

import glint

SET = "MOT15-train"
# Two equal squares that are d apart along an axis, of the side s, have the overlap (s - d) / (s + d) over their union. That is
# one half, from which on both programs pair them, where s is 3 d.
SIDES = 3
STRUCTURES = "guardrail", "post", "wall"  # no tracker is expected to have what stands beside the road

SENSOR = {"range_max_m": glint.number(0, 1e6), "field_of_view_rad": glint.number(0, math.tau)}


def sees(frame, sensor, one):
    """Is the middle of an object in the range and field of view of a sensor?"""
    if wrong := glint.fault(sensor, SENSOR):
        raise glint.BadFrame(f"{glint.place_of(frame)}: sensors.list: {sensor['name']}{wrong}")
    carrier = glint.ego(frame)
    x, y = glint.turned(sensor["mount_x_m"], sensor["mount_y_m"], carrier["yaw_rad"])
    x, y = one["x_m"] - carrier["x_m"] - x, one["y_m"] - carrier["y_m"] - y
    azimuth_rad = math.remainder(math.atan2(y, x) - carrier["yaw_rad"] - sensor["mount_yaw_rad"], math.tau)
    return math.hypot(x, y) <= sensor["range_max_m"] and abs(azimuth_rad) <= sensor["field_of_view_rad"] / 2


def truth_of(frame, which):
    """The objects that count, as by --objects of glint-score-tracks."""
    others = [one for one in frame["objects"] if one["id"] != frame["ego"] and one["class"] not in STRUCTURES]
    if which == "in_view":
        return [one for one in others if any(sees(frame, sensor, one) for sensor in frame["sensors"]["list"])]
    detected = {glint.owner(part) for target in frame["targets"] for part in target["contributors"]}
    return [one for one in others if which == "all" or one["id"] in detected]


def told(frames, path):
    """Frames, each with the tracks that a file of another tracker has for it."""
    with open(path, encoding="utf-8") as file:
        for number, frame in enumerate(frames, 1):
            try:
                line = json.loads(file.readline())
                if (line["scene"], line["frame"]) != (frame["scene"], frame["frame"]):
                    raise ValueError(f"frame {line['frame']} of {line['scene']!r}")
                x, y = frame.get("origin_x_m", 0), frame.get("origin_y_m", 0)
                yield frame, [(one["id"], one["x_m"] + x, one["y_m"] + y) for one in line["tracks"]]
            except (KeyError, TypeError, ValueError) as error:
                raise glint.BadFrame(f"{path}:{number}: {error!r}; expected the tracks of {glint.place_of(frame)}") from None


class Sequence:
    """A scene, whose frames count from 1. Ids of objects and tracks become numbers from 1, as TrackEval wants them small."""

    def __init__(self, folder, name, tracker, side_m):
        self.name, self.side_m, self.frames, self.numbers = name, side_m, 0, ({}, {})
        self.info = os.path.join(folder, "gt", SET, name, "seqinfo.ini")
        self.paths = (os.path.join(folder, "gt", SET, name, "gt", "gt.txt"),
                      os.path.join(folder, "trackers", SET, tracker, "data", f"{name}.txt"))
        for path in self.paths:
            os.makedirs(os.path.dirname(path), exist_ok=True)
        self.lines = [], []

    def add(self, truth, tracks):
        self.frames += 1
        for ones, numbers, lines in zip((truth, tracks), self.numbers, self.lines):
            for name, x, y in ones:
                number = numbers.setdefault(name, len(numbers) + 1)
                left, top = x - self.side_m / 2, y - self.side_m / 2
                lines.append(f"{self.frames},{number},{left:.3f},{top:.3f},{self.side_m:g},{self.side_m:g},1,1,1\n")

    def write(self):
        for path, lines in zip(self.paths, self.lines):
            with open(path, "w", encoding="utf-8") as file:
                file.writelines(lines)
        with open(self.info, "w", encoding="utf-8") as file:
            file.write(f"[Sequence]\nname={self.name}\nseqLength={self.frames}\n")


def write(folder, joined, which, gate_m, tracker="tracker"):
    """Writes gt/ and trackers/. joined: frames, each with its tracks, (id, x, y, ...) in the world."""
    scenes = {}
    for frame, tracks in joined:
        scene = frame["scene"], frame["seed"]
        if scene not in scenes:
            name = f"{len(scenes) + 1:04}-{re.sub('[^A-Za-z0-9-]+', '_', frame['scene'])[:99]}"
            scenes[scene] = Sequence(folder, name, tracker, SIDES * gate_m)
        x, y = frame.get("origin_x_m", 0), frame.get("origin_y_m", 0)
        truth = [(one["id"], one["x_m"] + x, one["y_m"] + y) for one in truth_of(frame, which)]
        scenes[scene].add(truth, [one[:3] for one in tracks])
    os.makedirs(os.path.join(folder, "gt", "seqmaps"))
    with open(os.path.join(folder, "gt", "seqmaps", f"{SET}.txt"), "w", encoding="utf-8") as file:
        file.writelines(["name\n", *(f"{one.name}\n" for one in scenes.values())])
    for one in scenes.values():
        one.write()
