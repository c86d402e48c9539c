"""The diagrams of tests/tools/accuracy-cost, by gnuplot: cost-long.svg, cost-short.svg, knobs.svg.

All axes are scaled here, so that the place of every point is known and labels can be placed beside it.
"""
import math
import os

from glint.drawings import gnuplot
import labels
from labels import Box
from written import RADARS, changes, measured, pick, spent_more

BLUE, ORANGE, GREY = "#0072b2", "#d55e00", "#888888"
SIZE, WIDTH = 13, 880  # of the font and of a picture, in pixels
# Marks of points by their colour, so that nobody needs to see the colour, and their signs in a legend.
MARKS = {BLUE: ("points pt 7 ps 0.6", "●"), ORANGE: ("points pt 4 ps 0.7 lw 1.6", "□")}


def power(value):
    return f"{value:,.10g}"


def steps(low, high):
    """1, 2 and 5 times powers of ten, from the last that is at most low to the first that is at least high."""
    marks = [lead * 10.0 ** k for k in range(-20, 20) for lead in (1, 2, 5)]
    return ([mark for mark in marks if mark <= low * (1 + 1e-9)][-1:] + [mark for mark in marks if low < mark < high]
            + [mark for mark in marks if mark >= high * (1 - 1e-9)][:1])


class Logarithmic:
    """An axis from step to step. Values below the least decade, zero and negative ones stand beyond a break."""

    def __init__(self, values, least=None):
        above = [value for value in values if value > 0]
        decade = 10.0 ** math.floor(math.log10(max(min(above), least or 0)))
        self.broken = any(value < decade for value in values)
        marks = steps(decade if self.broken else min(above), max(above))
        self.low, self.high = math.log10(marks[0]), math.log10(marks[-1])
        sparse = [mark for mark in marks if f"{mark:e}"[0] == "1"]
        self.marks = marks if self.high - self.low < 2.2 else sparse
        self.gap = 0.11 * (self.high - self.low)
        room = 0.03 * (self.high - self.low)
        self.range = (self.low - (1.5 * self.gap if self.broken else room), self.high + room)

    def at(self, value):
        return math.log10(value) if value > 0 and math.log10(value) >= self.low else self.low - self.gap

    def tics(self, suffix=""):
        marks = [f'"{power(mark)}{suffix}" {math.log10(mark):.6g}' for mark in self.marks]
        if self.broken:
            marks.insert(0, f'"<{power(10.0 ** self.low)}{suffix}" {self.low - self.gap:g}')
        return "(" + ", ".join(marks) + ")"


class Signed:
    """An axis with decades on both sides of a linear part around zero; its label names the linear part."""
    LINEAR = 0.2
    SCALE = f"linear within ±{LINEAR:g}, logarithmic beyond"
    MARKS = [-100, -30, -10, -3, -1, -0.3, 0, 0.3, 1, 3, 10, 30, 100]

    def __init__(self, values):
        self.range = (self.at(min([*values, 0]) * 1.2), self.at(max(values) * 1.2))

    def at(self, value):
        return math.asinh(value / self.LINEAR)

    def tics(self, suffix=""):
        low, high = self.range
        marks = [mark for mark in self.MARKS if low <= self.at(mark) <= high]
        return "(" + ", ".join(f'"{mark:g}{suffix}" {self.at(mark):.6g}' for mark in marks) + ")"


class Linear:
    """From zero."""

    def __init__(self, values):
        self.range = (0, max(values) * 1.05)
        self.step = next(mark for mark in steps(1e-6, 1e6) if mark >= self.range[1] / 8)

    def at(self, value):
        return value

    def tics(self, suffix=""):
        return "(" + ", ".join(f'"{mark * self.step:g}{suffix}" {mark * self.step:.6g}'
                               for mark in range(int(self.range[1] / self.step) + 1)) + ")"


class Rows:
    """One row for each name, the first on top."""

    def __init__(self, names):
        self.names, self.range = names, (-0.8, len(names) - 0.2)

    def at(self, value):
        return len(self.names) - 1 - value

    def tics(self, suffix=""):
        return "(" + ", ".join(f'"{name}{suffix}" {self.at(row)}' for row, name in enumerate(self.names)) + ")"


