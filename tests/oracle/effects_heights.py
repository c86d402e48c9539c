"""Effects of the ideal list: elevation, height, diffraction, curvature and latency.

Usage: python3 tests/oracle/effects_heights.py BIN_DIR        exit status 1 if any check fails

The figures are those printed in MODEL 14.2 to 14.6, or closed forms.
"""

import json
import math
import sys

sys.dont_write_bytecode = True
import model  # noqa: E402
from model import ego, frame, sensor, suite_of, thing  # noqa: E402

LIGHT_MPS = 299792458.0
OURS = ["elevation", "height", "diffraction", "curvature"]


def point(**changes):
    return {"name": "p", "x": 0, "y": 0, "facing_rad": 0, "full_rad": math.pi, "zero_rad": math.pi, "shape": "hard",
            "ercs": 0.5, **changes}


def vehicle(points=(), planes=(), blocks=False, raised=False, height=1.0, **rest):
    return {"origin": "Made by tests/oracle/effects_heights.py.", "length_m": 1, "width_m": 1, "height_m": height,
            "reflectors": {"blocks": blocks, "raised": raised, "points": list(points), "planes": list(planes), **rest}}


def wide(**changes):
    return sensor(**{"range_max_m": 200, "phase_reference": "centre", **changes})


def aside(**changes):
    return wide(mount_yaw_rad=math.pi / 2, **changes)


def body(name, kind, x, y, height, length=0.2, width=0.2, velocity=(0.0, 0.0)):
    return dict(thing(name, kind, x, y, length=length, width=width, velocity=velocity), height_m=height)


def ideal(bench, things, suite, effects="auto", more=""):
    words = ["glint-ideal", "--sensors", bench.write_suite(suite), "--effects", effects, "--sections", "account" + more]
    [answer] = bench.through([frame([ego(), *things])], ["glint-extract"], words)
    return answer


def look(bench, things, suite, effects="auto"):
    """One frame of glint-ideal: echoes by object and reflector, and losses with their reasons."""
    answer = ideal(bench, things, suite, effects)
    lost = {(one["object"], one["reflector"]): group["reason"]
            for group in answer.get("lost", []) for one in group["echoes"]}
    return {(one["object"], one["reflector"]): one for one in answer.get("echoes", [])}, lost


def db(factor):
    return 20 * math.log10(factor)


def near(bench, value, wanted, tolerance, what):
    bench.check(abs(value - wanted) <= tolerance, f"{what}: {value!r}, expected {wanted!r}")


# ---- elevation -----------------------------------------------------------------------------------


def slant_ranges_are_as_published(bench):
    suite = suite_of(wide(mount_z_m=0.5))
    for distance, farther, cosine in [(3, .041381, .986394), (5, .024938, .995037), (10, .012492, .998752),
                                      (30, .004166, .999861)]:
        for height in 1.0, 2.0:
            echo = look(bench, [body("a", "high", distance, 0, height, velocity=(4, 0))], suite)[0]["a", "p"]
            rise = height - 0.5
            near(bench, echo["range_m"], math.hypot(distance, rise), 1e-13, "slant range")
            near(bench, echo["range_rate_mps"], 4 * distance / math.hypot(distance, rise), 1e-13, "rate")
            bench.check(echo["effects"] == ["elevation"], f"label {echo.get('effects')}")
            bench.check(echo["ercs"] == 0.5, "a beam without a width weakens")
            if height == 1.0:
                near(bench, echo["range_m"] - distance, farther, 5.1e-7, "MODEL 14.2, range")
                near(bench, echo["range_rate_mps"] / 4, cosine, 5.1e-7, "MODEL 14.2, cosine")


def azimuths_are_those_of_a_cone(bench):
    suite = suite_of(wide(mount_z_m=0.5))
    for degrees in -80, -30, 10, 45, 89:
        azimuth = math.radians(degrees)
        place = [body("a", "high", 8 * math.cos(azimuth), 8 * math.sin(azimuth), 4.5)]
        echo = look(bench, place, suite)[0]["a", "p"]
        near(bench, math.sin(echo["azimuth_rad"]), math.sin(azimuth) * 8 / math.hypot(8, 4), 1e-13, "cone")


