"""scripts/bench --guard: the part of the bench that a test can rely on, as it measures no time.

Instructions and bytes per frame of a few chains, of an object at the start and of a drawn scene. Instructions must be within 3 % of tests/speed/instructions.json, where
machine, compiler, its options and C library are those of the record; elsewhere they are only printed. A gain beyond
that fails too: --renew writes down what this build takes, there and in the table of README.md. However often it is
renewed, none may take more than its share (MOST) of the instructions in tests/speed/fixed.json, those of one
commit, which nothing writes. No chain may allocate anything after its first frames, anywhere. A chain that ends in
tables takes at most 1.5 times the instructions of one that ends in lines, 1,000 objects with ghosts at most 20 times
those without. Leaving out effects saves as much at the intersection as the pages say.
"""
import json
import os
import re
import subprocess

import counts
import effects
import scenes
from glint.progress import say

RECORD = os.path.join("tests", "speed", "instructions.json")
FIXED = os.path.join("tests", "speed", "fixed.json")
PAGE = os.path.join("tests", "speed", "README.md")
BUDGET = 0.03
LABELS = "highway-20x1, default, fused"
MOST = {LABELS: 0.95, "highway-20x1, full, fused": 0.75, "highway-20x1, full, all, fused": 0.5}
MOST_OTHERS = 1.02
FRAMES = 12
TABLES_SHARE = 1.5
GHOSTS_SHARE = 20
LEAST_GAIN = 2.2
CHAINS = [("highway", 20, 1, "default"), ("highway", 20, 1, "paper"), ("highway", 20, 1, "account"),
          ("intersection", 20, 4, "default"), ("in-view", 100, 1, "default"),
          ("highway", 20, 1, "full"), ("highway", 20, 1, "full, all")]
PIPED = CHAINS[0]
RELEASE = os.path.join("build-release", "bin", "glint")
RELEASE_CHAINS = [CHAINS[i] for i in (0, 2, 3, 5)]
RELEASE_SHARE = 0.92
RELEASE_MOST = 0.87
KINDS = ("instructions_per_frame", "bytes_per_frame")


def chains(glint, folder):
    """The chains whose instructions are counted: {name: job}."""
    found = {}
    for scene in CHAINS:
        for mode, job in counts.jobs(glint, scene[:3], FRAMES, scene[3], folder).items():
            if mode == "fused" or scene == PIPED:
                found["{}-{}x{}, {}, {}".format(*scene, mode)] = job
    return found


def differences():
    """What runs take beyond shorter ones: {name: (pipeline, longer pipeline, how many units longer)}."""
    start = [f"glint-traffic {scenes.write_scene('highway', count, 1)}" for count in (500, 1000)]
    drawn = [f"glint-traffic {scenes.write_drawn()} --scenes 0:{count}" for count in (20, 60)]
    return {"highway, an object at the start": (*start, 500), "highway-20, a drawn scene": (*drawn, 40)}


def per_unit(few, many, units):
    return round((many - few) / units, 3)


def measure(glint, folder):
    """Instructions and bytes of all that is held to the records: {kind: {name: number}}."""
    jobs, pairs_ = chains(glint, folder), differences()
    found = counts.side_by_side(lambda job: round(counts.instructions(glint, job)["all"], 3), jobs.values())
    found = {"instructions_per_frame": dict(zip(jobs, found)),
             "bytes_per_frame": {name: size(glint, job) for name, job in jobs.items()}}
    for name, (few, many, units) in pairs_.items():
        found["instructions_per_frame"][name] = per_unit(*counts.side_by_side(lambda text: whole(glint, text), (few, many)), units)
        found["bytes_per_frame"][name] = per_unit(len(written(glint, (few, os.devnull))), len(written(glint, (many, os.devnull))), units)
    return found


def pairs(glint, folder):
    """The chains whose allocations are counted, over few and over more frames, made by a source and read from
    text: (name, job)."""
    for frames in (FRAMES, 4 * FRAMES):
        commands = scenes.commands("highway", 20, 1, frames, "account")
        lines = os.path.join(folder, f"lines-{frames}.jsonl")
        subprocess.run([glint, "-c", f"{commands[0]} -o {lines}"], check=True)
        yield "made", (" | ".join(commands), os.devnull)
        yield "read", (" | ".join(commands[1:]), lines)


def growing(glint, folder):
    """A line for each chain that allocates after its first frames."""
    names, jobs = zip(*pairs(glint, folder))
    counted = counts.side_by_side(lambda job: counts.allocations(glint, job), jobs)
    return [f"frames {name}: {few} allocations in {FRAMES} frames, {many} in {4 * FRAMES}"
            for name, few, many in zip(names, counted[:2], counted[2:]) if few != many]


def tables_share(glint, folder):
    """The instructions of a chain that writes tables, over those of the chain that writes lines."""
    text = " | ".join(scenes.commands("intersection", 20, 4, counts.FIRST + FRAMES + 1, "account"))
    lines, tables = counts.side_by_side(lambda job: counts.instructions(glint, job)["all"], [
        (text, os.devnull), (f"{text} | glint-tables --plain {folder}", os.devnull)])
    return tables / lines


def effects_gain(glint, folder):
    """The instructions of all effects at the intersection, over those of the effects that it calls for."""
    path = os.path.join(folder, "rain")
    effects.write_frames(glint, effects.SCENES["intersection"], path)
    every, needed = counts.side_by_side(lambda words: effects.instructions(glint, path, words)["end to end"],
                                        ["all", "auto"])
    return every / needed


