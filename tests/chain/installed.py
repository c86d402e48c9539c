#!/usr/bin/env python3
"""What `make install` leaves in a folder: programs as small as they may be, and what own stages are built from.

    tests/chain/installed.py PREFIX BIN_DIR

PREFIX may lie elsewhere than where it was installed. BIN_DIR has the programs that were installed. One
stage is the one that the installed page shows, built with the Makefile that the page shows. The others are glint's
plug-ins, which give the bytes of the programs in BIN_DIR.
"""
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
import glint  # noqa: E402

PREFIX, BUILT = (os.path.abspath(folder) for folder in sys.argv[1:3])
DOCUMENTS = os.path.join(PREFIX, "share/doc/glint")  # has the layout of the source tree
PROGRAMS = os.path.join(PREFIX, "bin")
SCRIPTS = ["glint-" + name for name in ("demo", "dataset", "check-set", "export", "import", "make-radar", "realism", "tracker")]
MOST_BYTES = 4_000_000
STRICT = "-std=c11 -D_XOPEN_SOURCE=700 -O2 -Wall -Wextra -Werror"
ENVIRONMENT = {"PATH": f"{PROGRAMS}:/usr/local/bin:/usr/bin:/bin", "LC_ALL": "C",
               "PKG_CONFIG_PATH": os.path.join(PREFIX, "lib/pkgconfig")}
REACH_M = 40
EXAMPLES = {"summary.c", "noise_mine.c"}  # of stages; only noise_none.c is installed
OWN_STAGES = {"glint-spray", "glint-bins", "glint-noise-mine", "glint-traffic-adversarial"}  # of readers and of the tests


def run(command, folder="/", expected=0):
    done = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, env=ENVIRONMENT,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert done.returncode == expected, f"{command}: {done.returncode}, not {expected}\n{done.stderr}"
    return done.stdout + done.stderr


def frames(command, folder="/"):
    return [glint.name_lost(json.loads(line)) for line in run(command, folder).splitlines()]


def check_programs():
    """Every program that was built is installed, says the same, and all of them share their bytes."""
    names = sorted(os.listdir(BUILT))
    assert sorted(os.listdir(PROGRAMS)) == sorted([*names, *SCRIPTS]), "other programs are installed than were built"
    of_one_file = {}
    for name in names:
        path = os.path.join(PROGRAMS, name)
        of_one_file[os.stat(path).st_ino] = os.path.getsize(path)
        for option in "--help", "--version":
            assert run(f"{path} {option}") == run(f"{BUILT}/{name} {option}"), f"{name} {option} differs"
    assert sum(of_one_file.values()) <= MOST_BYTES, f"the programs have {sum(of_one_file.values())} bytes"
    assert not run(f"nm {PROGRAMS}/glint 2>/dev/null"), "glint is not stripped"
    assert run("pkg-config --modversion glint") == run("glint --version").split()[-1] + "\n"


def check_completions(folder):
    """bash completes options by --help, and names of documents, effects and sections by `glint --list`, as a shell reads them."""
    os.makedirs(os.path.join(folder, "own/sensors"))
    for name in "it's", "my radar", "a radar of a name that is as long as this":
        shutil.copy(os.path.join(PREFIX, "share/glint/data/sensors/lrr77.json"), os.path.join(folder, f"own/sensors/{name}.json"))
    for words, expected in {"glint-ideal --sen": "--sensors=", "glint-ideal --sensors = lrr77-f": "lrr77-full",
                            "glint-ideal --effects = all,-gho": "all,-ghosts", "glint-noise --sections = none,qua": "none,quality",
                            "glint-extract --vehicles det": "detailed", "glint-traffic cut": "cut-in", "glint two": "two-vehicles",
                            "glint --list sce": "scenarios", "glint-traffic --eg": "--ego=", "glint-ideal --sensors it": "it\\'s", "glint-ideal --sensors my": "my\\ radar",
                            "glint-ideal --sensors a\\ r": "a\\ radar\\ of\\ a\\ name\\ that\\ is\\ as\\ long\\ as\\ this"}.items():
        name = words.split()[0]
        told = run(f"""compopt() {{ :; }}; export GLINT_DATA=own; . {PREFIX}/share/bash-completion/completions/{name}
            COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))
            _glint {name} "${{COMP_WORDS[-1]}}" "${{COMP_WORDS[-2]}}"; echo "${{COMPREPLY[@]}}" """, folder)
        assert told == expected + "\n", f"{words} is completed as {told}"


