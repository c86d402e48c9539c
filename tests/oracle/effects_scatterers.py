"""The road as a mirror, wheels, limbs and clutter through the executables, against MODEL 14.10 to 14.13.

Usage: python3 tests/oracle/effects_scatterers.py BIN_DIR        exit status 1 if any check fails

Statistics use fixed seeds and are held to five standard errors.
"""

import cmath
import math
import sys

sys.dont_write_bytecode = True
import model  # noqa: E402
from effects_noise import check_even  # noqa: E402
from model import ROOT, ego, everywhere, full_sensor, sensor, stripped, suite_of, thing  # noqa: E402
from sizes import quick  # noqa: E402

LIGHT_MPS = 299792458.0
APART = "all,-merging,-threshold"
DRAWS = quick(3000, 6000)
OURS = ["wheels", "limbs", "clutter", "two_ray"]
FLAT = "azimuth_rad,sum,delta\n-1.57,1,-1\n1.57,1,1\n"
GAZE = {"antenna_pattern": "table", "antenna_table": "flat.csv", "phase_reference": "centre",
        "angle_estimator": "ratio", "final_threshold": False, "range_max_m": 250, "calibration_range_m": 250}


def flat(**changes):
    return sensor(**{**GAZE, **changes})


def vehicle(*points, height=1.0, **reflectors):
    return {"origin": "Made by tests/oracle/effects_scatterers.py.", "length_m": 0.1, "width_m": 0.1, "height_m": height,
            "reflectors": {"points": list(points), **reflectors}}


def add_vehicles(bench):
    model.add_shipped_vehicles(bench)
    bench.add_vehicle("dot", vehicle(everywhere("p", z=0.5), height=1.2))
    bench.add_vehicle("column", vehicle(everywhere("p", z=0.5, extent=1), height=1.2))
    bench.add_vehicle("anywhere", vehicle(everywhere("p", extent=1), height=1.2))
    bench.add_vehicle("cart", vehicle(everywhere("hub", moving_part="wheel")))
    bench.add_vehicle("walker", vehicle(everywhere("torso", moving_part="limbs")))
    bench.add_vehicle("mirror", {"origin": "For tests.", "length_m": 400, "width_m": 0.5, "height_m": 3, "reflectors": {
        "mirrors": [{"from_x": -0.5, "from_y": -0.5, "to_x": 0.5, "to_y": -0.5, "reflection": 0.9}]}})
    (bench.scratch / "flat.csv").write_text(FLAT)


def frames_of(objects, count=1, carrier=None, **conditions):
    first = model.frame([carrier or ego(), *objects])
    if conditions:
        first["conditions"] = conditions
    return [dict(first, frame=i, time_s=0.5 + 0.1 * i, last=i + 1 == count) for i in range(count)]


def see(bench, frames, one, effects=APART, stages="glint-sensor | glint-noise-none"):
    path = bench.write_suite(suite_of(one))
    text = f"glint-extract | glint-ideal --sensors {path} --effects={effects} --sections account | {stages}"
    return model.parsed(bench.fused(text, frames))


def on_path(frame, path):
    """Targets of one member each that took the path, by number."""
    found = [target for target in frame["targets"] if target["contributors"][0]["path"] == path]
    return sorted(found, key=lambda target: target["contributors"][0].get("number", 0))


def made(frame, path):
    return sum(one["echoes"] for count in frame["counts"] for one in count["paths"] if one["path"] == path)


def check_mean(bench, values, mean, deviation, what):
    error = deviation / math.sqrt(len(values))
    bench.check(abs(sum(values) / len(values) - mean) < 5 * error,
                f"{what}: mean {sum(values) / len(values):.6f} of {len(values)}, expected {mean:.6f}")


# ---- the road ------------------------------------------------------------------------------------


def fresnel(permittivity, psi, vertical):
    s, r = math.sin(psi), cmath.sqrt(permittivity - math.cos(psi) ** 2)
    return (permittivity * s - r) / (permittivity * s + r) if vertical else (s - r) / (s + r)


def mean(powers):
    powers = list(powers)
    return math.fsum(powers) / len(powers)