class Panel:
    """One diagram; frame is its part of the page in pixels, y upwards."""

    def __init__(self, page, frame, x, y, texts, suffixes=("", "")):
        self.page, self.frame, self.x, self.y = page, frame, x, y
        self.texts, self.suffixes = texts, suffixes
        self.blocks, self.plots, self.more, self.legend = [], [], [], []

    def pixel(self, x, y):
        (left, right), (low, high) = self.x.range, self.y.range
        frame = self.frame
        return (frame.left + (self.x.at(x) - left) / (right - left) * (frame.right - frame.left),
                frame.low + (self.y.at(y) - low) / (high - low) * (frame.high - frame.low))

    def data(self, rows):
        name = f"$PANEL_{len(self.blocks)}"
        self.blocks.append((name, rows))
        return name

    def series(self, points, colour, style=None, title=None):
        style = style or MARKS[colour][0]
        name = self.data([f"{self.x.at(x):.6g} {self.y.at(y):.6g}" for x, y in points])
        self.plots.append(f'{name} using 1:2 with {style} lc rgb "{colour}" notitle')
        if title:
            self.legend.append((title, colour))

    def bars(self, spans, colour, vertical):
        """Intervals: (x, y, low, high) each, along y or along x."""
        rows, boxes = [], []
        if not spans:
            return []
        for x, y, low, high in spans:
            ends = [(x, low), (x, high)] if vertical else [(low, y), (high, y)]
            rows += [f"{self.x.at(a):.6g} {self.y.at(b):.6g}" for a, b in ends] + [""]
            boxes.append(around(*(self.pixel(*end) for end in ends)))
        self.plots.append(f'{self.data(rows)} using 1:2 with lines lw 1.4 lc rgb "{colour}" notitle')
        return boxes

    def names(self, points, bars):
        """Labels (x, y, text, colour), with a line to the point where they stand far from it."""
        at = [(*self.pixel(x, y), text) for x, y, text, _ in points]
        for (x, y, text), (*_, colour), (left, low, anchor) in zip(
                at, points, labels.placed(at, self.frame, bars, SIZE)):
            self.write(text, left, low, {"start": "left", "middle": "center", "end": "right"}[anchor], colour)
            width, height = self.page
            if math.hypot(left - x, low - y) > 20:
                self.more.append(f'set arrow from screen {x / width:.6f}, screen {y / height:.6f} to screen '
                                 f'{left / width:.6f}, screen {low / height:.6f} nohead lw 0.5 lc rgb "{GREY}"')

    def breaks(self):
        """Two strokes across an axis where it is broken."""
        text = []
        for axis, along in ((self.x, "x"), (self.y, "y")):
            if not getattr(axis, "broken", False):
                continue
            for shift in (-0.006, 0.006):
                at = (axis.low - 0.5 * axis.gap - axis.range[0]) / (axis.range[1] - axis.range[0]) + shift
                ends = ((at - 0.006, -0.012, at + 0.006, 0.012) if along == "x" else
                        (-0.006, at - 0.012, 0.006, at + 0.012))
                text.append("set arrow from graph {:.5f}, {:.5f} to graph {:.5f}, {:.5f} nohead front".format(*ends))
        return text

    def heading(self):
        """Above the frame: the title, the vertical axis below it, and the legend to the right in its colours."""
        title, _, ylabel = self.texts
        left, right, high = self.frame.left - 60, self.frame.right, self.frame.high
        self.write(title, left, high + 42)
        self.write(ylabel, left, high + 22)
        for row, (text, colour) in enumerate(self.legend):
            sign = f"{MARKS[colour][1]} " if colour in MARKS else "··· "
            self.write(sign + text, right, high + 42 - 20 * row, "right", colour)

    def write(self, text, x, y, side="left", colour="black"):
        width, height = self.page
        if text:
            self.more.append(f'set label "{text}" at screen {x / width:.6f}, screen {y / height:.6f} '
                             f'{side} tc rgb "{colour}"')

    def commands(self, number):
        width, height = self.page
        frame = self.frame
        self.heading()
        blocks = "".join(f"{name} << END\n" + "\n".join(rows) + "\nEND\n" for name, rows in self.blocks)
        text = f"""unset label; unset arrow
set lmargin at screen {frame.left / width:.6f}; set rmargin at screen {frame.right / width:.6f}
set bmargin at screen {frame.low / height:.6f}; set tmargin at screen {frame.high / height:.6f}
set xlabel "{self.texts[1]}" offset 0,0.4
set xrange [{self.x.range[0]:.6g}:{self.x.range[1]:.6g}]; set yrange [{self.y.range[0]:.6g}:{self.y.range[1]:.6g}]
set xtics {self.x.tics(self.suffixes[0])}; set ytics {self.y.tics(self.suffixes[1])}
""" + "\n".join([*self.breaks(), *self.more]) + "\nplot " + ", ".join(self.plots) + "\n"
        return [part.replace("$PANEL_", f"$panel{number}_") for part in (blocks, text)]


