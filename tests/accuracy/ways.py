"""What scripts/accuracy-cost compares: radars, frames, and ways from frames to target lists."""
import decimal
import gzip
import json
import os
import re
import shlex
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.path.join(ROOT, os.environ.get("BUILD", "build"))
BIN = os.path.join(BUILD, "bin")
GLINT = os.path.join(BIN, "glint")

LONG = ["highway-straight", "walled-road", "wet-road", "shadows", "cut-in"]
SHORT = ["two-vehicles", "side-crossing", "corner-approach", "intersection", "wheels-and-limbs"]
WEATHER = {"road": "asphalt", "rain_mmph": 10, "fog_gpm3": 0.1, "clutter_per_m2": 1e-3, "clutter_ercs": 0.05}
# Folding is the waveform's, which all have.
PAPER = ["visibility", "plane_reflection", "rows", "occlusion", "ambiguity", "merging", "superposition",
         "threshold", "angle_noise", "range_noise", "final_threshold", "list_limit"]
SIZES = ["small", "medium", "large"]
CHAIN, SIGNAL = "glint-sensor | glint-noise", "glint-sensor-signal"


class Plan:
    """Scenes of a radar, frames of a scene, seeds; rounds of timing, and how often each reads all."""

    def __init__(self, scenes, frames, seeds, rounds, repeat):
        self.scenes, self.frames, self.seeds = scenes, frames, seeds
        self.rounds, self.repeat = rounds, repeat


# --- radars and frames -----------------------------------------------------------------------------

# What a sensor has to say so that an effect exists: taken from where all are described, but for
# false alarms, of which noise 18 dB below the threshold makes none.
DESCRIBED = ["mount_z_m", "elevation_half_width_rad", "diffraction", "curved_sides", "micro_motion",
             "latency_s", "bounces", "fluctuation", "fluctuation_sigma_db", "receiver_bandwidth_hz",
             "noise_figure_db", "antenna_gain_dbi", "chirp_slope_hzps", "chirp_s", "sigma_law",
             "window_factor", "misalignment_rad", "radome_bias_rad", "radome_period_rad",
             "radome_phase_rad"]


def sensors(name):
    with open(os.path.join(ROOT, "data", "sensors", name + ".json")) as text:
        return json.load(text)


def described(suite, repetitions, most_repetitions, rate_mps):
    """The suite with every effect. Fewer repetitions of the same chirps or pulses tell rates apart
    less well, and fold them alike."""
    full = sensors("lrr77-full")["sensors"][0]
    for sensor in suite["sensors"]:
        sensor |= {key: full[key] for key in DESCRIBED}
        sensor["unambiguous_rate_mps"] = rate_mps * most_repetitions / 2
        sensor["cell_range_rate_mps"] = rate_mps * most_repetitions / repetitions
        sensor["range_sigma_m"] = 0.1 * sensor["cell_range_m"]
        sensor["range_rate_sigma_mps"] = 0.1 * sensor["cell_range_rate_mps"]
        sensor["waveform"]["repetitions"] = repetitions
        if "antenna_table" in sensor:
            sensor["antenna_table"] = os.path.join(ROOT, "data", "sensors", sensor["antenna_table"])
    return suite


def long_range(size):
    """A chirp every 20 us: 256 of them part rates by 0.383 m/s."""
    suite = sensors(f"lrr77-signal-{size}")
    return described(suite, suite["sensors"][0]["waveform"]["repetitions"], 256, 97.971392 / 256)


def short_range(size):
    repetitions = {"small": 24, "medium": 40, "large": 64}[size]
    return described(sensors("srr24-signal"), repetitions, 64, 0.5)


