"""What a tracker makes of each chain's lists: GOSPA of its tracks in metres, by chain and by effect.

A score is the mean over scenes of the scene's mean GOSPA (glint-score-tracks, MODEL 11.2) against road users
in view, whom every chain shares. All chains have the same scenes, frames and seed, so a change from one chain to
another is paired; its interval is the bootstrap's over whole scenes. The drives of the recorded table share
their traffic and are one scene.
"""
import collections
import json
import os
import shlex
import subprocess
import sys

import chains
import scenes
import written
from errors import Resamples, interval

COLUMNS = ["group", "chain", "scenes", "frames", "gospa", "low", "high", "missed", "false", "switches",
           "change", "change_low", "change_high"]
LONGEST = 100  # frames of a scene
ROAD_USERS = "car,truck,articulated_truck,van,bus,motorcycle,bicycle,pedestrian"
RUNGS = ("perfect", "gauss", "paper", "all effects", "smear", "signal, small")


def weathered(number, drive):
    """Scenes are dry and in rain in turn; target lists have the section quality, for trackers."""
    weather = scenes.RAIN if number % 2 else scenes.DRY
    return [frame | {"conditions": weather | frame.get("conditions", {}), "seed": "1", "sections": ["objects", "quality"]}
            for frame in drive]


def drives(plan):
    """The first frames of scripted scenes, and those of the drives through the recorded table."""
    sources = [scene for scene in plan["scripted"] if scene != "empty-road"]
    sources += [f"{scenes.HIGHWAY}-{ego} --ego {ego}" for ego in plan["recorded"]]
    return [weathered(number, scenes.played(f"glint-traffic {source}")[:LONGEST])
            for number, source in enumerate(sources)]


def traffic_of(scene):
    return scene.partition("-")[0] if scene.startswith("highway-") and scene[8:].isdigit() else scene


def tracker_digest(command):
    """Of the command and of the files that it names."""
    files = [chains.content(word) for word in shlex.split(command) if os.path.isfile(word)]
    return chains.digest(command, *files, chains.content(os.path.join(chains.ROOT, "scripts", "glint", "frames.py")))


def scored(cache, lists, command):
    """A line of glint-score-tracks for each frame."""
    def write(path):
        text = (f"gzip -dc {lists} | {command} | {chains.BIN}/glint-score-tracks --tracks - {lists} "
                f"--objects in_view --classes {ROAD_USERS} -o {path}")
        if subprocess.run(["bash", "-o", "pipefail", "-c", text], check=False).returncode != 0:
            sys.exit(f"accuracy-cost: this fails: {text}")
    key = [tracker_digest(command), chains.program_digest("glint-score-tracks"), ROAD_USERS, os.path.basename(lists)]
    return [json.loads(line) for line in chains.content(cache.file(".tracks", key, write)).splitlines()]


class Score:
    """Of one chain: GOSPA by scene, and counts of all."""

    def __init__(self, lines):
        by_scene = collections.defaultdict(list)
        for line in lines:
            by_scene[traffic_of(line["scene"])].append(line["all"]["gospa"])
        self.gospa = [sum(of) / len(of) for _, of in sorted(by_scene.items())]
        self.frames = len(lines)
        self.count = {key: sum(line["all"][key + "_count"] for line in lines)
                      for key in ("true", "listed", "missed", "false")}
        self.switches = sum(line["id_switches"] for line in lines)


def mean_with_interval(values, resamples):
    return (sum(values) / len(values), *interval([total / len(values) for total in resamples.totals(values)]))


def row_of(chain, score, base, resamples):
    """change is what the chain adds to its base; of an effect that is left out, what the effect adds."""
    row = {"group": chain.group, "chain": chain.name, "scenes": len(score.gospa), "frames": score.frames,
           "missed": 100 * score.count["missed"] / score.count["true"],
           "false": 100 * score.count["false"] / max(1, score.count["listed"]),
           "switches": 1000 * score.switches / score.frames}
    row |= dict(zip(("gospa", "low", "high"), mean_with_interval(score.gospa, resamples)))
    if base:
        sign = -1 if chain.group == "left out" else 1
        changes = [sign * (a - b) for a, b in zip(score.gospa, base.gospa)]
        row |= dict(zip(("change", "change_low", "change_high"), mean_with_interval(changes, resamples)))
    return row


def ladder(radar):
    """Each rung, each effect added to the paper's, and each left out of all."""
    rungs = [chain for chain in chains.models(radar) if chain.name in RUNGS]
    return rungs + chains.added(radar) + chains.left_out(radar)


def rows(cache, command, progress, every, seen):
    """A row for each chain, over the drives that are seen."""
    frames = cache.text(".jsonl", "".join(json.dumps(frame) + "\n" for drive in seen for frame in drive))
    scores = {}
    for chain in progress.over(every, len(every)):
        scores[chain.group, chain.name] = Score(scored(cache, chain.lists(cache, frames), command))
    resamples = Resamples(len(next(iter(scores.values())).gospa))
    return [row_of(chain, scores[chain.group, chain.name], scores.get(("models", chain.base)), resamples)
            for chain in every]


def read(folder):
    return written.read_csv(os.path.join(folder, "tracker.csv"))


def measure(cache, command, folder, progress):
    """Writes tracker.csv, and returns its rows."""
    radar = scenes.Radar("long", cache, few=True)
    found = rows(cache, command, progress, ladder(radar), drives(radar.plan))
    written.write_csv(found, COLUMNS, os.path.join(folder, "tracker.csv"))
    return read(folder)
