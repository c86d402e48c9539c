"""Makes one shard of a data set, and holds those that are there to their records."""
import collections
import concurrent.futures
import contextlib
import fcntl
import functools
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile

from glint import command_line
from glint.places import GLINT
from glint.progress import Progress
from glint.sets import pace
from glint.sets.documents import environment, program_version
from glint.sets.durable import alone, digest_of_file, remove_temporaries, temporary_folder, whole_file, write_whole
from glint.sets.layout import WORK
from glint.sets.lines import Lines
from glint.sets.plan import BAD_DATA, IO, NO_INPUT, USAGE, Fault, read_json
from glint.sets.tables import PORTION, place_tables, tool_of
from glint.sets.traffic import shell_of

MANIFEST = "datapackage.json"
COPY = "/dev/fd/COPY"  # in a command: the pipe for the lines


def record_path(folder, part):
    return os.path.join(folder, WORK, f"part-{part}.json")


def runs_of(plan, shard, tool):
    """The pipelines that make a shard, as words, with the tool at the end. Tables need all frames of the shard in one run."""
    shell, commands = shell_of(plan), shard["commands"]
    if not shard["tables"] or len(commands) == 1:
        return [[*shell, f"{command} | {tool}"] for command in commands]
    joined = " && ".join(shlex.join([*shell, command]) for command in commands)
    return [["bash", "-o", "pipefail", "-c", f"{{ {joined}; }} | {tool}"]]


def counted(words, lines, folder, plan_folder):
    """Runs a pipeline that writes its lines into `lines`; returns the counts of the tool at its end. Frames without target
    lists and incomplete scenes are refused."""
    begin, end = os.pipe()
    words = [word.replace(COPY, f"/dev/fd/{end}") for word in words]
    # On a terminal glint would draw a line of progress of its own for each shard.
    with tempfile.TemporaryFile() as said, open(begin, "rb") as frames, \
            subprocess.Popen(words, cwd=plan_folder, env=environment(folder), stdin=subprocess.DEVNULL,
                             stdout=subprocess.PIPE, stderr=said, pass_fds=[end], text=True) as process:
        os.close(end)
        with contextlib.suppress(OSError):  # the system may refuse room for a portion to a user who has many pipes
            fcntl.fcntl(frames, fcntl.F_SETPIPE_SZ, PORTION)
        while portion := frames.read(PORTION):
            lines.write(portion)
        counts = process.communicate()[0]
        said.seek(0)
        sys.stderr.write(said.read().decode(errors="backslashreplace"))
    if process.returncode != 0:
        code = process.returncode
        raise Fault(code if code > 0 else 128 - code, f"exit status {code}: {shlex.join(words)}")
    return counts


def targets_by_kind(counts):
    """What glint-summary has counted: by the class of the object that made most of a target, or as ghosts and the like."""
    blocks = re.findall(r"\ntargets (?:by class|that show no object).*\n((?: .*\n)+)", counts)
    rows = re.findall(r" *(\d+) +[\d.]+ % +(.*)\n", "".join(blocks))
    return collections.Counter({name: int(count) for count, name in rows})


def rows_of_tables(counts):
    """What glint-tables has counted, by the name of the table."""
    rows = counts.partition("\nrows of tables\n")[2].split()
    return dict(zip(rows[1::2], map(int, rows[::2])))


@functools.lru_cache(maxsize=None)
def read_of_state(path, read, *_):
    return read(path)


def read_if_changed(path, read):
    """What `read` returns for the path of a file. It is called again only if the file is another one, or was written meanwhile."""
    state = os.stat(path)
    return read_of_state(path, read, state.st_dev, state.st_ino, state.st_size, state.st_mtime_ns, state.st_ctime_ns)


def check_inputs(layout, shard, folder, plan_folder):
    """The program, the copies of documents and the shard's own inputs are those of the layout."""
    program = read_if_changed(GLINT, program_version)
    if program != layout["program"]:
        raise Fault(BAD_DATA, f"the set was begun by {layout['program']}; this is {program}")
    for place, known, names in ((folder, layout["documents"], None), (plan_folder, layout["inputs"], shard["inputs"])):
        for input_ in known:
            path = os.path.join(place, input_["path"])
            if names is not None and input_["path"] not in names:
                continue
            if not os.path.isfile(path):
                raise Fault(NO_INPUT, f"{path}: no such file")
            if read_if_changed(path, digest_of_file) != input_["hash"]:
                raise Fault(BAD_DATA, f"{path}: has changed since the set was begun")


