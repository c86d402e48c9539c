"""Lays out a data set: which shard holds what, by which commands, from which documents."""
import collections
import json
import os
import re
import shlex
import shutil
import subprocess
import sys

from durable import (canonical, digest_of, digest_of_file, make_folder, remove_temporaries, sync_folder, whole_file,
                     write_whole)
from plan import (BAD_DATA, CANNOT_CREATE, FROM_FILES, NO_INPUT, ROOT, Fault, check_once, kind_of, read_json,
                  scene_of)

BIN = os.path.join(ROOT, os.environ.get("BUILD", "build"), "bin")
US = 1_000_000  # of a second
KINDS = {"recording": "trajectories", "scenario": "scenarios", "suite": "sensors"}
WORK, DOCUMENTS, LAYOUT = "work", "documents", "work/layout.json"

# Scenes [first, end) of a source, of `frames` frames each; a block of a recording is one such scene.
Stretch = collections.namedtuple("Stretch", "source seed block first end frames")


# --- documents ------------------------------------------------------------------------------------

def data_folders():
    """Where names of documents are looked up, as glint does."""
    return [folder for folder in (os.environ.get("GLINT_DATA"), os.path.join(ROOT, "data")) if folder]


def path_of(word, kind, plan_folder):
    """The file of a name or path."""
    if "/" in word or "." in word:
        found = [os.path.join(plan_folder, word)]
    else:
        found = [os.path.join(folder, KINDS[kind], word + ending) for folder in data_folders()
                 for ending in (".json", ".csv", ".csv.gz")]
    for path in found:
        if os.path.isfile(path):
            return path
    raise Fault(NO_INPUT, f"{kind} {word}: {' and '.join(found)}: no such file")


def is_name(word):
    return "/" not in word and "." not in word


def suite_name(word):
    return os.path.splitext(os.path.basename(word))[0]


def copies_of_suites(plan, plan_folder):
    for word in plan["suites"]:
        path = path_of(word, "suite", plan_folder)
        yield f"{DOCUMENTS}/sensors/{suite_name(word)}.json", path
        for sensor in read_json(path).get("sensors", []):
            table = sensor.get("antenna_table", "")
            if "/" in table:
                yield os.path.normpath(f"{DOCUMENTS}/sensors/{table}"), os.path.join(os.path.dirname(path), table)


def copies_of_vehicles(plan, plan_folder):
    """All of them, as traffic may have any class. The user's own stand before the shipped ones."""
    folders = [os.path.join(folder, "vehicles") for folder in reversed(data_folders())]
    if "vehicles" in plan:
        folders.append(os.path.join(plan_folder, plan["vehicles"]))
        if not os.path.isdir(folders[-1]):
            raise Fault(NO_INPUT, f"/vehicles: {folders[-1]}: no such folder")
    found = {name: os.path.join(folder, name) for folder in folders if os.path.isdir(folder)
             for name in os.listdir(folder) if name.endswith(".json")}
    for name, path in found.items():
        yield f"{DOCUMENTS}/vehicles/{name}", path


def copies_of_traffic(plan, plan_folder):
    """What has a name; what has a path is read where it lies."""
    for source in plan["sources"]:
        kind = kind_of(source)
        if kind in FROM_FILES and is_name(source[kind]):
            path = path_of(source[kind], kind, plan_folder)
            yield f"{DOCUMENTS}/{KINDS[kind]}/{os.path.basename(path)}", path


def copies(plan, plan_folder):
    """What the set gets copies of: file by the path that it gets in the set."""
    found = {}
    for copies_of in (copies_of_suites, copies_of_vehicles, copies_of_traffic):
        for name, path in copies_of(plan, plan_folder):
            if digest_of_file(found.setdefault(name, path)) != digest_of_file(path):
                raise Fault(BAD_DATA, f"{path} and {found[name]} would get one name in the set: {name}")
    return dict(sorted(found.items()))