def the_beam_is_down_by_half_at_its_half_width(bench):
    half = math.radians(7.5)
    suite = suite_of(wide(mount_z_m=0.5, elevation_half_width_rad=half))
    place = [body("a", "high", 10, 0, 0.5 + 10 * math.tan(half))]
    near(bench, look(bench, place, suite)[0]["a", "p"]["ercs"], 0.25, 1e-13, "gain both ways")


def a_curve_over_elevation_is_the_gain(bench):
    """Straight in decibels between its rows, by the side, and constant beyond them."""
    (bench.scratch / "beam.csv").write_text("elevation_rad,level_db\n-0.2,-20\n0.1,-2\n0.2,-10\n")
    suite = suite_of(wide(mount_z_m=2, elevation_curve="beam.csv"))
    for rise, level_db in (0.15, -6), (0.05, -5), (-0.1, -14), (-0.19, -19.4), (0.3, -10):
        place = [body("a", "high", 10, 0, 2 + 10 * math.tan(rise))]
        echo = look(bench, place, suite)[0]["a", "p"]
        near(bench, echo["ercs"], 0.5 * 10 ** ((level_db + 8) / 20), 1e-12, f"gain at {rise} rad")


def without_heights(seen):
    """Echoes without height_m, which only the road asks for: what a flat world shows."""
    echoes, lost = seen
    return {names: {key: echo[key] for key in echo if key not in ("height_m", "extent_m")}
            for names, echo in echoes.items()}, lost


def equal_heights_change_no_bit(bench):
    flat, high = suite_of(wide()), suite_of(wide(mount_z_m=0.7, elevation_half_width_rad=0.1))
    things = [body("a", "high", 7.3, 2.1, 0.7, velocity=(3, 1)), body("b", "flat", 11.7, -4.4, 3, velocity=(1, 2))]
    plain = look(bench, things, flat)
    for effects in "auto", "all":
        bench.check(without_heights(look(bench, things, high, effects)) == plain, f"equal heights, {effects}")
    raised = [body("a", "high", 7.3, 2.1, 1.7), body("b", "flat", 11.7, -4.4, 3)]
    for effects in "none", "-elevation":
        bench.check(without_heights(look(bench, raised, high, effects)) == look(bench, raised, flat, effects), f"off by {effects}")


# ---- height --------------------------------------------------------------------------------------


def a_truck_is_seen_over_a_car(bench):
    """The ray from 0.5 m up to 3 m, 40 m away, is above 1.5 m from 16 m on."""
    suite = suite_of(wide(mount_z_m=0.5))
    for begin, seen in (10, False), (15.9, False), (16.1, True), (25, True):
        things = [body("car", "block", begin + 2, 0, 1.5, length=4, width=1.8), body("truck", "high", 40, 0, 3)]
        echoes, lost = look(bench, things, suite, "-elevation")
        if seen:
            bench.check(echoes["truck", "p"]["effects"] == ["height"], "label of what is seen over a car")
            bench.check(echoes["truck", "p"]["ercs"] == 0.5, "what is seen over a car is weaker")
        bench.check((("truck", "p") in echoes) == seen, f"behind a car at {begin} m")
        for effects, bare in ("-height", suite), ("auto", suite_of(wide())):
            echoes, lost = look(bench, things, bare, effects)
            bench.check(not echoes and lost["truck", "p"] == "blocked", f"flat world, {effects}")


def a_low_reflector_hides_from_a_high_sensor(bench):
    """The ray from 4 m down to 0.5 m, 40 m away, is below 1.5 m for the last 11.43 m."""
    suite = suite_of(wide(mount_z_m=4))
    for end, seen in (28, True), (28.5, True), (28.65, False), (35, False):
        things = [body("car", "block", end - 2, 0, 1.5, length=4, width=1.8), body("low", "high", 40, 0, 0.5)]
        bench.check((("low", "p") in look(bench, things, suite)[0]) == seen, f"in front of a car up to {end} m")


