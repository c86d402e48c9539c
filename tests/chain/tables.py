"""Tables of recorded traffic: real files against an independent computation, what files lack, and bad input.

Usage: python3 tests/chain/tables.py BIN_DIR

tests/chain/same_motion.py compares the formats with each other.
"""
import csv
import gzip
import math
import os
import re
import resource
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import recorded  # noqa: E402
from recorded import BIN, DATA, check  # noqa: E402


def play(path, *words, fails=None):
    """The frames; of a failure the message."""
    told = recorded.run("glint-traffic", path, *words, fails=fails)
    return told if fails is None else told[0]


def save(folder, files):
    """Writes files, gzip where the name says so; returns the path of the first."""
    for name, text in files.items():
        bytes_ = text if isinstance(text, bytes) else text.encode("latin-1")
        with open(os.path.join(folder, name), "wb") as file:
            file.write(gzip.compress(bytes_) if name.endswith(".gz") else bytes_)
    return os.path.join(folder, next(iter(files)))


# ---- real files against a computation of their own ----------------------------------------------------


def read(path):
    with (gzip.open if path.endswith(".gz") else open)(path, "rt", encoding="ascii") as file:
        return list(csv.DictReader(file, skipinitialspace=True))


def highd_states(folder, name):
    rate = float(read(f"{folder}/{name}_recordingMeta.csv")[0]["frameRate"])
    tracks = {row["id"]: row for row in read(f"{folder}/{name}_tracksMeta.csv")}
    for row in read(f"{folder}/{name}_tracks.csv"):
        length, width, vx, vy = (float(row[key]) for key in ("width", "height", "xVelocity", "yVelocity"))
        yield (int(row["frame"]) / rate, row["id"], tracks[row["id"]]["class"].lower(), float(row["x"]) + length / 2,
               -float(row["y"]) - width / 2, math.atan2(-vy + 0.0, vx), vx, -vy, length, width)


def ind_states(folder, name):
    rate = float(read(f"{folder}/{name}_recordingMeta.csv")[0]["frameRate"])
    classes = {row["trackId"]: row["class"] for row in read(f"{folder}/{name}_tracksMeta.csv")}
    for row in read(f"{folder}/{name}_tracks.csv.gz"):
        x, y, heading, vx, vy, length, width = (float(row[key]) for key in (
            "xCenter", "yCenter", "heading", "xVelocity", "yVelocity", "length", "width"))
        yield (int(row["frame"]) / rate, row["trackId"], classes[row["trackId"]].replace("truck_bus", "truck"), x, y,
               math.radians(heading), vx, vy, length, width)


