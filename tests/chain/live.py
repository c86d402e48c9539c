"""No frame waits: a simulator that wants the answer to each frame before it writes the next one gets it.

Usage: python3 tests/chain/live.py BIN_DIR

Through pipes, FIFOs, sockets and terminals, plain and gzip, through processes and fused, the answers are the bytes
of a run over a file. An answer that has not come after a minute counts as never coming.
"""
import os
import select
import shutil
import socket
import subprocess
import sys
import tempfile
import tty
import zlib

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PATIENCE_S = 60
CHAIN = ("glint-extract | glint-ideal --sensors srr24-pair-every-frame --sections account | glint-sensor | glint-noise")
FRAMES = 60


def run(words, data=b""):
    done = subprocess.run(words, input=data, capture_output=True, check=False, timeout=PATIENCE_S)
    if done.returncode != 0:
        sys.exit(f"live: {' '.join(words)}: exit {done.returncode}: {done.stderr.decode()}")
    return done.stdout


# ---- ways in and out: (what the chain reads, what it writes, where to write, where to read) ------


def through_pipes(_):
    (chain_in, write), (read, chain_out) = os.pipe(), os.pipe()
    return chain_in, chain_out, write, read


def through_pipes_that_never_block(_):
    ends = through_pipes(None)
    for end in ends[:2]:
        os.set_blocking(end, False)
    return ends


def through_fifos(folder):
    ends = []
    for name in ("in", "out"):
        path = os.path.join(folder, name)
        os.mkfifo(path)
        read = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        ends += [read, os.open(path, os.O_WRONLY)]
        os.set_blocking(read, True)
    return ends[0], ends[3], ends[1], ends[2]


def through_a_socket(_):
    chain, ours = socket.socketpair()
    end = chain.detach()
    return end, os.dup(end), ours.fileno(), os.dup(ours.detach())


def through_terminals(_):
    (write, chain_in), (read, chain_out) = os.openpty(), os.openpty()
    for end in (chain_in, chain_out):
        tty.setraw(end)
    return chain_in, chain_out, write, read


class Answers:
    """Lines that come out of a descriptor."""

    def __init__(self, read):
        self.read, self.bytes = read, b""

    def next(self):
        while b"\n" not in self.bytes:
            if not select.select([self.read], [], [], PATIENCE_S)[0]:
                return b"nothing"
            chunk = os.read(self.read, 1 << 16)
            if not chunk:
                return b"the end"
            self.bytes += chunk
        line, _, self.bytes = self.bytes.partition(b"\n")
        return line


def converse(program, text, ends, frames, expected, pack=lambda line: line):
    """Writes each frame after the answer to the one before."""
    chain_in, chain_out, write, read = ends
    process = subprocess.Popen([program, "-c", text], stdin=chain_in, stdout=chain_out, stderr=subprocess.DEVNULL)
    os.close(chain_in)
    os.close(chain_out)
    answers = Answers(read)
    for number, (frame, lines) in enumerate(zip(frames, expected)):
        os.write(write, pack(frame))
        for line in lines:
            answer = answers.next()
            if answer != line:
                process.kill()
                return f"frame {number}: {answer[:80]!r} instead of {line[:80]!r}"
    process.kill()
    process.wait()
    os.close(write)
    os.close(read)
    return None


def packer():
    stream = zlib.compressobj(wbits=16 + zlib.MAX_WBITS)
    return lambda line: stream.compress(line) + stream.flush(zlib.Z_SYNC_FLUSH)


# ---- the checks ----------------------------------------------------------------------------------


def ways(frames, folder):
    targets = [[line] for line in run(["glint", "-c", CHAIN], b"".join(frames)).splitlines()]
    for way in (through_pipes, through_pipes_that_never_block, through_fifos, through_a_socket, through_terminals):
        for program in ("bash", "glint"):
            with tempfile.TemporaryDirectory(dir=folder) as place:
                try:
                    ends = way(place)
                except OSError as error:
                    if way is not through_terminals:
                        raise
                    print(f"skipped  {way.__name__}, {program}: no terminal can be opened: {error}")
                    continue
                yield f"{way.__name__}, {program}", converse(program, CHAIN, ends, frames, targets)
    for program in ("bash", "glint"):
        yield f"gzip, {program}", converse(program, CHAIN, through_pipes(None), frames, targets, packer())


