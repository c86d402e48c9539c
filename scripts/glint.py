"""Frames of glint in Python: read them, place detections, write tracks, be a stage of the chain.

One file without dependencies, for Python 3.8 and later: import it, or copy it into your own project. Frames
are the dictionaries that `json` makes of a line (schemas/frame.json), and all units are those of their names:
metres, seconds, radians, decibels. Columns of numbers are `array.array`, which numpy and torch take without
copying (`numpy.asarray(column)`, `torch.frombuffer(column, dtype=torch.float64)`).

    import glint

    for frame in glint.frames("list.jsonl.gz"):
        print(frame["time_s"], list(glint.detections(frame)["x_m"]))

Places are in one of three coordinate systems: "world", x and y as the traffic has them; "ego", x ahead and y left
of the middle of the ego's box; "sensor", x along its axis. Yaw turns from x to y. A sensor with a cycle or a latency
measures `age_s` before the frame's time: its detections are placed from where the ego was then.
"""
import array
import glob
import gzip
import json
import math
import os
import sys
import zlib

# Numbers of a target that are there in every list.
MEASURED = ("range_m", "azimuth_rad", "range_rate_mps", "amplitude_db")


class BadFrame(ValueError):
    """What is wrong with a line, and where it stands."""


def frames(*sources, needs=()):
    """The frames of files one after another: plain or .gz, "-" or none for standard input. needs: members that
    every frame must have."""
    for source in sources or ("-",):
        yield from _frames_of(source, needs)


def _frames_of(source, needs):
    if source == "-":
        yield from _parsed(sys.stdin.buffer, "standard input", needs)
        return
    opener = gzip.open if str(source).endswith(".gz") else open
    with opener(source, "rb") as lines:
        yield from _parsed(lines, source, needs)


def _refuse(word):
    raise ValueError(f"{word} is no number of JSON")


_DECODER = json.JSONDecoder(parse_constant=_refuse)


def _parsed(lines, source, needs):
    number, line = 0, b""
    while line is not None:
        number += 1
        try:
            line = next(lines, None)
            frame = line is not None and _DECODER.decode(line.decode())
        except (ValueError, RecursionError, EOFError, gzip.BadGzipFile, zlib.error) as error:
            raise BadFrame(f"{source}:{number}: {error}; expected a frame, one line of JSON") from None
        if line is not None:
            missing = [name for name in needs if name not in frame] if isinstance(frame, dict) else ["member"]
            if missing:
                raise BadFrame(f"{source}:{number}: no {missing[0]}; expected a frame, one line of JSON")
            yield frame


def write(frame, out=None):
    """Writes a frame as one line, at once: what stands behind this stage need not wait."""
    print(json.dumps(frame, ensure_ascii=False, separators=(",", ":")), file=out or sys.stdout, flush=True)


def stage(change):
    """Is a stage: change(frame) returns the frame to write, or None for none. Names of files stand in the
    command line; without them frames come from standard input."""
    changed = map(change, frames(*sys.argv[1:]))
    program(write, ((frame,) for frame in changed if frame is not None))


def program(write_one, results):
    """Is a program: calls write_one(*result) for each result. Bad input ends it with a message and a status of sysexits,
    without a trace."""
    try:
        for result in results:
            write_one(*result)
        sys.stdout.flush()
    except BrokenPipeError:  # who reads has enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(74)
    except (BadFrame, OSError) as error:
        print(f"{os.path.basename(sys.argv[0])}: {error}", file=sys.stderr)
        sys.stderr.flush()
        os._exit(65 if isinstance(error, BadFrame) else 66 if error.filename else 74)  # without what a full disk refuses


def ego(frame, age_s=0):
    """The object that carries the sensors; with age_s as it was so long before, along its arc."""
    carrier = next((one for one in frame.get("objects", ()) if one["id"] == frame["ego"]), None)
    if carrier is None:
        raise BadFrame(f"{frame['scene']}, frame {frame['frame']}: without its ego; --sections objects carries it")
    if not age_s:
        return carrier
    turn = -age_s * carrier["yaw_rate_radps"]
    chord = -age_s * (math.sin(turn / 2) / (turn / 2) if turn else 1)
    dx, dy = turned(carrier["vx_mps"], carrier["vy_mps"], turn / 2)
    vx, vy = turned(carrier["vx_mps"], carrier["vy_mps"], turn)
    return dict(carrier, x_m=carrier["x_m"] + chord * dx, y_m=carrier["y_m"] + chord * dy,
                yaw_rad=carrier["yaw_rad"] + turn, vx_mps=vx, vy_mps=vy)


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