def esmini_states(path, classes):
    with open(path, encoding="ascii") as file:
        lines = file.read().splitlines()
    head = next(i for i, line in enumerate(lines) if line.startswith("Index"))
    names = [name.strip() for name in lines[head].split(",")]
    for line in lines[head + 1:]:
        row = dict(zip(names, (cell.strip() for cell in line.split(",")), strict=True))
        for number in range(1, len(names) // 31 + 1):
            def value(name, row=row, number=number):
                return float(row[f"#{number} {name}"])
            name, yaw = row[f"#{number} Entity_Name [-]"], value("World_Heading_Angle [rad]")
            bx, by = value("bb_x [m]"), value("bb_y [m]")
            shift = bx * math.cos(yaw) - by * math.sin(yaw), bx * math.sin(yaw) + by * math.cos(yaw)
            rate = value("Heading_Angle_Rate [rad/s]")
            yield (float(row["TimeStamp [s]"]), name, classes[name], value("World_Position_X [m]") + shift[0],
                   value("World_Position_Y [m]") + shift[1], yaw, value("Vel_X [m/s]") - rate * shift[1],
                   value("Vel_Y [m/s]") + rate * shift[0], value("bb_length [m]"), value("bb_width [m]"))


def compare(frames, states, ego):
    members = ("class", "x_m", "y_m", "yaw_rad", "vx_mps", "vy_mps", "length_m", "width_m")
    steps = {}
    for time, name, *state in states:
        steps.setdefault(round(time, 6), {})[name] = dict(zip(members, state, strict=True))
    recorded.compare([frame | {"time_s": round(frame["time_s"], 6)} for frame in frames], steps, ego, close=1e-9)


def real_files():
    if DATA is None:
        print("skipped  recorded tables: GLINT_TEST_DATA is not set")
        return
    compare(play(f"{DATA}/csv/01_tracks.csv", "--ego", "5"), highd_states(f"{DATA}/csv", "01"), "5")
    compare(play(f"{DATA}/csv/00_tracks.csv.gz", "--ego", "5"), ind_states(f"{DATA}/csv", "00"), "5")
    for name, classes in (("cut-in", {"Ego": "car", "OverTaker": "car"}),
                          ("pedestrian", {"Ego": "car", "pedestrian_adult": "pedestrian"})):
        path = f"{DATA}/esmini/{name}.csv"
        compare(play(path, "--ego", "Ego"), esmini_states(path, classes), "Ego")


# ---- small files of our own -----------------------------------------------------------------------------

HIGHD = {
    "07_tracks.csv": """frame,id,x,y,width,height,xVelocity,yVelocity,precedingId
10,1,100.5,8.0,4.5,2.0,20.0,0.5,0
11,1,101.3,8.02,4.5,2.0,20.0,0.5,0
10,2,50.0,30.0,12.0,2.5,-0.3,0.4,1
11,2,50.0,30.0,12.0,2.5,0.0,0.0,1
""",
    "07_tracksMeta.csv": "id,width,height,class,drivingDirection\n1,4.5,2.0,Car,2\n2,12.0,2.5,Truck,1\n",
    "07_recordingMeta.csv": "id,frameRate,locationId,upperLaneMarkings\n7,25,2,1.0;4.5\n",
}
IND = {
    "18_tracks.csv": """recordingId,trackId,frame,trackLifetime,xCenter,yCenter,heading,width,length,xVelocity,yVelocity,laneletId
18,4,0,0,10.5,-8.25,350.0,1.8,4.5,10.0,0.0,1;2
18,4,1,1,10.9,-8.25,10.0,1.8,4.5,10.0,0.0,1;2
18,5,0,0,5.25,-8.25,0.0,2.2,3.0,10.0,0.0,1
18,5,1,1,5.65,-8.25,0.0,2.2,3.0,10.0,0.0,1
18,6,1,0,30.0,0.0,90.0,0.0,0.0,0.0,1.5,
""",
    "18_tracksMeta.csv": """recordingId,trackId,initialFrame,finalFrame,numFrames,width,length,class
18,4,0,1,2,1.8,4.5,car
18,5,0,1,2,2.2,3.0,trailer
18,6,1,1,1,0.0,0.0,pedestrian
""",
    "18_recordingMeta.csv": "recordingId,locationId,frameRate\n18,1,25\n",
}
INTERACTION = {
    "vehicle_tracks_000.csv": """track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width
1,1,100,car,20.5,-18.5,7.5,-7.5,-0.75,4.1,1.9
1,2,200,car,21.25,-19.25,7.5,-7.5,-0.75,4.1,1.9
2,1,100,car,0.5,-1.5,7.5,0,0.0,4.1,1.9
""",
}
NGSIM_COLUMNS = ("Vehicle_ID,Frame_ID,Total_Frames,Global_Time,Local_X,Local_Y,Global_X,Global_Y,v_Length,v_Width,"
                 "v_Class,v_Vel,v_Acc,Lane_ID,Preceding,Following,Space_Headway,Time_Headway")
NGSIM_ROWS = """2,13,437,1118846980200,16.467,35.381,6451137.641,1873344.962,14.5,4.9,2,40.00,0.00,2,0,0,0.00,0.00
2,14,437,1118846980300,16.447,39.381,6451140.329,1873342.000,14.5,4.9,2,40.00,0.00,2,0,0,0.00,0.00
2,15,437,1118846980400,16.426,43.381,6451143.018,1873339.038,14.5,4.9,2,40.00,0.00,2,0,0,0.00,0.00
9,15,100,1118846980400,40.000,900.000,6451143.018,1873339.038,50.0,8.5,3,30.00,0.00,2,0,0,0.00,0.00
2,16,437,1118846980500,16.426,2000.000,6451143.018,1873339.038,7.0,3.0,1,40.00,0.00,2,0,0,0.00,0.00
"""
NGSIM = {"trajectories.csv": NGSIM_COLUMNS + "\n" + NGSIM_ROWS}
NGSIM_EXPORT = {"export.csv": NGSIM_COLUMNS.replace("v_Length", "v_length").replace(
    "Preceding", "O_Zone,D_Zone,Int_ID,Section_ID,Direction,Movement,Preceding") + ",Location\n" + "".join(
        ",".join([*row.split(",")[:14], *[""] * 6, *row.split(",")[14:], "us-101"]) + "\n"
        for row in NGSIM_ROWS.splitlines())}


def esmini_log():
    columns = ("Entity_Name [-],Entity_ID [-],Current_Speed [m/s],bb_x [m],bb_y [m],bb_z [m],bb_length [m],bb_width [m],"
               "bb_height [m],World_Position_X [m],World_Position_Y [m],Vel_X [m/s],Vel_Y [m/s],"
               "World_Heading_Angle [rad],Heading_Angle_Rate [rad/s],collision_ids").split(",")
    bodies = {"Ego": "Ego,0,10,1.4,0,0.75,5,2,1.5,{x},0,10,0,0,0,", "Ego_trailer": "Ego_trailer,1,10,-1,0,1,4,2,2,{t},0,10,0,0,0,",
              "cyclist": "cyclist,2,3,0,0,1,1.8,0.6,1.7,30,{x},0,3,1.5,0.5,", "walker": "walker,3,1,0,0,1,0.5,0.6,1.8,40,5,0,0,0,0,",
              "lorry": "lorry,4,0,4,0,2,16,2.5,4,60,-4,0,0,3.25,0,"}
    lines = ["esmini GIT REV: N/A", "Scenario File Name: a, b.xosc", "Number of Vehicles: 5", "Index [-], TimeStamp [s], " + "".join(
        f"#{number} {column}, " for number in range(1, 6) for column in columns)]
    for step in range(3):
        cells = [str(step), f"{step * 0.05:.6f}"]
        for name, body in bodies.items():
            text = body.format(x=step * 0.5, t=step * 0.5 - 4.25)
            cells += text.split(",") if name != "walker" or step < 2 else [""] * len(columns)
        lines.append(", ".join(cells) + ", ")
    return "\n".join(lines) + "\n"


ESMINI = {"log.csv": esmini_log()}
SUMO = {
    "fcd.csv": """timestep_time;vehicle_angle;vehicle_id;vehicle_speed;vehicle_type;vehicle_x;vehicle_y
0.00;90.00;1;20.00;passenger;10.00;0.00
0.00;270.00;2;10.00;truck;90.00;4.00
0.50;90.00;1;20.00;passenger;20.00;0.00
""",
}


def by_id(frame):
    return {part["id"]: part for part in frame["objects"]}


def near(part, **values):
    return all(abs(part[key] - value) < 1e-9 for key, value in values.items())


def highd_says(folder):
    """The corner becomes the centre, y points up, and a lorry that creeps keeps to its direction of travel."""
    first, second = play(save(folder, HIGHD), "--ego", "1")
    check(near(first, time_s=0.4, interval_s=0.04) and near(second, time_s=0.44), "25 frames a second")
    car, lorry = by_id(first)["1"], by_id(first)["2"]
    check(near(car, x_m=102.75, y_m=-9, vx_mps=20, vy_mps=-0.5, yaw_rad=math.atan2(-0.5, 20), length_m=4.5, width_m=2),
          f"the car: {car}")
    check(lorry["class"] == "truck" and near(lorry, x_m=56, y_m=-31.25, yaw_rad=math.pi, vx_mps=-0.3, vy_mps=-0.4),
          f"the lorry creeps: {lorry}")
    check(near(by_id(second)["2"], yaw_rad=math.pi, yaw_rate_radps=0), "the lorry stands")


def ind_says(folder):
    """Headings are degrees, sizes of 0 remain for the class, and a trailer is a body of its own behind its car."""
    first, second = play(save(folder, IND), "--ego", "4")
    car, trailer = by_id(first)["4"], by_id(first)["5"]
    check(near(car, x_m=10.5, y_m=-8.25, yaw_rad=math.radians(-10), vx_mps=10), f"the car: {car}")
    check(near(car, yaw_rate_radps=math.radians(20) * 25), "the shorter arc from 350 to 10 degrees")
    check(trailer["class"] == "truck" and near(trailer, length_m=3, width_m=2.2, x_m=5.25), f"the trailer: {trailer}")
    check(list(by_id(second)) == ["4", "5", "6"], "a second body, and a pedestrian")
    check(near(by_id(second)["6"], length_m=0, width_m=0, yaw_rad=math.pi / 2, vy_mps=1.5), "the pedestrian")


def ngsim_says(folder):
    """Feet, front bumper, x along the road and y to its left; times are of the stamp, and ids come again."""
    first, second, third, last = frames = play(save(folder, NGSIM), "--ego", "2")
    foot = 0.3048
    car, lorry = by_id(second)["2"], by_id(third)["9"]
    check(near(first, time_s=1118846980.2) and near(second, interval_s=0.1), "Unix time in milliseconds")
    vy = (16.467 - 16.426) * foot / 0.2
    yaw = math.atan2(vy, 12.192)
    check(math.dist((car["vx_mps"], car["vy_mps"]), (12.192, vy)) < 1e-9, f"40 feet a second: {car}")
    check(math.dist((car["x_m"], car["y_m"]), ((39.381 - 7.25 * math.cos(yaw)) * foot,
                                               (-16.447 - 7.25 * math.sin(yaw)) * foot)) < 1e-9, f"the centre: {car}")
    check(near(car, yaw_rad=yaw, length_m=14.5 * foot, width_m=4.9 * foot), f"the yaw: {car}")
    check(lorry["class"] == "truck" and near(lorry, vx_mps=0, x_m=875 * foot, y_m=-40 * foot),
          f"who is there for one step only: {lorry}")
    check([frame["scene"] for frame in frames] == ["trajectories/2"] * 3 + ["trajectories/2/2"], "an id that comes again")
    check(by_id(last)["2"]["class"] == "motorcycle", "another vehicle of that id")
    export = play(save(folder, NGSIM_EXPORT), "--ego", "2", "--scene", "s")
    check(export == play(save(folder, NGSIM), "--ego", "2", "--scene", "s"), "the other spelling, and more columns")
    lower = NGSIM_COLUMNS.lower() + "\n" + NGSIM_ROWS
    check(export == play(save(folder, {"l.csv": lower}), "--ego", "2", "--scene", "s"), "small letters")
    for sign in (",", "   ", "\t"):
        text = "".join("  " * (sign != ",") + row.replace(",", sign) + "  \r" * (sign != ",") + "\n" for row in NGSIM_ROWS.splitlines())
        check(export == play(save(folder, {"t.txt": text}), "--ego", "2", "--scene", "s"), f"no header, {sign!r}")
    no_stamp = play(save(folder, {"f.csv": NGSIM["trajectories.csv"].replace("Global_Time", "Time")}), "--ego", "2")
    check(near(no_stamp[0], time_s=1.3), "frames of a tenth of a second")


def esmini_says(folder):
    """Boxes around the reference point, classes by box or by name, a trailer as a second body, and who leaves."""
    path = save(folder, ESMINI)
    frames = play(path, "--ego", "Ego")
    check([sorted(by_id(frame)) for frame in frames] ==
          [["Ego", "Ego_trailer", "cyclist", "lorry", "walker"]] * 2 + [["Ego", "Ego_trailer", "cyclist", "lorry"]], "who is there")
    ego, trailer, cyclist, lorry = (by_id(frames[1])[name] for name in ("Ego", "Ego_trailer", "cyclist", "lorry"))
    check(near(ego, x_m=1.9, y_m=0, vx_mps=10, height_m=1.5) and near(trailer, x_m=-4.75, length_m=4), "the trailer is a body")
    check(near(lorry, x_m=60 + 4 * math.cos(3.25), y_m=-4 + 4 * math.sin(3.25)), f"{lorry}")
    check([by_id(frames[0])[name]["class"] for name in ("Ego", "cyclist", "walker", "lorry")] ==
          ["car", "motorcycle", "pedestrian", "truck"], "classes by the box")
    named = play(path, "--ego", "Ego", "--class-map", "cyclist=bicycle,lorry=bus")[0]
    check([by_id(named)[name]["class"] for name in ("Ego", "cyclist", "lorry")] == ["car", "bicycle", "bus"], "by the name")
    for numbers in ((0, 1, 2, 3, 4), (7, 3, 12, 5, 100), (5, 4, 3, 2, 1)):
        text = re.sub("#([1-5]) ", lambda match, numbers=numbers: f"#{numbers[int(match[1]) - 1]} ", ESMINI["log.csv"])
        check(play(save(folder, {"log.csv": text}), "--ego", "Ego") == frames, f"users with the numbers {numbers}")
    plain = ESMINI["log.csv"].split("\n", 3)[3]
    check(play(save(folder, {"log.csv": plain}), "--ego", "Ego") == frames, "without the lines before the header")


def interaction_says(folder):
    """Pedestrians have neither heading nor size, in a file of their own and beside vehicles."""
    head, *rows = INTERACTION["vehicle_tracks_000.csv"].splitlines()
    walker = "P1,{0},{0}00,pedestrian/bicycle,5.0,2.0,0.6,0.8"
    joined = "\n".join([head, *rows, *(walker.format(frame) + ",,," for frame in (1, 2)), ""])
    alone = "\n".join([",".join(head.split(",")[:8]), *(walker.format(frame) for frame in (1, 2)), ""])
    frames = play(save(folder, {"joined.csv": joined}), "--ego", "1")
    check([len(frame["objects"]) for frame in frames] == [3, 2], "who is there")
    for frame in (*frames, *play(save(folder, {"alone.csv": alone}), "--ego", "P1")):
        part = by_id(frame)["P1"]
        check(part["class"] == "pedestrian" and near(part, yaw_rad=math.atan2(0.8, 0.6), length_m=0, width_m=0), f"{part}")
    cases = {"val.csv": "case_id," + head + ",track_to_predict\n" + "".join(
        f"{case},{row},0\n" for case in (1, 2) for row in rows)}
    text = play(save(folder, cases), "--ego", "1", fails=65)
    check('row 5, column "case_id": "2" is another recording; expected that of all rows' in text, text)
    save(folder, cases)
    one = "".join(line for i, line in enumerate(cases["val.csv"].splitlines(True)) if i == 0 or line.startswith("2,"))
    check(play(save(folder, {"one.csv": one}), "--ego", "1", "--scene", "s") ==
          play(save(folder, INTERACTION), "--ego", "1", "--scene", "s"), "one case of several")


def recordings_that_were_joined_are_refused(folder):
    """Two places in one table of NGSIM, two recordings in one of inD: as one scene they would be neither."""
    head, *rows = NGSIM_EXPORT["export.csv"].splitlines()
    check("Location" in head, head)
    other = [row.replace("us-101", "i-80") for row in rows]
    check(other != rows, "another place")
    text = play(save(folder, {"t.csv": "\n".join([head, *rows, *other, ""])}), "--ego", "2", fails=65)
    check(f'row {len(rows) + 2}, column "Location": "i-80" is another recording' in text, text)
    nowhere = [row.replace("us-101", "") for row in rows]
    text = play(save(folder, {"t.csv": "\n".join([head, *nowhere, *rows, ""])}), "--ego", "2", fails=65)
    check('column "Location": "us-101" is another recording' in text, text)
    last = IND["18_tracks.csv"].splitlines()[-1]
    joined = IND | {"18_tracks.csv": IND["18_tracks.csv"].replace(last, "19" + last[2:])}
    text = play(save(folder, joined), "--ego", "4", fails=65)
    check('column "recordingId": "19" is another recording; expected that of all rows' in text, text)


def cut_tables_are_refused(folder):
    """Anywhere in the last row, with its end too: what is left of 1.85 may be 1.8."""
    for files in (HIGHD, IND, INTERACTION, NGSIM, {"t.txt": NGSIM_ROWS.replace(",", "  ")}, ESMINI, SUMO):
        for name, whole in files.items():
            for text in (whole, whole.replace("\n", "\r\n")):
                end = len(text.rstrip("\r\n"))
                for cut in range(text.rstrip().rindex("\n") + 2, end + 1):
                    save(folder, files | {name: text[:cut]})
                    said = play(os.path.join(folder, next(iter(files))), "--ego", "all", fails=65)
                    check(name in said and re.search(r": row \d+: the file ends inside this row; expected a line end", said),
                          f"{name} cut at {cut}: {said}")
        name = next(iter(files))
        packed = save(folder, {name + ".gz": files[name].rstrip(), **{other: files[other] for other in files if other != name}})
        check("the file ends inside this row" in play(packed, "--ego", "all", fails=65), f"{name} as gzip")


def chains(folder):
    """From each format to target lists, as the page of traffic does; and at the bounds of places."""
    for files in (HIGHD, IND, INTERACTION, NGSIM, ESMINI, SUMO):
        path = save(folder, files)
        chain = (f"glint-traffic {path} --ego all --radius-m 150 | glint-extract | glint-ideal --sensors lrr77 "
                 "| glint-sensor | glint-noise --complete")
        done = subprocess.run([os.path.join(BIN, "glint"), "-c", chain], capture_output=True, check=False, timeout=300)
        check(done.returncode == 0, f"{path}: {done.stderr.decode()}")
        check(done.stdout.count(b"\n") == len(play(path, "--ego", "all")), f"{path}: a list for each frame")
    far = dict(HIGHD)
    far["07_tracks.csv"] = far["07_tracks.csv"].replace(",8.0,", ",1e9,").replace(",8.02,", ",1e9,").replace("0.5,0", "0,0")
    frame = play(save(folder, far), "--ego", "1", "--radius-m", "10")[0]
    check(frame["origin_y_m"] == -1e9 and frame["objects"][0]["y_m"] == -1, "a place at its bound")


def files_beside(folder):
    """Plain or gzip, whatever the table is."""
    plain = play(save(folder, IND), "--ego", "4")
    for packed in (("18_tracks.csv",), ("18_tracksMeta.csv", "18_recordingMeta.csv"), tuple(IND)):
        with tempfile.TemporaryDirectory() as place:
            files = {name + ".gz" * (name in packed): text for name, text in IND.items()}
            check(play(save(place, files), "--ego", "4") == plain, f"{packed} as gzip")


def columns_by_name(folder):
    """The order of columns and rows, quotes, and columns that nothing needs change nothing."""
    for files in (HIGHD, IND, INTERACTION, NGSIM, SUMO):
        path = save(folder, files)
        plain = play(path, "--ego", "all")
        lines = open(path, encoding="ascii").read().splitlines()
        sign = ";" if files is SUMO else ","
        table = [line.split(sign)[::-1] + ["\"a, b\"" if i else "more"] for i, line in enumerate(lines)]
        body = table[1:] if files is SUMO else table[:0:-1]
        text = "\r\n".join(sign.join(row) for row in [table[0], *body]) + "\r\n"
        save(folder, {os.path.basename(path): "\ufeff".encode() + text.encode()})
        check(play(path, "--ego", "all") == plain, f"columns of {path} in another order")


# ---- memory ---------------------------------------------------------------------------------------------

ROWS, TRACKS = 300000, 600


def in_memory(path, limit, *words):
    """Does it work with so many bytes of memory?"""
    done = subprocess.run([os.path.join(BIN, "glint-traffic"), path, *words, "-o", "/dev/null"], capture_output=True,
                          check=False, timeout=300,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_DATA, (limit, limit)))
    check(done.returncode in (0, 71), f"{path}: {done.stderr.decode()}")
    return done.returncode == 0


