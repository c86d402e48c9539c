"""Figures 3, 7, 8, 11, 12 and 13 of the paper: the model, the sensor and the chain."""
import math
import statistics
from collections import Counter

from glint.drawings.drawing import Drawing, draw_metres
from glint.drawings.played import at_point, make_frame, outline, thing
from glint.drawings.stills import BEAM_RAD, WIDTH

# Letters around the car as in figure 3; which letter is which point is our choice.
LETTERS = {"corner_fl": "A", "wheel_fl": "B", "wheel_rl": "C", "corner_rl": "D",
           "corner_rr": "E", "wheel_rr": "F", "wheel_fr": "G", "corner_fr": "H"}


def seen_from(ego, echo):
    """The place of an echo in the world, and the direction in which it sees the sensor."""
    bearing = ego["yaw_rad"] + echo["azimuth_rad"]
    place = (ego["x_m"] + echo["range_m"] * math.cos(bearing),
             ego["y_m"] + echo["range_m"] * math.sin(bearing))
    return place, math.remainder(bearing + math.pi, 2 * math.pi)


def sweep_around_car(bench, distance_m):
    """The cross section of every point of a car by direction, from a sensor led around it."""
    frames = []
    for degree in range(0, 360, 2):
        angle = math.radians(degree)
        ego = thing("ego", "car", distance_m * math.cos(angle), distance_m * math.sin(angle),
                    math.remainder(angle + math.pi, 2 * math.pi))
        frames.append(make_frame(degree, [ego, thing("car", "car", 0, 0)]))
    seen = {}
    for frame in bench.run("glint-extract frames.jsonl | glint-ideal --sensors probe", frames):
        for echo in frame["echoes"]:
            if echo["reflector"] in LETTERS:
                place, direction = seen_from(frame["objects"][0], echo)
                fan = seen.setdefault(echo["reflector"], (place, []))[1]
                fan.append((direction, echo["ercs"]))
    return frame["objects"][1], seen


def fan_outline(place, fan, scale_m):
    """The polar curve of cross section over direction around a place, closed at the place."""
    middle = math.atan2(sum(e * math.sin(a) for a, e in fan), sum(e * math.cos(a) for a, e in fan))
    turned = sorted((math.remainder(a - middle, 2 * math.pi) + middle, e) for a, e in fan)
    curve = [(place[0] + scale_m * e * math.cos(a), place[1] + scale_m * e * math.sin(a))
             for a, e in turned]
    return [place, *curve], middle


def figure_3(bench, path):
    car, seen = sweep_around_car(bench, 20)
    drawing = Drawing((WIDTH, 346), WIDTH / 7, -3.5, 2.55)
    drawing.polygon(list(outline(car))[:4], "body")
    for name, (place, fan) in sorted(seen.items()):
        curve, middle = fan_outline(place, fan, 2.0)
        drawing.polygon(curve, "blue fan rate-left" if name.startswith("corner") else "orange fan rate-right")
        drawing.circle(*drawing.at(place), "centre", 3)
        x, y = drawing.at((place[0] - 0.3 * math.cos(middle), place[1] - 0.3 * math.sin(middle)))
        drawing.word(LETTERS[name], x, y + 5, anchor="middle")
    drawing.word("Eight points, and from where each is seen", 12, 22, "strong")
    draw_metres(drawing, 1)
    drawing.save(path, "A car as eight reflection centres, each seen from a range of angles")


def figure_7(bench, path):
    bench.write("vehicles", "screen", {
        "origin": "scripts/figures", "length_m": 1.2, "width_m": 0.3, "height_m": 1,
        "reflectors": {"blocks": True}})
    sensors = [(-0.2, -4.6, math.pi / 2), (5.4, -4.2, 2.6)]
    others = [thing("car", "car", 0, 0), thing("screen", "screen", 2.7, -3.0, 1.0)]
    frames = bench.run(
        "glint-extract frames.jsonl | glint-ideal --sensors probe --sections account",
        [make_frame(i, [thing("ego", "car", *pose), *others]) for i, pose in enumerate(sensors)])
    drawing = Drawing((WIDTH, 318), 48, -2.8, 1.2)
    boxes = [list(outline(o))[:4] for o in frames[0]["objects"] if o["id"] != "ego"]
    for box in boxes:
        drawing.polygon(box, "body")
    drawing.line(*boxes[0][2:4], "plane")
    places = {}
    for number, (frame, kind, colour) in enumerate(zip(frames, ("rate-left", "rate-right"), ("blue", "orange")), 1):
        draw_evaluation(drawing, frame, kind, places)
        x, y = drawing.at(sensors[number - 1][:2])
        drawing.add(f'<path class="{colour}" d="M{x:.1f} {y - 9:.1f}l8 14h-16z"/>')
        drawing.word(f"sensor at position {number}", x, y + 24, colour, "middle")
    for name, place in places.items():
        draw_reflector(drawing, *drawing.at(place), name == "right")
    drawing.word("no reflection point", *drawing.at((5.5, -0.62)), "orange", "middle")
    drawing.word("blocked", *drawing.at((2.15, -3.45)), "orange", "end")
    for letter, name, aside in (("A", "corner_rr", 0.2), ("B", "wheel_rr", 0), ("C", "wheel_fr", 0), ("D", "corner_fr", -0.2)):
        drawing.word(letter, *drawing.at((places[name][0] + aside, places[name][1] + 0.2)), anchor="middle")
    drawing.line((2.75, 0.85), (2.95, 0.85), "plane")
    draw_reflector(drawing, *drawing.at((2.85, 0.43)), True)
    draw_reflector(drawing, *drawing.at((2.85, 0.01)), False)
    for line, text in enumerate(("plane reflector", "its reflection point", "point centre")):
        x, y = drawing.at((3.1, 0.85 - 0.42 * line))
        drawing.word(text, x, y + 5)
    drawing.save(path, "What two sensors see of a car's side")


