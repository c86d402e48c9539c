"""Writes the layouts of nuScenes and of MAN TruckScenes: radar files, and tables of JSON that are linked by tokens."""
import base64
import csv
import hashlib
import json
import math
from collections import namedtuple

import glint
from glint.exports.radar_files import MOVING_MPS, RadarFiles
from glint.exports.streams import boxes, identity, line, number, scans_of, visibility, word
from glint.sets.plan import BAD_DATA, Fault

MOST_POINTS = 1 << 15  # their numbers have 16 bits
BEGIN_US, GAP_US, END_US = 10 ** 15, 10 ** 6, 2 ** 53  # of the first scene; between scenes; of what all readers of JSON can count
UNKNOWN = "visibility_token is empty in {} of {} boxes: of objects out of view, and without --sections visibility of all"
MOTIONS = "ego_motion_cabin", "ego_motion_chassis"

# An object in the world, and what tells whether a point is in its box: no point is whose square of the distance is above reach2.
Box = namedtuple("Box", "id kind x y yaw speed length width height c s reach2")
# The ego and the other objects at the time of a scan.
Moment = namedtuple("Moment", "carrier boxes")
Scan = namedtuple("Scan", "path at channel sensor age_s moment counts")


def token(*names):
    return hashlib.sha256("\0".join(map(str, names)).encode()).hexdigest()[:32]


def quoted(text):
    return json.dumps(text, ensure_ascii=False)


def decimals(*values):
    """Numbers as the rows have them."""
    return ",".join([repr(round(value, 9) + 0.0) for value in values])


def turn(yaw):
    """A rotation about z."""
    return f"[{round(math.cos(yaw / 2), 9) + 0.0},0.0,0.0,{round(math.sin(yaw / 2), 9) + 0.0}]"


def moment_of(frame, age_s):
    found = []
    for one in boxes(frame, age_s):
        length, width, yaw = one["length_m"], one["width_m"], one["yaw_rad"]
        found.append(Box(one["id"], one["class"], one["x_m"], one["y_m"], yaw, math.hypot(one["vx_mps"], one["vy_mps"]),
                         length, width, one["height_m"], math.cos(yaw), math.sin(yaw), (length * length + width * width) / 3.9))
    return Moment(glint.ego(frame, age_s), found)


def points_in(boxes, places):
    """How many of the places lie in each box, of those in which some do."""
    counts = {}
    for box in boxes:
        box_x, box_y, reach2 = box.x, box.y, box.reach2
        for x, y, z in places:
            x, y = x - box_x, y - box_y
            if x * x + y * y <= reach2 and abs(box.c * x + box.s * y) <= box.length / 2 and \
                    abs(box.c * y - box.s * x) <= box.width / 2 and 0 <= z <= box.height:
                counts[box.id] = counts.get(box.id, 0) + 1
    return counts


def to_world(frame, carrier, sensor, places):
    """Places in the axes of a sensor in those of the world, with heights over the road."""
    x0, y0 = glint.to_world(frame, sensor["mount_x_m"], sensor["mount_y_m"], carrier)
    yaw, z0 = carrier["yaw_rad"] + sensor["mount_yaw_rad"], sensor["mount_z_m"]
    c, s = math.cos(yaw), math.sin(yaw)
    return [(x0 + c * x - s * y, y0 + s * x + c * y, z0 + z) for x, y, z in places]


def titles_of(scene, seed):
    """The names that a scene may have: the second one if another seed has the first already."""
    return scene, f"{scene}/{seed}"


def free_title(scene, taken):
    """The first of the names that a scene may have and no earlier one has, or None."""
    return next((name for name in titles_of(*scene) if name not in taken), None)


def path_of(layout, table):
    return f"{layout['version']}/{table}.json"


def lidar_file(layout):
    return f"samples/{layout['lidar']['channel']}/none{layout['lidar']['suffix']}"


def axle_of(scene, carrier):
    """How far ahead of the middle of the ego its rear axle is: known from targets, else as in a usual car."""
    return scene["axle"] or -5 / 18 * carrier["length_m"]


