"""The effects at home in noise, through the executables, against closed forms and published values.

Usage: python3 tests/oracle/effects_noise.py BIN_DIR

Exit status 1 if any check fails. Statistics use fixed seeds and are held to five standard errors or to three
per cent.
"""

import itertools
import json
import math
import sys

sys.dont_write_bytecode = True
import model  # noqa: E402
from model import ego, sensor, suite_of, thing  # noqa: E402
from sizes import quick  # noqa: E402

DRAWS = quick(6000, 20000)
THRESHOLD = 10 ** (6 / 20)
QUIET = {"pointer_sigma": 0, "range_sigma_m": 0, "range_rate_sigma_mps": 0, "final_threshold": False}
PLACE = ("range_m", "azimuth_rad", "range_rate_mps")


def frames_of(objects, count, interval=0.1):
    first = model.frame([ego()] + objects)
    return [dict(first, frame=i, time_s=interval * (i + 1), interval_s=interval, last=i + 1 == count)
            for i in range(count)]


def listen(bench, frames, sensors, effects="all", margins=False):
    """The output of the whole chain, with its account."""
    path = bench.write_suite(suite_of(*sensors))
    text = (f"glint-extract | glint-ideal --sensors {path} --effects {effects} --sections account"
            f"{',margins' if margins else ''} | glint-sensor | glint-noise")
    return model.parsed(bench.fused(text, frames))


def targets_of(frames, name):
    """The one target that the sensor has in every frame."""
    return [target for one in frames for target in one["targets"] if target["sensor"] == name]


def check_switch(bench, frames, sensors, effect, everything):
    """auto and all give the same bytes; an effect that is switched off marks nothing."""
    auto = listen(bench, frames, sensors, "auto")
    for one in everything + auto:
        one["sensors"].pop("effects")
    bench.check(auto == everything, f"{effect}: auto and all differ")
    without = listen(bench, frames, sensors, f"all,-{effect}")
    marked = [target for one in without for target in one["targets"] if effect in target.get("effects", [])]
    bench.check(not marked, f"{effect}: switched off, it marks {len(marked)} targets")
    return without


def rms(values):
    return math.sqrt(sum(value * value for value in values) / len(values))


def check_rms(bench, values, expected, what):
    bench.check(len(values) >= DRAWS and abs(rms(values) / expected - 1) < 0.03,
                f"{what}: {rms(values):.6f} over {len(values)} draws, expected {expected:.6f}")


def check_share(bench, hits, of, expected, what):
    error = math.sqrt(expected * (1 - expected) / of)
    bench.check(abs(hits / of - expected) < 5 * error, f"{what}: {hits / of:.6f}, expected {expected:.6f}")


def check_even(bench, values, what):
    """Kolmogorov's test of values that should be even over (0, 1)."""
    count = len(values)
    gap = max(max((i + 1) / count - value, value - i / count) for i, value in enumerate(sorted(values)))
    bench.check(gap < 2.2 / math.sqrt(count), f"{what}: not even, {gap:.4f} off over {count}")
    bench.check(min(values) < 12 / count and max(values) > 1 - 12 / count,
                f"{what}: from {min(values)} to {max(values)} only")


def check_unrelated(bench, one, other, what):
    means = sum(one) / len(one), sum(other) / len(other)
    products = [(x - means[0]) * (y - means[1]) for x, y in zip(one, other)]
    bench.check(abs(sum(products)) < 5 * rms(products) * math.sqrt(len(products)), f"{what} go together")


# ---- range and rate ---------------------------------------------------------------------------


def pole(name="pole", x=10.0, y=0.0):
    return thing(name, "post", x, y)


def snr_sensor(name, snr_db, **rest):
    """A sensor that sees the pole at 10 m with amplitude 4 T."""
    sigma = 4 * THRESHOLD / 10 ** (snr_db / 20)
    return sensor(name, **{**QUIET, "pointer_sigma": sigma, "calibration_ercs": 0.3, "calibration_range_m": 20,
                           "cell_range_m": 0.299792458, "sigma_law": "by_snr", "window_factor": 0.389848401, **rest})


