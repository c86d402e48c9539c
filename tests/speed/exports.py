"""scripts/bench --exports: what writing the layouts of other data sets costs, beside the chain that makes the frames and
beside writing the same files empty.

The frames are a moving scene of 400, seen by four radars. Each round runs the chain into a file of lines, every export of
that file, and for every layout a Python process that makes the same folders and files empty; the ratios of a round are of
that round alone. A layout is to take at most 1.5 times its empty files and 3 chains; one without a file for each scan at
most 3 chains. Time is CPU time of a process and all its children. Files of a disk take the system more time, and another
one in each round; in memory (TMPDIR=/dev/shm) the ratios repeat.
"""
import os
import shutil
import statistics
import subprocess
import sys

import timing
from glint.progress import say

FRAMES, SUITE = 400, "corner77-four"
CHAIN = ("glint-traffic-random --density medium --seconds 20 --scenes 0:1 --rate-hz 20 | glint-extract | "
         "glint-ideal --sensors {} --sections quality,visibility | glint-sensor | glint-noise -o {}")
EXPORT, LAYOUTS = os.path.abspath(os.path.join("scripts", "export")), os.path.join("data", "exports")
PROGRAMS = "glint-mcap", "glint-osi"  # write one file
EMPTY = """
import os, sys
with open(sys.argv[1], encoding="utf-8") as names:
    for name in names.read().splitlines():
        path = os.path.join(sys.argv[2], name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        open(path, "xb").close()
"""
TIMES_EMPTY, CHAINS = 1.5, 3


def layouts():
    """Names of the documents of scripts/export."""
    return sorted(name.removesuffix(".json") for name in os.listdir(LAYOUTS) if name.endswith(".json") and name != "schema.json")


def cpu_ms(command):
    return timing.spent(command)["spent"]["cpu_ns"] / 1e6


class Layout:
    """A layout, its files, and what each round took."""

    def __init__(self, name, command, folder):
        self.name, self.command, self.out, self.empty_command, self.files = name, command, os.path.join(folder, name), None, 1
        self.exported, self.empty, self.chains = [], [], []

    def remove(self):
        for path in (self.out, self.out + ".empty"):
            shutil.rmtree(path, ignore_errors=True)

    def list_files(self):
        """Exports once, and says which files there are; the empty ones are those. Python compiles its modules meanwhile."""
        subprocess.run(self.command, check=True, stderr=subprocess.DEVNULL)
        if not os.path.isdir(self.out):
            return
        found = sorted(os.path.relpath(os.path.join(place, name), self.out)
                       for place, _, names in os.walk(self.out) for name in names)
        with open(self.out + ".names", "w", encoding="utf-8") as file:
            file.write("".join(name + "\n" for name in found))
        self.files = len(found)
        self.empty_command = [sys.executable, "-c", EMPTY, self.out + ".names", self.out + ".empty"]

    def measure(self, chain_ms):
        self.remove()
        self.exported.append(cpu_ms(self.command))
        self.empty.append(cpu_ms(self.empty_command) if self.empty_command else 0)
        self.chains.append(chain_ms)

    def bound(self, empty, chain):
        """A layout has a file for each scan if it has more files than frames."""
        return TIMES_EMPTY * empty * (self.files > FRAMES) + CHAINS * chain

    def row(self):
        of_bound = [one / self.bound(*other) for one, *other in zip(self.exported, self.empty, self.chains)]
        empty, exported = map(statistics.median, (self.empty, self.exported))
        in_chains = statistics.median(map(float.__truediv__, self.exported, self.chains))
        return (f"{self.name:12} {self.files:6,} {empty:9.0f} {exported:10.0f} {in_chains:7.1f}   "
                f"{statistics.median(of_bound):6.2f}  {min(of_bound):.2f} to {max(of_bound):.2f}")


def run(options, folder):
    frames = os.path.join(folder, "frames.jsonl")
    os.environ["BUILD"] = os.path.dirname(os.path.dirname(os.path.abspath(options.glint)))
    os.environ["PYTHONPYCACHEPREFIX"] = os.path.join(folder, "modules")  # compiled once, as where Python may write beside them
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    chain = [options.glint, "-c", CHAIN.format(SUITE, frames)]
    subprocess.run(chain, check=True)
    found = [Layout(name, [sys.executable, EXPORT, name, "--out", os.path.join(folder, name), frames], folder) for name in layouts()]
    found += [Layout(name, [name, frames, "-o", os.path.join(folder, name)], folder) for name in PROGRAMS if shutil.which(name)]
    for layout in found:
        layout.list_files()
    for _ in range(options.repeat):
        chain_ms = cpu_ms(chain)
        for layout in found:
            layout.measure(chain_ms)
    say(f"{FRAMES} frames of {SUITE}, {options.repeat} rounds, medians of CPU time; the chain takes "
        f"{statistics.median(found[0].chains):.0f} ms\n"
        f"layout        files  empty ms  export ms  chains   of its bound (least to most)")
    for layout in found:
        say(layout.row())
    return 0
