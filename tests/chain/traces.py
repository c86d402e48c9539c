"""Traces that glint-osi writes, by protoc, and files that glint-mcap writes, record by record.

Usage: python3 tests/chain/traces.py BIN_DIR

protoc decodes with the full interface if GLINT_TEST_DATA names a folder that has it, and with our part of it. Signs,
axes and units are compared with numbers that were worked out by hand, all else with the lines of the same stream.
tests/tables/run reads the same files with other people's libraries.
"""
import base64
import csv
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import recorded  # noqa: E402
import osi_rules  # noqa: E402
from osi_messages import decode, messages_in, value_of  # noqa: E402
from recorded import BIN, DATA, ENV, ROOT, check  # noqa: E402

NAMED = 10**15
PATHS = ["direct", "wall_object", "object_wall", "wall_object_wall", "wheel", "limb", "clutter", "false_alarm"]
CLASSES = {"clutter": "OVERDRIVABLE", "false_alarm": "CLUTTER"} | {path: "INVALID" for path in PATHS[1:4]}


def pipe(text, data=b"", code=0):
    """What the commands print; with an exit code other than 0, their message."""
    done = subprocess.run(["glint", "-c", text], env=ENV, cwd=ROOT, input=data, capture_output=True, check=False)
    check(done.returncode == code, f"{text}: exit {done.returncode}, not {code}: {done.stderr.decode()}")
    return done.stdout if code == 0 else done.stderr.decode()


def frames_in(lines):
    return [json.loads(line) for line in lines.splitlines()]


# ---- readers --------------------------------------------------------------------------------------------


def osi_of(lines, *words):
    """The messages SensorData of a stream, decoded with each interface that is there."""
    trace = pipe(" ".join(("glint-osi", *words)), lines)
    with tempfile.TemporaryDirectory() as folder:
        ours = decode(trace, "SensorData", folder, os.path.join(ROOT, "stages", "osi"), "osi_trace.proto")
        if DATA is None:
            return ours
        full = decode(trace, "SensorData", folder, os.path.join(DATA, "osi", "proto"), "osi_sensordata.proto")
    check(len(full) == len(ours), "both interfaces see as many messages")
    return full


class File:
    """A file of MCAP: its records, with every checksum, length and place in it compared."""

    def __init__(self, data):
        check(data[:8] == data[-8:] == b"\x89MCAP0\r\n", "magic bytes at both ends")
        self.data, self.at = data, {}
        self.schemas, self.channels, self.messages, self.records = {}, {}, [], []
        for place, code, body in self.walk(8, len(data) - 8):
            self.records.append((place, code, body))
            if code == 6:
                self.read_chunk(place, body)
        self.codes = [code for _, code, _ in self.records]
        for _, code, body in self.records:
            if code == 3:
                number, = struct.unpack_from("<H", body)
                name, encoding, content = strings(body[2:], 3)
                self.schemas[number] = (name.decode(), encoding.decode(), content)
            elif code == 4:
                number, schema = struct.unpack_from("<HH", body)
                topic, encoding, pairs = strings(body[4:], 3)
                self.channels[number] = (topic.decode(), schema, encoding.decode(), pairs_of(pairs))
        self.check_end()
        self.check_index()

    def walk(self, begin, end, data=None):
        data = data or self.data
        while begin < end:
            code, length = struct.unpack_from("<BQ", data, begin)
            yield begin, code, data[begin + 9:begin + 9 + length]
            begin += 9 + length
        check(begin == end, "records fill their place")

    def read_chunk(self, place, body):
        first, last, size, crc, name, length = struct.unpack_from("<QQQIIQ", body)
        content = body[40:]
        check(name == 0 and size == length == len(content) and crc == zlib.crc32(content), "the checksum of a chunk")
        times = []
        for inner, code, record in self.walk(0, len(content), content):
            check(code == 5, "chunks hold messages alone")
            channel, sequence, log, published = struct.unpack_from("<HIQQ", record)
            check(sequence == 0 and log == published, "both times of a message are one")
            self.messages.append((channel, log, record[22:]))
            self.at[(place, inner)] = (channel, log)
            times.append(log)
        check((first, last) == (min(times), max(times)) and times == sorted(times), "times of a chunk")

    def check_end(self):
        place, _, body = next(one for one in self.records if one[1] == 15)
        check(struct.unpack("<I", body)[0] == zlib.crc32(self.data[:place]), "the checksum of the data")
        foot = len(self.data) - 8 - 29
        summary, offsets, crc = struct.unpack_from("<QQI", self.data, foot + 9)
        check(self.data[foot] == 2 and summary == place + 13, "the summary follows the data")
        check(crc == zlib.crc32(self.data[summary:foot + 25]), "the checksum of the summary")
        groups = [struct.unpack("<BQQ", body) for begin, code, body in self.records if code == 14]
        check(groups[0][1] == summary and groups[-1][1] + groups[-1][2] == offsets, "groups fill the summary")
        for code, begin, length in groups:
            check({one for _, one, _ in self.walk(begin, begin + length)} == {code}, "a group has records of one kind")
        self.groups = [code for code, _, _ in groups]

    def check_index(self):
        chunks = {place: body for place, code, body in self.records if code == 6}
        seen = set()
        for _, code, body in self.records:
            if code != 8:
                continue
            first, last, place, length, size = struct.unpack_from("<QQQQI", body)
            check(struct.unpack_from("<QQ", chunks[place]) == (first, last), "times of an indexed chunk")
            check(length == 9 + len(chunks[place]), "the length of an indexed chunk")
            for at in range(36, 36 + size, 10):
                channel, where = struct.unpack_from("<HQ", body, at)
                _, code, index = next(self.walk(where, where + 9 + struct.unpack_from("<Q", self.data, where + 1)[0]))
                check(code == 7 and struct.unpack_from("<H", index)[0] == channel, "a channel's index of a chunk")
                for log, inner in struct.iter_unpack("<QQ", index[6:]):
                    check(self.at[(place, inner)] == (channel, log), "an index leads to its message")
                    seen.add((place, inner))
            check(struct.unpack_from("<QIQQ", body, 36 + size)[1:] == (0, len(chunks[place]) - 40, len(chunks[place]) - 40),
                  "sizes of an indexed chunk")
        check(seen == set(self.at), "every message is in the index")

    def of(self, topic):
        number = next(number for number, channel in self.channels.items() if channel[0] == topic)
        return [(log, content) for channel, log, content in self.messages if channel == number]


