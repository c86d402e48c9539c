"""Range migration (MODEL 14.20): the fast sensors against the integral and against the signal.

Usage: python3 tests/oracle/effects_walk.py BIN_DIR

Exit status 1 if any check fails. The signal is left out, with a message, if the build has no such stage.
"""

import cmath
import math
import sys

sys.dont_write_bytecode = True
import model  # noqa: E402
from effects_noise import QUIET  # noqa: E402
from effects_reception import run as chain  # noqa: E402
from model import ego, sensor, suite_of, thing  # noqa: E402

CELL_M, CELL_MPS, CARRIER_HZ = 0.15, 0.028, 76.5e9
DWELL_S = 299792458 / CARRIER_HZ / (2 * CELL_MPS)
PLAIN = "glint-sensor | glint-noise-none"
SIGNAL = "glint-sensor-signal"
SMEAR = "glint-sensor-smear | glint-noise-none"
WALKS = range(11)
WINDOWS = ("hann", "rectangular")


def radar(window, **changes):
    """A radar of 70 ms and cells of 0.15 m, to which a post at 5 m is 80 dB above the threshold."""
    shape = {"kind": "chirp", "samples": 64, "repetitions": 256, "window": window, "cfar_cells": 64,
             "cfar_rank": 48}
    return sensor("radar", **{**QUIET, "carrier_hz": CARRIER_HZ, "calibration_ercs": 0.3, "calibration_range_m": 500,
                              "range_max_m": 64 * CELL_M, "cell_range_m": CELL_M, "cell_range_rate_mps": CELL_MPS,
                              "phase_reference": "centre", "angle_estimator": "ratio", "waveform": shape,
                              "range_migration": window, **changes})


def scene(cells, places, ego_mps=0.0):
    """Posts at these places, in cells from 5 m on, which walk so many cells beside an ego of this speed."""
    rate = cells * CELL_M / DWELL_S
    posts = [thing(f"post{n}", "post", 5 + place * CELL_M, 0, velocity=(rate + ego_mps, 0.0))
             for n, place in enumerate(places)]
    return model.frame([ego(velocity=(ego_mps, 0.0)), *posts])


def numbered(frames):
    return [dict(one, frame=i, last=i + 1 == len(frames)) for i, one in enumerate(frames)]


def run(bench, frames, sensors, stages):
    path = bench.write_suite(suite_of(*sensors))
    return chain(bench, f"glint-extract | glint-ideal --sensors {path} --sections account --effects all | {stages}", frames)


def strongest_db(frame):
    return max(one["amplitude_db"] for one in frame["targets"])


# ---- one echo ---------------------------------------------------------------------------------


def transform(window, distance):
    if abs(distance) < 1e-9:
        return 1.0
    if abs(abs(distance) - 1) < 1e-9 and window == "hann":
        return 0.5
    value = math.sin(math.pi * distance) / (math.pi * distance)
    return value / (1 - distance ** 2) if window == "hann" else value


def response(window, cells, a, b):
    """The integral of MODEL 14.20: over y in closed form, over x by the midpoint rule."""
    count, total = 80, 0.0
    for n in range(count):
        x = (n + 0.5) / count - 0.5
        weight = 1 + math.cos(math.tau * x) if window == "hann" else 1.0
        total += weight * transform(window, cells * x + b) * cmath.exp(2j * math.pi * a * x)
    return abs(total) / count


def peak_db(window, cells):
    """The rectangular window's peak moves among ripples half a cell apart, on one of the axes or half a cell
    beside it."""
    places = [(0.0, 0.0)]
    if window == "rectangular":
        places = [(a / 2, b / 2) for a in (0, 1) for b in range(int(cells) + 1)]
    return 20 * math.log10(max(response(window, cells, *place) for place in places))


def one_echo(bench):
    """The lost level of both fast sensors is that of the integral, whoever moves."""
    for window in WINDOWS:
        frames = numbered([scene(cells, (0.0,), ego_mps) for cells in WALKS for ego_mps in (0.0, -0.7 * cells)])
        for stages in (PLAIN, SMEAR):
            out = [strongest_db(one) for one in run(bench, frames, [radar(window)], stages)]
            still = [strongest_db(one) for one in run(bench, frames, [radar(window, range_migration="compensated")], stages)]
            for n, cells in enumerate(WALKS):
                for level, without in zip(out[2 * n:2 * n + 2], still[2 * n:2 * n + 2]):
                    bench.check(abs(level - without - peak_db(window, cells)) < 0.5,
                                f"{stages}, {window}, {cells} cells: {level - without} dB, expected "
                                f"{peak_db(window, cells)}")


# The radar reads the amplitude off a parabola through three cells, which the ripples without a window bend.
NEAR_DB = {"hann": 0.5, "rectangular": 1.4}


def one_echo_of_the_signal(bench):
    """Levels are means over the places in a cell. What the signal's radar compensates does not fade."""
    if not (bench.bin / SIGNAL).exists():
        print("skipped  one echo of the signal: there is no glint-sensor-signal")
        return
    for window in WINDOWS:
        frames = numbered([scene(cells, (0.25 * n,)) for cells in WALKS for n in range(4)])
        signal = [strongest_db(one) for one in run(bench, frames, [radar(window)], SIGNAL)]
        fast = [strongest_db(one) for one in run(bench, frames, [radar(window)], PLAIN)]
        apart = [sum(a - b for a, b in zip(signal[n:n + 4], fast[n:n + 4])) / 4 for n in range(0, len(fast), 4)]
        for cells, db in zip(WALKS, apart):
            bench.check(abs(db) < NEAR_DB[window], f"{window}, {cells} cells: {db} dB from the signal")
        print(f"  {window}: within {max(map(abs, apart)):.2f} dB of the signal")
        sharp = [radar(window, range_migration="compensated")]
        signal, fast = [[strongest_db(one) for one in run(bench, frames, sharp, stages)] for stages in (SIGNAL, PLAIN)]
        worst = max(abs(a - b) for a, b in zip(signal, fast))
        bench.check(worst < 0.15, f"{window}: compensated, {worst} dB from the signal")


# ---- two echoes -------------------------------------------------------------------------------


def two_echoes(bench):
    """Two posts are one target of glint-sensor up to the resolution, 1.7748 cells, which grows as the integral's width does:
    2 cells at rest, 2.578 and 5.168 over 4 and 10."""
    for cells, width in ((0, 2.0), (4, 2.578), (10, 5.168)):
        edge = 1.7748 * width / 2
        frames = numbered([scene(cells, (0, apart)) for apart in (edge - 0.03, edge + 0.03)])
        counts = [len(one["targets"]) for one in run(bench, frames, [radar("hann")], PLAIN)]
        bench.check(counts == [1, 2], f"{cells} cells: {counts} targets below and above {edge} cells")


CHECKS = [
    ("an echo that walks loses what the integral says", one_echo),
    ("an echo that walks is as strong as the signal has it", one_echo_of_the_signal),
    ("echoes that walk share larger cells", two_echoes),
]


if __name__ == "__main__":
    model.run(__doc__, model.add_shipped_vehicles, CHECKS)
