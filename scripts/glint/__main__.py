"""Run a program of glint: its name without `glint-`, or `glint` itself, and then the program's own words.

    python3 -m glint demo
    python3 -m glint traffic cut-in -o frames.jsonl
    python3 -m glint dataset --help

pip installs the same under the programs' own names: glint, glint-traffic, glint-dataset ...
"""
import os
import re
import runpy
import signal
import sys
import sysconfig

from glint import command_line
from glint.places import GLINT, SCRIPTS


def run(name, words):
    """Ends with the exit code of the program glint-NAME, or of glint."""
    script = os.path.join(SCRIPTS, name)
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # which Python ignores, and what it starts would, too
    os.environ["PATH"] = os.pathsep.join((sysconfig.get_path("scripts"), os.path.dirname(GLINT), os.environ.get("PATH", os.defpath)))
    if name == "demo":
        os.execvp("bash", ["bash", script, *words])
    if os.path.isfile(script):
        sys.argv = ["glint-" + name, *words]
        runpy.run_path(script, run_name="__main__")
        sys.exit()
    os.execv(GLINT, ["glint" if name == "glint" else "glint-" + name, *words])


def called():
    """The program that this file is called as."""
    run(os.path.basename(sys.argv[0]).removeprefix("glint-"), sys.argv[1:])


if __name__ == "__main__":
    sys.argv[0] = "python3 -m glint"
    command_line.check(__doc__, len(sys.argv) > 1 and re.fullmatch(r"[a-z][a-z0-9-]*", sys.argv[1]))
    run(sys.argv[1].removeprefix("glint-"), sys.argv[2:])
