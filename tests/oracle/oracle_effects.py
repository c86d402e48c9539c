"""The effects beyond the paper (MODEL 14), computed a second time and independently.

scan(frame, vehicles, document, sensor, effects) gives what one sensor makes of a frame with `objects`: a Scan
with echoes, losses, cells and targets before any draw. All formulas are in plain doubles; decisions within
NEAR of their border are doubtful, as another order of rounding may rightly decide the other way. `effects` is
the set of names that are simulated. What depends on draws (fluctuation, levels, wheels, limbs, clutter, noise, false
alarms, phases) is not here.

Readings taken where MODEL leaves room are marked "Reading:".
"""

import cmath
import math

import oracle

LIGHT_MPS = 299792458.0
NEAR = 1e-9
DARK = 2 * math.sqrt(2)
FOG_CELSIUS = 10.0
ONE_WAY = {"wall_object", "object_wall"}  # paths by a wall in one direction


def near(value, bound, scale=1.0):
    return abs(value - bound) <= NEAR * max(1.0, scale)


def minus(a, b):
    return a[0] - b[0], a[1] - b[1]


def plus(a, b, factor=1.0):
    return a[0] + factor * b[0], a[1] + factor * b[1]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def unit(a):
    size = math.hypot(*a)
    return a[0] / size, a[1] / size


# ---- the world at the instant of the scan (MODEL 2.4, 14.6) ------------------------------------------


def carried(item, seconds):
    """A body carried on at constant speed and turn rate, along the chord of its arc."""
    turn = item["yaw_rate_radps"] * seconds
    chord = math.sin(turn / 2) / (turn / 2) if turn != 0 else 1.0
    c, s = math.cos(turn / 2), math.sin(turn / 2)
    vx, vy = item["vx_mps"], item["vy_mps"]
    moved = dict(item, yaw_rad=item["yaw_rad"] + turn,
                 x_m=item["x_m"] + seconds * chord * (c * vx - s * vy),
                 y_m=item["y_m"] + seconds * chord * (s * vx + c * vy))
    moved["vx_mps"] = math.cos(turn) * vx - math.sin(turn) * vy
    moved["vy_mps"] = math.sin(turn) * vx + math.cos(turn) * vy
    return moved


def instant(sensor, frame):
    """The instant of the scan that falls into (time_s - interval_s, time_s], or None; that of a frame longer than the cycle
    is the frame's."""
    if frame["interval_s"] > sensor.get("cycle_s", 0) + NEAR or not sensor.get("cycle_s"):
        return frame["time_s"]
    last = math.floor(frame["time_s"] / sensor["cycle_s"] + NEAR) * sensor["cycle_s"]
    return last if last > frame["time_s"] - frame["interval_s"] + NEAR else None


class Body(oracle.Body):
    def __init__(self, item, document):
        super().__init__(item, document)
        self.height = item["height_m"] or document["height_m"]
        self.corners = [a for a, _ in self.outline()]
        self.blocks = self.model.get("blocks", False)
        self.clearance = self.model.get("clearance_m", 0)
        self.sides = [self.segment(side) for side in self.model.get("planes", [])]
        self.mirrors = [(self.segment(side), side) for side in self.model.get("mirrors", [])]

    def segment(self, side):
        return (self.world(self.scaled(side["from_x"], side["from_y"])),
                self.world(self.scaled(side["to_x"], side["to_y"])))


# ---- what stands in the way (MODEL 2.5, 14.3, 14.4) --------------------------------------------------


def stretch(corners, a, b, wider):
    """The part of the line a to b, as shares of its length, that is inside the convex outline grown by so
    much; or None."""
    low, high = crossings(corners, a, b, wider)
    return (low, high) if low <= high else None


def crossings(corners, a, b, wider=0.0):
    """Shares of the line at which it has entered the last side and at which it leaves the first, sides
    prolonged."""
    low, high, way = 0.0, 1.0, minus(b, a)
    for n, corner in enumerate(corners):
        inward = unit(minus(corners[(n + 1) % len(corners)], corner))
        inward = (-inward[1], inward[0])
        start, slope = dot(minus(a, corner), inward) + wider, dot(way, inward)
        if slope > 0:
            low = max(low, -start / slope)
        elif slope < 0:
            high = min(high, -start / slope)
        elif start < 0:
            return 1.0, 0.0
    return low, high


def touches(corners, a, b, wider):
    """The part of a line that touches an edge, or None; a line that is inside from end to end touches
    none."""
    inside = stretch(corners, a, b, -wider)
    if inside == (0.0, 1.0):
        return None
    return stretch(corners, a, b, wider)


def loss_factor(nu):
    """The factor of a knife edge on amplitude, there and back."""
    if nu >= DARK:
        return 0.0
    if nu <= -0.78:
        return 1.0
    return 10 ** (-2 * (6.9 + 20 * math.log10(math.hypot(nu - 0.1, 1) + nu - 0.1)) / 20)


def edge(depth, before, after, wavelength):
    before, after = max(before, 0.1), max(after, 0.1)
    return depth * math.sqrt(2 * (before + after) / (wavelength * before * after))


class Line:
    """A sight line from a to b, between heights (None in a flat world)."""

    def __init__(self, a, b, heights=None):
        self.a, self.b, self.heights = a, b, heights

    def height(self, share):
        return self.heights[0] + share * (self.heights[1] - self.heights[0])