def accuracy_by_snr(bench):
    """MODEL 14.7: the Cramer-Rao bound of 500 MHz and of half a metre per second."""
    published = {6: (0.058576, None), 13: (0.026165, 0.043638), 20: (0.011687, 0.019492)}
    frames = frames_of([pole()], DRAWS)
    sensors = [snr_sensor(f"snr{db}", db) for db in published]
    out = listen(bench, frames, sensors)
    for db, (range_m, rate_mps) in published.items():
        targets = targets_of(out, f"snr{db}")
        bench.check(all(abs(one["cell_amplitude"] - 4 * THRESHOLD) < 1e-12 for one in targets), "not 4 T")
        check_rms(bench, [one["range_m"] - one["cell_range_m"] for one in targets], range_m, f"range at {db} dB")
        if rate_mps:
            check_rms(bench, [one["range_rate_mps"] - one["cell_range_rate_mps"] for one in targets], rate_mps,
                      f"rate at {db} dB")
        bench.check(all({"accuracy", "range_noise"} <= set(one["effects"]) for one in targets), "not in the label")


def check_scaled(bench, targets, plain, key, sigma, what):
    """Errors are those under sigma 1, times sigma."""
    bench.check(len(targets) == len(plain) > 0, f"{what}: {len(targets)} targets")
    for one, other in zip(targets, plain):
        error, drawn = one[key] - one["cell_" + key], other[key] - other["cell_" + key]
        bench.check(abs(error - sigma * drawn) < 1e-12, f"{what}: {key}: {error / drawn}, expected {sigma}")


def accuracy_to_the_last_digit(bench):
    """The same draws under sigmas of 1 give the error under every other sigma."""
    floor = {"range_sigma_m": 0.05, "range_rate_sigma_mps": 0.05}
    cases = {
        "bound": (20, {}, lambda cell: 0.0389848401 * cell),
        "default": (20, {"window_factor": None}, lambda cell: 0.068 * cell),
        "floor": (20, floor, lambda cell: math.hypot(0.0389848401 * cell, 0.05)),
        "drowned": (-20, floor, lambda cell: cell / math.sqrt(12)),
        "quiet": (20, {"pointer_sigma": 0, **floor}, lambda cell: 0.05),
        "fixed": (20, {"sigma_law": "fixed", **floor}, lambda cell: 0.05),
        "amplitude": (20, {"sigma_law": "by_amplitude", **floor}, lambda cell: 0.05 / 4),
    }
    sensors = [snr_sensor(name, snr_db, **members) for name, (snr_db, members, _) in cases.items()]
    sensors = [{key: value for key, value in one.items() if value is not None} for one in sensors]
    frames = frames_of([pole()], 200)
    out = listen(bench, frames, sensors)
    ones = {"sigma_law": "fixed", "range_sigma_m": 1, "range_rate_sigma_mps": 1}
    plain = listen(bench, frames, [{**one, **ones} for one in sensors])
    for name, (_, _, sigma) in cases.items():
        targets = targets_of(out, name)
        check_scaled(bench, targets, targets_of(plain, name), "range_m", sigma(0.299792458), name)
        check_scaled(bench, targets, targets_of(plain, name), "range_rate_mps", sigma(0.5), name)
        marked = name not in ("fixed", "quiet")
        bench.check(all(("accuracy" in one["effects"]) == marked for one in targets), f"{name}: labels")
    without = check_switch(bench, frames, sensors, "accuracy", out)
    check_scaled(bench, targets_of(without, "floor"), targets_of(plain, "floor"), "range_m", 0.05, "accuracy is off")


def range_noise(bench):
    frames = frames_of([pole()], DRAWS)
    sensors = [snr_sensor("s", 20, sigma_law="fixed", range_sigma_m=0.02, range_rate_sigma_mps=0.05)]
    targets = targets_of(listen(bench, frames, sensors), "s")
    check_rms(bench, [one["range_m"] - one["cell_range_m"] for one in targets], 0.02, "range")
    check_rms(bench, [one["range_rate_mps"] - one["cell_range_rate_mps"] for one in targets], 0.05, "rate")
    few = frames[:100]
    for one in targets_of(check_switch(bench, few, sensors, "range_noise", listen(bench, few, sensors)), "s"):
        bench.check(one["range_m"] == one["cell_range_m"], "range noise is off, and the range is another one")


