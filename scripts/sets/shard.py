"""Makes one shard of a data set, and holds those that are there to their records."""
import collections
import contextlib
import fcntl
import gzip
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
import time
import zlib

from documents import environment, program_version
from durable import (alone, digest_of_file, remove_temporaries, sync_folder, temporary_folder, whole_file,
                     write_whole)
from layout import WORK
from plan import BAD_DATA, IO, NO_INPUT, USAGE, Fault, read_json
from progress import Progress, line_of

# The level of glint's own output: it keeps up with the chain. Tables of this size stay in a core's cache: two per cent
# faster than zlib's own choice, and as small. Bytes depend on the content and on zlib alone.
LEVEL, GZIP, TABLES = 1, 16 + zlib.MAX_WBITS, 7
# What goes through a pipe at once: few calls, and what was read is in the cache until all have used it.
PORTION = 1 << 18
BEGUN, MANIFEST = "begun", "datapackage.json"


def record_path(folder, part):
    return os.path.join(folder, WORK, f"part-{part}.json")


class Gzip:
    """Compresses lines into a file, and measures both sides."""

    def __init__(self, file):
        self.file, self.packer = file, zlib.compressobj(LEVEL, zlib.DEFLATED, GZIP, TABLES)
        self.packed, self.plain = hashlib.sha256(), hashlib.sha256()
        self.bytes = self.plain_bytes = 0

    def send(self, packed):
        self.packed.update(packed)
        self.bytes += len(packed)
        self.file.write(packed)

    def write(self, lines):
        self.plain.update(lines)
        self.plain_bytes += len(lines)
        self.send(self.packer.compress(lines))

    def close(self):
        self.send(self.packer.flush())

    def facts(self, rows):
        return {"rows": rows, "bytes": self.bytes, "hash": "sha256:" + self.packed.hexdigest(),
                "content_bytes": self.plain_bytes, "content_hash": "sha256:" + self.plain.hexdigest()}


def widen(pipe):
    """Gives a pipe room for a portion; the system may refuse that to a user who has many."""
    with contextlib.suppress(OSError):
        fcntl.fcntl(pipe, fcntl.F_SETPIPE_SZ, PORTION)


def run_into(gzip_file, command, folder, plan_folder):
    """Runs a pipeline and compresses its frames; what glint-summary, at its end, counts in them. Frames that are no
    target lists are refused, and scenes that are not whole."""
    begin, end = os.pipe()
    counting = f"{command} | glint-summary --complete --copy /dev/fd/{end}"
    with subprocess.Popen(["glint", "-c", counting], cwd=plan_folder, env=environment(folder), stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, pass_fds=[end], text=True) as process, \
            open(begin, "rb", buffering=0) as frames:
        os.close(end)
        widen(frames)
        room = bytearray(PORTION)
        while count := frames.readinto(room):
            gzip_file.write(memoryview(room)[:count])
        counts = process.stdout.read()
    if process.returncode != 0:
        code = process.returncode
        raise Fault(code if code > 0 else 128 - code, f"exit status {code}: glint -c {command!r}")
    return counts


