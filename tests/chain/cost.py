"""What glint-cost says, measured again.

Usage: python3 tests/chain/cost.py [--long] BIN_DIR

Energies are those of glint-score --ensemble for lists that glint makes with the same seeds. They change from
run to run in no bit, fused or alone. A printed pipeline runs in bash and in glint, and is the chain that was
measured. And promises hold: errors from samples of random traffic, against those of a held-out part of it
that is fifteen times as large.
"""
import json
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SEEDS = 4
REFERENCE = range(1, 2 * SEEDS, 2)
CHAIN = range(2, 2 * SEEDS + 1, 2)


class Bench:
    def __init__(self, bin_dir, folder):
        self.folder = folder
        self.environment = dict(os.environ, PATH=bin_dir + os.pathsep + os.environ["PATH"], GLINT_DATA=ROOT + "/data")

    def run(self, words, data=b""):
        done = subprocess.run(words, input=data, env=self.environment, cwd=ROOT, capture_output=True)
        if done.returncode != 0:
            sys.exit(f"cost: {' '.join(words)}: exit {done.returncode}: {done.stderr.decode()}")
        return done.stdout

    def glint(self, text, data=b""):
        return self.run(["glint", "-c", text], data)

    def cost(self, frames, suite, *options):
        return json.loads(self.run(["glint-cost", "--json", "--sensors", suite, *options], frames))

    def lists(self, frames, suite, effects, programs, ks):
        """Target lists of all seeds; those of one frame's own seed s are s + k 2^32."""
        made = b""
        for k in ks:
            seeded = re.sub(rb'"seed":"(\d+)"', lambda found: b'"seed":"%d"' % (int(found[1]) + (k << 32)), frames)
            made += self.glint(f"glint-extract | glint-ideal --sensors {suite} --effects {effects} | "
                               + " | ".join(programs), seeded)
        return made

    def energy(self, truth, listed):
        path = os.path.join(self.folder, "truth.jsonl")
        with open(path, "wb") as file:
            file.write(truth)
        return json.loads(self.run(["glint-score", "--ensemble", "--truth", path], listed))["energy"]


def without_times(cost):
    for chain in cost["chains"]:
        del chain["us_per_frame"]
    return cost


def same_as_the_score(bench, frames, suite, *options):
    """Every energy of the ladder against glint-score's, which reads lists and knows no ladder."""
    cost = bench.cost(frames, suite, *options)
    programs = ["glint-sensor-signal"] if cost["reference"] == "signal" else ["glint-sensor", "glint-noise"]
    truth = bench.lists(frames, suite, "auto", programs, REFERENCE)
    for chain in cost["chains"]:
        if "energy" not in chain:
            continue
        energy = bench.energy(truth, bench.lists(frames, suite, chain["effects"], chain["programs"], CHAIN))
        if abs(energy - chain["energy"]["value"]) > 1e-9 * max(1, abs(energy)):
            sys.exit(f"cost: {suite}: {chain['chain']}: D {chain['energy']['value']}, glint-score says {energy}")
        error = chain["energy"]["value"] / cost["chains"][0]["energy"]["value"]
        if "error" in chain and abs(error - chain["error"]["value"]) > 1e-9:
            sys.exit(f"cost: {suite}: {chain['chain']}: error {chain['error']['value']}, D over D of ideal {error}")
    return cost


def same_again(bench, frames, suite):
    text = f"glint-cost --json --reference all --sensors {suite}"
    runs = [without_times(json.loads(run)) for run in
            (bench.run(text.split(), frames), bench.run(text.split(), frames), bench.glint(text, frames))]
    if runs[0] != runs[1] or runs[0] != runs[2]:
        sys.exit("cost: another run measures other errors")


def printed_chain(plan):
    """Of the text to paste: suite, effects and the programs behind glint-ideal; error and effects that its head names."""
    text = re.sub(r"^#.*\n|^set .*\n|\\\n", "", plan, flags=re.M)
    _, ideal, *programs = [stage.split() for stage in text.split("|")]
    options = dict(zip(ideal[1::2], ideal[2::2]))
    error = float(re.search(r"with an error of (\S+) %", plan)[1])
    return options, [" ".join(words) for words in programs], error, re.findall(r"^# (\w+) +off: ", plan, re.M)


