"""The tables of a shard: the program that makes them, as CSV or by DuckDB as Parquet, and their entries in the manifest."""
import gzip
import hashlib
import os
import shlex
import subprocess

from glint import zstd
from glint.places import SCHEMAS
from glint.sets.durable import digest_of_file, sync_folder
from glint.sets.plan import IO, Fault, read_json

PORTION = 1 << 19
# As in schemas/README.md. With one thread the same rows make the same bytes.
COPY = "COPY (FROM {name}('.')) TO '{name}.parquet' (FORMAT parquet, COMPRESSION zstd, ROW_GROUP_SIZE 1000000);"


def paths_of(plan, place):
    """Paths of the tables of the shard at a place."""
    names = read_json(os.path.join(SCHEMAS, "tables.json")) if plan.get("tables") else []
    packed = {"gzip": ".csv.gz", "zstd": ".csv.zst"}[plan.get("compression", "gzip")]
    return [f"{place}/{name}{'.parquet' if plan['tables'] == 'parquet' else packed}" for name in names]


def tool_of(plan, part, place, copy):
    """The command that counts frames, copies their lines into the file `copy`, and makes the tables of a part in a place."""
    copied, bare = plan.get("lines") != "none", plan.get("lines") == "without_objects"
    words = ["--complete", *["--copy", copy] * copied]
    if not plan.get("tables"):
        return shlex.join(["glint-summary", *words])
    words += ["--without-objects"] * bare
    if plan["tables"] == "parquet":
        words.append("--plain")
    elif plan.get("compression") == "zstd":
        words.append("--zstd")
    return shlex.join(["glint-tables", "--counts", "--part", str(part), *words, place])


class Rows:
    """Counts the rows of a table of CSV. A cell in quotes may hold the end of a line."""

    def __init__(self):
        self.count, self.quoted = 0, False

    def add(self, text):
        pieces = text.split(b'"')
        self.count += sum(piece.count(b"\n") for piece in pieces[self.quoted::2])
        self.quoted ^= len(pieces) % 2 == 0


def opened(path):
    """A binary file of what a table holds, packed or not."""
    if path.endswith(".zst"):
        return zstd.opened(path)
    return (gzip.open if path.endswith(".gz") else open)(path, "rb")


def facts_of_content(path):
    """Bytes and digest of what a table holds, packed or not."""
    plain, plain_bytes = hashlib.sha256(), 0
    with opened(path) as file:
        while text := file.read(PORTION):
            plain.update(text)
            plain_bytes += len(text)
    return {"content_bytes": plain_bytes, "content_hash": "sha256:" + plain.hexdigest()}


def make_parquet(place, names):
    with open(os.path.join(SCHEMAS, "tables.sql"), encoding="utf-8") as file:
        script = "\n".join(["SET threads = 1;", file.read(), *(COPY.format(name=name) for name in names)])
    done = subprocess.run(["duckdb", "-bail"], cwd=place, input=script, stdout=subprocess.DEVNULL, text=True, check=False)
    if done.returncode != 0:
        raise Fault(IO, f"exit status {done.returncode}: duckdb")


def place_tables(paths, rows, made, folder):
    """Writes the tables of the folder `made`, of so many rows each, to the disk, and moves each to its path; their entries in
    the manifest."""
    names = [os.path.basename(path).split(".")[0] for path in paths]
    parquet = any(path.endswith(".parquet") for path in paths)
    tables = [name + ".csv" for name in names] if parquet else map(os.path.basename, paths)
    facts = [{"rows": rows[name], **facts_of_content(os.path.join(made, table))} for name, table in zip(names, tables)]
    if parquet:
        make_parquet(made, names)
    files = []
    for path, fact in zip(paths, facts):
        table = os.path.join(made, os.path.basename(path))
        with open(table, "rb") as file:
            os.fsync(file.fileno())
        files.append({"path": path, "bytes": os.path.getsize(table), "hash": digest_of_file(table), **fact})
        os.rename(table, os.path.join(folder, path))
    if paths:
        sync_folder(os.path.dirname(os.path.join(folder, paths[0])))
    return files
