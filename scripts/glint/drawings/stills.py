"""Stills seen from above: the pages' pictures, and figures 1, 2, 4, 10 and 14 of the paper."""
import math

from glint.drawings.drawing import Drawing, draw_metres
from glint.drawings.played import View, as_measured

WIDTH, HEAD = 480, 58  # pixels of a figure, and of the title and the key at its top
BEAM_RAD = math.radians(35)
SENSORS_KEY = (("left", "left sensor", 124), ("right", "right sensor", 134), ("centre", "reflection centre", 0))


def draw_bodies(drawing, frame, view, names):
    """Boxes, with the names that some of them have; one that begins with ^ or _ stands above or
    below its box."""
    for item in frame["objects"]:
        long = item["length_m"] > 40 * item["width_m"]
        drawing.polygon(list(view.contour(item))[:4],
                        "ego" if item["id"] == frame["ego"] else "rail" if long else "body")
        if item["id"] in names:
            name = names[item["id"]]
            x, y = drawing.at(view.world(item["x_m"], item["y_m"]))
            beside = drawing.scale * item["width_m"] / 2 + 18
            y += {"^": -beside, "_": beside}.get(name[:1], 0)
            drawing.word(name.strip("^_"), x, y + 5, "white" if item["id"] == frame["ego"] else "quiet", "middle")


def draw_field_of_view(drawing, view, name):
    """Where the sensor lists targets: its field of view, as far as its greatest range."""
    sensor = view.sensors[name]
    side_rad = sensor["field_of_view_rad"] / 2
    arc = [view.polar(name, sensor["range_max_m"], side_rad * step / 60) for step in range(-60, 61)]
    drawing.polygon([view.mount(name), *arc], "beam")


def draw_labels(drawing, frame, view):
    """Lines from each target to the echoes that made it, which are dots."""
    for target in frame["targets"]:
        for part in target["contributors"]:
            place = view.polar(target["sensor"], part["range_m"], part["azimuth_rad"])
            drawing.line(view.reading(target), place, "merged")
            drawing.circle(*drawing.at(place), "centre", 3)


def draw_mark(drawing, x, y, sensor, path, size=10):
    """A target of the sensor with this number: stars of the first, circles of the second, squares and triangles of the
    next, in two colours. Ghosts are hollow, clutter is three dots, a false alarm a cross of thin beams."""
    side = ("left", "right")[sensor % 2]
    kind = "ghost" if "wall" in path else side
    if path == "clutter":
        for dx, dy in ((0, -0.4), (-0.45, 0.35), (0.45, 0.35)):
            drawing.circle(x + dx * size, y + dy * size, {"left": "blue", "right": "orange"}[side], 0.3 * size)
    elif path == "false_alarm":
        drawing.star(x, y, side, size, 6, 0.2)
    elif sensor % 4 == 1:
        drawing.circle(x, y, kind, 0.7 * size)
    else:
        tips, inner = {0: (5, 0.42), 2: (4, 0.71), 3: (3, 0.5)}[sensor % 4]
        drawing.star(x, y, kind, size, tips, inner)


def draw_list(drawing, frame, view, way_s=0.5, size=10):
    """The targets, each with its radial speed."""
    numbers = {name: number for number, name in enumerate(view.sensors)}
    for target in frame["targets"]:
        number = numbers[target["sensor"]]
        drawing.line(*view.speed_line(target, way_s), ("rate-left", "rate-right")[number % 2])
        draw_mark(drawing, *drawing.at(view.reading(target)), number, target["contributors"][0]["path"], size)


def lost_of(frame, *reasons):
    """Echoes that are in no target of any sensor, by object and reflector, with what is told."""
    seen = {(part["object"], part["reflector"]) for t in frame["targets"] for part in t["contributors"]}
    found = {}
    for group in frame["lost"]:
        for echo in group["echoes"]:
            key = (echo["object"], echo["reflector"])
            if group["reason"] in reasons and key not in seen:
                found.setdefault(key, []).append(echo | {"reason": group["reason"], "sensor": group["sensor"]})
    return found


def draw_names(drawing, frame, view, names):
    """Words at objects, so many metres before or behind their middle."""
    for item in frame["objects"]:
        if item["id"] in names:
            name, ahead_m = names[item["id"]]
            ahead, left = view.world(item["x_m"], item["y_m"])
            x, y = drawing.at((ahead + ahead_m, left))
            drawing.word(name, x, y + 5, "quiet halo", "middle")


