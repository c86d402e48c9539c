"""The folder of an export. Parts of an export, each in a process of its own, write the files of their scans into it, and a file
of rows for each table; tables are joined when all parts are there."""
import contextlib
import csv
import os
import shutil
from collections import Counter

import glint
from glint.exports.streams import identity

FLAT = "z is 0 in {} of {} points: their radars measure no elevation"
TABLES = {"scans": ("path", "scene", "seed", "frame", "time_s", "sensor", "points"), "boxes": ("box", "scene", "seed", "object", "class"),
          "labels": ("path", "point", "object", "class", "reflector", "echo", "mirror", "number", "weight")}


class Folder:
    def __init__(self, path):
        self.path, self.made = path, set()

    def place(self, path):
        """Where a file goes; its folder is made."""
        above = path.rpartition("/")[0]
        if above not in self.made:
            os.makedirs(os.path.join(self.path, above), exist_ok=True)
            self.made.add(above)
        return f"{self.path}/{path}"

    def write(self, path, data):
        """A new file of text or bytes. Exports have thousands of small ones, for which objects of files are half of the cost."""
        data = data if isinstance(data, bytes) else data.encode()
        file = os.open(self.place(path), os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o666)
        try:
            while data:
                data = data[os.write(file, data):]
        finally:
            os.close(file)

    def join(self, path, parts, head="", rows="", between="", foot=""):
        """Writes a table: head, rows that no part has, the rows of the parts, and foot; `between` stands between rows that are not empty.
        The files of the parts are removed."""
        pieces = [f"{self.place(path)}.{part}" for part in range(parts)]
        with open(self.place(path), "xb") as whole:
            whole.write((head + rows).encode())
            for i, piece in enumerate(filter(os.path.getsize, pieces)):
                whole.write(between.encode() if rows or i > 0 else b"")
                with open(piece, "rb") as file:
                    shutil.copyfileobj(file, whole)
            whole.write(foot.encode())
        for piece in pieces:
            os.remove(piece)


class Part(Folder, contextlib.ExitStack):
    """What one part of an export writes, and what it has to say."""

    def __init__(self, path, number):
        Folder.__init__(self, path)
        contextlib.ExitStack.__init__(self)
        self.number = number
        self.notes, self.assumed, self.lacking, self.counted = {}, {}, Counter(), Counter()  # dictionaries, as their keys have an order
        self.frame, self.classes = None, {}  # the newest frame, and the class of each of its objects
        self.scans, self.boxes, self.labels = (csv.writer(self.rows(f"glint-{name}.csv"), lineterminator="\n") for name in TABLES)

    def rows(self, path):
        """The file of this part's rows of a table, which is closed at the end."""
        return self.enter_context(open(self.place(f"{path}.{self.number}"), "x", encoding="utf-8", newline=""))

    def note(self, text):
        """Says on stderr, once and when all is written, what users of the layout must know of it."""
        self.notes[text] = None

    def count(self, text, lacking, whole):
        """Counts values that stand for something unknown, for a note whose `{} of {}` are how many of them and of how many in all."""
        self.lacking[text] += lacking
        self.counted[text] += whole

    def scan(self, path, data, frame, sensor, targets):
        """Writes the points of a scan, with their labels: a row for each contributor of each target."""
        self.write(path, data)
        self.count(FLAT, ["elevation_rad" in target for target in targets].count(False), len(targets))
        if "height_is_assumed" in sensor:
            self.assumed[sensor["name"]] = None
        self.scans.writerow((path, *identity(frame), frame["frame"], float(frame["time_s"]), sensor["name"], len(targets)))
        if frame is not self.frame:
            self.frame, self.classes = frame, {one["id"]: one["class"] for one in frame["objects"]}
        self.labels.writerows([(path, i, one["object"], self.classes.get(glint.owner(one)), one["reflector"], one["path"], one.get("mirror"),
                                one.get("number"), float(one["weight"])) for i, target in enumerate(targets) for one in target["contributors"]])
