"""glint beside a recording: fitted on its first half, compared with its second half, in print."""
import itertools
import json
import math
import operator
import os
import statistics
import subprocess
import tempfile
from collections import namedtuple

from glint import command_line
from glint.places import GLINT
from glint.progress import Progress
from glint.recordings import chains, dense, fitted, geometry, marginals, readers, roadside, score, statics

FAR, NEAR = 10, (1, 2, 3)  # scans away, of predictors that the recording itself gives
MOUNT_Z_M = 0.5  # assumed, as lrr77-full
ROUNDS, LEVELLED = 3, 6  # that find the level of simulated lists beside dense ones, and the lists of each


class Part(namedtuple("Part", "radar scans speeds boxes scale coarse", defaults=(score.COARSE, frozenset()))):
    """Scans with boxes where the lists saw them, the ego's speeds, {(id, scan): box} of road users in view, units of scores,
    and the numbers of scans whose far lists are of coarse cells."""

    def of(self, lists, peaks=False):
        """{(id, scan): detections} of lists of these scans, or their peaks alone."""
        gate = geometry.WIDE if self.scale is score.COARSE else geometry.BARE
        seen = {key: geometry.gated(self.radar, box, lists[key[1]], gate) for key, box in self.boxes.items()}
        return {key: dense.peaks(own, self.peak_m(key)) for key, own in seen.items()} if peaks else seen

    def peak_m(self, key):
        """The least distance in range of two peaks of a road user: a unit, or three where cells are coarse."""
        is_far = geometry.look(self.radar, self.boxes[key]).range_m >= dense.NEAR_M
        return self.scale.range_m * (3 if is_far and key[1] in self.coarse else 1)

    def observed(self, peaks=False):
        return self.of([scan.detections for scan in self.scans], peaks)

    def scores(self, lists, peaks=False):
        """{(id, scan): S} of lists by seed and scan."""
        gated = [self.of(one, peaks) for one in lists]
        return {key: score.energy_score([one[key] for one in gated], seen, self.scale) for key, seen in self.observed(peaks).items()}

    def scores_of_itself(self, away, peaks=False):
        """{(id, scan): S} of what the same body gave in other scans, moved to where it is now, if there are two or more.
        away: does this distance in scans count?"""
        seen, looks = self.observed(peaks), {key: geometry.look(self.radar, box) for key, box in self.boxes.items()}
        others = {key: [moved(seen[other], looks[other], look) for other in seen if other[0] == key[0]
                        and away(abs(other[1] - key[1]))] for key, look in looks.items()}
        return {key: score.energy_score(own, seen[key], self.scale) for key, own in others.items() if len(own) > 1}


def moved(detections, there, here):
    ways = {name: getattr(here, name) - getattr(there, name) for name in here._fields}
    return [one._replace(**{name: getattr(one, name) + way for name, way in ways.items()}) for one in detections]


def part(fit, radar, scans):
    """Scans of a recording whose boxes lie as the annotation was found to."""
    lag_s, inset_m = fit.annotation
    boxes = [[box._replace(x_m=box.x_m - lag_s * box.vx_mps, y_m=box.y_m - lag_s * box.vy_mps,
                           length_m=max(box.length_m - 2 * inset_m, 0.1), width_m=max(box.width_m - 2 * inset_m, 0.1))
              for box in scan.boxes] for scan in scans]
    scans = [scan._replace(boxes=own) for scan, own in zip(fitted.completed(scans, fit.curve), boxes)]
    return Part(radar, scans, statics.ego_speeds(radar, scans),
                {(box.id, i): box for i, own in enumerate(boxes) for box in own
                 if box.kind not in readers.STANDING and geometry.in_view(fit.sensor, radar, box)},
                fit.scale, frozenset() if fit.scale is score.COARSE else dense.coarse_scans(radar, scans, fit.sensor["cell_range_m"]))


def halves(recording):
    middle = len(recording.scans) // 2
    return [recording._replace(scans=scans) for scans in (recording.scans[:middle], recording.scans[middle:])]