def across(depth_at, length, wavelength, ends):
    """(nu of an edge across a line, how far the line stays clear of it), by the line's depth in its shadow."""
    ends = [min(max(share, 0.0), 1.0) for share in ends]
    depths = [depth_at(share) for share in ends]
    ways = [edge(depth, share * length, (1 - share) * length, wavelength) for depth, share in zip(depths, ends)]
    return max(ways), -max(depths)


def passage(body, line, wavelength, wider):
    """(the factor of one body on the line, nu of its easiest way round or None)."""
    inside = touches(body.corners, line.a, line.b, wider)
    edges = []
    if line.heights and body.height > 0:
        edges.append(lambda share: body.height - line.height(share))
    if line.heights and body.clearance > 0:
        edges.append(lambda share: abs(line.height(share)) - body.clearance)
    length = math.hypot(*minus(line.b, line.a))
    if not wavelength or length == 0:
        free = inside and any(across(depth_at, length, 1.0, inside)[1] > wider for depth_at in edges)
        return (0.0 if inside and not free else 1.0), None
    if not inside and stretch(body.corners, line.a, line.b, -wider) == (0.0, 1.0):
        return 1.0, None
    towards = unit(minus(line.b, line.a))
    feet = [(dot(minus(c, line.a), towards), cross(towards, minus(c, line.a))) for c in body.corners]
    if not inside:
        feet = [foot for foot in feet if -wider < foot[0] < length + wider]
    if not feet:
        return 1.0, None
    feet = [(min(max(along, 0.0), length), aside) for along, aside in feet]
    if inside:
        ways = [max(edge(sign * aside, along, length - along, wavelength) for along, aside in feet) for sign in (1, -1)]
        ways += [across(depth_at, length, wavelength, inside)[0] for depth_at in edges]
    else:
        over = [min((across(depth_at, length, wavelength, [along / length])[0] for depth_at in edges), default=math.inf)
                for along, _ in feet]
        ways = [max(min(edge(sign * aside, along, length - along, wavelength), way)
                    for (along, aside), way in zip(feet, over)) for sign in (1, -1)]
    return loss_factor(min(ways)), min(ways)


class Way:
    """What all bodies together let through of a line."""

    def __init__(self, scene, line, free):
        self.factor, self.doubtful, self.by, self.effects = 1.0, False, set(), set()
        if "occlusion" not in scene.effects:
            return
        if "height" not in scene.effects:
            line = Line(line.a, line.b)
        for body in scene.blockers:
            if body in free:
                continue
            factor, nu = passage(body, line, scene.wavelength, 0.0)
            others = [passage(body, line, scene.wavelength, wider)[0] for wider in (NEAR, -NEAR)]
            self.doubtful |= any(abs(factor - other) > 1e-6 for other in others)
            self.doubtful |= nu is not None and near(nu, DARK, 100)
            self.factor *= factor
            if factor == 0:
                self.by.add(body.id)


def joined(one, other):
    """True for two sides in line that meet at an end, but for rounding."""
    if abs(cross(unit(minus(*one)), unit(minus(*other)))) > NEAR:
        return False
    return any(math.hypot(*minus(p, q)) <= NEAR for p, q in ((one[0], other[1]), (one[1], other[0])))


# ---- reflectors, direct and by way of a mirror (MODEL 14.1, 14.2, 14.5) ------------------------------


class Leg:
    """A straight way from the sensor to a place, as it unfolds: range, azimuth, rate, gain of the beam."""

    def __init__(self, scene, place, rate, rise):
        sensor = scene.sensor
        self.plane_m = math.hypot(*minus(place, scene.place))
        if "elevation" not in scene.effects:
            rise = 0.0
        self.range = math.hypot(self.plane_m, rise)
        cosine = self.plane_m / self.range if self.range > 0 else 1.0
        ahead, aside = scene.turned(minus(place, scene.place))
        azimuth = math.atan2(aside, ahead)
        self.front = ahead > 0
        self.front_doubt = abs(azimuth) > math.pi / 2 - NEAR and abs(azimuth) < math.pi / 2 + NEAR
        if rise != 0:
            sine = math.sin(azimuth) * cosine
            azimuth = math.atan2(sine, math.copysign(math.sqrt(max(0.0, 1 - sine * sine)), math.cos(azimuth)))
        self.azimuth, self.rate = azimuth, rate * cosine
        width = sensor.get("elevation_half_width_rad", 0)
        self.gain = 1.0
        if width and rise != 0:
            self.gain = 2 ** -((math.atan2(rise, self.plane_m) / width) ** 2)


