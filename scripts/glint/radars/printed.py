"""Reads the data sheet that `glint --datasheet` prints of a suite, and compares it with the figures that a sheet asks for."""
import json
import math
import os
import re
import subprocess
import tempfile

from glint.places import GLINT
from glint.radars.antennas import between
from glint.radars.figures import DEGREE, FIRST, LISTS, Refused, others, scale
from glint.sets.documents import TABLES
from glint.sets.plan import IO, UNAVAILABLE, Fault

TOLERANCE, OF_BEAMS, OF_DEVIATIONS, BESIDE_PLACES = 0.01, 0.02, 0.06, 0.3  # shares; deviations are printed with two digits
MOUNTS_M = 0.01
NUMBER = r"([-+\d.e]+)"
# Lines of the printed sheet, and the figures whose values stand in them, in these units.
LINES = ((rf"at x {NUMBER} m, y {NUMBER} m", ("ahead_of_middle_m", 1), ("left_of_middle_m", 1)),
         (rf"at x .*, z {NUMBER} m", ("height_m", 1)),
         (rf"at x .* looking to {NUMBER} degrees", ("yaw_left_deg", DEGREE)),
         (rf"carrier +{NUMBER} GHz", ("carrier_ghz", 1e9)),
         (rf"field of view +\+-{NUMBER} degrees", ("view_full_width_deg", 2 * DEGREE)),
         (rf"range +{NUMBER} \(blind before\) to {NUMBER} m", ("range_min_m", 1), ("range_max_m", 1)),
         (rf"resolution +{NUMBER} m or {NUMBER} m/s", ("range_resolution_m", 1), ("speed_resolution_mps", 1)),
         (rf"cell .* azimuths {NUMBER} degrees apart", ("azimuth_resolution_deg", DEGREE)),
         (rf"array +{NUMBER} transmitters in turn, {NUMBER} receivers", ("transmit_positions_wavelengths", 1), ("receive_positions_wavelengths", 1)),
         (rf"(?:element's )?beam +{NUMBER} degrees wide", ("beam_two_way_full_width_deg", DEGREE)),
         (rf"(?:element's )?beam .*, {NUMBER} degrees high", ("elevation_one_way_full_width_deg", DEGREE)),
         (rf"elevation +within \+-{NUMBER} degrees", ("elevation_view_full_width_deg", 2 * DEGREE)),
         (rf"unambiguous +to {NUMBER} m", ("range_unambiguous_m", 1)),
         (rf"unambiguous [^;]*within \+-{NUMBER} m/s", ("approaching_max_mps", 1)),
         (rf"unambiguous [^;]*within \+-{NUMBER} m/s", ("receding_max_mps", 1)),
         (rf"unambiguous [^;]*from {NUMBER} to {NUMBER} m/s", ("approaching_max_mps", -1), ("receding_max_mps", 1)),
         (rf"update +every {NUMBER} ms", ("cycle_ms", 1e-3)),
         (rf"update .*latency {NUMBER} ms", ("latency_ms", 1e-3)),
         (rf"false alarms +{NUMBER} a scan", ("false_alarms_per_scan", 1)),
         (rf"range: at least {NUMBER} % of the range", ("range_accuracy_percent", 1e-2)),
         (rf"list +the \w+ {NUMBER}", ("list_limit", 1)))


