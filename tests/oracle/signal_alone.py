"""glint-sensor-signal against a radar that this file simulates by itself, from the delays of moving points.

Usage: /usr/bin/python3 tests/oracle/signal_alone.py BIN_DIR [--long]

Exit status 1 if any check fails; 0, with a message, if the build has no such stage. The other oracles and the
programs share no formula with this file. --long counts more noise, and more points of the shipped suites.
"""

import itertools
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests/support"), str(ROOT / "scripts")]
import glint  # noqa: E402
import suites  # noqa: E402
from sizes import quick  # noqa: E402

C = 299792458.0
QUIET = "all,-angle_noise"
PADDING = 2  # cells of the transforms to a bin
SEED = 14
FAST = 4e12  # Hz/s: chirps of 20 us with the cells of lrr77
# How near the parabola of MODEL 11.3 comes to the summit of a spectrum, in cells and dB; shipped suites have Hann's
# window.
NEAR = {"hann": (0.005, 0.05), "rectangular": (0.011, 0.12)}
EGO = {"id": "ego", "class": "car", "length_m": 4, "width_m": 2, "height_m": 1,
       **dict.fromkeys(("x_m", "y_m", "yaw_rad", "vx_mps", "vy_mps", "yaw_rate_radps", "travelled_m"), 0)}
# A frame of the ego alone, but for its seed.
HEAD = {"version": 1, "scene": "scene", "frame": 0, "time_s": 1, "interval_s": 1, "last": True, "ego": "ego", "objects": [EGO]}


# ---- a radar, from its waves ------------------------------------------------------------------