def check_examples(folder):
    """Every man page has examples, and their commands run, but for those on files that a user brings."""
    pages = os.path.join(PREFIX, "share/man/man1")
    for name in os.listdir(pages):
        with open(os.path.join(pages, name), encoding="utf-8") as page:
            assert ".SH EXAMPLES\n.PP" in page.read(), f"{name} has no example"
    with open(os.path.join(os.path.dirname(BUILT), "../stages/examples.txt"), encoding="utf-8") as file:
        for command in re.findall(r"^    (\S.*)$", file.read(), re.MULTILINE):
            if not re.search(r"fcd\.xml|trace\.osi|scenario\.xml|small\.json|check-set|sheet\.json|demo|realism", command):
                run(command, folder)


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
        with open(os.path.join(DOCUMENTS, "stages/spray", name), encoding="utf-8") as file:
            assert file.read() == text, f"{name} is another one than the page's"
    shutil.copytree(os.path.join(DOCUMENTS, "stages/spray"), os.path.join(folder, "spray"))
    run(f'make -s -C spray install CFLAGS="{STRICT}"', folder)


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


FLOATING = """<fcd-export>
<timestep time="0"><vehicle id="a" x="10" y="5" angle="90" type="car" speed="10"/><vehicle id="b" x="40" y="2" angle="90" speed="9"/></timestep>
<timestep time="0.1"><vehicle id="a" x="11" y="5" angle="90" type="car" speed="10"/><vehicle id="b" x="40.9" y="2" angle="90" speed="9"/></timestep>
</fcd-export>
"""
STATE = """<{0}><position><point><x>{1}</x><y>{2}</y></point></position><orientation><exact>0.2</exact></orientation>
<time><exact>{3}</exact></time><velocity><exact>10</exact></velocity></{0}>"""
OBSTACLES = '<commonRoad timeStepSize="0.1" commonRoadVersion="2020a">' + "".join(
    f'''<dynamicObstacle id="{number}"><type>car</type><shape><rectangle><length>4.6</length><width>1.8</width></rectangle></shape>
{STATE.format("initialState", 20 * number, number, 0)}<trajectory>{STATE.format("state", 20 * number + 1, number, 1)}</trajectory>
</dynamicObstacle>''' for number in (1, 2)) + "</commonRoad>\n"
PLUGINS = {  # what each program is given; each writes to standard output
    "xml": {"glint-traffic-sumo": "floating.xml --ego all --class-map car=car --class-default van", "glint-traffic-commonroad": "obstacles.xml --ego all"},
    "osi": {"glint-osi": "list.jsonl", "glint-mcap": "list.jsonl", "glint-traffic-osi": "list.osi"},
    "sensor_signal": {"glint-sensor-signal": "ideal.jsonl"},
}


