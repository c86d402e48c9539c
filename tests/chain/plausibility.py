"""Recordings that contradict themselves, in every format of same_motion.py: places, speeds, times and yaws.

Usage: python3 tests/chain/plausibility.py BIN_DIR

A fault changes the poses of all users, or of one; the formats that state what it changes must notice.
"""
import copy
import json
import math
import os
import random
import struct
import subprocess
import sys

sys.dont_write_bytecode = True
here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(here, "..", "support"), here]
import recorded  # noqa: E402
import same_motion as motion  # noqa: E402
from recorded import DATA, check, run  # noqa: E402
from same_motion import Pose, User, circle, straight  # noqa: E402
from sentences import prove  # noqa: E402

STATED = [kind for kind in motion.FORMATS if not kind.name.startswith("NGSIM")]  # formats that state speeds
YAWS = [kind for kind in STATED if kind.name not in ("highD", "SUMO's table", "SUMO's XML")]  # and yaws in any unit


def car(name, at, kind="car"):
    return User(name, kind, 4.5, 1.8, 1.5, 0, motion.STEPS - 1, at)


def traffic():
    """Two cars that drive, one of them in a curve, a truck that comes towards them, and a car that stands."""
    return [car("1", straight(0, 0, 0, 15)), car("2", circle(20, 3.5, 40, 0.2)),
            car("3", straight(200, 8, math.pi, 12), "truck"), car("4", straight(60, -4, 0, 0))]


def changed(users, change, only=None):
    """The users with poses that change(pose, time_s) alters in place; only names the one it alters."""
    out = []
    for user in users:
        def at(time_s, user=user):
            pose = copy.copy(user.at(time_s))
            if only is None or user.id == only:
                change(pose, time_s)
            return pose
        out.append(User(user.id, user.kind, user.length, user.width, user.height, user.first, user.last, at))
    return out


def scaled(**factors):
    def change(pose, _):
        for name, factor in factors.items():
            setattr(pose, name, getattr(pose, name) * factor)
    return change


def write(kind, folder, users, rate_hz=10, steps=41):
    """The path of the users' motion as a file of the format, and the words of its options."""
    motion.RATE_HZ, motion.STEPS = rate_hz, steps
    for user in users:
        user.last = steps - 1
    path = kind.write(folder, users)
    return path, [os.path.join(folder, word) if word.endswith(".xml") else word for word in kind.options]


def frames_of(kind, folder, users, *words, **sampling):
    """The frames, and what stderr says."""
    path, options = write(kind, folder, users, **sampling)
    done = subprocess.run([os.path.join(recorded.BIN, kind.program), path, "--ego", "1", *options, *words],
                          capture_output=True, check=False, timeout=recorded.PATIENCE_S)
    check(done.returncode == 0, f"{kind.name}: {done.stderr.decode()}")
    return [json.loads(line) for line in done.stdout.splitlines()], done.stderr.decode()


def refuses(kind, folder, users, *said, **sampling):
    """Tables and scenarios, which are stored whole, are refused before the first frame."""
    path, options = write(kind, folder, users, **sampling)
    text, frames = run(kind.program, path, "--ego", "1", *options, fails=65)
    check(f"{path}: " in text and all(word in text for word in said), f"{kind.name}: {text}")
    by_time = kind.name in ("esmini", "SUMO's table", "SUMO's XML", "OSI")
    check(by_time or frames == 0, f"{kind.name}: {frames} frames before the message")


