"""Files that are whole and on the disk, or not there."""
import contextlib
import fcntl
import hashlib
import json
import os
import re
import shutil
import socket

TEMPORARY = ".tmp"
CHUNK = 1 << 20
HOST = socket.gethostname().replace(".", "-")


def sync_folder(folder):
    """Brings the names of a folder to the disk."""
    descriptor = os.open(folder or ".", os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def make_folder(folder):
    """The folder and those above it, each with its name on the disk."""
    if not os.path.isdir(folder):
        above = os.path.dirname(os.path.abspath(folder))
        make_folder(above)
        with contextlib.suppress(FileExistsError):
            os.mkdir(folder)
        sync_folder(above)


def began(process):
    """When a process of this host began, in ticks since the boot, where the system tells it; else 0, and where only its
    exit status is left. Numbers of processes come again; together with this they do not."""
    try:
        with open(f"/proc/{process}/stat", "rb") as stat:
            state, *numbers = stat.read().rsplit(b") ", 1)[1].split()
    except OSError:
        return 0
    return 0 if state in b"ZX" else int(numbers[18])


def temporary_name(path, work):
    """A name in the folder `work` that no other process of any host takes."""
    maker = f"{HOST}.{os.getpid()}-{began(os.getpid())}"
    return os.path.join(work, f"{os.path.basename(path)}.{maker}{TEMPORARY}")


@contextlib.contextmanager
def temporary_folder(path, work):
    """A folder for files that get their names elsewhere."""
    temporary = temporary_name(path, work)
    os.mkdir(temporary)
    try:
        yield temporary
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


@contextlib.contextmanager
def whole_file(path, work):
    """A binary file that gets its name when the block ends well, and vanishes when it does not.

    Until then it lies in the folder `work` of the same file system, under a name that holds host and process: two
    processes that make one file never write into each other's, and the later one replaces a file of the same bytes.
    """
    temporary = temporary_name(path, work)
    try:
        with open(temporary, "wb") as file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        os.rename(temporary, path)
        sync_folder(os.path.dirname(path))
    except BaseException:
        with contextlib.suppress(OSError):
            os.remove(temporary)
        raise


def write_whole(path, work, text):
    with whole_file(path, work) as file:
        file.write(text.encode(errors="surrogateescape"))  # paths may have bytes that are no UTF-8


@contextlib.contextmanager
def alone(work):
    """While the block runs, no other process is in such a block of this folder, where the file system has locks."""
    with open(os.path.join(work, "lock"), "ab") as lock:
        with contextlib.suppress(OSError):
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def running(process, since):
    """Is there a process of that number on this host that began then?"""
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        pass
    return began(process) == since


def remove_temporaries(work, of_all=False):
    """Removes what killed processes of this host left in a folder, and on request what those of other hosts did."""
    for name in os.listdir(work):
        maker = re.fullmatch(rf".*\.([^.]+)\.(\d+)-(\d+){re.escape(TEMPORARY)}", name, re.DOTALL)
        if maker and (not running(int(maker[2]), int(maker[3])) if maker[1] == HOST else of_all):
            path = os.path.join(work, name)
            shutil.rmtree(path, ignore_errors=True)
            with contextlib.suppress(FileNotFoundError):
                os.remove(path)


def digest_of(data):
    return "sha256:" + hashlib.sha256(data).hexdigest()


def digest_of_file(path):
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while chunk := file.read(CHUNK):
            digest.update(chunk)
    return "sha256:" + digest.hexdigest()


def canonical(value):
    """A text of JSON that depends on the value alone."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