def a_level_ray_at_a_top_is_blocked(bench):
    for height, seen in (1.5, False), (math.nextafter(1.5, 2), False), (math.nextafter(1.5, 1), True), (1.4, True):
        things = [body("car", "block", 12, 0, height, length=4, width=1.8), body("far", "flat", 40, 0, 1)]
        echoes = look(bench, things, suite_of(wide(mount_z_m=1.5)))[0]
        bench.check((("far", "p") in echoes) == seen, f"a level ray at 1.5 m over {height!r} m")


def under_and_over_vehicles(bench):
    """Under a truck a tenth of the cross section is left; over a car nothing is lost; where neither way is
    free, nothing is seen."""
    suite = suite_of(wide(mount_z_m=0.5))
    car, truck = (body(kind, kind, x, 0, height, 4, 2) for kind, x, height in (("block", 20, 1), ("raised", 12, 4)))
    far = body("far", "under", 40, 0, 2.5)
    for things, part in ([truck, far], 0.1), ([car, far], 1), ([car, truck, far], 0.1), (
            [dict(car, height_m=2), truck, far], 0):
        echo = look(bench, things, suite)[0].get(("far", "p"))
        near(bench, echo["ercs"] / 0.5 if echo else 0, part, 1e-15, "part under and over vehicles")


# ---- diffraction ---------------------------------------------------------------------------------


def behind_an_edge(bench, carrier_hz, depth, effects="auto", **changes):
    """The part of a cross section that is left 30 m away, on a sight line that passes depth inside an edge at
    15 m."""
    suite = suite_of(wide(carrier_hz=carrier_hz, diffraction=True, **changes))
    things = [body("wall", "block", 15, depth - 2, 5, length=1e-6, width=4), body("far", "flat", 30, 0, 1)]
    echoes, lost = look(bench, things, suite, effects)
    if ("far", "p") not in echoes:
        bench.check(lost["far", "p"] == "blocked", f"reason {lost}")
        return 0, []
    return echoes["far", "p"]["ercs"] / 0.5, echoes["far", "p"].get("effects", [])


def shadows_are_as_deep_as_published(bench):
    for carrier_hz, loss_db in (24.125e9, 32.4), (76.5e9, 41.6):
        factor, effects = behind_an_edge(bench, carrier_hz, 0.3)
        near(bench, -db(factor), loss_db, 0.051, f"0.3 m inside at {carrier_hz}")
        bench.check(effects == ["diffraction"], f"label {effects}")
        factor, effects = behind_an_edge(bench, carrier_hz, 0)
        near(bench, -db(factor), 2 * 6.032852, 1e-5, "at the edge")
        radius = math.sqrt(LIGHT_MPS / carrier_hz * 7.5)
        for zones, seen in (1.99, True), (2.01, False):
            bench.check((behind_an_edge(bench, carrier_hz, zones * radius)[0] > 0) == seen, f"{zones} zones inside")
        bench.check(0.99 < behind_an_edge(bench, carrier_hz, -0.55 * radius)[0] < 1, "just beside the edge")
        bench.check(behind_an_edge(bench, carrier_hz, -0.553 * radius) == (1, []), "beside the edge")
        for depth, factor in (0.3, 0), (0, 0), (-0.001, 1):
            bench.check(behind_an_edge(bench, carrier_hz, depth, "-diffraction")[0] == factor, "switched off")


def loss_db(depth, before, behind, carrier_hz):
    """The loss of MODEL 14.4, there and back."""
    nu = depth * math.sqrt(2 * (before + behind) / (LIGHT_MPS / carrier_hz * before * behind))
    return 2 * (6.9 + db(math.sqrt((nu - .1) ** 2 + 1) + nu - .1)) if nu > -.78 else 0