class Scene:
    """One sensor in the world at the instant of its scan."""

    def __init__(self, frame, vehicles, sensor, effects):
        self.sensor, self.effects = sensor, effects
        self.time = instant(sensor, frame) - (sensor.get("latency_s", 0) if "latency" in effects else 0)
        back = frame["time_s"] - self.time
        bodies = [Body(carried(item, -back), vehicles[item["class"]]) for item in frame["objects"]]
        ego = next(body for body in bodies if body.id == frame["ego"])
        self.bodies = [body for body in bodies if body is not ego]
        self.blockers = [body for body in self.bodies if body.blocks]
        self.place = ego.world((sensor["mount_x_m"], sensor["mount_y_m"]))
        self.velocity = ego.velocity_at(self.place)
        self.boresight = ego.yaw + sensor["mount_yaw_rad"]
        self.height = sensor.get("mount_z_m", 0)
        soft = sensor.get("diffraction", False) and "diffraction" in effects
        self.wavelength = LIGHT_MPS / sensor["carrier_hz"] if soft else 0.0

    def turned(self, way):
        c, s = math.cos(self.boresight), math.sin(self.boresight)
        return c * way[0] + s * way[1], c * way[1] - s * way[0]

    def rise(self, body, item):
        """Height of a reflector above the sensor; 0 in a flat world and for a reflector without a height."""
        return item["z"] * body.height - self.height if self.height and item.get("z") else 0.0

    def heights(self, rise):
        return (self.height, self.height + rise) if self.height else None

    def limits(self, distance, azimuth):
        low, high = self.sensor["range_min_m"], oracle.range_limit(self.sensor, azimuth)
        half = min(self.sensor["field_of_view_rad"] / 2, math.pi / 2) - oracle.VIEW_BORDER_RAD
        reason = None
        if not (distance > 0 and low <= distance <= high):
            reason = "out_of_range"
        elif abs(azimuth) >= half:
            reason = "out_of_view"
        return reason, near(distance, low) or near(distance, high, high) or abs(abs(azimuth) - half) < 2 * NEAR


class Echo:
    def __init__(self, key, **values):
        self.key = key
        self.__dict__.update(values)


class Scan:
    def __init__(self):
        self.echoes, self.lost, self.doubtful = {}, {}, set()
        self.cells, self.dark, self.doubtful_cells = [], [], False
        self.targets, self.interference = [], 0.0


def points_of(body):
    """Points and posts of a body: (document, local place, is it doubtful whether it is there, is it a
    post)."""
    for point in body.model.get("points", []):
        yield point, oracle.point_place(point, body), False, False
    for row in body.model.get("rows", []):
        for post, local, doubtful in oracle.posts_of(row, body):
            yield post, local, doubtful, True


def seen_from(body, point, place, eye):
    """Visibility: (V, is it doubtful whether it is 0)."""
    alpha = math.atan2(eye[1] - place[1], eye[0] - place[0]) - body.yaw
    delta = abs(math.remainder(alpha - point["facing_rad"], math.tau))
    doubtful = point["full_rad"] < math.pi and near(delta, point["zero_rad"])
    if point.get("shape") == "hard" or point["full_rad"] == point["zero_rad"]:
        doubtful |= point["full_rad"] < math.pi and near(delta, point["full_rad"])
    return oracle.visibility(point, delta), doubtful


def foot_of(side, margin, eye):
    """The foot on a side by MODEL 2.3: (foot, height of the eye over the side, is there one, is that
    doubtful)."""
    a, b = side
    length, along = math.hypot(*minus(b, a)), unit(minus(b, a))
    outward = (along[1], -along[0])
    t, height = dot(minus(eye, a), along), dot(minus(eye, a), outward)
    there = margin <= t <= length - margin and height > 0
    return plus(a, along, t), height, there, near(t, margin, abs(t)) or near(t, length - margin, abs(t)) or near(height, 0)


def side_ercs(scene, plane, distance):
    radius = plane.get("profile_radius_m", 0)
    if not (radius and scene.sensor.get("curved_sides") and "curvature" in scene.effects):
        return plane["ercs"]
    distance = max(distance, 0.0)
    area = math.pi * radius * distance ** 2 / (radius + distance)
    if plane.get("radius_m"):
        area *= plane["radius_m"] / (plane["radius_m"] + distance)
    return math.sqrt(area / 10)


def rate_along(scene, body, place):
    towards = unit(minus(place, scene.place)) if place != scene.place else (1.0, 0.0)
    return dot(minus(body.velocity_at(place), scene.velocity), towards)


class Direct:
    """One reflector, its direct way, and what its ghosts need of that way."""

    def __init__(self, scene, body, item, place, plane=False):
        self.plane = plane
        self.body, self.name, self.place, self.rise = body, item["name"], place, scene.rise(body, item)
        self.heights = (item["z"] * body.height, item.get("extent", 0) * body.height) if item.get("z") else None
        self.leg = Leg(scene, place, rate_along(scene, body, place), self.rise)
        self.reason, self.doubtful, self.by = None, False, set()
        self.way = None

    def passes(self, scene, free):
        self.way = self.way or Way(scene, Line(scene.place, self.place, scene.heights(self.rise)), free)
        return self.way

    def passes_by_road_too(self, scene, free):
        """The easier of both ways, and whether it is that by the road; ghosts have none by the road."""
        way, heights = self.passes(scene, free), scene.heights(self.rise)
        if not self.heights or self.plane or "height" not in scene.effects or way.factor == 1 \
                or not any(body.clearance for body in scene.bodies):
            return way, False
        road = Way(scene, Line(scene.place, self.place, (heights[0], -heights[1])), free)
        equal = road.factor != way.factor and near(road.factor, way.factor, 100)
        road.doubtful = way.doubtful = road.doubtful or way.doubtful or equal
        return (road, True) if road.factor > way.factor else (way, False)