def f4_db(low, high, distance, wavelength, reflection, extent=0, steps=1):
    """The power that four paths make of 1, over their mean over all phases; a reflector has that of steps along it."""
    direct, bounced = math.hypot(distance, low - high), math.hypot(distance, low + high)
    wave = reflection * direct / bounced * cmath.exp(-2j * math.pi * (bounced - direct) / wavelength)
    turns = (bounced - direct) / wavelength * extent / high
    along = mean(abs(1 + wave * cmath.exp(2j * math.pi * turns * ((i + 0.5) / steps - 0.5))) ** 4 for i in range(steps))
    return 10 * math.log10(along / mean(abs(1 + wave * cmath.exp(0.25j * math.pi * i)) ** 4 for i in range(8)))


def oracle_agrees(bench):
    """The formulas that the executables are held to below agree with the figures of MODEL 14.10 to the last
    digit."""
    for reflection, figures in ((-1, {20: "2.269695", 50: "-24.339348", 100: "4.177107", 200: "-2.650853"}),
                                (-0.7, {20: "2.245472", 50: "-19.288766", 100: "4.086294", 200: "-2.421411"})):
        for distance, printed in figures.items():
            bench.check_printed(f4_db(0.5, 0.6, distance, LIGHT_MPS / 76.5e9, reflection), printed, f"{distance} m")
    for degrees, across, upright in ((1, "0.982724", "0.916381"), (5, "0.916676", "0.642440"), (20, "0.711851", "0.085697")):
        bench.check_printed(abs(fresnel(5 - 0.25j, math.radians(degrees), False)), across, "Gamma_H")
        bench.check_printed(abs(fresnel(5 - 0.25j, math.radians(degrees), True)), upright, "Gamma_V")


def road(name, carrier):
    return (5 - 0.25j, 1e-3) if name == "asphalt" else (5.24 - {76.5e9: 0.322976, 24.125e9: 0.415270}[carrier] * 1j, 3e-4)


def reflection(name, carrier, vertical, distance, low=0.5, high=0.6):
    permittivity, rough = road(name, carrier)
    psi = math.atan((low + high) / distance)
    smooth = math.exp(-8 * (math.pi * rough * math.sin(psi) * carrier / LIGHT_MPS) ** 2)
    return smooth * fresnel(permittivity, psi, vertical)


def gains_db(bench, kind, distances, one, effects=APART, **conditions):
    """By how much the road raises echoes at these distances, each seen alone."""
    scenes = [frames_of([thing("o", kind, distance, 0)], **conditions)[0] for distance in distances]
    scenes = [dict(scene, scene=f"s{i}") for i, scene in enumerate(scenes)]
    found = []
    for with_it, without in zip(see(bench, scenes, one, effects), see(bench, scenes, one, effects + ",-two_ray")):
        a, b = with_it["targets"][0], without["targets"][0]
        found.append(20 * math.log10(a["cell_amplitude"] / b["cell_amplitude"]))
        bench.check(("two_ray" in a.get("effects", [])) == (found[-1] != 0), f"label {a.get('effects')}")
        bench.check("two_ray" not in b.get("effects", []), "switched off, the road has a label")
    return found


def compact_echoes_fade(bench):
    distances = [3, 5, 10, 15, 20, 30, 50, 100, 153.1059, 200]
    for carrier in 76.5e9, 24.125e9:
        for name in "asphalt", "concrete":
            for polarization in "horizontal", "vertical", None:
                one = flat(mount_z_m=0.5, carrier_hz=carrier, polarization=polarization)
                if polarization is None:
                    del one["polarization"]
                for effects in APART, APART + ",-elevation":
                    for distance, gain in zip(distances, gains_db(bench, "dot", distances, one, effects, road=name)):
                        upright = polarization != "horizontal"
                        wanted = f4_db(0.5, 0.6, distance, LIGHT_MPS / carrier,
                                       reflection(name, carrier, upright, distance))
                        bench.check(abs(gain - wanted) < 2e-5, f"{name}, {carrier}, {polarization}, {distance} m: "
                                                              f"{gain} dB, expected {wanted}")


def nulls_where_published(bench):
    one = flat(mount_z_m=0.5, carrier_hz=76.5e9, polarization="horizontal")
    for null in 153.1059, 76.5530, 51.0353:
        steps = [null * (1 + part / 1000) for part in range(-40, 41)]
        gains = gains_db(bench, "dot", steps, one, road="asphalt")
        deepest = min(range(len(gains)), key=gains.__getitem__)
        bench.check(abs(steps[deepest] / null - 1) < 0.003 and gains[deepest] < -60,
                    f"null at {steps[deepest]} m, {gains[deepest]} dB; expected at {null} m")