def strings(body, count):
    found, at = [], 0
    for _ in range(count):
        length, = struct.unpack_from("<I", body, at)
        found.append(body[at + 4:at + 4 + length])
        at += 4 + length
    check(at == len(body), "strings fill the record")
    return found


def pairs_of(body):
    found, at = [], 0
    while at < len(body):
        length, = struct.unpack_from("<I", body, at)
        found.append(body[at + 4:at + 4 + length].decode())
        at += 4 + length
    return dict(zip(found[::2], found[1::2], strict=True))


def mcap_of(lines, *words):
    return File(pipe(" ".join(("glint-mcap", *words)), lines))


def points_of(cloud):
    data, stride = base64.b64decode(cloud["data"]), cloud["point_stride"]
    kinds = {5: "<I", 7: "<f"}
    return [{field["name"]: struct.unpack_from(kinds[field["type"]], data, at + field["offset"])[0] for field in cloud["fields"]}
            for at in range(0, len(data), stride)]


# ---- numbers worked out by hand ---------------------------------------------------------------------------


def suite(folder, **mount):
    with open(os.path.join(ROOT, "data/sensors/srr24-pair.json"), encoding="utf-8") as file:
        sensor = json.load(file)["sensors"][0]
    sensor.update(name="radar", range_max_m=100, field_of_view_rad=math.pi, calibration_range_m=100, **mount)
    path = os.path.join(folder, "suite.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump({"origin": "a test's", "sensors": [sensor]}, file)
    return path


def thing(name, kind, x, y, yaw=0.0, vx=0.0, vy=0.0, rate=0.0):
    return {"id": name, "class": kind, "x_m": x, "y_m": y, "yaw_rad": yaw, "vx_mps": vx, "vy_mps": vy, "yaw_rate_radps": rate,
            "length_m": 0, "width_m": 0, "height_m": 0, "travelled_m": 0}


def scene(*objects, **more):
    frame = {"version": 1, "scene": "by hand", "frame": 0, "time_s": 7.24, "interval_s": 0.04, "last": True, "seed": "1",
             "ego": objects[0]["id"], "sections": ["objects", "quality"], "objects": list(objects), **more}
    return json.dumps(frame).encode() + b"\n"


def seen(path, frame):
    """Exact targets: one for each point, without any effect of a radar."""
    return pipe(f"glint-extract | glint-ideal --sensors {path} | glint-sensor-perfect | glint-noise-none", frame)


def near(found, wanted, what, close=1e-11):
    check(abs(found - wanted) <= close, f"{what} is {found}, by hand {wanted}")


# A post, seen by an ego of 4.5 m whose rear axle is 1.25 m behind its centre: places, turns and speeds of the ego, the
# mount, the post; and by hand the range, azimuth and speed towards the sensor, the pose of the sensor, and the post.
HALF = math.sqrt(0.5)
BY_HAND = {
    "approaching": (thing("1", "car", 0, 0, vx=10), (2, 0.5, 0), (40, 0.5), (38, 0, 10), (2, 0.5, 0)),
    "10 ms after its scan": (thing("1", "car", 0, 0, vx=10), (2, 0.5, 0), (40, 0.5), (38.1, 0, 10), (1.9, 0.5, 0)),
    "on the left": (thing("1", "car", 0, 0, vx=10), (2, 0, 0), (22, 20), (20 * math.sqrt(2), math.pi / 4, 10 * HALF), (2, 0, 0)),
    "mirrored": (thing("1", "car", 0, 0, vx=10), (2, 0, 0), (22, -20), (20 * math.sqrt(2), -math.pi / 4, 10 * HALF), (2, 0, 0)),
    "receding": (thing("1", "car", 0, 0, vx=-10), (2, 0, 0), (42, 0), (40, 0, -10), (2, 0, 0)),
    # The ego drives along y at 8 m/s and turns left at 0.5 rad/s: its sensor, 1 m ahead, looks along -x and moves
    # there at 0.5 m/s beside the 8 m/s along y.
    "turning": (thing("1", "car", 0, 0, math.pi / 2, 0, 8, 0.5), (1, 0, math.pi / 2), (-30, 1), (30, 0, 0.5), (0, 1, math.pi)),
}


def scenes_by_hand(folder):
    for name, (ego, mount, post, polar, pose) in BY_HAND.items():
        path = suite(folder, mount_x_m=mount[0], mount_y_m=mount[1], mount_yaw_rad=mount[2])
        lines = seen(path, scene(ego, thing("post 2", "post", *post), origin_x_m=1000, origin_y_m=-500,
                                 time_s=7.25 if "after" in name else 7.24))
        data = osi_of(lines)[0]
        radar, = data["feature_data"][0]["radar_sensor"]
        one, = radar["detection"]
        for wanted, place in zip(polar, (("position", "distance"), ("position", "azimuth"), ("radial_velocity",))):
            near(value_of(one, *place), wanted, f"{name}: {place[-1]} of OSI")
        header = radar["header"][0]
        for wanted, place in zip((mount[0] + 1.25, mount[1]), "xy"):
            near(value_of(header, "mounting_position", "position", place), wanted, f"{name}: mount {place}")
        near(value_of(header, "mounting_position", "orientation", "yaw"), mount[2], f"{name}: mount yaw")
        check(value_of(header, "measurement_time", "seconds") == 7 and value_of(header, "measurement_time", "nanos") == 24e7, name)
        truth = data["sensor_view"][0]["global_ground_truth"][0]
        car, = truth["moving_object"]
        pole, = truth["stationary_object"]
        for wanted, place in zip((ego["x_m"] + 1000, ego["y_m"] - 500, 0.75), "xyz"):
            near(value_of(car, "base", "position", place), wanted, f"{name}: car {place}")
        for wanted, place in zip((post[0] + 1000, post[1] - 500, 0.5), "xyz"):
            near(value_of(pole, "base", "position", place), wanted, f"{name}: post {place}", 1e-10)
        for key, place in (("vx_mps", ("velocity", "x")), ("vy_mps", ("velocity", "y")), ("yaw_rad", ("orientation", "yaw")),
                           ("yaw_rate_radps", ("orientation_rate", "yaw"))):
            near(value_of(car, "base", *place), ego[key], f"{name}: car {key}")
        near(value_of(car, "vehicle_attributes", "bbcenter_to_rear", "x"), -1.25, name)
        check((car["type"], pole["classification"][0]["type"]) in ((["TYPE_VEHICLE"], ["TYPE_POLE"]), (["2"], ["4"])), name)
        check(value_of(car, "id", "value") == value_of(truth, "host_vehicle_id", "value") == 1, name)
        check(value_of(pole, "id", "value") == NAMED + 1, f"{name}: {pole['id']}")
        check(one["classification"][0] == "DETECTION_CLASSIFICATION_OTHER", name)
        drawn_by_hand(name, lines, post, polar, pose)


def drawn_by_hand(name, lines, post, polar, pose):
    """What viewers draw of the same scene: the point, put at its sensor, lies on the post."""
    file = mcap_of(lines)
    (_, cloud), (_, update) = file.of("/radar/radar")[0], file.of("/scene")[0]
    cloud, update = json.loads(cloud), json.loads(update)
    point, = points_of(cloud)
    for wanted, key, sign in zip(polar, ("range_m", "azimuth_rad", "range_rate_mps"), (1, 1, -1)):
        near(sign * point[key], wanted, f"{name}: {key} of a point", 1e-5)
    position, turn = cloud["pose"]["position"], cloud["pose"]["orientation"]
    yaw = 2 * math.atan2(turn["z"], turn["w"])
    for wanted, found in zip(pose, (position["x"], position["y"], yaw)):
        near(found, wanted, f"{name}: pose of a cloud", 1e-9)
    near(position["x"] + point["x"] * math.cos(yaw) - point["y"] * math.sin(yaw), post[0], f"{name}: the point on the post", 1e-5)
    near(position["y"] + point["x"] * math.sin(yaw) + point["y"] * math.cos(yaw), post[1], f"{name}: the point on the post", 1e-5)
    box = update["entities"][1]
    check((box["id"], box["texts"][0]["text"]) == ("post 2", "post 2 (post)"), f"{name}: {box}")
    cube = box["cubes"][0]
    check(cube["pose"]["position"] == {"x": post[0], "y": post[1], "z": 0.5} and cube["size"]["z"] == 1, f"{name}: {cube}")
    check(box["metadata"] == [{"key": "class", "value": "post"}, {"key": "object", "value": str(int(point["object"]))}], name)


# ---- everything, against the lines --------------------------------------------------------------------------

CHAIN = " --sections quality,objects | glint-extract | glint-ideal --sensors {} --effects all | glint-sensor | glint-noise"
STREAMS = (("cut-in", "lrr77-full"), ("wheels-and-limbs", "lrr77-full"), ("walled-road", "radarscenes77-full"),
           ("gravel", "lrr77-full"), ("motorway", "lrr77-full"))


def strongest(target):
    return max(target["contributors"], key=lambda part: part["weight"])


def keeps_the_rules(data):
    for version in ("3.7", "3.8"):
        found = osi_rules.faults(data, version)
        check(not found, f"rules of OSI {version}: {found}")
    for radar in data["feature_data"][0].get("radar_sensor", []):
        kinds = [one["classification"] for one in radar.get("detection", [])]
        valid = sum(kind != ["DETECTION_CLASSIFICATION_INVALID"] for kind in kinds)
        check(radar["header"][0]["number_of_valid_detections"] == [str(valid)], "the header counts the valid detections")


def at_its_place(position, target):
    """OSI turns a point of the x axis about y, and then about z; the sensor's azimuth is the angle from its yz plane's normal."""
    distance, azimuth, pitch = (value_of(position, key) for key in ("distance", "azimuth", "elevation"))
    ahead, up = distance * math.cos(pitch), -distance * math.sin(pitch)
    near(ahead * math.sin(azimuth), target["range_m"] * math.sin(target["azimuth_rad"]), "y of a detection", 1e-9)
    near(up, target["range_m"] * math.sin(target.get("elevation_rad", 0)), "z of a detection", 1e-9)
    check("elevation" in position or azimuth == target["azimuth_rad"], "the azimuth in the plane is as it was reported")


def compare_osi(lines):
    """Every number of every message; returns how often each path and merged target came."""
    counts = {}
    for frame, data in zip(frames_in(lines), osi_of(lines, "--shift-s 1"), strict=True):
        objects = {one["id"]: one for one in frame["objects"]}
        keeps_the_rules(data)
        truth = data["sensor_view"][0]["global_ground_truth"][0]
        for one in truth.get("moving_object", []) + truth.get("stationary_object", []):
            reference = one["source_reference"][0]
            name, kind = (text.strip('"') for text in reference["identifier"])
            own = objects.pop(name)
            check(kind == own["class"] and reference["type"] == ['"glint.object"'], f"class of {name}")
            for key, place in (("x_m", ("position", "x")), ("y_m", ("position", "y")), ("yaw_rad", ("orientation", "yaw")),
                               ("length_m", ("dimension", "length")), ("width_m", ("dimension", "width")),
                               ("height_m", ("dimension", "height"))):
                check(value_of(one, "base", *place) == own[key] + frame.get(key.replace("x_m", "origin_x_m").replace(
                    "y_m", "origin_y_m"), 0) * (key in ("x_m", "y_m")), f"{name}: {place}")
        check(not objects, f"objects without truth: {list(objects)}")
        measured = [one for one in frame["sensors"]["list"] if one["measured"]]
        radars = data["feature_data"][0].get("radar_sensor", [])
        for sensor, radar in zip(measured, radars, strict=True):
            targets = [one for one in frame["targets"] if one["sensor"] == sensor["name"]]
            header = radar["header"][0]
            time = frame["time_s"] - sensor.get("age_s", 0) + 1
            near(value_of(header, "measurement_time", "seconds") + value_of(header, "measurement_time", "nanos") * 1e-9, time,
                 "time of a scan", 1e-9)
            check(value_of(header, "cycle_counter") == frame["frame"], "cycle")
            check(frame["sensors"]["list"][int(value_of(header, "sensor_id", "value")) - 1] is sensor, "number of a sensor")
            valid = 0
            for i, (target, one) in enumerate(zip(targets, radar.get("detection", []), strict=True)):
                part, quality = strongest(target), target["quality"]
                path = part["path"]
                kind = "OTHER" if part["object"] == "roadside" else CLASSES.get(path, "OTHER")
                valid += kind != "INVALID"
                check(one["classification"] == ["DETECTION_CLASSIFICATION_" + kind], f"{path} of {part['object']}: {one}")
                for key, place, sign in (("range_m", ("position", "distance"), 1), ("elevation_rad", ("position", "elevation"), -1),
                                         ("range_rate_mps", ("radial_velocity",), -1)):
                    check(value_of(one, *place) == sign * target.get(key, 0), f"{key} of a detection")
                at_its_place(one["position"][0], target)
                for key, place in (("range_sd_m", ("position_rmse", "distance")), ("azimuth_sd_rad", ("position_rmse", "azimuth")),
                                   ("elevation_sd_rad", ("position_rmse", "elevation")),
                                   ("range_rate_sd_mps", ("radial_velocity_rmse",)), ("rcs_dbsm", ("rcs",)), ("snr_db", ("snr",)),
                                   ("existence", ("existence_probability",))):
                    check(value_of(one, *place) == quality.get(key, 0), f"{key} of a detection")
                folds = quality.get("range_rate_interval_mps", 0) > 0
                check(value_of(one, "ambiguity_id", "value") == (i + 1 if folds else 0), "ambiguity")
                counts[path] = counts.get(path, 0) + 1
                counts["merged"] = counts.get("merged", 0) + quality["merged_objects"]
            check(value_of(header, "number_of_valid_detections") == valid, "valid detections")
    return counts


def whole_times(message):
    """True if all times of a message are digits alone: readers in Go refuse 4e+07 for a whole number."""
    times = re.findall(rb'"n?sec": *([^,}]*)', message)
    return len(times) > 1 and all(time.isdigit() for time in times)


def compare_mcap(lines):
    file, frames = mcap_of(lines, "--shift-s 1"), frames_in(lines)
    trace = pipe("glint-osi --shift-s 1", lines)
    check([content for _, content in file.of("/osi/SensorData")] == list(messages_in(trace)), "both write the same messages")
    check([content for _, content in file.of("/frames")] == lines.splitlines(), "frames are their lines")
    numbers = {}
    for (_, update), frame in zip(file.of("/scene"), frames, strict=True):
        check(whole_times(update), "seconds and nanoseconds without an exponent")
        for box, own in zip(json.loads(update)["entities"], frame["objects"], strict=True):
            numbers[box["id"]] = int(box["metadata"][1]["value"])
            cube = box["cubes"][0]
            check(box["id"] == own["id"] and cube["size"] == {"x": own["length_m"], "y": own["width_m"], "z": own["height_m"]}
                  and cube["pose"]["position"] == {"x": own["x_m"], "y": own["y_m"], "z": own["height_m"] / 2}, f"box of {own['id']}")
    check(len(set(numbers.values())) == len(numbers), "numbers of objects differ")
    for sensor in {one["name"] for frame in frames for one in frame["sensors"]["list"] if one["measured"]}:
        clouds = iter(file.of(f"/radar/{sensor}"))
        for frame in frames:
            if not next(one for one in frame["sensors"]["list"] if one["name"] == sensor)["measured"]:
                continue
            log, cloud = next(clouds)
            near(log, (frame["time_s"] + 1) * 1e9, "time of a message", 1)
            targets = [one for one in frame["targets"] if one["sensor"] == sensor]
            check(whole_times(cloud), "seconds and nanoseconds without an exponent")
            mount = next(one for one in frame["sensors"]["list"] if one["name"] == sensor)
            check(json.loads(cloud)["pose"]["position"]["z"] == mount.get("mount_z_m", 0), f"height of {sensor}")
            for point, target in zip(points_of(json.loads(cloud)), targets, strict=True):
                part = strongest(target)
                check(point["path"] == PATHS.index(part["path"]) and point["contributors"] == len(target["contributors"])
                      and point["object"] == (numbers[part["object"]] if part["path"] not in PATHS[6:] else 0), f"label of {point}")
                values = {**target, **target["quality"]}
                for key in ("range_m", "azimuth_rad", "range_rate_mps", "range_rate_over_ground_mps", "amplitude_db", "rcs_dbsm"):
                    check(point[key] == struct.unpack("<f", struct.pack("<f", values[key]))[0], f"{key} of a point")
                near(point["z"], target["range_m"] * math.sin(target.get("elevation_rad", 0)), "height of a point", 1e-5)
        check(next(clouds, None) is None, "a cloud for each scan")
    return file


def every_number(folder):
    sums, elevated = {}, os.path.join(folder, "elevated.json")
    with open(elevated, "w", encoding="utf-8") as file:
        json.dump({"extends": "lrr77-full", "origin": "for tests", "sensors": [{"name": "front", "elevation_view_rad": 0.3,
                                                                             "elevation_sigma_rad": 0.02}]}, file)
    for name, radars in (*STREAMS, ("wet-road", elevated)):
        lines = pipe(f"glint-traffic {name}" + CHAIN.format(radars))
        for key, count in compare_osi(lines).items():
            sums[key] = sums.get(key, 0) + count
        file = compare_mcap(lines)
        targets = [target for frame in frames_in(lines) for target in frame["targets"]]
        points, count = len(targets), sum("elevation_rad" not in target for target in targets)
        low = list(dict.fromkeys(one["name"] for frame in frames_in(lines) for one in frame["sensors"]["list"] if not one.get("mount_z_m")))
        for words in ("", " --ros2"):
            done = subprocess.run(["glint", "-c", "glint-mcap" + words], env=ENV, input=lines, capture_output=True, check=True)
            said = [f"z is 0 in {count} of {points} points: their radars measure no elevation"] if count else []
            said += [f"0 m is taken as the height of radars that have no mount_z_m: {', '.join(low)}"] if low else []
            check(done.stderr.decode().splitlines() == ["glint-mcap: " + text for text in said], f"what is said of heights: {done.stderr}")
        check(file.groups == [3, 4, 11, 8, 13], f"groups of the summary: {file.groups}")
        check([name for name, _, _ in list(file.schemas.values())[:3]] == ["osi3.SensorData", "glint.frame", "foxglove.SceneUpdate"],
              "schemas")
        named = set(re.findall(rb"[a-z_]+/[a-z_]+\.proto", file.schemas[1][2]))
        check(named == {b"export/osi_trace.proto", b"recorded/recorded_osi.proto"}, f"names that all files have: {named}")
        with open(os.path.join(ROOT, "schemas/frame.json"), encoding="utf-8") as schema:
            check(json.loads(file.schemas[2][2].rstrip(b"\0")) == json.load(schema), "the schema of frames")
    missing = [key for key in [*PATHS, "merged"] if not sums.get(key)]
    check(not missing, f"the streams have no {missing}")
    print(f"traces: {sums['merged']} merged targets and targets by path:", {path: sums[path] for path in PATHS})


def broken_once(data, kind, name, rule):
    """A copy of a message SensorData in which one message of the kind breaks the rule of its field."""
    copy = json.loads(json.dumps(data))
    message = [one for of, one in osi_rules.messages_of(copy) if of == kind and (name in one or rule[:2] in (">=", "<="))][-1]
    if rule[:2] in (">=", "<="):
        message[name] = [str(float(rule[2:]) + (1 if rule[0] == "<" else -1))]
    elif rule == "is_set" or rule.startswith("if_type"):
        del message[name]
    else:
        message[name] = [{"value": ["7" if rule == "is_globally_unique" else "5"]}]  # of the host as well, or of no object
    return copy


def rules_of_osi(folder):
    """The rules hold for hosts and objects of all kinds, are those of the interface, and none can be broken unseen."""
    path = suite(folder, mount_x_m=0, mount_y_m=0, mount_yaw_rad=0)
    kinds = ("car", "pedestrian", "bicycle", "post", "wall", "articulated_truck")
    things = [thing(kind, kind, 15 + 5 * i, 0) for i, kind in enumerate(kinds)]
    for kind in ("car", "pedestrian", "post", "truck"):
        data, = osi_of(seen(path, scene(thing("7", kind, 0, 0), *things)))
        keeps_the_rules(data)
        moving = data["sensor_view"][0]["global_ground_truth"][0]["moving_object"]
        host = next(one for one in moving if value_of(one, "id", "value") == 7)
        check("bbcenter_to_rear" in host["vehicle_attributes"][0], f"the origin of a host that is a {kind}")
    rules = osi_rules.table(osi_rules.RULES)
    for (kind, name), those in rules.items():
        for rule in those:
            fault = osi_rules.faults(broken_once(data, kind, name, rule), "3.8")
            check(f"{kind}.{name}: {rule}" in fault, f"{kind}.{name}: {rule} is broken unseen")
    one = data["feature_data"][0]["radar_sensor"][0]["detection"][0]
    one["object_id"] = [{"value": ["7"]}]
    check(osi_rules.faults(data, "3.7") and not osi_rules.faults(data, "3.8"), "an object_id breaks a rule of 3.7 alone")
    if DATA is not None:
        published = osi_rules.published(os.path.join(DATA, "osi", "proto"))
        check({key: published[key] for key in rules} == rules, "the rules are those of the interface")


def metadata_of_osi():
    file = mcap_of(b"")
    pairs, versions = None, {"version", "min_osi_version", "max_osi_version"}
    for _, code, body in file.records:
        if code == 12:
            check(pairs is None, "one metadata record")
            name, content = strings(body, 2)
            check(name == b"net.asam.osi.trace", "its name")
            pairs = pairs_of(content)
    check({pairs[key] for key in versions} == {"3.8.0"} and {"min_protobuf_version", "max_protobuf_version"} <= set(pairs), f"{pairs}")
    topic, schema, encoding, pairs = next(one for one in file.channels.values() if file.schemas[one[1]][0].startswith("osi3"))
    check(encoding == "protobuf" and set(pairs) == {"net.asam.osi.trace.channel.osi_version",
                                                    "net.asam.osi.trace.channel.protobuf_version"}, f"{topic}: {pairs}")
    check(file.messages == [] and pipe("glint-osi", b"") == b"", "a stream without frames")


# ---- limits and refusals --------------------------------------------------------------------------------------


def changed(line, **members):
    frame = json.loads(line)
    frame.update(members)
    return json.dumps(frame).encode() + b"\n"


def ids_and_times(folder):
    path = suite(folder, mount_x_m=2, mount_y_m=0, mount_yaw_rad=0)
    ids = ["0", "7", "999999999999999", "1000000000000000", "18446744073709551615", "007", "-1", "1.5", 'a "b" \\ é']
    others = [thing(name, "pedestrian", 20 + 3 * i, 0) for i, name in enumerate(ids)]
    line = seen(path, scene(thing("ego", "car", 0, 0, vx=1), *others))
    truth = osi_of(line)[0]["sensor_view"][0]["global_ground_truth"][0]
    numbers = {json.loads('"' + one["source_reference"][0]["identifier"][0][1:-1].replace("\\303\\251", "é") + '"'):
               one["id"][0]["value"][0] for one in truth["moving_object"]}
    check(set(numbers) == {"ego", *ids}, f"ids: {numbers}")
    check([int(numbers[name]) for name in ids[:3]] == [0, 7, 999999999999999], "numbers stay")
    named = [int(numbers[name]) for name in ["ego", *ids[3:]]]
    check(len(set(named)) == len(named) and all(NAMED <= number < NAMED + 100 for number in named), f"names: {named}")
    for time_s, shift_s, wanted in ((0, 0, (0, 0)), (9e9, 0, (9000000000, 0)), (1e10, 0, (10000000000, 0)), (-3, 3.5, (0, 500000000)),
                                    (1.9999999999, 0, (2, 0)), (0.1 + 0.2, 0, (0, 300000000)), (1700000000.123456, 0, None)):
        stamp = osi_of(changed(line, time_s=time_s), f"--shift-s {shift_s}")[0]["timestamp"][0]
        found = (int(stamp["seconds"][0]), int(stamp["nanos"][0]))
        check(found == wanted or (wanted is None and abs(found[1] - 123456001) < 999), f"{time_s}: {found}")
    file = mcap_of(changed(line, time_s=1e10))
    check({log for _, log, _ in file.messages} == {10**19}, "the latest time of MCAP")
    for program in ("glint-osi", "glint-mcap"):
        for time_s, words in ((-0.04, ""), (1e10, "--shift-s 1"), (3, "--shift-s -3.5")):
            said = pipe(f"{program} {words}", changed(line, time_s=time_s), 65)
            check(":1: time_s: a measurement at" in said and "--shift-s is added to all times" in said, said)


def refusals(folder):
    path = suite(folder, mount_x_m=2, mount_y_m=0, mount_yaw_rad=0)
    good = seen(path, scene(thing("ego", "car", 0, 0), thing("2", "car", 20, 0)))
    objects = json.loads(good)["objects"]
    flat = [objects[0] | {"height_m": 0}, objects[1]]
    unscanned = json.loads(good)["sensors"]
    unscanned["list"][0]["measured"] = False
    for program in ("glint-osi", "glint-mcap", "glint-mcap --ros2"):
        pipe(program, good)
        for data, said in (
                (seen(path, scene(thing("ego", "car", 0, 0), thing("2", "car", 20, 0), sections=["objects"])),
                 ":1: quality: missing; expected --sections quality at glint-noise or before"),
                (seen(path, scene(thing("ego", "car", 0, 0), thing("2", "car", 20, 0), sections=["quality"])),
                 ":1: objects: missing; --sections left them out of the stream"),
                (scene(thing("ego", "car", 0, 0)), ":1: sensors: missing; expected glint-ideal"),
                (changed(good, sensors=unscanned), ':1: targets[0].sensor: "radar" has no scan in this frame; expected one'),
                (changed(good, objects=flat), ':1: objects: "2" has no length, width or height; expected glint-extract'),
                (good + changed(good, scene="another"), ':2: scene: "another" after "by hand"; expected one scene of one seed'),
                (good + changed(good, seed="2"), ':2: scene: "by hand" after "by hand"; expected one scene of one seed'),
                (good + changed(good, frame=1), ":2: time_s: 7.24 after 7.24; expected ascending times"),
                (changed(good, time_s=0) + changed(good, frame=1, time_s=0), ":2: time_s: 0 after 0; expected ascending times"),
                (changed(good, time_s=0) + changed(good, frame=1, time_s=1e-10), ":2: time_s: 1e-10 after 0; expected")):
            text = pipe(program, data, 65)
            check(said in text.replace('"ego" has no', '"2" has no'), f"{said}: {text}")
        out = os.path.join(folder, "old")
        with open(out, "wb") as file:
            file.write(b"old")
        pipe(f"{program} -o {out}", good + b"{", 65)
        with open(out, "rb") as file:
            check(file.read() == b"old", "a run that fails leaves the old file")
        pipe(f"{program} -o {out}", good)
        with open(out, "rb") as file:
            check(file.read() == pipe(program, good), "same bytes for the same stream, into a file or a pipe")


def bags_of_ros(folder):
    """What a bag of ROS 2 holds and refuses; tests/tables/ros.mjs compares all that is in its messages."""
    path = suite(folder, mount_x_m=2, mount_y_m=0, mount_yaw_rad=0)
    line = seen(path, scene(thing("ego", "car", 0, 0, vx=1), thing("7", "car", 20, 0)))
    empty = mcap_of(b"", "--ros2")
    check(strings(empty.records[0][2], 2) == [b"ros2", b"glint"] and empty.messages == [] and empty.groups == [3, 4, 11],
          "a bag without frames")
    for time_s, words, stamp in ((0, "", (1, 0)), (0.5, "", (1, 500000000)), (1, "", (1, 0)), (0, "--shift-s 0", (0, 0)),
                                 (-3, "--shift-s 3.5", (0, 500000000)), (1.9999999999, "", (2, 0)), (2147483647, "", (2147483647, 0))):
        file = mcap_of(changed(line, time_s=time_s), "--ros2", words)
        for topic, (_, message), place in zip(("/tf", "/objects", "/radar/radar"), file.of("/tf") + file.of("/objects") +
                                              file.of("/radar/radar"), (8, 8, 4), strict=True):
            check(struct.unpack_from("<iI", message, place) == stamp, f"{topic} at {time_s} s: {struct.unpack_from('<iI', message, place)}")
        check({log for log, _ in file.of("/tf")} == {stamp[0] * 10**9 + stamp[1]}, "the time of a message")
    for time_s, words in ((2147483648, ""), (2147483647, "--shift-s 1"), (-0.5, ""), (1, "--shift-s -2")):
        said = pipe(f"glint-mcap --ros2 {words}", changed(line, time_s=time_s), 65)
        check(":1: time_s: a measurement at" in said and "expected one in [0, 2147483647] s" in said, said)
    for words in ("", "--ros2"):
        moved = line + changed(line, frame=1, time_s=8, origin_x_m=2)
        check(":2: origin_x_m, origin_y_m: (2, 0) after (0, 0); expected one origin" in pipe(f"glint-mcap {words}", moved, 65), "an origin that moves")
    for name in ("front_left", "_2", "R" * 200):
        topics = {channel[0] for channel in mcap_of(renamed(line, name), "--ros2").channels.values()}
        check(topics == {"/tf", "/objects", f"/radar/{name}"}, f"topics: {topics}")
    for name in ("front-left", "2", "vorn/links", "größe", "a b", "R" * 201):
        said = pipe("glint-mcap --ros2", renamed(line, name), 65)
        check(f':1: sensors: "{name}" is no name in ROS 2; expected at most 200 letters, digits and _, no digit first' in said, said)
        mcap_of(renamed(line, name))


def renamed(line, name):
    frame = json.loads(line)
    for view in frame["sensors"]["list"]:
        view["name"] = name
    for target in frame["targets"]:
        target["sensor"] = name
    return json.dumps(frame).encode() + b"\n"


def stamp_of(message, place):
    return int(value_of(message, place, "seconds")) * 10**9 + int(value_of(message, place, "nanos"))


def pair_of_ages(left_s, right_s, **members):
    """A frame of two radars, each with its own age; None: it did not measure."""
    line = pipe("glint-traffic two-vehicles --sections quality,objects | glint-extract | glint-ideal --sensors srr24-pair"
                " | glint-sensor | glint-noise").splitlines()[0]
    frame = json.loads(line) | members
    for view, age_s in zip(frame["sensors"]["list"], (left_s, right_s), strict=True):
        view["measured"] = age_s is not None
        view["age_s"] = age_s or 0.03
    silent = [view["name"] for view in frame["sensors"]["list"] if not view["measured"]]
    frame["targets"] = [one for one in frame["targets"] if one["sensor"] not in silent]
    return json.dumps(frame).encode() + b"\n"


def stamps_of_scans():
    """A scan is stamped with the time that it shows; the last measurement of a message is that of its youngest scan."""
    for left_s, right_s, last_s in ((0.05, 0.02, 0.02), (0.01, 0.04, 0.01), (None, 0.04, 0.04), (None, None, None)):
        line = pair_of_ages(left_s, right_s, time_s=7)
        data, file = osi_of(line)[0], mcap_of(line)
        check(stamp_of(data, "timestamp") == 7 * 10**9, "the time of a message is that of its frame")
        wanted = [round((7 - age_s) * 1e9) for age_s in (left_s, right_s) if age_s is not None]
        radars = data["feature_data"][0].get("radar_sensor", [])
        found = [stamp_of(radar["header"][0], "measurement_time") for radar in radars]
        check(found == wanted, f"measurement_time: {found}, not {wanted}")
        if last_s is None:
            check("last_measurement_time" not in data, "without a scan there is no last measurement")
        else:
            found = stamp_of(data, "last_measurement_time")
            check(found == round((7 - last_s) * 1e9), f"last_measurement_time: {found}")
        clouds = [json.loads(cloud) for one in file.channels.values() if one[0].startswith("/radar/")
                  for _, cloud in file.of(one[0])]
        found = sorted(one["timestamp"]["sec"] * 10**9 + one["timestamp"]["nsec"] for one in clouds)
        check(found == sorted(wanted), f"the stamps of clouds: {found}, not {wanted}")
        near(file.of("/scene")[0][0], 7e9, "the time of a message", 1)


def shifts():
    """A stream that begins at 0 is shifted by its largest age, if there is one; any other is not."""
    for ages, words, time_s, shift_s in (((0.05, 0.02), "", 0, 0.05), ((0.05, None), "", 0.03, 0.05), ((0.05, 0.02), "", 0.05, 0),
                                         ((None, None), "", 0, 0.03), ((0.05, 0.02), "--shift-s 1", 0, 1),
                                         ((0.05, 0.02), "", 1e9, 0)):
        lines = pair_of_ages(*ages, time_s=time_s) + pair_of_ages(*ages, time_s=time_s + 0.1, frame=1)
        wanted = [round((time + shift_s) * 1e9) for time in (time_s, time_s + 0.1)]
        found = [stamp_of(one, "timestamp") for one in osi_of(lines, words)]
        check(max(abs(a - b) for a, b in zip(found, wanted, strict=True)) < 200, f"{ages} at {time_s} s: {found}, not {wanted}")
        check([log for log, _ in mcap_of(lines, words).of("/scene")] == found, "MCAP has the same times")
    for program in ("glint-osi --shift-s 0", "glint-mcap --shift-s 0.04"):
        said = pipe(program, pair_of_ages(0.05, 0.02, time_s=0), 65)
        check(":1: time_s: a measurement at -0.0" in said and "--shift-s is added to all times" in said, said)


def labels_join_by_tables(folder):
    """A detection is the row of the tables with its frame, the name of its sensor and its place in the list."""
    lines = pipe("glint-traffic two-vehicles --sections quality,objects | glint-extract | glint-ideal --sensors srr24-pair"
                 " | glint-sensor | glint-noise")
    pipe(f"glint-tables --plain {folder}/tables", lines)
    with open(os.path.join(folder, "tables", "detections.csv"), newline="", encoding="utf-8") as file:
        rows = {(int(row["frame"]), row["sensor"], int(row["detection"])): row for row in csv.DictReader(file)}
    names = [one["name"] for one in frames_in(lines)[0]["sensors"]["list"]]
    for data in osi_of(lines):
        for radar in data["feature_data"][0].get("radar_sensor", []):
            header = radar["header"][0]
            sensor = names[int(value_of(header, "sensor_id", "value")) - 1]
            for i, one in enumerate(radar.get("detection", [])):
                row = rows.pop((int(value_of(header, "cycle_counter")), sensor, i))
                check(float(row["range_m"]) == value_of(one, "position", "distance"), f"the row of a detection: {row}")
    check(not rows, f"{len(rows)} rows without a detection")


# ---- from OSI to OSI --------------------------------------------------------------------------------------------


def poses_stay(folder):
    """Traces of esmini, through the chain: places, turns, speeds and sizes are those of the trace."""
    if DATA is None:
        print("skipped  traces of esmini: GLINT_TEST_DATA is not set")
        return
    for name in ("acc-test", "pedestrian"):
        path = os.path.join(DATA, "osi", name + ".osi")
        with open(path, "rb") as file:
            truths = decode(file.read(), "GroundTruth", folder, os.path.join(DATA, "osi", "proto"), "osi_groundtruth.proto")
        lines = pipe(f"glint-traffic-osi {path} --ego 0 --sections quality,objects | glint-extract"
                     " | glint-ideal --sensors lrr77 | glint-sensor | glint-noise")
        count = 0
        for truth, data in zip(truths, osi_of(lines), strict=True):
            after = {value_of(one, "id", "value"): one
                     for one in data["sensor_view"][0]["global_ground_truth"][0]["moving_object"]}
            check(data["timestamp"] == truth["timestamp"] or value_of(data, "timestamp", "nanos") == value_of(truth, "timestamp", "nanos"),
                  "times stay")
            for one in truth["moving_object"]:
                other = after.pop(value_of(one, "id", "value"))
                check(other.get("type") == one["type"], "types stay")
                for place in (("position", "x"), ("position", "y"), ("orientation", "yaw"), ("dimension", "length"),
                              ("dimension", "width"), ("velocity", "x"), ("velocity", "y")):
                    turn = math.remainder(value_of(other, "base", *place) - value_of(one, "base", *place), 2 * math.pi) \
                        if place[1] == "yaw" else value_of(other, "base", *place) - value_of(one, "base", *place)
                    near(turn, 0, f"{name}: change of {place}", 1e-9)
                    count += 1
            check(not after, f"{name}: objects that the trace has not: {list(after)}")
        print(f"traces: {count} numbers of {name}.osi are those of the trace that was read")


with tempfile.TemporaryDirectory() as place_of_files:
    if not os.path.exists(os.path.join(BIN, "glint-osi")) or shutil.which("protoc") is None:
        print("skipped  glint-osi and glint-mcap: they, or protoc, are not there")
    else:
        scenes_by_hand(place_of_files)
        every_number(place_of_files)
        rules_of_osi(place_of_files)
        metadata_of_osi()
        ids_and_times(place_of_files)
        refusals(place_of_files)
        bags_of_ros(place_of_files)
        stamps_of_scans()
        shifts()
        labels_join_by_tables(place_of_files)
        poses_stay(place_of_files)
print(f"traces: {recorded.checks} checks hold")