def ask(words, folder):
    """What a program prints."""
    done = subprocess.run(words, env=environment(folder), stdout=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise Fault(done.returncode, f"exit status {done.returncode}: {shlex.join(words)}")
    return done.stdout


def targets_by_kind(counts):
    """What glint-summary has counted: by the class of the object that made most of a target, or as ghosts and the like."""
    blocks = re.findall(r"\ntargets (?:by class|that show no object).*\n((?: .*\n)+)", counts)
    rows = re.findall(r" *(\d+) +[\d.]+ % +(.*)\n", "".join(blocks))
    return collections.Counter({name: int(count) for count, name in rows})


class Rows:
    """Counts the rows of a table of CSV. A cell in quotes may hold the end of a line."""

    def __init__(self):
        self.count, self.quoted = 0, False

    def add(self, text):
        pieces = text.split(b'"')
        self.count += sum(piece.count(b"\n") for piece in pieces[self.quoted::2])
        self.quoted ^= len(pieces) % 2 == 0


def facts_of_table(path):
    """As Gzip's, of a table of any length; the rows are those below the heading."""
    rows, plain, plain_bytes = Rows(), hashlib.sha256(), 0
    with gzip.open(path) as file:
        while text := file.read(PORTION):
            plain.update(text)
            plain_bytes += len(text)
            rows.add(text)
    return {"rows": rows.count - 1, "bytes": os.path.getsize(path), "hash": digest_of_file(path),
            "content_bytes": plain_bytes, "content_hash": "sha256:" + plain.hexdigest()}


def make_tables(shard, part, lines, folder):
    """The tables of a shard's lines, each on the disk before it gets its name; their facts."""
    files = []
    with temporary_folder(f"part-{part}-tables", os.path.join(folder, WORK)) as place:
        if shard["tables"]:
            ask(["glint-tables", "--part", str(part), place, lines], folder)
        for name in shard["tables"]:
            made = os.path.join(place, os.path.basename(name))
            files.append({"path": name, **facts_of_table(made)})
            os.rename(made, os.path.join(folder, name))
        if shard["tables"]:
            sync_folder(os.path.dirname(os.path.join(folder, shard["tables"][0])))
    return files


def check_inputs(layout, shard, folder, plan_folder):
    """The program, the copies of documents and the shard's own inputs are those of the layout."""
    if program_version() != layout["program"]:
        raise Fault(BAD_DATA, f"the set was begun by {layout['program']}; this is {program_version()}")
    for place, known, names in ((folder, layout["documents"], None), (plan_folder, layout["inputs"], shard["inputs"])):
        for input_ in known:
            path = os.path.join(place, input_["path"])
            if names is not None and input_["path"] not in names:
                continue
            if not os.path.isfile(path):
                raise Fault(NO_INPUT, f"{path}: no such file")
            if digest_of_file(path) != input_["hash"]:
                raise Fault(BAD_DATA, f"{path}: has changed since the set was begun")


def make_files(shard, part, folder, plan_folder):
    """The files of a shard, and its targets by kind."""
    frames, targets = 0, collections.Counter()
    with whole_file(os.path.join(folder, shard["path"]), os.path.join(folder, WORK)) as file:
        gzip_file = Gzip(file)
        for command in shard["commands"]:
            counts = run_into(gzip_file, command, folder, plan_folder)
            frames += int(counts.split()[0])
            targets += targets_by_kind(counts)
        gzip_file.close()
        file.flush()
        tables = make_tables(shard, part, file.name, folder)
    return [{"path": shard["path"], **gzip_file.facts(frames)}, *tables], dict(sorted(targets.items()))


def make(layout, part, folder, plan_folder):
    """Makes a shard: its files, and when they are on the disk, its record."""
    if not 0 <= part < len(layout["shards"]):
        raise Fault(USAGE, f"part-{part}: the set has part-0 to part-{len(layout['shards']) - 1}")
    shard = layout["shards"][part]
    try:
        check_inputs(layout, shard, folder, plan_folder)
        files, targets = make_files(shard, part, folder, plan_folder)
        record = {"identity": layout["identity"], "part": part, "files": files, "targets": targets}
        write_whole(record_path(folder, part), os.path.join(folder, WORK),
                    json.dumps(record, indent=1, ensure_ascii=False) + "\n")
    except (Fault, OSError) as fault:
        raise Fault(getattr(fault, "code", IO), f"part-{part}, {shard['path']}: {fault}") from fault
    show_progress(layout, folder)


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
            print(f"dataset: part-{part}: {reason}: it is made again", file=sys.stderr)
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
        write_whole(os.path.join(work, BEGUN), work, json.dumps({"time_s": time.time(), "missing": len(left)}))
        return left


def clear_progress():
    """Takes the line away that the last shard has left."""
    if sys.stderr.isatty():
        print(f"\r{'':72}\r", end="", file=sys.stderr, flush=True)


def show_progress(layout, folder):
    """The line of progress, from the records that are there."""
    if not sys.stderr.isatty():
        return
    try:
        begun = read_json(os.path.join(folder, WORK, BEGUN))
    except Fault:
        return
    names = os.listdir(os.path.join(folder, WORK))
    left = len(layout["shards"]) - sum(name.startswith("part-") and name.endswith(".json") for name in names)
    done, elapsed_s = begun["missing"] - left, time.time() - begun["time_s"]
    if done > 0 and elapsed_s >= 1:
        line = line_of("shards", done, elapsed_s, done / begun["missing"])
        print(f"\r{line:72}", end="", file=sys.stderr, flush=True)
