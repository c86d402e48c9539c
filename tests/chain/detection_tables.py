"""glint-tables against the frames that they read.

Usage: python3 tests/chain/detection_tables.py BIN_DIR        exit status 1 if any check fails

Rows are made here from the JSON lines, member by member, and must be those of the tables: the same names, the same
numbers, in the same order. The arrays of --npy have the cells of the tables. Sensor poses are integrated here along the ego's path. The keys that tables.json names
tell rows apart, and each of them finds the row that it joins.
"""
import ast
import csv
import gzip
import json
import math
import os
import struct
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(ROOT, "scripts"))
import glint  # noqa: E402

TABLES = ["detections", "objects", "scans", "contributors", "sightings", "lost", "frames"]
AWKWARD = 'with "quotes", commas and\u00a0blanks '
CHAIN = "glint-extract | glint-ideal --sensors {} | glint-sensor | glint-noise"
STREAMS = [
    f"glint-traffic side-crossing --scene '{AWKWARD}' | " + CHAIN.format("srr24-pair"),
    "glint-traffic walled-road | " + CHAIN.format("radarscenes77-full --sections account,margins,quality,visibility"),
    "glint-traffic gravel --conditions '{\"rain_mmph\": 10}' | " + CHAIN.format("lrr77-full --sections account,visibility"),
    "glint-traffic-random --frames 20 --density dense | " + CHAIN.format("corner77-uncompensated --sections account"),
]
# Members that stand elsewhere in a row or say the same for every row, and those that no column shows.
OF_SCAN = {"name", "measured", "age_s"}
COUNTS = ("reflectors", "in_range", "in_view", "blocked_share", "detections", "merged", "ghosts")
OF_LABEL = ["object", "reflector", "path", "mirror", "number", "weight"]
faults = []


def check(good, text):
    if not good:
        faults.append(text)


def run(text, bin_dir, data=None):
    environment = dict(os.environ, PATH=bin_dir + os.pathsep + os.environ["PATH"], GLINT_DATA=ROOT + "/data")
    done = subprocess.run(["bash", "-o", "pipefail", "-c", text], env=environment, cwd=ROOT, input=data,
                          capture_output=True, check=False)
    if done.returncode != 0:
        sys.exit(f"tables: {text}: {done.stderr.decode()}")
    return done.stdout


def read(path):
    with (gzip.open if path.endswith(".gz") else open)(path, "rt", newline="") as file:
        return list(csv.DictReader(file, strict=True))


ABSENT = {"<f8": math.isnan, "<i8": lambda cell: cell == -1, "<u8": lambda cell: cell == 0}
AS_TEXT = {"<f8": float, "<i8": int}


def read_array(path):
    """The columns of a .npy file with their types, and its rows."""
    with open(path, "rb") as file:
        magic, length = struct.unpack("<8sH", file.read(10))
        head = ast.literal_eval(file.read(length).decode("ascii"))
        check(magic == b"\x93NUMPY\1\0" and (10 + length) % 64 == 0 and not head["fortran_order"], f"{path}: {magic} {length}")
        kinds = {"<f8": "d", "<i8": "q", "<u8": "Q", "|b1": "?", "|V7": "7x"}
        rows = list(struct.iter_unpack("<" + "".join(kinds[kind] for _, kind in head["descr"]), file.read()))
    check((len(rows),) == head["shape"], f"{path}: {len(rows)} rows, told {head['shape']}")
    return {name: kind for name, kind in head["descr"] if name}, rows


def same_cell(cell, text, kind, names):
    if kind == "|b1":
        return cell == (text == "true")
    if text == "":
        return ABSENT[kind](cell)
    return names[cell] == text if kind == "<u8" else cell == AS_TEXT[kind](text)


def check_arrays(folder, frames, tables, bin_dir, stream):
    run(f"glint-tables --npy {folder}/arrays", bin_dir, frames)
    with open(f"{folder}/arrays/names.json", encoding="utf-8") as file:
        names = json.load(file)
    check(names[0] == "" and len(set(names)) == len(names), f"{stream}: names.json has a name twice, or its first one is not empty")
    for table, rows in tables.items():
        kinds, cells = read_array(f"{folder}/arrays/{table}.npy")
        check(len(cells) == len(rows), f"{stream}: the array {table} has {len(cells)} rows, expected {len(rows)}")
        for row, found in zip(rows, cells):
            wrong = [name for (name, kind), cell in zip(kinds.items(), found) if not same_cell(cell, row[name], kind, names)]
            check(not wrong and list(kinds) == list(row), f"{stream}: the array {table} differs in {wrong}: {row}")


