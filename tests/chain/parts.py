"""Parts of a long test (tests/support/parts.sh): the time left is true early, why parts failed stands last, and signals
that a parent ignores change nothing.

Usage: python3 tests/chain/parts.py BIN_DIR

The time left is computed for runs whose clock is simulated; parts that are run here take no time worth mention.
"""
import os
import pty
import random
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SCRIPTS = os.path.join(ROOT, "scripts")
sys.path.insert(0, SCRIPTS)
from glint import progress  # noqa: E402

PATIENCE_S = 300
IGNORED = "HUP,INT,QUIT,PIPE,ALRM,TERM,USR1,USR2,XCPU,XFSZ"
CORES, FACTOR, EARLY = 2, 1.6, 0.1


def shell(text, **more):
    return subprocess.run(["bash", "-c", text], cwd=ROOT, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, timeout=PATIENCE_S, check=False, **more)


def on_terminal(text):
    """What a script prints on a terminal, which it has for stdout and stderr."""
    ours, theirs = pty.openpty()
    process = subprocess.Popen(["bash", "-c", text], cwd=ROOT, stdin=subprocess.DEVNULL, stdout=theirs, stderr=theirs)
    os.close(theirs)
    shown = b""
    try:
        while piece := os.read(ours, 65536):
            shown += piece
    except OSError:  # the end of the other side
        pass
    os.close(ours)
    return process.wait(PATIENCE_S), shown.decode()


# --- the time left --------------------------------------------------------------------------------

def simulated(costs, pace, draws):
    """States of a run whose parts take their costs times the pace, each with a scatter of a quarter, three parts alone and
    then two beside each other: (seconds since the begin, seconds left, lines of parts_left)."""
    took = [pace * cost * draws.uniform(0.75, 1.25) for cost in costs]
    hows, begins, now, cores = ["alone"] * 3 + ["beside"] * (len(costs) - 3), [], 0, [0] * CORES
    for how, seconds in zip(hows, took):
        core = cores.index(min(cores))
        begins.append(max(cores) if how == "alone" else cores[core])
        cores = [begins[-1] + seconds] * CORES if how == "alone" else cores[:core] + [begins[-1] + seconds] + cores[core + 1:]
    whole = max(cores)
    for now in range(0, int(whole), max(1, int(whole / 40))):
        lines = []
        for how, cost, begin, seconds in zip(hows, costs, begins, took):
            state = "waits" if now <= begin else "runs" if now < begin + seconds else "ended"
            lines.append(f"{how} {cost} {state} {min(seconds, max(0, now - begin)):.0f} -")
        yield now / whole, whole - now, lines


def told(lines):
    """The seconds left that the line tells."""
    done = subprocess.run(["bash", "-c", f". tests/support/parts.sh; parts_left {CORES} names"], cwd=ROOT, input="\n".join(lines) + "\n",
                          capture_output=True, text=True, check=True)
    hours, minutes, seconds = map(int, re.search(r"(\d+):(\d\d):(\d\d) left: names", done.stderr).groups())
    return 3600 * hours + 60 * minutes + seconds


def the_time_left_of_parts_is_true_from_the_first_tenth_on(_):
    draws = random.Random(1)
    for pace in 0.3, 1, 4:
        costs = [60, 90, 40] + [draws.choice([5, 10, 20, 40, 80]) for _ in range(30)]
        for share, left, lines in simulated(costs, pace, draws):
            found = told(lines)
            if share == 0 and abs(found - (sum(costs[:3]) + sum(costs[3:]) / CORES)) > 1:
                return f"at the begin {found} s, which is not what the table says"
            if share > EARLY and left > 30 and not left / FACTOR < found < left * FACTOR:
                return f"{found} s left where {left:.0f} s are, after {100 * share:.0f} % at a pace of {pace}"
    return None


def a_part_that_had_nothing_to_build_says_nothing_of_the_others(_):
    """Within the factor after a build that takes a second instead of 100, and ten of thirty parts as the table says."""
    lines = ["alone 100+ ended 1 -"] + ["beside 10 ended 10 -"] * 10 + ["beside 10 waits 0 -"] * 20
    found = told(lines)
    return None if 100 / FACTOR < found < 100 * FACTOR else f"{found} s left where 100 s are"


def a_share_that_a_part_tells_counts_more_than_its_seconds(_):
    found = told(["alone 100 runs 300 0.5000"])
    return None if 200 < found < 300 * FACTOR else f"{found} s left of a part that is half done after 300 s"


def a_part_that_lasts_goes_on_lasting(_):
    """It is overdue: it is not about to end in a second."""
    found = told(["alone 12 runs 200 -"])
    return None if found >= 50 else f"{found} s left"