def several_edges_multiply_and_the_easiest_way_counts(bench):
    carrier_hz = 24.125e9
    suite = suite_of(wide(carrier_hz=carrier_hz, diffraction=True, mount_z_m=1))
    far = body("far", "flat", 30, 0, 1)
    one = body("one", "block", 10, -1.95, 5, length=1e-6, width=4)
    two = body("two", "block", 20, 2.02, 5, length=1e-6, width=4)
    echo = look(bench, [one, two, far], suite)[0]["far", "p"]
    wanted = loss_db(0.05, 10, 20, carrier_hz) + loss_db(-0.02, 20, 10, carrier_hz)
    near(bench, -db(echo["ercs"] / 0.5), wanted, 1e-4, "two edges")
    pole = body("pole", "block", 15, 0.05, 5, length=1e-6, width=0.4)
    echo = look(bench, [pole, far], suite)[0]["far", "p"]
    near(bench, -db(echo["ercs"] / 0.5), loss_db(0.15, 15, 15, carrier_hz), 1e-4, "the nearer of two edges")
    low = body("low", "block", 15, 0.05, 1.1, length=1e-6, width=4)
    echo = look(bench, [low, far], suite)[0]["far", "p"]
    near(bench, -db(echo["ercs"] / 0.5), loss_db(0.1, 15, 15, carrier_hz), 1e-4, "over the top")
    bench.check(echo["effects"] == ["height", "diffraction"], f"label {echo['effects']}")
    bench.check(look(bench, [dict(low, height_m=0.8), far], suite)[0]["far", "p"]["ercs"] == 0.5, "far over the top")


def an_edge_just_beside_the_sector_still_counts(bench):
    """A box stands on its corner beside a thin pole; the circle around the box ends at that corner."""
    suite = suite_of(wide(diffraction=True))
    far = body("far", "flat", 30, 0, 1, length=1e-3, width=1e-3)
    for depth, whole in (-0.02, False), (-0.1, False), (-0.2, True):
        box = dict(body("box", "block", 15, math.sqrt(2) - depth, 5, length=2, width=2), yaw_rad=math.pi / 4)
        auto, everything = (look(bench, [box, far], suite, effects)[0]["far", "p"] for effects in ("auto", "all"))
        bench.check(auto == everything, f"{depth} m beside an edge: auto is not all")
        near(bench, -db(auto["ercs"] / 0.5), loss_db(depth, 15, 15, 24.125e9), 1e-4, f"{depth} m beside an edge")
        bench.check((auto["ercs"] == 0.5) == whole, f"{depth} m beside an edge: {auto['ercs']}")
        hard = look(bench, [dict(box, y_m=math.sqrt(2) - 0.2), far], suite, "-occlusion")[0]["far", "p"]
        bench.check(hard["ercs"] == 0.5 and "effects" not in hard, "a shadow without occlusion")


def margin_of(bench, things, suite):
    answer = ideal(bench, things, suite, "auto", more=",margins")
    ones = answer.get("echoes", []) + [one for group in answer.get("lost", []) for one in group["echoes"]]
    return ones[0]["margins"]["sight_m"]


def a_car_behind_a_van_is_seen_under_it(bench):
    """MODEL 14.3: the wave that the road mirrors loses twice a knife edge of ITU-R P.526 at the van's underside."""
    soft = wide(mount_z_m=0.5, carrier_hz=76.5e9, diffraction=True)
    published = {8: 28.08, 10: 21.16, 12: 14.23, 13: 10.95, 14: 7.88, 18: 1.65, 20: 6.90, 21: 9.92, 22: 13.19, 24: 20.26}
    for begin, loss_db in published.items():
        things = [body("van", "clear", begin + 3.25, 0, 2.86, length=6.5, width=2.16), body("car", "high", 40, 0, 0.48)]
        for effects in "auto", "all":
            echo = look(bench, things, suite_of(soft), effects + ",-elevation")[0]["car", "p"]
            near(bench, -db(echo["ercs"] / 0.5), loss_db, 0.0051, f"behind a van at {begin} m")
            bench.check(set(echo["effects"]) == {"height", "diffraction"}, f"label: {echo['effects']}")
        echoes, lost = look(bench, things, suite_of(wide(mount_z_m=0.5)))
        bench.check((("car", "p") in echoes) == (12.5 < begin < 21.3), f"sharply behind a van at {begin} m")
        for effects, suite in ("-height", soft), ("auto", wide(carrier_hz=76.5e9, diffraction=True)):
            echoes, lost = look(bench, things, suite_of(suite), effects)
            bench.check(lost["car", "p"] == "blocked", f"flat world, {effects}, van at {begin} m")
    # The road mirrors the wave already, so that it has no straight one to interfere with.
    scene = dict(frame([ego(), *things[1:], body("van", "clear", 20, 0, 2.86, length=6.5, width=2.16)]), conditions={"road": "asphalt"})
    ideal = ["glint-ideal", "--sensors", bench.write_suite(suite_of(soft))]
    seen = bench.through([scene], ["glint-extract"], ideal)[0]["echoes"]
    bench.check([one["object"] for one in seen] == ["car"] and "height_m" not in seen[0], f"by the road: {seen}")


