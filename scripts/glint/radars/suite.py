"""The suite of a data sheet: each member of its sensors, where it comes from, and the tables of its antennas."""
import json
import math
import os

from glint.places import SCHEMAS
from glint.radars import antennas, detection, printed
from glint.radars.figures import ABOUT, DEGREE, FIRST, Figures, Refused, scale
from glint.sets.documents import TABLES, path_of, whole_suite
from glint.sets.plan import read_json, refuse
from glint.sets.schema import fault_of

SUITE = read_json(os.path.join(SCHEMAS, "sensors.json"))
SENSOR = SUITE["properties"]["sensors"]["items"]
LIGHT_MPS = 299792458.0
REFERENCE_DBSM = 10  # of an ERCS of 1
CFAR_FALSE_ALARM = 1e-4  # of a waveform that does not state its own
CLASSES_DBSM = {"car": 10, "truck": 20, "motorcycle": 3, "pedestrian": -3}  # as makers state ranges for
# Members that are figures of the sheet.
PLAIN = {"mount_z_m": "height_m", "mount_yaw_rad": "yaw_left_deg", "carrier_hz": "carrier_ghz", "range_min_m": "range_min_m",
         "field_of_view_rad": "view_full_width_deg", "latency_s": "latency_ms", "unambiguous_range_m": "range_unambiguous_m",
         "fluctuation": "fluctuation", "range_step_m": "range_step_m", "range_rate_step_mps": "speed_step_mps",
         "azimuth_step_rad": "azimuth_step_deg", "elevation_view_rad": "elevation_view_full_width_deg",
         "elevation_step_rad": "elevation_step_deg", "list_limit": "list_limit", "list_order": "list_order"}
# Members that a suite needs, if the sheet does not state them: value, and the reason for it.
USUAL = {"mount_y_m": (0, "in the middle of the front"),
         "mount_yaw_rad": (0, "straight ahead"),
         "carrier_hz": (76.5e9, "76.5 GHz, the middle of the usual band"),
         "range_min_m": (0.2, "the least of published 77 GHz radars"),
         "fluctuation": ("none", "echoes are steady"),
         "range_migration": ("compensated", "echoes that walk through cells do not fade"),
         "final_threshold": (True, "the noisy amplitude is tested"),
         "phase_reference": ("centre", "a pattern symmetric about the array's centre"),
         "list_order": ("strongest", "the strongest targets stay if there are too many"),
         "list_limit": (0, "the list has room for all")}
EXPONENT = 1.25
SLOPE = ("[F] levels of two UMRR-11 fell by 24 and 25 dB a decade of range, of a dense 4D radar by 14, of an ARS430 by 0 to 11 near it; "
         "40 without a control of gain over range")
EXPONENTS = 0.25, 3  # 5 to 60 dB a decade
# A row of elements with a beam of 0.886 lambda/D, of width 1, has a deviation of this over the root of the ratio of powers (MODEL 7.5).
SIGMA_OF_BEAM = math.sqrt(6) / math.tau / 0.8859
ELEVATION = "elevation_accuracy_deg", "elevation_resolution_deg", "elevation_view_full_width_deg", "elevation_step_deg"
LEVEL = "calibration_ercs", "calibration_range_m", "range_curve"
# What holds where a suite has none of these members.
ABSENT = {"cycle_s": "every frame has a scan", "latency_s": "lists have no latency", "unambiguous_range_m": "ranges do not fold",
          "unambiguous_rate_mps": "range rates do not fold", "sigma_law": "range and speed are equally accurate at every signal",
          "elevation_view_rad": "elevations are not measured",
          "elevation_half_width_rad elevation_curve": "echoes are equally strong at every elevation",
          "exponent range_curve": "echoes fall by 40 dB a decade of range"}