def ghosts_share(glint):
    """The instructions of 1,000 objects with ghosts, over those without."""
    texts = [" | ".join(scenes.commands("highway", 1000, 1, counts.FIRST + 3, labels)) for labels in ("full", "default")]
    full, plain = counts.side_by_side(lambda text: counts.instructions(glint, (text, os.devnull))["all"], texts)
    return full / plain


def whole(glint, text):
    """Instructions of a whole run, whatever functions its compiler has joined."""
    told = counts.run("cachegrind", glint, (text, os.devnull), "--cache-sim=no", "--cachegrind-out-file=/dev/null")
    return int(re.search(r"I +refs: +([\d,]+)", told)[1].replace(",", ""))


def release(options, _):
    """Prints what the build of `make release` takes of the instructions of this one, and for labels of those of the
    fixed commit; the exit status is 1 where it takes more than RELEASE_SHARE, or there RELEASE_MOST."""
    if not counts.available():
        return 0
    shares, fixed = [], read(FIXED)
    for scene in RELEASE_CHAINS:
        texts = [" | ".join(scenes.commands(*scene[:3], frames, scene[3])) for frames in (counts.FIRST, counts.FIRST + FRAMES)]
        few, many, fast_few, fast_many = counts.side_by_side(
            lambda job: whole(*job), [(binary, text) for binary in (options.glint, RELEASE) for text in texts])
        shares.append((fast_many - fast_few) / (many - few))
        say("{:16.3f}   {}-{}x{}, {}".format(shares[-1], *scene))
    since = shares[0] * read(RECORD)[KINDS[0]][LABELS] / fixed[KINDS[0]][LABELS]
    say(f"{since:16.3f}   the first of them, of {fixed['commit']}")
    return 1 if max(shares) > RELEASE_SHARE or since > RELEASE_MOST else 0


def written(glint, job):
    """What a chain writes."""
    with open(job[1]) as lines:
        return subprocess.run([glint, "-c", job[0]], check=True, stdin=lines, stdout=subprocess.PIPE).stdout


def size(glint, job):
    """Bytes per frame of it."""
    text = written(glint, job)
    return round(len(text) / text.count(b"\n"), 3)


def row(name, found, fixed):
    """A line of the table of README.md."""
    cells = [f"{found[kind][name]:16,.0f} {100 * (found[kind][name] / fixed[kind][name] - 1):+7.1f} %" for kind in KINDS]
    return f"{''.join(cells)}   {name}"


def printed(found, fixed):
    """All lines of the table."""
    heading = f"{'instructions':>16} {'since':>9}{'bytes':>16} {'since':>9}   a frame"
    return [heading, *(row(name, found, fixed) for name in found[KINDS[0]])]


def check(page):
    """True if a page has the table of the record."""
    return all(line in page.splitlines() for line in printed(read(RECORD), read(FIXED)))


def off_record(found, record):
    """A line for every chain that takes more or less than in the record."""
    for name, count in found.items():
        before = record.get(name)
        if before is None or abs(count / before - 1) > BUDGET:
            yield f"{name}: {count:,.0f} instructions; the record has {before}. If meant: scripts/bench --guard --renew"


def over_share(found, fixed):
    """A line for all that takes more than its share of the fixed commit."""
    for name, count in found.items():
        most = MOST.get(name, MOST_OTHERS)
        if count > most * fixed["instructions_per_frame"][name]:
            yield f"{name}: {count / fixed['instructions_per_frame'][name]:.3f} of {fixed['commit']}; expected at most {most}"


def held_ratios(glint, folder):
    """Prints ratios that hold on every machine, and yields a line for each that does not."""
    for about, share, least, most in (
            ("tables to lines", tables_share(glint, folder), 0, TABLES_SHARE),
            ("1,000 objects with ghosts to those without", ghosts_share(glint), 0, GHOSTS_SHARE),
            ("all effects to those that the intersection calls for", effects_gain(glint, folder), LEAST_GAIN, 9)):
        say(f"{share:16.2f}   {about}")
        if not least <= share <= most:
            yield f"{about}: {share:.2f}; expected {least} to {most}"


def read(path):
    with open(path) as file:
        return json.load(file)


def write(record, fixed):
    """Takes down the record, in its file and in README.md."""
    with open(RECORD, "w") as out:
        json.dump(record, out, indent=2)
        out.write("\n")
    with open(PAGE) as file:
        page = file.read()
    start = page.index("    instructions ")
    end = page.index("\n\n", start)
    with open(PAGE, "w") as out:
        out.write(page[:start] + "\n".join(printed(record, fixed)) + page[end:])


def run(options, folder):
    """Runs the guard; returns the exit status."""
    if not counts.available():
        return 0
    record, fixed, platform = read(RECORD), read(FIXED), counts.platform(options.glint)
    found = measure(options.glint, folder)
    say("\n".join(printed(found, fixed)))
    faults = [*growing(options.glint, folder), *held_ratios(options.glint, folder)]
    foreign = [key for key, value in platform.items() if fixed[key] != value]
    if foreign:
        say(f"not held to the records, which are of another {', '.join(foreign)}")
    else:
        faults += over_share(found[KINDS[0]], fixed)
        faults += [] if options.renew else off_record(found[KINDS[0]], record[KINDS[0]])
    for fault in faults:
        say(f"bench: {fault}")
    if options.renew:
        write(platform | found, fixed)
    return 1 if faults else 0
