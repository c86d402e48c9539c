"""Reads the plan of a data set and refuses what would leak or could not be made."""
import json
import os
import re
import shlex
import shutil

import glint
from glint import zstd
from glint.places import DATA
from glint.sets import schema

USAGE, BAD_DATA, NO_INPUT, UNAVAILABLE, CANNOT_CREATE, IO = 64, 65, 66, 69, 73, 74

# What a kind of source needs, and what it takes besides `program`, `options` and `split`.
KINDS = {"random": ({"random", "frames"}, set()),
         "moving": ({"random", "seconds", "scenes"}, {"rate_hz"}),
         "scenario": ({"scenario"}, {"scenes"}),
         "recording": ({"recording", "egos", "licence", "source"},
                       {"scene", "from_s", "to_s", "block_s", "rate_hz"})}
FROM_FILES = ("scenario", "recording")
# How a kind can be split.
SPLIT_BY = {"random": {"scene", "kind"}, "moving": {"scene", "kind"}, "scenario": {"scene", "kind"},
            "recording": {"time", "recording", "kind"}}
HIGHEST_LEVEL = {"gzip": 9, "zstd": 19}
OWN_FOLDERS = ("documents", "work")
# Options of sources that the plan's own members give.
OWN_OPTIONS = {"--first", "--frames", "--density", "--seed", "--scene", "--scenes", "--ego", "--from-s", "--to-s",
               "--rate-hz", "--seconds", "--output", "-o", "--complete"}
OPTIONS_OF_CHAIN = {"-o", "--output", "--seed", "--vehicles"}
LEAKS = {"ego": 'leaks: egos of one recording see the same traffic; split by "recording", or by "time" with a gap',
         "seed": 'leaks: another seed is the same traffic with other noise; split by "scene", "recording" or "time"'}


class Fault(Exception):
    """What is wrong, and the exit code that says of which kind it is (sysexits)."""

    def __init__(self, code, text):
        super().__init__(text)
        self.code = code


def refuse(condition, path, text):
    if condition:
        raise Fault(BAD_DATA, f"{path}: {text}")


def read_json(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file, object_pairs_hook=glint.once, parse_constant=glint.no_constant)
    except OSError as error:
        raise Fault(NO_INPUT, f"{path}: {error.strerror}") from error
    except json.JSONDecodeError as error:
        raise Fault(BAD_DATA, f"{path}:{error.lineno}: {error.msg}") from error
    except ValueError as error:
        raise Fault(BAD_DATA, f"{path}: {error}") from error
    except RecursionError as error:
        raise Fault(BAD_DATA, f"{path}: nested too deep") from error


def text_of(name):
    """A text of data/sets/."""
    with open(os.path.join(DATA, "sets", name), encoding="utf-8") as file:
        return file.read()


def kind_of(source):
    """The kind of a source: random snapshots, moving random scenes, a scenario or a recording."""
    kinds = [kind for kind in ("random", "scenario", "recording") if kind in source]
    if len(kinds) != 1:
        return None
    return "moving" if kinds == ["random"] and "seconds" in source else kinds[0]


def words_of(text, path, split=shlex.split):
    try:
        return split(text)
    except ValueError as error:
        raise Fault(BAD_DATA, f"{path}: {error}") from error


def check_source(source, path):
    kind = kind_of(source)
    refuse(kind is None, path, "expected one of random, scenario, recording")
    needed, taken = KINDS[kind]
    for name in sorted(needed - source.keys()):
        raise Fault(BAD_DATA, f"{path}: {name} is missing: a {kind} source needs it")
    for name in source.keys() - needed - taken - {"program", "options", "split"}:
        raise Fault(BAD_DATA, f"{path}/{name}: a {kind} source has none")
    for word in words_of(source.get("options", ""), f"{path}/options"):
        refuse(word.split("=")[0] in OWN_OPTIONS or word in "|<>&;", f"{path}/options", f"{word} is the plan's to say")
    for name in ("from_s", "to_s"):
        refuse("block_s" in source and name not in source, path, f"{name} is missing: blocks need it")
    refuse(source.get("from_s", 0) >= source.get("to_s", float("inf")), f"{path}/to_s", "expected later than from_s")
    refuse(kind == "moving" and not 1 <= source.get("rate_hz", 20) <= 10000, f"{path}/rate_hz",
           "expected a number in [1, 10000] for moving scenes")
    scenes = source.get("scenes", [0, 1])
    refuse(scenes[0] >= scenes[1], f"{path}/scenes", "expected a first scene before the last")


def stages_of(chain):
    """The stages of a chain, each as its words."""
    return words_of(chain, "/chain", glint.stages_of)


def is_own(stage):
    """True for a user's own stage, false for one of glint."""
    return not stage[0].startswith("glint-")


def check_chain(chain):
    refuse("{suite}" not in chain, "/chain", "names no suite; write --sensors {suite}")
    stages = stages_of(chain)
    for stage in filter(is_own, stages):
        refuse(not any("/" in word for word in stage), "/chain",
               f"{stage[0]!r} is no program of glint, and no file of your own: name that by a path, as ./mud.py")
    refuse(">" in chain or "<" in chain, "/chain", "redirects")
    for stage in stages:
        for word in stage:
            refuse(word.startswith("#"), "/chain", f"has a comment, {word!r}; expected the words of stages alone")
            refuse(word.split("=")[0] in OPTIONS_OF_CHAIN and not is_own(stage), "/chain", f"{word} may not be in the chain")


