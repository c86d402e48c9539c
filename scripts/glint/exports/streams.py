"""Reads what is exported, with all that formats need: frames of lines, of the tables of glint-tables, or of a set."""
import contextlib
import csv
import functools
import glob
import gzip
import io
import itertools
import json
import os
import pickle
import sys
import tempfile
import zlib
from collections import Counter, namedtuple

import glint
from glint import command_line
from glint.exports.arrays import NotWhole, frames_of_arrays, heads_of_arrays
from glint.exports.whole import checked, sensor_of
from glint.places import DATA, SCHEMAS
from glint.sets import schema
from glint.sets.plan import BAD_DATA, NO_INPUT, Fault, read_json
from glint.sets.tables import opened

HEIGHT_M = 0.5  # of a sensor that has none: usual for radars
Stream = namedtuple("Stream", "split place")  # place: of a file of lines, or of a folder of tables
LEVELS = {"v0-40": 0, "v40-60": 1, "v60-80": 2, "v80-100": 3}
COUNTED = "objects", "scans", "detections", "contributors", "sightings", "lost"  # tables of which frames have numbers of rows
CELLS = {"frame_key", "detection_key", "seed", "time_s", "sensor", "measured_s", "detection", "contributor", *COUNTED}  # no row lacks them
LOST = "a row was lost, doubled or moved, here or before"


def rows(folder, name):
    """The rows of a table, without empty cells; each knows its place."""
    of, path = {"integer": int, "number": float, "boolean": "true".__eq__, "string": str}, os.path.join(folder, name + ".csv")
    types = {one["name"]: of[one["type"]] for one in read_json(os.path.join(SCHEMAS, "tables.json"))[name]["fields"]}
    place = path = next(filter(os.path.exists, (path, path + ".zst")), path + ".gz")
    try:
        with io.TextIOWrapper(opened(path), encoding="utf-8", newline="") as file:
            table = csv.DictReader(file, strict=True)
            if not table.fieldnames:
                raise ValueError("no heading")
            for cells in table:
                place = f"{path}:{table.line_num}"
                row = glint.Frame((key, types[key](cell)) for key, cell in cells.items() if cell)
                if None in cells.values():
                    raise ValueError("cells are missing")
                if lacking := CELLS & types.keys() - row.keys():
                    raise ValueError(f"no {', '.join(sorted(lacking))}")
                row.place = place
                yield row
    except FileNotFoundError as error:
        raise Fault(NO_INPUT, f"{path}: no such table; expected all those of glint-tables: run it again if it was killed") from error
    except (AttributeError, EOFError, KeyError, TypeError, ValueError, csv.Error, gzip.BadGzipFile, zlib.error) as error:
        raise Fault(BAD_DATA, f"{place}: {error!r}; expected a table of glint-tables") from error


class Table:
    """The rows of a table in their order, without gaps. A row that was lost, doubled or moved is refused with its place."""

    def __init__(self, folder, name, numbers=None, first=None):
        """numbers: a column that goes up by 1 from row to row, from first on, or from what the first row has."""
        self.name, self.rows, self.numbers, self.first, self.next = name, rows(folder, name), numbers, first, first

    def take(self, above, **keys):
        """The next rows, as many as the row above says. They have these keys."""
        count, self.next = above[self.name], self.next if self.first is None else self.first
        found = [self.checked(row, keys) for _, row in zip(range(count), self.rows)]
        if len(found) < count:
            raise Fault(BAD_DATA, f"{above.place}: {self.name} {count}; the table {self.name} ends after {len(found)} of them")
        return found

    def checked(self, row, keys):
        if self.numbers:
            keys = keys | {self.numbers: row.get(self.numbers, 0) if self.next is None else self.next}
            self.next = keys[self.numbers] + 1
        if wrong := next((key for key, value in keys.items() if row.get(key) != value), None):
            raise Fault(BAD_DATA, f"{row.place}: {wrong} {row.get(wrong)}; expected {keys[wrong]}: {LOST}")
        return row

    def end(self):
        if row := next(self.rows, None):
            raise Fault(BAD_DATA, f"{row.place}: a row of {self.name} that belongs to no row of another table")


def of_scans(table, frame, scans, once=()):
    """The rows of a frame that belong to its scans, or to a sensor without one. No two have the same values in the columns `once`."""
    keys, known = {None, *(one["scan_key"] for one in scans)}, set()
    found = table.take(frame)
    for row in found:
        what = tuple(map(row.get, once))
        if row.get("scan_key") not in keys:
            raise Fault(BAD_DATA, f"{row.place}: scan_key {row['scan_key']}; expected a scan of {frame.place}: {LOST}")
        if once and what in known:
            raise Fault(BAD_DATA, f"{row.place}: {' '.join(map(str, what))} for the second time in {frame.place}: {LOST}")
        known.add(what)
    return found