def extended_echoes_hardly_fade(bench):
    one = flat(mount_z_m=0.5, carrier_hz=76.5e9)
    distances = [20, 50, 100, 150, 240]
    for distance, gain in zip(distances, gains_db(bench, "column", distances, one, road="asphalt")):
        wanted = f4_db(0.5, 0.6, distance, LIGHT_MPS / 76.5e9, reflection("asphalt", 76.5e9, True, distance), 1.2, 20000)
        bench.check(abs(gain - wanted) < 1e-4 and abs(gain) < 1, f"{distance} m: {gain} dB, expected {wanted}")


def all_causes(bench):
    high = flat(mount_z_m=0.5, carrier_hz=76.5e9)
    low = {key: high[key] for key in high if key != "mount_z_m"}
    for kind, one, conditions in (("dot", high, {}), ("dot", low, {"road": "asphalt"}),
                                  ("anywhere", high, {"road": "asphalt"})):
        bench.check(gains_db(bench, kind, [30], one, **conditions) == [0], f"{kind}, {conditions}: a cause is missing")
    frame = see(bench, frames_of([thing("o", "dot", 30, -2), thing("w", "mirror", 15, 4.25)], road="asphalt"),
                dict(high, bounces=3))[0]
    marked = {target["contributors"][0]["path"]: "two_ray" in target["effects"] for target in frame["targets"]}
    bench.check(marked == {"direct": True, "wall_object": False, "object_wall": False, "wall_object_wall": False},
                f"who has the road: {marked}")


# ---- wheels --------------------------------------------------------------------------------------

SPEED = 13.8889
ROLLING = SPEED * math.cos(math.radians(30))


def rolling_cart(count, **carrier):
    yaw = math.radians(30)
    cart = thing("o", "cart", 30, 0, yaw=yaw, velocity=(SPEED * math.cos(yaw), SPEED * math.sin(yaw)))
    return frames_of([cart], count, carrier=ego(**carrier))


def wheel_share(part):
    """The share of all points whose rho cos(psi) is at most this: rho is even over 0.3 to 1."""
    steps = 200
    rhos = [0.3 + 0.7 * (i + 0.5) / steps for i in range(steps)]
    return sum(1 - math.acos(max(-1, min(1, part / rho))) / math.pi for rho in rhos) / steps


def wheels_spread(bench):
    frames = see(bench, rolling_cart(DRAWS), flat(micro_motion=True))
    counts, parts = [], []
    for frame in frames:
        hub, points = on_path(frame, "direct")[0], on_path(frame, "wheel")
        counts.append(len(points))
        bench.check([one["contributors"][0]["number"] for one in points] == list(range(1, len(points) + 1)), "numbers")
        bench.check(made(frame, "wheel") == len(points), "count")
        bench.check(abs(hub["cell_range_rate_mps"] - ROLLING) < 1e-12, "the hub has another rate")
        for one in points:
            member = one["contributors"][0]
            bench.check((member["object"], member["reflector"]) == ("o", "hub"), f"{member}")
            bench.check("wheels" in one["effects"], f"label {one['effects']}")
            bench.check((one["cell_range_m"], one["cell_azimuth_rad"]) == (30, 0), "elsewhere")
            bench.check(abs(one["cell_amplitude"] / hub["cell_amplitude"] - 10 ** -0.5) < 1e-14, "not -10 dB")
            parts.append(one["cell_range_rate_mps"] / ROLLING - 1)
    check_mean(bench, counts, 1.5, math.sqrt(1.5), "points on a wheel")
    none = math.exp(-1.5)
    check_mean(bench, [not count for count in counts], none, math.sqrt(none * (1 - none)), "wheels without a point")
    bench.check(min(parts) >= -1 and max(parts) <= 1 and (max(parts) + 1) * ROLLING <= 24.0563, "rates out of bounds")
    squares = (1 - 0.3 ** 3) / 3 / 0.7
    fourths = 3 / 8 * (1 - 0.3 ** 5) / 5 / 0.7
    check_mean(bench, parts, 0, math.sqrt(squares / 2), "rho cos psi")
    check_mean(bench, [part ** 2 for part in parts], squares / 2, math.sqrt(fourths - squares ** 2 / 4), "its square")
    check_even(bench, [wheel_share(part) for part in parts[:3000]], "rho cos psi")


