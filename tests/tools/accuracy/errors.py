"""Errors of chains: distances from the reference in per cent of that of ideal echoes.

The squared error of a chain is the mean of its scenes' energy distances (glint-score --ensemble, MODEL 11.2) over
that of `perfect`; the error is its root. Differences of chains are in points of the square,
100 of which are ideal echoes. Intervals are the bootstrap's over whole scenes, which draws the same scenes for both
means. A scene's distance holds the noise of its seeds, so the spread over scenes holds both.
"""
import gzip
import json
import os
import random
import subprocess
import sys
import tempfile

import chains
import scenes

RESAMPLES = 4000
SIGNIFICANT = 1.96


def joined(files, path):
    """Blocks of lists as one file: .gz files in a row are one."""
    with open(path, "wb") as out:
        for name in files:
            with open(name, "rb") as file:
                out.write(file.read())


def ensemble(radar, truth, listed):
    """What glint-score --ensemble says of files of lists with the same scenes and other seeds."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [os.path.join(folder, name) for name in ("truth.jsonl.gz", "listed.jsonl.gz")]
        joined(truth, paths[0])
        joined(listed, paths[1])
        done = subprocess.run([os.path.join(chains.BIN, "glint-score"), "--ensemble", *radar.score, "--truth", *paths],
                              check=True, stdout=subprocess.PIPE, text=True)
    return json.loads(done.stdout)


def energies(radar, truth, listed):
    """By scene: its energy distance and the standard error that the seeds leave."""
    def write(path):
        with open(path, "w") as out:
            out.write(json.dumps(ensemble(radar, truth, listed)["scenes"]))
    lists = map(os.path.basename, [*truth, "against", *listed])
    scored = radar.cache.file(".energies", [chains.program_digest("glint-score"), *radar.score, *lists], write)
    return {of["scene"]: (of["energy"], of["energy_error"]) for of in json.loads(chains.content(scored))}


def refuse_empty(lists, radar):
    """Frames in which the reference lists no object whatever the seed would count as agreement."""
    listed = set()
    for line in chains.content(lists).splitlines():
        frame = json.loads(line)
        if any(map(scenes.of_an_object, frame["targets"])):
            listed.add((frame["scene"], frame["frame"]))
    empty = [scan for scan in ((frame["scene"], frame["frame"]) for frame in radar.frames) if scan not in listed]
    if empty:
        sys.exit(f"accuracy-cost: radar {radar.name}: the reference lists no object in {empty}; "
                 "expected one in every frame")


def spoiled(cache, lists, lost, off_m):
    """A file of the lists without this share of their targets, and with this added to all ranges."""
    def write(path):
        source = random.Random(1)
        with gzip.open(path, "wt", compresslevel=1) as out:
            for line in chains.content(lists).splitlines():
                frame = json.loads(line)
                frame["targets"] = [target | {"range_m": target["range_m"] + off_m} for target in frame["targets"]
                                    if source.random() >= lost]
                out.write(json.dumps(frame) + "\n")
    return cache.file(".jsonl.gz", ["spoiled", os.path.basename(lists), lost, off_m], write)


class Resamples:
    """Draws of as many scenes with replacement as there are."""

    def __init__(self, count, draws=RESAMPLES):
        source = random.Random(1)
        self.draws = [source.choices(range(count), k=count) for _ in range(draws)]

    def totals(self, values):
        return [sum(map(values.__getitem__, draw)) for draw in self.draws]


def interval(values):
    """The middle 95 %."""
    ordered = sorted(values)
    cut = len(ordered) // 40
    return ordered[cut], ordered[-1 - cut]


def root(square, low, high):
    """The error in per cent, from points of its square. A negative square gives 0, and the root of its upper half interval."""
    above = max(square, 0)
    return tuple(10 * end ** 0.5 for end in (above, max(low, 0), above + high - square))


class Errors:
    """Turns distances by scene into errors. All chains have the scenes of `ideal` in its order."""

    def __init__(self, ideal, resamples=None):
        self.scenes = list(ideal)
        self.resamples = resamples or Resamples(len(self.scenes))
        self.whole = sum(self.values(ideal))
        self.totals = self.resamples.totals(self.values(ideal))
        self.told = interval(self.totals)[0] > 0  # else ideal echoes are not told from the reference

    def values(self, distances):
        return [distances[scene][0] for scene in self.scenes]

    def ratio(self, values):
        """The sum over scenes in points, 100 for ideal echoes, with its interval."""
        ratios = [100 * total / whole for total, whole in zip(self.resamples.totals(values), self.totals)]
        return (100 * sum(values) / self.whole, *interval(ratios))

    def error(self, distances):
        return root(*self.ratio(self.values(distances)))

    def difference(self, one, other):
        """The squared error of the first less that of the second, on the same scenes, in points."""
        return self.ratio([a - b for a, b in zip(self.values(one), self.values(other))])

    def of_seeds(self, distances):
        """Half of the interval that seeds alone would leave, in points of the squared error."""
        squares = sum(distances[scene][1] ** 2 for scene in self.scenes)
        return 100 * SIGNIFICANT * squares ** 0.5 / self.whole
