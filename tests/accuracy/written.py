"""The rows of scripts/accuracy-cost as CSV and as tables in Markdown."""
import csv

import scores
from scores import COLUMNS, COMPONENTS, PARTS, pick, spent


def write_csv(rows, path):
    with open(path, "w", newline="") as out:
        table = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        table.writeheader()
        for row in rows:
            table.writerow({key: f"{value:.6g}" if isinstance(value, float) else value
                            for key, value in row.items()})


def line(cells):
    return "| " + " | ".join(cells) + " |\n"


def head(cells):
    return line(cells) + "|---" * len(cells) + "|\n"


def greatest(row):
    return ", ".join(f"{row[f'{name}_max']:.2g}" if f"{name}_max" in row else "" for name in COMPONENTS)


def time_of(row):
    return f"{spent(row['cpu_us'])} ({spent(row['cpu_us_min'])}, {spent(row['cpu_us_max'])})"


GREATEST = "at most: range m, azimuth rad, rate m/s, dB"
TIME = "CPU time (least, greatest)"


def models(rows, radar, against):
    own = [row for row in rows if row["radar"] == radar and row["against"] == against
           and row["ladder"] in ("models", "reference")]
    scenes = list(dict.fromkeys(row["scene"] for row in own))[1:]
    text = f"\n## {radar.capitalize()} range, against {against}\n\nPick: {scores.advice(rows, radar, against)}.\n\n"
    text += head(["way", "GOSPA", ", ".join(PARTS), "missed, false", GREATEST, TIME, "per echo", "bytes", *scenes])
    for row in pick(own):
        name = "floor: against itself" if row["ladder"] == "reference" else row["way"]
        by_scene = [pick(own, scene, ladder=row["ladder"], way=row["way"])[0] for scene in scenes]
        text += line([name, f"{row['gospa']:.2f} ± {row['gospa_error']:.2f}",
                      ", ".join(f"{row[f'gospa_{part}']:.2f}" for part in PARTS),
                      f"{row['missed_count']:.2f}, {row['false_count']:.2f}", greatest(row), time_of(row),
                      spent(row["cpu_ns_per_echo"] / 1e3), f"{row['bytes']:.0f}",
                      *(f"{one['gospa']:.2f}" for one in by_scene)])
    return text


def knob(rows, ladder):
    text = f"\n## {ladder.capitalize()}\n\n" + head(["radar", "way", "GOSPA", GREATEST, TIME, "bytes"])
    for row in pick(rows, ladder=ladder):
        text += line([row["radar"], row["way"], f"{row['gospa']:.3g}" if "gospa" in row else "", greatest(row),
                      time_of(row), f"{row['bytes']:.0f}" if "bytes" in row else ""])
    return text


def markdown(rows):
    """GOSPA in cells, and the parts of its square; CPU time and bytes per frame, or per angle."""
    text = ("# What accuracy costs\n\nBy `scripts/accuracy-cost`, which says what is compared with what. CPU time of"
            " one machine on one day: compare ratios.\n")
    for radar in dict.fromkeys(row["radar"] for row in rows if row["radar"]):
        for against in ("centres", "contour"):
            text += models(rows, radar, against)
    for ladder in ("table", "spacing", "digits", "plumbing"):
        text += knob(rows, ladder)
    return text
