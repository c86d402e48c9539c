"""Detections of what stands: the ego's speed, the way between two scans, and what is seen again."""
import bisect
import math
import operator
import statistics

AGREE_MPS = 0.3  # width of the window of speeds that agree
AZIMUTH_SIGMA_RAD = 0.006  # assumed for errors of the rate that belongs to an azimuth
ALONG = 0.3  # cosine from which on a rate tells the speed
GATE_M, GATE_RAD = 0.4, math.radians(1)  # seen again within


def densest(values, width):
    """The values in the window of this width that holds most of them; in the lowest one of several."""
    values, end, most = sorted(values), 0, []
    for begin, least in enumerate(values):
        while end < len(values) and values[end] - least <= width:
            end += 1
        if end - begin > len(most):
            most = values[begin:end]
    return most


def window(rows, value, least, most):
    """The rows whose first figure lies least to most beyond a value; rows are in order of that figure."""
    begin = bisect.bisect_left(rows, least, key=lambda row: row[0] - value)
    return rows[begin:bisect.bisect_right(rows, most, begin, key=lambda row: row[0] - value)]


def ego_speed(radar, scan):
    """Speed at which most detections stand still; None where fewer than five agree."""
    along = [(one.range_rate_mps, math.cos(one.azimuth_rad + radar.yaw_rad)) for one in scan.detections]
    same = densest([-rate_mps / cosine for rate_mps, cosine in along if abs(cosine) > ALONG], AGREE_MPS)
    return statistics.median(same) if len(same) >= 5 else None


def ego_speeds(radar, scans):
    """One speed a scan; a scan with too few statics has the median of all scans, which is 0 if none has enough."""
    found = [ego_speed(radar, scan) for scan in scans]
    middle = statistics.median([one for one in found if one is not None] or [0])
    return [middle if one is None or abs(one - middle) > 5 else one for one in found]


def standing(radar, detections, speed_mps):
    """Detections of what stands: (metres ahead, metres to the left, detection)."""
    kept = []
    for one in detections:
        angle = one.azimuth_rad + radar.yaw_rad
        allowed = AGREE_MPS / 2 + 3 * speed_mps * abs(math.sin(angle)) * AZIMUTH_SIGMA_RAD
        if abs(one.range_rate_mps + speed_mps * math.cos(angle)) <= allowed:
            kept.append((one.range_m * math.cos(angle), one.range_m * math.sin(angle), one))
    return kept


def pairs(before, after, driven_m):
    """Statics with the nearest of a later scan in a double gate: (error of range, of azimuth, both detections)."""
    found, places = [], sorted(((math.hypot(x, y), math.atan2(y, x), one) for x, y, one in after), key=operator.itemgetter(0))
    for x, y, one in before:
        range_m, angle = math.hypot(x - driven_m, y), math.atan2(y, x - driven_m)
        near = [(there_m - range_m, off_rad, one, other) for there_m, azimuth, other in window(places, range_m, -2 * GATE_M, 2 * GATE_M)
                if abs(off_rad := math.remainder(azimuth - angle, math.tau)) <= 2 * GATE_RAD]
        if near:
            found.append(min(near, key=lambda pair: math.hypot(pair[0] / GATE_M, pair[1] / GATE_RAD)))
    return found


def driven_m(before, after, expected_m):
    """The way between two scans on which most statics agree, at 0.6 to 1.8 times the expected one, and how many do."""
    places = sorted(after, key=operator.itemgetter(0))
    ways = [x - u for x, y, one in before for u, v, _ in window(places, x, -1.8 * expected_m, -0.6 * expected_m)
            if abs(y - v) <= 2 * GATE_RAD * one.range_m]
    same = densest(ways, GATE_M)
    return statistics.median(same or [expected_m]), len(same)


def retimed(radar, scans):
    """The scans at the times at which the ego's speed brings most statics together: lists are often sampled at another
    rate than the radar's. Intervals stay as they are where less than eight statics are seen again."""
    speeds = ego_speeds(radar, scans)
    still, times = [standing(radar, scan.detections, speed) for scan, speed in zip(scans, speeds)], [scans[0].time_s]
    for i in range(1, len(scans)):
        interval_s = scans[i].time_s - scans[i - 1].time_s
        way_m, shared = driven_m(still[i - 1], still[i], speeds[i] * interval_s)
        times.append(times[-1] + (way_m / speeds[i] if shared >= 8 and speeds[i] else interval_s))
    return [scan._replace(time_s=time_s) for scan, time_s in zip(scans, times)]
