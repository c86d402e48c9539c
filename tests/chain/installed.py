#!/usr/bin/env python3
"""What `make install` leaves in a folder: programs as small as they may be, and what own stages are built from.

    tests/chain/installed.py PREFIX BIN_DIR

PREFIX may lie elsewhere than where it was installed. BIN_DIR has the programs that were installed. The
stage is the one that the installed page shows, built with the Makefile that the page shows.
"""
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile

PREFIX, BUILT = (os.path.abspath(folder) for folder in sys.argv[1:3])
DOCUMENTS = os.path.join(PREFIX, "share/doc/glint")  # has the layout of the source tree
PROGRAMS = os.path.join(PREFIX, "bin")
MOST_BYTES = 4_000_000
ENVIRONMENT = {"PATH": f"{PROGRAMS}:/usr/local/bin:/usr/bin:/bin", "LC_ALL": "C",
               "PKG_CONFIG_PATH": os.path.join(PREFIX, "lib/pkgconfig")}
REACH_M = 40
EXAMPLES = {"summary.c", "noise_mine.c"}  # of stages; only noise_none.c is installed
OWN_STAGES = {"glint-spray", "glint-noise-mine", "glint-traffic-adversarial"}  # of readers and of the tests


def run(command, folder="/", expected=0):
    done = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, env=ENVIRONMENT,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert done.returncode == expected, f"{command}: {done.returncode}, not {expected}\n{done.stderr}"
    return done.stdout + done.stderr


def frames(command, folder="/"):
    return [json.loads(line) for line in run(command, folder).splitlines()]


def check_programs():
    """Every program that was built is installed, says the same, and all of them share their bytes."""
    names = sorted(os.listdir(BUILT))
    assert sorted(os.listdir(PROGRAMS)) == names, "other programs are installed than were built"
    of_one_file = {}
    for name in names:
        path = os.path.join(PROGRAMS, name)
        of_one_file[os.stat(path).st_ino] = os.path.getsize(path)
        for option in "--help", "--version":
            assert run(f"{path} {option}") == run(f"{BUILT}/{name} {option}"), f"{name} {option} differs"
    assert sum(of_one_file.values()) <= MOST_BYTES, f"the programs have {sum(of_one_file.values())} bytes"
    assert not run(f"nm {PROGRAMS}/glint 2>/dev/null"), "glint is not stripped"


def check_headers(folder):
    """Each header compiles by itself, as plain C11 and with no other package's headers."""
    run("""cd $(pkg-config --variable=includedir glint)
        for header in */*.h; do
            echo "#include \\"$header\\"" >"$OLDPWD/header.c"
            cc -std=c11 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I. "$OLDPWD/header.c" || exit 1
        done""", folder)


def build_stage(folder):
    """The page's stage, without a warning, beside glint's own programs."""
    with open(os.path.join(DOCUMENTS, "stages/README.md"), encoding="utf-8") as page:
        blocks = dict(re.findall(r"```(c|make)\n(.*?)```", page.read(), re.DOTALL))
    for name, text in ("spray.c", blocks["c"]), ("Makefile", blocks["make"]):
        shutil.copy(os.path.join(DOCUMENTS, "stages", name), folder)
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            assert file.read() == text, f"{name} is another one than the page's"
    assert len(blocks["make"].splitlines()) <= 12, "the page promises a Makefile of twelve lines"
    run('make -s install CFLAGS="-std=c11 -O2 -Wall -Wextra -Werror"', folder)


def check_stage(folder):
    """Each echo is kept or accounted for, by the law that the page states, and by its address alone."""
    source = "glint-traffic-random --frames 400 --seed 5 | glint-extract | glint-ideal --sensors corner77 --sections account"
    run(f"{source} >ideal.jsonl && glint-spray --reach-m {REACH_M} ideal.jsonl >spray.jsonl", folder)
    before, after = frames("cat ideal.jsonl", folder), frames("cat spray.jsonl", folder)
    expected = variance = kept = lost = 0
    for ideal, sprayed in zip(before, after, strict=True):
        chances = [math.exp(-echo["range_m"] / REACH_M) for echo in ideal["echoes"]]
        expected += sum(chances)
        variance += sum(chance * (1 - chance) for chance in chances)
        kept += len(sprayed["echoes"])
        lost += sum(len(group["echoes"]) for group in sprayed["lost"] if group["stage"] == "spray")
    assert kept + lost == sum(len(frame["echoes"]) for frame in before), "echoes vanished without account"
    assert lost > 1000 and abs(kept - expected) < 4 * math.sqrt(variance), f"kept {kept}, expected {expected:.0f}"
    tail = frames(f"tail -n 7 ideal.jsonl | glint-spray --reach-m {REACH_M}", folder)
    assert tail == after[-7:], "what is lost depends on the frames before"
    summary = run("glint-sensor spray.jsonl | glint-noise | glint-summary", folder)
    assert re.search(r"%  blocked", summary), summary
    refusal = run("glint-spray --reach-m 0.5", folder, expected=64)
    assert refusal.startswith("glint-spray: --reach-m: "), refusal


