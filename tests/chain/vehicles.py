"""Vehicles of data/detailed/ tell where their figures come from, and are seen under.

Usage: python3 tests/chain/vehicles.py BIN_DIR        exit status 1 if any check fails
"""
import fnmatch
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
ROOT = Path(__file__).resolve().parent.parent.parent
BIN = Path(sys.argv[1]).resolve() if len(sys.argv) == 2 else sys.exit(__doc__)
ENV = dict(os.environ, GLINT_DATA=str(ROOT / "data" / "detailed"))
failed = []


def check(good, message):
    if not good:
        failed.append(message)


def figures(document, path=""):
    """{path: number} of a document; a member of a list has its name for a path."""
    if isinstance(document, dict):
        of = {f"{path}.{key}" if path else key: value for key, value in document.items() if key != "reflectors"}
        of |= document.get("reflectors", {})
    elif isinstance(document, list):
        of = {one.get("name", path): one for one in document}
    else:
        return {path: document} if isinstance(document, (int, float)) and not isinstance(document, bool) else {}
    return {name: value for key, part in of.items() for name, value in figures(part, key).items()}


def source_of(path, sources):
    """The first text whose key has a pattern for a figure."""
    return next((text for key, text in sources.items() if any(fnmatch.fnmatch(path, one) for one in key.split(", "))), None)


def every_figure_has_two_sources_or_is_assumed():
    for place in sorted((ROOT / "data" / "detailed" / "vehicles").glob("*.json")):
        document = json.loads(place.read_text())
        paper = figures(json.loads((ROOT / "data" / "vehicles" / place.name).read_text()))
        sources, own = document["sources"], {path: value for path, value in figures(document).items()
                                             if paper.get(path) != value}
        check(len(own) > 10 and sources["others"].startswith("[A]"), f"{place.name}: {len(own)} figures of its own")
        for path in own:
            text = source_of(path, sources) or ""
            check(text.startswith("[A]") or text.startswith("[F]") and ";" in text, f"{place.name}: {path}: {text or 'no source'}")


def loss_behind_a_van_db(begin_m):
    """What the rear corner of a car, 40 m away, loses behind a van that begins here; the sensor is 0.5 m above the road."""
    def echo(effects):
        objects = [{"id": "ego", "class": "car", "x_m": -2.25, "length_m": 4.3, "width_m": 1.8, "height_m": 1.5},
                   {"id": "car", "class": "car", "x_m": 42.15, "length_m": 4.3, "width_m": 1.8, "height_m": 1.5},
                   {"id": "van", "class": "van", "x_m": begin_m + 3.25, "length_m": 6.5, "width_m": 2.16, "height_m": 2.86}]
        rest = {"y_m": 0, "yaw_rad": 0, "vx_mps": 0, "vy_mps": 0, "yaw_rate_radps": 0, "travelled_m": 0}
        frame = {"version": 0, "scene": "van", "frame": 0, "time_s": 0, "interval_s": 0.1, "seed": "1", "ego": "ego",
                 "last": True, "objects": [rest | one for one in objects]}
        with tempfile.TemporaryDirectory() as folder:
            scene = Path(folder, "scene.jsonl")
            scene.write_text(json.dumps(frame) + "\n")
            done = subprocess.run([BIN / "glint", "-c", f"glint-extract {scene} | glint-ideal --sensors lrr77-full --effects "
                                   f"{effects}"], env=ENV, check=True, stdout=subprocess.PIPE)
        return next((one["ercs"] for one in json.loads(done.stdout)["echoes"]
                     if (one["object"], one["reflector"]) == ("car", "corner_rr")), None)

    behind, free = echo("auto"), echo("auto,-occlusion")
    check(echo("auto,-height") is None, "a van that nobody sees under or over hides the car")
    return -20 * math.log10(behind / free)


def a_car_behind_a_van_is_seen_under_it():
    """Between both ends of the van where MODEL 14.3 has 14.23 and 10.95 dB, and where it has 9.92 and 13.19."""
    for begin_m in 12.3, 12.9, 21.2, 21.9:
        loss_db = loss_behind_a_van_db(begin_m)
        check(9.9 <= loss_db <= 14.2, f"behind a van at {begin_m} m: {loss_db:.2f} dB")


every_figure_has_two_sources_or_is_assumed()
a_car_behind_a_van_is_seen_under_it()
for message in failed:
    print("FAILED:", message)
print(f"vehicles: {'failed' if failed else 'figures have sources, and a car is seen under a van'}")
sys.exit(1 if failed else 0)