def true_recordings_stay_whole(folder):
    """At 25, 10 and 1 Hz: drives, curves, reversing, sliding, walkers that turn round, and noise of places and velocities."""
    draw = random.Random(37)
    def noise(places_m, velocities_mps):
        def change(pose, _):
            pose.x, pose.y = pose.x + draw.gauss(0, places_m), pose.y + draw.gauss(0, places_m)
            pose.vx, pose.vy = pose.vx + draw.gauss(0, velocities_mps), pose.vy + draw.gauss(0, velocities_mps)
        return change
    def round_again(time_s):
        phase = time_s % 4
        side = 1 if phase < 2 else -1
        return Pose(30 + 1.4 * min(phase, 4 - phase), -6, 0 if side > 0 else math.pi, 1.4 * side, 0, 0)
    others = [car("5", lambda time_s: Pose(90 - 3 * time_s, -8, 0, -3, 0, 0)),
              car("6", lambda time_s: Pose(20 + 8 * time_s, 14, math.pi / 2, 8, 0, 0))]
    for rate_hz, steps in ((25, 101), (10, 61), (1, 31)):
        for kind in motion.FORMATS:
            users = traffic() + (others if kind in STATED and "SUMO" not in kind.name else [])
            if "pedestrian" in kind.classes and "SUMO" not in kind.name:
                users.append(User("7", "pedestrian", 0.5, 0.6, 1.8, 0, 0, round_again))
            _, said = frames_of(kind, folder, users, rate_hz=rate_hz, steps=steps)
            check(said == "", f"{kind.name} at {rate_hz} Hz: {said}")
            for noises in ((0.3, 0), (0.6, 1), (1, 0), (1, 1.5)):
                if kind.name in ("INTERACTION", "inD", "CommonRoad", "OSI"):
                    _, said = frames_of(kind, folder, changed(users, noise(*noises)), rate_hz=rate_hz, steps=steps)
                    check(said == "", f"{kind.name} with noise of {noises} at {rate_hz} Hz: {said}")


def denied_ways_begin_visits(folder):
    """A car that stands and one that drives are 14.6 m aside from 2 s to 4 s: no velocity is that of the gap."""
    def aside(pose, time_s):
        pose.y += 14.6 if 1.99 < time_s < 3.99 else 0
    for kind in STATED:
        for rate_hz, steps, name in ((10, 61, "4"), (10, 61, "1"), (1, 31, "4"), (1, 31, "1")):
            for words in ((), ("--rate-hz", "20")):
                frames, said = frames_of(kind, folder, changed(traffic(), aside, name), "--ego", name, *words,
                                         rate_hz=rate_hz, steps=steps)
                check(len({frame["scene"] for frame in frames}) == 3, f"{kind.name}: scenes of {name}")
                check(sum(frame.get("last", False) for frame in frames) == 3, f"{kind.name}: visits of {name} end")
                for frame in frames:
                    part = next(part for part in frame["objects"] if part["id"] == name)
                    speed = math.hypot(part["vx_mps"], part["vy_mps"])
                    check(speed < (0.1 if name == "4" else 15.1), f"{kind.name}: {speed} m/s of {name} at {frame['time_s']} s")
                    check(part["travelled_m"] < 15.1 * steps / rate_hz, f"{kind.name}: distance of {name}")
                times = ("(2 times), farther than its speed allows (0)" if name == "4" else
                         "(0 times), farther than its speed allows (2)")
                check(times in said, f"{kind.name}, {name}: {said}")


def contradictions_are_refused(folder):
    """Long and short recordings, of many steps a second and of one."""
    degree = 111320
    for rate_hz, steps in ((10, 61), (10, 10), (1, 31), (1, 6)):
        for kind in STATED:
            for factors, text in (({"vx": 3.6, "vy": 3.6}, "3.6 times as far, as with speeds in km/h"),
                                  ({"vx": 2.237, "vy": 2.237}, "2.24 times as far, as with speeds in miles/h"),
                                  ({"vx": 0, "vy": 0}, "")):
                refuses(kind, folder, changed(traffic(), scaled(**factors)), "where their speeds say", text, rate_hz=rate_hz,
                        steps=steps)
            if kind.place_unit < 1e-4 and "SUMO" not in kind.name:  # whose writer puts the front ahead in metres
                refuses(kind, folder, changed(traffic(), scaled(x=1 / degree, y=1 / degree)), "as with places in degrees",
                        rate_hz=rate_hz, steps=steps)


