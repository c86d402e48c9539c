"""Instructions and allocations per frame as valgrind counts them. They repeat to the digit, so they may decide a
test where time never may.

Start-up, documents and the growth of buffers belong to the first frames and are left out (jansson hashes by a
random seed, so reading documents does not repeat). The C library picks its string functions by CPU; here it
is held to those that every x86-64 has.
"""
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import tempfile

import scenes
from glint.progress import Progress

SAME_HEAP = os.path.join("build", "tests", "speed", "same_heap.so")
ENVIRONMENT = {
    "LD_PRELOAD": SAME_HEAP, "PATH": "/usr/bin:/bin", "LC_ALL": "C",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-AVX2_Usable,-AVX_Fast_Unaligned_Load,-ERMS,-FSRM,-BMI2,"
                      "-SSE4_2,-SSE4_1,-SSSE3,-Fast_Unaligned_Copy"}
FIRST = 6
# Functions whose inclusive counts tell the parts apart, those that visit a sensor for glint-sensor and
# glint-noise; the rest is the runner's.
PARTS = {"traffic": "traffic_next", "extract": "extract_step", "ideal": "ideal_step",
         "sensor": "sense", "noise": "list_targets", "read": "frame_text_take",
         "write": "frame_text_write"}


def available():
    if shutil.which("valgrind") is None:
        print("skipped  instructions: there is no valgrind; scripts/deps --test installs it", file=sys.stderr)
    return shutil.which("valgrind") is not None


def jobs(glint, scene, frames, labels, folder):
    """{mode: (pipeline, its input)}: the whole, and each stage but the source between its lines."""
    commands = scenes.commands(*scene, FIRST + frames + 1, labels)
    found = {"fused": (" | ".join(commands), os.devnull)}
    carried = os.devnull
    for command in commands:
        name = command.split()[0][len("glint-"):]
        if carried != os.devnull:
            found[f"piped {name}"] = (command, carried)
        handle, written = tempfile.mkstemp(dir=folder)
        with open(carried) as lines, open(handle, "w") as out:
            subprocess.run([glint, "-c", command], check=True, stdin=lines, stdout=out)
        carried = written
    return found


def run(tool, binary, job, *options):
    """The output of valgrind. The input comes on standard input, so that the name of its folder makes no
    difference."""
    text, path = job
    with open(path) as lines:
        done = subprocess.run(["valgrind", f"--tool={tool}", *options, binary, "-c", text],
                              env=ENVIRONMENT, stdin=lines, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise SystemExit(f"bench: valgrind cannot run {text}:\n{done.stderr}")
    return done.stderr


def read_dump(path):
    """Instructions of one dump of callgrind: of the whole, and of the functions of PARTS with all that they
    call."""
    parts = {function: part for part, function in PARTS.items()}
    counts, names, called = {}, {}, None
    with open(path) as file:
        for line in file:
            if line.startswith("cfn=") or line.startswith("fn="):
                number, _, name = line.split("=", 1)[1].rstrip().partition(" ")
                names.setdefault(number, name)
                if line[0] == "c":
                    called = parts.get(names[number])
            elif line.startswith("calls="):
                cost = int(next(file).split()[1])
                if called:
                    counts[called] = counts.get(called, 0) + cost
            elif line.startswith("totals:"):
                counts["all"] = int(line.split()[1])
    return counts


def instructions(binary, job):
    """Instructions per frame, from frame FIRST to the last but one: {"all": ...} and every part. Callgrind
    dumps its counts wherever a frame begins."""
    begins = "runner_next" if job[1] == os.devnull else "frame_text_take"
    with tempfile.TemporaryDirectory() as folder:
        profile = os.path.join(folder, "callgrind")
        run("callgrind", binary, job, f"--callgrind-out-file={profile}", f"--dump-before={begins}")
        frames = [read_dump(f"{profile}.{number}")
                  for number in range(FIRST + 1, len(os.listdir(folder)) - 1)]
    counts = {part: sum(frame[part] for frame in frames) / len(frames)
              for part in ["all", *PARTS] if part in frames[0]}
    counts["runner"] = 2 * counts["all"] - sum(counts.values())
    return counts


def side_by_side(count, jobs_):
    """count(job) of every job, run side by side on all processors."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(Progress("jobs").over(pool.map(count, jobs_), len(jobs_)))


def allocations(binary, job):
    told = run("memcheck", binary, job, "--leak-check=no")
    return int(re.search(r"total heap usage: ([\d,]+) allocs", told)[1].replace(",", ""))


def platform(binary):
    """What else decides the number of instructions of a frame: compiler, its options, C library."""
    told = subprocess.run(["readelf", "--debug-dump=info", "--dwarf-depth=1", binary], check=True,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
    producers = sorted(set(re.findall(r"DW_AT_producer .*: (GNU C\d.*|.*clang.*)", told)))
    libc = subprocess.run(["getconf", "GNU_LIBC_VERSION"], check=True, stdout=subprocess.PIPE,
                          text=True).stdout
    return {"machine": os.uname().machine, "compiler": "; ".join(producers).strip(), "libc": libc.strip()}


def lines(glint, chosen, folder):
    """Instructions of scenes by name. Frames are as many as make a run of callgrind a few seconds."""
    frames = {2: 30, 20: 12, 100: 6, 1000: 2}
    for name in Progress("scenes").over([*chosen] if available() else []):
        scene = chosen[name]
        for labels in ("default", "account"):
            of_modes = jobs(glint, scene, frames[scene[1]], labels, folder)
            found = side_by_side(lambda job: instructions(glint, job), of_modes.values())
            for mode, parts in zip(of_modes, found):
                for part, count in parts.items():
                    yield {"scene": name, "labels": labels, "mode": mode, "part": part,
                           "instructions_per_frame": round(count, 3)}