def values(record, without=()):
    """The members of a JSON object that are single values, by the names of their columns."""
    found = {}
    for key, value in record.items():
        if isinstance(value, dict):
            found.update({f"{key}_{name}": one for name, one in values(value).items()})
        elif key == "effects":
            found[key] = " ".join(value)
        elif not isinstance(value, list) and key not in without:
            found[key] = value
    return found


def pose(frame, sensor):
    """Place, boresight and velocity of a sensor age_s ago, as the ego drives a circle at constant speed."""
    ego = next(one for one in frame["objects"] if one["id"] == frame["ego"])
    steps, age, turn = 64, sensor.get("age_s", 0), ego["yaw_rate_radps"]
    speed, course = math.hypot(ego["vx_mps"], ego["vy_mps"]), math.atan2(ego["vy_mps"], ego["vx_mps"])
    x, y = ego["x_m"], ego["y_m"]
    for step in range(steps):  # Simpson's rule on each step
        for share, weight in ((0, 1), (0.5, 4), (1, 1)):
            at = course - turn * age * (step + share) / steps
            x -= speed * math.cos(at) * age / steps * weight / 6
            y -= speed * math.sin(at) * age / steps * weight / 6
    yaw, course = ego["yaw_rad"] - turn * age, course - turn * age
    dx = math.cos(yaw) * sensor["mount_x_m"] - math.sin(yaw) * sensor["mount_y_m"]
    dy = math.sin(yaw) * sensor["mount_x_m"] + math.cos(yaw) * sensor["mount_y_m"]
    return {"sensor_x_m": x + dx, "sensor_y_m": y + dy, "sensor_yaw_rad": yaw + sensor["mount_yaw_rad"],
            "sensor_vx_mps": speed * math.cos(course) - turn * dy, "sensor_vy_mps": speed * math.sin(course) + turn * dx}


def ghost_label(path, kind):
    """The label of the Radar Ghost data set: class, main object, bounce type and order."""
    digit = {"pedestrian": 1, "bicycle": 2, "car": 3, "van": 3, "truck": 4, "articulated_truck": 4, "bus": 4,
             "motorcycle": 5}.get(kind, 0)
    bounces = {"wall_object": 12, "object_wall": 22, "wall_object_wall": 24}.get(path, 11)
    if path == "false_alarm":
        return -2
    return 0 if path == "clutter" or digit == 0 else 1000 * digit + 100 + bounces


def merged(target):
    """Flags of a quality that is there are false where the line lacks them."""
    flags = ("merged_objects", "merged_reflectors")
    return {f"quality_{flag}": target["quality"].get(flag, False) for flag in flags} if "quality" in target else {}


def expected(frames, first=0):
    """The rows of all tables."""
    rows = {table: [] for table in TABLES}
    for number, frame in enumerate(frames):
        when = {key: frame[key] for key in ("scene", "frame", "time_s")}
        keys, before = {}, {table: len(found) for table, found in rows.items()}
        for one in frame["objects"]:
            keys[one["id"]] = first + len(rows["objects"])
            rows["objects"].append({"object_key": keys[one["id"]], "frame_key": first + number, **when, **values(one)})
        classes = {one["id"]: one["class"] for one in frame["objects"]}
        whole = {"seed": frame["seed"], "interval_s": frame["interval_s"], "last": frame.get("last", False),
                 "ego": frame["ego"], "origin_x_m": frame.get("origin_x_m", 0), "origin_y_m": frame.get("origin_y_m", 0),
                 "suite": frame["sensors"]["suite"]}
        for sensor in frame["sensors"]["list"]:
            here, name = pose(frame, sensor), sensor["name"]
            targets = [one for one in frame["targets"] if one["sensor"] == name]
            scan = first + len(rows["scans"])
            if sensor["measured"]:
                rows["scans"].append({
                    "scan_key": scan, "frame_key": first + number, **when, **whole, "sensor": name,
                    "measured_s": frame["time_s"] - sensor.get("age_s", 0), "detections": len(targets), **here,
                    **values(sensor, OF_SCAN)})
            for place, target in enumerate(targets):
                key = first + len(rows["detections"])
                best = max(target["contributors"], key=lambda part: part["weight"])
                label = {column: best.get(column, "") for column in OF_LABEL}
                rows["detections"].append({
                    "detection_key": key, "scan_key": scan, "frame_key": first + number, "detection": place, **when, **values(target),
                    "sign_undecided": target.get("sign_undecided", False), **merged(target), "object_key": keys.get(best["object"], ""),
                    "class": classes.get(best["object"], ""), "contributors": len(target["contributors"]),
                    "radar_ghost_label": ghost_label(best["path"], classes.get(best["object"])), **label, **here})
                rows["contributors"] += [
                    {"detection_key": key, "contributor": index, "object_key": keys.get(part["object"], ""),
                     **values(part)} for index, part in enumerate(target["contributors"])]
            rows["sightings"] += [{"scan_key": scan, "object_key": keys[one["object"]], **dict.fromkeys(COUNTS, 0), **one}
                                  for one in frame.get("visibility", []) if one["sensor"] == name]
            rows["lost"] += [{"scan_key": scan, "object_key": keys.get(echo["object"], ""), **values(group),
                              **values(echo)}
                             for group in frame.get("lost", []) if group["sensor"] == name for echo in group["echoes"]]
        counts = {table: len(found) - before[table] for table, found in rows.items() if table != "frames"}
        rows["frames"].append({"frame_key": first + number, **when, **whole, **counts})
    return rows


