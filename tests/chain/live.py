"""No frame waits: a simulator that wants the answer to each frame before it writes the next one gets it.

Usage: python3 tests/chain/live.py BIN_DIR

Through pipes, FIFOs, sockets and terminals, plain and gzip, through processes and fused, the answers are the bytes
of a run over a file. An answer that has not come after a minute counts as never coming. glint.Loop (scripts/glint) is
tried hard: its chains are killed, stopped, fed and made to write garbage, and started again.
"""
import contextlib
import json
import math
import os
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import tty
import zlib

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.dont_write_bytecode = True
sys.path[:0] = [os.path.join(ROOT, "scripts"), os.path.join(ROOT, "pipelines")]
import glint  # noqa: E402
import simulators  # noqa: E402

PATIENCE_S = 300
CHAIN = ("glint-extract | glint-ideal --sensors srr24-pair-every-frame --sections account | glint-sensor | glint-noise")
FRAMES = 60


def run(words, data=b""):
    done = subprocess.run(words, input=data, capture_output=True, check=False, timeout=PATIENCE_S)
    if done.returncode != 0:
        sys.exit(f"live: {' '.join(words)}: exit {done.returncode}: {done.stderr.decode()}")
    return done.stdout


# ---- ways in and out: (what the chain reads, what it writes, where to write, where to read) ------


def through_pipes(_):
    (chain_in, write), (read, chain_out) = os.pipe(), os.pipe()
    return chain_in, chain_out, write, read


def through_pipes_that_never_block(_):
    ends = through_pipes(None)
    for end in ends[:2]:
        os.set_blocking(end, False)
    return ends


def through_fifos(folder):
    ends = []
    for name in ("in", "out"):
        path = os.path.join(folder, name)
        os.mkfifo(path)
        read = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        ends += [read, os.open(path, os.O_WRONLY)]
        os.set_blocking(read, True)
    return ends[0], ends[3], ends[1], ends[2]


def through_a_socket(_):
    chain, ours = socket.socketpair()
    end = chain.detach()
    return end, os.dup(end), ours.fileno(), os.dup(ours.detach())


def through_terminals(_):
    (write, chain_in), (read, chain_out) = os.openpty(), os.openpty()
    for end in (chain_in, chain_out):
        tty.setraw(end)
    return chain_in, chain_out, write, read


class Answers:
    """Lines that come out of a descriptor."""

    def __init__(self, read):
        self.read, self.bytes = read, b""

    def next(self):
        while b"\n" not in self.bytes:
            if not select.select([self.read], [], [], PATIENCE_S)[0]:
                return b"nothing"
            chunk = os.read(self.read, 1 << 16)
            if not chunk:
                return b"the end"
            self.bytes += chunk
        line, _, self.bytes = self.bytes.partition(b"\n")
        return line


def converse(program, text, ends, frames, expected, pack=lambda line: line):
    """Writes each frame after the answer to the one before."""
    chain_in, chain_out, write, read = ends
    process = subprocess.Popen([program, "-c", text], stdin=chain_in, stdout=chain_out, stderr=subprocess.DEVNULL)
    os.close(chain_in)
    os.close(chain_out)
    answers = Answers(read)
    for number, (frame, lines) in enumerate(zip(frames, expected)):
        os.write(write, pack(frame))
        for line in lines:
            answer = answers.next()
            if answer != line:
                process.kill()
                return f"frame {number}: {answer[:80]!r} instead of {line[:80]!r}"
    process.kill()
    process.wait()
    os.close(write)
    os.close(read)
    return None


def packer():
    stream = zlib.compressobj(wbits=16 + zlib.MAX_WBITS)
    return lambda line: stream.compress(line) + stream.flush(zlib.Z_SYNC_FLUSH)


# ---- the checks ----------------------------------------------------------------------------------


def ways(frames, folder):
    targets = [[line] for line in run(["glint", "-c", CHAIN], b"".join(frames)).splitlines()]
    for way in (through_pipes, through_pipes_that_never_block, through_fifos, through_a_socket, through_terminals):
        for program in ("bash", "glint"):
            with tempfile.TemporaryDirectory(dir=folder) as place:
                try:
                    ends = way(place)
                except OSError as error:
                    if way is not through_terminals:
                        raise
                    print(f"skipped  {way.__name__}, {program}: no terminal can be opened: {error}")
                    continue
                yield f"{way.__name__}, {program}", converse(program, CHAIN, ends, frames, targets)
    for program in ("bash", "glint"):
        yield f"gzip, {program}", converse(program, CHAIN, through_pipes(None), frames, targets, packer())


