"""Squared errors of targets divided by the variances in their quality, for people who write trackers.

    python3 tests/tools/accuracy/normalised_errors.py [--scenes 20] [--suites srr24-signal,lrr77-full] [--signal | --rows]

Random scenes of dense traffic move for 2 s each at 25 Hz. Each suite detects them by its cells (glint-sensor, glint-noise),
with --signal a suite with a waveform also by its signal (glint-sensor-signal). --rows prints rows of
data/accuracy/quality.txt: means by suite. The error of a target is its difference from the echo of its greatest weight; false
alarms have none. Misalignment is left out, as the quality does not contain it. The groups are targets of one echo and of
several, unmarked and marked by `looks_merged`, and all unmarked and all marked targets, which a tracker can tell apart. A
range rate is compared in its true fold; targets that the signal puts into a wrong one are a group of their own and in no
other. NEES is e' P^-1 e of range, range rate and azimuth, divided by their number. Where variances are right, each mean is 1,
and 95 % of the errors are inside their 95 % region (1.96 standard deviations, or the ellipsoid of NEES). Each figure has its
95 % interval over scenes. Such intervals of 20 scenes cover 94 % where scenes are alike, and 85 % where few scenes have most
of the errors.
"""
import argparse
import json
import math
import os
import subprocess
import sys

sys.dont_write_bytecode = True
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..")
sys.path[:0] = [os.path.join(ROOT, "scripts"), os.path.join(ROOT, "tests", "support")]
import suites  # noqa: E402
from glint.progress import Progress, say  # noqa: E402

GLINT = os.path.join(ROOT, os.environ.get("BUILD", "build"), "bin", "glint")
SUITES = ",".join(sorted(name[:-5] for name in os.listdir(os.path.join(ROOT, "data", "sensors"))
                         if name.endswith(".json") and not name.endswith("-every-frame.json")))
CELLS, SIGNAL = "glint-sensor | glint-noise", "glint-sensor-signal"
COMPONENTS = {"range": ("range_m", "range_sd_m"), "rate": ("range_rate_mps", "range_rate_sd_mps"),
              "azimuth": ("azimuth_rad", "azimuth_sd_rad")}
GROUPS = {(False, False): "one", (False, True): "one, marked", (True, False): "several", (True, True): "several, marked"}
TOTALS = {False: "all unmarked", True: "all marked"}
FEWEST = 8  # scenes with such targets, for an interval
REGION = {1: 3.841, 2: 5.991, 3: 7.815}  # 95 % of chi squared, by degrees of freedom


def normalised(target):
    """Squared errors divided by variances, by component, each with whether it is inside its 95 % region; components
    without a deviation are left out."""
    quality, truth = target["quality"], max(target["contributors"], key=lambda one: one["weight"])
    folds = quality.get("ambiguity_number", 0) * quality.get("range_rate_interval_mps", 0)
    reported = dict(target, range_rate_mps=target["range_rate_mps"] + folds)
    squares = {name: ((reported[key] - truth[key]) / quality[sd]) ** 2
               for name, (key, sd) in COMPONENTS.items() if quality[sd] > 0}
    errors = {name: (square, square <= REGION[1]) for name, square in squares.items()}
    if squares:
        nees = sum(squares.values())
        errors["NEES"] = nees / len(squares), nees <= REGION[len(squares)]
    return errors


def source_of(scenes):
    """The traffic of so many scenes."""
    return f"glint-traffic-random --density dense --seconds 2 --rate-hz 25 --scenes 0:{scenes} --seed 27"


def scenes_of(source, suite, chain):
    """The normalised errors of each target with an echo, by scene and group."""
    text = (f"{source} | glint-extract | glint-ideal --sensors {suite} --sections quality "
            f"--effects auto,-misalignment | {chain}")
    done = subprocess.run([GLINT, "-c", text], check=True, stdout=subprocess.PIPE, cwd=ROOT)
    scenes = {}
    for frame in map(json.loads, done.stdout.splitlines()):
        groups = scenes.setdefault(frame["scene"], {})
        for target in frame["targets"]:
            quality, parts = target["quality"], target["contributors"]
            marked = quality.get("looks_merged", False)
            belongs = [GROUPS[len(parts) > 1, marked], TOTALS[marked]]
            if chain == SIGNAL and quality["ambiguity_number"] != 0:
                belongs = ["wrong fold"]
            for group in belongs if parts[0]["path"] != "false_alarm" else ():
                groups.setdefault(group, []).append(normalised(target))
    return list(scenes.values())


