"""Lists of imaging radars, which have elevations: what is found in them otherwise than in coarse ones, and their peaks.

All figures come from the detections of road users, as such radars have other modes for other ranges: near detections are of fine
cells, and those beyond NEAR_M of fine or of coarse ones, from scan to scan.
"""
import math
import statistics

from glint.recordings import geometry
from glint.recordings.score import Scale

NEAR_M, COARSER = 25, 8  # coarse cells may begin here; one is as long as this many fine ones
ALIKE_M, ALIKE_MPS = 0.3, 0.1  # detections of one range, and of one range rate
LEAST, FEWEST_PAIRS = 1e-3, 8  # a shorter distance is none; this many pairs at least give a step
PEAK_MPS = 0.3  # the least distance in range rate of peaks of one range
FAR = 5  # scans away, from where the recording itself predicts a list
SKILLS = {"FULL": False, "PEAKS": True}  # of peaks alone?
LISTS = 12  # of a score; fewer than elsewhere, as each has many detections
INTERVAL_S = 0.1  # of scans in any order
COARSE = "coarse"  # name of the sensor with coarse cells
LEVEL = "[A] chosen on a dense recording, where scatterers of a car lie in fine cells of their own"
ASSUMED = {"cell_extent": ("width", "[A] a step of the grid of a list"), "level_constant_db": (2.2, LEVEL),
           "level_slow_db": (1.2, LEVEL), "level_fast_db": (1.8, LEVEL)}


def of_road_users(radar, scans):
    """The detections inside each box, [scan][box]."""
    return [[geometry.gated(radar, box, scan.detections, geometry.BARE) for box in scan.boxes] for scan in scans]


def figures(radar, scans, threshold_db):
    """Sentences on the detections inside the boxes that are in view; a near box counts with three or more."""
    looks = [[geometry.look(radar, box) for box in scan.boxes] for scan in scans]
    seen = [(look.range_m < NEAR_M, own) for lists, of in zip(of_road_users(radar, scans), looks)
            for look, own in zip(of, lists) if abs(look.azimuth_rad) < math.pi / 2]
    near, far = ([own for is_near, own in seen if is_near == wanted] for wanted in (True, False))
    several = [own for own in near if len(own) > 2]
    if not several or not far:
        return f"no road users both nearer and farther than {NEAR_M} m"
    levels = [[one.snr_db for one in own] for own in several]
    ranges = [len({round(one.range_m, 2) for one in own}) for own in several]
    azimuths = [len({round(math.degrees(one.azimuth_rad)) for one in own}) for own in several]
    spreads = [math.degrees(statistics.pstdev(one.elevation_rad for one in own)) for own in several]
    return f"""{statistics.fmean(map(len, near)):.1f} detections nearer than {NEAR_M} m, {statistics.fmean(map(len, far)):.1f} farther
           near: {statistics.fmean(ranges):.1f} ranges and {statistics.fmean(azimuths):.1f} whole degrees; levels lie within \
{statistics.fmean(max(own) - min(own) for own in levels):.1f} dB, elevations spread by {statistics.fmean(spreads):.1f} degrees
           the strongest fall by {slope(radar, scans, threshold_db):.1f} dB a decade of range"""


def step(values):
    """The step of the grid that distances lie on: the middle of those that are about as small as a few of the least; values in order."""
    return statistics.median(one for one in values if one < 1.5 * values[len(values) // 50])


def cells(seen):
    """Steps in range of detections of one range rate, and in range rate of those of one range; seen: [scan][box]."""
    pairs = [(abs(one.range_m - other.range_m), abs(one.range_rate_mps - other.range_rate_mps))
             for scan in seen for own in scan for i, one in enumerate(own) for other in own[:i]]
    found = {"cell_range_m": sorted(off_m for off_m, off_mps in pairs if off_mps < ALIKE_MPS and off_m > LEAST),
             "cell_range_rate_mps": sorted(off_mps for off_m, off_mps in pairs if off_m < ALIKE_M and off_mps > LEAST)}
    return {name: step(own) for name, own in found.items() if len(own) >= FEWEST_PAIRS}


def scale(sensor):
    """Units of scores: four cells of range, two of range rate, one degree and 3 dB."""
    return Scale(4 * sensor["cell_range_m"], 2 * sensor["cell_range_rate_mps"], math.radians(1), 3, LISTS)


def slope(radar, scans, threshold_db):
    """By how many dB a decade of range road users ahead become weaker, by their strongest detection, or the threshold without one."""
    levels = [(look.range_m, max((one.snr_db for one in own), default=threshold_db)) for scan, seen in zip(scans, of_road_users(radar, scans))
              for box, own in zip(scan.boxes, seen) if abs((look := geometry.look(radar, box)).azimuth_rad) < math.pi / 2]
    return -statistics.linear_regression([math.log10(range_m) for range_m, _ in levels], [level for _, level in levels]).slope


def strongest(seen):
    """Pairs of a key and the strongest level of its detections, of pairs of a key and detections, where there are any."""
    return [(key, max(one.snr_db for one in own)) for key, own in seen if own]


def coarse_scans(radar, scans, cell_m):
    """Numbers of the scans in which three of four neighbouring ranges of far road users are more than a few fine cells apart."""
    found = []
    for i, (scan, seen) in enumerate(zip(scans, of_road_users(radar, scans))):
        steps = []
        for box, own in zip(scan.boxes, seen):
            ranges = sorted(one.range_m for one in own if geometry.look(radar, box).range_m >= NEAR_M)
            steps += [after - before for before, after in zip(ranges, ranges[1:]) if after - before > cell_m / 2]
        if not steps or sorted(steps)[len(steps) // 4] > math.sqrt(COARSER) * cell_m:
            found.append(i)
    return frozenset(found)


def is_of_mode(target, is_coarse):
    """Is a target of the sensor whose cells the scan has at the target's range?"""
    return (target["sensor"] == COARSE) == (is_coarse and target["range_m"] >= NEAR_M)


def peaks(detections, apart_m):
    """The strongest detections, none of which is nearer than so much in range and PEAK_MPS to a stronger one, at any azimuth."""
    kept = []
    for one in sorted(detections, key=lambda one: -one.snr_db):
        if all(abs(one.range_m - other.range_m) >= apart_m or abs(one.range_rate_mps - other.range_rate_mps) >= PEAK_MPS for other in kept):
            kept.append(one)
    return kept
