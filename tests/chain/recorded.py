"""Recorded traffic: SUMO's floating car data against an independent computation, and what all recordings share.

Usage: python3 tests/chain/recorded.py BIN_DIR [--sumo]

With --sumo it runs SUMO itself on a net of its own into the whole chain, through a pipe.
"""
import cmath
import csv
import glob
import gzip
import json
import math
import os
import re
import select
import socket
import struct
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import recorded  # noqa: E402
from recorded import (  # noqa: E402
    BIN, DATA, PATIENCE_S, add_slopes, check, check_mirrored, egos_as_if_alone, in_lock_step, refuses, run, save)

# ---- a drive of our own: exact positions at any time ------------------------------------------------


def smooth(share):
    """From 0 to 1 with three derivatives that begin and end at 0."""
    share = min(max(share, 0), 1)
    return share**4 * (35 - 84 * share + 70 * share**2 - 20 * share**3)


def drive(kind, rate_hz, seconds):
    """Place and heading of a lane change, a turn or a stop, rate_hz times a second; integrated by midpoints."""
    if kind == "change":
        for i in range(round(seconds * rate_hz) + 1):
            share = (i / rate_hz - 1) / 4
            yield 25 * i / rate_hz, 3.5 * smooth(share), math.atan2(
                3.5 * (smooth(share + 1e-6) - smooth(share - 1e-6)) / 8e-6, 25)
        return
    x = y = yaw = 0.0
    speed, length = (8.0 if kind == "turn" else 10.0), 1 / 2000
    for i in range(seconds * 2000 + 1):
        if i % (2000 // rate_hz) == 0:
            yield x, y, yaw
        middle = (i + 0.5) * length
        # The turn rate rises to 0.5 rad/s within a second, and falls again; the deceleration to 3 m/s^2 in half of one.
        turn = 0.5 * (smooth(middle - 1) - smooth(middle - 4)) * length if kind == "turn" else 0
        brake = 0 if kind == "turn" else 3 * (smooth((middle - 1) / 0.5) - smooth((middle - 1 - 10 / 3) / 0.5)) * length
        x += max(speed - brake / 2, 0) * math.cos(yaw + turn / 2) * length
        y += max(speed - brake / 2, 0) * math.sin(yaw + turn / 2) * length
        yaw += turn
        speed -= brake


def table_of(kind, rate_hz, seconds=6):
    lines = ["time;id;x;y;angle;type"]
    for i, (x, y, yaw) in enumerate(drive(kind, rate_hz, seconds)):
        front = x + 2.5 * math.cos(yaw), y + 2.5 * math.sin(yaw)
        lines.append(f"{i / rate_hz:.3f};{kind};{front[0]:.9f};{front[1]:.9f};{90 - math.degrees(yaw):.9f};passenger")
    return "\n".join(lines) + "\n"


def resampling_error(folder):
    """10 Hz in, 20 Hz out, against the original at 200 Hz, whose velocities are differences over 10 ms."""
    for kind in ("change", "turn", "stop"):
        path = save(folder, f"{kind}.csv", table_of(kind, 10))
        frames = run("glint-traffic", path, "--ego", kind, "--rate-hz", "20")
        check(len(frames) == 121, f"{kind}: {len(frames)} frames at 20 Hz")
        original = list(drive(kind, 200, 6))
        place = speed = turn = 0
        for i, frame in enumerate(frames):
            part, (x, y, yaw) = frame["objects"][0], original[10 * i]
            before, after = original[max(10 * i - 1, 0)], original[min(10 * i + 1, 1200)]
            length_s = 0.01 if 0 < i < 120 else 0.005
            place = max(place, math.dist((part["x_m"], part["y_m"]), (x, y)))
            speed = max(speed, math.hypot(part["vx_mps"] - (after[0] - before[0]) / length_s,
                                          part["vy_mps"] - (after[1] - before[1]) / length_s))
            turn = max(turn, abs(math.remainder(part["yaw_rad"] - yaw, 2 * math.pi)))
        print(f"resampled {kind:7} {100 * place:6.3f} cm {speed:7.4f} m/s {math.degrees(turn):7.4f} degrees")
        check(place <= 0.02 and speed <= 0.1 and math.degrees(turn) <= 0.2, f"{kind}: resampled too coarsely")


# ---- floating car data against a computation of its own ---------------------------------------------

SIZES = {"passenger": ("car", 5, 1.8, 1.5), "truck": ("truck", 7.1, 2.4, 2.4), "bus": ("bus", 12, 2.5, 3.4),
         "bicycle": ("bicycle", 1.6, 0.65, 1.7), "DEFAULT_VEHTYPE": ("car", 5, 1.8, 1.5),
         "DEFAULT_PEDTYPE": ("pedestrian", 0.215, 0.478, 1.719), "DEFAULT_CONTAINERTYPE": ("truck", 6.1, 2.4, 2.6)}

FCD = """<?xml version="1.0" encoding="UTF-8"?>
<!-- <configuration><fcd-output value="x"/><vehicle id="none"/></configuration> -->
<fcd-export>
    <timestep time="0.00"/>
    <timestep time="0.50">
        <vehicle id="ego" x="10.00" y="0.00" angle="90.00" type="passenger" speed="20.00" lane="a_0">
            <person id="rider" x="10.00" y="0.00" angle="90.00" speed="20.00"/>
        </vehicle>
        <person id="walker" x="30.00" y="5.00" angle="0.00" speed="1.00" edge="a"/>
    </timestep>
    <timestep time="1.00">
        <vehicle id="ego" x="20.00" y="0.00" angle="90.00" type="passenger" speed="20.00"/>
        <person id="walker" x="30.00" y="5.50" angle="10.00" speed="1.00" edge="a"/>
        <container id="box &amp; co" x="50.00" y="-5.00" angle="180.00" speed="0.00"/>
    </timestep>
    <timestep time="2.00">
        <vehicle id="ego" x="42.00" y="0.50" angle="80.00" type="passenger" speed="22.00"/>
        <vehicle id="late" x="0.00" y="0.00" angle="45.00" type="bus@late" speed="4.00"/>
        <container id="box &amp; co" x="50.00" y="-5.00" angle="180.00" speed="0.00"/>
    </timestep>
</fcd-export>
"""


def users_of(text):
    """(time, id, x, y, angle, type, speed) by a plain search, without XML's comments and riders."""
    text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    text = re.sub(r"(<vehicle[^>]*[^/])>.*?</vehicle>", r"\1/>", text, flags=re.S)
    for step in re.finditer(r'<timestep time="([^"]*)">(.*?)</timestep>', text, flags=re.S):
        for kind, attributes in re.findall(r"<(vehicle|person|container) ([^>]*)/>", step[2]):
            value = dict(re.findall(r'([\w]+)="([^"]*)"', attributes))
            default = {"vehicle": "DEFAULT_VEHTYPE", "person": "DEFAULT_PEDTYPE",
                       "container": "DEFAULT_CONTAINERTYPE"}[kind]
            yield (float(step[1]), value["id"].replace("&amp;", "&"), float(value["x"]), float(value["y"]),
                   float(value["angle"]), value.get("type", default).split("@")[0], float(value["speed"]))


def spread(visit, length):
    """Places and yaws of a vehicle's rows (time, place of the front as a complex number, yaw, speed): jumps fade on a cubic
    from the step that has them, and the body turns no faster than the way of its front lets it."""
    along, cubic, begin, turned, out = cmath.rect(1, visit[0][2]), [0, 0, 0, 0], -3, visit[0][2], []
    for i, (time, place, yaw, speed) in enumerate(visit):
        if i > 0:
            length_s, way, said = time - visit[i - 1][0], place - visit[i - 1][1], speed * (time - visit[i - 1][0])
            aside, turn = (way / along).imag, math.remainder(yaw - visit[i - 1][2], 2 * math.pi)
            jump = way - said * along
            if (abs(aside) > max(1, 2 * length_s) and abs(way)**2 > said**2 + 1 and said * abs(turn) <= 1
                    and abs(jump) <= 5):
                since = time - begin
                now = (sum(c * since**k for k, c in enumerate(cubic)) if since < 3 else 0) + jump
                slope = sum(k * c * since**(k - 1) for k, c in enumerate(cubic) if k) if since < 3 else 0
                begin, cubic = time, [now, slope, -now / 3 - 2 * slope / 3, 2 * now / 27 + slope / 9]
                way -= jump
            body = way / cmath.rect(1, turned)
            side = 0 if way == 0 else math.sin(max(-math.pi / 2, min(math.pi / 2, cmath.phase(body))))
            share = max(abs(way), length_s) / length
            low, high = share * (2 * min(side, 0) - 0.5), share * (2 * max(side, 0) + 0.5)
            turned += max(low, min(high, math.remainder(yaw - turned, 2 * math.pi)))
            along = way / abs(way) if way != 0 else along
        since = time - begin
        out.append((place - (sum(c * since**k for k, c in enumerate(cubic)) if since < 3 else 0), turned))
    return out


def visits_of(steps, every):
    """Who is there in steps one after the other, as lists of (time, state)."""
    for name in {name for users in steps.values() for name in users}:
        visit = []
        for time in [*every, None]:
            state = steps.get(time, {}).get(name)
            if state is not None:
                visit.append((time, state))
            elif visit:
                yield visit
                visit = []


def move(visit):
    """Makes of fronts, yaws and speeds the places, yaws and velocities of centres; vehicles alone have jumps."""
    first = visit[0][1]
    if first["kind"] not in ("DEFAULT_PEDTYPE", "DEFAULT_CONTAINERTYPE"):
        rows = [(at, complex(one["x_m"], one["y_m"]), one["yaw_rad"], one["speed"]) for at, one in visit]
        for (_, one), (place, yaw) in zip(visit, spread(rows, first["length_m"]), strict=True):
            one.update(x_m=place.real, y_m=place.imag, yaw_rad=yaw)
    for _, one in visit:
        speed, yaw = one.pop("speed"), one["yaw_rad"]
        del one["kind"]
        one["x_m"] -= one["length_m"] / 2 * math.cos(yaw)
        one["y_m"] -= one["length_m"] / 2 * math.sin(yaw)
        if len(visit) == 1:
            one.update(vx_mps=speed * math.cos(yaw), vy_mps=speed * math.sin(yaw))
    add_slopes(visit)


def states_of(text, sizes):
    """What the frames have to say: {time: {id: object}}, by differences over the steps."""
    steps = {}
    for time, name, x, y, angle, kind, speed in users_of(text):
        class_, length, width, height = sizes[kind]
        steps.setdefault(time, {})[name] = {
            "x_m": x, "y_m": y, "yaw_rad": math.radians(90 - angle), "kind": kind, "speed": speed, "class": class_,
            "length_m": length, "width_m": width, "height_m": height}
    every = [float(time) for time in re.findall(r'<timestep time="([^"]*)"', re.sub(r"<!--.*?-->", "", text, flags=re.S))]
    for visit in visits_of(steps, every):
        move(visit)
    return steps


def compare(frames, text, sizes, ego):
    recorded.compare(frames, states_of(text, sizes), ego)


def exactness(folder):
    path = save(folder, "own.xml", FCD)
    compare(run("glint-traffic-sumo", path, "--ego", "ego"), FCD, SIZES, "ego")
    check(run("glint-traffic-sumo", "-", "--ego", "late", data=FCD.encode())[0]["ego"] == "late", "standard input")
    with gzip.open(path + ".gz", "wb") as file:
        file.write(FCD.encode())
    compare(run("glint-traffic-sumo", path + ".gz", "--ego", "ego"), FCD, SIZES, "ego")
    types = save(folder, "types.rou.xml", '<routes><vTypeDistribution id="d"><vType id="bus" vClass="coach" length="13"/>'
                 '</vTypeDistribution><vType id="passenger" width="2" height="1.4"/></routes>')
    sizes = dict(SIZES, bus=("bus", 13, 2.6, 4), passenger=("car", 5, 2, 1.4))
    compare(run("glint-traffic-sumo", path, "--ego", "ego", "--types", types), FCD, sizes, "ego")
    mapped = run("glint-traffic-sumo", path, "--ego", "late", "--class-map", "bus=truck")
    check(mapped[0]["objects"][-1]["class"] == "truck", "--class-map")
    if DATA is None:
        print("skipped  files of SUMO: GLINT_TEST_DATA is not set")
        return
    with gzip.open(f"{DATA}/sumo/grid.fcd.xml.gz", "rt", encoding="utf-8") as file:
        text = file.read()
    frames = run("glint-traffic-sumo", f"{DATA}/sumo/grid.fcd.xml.gz", "--ego", "3")
    compare(frames, text, SIZES, "3")
    check(frames == run("glint-traffic", f"{DATA}/sumo/grid.fcd.csv", "--ego", "3", "--scene", "grid/3"), "XML and table")
    with open(f"{DATA}/sumo/ped.fcd.xml", encoding="utf-8") as file:
        text = file.read()
    compare(run("glint-traffic-sumo", f"{DATA}/sumo/ped.fcd.xml", "--ego", "b1"), text, SIZES, "b1")


# ---- what all recordings share ----------------------------------------------------------------------


def riders_are_hidden(folder):
    """Within their vehicle, as newer SUMO writes them, or behind it at its place; who waits at one place is there."""
    bus = '<vehicle id="bus" x="{0}" y="2" angle="90" type="bus" speed="10"'
    behind = '<person id="p" x="{0}" y="2" angle="90" speed="10"/><container id="c" x="{0}" y="2" angle="90" speed="10"/>'
    waiting = '<container id="k" x="9" y="-5" angle="0" speed="0"/><container id="l" x="9" y="-5" angle="0" speed="0"/>'
    near = '<person id="n" x="{0}" y="2.01" angle="90" speed="10"/>'
    for riders in (f"{bus}/>{behind}", f"{bus}>{behind}</vehicle>", f"{bus}/>"):
        steps = "".join(f'<timestep time="{i}">{(riders + near + waiting).format(10 * i)}</timestep>' for i in range(3))
        path = save(folder, "riders.xml", f"<fcd-export>{steps}</fcd-export>")
        there = [[part["id"] for part in frame["objects"]] for frame in run("glint-traffic-sumo", path, "--ego", "bus")]
        check(there == [["bus", "k", "l", "n"]] * 3, f"riders: {there}")
    path = save(folder, "riders.csv",
                "timestep_time;vehicle_id;vehicle_x;vehicle_y;vehicle_angle;person_id;person_x;person_y;person_angle\n"
                "0;bus;0;2;90;;;;\n0;;;;;p;0;2;90\n0;;;;;q;0;3;90\n1;bus;9;2;90;r;9;2;90\n1;;;;;p;0;2;90\n")
    there = [[part["id"] for part in frame["objects"]] for frame in run("glint-traffic", path, "--ego", "bus")]
    check(there == [["bus", "q"], ["bus", "p"]], f"riders of a table: {there}")


def every_ego_is_as_if_alone(folder):
    path = os.path.join(folder, "own.xml")
    for words in ((), ("--radius-m", "20"), ("--rate-hz", "8"), ("--from-s", "0.7", "--to-s", "1.9")):
        together = egos_as_if_alone("glint-traffic-sumo", path, *words)
        check("walker" not in together and "ego" in together, "egos are all but pedestrians")


def table_of_visits(folder, name, visits):
    """Every id is there in the steps of its visits, for whoever is there in all of them too."""
    path = os.path.join(folder, name)
    with open(path, "w", newline="", encoding="ascii") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow("track_id,timestamp_ms,agent_type,x,y,vx,vy".split(","))
        for place, (id_, steps) in enumerate(visits.items()):
            rows.writerows((id_, 100 * step, "car", 9 * place, step, 0, 10) for step in steps)
    return path


def scenes_of(frames):
    """{(ego, visit): names of its frames}; a visit ends with its last frame."""
    names, visits = {}, {}
    for frame in frames:
        visit = visits.setdefault(frame["ego"], 1)
        names.setdefault((frame["ego"], visit), set()).add(frame["scene"])
        visits[frame["ego"]] += frame.get("last", False)
    return names


def listed(id_):
    """As --ego takes an id."""
    return id_.replace("\\", "\\\\").replace(",", "\\,")


def every_scene_has_a_name_of_its_own(folder):
    """Ids that end like the number of a visit, with slashes, commas, backslashes and quotes: all can be named."""
    coming = [0, 1, 3, 4, 6, 8]
    ids = ["z", "z/2", "z/2/1", "z/2/2", "z/1", "z/1/1", "z/3", "z/3/2", "/2", "2", "a,b", "a", "b", ",", "\\", "a\\,b", "a\\b",
           "a\\\\", "\"q\"", "\"", "all", "z/02", "z/0", "z/-2", "z/2x", "z/"]
    path = table_of_visits(folder, "visits.csv", {"here": range(9)} | {id_: coming for id_ in ids} | {"once/2": [2]})
    together = run("glint-traffic", path, "--ego", "all")
    names = scenes_of(together)
    check(all(len(each) == 1 for each in names.values()) and len(names) == 4 * len(ids) + 2, f"scenes: {names}")
    check(len({name for each in names.values() for name in each}) == len(names), "two scenes have one name")
    of = {key: next(iter(each)) for key, each in names.items()}
    check(all(of[id_, 1] == f"visits/{id_}" for id_ in ids if not re.search("/[1-9][0-9]*$", id_)), "names as they were")
    check(all(of[id_, visit] == f"visits/{id_}/{visit}" for id_ in ids for visit in (2, 3, 4)), "names of later visits")
    check((of["z", 2], of["z/2", 1], of["once/2", 1]) == ("visits/z/2", "visits/z/2/1", "visits/once/2/1"), f"{of}")
    for id_ in ids:
        if id_ == "all":
            continue
        alone = run("glint-traffic", path, "--ego", listed(id_))
        check(alone == [frame for frame in together if frame["ego"] == id_], f"{id_} alone")
    check(run("glint-traffic", path, "--ego", ",".join(listed(id_) for id_ in ["here", *ids, "once/2"])) == together,
          "a list of all")
    for list_ in ("", ",", "z,", ",z", "z,,a"):
        text, _ = run("glint-traffic", path, "--ego", list_, fails=64)
        check("has an empty id" in text or "a name of 0 bytes" in text, text)
    check(run("glint-traffic", path, "--ego", "z/2", "--scene", "s")[0]["scene"] == "s", "a scene that is named")


def lists_of_egos_may_be_long(folder):
    ids = [f"vehicle.of.a.long.name.{i:04}" for i in range(2000)]
    path = table_of_visits(folder, "many.csv", {id_: [0] for id_ in ids})
    check(run("glint-traffic", path, "--ego", ",".join(ids), "--radius-m", "5") ==
          run("glint-traffic", path, "--ego", "all", "--radius-m", "5"), "a list of 56,000 bytes")
    path = table_of_visits(folder, "long.csv", {"x" * 1020: [0]})
    text, _ = run("glint-traffic", path, "--ego", "all", fails=65)
    check("its scene's name is too long; see --scene" in text, text)
    check(len(run("glint-traffic", path, "--ego", "x" * 1020, "--scene", "s")) == 1, "an id of 1020 bytes")


def a_mirrored_world_is_mirrored(folder):
    def flip(match):
        return f'y="{-float(match[1]):.2f}" angle="{(180 - float(match[2])) % 360:.2f}"'
    path = save(folder, "mirrored.xml", re.sub(r'y="([^"]*)" angle="([^"]*)"', flip, FCD))
    check_mirrored(*(run("glint-traffic-sumo", one, "--ego", "ego", "--rate-hz", "7") for one in (os.path.join(folder, "own.xml"), path)))


def a_loop_in_lock_step_never_waits():
    """SUMO's stand-in writes a step, and waits for its frame before it writes the next."""
    steps = [step_of(i / 4, [("a", 2 * i, 8)]) for i in range(200)]
    frames = in_lock_step("glint-traffic-sumo", ["-", "--ego", "a", "--live"], steps, b"<fcd-export>\n", b"</fcd-export>\n")
    for i, frame in enumerate(frames):
        check(frame["frame"] == i and abs(frame["objects"][0]["vx_mps"] - 8) < 1e-9, f"live frame {i}: {frame}")
        check("last" not in frame, "nobody knows which frame is the last one")


def step_of(time, users):
    """A step of floating car data: users are (id, place of the front bumper along the road, speed)."""
    rows = "".join(f'<vehicle id="{name}" x="{x:.6f}" y="0" angle="90" speed="{speed:.6f}" type="passenger"/>'
                   for name, x, speed in users)
    return f'<timestep time="{time:.2f}">{rows}</timestep>\n'.encode()


def brake(chain):
    """A stand-in of SUMO brakes by the targets of the last scan, and waits for the list of each step; returns where it stops,
    and the lists."""
    x, speed, near, lists = 0.0, 20.0, False, []
    with subprocess.Popen(chain, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          env=dict(os.environ, PATH=f"{BIN}:{os.environ['PATH']}")) as loop:
        loop.stdin.write(b"<fcd-export>\n")
        for i in range(200):
            loop.stdin.write(step_of(i * 0.05, (("ego", x, speed), ("other", 105, 0))))
            loop.stdin.flush()
            check(bool(select.select([loop.stdout], [], [], PATIENCE_S)[0]), f"no targets of step {i} before the next")
            lists.append(loop.stdout.readline())
            frame = json.loads(lists[-1])
            if any(one.get("measured") for one in frame["sensors"]["list"]):
                near = min((target["range_m"] for target in frame["targets"]), default=1e3) < 50
            speed = max(0, speed - 0.05 * (5 if near else 0))
            x += 0.05 * speed
        loop.stdin.write(b"</fcd-export>\n")
        loop.stdin.close()
        check(loop.wait(PATIENCE_S) == 0, "the loop ends well")
    return x, lists


def a_loop_closes_through_the_whole_chain():
    text = ("glint-traffic-sumo - --ego ego --live | glint-extract | glint-ideal --sensors lrr77-every-frame "
            "| glint-sensor | glint-noise")
    piped, fused = brake(["bash", "-c", text]), brake(["glint", "-c", text])
    check(70 < piped[0] < 98, f"the stand-in stops at {piped[0]} m, before the standing car at 100 m")
    check(piped == fused, "piped and fused")


def memory_is_constant():
    """Ten times the steps take no more memory: the peaks that the kernel tells while the program waits for more."""
    peaks = []
    for steps in (2000, 20000):
        with subprocess.Popen([os.path.join(BIN, "glint-traffic-sumo"), "-", "--ego", "ego"], stdin=subprocess.PIPE,
                              stdout=subprocess.PIPE) as reader:
            reader.stdin.write(b"<fcd-export>\n")
            for i in range(steps):
                reader.stdin.write(step_of(i * 0.05, (("ego", i, 20), (f"passer {i // 10}", i, 20))))
                reader.stdin.flush()
                if i > 0:
                    reader.stdout.readline()
            with open(f"/proc/{reader.pid}/status", encoding="ascii") as file:
                peaks.append(int(re.search(r"VmHWM:\s+(\d+) kB", file.read())[1]))
            reader.stdin.write(b"</fcd-export>\n")
            reader.stdin.close()
            check(len(reader.stdout.readlines()) == 1, "the last frame")
    check(peaks[1] <= peaks[0] + 512, f"peaks of {peaks} kB")


def tables_of_sumo(folder):
    """Both spellings of the columns, and both separators, in any order."""
    names = {"timestep_time": "time", "vehicle_id": "id", "vehicle_x": "x", "vehicle_y": "y", "vehicle_angle": "angle",
             "vehicle_type": "type", "vehicle_speed": "speed", "vehicle_lane": "lane"}
    rows = [(time, name, x, y, angle, kind, speed) for time, name, x, y, angle, kind, speed in users_of(FCD)
            if kind in ("passenger", "bus")]
    expected = None
    for separator in (";", ","):
        for spelled in (lambda name: name, names.get):
            for order in ((0, 1, 2, 3, 4, 5, 6), (4, 5, 1, 6, 0, 3, 2)):
                lines = [separator.join(str(row[i]) for i in order) for row in [[spelled(name) for name in list(names)[:7]], *rows]]
                path = save(folder, "own.csv", "\n".join(lines) + "\n")
                frames = run("glint-traffic", path, "--ego", "ego")
                expected = expected or frames
                check(frames == expected and len(frames) == 3, f"a table with {separator}")
    xml = re.sub(r"<(person|container)[^>]*/>", "", FCD)
    for one, other in zip(expected, run("glint-traffic-sumo", "-", "--ego", "ego", data=xml.encode()), strict=True):
        check(one["objects"] == other["objects"], "a table and XML")


def places_reach_to_their_bound():
    """The centre of a body whose front is at 1e9 m lies beyond; its frame has an origin within the bound."""
    data = b'<fcd-export><timestep time="0"><vehicle id="a" x="1e9" y="-1e9" angle="-90"/></timestep></fcd-export>'
    frame = run("glint-traffic-sumo", "-", "--ego", "a", data=data)[0]
    check((frame["origin_x_m"], frame["origin_y_m"], frame["objects"][0]["x_m"]) == (1e9, -1e9, 2.5), f"{frame}")


def early_ends(folder):
    """Wherever a file is cut, the whole steps come out, and the message names the last of them."""
    steps = [(match.end(), match[1]) for match in re.finditer(r'<timestep time="([^"]*)"(?:/>|>.*?</timestep>)', FCD, re.S)]
    for cut in range(FCD.index("<fcd-export>") + 12, FCD.index("</fcd-export>") + 12, 23):
        path = save(folder, "cut.xml", FCD[:cut])
        whole = [time for end, time in steps if end <= cut]
        text, frames = run("glint-traffic-sumo", path, "--ego", "ego", fails=65)
        said = f"the last whole step is that of {float(whole[-1]):g} s" if whole else "no step is whole"
        check(said in text, f"cut at {cut}: {text}")
        check(frames == max(0, len(whole) - 1), f"cut at {cut}: {frames} frames")


def bad_input(folder):
    cases = [
        ('x="20.00"', 'x="wide"', 'line 12: x is "wide"; expected a number in [-1e+09, 1e+09]'),
        ('x="20.00"', 'x="nan"', 'line 12: x is "nan"; expected a number'),
        ('x="20.00"', 'x="2e9"', 'line 12: x is "2e9"; expected a number in [-1e+09, 1e+09]'),
        ('x="20.00"', "", "line 12: x is missing; expected a number"),
        ('y="0.50"', 'y=""', 'line 17: y is ""; expected a number'),
        ('angle="80.00"', "", "line 17: angle is missing; expected a number in [-1000, 1000]"),
        ('speed="22.00"', 'speed="fast"', 'line 17: speed is "fast"; expected a number'),
        ('id="late"', "", "line 18: id is missing; expected a name of 1 to 1024 bytes"),
        ('id="late"', 'id=""', 'line 18: id is ""; expected a name of 1 to 1024 bytes'),
        ('id="late"', 'id="ego"', " 2 s is in line "),
        ('"bus@late"', '"hovercraft"', 'line 18: unknown class "hovercraft"; expected a word that --help lists'),
        ('time="2.00"', 'time="0.75"', "0.75 s after a step of 1 s; expected a later time"),
        ('time="2.00"', 'time="noon"', 'line 16: time is "noon"; expected a number'),
        ('time="2.00"', "", "line 16: time is missing; expected a number"),
        ("</timestep>", "</step>", "line 10: mismatched tag"),
        ("<fcd-export>", "<fcd>", "line 3: <fcd-export> is missing; expected floating car data"),
        ('<fcd-output value="x"/>', '<fcd-output.geo value="true"/>',
         'line 2: --fcd-output.geo is "true"; expected coordinates in metres'),
        ('<timestep time="0.00"/>', '<vehicle id="a" x="0" y="0" angle="0"/>',
         "line 4: <timestep> is missing; expected one around road users"),
        ("<fcd-export>", "\x01", "line 3: not well-formed (invalid token)"),
    ]
    refuses("glint-traffic-sumo", folder, "bad.xml", FCD, cases, "ego")
    save(folder, "net.xml", '<net><vType id="passenger" length="1"/></net>')
    for words, code, message in (
            (("--ego", "nobody"), 65, '--ego: "nobody" is no id'),
            ((), 64, "a recording has no ego of its own"),
            (("--ego", "ego", "--live", "--rate-hz", "5"), 64, "--live: --rate-hz would wait for the next step"),
            (("--ego", "ego", "--from-s", "2", "--to-s", "1"), 64, "--to-s: 1 is before --from-s, which is 2"),
            (("--ego", "ego", "--class-map", "bus"), 64, '--class-map: "bus"; expected WORD=CLASS'),
            (("--ego", "ego,,late"), 64, 'has an empty id'),
            (("--ego", "ego", "--types", os.path.join(folder, "own.xml")), 65, "own.xml: SUMO's floating car data; "),
            (("--ego", "ego", "--types", os.path.join(folder, "net.xml")), 65,
             "net.xml: line 1: <routes> is missing; expected routes, or additional elements, of SUMO"),
            (("--ego", "ego", "--types", "none.xml"), 66, "--types: none.xml: No such file or directory")):
        text, _ = run("glint-traffic-sumo", os.path.join(folder, "own.xml"), *words, fails=code)
        check(message in text, f"{words}: {text}")
    text, _ = run("glint-traffic", os.path.join(folder, "own.xml"), "--ego", "ego", fails=65)
    check("SUMO's floating car data; glint-traffic-sumo reads it" in text, text)


def a_tag_has_an_end(folder):
    """expat parses an unfinished tag or comment again with every piece: one of more than 4 MB is refused, from pipes too."""
    step = '<timestep time="0"><vehicle id="a" x="0" y="0" angle="90"/></timestep>'
    for fits, text in ((True, f"<!--{'> ' * 2000000}-->\n<fcd-export>{step}</fcd-export>"),
                       (True, f"<fcd-export>{' ' * 6000000}{step}<![CDATA[{'y' * 6000000}]]></fcd-export>"),
                       (False, f"<!--{'> ' * 3000000}-->\n<fcd-export>{step}</fcd-export>"),
                       (False, f"<fcd-export>\n{step.replace('angle', 'lane=' + chr(34) + 'y' * 5000000 + chr(34) + ' angle')}")):
        path = save(folder, "long.xml", text)
        for source, data in ((path, None), ("-", text.encode())):
            if fits:
                check(len(run("glint-traffic-sumo", source, "--ego", "a", data=data)) == 1, "a comment of 4 MB, other text of 6 MB")
                continue
            said, _ = run("glint-traffic-sumo", source, "--ego", "a", data=data, fails=65)
            line = 1 + text[:text.index("y" * 9 if "y" * 9 in text else "<!--")].count("\n")
            check(f": line {line}: a tag or comment of more than 4 MB; expected its end before" in said, said)


def a_type_has_the_sizes_of_its_class(folder):
    """A type that says no length has that of its vClass, also where another type has the name of the class."""
    types = save(folder, "named.rou.xml",
                 '<routes><vType id="truck" vClass="truck" length="14"/><vType id="own" vClass="truck"/></routes>')
    data = '<fcd-export><timestep time="0"><vehicle id="a" x="0" y="0" angle="90" type="{}"/></timestep></fcd-export>'
    for word, length in (("truck", 14), ("own", 7.1)):
        frame = run("glint-traffic-sumo", "-", "--ego", "a", "--types", types, data=data.format(word).encode())[0]
        check(frame["objects"][0]["length_m"] == length, f"length of {word}: {frame}")


def a_class_that_is_none_of_glint_is_named(folder):
    """The message names the vClass and the option for it, in XML and in tables; also of the copies of a type."""
    for kind in ("ignoring", "ship", "aircraft", "hovercraft"):
        types = save(folder, "strange.rou.xml",
                     f'<routes><vType id="CarRed" vClass="{kind}" length="6.5"/><vType id="bus" vClass="{kind}"/></routes>')
        for word, length in (("CarRed", 6.5), ("bus", 5), ("CarRed@7", 6.5)):
            xml = save(folder, "strange.xml", f'<fcd-export><timestep time="0"><vehicle id="a" x="0" y="0" angle="90" '
                       f'type="{word}"/></timestep></fcd-export>')
            table = save(folder, "strange.csv", f"time;id;x;y;angle;type\n0;a;0;0;90;{word}\n")
            for source in (xml, table):
                words = (source, "--ego", "a", "--types", types)
                said, _ = run("glint-traffic-sumo", *words, fails=65)
                check(f'type "{word.split("@")[0]}" has vClass "{kind}"; expected one that --help lists; '
                      f"--class-map {kind}=CLASS or --class-default CLASS names one" in said, said)
                for more in (("--class-map", kind + "=car"), ("--class-default", "car")):
                    part = run("glint-traffic-sumo", *words, *more)[0]["objects"][0]
                    check((part["class"], part["length_m"], part["width_m"]) == ("car", length, 1.8), f"{more}: {part}")
                part = run("glint-traffic-sumo", *words, "--class-map", word + "=car")[0]["objects"][0]
                check((part["class"], part["width_m"]) == ("car", 1.8), f"{word}=car: {part}")


def types_come_from_several_files(folder):
    """Each --types adds to those before, for XML and for tables. An id may come again with the same class and size only."""
    texts = ["<?xml version='1.0'?><!-- <vType id='a' length='99'/> --><routes><![CDATA[<vType id='a' length='99'/>]]>\n"
             '<vTypeDistribution id="d"><vType id="a" vClass = "truck" length="14" width="2.6"/></vTypeDistribution>'
             "<vType id='c' length='3'/><route id='r' edges='x y'/></routes>",
             '<additional><vType id="b" vClass="bus" length="11.5" height="3"><param key="id" value="c"/></vType></additional>',
             "time;id;x;y;angle;type\n" + "".join(f"{t};{name};{9 * t};0;90;{name}\n" for t in (0, 1) for name in "ab"),
             "<fcd-export>" + "".join(f'<timestep time="{t}">' + "".join(
                 f'<vehicle id="{name}" x="{9 * t}" y="0" angle="90" type="{name}"/>' for name in "ab") + "</timestep>"
                 for t in (0, 1)) + "</fcd-export>"]
    names = ("one.rou.xml", "two.add.xml", "fcd.csv", "fcd.xml")
    one, two, table, xml = (save(folder, name, text) for name, text in zip(names, texts, strict=True))
    for words, sizes in (((one, two), {"a": ("truck", 14, 2.6, 2.4), "b": ("bus", 11.5, 2.5, 3)}),
                         ((two, one, one), {"a": ("truck", 14, 2.6, 2.4), "b": ("bus", 11.5, 2.5, 3)})):
        options = [word for path in words for word in ("--types", path)]
        for source in (xml, table):
            for part in run("glint-traffic-sumo", source, "--ego", "a", *options)[0]["objects"]:
                got = (part["class"], *(part[f"{size}_m"] for size in ("length", "width", "height")))
                check(got == sizes[part["id"]] and part["x_m"] == -got[1] / 2, f"{source} {words}: {part}")
    for program, source in (("glint-traffic-sumo", xml), ("glint-traffic", table)):
        said, _ = run(program, source, "--ego", "a", fails=65)
        check("but not its size, which is that of its vType: glint-traffic-sumo --types FILE" in said, said)
    for source in (xml, table):
        said, _ = run("glint-traffic-sumo", source, "--ego", "a", "--types", two, fails=65)
        check("--class-map a=CLASS or --class-default CLASS names one, but not its size, which is that of its vType, and no "
              "file of --types has it" in said, said)
        for old, new, message in (
                ('id="b"', "", 'line 1: id is missing; expected a name of 1 to 1024 bytes'),
                ('id="b"', 'id="a"', 'line 1: id is "a", as that of a type above with another class or size; expected one'),
                ('"11.5"', '"wide"', 'line 1: length is "wide"; expected a number in [0, 1e+06]'),
                ('"11.5"', '"-1"', 'line 1: length is "-1"; expected a number in [0, 1e+06]'),
                ('"11.5"', "11.5", "line 1: not well-formed (invalid token)"),
                ("</vType>", "</type>", "line 1: mismatched tag"),
                ("<additional>", "<!--\n<additional>", "line 1: unclosed token"),
                ("</additional>", "", "line 1: the file ends before </routes> or </additional>"),
                ("<additional>", "\n<net>", "line 2: <routes> is missing; expected routes, or additional elements, of SUMO"),
                (texts[1], "", "line 1: no element found")):
            path = save(folder, "bad.add.xml", texts[1].replace(old, new, 1))
            said, _ = run("glint-traffic-sumo", source, "--ego", "a", "--types", one, "--types", path, fails=65)
            check(f"--types: {path}: {message}" in said, f"{old} -> {new}: {said}")
    said, _ = run("glint-traffic-sumo", "data/trajectories/highway.csv", "--ego", "1", "--types", one, fails=65)
    check("data/trajectories/highway.csv: a table of INTERACTION; glint-traffic plays it" in said, said)


def files_of_other_programs_are_named():
    """Whoever reads frames names each file of another program, and what reads that."""
    names = [name for folder in ("sumo", "csv", "esmini", "osi", "commonroad") for name in
             glob.glob(f"{DATA}/{folder}/*.*")]
    check(len(names) >= 15, "files of other programs")
    for name in names:
        text, _ = run("glint-extract", name, fails=65)
        check(re.search(r": [^:;]+; glint-traffic(-sumo|-commonroad|-osi)? (--types )?(reads|takes|plays) ", text), text)


# ---- jumps of SUMO ------------------------------------------------------------------------------------


def fcd(rows):
    """Floating car data of (time, id, place of the front as a complex number, yaw, speed), in ascending time."""
    steps = {}
    for time, *user in rows:
        steps.setdefault(time, []).append(user)
    body = "".join(f'<timestep time="{time:.2f}">' + "".join(
        f'<vehicle id="{name}" x="{place.real:.9f}" y="{place.imag:.9f}" angle="{90 - math.degrees(yaw):.9f}" '
        f'speed="{speed:.9f}" type="passenger"/>' for name, place, yaw, speed in users) + "</timestep>\n"
        for time, users in steps.items())
    return f"<fcd-export>\n{body}</fcd-export>"


def course(length_s, jumps, seconds=12, speed=30, name="car", yaw=lambda time: 0, begin=0):
    """Rows of a straight drive whose place jumps to the left by so many metres at times."""
    for i in range(round(seconds / length_s) + 1):
        time = i * length_s
        aside = sum(far for at, far in jumps if time > at - 1e-9)
        yield round(time, 2), name, complex(begin + speed * time, aside), yaw(time), speed


def played(rows, *words, ego="car"):
    """The ego's own object in every frame, with its time."""
    frames = run("glint-traffic-sumo", "-", "--ego", ego, *words, data=fcd(rows).encode())
    return [(frame["time_s"], part) for frame in frames for part in frame["objects"] if part["id"] == ego]


def lane_changes_take_their_time():
    """A lane of 3.2 m at 30 m/s: along the lane SUMO's speed, aside 3.2 (3 p^2 - 2 p^3) of p = t / 3 s, at most 1.6 m/s."""
    for length_s, most, least in ((0.1, 1.6, 1.59), (1, 1.6, 1.18)):
        for words in ((), ("--live",), ("--rate-hz", "7")):
            sides, off = [], 0 if "--rate-hz" not in words else 0.01 if length_s < 1 else 0.15
            for time, part in played(course(length_s, [(4, 3.2)]), *words):
                p = min(max((time - 4) / 3, 0), 1)
                check(abs(part["y_m"] - 3.2 * (3 * p**2 - 2 * p**3)) <= off + 1e-9, f"{part['y_m']} m aside at {time} s")
                check(abs(part["x_m"] + 2.5 - 30 * time) < 1e-6 and abs(part["vx_mps"] - 30) < 1e-6, f"along at {time} s")
                check(part["yaw_rad"] == 0 and part["yaw_rate_radps"] == 0, f"yaw at {time} s")
                sides.append(part["vy_mps"])
            check(least - off <= max(sides) <= most + off + 1e-6 and min(sides) >= -off - 1e-6,
                  f"{min(sides)} to {max(sides)} m/s aside, {words}")
            check(abs(part["y_m"] - 3.2) < 1e-9, "the place at last is SUMO's")
    for name, text in (("with its speed", "time;id;x;y;angle;speed"), ("without", "time;id;x;y;angle")):
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            rows = [f"{time};{name};{place.real};{place.imag};90" + (";30" if "speed" in text else "")
                    for time, name, place, _, _ in course(0.1, [(4, 3.2)])]
            file.write("\n".join([text, *rows, ""]))
            file.flush()
            table = [frame["objects"][0] for frame in run("glint-traffic", file.name, "--ego", "car")]
            for one, (_, other) in zip(table, played(course(0.1, [(4, 3.2)])), strict=True):
                for key in ("x_m", "y_m", "vx_mps", "vy_mps"):
                    check(abs(one[key] - other[key]) < 1e-6, f"{key} of a table {name}")


def jumps_may_overlap_and_are_no_teleports():
    """A second jump goes on from the first with its speed; after an absence, and where it is longer than a lane, none fades."""
    for jumps in ([(4, 3.2), (5, 3.2)], [(4, 3.2), (5, -3.2)], [(4, 3.2), (4.1, -3.2), (4.2, 3.2)]):
        parts = played(course(0.1, jumps))
        for (_, one), (_, other) in zip(parts, parts[1:]):
            check(abs(other["y_m"] - one["y_m"]) <= 0.35 and abs(one["vy_mps"]) <= 3.4, f"{jumps}: {one} {other}")
            check(abs(other["vy_mps"] - one["vy_mps"]) <= 1.1, f"{jumps}: the speed aside has no jump: {one} {other}")
        check(abs(parts[-1][1]["y_m"] - sum(far for _, far in jumps)) < 1e-9, f"{jumps}: the place at last")
    who = "".join(f'<timestep time="{i}"><{kind} id="car" x="{i}" y="0" angle="90" speed="1"/></timestep>'
                  for i, kind in enumerate(("vehicle", "person", "vehicle", "vehicle")))
    check(len(run("glint-traffic-sumo", "-", "--ego", "car", data=f"<fcd-export>{who}</fcd-export>".encode())) == 4,
          "a walker may have the id of a vehicle")
    for far in (6, 30):
        parts = dict(played(course(0.1, [(4, far)])))
        check(parts[3.9]["y_m"] == 0 and abs(parts[4]["y_m"] - far) < 1e-9, f"a jump of {far} m stays")
    away = [row for pair in zip(course(0.1, [(4, 3.2)]), course(0.1, [], name="other"), strict=True) for row in pair
            if row[1] == "other" or not 3.75 < row[0] < 3.95]
    check(abs(dict(played(away))[4]["y_m"] - 3.2) < 1e-9, "who comes again is where SUMO has it")


def motion_without_jumps_is_that_of_the_file():
    """A lane change of 1 m/s, a curve of 30 m at 14 m/s and one that the front cuts, and a start: centres are the file's."""
    changing = [(t, name, complex(z.real, min(max(t - 4, 0), 3.2)), yaw, v) for t, name, z, yaw, v in course(0.5, [])]
    turn = [(t, "car", cmath.rect(30, 14 / 30 * t), 14 / 30 * t + math.pi / 2 - 2.5 / 30, 14) for t in range(9)]
    start = [(i / 10, "car", complex(0.02 * max(i - 9, 0)**2 + 0.01 * i, 0), 0.1, 0.1 + 0.4 * max(i - 9, 0)) for i in range(30)]
    for rows in (changing, turn, start):
        for (_, part), (time, _, place, yaw, _) in zip(played(rows), rows, strict=True):
            centre = place - cmath.rect(2.5, yaw)
            check(abs(complex(part["x_m"], part["y_m"]) - centre) < 1e-6, f"{part} at {time} s, expected {centre}")


def bodies_turn_with_their_way():
    """Yaws that jump by 55 degrees straight on, or by 90 where the way does, at 10 m/s: the front stays on its way."""
    jump = math.radians(55)
    straight = list(course(0.1, [], speed=10, yaw=lambda time: jump if time < 5.95 else 0))
    corner = [(i / 10, "car", complex(min(i, 60), max(i - 60, 0)), math.pi / 2 if i > 60 else 0, 10) for i in range(120)]
    for rows, fastest in ((straight, 1.04), (corner, 1.25)):
        parts = played(rows)
        for (time, part), (_, _, place, _, _) in zip(parts, rows, strict=True):
            front = complex(part["x_m"], part["y_m"]) + cmath.rect(2.5, part["yaw_rad"])
            check(abs(front - place) < 1e-6, f"front at {time} s: {front}, expected {place}")
            check(abs(part["yaw_rate_radps"]) <= 2.5 * 10 / 5 + 1e-9, f"{part['yaw_rate_radps']} rad/s at {time} s")
            if time > 6.05:
                check(math.hypot(part["vx_mps"], part["vy_mps"]) <= fastest * 10, f"centre at {time} s: {part}")
        turning = [time for time, part in parts if time > 5.85 and abs(part["yaw_rate_radps"]) > 1e-9]
        check(0.35 <= turning[-1] - turning[0] <= 1.5, f"turns from {turning[0]} to {turning[-1]} s")
        check(abs(parts[-1][1]["yaw_rad"] - rows[-1][3]) < 1e-6, "the yaw at last is SUMO's")


def targets_of_a_lane_change_have_the_speed_of_the_lane(folder):
    """The ego at 25 m/s and a car at 20 m/s 40 m ahead change lanes: -5 m/s and the part of at most 1.6 m/s on each side."""
    for who in ("ego", "car"):
        users = {"ego": dict(speed=25), "car": dict(speed=20, begin=60)}
        rows = (row for name, words in users.items()
                for row in course(0.1, [(2, 3.2)] if name == who else [], seconds=5, name=name, **words))
        path = save(folder, "targets.xml", fcd(sorted(rows, key=lambda row: row[0])))
        text = (f"glint-traffic-sumo {path} --ego ego | glint-extract | glint-ideal --sensors lrr77-every-frame "
                "| glint-sensor-perfect | glint-noise-none")
        done = subprocess.run([os.path.join(BIN, "glint"), "-c", text], capture_output=True, check=True)
        rates = [target["range_rate_mps"] for line in done.stdout.splitlines() for target in json.loads(line)["targets"]
                 if target["contributors"][0]["object"] == "car"]
        check(len(rates) > 50 and -5.7 < min(rates) and max(rates) < -4.3, f"rates of {min(rates)} to {max(rates)} m/s")
        said = "\n".join(line for line in done.stderr.decode().splitlines() if line.startswith("glint-traffic-sumo: "))
        check(said.count("\n") == 0 and "1 jumps to another lane are spread over 3 s, and 0 of the angle" in said, said)


def places_in_degrees_are_told_by_their_speeds(folder):
    """Without SUMO's comment, as XML and as a table; cars that stand, start, teleport or wait are no reason."""
    drive_m = list(course(0.1, [], speed=20, seconds=4))
    degrees = [(t, name, complex(11 + z.real / 75000, 48 + z.imag / 111000), yaw, v) for t, name, z, yaw, v in drive_m]
    path = save(folder, "degrees.csv", "time;id;x;y;angle;speed\n" + "".join(
        f"{t};{name};{z.real:.9f};{z.imag:.9f};90;{v}\n" for t, name, z, _, v in degrees))
    said, frames = run("glint-traffic-sumo", "-", "--ego", "car", data=fcd(degrees).encode(), fails=65)
    text = ("from here on road users move by 0.00107 m where their speeds say 80 m, 7.5e+04 times as far, as with places in "
            "degrees; expected places in m and speeds in m/s: run sumo without --fcd-output.geo")
    check(f"-: line 4: {text}" in said and frames == 41, f"{frames} frames: {said}")
    said, _ = run("glint-traffic", path, "--ego", "car", fails=65)
    check(f"{path}: row 4: {text}" in said, said)
    long = [row for i in range(60) for row in [(i, f"c{j}", 11 + (20 * i + j) / 75000, 0, 20) for j in range(100)]]
    said, frames = run("glint-traffic-sumo", "-", "--ego", "c0", "--live", data=fcd(long).encode(), fails=65)
    check("where their speeds say 4e+03 m" in said and frames == 3, f"{frames} frames: {said}")
    stands = [(i / 10, "car", complex(5, 0), 0, 0) for i in range(100)]
    starts = [(i / 10, "car", complex(0.002 * i * i, 0), 0, 0.04 * i) for i in range(100)]
    teleports = [(i / 10, "car", complex(900 * (i // 50), 0), 0, 0) for i in range(100)]
    late = [(t, name, z if t > 0.4 else 0, yaw, v) for t, name, z, yaw, v in drive_m]
    for rows in (stands, starts, teleports, late, drive_m[:2], degrees[:1]):
        check(len(played(rows)) == len(rows), "a true file is read")


# ---- SUMO itself --------------------------------------------------------------------------------------

NODES = '<nodes><node id="a" x="0" y="0"/><node id="b" x="300" y="0"/><node id="c" x="600" y="30"/></nodes>'
EDGES = ('<edges><edge id="ab" from="a" to="b" numLanes="3" speed="25"/>'
         '<edge id="bc" from="b" to="c" numLanes="3" speed="25"/></edges>')
ROUTES = """<routes><vType id="lorry" vClass="truck" length="12" width="2.5" height="3.8" maxSpeed="22"/>
<vType id="hasty" vClass="passenger" length="4.4" lcSpeedGain="5"/><route id="r" edges="ab bc"/>
<flow id="l" type="lorry" route="r" begin="0" end="60" period="2" departLane="0" departSpeed="max"/>
<flow id="m" type="hasty" route="r" begin="0" end="60" period="2" departLane="1" departSpeed="max"/>
<flow id="h" type="hasty" route="r" begin="0" end="60" period="2" departLane="2" departSpeed="max"/>
<vehicle id="ego" type="hasty" route="r" depart="5" departLane="1" departSpeed="20"/></routes>
"""


QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "check": True}


def beside_sumo(folder):
    for name, text in (("n.nod.xml", NODES), ("n.edg.xml", EDGES), ("n.rou.xml", ROUTES)):
        save(folder, name, text)
    subprocess.run(["netconvert", "-n", "n.nod.xml", "-e", "n.edg.xml", "-o", "n.net.xml"], cwd=folder, **QUIET)
    sumo = ("sumo -n n.net.xml -r n.rou.xml --end 60 --step-length 0.05 --precision 6 --seed 7 --no-step-log true "
            "--lateral-resolution 0.8")
    subprocess.run([*sumo.split(), "--fcd-output", "file.xml"], cwd=folder, **QUIET)
    path = os.path.join(folder, "file.xml")
    with open(path, encoding="utf-8") as file:
        text = file.read()
    check(len(set(re.findall(r'<vehicle id="([^"]*)"', text))) >= 60, "vehicles of SUMO")
    sizes = {"lorry": ("truck", 12, 2.5, 3.8), "hasty": ("car", 4.4, 1.8, 1.5)}
    words = ("--types", os.path.join(folder, "n.rou.xml"), "--ego", "ego")
    compare(run("glint-traffic-sumo", path, *words), text, sizes, "ego")
    jumps_of_sumo_are_spread(folder, sumo.replace("--lateral-resolution 0.8", ""), sizes, words)
    subprocess.run([*sumo.split(), "--fcd-output", "file.xml.gz"], cwd=folder, **QUIET)
    check(run("glint-traffic-sumo", path, *words) == run("glint-traffic-sumo", path + ".gz", *words), "gzip by SUMO")
    through_a_pipe(folder, sumo)
    riders_of_sumo_are_hidden(folder)
    sizes_are_those_of_sumo(folder)
    degrees_are_refused(folder)


def jumps_of_sumo_are_spread(folder, sumo, sizes, words):
    """Its changes of lanes in one step, which two of its options avoid."""
    for option, avoids in (("", False), ("--lanechange.duration 3", True), ("--lateral-resolution 0.8", True)):
        subprocess.run([*sumo.split(), *option.split(), "--fcd-output", "jumps.xml"], cwd=folder, **QUIET)
        path = os.path.join(folder, "jumps.xml")
        with open(path, encoding="utf-8") as file:
            compare(run("glint-traffic-sumo", path, *words), file.read(), sizes, "ego")
        done = subprocess.run([os.path.join(BIN, "glint-traffic-sumo"), path, *words], capture_output=True, check=True)
        count = int((re.search(r": (\d+) jumps to another lane", done.stderr.decode()) or [0, 0])[1])
        print(f"sumo {option or 'as it is'}: {count} jumps to another lane")
        check((count == 0) == avoids, f"{count} jumps to another lane, {option}")


STOPS = """<additional><busStop id="bs" lane="ab_1" startPos="40" endPos="60"/>
<busStop id="be" lane="bc_1" startPos="100" endPos="120"/>
<containerStop id="cs" lane="ab_1" startPos="80" endPos="120"/>
<containerStop id="ce" lane="bc_1" startPos="200" endPos="240"/></additional>"""
RIDES = """<routes><vType id="lorry" vClass="truck" containerCapacity="1"/><vType id="coach" vClass="coach"/>
<person id="p" depart="0"><walk from="ab" busStop="bs"/><ride busStop="be" lines="b"/><walk to="bc" arrivalPos="200"/></person>
<container id="k" depart="0" departPos="100"><transport from="ab" containerStop="ce" lines="l"/></container>
<vehicle id="lorry" type="lorry" line="l" depart="1"><route edges="ab bc"/><stop containerStop="cs" duration="5"/>
<stop containerStop="ce" duration="9"/></vehicle>
<vehicle id="bus" type="coach" line="b" depart="5"><route edges="ab bc"/><stop busStop="bs" duration="50"/>
<stop busStop="be" duration="5"/></vehicle></routes>"""


def riders_of_sumo_are_hidden(folder):
    """A person walks, rides a bus and walks again; a container waits and is carried."""
    for name, text in (("s.add.xml", STOPS), ("s.rou.xml", RIDES), ("s.edg.xml", EDGES.replace("speed", 'sidewalkWidth="2" speed'))):
        save(folder, name, text)
    subprocess.run(["netconvert", "-n", "n.nod.xml", "-e", "s.edg.xml", "-o", "s.net.xml"], cwd=folder, **QUIET)
    subprocess.run(["sumo", "-n", "s.net.xml", "-a", "s.add.xml", "-r", "s.rou.xml", "--end", "140", "--fcd-output", "s.xml"],
                   cwd=folder, **QUIET)
    frames = run("glint-traffic-sumo", os.path.join(folder, "s.xml"), "--ego", "bus,lorry", "--class-default", "truck")
    seen = {}
    for frame in frames:
        places = {part["id"]: (part["x_m"], part["y_m"]) for part in frame["objects"]}
        for name in set(places) - {frame["ego"]}:
            check(math.dist(places[name], places[frame["ego"]]) > 2, f"{name} in {frame['ego']} at {frame['time_s']} s")
            seen.setdefault(name, []).append(frame["time_s"])
    walks = sorted(set(seen["p"]))
    check(max(after - before for before, after in zip(walks, walks[1:])) > 10, f"the person is away while it rides: {walks}")
    check(max(seen["k"]) < 60, f"the container is away from when it is carried: {seen['k']}")


def through_a_pipe(folder, sumo):
    chain = (f"set -o pipefail; {sumo} --fcd-output /dev/stdout 2>/dev/null | glint-traffic-sumo - --types n.rou.xml "
             "--ego all --radius-m 150 | glint-extract | glint-ideal --sensors lrr77-every-frame --sections account "
             "| glint-sensor | glint-noise")
    lines = {}
    for mode, text in (("", f"{chain} --complete"), ("live", chain.replace("--ego all", "--ego ego --live"))):
        done = subprocess.run(["bash", "-c", text], cwd=folder, capture_output=True, check=False,
                              env=dict(os.environ, PATH=f"{BIN}:{os.environ['PATH']}"))
        check(done.returncode == 0, f"SUMO through the chain: {done.stderr.decode()}")
        lines[mode] = done.stdout.splitlines()
    scenes = {json.loads(line)["scene"] for line in lines[""][::50]}
    print(f"SUMO through the chain: {len(lines[''])} frames, at least {len(scenes)} scenes")
    check(len(lines[""]) > 20000 and len(scenes) >= 60, "frames of all vehicles")
    check(sum(json.loads(line)["ego"] == "ego" for line in lines[""]) == len(lines["live"]), "live frames of the ego")


def sizes_are_those_of_sumo(folder):
    """Asks a running SUMO (TraCI) for length, width and height of every class and default type that --help names."""
    page = subprocess.run([os.path.join(BIN, "glint-traffic-sumo"), "--help"], capture_output=True, check=True).stdout
    lists = re.findall(r"^    (\w+): (.+)$", re.sub(r",\n +", ", ", page.decode()), re.M)
    words = [(word, class_) for class_, words in lists for word in words.split(", ")]
    words = [(word, class_) for word, class_ in words if word not in ("container", "DEFAULT_RAILTYPE")]  # 1.15 has neither
    check(len(words) >= 28, f"words of --help: {words}")
    with open(os.path.join(folder, "t.rou.xml"), "w", encoding="utf-8") as file:
        types = "".join(f'<vType id="{word}" vClass="{word}"/>' for word, _ in words if not word.startswith("DEFAULT"))
        file.write(f"<routes>{types}</routes>")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    users = "".join(f'<vehicle id="{i}" x="{100 * i}" y="0" angle="90" type="{word}"/>'
                    for i, (word, _) in enumerate(words))
    frames = run("glint-traffic-sumo", "-", "--ego", "0",
                 data=f'<fcd-export><timestep time="0">{users}</timestep></fcd-export>'.encode())
    ours = {part["id"]: part for part in frames[0]["objects"]}
    with subprocess.Popen(["sumo", "-n", "n.net.xml", "-r", "t.rou.xml", "--remote-port", str(port)], cwd=folder,
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as sumo:
        with connection(port) as link:
            for i, (word, class_) in enumerate(words):
                theirs = [ask(link, variable, word) for variable in (0x44, 0x4D, 0xBC)]
                mine = [ours[str(i)][f"{size}_m"] for size in ("length", "width", "height")]
                check(mine == theirs, f"{word}: {mine}, in SUMO {theirs}")
                check(ours[str(i)]["class"] == class_, f"{word}: {ours[str(i)]['class']}")
            link.sendall(struct.pack("!iBB", 6, 2, 0x7F))
        sumo.wait(PATIENCE_S)
    print(f"sizes of {len(words)} classes and types are those of SUMO")


def connection(port):
    for _ in range(PATIENCE_S * 20):
        try:
            return socket.create_connection(("127.0.0.1", port), timeout=PATIENCE_S)
        except OSError:
            time.sleep(0.05)
    return sys.exit("recorded: SUMO does not listen")


def ask(link, variable, name):
    """A number that SUMO knows of a type: the last eight bytes of its answer."""
    text = name.encode()
    link.sendall(struct.pack("!iBBBi", 11 + len(text), 7 + len(text), 0xA5, variable, len(text)) + text)
    answer = link.recv(4, socket.MSG_WAITALL)
    answer = link.recv(struct.unpack("!i", answer)[0] - 4, socket.MSG_WAITALL)
    return struct.unpack("!d", answer[-8:])[0]


def degrees_are_refused(folder):
    """A net with a projection; SUMO has several words for a switch that is on."""
    nodes = re.sub(r'x="(\d+)" y="(\d+)"', lambda at: f'x="{11 + int(at[1]) / 75000}" y="{48 + int(at[2]) / 111000}"', NODES)
    with open(os.path.join(folder, "geo.nod.xml"), "w", encoding="utf-8") as file:
        file.write(nodes)
    subprocess.run(["netconvert", "-n", "geo.nod.xml", "-e", "n.edg.xml", "-o", "geo.net.xml", "--proj.utm", "true"],
                   cwd=folder, **QUIET)
    path = os.path.join(folder, "geo.xml")
    for word, on in (("true", True), ("1", True), ("ON", True), ("yes", True), ("x", True), ("off", False), ("no", False)):
        subprocess.run(["sumo", "-n", "geo.net.xml", "-r", "n.rou.xml", "--end", "6", "--fcd-output", path,
                        "--fcd-output.geo", word], cwd=folder, **QUIET)
        words = (path, "--ego", "ego", "--types", os.path.join(folder, "n.rou.xml"))
        if on:
            text, frames = run("glint-traffic-sumo", *words, fails=65)
            check("expected coordinates in metres: run sumo without that option" in text and frames == 0, text)
        else:
            check(len(run("glint-traffic-sumo", *words)) > 0, f"--fcd-output.geo {word}")


with tempfile.TemporaryDirectory() as place:
    if "--sumo" in sys.argv[2:]:
        beside_sumo(place)
    elif os.path.exists(os.path.join(BIN, "glint-traffic-sumo")):
        exactness(place)
        riders_are_hidden(place)
        every_ego_is_as_if_alone(place)
        a_mirrored_world_is_mirrored(place)
        a_loop_in_lock_step_never_waits()
        a_loop_closes_through_the_whole_chain()
        memory_is_constant()
        tables_of_sumo(place)
        places_reach_to_their_bound()
        early_ends(place)
        a_tag_has_an_end(place)
        a_type_has_the_sizes_of_its_class(place)
        a_class_that_is_none_of_glint_is_named(place)
        types_come_from_several_files(place)
        bad_input(place)
        lane_changes_take_their_time()
        jumps_may_overlap_and_are_no_teleports()
        motion_without_jumps_is_that_of_the_file()
        bodies_turn_with_their_way()
        targets_of_a_lane_change_have_the_speed_of_the_lane(place)
        places_in_degrees_are_told_by_their_speeds(place)
    else:
        print("skipped  glint-traffic-sumo: it is not there, as it needs expat")
    if "--sumo" not in sys.argv[2:]:
        resampling_error(place)
        every_scene_has_a_name_of_its_own(place)
        lists_of_egos_may_be_long(place)
        if DATA is not None:
            files_of_other_programs_are_named()
        else:
            print("skipped  files of other programs are named: GLINT_TEST_DATA is not set")
print(f"recorded: {recorded.checks} checks hold")
