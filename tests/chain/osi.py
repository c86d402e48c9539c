"""Traces of OSI against protoc with the full interface, and against messages that are packed here, byte by byte.

Usage: python3 tests/chain/osi.py BIN_DIR
"""
import gzip
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import recorded  # noqa: E402
from osi_messages import (  # noqa: E402
    LANE, VERSION, box, decode, message, moving, stamp, stationary, trace_of, value_of, vector, whole)
from recorded import (  # noqa: E402
    BIN, DATA, PATIENCE_S, check, check_mirrored, compare, egos_as_if_alone, in_lock_step, run, save, slopes)

PROGRAM = "glint-traffic-osi"
VEHICLES = {"TYPE_SMALL_CAR": "car", "TYPE_CAR": "car", "TYPE_MEDIUM_CAR": "car", "TYPE_HEAVY_TRUCK": "truck",
            "TYPE_VAN": "van", "TYPE_DELIVERY_VAN": "van", "TYPE_BUS": "bus", "TYPE_MOTORBIKE": "motorcycle",
            "TYPE_MOTORCYCLE": "motorcycle", "TYPE_BICYCLE": "bicycle", "TYPE_SEMITRAILER": "truck"}

# ---- a trace of our own ---------------------------------------------------------------------------------

STEP_NS = 50_000_000


def drive(step, sign=1):
    """A car that turns, as the host; the velocity is that of its rear axle, 1.4 m behind the centre."""
    rate, speed = 0.5, 8.0
    yaw = rate * step * STEP_NS * 1e-9
    x, y = speed / rate * math.sin(yaw), speed / rate * (1 - math.cos(yaw))
    rear = 1.4
    return {"x": x + rear * math.cos(yaw), "y": sign * (y + rear * math.sin(yaw)), "yaw": sign * yaw, "rate": sign * rate,
            "velocity": (speed * math.cos(yaw), sign * speed * math.sin(yaw)), "rear": (-rear, 0, -0.35)}


def own_trace(sign=1, zeros=True, count=6):
    """The host, of id 0; a tractor with its trailer; a walker without velocities; a pole and a bridge, said once."""
    for step in range(count):
        near = step % 50  # so that a long trace stays where it is
        parts = [VERSION, stamp(step * STEP_NS, zeros), message(3, whole(1, 0) if zeros else b"")]
        if step == 0:
            parts += [stationary(90, 4, 20, sign * 5.5), stationary(91, 2, 40, sign * 2), LANE]
        parts += [moving(0, 4, **drive(step, sign), zeros=zeros), LANE,
                  moving(7, 16, 30 + near, sign * 3.5, sign * 0.0, (6, 2.5, 3.5), (20, 0), 0, zeros=zeros),
                  moving(8, 8, 22 + near, sign * 3.5, sign * 0.0, (13, 2.5, 4), (20, 0), 0, zeros=zeros)]
        if step > 1:
            parts.append(moving(2**64 - 1, "pedestrian", 12 + 0.1 * near * near, sign * (8 + 0.05 * near), None, (0, 0, 0)))
        yield b"".join(parts)


