"""The radars of tests/tools/accuracy-cost and the frames that they look at."""
import json
import math
import os
import subprocess
import sys

import chains

sys.path.append(os.path.join(chains.ROOT, "tests", "support"))
import suites  # noqa: E402

SEEDS = 4  # in a block
OF_CHAINS = 1000  # seeds of chains begin behind those of the reference
HIGHWAY = "data/trajectories/highway.csv --radius-m 250 --scene highway"

# Scripted scenes, vehicles of the recorded table that carry the radar, and frames of random traffic.
LONG = {"scripted": ["corner-approach", "cut-in", "empty-road", "highway-straight", "intersection", "open-road",
                     "shadows", "two-vehicles", "walled-road", "wet-road", "wheels-and-limbs"],
        "recorded": ["3", "5", "9", "13"], "random": {"sparse": 12, "medium": 26, "dense": 26}}
SHORT = {"scripted": ["corner-approach", "cut-in", "empty-road", "highway-straight", "intersection", "open-road",
                      "shadows", "side-crossing", "two-vehicles"],
         "recorded": ["1", "5", "7", "13"], "random": {"medium": 32, "dense": 32}}
# Beside a road, with levels in place of fluctuation. Single frames show what both gain and cost, not how they last.
ROADSIDE = {"scripted": ["motorway"], "recorded": [], "random": {"sparse --roadside": 12, "medium --roadside": 20,
                                                                 "dense --roadside": 12}}
MOST = 4  # candidates of random traffic for each frame that is taken
EACH = 2  # frames of a scripted scene, and of a drive of the recorded table
DRY = {"road": "asphalt", "clutter_per_m2": 1e-3, "clutter_ercs": 0.05}
RAIN = DRY | {"rain_mmph": 10, "fog_gpm3": 0.1}
SIZES = ["small", "medium", "large"]
AZIMUTH_CELL_RAD = {"long": math.radians(1.6), "short": math.radians(9), "roadside": math.radians(1.6)}  # units of scores, finer than the beam

# What lrr77-full says of itself; all else that it has and a suite lacks is taken from it, so that every
# effect exists. Steps are those of the radar of long range.
OF_ITS_OWN = ["sources", "antenna_table", "unambiguous_range_m", "unambiguous_rate_mps", "false_alarms",
              "false_alarm_range_rate_mps"]
LEVELS = ["level_constant_db", "level_slow_db", "level_slow_m", "level_fast_db", "level_keeps"]
FLUCTUATION = {"fluctuation": "log_normal", "fluctuation_sigma_db": 3.41}  # one draw a scan, in place of levels
OF_LONG_RANGE = ["range_step_m", "range_rate_step_mps", "azimuth_step_rad"]


