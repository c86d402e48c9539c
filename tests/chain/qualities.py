"""Each figure of deviations and existence lies in its interval in data/accuracy/quality.txt; schemas/README.md has such rows.

Usage: python3 tests/chain/qualities.py BIN_DIR
"""
import pathlib
import re
import sys

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/tools/accuracy"), str(ROOT / "scripts")]
import existence  # noqa: E402
import normalised_errors as errors  # noqa: E402

FIGURE = re.compile(r"([0-9.e+]+) \(([0-9.e+-]+) to ([0-9.e+-]+)\)")


def rows_of(text):
    """The cells behind the first one of each row of Markdown, by the first one."""
    cells = [[cell.strip() for cell in line.strip("| \n").split("|")] for line in text if line.startswith("| `")]
    return {first: rest for first, *rest in cells}


def compare(row, recorded):
    """What differs between a fresh row and that of the record."""
    [(name, cells)] = rows_of([row]).items()
    if name not in recorded:
        return [f"{name}: no row of the record"]
    differing = []
    for cell, old in zip(cells, recorded[name]):
        fresh, told = FIGURE.search(cell), FIGURE.search(old)
        if told and not (fresh and float(told[2]) <= float(fresh[1]) <= float(told[3])):
            differing.append(f"{name}: {cell}, the record has {old}")
    return differing


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    existence.GLINT = errors.GLINT = str(pathlib.Path(sys.argv[1]).resolve() / "glint")
    recorded, shown = (rows_of((ROOT / name).read_text(encoding="utf-8").splitlines())
                       for name in ("data/accuracy/quality.txt", "schemas/README.md"))
    source, suites = errors.source_of(20), errors.SUITES.split(",")
    rows = [errors.row(suite, errors.scenes_of(source, suite, errors.CELLS)) for suite in suites]
    rows += existence.rows_of(existence.SUITES.split(","))[0]
    differing = [line for row in rows for line in compare(row, recorded)]
    differing += [f"{name}: schemas/README.md has another row" for name, cells in recorded.items() if shown.get(name, cells) != cells]
    print(*differing, f"{len(rows)} rows as the record has them", sep="\n")
    sys.exit(bool(differing))


if __name__ == "__main__":
    main()
