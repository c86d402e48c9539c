"""The rows of scripts/accuracy-cost as CSV and as tables in Markdown."""
import csv

from scores import COLUMNS, pick, spent

# The chains of the README's table: a way, its commands, what it simulates.
CHAINS = {
    "perfect": ("`glint-sensor-perfect \\| glint-noise-none`", "one exact target per echo"),
    "paper": ("`glint-sensor \\| glint-noise`", "the paper: cells, threshold, monopulse angle, noise"),
    "all effects": ("the same with `--effects all`", "ghosts, soft shadows, wheels, clutter, weather and more besides"),
    "smear": ("`glint-sensor-smear \\| glint-noise`", "all that, and the peaks of a windowed transform"),
    "centres": ("`glint-sensor-signal`", "all that, from 512 samples of 256 chirps in 8 channels"),
}


def write_csv(rows, path):
    with open(path, "w", newline="") as out:
        table = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        table.writeheader()
        for row in rows:
            table.writerow({key: f"{value:.6g}" if isinstance(value, float) else value
                            for key, value in row.items()})


def read_csv(path):
    """The rows that write_csv wrote, without empty cells."""
    words = ("ladder", "radar", "way", "against", "scene")
    with open(path) as file:
        return [{key: value if key in words else float(value)
                 for key, value in row.items() if value or key in words} for row in csv.DictReader(file)]


def line(cells):
    return "| " + " | ".join(cells) + " |\n"


def head(cells):
    return line(cells) + "|---" * len(cells) + "|\n"


def chain_times(cpu_us):
    """The README's table, from the times per frame by way."""
    return head(["chain", "µs a frame", "what it simulates"]) + "".join(
        line([chain, f"{float(f'{cpu_us[way]:.2g}'):,.0f}", simulated])
        for way, (chain, simulated) in CHAINS.items() if way in cpu_us)


def models(rows):
    """Ways against both references of both radars. A reference's own row is its lists against
    those of other seeds."""
    own = [row for row in pick(rows) if row["ladder"] in ("models", "reference")]
    found = {(row["way"], row["radar"], row["against"]): row for row in own}
    columns = [(radar, against) for radar in ("long", "short") for against in ("centres", "contour")]
    text = head(["way", *(f"GOSPA, {radar}, {against}" for radar, against in columns),
                 "CPU, long", "CPU, short"])
    for way in dict.fromkeys(row["way"] for row in own):
        scores = [found.get((way, *column)) for column in columns]
        first = [next(row for row in scores[side:side + 2] if row) for side in (0, 2)]
        name = f"{way}: other seeds" if first[0]["ladder"] == "reference" else way
        text += line([name, *(f"{row['gospa']:.2f} ± {row['gospa_error']:.2f}" if row else "" for row in scores),
                      *(spent(row["cpu_us"]) for row in first)])
    return text


def knob(rows, ladder, unit):
    columns = {"gospa": "GOSPA", "azimuth_rad_max": "greatest error, rad", "cpu_us": f"CPU per {unit}", "bytes": "bytes"}
    own = pick(rows, ladder=ladder)
    shown = [key for key in columns if all(key in row for row in own)
             and (key != "azimuth_rad_max" or ladder == "table")]
    text = f"\n{ladder.capitalize()}\n\n" + head(["radar", "way", *(columns[key] for key in shown)])
    for row in own:
        text += line([row["radar"] or "any", row["way"], *(
            spent(row[key]) if key == "cpu_us" else f"{row[key]:.0f}" if key == "bytes" else f"{row[key]:.3g}"
            for key in shown)])
    return text


def markdown(rows):
    """The tables of data/accuracy/README.md: GOSPA in cells, CPU time and bytes of a frame."""
    return models(rows) + "".join(
        knob(rows, ladder, "angle" if ladder == "table" else "frame")
        for ladder in ("table", "spacing", "digits", "plumbing"))
