"""The diagram of scripts/accuracy-cost, by gnuplot."""
import math
import os
import subprocess

from scores import pick

BLUE, ORANGE = "#0072b2", "#d55e00"
LEAST = 1e-9  # where exactly nothing is drawn


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


def knob_panel(rows, ladder, x, y, texts, more="", line="linespoints", least=LEAST):
    """One series for each radar; texts are title and axes."""
    title, xlabel, ylabel = texts
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
plot {", ".join(plots)}"""


FRAME, ANGLE = "CPU time per frame, µs", "CPU time per angle, µs"


def knobs(rows):
    exact = f"set yrange [{LEAST / 3:g}:30]"
    panels = [
        knob_panel(rows, "table", "cpu_us", "azimuth_rad_max",
                   ("Angle by a table of so many entries", ANGLE, "greatest error, rad"),
                   "set xrange [0.002:1]; set yrange [1e-17:1]", "points", 0),
        knob_panel(rows, "spacing", "cpu_us", "gospa",
                   ("Spacing of a contour", FRAME, "GOSPA from its signal, cells"),
                   "set yrange [0.8:10]"),
        knob_panel(rows, "digits", "bytes", "gospa",
                   ("Digits from stage to stage", "bytes written per frame", "GOSPA from all digits, cells"),
                   exact + "; set key center"),
        knob_panel(rows, "plumbing", "cpu_us", "bytes",
                   ("Plumbing: the same targets", FRAME, "bytes written per frame"),
                   "set xrange [50:3e3]; set yrange [300:3e5]; set key top left", "points"),
    ]
    parts = [f"set origin {number % 2 / 2}, {0.5 - 0.5 * (number // 2)}; set size 0.5, 0.5{commands}"
             for number, (_, commands) in enumerate(panels)]
    return "".join(text for blocks, _ in panels for text in blocks) + """set multiplot
set border 3; set tics nomirror out; set logscale xy; set key top right samplen 1 font ",9"; set bmargin 4
set format x "10^{%L}"; set format y "10^{%L}"
""" + "\n".join([*parts, "unset multiplot\n"])


def draw(rows, folder):
    place = os.path.join(folder, "knobs.svg")
    head = f'set terminal svg size 1100,800 fixed font "sans-serif,12"\nset output "{place}"\n'
    subprocess.run(["gnuplot", "-d"], input=head + knobs(rows), check=True, text=True)
