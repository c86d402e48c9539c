"""The signal of arrays whose transmitters take turns, against a radar that this file simulates by itself.

Usage: /usr/bin/python3 tests/oracle/arrays_signal.py BIN_DIR [--long]

Exit status 1 if any check fails; 0, with a message, if the build has no glint-sensor-signal. Samples follow from the
exact ways of waves from each transmitter to moving points and on to each receiver. Of each peak of range and range rate
the phases of the transmitters are turned back by every range rate that folds onto the measured one, and the highest
beam of all decides. A wrong one of these rates makes a wrong angle. Signal-to-noise ratios (SNR) are those of one echo
in a beam, after all windows and the taper; thresholds are amplitudes over the RMS of the noise there. --long simulates
ten times as many scans.
"""

import math
import sys

sys.dont_write_bytecode = True
import numpy as np  # noqa: E402
from arrays import Array, TAPERS, main, sensor_of, sine_of  # noqa: E402
from signal_alone import C, QUIET, three_sigma, vertex  # noqa: E402

SEED = 30
PADDING = 2  # cells of the transforms to a bin
NEAR = 3  # bins to each side in which the simulation looks for the highest cell
RANGE_CELL, RATE_CELL, CARRIER = 2.0, 0.25, 77e9
SAMPLES, REPETITIONS = 16, 32
FASTEST = 15.0  # m/s
FALSE_ALARM = 0.05  # high enough to show nearly all points


def hann(count):
    weights = np.sin(np.pi * np.arange(count) / count) ** 2
    return weights / weights.sum()


def centred(count):
    return np.arange(count) / count - 0.5


class Turns:
    """Transmitters that take turns, in the order of their list, and receivers; chirps fill 0.8 of a turn."""

    def __init__(self, array, transmitters=2, order=None):
        self.array, each = array, array.count // transmitters
        self.wavelength = C / CARRIER
        self.order = list(order or range(transmitters))
        middle = array.spacing * (array.count - 1) / 2
        self.transmit = np.array(self.order) * each * array.spacing
        self.receive = np.arange(each) * array.spacing
        # Virtual elements by place: the signals of turn i and receiver r are element index[i, r].
        self.index = np.rint((self.transmit[:, None] + self.receive) / array.spacing).astype(int)
        self.transmit, self.receive = self.transmit - middle / 2, self.receive - middle / 2
        self.dwell = self.wavelength / (2 * RATE_CELL)
        self.turn = self.dwell / REPETITIONS / transmitters
        self.unambiguous = self.wavelength / (4 * transmitters * self.turn)
        self.chirp = 0.8 * self.turn
        self.slope = C / (2 * RANGE_CELL) / self.chirp
        self.fast = centred(SAMPLES) * self.chirp
        self.slow = centred(REPETITIONS) * self.dwell

    def delays(self, place, sine, rate):
        """Of waves from each transmitter to a point that moves along the line of sight, and on to each receiver:
        scans by turns by receivers by repetitions by samples."""
        place, sine, rate = (np.asarray(one)[:, None, None, None, None] for one in (place, sine, rate))
        turns = np.arange(len(self.transmit))[:, None, None, None] * self.turn
        time = turns + self.slow[:, None] + self.fast
        receiver = self.receive[:, None, None] * self.wavelength
        transmitter = self.transmit[:, None, None, None] * self.wavelength

        def way(at, aside):
            distance = place + rate * at
            return np.sqrt(distance * distance - 2 * distance * sine * aside + aside * aside)
        at = time
        for _ in range(3):
            at = time - way(at, receiver) / C
        return (way(at, receiver) + way(at, transmitter)) / C

    def samples(self, place, sine, rate):
        """Of points of amplitude 1, mixed with what is transmitted."""
        delay = self.delays(place, sine, rate)
        beat = -CARRIER * delay - self.slope * self.fast * delay + self.slope * delay * delay / 2
        return np.exp(2j * np.pi * beat)

    def noise(self, draw, shape):
        """Noise of samples that has an RMS of 1 in a beam."""
        gain = (hann(SAMPLES) ** 2).sum() * (hann(REPETITIONS) ** 2).sum()
        values = draw.standard_normal(shape) + 1j * draw.standard_normal(shape)
        return values * self.array.noise / math.sqrt(2 * gain)

    def cells(self, samples, place, rate):
        """The transform along range and range rate of each element, NEAR bins around where a point is expected; and
        the bins of its rows and columns."""
        bins = np.rint((place + CARRIER * rate / self.slope) / RANGE_CELL) + np.arange(-NEAR, NEAR + 0.1, 1 / PADDING)
        rates = np.rint(rate / RATE_CELL) + np.arange(-NEAR, NEAR + 0.1, 1 / PADDING)
        across = np.exp(2j * np.pi * np.outer(centred(SAMPLES), bins)) * hann(SAMPLES)[:, None]
        along = np.exp(2j * np.pi * np.outer(rates, centred(REPETITIONS))) * hann(REPETITIONS)
        found = np.einsum("am,irmn,nb->irab", along, samples, across, optimize=True)
        cells = np.empty((self.array.count, *found.shape[2:]), complex)
        cells[self.index.ravel()] = found.reshape(self.array.count, *found.shape[2:])
        return cells, rates

    def turned(self, signals, rate):
        """Signals of elements, last axis, whose transmitters are turned back as of a point of this rate."""
        late = np.empty(self.array.count)
        late[self.index] = np.arange(len(self.transmit))[:, None] * self.turn
        return signals * np.exp(4j * np.pi / self.wavelength * np.multiply.outer(rate, late))

    def folds(self, rate):
        """All rates that fold onto this one and turn the transmitters in their own way, the folded one first."""
        folded = (rate + self.unambiguous) % (2 * self.unambiguous) - self.unambiguous
        return folded + 2 * self.unambiguous * np.arange(len(self.transmit))


    def image(self, folds):
        """How far aside, in lambda/D, a rate that is wrong by so many folds shows a point, and its level there."""
        beams = self.array.beams(self.turned(np.ones(self.array.count), 2 * folds * self.unambiguous))
        steps, _ = self.array.maxima(beams)
        sines, levels = self.array.vertices(beams, steps[:1])
        return abs(sines[0]) / self.array.beam, levels[0]

    def is_near(self, target, place, rate):
        """Is this target in the cell of a point, whichever rate decided? The Doppler shift adds to its range."""
        fold, off = 2 * self.unambiguous, target["range_rate_mps"] - rate
        far = target["range_m"] - place + CARRIER / self.slope * off
        return abs((off + fold / 2) % fold - fold / 2) < 2 * RATE_CELL and abs(far) < RANGE_CELL

    def is_right(self, rate, true):
        """Does this rate turn the transmitters as the true one does?"""
        every = 2 * self.unambiguous * len(self.transmit)
        return abs((rate - true + every / 2) % every - every / 2) < self.unambiguous


