"""The effects beyond the paper on random scenes, against an independent computation (oracle_effects.py).

Usage: python3 tests/oracle/effects_oracle.py BIN_DIR [FRAMES]

FRAMES (6) of every density with every suite below; half of them with the conditions that a random scene draws, half with a road, rain, fog and other radars. Exit status 1 if
any check fails.
"""

import csv
import json
import math
import random
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import model  # noqa: E402
import oracle  # noqa: E402
import oracle_effects  # noqa: E402
import random_scenes  # noqa: E402
from sizes import quick  # noqa: E402

QUIET = ["angle_noise", "range_noise", "false_alarms", "fluctuation", "level", "wheels", "limbs", "clutter", "coherence"]
EFFECTS_OFF = [[], ["diffraction"], ["elevation", "range_migration"], ["height", "curvature"], ["ghosts", "latency"],
               ["ambiguity", "interference", "quantisation", "two_ray"], ["diffraction", "misalignment", *oracle_effects.ATTENUATIONS]]
RELATIVE, ABSOLUTE, FAINT = 1e-9, 1e-9, 1e-11
# In a deep shadow, or nearly out of sight, a cross section depends on the last digits of its place.
STEEP = 1e-7


# ---- the suites ------------------------------------------------------------------------------------


def described():
    """The members of a sensor, with a value for each that causes an effect."""
    return {"mount_z_m": 0.6, "elevation_half_width_rad": 0.12, "diffraction": True, "curved_sides": True,
            "latency_s": 0.04, "bounces": 3, "unambiguous_range_m": 61.7, "unambiguous_rate_mps": 17.3,
            "receiver_bandwidth_hz": 4e7, "noise_figure_db": 12, "antenna_gain_dbi": 12, "chirp_slope_hzps": 5e13,
            "chirp_s": 2e-5, "misalignment_rad": -0.02, "radome_bias_rad": 0.015, "radome_period_rad": 0.6,
            "radome_phase_rad": 0.3, "range_migration": "rectangular", "range_step_m": 0.1, "range_rate_step_mps": 0.05, "azimuth_step_rad": 0.002,
            "list_order": "nearest", "list_limit": 25}


def suites():
    """(title, document): the shipped sensor of all effects, and wide ones with dipoles and with a table."""
    full = json.loads((model.ROOT / "data/sensors/lrr77-full.json").read_text())
    wide = json.loads((model.ROOT / "data/sensors/corner77-every-frame.json").read_text())
    for sensor in full["sensors"] + wide["sensors"]:
        sensor["antenna_table"] = str(model.ROOT / "data/sensors" / sensor["antenna_table"])
    for sensor in wide["sensors"]:
        sensor.update(described())
    left, right = wide["sensors"]
    left.update(antenna_pattern="dipole_pair", field_of_view_rad=3.0, mount_yaw_rad=0.4, calibration_range_m=60,
                unambiguous_middle_mps=4.1, range_limits=[{"azimuth_rad": 0.2, "range_max_m": 80},
                                                          {"azimuth_rad": 1.1, "range_max_m": 25}])
    left.pop("antenna_table")
    right.update(carrier_hz=24.125e9, polarization="horizontal", mount_z_m=0.3, mount_yaw_rad=-2.2, list_order="strongest", list_limit=8,
                 cell_range_m=1.5, cell_range_rate_mps=0.5, bounces=2, cycle_s=0.07, if_sampling="complex")
    right.pop("unambiguous_range_m")
    return [("lrr77-full", full), ("all members, wide", wide)]


def rows_of(sensor):
    if "antenna_table" not in sensor:
        return None
    with open(sensor["antenna_table"], newline="", encoding="utf-8") as file:
        return [tuple(float(row[name]) for name in ("azimuth_rad", "sum", "delta")) for row in csv.DictReader(file)]