def pipeline_is_the_chain(bench, frames, suite, option):
    """The text to paste leaves out what its head tells of, has the error that its head names, and makes the lists of that
    chain, byte for byte. Times change from run to run, and with them which chain is found; errors do not."""
    plan = bench.run(["glint-cost", *option, "--sensors", suite], frames).decode()
    options, programs, error, left_out = printed_chain(plan)
    brief = {chain["chain"]: chain for chain in bench.cost(frames, suite, "--brief", "--reference", "all")["chains"]}
    chains = [(",-".join(["auto", *left_out]), ["glint-sensor", "glint-noise"])]
    chains += [(brief[name]["effects"], brief[name]["programs"]) for name in ("perfect", "paper", "smear")]
    if options != {"--sensors": suite, "--effects": options["--effects"]} or (options["--effects"], programs) not in chains:
        sys.exit(f"cost: {' '.join(option)}: none of {chains} is\n{plan}")
    truth = bench.lists(frames, suite, "auto", ["glint-sensor", "glint-noise"], REFERENCE)
    energy = bench.energy(truth, bench.lists(frames, suite, options["--effects"], programs, CHAIN))
    if abs(100 * energy / brief["perfect"]["energy"]["value"] - error) > 0.0501:
        sys.exit(f"cost: {' '.join(option)}: D {energy} of {brief['perfect']['energy']['value']} is not the error of\n{plan}")
    expected = bench.lists(frames, suite, options["--effects"], programs, [0])
    for shell in "bash", "glint":
        if bench.run([shell, "-c", plan], frames) != expected:
            sys.exit(f"cost: run by {shell}, other lists than those of the chain that is printed, from\n{plan}")
    return left_out


def promises_hold(bench, suite, options, splits, sample, held_out):
    """How many intervals from samples hold the error of the held-out part, and how many there are."""
    def frames(first, count):
        return bench.glint(f"glint-traffic-random --first {first} --frames {count} {options}")

    def errors(*cost):
        return {chain["chain"]: chain["error"] for chain in bench.cost(*cost)["chains"] if "error" in chain}
    truth = errors(frames(100000, held_out), suite, "--brief", "--reference", "all", "--sample", str(held_out))
    held = promised = 0
    for split in range(splits):
        for name, error in errors(frames(split * sample, sample), suite, "--brief", "--reference", "all").items():
            if name not in ("perfect", "auto"):  # which are 100 % and 0 % by definition
                held += error["low"] <= truth[name]["value"] <= error["high"]
                promised += 1
    print(f"cost: {suite}: {held} of {promised} intervals hold the held-out error")
    return held, promised


def main(bin_dir, long):
    with tempfile.TemporaryDirectory(prefix="glint-cost.") as folder:
        bench = Bench(os.path.abspath(bin_dir), folder)
        cut_in = bench.glint("glint-traffic cut-in").splitlines(keepends=True)
        some = b"".join(cut_in[60:120:5] + bench.glint("glint-traffic two-vehicles").splitlines(keepends=True)[:7])
        same_as_the_score(bench, some, "srr24-pair")
        same_as_the_score(bench, some, "corner77", "--effects", "auto,-occlusion")
        if os.path.exists(os.path.join(bin_dir, "glint-sensor-signal")):
            cost = same_as_the_score(bench, b"".join(cut_in[::20]), "srr24-signal", "--brief")
            if cost["reference"] != "signal":
                sys.exit("cost: the suite has a waveform, but the signal is not the reference")
        else:
            print("skipped  costs with the signal as reference: there is no glint-sensor-signal")
        for effects, name in ("none", "none"), ("merging,occlusion", "merging,occlusion"), ("all", "auto"):
            chains = bench.cost(some, "srr24-pair", "--effects", effects, "--brief")["chains"]
            if [chain["chain"] for chain in chains] != ["perfect", "paper", name, "smear"]:
                sys.exit(f"cost: with {effects} the whole chain is not called {name}: {chains}")
        same_again(bench, some, "srr24-pair")
        for option in ["--error", "30%"], ["--error", "3%"], ["--within", "1e9us"]:
            left_out = pipeline_is_the_chain(bench, b"".join(cut_in[::8]), "lrr77-full", option)
            if (len(left_out) == 0) != (option[0] == "--within"):
                sys.exit(f"cost: {' '.join(option)} leaves out {left_out}")
        suites = ["srr24-pair-every-frame", "lrr77-full", "corner77-every-frame"] + (["radarscenes77-full"] if long else [])
        results = [promises_hold(bench, suite, "--density dense --rate-hz 10 --draw-conditions", 60 if long else 20, 40, 600) for suite in suites]
        held, promised = (sum(counts) for counts in zip(*results))
        if promised < 20 * len(suites) or held < 0.9 * promised:
            sys.exit(f"cost: {held} of {promised} intervals hold the held-out error; at least 9 of 10 should")


if __name__ == "__main__":
    words = [word for word in sys.argv[1:] if word != "--long"]
    if len(words) != 1:
        sys.exit(__doc__)
    main(words[0], "--long" in sys.argv)
