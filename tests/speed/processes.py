"""What scripts/bench measures of whole processes: how fast they start, what two shards gain, how long the targets
of a single frame take, and whether the end of a long stream costs as much as its beginning."""
import os
import statistics
import subprocess
import time

import glint
import scenes
import timing
from glint.progress import Progress

SUITE = "--sensors lrr77-every-frame"
# What each executable gets to do with one frame: options, and the stage whose output it reads.
STARTS = {"extract": ("", 0), "ideal": (SUITE, 1), "plan": (SUITE, 1), "sensor": ("", 2),
          "sensor-perfect": ("", 2), "noise": ("", 3), "noise-gauss": ("", 3),
          "noise-none": ("", 3), "summary": ("", 4), "view": ("", 4)}
TENTHS = 10


def one_frame(glint, folder):
    """The stages of a chain over one frame, and the files that they write."""
    commands = scenes.commands("highway", 20, 1, 1, "default")
    files = []
    for number, command in enumerate(commands):
        path = os.path.join(folder, f"one-{number}.jsonl")
        text = " ".join([command] + files[-1:] + ["-o", path])
        subprocess.run([glint, "-c", text], check=True)
        files.append(path)
    return commands, files


def start_commands(glint, folder):
    """{executable: (command, frames)}; an executable that is not known here is asked for its version."""
    bin_folder = os.path.dirname(glint)
    commands, files = one_frame(glint, folder)
    found = {"true": (["true"], 0), "glint": ([glint, "-c", " | ".join(commands)], 1)}
    for program in sorted(os.listdir(bin_folder)):
        path, name = os.path.join(bin_folder, program), program[len("glint-"):]
        if name == "traffic":
            found[program] = [path] + commands[0].split()[1:], 1
        elif name == "traffic-random":
            found[program] = [path, "--frames", "1"], 1
        elif name in STARTS:
            words, stage = STARTS[name]
            found[program] = [path] + words.split() + [files[stage]], 1
        elif program != "glint":
            found[program] = [path, "--version"], 0
    return found


def start_lines(options, folder):
    """Times from start to end over one frame, documents included; `true` is the time of any process."""
    commands, samples = start_commands(options.glint, folder), {}
    for _ in range(4 * options.repeat):
        for program, (command, _) in commands.items():
            told = timing.spent(command)["spent"]
            samples.setdefault(program, []).append((told["wall_ns"], told["cpu_ns"]))
    for program, values in samples.items():
        walls, cpus = zip(*values)
        yield ({"start": program, "frames": commands[program][1]} | timing.spread(walls, "ns")
               | {"cpu_ns": round(statistics.median(cpus))})


def shard_lines(options, folder, frames=1000, reads=15):
    """Times of one process over a stream of frames, and of two processes over half of it each."""
    source, *stages = scenes.commands("highway", 20, 1, frames, "default")
    lines = os.path.join(folder, "shards.jsonl")
    subprocess.run([options.glint, "-c", f"{source} -o {lines}"], check=True)

    def run(times):
        text = " | ".join([" ".join([stages[0]] + [lines] * times)] + stages[1:])
        return f"{options.glint} -c '{text}'"
    commands = {"one": run(2 * reads), "two": f"{run(reads)} & other=$!; {run(reads)} && wait $other"}
    samples = {"one": [], "two": []}
    for _ in range(options.repeat):
        for name, command in commands.items():
            told = timing.spent(["bash", "-c", command])["spent"]
            samples[name].append(told["wall_ns"] / (2 * reads * frames))
    for name, values in samples.items():
        yield {"shards": name} | timing.spread(values)


def trips(commands, lines):
    """Nanoseconds from writing each frame to having its targets, if each waits for those of the one before."""
    processes, took = pipe(commands, subprocess.PIPE), []
    first, last = processes[0].stdin, processes[-1].stdout
    for line in lines:
        begin = time.perf_counter_ns()
        first.write(line)
        first.flush()
        last.readline()
        took.append(time.perf_counter_ns() - begin)
    first.close()
    if any(process.wait() != 0 for process in processes):
        raise SystemExit("bench: a stage of the round trip failed")
    return took