# ---- the angle --------------------------------------------------------------------------------


def angle_noise(bench):
    """MODEL 7.3: the dipole pair at 30 dB in the sum channel, for a pole aside of boresight."""
    published = {20: 0.7457, 40: 0.5666}
    sensors = []
    for degrees in published:
        aside = math.radians(degrees)
        height = math.cos(math.pi / 2 * math.sin(aside)) * math.cos(aside)
        height *= math.sin(math.pi / 2 * math.sin(aside)) / (math.pi / 2 * math.sin(aside))
        sensors.append(snr_sensor(f"at{degrees}", 30, mount_yaw_rad=-aside, sigma_law="fixed", threshold_db=-100))
        sensors[-1]["pointer_sigma"] = 4 * 10 ** -5 * height / 10 ** 1.5
    frames = frames_of([pole()], DRAWS)
    out = listen(bench, frames, sensors)
    for degrees, expected in published.items():
        targets = targets_of(out, f"at{degrees}")
        errors = [math.degrees(one["azimuth_rad"] - one["cell_azimuth_rad"]) for one in targets]
        check_rms(bench, errors, expected, f"azimuth at {degrees} degrees")
        bench.check(all("angle_noise" in one["effects"] for one in targets), "not in the label")
    few = frames[:100]
    without = check_switch(bench, few, sensors, "angle_noise", listen(bench, few, sensors))
    for degrees in published:
        for one in targets_of(without, f"at{degrees}"):
            bench.check(one["azimuth_rad"] == one["cell_azimuth_rad"], "angle noise is off, and the angle another one")


def angle_floor(bench):
    """MODEL 14.7: a floor of 1 degree adds in quadrature to the 0.8156 degrees of 7.3 at 30 dB, and is all of the
    noise where the pointers have none. It is Gaussian, and no other draw moves."""
    expected = {"noisy": math.hypot(0.8156, 1), "quiet": 1.0}
    sigma = {"noisy": 4 * THRESHOLD / 10 ** 1.5, "quiet": 0}
    plain = {name: snr_sensor(name, 30, sigma_law="fixed", range_sigma_m=0.05, angle_estimator="ratio",
                              pointer_sigma=sigma[name]) for name in expected}
    with_floor = [dict(one, azimuth_floor_rad=math.radians(1)) for one in plain.values()]
    frames = frames_of([pole()], DRAWS)
    out, without = listen(bench, frames, with_floor), listen(bench, frames, list(plain.values()))
    for name in expected:
        targets, others = targets_of(out, name), targets_of(without, name)
        errors = [math.degrees(one["azimuth_rad"] - one["cell_azimuth_rad"]) for one in targets]
        check_rms(bench, errors, expected[name], f"{name}: azimuth")
        check_share(bench, sum(abs(one) > 2 * expected[name] for one in errors), DRAWS, 0.0455, f"{name}: beyond 2 sigma")
        check_unrelated(bench, errors, [one["range_m"] for one in targets], f"{name}: azimuth and range")
        bench.check(all({**one, "azimuth_rad": 0, "effects": 0} == {**other, "azimuth_rad": 0, "effects": 0}
                        for one, other in zip(targets, others)), f"{name}: the floor moves more than the azimuth")
        bench.check(all("angle_noise" in one["effects"] for one in targets), f"{name}: not in the label")
    pairs = [(one["azimuth_rad"], other["azimuth_rad"])
             for one, other in zip(targets_of(out, "noisy"), targets_of(without, "noisy"))]
    check_unrelated(bench, [one - other for one, other in pairs], [other for _, other in pairs], "floor and pointers' noise")
    few = frames[:100]
    off = check_switch(bench, few, with_floor, "angle_noise", listen(bench, few, with_floor))
    bench.check(all(one["azimuth_rad"] == one["cell_azimuth_rad"] for frame in off for one in frame["targets"]),
                "angle noise is off, and the floor is not")


