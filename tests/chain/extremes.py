"""Extreme documents and frames, drawn from the schemas: the chain works on them or says what it refuses.

Usage: python3 tests/chain/extremes.py BIN_DIR [CASES [SEED]]

Members of good documents and frames take the bounds of their schema, values next to bounds, and the smallest
and largest doubles that are allowed. Either all lines that come out are by the schema of frames, or the
exit code is 65 or 78 and the message names the line or the document, and the member.
"""
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(ROOT, "tests", "support"))
import suites  # noqa: E402
from sizes import quick  # noqa: E402

PATIENCE_S = 300
def without_distributions(member):
    """Where a distribution may stand for a value, the first alternative is the value's schema."""
    return member["anyOf"][0] if "anyOf" in member else member


SCHEMAS = {name: json.load(open(f"{ROOT}/schemas/{name}.json"), object_hook=without_distributions)
           for name in ("frame", "scenario", "sensors", "vehicle")}
CHAIN = ["glint-extract", "glint-ideal --sensors {sensors}", "{sensor}", "{noise}"]
SENSORS = ["glint-sensor", "glint-sensor", "glint-sensor-perfect", "glint-sensor-smear"]
NOISES = ["glint-noise", "glint-noise", "glint-noise-gauss", "glint-noise-none"]
READERS = ["glint-summary", "glint-view"]
NUMBERS = ("number", "integer")


class Fault(Exception):
    """A run that ends otherwise than it should."""


# ---- values ----------------------------------------------------------------------------------------------------


def extremes_of(schema):
    """Numbers that a schema allows, at and near its bounds."""
    low, high = schema["minimum"], schema["maximum"]
    if schema["type"] == "integer":
        found = [low, low + 1, high - 1, high]
    else:
        found = [low, high, math.nextafter(low, high), math.nextafter(high, low)]
        found += [sign * 10.0 ** power for sign in (1, -1) for power in (-300, -9, -2, 0, 1, 2, 3, 4, 6, 150, 300)] + [0.0]
    return [value for value in found if low <= value <= high]


def records_of(value, schema):
    """Every object within a value, with its schema."""
    if isinstance(value, list):
        for item in value:
            yield from records_of(item, schema["items"])
    elif "properties" in schema:
        yield value, schema
        for name, member in schema["properties"].items():
            if name in value:
                yield from records_of(value[name], member)


def has_value(schema):
    return schema.get("type") in NUMBERS + ("boolean",) or "enum" in schema


def drawn(schema, draw):
    """A value that the schema allows; of an object, the members that it requires."""
    if "enum" in schema:
        return draw.choice(schema["enum"])
    if schema.get("type") == "boolean":
        return draw.random() < 0.5
    if schema.get("type") in NUMBERS:
        return draw.choice(extremes_of(schema))
    if schema.get("type") == "array":
        return [drawn(schema["items"], draw) for _ in range(draw.randint(1, 3))]
    if "properties" in schema:
        return {name: drawn(schema["properties"][name], draw) for name in schema["required"]}
    return "n" + str(draw.randint(1, 99))


def add_parts(value, schema, draw):
    """Adds some of the objects and lists that are missing."""
    if isinstance(value, list):
        for item in value:
            add_parts(item, schema["items"], draw)
        return
    for name, member in schema.get("properties", {}).items():
        holds = "properties" in member or "properties" in member.get("items", {})
        if holds and name not in value and draw.random() < 0.1:
            value[name] = drawn(member, draw)
        elif holds and name in value:
            add_parts(value[name], member, draw)


def changed(good, schema, draw):
    """A copy in which objects of one kind have extreme values in a few members."""
    value = json.loads(json.dumps(good))
    kinds = {}
    for record, of in records_of(value, schema):
        kinds.setdefault(id(of), (of, []))[1].append(record)
    of, records = draw.choice(list(kinds.values()))
    names = [name for name, member in of["properties"].items() if has_value(member)]
    for record in records if draw.random() < 0.5 else [draw.choice(records)]:
        for name in draw.sample(names, min(len(names), draw.choice((1, 1, 2, 3)))):
            record[name] = drawn(of["properties"][name], draw)
    return value


# ---- runs ------------------------------------------------------------------------------------------------------


