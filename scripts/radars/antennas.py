"""Tables of antennas: sums by the gain over azimuth, deltas by the accuracy of the azimuth.

With r = delta/sum the standard deviation of the azimuth at a ratio of powers S is sqrt(1 + r^2)/(r' sqrt(2 S)) (MODEL 7.3), so
asinh r is the integral of 1/(sigma sqrt(2 S)) over the azimuth.
"""
import math

from figures import DEGREE, Refused

ROWS = 100  # on either side
MOST = 8.0  # of asinh r: the delta channel is then 1,500 times as strong as the sum
LEAST_DB = -80.0
STATED = ("gains", "beam_two_way_full_width_deg", "azimuth_accuracy_deg", "azimuth_accuracies",
          "receive_positions_wavelengths", "transmit_positions_wavelengths", "view_full_width_deg")


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


def elements_sigma(scan, snr):
    """Of a row of elements, the standard deviation of the azimuth on boresight; None without elements."""
    places = [scan.figures.places(name) for name in ("transmit_positions_wavelengths", "receive_positions_wavelengths")]
    if not places[1]:
        if places[0]:
            raise Refused(f"{scan.name}: transmit_positions_wavelengths need receive_positions_wavelengths")
        return None
    virtual = sorted({a + b for a in places[0] or [0] for b in places[1]})
    if len(virtual) < 2:
        raise Refused(f"{scan.name}: receive_positions_wavelengths has {len(virtual)} place; expected two or more")
    aperture = virtual[-1] - virtual[0] + min(b - a for a, b in zip(virtual, virtual[1:]))
    scan.assumed.append(f"{len(virtual)} virtual elements over {aperture:.4g} wavelengths set the accuracy of azimuths and do not separate echoes")
    return 0.39 / (aperture * math.sqrt(snr))


def accuracies(scan, half_rad, snr):
    """The standard deviation of the azimuth over azimuth, in rad: a function."""
    rows, bound = scan.figures.rows("azimuth_accuracies", "accuracy_deg"), elements_sigma(scan, snr)
    figure, stated = scan.figures.agreed(("azimuth_accuracies", between(rows, 0) if rows else None),
                                         ("azimuth_accuracy_deg", scan.figures.take("azimuth_accuracy_deg")))
    if bound and stated and stated < 0.9 * bound:
        raise Refused(f"{scan.name}: an azimuth accuracy of {stated / DEGREE:.3g} degrees is finer than {bound / DEGREE:.3g}, what the "
                      f"elements have at {10 * math.log10(snr):.3g} dB")
    if stated or bound:
        scan.put("azimuth_sigma_rad", stated or bound, figure or "receive_positions_wavelengths")
    else:
        scan.assume("azimuth_sigma_rad", half_rad / 50, "a hundredth of the field of view")
    sigma, step = scan.members["azimuth_sigma_rad"], scan.members.get("azimuth_step_rad", 0)
    if scan.members.pop("azimuth_floor_rad", None):
        scan.assumed.append("azimuths have no floor of their noise beside the accuracy")
    if rows:
        return lambda at: scan.unrounded(between(rows, at), step, "azimuth_accuracies")
    sigma = scan.unrounded(sigma, step, "azimuth_accuracy_deg")
    return lambda at: sigma / (1 if stated or not bound else max(math.cos(at), 0.02))


def reference_snr(scan):
    """The ratio of powers at which accuracies hold."""
    snr_db = scan.figures.take("accuracy_snr_db")
    if snr_db is None:
        snr_db = scan.members["threshold_db"] - 20 * math.log10(scan.members["pointer_sigma"]) + 20
        scan.assumed.append(f"the accuracy of azimuths, a standard deviation, holds 20 dB above the threshold, {snr_db:.3g} dB over the noise")
    return 10 ** (snr_db / 10)


def rows_of(level, sigma, half_rad, snr, scan):
    """Rows from one side to the other, beyond the field of view by five deviations. Mirrored rows are mirrored exactly."""
    reach_rad = min(1.02 * half_rad + 5 * sigma(half_rad), math.pi / 2)
    psi, step, sides = 0, reach_rad / ROWS, {1: [(0, 10 ** (level(0) / 20), 0)], -1: []}
    for side, rows in sides.items():
        psi = 0
        for i in range(1, ROWS + 1):
            at, between_rad = side * i * step, [side * step * (i - 1 + (k + 0.5) / 8) for k in range(8)]
            psi += sum(step / 8 / sigma(place) for place in between_rad) / math.sqrt(2 * snr)
            rows.append((at, 10 ** (level(at) / 20), side * math.sinh(min(psi, MOST))))
        if psi > MOST:
            raise Refused(f"{scan.name}: the azimuth accuracy of {sigma(0) / DEGREE:.3g} degrees over {2 * half_rad / DEGREE:.3g} degrees of view "
                          f"is finer than one pair of beams has at {10 * math.log10(snr):.3g} dB; expected "
                          f"{sigma(0) / DEGREE * psi / MOST:.3g} or more, or a higher accuracy_snr_db")
    return [(at, total, total * ratio) for at, total, ratio in sides[-1][::-1] + sides[1]]


def table(scan):
    """Rows (azimuth, sum, delta) of the antenna; None if the sheet states nothing of it and extends a suite."""
    if "antenna_pattern" in scan.members and not any(name in scan.figures for name in STATED):
        return None
    half_rad, snr = scan.members["field_of_view_rad"] / 2, reference_snr(scan)
    sigma = accuracies(scan, half_rad, snr)
    level = beam(scan, half_rad)
    scan.members.pop("azimuth_curve", None)
    scan.members["antenna_pattern"] = "table"
    return rows_of(level, sigma, half_rad, snr, scan)


def write(rows, path):
    with open(path, "w", encoding="ascii") as out:
        out.write("azimuth_rad,sum,delta\n")
        out.writelines(",".join(f"{value:.12g}" for value in row) + "\n" for row in rows)
