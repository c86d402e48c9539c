"""scripts/bench --effects: what leaving out effects gains.

The same frames of six scenes in rain, under lrr77-full, with --effects all, auto, and none, which is the
floor. The part physics is the steps of ideal, sensor and noise; end to end is from a file of frames to target
lists. Each ratio is the time of all divided by that of its line.
"""
import json
import os
import statistics
import subprocess

import counts
import timing

SCENES = {"highway": "glint-traffic highway-straight", "intersection": "glint-traffic intersection",
          "empty road": "glint-traffic empty-road", "cut-in": "glint-traffic cut-in", "motorway": "glint-traffic motorway",
          "densest": "glint-traffic-random --density dense --frames 40"}
EFFECTS = ["all", "auto", "none"]
PHYSICS = ["ideal", "sensor", "noise"]


def write_frames(glint, source, path, count=40):
    """Frames spread evenly over a scene, in rain."""
    done = subprocess.run([glint, "-c", source], check=True, stdout=subprocess.PIPE, text=True)
    frames = [json.loads(line) for line in done.stdout.splitlines()]
    frames = frames[::len(frames) // count][:count]
    for frame in frames:
        frame.setdefault("conditions", {})["rain_mmph"] = 10
    with open(path, "w") as out:
        out.writelines(json.dumps(frame) + "\n" for frame in frames)
    return len(frames)


def chain(files, effects):
    return (f"glint-extract {files} | glint-ideal --sensors lrr77-full --effects {effects}"
            " | glint-sensor | glint-noise")


def instructions(glint, path, effects):
    parts = counts.instructions(glint, (chain("-", effects), path))
    return {"physics": sum(parts[name] for name in PHYSICS), "end to end": parts["all"]}


def sample(glint, path, repeat, folder):
    """Samples of ns per frame, by effects and part. A scene is read 20 times, so that the start
    does not count."""
    samples = {(effects, part): [] for effects in EFFECTS for part in ("physics", "end to end")}
    for _ in range(repeat):
        for effects in EFFECTS:
            ns = timing.part_times(glint, chain(" ".join([path] * 20), effects), folder)
            samples[effects, "physics"].append(sum(ns[name] for name in PHYSICS))
            samples[effects, "end to end"].append(sum(ns.values()))
    return samples


def lines(options, folder):
    for scene, source in SCENES.items():
        path = os.path.join(folder, "frames")
        frames = write_frames(options.glint, source, path)
        counted = counts.available() and dict(zip(EFFECTS, counts.side_by_side(
            lambda effects: instructions(options.glint, path, effects), EFFECTS)))
        samples = sample(options.glint, path, options.repeat, folder)
        for (effects, part), values in samples.items():
            line = {"scene": scene, "effects": effects, "part": part, "frames": frames}
            if counted:
                line["instructions_per_frame"] = round(counted[effects][part])
                line["instructions_ratio"] = round(counted["all"][part] / counted[effects][part], 2)
            ratio = statistics.median(samples["all", part]) / statistics.median(values)
            yield line | timing.spread(values) | {"ns_ratio": round(ratio, 2)}
