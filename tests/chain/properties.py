"""Properties of the whole chain, tested through the executables.

Usage: python3 tests/chain/properties.py BIN_DIR

One line per property. Set GLINT_TEST_DATA to a folder with csv/us101_interaction.csv to send a
recording through the chain too.
"""
import csv
import functools
import glob
import importlib.util
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
sys.path.append(os.path.join(ROOT, "scripts"))
import glint  # noqa: E402
import suites  # noqa: E402
from sizes import quick  # noqa: E402

BIN = os.path.abspath(sys.argv[1]) if len(sys.argv) == 2 else sys.exit(__doc__)
ENV = dict(os.environ, PATH=BIN + os.pathsep + os.environ["PATH"], GLINT_DATA=ROOT + "/data")
PIPELINES = sorted(glob.glob(ROOT + "/pipelines/*.sh"))
SCHEMA = json.load(open(ROOT + "/schemas/frame.json"))
PARTS = list(SCHEMA["properties"])
PATHS = SCHEMA["properties"]["echoes"]["items"]["properties"]["path"]["enum"]
REASONS = SCHEMA["properties"]["lost"]["items"]["properties"]["reason"]["examples"]
SCENARIOS = sorted(name[:-5] for name in os.listdir(ROOT + "/data/scenarios"))
TABLE = "highway --ego 1 --radius-m 250"
SUITES = ["srr24-pair-every-frame", "corner77-every-frame", "lrr77-every-frame"]
SEEN_AGAIN = quick(SUITES[:1], SUITES)  # by which a scene is seen that is mirrored, turned or shifted
NAMES = ("sensor", "object", "reflector", "path")


class Fault(Exception):
    """A property that does not hold."""


class Skip(Exception):
    """A property that cannot be tested here."""


def check(holds, message):
    if not holds:
        raise Fault(message)


# Running


def run(words, data=b"", code=0):
    done = subprocess.run(words, input=data, env=ENV, cwd=ROOT, capture_output=True)
    check(done.returncode == code,
          f"{' '.join(words)}: exit {done.returncode}, expected {code}: {done.stderr.decode()}")
    return done


def piped(text, data=b""):
    return run(["bash", "-o", "pipefail", "-c", text], data).stdout


def fused(text, data=b""):
    return run([BIN + "/glint", "-c", text], data).stdout


def chain(suite, account=True, sensor="glint-sensor", noise="glint-noise"):
    ideal = f"glint-ideal --sensors {suite}" + (" --sections account" if account else "")
    again = f" --sensors {suite}" if "/" in suite else ""
    return f"glint-extract | {ideal} | {sensor}{again} | {noise}{again}"


def stages_of(path):
    """The header and the commands of a pipeline file."""
    lines = open(path).read().replace("\\\n", " ").splitlines()
    lines = [line for line in lines if line and not line.startswith("#")]
    return "\n".join(lines[:-1]) + "\n", [word.strip() for word in lines[-1].split("|")]


def writes_frames(command):
    name = command.split()[0]
    return name.startswith("glint-") and b"Writes frames (JSON lines)" in run([name, "--help"]).stdout


@functools.cache
def hops_of(path):
    """The streams that leave each of glint's own stages in a pipeline file that writes frames, with their commands."""
    header, commands = stages_of(path)
    return [(command, run(["bash", "-c", header + " | ".join(commands[:count]), path]).stdout)
            for count, command in enumerate(commands, 1) if writes_frames(command)]


# Reading


def parse(data):
    return [glint.name_lost(json.loads(line)) for line in data.splitlines()]


def exact(data):
    """Frames whose numbers stay as they are spelled, for comparisons byte by byte."""
    return [glint.name_lost(json.loads(line, parse_float=str, parse_int=str)) for line in data.splitlines()]


def write(frames):
    return "".join(json.dumps(frame) + "\n" for frame in frames).encode()


def place(frame):
    return f"scene {frame['scene']}, frame {frame['frame']}"


def same_frames(left, right, without, what):
    check(len(left) == len(right), f"{what}: {len(left)} and {len(right)} frames")
    for one, other in zip(left, right):
        for part in PARTS:
            if part not in without:
                check(one.get(part) == other.get(part),
                      f"{what}: {place(one)}: {part} differs")


def finite(text):
    value = float(text)
    if not math.isfinite(value):
        raise Fault(f"{text} is not finite")
    return value


# The account


def vehicle(name, loaded={}):
    if name not in loaded:
        loaded[name] = json.load(open(f"{ROOT}/data/vehicles/{name}.json"))["reflectors"]
    return loaded[name]


def in_world(owner, x, y):
    cosine, sine = math.cos(owner["yaw_rad"]), math.sin(owner["yaw_rad"])
    return owner["x_m"] + x * cosine - y * sine, owner["y_m"] + x * sine + y * cosine


def speed(body):
    return math.hypot(body["vx_mps"], body["vy_mps"]) + 10 * abs(body["yaw_rate_radps"])


