"""Run the executables against MODEL's printed figures and against the independent oracle.

Usage: python3 tests/oracle/model.py BIN_DIR        exit status 1 if any check fails
"""

import itertools
import json
import math
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

sys.dont_write_bytecode = True
import oracle  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "tests/support"), str(ROOT / "scripts")]
import glint  # noqa: E402

TAU = math.tau
RELATIVE = ABSOLUTE = 1e-9
FAINT = 1e-12  # near V = 0 and near +-90 degrees rounding of the angle alone moves cross sections and weights


# ---- running the chain, and saying what went wrong -------------------------------------------


def lines_of(frames):
    return "".join(json.dumps(one) + "\n" for one in frames)


def parsed(text):
    return [glint.name_lost(json.loads(line)) for line in text.splitlines()]


class Bench:
    def __init__(self, bin_dir, scratch):
        self.bin, self.scratch = Path(bin_dir).resolve(), Path(scratch)
        self.env = dict(os.environ, GLINT_DATA=str(self.scratch / "data"),
                        PATH=os.pathsep.join([str(self.bin), str(self.bin.parent / "tests"), os.environ["PATH"]]))
        self.vehicles = {path.stem: json.loads(path.read_text()) for path in (ROOT / "data/vehicles").glob("*.json")}
        self.failures, self.group_failures, self.group_checks = 0, 0, 0
        (self.scratch / "data/vehicles").mkdir(parents=True)
        (self.scratch / "data/sensors").symlink_to(self.scratch)  # where stages after glint-ideal look for suites

    def add_vehicle(self, name, document):
        self.vehicles[name] = document
        (self.scratch / f"data/vehicles/{name}.json").write_text(json.dumps(document))

    def program(self, name, pipeline):
        """The path of a program; the tests have a glint with a source of their own."""
        own = "glint-traffic-adversarial" in pipeline
        return str((self.bin.parent / "tests" if own else self.bin) / name)

    def stage(self, words, text):
        done = subprocess.run([self.program(words[0], words), *words[1:]], input=text, env=self.env, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        if done.returncode:
            raise SystemExit(f"{' '.join(words)}: exit status {done.returncode}\n{done.stderr}")
        return done.stdout

    def through(self, frames, *stages):
        """What stages make of frames, one process after the other."""
        text = lines_of(frames)
        for words in stages:
            text = self.stage(words, text)
        return parsed(text)

    def fused(self, pipeline, frames=()):
        """The lines that a pipeline in one process makes of frames."""
        done = subprocess.run([self.program("glint", pipeline), "-c", pipeline], input=lines_of(frames), env=self.env, text=True,
                              capture_output=True, check=False)
        self.check(done.returncode == 0, f"{pipeline}: exit status {done.returncode}: {done.stderr}")
        return done.stdout

    def played(self, *words):
        """The frames of a source."""
        return parsed(self.stage(words, ""))

    def write_suite(self, suite):
        path = self.scratch / "suite.json"
        path.write_text(json.dumps(suite))
        return str(path)

    def chain(self, frames, suite, account=False):
        """Runs the chain and returns frames with echoes, cells and targets."""
        ideal = ["glint-ideal", "--sensors", self.write_suite(suite)] + \
            ["--sections", "echoes,cells" + (",account" if account else "")]
        answer = self.through(frames, ["glint-extract"], ideal, ["glint-sensor"], ["glint-noise-none"])
        self.check(len(answer) == len(frames), f"{len(frames)} frames in, {len(answer)} out")
        return answer

    def cells_of(self, echo_lists, suite):
        """The cells that glint-sensor makes of hand-made echoes of the suite's only sensor."""
        [empty] = self.through([frame([ego()])], ["glint-extract"], ["glint-ideal", "--sensors", self.write_suite(suite)])
        frames = [dict(empty, scene=f"s{n}", echoes=echoes) for n, echoes in enumerate(echo_lists)]
        return [one.get("cells", []) for one in self.through(frames, ["glint-sensor"])]

    def check(self, good, message):
        self.group_checks += 1
        if not good:
            self.group_failures += 1
            if self.group_failures <= 10:
                print(f"  FAIL: {message}")
        return good

    def check_printed(self, value, printed, what):
        """A value agrees with a figure as printed, to the figure's last digit."""
        digits = len(printed.partition(".")[2])
        good = abs(value - float(printed)) <= 0.5000001 * 10.0 ** -digits
        self.check(good, f"{what}: {value:.9g}, MODEL prints {printed}")

    def end_group(self, title, note=""):
        verdict = f"{self.group_failures} FAILED of " if self.group_failures else "ok, "
        print(f"{title}: {verdict}{self.group_checks} checks{note}", flush=True)
        self.failures += self.group_failures
        self.group_failures = self.group_checks = 0


def run(doc, prepare, checks):
    """Runs a table of (sentence, check): each check on one bench, and exit status 1 if any sentence is
    false."""
    if len(sys.argv) != 2:
        sys.exit(doc)
    with tempfile.TemporaryDirectory(prefix="glint-") as scratch:
        bench = Bench(sys.argv[1], scratch)
        prepare(bench)
        for sentence, prove in checks:
            prove(bench)
            bench.end_group(sentence)
    sys.exit(bench.failures > 0)


def add_shipped_vehicles(bench):
    for name in list(bench.vehicles):
        bench.add_vehicle(name, bench.vehicles[name])


def full_sensor(**changes):
    """The shipped radar of all effects."""
    one = json.loads((ROOT / "data/sensors/lrr77-full.json").read_text())["sensors"][0]
    return dict(one, antenna_table=str(ROOT / "data/antennas/lrr77.csv"), **changes)


def stripped(frames):
    """Frames without the choice of effects, and without the digest of their suite."""
    for one in frames:
        one["sensors"].pop("effects")
        one["sensors"].pop("digest")
    return frames


# ---- documents and frames ----------------------------------------------------------------------


def sensor(name="radar", **changes):
    document = {"name": name, "mount_x_m": 0, "mount_y_m": 0, "mount_yaw_rad": 0, "carrier_hz": 24.125e9,
                "range_min_m": 0.2, "range_max_m": 30, "field_of_view_rad": math.pi, "threshold_db": 6,
                "calibration_ercs": 0.8, "calibration_range_m": 30, "exponent": 2, "range_floor_m": 0.5,
                "cell_range_m": 0.3, "cell_range_rate_mps": 0.5, "cell_extent": "width",
                "antenna_pattern": "dipole_pair", "phase_reference": "element", "angle_estimator": "magnitude",
                "pointer_sigma": 0.5, "range_sigma_m": 0.02, "range_rate_sigma_mps": 0.05,
                "azimuth_sigma_rad": 0.04, "final_threshold": True, "first_threshold": "full", "list_order": "strongest", "list_limit": 0}
    document.update(changes)
    return document


def suite_of(*sensors):
    return {"origin": "Made by tests/oracle/model.py.", "sensors": list(sensors)}


def thing(name, kind, x, y, yaw=0.0, velocity=(0.0, 0.0), turn=0.0, length=0.0, width=0.0):
    return {"id": name, "class": kind, "x_m": x, "y_m": y, "yaw_rad": yaw, "vx_mps": velocity[0],
            "vy_mps": velocity[1], "yaw_rate_radps": turn, "length_m": length, "width_m": width, "height_m": 0,
            "travelled_m": 0}


def ego(x=0.0, y=0.0, **rest):
    return thing("ego", "car", x, y, **rest)


def frame(objects, scene="scene"):
    return {"version": 1, "scene": scene, "frame": 0, "time_s": 0.5, "interval_s": 0.1, "last": True, "seed": "1",
            "ego": "ego", "objects": objects}


def ahead(speed, yaw):
    return (speed * math.cos(yaw), speed * math.sin(yaw))


def polar(distance, degrees):
    return distance * math.cos(math.radians(degrees)), distance * math.sin(math.radians(degrees))


def echo(name, distance, azimuth, rate, ercs):
    return {"sensor": "radar", "object": "o", "reflector": name, "path": "direct", "range_m": distance,
            "azimuth_rad": azimuth, "range_rate_mps": rate, "ercs": ercs, "time_s": 0.5}


def everywhere(name, ercs=0.5, **rest):
    return dict({"name": name, "x": 0, "y": 0, "facing_rad": 0, "full_rad": math.pi, "zero_rad": math.pi,
                 "shape": "hard", "ercs": ercs}, **rest)


def vehicle(length, width, **reflectors):
    return {"origin": "Made by tests/oracle/model.py.", "length_m": length, "width_m": width, "height_m": 1,
            "reflectors": reflectors}


SIDES = [("front", 0.5, -0.5, 0.5, 0.5), ("left", 0.5, 0.5, -0.5, 0.5), ("rear", -0.5, 0.5, -0.5, -0.5),
         ("right", -0.5, -0.5, 0.5, -0.5)]
CORNERS = [("fl", 0.5, 0.5), ("fr", 0.5, -0.5), ("rl", -0.5, 0.5), ("rr", -0.5, -0.5)]


def plane(name, from_x, from_y, to_x, to_y, **rest):
    return dict({"name": name, "from_x": from_x, "from_y": from_y, "to_x": to_x, "to_y": to_y, "ercs": 0.8}, **rest)


def add_vehicles(bench):
    bench.add_vehicle("spot", vehicle(0.5, 0.5, points=[everywhere("p")]))
    bench.add_vehicle("plate", vehicle(0.5, 4.5, planes=[plane("p", 0, 0.5, 0, -0.5)]))
    shapes = ["raised_cosine", "hard", "linear", "cosine"]
    points = [{"name": f"{shape}_{tag}", "x": x, "y": y, "facing_rad": facing, "full_rad": 0.5, "zero_rad": zero,
               "shape": shape, "ercs": 0.4, "inset_m": inset}
              for shape in shapes
              for tag, x, y, facing, zero, inset in (("a", 0.5, 0.1, 0.2, 1.2, 0.0), ("b", -0.3, 0.5, 2.0, 1.9, 0.15),
                                                     ("c", -0.5, -0.4, -3.0, 2.5, 0.3))]
    rows = [dict(plane("slant", -0.5, -0.5, 0.4, 0.3), spacing_m=0.7, facing_rad=1.0, full_rad=0.6, zero_rad=2.0,
                 shape="linear", ercs=0.3),
            dict(plane("back", 0.5, 0.2, -0.5, 0.2), spacing_m=1.1, facing_rad=-1.5, full_rad=0.3, zero_rad=1.4, ercs=0.2)]
    planes = [plane(*side, margin_m=0.2) for side in SIDES]
    bench.add_vehicle("shapes", vehicle(5, 2.5, points=points, rows=rows, planes=planes))
    wheels = [everywhere(f"wheel_{n}", x=x, y=y, under_vehicles=part)
              for n, (_, x, y) in enumerate(CORNERS) for part in ((0.5, 0.25, 1, 0)[n],)]
    bench.add_vehicle("runner", vehicle(6, 2, blocks=True, raised=True, points=wheels))
    corners = [everywhere(name, x=x, y=y) for name, x, y in CORNERS]
    planes = [plane(*side) for side in SIDES]
    bench.add_vehicle("brick", vehicle(4, 2, blocks=True, points=corners, planes=planes))
    narrow = [plane(*side, margin_m=0.5) for side in SIDES]
    bench.add_vehicle("raised_brick", vehicle(4, 4, blocks=True, raised=True, points=corners, planes=narrow))
    gates = [everywhere(f"{shape}_{tag}", full_rad=full, zero_rad=math.pi / 2, shape=shape, facing_rad=facing)
             for shape in shapes for tag, full, facing in (("falls", 0.5, math.pi / 2), ("steep", math.pi / 2, -math.pi / 2))]
    bench.add_vehicle("gate", vehicle(1, 1, points=gates))
    bench.add_vehicle("omni", vehicle(1, 1, points=[everywhere(shape, shape=shape) for shape in shapes[:3]]))
    bench.add_vehicle("low_spot", vehicle(1, 1, points=[everywhere("p", under_vehicles=0.5)]))


# ---- (a) the figures that MODEL prints ---------------------------------------------------------

PATTERN = """0 1 0
5 .9838 .1355
10 .9367 .2620
20 .7690 .4581
30 .5513 .5513
35 .4425 .5587
40 .3418 .5439
50 .1791 .4652
60 .0751 .3515
70 .0218 .2296
80 .0027 .1122"""

DETECTION = """0.2 15.00 13.15 9.98 6.35 4.11
0.3 18.37 16.11 12.22 7.77 5.03
0.4 21.21 18.60 14.11 8.98 5.81
0.5 23.72 20.80 15.78 10.04 6.50
0.6 25.98 22.78 17.28 11.00 7.12
0.7 28.06 24.61 18.67 11.88 7.69
0.8 30.00 26.31 19.96 12.70 8.22"""


def check_pattern(bench):
    rows = [line.split() for line in PATTERN.splitlines()]
    for reference in ("element", "centre"):
        suite = suite_of(sensor(phase_reference=reference, threshold_db=-100, calibration_ercs=0.8e-5))
        for sign in (1, -1):
            lists = [[echo("p", 10, sign * math.radians(float(r[0])), 0, 0.5)] for r in rows]
            for row, cells in zip(rows, bench.cells_of(lists, suite)):
                if not bench.check(len(cells) == 1, f"7.1 at {row[0]} deg: {len(cells)} cells"):
                    continue
                cell = cells[0]
                gain = oracle.reference_amplitude(suite["sensors"][0], 10) * 0.5
                total, delta = complex(cell["sum_re"], cell["sum_im"]), complex(cell["delta_re"], cell["delta_im"])
                bench.check_printed(abs(total) / gain, row[1], f"7.1 |H_S| at {row[0]} deg, {reference}")
                bench.check_printed(abs(delta) / gain, row[2], f"7.1 |H_D| at {row[0]} deg, {reference}")
                bench.check(abs(cell["azimuth_rad"] - sign * math.radians(float(row[0]))) < 1e-12,
                            f"7.2 round trip at {sign}*{row[0]} deg gives {math.degrees(cell['azimuth_rad'])}")
                for degrees, printed in ((10, "-0.279738"), (-40, "1.591105")):
                    if sign * float(row[0]) == degrees:
                        bench.check_printed((delta / total).imag, printed, f"13 H_D/H_S at {degrees} deg, {reference}")
    bench.end_group("MODEL 7.1, 7.2, 13: pointers and their inverse")


def check_detection(bench):
    suite, angles = suite_of(sensor()), (0, 20, 35, 50, 60)
    cases = [(float(line.split()[0]), angle, float(printed))
             for line in DETECTION.splitlines() for angle, printed in zip(angles, line.split()[1:])]
    lists = [[echo("p", distance + step, math.radians(angle), 0, ercs)]
             for ercs, angle, distance in cases for step in (-0.00501, 0.00501)]
    for n, cells in enumerate(bench.cells_of(lists, suite)):
        ercs, angle, distance = cases[n // 2]
        bench.check(len(cells) == (n + 1) % 2,
                    f"4.1 ERCS {ercs} at {angle} deg, {distance} m {'+' if n % 2 else '-'} 5 mm: {len(cells)} targets")
    [cells] = bench.cells_of([[echo("p", 30, 0, 0, 0.8)]], suite)
    bench.check(len(cells) == 1, f"4.1 ERCS 0.8 at exactly 30 m on boresight: {len(cells)} targets, must be detected")
    [[cell]] = bench.cells_of([[echo("p", 10, math.radians(20), 0, 0.5)]], suite)
    bench.check_printed(cell["amplitude"], "8.63", "13 A_n(10 m, 20 deg, 0.5)")
    bench.end_group("MODEL 4.1, 13: detection ranges and amplitude")


def check_clusters(bench):
    rows = [(10.00, -2.0, 10), (10.10, -2.1, 5), (10.40, -2.0, 4), (10.12, -1.5, 3)]
    reference = oracle.reference_amplitude
    for order in itertools.permutations(range(4)):
        names = [f"r{1 + order[n]}" for n in range(4)]
        ordered = sorted(zip(names, (rows[k] for k in order)))
        lists = [[echo(name, d, 0, v, a / reference(sensor(), d)) for name, (d, v, a) in ordered]]
        [cells] = bench.cells_of(lists, suite_of(sensor()))
        found = sorted([sorted(m["reflector"] for m in c["members"]) for c in cells])
        bench.check(found == [["r1", "r2"], ["r3"], ["r4"]], f"13 clustering: {found}")
    first = next(c for c in cells if c["members"][0]["reflector"] == "r1")
    for key, printed in (("amplitude", "15.000"), ("range_m", "10.0333"), ("range_rate_mps", "-2.0333")):
        bench.check_printed(first[key], printed, f"13 clustering {key}")
    lists = [[echo("a", 20, 0, 0, 0.2), echo("b", 20.1, 0, 0, 0.2)], [echo("a", 20, 0, 0, 0.2)]]
    pair, single = bench.cells_of(lists, suite_of(sensor()))
    bench.check(len(pair) == 1 and not single, "6: two echoes below the threshold must add up over it, one must not")
    check_cell_edges(bench)
    check_ties(bench)
    bench.end_group("MODEL 6, 13: clustering, closed cell edges, ties")


def check_cell_edges(bench):
    """Half widths are 0.25 m and 0.5 m/s here, and the edge belongs to the cell: pairs stand half a width
    apart, and twice that with half_width."""
    tiny = 2.0 ** -40
    places = [(0.25, 0, 1), (0.25 + tiny, 0, 2), (-0.25, 0, 1), (-0.25 - tiny, 0, 2), (0, 0.5, 1), (0, 0.5 + tiny, 2),
              (0, -0.5, 1), (0, -0.5 - tiny, 2), (0.25, -0.5, 1)]
    for extent, factor in (("width", 1), ("half_width", 2)):
        suite = suite_of(sensor(cell_range_m=0.5, cell_range_rate_mps=1, cell_extent=extent))
        lists = [[echo("a", 8, 0, -3, 1), echo("b", 8 + factor * d, 0, -3 + factor * v, 0.5)] for d, v, _ in places]
        for (d, v, count), cells in zip(places, bench.cells_of(lists, suite)):
            bench.check(len(cells) == count, f"6 {extent}, second echo at {factor * d} m, {factor * v} m/s: {len(cells)} cells")


def check_ties(bench):
    """Equal amplitudes, as both are nearer than the range floor: the first of each pair must lead."""
    suite = suite_of(sensor())
    base = ("o", "r", 0.375, 0.125, 1.0)
    pairs = [("range", ("o", "z", 0.25, 0.125, 1.125), base), ("rate", ("o", "z", 0.375, 0.125, 0.875), base),
             ("azimuth", ("o", "z", 0.375, -0.125, 1.0), base), ("object", base, ("p", "a", 0.375, 0.125, 1.0)),
             ("reflector", base, ("o", "s", 0.375, 0.125, 1.0))]
    for rule, first, second in pairs:
        echoes = [dict(echo(r, d, phi, v, 0.5), object=o) for o, r, d, phi, v in sorted([first, second])]
        [cells] = bench.cells_of([echoes], suite)
        leaders = [(c["members"][0]["object"], c["members"][0]["reflector"]) for c in cells]
        bench.check(leaders == [first[:2]], f"6 tie decided by {rule}: leaders {leaders}, expected {first[:2]}")


def car_scenes():
    """(title, car, printed figures per target: reflectors, range, rate, degrees, dB; complete?)."""
    yaw = math.radians(135)
    crossing = [thing("car", "car", 8.9, y, math.pi / 2, ahead(5, math.pi / 2)) for y in (-1.5, 0, 1.5, 4)]
    return [
        ("oncoming, front 10 m", thing("car", "car", 12.25, 0, math.pi, (-10, 0)),
         [({"front", "corner_fl", "corner_fr"}, "10.018", "-9.98", "0.33", "29.0")]),
        ("lead car, rear 20 m", thing("car", "car", 22.25, 0, 0, (-3, 0)),
         [({"rear", "corner_rl", "corner_rr"}, "20.010", "-3.00", "0.09", "17.7")]),
        ("yawed 135 deg at (6,1)", thing("car", "car", 6, 1, yaw, ahead(5, yaw)),
         [({"corner_fl"}, "4.25", None, "27.4", "31.6"), ({"wheel_fl"}, "4.60", None, "16.6", None),
          ({"wheel_rl"}, "6.27", None, "-4.8", None)]),
        ("yawed 135 deg at (20,1)", thing("car", "car", 20, 1, yaw, ahead(5, yaw)),
         [({"corner_fl"}, "17.88", None, "6.3", "10.7")]),
        ("crossing, y = -1.5", crossing[0], [("left", "8.00", "-0.02", "-0.26", None)]),
        ("crossing, y = 0", crossing[1], [("left", "8.00", "0.00", "0.00", None)]),
        ("crossing, y = 1.5", crossing[2], [("left", "8.00", "0.04", "0.43", None)]),
        ("crossing, y = 4", crossing[3],
         [({"corner_rl"}, "8.19", None, "12.3", None), ({"wheel_rl"}, "8.46", None, None, None),
          ({"wheel_fl"}, "9.62", None, None, None)]),
    ]


def check_car_scenes(bench):
    scenes = car_scenes()
    answers = bench.chain([frame([ego(), car], scene=title) for title, car, _ in scenes], suite_of(sensor()))
    for (title, _, expected), answer in zip(scenes, answers):
        targets = sorted(answer["targets"], key=lambda t: -t["amplitude_db"])
        lists = [{c["reflector"] for c in t["contributors"]} for t in targets]
        for members, *printed in expected:
            if isinstance(members, str):
                chosen = targets[:1] if targets and members in lists[0] else []
                sides = {t["range_rate_mps"] > 0 for t in targets[1:]}
                bench.check(sides == {True, False}, f"{title}: others must come with both signs of v: {lists}")
            else:
                chosen = [t for t, names in zip(targets, lists) if names == members]
                bench.check(len(targets) == len(expected), f"{title}: {len(expected)} targets expected: {lists}")
            if not bench.check(len(chosen) == 1, f"{title}: no target of {members} where expected: {lists}"):
                continue
            t = chosen[0]
            values = (t["range_m"], t["range_rate_mps"], math.degrees(t["azimuth_rad"]), t["amplitude_db"])
            for what, value, text in zip(("d", "v", "phi", "dB"), values, printed):
                if text is not None:
                    bench.check_printed(value, text, f"{title}, {sorted(members)}, {what}")
    bench.end_group("MODEL 13: default-car scenes")


def check_visibility_edges(bench):
    """Seen along its x axis, every point of a gate is exactly zero_rad off its facing: V = 0 there, unless
    full_rad reaches as far, whose branch comes first in MODEL 2.2. A hard edge belongs to the visible range;
    a cosine has no flat part. A point that is full up to pi is seen from everywhere, also from exactly
    behind."""
    suite = suite_of(sensor(mount_yaw_rad=math.pi))
    [answer] = bench.chain([frame([ego(), thing("gate", "gate", -8, 0)])], suite)
    found = {e["reflector"]: e["ercs"] for e in answer["echoes"]}
    for shape, tag in itertools.product(("raised_cosine", "hard", "linear", "cosine"), ("falls", "steep")):
        ercs = 0.5 if shape == "hard" or tag == "steep" and shape != "cosine" else None
        what = f"2.2 {shape} at |delta| = zero_rad, full_rad {'= zero_rad' if tag == 'steep' else '< zero_rad'}"
        bench.check(found.get(f"{shape}_{tag}") == ercs, f"{what}: ercs {found.get(f'{shape}_{tag}')}, expected {ercs}")
    [answer] = bench.chain([frame([ego(), thing("omni", "omni", 8, 0)])], suite_of(sensor()))
    found = {e["reflector"] for e in answer["echoes"]}
    for shape in ("raised_cosine", "hard", "linear"):
        bench.check(shape in found, f"2.2 {shape} with full_rad = zero_rad = pi, seen from exactly behind: no echo")
    bench.end_group("MODEL 2.2: edges of visibility")


def check_planes(bench):
    for place, yaw, expected in (((0, 0), 0, 8.0), ((0, 3), 0, None), ((9, 0), math.pi, None), ((0, 2.25), 0, 8.0)):
        suite = suite_of(sensor(mount_x_m=place[0], mount_y_m=place[1], mount_yaw_rad=yaw))
        [answer] = bench.chain([frame([ego(), thing("plate", "plate", 8, 0)])], suite)
        found = [(e["range_m"], e["azimuth_rad"]) for e in answer["echoes"]]
        bench.check(found == ([] if expected is None else [(expected, 0.0)]), f"13 foot from {place}: {found}")
    steps = [n / 16 for n in range(-16 * 6, 16 * 6 + 1)] + [edge + d for edge in (-2.25, 2.25) for d in (-1e-13, 1e-13)]
    for distance in (0.25, 3.0, 20.0):
        frames = [frame([ego(), thing("car", "car", -x, distance + 0.9)], scene=f"{x}") for x in steps]
        suite = suite_of(sensor(mount_yaw_rad=math.pi / 2))
        for x, answer in zip(steps, bench.chain(frames, suite)):
            names = {e["reflector"] for e in answer["echoes"]}
            beside = abs(x) <= 2.25
            bench.check(bool(names & {"right", "corner_fr", "corner_rr"}), f"2.3 gap at x = {x}, {distance} m: {names}")
            bench.check(("right" in names) == beside, f"2.3 plane at x = {x}, {distance} m: {names}")
            corner = "corner_fr" if x > 0 else "corner_rr"
            bench.check(beside or corner in names, f"2.3 corner must take over at x = {x}, {distance} m: {names}")
    bench.end_group("MODEL 2.3, 13: plane feet and hand-over to the corners")


# ---- (b) two reflectors in one cell -------------------------------------------------------------


def check_merge(bench):
    bench.add_vehicle("spot_2", vehicle(0.5, 0.5, points=[everywhere("p", 1.0)]))
    bench.add_vehicle("spot_5", vehicle(0.5, 0.5, points=[everywhere("p", 2.5)]))
    pairs = [(-a, a, "spot", "element", text) for a, text in
             ((4, "0.44"), (6, "1.00"), (8, "1.80"), (10, "2.85"), (12, "4.17"), (15, "6.70"), (20, "12.5"),
              (25, "20.5"), (30, "30.0"))]
    pairs += [(-a, a, "spot", "centre", "0.0000") for a in (4, 6, 8, 10, 12, 15, 20, 25, 30)]
    for kind, literal, centred in (("spot_2", "3.23", "2.70"), ("spot_5", "5.60", "5.37")):
        pairs += [(-8, 8, kind, "element", literal), (-8, 8, kind, "centre", centred)]
    pairs += [(-5, 15, "spot", "element", "5.40"), (-5, 15, "spot", "centre", "4.64")]
    for left_of, right_of, kind, reference, printed in pairs:
        objects = [ego(), thing("a", "spot", *polar(10, left_of)), thing("b", kind, *polar(10, right_of))]
        [answer] = bench.chain([frame(objects)], suite_of(sensor(phase_reference=reference)))
        what = f"8.1 {left_of}/{right_of} deg, {kind}, {reference}"
        if not bench.check(len(answer["targets"]) == 1, f"{what}: {len(answer['targets'])} targets"):
            continue
        target = answer["targets"][0]
        bench.check({c["object"] for c in target["contributors"]} == {"a", "b"}, f"{what}: not labelled with both")
        bench.check_printed(math.degrees(target["azimuth_rad"]), printed, f"{what}, phi_cell")
        undecided = kind == "spot" and reference == "element" and left_of == -right_of
        if undecided:
            bench.check(target.get("sign_undecided") is True, f"{what}: a real ratio must be flagged undecided")
    bench.end_group("MODEL 8.1: two vehicles, one target")


def check_undecided(bench):
    """An azimuth with |Im(H_D conj H_S)| <= 2^-47 |H_D| |H_S| is reported positive and flagged."""
    suite, angle = suite_of(sensor()), math.radians(30)  # there |H_D| = |H_S|, and rounding is far below the bound
    lists = [[echo("p", 10, -angle, 0, 0.5), echo("q", 10, angle + step, 0, 0.5)] for step in (1e-6, -1e-6)]
    wide = bench.cells_of(lists, suite)
    slope = abs(oracle.estimate(*(complex(wide[0][0][f"{h}_re"], wide[0][0][f"{h}_im"]) for h in ("sum", "delta")),
                                "magnitude")[2]) / 1e-6
    cases = [(sine / slope * sign, sine < 2.0 ** -47, sign) for sine in (2e-15, 3e-14) for sign in (1, -1)]
    lists = [[echo("p", 10, -angle, 0, 0.5), echo("q", 10, angle + step, 0, 0.5)] for step, _, _ in cases]
    for (step, undecided, _), [cell], [decided] in zip(cases, bench.cells_of(lists, suite), wide * 2):
        what = f"30 deg pair, {step:.2g} rad apart"
        flag, azimuth = cell.get("sign_undecided", False), cell["azimuth_rad"]
        bench.check(flag == undecided, f"{what}: sign_undecided {flag}")
        sign = 1.0 if undecided else math.copysign(1, decided["azimuth_rad"])
        bench.check(math.copysign(1, azimuth) == sign, f"{what}: azimuth {azimuth}, sign should be {sign}")
    for reference in ("element", "centre"):
        [[cell]] = bench.cells_of([[echo("p", 10, 0.0, 0, 0.5)]], suite_of(sensor(phase_reference=reference)))
        flag, azimuth = cell.get("sign_undecided", False), cell["azimuth_rad"]
        bench.check(math.copysign(1, azimuth) == 1 and azimuth == 0, f"boresight, {reference}: azimuth {azimuth}")
        bench.check(flag, f"boresight, {reference}: H_D = {cell['delta_re']} + {cell['delta_im']}j exactly, 0 <= 0 holds, "
                          f"but sign_undecided is {flag}")
    bench.end_group("MODEL 7.4: undecided signs")


# ---- (c) random scenes against the oracle --------------------------------------------------------


def random_sensor(draw, n):
    fov = draw.choice([math.pi, math.pi, 2.0, 1.2])
    changes = {"mount_x_m": draw.uniform(-2.5, 2.5), "mount_y_m": draw.uniform(-1, 1),
               "mount_yaw_rad": draw.choice([0, draw.uniform(-math.pi, math.pi)]), "field_of_view_rad": fov,
               "range_min_m": draw.choice([0.01, 0.2, 2]), "range_max_m": draw.choice([30, 60, 15]),
               "threshold_db": draw.choice([6, 6, 10, 0]), "calibration_ercs": draw.choice([0.8, 0.8, 0.1]),
               "calibration_range_m": draw.choice([30, 39]), "exponent": draw.choice([2, 2, 1.5]),
               "cell_range_m": draw.choice([0.3, 0.3, 2, 6]), "cell_range_rate_mps": draw.choice([0.5, 0.5, 4, 10]),
               "cell_extent": draw.choice(["width", "width", "half_width"]),
               "phase_reference": draw.choice(["centre", "element"]),
               "angle_estimator": draw.choice(["magnitude", "magnitude", "ratio"]),
               "first_threshold": draw.choice(["full", "lowered"])}
    document = sensor(f"s{n}", **changes)
    if draw.random() < 0.3:
        document.pop("cell_extent")
    return document


def random_objects(draw, kinds):
    yaw = draw.uniform(-7, 7)
    middle = (draw.uniform(-1000, 1000), draw.uniform(-1000, 1000))
    objects = [ego(*middle, yaw=yaw, velocity=(draw.uniform(-30, 30), draw.uniform(-30, 30)),
                   turn=draw.choice([0, draw.uniform(-1, 1)]))]
    ring = draw.choice([3, 8, 25, 40])
    for n in range(draw.randint(1, 12)):
        away, bearing = ring * math.sqrt(draw.uniform(0.01, 1)), draw.uniform(0, TAU)
        place = (middle[0] + away * math.cos(bearing), middle[1] + away * math.sin(bearing))
        heading = draw.uniform(-7, 7)
        motion = draw.choice([objects[0]["vx_mps"], 0]), draw.choice([objects[0]["vy_mps"], 0])
        if draw.random() < 0.6:
            motion = ahead(draw.uniform(-20, 20), heading + draw.uniform(-0.5, 0.5))
        kind = draw.choice(kinds)
        length = draw.choice([0, 0, draw.uniform(0.5, 12)])
        if kind == "guardrail":
            length = draw.choice([0, draw.uniform(10, 60)])
        objects.append(thing(f"o{n}", kind, *place, heading, motion, draw.choice([0, draw.uniform(-2, 2)]),
                             length, draw.choice([0, 0, draw.uniform(0.2, 4)])))
    return objects


def grid_objects(draw):
    """Objects on halves of metres and parallel, so that touching happens often and is exact."""
    half = lambda low, high: draw.randint(2 * low, 2 * high) / 2
    still = draw.random() < 0.5
    speed = lambda: 0.0 if still else half(-5, 5)
    objects = [ego(half(-3, 3), half(-3, 3), velocity=(speed(), speed()))]
    for n in range(draw.randint(2, 10)):
        kind = draw.choice(["brick", "raised_brick", "spot", "low_spot", "brick", "low_spot"])
        objects.append(thing(f"o{n}", kind, half(-2, 14), half(-7, 7), 0.0, (speed(), speed()), 0.0,
                             draw.choice([0, 2, 8]), draw.choice([0, 1, 2])))
    return objects


def near(a, b, relative=RELATIVE, absolute=0.0):
    return abs(a - b) <= max(relative * max(abs(a), abs(b)), absolute)


def same_members(cell, mine):
    return {(m["object"], m["reflector"]) for m in cell["members"]} == set(mine["members"])


def compare_echoes(bench, where, found, view, item):
    for key, e in found.items():
        mine = view.echoes[key]
        for name, absolute in (("range_m", 0), ("azimuth_rad", ABSOLUTE), ("range_rate_mps", ABSOLUTE), ("ercs", FAINT)):
            bench.check(near(e[name], mine[name], absolute=absolute),
                        f"{where} echo {key} {name}: {e[name]!r}, oracle {mine[name]!r}")
        bench.check(e["time_s"] == item["time_s"] and e["path"] == "direct", f"{where} echo {key}: time or path")


def compare_angle(bench, where, cell, mine):
    """Where rounding alone decides the sign (or the flag), only the magnitude is compared; the rule itself is
    tested by check_undecided."""
    size, a, b = mine["amplitude"], cell["azimuth_rad"], mine["azimuth_rad"]
    vague = 1e-16 < mine["sine"] < 1e-13 or abs(mine["delta"]) < 1e-12 * size
    good = near(abs(a), abs(b), absolute=ABSOLUTE) if vague else near(a, b, absolute=ABSOLUTE)
    bench.check(good, f"{where} azimuth {a!r}, oracle {b!r}")
    if not vague:
        flags = cell.get("sign_undecided", False), mine["sign_undecided"]
        bench.check(flags[0] == flags[1], f"{where} sign_undecided {flags[0]}, oracle {flags[1]}")


def compare_cell(bench, where, cell, mine):
    compare_angle(bench, where, cell, mine)
    size = mine["amplitude"]
    total, delta = complex(cell["sum_re"], cell["sum_im"]), complex(cell["delta_re"], cell["delta_im"])
    bench.check(abs(total - mine["sum"]) <= RELATIVE * size, f"{where} sum {total}, oracle {mine['sum']}")
    bench.check(abs(delta - mine["delta"]) <= RELATIVE * max(size, abs(mine["delta"])), f"{where} delta {delta}, oracle {mine['delta']}")
    bench.check(size * (1 + RELATIVE) >= abs(total), f"{where} upper amplitude below the pointer sum")
    for name, absolute in (("range_m", 0), ("range_rate_mps", ABSOLUTE), ("amplitude", 0)):
        bench.check(near(cell[name], mine[name], absolute=absolute), f"{where} {name} {cell[name]!r}, oracle {mine[name]!r}")
    bench.check(near(sum(m["weight"] for m in cell["members"]), 1.0), f"{where} weights do not add up to 1")
    for m in cell["members"]:
        weight = mine["members"][m["object"], m["reflector"]]
        bench.check(near(m["weight"], weight, absolute=FAINT), f"{where} weight {m['weight']!r}, oracle {weight!r}")


def compare_target(bench, where, target, cell):
    """glint-noise-none passes the values of the cell on unchanged."""
    level = 20 * math.log10(math.hypot(cell["sum_re"], cell["sum_im"]))
    bench.check(near(target["amplitude_db"], level, absolute=1e-9), f"{where} amplitude_db {target['amplitude_db']}")
    for name in ("range_m", "azimuth_rad", "range_rate_mps"):
        bench.check(target[name] == cell[name] == target["cell_" + name], f"{where} target {name}")
    flags = target.get("sign_undecided", False), cell.get("sign_undecided", False)
    bench.check(flags[0] == flags[1], f"{where} sign_undecided {flags}")
    bench.check(target["contributors"] == cell["members"], f"{where} target's label is not the cell's members")


def compare_account(bench, where, answer, name):
    ended = [(c["object"], c["reflector"]) for t in answer["targets"] if t["sensor"] == name for c in t["contributors"]]
    ended += [(e["object"], e["reflector"]) for g in answer.get("lost", []) if g["sensor"] == name for e in g["echoes"]]
    pairs = next(c["pairs"] for c in answer["counts"] if c["sensor"] == name)
    bench.check(len(ended) == len(set(ended)) == pairs, f"{where}: {pairs} pairs, {len(ended)} entries")


def compare_scene(bench, title, answer, item, views, exact):
    """Compares one scene; with exact no decision about echoes may be doubtful. False if the scene was skipped
    because of a doubtful decision."""
    for name, view in views.items():
        where = f"{title} {name}"
        found = {(e["object"], e["reflector"]): e for e in answer["echoes"] if e["sensor"] == name}
        compare_account(bench, where, answer, name)
        if found.keys() != view.echoes.keys():
            odd = found.keys() ^ view.echoes.keys()
            if not exact and odd <= view.doubtful_echoes:
                return False
            told = [("program only" if k in found else "oracle only", k) for k in sorted(odd)]
            bench.check(False, f"{where} echoes differ: {told}")
            continue
        compare_echoes(bench, where, found, view, item)
        cells = {(c["members"][0]["object"], c["members"][0]["reflector"]): c for c in answer["cells"] if c["sensor"] == name}
        expected = {c["leader"]: c for c in view.cells}
        alike = cells.keys() == expected.keys() and all(same_members(cells[k], expected[k]) for k in cells)
        if not alike and view.doubtful_cells:
            return False
        if not bench.check(alike, f"{where} cells differ: program {sorted(cells)}, oracle {sorted(expected)}"):
            continue
        targets = [t for t in answer["targets"] if t["sensor"] == name]
        steady = sum(not cell["below_threshold"] for cell in expected.values())
        bench.check(len(targets) == steady, f"{where}: {steady} of {len(cells)} cells at the threshold, {len(targets)} targets")
        for key, cell in cells.items():
            bench.check(cell.get("below_threshold", False) == expected[key]["below_threshold"], f"{where} cell {key} below the threshold")
            compare_cell(bench, f"{where} cell {key}", cell, expected[key])
        for target in targets:
            first = target["contributors"][0]
            compare_target(bench, f"{where} target", target, cells[first["object"], first["reflector"]])
    return True


def compare_batch(bench, title, suite, object_lists, tally, exact=False):
    items = [frame(objects, scene=f"{title}-{n}") for n, objects in enumerate(object_lists)]
    for item, answer in zip(items, bench.chain(items, suite, account=True)):
        views = oracle.look(item, bench.vehicles, suite)
        failed = bench.group_failures
        if not compare_scene(bench, item["scene"], answer, item, views, exact):
            tally["skipped"] += 1
        if failed == 0 < bench.group_failures:
            kept = Path(tempfile.gettempdir()) / "glint-model-failure.json"
            kept.write_text(json.dumps({"frame": item, "suite": suite}))
            print(f"  (first failing scene and suite: {kept})")
        tally["scenes"] += 1
        tally["echoes"] += len(answer["echoes"])
        tally["cells"] += len(answer["cells"])
        tally["merged"] += sum(len({m["object"] for m in c["members"]}) > 1 for c in answer["cells"])
        for group in answer.get("lost", []):
            tally[group["reason"]] = tally.get(group["reason"], 0) + len(group["echoes"])


def end_random(bench, title, tally):
    bench.check(tally["skipped"] <= 0.02 * tally["scenes"], f"{tally['skipped']} of {tally['scenes']} scenes skipped")
    bench.end_group(title, ", " + ", ".join(f"{name} {count}" for name, count in tally.items()))


def new_tally():
    return {"scenes": 0, "skipped": 0, "echoes": 0, "cells": 0, "merged": 0}


def check_random(bench):
    draw, tally = random.Random(2006), new_tally()
    kinds = sorted(set(bench.vehicles) - {"spot_2", "spot_5", "plate"})
    for batch in range(40):
        suite = suite_of(*(random_sensor(draw, n) for n in range(2)))
        compare_batch(bench, f"random-{batch}", suite, [random_objects(draw, kinds) for _ in range(20)], tally)
    end_random(bench, "random scenes against the oracle", tally)


def check_grid(bench):
    draw, tally = random.Random(13), new_tally()
    for batch in range(6):
        mounts = [(draw.randint(-2, 2) / 2, draw.randint(-2, 2) / 2) for _ in range(2)]
        suite = suite_of(*(sensor(f"s{n}", mount_x_m=x, mount_y_m=y, phase_reference=reference,
                                  range_min_m=draw.choice([0, 0, 0.5, 1.5]), range_max_m=draw.choice([6.5, 30, 30]),
                                  cell_range_m=n + 1, cell_range_rate_mps=2 - n)
                           for n, ((x, y), reference) in enumerate(zip(mounts, ("centre", "element")))))
        compare_batch(bench, f"grid-{batch}", suite, [grid_objects(draw) for _ in range(50)], tally, exact=True)
    end_random(bench, "scenes on a grid (touching is exact) against the oracle", tally)


def mirrored(item):
    turned = dict(item, scene="mirror of " + item["scene"])
    odd = ("y_m", "yaw_rad", "vy_mps", "yaw_rate_radps")
    turned["objects"] = [{k: -v if k in odd else v for k, v in o.items()} for o in item["objects"]]
    return turned


def check_mirror(bench):
    draw = random.Random(7)
    kinds = ["car", "van", "truck", "bus", "motorcycle", "bicycle", "pedestrian", "wall", "guardrail"]
    items = [frame(random_objects(draw, kinds), scene=f"m{n}") for n in range(60)]
    suite = suite_of(sensor(phase_reference="centre", mount_x_m=2))
    answers = [bench.chain(batch, suite) for batch in (items, [mirrored(item) for item in items])]
    for a, b in zip(*answers):
        keys = [sorted((t["range_m"], t["range_rate_mps"], sign * t["azimuth_rad"], t["amplitude_db"]) for t in x["targets"])
                for x, sign in ((a, 1), (b, -1))]
        good = len(keys[0]) == len(keys[1]) and all(near(p, q, absolute=ABSOLUTE)
                                                    for s, t in zip(*keys) for p, q in zip(s, t))
        bench.check(good, f"scene {a['scene']}: {keys[0]} and mirrored {keys[1]}")
    bench.end_group("mirror symmetry of the target list")


# ---- (d) the shipped two-vehicle pipeline ----------------------------------------------------------


def check_two_vehicles(bench):
    script = ROOT / "pipelines/two-vehicles.sh"
    quiet = bench.scratch / "two-vehicles-without-noise.sh"
    quiet.write_text(script.read_text().replace("| glint-noise", "| glint-noise-none"))
    texts = {}
    for name, words in (("piped", ["bash", str(script)]), ("fused", [str(bench.bin / "glint"), str(script)]),
                        ("piped without noise", ["bash", str(quiet)]),
                        ("fused without noise", [str(bench.bin / "glint"), str(quiet)])):
        done = subprocess.run(words, env=bench.env, stdout=subprocess.PIPE, text=True, check=False)
        bench.check(done.returncode == 0, f"{name}: exit status {done.returncode}")
        texts[name] = done.stdout
        check_middle(bench, name, parsed(done.stdout), "centre")
    bench.check(texts["piped"] == texts["fused"], "piped and fused differ")
    bench.check(texts["piped without noise"] == texts["fused without noise"], "piped and fused differ without noise")
    suite = json.loads((ROOT / "data/sensors/srr24-pair.json").read_text())
    for radar in suite["sensors"]:
        radar["phase_reference"] = "element"
    check_middle(bench, "element", bench.chain(bench.played("glint-traffic", "two-vehicles"), suite), "element")
    bench.end_group("pipelines/two-vehicles: one target in the middle, under both phase references")


def azimuth_of_all(contributors, reference):
    """MODEL 8.1: the pointers of all contributors, added in phase, and the angle of 7.2 and 7.4."""
    both = [0, 0]
    for one in contributors:
        u = math.pi / 2 * math.sin(one["azimuth_rad"])
        turn = complex(math.cos(u), math.sin(u)) if reference == "element" else 1
        both[0] += one["weight"] * turn
        both[1] += one["weight"] * turn * -1j * math.tan(u)
    size = math.asin(2 / math.pi * math.atan(abs(both[1]) / abs(both[0])))
    return math.copysign(size, -(both[1] * both[0].conjugate()).imag)


def check_middle(bench, name, frames, reference):
    aside = {"centre": 0.575, "element": 0.36}[reference]
    bench.check(len(frames) == 101, f"{name}: {len(frames)} frames")
    for item in frames:
        for radar in ("left", "right"):
            where = f"{name} at {item['time_s']} s, {radar}"
            targets = [t for t in item["targets"] if t["sensor"] == radar]
            if not bench.check(len(targets) == 1, f"{where}: {len(targets)} targets"):
                continue
            owners = {c["object"] for c in targets[0]["contributors"]}
            bench.check(owners == {"left", "right"}, f"{where}: labelled with {owners}")
            lateral = targets[0]["cell_range_m"] * math.sin(targets[0]["cell_azimuth_rad"]) + (0.6 if radar == "left" else -0.6)
            bench.check(abs(abs(lateral) - aside) < 0.01, f"{where}: target at y = {lateral}, not {aside} from the middle")
            summed = azimuth_of_all(targets[0]["contributors"], reference)
            bench.check(near(targets[0]["cell_azimuth_rad"], summed), f"{where}: azimuth of the sum {summed}")


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    with tempfile.TemporaryDirectory(prefix="glint-model-") as scratch:
        bench = Bench(sys.argv[1], scratch)
        add_vehicles(bench)
        for check in (check_pattern, check_detection, check_clusters, check_car_scenes, check_visibility_edges,
                      check_planes, check_merge, check_undecided, check_random, check_grid, check_mirror, check_two_vehicles):
            check(bench)
    if bench.failures:
        raise SystemExit(f"{bench.failures} checks failed")


if __name__ == "__main__":
    main()
