"""One motion, written in every format of recorded traffic: the same frames, and mirrored a mirrored target list. So it is
of mirrored scenarios. The parts of a file that is cut by time have every frame of the whole once.

Usage: python3 tests/chain/same_motion.py BIN_DIR

A format is a row of FORMATS: a function that writes the motion as a file of the format, and what the format says. To
add one, write such a function and such a row.
"""
import json
import math
import os
import random
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import osi_messages  # noqa: E402
import recorded  # noqa: E402
from recorded import BIN, check  # noqa: E402

RATE_HZ = 10
STEPS = 61


def glint(program, *words, data=None):
    done = subprocess.run([os.path.join(BIN, program), *words], input=data, capture_output=True, check=False, timeout=300)
    check(done.returncode == 0, f"{program} {words}: {done.stderr.decode()}")
    return done.stdout


# ---- the motion: every pose in closed form ----------------------------------------------------------


@dataclass
class Pose:
    x: float
    y: float
    yaw: float
    vx: float
    vy: float
    rate: float

    def mirrored(self):
        return Pose(self.x, -self.y, -self.yaw, self.vx, -self.vy, -self.rate)


@dataclass
class User:
    id: str
    kind: str
    length: float
    width: float
    height: float
    first: int
    last: int
    at: object  # the pose at a time

    def pose(self, step):
        return self.at(step / RATE_HZ)

    def mirrored(self):
        return User(self.id, self.kind, self.length, self.width, self.height, self.first, self.last,
                    lambda time_s: self.at(time_s).mirrored())


def straight(x, y, yaw, speed):
    vx, vy = speed * math.cos(yaw), speed * math.sin(yaw)
    return lambda time_s: Pose(x + vx * time_s, y + vy * time_s, yaw, vx, vy, 0)


def circle(x, y, radius, rate):
    """To the left, around (x, y + radius)."""
    def at(time_s):
        turn = rate * time_s
        return Pose(x + radius * math.sin(turn), y + radius * (1 - math.cos(turn)), turn,
                    radius * rate * math.cos(turn), radius * rate * math.sin(turn), rate)
    return at


def lane_change(x, y, speed, begin_s, end_s):
    """3.5 m to the left on half a wave of the sine, along its velocity."""
    wave = math.pi / (end_s - begin_s)
    def at(time_s):
        phase = min(max(wave * (time_s - begin_s), 0), math.pi)
        vy, ay = 1.75 * wave * math.sin(phase), 1.75 * wave * wave * math.cos(phase) * (0 < phase < math.pi)
        return Pose(x + speed * time_s, y + 1.75 * (1 - math.cos(phase)), math.atan2(vy, speed), speed, vy,
                    ay * speed / (speed**2 + vy**2))
    return at


USERS = [
    User("1", "car", 4.5, 1.8, 1.5, 0, STEPS - 1, straight(0, 0, 0, 20)),
    User("2", "car", 4.2, 1.7, 1.4, 0, STEPS - 1, lane_change(40, -3.5, 22, 1, 5)),
    User("3", "truck", 10, 2.5, 3.5, 0, STEPS - 1, straight(150, 8, math.pi, 15)),
    User("4", "motorcycle", 2.2, 0.8, 1.5, 0, STEPS - 1, circle(60, -6, 90, 0.1)),
    User("5", "car", 4.4, 1.8, 1.5, 20, 40, straight(30, 4, 0, 25)),
    User("6", "pedestrian", 0.5, 0.6, 1.8, 0, STEPS - 1, straight(90, -9, 1.2, 1.4)),
    User("7", "car", 4.6, 1.9, 1.5, 0, STEPS - 1, straight(70, 12, 0, 0)),
]


# ---- formats ----------------------------------------------------------------------------------------


@dataclass
class Format:
    """What a format says. A unit is that of the last digit, in SI."""
    name: str
    write: object  # (folder, users): the path of the file
    place_unit: float
    program: str = "glint-traffic"
    options: tuple = ()
    velocity_unit: float = 0  # 0: from places
    yaw_unit: float = 0       # 0: from velocities
    rate_unit: float = 0      # 0: from yaws
    size_unit: float = 0.01   # 0: sizes of its own
    heights: bool = False
    front: float = 0          # the share of the length by which its places lie ahead
    classes: dict = field(default_factory=dict)  # its word for each of our classes
    first_s: float = 0        # the time of step 0


def rows(users):
    """(step, user, pose) by track."""
    for user in users:
        for step in range(user.first, user.last + 1):
            yield step, user, user.pose(step)