def shaken(item, draw):
    """A scene of low and high things, some of which turn."""
    objects = [dict(thing, height_m=draw.choice([0, 0, draw.uniform(0.3, 1.2), draw.uniform(0.3, 4)]),
                    yaw_rate_radps=draw.choice([0, draw.uniform(-1, 1)])) for thing in item["objects"]]
    return dict(item, objects=objects, time_s=draw.randrange(1000) * item["interval_s"])


def walled(draw, number):
    """A scene of a road along walls, rails and lorries, some in line, some on the move, with other things
    between them."""
    yaw = draw.uniform(-3, 3)

    def put(name, kind, x, y, turn, speed, length=0.0):
        c, s = math.cos(yaw), math.sin(yaw)
        return model.thing(name, kind, 100 + c * x - s * y, -40 + s * x + c * y, yaw + turn, model.ahead(speed, yaw),
                           length=length)

    objects = [put("ego", "car", 0, 0, draw.uniform(-0.2, 0.2), draw.uniform(-30, 30))]
    for n in range(draw.randint(2, 5)):
        kind, side = draw.choice(["wall", "guardrail", "wall", "truck", "articulated_truck", "bus"]), draw.choice([-1, 1])
        place, speed = (draw.uniform(-30, 90), side * draw.uniform(2.5, 12)), draw.choice([0, draw.uniform(-25, 25)])
        turn, length = draw.choice([0, 0, math.pi, draw.uniform(-0.3, 0.3)]), draw.uniform(5, 80)
        objects.append(put(f"m{n}", kind, *place, turn, speed, length if kind in ("wall", "guardrail") else 0))
        if kind == "wall" and turn == 0:
            objects.append(put(f"m{n}_next", kind, place[0] + length / 2 + 5, place[1], 0, speed))
    for n in range(draw.randint(2, 7)):
        kind = draw.choice(["car", "van", "pedestrian", "post", "bicycle", "motorcycle", "truck", "wall"])
        objects.append(put(f"o{n}", kind, draw.uniform(-20, 100), draw.uniform(-9, 9), draw.uniform(-3, 3), draw.uniform(-30, 30)))
    return dict(model.frame(objects, scene=f"walled-{number}"), interval_s=0.05)


def scenes(bench, density, suite, frames, first):
    if density == "walled":
        return [walled(random.Random(f"{first} {n}"), n) for n in range(frames)]
    return bench.played(*random_scenes.source(density, suite, frames, first=first), "--draw-conditions")


def with_conditions(item, number):
    """Every other scene keeps the conditions that it was drawn with."""
    if number % 3:
        item = shaken(item, random.Random(number))
    if number % 2 == 0:
        return item
    others = [thing["id"] for thing in item["objects"] if thing["id"] != item["ego"]][:3]
    radars = [{"object": name, "eirp_dbm": 20 + 3 * n, "slope_hzps": (-7.5e12, 7.6e12, 7.5e12)[n], "hit_share": 0.05 * n + 0.01}
              for n, name in enumerate(others if number % 4 == 1 else [])]
    return dict(item, conditions={"road": ("asphalt", "concrete", "unknown")[number % 3], "rain_mmph": (2.5, 40)[number % 3 == 0], "fog_gpm3": 0.3 * (number % 5), "interferers": radars})


# ---- the comparison ----------------------------------------------------------------------------------


class Tally(dict):
    def add(self, name, count=1):
        self[name] = self.get(name, 0) + count

    def __str__(self):
        return ", ".join(f"{name} {count}" for name, count in self.items())


def key_of(item):
    return item["object"], item["reflector"], item["path"], item.get("mirror", ""), item.get("number", 0)


def near(a, b, absolute=ABSOLUTE, relative=RELATIVE):
    return abs(a - b) <= max(relative * max(abs(a), abs(b)), absolute)