def draw_notes(drawing, frame, view, lost):
    """What became of three echoes of the cut-in: one target of several, one echo too weak, one hidden."""
    merged = next(t for t in frame["targets"] if t["contributors"][0]["object"] == "cutter")
    shares = [f"{part['reflector']} {100 * part['weight']:.0f} %" for part in merged["contributors"]]
    weak, hidden = lost["slow_1", "corner_rr"], lost["rail_left", "post_67"]
    shortfall_db = min(echo["shortfall_db"] for echo in weak)
    for echoes, lines, y in ((weak, [f"{shortfall_db:.1f} dB too weak", "the truck's other corner"], 40),
                             (hidden, ["hidden by the overtaker", "a post of the guardrail"], 232)):
        place = view.polar(echoes[0]["sensor"], echoes[0]["range_m"], echoes[0]["azimuth_rad"])
        drawing.note(place, lines, 234, y, "red")
    drawing.note(view.reading(merged), [f"{len(shares)} echoes, 1 target:", ", ".join(shares[:2]) + ",",
                                        f"{shares[2]}, in one cell"], 234, 134)


def picture_echoes(bench, path):
    """The cut-in: what stands there, what two radars report of it, and what the account knows besides."""
    frame = bench.still("cut-in", 5.4)
    view, lost = View(frame), lost_of(frame, "below_threshold", "blocked")
    told = {part["object"] for target in frame["targets"] for part in target["contributors"]}
    there, listed, known = (Drawing((width, 352), 13.8, -7.3, 21.6, upright=True) for width in (240, 240, 432))
    for panel in (there, listed, known):
        panel.add('<rect class="panel" width="100%" height="100%"/>')
    for panel in (there, known):
        for lane in (1.875, -1.875, -5.625):
            panel.line((-4, lane), (22, lane), "road")
        draw_bodies(panel, frame, view, {})
    draw_bodies(listed, frame | {"objects": [view.ego]}, view, {})
    draw_names(there, frame, view, {"cutter": ("cuts in", 3), "overtaker": ("overtakes", 3), "slow_1": ("truck", -4.4), "ego": ("ego", 3)})
    draw_list(listed, frame, view, size=8)
    crosses = [known.at(view.polar(echo["sensor"], echo["range_m"], echo["azimuth_rad"])) for echo, *_ in lost.values()]
    crosses = [place for place in crosses if 0 <= place[1] <= known.size[1]]
    for place in crosses:
        known.cross(*place)
    draw_list(known, frame, view, 0, 8)
    draw_labels(known, frame, view)
    draw_notes(known, frame, view, lost)
    draw_metres(known, 5, 234)
    drawing = Drawing((960, 472), 1, 0, 0)
    drawing.add('<text x="12" y="28" font-size="22" class="strong">A radar reports echoes, not cars. glint says whose they are.</text>')
    for number, (panel, x, head, below) in enumerate((
            (there, 12, "What is there", f"{len(told)} vehicles between two guardrails"),
            (listed, 264, "What a tracker gets", f"{len(frame['targets'])} targets without names"),
            (known, 516, "What only a simulation knows", f"the echoes of each target, and why {len(crosses)} others are in none")), 1):
        drawing.word(f"{number}  {head}", x, 60, "strong")
        drawing.word(below, x, 79, "quiet")
        drawing.put(panel, x, 88)
    draw_key(drawing, 20, 462, (("left", "target of the left radar", 204), ("right", "of the right one", 152),
                                ("line", "its radial speed in 0.5 s", 204), ("centre", "echo in a target", 150),
                                ("lost", "echo in none", 0)))
    drawing.save(path, "A scene, the targets that two radars list of it, and the echoes that made each target")


def picture_ghosts(bench, path):
    """Mirror ghosts of an oncoming car, and the way that the waves of the farthest one took."""
    frame = as_measured(bench.run("glint-traffic walled-road | glint-extract | glint-ideal --sensors lrr77-full"
                                  " | glint-sensor | glint-noise")[60])
    view = View(frame)
    drawing = Drawing((960, 488), 9.9, -7, 21)
    draw_field_of_view(drawing, view, "front")
    wall = next(item for item in frame["objects"] if item["id"] == "wall")
    twin = next(t for t in frame["targets"] if t["contributors"][0]["path"] == "wall_object_wall")
    part = twin["contributors"][0]
    image = view.polar("front", part["range_m"], part["azimuth_rad"])
    share = (wall["y_m"] - wall["width_m"] / 2) / image[1]
    foot = (view.mount("front")[0] + share * (image[0] - view.mount("front")[0]), share * image[1])
    real = (image[0], 2 * foot[1] - image[1])
    near = Drawing((340, 256), 27, image[0] - 5, image[1] + 2.6)
    for canvas in (drawing, near):
        draw_bodies(canvas, frame, view, {"ego": "ego", "van": "van"} if canvas is drawing else {"oncoming_1": "_oncoming car"})
        for start, end in ((view.mount("front"), foot), (foot, real)):
            canvas.line(start, end, "path")
        canvas.line(foot, image, "merged")
        draw_labels(canvas, frame, view)
        draw_list(canvas, frame, view, size=9)
    drawing.inset(near, 590, 218)
    drawing.note(view.reading(twin), ["a twin behind the wall", "radar, wall, car, wall, radar"],
                 820, 62, anchor="end")
    one_way = ("object_wall", "wall_object")  # either leads: their echoes are alike
    both = next(t for t in frame["targets"] if t["contributors"][0]["path"] in one_way)
    drawing.note(view.reading(both), ["by the wall one way only", f"{len(both['contributors'])} echoes, 1 target"],
                 600, 108, anchor="end")
    draw_key(drawing, 20, 24, (("left", "target; its line: radial speed", 240), ("ghost", "ghost: a target seen in the wall", 0)))
    draw_metres(drawing, 10)
    drawing.save(path, "Mirror ghosts of an oncoming car beside a wall, and the way of the waves")


