"""Heights of recorded traffic: who is on the ego's road, from every source that has heights.

Usage: python3 tests/chain/levels.py BIN_DIR
"""
import json
import math
import os
import select
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import recorded  # noqa: E402
from osi_messages import VERSION, message, real, stamp, trace_of, vector, whole  # noqa: E402
from recorded import BIN, PATIENCE_S, check, run, save  # noqa: E402

STEP_S, STEPS = 0.1, 60

# ---- scenes: places, heights of the road and yaws at a time -----------------------------------------------


def along(ahead_m, speed, height, side_m=0.0):
    """Drives along x; height is that of the road by x."""
    return lambda t: (ahead_m + speed * t, side_m, height(ahead_m + speed * t), 0.0, speed)


def across(x_m, from_m, speed, height_m):
    return lambda t: (x_m, from_m + speed * t, height_m, math.pi / 2, speed)


def hill(x):
    return 0.06 * x


def flat(_):
    return 0.0


HILL = {"0": along(0, 15, hill), "1": along(250, 15, hill), "2": along(-250, 14, hill, 3.5)}
BRIDGE = {"0": along(-60, 15, flat), "1": along(-30, 15, flat), "2": across(20, -40, 12, 6.0), "3": across(26, 50, -12, 6.0),
          "4": along(-200, 16, lambda x: 6.0, 2)}
ON_BRIDGE = {"0": along(-60, 15, lambda x: 6.0), "1": along(-30, 15, lambda x: 6.0), "2": across(20, -40, 12, 0.0)}
OVER_HILL = {"0": along(-60, 15, hill), "1": along(-30, 15, hill, 3.5), "2": across(20, -40, 12, hill(20) + 6),
             "3": across(40, -50, 12, hill(40))}
SCENES = (("a hill", HILL, {"0", "1", "2"}), ("a bridge", BRIDGE, {"0", "1"}), ("on a bridge", ON_BRIDGE, {"0", "1"}),
          ("a bridge over a hill", OVER_HILL, {"0", "1", "3"}))
TIMES = [round(i * STEP_S, 3) for i in range(STEPS)]

# ---- the scenes in each format ----------------------------------------------------------------------------


def sumo(scene, heights=True, slope=None):
    steps = []
    for t in TIMES:
        rows = []
        for name, drive in scene.items():
            x, y, z, yaw, speed = drive(t)
            more = (f' z="{z:.2f}"' if heights else "") + (f' slope="{slope(name)}"' if slope else "")
            rows.append(f'<vehicle id="{name}" x="{x:.2f}" y="{y:.2f}"{more} angle="{90 - math.degrees(yaw):.2f}" '
                        f'speed="{speed:.2f}"/>')
        steps.append(f'<timestep time="{t:.2f}">' + "".join(rows) + "</timestep>\n")
    return ("<fcd-export>\n" + "".join(steps) + "</fcd-export>\n").encode()


def sumo_table(scene):
    rows = ["timestep_time;vehicle_id;vehicle_x;vehicle_y;vehicle_z;vehicle_angle;vehicle_speed"]
    for t in TIMES:
        for name, drive in scene.items():
            x, y, z, yaw, speed = drive(t)
            rows.append(f"{t};{name};{x:.2f};{y:.2f};{z:.2f};{90 - math.degrees(yaw):.2f};{speed}")
    return ("\n".join(rows) + "\n").encode()


def esmini(scene):
    columns = ("Entity_Name [-]", "World_Position_X [m]", "World_Position_Y [m]", "World_Position_Z [m]", "Vel_X [m/s]",
               "Vel_Y [m/s]", "World_Heading_Angle [rad]", "Heading_Angle_Rate [rad/s]", "bb_x [m]", "bb_y [m]",
               "bb_length [m]", "bb_width [m]", "bb_height [m]")
    rows = ["Index [-],TimeStamp [s]," + ",".join(f"#{i + 1} {name}" for i in range(len(scene)) for name in columns)]
    for i, t in enumerate(TIMES):
        cells = [str(i), f"{t}"]
        for name, drive in scene.items():
            x, y, z, yaw, speed = drive(t)
            cells += [name, *(f"{value:.6f}" for value in (
                x, y, z, speed * math.cos(yaw), speed * math.sin(yaw), yaw, 0, 0, 0, 4.5, 1.8, 1.5))]
        rows.append(",".join(cells))
    return ("\n".join(rows) + "\n").encode()


def body(number, x, y, z, yaw, height=1.5, velocity=None, kind=None, pitch=0.0):
    """A moving object, or with a kind a stationary one; z is the height of the road below it, None: none is said."""
    place = [real(1, x), real(2, y)] + ([real(3, z + height / 2)] if z is not None else [])
    base = message(2, vector(1, 4.5, 1.8, height), message(2, *place), vector(3, 0, pitch, yaw),
                   vector(4, *velocity, 0) if velocity else b"")
    more = message(3, whole(1, kind)) if kind else whole(3, 2) + message(6, whole(1, 4))
    return message(4 if kind else 5, message(1, whole(1, number)), base, more)