def sinks(frames, folder):
    """Scores, which are lines too; their truth waits as well."""
    cells = CHAIN.rpartition(" | ")[0]
    truth, begun = os.path.join(folder, "truth.jsonl"), os.path.join(folder, "begun.jsonl")
    true_lines = run(["glint", "-c", cells + " | glint-noise-none"], b"".join(frames)).splitlines(keepends=True)
    with open(truth, "wb") as out:
        out.writelines(true_lines)
    text = f"{CHAIN} | glint-score --truth {truth}"
    seen, expected = 0, []
    for count in range(1, len(frames) + 1):
        with open(begun, "wb") as out:
            out.writelines(true_lines[:count])
        lines = run(["glint", "-c", text.replace(truth, begun)], b"".join(frames[:count])).splitlines()
        expected.append(lines[seen:])
        seen = len(lines)
    for program in ("bash", "glint"):
        yield f"glint-score, {program}", converse(program, text, through_pipes(None), frames, expected)


def late_truth(frames, folder):
    """Scores of frames that are there come out while the truth of the next one is awaited."""
    targets = run(["glint", "-c", CHAIN], b"".join(frames))
    path, fifo = os.path.join(folder, "list.jsonl"), os.path.join(folder, "truth")
    with open(path, "wb") as out:
        out.write(targets)
    os.mkfifo(fifo)
    scores = [[line] for line in run(["glint-score", "--truth", path, path]).splitlines()]
    read = os.open(fifo, os.O_RDONLY | os.O_NONBLOCK)
    write = os.open(fifo, os.O_WRONLY)
    out_read, out_write = os.pipe()
    yield "late truth", converse("bash", f"exec glint-score --truth {fifo} {path}", (read, out_write, write, out_read),
                                 targets.splitlines(True), scores)


LINE = {"class": "car", "y_m": 0, "yaw_rad": 0, "vy_mps": 0, "yaw_rate_radps": 0, "length_m": 0, "width_m": 0, "height_m": 0,
        "travelled_m": 0}
OBJECTS = [{"id": "ego", "x_m": 0, "vx_mps": 30, **LINE}, {"id": "leader", "x_m": 60, "vx_mps": 20, **LINE}]
STAGES = "glint-extract | glint-ideal --sensors lrr77 | glint-sensor | glint-noise"
OWN = "glint-extract | glint-ideal --sensors lrr77 | {} | glint-sensor | glint-noise"


def simulator():
    """pipelines/live.py, and how it ends where its chain does."""
    words = [sys.executable, f"{ROOT}/pipelines/live.py"]
    shown = run(words)
    speed_mps, gap_m = (float(shown.split()[at]) for at in (-4, -2))
    yield "pipelines/live.py", None if 20 < speed_mps < 21 and 30 < gap_m < 40 else f"ends with {shown.splitlines()[-1]}"
    with tempfile.TemporaryDirectory() as folder:
        os.makedirs(f"{folder}/sensors")
        with open(f"{folder}/sensors/lrr77.json", "w", encoding="utf-8") as suite:
            suite.write("{}")
        done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, "GLINT_DATA": folder}, timeout=PATIENCE_S, check=False)
        said = done.stderr.splitlines()[-1]
        yield "pipelines/live.py, a bad suite", None if said.startswith(f"glint.frames.ChainError: exit status 78: glint-ideal: {folder}/") else said


def fails(loop, kind, message, within_s=1.0, objects=OBJECTS, steps=50):
    """What is wrong with how a loop fails, that it can be started again, and that it leaves no process behind."""
    begin, groups = time.monotonic(), [process.pid for process in loop.processes]
    try:
        for _ in range(steps):
            begin = time.monotonic()
            loop.step("ego", objects)
        return "does not fail"
    except (glint.ChainError, TimeoutError) as error:
        if not isinstance(error, kind) or message not in str(error):
            return f"{type(error).__name__}: {error}"
    took_s = time.monotonic() - begin
    if took_s > within_s:
        return f"takes {took_s:.2f} s"
    left = [group for group in groups if subprocess.run(["pgrep", "-g", str(group)], stdout=subprocess.DEVNULL, check=False).returncode == 0]
    if left:
        return "leaves processes behind"
    try:
        loop.step("ego", objects)
        return "answers after its end"
    except glint.ChainError as error:
        return None if "restart()" in str(error) else str(error)