def save(folder, name, lines):
    return recorded.save(folder, name, "".join(line + "\n" for line in lines))


def turned_deg(angle_rad):
    return math.degrees(angle_rad) % 360


def interaction(folder, users):
    head = "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width"
    return save(folder, "interaction.csv", [head] + [
        f"{user.id},{step + 1},{step * 1000 // RATE_HZ},{INTERACTION[user.kind]},{at.x:.3f},{at.y:.3f},{at.vx:.3f},"
        f"{at.vy:.3f},{at.yaw:.3f},{user.length:.2f},{user.width:.2f}" for step, user, at in rows(users)])


def highd(folder, users):
    save(folder, "03_recordingMeta.csv", ["id,frameRate,locationId", f"3,{RATE_HZ},1"])
    save(folder, "03_tracksMeta.csv", ["id,width,height,class,drivingDirection"] + [
        f"{user.id},{user.length:.2f},{user.width:.2f},{HIGHD[user.kind]},{1 if user.pose(0).vx < 0 else 2}"
        for user in users])
    return save(folder, "03_tracks.csv", ["frame,id,x,y,width,height,xVelocity,yVelocity,precedingId"] + [
        f"{step + 1},{user.id},{at.x - user.length / 2:.2f},{-at.y - user.width / 2:.2f},{user.length:.2f},"
        f"{user.width:.2f},{at.vx:.2f},{-at.vy:.2f},0" for step, user, at in rows(users)])


def ind(folder, users):
    save(folder, "04_recordingMeta.csv", ["recordingId,locationId,frameRate", f"4,1,{RATE_HZ}.0"])
    save(folder, "04_tracksMeta.csv", ["recordingId,trackId,width,length,class"] + [
        f"4,{user.id},{user.width:.5f},{user.length:.5f},{IND[user.kind]}" for user in users])
    head = "recordingId,trackId,frame,trackLifetime,xCenter,yCenter,heading,width,length,xVelocity,yVelocity,laneletId"
    return save(folder, "04_tracks.csv", [head] + [
        f"4,{user.id},{step},{step - user.first},{at.x:.5f},{at.y:.5f},{turned_deg(at.yaw):.5f},{user.width:.5f},"
        f"{user.length:.5f},{at.vx:.5f},{at.vy:.5f},3;5" for step, user, at in rows(users)])


NGSIM_COLUMNS = ("Vehicle_ID,Frame_ID,Total_Frames,Global_Time,Local_X,Local_Y,Global_X,Global_Y,v_Length,v_Width,"
                 "v_Class,v_Vel,v_Acc,Lane_ID,Preceding,Following,Space_Headway,Time_Headway")
FOOT = 0.3048


def ngsim_lines(users):
    for step, user, at in rows(users):
        front = (at.x + user.length / 2 * math.cos(at.yaw), at.y + user.length / 2 * math.sin(at.yaw))
        yield (f"{user.id},{step + 1},{user.last - user.first + 1},{1118846979700 + step * 1000 // RATE_HZ},"
               f"{-front[1] / FOOT:.3f},{front[0] / FOOT:.3f},6451137.641,1873344.962,{user.length / FOOT:.2f},"
               f"{user.width / FOOT:.2f},{NGSIM[user.kind]},{math.hypot(at.vx, at.vy) / FOOT:.2f},0.00,2,0,0,0.00,0.00")


def ngsim_commas(folder, users):
    return save(folder, "trajectories.csv", [NGSIM_COLUMNS, *ngsim_lines(users)])


def ngsim_blanks(folder, users):
    return save(folder, "trajectories.txt", ["  " + line.replace(",", "     ") for line in ngsim_lines(users)])


ESMINI_COLUMNS = ("Entity_Name [-],Entity_ID [-],Current_Speed [m/s],bb_x [m],bb_y [m],bb_z [m],bb_length [m],bb_width [m],"
                  "bb_height [m],World_Position_X [m],World_Position_Y [m],Vel_X [m/s],Vel_Y [m/s],"
                  "World_Heading_Angle [rad],Heading_Angle_Rate [rad/s],lane_id")