def misalignment(bench):
    """MODEL 14.8: a yaw error of one degree shifts what is straight ahead aside."""
    published = {10: 0.174524, 30: 0.523572, 100: 1.745241}
    poles = [pole(f"p{x}", x) for x in published]
    turned = sensor("turned", range_max_m=200, calibration_range_m=1000, misalignment_rad=math.radians(1), **QUIET)
    frames = frames_of(poles, 1)
    out = listen(bench, frames, [turned])
    for one in targets_of(out, "turned"):
        distance = round(one["range_m"])
        aside = one["range_m"] * math.sin(one["azimuth_rad"])
        bench.check(abs(aside - published[distance]) < 5e-7, f"{aside} m aside at {distance} m")
        bench.check(one["cell_azimuth_rad"] == 0 == one["contributors"][0]["azimuth_rad"], "the label is not exact")
        bench.check("misalignment" in one["effects"], "not in the label")
    bench.check(len(out[0]["targets"]) == 3, "not three poles")
    without = check_switch(bench, frames, [turned], "misalignment", out)
    bench.check(all(one["azimuth_rad"] == 0 for one in targets_of(without, "turned")), "misalignment is not off")


def radome(bench):
    """The bias is a sine of the azimuth and the same at every range."""
    members = {"radome_bias_rad": 0.01, "radome_period_rad": 0.5, "radome_phase_rad": 0.3, "misalignment_rad": -0.02}
    poles = [pole(f"p{i}", 5 * math.cos(i / 10) + i, 5 * math.sin(i / 10)) for i in range(-12, 13) if i > -5]
    bent = sensor("bent", range_max_m=200, calibration_range_m=1000, cell_range_m=1e-3, **members, **QUIET)
    targets = targets_of(listen(bench, frames_of(poles, 1), [bent]), "bent")
    bench.check(len(targets) > 10, f"{len(targets)} poles")
    for one in targets:
        true = one["cell_azimuth_rad"]
        expected = true - 0.02 + 0.01 * math.sin(math.tau * true / 0.5 + 0.3)
        bench.check(abs(one["azimuth_rad"] - expected) < 1e-14, f"{one['azimuth_rad']}, expected {expected}")


def standing_world(bench):
    """MODEL 14.8: at 30 m/s what stands has another rate than its reported azimuth says."""
    turned = sensor("turned", range_max_m=200, calibration_range_m=1000, misalignment_rad=math.radians(1), **QUIET)
    for degrees, expected in ((30, 0.265743), (0, 0.004569)):
        aside = math.radians(degrees)
        one = model.frame([ego(velocity=(30, 0)), pole("p", 40 * math.cos(aside), 40 * math.sin(aside))])
        target = listen(bench, [one], [turned])[0]["targets"][0]
        error = 30 * math.cos(target["azimuth_rad"]) + target["range_rate_mps"]
        bench.check(abs(abs(error) - expected) < 5e-7, f"off by {error} m/s at {degrees} degrees")


# ---- false alarms -----------------------------------------------------------------------------


def alarm_sensor(name, mean=0.64, **rest):
    return sensor(name, **{**QUIET, "pointer_sigma": 0.5, "false_alarms": mean, "false_alarm_range_rate_mps": 40,
                           "field_of_view_rad": 2.0, "final_threshold": True, **rest})


def search_noise(radar):
    """Power of the noise that passes the threshold in as many cells as there are false alarms (MODEL 14.9)."""
    ranges = (radar["range_max_m"] - radar["range_min_m"]) / radar["cell_range_m"]
    rates = 2 * radar["false_alarm_range_rate_mps"] / radar["cell_range_rate_mps"]
    return 10 ** (radar["threshold_db"] / 10) / math.log(ranges * rates / radar["false_alarms"])


