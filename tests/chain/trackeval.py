"""Truth given as tracks scores 1 in TrackEval's metrics, by what scripts/tracker --trackeval writes: python3 tests/chain/trackeval.py BIN_DIR

TrackEval's reader of the MOTChallenge's text and its metrics HOTA, CLEAR and Identity are written here a second time, from
their publications (Luiten et al. 2021; Bernardin, Stiefelhagen 2008; Ristani et al. 2016) and from what the reader refuses.
"""
import collections
import json
import math
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(ROOT, "scripts"))
import glint  # noqa: E402
from glint.exports.trackeval import truth_of  # noqa: E402

ENVIRONMENT = dict(os.environ, PATH=os.path.abspath(sys.argv[1]) + os.pathsep + os.environ["PATH"], GLINT_DATA=ROOT + "/data",
                   PYTHONDONTWRITEBYTECODE="1")
ALPHAS = [0.05 * i for i in range(1, 20)]
SET = "MOT15-train"


def run(command, folder, status=0):
    done = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, env=ENVIRONMENT, capture_output=True, text=True, check=False)
    assert done.returncode == status, f"{command}: {done.returncode}: {done.stderr}"
    return done.stdout + done.stderr


# What TrackEval reads


def rows_of(path, length, is_truth):
    """{frame: {id: box}} of a text of the MOTChallenge; what TrackEval's reader refuses is a ValueError."""
    frames = collections.defaultdict(dict)
    with open(path) as file:
        for line in file:
            frame, name, left, top, width, height, conf, kind, *_ = map(float, line.split(","))
            if not 1 <= frame <= length or frame % 1:
                raise ValueError(f"frame {frame} is outside 1 to {length}")
            if name < 0 or name % 1 or name in frames[frame]:
                raise ValueError(f"id {name} in frame {frame}: negative, or twice")
            if kind != 1 and (is_truth or kind != -1):
                raise ValueError(f"class {kind}")
            if conf == 0 and is_truth:
                continue
            frames[frame][int(name)] = left, top, width, height
    return frames


def sequences(folder, tracker):
    with open(os.path.join(folder, "gt", "seqmaps", SET + ".txt")) as file:
        names = [line.strip() for line in file][1:]
    for name in names:
        if "/" in name:
            raise ValueError(f"sequence {name}")
        with open(os.path.join(folder, "gt", SET, name, "seqinfo.ini")) as file:
            length = int(next(line for line in file if line.startswith("seqLength")).split("=")[1])
        yield [length, *(rows_of(os.path.join(folder, *path), length, path[0] == "gt") for path in
                         (("gt", SET, name, "gt", "gt.txt"), ("trackers", SET, tracker, "data", name + ".txt")))]


def overlap(one, other):
    """Intersection over union of two boxes."""
    sides = [max(0, min(one[i] + one[i + 2], other[i] + other[i + 2]) - max(one[i], other[i])) for i in (0, 1)]
    both = sides[0] * sides[1]
    union = one[2] * one[3] + other[2] * other[3] - both
    return both / union if union > 0 else 0


# What TrackEval computes


def assigned(gain):
    """The pairs (row, column) of the greatest sum of gains: the Hungarian method on a square of costs."""
    size = max(len(gain), max(map(len, gain), default=0))
    cost = [[-(gain[i][j] if i < len(gain) and j < len(gain[i]) else 0) for j in range(size)] for i in range(size)]
    u, v, row_of, way = [0.0] * (size + 1), [0.0] * (size + 1), [0] * (size + 1), [0] * (size + 1)
    for i in range(1, size + 1):
        row_of[0], column = i, 0
        least, used = [math.inf] * (size + 1), [False] * (size + 1)
        while row_of[column]:
            used[column], best = True, (math.inf, 0)
            for j in range(1, size + 1):
                if not used[j]:
                    slack = cost[row_of[column] - 1][j - 1] - u[row_of[column]] - v[j]
                    if slack < least[j]:
                        least[j], way[j] = slack, column
                    best = min(best, (least[j], j))
            for j in range(size + 1):
                if used[j]:
                    u[row_of[j]] += best[0]
                    v[j] -= best[0]
                else:
                    least[j] -= best[0]
            column = best[1]
        while column:
            row_of[column], column = row_of[way[column]], way[column]
    return [(row_of[j] - 1, j - 1) for j in range(1, size + 1) if row_of[j] <= len(gain) and j <= len(gain[0])] if gain else []


