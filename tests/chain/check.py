"""glint-check and scripts/check-set find what is wrong, and nothing in what is right.

Usage: python3 tests/chain/check.py BIN_DIR        exit status 1 if any check fails

Faults are planted here: in single values of a stream, in the order of its frames, in tables, and in a set every
truncation of 20 files and every flipped bit of five. Of the flipped bits of a bare stream, those that leave it valid
are counted and printed.
"""
import gzip
import hashlib
import importlib.machinery
import importlib.util
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(ROOT, "tests", "support"))
sys.path.append(os.path.join(ROOT, "scripts"))
import glint  # noqa: E402
from sizes import quick  # noqa: E402

CHAIN = "glint-extract | glint-ideal --sensors {} | glint-sensor | glint-noise"
# Streams, and the options with which glint-check recomputes their labels.
SOUND = [
    ("glint pipelines/intersection.sh", ""), ("glint pipelines/contour.sh", "--extract extract-contour"),
    ("glint pipelines/3gpp.sh", "--extract extract-3gpp"), ("glint pipelines/wheels-and-limbs.sh", ""),
    ("glint pipelines/smear.sh", ""), ("glint pipelines/ghosts.sh", ""), ("glint pipelines/snow.sh", ""),
    ("glint-traffic-random --frames 60 --draw-conditions --density dense | "
     + CHAIN.format("radarscenes77-full --sections account,reflectors"), ""),
    ("glint-traffic-random --frames 60 --density dense | glint-extract --vehicles data/detailed/vehicles --sections "
     "reflectors | glint-ideal --sensors corner77-uncompensated | glint-sensor | glint-noise", ""),
    ("glint-traffic-random --frames 30 --density medium | glint-extract --vehicles surfaces | glint-ideal --sensors "
     "corner77 --sections account,visibility | glint-sensor | glint-noise", ""),
]
PLANTED = "glint-traffic side-crossing | " + CHAIN.format("srr24-pair --sections account,visibility")
FLIPS = quick(100, 300)
EVERY = quick(7, 1)  # so many lengths of a cut file, and so many bits, are one that is tried
faults, checks = [], 0


def check(good, text):
    global checks
    checks += 1
    if not good:
        faults.append(text)


def run(command, bin_dir, data=None):
    environment = dict(os.environ, PATH=bin_dir + os.pathsep + os.environ["PATH"], GLINT_DATA=ROOT + "/data")
    return subprocess.run(["bash", "-o", "pipefail", "-c", command], env=environment, cwd=ROOT, input=data,
                          capture_output=True, check=False)


def stream_of(command, bin_dir):
    done = run(command, bin_dir)
    if done.returncode != 0:
        sys.exit(f"check: {command}: {done.stderr.decode()}")
    return done.stdout


def lines_of(frames):
    return "".join(json.dumps(frame) + "\n" for frame in frames).encode()


def direct_part(frames, point):
    """A contributor that a point of a car made (or a flat side), the number of its frame, and its path."""
    for number, frame in enumerate(frames):
        for i, target in enumerate(frame["targets"]):
            for j, part in enumerate(target["contributors"]):
                if part["path"] == "direct" and part["reflector"].startswith("corner") == point and part["range_rate_mps"]:
                    return part, number, f"targets[{i}].contributors[{j}]."
    sys.exit("check: no such contributor")


def values(bin_dir, text):
    """A value of a label that is off by 1e-8 is found and named; one that is off by 1e-12 is none."""
    for point, member, floor in ((True, "range_m", 0), (True, "azimuth_rad", 1), (True, "range_rate_mps", 0),
                                 (False, "range_rate_mps", 0), (True, "time_s", 1)):
        for share, wanted in ((1e-8, 65), (1e-12, 0)):
            frames = [json.loads(line) for line in text.splitlines()]
            part, number, path = direct_part(frames, point)
            part[member] += share * max(abs(part[member]), floor, 10 * (member == "range_rate_mps"))
            done = run("glint-check", bin_dir, lines_of(frames))
            check(done.returncode == wanted and (wanted == 0 or f"stdin:{number + 1}: {path}{member}:" in
                                                 done.stderr.decode()), f"{member} off by {share}: {done.stderr.decode()}")