def alarms_of(frame, name):
    return [one for one in frame["targets"] if one["sensor"] == name and one["contributors"][0]["object"] == "noise"]


def false_alarm_counts(bench):
    """MODEL 14.9: 6400 cells at 1e-4 are 0.64 false alarms a scan, and none in 52.7292 % of them."""
    frames = frames_of([], DRAWS)
    sensors = [alarm_sensor("a"), alarm_sensor("b"), alarm_sensor("many", 5), alarm_sensor("silent", 0)]
    out = listen(bench, frames, sensors)
    counts = {one["name"]: [len(alarms_of(frame, one["name"])) for frame in out] for one in sensors}
    bench.check(len(out) == DRAWS, f"{len(out)} scans")
    bench.check(sum(counts["silent"]) == 0, "false alarms of a sensor that has none")
    for name, mean in (("a", 0.64), ("b", 0.64), ("many", 5)):
        for number in range(4):
            expected = math.exp(-mean) * mean ** number / math.factorial(number)
            check_share(bench, counts[name].count(number), DRAWS, expected, f"{name}: {number} false alarms")
        error = math.sqrt(mean / DRAWS)
        found = sum(counts[name]) / DRAWS
        bench.check(abs(found - mean) < 5 * error, f"{name}: {found} false alarms a scan, expected {mean}")
    check_unrelated(bench, counts["a"], counts["b"], "counts of two sensors")
    check_unrelated(bench, counts["a"][1:], counts["a"][:-1], "counts of two scans")
    made = sum(path["echoes"] for frame in out for count in frame["counts"] for path in count["paths"]
               if path["path"] == "false_alarm")
    bench.check(made == sum(map(sum, counts.values())), f"{made} counted")
    without = check_switch(bench, frames[:300], sensors, "false_alarms", out[:300])
    bench.check(not any(frame["targets"] for frame in without), "false alarms are not off")


def false_alarm_values(bench):
    """False alarms are even over all cells; their power has no memory above the threshold."""
    scans = [alarms_of(frame, "s") for frame in listen(bench, frames_of([], 4000), [alarm_sensor("s", 5)])]
    alarms = [one for scan in scans for one in scan]
    power = search_noise(alarm_sensor("s", 5))
    excess = [(10 ** (one["amplitude_db"] / 10) - THRESHOLD ** 2) / power for one in alarms]
    bench.check(min(excess) > -1e-9, "a false alarm below the threshold")
    shares = {
        "range": [(one["range_m"] - 0.2) / 29.8 for one in alarms],
        "azimuth": [one["azimuth_rad"] / 2 + 0.5 for one in alarms],
        "range rate": [one["range_rate_mps"] / 80 + 0.5 for one in alarms],
        "power above the threshold": [1 - math.exp(-value) for value in excess],
    }
    for what, values in shares.items():
        check_even(bench, values, what)
    for one, other in itertools.combinations(shares, 2):
        check_unrelated(bench, shares[one], shares[other], f"{one} and {other}")
    numbers = {one["contributors"][0]["number"]: one for scan in scans for one in scan}
    bench.check(min(numbers) == 1 and len(numbers) == max(numbers), f"numbers {sorted(numbers)}")
    for number in (1, 2):
        found = [[one for one in scan if one["contributors"][0]["number"] == number] for scan in scans]
        pairs = [(len(scan), one["range_m"]) for scan, listed in zip(scans, found) for one in listed]
        check_unrelated(bench, *zip(*pairs), f"the count and the range of number {number}")


