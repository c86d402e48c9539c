"""What valgrind counts: instructions and allocations per frame, which repeat to the digit, so they
may decide a test where time never may.

Start-up, documents and the growing of buffers belong to the first frames and are left out (jansson
hashes by a random seed, so reading documents does not repeat). The C library picks its string
functions by CPU; here it is held to those that every x86-64 has.
"""
import os
import re
import shutil
import subprocess
import sys

import scenes

SAME_HEAP = os.path.join("build", "tests", "speed", "same_heap.so")
ENVIRONMENT = {
    "LD_PRELOAD": SAME_HEAP, "PATH": "/usr/bin:/bin", "LC_ALL": "C",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-AVX2_Usable,-AVX_Fast_Unaligned_Load,-ERMS,-FSRM,-BMI2,"
                      "-SSE4_2,-SSE4_1,-SSSE3,-Fast_Unaligned_Copy"}
FIRST = 6
# Functions whose inclusive counts tell the parts apart; what is left is the runner's.
PARTS = {"traffic": "traffic_next", "extract": "extract_step", "ideal": "ideal_step",
         "sensor": "sensor_step", "noise": "noise_step", "read": "frame_text_read",
         "write": "frame_text_write"}


def available():
    if shutil.which("valgrind") is None:
        print("bench: no valgrind here, so no instructions; scripts/deps --test installs it",
              file=sys.stderr)
    return shutil.which("valgrind") is not None


def texts(glint, scene, frames, labels, folder):
    """(mode, pipeline): the whole, and each stage but the source between its lines."""
    commands = scenes.commands(*scene, FIRST + frames + 1, labels)
    yield "fused", " | ".join(commands)
    carried = os.path.join(folder, "0.jsonl")
    subprocess.run([glint, "-c", f"{commands[0]} -o {carried}"], check=True)
    for number, command in enumerate(commands[1:], 1):
        name = command.split()[0][len("glint-"):]
        yield f"piped {name}", f"{command} {carried}"
        written = os.path.join(folder, f"{number}.jsonl")
        subprocess.run([glint, "-c", f"{command} {carried} -o {written}"], check=True)
        carried = written


def run(tool, binary, text, *options):
    done = subprocess.run(["valgrind", f"--tool={tool}", *options, binary, "-c", text],
                          env=ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          text=True)
    if done.returncode != 0:
        raise SystemExit(f"bench: valgrind cannot run {text}:\n{done.stderr}")
    return done.stderr


def part_counts(profile):
    """The inclusive counts of one dump: of the whole and of every part that it has."""
    table = subprocess.run(["callgrind_annotate", "--auto=no", "--inclusive=yes",
                            "--threshold=100", profile], check=True, stdout=subprocess.PIPE,
                           text=True).stdout
    counts = {}
    for part, function in PARTS.items():
        found = re.search(rf"^ *([\d,]+) .*:{function} \[", table, re.M)
        if found:
            counts[part] = int(found[1].replace(",", ""))
    return counts


def total(profile):
    with open(profile) as file:
        return int(re.search(r"^totals: (\d+)", file.read(), re.M)[1])


def instructions(binary, text, folder, parts=False):
    """Per frame, from frame FIRST to the last but one: {"all": ...} and, if asked for, every part.
    Callgrind is made to dump wherever a frame begins."""
    profile = os.path.join(folder, "callgrind")
    begins = "runner_next" if "glint-traffic" in text else "runner_step"
    run("callgrind", binary, text, f"--callgrind-out-file={profile}", f"--dump-before={begins}")
    dumps = []
    while os.path.exists(f"{profile}.{len(dumps) + 1}"):
        dumps.append(f"{profile}.{len(dumps) + 1}")
    frames = dumps[FIRST:-1]
    counts = {"all": sum(map(total, frames)) / len(frames)}
    for dump in frames if parts else []:
        for part, count in part_counts(dump).items():
            counts[part] = counts.get(part, 0) + count / len(frames)
    if parts:
        counts["runner"] = 2 * counts["all"] - sum(counts.values())
    for dump in dumps + [profile]:
        os.remove(dump)
    return counts


def allocations(binary, text):
    told = run("memcheck", binary, text, "--leak-check=no")
    return int(re.search(r"total heap usage: ([\d,]+) allocs", told)[1].replace(",", ""))


def platform(binary):
    """What else decides how many instructions a frame takes: compiler, its options, C library."""
    told = subprocess.run(["readelf", "--debug-dump=info", "--dwarf-depth=1", binary], check=True,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
    producers = sorted(set(re.findall(r"DW_AT_producer .*: (GNU C\d.*|.*clang.*)", told)))
    libc = subprocess.run(["getconf", "GNU_LIBC_VERSION"], check=True, stdout=subprocess.PIPE,
                          text=True).stdout
    return {"machine": os.uname().machine, "compiler": "; ".join(producers).strip(), "libc": libc.strip()}
