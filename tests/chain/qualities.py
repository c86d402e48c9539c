"""Deviations and existence as schemas/README.md has them: each figure lies in the interval that the page prints.

Usage: python3 tests/chain/qualities.py BIN_DIR
"""
import os
import re
import sys

sys.dont_write_bytecode = True
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path[:0] = [os.path.join(ROOT, "tests", "tools", "accuracy"), os.path.join(ROOT, "scripts")]
import existence  # noqa: E402
import normalised_errors as errors  # noqa: E402

FIGURE = re.compile(r"([0-9.e+]+) \(([0-9.e+-]+) to ([0-9.e+-]+)\)")
SCENES = 20


def rows_of(text):
    """The cells behind the first one of each row of Markdown, by the first one."""
    cells = [[cell.strip() for cell in line.strip("| \n").split("|")] for line in text if line.startswith("| `")]
    return {first: rest for first, *rest in cells}


def compare(row, printed):
    """What differs between a fresh row and that of the page."""
    [(name, cells)] = rows_of([row]).items()
    if name not in printed:
        return [f"{name}: no row of the page"]
    differing = []
    for cell, old in zip(cells, printed[name]):
        fresh, page = FIGURE.search(cell), FIGURE.search(old)
        if page and not (fresh and float(page[2]) <= float(fresh[1]) <= float(page[3])):
            differing.append(f"{name}: {cell}, the page has {old}")
    return differing


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    existence.GLINT = errors.GLINT = os.path.join(os.path.abspath(sys.argv[1]), "glint")
    with open(os.path.join(ROOT, "schemas", "README.md"), encoding="utf-8") as page:
        printed = rows_of(page)
    source, suites = errors.source_of(SCENES), errors.SUITES.split(",")
    rows = [errors.row(suite, errors.scenes_of(source, suite, errors.CELLS)) for suite in suites]
    rows += existence.rows_of(existence.SUITES.split(","))[0]
    differing = [line for row in rows for line in compare(row, printed)]
    print(*differing, f"{len(rows)} rows as the page has them", sep="\n")
    sys.exit(bool(differing))


if __name__ == "__main__":
    main()