def truth(bin_dir, text):
    """A stream whose objects, names, weights, mounts or frames are others is refused."""
    def plant(name, change, expected):
        frames = [json.loads(line) for line in text.splitlines()]
        frames = change(frames) or frames
        done = run("glint-check", bin_dir, lines_of(frames))
        check(done.returncode == 65 and expected in done.stderr.decode(), f"{name}: {done.returncode} {done.stderr.decode()}")

    def seen(frames):
        part, number, _ = direct_part(frames, True)
        return frames[number], part

    def move(frames, member, step, ego):
        frame, part = seen(frames)
        name = frame["ego"] if ego else part["object"]
        next(one for one in frame["objects"] if one["id"] == name)[member] += step

    for ego in (False, True):
        for member in ("x_m", "y_m", "yaw_rad", "vx_mps", "vy_mps", "yaw_rate_radps"):
            plant(member, lambda frames, member=member, ego=ego: move(frames, member, 1e-6, ego), "contributors[")
    for member in ("length_m", "width_m"):
        plant(member, lambda frames, member=member: move(frames, member, 1e-6, False), "contributors[")
    plant("mount", lambda frames: frames[0]["sensors"]["list"][0].update(mount_yaw_rad=1e-6), "list[0].mount_yaw_rad")
    plant("weight", lambda frames: seen(frames)[1].update(weight=0.5), "weights sum to")
    plant("another object", lambda frames: seen(frames)[1].update(object="nobody"), 'no echo of "nobody"')
    plant("a missing frame", lambda frames: frames[:3] + frames[4:], "frame: 4 of scene")
    plant("no last frame", lambda frames: frames[:-1], "last")
    plant("two frames swapped", lambda frames: [frames[1], frames[0], *frames[2:]], "frame")
    plant("a loss that is missing", lambda frames: frames[0]["lost"][0]["echoes"].pop() and None, "account")
    for path in ("clutter", "false_alarm"):
        plant(path, lambda frames, path=path: seen(frames)[1].update(path=path), "entries of path direct")
    plant("another reason", lambda frames: frames[0]["lost"][0].update(reason="list_limit"), "lost[0].echoes: of these objects")
    plant("a loss elsewhere", lambda frames: frames[0]["lost"][0]["echoes"][0].update(range_m=1), "lost[0].echoes[0].range_m")
    plant("a loss of nobody", lambda frames: frames[0]["lost"][0]["echoes"][0].update(object="nobody"), "lost[0].echoes: of these")
    plant("a count", lambda frames: frames[0]["counts"][1]["paths"][0].update(echoes=99), "counts[1].paths: direct echoes: 99;")
    plant("pairs", lambda frames: frames[0]["counts"][0].update(pairs=1), "entries of path direct; 1 are due")
    plant("a path", lambda frames: frames[0]["counts"][0]["paths"].append({"path": "wheel", "echoes": 1}), "path wheel; 1 are due")
    for member in ("reflectors", "in_range", "in_view", "detections"):
        plant(member, lambda frames, member=member: frames[5]["visibility"][0].update({member: 77}), f"visibility[0].{member}: 77;")
    plant("an echo's cross section", lambda frames: seen(frames)[1].update(ercs=9), "ercs: 9; recomputed")
    plant("no measurement", lambda frames: frames[0]["sensors"]["list"][0].update(measured=False), "list[0].measured")
    plant("a value out of bounds", lambda frames: seen(frames)[0]["targets"][0].update(range_m=-1), "outside")
    for due, wanted in ((True, 65), (False, 0)):  # one frame in four, from the first on
        frames = [json.loads(line) for line in text.splitlines()]
        number = next(i for i, frame in enumerate(frames) if frame["targets"] and (i % 4 == 0) == due)
        frames[number]["targets"][0]["contributors"][0]["range_m"] += 1e-3
        done = run("glint-check --every 4", bin_dir, lines_of(frames))
        check(done.returncode == wanted, f"frame {number} of --every 4: {done.stderr.decode()}")


def every_lost_echo_may_name_its_object_and_path(bin_dir, text):
    """As in streams of earlier versions."""
    full = lines_of(glint.name_lost(json.loads(line)) for line in text.splitlines())
    check(full.count(b'"object"') > 1.5 * text.count(b'"object"'), "most lost echoes are of the object before")
    for command in ("glint-check", "glint-summary", "glint-view -o /dev/stdout"):
        short, told = run(command, bin_dir, text), run(command, bin_dir, full)
        check(told.returncode == 0 and told.stdout == short.stdout, f"{command}: {told.stderr.decode()}")