def numbers_of(line):
    """The JSON value of a line, all of whose numbers are finite."""
    def refuse(word):
        raise Fault(f"a number is {word}")
    value = json.loads(line, parse_constant=refuse)
    if re.search(r"[:\[,]-?\d[\d.]*[eE]\+?(309|3[1-9]\d|[4-9]\d\d)", line):
        raise Fault("a number is beyond the doubles")
    return value


def require(value, schema, place="frame"):
    """Holds a value to the types and bounds of its schema."""
    if isinstance(value, list):
        for i, item in enumerate(value):
            require(item, schema["items"], f"{place}[{i}]")
    elif schema.get("type") in NUMBERS:
        if not schema["minimum"] <= value <= schema["maximum"]:
            raise Fault(f"{place} is {value!r}")
    elif "enum" in schema and value not in schema["enum"]:
        raise Fault(f"{place} is {value!r}")
    for name, member in schema.get("properties", {}).items():
        if isinstance(value, dict) and name in value:
            require(value[name], member, f"{place}.{name}")


def end_of(done, wrote_frames):
    """Holds a run to what it may do; returns its exit code."""
    message = done.stderr.decode("utf-8", "replace").strip()
    last = message.splitlines()[-1] if message else ""
    if done.returncode not in (0, 65, 78):
        raise Fault(f"exit {done.returncode}: {last}")
    if done.returncode != 0 and not re.match(r"glint[\w-]*: .*(:\d+|\.json|row \d+|frame \d+).*: .+", last):
        raise Fault(f"exit {done.returncode} without a place: {last}")
    if done.returncode == 0 and wrote_frames:
        for line in done.stdout.decode().splitlines():
            require(numbers_of(line), SCHEMAS["frame"])
    return done.returncode


class Bench:
    """A folder with good documents and the frames that they make."""

    def __init__(self, folder, bin_dir):
        self.folder = os.path.join(folder, "sensors")
        # The glint of the tests has glint-traffic-adversarial as well.
        tests = os.path.join(os.path.dirname(bin_dir), "tests")
        self.environment = dict(os.environ, PATH=os.pathsep.join((tests, bin_dir, os.environ["PATH"])),
                                GLINT_DATA=os.path.join(ROOT, "data"))
        for name in ("sensors", "antennas"):
            shutil.copytree(os.path.join(ROOT, "data", name), os.path.join(folder, name))
        self.vehicle = json.load(open(ROOT + "/data/vehicles/car.json"))
        self.scenario = {
            "origin": "For tests.", "ego": "ego", "rate_hz": 10, "duration_s": 0.1,
            "objects": [{"id": "ego", "class": "car", "speed_mps": 10},
                        {"id": "ahead", "class": "vehicle.json", "x_m": 15, "y_m": 1, "speed_mps": 8},
                        {"id": "walker", "class": "pedestrian", "x_m": 9, "y_m": -3, "yaw_rad": 1.5, "speed_mps": 1},
                        {"id": "wall", "class": "wall", "x_m": 20, "y_m": 6, "length_m": 60}]}
        self.suites = {name: suites.whole(name)
                       for name in ("srr24-pair-every-frame", "corner77-every-frame", "lrr77-full",
                                    "radarscenes77-full", "lrr77-coherent", "array77")}

    def save(self, name, value):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            json.dump(value, file)
            file.write("\n")

    def run(self, stages):
        return subprocess.run(["glint", "-c", " | ".join(stages)], cwd=self.folder, env=self.environment,
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=PATIENCE_S, check=False)


def small(scenario):
    """Keeps a scenario to a few frames."""
    scenario["duration_s"] = min(scenario["duration_s"], 2 / scenario["rate_hz"])
    return scenario


def chain_of(draw):
    words = {"sensors": "./suite.json", "sensor": draw.choice(SENSORS), "noise": draw.choice(NOISES)}
    chain = [command.format(**words) for command in CHAIN]
    chain[1] += draw.choice(("", " --sections account", " --sections margins", " --sections account,margins", " --effects all"))
    return chain


def documents(bench, draw):
    """Extreme documents before the whole chain."""
    good = {"scenario": bench.scenario, "vehicle": bench.vehicle,
            "sensors": bench.suites[draw.choice(sorted(bench.suites))]}
    which = draw.sample(sorted(good), draw.choice((1, 1, 2)))
    for name in which:
        good[name] = json.loads(json.dumps(good[name]))
        add_parts(good[name], SCHEMAS[name], draw)
        for _ in range(draw.choice((1, 2, 3))):
            good[name] = changed(good[name], SCHEMAS[name], draw)
    bench.save("scene.json", small(good["scenario"]))
    bench.save("vehicle.json", good["vehicle"])
    bench.save("suite.json", good["sensors"])
    return ["glint-traffic ./scene.json"] + chain_of(draw)