def sinks(frames, folder):
    """Scores, which are lines too; their truth waits as well."""
    cells = CHAIN.rpartition(" | ")[0]
    truth = os.path.join(folder, "truth.jsonl")
    with open(truth, "wb") as out:
        out.write(run(["glint", "-c", cells + " | glint-noise-none"], b"".join(frames)))
    text = f"{CHAIN} | glint-score --truth {truth}"
    seen, expected = 0, []
    for count in range(1, len(frames) + 1):
        lines = run(["glint", "-c", text.replace("glint-score", "glint-score --partial")],
                    b"".join(frames[:count])).splitlines()
        expected.append(lines[seen:])
        seen = len(lines)
    for program in ("bash", "glint"):
        yield f"glint-score, {program}", converse(program, text, through_pipes(None), frames, expected)


def late_truth(frames, folder):
    """Scores of frames that are there come out while the truth of the next one is awaited."""
    targets = run(["glint", "-c", CHAIN], b"".join(frames))
    path, fifo = os.path.join(folder, "list.jsonl"), os.path.join(folder, "truth")
    with open(path, "wb") as out:
        out.write(targets)
    os.mkfifo(fifo)
    scores = [[line] for line in run(["glint-score", "--truth", path, path]).splitlines()]
    read = os.open(fifo, os.O_RDONLY | os.O_NONBLOCK)
    write = os.open(fifo, os.O_WRONLY)
    out_read, out_write = os.pipe()
    yield "late truth", converse("bash", f"exec glint-score --truth {fifo} {path}", (read, out_write, write, out_read),
                                 targets.splitlines(True), scores)


def simulator():
    shown = [run([sys.executable, f"{ROOT}/pipelines/live.py", *program]) for program in ([], ["glint"])]
    speed_mps, gap_m = (float(shown[0].split()[at]) for at in (-4, -2))
    good = shown[0] == shown[1] and 20 < speed_mps < 21 and 30 < gap_m < 40
    yield "pipelines/live.py", None if good else f"ends with {shown[0].splitlines()[-1]} in bash"


def simulator_of_a_broken_radar(folder):
    """A stage in the middle that cannot start, dies after some frames, or is killed: the simulator ends as it does."""
    os.makedirs(f"{folder}/sensors")
    with open(f"{folder}/sensors/lrr77-every-frame.json", "w", encoding="utf-8") as suite:
        suite.write("{}")
    bad_suite, path = {"GLINT_DATA": folder}, {"PATH": folder + os.pathsep + os.environ["PATH"]}
    sensor, real = os.path.join(folder, "glint-sensor"), shutil.which("glint-sensor")
    for name, program, script, environment, code, message in (
            ("a bad suite", [], None, bad_suite, 78, f"glint-ideal: {folder}/sensors/"),
            ("a bad suite, glint", ["glint"], None, bad_suite, 78, f"glint-ideal: {folder}/sensors/"),
            ("a stage that fails", [], f"sed -u 5q | {real}; echo mine: no more >&2; exit 65", path, 65, "mine: no more"),
            ("a stage that is killed", [], "read -r; kill -9 $$", path, None, "")):
        if script:
            with open(sensor, "w", encoding="utf-8") as file:
                file.write("#!/bin/bash\n" + script + "\n")
            os.chmod(sensor, 0o755)
        try:
            done = subprocess.run([sys.executable, f"{ROOT}/pipelines/live.py", *program], capture_output=True, text=True,
                                  env={**os.environ, **environment}, timeout=PATIENCE_S, check=False)
            good = (done.returncode == code if code else done.returncode > 0) and message in done.stderr
            fault = None if good and "Traceback" not in done.stderr else f"exit {done.returncode}: {done.stderr[-300:]}"
        except subprocess.TimeoutExpired:
            fault = "hangs"
        yield f"pipelines/live.py, {name}", fault


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    os.environ["PATH"] = os.path.abspath(sys.argv[1]) + os.pathsep + os.environ["PATH"]
    os.environ["GLINT_DATA"] = ROOT + "/data"
    frames = run(["glint-traffic", "cut-in"]).splitlines(True)[:FRAMES]
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        for checks in (ways(frames, folder), sinks(frames[:8], folder), late_truth(frames, folder), simulator(),
                       simulator_of_a_broken_radar(folder)):
            for name, fault in checks:
                print(f"{name}: {fault or 'no frame waits'}")
                faults += fault is not None
    sys.exit(1 if faults else 0)


main()
