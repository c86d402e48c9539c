"""glint-sensor-signal against a radar that this file simulates by itself, from the delays of moving points.

Usage: /usr/bin/python3 tests/oracle/signal_alone.py BIN_DIR [--long]

Exit status 1 if any check fails; 0, with a message, if the build has no such stage. The other oracles and the
programs share no formula with this file. --long counts more noise, and more points of the shipped suites.
"""

import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

C = 299792458.0
ROOT = Path(__file__).resolve().parents[2]
QUIET = "all,-angle_noise"
PADDING = 1  # bins of the transforms to a resolution cell
SEED = 14
# Factors of MODEL 11.4 for a false alarm in 1000, 16 neighbours, and the 12th of them.
# Lone points are compared if they walk no farther than this in a scan, in cells: beyond, interpolation between bins
# that takes no account of the walk is what differs.
WALK = {"hann": 0.6, "rectangular": 0.1}
FACTORS = {(window, cfar): factor for window in ("hann", "rectangular")
           for cfar, factor in (("ordered", 7.421411), ("mean", 8.638824))}


# ---- a radar, from its waves ------------------------------------------------------------------


class Radar:
    """What a radar transmits, when it samples, and how it transforms. Times count from the scan's middle, those
    of samples (`fast`) from the middle of a chirp or from the start of a pulse."""

    def __init__(self, sensor):
        wave = sensor["waveform"]
        self.carrier, self.cell, self.rate_cell = (sensor[key] for key in (
            "carrier_hz", "cell_range_m", "cell_range_rate_mps"))
        self.samples, self.repetitions, self.window = wave["samples"], wave["repetitions"], wave.get("window", "hann")
        self.pulsed = wave["kind"] == "pulse"
        self.dwell = C / self.carrier / (2 * self.rate_cell)
        self.starts = centred(self.repetitions) * self.dwell
        self.bin = self.cell / 4 if self.pulsed else self.cell
        if self.pulsed:
            self.fast = np.arange(self.samples) * self.bin * 2 / C
        else:
            self.chirp = sensor.get("chirp_s", self.dwell / self.repetitions)
            self.slope = C / (2 * self.cell) / self.chirp
            self.fast = centred(self.samples) * self.chirp

    def delay(self, time, place, rate):
        """Of a wave that is received at this time from a point that is at this place at time 0. It left the
        point half of its delay ago, so delay = 2 (place + rate (time - delay/2))/c."""
        return 2 * (place + rate * time) / (C + rate)

    def phase(self, time):
        """Of a transmitted chirp, in cycles, from its middle on."""
        return self.carrier * time + self.slope * time * time / 2

    def receive(self, places, rates, fast=None):
        """Samples of points of amplitude 1: points by repetitions by samples, or by these times instead."""
        fast = self.fast if fast is None else fast
        place, rate = (np.asarray(one, float)[..., None, None] for one in (places, rates))
        delay = self.delay(self.starts[:, None] + fast, place, rate)
        if self.pulsed:
            # The matched filter's answer to a Gaussian pulse, half as high half a cell beside its place.
            return np.exp2(-(((fast - delay) * C / self.cell) ** 2)) * np.exp(-2j * np.pi * self.carrier * delay)
        return np.exp(2j * np.pi * (self.phase(fast - delay) - self.phase(fast)))

    def weights(self, count):
        """Hann's window, or none, of sum 1, about the middle of the samples."""
        raised = np.sin(np.pi * (centred(count) + 0.5)) ** 2 if self.window == "hann" else np.ones(count)
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

    def map(self, samples):
        """Power over rate and range on a grid of 1/PADDING bins; noise of power 1 in a sample has power 1."""
        shape = [PADDING * self.repetitions, self.samples if self.pulsed else PADDING * self.samples]
        weights = self.weights(self.repetitions)[:, None]
        if not self.pulsed:
            weights = weights * self.weights(self.samples)
        values = np.fft.ifft(samples * weights, shape[0], axis=-2) * shape[0]
        if not self.pulsed:
            values = np.fft.ifft(values, shape[1], axis=-1) * shape[1]
        return np.abs(values) ** 2 / (weights ** 2).sum()


def centred(count):
    return (np.arange(count) - (count - 1) / 2) / count


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


def around(power, steps_of_rate, steps):
    return np.roll(power, (steps_of_rate, steps), (-2, -1))


def are_peaks(power):
    """Is a sample above all of its eight neighbours?"""
    best = np.ones(power.shape, bool)
    for a, b in ((a, b) for a in (-1, 0, 1) for b in (-1, 0, 1) if a or b):
        best &= power > around(power, a, b)
    return best


