"""Reads what is exported, with all that formats need: frames of lines, of the tables of glint-tables, or of a set."""
import csv
import functools
import glob
import gzip
import itertools
import json
import math
import os
import zlib

import glint
import schema
from documents import data_folders
from plan import BAD_DATA, NO_INPUT, ROOT, Fault, read_json
from progress import Progress

HEIGHT_M = 0.5  # of a sensor whose document has none: usual for radars
LEVELS = "v0-40", "v40-60", "v60-80", "v80-100"
CELLS = {"frame_key", "scan_key", "detection_key", "seed", "time_s", "sensor", "measured_s", "detections"}  # are in all rows of tables that have them
# What formats need beyond glint.FRAME, and what gives it.
LENGTH, VALUE = glint.number(1e-3, 1e6), glint.number(-1e9, 1e9)
QUALITY = ("rcs_dbsm", "range_sd_m", "range_rate_sd_mps", "azimuth_sd_rad", "existence", "range_rate_over_ground_mps", "x_centre_m",
           "x_rear_axle_m")
NEEDED = {**dict.fromkeys(("scene", "seed", "frame", "time_s", "ego"), (lambda value: value is not None, "a value")),
          "objects": [{"class": glint.NAME, "length_m": LENGTH, "width_m": LENGTH, "height_m": LENGTH}],
          "sensors": {"suite": glint.NAME, "list": [{"field_of_view_rad": glint.number(1e-3, math.tau)}]},
          "targets": [{"quality": dict.fromkeys(QUALITY, VALUE), "contributors": [{"path": glint.NAME}]}],
          "visibility": [{"sensor": glint.NAME, "object": glint.NAME, "visibility": glint.NAME}]}
GIVEN_BY = {"quality": "give glint-ideal --sections quality", "objects:": "leave out --sections -objects",
            "targets:": "expected lists, as glint-noise writes them", "_m:": "glint-extract gives objects the sizes of their class"}


def rows(folder, name):
    """The rows of a table, without empty cells; each knows its place."""
    of, path = {"integer": int, "number": float, "boolean": "true".__eq__, "string": str}, os.path.join(folder, name + ".csv")
    types = {one["name"]: of[one["type"]] for one in read_json(os.path.join(ROOT, "schemas", "tables.json"))[name]["fields"]}
    place = path = path + ".gz" * (not os.path.exists(path))
    try:
        with (gzip.open if path.endswith(".gz") else open)(path, "rt", encoding="utf-8", newline="") as file:
            table = csv.DictReader(file, strict=True)
            if not table.fieldnames:
                raise ValueError("no heading")
            for cells in table:
                place = f"{path}:{table.line_num}"
                row = glint.Frame((key, types[key](cell)) for key, cell in cells.items() if cell)
                if None in cells.values() or CELLS & types.keys() - row.keys():
                    raise ValueError("cells are missing")
                row.place = place
                yield row
    except FileNotFoundError as error:
        raise Fault(NO_INPUT, f"{path}: no such table; expected all those of glint-tables: run it again if it was killed") from error
    except (AttributeError, EOFError, KeyError, TypeError, ValueError, csv.Error, gzip.BadGzipFile, zlib.error) as error:
        raise Fault(BAD_DATA, f"{place}: {error!r}; expected a table of glint-tables") from error


def by(key, folder, name):
    """Gives the rows of a table that have this key, which increases from call to call. Rows of other keys are refused."""
    groups = ((found, list(group)) for found, group in itertools.groupby(rows(folder, name), lambda row: row[key]))
    ahead = [next(groups, (math.inf, []))]

    def of(wanted):
        found, group = ahead[0]
        if found < wanted:
            raise Fault(BAD_DATA, f"{group[0].place}: {key} {found}; expected ascending keys, each of a row of {key[:-4]}s")
        if found > wanted:
            return []
        ahead[0] = next(groups, (math.inf, []))
        return group
    return of


def frames_of_tables(folder):
    objects, scans, targets = (by("frame_key", folder, name) for name in ("objects", "scans", "detections"))
    parts, sightings = by("detection_key", folder, "contributors"), by("scan_key", folder, "sightings")
    for row in rows(folder, "frames"):
        key = row["frame_key"]
        sensors = [one | {"name": one["sensor"], "age_s": round(row["time_s"] - one["measured_s"], 9)} for one in scans(key)]
        frame = glint.Frame(row, seed=str(row["seed"]), objects=objects(key), sensors={"suite": row.get("suite"), "list": sensors},
                            targets=targets(key), visibility=[seen for one in sensors for seen in sightings(one["scan_key"])])
        for one in frame["targets"]:
            one["quality"] = {name[8:]: value for name, value in one.items() if name.startswith("quality_")}
            one["contributors"] = parts(one["detection_key"])
        frame.place = row.place
        if fault := glint.fault(frame, glint.FRAME) or glint.unjoined(frame):
            raise Fault(BAD_DATA, f"{row.place}: {fault.lstrip('.')}")
        if (found := len(frame["targets"])) != (expected := sum(one["detections"] for one in sensors)):
            raise Fault(BAD_DATA, f"{row.place}: {found} rows of detections; expected {expected}, as scans say")
        yield frame
    for of in (objects, scans, targets, parts, sightings):
        of(math.inf)


