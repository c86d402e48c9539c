"""One frame of a stream, seen from above: the objects, the targets, and the echoes that made them."""
import html

from glint.drawings.drawing import Drawing, draw_metres
from glint.drawings.played import View
from glint.drawings.stills import draw_bodies, draw_field_of_view, draw_labels, draw_list, draw_mark, lost_of

WIDTH, HEIGHT, HEAD, LINE = 960, 560, 40, 24  # pixels: the map, the title above it, a line of the key below it
# Losses by geometry, which are the rule.
USUAL = {"facing_away", "no_specular_point", "out_of_range", "out_of_view", "switched_off"}


def subjects(frame):
    """The ego and the objects that have targets, but for long ones, as walls are."""
    told = {part["object"] for target in frame["targets"] for part in target["contributors"]} | {frame["ego"]}
    return [item for item in frame["objects"] if item["id"] in told and item["length_m"] < 20]


def map_of(frame, view):
    """The map; the subjects and all targets are on it."""
    places = [view.reading(target) for target in frame["targets"]]
    for item in subjects(frame):
        places += view.contour(item)
    (left, right), (low, high) = [(min(axis) - 3, max(axis) + 3) for axis in zip(*places)]
    scale = min(40, WIDTH / (right - left), HEIGHT / (high - low))
    drawing = Drawing((WIDTH, HEIGHT), scale, (left + right - WIDTH / scale) / 2, (low + high + HEIGHT / scale) / 2)
    for name in view.sensors:
        draw_field_of_view(drawing, view, name)
    names = {item["id"]: "^" + html.escape(item["id"]) for item in subjects(frame)}
    names[frame["ego"]] = "ego" if scale > 8 else ""
    draw_bodies(drawing, frame, view, names)
    for echoes in lost_of(frame, *{group["reason"] for group in frame.get("lost", ())} - USUAL).values():
        if "range_m" in echoes[0]:
            drawing.cross(*drawing.at(view.polar(echoes[0]["sensor"], echoes[0]["range_m"], echoes[0].get("azimuth_rad", 0))))
    draw_labels(drawing, frame, view)
    draw_list(drawing, frame, view)
    draw_metres(drawing, 5 if scale > 12 else 20)
    return drawing


def key_of(frame, view):
    """What the marks mean: the words, and what draws each mark at a place of a drawing."""
    paths = {target["contributors"][0]["path"] for target in frame["targets"]}
    kinds = (("wall_object", "ghost", {path for path in paths if "wall" in path}), ("clutter", "clutter", {"clutter"} & paths),
             ("false_alarm", "false alarm", {"false_alarm"} & paths))
    speed = '<path class="rate-left" d="M{:.1f} {:.1f}h18"/>'
    return [*((f"target of {name}", lambda drawing, x, y, number=number: draw_mark(drawing, x, y, number, "direct", 9))
              for number, name in enumerate(view.sensors)),
            *((words, lambda drawing, x, y, path=path: draw_mark(drawing, x, y, 0, path, 9)) for path, words, found in kinds if found),
            ("its radial speed in 0.5 s", lambda drawing, x, y: drawing.add(speed.format(x - 9, y))),
            ("echo in a target", lambda drawing, x, y: drawing.circle(x, y, "centre", 3)),
            *([("echo in no target", Drawing.cross)] if "lost" in frame else [])]


def draw_key(drawing, entries):
    x, y = 20, HEAD + HEIGHT + LINE / 2
    for words, mark in entries:
        width = 34 + 8 * len(words)
        if x + width > WIDTH:
            x, y = 20, y + LINE
        mark(drawing, x, y)
        drawing.word(html.escape(words), x + 16, y + 5)
        x += width
    return y + LINE / 2


def draw_frame(frame, path):
    view = View(frame)
    sensors = " and ".join(view.sensors) or "no sensor"
    title = f'{frame["scene"]}, frame {frame["frame"]} at {frame["time_s"]:g} s: {len(frame["targets"])} targets of {sensors}'
    drawing = Drawing((WIDTH, HEAD + HEIGHT), 1, 0, 0)
    drawing.word(html.escape(title), 12, 26, "strong")
    drawing.put(map_of(frame, view), 0, HEAD)
    drawing.size = WIDTH, round(draw_key(drawing, key_of(frame, view)) + 6)
    drawing.save(path, html.escape(title))