def frames_of(length, truth, tracks):
    for number in range(1, length + 1):
        ids, names = sorted(truth[number]), sorted(tracks[number])
        yield ids, names, [[overlap(truth[number][one], tracks[number][other]) for other in names] for one in ids]


def clear(length, truth, tracks):
    """MOTA."""
    hits = misses = false = switches = 0
    last, before = {}, {}
    for ids, names, alike in frames_of(length, truth, tracks):
        gain = [[(1000 * (before.get(one) == other) + alike[i][j]) * (alike[i][j] >= 0.5) for j, other in enumerate(names)]
                for i, one in enumerate(ids)]
        pairs = {ids[i]: names[j] for i, j in assigned(gain) if gain[i][j] > 0}
        switches += sum(one in last and last[one] != other for one, other in pairs.items())
        last.update(pairs)
        before = pairs
        hits, misses, false = hits + len(pairs), misses + len(ids) - len(pairs), false + len(names) - len(pairs)
    return (hits - false - switches) / (hits + misses)


def identity(length, truth, tracks):
    """IDF1."""
    both, of_ids, of_names = collections.Counter(), collections.Counter(), collections.Counter()
    for ids, names, alike in frames_of(length, truth, tracks):
        of_ids.update(ids)
        of_names.update(names)
        both.update((one, other) for i, one in enumerate(ids) for j, other in enumerate(names) if alike[i][j] >= 0.5)
    ids, names = sorted(of_ids), sorted(of_names)
    gain = [[both[one, other] for other in names] for one in ids]
    same = sum(gain[i][j] for i, j in assigned(gain))
    return 2 * same / (sum(of_ids.values()) + sum(of_names.values()))


def hota(length, truth, tracks):
    """HOTA, the mean over thresholds of the root of detection's and association's accuracy."""
    frames = list(frames_of(length, truth, tracks))
    chance, of_ids, of_names = collections.Counter(), collections.Counter(), collections.Counter()
    for ids, names, alike in frames:
        rows, columns = [sum(row) for row in alike], [sum(column) for column in zip(*alike)]
        for i, one in enumerate(ids):
            for j, other in enumerate(names):
                union = rows[i] + columns[j] - alike[i][j]
                chance[one, other] += alike[i][j] / union if union > 0 else 0
        of_ids.update(ids)
        of_names.update(names)
    aligned = {(one, other): sum_ / (of_ids[one] + of_names[other] - sum_) for (one, other), sum_ in chance.items()}
    matches = [collections.Counter() for _ in ALPHAS]
    for ids, names, alike in frames:
        gain = [[aligned[one, other] * alike[i][j] for j, other in enumerate(names)] for i, one in enumerate(ids)]
        for i, j in assigned(gain):
            for alpha, found in zip(ALPHAS, matches):
                found[ids[i], names[j]] += alike[i][j] >= alpha - 1e-12 and alike[i][j] > 0
    scores = []
    for found in matches:
        hits = sum(found.values())
        whole = sum(of_ids.values()) + sum(of_names.values()) - hits
        joined = sum(n * n / (of_ids[one] + of_names[other] - n) for (one, other), n in found.items() if n)
        scores.append(math.sqrt(hits / whole * joined / hits) if hits else 0)
    return sum(scores) / len(scores)


def scores(folder, tracker="tracker"):
    """HOTA, MOTA and IDF1 of each sequence."""
    return [tuple(metric(*one) for metric in (hota, clear, identity)) for one in sequences(folder, tracker)]


# What is tested


def moved_truth(folder, step_m):
    """Truth in view as tracks, each moved along x, under other ids; evaluated with a gate of 2 m."""
    with open(os.path.join(folder, "truth.jsonl"), "w") as file:
        for frame in glint.frames(os.path.join(folder, "list.jsonl")):
            glint.write_tracks(frame, [("t" + one["id"], one["x_m"] + step_m, one["y_m"], 0, 0) for one in truth_of(frame, "in_view")], file)
    run(f"rm -rf moved; {ROOT}/scripts/tracker --trackeval moved --tracks truth.jsonl --gate-m 2 list.jsonl", folder)
    return scores(os.path.join(folder, "moved"))