class Scan:
    """A sensor of the suite: its members, and where each comes from. Members that the sheet states as such stay as they are."""

    def __init__(self, name, figures, base):
        self.name, self.figures, self.base, self.own = name, figures, base, figures.members
        stated = {member: value for member, value in self.own.items() if value is not None}
        missing = [member for member in SENSOR["required"] if self.own.get(member, 0) is None]
        if fault := fault_of(stated, SENSOR | {"required": []}, name) or missing and f"{name}: members: {missing[0]} is null; a suite needs it":
            raise Refused(fault)
        self.members = {member: value for member, value in (base or {}).items() if member not in self.own} | stated | {"name": name}
        self.sources = self.members.pop("sources", {}) | {member: f"[F] members: {figures.document}" for member in stated}
        self.assumed, self.detected = [], None
        self.size_m = figures.take("vehicle_length_m") or 4.5, figures.take("vehicle_width_m") or 1.8

    def put(self, member, value, *figures):
        """A member that follows from figures of the sheet."""
        if member not in self.own:
            self.members[member] = value
            self.sources[member], guesses = self.figures.source(figures)
            self.assumed += guesses
        elif not alike(self.own[member], value):
            stated = " and ".join(self.figures.told(one, value) for one in figures if one in self.figures)
            raise Refused(f"{self.name}: {stated} and members, {member} {told(self.own[member])}, contradict each other: {told(value)} follows")

    def follow(self, member, value):
        """A member that follows from others."""
        self.members[member] = self.own.get(member, value)

    def drop(self, *members):
        """Takes away what the extended suite has."""
        for member in members:
            if member not in self.own:
                self.members.pop(member, None)

    def assume(self, member, value, reason):
        """A member that the sheet does not state, unless the suite that it extends has it."""
        if member not in self.members and member not in self.own:
            self.members[member], self.sources[member] = value, f"[A] {reason}"
            self.assumed.append(f"{member} {told(value)}: {reason}")

    def choose(self, member, *given):
        """A member that is the first of some (figure, value); the others that the sheet has must agree. The figure, or None."""
        figure, value = self.figures.agreed(*given)
        if figure:
            self.put(member, value, figure)
        return figure

    def unrounded(self, sigma, step, figure):
        """The deviation that becomes this one by rounding to steps."""
        if sigma ** 2 < step ** 2 / 12:
            finest, fine, steps = (told(value / scale(figure)) for value in (step / 12 ** 0.5, sigma, step))
            raise Refused(f"{self.name}: {figure} has {fine}; steps of {steps} alone have a deviation of {finest}")
        return math.sqrt(sigma ** 2 - step ** 2 / 12)

    def copy(self, member, figure):
        return self.choose(member, (figure, self.figures.take(figure)))


def alike(one, other):
    numbers = all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in (one, other))
    return abs(one - other) <= 1e-3 * abs(other) + 1e-9 if numbers else one == other


def told(value):
    return f"{value:.4g}" if isinstance(value, (int, float)) and not isinstance(value, bool) else json.dumps(value).strip('"')


def mount(scan):
    figures = scan.figures
    for axis, size, size_m, origins in (
            ("x", "vehicle_length_m", scan.size_m[0], ("ahead_of_middle_m", "behind_front_bumper_m", "ahead_of_rear_bumper_m")),
            ("y", "vehicle_width_m", scan.size_m[1], ("left_of_middle_m", "inside_left_side_m", "inside_right_side_m"))):
        figure = scan.choose(f"mount_{axis}_m", *((name, part * size_m + sign * figures.take(name)) for name, part, sign in
                                                  zip(origins, (0, 0.5, -0.5), (1, -1, 1)) if name in figures))
        if size not in figures and figure != origins[0] and (figure or axis == "x" and not scan.base):
            scan.assumed.append(f"{size} {size_m}, as of a usual car")
    scan.assume("mount_x_m", scan.size_m[0] / 2, "at the front bumper")


