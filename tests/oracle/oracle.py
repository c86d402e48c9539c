"""The reflection-centre model (MODEL 2 to 8), computed a second time and independently.

look(frame, vehicles, suite) takes a frame with `objects`, the vehicle documents by class and a
sensor suite document, and returns one View per sensor. It knows nothing of the program: plain
formulas in doubles, occlusion decided exactly. A View also names its doubts: decisions so close
to their boundary (DOUBT) that another order of rounding may rightly decide the other way.

Readings taken where MODEL leaves room are marked "Reading:".
"""

import cmath
import math
from fractions import Fraction

DOUBT = 1e-12
UNDECIDED = 2.0 ** -47
# Reading: the border of the view is outside and this wide: the foot on a wall along boresight lies on it but
# for rounding.
VIEW_BORDER_RAD = 1e-9


class View:
    """What one sensor sees: echoes by (object, reflector), and cells in the order in which they are made."""

    def __init__(self, name):
        self.sensor = name
        self.echoes = {}
        self.cells = []
        self.doubtful_echoes = set()
        self.doubtful_cells = False


def close(value, bound, scale=1.0):
    return abs(value - bound) <= DOUBT * scale


# ---- objects and where their reflectors are (MODEL 2.1, 2.3, 2.4) ----------------------------


class Body:
    def __init__(self, item, document):
        self.id = item["id"]
        self.x, self.y, self.yaw = item["x_m"], item["y_m"], item["yaw_rad"]
        self.vx, self.vy, self.turn = item["vx_mps"], item["vy_mps"], item["yaw_rate_radps"]
        self.length = item["length_m"] or document["length_m"]
        self.width = item["width_m"] or document["width_m"]
        self.model = document["reflectors"]

    def world(self, local):
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return (self.x + c * local[0] - s * local[1], self.y + s * local[0] + c * local[1])

    def velocity_at(self, place):
        return (self.vx - self.turn * (place[1] - self.y), self.vy + self.turn * (place[0] - self.x))

    def scaled(self, x, y):
        return (x * self.length, y * self.width)

    def outline(self):
        places = ((0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5), (0.5, -0.5))
        corners = [self.world(self.scaled(*place)) for place in places]
        return [(corners[n], corners[(n + 1) % 4]) for n in range(4)]


def posts_of(row, body):
    """Post n stands n spacings from the row's start, counted from 0; the end is included."""
    start, end = body.scaled(row["from_x"], row["from_y"]), body.scaled(row["to_x"], row["to_y"])
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    steps = length / row["spacing_m"]
    for n in range(int(steps * (1 + DOUBT)) + 1):
        along = n * row["spacing_m"] / length if length > 0 else 0.0
        place = (start[0] + along * dx, start[1] + along * dy)
        yield dict(row, name=f"{row['name']}_{n}"), place, n > steps * (1 - DOUBT) - DOUBT and n != steps


def point_place(point, body):
    """Reading: an inset moves the point inwards, against its facing."""
    x, y = body.scaled(point["x"], point["y"])
    depth = point.get("inset_m", 0.0)
    return (x - depth * math.cos(point["facing_rad"]), y - depth * math.sin(point["facing_rad"]))


# ---- visibility (MODEL 2.2) -------------------------------------------------------------------


def visibility(point, delta):
    """V of MODEL 2.2; delta is |angle off the facing|. The first branch wins where full and zero are
    equal."""
    shape, full, zero = point.get("shape", "raised_cosine"), point["full_rad"], point["zero_rad"]
    if shape == "cosine":  # Reading: MODEL 2.2's formula has no flat part, so full is not used
        return math.cos(0.5 * math.pi * delta / zero) if delta < zero else 0.0
    if delta <= full:
        return 1.0
    if shape == "hard":  # Reading: 1 up to delta_2, which belongs to it
        return 1.0 if delta <= zero else 0.0
    if delta >= zero:
        return 0.0
    fall = (delta - full) / (zero - full)
    if shape == "linear":
        return 1.0 - fall
    return math.cos(0.5 * math.pi * fall) ** 2


def visibility_doubtful(point, delta):
    if point["full_rad"] >= math.pi:
        return False
    if point.get("shape") == "hard" or point["full_rad"] == point["zero_rad"]:
        return close(delta, point["zero_rad"]) or close(delta, point["full_rad"])
    return close(delta, point["zero_rad"])