def print_found(recording, fit, lost):
    duration_s = recording.scans[-1].time_s - recording.scans[0].time_s
    print(f"{len(recording.scans)} scans in {duration_s:.1f} s: fitted on the first half, compared with the second",
          *recording.notes, sep="\n")
    (lag_s, inset_m), law, sensor = fit.annotation, fit.curve, fit.sensor
    azimuth_rad = math.hypot(sensor.get("azimuth_floor_rad", 0), fit.azimuth_noise / 10)
    speed_mps = statistics.fmean(statics.ego_speeds(recording.radar, recording.scans))
    stands = any(statics.ego_speed(recording.radar, scan) is not None for scan in recording.scans)
    def told(member, text):
        return text if fitted.is_found(fit, member) else f"{text} (not found: as lrr77-full)"

    print(f"""
boxes      lists are {f"{lag_s:.2f} s older" if lag_s else "taken to be as old"}, and near faces lie {inset_m:.2f} m inside
ego        {f"{speed_mps:.1f} m/s on average, by what stands" if stands else "taken to stand, as too few rates agree"}
threshold  {sensor['threshold_db']:.1f} dB over the noise
receiver   0 dBsm has {", ".join(f"{level:.1f} dB at {range_m:.0f} m" for range_m, level in law.over_range)}
           aside {", ".join(f"{level:.1f} dB at {math.degrees(angle):.1f}" for angle, level in law.over_azimuth)} degrees
cells      {told("cell_range_m", f"{sensor['cell_range_m']:.2f} m")}, {told("cell_range_rate_mps", f"{sensor['cell_range_rate_mps']:.2f} m/s")}
noise      {told("range_sigma_m", f"{sensor['range_sigma_m']:.2f} m")}, \
{told("range_rate_sigma_mps", f"{sensor['range_rate_sigma_mps']:.3f} m/s")}, {told("azimuth_sigma_rad", f"{math.degrees(azimuth_rad):.2f} degrees at 20 dB")}\
{" (no less is possible in so wide a view)" * (fit.azimuth_noise < 1.001 * fitted.least_noise_rad(law))}
{f"inside     {dense.figures(recording.radar, recording.scans, sensor['threshold_db'])}" + chr(10) if fit.scale is not score.COARSE else ""}\
levels     keep the {fit.sensor['level_keeps']}: scores of blocks left out: {", ".join(f"{word} {own:.1f}" for word, own in lost.items()) or "none"}
roadside   {", ".join(f"{100 * one['per_m2'] * one['width_m']:.1f} of {one['rcs_dbsm']:.0f} dBsm at {one['from_y_m']} m{' (at its cap)' * roadside.at_cap(one)}"
                      for one in fit.roadside) or "nothing"}, in 100 m
""")


def gains(scores, others, ideal, scans, without=None):
    """By how many points scores are better than others, with the interval; without: one body left out."""
    better = {key: others[key] - score for key, score in scores.items() if key[0] != without}
    return [100 * one for one in score.share(better, ideal, scans)]


def skilled(suite, fit, recording, kinds, ways):
    """Scans as a part, and {chain: {(id, scan): S}} of the first kind of skill; prints the table of all kinds, {name: of peaks alone?}."""
    own = part(fit, recording.radar, recording.scans)
    results = {chain: chains.run(chain, suite, fit, own, own.scale.lists) for chain in Progress("chains").over(ways)}
    scores = {kind: {chain: own.scores(lists, peaks) for chain, (lists, _) in results.items()} for kind, peaks in kinds.items()}
    if own.boxes:
        print_skills(own, results, scores, kinds)
    return own, next(iter(scores.values()))


def print_skills(own, results, scores, kinds):
    scans, far = len(own.scans), FAR if own.scale is score.COARSE else dense.FAR
    rows = [("an empty list", None, {kind: own.scores([[[]] * scans], peaks) for kind, peaks in kinds.items()}),
            *((chain.name, us, {kind: of[chain] for kind, of in scores.items()}) for chain, (_, us) in results.items()),
            *((name, None, {kind: own.scores_of_itself(away, peaks) for kind, peaks in kinds.items()}) for name, away in (
                (f"the same body at least {far} scans away", far.__le__), ("the same body 1 to 3 scans away", NEAR.__contains__)))]
    print(f"{'predictor':38} {'us a frame':>10}", *(f"{kind:>8} {'interval':>13}" for kind in kinds))
    for name, us, found in (row for row in rows if all(row[2].values())):
        cells = [gains(found[kind], of[chains.IDEAL], of[chains.IDEAL], scans) for kind, of in scores.items()]
        print(f"{name:38} {'' if us is None else f'{us:.1f}':>10}",
              *(f"{skill:6.0f} % {least:6.0f} to {most:3.0f}" for skill, least, most in cells))
    blocks = scans / score.block_length(scans)
    if blocks < score.LONG_BLOCKS:
        print(f"too short: intervals of {blocks:.0f} blocks of scans; {score.LONG_BLOCKS} are needed")