class Radar:
    """What a radar transmits, when it samples, and how it transforms. Times count from the instant of the
    measurement, those of samples (`fast`) from the middle of a chirp or from the start of a pulse."""

    def __init__(self, sensor):
        wave = sensor["waveform"]
        self.carrier, self.cell, self.rate_cell = (sensor[key] for key in (
            "carrier_hz", "cell_range_m", "cell_range_rate_mps"))
        self.samples, self.repetitions, self.window = wave["samples"], wave["repetitions"], wave.get("window", "hann")
        self.pulsed, self.folds = wave["kind"] == "pulse", wave.get("stagger", 1)
        self.dwell = C / self.carrier / (2 * self.rate_cell)
        self.starts = centred(self.repetitions) * self.dwell
        self.second = (0.5 + (1 + 1 / self.folds) * np.arange(self.repetitions) / self.repetitions) * self.dwell
        self.bin = self.cell / 4 if self.pulsed else self.cell
        if self.pulsed:
            self.fast = np.arange(self.samples) * self.bin * 2 / C
            return
        self.slope = sensor.get("chirp_slope_hzps", C / (2 * self.cell) / (self.dwell / self.repetitions))
        self.chirp = C / (2 * self.cell) / self.slope
        self.fast = centred(self.samples) * self.chirp

    def delay(self, time, place, rate):
        """Of a wave that is received at this time from a point that is at this place at time 0. It left the
        point half of its delay ago, so delay = 2 (place + rate (time - delay/2))/c."""
        return 2 * (place + rate * time) / (C + rate)

    def phase(self, time):
        """Of a transmitted chirp, in cycles, from its middle on."""
        return self.carrier * time + self.slope * time * time / 2

    def receive(self, places, rates, fast=None, starts=None):
        """Samples of points of amplitude 1: points by repetitions by samples, or at other times than those."""
        fast, starts = self.fast if fast is None else fast, self.starts if starts is None else starts
        place, rate = (np.asarray(one, float)[..., None, None] for one in (places, rates))
        delay = self.delay(starts[:, None] + fast, place, rate)
        if self.pulsed:
            # The matched filter's answer to a Gaussian pulse, half as high half a cell beside its place.
            return np.exp2(-(((fast - delay) * C / self.cell) ** 2)) * np.exp(-2j * np.pi * self.carrier * delay)
        return np.exp(2j * np.pi * (self.phase(fast - delay) - self.phase(fast)))

    def weights(self, count):
        """Hann's window, or none, of sum 1."""
        raised = np.sin(np.pi * np.arange(count) / count) ** 2 if self.window == "hann" else np.ones(count)
        return raised / raised.sum()

    def coupling(self, rate):
        """How much too far away a chirp shows a point, as the Doppler shift adds to the beat."""
        return 0 if self.pulsed else self.carrier * rate / self.slope

    def spectrum(self, samples, bins, rate_bins):
        """The transform of samples at any places, in bins; pulses have none along range."""
        slow = np.exp(2j * np.pi * np.outer(rate_bins, centred(self.repetitions))) * self.weights(self.repetitions)
        if self.pulsed:
            return slow @ samples
        return slow @ samples @ (np.exp(2j * np.pi * np.outer(bins, centred(self.samples)))
                                 * self.weights(self.samples)).T

    def ranges(self, samples):
        """The transform along range, where there is one."""
        if self.pulsed:
            return samples
        count = PADDING * self.samples
        return np.fft.ifft(samples * self.weights(self.samples), count, axis=-1) * count

    def map(self, samples):
        """Power over rate and range: of a point of amplitude 1 in its cell, 1."""
        count = PADDING * self.repetitions
        weighed = self.ranges(samples) * self.weights(self.repetitions)[:, None]
        return np.abs(np.fft.ifft(weighed, count, axis=-2) * count) ** 2

    def noise(self, draw, shape):
        """Samples of noise that has power 1 in a cell of the map; that of pulses went through their filter, so that
        it is correlated as an echo is wide."""
        values = draw.standard_normal(shape) + 1j * draw.standard_normal(shape)
        gain = 2 * (self.weights(self.repetitions) ** 2).sum()
        if not self.pulsed:
            return values / math.sqrt(gain * (self.weights(self.samples) ** 2).sum())
        taps = np.exp2(-np.arange(-6, 7) ** 2 / 2.0)
        filtered = sum(tap * np.roll(values, i, -1) for i, tap in enumerate(taps))
        return filtered / math.sqrt(gain * (taps ** 2).sum())

    def lobe(self, bins):
        """The transform of a point, so many bins beside it."""
        return np.sinc(bins) / (1 - bins * bins) if self.window == "hann" else np.sinc(bins)


def centred(count):
    return np.arange(count) / count - 0.5


def summit(radar, place, rate):
    """Where the spectrum of one point is highest, in bins of range and rate, and its level there."""
    bins, rates = (place + radar.coupling(rate)) / radar.bin, rate / radar.rate_cell
    samples = None if radar.pulsed else radar.receive(place, rate)
    step = 0.5
    while step > 1e-5:
        grid = np.arange(-4, 5) * step
        if radar.pulsed:
            samples = radar.receive(place, rate, (bins + grid) * radar.bin * 2 / C)
        near = np.abs(radar.spectrum(samples, bins + grid, rates + grid))
        row, column = np.unravel_index(near.argmax(), near.shape)
        rates, bins, step = rates + grid[row], bins + grid[column], step / 2
    return bins, rates, near.max()


def vertex(powers):
    """Of the parabola through the logarithms of three powers, in cells from the middle one."""
    low, middle, high = np.log(powers)
    return (high - low) / (4 * middle - 2 * low - 2 * high)


def read(radar, power, peak=None):
    """What MODEL 11.3 reads off a peak of a map, the highest by default: bins of range and rate, and amplitude."""
    row, column = peak or np.unravel_index(power.argmax(), power.shape)
    rows, columns = power.shape
    off_rate = vertex([power[(row + i) % rows, column] for i in (-1, 0, 1)]) / PADDING
    off = vertex([power[row, (column + i) % columns] for i in (-1, 0, 1)])
    if radar.pulsed:
        lobe = 2 ** -((off / 2) ** 2)
    else:
        off /= PADDING
        lobe = radar.lobe(off)
    amplitude = math.sqrt(power[row, column]) / lobe / radar.lobe(off_rate)
    return column / (1 if radar.pulsed else PADDING) + off, row / PADDING + off_rate, amplitude