# ---- sight lines (MODEL 2.5, closed test) -----------------------------------------------------


def side(a, b, c):
    """(sign of the turn a -> b -> c, decided exactly on the doubles; is it within DOUBT of 0)."""
    value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    size = (abs(b[0] - a[0]) + abs(b[1] - a[1])) * (abs(c[0] - a[0]) + abs(c[1] - a[1]))
    reach = max(abs(v) for p in (a, b, c) for v in p)
    doubtful = abs(value) <= DOUBT * (size + reach)
    if abs(value) <= 1e-9 * (size + reach * reach):
        (ax, ay), (bx, by), (cx, cy) = [tuple(map(Fraction, p)) for p in (a, b, c)]
        value = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (value > 0) - (value < 0), doubtful


def between(a, b, c):
    return min(a[0], b[0]) <= c[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= c[1] <= max(a[1], b[1])


def segments_touch(a, b, c, d):
    """(do the closed segments a-b and c-d share a point, is that doubtful)."""
    sides = [side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)]
    signs = [s for s, _ in sides]
    near = [sides[0][1] or sides[1][1], sides[2][1] or sides[3][1]]
    cross = [signs[0] * signs[1] <= 0, signs[2] * signs[3] <= 0]
    if all(s == 0 for s in signs):
        touch = between(a, b, c) or between(a, b, d) or between(c, d, a) or between(c, d, b)
    else:
        touch = all(cross)
    apart = any(not cross[n] and not near[n] for n in (0, 1))
    return touch, not apart and any(near)


def sight(sensor, place, owner, blockers):
    """What the sight line meets: ("clear", "under" raised vehicles only, or "blocked"; is that doubtful)."""
    state, doubtful = "clear", False
    for other, edges in blockers:
        if other is owner:
            continue
        found = [segments_touch(sensor, place, *edge) for edge in edges]
        if any(touch for touch, _ in found):
            raised = other.model.get("raised", False)
            state = "under" if raised and state in ("clear", "under") else "blocked"
        if not any(touch and not doubt for touch, doubt in found):
            doubtful = doubtful or any(doubt for _, doubt in found)
    return state, doubtful


# ---- one sensor and its echoes (MODEL 2.4, 2.5, 5) --------------------------------------------


def range_limit(document, azimuth):
    """The greatest range at an azimuth: straight between the limits beside it."""
    rows = [(row["azimuth_rad"], row["range_max_m"]) for row in document.get("range_limits", [])]
    if not rows:
        return document["range_max_m"]
    at = min(max(abs(azimuth), rows[0][0]), rows[-1][0])
    for (x, low), (y, high) in zip(rows, rows[1:]):
        if x <= at <= y:
            return (low * (y - at) + high * (at - x)) / (y - x)
    return rows[0][1]


class Radar:
    def __init__(self, document, ego):
        self.document = document
        self.place = ego.world((document["mount_x_m"], document["mount_y_m"]))
        self.velocity = ego.velocity_at(self.place)
        self.boresight = ego.yaw + document["mount_yaw_rad"]

    def to(self, place):
        """The way to a place: (distance, unit vector)."""
        dx, dy = place[0] - self.place[0], place[1] - self.place[1]
        distance = math.hypot(dx, dy)
        return distance, (dx / distance, dy / distance) if distance > 0 else (1.0, 0.0)

    def observe(self, towards, velocity):
        """The reading of a moving place: (azimuth, range rate)."""
        c, s = math.cos(self.boresight), math.sin(self.boresight)
        azimuth = math.atan2(c * towards[1] - s * towards[0], c * towards[0] + s * towards[1])
        wx, wy = velocity[0] - self.velocity[0], velocity[1] - self.velocity[1]
        return azimuth, wx * towards[0] + wy * towards[1]

    def limits(self, distance, azimuth):
        """(is it within range and field of view, is that doubtful)."""
        low, high = self.document["range_min_m"], range_limit(self.document, azimuth)
        half = min(0.5 * self.document["field_of_view_rad"], 0.5 * math.pi) - VIEW_BORDER_RAD
        inside = distance > 0 and low <= distance <= high and abs(azimuth) < half
        scale = max(1.0, distance)
        return inside, close(distance, low, scale) or close(distance, high, scale) or close(abs(azimuth), half)


