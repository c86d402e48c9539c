"""Data sheets as glint --datasheet prints them, against what the chain does.

Usage: python3 tests/oracle/data_sheet.py BIN_DIR

A post stands where the sheet says how often and how accurately it is seen, and the whole chain counts. Exit
status 1 if any check fails. Seeds are fixed; shares are held to five standard errors beyond the last printed
digit, deviations to eight per cent, as they are printed with two digits.
"""

import json
import math
import re
import subprocess
import sys

sys.dont_write_bytecode = True
import model  # noqa: E402
from model import sensor, suite_of, thing  # noqa: E402
from effects_noise import THRESHOLD, frames_of, listen, rms  # noqa: E402

DRAWS = 5000
SECTIONS_DBSM = [0, 10, 20]


def radar(**changes):
    return sensor("radar", **{"range_max_m": 500, "calibration_range_m": 60, "angle_estimator": "ratio",
                              "phase_reference": "centre", "pointer_sigma": 0.4 * THRESHOLD,
                              "range_sigma_m": 0.02, "range_rate_sigma_mps": 0.05, **changes})


RADARS = {
    "steady": radar(),
    "swerling_1": radar(fluctuation="swerling_1"),
    "swerling_3": radar(fluctuation="swerling_3", exponent=1.3),
    "log_normal": radar(fluctuation="log_normal", fluctuation_sigma_db=5),
    "no final threshold": radar(fluctuation="swerling_1", final_threshold=False),
    "by_snr": radar(sigma_law="by_snr", range_step_m=0.3, azimuth_floor_rad=0.02, pointer_sigma=0.1 * THRESHOLD),
}


def sheet_of(bench, document):
    """Chances of detection, {(degrees, dBsm, which chance): range}, and the rows of the accuracies."""
    done = subprocess.run([str(bench.bin / "glint"), "--datasheet", str(bench.write_suite(suite_of(document)))],
                          capture_output=True, check=True, text=True)
    chances = [float(word) for word in re.search(r"probability of ([\d.]+) and of ([\d.]+)", done.stdout).groups()]
    rows = re.findall(r"^ +([\d.]+) degrees((?: +\S+){6})$", done.stdout, re.M)
    ranges = {(float(degrees), section, chance): words.split()[2 * i + chance]
              for degrees, words in rows for i, section in enumerate(SECTIONS_DBSM) for chance in (0, 1)}
    accuracies = [[float(word) for word in row.split()[:5]]
                  for row in re.findall(r"^  SNR +(.*)$", done.stdout.replace(" dB", ""), re.M)]
    return chances, ranges, accuracies


def look(bench, document, kind, range_m, degrees, draws):
    """The targets of a post, in as many frames."""
    place = range_m * math.cos(math.radians(degrees)), range_m * math.sin(math.radians(degrees))
    frames = listen(bench, frames_of([thing("post", kind, *place)], draws), [document])
    return [target for one in frames for target in one["targets"]]


def detection(bench):
    for name, document in RADARS.items():
        chances, ranges, _ = sheet_of(bench, document)
        for degrees, section, which in ((0.0, 10, 0), (0.0, 10, 1), (30.0, 0, 1), (60.0, 20, 0)):
            # A hair nearer, as a steady echo at the threshold itself hangs on the range's last digit.
            near = float(ranges[degrees, section, which]) * 0.999
            share = len(look(bench, document, f"section_{section}", near, degrees, DRAWS)) / DRAWS
            slack = 5 * math.sqrt(share * (1 - share) / DRAWS) + 0.01
            bench.check(abs(share - chances[which]) < slack,
                        f"{name}, {section} dBsm at {degrees} degrees, {near} m: {share}, printed {chances[which]}")


def accuracy(bench):
    """20 dB above the threshold, where the ratio of powers on boresight is the printed one."""
    for name in ("steady", "by_snr"):
        document = RADARS[name]
        _, ranges, accuracies = sheet_of(bench, document)
        far, (_, range_m, rate_mps, azimuth_deg) = float(ranges[0.0, 10, 0]) / math.sqrt(10), accuracies[2][:4]
        targets = look(bench, document, "section_10", far, 0.0, DRAWS)
        bench.check(len(targets) == DRAWS, f"{name}: {len(targets)} targets")
        for key, scale, printed in (("range_m", 1, range_m), ("range_rate_mps", 1, rate_mps),
                                    ("azimuth_rad", 180 / math.pi, azimuth_deg)):
            measured = scale * rms([one[key] - one["cell_" + key] for one in targets])
            bench.check(abs(measured / printed - 1) < 0.08, f"{name}: {key} {measured}, printed {printed}")


def prepare(bench):
    model.add_shipped_vehicles(bench)
    for section in SECTIONS_DBSM:
        ercs = math.sqrt(10 ** (section / 10) / 10)
        bench.add_vehicle(f"section_{section}", model.vehicle(0.1, 0.1, points=[model.everywhere("p", ercs)]))


CHECKS = [
    ("posts are detected as often as printed, at the printed ranges", detection),
    ("errors are as large as printed", accuracy),
]


if __name__ == "__main__":
    model.run(__doc__, prepare, CHECKS)
