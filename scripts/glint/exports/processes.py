"""Work in processes side by side."""
import contextlib
import os
import pickle
import select
import signal
import sys
import threading
import time

from glint.exports.faults import ERRORS, fault_of
from glint.progress import Progress
from glint.sets.plan import IO, Fault

LOOK_S = 0.5  # between two looks at whether the parent lives
MOST_JOBS = 256  # each has a pipe, and a process has 1,024 files at most


def answer_of(work, item):
    """What work(item) returns, or code and text of its fault; the other one is None."""
    try:
        return work(item), None
    except ERRORS as error:
        fault = fault_of(error)
        return None, (fault.code, str(fault))


def end_with(parent):
    """Ends this process as an interrupt does, once its parent has ended: a parent that was killed could not tell it."""
    while os.getppid() == parent:
        time.sleep(LOOK_S)
    signal.pthread_kill(threading.main_thread().ident, signal.SIGTERM)


def begin(work, item):
    """Begins a process that sends the answer for an item; the process, and the end of a pipe where its answer comes."""
    (end, own_end), parent = os.pipe(), os.getpid()
    if process := os.fork():
        os.close(own_end)
        return process, open(end, "rb")
    code = 1
    try:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # an interrupt is for the caller, which then ends this process by SIGTERM
        signal.signal(signal.SIGTERM, signal.default_int_handler)  # so that temporary files are removed
        threading.Thread(target=end_with, args=(parent,), daemon=True).start()
        with contextlib.suppress(BrokenPipeError), open(own_end, "wb") as file:  # who would take the answer may have been ended
            pickle.dump(answer_of(work, item), file)
        code = 0
    except Exception:  # a fault of this program, which says where it is
        sys.excepthook(*sys.exc_info())
    finally:
        os._exit(code)


def received(process, end):
    """The answer of a process, which then ends; a fault if the process was ended before."""
    with end, contextlib.suppress(EOFError, pickle.UnpicklingError):
        answer = pickle.load(end)
    status = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
    return (None, (IO, f"one of its processes ended with exit status {status}")) if status else answer


def end_after(running, number):
    """Ends the processes of items after the one of this number."""
    for end, (process, own) in [*running.items()]:
        if own > number:
            del running[end]
            os.kill(process, signal.SIGTERM)
            os.waitpid(process, 0)
            end.close()


def side_by_side(work, items, jobs):
    """work(item) of each item, as many at a time as jobs, each in a process of its own; a single item needs none. The fault that is
    raised is that of the first item that has one: items before it go on to their end, and those after it are ended."""
    if len(items) == 1:
        return [work(items[0])]
    waiting, running, answers, wrong = [*enumerate(items)], {}, {}, []
    progress = Progress("parts", len(items))
    try:
        while waiting or running:
            while waiting and len(running) < min(jobs, MOST_JOBS):
                number, item = waiting.pop(0)
                process, end = begin(work, item)
                running[end] = process, number
            for end in select.select([*running], [], [])[0]:
                process, number = running.pop(end)
                answers[number] = received(process, end)
                progress.step()
            if wrong := [number for number, (_, fault) in answers.items() if fault]:
                waiting.clear()
                end_after(running, min(wrong))
    finally:
        progress.end()
        end_after(running, -1)
    if wrong:
        raise Fault(*answers[min(wrong)][1])
    return [answers[number][0] for number in range(len(items))]