def of_suite(suite, out, tables):
    """{radar or scan: its lines of the printed sheet} of a suite that is not yet written, with the tables that are made for it."""
    there = os.path.realpath(os.path.dirname(out))
    sensors = [sensor | {member: os.path.join(there, sensor[member]) for member in sensor.keys() & set(TABLES)
                         if os.path.join(os.path.dirname(out), sensor[member]) not in tables} for sensor in suite["sensors"]]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "suite.json")
        try:
            for name, text in [(path, json.dumps(suite | {"sensors": sensors})), *tables.items()]:
                with open(os.path.join(folder, os.path.basename(name)), "w", encoding="utf-8") as file:
                    file.write(text)
        except OSError as error:
            raise Fault(IO, f"{out}: {error.strerror}") from error
        try:
            done = subprocess.run([GLINT, "--datasheet", path], capture_output=True, check=False, text=True)
        except OSError as error:
            raise Fault(UNAVAILABLE, f"{GLINT}: {error.strerror}; it prints the data sheet with which the figures are compared") from error
    if done.returncode:
        fault = done.stderr.strip().removeprefix("glint: ").replace(path, out).replace(folder + "/", "")
        raise Refused(f"glint refuses the suite: {fault}; members of the extended suite can be stated anew, or be null, under members")
    found, names = {}, []
    for line in done.stdout.partition("\nassumed\n")[0].splitlines():
        if " at x " in line and not line.startswith(" "):
            names = (names if names and len(found[names[-1]]) == 1 else []) + [line.partition(":")[0]]
            found[names[-1]] = []
        for name in names if line.startswith(" ") else names[-1:]:
            found[name].append(line.partition(": ")[2] if not line.startswith(" ") else line.strip())
    return found


def values(scan, lines):
    """The figures that stand in lines of a printed sheet, by their first names."""
    found = {name: None for _, *of in LINES for name, _ in of} | {"list_limit": 0}
    for pattern, *of in LINES:
        for told in filter(None, (re.match(pattern, line) for line in lines)):
            found |= {name: float(word) * unit for word, (name, unit) in zip(told.groups(), of)}
    (length_m, width_m), (x, y) = scan.size_m, (found["ahead_of_middle_m"], found["left_of_middle_m"])
    one_speed = found["receding_max_mps"] == found["approaching_max_mps"]
    return found | {"behind_front_bumper_m": length_m / 2 - x, "ahead_of_rear_bumper_m": length_m / 2 + x,
                    "inside_left_side_m": width_m / 2 - y, "inside_right_side_m": width_m / 2 + y,
                    "update_rate_hz": found["cycle_ms"] and 1 / found["cycle_ms"], "speed_max_mps": found["receding_max_mps"] if one_speed else None}


def hold(scan, what, asked, got, slack, unit=1, times=1):
    """Refuses what the printed sheet does not have as asked, or up to `times` as much."""
    if got is None or not min(asked, asked * times) - slack <= got <= max(asked, asked * times) + slack:
        has = "none" if got is None else f"{got / unit:.4g}"
        raise Refused(f"{scan.name}: {what} {asked / unit:.4g} is asked, and the suite's printed data sheet has {has}")


def compare(scan, lines):
    """Refuses a suite whose printed sheet does not have the figures that its sheet states."""
    figures, found = scan.figures, values(scan, lines)
    for spelling in figures.values:
        first = FIRST[spelling]
        if first not in found:
            continue
        asked = len(figures.places(first)) if first in LISTS else figures.take(first)
        share = {"beam_two_way_full_width_deg": OF_BEAMS, "azimuth_resolution_deg":
                 BESIDE_PLACES if "receive_positions_wavelengths" in figures else TOLERANCE}.get(first, TOLERANCE)
        slack = MOUNTS_M if re.search("_middle_|_bumper_|_side_", first) else share * abs(asked)
        hold(scan, spelling, asked, found[first], slack, scale(spelling) * dict(others(first))[spelling])
    limits = figures.rows("range_limits", "range_max_m") if "range_limits" in figures else []
    for limit_m, degrees in re.findall(rf"{NUMBER} m at {NUMBER} degrees", " ".join(one for one in lines if limits and one.startswith("range limits"))):
        asked_m = between(limits if limits[0][0] <= 0 else [(0, found["range_max_m"]), *limits], float(degrees) * DEGREE)
        hold(scan, f"range_limits at {degrees} degrees", asked_m, float(limit_m), TOLERANCE * asked_m)
    compare_accuracy(scan, lines)
    if scan.detected:
        compare_detection(scan, next(line for line in lines if line.startswith("0 degrees ")).split()[3::2])