def wheels_roll_over_ground(bench):
    """The ego's own speed moves all rates alike; a wheel that stands, or moves across, has no points."""
    one = flat(micro_motion=True)
    still, driving = (see(bench, rolling_cart(50, **rest), one) for rest in ({}, {"velocity": (10, 0)}))
    for a, b in zip(still, driving):
        for left, right in zip(on_path(a, "wheel"), on_path(b, "wheel")):
            bench.check(abs(left["cell_range_rate_mps"] - 10 - right["cell_range_rate_mps"]) < 1e-12, "another rate")
    for velocity in (0, 0), (0, 10):
        frames = see(bench, frames_of([thing("o", "cart", 30, 0, velocity=velocity)], 50, carrier=ego(velocity=(10, 0))), one)
        bench.check(all(made(frame, "wheel") == 0 for frame in frames), f"{velocity}: points that have the hub's rate")
    frames = see(bench, rolling_cart(50), flat())
    bench.check(all(made(frame, "wheel") == 0 for frame in frames), "without micro_motion")
    slant = see(bench, rolling_cart(50), flat(micro_motion=True, mount_z_m=3))
    bench.check([made(frame, "wheel") for frame in slant] == [made(frame, "wheel") for frame in still], "other draws")


# ---- limbs ---------------------------------------------------------------------------------------


def triangle(x):
    return (x + 1) ** 2 / 2.5 if x < 0 else 1 - (1.5 - x) ** 2 / 3.75


def limbs_swing(bench):
    yaw, place = math.radians(40), (20, 5)
    walker = thing("o", "walker", *place, yaw=yaw, velocity=(1.4 * math.cos(yaw), 1.4 * math.sin(yaw)))
    frames = see(bench, frames_of([walker], 4 * DRAWS), flat(micro_motion=True))
    walking = 1.4 * math.cos(yaw - math.atan2(5, 20))
    counts, swings, offsets = [], [], []
    for frame in frames:
        torso, limbs = on_path(frame, "direct")[0], on_path(frame, "limb")
        counts.append(len(limbs))
        bench.check(made(frame, "limb") == len(limbs), "count")
        for one in limbs:
            ratio = one["contributors"][0]["ercs"] / torso["contributors"][0]["ercs"]
            bench.check(abs(20 * math.log10(ratio) + 6) < 1e-12, f"{20 * math.log10(ratio)} dB")
            bench.check("limbs" in one["effects"], f"label {one['effects']}")
            member = one["contributors"][0]
            x, y = (member["range_m"] * f(member["azimuth_rad"]) for f in (math.cos, math.sin))
            offsets.append((x - place[0]) * math.cos(yaw) + (y - place[1]) * math.sin(yaw))
            aside = (y - place[1]) * math.cos(yaw) - (x - place[0]) * math.sin(yaw)
            bench.check(abs(aside) < 1e-12, f"{aside} m aside")
            swings.append(member["range_rate_mps"] / walking - 1)
    check_mean(bench, counts, 0.5, math.sqrt(0.5), "limbs of a person")
    bench.check(-1 <= min(swings) and max(swings) <= 1.5, "swings out of bounds")
    check_mean(bench, swings, 1 / 6, math.sqrt(4.75 / 18), "swing")
    check_even(bench, [triangle(swing) for swing in swings], "swing")
    check_even(bench, [(offset + 0.35) / 0.7 for offset in offsets], "offset")
    standing = see(bench, frames_of([thing("o", "walker", 20, 5)], 100, carrier=ego(velocity=(10, 0))), flat(micro_motion=True))
    bench.check(all(made(frame, "limb") == 0 for frame in standing), "who stands has limbs")


def limbs_in_view(bench):
    """Limbs that the sensor could not see are not made."""
    for one in flat(micro_motion=True, range_min_m=20), flat(micro_motion=True, range_max_m=20):
        frames = see(bench, frames_of([thing("o", "walker", 20, 0, velocity=(1.4, 0))], 1000), one)
        limbs = [limb["cell_range_m"] for frame in frames for limb in on_path(frame, "limb")]
        bench.check(150 < len(limbs) < 350 and all(one["range_min_m"] <= x <= one["range_max_m"] for x in limbs),
                    f"{len(limbs)} limbs within {one['range_min_m']} to {one['range_max_m']} m")


