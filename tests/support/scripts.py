"""Runs of users' scripts within a test, where their package and the programs are, and the members of what they read."""
import os
import runpy
import subprocess
import sys
import tempfile
import traceback

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPTS = os.path.join(ROOT, "scripts")
sys.path.insert(0, SCRIPTS)
# With the programs of the folder that a test is given, and the shipped documents.
ENVIRONMENT = dict(os.environ, PATH=os.path.abspath(sys.argv[1]) + os.pathsep + os.environ["PATH"], GLINT_DATA=ROOT + "/data")


def shell(command, folder):
    return subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, env=ENVIRONMENT, check=True, capture_output=True, text=True).stdout


def in_a_fork(name, words):
    """Status and message of a script, in a process without a start of its own; what it prints is dropped."""
    with tempfile.TemporaryFile() as told:
        child = os.fork()
        if child == 0:
            try:
                os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
                os.dup2(told.fileno(), 2)
                sys.argv = [name, *words]
                runpy.run_path(os.path.join(SCRIPTS, name), run_name="__main__")
                os._exit(0)
            except SystemExit as end:
                sys.stderr.flush()
                os._exit(end.code)
            except BaseException:
                traceback.print_exc()
                sys.stderr.flush()
            os._exit(70)
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        told.seek(0)
        return status, told.read().decode()


def members(value, path=()):
    """Paths of all members, of a list those of its first item."""
    for key in value if isinstance(value, dict) else range(min(len(value), 1)) if isinstance(value, list) else ():
        yield (*path, key)
        yield from members(value[key], (*path, key))
