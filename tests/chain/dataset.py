"""Data sets by scripts/dataset: the same bytes however they are cut, interrupted and resumed; leaks are refused.

Usage: python3 tests/chain/dataset.py BIN_DIR [--kills N] [--scenes N]

50 kills in 200 scenes if absent.
"""
import argparse
import csv
import glob
import gzip
import hashlib
import io
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPTS = os.path.join(ROOT, "scripts")
sys.path[:0] = [SCRIPTS, os.path.join(ROOT, "tests", "support")]
sys.dont_write_bytecode = True
from glint import zstd  # noqa: E402
from glint.progress import Progress  # noqa: E402
from sizes import quick  # noqa: E402

DATASET, CHECK_SET = (os.path.join(SCRIPTS, name) for name in ("dataset", "check-set"))
CHAIN = "glint-extract | glint-ideal --sensors {suite} --sections account | glint-sensor | glint-noise"
SUITE = "corner77-every-frame"
SHARES = {"train": 0.8, "validation": 0.1, "test": 0.1}
PATIENCE_S = 600
RECORDED = {"licence": "MIT", "source": "glint, data/trajectories"}


def plan_of(sources, **members):
    sources = [RECORDED | source if "recording" in source else source for source in sources]
    return {"name": "set", "origin": "Made for a test.", "sources": sources, "chain": CHAIN, "suites": [SUITE],
            "frames_per_shard": 10} | members


def snapshots(count, **members):
    return plan_of([{"random": "medium", "frames": count}], **members)


def run(words, **more):
    return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=PATIENCE_S, **more)


def printed(words, **more):
    """What a program prints, without its notices."""
    return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, timeout=PATIENCE_S, **more).stdout