def esmini(folder, users):
    """The reference point is 1.4 m behind the centre, and 0.1 m to its right."""
    head = "Index [-], TimeStamp [s], " + "".join(
        f"#{number} {column}, " for number in range(1, len(users) + 1) for column in ESMINI_COLUMNS.split(","))
    lines = ["esmini GIT REV: N/A", "esmini BUILD VERSION: N/A, client build", f"Number of Vehicles: {len(users)}", head]
    for step in range(STEPS):
        cells = [str(step), f"{step / RATE_HZ:.6f}"]
        for user in users:
            at, cosine, sine = user.pose(step), math.cos(user.pose(step).yaw), math.sin(user.pose(step).yaw)
            back = -1.4 * cosine + 0.1 * sine, -1.4 * sine - 0.1 * cosine
            values = (math.hypot(at.vx, at.vy), 1.4, 0.1, 0.75, user.length, user.width, user.height, at.x + back[0],
                      at.y + back[1], at.vx - at.rate * back[1], at.vy + at.rate * back[0], at.yaw % (2 * math.pi), at.rate)
            there = [user.id, user.id, *(f"{value:.6f}" for value in values), "-2"]
            cells += there if user.first <= step <= user.last else [""] * len(there)
        lines.append(", ".join(cells) + ", ")
    return save(folder, "esmini.csv", lines)


def sumo_rows(users):
    """(step, user, front, angle) by time."""
    for step, user, at in sorted(rows(users), key=lambda row: row[0]):
        front = (at.x + user.length / 2 * math.cos(at.yaw), at.y + user.length / 2 * math.sin(at.yaw))
        yield step, user, at, front, turned_deg(math.pi / 2 - at.yaw)


def sumo_table(folder, users):
    head = "timestep_time;vehicle_angle;vehicle_id;vehicle_speed;vehicle_type;vehicle_x;vehicle_y"
    return save(folder, "fcd.csv", [head] + [
        f"{step / RATE_HZ:.2f};{angle:.6f};{user.id};{math.hypot(at.vx, at.vy):.6f};{SUMO[user.kind]};{front[0]:.6f};"
        f"{front[1]:.6f}" for step, user, at, front, angle in sumo_rows(users)])


def sumo_types(users):
    """Sizes of a table come from the classes alone, those of XML from a file of routes."""
    return ["<routes>"] + [f'<vType id="t{user.id}" vClass="{SUMO[user.kind]}" length="{user.length}" '
                           f'width="{user.width}" height="{user.height}"/>' for user in users] + ["</routes>"]


def sumo_xml(folder, users):
    save(folder, "types.rou.xml", sumo_types(users))
    steps = {step: [] for step in range(STEPS)}
    for step, user, at, front, angle in sumo_rows(users):
        kind = "person" if user.kind == "pedestrian" else "vehicle"
        steps[step].append(f'<{kind} id="{user.id}" x="{front[0]:.6f}" y="{front[1]:.6f}" angle="{angle:.6f}" '
                           f'type="t{user.id}" speed="{math.hypot(at.vx, at.vy):.6f}"/>')
    lines = [f'<timestep time="{step / RATE_HZ:.2f}">{"".join(there)}</timestep>' for step, there in steps.items()]
    return save(folder, "fcd.xml", ["<fcd-export>", *lines, "</fcd-export>"])


def commonroad_state(tag, step, at):
    values = {"orientation": f"{at.yaw:.6f}", "time": step, "velocity": f"{math.hypot(at.vx, at.vy):.6f}",
              "yawRate": f"{at.rate:.6f}"}
    exact = "".join(f"<{name}><exact>{value}</exact></{name}>" for name, value in values.items())
    return f"<{tag}><position><point><x>{at.x:.6f}</x><y>{at.y:.6f}</y></point></position>{exact}</{tag}>"


def commonroad(folder, users):
    lines = [f'<commonRoad timeStepSize="{1 / RATE_HZ}" commonRoadVersion="2020a">']
    for user in users:
        first, *later = [(step, at) for step, who, at in rows(users) if who is user]
        lines += [f'<dynamicObstacle id="{user.id}"><type>{user.kind}</type><shape><rectangle>'
                  f"<length>{user.length}</length><width>{user.width}</width></rectangle></shape>",
                  commonroad_state("initialState", *first), "<trajectory>",
                  *[commonroad_state("state", *state) for state in later], "</trajectory></dynamicObstacle>"]
    return save(folder, "scenario.xml", [*lines, "</commonRoad>"])