def loops(folder):
    """glint.Loop under all that may happen to its chain."""
    with glint.Loop(STAGES) as loop:
        expected = [loop.step("ego", OBJECTS) for _ in range(5)]
        # The radar's cycle is longer than a step, so that some steps have no scan.
        sensors = {target["sensor"] for one in expected for target in one}
        yield "answers are targets", None if sensors == {"front"} else expected
        loop.restart()
        yield "restart", None if [loop.step("ego", OBJECTS) for _ in range(5)] == expected else "other targets"
        pid = loop.processes[0].pid
        try:
            loop.step("ego", [dict(OBJECTS[0], x_m=float("nan")), OBJECTS[1]])
            yield "a number that is none", "is taken"
        except ValueError as error:
            yield "a number that is none", None if loop.processes and loop.processes[0].pid == pid else error
        yield "after it", None if loop.step("ego", OBJECTS)[0]["range_m"] > 0 else "no targets"
        yield "a frame without its ego", fails(loop, glint.ChainError, "exit status 65: glint-extract: ", objects=OBJECTS[1:])
        loop.restart()
        os.kill(loop.processes[0].pid, signal.SIGSTOP)
        loop.timeout_s = 0.3
        yield "a chain that stands still", fails(loop, TimeoutError, "no answer in 0.3 s")
        loop.timeout_s = PATIENCE_S
        loop.restart()
        yield "again", None if [loop.step("ego", OBJECTS) for _ in range(5)] == expected else "other targets"
        os.kill(loop.processes[0].pid, signal.SIGKILL)
        yield "a chain that is killed", fails(loop, glint.ChainError, "exit status -9")
    yield "after the with", None if not loop.processes else "runs on"
    with glint.Loop(STAGES, fused=False) as loop:
        yield "processes", None if [loop.step("ego", OBJECTS) for _ in range(5)] == expected else "other targets"
        os.kill(loop.processes[2].pid, signal.SIGKILL)
        yield "a stage that is killed", fails(loop, glint.ChainError, "exit status -9")
        for i in range(4):
            loop.restart()
            loop.timeout_s = 0.3
            os.kill(loop.processes[i].pid, signal.SIGSTOP)
            yield f"stage {i} stands still", fails(loop, TimeoutError, "no answer in 0.3 s")
    for name, stage, kind, message in (("a stage that fails after some frames", "bash -c 'sed -u 5q; echo mine: no more >&2; exit 65'", glint.ChainError, "mine: no more"),
                                       ("a stage that swallows frames", "grep --line-buffered -v leader", TimeoutError, "no answer in 0.5 s"),
                                       ("a stage that writes frames twice", "sed -u p", glint.ChainError, ""),
                                       ("a stage that hangs at its end", "bash -c 'sed -u 5q; exec >&-; sleep 60'", glint.ChainError, "exit status")):
        with glint.Loop(OWN.format(stage), timeout_s=0.5 if kind is TimeoutError else PATIENCE_S) as loop:
            yield name, fails(loop, kind, message, within_s=6 if "hangs" in name else 1)
    for name, last, message in (("garbage", "sed -u s/targets/targats/", "no targets"), ("noise", "sed -u s/{/x/", "no targets: Expecting value"),
                                ("an old answer", "sed -u 's/\"frame\":[1-9][0-9]*/\"frame\":0/'", "another frame than live, frame 1"),
                                ("an array", "sed -u 's/.*/[]/'", "no targets"), ("half a line", "head -c 99", "exit status"), ("a number", "sed -u 's/.*/5/'", "no targets"),
                                ("nothing", "true", "exit status"), ("a deep line", "sed -u s/.*/" + "[" * 5000 + "/", "no targets")):
        with glint.Loop(f"{STAGES} | {last}", timeout_s=PATIENCE_S) as loop:
            yield name, fails(loop, glint.ChainError, message)
    for text, expected in (("a b|c", [["a", "b"], ["c"]]), ("a 'b|c' d#e | f \"#|'\" g\\|h '|' #i", [["a", "b|c", "d#e"], ["f", "#|'", "g|h", "|", "#i"]])):
        yield f"the words of {text}", None if glint.stages_of(text) == expected else glint.stages_of(text)
    for text in ("", "a | | b", "a |", "a 'b"):
        try:
            yield f"the words of {text!r}", f"are {glint.stages_of(text)}"
        except ValueError:
            pass
    os.mkdir(os.path.join(folder, "sensors"))
    shutil.copy(os.path.join(ROOT, "data/sensors/lrr77.json"), os.path.join(folder, "sensors/a#b.json"))
    shutil.copytree(os.path.join(ROOT, "data/antennas"), os.path.join(folder, "antennas"))
    os.environ["GLINT_DATA"] = folder
    for fused in (True, False):
        with glint.Loop(STAGES.replace("lrr77", "a#b"), fused=fused) as loop:
            sensors = {target["sensor"] for _ in range(3) for target in loop.step("ego", OBJECTS)}
            yield "a suite with # in its name", None if sensors == {"front"} else f"has the sensors {sensors}"
    os.environ["GLINT_DATA"] = os.path.join(ROOT, "data")
    children = f"/proc/self/task/{os.getpid()}/children"
    running = open(children, encoding="ascii").read()
    try:
        glint.Loop("sleep 300 | nowhere")
        yield "a program that is not there", "starts"
    except FileNotFoundError as error:
        left = open(children, encoding="ascii").read()
        yield "a program that is not there", None if error.filename == "nowhere" and left == running else f"{error}: {left} are left"
    before = len(os.listdir("/proc/self/fd"))
    with glint.Loop(f"{STAGES} | sleep 0") as loop:
        for _ in range(20):
            fails(loop, glint.ChainError, "")
            loop.restart()
    yield "20 restarts keep no descriptors", None if len(os.listdir("/proc/self/fd")) <= before + 1 else "some are left"
    yield from large_frames(folder)


