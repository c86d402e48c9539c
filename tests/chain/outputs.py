"""A file that -o names is the old one or the new one, whole, and nothing else is left beside it.

Usage: python3 tests/chain/outputs.py BIN_DIR

On file systems with and without files without names (O_TMPFILE, which NFS lacks): a filter refuses the system's calls.
Runs that are killed, disks that are full, files of several names, of other users, and mounted by themselves.
"""
import ctypes
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "tests", "support"))
import signals  # noqa: E402

PATIENCE_S = 300
NUMBERS = {"x86_64": (257, 436), "aarch64": (56, 436)}.get(os.uname().machine)  # of openat and close_range
O_TMPFILE, EOPNOTSUPP, ENOSYS = 0o20000000, 95, 38
NOBODY = 65534
LIST = "glint-extract | glint-ideal --sensors corner77 | glint-sensor | glint-noise"


def refuse_calls():
    """From here on this process and those that it starts have no O_TMPFILE and no close_range."""
    openat, close_range = NUMBERS
    load, equal, any_bit, end = 0x20, 0x15, 0x45, 0x06
    rules = [(load, 0, 0, 0), (equal, 0, 1, close_range), (end, 0, 0, 0x50000 | ENOSYS), (equal, 0, 3, openat),
             (load, 0, 0, 32), (any_bit, 0, 1, O_TMPFILE), (end, 0, 0, 0x50000 | EOPNOTSUPP), (end, 0, 0, 0x7fff0000)]
    program = ctypes.create_string_buffer(b"".join(struct.pack("HBBI", *rule) for rule in rules))
    libc = ctypes.CDLL(None, use_errno=True)
    libc.prctl(38, 1, 0, 0, 0)
    head = ctypes.create_string_buffer(struct.pack("HxxxxxxP", len(rules), ctypes.addressof(program)))
    if libc.prctl(22, 2, head, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "no filter of system calls")


def nothing():
    """All calls are allowed."""


class Place:
    """A folder whose old file is "old", and runs in it."""

    def __init__(self, folder, before):
        self.folder, self.before = folder, before
        self.file = os.path.join(folder, "out")
        self.put("out", b"old")

    def put(self, name, content):
        with open(os.path.join(self.folder, name), "wb") as file:
            file.write(content)

    def start(self, text, **options):
        before = options.pop("before", self.before)
        return subprocess.Popen(["bash", "-c", text], cwd=self.folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, preexec_fn=before, **options)

    def run(self, text, data=b"", **options):
        """Exit code and messages."""
        process = self.start(text, **options)
        try:
            messages = process.communicate(data, timeout=PATIENCE_S)[1].decode()
        except subprocess.TimeoutExpired:
            process.kill()
            return "never ends", ""
        return process.returncode, messages

    def content(self, name="out"):
        try:
            with open(os.path.join(self.folder, name), "rb") as file:
                return file.read()
        except FileNotFoundError:
            return b"none"

    def names(self):
        return sorted(os.listdir(self.folder))


def expect(what, found, due):
    return None if found == due else f"{what}: {str(found)[:200]} instead of {str(due)[:200]}"


def first_fault(*faults):
    return next((fault for fault in faults if fault), None)


def outputs_end(place, frames):
    """One output, several outputs and outputs beside each other."""
    os.mkdir(os.path.join(place.folder, "tables"))
    whole = subprocess.run(["bash", "-c", LIST], input=frames, capture_output=True, check=True).stdout
    ended = [place.run(text, frames) for text in (
        f"{LIST} -o out", f"glint -c '{LIST} | glint-tables tables'", f"{LIST} | glint-summary --copy copy -o counts")]
    return first_fault(expect("runs", ended, [(0, "")] * 3), expect("out", place.content(), whole),
                       expect("the copy", place.content("copy"), whole),
                       expect("folder", place.names(), ["copy", "counts", "out", "tables"]))


def begin(place, frames):
    """A run that has read some frames and waits for more."""
    process = place.start("exec glint-extract -o out", bufsize=0)
    process.stdin.write(frames)
    while not waits(process.pid):
        time.sleep(0.01)
    return process


def waits(process):
    """Does the run wait for input that is not there, with its output open?"""
    with open(f"/proc/{process}/stat", encoding="utf-8") as stat, open(f"/proc/{process}/cmdline", "rb") as words:
        return stat.read().rsplit(") ", 1)[1][0] == "S" and words.read().startswith(b"glint-extract")


def kills(place, frames):
    """Signals, then SIGKILL beside a run that goes on; a second name of the old file keeps its bytes."""
    os.link(place.file, os.path.join(place.folder, "twin"))
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGKILL):
        process = begin(place, frames)
        process.send_signal(number)
        process.communicate(timeout=PATIENCE_S)
        hidden = [name for name in place.names() if name.startswith(".")]
        due = [f".glint-{process.pid}-1@{os.uname().nodename}"]
        if process.returncode != -number or place.content() != b"old" or place.content("twin") != b"old":
            return f"{number.name}: exit {process.returncode}, {place.content()[:50]}"
        if hidden and hidden != due:
            return f"{number.name} leaves {hidden}"
    running = begin(place, frames)
    again = place.run("glint-extract -o out", frames)
    temporaries = [name for name in place.names() if name.startswith(".") and f"-{running.pid}-" not in name]
    place.put("out", b"old")
    running.communicate(timeout=PATIENCE_S)
    return first_fault(expect("left after the next run", temporaries, []), expect("the next run", again, (0, "")),
                       expect("the run that went on", running.returncode, 0),
                       expect("its lines", place.content().count(b"\n"), frames.count(b"\n")),
                       expect("folder", place.names(), ["out", "twin"]), expect("twin", place.content("twin"), b"old"))