def memory(folder):
    """A table by track takes 64 bytes a row, one by time those of three steps."""
    steps = ROWS // TRACKS
    path = save(folder, {
        "10_tracks.csv": IND["18_tracks.csv"].splitlines()[0] + "\n" + "".join(
            f"10,{track},{step},{step},{step}.25,{track}.5,0.5,1.8,4.5,25.0,0.25,1\n" for track in range(TRACKS)
            for step in range(steps)),
        "10_tracksMeta.csv": "trackId,class\n" + "".join(f"{track},car\n" for track in range(TRACKS)),
        "10_recordingMeta.csv": "frameRate\n25\n"})
    base = 8 << 20
    check(in_memory(path, base + 64 * ROWS, "--ego", "1"), "64 bytes for each row")
    check(not in_memory(path, base, "--ego", "1"), "a limit that is too low")
    path = save(folder, {"fcd.csv": SUMO["fcd.csv"].splitlines()[0] + "\n" + "".join(
        f"{step / 25:.2f};90.00;{track};25.00;passenger;{step}.25;{track}.50\n" for step in range(steps)
        for track in range(TRACKS))})
    check(in_memory(path, base, "--ego", "1", "--radius-m", "100"), "a table by time in constant memory")


# ---- bad input ------------------------------------------------------------------------------------------


