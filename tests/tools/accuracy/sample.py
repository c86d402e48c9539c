"""What scripts/test checks of tests/tools/accuracy-cost with few frames and seeds."""
import json
import os
import random
import statistics
import sys
import tempfile

import chains
import errors
import knobs
import scenes
import tracking
import written
from glint.progress import Progress
from written import RADARS, pick


def frames(name, cache):
    """The file of the frames from which the digests of cost.csv are made."""
    return scenes.Radar(name, cache, few=True).block(0, scenes.OF_CHAINS)


class Checks:
    def __init__(self):
        self.failed = 0

    def hold(self, good, what):
        if not good:
            self.failed += 1
            print(f"accuracy-cost: {what}", file=sys.stderr)


def every_chain(radar):
    return [*chains.models(radar), *chains.added(radar), *chains.left_out(radar), chains.reference(radar)]


def up_to_date(checks, cost, radar, cache):
    """cost.csv has the chains that there are, and they make the lists that were measured."""
    known = {(row["group"], row["chain"]): row["digest"] for row in pick(cost, radar=radar.name)
             if row["group"] != "scale"}
    sample = radar.block(0, scenes.OF_CHAINS)
    every = every_chain(radar)
    stale = [f"{chain.group}: {chain.name}" for chain in every
             if known.get((chain.group, chain.name)) != chain.digest(sample)]
    gone = len(known) - len({(chain.group, chain.name) for chain in every} & known.keys())
    checks.hold(not stale and not gone, f"data/accuracy/cost.csv is stale: {len(stale)} chains of radar {radar.name} "
                f"have another suite, version or lists ({', '.join(stale[:3])} ...), {gone} are gone: make accuracy")


def order(checks, radar, cache):
    """The clear cases, with a signal that is quick: ideal echoes are farther off than the paper's model,
    that is farther off than all effects, and the signal is as near to itself as its seeds allow."""
    truth = chains.Chain("sample", "signal, small", radar, chains.SIGNAL, size="small")
    of = {chain.name: chain for chain in chains.models(radar)}
    blocks = [truth.lists(cache, radar.block(block)) for block in range(2)]
    found = {name: errors.energies(radar, blocks, [of[name].lists(cache, radar.block(0, scenes.OF_CHAINS))])
             for name in ("perfect", "paper", "all effects")}
    scale = errors.Errors(found["perfect"])
    checks.hold(scale.told, f"radar {radar.name}: ideal echoes are not told from the signal")
    for less, more in (("paper", "perfect"), ("all effects", "paper")):
        low = scale.difference(found[more], found[less])[1]
        checks.hold(low > 0, f"radar {radar.name}: {more} is not farther off than {less}: {low:.3g}")
    _, low, high = scale.error(errors.energies(radar, blocks[:1], blocks[1:]))
    checks.hold(low < 22, f"radar {radar.name}: the signal is {low:.3g} to {high:.3g} % from itself")
    same_mean(checks, radar, blocks, of["paper"].lists(cache, radar.block(0, scenes.OF_CHAINS)), scale, found)


def same_mean(checks, radar, blocks, listed, scale, found):
    """The mean over scenes and its bootstrapped interval are those of glint-score."""
    said = errors.ensemble(radar, blocks, [listed])
    values = scale.values(found["paper"])
    low, high = (end / len(values) for end in errors.interval(scale.resamples.totals(values)))
    near = 0.1 * (said["high"] - said["low"])
    checks.hold(abs(said["energy"] - statistics.fmean(values)) < 1e-9, f"radar {radar.name}: mean {values}")
    checks.hold(abs(low - said["low"]) < near and abs(high - said["high"]) < near,
                f"radar {radar.name}: interval {low:.3g} to {high:.3g}, "
                f"glint-score has {said['low']:.3g} to {said['high']:.3g}")