def margins_tell_of_tops_and_soft_shadows(bench):
    """The ray from 0.5 m to 3 m, 40 m away, passes over a car of 1.5 m that begins at 25 m, then at 10 m."""
    suite = suite_of(wide(mount_z_m=0.5))
    for begin, margin in (25, 0.5625), (10, 0.375):
        things = [body("car", "block", begin + 2, 0, 1.5, length=4, width=1.8), body("truck", "high", 40, 0, 3)]
        near(bench, margin_of(bench, things, suite), margin, 1e-12, "margin to a top")
    wall, far = body("wall", "block", 15, -1.8, 5, length=1e-6, width=4), body("far", "flat", 30, 0, 1)
    near(bench, margin_of(bench, [wall, far], suite_of(wide())), 0.2, 1e-12, "margin in a hard shadow")
    near(bench, margin_of(bench, [wall, far], suite_of(wide(diffraction=True))), 0, 0, "margin in a soft shadow")
    dark = dict(wall, y_m=-1)
    near(bench, margin_of(bench, [dark, far], suite_of(wide(diffraction=True))), 1 - 2 * 0.3053, 5e-3,
         "margin in a dark shadow")


# ---- curvature and latency -----------------------------------------------------------------------


def a_rail_reflects_by_its_corrugation(bench):
    """MODEL 14.5: sigma = pi r2 R^2/(r2 + R), as ERCS over 10 m^2."""
    for distance in 2.0, 10.0, 50.0:
        rail = [body("rail", "rail", 0, distance + 0.1, 1, length=20)]
        for suite, curved in (suite_of(aside(curved_sides=True)), True), (suite_of(aside()), False):
            echo = look(bench, rail, suite)[0]["rail", "right"]
            sigma = math.pi * 0.04 * distance ** 2 / (0.04 + distance)
            near(bench, echo["ercs"], math.sqrt(sigma / 10) if curved else 0.8, 1e-12, "rail")
            bench.check(("curvature" in echo["effects"]) == curved, "label of a rail")
        echo = look(bench, rail, suite_of(aside(curved_sides=True)), "-curvature")[0]["rail", "right"]
        bench.check(echo["ercs"] == 0.8, "curvature switched off")


def a_late_scan_lags_by_the_way_in_its_latency(bench):
    """MODEL 14.6: 1.5 m at 30 m/s and 50 ms."""
    things = [body("a", "flat", 60, 0, 1, velocity=(-30, 0)), body("b", "flat", 60, 4, 1)]
    now, late = (look(bench, things, suite_of(wide(**changes)))[0] for changes in ({}, {"latency_s": 0.05}))
    near(bench, late["a", "p"]["range_m"] - now["a", "p"]["range_m"], 1.5, 1e-12, "latency")
    bench.check(late["a", "p"]["effects"] == ["latency"], "label of a late echo")
    near(bench, now["a", "p"]["time_s"] - late["a", "p"]["time_s"], 0.05, 1e-12, "time of a late echo")
    bench.check(late["b", "p"]["range_m"] == now["b", "p"]["range_m"] and not late["b", "p"].get("effects"),
                "what stands still is the same late")
    off = look(bench, things, suite_of(wide(latency_s=0.05)), "-latency")[0]
    bench.check(off == now, "latency switched off")


# ---- auto is all ---------------------------------------------------------------------------------


