"""Reads boxes and poses of sets in the layout of nuScenes, row by row: tables may be larger than memory."""
import array
import csv
import glob
import json
import math
import os
import re
import sys

import glint
from glint import command_line
from glint.progress import Progress
from glint.sets.plan import BAD_DATA, NO_INPUT, Fault

CHUNK, LONGEST_ROW = 1 << 20, 1 << 24  # characters
GAP_S = 1.5  # between boxes that tell each other's velocity
BLANKS, DECODER = re.compile(r"\s*"), json.JSONDecoder(parse_constant=glint.no_constant)
PLACE, TOKEN = glint.number(-1e9, 1e9), glint.NAME
VECTOR, TURN = ((lambda value, size=size: type(value) is list and len(value) == size and all(map(PLACE[0], value)), text)
                for size, text in ((3, "three numbers"), (4, "a quaternion w, x, y, z")))
SHAPES = {"scene": {"token": TOKEN, "name": TOKEN}, "category": {"token": TOKEN, "name": TOKEN},
          "sample": {"token": TOKEN, "scene_token": TOKEN, "timestamp": glint.WHOLE}, "instance": {"token": TOKEN, "category_token": TOKEN},
          "sample_data": {"sample_token": TOKEN, "ego_pose_token": TOKEN, "timestamp": glint.WHOLE},
          "ego_pose": {"token": TOKEN, "translation": VECTOR, "rotation": TURN},
          "sample_annotation": {"sample_token": TOKEN, "instance_token": TOKEN, "translation": VECTOR, "rotation": TURN, "size": VECTOR}}
HEADING = "track_id", "timestamp_us", "agent_type", "x", "y", "vx", "vy", "psi_rad", "length", "width", "height"


class Text:
    """A text of JSON that is read piece by piece."""

    def __init__(self, file):
        self.file, self.text, self.at = file, "", 0

    def more(self):
        piece = self.file.read(CHUNK)
        self.text, self.at = self.text[self.at:] + piece, 0
        return piece != ""

    def next(self):
        """The next character that is no blank; "" at the end."""
        self.at = BLANKS.match(self.text, self.at).end()
        while self.at == len(self.text) and self.more():
            self.at = BLANKS.match(self.text, self.at).end()
        return self.text[self.at:self.at + 1]

    def take(self, marks):
        found = self.next()
        if found == "" or found not in marks:
            raise ValueError(f"{found or 'the end'}; expected {' or '.join(marks)}")
        self.at += 1
        return found

    def value(self):
        self.next()
        while True:
            try:
                found, self.at = DECODER.raw_decode(self.text, self.at)
                return found
            except json.JSONDecodeError:
                if len(self.text) - self.at > LONGEST_ROW or not self.more():
                    raise


def rows_of(path, shape):
    """The rows of a table, which is an array of objects in JSON, one after another. What is none is refused with its number, from 1."""
    count = 0
    try:
        with open(path, encoding="utf-8") as file:
            text = Text(file)
            mark = text.take("[")
            while mark != "]" and (count or text.next() != "]"):
                count += 1
                row = text.value()
                if fault := glint.fault(row, shape):
                    raise Fault(BAD_DATA, f"{path}: row {count}{fault}")
                yield row
                mark = text.take(",]")
    except OSError as error:
        raise Fault(NO_INPUT, f"{path}: {error.strerror}; expected the tables of a set") from error
    except json.JSONDecodeError as error:
        raise Fault(BAD_DATA, f"{path}: row {count}: {error.msg}") from error
    except (ValueError, RecursionError) as error:
        raise Fault(BAD_DATA, f"{path}: row {count}: {error}") from error


def tables_of(folder):
    """The folder of a set's tables: it, or the only one in it."""
    found = [os.path.dirname(path) for path in (os.path.join(folder, "scene.json"), *glob.glob(os.path.join(glob.escape(folder), "*", "scene.json")))
             if os.path.isfile(path)]
    if len(found) != 1:
        raise Fault(NO_INPUT, f"{folder}: {', '.join(sorted(found)) or 'no scene.json'}; expected one folder of tables, as {folder}/v1.0-mini")
    return found[0]


