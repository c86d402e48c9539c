"""Probability of detection of one echo in noise of power 1, as glint detects it: its amplitude meets a first threshold, and with
noise the final one (MODEL 8.4, 14.14)."""
import math

STEPS = 100
DECIDES = 5  # noise decides so far from the threshold; beyond with less than 1e-10
LOWERED_BY = 1.75  # the first threshold, where a final one follows
ORDERS = {"swerling_1": 1, "swerling_3": 2}  # of the gamma law of the power


class Law:
    """How a sensor's echoes vary: by its fluctuation, and by levels of bodies, which are normal in dB (MODEL 14.22)."""

    def __init__(self, members):
        levels = [(math.hypot(*(members.get(f"level_{name}_db", 0) for name in ("constant", "slow", "fast"))), members.get("level_keeps"))]
        if members.get("fluctuation") == "log_normal":
            levels.append((members.get("fluctuation_sigma_db", 3.41), "mean"))
        self.order, self.final = ORDERS.get(members.get("fluctuation")), members.get("final_threshold", True)
        self.lowered = self.final and members.get("first_threshold") != "full"
        self.sigma_db = math.hypot(*(sigma_db for sigma_db, _ in levels))
        self.mean_db = sum(-math.log(10) / 20 * sigma_db ** 2 for sigma_db, keeps in levels if keeps != "median")

    def probability(self, mean, threshold):
        """Of an echo of this mean amplitude (root of the mean power)."""
        if self.sigma_db == 0:
            return self.alone(mean, threshold)
        count = 400 if self.order is None else 40
        places = [12 * (i + 0.5) / count - 6 for i in range(count)]
        chances = [self.alone(mean * 10 ** ((self.mean_db + self.sigma_db * x) / 20), threshold) for x in places]
        return sum(chance * math.exp(-x * x / 2) for chance, x in zip(chances, places)) / sum(math.exp(-x * x / 2) for x in places)

    def alone(self, mean, threshold):
        """Without levels."""
        first = max(threshold - LOWERED_BY, 0) if self.lowered else threshold
        if self.order is None:
            return self.noisy(mean, threshold) if mean >= first * (1 - 1e-12) else 0
        low, high = max(first, threshold - DECIDES), max(first, threshold + DECIDES if self.final else 0)
        step, total = (high - low) / STEPS, self.tail((high / mean) ** 2)
        for i in range(STEPS if high > low else 0):
            amplitude = low + (i + 0.5) * step
            total += self.density((amplitude / mean) ** 2) * 2 * amplitude / mean ** 2 * self.noisy(amplitude, threshold) * step
        return total

    def density(self, power):
        order = self.order
        return order ** order * power ** (order - 1) * math.exp(-order * power) / math.factorial(order - 1)

    def tail(self, power):
        """How likely a power is above this one."""
        return math.exp(-self.order * power) * sum((self.order * power) ** k / math.factorial(k) for k in range(self.order))

    def noisy(self, amplitude, threshold):
        return in_noise(amplitude, threshold) if self.final else 1

    def amplitude(self, chance, threshold):
        """The mean amplitude that is detected with this probability."""
        low, high = threshold / 1e3, threshold * 1e4
        while high > low * 1.0001:
            middle = math.sqrt(low * high)
            low, high = (middle, high) if self.probability(middle, threshold) < chance else (low, middle)
        return high


def in_noise(amplitude, threshold):
    """The probability that noise leaves the amplitude above the threshold, by an integral around the threshold's circle: seen
    from the echo, noise ends inside it with 1 - exp(-rho^2) along a ray that meets it at rho. Far above the noise the circle is straight."""
    if threshold > 50:
        return math.erfc(threshold - amplitude) / 2
    steps, inside = 16 + int(8 * threshold), 0
    for i in range(steps):
        cosine = math.cos(math.pi * (i + 0.5) / steps)
        rho2 = (amplitude - threshold) ** 2 + 2 * amplitude * threshold * (1 - cosine)
        inside += (threshold - amplitude * cosine) * -math.expm1(-rho2) / rho2
    return min(1, max(0, 1 - threshold * inside / steps))
