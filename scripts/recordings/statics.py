"""Detections of what stands: the ego's speed, the way between two scans, and what is seen again."""
import math
import statistics

AGREE_MPS = 0.3  # width of the window of speeds that agree
AZIMUTH_SIGMA_RAD = 0.006  # assumed for errors of the rate that belongs to an azimuth
GATE_M, GATE_RAD = 0.4, math.radians(1)  # seen again within


def ego_speed(radar, scan):
    """Speed at which most detections stand still; None where fewer than five agree."""
    speeds = sorted(-one.range_rate_mps / math.cos(one.azimuth_rad + radar.yaw_rad) for one in scan.detections)
    same = max(([one for one in speeds[i:] if one - begin <= AGREE_MPS] for i, begin in enumerate(speeds)),
               key=len, default=[])
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
    found, places = [], [(math.hypot(x, y), math.atan2(y, x), one) for x, y, one in after]
    for x, y, one in before:
        range_m, angle = math.hypot(x - driven_m, y), math.atan2(y, x - driven_m)
        near = [(there_m - range_m, azimuth - angle, one, other) for there_m, azimuth, other in places
                if abs(azimuth - angle) <= 2 * GATE_RAD and abs(there_m - range_m) <= 2 * GATE_M]
        if near:
            found.append(min(near, key=lambda pair: abs(pair[0])))
    return found


def driven_m(before, after, expected_m):
    """The way between two scans that brings most statics together, at 0.6 to 1.8 times the expected one: lists are
    often sampled at another rate than the radar's."""
    steps = [expected_m * (0.6 + 0.01 * i) for i in range(121)]
    best = max(steps, key=lambda way: sum(math.exp(-0.5 * (off / 0.2) ** 2) for off, *_ in pairs(before, after, way)))
    return best - statistics.median([off for off, *_ in pairs(before, after, best)] or [0])
