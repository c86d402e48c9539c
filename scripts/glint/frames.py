"""Frames of glint in Python: read them, place detections, write tracks, be a stage of the chain or the simulator before it.

One file without dependencies, for Python 3.8 and later, which also works alone, copied as glint.py. Frames are the
dictionaries that `json` makes of a line (schemas/frame.json), and all units are those of their names: metres, seconds,
radians, decibels. Columns of numbers are `array.array`, which numpy and torch take without copying
(`numpy.asarray(column)`, `torch.frombuffer(column, dtype=torch.float64)`).

    import glint

    for frame in glint.frames("list.jsonl.gz"):
        print(frame["time_s"], list(glint.detections(frame)["x_m"]))

Places are in one of three coordinate systems: "world", x and y as the traffic has them; "ego", x ahead and y left
of the middle of the ego's box; "sensor", x along its axis. Yaw turns from x to y. A sensor with a cycle or a latency
measures `age_s` before the frame's time: its detections are placed from where the ego was then.
"""
import array
import contextlib
import errno
import glob
import gzip
import json
import math
import os
import re
import select
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import zlib

# The version of frames (those of version 0 are read, too), and the numbers that a target has in every list.
VERSION = 1
MEASURED = ("range_m", "azimuth_rad", "range_rate_mps", "amplitude_db")


class BadFrame(ValueError):
    """What is wrong with a line, and where it stands."""


class Frame(dict):
    """A frame that knows its place, as in list.jsonl:7."""
    place = ""


def number(low, high, of=(int, float)):
    return lambda value: type(value) in of and low <= value <= high, f"a number in [{low:g}, {high:g}]"


# Shapes of the members that this module reads: a test with what it expects, a list of one shape, or shapes by name.
NAME = lambda value: type(value) is str and value != "", "a name"
SEED = lambda value: type(value) is str and re.fullmatch("[0-9]{1,20}", value), "a string of digits"
WHOLE = lambda value: type(value) in (int, float) and 0 <= value < 2 ** 53 and value % 1 == 0, "a whole number"
QUALITY = (lambda value: type(value) is dict and all(map(number(-1e9, 1e9, (int, float, bool))[0], value.values()))
           and 0 <= value.get("existence", 1) <= 1, "an object of numbers, existence in [0, 1]")
PLACE, ANGLE, SPEED, ORIGIN = (number(-most, most) for most in (1e7, 1e6, 1e4, 1e9))
OBJECT = {"id": NAME, "x_m": PLACE, "y_m": PLACE, "yaw_rad": ANGLE, "vx_mps": SPEED, "vy_mps": SPEED,
          "yaw_rate_radps": number(-1e3, 1e3)}
SENSOR = {"name": NAME, "mount_x_m": PLACE, "mount_y_m": PLACE, "mount_z_m": number(0, 100), "mount_yaw_rad": ANGLE,
          "age_s": number(0, 1e6)}
TARGET = {"sensor": NAME, "range_m": number(0, 1e7), "azimuth_rad": number(-math.pi, math.pi),
          "range_rate_mps": number(-1e6, 1e6), "amplitude_db": SPEED, "elevation_rad": ANGLE, "quality": QUALITY,
          "contributors": [{"object": NAME, "reflector": NAME, "weight": number(0, 1)}]}
LOST = {"echoes": (lambda value: type(value) is list and all(type(one) is dict for one in value)
                   and all(NAME[0](one.get("object")) for one in value[:1]), "an array of objects, the first of which names its object")}
VERSIONS = lambda value: type(value) in (int, float) and value in (0, VERSION), f"0 or {VERSION}; a newer glint reads others"
FRAME = {"version": VERSIONS, "scene": NAME, "seed": SEED, "frame": WHOLE, "time_s": number(-1e10, 1e10), "ego": NAME, "origin_x_m": ORIGIN,
         "origin_y_m": ORIGIN, "objects": [OBJECT], "sensors": {"list": [SENSOR]}, "targets": [TARGET],
         "lost": [LOST]}
OPTIONAL = {*FRAME, "age_s", "elevation_rad", "mount_z_m", "quality"}


