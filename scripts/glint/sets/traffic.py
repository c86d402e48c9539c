"""The traffic of a data set: which split has which scenes, how they fill shards, and the commands that play them."""
import collections
import itertools
import math
import re
import shlex

from glint.sets.documents import path_of
from glint.sets.plan import BAD_DATA, FROM_FILES, Fault, is_own, kind_of, read_json, scene_of, split_of, stages_of

US = 1_000_000  # of a second
MOST_BLOCKS = 1_000_000

# Scenes [first, end) of a source, of `frames` frames each; a block of a recording is one such scene.
Stretch = collections.namedtuple("Stretch", "source seed block first end frames")


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
    begin, end = (round(source[name] * US) if name in source else None for name in ("from_s", "to_s"))
    if split := split_of(plan, source):
        return {split: (begin, end)}
    gap = round(plan["splits"]["gap_s"] * US)
    gaps = gap * (len(plan["splits"]["shares"]) - 1)
    if end - begin <= gaps:
        raise Fault(BAD_DATA, f"/splits/gap_s: gaps fill all of {source['recording']}")
    parts = shares_of(plan, begin, end - gaps)
    return {name: (part[0] + i * gap, part[1] + i * gap) for i, (name, part) in enumerate(parts.items())}


def blocks_of(source, begin, end):
    """A split of a recording as scenes of at most block_s."""
    if "block_s" not in source:
        return [] if begin is not None and begin == end else [(begin, end)]
    step = round(source["block_s"] * US)
    if (end - begin) // step > MOST_BLOCKS:
        raise Fault(BAD_DATA, f"/block_s: {source['block_s']}: more than {MOST_BLOCKS} blocks of {source['recording']}")
    return [(at, min(at + step, end)) for at in range(begin, end, step)]


def scene_frames(source, size, plan_folder):
    """How many frames a scene has at most; the size of a shard where that is drawn."""
    kind = kind_of(source)
    if kind == "random":
        return 1
    if kind == "moving":
        return max(1, math.ceil(source["seconds"] * source.get("rate_hz", 20) - 1e-9))
    path = path_of(source["scenario"], "scenario", plan_folder)
    document = read_json(path)
    try:
        drawn = isinstance(document["duration_s"], dict) or isinstance(document["rate_hz"], dict)
        return size if drawn else int(document["duration_s"] * document["rate_hz"] + 1e-9) + 1
    except (KeyError, TypeError, OverflowError) as error:
        raise Fault(BAD_DATA, f"{path}: expected a scenario with duration_s and rate_hz") from error


def stretches_of(plan, source, seed, size, plan_folder):
    """Stretches by split."""
    if kind_of(source) == "recording":
        return {split: [Stretch(source, seed, block, 0, 1, frames_of_block(source, block, size))
                        for block in blocks_of(source, *times)]
                for split, times in times_of(plan, source).items()}
    first, end = source.get("scenes", (0, source.get("frames", 1)))
    frames = scene_frames(source, size, plan_folder)
    split = split_of(plan, source)
    parts = {split: (first, end)} if split else shares_of(plan, first, end)
    return {split: [Stretch(source, seed, None, *part, frames)] for split, part in parts.items() if part[0] < part[1]}


def first_scenes(source, seed, most=8):
    first, end = source.get("scenes", (0, 1))
    return Stretch(source, seed, None, first, min(end, first + most), 1)


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


def operand(path):
    """A path that no program takes for an option."""
    return "./" + path if path.startswith("-") else path


def words_of_recording(source, block, title):
    """The end of a block is the next one's begin: the microsecond before it is the last that is played."""
    begin, end = block
    name = title + (f"@{seconds(begin)}" if begin is not None else "")
    egos = ",".join(re.sub(r"([\\,])", r"\\\1", ego) for ego in source["egos"])
    words = [operand(source["recording"]), "--ego", egos, "--scene", name]
    words += ["--from-s", seconds(begin)] if begin is not None else []
    words += ["--to-s", seconds(end - 1)] if end is not None else []
    return words + (["--rate-hz", repr(source["rate_hz"])] if "rate_hz" in source else [])


def source_words(stretch, title):
    source, kind = stretch.source, kind_of(stretch.source)
    if kind == "recording":
        return words_of_recording(source, stretch.block, title)
    scenes = ["--scenes", f"{stretch.first}:{stretch.end}"] if "scenes" in source else []
    scenes += ["--scene", title] if title != scene_of(source) else []
    if kind == "scenario":
        return [operand(source["scenario"]), *scenes]
    if kind == "random":
        frames = ["--first", str(stretch.first), "--frames", str(stretch.end - stretch.first)]
        return ["--density", source["random"], *frames, *scenes]
    rate = ["--rate-hz", repr(source["rate_hz"])] if "rate_hz" in source else []
    return ["--density", source["random"], "--seconds", repr(source["seconds"]), *scenes, *rate]


def command_words(source, words):
    """The command that plays a source."""
    program = source.get("program", "glint-traffic" if kind_of(source) in FROM_FILES else "glint-traffic-random")
    return [program, *words, *shlex.split(source.get("options", ""))]


def title_of(plan, stretch, suite):
    """How the names of scenes begin. Each scene of a set has a name of its own, also if several radars see its traffic, or
    several seeds play it; random scenes have their seed in their names anyway."""
    with_suite, with_seed = len(plan["suites"]) > 1, len(plan.get("seeds", [1])) > 1 and kind_of(stretch.source) in FROM_FILES
    return "/".join([scene_of(stretch.source), *[suite] * with_suite, *[str(stretch.seed)] * with_seed])


def source_command(plan, stretch, suite):
    words = source_words(stretch, title_of(plan, stretch, suite))
    return shlex.join(command_words(stretch.source, [*words, "--seed", str(stretch.seed)]))


def shell_of(plan):
    """The shell of the plan's pipelines: glint, in one process, or bash if the user has own stages."""
    return ["bash", "-o", "pipefail", "-c"] if any(map(is_own, stages_of(plan["chain"]))) else ["glint", "-c"]


def chain_of(plan, suite, *before):
    """The pipeline of a source and of the chain behind it, or of the chain alone. Neighbouring stages of glint run in one
    process."""
    stages = [stage for text in (*before, plan["chain"].replace("{suite}", suite)) for stage in stages_of(text)]
    if shell_of(plan)[0] == "glint":
        return " | ".join(map(shlex.join, stages))
    pieces = []
    for own, group in itertools.groupby(stages, is_own):
        texts = [shlex.join(stage) for stage in group]
        pieces += texts if own else [shlex.join(["glint", "-c", " | ".join(texts)])]
    return " | ".join(pieces)