def limits(scan):
    figures, members = scan.figures, scan.members
    scan.copy("range_max_m", "range_max_m" if "range_max_m" in figures or "range_max_m" in members else "detected_at_m")
    rate_hz = figures.take("update_rate_hz")
    scan.choose("cycle_s", ("cycle_ms", figures.take("cycle_ms")), ("update_rate_hz", rate_hz and 1 / rate_hz))
    width_rad = figures.take("elevation_one_way_full_width_deg")
    if scan.choose("elevation_half_width_rad", ("elevation_one_way_full_width_deg", width_rad and width_rad / 2)):
        scan.drop("elevation_curve")
        scan.assume("mount_z_m", 0.5, "in the bumper; the width in elevation needs a height")
    for member, name in (("range_max_m", "range_max_m"), ("field_of_view_rad", "view_full_width_deg")):
        if member not in members:
            raise Refused(f"{scan.name}: {name} is missing")
    least_m, most_m, rows = members["range_min_m"], members["range_max_m"], figures.rows("range_limits", "range_max_m")
    if least_m >= most_m:
        raise Refused(f"{scan.name}: range_min_m {told(least_m)} is not below range_max_m, {told(most_m)}")
    if rows:
        rows = rows if rows[0][0] <= 0 else [(0, most_m), *rows]
        scan.put("range_limits", [{"azimuth_rad": at, "range_max_m": value} for at, value in rows], "range_limits")
    for at, value in rows:
        if at < 0 or not least_m < value <= most_m:
            raise Refused(f"{scan.name}: range_limits have {told(value)} m at {told(math.degrees(at))} degrees; expected azimuths from 0 on, "
                          f"as limits hold to both sides, and more than range_min_m, {told(least_m)}, and at most range_max_m, {told(most_m)}")


def resolution(members, cell):
    """The least distance of two echoes of which each has a cell of its own, half a cell, by the member that states cells."""
    return members[cell] * (0.5 if members.get("cell_extent", "width") == "width" else 1)


def cells(scan):
    """Cells are half widths, unless members state cells."""
    figures, members = scan.figures, scan.members
    kinds = {"cell_range_m": ("range_resolution_m", "range_accuracy_m"), "cell_range_rate_mps": ("speed_resolution_mps", "speed_accuracy_mps")}
    stated = [resolution for resolution, _ in kinds.values() if resolution in figures]
    if "waveform" in members and stated:
        raise Refused(f"{scan.name}: {figures.told(stated[0])} beside a waveform, which sets the cells; extend a suite without one")
    extent = members.get("cell_extent", "width") if scan.own.keys() & {"cell_extent", *kinds} else "half_width"
    size = 2 if extent == "width" else 1
    for member, (name, accuracy) in kinds.items() if stated or not scan.base else ():
        if member in members:
            scan.follow(member, size * resolution(members, member))
        wanted, accuracy_si = figures.take(name), figures.take(accuracy)
        if not scan.choose(member, (name, wanted and size * wanted)) and member not in members and not accuracy_si:
            raise Refused(f"{scan.name}: {name} is missing, and the accuracy from which it could be assumed")
        scan.assume(member, 4 * size * (accuracy_si or 0), "four times the accuracy")
    if stated or not scan.base:
        members["cell_extent"] = extent
    speed = figures.take("speed_max_mps")
    (away, receding), (toward, approaching) = (figures.agreed((name, figures.take(name)), ("speed_max_mps", speed))
                                               for name in ("receding_max_mps", "approaching_max_mps"))
    if away and toward:
        scan.put("unambiguous_rate_mps", (receding + approaching) / 2, away, toward)
        scan.follow("false_alarm_range_rate_mps", members["unambiguous_rate_mps"])
        scan.drop("unambiguous_middle_mps")
        if receding != approaching:
            scan.follow("unambiguous_middle_mps", (receding - approaching) / 2)
    elif away or toward:
        raise Refused(f"{scan.name}: receding_max_kmh and approaching_max_kmh belong together, or speed_max_kmh for both")


def bins(members):
    """The number of cells of a scan, as glint counts them for false alarms, and the width of a bin in range rate."""
    full_m, full_mps = (2 * resolution(members, cell) for cell in ("cell_range_m", "cell_range_rate_mps"))
    ranges, rates = (members["range_max_m"] - members["range_min_m"]) / full_m, 2 * members.get("false_alarm_range_rate_mps", 70) / full_mps
    azimuths = members["field_of_view_rad"] / members["azimuth_cell_rad"] if members.get("azimuth_cell_rad") else 1
    return max(ranges, 1) * max(rates, 1) * max(azimuths, 1), full_mps