def own_states(count=6, rear_axle=False):
    steps = {}
    for step in range(count):
        at = drive(step)
        vx, vy = at["velocity"]
        if rear_axle:
            vx, vy = vx - 1.4 * at["rate"] * math.sin(at["yaw"]), vy + 1.4 * at["rate"] * math.cos(at["yaw"])
        steps[step * STEP_NS * 1e-9] = {
            "0": {"class": "car", "x_m": at["x"], "y_m": at["y"], "yaw_rad": at["yaw"], "yaw_rate_radps": at["rate"],
                  "vx_mps": vx, "vy_mps": vy, "length_m": 4.5, "width_m": 1.8, "height_m": 1.5},
            "7": {"class": "truck", "x_m": 30 + step, "y_m": 3.5, "yaw_rad": 0, "vx_mps": 20, "length_m": 6},
            "8": {"class": "truck", "x_m": 22 + step, "y_m": 3.5, "yaw_rad": 0, "vx_mps": 20, "length_m": 13},
            "90": {"class": "post", "x_m": 20, "y_m": 5.5, "vx_mps": 0, "vy_mps": 0, "yaw_rate_radps": 0, "height_m": 3}}
    times = sorted(steps)[2:]
    xs, ys = ([12 + 0.1 * i * i for i in range(2, count)], [8 + 0.05 * i for i in range(2, count)])
    for i, (time, vx, vy) in enumerate(zip(times, slopes(times, xs), slopes(times, ys))):
        steps[time][str(2**64 - 1)] = {"class": "pedestrian", "x_m": xs[i], "y_m": ys[i], "vx_mps": vx, "vy_mps": vy,
                                       "yaw_rad": math.atan2(vy, vx), "length_m": 0, "width_m": 0, "height_m": 0}
    return {round(time, 9): users for time, users in steps.items()}


def sensor_view(truth):
    return VERSION + stamp(0) + message(3, whole(1, 77)) + message(7, truth) + message(8, whole(1, 8))


def exactness(folder):
    for zeros in (True, False):
        content = trace_of(*own_trace(zeros=zeros))
        path = save(folder, "own.osi", content)
        compare(run(PROGRAM, path), own_states(), "0")
        compare(run(PROGRAM, path, "--rear-axle-velocity"), own_states(rear_axle=True), "0")
        compare(run(PROGRAM, path, "--ego", str(2**64 - 1)), own_states(), str(2**64 - 1))
        compare(run(PROGRAM, "-", data=content), own_states(), "0")
        compare(run(PROGRAM, save(folder, "own.osi.gz", gzip.compress(content))), own_states(), "0")
    views = trace_of(*[sensor_view(truth) for truth in own_trace()])
    compare(run(PROGRAM, save(folder, "views.osi", views)), own_states(), "8")
    late = trace_of(VERSION + stamp(1_700_000_000_123_456_789) + moving(5, 4, 0, 0, 0.0))
    check(run(PROGRAM, save(folder, "late.osi", late), "--ego", "5")[0]["time_s"] == 1700000000.123456789, "time since 1970")
    moved = [next(own_trace()), stamp(STEP_NS) + moving(0, 4, 0, 0, 0.0) + stationary(95, 11, 1, 2)]
    frames = run(PROGRAM, save(folder, "moved.osi", trace_of(*moved)))
    check([part["id"] for part in frames[1]["objects"]] == ["0", "95"], "stationary objects stay until others come")


def every_message_with_a_ground_truth_is_read(folder):
    """Views and data of sensors; the time and the host of a message serve where its ground truth has none."""
    def data(view):
        return (VERSION + stamp(5 * STEP_NS) + message(5, whole(1, 3)) + message(6, vector(1, 1, 2, 3), vector(2, 0, 0, 1)) +
                message(8, VERSION, stamp(0)) + message(8, view) + message(9, whole(1, 1)) + message(26, VERSION))
    truths = list(own_trace())
    for one in (truths, list(own_trace(zeros=False))):
        compare(run(PROGRAM, save(folder, "data.osi", trace_of(*[data(sensor_view(truth)) for truth in one]))), own_states(), "8")
    mixed = [truths[0], sensor_view(truths[1]), data(sensor_view(truths[2]))]
    compare(run(PROGRAM, save(folder, "mixed.osi", trace_of(*mixed)), "--ego", "0"), own_states(3), "0")
    car = moving(0, 4, 1, 2, 0.0)
    untimed = [VERSION + stamp(i * STEP_NS) + message(7, message(3, b""), car) for i in range(2)]
    frames = run(PROGRAM, save(folder, "untimed.osi", trace_of(*untimed)))
    check([frame["time_s"] for frame in frames] == [0, 0.05] and frames[0]["ego"] == "0", f"time of the view: {frames}")
    light = message(7, message(1, whole(1, 3)))  # a traffic light, where a view has its ground truth
    compare(run(PROGRAM, save(folder, "lights.osi", trace_of(*[truth + light for truth in truths]))), own_states(), "0")
    sensor = message(3, whole(1, 77)) + message(4, vector(1, 1.5, 0, 0.5))
    for content in (stamp(0) + message(5, whole(1, 3)) + message(26, VERSION),
                    stamp(0) + message(8, VERSION, stamp(0), sensor) + message(26, VERSION),
                    VERSION + stamp(0) + message(26, VERSION), VERSION + stamp(0) + sensor,
                    VERSION + stamp(0) + message(3, whole(1, 77)) + message(1001, b"")):
        text, _ = run(PROGRAM, save(folder, "untrue.osi", trace_of(content)), "--ego", "0", fails=65)
        check("without a ground truth; expected a GroundTruth, or a SensorView or SensorData with global_ground_truth" in text, text)