def described(suite, repetitions, most_repetitions, rate_mps, cells=16, without=(), levels=False):
    """The suite with every effect and a scan in every frame, without a second train: chain and signal fold
    alike. Fewer repetitions of the same chirps or pulses tell rates apart less well."""
    full = suites.whole("lrr77-full")["sensors"][0]
    taken = {key: value for key, value in full.items() if key not in [*OF_ITS_OWN, *LEVELS, *without]}
    taken |= {key: full[key] for key in LEVELS if key in full} if levels else FLUCTUATION
    for number, sensor in enumerate(suite["sensors"]):
        sensor = suite["sensors"][number] = taken | sensor
        sensor.pop("cycle_s", None)
        sensor["unambiguous_rate_mps"] = rate_mps * most_repetitions / 2
        sensor["cell_range_rate_mps"] = rate_mps * most_repetitions / repetitions
        sensor["range_sigma_m"] = 0.1 * sensor["cell_range_m"]
        sensor["range_rate_sigma_mps"] = 0.1 * sensor["cell_range_rate_mps"]
        sensor["false_alarm_range_rate_mps"] = sensor["unambiguous_rate_mps"]
        sensor["waveform"] |= {"repetitions": repetitions, "cfar_cells": cells, "cfar_rank": 3 * cells // 4}
        sensor["waveform"].pop("stagger", None)
    return suite


def long_range(size, levels=False):
    """A chirp every 20 us: 256 of them part rates by 0.383 m/s."""
    suite = suites.whole(f"lrr77-signal-{size}")
    return described(suite, suite["sensors"][0]["waveform"]["repetitions"], 256, 97.971392 / 256, levels=levels)


def short_range(size):
    """Fewer pulses leave less room for the noise's window."""
    repetitions, cells = {"small": (28, 8), "medium": (40, 12), "large": (64, 16)}[size]
    return described(suites.whole("srr24-signal"), repetitions, 64, 0.5, cells, OF_LONG_RANGE)


def beside_a_road(size):
    return long_range(size, True)


def played(text):
    done = subprocess.run([chains.GLINT, "-c", text], check=True, stdout=subprocess.PIPE, cwd=chains.ROOT)
    return [json.loads(line) for line in done.stdout.splitlines()]


def evenly(items, count):
    """As many of the items, from the middles of equal pieces; all where there are no more."""
    if len(items) <= count:
        return items
    return [items[(2 * i + 1) * len(items) // (2 * count)] for i in range(count)]


def recorded(egos):
    """Drives of one table are one scene: they share its traffic. Frames and times ascend."""
    return [frame | {"frame": frame["frame"] + 1000 * drive, "time_s": frame["time_s"] + 100 * drive}
            for drive, ego in enumerate(egos) for frame in evenly(played(f"glint-traffic {HIGHWAY} --ego {ego}"), 24)]


class Radar:
    """A radar's suites by size, and frames in which it lists something; again: other frames than those of the tables."""

    def __init__(self, name, cache, few=False, again=False):
        of_size, self.plan = {"long": (long_range, LONG), "short": (short_range, SHORT),
                             "roadside": (beside_a_road, ROADSIDE)}[name]
        self.name, self.cache, self.few, self.again = name, cache, few, again
        self.lasting = name == "roadside"  # do levels and a roadside stay from scan to scan?
        self.score = ["--azimuth-cell-rad", repr(AZIMUTH_CELL_RAD[name])]  # options of glint-score
        self.suites = {size: self.suite_file(of_size(size)) for size in SIZES}
        with open(self.suites["large"]) as suite:
            self.cell_range_m = json.load(suite)["sensors"][0]["cell_range_m"]
        self.contour = f"glint-extract-contour --spacing-m {self.cell_range_m / 3:.9g}"
        self.frames = self.few_frames() if few else self.chosen()
        self.first = cache.text(".jsonl", lines_of(self.frames[:1], [1]))

    def suite_file(self, suite):
        """The suite with its antenna's tables beside it: its text and name are the same in every folder."""
        for sensor in suite["sensors"]:
            for member in {"antenna_table", "azimuth_curve"} & sensor.keys():
                with open(os.path.join(suites.FOLDER, sensor[member])) as table:
                    sensor[member] = os.path.basename(self.cache.text(".csv", table.read()))
        return self.cache.text(".json", json.dumps(suite))

    def few_frames(self):
        """The sample: one frame from each of a few scenes."""
        some = self.plan["scripted"][1:6] or self.plan["scripted"]
        scripted = [frame for scene in some for frame in evenly(played(f"glint-traffic {scene}"), 1)]
        density = list(self.plan["random"])[-1]
        return weathered(scripted + played(f"glint-traffic-random --density {density} --frames 3"))

    def chosen(self):
        """Candidates are more than what is taken of them: frames in which the smallest signal sees a target."""
        found = []
        for scene in self.plan["scripted"]:
            found += self.taken(self.seen(evenly(played(f"glint-traffic {scene}"), 24)))
        drives = self.seen(recorded(self.plan["recorded"]))
        for drive in range(len(self.plan["recorded"])):
            found += self.taken([frame for frame in drives if frame["frame"] // 1000 == drive])
        for density, count in self.plan["random"].items():
            first = 1000 if self.again else 0
            found += self.seen(played(f"glint-traffic-random --density {density} --first {first} --frames {MOST * count}"))[:count]
        return weathered(found)

    def taken(self, candidates):
        """The frames that are taken from one drive."""
        kept = evenly(candidates, EACH)
        return evenly([frame for frame in candidates if frame not in kept], EACH) if self.again else kept

    def seen(self, frames):
        """Those in which the smallest signal lists an object in 3 of 4 draws."""
        chain = chains.Chain("choice", "signal, small", self, chains.SIGNAL, size="small")
        lists = chain.lists(self.cache, self.cache.text(".jsonl", lines_of(weathered(frames), range(1, 5))))
        hits = {}
        for line in chains.content(lists).splitlines():
            listed = json.loads(line)
            scan = listed["scene"], listed["frame"]
            hits[scan] = hits.get(scan, 0) + any(map(of_an_object, listed["targets"]))
        return [frame for frame in frames if hits[frame["scene"], frame["frame"]] >= 3]

    def block(self, number, first=0):
        """The file of all frames under as many seeds, seed by seed."""
        seeds = range(first + 1 + number * SEEDS, first + 1 + (number + 1) * SEEDS)
        return self.cache.text(".jsonl", lines_of(self.frames, seeds))

    def one_seed(self):
        """The file of all frames under the first seed of chains."""
        return self.cache.text(".jsonl", lines_of(self.frames, [OF_CHAINS + 1]))


def of_an_object(target):
    """Neither a false alarm nor clutter."""
    return any(part["path"] not in ("false_alarm", "clutter") for part in target["contributors"])


def weathered(frames):
    """Dry and in rain in turn, on asphalt with ground clutter, where the scene says nothing else."""
    return [frame | {"conditions": (RAIN if number % 2 else DRY) | frame.get("conditions", {})}
            for number, frame in enumerate(frames)]


def lines_of(frames, seeds):
    """The frames under each seed; that a frame is the last of its scene does not hold any more."""
    kept = [{key: value for key, value in frame.items() if key != "last"} for frame in frames]
    return "".join(json.dumps(frame | {"seed": str(seed)}) + "\n" for seed in seeds for frame in kept)