def yaws_in_degrees_are_refused(folder):
    """Also of two cars that drive in one direction, whichever it is."""
    kinds = [kind for kind in YAWS if kind.name in ("INTERACTION", "CommonRoad", "OSI")]
    degrees = scaled(yaw=180 / math.pi)
    for kind in kinds:
        for rate_hz, steps in ((10, 10), (1, 10)):
            for direction in (-170, -135, -90, -30, 20, 45, 90, 135, 180, 270):
                yaw = math.radians(direction)
                users = [car("1", straight(0, 0, yaw, 15)), car("2", straight(-9, 20, yaw, 12)),
                         car("4", straight(60, -4, 0, 0))]
                refuses(kind, folder, changed(users, degrees), "as with degrees that are taken for radians", rate_hz=rate_hz,
                        steps=steps)


def yaws_counted_the_other_way_are_refused(folder):
    """Clockwise from north or from x, of two cars that drive in one direction; SUMO's first versions began at south."""
    users = [car("1", straight(0, 0, 0.6, 15)), car("2", straight(-9, 20, 0.6, 12)), car("4", straight(60, -4, 0, 0))]
    def compass(pose, _):
        pose.yaw = math.pi / 2 - pose.yaw
    for kind in YAWS:
        refuses(kind, folder, changed(users, scaled(yaw=-1)), "as with yaws clockwise from x", steps=101)
        if kind.name != "CommonRoad":  # whose velocities follow the yaws
            users[0].at, users[1].at = straight(0, 0, 0.1, 15), straight(-9, 20, 0.1, 12)
            refuses(kind, folder, changed(users, compass), "as with yaws clockwise from north", steps=101)
            users[0].at, users[1].at = straight(0, 0, 0.6, 15), straight(-9, 20, 0.6, 12)
    north = [car("1", straight(0, 0, math.pi / 2, 15))]
    for kind in STATED:
        if "SUMO" in kind.name:
            refuses(kind, folder, changed(north, scaled(yaw=-1)), "as with yaws clockwise from x", "SUMO wrote 180 minus these")


def parked_vehicles_leave_their_lane(folder):
    """A way of 3.2 m aside within one lane is a new visit, be it parallel or aslant; to another lane it is spread, and so is
    one of a vehicle that drives."""
    def step(time, lane, aside, angle, speed):
        y = 3.2 * aside - 1.6
        return (f'<timestep time="{time}"><vehicle id="a" x="{5 * time}" y="1.6" angle="90" speed="5" type="passenger" '
                f'lane="in_1"/><vehicle id="b" x="{60 + speed * time}" y="{y}" angle="{angle}" speed="{speed}" type="passenger" lane="{lane}"/>'
                "</timestep>", f"{time};5;a;{5 * time};1.6;90;in_1\n{time};{speed};b;{60 + speed * time};{y};{angle};{lane}\n")
    for dt in (0.1, 1):
        for other, angle, speed, visits in (("in_0", 90, 0, 2), ("in_0", 30, 0, 2), ("in_1", 90, 0, 1), ("in_0", 90, 5, 1)):
            steps = [step(i * dt, other if i >= 5 else "in_0", i >= 5, angle if i >= 5 else 90, speed) for i in range(10)]
            xml, table = os.path.join(folder, "park.xml"), os.path.join(folder, "park.csv")
            with open(xml, "w", encoding="ascii") as file:
                file.write("<fcd-export>" + "".join(one for one, _ in steps) + "</fcd-export>")
            with open(table, "w", encoding="ascii") as file:
                file.write("time;speed;id;x;y;angle;lane\n" + "".join(one for _, one in steps))
            for program, path in (("glint-traffic-sumo", xml), ("glint-traffic", table)):
                frames = run(program, path, "--ego", "b")
                check(len({frame["scene"] for frame in frames}) == visits, f"{path}: visits of {other} at {dt} s")
                fastest = max(math.hypot(part["vx_mps"], part["vy_mps"]) for frame in frames for part in frame["objects"]
                              if part["id"] == "b")
                check(fastest < 1e-6 if visits == 2 else 0.5 < fastest < 1.7 + speed, f"{path}: {fastest} m/s, {other} at {dt} s")