def note(scene, scan, direct, ercs, reason, doubtful, post=False, free=()):
    """Enters a direct echo, or the reason of its loss."""
    key = (direct.body.id, direct.name, "direct", "", 0)
    leg, by = direct.leg, set()
    limit, limit_doubt = scene.limits(leg.range, leg.azimuth)
    if post and limit == "out_of_range" and not limit_doubt:
        return
    way, by_road = None, False
    if reason is None or doubtful:
        way, by_road = direct.passes_by_road_too(scene, {direct.body, *free})
        doubtful = doubtful or limit_doubt or ((limit is None or limit_doubt) and way.doubtful)
    if doubtful:
        scan.doubtful.add(key)
    reason = reason or limit
    if reason is None and way.factor == 0:
        reason, by = "blocked", way.by
    if reason:
        scan.lost[key] = (reason, by)
    else:
        scan.echoes[key] = Echo(key, range=leg.range, azimuth=leg.azimuth, rate=leg.rate, departure=0.0,
                                ercs=ercs * leg.gain * way.factor, along=leg.plane_m,
                                heights=None if by_road else direct.heights)


def see_point(scene, scan, body, point, local, doubtful, post):
    place = body.world(local)
    seen, doubt = seen_from(body, point, place, scene.place)
    direct = Direct(scene, body, point, place)
    note(scene, scan, direct, point["ercs"] * seen, None if seen > 0 else "facing_away", doubtful or doubt, post)
    for mirror in mirrors_for(scene, body):
        ghosts_of_point(scene, scan, mirror, direct, point, seen, doubtful or doubt)


def see_plane(scene, scan, body, plane):
    side = body.segment(plane)
    foot, height, there, doubtful = foot_of(side, plane.get("margin_m", 0), scene.place)
    direct = Direct(scene, body, plane, foot, plane=True)
    free = [other for other in scene.blockers if any(joined(side, mine) for mine in other.sides)]
    note(scene, scan, direct, side_ercs(scene, plane, height), None if there else "no_specular_point", doubtful,
         free=free)
    for mirror in mirrors_for(scene, body):
        ghost_of_plane(scene, scan, mirror, body, plane, side)


# ---- ghosts (MODEL 14.1) -----------------------------------------------------------------------------


def permittivity(material, carrier_hz):
    """ITU-R P.2040-3: relative, complex."""
    real, scale, exponent = {"concrete": (5.24, 0.0462, 0.7822), "brick": (3.91, 0.0238, 0.16),
                             "glass": (6.31, 0.0036, 1.3394), "metal": (1, 1e7, 0)}[material]
    f = carrier_hz / 1e9
    return real - 17.98j * scale * f ** exponent / f


def surface_part(eps, cosine, upright):
    """The size of Fresnel's coefficient of an upright wall, by Snell's law; an upright field is TE there."""
    index = cmath.sqrt(eps)
    onward = cmath.sqrt(1 - (1 - cosine ** 2) / eps)
    near_side, far_side = (cosine, index * onward) if upright else (index * cosine, onward)
    return abs((near_side - far_side) / (near_side + far_side))


class Mirror:
    def __init__(self, scene, body, number, segment, side):
        self.body, self.number, self.segment, self.side = body, number, segment, side
        a, b = segment
        self.along = unit(minus(b, a))
        self.length = math.hypot(*minus(b, a))
        self.outward = (self.along[1], -self.along[0])
        self.free = {other for other in scene.bodies
                     if other is body or any(joined(segment, mine) for mine, _ in other.mirrors)}

    def before(self, place):
        return dot(minus(place, self.segment[0]), self.outward)

    def part(self, scene, place, distance):
        """Of an amplitude after the bounce, on a way of that length from the sensor to the place."""
        heights = self.before(scene.place), self.before(place)
        cosine, first = sum(heights) / distance, heights[0] / sum(heights) * distance
        part = self.side.get("reflection") or surface_part(
            permittivity(self.side["material"], scene.sensor["carrier_hz"]), cosine,
            scene.sensor.get("polarization") != "horizontal")
        for radius, tilt in ((self.side.get("radius_m"), cosine), (self.side.get("profile_radius_m"), 1 / cosine)):
            if radius:  # the wavefront's own radius after the bounce, and its spreading from there on
                front = 1 / (1 / first + 2 / (radius * tilt))
                part *= math.sqrt(front / (front + distance - first) / (first / distance))
        return part

    def image(self, place):
        return plus(place, self.outward, -2 * self.before(place))

    def bounce(self, eye, place):
        """(W or None, the share of the way from the eye at which it lies, is that doubtful), by similar
        triangles."""
        here, there = self.before(eye), self.before(place)
        if here <= -NEAR or there <= -NEAR or here + there <= 0:
            return None, 0.0, False
        share = here / (here + there)
        start, end = dot(minus(eye, self.segment[0]), self.along), dot(minus(place, self.segment[0]), self.along)
        t = start + share * (end - start)
        doubtful = near(here, 0) or near(there, 0) or near(t, 0, self.length) or near(t, self.length, self.length)
        if not doubtful and not 0 <= t <= self.length:
            return None, 0.0, False
        return plus(self.segment[0], self.along, t), share, doubtful


def mirrors_for(scene, body):
    """The mirrors that may show an object. Reading: an object is no mirror for itself."""
    if "ghosts" not in scene.effects or scene.sensor.get("bounces", 0) < 2:
        return []
    if not hasattr(scene, "mirrors"):
        scene.mirrors = [Mirror(scene, other, n + 1, *mirror) for other in scene.bodies
                         for n, mirror in enumerate(other.mirrors)]
        scene.mirrors = [mirror for mirror in scene.mirrors if mirror.before(scene.place) > -NEAR]
    return [mirror for mirror in scene.mirrors if mirror.body is not body]