def own_traces_are_read_back(folder):
    """Frames through glint-osi come back with the ids, classes and motions of their objects."""
    def pipe(*stages, data=None):
        for stage in stages:
            data = subprocess.run([os.path.join(BIN, stage[0]), *stage[1:]], input=data, capture_output=True, check=True,
                                  timeout=PATIENCE_S).stdout
        return data
    objects = [{"id": name, "class": kind, "x_m": 30.0 * i, "y_m": 4.0 * i, "speed_mps": speed} for i, (name, kind, speed) in
               enumerate((("all", "car", 15), ("a,b", "articulated_truck", 10), ("7", "pedestrian", 1), ("post 1", "post", 0),
                          ("w", "wall", 0), ("bus", "bus", 12)))]
    scene = {"origin": "made by hand", "ego": "all", "rate_hz": 20, "duration_s": 0.5, "objects": objects}
    path = save(folder, "own.json", json.dumps(scene).encode())
    lines = pipe(("glint-traffic", path), ("glint-extract",), ("glint-ideal", "--sensors", "lrr77-every-frame"),
                 ("glint-sensor",), ("glint-noise", "--sections", "quality"))
    frames = [json.loads(line) for line in lines.splitlines()]
    back = run(PROGRAM, save(folder, "glint.osi", pipe(("glint-osi",), data=lines)))
    check(len(back) == len(frames) and len(frames) > 9, f"{len(back)} frames of {len(frames)}")
    for frame, own in zip(frames, back):
        check(own["ego"] == "all" and abs(own["time_s"] - frame["time_s"]) < 1e-9, f"ego and time of {own}")
        check([part["id"] for part in own["objects"]] == sorted(part["id"] for part in objects), f"who is there: {own}")
        parts = {part["id"]: part for part in frame["objects"]}
        for part in own["objects"]:
            same = [key for key in part if key != "travelled_m" and part[key] != parts[part["id"]].get(key)]
            check(not same, f"{part['id']}: {same} of {part}, {parts[part['id']]}")


def a_type_that_is_missing_is_said(folder):
    """A classification of vehicles makes a vehicle; without it the message names the field that is missing."""
    name, place = message(1, whole(1, 5)), box(1, 2, 0.0, (4, 2, 1.5))
    bus = message(6, whole(1, 12))
    for kind in (b"", whole(3, 0)):
        frame = run(PROGRAM, save(folder, "bus.osi", trace_of(stamp(0) + message(5, name, place, kind, bus))), "--ego", "5")[0]
        check(frame["objects"][0]["class"] == "bus", f"a classification without a type: {frame}")
    for parts, said in (
            (b"", "moving_object 5: type is missing or unknown; expected TYPE_VEHICLE, TYPE_PEDESTRIAN or TYPE_ANIMAL, or a "
             "vehicle_classification; --class-map unknown=CLASS or --class-default CLASS names one"),
            (whole(3, 2), "moving_object 5: vehicle_classification.type is missing or unknown; expected a type of vehicles; "
             "--class-map unknown_vehicle=CLASS or --class-default CLASS names one"),
            (message(6, b""), "--class-map unknown_vehicle=CLASS or"),
            (whole(3, 1), 'unknown class "other"'), (whole(3, 2) + message(6, whole(1, 1)), 'unknown class "other_vehicle"'),
            (whole(3, 2) + message(6, whole(1, 20)), 'unknown class "watercraft"')):
        path = save(folder, "typeless.osi", trace_of(stamp(0) + message(5, name, place, parts)))
        text, _ = run(PROGRAM, path, "--ego", "5", fails=65)
        check(f"{path}: byte 0: " in text and said in text, text)
        word = re.search("--class-map ([a-z_]+)=CLASS", text)[1]
        frame = run(PROGRAM, path, "--ego", "5", "--class-map", word + "=van")[0]
        check(frame["objects"][0]["class"] == "van", f"--class-map {word}: {frame}")


