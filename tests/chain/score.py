"""glint-score and glint-score-tracks against an independent computation.

Usage: python3 tests/chain/score.py BIN_DIR        exit status 1 if any check fails

Lists of random scenes, noise-free and noisy, are compared here by trying every assignment (remembering the
best one for the rest of a list), with distances and statistics from their definitions: Wasserstein-1 as an
integral over quantiles in fractions, percentiles by counting. Tracks are the objects, moved, renamed, dropped
and added by a seeded generator.
"""
import cmath
import functools
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile
from fractions import Fraction

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
COMPONENTS = ["range_m", "azimuth_rad", "range_rate_mps", "amplitude_db"]
TRACKED = ["position_m", "velocity_mps", "nees"]
MOST = 11  # the most targets a side for which trying all assignments is feasible
CUTOFF, CUTOFF_M = 2, 5  # pairs are nearer: targets in cells, tracks in metres
BESIDE_M = 2  # a track so near the box of an object that does not count is not false
checks = failures = 0


def check(good, what):
    global checks, failures
    checks += 1
    if not good:
        failures += 1
        if failures <= 20:
            print("score: " + what)


def near(actual, expected, what):
    check(abs(actual - expected) <= 1e-9 * max(1, abs(expected)), f"{what}: {actual}, expected {expected}")


# ---- the definitions --------------------------------------------------------------------------


def assign(distance, truths, listed, cutoff):
    """The least sum of squared distances of pairs below the cut-off, plus half the squared cut-off for every
    other item."""

    @functools.lru_cache(None)
    def best(row, used):
        if row == truths:
            left = listed - bin(used).count("1")
            return left * cutoff**2 / 2, ()
        cost, pairs = best(row + 1, used)
        answer = cost + cutoff**2 / 2, pairs
        for column in range(listed):
            if used >> column & 1 or distance[row][column] >= cutoff:
                continue
            cost, pairs = best(row + 1, used | 1 << column)
            cost += distance[row][column] ** 2
            if cost < answer[0]:
                answer = cost, ((row, column), *pairs)
        return answer

    return best(0, 0)


def least_ospa(distance, truths, listed, cutoff):
    """Least sum of squares where every item of the shorter list has a partner, at most the cut-off away."""
    if max(truths, listed) == 0:
        return 0
    if truths > listed:
        distance = [[distance[i][j] for i in range(truths)] for j in range(listed)]
    short, long = min(truths, listed), max(truths, listed)

    @functools.lru_cache(None)
    def best(row, used):
        if row == short:
            return 0
        return min(min(distance[row][column], cutoff) ** 2 + best(row + 1, used | 1 << column)
                   for column in range(long) if not used >> column & 1)

    return math.sqrt((best(0, 0) + cutoff**2 * (long - short)) / long)


def wasserstein(one, other):
    """The integral over 0 < q < 1 of the difference of the quantiles at q."""
    one, other = sorted(one), sorted(other)
    steps = sorted({Fraction(i, len(one)) for i in range(len(one) + 1)}
                   | {Fraction(i, len(other)) for i in range(len(other) + 1)})
    total = Fraction(0)
    for low, high in zip(steps, steps[1:]):
        middle = (low + high) / 2
        total += (high - low) * abs(Fraction(one[int(middle * len(one))]) - Fraction(other[int(middle * len(other))]))
    return float(total)


def statistics(differences):
    sizes = sorted(map(abs, differences))
    return {"mean": math.fsum(differences) / len(sizes),
            "rms": math.sqrt(math.fsum(d * d for d in differences) / len(sizes)),
            "p95": next(s for s in sizes if sum(t <= s for t in sizes) * 100 >= 95 * len(sizes)),
            "max": sizes[-1]}


