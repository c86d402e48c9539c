"""Suites that scripts/make-radar writes from data sheets: every figure comes back, and contradictions are refused.

Usage: python3 tests/oracle/my_radar.py BIN_DIR

What `glint --datasheet` prints is compared with the sheet: within 1 %, and 6 % for deviations, which it prints with two digits.
In the whole chain probabilities of detection are counted, to five standard errors, and deviations of azimuth measured, within
10 %. Exit status 1 if any check fails.
"""
import csv
import json
import math
import os
import random
import re
import subprocess
import sys

sys.dont_write_bytecode = True
import data_sheet  # noqa: E402
import model  # noqa: E402
from effects_noise import frames_of, listen, rms  # noqa: E402
from sizes import quick  # noqa: E402
from suites import whole as whole_suite  # noqa: E402

SCRIPT = model.ROOT / "scripts" / "make-radar"
PLAIN = {"range_max_m": 150, "view_half_width_deg": 30, "range_resolution_m": 1, "speed_resolution_mps": 0.2}
DRAWS = quick(600, 1500)


def shipped_suites():
    """The paths of suites; a link is another name of one."""
    return [path for path in sorted((model.ROOT / "data/sensors").glob("*.json")) if not path.is_symlink()]


def made(bench, sheet):
    """The script's result on a sheet, and the suite's path."""
    path, out = bench.scratch / "sheet.json", bench.scratch / "made.json"
    path.write_text(json.dumps(sheet))
    return run(path, "-o", out), out


def run(*words, limit=None, **variables):
    """The script's result. No file may be longer than `limit` KiB."""
    words = [SCRIPT, *words] if limit is None else ["bash", "-c", f'ulimit -f {limit}; exec "$@"', "-", SCRIPT, *words]
    return subprocess.run(words, capture_output=True, check=False, text=True, env=os.environ | variables)


def reads(bench, suite):
    """What glint says against a suite; an empty text if it takes it."""
    return subprocess.run([bench.bin / "glint", "--datasheet", suite], capture_output=True, check=False, text=True).stderr


def printed(bench, sheet):
    """{sensor: its part of the data sheet} and the assumptions."""
    done, out = made(bench, sheet)
    if done.returncode != 0:
        bench.check(False, f"{sheet}: {done.stderr}")
        return {}, ""
    text = subprocess.run([str(bench.bin / "glint"), "--datasheet", str(out)], capture_output=True, check=True, text=True).stdout
    text, _, assumed = text.partition("\nassumed\n")
    parts = re.split(r"^(\w+): at ", text, flags=re.M)[1:]
    return dict(zip(parts[::2], parts[1::2])), assumed


def sensors_of(bench, sheet):
    """The sensors of the suite that the script makes, alone on their vehicle and without false alarms."""
    done, out = made(bench, sheet)
    bench.check(done.returncode == 0, f"{sheet}: {done.stderr}")
    sensors = json.loads(out.read_text())["sensors"]
    for one in sensors:
        one.update(mount_x_m=0, mount_y_m=0, mount_yaw_rad=0, false_alarms=0)
        for member in ("antenna_table", "azimuth_curve", "azimuth_floor_curve"):
            if member in one:
                one[member] = str((bench.scratch / one[member]).resolve())
        one.pop("cycle_s", None)  # every frame has a scan
    return sensors


def numbers(part, line):
    found = re.search(rf"^  {line}\s(.*)$", part, re.M)
    return [float(one) for one in re.findall(r"-?\d+\.?\d*(?:e[-+]\d+)?", found[1])] if found else None


def hold(bench, what, value, expected, tolerance=0.01):
    bench.check(value is not None and abs(value - expected) <= tolerance * abs(expected) + 1e-9,
                f"{what}: {value}, the sheet has {expected}")


def last_accuracy(part):
    """Range, rate and the four azimuths 20 dB above the threshold, and those azimuths' directions."""
    rows = re.findall(r"^  SNR +\S+ dB +(.*)$", part, re.M)
    at = re.search(r"azimuth, degrees, at(.*)$", part, re.M)[1].split()
    return [float(word) for word in rows[2].split()], [float(word) for word in at]


