"""Rate and time left stand on stderr where it is a terminal and work takes over a second, and nowhere else. What is
no text is not written to a terminal.

Usage: python3 tests/chain/progress.py BIN_DIR

No test depends on the speed of the machine: a run takes over a second because nobody reads what it writes, or
because it has work for hours and is ended; and a run that must be silent as it is short is measured.
"""
import fcntl
import os
import pty
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import termios
import threading
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tests", "support"))
import signals  # noqa: E402

PATIENCE_S = 300
LINE = rb"\r\[#* *\] +\d+ %, \d+(\.\d)? UNIT/s, \d+:\d\d:\d\d left *"
FRAMES = re.compile(LINE.replace(b"UNIT", b"frames"))
ERASED = re.compile(rb"\r *\r\Z")
ENDLESS = "glint-traffic-random --frames 1000000000"
LIST = "glint-extract | glint-ideal --sensors corner77 | glint-sensor | glint-noise"
BLOCKED_S = 1.1


class Terminal:
    """What a program writes to a terminal of its own."""

    def __init__(self, idle_s=0, columns=0):
        self.idle_s = idle_s  # nobody looks at it for so long
        self.ours, self.theirs = pty.openpty()
        fcntl.ioctl(self.theirs, termios.TIOCSWINSZ, struct.pack("4H", 24, columns, 0, 0))
        self.text, self.changed = b"", threading.Condition()
        self.reader = threading.Thread(target=self.read, daemon=True)

    def start(self, command, **streams):
        process = subprocess.Popen(["bash", "-c", "exec " + command], stderr=self.theirs, **streams)
        os.close(self.theirs)
        self.reader.start()
        return process

    def read(self):
        time.sleep(self.idle_s)
        while True:
            try:
                piece = os.read(self.ours, 65536)
            except OSError:
                piece = b""
            with self.changed:
                self.text += piece
                self.changed.notify()
            if not piece:
                return

    def wait_for(self, pattern):
        with self.changed:
            return self.changed.wait_for(lambda: pattern.search(self.text), PATIENCE_S)

    def all(self):
        self.reader.join(PATIENCE_S)
        os.close(self.ours)
        return self.text


def on_terminal(command, stdin=subprocess.DEVNULL, columns=0):
    """stderr of a run of over a second, and stdout, which nobody reads in the first."""
    terminal = Terminal(columns=columns)
    process = terminal.start(command, stdin=stdin, stdout=subprocess.PIPE)
    time.sleep(BLOCKED_S)
    written = process.stdout.read()
    process.wait(PATIENCE_S)
    return terminal.all(), written


def endless_work_tells_how_long_it_takes(folder):
    for command in (f"{ENDLESS} -o {folder}/list.jsonl", f"{ENDLESS} > /dev/null", f"{ENDLESS} | cat > /dev/null",
                    f"{ENDLESS} -o {folder}/list.jsonl.gz",
                    f"glint -c '{ENDLESS} | {LIST} -o {folder}/list.jsonl'",
                    f"glint -c '{ENDLESS} | {LIST} | glint-summary'"):
        terminal = Terminal()
        words = command if "|" not in command or "-c" in command else f"bash -c '{command}'"
        process = terminal.start(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, start_new_session=True)
        if not terminal.wait_for(FRAMES):
            return f"no rate of: {command}"
        os.killpg(process.pid, 15)
        process.wait(PATIENCE_S)
        terminal.all()
    return None


def a_stage_that_reads_a_file_tells_it_too(folder):
    for command in (f"glint-extract {folder}/frames.jsonl", f"glint-extract {folder}/frames.jsonl.gz",
                    f"glint-extract {folder}/frames.jsonl {folder}/frames.jsonl.gz",
                    f"glint-extract < {folder}/frames.jsonl", f"glint-score --truth {folder}/lists.jsonl {folder}/lists.jsonl",
                    f"glint -c 'glint-extract {folder}/frames.jsonl | glint-ideal --sensors corner77'"):
        text, _ = on_terminal(command)
        if not FRAMES.match(text):
            return f"no rate of: {command}: {text[:100]}"
        if not ERASED.search(text):
            return f"the line stays after: {command}: {text[-100:]}"
    return None


