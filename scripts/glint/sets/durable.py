"""Files that are whole and on the disk, or not there."""
import contextlib
import fcntl
import hashlib
import json
import os
import re
import shutil

from glint.sets.plan import CANNOT_CREATE, Fault

TEMPORARY = ".tmp"
MACHINE = os.uname().nodename.replace(".", "-")
with contextlib.suppress(OSError), open("/proc/sys/kernel/random/boot_id", encoding="ascii") as boot:
    MACHINE = boot.read().strip()  # containers of one machine share it, whatever their host names


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


def create(path, work, folder=False):
    """A new file or folder in the folder `work` under a name that no other process takes, and its open descriptor. The
    descriptor's lock says that its maker lives, to other containers and machines too where the file system has locks."""
    while True:
        temporary = os.path.join(work, f"{os.path.basename(path)[:40]}.{MACHINE}.{os.urandom(8).hex()}{TEMPORARY}")
        os.mkdir(temporary) if folder else open(temporary, "xb").close()
        with contextlib.suppress(FileNotFoundError):  # another process removed it before it was locked
            descriptor = os.open(temporary, os.O_RDONLY if folder else os.O_WRONLY)
            with contextlib.suppress(OSError):
                fcntl.flock(descriptor, fcntl.LOCK_EX)
            if os.path.exists(temporary):
                return temporary, descriptor
            os.close(descriptor)


@contextlib.contextmanager
def temporary_folder(path, work):
    """A folder for files that get their names elsewhere."""
    temporary, descriptor = create(path, work, folder=True)
    try:
        yield temporary
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
        os.close(descriptor)


@contextlib.contextmanager
def new_folder(path, option):
    """A folder that gets its name when the block ends well, and vanishes when it does not. It is the value of an option."""
    above, name = os.path.split(os.path.abspath(path))
    if not path or os.path.lexists(path) or not os.access(above, os.W_OK) or len(os.fsencode(name)) > 255:
        raise Fault(CANNOT_CREATE, f"{option} {path!r}: is there already, or cannot be made; expected a new folder in one that is there")
    remove_temporaries(above)
    with temporary_folder(path, above) as folder:
        yield folder
        os.rename(folder, path)


@contextlib.contextmanager
def whole_file(path, work):
    """A binary file that gets its name when the block ends well, and vanishes when it does not.

    Until then it lies in the folder `work` of the same file system, under a name of its own: two processes that make
    one file never write into each other's, and the later one replaces a file of the same bytes.
    """
    temporary, descriptor = create(path, work)
    try:
        with open(temporary, "wb", opener=lambda *_: descriptor) as file:
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


def remove_if_left(path):
    """Removes a file or folder, unless the process that made it still runs and holds its lock, or the file system has no locks."""
    with contextlib.suppress(OSError):
        descriptor = os.open(path, os.O_RDONLY if os.path.isdir(path) else os.O_RDWR)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)
        finally:
            os.close(descriptor)


def remove_temporaries(work, of_all=False):
    """Removes what killed processes of this machine left in a folder, and on request what those of other machines did."""
    for name in os.listdir(work):
        maker = re.fullmatch(rf".*\.([^.]+)\.[^.]+{re.escape(TEMPORARY)}", name, re.DOTALL)
        if maker and (of_all or maker[1] == MACHINE):
            remove_if_left(os.path.join(work, name))


def digest_of(data):
    return "sha256:" + hashlib.sha256(data).hexdigest()


def digest_of_file(path):
    with open(path, "rb") as file:
        return "sha256:" + hashlib.file_digest(file, "sha256").hexdigest()


def digest_of_folder(folder):
    """One digest of all names below a folder, of the bytes of files and of where links lead."""
    names = sorted(os.path.join(place, name) for place, folders, files in os.walk(folder) for name in folders + files)
    found = (os.readlink(path) if os.path.islink(path) else os.path.isfile(path) and digest_of_file(path) for path in names)
    return digest_of("".join(f"{path[len(folder):]} {one}\n" for path, one in zip(names, found)).encode(errors="surrogateescape"))


def has_its_digest(folder):
    """Is a folder as it was when its digest was written into the file of its name with .sha256?"""
    with contextlib.suppress(OSError), open(folder + ".sha256", "rb") as file:
        return file.read().strip() == digest_of_folder(folder).encode()
    return False


def canonical(value):
    """A text of JSON that depends on the value alone."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
