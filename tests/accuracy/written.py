"""The tables of scripts/accuracy-cost: cost.csv, knobs.csv, and the same in Markdown."""
import csv
import os

from chains import BASES

COST = ["radar", "group", "chain", "scenes", "seeds", "us", "root", "root_low", "root_high", "gain", "gain_low",
        "gain_high", "digest"]
KNOBS = ["radar", "group", "setting", "us", "off", "root", "root_low", "root_high", "bytes"]
WORDS = ("radar", "group", "chain", "setting", "digest")
RADARS = {"long": "long range", "short": "short range", "roadside": "long range, beside a road"}
BEGIN = "## Tables\n\n"


def write_csv(rows, columns, path):
    with open(path, "w", newline="") as out:
        table = csv.DictWriter(out, columns, lineterminator="\n", extrasaction="raise")
        table.writeheader()
        for row in rows:
            table.writerow({key: f"{value:.5g}" if isinstance(value, float) else value for key, value in row.items()})


def read_csv(path):
    """The rows that write_csv wrote, without empty cells; none where there is no file."""
    if not os.path.exists(path):
        return []
    with open(path) as file:
        return [{key: value if key in WORDS else float(value)
                 for key, value in row.items() if value or key in WORDS} for row in csv.DictReader(file)]


def pick(rows, **wanted):
    return [row for row in rows if all(row[key] == value for key, value in wanted.items())]


# --- Markdown --------------------------------------------------------------------------------------

def line(cells):
    return "| " + " | ".join(cells) + " |\n"


def head(cells):
    return line(cells) + "|---" * len(cells) + "|\n"


def spent(us):
    return f"{us:.3g} µs" if us < 1000 else f"{us / 1000:.3g} ms"


def with_interval(row):
    """An effect's gain."""
    return f"{row['gain']:.2f} ({row['gain_low']:.2f} to {row['gain_high']:.2f})" if "gain" in row else "not told"


def error(row):
    """The error as text: "<" and its upper end if the interval reaches 0."""
    if "root" not in row:
        return "not told"
    if row["root_low"] <= 0:
        return f"<{row['root_high']:.1f}"
    return f"{row['root']:.1f} ({row['root_low']:.1f} to {row['root_high']:.1f})"


def scale(rows, radar):
    """The line of the scale: errors of spoiled lists of the reference."""
    own = pick(rows, radar=radar, group="scale")
    return "For scale: " + ", ".join(f"{row['chain']} {error(row)} %" for row in own) + ".\n" if own else ""


def models(rows, radar):
    """Chains of a radar: error with its interval, and time."""
    of = pick(rows, radar=radar)
    text = f"\n### {RADARS[radar].capitalize()}\n\n{of[0]['scenes']:.0f} scenes, {of[0]['seeds']:.0f} seeds of the reference.\n"
    text += scale(rows, radar) + "\n" + head(["chain", "error, %", "time", "points of the squared error less than"])
    for row in (row for row in of if row["group"] in ("models", "reference")):
        less = f"{BASES[row['chain']]}: " + with_interval(row) if "gain" in row else ""
        text += line([row["chain"], error(row), spent(row["us"]) if "us" in row else "", less])
    return text


def measured(rows, radar):
    """False where the interval of ideal echoes reaches 0."""
    return all("root" in row for row in pick(rows, radar=radar))


NEGLIGIBLE = 0.01  # points


def told(row):
    """1 if the effect gains and its interval says so, -1 if it harms, else 0."""
    return (row["gain_low"] > 0) - (row["gain_high"] < 0) if abs(row.get("gain", 0)) >= NEGLIGIBLE else 0


def changes(row):
    """Whether the effect changes any list: then no distance is the same to the digit."""
    return any(row.get(key) for key in ("gain", "gain_low", "gain_high"))


def spent_more(rows, row):
    """What the effect takes in microseconds; None before times are measured."""
    without = "paper" if row["group"] == "added" else "all effects"
    base = pick(rows, radar=row["radar"], group="models", chain=without)[0]
    if "us" not in row or "us" not in base:
        return None
    return row["us"] - base["us"] if row["group"] == "added" else base["us"] - row["us"]


