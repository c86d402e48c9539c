"""The pipelines that glint-plan prints, run: they make the targets of the whole chain.

Usage: python3 tests/chain/plan.py BIN_DIR

For every pipeline's stream, and for suites that spare a stage: the printed pipeline, run in bash and fused, gives the
target lists that all effects and all stages give. The numbers of lists that change without an effect are those of lists
that chains with `all,-EFFECT` give, also in scenes where geometry tells which lists these are.
"""
import glob
import json
import os
import re
import subprocess
import sys
import tempfile

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import suites  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
QUIET = {"pointer_sigma": 0, "azimuth_floor_rad": 0, "range_sigma_m": 0, "range_rate_sigma_mps": 0,
         "final_threshold": False, "list_limit": 250}


class Bench:
    def __init__(self, bin_dir, folder):
        self.folder = folder
        self.environment = dict(os.environ, PATH=bin_dir + os.pathsep + os.environ["PATH"],
                                GLINT_DATA=ROOT + "/data")

    def run(self, words, data=b""):
        done = subprocess.run(words, input=data, env=self.environment, cwd=ROOT, capture_output=True)
        if done.returncode != 0:
            sys.exit(f"plan: {' '.join(words)}: exit {done.returncode}: {done.stderr.decode()}")
        return done.stdout

    def chain(self, text, data=b""):
        return self.run(["bash", "-o", "pipefail", "-c", text], data)

    def whole(self, scenes, suite, effects):
        extract = suites.extraction(self.run(["glint", "--datasheet", suite]).decode())
        return self.chain(f"{extract} | glint-ideal --sensors '{suite}' --effects {effects} | "
                          f"glint-sensor --sensors '{suite}' | glint-noise --sensors '{suite}'", scenes)

    def plan(self, frames, suite, options):
        return self.run(["glint-plan", "--sensors", suite, *options], frames).decode()

    def suite(self, name, changes):
        """corner77 with other members, as a file of its own."""
        with open(f"{ROOT}/data/sensors/corner77-every-frame.json", encoding="utf-8") as file:
            document = json.load(file)
        for sensor in document["sensors"]:
            sensor.update(changes)
            sensor.pop("sources")
            if "antenna_table" in sensor:
                sensor["antenna_table"] = f"{ROOT}/data/antennas/corner77.csv"
        path = os.path.join(self.folder, name + " suite.json")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(document, file)
        return path


def lists(frames):
    """The lists of targets by frame and sensor, each as the bytes of its targets."""
    found = {}
    for number, line in enumerate(frames.splitlines()):
        frame = json.loads(line)
        for sensor in frame["sensors"]["list"]:
            if sensor["measured"]:
                found[number, sensor["name"]] = []
        for target in frame["targets"]:
            found[number, target["sensor"]].append(json.dumps(target))
    return found


def same(bench, what, scenes, suite, options=(), expected=()):
    plan = bench.plan(scenes, suite, options)
    for words in expected:
        if words not in plan:
            sys.exit(f"plan: {what}: \"{words}\" is not in\n{plan}")
    whole = lists(bench.whole(scenes, suite, "all"))
    for shell in ["bash", "-c"], ["glint", "-c"]:
        if lists(bench.run([*shell, plan], scenes)) != whole:
            sys.exit(f"plan: {what}, run by {shell[0]}: other lists than the whole chain's from\n{plan}")


def changed(bench, scenes, suite):
    """By effect, the lists that differ if the chain has all effects but this one."""
    whole = lists(bench.whole(scenes, suite, "all"))
    names = [line.split()[0] for line in bench.run(["glint", "--list", "effects"]).decode().splitlines() if line]
    without = {name: lists(bench.whole(scenes, suite, "all,-" + name)) for name in names}
    return {name: [key for key in whole if whole[key] != without[name][key]] for name in names}, len(whole)


def counts_are_those_of_chains(bench, what, scenes, suite):
    """Every count of glint-plan against lists of other runs. Returns the lists that change, by effect, and the plan's rows."""
    plan = json.loads(bench.plan(scenes, suite, ["--json"]))
    rows = {row["effect"]: row for row in plan["effects"]}
    lists_of, number = changed(bench, scenes, suite)
    if plan["lists"] != number:
        sys.exit(f"plan: {what}: {plan['lists']} lists; the chain gives {number}")
    for name, keys in lists_of.items():
        said = rows[name]["lists_changed"] if name in rows else 0
        if said != len(keys):
            sys.exit(f"plan: {what}: {said} lists change without {name}; chains give {len(keys)}")
    return lists_of, rows


def counts(bench):
    for scene, suite in ("intersection", "lrr77-full"), ("walled-road", "lrr77-coherent"), ("wet-road", "lrr77-full"), \
            ("wheels-and-limbs", "radarscenes77-full"), ("gravel", "array77"):
        scenes = b"".join(bench.chain("glint-traffic " + scene).splitlines(keepends=True)[::7])
        counts_are_those_of_chains(bench, f"{scene} seen by {suite}", scenes, suite)