def compare_accuracy(scan, lines):
    """Deviations at the printed ratio of powers that is nearest to the one for which they are stated. What the antenna makes of them
    falls with the signal, and a floor does not. At 90 degrees every antenna's table ends."""
    figures, snr_db, rate = scan.figures, scan.figures.take("accuracy_snr_db"), scan.figures.take("false_alarm_rate")
    rows = [row for row in (re.match(rf"(?:SNR|threshold \+) +{NUMBER} dB +(.*)", line) for line in lines) if row]
    row = rows[-1] if snr_db is None else min(rows, key=lambda one: abs(float(one[1]) - snr_db))
    if rate:
        hold(scan, "threshold by false_alarm_rate in dB", 10 * math.log10(-math.log(rate)), float(rows[0][1]), 0.06)
    range_m, rate_mps, *azimuths = row[2].split()
    for name, word in (("range_accuracy_m", range_m), ("speed_accuracy_mps", rate_mps)):
        asked = figures.take(name)
        if asked:
            hold(scan, figures.spelled(name), asked, float(word), OF_DEVIATIONS * asked, scale(figures.spelled(name)))
    compare_elevation(scan, lines, (float(row[1]) if snr_db is None else snr_db) - float(rows[0][1]))
    directions = next(line for line in lines if line.startswith("accuracy")).partition(", at")[2].split()
    stated, times = figures.rows("azimuth_accuracies", "accuracy_deg"), 1 if snr_db is None else 10 ** ((snr_db - float(row[1])) / 20)
    for degrees, word in zip(directions, azimuths):
        asked = between(stated, float(degrees) * DEGREE) if stated else figures.take("azimuth_accuracy_deg")
        if asked and word != "-" and float(degrees) < 90 and (stated or degrees == "0" or "array" not in scan.members):
            hold(scan, f"azimuth accuracy at {degrees} degrees", asked, float(word) * DEGREE, OF_DEVIATIONS * asked, DEGREE, times)


def compare_elevation(scan, lines, above_db):
    """The deviation of elevations, so many dB above the threshold. At the threshold it is at most that of an elevation anywhere in the view."""
    asked, step_rad = scan.figures.take("elevation_accuracy_deg"), scan.members.get("elevation_step_rad", 0)
    for word, floor in re.findall(rf"1 sigma: {NUMBER} degrees at the threshold, at best {NUMBER}", " ".join(lines)) if asked else ():
        most, floor_rad = float(word) * DEGREE, float(floor) * DEGREE
        fades_rad = math.sqrt(max(most ** 2 - floor_rad ** 2, 0)) / 10 ** (above_db / 20)
        if most < 0.95 * scan.members["elevation_view_rad"] / 12 ** 0.5:
            hold(scan, "elevation_accuracy_deg", asked, math.hypot(fades_rad, floor_rad, step_rad / 12 ** 0.5), OF_DEVIATIONS * asked, DEGREE)


def compare_detection(scan, printed):
    """Ranges up to which 0, 10 and 20 dBsm are detected with a probability of 0.9, by the range that is stated for the nearest cross section."""
    for printed_dbsm, word in zip((0, 10, 20), printed):
        dbsm, at_m, chance, stronger = min(scan.detected, key=lambda line: abs(line[0] - printed_dbsm))
        asked_m = at_m * (stronger * 10 ** ((printed_dbsm - dbsm) / 20)) ** (1 / scan.members.get("exponent", 2))
        got_m = 0 if word == "-" else float(word.lstrip(">"))
        least_m = max(scan.members["range_min_m"], scan.members.get("range_floor_m", 0.5))
        beyond = word[0] == ">" and asked_m > got_m or word == "-" and asked_m < 1.01 * least_m
        stated = f"with {dbsm:g} dBsm at {at_m:.4g} m and a probability of {chance:g}, "
        hold(scan, f"{stated}{printed_dbsm} dBsm detected up to m", asked_m, asked_m if beyond else got_m, OF_BEAMS * asked_m)
