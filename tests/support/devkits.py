"""The devkits of nuScenes and of MAN TruckScenes, written again from what they demand: their tables, radar files, splits, pictures,
and evaluations of detection and tracking. What raises in them raises here, by the same kind of error."""
import json
import math
import os
import struct

FIELDS = {"nuscenes": "x y z dyn_prop id rcs vx vy vx_comp vy_comp is_quality_valid ambig_state x_rms y_rms invalid_state pdh0 vx_rms vy_rms",
          "truckscenes": "x y z vrel_x vrel_y vrel_z rcs"}
OWN_SPLITS = "train", "val", "test", "mini_train", "mini_val", "train_detect", "train_track"  # of the devkit's own scenes
PEDESTRIANS = "adult", "child", "construction_worker", "police_officer"
COLOURED = {"animal", *("human.pedestrian." + kind for kind in (*PEDESTRIANS, "personal_mobility", "stroller", "wheelchair")),
            *("movable_object." + kind for kind in ("barrier", "debris", "pushable_pullable", "trafficcone")), "static_object.bicycle_rack",
            *("vehicle." + kind for kind in ("bicycle", "bus.bendy", "bus.rigid", "car", "construction", "emergency.ambulance", "emergency.police",
                                             "motorcycle", "trailer", "truck"))}
MORE_COLOURS = {"nuscenes": {"vehicle.ego", *("flat." + kind for kind in ("driveable_surface", "other", "sidewalk", "terrain")),
                             *("static." + kind for kind in ("manmade", "other", "vegetation"))},
                "truckscenes": {"static_object.traffic_sign", "vehicle.train", "vehicle.other", "vehicle.ego_trailer"}}
DETECTED = {**{"vehicle." + kind: kind for kind in ("car", "truck", "trailer", "motorcycle", "bicycle")}, "vehicle.bus.bendy": "bus",
            "vehicle.bus.rigid": "bus", **{"human.pedestrian." + kind: "pedestrian" for kind in PEDESTRIANS},
            "movable_object.barrier": "barrier", "movable_object.trafficcone": "traffic_cone"}
MORE_DETECTED = {"nuscenes": {"vehicle.construction": "construction_vehicle"},
                 "truckscenes": {"vehicle.construction": "other_vehicle", "vehicle.other": "other_vehicle", "animal": "animal",
                                 "static_object.traffic_sign": "traffic_sign"}}
ATTRIBUTES = {"vehicle.moving", "vehicle.parked", "vehicle.stopped", "cycle.with_rider", "cycle.without_rider", "pedestrian.moving",
              "pedestrian.standing", "pedestrian.sitting_lying_down", ""}
RANGES_M = {"nuscenes": {**dict.fromkeys(("car", "truck", "bus", "trailer", "construction_vehicle"), 50),
                         **dict.fromkeys(("pedestrian", "motorcycle", "bicycle"), 40), "traffic_cone": 30, "barrier": 30},
            "truckscenes": {**dict.fromkeys(("pedestrian", "traffic_cone", "barrier", "animal", "traffic_sign"), 75),
                            **dict.fromkeys(("car", "truck", "bus", "trailer", "other_vehicle", "motorcycle", "bicycle"), 150)}}
TRACKED = "bicycle", "bus", "car", "motorcycle", "pedestrian", "trailer", "truck"
DISTANCES_M, ERRORS_AT_M, MOST_BOXES = (0.5, 1, 2, 4), 2, 500
VERSIONS = {"nuscenes": ("v1.0-trainval", "log map", "LIDAR_TOP"),
            "truckscenes": ("v1.1-trainval", "ego_motion_cabin ego_motion_chassis weather_annotation", "LIDAR_LEFT")}


def read_pcd(path, filtered=True):
    """As the devkit of nuScenes reads radar files: its assertions on header and length, fields counted from both ends, and its
    default filter. A list of points, with all fields."""
    with open(path, "rb") as file:
        data = file.read()
    head = data[:data.index(b"DATA")].decode().split("\n")[:-1]
    begin = data.index(b"\n", data.index(b"DATA")) + 1
    kind = data[data.index(b"DATA"):begin].decode().split()[1]
    assert len(head) == 10 and head[0].startswith("#") and head[1].startswith("VERSION") and kind == "binary"
    sizes, types, counts = ([*line.split(" ")[1:]] for line in head[3:6])
    width, height = int(head[6].split(" ")[1]), int(head[7].split(" ")[1])
    assert head[2].split(" ")[1:] == FIELDS["nuscenes"].split() and set(counts) == {"1"} and height == 1 and width > 0
    assert head[9] == f"POINTS {width}" and [head[i].split(" ")[0] for i in (6, 7, 8)] == ["WIDTH", "HEIGHT", "VIEWPOINT"]
    code = "<" + "".join({"F4": "f", "I1": "b", "I2": "h"}[kind + size] for kind, size in zip(types, sizes))
    assert begin + width * struct.calcsize(code) < len(data), "no byte behind the points"
    points = [struct.unpack_from(code, data, begin + i * struct.calcsize(code)) for i in range(width)]
    if any(math.isnan(value) for value in points[0]):
        return []
    keeps = [one for one in points if one[-4] in (0,) and one[3] in range(8) and one[11] in (3,)]
    return keeps if filtered else points


