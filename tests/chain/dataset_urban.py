"""The set of data/sets/urban.json, made in full, is the one that its page publishes, with the same scores of the tracker.

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

PLAN = os.path.join(sets.ROOT, "data", "sets", "urban.json")
SCORES = ("scripts/tracker {lines} | glint-score-tracks --tracks - {lines} --text")


def words(text):
    """Lines as words, so that a page may align them as it likes."""
    return [line.split() for line in text.splitlines()]


def main():
    sets.use(sys.argv[1])
    with open(sets.PAGE, encoding="utf-8") as page:
        published = page.read()
    with tempfile.TemporaryDirectory() as folder:
        place = os.path.join(folder, "urban")
        for command in ([sets.DATASET, PLAN, "--out", place], ["make", "-s", "-C", place, "-j2"]):
            done = sets.run(command)
            assert done.returncode == 0, done.stdout
        found = sets.manifest(place)["content_hash"]
        assert found in published, f"data/sets/README.md publishes another set; this has {found}"
        lines = os.path.join(folder, "test.jsonl.zst")
        scores = SCORES.format(lines=shlex.quote(lines))
        done = sets.run(["bash", "-e", "-o", "pipefail", "-c",
                         f"cat {shlex.quote(place)}/test/*/*.jsonl.zst > {shlex.quote(lines)}; {scores}"], cwd=sets.ROOT)
        assert done.returncode == 0, done.stdout
        shown = re.search(r"--text\n\n((?:    .*\n)+)", published)[1]
        wrong = [line for line in words(shown) if line not in words(done.stdout)]
        assert not wrong, f"data/sets/README.md shows other scores than these: {' '.join(wrong[0])}\n{done.stdout}"
    print(f"urban: {found}, and the page's scores")


main()