def reach_m(part, degrees, dbsm):
    """The range up to which 9 of 10 are detected, and whether it is the limit."""
    for row in re.findall(r"^ +([\d.]+) degrees((?: +\S+){6})$", part, re.M):
        if abs(float(row[0]) - degrees) < 0.01 * degrees + 1e-9:
            word = row[1].split()[1 + dbsm // 5]
            return float(word.lstrip(">")), word[0] == ">"
    return None, None


def public_sheets(bench):
    far, near = (printed(bench, json.loads((model.ROOT / "data/sheets/ars408-21.json").read_text()))[0][name]
                 for name in ("front_far", "front_near"))
    for part, range_m, view_deg, cell_m, kmh, sigma_m in ((far, 250, 9, 1.79, 0.37, 0.4), (near, 100, 60, 0.39, 0.43, 0.1)):
        hold(bench, "range_max_m", numbers(part, "range")[1], range_m)
        hold(bench, "view", -numbers(part, "field of view")[0], view_deg)
        hold(bench, "range resolution", numbers(part, "resolution")[0], cell_m)
        hold(bench, "speed resolution", numbers(part, "resolution")[1], kmh / 3.6)
        rates = numbers(part, "unambiguous")
        hold(bench, "approaching", rates[0], -200 / 3.6)
        hold(bench, "receding", rates[1], 400 / 3.6)
        hold(bench, "cycle", numbers(part, "update")[0], 72)
        hold(bench, "list", numbers(part, "list")[0], 250)
        accuracy, at = last_accuracy(part)
        hold(bench, "range accuracy", accuracy[0], sigma_m, 0.06)
        hold(bench, "speed accuracy", accuracy[1], 0.1 / 3.6, 0.06)
        for degrees, value in zip(at, accuracy[2:]):
            expected = 0.1 if part is far else 0.3 + 0.7 * degrees / 45 if degrees <= 45 else 1 + 4 * (degrees - 45) / 15
            hold(bench, f"azimuth accuracy at {degrees}", value, expected, 0.06)
        hold(bench, "a car on boresight", reach_m(part, 0, 10)[0], range_m)
    for degrees, limit_m in ((0, 100), (20, 100 - 30 * 20 / 45), (60, 20)):
        value, ends = reach_m(near, degrees, 20)
        hold(bench, f"range limit at {degrees} degrees", value, limit_m)
        bench.check(ends, f"no limit at {degrees} degrees")
    part = printed(bench, json.loads((model.ROOT / "data/sheets/ars548-rdi.json").read_text()))[0]["front"]
    for line, values in (("range", [0.2, 300]), ("field of view", [-60]), ("resolution", [0.22, 0.1]), ("carrier", [77]), ("update", [50]),
                         ("unambiguous", [-200 / 3.6, 400 / 3.6]), ("list", [800]), ("array", [1, 74, 74])):
        for value, expected in zip(numbers(part, line), values):
            hold(bench, line, value, expected)
    hold(bench, "azimuths apart", numbers(part, "cell")[2], 1.2)
    hold(bench, "height of the beam", numbers(part, "element's beam")[1], 28)
    for value, expected in zip(numbers(part, "elevation"), (-14, 1, 0.288, 0.096)):  # the second is the 1 of "1 sigma"
        hold(bench, "elevation", value, expected, 0.06)
    hold(bench, "azimuth accuracy", last_accuracy(part)[0][2], 0.1, 0.06)
    for dbsm in (0, 10):
        hold(bench, f"{dbsm} dBsm at 25 dB a decade", reach_m(part, 0, dbsm)[0], 300 * 10 ** ((dbsm - 10) / 25))
    part = printed(bench, json.loads((model.ROOT / "data/sheets/umrr-11-type-132.json").read_text()))[0]["front"]
    for line, values in (("range", [1, 175]), ("field of view", [-16]), ("resolution", [1.8, 0.14]), ("carrier", [77])):
        for value, expected in zip(numbers(part, line), values):
            hold(bench, line, value, expected)
    hold(bench, "azimuth accuracy", last_accuracy(part)[0][2], 0.25, 0.06)


def other_words(bench):
    """Other spellings of the same figures make the same suite; mounts count from bumpers and sides."""
    one, same = ({**PLAIN, "receding_max_mps": 50, "approaching_max_mps": 50, "yaw_left_deg": -40},
                 {"range_max_m": 150, "view_full_width_deg": 60, "range_cell_m": 2, "speed_resolution_kmh": 0.72,
                  "speed_max_kmh": 180, "yaw_right_deg": 40})
    parts = [printed(bench, sheet)[0]["front"] for sheet in (one, same)]
    bench.check(parts[0] == parts[1], f"other words, other suites: {parts}")
    part = printed(bench, {**PLAIN, "vehicle_length_m": 5, "vehicle_width_m": 2, "behind_front_bumper_m": 0.4,
                           "inside_right_side_m": 0.1, "height_m": 0.6, "yaw_right_deg": 45,
                           "elevation_one_way_full_width_deg": 14})[0]["front"]
    bench.check(part.startswith("x 2.1 m, y -0.9 m, z 0.6 m, looking to -45 degrees"), part[:60])
    hold(bench, "elevation", numbers(part, "beam")[1], 14)
    other = printed(bench, {**PLAIN, "range_max_m": 150, "range_resolution_m": 1.5, "update_rate_hz": 20, "speed_accuracy_mps": 0.04})[0]
    part = {"range_max_m": 150, "view_half_width_deg": 30, "range_resolution_cm": 150, "cycle_ms": 50, "speed_resolution_mps": 0.2,
            "speed_accuracy_mph": 0.04 / 0.44704}
    bench.check(printed(bench, part)[0] == other, f"centimetres, hertz and miles: {other}")
    for figure, place in (("behind_front_bumper_m", "x 2 m"), ("ahead_of_rear_bumper_m", "x -2 m"), ("ahead_of_middle_m", "x 0.25 m"),
                          ("inside_left_side_m", "y 0.65 m"), ("inside_right_side_m", "y -0.65 m"), ("left_of_middle_m", "y 0.25 m")):
        part = printed(bench, {**PLAIN, figure: 0.25})[0]["front"]
        bench.check(place in part.splitlines()[0], f"{figure} 0.25: {part.splitlines()[0]}")
    part = printed(bench, {"range_max_m": 150, "view_half_width_deg": 9, "range_accuracy_m": 0.1, "speed_accuracy_mps": 0.05})[0]["front"]
    for value, expected in zip(numbers(part, "resolution"), (0.4, 0.2)):
        hold(bench, "resolution by accuracy", value, expected)


def antennas(bench):
    """Beams by width and by gain, deviations by elements."""
    for sheet, width_deg in (({"beam_two_way_full_width_deg": 20}, 20), ({"beam_one_way_half_width_deg": 10}, 20 / math.sqrt(2)),
                             ({"gains": [{"azimuth_deg": 0, "one_way_db": 0}, {"azimuth_deg": 10, "one_way_db": -3},
                                         {"azimuth_deg": 35, "one_way_db": -12}]}, 10)):
        hold(bench, f"beam of {sheet}", numbers(printed(bench, PLAIN | sheet)[0]["front"], "beam")[0], width_deg, 0.02)
    part = printed(bench, PLAIN | {"receive_positions_wavelengths": [0, 0.5, 1, 1.5], "transmit_positions_wavelengths": [0, 2]})[0]["front"]
    accuracy, at = last_accuracy(part)
    for degrees, value in zip(at, accuracy[2:]):
        expected = math.degrees(0.39 / (4 * math.cos(math.radians(degrees)) * 10 ** (31.404 / 20)))
        hold(bench, f"deviation by elements at {degrees} degrees", value, expected, 0.06)
    hold(bench, "virtual elements", numbers(part, "array")[2], 8)
    hold(bench, "their steps", numbers(part, "array")[3], 0.5)
    done, _ = made(bench, PLAIN | {"accuracy_snr_db": 8})
    bench.check(done.returncode == 0, f"an accuracy is assumed that one pair of beams does not have: {done.stderr}")
    for view_deg, degrees in ((9, 1.6), (60, 1.2), (60, 3.2), (60, 14), (85, 10)):
        part = printed(bench, PLAIN | {"view_half_width_deg": view_deg, "azimuth_resolution_deg": degrees})[0]["front"]
        hold(bench, "azimuth resolution", numbers(part, "cell")[2], degrees)


def shipped_tables(bench):
    """The antennas of the shipped suites are two apertures side by side, as data/sensors/README.md has them."""
    for name, wavelengths, edge_deg in (("corner77", 0.35, 75), ("lrr77", 2.2, 12)):
        rows = [tuple(map(float, row)) for row in list(csv.reader((model.ROOT / f"data/antennas/{name}.csv").open(encoding="ascii")))[1:]]
        hold(bench, f"edge of {name}", math.degrees(rows[-1][0]), edge_deg, 1e-9)
        for azimuth_rad, total, delta in rows:
            u = math.pi * wavelengths * math.sin(azimuth_rad)
            lit = math.sqrt(math.cos(azimuth_rad)) * (math.sin(u) / u if u else 1)
            hold(bench, f"sum of {name} at {azimuth_rad}", total, lit * math.cos(u), 1e-10)
            hold(bench, f"delta of {name} at {azimuth_rad}", delta, lit * math.sin(u), 1e-10)


def chances(bench):
    """As many echoes are detected as stated, and false alarms are as many as stated."""
    detected = {"detected_dbsm": 10, "detected_at_m": 80, "false_alarm_rate": 1e-5}
    levels = {"extends": "radarscenes77-full", "detected_dbsm": 10, "detected_at_m": 80}
    full = PLAIN | detected | {"members": {"first_threshold": "full"}}
    for sheet, law, chance in ((PLAIN | detected, "none", 0.9), (PLAIN | detected, "none", 0.3), (full, "swerling_1", 0.6),
                               (PLAIN | detected, "swerling_1", 0.6), (PLAIN | detected, "swerling_3", 0.8),
                               (levels, "none", 0.7), (levels, "swerling_1", 0.9)):
        sensor = sensors_of(bench, sheet | {"fluctuation": law, "detection_probability": chance})[0]
        share = len(data_sheet.look(bench, sensor, "rcs_10", 79.99, 0, DRAWS)) / DRAWS
        slack = 5 * math.sqrt(chance * (1 - chance) / DRAWS) + 0.002
        bench.check(abs(share - chance) < slack, f"{law}: {share} detected, not {chance}")
    lines = [{"dbsm": 10, "at_m": 140, "probability": 0.9}, {"dbsm": 0, "at_m": 70, "probability": 0.7}]
    for law in ("none", "swerling_1"):
        sensor = sensors_of(bench, PLAIN | {"detections": lines, "false_alarm_rate": 1e-5, "fluctuation": law})[0]
        for line in lines:
            chance, kind = line["probability"], f"rcs_{line['dbsm']}"
            share = len(data_sheet.look(bench, sensor, kind, line["at_m"] - 0.01, 0, DRAWS)) / DRAWS
            bench.check(abs(share - chance) < 5 * math.sqrt(chance * (1 - chance) / DRAWS) + 0.002, f"{law}, {line}: {share} detected")
    for sheet in ({"detected_at_m": 140}, {"detections": [{"object": "car", "at_m": 140}]}):
        hold(bench, f"0 dBsm with {sheet}, at 25 dB a decade", reach_m(printed(bench, PLAIN | sheet)[0]["front"], 0, 0)[0], 140 * 10 ** (-10 / 25), 0.02)
    part = printed(bench, PLAIN | {"detections": [{"object": "car", "at_m": 140}, {"object": "pedestrian", "at_m": 60}]})[0]["front"]
    for dbsm in (0, 10):  # 13 dB are lg(140/60) decades
        hold(bench, f"{dbsm} dBsm between two lines", reach_m(part, 0, dbsm)[0], 140 * (140 / 60) ** ((dbsm - 10) / 13), 0.02)
    part = printed(bench, PLAIN | {"false_alarms_per_scan": 2})[0]["front"]
    hold(bench, "false alarms", numbers(part, "false alarms")[0], 2)


def posts_of(bench, sensor, places, draws):
    """Targets of a scan with posts at (metres, degrees, metres a second); each is 20 dB over the threshold in the first place's gain."""
    (range_m, degrees, _), array = places[0], "azimuth_curve" in sensor
    with open(sensor["azimuth_curve" if array else "antenna_table"], encoding="ascii") as table:
        near = min(list(csv.reader(table))[1:], key=lambda row: abs(float(row[0]) - math.radians(degrees)))
    gain = 10 ** (float(near[1]) / 20) if array else float(near[1])
    ercs = 10 * sensor["calibration_ercs"] * (range_m / sensor["calibration_range_m"]) ** sensor["exponent"] / gain
    bench.add_vehicle("strong", model.vehicle(0.1, 0.1, points=[model.everywhere("p", ercs)]))
    things = [model.thing(f"post{i}", "strong", *model.polar(at_m, at_deg), velocity=(mps, 0)) for i, (at_m, at_deg, mps) in enumerate(places)]
    frames = [dict(one, scene=f"s{one['frame']}", frame=0, last=True) for one in frames_of(things, draws)]
    return [one["targets"] for one in listen(bench, frames, [sensor])]


def edges(bench):
    """In the whole chain, up to the borders of the views: accuracy of azimuths, least distances, ends of the spans of speeds."""
    ars408 = json.loads((model.ROOT / "data/sheets/ars408-21.json").read_text())
    far, near = sensors_of(bench, ars408)
    sided = sensors_of(bench, PLAIN | {"azimuth_accuracies": [{"azimuth_deg": -30, "accuracy_deg": 0.5}, {"azimuth_deg": 30, "accuracy_deg": 2}],
                                       "azimuth_step_deg": 0.2})[0]
    for sensor, degrees, stated in ((far, 0, 0.1), (far, -8.9, 0.1), (near, 0, 0.3), (near, 45, 1), (near, -59.5, 4.87), (sided, -29, 0.53),
                                    (sided, 29, 1.97)):
        lists = posts_of(bench, sensor, [(15, degrees, 0)], DRAWS)
        error_deg = rms([math.degrees(one["azimuth_rad"]) - degrees for targets in lists for one in targets])
        bench.check(abs(error_deg / stated - 1) < 0.1, f"{sensor['name']}: azimuths scatter by {error_deg} at {degrees} degrees, not {stated}")
    shares = sensors_of(bench, PLAIN | {"range_accuracy_m": 0.3, "range_accuracy_percent": 1})[0]
    for range_m, sigma_m in ((15, 0.3), (60, 0.6), (140, 1.4)):
        lists = posts_of(bench, shares, [(range_m, 0, 0)], DRAWS)
        error_m = rms([one["range_m"] - range_m for targets in lists for one in targets])
        bench.check(abs(error_m / sigma_m - 1) < 0.1, f"ranges scatter by {error_m} m at {range_m} m, not {sigma_m}")
    for figures, sigma_deg in (({"elevation_accuracy_deg": 0.4}, 0.4), ({"elevation_accuracy_deg": 0.1, "elevation_resolution_deg": 2.3}, 0.1),
                               ({"elevation_resolution_deg": 2.3}, 2.3 * 0.44 / 10 ** (31.4 / 20))):
        sensor = sensors_of(bench, PLAIN | {"elevation_view_half_width_deg": 14} | figures)[0]
        lists = posts_of(bench, sensor, [(15, 0, 0)], DRAWS)
        error_deg = rms([math.degrees(one["elevation_rad"] - one["cell_elevation_rad"]) for targets in lists for one in targets])
        bench.check(abs(error_deg / sigma_deg - 1) < 0.1, f"{figures}: elevations scatter by {error_deg}, not {sigma_deg}")
    fine = sensors_of(bench, json.loads((model.ROOT / "data/sheets/ars548-rdi.json").read_text()))[0]
    for sensor, resolution_deg in ((far, 1.6), (near, 3.2), (fine, 1.2)):
        for times, least, most in ((0.3, 0, 0.35), (1, 0.5, 0.8), (2, 1, 1)):
            apart = times * resolution_deg / 2
            lists = posts_of(bench, sensor | {"cell_phase": "random"}, [(15, apart, 0), (15, -apart, 0)], 400)
            share = sum(len(targets) > 1 for targets in lists) / len(lists)
            bench.check(least <= share <= most, f"{sensor['name']}: {share} of pairs {2 * apart} degrees apart are more than one target")
    for sensor, metres, mps in ((far, 1.79, 0.37 / 3.6), (near, 0.39, 0.43 / 3.6)):
        for part, count in ((0.97, 1), (1.03, 2)):
            for place in (15 + part * metres, 0, 0), (15, 0, part * mps):
                lists = posts_of(bench, sensor, [(15, 0, 0), place], 20)
                bench.check(all(len(targets) == count for targets in lists), f"{sensor['name']}: posts at {place}, {[len(one) for one in lists]}")
        for kmh, seen_kmh in ((-199, -199), (399, 399), (-201, 399), (401, -199)):
            rate = rms([3.6 * one["range_rate_mps"] - seen_kmh for one in posts_of(bench, sensor, [(15, 0, kmh / 3.6)], 5)[0]])
            bench.check(rate < 1, f"{sensor['name']}: {kmh} km/h are seen {rate} off {seen_kmh}")


def assumptions(bench):
    """What a suite has that its sheet does not state is among its assumptions, which are printed."""
    for sheet in (PLAIN, PLAIN | {"behind_front_bumper_m": 0.2, "detected_object": "car", "sources": {"range_max_m": "assumed, far"}},
                  {"extends": "srr24-pair", "range_max_m": 40, "azimuth_accuracy_deg": 2}):
        _, assumed = printed(bench, sheet)
        suite = json.loads((bench.scratch / "made.json").read_text())
        bench.check(len(suite["assumed"]) == len(assumed.splitlines()), f"not all printed: {assumed}")
        for member, text in suite["sensors"][0]["sources"].items():
            figure = text.split()[1] if ":" in text.split(" ")[1] or " " in text else member
            said = not text.startswith("[A]") or "extends" in sheet or member in assumed or figure in assumed
            bench.check(said, f"{member}: {text} is not among {assumed}")
    for words in ("vehicle_length_m 4.5", "range_max_m 150: far", "10 dBsm are detected at 150 m", "does not state the cross section of a car or the range or the probability"):
        assumed = printed(bench, PLAIN | {"behind_front_bumper_m": 0.2, "sources": {"range_max_m": "assumed, far"}})[1]
        bench.check(words in assumed, f"{words} is not in {assumed}")


def extended(bench):
    """A sheet changes what it states of another suite, and nothing else."""
    done, out = made(bench, {"extends": "lrr77", "range_resolution_m": 0.6})
    suite = json.loads(out.read_text())["sensors"][0]
    base = json.loads((model.ROOT / "data/sensors/lrr77.json").read_text())["sensors"][0]
    differ = {name for name in (suite | base) if suite.get(name) != base.get(name)} - {"sources", "antenna_table"}
    bench.check(differ <= {"cell_range_m", "cell_range_rate_mps", "cell_extent"}, f"also changed: {differ} {done.stderr}")
    part = printed(bench, {"extends": "lrr77", "range_resolution_m": 0.6})[0]["front"]
    hold(bench, "resolution", numbers(part, "resolution")[0], 0.6)
    hold(bench, "speed of the extended suite", numbers(part, "resolution")[1], 0.0515)
    parts, _ = printed(bench, {"extends": "corner77-four", "azimuth_accuracy_deg": 2, "range_accuracy_m": 0.05})
    bench.check(len(parts) == 4, f"not all radars of the extended suite: {list(parts)}")
    accuracy, _ = last_accuracy(parts["rear_right"])
    for value, expected in zip(accuracy, (0.05, 0.004, 2, 2, 2, 2)):
        hold(bench, "accuracy beside that of the extended suite", value, expected, 0.06)
    done, _ = made(bench, {"extends": "lrr77-full", "range_resolution_m": 0.3})
    bench.check(done.returncode == 65 and "sensors[0].chirp_slope_hzps: sweep" in done.stderr, f"the chirp of another cell: {done.stderr}")
    chirp = dict.fromkeys(("chirp_slope_hzps", "chirp_s", "receiver_bandwidth_hz"))
    part = printed(bench, {"extends": "lrr77-full", "range_resolution_m": 0.3, "members": chirp})[0]["front"]
    hold(bench, "resolution without the other chirp", numbers(part, "resolution")[0], 0.3)
    made(bench, {"extends": "corner77-four", "azimuth_accuracy_deg": 2, "range_accuracy_m": 0.05})
    (bench.scratch / "inner").mkdir()
    subprocess.run([SCRIPT, bench.scratch / "sheet.json", "-o", bench.scratch / "inner" / "base.json"], check=True)
    part = printed(bench, {"extends": "inner/base.json", "range_max_m": 99})[0]
    hold(bench, "range beside a suite of one's own", numbers(part["rear_right"], "range")[1], 99)
    made(bench, PLAIN)
    subprocess.run([SCRIPT, bench.scratch / "sheet.json", "-o", bench.scratch / "inner" / "base.json"], check=True)
    part = printed(bench, {"extends": "inner/base.json", "range_max_m": 299.8})[0]
    hold(bench, "false alarms in twice as many cells", numbers(part["front"], "false alarms")[0], 2 * 1e-6 * 149.8 / 2 * 140 / 0.4)


def shipped(bench):
    """Every shipped suite can be extended by figures of detection, and is found from anywhere."""
    for i, path in enumerate(shipped_suites()):
        sheet = {"extends": path.stem} | ({"detected_at_m": 20}, {"detection_probability": 0.8}, {"false_alarm_rate": 1e-5})[i % 3]
        done, out = made(bench, sheet)
        bench.check(done.returncode == 0 and not reads(bench, out), f"{sheet}: {done.stderr}")
    made(bench, {"extends": "corner77-four", "height_m": 0.6})
    (bench.scratch / "real/deep").mkdir(parents=True)
    (bench.scratch / "linked").symlink_to("real/deep")
    for out in "linked/made.json", "made.json":
        done = run(bench.scratch / "sheet.json", "-o", bench.scratch / out, GLINT_DATA=str(bench.scratch))
        fault = done.stderr or reads(bench, bench.scratch / out)
        bench.check(not fault, f"{out} with other data: {fault}")


def random_sheet(generator, name, sensors):
    """A sheet that extends a suite by a few figures, and now and then by a member."""
    one, sheet = sensors[0], {"extends": name}
    far_m, view_deg = one["range_max_m"] * generator.uniform(0.5, 1.3), math.degrees(one["field_of_view_rad"])
    figures = [("range_max_m", far_m), ("detected_at_m", far_m * generator.uniform(0.3, 0.9)), ("detected_dbsm", generator.uniform(-5, 20)),
               ("detection_probability", generator.uniform(0.6, 0.95)), ("fluctuation", generator.choice(("none", "swerling_1", "swerling_3"))),
               ("false_alarm_rate", 10 ** generator.uniform(-8, -3)), ("range_resolution_m", generator.uniform(0.1, 3)),
               ("speed_resolution_kmh", generator.uniform(0.2, 2)), ("view_half_width_deg", view_deg * generator.uniform(0.3, 0.5)),
               ("azimuth_accuracy_deg", generator.uniform(0.3, 3)), ("azimuth_resolution_deg", generator.uniform(2, 20)), ("cycle_ms", generator.uniform(20, 90)),
               ("latency_ms", generator.uniform(0, 90)), ("speed_max_kmh", generator.uniform(100, 400)), ("range_accuracy_m", generator.uniform(0.02, 0.5)),
               ("height_m", generator.uniform(0.3, 1)), ("range_accuracy_percent", generator.uniform(0.1, 2)),
               ("elevation_view_half_width_deg", generator.uniform(5, 20)), ("elevation_accuracy_deg", generator.uniform(0.05, 1)),
               ("elevation_resolution_deg", generator.uniform(1, 5)),
               ("detections", [{"object": "car", "at_m": far_m * generator.uniform(0.5, 0.9)}, {"dbsm": -3, "at_m": far_m * generator.uniform(0.1, 0.5)}]),
               ("carrier_ghz", generator.uniform(76, 81)), ("list_limit", generator.randrange(10, 300)),
               ("behind_front_bumper_m", generator.uniform(0, 0.5)), ("yaw_right_deg", generator.uniform(-90, 90)), ("range_unambiguous_m", generator.uniform(50, 500))]
    members = [("level_constant_db", generator.uniform(1, 6)), ("exponent", generator.uniform(1.3, 2.2)), ("bounces", 3), ("final_threshold", False),
               ("pointer_sigma", generator.uniform(0.2, 2)), ("cell_range_m", generator.uniform(0.2, 3)), ("threshold_db", generator.uniform(3, 15)),
               ("range_max_m", far_m), ("fluctuation", "swerling_1"), ("receiver_bandwidth_hz", None), ("waveform", None), ("calibration_range_m", far_m)]
    chosen = {figure: value if isinstance(value, (int, str, list)) else float(f"{value:.4g}") for figure, value in generator.sample(figures, generator.randint(1, 5))}
    sheet |= {figure: value for figure, value in chosen.items() if figure not in ("detected_dbsm", "detection_probability") or "detected_at_m" in chosen}
    return sheet | ({"members": dict(generator.sample(members, generator.randint(1, 2)))} if generator.random() < 0.5 else {})


def read_back(bench, sheet, out):
    """Figures of a sheet, each against the suite as glint prints it, by readings of this test's own."""
    text = subprocess.run([str(bench.bin / "glint"), "--datasheet", str(out)], capture_output=True, check=True, text=True).stdout
    part = text.partition(" at x ")[2]
    for figure, line, i, unit in (("range_max_m", "range", 1, 1), ("range_resolution_m", "resolution", 0, 1), ("speed_resolution_kmh", "resolution", 1, 3.6),
                                  ("view_half_width_deg", "field of view", 0, -1), ("cycle_ms", "update", 0, 1), ("carrier_ghz", "carrier", 0, 1),
                                  ("list_limit", "list", 0, 1), ("azimuth_resolution_deg", "cell", 2, 1),
                                  ("range_accuracy_percent", "range: at least", 0, 1), ("elevation_view_half_width_deg", "elevation", 0, -1)):
        if figure in sheet:
            hold(bench, f"{figure} of {sheet}", unit * numbers(part, line)[i], sheet[figure])
    if "azimuth_accuracy_deg" in sheet:
        hold(bench, f"accuracy of {sheet}", last_accuracy(part)[0][2], sheet["azimuth_accuracy_deg"], 0.06)
    if "detected_at_m" in sheet and "detection_probability" not in sheet:
        dbsm, exponent = sheet.get("detected_dbsm", 10), sheet.get("members", {}).get("exponent") or json.loads(out.read_text())["sensors"][0].get("exponent", 2)
        for printed_dbsm in (0, 10, 20):
            (value, ends), expected = reach_m(part, 0, printed_dbsm), sheet["detected_at_m"] * 10 ** ((printed_dbsm - dbsm) / 20 / exponent)
            bench.check(ends and expected > 0.98 * value or abs(value - expected) < 0.03 * expected, f"{printed_dbsm} dBsm of {sheet}: {value}, not {expected}")


def random_sheets(bench):
    """Whatever a sheet asks of a shipped suite, the suite that is written is read by glint and has what is asked; else there is no suite."""
    generator, accepted = random.Random(37), 0
    suites = shipped_suites()[::3]
    for path in suites:
        sheet = random_sheet(generator, path.stem, whole_suite(path.stem)["sensors"])
        out = bench.scratch / "made.json"
        out.unlink(missing_ok=True)
        done, out = made(bench, sheet)
        told = done.stderr.startswith("make-radar: ") and "Traceback" not in done.stderr and len(done.stderr.splitlines()) == 1
        bench.check(done.returncode == 0 or done.returncode == 65 and told and not out.exists(), f"{sheet}: {done.returncode}, {done.stderr}")
        if done.returncode == 0:
            accepted += 1
            read_back(bench, sheet, out)
    bench.check(accepted >= len(suites) / 3, f"only {accepted} of {len(suites)} sheets make a suite")


def members_come_first(bench):
    """What is detected where holds for the members that the sheet states, and they are in the suite as they are."""
    for i, members in enumerate(({"level_constant_db": 6, "level_keeps": "median"}, {"exponent": 1.4}, {"fluctuation": "swerling_1"}, {"pointer_sigma": 0.2},
                    {"threshold_db": 18}, {"cell_range_m": 2}, {"cell_range_m": 1, "cell_extent": "half_width"}, {"level_fast_db": 4, "exponent": 1.8})):
        base = PLAIN | {"range_max_m": 400} if i % 2 else {"extends": "lrr77"}
        sheet = base | {"detected_at_m": 150, "members": members}
        done, out = made(bench, sheet)
        bench.check(done.returncode == 0, f"{sheet}: {done.stderr}")
        text = subprocess.run([bench.bin / "glint", "--datasheet", out], capture_output=True, check=True, text=True).stdout
        hold(bench, f"10 dBsm with {sheet}", reach_m(text, 0, 10)[0], 150, 0.02)
        sensor = json.loads(out.read_text())["sensors"][0]
        bench.check(all(sensor[member] == value for member, value in members.items()), f"{sheet}: members are {sensor}")


def kept(bench):
    """Neither the extended suite nor its tables are written over, whatever the sheet asks."""
    folder = bench.scratch / "kept"
    folder.mkdir()
    for name, sheet, out in (("base", PLAIN, "base"), ("other", {"extends": "./base.json", "range_max_m": 90}, "base"),
                             ("third", {"extends": "./linked.json", "azimuth_accuracy_deg": 2, "radars": [{"name": "front"}]}, "base")):
        (folder / "linked.json").unlink(missing_ok=True)
        if name == "third":
            (folder / "linked.json").write_text((folder / "base.json").read_text())
        (folder / f"{name}.sheet").write_text(json.dumps(sheet))
        before = {path: path.read_bytes() for path in folder.glob("*.*")}
        done = run(folder / f"{name}.sheet", "-o", folder / f"{out}.json")
        good = done.returncode == 0 if name == "base" else done.returncode == 65 and "need this file" in done.stderr
        bench.check(good and (name == "base" or before == {path: path.read_bytes() for path in folder.glob("*.*")}), f"{name}: {done.stderr}")


def levels(bench):
    """Members of the sheet hold for radars with members of their own, for which null takes one away; a table among them is as it is."""
    radars = [{"name": "a"}, {"name": "b", "members": {"diffraction": True, "bounces": None}}, {"name": "c", "members": {"antenna_table": "own.csv"}}]
    (bench.scratch / "own.csv").write_text("azimuth_rad,sum,delta\n-0.6,0.5,-1\n0,1,0\n0.6,0.5,1\n")
    done, out = made(bench, PLAIN | {"members": {"bounces": 3, "curved_sides": True}, "radars": radars})
    found = [{name: one.get(name) for name in ("bounces", "curved_sides", "diffraction", "antenna_table")} for one in json.loads(out.read_text())["sensors"]]
    expected = [(3, True, None, "made-a.csv"), (None, True, True, "made-b.csv"), (3, True, None, "own.csv")]
    bench.check([tuple(one.values()) for one in found] == expected, f"{found} {done.stderr}")


def whole(bench):
    """A radar that cannot be written leaves the one that is there, and nothing else; a data set has all of its tables."""
    sheet, folder = model.ROOT / "data/sheets/ars408-21.json", bench.scratch / "whole"
    (folder / "folder").mkdir(parents=True)
    run(sheet, "-o", folder / "made.json")
    before = {path: path.read_bytes() for path in folder.glob("*.*")}
    bench.check(len(before) == 5, f"files: {list(before)}")
    for out, limit, code, message in (("made.json", 2, 74, "made.json: File too large"), ("folder", None, 73, "is there, and is no plain file"),
                                      ("folder/", None, 73, "is there, and is no plain file"), ("no/made.json", None, 73, "no/made.json: No such file")):
        done = run(sheet, "-o", f"{folder}/{out}", limit=limit)
        bench.check(done.returncode == code and message in done.stderr, f"{out}: {done.returncode}, {done.stderr}")
        bench.check(before == {path: path.read_bytes() for path in folder.rglob("*.*")}, f"{out} was not written, and the folder has changed")
    (folder / "plan.json").write_text(json.dumps({
        "name": "x", "origin": "x", "sources": [{"random": "sparse", "frames": 1}], "suites": ["./made.json"], "frames_per_shard": 1,
        "chain": "glint-extract | glint-ideal --sensors {suite} | glint-sensor | glint-noise --sensors {suite}"}))
    done = subprocess.run([model.ROOT / "scripts/dataset", folder / "plan.json", "--out", folder / "set"], capture_output=True, check=False, text=True)
    bench.check((folder / "set/documents/sensors/made-front_near-floor.csv").exists(), done.stderr)


REFUSED = [
    ({"range_resolution_m": 1.5, "range_cell_m": 2}, "range_resolution_m 1.5 and range_cell_m 2 contradict"),
    ({"speed_resolution_kmh": 0.5}, "speed_resolution_mps 0.2 and speed_resolution_kmh 0.5 contradict"),
    ({"range_min_m": 200}, "range_min_m 200 is not below range_max_m, 150"),
    ({"range_limits": [{"azimuth_deg": 0, "range_max_m": 160}]}, "range_limits have 160 m at 0 degrees; expected"),
    ({"range_limits": [{"azimuth_deg": -5, "range_max_m": 60}]}, "expected azimuths from 0 on, as limits hold to both sides"),
    ({"range_limits": [{"azimuth_deg": 5}]}, 'range_limits[0] is {"azimuth_deg": 5}; expected azimuth_deg and one of range_max_m'),
    ({"cycle_ms": 4, "carrier_ghz": 77}, "takes a dwell of 4.87 ms, more than cycle_ms, 4"),
    ({"detected_at_m": 170}, "detected_at_m 170 is beyond the range limit on boresight, 150"),
    ({"detected_object": "car", "detected_dbsm": 5}, "detected_object car (10) and detected_dbsm 5 contradict each other"),
    ({"false_alarm_rate": 1e-3, "false_alarms_per_scan": 1}, "makes 26.22 false alarms a scan; false_alarms_per_scan is 1"),
    ({"beam_one_way_full_width_deg": 20, "beam_two_way_full_width_deg": 20}, "beam_two_way_full_width_deg 20 and beam_one_way_full_width_deg 20 contradict"),
    ({"azimuth_accuracy_deg": 0.001}, "the azimuth accuracy of 0.001 degrees over 60 degrees of view is finer"),
    ({"azimuth_accuracy_deg": 0.01, "receive_positions_wavelengths": [0, 0.5]}, "0.01 degrees at 0 degrees is finer than 0.694"),
    ({"azimuth_accuracies": [{"azimuth_deg": 0, "accuracy_deg": 1}, {"azimuth_deg": 30, "accuracy_deg": 0.1}], "azimuth_resolution_deg": 14},
     "is finer than 0.192, what the elements have at 31.4 dB"),
    ({"azimuth_resolution_deg": 5, "receive_positions_wavelengths": [0, 0.5, 1, 1.5]}, "4 elements 0.5 wavelengths apart resolve 26.1 degrees, not azimuth_resolution_deg 5"),
    ({"receive_positions_wavelengths": [0, 0.5, 1.5]}, "3 sums of transmit and receive positions, 0.5 to 1 wavelengths apart; expected 2 to 256 in even steps of at most 1"),
    ({"receive_positions_wavelengths": [0, 1.5]}, "2 sums of transmit and receive positions, 1.5 to 1.5 wavelengths apart; expected 2 to 256 in even steps of at most 1"),
    ({"transmit_positions_wavelengths": [0, 1.5]}, "0 sums of transmit and receive positions"),
    ({"azimuth_resolution_deg": 0.15}, "azimuth_resolution_deg 0.15 takes more than 256 elements 1 wavelengths apart"),
    ({"receding_max_kmh": 100}, "receding_max_kmh and approaching_max_kmh belong together"),
    ({"speed_resolution": 1}, "speed_resolution: unknown figure; did you mean speed_resolution_"),
    ({"detection_probability": 0.4, "members": {"first_threshold": "full"}}, "detection_probability 0.4 is not reached; an echo at the threshold has 0.538"),
    ({"fluctuation": "rayleigh"}, 'fluctuation is "rayleigh"; expected one of none, swerling_1, swerling_3'),
    ({"false_alarm_rate": 1}, "false_alarm_rate is 1; expected a number from 1e-15 to 0.1"),
    ({"false_alarms_per_scan": 9000}, "false_alarms_per_scan 9000 in 2.62e+04 cells is a rate of 0.3433 in each; expected 0.1 or less"),
    ({"cycle_ms": 50, "update_rate_hz": 18}, "cycle_ms 50 and update_rate_hz 18 contradict each other"),
    ({"speed_max_kmh": 100, "receding_max_kmh": 200, "approaching_max_kmh": 100}, "receding_max_kmh 200 and speed_max_kmh 100 contradict each other"),
    ({"receding_max_kmh": -400, "approaching_max_kmh": 200}, "receding_max_kmh is -400; expected a number from 0.36 to 36000"),
    ({"azimuth_accuracies": [{"azimuth_deg": 0, "accuracy_deg": 1}], "azimuth_accuracy_deg": 2}, "azimuth_accuracies (1) and azimuth_accuracy_deg 2 contradict"),
    ({"gains": [{"azimuth_deg": 0, "one_way_db": 0}, {"azimuth_deg": 10, "one_way_db": -3}], "beam_one_way_full_width_deg": 40},
     "gains are down by 3 dB both ways over 9.99 degrees, and with beam_one_way_full_width_deg 40 over 28.3"),
    ({"range_accuracy_m": 0.05, "range_step_m": 0.2}, "range_accuracy_m has 0.05; steps of 0.2 alone have a deviation of 0.05774"),
    ({"extends": "lrr77-signal-small"}, "range_resolution_m 1 beside a waveform, which sets the cells"),
    ({"extends": "no-radar"}, "no-radar.json and "),
    ({"radars": [{"name": "a"}, {"name": "a"}]}, "two radars or scans have the name a"),
    ({"radars": [{"scans": []}]}, "radars[0].scans is []; expected a list of one or more objects"),
    ({"sources": {"range_max": "x"}}, "sources.range_max: unknown figure; did you mean range_max_m?"),
    ({"radars": [{"name": "a/b"}]}, 'name is "a/b"; expected letters, digits, _ and -'),
    ({"name": "a"}, "name: expected only in a radar or a scan, not in the sheet"),
    ({"scans": [{"name": "far"}]}, "scans: expected only in a radar, not in the sheet"),
    ({"radars": [{"radars": [{}]}]}, "radars[0].radars: expected only in the sheet, not in a radar"),
    ({"radars": [{"extends": "lrr77"}]}, "radars[0].extends: expected only in the sheet"),
    ({"radars": [{"scans": [{"scans": [{}]}]}]}, "radars[0].scans[0].scans: expected only in a radar, not in a scan"),
    ({"radars": [{"name": "front", "azimuth_accuracies": [{"azimuth_deg": 0, "accuracy_deg": 1}, {"azimuth_deg": 30, "accuracy_deg": 2}]},
                 {"name": "front-floor"}]}, "made-front-floor.csv is a table of another radar or scan"),
    ({"members": {"carrier_hz": None}, "cycle_ms": 50}, "front: members: carrier_hz is null; a suite needs it"),
    ({"members": {"cell_range_rate_mps": "x"}, "cycle_ms": 50}, "front/cell_range_rate_mps: 'x'; expected number"),
    ({"members": {"cycle_s": "x"}}, "front/cycle_s: 'x'; expected number"),
    ({"members": {"name": "x"}}, 'members is {"name": "x"}; expected an object of members other than name'),
    ({"members": {"cycle": 1}}, "front/cycle: unknown member"),
    ({"members": {"cell_range_m": 2, "cell_extent": "half_width"}}, "range_resolution_m 1 and members, cell_range_m 2, contradict each other: 1 follows"),
    ({"cycle_ms": 50, "members": {"cycle_s": 0.06}}, "cycle_ms 50 and members, cycle_s 0.06, contradict each other: 0.05 follows"),
    ({"false_alarm_rate": 1e-6, "members": {"threshold_db": 20}}, "false_alarm_rate 1e-06 and members, threshold_db 20, contradict each other"),
    ({"detected_at_m": 90, "members": {"calibration_ercs": 1, "calibration_range_m": 60}}, "detected_at_m: not used beside the other figures"),
    ({"detections": []}, "detections is []; expected a list of one or two rows"),
    ({"detections": [{"object": "car"}]}, 'detections[0] is {"object": "car"}; expected object or dbsm, at_m, and no more than probability'),
    ({"detections": [{"object": "car", "dbsm": 10, "at_m": 90}]}, "expected object or dbsm, at_m, and no more than probability beside them"),
    ({"detections": [{"object": "lorry", "at_m": 90}]}, 'detections[0].object is "lorry"; expected one of car, truck, motorcycle, pedestrian'),
    ({"detections": [{"object": "car", "at_m": "far"}]}, 'detections[0].at_m is "far"; expected a number from 0.1 to 100000'),
    ({"detections": 3 * [{"object": "car", "at_m": 90}]}, "expected one or two rows, which state level and slope"),
    ({"detections": [{"object": "car", "at_m": 90}], "detected_at_m": 80}, "detected_at_m: not used beside the other figures"),
    ({"detections": [{"object": "car", "at_m": 151}]}, "detections, at_m 151 is beyond the range limit on boresight, 150"),
    ({"detections": [{"object": "car", "at_m": 90}, {"object": "pedestrian", "at_m": 90}]},
     "that 10 dBsm are detected at 90 m with a probability of 0.9 and that -3 dBsm are detected at 90 m with a probability of 0.9 are at one range"),
    ({"detections": [{"object": "car", "at_m": 90}, {"object": "pedestrian", "at_m": 80}]},
     "that 10 dBsm are detected at 90 m with a probability of 0.9 and that -3 dBsm are detected at 80 m with a probability of 0.9 let echoes fall by "
     "254 dB a decade of range; expected two ranges, and 5 to 60 dB"),
    ({"detections": [{"object": "car", "at_m": 60}, {"object": "pedestrian", "at_m": 140}]}, "let echoes fall by -35.3 dB a decade of range"),
    ({"detections": [{"object": "car", "at_m": 140}, {"object": "pedestrian", "at_m": 60}], "members": {"exponent": 2}},
     "detections (1.766) and members, exponent 2, contradict each other: 1.766 follows"),
    ({"elevation_accuracy_deg": 0.1}, "elevation_accuracy_deg 0.1 needs elevation_view_full_width_deg beside it"),
    ({"elevation_view_half_width_deg": 14, "elevation_accuracy_deg": 0.01, "elevation_resolution_deg": 2.3},
     "elevation_accuracy_deg 0.01 is finer than 0.0272 degrees, what elements with elevation_resolution_deg 2.3 have 20 dB above the threshold"),
    ({"elevation_view_half_width_deg": 14, "members": {"elevation_view_rad": 0.4}}, "elevation_view_half_width_deg 14 and members, elevation_view_rad 0.4, contra"),
    ({"elevation_view_half_width_deg": 14, "elevation_accuracy_deg": 0.1, "members": {"elevation_floor_rad": 0.01}},
     "elevation_accuracy_deg 0.1 is asked, and the suite's printed data sheet has 0.5797"),
    ({"range_limits": [{"azimuth_deg": 0, "range_max_m": 100}], "members": {"range_limits": [{"azimuth_rad": 0, "range_max_m": 90}]}},
     'range_limits and members, range_limits [{"azimuth_rad": 0, "range_max_m": 90}], contradict each other'),
    ({"range_accuracy_percent": 0.5, "members": {"range_sigma_share": 0.01}},
     "range_accuracy_percent 0.5 and members, range_sigma_share 0.01, contradict each other: 0.005 follows"),
    ({"range_accuracy_percent": 101}, "range_accuracy_percent is 101; expected a number from 0 to 100"),
    ({"azimuth_accuracy_deg": 1, "members": {"azimuth_floor_rad": 0.1}}, "azimuth accuracy at 0 degrees 1 is asked, and the suite's printed data sheet has 5.8"),
    ({"speed_max_kmh": 180, "members": {"unambiguous_middle_mps": 5}}, "speed_max_kmh 180 is asked, and the suite's printed data sheet has none"),
    ({"elevation_one_way_full_width_deg": 14, "members": {"mount_z_m": None}}, "glint refuses the suite: "),
    ({"radars": [{"name": "a", "range_resolution_m": 4}]}, "range_resolution_m 1 holds for no scan; a has range_resolution_m 4"),
    ({"radars": [{"name": "a", "range_cell_m": 4}]}, "range_resolution_m 1 and range_cell_m 4 contradict each other"),
    ({"list_limit": 2.5}, "front/list_limit: 2.5; expected integer"),
    ({"range_max_m": 9e4, "range_resolution_m": 1e4}, "front/range_sigma_m: 2500.0; expected at most 1000"),
    ({"document": "\ud800"}, "/document: '\\ud800'; expected one line"),
    ({"origin": ""}, 'origin is ""; expected a text of 1 to 239 letters'),
    ({"sources": {"range_max_m": 240 * "x"}}, "expected a text of at most 239 letters"),
    ({"extends": "./sheet.json"}, "expected a suite that does not extend this one"),
    ({"extends": "/etc/passwd"}, "make-radar: /etc/passwd:1: "),
    ({"range_max_m": None}, "range_max_m is null; expected a number from 0.1 to 100000"),
    ({"range_min_m": "near"}, 'range_min_m is "near"; expected a number'),
    ({"left_of_middle_m": 0.1, "inside_left_side_m": 0.1}, "left_of_middle_m 0.1 and inside_left_side_m 0.1 contradict each other"),
]


def refused(bench):
    for change, message in REFUSED:
        done, _ = made(bench, PLAIN | change)
        code = 66 if change.get("extends") == "no-radar" else 65
        bench.check(done.returncode == code and message in done.stderr, f"{change}: {done.returncode}, {done.stderr}")
    path = bench.scratch / "sheet.json"
    for text, out, code, message in (('{"range_max_m": 1, "range_max_m": 2}', "made.json", 65, "'range_max_m' stands twice"),
                                     ('{"range_max_m": 1,}', "made.json", 65, "sheet.json:1: "), ("[" * 100000, "made.json", 65, "nested too deep"),
                                     (json.dumps(PLAIN), "sheet.json", 64, "unknown command line")):
        path.write_text(text)
        done = run(path, "-o", bench.scratch / out)
        bench.check(done.returncode == code and message in done.stderr, f"{text[:80]}: {done.returncode}, {done.stderr}")
    with open("/dev/full", "w", encoding="ascii") as full:
        done = subprocess.run([SCRIPT, "--help"], stdout=full, stderr=subprocess.PIPE, check=False, text=True)
    bench.check((done.returncode, done.stderr) == (74, "make-radar: No space left on device\n"), f"a full disk: {done.returncode}, {done.stderr}")


def scans(bench):
    """Both scans of one radar run in one cycle, and the near one has no target beyond its limits."""
    _, out = made(bench, json.loads((model.ROOT / "data/sheets/ars408-21.json").read_text()))
    text = f"glint-traffic intersection | glint-extract | glint-ideal --sensors {out} | glint-sensor | glint-noise --sensors {out}"
    lines = subprocess.run([str(bench.bin / "glint"), "-c", text], capture_output=True, check=True, text=True).stdout.splitlines()
    seen = [target for line in lines for target in json.loads(line)["targets"]]
    near = [one for one in seen if one["sensor"] == "front_near"]
    bench.check(len(near) > 20 and len(seen) > len(near), f"{len(near)} of {len(seen)} targets in the near scan")
    for one in near:
        degrees = abs(math.degrees(one["cell_azimuth_rad"]))
        limit_m = 100 - 30 * degrees / 45 if degrees < 45 else 70 - 50 * (degrees - 45) / 15
        bench.check(one["range_m"] < limit_m + 3, f"a target at {one['range_m']} m, {degrees} degrees")


CHECKS = [
    ("every figure of the public sheets is read back", public_sheets),
    ("other words of the same figures make the same suite", other_words),
    ("antennas by beam, by gain and by elements", antennas),
    ("shipped antennas are two apertures", shipped_tables),
    ("echoes are detected as often as the sheet states", chances),
    ("accuracy, resolution and speeds hold in the whole chain, up to the borders", edges),
    ("what a sheet does not state is among the printed assumptions", assumptions),
    ("a sheet extends a suite", extended),
    ("what is detected holds for the members of the sheet", members_come_first),
    ("the extended suite is never written over", kept),
    ("a random sheet makes a suite that has what it asks, or none", random_sheets),
    ("every shipped suite can be extended, from anywhere", shipped),
    ("members of the sheet hold beside those of a radar", levels),
    ("what fails leaves the radar that is there", whole),
    ("figures that contradict each other are refused with both", refused),
    ("near and far scan of one radar run in one cycle", scans),
]


if __name__ == "__main__":
    model.run(__doc__, data_sheet.prepare, CHECKS)