def osi(folder, users):
    """Every number whole, with the bits of its double."""
    messages = []
    for step in range(STEPS):
        there = [(user, user.pose(step)) for user in users if user.first <= step <= user.last]
        messages.append(osi_messages.stamp(step * 1_000_000_000 // RATE_HZ) + b"".join(
            osi_messages.moving(int(user.id), OSI[user.kind], at.x, at.y, at.yaw, (user.length, user.width, user.height),
                                (at.vx, at.vy), at.rate) for user, at in there))
    return recorded.save(folder, "trace.osi", osi_messages.trace_of(*messages))


OWN = {kind: kind for kind in ("car", "truck", "motorcycle", "pedestrian")}
INTERACTION = OWN
OSI = {"car": 4, "truck": 7, "motorcycle": 10, "pedestrian": "pedestrian"}
HIGHD = {"car": "Car", "truck": "Truck"}
IND = OWN
NGSIM = {"car": 2, "truck": 3, "motorcycle": 1}
SUMO = dict(OWN, car="passenger")
SUMO_SIZES = {"car": (5, 1.8, 1.5), "truck": (7.1, 2.4, 2.4), "motorcycle": (2.2, 0.9, 1.5),
              "pedestrian": (0.215, 0.478, 1.719)}

FORMATS = [
    Format("INTERACTION", interaction, 1e-3, velocity_unit=1e-3, yaw_unit=1e-3, classes=INTERACTION),
    Format("highD", highd, 1e-2, velocity_unit=1e-2, classes=HIGHD, first_s=1 / RATE_HZ),
    Format("inD", ind, 1e-5, velocity_unit=1e-5, yaw_unit=math.radians(1e-5), size_unit=1e-5, classes=IND),
    Format("NGSIM with commas", ngsim_commas, FOOT * 1e-3, size_unit=FOOT * 1e-2, front=0.5, classes=NGSIM,
           first_s=1118846979.7),
    Format("NGSIM with blanks", ngsim_blanks, FOOT * 1e-3, size_unit=FOOT * 1e-2, front=0.5, classes=NGSIM,
           first_s=1118846979.7),
    Format("esmini", esmini, 1e-6, velocity_unit=1e-6, yaw_unit=1e-6, rate_unit=1e-6, size_unit=1e-6, heights=True,
           classes=OWN),
    Format("SUMO's table", sumo_table, 1e-6, yaw_unit=math.radians(1e-6), size_unit=0, classes=SUMO),
    Format("SUMO's XML", sumo_xml, 1e-6, program="glint-traffic-sumo", options=("--types", "types.rou.xml"),
           yaw_unit=math.radians(1e-6), heights=True, classes=SUMO),
    Format("CommonRoad", commonroad, 1e-6, program="glint-traffic-commonroad", velocity_unit=1e-4, yaw_unit=1e-6,
           rate_unit=1e-6, size_unit=1e-6, classes=OWN),
    Format("OSI", osi, 1e-9, program="glint-traffic-osi", velocity_unit=1e-9, yaw_unit=1e-9, rate_unit=1e-9,
           size_unit=1e-9, heights=True, classes=OSI),
]


# ---- the frames that they must give -----------------------------------------------------------------


def slope(before, middle, after):
    """Of values at steps beside each other; None where there is no step."""
    if before is None and after is None:
        return 0
    if before is None or after is None:
        return ((middle - before) if after is None else (after - middle)) * RATE_HZ
    return (after - before) / 2 * RATE_HZ


def beside(user, step, value):
    """The value at the step before, at this one and at the next."""
    return [value(user.pose(at)) if user.first <= at <= user.last else None for at in (step - 1, step, step + 1)]


def expected(kind, user, step):
    """The pose that a format can give: with differences where it has no more, as the header of the reader says."""
    at = user.pose(step)
    if kind.velocity_unit == 0:
        at.vx, at.vy = (slope(*beside(user, step, value)) for value in (lambda pose: pose.x, lambda pose: pose.y))
    if kind.yaw_unit == 0 and math.hypot(at.vx, at.vy) > 0.1:
        at.yaw += math.remainder(math.atan2(at.vy, at.vx) - at.yaw, 2 * math.pi)
    if kind.rate_unit == 0:
        at.rate = slope(*beside(user, step, lambda pose: pose.yaw))
    return at


