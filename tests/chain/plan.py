"""The pipelines that glint-plan prints, run: they make the targets of the whole chain.

Usage: python3 tests/chain/plan.py BIN_DIR

For every pipeline's stream, and for suites that spare a stage: the printed pipeline, run in bash and
fused, gives the bytes that all effects and all stages give, but for the request in `sensors`.
"""
import glob
import json
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
REQUEST = re.compile(rb'"effects":"[^"]*"')
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


def lines_without_request(frames):
    return [REQUEST.sub(b"", line, count=1) for line in frames.splitlines()]


def same(bench, what, scenes, suite, options=(), expected=()):
    plan = bench.plan(scenes, suite, options)
    for words in expected:
        if words not in plan:
            sys.exit(f"plan: {what}: \"{words}\" is not in\n{plan}")
    whole = bench.chain(f"glint-extract | glint-ideal --sensors '{suite}' --effects all | "
                        f"glint-sensor --sensors '{suite}' | glint-noise --sensors '{suite}'", scenes)
    for shell in ["bash", "-c"], ["glint", "-c"]:
        planned = bench.run([*shell, plan], scenes)
        if lines_without_request(planned) != lines_without_request(whole):
            sys.exit(f"plan: {what}, run by {shell[0]}: other bytes than the whole chain's from\n{plan}")


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
    scenes = bench.chain("glint-traffic cut-in")
    stages = ["glint-extract", "glint-ideal --sensors lrr77-every-frame", "glint-sensor", "glint-noise"]
    plans = {bench.plan(scenes, "srr24-pair", ())}
    for stage in stages:
        scenes = bench.chain(stage, scenes)
        plans.add(bench.plan(scenes, "srr24-pair", ()))
    if len(plans) != 1:
        sys.exit("plan: frames from later in the chain make other plans")


def spared(bench):
    """Stages that a simpler one stands in for, and stages that only look as if it could."""
    scenes = bench.chain("glint-traffic two-vehicles")
    quiet = bench.suite("quiet", QUIET)
    same(bench, "no noise", scenes, quiet, (), ["goes: glint-noise-none writes the same targets"])
    short = bench.suite("short", {**QUIET, "list_limit": 1})
    same(bench, "a short list", scenes, short, (), ["stays: glint-noise-none writes other targets"])
    fine = bench.suite("fine", {**QUIET, "cell_range_m": 1e-6, "threshold_db": -100})
    same(bench, "nothing merges", scenes, fine, (), ["stays: glint-sensor-perfect writes other cells"])


def main(bin_dir):
    with tempfile.TemporaryDirectory(prefix="glint-plan.") as folder:
        bench = Bench(os.path.abspath(bin_dir), folder)
        count = shipped(bench)
        later_frames(bench)
        spared(bench)
    print(f"plan: {count} pipelines and 3 suites give the whole chain's bytes")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