def page(path, size, panels, title):
    """Writes the panels as one picture."""
    parts = [panel.commands(number) for number, panel in enumerate(panels)]
    text = ("".join(blocks for blocks, _ in parts) + "set multiplot\nset border 3; set tics nomirror out\n"
            + "".join(commands for _, commands in parts) + "unset multiplot\n")
    gnuplot.draw(f'size {size[0]},{size[1]} fixed noenhanced font "sans-serif,{SIZE}"', text, path, title)


def around(one, other):
    """The box of a line between two pixels."""
    (left, right), (low, high) = (sorted(pair) for pair in zip(one, other))
    return Box(left - 1, right + 1, low - 1, high + 1)


def front(rows):
    """The chains than which no cheaper one has a smaller error, cheapest first."""
    kept = []
    for row in sorted(rows, key=lambda row: (row["us"], row["root"])):
        if not kept or row["root"] < kept[-1]["root"]:
            kept.append(row)
    return kept


def models_panel(rows, radar, size, frame):
    own = [row for row in pick(rows, radar=radar)
           if row["group"] in ("models", "reference") and "us" in row and "root" in row]
    panel = Panel(size, frame, Logarithmic([row["us"] for row in own]),
                  Logarithmic([row[key] for row in own for key in ("root", "root_low", "root_high")], 1),
                  (f"What accuracy costs: {RADARS[radar]}", "CPU time of a frame, µs",
                   "error: distance from the signal, 100 % is that of ideal echoes"), ("", " %%"))
    best = front(own)
    steps = [point for one, after in zip(best, best[1:]) for point in
             ((one["us"], one["root"]), (after["us"], one["root"]))] + [(best[-1]["us"], best[-1]["root"])]
    panel.series(steps, GREY, "lines lw 1 dt 2", "no cheaper chain is nearer the signal")
    bars = panel.bars([(row["us"], row["root"], row["root_low"], row["root_high"]) for row in own], BLUE, True)
    bars += [around(panel.pixel(*one), panel.pixel(*after)) for one, after in zip(steps, steps[1:])]
    panel.series([(row["us"], row["root"]) for row in own], BLUE, title="chain, with its 95 % interval")
    panel.names([(row["us"], row["root"], row["chain"], "black") for row in own], bars)
    return panel


# Group, colour, shift within the effect's row, and words of the legend.
EFFECT_GROUPS = (("added", BLUE, -0.16, "added to the paper's"), ("left out", ORANGE, 0.16, "in all others"))


def effect_series(panel, rows, names, value):
    """What effects change, to both sides of a line at zero: with its interval, a row of the panel for each name."""
    panel.more.append(f"set arrow from 0, graph 0 to 0, graph 1 nohead lw 0.5 lc rgb \"{GREY}\"")
    for group, colour, shift, _ in EFFECT_GROUPS:
        at = [(row, names.index(row["chain"]) + shift) for row in pick(rows, group=group)]
        panel.bars([(row[value], y, row[value + "_low"], row[value + "_high"]) for row, y in at], colour, False)
        panel.series([(row[value], y) for row, y in at], colour)


def effect_panels(rows, radar, size, frames):
    """What effects gain, and beside it what they cost."""
    own = [row for row in pick(rows, radar=radar)
           if row["group"] in ("added", "left out") and changes(row) and "gain" in row and "us" in row]
    best = {}
    for row in own:
        best[row["chain"]] = max(best.get(row["chain"], -1000), row["gain"])
    names = sorted(best, key=lambda name: -best[name])
    ends = [row[key] for row in own for key in ("gain_low", "gain_high")]
    gains = Panel(size, frames[0], Signed(ends), Rows(names),
                  ("Squared error that an effect takes away, with its 95 % interval", f"points; {Signed.SCALE}", ""))
    cost = {id(row): spent_more(rows, row) for row in own}
    costs = Panel(size, frames[1], Logarithmic(list(cost.values()), 1), Rows(["" for _ in names]),
                  ("Time that it takes", "CPU time of a frame, µs", ""))
    effect_series(gains, own, names, "gain")
    for group, colour, shift, title in EFFECT_GROUPS:
        costs.series([(cost[id(row)], names.index(row["chain"]) + shift) for row in pick(own, group=group)], colour,
                     title=title)
    return [gains, costs]


