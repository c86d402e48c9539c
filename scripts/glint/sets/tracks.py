"""Tells whether two recordings or two scenes have the same traffic: by how bodies move, whatever names, files and origins they have."""
import collections
import itertools
import math

STEPS, MOST = 25, 100  # steps of a piece of motion; most bodies kept for one piece: a long column of vehicles moves alike
STEP_M, SHIFT_M, SHIFT_S = 1e-2, 1, 0.1  # how closely steps agree, and the shifts of all bodies of a copy
MOVED_M = 1  # a body at this distance from its first place has moved
SHARE, FEWEST = 1 / 20, 2  # of the bodies of the smaller recording that are in both if they are copies


def whole(value, unit):
    """The value in whole units. 0.37 keeps values with few decimals off the borders, so that a shifted origin gives the same."""
    return math.floor(value / unit + 0.37)


# Times of a body in a recording, its first place, and whether it moved from there.
Stay = collections.namedtuple("Stay", "begin_s end_s place moved")


def place_in(frame):
    """The place of the ego of a frame."""
    body = next(one for one in frame["objects"] if one["id"] == frame["ego"])
    return frame.get("origin_x_m", 0) + body["x_m"], frame.get("origin_y_m", 0) + body["y_m"]


def noted(frames, stays):
    """Passes on the frames, in which each body is an ego, and notes the stay of each."""
    for frame in frames:
        place = place_in(frame)
        begin_s, _, first, moved = stays.get(frame["ego"], (frame["time_s"], None, place, False))
        stays[frame["ego"]] = Stay(begin_s, frame["time_s"], first, moved or math.dist(place, first) > MOVED_M)
        yield frame


def pieces_of(frames):
    """Of frames of each body as an ego: its time and place at pieces of its motion, the first, the last, and one in eight
    of the others."""
    pieces, ways, places, known = collections.defaultdict(dict), {}, {}, set()
    for frame in frames:
        name, place = frame["scene"], place_in(frame)
        dx, dy = (whole(here - there, STEP_M) for here, there in zip(place, places.get(name, place)))
        places[name] = place
        way = ways.setdefault(name, collections.deque(maxlen=STEPS))
        way.append(dx << 32 ^ dy)
        piece = hash(tuple(way))
        known_by = frame.get("last") or len(way) == STEPS and (name not in known or piece % 8 == 0)
        if known_by and any(way) and len(pieces[piece]) < MOST:
            known.add(name)
            pieces[piece].setdefault(name, (frame["time_s"], *place))
    return pieces


def bodies_in(pieces):
    return len(set().union(*pieces.values()))


def same_traffic(one, other):
    """Are enough bodies of the smaller recording in both, all of them shifted alike in time and place?"""
    shifted = collections.defaultdict(set)
    for piece in one.keys() & other.keys():
        for here, (name, there) in itertools.product(one[piece].values(), other[piece].items()):
            shift = (whole(b - a, unit) for a, b, unit in zip(here, there, (SHIFT_S, SHIFT_M, SHIFT_M)))
            shifted[tuple(shift)].add(name)
    bodies = min(bodies_in(one), bodies_in(other))
    return max(map(len, shifted.values()), default=0) >= max(min(FEWEST, bodies), SHARE * bodies, 1)


def ways_of(frames):
    """The places of each body of a scene, by time in microseconds."""
    ways = {}
    for frame in frames:
        x, y = frame.get("origin_x_m", 0), frame.get("origin_y_m", 0)
        for body in frame["objects"]:
            ways.setdefault(body["id"], {})[round(1e6 * frame["time_s"])] = (x + body["x_m"], y + body["y_m"])
    return ways


def shift_of(one, other):
    """From the place of one body to that of another, if it is the same, to the centimetre, at each time that both have, and these
    reach over half of the time of one of them; else None."""
    common = sorted(one.keys() & other)
    shifts = ([there - here for here, there in zip(one[time_us], other[time_us])] for time_us in common)
    first = next(shifts, None)
    if any(math.dist(shift, first) > STEP_M for shift in shifts):
        return None
    lasts = min(max(way) - min(way) for way in (one, other))
    return first if first and 2 * (common[-1] - common[0]) >= lasts else None


def same_scene(one, other):
    """Are more than half of the bodies of the smaller scene, and more than half of those that move, in the other one, all of them
    shifted alike?"""
    fewer, more = sorted((one, other), key=len)
    moving = {name for name, way in fewer.items() if math.dist(*(way[at(way)] for at in (min, max))) > MOVED_M}
    shifted = collections.defaultdict(set)
    for (name, way), its in itertools.product(fewer.items(), more.values()):
        if shift := shift_of(way, its):
            shifted[tuple(whole(along, SHIFT_M) for along in shift)].add(name)
    return any(2 * len(names) > len(fewer) and 2 * len(names & moving) >= len(moving) + bool(moving) for names in shifted.values())