class Tally:
    """The scores of one scan, or of several together."""

    def __init__(self):
        self.gospa, self.ospa, self.parts, self.counts = [], [], [], [0, 0, 0]
        self.apart, self.truth, self.listed = {}, {}, {}

    def scan(self, distance, truth, listed, cutoff):
        """Counts the lists of one scan; returns the pairs."""
        total, pairs = assign(distance, len(truth), len(listed), cutoff)
        alone = cutoff**2 / 2
        missed, false = len(truth) - len(pairs), len(listed) - len(pairs)
        self.gospa.append(math.sqrt(total))
        self.ospa.append(least_ospa(distance, len(truth), len(listed), cutoff))
        self.parts.append((total - alone * (missed + false), alone * missed, alone * false))
        self.counts = [a + b for a, b in zip(self.counts, (len(truth), len(listed), len(pairs)))]
        return pairs

    def add(self, other):
        self.gospa += other.gospa
        self.ospa += other.ospa
        self.parts += other.parts
        self.counts = [a + b for a, b in zip(self.counts, other.counts)]
        for mine, others in ((self.apart, other.apart), (self.truth, other.truth), (self.listed, other.listed)):
            for name, values in others.items():
                mine.setdefault(name, []).extend(values)

    def compare(self, score, what):
        scans = len(self.gospa)
        truths, listed, pairs = self.counts
        for key, value in {"scans": scans, "true_count": truths, "listed_count": listed, "pair_count": pairs,
                           "missed_count": truths - pairs, "false_count": listed - pairs}.items():
            check(score[key] == value, f"{what}: {key} is {score[key]}, expected {value}")
        near(score["gospa"], sum(self.gospa) / scans, what + " gospa")
        near(score["gospa_rms"] ** 2, sum(g * g for g in self.gospa) / scans, what + " gospa_rms")
        near(score["gospa_max"], max(self.gospa), what + " gospa_max")
        for i, part in enumerate(("localisation", "missed", "false")):
            near(score["gospa_" + part], sum(p[i] for p in self.parts) / scans, what + " " + part)
        near(score["ospa"], sum(self.ospa) / scans, what + " ospa")
        for name in COMPONENTS + TRACKED:
            told = score.get(name, {})
            expected = statistics(self.apart[name]) if self.apart.get(name) else {}
            if self.truth.get(name) and self.listed.get(name):
                expected["wasserstein"] = wasserstein(self.truth[name], self.listed[name])
            check(told.keys() == expected.keys(), f"{what}: {name} has {list(told)}, expected {list(expected)}")
            for key in expected.keys() & told.keys():
                near(told[key], expected[key], f"{what} {name} {key}")


# ---- targets ----------------------------------------------------------------------------------


def turn(angle):
    return math.remainder(angle, math.tau)


def scan_targets(truth, listed, view, azimuth_cell):
    width = azimuth_cell or view["field_of_view_rad"] / 20

    def apart(a, b):
        return math.hypot((a["range_m"] - b["range_m"]) / view["cell_range_m"],
                          (a["range_rate_mps"] - b["range_rate_mps"]) / view["cell_range_rate_mps"],
                          turn(a["azimuth_rad"] - b["azimuth_rad"]) / width)

    tally = Tally()
    pairs = tally.scan([[apart(a, b) for b in listed] for a in truth], truth, listed, CUTOFF)
    for name in COMPONENTS:
        tally.apart[name] = [listed[j][name] - truth[i][name] for i, j in pairs]
        tally.truth[name] = [target[name] for target in truth]
        tally.listed[name] = [target[name] for target in listed]
    tally.apart["azimuth_rad"] = [turn(angle) for angle in tally.apart["azimuth_rad"]]
    return tally


class Bench:
    def __init__(self, bin_dir, folder):
        self.folder = folder
        self.environment = dict(os.environ, PATH=os.path.abspath(bin_dir) + os.pathsep + os.environ["PATH"],
                                GLINT_DATA=ROOT + "/data")

    def table(self, text):
        """{figure: (unit, [number or None, ...])} of a table, whose columns must end where their heads do."""
        lines = self.output(text).splitlines()[1:]
        ends = [match.end() for match in re.finditer(r"\S+", lines[0])][1:]
        found = {}
        for line in lines[1:]:
            cells = [match for match in re.finditer(r"\S+", line[36:])]
            check([36 + cell.end() for cell in cells] == ends, f"{text}: not under its heads: {line}")
            found[line[:24].rstrip()] = line[24:36].strip(), [
                None if cell[0] == "-" else float(cell[0]) for cell in cells]
        return found

    def run(self, text):
        return [json.loads(line) for line in self.output(text).splitlines()]

    def output(self, text):
        done = subprocess.run(["bash", "-o", "pipefail", "-c", text], env=self.environment, cwd=self.folder,
                              text=True, capture_output=True, check=False)
        if done.returncode != 0:
            sys.exit(f"score: {text}: exit {done.returncode}: {done.stderr}")
        return done.stdout

    def write(self, name, lines):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.writelines(json.dumps(line) + "\n" for line in lines)