def files_of(source, plan_folder):
    """Paths, from the plan's folder, of the files that a source reads there: traffic, its meta files, options' files."""
    kind = kind_of(source)
    words = shlex.split(source.get("options", "").replace("=", " "))
    names = [word for word in words if not is_name(word) and os.path.isfile(os.path.join(plan_folder, word))]
    if kind in FROM_FILES and not is_name(source[kind]):
        names.append(source[kind])
        folder, name = os.path.split(source[kind])
        recorded = re.fullmatch(r"(.*)_tracks\.csv(\.gz)?", name)
        beside = os.listdir(os.path.join(plan_folder, folder)) if recorded else []
        names += [os.path.join(folder, other) for other in beside
                  if re.fullmatch(re.escape(recorded[1]) + r"_(tracks|recording)Meta\.csv", other)]
    return sorted(set(names))


# --- traffic --------------------------------------------------------------------------------------

def shares_of(plan, first, end):
    """The part of [first, end) of each split, in whole numbers that fill it."""
    begin, sum_, parts = first, 0, {}
    shares = plan["splits"]["shares"]
    for name, share in shares.items():
        sum_ += share
        stop = end if name == list(shares)[-1] else first + round((end - first) * sum_)
        parts[name] = (begin, stop)
        begin = stop
    return parts


def times_of(plan, source):
    """From when to when, in microseconds, each split has of a recording: shares of what the gaps leave."""
    if "from_s" not in source or "to_s" not in source:
        return {source.get("split", "all"): tuple(round(source[name] * US) if name in source else None
                                                  for name in ("from_s", "to_s"))}
    begin, end = round(source["from_s"] * US), round(source["to_s"] * US)
    if plan.get("splits", {}).get("by") != "time":
        return {source.get("split", "all"): (begin, end)}
    gap = round(plan["splits"]["gap_s"] * US)
    gaps = gap * (len(plan["splits"]["shares"]) - 1)
    if end - begin <= gaps:
        raise Fault(BAD_DATA, f"/splits/gap_s: gaps fill all of {source['recording']}")
    parts = shares_of(plan, begin, end - gaps)
    return {name: (part[0] + i * gap, part[1] + i * gap) for i, (name, part) in enumerate(parts.items())}


def blocks_of(source, begin, end):
    """A split of a recording as scenes of at most block_s."""
    if "block_s" not in source:
        return [(begin, end)]
    step = round(source["block_s"] * US)
    return [(at, min(at + step, end)) for at in range(begin, end, step)]


def scene_frames(source, size, plan_folder):
    """How many frames a scene has at most; the size of a shard where that is drawn."""
    kind = kind_of(source)
    if kind == "random":
        return 1
    if kind == "moving":
        return int(source["seconds"] * source.get("rate_hz", 20) + 1e-9) + 1
    document = read_json(path_of(source["scenario"], "scenario", plan_folder))
    drawn = isinstance(document["duration_s"], dict) or isinstance(document["rate_hz"], dict)
    return size if drawn else int(document["duration_s"] * document["rate_hz"] + 1e-9) + 1


def stretches_of(plan, source, seed, size, plan_folder):
    """Stretches by split."""
    if kind_of(source) == "recording":
        return {split: [Stretch(source, seed, block, 0, 1, frames_of_block(source, block, size))
                        for block in blocks_of(source, *times)]
                for split, times in times_of(plan, source).items()}
    first, end = source.get("scenes", (0, source.get("frames", 1)))
    frames = scene_frames(source, size, plan_folder)
    parts = shares_of(plan, first, end) if "splits" in plan else {"all": (first, end)}
    return {split: [Stretch(source, seed, None, *part, frames)] for split, part in parts.items() if part[0] < part[1]}


def frames_of_block(source, block, size):
    """How many frames a block has; the size of a shard where nobody says so."""
    if "rate_hz" not in source or None in block or source["egos"] == ["all"]:
        return size
    return max(1, round((block[1] - block[0]) / US * source["rate_hz"]) * len(source["egos"]))


