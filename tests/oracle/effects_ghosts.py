"""Mirror ghosts through the executables, against the example of MODEL 14.1 and closed forms.

Usage: python3 tests/oracle/effects_ghosts.py BIN_DIR

Exit status 1 if any check fails.
"""

import json
import math
import random
import subprocess
import sys

sys.dont_write_bytecode = True
import model  # noqa: E402
from model import ROOT, ego, everywhere, sensor, suite_of, thing  # noqa: E402

GHOSTS = ["wall_object", "object_wall", "wall_object_wall"]
DOT = {"origin": "For tests.", "length_m": 0.1, "width_m": 0.1, "height_m": 1,
       "reflectors": {"points": [everywhere("dot", 1)]}}
WALL = {"origin": "For tests.", "length_m": 40, "width_m": 0.5, "height_m": 3,
        "reflectors": {"blocks": True, "mirrors": [
            {"from_x": -0.5, "from_y": -0.5, "to_x": 0.5, "to_y": -0.5, "reflection": 0.9}]}}
FLAT = "azimuth_rad,sum,delta\n-1.57,1,-1\n1.57,1,1\n"
SENSOR = {"range_max_m": 100, "calibration_range_m": 100, "bounces": 3, "phase_reference": "centre",
          "angle_estimator": "ratio", "final_threshold": False}
APART = "all,-merging"


def example_scene():
    """The object at (30, -2) m with v = (-5, 0) m/s, and a wall at y = 4 m."""
    return model.frame([ego(), thing("o", "dot", 30, -2, velocity=(-5, 0)), thing("w", "mirror", 15, 4.25)])


def see(bench, frames, one, effects="all", noise="glint-noise-none"):
    path = bench.write_suite(suite_of(one))
    text = f"glint-extract | glint-ideal --sensors {path} --effects={effects} --account | glint-sensor | {noise}"
    data = "".join(json.dumps(frame) + "\n" for frame in frames).encode()
    done = subprocess.run([str(bench.bin / "glint"), "-c", text], input=data, env=bench.env, capture_output=True,
                          check=False)
    bench.check(done.returncode == 0, f"{text}: exit status {done.returncode}: {done.stderr.decode()}")
    return [json.loads(line) for line in done.stdout.splitlines()]


def by_path(frame):
    """Targets of one member each, by the path of that member."""
    return {target["contributors"][0]["path"]: target for target in frame["targets"]
            if len(target["contributors"]) == 1}


def flat(**changes):
    return sensor(**dict(SENSOR, antenna_pattern="table", antenna_table="flat.csv", **changes))


# ---- the checks ---------------------------------------------------------------------------------


def the_example_has_its_ghosts(bench):
    targets = by_path(see(bench, [example_scene()], flat(), APART)[0])
    bench.check(set(targets) == {"direct", *GHOSTS}, f"targets of the paths {sorted(targets)}")
    for path, distance, rate, azimuth, relative in (
            ("direct", "30.066593", "-4.988926", "-3.814075", "0.000000"),
            ("wall_object", "30.844685", "-4.866171", "-3.814075", "-1.353466"),
            ("object_wall", "30.844685", "-4.866171", "18.434949", "-1.353466"),
            ("wall_object_wall", "31.622777", "-4.743416", "18.434949", "-2.706931")):
        target = targets[path]
        bench.check_printed(target["range_m"], distance, f"{path}: range_m")
        bench.check_printed(target["range_rate_mps"], rate, f"{path}: range_rate_mps")
        bench.check_printed(math.degrees(target["azimuth_rad"]), azimuth, f"{path}: azimuth")
        bench.check_printed(target["amplitude_db"] - targets["direct"]["amplitude_db"], relative, f"{path}: amplitude")
        member = target["contributors"][0]
        bench.check((member.get("mirror"), member.get("number")) == (("w", 1) if path != "direct" else (None, None)),
                    f"{path}: {member}")
        bench.check(("ghosts" in target.get("effects", [])) == (path != "direct"), f"{path}: {target.get('effects')}")


def pattern(azimuth):
    u = math.pi / 2 * math.sin(azimuth)
    return math.sin(u) / u * math.cos(azimuth) * math.cos(u)


def one_way_each(bench):
    """Under the paper's antenna a ghost has the root of the pattern on each way, and the azimuth of the
    arrival."""
    targets = by_path(see(bench, [example_scene()], sensor(**SENSOR), APART)[0])
    law = 10 ** (6 / 20) / 0.8 * 100 ** 2
    leave, image = math.atan2(-2, 30), math.atan2(10, 30)
    ways = {"direct": (leave, leave, math.sqrt(904), 1), "wall_object": (image, leave, 0, 0.9),
            "object_wall": (leave, image, 0, 0.9), "wall_object_wall": (image, image, math.sqrt(1000), 0.81)}
    for path, (out, back, distance, reflection) in ways.items():
        square = distance ** 2 or math.sqrt(904 * 1000)
        expected = law / square * reflection * math.sqrt(pattern(out) * pattern(back))
        target = targets[path]
        bench.check(abs(target["cell_amplitude"] / expected - 1) < 1e-12,
                    f"{path}: amplitude {target['cell_amplitude']}, expected {expected}")
        bench.check(abs(target["cell_azimuth_rad"] - back) < 1e-12, f"{path}: azimuth {target['cell_azimuth_rad']}")


def resolved_ghosts(bench):
    """Both one-way paths share one cell, as no radar can tell them apart by range and rate."""
    targets = see(bench, [example_scene()], flat())[0]["targets"]
    labels = sorted(sorted(one["path"] for one in target["contributors"]) for target in targets)
    bench.check(labels == [["direct"], ["object_wall", "wall_object"], ["wall_object_wall"]], f"cells of {labels}")
    both = next(target for target in targets if len(target["contributors"]) == 2)
    bench.check(all(abs(one["weight"] - 0.5) < 1e-12 for one in both["contributors"]), f"{both}")


