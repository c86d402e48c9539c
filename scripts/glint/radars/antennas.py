"""Antennas by the figures of a sheet: rows of elements, or sum and delta; their gain, and the noise of azimuths beside theirs.

With r = delta/sum the standard deviation of the azimuth at a ratio of powers S is sqrt(1 + r^2)/(r' sqrt(2 S)) (MODEL 7.3), so
asinh r ascends evenly with the azimuth where the deviation sigma is the same: by 1/(sigma sqrt(2 S)).
"""
import math

from glint.radars.figures import DEGREE, Refused

ROWS = 100  # on either side
MOST = 8.0  # of asinh r: the delta channel is then 1,500 times as strong as the sum
LEAST_DB = -80.0
MOST_ELEMENTS = 256  # of an array of glint
STATED = ("gains", "beam_two_way_full_width_deg", "azimuth_accuracy_deg", "azimuth_accuracies",
          "azimuth_resolution_deg", "receive_positions_wavelengths", "transmit_positions_wavelengths", "view_full_width_deg")


def between(rows, at):
    """Straight between rows (azimuth, value), constant beyond; of rows without a negative azimuth at either side."""
    at = abs(at) if rows[0][0] >= 0 else at
    at = min(max(at, rows[0][0]), rows[-1][0])
    for (x, low), (y, high) in zip(rows, rows[1:]):
        if x <= at <= y:
            return low + (high - low) * (at - x) / (y - x)
    return rows[0][1]


def beam(scan, half_rad):
    """The level over azimuth in dB, both ways: a function."""
    width_rad, gains = scan.figures.take("beam_two_way_full_width_deg"), scan.figures.rows("gains", "two_way_db", "one_way_db")
    if gains:
        levels = [between(gains, 0.01 * DEGREE * i) - between(gains, 0) for i in range(-18000, 18000)]
        shown_deg, stated_deg = 0.01 * sum(level_db >= -3 for level_db in levels), (width_rad or 0) / DEGREE
        if width_rad and abs(shown_deg - stated_deg) > 0.05 * stated_deg:
            raise Refused(f"{scan.name}: gains are down by 3 dB both ways over {shown_deg:.3g} degrees, and with "
                          f"{scan.figures.told('beam_two_way_full_width_deg')} over {stated_deg:.3g}")
        return lambda at: max(between(gains, at) - between(gains, 0), LEAST_DB)
    if width_rad is None:
        scan.assumed.append("the beam is down by 6 dB both ways at the border of the field of view")
        width_rad = math.sqrt(2) * half_rad
    return lambda at: max(-3 * (2 * at / width_rad) ** 2, LEAST_DB)


def array(scan, half_rad):
    """Puts the array that the sheet states, or that resolves as it states. The deviation of a sine at a ratio of powers of 1, or None."""
    figures, resolution_rad, most = scan.figures, scan.figures.take("azimuth_resolution_deg"), 0.5 / math.sin(half_rad)
    transmit, receive = (figures.places(f"{way}_positions_wavelengths") or [one["place"] for one in scan.members.get("array", {}).get(way, [])]
                         for way in ("transmit", "receive"))
    if resolution_rad and "receive_positions_wavelengths" not in figures:
        count = next((n for n in range(8, MOST_ELEMENTS + 1) if beam_sines(n) <= resolution_rad * most), None)
        if not count:
            raise Refused(f"{scan.name}: {figures.told('azimuth_resolution_deg')} takes more than {MOST_ELEMENTS} elements {most:.4g} wavelengths apart, the "
                          f"farthest in a view of {2 * half_rad / DEGREE:.4g} degrees")
        transmit, receive = [0], [n * beam_sines(count) / resolution_rad for n in range(count)]
        scan.assumed.append(f"{count} receivers {receive[1]:.4g} wavelengths apart have {figures.told('azimuth_resolution_deg')}")
    virtual = sorted(a + b for a in transmit or [0] for b in receive)
    steps = [b - a for a, b in zip(virtual, virtual[1:])]
    if not virtual and not transmit:
        return None
    if not 2 <= len(virtual) <= MOST_ELEMENTS or max(steps) > most * (1 + 1e-9) or max(steps) - min(steps) > 1e-6 or min(steps) <= 0:
        raise Refused(f"{scan.name}: {len(virtual)} sums of transmit and receive positions, {min(steps, default=0):g} to {max(steps, default=0):g} "
                      f"wavelengths apart; expected 2 to {MOST_ELEMENTS} in even steps of at most {most:.4g}, beyond which two directions in a view of "
                      f"{2 * half_rad / DEGREE:.4g} degrees look alike")
    shown_rad = beam_sines(len(virtual)) / steps[0]
    if resolution_rad and not 0.7 < shown_rad / resolution_rad < 1.3:
        raise Refused(f"{scan.name}: {len(virtual)} elements {steps[0]:g} wavelengths apart resolve {shown_rad / DEGREE:.3g} degrees, "
                      f"not {figures.told('azimuth_resolution_deg')}")
    scan.put("array", {"transmit": [{"place": place} for place in transmit or [0]], "receive": [{"place": place} for place in receive]},
             "transmit_positions_wavelengths", "receive_positions_wavelengths", "azimuth_resolution_deg")
    return math.sqrt(6 / (len(virtual) ** 2 - 1)) / (math.tau * steps[0])