def thin(rng, frames):
    """Lists short enough for trying all assignments, in any order, as no score may depend on that."""
    for frame in frames:
        names = [view["name"] for view in frame["sensors"]["list"]]
        targets = {name: [t for t in frame["targets"] if t["sensor"] == name] for name in names}
        for name in names:
            rng.shuffle(targets[name])
            del targets[name][rng.randint(0, MOST):]
        frame["targets"] = [target for name in names for target in targets[name]]
    return frames


def check_targets(bench, rng, source, suite, azimuth_cell):
    bench.run(f"{source} | glint-extract | glint-ideal --sensors {suite} | glint-sensor -o cells.jsonl")
    truth = thin(rng, bench.run("glint-noise-none cells.jsonl"))
    listed = thin(rng, bench.run("glint-noise-gauss cells.jsonl"))
    bench.write("truth.jsonl", truth)
    shuffled = listed[:]
    rng.shuffle(shuffled)
    shuffled.sort(key=lambda frame: frame["frame"])
    bench.write("list.jsonl", shuffled)
    command = "glint-score --truth truth.jsonl list.jsonl"
    if azimuth_cell is not None:
        command += f" --azimuth-cell-rad {azimuth_cell}"
    lines = {(line["scene"], line["frame"]): line for line in bench.run(command)}
    check(len(lines) == len(truth), f"{source}: {len(lines)} lines for {len(truth)} frames")
    sensors = {}
    for a, b in zip(truth, listed):
        line = lines[a["scene"], a["frame"]]
        views = [view for view in a["sensors"]["list"] if view["measured"]]
        check([score["sensor"] for score in line["sensors"]] == [view["name"] for view in views],
              f"{source}, frame {a['frame']}: other sensors")
        for view, score in zip(views, line["sensors"]):
            tally = scan_targets([t for t in a["targets"] if t["sensor"] == view["name"]],
                                 [t for t in b["targets"] if t["sensor"] == view["name"]], view, azimuth_cell)
            tally.compare(score, f"{source} {a['scene']} {a['frame']} {view['name']}")
            sensors.setdefault(view["name"], Tally()).add(tally)
    summary = bench.run(command + " --summary")[0]
    check_summary(summary, sensors, source)
    check_table(bench.table(command + " --text"), summary["sensors"] + [summary["all"]] * (len(sensors) > 1), "cells",
                source)
    swapped = bench.run(command.replace("truth.jsonl list.jsonl", "list.jsonl truth.jsonl") + " --summary")[0]
    for tally in sensors.values():
        tally.counts = [tally.counts[1], tally.counts[0], tally.counts[2]]
        tally.parts = [(place, false, missed) for place, missed, false in tally.parts]
        tally.truth, tally.listed = tally.listed, tally.truth
        tally.apart = {name: [-value for value in values] for name, values in tally.apart.items()}
    check_summary(swapped, sensors, source + ", swapped")


UNITS = {"range_m": "m", "azimuth_rad": "deg", "range_rate_mps": "m/s", "amplitude_db": "dB", "position_m": "m",
         "velocity_mps": "m/s", "nees": ""}


def rows(score, distance):
    """The table of a score: {figure: (unit, number)}, from its definitions."""
    found = {"missed": ("% of true", 100 * score["missed_count"] / score["true_count"] if score["true_count"] else None),
             "false": ("% of listed",
                       100 * score["false_count"] / score["listed_count"] if score["listed_count"] else None)}
    for key, value in score.items():
        if key in UNITS:
            scale = 180 / math.pi if key == "azimuth_rad" else 1
            found.update({f"{key.rpartition('_')[0] or key} {figure}": (UNITS[key], scale * size)
                          for figure, size in value.items()})
        elif key != "sensor":
            square = key in ("gospa_localisation", "gospa_missed", "gospa_false")
            unit = distance + "^2" * square if key[0] in "go" else ""
            found[key] = unit, value
    return found