def cost_page(rows, radar, path):
    shown = {row["chain"] for row in pick(rows, radar=radar) if row["group"] in ("added", "left out") and changes(row)}
    middle = 80 + 18 * len(shown)
    size = (WIDTH, middle + 500)
    frames = [Box(150, 550, 60, middle), Box(600, 830, 60, middle)]
    page(path, size, [models_panel(rows, radar, size, Box(80, 830, middle + 130, size[1] - 65)),
                      *effect_panels(rows, radar, size, frames)], f"What accuracy costs: {RADARS[radar]}")


def knob_panel(rows, group, x, y, least, size, frame, texts):
    """One series for each radar, every setting labelled."""
    own = [row for row in pick(rows, group=group) if x in row and y in row]
    panel = Panel(size, frame, Logarithmic([row[x] for row in own]),
                  Logarithmic([row[key] for row in own for key in (y, "root_low", "root_high") if key in row], least), texts)
    bars, names = [], []
    for radar, colour in zip(RADARS if own[0]["radar"] else [""], (BLUE, ORANGE)):
        of = pick(own, radar=radar)
        names += [(row[x], row[y], row["setting"], colour) for row in of]
        bars += panel.bars([(row[x], row[y], row["root_low"], row["root_high"]) for row in of if "root" in row], colour, True)
        panel.series([(row[x], row[y]) for row in of], colour, title=RADARS.get(radar))
    panel.names(names, bars)
    return panel


def tracker_page(rows, path):
    """The score on each rung, and below it what effects change."""
    rungs, own = pick(rows, group="models"), [row for row in rows if row["group"] != "models" and "change" in row]
    shown = {}
    for row in own:
        if row["change_low"] > 0 or row["change_high"] < 0:
            shown[row["chain"]] = max(shown.get(row["chain"], 0), abs(row["change"]))
    names = sorted(shown, key=lambda name: -shown[name])
    own = [row for row in own if row["chain"] in shown]
    middle = 60 + 24 * len(names)
    size = (WIDTH, middle + 24 * len(rungs) + 210)
    ladder = Panel(size, Box(170, 830, middle + 130, size[1] - 65), Linear([row["high"] for row in rungs]),
                   Rows([row["chain"] for row in rungs]),
                   ("What a tracker makes of each chain", "GOSPA of its tracks, m, with 95 % interval", ""))
    ladder.bars([(row["gospa"], place, row["low"], row["high"]) for place, row in enumerate(rungs)], BLUE, False)
    ladder.series([(row["gospa"], place) for place, row in enumerate(rungs)], BLUE)
    effects = Panel(size, Box(170, 830, 60, middle),
                    Signed([row[key] for row in own for key in ("change_low", "change_high")] or [1]), Rows(names),
                    ("What an effect adds to it, with its 95 % interval",
                     f"GOSPA of its tracks, m; {Signed.SCALE}", ""))
    effect_series(effects, own, names, "change")
    effects.legend += [(title, colour) for _, colour, _, title in EFFECT_GROUPS]
    page(path, size, [ladder, effects], "The score of a tracker on each chain, and what effects add to it")


FRAME, ANGLE = "CPU time of a frame, µs", "CPU time of an angle, µs"


def knobs_page(rows, path):
    size = (WIDTH, 960)
    frames = [Box(80, 415, 560, 895), Box(515, 845, 560, 895), Box(80, 415, 60, 395), Box(515, 845, 60, 395)]
    panels = [("table", "us", "off", 0, ("Angle by a table of so many entries", ANGLE, "greatest error, rad")),
              ("spacing", "us", "root", 1e-6, ("Spacing of a contour", FRAME, "error from 0.05 m, %")),
              ("digits", "bytes", "off", 1e-6, ("Digits from stage to stage", "bytes of a frame",
                                                "GOSPA from all digits, cells")),
              ("plumbing", "us", "bytes", 1e-6, ("Plumbing: the same targets", FRAME, "bytes of a frame"))]
    page(path, size, [knob_panel(rows, group, x, y, least, size, frame, texts)
                      for (group, x, y, least, texts), frame in zip(panels, frames)],
         "What a table of angles, the spacing of a contour, digits and plumbing cost")


def draw(cost, settings, folder):
    for radar in filter(lambda radar: measured(cost, radar), RADARS):
        cost_page(cost, radar, os.path.join(folder, f"cost-{radar}.svg"))
    knobs_page(settings, os.path.join(folder, "knobs.svg"))