def beam_sines(count):
    """The width of a row's beam in sines, down by 3 dB, for steps of a wavelength: within 0.1 % from 4 elements on."""
    return 0.8859 * (1 + 0.46 / count ** 2) / count


def accuracy(scan):
    """The standard deviation of the azimuth over azimuth, in rad, before rounding: a function; None if the sheet has none."""
    rows, step = scan.figures.rows("azimuth_accuracies", "accuracy_deg"), scan.members.get("azimuth_step_rad", 0)
    figure = scan.choose("azimuth_sigma_rad", ("azimuth_accuracies", between(rows, 0) if rows else None),
                         ("azimuth_accuracy_deg", scan.figures.take("azimuth_accuracy_deg")))
    return figure and (lambda at: scan.unrounded(between(rows, at) if rows else scan.members["azimuth_sigma_rad"], step, figure))


def least_snr(scan):
    """The ratio of powers at the threshold."""
    if scan.members["pointer_sigma"] == 0:
        raise Refused(f"{scan.name}: pointer_sigma 0; the accuracy of angles depends on the noise, expected more than 0")
    return 10 ** (scan.members["threshold_db"] / 10) / scan.members["pointer_sigma"] ** 2


def reference_snr(scan):
    """The ratio of powers at which accuracies of angles hold."""
    snr_db = scan.figures.take("accuracy_snr_db")
    if snr_db is None:
        snr_db = 10 * math.log10(least_snr(scan)) + 20
        sentence = f"the accuracy of angles, a standard deviation, holds 20 dB above the threshold, {snr_db:.3g} dB over the noise"
        if sentence not in scan.assumed:  # azimuths and elevations need it
            scan.assumed.append(sentence)
    return 10 ** (snr_db / 10)


def pair(scan, level, sigma, half_rad, snr):
    """Sum and delta, a little beyond the field of view, by which azimuths have the deviation sigma everywhere."""
    reach_rad = min(1.02 * half_rad + 5 * sigma, math.pi / 2)
    finest_deg = reach_rad / MOST / math.sqrt(2 * snr) / DEGREE
    if sigma < finest_deg * DEGREE:
        raise Refused(f"{scan.name}: the azimuth accuracy of {sigma / DEGREE:.3g} degrees over {2 * half_rad / DEGREE:.3g} degrees of view is finer "
                      f"than one pair of beams has at {10 * math.log10(snr):.3g} dB; expected {finest_deg:.3g} or more, a higher accuracy_snr_db, "
                      "or azimuth_resolution_deg")
    places = [(reach_rad * i / ROWS, 10 ** (level(reach_rad * i / ROWS) / 20)) for i in range(-ROWS, ROWS + 1)]
    return [(at, gain, gain * math.sinh(at / sigma / math.sqrt(2 * snr))) for at, gain in places]