def build_plugins(folder):
    """Each plug-in of glint builds as a folder of a user's, without a warning, and its programs give the tree's bytes."""
    for name, text in ("floating.xml", FLOATING), ("obstacles.xml", OBSTACLES):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    run("""glint-traffic cut-in | glint-extract | glint-ideal --sensors srr24-signal | head -n 6 >ideal.jsonl
        glint-traffic cut-in | glint-extract | glint-ideal --sensors srr24-pair --sections quality,objects | glint-sensor | glint-noise >list.jsonl
        ! command -v glint-osi >/dev/null || glint-osi list.jsonl -o list.osi""", folder)
    for plugin, programs in PLUGINS.items():
        if not all(os.path.exists(os.path.join(BUILT, program)) for program in programs):
            print(f"skipped  stages/{plugin} outside the tree: it was not built")
            continue
        shutil.copytree(os.path.join(DOCUMENTS, "stages", plugin), os.path.join(folder, plugin))
        refusal = run(f"PKG_CONFIG_PATH= PKG_CONFIG_LIBDIR=none make -C {plugin}", folder, expected=2)
        assert "glint.pc" in refusal and not os.path.exists(os.path.join(folder, plugin, "build")), refusal
        run(f'make -s -j2 -C {plugin} CFLAGS="{STRICT}"', folder)
        made = sorted(name for name in os.listdir(os.path.join(folder, plugin)) if name.startswith("glint-"))
        assert made == sorted(programs), f"{plugin} makes {made}"
        for program, words in programs.items():
            at = f"GLINT_DATA={PREFIX}/share/glint/data"
            run(f"{at} {plugin}/{program} {words} >outside && {BUILT}/{program} {words} >inside", folder)
            assert os.path.getsize(os.path.join(folder, "inside")) > 1000, f"{program} {words} writes little"
            run("cmp outside inside", folder)
            assert run(f"{plugin}/{program} --help", folder) == run(f"{BUILT}/{program} --help"), f"{program} --help differs"


def check_own_sensor(folder):
    """The sensor stage of the pages, in Python and in C, makes the same cells, with labels that glint-check takes."""
    at = os.path.join(DOCUMENTS, "pipelines")
    shutil.copytree(os.path.join(at, "bins"), os.path.join(folder, "bins"))
    run(f'make -s -C bins install CFLAGS="{STRICT}"', folder)
    run("glint-traffic cut-in | glint-extract | glint-ideal --sensors srr24-pair --sections account >seen.jsonl", folder)
    for stage in f"python3 -B {at}/bins.py", "glint-bins":
        found = run(f"{stage} seen.jsonl | glint-noise | glint-check", folder)
        assert re.fullmatch(r"201 frames, \d+ targets; (\d{4}) of \1 contributors recomputed\n", found), f"{stage}: {found}"
    alike = list(zip(frames(f"python3 -B {at}/bins.py seen.jsonl | glint-noise-none", folder),
                     frames("glint-bins seen.jsonl | glint-noise-none", folder), strict=True))
    for one, other in alike:
        same = near(one["targets"], other["targets"]) and lost_of(one) == lost_of(other)
        assert same, f"frame {one['frame']}: bins.py and bins.c differ"
    os.remove(os.path.join(PROGRAMS, "glint-bins"))


def lost_of(frame):
    return [(group["sensor"], group["stage"], echo["object"], echo["reflector"]) for group in frame["lost"] for echo in group["echoes"]]


def near(one, other):
    """The same, numbers but for their last digits."""
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(near(one[name], other[name]) for name in one)
    if isinstance(one, list):
        return len(one) == len(other) and all(map(near, one, other))
    return one == other or type(one) in (int, float) and math.isclose(one, other, rel_tol=1e-9, abs_tol=1e-9)


def pages():
    """(folder, text, is it a history?) of every installed page. CHANGES.md names what is gone, and what is in the source
    tree alone."""
    for top in DOCUMENTS, os.path.join(PREFIX, "share/glint"):
        for folder, _, names in os.walk(top):
            for name in names:
                if name.endswith(".md"):
                    with open(os.path.join(folder, name), encoding="utf-8") as page:
                        yield folder, page.read(), name == "CHANGES.md"


