"""The tables of tests/tools/accuracy-cost: cost.csv, knobs.csv, and the same in Markdown."""
import csv
import os

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


def error(row):
    """The error as text: "<" and its upper end if the interval reaches 0; alone if it has none, as ideal echoes."""
    if "root" not in row:
        return "not told"
    if row["root_low"] == row["root_high"]:
        return f"{row['root']:.0f}"
    if row["root_low"] <= 0:
        return f"<{row['root_high']:.1f}"
    return f"{row['root']:.1f} ({row['root_low']:.1f} to {row['root_high']:.1f})"


def models(rows, radars):
    """Chains, and spoiled lists of the reference, by radar: error with its interval, and time."""
    own = [row for row in rows if row["group"] in ("scale", "models", "reference")]
    names = list(dict.fromkeys(row["chain"] for group in ("scale", "models", "reference") for row in pick(own, group=group)))
    text = head(["lists", *(f"{RADARS[radar]}: error, %" for radar in radars)])
    for name in names:
        found = {row["radar"]: error(row) + (f"; {spent(row['us'])}" if "us" in row else "") for row in pick(own, chain=name)}
        text += line([name, *(found.get(radar, "") for radar in radars)])
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


def gain(rows, radar, group, name):
    """What an effect gains, as text: "-" if it is not significant, nothing where the radar has no such row."""
    found = pick(rows, radar=radar, group=group, chain=name)
    return "".join(f"{row['gain']:.1f}" if told(row) else "-" for row in found)


LEAST = 1  # points that an effect of the table gains or harms somewhere


def effects(rows, radars):
    """What each effect gains, added to the paper's and in all others; those that matter."""
    most = {}
    for row in rows:
        if row["group"] in ("added", "left out") and told(row):
            most[row["chain"]] = max(most.get(row["chain"], 0), abs(row["gain"]))
    text = "\n" + head(["points that an effect gains: added to the paper's / in all others", *(RADARS[radar] for radar in radars)])
    for name in sorted((name for name in most if most[name] >= LEAST), key=lambda name: -most[name]):
        pairs = [[gain(rows, radar, group, name) for group in ("added", "left out")] for radar in radars]
        text += line([name, *(f"{added or ' '} / {left_out}".strip() if added or left_out else "" for added, left_out in pairs)])
    return text


def markdown(cost):
    """The tables of data/accuracy/README.md."""
    radars = [radar for radar in RADARS if pick(cost, radar=radar)]
    text = models(cost, radars) + "".join(
        f"\n{RADARS[radar].capitalize()}: ideal echoes are not told from the reference, so there are no errors.\n"
        for radar in radars if not measured(cost, radar))
    return text + effects(cost, radars)


def renew_page(path, tables):
    """Replaces what stands behind the heading of the tables, up to the next one."""
    with open(path) as file:
        before, _, behind = file.read().partition(BEGIN)
    with open(path, "w") as out:
        out.write(before + BEGIN + tables + "\n" + behind[behind.index("## "):])