def osi(scene, heights=True):
    steps = []
    for t in TIMES:
        parts = [VERSION, stamp(round(t * 1e9)), message(3, whole(1, 0))]
        for name, drive in scene.items():
            x, y, z, yaw, speed = drive(t)
            height = 3.5 if name == "2" else 1.5  # whose centre is higher by a metre
            parts.append(body(int(name), x, y, z if heights else None, yaw, height,
                              (speed * math.cos(yaw), speed * math.sin(yaw))))
        steps.append(b"".join(parts))
    return trace_of(*steps)


FORMATS = (("glint-traffic-sumo", "fcd.xml", sumo), ("glint-traffic", "fcd.csv", sumo_table), ("glint-traffic", "log.csv", esmini),
           ("glint-traffic-osi", "trace.osi", osi))


def ids(frames):
    return [{part["id"] for part in frame["objects"]} for frame in frames]


def note_of(program, *words):
    done = subprocess.run([os.path.join(BIN, program), *words], capture_output=True, check=True, timeout=PATIENCE_S)
    return done.stderr.decode()


# ---- tests ------------------------------------------------------------------------------------------------


def a_hill_keeps_all_and_a_bridge_keeps_none(folder):
    """In every frame, from every source, resampled and with a radius too; what is left out is counted."""
    for program, name, write in FORMATS:
        for title, scene, on in SCENES:
            path = save(folder, name, write(scene))
            for words in ((), ("--rate-hz", "17"), ("--radius-m", "1000")):
                found = ids(run(program, path, "--ego", "0", *words))
                check(all(one == on for one in found) and len(found) > 50, f"{program}, {title} {words}: {found}")
            note, others = note_of(program, path, "--ego", "0"), len(scene) - len(on)
            said = f"{path}: {others} bodies are left out of {STEPS} frames, because they are more than 3 m above or below"
            check(said in note if others else "left out" not in note, f"{program}, {title}: {note}")


def whoever_is_above_sees_who_is_above(folder):
    """Each ego has a road of its own."""
    path = save(folder, "fcd.xml", sumo(BRIDGE))
    for frame in run("glint-traffic-sumo", path, "--ego", "all"):
        low = frame["ego"] in ("0", "1")
        check({part["id"] for part in frame["objects"]} == ({"0", "1"} if low else {"2", "3", "4"}), f"{frame['ego']}: {frame}")


def without_heights_all_are_there(folder):
    """As before: a source without heights, and bodies without one among others."""
    for program, name, content in (("glint-traffic-sumo", "fcd.xml", sumo(BRIDGE, heights=False)),
                                   ("glint-traffic-osi", "trace.osi", osi(BRIDGE, heights=False)),
                                   ("glint-traffic-sumo", "fcd.xml", sumo(BRIDGE).replace(b' z="6.00"', b""))):
        path = save(folder, name, content)
        check(all(one == set(BRIDGE) for one in ids(run(program, path, "--ego", "0"))), f"{program} without heights")
        check("left out" not in note_of(program, path, "--ego", "0"), "nothing is left out")


def a_standing_ego_has_the_slope_that_the_source_states(folder):
    """SUMO's slope, and OSI's pitch, which is positive with the nose down, tell it of a road that nobody drives."""
    scene = {"0": along(0, 0, hill), "1": along(120, 0, hill)}
    plain = save(folder, "fcd.xml", sumo(scene, slope=lambda _: "0.00"))
    check(ids(run("glint-traffic-sumo", plain, "--ego", "0"))[5] == {"0"}, "nothing tells the slope")
    sloped = save(folder, "fcd.xml", sumo(scene, slope=lambda _: f"{math.degrees(math.atan(0.06)):.2f}"))
    check(ids(run("glint-traffic-sumo", sloped, "--ego", "0"))[5] == {"0", "1"}, "SUMO's slope")
    for pitch, on in ((-math.atan(0.06), {"0", "1"}), (math.atan(0.06), {"0"})):
        steps = [stamp(i * 100_000_000) + body(0, 0, 0, 0, 0, pitch=pitch, velocity=(0, 0)) +
                 body(1, 120, 0, 7.2, 0, pitch=pitch, velocity=(0, 0)) for i in range(3)]
        path = save(folder, "trace.osi", trace_of(*steps))
        check(ids(run("glint-traffic-osi", path, "--ego", "0"))[1] == on, f"pitch {pitch}")