def around(power, steps_of_rate, steps):
    return np.roll(power, (steps_of_rate, steps), (-2, -1))


def are_peaks(power):
    """Is a cell above all of its eight neighbours?"""
    best = np.ones(power.shape, bool)
    for a, b in ((a, b) for a in (-1, 0, 1) for b in (-1, 0, 1) if a or b):
        best &= power > around(power, a, b)
    return best


def passes(radar, power, places, detector):
    """Do the cells at these places of maps exceed what their neighbours along range rate say of the noise?"""
    apart = 3 if radar.window == "hann" else 1
    steps = [sign * PADDING * (detector["guard"] + 1 + i * apart) for i in range(detector["cells"] // 2)
             for sign in (-1, 1)]
    scan, row, column = places
    neighbours = power[scan, (row + np.array(steps)[:, None]) % power.shape[1], column]
    if detector["cfar"] == "mean":
        return power[places] > detector["factor"] * neighbours.mean(0)
    return power[places] > detector["factor"] * np.partition(neighbours, detector["rank"] - 1, 0)[detector["rank"] - 1]


def detector_of(sensor):
    """The detector that a waveform describes, with the factor of MODEL 11.4."""
    wave = sensor["waveform"]
    cells, rank, probability = wave["cfar_cells"], wave["cfar_rank"], wave["cfar_false_alarm"]
    if wave["cfar"] == "mean":
        factor = cells * (probability ** (-1 / cells) - 1)
    else:
        factor, high = 0.0, 1e4
        for _ in range(100):
            middle = (factor + high) / 2
            passed = math.prod((cells - i) / (cells - i + middle) for i in range(rank))
            factor, high = (middle, high) if passed > probability else (factor, middle)
    return {"cfar": wave["cfar"], "cells": cells, "guard": 2, "rank": rank, "factor": factor}


# ---- the program ------------------------------------------------------------------------------


class Program:
    """glint-sensor-signal, and what was found wrong with it."""

    def __init__(self, bin_dir, scratch):
        self.bin, self.scratch, self.failures, self.checks = Path(bin_dir).resolve(), Path(scratch), 0, 0

    def run(self, text, data):
        done = subprocess.run([str(self.bin / "glint"), "-c", text], input=data, text=True, capture_output=True,
                              check=False, cwd=self.scratch,
                              env={"GLINT_DATA": str(ROOT / "data"), "PATH": str(self.bin)})
        if done.returncode:
            raise SystemExit(f"{text}: exit status {done.returncode}\n{done.stderr}")
        return [glint.name_lost(json.loads(line)) for line in done.stdout.splitlines()]

    def targets(self, sensor, scans, effects=QUIET, stages="glint-sensor-signal"):
        """The targets of scans, each of which is a list of points (range, rate, ERCS) on boresight."""
        suite = self.scratch / "suite.json"
        suite.write_text(json.dumps({"origin": "Made by tests/oracle/signal_alone.py.", "sensors": [sensor]}))
        empty, = self.run(f"glint-extract | glint-ideal --sensors {suite} --effects {effects}", json.dumps(HEAD | {"seed": str(SEED)}))
        lines = []
        for number, points in enumerate(scans):
            echoes = [{"sensor": sensor["name"], "object": "point", "reflector": str(n), "path": "direct",
                       "range_m": place, "azimuth_rad": 0, "range_rate_mps": rate, "ercs": ercs, "time_s": 1}
                      for n, (place, rate, ercs) in enumerate(points)]
            lines.append(json.dumps(dict(empty, scene=f"scene {number}", echoes=echoes)) + "\n")
        return [frame.get("targets", []) for frame in self.run(stages, "".join(lines))]

    def check(self, good, message):
        self.checks += 1
        if not good:
            self.failures += 1
            print(f"  FAIL: {message}")

    def end(self, title):
        print(f"{title}: {self.checks} checks", flush=True)
        self.checks = 0


def shipped(name):
    """The first sensor of a shipped suite, whose amplitudes hardly depend on range here, without false alarms."""
    sensor = suites.whole(name)["sensors"][0]
    for table in {"antenna_table", "azimuth_curve"} & sensor.keys():
        sensor[table] = str(ROOT / "data/sensors" / sensor[table])
    return dict(sensor, exponent=0.1, cell_phase="random", list_limit=0, false_alarms=0)


def small(kind, window, **changes):
    """A radar of few samples, with the cells of srr24-signal."""
    sensor = shipped("srr24-signal")
    sensor["waveform"] = {"kind": kind, "samples": {"chirp": 32, "pulse": 80}[kind], "repetitions": 32,
                          "window": window, "cfar": "ordered", "cfar_cells": 8, "cfar_rank": 6,
                          "cfar_false_alarm": 1e-4}
    return dict(sensor, range_min_m=0, range_max_m={"chirp": 9.6, "pulse": 6.0}[kind], **changes)


# ---- what is checked --------------------------------------------------------------------------


def level_of(radar, place, rate, bins, rate_bins):
    return radar.spectrum(radar.receive(place, rate), [bins], [rate_bins])[0, 0]


def closed_forms(program, _):
    """The simulator: place and level of a point, between bins, of two in phase, and of one that walks."""
    lobes = {"hann": (0.848826, 0.169765), "rectangular": (0.636620, 0.212207)}  # sin(x)/x, over 1 - d^2 with Hann
    for window, lobe in lobes.items():
        fine = {"kind": "chirp", "samples": 256, "repetitions": 256, "window": window}
        radar = Radar(dict(small("chirp", window), waveform=fine))
        for place, rate in ((5.0, 0.0), (5.13, 1.2), (6.1, -3.3)):
            bins, rates, level = summit(radar, place, rate)
            off = bins - (place + radar.coupling(rate)) / radar.cell, rates - rate / radar.rate_cell
            program.check(max(map(abs, off)) < 1e-3 and abs(level - 1) < 3e-3, f"{window}: {off}, {level}")
        for distance, expected in zip((0.5, 1.5), lobe):
            value = abs(level_of(radar, 17 * radar.cell, 0, 17 + distance, 0))
            program.check(abs(value - expected) < 1e-4, f"{window}: {value} at {distance} bins")
    places = 17 * radar.cell, 18 * radar.cell
    radar.window = "hann"
    pair = [level_of(radar, place, 0, 17.5, 0) / level_of(radar, place, 0, place / radar.cell, 0) for place in places]
    program.check(abs(20 * math.log10(abs(sum(pair))) - 4.60) < 0.005, f"a pair in phase: {pair}")
    # Without a window, at its place: 2/(pi K) times the sine integral of pi K/2; Si(pi) = 1.851937.
    radar.window, rate = "rectangular", 2 * radar.cell / radar.dwell
    value = abs(level_of(radar, 5.0, rate, (5.0 + radar.coupling(rate)) / radar.cell, rate / radar.rate_cell))
    program.check(abs(value - 1.851937 / math.pi) < 1e-3, f"walking two cells: {value}")
    pulse = Radar(small("pulse", "hann"))
    bins, rates, level = summit(pulse, 5.13, 0.2)
    program.check(abs(bins * pulse.bin - 5.13) < 1e-4 and abs(rates - 0.4) < 1e-4 and abs(level - 1) < 1e-3, "a pulse")


def differences(radar, found, bins, rates, level):
    """Of a target's range and rate from these places, in cells, and of its level from this one, in dB."""
    half = radar.repetitions / 2
    place = found["range_m"] + radar.coupling(found["range_rate_mps"])
    return (abs(place - bins * radar.bin) / radar.cell,
            abs((found["range_rate_mps"] / radar.rate_cell - rates + half) % (2 * half) - half),
            abs(found["amplitude_db"] - 20 * math.log10(found["cell_amplitude"] * level)))


def compare(program, name, sensor, points):
    """Targets of lone points have the places and levels that MODEL reads off the simulation, and, where they walk
    less than half a cell in a scan, those of the spectrum's summit."""
    radar, worst = Radar(sensor), np.zeros((2, 3))
    for (place, rate, _), found in zip(points, program.targets(sensor, [[point] for point in points])):
        where = f"{name}: {place:.3f} m, {rate:.3f} m/s"
        walk = abs(rate) * radar.dwell / radar.cell
        # Without a window an echo that walks has side ridges, which are peaks of their own.
        alone = len(found) == 1 or (found and radar.window != "hann" and walk > 0.5)
        program.check(alone, f"{where}: {len(found)} targets")
        if not found:
            continue
        one = max(found, key=lambda one: one["amplitude_db"])
        off = differences(radar, one, *read(radar, radar.map(radar.receive(place, rate))))
        program.check(max(off[:2]) < 0.002 and off[2] < 0.02, f"{where}: off the reading by {off}")
        worst[0] = np.maximum(worst[0], off)
        if radar.folds > 1:
            program.check(abs(one["range_rate_mps"] - rate) < radar.rate_cell, f"{where}: unfolded to {one}")
        if walk < 0.5:
            off = differences(radar, one, *summit(radar, place, rate))
            program.check(max(off[:2]) < NEAR[radar.window][0] and off[2] < NEAR[radar.window][1],
                          f"{where}: off the summit by {off}")
            worst[1] = np.maximum(worst[1], off)
    print(f"  {name}: {worst.round(4).tolist()} cells in range, cells in rate, dB", flush=True)


def lone_points(program, long):
    """Everywhere in a cell, at rates from 0 to 50 m/s, with every window; and with the shipped waveforms, one of
    them also with fast chirps; in the quick run the small ones."""
    draw = np.random.default_rng(SEED)
    for kind in ("chirp", "pulse"):
        for window in ("hann", "rectangular"):
            sensor = small(kind, window, range_migration=window)
            rates = np.concatenate([draw.uniform(-1, 1, 20), draw.uniform(-10, 10, 20), draw.uniform(-50, 50, 10)])[::quick(3, 1)]
            compare(program, f"{kind}, {window}", sensor, [(draw.uniform(2.5, 3.5), rate, 1e3) for rate in rates])
    for name, count, slope in (("lrr77-signal-small", 20, None), ("lrr77-signal-small", 20, FAST),
                               ("lrr77-signal-small", 20, -FAST), ("srr24-signal", 20, None),
                               ("lrr77-signal-medium", 8, None), ("lrr77-signal-large", 4, None))[:quick(4, 6)]:
        sensor = dict(shipped(name), **({"chirp_slope_hzps": slope} if slope else {}))
        points = [(draw.uniform(0.3, 0.7) * sensor["range_max_m"], draw.uniform(-50, 50), 1e3)
                  for _ in range(count * (5 if long else 1))]
        compare(program, f"{name}, {slope:g} Hz/s" if slope else name, sensor, points)


def walk(radar, rate):
    """The level, in dB, and the -6 dB widths in range and rate, in bins, of the highest peak of a point."""
    samples, cells = radar.receive(20, rate), abs(rate) * radar.dwell / radar.cell
    bins, rates = (20 + radar.coupling(rate)) / radar.bin, rate / radar.rate_cell
    grid = np.arange(-cells / 2 - 2, cells / 2 + 2, 1 / 16)
    near = np.abs(radar.spectrum(samples, bins + grid, rates + grid))
    row, column = np.unravel_index(near.argmax(), near.shape)
    widths, fine = [], np.arange(-cells - 2, cells + 2, 1 / 64)
    for cut in (radar.spectrum(samples, bins + grid[column] + fine, [rates + grid[row]])[0],
                radar.spectrum(samples, [bins + grid[column]], rates + grid[row] + fine)[:, 0]):
        below = np.nonzero(np.abs(cut) < near.max() / 2)[0] - len(fine) // 2
        widths.append((below[below > 0].min() - below[below < 0].max() - 1) / 64)
    return 20 * math.log10(near.max()), widths


def walks(program, _):
    """Echoes that walk through cells fade and widen in glint-sensor as in the simulation, within 0.5 dB and 0.5
    cells (MODEL 14.20)."""
    for window, resolution in (("hann", 1.7748), ("rectangular", 0.9967)):
        sensor = dict(shipped("lrr77-signal-small"), range_migration=window, cell_phase="in_phase")
        sensor["waveform"].update(samples=128, repetitions=128, window=window)
        radar, worst, apart = Radar(sensor), [0.0, 0.0], np.arange(0.4, 12, 0.04)
        _, (still, _) = walk(radar, 0)
        for cells in np.arange(0, 10.1, 0.5):
            rate = cells * radar.cell / radar.dwell
            level, widths = walk(radar, rate)
            scans = [[(20, 0, 1e3)], [(20, rate, 1e3)]]
            scans += [[(20, rate, 1e3), (20 + d * radar.cell, rate, 1e3)] for d in apart]
            alone, walking, *two = program.targets(sensor, scans, "all", "glint-sensor | glint-noise-none")
            loss = walking[0]["amplitude_db"] - alone[0]["amplitude_db"]
            # Echoes of one cell are at most the resolution apart, which grows as the width does.
            wide = apart[np.array([len(one) for one in two]) == 1].max() / resolution * still
            worst = np.maximum(worst, [abs(loss - level), max(abs(wide - width) for width in widths)])
        print(f"  {window}: up to {worst[0]:.2f} dB and {worst[1]:.2f} cells off")
        program.check(worst[0] < 0.5 and worst[1] < 0.5, f"{window}: walking echoes are {worst} off")


def are_two(radar, samples, detector=None):
    """Has a scan two peaks that are less than 6 dB apart, and are detected?"""
    power = radar.map(samples)
    places = np.nonzero(are_peaks(power) & (power > power.max((-2, -1), keepdims=True) / 4))
    if detector:
        kept = passes(radar, power, places, detector)
        places = [one[kept] for one in places]
    return np.bincount(places[0], minlength=len(power)) == 2


def two_listed(targets):
    levels = sorted((one["amplitude_db"] for one in targets), reverse=True) + [-math.inf] * 3
    return levels[1] > levels[0] - 20 * math.log10(2) > levels[2]


def pairs(program, _):
    """Equal points of random phases, without noise and 20 dB above it, are two as often as in the simulation,
    within 3 sigma of 1,000 pairs."""
    draw, count, batch = np.random.default_rng(SEED), 1000, 50
    for kind, window, axis, noisy in (("chirp", "hann", 0, False), ("chirp", "hann", 1, True),
                                      ("chirp", "rectangular", 0, False), ("chirp", "rectangular", 1, True),
                                      ("pulse", "hann", 1, True)):
        sensor = small(kind, window, pointer_sigma=1)
        radar, detector, ercs = Radar(sensor), detector_of(sensor) if noisy else None, 10 / strength(sensor, 3)
        for bins in (1, 1.5, 2, 2.5):
            name = f"{kind}, {window}, {bins} bins in {'rate' if axis else 'range'}{', noise' if noisy else ''}"
            first = draw.uniform(3, 3.3, count), draw.uniform(0, 0.5, count)
            second = first[0] + (1 - axis) * bins * radar.cell, first[1] + axis * bins * radar.rate_cell
            turn, two = np.exp(2j * np.pi * draw.uniform(size=(count, 1, 1))), 0
            for i in range(0, count, batch):
                a, b, c, d = (one[i:i + batch] for one in (*first, *second))
                samples = radar.receive(a, b) + turn[i:i + batch] * radar.receive(c, d)
                if noisy:
                    samples += 0.1 * radar.noise(draw, samples.shape)
                two += are_two(radar, samples, detector).sum()
            scans = [[(a, b, ercs), (c, d, ercs)] for a, b, c, d in zip(*first, *second)]
            found = program.targets(sensor, scans, "all" if noisy else QUIET)
            share, expected = np.mean([two_listed(one) for one in found]), two / count
            bound = three_sigma(expected, count)
            print(f"  {name}: {share:.3f} are two, simulated {expected:.3f}")
            program.check(abs(share - expected) < bound, f"{name}: {share} are two, simulated {expected} +- {bound}")


def strength(sensor, place):
    """The amplitude of an ERCS of 1 at this place on boresight (MODEL 4)."""
    threshold = 10 ** (sensor["threshold_db"] / 20)
    return threshold / sensor["calibration_ercs"] * (sensor["calibration_range_m"] / place) ** sensor["exponent"]


def three_sigma(share, count):
    """Of the share that so many draws have; a share of 0 or 1 may be missed by three of them."""
    return 3 * math.sqrt(max(share * (1 - share), 1 / count) / count)


def unfold(radar, sensor, reading, second):
    """The rate that MODEL 11.3 gives to a peak, read off the first train, by samples of the second."""
    bins, rates, amplitude = reading
    span = radar.repetitions * radar.rate_cell
    folded = (rates * radar.rate_cell + span / 2) % span - span / 2
    ranges, times, best = radar.ranges(second), radar.second, (math.inf, math.nan)
    for rate in folded + span * np.arange(-radar.folds, radar.folds + 1):
        place = bins * radar.bin - radar.coupling(rate)
        inside = sensor["range_min_m"] - radar.cell / 2 <= place <= sensor["range_max_m"] + radar.cell / 2
        if not inside or abs(rate) > radar.folds * span / 2:
            continue
        by_then = (bins * radar.bin + rate * times.mean()) / radar.bin * (1 if radar.pulsed else PADDING)
        column = ranges[:, round(by_then) % ranges.shape[1]]
        turned = column * np.exp(4j * np.pi * radar.carrier * rate * times / C)
        best = min(best, (abs(abs(turned @ radar.weights(radar.repetitions)) - amplitude), rate))
    return best[1]


def unfolding(program, _):
    """Of detected points with rates up to 60 m/s as many are unfolded right as in the simulation."""
    draw, count = np.random.default_rng(SEED), 700
    sensor = dict(shipped("lrr77-signal-small"), range_max_m=57, pointer_sigma=1)
    sensor["waveform"].update(samples=32, cfar_cells=16, cfar_rank=12, cfar_false_alarm=1e-4)
    radar, detector, span = Radar(sensor), detector_of(sensor), 64 * sensor["cell_range_rate_mps"]
    for ratio in (11, 14):
        places, rates, amplitude = draw.uniform(20, 40, count), draw.uniform(-60, 60, count), 10 ** (ratio / 20)
        tried = right = 0
        for place, rate in zip(places, rates):
            samples = [amplitude * radar.receive(place, rate, starts=starts) for starts in (radar.starts, radar.second)]
            first, second = (one + radar.noise(draw, one.shape) for one in samples)
            reading = strongest(radar, radar.map(first), detector)
            if reading and near_fold(reading[1] * radar.rate_cell, rate, span):
                tried += 1
                right += abs(unfold(radar, sensor, reading, second) - rate) < span / 4
        scans = [[(place, rate, amplitude / strength(sensor, place))] for place, rate in zip(places, rates)]
        found = [one["range_rate_mps"] - rate for scan, rate in zip(program.targets(sensor, scans, "all"), rates)
                 for one in sorted(scan, key=lambda one: -one["amplitude_db"])[:1]
                 if near_fold(one["range_rate_mps"], rate, span)]
        shares = np.mean([abs(off) < span / 4 for off in found]), right / tried
        print(f"  {ratio} dB: {shares[0]:.3f} of {len(found)} unfolded right, simulated {shares[1]:.3f} of {tried}")
        program.check(abs(shares[0] - shares[1]) < math.sqrt(2) * three_sigma(shares[1], tried), "unfolded right")
        shares = len(found) / count, tried / count
        program.check(abs(shares[0] - shares[1]) < math.sqrt(2) * three_sigma(shares[1], count), f"detected: {shares}")


def strongest(radar, power, detector):
    """The reading of the highest peak that is detected, if any is."""
    peaks = np.nonzero(are_peaks(power[None]))
    _, rows, columns = (one[passes(radar, power[None], peaks, detector)] for one in peaks)
    if not len(rows):
        return None
    best = power[rows, columns].argmax()
    return read(radar, power, (rows[best], columns[best]))


def near_fold(rate, true, span):
    return abs((rate - true + span / 2) % span - span / 2) < 0.2


def alarms(program, long):
    """Noise passes the threshold of MODEL 11.4 with the probability that it states, in cells of the unpadded grid,
    and the program lists as many peaks of noise as the simulation."""
    draw, shape = np.random.default_rng(SEED), (50, 64, 32)
    probability, least = (1e-4, 2e7) if long else (1e-2, 2e5)
    for window, cfar in itertools.product(("hann", "rectangular"), ("ordered", "mean")):
        sensor = small("chirp", window, pointer_sigma=1)
        sensor["waveform"].update(repetitions=shape[1], cfar_cells=16, cfar_rank=12, cfar=cfar,
                                  cfar_false_alarm=probability)
        radar, detector, passed, listed, cells = Radar(sensor), detector_of(sensor), 0, 0, 0
        bins = np.nonzero(np.ones(shape, bool))
        bins = bins[0], bins[1] * PADDING, bins[2] * PADDING
        while cells < least:
            power = radar.map(radar.noise(draw, shape))
            passed += passes(radar, power, bins, detector).sum()
            listed += passes(radar, power, np.nonzero(are_peaks(power)), detector).sum()
            cells += math.prod(shape)
        name, share = f"{window}, {cfar}", passed / cells / probability
        found = sum(map(len, program.targets(sensor, [[]] * (cells // math.prod(shape[1:])), "all")))
        print(f"  {name}: in {cells} cells {share:.3f} of the nominal; {found} listed, simulated {listed}", flush=True)
        program.check(abs(share - 1) < 0.1, f"{name}: noise passes {share} as often as nominal")
        bound = 4 * math.sqrt(2 * listed)
        program.check(abs(found - listed) < bound, f"{name}: {found} alarms, simulated {listed} +- {bound}")


def main():
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--long"]):
        sys.exit(__doc__.split("\n\n")[1])
    if not (Path(sys.argv[1]) / "glint-sensor-signal").exists():
        print("skipped  the signal alone: there is no glint-sensor-signal")
        return
    with tempfile.TemporaryDirectory() as scratch:
        program = Program(sys.argv[1], scratch)
        for title, group in (("closed forms of the simulation", closed_forms), ("lone points", lone_points),
                             ("pairs", pairs), ("walks", walks), ("unfolding", unfolding), ("alarms", alarms)):
            group(program, bool(sys.argv[2:]))
            program.end(title)
        sys.exit(1 if program.failures else 0)


if __name__ == "__main__":
    main()