def compare_set(bench, where, told, mine, doubtful, what):
    """Compares the entries that both sides have; doubtful ones may be missing on one side. False if any is
    missing."""
    odd = told.keys() ^ mine.keys()
    for key in sorted(odd - doubtful):
        bench.check(False, f"{where}: {what} {key} of the {'program' if key in told else 'oracle'} only")
    bench.check(True, "")
    return not odd


def compare_echo(bench, where, told, mine, time):
    for name, value in (("range_m", mine.range), ("azimuth_rad", mine.azimuth), ("range_rate_mps", mine.rate),
                        ("departure_azimuth_rad", mine.departure)):
        bench.check(near(told.get(name, 0), value), f"{where} {name}: {told.get(name, 0)!r}, oracle {value!r}")
    bench.check(near(told["ercs"], mine.ercs, FAINT, STEEP), f"{where} ercs: {told['ercs']!r}, oracle {mine.ercs!r}")
    bench.check(near(told["time_s"], time), f"{where} time_s: {told['time_s']!r}, oracle {time!r}")


def compare_losses(bench, where, answer, name, made):
    told = {key_of(one): (group["reason"], one.get("by")) for group in answer["lost"]
            if group["sensor"] == name and group["stage"] == "ideal" for one in group["echoes"]}
    # Posts beyond the range are pairs only where a row was expanded a little farther than needed.
    told = {key: value for key, value in told.items() if key in made.lost or value[0] != "out_of_range" or "_" not in key[1]}
    compare_set(bench, where, told, made.lost, made.doubtful, "loss")
    for key in told.keys() & made.lost.keys() - made.doubtful:
        reason, by = made.lost[key]
        bench.check(told[key][0] == reason, f"{where}: {key} lost as {told[key]}, oracle {reason}")
        bench.check(reason != "blocked" or told[key][1] in by, f"{where}: {key} blocked by {told[key][1]}, oracle {by}")


def compare_cell(bench, where, told, mine, made):
    size = mine.amplitude
    for name, value in (("range_m", mine.range), ("range_rate_mps", mine.rate)):
        bench.check(near(told[name], value, STEEP * 0.1), f"{where} {name}: {told[name]!r}, oracle {value!r}")
    bench.check(near(told["amplitude"], size, 0, STEEP), f"{where} amplitude: {told['amplitude']!r}, oracle {size!r}")
    for name, value in (("sum", mine.total), ("delta", mine.delta)):
        pointer = complex(told[name + "_re"], told[name + "_im"])
        bench.check(abs(pointer - value) <= STEEP * max(size, abs(value)), f"{where} {name}: {pointer}, oracle {value}")
    bench.check(near(told.get("interference", 0), made.interference, 0),
                f"{where} interference: {told.get('interference', 0)!r}, oracle {made.interference!r}")
    if mine.azimuth is not None and mine.sine > 1e-9 and abs(mine.total) > 1e-3 * size:
        bench.check(near(told["azimuth_rad"], mine.azimuth, STEEP), f"{where} azimuth: {told['azimuth_rad']!r}, oracle {mine.azimuth!r}")
    for member in told["members"]:
        weight = mine.weights[key_of(member)]
        bench.check(near(member["weight"], weight, FAINT, STEEP), f"{where} weight: {member['weight']!r}, oracle {weight!r}")


def compare_dark(bench, where, answer, name, made):
    told = {key_of(one): one.get("shortfall_db", 0) for group in answer["lost"]
            if group["sensor"] == name and group["reason"] == "below_threshold" for one in group["echoes"]}
    dark = {key: 20 * math.log10(made.threshold / cell.amplitude) for cell in made.dark for key in cell.keys}
    if compare_set(bench, where, told, dark, set(), "below the threshold"):
        for key, short in dark.items():
            bench.check(short > 150 or near(told[key], short, 1e-6), f"{where} {key} short of {told[key]!r} dB, oracle {short!r}")