class Heard(glint.Loop):
    """A loop that keeps the bytes of its answers."""

    def restart(self):
        self.heard = b""
        super().restart()

    def _exchange(self, text):
        line = super()._exchange(text)
        self.heard += line + b"\n"
        return line


def played(words, expected, status=0):
    """What is wrong with what a recording gives when it is played: bytes, exit status."""
    done = subprocess.run(words, capture_output=True, check=False, timeout=PATIENCE_S)
    good = done.stdout == expected and done.returncode == status
    return None if good else f"{len(done.stdout)} bytes of {len(expected)}, exit {done.returncode}: {done.stderr[-200:]}"


def recordings(folder):
    """A recording gives the bytes of its loop again, from glint and from bash, whole, broken off and after a fault."""
    path, crowd = os.path.join(folder, "loop.sh"), [*OBJECTS, dict(OBJECTS[1], id="it's \u00fc", x_m=30, y_m=3)]
    with Heard(CHAIN, record=path, scene="a 'b' $c") as loop:
        for number in range(40):
            loop.step("ego", [dict(one, x_m=one["x_m"] + number) for one in crowd], conditions={"rain_mmph": number})
        unended = open(path, "rb").read()
        heard = loop.heard
        loop.restart()
        loop.step("ego", OBJECTS)
        again = loop.heard
    yield "a recording names itself", None if unended.startswith(b"# A recording of glint.Loop") else unended[:99]
    for program in ("glint", "bash"):
        yield f"{program} plays a recording", played([program, path], heard)
        yield f"{program} plays what a restart began", played([program, f"{path}.2"], again)
    with open(path, "wb") as file:
        file.write(unended)
    for program in ("glint", "bash"):
        yield f"{program} plays a recording without an end", played([program, path], heard)
    with Heard(STAGES, record=path) as loop:
        loop.step("ego", OBJECTS)
        yield "a fault", fails(loop, glint.ChainError, "exit status 65: glint-extract: ", objects=OBJECTS[1:])
    for program in ("glint", "bash"):
        yield f"{program} plays a fault", played([program, path], loop.heard, 65)
    with Heard(f"{STAGES} | sed -u 's/\"leader/\"first/'", record=path) as loop:
        loop.step("ego", OBJECTS)
    yield "bash plays stages of one's own", played(["bash", path], loop.heard) or (None if b'"first"' in loop.heard else "no first")
    yield "glint does not", played(["glint", path], b"", 64)
    with glint.Loop(CHAIN, record=path) as loop:
        process = loop.processes[0]
        os.dup2(os.open("/dev/full", os.O_WRONLY), loop.recording.fileno())
        try:
            loop.step("ego", OBJECTS)
            yield "a recording on a full disk", "does not fail"
        except OSError as error:
            yield "a recording on a full disk", None if str(error) == f"[Errno 28] {path}: No space left on device" else str(error)
        yield "its chain", None if process.poll() is not None else "it still runs"
    with contextlib.suppress(FileNotFoundError), glint.Loop(CHAIN, record=os.path.join(folder, "none", "loop.sh")):
        pass
    with open(f"/proc/self/task/{threading.get_native_id()}/children", encoding="ascii") as children:
        left = children.read()
    yield "a recording in no folder leaves no chain", f"processes {left}" if left else None