def broken(folder, files, name, old, new):
    """The files, one of them changed; new None: without that file."""
    changed = dict(files)
    if new is None:
        del changed[name]
    else:
        check(old in changed[name], f"{old} is in {name}")
        changed[name] = changed[name].replace(old, new, 1)
    for left in os.listdir(folder):
        os.remove(os.path.join(folder, left))
    return save(folder, changed)


def shared_cases(row, x, x_name, id_name, sign=","):
    """What every table refuses. row is its first row as text, x the value of x_name in it."""
    first = row.split(sign)
    empty = sign.join("" if cell == x else cell for cell in first)
    return [
        (row, row.replace(x, "wide"), f'row 2, column "{x_name}": "wide" is not a number'),
        (row, row.replace(x, "nan"), f'row 2, column "{x_name}": "nan" is not a number'),
        (row, row.replace(x, "0x10"), f'row 2, column "{x_name}": "0x10" is not a number'),
        (row, row.replace(x, "2e9"), f'row 2, column "{x_name}": 2e9 is outside [-1e+09, 1e+09]'),
        (row, empty, f'row 2, column "{x_name}": "" is not a number'),
        (row, sign.join(first[:-1]), f"row 2: {len(first) - 1} cells; expected {len(first)} as in the header"),
        (row, row + sign + "1", f"row 2: {len(first) + 1} cells; expected {len(first)} as in the header"),
        (row, row + "\n" + row.replace(x, x + "1"), f"row 3: {id_name} "),
        (row, row.replace(x, 'a"b'), "row 2: a misplaced quote"),
        (row, row.replace(x, '"' + x), "quote opens a cell and nothing closes it"),
        (row, row.replace(x, "\0"), "row 2: a NUL byte; expected text"),
        (x_name, "z", f'column "{x_name}" is missing for a '),
    ]


