"""The diagrams of scripts/accuracy-cost, by gnuplot."""
import math
import os
import subprocess
import textwrap

import scores
from scores import pick

BLUE, ORANGE, GREY, INK = "#0072b2", "#d55e00", "#999999", "#333333"
LEAST = 1e-9  # where exactly nothing is drawn

# Series of the models, how they are drawn, what the legend calls them.
MODELS = [("front", f'with steps lw 2 lc rgb "{ORANGE}"', "Pareto front"),
          ("effects", f'with points pt 6 ps 0.5 lc rgb "{GREY}"', "the paper and one effect"),
          ("contour", f'with points pt 8 ps 0.9 lc rgb "{GREY}"', "against the contour's signal"),
          ("main", f'with points pt 7 ps 0.9 lc rgb "{BLUE}"', "against the same centres' signal")]


def block(name, rows, x, y, least=0):
    text = "\n".join(f'{row[x]:.6g} {max(row[y], least):.6g} "{row["way"]}"' for row in rows)
    return f"${name} << END\n{text}\nEND\n"


def labels(rows, x, y, near, least=0):
    """One row, with all their names, for points that lie nearer than such a part of both axes,
    which are a decade long at least."""
    def place(row):
        return math.log10(row[x]), math.log10(max(row[y], least))

    axes = [max(max(values) - min(values), 1) for values in zip(*map(place, rows))]
    found = []
    for row in rows:
        for other in found:
            if all(abs(a - b) < near * axis for a, b, axis in zip(place(row), place(other), axes)):
                other["way"] += ", " + row["way"]
                break
        else:
            found.append(dict(row))
    return found


def wrapped(text, width):
    return r"\n".join(textwrap.wrap("Pick: " + text, width))


def models_panel(rows, radar, legend):
    """Blocks of data, and the commands that draw them."""
    def title(text):
        return f'title "{text}"' if legend else "notitle"

    floor = scores.floor(rows, radar, "centres")
    own, contour = (pick(rows, ladder="models", radar=radar, against=against) for against in ("centres", "contour"))
    effects = [row for row in own if scores.single(row)]
    best = min(effects, key=lambda row: row["gospa"])
    series = {"front": scores.front(own), "effects": effects,
              "main": [row for row in own if row not in effects] + [floor | {"way": "signal, large"}],
              "contour": [row for row in contour if not scores.single(row)],
              "best": [best | {"way": best["way"].replace("paper ", "")}]}
    series["label"] = labels(series["main"], "cpu_us", "gospa", 0.03)
    plots = [f'{floor["gospa"]} with lines dt 2 lc rgb "{INK}" {title("floor: that signal against itself")}']
    plots += [f"${name}_{radar} using 1:2 {look} {title(text)}" for name, look, text in MODELS]
    plots += [f'$label_{radar} using 1:2:3 with labels left rotate by 25 offset 0.7, 0.4 font ",10" notitle',
              f'$best_{radar} using 1:2:3 with labels right offset -0.8, 0 font ",9" tc rgb "{GREY}" notitle']
    return [block(f"{name}_{radar}", of, "cpu_us", "gospa") for name, of in series.items()], f"""
set title "{radar.capitalize()} range"
set label 1 "{wrapped(scores.advice(rows, radar, "centres"), 68)}" at graph 0, -0.19 font ",10"
plot {", ".join(plots)}"""


def models(rows):
    panels = [models_panel(rows, radar, radar == "long") for radar in ("long", "short")]
    parts = [f"set origin {0.5 * number}, 0; set size 0.5, 1{commands}" for number, (_, commands) in enumerate(panels)]
    return "".join(text for blocks, _ in panels for text in blocks) + """set multiplot
set border 3; set tics nomirror out; set logscale xy; set xrange [2:1e6]; set yrange [0.8:16]; set bmargin 9
set ytics (1, 1.5, 2, 3, 4, 5, 7, 10); set format x "10^{%L}"; set key top right samplen 1.5 font ",10"
set xlabel "CPU time per frame, µs"; set ylabel "GOSPA, cells"
""" + "\n".join([*parts, "unset multiplot\n"])


