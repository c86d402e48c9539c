"""Stills seen from above: the pages' pictures, and figures 1, 2, 4, 10 and 14 of the paper."""
import math

from drawing import Drawing, draw_metres
from played import View

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
            y += {"^": -beside, "_": beside}.get(name[0], 0)
            drawing.word(name.strip("^_"), x, y + 5, "white" if item["id"] == frame["ego"] else "quiet", "middle")


def draw_field_of_view(drawing, view, name):
    """Where the sensor lists targets: its field of view, as far as its greatest range."""
    sensor = view.sensors[name]
    side_rad = sensor["field_of_view_rad"] / 2
    arc = [view.polar(name, sensor["range_max_m"], side_rad * step / 60) for step in range(-60, 61)]
    drawing.polygon([view.mount(name), *arc], "beam")


def draw_cell(drawing, view, target):
    """The range cell in which the echoes of a target add up, as far as they reach in azimuth."""
    half = view.sensors[target["sensor"]]["cell_range_m"] / 2
    azimuths = sorted(part["azimuth_rad"] for part in target["contributors"])
    low, high = azimuths[0] - 0.02, azimuths[-1] + 0.02
    steps = [low + (high - low) * i / 12 for i in range(13)]
    middle = target["contributors"][0]["range_m"]
    drawing.polygon([view.polar(target["sensor"], middle - half, a) for a in steps]
                    + [view.polar(target["sensor"], middle + half, a) for a in reversed(steps)], "cell")


def draw_labels(drawing, frame, view):
    """Lines from each target to the echoes that made it, which are dots."""
    for target in frame["targets"]:
        for part in target["contributors"]:
            place = view.polar(target["sensor"], part["range_m"], part["azimuth_rad"])
            drawing.line(view.reading(target), place, "merged")
            drawing.circle(*drawing.at(place), "centre", 3)


def draw_list(drawing, frame, view, way_s=0.5, size=10):
    """Circles of the right sensor, stars of any other, ghosts hollow, each with its radial speed."""
    for target in frame["targets"]:
        right, ghost = target["sensor"] == "right", "wall" in target["contributors"][0]["path"]
        drawing.line(*view.speed_line(target, way_s), "rate-right" if right else "rate-left")
        if right:
            drawing.circle(*drawing.at(view.reading(target)), "right", 0.7 * size)
        else:
            drawing.star(*drawing.at(view.reading(target)), "ghost" if ghost else "left", size)


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


CUT_IN = {"ego": "ego", "cutter": "_car that cuts in", "overtaker": "^overtaking car", "slow_1": "truck"}


def picture_hero(bench, path):
    """The cut-in: what stands there, what two radars report of it, and what became of the rest."""
    frame = bench.still("cut-in", 5.4)
    view = View(frame)
    lost = lost_of(frame, "below_threshold", "blocked")
    places = {key: view.polar(echo["sensor"], echo["range_m"], echo["azimuth_rad"])
              for key, (echo, *_) in lost.items()}
    drawing = Drawing((960, 556), 27, -6, 10.6)
    for lane in (1.875, -1.875, -5.625):
        drawing.line((-6, lane), (30, lane), "road")
    for name in ("left", "right"):
        draw_field_of_view(drawing, view, name)
    draw_bodies(drawing, frame, view, CUT_IN)
    for place in places.values():
        drawing.cross(*drawing.at(place))
    merged = next(t for t in frame["targets"] if t["contributors"][0]["object"] == "cutter")
    draw_cell(drawing, view, merged)
    draw_labels(drawing, frame, view)
    draw_list(drawing, frame, view)
    for key, what, y in ((("rail_left", "post_67"), "a post of the guardrail", 106),
                         (("slow_1", "corner_rr"), "the truck's other corner", 428)):
        drawing.note(places[key], [because(lost[key]), what], 690, y + 27, "red")
    shares = [f"{part['reflector']} {100 * part['weight']:.0f} %" for part in merged["contributors"]]
    drawing.note(view.reading(merged), [f"{len(shares)} echoes, 1 target", ", ".join(shares[:2]) + ",",
                                        f"{shares[2]}: one cell of range"], 690, 250)
    told = {(part["object"], part["reflector"]) for t in frame["targets"] for part in t["contributors"]}
    drawing.add(f'<rect class="paper" width="{drawing.size[0]}" height="64"/>')
    draw_key(drawing, 20, 50, (("left", "target of the left radar", 206), ("right", "of the right one; its line: radial speed", 302),
                               ("centre", "echo in a target", 144), ("lost", "echo in no target", 0)))
    drawing.word(f"A car cuts in: two radars report {len(frame['targets'])} targets of {len({name for name, _ in told})}"
                 f" vehicles; {len(lost)} echoes are hidden or too weak", 12, 24, "strong")
    draw_metres(drawing, 5)
    front = view.sensors["left"]
    drawing.word(f"shaded: field of view, {math.degrees(front['field_of_view_rad']):.0f}° to {front['range_max_m']} m",
                 948, 546, "quiet", "end")
    drawing.save(path)


def because(echoes):
    """Why an echo is in no target, of any sensor."""
    if echoes[0]["reason"] == "blocked":
        return "hidden by the " + CUT_IN[echoes[0]["by"]].lstrip("^")
    return f"{min(echo['shortfall_db'] for echo in echoes):.1f} dB too weak"


WALLED = {"ego": "ego", "van": "van"}


def picture_ghosts(bench, path):
    """Mirror ghosts of an oncoming car, and the way that the waves of the farthest one took."""
    frame = bench.run("glint-traffic walled-road | glint-extract | glint-ideal --sensors lrr77-full"
                      " | glint-sensor | glint-noise")[60]
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
        draw_bodies(canvas, frame, view, WALLED if canvas is drawing else {"oncoming_1": "_oncoming car"})
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
    drawing.save(path)


def draw_key(drawing, x, y, entries):
    """A row of marks with their names, each as wide as its entry says."""
    for mark, name, width in entries:
        if mark == "lost":
            drawing.cross(x, y - 5)
        elif mark in ("right", "centre"):
            drawing.circle(x, y - 5, mark, 6.3 if mark == "right" else 3)
        else:
            drawing.star(x, y - 5, mark, 9)
        drawing.word(name, x + 14, y)
        x += width


# --- the paper's figures ------------------------------------------------------------------------

def draw_beams(drawing, view):
    """The edges of the sensors' beams."""
    for name in ("left", "right"):
        for side in (-1, 1):
            drawing.line(view.mount(name), view.polar(name, 60, side * BEAM_RAD), f"rate-{name} edge")


def draw_scan(frame, scale, x_range, y_range, title, way_s=0.5, extra=None):
    """One scan with its title; of marks, room is left for the key."""
    size = [scale * (high - low) for low, high in (x_range, y_range)]
    drawing = Drawing((round(size[0]), HEAD + round(size[1])), scale, x_range[0], y_range[1] + HEAD / scale)
    view = View(frame)
    draw_beams(drawing, view)
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
    drawing.save(path)


def figure_1(bench, path):
    still(path, bench.still("corner-approach", 3.36), (-2, 17), (-5, 5), "At 11 m the corner alone answers")


def figure_2(bench, path):
    still(path, bench.still("corner-approach", 4.64), (-2, 12), (-4.5, 3), "At 5 m the wheel houses answer, too")


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


def figure_10(bench, path):
    still(path, bench.still("two-vehicles", 0.04), (-2, 22), (-5, 5), "Two cars, one target in the middle")


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
    drawing.save(path)