def compare_targets(bench, where, answer, name, made):
    told = [target for target in answer["targets"] if target["sensor"] == name]
    keys = [frozenset(key_of(one) for one in target["contributors"]) for target in told]
    mine = [target.cell.keys for target in made.targets]
    values = [t.unrounded for t in made.targets]
    ties = any(near(a, b, 1e-7) for a, b in zip(values, values[1:] + [t.unrounded for t in made.beyond[:1]]))
    strengths = sorted(t.amplitude for t in made.targets + made.beyond)
    ties = ties or any(near(a, b, 0, 1e-6) for a, b in zip(strengths, strengths[1:]))
    if ties and keys != mine:
        return
    if not bench.check(keys == mine, f"{where}: {len(keys)} targets, oracle {len(mine)}, or in another order"):
        return
    for number, (target, own) in enumerate(zip(told, made.targets)):
        here = f"{where} target {number}"
        level = 20 * math.log10(own.amplitude) if own.amplitude > 0 else -math.inf
        bench.check(near(target["amplitude_db"], level, 1e-6 * max(1.0, own.cell.amplitude / own.amplitude)),
                    f"{here} amplitude_db {target['amplitude_db']!r}, oracle {level!r}")
        if own.doubtful:
            continue
        bench.check(near(target["range_m"], own.range, 1e-8), f"{here} range_m {target['range_m']!r}, oracle {own.range!r}")
        bench.check(near(target["range_rate_mps"], own.rate, 1e-8), f"{here} rate {target['range_rate_mps']!r}, oracle {own.rate!r}")
        if own.azimuth is not None and own.cell.sine > 1e-9 and abs(own.cell.total) > 1e-3 * own.cell.amplitude:
            bench.check(near(target["azimuth_rad"], own.azimuth, STEEP), f"{here} azimuth {target['azimuth_rad']!r}, oracle {own.azimuth!r}")


def compare(bench, where, answer, name, made, tally):
    told = {key_of(one): one for one in answer["echoes"] if one["sensor"] == name}
    alike = compare_set(bench, where, told, made.echoes, made.doubtful, "echo")
    for key in told.keys() & made.echoes.keys() - made.doubtful:
        compare_echo(bench, f"{where} {key}", told[key], made.echoes[key], made.time)
        tally.add("direct" if key[2] == "direct" else "ghosts")
    compare_losses(bench, where, answer, name, made)
    tally.add("losses", len(made.lost))
    tally.add("doubtful", len(made.doubtful))
    if not alike or made.doubtful & made.echoes.keys():
        tally.add("scans skipped")
        return
    cells = {frozenset(key_of(one) for one in cell["members"]): cell for cell in answer["cells"] if cell["sensor"] == name}
    mine = {cell.keys: cell for cell in made.cells}
    if made.doubtful_cells and cells.keys() != mine.keys():
        tally.add("scans skipped")
        return
    if not bench.check(cells.keys() == mine.keys(), f"{where}: {len(cells)} cells, oracle {len(mine)}"):
        return
    for number, (keys, cell) in enumerate(mine.items()):
        compare_cell(bench, f"{where} cell {number}", cells[keys], cell, made)
    compare_dark(bench, where, answer, name, made)
    compare_targets(bench, where, answer, name, made)
    tally.add("cells", len(cells))
    tally.add("targets", len(made.targets))


# ---- all of it ---------------------------------------------------------------------------------------


def answers(bench, items, suite, effects):
    ideal = ["glint-ideal", "--sensors", suite, "--sections", "account,margins,echoes,cells", "--effects", effects]
    return bench.through(items, ["glint-extract"], ideal, ["glint-sensor"], ["glint-noise"])


def effects_but(bench, off):
    """What the program simulates, as --effects has it, and the set for the oracle."""
    listed = subprocess.run([str(bench.bin / "glint"), "--list", "effects"], env=bench.env, capture_output=True, text=True, check=True)
    names = {line.split()[0] for line in listed.stdout.splitlines()}
    return ",".join(["all", *("-" + name for name in [*QUIET, *off])]), names - set(QUIET) - set(off)