def noise_us(rows, radar):
    """Differences of times below it are not significant: twice the RMS over the effects that change no list."""
    more = [spent_more(rows, row) for row in pick(rows, radar=radar)
            if row["group"] in ("added", "left out") and not changes(row)]
    return 2 * (sum((us or 0) ** 2 for us in more) / max(len(more), 1)) ** 0.5


def effect_cells(rows, row, noise):
    if row is None:
        return ["", "", ""]
    more = spent_more(rows, row)
    rate = ""
    if told(row) > 0 and more is not None:
        rate = f"{row['gain'] / more:.2g}" if more > noise else "free"
    return [with_interval(row), "" if more is None else f"{more:.0f}", rate]


def effects(rows, radar):
    """What each effect gains and takes, added to the paper's and left out of all."""
    if not measured(rows, radar):
        return ""
    own = [row for row in pick(rows, radar=radar) if row["group"] in ("added", "left out") and changes(row)]
    found = {(row["group"], row["chain"]): row for row in own}
    noise = noise_us(rows, radar)
    text = f"\nEffects, {RADARS[radar]}: points of the squared error that an effect takes away; "
    text += f"differences of times below {noise:.0f} µs are not significant\n\n"
    text += head(["effect", "added to the paper's model", "µs", "points per µs", "in all others", "µs", "points per µs"])
    gains = {}
    for row in own:
        gains[row["chain"]] = max(gains.get(row["chain"], -1000), row.get("gain", 0))
    for name in sorted(gains, key=lambda name: -gains[name]):
        text += line([name, *(cell for group in ("added", "left out")
                              for cell in effect_cells(rows, found.get((group, name)), noise))])
    return text


def verdicts(rows, radar):
    """What the intervals support, in words."""
    text = "\n"
    if not measured(rows, radar):
        return text + "Ideal echoes are not told from the reference, so there are no errors.\n"
    for group, where in (("added", "added to the paper's model"), ("left out", "in all others")):
        own = pick(rows, radar=radar, group=group)
        said = {"gain": [row for row in own if told(row) > 0], "harm": [row for row in own if told(row) < 0],
                "have no significant gain, or one below 0.01": [row for row in own if not told(row) and changes(row)],
                "change no list here": [row for row in own if not changes(row)]}
        for verb, of in said.items():
            names = ", ".join(row["chain"] for row in sorted(of, key=lambda row: -abs(row.get("gain", 0))))
            text += f"- {where}, {verb}: {names}\n" if of else ""
    return text


UNITS = {"table": "greatest error, rad", "spacing": "error from 0.05 m, %", "digits": "GOSPA, cells",
         "plumbing": ""}


def knob(rows, group):
    own = pick(rows, group=group)
    columns = [key for key in ("off", "us", "bytes") if any(key in row or (key == "off" and "root" in row) for row in own)]
    names = {"off": UNITS[group], "us": "time", "bytes": "bytes a frame"}
    text = f"\n### {group.capitalize()}\n\n" + head(["radar", group, *(names[key] for key in columns)])
    for row in own:
        cells = {"us": spent(row["us"]) if "us" in row else "", "bytes": f"{row.get('bytes', 0):.0f}",
                 "off": error(row) if "root" in row else f"{row.get('off', 0):.3g}"}
        text += line([row["radar"] or "any", row["setting"], *(cells[key] for key in columns)])
    return text


def markdown(cost, settings):
    """The tables of data/accuracy/README.md."""
    return "".join(models(cost, radar) + verdicts(cost, radar) + effects(cost, radar)
                   for radar in RADARS if pick(cost, radar=radar)).lstrip("\n") + "".join(
        knob(settings, group) for group in UNITS if pick(settings, group=group))


def renew_page(path, tables):
    """Replaces what stands behind the heading of the tables, the end of the page."""
    with open(path) as file:
        text = file.read().partition(BEGIN)[0]
    with open(path, "w") as out:
        out.write(text + BEGIN + tables)