def frame_of(number, objects, count):
    """A frame of a standing ego and of other standing objects: id, class, x, y, length, width."""
    rows = [{"id": "ego", "class": "car", "x_m": 0, "y_m": 0, "length_m": 4.5, "width_m": 1.8}]
    rows += [dict(zip(("id", "class", "x_m", "y_m", "length_m", "width_m"), row)) for row in objects]
    rows = [dict({"yaw_rad": 0, "vx_mps": 0, "vy_mps": 0, "yaw_rate_radps": 0, "height_m": 0, "travelled_m": 0}, **row) for row in rows]
    frame = {"version": 1, "scene": "known", "frame": number, "time_s": 0.1 * number, "interval_s": 0.1, "seed": "5", "ego": "ego",
             "objects": rows}
    return json.dumps(frame | ({"last": True} if number == count - 1 else {})) + "\n"


def scenes_of(rows):
    return "".join(frame_of(number, objects, len(rows)) for number, objects in enumerate(rows)).encode()


def known_lists(bench):
    """A car behind a wide truck in frames 3 to 6, beside it in the others: occlusion changes these lists alone. Nothing else
    is near: no mirror faces both, and no two objects share a cell."""
    quiet = bench.suite("flat", {**QUIET, "bounces": 0})
    rows = [[("truck", "truck", 20, 0, 8, 2.5), ("car", "car", 60, 0 if 3 <= number <= 6 else 15, 4.5, 1.8)] for number in range(10)]
    keys, row = counts_are_those_of_chains(bench, "a car behind a truck", scenes_of(rows), quiet)
    hidden = {number for number, _ in keys["occlusion"]}
    if hidden != {3, 4, 5, 6}:
        sys.exit(f"plan: the truck hides the car in frames 3 to 6; occlusion changes lists of {sorted(hidden)}")
    if row["occlusion"]["called_for_by"] != "truck hides car":
        sys.exit(f"plan: what calls for occlusion is \"{row['occlusion']['called_for_by']}\", not that the truck hides the car")


def shipped(bench):
    """For every pipeline with a suite: the frames of its source, run through the printed plan and through the
    whole chain."""
    count = 0
    for path in sorted(glob.glob(ROOT + "/pipelines/*.sh")):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        source = re.search(r"^(glint-traffic.*) \\$", text, re.M).group(1)
        suite = re.search(r"--sensors (\S+)", text).group(1)
        scenes = bench.chain(source)
        same(bench, os.path.basename(path), scenes, suite)
        count += 1
    return count


def later_frames(bench):
    """Frames of any place in the chain make one plan, but for times."""
    def plan(scenes):
        table = json.loads(bench.plan(scenes, "srr24-pair", ["--json"]))
        effects = [(row["effect"], row["lists_changed"], row["called_for_by"]) for row in table["effects"]]
        return json.dumps([effects, [(chain["effects"], chain["programs"]) for chain in table["chains"]]])
    scenes = bench.chain("glint-traffic cut-in")
    stages = ["glint-extract", "glint-ideal --sensors lrr77-every-frame", "glint-sensor", "glint-noise"]
    plans = {plan(scenes)}
    for stage in stages:
        scenes = bench.chain(stage, scenes)
        plans.add(plan(scenes))
    if len(plans) != 1:
        sys.exit("plan: frames from later in the chain make other plans")


def spared(bench):
    """Stages that a simpler one stands in for, and stages that only look as if it could."""
    scenes = bench.chain("glint-traffic two-vehicles")
    quiet = bench.suite("quiet", QUIET)
    same(bench, "no noise", scenes, quiet, (), ["goes: with glint-noise-none, 0 of"])
    short = bench.suite("short", {**QUIET, "list_limit": 1})
    same(bench, "a short list", scenes, short, (), ["stays: with glint-noise-none, "])
    fine = bench.suite("fine", {**QUIET, "cell_range_m": 1e-6, "threshold_db": -100})
    same(bench, "nothing merges", scenes, fine, (), ["stays: with glint-sensor-perfect, "])
    both = bench.suite("both", {**QUIET, "cell_range_m": 1e-6, "final_threshold": True})
    same(bench, "two thresholds, each of which does for both", bench.chain("glint-traffic intersection"), both, (), ["Put back, as lists change without all of them: "])


def main(bin_dir):
    with tempfile.TemporaryDirectory(prefix="glint-plan.") as folder:
        bench = Bench(os.path.abspath(bin_dir), folder)
        count = shipped(bench)
        later_frames(bench)
        spared(bench)
        known_lists(bench)
        counts(bench)
    print(f"plan: {count} pipelines and 4 suites give the whole chain's lists, and counts are those of chains")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