def a_ladder_of_chains_tells_when_it_is_done(folder):
    """The stream comes by a pipe, of which nothing is told; then the signal takes some 10 ms a frame and seed."""
    if not shutil.which("glint-sensor-signal"):
        print("skipped  a ladder of chains tells when it is done: there is no glint-sensor-signal")
        return None
    terminal = Terminal()
    with subprocess.Popen(["cat", f"{folder}/frames.jsonl"], stdout=subprocess.PIPE) as other:
        process = terminal.start("glint-cost --sample 500 --sensors srr24-signal", stdin=other.stdout,
                                 stdout=subprocess.DEVNULL)
        shown = terminal.wait_for(FRAMES)
        process.terminate()
        process.wait(PATIENCE_S)
    terminal.all()
    return not shown and "no rate of glint-cost"


def who_reads_a_pipe_leaves_it_to_the_other_side(folder):
    with subprocess.Popen(["cat", f"{folder}/frames.jsonl"], stdout=subprocess.PIPE) as other:
        text, _ = on_terminal("glint-extract", other.stdout)
        return text and f"a second line: {text[:100]}"


def nothing_is_printed_where_stderr_is_no_terminal(folder):
    command = f"glint-extract {folder}/frames.jsonl"
    with subprocess.Popen(command.split(), stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        time.sleep(BLOCKED_S)
        process.stdout.read()
        text = process.stderr.read()
    return text and f"{text[:100]} from: {command}"


def short_work_is_silent(_):
    for _ in range(100):
        begin, terminal = time.monotonic(), Terminal()
        process = terminal.start("glint-traffic-random --frames 2", stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        process.wait(PATIENCE_S)
        ended, found = time.monotonic(), terminal.all()
        if ended - begin < 1:
            return found and f"{found[:100]} from a run of under a second"
    return "no run takes under a second"


def a_narrow_terminal_cuts_the_line_off(folder):
    python = f"import sys, time; sys.path.insert(0, '{ROOT}/scripts'); from glint.progress import Progress\n" \
             f"for n in Progress('runs').over(range(2)): time.sleep({BLOCKED_S})"
    shell = f". {ROOT}/scripts/support/progress.sh; sleep {BLOCKED_S}; progress 1 4 runs; progress_end"
    pace = f"import sys, time, array; sys.path.insert(0, '{ROOT}/scripts'); from glint.sets import pace; pace.PATH = 'begun'\n" \
           f"open('{folder}/begun', 'wb').write(array.array('d', [time.time() - 9, 4, 0])); pace.Pace('{folder}', 0, 1).end(); pace.clear()"
    for command in (f"glint-extract {folder}/frames.jsonl", f"python3 -c \"{python}\"", f"python3 -c \"{pace}\"", f"sh -c '{shell}'"):
        for columns in (40, 72, 73, 200):
            text, _ = on_terminal(command, columns=columns)
            width = min(columns - 1, 72)
            if not re.match(rb"\r\[#* *", text) or {len(line) for line in text.split(b"\r")} != {0, width} or not ERASED.search(text):
                return f"in {columns} columns: {text[:100]} from: {command}"
    return None


def tables_fit_a_terminal(folder):
    """Their words are those of a file, and the pipeline of a plan stays as it is."""
    with open(f"{folder}/few.jsonl", "wb") as few, open(f"{folder}/frames.jsonl", "rb") as frames:
        few.writelines(frames.readlines()[:5])
    plan = f"glint -c 'glint-extract {folder}/few.jsonl | glint-plan --sensors corner77'"
    for command in ("glint --list pipelines", "glint --datasheet lrr77-full", f"glint-summary {folder}/lists.jsonl", plan):
        wide = subprocess.run(command, shell=True, check=True, stdout=subprocess.PIPE).stdout.decode()
        terminal = Terminal(columns=60)
        terminal.start(f"{command} >&2", stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL).wait(PATIENCE_S)
        lines = terminal.all().decode().split("\r\n")
        commands = [line for line in wide.splitlines() if line.startswith(("glint-", "  |")) and command == plan]
        if max(map(len, wide.splitlines())) <= 60 or any(len(line) > 60 for line in lines if line not in commands):
            return f"no line, or one of the terminal, is too wide: {command}: {max(lines, key=len)}"
        if command == plan and not {*commands} <= {*lines}:
            return f"other commands than {commands}"
        if command != plan and " ".join(lines).split() != wide.split():
            return f"other words: {command}"
    return None


def frames_on_a_terminal_stay_whole(folder):
    """Frames that a terminal shows are no place for a line between them."""
    terminal = Terminal(BLOCKED_S)
    expected = subprocess.run(["glint-extract", f"{folder}/frames.jsonl"], check=True, stdout=subprocess.PIPE).stdout
    process = terminal.start(f"glint-extract {folder}/frames.jsonl >&2", stdin=subprocess.DEVNULL)
    process.wait(PATIENCE_S)
    found = terminal.all().replace(b"\r\n", b"\n")
    return found != expected and "a terminal shows other bytes than the frames"


def a_page_is_not_written_to_a_terminal(folder):
    frames = f"{folder}/lists.jsonl"
    for command in (f"glint-view {frames}", f"glint -c 'glint-view {frames}'"):
        terminal = Terminal()
        process = terminal.start(f"{command} >&2", stdin=subprocess.DEVNULL)
        code, text = process.wait(PATIENCE_S), terminal.all()
        if code != 64 or b"-o FILE" not in text or text.count(b"\n") != 1:
            return f"exit code {code} and {text[:100]} from: {command}"
    for output, begin in ((f"{folder}/page.html", b""), ("-", b"<!DO")):
        terminal = Terminal()
        process = terminal.start(f"glint-view -o {output} {frames} >&2", stdin=subprocess.DEVNULL)
        code, text = process.wait(PATIENCE_S), terminal.all()
        if code != 0 or text[:4] != begin:
            return f"exit code {code} and {text[:100]} with -o {output}"
    return None


def scripts_show_the_same_line(_):
    """The two helpers of scripts; a script that uses one is tried with work that takes over a second."""
    python = f"import sys, time; sys.path.insert(0, '{ROOT}/scripts'); from glint.progress import Progress\n" \
             f"for n in Progress('runs').over(range(4)): time.sleep({BLOCKED_S} if n < 2 else 0.3)"
    shell = f". {ROOT}/scripts/support/progress.sh; sleep {BLOCKED_S}; progress 1 4 runs; progress_end"
    for words in (f"python3 -c \"{python}\"", f"sh -c '{shell}'", f"bash -c '{shell}'"):
        text, _ = on_terminal(words)
        if not re.match(LINE.replace(b"UNIT", b"runs"), text) or not ERASED.search(text):
            return f"no rate, or it stays: {words}: {text[:100]}"
        if not re.search(rb"\r\[######                  \]  25 %, \d\.\d runs/s, 0:00:\d\d left", text):
            return f"another line: {words}: {text[:100]}"
        done = subprocess.run(words, shell=True, check=True, capture_output=True)
        if done.stderr:
            return f"{done.stderr[:100]} without a terminal: {words}"
    return None


TESTS = [endless_work_tells_how_long_it_takes, a_stage_that_reads_a_file_tells_it_too,
         a_ladder_of_chains_tells_when_it_is_done, who_reads_a_pipe_leaves_it_to_the_other_side, nothing_is_printed_where_stderr_is_no_terminal,
         short_work_is_silent, a_narrow_terminal_cuts_the_line_off, tables_fit_a_terminal, frames_on_a_terminal_stay_whole, a_page_is_not_written_to_a_terminal, scripts_show_the_same_line]


def lacks_terminal(test):
    """Why a test cannot open the terminal that it needs, or None."""
    try:
        if test is not nothing_is_printed_where_stderr_is_no_terminal:
            for end in pty.openpty():
                os.close(end)
        return None
    except OSError as error:
        return f"no terminal can be opened: {error}"


def main(words):
    if len(words) != 1:
        sys.exit(__doc__)
    signals.as_on_a_terminal()
    os.environ["PATH"] = os.path.abspath(words[0]) + os.pathsep + os.environ["PATH"]
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        for made in ("frames.jsonl", "frames.jsonl.gz"):
            subprocess.run(["glint-traffic-random", "--density", "medium", "--frames", "500", "-o", f"{folder}/{made}"],
                           check=True)
        subprocess.run(["glint", "-c", f"glint-traffic-random --density dense --frames 500 | {LIST} -o {folder}/lists.jsonl"], check=True)
        for test in TESTS:
            name, reason = test.__name__.replace("_", " "), lacks_terminal(test)
            if reason:
                print(f"skipped  {name}: {reason}")
                continue
            fault = test(folder)
            failed += bool(fault)
            print(f"{'FAILED' if fault else 'ok':8} {name}{': ' + fault if fault else ''}")
    sys.exit(failed > 0)


main(sys.argv[1:])