def large_frames(folder):
    """Frames and answers of several pipes' size, and stages that read late: nobody waits for the other."""
    crowd = [OBJECTS[0]] + [dict(OBJECTS[1], id=f"o{i}", x_m=10 + i % 40, y_m=2 * (i // 40) - 40) for i in range(1500)]
    with glint.Loop("glint-extract | glint-ideal --sensors corner77-four --sections all | glint-sensor | glint-noise", timeout_s=PATIENCE_S) as loop:
        frame = dict(loop.head, frame=0, time_s=0, ego="ego", objects=crowd)
        answer = loop.send(frame)
        size = len(json.dumps(answer))
        yield "large frames", None if len(answer["objects"]) == 1501 and size > 1 << 20 else f"{size} bytes"
    with glint.Loop(f"bash -c 'sleep 0.3; cat' | {STAGES} | bash -c 'sleep 0.3; cat'") as loop:
        yield "late readers", None if loop.step("ego", crowd) else "no targets"


class Fake:
    """Members and methods of other programs, by name."""

    def __init__(self, **members):
        self.__dict__.update(members)


def other_simulators():
    """By hand. CARLA: a car at (10, 20) whose yaw of 90 degrees points along its y, which is the right: south for us. Its box is 1 m ahead
    of its place; it drives at 5 m/s and turns to its right by 0.5 rad/s, so that the middle of the box drifts to the west.
    SUMO: a truck of 8 m with its bumper at (100, 50) drives east, by 90 degrees from north, and changes to the left."""
    vector = lambda x, y, z: Fake(x=x, y=y, z=z)  # noqa: E731
    actor = Fake(id=7, type_id="vehicle.some.car", attributes={"base_type": "van"},
                 bounding_box=Fake(location=vector(1, 0, 0.7), extent=vector(2.5, 1, 0.8)),
                 get_transform=lambda: Fake(location=vector(10, 20, 0), rotation=Fake(yaw=90)), get_velocity=lambda: vector(0, 5, 0),
                 get_angular_velocity=lambda: vector(0, 0, math.degrees(0.5)))
    found = simulators.carla_object(actor)
    expected = {"id": "7", "class": "van", "x_m": 10, "y_m": -21, "yaw_rad": -math.pi / 2, "vx_mps": -0.5, "vy_mps": -5,
                "yaw_rate_radps": -0.5, "length_m": 5, "width_m": 2, "height_m": 1.6, "travelled_m": 0}
    yield "CARLA's axes", differences(found, expected)
    actor.attributes, actor.type_id = {}, "walker.pedestrian.0001"
    yield "CARLA's walkers", None if simulators.carla_object(actor)["class"] == "pedestrian" else "another class"
    of_sumo = {"getPosition": (100, 50), "getAngle": 90, "getSpeed": 10, "getLateralSpeed": 1, "getLength": 8, "getWidth": 2.5, "getHeight": 3}
    vehicle = Fake(**{name: lambda _, value=value: value for name, value in of_sumo.items()})
    expected = {"id": "t", "class": "truck", "x_m": 96, "y_m": 50, "yaw_rad": 0, "vx_mps": 10, "vy_mps": 1, "yaw_rate_radps": 0, "length_m": 8,
                "width_m": 2.5, "height_m": 3, "travelled_m": 0}
    yield "SUMO's TraCI", differences(simulators.sumo_object(vehicle, "t", "truck"), expected)
    with glint.Loop(STAGES) as loop:
        yield "objects of both", None if loop.step("7", [found, dict(expected, x_m=40, y_m=-60)]) is not None else "no targets"


def differences(found, expected):
    same = found.keys() == expected.keys() and all(math.isclose(found[key], value, abs_tol=1e-9) if isinstance(value, (int, float)) else found[key] == value
                                                   for key, value in expected.items())
    return None if same else found


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    os.environ["PATH"] = os.path.abspath(sys.argv[1]) + os.pathsep + os.environ["PATH"]
    os.environ["GLINT_DATA"] = ROOT + "/data"
    frames = run(["glint-traffic", "cut-in"]).splitlines(True)[:FRAMES]
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        for checks in (ways(frames, folder), sinks(frames[:8], folder), late_truth(frames, folder), simulator(),
                       loops(folder), recordings(folder), other_simulators()):
            for name, fault in checks:
                print(f"{name}: {fault or 'good'}", flush=True)
                faults += fault is not None
    sys.exit(1 if faults else 0)


main()