def look(turns, samples, place, rate, threshold):
    """Sines of the beams that one scan shows, the highest first, and the rate that decided."""
    array = turns.array
    cells, rates = turns.cells(samples, place, rate)
    signals = np.moveaxis(cells, 0, -1)
    middle = rates[len(rates) // 2] * RATE_CELL
    best = np.zeros(signals.shape[:2])
    for turn in turns.folds(middle):
        own = turn + rates * RATE_CELL - middle
        best = np.maximum(best, array.beams(turns.turned(signals, own[:, None])).max(-1))
    inner = best[1:-1, 1:-1]
    row, column = (one + 1 for one in np.unravel_index(inner.argmax(), inner.shape))
    folds = turns.folds((rates[row] + vertex(best[row - 1:row + 2, column] ** 2) / PADDING) * RATE_CELL)
    beams = array.beams(turns.turned(signals[row, column], folds))
    chosen = beams.max(-1).argmax()
    steps, levels = array.maxima(beams[chosen])
    kept = array.kept(steps[None], levels[None], threshold)[0]
    return array.vertices(beams[chosen], steps[kept])[0], folds[chosen]


class Scans:
    """Points that share range and range rate, each group alone in a scan."""

    def __init__(self, turns, draw, count, apart, levels):
        self.turns, self.draw, self.levels = turns, draw, levels
        self.place, self.rate = draw.uniform(8, 20, count), draw.uniform(-FASTEST, FASTEST, count)
        self.sines = draw.uniform(-0.4, 0.3, (count, 1)) + turns.array.beam * np.cumsum([0, *apart])

    def simulated(self, noise=1.0, threshold=3.5):
        """What the simulation shows."""
        shown = []
        for begin in range(0, len(self.place), 20):
            some = slice(begin, begin + 20)
            samples, where = 0, (self.place[some], self.rate[some])
            for k, level in enumerate(self.levels):
                turn = np.exp(2j * np.pi * self.draw.uniform(size=(len(where[0]), 1, 1, 1, 1)))
                point = self.turns.samples(where[0], self.sines[some, k], where[1])
                samples = samples + 10 ** (level / 20) * turn * point
            samples = samples + noise * self.turns.noise(self.draw, samples.shape)
            shown += [look(self.turns, one, *at, threshold) for one, *at in zip(samples, *where)]
        return shown

    def listed(self, chain, effects="all"):
        """What glint-sensor-signal lists at the place of its strongest target, in the same form."""
        array = self.turns.array
        layout = {"transmit": [{"place": place} for place in self.turns.transmit.tolist()],
                  "receive": [{"place": place} for place in self.turns.receive.tolist()], "taper": array.taper}
        sensor = sensor_of(array, array=layout, carrier_hz=CARRIER, cell_range_m=RANGE_CELL, range_min_m=0,
                           cell_range_rate_mps=RATE_CELL, range_max_m=26, chirp_slope_hzps=self.turns.slope)
        sensor["waveform"] = {"kind": "chirp", "samples": SAMPLES, "repetitions": REPETITIONS, "window": "hann",
                              "cfar": "ordered", "cfar_cells": 8, "cfar_rank": 6, "cfar_false_alarm": FALSE_ALARM}
        cells = [[(sine, 10 ** (level / 20)) for sine, level in zip(one, self.levels)] for one in self.sines.tolist()]
        where, shown = list(zip(self.place.tolist(), self.rate.tolist())), []
        for at, frame in zip(where, chain.frames(sensor, cells, "glint-sensor-signal", effects, "", 1, where)):
            near = [one for one in frame.get("targets", []) if self.turns.is_near(one, *at)]
            near.sort(key=lambda one: -one["amplitude_db"])
            near = [one for one in near if abs(one["range_m"] - near[0]["range_m"]) < RANGE_CELL / 2
                    and abs(one["range_rate_mps"] - near[0]["range_rate_mps"]) < RATE_CELL / 2]
            shown.append(near and (np.array([sine_of(one) for one in near]), near[0]["range_rate_mps"]))
        return shown

    def wrong(self, shown):
        """The share of scans that a wrong rate decided, of those that show anything."""
        return 1 - np.mean([self.turns.is_right(one[1], rate) for one, rate in zip(shown, self.rate) if one])

    def aside(self, shown):
        """How far the strongest beam of each scan is from the middle of the points, in lambda/D."""
        off = [one[0][0] - sines.mean() for one, sines in zip(shown, self.sines) if one]
        return np.array(off) / self.turns.array.beam


# ---- what is checked --------------------------------------------------------------------------


def closed_forms(chain, _):
    """The simulation: places of points without noise, up to the parallax of receivers beside the middle; and what a
    wrong rate makes of the halves of an array without taper: the highest beams of sin(x)^2/x, x = pi/2 u D/lambda, are
    0.742 lambda/D aside and of 0.7246."""
    draw = np.random.default_rng(SEED)
    for taper, transmitters in ((taper, transmitters) for taper in TAPERS for transmitters in (1, 2, 4)):
        scans = Scans(Turns(Array(16, taper), transmitters), draw, 20, [], (20,))
        shown = scans.simulated(noise=0)
        off, wrong = np.abs(scans.aside(shown)).max(), scans.wrong(shown)
        chain.check(off < 0.01 and wrong == 0, f"{taper}, {transmitters}: {off} lambda/D off, {wrong} wrong")
    aside, level = Turns(Array(64, "rectangular")).image(1)
    chain.check(abs(aside - 0.742) < 0.001 and abs(level - 0.7246) < 0.001, f"a wrong rate shows {aside}, {level}")
    for taper in TAPERS:
        for transmitters, order in ((2, (0, 1)), (4, (0, 1, 2, 3)), (4, (0, 2, 1, 3))):
            turns = Turns(Array(16, taper), transmitters, order)
            images = [turns.image(k) for k in range(1, transmitters)]
            shown = ", ".join(f"{aside:.2f} lambda/D ({level:.2f})" for aside, level in images)
            print(f"  {taper}, turns {order}: wrong rates show aside by {shown}")


def exact_places(chain, long):
    """Without noise, targets of lone points have their sines, to 0.01 lambda/D, and the right rate, whatever the order
    in which the transmitters take turns."""
    draw, worst = np.random.default_rng(SEED), 0
    for taper in TAPERS:
        for transmitters, order in ((1, None), (2, None), (2, (1, 0)), (4, None), (4, (0, 2, 1, 3))):
            scans = Scans(Turns(Array(16, taper), transmitters, order), draw, 100 if long else 10, [], (20,))
            shown = scans.listed(chain, QUIET)
            off, wrong = np.abs(scans.aside(shown)).max(), scans.wrong(shown)
            worst = max(worst, off)
            chain.check(off < 0.01 and wrong == 0, f"{taper}, turns {order}: {off} lambda/D off, {wrong} wrong")
    print(f"  up to {worst:.4f} lambda/D off")


def shown_of(chain, name, found, most):
    """Of the scans no more than these show nothing, as the CFAR has few neighbours."""
    none = np.mean([not one for one in found])
    chain.check(none <= most, f"{name}: {none} show no target")


def alike(chain, name, found, expected, count, more=0.0):
    """Two shares of so many draws each, within three deviations and what is known to differ."""
    bound = math.sqrt(2) * three_sigma(max(min((found + expected) / 2, 1), 0), count) + more
    chain.check(abs(found - expected) < bound, f"{name}: {found}, simulated {expected} +- {bound}")


def lone_echoes(chain, long):
    """Wrong rates decide under 0.5 % of lone echoes of 20 dB before two transmitters, and as many of weaker ones as in
    the simulation; angles err as the taper says."""
    draw = np.random.default_rng(SEED)
    for taper, transmitters, level, count in (("hann", 2, 20, 400), ("rectangular", 2, 20, 400), ("hann", 2, 13, 300),
                                              ("rectangular", 2, 13, 300), ("hann", 4, 17, 300)):
        count *= 10 if long else 1
        turns = Turns(Array(16, taper), transmitters)
        scans = Scans(turns, draw, count, [], (level,))
        found, simulated = scans.listed(chain), scans.simulated()
        wrong = scans.wrong(found), scans.wrong(simulated)
        name = f"{taper}, {transmitters} transmitters, {level} dB"
        shown_of(chain, name, found, 0.01 if level == 20 else 0.2)
        aside = [scans.aside(one) for one in (found, simulated)]
        error = [np.sqrt(np.mean(one[np.abs(one) < 0.35] ** 2)) * 10 ** (level / 20) for one in aside]
        print(f"  {name}: {100 * wrong[0]:.2f} % by a wrong rate, simulated {100 * wrong[1]:.2f}; errors of"
              f" {error[0]:.3f} lambda/D at an SNR of 1, simulated {error[1]:.3f}", flush=True)
        alike(chain, name, *wrong, count)
        chain.check(level < 20 or wrong[0] < 0.005, f"{name}: {wrong[0]} by a wrong rate")
        chain.check(abs(error[0] / error[1] - 1) < 4 / math.sqrt(count), f"{name}: errors of {error}")
        away = np.abs(scans.aside([one if one and not turns.is_right(one[1], rate) else None
                                   for one, rate in zip(found, scans.rate)]))
        if level == 13:
            expected = turns.image(1)[0]
            print(f"    wrong rates show {np.median(away):.2f} lambda/D aside, without noise {expected:.2f}")
            chain.check(abs(np.median(away) - expected) < 0.25, f"{name}: wrong rates show {away} lambda/D aside")


def pairs(chain, long):
    """Wrong rates decide as many pairs as in the simulation; their strongest beams are as far aside, and as many are
    two."""
    draw, count = np.random.default_rng(SEED), 1500 if long else 150
    for taper, transmitters, apart, levels in (
            ("hann", 2, 1, (20, 20)), ("hann", 2, 2, (20, 20)), ("hann", 2, 3, (20, 20)), ("hann", 2, 2.5, (20, 30)),
            ("rectangular", 2, 1, (20, 20)), ("rectangular", 2, 1.5, (20, 20)), ("rectangular", 4, 2, (20, 20))):
        scans = Scans(Turns(Array(16, taper), transmitters), draw, count, [apart], levels)
        found, simulated = scans.listed(chain), scans.simulated()
        name = f"{taper}, {transmitters}, {apart} lambda/D, {levels} dB"
        wrong = scans.wrong(found), scans.wrong(simulated)
        shown_of(chain, name, found, 0.1)
        two = [np.mean([len(one[0]) == 2 for one in shown if one]) for shown in (found, simulated)]
        aside = [np.sort(scans.aside(shown)) for shown in (found, simulated)]
        every = np.concatenate(aside)
        parted = abs(np.subtract(*(np.searchsorted(one, every, "right") / len(one) for one in aside))).max()
        print(f"  {name}: {100 * wrong[0]:.1f} % by a wrong rate, simulated {100 * wrong[1]:.1f}; {two[0]:.3f} are two,"
              f" simulated {two[1]:.3f}; distributions {parted:.3f} apart", flush=True)
        alike(chain, f"{name}, wrong rates", *wrong, count)
        # The threshold of the program is its CFAR's, which varies; that of the simulation does not.
        alike(chain, f"{name}, two", *two, count, 0.05)
        # Kolmogorov and Smirnov: larger by chance once in 1,000 times.
        chain.check(parted < 1.95 * math.sqrt(2 / count), f"{name}: strongest beams lie {parted} apart")


CHECKS = [
    ("closed forms of the simulation", closed_forms),
    ("lone points without noise", exact_places),
    ("lone echoes", lone_echoes),
    ("pairs", pairs),
]


if __name__ == "__main__":
    main(__doc__, CHECKS, needs="glint-sensor-signal")