def bent_rate(scene, mirror, body, place, bounce):
    """The rate at which S-W-O grows: each end and the mirror at W add their speed along the ways that meet
    there."""
    out, back = unit(minus(bounce, scene.place)), unit(minus(bounce, place))
    middle = mirror.body.velocity_at(bounce)
    return (dot(minus(middle, scene.velocity), out) + dot(minus(middle, body.velocity_at(place)), back))


class Bent:
    """The way S-W-O, unfolded to S-O'."""

    def __init__(self, scene, mirror, body, place, rise):
        self.there = False
        self.bounce, self.share, self.doubtful = mirror.bounce(scene.place, place)
        if self.bounce is None or math.hypot(*minus(self.bounce, place)) == 0 or self.bounce == scene.place:
            return
        self.there = True
        self.leg = Leg(scene, mirror.image(place), bent_rate(scene, mirror, body, place, self.bounce), rise)
        heights = scene.heights(rise)
        first = second = None
        if heights:
            turn = heights[0] + self.share * rise
            first, second = (heights[0], turn), (turn, heights[1])
            bottom = mirror.side.get("bottom", 0) * mirror.body.height
            self.doubtful |= (near(turn, mirror.body.height) or near(turn, bottom)) and "height" in scene.effects
            if (turn > mirror.body.height > 0 or turn < bottom) and "height" in scene.effects:
                self.there = False
        self.lines = [Line(scene.place, self.bounce, first), Line(self.bounce, place, second)]
        self.free = [mirror.free, mirror.free | {body}]

    def passes(self, scene):
        ways = [Way(scene, line, free) for line, free in zip(self.lines, self.free)]
        return ways[0].factor * ways[1].factor, ways[0].doubtful or ways[1].doubtful


def enter_ghost(scene, scan, mirror, body, name, path, legs, ercs, reach, doubtful):
    """Enters the ghost of two legs, the way out and the way back. Ghosts that are not seen are not made."""
    out, back = legs
    key = (body.id, name, path, mirror.body.id, mirror.number)
    distance = (out.range + back.range) / 2
    limit, doubt = scene.limits(distance, back.azimuth)
    doubt = doubt or doubtful or out.front_doubt
    if doubt:
        scan.doubtful.add(key)
    if limit or not out.front or not reach or ercs <= 0:
        return
    scan.echoes[key] = Echo(key, range=distance, azimuth=back.azimuth, rate=(out.rate + back.rate) / 2,
                            departure=out.azimuth if path in ONE_WAY else 0.0, ercs=ercs, along=0.0, heights=None)


def ghosts_of_point(scene, scan, mirror, direct, point, seen, doubtful):
    bent = Bent(scene, mirror, direct.body, direct.place, direct.rise)
    if not bent.there and not bent.doubtful or bent.bounce is None or not hasattr(bent, "lines"):
        return
    aside, doubt = seen_from(direct.body, point, direct.place, bent.bounce)
    if aside <= 0 and not doubt:
        return
    factor, sight = bent.passes(scene)
    doubt = doubt or sight or bent.doubtful
    here, there = direct.leg, bent.leg
    part = mirror.part(scene, direct.place, there.range)
    strength = part * point["ercs"]
    reach = bent.there
    if scene.sensor["bounces"] >= 3:
        enter_ghost(scene, scan, mirror, direct.body, direct.name, "wall_object_wall", (there, there),
                    strength * part * aside * there.gain * factor, reach, doubt)
    if (seen <= 0 and not doubtful) or here.range == 0:
        return
    way = direct.passes(scene, {direct.body})
    doubt = doubt or doubtful or way.doubtful
    middle = (here.range + there.range) / 2
    ercs = (strength * math.sqrt(seen * aside) * math.sqrt(here.gain * there.gain) * math.sqrt(way.factor * factor)
            * middle ** 2 / (here.range * there.range))
    for path, legs in (("wall_object", (there, here)), ("object_wall", (here, there))):
        enter_ghost(scene, scan, mirror, direct.body, direct.name, path, legs, ercs, reach, doubt)


def ghost_of_plane(scene, scan, mirror, body, plane, side):
    """The one ghost of a flat side, out and back by the mirror: only from the foot of the sensor's image does
    the wave return."""
    if scene.sensor["bounces"] < 3:
        return
    foot, height, there, doubtful = foot_of(side, plane.get("margin_m", 0), mirror.image(scene.place))
    if not there and not doubtful:
        return
    bent = Bent(scene, mirror, body, foot, scene.rise(body, plane))
    if bent.bounce is None or not hasattr(bent, "lines"):
        return
    bent.free[1] = bent.free[1] | {other for other in scene.blockers if any(joined(side, mine) for mine in other.sides)}
    factor, sight = bent.passes(scene)
    leg = bent.leg
    enter_ghost(scene, scan, mirror, body, plane["name"], "wall_object_wall", (leg, leg),
                mirror.part(scene, foot, leg.range) ** 2 * side_ercs(scene, plane, height) * leg.gain * factor,
                there and bent.there, doubtful or sight or bent.doubtful)


# ---- the road as a mirror (MODEL 14.10) ----------------------------------------------------------------


def road_of(scene, frame):
    """The road of the conditions: (complex permittivity, roughness in m), or None."""
    road, carrier_hz = frame.get("conditions", {}).get("road"), scene.sensor["carrier_hz"]
    if not scene.height or "two_ray" not in scene.effects:
        return None
    return {"asphalt": (5 - 0.25j, 1e-3), "concrete": (permittivity("concrete", carrier_hz), 3e-4)}.get(road)