def add_echo(view, radar, body, blockers, name, place, line, ercs, under, doubtful):
    distance, towards = line
    azimuth, rate = radar.observe(towards, body.velocity_at(place))
    inside, limit_doubt = radar.limits(distance, azimuth)
    if not inside and not limit_doubt:
        return
    state, sight_doubt = sight(radar.place, place, body, blockers)
    key = (body.id, name)
    if doubtful or limit_doubt or sight_doubt:
        view.doubtful_echoes.add(key)
    # Reading: the part left under raised vehicles counts once, however many there are.
    ercs *= {"clear": 1.0, "under": under, "blocked": 0.0}[state]
    if inside and ercs > 0:
        view.echoes[key] = {"range_m": distance, "azimuth_rad": azimuth, "range_rate_mps": rate, "ercs": ercs}


def look_at_point(view, radar, body, blockers, point, local, doubtful=False):
    place = body.world(local)
    alpha = math.atan2(radar.place[1] - place[1], radar.place[0] - place[0]) - body.yaw
    delta = abs(math.remainder(alpha - point["facing_rad"], math.tau))
    doubtful = doubtful or visibility_doubtful(point, delta)
    seen = visibility(point, delta)
    if seen > 0 or doubtful:
        add_echo(view, radar, body, blockers, point["name"], place, radar.to(place), point["ercs"] * seen,
                 point.get("under_vehicles", 0.0), doubtful)


def look_at_plane(view, radar, body, blockers, plane):
    """The foot on a flat side by MODEL 2.3; the outer face is to the right of from -> to."""
    a = body.world(body.scaled(plane["from_x"], plane["from_y"]))
    b = body.world(body.scaled(plane["to_x"], plane["to_y"]))
    e, s = (b[0] - a[0], b[1] - a[1]), radar.place
    length = math.hypot(*e)
    normal = (e[1] / length, -e[0] / length)
    t = ((s[0] - a[0]) * e[0] + (s[1] - a[1]) * e[1]) / (length * length)
    height = normal[0] * (s[0] - a[0]) + normal[1] * (s[1] - a[1])
    margin = plane.get("margin_m", 0.0) / length
    doubtful = close(t, margin, max(1.0, abs(t))) or close(t, 1 - margin, max(1.0, abs(t))) or close(height, 0)
    exists = margin <= t <= 1 - margin and height > 0
    if exists or doubtful:
        foot = (a[0] + t * e[0], a[1] + t * e[1])
        line = (max(height, 0.0), (-normal[0], -normal[1]))
        add_echo(view, radar, body, blockers, plane["name"], foot, line, plane["ercs"] if exists else 0.0, 0.0, doubtful)


def see(view, radar, bodies, blockers):
    for body in bodies:
        for point in body.model.get("points", []):
            look_at_point(view, radar, body, blockers, point, point_place(point, body))
        for row in body.model.get("rows", []):
            for post, local, doubtful in posts_of(row, body):
                look_at_point(view, radar, body, blockers, post, local, doubtful)
        for plane in body.model.get("planes", []):
            look_at_plane(view, radar, body, blockers, plane)


# ---- amplitude, cells, angle (MODEL 4, 6, 7, 8) -----------------------------------------------


def threshold(sensor):
    return 10.0 ** (sensor["threshold_db"] / 20.0)


def first_threshold(sensor):
    """The threshold on cells without noise (MODEL 8.4)."""
    lowered = sensor["final_threshold"] and sensor.get("first_threshold") != "full"
    return max(threshold(sensor) - 1.75 * sensor["pointer_sigma"], 0) if lowered else threshold(sensor)


def reference_amplitude(sensor, distance):
    """A_ref of equation (3): calibration_ercs just meets the threshold at calibration_range_m."""
    q = sensor.get("exponent", 2.0)
    a_1 = threshold(sensor) / sensor["calibration_ercs"] * sensor["calibration_range_m"] ** q
    return a_1 / max(distance, sensor.get("range_floor_m", 0.5)) ** q


def pointers(azimuth, reference):
    """Equation (6): sum and delta of two half-wave dipoles half a wavelength apart."""
    u = 0.5 * math.pi * math.sin(azimuth)
    element = (math.sin(u) / u if u != 0 else 1.0) * math.cos(azimuth)
    turn = cmath.exp(1j * u) if reference == "element" else 1.0
    return element * math.cos(u) * turn, -1j * element * math.sin(u) * turn