def check_table(table, scores, distance, what):
    """A table says what the JSON lines do: in degrees, with units and rates, a column for each score."""
    columns = [rows(score, distance) for score in scores]
    expected = {name: column[name][0] for column in columns for name in column
                if any(other.get(name, (0, None))[1] is not None for other in columns)}
    check({name: unit for name, (unit, _) in table.items()} == expected, f"{what}: rows {list(table)}, not {expected}")
    for name, (unit, numbers) in table.items():
        for number, column in zip(numbers, columns, strict=True):
            value = column.get(name, ("", None))[1]
            rounding = 0.0501 if "%" in unit else max(0.0000501, 0.000501 * abs(value or 0) * (abs(value or 0) >= 1e6))
            near_zero = value is not None and 0 < abs(value) < 0.00005
            good = number is value is None or (None not in (number, value) and abs(number - value) <= (
                0.001 * abs(value) if near_zero else rounding))
            check(good, f"{what}: {name} is {number}, expected {value}")


def check_summary(summary, sensors, what):
    everything = Tally()
    for name, score in zip(sorted(sensors), summary["sensors"]):
        check(score["sensor"] == name, f"{what}: {score['sensor']} stands for {name}")
        sensors[name].compare(score, f"{what}, summary of {name}")
        everything.add(sensors[name])
    everything.compare(summary["all"], what + ", summary")


# ---- tracks -----------------------------------------------------------------------------------


def invented_tracks(rng, frame, names):
    """The objects as a poor tracker might report them; names holds the ids that it gives."""
    tracks = []
    for thing in rng.sample(frame["objects"], min(len(frame["objects"]), MOST - 2)):
        if thing["id"] == frame["ego"] or rng.random() < 0.2:
            continue
        if thing["id"] not in names or rng.random() < 0.1:
            names[thing["id"]] = str(rng.randrange(10**6))
        tracks.append({"id": names[thing["id"]], "x_m": thing["x_m"] + rng.gauss(0, 2),
                       "y_m": thing["y_m"] + rng.gauss(0, 2), "vx_mps": thing["vx_mps"] + rng.gauss(0, 1),
                       "vy_mps": thing["vy_mps"]})
        if rng.random() < 0.5:
            tracks[-1].update(variance_x_m2=4, covariance_xy_m2=rng.uniform(-1.9, 1.9), variance_y_m2=1)
    for _ in range(rng.randint(0, 2)):
        tracks.append({"id": str(rng.randrange(10**6)), "x_m": rng.uniform(-50, 50), "y_m": rng.uniform(-50, 50),
                       "vx_mps": 0, "vy_mps": 0})
    return list({track["id"]: track for track in tracks}.values())


def nees(thing, track):
    """The squared distance over the covariance, by its inverse."""
    dx, dy = track["x_m"] - thing["x_m"], track["y_m"] - thing["y_m"]
    a, b, c = (track[key] for key in ("variance_x_m2", "covariance_xy_m2", "variance_y_m2"))
    return (c * dx * dx - 2 * b * dx * dy + a * dy * dy) / (a * c - b * b)


def is_seen(frame, thing):
    ego = next(o for o in frame["objects"] if o["id"] == frame["ego"])
    for view in frame["sensors"]["list"]:
        cos, sin = math.cos(ego["yaw_rad"]), math.sin(ego["yaw_rad"])
        x = thing["x_m"] - (ego["x_m"] + cos * view["mount_x_m"] - sin * view["mount_y_m"])
        y = thing["y_m"] - (ego["y_m"] + sin * view["mount_x_m"] + cos * view["mount_y_m"])
        azimuth = turn(math.atan2(y, x) - ego["yaw_rad"] - view["mount_yaw_rad"])
        if math.hypot(x, y) <= view["range_max_m"] and abs(azimuth) <= view["field_of_view_rad"] / 2:
            return True
    return False


def counts(frame, thing, which):
    echoing = {c["object"] for target in frame["targets"] for c in target["contributors"]}
    return thing["id"] != frame["ego"] and thing["class"] not in ("guardrail", "post", "wall") and (
        which == "all" or (which == "in_view" and is_seen(frame, thing))
        or (which == "detected" and thing["id"] in echoing))


def lies_on(track, thing):
    """Is the track in the box of an object, or near it? The box is turned to lie along x."""
    away = complex(track["x_m"] - thing["x_m"], track["y_m"] - thing["y_m"]) * cmath.exp(-1j * thing["yaw_rad"])
    beyond = [max(abs(d) - size / 2, 0) for d, size in ((away.real, thing["length_m"]), (away.imag, thing["width_m"]))]
    return math.hypot(*beyond) <= BESIDE_M


