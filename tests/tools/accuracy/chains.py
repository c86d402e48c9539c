"""Chains of stages from frames to target lists: what they are, their lists and their time."""
import functools
import gzip
import hashlib
import os
import shlex
import subprocess
import sys

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))
BUILD = os.path.join(ROOT, os.environ.get("BUILD", "build"))
BIN = os.path.join(BUILD, "bin")
GLINT = os.path.join(BIN, "glint")

# The effects of the paper's model. Folding is the waveform's, which all have.
PAPER = ["visibility", "plane_reflection", "rows", "occlusion", "ambiguity", "merging", "superposition",
         "threshold", "angle_noise", "range_noise", "final_threshold", "list_limit"]
SENSOR, SIGNAL = "glint-sensor | glint-noise", "glint-sensor-signal"
REFERENCE = "reference"


def digest(*parts):
    """Of texts and bytes, twelve hexadecimal digits of SHA-256."""
    whole = hashlib.sha256()
    for part in parts:
        data = part if isinstance(part, bytes) else str(part).encode()
        whole.update(b"%d:" % len(data) + data)
    return whole.hexdigest()[:12]


def content(path):
    with (gzip.open if path.endswith(".gz") else open)(path, "rb") as file:
        return file.read()


@functools.lru_cache(None)
def program_digest(name):
    return digest(content(os.path.join(BIN, name)))


class Cache:
    """A folder of files, each named by a digest of all that it depends on."""

    def __init__(self, folder):
        self.folder = folder
        os.makedirs(folder, exist_ok=True)

    def file(self, ending, key, make):
        """The file of that key; make(path) writes it where it is missing, whole or not at all."""
        path = os.path.join(self.folder, digest(*key) + ending)
        if not os.path.exists(path):
            new = f"{path[:-len(ending)]}.{os.getpid()}{ending}"
            make(new)
            os.rename(new, path)
        return path

    def text(self, ending, text):
        def write(path):
            with open(path, "w") as out:
                out.write(text)
        return self.file(ending, (text,), write)


def cpu_s(words):
    """CPU time of a command and of all that it started."""
    child = subprocess.Popen(words, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"accuracy-cost: {shlex.join(words)}: exit status {child.returncode}")
    return usage.ru_utime + usage.ru_stime


class Chain:
    """All stages in one process. A name is unique in its group; base names the chain of `models` that it is
    compared with: of a chain of another group, the one from which it differs by an effect."""

    def __init__(self, group, name, radar, sensor=SENSOR, effects="all", extract="glint-extract", size="large",
                 base=None):
        self.group, self.name, self.radar, self.base = group, name, radar, base
        self.suite = radar.suites[size]
        suite = f" --sensors {self.suite}"
        self.stages = [extract, f"glint-ideal{suite} --effects {effects}"]
        self.stages += [stage + suite for stage in sensor.split(" | ")]
        self.slow = sensor == SIGNAL

    def text(self, files, out):
        return " | ".join([f"{self.stages[0]} {' '.join(files)}", *self.stages[1:]]) + f" -o {out}"

    def run(self, files, out="/dev/null", words=(GLINT,)):
        """Its CPU time in seconds."""
        return cpu_s([*words, "-c", self.text(files, out)])

    def lists(self, cache, frames):
        """The file with the lists of a file of frames."""
        programs = [program_digest(stage.split()[0]) for stage in self.stages]
        texts = [stage.replace(self.suite, os.path.basename(self.suite)) for stage in self.stages]
        return cache.file(".jsonl.gz", [*programs, *texts, os.path.basename(frames)],
                          lambda path: self.run([frames], path))

    def digest(self, frames):
        """Of its suite, whose name says what is in it, the program's version and the lists of the frames; the
        signal's lists do not count, because FFTW rounds them as its version does."""
        version = subprocess.run([GLINT, "--version"], check=True, stdout=subprocess.PIPE).stdout
        made = b""
        if not self.slow:
            made = subprocess.run([GLINT, "-c", self.text([frames], "/dev/stdout")], check=True,
                                  stdout=subprocess.PIPE).stdout
        name = os.path.basename(self.suite)
        return digest(version, name, made.replace(self.suite.encode(), name.encode()))

    def frame_us(self, frames, count, repeat):
        """CPU time of a frame, without start-up and the first frame."""
        files = [frames] * (1 if self.slow else repeat)
        spent = self.run(files) - self.run([self.radar.first])
        return 1e6 * spent / (count * len(files) - 1)


@functools.lru_cache(None)
def effects_known():
    done = subprocess.run([GLINT, "--list", "effects"], check=True, stdout=subprocess.PIPE, text=True)
    return [line.split()[0] for line in done.stdout.splitlines()]


def reference(radar):
    """The largest signal of the same reflection centres."""
    return Chain(REFERENCE, "signal, large", radar, SIGNAL)


# What each model is compared with.
BASES = {"gauss": "perfect", "paper": "perfect", "all effects": "paper", "all effects, 3gpp": "all effects",
         "all effects, contour": "all effects", "smear": "all effects", "signal, small": "smear",
         "signal, medium": "signal, small"}


# Of the radar whose levels and roadside last, these are measured; it has no fluctuation, and no frame has snow.
FEW_MODELS = ("perfect", "paper", "all effects", "smear", "signal, small")
FEW_EFFECTS = ("roadside", "level", "clutter", "fluctuation", "snow")


def models(radar):
    paper = ",".join(PAPER)
    made = [("perfect", {"sensor": "glint-sensor-perfect | glint-noise-none", "effects": paper}),
            ("gauss", {"sensor": "glint-sensor-perfect | glint-noise-gauss", "effects": paper}),
            ("paper", {"effects": paper}),
            ("all effects", {}),
            ("all effects, 3gpp", {"extract": "glint-extract-3gpp"}),
            ("all effects, contour", {"extract": radar.contour}),
            ("smear", {"sensor": "glint-sensor-smear | glint-noise"}),
            ("signal, small", {"sensor": SIGNAL, "size": "small"}),
            ("signal, medium", {"sensor": SIGNAL, "size": "medium"})]
    return [Chain("models", name, radar, base=BASES.get(name), **how) for name, how in made
            if name in FEW_MODELS or not radar.lasting]


def measured_effects(radar):
    return [effect for effect in effects_known() if effect in FEW_EFFECTS or not radar.lasting]


def added(radar):
    """Each effect added to the paper's."""
    return [Chain("added", effect, radar, effects=",".join([*PAPER, effect]), base="paper")
            for effect in measured_effects(radar) if effect not in PAPER]


def left_out(radar):
    """Each effect left out of all."""
    return [Chain("left out", effect, radar, effects=f"all,-{effect}", base="all effects")
            for effect in measured_effects(radar)]
