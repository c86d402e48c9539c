"""glint-summary against counts of its own input.

Usage: python3 tests/chain/summary.py BIN_DIR        exit status 1 if any check fails

Targets are counted here for the class of the object that has the greatest weight in them; those that a mirror,
the ground or noise made stand apart from classes. Every share is of its printed whole. Of frames before the sensors,
objects are counted, each once in its scene.
"""
import collections
import json
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
OTHERS = {"wall_object": "ghost", "object_wall": "ghost", "wall_object_wall": "ghost", "clutter": "clutter",
          "false_alarm": "false alarm"}
SENSORS, CLASSES, APART, LOOKED = (
    "targets by sensor", "targets by class of the object that made the most of them",
    "targets that show no object at their place", "reflectors that a sensor looked for, by what became of them")
OBJECTS = "objects by class, each counted once in its scene, egos too"


def weakest_first(lines):
    """The frames as another model might write them, whose labels have the leader last."""
    frames = [json.loads(line) for line in lines.splitlines()]
    for frame in frames:
        for target in frame["targets"]:
            target["contributors"].reverse()
    return "".join(json.dumps(frame) + "\n" for frame in frames)


def run(text, bin_dir, data=None):
    environment = dict(os.environ, PATH=bin_dir + os.pathsep + os.environ["PATH"], GLINT_DATA=ROOT + "/data")
    done = subprocess.run(["bash", "-o", "pipefail", "-c", text], env=environment, cwd=ROOT, input=data, text=True,
                          capture_output=True, check=False)
    if done.returncode != 0:
        sys.exit(f"summary: {text}: {done.stderr}")
    return done.stdout


def counted(frames):
    """{heading: (counts by name, the whole)}, the scans of each sensor, and how many targets are merged."""
    counts, scans, merged = collections.defaultdict(collections.Counter), collections.Counter(), 0
    for frame in frames:
        classes = {one["id"]: one["class"] for one in frame["objects"]}
        scans.update(one["name"] for one in frame["sensors"]["list"] if one["measured"])
        for group in frame.get("lost", []) if "account" in frame.get("sections", []) else []:
            own = group["stage"] + ": " if group["stage"] == "mud" else ""
            counts[LOOKED][own + group["reason"]] += len(group["echoes"])
        for target in frame["targets"]:
            parts = target["contributors"]
            strongest = max(parts, key=lambda part: part["weight"])
            other = OTHERS.get(strongest["path"])
            counts[SENSORS][target["sensor"]] += 1
            counts[APART if other else CLASSES][other or classes.get(strongest["object"], strongest["object"])] += 1
            merged += len({part["object"] for part in parts}) > 1
            if "account" in frame.get("sections", []):
                counts[LOOKED]["in a target"] += sum(part["path"] != "false_alarm" for part in parts)
    for name in scans:
        counts[SENSORS][name] += 0
    targets = sum(counts[SENSORS].values())
    wholes = {LOOKED: sum(counts[LOOKED].values())}
    return {title: (own, wholes.get(title, targets)) for title, own in counts.items()}, scans, merged


def expected_of_traffic(frames):
    """The summary of frames before the sensors, behind its first line."""
    ids = {(frame["scene"], frame["seed"], one["id"], one["class"]) for frame in frames for one in frame["objects"]}
    classes = collections.Counter(name for *_, name in ids)
    mean = sum(len(frame["objects"]) for frame in frames) / len(frames)
    yield from (f"{len(ids)} objects, {mean:.2f} in a frame; no sensor has looked at them yet", "", OBJECTS)
    for name, count in sorted(classes.items(), key=lambda item: (-item[1], item[0].encode())):
        yield f"  {count:9}  {100 * count / len(ids):5.1f} %  {name}"


def expected(frames):
    """The whole summary, line by line."""
    yield (f"{len(frames)} frames, {sum(frame['interval_s'] for frame in frames):.2f} s; scenes that reached their end: "
           f"{sum(frame.get('last', False) for frame in frames)}")
    if frames and "targets" not in frames[0]:
        yield from expected_of_traffic(frames)
        return
    tables, scans, merged = counted(frames)
    targets = tables[SENSORS][1]
    farthest = max((target["range_m"] for frame in frames for target in frame["targets"]), default=0)
    yield (f"{targets} targets, {targets / max(sum(scans.values()), 1):.2f} a scan, the farthest at {farthest:.1f} m; "
           f"{merged} ({100 * merged / max(targets, 1):.1f} %) of them merged from several objects")
    for title in SENSORS, CLASSES, APART, LOOKED:
        own, whole = tables.get(title, ({}, 0))
        if own:
            yield from ("", title)
        for name, count in sorted(own.items(), key=lambda item: (-item[1], item[0].encode())):
            line = f"  {count:9}  {100 * count / max(whole, 1):5.1f} %  {name}"
            scanned = title == SENSORS and scans[name] > 0
            yield line + (f": {count / scans[name]:.2f} in each of {scans[name]} scans" if scanned else "")


def main(bin_dir):
    failed, seen = 0, set()
    sources = [f"glint pipelines/{name}.sh" for name in ("ghosts", "false-alarms", "clutter", "intersection")]
    sources += ["bash pipelines/mud.sh", "true",
                "glint-traffic empty-road | glint-extract | glint-ideal --sensors srr24-pair-every-frame | glint-sensor | glint-noise",
                "glint-traffic two-vehicles | glint-extract | glint-ideal --sensors corner77 | glint-sensor | glint-noise"]
    sources += ["glint-traffic cut-in", "glint-traffic-random --frames 200 | glint-extract"]
    streams = [(source, run(source, bin_dir)) for source in sources]
    random, other = (run(f"glint-traffic-random --frames 9 --seed {seed}", bin_dir).splitlines(True) for seed in (1, 2))
    mixed = "".join(one + two for one, two in zip(random, other))
    streams.append(("scenes of one name whose frames alternate", mixed + streams[-2][1]))
    streams.append(("labels with the leader last", weakest_first(streams[0][1] + streams[3][1])))
    for source, lines in streams:
        shown = run("glint-summary", bin_dir, lines).splitlines()
        of = list(expected([json.loads(line) for line in lines.splitlines()]))
        seen |= {re.sub(r"^[\s\d.]+%\s+", "", line) for line in shown}
        for one, other in zip(shown + ["nothing"] * len(of), of + ["nothing"] * (len(shown) - len(of))):
            if one != other:
                print(f"summary: {source}: {one!r}, expected {other!r}")
                failed = 1
    missing = {"ghost", "clutter", "false alarm", "in a target", APART, OBJECTS} - seen
    if missing:
        print(f"summary: no source shows {missing}")
    return failed or bool(missing)


if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1])))