def thresholds(scan):
    """Threshold and false alarms by the rate in noise alone, the calibration by what is detected where. Absent: the noise is 1."""
    figures, members, (count, _) = scan.figures, scan.members, bins(scan.members)
    waveform, cells_of_base = members.get("waveform"), scan.base and bins(scan.base)[0]
    if waveform and scan.base and scan.base.get("false_alarms"):  # they tell how many cells the waveform has
        cells_of_base = scan.base["false_alarms"] / waveform.get("cfar_false_alarm", CFAR_FALSE_ALARM)
        count = cells_of_base * (members["range_max_m"] - members["range_min_m"]) / (scan.base["range_max_m"] - scan.base["range_min_m"])
    if scan.base and not any(name in figures for name in (
            "false_alarm_rate", "false_alarms_per_scan", "detected_dbsm", "detected_object", "detected_at_m", "detection_probability", "fluctuation", "detections")):
        if "false_alarms" in members:
            scan.follow("false_alarms", members["false_alarms"] * count / cells_of_base)  # as many in a cell
        return
    rate, alarms = figures.take("false_alarm_rate"), figures.take("false_alarms_per_scan")
    if rate and alarms and not 0.5 < rate * count / alarms < 2:
        raise Refused(f"{scan.name}: false_alarm_rate {told(rate)} in {count:.3g} cells makes {told(rate * count)} false alarms a "
                      f"scan; false_alarms_per_scan is {told(alarms)}")
    scan.drop("threshold_db", "pointer_sigma", "false_alarms")
    if "pointer_sigma" not in scan.own:
        members["pointer_sigma"], scan.sources["pointer_sigma"] = 1, "[T] amplitudes are ratios to the noise"
    if members["pointer_sigma"] == 0:
        raise Refused(f"{scan.name}: members: pointer_sigma 0; what is detected depends on the noise, expected more than 0")
    noise_db = 20 * math.log10(members["pointer_sigma"])
    of_members = math.exp(-10 ** ((members["threshold_db"] - noise_db) / 10)) if "threshold_db" in members else None
    of_members = waveform.get("cfar_false_alarm", CFAR_FALSE_ALARM) if waveform and not of_members else of_members
    rate = rate or (alarms / count if alarms else of_members) or 1e-6
    if rate > 0.1:
        what = figures.told("false_alarms_per_scan") if alarms else f"threshold_db {told(members['threshold_db'])}"
        raise Refused(f"{scan.name}: {what} in {count:.3g} cells is a rate of {told(rate)} in each; expected 0.1 or less")
    threshold_db, name = 10 * math.log10(-math.log(rate)), "false_alarm_rate" if "false_alarm_rate" in figures else "false_alarms_per_scan"
    if name in figures:
        scan.put("threshold_db", threshold_db + noise_db, name)
    scan.assume("threshold_db", threshold_db + noise_db, f"a false alarm rate of {told(rate)} in each of {count:.3g} cells")
    if alarms:
        scan.put("false_alarms", alarms, "false_alarms_per_scan")
    scan.follow("false_alarms", alarms or rate * count)
    if waveform:
        scan.follow("waveform", waveform | {"cfar_false_alarm": rate})
    if not scan.base and not members.keys() & {"exponent", "range_curve"} and len(figures.detections()) < 2:
        members["exponent"], scan.sources["exponent"] = EXPONENT, SLOPE
        scan.assumed.append(f"echoes fall by {20 * EXPONENT:g} dB a decade of range (exponent {EXPONENT}), as measured of radars")
    if not scan.own.keys() & set(LEVEL):
        scan.drop(*LEVEL)
        calibrate(scan, 10 ** ((members["threshold_db"] - noise_db) / 20))


