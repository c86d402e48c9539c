"""What stands beside the road comes again in the next scans as often as beside real radars.

Usage: python3 tests/chain/roadside.py BIN_DIR        exit status 1 if any check fails

The radar is one like the front radar of the aiMotive data set: its threshold, sensitivity, view, cells and noise are
those that were found in the recording (MODEL 14.23). It drives along data/scenarios/motorway.json at 30 m/s and scans
every 60 ms. A detection comes again if the next scan has one 6 dB above the threshold within 0.4 m and 1 degree of where
it must be then; by chance it does in any other scan.
"""
import json
import math
import os
import random
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
import recorded  # noqa: E402
from recorded import BIN, ENV, ROOT, check  # noqa: E402

SPEED_MPS, SCAN_S = 30, 0.06
THRESHOLD_DB, STRONG_DB = 14.2, 20.2
RANGE_M, VIEW_RAD = (13, 179), math.radians(16)
FRONT = {
    "name": "front", "mount_x_m": 2.25, "mount_y_m": 0, "mount_yaw_rad": 0, "carrier_hz": 76.5e9,
    "range_min_m": RANGE_M[0], "range_max_m": RANGE_M[1], "field_of_view_rad": 2 * VIEW_RAD,
    # 14.2 dB are met by -5.1 dBsm at 100 m, and power falls with 24.4 dB a decade.
    "threshold_db": THRESHOLD_DB, "calibration_ercs": math.sqrt(10 ** -0.51 / 10), "calibration_range_m": 100,
    "exponent": 1.22, "range_floor_m": 0.5, "cell_range_m": 1.4, "cell_range_rate_mps": 0.2, "cell_extent": "width",
    "antenna_pattern": "table", "antenna_table": "front.csv", "phase_reference": "centre", "angle_estimator": "ratio",
    "pointer_sigma": 0.1, "range_sigma_m": 0.13, "range_rate_sigma_mps": 0.018, "azimuth_sigma_rad": math.radians(0.13),
    "final_threshold": True, "list_order": "nearest", "list_limit": 250,
}


def glint(text, folder, data=None):
    done = subprocess.run([BIN + "/glint", "-c", text], env=ENV, cwd=folder, input=data, capture_output=True, check=False)
    check(done.returncode == 0, f"{text}: {done.stderr.decode()}")
    return done.stdout.splitlines()


def write_front(folder):
    """The beam loses 0.042 dB a square degree and 0.00013 dB a fourth power; its slope gives 0.35 degrees at 16 dB."""
    rows = ["azimuth_rad,sum,delta"]
    for degrees in (half / 2 for half in range(-40, 41)):
        gain = 10 ** (-(0.042 * degrees ** 2 + 0.00013 * degrees ** 4) / 20)
        rows.append(f"{math.radians(degrees):.9f},{gain:.9f},{gain * 2 * math.radians(degrees):.9f}")
    with open(os.path.join(folder, "front.csv"), "w") as out:
        out.write("\n".join(rows) + "\n")
    for name, more in ("front", {}), ("phases", {"cell_phase": "by_path"}):
        with open(os.path.join(folder, name + ".json"), "w") as out:
            json.dump({"origin": "tests/chain/roadside.py", "sensors": [FRONT | more]}, out)
    with open(os.path.join(ROOT, "data/scenarios/motorway.json")) as text:
        scenario = json.load(text) | {"rate_hz": 1 / SCAN_S}
    with open(os.path.join(folder, "motorway.json"), "w") as out:
        json.dump(scenario, out)


# ---- what comes again ---------------------------------------------------------------------------


def standing(frame):
    """(range, azimuth, rate, dB) of each target whose rate is that of something that stands."""
    lists = [(one["range_m"], one["azimuth_rad"], one["range_rate_mps"], one["amplitude_db"]) for one in frame["targets"]]
    return [one for one in lists if abs(one[2] + SPEED_MPS * math.cos(one[1])) < 0.35]


def strong(detections):
    return [one for one in detections if one[3] > STRONG_DB]


def later(one):
    """Range and azimuth in the next scan of what stands still; None near the border of range or view."""
    x = one[0] * math.cos(one[1]) - SPEED_MPS * SCAN_S
    y = one[0] * math.sin(one[1])
    range_m, azimuth_rad = math.hypot(x, y), math.atan2(y, x)
    inside = range_m > RANGE_M[0] + 0.5 and abs(azimuth_rad) < VIEW_RAD - math.radians(0.5)
    return (range_m, azimuth_rad) if inside else None


def share_again(pairs):
    due = [(place, after) for before, after in pairs for place in map(later, before) if place]
    found = sum(any(abs(one[0] - place[0]) < 0.4 and abs(one[1] - place[1]) < math.radians(1) for one in after)
                for place, after in due)
    return found / len(due)


def check_recurrence(scans, seed):
    lists = [strong(scan) for scan in scans]
    again = share_again(zip(lists, lists[1:]))
    drawn = random.Random(seed)
    others = [lists[(i + drawn.randrange(40, len(lists) - 40)) % len(lists)] for i in range(len(lists))]
    by_chance = share_again(zip(lists, others))
    count = statistics.mean(map(len, scans))
    print(f"seed {seed}: {count:.1f} standing targets a scan; {again:.2f} of the strong ones come again, {by_chance:.2f} by chance")
    check(0.55 <= again <= 0.85, f"seed {seed}: {again:.3f} come again")
    check(by_chance <= 0.2, f"seed {seed}: {by_chance:.3f} come again by chance")
    check(30 <= count <= 40, f"seed {seed}: {count:.1f} a scan")


# ---- the ego's own speed ------------------------------------------------------------------------


