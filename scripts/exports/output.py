"""The folder of an export: its files, and beside them tables of what formats do not carry."""
import contextlib
import csv
import json
import os

TABLES = {"scans": ("path", "scene", "frame", "time_s", "sensor", "points"), "boxes": ("box", "scene", "object", "class"),
          "labels": ("path", "point", "object", "class", "reflector", "echo", "mirror", "number", "weight")}


def line(value):
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":")) + "\n"


class Output(contextlib.ExitStack):
    def __init__(self, folder):
        super().__init__()
        self.folder = folder
        self.scans, self.boxes, self.labels = (csv.writer(self.file(f"glint-{name}.csv"), lineterminator="\n") for name in TABLES)
        for table, heading in zip((self.scans, self.boxes, self.labels), TABLES.values()):
            table.writerow(heading)

    def file(self, path):
        """A new file of text, which is closed at the end."""
        os.makedirs(os.path.dirname(os.path.join(self.folder, path)), exist_ok=True)
        return self.enter_context(open(os.path.join(self.folder, path), "x", encoding="utf-8", newline=""))

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
