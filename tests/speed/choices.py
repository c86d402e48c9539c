"""scripts/bench --sections: what each choice of --sections takes, and each form in which the frames of the default choice
are written, in bytes and microseconds per frame.

The frames of two scenarios, several scenes of each, go from a file through the fused chain to files. Bytes are the same
in every run; time is CPU time, the least of several runs.
"""
import os
import subprocess
import tempfile

import timing
from glint.progress import say

CHOICES = ("none", "objects", "quality", "visibility", "account:every=10", "account", "margins",
           "reflectors,echoes,cells", "all")
# What makes the frames, and the suite.
SCENES = {"intersection": ("glint-traffic intersection --scenes 0:4", "srr24-pair-every-frame"),
          "highway": ("glint-traffic highway-straight --scenes 0:4", "lrr77-every-frame")}
RUNS = 3
DEFAULT = "objects"
# Ends of the chain that write its frames into the folder "out".
FORMS = {"lines": "glint-noise -o out/frames.jsonl", "lines, gzip": "glint-noise -o out/frames.jsonl.gz",
         "tables": "glint-noise | glint-tables --plain out", "tables, gzip": "glint-noise | glint-tables out"}


class Scene:
    """A file of frames, and what its chain takes."""

    def __init__(self, glint, name, folder):
        self.glint, self.name, self.folder = glint, name, folder
        source, self.suite = SCENES[name]
        self.frames = os.path.join(folder, name + ".jsonl")
        subprocess.run([glint, "-c", f"{source} -o {self.frames}"], check=True)
        with open(self.frames, "rb") as file:
            self.count = sum(1 for _ in file)

    def measure(self, choice, form):
        """Bytes and microseconds per frame, as cells."""
        with tempfile.TemporaryDirectory(dir=self.folder) as out:
            end = FORMS[form].replace("out", out)
            chain = (f"glint-extract {self.frames} | glint-ideal --sensors {self.suite}"
                     f" --sections {choice} | glint-sensor | {end}")
            took = min(sum(timing.part_times(self.glint, chain, self.folder).values()) for _ in range(RUNS))
            size = sum(entry.stat().st_size for entry in os.scandir(out))
        return f"{size / self.count:,.0f} | {took / 1e3:.0f}"


def show(heading, scenes, rows, cells):
    """Prints a table of which cells(scene, row) are the cells."""
    say(f"| {heading} | " + " | ".join(f"{scene.name}: bytes | µs" for scene in scenes) + " |")
    say("|---" * (1 + 2 * len(scenes)) + "|")
    for row in rows:
        say(f"| `{row}` | " + " | ".join(cells(scene, row) for scene in scenes) + " |")


def run(options, folder):
    scenes = [Scene(options.glint, name, folder) for name in SCENES]
    show("`--sections`", scenes, CHOICES, lambda scene, choice: scene.measure(choice, "lines"))
    say("")
    show("written as", scenes, FORMS, lambda scene, form: scene.measure(DEFAULT, form))
