"""Probability of detection of one echo in noise of power 1, as glint detects it: its amplitude meets the threshold, and so does
its amplitude with noise (MODEL 14.14)."""
import math

STEPS = 100
ORDERS = {"none": None, "swerling_1": 1, "swerling_3": 2}  # of the gamma law of the power


def in_noise(amplitude, threshold):
    """The probability that noise leaves the amplitude above the threshold, by an integral around the threshold's circle: seen
    from the echo, noise ends inside it with 1 - exp(-rho^2) along a ray that meets it at rho."""
    steps, inside = 16 + int(8 * threshold), 0
    for i in range(steps):
        cosine = math.cos(math.pi * (i + 0.5) / steps)
        rho2 = (amplitude - threshold) ** 2 + 2 * amplitude * threshold * (1 - cosine)
        inside += (threshold - amplitude * cosine) * -math.expm1(-rho2) / rho2
    return min(1, max(0, 1 - threshold * inside / steps))


def probability(mean, threshold, fluctuation):
    """Of an echo of this mean amplitude (root of the mean power)."""
    order = ORDERS[fluctuation]
    if order is None:
        return in_noise(mean, threshold) if mean >= threshold * (1 - 1e-12) else 0
    least = (threshold / mean) ** 2
    total, width = 0, 20 / STEPS
    for i in range(STEPS):
        power = least + ((i + 0.5) / STEPS) ** 2 * 20
        density = order ** order * power ** (order - 1) * math.exp(-order * power) / math.factorial(order - 1)
        total += density * in_noise(mean * math.sqrt(power), threshold) * 2 * (i + 0.5) / STEPS * width
    return total


def amplitude(chance, threshold, fluctuation):
    """The mean amplitude that is detected with this probability; at least the threshold."""
    low, high = threshold, threshold * 1e4
    while high > low * 1.0001:
        middle = math.sqrt(low * high)
        low, high = (middle, high) if probability(middle, threshold, fluctuation) < chance else (low, middle)
    return high
