"""How many detections with a probability of existence are echoes, by scene, as rows of data/accuracy/quality.txt.

    python3 tests/tools/accuracy/existence.py [--suites lrr77-full,radarscenes77-full] [--signal]

A detection is an echo if its label is any but a false alarm's: of an object, a ghost, clutter. Each cell has the mean
of the probabilities that are told, and the share of echoes with its 95 % interval: Wilson's, of as many independent
detections as vary alike from block to block of 20 frames. With --signal the targets are those of glint-sensor-signal.
"""
import argparse
import json
import math
import os
import subprocess
import sys

sys.dont_write_bytecode = True
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..")
sys.path.append(os.path.join(ROOT, "scripts"))
from glint.progress import Progress, say  # noqa: E402

GLINT = os.path.join(ROOT, os.environ.get("BUILD", "build"), "bin", "glint")
SUITES = "lrr77-full,radarscenes77-full,array77,srr24-signal"
SCENES = {
    "intersection": "intersection", "rush hour": "rush-hour --scenes 0:2", "motorway": "motorway",
    "highway": "highway-straight", "sparse": "random --density sparse --frames 1500",
    "medium": "random --density medium --frames 1000", "dense": "random --density dense --frames 500",
}
EDGES = (0.2, 0.8)
BLOCK = 20  # frames
CELLS, SIGNAL = "glint-sensor | glint-noise", "glint-sensor-signal"


def blocks_of(suite, scene, chain):
    """Pairs of a probability and whether it is an echo, by block; the number of scans."""
    traffic = "glint-traffic-" + scene if scene.startswith("random") else "glint-traffic " + scene
    text = f"{traffic} | glint-extract | glint-ideal --sensors {suite} --sections quality | {chain}"
    done = subprocess.run([GLINT, "-c", text], check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, cwd=ROOT)
    blocks, scans = {}, 0
    for number, frame in enumerate(map(json.loads, done.stdout.splitlines())):
        scans += sum(view["measured"] for view in frame["sensors"]["list"])
        blocks.setdefault(number // BLOCK, []).extend(
            (one["quality"]["existence"], one["contributors"][0]["path"] != "false_alarm") for one in frame["targets"])
    return list(blocks.values()), scans


def interval(found, counts):
    """Wilson's 95 % interval of a share, by numbers found and of all in each block."""
    total, share = sum(counts), sum(found) / sum(counts)
    spread = sum((one - share * count) ** 2 for one, count in zip(found, counts))
    alike = total / max(1, spread / (total * share * (1 - share)) if 0 < share < 1 else 1)
    z2 = 1.96 ** 2
    middle = (share + z2 / 2 / alike) / (1 + z2 / alike)
    half = 1.96 * math.sqrt(share * (1 - share) / alike + z2 / 4 / alike ** 2) / (1 + z2 / alike)
    return middle - half, middle + half


def cell(blocks, low, high):
    """The column of probabilities from low to high: its text, and whether what is told is in the interval."""
    own = [[pair for pair in block if low <= pair[0] < high] for block in blocks]
    own = [block for block in own if block]
    counts = [len(block) for block in own]
    if not counts:
        return "-", None
    told = sum(sum(probability for probability, _ in block) for block in own) / sum(counts)
    found = [sum(echo for _, echo in block) for block in own]
    least, most = interval(found, counts)
    text = f"{told:.3f}: {sum(found) / sum(counts):.3f} ({least:.3f} to {most:.3f})"
    return text, least - 0.0005 <= told <= most + 0.0005


def rows_of(suites, chain=CELLS):
    """Rows of Markdown, and of each cell whether what is told is in the interval of the share."""
    edges = (0, *EDGES, math.inf)
    rows, held = [], []
    for suite, name in Progress("rows").over([(suite, name) for suite in suites for name in SCENES]):
        blocks, scans = blocks_of(suite, SCENES[name], chain)
        cells = [cell(blocks, low, high) for low, high in zip(edges, edges[1:])]
        held += [inside for _, inside in cells if inside is not None]
        echoes = sum(echo for block in blocks for _, echo in block) / scans
        rows.append(f"| `{suite}`, {name} | {echoes:.2f} | " + " | ".join(text for text, _ in cells) + " |")
    return rows, held


def main():
    asked = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    asked.add_argument("--suites", default=SUITES, help="names of suites with commas")
    asked.add_argument("--signal", action="store_true", help="by the signal; for suites with a waveform")
    asked = asked.parse_args()
    rows, held = rows_of(asked.suites.split(","), SIGNAL if asked.signal else CELLS)
    heads = ["suite, scene", "echoes a scan", f"below {EDGES[0]}", f"to {EDGES[1]}", "above"]
    say("| " + " | ".join(heads) + " |\n" + "|---" * len(heads) + "|")
    for row in rows:
        say(row)
    say(f"\nWhat is told is in the interval in {sum(held)} of {len(held)} cells.")


if __name__ == "__main__":
    main()
