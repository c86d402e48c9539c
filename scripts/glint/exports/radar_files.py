"""Radar files of nuScenes and of MAN TruckScenes: points in PCD."""
import math
import struct
from bisect import bisect_right

import glint

NO_POINT = *(math.nan,) * 3, 0, 0, *(math.nan,) * 5, *(0,) * 8  # a scan of nuScenes without targets
MOVING_MPS = 0.5  # what is slower stands
KINDS = {"f": (4, "F"), "h": (2, "I"), "b": (1, "I")}  # size and type of PCD
# Limits between codes: of the probability of a false alarm, 1 to 7, and of the ARS408's deviations in m or m/s, 0 to 31.
PDH0 = 0.25, 0.5, 0.75, 0.9, 0.99, 0.999
DEVIATIONS = [0.005 * 2000 ** (i / 30) for i in range(31)]


def direction(target):
    """Ahead, left and up; up is 0 where the radar measures no elevation."""
    if "elevation_rad" in target:
        return glint.sight(target)
    angle = target["azimuth_rad"]
    return math.cos(angle), math.sin(angle), 0.0


def deviation_codes(along_sd, across_sd, c, s):
    """Codes of the deviations in x and y of what has these along and across a line of sight."""
    return (bisect_right(DEVIATIONS, math.hypot(c * along_sd, s * across_sd)),
            bisect_right(DEVIATIONS, math.hypot(s * along_sd, c * across_sd)))


def motion_code(ground_mps):
    """dyn_prop: 1 stands, 0 goes away, 2 comes."""
    if abs(ground_mps) < MOVING_MPS:
        return 1
    return 0 if ground_mps > 0 else 2


def values_of_nuscenes(targets):
    """The fields of each point, one after another. Its velocities are rates along the line of sight, as vectors."""
    values = []
    for i, one in enumerate(targets):
        quality, r, rate = one["quality"], one["range_m"], one["range_rate_mps"]
        (c, s, up), ground, angle_sd = direction(one), quality["range_rate_over_ground_mps"], quality["azimuth_sd_rad"]
        flat_c, flat_s = (math.cos(one["azimuth_rad"]), math.sin(one["azimuth_rad"])) if up else (c, s)
        values += (r * c, r * s, r * up, motion_code(ground), i, quality["rcs_dbsm"], rate * c, rate * s, ground * c, ground * s,
                   1, 1 if quality.get("ambiguity_number") else 3, *deviation_codes(quality["range_sd_m"], r * angle_sd, flat_c, flat_s),
                   0, 1 + bisect_right(PDH0, 1 - quality["existence"]),
                   *deviation_codes(quality["range_rate_sd_mps"], abs(rate) * angle_sd, flat_c, flat_s))
    return values


def values_of_truckscenes(targets):
    values = []
    for one in targets:
        r, rate, (c, s, up) = one["range_m"], one["range_rate_mps"], direction(one)
        values += r * c, r * s, r * up, rate * c, rate * s, rate * up or 0, one["quality"]["rcs_dbsm"]
    return values


class RadarFiles:
    """Files of one layout, whose points have these fields, of kinds as in Python's struct."""

    def __init__(self, kinds, fields):
        self.kinds, self.count = kinds, len(fields)
        self.is_nuscenes = len(fields) == len(NO_POINT)
        self.values_of = values_of_nuscenes if self.is_nuscenes else values_of_truckscenes
        sizes, types = (" ".join(str(KINDS[kind][i]) for kind in kinds[1:]) for i in (0, 1))
        self.head = (f"# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS {' '.join(fields)}\nSIZE {sizes}\nTYPE {types}\n"
                     f"COUNT{' 1' * len(fields)}\nWIDTH {{0}}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {{0}}\nDATA binary\n")

    def file_of(self, targets):
        """The file of a scan, and the places of its points in the sensor's axes."""
        values = self.values_of(targets)
        count, step = len(targets), self.count
        places = [*zip(values[0::step], values[1::step], values[2::step])]
        if self.is_nuscenes and not targets:
            values, count = NO_POINT, 1
        # The reader of nuScenes asks for a byte behind the data.
        return self.head.format(count).encode() + struct.pack("<" + self.kinds[1:] * count, *values) + b"\n" * self.is_nuscenes, places
