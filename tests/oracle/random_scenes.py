"""Random scenes by glint-traffic-random, sent through the chain and compared with the oracle.

Usage: python3 tests/oracle/random_scenes.py BIN_DIR [FRAMES]

FRAMES (2000) of every density go through every suite with --sections account. Exit status 1 if any check
fails.
"""

import json
import sys
import tempfile
from itertools import combinations

sys.dont_write_bytecode = True
import model  # noqa: E402
import oracle  # noqa: E402
from sizes import quick  # noqa: E402

DENSITIES = ["sparse", "medium", "dense", "adversarial"]
SUITES = ["srr24-pair-every-frame", "lrr77-every-frame", "corner77-every-frame"]
LEAST_HITS = 0.05
COMPARED = 300


def source(density, suite, frames, first=0, seed=1):
    """Frames that last longer than a radar's cycle, so that each has a scan at its time."""
    kind = ["glint-traffic-random", "--density", density]
    if density == "adversarial":
        kind = ["glint-traffic-adversarial", "--sensors", suite]
    return [*kind, "--rate-hz", "10", "--frames", str(frames), "--first", str(first), "--seed", str(seed)]


def chain(suite, more=""):
    return f"glint-extract | glint-ideal --sensors {suite} --sections account{more} | glint-sensor | glint-noise"


# ---- the source alone ---------------------------------------------------------------------------


def check_shards(bench):
    for density in DENSITIES:
        whole = bench.stage(source(density, SUITES[0], 60), "")
        parts = [bench.stage(source(density, SUITES[0], count, first), "")
                 for first, count in ((0, 1), (1, 0), (1, 22), (23, 36), (59, 1))]
        bench.check("".join(parts) == whole, f"{density}: shards joined are not the whole")
        lines = whole.splitlines()
        bench.check(len(lines) == 60 == len(set(lines)), f"{density}: frames repeat")
        scenes = {json.loads(line)["scene"] for line in lines}
        bench.check(len(scenes) == 60, f"{density}: {len(scenes)} names for 60 scenes")
        other = bench.stage(source(density, SUITES[0], 60, seed=2), "").splitlines()
        places = [json.loads(line)["objects"] for line in lines + other]
        bench.check(all(a != b for a, b in combinations(places, 2)), f"{density}: two snapshots are alike")
        bench.stage(["glint-extract", "--complete"], whole)
    bench.end_group("shards joined are the whole, byte for byte; no snapshot comes twice")


# ---- the laws of the chain -----------------------------------------------------------------------


def check_laws(bench, frames):
    for density in DENSITIES:
        for suite in SUITES:
            text = " ".join(source(density, suite, frames)) + " | " + chain(suite)
            bench.check(bench.fused(text).count("\n") == frames, f"{density}, {suite}: frames are missing")
    bench.end_group(f"{frames} frames of every density through every suite, with account")


# ---- are hard cases hard? ------------------------------------------------------------------------


def near_threshold(frame, sensor):
    limit = oracle.first_threshold(sensor)
    sums = [c["amplitude"] for c in frame["cells"] if c["sensor"] == sensor["name"]]
    for group in frame.get("lost", []):
        if group["sensor"] == sensor["name"] and group["reason"] == "below_threshold":
            sums += [oracle.threshold(sensor) * 10 ** (-e.get("shortfall_db", 0) / 20) for e in group["echoes"]]
    return any(abs(s / limit - 1) <= 1e-3 * (1 + 1e-9) for s in sums)


def near_tie(frame, sensor):
    leaders = sorted(c["members"][0]["weight"] * c["amplitude"] for c in frame["cells"] if c["sensor"] == sensor["name"])
    return any(b - a <= 1e-3 * (1 + 1e-9) * a for a, b in zip(leaders, leaders[1:]))


def near_tie_in_reach(frame, sensor):
    """Two members of one cell, either of which might lead it."""
    return any(abs(a["weight"] / b["weight"] - 1) <= 1.001e-3 for c in frame["cells"] if c["sensor"] == sensor["name"]
               for a, b in zip(c["members"], c["members"][1:]))


def at_spacing(frame, sensor, wanted):
    half = dict(zip(("range_m", "range_rate_mps"), oracle.half_cells(sensor)))
    [other] = set(half) - {wanted}
    echoes = [e for e in frame["echoes"] if e["sensor"] == sensor["name"]]
    return any(abs(abs(a[wanted] - b[wanted]) / half[wanted] - 1) <= 1e-6 * (1 + 1e-6)
               and abs(a[other] - b[other]) <= half[other] for a, b in combinations(echoes, 2))


def hit_rates(bench, density, suite, frames):
    sensors = json.loads((model.ROOT / f"data/sensors/{suite}.json").read_text())["sensors"]
    ways = {"threshold": near_threshold, "leaders": near_tie, "tie in cell": near_tie_in_reach,
            "range": lambda f, s: at_spacing(f, s, "range_m"), "rate": lambda f, s: at_spacing(f, s, "range_rate_mps")}
    hits = dict.fromkeys(ways, 0)
    text = " ".join(source(density, suite, frames)) + " | " + chain(suite, ",echoes,cells")
    for frame in model.parsed(bench.fused(text)):
        for name, way in ways.items():
            hits[name] += any(way(frame, sensor) for sensor in sensors)
    return {name: count / frames for name, count in hits.items()}


def check_hits(bench, frames):
    for suite in SUITES:
        rates = hit_rates(bench, "adversarial", suite, frames)
        for name, rate in rates.items():
            bench.check(rate >= LEAST_HITS, f"{suite}: {name} in {rate:.1%} of the frames")
        note = ", ".join(f"{name} {rate:.1%}" for name, rate in rates.items())
        bench.end_group(f"adversarial scenes are, {suite}", f": {note}")


# ---- against the oracle --------------------------------------------------------------------------


def with_dipoles(suite):
    """The suite with dipoles, the one antenna that the oracle knows."""
    document = json.loads((model.ROOT / f"data/sensors/{suite}.json").read_text())
    for sensor in document["sensors"]:
        sensor.pop("antenna_table", None)
        sensor["antenna_pattern"] = "dipole_pair"
    return document


def check_oracle(bench):
    for density in DENSITIES:
        tally = {"scenes": 0, "skipped": 0, "echoes": 0, "cells": 0}
        for suite in SUITES:
            document = with_dipoles(suite)
            words = source(density, bench.write_suite(document), COMPARED)
            items = bench.played(*words)
            for item, answer in zip(items, bench.chain(items, document, account=True)):
                views = oracle.look(item, bench.vehicles, document)
                if not model.compare_scene(bench, f"{suite} {item['scene']}", answer, item, views, False):
                    tally["skipped"] += 1
                for name, count in (("scenes", 1), ("echoes", len(answer["echoes"])), ("cells", len(answer["cells"]))):
                    tally[name] += count
        bench.check(tally["skipped"] <= (0.1 if density == "adversarial" else 0.0) * tally["scenes"],
                    f"{tally['skipped']} of {tally['scenes']} scenes hang on rounding")
        bench.end_group(f"{density} scenes against the oracle", ", " + ", ".join(f"{k} {v}" for k, v in tally.items()))


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    frames = int(sys.argv[2]) if len(sys.argv) == 3 else quick(600, 2000)
    with tempfile.TemporaryDirectory() as scratch:
        bench = model.Bench(sys.argv[1], scratch)
        check_shards(bench)
        check_laws(bench, frames)
        check_hits(bench, frames)
        check_oracle(bench)
    sys.exit(bench.failures > 0)


if __name__ == "__main__":
    main()
