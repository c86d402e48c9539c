"""Work in processes side by side."""
import os
import pickle
import signal
import struct
import sys
import tempfile

import glint
from glint.progress import Progress
from glint.sets.plan import BAD_DATA, IO, NO_INPUT, Fault

ERRORS = Fault, OSError, glint.BadFrame, struct.error, OverflowError, UnicodeError  # for which the input or the system is to blame


def fault_of(error):
    """What one of ERRORS says, with the code that a program ends with."""
    if isinstance(error, Fault):
        return error
    if not isinstance(error, OSError):
        return Fault(BAD_DATA, str(error))
    text = ": ".join(filter(None, (error.filename, error.strerror)))
    return Fault(NO_INPUT if isinstance(error, FileNotFoundError) else IO, text)


def begin(work, item, file):
    """Begins a process that writes what work(item) returns into a file, or code and text of its fault; the process."""
    if process := os.fork():
        return process
    code = 1
    try:
        try:
            told = work(item), None
        except ERRORS as error:
            fault = fault_of(error)
            told = None, (fault.code, str(fault))
        pickle.dump(told, file)
        file.flush()
        code = 0
    except Exception:  # a fault of this program, which says where it is
        sys.excepthook(*sys.exc_info())
    finally:
        os._exit(code)


def side_by_side(work, items, jobs):
    """work(item) of each item, as many at a time as jobs, each in a process of its own; a single item needs none. The first fault is
    raised when the items that were begun have ended."""
    if len(items) == 1:
        return [work(items[0])]
    files, running, results, faults = [tempfile.TemporaryFile() for _ in items], {}, {}, {}
    progress = Progress("parts", len(items))
    try:
        while running or len(results) < len(items) and not faults:
            number = len(results) + len(running)
            if number < len(items) and len(running) < jobs and not faults:
                running[begin(work, items[number], files[number])] = number
                continue
            process, status = os.wait()
            number = running.pop(process)
            files[number].seek(0)
            results[number], fault = (None, (IO, "its process was ended")) if status else pickle.load(files[number])
            if fault:
                faults[number] = Fault(*fault)
            progress.step()
    finally:
        progress.end()
        for process in running:
            os.kill(process, signal.SIGTERM)
            os.waitpid(process, 0)
    if faults:
        raise faults[min(faults)]
    return [results[number] for number in range(len(items))]
