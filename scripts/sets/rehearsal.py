"""Tries a plan before a folder is there: what leaks, and what would fail in a shard hours later."""
import bisect
import itertools
import json
import shlex
import subprocess
import tempfile

from documents import copy_documents, environment, suite_name
from plan import Fault, kind_of, refuse
from tracks import pieces_of, same_traffic
from traffic import (US, chain_of, command_words, first_scenes, operand, seconds, source_command, stretches_of,
                     words_of_recording)

FRAMES = 10  # of each source go through the chain of each suite


class Rehearsal:
    """Plays the sources of a plan, which lie from `folder`, with the copies of documents in the folder `trial`."""

    def __init__(self, plan, folder, trial):
        self.plan, self.folder, self.environment = plan, folder, environment(trial)

    def lines(self, path, *words):
        """The lines that a command writes, as far as they are asked for."""
        with subprocess.Popen(words, cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE) as process:
            try:
                yield from process.stdout
            except GeneratorExit:
                process.kill()
                raise
        if process.returncode != 0:
            raise Fault(process.returncode, f"{path}: this fails: {shlex.join(words)}")

    def egos(self, source, path, words):
        """The frames of a recording, with the egos alone as their objects."""
        return map(json.loads, self.lines(path, *command_words(source, words), "--radius-m", "0"))

    def check_chain(self, stretch, suite, path):
        """Sends the first frames of a source through the chain."""
        source, rest = source_command(self.plan, stretch, suite), f"{chain_of(self.plan, suite)} | glint-summary"
        frames = b"".join(itertools.islice(self.lines(path, "glint", "-c", source), FRAMES))
        done = subprocess.run(["glint", "-c", rest], input=frames, cwd=self.folder, env=self.environment,
                              stdout=subprocess.DEVNULL, check=False)
        if done.returncode != 0:
            raise Fault(done.returncode, f"/chain: this fails: glint -c {shlex.quote(f'{source} | {rest}')}")

    def check_drawn(self, source, path):
        """Refuses to split a scenario of which two of the first scenes are alike, as it draws nothing or too little."""
        stretch, scenes, names = first_scenes(source, self.plan.get("seeds", [1])[0]), {}, {}
        command = source_command(self.plan, stretch, suite_name(self.plan["suites"][0]))
        for frame in map(json.loads, self.lines(path, "glint", "-c", command)):
            scenes.setdefault(frame["scene"], []).append(frame["objects"])
        for name, objects in scenes.items():
            other = names.setdefault(json.dumps(objects), name)
            refuse(other != name, path, f"scenes {other} and {name} are alike: in two splits they would leak")

    def check_egos(self, source, blocks, path):
        """Each ego has frames in every block; if all are egos, there is one in every block."""
        begins, ends = zip(*blocks)
        whole = None if None in begins else min(begins), None if None in ends else max(ends)
        times = {}
        for frame in self.egos(source, path, words_of_recording(source, whole, "all")):
            ego = "all" if source["egos"] == ["all"] else frame["ego"]
            times.setdefault(ego, []).append(round(frame["time_s"] * US))
        for (begin, end), ego in itertools.product(blocks, source["egos"]):
            at = times.get(ego, [])
            first = bisect.bisect_left(at, begin) if begin is not None else 0
            refuse(first == (bisect.bisect_left(at, end) if end is not None else len(at)), f"{path}/egos",
                   f'"{ego}" has no frame in the block' + (f" that begins at {seconds(begin)} s" if begin is not None else ""))

    def check_recordings(self):
        """Refuses recordings with the same traffic in two splits."""
        splits, known = self.plan["splits"], []
        for i, source in enumerate(self.plan["sources"]):
            pieces = pieces_of(self.egos(source, f"/sources/{i}", [operand(source["recording"]), "--ego", "all"]))
            for j, other in known:
                leaks = splits["by"] == "time" or source["split"] != self.plan["sources"][j]["split"]
                refuse(leaks and same_traffic(other, pieces), f"/sources/{i}",
                       f"its bodies move as those of /sources/{j}: both recordings have the same traffic, in two splits, so it leaks")
            known.append((i, pieces))


def rehearse(plan, folder, copied):
    with tempfile.TemporaryDirectory() as trial:
        copy_documents(copied, trial, trial)
        rehearsal = Rehearsal(plan, folder, trial)
        for i, source in enumerate(plan["sources"]):
            path, seed = f"/sources/{i}", plan.get("seeds", [1])[0]
            parts = stretches_of(plan, source, seed, plan["frames_per_shard"], folder)
            stretches = list(itertools.chain(*parts.values()))
            refuse(not stretches, path, "this source gives no scene")
            if kind_of(source) == "recording":
                rehearsal.check_egos(source, [stretch.block for stretch in stretches], path)
            if kind_of(source) == "scenario" and "splits" in plan:
                rehearsal.check_drawn(source, path)
            for suite in map(suite_name, plan["suites"]):
                rehearsal.check_chain(stretches[0], suite, path)
        if plan.get("splits", {}).get("by") in ("time", "recording") and len(plan["sources"]) > 1:
            rehearsal.check_recordings()
