"""scripts/bench --sets: two jobs of make on a data set, beside two processes that are started by hand.

By hand, twice: chains that write compressed lines and no more; and chains whose lines also get what a set has, the
digests of both sides and the counts by class, from the usual programs. Runs alternate. Frames a second are those of
all time that passes, the shares are of the same number by hand, memory is that of the largest process.
"""
import json
import os
import shutil
import statistics
import subprocess
import sys

import timing

SCENES, SECONDS, RATE_HZ, SUITE = 120, 20, 20, "corner77-four"
CHAIN = "glint-extract | glint-ideal --sensors {suite} --sections quality | glint-sensor | glint-noise"
DATASET = os.path.join("scripts", "dataset")
DIGESTS = ("| tee >(sha256sum > {name}.plain) >(glint-summary --complete > {name}.txt) | gzip -1 "
           "| tee >(sha256sum > {name}.packed) > {name}")


def lay_out(folder, scenes):
    """A set of two shards; the command that makes it."""
    place, plan = os.path.join(folder, "set"), os.path.join(folder, "plan.json")
    shutil.rmtree(place, ignore_errors=True)
    source = {"random": "medium", "seconds": SECONDS, "scenes": [0, scenes], "rate_hz": RATE_HZ}
    with open(plan, "w", encoding="utf-8") as file:
        json.dump({"name": "bench", "origin": "To be timed.", "sources": [source], "chain": CHAIN, "suites": [SUITE],
                   "frames_per_shard": scenes // 2 * SECONDS * RATE_HZ}, file)
    subprocess.run([sys.executable, DATASET, plan, "--out", place], check=True, stderr=subprocess.DEVNULL)
    return ["make", "-s", "-C", place, "-j2"]


def by_hand(glint, folder, scenes, ending):
    """Two processes, of half the scenes each."""
    halves = []
    for part, (first, last) in enumerate(((0, scenes // 2), (scenes // 2, scenes))):
        source = f"glint-traffic-random --density medium --seconds {SECONDS} --scenes {first}:{last} --rate-hz {RATE_HZ}"
        name = os.path.join(folder, f"{part}.jsonl.gz")
        halves.append(f"{glint} -c '{source} | {CHAIN.format(suite=SUITE)}{{}}' {{}}".format(*(
            (f" -o {name}", "") if ending is None else ("", ending.format(name=name)))))
    return ["bash", "-c", f"{halves[0]} & other=$!; {halves[1]} && wait $other"]


def run(glint, folder, repeat):
    os.environ["BUILD"] = os.path.dirname(os.path.dirname(glint))
    runs = {"two processes by hand": lambda: by_hand(glint, folder, SCENES, None),
            "the same with digests and counts": lambda: by_hand(glint, folder, SCENES, DIGESTS),
            "two jobs of make": lambda: lay_out(folder, SCENES)}
    samples = {name: [] for name in runs}
    for _ in range(repeat):
        for name, command in runs.items():
            samples[name].append(timing.spent(command())["spent"])
    frames = SCENES * SECONDS * RATE_HZ
    rates = {name: frames / statistics.median(told["wall_ns"] for told in all_told) * 1e9 for name, all_told in samples.items()}
    print("frames/s   of the 1st   of the 2nd   CPU µs a frame   peak MB")
    first, second, _ = rates.values()
    for name, all_told in samples.items():
        cpu_ns = statistics.median(told["cpu_ns"] for told in all_told)
        peak_kB = max(told["peak_kB"] for told in all_told)
        print(f"{rates[name]:8,.0f} {rates[name] / first:12.2f} {rates[name] / second:12.2f} {cpu_ns / frames / 1e3:16.0f} "
              f"{peak_kB / 1e3:9.1f}   {name}", flush=True)