def draw_reflector(drawing, x, y, of_plane):
    if of_plane:
        drawing.add(f'<path class="green" d="M{x:.1f} {y - 7:.1f}l7 7l-7 7l-7-7z"/>')
    else:
        drawing.circle(x, y, "centre", 4)


def draw_evaluation(drawing, frame, kind, places):
    """What a sensor sees (lines) and what it does not (dashes), by glint's own account. places
    holds where reflectors are, as far as one of the sensors has seen them."""
    ego = next(o for o in frame["objects"] if o["id"] == "ego")
    at = ego["x_m"], ego["y_m"]
    for echo in frame["echoes"]:
        places[echo["reflector"]] = seen_from(ego, echo)[0]
        drawing.line(at, places[echo["reflector"]], kind)
    for group in frame["lost"]:
        for lost in group["echoes"]:
            if group["reason"] == "blocked":
                drawing.line(at, places[lost["reflector"]], kind + " edge")
            elif lost["reflector"] == "right":
                drawing.line(at, (at[0], places["right"][1]), kind + " edge")


# --- the sensor --------------------------------------------------------------------------------

def figure_8(bench, path):
    bench.write_point("point", 0.5)
    frames = bench.run("glint-extract frames.jsonl | glint-ideal --sensors probe | glint-sensor"
                       " | glint-noise", [at_point(i, "point", 12.55, 0) for i in range(1000)])
    readings = [t["range_m"] for frame in frames for t in frame["targets"]]
    mean, sigma = statistics.fmean(readings), statistics.stdev(readings)
    bins = Counter(math.floor(100 * reading) for reading in readings)
    left, bottom, step = 60, 290, 28  # pixels: the axes, and a centimetre; a hit is one pixel
    drawing = Drawing((WIDTH, 340), 1, 0, 0)
    for hits in range(0, 251, 50):
        drawing.line((left, hits - bottom), (left + 14 * step, hits - bottom), "pointer")
        drawing.word(f"{hits}", left - 8, bottom - hits + 5, "quiet", "end")
    for centimetre in range(1248, 1263, 2):
        drawing.word(f"{centimetre / 100:.2f}", left + (centimetre - 1248) * step, bottom + 20, "quiet", "middle")
    for centimetre, hits in bins.items():
        drawing.add(f'<rect class="blue" x="{left + (centimetre - 1248) * step + 1}" y="{bottom - hits}" '
                    f'width="{step - 2}" height="{hits}"/>')
    drawing.word(f"{len(readings)} readings: {mean:.3f} m ± {100 * sigma:.1f} cm", 12, 22, "strong")
    drawing.word("hits by distance [m]", left + 7 * step, bottom + 42, anchor="middle")
    drawing.save(path, "Noise of the measured range of a fixed target")


def figure_11(bench, path):
    bench.write_point("point", 0.5)
    angles = range(-89, 90)
    frames = bench.run("glint-extract frames.jsonl | glint-ideal --sensors probe"
                       " | glint-sensor-perfect",
                       [at_point(i, "point", 10, math.radians(a)) for i, a in enumerate(angles)])
    cells = [frame["cells"][0] for frame in frames]
    full = max(math.hypot(c["sum_re"], c["sum_im"]) for c in cells)
    drawing = Drawing((WIDTH, 246), WIDTH / 102, -51, 47)  # a decibel is a metre here
    draw_polar_grid(drawing)
    for channel, kind, colour, y in (("sum", "rate-left", "blue", 24), ("delta", "rate-right", "orange", 46)):
        levels = [math.hypot(cell[channel + "_re"], cell[channel + "_im"]) / full for cell in cells]
        drawing.curve([place_polar(max(0.0, 40 + 20 * math.log10(max(level, 1e-9))), angle)
                       for angle, level in zip(angles, levels)], kind)
        drawing.word(channel, 20, y, colour)
    drawing.save(path, "Sum and delta channel over azimuth")