def truth_scores_one_and_the_gate_is_where_it_says(folder):
    assert moved_truth(folder, 0) == [(1, 1, 1)] * 2
    for step_m, paired in ((0.5, True), (1.99, True), (2.01, False)):
        alike = (6 - step_m) / (6 + step_m)
        expected = sum(alpha <= alike for alpha in ALPHAS) / len(ALPHAS)
        for found in moved_truth(folder, step_m):
            assert abs(found[0] - expected) < 0.01, (step_m, found, expected)
            assert found[1:] == (1, 1) if paired else found[1] < -0.9 and found[2] < 0.1, (step_m, found)


def what_the_reader_refuses_is_not_written(folder):
    """Each fault that TrackEval refuses or scores 0 is planted into what was written."""
    moved_truth(folder, 0)
    place = os.path.join(folder, "moved")
    [first, *_] = os.listdir(os.path.join(place, "gt", SET))
    path = os.path.join(place, "trackers", SET, "tracker", "data", first + ".txt")
    with open(path) as file:
        good = file.readlines()
    cells = good[0].split(",")
    for fault in (["0", *cells[1:]], [*cells[:7], "12.5", *cells[8:]], ["1", "-1", *cells[2:]], ["100000", *cells[1:]], cells):
        with open(path, "w") as file:
            file.writelines([",".join(fault), *(good if fault is cells else good[1:])])
        try:
            scores(place)
        except ValueError:
            continue
        raise AssertionError(f"{fault} was read")
    with open(path, "w") as file:
        file.writelines(",".join([*line.split(",")[:4], "0", "0", *line.split(",")[6:]]) for line in good)
    assert min(scores(place))[1] == -1, "squares without a side"


def the_tracker_is_scored_and_objects_can_be_chosen(folder):
    for which in ("in_view", "detected", "all"):
        run(f"{ROOT}/scripts/tracker --trackeval own-{which} --objects {which} list.jsonl", folder)
        for score in scores(os.path.join(folder, f"own-{which}")):
            assert 0.1 < score[0] < 1 and score[1] < 1 and 0.1 < score[2] < 1, (which, score)
    lines = {which: run(f"cat own-{which}/gt/{SET}/*/gt/gt.txt | wc -l", folder) for which in ("in_view", "detected", "all")}
    truths = {which: json.loads(run(f"glint-score-tracks --tracks truth.jsonl --objects {which} --summary list.jsonl", folder))["all"]["true_count"]
              for which in lines}
    assert {which: int(count) for which, count in lines.items()} == truths and len(set(truths.values())) == 3, (lines, truths)


def faults_have_a_line_and_a_status(folder):
    tracker = f"{ROOT}/scripts/tracker"
    for words, status, message in (("--trackeval own-all list.jsonl", 73, "--trackeval 'own-all': is there already"),
                                   ("--trackeval new --tracks list.jsonl list.jsonl", 65, "list.jsonl:1: KeyError('tracks'); expected the tracks of"),
                                   ("--trackeval new --gate-m 0 list.jsonl", 64, "--gate-m 0.0: expected more than 0 m"),
                                   ("--trackeval new nowhere.jsonl", 66, "nowhere.jsonl"),
                                   ("--objects seen list.jsonl", 64, "--objects: invalid choice")):
        told = run(f"{tracker} {words}", folder, status)
        assert message in told and told.count("\n") == 1, (words, told)
        assert not os.path.exists(os.path.join(folder, "new"))


def main():
    with tempfile.TemporaryDirectory() as folder:
        run("for source in cut-in intersection; do glint-traffic $source | glint-extract | glint-ideal --sensors corner77 --sections"
            " quality,objects | glint-sensor | glint-noise; done > list.jsonl", folder)
        for test in (truth_scores_one_and_the_gate_is_where_it_says, what_the_reader_refuses_is_not_written,
                     the_tracker_is_scored_and_objects_can_be_chosen, faults_have_a_line_and_a_status):
            test(folder)
            print("ok      ", test.__name__.replace("_", " "))


main()
