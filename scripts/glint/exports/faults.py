"""Faults for which the input or the system is to blame, and their message."""
import contextlib
import struct

import glint
from glint import command_line
from glint.sets.plan import BAD_DATA, IO, NO_INPUT, Fault

ERRORS = Fault, OSError, glint.BadFrame, struct.error, OverflowError, UnicodeError


def fault_of(error):
    """What one of ERRORS says, with the code that a program ends with."""
    if isinstance(error, Fault):
        return error
    if not isinstance(error, OSError):
        return Fault(BAD_DATA, str(error))
    text = ": ".join(filter(None, (error.filename, error.strerror)))
    return Fault(NO_INPUT if isinstance(error, FileNotFoundError) else IO, text)


@contextlib.contextmanager
def told():
    """Ends the program with the message of a fault in the block."""
    try:
        yield
    except ERRORS as error:
        fault = fault_of(error)
        command_line.fail(fault.code, fault)
