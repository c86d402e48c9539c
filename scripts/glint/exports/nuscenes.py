"""Writes the layouts of nuScenes and of MAN TruckScenes: radar files, and tables of JSON that are linked by tokens."""
import base64
import csv
import hashlib
import math
import struct

import glint
from glint.exports.streams import boxes, identity, line, number, scans_of, visibility, word
from glint.sets.plan import BAD_DATA, Fault

NO_POINT = *(math.nan,) * 3, 0, 0, *(math.nan,) * 5, *(0,) * 8  # a scan of nuScenes without targets
MOVING_MPS, MOST_POINTS = 0.5, 1 << 15  # what is slower stands; numbers of points have 16 bits
BEGIN_US, GAP_US, END_US = 10 ** 15, 10 ** 6, 2 ** 53  # of the first scene; between scenes; of what all readers of JSON can count
UNKNOWN = "visibility_token is empty in {} of {} boxes: --sections visibility gives it to those in view"
PDH0 = 0.25, 0.5, 0.75, 0.9, 0.99, 0.999  # limits between the codes 1 to 7 of the probability of a false alarm
MOTIONS = {"ego_motion_cabin", "ego_motion_chassis"}
KINDS = {"f": (4, "F"), "h": (2, "I"), "b": (1, "I")}  # size and type of PCD


def token(*names):
    return hashlib.sha256("\0".join(map(str, names)).encode()).hexdigest()[:32]


def rms_code(deviation):
    """The ARS408's code of a deviation in m or m/s: 0 is below 0.005, each limit is 2000^(1/30) times the one before; 31 is
    10 and more."""
    return min(max(math.floor(30 * math.log(max(deviation, 1e-9) / 0.005) / math.log(2000)) + 1, 0), 31)


def rms_codes(along, along_sd, across_sd, angle):
    c, s = math.cos(angle), math.sin(angle)
    return rms_code(math.hypot(c * along_sd, s * across_sd)), rms_code(math.hypot(s * along_sd, c * across_sd))


def point_of(fields, count, target):
    """The fields of a point. Its velocities are rates along the line of sight, as vectors."""
    quality, angle, r, rate = target["quality"], target["azimuth_rad"], target["range_m"], target["range_rate_mps"]
    (c, s, up), ground, angle_sd = glint.sight(target), quality["range_rate_over_ground_mps"], quality["azimuth_sd_rad"]
    if len(fields) == 7:  # of TruckScenes
        return r * c, r * s, r * up, rate * c, rate * s, rate * up or 0, quality["rcs_dbsm"]
    return (r * c, r * s, r * up, 1 if abs(ground) < MOVING_MPS else 0 if ground > 0 else 2, count, quality["rcs_dbsm"],
            rate * c, rate * s, ground * c, ground * s, 1, 1 if quality.get("ambiguity_number") else 3,
            *rms_codes(r, quality["range_sd_m"], r * angle_sd, angle), 0, 1 + sum(1 - quality["existence"] >= limit for limit in PDH0),
            *rms_codes(rate, quality["range_rate_sd_mps"], abs(rate) * angle_sd, angle))


def radar_file(kinds, fields, points):
    points = points or [NO_POINT] * (len(fields) == len(NO_POINT))
    sizes, types = (" ".join(str(KINDS[kind][i]) for kind in kinds[1:]) for i in (0, 1))
    head = (f"# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS {' '.join(fields)}\nSIZE {sizes}\nTYPE {types}\n"
            f"COUNT{' 1' * len(fields)}\nWIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\nDATA binary\n")
    # The reader of nuScenes asks for a byte behind the data.
    return head.encode() + b"".join(struct.pack(kinds, *point) for point in points) + b"\n" * (len(fields) == len(NO_POINT))


def turn(yaw):
    return [number(math.cos(yaw / 2)), 0.0, 0.0, number(math.sin(yaw / 2))]


def axle_of(scene, carrier):
    """How far ahead of the middle of the ego its rear axle is: known from targets, else as in a usual car."""
    return scene["axle"] or -5 / 18 * carrier["length_m"]


def inside(box, x, y, z):
    x, y = glint.turned(x - box["x_m"], y - box["y_m"], -box["yaw_rad"])
    return abs(x) <= box["length_m"] / 2 and abs(y) <= box["width_m"] / 2 and 0 <= z <= box["height_m"]