def make_files(layout, part, folder, plan_folder):
    """Makes a shard: entries of its files, number of its frames, and its targets by kind."""
    plan, shard, work = layout["plan"], layout["shards"][part], os.path.join(folder, WORK)
    progress, frames, targets = pace.Pace(folder, part, shard["frames"]), 0, collections.Counter()
    with contextlib.ExitStack() as whole:
        file = whole.enter_context(whole_file(os.path.join(folder, shard["lines"]), work)) if shard["lines"] else None
        made = whole.enter_context(temporary_folder(f"part-{part}-tables", work)) if shard["tables"] else None
        lines = Lines(plan, file, progress)
        for words in runs_of(plan, shard, tool_of(plan, part, made and os.path.abspath(made), COPY)):
            counts = counted(words, lines, folder, plan_folder)
            frames += int(counts.split()[0])
            targets += targets_by_kind(counts)
        files = [{"path": shard["lines"], **lines.facts(frames)}] if file else []
        files += place_tables(shard["tables"], rows_of_tables(counts), made, folder)
    progress.end()
    return files, frames, dict(sorted(targets.items()))


def make(layout, part, folder, plan_folder):
    """Makes a shard: its files, and when they are on the disk, its record."""
    if not 0 <= part < len(layout["shards"]):
        raise Fault(USAGE, f"part-{part}: the set has part-0 to part-{len(layout['shards']) - 1}")
    shard = layout["shards"][part]
    try:
        check_inputs(layout, shard, folder, plan_folder)
        files, frames, targets = make_files(layout, part, folder, plan_folder)
        record = {"identity": layout["identity"], "part": part, "frames": frames, "files": files, "targets": targets}
        write_whole(record_path(folder, part), os.path.join(folder, WORK),
                    json.dumps(record, indent=1, ensure_ascii=False) + "\n")
    except (Fault, OSError) as fault:
        raise Fault(getattr(fault, "code", IO), f"part-{part}, {shard['lines'] or shard['tables'][0]}: {fault}") from fault


def side_by_side(work, items, jobs):
    """Calls work(item) for each item, as many at a time as `jobs`. A fault is raised when the calls that were begun have ended."""
    pool = concurrent.futures.ThreadPoolExecutor(jobs)
    try:
        for _ in pool.map(work, items):
            pass
    finally:
        pool.shutdown(cancel_futures=True)


def make_missing(layout, left, folder, plan_folder, jobs):
    """Makes the shards `left`, as many at a time as `jobs`. One that fails is named, and stops no other."""
    def attempt(part):
        try:
            make(layout, part, folder, plan_folder)
        except Fault as fault:
            pace.clear()
            print(f"{command_line.name()}: {fault}", file=sys.stderr)

    side_by_side(attempt, left, jobs)


def wrong_record(layout, part, folder, by_digest):
    """Why a shard has to be made, or None: it is there as its record says, and the record is of this layout."""
    path = record_path(folder, part)
    if not os.path.exists(path):
        return "missing"
    try:
        record = read_json(path)
        if record["identity"] != layout["identity"] or record["part"] != part:
            return "of another plan"
        for file in record["files"]:
            place = os.path.join(folder, file["path"])
            if not os.path.isfile(place):
                return f"{file['path']} is missing"
            if os.path.getsize(place) != file["bytes"] or by_digest and digest_of_file(place) != file["hash"]:
                return f"{file['path']} is damaged"
    except (Fault, KeyError, TypeError) as fault:
        return f"its record is damaged: {fault}"
    return None


def missing(layout, folder, by_digest=True):
    """The numbers of shards that have to be made. Records that do not hold are taken away."""
    found = []
    for part in Progress("shards verified").over(range(len(layout["shards"]))):
        reason = wrong_record(layout, part, folder, by_digest)
        if reason is None:
            continue
        found.append(part)
        if reason != "missing":
            print(f"{command_line.name()}: part-{part}: {reason}: it is made again", file=sys.stderr)
            os.remove(record_path(folder, part))
    return found


def verify(layout, folder):
    """Before a run: what is left of killed runs goes, and what is there is held to its records. A manifest stands
    beside whole sets alone."""
    work = os.path.join(folder, WORK)
    with alone(work):
        remove_temporaries(work)
        left = missing(layout, folder)
        if left and os.path.exists(os.path.join(folder, MANIFEST)):
            os.remove(os.path.join(folder, MANIFEST))
        with whole_file(os.path.join(folder, pace.PATH), work) as file:
            file.write(pace.begin(layout, left))
        return left