def read_truckscenes(path):
    """By the names of fields, as TruckScenes' reader does."""
    with open(path, "rb") as file:
        head, data = file.read().split(b"\nDATA binary\n", 1)
    words = {line.split()[0]: line.split()[1:] for line in head.decode().split("\n")}
    assert {*FIELDS["truckscenes"].split()} <= {*words["FIELDS"]} and {*words["SIZE"]} == {"4"} and {*words["TYPE"]} == {"F"}
    assert len(data) == 28 * int(words["POINTS"][0]) and words["WIDTH"] == words["POINTS"]
    return list(struct.iter_unpack("<7f", data))


def rotated(rotation, point):
    """A vector turned by a quaternion w, x, y, z."""
    w, x, y, z = rotation
    px, py, pz = point
    cx, cy, cz = y * pz - z * py + w * px, z * px - x * pz + w * py, x * py - y * px + w * pz
    return px + 2 * (y * cz - z * cy), py + 2 * (z * cx - x * cz), pz + 2 * (x * cy - y * cx)


def yaw_of(rotation):
    w, x, y, z = rotation
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def outwards(row, point):
    """From the axes of a calibrated sensor or of an ego's pose to those in which it stands."""
    return tuple(a + b for a, b in zip(rotated(row["rotation"], point), row["translation"]))


def inwards(row, point):
    w, x, y, z = row["rotation"]
    return rotated((w, -x, -y, -z), [a - b for a, b in zip(point, row["translation"])])


