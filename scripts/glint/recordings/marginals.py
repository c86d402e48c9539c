"""Marginals: single numbers of a recording's scans, and of a chain's lists with the same boxes."""
import statistics

from glint.recordings import geometry, statics

EDGES_M = (0, 20, 40, 80)  # of the ranges for which detections are counted
STRONG_DB = 6  # over the threshold: a static that should be seen again


def values(part, lists, threshold_db):
    """{name: number} of lists, one a scan; what too few detections show has no number."""
    seen = part.of(lists)
    strongest = {key: max(one.rcs_dbsm for one in own) for key, own in seen.items() if own}
    depths = [one.range_m - geometry.nearest_m(part.radar, part.boxes[key]) for key, own in seen.items() for one in own]
    found = counts(part, seen)
    if len(depths) > 1:
        found["depth behind the near face, m: median"] = statistics.median(depths)
        found["depth behind the near face, m: 90 %"] = statistics.quantiles(depths, n=10)[-1]
        found["strongest cross section, dBsm: mean"] = statistics.fmean(strongest.values())
    found |= memory(strongest, len(lists))
    followed = [(name, scan + 1) in strongest for name, scan in strongest if (name, scan + 1) in seen]
    if followed:
        found["seen again given seen, %"] = 100 * statistics.fmean(followed)
    return found | recurrence(part, lists, threshold_db + STRONG_DB)


def counts(part, seen):
    """Shares of scans in which a body of a class and range has no, one, two, three or more detections."""
    groups = {}
    for key, own in seen.items():
        range_m = geometry.look(part.radar, part.boxes[key]).range_m
        name = f"{part.boxes[key].kind} beyond {max(edge for edge in EDGES_M if edge <= range_m)} m"
        groups.setdefault(name, []).append(min(len(own), 3))
    return {f"{name}, %: {word}": 100 * own.count(count) / len(own) for name, own in sorted(groups.items())
            for count, word in enumerate(("none", "one", "two", "three and more"))}


def memory(levels, scans):
    """Changes of the level of a body's strongest detection, {(id, scan): dBsm}, and semivariances."""
    found = {}
    for lag in sorted({1, 3, 10, scans // 6, scans // 3} - {0}):
        changes = [level - levels[of, scan + lag] for (of, scan), level in levels.items() if (of, scan + lag) in levels]
        if len(changes) > 1 and lag in (1, 10):
            found[f"level change over {lag} scans, dB"] = statistics.fmean(map(abs, changes))
        if len(changes) > 1 and lag <= scans // 3:
            found[f"semivariance over {lag} scans, dB2"] = statistics.fmean(one * one for one in changes) / 2
    return found


def recurrence(part, lists, strong_db):
    """Statics a scan, and how many of the strong ones are in the next scan and, by chance, in one half of all scans
    away."""
    still = [statics.standing(part.radar, own, speed) for own, speed in zip(lists, part.speeds)]
    found, n = {"statics a scan": statistics.fmean(map(len, still))}, len(lists)
    for name, away in (("statics that recur, %", 1), ("statics that recur by chance, %", n // 2)):
        strong = again = 0
        for i in range(n - 1):
            own = [one for one in still[i] if one[2].snr_db >= strong_db]
            way_m = part.speeds[i] * (part.scans[i + 1].time_s - part.scans[i].time_s)
            again += sum(abs(off_m) <= statics.GATE_M and abs(off_rad) <= statics.GATE_RAD
                         for off_m, off_rad, *_ in statics.pairs(own, still[(i + away) % n], way_m))
            strong += len(own)
        if strong > 4:
            found[name] = 100 * again / strong
    return found


def outside(value, others):
    """Is a number less than all others or more? Of 39 others of its law, 1 time in 20 at most. Of no others it is."""
    return not others or not min(others) <= value <= max(others)
