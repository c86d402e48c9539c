"""The sets of urban.json and urban-mini.json of data/sets, made in full, are those that their page publishes, with the same scores
of the tracker.

Usage: python3 tests/chain/dataset_urban.py BIN_DIR
"""
import os
import re
import shlex
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import dataset as sets  # noqa: E402

SCORES = ("scripts/tracker {lines} | glint-score-tracks --tracks - {lines} --text")


def words(text):
    """Lines as words, so that a page may align them as it likes."""
    return [line.split() for line in text.splitlines()]


def made(folder, name, published):
    """The folder of a set, made by its plan, whose digest the page has."""
    place = os.path.join(folder, name)
    for command in ([sets.DATASET, f"data/sets/{name}.json", "--out", place], ["make", "-s", "-C", place, "-j2"]):
        done = sets.run(command, cwd=sets.ROOT)
        assert done.returncode == 0, done.stdout
    found = sets.manifest(place)["content_hash"]
    assert found in published, f"data/sets/README.md publishes another {name}; this has {found}"
    print(f"{name}: {found}")
    return place


def main():
    sets.use(sys.argv[1])
    with open(sets.PAGE, encoding="utf-8") as page:
        published = page.read()
    with tempfile.TemporaryDirectory() as folder:
        made(folder, "urban-mini", published)
        place = made(folder, "urban", published)
        lines = os.path.join(folder, "test.jsonl.zst")
        scores = SCORES.format(lines=shlex.quote(lines))
        done = sets.run(["bash", "-e", "-o", "pipefail", "-c",
                         f"cat {shlex.quote(place)}/test/*/*.jsonl.zst > {shlex.quote(lines)}; {scores}"], cwd=sets.ROOT)
        assert done.returncode == 0, done.stdout
        shown = re.search(r"--text\n\n((?:    .*\n)+)", published)[1]
        wrong = [line for line in words(shown) if line not in words(done.stdout)]
        assert not wrong, f"data/sets/README.md shows other scores than these: {' '.join(wrong[0])}\n{done.stdout}"
    print("the tracker has the page's scores")


main()
