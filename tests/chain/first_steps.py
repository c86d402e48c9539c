"""README's commands in their order, as a new user types them who has only run scripts/demo, and the demo's table of chains.

Usage: python3 tests/chain/first_steps.py DEMO_OUTPUT

Runs in one shell, in a folder that has links to all of the tree: README's indented blocks, its Python, and the commands of
its table "I want to ...", with the files that their words name, from the pages that the rows name. Needs Python's
standard library alone.
Commands that take minutes, or install more than the demo does, must be there; they are not run.
"""
import gzip
import os
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
RUN_ALREADY = "scripts/demo"
LONG = {"make accuracy", "make check", "scripts/bench --summary", "scripts/figures", "scripts/realism", "scripts/test"}
# What stands before and behind the commands that are stages of a chain, or need more words.
BEFORE = {"glint-extract": "glint-traffic cut-in | ", "glint-ideal": "glint-traffic cut-in | glint-extract | ",
          "glint-plan": "glint-traffic cut-in | ", "glint-cost": "glint-traffic cut-in | ",
          "glint-sensor-signal": "glint-traffic cut-in | sed -n 1,2p | glint-extract | glint-ideal --sensors srr24-signal | ",
          "glint-score-tracks": "scripts/tracker list.jsonl | "}
BEHIND = {"glint-ideal": " --sensors srr24-pair", "glint-cost": " --sample 12",
          "scripts/export": " --out exported quality.jsonl"}
QUALITY = "glint-traffic two-vehicles | glint-extract | glint-ideal --sensors srr24-pair --sections quality | glint-sensor | " \
          "glint-noise > quality.jsonl"
TRACKS = "track_id,frame_id,timestamp_ms,agent_type,x,y,vx,vy,psi_rad,length,width\n"


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


# --- the table of chains --------------------------------------------------------------------------

ROW = re.compile(r"(?m)^ *(perfect|paper|auto|smear|signal) +[\d.]+ +(?:(\d+\.\d) %|reference)(?: +(\d+\.\d) to +(\d+\.\d))?")


def check_table(printed):
    """The demo prints five rows, each error within the interval that README states."""
    due = {row[0]: row[1:] for row in ROW.findall(read("README.md"))}
    found = {row[0]: row[1:] for row in ROW.findall(printed)}
    assert len(due) == 5 and list(found) == list(due), f"the demo has the rows {list(found)}, README {list(due)}"
    for chain, (error, low, high) in due.items():
        inside = found[chain][0] == error == "" or float(low) <= float(found[chain][0]) <= float(high)
        assert inside, f"the demo's {chain} has {found[chain][0]} %, README {low} to {high} %"


# --- the commands ---------------------------------------------------------------------------------

def commands_of(text):
    """Indented blocks whose first word is a program, README's Python, and the third column of its table."""
    lines = r"(?m)^    ((?:export|scripts/\w|glint|build/|bash |python3 |make ).*)$|^```python\n((?:.*\n)+?)```$|^\| .*? \| (?:`(.*?)`)? \| .*\|$"
    for shell, python, row in re.findall(lines, text):
        command = re.sub(r"\s+#.*", "", shell) or (f"python3 - <<'END'\n{python}END" if python else in_chain(row))
        if command and command != RUN_ALREADY and not re.match(r"[^|]*\.\.\.", command):
            yield command


def in_chain(row):
    if row in LONG:
        program = row.split()[0]
        return f"make -n {row.split()[1]} >/dev/null" if program == "make" else f"{program} --help >/dev/null"
    words = row.split()
    return BEFORE.get(words[0], "") + row + BEHIND.get(words[0], "") if words else ""


def bring(folder):
    """The files that a user of the table brings, as the pages have them."""
    scenario = re.search(r'(?m)^    \{"origin"(?:.*\n)+?(?=\n)', read("data/trajectories/README.md"))[0]
    sheet = re.search(r"```json\n(.*?)```", read("data/sensors/MY_RADAR.md"), re.DOTALL)[1]
    for name, content in (("my-scene.json", scenario), ("sheet.json", sheet), ("plan.json", read("data/sets/small.json"))):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(content)
    with gzip.open(os.path.join(folder, "tracks.csv.gz"), "wt") as file:
        file.write(TRACKS)
        for step in range(20):
            file.writelines(f"{car},{step},{100 * step},car,{1.5 * step + 20 * (car - 7)},0,15,0,0,4.5,1.8\n" for car in (7, 8))
    os.mkdir(os.path.join(folder, "mine"))
    for name in os.listdir(ROOT):
        os.symlink(os.path.join(ROOT, name), os.path.join(folder, name))


def script():
    """All commands, each behind a line that names it."""
    text, first_row = read("README.md"), True
    yield "set -eo pipefail\n"
    for command in commands_of(text):
        if first_row and f"`{command}`" in text:
            first_row = False
            yield f"cp data/vehicles/car.json mine; cp list.jsonl old.jsonl; cp list.jsonl new.jsonl; {QUALITY}\n"
        yield f"echo {shlex.quote(command)} >&3\n{command}\n"


def main(demo):
    with open(demo, encoding="utf-8") as file:
        check_table(file.read())
    print("the demo prints README's table of chains within its intervals")
    with tempfile.TemporaryDirectory() as folder, open(os.path.join(folder, "told"), "w+", encoding="utf-8") as told:
        bring(folder)
        text = "".join(script())
        done = subprocess.run(["bash", "-c", f"exec 3>&{told.fileno()}\n{text}"], cwd=folder, pass_fds=[told.fileno()], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        told.seek(0)
        named = re.split(r"\n(?=\S)", told.read().strip())
    due = re.search(r"```python\n.*?```\n\n.*?\n\n    (.*?)\n", read("README.md"), re.DOTALL)[1]
    if done.returncode != 0:
        sys.exit(f"README's command fails with {done.returncode}: {named[-1]}\n{done.stdout.decode()[-2000:]}")
    if f"\n{due}\n" not in f"\n{done.stdout.decode()}":
        sys.exit(f"README's Python does not print: {due}")
    print(f"README's commands run in their order: {text.count('>&3')}")


if len(sys.argv) != 2:
    sys.exit(__doc__)
main(sys.argv[1])
