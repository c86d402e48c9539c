"""A sensor of your own: echoes add up in the bins of a fixed grid, where glint-sensor opens a cell around the strongest.

Stands between glint-ideal and glint-noise in the place of glint-sensor. Its radar is that of srr24-pair: an ERCS of
0.8 has 6 dB at 30 m (MODEL 4.1), its threshold is 6 dB, and two dipoles are its antenna (7.1). What it hears is labelled,
and what it does not hear is in `lost`, so that glint-check finds nothing to refuse.
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "scripts"))
import glint  # noqa: E402

THRESHOLD = 10 ** (6 / 20)
LABEL = ("object", "reflector", "path", "range_m", "azimuth_rad", "range_rate_mps", "ercs", "time_s")


def pointers(echo):
    """What an echo gives the sum channel (real) and the delta channel (imaginary)."""
    u = math.pi / 2 * math.sin(echo["azimuth_rad"])
    strength = THRESHOLD * (30 / max(echo["range_m"], 0.5)) ** 2 * echo["ercs"] / 0.8
    element = strength * (math.sin(u) / u if u else 1) * math.cos(echo["azimuth_rad"])
    return element * math.cos(u), -element * math.sin(u)


def cell_of(sensor, echoes):
    """The cell of a bin: pointers add, places are means, and the echoes with their shares of the amplitude are its label."""
    heard = sorted(((*pointers(echo), echo) for echo in echoes), key=lambda one: -one[0])
    amplitude = sum(one[0] for one in heard) or 1e-300  # where no echo has any, no share is one
    delta = sum(one[1] for one in heard)
    range_m, rate_mps = (sum(one[0] * one[2][name] for one in heard) / amplitude for name in ("range_m", "range_rate_mps"))
    label = [{**{name: echo[name] for name in LABEL}, "weight": part / amplitude} for part, _, echo in heard]
    effects = {name: True for echo in echoes for name in echo.get("effects", ())}
    return {"sensor": sensor, "range_m": range_m, "range_rate_mps": rate_mps, "amplitude": amplitude, "effects": [*effects],
            "azimuth_rad": math.asin(2 / math.pi * math.atan(-delta / amplitude)),
            "sum_re": amplitude, "sum_im": 0, "delta_re": 0, "delta_im": delta, "members": label}


def change(frame):
    """The cells of a frame in the place of its echoes."""
    if "echoes" not in frame:
        raise glint.BadFrame(f"{frame.place}: echoes: missing; expected behind glint-ideal")
    size = {one["name"]: (one["cell_range_m"], one["cell_range_rate_mps"]) for one in frame["sensors"]["list"]}
    bins, weak = {}, {}
    for echo in frame.pop("echoes"):
        of_range, of_rate = size[echo["sensor"]]
        place = echo["sensor"], math.floor(echo["range_m"] / of_range), math.floor(echo["range_rate_mps"] / of_rate)
        bins.setdefault(place, []).append(echo)
    frame["cells"] = []
    for (sensor, _, _), echoes in sorted(bins.items()):
        cell = cell_of(sensor, echoes)
        if cell["amplitude"] >= THRESHOLD:
            frame["cells"].append(cell)
        else:
            weak.setdefault(sensor, []).extend({name: echo[name] for name in LABEL[:5]} for echo in echoes)
    if "account" in frame["sections"]:
        frame["lost"] += [{"sensor": name, "stage": "bins", "reason": "weak", "echoes": lost} for name, lost in weak.items()]
    return frame


glint.stage(change)