BOXES = {"box": str, "object": str, "class": str}
EGOS = {"token": str, "object": str, "class": str, "rear_axle_x_m": float, "length_m": float, "width_m": float, "height_m": float}


def beside(tables, name, columns):
    """The rows of a table of glint's that scripts/export wrote beside those of the layout."""
    path = os.path.join(tables, "..", f"glint-{name}.csv")
    if not os.path.exists(path):
        return []
    try:
        with open(path, encoding="utf-8", newline="") as file:
            return [{column: kind(row[column]) for column, kind in columns.items()} for row in csv.DictReader(file, restval="")]
    except KeyError as error:
        raise Fault(BAD_DATA, f"{path}: no column {error}; expected {', '.join(columns)}") from error
    except (ValueError, csv.Error) as error:
        raise Fault(BAD_DATA, f"{path}: {error}") from error


def yaw_of(rotation):
    w, x, y, z = rotation
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def neighbours(at, times):
    """The first and the last of up to three times in a row, each at most GAP_S behind the one before. Time `at` is one of
    them, in the middle if it can be."""
    def follows(i):
        """Whether there is a time i, close behind the one before."""
        return 0 < i < len(times) and times[i] - times[i - 1] <= GAP_S
    if follows(at) and follows(at + 1):
        return at - 1, at + 1
    if follows(at + 1):
        return at, at + 1 + follows(at + 2)
    if follows(at):
        return at - 1 - follows(at - 1), at
    return at, at


def slope(at, values, times):
    """The derivative of the parabola through a value and its two neighbours in time, of the line if there is one neighbour, or 0."""
    low, high = neighbours(at, times)
    if low == high:
        return 0.0
    if high - low == 1:
        return (values[high] - values[low]) / (times[high] - times[low])
    before, after = ((values[i + 1] - values[i]) / (times[i + 1] - times[i]) for i in (low, low + 1))
    bend = (after - before) / (times[high] - times[low])
    return before + bend * (2 * times[at] - times[low] - times[low + 1])


