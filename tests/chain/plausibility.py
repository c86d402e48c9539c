"""Recordings that contradict themselves, in every format of same_motion.py: places, speeds, times and yaws.

Usage: python3 tests/chain/plausibility.py BIN_DIR

A fault changes the poses of all users, or of one; the formats that state what it changes must notice.
"""
import copy
import math
import os
import random
import sys
import tempfile

sys.dont_write_bytecode = True
here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(here, "..", "support"), here]
import recorded  # noqa: E402
import same_motion as motion  # noqa: E402
from recorded import DATA, check, run  # noqa: E402
from same_motion import Pose, User, circle, straight  # noqa: E402

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


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        import subprocess
        def go(what, users, formats=STATED, rate=10, steps=61):
            motion.RATE_HZ, motion.STEPS = rate, steps
            for u in users: u.last = steps - 1
            for kind in formats:
                path = kind.write(folder, users)
                words = [os.path.join(folder, w) if w.endswith(".xml") else w for w in kind.options]
                done = subprocess.run([os.path.join(recorded.BIN, kind.program), path, "--ego", "1", *words], capture_output=True)
                print(what, rate, steps, kind.name, done.returncode, len(done.stdout.splitlines()), done.stderr.decode()[-300:].strip().split(":", 2)[-1])
        for rate, steps in ((10, 61), (10, 11), (1, 31), (25,31), (1, 6)):
            go("plain", traffic(), motion.FORMATS, rate, steps)
            go("kmh", changed(traffic(), scaled(vx=3.6, vy=3.6)), STATED, rate, steps)
            go("mph", changed(traffic(), scaled(vx=2.237, vy=2.237)), STATED, rate, steps)
            go("knots", changed(traffic(), scaled(vx=1.944, vy=1.944)), STATED, rate, steps)
            go("zero", changed(traffic(), scaled(vx=0, vy=0)), STATED, rate, steps)
            go("feet", changed(traffic(), scaled(x=3.28, y=3.28)), STATED, rate, steps)
            go("degplaces", changed(traffic(), scaled(x=1/111320, y=1/111320)), STATED, rate, steps)
            go("yawdeg", changed(traffic(), scaled(yaw=180/math.pi)), YAWS, rate, steps)
            go("yawrad", changed(traffic(), scaled(yaw=math.pi/180)), YAWS, rate, steps)
            def tele(p, t):
                if t >= 2 and t < 4: p.x += 0; p.y += 14.6
            go("tele all", changed(traffic(), tele, "2"), STATED, rate, steps)
            go("park", changed(traffic(), tele, "4"), STATED, rate, steps)