def tolerances(kind, user, step, at):
    """Of place, velocity, yaw and yaw rate: what rounding the last digit changes, with that of the size. Where a format
    tells places of the front and no headings, the course is that of the front, which swings out in a curve."""
    speed = math.hypot(at.vx, at.vy)
    ahead = kind.front * user.length
    swing = 1.2 * ahead * max(abs(user.pose(beside).rate) for beside in range(step - 2, step + 3))
    place = 1.5 * kind.place_unit + kind.size_unit / 2
    velocity = kind.velocity_unit + 1.5 * kind.rate_unit or 2 * RATE_HZ * kind.place_unit + swing
    yaw = kind.yaw_unit or (velocity / speed if speed > 0 else 0)
    rate = kind.rate_unit or 2 * RATE_HZ * yaw
    return place + 1.5 * ahead * yaw + 1e-9, velocity + 1e-9, yaw + 1e-9, rate + 1e-9


def compare(kind, users, frames):
    ego = users[0]
    check(len(frames) == ego.last - ego.first + 1, f"{kind.name}: {len(frames)} frames")
    for step, frame in enumerate(frames):
        check(abs(frame["time_s"] - kind.first_s - step / RATE_HZ) < 1e-6, f"{kind.name}: time {frame['time_s']}")
        there = [user for user in users if user.first <= step <= user.last]
        check([part["id"] for part in frame["objects"]] == [user.id for user in there], f"{kind.name}: who is there")
        for user, part in zip(there, frame["objects"]):
            compare_body(kind, user, step, part)


def compare_body(kind, user, step, part):
    at = expected(kind, user, step)
    place, velocity, yaw, rate = tolerances(kind, user, step, at)
    size = (user.length, user.width) if kind.size_unit else SUMO_SIZES[user.kind][:2]
    if not kind.size_unit:  # whose places are of the front bumper, whatever the length is
        shift = (user.length - size[0]) / 2
        at.x, at.y = at.x + shift * math.cos(at.yaw), at.y + shift * math.sin(at.yaw)
        at.vx, at.vy = (at.vx - shift * at.rate * math.sin(at.yaw), at.vy + shift * at.rate * math.cos(at.yaw))
        velocity += abs(shift * at.rate) * 0.2
    what = f"{kind.name}: {user.id} in step {step}: {part}, expected {at}"
    check(part["class"] == user.kind, what)
    check(math.dist((part["x_m"], part["y_m"]), (at.x, at.y)) <= place, "place, " + what)
    check(math.dist((part["vx_mps"], part["vy_mps"]), (at.vx, at.vy)) <= velocity, "velocity, " + what)
    check(abs(math.remainder(part["yaw_rad"] - at.yaw, 2 * math.pi)) <= yaw, "yaw, " + what)
    check(abs(part["yaw_rate_radps"] - at.rate) <= rate, "yaw rate, " + what)
    check(math.dist((part["length_m"], part["width_m"]), size) <= kind.size_unit, "size, " + what)
    check(not kind.heights or part["height_m"] == user.height, "height, " + what)


# ---- mirrors ----------------------------------------------------------------------------------------


def targets_of(frames):
    chain = "glint-extract | glint-ideal --sensors lrr77 | glint-sensor | glint-noise-none"
    lists = glint("glint", "-c", chain, data=frames)
    return [json.loads(line)["targets"] for line in lists.splitlines()]


def mirrors(kind, frames, mirrored_frames):
    """Decisions may fall otherwise where rounding is not symmetric, so a list in a hundred may differ."""
    def key(target, sign):
        return (round(target["range_m"], 2), round(sign * target["azimuth_rad"] + 1e-9, 3), round(target["range_rate_mps"], 1))
    pairs = list(zip(targets_of(frames), targets_of(mirrored_frames), strict=True))
    check(sum(len(plain) for plain, _ in pairs) > len(pairs), f"{kind.name}: {sum(len(plain) for plain, _ in pairs)} targets")
    for step, (plain, mirrored) in enumerate(pairs):
        check(len(plain) == len(mirrored), f"{kind.name}: mirrored, {len(plain)} and {len(mirrored)} targets at {step}")
        for one, other in zip(sorted(plain, key=lambda t: key(t, 1)), sorted(mirrored, key=lambda t: key(t, -1))):
            close = (abs(one["range_m"] - other["range_m"]) < 5 * kind.place_unit + 1e-6 and
                     abs(one["azimuth_rad"] + other["azimuth_rad"]) < kind.place_unit + 1e-5 and
                     abs(one["range_rate_mps"] - other["range_rate_mps"]) < 5 * max(kind.velocity_unit, kind.place_unit) + 1e-5)
            check(close, f"{kind.name}: mirrored, {one} and {other} at {step}")


# ---- parts --------------------------------------------------------------------------------------------


