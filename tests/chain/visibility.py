"""The section visibility against the account and the labels of the same frames, and against a closed form.

Usage: python3 tests/chain/visibility.py BIN_DIR        exit status 1 if any check fails

Of every sensor and object, reflectors in range, in view and blocked are counted in `lost` and among the echoes;
detections, merged ones and ghosts in the labels. A wall that hides a known part of a body's side must hide the same
part of scatterers at equal distances along it, to one scatterer.
"""
import collections
import json
import os
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import recorded  # noqa: E402
from recorded import BIN, ENV, ROOT, check  # noqa: E402
import glint  # noqa: E402

SILENT = {"facing_away", "no_specular_point", "switched_off"}
LEVELS = ((0.4, "v0-40"), (0.6, "v40-60"), (0.8, "v60-80"), (2, "v80-100"))
SHOWING = {"direct", "wheel", "limb"}
COUNTS = ("reflectors", "in_range", "in_view", "detections", "merged", "ghosts")
RIGHT_ANGLE = 1.5707963267948966


def run(text, data=None):
    done = subprocess.run([BIN + "/glint", "-c", text], env=ENV, cwd=ROOT, input=data, capture_output=True, text=True,
                          check=False)
    check(done.returncode == 0, f"{text}: {done.stderr}")
    return [glint.name_lost(json.loads(line)) for line in done.stdout.splitlines()]


def level_of(share):
    return next(name for end, name in LEVELS if share < end)


def from_account(frame):
    """{(sensor, object): counts}, of the reflectors by what became of them."""
    counts = collections.defaultdict(collections.Counter)
    echoes = [(one["sensor"], one["object"]) for one in frame["echoes"] if one["path"] == "direct"]
    for key in echoes:
        counts[key].update(("reflectors", "in_range", "in_view"))
    for group in frame["lost"]:
        for one in group["echoes"] if group["stage"] == "ideal" else []:
            reason, count = group["reason"], counts[group["sensor"], one["object"]]
            count["reflectors"] += 1
            count["in_range"] += reason not in SILENT | {"out_of_range"}
            count["in_view"] += reason not in SILENT | {"out_of_range", "out_of_view"}
            count["blocked"] += reason == "blocked"
    for target in frame["targets"]:
        parts = target["contributors"]
        several = len({part["object"] for part in parts}) > 1
        for name in {part["object"] for part in parts if part["path"] in SHOWING}:
            counts[target["sensor"], name].update(["detections", "merged"] if several else ["detections"])
        for name in {part["object"] for part in parts if "mirror" in part}:
            counts[target["sensor"], name]["ghosts"] += 1
    return counts


def compare(frame, seen):
    """seen counts what the frames have, so that nothing is held that never happens."""
    counts = from_account(frame)
    measured = [one["name"] for one in frame["sensors"]["list"] if one["measured"]]
    bodies = [one["id"] for one in frame["objects"] if one["id"] != frame["ego"]]
    keys = [(one["sensor"], one["object"]) for one in frame["visibility"]]
    check(keys == sorted((sensor, body) for sensor in measured for body in bodies), "a sighting of every object")
    for one in frame["visibility"]:
        due = counts[one["sensor"], one["object"]]
        where = f"{frame['scene']}, frame {frame['frame']}, {one['sensor']}, {one['object']}"
        found = {name: one.get(name, 0) for name in COUNTS}
        check(found == {name: due[name] for name in COUNTS}, f"{where}: {found}, expected {dict(due)}")
        blocked = due["blocked"] / due["in_view"] if due["in_view"] else 0
        level = level_of((due["in_view"] - due["blocked"]) / due["in_view"]) if due["in_view"] else None
        check(one.get("blocked_share", 0) == blocked and one.get("visibility") == level, f"{where}: {one}")
        seen.update({name: found[name] > 0 for name in COUNTS})
        seen[level] += 1


def count_in_the_account():
    seen = collections.Counter()
    for source, suite in (("glint-traffic intersection", "srr24-pair"), ("glint-traffic walled-road", "lrr77-full"),
                          ("glint-traffic-random --density dense --frames 60", "corner77-every-frame"),
                          ("glint-traffic-random --density medium --draw-conditions --frames 60", "lrr77-full")):
        for frame in run(f"{source} --sections visibility,account,echoes | glint-extract"
                         f" | glint-ideal --sensors {suite} | glint-sensor | glint-noise"):
            compare(frame, seen)
    rare = [name for name in (*COUNTS, None, *(name for _, name in LEVELS)) if seen[name] < 10]
    check(not rare, f"the scenes have no {rare}: {seen}")


def change_nothing_else():
    chain = "glint-extract | glint-ideal --sensors lrr77-full{} | glint-sensor{} | glint-noise"
    for source in ("glint-traffic walled-road", "glint-traffic-random --density dense --frames 40"):
        plain = run(f"{source} | " + chain.format("", ""))
        with_it = run(f"{source} | " + chain.format(" --sections visibility", ""))
        dropped = run(f"{source} | " + chain.format(" --sections visibility", " --sections=-visibility"))
        check(all("visibility" in frame for frame in with_it), "a section in every frame")
        for frame in with_it:
            del frame["sections"], frame["visibility"]
        check(with_it == plain and dropped == plain, f"{source}: another frame with visibility")


def thing(name, kind, x, y, length, width, yaw=0.0):
    return {"id": name, "class": kind, "x_m": x, "y_m": y, "yaw_rad": yaw, "vx_mps": 0, "vy_mps": 0,
            "yaw_rate_radps": 0, "length_m": length, "width_m": width, "height_m": 0, "travelled_m": 0}


def hide_half_a_body():
    """A truck stands across the road, its near side 30 m away, 4 m of it to either side of boresight. A wall at
    15 m reaches from the far right to the line of sight of a place along that side."""
    spacing, near_m, wall_m = 0.1, 30.0, 15.0
    levels = set()
    for tenth in range(1, 10):
        edge_y = (-4 + 8 * tenth / 10) * wall_m / near_m
        objects = [thing("ego", "car", -2.25, 0, 4.5, 2), thing("across", "truck", near_m + 1.25, 0, 8, 2.5, RIGHT_ANGLE),
                   thing("screen", "wall", wall_m + 0.05, edge_y - 10, 20, 0.1, RIGHT_ANGLE)]
        frame = {"version": 1, "scene": "half", "frame": 0, "time_s": 0.1, "interval_s": 0.1, "seed": "1",
                 "ego": "ego", "objects": objects, "sections": ["objects", "visibility"]}
        out = run(f"glint-extract-contour --spacing-m {spacing} | glint-ideal --sensors lrr77-every-frame",
                  json.dumps(frame) + "\n")
        one, = [one for one in out[0]["visibility"] if one["object"] == "across"]
        scatterers = one["in_view"]
        check(scatterers > 60, f"scatterers of the near side: {one}")
        share = one.get("blocked_share", 0)
        check(abs(share - tenth / 10) <= 3 / scatterers, f"{tenth} tenths of the side are hidden: {one}")
        check(one["visibility"] == level_of(1 - share), f"{one}")
        levels.add(one["visibility"])
    check(len(levels) == 4, f"levels: {levels}")


count_in_the_account()
change_nothing_else()
hide_half_a_body()
print(f"visibility: {recorded.checks} checks, 0 failed")