def one_detection(figures):
    """What is detected by figures of their own, as a row of `detections`; absent: a car."""
    kind, dbsm = figures.take("detected_object"), figures.take("detected_dbsm")
    figures.agreed(("detected_object", CLASSES_DBSM.get(kind)), ("detected_dbsm", dbsm))
    row = {"at_m": figures.take("detected_at_m"), "probability": figures.take("detection_probability")}
    return row | ({"object": kind or "car"} if dbsm is None else {"dbsm": dbsm})


def detections(scan):
    """One or two of (cross section in dBsm, range in m, probability) that the sheet states; absent: a car at the greatest range with 0.9."""
    figures, members, stated = scan.figures, scan.members, []
    limit_m = min([members["range_max_m"], *(row["range_max_m"] for row in members.get("range_limits", [])[:1])])
    for row in figures.detections() or [one_detection(figures)]:
        kind, at_m, chance = row.get("object"), row.get("at_m"), row.get("probability")
        stated.append((CLASSES_DBSM[kind] if kind else row["dbsm"], at_m or members["range_max_m"], chance or 0.9))
        if at_m and at_m > limit_m:
            name = "detections, at_m" if "detections" in figures else "detected_at_m"
            raise Refused(f"{scan.name}: {name} {told(at_m)} is beyond the range limit on boresight, {told(limit_m)}")
        missing = [what for what, absent in ((f"cross section of a {kind}", kind), ("range", not at_m), ("probability", not chance)) if absent]
        if missing:
            scan.assumed.append(f"{told_of(*stated[-1])}; the sheet does not state the {' or the '.join(missing)}")
    return stated


def told_of(dbsm, at_m, chance):
    return f"{dbsm:g} dBsm are detected at {told(at_m)} m with a probability of {told(chance)}"


def exponent_of(scan, lines, strong):
    """The exponent by which amplitudes fall from one line of detection to the other, whose mean amplitudes are `strong`."""
    (dbsm, at_m, _), (other_dbsm, other_m, _) = lines
    rise = 10 ** ((dbsm - other_dbsm) / 20) * strong[1] / strong[0]
    exponent = math.log(rise) / math.log(at_m / other_m) if at_m != other_m else math.inf
    if not EXPONENTS[0] <= exponent <= EXPONENTS[1]:
        falls = f"let echoes fall by {20 * exponent:.3g} dB a decade of range" if at_m != other_m else "are at one range"
        least_db, most_db = (20 * end for end in EXPONENTS)
        raise Refused(f"{scan.name}: detections: that {' and that '.join(told_of(*line) for line in lines)} {falls}; "
                      f"expected two ranges, and {least_db:g} to {most_db:g} dB")
    return exponent


def calibrate(scan, threshold):
    members, lines, law = scan.members, detections(scan), detection.Law(scan.members)
    strong = [law.amplitude(chance, threshold) for *_, chance in lines]
    for amplitude, (*_, chance) in zip(strong, lines):
        if abs(law.probability(amplitude, threshold) - chance) > 0.01:
            raise Refused(f"{scan.name}: detection_probability {chance:g} is not reached; an echo at the threshold has "
                          f"{law.probability(threshold, threshold):.3g}")
    if len(lines) == 2:
        scan.put("exponent", exponent_of(scan, lines, strong), "detections")
    likely = law.amplitude(0.9, threshold)
    scan.detected = [(*line, amplitude / likely) for line, amplitude in zip(lines, strong)]
    dbsm, at_m, _ = lines[0]
    scan.put("calibration_ercs", 10 ** ((dbsm - REFERENCE_DBSM) / 20), "detected_dbsm", "detected_object", "detections")
    scan.put("calibration_range_m", at_m * (strong[0] / threshold) ** (1 / members.get("exponent", 2)), "detected_at_m",
             "detection_probability", "detections")