def coverage(checks):
    """Of 30 scenes whose distances are drawn by a law with a ratio of 40 %, the interval holds 40 % as often
    as it says: in 90 to 99 of 100 of 300 tries."""
    source, held, tries = random.Random(7), 0, 300
    resamples = errors.Resamples(30, 400)
    for _ in range(tries):
        ideal = [source.lognormvariate(1, 0.5) for _ in range(30)]
        scale = errors.Errors({i: (value, 0) for i, value in enumerate(ideal)}, resamples)
        _, low, high = scale.ratio([value * source.uniform(0.2, 0.6) + source.gauss(0, 0.2) for value in ideal])
        held += low <= 40 <= high
    checks.hold(0.9 * tries <= held <= 0.99 * tries, f"intervals hold the ratio in {held} of {tries} tries")


def no_ratio(checks):
    """Where ideal echoes are not told from the reference there is no error, and the tables say so."""
    scale = errors.Errors({i: (value, 0) for i, value in enumerate([-1, 1.1] * 10)})
    checks.hold(not scale.told, "a ratio to a distance whose interval reaches 0")
    rows = [{"radar": radar, "group": "models", "chain": "perfect", "scenes": 2, "seeds": 8, "us": 1}
            for radar in RADARS]
    checks.hold(written.markdown(rows).count("not told from the reference") == len(RADARS), "no word of that")


def settings(checks, radar, cache):
    """More digits are nearer, and plumbing changes nothing."""
    with tempfile.TemporaryDirectory() as folder:
        once = cache.text(".jsonl", scenes.lines_of(radar.frames, [1]))
        made = knobs.measured(radar, folder, once, len(radar.frames))
    off = [distance for _, distance in made if distance is not None]
    checks.hold(all(few >= many for few, many in zip(off, off[1:])) and off[-1] == 0, f"digits: GOSPA {off}")


SILENT = """python3 -c '
import json, sys
for line in sys.stdin:
    frame = json.loads(line)
    print(json.dumps({"scene": frame["scene"], "frame": frame["frame"], "tracks": []}))'"""


def tracker(checks, radar, cache):
    """A tracker without tracks misses all: GOSPA is the same on every rung, the root of half the square of the
    cut-off of 5 m for each road user in view (order 2, alpha 2). The tracker of scripts/ does better."""
    rungs = [chain for chain in chains.models(radar) if chain.name in ("perfect", "paper")]
    seen = [tracking.weathered(0, scenes.played("glint-traffic cut-in")[::5])]
    progress = Progress("rungs")
    silent = tracking.rows(cache, SILENT, progress, rungs, seen)
    ours = tracking.rows(cache, os.path.join(chains.ROOT, "scripts", "tracker"), progress, rungs, seen)
    lists = rungs[0].lists(cache, cache.text(".jsonl", "".join(json.dumps(frame) + "\n" for frame in seen[0])))
    lines = tracking.scored(cache, lists, SILENT)
    expected = statistics.fmean((12.5 * line["all"]["true_count"]) ** 0.5 for line in lines)
    checks.hold(all(abs(row["gospa"] - expected) < 1e-9 and row["missed"] == 100 for row in silent) and expected > 1,
                f"without tracks GOSPA is {silent[0]['gospa']}, expected {expected}")
    checks.hold(silent[1]["change"] == 0, f"without tracks a chain changes GOSPA by {silent[1]['change']}")
    checks.hold(ours[0]["gospa"] < 0.8 * expected, f"on ideal echoes the tracker has {ours[0]['gospa']:.3g} m")


def check(tables):
    checks = Checks()
    with tempfile.TemporaryDirectory() as place:
        cache = chains.Cache(place)
        for name in RADARS:
            radar = scenes.Radar(name, cache, few=True)
            up_to_date(checks, tables.cost, radar, cache)
            order(checks, radar, cache)
        settings(checks, radar, cache)
        tracker(checks, radar, cache)
    angles = {name: off for name, _, off in knobs.angles(1)}
    checks.hold(angles["closed form"] <= angles["65536"] <= 1e-6 * angles["16"], f"tables of angles: {angles}")
    coverage(checks)
    no_ratio(checks)
    return 1 if checks.failed else 0