def pages():
    """(folder, text, is it a history?) of every installed page. CHANGES.md names what is gone."""
    for top in DOCUMENTS, os.path.join(PREFIX, "share/glint"):
        for folder, _, names in os.walk(top):
            for name in names:
                if name.endswith(".md"):
                    with open(os.path.join(folder, name), encoding="utf-8") as page:
                        yield folder, page.read(), name == "CHANGES.md"


def check_names():
    """Links lead somewhere. Programs, scripts, pipelines, documents, schemas and headers that pages name are there, and scripts have a help."""
    scripts = set()
    for folder, text, is_history in pages():
        for target in re.findall(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)", text):
            assert os.path.exists(os.path.join(folder, target)), f"{folder}: a link leads to {target}, which is not installed"
        for name in re.findall(r"(?<![\w./-])scripts/[\w-]+(?![\w./-])", text):
            gone = is_history and not os.path.exists(os.path.join(os.path.dirname(__file__), "..", "..", name))
            assert gone or os.path.exists(os.path.join(DOCUMENTS, name)), f"{folder}: {name} is not installed"
        for target, after in re.findall(r"`make ([a-z]+)[^`]*`(.{0,20})", text, re.DOTALL):
            assert target in ("install", "uninstall", "part") or after.startswith(" of the source tree"), f"{folder}: make {target}: no Makefile is installed"
        if is_history:
            continue
        for name in re.findall(r"\bglint(?:-[a-z0-9]+)*(?= -|\b[^-a-z0-9/._*])", text):
            known = os.path.exists(os.path.join(PROGRAMS, name)) or name in OWN_STAGES
            assert known, f"{folder}: {name} is not installed"
        for name in re.findall(r"(?<![\w./$-])(?:scripts|pipelines|data|schemas|stages|tests)/[\w./-]*\w", text):
            is_script = name.startswith("scripts/") or name.endswith(".py")
            there = os.path.exists(os.path.join(DOCUMENTS, name)) or os.path.basename(name) in EXAMPLES
            assert there or not is_script and name.startswith("tests/"), f"{folder}: {name} is not installed"
        for name in re.findall(r"(?<![\w./-])lib/([a-z]+/\w+\.h)", text):
            assert os.path.exists(os.path.join(PREFIX, "include/glint", name)), f"{folder}: {name} is not installed"
        scripts.update(re.findall(r"(?<![\w./-])scripts/([\w-]+)(?![\w./-])", text))
    assert {"dataset", "check-set", "tracker"} <= scripts, scripts
    for name in sorted(scripts):
        assert run(f"{DOCUMENTS}/scripts/{name} --help"), f"{name} --help prints nothing"


def check_scripts(folder):
    """A set is made, checked and exported, also by scripts through a link; tracks are scored, and glint.py reads frames."""
    run(f"{DOCUMENTS}/scripts/dataset {DOCUMENTS}/data/sets/small.json --out set && make -s -C set && {DOCUMENTS}/scripts/check-set set", folder)
    run(f"cat set/*/*/*.jsonl.gz > list.jsonl.gz && {DOCUMENTS}/scripts/tracker list.jsonl.gz > tracks.jsonl", folder)
    score = json.loads(run("glint-score-tracks --tracks tracks.jsonl --summary list.jsonl.gz", folder))
    assert score["frames"] == 1000, score
    code = "import glint; print(sum(len(one['targets']) for one in glint.frames('list.jsonl.gz')))"
    assert int(run(f'PYTHONPATH={DOCUMENTS}/scripts python3 -B -c "{code}"', folder)) > 0
    assert run("build/bin/glint pipelines/two-vehicles.sh", DOCUMENTS).startswith("{")
    linked = os.path.join(PREFIX, "share/glint/scripts")
    run(f"{linked}/make-radar {DOCUMENTS}/data/sheets/ars408-21.json -o radar.json && glint-traffic two-vehicles | glint-extract | "
        "glint-ideal --sensors ./radar.json --sections quality | glint-sensor | glint-noise >seen.jsonl", folder)
    run(f"{linked}/export kitti --out kitti seen.jsonl", folder)


check_programs()
check_names()
with tempfile.TemporaryDirectory() as place:
    check_headers(place)
    check_scripts(place)
    build_stage(place)
    check_stage(place)
os.remove(os.path.join(PROGRAMS, "glint-spray"))
print("installed: one body for all programs, all that pages name, and a stage of one's own")
