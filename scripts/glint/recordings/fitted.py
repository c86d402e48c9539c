"""What the first half of a recording says of its annotation and of its radar; the latter as a suite with sources."""
import bisect
import itertools
import json
import math
import os
import statistics
from collections import namedtuple

from glint.places import DATA
from glint.recordings import dense, geometry, statics
from glint.recordings.readers import STANDING, is_dense, json_of
from glint.recordings.score import COARSE

# A list is lag_s older than its boxes, and near faces lie inset_m inside them.
Annotation = namedtuple("Annotation", "lag_s inset_m")
# azimuth_noise: standard deviation in rad at a signal as strong as the noise; sensor: members of a suite's sensor;
# scale: units of scores; roadside: strips of a scene.
Fit = namedtuple("Fit", "annotation curve azimuth_noise sensor scale roadside", defaults=(COARSE, []))
SLOWEST = 24  # dB a decade, the lesser of two 77 GHz radars on roads: few near detections are as weak as the threshold
LEAST = 0.001  # share of the detections that may be weaker than the threshold
STEEPEST = 8  # extent of the view in noise of azimuth: delta is at most 140 times sum
FEWEST_PAIRS = 8  # of neighbours that tell a cell
AGREE, NARROWED = 0.8, 6  # detections that agree lie at most this part of a cell apart; how often the bounds are narrowed
WIDEST_MPS = 1  # a cell of rates; usual are 0.03 to 0.4
WITHIN_2 = 0.7737  # variance of normal numbers within two standard deviations
# Members that lists do not show, and figures for which a half may have too few detections: those of lrr77-full.
SHIPPED = ("range_min_m range_floor_m diffraction curved_sides micro_motion bounces antenna_pattern phase_reference "
           "angle_estimator final_threshold list_order list_limit azimuth_sigma_rad range_sigma_m range_rate_sigma_mps").split()
NOISES = "range_sigma_m", "range_rate_sigma_mps", "azimuth_sigma_rad"
CELLS, FOUND = ("cell_range_m", "cell_range_rate_mps"), "[F] the recording, its first half"
LEVEL = "[A] the middle between two 77 GHz radars on roads (MODEL 14.22)"
ASSUMED = {"cell_phase": ("by_path", "[A] as lrr77-coherent"), "cell_extent": ("half_width", "[A] a least distance"),
           "pointer_sigma": (1, "[A] amplitudes are ratios to the noise"), "level_constant_db": (4.5, LEVEL), "level_slow_db": (2.5, LEVEL), "level_fast_db": (2.9, LEVEL)}


class Curve(namedtuple("Curve", "over_range over_azimuth")):
    """Signal-to-noise ratio in dB of 0 dBsm on boresight, rows (range in m, dB), straight over lg R between them; and what
    is lost aside, rows (azimuth in rad, dB)."""

    def raised(self, by_db):
        return self._replace(over_range=[(range_m, level + by_db) for range_m, level in self.over_range])

    def snr_db(self, range_m, azimuth_rad):
        rows = [(math.log10(row_m), level) for row_m, level in self.over_range]
        return sum(part * level for x, of in ((math.log10(range_m), rows), (azimuth_rad, self.over_azimuth))
                   for part, (_, level) in zip(parts(x, [knot for knot, _ in of]), of))


def parts(x, knots):
    """How much each knot weighs at x, if values are straight between knots and constant beyond them."""
    x, i = min(max(x, knots[0]), knots[-1]), min(max(bisect.bisect(knots, x), 1), len(knots) - 1)
    way = (x - knots[i - 1]) / (knots[i] - knots[i - 1])
    return [1 - way if k == i - 1 else way if k == i else 0 for k in range(len(knots))]


def quantile(values, share):
    return sorted(values)[min(int(share * len(values)), len(values) - 1)]


def spread(values):
    """Standard deviation by the values within two of it, so that wrong pairs and merged targets hardly count."""
    sigma = 1.4826 * statistics.median(map(abs, values))
    for _ in range(12):
        sigma = math.sqrt(statistics.fmean(one * one for one in values if abs(one) <= 2 * sigma) / WITHIN_2)
    return sigma


