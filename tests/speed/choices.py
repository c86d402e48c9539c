"""scripts/bench --sections: what each choice of --sections takes, in bytes and microseconds per frame.

The frames of two scenes go from a file through the fused chain to a file. Bytes are the same in every run; time is
CPU time, the least of several runs, of which each reads the file several times.
"""
import os
import subprocess

import timing

CHOICES = ("none", "objects", "quality", "visibility", "account:every=10", "account", "margins",
           "reflectors,echoes,cells", "all")
# What makes the frames, the suite, and how often the file is read.
SCENES = {"intersection": ("glint-traffic intersection", "srr24-pair-every-frame", 4),
          "highway": ("glint-traffic highway-straight", "lrr77-every-frame", 4)}
RUNS = 3


def measure(glint, frames, suite, choice, reads, folder):
    """Bytes and microseconds per frame."""
    out = os.path.join(folder, "out.jsonl")
    chain = (f"glint-extract {' '.join([frames] * reads)} | glint-ideal --sensors {suite} --sections {choice}"
             f" | glint-sensor | glint-noise -o {out}")
    took = min(sum(timing.part_times(glint, chain, folder).values()) for _ in range(RUNS))
    with open(out, "rb") as file:
        lines = sum(1 for _ in file)
    return os.path.getsize(out) / lines, took / 1e3


def run(glint, folder):
    print("| `--sections` | " + " | ".join(f"{scene}: bytes | µs" for scene in SCENES) + " |")
    print("|---" * (1 + 2 * len(SCENES)) + "|")
    rows = {choice: [] for choice in CHOICES}
    for scene, (source, suite, reads) in SCENES.items():
        frames = os.path.join(folder, scene + ".jsonl")
        subprocess.run([glint, "-c", f"{source} -o {frames}"], check=True)
        for choice in CHOICES:
            size, took = measure(glint, frames, suite, choice, reads, folder)
            rows[choice] += [f"{size:,.0f}", f"{took:.0f}"]
    for choice, cells in rows.items():
        print(f"| `{choice}` | " + " | ".join(cells) + " |")
