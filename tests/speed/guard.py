"""scripts/bench --guard: the part of the bench that a test can rely on, as it measures no time.

Instructions per frame of a few chains must be within 3 % of tests/speed/instructions.json where machine,
compiler, its options and C library are those of the record; elsewhere they are only printed. A gain beyond
that fails too: --renew writes down the instructions of this build. No chain may allocate anything after its
first frames, anywhere. A chain that ends in tables takes at most 1.5 times the instructions of one that ends in lines.
Leaving out effects saves more than half of the instructions at the intersection, as README.md says.
"""
import json
import os
import subprocess

import counts
import effects
import scenes

RECORD = os.path.join("tests", "speed", "instructions.json")
BUDGET = 0.03
FRAMES = 12
TABLES_SHARE = 1.5
LEAST_GAIN = 2
CHAINS = [("highway", 20, 1, "default"), ("highway", 20, 1, "account"),
          ("intersection", 20, 4, "default"), ("in-view", 100, 1, "default")]
PIPED = CHAINS[0]


def chains(glint, folder):
    """The chains whose instructions are counted: {name: job}."""
    found = {}
    for scene in CHAINS:
        for mode, job in counts.jobs(glint, scene[:3], FRAMES, scene[3], folder).items():
            if mode == "fused" or scene == PIPED:
                found["{}-{}x{}, {}, {}".format(*scene, mode)] = job
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


def compare(found, record):
    """A line for every chain, and the names of the chains that leave the budget."""
    outside = []
    for name, count in found.items():
        before = record.get(name)
        change = f"{count / before - 1:+8.2%}" if before else "     new"
        print(f"{count:14,.0f} {change}  {name}")
        if before is None or abs(count / before - 1) > BUDGET:
            outside.append(name)
    return outside


def write(record):
    with open(RECORD, "w") as out:
        json.dump(record, out, indent=2)
        out.write("\n")


def run(glint, renew, folder):
    """Runs the guard; returns the exit status."""
    if not counts.available():
        return 0
    with open(RECORD) as file:
        record = json.load(file)
    platform, jobs = counts.platform(glint), chains(glint, folder)
    found = counts.side_by_side(lambda job: round(counts.instructions(glint, job)["all"], 3),
                                jobs.values())
    found = dict(zip(jobs, found))
    print("instructions per frame, next to the record")
    outside = compare(found, record["instructions_per_frame"])
    grown = growing(glint, folder)
    share = tables_share(glint, folder)
    print(f"tables take {share:.2f} times the instructions of lines")
    if share > TABLES_SHARE:
        grown.append(f"tables take {share:.2f} times the instructions of lines; at most {TABLES_SHARE} are expected")
    gain = effects_gain(glint, folder)
    print(f"leaving out effects saves a factor of {gain:.2f}")
    if gain < LEAST_GAIN:
        grown.append(f"leaving out effects saves a factor of {gain:.2f}; at least {LEAST_GAIN} is expected")
    for told in grown:
        print(f"bench: {told}")
    foreign = [key for key, value in platform.items() if record[key] != value]
    if renew:
        write(platform | {"instructions_per_frame": found})
    elif foreign:
        print(f"not held to the record, which is of another {', '.join(foreign)}")
    elif outside:
        print(f"bench: more than {BUDGET:.0%} off: {'; '.join(outside)}\n"
              "Where this is meant: scripts/bench --guard --renew")
    return 1 if grown or (outside and not foreign and not renew) else 0
