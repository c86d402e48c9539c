#!/usr/bin/env python3
"""scripts/import makes traffic of boxes and poses, and glint simulates radars for it: tests/chain/imports.py BIN_DIR [TEST...]"""
import csv
import json
import math
import os
import shutil
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from scripts import ENVIRONMENT, SCRIPTS, in_a_fork, shell  # noqa: E402
import glint  # noqa: E402
from glint.imports import nuscenes  # noqa: E402
from sentences import prove  # noqa: E402

os.environ.update(ENVIRONMENT)
CHAIN = "glint-extract | glint-ideal --sections quality --sensors corner77-four | glint-sensor | glint-noise"
ASSUMED = "import: the ego's box is assumed, as no table has it: car, 4.08 x 1.73 m, its rear axle 1.39 m behind the middle\n"


def frames_of(text):
    return [json.loads(line) for line in text.splitlines()]


def imported(*words, status=0):
    found, said = in_a_fork("import", [*words])
    assert found == status and "Traceback" not in said, (words, found, said)
    return said


def a_set(folder, name="set", version="v1.0-mini", **changes):
    """A scene of three key frames at 2 Hz by hand: the ego drives north on a slope at 10 m/s, a car comes, a cone stands. Times of the
    poses are 5 ms after those of the samples, and rows stand as the devkit writes them, on many lines."""
    slope = math.sin(0.05), 0.0, 0.0  # of a quaternion: pitch by 0.1 rad
    north = [math.cos(math.pi / 4) * math.cos(0.05), -math.sin(math.pi / 4) * slope[0], math.cos(math.pi / 4) * slope[0], math.sin(math.pi / 4) * math.cos(0.05)]
    begin = 1532402927647951
    tables = {
        "scene": [{"token": "s", "name": "scene-0061"}], "category": [{"token": "c", "name": "vehicle.car"}, {"token": "t", "name": "movable_object.trafficcone"}],
        "sample": [{"token": f"k{i}", "scene_token": "s", "timestamp": begin + 500_000 * i} for i in range(3)],
        "instance": [{"token": "car", "category_token": "c"}, {"token": "cone", "category_token": "t"}],
        "sample_data": [{"token": f"{of}{i}", "sample_token": f"k{i}", "ego_pose_token": f"{of}{i}", "is_key_frame": of != "sweep",
                         "timestamp": begin + 500_000 * i + after} for i in range(3) for of, after in (("cam", 30_000), ("lidar", 5_000), ("sweep", 0))],
        "ego_pose": [{"token": f"{of}{i}", "translation": [600, 1600 + 10 * (0.5 * i + after), 2], "rotation": north}
                     for i in range(3) for of, after in (("cam", 0.03), ("lidar", 0.005), ("sweep", 0))],
        "sample_annotation": [{"token": f"{of}{i}", "sample_token": f"k{i}", "instance_token": of, "translation": place, "size": [1.9, 4.6, 1.7],
                               "rotation": [0, 0, 0, 1]} for i in range(3) for of, place in (("car", [640 - 8 * 0.5 * i, 1630, 1]), ("cone", [603, 1620, 1]))]}
    root = os.path.join(folder, name)
    os.makedirs(os.path.join(root, version), exist_ok=True)
    for table, rows in (tables | changes).items():
        with open(os.path.join(root, version, table + ".json"), "w", encoding="utf-8") as file:
            file.write(rows if isinstance(rows, str) else json.dumps(rows, indent=0))
    return root, tables