def packed(stretches, size):
    """The stretches, cut and joined to shards of at most `size` frames; one scene is never cut."""
    shard, room = [], size
    for stretch in stretches:
        while stretch.first < stretch.end:
            if shard and stretch.frames > room:
                yield shard
                shard, room = [], size
            count = min(stretch.end - stretch.first, max(1, room // stretch.frames))
            shard.append(stretch._replace(end=stretch.first + count))
            room -= count * stretch.frames
            stretch = stretch._replace(first=stretch.first + count)
    if shard:
        yield shard


# --- commands -------------------------------------------------------------------------------------

def seconds(time_us):
    """A time as text, exact."""
    sign, whole = "-" * (time_us < 0), abs(time_us)
    return f"{sign}{whole // US}.{whole % US:06}".rstrip("0").rstrip(".")


def text_of(value):
    """The shortest text that reads back to the same number."""
    return repr(value)


def words_of_recording(stretch):
    """The end of a block is the next one's begin: the microsecond before it is the last that is played."""
    source, (begin, end) = stretch.source, stretch.block
    name = scene_of(source) + (f"@{seconds(begin)}" if begin is not None else "")
    words = [source["recording"], "--ego", ",".join(source["egos"]), "--scene", name]
    words += ["--from-s", seconds(begin)] if begin is not None else []
    words += ["--to-s", seconds(end - 1)] if end is not None else []
    return words + (["--rate-hz", text_of(source["rate_hz"])] if "rate_hz" in source else [])


def source_words(stretch):
    source, kind = stretch.source, kind_of(stretch.source)
    if kind == "recording":
        return words_of_recording(stretch)
    scenes = ["--scenes", f"{stretch.first}:{stretch.end}"] if "scenes" in source else []
    if kind == "scenario":
        return [source["scenario"], *scenes]
    if kind == "random":
        return ["--density", source["random"], "--first", str(stretch.first), "--frames", str(stretch.end - stretch.first)]
    rate = ["--rate-hz", text_of(source["rate_hz"])] if "rate_hz" in source else []
    return ["--density", source["random"], "--seconds", text_of(source["seconds"]), *scenes, *rate]


def source_command(stretch):
    source = stretch.source
    program = source.get("program", "glint-traffic" if kind_of(source) in FROM_FILES else "glint-traffic-random")
    more = shlex.split(source.get("options", ""))
    return shlex.join([program, *source_words(stretch), "--seed", str(stretch.seed), *more])


def command_of(stretch, chain):
    return f"{source_command(stretch)} | {chain}"


# --- shards ---------------------------------------------------------------------------------------

def table_names():
    return list(read_json(os.path.join(ROOT, "schemas", "tables.json")))


def shard_of(stretches, split, suite, number, plan, plan_folder):
    place = f"{split}/{suite}/{number:05}"
    return {"path": place + ".jsonl.gz", "split": split, "suite": suite,
            "tables": [f"{place}/{name}.csv.gz" for name in table_names() if plan.get("tables")],
            "inputs": sorted({name for stretch in stretches for name in files_of(stretch.source, plan_folder)}),
            "commands": [command_of(stretch, plan["chain"].replace("{suite}", suite)) for stretch in stretches]}


def shards_of(plan, plan_folder):
    """All shards: of each split all suites, of each suite all seeds, of each seed all sources."""
    size, by_split = plan["frames_per_shard"], {}
    for split in plan.get("splits", {}).get("shares", {}):
        by_split[split] = []
    for seed in plan.get("seeds", [1]):
        for source in plan["sources"]:
            for split, stretches in stretches_of(plan, source, seed, size, plan_folder).items():
                by_split.setdefault(split, []).extend(stretches)
    return [shard_of(stretches, split, suite_name(suite), number, plan, plan_folder)
            for split, all_stretches in by_split.items() for suite in plan["suites"]
            for number, stretches in enumerate(packed(all_stretches, size))]


def program_version():
    done = subprocess.run([os.path.join(BIN, "glint"), "--version"], check=True, stdout=subprocess.PIPE, text=True)
    return done.stdout.strip()


def described(files, folder=""):
    """Size and digest of files, by the names that they have in the set or from the plan's folder."""
    return [{"path": name, "bytes": os.path.getsize(os.path.join(folder, path)),
             "hash": digest_of_file(os.path.join(folder, path))} for name, path in files.items()]


def lay_out(plan, plan_folder):
    """Layout and copies of a plan. The identity of the layout is a digest of all that decides the set's bytes."""
    check_once(plan, lambda word, kind: path_of(word, kind, plan_folder), digest_of_file)
    copied, shards = copies(plan, plan_folder), shards_of(plan, plan_folder)
    inputs = sorted({name for shard in shards for name in shard["inputs"]})
    layout = {"program": program_version(), "plan": plan, "documents": described(copied),
              "inputs": described({name: name for name in inputs}, plan_folder), "shards": shards}
    layout["identity"] = digest_of(canonical(layout).encode())
    return layout, copied


def environment(folder):
    return os.environ | {"PATH": BIN + os.pathsep + os.environ["PATH"],
                         "GLINT_DATA": os.path.abspath(os.path.join(folder, DOCUMENTS))}


def rehearse(layout, folder):
    """Sends a random frame through the chain of each suite, so that a wrong word is found before a thousand shards."""
    for suite in map(suite_name, layout["plan"]["suites"]):
        text = "glint-traffic-random --frames 1 | " + layout["plan"]["chain"].replace("{suite}", suite) + " | glint-summary"
        done = subprocess.run(["glint", "-c", text], env=environment(folder), stdout=subprocess.DEVNULL)
        if done.returncode != 0:
            raise Fault(done.returncode, f"/chain: this fails: glint -c '{text}'")


# --- the folder of the set ------------------------------------------------------------------------

MAKEFILE = """\
# The data set {name}, of {count} shards.
#   make -jN        makes what is missing, names what fails and, when all is there, writes README.md and datapackage.json
#   make part-7     makes one shard
#   make missing    names what is missing
#   make slurm      has Slurm make what is missing
dataset = {program} --in . --plan-folder {plan_folder}
MAKEFLAGS += --keep-going --no-print-directory --no-builtin-rules

all:
\t@$(dataset) --verify
\t@$(MAKE) parts; $(dataset) --finish

missing slurm:
\t@$(dataset) --$@

work/part-%.json:
\t@$(dataset) --part $*

{rules}

.PHONY: all missing slurm parts
"""


def makefile_of(layout, plan_folder):
    shards = layout["shards"]
    rules = "\n".join(f"parts part-{i}: work/part-{i}.json  # {shard['path']}" for i, shard in enumerate(shards))
    return MAKEFILE.format(name=layout["plan"]["name"], count=len(shards), rules=rules,
                           program=os.path.join(ROOT, "scripts", "dataset"), plan_folder=shlex.quote(plan_folder))


def read_layout(folder):
    """The layout of a folder, if it is what was written."""
    layout = read_json(os.path.join(folder, LAYOUT))
    identity = layout.pop("identity", None)
    if identity != digest_of(canonical(layout).encode()):
        raise Fault(BAD_DATA, f"{folder}/{LAYOUT}: not as it was written; remove the folder and make the set again")
    return layout | {"identity": identity}


def check_folder(folder, layout):
    """Refuses a folder that holds something else, or the set of another plan."""
    if os.path.exists(os.path.join(folder, LAYOUT)):
        if read_layout(folder)["identity"] != layout["identity"]:
            raise Fault(CANNOT_CREATE, f"{folder}: holds the set of another plan, of other inputs or of another version")
    elif os.path.isdir(folder) and set(os.listdir(folder)) - {WORK}:
        raise Fault(CANNOT_CREATE, f"{folder}: holds other files; name a new folder")


def prepare(plan, plan_folder, folder):
    """Writes all but the shards: layout, documents, folders, and the Makefile last."""
    layout, copied = lay_out(plan, plan_folder)
    check_folder(folder, layout)
    work = os.path.join(folder, WORK)
    make_folder(work)
    remove_temporaries(work)
    write_whole(os.path.join(folder, LAYOUT), work, json.dumps(layout, indent=1, ensure_ascii=False) + "\n")
    for name, path in copied.items():
        make_folder(os.path.dirname(os.path.join(folder, name)))
        with open(path, "rb") as source, whole_file(os.path.join(folder, name), work) as file:
            shutil.copyfileobj(source, file)
    rehearse(layout, folder)
    for path in {path for shard in layout["shards"] for path in (shard["path"], *shard["tables"][:1])}:
        make_folder(os.path.dirname(os.path.join(folder, path)))
    write_whole(os.path.join(folder, "Makefile"), work, makefile_of(layout, os.path.abspath(plan_folder)))
    sync_folder(folder)
    print(f"dataset: {folder}: {len(layout['shards'])} shards; make -C {shlex.quote(folder)} -jN", file=sys.stderr)
    return layout