class Radar:
    """Its suites in three sizes, and its frames: once for each seed, as scenes of their own. Those
    of `others` have the same names and other seeds. Both are in one shard a round."""

    def __init__(self, name, suites, scenes, plan, folder):
        self.name, self.folder = name, folder
        self.suites = {size: os.path.join(folder, f"{name}-{size}.json") for size in SIZES}
        for size, path in self.suites.items():
            suite = suites(size)
            self.cell_range_m = suite["sensors"][0]["cell_range_m"]
            with open(path, "w") as out:
                json.dump(suite, out)
        frames = [frame for scene in scenes[:plan.scenes] for frame in frames_of(scene, plan.frames)]
        parts = [range(first, plan.seeds, plan.rounds) for first in range(plan.rounds)]
        self.shards = [self.write(f"frames-{i}", frames, seeds, 1000) for i, seeds in enumerate(parts)]
        self.others = [self.write(f"others-{i}", frames, seeds, 0) for i, seeds in enumerate(parts)]
        self.one = self.write("one", frames[:1], [0], 1000)
        self.count = len(frames) * plan.seeds

    def write(self, what, frames, seeds, offset):
        path = os.path.join(self.folder, f"{self.name}-{what}.jsonl")
        with open(path, "w") as out:
            for seed in seeds:
                for frame in frames:
                    own = {"scene": f"{frame['scene']}#{seed}", "seed": str(seed + offset + 1)}
                    out.write(json.dumps(frame | own) + "\n")
        return path


