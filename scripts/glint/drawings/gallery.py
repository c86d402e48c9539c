"""Pictures of the gallery of pipelines: what a radar lists, and what stands there."""
import os

from glint.drawings.drawing import Drawing, draw_metres
from glint.drawings.played import View, as_measured
from glint.drawings.stills import HEAD, WIDTH, draw_bodies, draw_field_of_view, draw_key, draw_labels, draw_list
from glint.places import ROOT

TARGET_KEY = ("left", "target, and its radial speed", 225)
ECHO_KEY = ("centre", "echo in it", 0)
DOT, CROSS = "h3m0 1.8h-3", "m-3-3l6 6m0-6l-6 6"


def text_of(pipeline):
    with open(os.path.join(ROOT, "pipelines", pipeline + ".sh"), encoding="utf-8") as file:
        return file.read()


def draw_scan(bench, pipeline, number, x_range, y_range, names, way_s=0.5):
    """A frame of a pipeline with one sensor, seen from above, and its view."""
    frame = as_measured(bench.run(text_of(pipeline))[number])
    view = View(frame)
    scale = WIDTH / (x_range[1] - x_range[0])
    size = WIDTH, round(HEAD + scale * (y_range[1] - y_range[0]))
    drawing = Drawing(size, scale, x_range[0], y_range[1] + HEAD / scale)
    draw_field_of_view(drawing, view, "front")
    draw_bodies(drawing, frame, view, names)
    draw_labels(drawing, frame, view)
    draw_list(drawing, frame, view, way_s, 8)
    drawing.add(f'<rect class="paper" width="{WIDTH}" height="{HEAD}"/>')
    return drawing, frame, view


def finish(drawing, path, title, key, metres):
    drawing.word(title, 12, 22, "strong")
    draw_key(drawing, 20, 46, key)
    draw_metres(drawing, metres)
    drawing.save(path, title)


def target_of(frame, name):
    return next(t for t in frame["targets"] if (t["contributors"][0]["object"], t["contributors"][0]["path"]) == (name, "direct"))


def picture_array(bench, path):
    drawing, _, _ = draw_scan(bench, "array", 1, (-2, 22), (-5, 5.5), {})
    finish(drawing, path, "Sixteen elements: a target for each car", (TARGET_KEY, ECHO_KEY), 5)


def picture_shadows(bench, path):
    drawing, frame, view = draw_scan(bench, "shadows", 20, (22, 50), (-8, 5), {"truck": "truck", "car": "^car", "van": "van"})
    person = next(item for item in frame["objects"] if item["id"] == "person")
    drawing.cross(*drawing.at(view.world(person["x_m"], person["y_m"])))
    drawing.note(view.world(person["x_m"], person["y_m"]), ["a person", "behind the van"], 368, 234, "red")
    drawing.note(view.reading(target_of(frame, "truck")), ["seen above the car"], 300, 84)
    finish(drawing, path, "A truck above a car, nobody behind a van", (TARGET_KEY, ECHO_KEY), 5)


def picture_roadside(bench, path):
    drawing, _, _ = draw_scan(bench, "roadside", 60, (-6, 130), (-20, 18), {}, 0)
    finish(drawing, path, "Guardrails and bushes fill the list", (("left", "vehicle", 110), ("clutter", "roadside", 0)), 20)


def picture_ambiguity(bench, path):
    drawing, frame, view = draw_scan(bench, "ambiguity", 72, (-5, 55), (-8, 11), {}, 0.2)
    car = next(item for item in frame["objects"] if item["id"] == "oncoming_1")
    place = view.world(car["x_m"], car["y_m"])
    relative_mps = car["vx_mps"] - view.ego["vx_mps"]
    drawing.arrow((place[0], place[1] + 3.5), (place[0] + 0.2 * relative_mps, place[1] + 3.5))
    listed_mps = target_of(frame, "oncoming_1")["range_rate_mps"]
    drawing.word(f"true: {relative_mps:.0f} m/s".replace("-", "−"), *drawing.at((place[0] - 11, place[1] + 4.2)))
    drawing.word(f"listed: {listed_mps:+.0f} m/s", *drawing.at((place[0] - 3, place[1] - 4)), "blue")
    finish(drawing, path, "It comes closer and is listed as going away", (TARGET_KEY, ECHO_KEY), 10)


def listed(frames):
    """Where vehicles are listed: {(time, vehicle): range}."""
    return {(frame["time_s"], part["object"]): target["range_m"] for frame in frames for target in frame["targets"]
            for part in target["contributors"][:1] if part["path"] == "direct"}


def picture_rain(bench, path):
    wet, dry = (listed(bench.run(text_of("rain").replace("-interference", left_out)))
                for left_out in ("-interference", "-interference,-rain"))
    left, bottom, second, metre = 60, 250, 33, 1.0  # pixels: the axes, a second and a metre
    drawing = Drawing((WIDTH, 285), 1, 0, 0)
    for metres in range(0, 151, 50):
        drawing.line((left, metre * metres - bottom), (left + 12 * second, metre * metres - bottom), "pointer")
        drawing.word(f"{metres} m", left - 8, bottom - metre * metres + 5, "quiet", "end")
    for time_s in range(0, 13, 2):
        drawing.word(f"{time_s} s", left + time_s * second, bottom + 20, "quiet", "middle")
    for kind, mark, found in (("rate-left", DOT, wet), ("lost", CROSS, {key: dry[key] for key in dry.keys() - wet.keys()})):
        marks = "".join(f"M{left + time_s * second:.0f} {bottom - metre * range_m:.0f}{mark}"
                        for (time_s, _), range_m in sorted(found.items()))
        drawing.add(f'<path class="{kind}" d="{marks}"/>')
    drawing.word("the car ahead", left + 5, bottom - 37, "quiet")
    drawing.word("oncoming", left + 2.5 * second, bottom - 120, "quiet")
    drawing.word("Heavy rain takes far vehicles out of the list", 12, 22, "strong")
    drawing.add(f'<path class="rate-left" d="M14 41{DOT}"/><path class="lost" d="M150 41{CROSS}"/>')
    drawing.word("range in the list", 26, 46)
    drawing.word("in the list only without rain", 162, 46)
    drawing.save(path, "Ranges of listed vehicles over time, and of those that heavy rain hides")