def noise_level(power, cfar, cells=16, guard=2, rank=12):
    """What the neighbours along range rate say of the noise: their mean, or the one of this rank."""
    steps = [sign * PADDING * (guard + 1 + i) for i in range(cells // 2) for sign in (-1, 1)]
    neighbours = np.array([around(power, step, 0) for step in steps])
    return neighbours.mean(0) if cfar == "mean" else np.partition(neighbours, rank - 1, axis=0)[rank - 1]


# ---- the program ------------------------------------------------------------------------------


class Program:
    """glint-sensor-signal, and what was found wrong with it."""

    def __init__(self, bin_dir, scratch):
        self.bin, self.scratch, self.failures, self.checks = Path(bin_dir).resolve(), Path(scratch), 0, 0

    def run(self, text, data):
        done = subprocess.run([str(self.bin / "glint"), "-c", text], input=data, text=True, capture_output=True,
                              check=False, env={"GLINT_DATA": str(ROOT / "data"), "PATH": str(self.bin)})
        if done.returncode:
            raise SystemExit(f"{text}: exit status {done.returncode}\n{done.stderr}")
        return [json.loads(line) for line in done.stdout.splitlines()]

    def targets(self, sensor, scans, effects=QUIET):
        """The targets of scans, each of which is a list of points (range, rate, ERCS) on boresight."""
        suite = self.scratch / "suite.json"
        suite.write_text(json.dumps({"origin": "Made by tests/oracle/signal_alone.py.", "sensors": [sensor]}))
        ego = {"id": "ego", "class": "car", "length_m": 4, "width_m": 2, "height_m": 1,
               **dict.fromkeys(("x_m", "y_m", "yaw_rad", "vx_mps", "vy_mps", "yaw_rate_radps", "travelled_m"), 0)}
        head = {"version": 0, "scene": "scene", "frame": 0, "time_s": 1, "interval_s": 1, "last": True,
                "seed": str(SEED), "ego": "ego", "objects": [ego]}
        empty, = self.run(f"glint-extract | glint-ideal --sensors {suite} --effects {effects}", json.dumps(head))
        lines = []
        for number, points in enumerate(scans):
            echoes = [{"sensor": sensor["name"], "object": "point", "reflector": str(n), "path": "direct",
                       "range_m": place, "azimuth_rad": 0, "range_rate_mps": rate, "ercs": ercs, "time_s": 1}
                      for n, (place, rate, ercs) in enumerate(points)]
            lines.append(json.dumps(dict(empty, scene=f"scene {number}", echoes=echoes)) + "\n")
        return [frame.get("targets", []) for frame in self.run("glint-sensor-signal", "".join(lines))]

    def check(self, good, message):
        self.checks += 1
        if not good:
            self.failures += 1
            print(f"  FAIL: {message}")

    def end(self, title):
        print(f"{title}: {self.checks} checks", flush=True)
        self.checks = 0


def shipped(name):
    """The first sensor of a shipped suite, whose amplitudes hardly depend on range here."""
    sensor = json.loads((ROOT / f"data/sensors/{name}.json").read_text())["sensors"][0]
    if "antenna_table" in sensor:
        sensor["antenna_table"] = str(ROOT / "data/sensors" / sensor["antenna_table"])
    return dict(sensor, exponent=0.1, cell_phase="random", list_limit=0)


def small(kind, window, **changes):
    """A radar of few samples, with the cells of srr24-signal."""
    sensor = shipped("srr24-signal")
    samples = {"chirp": 32, "pulse": 128}[kind]
    sensor["waveform"] = {"kind": kind, "samples": samples, "repetitions": 32, "window": window}
    return dict(sensor, range_min_m=0, range_max_m=9.6, **changes)


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


def compare(program, name, sensor, points):
    """Targets of lone points have the places and levels that the simulation has."""
    radar = Radar(sensor)
    half, worst = radar.repetitions / 2, [0.0, 0.0, 0.0]
    for (place, rate, _), found in zip(points, program.targets(sensor, [[point] for point in points])):
        bins, rates, level = summit(radar, place, rate)
        if len(found) != 1:
            program.check(False, f"{name}: {len(found)} targets of {place} m, {rate} m/s")
            continue
        one, = found
        off = ((one["range_m"] + radar.coupling(rate) - bins * radar.bin) / radar.cell,
               (one["range_rate_mps"] / radar.rate_cell - rates + half) % (2 * half) - half,
               one["amplitude_db"] - 20 * math.log10(one["cell_amplitude"] * level))
        program.check(abs(off[0]) < 0.01 and abs(off[1]) < 0.01 and abs(off[2]) < 0.1,
                      f"{name}: {place:.3f} m, {rate:.3f} m/s: off by {off[0]:.4f}, {off[1]:.4f} cells, {off[2]:.3f} dB")
        worst = [max(old, abs(new)) for old, new in zip(worst, off)]
    print(f"  {name}: {worst[0]:.4f} cells in range, {worst[1]:.4f} in rate, {worst[2]:.3f} dB", flush=True)


def lone_points(program, long):
    """Everywhere in a cell, at rates from 0 on, with every window; and with the shipped waveforms."""
    draw = np.random.default_rng(SEED)
    for kind in ("chirp", "pulse"):
        for window in ("hann", "rectangular"):
            sensor = small(kind, window)
            fastest = WALK[window] * sensor["cell_range_m"] / Radar(sensor).dwell
            rates = np.concatenate([draw.uniform(-1, 1, 20), draw.uniform(-fastest, fastest, 20)])
            compare(program, f"{kind}, {window}", sensor, [(draw.uniform(4, 5.2), rate, 1e3) for rate in rates])
    for name, count in (("lrr77-signal-small", 20), ("srr24-signal", 20), ("lrr77-signal-medium", 8),
                        ("lrr77-signal-large", 4)):
        sensor = shipped(name)
        fastest = min(50, WALK["hann"] * sensor["cell_range_m"] / Radar(sensor).dwell)
        points = [(draw.uniform(0.3, 0.7) * sensor["range_max_m"], draw.uniform(-fastest, fastest), 1e3)
                  for _ in range(count * (5 if long else 1))]
        compare(program, name, sensor, points)


def pairs(program, _):
    """Equal points of random phases are two as often as in the simulation, within 3 sigma of 1,000 pairs."""
    draw, count = np.random.default_rng(SEED), 1000
    for kind, window, axis in (("chirp", "hann", 0), ("chirp", "hann", 1), ("chirp", "rectangular", 0),
                               ("chirp", "rectangular", 1), ("pulse", "hann", 1), ("pulse", "rectangular", 1)):
        sensor = small(kind, window)
        radar = Radar(sensor)
        for bins in (1, 1.5, 2, 2.5):
            first = draw.uniform(4, 4.3, count), draw.uniform(0, 0.5, count)
            second = first[0] + (1 - axis) * bins * radar.cell, first[1] + axis * bins * radar.rate_cell
            scans = [[(a, b, 1e3), (c, d, 1e3)] for a, b, c, d in zip(*first, *second)]
            turn = np.exp(2j * np.pi * draw.uniform(size=count))[:, None, None]
            power = radar.map(radar.receive(*first) + turn * radar.receive(*second))
            best = are_peaks(power) & (power > 0.04 * power.max((-2, -1), keepdims=True))
            expected = np.mean(best.sum((-2, -1)) == 2)
            share = np.mean([len(found) == 2 for found in program.targets(sensor, scans)])
            bound = 3 * math.sqrt(max(expected * (1 - expected), 1 / count) / count)
            print(f"  {kind}, {window}, {'rate' if axis else 'range'}, {bins} bins: {share:.3f}, simulated {expected:.3f}")
            program.check(abs(share - expected) < bound, f"{share} of pairs are two, simulated {expected} +- {bound}")


def alarms(program, long):
    """Noise passes the threshold of MODEL 11.4 with the probability that it states, and the program lists as many
    peaks of noise as the simulation, of the same levels."""
    draw, probability, shape = np.random.default_rng(SEED), 1e-3, (100, 64, 32)
    for (window, cfar), factor in FACTORS.items():
        sensor = small("chirp", window, threshold_db=-200, pointer_sigma=1)
        sensor["waveform"].update(repetitions=shape[1], cfar=cfar, cfar_false_alarm=probability)
        radar, passed, cells, levels = Radar(sensor), 0, 0, []
        while cells < (4e6 if long else 1e6):
            noise = draw.standard_normal(shape) + 1j * draw.standard_normal(shape)
            power = radar.map(noise / math.sqrt(2))
            above = power > factor * noise_level(power, cfar)
            passed += above.sum()
            cells += power.size
            levels.append(power[above & are_peaks(power)])
        scans = cells // (shape[1] * shape[2])
        levels = np.concatenate(levels)
        found = [one for scan in program.targets(sensor, [[]] * scans, "all") for one in scan]
        print(f"  {window}, {cfar}: {passed / cells:.3g} of {cells} cells; {len(found)} listed, simulated {len(levels)}")
        if window == "rectangular":
            program.check(abs(passed / cells / probability - 1) < 0.1, f"noise passes with {passed / cells}")
        bound = 4 * math.sqrt(2 * len(levels))
        program.check(abs(len(found) - len(levels)) < bound, f"{len(found)} alarms, simulated {len(levels)} +- {bound}")


def main():
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--long"]):
        sys.exit(__doc__.split("\n\n")[1])
    if not (Path(sys.argv[1]) / "glint-sensor-signal").exists():
        print("the signal alone: left out, as this build has no glint-sensor-signal")
        return
    with tempfile.TemporaryDirectory() as scratch:
        program = Program(sys.argv[1], scratch)
        for title, group in (("closed forms of the simulation", closed_forms), ("lone points", lone_points),
                             ("pairs", pairs), ("alarms", alarms)):
            group(program, bool(sys.argv[2:]))
            program.end(title)
        sys.exit(1 if program.failures else 0)


if __name__ == "__main__":
    main()