def print_gains(scans, scores, ways):
    """How many points of skill chains gain over others, {chain: other}, and without each body."""
    ideal = scores[chains.IDEAL]
    for chain, before in ways.items():
        points, least, _ = gains(scores[chain], scores[before], ideal, scans) if before else (0, 0, 0)
        if least > 0:
            bodies = sorted({key[0] for key in ideal})
            left = {body: gains(scores[chain], scores[before], ideal, scans, body) for body in bodies if len(bodies) > 1}
            print(f"gain of {chain.name} over {before.name}: {points:.1f} points;", ", ".join(
                f"without body {body} {rest:.1f}{' (vanishes)' * (lowest <= 0)}" for body, (rest, lowest, _) in left.items()))


def kept(recording, folder):
    """Do levels keep the mean of the power or the median? {word: score} of blocks of scans, each under the suite found in
    the others; the lower is better. Without boxes there is none."""
    scans, lost = recording.scans, dict.fromkeys(("median", "mean") if any(scan.boxes for scan in recording.scans) else (), 0)
    blocks = max(len(scans) // score.block_length(len(scans)), 2)
    for begin, end in itertools.pairwise(len(scans) * i // blocks for i in range(blocks + 1)):
        fit = fit_of(recording._replace(scans=scans[:begin] + scans[end:]), folder)
        block = part(fit, recording.radar, scans[begin:end])
        for word in lost:
            lists, _ = chains.run(chains.ALL, fitted.write_suite(fit, folder, level_keeps=word), fit, block, block.scale.lists)
            lost[word] += sum(block.scores(lists).values())
    return lost


def fit_of(recording, folder, keeps="median"):
    """What the scans of a recording say; beside dense lists without cross sections, with the level at which lists of all effects
    have strongest detections as strong as the recorded ones."""
    fit = fitted.fit(recording, keeps)
    if fit.scale is score.COARSE or any(one.rcs_dbsm is not None for scan in recording.scans for one in scan.detections):
        return fit
    scans = [scan._replace(time_s=dense.INTERVAL_S * i) for i, scan in enumerate(recording.scans)]  # also of drawn ones
    for _ in range(ROUNDS):
        own = part(fit, recording.radar, scans)
        lists, _ = chains.run(chains.ALL, fitted.write_suite(fit, folder), fit, own, LEVELLED)
        seen, made = ([level for of in lists for _, level in dense.strongest(own.of(of).items())] for lists in (
            [[scan.detections for scan in own.scans]], lists))
        fit = fit._replace(curve=fit.curve.raised(statistics.fmean(seen) - statistics.fmean(made)) if made else fit.curve)
    return fit


def fits(recording, folder, keeps="median", **changed):
    """What a recording says, and what as many others of its law might say as a chain has lists: from scans drawn in blocks.
    All have the roadside of the first. Lists of all effects under the first tell what the estimates add: their echoes lie
    behind the nearest points of boxes, and merged ones spread wider than the noise of range. All fits are without it. Of n
    blocks n - 3 are drawn: fits then vary by n/(n - 3) times the bootstrap's variance, as Student's t of n blocks does."""
    found = fit_of(recording, folder, keeps)
    own = part(found, recording.radar, recording.scans)
    lists, _ = chains.run(chains.ALL, fitted.write_suite(found, folder, **changed), found, own, own.scale.lists)
    made = [[scan._replace(detections=seen) for scan, seen in zip(own.scans, one)] for one in lists]
    behind = (0, 0) if found.scale is not score.COARSE else [
        statistics.fmean(of) for of in zip(*(fitted.annotation(recording._replace(scans=scans)) for scans in made))]
    noises_m = [fitted.noise(recording.radar, scans, 1e-3)[0].get("range_sigma_m") for scans in made]
    wider = 1 if None in noises_m or not fitted.is_found(found, "range_sigma_m") else statistics.fmean(noises_m) / found.sensor["range_sigma_m"]
    drawn = Progress("fits").over([*score.resampled(len(recording.scans), chains.SEEDS, 3)])
    told = [found, *(fit_of(recording._replace(scans=[recording.scans[i] for i in one]), folder, keeps) for one in drawn)]
    return [one._replace(annotation=fitted.Annotation(*map(operator.sub, one.annotation, behind)),
                         sensor=one.sensor | {"range_sigma_m": one.sensor["range_sigma_m"] / wider}) for one in told]


def drawn_lists(chain, fits_drawn, rest, folder, **changed):
    """Lists, [fit][scan], of a chain: one seed under each fit, with the boxes where that fit has them."""
    return [chains.run(chain, fitted.write_suite(fit, folder, **changed), fit, part(fit, rest.radar, rest.scans), 1, seed)[0][0]
            for seed, fit in enumerate(fits_drawn, 1)]


def print_marginals(second, lists, threshold_db):
    """Numbers of the recording beside the least and largest of the lists of each chain, {chain: [list][scan]}."""
    told = marginals.values(second, [scan.detections for scan in second.scans], threshold_db)
    ranges = {chain: [marginals.values(second, one, threshold_db) for one in own] for chain, own in lists.items()}
    print(f"\n{'* outside':42} {'recorded':>8}", *(f"{chain.name:>20}" for chain in ranges))
    for name, value in told.items():
        cells = [[one[name] for one in own if name in one] for own in ranges.values()]
        print(f"{name:42} {value:8.1f}", *(f"{f'{min(own):.1f} to {max(own):.1f}' if own else 'none':>19}"
                                           + " *"[marginals.outside(value, own)] for own in cells))


def print_components(second, fit, folder, scores):
    """The components whose replacement costs most, of the best chain with all effects, and what a road that mirrors costs."""
    with_all = [chain for chain in scores if chain.effects == "auto" and not chain.road]
    best = min(with_all, key=lambda chain: sum(scores[chain].values()))
    suite, scans, lost = fitted.write_suite(fit, folder), len(second.scans), []
    listed = subprocess.run([GLINT, "--list", "effects"], check=True, stdout=subprocess.PIPE, text=True).stdout
    trials = [(f"without {name}", best._replace(effects=f"all,-{name}"), suite)
              for name in (line.split()[0] for line in listed.splitlines())]
    steady = {"level_constant_db": 0, "level_slow_db": 0, "level_fast_db": 0}
    trials += [(f"{law} instead of levels", best, fitted.write_suite(fit, folder, **steady, fluctuation=law))
               for law in ("log_normal", "swerling_1", "swerling_3")]
    mirrored = (f"over asphalt, {MOUNT_Z_M} m high", best._replace(surface="asphalt"), fitted.write_suite(fit, folder, mount_z_m=MOUNT_Z_M))
    for name, chain, document in Progress("components").over([*trials, mirrored]):
        lists, _ = chains.run(chain, document, fit, second, second.scale.lists)
        lost.append((gains(scores[best], second.scores(lists), scores[chains.IDEAL], scans), name))
    print(f"\n{best.name}, these cost most skill")
    for (points, least, most), name in [*sorted(lost[:-1], reverse=True)[:3], lost[-1]]:
        print(f"{name:38} {points:6.1f} points, {least:.1f} to {most:.1f}")


def compare(folder, suite_folder=None):
    """Prints all of it, and writes the suite that was found into a folder, if one is named."""
    try:
        os.makedirs(suite_folder or ".", exist_ok=True)
    except OSError as error:
        command_line.fail(os.EX_CANTCREAT, error)
    recording = readers.read(folder)
    first, rest = halves(recording)
    with tempfile.TemporaryDirectory() as place:
        lost = kept(first, place)
        fit, *others = fits(first, place, min(lost, key=lost.get, default="median"))
        suite = fitted.write_suite(fit, suite_folder or place)
        is_dense = fit.scale is not score.COARSE
        kinds, ways = (dense.SKILLS, chains.DENSE) if is_dense else ({"skill": False}, chains.CHAINS)
        strips = [] if is_dense else roadside.strips(chains.ROADSIDE, suite, fit, part(fit, first.radar, first.scans))
        fit, *others = (one._replace(roadside=strips) for one in (fit, *others))
        print_found(recording, fit, lost)
        if is_dense:
            print("all scans, also those of the fit:")
            skilled(suite, fit, recording, kinds, ways)
            print("the second half alone:")
        second, scores = skilled(suite, fit, rest, kinds, ways)
        if second.boxes:
            print_gains(len(second.scans), scores, ways)
        elif any(scan.boxes for scan in recording.scans):
            print("no road user is in view in the second half: skill and the marginals of road users are left out")
        print_marginals(second, {chain: drawn_lists(chain, others, rest, place)
                                 for chain in Progress("chains").over([*ways][1:])}, fit.sensor["threshold_db"])
        if second.boxes:
            print_components(second, fit, place, scores)
    if suite_folder:
        print(f"written: {os.path.relpath(suite)} and {os.path.relpath(write_found(fit, recording, suite_folder))}")


def write_found(fit, recording, folder):
    """What is found beside the suite: strips for a scenario, age and size of the boxes, and which members are not the recording's."""
    path = os.path.join(folder, "found.json")
    with open(path, "w", encoding="utf-8") as out:
        json.dump({"ego_mps": statistics.fmean(statics.ego_speeds(recording.radar, recording.scans)), **fit.annotation._asdict(), "roadside": fit.roadside,
                   "roadside_at_cap_y_m": [one["from_y_m"] for one in fit.roadside if roadside.at_cap(one)],
                   "not_found": [member for member in (*fitted.CELLS, *fitted.NOISES) if not fitted.is_found(fit, member)]}, out, indent=2)
    return path
