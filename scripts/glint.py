"""Frames of glint in Python: read them, place detections, write tracks, be a stage of the chain.

One file without dependencies, for Python 3.8 and later: import it, or copy it into your own project. Frames
are the dictionaries that `json` makes of a line (schemas/frame.json), and all units are those of their names:
metres, seconds, radians, decibels. Columns of numbers are `array.array`, which numpy and torch take without
copying (`numpy.asarray(column)`, `torch.frombuffer(column, dtype=torch.float64)`).

    import glint

    for frame in glint.frames("list.jsonl.gz"):
        print(frame["time_s"], list(glint.detections(frame)["x_m"]))

Places are in one of three coordinate systems: "world", x and y as the traffic has them; "ego", x ahead and y left
of the middle of the ego's box; "sensor", x along its axis. Yaw turns from x to y.
"""
import array
import glob
import gzip
import json
import math
import os
import sys

# Numbers of a target that are there in every list.
MEASURED = ("range_m", "azimuth_rad", "range_rate_mps", "amplitude_db")


def frames(*sources):
    """The frames of files one after another: plain or .gz, "-" or none for standard input."""
    for source in sources or ("-",):
        yield from _frames_of(source)


def _frames_of(source):
    if source == "-":
        yield from _parsed(sys.stdin, "standard input")
        return
    opener = gzip.open if str(source).endswith(".gz") else open
    with opener(source, "rt", encoding="utf-8") as lines:
        yield from _parsed(lines, source)


def _parsed(lines, source):
    for number, line in enumerate(lines, 1):
        try:
            yield json.loads(line)
        except json.JSONDecodeError as error:
            raise ValueError(f"{source}:{number}: {error}; expected a frame, one line of JSON") from None


def write(frame, out=None):
    """Writes a frame as one line, at once: what stands behind this stage need not wait."""
    print(json.dumps(frame, ensure_ascii=False, separators=(",", ":")), file=out or sys.stdout, flush=True)


def stage(change):
    """Is a stage: change(frame) returns the frame to write, or None for none. Names of files stand in the
    command line; without them frames come from standard input."""
    for frame in frames(*sys.argv[1:]):
        changed = change(frame)
        if changed is not None:
            write(changed)


def ego(frame):
    """The object that carries the sensors."""
    return next(one for one in frame["objects"] if one["id"] == frame["ego"])


def sensor(frame, name):
    """The sensor of this name."""
    return next(one for one in frame["sensors"]["list"] if one["name"] == name)


def turned(x, y, angle):
    return x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle)


def to_world(frame, x, y):
    """From the ego's coordinates to the world's."""
    carrier = ego(frame)
    x, y = turned(x, y, carrier["yaw_rad"])
    return (x + carrier["x_m"] + frame.get("origin_x_m", 0), y + carrier["y_m"] + frame.get("origin_y_m", 0))


def place(frame, target, system="world"):
    """x and y of a target in a coordinate system."""
    x, y = turned(target["range_m"], 0, target["azimuth_rad"])
    if system == "sensor":
        return x, y
    mount = sensor(frame, target["sensor"])
    x, y = turned(x, y, mount["mount_yaw_rad"])
    x, y = x + mount["mount_x_m"], y + mount["mount_y_m"]
    return (x, y) if system == "ego" else to_world(frame, x, y)


def direction(frame, target):
    """The angle in the world under which the sensor sees a target."""
    return target["azimuth_rad"] + sensor(frame, target["sensor"])["mount_yaw_rad"] + ego(frame)["yaw_rad"]


def rate_over_ground(frame, target):
    """The range rate that a sensor at rest would measure there: 0 of what stands."""
    carrier, mount = ego(frame), sensor(frame, target["sensor"])
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