class Tables:
    """The tables as the devkits index them; each token of a row must be one of its table."""

    def __init__(self, root, form):
        self.root, self.form, (version, more, self.lidar) = root, form, VERSIONS[form]
        self.names = ("attribute calibrated_sensor category ego_pose instance sample sample_annotation sample_data scene sensor visibility "
                      + more).split()
        self.rows, self.version = {}, os.path.join(root, version)
        for name in self.names:
            with open(os.path.join(self.version, name + ".json"), encoding="utf-8") as file:
                self.rows[name] = json.load(file)
        self.by_token = {name: {row["token"]: row for row in rows} for name, rows in self.rows.items()}
        for name, rows in self.rows.items():
            assert len(self.by_token[name]) == len(rows), f"{name}: a token twice"
        for row in self.rows["sample"]:
            row |= {"data": {}, "anns": []}
        for row in self.rows["sample_data"]:
            sensor = self.of("sensor", self.of("calibrated_sensor", row["calibrated_sensor_token"])["sensor_token"])
            row |= {"channel": sensor["channel"], "modality": sensor["modality"]}
            assert os.path.isfile(os.path.join(root, row["filename"])) and row["filename"].endswith((".pcd", ".pcd.bin"))
            if row["is_key_frame"]:
                self.of("sample", row["sample_token"])["data"][row["channel"]] = row["token"]
        for row in self.rows["sample_annotation"]:
            row["category_name"] = self.of("category", self.of("instance", row["instance_token"])["category_token"])["name"]
            self.of("sample", row["sample_token"])["anns"].append(row["token"])
        if form == "nuscenes":
            maps = {log: row["token"] for row in self.rows["map"] for log in row["log_tokens"]}
            assert all(row["token"] in maps for row in self.rows["log"])
            assert all(os.path.isfile(os.path.join(root, row["filename"])) for row in self.rows["map"])

    def of(self, table, token):
        return self.by_token[table][token]

    def radars(self):
        """The rows of scans of radars."""
        return [row for row in self.rows["sample_data"] if row["modality"] == "radar"]

    def resolve(self):
        for name, rows in self.rows.items():
            for row in rows:
                for key, value in row.items():
                    table = {"first_sample": "sample", "last_sample": "sample", "first_annotation": "sample_annotation",
                             "last_annotation": "sample_annotation"}.get(key[:-6], key[:-6])
                    if key.endswith("_token") and not (key == "log_token" and self.form == "truckscenes" and value == ""):
                        assert value in self.by_token[table] or key == "visibility_token" and value == "", (name, key, value)
                    for one in value if key.endswith("_tokens") else ():
                        assert one in self.by_token[key[:-7]], (name, key, one)
        for name in ("sample", "sample_data", "sample_annotation"):
            for row in self.rows[name]:
                after = self.by_token[name].get(row["next"])
                assert (row["next"] == "") == (after is None) and (after is None or after["prev"] == row["token"])
                if after and name != "sample_annotation":
                    assert after["timestamp"] > row["timestamp"]
        for owner, name, part, number in (("scene", "sample", "sample", "nbr_samples"),
                                          ("instance", "sample_annotation", "annotation", "nbr_annotations")):
            for row in self.rows[owner]:
                walked, at = [], row[f"first_{part}_token"]
                while at:
                    walked.append(at)
                    at = self.of(name, at)["next"]
                assert walked[-1] == row[f"last_{part}_token"] and len(walked) == row[number]

    def points(self, data):
        path = os.path.join(self.root, data["filename"])
        return read_pcd(path, filtered=False) if self.form == "nuscenes" else read_truckscenes(path)

    def to_world(self, data, point):
        """By the mounting and the ego's pose."""
        mount, pose = self.of("calibrated_sensor", data["calibrated_sensor_token"]), self.of("ego_pose", data["ego_pose_token"])
        return outwards(pose, outwards(mount, point[:3]))

    def split(self, name):
        """The names of a split's scenes. Names of the devkit's own splits are of its own scenes alone, and TruckScenes' evaluation
        knows no others, unless its function is replaced, as the page says."""
        if name in OWN_SPLITS:
            return []
        with open(os.path.join(self.version, "splits.json"), encoding="utf-8") as file:
            return json.load(file)[name]

    def samples(self, split):
        scenes = self.split(split)
        return [row["token"] for row in self.rows["sample"] if self.of("scene", row["scene_token"])["name"] in scenes]

    def closest(self, table, at):
        """The row of a table that is nearest in time, among those of all scenes."""
        return sorted(self.rows[table], key=lambda row: abs(row["timestamp"] - at))[0]

    def velocity(self, row):
        """By the places of the annotations before and after; nan where they are too far apart in time."""
        ends = [self.of("sample_annotation", row[key]) if row[key] else row for key in ("prev", "next")]
        took_s = sum(sign * 1e-6 * self.of("sample", one["sample_token"])["timestamp"] for sign, one in zip((-1, 1), ends))
        if ends[0] is ends[1] or took_s > 1.5 * (1 + all(row[key] for key in ("prev", "next"))):
            return math.nan, math.nan
        return tuple((b - a) / took_s for a, b in zip(ends[0]["translation"][:2], ends[1]["translation"][:2]))

    def boxes(self, token, tracking=False):
        """The truth of a sample as evaluations take it, with the number of its points."""
        names = DETECTED | MORE_DETECTED[self.form]
        for row in (self.of("sample_annotation", one) for one in self.of("sample", token)["anns"]):
            name = names.get(row["category_name"])
            if name is None or tracking and name not in TRACKED:
                continue
            attributes = [self.of("attribute", one)["name"] for one in row["attribute_tokens"]]
            if len(attributes) > 1:
                raise ValueError("a box with more than one attribute")
            attribute = attributes[0] if attributes else ""
            assert attribute in ATTRIBUTES, attribute
            yield {"sample_token": token, "translation": row["translation"], "size": row["size"], "rotation": row["rotation"], "name": name,
                   "velocity": self.velocity(row), "attribute": attribute, "points": row["num_lidar_pts"] + row["num_radar_pts"],
                   "track": row["instance_token"], "score": -1.0}

    def near(self, box):
        """Whether a box is in the range of its class, from the ego's place by the lidar's row of its sample."""
        pose = self.of("ego_pose", self.of("sample_data", self.of("sample", box["sample_token"])["data"][self.lidar])["ego_pose_token"])
        place = [a - b for a, b in zip(box["translation"], pose["translation"])]
        return math.hypot(*place[:2]) < RANGES_M[self.form][box["name"]]

    def in_a_rack(self, box):
        racks = (row for row in map(self.by_token["sample_annotation"].get, self.of("sample", box["sample_token"])["anns"])
                 if row["category_name"] == "static_object.bicycle_rack")
        return box["name"] in ("bicycle", "motorcycle") and any(in_box(row, box["translation"]) for row in racks)

    def truth(self, split, tracking=False):
        """The boxes of a split that are scored, by sample."""
        boxes = {token: [*self.boxes(token, tracking)] for token in self.samples(split)}
        if not any(boxes.values()):
            raise ValueError("Invalid box type: None")
        return {token: [box for box in found if self.near(box) and box["points"] and not self.in_a_rack(box)] for token, found in boxes.items()}

    def filtered(self, results, split):
        """Predictions in range; each sample of the split must be there."""
        for token in self.samples(split):
            assert len(results[token]) <= MOST_BOXES
        return {token: [box for box in boxes if self.near(box) and not self.in_a_rack(box)] for token, boxes in results.items()}

    def detection(self, results, split):
        """By class that is in the truth: average precision, and the mean errors of place, size, yaw, velocity and attribute."""
        truth, found = self.truth(split), self.filtered(results, split)
        scores = {}
        for name in sorted({box["name"] for boxes in truth.values() for box in boxes}):
            pairs = {distance: matched(truth, found, name, distance) for distance in DISTANCES_M}
            precisions = [average_precision(hits, count) for hits, count in pairs.values()]
            scores[name] = {"ap": sum(precisions) / len(precisions), **mean_errors(pairs[ERRORS_AT_M][0], name)}
        return scores

    def tracking(self, results, split):
        """AMOTA by class that is in the truth."""
        truth, found = self.truth(split, tracking=True), self.filtered(results, split)
        for boxes in found.values():
            assert all(type(box["track"]) is str and box["name"] in TRACKED for box in boxes)
        return {name: average_accuracy(self.in_time(truth, name), self.in_time(found, name))
                for name in sorted({box["name"] for boxes in truth.values() for box in boxes})}

    def in_time(self, boxes, name):
        """The boxes of a class, in a list for each sample in its order."""
        order = sorted(boxes, key=lambda token: self.of("sample", token)["timestamp"])
        return [[box for box in boxes[token] if box["name"] == name] for token in order]

    def picture(self, token, channel):
        """What is drawn of a radar's sample: points in the lidar's axes with their velocities, and boxes with their colours."""
        sample = self.of("sample", token)
        shown, lidar = (self.of("sample_data", sample["data"][name]) for name in (channel, self.lidar))
        mount, pose = self.of("calibrated_sensor", lidar["calibrated_sensor_token"]), self.of("ego_pose", lidar["ego_pose_token"])
        if self.form == "truckscenes":
            assert self.closest("ego_pose", lidar["timestamp"])["translation"] == pose["translation"]
            for table in ("ego_motion_chassis", "ego_motion_cabin"):
                self.closest(table, shown["timestamp"])
        first = FIELDS[self.form].split().index("vx_comp" if self.form == "nuscenes" else "vrel_x")
        points = [(inwards(mount, inwards(pose, self.to_world(shown, point))), point[first:first + 2]) for point in
                  (read_pcd(os.path.join(self.root, shown["filename"])) if self.form == "nuscenes" else self.points(shown))]
        colours = {name: f"hsl({37 * i % 360},70%,50%)" for i, name in enumerate(sorted(COLOURED | MORE_COLOURS[self.form]))}
        boxes = [(row, inwards(mount, inwards(pose, row["translation"])), colours[row["category_name"]])
                 for row in map(self.by_token["sample_annotation"].get, sample["anns"])]
        return points, boxes