def own_speed(targets, drawn):
    """The speed that most targets agree on, by least squares over them, and its standard deviation, from theirs."""
    told = []
    for one in targets:
        across_mps = SPEED_MPS * math.sin(one["azimuth_rad"]) * one["quality"]["azimuth_sd_rad"]
        told.append((math.cos(one["azimuth_rad"]), one["range_rate_mps"],
                     math.hypot(one["quality"]["range_rate_sd_mps"], across_mps)))
    best = []
    for cosine, rate, _ in (drawn.choice(told) for _ in range(30)):
        agreeing = [one for one in told if abs(one[1] - rate / cosine * one[0]) < max(3 * one[2], 0.05)]
        best = max(best, agreeing, key=len)
    weights = sum((cosine / sigma) ** 2 for cosine, _, sigma in best)
    return -sum(cosine * rate / sigma ** 2 for cosine, rate, sigma in best) / weights, 1 / math.sqrt(weights)


def check_own_speed(folder):
    """Targets of one scatterer tell the ego's speed as well as they say. Echoes of both sides of the road in one cell are
    read nearer to boresight than their rate is, and the speed is low; where they have phases the radar sees most of them."""
    drawn, frames = random.Random(1), []
    for seed in (1, 2, 3):
        lines = glint(f"glint-traffic ./motorway.json --seed {seed} | glint-extract | "
                      "glint-ideal --sensors phases.json --sections quality | glint-sensor | glint-noise", folder)
        frames += [json.loads(line) for line in lines]
    for what, belongs, most_low in (("single", lambda one: len(one["contributors"]) == 1, 0.1),
                                    ("not seen to be merged", lambda one: not one["quality"]["looks_merged"], 0.3)):
        errors = []
        for frame in frames:
            speed, sigma = own_speed([one for one in frame["targets"] if belongs(one)], drawn)
            errors.append((speed - SPEED_MPS) / sigma)
        outside, mean = sum(abs(error) > 3 for error in errors), statistics.mean(errors)
        print(f"targets that are {what}: the ego's speed is off by {mean:.2f} sigma in the mean, by more than 3 sigma in "
              f"{outside} of {len(frames)} scans")
        check(outside <= 0.01 * len(frames) and abs(mean) < most_low, f"{what}: another speed")
        check(0.9 < statistics.pstdev(errors) < 1.1, f"{what}: {statistics.pstdev(errors):.2f} times the spread that is told")


# ---- a radar that stands ------------------------------------------------------------------------


def street_frames(speed_mps):
    """An ego every 4 m between dense bushes."""
    bushes = [{"kind": "vegetation", "from_x_m": -150, "from_y_m": y, "to_x_m": 250, "to_y_m": y, "width_m": 8,
               "per_m2": 10, "rcs_dbsm": -31} for y in (-8, 8)]
    for number in range(15):
        ego = {"id": "ego", "class": "car", "x_m": 4 * number, "y_m": 0, "yaw_rad": 0, "vx_mps": speed_mps, "vy_mps": 0,
               "yaw_rate_radps": 0, "length_m": 4.5, "width_m": 1.8, "height_m": 1.5, "travelled_m": 4 * number}
        yield json.dumps({"version": 1, "scene": "street", "frame": number, "time_s": number, "interval_s": 1, "seed": "1",
                          "ego": "ego", "roadside": bushes, "objects": [ego]})


def targets_a_scan(folder, speed_mps):
    chain = "glint-extract | glint-ideal --sensors radarscenes77-full | glint-sensor | glint-noise"
    lines = glint(chain, folder, "\n".join(street_frames(speed_mps)).encode() + b"\n")
    frames = [json.loads(line) for line in lines]
    return statistics.mean(len(frame["targets"]) / len(frame["sensors"]["list"]) for frame in frames)


def check_standing_radar(folder):
    moving, resting = targets_a_scan(folder, 10), targets_a_scan(folder, 0)
    print(f"four radars of 120 degrees: {moving:.0f} targets a scan at 10 m/s, {resting:.0f} standing, {resting / moving:.2f}")
    check(abs(resting / moving - 0.47) <= 0.1, f"{resting} of {moving}")


# ---- the same bytes -----------------------------------------------------------------------------


def check_pieces(folder, whole):
    """The list of a scan is the same if the stream begins with it, or if every stage is a process of its own."""
    scenes = glint("glint-traffic ./motorway.json --seed 1", folder)
    chain = "glint-extract | glint-ideal --sensors front.json | glint-sensor --sensors front.json | glint-noise --sensors front.json"
    check(glint(chain, folder, b"\n".join(scenes[100:]) + b"\n") == whole[100:], "the last scans alone differ")
    piped = subprocess.run(["bash", "-o", "pipefail", "-c", chain], env=ENV, cwd=folder, input=b"\n".join(scenes) + b"\n",
                           capture_output=True, check=True)
    check(piped.stdout.splitlines() == whole, "piped stages differ")
    everything = glint(chain.replace("front.json |", "front.json --effects all |", 1), folder, b"\n".join(scenes) + b"\n")
    targets = [[json.loads(line)["targets"] for line in lines] for lines in (whole, everything)]
    check(targets[0] == targets[1], "auto and all differ")


def main():
    with tempfile.TemporaryDirectory() as folder:
        write_front(folder)
        for seed in (1, 2, 3):
            lines = glint(f"glint-traffic ./motorway.json --seed {seed} | glint-extract | "
                          "glint-ideal --sensors front.json | glint-sensor | glint-noise", folder)
            frames = [json.loads(line) for line in lines]
            check_recurrence([standing(frame) for frame in frames], seed)
            if seed == 1:
                check_pieces(folder, lines)
        check_own_speed(folder)
        check_standing_radar(folder)
    print(f"roadside: {recorded.checks} checks passed")


main()
