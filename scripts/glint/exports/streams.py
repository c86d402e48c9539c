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

import glint
from glint import command_line
from glint.exports.arrays import NotWhole, frames_of_arrays
from glint.exports.whole import checked
from glint.places import DATA, SCHEMAS
from glint.progress import Progress
from glint.sets import schema
from glint.sets.plan import BAD_DATA, NO_INPUT, Fault, read_json
from glint.sets.tables import opened

HEIGHT_M = 0.5  # of a sensor that has none: usual for radars
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
        sensors = [one | {"name": one["sensor"], "age_s": round(row["time_s"] - one["measured_s"], 9)} for one in of_sensors]
        known = {name: value for name, value in row.items() if name not in COUNTED}
        frame = glint.Frame(known, version=glint.VERSION, seed=str(row["seed"]), objects=bodies, sensors={"suite": row.get("suite"), "list": sensors},
                            targets=found, visibility=seen)
        frame.place = row.place
        yield checked(frame)
    for table in tables:
        table.end()


def frames_of_lines(path):
    """Frames by their arrays, and from the first one on that is not whole there by their lines."""
    number = 0
    with contextlib.suppress(NotWhole, FileNotFoundError):
        if not os.path.isfile(path):  # a pipe is read once
            raise NotWhole
        for frame in frames_of_arrays(path):
            yield frame
            number += 1
        return
    yield from map(checked, itertools.islice(glint.frames(path, check=False), number, None))


def place_of(shard, are_whole):
    """The lines of a shard where they are whole, as those are read in a third of the time; else its tables."""
    lines, tables = glob.glob(glob.escape(shard) + ".jsonl.*"), glob.glob(os.path.join(glob.escape(shard), "frames.csv*"))
    return shard if tables and not (lines and are_whole) else next(iter(lines), shard + ".jsonl.gz")


def streams_of(path):
    """The streams of an input: split of a set, or None, and frames."""
    manifest, places = os.path.join(path, "datapackage.json"), [(None, path)]
    if os.path.exists(manifest):
        found = document(manifest, "set")
        shards = {(one["path"].split("/")[0], os.path.join(path, *one["path"].split(".")[0].split("/")[:3])) for one in found["resources"]}
        are_whole = found.get("plan", {}).get("lines", "whole") == "whole"
        places = [(split, place_of(shard, are_whole)) for split, shard in sorted(shards)]
    for split, place in places:
        yield split, frames_of_tables(place) if os.path.isdir(place) else frames_of_lines(place)


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


def complete_frames(streams):
    for split, frames in Progress("streams").over(streams):
        for frame in frames:
            complete(frame)
            yield {"validation": "val"}.get(split, split), frame


def frames_of(streams):
    """The frames of streams with their splits, scene by scene, those of a scene in their order. Says on stderr which scenes have no scan."""
    seen, before = {}, (None, 0, 0)  # of each scene: its first frame's place, or None as soon as a sensor has measured
    for split, frame in scene_by_scene(complete_frames(streams)):
        now = identity(frame), frame["frame"], frame["time_s"]
        if now[0] in seen if now[0] != before[0] else now[1] <= before[1] or now[2] <= before[2]:
            raise Fault(BAD_DATA, f"{frame.place}: frame {now[1]} of {now[0][0]} at {now[2]:.15g} s; expected each scene once, with all of its "
                                  "frames in their order")
        place = seen.setdefault(now[0], frame.place)
        if place and any(scans_of(frame)):
            seen[now[0]] = None
        before = now
        yield split, frame
    without = [(name, seed, place) for (name, seed), place in seen.items() if place]
    if len(without) == len(seen):
        raise Fault(BAD_DATA, "the inputs have no frame in which a sensor has measured")
    if without:
        print("{}: {} of {} scenes have no scan and are left out; the first is {} with seed {}, at {}".format(
            command_line.name(), len(without), len(seen), *without[0]), file=sys.stderr)


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
