"""The command line of a script: --help prints the text at its head, and a wrong line ends it with 64 and a message."""
import os
import sys

USAGE, IO = 64, 74


def check(text, good):
    """text is the one at the script's head; good says whether the words after its name are a command line of it."""
    name, words = os.path.basename(sys.argv[0]), sys.argv[1:]
    if words[:1] in (["-h"], ["--help"]):
        try:
            os.write(1, (text.strip() + "\n").encode())
        except OSError as error:
            print(f"{name}: {error.strerror}", file=sys.stderr)
            sys.exit(IO)
        sys.exit()
    if not good:
        print(f"{name}: unknown command line: {' '.join(words) or '(empty)'}; see --help", file=sys.stderr)
        sys.exit(USAGE)
