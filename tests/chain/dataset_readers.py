"""What the README.md of a data set says about loading works: each reader finds the frames and targets that are there.

Usage: python3 tests/chain/dataset_readers.py BIN_DIR

Needs Debian's python3-pandas, python3-torch and octave, and DuckDB, which tests/tables/run puts into build/tables.
"""
import json
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import dataset as sets  # noqa: E402

# DuckDB's library for JavaScript, in the place of its program: SQL from standard input or after -c.
PROGRAM = """
import { readFileSync } from "node:fs";
import { DuckDBInstance } from "@duckdb/node-api";
const at = process.argv.indexOf("-c");
const connection = await (await DuckDBInstance.create()).connect();
const rows = (await connection.runAndReadAll(at < 0 ? readFileSync(0, "utf8") : process.argv[at + 1])).getRowsJson();
if (at >= 0) console.log(rows.map((row) => row.join(",")).join("\\n"));
"""
DUCKDB = """
import { readFileSync } from "node:fs";
import { DuckDBInstance } from "@duckdb/node-api";
const connection = await (await DuckDBInstance.create()).connect();
const rows = (await connection.runAndReadAll(readFileSync(0, "utf8"))).getRowsJson();
console.log(rows.length, rows[0].length);
"""


def reader_words(reader, folder, text):
    """The command that runs a snippet. Debian's own Python has Debian's packages; Octave reads MATLAB from files."""
    if reader == "DuckDB":
        path = os.path.join(sets.ROOT, os.environ["BUILD"], "tables", "duckdb.mjs")
        text = DUCKDB
    else:
        path = os.path.join(folder, "snippet")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return {"DuckDB": ["node"], "MATLAB": ["octave", "--no-gui", "--quiet"]}.get(reader, ["/usr/bin/python3"]) + [path]


def printed_by(reader, place):
    """What a reader prints that runs the page's snippet, in the folder of the set."""
    with open(os.path.join(place, "README.md"), encoding="utf-8") as page:
        text = re.search(rf"\n{reader}.*:\n\n```\w+\n((?:.*\n)*?)```", page.read())[1]
    done = subprocess.run(reader_words(reader, os.path.dirname(place), text), input=text, cwd=place, capture_output=True,
                          text=True, check=False)
    assert done.returncode == 0, f"{reader}: {done.stdout}{done.stderr}"
    return done.stdout.split()


def counts(frames):
    return len(frames), sum(len(frame["targets"]) for frame in frames)


def main():
    sets.use(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        place = sets.made(folder, sets.snapshots(200, splits={"by": "scene", "shares": sets.SHARES}))
        train = [json.loads(line) for line in sets.frames_of(place, "train/*").splitlines()]
        (first, first_targets), (_, all_targets) = counts(train[:10]), counts(train)
        strongest = {max(target["contributors"], key=lambda part: part["weight"])["object"]
                     for frame in train[:10] for target in frame["targets"]}
        expected = {"pandas": [first, first_targets, len(strongest)], "PyTorch": [all_targets],
                    "MATLAB": ["printed", "=", first, first_targets], "DuckDB": [all_targets, 6]}
        for reader, wanted in expected.items():
            printed = printed_by(reader, place)
            assert printed == list(map(str, wanted)), f"{reader}: {printed}, expected {wanted}"
            print(f"{reader} loads the set", flush=True)
        path = os.path.join(sets.ROOT, os.environ["BUILD"], "tables", "program.mjs")
        with open(path, "w", encoding="utf-8") as file:
            file.write(PROGRAM)
    with tempfile.TemporaryDirectory() as folder:
        os.environ.update(sets.program(folder, "duckdb", f'#!/bin/sh\nexec node {path} "$@"\n'))
        sets.parquet_needs_duckdb(folder)
        print("DuckDB makes Parquet", flush=True)


main()
