"""What the tests of sources of recorded traffic share: runs of programs, and comparisons of frames."""
import json
import math
import os
import subprocess
import sys

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
    check(done.returncode == fails, f"{program} {words}: exit {done.returncode}, not {fails}: {done.stderr.decode()}")
    return done.stderr.decode(), done.stdout.count(b"\n")


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
    path = os.path.join(folder, name)
    for old, new, message in cases:
        check(old in text, f"{old} is in the data")
        with open(path, "w" if isinstance(text, str) else "wb") as file:
            file.write(text.replace(old, new, 1))
        said, _ = run(program, path, "--ego", ego, fails=65)
        check(f"{program}: {path}: " in said and message in said, f"{old} -> {new}: {said}")