def beside_cases(stem, id_name, track):
    tracks, recording, table = f"{stem}_tracksMeta.csv", f"{stem}_recordingMeta.csv", f"{stem}_tracks.csv"
    return [
        (tracks, "", None, f"{tracks}: No such file or directory"),
        (recording, "", None, f"{recording}: No such file or directory"),
        (recording, "frameRate", "rate", f'{recording}: column "frameRate" is missing; the header is: '),
        (recording, "25", "fast", f'{recording}: row 2, column "frameRate": "fast" is not a number'),
        (recording, "25", "0", f'{recording}: row 2, column "frameRate": 0 is outside [1, 1e+06]'),
        (recording, "\n", "\n" + "1,25,25\n" if stem == "18" else "\n7,25,2,x\n",
         f"{recording}: row 3: a second recording; expected one"),
        (tracks, "class", "kind", f'{tracks}: column "class" is missing'),
        (tracks, id_name, "number", f'{tracks}: column "{id_name}" is missing'),
        (tracks, track, track + "\n" + track, f"{tracks}: row 3: {id_name} "),
        (tracks, track + "\n", "", f'row 2, column "{id_name}": "'),
        (table, "frame,", "frames,", 'column "frame" is missing'),
    ]


def refused(folder, files, cases, ego):
    """Every case has file or path, row, column or value, and what was expected; the exit code is that of bad data."""
    table = next(iter(files))
    for case in cases:
        name, old, new, message = case if len(case) == 4 else (table, *case)
        path = broken(folder, files, name, old, new)
        code = 66 if "No such file" in message else 65
        text = play(path, "--ego", ego, fails=code)
        check(f"glint-traffic: {folder}" in text and message in text, f"{name}: {old!r} -> {new!r}: {text}")