def posts(frame, ego, sensor, owner, row):
    """The posts of a row that must be accounted for, and those that may be: objects stand where they are at
    the end of the frame, so a sensor with a cycle gets some slack."""
    cycle, time = sensor.get("cycle_s", 0), frame["time_s"]
    age = time - math.floor(time / cycle + 1e-9) * cycle if cycle else 0
    slack = 1e-6 + (speed(ego) + speed(owner)) * abs(age)
    eye = in_world(ego, sensor["mount_x_m"], sensor["mount_y_m"])
    ends = [(row[end + "_x"] * owner["length_m"], row[end + "_y"] * owner["width_m"])
            for end in ("from", "to")]
    length = math.dist(*ends)
    must, may = set(), set()
    for number in range(1 + math.floor(length / row["spacing_m"] + 1e-9)):
        share = number * row["spacing_m"] / length if length else 0
        spot = in_world(owner, *(a + share * (b - a) for a, b in zip(*ends)))
        distance = math.dist(eye, spot)
        name = (sensor["name"], owner["id"], f"{row['name']}_{number}", "direct")
        if distance <= sensor["range_max_m"] - slack:
            must.add(name)
        if distance <= sensor["range_max_m"] + 3 * row["spacing_m"] + slack:
            may.add(name)
    return must, may


def expected_pairs(frame):
    must, may = set(), set()
    ego = next(body for body in frame["objects"] if body["id"] == frame["ego"])
    for sensor in frame["sensors"]["list"]:
        for owner in frame["objects"]:
            if not sensor["measured"] or owner is ego:
                continue
            model = vehicle(owner["class"])
            must |= {(sensor["name"], owner["id"], one["name"], "direct")
                     for one in model.get("points", []) + model.get("planes", [])}
            for row in model.get("rows", []):
                some, more = posts(frame, ego, sensor, owner, row)
                must |= some
                may |= more
    return must, must | may


def endings(frame):
    def name(sensor, one):
        return (sensor,) + tuple(one[key] for key in NAMES[1:]) + (one.get("mirror"), one.get("number"))

    ends = [name(target["sensor"], one) for target in frame["targets"] for one in target["contributors"]]
    return ends + [name(group["sensor"], one) for group in frame["lost"] for one in group["echoes"]]


def check_laws(frame):
    """Both laws of the account, with what must be accounted for taken from the vehicle documents and not from
    glint-ideal."""
    where, ends = place(frame), endings(frame)
    check(len(ends) == len(set(ends)), f"{where}: an echo ends twice")
    direct = {end[:4] for end in ends if end[3] == "direct"}
    must, may = expected_pairs(frame)
    check(must <= direct, f"{where}: no entry for {sorted(must - direct)[:3]}")
    check(direct <= may, f"{where}: entries for no pair: {sorted(direct - may)[:3]}")
    counts = {count["sensor"]: count for count in frame["counts"]}
    measured = {one["name"] for one in frame["sensors"]["list"] if one["measured"]}
    check(set(counts) == measured, f"{where}: counts of {sorted(counts)}, not {sorted(measured)}")
    unmade = [group["sensor"] for group in frame["lost"] if group["stage"] == "ideal"
              for _ in group["echoes"]]
    for sensor, count in counts.items():
        pairs = sum(end[0] == sensor for end in direct)
        check(pairs == count["pairs"],
              f"{where}: {sensor}: {pairs} entries, {count['pairs']} pairs")
        made = {path["path"]: path["echoes"] for path in count["paths"]}
        for path, echoes in made.items():
            ended = sum(end[0] == sensor and end[3] == path for end in ends)
            ended -= unmade.count(sensor) if path == "direct" else 0
            check(ended == echoes, f"{where}: {sensor}: {echoes} {path} echoes, {ended} accounted")


