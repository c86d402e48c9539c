"""What glint-cost says, measured again.

Usage: python3 tests/chain/cost.py [--long] BIN_DIR

Energies are those of glint-score --ensemble for lists that glint makes with the same seeds. They change from
run to run in no bit, fused or alone. A printed pipeline runs in bash and in glint, and is the chain that was
measured. And intervals cover the error of their frames under 200 other seeds.

--long is run by hand, in half an hour: coverage on moving scenes of 3, 6 and 20 s, 40 trials each, what four calls of
--error with other seeds leave out, and how far the errors of the scale vary with the seed, beside what the page says.
"""
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts"))
from glint.progress import Progress  # noqa: E402

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import suites  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SEEDS = 6
REFERENCE = range(1, 2 * SEEDS, 2)
CHAIN = range(2, 2 * SEEDS + 1, 2)


def moved(frames, k, each):
    """The frames, with the seeds s + (each f + k) 2^32."""
    def line(text):
        number = int(re.search(rb'"frame":(\d+)', text)[1])
        return re.sub(rb'"seed":"(\d+)"', lambda found: b'"seed":"%d"' % (int(found[1]) + (each * number + k << 32)), text)
    return b"".join(map(line, frames.splitlines(keepends=True)))


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
        """Target lists of all seeds: s + (16 f + k) 2^32 of frame f with seed s, written as s + k 2^32; s if k is 0."""
        made, extract = b"", suites.extraction(self.run(["glint", "--datasheet", suite]).decode())
        for k in ks:
            seeded = moved(frames, k, 16 if k else 0)
            listed = self.glint(f"{extract} | glint-ideal --sensors {suite} --effects {effects} | " + " | ".join(programs), seeded)
            made += moved(listed, 0, -16 if k else 0)
        return made

    def energy(self, truth, listed):
        path = os.path.join(self.folder, "truth.jsonl")
        with open(path, "wb") as file:
            file.write(truth)
        return json.loads(self.run(["glint-score", "--ensemble", "--truth", path], listed))["energy"]


def without_times(cost):
    for row in cost["chains"] + cost["effects"]:
        for name in {"us_per_frame", "saved"} & row.keys():
            del row[name]
    return cost


def lists_changed(whole, other):
    """How many lists of both, with labels, are not the same bytes; and how many there are."""
    count = changed = 0
    for one, two in zip(whole.splitlines(), other.splitlines()):
        one, two = json.loads(one), json.loads(two)
        for sensor in one["sensors"]["list"]:
            of = [[target for target in frame["targets"] if target["sensor"] == sensor["name"]] for frame in (one, two)]
            count += sensor["measured"]
            changed += json.dumps(of[0]) != json.dumps(of[1])
    return changed, count


def effects_are_those_of_chains(bench, cost, frames, suite, truth):
    """What the rows of effects say, from lists that glint makes without each of them."""
    whole = next(chain for chain in cost["chains"] if chain["chain"].split(",")[0] == "auto")
    listed = bench.lists(frames, suite, whole["effects"], whole["programs"], CHAIN)
    ideal = cost["chains"][0]["energy"]["value"]
    for row in cost["effects"]:
        without = bench.lists(frames, suite, whole["effects"] + ",-" + row["effect"], whole["programs"], CHAIN)
        if lists_changed(listed, without) != (row["lists_changed"], cost["lists"]):
            sys.exit(f"cost: {suite}: {lists_changed(listed, without)} lists change without {row['effect']}, not {row['lists_changed']}")
        added = (bench.energy(truth, without) - whole["energy"]["value"]) / ideal
        if abs(added - row["squared_error_added"]["value"]) > 1e-9:
            sys.exit(f"cost: {suite}: {row['effect']} adds {added}, not {row['squared_error_added']['value']}")


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
        error = max(0, chain["energy"]["value"] / cost["chains"][0]["energy"]["value"]) ** 0.5
        if "relative_distance" in chain and abs(error - chain["relative_distance"]["value"]) > 1e-9:
            sys.exit(f"cost: {suite}: {chain['chain']}: error {chain['relative_distance']['value']}, root of D over D of ideal {error}")
    effects_are_those_of_chains(bench, cost, frames, suite, truth)
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
    error = re.search(r"with an error of (<?)(\S+) % \((\S+) to (\S+)\)", plan)
    return options, [" ".join(words) for words in programs], error.groups(), re.findall(r"^# (\w+) +\d+ of \d+ ", plan, re.M)