def place_polar(radius, degree):
    """Straight ahead is up, and left is left."""
    return -radius * math.sin(math.radians(degree)), radius * math.cos(math.radians(degree))


def draw_polar_grid(drawing):
    for radius in (10, 20, 30, 40):
        drawing.curve([place_polar(radius, a) for a in range(-90, 91, 2)], "pointer")
    for degree in (-90, -60, -30, 0, 30, 60, 90):
        drawing.line((0, 0), place_polar(40, degree), "pointer")
        x, y = place_polar(41.5, degree)
        drawing.word(f"{degree}°".replace("-", "−"), *drawing.at((x, max(y, 0.5))),
                     anchor="start" if degree < 0 else "end" if degree > 0 else "middle")
    for level in (0, -20):
        drawing.word(f"{level} dB".replace("-", "−"), *drawing.at((40 + level, -4)), "quiet", "middle")


def border_of_visibility(bench, points, rounds=18):
    """The greatest range at which glint-sensor still makes a cell, by bisection, for every
    (class, azimuth)."""
    near, far = [0.2] * len(points), [30.0] * len(points)
    for _ in range(rounds):
        middle = [(a + b) / 2 for a, b in zip(near, far)]
        frames = bench.run(
            "glint-extract frames.jsonl | glint-ideal --sensors probe | glint-sensor",
            [at_point(i, kind, r, azimuth)
             for i, ((kind, azimuth), r) in enumerate(zip(points, middle))])
        for i, frame in enumerate(frames):
            (near if frame.get("cells") else far)[i] = middle[i]
    return near


def figure_12(bench, path):
    classes = [(f"point{tenths}", tenths / 10) for tenths in range(8, 1, -1)]
    for name, ercs in classes:
        bench.write_point(name, ercs)
    azimuths = [math.radians(a) for a in range(-88, 89, 2)]
    ranges = iter(border_of_visibility(bench, [(name, azimuth) for name, _ in classes for azimuth in azimuths]))
    drawing = Drawing((WIDTH, 410), WIDTH / 33, -0.5, 14.8)
    for _, ercs in classes:
        curve = [(r * math.cos(a), r * math.sin(a)) for a, r in zip(azimuths, ranges)]
        drawing.curve([(0, 0), *curve, (0, 0)], "rate-left")
        x, y = drawing.at((max(x for x, _ in curve), 0))
        drawing.word(f"{ercs}", x + 3, y + 5, "blue")
    drawing.word("ERCS", *drawing.at((14.4, -0.35)), "blue", "end")
    for side in (-1, 1):
        drawing.line((0, 0), (22 * math.cos(BEAM_RAD), side * 22 * math.sin(BEAM_RAD)), "pointer edge")
    drawing.word("Where a reflector is detected, by ERCS", 12, 22, "strong")
    draw_metres(drawing, 5)
    drawing.save(path, "Where a reflector is detected, by its cross section")


# --- the chain ---------------------------------------------------------------------------------

def count_along_chain(bench):
    """What one scan of the left sensor makes of the intersection, stage by stage."""
    frames = bench.run("glint-traffic intersection | glint-extract"
                       " | glint-ideal --sensors srr24-pair --sections account,echoes,cells"
                       " | glint-sensor | glint-noise")
    frame = min(frames, key=lambda f: abs(f["time_s"] - 2.36))

    def of_left(part):
        return len([item for item in frame[part] if item["sensor"] == "left"])
    pairs = next(c["pairs"] for c in frame["counts"] if c["sensor"] == "left")
    return (len(frame["objects"]), pairs, of_left("echoes"), of_left("cells"), of_left("targets"))


def figure_13(bench, path):
    objects, pairs, echoes, cells, targets = count_along_chain(bench)
    steps = (("traffic simulation", "", f"{objects} objects"),
             ("vehicle model extraction", "glint-extract", f"{pairs} reflection centres"),
             ("ideal target list", "glint-ideal", f"{echoes} echoes"),
             ("resolution, threshold, pointers", "glint-sensor", f"{cells} cells"),
             ("noise, angle, final threshold", "glint-noise", f"{targets} targets"))
    drawing = Drawing((WIDTH, 402), 1, 0, 0)
    for number, (name, tool, made) in enumerate(steps):
        top = 10 + 78 * number
        for left, width in ((10, 220), (250, 220)) if number == 0 else ((10, 460),):
            drawing.add(f'<rect class="body" x="{left}" y="{top}" width="{width}" height="44"/>')
        for x in (110, 360) if number == 0 else (110,):
            drawing.arrow((x, -top - 44), (x, -top - 76))
        drawing.word(name, 26, top + 27)
        drawing.word(tool, 454, top + 27, "blue", "end")
        drawing.word(made, 126, top + 66, "orange")
    drawing.word("traffic scene database", 266, 37)
    drawing.word("glint-traffic", 346, 76, "blue", "end")
    drawing.save(path, "The chain of programs, and what passes along it in one scan")
