"""Arrays through the executables against a full transform that this file computes by itself.

Usage: /usr/bin/python3 tests/oracle/arrays.py BIN_DIR [--long]

Exit status 1 if any check fails. The transform has noise on every element, and its maxima are searched on a grid of 16
steps to a beam's width, lambda/D, D the number of elements times their spacing. Signal-to-noise ratios (SNR) are those
of one echo in a beam, after the taper; thresholds are amplitudes over the RMS of the noise there. Hann's taper is
sampled in the middle of each element: sin^2(pi (n + 1/2)/N). --long draws ten times as many pairs and lone echoes, and
searches the cube of range, range rate and angle as well.
"""

import json
import math
import sys
import tempfile
import zlib
from pathlib import Path

sys.dont_write_bytecode = True
import numpy as np  # noqa: E402
from signal_alone import HEAD, Program, ROOT, strength  # noqa: E402
from sizes import quick  # noqa: E402

TAPERS = ("rectangular", "hann", "taylor", "chebyshev")
COUNTS = (8, 16, 32)
APART = (0.5, 1, 1.5, 2, 2.5)  # lambda/D
LEVELS = ((20, 20), (20, 30), (20, 40))  # dB
THRESHOLD_DB = 12
FINE = 16  # steps of the grid to lambda/D
SEED = 29


# ---- the transform ----------------------------------------------------------------------------


def taper_of(name, count):
    """Weights of a taper by its definition: Taylor's (1955) and Chebyshev's (Dolph 1946) have side lobes of -30 dB."""
    place, ratio = (np.arange(count) + 0.5) / count - 0.5, 10 ** 1.5
    if name == "rectangular":
        return np.ones(count)
    if name == "hann":
        return np.cos(np.pi * place) ** 2
    if name == "chebyshev":
        # The pattern is a polynomial of Chebyshev, and the weights are its transform.
        degree, steps = count - 1, np.arange(count)
        wide = math.cosh(math.acosh(ratio) / degree) * np.cos(np.pi * steps / count)
        lobes = np.cos(degree * np.arccos(np.clip(wide, -1, 1)))
        peak = np.sign(wide) ** degree * np.cosh(degree * np.arccosh(np.maximum(np.abs(wide), 1)))
        return np.cos(2 * np.pi * np.outer(place, steps)) @ np.where(np.abs(wide) > 1, peak, lobes)
    equal, a = 4, math.acosh(ratio) / np.pi
    dilated = equal ** 2 / (a * a + (equal - 0.5) ** 2)
    weights = np.ones(count)
    for m in range(1, equal):
        above = math.prod(1 - m * m / dilated / (a * a + (i - 0.5) ** 2) for i in range(1, equal))
        below = math.prod(1 - (m / i) ** 2 for i in range(1, equal) if i != m)
        weights = weights - (-1) ** m * above / below * np.cos(2 * np.pi * m * place)
    return weights