class Source:
    """A set whose scenes become tables of traffic. What is kept of a box takes 56 bytes."""

    def __init__(self, folder, words, scenes):
        self.tables, self.words = tables_of(folder), words
        known = {row["token"]: row["name"] for row in self.rows("scene")}
        if unknown := {*scenes} - {*known.values()}:
            raise Fault(BAD_DATA, f"{self.tables}/scene.json: no scene {min(unknown)}; it has {', '.join(sorted(known.values())[:3])}, ...")
        self.scenes = {token: name for token, name in known.items() if not scenes or name in scenes}
        self.samples = {row["token"]: (row["scene_token"], row["timestamp"]) for row in self.rows("sample")}
        self.categories = {row["token"]: row["name"] for row in self.rows("category")}
        self.instances = {row["token"]: row["category_token"] for row in self.rows("instance")}
        self.named = {row["box"]: (row["object"], row["class"]) for row in beside(self.tables, "boxes", BOXES)}
        self.carriers = {row["token"]: row for row in beside(self.tables, "egos", EGOS)}
        self.tracks = {token: {} for token in self.scenes}  # of a scene by instance: time in us, x, y, yaw, length, width, height

    def rows(self, table):
        return rows_of(os.path.join(self.tables, table + ".json"), SHAPES[table])

    def found(self, table, row, key, of):
        """What a table has under the token that a row of another one names."""
        try:
            return of[row[key]]
        except KeyError:
            raise Fault(BAD_DATA, f"{self.tables}/{table}.json: {key} {row[key]!r}; expected a token of {key[:-6]}.json") from None

    def read(self):
        for read in Progress("tables").over((self.read_egos, self.read_boxes)):
            read()

    def read_egos(self):
        """The poses of key frames that are nearest in time to their sample's."""
        nearest = {}
        for row in self.rows("sample_data"):
            if row.get("is_key_frame") is not True:
                continue
            scene, at = self.found("sample_data", row, "sample_token", self.samples)
            if scene in self.scenes:
                one = abs(row["timestamp"] - at), row["timestamp"], row["ego_pose_token"]
                nearest[row["sample_token"]] = min(nearest.get(row["sample_token"], one), one)
        wanted = {}
        for sample, (_, at, pose) in nearest.items():
            wanted.setdefault(pose, []).append((self.samples[sample][0], at))
        for row in self.rows("ego_pose"):
            for scene, at in wanted.pop(row["token"], ()):
                box = self.carriers.get(scene, self.words["ego"])
                ahead, yaw = -box["rear_axle_x_m"], yaw_of(row["rotation"])
                x, y = (place + ahead * part for place, part in zip(row["translation"], (math.cos(yaw), math.sin(yaw))))
                self.keep(scene, "", at, (x, y, yaw, *(box[name] for name in ("length_m", "width_m", "height_m"))))
        if wanted:
            raise Fault(BAD_DATA, f"{self.tables}/sample_data.json: ego_pose_token {min(wanted)!r}; expected a token of ego_pose.json")

    def read_boxes(self):
        for row in self.rows("sample_annotation"):
            scene, at = self.found("sample_annotation", row, "sample_token", self.samples)
            if scene in self.scenes:
                self.found("sample_annotation", row, "instance_token", self.instances)
                (x, y, _), (width, length, height) = row["translation"], row["size"]
                self.keep(scene, row["instance_token"], at, (x, y, yaw_of(row["rotation"]), length, width, height))

    def keep(self, scene, instance, at, values):
        self.tracks[scene].setdefault(instance, array.array("d")).extend((at, *values))

    def label(self, scene, instance):
        """The id and the class of an instance, or of the ego: glint's own, if it wrote the set."""
        if not instance:
            box = self.carriers.get(scene, {"object": "ego", **self.words["ego"]})
            return box["object"], box["class"]
        if instance in self.named:
            return self.named[instance]
        category = self.found("instance", {"category_token": self.instances[instance]}, "category_token", self.categories)
        if category not in self.words["classes"]:
            raise Fault(BAD_DATA, f"{self.tables}/category.json: {category}; the layout has no class for it: name one in read.classes of a copy")
        return instance, self.words["classes"][category]

    def write(self, scene, file):
        """A table of traffic of a scene; the number of its boxes."""
        table, count = csv.writer(file, lineterminator="\n"), 0
        table.writerow(HEADING)
        for instance, values in self.tracks[scene].items():
            (name, kind), steps = self.label(scene, instance), sorted(zip(*[iter(values)] * 7))
            if again := next((int(one[0]) for one, other in zip(steps, steps[1:]) if one[0] == other[0]), None):
                raise Fault(BAD_DATA, f"{self.tables}: {instance or 'the ego'} is in two boxes at {again} us; expected one in a sample")
            times = [(step[0] - steps[0][0]) / 1e6 for step in steps]
            places = [[step[i] for step in steps] for i in (1, 2)]
            for i, (at, x, y, *shape) in enumerate(steps):
                velocity = [round(slope(i, of, times), 9) for of in places]
                table.writerow((name, int(at), kind, round(x, 9), round(y, 9), *velocity, *(round(one, 9) for one in shape)))
            count += len(steps)
        return count


def write(source, folder):
    """A table for each scene, under its name."""
    boxes, taken = 0, {}
    for scene, name in source.scenes.items():
        path = re.sub(r"[^\w.-]", "_", name, flags=re.ASCII) + ".csv"
        if path in taken:
            raise Fault(BAD_DATA, f"{source.tables}/scene.json: {name} and {taken[path]} would both be {path}; give one of them by --scene")
        taken[path] = name
        with open(os.path.join(folder, path), "x", encoding="utf-8", newline="") as file:
            boxes += source.write(scene, file)
    print(f"{command_line.name()}: {len(taken)} scenes, {boxes} boxes, the ego's among them", file=sys.stderr)
    if not source.carriers:
        ego = source.words["ego"]
        print(f"{command_line.name()}: the ego's box is assumed, as no table has it: {ego['class']}, {ego['length_m']} x {ego['width_m']} m, "
              f"its rear axle {-ego['rear_axle_x_m']} m behind the middle", file=sys.stderr)