def place(frame, target, system="world"):
    """x and y of a target in a coordinate system, when it was measured."""
    x, y = turned(target["range_m"], 0, target["azimuth_rad"])
    if system == "sensor":
        return x, y
    mount = sensor(frame, target["sensor"])
    x, y = turned(x, y, mount["mount_yaw_rad"])
    x, y = x + mount["mount_x_m"], y + mount["mount_y_m"]
    return (x, y) if system == "ego" else to_world(frame, x, y, carrier_of(frame, target))


def direction(frame, target):
    """The angle in the world under which the sensor sees a target."""
    yaw_rad = carrier_of(frame, target)["yaw_rad"]
    return target["azimuth_rad"] + sensor(frame, target["sensor"])["mount_yaw_rad"] + yaw_rad


def rate_over_ground(frame, target):
    """The range rate that a sensor at rest would measure there: 0 of what stands."""
    carrier, mount = carrier_of(frame, target), sensor(frame, target["sensor"])
    x, y = turned(mount["mount_x_m"], mount["mount_y_m"], carrier["yaw_rad"])
    vx = carrier["vx_mps"] - carrier["yaw_rate_radps"] * y
    vy = carrier["vy_mps"] + carrier["yaw_rate_radps"] * x
    angle = direction(frame, target)
    return target["range_rate_mps"] + vx * math.cos(angle) + vy * math.sin(angle)


def label(target):
    """The contributor with the largest weight, or None: whose detection this is."""
    return max(target["contributors"], key=lambda one: one["weight"], default=None)


def detections(frame, system="world"):
    """The targets of a frame as columns: numbers as arrays of doubles, `sensor`, `object` and `reflector` as
    lists of names. object and reflector are the label; "" where no object shows. Frames that carry `quality`
    (`glint-ideal --sections quality`) give its numbers as well, NaN where a target lacks one."""
    targets = frame.get("targets", [])
    columns = {name: array.array("d", (one[name] for one in targets)) for name in MEASURED}
    places = [place(frame, one, system) for one in targets]
    columns["x_m"] = array.array("d", (x for x, _ in places))
    columns["y_m"] = array.array("d", (y for _, y in places))
    columns["rate_over_ground_mps"] = array.array("d", (rate_over_ground(frame, one) for one in targets))
    columns["sensor"] = [one["sensor"] for one in targets]
    told = [one.get("quality", {}) for one in targets]
    for name in sorted({name for one in told for name in one}):
        columns[name] = array.array("d", (one.get(name, math.nan) for one in told))
    labels = [label(one) or {} for one in targets]
    for name in ("object", "reflector"):
        columns[name] = [one.get(name, "") for one in labels]
    return columns


def write_tracks(frame, tracks, out=None):
    """Writes the tracks of a frame as schemas/tracks.json has them, for glint-score-tracks and glint-view.
    tracks: (id, x, y, vx, vy) of centres in the world."""
    x, y = frame.get("origin_x_m", 0), frame.get("origin_y_m", 0)
    write({"scene": frame["scene"], "frame": frame["frame"], "time_s": frame["time_s"],
           "tracks": [{"id": one[0], "x_m": one[1] - x, "y_m": one[2] - y, "vx_mps": one[3], "vy_mps": one[4]}
                      for one in tracks]}, out)


class Shards:
    """The frames of a set that scripts/dataset made, as an iterable data set.

    Of several workers each reads its own shards, so none is read twice. In PyTorch:

        class Frames(torch.utils.data.IterableDataset):
            def __iter__(self):
                worker = torch.utils.data.get_worker_info()
                return iter(glint.Shards("set", "train", worker=worker.id, workers=worker.num_workers))
    """

    def __init__(self, folder, split="*", suite="*", worker=0, workers=1):
        files = sorted(glob.glob(os.path.join(glob.escape(folder), split, suite, "*.jsonl.gz")))
        if not files:
            raise FileNotFoundError(f"{folder}: no shards {split}/{suite}/*.jsonl.gz")
        self.files = files[worker::workers]

    def __iter__(self):
        return frames(*self.files) if self.files else iter(())
