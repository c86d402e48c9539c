"""The quality of detections, through the executables, against closed forms and Monte Carlo (MODEL 14.21).

Usage: python3 tests/oracle/quality.py BIN_DIR

Exit status 1 if any check fails. Seeds are fixed; statistics are held to three standard errors.
"""

import cmath
import itertools
import math
import random
import sys

sys.dont_write_bytecode = True
import effects_signal as signal  # noqa: E402
import model  # noqa: E402
import suites  # noqa: E402
from model import ego, sensor, suite_of, thing  # noqa: E402
from sizes import quick  # noqa: E402

SCANS = quick(9000, 30000)
ASKED = ["--sections", "quality"]
BATCH = 100  # cells of one frame
PARTS = ("range_m", "range_rate_mps", "azimuth_rad")
DEVIATIONS = ("range_sd_m", "range_rate_sd_mps", "azimuth_sd_rad")
DEGREE = math.pi / 180


def part(name, **values):
    return {"object": name, "reflector": "r", "path": "direct", "range_m": 50, "azimuth_rad": 0, "range_rate_mps": 0,
            "ercs": 1, "time_s": 0, "weight": 1, **values}


def cell_of(number, range_m, azimuth_rad, rate_mps, amplitude, **rest):
    """A cell of one echo that two dipoles receive with this amplitude on the sum channel (MODEL 7.1)."""
    values = {"range_m": range_m, "azimuth_rad": azimuth_rad, "range_rate_mps": rate_mps}
    u = math.pi / 2 * math.sin(azimuth_rad)
    return {"sensor": "radar", **values, "amplitude": amplitude, "sum_re": amplitude, "sum_im": 0, "delta_re": 0,
            "delta_im": -amplitude * math.tan(u), "members": [part(f"o{number}", **values)], **rest}


def heard(bench, suite, lists, noise="glint-noise", effects="all"):
    """What a noise stage makes of lists of cells, one list a frame."""
    ideal = ["glint-ideal", *ASKED, "--effects", effects, "--sensors", bench.write_suite(suite)]
    [empty] = bench.through([model.frame([ego()])], ["glint-extract"], ideal)
    return bench.through([dict(empty, scene=f"s{n}", cells=cells) for n, cells in enumerate(lists)], [noise])


def targets_of(frames):
    return [target for one in frames for target in one["targets"]]


