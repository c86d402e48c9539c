"""Submits a data set to Slurm: job arrays of `make part-N`, and a check that depends on them."""
import os
import re
import shlex
import subprocess
import sys

from glint import command_line
from glint.sets.durable import make_folder, write_whole
from glint.sets.layout import WORK
from glint.sets.plan import UNAVAILABLE, Fault, refuse, text_of


def ask(words):
    """What a command of Slurm prints."""
    try:
        done = subprocess.run(words, stdout=subprocess.PIPE, text=True, check=False)
    except FileNotFoundError as error:
        raise Fault(UNAVAILABLE, f"{words[0]}: no such program; Debian's package is slurm-client") from error
    if done.returncode != 0:
        raise Fault(UNAVAILABLE, f"exit status {done.returncode}: {shlex.join(words)}")
    return done.stdout


def most_tasks():
    """How many tasks an array may have: their numbers lie below MaxArraySize."""
    found = re.search(r"MaxArraySize\s*=\s*(\d+)", ask(["scontrol", "show", "config"]))
    return int(found[1]) if found else 1001


def ranges(numbers):
    """Ascending numbers as Slurm writes them: 0-3,7."""
    runs = []
    for number in numbers:
        if runs and runs[-1][1] == number - 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    return ",".join(str(first) if first == last else f"{first}-{last}" for first, last in runs)


def arrays(parts, most):
    """(first part, task numbers from it) of each array: no task number reaches `most`."""
    groups = {}
    for part in parts:
        groups.setdefault(part // most * most, []).append(part % most)
    return list(groups.items())


def place_of(folder):
    """Where scripts and outputs of jobs lie. Slurm reads % and \\ in the path of an output."""
    place = os.path.join(os.path.abspath(folder), WORK, "slurm")
    refuse(re.search(r"[%\\]", place), place, "Slurm takes no path with % or \\")
    return place


def array_words(folder, first, tasks):
    """The command that submits an array."""
    place = place_of(folder)
    return ["sbatch", "--parsable", f"--array={ranges(tasks)}", f"--export=ALL,GLINT_FIRST_PART={first}",
            f"--output={place}/%A_%a.out", f"{place}/part.sh"]


def repeat(parts, folder):
    """The commands that submit parts again."""
    return [shlex.join(array_words(folder, first, tasks)) for first, tasks in arrays(parts, most_tasks())]


def number_of_job(printed):
    """The id that sbatch prints. None is refused, as a dependency on no job would hold at once."""
    found = re.match(r"(\d+)(;|$)", printed.strip())
    if not found:
        raise Fault(UNAVAILABLE, f"sbatch printed {printed.strip()!r} instead of the id of a job")
    return found[1]


def write_script(path, work, name, **words):
    """Writes a script of the shell: the text `name` of data/sets/ with these words in their places."""
    write_whole(path, work, "#!/bin/sh\n" + text_of(name).format(**words))


def submit(parts, folder, plan_folder):
    """Submits what is missing, as few arrays as may be, and the check that depends on all of them."""
    place, work = place_of(folder), os.path.join(os.path.abspath(folder), WORK)
    make_folder(place)
    quoted = shlex.quote(os.path.abspath(folder))
    write_script(f"{place}/part.sh", work, "slurm-batch.txt", folder=quoted)
    program, plan_folder = (shlex.quote(os.path.abspath(path)) for path in (sys.argv[0], plan_folder))
    write_script(f"{place}/check.sh", work, "slurm-check.txt", folder=quoted, program=program, plan_folder=plan_folder)
    ids = [number_of_job(ask(array_words(folder, first, tasks))) for first, tasks in arrays(parts, most_tasks())]
    check = number_of_job(ask(["sbatch", "--parsable", f"--dependency=afterany:{':'.join(ids)}",
                               f"--output={place}/check.out", f"{place}/check.sh"]))
    print(f"{command_line.name()}: {len(parts)} shards in arrays {' '.join(ids)}; job {check} checks them: {place}/check.out")
