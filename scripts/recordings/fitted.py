"""What the first half of a recording says of its annotation and of its radar; the latter as a suite with sources."""
import json
import math
import os
import statistics
from collections import namedtuple

import geometry
import statics
from readers import STANDING

# A list is lag_s older than its boxes, and near faces lie inset_m inside them.
Annotation = namedtuple("Annotation", "lag_s inset_m")
# azimuth_noise: standard deviation in rad at a signal as strong as the noise; sensor: members of a suite's sensor.
Fit = namedtuple("Fit", "annotation curve azimuth_noise sensor")
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
LEAST = 0.001  # share of the detections that may be weaker than the threshold
# Members that lists do not show, and figures for which a half may have too few detections: those of lrr77-full.
SHIPPED = ("range_floor_m diffraction curved_sides micro_motion bounces fluctuation fluctuation_sigma_db antenna_pattern "
           "phase_reference angle_estimator final_threshold list_order list_limit azimuth_sigma_rad cell_range_m "
           "cell_range_rate_mps range_sigma_m range_rate_sigma_mps").split()


class Curve(namedtuple("Curve", "at_1_m per_decade per_deg2 per_deg4", defaults=(0, 0))):
    """Signal-to-noise ratio in dB of 0 dBsm: at 1 m, and how it falls over range and over azimuth in degrees."""

    def snr_db(self, range_m, azimuth_rad):
        square = math.degrees(azimuth_rad) ** 2
        return self.at_1_m - self.per_decade * math.log10(range_m) - self.per_deg2 * square - self.per_deg4 * square ** 2


def quantile(values, share):
    values = sorted(values)
    return values[min(int(share * len(values)), len(values) - 1)]


def spread(values):
    """Standard deviation by the median of magnitudes, so that a few wrong pairs do not count."""
    return 1.4826 * statistics.median(map(abs, values))


def least_squares(rows, values):
    """The coefficients of the columns of rows, by the normal equations."""
    n = len(rows[0])
    system = [[sum(row[i] * row[j] for row in rows) for j in range(n)]
              + [sum(row[i] * value for row, value in zip(rows, values))] for i in range(n)]
    for i in range(n):
        for j in range(n):
            if j != i:  # positive definite, so that pivots are on the diagonal
                factor = system[j][i] / system[i][i]
                system[j] = [one - factor * other for one, other in zip(system[j], system[i])]
    return [system[i][n] / system[i][i] for i in range(n)]


def annotation(recording):
    """Lag and inset, by the nearest detection of each road user against its range rate: a median for each, then a line.
    Without two whose rates differ by 2 m/s the lag is taken as 0."""
    offsets = {}
    for scan in recording.scans:
        for box in scan.boxes:
            seen = geometry.gated(recording.radar, box, scan.detections)
            if seen and box.kind not in STANDING:
                off_m = min(one.range_m for one in seen) - geometry.nearest_m(recording.radar, box)
                offsets.setdefault(box.id, []).append((geometry.look(recording.radar, box).range_rate_mps, off_m))
    middles = [tuple(map(statistics.median, zip(*own))) for own in offsets.values() if len(own) >= 5]
    rates = [rate for rate, _ in middles]
    if not middles or max(rates) - min(rates) < 2:
        return Annotation(0, statistics.median([off for _, off in middles] or [0]))
    line = statistics.linear_regression(rates, [off for _, off in middles])
    return Annotation(-line.slope, line.intercept)