def table(folder, users, stamp, change=lambda rows: rows):
    """A table of INTERACTION of 4 s in which every user has a row each 0.1 s, at stamp(number, step)."""
    path = os.path.join(folder, "own.csv")
    rows = []
    for number, user in enumerate(users):
        for step in range(40):
            time_s = stamp(number, step)
            at = user.at(time_s)
            rows.append(f"{user.id},{1000000 * time_s:.0f},car,{at.x:.4f},{at.y:.4f},{at.vx:.4f},{at.vy:.4f},{at.yaw:.4f},4.5,1.8\n")
    with open(path, "w", encoding="ascii") as file:
        file.write("track_id,timestamp_us,agent_type,x,y,vx,vy,psi_rad,length,width\n" + "".join(change(rows)))
    return path


def times_of_their_own_are_judged(folder):
    """Between rows without common stamps, too, denied ways begin visits, and contradictions of units are refused."""
    def own(number, step):
        return 0.1 * step + 0.03 * number
    def aside(pose, time_s):
        pose.y += 14.6 if 1.5 < time_s < 2.5 else 0
    for rate in ("3", "10", "25"):
        path = table(folder, changed(traffic(), aside, "1"), own)
        frames = run("glint-traffic", path, "--ego", "1", "--rate-hz", rate)
        check(len({frame["scene"] for frame in frames}) == 3, f"visits at {rate} Hz")
        for frame in frames:
            part = next(part for part in frame["objects"] if part["id"] == "1")
            check(math.hypot(part["vx_mps"], part["vy_mps"]) < 15.1 and part["travelled_m"] < 61, f"{part} at {rate} Hz")
    text, _ = run("glint-traffic", table(folder, changed(traffic(), scaled(vx=3.6, vy=3.6)), own), "--ego", "1", "--rate-hz", "10",
                  fails=65)
    check("as with speeds in km/h" in text, text)


def a_rare_road_user_is_interpolated(folder):
    """One has a row a second and the others ten: its scene is whole under --rate-hz."""
    path = table(folder, traffic(), lambda number, step: 0.1 * step,
                 lambda rows: [row for i, row in enumerate(rows) if i >= 40 or i % 10 == 0])
    frames = run("glint-traffic", path, "--ego", "1", "--rate-hz", "10")
    check(len(frames) == 31 and len({frame["scene"] for frame in frames}) == 1, f"{len(frames)} frames of a rare ego")


def rows_that_stand_twice_are_read_once(folder):
    """Any row, the last one and all of them; with stamps that agree, that jitter, and that are of their own."""
    draw = random.Random(3)
    stamps = ((), lambda number, step: 0.1 * step), ((), lambda number, step: 0.1 * step + draw.uniform(0, 0.004)), (
        ("--rate-hz", "10"), lambda number, step: 0.1 * step + 0.03 * number)
    for words, stamp in stamps:
        times = {}
        def kept(number, step, times=times, stamp=stamp):
            return times.setdefault((number, step), stamp(number, step))
        once = run("glint-traffic", table(folder, traffic(), kept), "--ego", "1", *words)
        for again in (slice(0, 1), slice(57, 58), slice(39, 40), slice(159, 160), slice(0, 160)):
            path = table(folder, traffic(), kept, lambda rows, again=again: rows + rows[again])
            check(run("glint-traffic", path, "--ego", "1", *words) == once, f"rows {again} twice")