def shared_options(folder):
    path = os.path.join(folder, "own.osi")
    for words in ((), ("--radius-m", "25"), ("--rate-hz", "50"), ("--from-s", "0.1", "--to-s", "0.2")):
        together = egos_as_if_alone(PROGRAM, path, *words)
        check(sorted(together) == ["0", "7", "8"], f"egos are all vehicles: {sorted(together)}")
    mapped = run(PROGRAM, path, "--class-map", "semitrailer=van,pole=guardrail")
    check([part["class"] for part in mapped[0]["objects"]] == ["car", "truck", "van", "guardrail"], "--class-map")
    strange = save(folder, "strange.osi", trace_of(stamp(0) + moving(0, 25, 0, 0, 0.0)))
    text, _ = run(PROGRAM, strange, "--ego", "0", fails=65)
    check('unknown class "vehicle_25"; expected a word that --help lists' in text, text)
    check(run(PROGRAM, strange, "--ego", "0", "--class-default", "bus")[0]["objects"][0]["class"] == "bus", "--class-default")
    none = save(folder, "none.osi", trace_of(stamp(0) + moving(0, 4, 0, 0, 0.0)))
    text, _ = run(PROGRAM, none, fails=64)
    check("a recording has no ego of its own; expected --ego" in text, text)


def a_mirrored_world_is_mirrored(folder):
    path = save(folder, "mirrored.osi", trace_of(*own_trace(sign=-1)))
    for words in ((), ("--rear-axle-velocity",), ("--rate-hz", "70")):
        check_mirrored(run(PROGRAM, os.path.join(folder, "own.osi"), *words), run(PROGRAM, path, *words))


def a_loop_in_lock_step_never_waits():
    """A stand-in of a simulator writes a message, and waits for its frame before it writes the next."""
    messages = [trace_of(stamp(i * STEP_NS) + message(3, b"") + moving(0, 4, 0.4 * i, 0, 0.0, zeros=False)) for i in range(200)]
    for i, frame in enumerate(in_lock_step(PROGRAM, ["-", "--live"], messages)):
        check(frame["frame"] == i and abs(frame["objects"][0]["vx_mps"] - 8 * (i > 0)) < 1e-9, f"live frame {i}: {frame}")