def frame_of(row, scans, **members):
    """A frame of a row and of the rows of its scans."""
    sensors = [sensor_of(one, row["time_s"]) for one in scans]
    known = {name: value for name, value in row.items() if name not in COUNTED}
    frame = glint.Frame(known, version=glint.VERSION, seed=str(row["seed"]), sensors={"suite": row.get("suite"), "list": sensors}, **members)
    frame.place = row.place
    return frame


def heads_of_tables(folder):
    """Frames with their sensors alone."""
    frames, scans = Table(folder, "frames", "frame_key"), Table(folder, "scans", "scan_key")
    for row in frames.rows:
        yield frame_of(row, scans.take(row, frame_key=frames.checked(row, {})["frame_key"]))


def frames_of_tables(folder):
    tables = frames, objects, scans, targets, parts, sightings, lost = [Table(folder, *words) for words in (
        ("frames", "frame_key"), ("objects", "object_key"), ("scans", "scan_key"), ("detections", "detection_key"),
        ("contributors", "contributor", 0), ("sightings",), ("lost",))]
    for row in frames.rows:
        key = {"frame_key": frames.checked(row, {})["frame_key"]}
        bodies, of_sensors = objects.take(row, **key), scans.take(row, **key)
        found = [one for scan in of_sensors for one in targets.take(scan, **key, scan_key=scan["scan_key"], sensor=scan["sensor"])]
        for one in found:
            one["quality"] = {name[8:]: value for name, value in one.items() if name.startswith("quality_")}
            one["contributors"] = parts.take(one, detection_key=one["detection_key"])
        for name, count in ("detections", len(found)), ("contributors", sum(len(one["contributors"]) for one in found)):
            if row[name] != count:
                raise Fault(BAD_DATA, f"{row.place}: {name} {row[name]}; expected {count}, the rows of that table")
        seen = of_scans(sightings, row, of_sensors, once=("sensor", "object"))
        of_scans(lost, row, of_sensors)
        yield checked(frame_of(row, of_sensors, objects=bodies, targets=found, visibility=seen))
    for table in tables:
        table.end()


def frames_of_lines(path, of_arrays=frames_of_arrays):
    """Frames by their arrays, and from the first one on that is not whole there by their lines."""
    number = 0
    with contextlib.suppress(NotWhole, FileNotFoundError):
        if not os.path.isfile(path):  # a pipe is read once
            raise NotWhole
        for frame in of_arrays(path):
            yield frame
            number += 1
        return
    yield from map(checked, itertools.islice(glint.frames(path, check=False), number, None))


def place_of(shard, are_whole):
    """The lines of a shard where they are whole, as those are read in a third of the time; else its tables."""
    lines, tables = glob.glob(glob.escape(shard) + ".jsonl.*"), glob.glob(os.path.join(glob.escape(shard), "frames.csv*"))
    return shard if tables and not (lines and are_whole) else next(iter(lines), shard + ".jsonl.gz")


def streams_of(path, split):
    """The streams of an input: a set has splits of its own."""
    manifest = os.path.join(path, "datapackage.json")
    if not os.path.exists(manifest):
        return [Stream(split, path)]
    found = document(manifest, "set")
    shards = {(one["path"].split("/")[0], os.path.join(path, *one["path"].split(".")[0].split("/")[:3])) for one in found["resources"]}
    are_whole = found.get("plan", {}).get("lines", "whole") == "whole"
    return [Stream(split, place_of(shard, are_whole)) for split, shard in sorted(shards)]


def frames_in(place, heads):
    """The frames of a stream; heads: they need no more than their sensors."""
    if os.path.isdir(place):
        return heads_of_tables(place) if heads else frames_of_tables(place)
    return frames_of_lines(place, heads_of_arrays if heads else frames_of_arrays)


def is_read_again(stream):
    """Whether a stream can be read twice; a pipe can not."""
    return os.path.isfile(stream.place) or os.path.isdir(stream.place)


def document(path, kind):
    """A document of a kind of data/exports/schema.json."""
    found = read_json(path)
    if fault := schema.fault_of(found, read_json(os.path.join(DATA, "exports", "schema.json"))[kind]):
        raise Fault(BAD_DATA, f"{path}: {fault}")
    return found


def complete(frame):
    """Gives a height to sensors that have none; refuses sensors that files would take for one."""
    for one in frame["sensors"]["list"]:
        if "mount_z_m" not in one:
            one |= {"mount_z_m": HEIGHT_M, "height_is_assumed": True}
    words = [word(one["name"]) for one in frame["sensors"]["list"]]
    if len({*words}) < len(words):
        raise Fault(BAD_DATA, f"{frame.place}: sensors: two would be {max(words, key=words.count)}; expected names that differ in ASCII letters or digits")


def identity(frame):
    """Frames of one name and one seed are a scene."""
    return frame["scene"], frame["seed"]


