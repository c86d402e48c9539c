"""The scenes that scripts/bench runs: documents written to build/bench, the same everywhere.

A scene has 2, 20, 100 or 1,000 objects beside the ego. The highway of 20 is highway-straight without its
guardrails, the intersection of 20 a crossing of four arms; larger scenes are copies of these side by side and
one after the other, so that the density stays the same and the scene grows. These are the scenes "highway"
and "intersection". A radar reaches 250 m and four corner radars 100 m, so what they have in view grows less
than the scene. In "in-view" and "unhidden" everything is in view whatever the number: a radar with 120
degrees and 3 km of reach looks at a highway that lies ahead. In "in-view" vehicles hide each other, the more
so the more they are; "unhidden" has the same places with motorcycles, which hide nothing.
"""
import json
import math
import os

FOLDER = os.path.join("build", "bench")
COUNTS = [2, 20, 100, 1000]
SUITES = {1: "lrr77-every-frame", 4: "corner77-four"}
DURATION_S = {"highway": 10, "intersection": 4, "in-view": 10, "unhidden": 10, "platoon": 100}
SCAN_S = 0.08  # in a shorter frame not all of these radars scan: their cycles take 0.06 and 0.072 s

NORTH, WEST, SOUTH = math.pi / 2, math.pi, -math.pi / 2
# Class, x, y, yaw, speed: on the road across everyone drives, on the other everyone waits.
CROSSING = [
    ("van", 0, -1.75, 0, 10), ("car", 12, 1.75, WEST, 10),
    ("car", 24, -1.75, 0, 10), ("truck", 45, -1.75, 0, 10), ("car", -48, -1.75, 0, 10),
    ("car", -40, 1.75, WEST, 10), ("bus", -12, 1.75, WEST, 10),
    ("motorcycle", 30, 1.75, WEST, 10), ("car", 45, 1.75, WEST, 10),
    ("car", 1.75, -12, NORTH, 0), ("van", 1.75, -20, NORTH, 0),
    ("truck", 1.75, -29, NORTH, 0), ("car", 1.75, -39, NORTH, 0),
    ("car", -1.75, 12, SOUTH, 0), ("car", -1.75, 19, SOUTH, 0),
    ("articulated_truck", -1.75, 34, SOUTH, 0),
    ("bicycle", -20, -4.5, 0, 4.5), ("bicycle", 18, 4.5, WEST, 4.5),
    ("pedestrian", 7, -12, SOUTH, 1.4), ("pedestrian", -7, 12, NORTH, 1.4),
]


def actor(name, kind, x, y, yaw, speed, segments=()):
    document = {"id": name, "class": kind, "x_m": x, "y_m": y, "yaw_rad": yaw, "speed_mps": speed}
    return document | ({"segments": list(segments)} if segments else {})


def crossing():
    ego = actor("ego", "car", -25, -1.75, 0, 10)
    return ego, [actor(f"u{i:02}", *user) for i, user in enumerate(CROSSING)]


def highway():
    """The ego and the 20 vehicles; the two of the scene of two come first."""
    with open("data/scenarios/highway-straight.json") as file:
        ego, *others = json.load(file)["objects"]
    others = [other for other in others if other["class"] != "guardrail"]
    return ego, sorted(others, key=lambda other: other["id"] not in ("middle_3", "right_4"))


def copies(count, block, tile_m, ahead):
    """The block repeated at as many places of a grid as it takes: around the ego, or all ahead of it."""
    places = [(i, j) for i in range(0 if ahead else -8, 9) for j in range(-8, 9)]
    places.sort(key=lambda place: (max(map(abs, place)), -place[0], abs(place[1]), place[1]))
    objects = []
    for number, (i, j) in enumerate(places[:math.ceil(count / len(block))]):
        for other in block:
            name = f"{other['id']}_{number}" if number > 0 else other["id"]
            objects.append(other | {"id": name,
                                    "x_m": round(other["x_m"] + i * tile_m[0], 6),
                                    "y_m": round(other["y_m"] + j * tile_m[1], 6)})
    return objects[:count]


def objects_of(kind, count):
    if kind == "intersection":
        ego, block = crossing()
        return [ego] + copies(count, block, (120, 120), False)
    ego, block = highway()
    if kind == "platoon":
        block = [{key: other[key] for key in ("id", "class", "x_m", "y_m")} | {"speed_mps": 30}
                 for other in block]
    if kind in ("in-view", "unhidden"):
        block = [other | {"x_m": other["x_m"] + 200} for other in block]
    if kind == "unhidden":
        block = [other | {"class": "motorcycle"} for other in block]
    return [ego] + copies(count, block, (300, 15), kind in ("in-view", "unhidden"))


