"""scripts/bench --python: what reading a stream takes in Python, beside the chain that makes it.

The frames are those of a highway with 20 vehicles and one radar, a scan in each. Every round makes them as lines in a file and
reads them in each way, by this process; the ratios of a round are of that round alone. Time is CPU time of this process
and its children. The last row makes the frames itself, and no line of them is written.
"""
import collections
import json
import os
import resource
import statistics
import subprocess

import glint
import scenes
from glint.progress import say

FRAMES = 4200
MOST = 2  # chains that columns may take


def cpu_us():
    """Of this process and of its children that have ended."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return 1e6 * sum(one.ru_utime + one.ru_stime for one in used)


def lines(path):
    with open(path, "rb") as file:
        yield from file


def drain(found):
    collections.deque(found, maxlen=0)


def ways(program, folder):
    """By name, what is measured; the first one makes the file that the others read."""
    chain, path = " | ".join(scenes.commands("highway", 20, 1, FRAMES, "default")), os.path.join(folder, "frames.jsonl")
    return {"the chain, into lines": lambda: subprocess.run([program, "-c", f"{chain} -o {path}"], check=True),
            "json.loads": lambda: drain(map(json.loads, lines(path))),
            "glint.frames(check=False)": lambda: drain(glint.frames(path, check=False)),
            "glint.frames": lambda: drain(glint.frames(path)),
            "glint.frames, glint.detections": lambda: drain(map(glint.detections, glint.frames(path))),
            "glint.columns of the lines": lambda: glint.columns(path),
            "glint.columns(chain=...)": lambda: glint.columns(chain=chain)}


def run(options, folder):
    """Prints all ways; 1 if the columns take too long."""
    import numpy  # noqa: F401: glint.columns does not wait for it, and other benchmarks do without it
    spent = {name: [] for name in ways(options.glint, folder)}
    for _ in range(options.repeat):
        for name, way in ways(options.glint, folder).items():
            begin = cpu_us()
            way()
            spent[name].append((cpu_us() - begin) / FRAMES)
    say(f"{FRAMES} frames, {options.repeat} rounds, medians of CPU time\n\nus a frame   chains (least to most)")
    made, slow = next(iter(spent.values())), 0
    for name, taken in spent.items():
        ratios = [one / chain for one, chain in zip(taken, made)]
        say(f"{statistics.median(taken):10.1f}   {statistics.median(ratios):6.2f} ({min(ratios):.2f} to {max(ratios):.2f})   {name}")
        slow |= "columns" in name and statistics.median(ratios) > MOST
    return int(slow)