def same(column, cell, value):
    if isinstance(value, bool):
        return cell == str(value).lower()
    if not isinstance(value, (int, float)) or cell == "":
        return cell == value
    if column.startswith("sensor_"):
        return abs(float(cell) - value) <= 1e-9
    return float(cell) == value


def compare(table, rows, wanted, columns, stream):
    check(len(rows) == len(wanted), f"{stream}: {table} has {len(rows)} rows, expected {len(wanted)}")
    for row, want in zip(rows, wanted):
        unknown = want.keys() - set(columns)
        check(not unknown, f"{stream}: {table} has no column {unknown}")
        wrong = {column: (row[column], want.get(column, "")) for column in columns
                 if not same(column, row[column], want.get(column, ""))}
        check(not wrong, f"{stream}: {table}: {wrong}")
        if faults:
            return


def check_keys(tables, schema, stream):
    """Keys as tables.json says: none of a table's primary keys comes twice or is empty, and each other one finds its row."""
    found = {table: {column: {row[column] for row in rows} for column in rows[0]} if rows else {}
             for table, rows in tables.items()}
    for table, rows in tables.items():
        primary = schema[table].get("primaryKey", [])
        primary = [primary] if isinstance(primary, str) else primary
        keys = {tuple(row[column] for column in primary) for row in rows}
        check(not primary or len(keys) == len(rows), f"{stream}: rows of {table} share a primary key")
        check(not primary or not any("" in key for key in keys), f"{stream}: a primary key of {table} is empty")
        joins = {key["fields"]: key["reference"] for key in schema[table].get("foreignKeys", [])}
        named = {*primary, *joins}
        for column in (field["name"] for field in schema[table]["fields"] if field["name"].endswith("_key")):
            check(column in named, f"tables.json does not say what {table}.{column} joins")
        for column, reference in joins.items():
            home = schema[reference["resource"]].get("primaryKey")
            check(reference["fields"] == column == home, f"tables.json: {table}.{column} joins {reference}")
            there = found[reference["resource"]].get(reference["fields"], set()) | {""}
            check(found[table].get(column, set()) <= there, f"{stream}: {table}.{column} finds no row of {reference['resource']}")


def check_choices(rows, fields, table):
    """Words are among those that tables.json lists."""
    for field in fields:
        words = {row[field["name"]] for row in rows} - {""}
        allowed = field.get("constraints", {}).get("enum", words)
        check(words <= set(allowed), f"{table}.{field['name']} has {words - set(allowed)}")


def check_stream(stream, schema, bin_dir, seen):
    frames = run(stream, bin_dir)
    wanted = expected([glint.name_lost(json.loads(line)) for line in frames.splitlines()])
    with tempfile.TemporaryDirectory() as folder:
        run(f"glint-tables {folder}", bin_dir, frames)
        tables = {table: read(f"{folder}/{table}.csv.gz") for table in TABLES}
        check_keys(tables, schema, stream)
        check_arrays(folder, frames, tables, bin_dir, stream)
        for table, rows in tables.items():
            check_choices(rows, schema[table]["fields"], table)
            columns = [field["name"] for field in schema[table]["fields"]]
            check(not rows or list(rows[0]) == columns, f"{stream}: the columns of {table} are not those of tables.json")
            compare(table, rows, wanted[table], columns, stream)
            seen[table] += len(rows)
            for row in rows:
                seen["empty scans"] += row.get("detections") == "0"
                seen["labels"].add(row.get("radar_ghost_label"))