def memory_is_constant():
    """What is resident while a simulator writes on."""
    def resident_kb(process):
        with open(f"/proc/{process.pid}/status", encoding="ascii") as file:
            return int(re.search(r"VmRSS:\s+(\d+) kB", file.read())[1])
    kilobytes = {}
    with subprocess.Popen([os.path.join(BIN, PROGRAM), "-", "--live"], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as loop:
        for i, one in enumerate(own_trace(count=10001)):
            os.write(loop.stdin.fileno(), trace_of(one))
            loop.stdout.readline()
            if i in (1000, 10000):
                kilobytes[i] = resident_kb(loop)
        loop.stdin.close()
        check(loop.wait(PATIENCE_S) == 0, "the loop ends well")
    print(f"osi: {kilobytes[1000]} kB of memory after 1,000 messages, {kilobytes[10000]} kB after 10,000")
    check(kilobytes[10000] <= kilobytes[1000] + 100, f"memory grows: {kilobytes} kB")


def early_ends(folder):
    """Wherever a trace is cut, the whole messages come out, and the message names the last of them."""
    content, ends = b"", []
    for one in own_trace():
        content += trace_of(one)
        ends.append(len(content))
    for cut in (*range(1, len(content), 97), *[end + more for end in ends[:-1] for more in (1, 3, 4)]):
        path, count = save(folder, "cut.osi", content[:cut]), sum(end <= cut for end in ends)
        if cut in ends:
            check(len(run(PROGRAM, path)) == count, f"cut at {cut}, between messages")
            continue
        text, frames = run(PROGRAM, path, fails=65)
        said = f"the last whole message is that of {0.05 * (count - 1):g} s" if count else "no message is whole"
        check(said in text and f"byte {ends[count - 1] if count else 0}: " in text, f"cut at {cut}: {text}")
        check(frames == count, f"cut at {cut}: {frames} frames")


def bad_input(folder):
    """Each is the second message of a trace; the message says its byte."""
    first = trace_of(next(own_trace()))
    nan, car = float("nan"), {"number": 5, "kind": 4}
    cases = [
        (stamp(0), "0 s after a step of 0 s; expected a later time"),
        (b"", "timestamp is missing; expected one in each"),
        (moving(0, 4, 1, 1), "timestamp is missing; expected one in each"),
        (message(2, whole(1, 10**10)), "timestamp is 10000000000 s and 0 ns; expected seconds in [-9e9, 9e9]"),
        (message(2, whole(1, 1), whole(2, 10**9)), "timestamp is 1 s and 1000000000 ns; expected seconds in"),
        (b"\xff" * 20, "a message of 20 bytes without a ground truth; expected a GroundTruth, or a SensorView or SensorData with global_ground_truth, "
         "behind its length"),
        (stamp(STEP_NS)[:-1], " bytes without a ground truth; expected"),
        (stamp(STEP_NS) + message(5, message(1, whole(1, 5)), whole(2, 3)), " bytes without a ground truth; expected"),
        (stamp(STEP_NS) + message(5, box(0, 0, 0, (1, 1, 1))), "moving_object: id is missing; expected one in each"),
        (stamp(STEP_NS) + message(5, message(1, whole(1, 5))), "moving_object: base.position is missing; expected one in each"),
        (stamp(STEP_NS) + moving(**car, x=nan, y=0),
         "moving_object 5: base.position.x is nan; expected a number in [-1e+09, 1e+09]"),
        (stamp(STEP_NS) + moving(**car, x=0, y=2e9), "moving_object 5: base.position.y is 2e+09; expected a number in"),
        (stamp(STEP_NS) + moving(**car, x=0, y=0, yaw=math.inf), "moving_object 5: base.orientation.yaw is inf; expected"),
        (stamp(STEP_NS) + moving(**car, x=0, y=0, size=(-1, 1, 1)),
         "moving_object 5: base.dimension.length is -1; expected a number in [0, 1e+06]"),
        (stamp(STEP_NS) + moving(**car, x=0, y=0, size=(1, nan, 1)), "moving_object 5: base.dimension.width is nan; expected"),
        (stamp(STEP_NS) + moving(**car, x=0, y=0, size=(1, 1, 1e9)), "moving_object 5: base.dimension.height is 1e+09; expected"),
        (stamp(STEP_NS) + moving(**car, x=0, y=0, velocity=(1e5, 0)), "moving_object 5: base.velocity.x is 100000; expected"),
        (stamp(STEP_NS) + moving(**car, x=0, y=0, velocity=(0, nan)), "moving_object 5: base.velocity.y is nan; expected"),
        (stamp(STEP_NS) + moving(**car, x=0, y=0, rate=-2e3), "moving_object 5: base.orientation_rate.yaw is -2000; expected"),
        (stamp(STEP_NS) + moving(**car, x=0, y=0, yaw=0, velocity=(1, 0), rate=1, rear=(nan, 0)),
         "moving_object 5: bbcenter_to_rear is (nan, 0); expected numbers in [-1e3, 1e3]"),
        (stamp(STEP_NS) + stationary(6, 4, nan, 0), "stationary_object 6: base.position.x is nan; expected a number"),
        (stamp(STEP_NS) + moving(0, 4, 0, 0) + moving(0, 4, 1, 1), "id of an object 0 at 0.05 s is in byte "),
        (stamp(STEP_NS) + moving(0, 4, 0, 0) + stationary(0, 4, 1, 1), "id of an object 0 at 0.05 s is in byte "),
        (stamp(STEP_NS) + moving(0, 0, 0, 0), "moving_object 0: vehicle_classification.type is missing or unknown; expected a type of vehicles; --class-map "
         "unknown_vehicle=CLASS or --class-default CLASS names one"),
    ]
    for content, said in cases:
        path = save(folder, "bad.osi", first + trace_of(content))
        text, _ = run(PROGRAM, path, "--ego", "0", "--rear-axle-velocity", fails=65)
        check(f"{PROGRAM}: {path}: byte {len(first)}: " in text and said in text, f"{said}: {text}")
    for content, said in ((b"\x01\x02\x03", "byte 0: the trace ends inside a message; no message is whole"),
                          (struct.pack("<I", 1 << 31), "byte 0: the length of a message is 2147483648; expected at most"),
                          (b"\x89MCAP0\r\n" + bytes(50), "a log of MCAP; "),
                          (b"<?xml version='1.0'?>\n<commonRoad ", "glint-traffic-commonroad reads it")):
        text, _ = run(PROGRAM, save(folder, "bad.osi", content), "--ego", "0", fails=65)
        check(said in text, f"{said}: {text}")
    for name, content in (("empty.osi", b""), ("empty.osi.gz", gzip.compress(b""))):
        for words in ((), ("--ego", "0"), ("--ego", "all", "--live")):
            text, _ = run(PROGRAM, save(folder, name, content), *words, fails=65)
            check("the trace is empty; expected messages of OSI" in text, text)
    text, _ = run(PROGRAM, os.path.join(folder, "absent.osi"), fails=66)
    check("absent.osi: No such file or directory" in text, text)
    for name in ("own.osi", "none.osi"):  # which begin with a version and with a time
        text, _ = run("glint-traffic", os.path.join(folder, name), "--ego", "0", fails=65)
        check("an OSI trace; glint-traffic-osi reads it" in text, text)


# ---- real traces, decoded with the full interface -------------------------------------------------------


def decoded(path, folder):
    with open(path, "rb") as file:
        return decode(file.read(), "GroundTruth", folder, f"{DATA}/osi/proto", "osi_groundtruth.proto")


def states_of(truths):
    steps, tracks = {}, {}
    for truth in truths:
        time = round(value_of(truth, "timestamp", "seconds") + value_of(truth, "timestamp", "nanos") * 1e-9, 9)
        steps[time] = {}
        for thing in truth.get("moving_object", []):
            one = {key: value_of(thing, "base", *path) for key, path in {
                "x_m": ("position", "x"), "y_m": ("position", "y"), "yaw_rad": ("orientation", "yaw"),
                "vx_mps": ("velocity", "x"), "vy_mps": ("velocity", "y"), "yaw_rate_radps": ("orientation_rate", "yaw"),
                "length_m": ("dimension", "length"), "width_m": ("dimension", "width"),
                "height_m": ("dimension", "height")}.items()}
            kind = thing["type"][-1]
            one["class"] = ("pedestrian" if kind == "TYPE_PEDESTRIAN"
                            else VEHICLES[thing["vehicle_classification"][-1]["type"][-1]])
            name = f"{value_of(thing, 'id', 'value'):.0f}"
            steps[time][name] = one
            tracks.setdefault(name, []).append((time, one, value_of(thing, "vehicle_attributes", "bbcenter_to_rear", "x")))
    return steps, tracks


def real_traces(folder):
    if DATA is None or shutil.which("protoc") is None:
        print(f"skipped  traces of OSI: {'there is no protoc' if DATA else 'GLINT_TEST_DATA is not set'}")
        return
    for name in ("acc-test", "pedestrian"):
        path = f"{DATA}/osi/{name}.osi"
        steps, tracks = states_of(decoded(path, folder))
        check(len(steps) > 400 and len(tracks) >= 2, f"{name}: {len(steps)} steps, {len(tracks)} objects")
        for ego in tracks:
            compare(run(PROGRAM, path, "--ego", ego), steps, ego)
        centres_of_esmini_move_about_their_rear_axles(name, path, tracks["0"])


def centres_of_esmini_move_about_their_rear_axles(name, path, track):
    """Its places are of centres, its velocities of rear axles: moved to the centres they are the slopes of the places."""
    times = [time for time, _, _ in track]
    slope = list(zip(*[slopes(times, [one[key] for _, one, _ in track]) for key in ("x_m", "y_m")]))
    worst = {}
    for words in ((), ("--rear-axle-velocity",)):
        parts = [next(part for part in frame["objects"] if part["id"] == "0")
                 for frame in run(PROGRAM, path, "--ego", "0", *words)]
        turning = [i for i in range(2, len(times) - 2) if abs(track[i][1]["yaw_rate_radps"]) > 5e-3]
        worst[words] = max((math.dist((parts[i]["vx_mps"], parts[i]["vy_mps"]), slope[i]) for i in turning), default=0)
    print(f"osi: {name}: velocities differ from the slopes of the places by {worst[()]:.4f} m/s, moved from rear axles "
          f"by {worst[('--rear-axle-velocity',)]:.4f} m/s")
    check(worst[("--rear-axle-velocity",)] <= worst[()] / 4, f"{name}: {worst}")


def the_interface_is_part_of_the_standard():
    """Every field of our interface, as it is read and written, has number and type of the full one."""
    if DATA is None:
        return
    full, ours = "", ""
    for name in ("osi_version", "osi_common", "osi_object", "osi_groundtruth", "osi_sensorview", "osi_featuredata",
                 "osi_sensordata"):
        with open(f"{DATA}/osi/proto/{name}.proto", encoding="utf-8") as file:
            full += re.sub(r"//.*", "", file.read())
    for name in ("recorded_osi", "osi_trace"):
        with open(os.path.join(os.path.dirname(__file__), "../../stages/osi", name + ".proto"), encoding="utf-8") as file:
            ours += re.sub(r"//.*", "", file.read())
    fields = re.findall(r"(?:(optional|repeated) (\w+) )?(\w+) = (\d+);", ours)
    check(len(fields) > 80, f"{len(fields)} fields")
    for label, kind, name, number in fields:
        kind = {"int32": "Type", "Base": "Base(Moving|Stationary)"}.get(kind, kind)
        check(re.search(rf"{label} ?{kind} ?{name} = {number};", full), f"{label} {kind} {name} = {number} is none of OSI")


with tempfile.TemporaryDirectory() as place:
    if os.path.exists(os.path.join(BIN, PROGRAM)):
        exactness(place)
        every_message_with_a_ground_truth_is_read(place)
        own_traces_are_read_back(place)
        a_type_that_is_missing_is_said(place)
        shared_options(place)
        a_mirrored_world_is_mirrored(place)
        a_loop_in_lock_step_never_waits()
        memory_is_constant()
        early_ends(place)
        bad_input(place)
        real_traces(place)
        the_interface_is_part_of_the_standard()
    else:
        print(f"skipped  {PROGRAM}: it is not there, as it needs libprotobuf-c and protoc-c")
print(f"osi: {recorded.checks} checks hold")