def check_suite(bench, title, document, density, frames, turn, tally):
    suite, off = bench.write_suite(document), EFFECTS_OFF[turn]
    items = scenes(bench, density, suite, frames, first=1000 * (1 + turn))
    items = [with_conditions(item, n) for n, item in enumerate(items)]
    effects, simulated = effects_but(bench, off)
    done = answers(bench, items, suite, effects)
    bench.check(len(done) == len(items), f"{len(items)} frames in, {len(done)} out")
    for item, answer in zip(items, done):
        for sensor, view in zip(document["sensors"], answer["sensors"]["list"]):
            measured = oracle_effects.instant(sensor, item) is not None
            bench.check(view["measured"] == measured, f"{title} {item['scene']} {sensor['name']}: measured")
            if not measured:
                continue
            made = oracle_effects.scan(item, bench.vehicles, sensor, simulated, rows_of(sensor))
            compare(bench, f"{title} {item['scene']} {sensor['name']} without {off}", answer, sensor["name"], made, tally)
            tally.add("scans")


def jointed(yaw, aside):
    """A scene of two walls in line, and a post that is seen close beside their joint; rounding decides how
    they meet."""
    def put(name, kind, x, y, length=0):
        c, s = math.cos(yaw), math.sin(yaw)
        return model.thing(name, kind, c * x - s * y, s * x + c * y, yaw, length=length)

    things = [put("ego", "car", 0, 0), put("post", "post", 22.1 + 2 * aside, 0.75), put("w1", "wall", 7.1, 4.1, 10),
              put("w2", "wall", 17.1, 4.1, 10)]
    return dict(model.frame(things, scene=f"joint of walls turned by {yaw}, {aside} m aside"), interval_s=0.05)


def check_joints(bench):
    tally, document = Tally(), suites()[1][1]
    document["sensors"] = document["sensors"][:1]
    items = [jointed(yaw, aside) for yaw in (0, 0.3, 0.7, 2.0) for aside in (-0.05, -0.02, 0.02, 0.05)]
    effects, simulated = effects_but(bench, [])
    done = answers(bench, items, bench.write_suite(document), effects)
    for item, answer in zip(items, done):
        [sensor] = document["sensors"]
        made = oracle_effects.scan(item, bench.vehicles, sensor, simulated, rows_of(sensor))
        compare(bench, item["scene"], answer, sensor["name"], made, tally)
    bench.check(tally["ghosts"] >= len(items), f"ghosts beside joints: {tally}")
    bench.end_group("ghosts beside the joint of two walls", f", {tally}")


# Undersides in m, so low and so high that lines by the road pass beside, under and through them.
CLEARANCES = {"car": 0.15, "van": 0.25, "truck": 0.9, "bus": 0.3, "articulated_truck": 1.1}


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    frames = int(sys.argv[2]) if len(sys.argv) == 3 else quick(2, 6)
    with tempfile.TemporaryDirectory() as scratch:
        bench = model.Bench(sys.argv[1], scratch)
        for title, document in suites():
            for name, clearance_m in CLEARANCES.items() if title == "all members, wide" else ():
                reflectors = bench.vehicles[name]["reflectors"]
                bench.add_vehicle(name, dict(bench.vehicles[name], reflectors=dict(reflectors, clearance_m=clearance_m)))
            for density in [*random_scenes.DENSITIES, "walled"]:
                tally = Tally()
                for turn in range(len(EFFECTS_OFF)):
                    check_suite(bench, title, document, density, frames, turn, tally)
                most = 0.25 if density == "adversarial" else 0.01
                bench.check(tally.get("scans skipped", 0) <= most * tally["scans"], f"skipped too many: {tally}")
                bench.end_group(f"effects against an independent computation, {title}, {density}", f", {tally}")
        check_joints(bench)
    sys.exit(bench.failures > 0)


if __name__ == "__main__":
    main()
