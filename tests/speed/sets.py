"""scripts/bench --sets: what making a set costs beside the chain alone, and the memory of its processes.

A frame's cost is that of a large set less that of a small one, for each frame that the large one has more; the chain's is
measured likewise, as two processes at once write half of its lines each, like those of make -j2. Their ratio is of one
round: each round makes all sets once. The fixed cost is that of a set of four shards of one frame each, laid out and
made. Time is CPU time of all processes; no instructions are counted, as the digests use some of the processor's that
callgrind does not know.

Memory is the most that each process had, sampled while make runs, for shards of 1,000 to 100,000 frames with tables.
"""
import json
import os
import shlex
import shutil
import statistics
import subprocess
import sys
import time

import timing
from glint.progress import say

SECONDS, RATE_HZ, SUITE = 20, 20, "corner77-four"
SMALL, LARGE = 2, 22  # scenes, in two shards
CHAIN = "glint-extract | glint-ideal --sensors {suite} --sections quality | glint-sensor | glint-noise"
DATASET = os.path.abspath(os.path.join("scripts", "dataset"))
KINDS = {"lines by gzip": {}, "lines by zstd": {"compression": "zstd"}, "lines and tables by gzip": {"tables": True},
         "lines and tables by zstd": {"tables": True, "compression": "zstd"},
         "tables by zstd": {"tables": True, "compression": "zstd", "lines": "none"}}
SHARDS = (1000, 10_000, 100_000)
SAMPLE_S = 0.01


def moving(scenes):
    return {"random": "medium", "seconds": SECONDS, "scenes": [0, scenes], "rate_hz": RATE_HZ}


def write_plan(folder, source, **more):
    """A plan and the place of its set, in which there is nothing yet."""
    place, plan = os.path.join(folder, "set"), os.path.join(folder, "plan.json")
    shutil.rmtree(place, ignore_errors=True)
    with open(plan, "w", encoding="utf-8") as file:
        json.dump({"name": "bench", "origin": "To be timed.", "sources": [source], "chain": CHAIN, "suites": [SUITE]} | more, file)
    return plan, place


def lay_out(folder, source, **more):
    """A set that is laid out; its folder."""
    plan, place = write_plan(folder, source, **more)
    subprocess.run([sys.executable, DATASET, plan, "--out", place], check=True, stderr=subprocess.DEVNULL)
    return place


def cpu_s(command):
    return timing.spent(command)["spent"]["cpu_ns"] / 1e9


def made_s(folder, scenes, kind):
    """What make takes for a set of so many scenes in two shards."""
    place = lay_out(folder, moving(scenes), frames_per_shard=scenes // 2 * SECONDS * RATE_HZ, **KINDS[kind])
    return cpu_s(["make", "-s", "-C", place, "-j2"])


def chain_s(glint, folder, scenes):
    source, half = f"glint-traffic-random --density medium --seconds {SECONDS} --rate-hz {RATE_HZ} --scenes", scenes // 2
    text = f"{glint} -c '{source} %d:%d | {CHAIN.format(suite=SUITE)} -o {folder}/%d.jsonl'"
    return cpu_s(["bash", "-c", f"{text % (0, half, 0)} & {text % (half, scenes, 1)} && wait $!"])


def fixed_s(folder):
    plan, place = write_plan(folder, of_snapshots(4), frames_per_shard=1)
    return cpu_s(["bash", "-c", f"{sys.executable} {DATASET} {plan} --out {place} && make -s -C {place} -j2"])


def told(values, digits):
    return f"{statistics.median(values):.{digits}f}  {min(values):.{digits}f} to {max(values):.{digits}f}"


def compare(glint, folder, repeat):
    frames, chains, ratios, fixed = (LARGE - SMALL) * SECONDS * RATE_HZ, [], {kind: [] for kind in KINDS}, []
    for _ in range(repeat):
        chain = chain_s(glint, folder, LARGE) - chain_s(glint, folder, SMALL)
        chains.append(chain / frames * 1e6)
        fixed.append(fixed_s(folder))
        for kind, values in ratios.items():
            values.append((made_s(folder, LARGE, kind) - made_s(folder, SMALL, kind)) / chain)
    say(f"{repeat} rounds, medians of CPU time and their ranges\n"
        f"the chain alone, its lines in files, a frame        us      {told(chains, 0)}\n"
        f"a set of four shards, whatever is in them           s       {told(fixed, 2)}")
    for kind, values in ratios.items():
        say(f"a frame of a set: {kind:33} chains  {told(values, 2)}")


# --- memory ---------------------------------------------------------------------------------------

def kind_of(words):
    """How a process of make is called: the program, and what scripts/dataset is to do."""
    if DATASET not in words:
        return os.path.basename(words[0])
    return "dataset " + next(word for word in words if word in ("--make", "--part", "--finish"))


def members(session):
    """The processes of a session: what they are, and the most memory that each has had, in kB."""
    for process in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{process}/stat", encoding="utf-8") as stat:
                if int(stat.read().rsplit(") ", 1)[1].split()[3]) != session:
                    continue
            with open(f"/proc/{process}/cmdline", encoding="utf-8") as words, \
                    open(f"/proc/{process}/status", encoding="utf-8") as status:
                peak = [int(line.split()[1]) for line in status if line.startswith("VmHWM:")]
                called = words.read()
                if called and peak:  # it has not ended
                    yield kind_of(called.split("\0")), peak[0]
        except (FileNotFoundError, ProcessLookupError):
            continue


def peaks(command):
    """The most memory of any process of a command, by what the process is."""
    found = {}
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True) as process:
        while process.poll() is None:
            for kind, peak_kB in members(process.pid):
                found[kind] = max(found.get(kind, 0), peak_kB)
            time.sleep(SAMPLE_S)
    if process.returncode != 0:
        raise SystemExit(f"bench: {shlex.join(command)}: {process.returncode}")
    return found


def of_scenes(frames):
    """Moving scenes of 100 frames."""
    return {"random": "medium", "seconds": 100 / RATE_HZ, "scenes": [0, frames // 100], "rate_hz": RATE_HZ}


def of_snapshots(frames):
    return {"random": "medium", "frames": frames}


def measure_memory(folder, title, source_of):
    """A row for every process of make, a column for every size of a shard."""
    columns = []
    for frames in SHARDS:
        place = lay_out(folder, source_of(frames), frames_per_shard=frames, tables=True)
        columns.append(peaks(["make", "-s", "-C", place, "-j2"]))
    say(f"\npeak MB of each process, by frames of a shard with tables, {title}\n"
        f"{'':16}" + "".join(f"{frames:10,}" for frames in SHARDS))
    for kind in sorted(set().union(*columns)):
        say(f"{kind:16}" + "".join(f"{column.get(kind, 0) / 1e3:10.1f}" for column in columns))


def run(options, folder):
    os.environ["BUILD"] = os.path.dirname(os.path.dirname(os.path.abspath(options.glint)))
    compare(options.glint, folder, options.repeat)
    measure_memory(folder, "in scenes of 100 frames", of_scenes)
    measure_memory(folder, "in snapshots, each of them a scene", of_snapshots)