def round_trip_lines(options, folder, frames=1000):
    """Wall times of the way there and back of a simulator in the loop, through processes and through one."""
    source, *stages = scenes.commands("highway", 20, 1, frames, "default")
    path = os.path.join(folder, "trips.jsonl")
    subprocess.run([options.glint, "-c", f"{source} -o {path}"], check=True)
    with open(path, "rb") as file:
        lines = file.readlines()
    programs = [[os.path.join(os.path.dirname(options.glint), word) if at == 0 else word
                 for at, word in enumerate(stage.split())] for stage in stages]
    for mode, commands in (("fused", [[options.glint, "-c", " | ".join(stages)]]), ("piped", programs)):
        took = trips(commands, lines)
        yield {"round_trip": mode, "processes": len(commands)} | spread_of(took)
    yield from loop_lines(options.glint, folder)


def loop_lines(glint_program, folder, frames=500):
    """Times of glint.Loop with a crowd: 100 objects on a highway under ten radars, with JSON on both sides."""
    path, suite = os.path.join(folder, "crowd.jsonl"), scenes.ten_radars()
    subprocess.run([glint_program, "-c", f"{scenes.commands('highway', 100, 1, frames, 'default')[0]} -o {path}"], check=True)
    chain = f"glint-extract | glint-ideal --sensors {suite} | glint-sensor --sensors {suite} | glint-noise --sensors {suite}"
    for mode, fused in (("loop of ten radars and 100 objects", True), ("the same, a process for each stage", False)):
        took = []
        with glint.Loop(chain, fused=fused) as loop:
            for frame in glint.frames(path):
                begin = time.perf_counter_ns()
                loop.send(frame)
                took.append(time.perf_counter_ns() - begin)
            yield {"round_trip": mode, "processes": len(loop.processes)} | spread_of(took)


def spread_of(took):
    took = sorted(took)
    return {"ns": took[len(took) // 2], "p99_ns": took[len(took) * 99 // 100], "max_ns": took[-1]}


def seen(processes):
    """CPU time so far, and resident memory now, of running processes together."""
    cpu_ns = resident_kB = 0
    for process in processes:
        with open(f"/proc/{process.pid}/schedstat") as file:
            cpu_ns += int(file.read().split()[0])
        with open(f"/proc/{process.pid}/status") as file:
            fields = dict(line.split(":", 1) for line in file)
        resident_kB += int(fields.get("VmRSS", "0 kB").split()[0])
    return cpu_ns, resident_kB


def follow(processes, frames):
    """Reads the output of the last process; (CPU, memory) at the end of every tenth but the last, after which
    there may be no process to ask."""
    found, done, progress = [(0, 0)], 0, Progress("frames", frames)
    while chunk := os.read(processes[-1].stdout.fileno(), 1 << 20):
        done += chunk.count(b"\n")
        progress.step(chunk.count(b"\n"))
        if len(found) < TENTHS and done >= len(found) * frames // TENTHS:
            found.append(seen(processes))
    progress.end()
    if done != frames or any(process.wait() != 0 for process in processes):
        raise SystemExit(f"bench: {done} frames came out of {frames}")
    return found


def pipe(commands, source=subprocess.DEVNULL):
    processes = []
    for command in commands:
        before = processes[-1].stdout if processes else source
        processes.append(subprocess.Popen(command, stdin=before, stdout=subprocess.PIPE))
        if len(processes) > 1:
            before.close()
    return processes


def stream_lines(options, _):
    """Lines about the platoon, in which everyone has the ego's speed, in so many frames, fused and piped."""
    commands = scenes.commands("platoon", 20, 1, options.stream, "default")
    fused = [subprocess.Popen([options.glint, "-c", " | ".join(commands)], stdout=subprocess.PIPE)]
    for mode, processes in (("fused", fused), ("piped", None)):
        found = follow(processes or pipe([command.split() for command in commands]), options.stream)
        for tenth in range(1, len(found)):
            cpu_ns = (found[tenth][0] - found[tenth - 1][0]) / (options.stream / TENTHS)
            yield {"stream": options.stream, "mode": mode, "tenth": tenth, "cpu_ns_per_frame": round(cpu_ns),
                   "resident_kB": found[tenth][1]}