# ---- clutter -------------------------------------------------------------------------------------

GROUND = {"range_min_m": 2, "range_max_m": 60, "field_of_view_rad": 1.2, "mount_x_m": 2, "mount_y_m": 0.5,
          "mount_yaw_rad": 0.4}
AREA = 1.2 / 2 * (60 ** 2 - 2 ** 2)


def turning_ego():
    return ego(x=100, y=50, yaw=0.7, velocity=(20 * math.cos(0.7) + 1, 20 * math.sin(0.7)), turn=0.3)


def clutter_frames(count, mean, **more):
    return frames_of([], count, carrier=turning_ego(), clutter_per_m2=mean / AREA, clutter_ercs=0.2, **more)


def clutter_lies_on_the_ground(bench):
    frames = see(bench, clutter_frames(DRAWS, 3), flat(**GROUND))
    velocity = (20 + math.cos(0.7) - 0.3 * 0.5, -math.sin(0.7) + 0.3 * 2)
    counts, places, angles, powers = [], [], [], []
    for frame in frames:
        points = on_path(frame, "clutter")
        counts.append(len(points))
        bench.check(made(frame, "clutter") == len(points) == len(frame["targets"]), "count")
        numbers = [one["contributors"][0]["number"] for one in points]
        bench.check(len(set(numbers)) == len(numbers), "numbers")
        for one in points:
            member = one["contributors"][0]
            bench.check((member["object"], member["reflector"]) == ("clutter", "ground"), f"{member}")
            bench.check(member["time_s"] == frame["time_s"] and "clutter" in one["effects"], f"{one}")
            places.append((member["range_m"] ** 2 - 4) / (60 ** 2 - 4))
            angles.append(member["azimuth_rad"] / 1.2 + 0.5)
            powers.append(math.exp(-(member["ercs"] / 0.2) ** 2))
            look = 0.4 + member["azimuth_rad"]
            rate = -velocity[0] * math.cos(look) - velocity[1] * math.sin(look)
            bench.check(abs(member["range_rate_mps"] - rate) < 1e-12, f"rate {member['range_rate_mps']}, expected {rate}")
    check_mean(bench, counts, 3, math.sqrt(3), "points")
    check_mean(bench, [not count for count in counts], math.exp(-3), math.sqrt(math.exp(-3)), "scans without")
    for values, what in ((places, "area"), (angles, "azimuth"), (powers, "power")):
        check_even(bench, values, what)
    for one, other, what in ((places, angles, "area and azimuth"), (angles, powers, "azimuth and power"),
                             (places, powers, "area and power")):
        check_mean(bench, [(a - 0.5) * (b - 0.5) for a, b in zip(one, other)], 0, 1 / 12, what)


def clutter_counts(bench):
    """Overdispersed counts have a wider spread; there is no cap, but too many are refused."""
    for spread in 1, 4:
        frames = see(bench, clutter_frames(DRAWS, 8, clutter_overdispersion=spread), flat(**GROUND))
        counts = [made(frame, "clutter") for frame in frames]
        check_mean(bench, counts, 8, math.sqrt(8 * spread), "points")
        variance = sum((count - 8) ** 2 for count in counts) / len(counts)
        bench.check(abs(variance / (8 * spread) - 1) < 0.12, f"variance {variance}, expected {8 * spread}")
    for conditions in ({"clutter_per_m2": 1}, {"clutter_ercs": 1}):
        frames = see(bench, frames_of([], 5, **conditions), flat(**GROUND))
        bench.check(all(made(frame, "clutter") == 0 for frame in frames), f"{conditions}")
    full = see(bench, frames_of([], 2, clutter_per_m2=1, clutter_ercs=1e3), flat(**GROUND))
    bench.check(all(abs(made(frame, "clutter") - AREA) < 5 * math.sqrt(AREA) for frame in full), "a cap")
    late = see(bench, clutter_frames(50, 3), flat(**GROUND, latency_s=0.25))
    now = see(bench, clutter_frames(50, 3), flat(**GROUND))
    for a, b in zip(late, now):
        for left, right in zip(a["targets"], b["targets"]):
            member = left["contributors"][0]
            bench.check(member["time_s"] == a["time_s"] - 0.25, "time of the measurement")
            bench.check(abs(member["range_rate_mps"] - right["contributors"][0]["range_rate_mps"]) < 1e-12, "another ground")