def full_suite():
    """A pair of wide radars on a roof with every effect of this file."""
    suite = json.loads((model.ROOT / "data/sensors/corner77.json").read_text())
    for sensor in suite["sensors"]:
        del sensor["cycle_s"]  # a scan in every frame
    for one in suite["sensors"]:
        one.pop("sources")
        one["antenna_table"] = str(model.ROOT / "data/antennas/corner77.csv")
        one.update(mount_z_m=2.5, elevation_half_width_rad=0.3, diffraction=True, curved_sides=True, latency_s=0.05,
                   carrier_hz=24e9)
    return suite


def whole_chain(bench, frames, effects):
    sensors = ["--sensors", bench.write_suite(full_suite())]
    ideal = ["glint-ideal", *sensors, "--effects", effects, "--sections", "account"]
    return bench.through(frames, ["glint-extract"], ideal, ["glint-sensor", *sensors], ["glint-noise", *sensors])


def auto_is_all_and_each_can_be_left_out(bench):
    bench.env["GLINT_DATA"] = str(model.ROOT / "data")
    for density, frames in ("medium", 300), ("dense", 200):
        drawn = bench.played("glint-traffic-random", "--density", density, "--frames", str(frames))
        auto, everything = (whole_chain(bench, drawn, effects) for effects in ("auto", "all"))
        for one, other in zip(auto, everything):
            for part in "targets", "lost", "counts":
                bench.check(one.get(part) == other.get(part), f"{density}, frame {one['frame']}: {part}")
        labels = [effect for one in auto for target in one["targets"] for effect in target["effects"]]
        for effect in OURS[:3]:
            bench.check(labels.count(effect) >= 5, f"{density}: only {labels.count(effect)} times {effect}")
            without = whole_chain(bench, drawn, f"all,-{effect}")
            bench.check(not any(effect in target["effects"] for one in without for target in one["targets"]),
                        f"{effect} is left out and labels")
            bench.check(any(one.get("targets") != other.get("targets") for one, other in zip(without, everything)),
                        f"{effect} matters nowhere")


def prepare(bench):
    rail = {"name": "right", "from_x": -0.5, "from_y": -0.5, "to_x": 0.5, "to_y": -0.5, "ercs": 0.8,
            "profile_radius_m": 0.04}
    for name, document in {
            "car": vehicle(), "flat": vehicle([point()]), "high": vehicle([point(z=1)]),
            "under": vehicle([point(z=1, under_vehicles=0.1)]), "block": vehicle(blocks=True),
            "clear": vehicle(blocks=True, clearance_m=0.19),
            "raised": vehicle(blocks=True, raised=True), "rail": vehicle(planes=[rail])}.items():
        bench.add_vehicle(name, document)


CHECKS = [
    ("slant ranges are as published", slant_ranges_are_as_published),
    ("azimuths are those of a cone", azimuths_are_those_of_a_cone),
    ("the beam is down by half at its half width", the_beam_is_down_by_half_at_its_half_width),
    ("a curve over elevation is the gain", a_curve_over_elevation_is_the_gain),
    ("equal heights change no bit", equal_heights_change_no_bit),
    ("a truck is seen over a car", a_truck_is_seen_over_a_car),
    ("a low reflector hides from a high sensor", a_low_reflector_hides_from_a_high_sensor),
    ("a level ray at a top is blocked", a_level_ray_at_a_top_is_blocked),
    ("reflectors show under and over vehicles", under_and_over_vehicles),
    ("a car behind a van is seen under it by the road", a_car_behind_a_van_is_seen_under_it),
    ("margins tell of tops and soft shadows", margins_tell_of_tops_and_soft_shadows),
    ("shadows are as deep as published", shadows_are_as_deep_as_published),
    ("several edges multiply and the easiest way counts", several_edges_multiply_and_the_easiest_way_counts),
    ("an edge just beside the sector still counts", an_edge_just_beside_the_sector_still_counts),
    ("a rail reflects by its corrugation", a_rail_reflects_by_its_corrugation),
    ("a late scan lags by the way in its latency", a_late_scan_lags_by_the_way_in_its_latency),
    ("auto is all, and each effect can be left out", auto_is_all_and_each_can_be_left_out),
]


if __name__ == "__main__":
    model.run(__doc__, prepare, CHECKS)
