"""What the tests of sources of recorded traffic share: runs of programs, and comparisons of frames."""
import json
import math
import os
import select
import subprocess
import sys

from scripts import ENVIRONMENT as ENV, ROOT  # noqa: F401: for the tests

BIN = os.path.abspath(sys.argv[1])
DATA = os.environ.get("GLINT_TEST_DATA")
NAME = os.path.basename(sys.argv[0]).removesuffix(".py")
PATIENCE_S = 300
checks = 0


def check(good, what):
    global checks
    checks += 1
    if not good:
        sys.exit(f"{NAME}: {what}")


def run(program, *words, data=None, fails=None):
    """The frames; with fails, an exit status, the message and the number of frames before it."""
    done = subprocess.run([os.path.join(BIN, program), *words], input=data, capture_output=True, check=False,
                          timeout=PATIENCE_S)
    if fails is None:
        check(done.returncode == 0, f"{program} {words}: {done.stderr.decode()}")
        return [json.loads(line) for line in done.stdout.splitlines()]
    check(done.returncode == fails, f"{program} {words}: exit {done.returncode}, not {fails}: {done.stderr!r}")
    return done.stderr.decode(errors="replace"), done.stdout.count(b"\n")


def save(folder, name, content):
    """Writes a file of text or bytes; returns its path."""
    path = os.path.join(folder, name)
    with open(path, "wb") as file:
        file.write(content.encode() if isinstance(content, str) else content)
    return path


def in_lock_step(program, words, messages, begin=b"", end=b""):
    """The frames of a stream, each of which must be there before the next message is written."""
    frames = []
    with subprocess.Popen([os.path.join(BIN, program), *words], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as loop:
        into, out = loop.stdin.fileno(), loop.stdout.fileno()
        os.write(into, begin)
        for number, one in enumerate(messages):
            os.write(into, one)
            check(bool(select.select([out], [], [], PATIENCE_S)[0]), f"no frame of message {number} before the next")
            frames.append(json.loads(os.read(out, 1 << 16)))
        os.write(into, end)
        loop.stdin.close()
        check(loop.wait(PATIENCE_S) == 0, "the loop ends well")
    return frames


def egos_as_if_alone(program, path, *words):
    """The frames of all egos by their ids, each of which has the same frames alone."""
    together = {}
    for frame in run(program, path, "--ego", "all", *words):
        together.setdefault(frame["ego"], []).append(frame)
    for ego, frames in together.items():
        check(frames == run(program, path, "--ego", ego, *words), f"{ego} alone, {words}")
        check([frame.get("last", False) for frame in frames] == [False] * (len(frames) - 1) + [True], "last frames")
    return together


def check_mirrored(plain, mirrored):
    """The bodies of frames against those of the mirrored world."""
    for one, other in zip(plain, mirrored, strict=True):
        for a, b in zip(one["objects"], other["objects"], strict=True):
            check((a["id"], a["class"]) == (b["id"], b["class"]), f"mirrored: {a['id']} and {b['id']}")
            for key in ("x_m", "vx_mps", "length_m", "width_m", "travelled_m"):
                check(abs(a[key] - b[key]) < 1e-9, f"mirrored {key} of {a['id']}")
            for key in ("y_m", "vy_mps", "yaw_rate_radps"):
                check(abs(a[key] + b[key]) < 1e-9, f"mirrored {key} of {a['id']}")
            check(turn_between(a["yaw_rad"], -b["yaw_rad"]) < 1e-9, f"mirrored yaw of {a['id']}")


def turn_between(a, b):
    return abs(math.remainder(a - b, 2 * math.pi))


def slopes(times, values, turn=lambda difference: difference):
    """At every time the slope of the parabola through three values, at the ends the difference of two; 0 for one."""
    out = []
    for i, _ in enumerate(times):
        back = turn(values[i] - values[i - 1]) / (times[i] - times[i - 1]) if i > 0 else None
        ahead = turn(values[i + 1] - values[i]) / (times[i + 1] - times[i]) if i + 1 < len(times) else None
        if back is None or ahead is None:
            out.append(back if back is not None else ahead if ahead is not None else 0)
        else:
            left, right = times[i] - times[i - 1], times[i + 1] - times[i]
            out.append((back * right + ahead * left) / (left + right))
    return out


def add_slopes(track):
    """Gives the states of a track, a list of (time, state), the velocities and yaw rates that they lack: their slopes."""
    times = [time for time, _ in track]
    for place, key in (("x_m", "vx_mps"), ("y_m", "vy_mps"), ("yaw_rad", "yaw_rate_radps")):
        turn = (lambda angle: math.remainder(angle, 2 * math.pi)) if place == "yaw_rad" else lambda way: way
        for (_, one), slope in zip(track, slopes(times, [one[place] for _, one in track], turn), strict=True):
            if one.get(key) is None:
                one[key] = slope


def compare(frames, expected, ego, close=1e-8):
    """Frames of an ego against {time: {id: state}}; a state has the members of an object, or some of them."""
    times = sorted(time for time, users in expected.items() if ego in users)
    check([frame["time_s"] for frame in frames] == times, f"times of {ego}")
    for frame in frames:
        users = expected[frame["time_s"]]
        origin = {"x_m": frame.get("origin_x_m", 0), "y_m": frame.get("origin_y_m", 0)}
        check([part["id"] for part in frame["objects"]] == sorted(users), f"who is there at {frame['time_s']} s")
        for part in frame["objects"]:
            for key, value in users[part["id"]].items():
                got = part[key] + origin.get(key, 0) if key != "class" else part[key]
                good = (got == value if key == "class" else turn_between(got, value) < close if key == "yaw_rad"
                        else abs(got - value) < (3e-7 if key == "yaw_rate_radps" else close))
                check(good, f"{part['id']} at {frame['time_s']} s: {key} is {got}, expected {value}")


def refuses(program, folder, name, text, cases, ego):
    """Cases (old, new, message): the text with old replaced by new is refused with its file and the message."""
    for old, new, message in cases:
        check(old in text, f"{old} is in the data")
        path = save(folder, name, text.replace(old, new, 1))
        said, _ = run(program, path, "--ego", ego, fails=65)
        check(f"{program}: {path}: " in said and message in said, f"{old} -> {new}: {said}")