def frames(bench, draw):
    """An extreme frame between two stages, and what reads it."""
    bench.save("scene.json", bench.scenario)
    bench.save("vehicle.json", bench.vehicle)
    bench.save("suite.json", bench.suites[draw.choice(sorted(bench.suites))])
    chain = ["glint-traffic ./scene.json"] + chain_of(draw)
    cut = draw.randint(1, 5)
    before = bench.run(chain[:cut])
    if before.returncode != 0:
        raise Fault(f"good documents are refused: {before.stderr.decode()}")
    lines = [json.loads(line) for line in before.stdout.splitlines()]
    for _ in range(draw.choice((1, 2, 3))):
        lines[0] = changed(lines[0], SCHEMAS["frame"], draw)
    bench.save("frames.jsonl", lines[0])
    after = chain[cut:] or [draw.choice(READERS)]
    return [after[0] + " frames.jsonl"] + after[1:]


def adversarial(bench, draw):
    """Adversarial scenes for an extreme suite."""
    name = draw.choice(sorted(bench.suites))
    bench.save("suite.json", changed(bench.suites[name], SCHEMAS["sensors"], draw))
    return ["glint-traffic-adversarial --sensors ./suite.json --frames 4"] + chain_of(draw)


def table(bench, draw):
    """A recorded table of extreme values."""
    good = {"track_id": 1, "frame_id": 1, "timestamp_ms": 0, "agent_type": "car", "x": 0, "y": 0, "vx": 10, "vy": 0,
            "psi_rad": 0, "length": 4, "width": 2}
    rows = [dict(good, track_id=track, frame_id=step + 1, timestamp_ms=100 * step, x=20 * (track - 1) + step)
            for track in (1, 2) for step in (0, 1)]
    ends = [sign * 10.0 ** power for sign in (1, -1) for power in (-300, -9, 3, 4, 6, 7, 9, 10, 13, 300)] + [0]
    for _ in range(draw.choice((1, 1, 2, 4))):
        row, name = draw.choice(rows), draw.choice(("timestamp_ms", "x", "y", "vx", "vy", "psi_rad", "length", "width"))
        row[name] = draw.choice(ends)
        if name == "timestamp_ms":
            row[name] = int(max(min(row[name], 1e17), -1e17))
    with open(os.path.join(bench.folder, "tracks.csv"), "w", encoding="utf-8") as file:
        file.write(",".join(good) + "\n")
        file.writelines(",".join(str(value) for value in row.values()) + "\n" for row in rows)
    bench.save("suite.json", bench.suites["corner77-every-frame"])
    return ["glint-traffic tracks.csv --ego 1"] + chain_of(draw)


KINDS = (documents, documents, documents, frames, frames, frames, adversarial, table)


def one(bench, number, seed):
    """Runs a case; returns its kind and exit code."""
    draw = random.Random(f"{seed}/{number}")
    kind = KINDS[number % len(KINDS)]
    stages = kind(bench, draw)
    try:
        return kind.__name__, end_of(bench.run(stages), stages[-1].split()[0] not in READERS)
    except (Fault, subprocess.TimeoutExpired) as fault:
        raise Fault(f"case {number}, {kind.__name__}: {' | '.join(stages)}: {fault}") from fault


def main():
    if len(sys.argv) not in (2, 3, 4):
        sys.exit(__doc__)
    cases, seed = [int(word) for word in sys.argv[2:] + [str(quick(300, 800)), "1"][len(sys.argv) - 2:]]
    ends, faults = {}, []
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(folder, os.path.abspath(sys.argv[1]))
        for number in range(cases):
            try:
                end = one(bench, number, seed)
                ends[end] = ends.get(end, 0) + 1
            except Fault as fault:
                faults.append(fault)
                print(fault, flush=True)
    for (kind, code), count in sorted(ends.items()):
        print(f"extremes: {kind}: {count} end with {code}")
    if faults:
        sys.exit(f"extremes: {len(faults)} faults")


main()
