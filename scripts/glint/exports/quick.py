"""Tells of most frames in few steps that they have all that formats need."""
import itertools
import math
from operator import itemgetter

import glint

# Members at the head of a frame; the others are taken out of all records of a kind at once.
HEAD = {name: glint.FRAME[name] for name in ("version", "scene", "seed", "frame", "time_s", "ego", "origin_x_m", "origin_y_m")}
ABSENT = {"version", "origin_x_m", "origin_y_m"}  # tables have no version
IDS, CLASSES, PLACES = itemgetter("id"), itemgetter("class"), itemgetter("x_m", "y_m")
MOTIONS, SIZES = itemgetter("yaw_rad", "vx_mps", "vy_mps", "yaw_rate_radps"), itemgetter("length_m", "width_m", "height_m")
NAMES, MOUNTS, VIEWS = itemgetter("name"), itemgetter("mount_x_m", "mount_y_m", "mount_yaw_rad"), itemgetter("field_of_view_rad")
REACHES = itemgetter("range_max_m")
SENSORS, RANGES, AZIMUTHS, RATES = map(itemgetter, ("sensor", "range_m", "azimuth_rad", "range_rate_mps"))
AMPLITUDES, QUALITIES, EXISTENCES, PARTS = map(itemgetter, ("amplitude_db", "quality", "existence", "contributors"))
WEIGHTS, LABELS, SEEN = itemgetter("weight"), itemgetter("object", "reflector", "path"), itemgetter("sensor", "object")
NUMBERS = {int, float}


def flat(of, records):
    return itertools.chain.from_iterable(map(of, records))


def within(low, high, *columns, kinds=NUMBERS):
    """Whether all are finite numbers in these bounds."""
    values = [*itertools.chain(*columns)]
    return not values or {*map(type, values)} <= kinds and math.isfinite(sum(values)) and low <= min(values) and max(values) <= high


def names(*columns):
    values = {*itertools.chain(*columns)}
    return {*map(type, values)} <= {str} and "" not in values


def joined(frame, bodies, sensors, targets, lists):
    """Whether names are those of one thing each, and all that refers to them does to one that is there."""
    ids, known = {*map(IDS, bodies)}, {*map(NAMES, sensors)}
    return (len(ids) == len(bodies) and len(known) == len(sensors) and frame["ego"] in ids and {*map(SENSORS, targets)} <= known
            and {*map(type, lists)} <= {list} and all(lists))


def is_whole(frame, needed):
    """True if a frame has all members that formats need, among them these numbers of quality. False if that takes a closer look:
    bounds are narrower here than in glint.FRAME."""
    try:
        bodies, sensors, targets, sightings = frame["objects"], frame["sensors"]["list"], frame["targets"], frame.get("visibility", [])
        qualities, lists = [*map(QUALITIES, targets)], [*map(PARTS, targets)]
        parts = [*itertools.chain.from_iterable(lists)]
        return ({*map(type, (bodies, sensors, targets, sightings))} == {list} and glint.fault(frame, HEAD, ABSENT) is None
                and joined(frame, bodies, sensors, targets, lists)
                and names(map(IDS, bodies), map(CLASSES, bodies), map(NAMES, sensors), [frame["sensors"]["suite"]], flat(LABELS, parts))
                and names(flat(SEEN, sightings), [one.get("visibility", "unknown") for one in sightings])
                and within(-1e3, 1e3, flat(MOTIONS, bodies), flat(MOUNTS, sensors), map(RATES, targets), map(AMPLITUDES, targets))
                and within(-1e7, 1e7, flat(PLACES, bodies)) and within(1e-3, 1e6, flat(SIZES, bodies), map(REACHES, sensors)) and within(1e-3, math.tau, map(VIEWS, sensors))
                and within(0, 100, [one.get("mount_z_m", 0) for one in sensors], [one.get("age_s", 0) for one in sensors])
                and within(0, 1e7, map(RANGES, targets)) and within(-math.pi, math.pi, map(AZIMUTHS, targets), [one.get("elevation_rad", 0) for one in targets])
                and within(0, 1, map(EXISTENCES, qualities), map(WEIGHTS, parts)) and within(-1e9, 1e9, flat(dict.values, qualities), kinds={*NUMBERS, bool})
                and {*map(type, flat(needed, qualities))} <= NUMBERS)
    except (AttributeError, KeyError, TypeError):
        return False
