"""Strips beside the road, as dense and as strong as what stands in a recording."""
import statistics

from glint.recordings import chains, statics

WIDTH_M, FARTHEST_M = 4, 40  # of strips along the ego's way, to the right and left of it
ROUNDS, SEEDS, MOST_PER_M2 = 5, 3, 1  # more scatterers than one a square metre share cells
BEGIN = {"kind": "other", "width_m": WIDTH_M, "per_m2": 0.03, "rcs_dbsm": -8, "spread_db": 9, "level_db": 2}  # MODEL 14.23


def levels(part, lists):
    """{number of a strip: cross sections of what stands in it} in lists, one a scan; from right to left."""
    found = {}
    for own, speed in zip(lists, part.speeds):
        for _, y, one in statics.standing(part.radar, own, speed):
            found.setdefault(round((y + part.radar.y_m) / WIDTH_M), []).append(one.rcs_dbsm)
    return found


def at_cap(strip):
    """Would the lists take more scatterers than a strip may have?"""
    return strip["per_m2"] >= MOST_PER_M2


def strips(chain, suite, fit, part):
    """Strips with which lists of a chain have as many statics, and as strong ones, as the recording. A strip where less
    than one is seen in two scans is left out."""
    seen = {at: own for at, own in levels(part, [scan.detections for scan in part.scans]).items()
            if 2 * len(own) >= len(part.scans) and WIDTH_M * abs(at) <= FARTHEST_M}
    behind_m = min((x for scan, speed in zip(part.scans, part.speeds) for x, _, _ in statics.standing(part.radar, scan.detections, speed)), default=0)
    end_m = 400 + max(part.speeds) * (part.scans[-1].time_s - part.scans[0].time_s)
    found = {at: BEGIN | {"from_x_m": min(behind_m, 0) - 50, "from_y_m": WIDTH_M * at, "to_x_m": end_m, "to_y_m": WIDTH_M * at}
             for at in sorted(seen)}
    for _ in range(ROUNDS):
        lists, _ = chains.run(chain, suite, fit._replace(roadside=list(found.values())), part, SEEDS)
        made = [levels(part, one) for one in lists]
        for at, strip in found.items():
            own = [level for one in made for level in one.get(at, [])]
            strip["per_m2"] = min(strip["per_m2"] * min(SEEDS * len(seen[at]) / max(len(own), 1), 5), MOST_PER_M2)
            strip["rcs_dbsm"] += statistics.fmean(seen[at]) - statistics.fmean(own or seen[at])
    return list(found.values())