def table(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def an_export_is_read_back(folder):
    """The same objects of the same ids and classes at the same times, within the rounding of the tables; velocities are slopes of
    places. Radars are simulated for them."""
    shell(f"glint-traffic intersection | {CHAIN} > list.jsonl", folder)
    before = frames_of(shell("cat list.jsonl", folder))
    for form in ("nuscenes", "truckscenes"):
        shell(f"{SCRIPTS}/export {form} --out {form} list.jsonl", folder)
        said = imported(form, "--out", folder + "/back-" + form, os.path.join(folder, form))
        assert said == f"import: 1 scenes, {sum(len(frame['objects']) for frame in before)} boxes, the ego's among them\n", said
        after = frames_of(shell(f"glint-traffic back-{form}/intersection_ego.csv --ego ego", folder))
        assert len(before) == len(after) == 201
        for one, other in zip(before, after):
            assert abs(other["time_s"] - 1e9 - one["time_s"]) < 1e-6
            bodies = {body["id"]: body for body in other["objects"]}
            assert bodies.keys() == {body["id"] for body in one["objects"]} and one["ego"] == other["ego"]
            for body in one["objects"]:
                back = bodies[body["id"]]
                assert all(back[name] == body[name] for name in ("class", "length_m", "width_m", "height_m")), (body, back)
                assert math.dist([body[name] for name in ("x_m", "y_m")], [back[name] for name in ("x_m", "y_m")]) < 4e-9
                assert abs(math.remainder(body["yaw_rad"] - back["yaw_rad"], math.tau)) < 4e-9
                assert math.dist([body[name] for name in ("vx_mps", "vy_mps")], [back[name] for name in ("vx_mps", "vy_mps")]) < 0.06
        lists = frames_of(shell(f"glint-traffic back-{form}/intersection_ego.csv --ego ego | {CHAIN}", folder))
        counts = [sum(len(frame["targets"]) for frame in of) for of in (before, lists)]
        assert abs(counts[1] / counts[0] - 1) < 0.05, counts


def boxes_of_a_real_set_become_traffic(folder):
    """The ego's middle is 1.39 m ahead of its pose's origin, at the time of the pose that is nearest to the sample's; its pitch does
    not change its yaw. What categories are is in the layout."""
    root, tables = a_set(folder)
    assert imported("nuscenes", "--out", folder + "/traffic", root) == "import: 1 scenes, 9 boxes, the ego's among them\n" + ASSUMED
    assert os.listdir(folder + "/traffic") == ["scene-0061.csv"]
    rows = table(folder + "/traffic/scene-0061.csv")
    assert [(row["track_id"], row["agent_type"]) for row in rows[::3]] == [("ego", "car"), ("car", "car"), ("cone", "post")]
    for i, row in enumerate(rows):
        numbers = {name: float(row[name]) for name in nuscenes.HEADING if name not in ("track_id", "agent_type")}
        late = 5_000 if row["track_id"] == "ego" else 0
        assert int(row["timestamp_us"]) == tables["sample"][i % 3]["timestamp"] + late
        x, y, vx, vy, yaw, size = {"ego": (600, 1601.44 + 5 * (i % 3), 0, 10, math.pi / 2, (4.08, 1.73, 1.56)), "car": (640 - 4 * (i % 3), 1630, -8, 0, math.pi, (4.6, 1.9, 1.7)),
                                   "cone": (603, 1620, 0, 0, math.pi, (4.6, 1.9, 1.7))}[row["track_id"]]
        found = [numbers[name] for name in ("x", "y", "vx", "vy", "length", "width", "height")]
        assert all(abs(a - b) < 1e-6 for a, b in zip(found, (x, y, vx, vy, *size))), (row, x, y, vx, vy)
        assert abs(math.remainder(numbers["psi_rad"] - yaw, math.tau)) < 1e-8
    frames = frames_of(shell(f"glint-traffic traffic/scene-0061.csv --ego ego --rate-hz 20 | {CHAIN}", folder))
    assert len(frames) == 21 and any(part["object"] == "car" for frame in frames for one in frame["targets"] for part in one["contributors"])
    heights = {body["id"]: body["height_m"] for body in frames[0]["objects"]}
    assert heights == {"ego": 1.56, "car": 1.7, "cone": 1.7}


def between_key_frames_bodies_move_on_cubics(folder):
    """A car at 10 m/s that turns by 0.3 rad/s, kept at 2 Hz and resampled at 20 Hz, is within 5 cm of its way, the ends aside."""
    begin, root = 10 ** 15, os.path.join(folder, "set")
    ways = {"ego": (0, 0, 0.0), "other": (20, 5, 0.3)}

    def place(name, t):
        x, y, rate = ways[name]
        return (x + 10 / rate * math.sin(rate * t), y + 10 / rate * (1 - math.cos(rate * t)), rate * t) if rate else (x + 10 * t, y, 0.0)

    def turn(yaw):
        return [math.cos(yaw / 2), 0, 0, math.sin(yaw / 2)]
    samples = [(f"k{i}", 0.5 * i) for i in range(13)]
    root, _ = a_set(folder, sample=[{"token": name, "scene_token": "s", "timestamp": begin + round(1e6 * t)} for name, t in samples],
                    sample_data=[{"sample_token": name, "ego_pose_token": name, "is_key_frame": True, "timestamp": begin + round(1e6 * t)} for name, t in samples],
                    ego_pose=[{"token": name, "translation": [*place("ego", t)[:2], 0], "rotation": turn(0)} for name, t in samples],
                    sample_annotation=[{"sample_token": name, "instance_token": "car", "translation": [*place("other", t)[:2], 1], "size": [1.9, 4.6, 1.7],
                                        "rotation": turn(place("other", t)[2])} for name, t in samples])
    imported("nuscenes", "--out", folder + "/traffic", root)
    frames = frames_of(shell("glint-traffic traffic/scene-0061.csv --ego ego --rate-hz 20", folder))
    assert len(frames) == 121
    for i, frame in enumerate(frames):
        other = next(body for body in frame["objects"] if body["id"] == "car")
        x, y, yaw = place("other", 0.05 * i)
        off = math.dist((x, y), (other["x_m"] + frame.get("origin_x_m", 0), other["y_m"] + frame.get("origin_y_m", 0)))
        inner = 10 <= i <= 110
        assert off < (0.05 if inner else 0.1), (i, off)
        assert abs(math.remainder(yaw - other["yaw_rad"], math.tau)) < 0.02


def velocities_are_slopes_of_parabolas(_):
    """Of t^2 at uneven times they are exact, at the ends too; beyond 1.5 s there is no neighbour."""
    times = [0, 0.4, 1, 1.5, 2.9]
    for i, t in enumerate(times):
        assert abs(nuscenes.slope(i, [3 * one * one - one for one in times], times) - (6 * t - 1)) < 1e-9, i
    times = [0, 1.6, 2, 4]
    found = [nuscenes.slope(i, [0, 1, 2, 7], times) for i in range(4)]
    assert all(abs(a - b) < 1e-12 for a, b in zip(found, (0, 2.5, 2.5, 0))), found


def tables_are_read_in_pieces(folder):
    """Of any size, also where a row is longer than a piece."""
    rows = [{"token": f"a ä \\ \" {i}", "name": "]" * i} for i in range(40)]
    path = os.path.join(folder, "scene.json")
    for text in (json.dumps(rows), json.dumps(rows, indent=3), " \n " + json.dumps(rows, ensure_ascii=False) + "\n", json.dumps(rows).replace("},", "} \n\t,")):
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        for chunk in (1, 2, 7, 64, 1 << 20):
            nuscenes.CHUNK = chunk
            found = nuscenes.rows_of(path, {"token": glint.NAME, "name": (lambda value: True, "")})
            assert [*found] == rows, chunk
    nuscenes.CHUNK = 1 << 20
    with open(path, "w", encoding="utf-8") as file:
        file.write("[]")
    assert [*nuscenes.rows_of(path, {})] == []


def what_is_no_set_is_refused(folder):
    """With the table, the row, what is there and what is expected; nothing is left behind."""
    good = a_set(folder)[1]

    def changed(table_name, i, **members):
        return [row | members if k == i else row for k, row in enumerate(good[table_name])]
    a_set(folder)
    out = os.path.join(folder, "out")
    for changes, wrong in (
            ({"sample_annotation": changed("sample_annotation", 4, sample_token="k9")}, "sample_annotation.json: sample_token 'k9'; expected a token of sample.json"),
            ({"sample_annotation": changed("sample_annotation", 4, instance_token="x")}, "instance_token 'x'; expected a token of instance.json"),
            ({"sample_annotation": changed("sample_annotation", 2, size=[1, 2])}, "sample_annotation.json: row 3.size: [1, 2]; expected three numbers"),
            ({"sample_annotation": changed("sample_annotation", 0, rotation=[1, 0, 0, "0"])}, "row 1.rotation: [1, 0, 0, '0']; expected a quaternion w, x, y, z"),
            ({"sample_annotation": [*good["sample_annotation"], good["sample_annotation"][0]]}, f"{good['sample_annotation'][0]['instance_token']} is in two boxes at "),
            ({"sample_annotation": "[{}"}, "sample_annotation.json: row 1.sample_token: missing"),
            ({"sample_annotation": json.dumps(good["sample_annotation"])[:-300]}, "sample_annotation.json: row 5: "),
            ({"sample_annotation": json.dumps(good["sample_annotation"])[:-1]}, "sample_annotation.json: row 6: the end; expected , or ]"),
            ({"ego_pose": json.dumps(good["ego_pose"]).replace("600", "NaN", 1)}, "ego_pose.json: row 1: NaN is no value"),
            ({"sample": {"token": "k0"}}, "sample.json: row 0: {; expected ["), ({"scene": "[1, 2]"}, "scene.json: row 1: 1; expected an object"),
            ({"scene": ""}, "scene.json: row 0: the end; expected ["),
            ({"ego_pose": good["ego_pose"][2:]}, "sample_data.json: ego_pose_token 'lidar0'; expected a token of ego_pose.json"),
            ({"category": changed("category", 0, name="vehicle.tank")}, "category.json: vehicle.tank; the layout has no class for it: name one in read.classes of a copy"),
            ({"scene": [*good["scene"], {"token": "t", "name": "scene/0061"}, {"token": "u", "name": "scene_0061"}]}, "scene_0061 and scene/0061 would both be scene_0061.csv")):
        shutil.rmtree(os.path.join(folder, "set"))
        a_set(folder, **changes)
        said = imported("nuscenes", "--out", out, os.path.join(folder, "set"), status=65)
        assert wrong in said and said.startswith("import: ") and said.count("\n") == 1, (wrong, said)
        assert sorted(os.listdir(folder)) == ["set"]
    shutil.rmtree(os.path.join(folder, "set"))
    root, _ = a_set(folder)
    for name, text, wrong in (("boxes", b"box,object\n1,car\n", "glint-boxes.csv: no column 'class'; expected box, object, class"),
                              ("egos", b"\xff\n", "glint-egos.csv: 'utf-8' codec can't decode byte 0xff"),
                              ("egos", b"token,object,class,rear_axle_x_m\ns,ego,car,far\n", "glint-egos.csv: could not convert string to float: 'far'")):
        path = f"{root}/glint-{name}.csv"
        with open(path, "wb") as file:
            file.write(text)
        assert wrong in imported("nuscenes", "--out", out, root, status=65), wrong
        os.remove(path)
    for words, status, wrong in ((["nuscenes", "--out", out, folder + "/no"], 66, "no scene.json; expected one folder of tables"), (["kitti", "--out", out, root], 65, "kitti.json: no read"),
                                 (["nuscenes", "--out", root, root], 73, "is there already"), (["nuscenes", root], 64, "--out"), (["nuscenes", "--out", out], 64, "set"),
                                 (["nuscenes", "--out", out, "--scene", "scene-9", root], 65, "no scene scene-9; it has scene-0061")):
        assert wrong in imported(*words, status=status), words
    os.remove(root + "/v1.0-mini/sample_data.json")
    assert "sample_data.json: No such file or directory; expected the tables of a set" in imported("nuscenes", "--out", out, root, status=66)
    a_set(folder, version="v1.0-test")
    assert "v1.0-mini, " in imported("nuscenes", "--out", out, root, status=66)
    imported("nuscenes", "--out", out, "--scene", "scene-0061", root + "/v1.0-test")


prove((an_export_is_read_back, boxes_of_a_real_set_become_traffic, between_key_frames_bodies_move_on_cubics,
       velocities_are_slopes_of_parabolas, tables_are_read_in_pieces, what_is_no_set_is_refused), sys.argv[2:])