def ratio(pairs):
    """The ratio of sums, with its 95 % interval if at least FEWEST scenes have such targets: that of its logarithm, by the
    jackknife over scenes and Student's t."""
    above, below = map(sum, zip(*pairs))
    pairs = [pair for pair in pairs if pair[1]]
    count = len(pairs)
    if count < FEWEST or any(pair[0] >= above for pair in pairs):
        return f"{above / below:.3g} (few)" if below else "-"
    logs = [math.log((above - one) / (below - other)) for one, other in pairs]
    middle, z = sum(logs) / count, 1.96
    student = z + (z ** 3 + z) / (4 * (count - 1))
    half = student * math.sqrt((count - 1) / count * sum((log - middle) ** 2 for log in logs))
    return f"{above / below:.3g} ({above / below * math.exp(-half):.3g} to {above / below * math.exp(half):.3g})"


def report(title, scenes):
    """Rows of one chain: groups by component."""
    all_of = [sum(len(scene.get(group, [])) for group in [*GROUPS.values(), "wrong fold"]) for scene in scenes]
    for group in [*GROUPS.values(), "wrong fold", *TOTALS.values()]:
        own = [scene.get(group, []) for scene in scenes]
        share = ratio([(100 * len(of), every) for of, every in zip(own, all_of)])
        for name in [*COMPONENTS, "NEES"] if any(own) else ():
            errors = [[one[name] for one in of if name in one] for of in own]
            mean = ratio([(sum(square for square, _ in of), len(of)) for of in errors])
            inside = ratio([(100 * sum(within for _, within in of), len(of)) for of in errors])
            say(f"{title:27}{group:17}{name:9}{sum(map(len, own)):6}  {share:23}{mean:28}{inside}")


def mean_of(scenes, groups, name):
    """The mean of a component over groups, with its interval."""
    errors = [[one[name] for group in groups for one in scene.get(group, []) if name in one] for scene in scenes]
    return ratio([(sum(square for square, _ in of), len(of)) for of in errors])


def row(title, scenes):
    """The row of one chain in the table of a page."""
    unmarked, every = (sum(len(scene.get(total, [])) for scene in scenes for total in totals)
                       for totals in ((TOTALS[False],), TOTALS.values()))
    figures = [mean_of(scenes, [GROUPS[False, False]], name) for name in COMPONENTS]
    figures += [mean_of(scenes, [TOTALS[marked]], "azimuth") for marked in (False, True)]
    share = f"{100 * unmarked / every:.0f} %"
    return f"| `{title}` | " + " | ".join([*figures[:3], share, *figures[3:]]) + " |"


def main():
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("--scenes", type=int, default=20, help="number of random scenes; absent: 20")
    asked.add_argument("--suites", default=SUITES, help="names of suites with commas")
    asked.add_argument("--signal", action="store_true", help="by the signal as well")
    asked.add_argument("--rows", action="store_true", help="rows of the page's table")
    asked = asked.parse_args()
    chains = []
    for suite in asked.suites.split(","):
        chains.append((suite, suite, CELLS))
        if asked.signal and all("waveform" in one for one in suites.whole(suite)["sensors"]):
            chains.append((f"{suite}, signal", suite, SIGNAL))
    if asked.rows:
        say("| suite | range | range rate | azimuth | unmarked | their azimuth | marked, azimuth |\n" + "|---" * 7 + "|")
    else:
        say(f"{'suite':27}{'echoes':17}{'':9}{'count':>6}  {'% of targets':23}{'mean squared error/variance':28}% inside 95 %")
    for title, suite, chain in Progress("chains").over(chains):
        scenes = scenes_of(source_of(asked.scenes), suite, chain)
        if asked.rows:
            say(row(title, scenes))
        else:
            report(title, scenes)


if __name__ == "__main__":
    main()
