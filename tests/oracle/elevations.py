"""Elevations of the chain beside those that a row of elements, one above the other, reads of its samples.

Usage: python3 tests/oracle/elevations.py BIN_DIR        exit status 1 if any check fails

The row is simulated here alone: samples of its elements, and the phase from one to the next or the maximum of its beam.
It shares nothing with the chain but the echoes. A mean over phases is one of readings weighted by their power, as a weak
sum of echoes that cancel reads anything. Draws have fixed seeds.
"""
import cmath
import json
import math
import os
import random
import re
import struct
import sys
from pathlib import Path

sys.dont_write_bytecode = True
import model  # noqa: E402
import glint  # noqa: E402
from glint.recordings import readers  # noqa: E402
from model import echo, ego, frame, sensor, suite_of, thing  # noqa: E402
from sizes import quick  # noqa: E402

ELEMENTS, SPACING = 8, 0.5  # wavelengths apart
LOOKS = quick(1000, 10000)
THRESHOLD = 10 ** (6 / 20)
NOISE = THRESHOLD / 10 ** (13 / 20)
HEIGHT_M = 0.5
ROW = {"mount_z_m": HEIGHT_M, "elevation_view_rad": 0.4, "carrier_hz": 76.5e9, "range_max_m": 300, "cell_range_m": 2}


# ---- the row -------------------------------------------------------------------------------------


def samples(echoes, noise=0.0, draw=None):
    """Of each element: echoes are pairs of a complex amplitude and an elevation; noise is the RMS in a beam."""
    sigma = noise * math.sqrt(ELEMENTS / 2)
    return [sum(a * cmath.exp(2j * math.pi * SPACING * n * math.sin(e)) for a, e in echoes)
            + (complex(draw.gauss(0, sigma), draw.gauss(0, sigma)) if noise else 0) for n in range(ELEMENTS)]


def by_phase(found):
    """The sine by the phase from an element to the next, and the power."""
    turn = sum(b * a.conjugate() for a, b in zip(found, found[1:]))
    return cmath.phase(turn) / (2 * math.pi * SPACING), abs(turn)


def by_beam(found, sine):
    """The sine of the beam's maximum near one, by steps over the curvature that a single echo has."""
    curvature = (2 * math.pi * SPACING) ** 2 * (ELEMENTS ** 2 - 1) / 12
    for _ in range(6):
        beam = [x * cmath.exp(-2j * math.pi * SPACING * n * sine) for n, x in enumerate(found)]
        whole, slope = sum(beam), sum(-2j * math.pi * SPACING * n * x for n, x in enumerate(beam))
        sine += (whole.conjugate() * slope).real / (abs(whole) ** 2 * curvature)
    return sine


def mean_over_phases(echoes, draw):
    """The mean of readings weighted by their power, and its standard error."""
    told = []
    for _ in range(LOOKS):
        told.append(by_phase(samples([(a * cmath.rect(1, draw.uniform(0, math.tau)), e) for a, e in echoes])))
    weight = sum(power for _, power in told)
    mean = sum(sine * power for sine, power in told) / weight
    return mean, math.sqrt(sum((power * (sine - mean)) ** 2 for sine, power in told)) / weight


# ---- beside the chain ----------------------------------------------------------------------------


def seen(bench, lists, suite, *stages, **members):
    """What stages make of hand-made echoes of the suite's only sensor, a frame for each list."""
    first = dict(frame([ego()]), **members)
    [empty] = bench.through([first], ["glint-extract"], ["glint-ideal", "--sensors", bench.write_suite(suite), "--sections", "quality"])
    return bench.through([dict(empty, scene=f"s{i}", echoes=echoes) for i, echoes in enumerate(lists)], ["glint-sensor"], *stages)


def amplitude(ercs, range_m):
    return THRESHOLD / 0.8 * (30 / range_m) ** 2 * ercs


def at(name, range_m, ercs, elevation_rad, **rest):
    return dict(echo(name, range_m, 0, 0, ercs), elevation_rad=elevation_rad, **rest)


def two_echoes_of_a_cell(bench):
    draw = random.Random(4)
    pairs = [[(name, draw.uniform(0.3, 3), draw.uniform(-0.04, 0.04)) for name in "ab"] for _ in range(12)]
    lists = [[at(name, 20, ercs, elevation) for name, ercs, elevation in pair] for pair in pairs]
    for pair, one in zip(pairs, seen(bench, lists, suite_of(sensor(**ROW)), ["glint-noise-none"])):
        [cell] = one["targets"]
        mean, error = mean_over_phases([(ercs, elevation) for _, ercs, elevation in pair], draw)
        bench.check(abs(cell["elevation_rad"] - mean) < 5 * error + 1e-5,
                    f"{pair}: {cell['elevation_rad']} rad, the row reads {mean} +- {error}")
        bench.check(cell["elevation_rad"] == cell["cell_elevation_rad"], "without noise a target has the elevation of its cell")
        label = {part["reflector"]: part["elevation_rad"] for part in cell["contributors"]}
        bench.check(label == {name: elevation for name, _, elevation in pair}, f"label {label}")