def pipeline_is_the_chain(bench, frames, suite, option):
    """The printed pipeline leaves out the effects of its head, has the error in its head, and makes the lists of that
    chain, byte for byte. Times change from run to run, and so does the chain that is found; errors do not."""
    plan = bench.run(["glint-cost", *option, "--sensors", suite], frames).decode()
    options, programs, error, left_out = printed_chain(plan)
    brief = {chain["chain"]: chain for chain in bench.cost(frames, suite, "--brief", "--reference", "all")["chains"]}
    chains = [(",-".join(["auto", *left_out]), ["glint-sensor", "glint-noise"])]
    chains += [(brief[name]["effects"], brief[name]["programs"]) for name in ("perfect", "paper", "smear")]
    if options != {"--sensors": suite, "--effects": options["--effects"]} or (options["--effects"], programs) not in chains:
        sys.exit(f"cost: {' '.join(option)}: none of {chains} is\n{plan}")
    truth = bench.lists(frames, suite, "auto", ["glint-sensor", "glint-noise"], REFERENCE)
    energy = bench.energy(truth, bench.lists(frames, suite, options["--effects"], programs, CHAIN))
    below, said, low, high = error
    root = 100 * max(0, energy / brief["perfect"]["energy"]["value"]) ** 0.5
    if (not below and abs(root - float(said)) > 0.0501) or not float(low) <= root + 0.05 <= float(high) + 0.1 or (below and said != high):
        sys.exit(f"cost: {' '.join(option)}: D {energy} of {brief['perfect']['energy']['value']} is not the error of\n{plan}")
    expected = bench.lists(frames, suite, options["--effects"], programs, [0])
    for shell in "bash", "glint":
        if bench.run([shell, "-c", plan], frames) != expected:
            sys.exit(f"cost: run by {shell}, other lists than those of the chain that is printed, from\n{plan}")
    return left_out


def seeded(frames, seed):
    return re.sub(rb'"seed":"\d+"', b'"seed":"%d"' % seed, frames)


def coverage(bench, frames, suite, trials, *options):
    """For each chain but ideal echoes: the number of intervals that contain the error of the same frames under 200 other
    seeds, and the number of calls without an error."""
    progress = Progress("calls")
    calls = [{chain["chain"]: chain for chain in bench.cost(seeded(frames, seed), suite, "--brief", *options)["chains"]}
             for seed in progress.over(range(1, 1 + trials + 34), trials + 34)]
    mean = {name: sum(call[name]["energy"]["value"] for call in calls[trials:]) for name in calls[0] if "energy" in calls[0][name]}
    found = {}
    for name in mean.keys() - {"perfect"}:
        truth = max(0, mean[name] / mean["perfect"]) ** 0.5
        said = [call[name]["relative_distance"] for call in calls[:trials] if "relative_distance" in call[name]]
        found[name] = sum(error["low"] <= truth <= error["high"] for error in said), trials - len(said), truth
    return found


def intervals_cover(bench, rows):
    """For rows of frames, suite, trials and options: 90 % of all intervals contain the error, 80 % in every row; at most a
    tenth of the calls print no error."""
    pooled = []
    for label, frames, suite, trials, *options in rows:
        for name, (held, none, truth) in sorted(coverage(bench, frames, suite, trials, *options).items()):
            print(f"cost: {label}, {suite}, {name}: {held} of {trials} intervals hold {100 * truth:.1f} %, {none} calls have none")
            if held < 0.8 * (trials - none) or none > 0.1 * trials:
                sys.exit("cost: these intervals do not hold")
            pooled.append((held, trials - none))
    held, said = (sum(counts) for counts in zip(*pooled))
    print(f"cost: {held} of {said} intervals hold the error under other seeds")
    if held < 0.9 * said:
        sys.exit("cost: 9 of 10 should")