def some(data):
    """At most 150 frames of a stream, spread over it; 40 in the quick run."""
    lines = data.splitlines(keepends=True)
    return b"".join(lines[::1 + (len(lines) - 1) // quick(40, 150)])


# The noise-free list, compared within a tolerance


def close(one, other, key):
    """True within 1e-9; amplitudes, which have no scale of their own, relative to themselves."""
    scale = abs(one) if key == "cell_amplitude" else 1
    return abs(one - other) <= 1e-9 * scale


def compare_values(one, other, sign, keys, angles, where):
    for key in keys:
        if not close(one[key], other[key], key):
            raise Fault(f"{where}: {key} {one[key]!r} and {other[key]!r}")
    for key in angles:
        if not close(one[key], sign * other[key], key):
            raise Fault(f"{where}: {key} {one[key]!r} and {sign} x {other[key]!r}")


def label(target):
    return {(one["object"], one["reflector"], one["path"]): one for one in target["contributors"]}


def by_label(frame, rename):
    """Targets by sensor and label, in which the leader is a member like all others: exact ties may choose
    another leader."""
    found = {}
    for target in frame["targets"]:
        names = {rename(target["sensor"], key): one for key, one in label(target).items()}
        found[frozenset(names)] = (target, names)
    return found


def losses(frame, rename):
    return {(rename(group["sensor"], (one["object"], one["reflector"], one["path"])),
             group["stage"], group["reason"], one.get("by"))
            for group in frame["lost"] for one in group["echoes"]}


def plain(sensor, names):
    return (sensor,) + names


def compare_lists(left, right, sign=1, rename=plain):
    check(len(left) == len(right), f"{len(left)} and {len(right)} frames")
    for one, other in zip(left, right):
        where = place(one)
        mine, theirs = by_label(one, plain), by_label(other, rename)
        check(set(mine) == set(theirs), f"{where}: targets of one side only: "
              f"{[sorted(names) for names in set(mine) ^ set(theirs)]}")
        check(losses(one, plain) == losses(other, rename),
              f"{where}: losses of one side only: "
              f"{sorted(losses(one, plain) ^ losses(other, rename), key=str)[:4]}")
        for names in mine:
            (target, parts), (twin, twin_parts) = mine[names], theirs[names]
            spot = f"{where}, {sorted(names)[0]}"
            undecided = target.get("sign_undecided") or twin.get("sign_undecided")
            compare_values(target, twin, sign,
                           ("range_m", "range_rate_mps", "amplitude_db", "cell_range_m",
                            "cell_range_rate_mps", "cell_amplitude"),
                           () if undecided else ("azimuth_rad", "cell_azimuth_rad"), spot)
            for name, part in parts.items():
                compare_values(part, twin_parts[name], sign,
                               ("range_m", "range_rate_mps", "ercs", "time_s", "weight"),
                               ("azimuth_rad",), f"{spot}, {name}")


def noise_free(suite, data):
    """The chain without noise, and without clutter, whose places are drawn."""
    return parse(fused(chain(f"{suite} --effects=-clutter", noise="glint-noise-none"), data))


# Mirrors


def angle_key(angle):
    return round(math.sin(angle), 9), round(math.cos(angle), 9)


def mirror_names(model):
    """For each reflector the one whose place it takes in the mirror."""
    def point(one, sign):
        return ("point", one["x"], sign * one["y"] + 0.0, angle_key(sign * one["facing_rad"]))

    def plane(one, sign):
        ends = [(one["from_x"], sign * one["from_y"]), (one["to_x"], sign * one["to_y"])]
        return ("plane", tuple(ends if sign > 0 else reversed(ends)))

    names = {}
    for kind, key in (("points", point), ("planes", plane)):
        at = {key(one, 1): one["name"] for one in model.get(kind, [])}
        names.update({one["name"]: at[key(one, -1)] for one in model.get(kind, [])})
    return names


def mirror_traffic(data):
    frames = parse(data)
    for frame in frames:
        for body in frame["objects"]:
            for key in ("y_m", "yaw_rad", "vy_mps", "yaw_rate_radps"):
                body[key] = -body[key]
    return frames


@functools.cache
def mirror_side(name):
    sides = {"left": "right", "right": "left"}
    return re.sub("left|right", lambda side: sides[side.group()], name)


def mirror_suite(suite, folder):
    document = json.load(open(f"{ROOT}/data/sensors/{suite}.json"))
    for sensor in document["sensors"]:
        sensor["name"] = mirror_side(sensor["name"])
        sensor["mount_y_m"] = -sensor["mount_y_m"]
        sensor["mount_yaw_rad"] = -sensor["mount_yaw_rad"]
        if "antenna_table" in sensor:
            sensor["antenna_table"] = f"{ROOT}/data/sensors/{sensor['antenna_table']}"
    return save(folder, suite + "-mirrored.json", document)


def save(folder, name, document):
    path = os.path.join(folder, name)
    with open(path, "w") as file:
        json.dump(document, file)
    return path


def general_position(name):
    """A scenario without the coincidences of hand-written numbers (a wall exactly at the border of the view,
    a corner exactly in the line of sight), which rounding may decide either way. Places lie on a grid that a
    shift by 1e6 m keeps."""
    document, draw = json.load(open(f"{ROOT}/data/scenarios/{name}.json")), random.Random(name)
    for body in document["objects"]:
        moved = [draw.uniform(-0.01, 0.01) for _ in range(3)]
        for spot in body.get("waypoints", [body]):
            for key, offset in zip(("x_m", "y_m"), moved):
                spot[key] = round((spot.get(key, 0) + offset) * 2**30) / 2**30
        body["yaw_rad"] = body.get("yaw_rad", 0) + moved[2]
    return document


def move(document, angle, shift):
    document = json.loads(json.dumps(document))
    cosine, sine = math.cos(angle), math.sin(angle)
    for body in document["objects"]:
        for spot in body.get("waypoints", [body]):
            x, y = spot["x_m"], spot["y_m"]
            spot["x_m"] = shift[0] + x * cosine - y * sine
            spot["y_m"] = shift[1] + x * sine + y * cosine
        body["yaw_rad"] += angle
    for strip in document.get("roadside", []):
        for x_m, y_m in (("from_x_m", "from_y_m"), ("to_x_m", "to_y_m")):
            x, y = strip[x_m], strip[y_m]
            strip[x_m] = shift[0] + x * cosine - y * sine
            strip[y_m] = shift[1] + x * sine + y * cosine
    return document


# The properties


def laws_hold(folder):
    """The account of scenes whose reflectors are those of the vehicle documents, which say what must be
    accounted for."""
    frames = 0
    for path in PIPELINES:
        commands = stages_of(path)[1]
        if ("--sections account" in " ".join(commands) and writes_frames(commands[-1])
                and "glint-extract" in (command.split()[0] for command in commands)):
            for frame in parse(run(["bash", path]).stdout)[::quick(5, 1)]:
                check_laws(frame)
                frames += 1
    check(frames > 0, "no pipeline keeps account")
    return f"{frames} frames"


def laws_hold_after_swaps(folder):
    for suite in SUITES:
        for sensor in ("glint-sensor", "glint-sensor-perfect"):
            for noise in ("glint-noise", "glint-noise-gauss", "glint-noise-none"):
                for frame in parse(fused("glint-traffic corner-approach | "
                                         + chain(suite, sensor=sensor, noise=noise))):
                    check_laws(frame)


def has_roadside(name):
    """What stands beside the road is drawn, and a mirror draws no mirrored numbers."""
    return "roadside" in json.load(open(f"{ROOT}/data/scenarios/{name}.json"))


def mirror_symmetry(folder):
    renamed = {path[:-5]: mirror_names(vehicle(path[:-5]))
               for path in os.listdir(ROOT + "/data/vehicles") if path.endswith(".json")}
    for source in [name for name in SCENARIOS if not has_roadside(name)] + [TABLE]:
        traffic = some(piped(f"glint-traffic {source}"))
        mirrored = mirror_traffic(traffic)
        classes = {body["id"]: body["class"] for frame in mirrored for body in frame["objects"]}

        @functools.cache
        def rename(sensor, names):
            thing, reflector, path = names
            return (mirror_side(sensor), thing,
                    renamed[classes[thing]].get(reflector, reflector), path)

        for suite in SEEN_AGAIN:
            right = noise_free(mirror_suite(suite, folder), write(mirrored))
            compare_lists(noise_free(suite, traffic), right, -1, rename)


def check_origin(frames, document):
    """Beyond a kilometre there is an origin in whole metres near the ego."""
    ego = next(body for body in document["objects"] if body["id"] == document["ego"])
    far = max(abs(ego["x_m"]), abs(ego["y_m"])) > 1000
    origin = (round(ego["x_m"]), round(ego["y_m"])) if far else (0, 0)
    for frame in frames:
        found = (frame.get("origin_x_m", 0), frame.get("origin_y_m", 0))
        check(found == origin, f"{place(frame)}: the origin is {found}, not {origin}")


def is_scripted(name):
    """Are all places numbers, neither drawn nor on roads?"""
    document = json.load(open(f"{ROOT}/data/scenarios/{name}.json"))
    bodies = document["objects"] if "roads" not in document else []
    return bodies != [] and not any(isinstance(value, dict) for body in bodies for value in body.values())


def turn_and_shift(folder):
    for name in filter(is_scripted, SCENARIOS):
        document = general_position(name)
        traffic = some(piped(f"glint-traffic {save(folder, name + '.json', document)}"))
        lists = {suite: noise_free(suite, traffic) for suite in SEEN_AGAIN}
        for angle, shift in ((0.7, (0, 0)), (0, (1e6, -1e6))):
            moved = move(document, angle, shift)
            after = some(piped(f"glint-traffic {save(folder, name + '.json', moved)}"))
            check_origin(parse(after), moved)
            for suite in SEEN_AGAIN:
                try:
                    compare_lists(lists[suite], noise_free(suite, after))
                except Fault as fault:
                    raise Fault(f"{name} turned by {angle} and shifted by {shift}, {suite}: "
                                f"{fault}") from None


def object_order(folder):
    shuffle = random.Random(1).shuffle
    for source in ("highway-straight", "intersection"):
        for noise in ("glint-noise", "glint-noise-gauss", "glint-noise-none"):
            traffic = piped(f"glint-traffic {source}")
            text = chain("srr24-pair-every-frame", noise=noise)
            shuffled = parse(traffic)
            for frame in shuffled:
                shuffle(frame["objects"])
            same_frames(exact(fused(text, traffic)), exact(fused(text, write(shuffled))),
                        ("objects",), f"{source}, {noise}")


READERS = {"tables": "glint-tables --plain {0}", "summary": "glint-summary", "osi": "glint-osi --shift-s 1",
           "mcap": """glint-mcap --shift-s 1 | grep -ao '"data": *"[^"]*"'""",  # points, without sums of the bytes of the file
           "page": "glint-view", "check": "glint-check",
           "detected": "glint-score-tracks --objects detected --tracks <(python3 {root}/scripts/tracker {list}) {list}",
           "tracks": "python3 {root}/scripts/tracker {list}",
           "export": "python3 {root}/scripts/export nuscenes --out {0} {list} && rm {0}/glint-boxes.csv",  # boxes have hashes of ids
           "python": "python3 -c 'import glint; print([glint.detections(one) for one in glint.frames()])'"}


def read_by_all(folder, name):
    """A list and what every reader of labels makes of it, of a scene in which a car out of sight has this id."""
    poles = {"kind": "poles", "from_x_m": -50, "from_y_m": 5, "to_x_m": 400, "to_y_m": 5}
    cars = [{"id": one, "class": "car", "x_m": x, "y_m": 0, "speed_mps": 20} for one, x in (("ego", 0), ("lead", 60), (name, -30))]
    scene = save(folder, "named.json", {
        "origin": "For tests.", "ego": "ego", "rate_hz": 10, "duration_s": 1, "roadside": [poles], "objects": cars,
        "conditions": {"clutter_per_m2": 0.02, "clutter_ercs": 0.3}})
    words = "--sensors lrr77-full --effects all --sections account,quality,visibility"
    found = {"list": piped(f"glint-traffic {scene} | glint-extract | glint-ideal {words} | glint-sensor | glint-noise")}
    place = os.path.join(folder, "named.jsonl")
    with open(place, "wb") as out:
        out.write(found["list"])
    for reader, command in READERS.items():
        out = os.path.join(folder, "read")
        found[reader] = piped(f"export PYTHONPATH={ROOT}/scripts PYTHONDONTWRITEBYTECODE=1; "
                              + command.format(out, list=place, root=ROOT), found["list"])
        for path in sorted(glob.glob(out + "/*.csv")):
            with open(path, "rb") as file:
                found[f"{reader} {os.path.basename(path)}"] = file.read()
        shutil.rmtree(out, ignore_errors=True)
    return found


def names_of_no_object(folder):
    """A car called as the labels of what is no object changes no list, and no reader takes those labels for the car's."""
    for name in ("roadside", "clutter", "noise"):
        other = name[:-1] + chr(ord(name[-1]) + 1)  # as long, and in the same order among all names
        found, expected = read_by_all(folder, name), read_by_all(folder, other)
        labels = {one["object"] for frame in parse(found["list"]) for target in frame["targets"] for one in target["contributors"]
                  if one["path"] in ("clutter", "false_alarm")}
        check(labels == {"roadside", "clutter", "noise"}, f"the list has only labels of {labels}")
        for reader, text in expected.items():
            if (name, reader) != ("noise", "page"):  # a page keeps each name once, that of the stage noise as well
                check(found[reader] == text.replace(other.encode(), name.encode()), f"{name}: {reader} joins labels to the car")


def times_below_zero(folder):
    """A scene that is earlier by 1000 or 20000 cycles has as many scans and targets in each frame."""
    frames = parse(piped("glint-traffic cut-in"))

    def counts(earlier_s):
        moved = write([dict(frame, time_s=round(frame["time_s"] - earlier_s, 9)) for frame in frames])
        return [(frame["sensors"]["list"][0]["measured"], len(frame["targets"])) for frame in parse(fused(chain("lrr77"), moved))]

    expected = counts(0)
    check(len({measured for measured, _ in expected}) == 2, "frames with a scan and frames without are due")
    for earlier_s in (72, 1440):
        check(counts(earlier_s) == expected, f"{earlier_s} s earlier there are other scans")


def lines_alone(folder):
    """What a stage remembers of a line never shows in another line: other scenes, other orders of objects,
    other reflectors of the same class."""
    draw = random.Random(2)
    frames = [frame for name in ("cut-in", "intersection", "highway-straight")
              for frame in parse(piped(f"glint-traffic {name}"))[::12]]
    draw.shuffle(frames)
    for stage in chain("srr24-pair-every-frame").split(" | "):
        for frame in frames:
            draw.shuffle(frame["objects"])
            for one in frame.get("reflectors", [])[draw.randrange(2)::2]:
                for point in one.get("points", []):
                    point["ercs"] = draw.choice([point["ercs"], 0.5])
        lines = [json.dumps(frame, separators=(",", ":")).encode() + b"\n" for frame in frames]
        whole = piped(stage, b"".join(lines))
        for line, expected in zip(lines, whole.splitlines(keepends=True)):
            check(piped(stage, line) == expected,
                  f"{place(json.loads(line))}: {stage} writes something else of this line alone")
        frames = parse(whole)
    return f"{len(frames)} lines"


def interleaved_scenes(folder):
    text = chain("srr24-pair")
    scenes = [piped(f"glint-traffic {name}").splitlines(keepends=True)
              for name in ("cut-in", "intersection")]
    mixed = [line for pair in zip(*scenes) for line in pair]
    mixed += max(scenes, key=len)[min(map(len, scenes)):]
    out = piped(text, b"".join(mixed)).splitlines(keepends=True)
    for scene in scenes:
        name = json.loads(scene[0])["scene"]
        alone = fused(text, b"".join(scene)).splitlines(keepends=True)
        check([line for line in out if json.loads(line)["scene"] == name] == alone,
              f"scene {name} differs")


def seeds(folder):
    stages = chain("srr24-pair").split(" | ")
    expected = piped("glint-traffic cut-in --seed 7 | " + " | ".join(stages))
    for index in range(len(stages)):
        words = stages[:index] + [stages[index] + " --seed 7"] + stages[index + 1:]
        check(piped("glint-traffic cut-in | " + " | ".join(words)) == expected,
              f"--seed at {stages[index]} differs from --seed at the source")
    cells = " | ".join(stages[:3])
    one, other = (exact(piped(f"glint-traffic cut-in --seed {seed} | {cells}")) for seed in (1, 7))
    same_frames(one, other, ("seed",), "noise-free parts under another seed")
    mine, theirs = parse(piped("glint-traffic cut-in | " + " | ".join(stages))), parse(expected)
    pairs = 0
    for frame, twin in zip(mine, theirs):
        labels = {(target["sensor"], tuple(label(target))): target for target in twin["targets"]}
        for target in frame["targets"]:
            other = labels.get((target["sensor"], tuple(label(target))))
            if other is not None:
                pairs += 1
                check(target["cell_range_m"] == other["cell_range_m"] and
                      target["contributors"] == other["contributors"],
                      f"{place(frame)}: the noise-free values depend on the seed")
                for key in ("range_m", "range_rate_mps", "azimuth_rad", "amplitude_db"):
                    check(target[key] != other[key], f"{place(frame)}: {key} under both seeds")
    check(pairs > 100, "too few targets to compare")


def unseen_objects(folder):
    """An object that has no echo and hides nothing can go without a trace in any target."""
    for source, suite in (("cut-in", "srr24-pair"), ("highway-straight", "lrr77")):
        text = chain(suite)
        frames = parse(piped(f"glint-traffic {source}"))
        before = exact(fused(text, write(frames)))
        seen = {end[1] for frame in before for end in endings(frame)
                if not any(group["stage"] == "ideal" and group["sensor"] == end[0] and
                           any(one["object"] == end[1] and one["reflector"] == end[2]
                               for one in group["echoes"]) for group in frame["lost"])}
        seen |= {one["by"] for frame in before for group in frame["lost"]
                 for one in group["echoes"] if "by" in one}
        everyone = {body["id"] for frame in frames for body in frame["objects"]}
        unseen = everyone - seen - {frames[0]["ego"]}
        check(unseen, f"{source}: every object is seen")
        for frame in frames:
            frame["objects"] = [body for body in frame["objects"] if body["id"] not in unseen]
        after = exact(fused(text, write(frames)))
        for one, other in zip(before, after):
            check(one["targets"] == other["targets"],
                  f"{place(one)}: without {sorted(unseen)} the targets differ")


def perfect_sensor(folder):
    text = ("glint-extract | glint-ideal --sensors srr24-pair --sections account,echoes | "
            "glint-sensor-perfect | glint-noise-none")
    targets = 0
    for frame in parse(fused(text, piped("glint-traffic intersection"))):
        echoes = {tuple(echo[key] for key in NAMES): echo for echo in frame["echoes"]}
        lost = {(group["sensor"],) + tuple(one[key] for key in NAMES[1:])
                for group in frame["lost"] if group["stage"] != "ideal" for one in group["echoes"]}
        check(not lost, f"{place(frame)}: echoes without a target: {sorted(lost)}")
        found = {}
        for target in frame["targets"]:
            check(len(target["contributors"]) == 1, f"{place(frame)}: two echoes in a target")
            found[(target["sensor"],) + next(iter(label(target)))] = target
        check(set(found) == set(echoes) and len(frame["targets"]) == len(echoes),
              f"{place(frame)}: targets and echoes are not one to one")
        for name, target in found.items():
            targets += 1
            for key in ("range_m", "azimuth_rad", "range_rate_mps"):
                check(target[key] == echoes[name][key], f"{place(frame)}: {name}: {key} differs")
    check(targets > 1000, "too few targets")


def carrying(stage, sections):
    """The command of a stage that is told more sections."""
    told = "--sections account"
    return stage.replace(told, f"{told},{sections}") if told in stage else f"{stage} --sections {sections}"


def keep(folder):
    stages = chain("srr24-pair").split(" | ")
    uses = ["objects", "reflectors", "echoes", "cells"]
    data = piped("glint-traffic intersection")
    for stage, used in zip(stages, uses):
        plain_out, read = piped(stage, data), exact(data)
        if used != "objects":
            kept = exact(piped(carrying(stage, used), data))
            for frame, before in zip(kept, read):
                check(frame.get(used) == before[used], f"{stage}: {used} is not kept")
            same_frames(kept, exact(plain_out), (used, "sections"), f"{stage} --sections {used}")
            check(not any(used in frame for frame in exact(plain_out)), f"{stage} leaves {used}")
        data = plain_out
    for place, told in enumerate(("reflectors,echoes,cells", "reflectors,echoes,cells", "echoes,cells", "cells")):
        words = list(stages)
        words[place] = carrying(words[place], told)
        same_frames(exact(data), exact(piped("glint-traffic intersection | " + " | ".join(words))),
                    [*uses, "sections"], f"sections given to {stages[place]}")


EXTRAS = ['{"b" : [1.0,1e5, -0,\t"\\u00e4\u00e4\\/"] ,"a":null,"b":{}}', '"x"', "1.50", "[ ]",
          "true", '{"targets":[{"sensor":"left"}]}']


def add_extra(data, pick, after):
    """Puts an extra member behind the first key of the part that pick names, and counts the parts."""
    lines, added = [], 0
    for number, line in enumerate(data.decode().splitlines(keepends=True)):
        extra = f'"extra": {EXTRAS[number % len(EXTRAS)]} ,"{after}":'
        begin = line.index(pick) if pick in line else len(line)
        head, tail = line[:begin], line[begin:]
        added += f'"{after}":' in tail
        lines.append(head + tail.replace(f'"{after}":', extra, 1))
    return "".join(lines).encode(), added


def check_extras(data, count, where):
    """A part that a stage does not alter passes word for word, with the blank behind the key."""
    found = sum(1 for number, line in enumerate(data.decode().splitlines())
                if f'"extra":{EXTRAS[number % len(EXTRAS)]}' in line.replace('"extra": ', '"extra":'))
    check(found == count, f"{where}: {found} of {count} extra members are left")


def extras(folder):
    stages = ["glint-traffic cut-in"] + chain("srr24-pair").split(" | ")
    # An extra member: where it is put in, what carries it, its key, and the stages that must pass it on.
    carriers = [(1, "{", "version", "glint-extract | glint-ideal --sensors srr24-pair | "
                 "glint-sensor | glint-noise"),
                (1, '"objects":', "id", "glint-extract | glint-ideal --sensors srr24-pair | "
                 "glint-sensor-perfect | glint-noise-gauss"),
                (3, '"echoes":', "sensor", "glint-sensor --sections echoes | glint-noise"),
                (4, '"cells":', "sensor", "glint-noise --sections cells"),
                (5, '"targets":', "sensor", "glint-extract")]
    for count, pick, after, rest in carriers:
        data, added = add_extra(piped(" | ".join(stages[:count])), pick, after)
        check(added > 50, f"{pick}: only {added} carriers")
        for runner in (piped, fused):
            check_extras(runner(rest, data), added, f"{pick} through {rest}")
    data, added = add_extra(piped(" | ".join(stages[:3])), '"echoes":', "sensor")
    check(b'"extra"' not in piped("glint-sensor", data), "an extra outlives its echo")


def ascending(items, where):
    check(items == sorted(items), f"{where} is not in order")


@functools.cache
def text_key(*names):
    return tuple(name.encode() for name in names)


def echo_key(one):
    return (text_key(one["object"], one["reflector"]) + (PATHS.index(one["path"]),) +
            text_key(one.get("mirror", "")) + (one.get("number", 0),))


def check_order(frame):
    where = place(frame)
    keys = [PARTS.index(key) for key in frame]
    ascending(keys, f"{where}: the frame's members")
    ascending([text_key(one["model"]) for one in frame.get("reflectors", [])],
              f"{where}: reflectors")
    for one in frame.get("reflectors", []):
        ascending([text_key(name) for name in one["objects"]], f"{where}: objects")
    ascending([text_key(one["name"]) for one in frame.get("sensors", {"list": []})["list"]],
              f"{where}: sensors")
    for part in ("echoes", "counts", "targets"):
        key = echo_key if part == "echoes" else lambda one: ()
        ascending([text_key(one["sensor"]) + key(one) for one in frame.get(part, [])],
                  f"{where}: {part}")
    ascending([text_key(one["sensor"]) + echo_key(one["members"][0])
               for one in frame.get("cells", [])], f"{where}: cells")
    for parts in [one["members"] for one in frame.get("cells", [])] + \
            [one["contributors"] for one in frame.get("targets", [])]:
        ascending([echo_key(one) for one in parts[1:]], f"{where}: a label")
        check(abs(sum(one["weight"] for one in parts) - 1) < 1e-12, f"{where}: weights")
        strongest = max(one["weight"] for one in parts)
        check(parts[0]["weight"] == strongest, f"{where}: the leader is not the strongest")
    ascending([text_key(one["sensor"], one["stage"]) + ((REASONS + [one["reason"]]).index(one["reason"]), one["reason"])
               for one in frame.get("lost", [])], f"{where}: lost")
    for group in frame.get("lost", []):
        ascending([echo_key(one) for one in group["echoes"]], f"{where}: lost echoes")


def check_list(frame, suite):
    """Targets stand in the sensor's own order."""
    for sensor in suite["sensors"]:
        mine = [one for one in frame["targets"] if one["sensor"] == sensor["name"]]
        nearest = sensor["list_order"] == "nearest"
        ascending([one["range_m"] if nearest else -one["amplitude_db"] for one in mine],
                  f"{place(frame)}: the targets of {sensor['name']}")


@functools.cache
def suite_of(name):
    return suites.whole(name)


def well_formed(folder):
    for path in quick(PIPELINES[::4], PIPELINES):
        for command, data in hops_of(path):
            for line in data.splitlines()[::quick(10, 2)]:
                frame = glint.name_lost(json.loads(line, parse_float=finite, parse_constant=finite))
                check_order(frame)
                if "targets" in frame:
                    name = frame["sensors"]["suite"]
                    check_list(frame, suite_of(name))


def schema(folder):
    if importlib.util.find_spec("jsonschema") is None:
        raise Skip("python3-jsonschema is not installed")
    from jsonschema import Draft202012Validator
    Draft202012Validator.check_schema(SCHEMA)
    validator, count = Draft202012Validator(SCHEMA), 0
    for path in quick(PIPELINES[::4], PIPELINES):
        for command, data in hops_of(path):
            for frame in map(json.loads, data.splitlines()[::67]):
                count += 1
                fault = next(validator.iter_errors(frame), None)
                check(fault is None, f"{path}, {command}: {fault}")
    return f"{count} frames"


def suites_by_schema(folder):
    if importlib.util.find_spec("jsonschema") is None:
        raise Skip("python3-jsonschema is not installed")
    from jsonschema import Draft202012Validator
    schemas = {name: json.load(open(f"{ROOT}/schemas/{name}.json")) for name in ("sensors", "sensors-extending")}
    for schema_of in schemas.values():
        Draft202012Validator.check_schema(schema_of)
    names = sorted(name[:-5] for name in os.listdir(suites.FOLDER) if name.endswith(".json"))
    for name in names:
        document = json.load(open(f"{suites.FOLDER}/{name}.json"))
        kind = "sensors-extending" if "extends" in document else "sensors"
        for document, kind in ((document, kind), (suites.whole(name), "sensors")):
            fault = next(Draft202012Validator(schemas[kind]).iter_errors(document), None)
            check(fault is None, f"{name} by {kind}: {fault}")
    wrong = {"extends": "lrr77", "sensors": [{"name": "front", "range_max_m": None}]}
    check(not Draft202012Validator(schemas["sensors-extending"]).is_valid(wrong), "a member that must be there is taken away")
    return f"{len(names)} suites"


def recording(folder):
    data = os.environ.get("GLINT_TEST_DATA")
    if not data:
        raise Skip("GLINT_TEST_DATA is not set")
    path = os.path.join(data, "csv", "us101_interaction.csv")
    rows = list(csv.DictReader(open(path)))
    steps = {}
    for row in rows:
        steps.setdefault(row["track_id"], []).append(int(row["timestamp_ms"]))
    check(len(steps) == 12, f"{path}: {len(steps)} tracks, expected 12")
    for suite in ("srr24-pair-every-frame", "lrr77-every-frame"):
        for ego, times in steps.items():
            text = f"glint-traffic {path} --ego {ego} --radius-m 100 | {chain(suite)}"
            out = piped(text)
            check(fused(text) == out, f"{text}: fused differs")
            frames = parse(out)
            check([round(frame["time_s"] * 1000) for frame in frames] == sorted(times),
                  f"{text}: not one frame per recorded step of the ego")
            for frame in frames:
                check_laws(frame)
    return f"{len(steps)} egos"


PROPERTIES = [
    ("every pair of reflector and sensor ends in exactly one place", laws_hold),
    ("so it does with every combination of stages", laws_hold_after_swaps),
    ("a mirrored scene gives the mirrored list", mirror_symmetry),
    ("a scene turned, or shifted by 1e6 m, gives the same list", turn_and_shift),
    ("the order of objects does not matter", object_order),
    ("a scene before time 0 has the scans of one after it", times_below_zero),
    ("a line is read and written as it is alone", lines_alone),
    ("frames of two scenes may interleave", interleaved_scenes),
    ("a seed may be given anywhere and touches noise alone", seeds),
    ("objects that no sensor sees leave no trace", unseen_objects),
    ("an object may have the name that labels of no object have", names_of_no_object),
    ("a perfect sensor without noise shows every echo as it is", perfect_sensor),
    ("--sections keeps sections and changes nothing else", keep),
    ("extra members pass byte for byte", extras),
    ("all numbers are finite, all parts in canonical order", well_formed),
    ("frames are as the schema says", schema),
    ("suites are as their schemas say", suites_by_schema),
    ("a recording goes through with every vehicle as ego", recording),
]


def main():
    failed = False
    folder = tempfile.mkdtemp(prefix="glint-properties-")
    try:
        for sentence, prove in PROPERTIES:
            try:
                note = prove(folder)
                print(f"ok       {sentence}" + (f" ({note})" if note else ""))
            except Skip as reason:
                print(f"skipped  {sentence}: {reason}")
            except Fault as fault:
                failed = True
                print(f"FAILED   {sentence}: {fault}")
            sys.stdout.flush()
    finally:
        shutil.rmtree(folder)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