def an_echo_and_its_image(bench):
    """Over asphalt, whose coefficient is written a second time here. The way from 60 to 200 m turns the phase often."""
    draw, wave_m = random.Random(5), 299792458 / 76.5e9
    for range_m in 60, 120, 200:
        height_m = 0.6
        sine = (HEIGHT_M + height_m) / math.hypot(range_m, HEIGHT_M + height_m)
        bent = cmath.sqrt(5 - 0.25j - 1 + sine * sine)
        coefficient = ((5 - 0.25j) * sine - bent) / ((5 - 0.25j) * sine + bent) * math.exp(-8 * (math.pi * 1e-3 * sine / wave_m) ** 2)
        part = abs(coefficient) * math.hypot(range_m, 0.1) / math.hypot(range_m, 1.1)
        point, image = math.atan(0.1 / range_m), -math.atan(1.1 / range_m)
        [one] = seen(bench, [[at("a", range_m, 100, point, height_m=height_m)]], suite_of(sensor(**ROW)), ["glint-noise-none"],
                     conditions={"road": "asphalt"})
        mean, error = mean_over_phases([(1, point), (part, image)], draw)
        told = one["targets"][0]["elevation_rad"]
        bench.check(abs(told - mean) < 5 * error + 1e-6, f"{range_m} m: {told} rad, the row reads {mean} +- {error}")


def beams_of_a_cell(bench):
    """Two beams of an array along the bumper, each of an echo of its own."""
    array = {"antenna_pattern": "array", "angle_estimator": "beams", "array": {
        "transmit": [{"place": 0}], "receive": [{"place": 0.5 * n} for n in range(8)], "taper": "rectangular"}, "pointer_sigma": 0.01}
    pair = [dict(at("a", 20, 2, 0.03), azimuth_rad=-0.5), dict(at("b", 20, 1.5, -0.02), azimuth_rad=0.4)]
    [one] = seen(bench, [pair], suite_of(sensor(**ROW, **array)), ["glint-noise-none"])
    found = {target["contributors"][0]["reflector"]: target["elevation_rad"] for target in one["targets"]}
    bench.check(found.keys() == {"a", "b"}, f"beams of {found}")
    for wanted in pair:
        bench.check(abs(found.get(wanted["reflector"], 0) - wanted["elevation_rad"]) < 1e-12, f"{wanted['reflector']}: {found}")


def deviations(bench):
    """At the threshold, 13 dB over the noise, where the law of first order is 6 % short, and above it."""
    draw, at_threshold = random.Random(6), math.sqrt(6) / (2 * math.pi) / (ELEMENTS * SPACING) * NOISE / THRESHOLD
    suite = suite_of(sensor(**ROW, elevation_sigma_rad=at_threshold, pointer_sigma=0, final_threshold=False))
    for above_db in 0.1, 7, 17:
        ercs = 0.8 * (20 / 30) ** 2 * 10 ** (above_db / 20)
        frames = seen(bench, [[at("a", 20, ercs, 0.02)]] * LOOKS, suite, ["glint-noise"])
        errors = [one["targets"][0]["elevation_rad"] - 0.02 for one in frames]
        row = [by_beam(samples([(amplitude(ercs, 20), 0.02)], NOISE, draw), math.sin(0.02)) - math.sin(0.02) for _ in range(LOOKS)]
        chain, own = (math.sqrt(sum(x * x for x in told) / LOOKS) for told in (errors, row))
        bench.check(abs(chain / own - 1) < 5 / math.sqrt(LOOKS) + 0.04, f"{above_db} dB: {chain} rad, that of the row {own}")
        bench.check(abs(sum(errors) / LOOKS) < 5 * chain / math.sqrt(LOOKS), f"{above_db} dB: errors have the mean {sum(errors) / LOOKS}")
        stated = frames[0]["targets"][0]["quality"]["elevation_sd_rad"]
        bench.check(abs(chain / stated - 1) < 5 / math.sqrt(2 * LOOKS), f"{above_db} dB: {chain} rad, stated {stated}")


# ---- beside a recording --------------------------------------------------------------------------

NEAR_M, BODIES = 25, 20
PAGE = (r"the elevations of a car at 9 to 14 m\s+spread by ([\d.]+) degrees as measured \((\d+) detections\), and by ([\d.]+) "
        r"simulated \(on average (\d+);\s+([\d.]+) to ([\d.]+) by body\)")