def fault(value, shape, optional=OPTIONAL):
    """Where a value is not of a shape, what is there, and what is expected; None: it is."""
    if isinstance(shape, tuple):
        return None if shape[0](value) else f": {value!r:.60}; expected {shape[1]}"
    if not isinstance(value, type(shape)):
        return f": {value!r:.60}; expected {'an array' if isinstance(shape, list) else 'an object'}"
    if isinstance(shape, list):
        for i, one in enumerate(value):
            wrong = fault(one, shape[0], optional)
            if wrong:
                return f"[{i}]{wrong}"
        return None
    for name, inner in shape.items():
        if type(inner) is tuple and inner[0](value.get(name)) or name in optional and name not in value:
            continue
        wrong = fault(value[name], inner, optional) if name in value else ": missing"
        if wrong:
            return f".{name}{wrong}"
    return None


def unjoined(frame):
    """A name that joins nothing, or two things; None: there is none."""
    ids = [one["id"] for one in frame.get("objects", ())]
    names = [one["name"] for one in frame["sensors"]["list"]] if "sensors" in frame else []
    if len({*ids}) + len({*names}) < len(ids) + len(names):
        return "objects or sensors.list: two have the same id or name"
    if ids and frame.get("ego") not in ids:
        return f"ego: {frame.get('ego')!r} is not among the objects"
    return next((f"targets[{i}]: {one['sensor']!r:.60}; expected a sensor of sensors.list, and contributors"
                 for i, one in enumerate(frame.get("targets", ())) if one["sensor"] not in names or not one["contributors"]),
                None)


def frames(*sources, needs=(), check=True):
    """The frames of files one after another: plain or packed, "-" or none for standard input. needs: members that
    every frame must have. What is no JSON is refused (BadFrame), and what is wrong in members that this module reads;
    glint-check holds frames to all that they must be. Lines that it has checked are read in half the time without check."""
    for source in sources or ("-",):
        name = "standard input" if source == "-" else str(source)
        with open(0 if source == "-" else source, "rb", closefd=source != "-") as file:
            yield from _parsed(file, name, needs, check)


def no_constant(word):
    raise ValueError(f"{word} is no value")


def once(members):
    found = dict(members)
    if len(found) < len(members):
        seen = set()
        raise ValueError(f"the key {next(name for name, _ in members if name in seen or seen.add(name))!r} stands twice")
    return found


def _finite(digits):
    value = float(digits)
    if math.isinf(value):
        raise ValueError(f"{digits:.40} is too large")
    return value


def _whole(digits):
    _finite(digits)
    return int(digits)


_DECODER = json.JSONDecoder(parse_constant=no_constant, object_pairs_hook=once)
# Of a line only digits, signs and letters of exponents, and what ends a number, which is a comma here.
_NUMBERS = bytes(ord("0" if chr(byte) in "0123456789" else "e" if chr(byte) in "eE" else "+" if byte == ord("+") else
                     "," if chr(byte) in ",]} \t\r\n" else "x") for byte in range(256))
_FINITE = json.JSONDecoder(parse_constant=no_constant, object_pairs_hook=once, parse_float=_finite, parse_int=_whole)


def _may_be_large(line):
    """Whether a number may be too large for a double: it has three digits in its exponent, or 200 digits in a row."""
    numbers = line.translate(_NUMBERS)
    behind = numbers.replace(b"e+", b"e").split(b"e000")[1:]  # a digest has a letter or a quote behind its digits
    return any(text.lstrip(b"0")[:1] in (b",", b"") for text in behind) or b"0" * 200 in numbers


def decoded(line):
    """What a text of JSON says, as strictly as glint reads it."""
    value = (_FINITE if _may_be_large(line) else _DECODER).decode(line.decode())
    if b"\\u" in line and b"\\u0000" in json.dumps(value, ensure_ascii=False).encode():  # encode() refuses lone surrogates
        raise ValueError("a character 0")
    return value


def _feed(file, pipe):
    with contextlib.suppress(BrokenPipeError), pipe:  # a reader that has ended says why by its status
        shutil.copyfileobj(file, pipe)