def estimate(total, delta, estimator):
    """(azimuth, is its sign undecided, |sine of the phase between the channels|)."""
    imaginary = (delta * total.conjugate()).imag
    product = abs(delta) * abs(total)
    if estimator == "ratio":  # Reading: H_D/H_S = -j tan u, so tan u is minus its imaginary part
        return math.asin(2 / math.pi * math.atan2(-imaginary, abs(total) ** 2)), False, 1.0
    magnitude = math.asin(min(1.0, 2 / math.pi * math.atan2(abs(delta), abs(total))))
    sine = abs(imaginary) / product if product > 0 else 0.0
    if abs(imaginary) <= UNDECIDED * product:
        return magnitude, True, sine
    return (-magnitude if imaginary > 0 else magnitude), False, sine


def half_cells(sensor):
    """Half a resolution cell in range and in range rate (MODEL 6)."""
    waveform, share = sensor.get("waveform"), 1.0 if sensor.get("cell_extent", "width") == "half_width" else 0.5
    shares = [share, share]
    if waveform:
        window = {"hann": 1.7748, "rectangular": 0.9967}[waveform.get("window", "hann")]
        shares = [3.5802 / 4 if waveform["kind"] == "pulse" else window, window]
    return shares[0] * sensor["cell_range_m"], shares[1] * sensor["cell_range_rate_mps"]


def make_cell(sensor, members):
    reference = sensor["phase_reference"]
    amplitude = math.fsum(m["amplitude"] for m in members)
    weights = [m["amplitude"] / amplitude for m in members]
    total = delta = 0j
    for m in members:
        gain = reference_amplitude(sensor, m["range_m"]) * m["ercs"]
        h_s, h_d = pointers(m["azimuth_rad"], reference)
        total += gain * h_s
        delta += gain * h_d
    azimuth, undecided, sine = estimate(total, delta, sensor["angle_estimator"])
    return {"leader": members[0]["key"], "members": {m["key"]: w for m, w in zip(members, weights)},
            "range_m": math.fsum(w * m["range_m"] for w, m in zip(weights, members)),
            "range_rate_mps": math.fsum(w * m["range_rate_mps"] for w, m in zip(weights, members)),
            "azimuth_rad": azimuth, "sign_undecided": undecided, "sine": sine, "amplitude": amplitude,
            "sum": total, "delta": delta}


def cluster(view, sensor):
    """Cells by MODEL 6. Leaders in the order: amplitude descending, range, range rate, azimuth, object,
    reflector."""
    remaining = []
    for key, echo in view.echoes.items():
        h_s, _ = pointers(echo["azimuth_rad"], sensor["phase_reference"])
        amplitude = reference_amplitude(sensor, echo["range_m"]) * abs(h_s) * echo["ercs"]
        remaining.append(dict(echo, key=key, amplitude=amplitude))
    remaining.sort(key=lambda m: (-m["amplitude"], m["range_m"], m["range_rate_mps"], m["azimuth_rad"], m["key"]))
    half_range, half_rate = half_cells(sensor)
    limit = first_threshold(sensor)
    while remaining:
        leader, rest = remaining[0], remaining[1:]
        if rest and close(rest[0]["amplitude"], leader["amplitude"], leader["amplitude"]):
            view.doubtful_cells = True
        members, others = [leader], []
        for m in rest:
            far = abs(m["range_m"] - leader["range_m"])
            fast = abs(m["range_rate_mps"] - leader["range_rate_mps"])
            view.doubtful_cells |= close(far, half_range) or close(fast, half_rate)
            (members if far <= half_range and fast <= half_rate else others).append(m)
        remaining = others
        amplitude = math.fsum(m["amplitude"] for m in members)
        view.doubtful_cells |= any(close(amplitude, one, one) for one in (limit, threshold(sensor)))
        if amplitude >= limit:
            view.cells.append(make_cell(sensor, members) | {"below_threshold": amplitude < threshold(sensor)})


def look(frame, vehicles, suite):
    bodies = [Body(item, vehicles[item["class"]]) for item in frame["objects"]]
    ego = next(body for body in bodies if body.id == frame["ego"])
    others = [body for body in bodies if body is not ego]
    blockers = [(body, body.outline()) for body in others if body.model.get("blocks", False)]
    views = {}
    for sensor in suite["sensors"]:
        view = View(sensor["name"])
        see(view, Radar(sensor, ego), others, blockers)
        cluster(view, sensor)
        views[sensor["name"]] = view
    return views