IMAGING = {**ROW, "mount_z_m": 0.6, "cell_range_m": 0.107, "cell_range_rate_mps": 0.136, "calibration_ercs": 1, "calibration_range_m": 350,
           "exponent": 0.7, "cell_phase": "random", "angle_estimator": "ratio", "pointer_sigma": 1, "elevation_sigma_rad": 0.0088,
           "elevation_floor_rad": 0.0017}


def spread(scans):
    """The deviation of elevations, in rad, within a car in a scan, pooled over all scans, in degrees."""
    told = [scan for scan in scans if len(scan) > 1]
    squares = sum((one - sum(scan) / len(scan)) ** 2 for scan in told for one in scan)
    return math.degrees(math.sqrt(squares / sum(len(scan) - 1 for scan in told)))


def inside(box, points):
    """The elevations of points, triples with x and y, in the outline of a box."""
    turned = [(*glint.turned(x - box.x_m, y - box.y_m, -box.yaw_rad), up) for x, y, up in points]
    return [up for ahead, left, up in turned if abs(ahead) <= box.length_m / 2 and abs(left) <= box.width_m / 2]


def near_cars(folder):
    """The cars of the recording nearer than NEAR_M that have detections, and the elevations in their outlines; the recording counts downwards."""
    names = [readers.numbered(folder, one).values() for one in ("calib/*.txt", "label_2/*.txt", "velodyne/*.bin")]
    for calibration, labels, points in zip(*names, strict=True):
        line = next(one for one in Path(calibration).read_text().splitlines() if one.startswith("Tr_velo"))
        rows = [(x, y, -math.radians(beta)) for x, y, *_, beta in struct.iter_unpack("<8f", Path(points).read_bytes())]
        for one in Path(labels).read_text().splitlines():
            box = readers.kitti_box(one.split(), list(map(float, line.split()[1:])))
            seen_there = inside(box, rows)
            if math.hypot(box.x_m, box.y_m) < NEAR_M and seen_there:
                yield box, seen_there


def beside_a_recording(bench):
    """The page has both spreads and numbers of detections. Each scene has a body of its own."""
    folder = os.path.join(os.environ.get("GLINT_TEST_DATA", ""), "tj4d-first")
    if not os.path.isdir(folder):
        print("skipped  elevations beside a recording: GLINT_TEST_DATA has no tj4d-first")
        return
    boxes, measured = zip(*near_cars(folder))
    for name in "car", "ego":
        bench.add_vehicle(name, json.loads((model.ROOT / "data/surfaces/vehicles/car.json").read_text()))
    frames = [dict(frame([ego(), dict(thing("other", "car", box.x_m, box.y_m, box.yaw_rad), length_m=box.length_m, width_m=box.width_m,
                                      height_m=box.height_m)]), scene=f"body {body}", frame=i, last=i + 1 == len(boxes))
              for body in range(BODIES) for i, box in enumerate(boxes)]
    lists = model.parsed(bench.fused(f"glint-extract | glint-ideal --sensors {bench.write_suite(suite_of(sensor(**IMAGING)))} | glint-sensor"
                                     " | glint-noise", frames))
    simulated = [inside(box, [(*glint.place(one, target, "sensor"), target["elevation_rad"]) for target in one["targets"]])
                 for box, one in zip(boxes * BODIES, lists, strict=True)]
    by_body = sorted(spread(simulated[i:i + len(boxes)]) for i in range(0, len(simulated), len(boxes)))
    told = [spread(measured), sum(map(len, measured)), spread(simulated), sum(map(len, simulated)) / BODIES, by_body[0], by_body[-1]]
    print(f"a car at {min(math.hypot(box.x_m, box.y_m) for box in boxes):.1f} to {max(math.hypot(box.x_m, box.y_m) for box in boxes):.1f} m: "
          f"{told[1]} detections measured, {told[3]:.1f} simulated in {len(boxes)} scans; {told[0]:.2f} and {told[2]:.2f} degrees")
    found = re.search(PAGE, (model.ROOT / "data/measured/README.md").read_text())
    for value, printed in zip(told, found.groups(), strict=True):
        bench.check_printed(value, printed, "elevations on the page")


CHECKS = [("the elevation of a cell is the mean of what a row reads over phases", two_echoes_of_a_cell),
          ("beams of one cell have the elevations of their own echoes", beams_of_a_cell),
          ("the road's image pulls it as it pulls the row's", an_echo_and_its_image),
          ("its deviation is that of the row's beam", deviations),
          ("elevations of a near car spread as a page says", beside_a_recording)]

if __name__ == "__main__":
    model.run(__doc__, lambda bench: None, CHECKS)