def begin(folder, plan, name="set"):
    """Lays a set out; its folder, and what scripts/dataset says."""
    path = os.path.join(folder, f"{name}.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(plan, file)
    done = run([DATASET, path, "--out", os.path.join(folder, name)])
    return os.path.join(folder, name), done


def make(place, *words):
    return run(["make", "-s", "-C", place, "-j2", *words])


def made(folder, plan, name="set"):
    """A set that is there; its folder."""
    place, done = begin(folder, plan, name)
    assert done.returncode == 0, done.stdout
    done = make(place)
    assert done.returncode == 0, done.stdout
    return place


def files(place):
    """All files of a set by their paths. The Makefile has paths of the machine."""
    found = {}
    for path in glob.glob(place + "/**", recursive=True):
        name = os.path.relpath(path, place)
        if os.path.isfile(path) and name != "Makefile":
            with open(path, "rb") as file:
                found[name] = file.read()
    return found


def frames_of(place, pattern):
    return b"".join(gzip.open(path).read() for path in sorted(glob.glob(os.path.join(place, pattern, "*.jsonl.gz"))))


def manifest(place):
    with open(os.path.join(place, "datapackage.json"), encoding="utf-8") as file:
        return json.load(file)


def sha256(data):
    return "sha256:" + hashlib.sha256(data).hexdigest()


# --- bytes ----------------------------------------------------------------------------------------

def shards_join_to_the_bytes_of_one_run(folder):
    chain = CHAIN.format(suite=SUITE)
    right = printed(["glint", "-c", f"glint-traffic-random --density medium --frames 64 | {chain}"]).encode()
    for size, count in ((64, 1), (10, 7), (1, 64)):
        place = made(folder, snapshots(64, frames_per_shard=size), f"by-{size}")
        assert len(manifest(place)["resources"]) == count, f"{size} frames a shard: {len(manifest(place)['resources'])} shards"
        assert frames_of(place, "all/*") == right, f"{count} shards join to other bytes"


def scenes_and_seeds_are_played_whole(folder):
    sources = [{"scenario": "cut-in"}, {"scenario": "varied-cut-in", "scenes": [3, 8]},
               {"random": "medium", "seconds": 2, "scenes": [4, 9], "rate_hz": 10}]
    words = ("glint-traffic cut-in --scene cut-in/{seed}", "glint-traffic varied-cut-in --scenes 3:8 --scene varied-cut-in/{seed}",
             "glint-traffic-random --density medium --seconds 2 --scenes 4:9 --rate-hz 10")
    right = "".join(printed(["glint", "-c", f"{source.format(seed=seed)} --seed {seed} | {CHAIN.format(suite=SUITE)}"])
                    for seed in (1, 2) for source in words)
    for size, count in ((10000, 1), (300, 8), (100, 14)):
        place = made(folder, plan_of(sources, seeds=[1, 2], frames_per_shard=size), f"by-{size}")
        assert frames_of(place, "all/*") == right.encode()
        assert len(manifest(place)["resources"]) == count, len(manifest(place)["resources"])


def the_manifest_says_what_is_there(folder):
    place = made(folder, snapshots(40, splits={"by": "scene", "shares": SHARES}, suites=[SUITE, "lrr77-every-frame"]))
    package = manifest(place)
    text = files(place)["datapackage.json"].decode()
    whole, last = text[:text.rindex(' "digest"')], text[text.rindex(' "digest"'):]
    assert last == f' "digest": "{sha256(whole.encode())}"}}\n', "the last line is no digest of those before"
    rows = {}
    for resource in package["resources"]:
        packed = files(place)[resource["path"]]
        plain = gzip.decompress(packed)
        assert (len(packed), sha256(packed)) == (resource["bytes"], resource["hash"])
        assert (len(plain), sha256(plain)) == (resource["content_bytes"], resource["content_hash"])
        assert plain.count(b"\n") == resource["rows"]
        rows[resource["split"], resource["suite"]] = rows.get((resource["split"], resource["suite"]), 0) + resource["rows"]
        again = "".join(printed(["glint", "-c", command], env=os.environ | {"GLINT_DATA": place + "/documents"})
                        for command in resource["commands"])
        assert again.encode() == plain, f"{resource['path']}: its commands make other bytes"
    suites = (SUITE, "lrr77-every-frame")
    assert rows == {(split, suite): count for split, count in zip(SHARES, (32, 4, 4)) for suite in suites}, rows
    for document in package["documents"]:
        assert sha256(files(place)[document["path"]]) == document["hash"]


def tables_have_the_targets_of_their_lines(folder):
    place = made(folder, snapshots(40, tables=True, splits={"by": "scene", "shares": SHARES}))
    frames = [json.loads(line) for line in frames_of(place, "train/*").splitlines()]
    of_tables, keys = [], set()
    for path in sorted(glob.glob(place + "/train/*/*/detections.csv.gz")):
        with gzip.open(path, "rt", encoding="utf-8", newline="") as table:
            rows = list(csv.DictReader(table))
        of_tables += [(row["scene"], float(row["range_m"])) for row in rows]
        keys |= {row["detection_key"] for row in rows}
    of_lines = [(frame["scene"], target["range_m"]) for frame in frames for target in frame["targets"]]
    assert of_tables == of_lines and len(keys) == len(of_lines) > 100
    facts = {resource["path"]: resource for resource in manifest(place)["resources"]}
    names = {resource["name"] for resource in facts.values()}
    assert len(facts) == 6 * 8, "lines and seven tables of six shards"
    assert sum(fact["rows"] for path, fact in facts.items() if path.startswith("train/") and "detections" in path) == len(of_lines)
    for path, fact in facts.items():
        packed = files(place)[path]
        assert sha256(packed) == fact["hash"] and sha256(gzip.decompress(packed)) == fact["content_hash"]
        assert fact["schema"] in files(place), f"{path}: there is no {fact['schema']}"
        joins = json.loads(files(place)[fact["schema"]]).get("foreignKeys", [])
        assert all(join["reference"]["resource"] in names for join in joins), f"{path}: joins what is no resource"


def rows_are_counted_wherever_a_table_is_cut(_):
    """Ends of lines within quotes are no ends of rows."""
    from glint.sets import tables
    cells = ["plain", 'a "word"', "two\nlines", '"', "", "\n", ',"\n"']
    with io.StringIO(newline="") as table:
        csv.writer(table, lineterminator="\n").writerows([cells[i:], cells[:i]] for i in range(len(cells)))
        csv.writer(table, lineterminator="\n").writerows([cells] * 3)
        text = table.getvalue().encode()
    for cut in range(len(text)):
        rows = tables.Rows()
        rows.add(text[:cut])
        rows.add(text[cut:])
        assert rows.count == len(cells) + 3, f"cut at {cut}: {rows.count} rows"


def every_table_joins_every_other(folder):
    """In a set of two seeds and two radars on one recording, by the keys that tables.json names; and the tracker reads it."""
    source = {"recording": "highway", "egos": ["1", "7"], "from_s": 0, "to_s": 1, "block_s": 0.5}
    chain = CHAIN.replace("account", "account,visibility")
    place = made(folder, plan_of([source, {"random": "medium", "frames": 5}], seeds=[1, 2], suites=[SUITE, "lrr77-every-frame"], tables=True,
                                 chain=chain))
    frames = [json.loads(line) for line in frames_of(place, "all/*").splitlines()]
    assert len({(frame["scene"], frame["frame"]) for frame in frames}) == len(frames), "two scenes of one name"
    with open(os.path.join(ROOT, "schemas", "tables.json"), encoding="utf-8") as file:
        schemas = json.load(file)
    tables = {name: [row for path in sorted(glob.glob(f"{place}/all/*/*/{name}.csv.gz"))
                     for row in csv.DictReader(gzip.open(path, "rt", encoding="utf-8", newline=""))] for name in schemas}
    assert len(tables["frames"]) == len(frames)
    reached = {name: {join["reference"]["resource"] for join in schema.get("foreignKeys", [])} for name, schema in schemas.items()}
    whole = {"frames"}
    while more := {name for name, others in reached.items() if others & whole} - whole:
        whole |= more
    assert whole == schemas.keys(), f"no keys lead from {schemas.keys() - whole} to frames"
    for name, schema in schemas.items():
        primary = schema.get("primaryKey", [])
        primary = [primary] if isinstance(primary, str) else primary
        assert not primary or len({tuple(map(row.get, primary)) for row in tables[name]}) == len(tables[name]) > 0, name
        for join in schema.get("foreignKeys", []):
            key, other = join["fields"], join["reference"]["resource"]
            rows = {row[key]: row for row in tables[other]}
            for row in tables[name]:
                there = rows[row[key]] if row[key] else row
                assert all(row[column] == there[column] for column in ("scene", "frame", "time_s") if column in row.keys() & there.keys()
                           and name != "contributors"), f"{name}.{key} joins another world"
    lines = os.path.join(folder, "test.jsonl.gz")
    done = run(["bash", "-e", "-o", "pipefail", "-c", f"cat {place}/*/*/*.jsonl.gz > {lines}; scripts/tracker {lines}"
                f" | glint-score-tracks --tracks - {lines} --text"], cwd=ROOT)
    assert done.returncode == 0 and f"{len(frames)} frames;" in done.stdout, done.stdout


def kind_of_target(frame, target):
    """What made most of it: the class of an object where it is, or what else."""
    most = max(target["contributors"], key=lambda part: part["weight"])
    if most["path"] in ("clutter", "false_alarm"):
        return most["path"].replace("_", " ")
    if most["path"] not in ("direct", "wheel", "limb"):
        return "ghost"
    return next(one["class"] for one in frame["objects"] if one["id"] == most["object"])


def counts_of_the_page_add_up(folder):
    """All targets by kind, as the lines have them; and the page says where the traffic comes from."""
    sources = [{"random": "dense", "frames": 200, "options": "--draw-conditions"}]
    place = made(folder, plan_of(sources, suites=["lrr77-full"], splits={"by": "scene", "shares": SHARES}, frames_per_shard=50))
    with open(os.path.join(place, "README.md"), encoding="utf-8") as file:
        page = file.read()
    counted = {}
    for split in SHARES:
        for frame in map(json.loads, frames_of(place, f"{split}/*").splitlines()):
            for target in frame["targets"]:
                kind = kind_of_target(frame, target)
                counted.setdefault(kind, dict.fromkeys(SHARES, 0))[split] += 1
    assert {"ghost", "clutter", "false alarm", "car"} <= counted.keys(), counted
    for kind, counts in counted.items():
        row = " | ".join(f"{counts[split]:,}" for split in SHARES)
        assert f"\n| {kind} | {row} |\n" in page, f"{kind}: {row}: {page}"
    sums = {split: sum(counts[split] for counts in counted.values()) for split in SHARES}
    assert f" {sum(sums.values()):,} targets of all kinds" in page
    for split, count in sums.items():
        assert re.search(rf"\n\| `{split}/lrr77-full` \| \d+ \| [\d,]+ \| {count:,} \|", page), page
    assert "no radar has measured them" in page and "- `random-dense`: snapshots that glint has drawn" in page
    with open(os.path.join(place, "documents", "sensors", "lrr77-full.json"), encoding="utf-8") as suite:
        assert f"\n- `lrr77-full`: {json.load(suite)['origin']}\n" in page
    assert f"\n    {manifest(place)['content_hash']}\n" in page


def counts_add_up_at_the_edges(folder):
    """Sets of one frame, of one shard, of one frame a shard, and of tables alone have no empty shard, and pass check-set."""
    halves = {"by": "scene", "shares": {"train": 0.5, "test": 0.5}}
    plans = [(1, 1, {}), (3, 1, {"frames_per_shard": 10 ** 9}), (3, 3, {"frames_per_shard": 1, "tables": True, "lines": "none"}),
             (2, 2, {"splits": halves, "tables": True, "lines": "without_objects"})]
    for i, (frames, shards, members) in enumerate(plans):
        place = made(folder, snapshots(frames, **members), f"edge{i}")
        package = manifest(place)
        counting = [one for one in package["resources"] if "/frames.csv" in one["path"] or ".jsonl." in one["path"]]
        by_shard = {one["path"].split(".")[0].removesuffix("/frames"): one["rows"] for one in counting}
        assert package["frames"] == sum(by_shard.values()) == frames and len(by_shard) == shards, (members, by_shard)
        assert min(by_shard.values()) > 0 and package["rows"] == sum(one["rows"] for one in package["resources"])
        done = run([CHECK_SET, place, "-j2"])
        assert done.returncode == 0, done.stdout


def what_is_kept_is_the_same_however_it_is_packed(folder):
    """Compares sets of tables with whole lines, with lines without objects, and alone; all packed by gzip and by zstd,
    which makes the same bytes in C, in Python and as a program."""
    def by_path(place):
        return {one["path"]: one["content_hash"] for one in manifest(place)["resources"]}

    whole = made(folder, snapshots(20, tables=True), "whole")
    tables = {path: content for path, content in by_path(whole).items() if ".csv" in path}
    lines = frames_of(whole, "all/*")
    assert by_path(made(folder, snapshots(20, tables=True, lines="none"), "none")) == tables
    bare = made(folder, snapshots(20, tables=True, lines="without_objects", level=9), "bare")
    assert tables.items() <= by_path(bare).items() and len(by_path(bare)) == len(tables) + 2
    expected = [json.loads(line) for line in lines.splitlines()]
    for frame in expected:
        del frame["objects"]
        frame["sections"].remove("objects")
    assert [json.loads(line) for line in frames_of(bare, "all/*").splitlines()] == expected
    by_zstd = made(folder, snapshots(20, tables=True, compression="zstd", level=3), "zstd")
    unpacked = run(["bash", "-c", f"zstd -dcq {by_zstd}/all/*/*.jsonl.zst"]).stdout
    assert unpacked.encode() == lines
    assert {path.replace(".gz", ".zst"): content for path, content in by_path(whole).items()} == by_path(by_zstd)
    assert {one["path"].split(".")[0]: one["rows"] for one in manifest(whole)["resources"]} == {
        one["path"].split(".")[0]: one["rows"] for one in manifest(by_zstd)["resources"]}
    for path in glob.glob(f"{by_zstd}/all/**/*.csv.zst", recursive=True):
        with open(path, "rb") as file, zstd.opened(path) as table:
            made_by_c, content, packer = file.read(), table.read(), zstd.Packer(1)
        program = ["zstd", "-q", "--single-thread", "-1"]
        assert packer.compress(content) + packer.flush() == made_by_c, path
        assert subprocess.run(program, input=content, stdout=subprocess.PIPE, check=True).stdout == made_by_c, path
    for place in (whole, bare, by_zstd):
        done = run([CHECK_SET, place, "--all"])
        assert done.returncode == 0, done.stdout
    path = glob.glob(f"{by_zstd}/all/*/00001.jsonl.zst")[0]
    shutil.copy(glob.glob(f"{by_zstd}/all/*/00000.jsonl.zst")[0], path)
    assert run([CHECK_SET, by_zstd]).returncode == 65


def parquet_needs_duckdb(folder):
    plan = snapshots(20, tables="parquet", lines="none")
    if not shutil.which("duckdb"):
        refusals(folder, [(plan, '/tables: "parquet" needs the program duckdb')], 69)
        print("skipped  tables as Parquet: there is no duckdb")
        return
    place, plain = made(folder, plan), made(folder, snapshots(20, tables=True, lines="none"), "plain")
    assert {one["path"].replace(".csv.gz", ".parquet"): one["rows"] for one in manifest(plain)["resources"]} == {
        one["path"]: one["rows"] for one in manifest(place)["resources"]}
    counted = run(["duckdb", "-csv", "-noheader", "-c", f"SELECT count(*) FROM '{place}/all/*/*/detections.parquet'"]).stdout
    assert int(counted) == sum(one["rows"] for one in manifest(place)["resources"] if "detections" in one["path"])
    assert run([CHECK_SET, place]).returncode == 0
    again = made(folder, plan, "again")
    assert by_content(place) == by_content(again)


def by_content(place):
    return {one["path"]: one["hash"] for one in manifest(place)["resources"]}


def own_stage(folder):
    """Builds the C stage of stages/README.md by the commands there, but with the headers and the library of this build."""
    with open(os.path.join(ROOT, "stages", "README.md"), encoding="utf-8") as page, \
            open(os.path.join(folder, "spray.c"), "w", encoding="utf-8") as file:
        file.write(re.search(r"```c\n(.*?)```", page.read(), re.DOTALL)[1] + '#include "run/chain.h"\n'
                   "int main(int count, char **words)\n{\n    return chain_main(&stage_spray, count, words);\n}\n")
    library = os.path.join(ROOT, os.environ["BUILD"], "libglint.a")
    zstd = ["-lzstd"] if run(["pkg-config", "--exists", "libzstd"]).returncode == 0 else []
    done = run(["cc", "-std=c11", "-O2", "-ffp-contract=off", f"-I{ROOT}/lib", "-o", "spray", "spray.c", library, "-ljansson", "-lcsv",
                "-lz", *zstd, "-lm"], cwd=folder)
    assert done.returncode == 0, done.stdout


def own_stages_stand_in_a_chain(folder):
    """A stage in C and one in Python give the frames of a pipe of bash; after a change of a stage no shard is made."""
    own_stage(folder)
    shutil.copy(os.path.join(ROOT, "pipelines", "mud.py"), folder)
    front, back = CHAIN.split(" | glint-sensor ")
    chain = f"{front} | ./spray --reach-m 30 | python3 ./mud.py -0.2 '0.1' | glint-sensor {back}"
    for name, more in (("lines", {}), ("tables", {"tables": True}),
                       ("several", {"tables": True, "sources": [{"random": one, "frames": 8} for one in ("medium", "sparse")]})):
        plan = snapshots(16, chain=chain, frames_per_shard=20) | more
        place = made(folder, plan, name)
        command = " && ".join(f"glint-traffic-random --density {source['random']} --frames {source['frames']}"
                              for source in plan["sources"])
        right = run(["bash", "-o", "pipefail", "-c", f"{{ {command}; }} | {chain.format(suite=SUITE)}"], cwd=folder).stdout
        assert frames_of(place, "all/*") == right.encode() and "absorbed" in right and "covered" in right, name
        done = run([CHECK_SET, place, "--all"])
        assert done.returncode == 0, done.stdout
    assert {one["path"] for one in manifest(place)["inputs"]} == {"./spray", "./mud.py"}
    place, _ = begin(folder, snapshots(6, chain=chain), "changed")
    with open(os.path.join(folder, "mud.py"), "a", encoding="utf-8") as file:
        file.write("\n")
    assert "mud.py: has changed since the set was begun" in make(place).stdout
    with open(os.path.join(folder, "mud.py"), "a", encoding="utf-8") as file:
        file.write("sys.exit(7)\n")
    place, done = begin(folder, snapshots(6, chain=chain), "failing")
    assert done.returncode == 7 and "/chain: this fails" in done.stdout and not os.path.exists(place), done.stdout


def words_of_a_stage_may_have_bars_and_hashes(folder):
    """A bar in quotes ends no stage, and a hash hides nothing."""
    with open(os.path.join(folder, "same.py"), "w", encoding="utf-8") as file:
        file.write("import sys\nassert sys.argv[1:] == ['a|b', 'c#d', 'e'], sys.argv\nfor line in sys.stdin:\n    print(line, end='', flush=True)\n")
    plain = made(folder, snapshots(4), "plain")
    place = made(folder, snapshots(4, chain=f"{CHAIN} | python3 ./same.py 'a|b' c#d e"), "worded")
    assert frames_of(place, "all/*") == frames_of(plain, "all/*")
    assert run([CHECK_SET, place]).returncode == 0


def several_kinds_of_source_share_nothing_between_splits(folder):
    """Splits share no scene, no draw and no vehicle of a recording; a source with a split is all in it."""
    recorded = {"recording": two_halves(folder), "egos": ["all"], "from_s": 0, "to_s": 10.2, "block_s": 2}
    sources = [{"random": "medium", "frames": 10, "options": "--draw-conditions"}, {"random": "sparse", "seconds": 0.5, "scenes": [0, 4]},
               {"scenario": "varied-cut-in", "scenes": [0, 4]}, {"scenario": "cut-in", "split": "test"}, recorded]
    place = made(folder, plan_of(sources, seeds=[1, 2], frames_per_shard=100,
                                 splits={"by": "kind", "shares": {"train": 0.6, "test": 0.4}, "gap_s": 1.2}))
    splits = [[json.loads(line) for line in frames_of(place, f"{split}/*").splitlines()] for split in ("train", "test")]
    kinds = ("random-medium/", "moving-sparse/", "varied-cut-in/", "cut-in/", "halves/")
    names = [{frame["scene"] for frame in frames} for frames in splits]
    assert not names[0] & names[1]
    found = [{kind for kind in kinds if any(name.startswith(kind) for name in of_split)} for of_split in names]
    assert found[1] - found[0] == {"cut-in/"} and len(found[0]) == 4, found
    drawn = [{number for frame in frames if not frame["scene"].startswith(("cut-in/", "halves/")) for number in numbers_of(frame)}
             for frames in splits]
    assert not drawn[0] & drawn[1] and min(map(len, drawn)) > 100
    bodies = [{one["id"] for frame in frames if frame["scene"].startswith("halves/") for one in frame["objects"]} for frames in splits]
    assert bodies == [{"1001", "1007"}, {"2001", "2007"}], bodies


SLOW = """
import sys, time
for line in sys.stdin:
    time.sleep(0.2)
    print(line, end="", flush=True)
"""


def make_shows_how_far_it_is(folder):
    """On a terminal there is one line for all shards, although several are made at the same time."""
    if run(["script", "-qec", "true", "/dev/null"], stdin=subprocess.DEVNULL).returncode != 0:
        print("skipped  make shows how far it is: this machine has no pseudo-terminals")
        return
    with open(os.path.join(folder, "slow.py"), "w", encoding="ascii") as file:
        file.write(SLOW)
    place, _ = begin(folder, snapshots(20, chain=CHAIN.replace(" | glint-sensor", " | python3 ./slow.py | glint-sensor")))
    done = run(["script", "-qec", f"make -s -C {place} -j2", "/dev/null"], stdin=subprocess.DEVNULL)
    shown = [int(share) for share in re.findall(r"\[#* *\] +(\d+) %, [\d.]+ frames/s, \d:\d\d:\d\d left", done.stdout)]
    assert done.returncode == 0 and shown == sorted(shown) and len(shown) > 2 and shown[0] < 100, done.stdout


def recordings_tell_licence_and_source(folder):
    source = {"recording": "highway", "egos": ["1"]}
    for name in RECORDED:
        plan = plan_of([source])
        del plan["sources"][0][name]
        refusals(folder, [(plan, f"/sources/0: {name} is missing: a recording source needs it")], 65)
    place = made(folder, plan_of([source]))
    with open(os.path.join(place, "README.md"), encoding="utf-8") as page:
        assert "- `highway`: a recording, by glint, data/trajectories; licence: MIT\n" in page.read()
    package = manifest(place)
    assert package["licenses"] == [{"name": "MIT"}] and package["sources"] == [{"title": RECORDED["source"]}]
    assert package["plan"]["sources"][0].items() >= RECORDED.items()


# --- splits ---------------------------------------------------------------------------------------

def times_of(place, split):
    """(scene, time) of all frames of a split."""
    lines = frames_of(place, f"{split}/*").splitlines()
    return [(frame["scene"], frame["time_s"]) for frame in map(json.loads, lines)]


def two_halves(folder, name="halves.csv"):
    """Vehicles 1 and 7 of the shipped recording, and others in their places from 6 s on."""
    return copied(folder, name, lambda row: {"track_id": 1000 * (1 + (int(row["timestamp_ms"]) > 6000)) + int(row["track_id"])},
                  ids=(1, 7), end_s=10.1)


def blocks_of_time_keep_their_gap(folder):
    source = {"recording": two_halves(folder), "egos": ["all"], "from_s": 0, "to_s": 10.2, "block_s": 1.5}
    place = made(folder, plan_of([source], splits={"by": "time", "shares": {"train": 0.6, "test": 0.4}, "gap_s": 1.2}))
    train, test = times_of(place, "train"), times_of(place, "test")
    steps = [round(i / 10, 1) for i in range(1, 102)]
    for ego in "17":
        of_ego = [[time_s for scene, time_s in split if scene.endswith(ego)] for split in (train, test)]
        assert of_ego == [[at for at in steps if at < 5.4], [at for at in steps if at >= 6.6]], f"ego {ego}: {of_ego}"
    assert len({scene for scene, _ in train}) == 8 and len({scene for scene, _ in test}) == 6
    assert not {scene for scene, _ in train} & {scene for scene, _ in test}


def blocks_of_a_resampled_recording_have_all_frames(folder):
    source = {"recording": "highway", "egos": ["1", "7"], "from_s": 0.1, "to_s": 10.1, "block_s": 1.3, "rate_hz": 40}
    place = made(folder, plan_of([source]))
    played = printed(["glint-traffic", "highway", "--ego", "1,7", "--rate-hz", "40", "--from-s", "0.1", "--to-s", "10.099999"])
    right = sorted((frame["ego"], frame["time_s"]) for frame in map(json.loads, played.splitlines()))
    frames = map(json.loads, frames_of(place, "all/*").splitlines())
    assert sorted((frame["ego"], frame["time_s"]) for frame in frames) == right and len(right) == 800, len(right)


def numbers_of(frame):
    """What was drawn of a frame: numbers that no document has."""
    places = [one[name] for one in frame["objects"] for name in ("x_m", "y_m", "vx_mps")]
    weather = [value for value in frame.get("conditions", {}).values() if isinstance(value, float)]
    return {value for value in places + weather if abs(value - round(value, 3)) > 1e-9}


def no_two_scenes_share_a_draw(folder):
    """Of every kind of source beside every other: random snapshots and moving scenes with their weather, and scenarios."""
    with open(os.path.join(ROOT, "data", "scenarios", "random-roads.json"), encoding="utf-8") as file:
        roads = json.load(file)
    with open(os.path.join(folder, "mine.json"), "w", encoding="utf-8") as file:
        json.dump(roads | {"origin": "A copy."}, file)
    scenarios = [{"scenario": name, "scenes": [0, 12]} for name in ("varied-cut-in", "random-roads", "./mine.json")]
    drawn = [{"random": density, **more, "options": "--draw-conditions"} for density in ("sparse", "medium", "dense")
             for more in ({"frames": 12}, {"seconds": 1, "scenes": [0, 12]})]
    place, done = begin(folder, plan_of([*drawn, *scenarios], seeds=[1, 2], frames_per_shard=10000,
                                        splits={"by": "scene", "shares": {"train": 0.5, "test": 0.5}}))
    assert done.returncode == 0, done.stdout
    with open(os.path.join(place, "work", "layout.json"), encoding="utf-8") as file:
        commands = [command.split(" | ")[0] for shard in json.load(file)["shards"] for command in shard["commands"]]
    first, owner = {}, {}
    for command in commands:
        for frame in map(json.loads, printed(["glint", "-c", command], cwd=folder).splitlines()):
            first.setdefault(frame["scene"], frame)
    assert len(first) == 2 * 12 * 9, len(first)
    for scene, frame in first.items():
        for number in numbers_of(frame):
            assert owner.setdefault(number, scene) == scene, f"{scene} and {owner[number]} have {number}"


def recording(folder, name, rows):
    """A part of the shipped recording as a file of its own: the plan's path of it."""
    with open(os.path.join(ROOT, "data/trajectories/highway.csv"), encoding="utf-8") as table:
        lines = table.readlines()
    os.makedirs(os.path.join(folder, "traffic"), exist_ok=True)
    with open(os.path.join(folder, "traffic", name), "w", encoding="utf-8") as file:
        file.writelines([lines[0], *lines[rows]])
    return "traffic/" + name


def leaks_are_refused(folder):
    one, two = {"recording": "highway", "egos": ["1"]}, {"recording": "highway", "egos": ["7"], "scene": "other"}
    copied = {"recording": recording(folder, "copied.csv", slice(1, None)), "egos": ["7"]}
    by_recording = {"splits": {"by": "recording"}}
    with open(os.path.join(folder, copied["recording"]), "rb") as table, \
            gzip.open(os.path.join(folder, "traffic", "packed.csv.gz"), "wb") as file:
        file.write(table.read().replace(b"\n", b"\r\n"))
    packed = {"recording": "traffic/packed.csv.gz", "egos": ["7"]}
    medium = {"random": "medium", "frames": 20}
    alike = {"scenario": "cut-in", "scenes": [0, 30]}
    timed = one | {"from_s": 0, "to_s": 10}
    by_kind = {"by": "kind", "shares": {"a": 0.5, "b": 0.5}}
    shutil.copy(os.path.join(ROOT, "data", "scenarios", "cut-in.json"), os.path.join(folder, "other.json"))
    cases = [
        (plan_of([one], splits={"by": "ego"}), '/splits/by: "ego" leaks: egos of one recording see the same traffic'),
        (snapshots(9, splits={"by": "seed"}), '/splits/by: "seed" leaks: another seed is the same traffic'),
        (plan_of([one | {"split": "train"}, two | {"split": "test"}], **by_recording), "in two splits, so it leaks"),
        (plan_of([one | {"split": "train"}, copied | {"split": "test"}], **by_recording), "in two splits, so it leaks"),
        (plan_of([one | {"split": "train"}, packed | {"split": "test"}], **by_recording), "in two splits, so it leaks"),
        (plan_of([alike], splits={"by": "scene", "shares": SHARES}), "/sources/0: scenes cut-in/ego/0 and cut-in/ego/1 are alike"),
        (plan_of([medium, medium]), "/sources/1: its scenes have the names of those of /sources/0"),
        (plan_of([one], splits={"by": "scene", "shares": SHARES}), "cannot be split by scene"),
        (plan_of([medium], **by_recording), "cannot be split by recording"),
        (plan_of([timed], splits={"by": "time", "shares": SHARES}), "/splits/gap_s: missing: without a gap"),
        (plan_of([timed | {"egos": ["1", "7"]}], splits={"by": "time", "shares": {"a": 0.5, "b": 0.5}, "gap_s": 1}),
         "/splits/gap_s: 1; a body of highway moves in two splits, so it leaks; expected more than the 10 s"),
        (plan_of([{"scenario": name, "split": split} for name, split in (("cut-in", "a"), ("./other.json", "b"))], splits=by_kind),
         "/sources/1: scenes cut-in/ego and other/ego are alike"),
        (plan_of([medium | {"split": "c"}], splits=by_kind), "/sources/0/split: 'c'; expected one of a, b"),
        (plan_of([medium | {"split": "a"}], splits={"by": "scene", "shares": SHARES}), "split is for splits by recording or kind"),
        (plan_of([medium, {"scenario": "cut-in"}], splits=by_kind), "/sources/1: it is one scene, which cannot be split"),
        (plan_of([medium, timed], splits=by_kind), "/splits/gap_s: missing: without a gap"),
        (plan_of([medium], splits=by_kind | {"gap_s": 1}), "/splits/gap_s: is for splits by time"),
        (plan_of([medium, one | {"split": "a"}, copied | {"split": "b"}], splits=by_kind), "in two splits, so it leaks"),
        (plan_of([timed], splits={"by": "time", "shares": SHARES, "gap_s": 5}), "gaps fill all of highway"),
        (plan_of([one], splits={"by": "time", "shares": SHARES, "gap_s": 1}), "splits by time need from_s and to_s"),
        (plan_of([{"scenario": "cut-in"}], splits={"by": "scene", "shares": SHARES}), "it is one scene"),
        (snapshots(9, splits={"by": "scene", "shares": {"train": 0.8, "test": 0.1}}), "expected 1"),
        (snapshots(9, splits={"by": "scene", "shares": {"train": 0.99, "test": 0.01}}), "test gets no scene"),
        (plan_of([timed], splits={"by": "time", "shares": SHARES, "gap_s": 1e-9}), "/splits/gap_s: 1e-09; expected at least"),
        (plan_of([timed | {"to_s": 1e-7}]), "all gets no scene"),
    ]
    refusals(folder, cases, 65)


def scenes_that_differ_by_a_body_are_alike(folder):
    """A scenario of one split stands in no other: neither with a body more, less or changed, be it the ego, nor elsewhere, slower
    sampled, or cut short. Scenes that share no more than what stands beside the road, or the ego, do not leak."""
    ego, lead = {"id": "ego", "class": "car", "speed_mps": 20}, {"id": "lead", "class": "car", "x_m": 40, "speed_mps": 18}
    slow, rail = {"id": "slow", "class": "truck", "x_m": 60, "y_m": -4, "speed_mps": 15}, {"id": "rail", "class": "guardrail", "length_m": 200, "y_m": 8}
    parked = [{"id": f"parked{i}", "class": "car", "x_m": 10 * i, "y_m": 5, "speed_mps": 0} for i in range(1, 4)]
    base = [ego, lead, slow, rail]

    def scenario(name, objects, **members):
        with open(os.path.join(folder, name + ".json"), "w", encoding="utf-8") as file:
            json.dump({"origin": "For tests.", "ego": "ego", "rate_hz": 20, "duration_s": 2, "objects": objects} | members, file)
        return {"scenario": f"./{name}.json"}

    def moved(objects, **by):
        return [one | {key: one.get(key, 0) + value for key, value in by.items()} for one in objects]
    still = [one | {"speed_mps": 0} for one in (ego, *parked)]
    leaks = {"more": base + [parked[0]], "less": base[:2] + base[3:], "changed": [ego, lead | {"x_m": 50}, slow, rail],
             "other-ego": [ego | {"speed_mps": 22, "x_m": 3}, lead, slow, rail], "elsewhere": moved(base, x_m=500, y_m=20)}
    sources = {name: scenario(name, objects) for name, objects in leaks.items()}
    sources |= {"slower": scenario("slower", base, rate_hz=10), "aside": scenario("aside", base, rate_hz=15), "shorter": scenario("shorter", base, duration_s=1)}
    by_kind = {"splits": {"by": "kind", "shares": {"train": 0.5, "test": 0.5}}}

    def plan(one, two):
        return plan_of([one | {"split": "train"}, two | {"split": "test"}], **by_kind)
    refusals(folder, [(plan(scenario("base", base), source), f"/sources/1: scenes base/ego and {name}/ego are alike") for name, source in sources.items()]
             + [(plan(scenario("still", still), scenario("still-more", still + [lead | {"speed_mps": 0}])), "still/ego and still-more/ego are alike in most")], 65)
    others = [ego, lead | {"speed_mps": 17, "x_m": 33}, slow | {"speed_mps": 13}, rail]
    for name, one, two in (("rail", base, others), ("ego", [ego, lead], [ego, lead | {"x_m": 55, "speed_mps": 19}]),
                           ("parked", [ego, *parked], [ego, *moved(parked[:1], x_m=3), *moved(parked[1:], y_m=1)])):
        done = begin(folder, plan(scenario("one", one), scenario("two", two)), name)[1]
        assert done.returncode == 0, (name, done.stdout)


def what_cannot_be_made_is_refused(folder):
    medium = {"random": "medium", "frames": 20}
    refusals(folder, [
        (snapshots(0), "/sources/0/frames: 0; expected at least 1"),
        (snapshots(9, suites=[]), "/suites: []; expected at least this many items: 1"),
        (snapshots(9, colour="red"), "/colour: unknown member"),
        (snapshots(9, chain="cat"), "/chain: names no suite"),
        (snapshots(9, chain=CHAIN + " # a comment"), "/chain: has a comment"),
        (snapshots(9, splits={"by": "scene", "shares": {"train": 0.5, "work": 0.5}}), "'work' is a folder of every set"),
        (snapshots(9, chain=CHAIN + " > list"), "/chain: redirects"),
        (snapshots(9, chain="cat | " + CHAIN), "'cat' is no program of glint, and no file of your own"),
        (snapshots(9, lines="none"), '/lines: "none" needs tables'),
        (snapshots(9, lines="some"), "/lines: 'some'; expected one of ['whole', 'without_objects', 'none']"),
        (snapshots(9, tables=True, lines="none", level=3), "/level: a set without lines has none"),
        (snapshots(9, level=10), "/level: 10; expected at most 9 for gzip"),
        (snapshots(9, tables="parquet", lines="none", compression="zstd"), "/compression: Parquet has its own"),
        (snapshots(9, tables="excel"), "/tables: 'excel'; expected one of"),
        (snapshots(9, tables=1), "/tables: 1; expected one of"),
        (plan_of([medium | {"scenario": "cut-in"}]), "expected one of random, scenario, recording"),
        (plan_of([{"random": "medium"}]), "frames is missing"),
        (plan_of([medium | {"options": "--seed 3"}]), "--seed is the plan's to say"),
        (plan_of([medium | {"egos": ["1"]}]), "a random source has none"),
        (plan_of([medium | {"options": "'"}]), "/sources/0/options: No closing quotation"),
        (plan_of([{"random": "medium", "seconds": 1, "scenes": [0, 2], "rate_hz": 0.5}]), "expected a number in [1, 10000]"),
        (plan_of([{"recording": "highway", "egos": ["1"], "from_s": 0, "to_s": 9e9, "block_s": 1e-6}]), "more than 1000000 blocks"),
        (snapshots(9, chain=CHAIN + " --seed 7"), "/chain: --seed may not be in the chain"),
        (snapshots(9, chain=CHAIN + ' "--seed" 7'), "/chain: --seed may not be in the chain"),
        (snapshots(9, chain=CHAIN + " --se'ed=7'"), "/chain: --seed=7 may not be in the chain"),
        (snapshots(9, name="small\n"), "/name: 'small\\n'; expected one line"),
        (plan_of([{"recording": "traffic/a\nb.csv", "egos": ["1"]}]), "/sources/0/recording: 'traffic/a\\nb.csv'; expected one line"),
        (snapshots(9, name="small "), "/name: 'small '; expected a text like"),
        (snapshots(9, origin="\ud800"), "/origin: '\\ud800'; expected one line"),
        (snapshots(9, suites=[SUITE, f"{ROOT}/data/sensors/{SUITE}.json"]), f"/suites: {SUITE} is there twice"),
        (snapshots(9, suites=["./my radar.json"]), "./my radar.json: expected a file name of letters"),
        (snapshots(9, suites=[f"{ROOT}/schemas/sensors.json"]), "expected a suite of sensors"),
        (plan_of([{"scenario": f"{ROOT}/schemas/frame.json"}]), "expected a scenario with duration_s and rate_hz"),
    ], 65)
    refusals(folder, [(plan_of([{"recording": "nowhere.csv", "egos": ["1"]}]), "no such file"),
                      (snapshots(9, chain=CHAIN + " | python3 ./nowhere.py"), "/chain: python3 ./nowhere.py: no such file"),
                      (snapshots(9, suites=["nowhere"]), "no such file")], 66)
    refusals(folder, [(snapshots(9, chain=CHAIN.replace("--sections account", "--acount")), "/chain: this fails: glint -c")], 64)


def copied(folder, name, change, ids=range(1, 15), begin_s=0, end_s=20):
    """A part of the shipped recording with other ids, its rows changed: the plan's path of it."""
    path = os.path.join(folder, recording(folder, name, slice(1, None)))
    with open(path, encoding="utf-8", newline="") as table:
        head, *rows = csv.reader(table)
    rows = [dict(zip(head, row)) for row in rows]
    with open(path, "w", encoding="utf-8", newline="") as table:
        writer = csv.DictWriter(table, head)
        writer.writeheader()
        writer.writerows({**row, "track_id": 1000 + int(row["track_id"]), **change(row)} for row in rows
                         if int(row["track_id"]) in ids and begin_s <= int(row["timestamp_ms"]) / 1000 <= end_s)
    return "traffic/" + name


def copies_of_a_recording_are_known(folder):
    """Whatever their names, origins and times, whole or in part; other bodies of the same roads are no copy."""
    def moved(x_m, y_m, digits=6, time_ms=0):
        return lambda row: {"x": f"{float(row['x']) + x_m:.{digits}f}", "y": f"{float(row['y']) + y_m:.{digits}f}",
                            "timestamp_ms": int(row["timestamp_ms"]) + time_ms}

    one = {"recording": "highway", "egos": ["all"], "split": "train"}
    ways = [(moved(0, 0), {}), (moved(691000.5, -5334000.25), {}), (moved(12.345678, 0.5, digits=3), {}), (moved(0, 0, time_ms=30000), {}),
            (moved(3, 4), {"begin_s": 4, "end_s": 8}), (moved(3, 4), {"ids": (3, 9)})]
    for i, (change, part) in enumerate(ways):
        two = {"recording": copied(folder, f"{i}.csv", change, **part), "egos": ["all"], "split": "test"}
        leak = "/sources/1: its bodies move as those of /sources/0: both recordings have the same traffic, in two splits, so it leaks"
        place, done = begin(folder, plan_of([one, two], splits={"by": "recording"}), "refused")
        assert done.returncode == 65 and leak in done.stdout and not os.path.exists(place), f"{i}: {done.stdout}"
    timed = [{"recording": name, "egos": ["all"], "from_s": 0, "to_s": 10} for name in ("highway", "traffic/1.csv")]
    refusals(folder, [(plan_of(timed, splits={"by": "time", "shares": {"train": 0.5, "test": 0.5}, "gap_s": 1}), leak)], 65)
    halves = [{"recording": copied(folder, f"{name}.csv", moved(0, 0), ids=ids), "egos": ["all"], "split": name}
              for name, ids in (("train", range(1, 8)), ("test", range(8, 15)))]
    assert begin(folder, plan_of(halves, splits={"by": "recording"}))[1].returncode == 0


def what_no_frame_of_a_rehearsal_meets_is_refused(folder):
    timed = {"recording": "highway", "egos": ["1", "7"], "from_s": 0.1, "to_s": 10, "block_s": 2}
    late = {"recording": copied(folder, "late.csv", lambda row: {}, begin_s=0), "egos": ["1001", "1007"]}
    with open(os.path.join(folder, late["recording"]), encoding="utf-8") as file:
        rows = [line for line in file if not line.startswith("1007,") or int(line.split(",")[2]) < 6000]
    with open(os.path.join(folder, late["recording"]), "w", encoding="utf-8") as file:
        file.writelines(rows)
    moving = {"random": "medium", "seconds": 1, "scenes": [0, 2]}
    refusals(folder, [
        (plan_of([{"random": "medium", "frames": 9}, timed | late]), '/sources/1/egos: "1007" has no frame in the block that begins at 6.1 s'),
        (plan_of([timed | {"egos": ["1", "nobody"]}]), '/sources/0: this fails: glint-traffic highway --ego 1,nobody'),
        (plan_of([timed | {"options": "--class-map car=carr"}]), "/chain: this fails: glint -c"),
        (plan_of([moving | {"options": "--draw-conditions=7"}]), "/sources/0: this fails: glint -c"),
        (plan_of([moving | {"options": "--colour red"}]), "/sources/0: this fails: glint -c"),
    ], None)


def scenes_of_one_name_are_refused(folder):
    """Each is a scene of its own, so that a shard of several pipelines has no scene twice."""
    one, two = ({"recording": recording(folder, f"{name}.csv", rows), "egos": ["all"]}
                for name, rows in (("one", slice(1, 101)), ("two", slice(101, 201))))
    named = [({"scenario": "cut-in"}, {"scene": "cut-in/ego"}), (one, {"scene": "one@2"}), (one, {"scene": "one"}),
             (one | {"scene": "two/7"}, {}), ({"random": "medium", "frames": 1}, {"scene": "random-medium/1/0"})]
    refusals(folder, [(plan_of([source, two | other]), "/sources/1: its scenes have the names of those of /sources/0")
                      for source, other in named], 65)
    assert begin(folder, plan_of([one, two | {"scene": "one-more"}]))[1].returncode == 0


def refusals(folder, cases, code):
    for plan, message in cases:
        place, done = begin(folder, plan, "refused")
        assert done.returncode == code or code is None and done.returncode, f"{message}: {done.returncode}: {done.stdout}"
        assert message in done.stdout, f"{message}: {done.stdout}"
        assert not os.path.exists(place), f"{message}: leaves a folder"


def tables_of_a_suite_stand_in_the_set_or_are_refused(folder):
    for name in ("sensors", "antennas"):
        shutil.copytree(os.path.join(ROOT, "data", name), os.path.join(folder, "radars", name))
    shutil.copy(os.path.join(folder, "radars/antennas/corner77.csv"), os.path.join(folder, "outside.csv"))
    shutil.copy(os.path.join(folder, "outside.csv"), os.path.join(folder, "radars/sensors/beside.csv"))
    with open(os.path.join(folder, "radars", "sensors", SUITE + ".json"), encoding="utf-8") as file:
        suite = file.read()

    def with_table(table):
        with open(os.path.join(folder, "radars/sensors/mine.json"), "w", encoding="utf-8") as file:
            file.write(suite.replace("../antennas/corner77.csv", table))
        return snapshots(9, suites=["radars/sensors/mine.json"])

    place = made(folder, with_table("beside.csv"))
    assert "documents/sensors/beside.csv" in files(place), list(files(place))
    for table in ("../../outside.csv", folder + "/outside.csv"):
        refusals(folder, [(with_table(table), f"mine.json: {table}: expected a table in or below the folder above")], 65)
    refusals(folder, [(with_table("nowhere.csv"), "nowhere.csv: no such file")], 66)


def suites_that_a_suite_extends_stand_in_the_set(folder):
    for name in ("sensors", "antennas"):
        shutil.copytree(os.path.join(ROOT, "data", name), os.path.join(folder, "radars", name))
    os.rename(os.path.join(folder, "radars/sensors", SUITE + ".json"), os.path.join(folder, "radars/base.json"))
    base = json.loads(open(os.path.join(folder, "radars/base.json"), encoding="utf-8").read().replace("../antennas", "antennas"))

    def extending(word):
        for path, document in (("base.json", base), ("sensors/mine.json", {"extends": word})):
            with open(os.path.join(folder, "radars", path), "w", encoding="utf-8") as file:
                json.dump(document, file)
        return snapshots(9, suites=["radars/sensors/mine.json"])

    there = files(made(folder, extending("../base.json")))
    assert {"documents/sensors/mine.json", "documents/base.json", "documents/antennas/corner77.csv"} <= set(there), list(there)
    there = files(made(folder, extending("lrr77-coherent"), "other"))
    assert {"documents/sensors/lrr77-coherent.json", "documents/sensors/lrr77.json"} <= set(there), list(there)
    base["extends"] = "sensors/mine.json"
    refusals(folder, [(extending("../base.json"), "expected a suite that does not extend this one")], 65)


def vehicles_are_those_of_the_plan_or_of_its_suites(folder):
    """A set has the documents of one set of vehicles, whose word or path the plan has, or else all of its suites."""
    def document(*path):
        with open(os.path.join(ROOT, "data", *path), "rb") as file:
            return file.read()

    paper, detailed, wall = document("vehicles/car.json"), document("detailed/vehicles/car.json"), document("vehicles/wall.json")
    os.mkdir(os.path.join(folder, "mine"))
    shutil.copy(os.path.join(ROOT, "data/vehicles/van.json"), os.path.join(folder, "mine/car.json"))
    for number, (members, car) in enumerate((({}, paper), ({"suites": ["lrr77-full"]}, detailed), ({"vehicles": "detailed"}, detailed),
                                             ({"suites": ["lrr77-full"], "vehicles": "paper"}, paper),
                                             ({"suites": ["lrr77-full", "radarscenes77-full"]}, detailed),
                                             ({"suites": [SUITE, "lrr77-full"], "vehicles": "detailed"}, detailed),
                                             ({"vehicles": "./mine"}, document("vehicles/van.json")))):
        there = files(begin(folder, snapshots(9, **members), f"set{number}")[0])
        assert there["documents/vehicles/car.json"] == car, members
        assert there["documents/vehicles/wall.json"] == wall, members
    refusals(folder, [(snapshots(9, suites=[SUITE, "lrr77-full"]), "/vehicles: missing; the suites name detailed and paper"),
                      (snapshots(9, vehicles="mine"), '/vehicles: "mine" is no set of vehicles; expected a word as detailed or paper, '
                       'or the path of a folder: ./mine')], 65)
    refusals(folder, [(snapshots(9, vehicles="./nowhere"), "/vehicles: ")], 66)


def paths_may_have_any_letters(folder):
    """A plan's folder with letters that mean something to make and the shell, and a table that looks like an option."""
    home = os.path.join(folder, "it's $(my) #1 \"plan\"")
    os.mkdir(home)
    shutil.move(os.path.join(folder, recording(folder, "-table.csv", slice(1, None))), home)
    place = made(home, plan_of([{"recording": "-table.csv", "egos": ["7"], "to_s": 1}]))
    assert manifest(place)["frames"] > 0


# --- nothing lost ---------------------------------------------------------------------------------

def another_plan_in_the_folder_is_refused(folder):
    place = made(folder, snapshots(20))
    before = files(place)
    _, done = begin(folder, snapshots(30))
    assert done.returncode == 73 and "holds the set of another plan" in done.stdout, done.stdout
    assert files(place) == before
    place, done = begin(folder, snapshots(20))
    assert done.returncode == 0 and make(place).returncode == 0 and files(place) == before
    os.makedirs(os.path.join(folder, "full", "of things"))
    _, done = begin(folder, snapshots(20), "full")
    assert done.returncode == 73 and "holds other files" in done.stdout, done.stdout


def at_once(commands):
    """Runs commands beside each other; their exit codes and what they print."""
    runs = [subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) for words in commands]
    printed = [process.communicate(timeout=PATIENCE_S)[0] for process in runs]
    return [process.returncode for process in runs], printed