def road_factor(scene, road, along, heights):
    """The factor of the road: the root of the mean power over a reflector's extent, over that over all phases."""
    own, (high, extent) = scene.height, heights
    wavelength = LIGHT_MPS / scene.sensor["carrier_hz"]
    near_m, far_m = math.hypot(along, own - high), math.hypot(along, own + high)
    sine = (own + high) / far_m
    bent = cmath.sqrt(road[0] - (along / far_m) ** 2)
    steep = sine * (1 if scene.sensor.get("polarization") == "horizontal" else road[0])
    g = (steep - bent) / (steep + bent) * math.exp(-8 * (math.pi * road[1] * sine / wavelength) ** 2) * near_m / far_m
    def swing(phase):  # its derivative is |1 + g exp(jx)|^4 without the mean
        return 4 * abs(g) * (1 + abs(g) ** 2) * math.sin(phase) + abs(g) ** 2 * math.sin(2 * phase)

    mean = 1 + 4 * abs(g) ** 2 + abs(g) ** 4
    middle, half = (2 * math.pi * 4 * own * metres / (near_m + far_m) / wavelength for metres in (high, extent / 2))
    if half == 0:
        return abs(1 + g * cmath.exp(-1j * middle)) ** 2 / math.sqrt(mean)
    middle -= cmath.phase(g)
    return math.sqrt(max(1 + (swing(middle + half) - swing(middle - half)) / (2 * half) / mean, 0))


# ---- rain, fog, ambiguity, interference (MODEL 14.15 to 14.17) ------------------------------------------

RAIN_K = {"horizontal": ([(-5.33980, -0.10008, 1.13098), (-0.35351, 1.26970, 0.45400), (-0.23789, 0.86036, 0.15354),
                          (-0.94158, 0.64552, 0.16817)], -0.18961, 0.71147),
          "vertical": ([(-3.80595, 0.56934, 0.81061), (-3.44965, -0.22911, 0.51059), (-0.39902, 0.73042, 0.11899),
                        (0.50167, 1.07319, 0.27195)], -0.16398, 0.63297)}
RAIN_ALPHA = {"horizontal": ([(-0.14318, 1.82442, -0.55187), (0.29591, 0.77564, 0.19822), (0.32177, 0.63773, 0.13164),
                              (-5.37610, -0.96230, 1.47828), (16.1721, -3.29980, 3.43990)], 0.67849, -1.95537),
              "vertical": ([(-0.07771, 2.33840, -0.76284), (0.56727, 0.95545, 0.54039), (-0.20238, 1.14520, 0.26809),
                            (-48.2991, 0.791669, 0.116226), (48.5833, 0.791459, 0.116479)], -0.053739, 0.83433)}


def bells(table, carrier_hz):
    lines, slope, rest = table
    f = math.log10(carrier_hz / 1e9)
    return math.fsum(a * math.exp(-((f - b) / c) ** 2) for a, b, c in lines) + slope * f + rest


# Decibels per km, one way, of every weather that attenuates: effect -> (condition, law(sensor, value)).
ATTENUATIONS = {}


def attenuation(effect, condition):
    def enter(law):
        ATTENUATIONS[effect] = condition, law
        return law
    return enter


@attenuation("rain", "rain_mmph")
def rain_dbpkm(sensor, rate):
    """ITU-R P.838-3."""
    kind = sensor.get("polarization", "vertical")
    k, alpha = 10 ** bells(RAIN_K[kind], sensor["carrier_hz"]), bells(RAIN_ALPHA[kind], sensor["carrier_hz"])
    return k * rate ** alpha if rate > 0 else 0.0


@attenuation("fog", "fog_gpm3")
def fog_dbpkm(sensor, water):
    """Attenuation by fog, ITU-R P.840, double-Debye permittivity of water."""
    f, theta = sensor["carrier_hz"] / 1e9, 300 / (273.15 + FOG_CELSIUS)
    e0 = 77.66 + 103.3 * (theta - 1)
    e1, e2 = 0.0671 * e0, 3.52
    fp = 20.20 - 146 * (theta - 1) + 316 * (theta - 1) ** 2
    fs = 39.8 * fp
    imaginary = f * (e0 - e1) / (fp * (1 + (f / fp) ** 2)) + f * (e1 - e2) / (fs * (1 + (f / fs) ** 2))
    real = (e0 - e1) / (1 + (f / fp) ** 2) + (e1 - e2) / (1 + (f / fs) ** 2) + e2
    eta = (2 + real) / imaginary
    return 0.819 * f / (imaginary * (1 + eta * eta)) * water


@attenuation("snow", "snow_mmph")
def snow_dbpkm(sensor, rate):
    """Gunn and East, by wavelength in cm."""
    centimetres = LIGHT_MPS / sensor["carrier_hz"] * 100
    return 3.49e-3 * rate ** 1.6 * centimetres ** -4 + 2.24e-3 * rate / centimetres


def weather_dbpkm(sensor, conditions, effects):
    return sum(law(sensor, conditions.get(condition, 0)) for effect, (condition, law) in ATTENUATIONS.items()
               if effect in effects)


