"""What scripts/bench times: scenes fused and piped, the machine's floors, start-up, two shards, a
long stream.

Nanoseconds are CPU time, so that a busy machine counts little; times called wall, start-up and shards are
wall-clock time. Every number is a median, with minimum and maximum."""
import json
import os
import shlex
import statistics
import subprocess

import scenes

TOOLS = os.path.join("build", "tests", "speed")
SPENT = os.path.join(TOOLS, "spent")
# Frames of a run by number of objects, so many that starting is a small part of the run; and how often a
# piped stage reads its file, so that a small file makes a long run.
FRAMES = {2: 10000, 20: 4000, 100: 800, 1000: 60}
READS = {2: 100, 20: 40, 100: 20, 1000: 6}


def spread(values, name="ns_per_frame"):
    return {name: round(statistics.median(values)), "min": round(min(values)),
            "max": round(max(values))}


def spent(command, stdout=subprocess.DEVNULL):
    """The lines of JSON on stderr about a command's times, by part; what the command itself says there is dropped."""
    done = subprocess.run([SPENT] + command, check=False, stdin=subprocess.DEVNULL, stdout=stdout,
                          stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise SystemExit(f"bench: {shlex.join(command)}:\n{done.stderr}")
    told = map(json.loads, filter(lambda line: line.startswith("{"), done.stderr.splitlines()))
    return {line["part"]: line for line in told}


def timed(glint, script):
    """What each part of a pipeline takes in the build of that glint."""
    return spent([os.path.join(os.path.dirname(glint), "..", "tests", "speed", "timed"), script])


def function_lines(options, _):
    done = subprocess.run([os.path.join(TOOLS, "functions"), str(options.repeat)],
                          check=True, stdout=subprocess.PIPE, text=True)
    samples = {}
    for line in done.stdout.splitlines():
        name, ours, libm = line.split("\t")
        samples.setdefault(name, []).append((float(ours), float(libm)))
    for name, pairs in samples.items():
        ours, libm = (statistics.median(column) for column in zip(*pairs))
        yield {"function": name, "ns": round(ours, 2), "libm_ns": round(libm, 2),
               "ratio": round(ours / libm, 2)}


def write_text(text, folder, name="chain.sh"):
    path = os.path.join(folder, name)
    with open(path, "w") as out:
        out.write(f"set -o pipefail\n{text}\n")
    return path


def part_times(glint, text, folder):
    """ns per frame of one fused run, by part."""
    told = timed(glint, write_text(text, folder))
    return {part: line["ns_per_frame"] for part, line in told.items() if "ns_per_frame" in line}


class Chain:
    """One pipeline to measure: fused, each stage alone between the lines that a pipe would carry, and in real
    pipes."""

    def __init__(self, glint, commands, frames, reads, folder):
        self.glint, self.frames, self.samples, self.bytes, self.peak_kB = glint, frames, {}, {}, {}
        os.makedirs(folder)
        self.fused = write_text(" | ".join(commands), folder)
        self.stages, read = [], []
        for number, command in enumerate(commands):
            name = command.split()[0][len("glint-"):]
            many = write_text(" ".join([command] + read * reads), folder, f"{number}.sh")
            self.stages.append((name, many))
            written = os.path.join(folder, f"{number}.jsonl")
            self.write_lines(" ".join([command] + read), written, frames // reads)
            read = [written]

    def write_lines(self, text, path, frames):
        """Lets a source make all its frames; the file gets so many of them, spread evenly."""
        subprocess.run([self.glint, "-c", f"{text} -o {path}"], check=True)
        with open(path) as file:
            lines = file.readlines()
        with open(path, "w") as out:
            out.writelines(lines[::len(lines) // frames][:frames])

    def add(self, mode, part, value):
        self.samples.setdefault((mode, part), []).append(value)

    def add_run(self, mode, told, prefix=""):
        """Adds every part of one process; returns their sum."""
        total = 0
        for part, line in told.items():
            if "ns_per_frame" in line:
                self.add(mode, prefix + part, line["ns_per_frame"])
                total += line["ns_per_frame"]
                frames = line["frames"]
        for part in ("read", "written"):
            if told["bytes"][part] > 0:
                name = prefix + {"read": "read", "written": "write"}[part]
                self.bytes[mode, name] = round(told["bytes"][part] / frames)
        return total

    def sample(self):
        told = timed(self.glint, self.fused)
        self.add("fused", "all", self.add_run("fused", told))
        told = spent([self.glint, self.fused])["spent"]
        self.add("fused", "cpu", told["cpu_ns"] / self.frames)
        self.add("fused", "wall", told["wall_ns"] / self.frames)
        self.peak_kB["fused", "all"] = told["peak_kB"]
        total = 0
        for name, text in self.stages:
            told = timed(self.glint, text)
            total += self.add_run("piped", told, f"{name}: ")
        self.add("piped", "all", total)
        told = spent(["bash", self.fused])["spent"]
        self.add("piped", "cpu", told["cpu_ns"] / self.frames)
        self.add("piped", "wall", told["wall_ns"] / self.frames)
        self.peak_kB["piped", "all"] = told["peak_kB"]

    def lines(self, echoes, targets, plain_ns):
        for (mode, part), values in self.samples.items():
            line = {"mode": mode, "part": part, "frames": self.frames} | spread(values)
            ns = line["ns_per_frame"]
            line["plain_chains"] = round(ns / plain_ns, 3)
            if echoes > 0:
                line["ns_per_echo"] = round(ns / echoes)
            if targets > 0:
                line["ns_per_target"] = round(ns / targets)
            if (mode, part) in self.bytes:
                line["bytes_per_frame"] = self.bytes[mode, part]
            if (mode, part) in self.peak_kB:
                line["peak_kB"] = self.peak_kB[mode, part]
            yield line


class Floors:
    """What the machine takes for the simplest parts of the work, sampled all along a run."""

    def __init__(self, frames):
        self.frames, self.samples = frames, {}

    def sample(self):
        """Samples the floors; returns the time of the plain chain in ns."""
        done = subprocess.run([os.path.join(TOOLS, "floors"), "1", self.frames], check=True,
                              stdout=subprocess.PIPE, text=True)
        for line in done.stdout.splitlines():
            name, unit, value = line.split("\t")
            self.samples.setdefault((name, unit), []).append(float(value))
        return self.samples["plain chain", "ns"][-1]

    def lines(self):
        for (name, unit), values in self.samples.items():
            yield {"floor": name} | spread(values, unit)


def census(glint, text):
    """Echoes and targets per frame; the text has --sections account."""
    done = subprocess.run([glint, "-c", text], check=True, stdout=subprocess.PIPE, text=True)
    frames = [json.loads(line) for line in done.stdout.splitlines()]
    echoes = sum(path["echoes"] for frame in frames for count in frame["counts"]
                 for path in count["paths"])
    return echoes / len(frames), sum(len(frame["targets"]) for frame in frames) / len(frames)


def scene_s(_, count, sensors):
    """What one repetition of a scene takes on two cores, in s: the floors, and frames by objects and sensors."""
    return 3 + 4e-5 * FRAMES[count] * count * (1 + sensors)


def scene_lines(glint, scene, floors, repeat, folder):
    """Every line of one scene: (kind, objects, sensors)."""
    kind, count, sensors = scene
    name = f"{kind}-{count}x{sensors}"
    frames, reads = FRAMES[count], READS[count]
    few = " | ".join(scenes.commands(*scene, max(frames // reads, 4), "account"))
    echoes, targets = census(glint, few)
    chains = {labels: Chain(glint, scenes.commands(*scene, frames, labels), frames, reads,
                            os.path.join(folder, f"{name}-{labels}"))
              for labels in ("default", "account")}
    plain = []
    for _ in range(repeat):
        plain.append(floors.sample())
        for chain in chains.values():
            chain.sample()
    for labels, chain in chains.items():
        about = {"scene": name, "objects": count, "sensors": sensors, "labels": labels,
                 "echoes": round(echoes, 2), "targets": round(targets, 2)}
        for line in chain.lines(echoes, targets, statistics.median(plain)):
            yield about | line
