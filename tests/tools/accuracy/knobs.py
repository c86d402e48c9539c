"""What else costs time or accuracy in tests/tools/accuracy-cost: spacing, digits, plumbing, tables of angles."""
import decimal
import json
import os
import re
import statistics
import subprocess
import sys

import chains
from chains import Chain

SPACINGS = [2, 1, 0.5, 0.2, 0.1, 0.05]  # m
DIGITS = [3, 4, 6, 9, 12]


def spacings(radar):
    """All effects on contours; the finest is what the others are compared with."""
    return [Chain("spacing", f"{metres:g} m", radar, extract=f"glint-extract-contour --spacing-m {metres:g}")
            for metres in SPACINGS]


class Knob:
    """A setting of all effects on one file of frames. `lists` is its file of lists; it writes `bytes` a
    frame on the way."""

    def __init__(self, group, name, radar, folder, ending=".jsonl"):
        self.group, self.name, self.radar = group, name, radar
        self.chain = Chain(group, name, radar)
        self.place = os.path.join(folder, re.sub(r"\W+", "_", f"{radar.name}-{group}-{name}"))
        self.lists, self.bytes = self.place + ending, 0


class Plumbed(Knob):
    """The same text in one process or as bash's pipe, into one file."""

    def __init__(self, name, radar, folder, words, ending=".jsonl"):
        super().__init__("plumbing", name, radar, folder, ending)
        self.words, self.ending = words, ending

    def make(self, frames, count):
        self.chain.run([frames], self.lists, self.words)
        self.bytes = os.path.getsize(self.lists) / count

    def frame_us(self, frames, count, repeat):
        again = self.place + "-again" + self.ending
        spent = self.chain.run([frames] * repeat, again, self.words) - self.chain.run([frames], again, self.words)
        return 1e6 * spent / (count * (repeat - 1))


class Staged(Knob):
    """Stage by stage from file to file, which may lose digits on the way."""

    def __init__(self, group, name, radar, folder, digits=None, ending=".jsonl"):
        super().__init__(group, name, radar, folder, ending)
        self.digits = digits
        self.files = [f"{self.place}-{number}{ending}" for number in range(len(self.chain.stages))]
        self.lists = self.files[-1]

    def run_stage(self, number, inputs, out):
        words = self.chain.stages[number].split()
        return chains.cpu_s([os.path.join(chains.BIN, words[0]), *words[1:], *inputs, "-o", out])

    def make(self, frames, count):
        for number, out in enumerate(self.files):
            self.run_stage(number, self.files[number - 1:number] or [frames], out)
            if self.digits:
                shorten(out, self.digits)
            self.bytes += os.path.getsize(out) / count

    def frame_us(self, frames, count, repeat):
        spent = 0
        for number, out in enumerate(self.files):
            inputs = self.files[number - 1:number] or [frames]
            again = out.replace(self.place, self.place + "-again")
            spent += self.run_stage(number, inputs * repeat, again) - self.run_stage(number, inputs, again)
        return 1e6 * spent / (count * (repeat - 1))


NUMBERS = re.compile(rb'"time_s":[^,}]*|"(?:[^"\\]|\\.)*"|-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?')


def cut(line, digits):
    """The line with that many significant digits in every number that is not whole, but for the time, by
    which lists are compared. Towards zero, so that nothing passes its bound."""
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


def digits(radar, folder):
    return [Staged("digits", str(count), radar, folder, count) for count in DIGITS] + [
        Staged("digits", "all", radar, folder)]


def plumbing(radar, folder):
    return [Plumbed("one process", radar, folder, [chains.GLINT]),
            Plumbed("one process, .gz", radar, folder, [chains.GLINT], ".jsonl.gz"),
            Plumbed("pipes", radar, folder, ["bash"]), Staged("plumbing", "files", radar, folder),
            Staged("plumbing", "files, .gz", radar, folder, ending=".jsonl.gz")]


def gospa(radar, truth, listed):
    """Mean of the scans in cells; both lists have the same seeds, so 0 is equal."""
    done = subprocess.run([os.path.join(chains.BIN, "glint-score"), *radar.score, "--truth", truth, listed], check=True,
                          stdout=subprocess.PIPE)
    return statistics.fmean(sensor["gospa"] for line in done.stdout.splitlines()
                            for sensor in json.loads(line)["sensors"])


def measured(radar, folder, frames, count):
    """Digits and plumbing, each with how far its lists are from those of all digits in one process."""
    found = []
    for knob in digits(radar, folder) + plumbing(radar, folder):
        knob.make(frames, count)
        found.append(knob)
    exact = found[len(DIGITS)].lists
    for knob in found[len(DIGITS) + 1:]:
        if chains.content(knob.lists) != chains.content(found[len(DIGITS) + 1].lists):
            sys.exit(f"accuracy-cost: {knob.name}: plumbing changes bytes")
    return [(knob, gospa(radar, exact, knob.lists) if knob.group == "digits" else None) for knob in found]


def angles(rounds):
    """Inverting the sensing ratio by tables: entries, microseconds per angle, greatest error in rad."""
    program = os.path.join(chains.BUILD, "tests", "speed", "angles")
    subprocess.run(["make", "-s", f"BUILD={os.path.relpath(chains.BUILD, chains.ROOT)}",
                    os.path.relpath(program, chains.ROOT)], check=True, cwd=chains.ROOT)
    text = subprocess.run([program, str(rounds)], check=True, stdout=subprocess.PIPE, text=True).stdout
    samples = {}
    for line in text.splitlines():
        entries, ns, _, greatest = map(float, line.split("\t"))
        samples.setdefault((int(entries), greatest), []).append(ns)
    return [(str(entries) if entries else "closed form", statistics.median(ns) / 1e3, greatest)
            for (entries, greatest), ns in samples.items()]