def check_files(plan):
    """Refuses contradictions of lines, tables and compression, and missing programs."""
    lines, compression = plan.get("lines", "whole"), plan.get("compression", "gzip")
    refuse(lines != "whole" and not plan.get("tables"), "/lines", f'"{lines}" needs tables')
    refuse(lines == "none" and "level" in plan, "/level", "a set without lines has none")
    refuse("compression" in plan and lines == "none" and plan["tables"] == "parquet", "/compression", "Parquet has its own")
    if "exports" in plan:
        refuse(plan.get("tables") is not True and lines != "whole", "/exports", "are made of tables of CSV, or of whole lines")
        refuse("quality" not in plan["chain"], "/exports", "need the quality of targets; write glint-ideal --sections quality in the chain")
    highest = HIGHEST_LEVEL[compression]
    refuse(plan.get("level", 1) > highest, "/level", f"{plan.get('level')}; expected at most {highest} for {compression}")
    if compression == "zstd" and not zstd.library():
        raise Fault(UNAVAILABLE, '/compression: "zstd" needs libzstd.so.1, which is not there; Debian\'s package is libzstd1')
    if plan.get("tables") == "parquet" and not shutil.which("duckdb"):
        raise Fault(UNAVAILABLE, '/tables: "parquet" needs the program duckdb, which is not in PATH')


def split_of(plan, source):
    """The split that has all of a source; None: its scenes or times are split."""
    return source.get("split") if "splits" in plan else "all"


def check_splits(plan):
    splits = plan.get("splits", {})
    by, shares = splits.get("by"), splits.get("shares", {})
    for i, source in enumerate(plan["sources"]):
        path, kind = f"/sources/{i}", kind_of(source)
        refuse(by and by not in SPLIT_BY[kind], path,
               f"a {kind} source cannot be split by {by}, but by {' or '.join(sorted(SPLIT_BY[kind]))}")
        refuse(by == "recording" and "split" not in source, path, "split is missing")
        refuse(by not in ("recording", "kind") and "split" in source, path, "split is for splits by recording or kind")
        refuse(shares and source.get("split", [*shares][0]) not in shares, f"{path}/split",
               f"{source.get('split')!r}; expected one of {', '.join(shares)}")
        refuse(by and split_of(plan, source) is None and kind == "scenario" and "scenes" not in source, path,
               "it is one scene, which cannot be split; scenes are missing" + ", or a split" * (by == "kind"))
        refuse(by and split_of(plan, source) is None and kind == "recording" and not {"from_s", "to_s"} <= source.keys(), path,
               "splits by time need from_s and to_s")
    refuse(by in ("scene", "time", "kind") and not shares, "/splits", "shares is missing")
    refuse(by == "recording" and shares, "/splits/shares", "the sources say their splits")
    timed = any(kind_of(source) == "recording" and split_of(plan, source) is None for source in plan["sources"])
    whole = sum(shares.values())
    refuse(shares and abs(whole - 1) > 1e-9, "/splits/shares", f"{whole} in sum; expected 1")
    refuse(timed != ("gap_s" in splits) and by, "/splits/gap_s",
           "missing: without a gap, traffic of one split is in the next" if timed else "is for splits by time")
    for name in [*shares, *(source["split"] for source in plan["sources"] if "split" in source)]:
        refuse(not re.fullmatch("[a-z0-9][a-z0-9_-]*", name), "/splits/shares", f"{name!r} is no name of a folder")
        refuse(name in OWN_FOLDERS, "/splits", f"{name!r} is a folder of every set")


def check_names(plan):
    """Refuses scenes that might have one name. By it a source's random numbers are addressed, too."""
    names = []
    for i, source in enumerate(plan["sources"]):
        name = scene_of(source)
        for j, other in enumerate(names):
            # Names of scenes go on with an ego or a number, and those of blocks with their begin.
            may_share = f"{name}/".startswith((f"{other}/", f"{other}@")) or f"{other}/".startswith((f"{name}/", f"{name}@"))
            refuse(may_share, f"/sources/{i}", f"its scenes have the names of those of /sources/{j}; give it a scene")
        names.append(name)


def scene_of(source):
    """How the names of a source's scenes begin."""
    kind = kind_of(source)
    if kind not in FROM_FILES:
        return f"{kind}-{source['random']}"
    return source.get("scene", os.path.basename(source[kind]).split(".")[0] or "scene")


def read_plan(path):
    """A plan that is right by itself; whether its traffic leaks, a rehearsal shows."""
    plan = read_json(path)
    try:
        by = plan["splits"]["by"] if isinstance(plan, dict) and isinstance(plan.get("splits"), dict) else None
        refuse(isinstance(by, str) and by in LEAKS, "/splits/by", f'"{by}" {LEAKS.get(by)}')
        if fault := schema.fault_of(plan, schema.PLAN):
            raise Fault(BAD_DATA, fault)
        for i, source in enumerate(plan["sources"]):
            check_source(source, f"/sources/{i}")
        check_chain(plan["chain"])
        check_files(plan)
        check_splits(plan)
        check_names(plan)
    except Fault as fault:
        raise Fault(fault.code, f"{path}: {fault}") from fault
    return plan