def in_box(row, point, margin=0.0):
    local = inwards(row, point)
    width, length, height = row["size"]
    return all(abs(one) <= side / 2 + margin for one, side in zip(local, (length, width, height)))


def apart_m(one, other):
    return math.dist(one["translation"][:2], other["translation"][:2])


def matched(truth, found, name, distance_m):
    """Predictions of a class by falling score, each with the nearest free box of the truth, or None; and how many boxes there are."""
    free = {token: [box for box in boxes if box["name"] == name] for token, boxes in truth.items()}
    count, hits = sum(map(len, free.values())), []
    predictions = [box for boxes in found.values() for box in boxes if box["name"] == name]
    for box in sorted(predictions, key=lambda box: box["score"])[::-1]:
        nearest = min(free[box["sample_token"]], key=lambda one: apart_m(one, box), default=None)
        if nearest is not None and apart_m(nearest, box) < distance_m:
            free[box["sample_token"]].remove(nearest)
            hits.append((box, nearest))
        else:
            hits.append((box, None))
    return hits, count


def average_precision(hits, count):
    """The mean of the precision above 0.1, at recalls of 0.11 to 1, where it is interpolated; 0 beyond the recall that is reached."""
    curve, true = [], 0
    for i, (_, box) in enumerate(hits):
        true += box is not None
        curve.append((true / count, true / (i + 1)))
    total = 0
    for step in range(11, 101):
        after = next((i for i, (recall, _) in enumerate(curve) if recall >= step / 100), None)
        if after is None:
            continue
        (r1, p1), (r0, p0) = curve[after], curve[max(after - 1, 0)]
        share = (step / 100 - r0) / (r1 - r0) if r1 > r0 else 1
        total += max(p0 + min(share, 1) * (p1 - p0) - 0.1, 0) if share > 0 else max(p0 - 0.1, 0)
    return total / 90 / 0.9


