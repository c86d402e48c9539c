"""README's commands in their order, as a new user types them who has only run scripts/demo, and the demo's table of chains.

Usage: python3 tests/chain/first_steps.py DEMO_OUTPUT

Runs in one shell, in a folder that has links to all of the tree: README's indented blocks and the commands of its table
"I want to ...", all as they stand. Needs Python's standard library alone.
Commands that take minutes, or install more than the demo does, must be there; they are not run.
"""
import os
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
RUN_ALREADY = "scripts/demo"
LONG = {"make accuracy", "make check", "scripts/bench --summary", "scripts/figures", "scripts/numerics", "scripts/realism", "scripts/test"}


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


# --- the table of chains --------------------------------------------------------------------------

SHOWN = re.compile(r"(?m)^\| `(\w+)` \| \d+ \| (?:<?(\d+\.\d) %|reference) \|(?: (\d+\.\d) to (\d+\.\d))? \|")
PRINTED = re.compile(r"(?m)^(perfect|paper|auto|smear|signal) +\S*\d +(?:<?(\d+\.\d) %|reference)")


def check_table(printed):
    """The demo prints five rows, each error, or the bound of one that cannot be told from 0, within the interval that README states."""
    due = {row[0]: row[1:] for row in SHOWN.findall(read("README.md"))}
    found = dict(PRINTED.findall(printed))
    assert len(due) == 5 and list(found) == list(due), f"the demo has the rows {list(found)}, README {list(due)}"
    for chain, (error, low, high) in due.items():
        inside = found[chain] == error == "" or float(low) <= float(found[chain]) <= float(high)
        assert inside, f"the demo's {chain} has {found[chain]} %, README {low} to {high} %"


# --- the commands ---------------------------------------------------------------------------------

def commands_of(text):
    """Indented lines whose first word is a program, and the second column of the table "I want to ..."."""
    lines = r"(?m)^    ((?:export|scripts/\w|glint|build/|bash |python3 |make ).*)$|^\| .*? \| `([^`]*)` \| \[.*\|$"
    for shell, row in re.findall(lines, text):
        command = re.sub(r"\s+#.*", "", shell) or as_tested(row.replace("\\|", "|"))
        if command != RUN_ALREADY and not re.match(r"[^|]*\.\.\.", command):
            yield command


def as_tested(row):
    program = row.split()[0]
    if row in LONG:
        return f"make -n {row.split()[1]} >/dev/null" if program == "make" else f"{program} --help >/dev/null"
    return row


def script():
    """All commands, each behind a line that names it."""
    yield "set -eo pipefail\n"
    for command in commands_of(read("README.md")):
        yield f"echo {shlex.quote(command)} >&3\n{command}\n"


def main(demo):
    with open(demo, encoding="utf-8") as file:
        check_table(file.read())
    print("the demo prints README's table of chains within its intervals")
    with tempfile.TemporaryDirectory() as folder, open(os.path.join(folder, "told"), "w+", encoding="utf-8") as told:
        for name in os.listdir(ROOT):
            os.symlink(os.path.join(ROOT, name), os.path.join(folder, name))
        text = "".join(script())
        done = subprocess.run(["bash", "-c", f"exec 3>&{told.fileno()}\n{text}"], cwd=folder, pass_fds=[told.fileno()], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        told.seek(0)
        named = re.split(r"\n(?=\S)", told.read().strip())
    if done.returncode != 0:
        sys.exit(f"README's command fails with {done.returncode}: {named[-1]}\n{done.stdout.decode()[-2000:]}")
    print(f"README's commands run in their order: {text.count('>&3')}")


if len(sys.argv) != 2:
    sys.exit(__doc__)
main(sys.argv[1])