def things_stand_on_a_road_with_any_part(folder):
    """A house with a cellar stands beside the road, a lamp of a bridge over it does not."""
    steps = [stamp(i * 100_000_000) + body(0, i, 0, 0, 0, velocity=(10, 0)) + body(90, 30, 9, -6, 0, 20, kind=3) +
             body(91, 40, 3, 6, 0, 5, kind=4) + body(92, 50, 3, 0, 0, 5, kind=4) for i in range(5)]
    found = ids(run("glint-traffic-osi", save(folder, "trace.osi", trace_of(*steps)), "--ego", "0"))
    check(all(one == {"0", "90", "92"} for one in found), f"things: {found}")


def heights_of_osi_are_those_of_centres(folder):
    """The road below a truck is 2.5 m above the ego's, its centre 3.75 m above the ego's."""
    steps = [stamp(i * 100_000_000) + body(0, i, 0, 0, 0, velocity=(10, 0)) + body(1, 9 + i, 3, 2.5, 0, 4, velocity=(10, 0)) +
             body(2, 9 + i, -3, 3.1, 0, velocity=(10, 0)) for i in range(5)]
    found = ids(run("glint-traffic-osi", save(folder, "trace.osi", trace_of(*steps)), "--ego", "0"))
    check(all(one == {"0", "1"} for one in found), f"centres: {found}")


def heights_are_resampled(folder):
    """Whoever climbs 6 m from one step to the next is on the ego's road at first."""
    text = "<fcd-export>" + "".join(
        f'<timestep time="{t}"><vehicle id="0" x="{10 * t}" y="0" z="0" angle="90" speed="10"/>'
        f'<vehicle id="1" x="30" y="{50 * t - 25}" z="{6 * t}" angle="0" speed="50"/></timestep>' for t in (0, 1)) + "</fcd-export>"
    frames = run("glint-traffic-sumo", save(folder, "fcd.xml", text.encode()), "--ego", "0", "--rate-hz", "8")
    check([len(one) for one in ids(frames)] == [2, 2, 2, 2, 2, 1, 1, 1, 1], f"resampled: {ids(frames)}")


def a_live_source_has_the_slope_of_the_way_so_far():
    """From the second step on, before the next one arrives."""
    with subprocess.Popen([os.path.join(BIN, "glint-traffic-osi"), "-", "--live"], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE) as loop:
        for i, one in enumerate(HILL["0"](t) for t in TIMES[:20]):
            far = HILL["1"](TIMES[i])
            os.write(loop.stdin.fileno(), trace_of(stamp(round(TIMES[i] * 1e9)) + message(3, whole(1, 0)) + b"".join(
                body(number, x, y, z, yaw, velocity=(speed, 0)) for number, (x, y, z, yaw, speed) in ((0, one), (1, far)))))
            check(bool(select.select([loop.stdout.fileno()], [], [], PATIENCE_S)[0]), f"no frame {i} before the next message")
            objects = json.loads(os.read(loop.stdout.fileno(), 1 << 16))["objects"]
            check(len(objects) == (2 if i > 0 else 1), f"live frame {i}: {objects}")
        loop.stdin.close()
        check(loop.wait(PATIENCE_S) == 0, "the loop ends well")


def bad_heights_are_refused(folder):
    text = sumo(BRIDGE, slope=lambda _: "0.00")
    for old, new, said in ((b' z="0.00"', b' z="high"', 'z is "high"; expected a number in [-1e+09, 1e+09]'),
                           (b' slope="0.00"', b' slope="steep"', 'slope is "steep"; expected a number')):
        path = save(folder, "fcd.xml", text.replace(old, new, 1))
        message_of, _ = run("glint-traffic-sumo", path, "--ego", "0", fails=65)
        check(f"{path}: line 2: {said}" in message_of, message_of)
    path = save(folder, "trace.osi", trace_of(stamp(0) + body(0, 0, 0, math.nan, 0)))
    message_of, _ = run("glint-traffic-osi", path, "--ego", "0", fails=65)
    check("moving_object 0: base.position.z is nan; expected a number in" in message_of, message_of)


with tempfile.TemporaryDirectory() as place:
    missing = [name for name in ("glint-traffic-sumo", "glint-traffic-osi") if not os.path.exists(os.path.join(BIN, name))]
    if not missing:
        a_hill_keeps_all_and_a_bridge_keeps_none(place)
        whoever_is_above_sees_who_is_above(place)
        without_heights_all_are_there(place)
        a_standing_ego_has_the_slope_that_the_source_states(place)
        things_stand_on_a_road_with_any_part(place)
        heights_of_osi_are_those_of_centres(place)
        heights_are_resampled(place)
        a_live_source_has_the_slope_of_the_way_so_far()
        bad_heights_are_refused(place)
    else:
        print(f"skipped  heights of traffic: {' and '.join(missing)} are not there, as they need expat and libprotobuf-c")
print(f"levels: {recorded.checks} checks hold")