# ---- the choice of effects ----------------------------------------------------------------------


def scenes(bench):
    for name in "road-mirror", "wheels-and-limbs", "gravel":
        yield name, bench.played("glint-traffic", str(ROOT / f"data/scenarios/{name}.json")), full_sensor()
    everything = [thing("c", "car", 30, 8, yaw=-2, velocity=(-5, -8)), thing("p", "pedestrian", 12, 1, velocity=(0.7, 1)),
                  thing("b", "bicycle", 20, -4, yaw=1, velocity=(2, 3)), thing("g", "guardrail", 20, 12)]
    yield "all at once", frames_of(everything, 60, carrier=turning_ego_at_origin(), road="concrete", rain_mmph=20,
                                   clutter_per_m2=0.01, clutter_ercs=0.2), \
        full_sensor(fluctuation="swerling_1", cell_phase="by_path", unambiguous_range_m=40)


def turning_ego_at_origin():
    return ego(velocity=(12, 0), turn=0.1)


CHAIN = "glint-sensor | glint-noise"


def auto_is_all(bench):
    seen = set()
    for name, frames, one in scenes(bench):
        every = stripped(see(bench, frames, one, "all", CHAIN))
        auto = stripped(see(bench, frames, one, "auto", CHAIN))
        bench.check(auto == every, f"{name}: auto and all differ")
        seen |= {effect for frame in every for target in frame["targets"] for effect in target.get("effects", [])}
    bench.check(set(OURS) <= seen, f"only {sorted(seen)}")


def without_cause(frames, one, effect):
    words = {"two_ray": ["road"], "clutter": ["clutter_per_m2"]}.get(effect, [])
    frames = [{**frame, "conditions": {key: value for key, value in frame.get("conditions", {}).items() if key not in words}}
              for frame in frames]
    return frames, {key: one[key] for key in one if key != "micro_motion" or effect != "wheels,-limbs"}


def switched_off(bench):
    for name, frames, one in scenes(bench):
        for effect in "two_ray", "clutter", "wheels,-limbs":
            without = stripped(see(bench, frames, one, f"all,-{effect}", CHAIN))
            plain = stripped(see(bench, *without_cause(frames, one, effect), "all", CHAIN))
            for frame in without + plain:
                frame.pop("conditions", None)
            bench.check(without == plain, f"{name}: {effect} switched off, and without its cause")


def others_keep_their_draws(bench):
    _, frames, one = list(scenes(bench))[-1]
    every = see(bench, frames, one, APART)
    for effect, path in (("wheels", "wheel"), ("limbs", "limb"), ("clutter", "clutter")):
        for a, b in zip(every, see(bench, frames, one, f"{APART},-{effect}")):
            kept = [target for target in a["targets"] if target["contributors"][0]["path"] != path]
            bench.check(kept == b["targets"], f"{effect} moves other targets")


def perfect_has_none(bench):
    for name, frames, one in scenes(bench):
        for frame in see(bench, frames[:20], one, "all", "glint-sensor-perfect | glint-noise-none"):
            marked = [target for target in frame["targets"] if set(OURS) & set(target.get("effects", []))]
            bench.check(not marked, f"{name}: the perfect sensor has {len(marked)}")


CHECKS = [
    ("the oracle has the figures of MODEL 14.10", oracle_agrees),
    ("compact echoes rise and fade over the road", compact_echoes_fade),
    ("nulls lie where MODEL 14.10 has them", nulls_where_published),
    ("extended echoes hardly fade", extended_echoes_hardly_fade),
    ("the road counts with all its causes only, and not for ghosts", all_causes),
    ("points on a wheel spread as MODEL 14.11 says", wheels_spread),
    ("wheels roll over ground", wheels_roll_over_ground),
    ("limbs swing as MODEL 14.12 says", limbs_swing),
    ("limbs are in view", limbs_in_view),
    ("clutter lies evenly on the ground and stands", clutter_lies_on_the_ground),
    ("how much clutter there is", clutter_counts),
    ("auto leaves out none", auto_is_all),
    ("switched off, they leave no trace", switched_off),
    ("leaving one out moves no other", others_keep_their_draws),
    ("the perfect sensor has none", perfect_has_none),
]


if __name__ == "__main__":
    model.run(__doc__, add_vehicles, CHECKS)