def two_plans_at_once_make_one_set(folder):
    for seed in (1, 2):
        with open(os.path.join(folder, f"{seed}.json"), "w", encoding="utf-8") as file:
            json.dump(snapshots(9, seeds=[seed]), file)
    for attempt in range(3):
        place = os.path.join(folder, f"set{attempt}")
        codes, printed = at_once([[DATASET, f"{folder}/{seed}.json", "--out", place] for seed in (1, 2)])
        assert sorted(codes) == [0, 73], printed
        assert make(place).returncode == 0 and manifest(place)["plan"]["seeds"] == [codes.index(0) + 1]


def who_finishes_at_once_disturbs_nobody(folder):
    place = made(folder, snapshots(20))
    right = files(place)
    for _ in range(8):
        os.remove(os.path.join(place, "datapackage.json"))
        codes, printed = at_once([[DATASET, "--in", place, "--plan-folder", folder, "--finish"]] * 4)
        assert codes == [0] * 4 and files(place) == right, printed


def what_is_damaged_is_made_again(folder):
    place = made(folder, snapshots(40))
    right = files(place)
    shards = sorted(name for name in right if name.endswith(".jsonl.gz"))

    def flip(name):
        with open(os.path.join(place, name), "r+b") as file:
            file.seek(len(right[name]) // 2)
            file.write(bytes([right[name][len(right[name]) // 2] ^ 1]))

    def cut(name):
        os.truncate(os.path.join(place, name), len(right[name]) - 1)

    def remove(name):
        os.remove(os.path.join(place, name))

    for damage, name in ((flip, shards[0]), (cut, shards[1]), (remove, shards[2]), (flip, "work/part-3.json")):
        damage(name)
        done = make(place)
        assert done.returncode == 0 and "it is made again" in done.stdout, f"{damage.__name__} {name}: {done.stdout}"
        assert files(place) == right, f"{damage.__name__} {name}"
    flip("documents/sensors/" + SUITE + ".json")
    remove("work/part-0.json")
    done = make(place)
    assert done.returncode != 0 and "has changed since the set was begun" in done.stdout, done.stdout
    assert "datapackage.json" not in files(place)


HOLDER = """
import sys
sys.path.insert(0, sys.argv[1])
from glint.sets import durable
with durable.whole_file("{place}/file", "{place}"), durable.temporary_folder("folder", "{place}"):
    print("begun", flush=True)
    sys.stdin.read()
"""


def temporaries_of_the_living_stay(folder):
    """Also those of another container with this host name; those of the killed go, whatever has their numbers now."""
    from glint.sets import durable
    alone = ["unshare", "-rpf", "--mount-proc", "--kill-child", sys.executable]
    if run([*alone, "-c", ""]).returncode != 0:
        print("skipped  temporaries of another container: this machine lets nobody begin a namespace; tried without one")
        alone = [sys.executable]
    with subprocess.Popen([*alone, "-c", HOLDER.format(place=folder), SCRIPTS], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          text=True) as holder:
        assert holder.stdout.readline() == "begun\n"
        for of_all in (False, True):
            durable.remove_temporaries(folder, of_all=of_all)
            assert len(os.listdir(folder)) == 2, f"{os.listdir(folder)} are left of two temporaries in use"
        holder.kill()
        holder.wait()
        holder.stdout.read()
    durable.remove_temporaries(folder)
    assert not os.listdir(folder), f"{os.listdir(folder)} are left of a killed process"


def an_ego_may_have_any_letters_in_its_id(folder):
    name = recording(folder, "ids.csv", slice(1, 102))
    path = os.path.join(folder, name)
    with open(path, encoding="utf-8") as file:
        head, *rows = file.readlines()
    with open(path, "w", encoding="utf-8") as file:
        file.writelines([head, *('"a,b\\c"' + row[1:] for row in rows)])
    place = made(folder, plan_of([{"recording": name, "egos": ["a,b\\c"]}]))
    egos = {json.loads(line)["ego"] for line in frames_of(place, "all/*").splitlines()}
    assert egos == {"a,b\\c"}, egos


def one_failing_scene_stops_no_other(folder):
    names = [recording(folder, f"{i}.csv", slice(1 + 100 * i, 101 + 100 * i)) for i in range(4)]
    place, done = begin(folder, plan_of([{"recording": name, "egos": ["all"]} for name in names]))
    assert done.returncode == 0, done.stdout
    path = os.path.join(folder, names[2])
    with open(path, encoding="utf-8") as file:
        good = file.read()
    with open(path, "w", encoding="utf-8") as file:
        file.write(good[:-40])
    done = make(place)
    assert done.returncode != 0 and "1 of 4 shards are missing: part-2;" in done.stdout, done.stdout
    assert f"{names[2]}: has changed since the set was begun" in done.stdout
    there = files(place)
    assert sum(name.endswith(".jsonl.gz") for name in there) == 3 and "datapackage.json" not in there, list(there)
    with open(path, "w", encoding="utf-8") as file:
        file.write(good)
    assert make(place).returncode == 0
    assert files(place) == files(made(folder, plan_of([{"recording": name, "egos": ["all"]} for name in names]), "right"))


def a_chain_that_fails_is_named(folder):
    """By a class without a document, which the rehearsal does not meet."""
    body = {"id": "ego", "class": {"choice": ["car"] * 8 + ["unicycle"]}, "speed_mps": 5}
    with open(os.path.join(folder, "mine.json"), "w", encoding="utf-8") as file:
        json.dump({"origin": "a test", "ego": "ego", "rate_hz": 10, "duration_s": 1, "objects": [body]}, file)
    place, done = begin(folder, plan_of([{"scenario": "./mine.json", "scenes": [0, 20]}]))
    assert done.returncode == 0, done.stdout
    played = printed(["glint-traffic", "./mine.json", "--scenes", "0:20"], cwd=folder)
    wrong = sorted({int(frame["scene"].split("/")[2]) for frame in map(json.loads, played.splitlines())
                    if frame["objects"][0]["class"] == "unicycle"})
    done = make(place)
    assert wrong and done.returncode != 0 and "exit status 65: glint -c" in done.stdout, done.stdout
    assert all(f"part-{part}, all/" in done.stdout for part in wrong), done.stdout
    missing = " ".join(f"part-{part}" for part in wrong)
    assert f"{len(wrong)} of 20 shards are missing: {missing};" in done.stdout, done.stdout


def a_full_disk_loses_nothing(folder):
    """A file system with room for half of the shards, in a mount of its own."""
    plan = snapshots(60)
    right = files(made(folder, plan, "right"))
    pages = {name: 1 + len(content) // 4096 for name, content in right.items()}
    shards = sum(count for name, count in pages.items() if name.endswith(".jsonl.gz"))
    size = 4 * (sum(pages.values()) - shards // 2)
    disk, script = os.path.join(folder, "disk"), f"""
        mount -t tmpfs -o size={size}k glint {folder}/disk || exit 99
        {DATASET} {folder}/set.json --out {folder}/disk/set && make -s -C {folder}/disk/set -j2
        echo made $?; ls -A {folder}/disk/set/work | grep tmp; ls {folder}/disk/set/datapackage.json
        mount -o remount,size=100m {folder}/disk && make -s -C {folder}/disk/set -j2 && cp -r {folder}/disk/set {folder}/copy"""
    os.mkdir(disk)
    with open(os.path.join(folder, "set.json"), "w", encoding="utf-8") as file:
        json.dump(plan, file)
    done = run(["unshare", "-rm", "bash", "-c", script])
    if done.returncode in (1, 99) and "made" not in done.stdout:
        print("skipped  a full disk loses nothing: this machine lets nobody mount a small disk")
        return
    assert "No space left on device" in done.stdout and "shards are missing" in done.stdout, done.stdout
    assert "made 2" in done.stdout and ".tmp\n" not in done.stdout, done.stdout
    assert files(os.path.join(folder, "copy")) == right


def kill_at_random(place, draws):
    """Begins a run and kills all of it, or one of its processes, at a random time. True if it ended before."""
    process = subprocess.Popen(["make", "-s", "-C", place, "-j2"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               start_new_session=True)
    time.sleep(draws.random() * 0.4)
    with open(f"/proc/{process.pid}/stat", encoding="ascii") as stat:
        ended = stat.read().split(") ")[1][0] == "Z"
    if draws.random() < 0.3:
        kill_one(process.pid, draws)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    return ended


def kill_one(session, draws):
    """Kills one process of a session, and lets the others go on for a moment."""
    members = []
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{name}/stat", encoding="ascii") as stat:
                if int(stat.read().rsplit(") ", 1)[1].split()[3]) == session:
                    members.append(int(name))
        except (FileNotFoundError, ProcessLookupError):
            continue
    try:
        os.kill(draws.choice(members), signal.SIGKILL)
    except (ProcessLookupError, IndexError):
        return
    time.sleep(draws.random() * 0.05)


def kills_lose_nothing(folder, kills, scenes):
    """Kills runs of a set until there were enough; a set that gets done is begun again. Each is then as if never killed."""
    plan = snapshots(scenes, frames_per_shard=4)
    right, draws, done, place = files(made(folder, plan, "right")), random.Random(1), 0, None
    progress = Progress("kills", kills)
    while done < kills:
        place, _ = begin(folder, plan)
        while done < kills and not kill_at_random(place, draws):
            done += 1
            progress.step()
        last = make(place)
        found = files(place)
        other = sorted(name for name in found.keys() | right.keys() if found.get(name) != right.get(name))
        assert last.returncode == 0 and not other, f"after {done} kills: {other}: {last.stdout}"
        shutil.rmtree(place)
    progress.end()


# --- engines --------------------------------------------------------------------------------------

PAGE = os.path.join(ROOT, "data", "sets", "README.md")


def block_of_page(first_word, kind="sh"):
    """A block of the page, by how it begins."""
    with open(PAGE, encoding="utf-8") as page:
        blocks = re.findall(rf"```{kind}\n(.*?)```", page.read(), re.DOTALL)
    return next(block for block in blocks if block.startswith(first_word))


def parallel_makes_the_same_bytes(folder):
    """By the lines of the page, whose set is called small."""
    plan = snapshots(64)
    right = files(made(folder, plan, "right"))
    begin(folder, plan, "small")
    lines = block_of_page("# GNU parallel")
    assert len(lines.splitlines()) <= 12
    done = run(["bash", "-e", "-o", "pipefail", "-c", lines], cwd=folder)
    assert done.returncode == 0 and files(os.path.join(folder, "small")) == right, done.stdout


def program(folder, name, text):
    """A folder with a program of one's own, and the environment that has it."""
    place = os.path.join(folder, "tools")
    os.makedirs(place, exist_ok=True)
    with open(os.path.join(place, name), "w", encoding="ascii") as file:
        file.write(text)
    os.chmod(os.path.join(place, name), 0o755)
    return os.environ | {"PATH": place + os.pathsep + os.environ["PATH"]}


def jobs_without_a_number_are_refused(folder):
    """Programs that stand for Slurm's: an sbatch that prints no id, one whose array gets no number, and one that fails."""
    place, _ = begin(folder, snapshots(20))
    for sbatch, message in (("true", "sbatch printed '' instead of the id"), ("false", "exit status 1: sbatch"),
                            ("echo Submitted batch job 7", "instead of the id")):
        program(folder, "scontrol", "#!/bin/sh\necho MaxArraySize = 1001\n")
        tools = program(folder, "sbatch", f"#!/bin/sh\n{sbatch}\n")
        done = run(["make", "-s", "-C", place, "slurm"], env=tools)
        assert done.returncode == 2 and message in done.stdout, done.stdout
    done = run(["sh", os.path.join(place, "work/slurm/part.sh")], env=os.environ | {"SLURM_ARRAY_TASK_ID": ""})
    assert done.returncode != 0 and "SLURM_ARRAY_TASK_ID: is empty" in done.stdout, done.stdout
    for letter in "%\\":
        done = run([DATASET, f"{folder}/set.json", "--out", f"{folder}/100{letter}", "--slurm"])
        assert done.returncode == 65 and "Slurm takes no path with % or \\" in done.stdout, done.stdout
        assert not os.path.exists(f"{folder}/100{letter}")


CHECKS = [shards_join_to_the_bytes_of_one_run, scenes_and_seeds_are_played_whole, the_manifest_says_what_is_there,
          tables_have_the_targets_of_their_lines, every_table_joins_every_other, counts_of_the_page_add_up,
          counts_add_up_at_the_edges, what_is_kept_is_the_same_however_it_is_packed, parquet_needs_duckdb,
          own_stages_stand_in_a_chain, words_of_a_stage_may_have_bars_and_hashes, several_kinds_of_source_share_nothing_between_splits, make_shows_how_far_it_is,
          recordings_tell_licence_and_source, rows_are_counted_wherever_a_table_is_cut,
          blocks_of_time_keep_their_gap, blocks_of_a_resampled_recording_have_all_frames, no_two_scenes_share_a_draw,
          leaks_are_refused, scenes_that_differ_by_a_body_are_alike, copies_of_a_recording_are_known, what_no_frame_of_a_rehearsal_meets_is_refused, what_cannot_be_made_is_refused,
          scenes_of_one_name_are_refused, tables_of_a_suite_stand_in_the_set_or_are_refused,
          suites_that_a_suite_extends_stand_in_the_set, vehicles_are_those_of_the_plan_or_of_its_suites, paths_may_have_any_letters,
          another_plan_in_the_folder_is_refused, two_plans_at_once_make_one_set, who_finishes_at_once_disturbs_nobody,
          what_is_damaged_is_made_again, temporaries_of_the_living_stay, one_failing_scene_stops_no_other,
          an_ego_may_have_any_letters_in_its_id, a_chain_that_fails_is_named, a_full_disk_loses_nothing, parallel_makes_the_same_bytes,
          jobs_without_a_number_are_refused]
# What a set is and that it is refused where it would mislead; the rest is about how it is made.
IN_QUICK_RUN = [shards_join_to_the_bytes_of_one_run, scenes_and_seeds_are_played_whole, the_manifest_says_what_is_there,
                tables_have_the_targets_of_their_lines, counts_add_up_at_the_edges, own_stages_stand_in_a_chain,
                no_two_scenes_share_a_draw, vehicles_are_those_of_the_plan_or_of_its_suites, leaks_are_refused, what_is_damaged_is_made_again]


def use(programs):
    """Has everything here use the programs of a folder."""
    os.environ["PATH"] = os.path.abspath(programs) + os.pathsep + os.environ["PATH"]
    os.environ["BUILD"] = os.path.relpath(os.path.dirname(os.path.abspath(programs)), ROOT)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("bin")
    parser.add_argument("--kills", type=int, default=quick(5, 20))
    parser.add_argument("--scenes", type=int, default=quick(60, 100))
    options = parser.parse_args()
    use(options.bin)
    for check in quick(IN_QUICK_RUN, CHECKS):
        with tempfile.TemporaryDirectory() as folder:
            check(folder)
        print(check.__name__.replace("_", " "), flush=True)
    with tempfile.TemporaryDirectory() as folder:
        kills_lose_nothing(folder, options.kills, options.scenes)
    print(f"{options.kills} kills lose nothing")


if __name__ == "__main__":
    main()