def write(name, document):
    """Writes a file to build/bench, whole or not at all; returns its path."""
    os.makedirs(FOLDER, exist_ok=True)
    path = os.path.join(FOLDER, name + ".json")
    with open(f"{path}.{os.getpid()}", "w") as out:
        json.dump(document, out, indent=1)
    os.replace(out.name, path)
    return path


def write_scene(kind, count, frames):
    """Writes a scenario with this many frames, spread evenly over its time; returns its path."""
    duration_s = DURATION_S[kind]
    return write(f"{kind}-{count}-{frames}", {
        "origin": "Made by tests/speed/scenes.py.", "ego": "ego",
        "rate_hz": max(frames - 1, 1) / duration_s, "duration_s": duration_s if frames > 1 else 0,
        "objects": objects_of(kind, count)})


def source(kind, count, frames):
    """glint-traffic for this many frames, in equal scenes so short that every radar scans in each frame."""
    most = int(DURATION_S[kind] / SCAN_S) + 1
    scenes = next(number for number in range(1, frames + 1) if frames % number == 0 and frames // number <= most)
    return f"glint-traffic {write_scene(kind, count, frames // scenes)}" + (f" --scenes 0:{scenes}" if scenes > 1 else "")


def suite_of(kind, sensors):
    """A name in data/sensors/, or the path of the suite that sees all that is ahead."""
    if kind not in ("in-view", "unhidden"):
        return SUITES[sensors]
    with open("data/sensors/lrr77-every-frame.json") as file:
        sensor = json.load(file)["sensors"][0]
    sensor |= {"range_max_m": 3000, "calibration_range_m": 3000, "list_limit": 100000,
               "field_of_view_rad": 2 * math.pi / 3,
               "antenna_table": "../../data/antennas/corner77.csv"}
    del sensor["sources"]
    return write("all-ahead", {"origin": "Made by tests/speed/scenes.py.", "sensors": [sensor]})


def ten_radars():
    """The path of a suite of ten corner radars that look all around."""
    with open("data/sensors/corner77-every-frame.json", encoding="utf-8") as file:
        sensor = json.load(file)["sensors"][0] | {"antenna_table": "../../data/antennas/corner77.csv"}
    del sensor["sources"]
    angles = [math.remainder(2 * math.pi * i / 10, 2 * math.pi) for i in range(10)]
    return write("ten-radars", {"origin": "Made by tests/speed/scenes.py.", "sensors": [
        sensor | {"name": f"radar_{i}", "mount_yaw_rad": angle, "mount_x_m": 2.25 * math.cos(angle), "mount_y_m": 0.9 * math.sin(angle)}
        for i, angle in enumerate(angles)]})


def write_drawn():
    """Writes the highway of 20 vehicles, each of them at a speed that is drawn, as scenes of one frame; returns its path."""
    objects = [one | {"speed_mps": {"uniform": [20, 30]}} for one in objects_of("highway", 20)]
    return write("drawn-highway-20", {"origin": "Made by tests/speed/scenes.py.", "ego": "ego", "rate_hz": 1,
                                      "duration_s": 0, "objects": objects})


# What the paper does not have, of all that a full suite describes.
BEYOND_PAPER = ("latency", "curvature", "elevation", "height", "diffraction", "ghosts", "wheels", "limbs", "clutter", "two_ray",
                "fluctuation", "rain", "fog", "snow", "range_migration", "interference", "coherence", "accuracy", "misalignment",
                "false_alarms", "quantisation")
WORDS = {"account": " --sections account", "full, all": " --effects all",
         "paper": " --effects auto," + ",".join("-" + name for name in BEYOND_PAPER)}
FULL = ("full", "full, all", "paper")


def commands(kind, count, sensors, frames, labels):
    """The five stages of the chain. labels: "default", "account", or of a full suite "paper", "full" and "full, all"."""
    words = WORDS.get(labels, "")
    suite = "lrr77-full" if labels in FULL else suite_of(kind, sensors)
    again = f" --sensors {suite}" if "/" in suite else ""
    return [source(kind, count, frames), "glint-extract",
            f"glint-ideal --sensors {suite}{words}", f"glint-sensor{again}", f"glint-noise{again}"]
