"""Mirror ghosts through the executables, against the example of MODEL 14.1 and closed forms.

Usage: python3 tests/oracle/effects_ghosts.py BIN_DIR

Exit status 1 if any check fails.
"""

import itertools
import math
import random
import sys

sys.dont_write_bytecode = True
import model  # noqa: E402
from model import ROOT, ego, everywhere, full_sensor, sensor, stripped, suite_of, thing  # noqa: E402
from oracle_effects import permittivity, surface_part  # noqa: E402

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
    text = f"glint-extract | glint-ideal --sensors {path} --effects={effects} --sections account | glint-sensor | {noise}"
    return model.parsed(bench.fused(text, frames))


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


def mirrored(bench, mirror, one, turn_deg=0.0, paths=GHOSTS):
    """The ghosts, by path, of a dot whose wave meets the mirror 10 m away at that angle of incidence, and the
    length of its way there."""
    side = dict(from_x=-0.5, from_y=-0.5, to_x=0.5, to_y=-0.5, **mirror)
    bench.add_vehicle("sheet", dict(WALL, reflectors={"blocks": True, "mirrors": [side]}))
    angle = math.radians(turn_deg)
    ahead, aside = 5 * math.tan(angle), 5.0
    things = [thing("o", "dot", 2.2 * ahead + 1e-9, aside - 1.2 * aside),
              thing("m", "sheet", ahead, aside + 0.05, length=100, width=0.1)]
    found = by_path(see(bench, [model.frame([ego(), *things])], one, APART)[0])
    bench.check(set(paths) <= set(found), f"{mirror}, {turn_deg} degrees: {sorted(found)}")
    return found, 2.2 * aside / math.cos(angle)


def materials(bench):
    """Walls mirror as ITU-R P.2040-3 and Fresnel say. Figures of smooth concrete, 5.24 without loss, stand beside."""
    for carrier_hz, field, material, turn_deg in itertools.product(
            (24.125e9, 77e9), ("vertical", "horizontal"), ("concrete", "brick", "glass", "metal"),
            (20, 40, 60, 75, 82, 85)):
        one = flat(carrier_hz=carrier_hz, polarization=field, range_max_m=300, calibration_range_m=3000)
        found, _ = mirrored(bench, {"material": material}, one, turn_deg)
        part = math.sqrt(found["wall_object_wall"]["contributors"][0]["ercs"])
        cosine = math.cos(math.radians(turn_deg))
        expected = surface_part(permittivity(material, carrier_hz), cosine, field == "vertical")
        what = f"{material}, {carrier_hz / 1e9:g} GHz, {field}, {turn_deg} degrees"
        bench.check(abs(part - expected) < 1e-9, f"{what}: {part}, expected {expected}")
        printed = {("vertical", 60): 0.618, ("horizontal", 60): 0.106, ("vertical", 82): 0.874}.get((field, turn_deg))
        if material == "concrete" and printed:
            bench.check(abs(part - printed) < 2e-3, f"{what}: {part}, not {printed}")
        one_way = found["object_wall"]["contributors"][0]["ercs"]
        here, there = found["direct"]["cell_range_m"], found["wall_object_wall"]["cell_range_m"]
        spread = ((here + there) / 2) ** 2 / (here * there)
        bench.check(abs(one_way - part * spread) < 1e-9, f"{what}, one way: {one_way}")


def ray_tube(radius_m, profile_m, cosine, first_m, onward_m):
    """The spreading of a narrow bundle of rays behind a bulge z = -x^2/(2 radius) - y^2/(2 profile), against a flat
    mirror's, on amplitude: rays are traced beside the middle one."""
    sine, step = math.sqrt(1 - cosine ** 2), 1e-6
    source = (-first_m * sine, 0.0, first_m * cosine)

    def arrival(x, y):
        place = (x, y, -x * x / (2 * radius_m) - y * y / (2 * profile_m))
        normal = (x / radius_m, y / profile_m, 1.0)
        way = [p - s for p, s in zip(place, source)]
        depth = 2 * sum(w * n for w, n in zip(way, normal)) / sum(n * n for n in normal)
        back = [w - depth * n for w, n in zip(way, normal)]
        far = (onward_m - (place[0] * sine + place[2] * cosine)) / (back[0] * sine + back[2] * cosine)
        spot = [p + far * v for p, v in zip(place, back)]
        return spot[0] * cosine - spot[2] * sine, spot[1]

    along, across = arrival(step, 0)[0], arrival(0, step)[1]
    start = step * cosine / first_m, step / first_m  # the angles between the rays at their source
    return (first_m + onward_m) * math.sqrt(start[0] * start[1] / (along * across))