class Writer:
    """Writes frames: the files of a frame at once, the rows of a scene at its end, when all links are known."""

    def __init__(self, layout, output):
        self.layout, self.output, self.fields = layout, output, layout["fields"].split()
        self.scene, self.titles, self.splits, self.shared, self.newest_us = None, set(), {}, {}, {}  # the last of each channel
        self.lidar = layout["lidar"] | {"path": f"samples/{layout['lidar']['channel']}/none{layout['lidar']['suffix']}"}
        for name, text in {self.lidar["path"]: "", **layout.get("files", {})}.items():
            output.write(name, base64.b64decode(text))
        self.tables = {name: output.file(f"{layout['version']}/{name}.json") for name in layout["tables"]}
        self.egos = csv.writer(output.file("glint-egos.csv"), lineterminator="\n")
        self.egos.writerow(("token", "scene", "seed", "object", "class", "length_m", "width_m", "height_m", "rear_axle_x_m"))
        self.before = dict.fromkeys(self.tables, "[\n")
        for name, rows in layout["tables"].items():
            self.rows(name, *rows)

    def rows(self, table, *rows):
        for row in rows:
            self.tables[table].write(self.before[table] + line(row))
            self.before[table] = ","

    def linked(self, table, rows):
        """Rows that follow each other in time."""
        tokens = ["", *(row["token"] for row in rows), ""]
        self.rows(table, *(row | {"prev": before, "next": after} for row, before, after in zip(rows, tokens, tokens[2:])))

    def once(self, table, row):
        """A row that scenes share; its token."""
        if self.shared.setdefault(row["token"], row) is row:
            self.rows(table, row)
        return row["token"]

    def add(self, split, frame):
        if not self.scene or self.scene["identity"] != identity(frame):
            self.end_scene()
        scans = [(sensor, targets, frame["time_s"] - sensor.get("age_s", 0)) for sensor, targets in scans_of(frame)]
        if not self.scene and scans:
            begin_us = max(self.newest_us.values(), default=BEGIN_US - GAP_US) + GAP_US - round(1e6 * min(at_s for _, _, at_s in scans))
            self.scene = {"identity": identity(frame), "name": self.title(frame), "token": token(*identity(frame)), "begin_us": begin_us,
                          "frames": [], "axle": None}
            self.splits.setdefault("glint_" + split, []).append(self.scene["name"])  # as devkits keep names like val for their own scenes
        if scans:
            self.scene["frames"].append((frame, [self.scan(frame, *scan) for scan in scans]))
            for one in frame.pop("targets"):  # kept no longer, as scenes may be long
                self.scene["axle"] = self.scene["axle"] or number(one["quality"]["x_centre_m"] - one["quality"]["x_rear_axle_m"], 3)

    def title(self, frame):
        """The scene's name, by which splits know it: with its seed if another seed has the name already."""
        name = "/".join(identity(frame)) if frame["scene"] in self.titles else frame["scene"]
        if name in self.titles:
            raise Fault(BAD_DATA, f"{frame.place}: {name} would be the name of two scenes; expected other names, by --scene of their source")
        self.titles.add(name)
        return name

    def scan(self, frame, sensor, targets, at_s):
        """Writes the file of a scan; what its rows need."""
        at, channel = self.scene["begin_us"] + round(1e6 * at_s), "RADAR_" + word(sensor["name"])
        before, self.newest_us[channel] = self.newest_us.get(channel, 0), at
        if len(targets) > MOST_POINTS or not before < at < END_US:
            raise Fault(BAD_DATA, f"{frame.place}: {at_s} s: {len(targets)} targets of {sensor['name']} at {at} us; expected at most {MOST_POINTS}, "
                                  f"1 us or more after the scan before, and before {END_US}")
        path = f"samples/{channel}/{self.scene['token'][:8]}__{channel}__{at}.pcd"
        points = [point_of(self.fields, i, one) for i, one in enumerate(targets)]
        self.output.scan(path, radar_file(self.layout["point"], self.fields, points), frame, sensor, targets)
        places, age_s = [(*glint.place(frame, one), glint.height(frame, one)) for one in targets], sensor.get("age_s", 0)
        return {"path": path, "at": at, "channel": channel, "sensor": sensor, "age_s": age_s,
                "counts": {box["id"]: sum(inside(box, *place) for place in places) for box in boxes(frame, age_s)}}

    def end_scene(self):
        """A frame in which all sensors have a scan is a sample; other scans are sweeps of the next sample."""
        if not self.scene:
            return
        scene, frames = self.scene, self.scene["frames"]
        channels = sorted({scan["channel"] for _, scans in frames for scan in scans})
        keys = [i for i, (_, scans) in enumerate(frames) if len(scans) == len(channels)]
        if not keys:
            raise Fault(BAD_DATA, f"{frames[0][0].place}: {scene['name']} has no frame in which all sensors have a scan; expected "
                                  "frames at the rate of their cycles")
        names = {i: token(scene["token"], "sample", frames[i][0]["frame"]) for i in keys}
        self.rows("scene", {"token": scene["token"], "log_token": "log" * ("log" in self.tables), "nbr_samples": len(keys),
                            "first_sample_token": names[keys[0]], "last_sample_token": names[keys[-1]], "name": scene["name"],
                            "description": self.described(frames[0][0])})
        carrier = glint.ego(frames[0][0])
        self.egos.writerow((scene["token"], *scene["identity"], *(carrier[name] for name in ("id", "class")),
                            *(float(carrier[name]) for name in ("length_m", "width_m", "height_m")), axle_of(scene, carrier)))
        newest = {i: min(frames[i][1], key=lambda scan: scan["age_s"]) for i in keys}
        self.linked("sample", [{"token": names[i], "timestamp": newest[i]["at"], "scene_token": scene["token"]} for i in keys])
        sample_of = [names[next((key for key in keys if key >= i), keys[-1])] for i in range(len(frames))]
        for channel in channels:
            self.linked("sample_data", [self.data_of(frame, scan, sample_of[i], i in names) for i, (frame, scans) in enumerate(frames)
                                        for scan in scans if scan["channel"] == channel])
        self.motion(scene, [(frame, min(scans, key=lambda scan: scan["age_s"])) for frame, scans in frames])
        self.linked("sample_data", [self.nothing_of(scene, newest[i], names[i]) for i in keys])
        boxed = {}
        for i in keys:
            levels = visibility(frames[i][0], [scan["sensor"]["name"] for scan in frames[i][1]])
            for box in boxes(frames[i][0], newest[i]["age_s"]):
                points = sum(scan["counts"][box["id"]] for scan in frames[i][1])
                boxed.setdefault((box["id"], box["class"]), []).append((names[i], box, levels.get(box["id"]), points))
        for (name, kind), found in boxed.items():
            self.instance(name, kind, found)
        self.scene = None

    def described(self, frame):
        """What a scene is, with the tags of its weather where a layout has such; evaluations find scenes by them."""
        weather, conditions = self.layout.get("weather", {}), frame.get("conditions", {})
        tags = [tag for name, tag in weather.items() if conditions.get(name)] or [*weather.values()][:1]
        separator = ";" if tags else ", "
        return separator.join([*tags, "simulated", f"suite {frame['sensors']['suite']}", f"seed {frame['seed']}"])

    def data_of(self, frame, scan, sample, is_key):
        """The row of a scan, after those of its sensor and its pose."""
        own, sensor, carrier = token(scan["path"]), scan["sensor"], glint.ego(frame, scan["age_s"])
        axle = axle_of(self.scene, carrier)
        mount = [number(sensor["mount_x_m"] - axle), number(sensor["mount_y_m"]), number(sensor["mount_z_m"])]
        calibrated = self.calibrated(scan["channel"], "radar", mount, turn(sensor["mount_yaw_rad"]))
        self.rows("ego_pose", {"token": own, "timestamp": scan["at"], "rotation": turn(carrier["yaw_rad"]),
                               "translation": [*map(number, glint.to_world(frame, axle, 0, carrier)), 0.0]})
        return {"token": own, "sample_token": sample, "ego_pose_token": own, "calibrated_sensor_token": calibrated, "timestamp": scan["at"],
                "fileformat": "pcd", "is_key_frame": is_key, "height": 0, "width": 0, "filename": scan["path"]}

    def nothing_of(self, scene, scan, sample):
        """The row of a lidar that sees nothing: devkits take the time and the pose of a sample from it."""
        calibrated = self.calibrated(self.lidar["channel"], "lidar", [0.0, 0.0, 0.0], turn(0))
        return {"token": token(sample, self.lidar["channel"]), "sample_token": sample, "ego_pose_token": token(scan["path"]), "timestamp": scan["at"],
                "calibrated_sensor_token": calibrated, "fileformat": "pcd", "is_key_frame": True, "height": 0, "width": 0, "filename": self.lidar["path"]}

    def motion(self, scene, frames):
        """The ego's motion at the middle of its rear axle, in its own axes, where a layout has tables of it; the same for chassis and cabin."""
        if not MOTIONS & self.tables.keys():
            return
        states = []
        for frame, scan in frames:
            carrier = glint.ego(frame, scan["age_s"])
            x, y = glint.turned(0, carrier["yaw_rate_radps"] * axle_of(scene, carrier), carrier["yaw_rad"])
            states.append((scan["at"], carrier["yaw_rad"], carrier["yaw_rate_radps"], carrier["vx_mps"] + x, carrier["vy_mps"] + y))
        for (before, *_, bx, by), (at, yaw, yaw_rate, x, y), (after, *_, ax, ay) in zip(states[:1] + states, states, states[1:] + states[-1:]):
            took_s = max(after - before, 1) / 1e6
            vx, vy = glint.turned(x, y, -yaw)
            forward, left = glint.turned((ax - bx) / took_s, (ay - by) / took_s, -yaw)
            row = {"timestamp": at, "vx": vx, "vy": vy, "vz": 0, "ax": forward, "ay": left, "az": 0, "yaw": math.remainder(yaw, math.tau),
                   "pitch": 0, "roll": 0, "yaw_rate": yaw_rate, "pitch_rate": 0, "roll_rate": 0}
            for name in sorted(MOTIONS):
                self.rows(name, {"token": token(scene["token"], name, at)} | {key: value if key == "timestamp" else number(value) for key, value in row.items()})

    def calibrated(self, channel, modality, translation, rotation):
        """The token of a sensor in its place."""
        sensor, mount = token(channel), {"translation": translation, "rotation": rotation}
        self.once("sensor", {"token": sensor, "channel": channel, "modality": modality})
        return self.once("calibrated_sensor", {"token": token(sensor, line(mount)), "sensor_token": sensor, "camera_intrinsic": []} | mount)

    def instance(self, name, kind, found):
        """Rows of an object of a scene."""
        own, (called, *attributes) = token(self.scene["token"], name, kind), self.layout["classes"].get(kind, self.layout["others"])
        if kind not in self.layout["classes"]:
            self.output.note(f"objects of class {kind} are {called}, as the layout has no word for them")
        category = self.once("category", {"token": token("category", kind), "name": called, "description": kind})
        rows = [{"token": token(own, sample), "sample_token": sample, "instance_token": own,
                 "visibility_token": "" if level is None else str(level + 1),
                 "attribute_tokens": attributes[math.hypot(box["vx_mps"], box["vy_mps"]) >= MOVING_MPS:][:1],
                 "translation": [number(box["x_m"]), number(box["y_m"]), number(box["height_m"] / 2)], "rotation": turn(box["yaw_rad"]),
                 "size": [number(box["width_m"]), number(box["length_m"]), number(box["height_m"])],
                 "num_lidar_pts": 0, "num_radar_pts": points} for sample, box, level, points in found]
        self.output.count(UNKNOWN, sum(level is None for _, _, level, _ in found), len(found))
        self.rows("instance", {"token": own, "category_token": category, "nbr_annotations": len(rows),
                               "first_annotation_token": rows[0]["token"], "last_annotation_token": rows[-1]["token"]})
        self.output.boxes.writerow((own, *self.scene["identity"], name, kind))
        self.linked("sample_annotation", rows)

    def close(self):
        self.end_scene()
        for name, file in self.tables.items():
            file.write("]\n" if self.before[name] == "," else "[]\n")
        self.output.write(f"{self.layout['version']}/splits.json", line(self.splits))