def accuracy(scan):
    """The antenna's table, and the standard deviations of range and range rate."""
    members = scan.members
    scan.copy("range_sigma_share", "range_accuracy_percent")
    for member, step, name, what in (("range_sigma_m", "range_step_m", "range_accuracy_m", "cell_range_m"),
                                     ("range_rate_sigma_mps", "range_rate_step_mps", "speed_accuracy_mps", "cell_range_rate_mps")):
        sigma = scan.figures.take(name)
        if scan.choose(member, (name, sigma and scan.unrounded(sigma, members.get(step, 0), scan.figures.spelled(name)))):
            scan.drop("sigma_law")
        scan.assume(member, resolution(members, what) / 4, "a quarter of the resolution")
    return antennas.tables(scan)


def elevation(scan):
    """The standard deviation of elevations at the threshold, by the beam or by the accuracy, and the floor that makes up the difference."""
    figures, members, stated = scan.figures, scan.members, [name for name in ELEVATION if name in scan.figures]
    accuracy_rad, beam_rad = figures.take("elevation_accuracy_deg"), figures.take("elevation_resolution_deg")
    if stated and "elevation_view_rad" not in members:
        raise Refused(f"{scan.name}: {figures.told(stated[0])} needs elevation_view_full_width_deg beside it")
    if stated:
        scan.assume("mount_z_m", 0.5, "in the bumper; elevation needs a height")
    if not (accuracy_rad or beam_rad) and (not stated or members.keys() & {"elevation_sigma_rad", "elevation_floor_rad"}):
        return
    times = math.sqrt(antennas.reference_snr(scan) / antennas.least_snr(scan))
    if not (accuracy_rad or beam_rad):
        accuracy_rad = members["elevation_view_rad"] / 100
        scan.assumed.append(f"the accuracy of elevations is {accuracy_rad / DEGREE:.3g} degrees, a hundredth of their view")
    sigma_rad = accuracy_rad and scan.unrounded(accuracy_rad, members.get("elevation_step_rad", 0), "elevation_accuracy_deg")
    of_beam_rad = SIGMA_OF_BEAM * beam_rad / math.sqrt(antennas.least_snr(scan)) if beam_rad else times * sigma_rad
    finest_rad = of_beam_rad / times
    if sigma_rad and sigma_rad < 0.98 * finest_rad:
        raise Refused(f"{scan.name}: {figures.told('elevation_accuracy_deg')} is finer than {finest_rad / DEGREE:.3g} degrees, what elements with "
                      f"{figures.told('elevation_resolution_deg')} have {20 * math.log10(times):.3g} dB above the threshold")
    scan.put("elevation_sigma_rad", of_beam_rad, "elevation_accuracy_deg", "elevation_resolution_deg")
    scan.drop("elevation_floor_rad")
    if sigma_rad and sigma_rad > 1.01 * finest_rad:
        scan.follow("elevation_floor_rad", math.sqrt(sigma_rad ** 2 - finest_rad ** 2))


def scan_of(name, figures, base):
    scan = Scan(name, figures, base)
    if base:
        scan.assumed.append(f"what the sheet does not state is as in {figures.extends}" + (f", {base['name']}" if base["name"] != name else ""))
    for member, figure in PLAIN.items():
        scan.copy(member, figure)
    mount(scan)
    for member, (value, reason) in ({} if base else USUAL).items():
        scan.assume(member, value, reason)
    limits(scan)
    cells(scan)
    thresholds(scan)
    tables = accuracy(scan)
    elevation(scan)
    scan.assumed += [sentence for names, sentence in ABSENT.items() if not scan.members.keys() & set(names.split())]
    if left := sorted(figures.values.keys() - figures.used):
        raise Refused(f"{name}: {', '.join(left)}: not used beside the other figures")
    if fault := fault_of(scan.members, SENSOR, name):
        raise Refused(fault)
    return scan, tables


def check_dwells(radar, scans):
    """The scans of one radar follow each other in its cycle."""
    dwells_s = [LIGHT_MPS / scan.members["carrier_hz"] / (2 * bins(scan.members)[1]) for scan in scans]
    cycles_s = {scan.members["cycle_s"] for scan in scans if "cycle_s" in scan.members}
    if cycles_s and sum(dwells_s) > min(cycles_s) * (1 + 1e-6):
        parts = " and ".join(f"{1e3 * dwell_s:.3g} ms" for dwell_s in dwells_s)
        raise Refused(f"{radar}: a speed resolution as stated takes a dwell of {parts}, more than cycle_ms, {1e3 * min(cycles_s):.3g}")