def without_excused(frame, truth, tracks):
    """The tracks but those that the best pairs leave over and that lie on an object which does not count."""
    apart = [[math.dist((o["x_m"], o["y_m"]), (t["x_m"], t["y_m"])) for t in tracks] for o in truth]
    paired = {j for _, j in Tally().scan(apart, truth, tracks, CUTOFF_M)}
    others = [one for one in frame["objects"] if one["id"] != frame["ego"] and one not in truth]
    return [one for j, one in enumerate(tracks) if j in paired or not any(lies_on(one, other) for other in others)]


def check_tracks(bench, rng, frames, which):
    names, last = {}, {}
    lines = [{"scene": frame["scene"], "frame": frame["frame"], "time_s": frame["time_s"],
              "tracks": invented_tracks(rng, frame, names)} for frame in frames]
    bench.write("frames.jsonl", frames)
    bench.write("tracks.jsonl", lines)
    command = f"glint-score-tracks --tracks tracks.jsonl frames.jsonl --objects {which}"
    scores, everything, total, excused = bench.run(command), Tally(), 0, 0
    check(len(scores) == len(frames), f"{len(scores)} lines of tracks for {len(frames)} frames")
    for frame, line, score in zip(frames, lines, scores):
        truth = [thing for thing in frame["objects"] if counts(frame, thing, which)]
        tally, tracks = Tally(), without_excused(frame, truth, line["tracks"])
        excused += len(line["tracks"]) - len(tracks)
        pairs = tally.scan([[math.dist((o["x_m"], o["y_m"]), (t["x_m"], t["y_m"])) for t in tracks] for o in truth],
                           truth, tracks, CUTOFF_M)
        tally.apart["position_m"] = [math.dist((truth[i]["x_m"], truth[i]["y_m"]), (tracks[j]["x_m"], tracks[j]["y_m"]))
                                     for i, j in pairs]
        tally.apart["velocity_mps"] = [math.hypot(truth[i]["vx_mps"] - tracks[j]["vx_mps"],
                                                  truth[i]["vy_mps"] - tracks[j]["vy_mps"]) for i, j in pairs]
        tally.apart["nees"] = [nees(truth[i], tracks[j]) for i, j in pairs if "variance_x_m2" in tracks[j]]
        switches = sum(last.get(truth[i]["id"], tracks[j]["id"]) != tracks[j]["id"] for i, j in pairs)
        last.update((truth[i]["id"], tracks[j]["id"]) for i, j in pairs)
        tally.compare(score["all"], f"tracks {which} {frame['frame']}")
        check(score["id_switches"] == switches,
              f"tracks {which} {frame['frame']}: {score['id_switches']} switches, expected {switches}")
        everything.add(tally)
        total += switches
    summary = bench.run(command + " --summary")[0]
    everything.compare(summary["all"], f"tracks {which}, summary")
    check_table(bench.table(command + " --text"), [summary["all"]], "m", f"tracks {which}")
    check(summary["id_switches"] == total > 0, f"tracks {which}: {summary['id_switches']} switches, expected {total}")
    check((which == "all") <= (excused == 0) and (which == "detected") <= (excused > 0), f"tracks {which}: {excused} are excused")


# ---- ensembles --------------------------------------------------------------------------------


def embed(frame, sensor, azimuth_cell):
    """Targets in cells and steps of 3 dB."""
    return [(target["range_m"] / sensor["cell_range_m"], target["azimuth_rad"] / azimuth_cell,
             target["range_rate_mps"] / sensor["cell_range_rate_mps"], target["amplitude_db"] / 3)
            for target in frame["targets"] if target["sensor"] == sensor["name"]]


def kernels(one, other):
    """Sum of the kernels of three widths over all pairs."""
    return math.fsum(math.exp(-math.dist(a, b) ** 2 / (2 * width ** 2))
                     for a in one for b in other for width in (1, 3, 10))


def apart(one, other):
    return math.sqrt(max(0, kernels(one, one) + kernels(other, other) - 2 * kernels(one, other)))