def shipped_false_alarms(bench):
    """The powers of a shipped suite's false alarms are those of noise that passes the threshold at their rate
    (MODEL 14.9)."""
    for path in sorted((model.ROOT / "data/sensors").glob("*.json")):
        radar = json.loads(path.read_text())["sensors"][0]
        if "waveform" in radar or not radar.get("false_alarms"):
            continue
        frames = [dict(one, seed=str(seed)) for seed in range(4) for one in frames_of([], 1500)]
        text = bench.fused(f"glint-extract | glint-ideal --sensors {path} | glint-sensor | glint-noise", frames)
        alarms = [one for frame in model.parsed(text) for one in alarms_of(frame, radar["name"])]
        over = [10 ** (one["amplitude_db"] / 10 - radar["threshold_db"] / 10) for one in alarms]
        noise = search_noise(radar) / 10 ** (radar["threshold_db"] / 10)
        check_even(bench, [1 - math.exp((1 - level) / noise) for level in over], f"{path.stem}: powers of false alarms")
        near = sum(level < 10 ** 0.03 for level in over) / len(over)
        print(f"  {path.stem}: {len(over)} false alarms, {near:.2f} of them within 0.3 dB of the threshold")


def false_alarm_labels(bench):
    """The label has the drawn values; numbers count up; false alarms beyond the list's limit are lost."""
    steps = {"range_step_m": 0.5, "azimuth_step_rad": 0.01, "range_rate_step_mps": 0.25}
    sensors = [alarm_sensor("full", 8, list_limit=3), alarm_sensor("rough", 8, **steps),
               alarm_sensor("slow", 8, cycle_s=0.3, latency_s=0.05), alarm_sensor("turned", 8, misalignment_rad=0.1)]
    frames = frames_of([pole()], 60)
    out = listen(bench, frames, sensors, margins=True)
    for frame in out:
        for one in (one for name in ("full", "rough", "slow", "turned") for one in alarms_of(frame, name)):
            label = one["contributors"][0]
            bench.check(len(one["contributors"]) == 1 and label["weight"] == 1 and label["reflector"] == "cell" and
                        label["path"] == "false_alarm", f"label {label}")
            bench.check(all(one["cell_" + key] == label[key] for key in PLACE), "the cell is not what was drawn")
            rough = one["sensor"] == "rough"
            bench.check(one["effects"] == ["false_alarms"] + ["quantisation"] * rough, f"effects {one['effects']}")
            bench.check(rough or all(one[key] == label[key] for key in PLACE), "the report is not what was drawn")
            bench.check(abs(20 * math.log10(one["cell_amplitude"]) - one["amplitude_db"]) < 1e-12, "amplitudes differ")
        lost = [one["number"] for group in frame["lost"] if group["reason"] == "list_limit" for one in group["echoes"]
                if one["path"] == "false_alarm"]
        listed = [one["contributors"][0]["number"] for one in alarms_of(frame, "full")]
        bench.check(sorted(lost + listed) == list(range(1, len(lost + listed) + 1)), f"numbers {listed} and {lost}")
        slow = next(one for one in frame["sensors"]["list"] if one["name"] == "slow")
        times = {round(one["contributors"][0]["time_s"] + 0.05, 9) for one in alarms_of(frame, "slow")}
        late = round(math.floor(frame["time_s"] / 0.3 + 1e-9) * 0.3, 9)
        bench.check(times <= {late} and (slow["measured"] or not times), f"{frame['time_s']} s: measured at {times}")
    without = check_switch(bench, frames, sensors, "false_alarms", listen(bench, frames, sensors))
    kept = [{key: one for key, one in target.items() if key != "margins"} for frame in out
            for target in frame["targets"] if target["sensor"] != "full" and target["contributors"][0]["object"] != "noise"]
    bench.check(kept == [one for frame in without for one in frame["targets"] if one["sensor"] != "full"],
                "false alarms move other targets")


# ---- the list ---------------------------------------------------------------------------------


def final_threshold(bench):
    """MODEL 14.14: a steady echo at a threshold of 6 dB above the noise passes with 0.571892."""
    frames = frames_of([pole()], DRAWS)
    at = {"pointer_sigma": 1, "calibration_range_m": 10 * (1 + 1e-9), "sigma_law": "fixed"}
    sensors = [snr_sensor("twice", 0, final_threshold=True, **at), snr_sensor("once", 0, final_threshold=False, **at)]
    out = listen(bench, frames, sensors)
    twice = targets_of(out, "twice")
    check_share(bench, len(twice), DRAWS, 0.571892, "passed")
    bench.check(min(one["amplitude_db"] for one in twice) >= 6, "a target below the threshold")
    bench.check(len(targets_of(out, "once")) == DRAWS, "lost without a final threshold")
    lost = [one for frame in out for group in frame["lost"] if group["reason"] == "below_final_threshold"
            for one in group["echoes"]]
    bench.check(len(lost) == DRAWS - len(twice) and all(one["shortfall_db"] > 0 for one in lost), f"{len(lost)} lost")
    few = frames[:100]
    without = check_switch(bench, few, sensors, "final_threshold", listen(bench, few, sensors))
    bench.check(len(targets_of(without, "twice")) == 100, "the final threshold is not off")