def check_names():
    """Links lead somewhere; ../../releases is the host's page of releases. Programs, pipelines, documents, schemas and headers that
    pages name are there, and scripts have a help that names them as they are called."""
    text_of_all = ""
    for folder, text, is_history in pages():
        for target in re.findall(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)", text):
            assert target == "../../releases" or os.path.exists(os.path.join(folder, target)), f"{folder}: a link leads to {target}, which is not installed"
        for name in re.findall(r"(?<![\w./-])scripts/[\w-]+(?![\w./-])", text):
            assert is_history or os.path.exists(os.path.join(DOCUMENTS, name)), f"{folder}: {name} is not installed"
        for target, after in re.findall(r"`make ([a-z]+)[^`]*`(.{0,20})", text, re.DOTALL):
            of_tree = is_history or after.startswith(" of the source tree")
            assert of_tree or target in ("install", "uninstall", "part"), f"{folder}: make {target}: no Makefile is installed"
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
        text_of_all += text
    for name in SCRIPTS:
        assert f"{name} " in text_of_all, f"no page has a command of {name}"
        told = run(f"{name} --help")
        assert f"    {name} " in told, f"{name} --help: {told}"


def check_scripts(folder):
    """Users' programs do their work without the pages, from any folder: vehicles are found by the words of sets, a set is made,
    checked, exported and tracked, a data sheet becomes a radar, and Python imports glint as stages/README.md says."""
    data = os.path.join(PREFIX, "share/glint/data")
    for word, of_set in ("paper", "vehicles"), ("detailed", "detailed/vehicles"), ("surfaces", "surfaces/vehicles"):
        run(f"glint-traffic cut-in | glint-extract --vehicles {word} >word && "
            f"glint-traffic cut-in | glint-extract --vehicles {data}/{of_set} | cmp - word", folder)
    assert "high; also --vehicles detailed, surfaces\n" in run("glint --list vehicles"), "sets of vehicles are not listed"
    run(f"BUILD=elsewhere glint-dataset {data}/sets/small.json --out set && make -s -C set && glint-check-set set", folder)
    run("cat set/*/*/*.jsonl.gz > list.jsonl.gz && glint-tracker list.jsonl.gz > tracks.jsonl", folder)
    score = json.loads(run("glint-score-tracks --tracks tracks.jsonl --summary list.jsonl.gz", folder))
    assert score["frames"] == 1000, score
    run(f"glint-make-radar {data}/sheets/ars408-21.json -o radar.json && glint-traffic two-vehicles | glint-extract | "
        "glint-ideal --sensors ./radar.json --sections quality | glint-sensor | glint-noise >seen.jsonl", folder)
    run("glint-export kitti --out kitti seen.jsonl", folder)
    code = "import glint; print(sum(len(one['targets']) for one in glint.frames('list.jsonl.gz')))"
    with_path = "PYTHONPATH=$(pkg-config --variable=datadir glint)/scripts"
    assert int(run(f'{with_path} python3 -B -c "{code}"', folder)) > 0
    assert "m/s" in run(f"python3 -B {PREFIX}/share/glint/pipelines/live.py", folder)
    refusal = run("glint-export kitti --out kitti seen.jsonl", folder, expected=73)
    assert refusal.startswith("glint-export: --out 'kitti': is there already"), refusal
    if shutil.which("gnuplot"):
        run("glint-realism --draw . && [ -s realism.svg ]", folder)
    else:
        print("skipped  glint-realism draws: there is no gnuplot")


def without_pages(check, folder):
    """Runs a check while the folder of pages is away."""
    pages_at = os.path.join(PREFIX, "share/doc")
    os.rename(pages_at, pages_at + ".away")
    try:
        check(folder)
    finally:
        os.rename(pages_at + ".away", pages_at)


check_programs()
check_names()
with tempfile.TemporaryDirectory() as place:
    check_examples(place)
with tempfile.TemporaryDirectory() as place:
    check_headers(place)
    check_completions(place)
    run("glint-demo --fast", place, expected=64)
    without_pages(check_scripts, place)
    build_stage(place)
    check_stage(place)
    build_plugins(place)
    check_own_sensor(place)
os.remove(os.path.join(PROGRAMS, "glint-spray"))
print("installed: one body for all programs, all that pages name, a stage of one's own, and plug-ins outside the tree")
