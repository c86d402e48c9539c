"""The command line of a program: its name, and --help, which prints the text at its head. A wrong line ends it with 64
and a message.

A program is called scripts/NAME in the source tree, and glint-NAME where it is installed.
"""
import argparse
import os
import re
import sys

USAGE, IO = 64, 74


def name():
    return os.path.basename(sys.argv[0])


def fail(code, text):
    """Ends the program with an exit code and a message."""
    print(f"{name()}: {text}", file=sys.stderr)
    sys.exit(code)


def run(main):
    """Calls the program's main function; who interrupts it gets the exit code of a shell."""
    try:
        main()
    except KeyboardInterrupt:
        sys.exit(130)


def as_called(text):
    """The text with programs named as they are called here."""
    return re.sub(r"\bscripts/", "glint-", text) if name().startswith("glint-") else text


def write_help(text):
    try:
        os.write(1, (as_called(text).strip() + "\n").encode())
    except OSError as error:
        fail(IO, error.strerror)


def check(text, good):
    """text is the one at the program's head; good says whether the words after its name are a command line of it."""
    words = sys.argv[1:]
    if words[:1] in (["-h"], ["--help"]):
        write_help(text)
        sys.exit()
    if not good:
        fail(USAGE, f"unknown command line: {' '.join(words) or '(empty)'}; see --help")


def parser(text, expected=""):
    """Reads options of the program with this text at its head; expected: what a message on a wrong line says of a right one."""
    made = argparse.ArgumentParser()
    made.print_help = lambda: write_help(text)
    made.error = lambda fault: fail(USAGE, f"{fault}; {expected}see --help")
    return made