def items_of_python_follow_the_same_law(_):
    """scripts/bench: scenes that cost from 1 to 1,000 s."""
    draws, costs = random.Random(2), [1, 3, 10, 100, 30, 300, 1000, 100]
    for pace in 0.3, 1, 4:
        took = [pace * cost * draws.uniform(0.8, 1.25) for cost in costs]
        for done in range(len(costs)):
            for part in 0, 0.5, 0.9:
                spent, running = sum(took[:done]), part * took[done]
                left = sum(took) - spent - running
                found = progress.left_s(costs, done, spent, running)
                if (spent + running) / sum(took) > EARLY and left > 0.02 * sum(took) and not left / 2 < found < left * 2:
                    return f"{found:.0f} s left where {left:.0f} s are, at a pace of {pace}"
    return None


# --- parts ----------------------------------------------------------------------------------------

PARTS = """. tests/support/parts.sh
good() { sleep 1.2; echo "good is $1"; }
bad() { for line in $(seq 60); do echo "line $line of bad"; done; [ 1 = 2 ]; echo "not reached"; }
killed() { sh -c 'kill -KILL $$'; }
every_part() {
    needed first %s
    beside second good two
    beside third %s
    beside fourth good four
    together
    part last good five
}
run_parts every_part
"""


def fake(third, first="good one"):
    return f"export PARTS_SECONDS=$(mktemp); printf '1 first\\n1 second\\n2 third\\n1 last\\n' >$PARTS_SECONDS; {PARTS % (first, third)}"


def parts_that_pass_print_what_they_say_in_their_order(_):
    done = shell(fake("good three"))
    parts = re.findall(r"== (\w+)\ngood is (\w+)\n   \(\d+ s\)\n", done.stdout)
    due = {("first", "one"), ("second", "two"), ("third", "three"), ("fourth", "four"), ("last", "five")}
    good = done.returncode == 0 and parts[0] == ("first", "one") and parts[-1] == ("last", "five") and set(parts) == due
    return None if good and re.search(r"\Z|all tests passed in \d+ s\n\Z", done.stdout) and "\r" not in done.stdout else done.stdout


def why_a_part_failed_stands_last_with_its_log(_):
    for third, why, lines in (("bad", "(bad): exit status 1\n", 39), ("killed", "(killed): ended by SIGKILL\n", 0), ("nowhere", "(nowhere): exit status 127\n", 0)):
        done = shell(fake(third))
        last = done.stdout[done.stdout.rindex("\nFAILED: third "):]
        if done.returncode != 1 or why not in last or len(re.findall(r"(?m)^    line \d+ of bad$", last)) != lines:
            return last
        if "not reached" in done.stdout or "good is five" not in done.stdout or "all tests passed" in done.stdout:
            return f"goes on wrongly after {third}: {done.stdout}"
        if third == "bad" and not last.endswith("    this failed with exit status 1: [ 1 = 2 ]\n"):
            return f"does not say what failed: {last}"
    return None


def nothing_runs_after_a_needed_part_that_failed(_):
    done = shell(fake("good three", first="bad"))
    return None if done.returncode == 1 and "FAILED: first" in done.stdout and "good" not in done.stdout else done.stdout


def a_terminal_shows_the_time_left_by_cost_and_the_names(_):
    code, shown = on_terminal(fake("good three"))
    lines = re.findall(r"\r\[#* *\] +\d+ %, 0:00:\d\d left: (\w+(?:, \w+)?) *", shown)
    good = code == 0 and "first" in lines and "last" in lines and re.search(r"\r *\r\S*all tests passed", shown)
    return None if good else f"exit {code}: {shown}"


def a_part_tells_its_share_and_what_it_starts_does_not(folder):
    """The share of one that runs its own work in halves; a script inside it has another."""
    script = os.path.join(folder, "work.py")
    with open(script, "w", encoding="ascii") as file:
        file.write(f"import subprocess, sys, time; sys.path.insert(0, '{SCRIPTS}'); from glint.progress import Progress\n"
                   "if sys.argv[1:]: [time.sleep(1.5) for _ in Progress('x').over([0], cost=lambda _: 1)]\n"
                   "else:\n    for _ in Progress('halves').over([0, 1], cost=lambda _: 2): subprocess.run([sys.executable, __file__, 'inner'])\n")
    telling = f"( export GLINT_PROGRESS=\"$BASHPID {folder}/share\"; python3 {script}; true )"
    done = shell(telling)
    with open(f"{folder}/share", encoding="ascii") as file:
        share = float(file.read())
    os.remove(f"{folder}/share")
    strange = shell(f"export GLINT_PROGRESS='1 {folder}/share'; ( python3 {script} inner; true )")
    if done.stdout or strange.stdout or os.path.exists(f"{folder}/share"):
        return f"tells what it should not: {done.stdout}{strange.stdout}"
    return None if 0.3 < share < 1 else f"tells {share}"