def body_of(line):
    """What a frame says whatever scene it is in: each part is a scene of its own, which begins with frame 0."""
    frame = json.loads(line)
    return {key: value for key, value in frame.items() if key not in ("scene", "frame", "last")}


def parts_have_every_frame_once(kind, path, words, draw):
    """Cuts at random microseconds and at times of frames, at the source's own rate and at others: the parts are the whole."""
    for rate in (None, 2 * RATE_HZ, 7, 3, 1.7, 61.3):
        words_of_rate = [*words, "--ego", "1"] + (["--rate-hz", str(rate)] if rate else [])
        whole = glint(kind.program, path, *words_of_rate).splitlines()
        first, last = (json.loads(line)["time_s"] for line in (whole[0], whole[-1]))
        check(rate is None or len(whole) == math.floor((last - first) * rate + 1e-6) + 1, f"{kind.name}: {len(whole)} frames")
        times = [draw.uniform(first, last), draw.uniform(first, last), json.loads(draw.choice(whole[1:]))["time_s"]]
        cuts = sorted(round(time_s * 1e6) for time_s in times)
        parts = []
        for begin, end in zip([None, *cuts], [*cuts, None]):
            times = ([] if begin is None else ["--from-s", f"{begin / 1e6:.6f}"]) + (
                [] if end is None else ["--to-s", f"{(end - 1) / 1e6:.6f}"])
            done = subprocess.run([os.path.join(BIN, kind.program), path, *words_of_rate, *times], capture_output=True,
                                  check=False, timeout=300)
            check(done.returncode == 0 or b"between --from-s and --to-s" in done.stderr, done.stderr.decode())
            part = done.stdout.splitlines()
            check([json.loads(line)["frame"] for line in part] == list(range(len(part))), f"{kind.name}: numbers of a part")
            check([json.loads(line).get("last", False) for line in part] == [False] * (len(part) - 1) + [True] * (part != []),
                  f"{kind.name}: the last frame of a part")
            parts += part
        check([body_of(line) for line in parts] == [body_of(line) for line in whole],
              f"{kind.name} at {rate} Hz, cut at {cuts} us: {len(parts)} frames of {len(whole)}")


MIRRORED = ("y_m", "offset_m", "yaw_rad", "yaw_rate_radps")
SCENARIOS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "data", "scenarios")


def mirror_of(value, sign=1):
    """A scenario with the other sign of all that points to the left; sign is that of the numbers in value."""
    if isinstance(value, dict):
        return {key: mirror_of(each, -1 if key in MIRRORED else sign) for key, each in value.items()}
    if isinstance(value, list):
        return [mirror_of(each, sign) for each in value]
    return value if isinstance(value, str) or sign > 0 else -value


def mirrors_scenario(name, *words):
    """Traffic of our own, with roads and with distributions, in a mirrored world."""
    kind = Format(name, None, 1e-9)
    with open(os.path.join(SCENARIOS, name + ".json"), encoding="utf-8") as file:
        mirrored = json.dumps(mirror_of(json.load(file)))
    with tempfile.TemporaryDirectory() as folder:
        path = save(folder, name + ".json", [mirrored])
        streams = [glint("glint-traffic", source, *words, "--scene", name)
                   for source in (os.path.join(SCENARIOS, name + ".json"), path)]
    recorded.check_mirrored(*([json.loads(line) for line in stream.splitlines()] for stream in streams))
    mirrors(kind, *streams)


def main():
    written, draw = 0, random.Random(25)
    mirrors_scenario("rush-hour", "--scenes", "0:1", "--radius-m", "150")
    mirrors_scenario("varied-cut-in", "--scenes", "0:5")
    for kind in FORMATS:
        if not os.path.exists(os.path.join(BIN, kind.program)):
            print(f"skipped  the same motion by {kind.program}: it is not there")
            continue
        users = [user for user in USERS if user.kind in kind.classes]
        streams = []
        for world in (users, [user.mirrored() for user in users]):
            with tempfile.TemporaryDirectory() as folder:
                path = kind.write(folder, world)
                words = [os.path.join(folder, word) if os.path.exists(os.path.join(folder, word)) else word
                         for word in kind.options]
                streams.append(glint(kind.program, path, "--ego", "1", *words))
                compare(kind, world, [json.loads(line) for line in streams[-1].splitlines()])
                if world is users:
                    parts_have_every_frame_once(kind, path, words, draw)
        mirrors(kind, *streams)
        written += 1
    print(f"same_motion: {recorded.checks} checks of {written} formats hold")


if __name__ == "__main__":
    main()