def marcum(amplitude, threshold):
    """Marcum's Q1(sqrt 2 A, sqrt 2 T) for noise of power 1, by its series of Poisson terms."""
    x, y = amplitude ** 2, threshold ** 2
    weight, term = math.exp(-x), math.exp(-y)
    below, total = term, weight * term
    for k in range(1, 3000):
        weight, term = weight * x / k, term * y / k
        below += term
        total += weight * below
    return total


ROW = {"antenna_pattern": "array", "angle_estimator": "beams",
       "array": {"transmit": [{"place": 0}], "receive": [{"place": n / 2} for n in range(8)]}}


def detection_in_noise(bench):
    """MODEL 8.4: a steady echo is detected with Marcum's probability, or never below the lowered threshold, by the sum channel or
    by the beams of an array. Without a final threshold, without noise or with a full first threshold, T decides."""
    frames = frames_of([pole()], DRAWS)
    for over_db in (4, 6, 10, 13.2, 18.1, 26):
        threshold = 10 ** (over_db / 20)
        lowered = max(threshold - 1.75, 0)
        amplitudes = {"weak": 1.01 * lowered + 0.05, "near": threshold * 10 ** (-0.25 / 20), "at": threshold * 1.0001,
                      "strong": threshold + 0.8}

        def one(name, amplitude, **changes):  # the pole has the amplitude, in units of the noise
            at_m = 10 * math.sqrt(amplitude / threshold)
            return snr_sensor(name, 0, **{"pointer_sigma": THRESHOLD / threshold, "sigma_law": "fixed", "calibration_range_m": at_m,
                                          "first_threshold": "lowered", "final_threshold": True, **changes})

        near = amplitudes["near"]
        noisy = [one(name, amplitude) for name, amplitude in amplitudes.items()]
        noisy += [one(f"array {name}", amplitudes[name], **ROW) for name in ("near", "strong")]
        silent = [one("full", near, first_threshold="full"), one("once", near, final_threshold=False), one("silent", near, pointer_sigma=0)]
        silent += [one("below", 0.99 * lowered)] if lowered > 0 else []
        out = listen(bench, frames, noisy + silent)
        for radar in noisy:
            expected = marcum(amplitudes[radar["name"].split()[-1]], threshold)
            check_share(bench, len(targets_of(out, radar["name"])), DRAWS, expected, f"{over_db} dB over the noise, {radar['name']}")
        for radar in silent:
            bench.check(not targets_of(out, radar["name"]), f"{over_db} dB over the noise: {radar['name']} is detected")


def quantisation(bench):
    """MODEL 9: the error of rounding is even within a step."""
    steps = {"range_step_m": 0.2, "range_rate_step_mps": 0.25, "azimuth_step_rad": math.radians(0.1)}
    expected = {"range_m": 0.057735, "range_rate_mps": 0.072169, "azimuth_rad": math.radians(0.028868)}
    frames = frames_of([pole()], DRAWS)
    sensors = [snr_sensor("s", 20, sigma_law="fixed", range_sigma_m=0.6, range_rate_sigma_mps=0.7, **steps)]
    out = listen(bench, frames, sensors)
    exact = listen(bench, frames, sensors, "all,-quantisation")
    for key, step in zip(expected, (0.2, 0.25, math.radians(0.1))):
        errors = [one[key] - other[key] for one, other in zip(targets_of(out, "s"), targets_of(exact, "s"))]
        check_rms(bench, errors, expected[key], f"rounding of {key}")
        bench.check(max(map(abs, errors)) <= step / 2 * (1 + 1e-9), f"{key}: {max(map(abs, errors))} off")
        check_even(bench, [error / step + 0.5 for error in errors], f"rounding of {key}")
        bench.check(all(one[key] == step * round(one[key] / step) for one in targets_of(out, "s")),
                    f"{key}: not a multiple")
    for one, other in zip(targets_of(out, "s"), targets_of(exact, "s")):
        bench.check(all(one[key] == other[key] for key in one if key not in expected and key != "effects"),
                    "rounding changes the label")
    few = frames[:100]
    check_switch(bench, few, sensors, "quantisation", listen(bench, few, sensors))