def mean_errors(hits, name):
    pairs = [(one, other) for one, other in hits if other is not None]
    if not pairs:
        return dict.fromkeys(("place", "size", "yaw", "velocity", "attribute"), 1.0)
    period = math.pi if name == "barrier" else math.tau
    errors = {"place": [apart_m(*pair) for pair in pairs], "size": [1 - overlap(*(one["size"] for one in pair)) for pair in pairs],
              "yaw": [abs(math.remainder(yaw_of(one["rotation"]) - yaw_of(other["rotation"]), period)) for one, other in pairs],
              "velocity": [math.dist(one["velocity"], other["velocity"]) for one, other in pairs],
              "attribute": [float(one["attribute"] != other["attribute"]) for one, other in pairs if other["attribute"]]}
    known = {key: [value for value in values if not math.isnan(value)] for key, values in errors.items()}
    return {key: sum(values) / len(values) if values else 0.0 for key, values in known.items()}


def overlap(one, other):
    both = math.prod(map(min, one, other))
    return both / (math.prod(one) + math.prod(other) - both)


def average_accuracy(truth, found):
    """The mean over 40 recalls of the accuracy of tracks above the score that reaches it."""
    count, scores = sum(map(len, truth)), []
    for boxes, predictions in zip(truth, found):
        scores += [box["score"] for box, one, _ in pairs_of(boxes, predictions, {}) if one is not None]
    scores.sort(reverse=True)
    total = 0.0
    for i in range(40):
        recall = 0.1 + 0.9 * i / 39
        needed = math.ceil(recall * count - 1e-9)
        if needed > len(scores):
            continue
        misses, false, switches = errors_of_tracks(truth, found, scores[needed - 1])
        accuracy = 1 - (misses + false + switches - (1 - recall) * count) / (recall * count)
        total += min(max(accuracy, 0), 1)
    return total / 40


def pairs_of(boxes, predictions, known):
    """Predictions with the boxes that they follow within 2 m: first those that did before, then by distance."""
    order = sorted((known.get(box["track"]) != one["track"], apart_m(one, box), i, k) for i, one in enumerate(predictions)
                   for k, box in enumerate(boxes) if apart_m(one, box) < 2)
    taken, free, pairs = set(), set(range(len(boxes))), []
    for switched, _, i, k in order:
        if i not in taken and k in free:
            taken.add(i)
            free.remove(k)
            pairs.append((predictions[i], boxes[k], switched and boxes[k]["track"] in known))
    return pairs + [(one, None, False) for i, one in enumerate(predictions) if i not in taken]


def errors_of_tracks(truth, found, least):
    """Misses, false boxes and switches of identities."""
    known, misses, false, switches = {}, 0, 0, 0
    for boxes, predictions in zip(truth, found):
        pairs = pairs_of(boxes, [one for one in predictions if one["score"] >= least], known)
        hits = [pair for pair in pairs if pair[1] is not None]
        misses, false, switches = misses + len(boxes) - len(hits), false + len(pairs) - len(hits), switches + sum(pair[2] for pair in hits)
        known.update((box["track"], one["track"]) for one, box, _ in hits)
    return misses, false, switches


def as_predictions(truth):
    """Boxes of the truth as a detector or tracker would give them: a track's score is the mean of its numbers of points, over 1000."""
    points = {}
    for box in (box for boxes in truth.values() for box in boxes):
        points.setdefault(box["track"], []).append(box["points"])
    return {token: [box | {"score": sum(points[box["track"]]) / len(points[box["track"]]) / 1000} for box in boxes] for token, boxes in truth.items()}
