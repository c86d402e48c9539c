"""Reads what formats need of a file of frames from the arrays of glint-tables, without a line of JSON in Python."""
import itertools
import json
import math
import os
import re
import struct
import subprocess
import tempfile

import glint
from glint.exports.whole import NEEDED, sensor_of
from glint.places import BIN

FRAMES_AT_ONCE = 256
CODES = {"<i8": "q", "<f8": "d", "<u8": "Q", "|b1": "?", "|V7": "7x"}  # of the kinds of columns, in Python's struct; Q is the place of a name
IS_THERE = {"q": lambda value: value != -1, "d": lambda value: value == value, "Q": lambda value: value != ""}
ANY = lambda value: True, "a value"
COUNTS = dict.fromkeys(("objects", "scans", "detections", "contributors", "sightings"), ANY)  # of the rows that belong to a frame
SENSOR, TARGET = NEEDED["sensors"]["list"][0], NEEDED["targets"][0]
# The columns of each table by the shape of their values, as in glint.FRAME.
HEAD = {name: glint.FRAME[name] for name in ("scene", "seed", "frame", "time_s", "ego", "origin_x_m", "origin_y_m")} | COUNTS | {
    "last": ANY, "suite": NEEDED["sensors"]["suite"]}
BODY = glint.OBJECT | NEEDED["objects"][0]
SCAN = {name: test for name, test in (glint.SENSOR | SENSOR).items() if name not in ("name", "age_s")} | {
    "sensor": glint.NAME, "measured_s": ANY, "detections": ANY}
DETECTION = {name: test for name, test in glint.TARGET.items() if name not in ("quality", "contributors")} | {"contributors": ANY}
QUALITY = TARGET["quality"] | {"range_rate_interval_mps": ANY, "ambiguity_number": ANY}
PART = glint.TARGET["contributors"][0] | TARGET["contributors"][0] | {"mirror": ANY, "number": ANY}
SIGHTING = NEEDED["visibility"][0]
TABLES = {"frames": HEAD, "objects": BODY, "scans": SCAN, "detections": DETECTION, "quality": QUALITY, "contributors": PART, "sightings": SIGHTING}
PART_OF = {"quality": "detections"}  # its columns begin with quality_ there
OPTIONAL = {"origin_x_m", "origin_y_m", "mount_z_m", "elevation_rad", "range_rate_interval_mps", "mirror", "number", "visibility"}


class NotWhole(ValueError):
    """Frames lack something that formats need: the lines tell what, and where."""


class Table:
    """The rows of a table as dictionaries of the columns that a shape names."""

    def __init__(self, folder, name, names, shape):
        begin = name + "_" if name in PART_OF else ""
        self.file, self.names = open(os.path.join(folder, PART_OF.get(name, name) + ".npy"), "rb"), names
        head = self.file.read(struct.unpack("<8xH", self.file.read(10))[0]).decode()
        columns = [(name, CODES[kind]) for name, kind in re.findall(r"\('(\w*)', '(.\w+)'\)", head)]
        wanted = {begin + name: name for name in shape}
        self.row = struct.Struct("<" + "".join(code if name in wanted else f"{struct.calcsize(code)}x" for name, code in columns))
        self.columns = [(wanted[name], code, shape[wanted[name]][0]) for name, code in columns if name in wanted]

    def take(self, count):
        """The next rows, without the optional members that they lack."""
        read, lacking = {}, {}
        for (name, code, test), values in zip(self.columns, zip(*self.row.iter_unpack(self.file.read(count * self.row.size)))):
            distinct = values
            if code == "Q":
                distinct = [*map(self.names.__getitem__, {*values})]
                values = [*map(self.names.__getitem__, values)]
            there = [*filter(IS_THERE[code], distinct)] if name in OPTIONAL else distinct
            if there:
                if not (test(min(there)) and test(max(there)) and (code != "d" or math.isfinite(sum(there)))):
                    raise NotWhole
                read[name] = values
                if len(there) < len(distinct):
                    lacking[name] = IS_THERE[code]
        rows = [dict(zip(read, row)) for row in zip(*read.values())]
        for name, is_there in lacking.items():
            for row in rows:
                if not is_there(row[name]):
                    del row[name]
        return rows


def tables_of(path):
    """The tables of a file of frames, as open files; their folder is removed."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([os.path.join(BIN, "glint-tables"), "--npy", folder, path], stderr=subprocess.DEVNULL, check=False)
        if done.returncode != 0:
            raise NotWhole
        with open(os.path.join(folder, "names.json"), encoding="utf-8") as file:
            names = json.load(file)
        return {name: Table(folder, name, names, shape) for name, shape in TABLES.items()}


def join(head, bodies, targets, parts, sightings):
    """Takes what else belongs to a frame, and puts it where its line has it."""
    head["objects"], head["visibility"] = ([*itertools.islice(rows, head[name])] for name, rows in (("objects", bodies), ("sightings", sightings)))
    found = [*itertools.islice(targets, head["detections"])]
    if head["ego"] not in [one["id"] for one in head["objects"]] or sum(one["detections"] for one in head["sensors"]["list"]) != len(found):
        raise NotWhole
    for one in found:
        one["contributors"] = [*itertools.islice(parts, one["contributors"])]
    head["targets"] = found


def heads_of(path, tables):
    """Frames with their sensors alone, many at once; tables: of the file `path`."""
    heads, scans = tables["frames"], tables["scans"]
    numbers = itertools.count(1)
    while found := [glint.Frame(head) for head in heads.take(FRAMES_AT_ONCE)]:
        rows = iter(scans.take(sum(head["scans"] for head in found)))
        for head in found:
            head.place = f"{path}:{next(numbers)}"
            listed = [sensor_of(one, head["time_s"]) for one in itertools.islice(rows, head["scans"])]
            head["sensors"] = {"suite": head["suite"], "list": listed}
        yield found


def heads_of_arrays(path):
    """Frames as their lines would give them, but with their sensors alone."""
    return itertools.chain.from_iterable(heads_of(path, tables_of(path)))


def frames_of_arrays(path):
    """Frames as their lines would give them, but for what no format needs."""
    tables = tables_of(path)
    for found in heads_of(path, tables):
        total = {name: sum(head[name] for head in found) for name in COUNTS}
        targets = tables["detections"].take(total["detections"])
        for one, quality in zip(targets, tables["quality"].take(len(targets))):
            if "range_rate_interval_mps" not in quality:
                del quality["ambiguity_number"]
            one["quality"] = quality
        bodies, parts, sightings = (iter(tables[name].take(total[name])) for name in ("objects", "contributors", "sightings"))
        targets = iter(targets)
        for head in found:
            join(head, bodies, targets, parts, sightings)
            yield head