def walked(sensor, echo, effects):
    """Level and width of an echo that walks through range cells, 1 at rest (MODEL 14.20)."""
    laws = {"rectangular": ((0.142, 0.1191, 0.1389), (0, 0.07909, 0.1149)),
            "hann": ((0.04446, 3.041e-4, 4.899e-3), (0.0368, 2.462e-4, 3.976e-3))}
    window = sensor.get("range_migration")
    if window not in laws or "range_migration" not in effects:
        return 1.0, 1.0
    full = 2 if sensor.get("cell_extent", "width") == "half_width" else 1
    dwell = LIGHT_MPS / sensor["carrier_hz"] / 2 / (full * sensor["cell_range_rate_mps"])
    cells = abs(echo.rate) * dwell / (full * sensor["cell_range_m"])
    loss, width = [math.sqrt(1 + cells ** 2 * (a + b * cells ** 3) / (1 + c * cells ** 3))
                   for a, b, c in laws[window]]
    return 1 / loss, width


def folded(value, low, width):
    return value - width * math.floor((value - low) / width)


def interference(scene, frame, antenna):
    sensor = scene.sensor
    bandwidth = sensor.get("receiver_bandwidth_hz", 0)
    if not bandwidth or "interference" not in scene.effects:
        return 0.0
    noise = 10 * math.log10(1.380649e-23 * 290 * bandwidth * 1e3) + sensor.get("noise_figure_db", 0)
    ratio = 0.0
    for other in frame.get("conditions", {}).get("interferers", []):
        for body in scene.bodies:
            if body.id != other["object"]:
                continue
            way = minus((body.x, body.y), scene.place)
            ahead, aside = scene.turned(way)
            azimuth = math.atan2(aside, ahead)
            gain = abs(antenna.pointers(azimuth)[0]) if abs(azimuth) < math.pi / 2 else 0.0
            if abs(azimuth) >= sensor["field_of_view_rad"] / 2 or gain == 0:
                continue
            power = (other["eirp_dbm"] + sensor.get("antenna_gain_dbi", 0) + 10 * math.log10(gain)
                     + 20 * math.log10(LIGHT_MPS / sensor["carrier_hz"] / (4 * math.pi * math.hypot(*way))))
            slope = abs(sensor.get("chirp_slope_hzps", 0) - other["slope_hzps"])
            band = bandwidth * (1 if sensor.get("if_sampling") == "complex" else 2)
            overlap = min(1.0, band / (slope * sensor["chirp_s"])) if slope > 0 else 1.0
            ratio += 10 ** ((power - noise) / 10) * overlap * other["hit_share"]
    return ratio


# ---- antenna, cells, targets (MODEL 6 to 9, 14.1, 14.8) ----------------------------------------------


class Antenna:
    """An antenna: the dipoles, or rows of (azimuth, sum, delta), linear between rows and zero outside."""

    def __init__(self, sensor, rows=None):
        self.sensor, self.rows = sensor, rows

    def pointers(self, azimuth):
        if self.rows is None:
            return oracle.pointers(azimuth, self.sensor["phase_reference"])
        rows = self.rows
        if not rows[0][0] <= azimuth <= rows[-1][0]:
            return 0.0, 0.0
        n = next(n for n in range(len(rows) - 1) if azimuth <= rows[n + 1][0])
        share = (azimuth - rows[n][0]) / (rows[n + 1][0] - rows[n][0])
        total, delta = [rows[n][k] + share * (rows[n + 1][k] - rows[n][k]) for k in (1, 2)]
        return total, -1j * delta

    def azimuth(self, total, delta):
        """The azimuth of two pointers: (azimuth, is its sign undecided, |sine of the phase|); None where the
        table has no such ratio."""
        if self.rows is None:
            return oracle.estimate(total, delta, self.sensor["angle_estimator"])
        ratio = -(delta * complex(total).conjugate()).imag / abs(total) ** 2
        for (a, s0, d0), (b, s1, d1) in zip(self.rows, self.rows[1:]):
            if s0 > 0 and s1 > 0 and d0 / s0 <= ratio <= d1 / s1:
                share = (ratio * s0 - d0) / ((d1 - d0) - ratio * (s1 - s0))
                return a + share * (b - a), False, 1.0
        return None, False, 1.0


class Ray:
    def __init__(self, sensor, antenna, echo, weather, effects):
        self.echo, self.key = echo, echo.key
        self.strength = oracle.reference_amplitude(sensor, echo.range) * echo.ercs * echo.road
        self.strength *= 10 ** (-2 * weather * echo.range / 1000 / 20)
        level, self.size = walked(sensor, echo, effects)
        self.strength *= level
        h_s, h_d = antenna.pointers(echo.azimuth)
        if self.key[2] in ONE_WAY:
            out = abs(antenna.pointers(echo.departure)[0])
            scale = math.sqrt(out / abs(h_s)) if h_s != 0 else 0.0
            h_s, h_d = h_s * scale, h_d * scale
        self.total, self.delta = self.strength * h_s, self.strength * h_d
        self.amplitude = abs(self.total)
        self.range, self.rate = echo.range, echo.rate
        if "ambiguity" in effects:
            if sensor.get("unambiguous_range_m"):
                self.range = folded(self.range, 0, sensor["unambiguous_range_m"])
            if sensor.get("unambiguous_rate_mps"):
                limit, middle = sensor["unambiguous_rate_mps"], sensor.get("unambiguous_middle_mps", 0)
                self.rate = folded(self.rate, middle - limit, 2 * limit)

    def order(self):
        return -self.amplitude, self.range, self.rate, self.echo.azimuth, self.key