def frames_of(scene, count):
    """Some frames, evenly over a scene."""
    done = subprocess.run([GLINT, "-c", f"glint-traffic {scene}"], check=True, stdout=subprocess.PIPE)
    made = done.stdout.splitlines()
    some = [json.loads(made[(2 * i + 1) * len(made) // (2 * count)]) for i in range(count)]
    return [frame | {"conditions": WEATHER | frame.get("conditions", {})} for frame in some]


# --- ways ------------------------------------------------------------------------------------------

def cpu_s(words):
    """CPU time of a command and all that it started."""
    child = subprocess.Popen(words, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"accuracy-cost: {shlex.join(words)}: exit status {child.returncode}")
    return usage.ru_utime + usage.ru_stime


def content(path):
    with (gzip.open if path.endswith(".gz") else open)(path, "rb") as text:
        return text.read()


class Way:
    """One point of a ladder, all stages in one process. `lists` are its target lists, `cpu_ns` the
    times per frame, `bytes` what it writes per frame."""

    def __init__(self, ladder, name, radar, sensor=CHAIN, effects="all", extract="glint-extract",
                 size="large", options=""):
        self.ladder, self.name, self.radar = ladder, name, radar
        self.slow = sensor == SIGNAL
        self.stages = [extract, f"glint-ideal --sensors {radar.suites[size]} --effects {effects} {options}",
                       *sensor.split(" | ")]
        self.place = os.path.join(radar.folder, re.sub(r"\W+", "_", f"{radar.name}-{ladder}-{name}"))
        self.lists, self.cpu_ns, self.bytes = [], [], 0

    def run(self, files, out="/dev/null", words=(GLINT,)):
        text = " | ".join([f"{self.stages[0]} {' '.join(files)}", *self.stages[1:]])
        return cpu_s([*words, "-c", f"{text} -o {out}"])

    def make(self, shards):
        """The signal takes long enough that making its lists is the timing, too."""
        for number, shard in enumerate(shards):
            self.lists.append(f"{self.place}-{number}.jsonl")
            spent = self.run([shard], self.lists[-1])
            if self.slow:
                frames = content(shard).count(b"\n")
                self.cpu_ns.append(1e9 * (spent - self.run([self.radar.one])) / (frames - 1))
        self.bytes = sum(map(os.path.getsize, self.lists)) / self.radar.count

    def time(self, plan):
        """One round, without start-up and first frame."""
        if self.slow:
            return
        spent = self.run(self.radar.shards * plan.repeat) - self.run([self.radar.one])
        self.cpu_ns.append(1e9 * spent / (self.radar.count * plan.repeat - 1))


class Plumbed(Way):
    """The same text in one process or as bash's pipe, into one file."""

    def __init__(self, name, radar, words, ending=".jsonl"):
        super().__init__("plumbing", name, radar)
        self.words, self.lists = words, [self.place + ending]

    def make(self, shards):
        self.run(shards, self.lists[0], self.words)
        self.bytes = os.path.getsize(self.lists[0]) / self.radar.count

    def time(self, plan):
        again = self.lists[0].replace("plumbing", "again")
        spent = (self.run(self.radar.shards * plan.repeat, again, self.words)
                 - self.run(self.radar.shards, again, self.words))
        self.cpu_ns.append(1e9 * spent / (self.radar.count * (plan.repeat - 1)))


class Staged(Way):
    """Stage by stage from file to file, which may lose digits on the way."""

    def __init__(self, ladder, name, radar, digits=None, ending=".jsonl"):
        super().__init__(ladder, name, radar)
        self.digits = digits
        self.files = [f"{self.place}-{number}{ending}" for number in range(len(self.stages))]
        self.lists = self.files[-1:]

    def run_stage(self, number, inputs, out):
        words = self.stages[number].split()
        return cpu_s([os.path.join(BIN, words[0]), *words[1:], *inputs, "-o", out])

    def make(self, shards):
        for number, out in enumerate(self.files):
            self.run_stage(number, self.files[number - 1:number] or shards, out)
            if self.digits:
                shorten(out, self.digits)
            self.bytes += os.path.getsize(out) / self.radar.count

    def time(self, plan):
        spent = 0
        for number, out in enumerate(self.files):
            inputs = self.files[number - 1:number] or self.radar.shards
            again = out.replace(self.ladder, "again")
            spent += (self.run_stage(number, inputs * plan.repeat, again)
                      - self.run_stage(number, inputs, again))
        self.cpu_ns.append(1e9 * spent / (self.radar.count * (plan.repeat - 1)))


NUMBERS = re.compile(rb'"(?:[^"\\]|\\.)*"|-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?')


def cut(line, digits):
    """The line with that many significant digits in every number that is not whole. Towards zero,
    so that nothing passes its bound."""
    context = decimal.Context(prec=digits, rounding=decimal.ROUND_DOWN)

    def shorter(found):
        word = found[0]
        if word[:1] == b'"' or not re.search(rb"[.eE]", word):
            return word
        return str(context.create_decimal(word.decode())).encode()
    return NUMBERS.sub(shorter, line)


def shorten(path, digits):
    with open(path, "rb") as text:
        lines = [cut(line, digits) for line in text]
    with open(path, "wb") as text:
        text.writelines(lines)


# --- ladders ---------------------------------------------------------------------------------------

def effects_known():
    done = subprocess.run([GLINT, "--list", "effects"], check=True, stdout=subprocess.PIPE, text=True)
    return [line.split()[0] for line in done.stdout.splitlines() if line[0] != " "]


def references(radar):
    """The contour's scatterers lie three to a range cell, or closer."""
    contour = f"glint-extract-contour --spacing-m {radar.cell_range_m / 3:.9g}"
    return {"centres": Way("reference", "centres", radar, SIGNAL),
            "contour": Way("reference", "contour", radar, SIGNAL, extract=contour)}


def models(radar):
    paper = ",".join(PAPER)
    named = [("perfect", paper, "glint-sensor-perfect | glint-noise-none"),
             ("gauss", paper, "glint-sensor-perfect | glint-noise-gauss"),
             ("paper, no merging", paper.replace("merging,", ""), CHAIN),
             ("paper", paper, CHAIN)]
    named += [(f"paper + {effect}", f"{paper},{effect}", CHAIN)
              for effect in effects_known() if effect not in PAPER]
    named += [("all effects", "all", CHAIN), ("smear", "all", "glint-sensor-smear | glint-noise")]
    return ([Way("models", name, radar, sensor, effects) for name, effects, sensor in named]
            + [Way("models", f"signal, {size}", radar, SIGNAL, size=size) for size in SIZES[:-1]]
            + [Way("models", f"all effects, {name}", radar, extract=f"glint-extract-{name}")
               for name in ("3gpp", "contour")])


def spacing(radar):
    return [Way("spacing", f"{metres:g} m", radar, extract=f"glint-extract-contour --spacing-m {metres:g}")
            for metres in (2, 1, 0.5, 0.2, 0.1, 0.05)]


def digits(radar):
    return [Staged("digits", str(count), radar, count) for count in (3, 4, 6, 9, 12)] + [
        Staged("digits", "all", radar)]


def plumbing(radar):
    return [Plumbed("one process", radar, [GLINT]), Plumbed("one process, .gz", radar, [GLINT], ".jsonl.gz"),
            Plumbed("pipes", radar, ["bash"]), Staged("plumbing", "files", radar),
            Staged("plumbing", "files, .gz", radar, ending=".jsonl.gz")]
