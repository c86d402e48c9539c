"""Where a box stands for a radar, and which detections belong to it."""
import math
from collections import namedtuple

Look = namedtuple("Look", "range_m azimuth_rad range_rate_mps")
# The gate around a box: so much longer and wider at each end, wider with range, and off its range rate.
Gate = namedtuple("Gate", "behind_m aside_m aside_rad off_mps")
WIDE, BARE = Gate(2.9, 1.5, math.radians(1), 1.5), Gate(0, 0, 0, 1.5)


def look(radar, box):
    """Range, azimuth and range rate of the middle of a box."""
    x, y = box.x_m - radar.x_m, box.y_m - radar.y_m
    range_m = max(math.hypot(x, y), 1e-3)
    azimuth_rad = math.remainder(math.atan2(y, x) - radar.yaw_rad, 2 * math.pi)
    return Look(range_m, azimuth_rad, (x * box.vx_mps + y * box.vy_mps) / range_m)


def in_box(box, x, y):
    """A place in the axes of a box: metres ahead and to the left of its middle."""
    x, y, c, s = x - box.x_m, y - box.y_m, math.cos(box.yaw_rad), math.sin(box.yaw_rad)
    return c * x + s * y, c * y - s * x


def gated(radar, box, detections, gate=WIDE):
    """The detections of a box: half its size and the gate's margin around it, at about its range rate."""
    seen, kept = look(radar, box), []
    for one in detections:
        if abs(one.range_rate_mps - seen.range_rate_mps) <= gate.off_mps:
            angle = one.azimuth_rad + radar.yaw_rad
            ahead, left = in_box(box, radar.x_m + one.range_m * math.cos(angle), radar.y_m + one.range_m * math.sin(angle))
            if (abs(ahead) <= box.length_m / 2 + gate.behind_m
                    and abs(left) <= box.width_m / 2 + gate.aside_m + gate.aside_rad * seen.range_m):
                kept.append(one)
    return kept


def nearest_m(radar, box):
    """Range of the nearest point of a box."""
    ahead, left = in_box(box, radar.x_m, radar.y_m)
    return math.hypot(max(abs(ahead) - box.length_m / 2, 0), max(abs(left) - box.width_m / 2, 0))


def in_view(sensor, radar, box):
    """Is the middle of a box in the reach of the sensor of a suite?"""
    seen = look(radar, box)
    return (sensor["range_min_m"] < seen.range_m < sensor["range_max_m"]
            and abs(seen.azimuth_rad) < sensor["field_of_view_rad"] / 2)
