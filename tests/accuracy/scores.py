"""How far ways are off, as rows: of one way against one reference, in one scene or in all."""
import json
import math
import os
import re
import statistics
import subprocess

import ways

COMPONENTS = ["range_m", "azimuth_rad", "range_rate_mps", "amplitude_db"]
PARTS = ["localisation", "missed", "false"]
COLUMNS = ["ladder", "radar", "way", "against", "scene", "gospa", "gospa_error",
           *(f"gospa_{part}" for part in PARTS), "missed_count", "false_count",
           *(f"{name}_max" for name in COMPONENTS), "azimuth_rad_mean", "cpu_us", "cpu_us_min",
           "cpu_us_max", "cpu_ns_per_echo", "echoes", "bytes"]


def summary(seeds):
    """Of lists of scans by seed. Means over scans: GOSPA and the parts of its square, counts; the
    standard error that the seeds leave; and the greatest differences."""
    scans = [scan for of in seeds.values() for scan in of]
    means = {key: statistics.fmean(scan[key] for scan in scans)
             for key in ["gospa", *(f"gospa_{part}" for part in PARTS), "missed_count", "false_count"]}
    spread = statistics.stdev(statistics.fmean(scan["gospa"] for scan in of) for of in seeds.values())
    greatest = {f"{name}_max": max((scan[name]["max"] for scan in scans if "max" in scan.get(name, {})), default=0)
                for name in COMPONENTS}
    return means | {"gospa_error": spread / math.sqrt(len(seeds))} | greatest


def score(truths, lists):
    """Summaries by scene and of all."""
    scans = {}
    for truth, listed in zip(truths, lists):
        done = subprocess.run([os.path.join(ways.BIN, "glint-score"), "--truth", truth, listed], check=True,
                              stdout=subprocess.PIPE)
        for line in done.stdout.splitlines():
            frame = json.loads(line)
            name, _, seed = frame["scene"].partition("#")
            for scene in ("all", name.partition("/")[0]):
                scans.setdefault(scene, {}).setdefault(seed, []).extend(frame["sensors"])
    return {scene: summary(of) for scene, of in scans.items()}


def rotated(lists):
    """Each list under the names of its next seed, to compare a reference with itself."""
    turned = []
    for path in lists:
        lines = ways.content(path).decode().splitlines()
        seed_of = re.compile(r'"scene":"[^"#]*#(\d+)"')
        of = [seed_of.search(line)[1] for line in lines]
        seeds = list(dict.fromkeys(of))
        after = dict(zip(seeds, seeds[1:] + seeds[:1]))
        moved = {seed: [] for seed in seeds}
        for line, seed in zip(lines, of):
            moved[after[seed]].append(re.sub(r"#\d+\"", f'#{after[seed]}"', line, count=1))
        turned.append(f"{path}.turned")
        with open(turned[-1], "w") as text:
            text.writelines(f"{line}\n" for seed in seeds for line in moved[seed])
    return turned


def timed(ladder, radar, name, against, scene, cpu_ns):
    return {"ladder": ladder, "radar": radar, "way": name, "against": against, "scene": scene,
            "cpu_us": statistics.median(cpu_ns) / 1e3, "cpu_us_min": min(cpu_ns) / 1e3,
            "cpu_us_max": max(cpu_ns) / 1e3}


def rows(way, against, scores):
    text = b"".join(map(ways.content, way.lists))
    echoes = sum(map(int, re.findall(rb'"echoes":(\d+)', text))) / way.radar.count
    made = []
    for scene, of in scores.items():
        row = timed(way.ladder, way.radar.name, way.name, against, scene, way.cpu_ns)
        made.append(row | of | {"cpu_ns_per_echo": 1e3 * row["cpu_us"] / echoes, "echoes": echoes,
                                "bytes": way.bytes})
    return made


def table_rows(rounds):
    """Inverting the sensing ratio by tables: time per angle, and errors."""
    program = os.path.join(ways.BUILD, "tests", "speed", "angles")
    subprocess.run(["make", "-s", f"BUILD={os.path.relpath(ways.BUILD, ways.ROOT)}",
                    os.path.relpath(program, ways.ROOT)], check=True, cwd=ways.ROOT)
    text = subprocess.run([program, str(rounds)], check=True, stdout=subprocess.PIPE, text=True).stdout
    samples = {}
    for line in text.splitlines():
        entries, ns, mean, greatest = map(float, line.split("\t"))
        samples.setdefault((int(entries), mean, greatest), []).append(ns)
    return [timed("table", "", str(entries) if entries else "closed form", "exact", "all", ns)
            | {"azimuth_rad_mean": mean, "azimuth_rad_max": greatest}
            for (entries, mean, greatest), ns in samples.items()]


# --- read off --------------------------------------------------------------------------------------

def pick(of, scene="all", **wanted):
    return [row for row in of if row["scene"] == scene
            and all(row[key] == value for key, value in wanted.items())]


def floor(of, radar, against):
    return pick(of, ladder="reference", radar=radar, against=against)[0]


def spent(us):
    return f"{us:.3g} µs" if us < 1000 else f"{us / 1000:.3g} ms"
