"""What formats need of a frame, and the refusal of one that lacks it."""
import math

import glint
from glint.sets.plan import BAD_DATA, Fault

# What formats need beyond glint.FRAME, and what gives it.
LENGTH, VALUE = glint.number(1e-3, 1e6), glint.number(-1e9, 1e9)
QUALITY = ("rcs_dbsm", "range_sd_m", "range_rate_sd_mps", "azimuth_sd_rad", "existence", "range_rate_over_ground_mps", "x_centre_m",
           "x_rear_axle_m")
NEEDED = {**dict.fromkeys(("scene", "seed", "frame", "time_s", "ego"), (lambda value: value is not None, "a value")),
          "objects": [{"class": glint.NAME, "length_m": LENGTH, "width_m": LENGTH, "height_m": LENGTH}],
          "sensors": {"suite": glint.NAME, "list": [{"field_of_view_rad": glint.number(1e-3, math.tau), "range_max_m": glint.number(0, 1e6), "mount_z_m": glint.number(0, 100)}]},
          "targets": [{"quality": dict.fromkeys(QUALITY, VALUE), "contributors": [{"path": glint.NAME}]}],
          "visibility": [{"sensor": glint.NAME, "object": glint.NAME, "visibility": glint.NAME}]}
GIVEN_BY = {"quality": "give glint-ideal --sections quality", "objects:": "leave out --sections -objects",
            "targets:": "expected lists, as glint-noise writes them", "_m:": "glint-extract gives objects the sizes of their class"}


def sensor_of(scan, time_s):
    """The sensor of a frame at this time, as lines have it, by its row of the table of scans."""
    return scan | {"name": scan["sensor"], "age_s": round(time_s - scan["measured_s"], 9)}


def checked(frame):
    """The frame, if it has all that formats need."""
    if fault := glint.fault(frame, glint.FRAME) or glint.unjoined(frame):
        raise Fault(BAD_DATA, f"{frame.place}: {fault.lstrip('.: ')}")
    if fault := glint.fault(frame, NEEDED, ("visibility", "mount_z_m")):
        raise Fault(BAD_DATA, "; ".join([f"{frame.place}: {fault[1:]}", *(hint for name, hint in GIVEN_BY.items() if name in fault)]))
    return frame