def ghosts_are_counted(bin_dir):
    """Without an account, too: what ideal counts is counted again."""
    text = stream_of("glint-traffic walled-road | glint-extract | glint-ideal --sensors lrr77-full | glint-sensor | glint-noise",
                     bin_dir)
    for old, member in ((rb'("path":"wall_object","echoes":)\d+', b"wall_object echoes: 99; "), (rb'("pairs":)\d+', b"pairs: 99; ")):
        said = run("glint-check", bin_dir, re.sub(old, rb"\g<1>99", text, count=1))
        check(said.returncode == 65 and member in said.stderr, f"{old}: {said.stderr.decode()}")


def flips(bin_dir, text):
    """Flipped bits of a bare stream: how many stay valid. Those of digits that no truth recomputes, and of names."""
    draw, valid = random.Random(1), 0
    line = text.splitlines(keepends=True)[0]
    whole = lines_of([json.loads(line) | {"last": True}])
    for _ in range(FLIPS):
        bit = draw.randrange(8 * len(whole))
        flipped = bytearray(whole)
        flipped[bit // 8] ^= 1 << bit % 8
        valid += run("exec glint-check", bin_dir, bytes(flipped)).returncode == 0
    check(0 < valid < FLIPS / 2, f"{valid} of {FLIPS} flips stay valid")
    return f"{valid} of {FLIPS} flipped bits of a bare frame stay valid ({valid / FLIPS:.0%})"


def check_set():
    """scripts/check-set as a module, beside its package."""
    sys.path.insert(0, ROOT + "/scripts")
    loader = importlib.machinery.SourceFileLoader("check_set", ROOT + "/scripts/check-set")
    spec = importlib.util.spec_from_loader("check_set", loader)
    module = importlib.util.module_from_spec(spec)
    loader.exec_module(module)
    return module


def fault_of(module, data, entry):
    """What the script's own functions say of a file's bytes; entry None: of the manifest's."""
    try:
        return module.fault_of_manifest(data) if entry is None else module.fault_of_bytes(len(data), module.digest_of(data), entry)
    except (ValueError, KeyError, TypeError) as error:
        return str(error)


def forge(folder, package, text=None):
    """Writes a manifest whose last line is the digest of the lines before it."""
    text = text or json.dumps({name: value for name, value in package.items() if name != "digest"}, indent=1)
    text = text.removesuffix("\n}") + ",\n"
    with open(f"{folder}/set/datapackage.json", "w", encoding="utf-8") as file:
        file.write(text + f' "digest": "sha256:{hashlib.sha256(text.encode()).hexdigest()}"}}\n')


def forged(module, folder, package):
    """A manifest of other values, whose digest is its own, is told from the set's, or says nothing that is checked."""
    stream, table, document = package["resources"][0], package["resources"][1], package["documents"][0]
    places = [(package, name) for name in package] + [(one, name) for one in (stream, table, document) for name in one]
    free, tried = {"profile", "name", "description", "program", "identity", "plan", "inputs", "digest"}, 0
    for record, name in places:
        kept = record[name]
        for value in (None, "", "x", "/etc/passwd", "../x", "a/../b", "a\0b", 0, -1, 1.5, float("inf"), 10 ** 400, [], [7], {}, True):
            if value == kept or value == [] and name in ("commands", "documents"):  # says less, nothing false
                continue
            record[name] = value
            forge(folder, package)
            found, _ = module.check(f"{folder}/set")
            checked = record is package and name not in free or name in module.PACKAGE["resources"][0]
            check(found or not checked or record is document, f"{name}: {value!r:.40} of the manifest passes")
            check(not any("Traceback" in line or "\n" in line for line in found), f"{name}: {value!r:.40}: {found}")
            tried += 1
        record[name] = kept
    lists = {"a shard twice": [*package["resources"], stream], "no stream before its tables": package["resources"][1:],
             "a shard left out": [one for one in package["resources"] if "00000" not in one["path"]],
             "other rows": [stream, dict(table, rows=table["rows"] + 1), *package["resources"][2:]],
             "another table": [stream, dict(table, path=os.path.dirname(table["path"]) + "/others.csv.gz")]}
    for name, resources in lists.items():
        frames = sum(entry["rows"] for entry in resources if module.is_stream(entry))
        forge(folder, {**package, **module.sums_of(resources), "frames": frames, "resources": resources})
        check(module.check(f"{folder}/set")[0], f"{name} passes")
    for text in ('{"a": ' + "[" * 9999 + "]" * 9999 + "\n}", '{"frames": 1' + "0" * 5000 + "\n}", '{"x": NaN\n}', "[1\n}"):
        forge(folder, None, text)
        check(module.check(f"{folder}/set")[0], f"{text[:20]} passes")
    forge(folder, package)
    check(module.check(f"{folder}/set")[0] == [], "the manifest itself")
    return tried


def agree(module, folder, package, entry, data=None):
    """Forges a manifest whose sums are those of its files; with data, a file has these bytes, and its entry agrees with them."""
    if data is not None:
        with open(f"{folder}/set/{entry['path']}", "wb") as file:
            file.write(data)
        entry |= {"bytes": len(data), "hash": module.digest_of(data)}
    package |= module.sums_of(package["resources"])
    forge(folder, package)


def each_check(module, folder, package):
    """Each single check of a set finds the fault that it is for, where all others agree with it, and says what it found."""
    shutil.copytree(f"{folder}/set", f"{folder}/sound")
    number = {os.path.basename(one["path"]): i for i, one in enumerate(package["resources"][:8])}
    stream, table, frames = (number[name] for name in ("00000.jsonl.gz", "objects.csv.gz", "frames.csv.gz"))
    other = len(number) + table  # the table of the second shard

    def expect(what, message, change, every=1):
        shutil.rmtree(f"{folder}/set")
        shutil.copytree(f"{folder}/sound", f"{folder}/set")
        forged_one = json.loads(json.dumps(package))
        change(forged_one, forged_one["resources"])
        found = module.check(f"{folder}/set", 2, every)[0]
        check(any(message in one for one in found) if message else not found, f"{what}: {found}; expected {message!r}")

    def said(**members):
        """Members of the manifest, or of the table, that are other ones."""
        def change(forged_one, resources):
            for name, value in members.items():
                record = forged_one if name in ("frames", "plan") or len(members) > 1 else resources[table]
                record[name] = value(record[name])
            forge(folder, forged_one) if record is forged_one else agree(module, folder, forged_one, resources[table])
        return change

    def bytes_of(which, packed):
        """Other bytes of a file, with which its entry agrees."""
        return lambda forged_one, resources: agree(module, folder, forged_one, resources[which], packed(read(which)))

    def read(which):
        with open(f"{folder}/sound/{package['resources'][which]['path']}", "rb") as file:
            return file.read()

    def of_files(change):
        return lambda _, resources: change(f"{folder}/set", [f"{folder}/set/{one['path']}" for one in resources])

    def label(forged_one, resources):
        """A label that the chain does not give, in a file that is right by its entry."""
        text = re.sub(rb'("ercs":)[^,]+', rb"\g<1>7.5", gzip.decompress(read(stream)), count=1)
        resources[stream] |= {"content_bytes": len(text), "content_hash": module.digest_of(text)}
        agree(module, folder, forged_one, resources[stream], gzip.compress(text))

    def rows(forged_one, resources):
        resources[frames]["rows"] += 1
        agree(module, folder, forged_one, resources[frames])

    def renamed(forged_one, resources):
        old = resources[table]["path"]
        resources[table]["path"] = old.replace("objects", "others")
        os.rename(f"{folder}/set/{old}", f"{folder}/set/{resources[table]['path']}")
        agree(module, folder, forged_one, resources[table])

    def swapped(which):
        def change(forged_one, resources):
            source = resources[table if which == other else other]
            resources[which] |= {name: source[name] for name in ("rows", "content_bytes", "content_hash")}
            agree(module, folder, forged_one, resources[which], read(table if which == other else other))
        return change

    def twice(forged_one, resources):
        forged_one["documents"].append(forged_one["documents"][0])
        forge(folder, forged_one)

    def streams_last(forged_one, resources):
        resources[:2] = resources[1::-1]
        agree(module, folder, forged_one, resources[0])
    expect("a sound set", "", lambda *_: None)
    expect("a byte of the manifest", "the last line is not the digest", of_files(lambda place, _: os.truncate(f"{place}/datapackage.json", os.path.getsize(f"{place}/datapackage.json") - 1)))
    expect("frames in words", "frames: 'x'; expected a whole number", said(frames=lambda _: "x"))
    expect("a chain with a hole", "chain: 'a | | b'; expected stages", said(plan=lambda plan: plan | {"chain": "a | | b"}))
    expect("a document twice", "is listed twice", twice)
    expect("tables before their stream", "expected the stream of a shard and then its tables", streams_last)
    expect("a stream where there is none", "expected no stream, but tables", said(plan=lambda plan: plan | {"lines": "none"}))
    expect("frames without a line", "the stream and the table of frames differ in rows", rows)
    for name in (*module.SUMS, "frames"):
        expect(f"the sum of {name}", f"datapackage.json: {name}: ", said(**{name: lambda count: count + 1, "plan": dict}))
    expect("the digest of all content", "datapackage.json: content_hash: ", said(content_hash=lambda _: "sha256:0", plan=dict))
    for name in ("rows", "content_bytes"):
        expect(f"{name} of a table", f"objects.csv.gz: {name}: ", said(**{name: lambda count: count + 1}))
    expect("the content of a table", "objects.csv.gz: content_hash: ", said(content_hash=lambda _: "sha256:" + 64 * "0"))
    expect("a byte that packs alike", "objects.csv.gz: hash: ", of_files(lambda _, paths: flip(paths[table], 9)))
    expect("a byte of a document", "README.md: hash: ", of_files(lambda place, _: flip(f"{place}/README.md", 9)))
    expect("a byte behind a document", "README.md: bytes: ", of_files(lambda place, _: os.truncate(f"{place}/README.md", 9)))
    for what, message, packed in (("bytes behind the packed ones", "not one whole gzip member", lambda data: data + b"more"),
                                  ("a second member", "not one whole gzip member", lambda data: data + gzip.compress(b"")),
                                  ("an end that is missing", "not one whole gzip member", lambda data: data[:-4]),
                                  ("other packed bytes", "Error -3 while decompressing data", lambda data: data[:10] + b"\xff" * 9 + data[19:])):
        expect(what, f"objects.csv.gz: {message}", bytes_of(table, packed))
    expect("a label", "glint-check: ", label)
    expect("a stream that is gone", "00000.jsonl.gz: no such file", of_files(lambda _, paths: os.remove(paths[stream])))
    for name in ("objects", "frames"):
        expect("tables that are gone", f"{name}.csv.gz: no such file", of_files(lambda _, paths: (os.remove(paths[table]), os.remove(paths[frames]))))
    expect("a table of no name", "glint-tables writes no table of this name", renamed)
    expect("a table of another shard", "other rows than those of the stream", swapped(table), every=8)
    expect("that of a later shard", "other rows than those of the stream", swapped(other))
    for name in ("99999.jsonl.zst", "00000/more.csv", "00000/more.parquet"):
        expect(f"a stranger, {name}", f"{name}: not in the manifest", of_files(lambda _, paths, name=name: open(f"{os.path.dirname(paths[stream])}/{name}", "x").close()))
    expect("an export that is not there", "exports/kitti: other files than its .sha256 says", said(plan=lambda plan: plan | {"exports": ["kitti"]}))
    shutil.rmtree(f"{folder}/set")
    os.rename(f"{folder}/sound", f"{folder}/set")
    for chain, every, words in (("glint-extract | b", 8, ["--every", "8", "--extract", "extract"]), ("glint-extract-3gpp", 1, ["--every", "1", "--extract", "extract-3gpp"]),
                                ("glint-extract | ./b", 8, ["--every", "0"])):
        check(module.check_of(chain.replace("| b", "| glint-b"), every) == ["glint-check", *words], f"{chain}: {module.check_of(chain, every)}")

    kept, sys.argv = sys.argv, ["check-set", "--all", "set"]
    check(module.words().every == 1, "--all checks a part")
    sys.argv = ["check-set", "set"]
    check(module.words().every == 8, "without --all, not every eighth is checked")
    sys.argv = kept
    if not shutil.which("zstd"):
        print("skipped  bytes behind those of zstd: zstd is not installed")
        return
    run(f"cd {folder} && echo text | zstd -q > more.zst && echo more >> more.zst", "/usr/bin")
    try:
        check(not list(module.unpacked(f"{folder}/more.zst", hashlib.sha256())), "bytes behind those of zstd pass")
    except ValueError as error:
        check("zstd" in str(error), str(error))


def flip(path, place):
    with open(path, "r+b") as file:
        file.seek(place)
        byte = file.read(1)[0]
        file.seek(place)
        file.write(bytes([byte ^ 1]))


def sets(bin_dir):
    """In a set every truncation and every flipped bit is found."""
    module = check_set()
    with tempfile.TemporaryDirectory() as folder:
        plan = {"name": "tiny", "origin": "For tests.", "sources": [{"random": "sparse", "frames": 3}],
                "chain": CHAIN.format("{suite}"), "suites": ["corner77-every-frame"], "frames_per_shard": 1, "tables": True}
        with open(f"{folder}/plan.json", "w", encoding="utf-8") as file:
            json.dump(plan, file)
        build = os.path.dirname(bin_dir)
        done = run(f"BUILD={build} scripts/dataset {folder}/plan.json --out {folder}/set && BUILD={build} "
                   f"make -s -C {folder}/set", bin_dir)
        if done.returncode != 0:
            sys.exit(f"check: {done.stderr.decode()}")
        done = run(f"BUILD={build} scripts/check-set {folder}/set", bin_dir)
        check(done.returncode == 0, f"a sound set: {done.stdout.decode()}")
        with open(f"{folder}/set/datapackage.json", "rb") as file:
            manifest = file.read()
        package = json.loads(manifest)
        entries = [None, *sorted(package["documents"] + package["resources"], key=lambda entry: entry["bytes"])]
        cut = flipped = 0
        for number, entry in enumerate(entries[:20]):
            data = manifest
            if entry is not None:
                with open(f"{folder}/set/{entry['path']}", "rb") as file:
                    data = file.read()
            sizes, bits = range(0, len(data), EVERY), range(0, 8 * len(data), EVERY)
            lost = [size for size in sizes if not fault_of(module, data[:size], entry)]
            check(not lost, f"truncations of {entry} to {lost[:3]} bytes pass")
            cut += len(sizes)
            if number < 5:
                other = bytearray(data)
                for bit in bits:
                    other[bit // 8] ^= 1 << bit % 8
                    check(fault_of(module, bytes(other), entry), f"bit {bit} of {entry} may flip")
                    other[bit // 8] ^= 1 << bit % 8
                flipped += len(bits)
        each_check(module, folder, package)
        tried = forged(module, folder, package)
        # The same by the script: a shard that is cut, and one that is gone.
        shard = package["resources"][0]
        path = f"{folder}/set/{shard['path']}"
        shutil.copy(path, f"{folder}/kept")
        os.truncate(path, shard["bytes"] - 1)
        done = run(f"BUILD={build} scripts/check-set {folder}/set", bin_dir)
        check(done.returncode == 65 and f"{shard['path']}: bytes: {shard['bytes'] - 1}" in done.stdout.decode(),
              f"a cut shard: {done.stdout.decode()}")
        shutil.copy(f"{folder}/kept", path)
        done = run(f"BUILD={build} scripts/check-set {folder}/set >/dev/full", bin_dir)
        check(done.returncode == 74 and b"check-set: No space left" in done.stderr, f"a full disk: {done.stderr.decode()}")
        for what, status, message in (("nowhere", 66, "nowhere/datapackage.json"), (f"{folder}/set", 69, "/glint-check: no such program; make builds it")):
            done = run(f"BUILD={build if status == 66 else '/nowhere'} scripts/check-set {what}", bin_dir)
            check(done.returncode == status and message in done.stderr.decode(), f"{what}: {done.returncode}: {done.stderr.decode()}")
        os.remove(path)
        os.mkfifo(path)
        done = run(f"BUILD={build} scripts/check-set {folder}/set", bin_dir)
        check(done.returncode == 65 and "no such file" in done.stdout.decode(), f"a shard that is gone: {done.stdout.decode()}")
    return f"{cut} truncations of 20 files and {flipped} flipped bits of 5 were found; {tried} forged manifests"


def main():
    bin_dir = os.path.abspath(sys.argv[1])
    recomputed = []
    for command, options in SOUND:
        done = run(f"glint-check {options}", bin_dir, stream_of(command, bin_dir))
        check(done.returncode == 0, f"{command}: {done.stderr.decode()}")
        recomputed.append(done.stdout.decode().strip())
        check(recomputed[-1].endswith("recomputed") and "; 0 of" not in recomputed[-1], f"{command}: {recomputed[-1]}")
    text = stream_of(PLANTED, bin_dir)
    for part in (values, truth):
        part(bin_dir, text)
    every_lost_echo_may_name_its_object_and_path(bin_dir, text)
    ghosts_are_counted(bin_dir)
    told = [flips(bin_dir, stream_of(SOUND[0][0], bin_dir)), sets(bin_dir)]
    for fault in faults[:10]:
        print(f"FAILED   {fault}"[:2000])
    print(f"check: {recomputed[0]}; {'; '.join(told)}; {checks} checks, {len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