def alone(draw, count, snr_db, azimuth_rad, sigma):
    """Lists of cells of one echo each, SNR even in decibels and azimuth even to both sides."""
    def one(number):
        aside = draw.uniform(*azimuth_rad) * draw.choice((-1, 1))
        strength = sigma * 10 ** (draw.uniform(*snr_db) / 20)
        return cell_of(number, draw.uniform(20, 90), aside, draw.uniform(-40, 40), strength)
    return [[one(number) for number in range(BATCH)] for _ in range(count // BATCH)]


def squared(targets, key, deviation):
    """The squared errors of a component over the variances that the sensor tells."""
    return [((one[key] - one["cell_" + key]) / one["quality"][deviation]) ** 2 for one in targets]


def mean_of(values):
    """The mean and its standard error."""
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((value - mean) ** 2 for value in values) / len(values) ** 2)


def radar(**changes):
    members = {"range_max_m": 100, "pointer_sigma": 0.5, "final_threshold": False, "threshold_db": 6,
               "cell_range_m": 1.5, "cell_range_rate_mps": 0.2, "angle_estimator": "ratio",
               "phase_reference": "centre"}
    return sensor(**{**members, **changes})


BY_SNR = {"sigma_law": "by_snr", "range_sigma_m": 0.01, "range_rate_sigma_mps": 0.001}
LAWS = {
    "ratio, fixed": ({}, 0),
    "ratio, by_snr": (BY_SNR, 0),
    "ratio, by_snr, floor and steps": ({**BY_SNR, "azimuth_floor_rad": 0.01, "range_step_m": 0.2,
                                        "range_rate_step_mps": 0.05, "azimuth_step_rad": 0.01}, 0),
    "magnitude, by_amplitude": ({"sigma_law": "by_amplitude", "angle_estimator": "magnitude"}, 5),
    "magnitude, by_snr": ({**BY_SNR, "angle_estimator": "magnitude"}, 5),
}


def errors(bench):
    """Normalised squared errors of targets of one contributor, SNR from 15 dB, beyond 5 degrees for magnitude:
    within three standard errors of 1 over 30,000 scans."""
    for name, (members, from_degrees) in LAWS.items():
        for snr_db in ((15, 15), (15, 40))[:1 + ("by_snr" in name)]:
            draw = random.Random(f"{name} {snr_db}")
            lists = alone(draw, SCANS, snr_db, (from_degrees * DEGREE, 60 * DEGREE), 0.5)
            targets = targets_of(heard(bench, suite_of(radar(**members)), lists))
            bench.check(len(targets) == SCANS, f"{name}: {len(targets)} targets")
            for key, deviation in zip(PARTS, DEVIATIONS):
                mean, error = mean_of(squared(targets, key, deviation))
                bench.check(abs(mean - 1) < 3 * math.sqrt(2 / SCANS), f"{name}, {snr_db} dB: {key}: {mean:.4f}")
                print(f"  {name}, {snr_db[0]} to {snr_db[1]} dB: {key} {mean:.4f} +- {error:.4f}")


def outside(bench):
    """MODEL 14.21's table of azimuths for which the deviations do not hold, at some of its places."""
    table = [("magnitude", 15, 0, "2.01"), ("magnitude", 15, 5, "1.52"), ("magnitude", 20, 5, "1.10"),
             ("magnitude", 15, 10, "1.03"), ("ratio", 8, 40, "1.06")]
    for estimator, snr_db, degrees, printed in table:
        azimuth = (degrees * DEGREE, degrees * DEGREE)
        lists = alone(random.Random(degrees), 6000, (snr_db, snr_db), azimuth, 0.5)
        targets = targets_of(heard(bench, suite_of(radar(angle_estimator=estimator)), lists))
        mean, error = mean_of(squared(targets, "azimuth_rad", "azimuth_sd_rad"))
        bench.check(abs(mean - float(printed)) < 3 * error + 0.005, f"{estimator}, {snr_db} dB, {degrees}: {mean:.3f}")


def poisson(draw, mean):
    count, left = 0, draw.expovariate(1)
    while left < mean:
        count, left = count + 1, left + draw.expovariate(1)
    return count


def varying(draw, mean):
    """A count whose own mean is drawn by a gamma law of shape 1/4 from scan to scan: mostly few, now and then many."""
    return poisson(draw, draw.gammavariate(0.25, 4 * mean))


def tally(bench, targets, what):
    """Of the targets with a probability of existence in each of ten bins, so many are echoes, within three standard
    errors and 0.03."""
    bins = [[0, 0, 0, 0] for _ in range(10)]
    for one in targets:
        probability = one["quality"]["existence"]
        own = bins[min(int(10 * probability), 9)]
        own[0] += 1
        own[1] += probability
        own[2] += probability * (1 - probability)
        own[3] += one["contributors"][0]["path"] != "false_alarm"
    for number, (count, expected, variance, found) in enumerate(bins):
        good = abs(found - expected) <= 3 * math.sqrt(variance) + 0.03 * count
        bench.check(good, f"{what}, bin {number}: {found} echoes of {count}, expected {expected:.1f}")
    shares = ", ".join(f"{found / count:.3f} for {expected / count:.3f}" for count, expected, _, found in bins if count)
    print(f"  {what}: {shares}")
    return [count for count, *_ in bins]


def existence(bench):
    """Of cells with powers even over decibels that all pass the first threshold, with the effect left out."""
    sigma, scans = 0.8, quick(2000, 6000)
    for interference in (0, 3):
        draw = random.Random(interference)
        loud = [[cell_of(number, 50, draw.uniform(-1, 1), 0, sigma * 10 ** draw.uniform(-0.5, 1.5),
                         interference=interference) for number in range(max(1, varying(draw, 10)))]
                for _ in range(scans)]
        suite = suite_of(radar(pointer_sigma=sigma, final_threshold=True, false_alarms=3, false_alarm_range_rate_mps=2))
        targets = targets_of(heard(bench, suite, loud, effects="all,-threshold"))
        counts = tally(bench, targets, f"interference {interference}")
        bench.check(interference or sum(count > 100 for count in counts) >= 8, f"empty bins: {counts}")


# What a suite's thresholds and noise decide; all else would change the powers of the world.
DECIDED = "visibility,merging,superposition,fluctuation,threshold,angle_noise,range_noise,false_alarms,final_threshold"
LEVELS_DB = range(-18, 25, 3)  # of the world's echoes, over the threshold


def world(draw, document, kinds, scans):
    """Frames with objects ahead of a shipped radar, each in a cell of its own, and the vehicles: one a level."""
    one = document["sensors"][0]
    one.update(fluctuation="swerling_1", list_limit=0, latency_s=0, mount_yaw_rad=0, false_alarm_range_rate_mps=1,
               antenna_table=str(model.ROOT / "data/antennas" / one["antenna_table"].rpartition("/")[2])
               if "antenna_table" in one else None)
    document["sensors"] = [{key: value for key, value in one.items() if value is not None}]
    at_m = 0.8 * one["range_max_m"]
    ercs = one["calibration_ercs"] * (at_m / one["calibration_range_m"]) ** one["exponent"]
    point = {"name": "point", "x": 0, "y": 0, "facing_rad": 0, "full_rad": math.pi, "zero_rad": math.pi}
    step = 3 * one["cell_range_rate_mps"]
    frames = []
    for number in range(scans):
        stand = [thing(f"o{i}", draw.choice(kinds), at_m + one["mount_x_m"], one["mount_y_m"], velocity=(step * i, 0))
                 for i in range(min(varying(draw, 10), 300))]
        frames.append(dict(model.frame([ego()] + stand), scene=f"s{number}"))
    return frames, [{"origin": "tests", "length_m": 0.1, "width_m": 0.1, "height_m": 1,
                     "reflectors": {"blocks": False, "points": [dict(point, ercs=ercs * 10 ** (level_db / 20))]}}
                    for level_db in LEVELS_DB]


def existence_of_shipped(bench):
    """Through the whole chain, with both thresholds, in worlds of echoes whose powers are even over decibels."""
    kinds = [f"point{number}" for number in range(len(LEVELS_DB))]
    for name in ("lrr77-full", "radarscenes77-full", "srr24-signal"):
        document = suites.whole(name)
        frames, vehicles = world(random.Random(name), document, kinds, quick(1000, 4000))
        for kind, vehicle in zip(kinds, vehicles):
            bench.add_vehicle(kind, vehicle)
        tally(bench, targets_of(driven(bench, document, frames, effects=DECIDED)), name)


def driven(bench, suite, frames, quality=True, effects="all"):
    """What the chain makes of frames."""
    ideal = ["glint-ideal", *(ASKED if quality else ()), "--effects", effects, "--sensors", bench.write_suite(suite)]
    return bench.through(frames, ["glint-extract"], ideal, ["glint-sensor"], ["glint-noise"])


def turned(place, yaw):
    return (place[0] * math.cos(yaw) - place[1] * math.sin(yaw), place[0] * math.sin(yaw) + place[1] * math.cos(yaw))


def roadside(draw, number, posts):
    """An ego that drives and turns among posts."""
    yaw, speed = draw.uniform(-3, 3), draw.uniform(0, 40)
    own = dict(ego(), x_m=draw.uniform(-500, 500), y_m=draw.uniform(-500, 500), yaw_rad=yaw, length_m=5,
               vx_mps=speed * math.cos(yaw), vy_mps=speed * math.sin(yaw), yaw_rate_radps=draw.uniform(-0.5, 0.5))
    stand = [thing(f"p{i}", "post", own["x_m"] + draw.uniform(-60, 60), own["y_m"] + draw.uniform(-60, 60))
             for i in range(posts)]
    return dict(model.frame([own] + stand), scene=f"s{number}")


def check_target(bench, frame, view, target):
    """Places and rate over ground of one target, from what the line says of ego and mount."""
    own = next(one for one in frame["objects"] if one["id"] == frame["ego"])
    age, turn, quality = view.get("age_s", 0), own["yaw_rate_radps"], target["quality"]
    yaw, velocity = own["yaw_rad"], (own["vx_mps"], own["vy_mps"])
    place = [own["x_m"], own["y_m"]]
    for _ in range(200 if age else 0):
        middle = turned(velocity, -turn * age / 400)
        place = [place[0] - middle[0] * age / 200, place[1] - middle[1] * age / 200]
        velocity, yaw = turned(velocity, -turn * age / 200), yaw - turn * age / 200
    mount = (view["mount_x_m"], view["mount_y_m"])
    seen = turned((target["range_m"], 0), target["azimuth_rad"])
    body = [a + b for a, b in zip(mount, turned(seen, view["mount_yaw_rad"]))]
    world = [a + b for a, b in zip(place, turned(body, yaw))]
    arm = turned(mount, yaw)
    speed = (velocity[0] - turn * arm[1], velocity[1] + turn * arm[0])
    sight = yaw + view["mount_yaw_rad"] + target["azimuth_rad"]
    expected = {
        "x_sensor_m": seen[0], "y_sensor_m": seen[1], "x_centre_m": body[0], "y_centre_m": body[1],
        "x_rear_axle_m": body[0] + 5 * 5 / 18, "y_rear_axle_m": body[1], "x_world_m": world[0], "y_world_m": world[1],
        "range_rate_over_ground_mps": target["range_rate_mps"] + speed[0] * math.cos(sight) + speed[1] * math.sin(sight),
    }
    for key, value in expected.items():
        bench.check(abs(quality[key] - value) < 6e-5, f"{key}: {quality[key]}, expected {value}")
    return speed[0] * math.sin(sight) - speed[1] * math.cos(sight)


def places(bench):
    """Places are those of the line's range, azimuth, mount and ego at the instant that the scan shows; what stands
    has a rate over ground of 0, as far as the deviations of rate and azimuth say."""
    draw = random.Random(5)
    corner = {"mount_x_m": 2, "mount_y_m": -0.8, "mount_yaw_rad": -1.2, **BY_SNR}
    far = {"calibration_range_m": 90, "cell_range_m": 0.3}
    suite = suite_of(radar(latency_s=0.05, **{**corner, **far}), radar(name="ahead"))
    frames = driven(bench, suite, [roadside(draw, number, 60) for number in range(300)])
    scaled = []
    for frame in frames:
        views = {view["name"]: view for view in frame["sensors"]["list"]}
        for target in frame["targets"]:
            across = check_target(bench, frame, views[target["sensor"]], target)
            quality = target["quality"]
            deviation = math.hypot(quality["range_rate_sd_mps"], across * quality["azimuth_sd_rad"])
            if quality["snr_db"] >= 15 and not quality["merged_reflectors"] and target["sensor"] == "radar":
                scaled.append(quality["range_rate_over_ground_mps"] / deviation)
    mean, _ = mean_of([value * value for value in scaled])
    count = len(scaled)
    bench.check(count > 1500 and abs(mean - 1) < 3 * math.sqrt(2 / count), f"standing: {mean} over {count}")
    bench.check(abs(sum(scaled) / count) < 3 / math.sqrt(count), f"standing: mean {sum(scaled) / count}")
    print(f"  rate over ground of {count} standing echoes: mean square {mean:.3f}")


def labels(bench):
    """The true rate is the reported one plus ambiguity_number intervals; merged echoes are told."""
    draw = random.Random(6)
    lists = [[cell_of(n, 50, 0.2, 0, 40) for n in range(BATCH)] for _ in range(20)]
    for cell in (cell for cells in lists for cell in cells):
        true = draw.uniform(-70, 70)
        cell["range_rate_mps"] = (true + 12) % 24 - 12
        cell["members"][0]["range_rate_mps"] = true
        kind = draw.randrange(3)
        if kind:
            name = cell["members"][0]["object"] if kind == 1 else "z"
            cell["members"] += [dict(part(name), reflector="s", weight=0)]
    for target in targets_of(heard(bench, suite_of(radar(unambiguous_rate_mps=12)), lists)):
        quality, parts = target["quality"], target["contributors"]
        true = target["range_rate_mps"] + quality["ambiguity_number"] * quality["range_rate_interval_mps"]
        bench.check(abs(true - parts[0]["range_rate_mps"]) < 6 * quality["range_rate_sd_mps"], f"{quality} {parts}")
        bench.check(quality["merged_reflectors"] == (len(parts) > 1), f"{quality} {parts}")
        bench.check(quality["merged_objects"] == (parts[-1]["object"] == "z"), f"{quality} {parts}")


def other_stages(bench):
    """glint-noise-gauss tells its fixed sigmas, glint-noise-none that it adds nothing, and both the rest."""
    suite = suite_of(radar(azimuth_sigma_rad=0.03))
    lists = alone(random.Random(8), SCANS, (15, 40), (0, 60 * DEGREE), 0.5)
    targets = targets_of(heard(bench, suite, lists, "glint-noise-gauss"))
    for key, deviation in zip(PARTS, DEVIATIONS):
        mean, _ = mean_of(squared(targets, key, deviation))
        bench.check(abs(mean - 1) < 3 * math.sqrt(2 / SCANS), f"glint-noise-gauss: {key}: {mean:.4f}")
    errors_of = {key: [(one[key] - one["cell_" + key]) / one["quality"][deviation] for one in targets]
                 for key, deviation in zip(PARTS, DEVIATIONS)}
    for key, other in itertools.combinations(PARTS, 2):
        product = sum(a * b for a, b in zip(errors_of[key], errors_of[other])) / SCANS
        bench.check(abs(product) < 3 / math.sqrt(SCANS), f"glint-noise-gauss: {key} and {other}: {product:.4f}")
    for cell, target in zip(lists[0], targets_of(heard(bench, suite, lists[:1], "glint-noise-none"))):
        quality = target["quality"]
        bench.check(all(quality[key] == 0 for key in DEVIATIONS) and quality["existence"] == 1, f"none: {quality}")
    for target in targets[:BATCH]:
        quality = target["quality"]
        u = math.pi / 2 * math.sin(target["azimuth_rad"])
        pattern = math.sin(u) / u * math.cos(target["azimuth_rad"]) * math.cos(u)
        law = 10 ** (6 / 20) / 0.8 * (30 / target["range_m"]) ** 2
        amplitude = 10 ** (target["amplitude_db"] / 20)
        bench.check(abs(quality["snr_db"] - 20 * math.log10(amplitude / 0.5)) < 6e-4, f"snr: {quality}")
        bench.check(abs(quality["rcs_dbsm"] - 10 - 20 * math.log10(amplitude / law / pattern)) < 6e-4, f"rcs: {quality}")


def noisy(draw, sigma):
    return sigma / math.sqrt(2) * complex(draw.gauss(0, 1), draw.gauss(0, 1))


def looks_merged(pointers, sigma):
    """|Re(delta conj sum)|/|sum| beyond 3 standard deviations by noise of this RMS on both channels."""
    total, delta = pointers
    real = (delta * total.conjugate()).real / abs(total)
    return abs(real) > 3 * sigma * math.sqrt((1 + abs(delta / total) ** 2) / 2)


def pair_of(draw, table, apart, amplitude):
    """Sum and delta of two echoes with uniform phases on both sides of boresight, each of this amplitude in the sum; of
    one echo if their distance is 0."""
    parts = [(cmath.rect(amplitude, draw.uniform(0, math.tau)), table(side * apart / 2))
             for side in ((-1, 1) if apart else (1,))]
    return sum(echo for echo, _ in parts), sum(-1j * echo * delta / total for echo, (total, delta) in parts)


def marks(bench):
    """0.27 % of single echoes look merged; of pairs 4 degrees apart as many as in an independent Monte Carlo."""
    path, sigma, count = model.ROOT / "data/antennas/lrr77.csv", 0.5, quick(4000, 10000)
    with open(path, encoding="utf-8") as text:
        rows = [tuple(map(float, line.split(","))) for line in text if line[0] in "-0123456789"]

    def table(azimuth):
        low, high = max(row for row in rows if row[0] <= azimuth), min(row for row in rows if row[0] > azimuth)
        part = (azimuth - low[0]) / (high[0] - low[0])
        return [a + part * (b - a) for a, b in zip(low[1:], high[1:])]
    suite = suite_of(radar(antenna_pattern="table", antenna_table=str(path), pointer_sigma=sigma, list_limit=0))
    for apart, snr_db, least, most in ((0, 20, 0.0012, 0.0042), (4, 20, 0.62, 0.67), (4, 25, 0.79, 0.83)):
        draw, amplitude = random.Random(snr_db), sigma * 10 ** (snr_db / 20)
        own = sum(looks_merged([one + noisy(draw, sigma) for one in pair_of(draw, table, apart * DEGREE, amplitude)], sigma)
                  for _ in range(count)) / count
        cells = [cell_of(n, 50, 0, 0, amplitude) for n in range(count)]
        for cell in cells:
            total, delta = pair_of(draw, table, apart * DEGREE, amplitude)
            cell.update(sum_re=total.real, sum_im=total.imag, delta_re=delta.real, delta_im=delta.imag)
        lists = [cells[n:n + BATCH] for n in range(0, count, BATCH)]
        found = [one["quality"]["looks_merged"] for one in targets_of(heard(bench, suite, lists))]
        share, error = mean_of(found)
        bench.check(len(found) == count and abs(share - own) < 3 * math.sqrt(2) * error and least < share < most,
                    f"{apart} degrees, {snr_db} dB: {share:.4f} of {len(found)} look merged, expected {own:.4f}")
        print(f"  {apart} degrees apart, {snr_db} dB: {share:.4f} +- {error:.4f} look merged")


def beside(samples):
    """What 8 elements half a wavelength apart receive beside their largest beam: the least power that one wave leaves."""
    def beam(sine):
        return abs(sum(one * cmath.rect(1 / 8, -math.pi * n * sine) for n, one in enumerate(samples)))
    best = max((step / 64 for step in range(-64, 65)), key=beam)
    step = 1 / 64
    while step > 1e-5:
        step /= 2
        best = max((best - step, best, best + step), key=beam)
    return sum(abs(one) ** 2 for one in samples) / 8 - beam(best) ** 2


def marks_of_arrays(bench):
    """1 % of single echoes at most look merged; of pairs with uniform phases as many as in an independent Monte Carlo."""
    sigma, count = 0.5, quick(1000, 4000)
    suite = suite_of(radar(pointer_sigma=sigma, list_limit=0, **signal.row_of(8)))
    least = 7 * sigma ** 2 + 3 * math.sqrt(8) * sigma ** 2

    def received(draw, apart):
        echoes = [(cmath.rect(10 * sigma, draw.uniform(0, math.tau)), side * apart / 2) for side in (-1, 1)[:1 + (apart > 0)]]
        return [sum(echo * cmath.rect(1, math.pi * (n - 3.5) * sine) for echo, sine in echoes) for n in range(8)]
    for apart, low, high in ((0, 0, 0.01), (0.06, 0.3, 0.7), (0.12, 0.6, 0.95)):
        draw = random.Random(str(apart))
        own = sum(beside([one + noisy(draw, sigma * math.sqrt(8)) for one in received(draw, apart)]) > least
                  for _ in range(count)) / count
        cells = [cell_of(n, 50, 0, 0, 10 * sigma, elements=[{"re": one.real, "im": one.imag} for one in received(draw, apart)])
                 for n in range(count)]
        targets = targets_of(heard(bench, suite, [cells[n:n + BATCH] for n in range(0, count, BATCH)]))
        targets.sort(key=lambda one: one["amplitude_db"])
        largest = {one["contributors"][0]["object"]: one["quality"]["looks_merged"] for one in targets}
        share, error = mean_of(list(largest.values()))
        wide = 3 * math.sqrt(2) * max(error, 0.002)
        bench.check(len(largest) == count and abs(share - own) < wide and low <= share < high,
                    f"{apart} apart: {share:.4f} of {len(largest)} look merged, expected {own:.4f}")
        print(f"  an array, sines {apart} apart, 20 dB: {share:.4f} +- {error:.4f} look merged, expected {own:.4f}")


SIGNALS = {
    "chirp, hann": {"waveform": {"window": "hann"}},
    "chirp, rectangular": {"waveform": {"window": "rectangular"}},
    "pulse": {"waveform": {"kind": "pulse", "samples": 4 * signal.BINS}},
    "array": {"waveform": {"window": "hann"}, **signal.row_of(8)},
}


def of_the_signal(bench):
    """The signal's errors at 20 dB, wherever an echo stands in its cell."""
    if not (bench.bin / "glint-sensor-signal").exists():
        print("skipped  the signal's errors: there is no glint-sensor-signal")
        return
    for name, members in SIGNALS.items():
        frames = signal.spread(quick(300, 800), 2.0)
        suite = bench.write_suite(suite_of(signal.radar(**members)))
        ideal = ["glint-ideal", *ASKED, "--sensors", suite]
        targets = signal.made(bench.through(frames, ["glint-extract"], ideal, ["glint-sensor-signal"]))
        for key, deviation in zip(PARTS, DEVIATIONS):
            values = [((one[key] - one["contributors"][0][key]) / one["quality"][deviation]) ** 2 for one in targets]
            found, error = mean_of(values)
            bench.check(len(values) > 0.97 * len(frames) and abs(found - 1) < 0.25, f"{name}: {key}: {found:.3f}")
            print(f"  {name}: {key} {found:.3f} +- {error:.3f} of {len(values)}")


def unasked(bench):
    """A stream that does not ask has no quality, and else the same bytes."""
    frames = [roadside(random.Random(9), number, 60) for number in range(40)]
    plain, asked = (driven(bench, suite_of(radar(false_alarms=2, calibration_range_m=90)), frames, quality=quality) for quality in (False, True))
    bench.check(sum("quality" in one for one in targets_of(asked)) == len(targets_of(plain)) > 80, "few targets")
    bench.check(all("quality" not in one for one in targets_of(plain)), "quality without being asked")
    for one in targets_of(asked):
        one.pop("quality")
    for one in asked:
        bench.check(one.pop("sections") == ["objects", "quality"], "the frame does not say it")
    bench.check(asked == plain, "another stream with a quality")


CHECKS = [
    ("errors are as large as their deviations say", errors),
    ("near boresight and in noise they are as MODEL prints", outside),
    ("of detections with a probability of existence so many are echoes", existence),
    ("so they are through the chain of shipped suites, with both thresholds", existence_of_shipped),
    ("places and the rate over ground are those of the ego and the mount", places),
    ("a mark of merged echoes comes with its probability", marks),
    ("so does a mark of other echoes beside an array's beam", marks_of_arrays),
    ("labels of folds and merged echoes are exact", labels),
    ("the other noise stages tell their own errors", other_stages),
    ("the signal's errors are as large as their deviations say", of_the_signal),
    ("nothing is told unless it is asked for", unasked),
]

if __name__ == "__main__":
    model.run(__doc__, model.add_shipped_vehicles, CHECKS)
