"""scripts/bench --sets: make on a data set beside processes that are started by hand, and the memory of its processes.

Two jobs of make are compared with two processes by hand, in rounds: each round runs every way once, and the shares of a
round are of that round alone. By hand are run

- the set's own command lines, `scripts/dataset --part N`, in two shells: what is left is the cost of make, of the
  verification and of the manifest;
- chains whose frames get the same facts from programs of every system: digests by sha256sum, compression by gzip;
  glint-summary checks and counts;
- chains that write compressed frames and no more: no digest, no count, no check.

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

SCENES, SECONDS, RATE_HZ, SUITE = 240, 20, 20, "corner77-four"
CHAIN = "glint-extract | glint-ideal --sensors {suite} --sections quality | glint-sensor | glint-noise"
DATASET = os.path.abspath(os.path.join("scripts", "dataset"))
FACTS = """rm -f {name}.a {name}.b; mkfifo {name}.a {name}.b
sha256sum <{name}.a >{name}.plain & sha256sum <{name}.b >{name}.packed &
glint -c {chain} | tee {name}.a | gzip -1 | tee {name}.b >{name}; wait"""
WAYS = ("two jobs of make", "its own command lines in two shells", "the same facts by sha256sum and gzip",
        "bare chains: no digest, no count, no check")
SHARDS = (1000, 10_000, 100_000)
SAMPLE_S = 0.01


def lay_out(folder, scenes, shards, **more):
    """A set of moving scenes; its folder."""
    place, plan = os.path.join(folder, "set"), os.path.join(folder, "plan.json")
    shutil.rmtree(place, ignore_errors=True)
    source = {"random": "medium", "seconds": SECONDS, "scenes": [0, scenes], "rate_hz": RATE_HZ}
    with open(plan, "w", encoding="utf-8") as file:
        json.dump({"name": "bench", "origin": "To be timed.", "sources": [source], "chain": CHAIN, "suites": [SUITE],
                   "frames_per_shard": scenes // shards * SECONDS * RATE_HZ} | more, file)
    subprocess.run([sys.executable, DATASET, plan, "--out", place], check=True, stderr=subprocess.DEVNULL)
    return place


def side_by_side(one, other):
    """Two scripts in two shells."""
    return ["bash", "-c", f"({one}) & other=$!; ({other}) && wait $other"]


def chain_of(half):
    source = f"glint-traffic-random --density medium --seconds {SECONDS} --scenes {half} --rate-hz {RATE_HZ}"
    return f"{source} | {CHAIN.format(suite=SUITE)}"


def commands(folder):
    """The command of each way; the first two work in a set that is laid out anew."""
    names = [os.path.join(folder, f"{part}.jsonl.gz") for part in (0, 1)]
    chains = [chain_of(half) for half in (f"0:{SCENES // 2}", f"{SCENES // 2}:{SCENES}")]
    place = lay_out(folder, SCENES, 2)
    own = f"{DATASET} --in {place} --plan-folder {folder} --part"
    counted = [shlex.quote(f"{chain} | glint-summary --complete --copy - -o {name}.txt") for chain, name in zip(chains, names)]
    return dict(zip(WAYS, (
        ["make", "-s", "-C", place, "-j2"], side_by_side(f"{own} 0", f"{own} 1"),
        side_by_side(*(FACTS.format(name=name, chain=chain) for name, chain in zip(names, counted))),
        side_by_side(*(f"glint -c {shlex.quote(f'{chain} -o {name}')}" for name, chain in zip(names, chains))))))


def shares(rounds, way, member):
    """What a way by hand takes, as a part of what make takes in the same round: 1 if make takes no more."""
    all_shares = [spent[way][member] / spent[WAYS[0]][member] for spent in rounds]
    return f"{statistics.median(all_shares):6.3f}  {min(all_shares):5.3f} to {max(all_shares):5.3f}"


def compare(folder, repeat):
    load, rounds = os.getloadavg()[0], []
    for _ in range(repeat):
        rounds.append({way: timing.spent(commands(folder)[way])["spent"] for way in WAYS})
    frames = SCENES * SECONDS * RATE_HZ
    say(f"{repeat} rounds; load of the machine before them {load:.1f}: by wall clock only an idle machine tells\n\n"
        "frames/s   CPU µs     share by CPU             by wall clock            way")
    for way in WAYS:
        wall_ns, cpu_ns = (statistics.median(spent[way][member] for spent in rounds) for member in ("wall_ns", "cpu_ns"))
        say(f"{frames / wall_ns * 1e9:8,.0f} {cpu_ns / frames / 1e3:8.1f}   {shares(rounds, way, 'cpu_ns')}   "
            f"{shares(rounds, way, 'wall_ns')}   {way}")


# --- memory ---------------------------------------------------------------------------------------

def kind_of(words):
    """How a process of make is called: the program, and what scripts/dataset is to do."""
    if DATASET not in words:
        return os.path.basename(words[0])
    return "dataset " + next(word for word in words if word in ("--verify", "--part", "--finish"))


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
        place = lay_out(folder, 1, 1, sources=[source_of(frames)], frames_per_shard=frames, tables=True)
        columns.append(peaks(["make", "-s", "-C", place, "-j2"]))
    say(f"\npeak MB of each process, by frames of a shard with tables, {title}\n"
        f"{'':16}" + "".join(f"{frames:10,}" for frames in SHARDS))
    for kind in sorted(set().union(*columns)):
        say(f"{kind:16}" + "".join(f"{column.get(kind, 0) / 1e3:10.1f}" for column in columns))


def run(glint, folder, repeat):
    os.environ["BUILD"] = os.path.dirname(os.path.dirname(os.path.abspath(glint)))
    compare(folder, repeat)
    measure_memory(folder, "in scenes of 100 frames", of_scenes)
    measure_memory(folder, "in snapshots, each of them a scene", of_snapshots)