def _unpacked_zstd(file):
    """The lines that zstd(1) unpacks; ValueError where they are damaged or end early."""
    try:
        process = subprocess.Popen(["zstd", "-dcq"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    except FileNotFoundError:
        raise ValueError("packed by zstd, and there is no program zstd") from None
    with process:
        threading.Thread(target=_feed, args=(file, process.stdin), daemon=True).start()
        for line in process.stdout:
            if line.endswith(b"\n") or process.wait() == 0:
                yield line
        if process.wait() != 0:
            raise ValueError(process.stderr.read().decode(errors="replace").strip())


def _unpacked(file, head):
    """The lines of a file, by its first byte."""
    if head == b"\x1f":
        return gzip.GzipFile(fileobj=file)
    return _unpacked_zstd(file) if head == b"(" else file


def _parsed(file, name, needs, check):
    number_of_line = 1
    try:
        head = file.peek(1)[:1]
        if not head and name.endswith((".gz", ".zst")):
            raise ValueError("0 bytes")
        for line in _unpacked(file, head):
            frame = decoded(line) if check else json.loads(line)
            wrong = fault(frame, FRAME, OPTIONAL - {"version", *needs}) or unjoined(frame) if check else fault(frame, {})
            if wrong:
                raise BadFrame(wrong.lstrip(".: "))
            name_lost(frame)
            frame = Frame(frame)
            frame.place = f"{name}:{number_of_line}"
            yield frame
            number_of_line += 1
    except (ValueError, RecursionError, EOFError, gzip.BadGzipFile, zlib.error) as error:
        expected = "" if isinstance(error, BadFrame) else "; expected a frame, one line of JSON"
        raise BadFrame(f"{name}:{number_of_line}: {error}{expected}") from None
    except OSError as error:
        raise OSError(error.errno, f"{name}: {error.strerror}") from None


def name_lost(frame):
    """Gives each lost echo its object and its path. A line leaves out the object of the echo before, and the path "direct"."""
    for group in frame.get("lost", ()):
        of = None
        for echo in group["echoes"]:
            of = echo.setdefault("object", of)
            echo.setdefault("path", "direct")
    return frame


def place_of(frame):
    return getattr(frame, "place", "") or f"{frame.get('scene')}, frame {frame.get('frame')}"


def write(frame, out=None):
    """Writes a frame as one line, at once: what stands behind this stage need not wait."""
    try:
        print(json.dumps(frame, ensure_ascii=False, allow_nan=False, separators=(",", ":")), file=out or sys.stdout, flush=True)
    except (ValueError, RecursionError) as error:
        raise BadFrame(f"{place_of(frame)}: cannot be written: {error}") from None


def stage(change):
    """Is a stage: change(frame) returns the frame to write, or None for none. Names of files stand in the
    command line; without them frames come from standard input."""
    changed = map(change, frames(*sys.argv[1:]))
    program(write, ((frame,) for frame in changed if frame is not None))


def program(write_one, results):
    """Is a program: calls write_one(*result) for each result. Bad input ends it with a message and a status of sysexits,
    without a trace."""
    try:
        if sys.stdout is None:
            raise OSError(errno.EBADF, "stdout: it is closed")
        sys.stdout.reconfigure(encoding="utf-8")
        for result in results:
            write_one(*result)
        sys.stdout.flush()
    except BrokenPipeError:  # who reads has enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(74)
    except KeyboardInterrupt:
        os._exit(130)
    except (BadFrame, OSError) as error:
        told = error if isinstance(error, BadFrame) else ": ".join(filter(None, (error.filename, error.strerror)))
        print(f"{os.path.basename(sys.argv[0])}: {told}", file=sys.stderr)
        sys.stderr.flush()
        os._exit(65 if isinstance(error, BadFrame) else 66 if error.filename else 74)  # without what a full disk refuses


def ego(frame, age_s=0):
    """The object that carries the sensors; with age_s as it was so long before."""
    carrier = next((one for one in frame.get("objects", ()) if one["id"] == frame["ego"]), None)
    if carrier is None:
        raise BadFrame(f"{place_of(frame)}: without its ego; --sections objects carries it")
    return earlier(carrier, age_s)


def earlier(one, age_s):
    """An object as it was so long before, along its arc."""
    if not age_s:
        return one
    turn = -age_s * one["yaw_rate_radps"]
    chord = -age_s * (math.sin(turn / 2) / (turn / 2) if turn else 1)
    dx, dy = turned(one["vx_mps"], one["vy_mps"], turn / 2)
    vx, vy = turned(one["vx_mps"], one["vy_mps"], turn)
    return dict(one, x_m=one["x_m"] + chord * dx, y_m=one["y_m"] + chord * dy, yaw_rad=one["yaw_rad"] + turn, vx_mps=vx, vy_mps=vy)


def sensor(frame, name):
    """The sensor of this name."""
    return next(one for one in frame["sensors"]["list"] if one["name"] == name)


def carrier_of(frame, target):
    """The ego when the target was measured."""
    return ego(frame, sensor(frame, target["sensor"]).get("age_s", 0))


def turned(x, y, angle):
    return x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle)


def to_world(frame, x, y, carrier=None):
    """From the ego's coordinates to the world's; carrier: the ego at another time."""
    carrier = carrier or ego(frame)
    x, y = turned(x, y, carrier["yaw_rad"])
    return (x + carrier["x_m"] + frame.get("origin_x_m", 0), y + carrier["y_m"] + frame.get("origin_y_m", 0))


def sight(target):
    """The direction of a target in the sensor's axes: ahead, left and up. Its azimuth is the angle of a cone."""
    c, s, up = math.cos(target["azimuth_rad"]), math.sin(target["azimuth_rad"]), math.sin(target.get("elevation_rad", 0))
    return math.copysign(math.sqrt(max(c * c - up * up, 0)), c) if up else c, s, up


def height(frame, target, system="world"):
    """z of a target: over the road, or from the sensor; 0 from a sensor that measures no elevation."""
    up_m = target["range_m"] * sight(target)[2]
    return up_m if system == "sensor" else up_m + sensor(frame, target["sensor"]).get("mount_z_m", 0)


def place(frame, target, system="world", mount=None, carrier=None):
    """x and y of a target in a coordinate system, when it was measured. mount, carrier: its sensor, and carrier_of it, where
    they are known."""
    x, y = (target["range_m"] * part for part in sight(target)[:2])
    if system == "sensor":
        return x, y
    mount = mount or sensor(frame, target["sensor"])
    x, y = turned(x, y, mount["mount_yaw_rad"])
    x, y = x + mount["mount_x_m"], y + mount["mount_y_m"]
    return (x, y) if system == "ego" else to_world(frame, x, y, carrier or carrier_of(frame, target))


def direction(frame, target, mount=None, carrier=None):
    """The angle in the world under which the sensor sees a target."""
    mount, carrier = mount or sensor(frame, target["sensor"]), carrier or carrier_of(frame, target)
    return target["azimuth_rad"] + mount["mount_yaw_rad"] + carrier["yaw_rad"]


def rate_over_ground(frame, target, mount=None, carrier=None):
    """The range rate that a sensor at rest would measure there: 0 of what stands."""
    mount, carrier = mount or sensor(frame, target["sensor"]), carrier or carrier_of(frame, target)
    x, y = turned(mount["mount_x_m"], mount["mount_y_m"], carrier["yaw_rad"])
    vx = carrier["vx_mps"] - carrier["yaw_rate_radps"] * y
    vy = carrier["vy_mps"] + carrier["yaw_rate_radps"] * x
    angle = direction(frame, target, mount, carrier)
    return target["range_rate_mps"] + vx * math.cos(angle) + vy * math.sin(angle)


def label(target):
    """The contributor with the largest weight, or None: whose detection this is."""
    return max(target["contributors"], key=lambda one: one["weight"], default=None)


def owner(echo):
    """The id of the object that a contributor or a lost echo is of; None for clutter and false alarms: they are of no object, even
    where an object is called as they are."""
    return None if echo.get("path") in ("clutter", "false_alarm") else echo["object"]


def detections(frame, system="world"):
    """The targets of a frame as columns: numbers as arrays of doubles, `sensor`, `object`, `reflector` and `path` as
    lists of names. These are of the label; object is "" for clutter and false alarms, and path "" where the frame
    has none. `elevation_rad` and `z_m` are of sensors that measure elevation. Frames that carry `quality` (`glint-ideal
    --sections quality`) give its numbers as well. Where a target lacks one of these, it is NaN."""
    targets = frame.get("targets", [])
    columns = {name: array.array("d", (one[name] for one in targets)) for name in MEASURED}
    seen_by = {name: (sensor(frame, name), carrier_of(frame, one)) for name, one in {one["sensor"]: one for one in targets}.items()}
    places = [place(frame, one, system, *seen_by[one["sensor"]]) for one in targets]
    columns["x_m"] = array.array("d", (x for x, _ in places))
    columns["y_m"] = array.array("d", (y for _, y in places))
    columns["elevation_rad"] = array.array("d", (one.get("elevation_rad", math.nan) for one in targets))
    columns["z_m"] = array.array("d", (height(frame, one, system) if "elevation_rad" in one else math.nan for one in targets))
    columns["rate_over_ground_mps"] = array.array("d", (rate_over_ground(frame, one, *seen_by[one["sensor"]]) for one in targets))
    columns["sensor"] = [one["sensor"] for one in targets]
    told = [one.get("quality", {}) for one in targets]
    for name in sorted({name for one in told for name in one}):
        columns[name] = array.array("d", (one.get(name, math.nan) for one in told))
    labels = [label(one) or {"object": ""} for one in targets]
    columns["object"] = [owner(one) or "" for one in labels]
    for name in ("reflector", "path"):
        columns[name] = [one.get(name, "") for one in labels]
    return columns


def columns(*sources, chain=None):
    """The tables of a stream (schemas/README.md) as arrays of numpy by their names, those of a table by the names of its
    columns: columns("list.jsonl.gz")["detections"]["range_m"]. sources: files of frames, "-" or none for standard input, or
    one folder that glint-tables --npy wrote; chain: what makes the frames, whose columns come out of the same process
    without a line of JSON. A row of `detections` has in `object_key` the row of `objects` that its label is of, or -1. What
    is absent is NaN, -1 or ""."""
    if chain is None and len(sources) == 1 and os.path.isdir(sources[0]):
        return _arrays(sources[0])
    with tempfile.TemporaryDirectory() as folder:
        words = ["glint-tables", "--npy", folder, *map(os.fspath, sources)]
        if chain is not None:
            frames = _QUOTED_OR_COMMENT.sub(lambda found: found[1] or "", chain).strip()
            words = ["glint", "-c", f"{frames} | {shlex.join(words)}"]
        done = subprocess.run(words, stderr=subprocess.PIPE, check=False)
        told = done.stderr.decode(errors="replace")
        if done.returncode:
            raise ChainError(f"exit status {done.returncode}: {told.strip()}", done.returncode)
        sys.stderr.write(told)
        return _arrays(folder)


TABLES = "contributors", "detections", "frames", "lost", "objects", "scans", "sightings"


def _arrays(folder):
    import numpy  # of all functions here this one alone needs it
    with open(os.path.join(folder, "names.json"), encoding="utf-8") as file:
        names = numpy.array(json.load(file), dtype=object)
    tables = {}
    for table in TABLES:  # a folder that lacks one was not written to its end
        rows = numpy.load(os.path.join(folder, f"{table}.npy"), mmap_mode="r")
        tables[table] = {
            name: names[rows[name]] if rows.dtype[name].kind == "u" else numpy.array(rows[name]) for name in rows.dtype.names}
    return tables


def write_tracks(frame, tracks, out=None):
    """Writes the tracks of a frame as schemas/tracks.json has them, for glint-score-tracks and glint-view.
    tracks: (id, x, y, vx, vy) of centres in the world, or with a sixth item, a matrix that begins with the covariance of x, y."""
    x, y = frame.get("origin_x_m", 0), frame.get("origin_y_m", 0)
    spread = [{"variance_x_m2": of[0][0], "covariance_xy_m2": of[0][1], "variance_y_m2": of[1][1]} if of else {}
              for of in (one[5] if len(one) > 5 else None for one in tracks)]
    write({"scene": frame["scene"], "frame": frame["frame"], "time_s": frame["time_s"],
           "tracks": [{"id": one[0], "x_m": one[1] - x, "y_m": one[2] - y, "vx_mps": one[3], "vy_mps": one[4], **of}
                      for one, of in zip(tracks, spread)]}, out)


class Shards:
    """The frames of a set that scripts/dataset made, as an iterable data set.

    Of several workers each reads its own shards, so none is read twice. In PyTorch:

        class Frames(torch.utils.data.IterableDataset):
            def __iter__(self):
                worker = torch.utils.data.get_worker_info()
                return iter(glint.Shards("set", "train", worker=worker.id, workers=worker.num_workers))
    """

    def __init__(self, folder, split="*", suite="*", worker=0, workers=1, check=True):
        files = sorted(glob.glob(os.path.join(glob.escape(folder), split, suite, "*.jsonl.*")))
        if not files:
            raise FileNotFoundError(f"{folder}: no shards {split}/{suite}/*.jsonl.gz or .zst")
        self.files, self.check = files[worker::workers], check

    def __iter__(self):
        return frames(*self.files, check=self.check) if self.files else iter(())


class ChainError(RuntimeError):
    """A chain has ended, or answered something else than targets; with its exit status, or None."""

    def __init__(self, text, status=None):
        super().__init__(text)
        self.status = status


_QUOTED_OR_COMMENT = re.compile(r"""(\\.|'[^']*'|"(?:\\.|[^"\\])*")|(?<![^\s|])#[^\n]*""", re.DOTALL)
_QUOTED_OR_BAR = re.compile(r"""(\\.|'[^']*'|"(?:\\.|[^"\\])*")|\|""", re.DOTALL)


def stages_of(chain):
    """The stages of a chain, which have `|` between them, each as its words. Quotes are those of a shell. There are no comments: a
    `#` is a letter."""
    stages = [shlex.split(stage) for stage in _QUOTED_OR_BAR.sub(lambda found: found[1] or "\0", chain).split("\0")]
    if not all(stages):
        raise ValueError(f"{chain!r}: a stage has no words; expected the name of a program between two |")
    return stages


class Loop:
    """A chain that answers each frame of a simulator with its targets.

        with glint.Loop("glint-extract | glint-ideal --sensors lrr77 | glint-sensor | glint-noise") as radar:
            for objects in my_simulator:                    # dictionaries, as pipelines/simulators.py makes them
                targets = radar.step("ego", objects)

    A chain that has not answered after timeout_s is a TimeoutError; one that ends, or answers no targets, is a ChainError
    with the messages of its stages. Both end the chain; restart() starts it again, at frame 0. A chain of glint's stages is one
    process, unless fused is false; one with stages of your own is a process for each. record: a file for the chain and all frames
    that it is given, which `glint FILE` plays again; what a restart begins goes to FILE.2, FILE.3 and so on.
    """

    def __init__(self, chain, interval_s=0.05, timeout_s=10, scene="live", seed=1, fused=True, record=None):
        self.commands = stages_of(chain)
        if fused and all(stage[0].startswith("glint-") for stage in self.commands):
            self.commands = [["glint", "-c", " | ".join(map(shlex.join, self.commands))]]
        self.chain, self.timeout_s, self.processes = chain, timeout_s, []
        self.record, self.recording, self.starts = record, None, 0
        self.head = {"version": VERSION, "scene": scene, "interval_s": interval_s, "seed": str(seed)}
        self.restart()

    def restart(self):
        self.end()
        self.frames, self.answers, self.told = 0, b"", tempfile.TemporaryFile()
        self.starts += 1
        if self.record is not None:
            self._begin_recording(self.record if self.starts == 1 else f"{self.record}.{self.starts}")
        for command in self.commands:
            before = self.processes[-1].stdout if self.processes else subprocess.PIPE
            try:
                self.processes.append(subprocess.Popen(command, stdin=before, stdout=subprocess.PIPE, stderr=self.told,
                                                       start_new_session=True, bufsize=0))
            except OSError:  # no program of that name
                self.end()
                raise
            if self.processes[1:]:
                before.close()  # the next one has it, and alone: its end is told to the one before
        for pipe in (self.processes[0].stdin, self.processes[-1].stdout):
            os.set_blocking(pipe.fileno(), False)

    def _begin_recording(self, path):
        first, *others = map(shlex.join, stages_of(self.chain))
        chain = " | ".join([f"{first} <<'END'", *others])
        self.recording = open(path, "wb", buffering=0)
        self._keep(f"# A recording of glint.Loop: `glint FILE` plays it.\nset -o pipefail\n{chain}\n".encode())

    def _keep(self, text):
        """Writes all of a text into the recording; where that fails, the recording ends there, and the chain with it."""
        try:
            while text:
                text = text[self.recording.write(text):]
        except OSError as error:
            path = self.recording.name
            self.recording.close()
            self.recording = None
            self.end()
            raise OSError(error.errno, f"{path}: {error.strerror}") from None

    def step(self, ego, objects, **members):
        """The targets of the next frame; members: others of the frame, as conditions."""
        time_s = self.frames * self.head["interval_s"]
        return self.send(dict(self.head, frame=self.frames, time_s=time_s, ego=ego, objects=objects, **members))["targets"]

    def send(self, frame):
        """The answer to a frame of your own: the frame with its targets."""
        if not self.processes:
            raise ChainError("the chain has ended; restart() starts it again")
        text = json.dumps(frame, allow_nan=False, separators=(",", ":")).encode() + b"\n"
        if self.recording:
            self._keep(text)
        try:
            answer = decoded(self._exchange(text))
            if not all(answer[name] == frame[name] for name in ("scene", "frame")) or "targets" not in answer:
                raise ValueError(f"the answer to another frame than {place_of(frame)}")
        except (KeyError, TypeError, ValueError, RecursionError) as error:
            raise ChainError(f"{self.chain}: no targets: {error}", self.end()) from None
        except BaseException:  # a late answer would be taken for the next one
            self.end()
            raise
        self.frames += 1
        return answer

    def _exchange(self, text):
        """Writes a line and reads the next one."""
        end_s, pipes = time.monotonic() + self.timeout_s, select.poll()
        write, read = self.processes[0].stdin.fileno(), self.processes[-1].stdout.fileno()
        pipes.register(read, select.POLLIN)
        pipes.register(write, select.POLLOUT)
        while text or b"\n" not in self.answers:
            ready = dict(pipes.poll(max(0, 1e3 * (end_s - time.monotonic()))))
            if not ready:
                raise TimeoutError(f"{self.chain}: no answer in {self.timeout_s} s")
            if read in ready:
                more = os.read(read, 1 << 20)
                if not more:
                    status, _ = self.end(patience_s=5), self.told.seek(0)
                    raise ChainError(f"exit status {status}: {self.told.read().decode(errors='replace').strip() or self.chain}", status)
                self.answers += more
            if write in ready:
                with contextlib.suppress(BrokenPipeError):  # the end of the answers says why
                    text = text[os.write(write, text):]
                if not text or ready[write] & select.POLLERR:
                    pipes.unregister(write)
        line, _, self.answers = self.answers.partition(b"\n")
        return line

    def end(self, patience_s=0):
        """Ends the chain, by force what has not ended after patience_s; the exit status of the last stage that failed, or 0."""
        processes, self.processes, end_s = self.processes, [], time.monotonic() + patience_s
        for process in processes[:1]:
            process.stdin.close()
        for process in processes:
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(max(0, end_s - time.monotonic()))
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.stdout.close()
        if self.recording:
            self._keep(b"END\n")
            self.recording.close()
            self.recording = None
        return next(filter(None, [process.wait() for process in reversed(processes)]), 0)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end(patience_s=0.5)