def same_effects(bench, frames, suite, bound, *options):
    """Four calls with other seeds differ only in effects that save less than 2 % of the time, in their mean."""
    calls = []
    for seed in range(1, 5):
        cost = bench.cost(seeded(frames, seed), suite, "--error", bound, *options)
        calls.append(({chain["chain"]: chain for chain in cost["chains"]}, cost["chosen"],
                      {row["effect"]: row["saved"]["us"] for row in cost["effects"]}))
    left_out = [chains[chosen]["effects"].split(",-")[1:] for chains, chosen, _ in calls]
    differ = []
    for name in sorted(set().union(*left_out)):
        share = sum(saved[name] / chains["auto"]["us_per_frame"] for chains, _, saved in calls) / 4
        count = sum(name in names for names in left_out)
        print(f"cost: {suite}, --error {bound}: {name} is left out by {count} of 4 calls and saves {100 * share:.1f} %")
        differ += [name] if count < 4 and share >= 0.02 else []
    if differ:
        sys.exit(f"cost: not all of four calls leave out {', '.join(differ)}")


SCALED = ("cut-in", "intersection", "highway-straight", "walled-road", "corner-approach", "shadows", "side-crossing")


def scale_varies_as_the_page_says(bench):
    """The greatest standard deviation over 20 seeds of the errors for scale, for 64 frames and for 12, in per cent."""
    with open(os.path.join(ROOT, "pipelines/README.md"), encoding="utf-8") as page:
        said = re.search(r"64 frames they have a standard deviation of at most (\S+) %, over 12 frames of at most (\S+) %",
                         " ".join(page.read().split()))
    for count, printed in zip((64, 12), said.groups()):
        most = 0
        for scene in SCALED:
            lines = bench.glint(f"glint-traffic {scene}").splitlines(keepends=True)
            frames = b"".join(lines[::max(1, len(lines) // count)][:count])
            for suite in ("srr24-pair", "lrr77-full"):
                scales = [bench.cost(seeded(frames, seed), suite, "--brief", "--reference", "all", "--sample", "1000")["scale"]
                          for seed in range(1, 21)]
                spread = max(100 * statistics.stdev(values) for values in zip(*(scale.values() for scale in scales)))
                print(f"cost: scale over {count} frames of {scene}, {suite}: deviation {spread:.1f} %")
                most = max(most, spread)
        if not most <= float(printed) <= 1.25 * most:
            sys.exit(f"cost: the scale varies by at most {most:.2f} % over {count} frames, the page says {printed} %")


def promises_hold(bench, long):
    """On the first seconds of scenes, sampled evenly."""
    def first(scene, seconds):
        lines = bench.glint(f"glint-traffic {scene}").splitlines(keepends=True)
        return b"".join(line for line in lines if json.loads(line)["time_s"] <= seconds)
    if not long:
        return intervals_cover(bench, [("cut-in, 3 s", first("cut-in", 3), "srr24-pair-every-frame", 16, "--sample", "16")])
    scenes = [("cut-in", 3), ("intersection", 6), ("rush-hour", 20)]
    intervals_cover(bench, [(f"{scene}, {seconds} s", first(scene, seconds), suite, 40, "--sample", "50", "--reference", "all")
                            for scene, seconds in scenes for suite in ("srr24-pair-every-frame", "lrr77-full", "corner77-every-frame")])
    same_effects(bench, first("cut-in", 8), "lrr77-full", "30%")
    return scale_varies_as_the_page_says(bench)


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
        for size in 1, 7, 19:
            if bench.cost(some, "srr24-pair", "--brief", "--sample", str(size))["frames"] != size:
                sys.exit(f"cost: --sample {size} measures another number of frames")
        for effects, name in ("none", "none"), ("merging,occlusion", "merging,occlusion"), ("all", "auto"):
            chains = bench.cost(some, "srr24-pair", "--effects", effects, "--brief")["chains"]
            if [chain["chain"] for chain in chains] != ["perfect", "paper", name, "smear"]:
                sys.exit(f"cost: with {effects} the whole chain is not called {name}: {chains}")
        same_again(bench, some, "srr24-pair")
        for option in ["--error", "50%"], ["--error", "25%"], ["--within", "1e9us"]:
            left_out = pipeline_is_the_chain(bench, b"".join(cut_in[::8]), "lrr77-full", option)
            if (len(left_out) == 0) != (option[0] == "--within"):
                sys.exit(f"cost: {' '.join(option)} leaves out {left_out}")
        promises_hold(bench, long)


if __name__ == "__main__":
    words = [word for word in sys.argv[1:] if word != "--long"]
    if len(words) != 1:
        sys.exit(__doc__)
    main(words[0], "--long" in sys.argv)