def curved_mirrors(bench):
    """A convex mirror spreads the wave as rays that are traced from it do."""
    for (radius_m, profile_m), turn_deg in itertools.product(
            ((20, 1.5), (40, 3), (None, 0.04), (5, None)), (20, 60, 80)):
        curves = {"radius_m": radius_m, "profile_radius_m": profile_m}
        curves = {key: value for key, value in curves.items() if value}
        one = flat(range_max_m=300, calibration_range_m=3000)
        found, way_m = mirrored(bench, {"reflection": 1, **curves}, one, turn_deg)
        ercs = found["wall_object_wall"]["contributors"][0]["ercs"]
        first_m = way_m / 2.2
        expected = ray_tube(radius_m or 1e12, profile_m or 1e12, math.cos(math.radians(turn_deg)), first_m,
                            way_m - first_m) ** 2
        bench.check(abs(ercs / expected - 1) < 1e-4, f"{curves}, {turn_deg} degrees: {ercs}, expected {expected}")


def range_laws(bench):
    """The wave spreads over both of its ways; what the receiver makes of it goes by the range that it reads."""
    (bench.scratch / "gain.csv").write_text("range_m,level_db\n" + "".join(f"{m},{20 * math.log10(ercs_1) - 10}\n"
                                                                for m, ercs_1 in ((1, 1e4), (10, 300), (100, 50))))
    table = {"range_curve": "gain.csv", "calibration_ercs": None, "calibration_range_m": None, "exponent": None}
    laws = [({"exponent": q}, lambda r, q=q: 10 ** (6 / 20) / 0.8 * (100 / r) ** q) for q in (1, 1.3, 2)]
    laws.append((table, lambda r: 300 * (r / 10) ** math.log10(50 / 300)))
    for changes, law in laws:
        one = {key: value for key, value in flat(**changes).items() if value is not None}
        found, _ = mirrored(bench, {"reflection": 0.9}, one, 75)
        here, there = found["direct"]["cell_range_m"], found["wall_object_wall"]["cell_range_m"]
        for path, ways, bounced in (("direct", here * here, 1), ("wall_object", here * there, 0.9),
                                    ("object_wall", here * there, 0.9), ("wall_object_wall", there * there, 0.81)):
            read = found[path]["cell_range_m"]
            expected = law(read) * read ** 2 * bounced / ways
            value = found[path]["cell_amplitude"]
            bench.check(abs(value / expected - 1) < 1e-9, f"{changes}, {path}: {value}, expected {expected}")


def shipped_mirrors(bench):
    """A dot at (20, 0) m is mirrored in the side, at y = 4 m, of every class that mirrors: O' is (20, 8)."""
    curves = {"guardrail": (1e12, 0.04), "car": (20, 1.5), "van": (40, 3)}
    one = flat(cell_range_m=0.01, calibration_range_m=1000)
    way_m = math.hypot(20, 8)
    for name in ("wall", "guardrail", "car", "van", "truck", "bus", "articulated_truck"):
        width = bench.vehicles[name]["width_m"]
        eps = permittivity("concrete" if name == "wall" else "metal", one["carrier_hz"])
        part = surface_part(eps, 8 / way_m, True) * ray_tube(*curves.get(name, (1e12, 1e12)), 8 / way_m,
                                                             way_m / 2, way_m / 2)
        for yaw in (0, math.pi):
            scene = model.frame([ego(), thing("o", "dot", 20, 0), thing("m", name, 10, 4 + width / 2, yaw=yaw)])
            found = by_path(see(bench, [scene], one, "all,-merging,-plane_reflection")[0])
            bench.check(set(GHOSTS) <= set(found), f"{name}: {sorted(found)}")
            ghost = found["wall_object_wall"]
            bench.check(abs(ghost["cell_range_m"] - way_m) < 1e-9, f"{name}: {ghost['cell_range_m']}")
            ercs = ghost["contributors"][0]["ercs"]
            bench.check(abs(ercs / part ** 2 - 1) < 1e-4, f"{name}: {ercs}, expected {part ** 2}")


# ---- the choice of effects ----------------------------------------------------------------------


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
    yield "walled-road", bench.played("glint-traffic", str(ROOT / "data/scenarios/walled-road.json")), full_sensor()


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
    ("walls mirror by their material, by angle and by polarization", materials),
    ("convex mirrors spread the wave", curved_mirrors),
    ("ghosts follow the sensor's law of range", range_laws),
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