def fold_doubtful(sensor, rays, effects):
    if "ambiguity" not in effects:
        return False
    limit, width = sensor.get("unambiguous_rate_mps", 0), sensor.get("unambiguous_range_m", 0)
    middle = sensor.get("unambiguous_middle_mps", 0)
    return any((limit and near(abs(abs(ray.rate - middle) - limit), 0)) or
               (width and min(ray.range, width - ray.range) < NEAR) for ray in rays)


class Cell:
    def __init__(self, members, antenna):
        self.members = members
        self.keys = frozenset(ray.key for ray in members)
        self.amplitude = math.fsum(ray.amplitude for ray in members)
        self.weights = {ray.key: ray.amplitude / self.amplitude for ray in members} if self.amplitude > 0 else {}
        mean = lambda name: math.fsum(self.weights[ray.key] * getattr(ray, name) for ray in members)
        self.total, self.delta = sum(ray.total for ray in members), sum(ray.delta for ray in members)
        if self.amplitude > 0:
            self.range, self.rate = mean("range"), mean("rate")
            self.azimuth, self.undecided, self.sine = antenna.azimuth(self.total, self.delta)


def resolve(scan, sensor, antenna, rays, limit):
    """Cells by MODEL 6; lost cells go to scan.dark with their amplitude."""
    half_range, half_rate = oracle.half_cells(sensor)
    left = sorted((ray for ray in rays if ray.amplitude > 0), key=Ray.order)
    while left:
        leader, members, others = left[0], [], []
        for ray in left:
            size = max(ray.size, leader.size)
            far, fast = abs(ray.range - leader.range) / size, abs(ray.rate - leader.rate) / size
            tie = near(ray.amplitude, leader.amplitude, leader.amplitude) and ray is not leader
            same = far <= NEAR and fast <= NEAR
            scan.doubtful_cells |= (tie and not same) or near(far, half_range) or near(fast, half_rate)
            (members if far <= half_range and fast <= half_rate else others).append(ray)
        left = others
        cell = Cell(members, antenna)
        scan.doubtful_cells |= near(cell.amplitude, limit, limit)
        (scan.cells if cell.amplitude >= limit else scan.dark).append(cell)


class Target:
    """The target of a cell without draws: its azimuth after bumper and misaligned mount, and its rounded
    values."""

    def __init__(self, cell, sensor, effects):
        self.cell, self.doubtful = cell, False
        self.azimuth = cell.azimuth
        if "misalignment" in effects and self.azimuth is not None:
            self.azimuth += sensor.get("misalignment_rad", 0)
            if sensor.get("radome_bias_rad"):
                self.azimuth += sensor["radome_bias_rad"] * math.sin(
                    math.tau * cell.azimuth / sensor["radome_period_rad"] + sensor.get("radome_phase_rad", 0))
        self.range, self.rate = cell.range, cell.rate
        self.amplitude = abs(cell.total)
        self.unrounded = self.range
        if "quantisation" in effects:
            self.range = self.rounded(self.range, sensor.get("range_step_m", 0))
            self.rate = self.rounded(self.rate, sensor.get("range_rate_step_mps", 0))
            self.azimuth = self.rounded(self.azimuth, sensor.get("azimuth_step_rad", 0))

    def rounded(self, value, step):
        if not step or value is None:
            return value
        steps = abs(value) / step
        self.doubtful |= abs(steps - math.floor(steps) - 0.5) < 1e-9 * max(1.0, 1 / step)
        return math.copysign(math.floor(steps + 0.5) * step, value)


def list_targets(scan, sensor, limit, effects):
    """Targets in the list's order, cut at its limit."""
    targets = [Target(cell, sensor, effects) for cell in scan.cells]
    scan.doubtful_cells |= any(near(t.amplitude, limit, limit) for t in targets) and sensor["final_threshold"]
    kept = [t for t in targets if not sensor["final_threshold"] or t.amplitude >= limit]
    scan.below_final = [t.cell for t in targets if t not in kept]
    nearest = sensor["list_order"] == "nearest"
    kept.sort(key=lambda t: t.unrounded if nearest else -t.amplitude)
    most = sensor["list_limit"] if "list_limit" in effects else 0
    scan.targets, scan.beyond = (kept[:most], kept[most:]) if most else (kept, [])


def scan(frame, vehicles, sensor, effects, rows=None):
    made, scene, antenna = Scan(), Scene(frame, vehicles, sensor, effects), Antenna(sensor, rows)
    made.time = scene.time
    for body in scene.bodies:
        for point, local, doubtful, post in points_of(body):
            see_point(scene, made, body, point, local, doubtful, post)
        for plane in body.model.get("planes", []):
            see_plane(scene, made, body, plane)
    weather = weather_dbpkm(sensor, frame.get("conditions", {}), effects)
    road = road_of(scene, frame)
    for echo in made.echoes.values():
        echo.road = 1.0
        if road and echo.heights:
            echo.road = road_factor(scene, road, echo.along, echo.heights)
    rays = [Ray(sensor, antenna, echo, weather, effects) for echo in made.echoes.values()]
    made.no_amplitude = {ray.key for ray in rays if ray.amplitude == 0}
    made.doubtful_cells |= fold_doubtful(sensor, rays, effects)
    made.interference = interference(scene, frame, antenna)
    # The floor, and with it the threshold, rise by what other radars add.
    rise = math.sqrt(1 + made.interference)
    made.threshold = oracle.threshold(sensor) * rise
    resolve(made, sensor, antenna, rays, oracle.first_threshold(sensor) * rise)
    list_targets(made, sensor, made.threshold, effects)
    return made
