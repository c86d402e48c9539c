"""Tries a plan before a folder is there: what leaks, and what would fail in a shard hours later."""
import bisect
import collections
import itertools
import json
import math
import os
import shlex
import subprocess
import tempfile

from glint.places import SCRIPTS
from glint.sets.documents import copy_documents, environment, path_of, suite_name
from glint.sets.plan import Fault, kind_of, read_json, refuse, split_of
from glint.sets.tables import tool_of
from glint.sets.tracks import noted, pieces_of, same_scene, same_traffic, ways_of
from glint.sets.traffic import (US, chain_of, command_words, first_scenes, operand, scene_frames, seconds, shell_of, source_command,
                                stretches_of, times_of, words_of_recording)

FRAMES, EXPORTED = 10, 50  # of each source go through the chain of each suite; of its first scene are exported


def first_scene(lines):
    """The lines of frames of the scene that begins first."""
    name = None
    for line in lines:
        frame = json.loads(line)
        name = name or frame["scene"]
        if frame["scene"] == name:
            yield line
            if frame.get("last"):
                return


class Rehearsal:
    """Plays the sources of a plan, which lie from `folder`, with the copies of documents in the folder `trial`."""

    def __init__(self, plan, folder, trial):
        self.plan, self.folder, self.environment, self.scans = plan, folder, environment(trial), collections.Counter()

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
        done = subprocess.run([*shell_of(self.plan), rest], input=frames, cwd=self.folder, env=self.environment,
                              stdout=subprocess.DEVNULL, check=False)
        if done.returncode != 0:
            whole = f"{chain_of(self.plan, suite, source)} | glint-summary"
            raise Fault(done.returncode, f"/chain: this fails: {shlex.join([*shell_of(self.plan), whole])}")

    def check_tables(self):
        """Refuses tables that this build of glint-tables cannot pack."""
        with tempfile.TemporaryDirectory() as place:
            words = shlex.split(tool_of({**self.plan, "lines": "none"}, 0, place, None))
            words.remove("--complete")  # which refuses an input without frames
            done = subprocess.run(words, env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, check=False)
        if done.returncode != 0:
            raise Fault(done.returncode, f"/compression: this fails: {shlex.join(words)}")

    def check_exports(self, stretches, suite, path):
        """Writes the first frames of a source in each layout, and refuses more scans than a layout has names for."""
        chain = chain_of(self.plan, suite, source_command(self.plan, stretches[0], suite))
        lines = list(itertools.islice(first_scene(self.lines(path, *shell_of(self.plan), chain)), EXPORTED))
        self.count_scans(json.loads(lines[0]), stretches)
        for form in self.plan["exports"]:
            with tempfile.TemporaryDirectory() as place:
                with open(os.path.join(place, "list.jsonl"), "wb") as file:
                    file.writelines(lines)
                done = subprocess.run([os.path.join(SCRIPTS, "export"), form, "--out", "out", "list.jsonl"], cwd=place, env=self.environment,
                                      stderr=subprocess.PIPE, text=True, check=False)
            if done.returncode != 0:
                raise Fault(done.returncode, f"/exports: {form}: the first frames of {path} with {suite}: {done.stderr.strip()}")
            digits = read_json(path_of(form, "export", "")).get("digits", math.inf)
            for name, count in self.scans.items():
                refuse(count > 10 ** digits, "/exports", f"{form}: {count} scans of {name}; expected at most {10 ** digits}, as "
                       f"names of its files have {digits} digits")

    def count_scans(self, frame, stretches):
        """Counts the scans of each sensor, one a frame or one a cycle, where the number of frames is known."""
        source = stretches[0].source
        frames = 0 if kind_of(source) == "recording" else scene_frames(source, 0, self.folder)
        scenes = sum(stretch.end - stretch.first for stretch in stretches) * len(self.plan.get("seeds", [1]))
        for sensor in frame["sensors"]["list"]:
            share = min(1, frame["interval_s"] / sensor["cycle_s"]) if "cycle_s" in sensor else 1
            self.scans[sensor["name"]] += int(frames * share) * scenes

    def check_scenes(self, source, path, known):
        """Refuses two of the first scenes of scenarios that are in different splits and alike: scenes of one source that are equal,
        as it then draws nothing or too little, and scenes of two sources that most of their bodies share. known: the scenes before."""
        stretch, scenes, split = first_scenes(source, self.plan.get("seeds", [1])[0]), {}, split_of(self.plan, source)
        command = source_command(self.plan, stretch, suite_name(self.plan["suites"][0]))
        for frame in map(json.loads, self.lines(path, "glint", "-c", command)):
            scenes.setdefault(frame["scene"], []).append(frame)
        for name, frames in scenes.items():
            now = path, [frame["objects"] for frame in frames], ways_of(frames)
            for other, its_split, (its_path, its_objects, its_ways) in known:
                alike = now[1] == its_objects if path == its_path else same_scene(now[2], its_ways)
                refuse(alike and not split == its_split is not None, path, f"scenes {other} and {name} are alike"
                       f"{' in most of their bodies' * (now[1] != its_objects)}: in two splits they would leak")
            known.append((name, split, now))

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

    def check_gap(self, source, stays):
        """Refuses a recording with a body that moves in the frames of two splits, unless it is the only ego."""
        times = times_of(self.plan, source)
        longest_s = max((stay.end_s - stay.begin_s for body, stay in stays.items() if stay.moved and [body] != source["egos"] and
                         sum(stay.begin_s * US < end and stay.end_s * US >= begin for begin, end in times.values()) > 1), default=0)
        refuse(longest_s, "/splits/gap_s", f'{self.plan["splits"]["gap_s"]}; a body of {source["recording"]} moves in two splits, '
               f"so it leaks; expected more than the {longest_s:.6g} s that one is there")

    def check_recordings(self):
        """Refuses recordings with the same traffic in two splits, and recordings with a body that moves in two splits."""
        known = []
        for i, source in enumerate(self.plan["sources"]):
            if kind_of(source) != "recording":
                continue
            split, stays = split_of(self.plan, source), {}
            frames = self.egos(source, f"/sources/{i}", [operand(source["recording"]), "--ego", "all"])
            pieces = pieces_of(noted(frames, stays))
            for j, its_split, _, other in known:
                refuse(not split == its_split is not None and same_traffic(other, pieces), f"/sources/{i}",
                       f"its bodies move as those of /sources/{j}: both recordings have the same traffic, in two splits, so it leaks")
            known.append((i, split, stays, pieces))
        for i, split, stays, _ in known:
            if split is None:
                self.check_gap(self.plan["sources"][i], stays)


def rehearse(plan, folder, copied):
    with tempfile.TemporaryDirectory() as trial:
        copy_documents(copied, trial, trial)
        rehearsal, scenes = Rehearsal(plan, folder, trial), []
        if plan.get("tables"):
            rehearsal.check_tables()
        for i, source in enumerate(plan["sources"]):
            path, seed = f"/sources/{i}", plan.get("seeds", [1])[0]
            parts = stretches_of(plan, source, seed, plan["frames_per_shard"], folder)
            stretches = list(itertools.chain(*parts.values()))
            refuse(not stretches, path, "this source gives no scene")
            if kind_of(source) == "recording":
                rehearsal.check_egos(source, [stretch.block for stretch in stretches], path)
            if kind_of(source) == "scenario" and "splits" in plan:
                rehearsal.check_scenes(source, path, scenes)
            for suite in map(suite_name, plan["suites"]):
                rehearsal.check_chain(stretches[0], suite, path)
                if "exports" in plan:
                    rehearsal.check_exports(stretches, suite, path)
        if "splits" in plan:
            rehearsal.check_recordings()