def steps_that_stand_twice_are_read_once(folder):
    """A step of SUMO's XML and a message of OSI, the first, another and the last; not one that differs."""
    for name in ("SUMO's XML", "OSI"):
        kind = next(kind for kind in STATED if kind.name == name)
        once, _ = frames_of(kind, folder, traffic())
        path, options = write(kind, folder, traffic())
        with open(path, "rb") as file:
            whole = file.read()
        if name == "OSI":
            cuts = [0]
            while cuts[-1] < len(whole):
                cuts.append(cuts[-1] + 4 + int.from_bytes(whole[cuts[-1]:cuts[-1] + 4], "little"))
            steps = [whole[a:b] for a, b in zip(cuts, cuts[1:])]
            head, tail = b"", b""
        else:
            head, tail = b"<fcd-export>\n", b"</fcd-export>\n"
            steps = [line + b"\n" for line in whole.splitlines() if line.startswith(b"<timestep")]
        for again in (0, 20, 40):
            with open(path, "wb") as file:
                file.write(head + b"".join(steps[:again + 1] + steps[again:]) + tail)
            check(run(kind.program, path, "--ego", "1", *options) == once, f"{name}: step {again} twice")
        old, new = (struct.pack("<d", at) for at in (30, 31))  # the place of user 1 at 2 s, without that of its front
        other = steps[20].replace(old, new) if name == "OSI" else steps[20].replace(b'x="32.25', b'x="33.25')
        check(other != steps[20], name)
        with open(path, "wb") as file:
            file.write(head + b"".join([*steps[:21], other, *steps[21:]]) + tail)
        text, _ = run(kind.program, path, "--ego", "1", *options, fails=65)
        check("2 s after a step of 2 s; expected a later time" in text, text)


def mesoscopic_places_are_refused(folder):
    """Cars of SUMO's mesoscopic model stand for five seconds, and are then 70 m ahead."""
    path = os.path.join(folder, "meso.xml")
    with open(path, "w", encoding="ascii") as file:
        file.write("<fcd-export>" + "".join(
            f'<timestep time="{time}">' + "".join(
                f'<vehicle id="{name}" x="{70 * ((time + name) // 5)}" y="0" angle="90" type="passenger" speed="14"/>'
                for name in range(2)) + "</timestep>" for time in range(20)) + "</fcd-export>")
    text, _ = run("glint-traffic-sumo", path, "--ego", "0", fails=65)
    check("and by" in text and "SUMO's mesoscopic model gives the places of segments" in text, text)


def real_files_stay_whole():
    if DATA is None:
        print("skipped  real recordings stay whole: GLINT_TEST_DATA is not set")
        return
    files = {"glint-traffic": ("csv/00_tracks.csv.gz", "csv/01_tracks.csv", "csv/us101_interaction.csv", "esmini/cut-in.csv",
                               "esmini/pedestrian.csv", "sumo/grid.fcd.csv"),
             "glint-traffic-sumo": ("sumo/grid.fcd.xml.gz", "sumo/hw.fcd.xml.gz", "sumo/ped.fcd.xml"),
             "glint-traffic-commonroad": ("commonroad/DEU_A9-3_1_T-1.xml", "commonroad/FRA_Anglet-1_1_T-1.xml"),
             "glint-traffic-osi": ("osi/acc-test.osi", "osi/pedestrian.osi")}
    for program, paths in files.items():
        for path in paths:
            done = subprocess.run([os.path.join(recorded.BIN, program), f"{DATA}/{path}", "--ego", "all", "--radius-m", "0",
                                   "--class-default", "car"], capture_output=True, check=False, timeout=recorded.PATIENCE_S)
            check(done.returncode == 0 and b"leaves and comes back" not in done.stderr, f"{path}: {done.stderr.decode()}")


prove((true_recordings_stay_whole, denied_ways_begin_visits, contradictions_are_refused, yaws_in_degrees_are_refused,
       yaws_counted_the_other_way_are_refused, parked_vehicles_leave_their_lane, times_of_their_own_are_judged,
       a_rare_road_user_is_interpolated, rows_that_stand_twice_are_read_once, steps_that_stand_twice_are_read_once,
       mesoscopic_places_are_refused))
real_files_stay_whole()
print(f"plausibility: {recorded.checks} checks hold")
