"""The table of README.md beside this file from scripts/bench's output: ratios first, then this machine's
figures. scripts/test holds the page to the table's words, never to its numbers."""
import re

BASE = "highway-20x1"
GROWING = ["highway", "in-view", "unhidden"]
SCENES = [f"{kind}-{count}x1" for kind in GROWING for count in (20, 1000)]


class Output:
    """Lines of an output, found by what they measure."""

    def __init__(self, lines):
        self.lines = lines

    def find(self, **about):
        return next(line for line in self.lines
                    if all(line.get(key) == value for key, value in about.items()))

    def ns(self, mode, part, scene=BASE, labels="default", **_):
        return self.find(scene=scene, labels=labels, mode=mode, part=part)["ns_per_frame"]

    def floor(self, name):
        return self.find(floor=name)["ns"]


def chain(output, labels):
    cpu = output.ns("fused", "cpu", labels=labels)
    return cpu / output.floor("plain chain"), 1e9 / cpu


def physics(output):
    parts = [output.ns("fused", part) for part in ("extract", "ideal", "sensor", "noise")]
    write = output.ns("fused", "write")
    return sum(parts) / write, sum(parts) / 1e3, write / 1e3


def text(output, part, floor):
    line = output.find(scene=BASE, labels="default", mode="piped", part=part)
    return line["ns_per_frame"] / output.floor(floor), line["bytes_per_frame"] / 1e3


def piped(output):
    cpu, fused = output.ns("piped", "cpu"), output.ns("fused", "cpu")
    return cpu / fused, 1e9 / output.ns("piped", "wall")


def shards(output):
    one, two = (output.find(shards=name)["ns_per_frame"] for name in ("one", "two"))
    return one / two, 1e9 / two


def growth(output, kind):
    few, many = (output.ns("fused", "cpu", scene=f"{kind}-{count}x1") / count
                 for count in (20, 1000))
    return many / few, many / 1e3


def start(output):
    ns = output.find(start="glint")["ns"]
    return ns / output.find(start="true")["ns"], ns / 1e6


# What is compared, the figure of this machine, and both of an output.
LINES = [
    ("a frame, fused / by a plain chain without labels", "{:,.0f} frames/s",
     lambda output: chain(output, "default")),
    ("the same, the frame with an account", "{:,.0f} frames/s", lambda output: chain(output, "account")),
    ("physics of the frame / writing its line", "{:.0f} to {:.0f} µs", physics),
    ("writing its line / writing 240 numbers", "{:.1f} kB",
     lambda output: text(output, "noise: write", "write 240 numbers")),
    ("reading it before noise / reading 240 numbers", "{:.1f} kB",
     lambda output: text(output, "noise: read", "read 240 numbers")),
    ("five processes / one process, in CPU time", "{:,.0f} frames/s", piped),
    ("one process / two shards on two cores", "{:,.0f} frames/s", shards),
    ("an object among 1,000 / an object among 20", "{:.1f} µs each", lambda output: growth(output, GROWING[0])),
    ("the same, all objects in view", "{:.1f} µs each", lambda output: growth(output, GROWING[1])),
    ("the same, all in view and none hidden", "{:.1f} µs each", lambda output: growth(output, GROWING[2])),
    ("starting glint / starting a process", "{:.1f} ms", start),
]


def row(ratio, about, figure):
    return f"    {ratio:>5}   {about:<49}{figure:>18}".rstrip()


def table(lines):
    """The rows of an output."""
    rows = [row("ratio", "", "here")]
    for about, figure, measure in LINES:
        ratio, *values = measure(Output(lines))
        rows.append(row(f"{ratio:.2f}", about, figure.format(*values)))
    return rows


def form(text):
    """Rows without their numbers and spaces."""
    return [re.sub(r"[ \d.,]+", " ", line).strip() for line in text.splitlines() if line.strip()]


def check(text):
    """True if a text has the rows of a table, whatever their numbers."""
    blank = [row("ratio", "", "here")]
    blank += [row("", about, re.sub(r"{.*?}", "", figure)) for about, figure, _ in LINES]
    wanted, found = form("\n".join(blank)), form(text)
    return any(found[start:start + len(wanted)] == wanted for start in range(len(found)))