def tables(scan):
    """Tables of the antenna by the members that name them; none if the sheet states nothing of it and extends a suite."""
    members, half_rad = scan.members, scan.members["field_of_view_rad"] / 2
    if scan.own.keys() & {"antenna_pattern", "antenna_table", "array"}:
        row = "array" in members
        scan.assume("antenna_pattern", "array" if row else "table", "as members state the antenna")
        scan.assume("angle_estimator", "beams" if row else "ratio", "as members state the antenna")
        scan.assume("azimuth_sigma_rad", half_rad / 50, "a hundredth of the field of view")
        return {}
    if "antenna_pattern" in members and not any(name in scan.figures for name in STATED):
        return {}
    snr = reference_snr(scan)
    stated, row, level = accuracy(scan), array(scan, half_rad), beam(scan, half_rad)
    places = [min(1.001 * half_rad, math.pi / 2) * i / ROWS for i in range(-ROWS, ROWS + 1)]
    scan.drop("azimuth_curve", "antenna_table", "azimuth_floor_curve", "azimuth_floor_rad")
    if row:
        antenna = [row / math.sqrt(snr) / max(math.cos(at), 0.02) for at in places]
        scan.assume("azimuth_sigma_rad", antenna[ROWS], "that of the elements")
        scan.assume("cell_phase", "by_path", "echoes of a cell have the phases of their paths, without which azimuths cannot separate them")
        scan.follow("antenna_pattern", "array")
        scan.follow("angle_estimator", "beams")
        made = {"azimuth_curve": [(at, level(at)) for at in places]}
    else:
        finest_rad = 1.02 * half_rad / max(MOST * math.sqrt(2 * snr) - 5, 1)  # of one pair of beams
        scan.assume("azimuth_sigma_rad", max(half_rad / 50, finest_rad), "a hundredth of the field of view, or what one pair of beams has")
        antenna = [min(map(stated, places)) if stated else members["azimuth_sigma_rad"]] * len(places)
        scan.follow("antenna_pattern", "table")
        scan.follow("angle_estimator", "ratio")
        scan.drop("array")
        made = {"antenna_table": pair(scan, level, antenna[0], half_rad, snr)}
    made |= floors(scan, [(at, stated(at), sigma) for at, sigma in zip(places, antenna)] if stated else [], snr)
    return {member: rows for member, rows in made.items() if member not in scan.own}


def floors(scan, rows, snr):
    """Puts what the stated deviations have beside those of the antenna, of rows (azimuth, stated, antenna's): its level over azimuth."""
    for at, stated, antenna in rows:
        if stated < 0.98 * antenna and (at == 0 or "azimuth_accuracies" in scan.figures):
            raise Refused(f"{scan.name}: an azimuth accuracy of {stated / DEGREE:.3g} degrees at {at / DEGREE:.3g} degrees is finer than "
                          f"{antenna / DEGREE:.3g}, what the elements have at {10 * math.log10(snr):.3g} dB")
    if any(stated < 0.98 * antenna for _, stated, antenna in rows):
        scan.assumed.append(f"azimuths at the border are as accurate as the elements allow, {rows[-1][2] / DEGREE:.3g} degrees")
    if all(stated < 1.01 * antenna for _, stated, antenna in rows):
        return {}
    curve = [(at, 10 * math.log10(max(stated ** 2 - antenna ** 2, 1e-4 * antenna ** 2))) for at, stated, antenna in rows]
    scan.follow("azimuth_floor_rad", 10 ** (curve[ROWS][1] / 20))
    return {"azimuth_floor_curve": curve}


def text_of(rows):
    """A table as a file has it."""
    heading = "azimuth_rad,sum,delta\n" if len(rows[0]) == 3 else "azimuth_rad,level_db\n"
    return heading + "".join(",".join(f"{value:.12g}" for value in row) + "\n" for row in rows)