def bounces(bench):
    for count, paths in ((None, []), (0, []), (1, []), (2, GHOSTS[:2]), (3, GHOSTS)):
        one = flat(bounces=count) if count is not None else flat()
        if count is None:
            del one["bounces"]
        frame = see(bench, [example_scene()], one, APART)[0]
        bench.check(set(by_path(frame)) == {"direct", *paths}, f"bounces {count}: {sorted(by_path(frame))}")
        made = {path["path"]: path["echoes"] for path in frame["counts"][0]["paths"]}
        bench.check(made == {path: 1 for path in ["direct", *paths]}, f"bounces {count}: counts {made}")
        bench.check(all(one["path"] == "direct" for group in frame["lost"] for one in group["echoes"]),
                    f"bounces {count}: a ghost is lost")


def shipped_mirrors(bench):
    """A dot at (20, 0) m is mirrored in the side, at y = 4 m, of every class that mirrors: O' is (20, 8)."""
    for name, reflection in (("wall", 0.6), ("guardrail", 0.8), ("car", 0.8), ("van", 0.8), ("truck", 0.8),
                             ("bus", 0.8), ("articulated_truck", 0.8)):
        width = bench.vehicles[name]["width_m"]
        for yaw in (0, math.pi):
            scene = model.frame([ego(), thing("o", "dot", 20, 0), thing("m", name, 10, 4 + width / 2, yaw=yaw)])
            found = by_path(see(bench, [scene], flat(cell_range_m=0.01), "all,-merging,-plane_reflection")[0])
            bench.check(set(GHOSTS) <= set(found), f"{name}: {sorted(found)}")
            ghost = found["wall_object_wall"]
            bench.check(abs(ghost["cell_range_m"] - math.hypot(20, 8)) < 1e-9, f"{name}: {ghost['cell_range_m']}")
            bench.check(abs(ghost["contributors"][0]["ercs"] - reflection ** 2) < 1e-12, f"{name}: {ghost}")


# ---- the choice of effects ----------------------------------------------------------------------


def full_sensor():
    one = json.loads((ROOT / "data/sensors/lrr77-full.json").read_text())["sensors"][0]
    one["antenna_table"] = str(ROOT / "data/antennas/lrr77.csv")
    return one


def street(draw):
    """A scene of cars, people and posts between walls and guardrails that are not quite parallel."""
    things = [thing(f"wall{i}", draw.choice(["wall", "guardrail", "mirror"]), draw.uniform(-10, 60),
                    draw.choice([-1, 1]) * draw.uniform(4, 12), draw.gauss(0, 0.1) + draw.choice([0, math.pi]),
                    length=draw.uniform(5, 80)) for i in range(3)]
    things += [thing(f"car{i}", draw.choice(["car", "truck", "pedestrian", "dot", "post"]), draw.uniform(4, 80),
                     draw.uniform(-10, 10), draw.uniform(-3, 3), (draw.uniform(-20, 20), draw.uniform(-2, 2)),
                     draw.uniform(-0.3, 0.3)) for i in range(5)]
    return model.frame([ego(velocity=(15, 0)), *things])


def scenes(bench):
    draw = random.Random(7)
    yield "random streets", [dict(street(draw), scene=f"s{i}") for i in range(200)], flat()
    walled = bench.stage(["glint-traffic", str(ROOT / "data/scenarios/walled-road.json")], "")
    yield "walled-road", [json.loads(line) for line in walled.splitlines()], full_sensor()


def stripped(frames):
    for frame in frames:
        frame["sensors"].pop("effects")
        frame["sensors"].pop("digest")
    return frames


def auto_is_all(bench):
    for name, frames, one in scenes(bench):
        every = stripped(see(bench, frames, one, "all", "glint-noise"))
        ghosts = sum(len(group["paths"]) - 1 for frame in every for group in frame["counts"])
        bench.check(ghosts > 100, f"{name}: only {ghosts} kinds of ghosts")
        bench.check(stripped(see(bench, frames, one, "auto", "glint-noise")) == every, f"{name}: auto and all differ")


def switched_off(bench):
    """Without the effect the list is that of a sensor without bounces."""
    for name, frames, one in scenes(bench):
        without = stripped(see(bench, frames, one, "all,-ghosts"))
        plain = stripped(see(bench, frames, {key: one[key] for key in one if key != "bounces"}))
        bench.check(without == plain, f"{name}: without ghosts, and without bounces")
        marked = [target for frame in without for target in frame["targets"] if "ghosts" in target.get("effects", [])]
        bench.check(not marked, f"{name}: switched off, {len(marked)} targets have ghosts")


CHECKS = [
    ("the example of MODEL 14.1 has its ghosts, told apart by their paths", the_example_has_its_ghosts),
    ("the antenna counts one way each", one_way_each),
    ("both one-way ghosts share a cell", resolved_ghosts),
    ("a sensor sees as many bounces as it says", bounces),
    ("walls, guardrails and vehicles mirror with both sides", shipped_mirrors),
    ("auto leaves out no ghost", auto_is_all),
    ("switched off, ghosts leave no trace", switched_off),
]


def prepare(bench):
    model.add_shipped_vehicles(bench)
    bench.add_vehicle("dot", DOT)
    bench.add_vehicle("mirror", WALL)
    (bench.scratch / "flat.csv").write_text(FLAT)


if __name__ == "__main__":
    model.run(__doc__, prepare, CHECKS)
