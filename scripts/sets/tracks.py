"""Tells whether two recordings have the same traffic: by how bodies move, whatever names, files and origins they have."""
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
