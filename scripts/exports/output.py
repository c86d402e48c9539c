"""A folder of files that gets its name when all is there, with the labels that formats do not carry."""
import contextlib
import csv
import json
import os

from durable import remove_temporaries, temporary_folder
from plan import CANNOT_CREATE, Fault

TABLES = {"scans": ("path", "scene", "frame", "time_s", "sensor", "points"), "boxes": ("box", "scene", "object", "class"),
          "labels": ("path", "point", "object", "class", "reflector", "echo", "mirror", "number", "weight")}


def line(value):
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":")) + "\n"


class Output:
    """Writes files below a folder, and beside them tables: of scans, of the objects in boxes, and of the labels of points."""

    def __init__(self, folder):
        self.folder = folder
        self.files = [open(os.path.join(folder, f"glint-{name}.csv"), "w", encoding="utf-8", newline="") for name in TABLES]
        self.scans, self.boxes, self.labels = (csv.writer(file, lineterminator="\n") for file in self.files)
        for table, heading in zip((self.scans, self.boxes, self.labels), TABLES.values()):
            table.writerow(heading)

    def write(self, path, data):
        os.makedirs(os.path.dirname(os.path.join(self.folder, path)), exist_ok=True)
        with open(os.path.join(self.folder, path), "xb") as file:
            file.write(data if isinstance(data, bytes) else data.encode())

    def scan(self, path, data, frame, sensor, targets):
        """Writes the points of a scan, with their labels: a row for each contributor of each target."""
        self.write(path, data)
        self.scans.writerow((path, frame["scene"], frame["frame"], float(frame["time_s"]), sensor["name"], len(targets)))
        classes = {one["id"]: one["class"] for one in frame["objects"]}
        self.labels.writerows((path, i, one["object"], classes.get(one["object"]), one["reflector"], one["path"], one.get("mirror"),
                               one.get("number"), float(one["weight"])) for i, target in enumerate(targets) for one in target["contributors"])

@contextlib.contextmanager
def whole_folder(path):
    """An Output whose folder gets its name when the block ends well, and vanishes when it does not."""
    if os.path.lexists(path):
        raise Fault(CANNOT_CREATE, f"{path}: is there already; name a new folder")
    above = os.path.dirname(os.path.abspath(path))
    remove_temporaries(above)
    with temporary_folder(path, above) as folder:
        output = Output(folder)
        yield output
        for file in output.files:
            file.close()
        os.rename(folder, path)