def curve(detections, threshold_db):
    """By least squares where lists have both figures. With cross sections alone, the weakest tenth of each eighth of the
    ranges meets the threshold. Without cross sections 40 dB a decade are assumed."""
    if all(None not in one for one in detections):
        squares = [math.degrees(one.azimuth_rad) ** 2 for one in detections]
        rows = [(1, -math.log10(one.range_m), -square, -square ** 2) for one, square in zip(detections, squares)]
        return Curve(*least_squares(rows, [one.snr_db - one.rcs_dbsm for one in detections]))
    if any(one.rcs_dbsm is None for one in detections):
        return Curve(threshold_db + 40 * math.log10(max(one.range_m for one in detections)), 40)
    ordered = sorted(detections)
    parts = [ordered[len(ordered) * i // 8:len(ordered) * (i + 1) // 8] for i in range(8)]
    rows = [(1, -math.log10(statistics.median(one.range_m for one in part))) for part in parts]
    return Curve(*least_squares(rows, [threshold_db - quantile([one.rcs_dbsm for one in part], 0.1) for part in parts]))


def completed(scans, law):
    """The scans with both figures in each detection, each from the other by the curve."""
    def of(one):
        gain = law.snr_db(one.range_m, one.azimuth_rad)
        snr_db = one.rcs_dbsm + gain if one.snr_db is None else one.snr_db
        return one._replace(snr_db=snr_db, rcs_dbsm=snr_db - gain if one.rcs_dbsm is None else one.rcs_dbsm)

    return [scan._replace(detections=[of(one) for one in scan.detections]) for scan in scans]


def cells(scans):
    """The least distance in range of detections whose rates agree, and in rate of those whose ranges do; 1 in 100 pairs
    of neighbours may be closer."""
    pairs = [(abs(one.range_m - other.range_m), abs(one.range_rate_mps - other.range_rate_mps))
             for scan in scans for i, one in enumerate(scan.detections) for other in scan.detections[:i]]
    near = {"cell_range_m": [off_m for off_m, off_mps in pairs if off_mps < 0.1 and off_m < 10],
            "cell_range_rate_mps": [off_mps for off_m, off_mps in pairs if off_m < 0.3 and off_mps < 5]}
    return {name: quantile(found, 0.01) for name, found in near.items() if len(found) >= 5}


def noise(radar, scans):
    """Standard deviations of statics from scan to scan, of range, range rate and azimuth, and the azimuth's at a signal
    as strong as the noise."""
    found, rates = [], []
    speeds = statics.ego_speeds(radar, scans)
    still = [statics.standing(radar, scan.detections, speed) for scan, speed in zip(scans, speeds)]
    for i in range(1, len(scans)):
        own = statics.pairs(still[i - 1], still[i], speeds[i] * (scans[i].time_s - scans[i - 1].time_s))
        found += own if len(own) >= 8 else []
        rates += [one.range_rate_mps + speeds[i] * x / one.range_m for x, y, one in still[i] if abs(y) < 0.05 * x]
    if len(found) < 40 or len(rates) < 20:
        return {}, 0.05
    found.sort(key=lambda pair: min(pair[2].snr_db, pair[3].snr_db))
    weak, strong = [(spread([pair[1] for pair in half]) ** 2 / 2,
                     statistics.fmean(10 ** (-min(pair[2].snr_db, pair[3].snr_db) / 10) for pair in half))
                    for half in (found[:len(found) // 2], found[len(found) // 2:])]
    per_noise = max((weak[0] - strong[0]) / (weak[1] - strong[1]), 1e-6)
    floor_rad = math.sqrt(max(strong[0] - per_noise * strong[1], 1e-8))
    return {"range_sigma_m": spread([pair[0] for pair in found]) / math.sqrt(2), "range_rate_sigma_mps": spread(rates),
            "azimuth_floor_rad": floor_rad, "azimuth_sigma_rad": floor_rad}, math.sqrt(per_noise)


def fit(recording):
    """What the scans of a recording say, for its annotation and its radar."""
    detections, radar = [one for scan in recording.scans for one in scan.detections], recording.radar
    told = [one.snr_db for one in detections if one.snr_db is not None]
    threshold_db = quantile(told, LEAST) if told else 14.0
    law = curve(detections, threshold_db)
    scans = completed(recording.scans, law)
    scatter, azimuth_noise = noise(radar, scans)
    found = {"mount_x_m": radar.x_m, "mount_y_m": radar.y_m, "mount_yaw_rad": radar.yaw_rad, "carrier_hz": radar.carrier_hz,
             "range_min_m": min(one.range_m for one in detections), "range_max_m": max(one.range_m for one in detections),
             "field_of_view_rad": 2.02 * max(abs(one.azimuth_rad) for one in detections), "threshold_db": threshold_db,
             "calibration_ercs": 1.0, "calibration_range_m": 10 ** ((law.at_1_m + 10 - threshold_db) / law.per_decade),
             "exponent": law.per_decade / 20, "antenna_table": "antenna.csv", **cells(scans), **scatter}
    with open(os.path.join(ROOT, "data", "sensors", "lrr77-full.json"), encoding="utf-8") as file:
        shipped = json.load(file)["sensors"][0]
    assumed = {"cell_phase": "by_path", "cell_extent": "half_width", "pointer_sigma": 1}
    sources = {**{name: shipped["sources"][name] for name in SHIPPED},
               **{name: "[A] amplitudes are ratios to the noise, and cells least distances" for name in assumed},
               **{name: "[F] the recording, its first half" for name in found}}
    return Fit(annotation(recording), law, azimuth_noise,
               {"name": "radar", **{name: shipped[name] for name in SHIPPED}, **assumed, **found, "sources": sources})


def write_suite(of, folder, **changed):
    """The suite and its antenna, with some members changed, in a folder; its path."""
    with open(os.path.join(folder, "antenna.csv"), "w", encoding="ascii") as out:
        out.write("azimuth_rad,sum,delta\n")
        for i in range(-120, 121):
            azimuth = 0.55 * of.sensor["field_of_view_rad"] * i / 120
            lit = 10 ** ((of.curve.snr_db(1, azimuth) - of.curve.at_1_m) / 20)
            ratio = math.sinh(azimuth / (math.sqrt(2) * of.azimuth_noise))  # as noisy in every direction
            out.write(f"{azimuth:.9g},{lit:.9g},{lit * ratio:.9g}\n")
    place = os.path.join(folder, "-".join(["recorded", *map(str, changed.values())]) + ".json")
    with open(place, "w", encoding="utf-8") as out:
        json.dump({"origin": "Written by scripts/realism --recordings.", "sensors": [{**of.sensor, **changed}]}, out, indent=2)
    return place
