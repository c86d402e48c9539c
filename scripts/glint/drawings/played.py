"""What pictures show: frames that glint makes of shipped scenes and of our own, and places as the observer sees them."""
import json
import math
import os
import shutil
import subprocess

import glint
from glint.places import DATA, GLINT
from glint.sets.plan import read_json


class Bench:
    """A folder with glint's data and documents of our own, where pipelines run."""

    def __init__(self, folder):
        self.folder = folder
        for kind in ("vehicles", "sensors", "scenarios", "antennas"):
            shutil.copytree(os.path.join(DATA, kind), os.path.join(folder, kind))
        # The suite "probe": one sensor of the paper's in the middle of a standing observer.
        sensor = read_json(self.path("sensors", "srr24-pair"))["sensors"][0]
        sensor.update(name="probe", mount_x_m=0, mount_y_m=0)
        sensor.pop("cycle_s")  # a scan in every frame
        self.write("sensors", "probe", {"origin": "scripts/figures", "sensors": [sensor]})

    def path(self, kind, name):
        return os.path.join(self.folder, kind, name + ".json")

    def write(self, kind, name, document):
        with open(self.path(kind, name), "w", encoding="utf-8") as out:
            json.dump(document, out)

    def write_point(self, name, ercs):
        """A class of objects that are one point, seen alike from everywhere."""
        point = {"name": "point", "x": 0, "y": 0, "facing_rad": 0, "full_rad": math.pi,
                 "zero_rad": math.pi, "shape": "hard", "ercs": ercs}
        self.write("vehicles", name, {
            "origin": "scripts/figures", "length_m": 0.1, "width_m": 0.1, "height_m": 1,
            "reflectors": {"blocks": False, "points": [point]}})

    def run(self, pipeline, frames=None):
        """The frames that a pipeline writes; it reads frames.jsonl if frames are given."""
        if frames is not None:
            with open(os.path.join(self.folder, "frames.jsonl"), "w", encoding="utf-8") as out:
                out.writelines(json.dumps(frame) + "\n" for frame in frames)
        lines = subprocess.check_output([GLINT, "-c", pipeline], cwd=self.folder, env={**os.environ, "GLINT_DATA": self.folder})
        return [glint.name_lost(json.loads(line)) for line in lines.splitlines()]

    def still(self, scenario, time_s, sensor="glint-sensor", noise="glint-noise"):
        """The frame of a scenario nearest to a time, with its target list."""
        frames = self.run(f"glint-traffic {scenario} | glint-extract"
                          f" | glint-ideal --sensors srr24-pair --sections account | {sensor} | {noise}")
        return min(frames, key=lambda frame: abs(frame["time_s"] - time_s))


def thing(name, kind, x_m, y_m, yaw_rad=0.0, size=(0, 0)):
    """An object that stands still."""
    return {"id": name, "class": kind, "x_m": x_m, "y_m": y_m, "yaw_rad": yaw_rad, "vx_mps": 0,
            "vy_mps": 0, "yaw_rate_radps": 0, "length_m": size[0], "width_m": size[1],
            "height_m": 0, "travelled_m": 0}


def make_frame(number, objects):
    return {"version": glint.VERSION, "scene": "figures", "frame": number, "time_s": number * 0.04,
            "interval_s": 0.04, "seed": "1", "ego": "ego", "objects": objects}


def at_point(number, kind, range_m, azimuth_rad):
    """A frame with one object at a place before the probe."""
    return make_frame(number, [thing("ego", "car", 0, 0),
                               thing("point", kind, range_m * math.cos(azimuth_rad),
                                     range_m * math.sin(azimuth_rad))])


def as_measured(frame):
    """The frame at the instant at which its one sensor measured."""
    sensor, = frame["sensors"]["list"]
    objects = [glint.earlier(one, sensor.get("age_s", 0)) for one in frame["objects"]]
    return frame | {"objects": objects, "sensors": {"list": [sensor | {"age_s": 0}]}}


class View:
    """Places as the observer sees them: metres ahead of its front bumper, and to its left. Sensors are where they
    measured."""

    def __init__(self, frame):
        self.ego = next(o for o in frame["objects"] if o["id"] == frame["ego"])
        self.bumper_m = self.ego["length_m"] / 2
        self.sensors = {s["name"]: s for s in frame["sensors"]["list"]}

    def world(self, x_m, y_m):
        ahead, left = glint.turned(x_m - self.ego["x_m"], y_m - self.ego["y_m"], -self.ego["yaw_rad"])
        return ahead - self.bumper_m, left

    def carrier(self, name):
        """The ego when the sensor measured."""
        return glint.earlier(self.ego, self.sensors[name].get("age_s", 0))

    def mount(self, name):
        sensor, carrier = self.sensors[name], self.carrier(name)
        x_m, y_m = glint.turned(sensor["mount_x_m"], sensor["mount_y_m"], carrier["yaw_rad"])
        return self.world(carrier["x_m"] + x_m, carrier["y_m"] + y_m)

    def polar(self, name, range_m, azimuth_rad):
        x_m, y_m = self.mount(name)
        turned = self.carrier(name)["yaw_rad"] - self.ego["yaw_rad"]
        bearing = azimuth_rad + self.sensors[name]["mount_yaw_rad"] + turned
        return x_m + range_m * math.cos(bearing), y_m + range_m * math.sin(bearing)

    def reading(self, target):
        return self.polar(target["sensor"], target["range_m"], target["azimuth_rad"])

    def speed_line(self, target, way_s):
        """The way in a time: away from the sensor if the target recedes, else towards it."""
        far = target["range_m"] + way_s * target["range_rate_mps"]
        return [self.reading(target), self.polar(target["sensor"], far, target["azimuth_rad"])]

    def contour(self, item):
        return [self.world(*corner) for corner in outline(item)]


def outline(item):
    """The corners of an object's box in the world, the first again at the end."""
    for along, across in ((1, 1), (-1, 1), (-1, -1), (1, -1), (1, 1)):
        x_m, y_m = glint.turned(along * item["length_m"] / 2, across * item["width_m"] / 2, item["yaw_rad"])
        yield item["x_m"] + x_m, item["y_m"] + y_m
