"""Lays out a data set: which shard holds what, by which commands, and the folder that make works in."""
import json
import os
import shlex
import sys

from glint import command_line
from glint.places import SCRIPTS
from glint.sets.documents import copies, copy_documents, described, files_of, files_of_chain, program_version, suite_name
from glint.sets.durable import alone, canonical, digest_of, make_folder, remove_temporaries, sync_folder, write_whole
from glint.sets.lines import ENDINGS
from glint.sets.plan import BAD_DATA, CANNOT_CREATE, Fault, read_json, refuse, text_of
from glint.sets.rehearsal import rehearse
from glint.sets.tables import paths_of
from glint.sets.traffic import chain_of, packed, source_command, stretches_of

WORK, LAYOUT = "work", "work/layout.json"


def shard_of(stretches, split, suite, number, plan, plan_folder):
    place = f"{split}/{suite}/{number:05}"
    inputs = {name for stretch in stretches for name in files_of(stretch.source, plan_folder)}
    return {"lines": None if plan.get("lines") == "none" else place + ENDINGS[plan.get("compression", "gzip")],
            "split": split, "suite": suite, "tables": paths_of(plan, place),
            "frames": sum((stretch.end - stretch.first) * stretch.frames for stretch in stretches),
            "inputs": sorted(inputs.union(files_of_chain(plan, plan_folder))),
            "commands": [chain_of(plan, suite, source_command(plan, stretch, suite)) for stretch in stretches]}


def shards_of(plan, plan_folder):
    """All shards: of each split all suites, of each suite all seeds, of each seed all sources."""
    size, by_split = plan["frames_per_shard"], {split: [] for split in plan.get("splits", {}).get("shares", {})}
    for seed in plan.get("seeds", [1]):
        for source in plan["sources"]:
            for split, stretches in stretches_of(plan, source, seed, size, plan_folder).items():
                by_split.setdefault(split, []).extend(stretches)
    for split, stretches in by_split.items():
        refuse(not stretches, "/splits/shares" if "splits" in plan else "/sources", f"{split} gets no scene")
    return [shard_of(stretches, split, suite_name(suite), number, plan, plan_folder)
            for split, all_stretches in by_split.items() for suite in plan["suites"]
            for number, stretches in enumerate(packed(all_stretches, size))]


def lay_out(plan, plan_folder):
    """Layout and copies of a plan. The identity of the layout is a digest of all that decides the set's bytes."""
    copied, shards = copies(plan, plan_folder), shards_of(plan, plan_folder)
    inputs = sorted({name for shard in shards for name in shard["inputs"]})
    layout = {"program": program_version(), "plan": plan, "documents": described(copied),
              "inputs": described({name: name for name in inputs}, plan_folder), "shards": shards}
    layout["identity"] = digest_of(canonical(layout).encode())
    return layout, copied


# --- the folder of the set ------------------------------------------------------------------------

def word_of_make(path):
    """A path as a word of the shell, in a variable of make."""
    return shlex.quote(path).replace("$", "$$").replace("#", "$(hash)")


def makefile_of(layout, plan_folder):
    shards = layout["shards"]
    rules = "\n".join(f"part-{i}: work/part-{i}.json  # {shard['split']}/{shard['suite']}" for i, shard in enumerate(shards))
    return text_of("makefile.txt").format(name=layout["plan"]["name"], count=len(shards), rules=rules,
                           program=word_of_make(os.path.join(SCRIPTS, "dataset")),
                           plan_folder=word_of_make(plan_folder))


def read_layout(folder):
    """The layout of a folder, if it is what was written."""
    layout = read_json(os.path.join(folder, LAYOUT))
    identity = layout.pop("identity", None) if isinstance(layout, dict) else None
    if identity != digest_of(canonical(layout).encode()):
        raise Fault(BAD_DATA, f"{folder}/{LAYOUT}: not as it was written; remove the folder and make the set again")
    return layout | {"identity": identity}


def check_folder(folder, layout):
    """Refuses a folder that holds something else, or the set of another plan."""
    if os.path.exists(os.path.join(folder, LAYOUT)):
        if read_layout(folder)["identity"] != layout["identity"]:
            raise Fault(CANNOT_CREATE, f"{folder}: holds the set of another plan, other inputs or another version")
    elif os.path.isdir(folder) and set(os.listdir(folder)) - {WORK}:
        raise Fault(CANNOT_CREATE, f"{folder}: holds other files; name a new folder")


def fill_folder(layout, copied, plan_folder, folder):
    work = os.path.join(folder, WORK)
    remove_temporaries(work)
    write_whole(os.path.join(folder, LAYOUT), work, json.dumps(layout, indent=1, ensure_ascii=False) + "\n")
    copy_documents(copied, folder, work)
    for path in {path for shard in layout["shards"] for path in filter(None, (shard["lines"], *shard["tables"][:1]))}:
        make_folder(os.path.dirname(os.path.join(folder, path)))
    write_whole(os.path.join(folder, "Makefile"), work, makefile_of(layout, os.path.abspath(plan_folder)))
    sync_folder(folder)


def prepare(plan, plan_folder, folder):
    """Writes all but the shards: layout, documents, folders, and the Makefile last."""
    refuse("\n" in os.path.abspath(plan_folder), repr(plan_folder), "make takes no path with a line break")
    layout, copied = lay_out(plan, plan_folder)
    check_folder(folder, layout)
    if not os.path.exists(os.path.join(folder, LAYOUT)):
        rehearse(plan, plan_folder, copied)
    make_folder(os.path.join(folder, WORK))
    with alone(os.path.join(folder, WORK)):
        check_folder(folder, layout)
        fill_folder(layout, copied, plan_folder, folder)
    print(f"{command_line.name()}: {folder}: {len(layout['shards'])} shards; make -C {shlex.quote(folder)} -jN", file=sys.stderr)
    return layout