def check_ways(bin_dir):
    """The same bytes fused and piped, packed in both ways and plain; and keys of parts that differ by 1e9."""
    stream = STREAMS[0]
    with tempfile.TemporaryDirectory() as folder:
        os.makedirs(f"{folder}/plain")
        run(f"{stream} | glint-tables {folder}", bin_dir)
        run(f"{stream} | glint-tables --zstd {folder}/zstd", bin_dir)
        quoted = stream.replace("'", "'\\''")
        run(f"glint -c '{quoted} | glint-tables --plain {folder}/plain'", bin_dir)
        for table in TABLES:
            with gzip.open(f"{folder}/{table}.csv.gz") as packed, open(f"{folder}/plain/{table}.csv", "rb") as plain:
                content = plain.read()
                check(packed.read() == content, f"{table}.csv has other bytes in one process")
            by_zstd = subprocess.run(["zstd", "-dcq", f"{folder}/zstd/{table}.csv.zst"], stdout=subprocess.PIPE, check=True).stdout
            check(by_zstd == content, f"{table}.csv.zst has other bytes")
        run(f"{stream} | glint-tables --plain --part 7 {folder}/plain", bin_dir)
        for table in TABLES:
            for part, whole in zip(read(f"{folder}/plain/{table}.csv"), read(f"{folder}/{table}.csv.gz")):
                moved = {name: str(int(cell) + 7 * 10**9) if name.endswith("_key") and cell else cell
                         for name, cell in whole.items()}
                check(part == moved, f"{table}: part 7 has the row {part}, expected {moved}")


def check_one_run(bin_dir):
    """A folder never holds tables of two runs: beside one of another kind none is written, and what is there stays."""
    stream, environment = "glint pipelines/two-vehicles.sh", dict(os.environ, GLINT_DATA=ROOT + "/data")
    frames = run(stream, bin_dir)
    for first, second, kind in (("", "--plain", ".csv.gz"), ("--plain", "", ".csv"), ("--zstd", "", ".csv.zst"), ("", "--zstd", ".csv.gz")):
        with tempfile.TemporaryDirectory() as folder:
            run(f"glint-tables {first} {folder}", bin_dir, frames)
            with open(f"{folder}/notes.csv", "w", encoding="utf-8") as file:
                file.write("mine\n")
            before = {name: os.stat(f"{folder}/{name}").st_ino for name in os.listdir(folder)}
            done = subprocess.run([f"{bin_dir}/glint-tables", *second.split(), folder], input=frames, env=environment,
                                  capture_output=True, check=False)
            check(done.returncode == 73 and f"{folder}/detections{kind}: a table of another run" in done.stderr.decode(),
                  f"{second} after {first}: {done}")
            check({name: os.stat(f"{folder}/{name}").st_ino for name in os.listdir(folder)} == before, "files have changed")
            for table in TABLES[1:]:
                os.remove(f"{folder}/{table}{kind}")
            os.rename(f"{folder}/detections{kind}", f"{folder}/{TABLES[-1]}{kind}")
            done = subprocess.run([f"{bin_dir}/glint-tables", *second.split(), folder], input=frames, env=environment,
                                  capture_output=True, check=False)
            check(done.returncode == 73 and sorted(os.listdir(folder)) == sorted(["notes.csv", TABLES[-1] + kind]),
                  f"beside one table of {first}: {done} {os.listdir(folder)}")
            os.remove(f"{folder}/{TABLES[-1]}{kind}")
            for _ in (1, 2):
                run(f"glint-tables {second} {folder}", bin_dir, frames)


def check_memory(bin_dir):
    """Ten times the frames take no more memory."""
    most = []
    for frames in (100, 1000):
        with tempfile.TemporaryDirectory() as folder:
            child = subprocess.Popen([f"{bin_dir}/glint", "-c", f"glint-traffic-random --frames {frames} | "
                                      f"{CHAIN.format('corner77')} | glint-tables {folder}"],
                                     env=dict(os.environ, GLINT_DATA=ROOT + "/data"))
            _, status, used = os.wait4(child.pid, 0)
            check(status == 0, f"{frames} frames end with {status}")
            most.append(used.ru_maxrss)
    check(most[1] <= most[0] + 1024, f"100 frames take {most[0]} kB, 1000 take {most[1]} kB")


def main():
    bin_dir = os.path.abspath(sys.argv[1])
    with open(ROOT + "/schemas/tables.json", encoding="utf-8") as file:
        schema = json.load(file)
    seen = dict.fromkeys([*TABLES, "empty scans"], 0) | {"labels": set()}
    for stream in STREAMS:
        check_stream(stream, schema, bin_dir, seen)
    check(all(seen[name] > 0 for name in seen if name != "labels"), f"too little to see: {seen}")
    check({"0", "-2", "3111", "3122"} <= seen["labels"], f"labels are {seen['labels']}")
    check_ways(bin_dir)
    check_one_run(bin_dir)
    check_memory(bin_dir)
    for text in faults[:10]:
        print(f"FAILED   {text}"[:2000])
    print(f"tables: {', '.join(f'{seen[table]} {table}' for table in TABLES)}; {len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