def list_limit(bench):
    """Targets are listed nearest or strongest first, by the values that the sensor has before it rounds."""
    things = [thing("walker", "pedestrian", 10, 0), pole("near", 10.5), pole("far", 20), pole("farther", 25)]
    order = {"nearest": ["walker", "near", "far", "farther"], "strongest": ["near", "walker", "far", "farther"]}
    for limit in range(5):
        for first, names in order.items():
            radar = snr_sensor("s", 60, list_order=first, list_limit=limit, range_step_m=2.5, pointer_sigma=0,
                               calibration_range_m=50)
            frames = frames_of(things, 1)
            out = listen(bench, frames, [radar])
            listed = [one["contributors"][0]["object"] for one in out[0]["targets"]]
            bench.check(listed == names[:limit or 4], f"{first}, {limit}: {listed}")
            lost = [one["object"] for group in out[0]["lost"] if group["reason"] == "list_limit"
                    for one in group["echoes"]]
            bench.check(sorted(lost) == sorted(names[limit or 4:]), f"{first}, {limit}: lost {lost}")
            without = check_switch(bench, frames, [radar], "list_limit", out)
            bench.check(len(without[0]["targets"]) == 4, "the list limit is not off")


def alternatives(bench):
    """glint-noise-none and glint-noise-gauss simulate none of these effects."""
    frames = frames_of([pole()], 50)
    radar = snr_sensor("s", 20, misalignment_rad=0.1, false_alarms=5, false_alarm_range_rate_mps=5, azimuth_sigma_rad=0,
                       range_step_m=0.5)
    path = bench.write_suite(suite_of(radar))
    cells = bench.through(frames, ["glint-extract"], ["glint-ideal", "--sensors", path, "--sections", "account"], ["glint-sensor"])
    for name in ("glint-noise-none", "glint-noise-gauss"):
        for targets in (frame["targets"] for frame in bench.through(cells, [name])):
            bench.check(len(targets) == 1 and all(targets[0][key] == targets[0]["cell_" + key] for key in PLACE),
                        f"{name}: {targets}")


CHECKS = [
    ("the stronger an echo, the better its range", accuracy_by_snr),
    ("accuracy is the formula's for every draw", accuracy_to_the_last_digit),
    ("range noise has the sigmas of the document", range_noise),
    ("angle noise is the dipole pair's", angle_noise),
    ("a floor of the angle adds in quadrature", angle_floor),
    ("a sensor that looks aside reports aside", misalignment),
    ("a bumper bends by a sine of the azimuth", radome),
    ("the standing world contradicts a yaw error", standing_world),
    ("false alarms are Poisson counts", false_alarm_counts),
    ("false alarms are anywhere, just above the threshold", false_alarm_values),
    ("false alarms of shipped suites are as strong as noise above a threshold", shipped_false_alarms),
    ("false alarms are labelled and accounted for", false_alarm_labels),
    ("the final threshold lets through what theory says", final_threshold),
    ("a steady echo is detected as often as Marcum's function says", detection_in_noise),
    ("rounding errors are even within a step", quantisation),
    ("a short list keeps the nearest or the strongest", list_limit),
    ("other models of noise have none of this", alternatives),
]


if __name__ == "__main__":
    model.run(__doc__, model.add_shipped_vehicles, CHECKS)