def full_disk(place, frames):
    """The shell's limit on files stands for a disk: the old file fits, with all of its names, the new one does not."""
    old = b"x" * 1024
    place.put("out", old)
    os.link(place.file, os.path.join(place.folder, "twin"))
    code, messages = place.run("trap '' XFSZ; ulimit -f 1; exec glint-extract -o out", frames)
    return first_fault(expect("exit", (code, "File too large" in messages), (74, True)),
                       expect("out", place.content() == old, True), expect("twin", place.content("twin") == old, True),
                       expect("folder", place.names(), ["out", "twin"]))


def full_tmpfs(place, frames):
    """A disk that the new file fills to two thirds, and one that it does not fit on."""
    frames *= 20
    size = len(subprocess.run(["glint-extract"], input=frames, capture_output=True, check=True).stdout)
    for room, code, due in (size * 3 // 2, 0, f"{size} out\n3 twin\n"), (size // 2, 74, "3 out\n3 twin\n"):
        script = (f"mount -t tmpfs -o size={room} none . && cd \"$PWD\" && echo -n old >out && ln out twin && "
                  "glint-extract -o out 2>&1; code=$?; stat -c \"%s %n\" * >&2; ls -A | wc -l >&2; exit $code")
        fault = expect(f"{room} bytes", place.run(f"unshare -m bash -c '{script}'", frames), (code, due + "2\n"))
        if fault:
            return fault
    return None


def mounted_alone(place, _):
    """Refused before the first frame is read: standard input stays open."""
    process = place.start("unshare -m bash -c 'mount --bind out out && exec glint-extract -o out'")
    return refused(place, process, "Device or resource busy")


def refused(place, process, why):
    try:
        code = process.wait(timeout=PATIENCE_S)
    except subprocess.TimeoutExpired:
        process.kill()
        return "is not refused before it reads"
    message = process.stderr.read().decode()
    due = f"glint-extract: out: {why}; no new file can take the place of this one: name another one, or let the shell " \
          "write into it (>)\n"
    return first_fault(expect("refused", (code, message), (73, due)), expect("out", place.content(), b"old"),
                       expect("folder", place.names(), ["out"]))


def as_nobody(place):
    def become():
        os.setgid(NOBODY)
        os.setuid(NOBODY)
        place.before()
    return become


def another_user(place, frames):
    """Somebody else's file is replaced where the folder allows it, keeps its mode, and else is refused at once."""
    os.chmod(place.file, 0o666)
    for mode, why in (0o755, "Permission denied"), (0o1777, "Operation not permitted"):
        os.chmod(place.folder, mode)
        fault = refused(place, place.start("exec glint-extract -o out", before=as_nobody(place)), why)
        if fault:
            return f"folder of mode {mode:o}: {fault}"
    os.chmod(place.folder, 0o777)
    ended = place.run("exec glint-extract -o out", frames, before=as_nobody(place))
    status = os.stat(place.file)
    return first_fault(expect("run", ended, (0, "")), expect("owner", status.st_uid, NOBODY),
                       expect("mode", status.st_mode & 0o7777, 0o666),
                       expect("lines", place.content().count(b"\n"), frames.count(b"\n")))


def can(before):
    return subprocess.run(["true"], preexec_fn=before, check=False).returncode == 0


def checks():
    """Each check, by whether it needs root."""
    mounts = os.geteuid() == 0 and subprocess.run(["unshare", "-m", "true"], capture_output=True, check=False).returncode == 0
    yield from ((check, None) for check in (outputs_end, kills, full_disk))
    yield another_user, None if os.geteuid() == 0 else "it takes root"
    yield from ((check, None if mounts else "it takes root and mounts") for check in (full_tmpfs, mounted_alone))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    signals.as_on_a_terminal()
    os.environ["PATH"] = os.path.abspath(sys.argv[1]) + os.pathsep + os.environ["PATH"]
    os.environ["GLINT_DATA"] = ROOT + "/data"
    frames = subprocess.run(["glint-traffic", "two-vehicles"], capture_output=True, check=True).stdout
    frames = b"".join(frames.splitlines(True)[:8])
    faults = 0
    for name, before in ("as it is", nothing), ("without O_TMPFILE", refuse_calls):
        if before is refuse_calls and NUMBERS is None:
            print(f"skipped  outputs without O_TMPFILE: no filter for {os.uname().machine}")
            continue
        for check, missing in checks():
            if missing:
                print(f"skipped  {check.__name__}, {name}: {missing}")
                continue
            with tempfile.TemporaryDirectory(prefix="glint-outputs.") as folder:
                os.chmod(folder, 0o755)
                fault = check(Place(folder, before), frames)
            print(f"{check.__name__}, {name}: {fault or 'the old file or the new one, whole'}")
            faults += fault is not None
    sys.exit(1 if faults else 0)


main()