class Array:
    """A line of elements, its pattern and its beams. Noise has the RMS 1 in a beam."""

    def __init__(self, count, taper, spacing=0.5):
        self.count, self.taper, self.spacing = count, taper, spacing
        weights = taper_of(taper, count)
        self.weights = weights / weights.sum()
        self.turn = 2 * np.pi * spacing * (np.arange(count) - (count - 1) / 2)
        self.noise = 1 / math.sqrt((self.weights ** 2).sum())
        self.beam = 1 / (count * spacing)
        pattern = np.abs(np.fft.fft(self.weights, FINE * count))[:FINE * count // 2 + 1]
        rising = np.nonzero(np.diff(pattern) > 0)[0]
        self.null = rising[0] if len(rising) else FINE * count // 2
        self.side_lobe = pattern[self.null:].max()
        self.pattern = pattern
        # The largest side lobe at this distance or farther; inside of the main lobe, the largest of all.
        falling = np.maximum.accumulate(pattern[::-1])[::-1]
        self.envelope = np.where(np.arange(len(pattern)) < self.null, self.side_lobe, falling)

    def received(self, sines, pointers):
        """Signals of the elements, from the last axis of sines and complex amplitudes."""
        return (pointers[..., None] * np.exp(1j * self.turn * sines[..., None])).sum(-2)

    def noisy(self, draw, signals):
        return signals + self.noise / math.sqrt(2) * (draw.standard_normal(signals.shape)
                                                      + 1j * draw.standard_normal(signals.shape))

    def beams(self, signals):
        return np.abs(np.fft.fft(signals * self.weights, FINE * self.count))

    def sine(self, steps):
        size = FINE * self.count
        return ((steps + size / 2) % size - size / 2) / (size * self.spacing)

    def maxima(self, beams, most=10):
        """The highest maxima in falling order: their steps on the grid and levels."""
        peaks = (beams > np.roll(beams, 1, -1)) & (beams >= np.roll(beams, -1, -1))
        peaks &= np.abs(self.sine(np.arange(beams.shape[-1]))) <= 1
        peaks = np.where(peaks, beams, 0)
        steps = np.argsort(-peaks, -1)[..., :most]
        return steps, np.take_along_axis(peaks, steps, -1)

    def kept(self, steps, levels, threshold, noise=1.0):
        """Which maxima stand out of noise, and of what the side lobes of those kept can make there."""
        size, kept = FINE * self.count, np.zeros(levels.shape, bool)
        kept[..., 0] = True
        for p in range(1, levels.shape[-1]):
            lobes = np.zeros(levels.shape[:-1])
            for j in range(p):
                apart = np.abs(steps[..., p] - steps[..., j])
                lobes += kept[..., j] * self.envelope[np.minimum(apart, size - apart)] * levels[..., j]
            kept[..., p] = (levels[..., p] > threshold) & (levels[..., p] > 1.06 * lobes + 3 * noise)
        return kept

    def shown(self, signals, threshold):
        """How many targets each cell shows."""
        return self.kept(*self.maxima(self.beams(signals)), threshold).sum(-1)

    def vertices(self, beams, steps):
        """Sine and level of the parabola through the powers beside each of these maxima."""
        size = beams.shape[-1]
        low, middle, high = (np.take_along_axis(beams, (steps + i) % size, -1) ** 2 for i in (-1, 0, 1))
        bend = np.minimum(low + high - 2 * middle, -1e-300)
        off = (low - high) / (2 * bend)
        return self.sine(steps + off), np.sqrt(middle + (low - high) * off / 4)

    def lone_deviation(self):
        """Times lambda/D over the root of the SNR."""
        spread, mean = ((self.weights * self.turn) ** 2).sum() * self.noise ** 2, (self.weights * self.turn ** 2).sum()
        return math.sqrt(spread / 2) / mean / self.beam


def points(array, draw, count, apart, levels):
    """Sines of points that are so many beams apart, around boresight, and their amplitudes."""
    sines = draw.uniform(-0.2, 0.2, (count, 1)) + array.beam * np.cumsum([0, *apart])
    return sines, np.broadcast_to(10 ** (np.array(levels) / 20), sines.shape)


def shares(array, draw, count, apart, levels, threshold_db=THRESHOLD_DB):
    """The shares of cells that show 0, 1, 2, 3 and more targets."""
    sines, amplitudes = points(array, draw, count, apart, levels)
    pointers = amplitudes * np.exp(2j * np.pi * draw.uniform(size=sines.shape))
    signals = array.noisy(draw, array.received(sines, pointers))
    return np.bincount(np.minimum(array.shown(signals, 10 ** (threshold_db / 20)), 4), minlength=5) / count


# ---- the program ------------------------------------------------------------------------------


def sensor_of(array, /, **changes):
    """A radar with that array, two transmitters of which take turns, and an SNR of 1 for an amplitude of 1."""
    half = array.count // 2
    layout = {"transmit": [{"place": 0}, {"place": half * array.spacing}],
              "receive": [{"place": n * array.spacing} for n in range(half)], "taper": array.taper}
    sensor = json.loads((ROOT / "data/sensors/srr24-pair.json").read_text())["sensors"][0]
    for name in ("cycle_s", "sources", "first_threshold"):
        sensor.pop(name, None)
    return {**sensor, "antenna_pattern": "array", "angle_estimator": "beams", "array": layout, "range_max_m": 100,
            "field_of_view_rad": 3.1, "threshold_db": THRESHOLD_DB, "pointer_sigma": 1, "exponent": 0.1,
            "cell_phase": "random", "list_limit": 0, "azimuth_sigma_rad": 0, "final_threshold": False, **changes}


class Chain(Program):
    """glint-sensor with a stage of noise, on echoes that this file makes."""

    def frames(self, sensor, cells, stages="glint-sensor | glint-noise", effects="all", sections="account,quality",
               a_frame=25, where=None):
        """What the stages write. A cell is a list of points (sine, amplitude); the cells of a frame do not touch, or
        are where each has a range and a range rate."""
        suite = self.scratch / "suite.json"
        suite.write_text(json.dumps({"origin": "Made by tests/oracle/arrays.py.", "sensors": [sensor]}))
        asked = f"--sections {sections}" if sections else ""
        empty, = self.run(f"glint-extract | glint-ideal {asked} --sensors {suite} --effects {effects}",
                          json.dumps(HEAD | {"seed": str(SEED)}))
        lines, name = [], zlib.crc32(repr((sensor, cells)).encode())  # other cells meet other draws
        for begin in range(0, len(cells), a_frame):
            echoes = []
            for n, cell in enumerate(cells[begin:begin + a_frame]):
                place, rate = where[begin + n] if where else (10 + 3 * n, 0)
                echoes += [f'{{"sensor":"{sensor["name"]}","object":"{begin + n}","reflector":"{k}","path":"direct",'
                           f'"range_m":{place},"azimuth_rad":{math.asin(sine)!r},"range_rate_mps":{rate},'
                           f'"ercs":{amplitude / strength(sensor, place)!r},"time_s":1}}'
                           for k, (sine, amplitude) in enumerate(cell)]
            for count in empty.get("counts", []):
                count.update(pairs=len(echoes), paths=[{"path": "direct", "echoes": len(echoes)}])
            rest = json.dumps(dict(empty, scene=f"{name} {begin}", echoes=[]))
            lines.append(rest.replace('"echoes": []', f'"echoes": [{",".join(echoes)}]') + "\n")
        return self.run(stages, "".join(lines))

    def lists(self, sensor, cells, **how):
        """The targets of each cell."""
        found = [[] for _ in cells]
        for frame in self.frames(sensor, cells, **how):
            for target in frame["targets"]:
                found[int(target["contributors"][0]["object"])].append(target)
        return found


def sine_of(target, key="azimuth_rad"):
    return math.sin(target[key])


# ---- what is checked --------------------------------------------------------------------------


def closed_forms(chain, _):
    """The transform: side lobes, nulls and deviations of tapers that are published, and shares of pairs of 20 dB."""
    lobes = {"rectangular": -13.26, "hann": -31.47, "taylor": -30.2, "chebyshev": -30}
    for taper, lobe in lobes.items():
        found = 20 * math.log10(Array(64, taper).side_lobe)
        chain.check(abs(found - lobe) < 0.15, f"{taper}: side lobes of {found} dB")
    for taper, null in (("rectangular", 1), ("hann", 2)):
        chain.check(Array(32, taper).null == null * FINE, f"{taper}: a null at {Array(32, taper).null}")
    for taper, expected in (("rectangular", 0.390), ("hann", 0.487), ("taylor", 0.395), ("chebyshev", 0.395)):
        factor = Array(16, taper).lone_deviation()
        chain.check(abs(factor - expected) < 0.006, f"{taper}: deviation of {factor} lambda/D at an SNR of 1")
    draw = np.random.default_rng(SEED)
    # The published shares state no threshold: of whole targets it was 12 dB, of Hann's three deviations.
    for taper, threshold_db, expected in (("rectangular", 12, (0.26, 0.58, 1, 1, 1)),
                                          ("hann", 9.54, (0.14, 0.31, 0.55, 0.95, 1))):
        found = [shares(Array(16, taper), draw, 4000, [apart], (20, 20), threshold_db)[2] for apart in APART]
        told = ", ".join(f"{share:.3f}" for share in found)
        print(f"  16 elements, {taper}, pairs of 20 dB, threshold {threshold_db} dB: {told} are two")
        chain.check(np.abs(np.subtract(found, expected)).max() < 0.035, f"{taper}: published {expected}")


def lone_splits(chain, long):
    """The noisy transform shows at most 0.2 % of lone echoes as two, from 14 to 50 dB."""
    draw, most = np.random.default_rng(SEED), 0
    for taper in TAPERS:
        for count in COUNTS:
            for level in (14, 20, 30, 40, 50):
                split = 1 - shares(Array(count, taper), draw, 20000 if long else 2000, [], (level,))[1]
                most = max(most, split)
                chain.check(split <= (0.002 if long else 0.004), f"{taper}, {count}, {level} dB: {split} are two")
    print(f"  threshold {THRESHOLD_DB} dB: up to {100 * most:.2f} % are two")


def cube(array, draw, sines, pointers, threshold, samples=16):
    """Do points of one range and rate show as two in their beam, and in a search of all maxima over range, range rate
    and angle? Both axes have Hann's window; the search has four cells to a bin."""
    window = np.sin(np.pi * np.arange(samples) / samples) ** 2
    window /= window.sum()
    grid = np.arange(-6, 7) / 4
    look = window * np.exp(-2j * np.pi * np.outer(grid, np.arange(samples) / samples - 0.5))
    noise = array.noisy(draw, np.zeros((len(sines), samples, samples, array.count)))
    noise = np.einsum("ai,bj,tijn->tabn", look, look, noise, optimize=True) / (window ** 2).sum()
    answer = look.sum(1)
    signals = array.received(sines, pointers)[:, None, None] * np.outer(answer, answer)[:, :, None] + noise
    beams = array.beams(signals)
    inner = beams[:, 1:-1, 1:-1]
    peaks = np.ones(inner.shape, bool)
    for a in (0, 1, 2):
        for b in (0, 1, 2):
            for c in (-1, 0, 1):
                if (a, b, c) != (1, 1, 0):
                    peaks &= inner > np.roll(beams[:, a:a + 11, b:b + 11], c, -1)
    peaks &= np.abs(array.sine(np.arange(beams.shape[-1]))) <= 1
    levels = np.where(peaks, inner, 0).reshape(len(sines), -1)
    best = np.argsort(-levels, -1)[:, :20]
    kept = array.kept(best % beams.shape[-1], np.take_along_axis(levels, best, -1), threshold)
    return array.shown(signals[:, 6, 6], threshold) == 2, kept.sum(-1) == 2


def full_searches(chain, long):
    """A search of the whole cube shows as many pairs as two as the transform at their range and rate: within 0.01 in
    the mean."""
    draw, off = np.random.default_rng(SEED), []
    for taper in TAPERS if long else ("hann",):
        for levels in quick(LEVELS[:1], LEVELS):
            array = Array(8, taper)
            for apart in APART:
                found = np.zeros(2)
                for _ in range(20 if long else 3):
                    sines, amplitudes = points(array, draw, 50, [apart], levels)
                    pointers = amplitudes * np.exp(2j * np.pi * draw.uniform(size=sines.shape))
                    found += [one.sum() for one in cube(array, draw, sines, pointers, 10 ** (THRESHOLD_DB / 20))]
                off.append(abs(found[0] - found[1]) / (1000 if long else 150))
    print(f"  off by {np.mean(off):.4f} in the mean and {max(off):.3f} at most")
    chain.check(np.mean(off) < 0.01 and max(off) < 0.04, f"differences {off}")


def compare_shares(chain, name, array, draw, count, setups):
    """Differences of the shares of cells that show as many targets as they have points, from the transform."""
    cells, expected = [], []
    for apart, levels in setups:
        sines, amplitudes = points(array, draw, count, apart, levels)
        cells += [list(zip(*one)) for one in zip(sines.tolist(), amplitudes.tolist())]
        expected.append(shares(array, draw, count, apart, levels))
    shown = [len(one) for one in chain.lists(sensor_of(array), cells, sections="")]
    off = []
    for number, (apart, levels) in enumerate(setups):
        found = np.bincount(np.minimum(shown[number * count:(number + 1) * count], 4), minlength=5) / count
        off.append(np.abs(found - expected[number])[len(levels)])
        worst = np.abs(found - expected[number]).max()
        chain.check(worst <= 0.08, f"{name}, {apart} lambda/D, {levels} dB: {found}, transform {expected[number]}")
    return off


def pairs(chain, long):
    """As many pairs show as two as in the transform: within 0.02 in the mean and 0.08 at each point."""
    draw, count, every = np.random.default_rng(SEED), 10000 if long else 1000, {levels: [] for levels in LEVELS}
    for taper in TAPERS:
        for elements in quick(COUNTS[:1], COUNTS):
            for levels in LEVELS:
                off = compare_shares(chain, f"{taper}, {elements}", Array(elements, taper), draw, count,
                                     [([apart], levels) for apart in APART])
                every[levels] += off
    for levels, off in every.items():
        print(f"  {levels} dB: off by {np.mean(off):.4f} in the mean, {max(off):.3f} at most; draws alone"
              f" {math.sqrt(0.5 / count):.3f}")
        chain.check(np.mean(off) <= 0.02, f"{levels} dB: {np.mean(off)} in the mean")


def triples(chain, long):
    """As many triples show as three as in the transform: within 0.02 in the mean and 0.08 at each point."""
    draw, every = np.random.default_rng(SEED), []
    for taper in quick(TAPERS[-1:], TAPERS):
        setups = [([apart, apart], levels) for apart in APART for levels in ((20, 20, 20), (20, 30, 20), (30, 20, 25))]
        every += compare_shares(chain, f"three, {taper}", Array(16, taper), draw, 5000 if long else 700, setups)
    print(f"  three points: off by {np.mean(every):.4f} in the mean, {max(every):.3f} at most")
    chain.check(np.mean(every) <= 0.02, f"three points: {np.mean(every)} in the mean")


def drawn(draw, array, count, least=2, most=3):
    """Cells of points up to 3 lambda/D apart, of 20 to 40 dB."""
    cells = []
    while len(cells) < count:
        size = draw.integers(least, most + 1)
        sines = np.cumsum([draw.uniform(-0.8, 0.5), *array.beam * draw.uniform(0, 3, size - 1)]).tolist()
        if sines[-1] < 0.8:
            cells.append([(sine, 10 ** (draw.uniform(20, 40) / 20)) for sine in sines])
    return cells


def elements_of(chain, sensor, cells):
    """The noise-free signals of the elements that glint-sensor writes for cells of several points."""
    signals = np.zeros((len(cells), len(sensor["array"]["transmit"]) * len(sensor["array"]["receive"])), complex)
    for frame in chain.frames(sensor, cells, "glint-sensor"):
        for cell in frame["cells"]:
            number, found = int(cell["members"][0]["object"]), cell.get("elements", [])
            several = len(cells[number]) > 1
            good = len(found) == (len(signals[0]) if several else 0)
            chain.check(good, f"{len(found)} elements")
            if good and several:
                signals[number] = [complex(one["re"], one["im"]) for one in found]
    return signals


def summits(array, signals, sines):
    """Sine and level of each maximum near one of these sines."""
    step = array.beam / FINE
    for _ in range(6):
        near = sines[:, None] + step * np.arange(-4, 5) / 4
        levels = np.abs((np.exp(-1j * array.turn * near[..., None]) * (array.weights * signals)[:, None]).sum(-1))
        best = levels.argmax(-1)
        sines, step = near[np.arange(len(near)), best], step / 3
    return sines, levels.max(-1)


def own_maxima(array, signals):
    """For each cell, sines and levels of what is kept without noise, and the sines of all maxima."""
    steps, levels = array.maxima(array.beams(signals))
    kept = array.kept(steps, levels, 10 ** (THRESHOLD_DB / 20), 1)
    rows, columns = np.nonzero(levels > 0)
    sines, heights = summits(array, signals[rows], array.sine(steps[rows, columns]))
    result = [([], []) for _ in signals]
    for row, sine, height, listed in zip(rows, sines, heights, kept[rows, columns]):
        result[row][1].append(sine)
        if listed:
            result[row][0].append((sine, height))
    return result


def response(array, apart):
    return abs((array.weights * np.exp(1j * array.turn * apart)).sum())


def own_labels(array, cell, kept):
    """For each kept maximum the shares of its echoes; and the echoes that have none."""
    labels, lost = [{} for _ in kept], []
    for number, (sine, amplitude) in enumerate(cell):
        answers = [response(array, sine - place) for place, _ in kept]
        best = int(np.argmax(answers))
        if answers[best] >= 0.5:
            labels[best][number] = amplitude * answers[best]
        else:
            lost.append(number)
    for label, (place, _) in zip(labels, kept):
        if not label:
            parts = [amplitude * response(array, sine - place) for sine, amplitude in cell]
            label[int(np.argmax(parts))] = 1.0
            lost = [one for one in lost if one not in label]
    return [{one: part / sum(label.values()) for one, part in label.items()} for label in labels], lost


def without_noise(chain, long):
    """glint-sensor writes the sums of the pointers of each element, to which glint-noise-none lists the maxima of the
    transform, with the echoes of each beam as its contributors: 99 % to 0.001 lambda/D and 0.001 of their level, and as
    many in 97 % of the cells. The rest are maxima so flat that a grid of lambda/(4 D) shows none."""
    draw, count, cells_seen, odd, apart = np.random.default_rng(SEED), 4000 if long else 300, 0, 0, []
    for taper in TAPERS:
        for elements in COUNTS:
            array = Array(elements, taper)
            cells, sensor = drawn(draw, array, count), sensor_of(array)
            signals = elements_of(chain, sensor, cells)
            for cell, signal in zip(cells, signals):
                check_elements(chain, array, cell, signal)
            lists = chain.lists(sensor, cells, stages="glint-sensor | glint-noise-none")
            for cell, own, targets in zip(cells, own_maxima(array, signals), lists):
                mine = sorted(own[0])
                found = sorted((sine_of(one), 10 ** (one["amplitude_db"] / 20)) for one in targets)
                cells_seen += 1
                odd += len(mine) != len(found)
                if len(mine) == len(found):
                    off = np.abs(np.subtract(mine, found)) / [array.beam, max(level for _, level in mine)]
                    apart += off.max(1).tolist()
                    if off.max() < 0.001:
                        check_labels(chain, array, cell, targets)
    exact = np.mean(np.array(apart) < 0.001)
    print(f"  {exact:.4f} of {len(apart)} maxima agree; {odd} of {cells_seen} cells list another number")
    chain.check(exact > 0.99, f"{exact} of the maxima agree")
    chain.check(odd < 0.03 * cells_seen, f"{odd} of {cells_seen} cells list another number of targets")


def check_elements(chain, array, cell, signal):
    """Signals are a sum of echoes of the cell's sines and amplitudes, with any phases."""
    sines, amplitudes = np.array(cell).T
    turns = np.exp(1j * np.outer(array.turn, sines))
    pointers = np.linalg.lstsq(turns, signal, rcond=None)[0]
    left = np.abs(turns @ pointers - signal).max() / amplitudes.max()
    chain.check(left < 1e-9, f"{array.taper}, {array.count}: signals are no sum of {cell}: {left}")
    near = np.diff(sines).min() < 0.1 * array.beam or np.allclose(np.abs(pointers), amplitudes, rtol=1e-6)
    chain.check(near, f"{array.taper}, {array.count}: amplitudes {np.abs(pointers)} of {amplitudes}")


def check_labels(chain, array, cell, targets):
    targets = sorted(targets, key=sine_of)
    expected, _ = own_labels(array, cell, [(sine_of(one), 0) for one in targets])
    for target, label in zip(targets, expected):
        found = {int(one["reflector"]): one["weight"] for one in target["contributors"]}
        chain.check(abs(sum(found.values()) - 1) < 1e-9, f"weights {found}")
        near = found.keys() == label.keys() and all(abs(found[one] - label[one]) < 1e-3 for one in label)
        chain.check(near, f"{array.taper}, {array.count}, {cell}: contributors {found}, expected {label}")


def account(chain, _):
    """Every echo of a cell is in a target or is lost, some of them as masked."""
    draw, masked = np.random.default_rng(SEED), 0
    for taper in TAPERS:
        array = Array(16, taper)
        cells = drawn(draw, array, 300, 1, 5)
        ended = [set() for _ in cells]
        for frame in chain.frames(sensor_of(array), cells):
            every = [(one["object"], one["reflector"]) for group in frame.get("lost", []) for one in group["echoes"]]
            masked += sum(len(group["echoes"]) for group in frame.get("lost", []) if group["reason"] == "masked")
            chain.check(len(every) == len(set(every)), f"{taper}: an echo is lost twice")
            held = {(one["object"], one["reflector"]) for target in frame["targets"] for one in target["contributors"]}
            chain.check(not held & set(every), f"{taper}: lost and in a target: {held & set(every)}")
            for number, echo in [*every, *held]:
                ended[int(number)].add(int(echo))
            for target in frame["targets"]:
                chain.check(abs(sum(one["weight"] for one in target["contributors"]) - 1) < 1e-9, "weights")
        for cell, found in zip(cells, ended):
            chain.check(len(found) == len(cell), f"{taper}: {cell}: only {found} are accounted for")
    print(f"  {masked} echoes are masked")
    chain.check(masked > 10, "no echo is masked")


def lone_echoes(chain, long):
    """Lone echoes have their own azimuth, with the errors of the taper: normalised squared errors of 0.9 to 1.1, and
    no bias of 0.05 degrees from 20 dB on."""
    draw, count = np.random.default_rng(SEED), 20000 if long else quick(2000, 4000)
    for taper in TAPERS:
        for elements in COUNTS:
            array, told = Array(elements, taper), []
            for level in (15, 20, 30):
                sines = draw.uniform(-0.5, 0.5, count)
                cells = [[(sine, 10 ** (level / 20))] for sine in sines.tolist()]
                lists = chain.lists(sensor_of(array), cells, sections="quality")
                where = f"{taper}, {elements}, {level} dB"
                chain.check(all(len(one) == 1 for one in lists), f"{where}: not one target each")
                targets = [one[0] for one in lists if one]
                true = np.arcsin(sines[[bool(one) for one in lists]])
                cell = np.array([one["cell_azimuth_rad"] for one in targets])
                chain.check(np.abs(cell - true).max() < 1e-9, f"{where}: azimuths of cells are not the echoes'")
                off = np.array([one["azimuth_rad"] for one in targets]) - true
                scaled = np.mean((off / [one["quality"]["azimuth_sd_rad"] for one in targets]) ** 2)
                factor = np.std(np.sin(true + off) - np.sin(true)) * 10 ** (level / 20) / array.beam
                bias, allowed = np.degrees(off.mean()), np.degrees(4 * off.std() / math.sqrt(count))
                told.append(f"{scaled:.3f}")
                chain.check(0.9 < scaled < 1.1, f"{where}: normalised squared errors of {scaled}")
                chain.check(level < 20 or abs(bias) < max(0.05, allowed), f"{where}: a bias of {bias} degrees")
                expected, bound = array.lone_deviation(), 4 / math.sqrt(2 * count)
                chain.check(abs(factor / expected - 1) < bound, f"{where}: {factor} lambda/D, expected {expected}")
            print(f"  {taper}, {elements}: normalised squared errors at 15, 20, 30 dB: {', '.join(told)}")


def coverage(chain, long):
    """Of several points, up to 3 lambda/D apart and of 20 to 40 dB, 0.93 to 0.97 of the intervals of 95 % hold the
    nearest maximum without noise where a target does not look merged. Where it does, its deviation has what the other
    points do to it, too, and at least 0.95 do."""
    draw, count, every, same, marked = np.random.default_rng(SEED), 10000 if long else quick(400, 800), [], [], []
    for taper in TAPERS:
        for elements in COUNTS:
            array = Array(elements, taper)
            cells, sensor, inside = drawn(draw, array, count, 2, 2), sensor_of(array), []
            signals = elements_of(chain, sensor, cells)
            for own, targets in zip(own_maxima(array, signals), chain.lists(sensor, cells, sections="quality")):
                for one in targets:
                    nearest = np.clip(min(own[1], key=lambda sine: abs(sine - sine_of(one))), -1, 1)
                    same.append(abs(nearest - sine_of(one, "cell_azimuth_rad")) < 0.001 * array.beam)
                    apart = abs(one["azimuth_rad"] - math.asin(nearest))
                    held = marked if one["quality"]["looks_merged"] else inside
                    held.append(apart < 1.959964 * one["quality"]["azimuth_sd_rad"])
            every += inside
            share = np.mean(inside)
            chain.check(abs(share - 0.95) < 0.01 + 3 * math.sqrt(0.0475 / len(inside)), f"{taper}, {elements}: {share}")
    print(f"  {np.mean(every):.4f} of {len(every)} intervals, {np.mean(marked):.4f} of {len(marked)} where targets look merged;"
          f" {np.mean(same):.4f} of the cells are at that maximum")
    chain.check(np.mean(same) > 0.995, f"{np.mean(same)} of the cells are at the nearest maximum")
    chain.check(0.93 <= np.mean(every) <= 0.97, f"{np.mean(every)} of the intervals of targets that do not look merged")
    chain.check(np.mean(marked) >= 0.95, f"{np.mean(marked)} of the intervals of targets that look merged")


def automatic(chain, _):
    """The lists are the same whether effects are chosen or all are simulated."""
    draw = np.random.default_rng(SEED)
    for taper in TAPERS:
        for changes in ({}, {"final_threshold": True}, {"cell_phase": "by_path"}, {"cell_phase": "in_phase"}):
            array = Array(8, taper)
            cells = drawn(draw, array, 200, 1, 4)
            both = []
            for effects in ("all", "auto"):
                lists = chain.lists(sensor_of(array, **changes), cells, effects=effects, sections="quality")
                both.append([[{key: value for key, value in one.items() if key != "effects"} for one in cell]
                             for cell in lists])
            chain.check(both[0] == both[1], f"{taper}, {changes}: lists differ")


CHECKS = [
    ("closed forms and published shares of the transform", closed_forms),
    ("lone echoes seldom show as two", lone_splits),
    ("a search of the whole cube shows the same pairs", full_searches),
    ("signals of elements, maxima and contributors without noise", without_noise),
    ("every echo is in a target or lost", account),
    ("lone echoes have their own angle and its noise", lone_echoes),
    ("as many pairs are two as in the transform", pairs),
    ("as many triples are three as in the transform", triples),
    ("angles of several echoes err as the lists tell", coverage),
    ("effects that are chosen give the lists of all", automatic),
]


def main(usage, checks, needs="glint-noise"):
    """Runs all checks, unless a program that they need was not built."""
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--long"]):
        sys.exit(usage.split("\n\n")[1])
    if not (Path(sys.argv[1]) / needs).exists():
        print(f"skipped  {Path(sys.argv[0]).name}: there is no {needs}")
        return
    with tempfile.TemporaryDirectory() as scratch:
        chain = Chain(sys.argv[1], scratch)
        for title, group in checks:
            group(chain, bool(sys.argv[2:]))
            chain.end(title)
        sys.exit(1 if chain.failures else 0)


if __name__ == "__main__":
    main(__doc__, CHECKS)