class Writer:
    """Writes frames: the files of a frame at once, the rows of a scene at its end, when all links are known."""

    @staticmethod
    def starts(surveys):
        """For each part, when the last scan before it is, and which titles earlier scenes have of those that its own may have."""
        newest_us, titles = BEGIN_US - GAP_US, set()
        for scenes in surveys:
            yield newest_us, titles.intersection(name for scene in scenes.spans_us for name in titles_of(*scene))
            for scene, (first_us, last_us) in scenes.spans_us.items():
                titles.add(free_title(scene, titles))
                newest_us += GAP_US + last_us - first_us

    def __init__(self, layout, output, start):
        self.layout, self.output, self.radars = layout, output, RadarFiles(layout["point"], layout["fields"].split())
        self.newest_us, self.titles = start
        self.scene, self.splits = None, {}
        self.shared = {}  # rows that are written once, by table and token
        self.newest_of = {}  # time of the last scan of each channel
        self.tables = {name: output.rows(path_of(layout, name)) for name in layout["tables"]}
        self.egos = csv.writer(output.rows("glint-egos.csv"), lineterminator="\n")
        self.before = dict.fromkeys(self.tables, "")

    def rows(self, table, texts):
        """Rows, each a text of JSON."""
        if texts:
            self.tables[table].write(self.before[table] + "\n,".join(texts) + "\n")
            self.before[table] = ","

    def linked(self, table, tokens, texts):
        """Rows that follow each other in time, with their tokens."""
        self.rows(table, [f'{text[:-1]},"prev":"{before}","next":"{after}"}}' for text, before, after in zip(texts, ["", *tokens], [*tokens[1:], ""])])

    def once(self, table, own, text):
        """A row that scenes share; its token."""
        self.shared[table, own] = text
        return own

    def add(self, split, frame):
        if not self.scene or self.scene["identity"] != identity(frame):
            self.end_scene()
        scans = [(sensor, targets, frame["time_s"] - sensor.get("age_s", 0)) for sensor, targets in scans_of(frame)]
        if not self.scene and scans:
            begin_us = self.newest_us + GAP_US - round(1e6 * min(at_s for _, _, at_s in scans))
            self.scene = {"identity": identity(frame), "name": self.title(frame), "token": token(*identity(frame)), "begin_us": begin_us,
                          "frames": [], "axle": None}
            self.splits.setdefault("glint_" + split, []).append(self.scene["name"])  # as devkits keep names like val for their own scenes
        if scans:
            moments = {age_s: moment_of(frame, age_s) for age_s in {sensor.get("age_s", 0) for sensor, _, _ in scans}}
            self.scene["frames"].append((frame, [self.scan(frame, *scan, moments) for scan in scans]))
            for one in frame.pop("targets"):  # kept no longer, as scenes may be long
                self.scene["axle"] = self.scene["axle"] or number(one["quality"]["x_centre_m"] - one["quality"]["x_rear_axle_m"], 3)

    def title(self, frame):
        """The scene's name, by which splits know it: with its seed if another seed has the name already."""
        name = free_title(identity(frame), self.titles)
        if name is None:
            raise Fault(BAD_DATA, f"{frame.place}: {'/'.join(identity(frame))} would be the name of two scenes; expected other names, by --scene of "
                                  "their source")
        self.titles.add(name)
        return name

    def scan(self, frame, sensor, targets, at_s, moments):
        """Writes the file of a scan; what its rows need."""
        at, channel = self.scene["begin_us"] + round(1e6 * at_s), "RADAR_" + word(sensor["name"])
        before, self.newest_of[channel] = self.newest_of.get(channel, 0), at
        self.newest_us = max(self.newest_us, at)
        if len(targets) > MOST_POINTS or not before < at < END_US:
            raise Fault(BAD_DATA, f"{frame.place}: {at_s} s: {len(targets)} targets of {sensor['name']} at {at} us; expected at most {MOST_POINTS}, "
                                  f"1 us or more after the scan before, and before {END_US}")
        path, age_s = f"samples/{channel}/{self.scene['token'][:8]}__{channel}__{at}.pcd", sensor.get("age_s", 0)
        data, places = self.radars.file_of(targets)
        self.output.scan(path, data, frame, sensor, targets)
        counts = points_in(moments[age_s].boxes, to_world(frame, moments[age_s].carrier, sensor, places))
        return Scan(path, at, channel, sensor, age_s, moments[age_s], counts)

    def end_scene(self):
        """A frame in which all sensors have a scan is a sample; other scans are sweeps of the next sample."""
        if not self.scene:
            return
        scene, frames = self.scene, self.scene["frames"]
        channels = sorted({scan.channel for _, scans in frames for scan in scans})
        keys = [i for i, (_, scans) in enumerate(frames) if len(scans) == len(channels)]
        if not keys:
            raise Fault(BAD_DATA, f"{frames[0][0].place}: {scene['name']} has no frame in which all sensors have a scan; expected "
                                  "frames at the rate of their cycles")
        names = {i: token(scene["token"], "sample", frames[i][0]["frame"]) for i in keys}
        newest = [min(scans, key=lambda scan: scan.age_s) for _, scans in frames]
        samples = [(frames[i][0], frames[i][1], newest[i], names[i]) for i in keys]
        self.describe(frames[0][0], [*names.values()])
        self.linked("sample", [*names.values()], [f'{{"token":"{name}","timestamp":{scan.at},"scene_token":"{scene["token"]}"}}'
                                                  for _, _, scan, name in samples])
        sample_of = [names[next((key for key in keys if key >= i), keys[-1])] for i in range(len(frames))]
        for channel in channels:
            self.scans([(frame, scan, sample_of[i], i in names) for i, (frame, scans) in enumerate(frames) for scan in scans if scan.channel == channel])
        self.motion(scene, newest)
        self.empty_lidar(samples)
        self.boxes(samples)
        self.scene = None

    def describe(self, frame, samples):
        """The rows of the scene and of its ego."""
        text = f"simulated, suite {frame['sensors']['suite']}, seed {frame['seed']}"
        self.rows("scene", [line({"token": self.scene["token"], "log_token": "log" * ("log" in self.tables), "nbr_samples": len(samples),
                                  "first_sample_token": samples[0], "last_sample_token": samples[-1], "name": self.scene["name"],
                                  "description": text})[:-1]])
        carrier = glint.ego(frame)
        self.egos.writerow((self.scene["token"], *self.scene["identity"], carrier["id"], carrier["class"],
                            *(float(carrier[name]) for name in ("length_m", "width_m", "height_m")), axle_of(self.scene, carrier)))

    def scans(self, scans):
        """Rows of the scans of a radar, after those of its places and the ego's."""
        tokens = [token(scan.path) for _, scan, _, _ in scans]
        poses, rows, mounts = [], [], {}
        for own, (frame, scan, sample, is_key) in zip(tokens, scans):
            sensor, carrier = scan.sensor, scan.moment.carrier
            axle = axle_of(self.scene, carrier)
            mount = sensor["mount_x_m"] - axle, sensor["mount_y_m"], sensor["mount_z_m"], sensor["mount_yaw_rad"]
            if mount not in mounts:
                mounts[mount] = self.calibrated(scan.channel, "radar", f"[{decimals(*mount[:3])}]", turn(mount[3]))
            poses.append(f'{{"token":"{own}","timestamp":{scan.at},"rotation":{turn(carrier["yaw_rad"])},'
                         f'"translation":[{decimals(*glint.to_world(frame, axle, 0, carrier))},0.0]}}')
            rows.append(f'{{"token":"{own}","sample_token":"{sample}","ego_pose_token":"{own}","calibrated_sensor_token":"{mounts[mount]}",'
                        f'"timestamp":{scan.at},"fileformat":"pcd","is_key_frame":{"true" if is_key else "false"},"height":0,"width":0,'
                        f'"filename":"{scan.path}"}}')
        self.rows("ego_pose", poses)
        self.linked("sample_data", tokens, rows)

    def empty_lidar(self, samples):
        """Rows of a lidar that sees nothing: devkits take the time and the pose of a sample from it."""
        channel = self.layout["lidar"]["channel"]
        mount, tokens = self.calibrated(channel, "lidar", "[0.0,0.0,0.0]", turn(0)), [token(name, channel) for _, _, _, name in samples]
        self.linked("sample_data", tokens, [
            f'{{"token":"{own}","sample_token":"{name}","ego_pose_token":"{token(scan.path)}","timestamp":{scan.at},"calibrated_sensor_token":"{mount}",'
            f'"fileformat":"pcd","is_key_frame":true,"height":0,"width":0,"filename":"{lidar_file(self.layout)}"}}'
            for own, (_, _, scan, name) in zip(tokens, samples)])

    def motion(self, scene, scans):
        """The ego's motion at the middle of its rear axle, in its own axes, where a layout has tables of it; the same for chassis and cabin."""
        if MOTIONS[0] not in self.tables:
            return
        states = []
        for scan in scans:
            carrier = scan.moment.carrier
            x, y = glint.turned(0, carrier["yaw_rate_radps"] * axle_of(scene, carrier), carrier["yaw_rad"])
            states.append((scan.at, carrier["yaw_rad"], carrier["yaw_rate_radps"], carrier["vx_mps"] + x, carrier["vy_mps"] + y))
        rows = []
        for (before, *_, bx, by), (at, yaw, yaw_rate, x, y), (after, *_, ax, ay) in zip(states[:1] + states, states, states[1:] + states[-1:]):
            took_s = max(after - before, 1) / 1e6
            forward, left = glint.turned((ax - bx) / took_s, (ay - by) / took_s, -yaw)
            values = *glint.turned(x, y, -yaw), 0, forward, left, 0, math.remainder(yaw, math.tau), 0, 0, yaw_rate, 0, 0
            names = "vx", "vy", "vz", "ax", "ay", "az", "yaw", "pitch", "roll", "yaw_rate", "pitch_rate", "roll_rate"
            rows.append((at, ",".join(f'"{name}":{number(value)}' for name, value in zip(names, values))))
        for name in MOTIONS:
            self.rows(name, [f'{{"token":"{token(scene["token"], name, at)}","timestamp":{at},{text}}}' for at, text in rows])

    def calibrated(self, channel, modality, translation, rotation):
        """The token of a sensor in its place."""
        sensor, mount = token(channel), f'"translation":{translation},"rotation":{rotation}'
        self.once("sensor", sensor, f'{{"token":"{sensor}","channel":"{channel}","modality":"{modality}"}}')
        own = token(sensor, f"{{{mount}}}\n")
        return self.once("calibrated_sensor", own, f'{{"token":"{own}","sensor_token":"{sensor}","camera_intrinsic":[],{mount}}}')

    def boxes(self, samples):
        """Rows of the objects of a scene, object by object."""
        found = {}
        for frame, scans, newest, sample in samples:
            levels = visibility(frame, [scan.sensor["name"] for scan in scans])
            for box in newest.moment.boxes:
                points = sum([scan.counts.get(box.id, 0) for scan in scans])
                found.setdefault((box.id, box.kind), []).append((sample, box, levels.get(box.id), points))
        for (name, kind), seen in found.items():
            self.instance(name, kind, seen)

    def instance(self, name, kind, seen):
        """Rows of an object."""
        own, (called, *attributes) = token(self.scene["token"], name, kind), self.layout["classes"].get(kind, self.layout["others"])
        if kind not in self.layout["classes"]:
            self.output.note(f"objects of class {kind} are {called}, as the layout has no word for them")
        category = token("category", kind)
        self.once("category", category, f'{{"token":"{category}","name":{quoted(called)},"description":{quoted(kind)}}}')
        standing, moving = (line(attributes[i:][:1])[:-1] for i in (0, 1))
        tokens, rows, place, shape = [token(own, sample) for sample, _, _, _ in seen], [], None, None
        for each, (sample, box, level, points) in zip(tokens, seen):
            if (box.x, box.y, box.yaw, box.length, box.width, box.height) != shape:  # most boxes stand
                shape = box.x, box.y, box.yaw, box.length, box.width, box.height
                place = (f'"translation":[{decimals(box.x, box.y, box.height / 2)}],"rotation":{turn(box.yaw)},'
                         f'"size":[{decimals(box.width, box.length, box.height)}]')
            rows.append(f'{{"token":"{each}","sample_token":"{sample}","instance_token":"{own}","visibility_token":"{"" if level is None else level + 1}",'
                        f'"attribute_tokens":{moving if box.speed >= MOVING_MPS else standing},{place},"num_lidar_pts":0,"num_radar_pts":{points}}}')
        self.output.count(UNKNOWN, sum(level is None for _, _, level, _ in seen), len(seen))
        self.rows("instance", [f'{{"token":"{own}","category_token":"{category}","nbr_annotations":{len(rows)},'
                               f'"first_annotation_token":"{tokens[0]}","last_annotation_token":"{tokens[-1]}"}}'])
        self.output.boxes.writerow((own, *self.scene["identity"], name, kind))
        self.linked("sample_annotation", tokens, rows)

    def close(self):
        """What `finish` needs of this part."""
        self.end_scene()
        return self.shared, self.splits

    @staticmethod
    def finish(layout, folder, parts):
        """Writes what scenes share, when all parts are there."""
        shared, splits = {}, {}
        for rows, of_part in parts:
            shared |= rows
            for split, scenes in of_part.items():
                splits.setdefault(split, []).extend(scenes)
        for name, text in {lidar_file(layout): "", **layout.get("files", {})}.items():
            folder.write(name, base64.b64decode(text))
        for name, constant in layout["tables"].items():
            rows = [line(row)[:-1] for row in constant] + [text for (table, _), text in shared.items() if table == name]
            folder.join(path_of(layout, name), len(parts), "[\n", "\n,".join(rows) + "\n" * bool(rows), ",", "]\n")
        folder.join("glint-egos.csv", len(parts), "token,scene,seed,object,class,length_m,width_m,height_m,rear_axle_x_m\n")
        folder.write(path_of(layout, "splits"), line(splits))
