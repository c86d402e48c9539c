"""The command line of a program: its name, and --help, which prints the text at its head. A wrong line ends it with 64
and a message.

A program is called scripts/NAME in the source tree, and glint-NAME where it is installed.
"""
import os
import re
import sys

USAGE, IO = 64, 74


def name():
    return os.path.basename(sys.argv[0])


def as_called(text):
    """The text with programs named as they are called here."""
    return re.sub(r"\bscripts/", "glint-", text) if name().startswith("glint-") else text


def check(text, good):
    """text is the one at the program's head; good says whether the words after its name are a command line of it."""
    words = sys.argv[1:]
    if words[:1] in (["-h"], ["--help"]):
        try:
            os.write(1, (as_called(text).strip() + "\n").encode())
        except OSError as error:
            print(f"{name()}: {error.strerror}", file=sys.stderr)
            sys.exit(IO)
        sys.exit()
    if not good:
        print(f"{name()}: unknown command line: {' '.join(words) or '(empty)'}; see --help", file=sys.stderr)
        sys.exit(USAGE)
