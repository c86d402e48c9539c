"""The fair energy score of random lists beside observed ones, and ratios of such scores with intervals.

    S = mean d(X_i, y) - 1/2 mean over i < j of d(X_i, X_j),     skill = 1 - S/S(ideal echoes)

X_i are the lists of a chain, y is the observed one, each of one body's detections in one scan. d is the distance of
glint-score (MODEL 11.2): a list is the sum of Gaussian kernels of widths 1, 3 and 10 at its detections, with range, range
rate, azimuth and level in units of a scale, and d the norm of a difference of sums (Gneiting, Raftery 2007).
"""
import math
import random
from collections import namedtuple

# Units of distances, and the number of lists of a score: 39, as marginals have (chains.SEEDS).
Scale = namedtuple("Scale", "range_m range_rate_mps azimuth_rad level_db lists")
COARSE = Scale(1.4, 0.2, math.radians(1.7), 3, 39)
LONG_BLOCKS = 20  # with fewer blocks of scans an interval is too short


def kernel(one, other, scale):
    square = (((one.range_m - other.range_m) / scale.range_m) ** 2
              + ((one.range_rate_mps - other.range_rate_mps) / scale.range_rate_mps) ** 2
              + ((one.azimuth_rad - other.azimuth_rad) / scale.azimuth_rad) ** 2 + ((one.snr_db - other.snr_db) / scale.level_db) ** 2)
    return math.exp(-square / 2) + math.exp(-square / 18) + math.exp(-square / 200)


def product(ones, others, scale):
    return sum(kernel(one, other, scale) for one in ones for other in others)


def energy_score(lists, observed, scale=COARSE):
    """S of the lists of a chain, or of other predictors, for one observed list."""
    own, m, of_observed = [product(one, one, scale) for one in lists], len(lists), product(observed, observed, scale)
    off = sum(math.sqrt(max(norm + of_observed - 2 * product(one, observed, scale), 0)) for one, norm in zip(lists, own)) / m
    apart = sum(math.sqrt(max(own[i] + own[j] - 2 * product(lists[i], lists[j], scale), 0)) for i in range(m) for j in range(i))
    return off - (apart / (m * (m - 1)) if m > 1 else 0)


def share(parts, wholes, scans, draws=1000):
    """Sum of parts over sum of wholes, {(body, scan): number} both, and its 95 % interval by a bootstrap of blocks of
    neighbouring scans."""
    sums = [[sum(of[key] for key in parts if key[1] == scan) for of in (parts, wholes)] for scan in range(scans)]

    def ratio(chosen):
        part, whole = (sum(sums[scan][i] for scan in chosen) for i in (0, 1))
        return part / whole if whole else 0

    drawn = sorted(ratio(chosen) for chosen in resampled(scans, draws) if any(sums[scan][1] for scan in chosen)) or [0]
    return ratio(range(scans)), drawn[round(0.025 * len(drawn))], drawn[round(0.975 * len(drawn)) - 1]


def block_length(scans):
    """5 to 10 scans."""
    return min(max(scans // LONG_BLOCKS, 5), 10)


def resampled(scans, draws, fewer=0):
    """Numbers of scans, drawn in blocks of neighbours that wrap around the end, and so many blocks fewer than there are; the
    same draws in each call."""
    generator, length = random.Random(1), block_length(scans)
    for _ in range(draws):
        begins = [generator.randrange(scans) for _ in range(max(math.ceil(scans / length) - fewer, 1))]
        yield [(begin + i) % scans for begin in begins for i in range(length)]
