"""Chains of glint on the traffic of a recording."""
import json
import math
import os
import resource
import shlex
import subprocess
import tempfile
from collections import namedtuple

from glint import command_line
from glint.frames import VERSION
from glint.places import DATA, GLINT
from glint.recordings import dense
from glint.recordings.readers import Box, Detection

# With so many lists, one more of their law lies between their least and their largest statistic 38 times in 40.
SEEDS = 39
PAPER = ("visibility,plane_reflection,rows,occlusion,ambiguity,merging,superposition,threshold,angle_noise,range_noise,"
         "final_threshold,list_limit")

# vehicles: a set of documents; road: between the strips beside the road that were found; surface: what
# the road is made of
Chain = namedtuple("Chain", "name effects stages vehicles road surface", defaults=("glint-sensor | glint-noise", "paper", False, "unknown"))
IDEAL = Chain("ideal echoes", PAPER, "glint-sensor-perfect | glint-noise-none")
PAPERS = Chain("the paper's model", PAPER)
STEADY = Chain("without levels", "auto,-level")
ALL = Chain("all effects", "auto")
DETAILED = Chain("with data/detailed", "auto", vehicles="detailed")
SURFACES = Chain("with data/surfaces", "auto", vehicles="surfaces")
ROADSIDE = Chain("with a roadside", "auto", road=True)
# Each with the chain that it should be better than; fewer ones beside dense lists.
CHAINS = {IDEAL: None, PAPERS: IDEAL, STEADY: PAPERS, ALL: STEADY, Chain("smear", "auto", "glint-sensor-smear | glint-noise"): ALL,
          DETAILED: ALL, SURFACES: DETAILED, ROADSIDE: ALL}
DENSE = {IDEAL: None, PAPERS: IDEAL, ALL: PAPERS, DETAILED: ALL, SURFACES: DETAILED}


def frames(scans, speeds, seed, strips, surface):
    """Frames of traffic, one a scan: the ego drives straight ahead at these speeds on a road, between strips of a roadside."""
    ways, ahead_m = {}, 0
    for i, (scan, speed) in enumerate(zip(scans, speeds)):
        interval_s = scans[max(i, 1)].time_s - scans[max(i, 1) - 1].time_s
        bodies, ahead_m = [Box("ego", "car", *[0] * 8), *scan.boxes], ahead_m + speed * interval_s * (i > 0)
        for box in bodies:
            driven_m = math.hypot(speed + box.vx_mps, box.vy_mps) * interval_s
            ways[box.id] = ways[box.id] + driven_m if box.id in ways else 0
        yield {"version": VERSION, "scene": f"seed{seed}", "frame": i, "time_s": scan.time_s - scans[0].time_s,
               "interval_s": interval_s, "seed": str(seed), "ego": "ego", "last": i + 1 == len(scans),
               "conditions": {"road": surface}, "roadside": strips, "objects": [
                   {"id": box.id, "class": box.kind, "x_m": ahead_m + box.x_m, "y_m": box.y_m, "yaw_rad": box.yaw_rad,
                    "vx_mps": speed + box.vx_mps, "vy_mps": box.vy_mps, "yaw_rate_radps": 0, "length_m": box.length_m,
                    "width_m": box.width_m, "height_m": box.height_m, "travelled_m": ways[box.id]} for box in bodies]}


def run(chain, suite, fit, part, seeds=SEEDS, first=1):
    """Lists of detections, [seed][scan], with seeds from the first one on, and the CPU time of a frame in microseconds."""
    scans = len(part.scans)
    with tempfile.NamedTemporaryFile("w", suffix=".jsonl") as traffic:
        for seed in range(first, first + seeds):
            for frame in frames(part.scans, part.speeds, seed, fit.roadside if chain.road else [], chain.surface):
                traffic.write(json.dumps(frame) + "\n")
        traffic.flush()
        text = (f"glint-extract --vehicles {chain.vehicles} {traffic.name} | glint-ideal --sensors {shlex.quote(suite)}"
                f" --effects {chain.effects} --sections none | {chain.stages}")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([GLINT, "-c", text], env=dict(os.environ, GLINT_DATA=DATA), check=False, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        command_line.fail(done.returncode, f"{text}: exit status {done.returncode}: {done.stderr}")
    spent_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    lists = [[detection(target, fit.curve) for target in json.loads(line)["targets"] if dense.is_of_mode(target, i % scans in part.coarse)]
             for i, line in enumerate(done.stdout.splitlines())]
    return [lists[i:i + scans] for i in range(0, len(lists), scans)], 1e6 * spent_s / len(lists)


def detection(target, law):
    place, snr_db = (target["range_m"], target["azimuth_rad"]), target["amplitude_db"]
    return Detection(*place, target["range_rate_mps"], snr_db, snr_db - law.snr_db(*place))