def streams_of(path):
    """The streams of an input: split and documents of a set, or None, and frames. Shards of a set are read by their tables, or by
    their lines if they have none."""
    manifest, shards = os.path.join(path, "datapackage.json"), {(None, path)}
    if os.path.exists(manifest):
        shards = {(one["path"].split("/")[0], os.path.join(path, *one["path"].split(".")[0].split("/")[:3]))
                  for one in document(manifest, "set")["resources"]}
    for split, place in sorted(shards, key=str):
        place += ".jsonl.gz" * (split is not None and not glob.glob(os.path.join(glob.escape(place), "frames.csv*")))
        yield split, split and os.path.join(path, "documents"), frames_of_tables(place) if os.path.isdir(place) else glint.frames(place)


def document(path, kind):
    """A document of a kind of data/exports/schema.json."""
    found = read_json(path)
    if fault := schema.fault_of(found, read_json(os.path.join(ROOT, "data", "exports", "schema.json"))[kind]):
        raise Fault(BAD_DATA, f"{path}: {fault}")
    return found


@functools.lru_cache
def mounts(suite, folder, name):
    """The sensors of a suite by name, from its document: the given one, or the one of its name."""
    places = [suite] if suite else [os.path.join(one, "sensors", name + ".json") for one in ([folder] if folder else data_folders())]
    path = next(filter(os.path.isfile, places), None)
    if path is None:
        raise Fault(NO_INPUT, f"{' and '.join(places)}: no such file, and frames lack the heights of sensors; name their document by --suite")
    return path, {one["name"]: one for one in document(path, "suite")["sensors"]}


def complete(frame, suite, folder):
    """Refuses a frame that lacks what formats need; gives its sensors their heights."""
    if fault := glint.fault(frame, NEEDED, ("visibility",)):
        raise Fault(BAD_DATA, "; ".join([f"{frame.place}: {fault[1:]}", *(hint for name, hint in GIVEN_BY.items() if name in fault)]))
    path, sensors = mounts(suite, folder, frame["sensors"]["suite"])
    for one in frame["sensors"]["list"]:
        mount = sensors.get(one["name"], {})
        if any(mount.get(key) != one[key] for key in ("mount_x_m", "mount_y_m", "mount_yaw_rad")):
            raise Fault(BAD_DATA, f"{frame.place}: sensor {one['name']}: {path} has no such sensor at this place")
        one["mount_z_m"] = mount.get("mount_z_m", HEIGHT_M)
    words = [word(one["name"]) for one in frame["sensors"]["list"]]
    if len({*words}) < len(words):
        raise Fault(BAD_DATA, f"{frame.place}: sensors: two would be {max(words, key=words.count)}; expected names that differ in ASCII letters or digits")


def frames_of(streams, suite):
    """The frames of streams with their splits: those of a scene together and in order."""
    seen, before, measured = set(), (None, 0, 0), False
    for split, folder, frames in Progress("streams").over(streams):
        for frame in frames:
            complete(frame, suite, folder)
            measured = measured or any(scans_of(frame))
            now = frame["scene"], frame["frame"], frame["time_s"]
            if now[0] in seen if now[0] != before[0] else now[1] <= before[1] or now[2] <= before[2]:
                raise Fault(BAD_DATA, f"{frame.place}: frame {now[1]} of {now[0]} at {now[2]} s; expected each scene once, with all of its "
                                      "frames in their order")
            seen.add(now[0])
            before = now
            yield {"validation": "val"}.get(split, split), frame
    if not measured:
        raise Fault(BAD_DATA, "the inputs have no frame in which a sensor has measured")


def scans_of(frame):
    """Each sensor that has a scan in the frame, with its targets in the order of their points."""
    for one in frame["sensors"]["list"]:
        if one.get("measured", True):
            yield one, [target for target in frame["targets"] if target["sensor"] == one["name"]]


def boxes(frame, age_s):
    """The objects but the ego, so long before the frame's time, in the world."""
    for one in frame["objects"]:
        if one["id"] != frame["ego"]:
            one = glint.earlier(one, age_s)
            yield one | {"x_m": one["x_m"] + frame.get("origin_x_m", 0), "y_m": one["y_m"] + frame.get("origin_y_m", 0)}


def visibility(frame, sensors):
    """The best level at which one of the sensors has each object in view."""
    levels = {}
    for one in frame.get("visibility", ()):
        if one["sensor"] in sensors and one.get("visibility") in LEVELS:
            levels[one["object"]] = max(levels.get(one["object"], 0), LEVELS.index(one["visibility"]))
    return levels


def number(value, digits=9):
    """Rounded, so that lines and tables give the same text; never -0."""
    return round(float(value), digits) + 0.0


def word(name):
    """FRONT_LEFT for front-left."""
    return "".join(c if c.isascii() and c.isalnum() else "_" for c in name).upper()


def line(value):
    return json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":")) + "\n"