def least_squares(rows, values):
    """The coefficients of the columns of rows, by the normal equations; 0 where a column is."""
    n = len(rows[0])
    system = [[sum(row[i] * row[j] for row in rows) + (1e-9 if i == j else 0) for j in range(n)]
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


def curve(detections, threshold_db, fall_db=40):
    """By least squares where lists have both figures. With cross sections alone, the weakest tenth of each sixth of the
    ranges meets the threshold, or is above it where levels would fall by less than SLOWEST. Without cross sections
    levels fall by so many dB a decade."""
    ordered, aside = sorted(detections), 1.01 * max(0.01, *(abs(one.azimuth_rad) for one in detections))
    azimuths = [aside * i / 4 for i in range(-4, 5)]
    flat = [(azimuth, 0) for azimuth in azimuths]
    if any(one.rcs_dbsm is None for one in detections):
        return Curve([(1, threshold_db + fall_db * math.log10(ordered[-1].range_m)), (ordered[-1].range_m, threshold_db)], flat)
    if any(one.snr_db is None for one in detections):
        sixths = [ordered[len(ordered) * i // 6:len(ordered) * (i + 1) // 6] for i in range(6)]
        rows = [(one[len(one) // 2].range_m, threshold_db - quantile([one.rcs_dbsm for one in one], 0.1)) for one in sixths]
        return Curve([(near_m, max(level + SLOWEST * math.log10(far_m / near_m) for far_m, level in rows[i:]))
                      for i, (near_m, _) in enumerate(rows)], flat)
    logs = [math.log10(ordered[(len(ordered) - 1) * i // 3].range_m) + 1e-3 * i for i in range(4)]
    rows = [parts(math.log10(one.range_m), logs) + parts(one.azimuth_rad, azimuths) for one in ordered]
    rows = [row[:8] + row[9:] for row in rows]  # nothing is lost on boresight
    levels = least_squares(rows, [one.snr_db - one.rcs_dbsm for one in ordered])
    return Curve([(10 ** log, level) for log, level in zip(logs, levels)],
                 list(zip(azimuths, levels[4:8] + [0] + levels[8:])))


def completed(scans, law):
    """The scans with both figures in each detection, each from the other by the curve."""
    def of(one):
        gain = law.snr_db(one.range_m, one.azimuth_rad)
        snr_db = one.rcs_dbsm + gain if one.snr_db is None else one.snr_db
        return one._replace(snr_db=snr_db, rcs_dbsm=snr_db - gain if one.rcs_dbsm is None else one.rcs_dbsm)

    return [scan._replace(detections=[of(one) for one in scan.detections]) for scan in scans]


def edge(values):
    """Where values begin to be dense, of few or many, some of which may lie below by mistake: of all places where a step of their
    density is most likely, by their numbers up to it and up to three times as far."""
    values, best, most = sorted(one for one in values if one > 0), 0, 0
    for i, value in enumerate(values):
        count = bisect.bisect_left(values, 3 * value)
        below = i / count
        gain = count * ((below * math.log(3 * below) if below else 0) + (1 - below) * math.log(1.5 * (1 - below))) if below < 1 / 3 else 0
        best, most = (value, gain) if gain > most else (best, most)
    return values[bisect.bisect_left(values, 0.9 * best)]


def cells(scans):
    """The least distance in range of detections whose rates agree, and in rate of those whose ranges do, where there are enough. What
    agrees lies well within a cell: both bounds are narrowed until that holds. Rates of the two sides of a road may lie farther apart
    than any cell, so that no pair shows it."""
    pairs = [(abs(one.range_m - other.range_m), abs(one.range_rate_mps - other.range_rate_mps))
             for scan in scans[:50] for i, one in enumerate(scan.detections) for other in scan.detections[:i]]
    near_m, near_mps, wide_m, wide_mps, found = 0.3, 0.1, True, True, {}
    for _ in range(NARROWED):
        near = {"cell_range_m": [off_m for off_m, off_mps in pairs if off_mps < near_mps and off_m < 10],
                "cell_range_rate_mps": [off_mps for off_m, off_mps in pairs if off_m < near_m and off_mps < 5]}
        found = {name: max(edge(own), 0.01) for name, own in near.items() if len(own) >= FEWEST_PAIRS}
        wide_m, wide_mps = near_m > AGREE * found.get("cell_range_m", 1), near_mps > AGREE * found.get("cell_range_rate_mps", 1)
        if not wide_m and not wide_mps:
            break
        near_m, near_mps = near_m / (1 + wide_m), near_mps / (1 + wide_mps)
    unseen = {"cell_range_m": wide_mps, "cell_range_rate_mps": wide_m or found.get("cell_range_rate_mps", 0) > WIDEST_MPS}
    return {name: value for name, value in found.items() if not unseen[name]}


def noise(radar, scans, least_rad):
    """Standard deviations of statics, as members of a sensor, as far as they are found: of range and azimuth from scan to scan, and
    of the range rate ahead and behind, where azimuths hardly enter it. And the azimuth's at a signal as strong as the noise, at
    least least_rad. Scans that do not follow each other at the usual interval make no pairs."""
    found, rates = [], []
    speeds = statics.ego_speeds(radar, scans)
    still = [statics.standing(radar, scan.detections, speed) for scan, speed in zip(scans, speeds)]
    intervals_s = [after.time_s - before.time_s for before, after in zip(scans, scans[1:])]
    for i, interval_s in enumerate(intervals_s, 1):
        if 0 < interval_s < 2 * statistics.median(intervals_s):
            own = statics.pairs(still[i - 1], still[i], speeds[i] * interval_s)
            found += own if len(own) >= 5 else []
        rates += [one.range_rate_mps + speeds[i] * x / one.range_m for x, y, one in still[i] if abs(y) < 0.05 * abs(x)]
    of_rate = {"range_rate_sigma_mps": spread(rates)} if len(rates) >= 20 else {}
    if len(found) < 40:
        return of_rate, max(least_rad, 0.05)
    floor, per_noise = azimuth_variances(found, least_rad ** 2)
    return of_rate | {"range_sigma_m": spread([pair[0] for pair in found]) / math.sqrt(2),
                      "azimuth_floor_rad": math.sqrt(floor), "azimuth_sigma_rad": math.sqrt(floor)}, math.sqrt(per_noise)


def azimuth_variances(found, least):
    """The variance of azimuths that no signal lessens, and that at a signal as strong as the noise, which is no less than
    the least: weighted least squares of the squares of differences. Beyond two standard deviations there are wrong pairs."""
    squares = [([2, 10 ** (-one.snr_db / 10) + 10 ** (-other.snr_db / 10)], off_rad ** 2) for _, off_rad, one, other in found]
    law = [1e-4, max(1e-2, least)]
    for _ in range(30):
        weighed = [(row, square, sum(map(math.prod, zip(row, law)))) for row, square in squares]
        near = [([one / variance for one in row], square / variance / WITHIN_2) for row, square, variance in weighed
                if square < 4 * variance]
        law[1] = max(least_squares(*zip(*near))[1], least)
        law[0] = max(sum(row[0] * (square - law[1] * row[1]) for row, square in near) / sum(row[0] ** 2 for row, _ in near), 1e-6)
    return law


def is_found(of, member):
    """Is a member of the sensor that of the recording?"""
    return of.sensor.get("sources", {}).get(member, FOUND) == FOUND


def least_noise_rad(law):
    """The least noise of azimuth, at a signal as strong as the noise, that an antenna's table can have in so wide a view."""
    return law.over_azimuth[-1][0] / STEEPEST


def fit(recording, level_keeps="median"):
    """What the scans of a recording say, for its annotation and its radar; level_keeps is chosen elsewhere."""
    detections, radar = [one for scan in recording.scans for one in scan.detections], recording.radar
    is_fine, seen = is_dense(recording.scans), dense.of_road_users(radar, recording.scans)
    told = [one.snr_db for one in (itertools.chain(*itertools.chain(*seen)) if is_fine else detections) if one.snr_db is not None]
    threshold_db = quantile(told, LEAST) if told else 14.0
    law = curve(detections, threshold_db, dense.slope(radar, recording.scans, threshold_db) if is_fine else 40)
    scans = completed(recording.scans, law)
    scatter, azimuth_noise = noise(radar, scans, least_noise_rad(law))
    found = {"mount_x_m": radar.x_m, "mount_y_m": radar.y_m, "mount_yaw_rad": radar.yaw_rad, "carrier_hz": radar.carrier_hz,
             "range_max_m": max(one.range_m for one in detections), "threshold_db": threshold_db,
             "field_of_view_rad": 2 * law.over_azimuth[-1][0],
             "range_curve": "range.csv", "azimuth_curve": "azimuth.csv", "antenna_table": "antenna.csv",
             "level_keeps": level_keeps, **(dense.cells(seen) if is_fine else cells(scans)), **scatter}
    shipped = json_of(os.path.join(DATA, "sensors", "lrr77-full.json"))["sensors"][0]
    members = {name: (shipped[name], shipped["sources"][name]) for name in SHIPPED} | {
        name: (shipped[name] / 2, f"[A] not found in the recording; as lrr77-full, {shipped[name]} wide") for name in CELLS} | ASSUMED | (
        dense.ASSUMED if is_fine else {}) | {
        name: (value, FOUND) for name, value in found.items()}
    sensor = {name: value for name, (value, _) in members.items()}
    return Fit(Annotation(0, 0) if is_fine else annotation(recording), law, azimuth_noise,
               {"name": "radar", **sensor, "sources": {name: source for name, (_, source) in members.items()}},
               dense.scale(sensor) if is_fine else COARSE)


def write_suite(of, folder, **changed):
    """The suite and its antenna, with some members changed, in a folder; its path."""
    aside = of.curve.over_azimuth[-1][0]
    steep = math.sqrt(2) * of.azimuth_noise  # the ratio of delta to sum makes azimuths as noisy in every direction
    ratios = [(aside * i / 50, 1, math.sinh(aside * i / 50 / steep)) for i in range(-50, 51)]
    for name, head, rows in (("range", "range_m,level_db", of.curve.over_range),
                             ("azimuth", "azimuth_rad,level_db", of.curve.over_azimuth),
                             ("antenna", "azimuth_rad,sum,delta", ratios)):
        with open(os.path.join(folder, name + ".csv"), "w", encoding="ascii") as out:
            out.write("\n".join([head] + [",".join(map(repr, map(float, row))) for row in rows]) + "\n")
    sensors = [of.sensor | changed]
    if of.scale is not COARSE:  # a twin with coarse cells
        sensors.append(sensors[0] | {"name": dense.COARSE, "cell_range_m": dense.COARSER * sensors[0]["cell_range_m"]})
    place = os.path.join(folder, "-".join(["recorded", *map(str, changed.values())]) + ".json")
    with open(place, "w", encoding="utf-8") as out:
        json.dump({"origin": "Made by scripts/realism --recordings.", "sensors": sensors}, out, indent=2)
    return place