def knob_panel(rows, ladder, x, y, texts, more="", line="linespoints", least=LEAST):
    """One series for each radar; texts are title, axes and what to pick."""
    title, xlabel, ylabel, choice = texts
    own = pick(rows, ladder=ladder)
    radars = list(dict.fromkeys(row["radar"] for row in own))
    names = [f"{ladder}_{radar or 'any'}" for radar in radars]
    blocks = [block(name, [row for row in own if row["radar"] == radar], x, y, least)
              for name, radar in zip(names, radars)]
    plots = [f'${name} using 1:2 with {line} pt 7 ps 0.7 lc rgb "{colour}" '
             + (f'title "{radar} range"' if radar else "notitle")
             for name, radar, colour in zip(names, radars, (BLUE, ORANGE))]
    shown = [labels(pick(own, radar=radar), x, y, 0.08, least) for radar in radars]
    blocks += [block(f"label_{name}", of, x, y, least) for name, of in zip(names, shown)]
    plots += [f'$label_{name} using 1:2:3 with labels left rotate by 25 offset 0.6, 0.4 font ",9" notitle'
              for name in names]
    return blocks, f"""
set title "{title}"; set xlabel "{xlabel}"; set ylabel "{ylabel}"; set autoscale; set key top right; {more}
set label 1 "{wrapped(choice, 68)}" at graph 0, -0.36 font ",10"
plot {", ".join(plots)}"""


FRAME, ANGLE = "CPU time per frame, µs", "CPU time per angle, µs"


def knobs(rows):
    exact = f"set yrange [{LEAST / 3:g}:30]"
    panels = [
        knob_panel(rows, "table", "cpu_us", "azimuth_rad_max",
                   ("Angle by a table of so many entries", ANGLE, "greatest error, rad",
                    "the closed form: an angle is little of a frame"),
                   "set xrange [0.002:1]; set yrange [1e-17:1]", "points", 0),
        knob_panel(rows, "spacing", "cpu_us", "gospa",
                   ("Spacing of a contour", FRAME, "GOSPA from its signal, cells",
                    "as coarse as outlines may be: closer scatterers cost, and make cells that a signal has not"),
                   "set yrange [0.8:10]"),
        knob_panel(rows, "digits", "bytes", "gospa",
                   ("Digits from stage to stage", "bytes written per frame", "GOSPA from all digits, cells",
                    "all; phases of 77 GHz turn within a millimetre, and digits save little room"),
                   exact + "; set key center"),
        knob_panel(rows, "plumbing", "cpu_us", "bytes",
                   ("Plumbing: the same targets", FRAME, "bytes written per frame",
                    "one process; .gz of its output where room counts"),
                   "set xrange [50:3e3]; set yrange [300:3e5]; set key top left", "points"),
    ]
    parts = [f"set origin {number % 2 / 2}, {0.5 - 0.5 * (number // 2)}; set size 0.5, 0.5{commands}"
             for number, (_, commands) in enumerate(panels)]
    return "".join(text for blocks, _ in panels for text in blocks) + """set multiplot
set border 3; set tics nomirror out; set logscale xy; set key top right samplen 1 font ",9"; set bmargin 7
set format x "10^{%L}"; set format y "10^{%L}"
""" + "\n".join([*parts, "unset multiplot\n"])


def draw(rows, folder):
    for name, script, height in (("models", models(rows), 620), ("knobs", knobs(rows), 800)):
        for ending, terminal in (("svg", f"svg size 1100,{height} fixed"), ("png", f"pngcairo size 1100,{height}")):
            place = os.path.join(folder, f"{name}.{ending}")
            head = f'set terminal {terminal} font "sans-serif,12"\nset output "{place}"\n'
            subprocess.run(["gnuplot", "-d"], input=head + script, check=True, text=True)