def bad_input(folder):
    row = HIGHD["07_tracks.csv"].splitlines()[1]
    refused(folder, HIGHD, [
        *shared_cases(row, "100.5", "x", "id"), *beside_cases("07", "id", "1,4.5,2.0,Car,2"),
        (row, row.replace("10,1", "10.5,1"), 'row 2, column "frame": 10.5 is not a whole number'),
        (row, row.replace("10,1", "-1,1"), 'row 2, column "frame": -1 is outside [0, 1e+09]'),
        (row, row.replace("10,1", "10,"), 'row 2, column "id": ""; expected 1 to 1024 printable ASCII characters'),
        (row, row.replace("4.5", "-4.5"), 'row 2, column "width": -4.5 is outside [0, 1e+06]'),
        ("07_tracksMeta.csv", "Car,2", "Car,3", '07_tracksMeta.csv: row 2, column "drivingDirection": 3 is outside [1, 2]'),
        ("07_tracksMeta.csv", "Car", "Ship", 'row 2: unknown class "Ship"; expected a word that --help lists'),
        ("yVelocity", "yVelocity,x", 'columns 3 and 9 are both named "x"'),
    ], "1")
    row = IND["18_tracks.csv"].splitlines()[1]
    refused(folder, IND, [
        *beside_cases("18", "trackId", "18,4,0,1,2,1.8,4.5,car"),
        (row, row.replace("350.0", "3500"), 'row 2, column "heading": 3500 is outside [-1000, 1000]'),
        ("18_tracksMeta.csv", "pedestrian", "drone", 'row 6: unknown class "drone"; expected a word that --help lists'),
        ("heading", "direction", 'column "heading" is missing'),
    ], "4")
    row = INTERACTION["vehicle_tracks_000.csv"].splitlines()[1]
    refused(folder, INTERACTION, [
        *shared_cases(row, "20.5", "x", "track_id"),
        (row, row.replace("car", ""), 'row 2, column "agent_type": ""; expected 1 to 1024 printable'),
        (row, row.replace("car", "ship"), 'row 2: unknown class "ship"; expected a word that --help lists'),
        (",200,", ",200100,", "row 3: a road user moves by 1.06 m in 200 s where its speeds say 2121 m"),
    ], "1")
    row = SUMO["fcd.csv"].splitlines()[1]
    refused(folder, SUMO, [
        *shared_cases(row, "10.00", "vehicle_x", "id", ";"),
        (row, row.replace("90.00", "9e3"), 'row 2, column "vehicle_angle": 9e3 is outside [-1000, 1000]'),
        (row, row.replace("passenger", "ship"), 'row 2: unknown class "ship"; expected a word that --help lists'),
        (row, "1.00;90;9;2;truck;1;1", "row 3: 0 s after a step of 1 s; expected a later time"),
        ("vehicle_angle", "angle", 'column "vehicle_angle" is missing'),
    ], "1")
    row = NGSIM_ROWS.splitlines()[0]
    refused(folder, NGSIM, [
        (row, row.replace("1118846980200", "1118846980200.5"), 'column "Global_Time": 1118846980200.5 is not a whole number'),
        (row, row.replace(",2,40.00", ",4,40.00"), 'row 2: unknown class "4"; expected a word that --help lists'),
        (row, row.replace("14.5", "-14.5"), 'row 2, column "v_Length": -14.5 is outside [0, 1e+09]'),
        ("v_Class", "v_Kind", 'column "v_Class" is missing'),
        ("v_Width", "v_length", 'column "v_Width" is missing'),
    ], "2")
    blanks = {"t.txt": NGSIM_ROWS.replace(",", "  ")}
    refused(folder, blanks, [
        ("35.381", "wide", 'row 1, column "Local_Y": "wide" is not a number'),
        ("39.381", "wide", 'row 2, column "Local_Y": "wide" is not a number'),
        ("39.381", "", "row 2: 17 cells; expected 18 as in the header"),
        ("39.381", "39.381 1", "row 2: 19 cells; expected 18 as in the header"),
    ], "2")
    row = next(line for line in ESMINI["log.csv"].splitlines() if line.startswith("0,"))
    head = next(line for line in ESMINI["log.csv"].splitlines() if line.startswith("Index"))
    x = "#1 World_Position_X [m]"
    refused(folder, ESMINI, [
        (row, row.replace("1.5, 0.0", "1.5, wide"), f'row 5, column "{x}": "wide" is not a number'),
        (row, row.replace("0.000000", "noon"), 'row 5, column "TimeStamp [s]": "noon" is not a number'),
        (row, row.replace("0.000000", "1.000000"), "row 6: 0.05 s after a step of 1 s; expected a later time"),
        (row, row.replace("walker", "Ego"), "row 5: Entity_Name Ego at 0 s is in row 5 already"),
        (row, row[:-2], "row 5: 82 cells; expected 83 as in the header"),
        (row, row + "1, ", "row 5: 84 cells; expected 83 as in the header"),
        (row, row.replace("5, 2, 1.5", "-5, 2, 1.5"), 'row 5, column "#1 bb_length [m]": -5 is outside [0, 1e+06]'),
        (head, head.replace(x, "#1 x"), f'column "{x}" or "#1 World_Position_X [-]" is missing'),
        (head, head.replace("#4 bb_x", "#4 bx"), 'column "#4 bb_x [m]" is missing'),
        (head, head.replace("#1 Entity_Name", "#0 Entity_Name"), '"#0 World_Position_X [m]" or'),
        (head, head.replace("#4 Entity_Name", "#4 Name"), '"#4 Entity_Name [-]" or'),
        (head, head.replace(x, "#1 bb_x [m]"), 'are both named "#1 bb_x [m]"'),
    ], "Ego")
    path = save(folder, {"whatever.csv": HIGHD["07_tracks.csv"]})
    check("expected a table named NN_tracks.csv" in play(path, "--ego", "1", fails=65), "a table of another name")
    save(folder, {"empty.csv": ""})
    check("the table is empty" in play(os.path.join(folder, "empty.csv"), "--ego", "1", fails=65), "an empty table")


def main():
    real_files()
    for test in (highd_says, ind_says, ngsim_says, esmini_says, interaction_says, recordings_that_were_joined_are_refused,
                 cut_tables_are_refused, chains, files_beside, columns_by_name, memory, bad_input):
        with tempfile.TemporaryDirectory() as folder:
            test(folder)
    print(f"tables: {recorded.checks} checks hold")


main()