def who_waits_for_files_fails_only_with_the_command(folder):
    """Under the strict options of scripts; the folder of the files appears late, and a share is empty while it is written."""
    text = f"set -euo pipefail; . scripts/support/progress.sh; sh -c 'sleep 0.7; mkdir {folder}/late; exit CODE' & " \
           f"progress_wait $! 1 files {folder}/late .o; echo whole; rmdir {folder}/late"
    found = [(done.returncode, done.stdout) for done in (shell(text.replace("CODE", code)) for code in "05")]
    if found != [(0, "whole\n"), (5, "")]:
        return f"waits wrongly: {found}"
    code, shown = on_terminal(fake("empties").replace("bad() {", "empties() { : >\"${GLINT_PROGRESS#* }\"; sleep 1.5; }; bad() {", 1))
    return None if code == 0 else f"an empty share ends the run: {shown}"


# --- signals --------------------------------------------------------------------------------------

def a_program_of_tests_finds_signals_at_their_defaults(folder):
    """Under a parent that ignores them, as nohup does; and its message says by which it was ended."""
    for name in IGNORED.split(","):
        program = os.path.join(folder, "test_ended")
        with open(program, "w", encoding="ascii") as file:
            file.write(f"#!/bin/sh\necho '[ RUN      ] a_test'\nkill -{name} $$\nsleep 1\necho survived\n")
        os.chmod(program, 0o755)
        done = shell(f"env --ignore-signal={IGNORED} tests/support/run_test {program} {program}")
        if done.returncode != 1 or f"it was in the test a_test\n{program} test_ended failed: ended by SIG{name}\n" not in done.stdout:
            return f"{name}: exit {done.returncode}: {done.stdout}"
    return None


def a_program_that_fails_says_how(folder):
    program = os.path.join(folder, "test_failing")
    for text, due in (("exit 3", "failed: exit status 3\n"), ("exit 1", f"{program}.log is empty; "),
                      ("echo '[       OK ] a_test'; echo why; exit 1", f"why\n{program} test_failing failed: exit status 1\n"),
                      ("exec /nonexistent", "failed: it cannot be run\n")):
        with open(program, "w", encoding="ascii") as file:
            file.write(f"#!/bin/sh\n{text}\n")
        os.chmod(program, 0o755)
        done = shell(f"tests/support/run_test {program} {program}")
        if done.returncode != 1 or due not in done.stdout or " OK " in done.stdout:
            return f"{text}: {done.stdout}"
    return None


def tests_run_under_nohup(_):
    """Those that end programs by signals, under a parent that ignores all that can be ignored."""
    program = os.path.join(os.path.dirname(BIN), "unit", "text")
    for test in (f"/usr/bin/python3 tests/chain/outputs.py {BIN}", f"{program} test_output"):
        if test.startswith(program) and not os.path.exists(program):
            print("skipped  test_output under nohup: it is not built")
            continue
        done = shell(f"exec env --ignore-signal={IGNORED} {test}")
        if done.returncode != 0:
            return f"{test}: {done.stdout[-2000:]}"
    return None


def whoever_sends_a_signal_that_can_be_ignored_sets_it(_):
    """Scripts of tests that end a process other than by SIGKILL use tests/support/signals.py."""
    for folder in "tests/chain", "tests/oracle", "tests/tools", "scripts":
        for name in sorted(os.listdir(os.path.join(ROOT, folder))):
            path = os.path.join(ROOT, folder, name)
            if not os.path.isfile(path) or path == os.path.abspath(__file__):
                continue
            with open(path, encoding="utf-8") as file:
                text = file.read()
            sends = re.search(r"\.terminate\(\)|send_signal\((?!signal\.SIGKILL)|killpg\(.*(15|SIGTERM|SIGINT|SIGHUP)\)", text)
            if sends and "signals.as_on_a_terminal()" not in text:
                return f"{folder}/{name} has {sends[0]}"
    return None


TESTS = [the_time_left_of_parts_is_true_from_the_first_tenth_on, a_part_that_had_nothing_to_build_says_nothing_of_the_others,
         a_share_that_a_part_tells_counts_more_than_its_seconds, a_part_that_lasts_goes_on_lasting, items_of_python_follow_the_same_law,
         parts_that_pass_print_what_they_say_in_their_order, why_a_part_failed_stands_last_with_its_log, nothing_runs_after_a_needed_part_that_failed,
         a_terminal_shows_the_time_left_by_cost_and_the_names, a_part_tells_its_share_and_what_it_starts_does_not, who_waits_for_files_fails_only_with_the_command,
         a_program_of_tests_finds_signals_at_their_defaults, a_program_that_fails_says_how, tests_run_under_nohup,
         whoever_sends_a_signal_that_can_be_ignored_sets_it]


def main():
    failed = 0
    for test in TESTS:
        with tempfile.TemporaryDirectory() as folder:
            fault = test(folder)
        failed += bool(fault)
        print(f"{'FAILED' if fault else 'ok':8} {test.__name__.replace('_', ' ')}{': ' + fault if fault else ''}", flush=True)
    sys.exit(failed > 0)


if len(sys.argv) != 2:
    sys.exit(__doc__)
BIN = os.path.abspath(sys.argv[1])
main()