def base_suite(name, beside, out):
    """The suite that a sheet extends, by name or by its path beside the sheet, with paths of tables as from the new suite; its path."""
    path = path_of(name, "suite", beside)
    suite = whole_suite(path)
    refuse(fault := fault_of(suite, SUITE), path, fault)
    for sensor in suite["sensors"]:
        for member in sensor.keys() & set(TABLES):
            there = os.path.join(os.path.dirname(path), sensor[member])
            sensor[member] = os.path.relpath(os.path.realpath(there), os.path.realpath(os.path.dirname(out)))
    return suite, path


def scans_of(sheet, bases):
    """All scans of all radars, with their tables; without radars, one for each that the extended suite has."""
    made = {}
    for radar in sheet.get("radars") or [{"name": one["name"]} for one in bases] or [{}]:
        radar, of_radar = {"name": "front"} | radar, []
        for part in radar.get("scans", [{}]):
            name = "_".join(one["name"] for one in (radar, part) if "name" in one)
            if name in made:
                raise Refused(f"two radars or scans have the name {name}")
            base = next((one for one in bases if one["name"] == name), bases[0] if bases else None)
            made[name] = scan_of(name, Figures(name, sheet, radar, part), base)
            of_radar.append(made[name][0])
        check_holds(radar, of_radar)
        check_dwells(radar["name"], of_radar)
    check_holds(sheet, [scan for scan, _ in made.values()])
    return made.values()


def check_holds(part, scans):
    """A figure of a sheet or a radar holds for one of its scans or more."""
    for name in part.keys() - ABOUT.keys():
        if all(scan.figures.values.get(name) != part[name] for scan in scans):
            raise Refused(f"{name} {told(part[name])} holds for no scan; {scans[0].name} has {scans[0].figures.told(FIRST[name])}")


def suite_of(sheet, beside, out):
    """The suite that the sheet makes and its tables, as texts by path."""
    (base, path), tables, sensors, assumed = base_suite(sheet["extends"], beside, out) if "extends" in sheet else ({}, None), {}, [], {}
    kept, scans = {path and os.path.realpath(path)}, scans_of(sheet, base.get("sensors", []))
    for sensor in (*base.get("sensors", []), *(scan.members for scan, _ in scans)):
        kept |= {os.path.realpath(os.path.join(os.path.dirname(out), sensor[member])) for member in sensor.keys() & set(TABLES)}
    for scan, of_scan in scans:
        for member, table in of_scan.items():
            path = f"{os.path.splitext(out)[0]}-{scan.name}{'-floor' if member == 'azimuth_floor_curve' else ''}.csv"
            if path in tables:
                raise Refused(f"{scan.name}: {path} is a table of another radar or scan; expected another name")
            tables[path], scan.members[member] = antennas.text_of(table), os.path.basename(path)
        sensors.append(scan.members | {"sources": {name: scan.sources[name] for name in scan.members if name in scan.sources}})
        for sentence in scan.assumed:
            assumed.setdefault(sentence, []).append(scan.name)
    origin = sheet.get("origin", f"Made by scripts/make-radar from {sheet.get('document', 'a data sheet')}.")
    sentences = [f"{', '.join(names)}: {sentence}." for sentence, names in assumed.items()]
    vehicles = sheet.get("vehicles") or base.get("vehicles", "detailed")  # of real radars' lists
    suite = base | {"origin": origin, "vehicles": vehicles, "sensors": sensors, "assumed": sentences}
    files = {out: json.dumps(suite, indent=2, ensure_ascii=False) + "\n"} | tables
    for path in files:
        refuse(os.path.realpath(path) in kept, path, "the extended suite or the sheet's members need this file; expected another name after -o")
    lines = printed.of_suite(suite, out, tables)
    for scan, _ in scans:
        printed.compare(scan, lines[scan.name])
    return files