def energy(ones, others):
    """The U-statistic of 2 E d(X, Y) - E d(X, X') - E d(Y, Y')."""
    def among(lists):
        pairs = [apart(a, b) for i, a in enumerate(lists) for b in lists[:i]]
        return sum(pairs) / len(pairs)

    between = [apart(a, b) for a in ones for b in others]
    return 2 * sum(between) / len(between) - among(ones) - among(others)


def jackknife(ones, others, mean):
    """The standard error of the mean over lists of the energy distance, of lists by seed, and its degrees of freedom
    by Welch and Satterthwaite."""
    variances = []
    for part in (ones, others):
        left_out = [mean([of for of in ones if of is not seed], [of for of in others if of is not seed])
                    for seed in part]
        middle = sum(left_out) / len(part)
        variances.append((len(part) - 1) / len(part) * sum((value - middle) ** 2 for value in left_out))
    freedom = sum(variances) ** 2 / sum(one ** 2 / (len(part) - 1) for one, part in zip(variances, (ones, others)))
    return math.sqrt(sum(variances)), freedom


def student(freedom):
    """The 97.5 % quantile of Student's distribution: its density, summed up by steps of 1e-4."""
    density = math.gamma((freedom + 1) / 2) / math.sqrt(freedom * math.pi) / math.gamma(freedom / 2)
    place, below, step = 0.0, 0.5, 1e-4
    while below < 0.975:
        below += step * density * (1 + (place + step / 2) ** 2 / freedom) ** (-(freedom + 1) / 2)
        place += step
    return place


def check_ensemble(bench):
    """Two models of one scene, with four and five seeds."""
    def stream(sensor, seeds):
        return [frame for seed in seeds for frame in bench.run(
            f"glint-traffic two-vehicles --seed {seed} | glint-extract"
            f" | glint-ideal --sensors srr24-pair-every-frame | {sensor} | glint-noise")[:6]]

    truth, listed = stream("glint-sensor", range(1, 5)), stream("glint-sensor-smear", range(11, 16))
    bench.write("truth.jsonl", truth)
    bench.write("list.jsonl", listed)
    score, = bench.run("glint-score --ensemble --azimuth-cell-rad 0.05 --truth truth.jsonl list.jsonl")
    scene, = score["scenes"]
    sensors = truth[0]["sensors"]["list"]

    def by_seed(frames):
        seeds = {}
        for frame in frames:
            seeds.setdefault(frame["seed"], []).extend(embed(frame, sensor, 0.05) for sensor in sensors)
        return list(seeds.values())

    def mean(ones, others):
        values = [energy([seed[k] for seed in ones], [seed[k] for seed in others]) for k in range(len(ones[0]))]
        return sum(values) / len(values)

    ones, others = by_seed(truth), by_seed(listed)
    error, freedom = jackknife(ones, others, mean)
    near(score["energy"], mean(ones, others), "ensemble: energy")
    near(scene["energy_error"], error, "ensemble: error")
    high = score["energy"] + student(freedom) * error
    check(abs(score["high"] - high) < 0.01 * student(freedom) * error, f"ensemble: high: {score['high']}, expected {high}")
    near(scene["true_targets"], sum(len(of) for seed in ones for of in seed) / len(ones) / len(ones[0]),
         "ensemble: targets")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    rng = random.Random(7)
    with tempfile.TemporaryDirectory(prefix="glint-score.") as folder:
        bench = Bench(sys.argv[1], folder)
        for source, suite, azimuth_cell in (
                ("glint-traffic-random --density medium --frames 60", "srr24-pair-every-frame", None),
                ("glint-traffic-random --density dense --frames 40 --seed 3", "corner77-every-frame", 0.1),
                ("glint-traffic cut-in", "corner77", 0.02)):
            check_targets(bench, rng, source, suite, azimuth_cell)
        # Frames of 20 Hz last longer than the cycle of this radar, so that each has a scan.
        frames = bench.run("glint-traffic highway-straight --radius-m 60 | glint-extract"
                           " | glint-ideal --sensors srr24-pair | glint-sensor | glint-noise")[:80]
        for which in ("all", "in_view", "detected"):
            check_tracks(bench, rng, frames, which)
        check_ensemble(bench)
    print(f"score: {checks} checks, {failures} failed")
    return 1 if failures else 0


sys.exit(main())