def draw_key(drawing, x, y, entries):
    """A row of marks with their names, each as wide as its entry says."""
    for mark, name, width in entries:
        if mark == "lost":
            drawing.cross(x, y - 5)
        elif mark in ("right", "centre"):
            drawing.circle(x, y - 5, mark, 6.3 if mark == "right" else 3)
        elif mark == "line":
            drawing.add(f'<path class="rate-left" d="M{x - 8:.1f} {y - 5:.1f}h18"/>')
        elif mark == "clutter":
            draw_mark(drawing, x, y - 5, 0, mark, 9)
        else:
            drawing.star(x, y - 5, mark, 9)
        drawing.word(name, x + 14, y)
        x += width


# --- the paper's figures ------------------------------------------------------------------------

def draw_scan(frame, scale, x_range, y_range, title, way_s=0.5, extra=None):
    """One scan with its title; of marks, room is left for the key."""
    size = [scale * (high - low) for low, high in (x_range, y_range)]
    drawing = Drawing((round(size[0]), HEAD + round(size[1])), scale, x_range[0], y_range[1] + HEAD / scale)
    view = View(frame)
    for name in ("left", "right"):
        for side in (-1, 1):
            drawing.line(view.mount(name), view.polar(name, 60, side * BEAM_RAD), f"rate-{name} edge")
    draw_bodies(drawing, frame, view, {})
    if extra is not None:
        extra(drawing, view)
    draw_labels(drawing, frame, view)
    draw_list(drawing, frame, view, way_s, 9)
    drawing.add(f'<rect class="paper" width="{drawing.size[0]}" height="{HEAD}"/>')
    drawing.word(title, 12, 22, "strong")
    draw_metres(drawing, 5)
    return drawing


def still(path, frame, x_range, y_range, title, extra=None):
    drawing = draw_scan(frame, WIDTH / (x_range[1] - x_range[0]), x_range, y_range, title, extra=extra)
    draw_key(drawing, 20, 48, SENSORS_KEY)
    drawing.save(path, title)


def still_of(scenario, time_s, *view):
    """What draws a still of a scenario at a time, by the ranges of places and the title."""
    return lambda bench, path: still(path, bench.still(scenario, time_s), *view)


figure_1 = still_of("corner-approach", 3.36, (-2, 17), (-5, 5), "At 11 m the corner alone answers")
figure_2 = still_of("corner-approach", 4.64, (-2, 12), (-4.5, 3), "At 5 m the wheel houses answer, too")
figure_10 = still_of("two-vehicles", 0.04, (-2, 22), (-5, 5), "Two cars, one target in the middle")


def figure_4(bench, path):
    frame = bench.still("side-crossing", 2.4)
    car = next(o for o in frame["objects"] if o["id"] == "car")

    def motion(drawing, view):
        """The car's way in half a second, and the sight lines to its mirroring side."""
        half_s = [car[place] + car[speed] / 2 for place, speed in (("x_m", "vx_mps"), ("y_m", "vy_mps"))]
        drawing.arrow(view.world(car["x_m"], car["y_m"]), view.world(*half_s))
        for target in frame["targets"]:
            for part in target["contributors"]:
                if part["reflector"] == "left":
                    drawing.line(view.mount(target["sensor"]),
                                 view.polar(target["sensor"], part["range_m"], part["azimuth_rad"]), "pointer")
    still(path, frame, (-2, 12), (-4, 4), "The side mirrors: straight ahead, at zero speed", motion)


def figure_14(bench, path):
    scans = []
    for title, sensor, noise in (("(a) ideal", "glint-sensor-perfect", "glint-noise-none"),
                                 ("(b) without noise", "glint-sensor", "glint-noise-none"),
                                 ("(c) as reported", "glint-sensor", "glint-noise")):
        frame = bench.still("cut-in", 5.4, sensor, noise)
        scans.append(draw_scan(frame, 10, (-2, 28), (-13, 9), f'{title}: {len(frame["targets"])} targets', 0.2))
    drawing = Drawing((3 * scans[0].size[0] + 24, scans[0].size[1]), 1, 0, 0)
    for number, scan in enumerate(scans):
        drawing.put(scan, number * (scan.size[0] + 12), 0)
    draw_key(drawing, 20, 48, SENSORS_KEY)
    drawing.save(path, "A cut-in as an ideal list, with the sensor's resolution, and with noise")