def scene_by_scene(found):
    """Pairs of a split and a frame, with the frames of a scene together, and the scenes in the order in which they begin. The frames
    of scenes that begin before another one has ended, as those of several egos do, wait in a file for their turn."""
    with tempfile.TemporaryFile() as file:
        now, waiting = None, {}  # the scene whose turn it is, and where the frames of the others lie
        for pair in found:
            now = now or identity(pair[1])
            if identity(pair[1]) != now:
                waiting.setdefault(identity(pair[1]), []).append(file.seek(0, os.SEEK_END))
                pickle.dump(pair, file)
                continue
            yield pair
            while pair[1].get("last") and (now := next(iter(waiting), None)):
                for place in waiting.pop(now):
                    file.seek(place)
                    pair = pickle.load(file)
                    yield pair
            now = None if pair[1].get("last") else now
        for place in itertools.chain.from_iterable(waiting.values()):
            file.seek(place)
            yield pickle.load(file)


def complete_frames(streams, heads):
    for split, place in streams:
        for frame in frames_in(place, heads):
            complete(frame)
            yield {"validation": "val"}.get(split, split), frame


class Scenes:
    """What is known of the scenes of a part, once their frames have been read."""

    def __init__(self):
        self.places = {}  # of the first frame of each scene
        self.spans_us = {}  # of each scene with scans: the time of its first scan, and of its last
        self.scans = Counter()  # of each radar
        self.now, self.number, self.time_s = None, 0, 0  # of the last frame
        self.fault = None  # code and text of what ended a survey of them

    def add(self, frame):
        """Takes a frame; refuses one that is not the next of its scene, and a scene that is there already."""
        last, self.now = self.now, identity(frame)
        is_next = self.number < frame["frame"] and self.time_s < frame["time_s"] if last == self.now else self.now not in self.places
        if not is_next:
            raise Fault(BAD_DATA, f"{frame.place}: frame {frame['frame']} of {frame['scene']} at {frame['time_s']:.15g} s; expected each scene "
                                  "once, with all of its frames in their order")
        self.number, self.time_s = frame["frame"], frame["time_s"]
        self.places.setdefault(self.now, frame.place)
        sensors = [one for one in frame["sensors"]["list"] if one.get("measured", True)]
        if sensors:
            self.scans.update([word(one["name"]).lower() for one in sensors])
            times_us = [round(1e6 * (frame["time_s"] - one.get("age_s", 0))) for one in sensors]
            first_us, last_us = self.spans_us.get(self.now, (min(times_us), max(times_us)))
            self.spans_us[self.now] = first_us, max(last_us, *times_us)

    @staticmethod
    def are_shared(parts):
        """Whether a scene has frames in several parts."""
        return sum(len(one.places) for one in parts) > len(set().union(*(one.places for one in parts)))

    @staticmethod
    def tell_of_empty(parts):
        """Says on stderr which scenes have no scan; refuses an export without any."""
        count = sum(len(one.places) for one in parts)
        empty = [(name, seed, place) for one in parts for (name, seed), place in one.places.items() if (name, seed) not in one.spans_us]
        if len(empty) == count:
            raise Fault(BAD_DATA, "the inputs have no frame in which a sensor has measured")
        if empty:
            print("{}: {} of {} scenes have no scan and are left out; the first is {} with seed {}, at {}".format(
                command_line.name(), len(empty), count, *empty[0]), file=sys.stderr)


def frames_of(streams, scenes, heads=False):
    """The frames of streams with their splits, scene by scene, those of a scene in their order. `scenes` gets to know each.
    heads: frames may have their sensors alone."""
    for split, frame in scene_by_scene(complete_frames(streams, heads)):
        scenes.add(frame)
        yield split, frame


def scans_of(frame):
    """Each sensor that has a scan in the frame, with its targets in the order of their points."""
    for one in frame["sensors"]["list"]:
        if one.get("measured", True):
            yield one, [target for target in frame["targets"] if target["sensor"] == one["name"]]


def boxes(frame, age_s):
    """The objects but the ego, so long before the frame's time, in the world."""
    x, y = frame.get("origin_x_m", 0), frame.get("origin_y_m", 0)
    for one in frame["objects"]:
        if one["id"] != frame["ego"]:
            one = glint.earlier(one, age_s)
            yield one | {"x_m": one["x_m"] + x, "y_m": one["y_m"] + y} if x or y else one


def visibility(frame, sensors):
    """The best level at which one of the sensors has each object in view."""
    levels = {}
    for one in frame.get("visibility", ()):
        if one["sensor"] in sensors and one.get("visibility") in LEVELS:
            levels[one["object"]] = max(levels.get(one["object"], 0), LEVELS[one["visibility"]])
    return levels


def number(value, digits=9):
    """Rounded, so that lines and tables give the same text; never -0."""
    return round(float(value), digits) + 0.0


@functools.lru_cache
def word(name):
    """FRONT_LEFT for front-left."""
    return "".join(c if c.isascii() and c.isalnum() else "_" for c in name).upper()


def line(value):
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":")) + "\n"
