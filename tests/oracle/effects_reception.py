"""The effects of reception, through the executables, against closed forms and published values.

Usage: python3 tests/oracle/effects_reception.py BIN_DIR

Fluctuation, levels, rain and fog, ambiguity, interference and coherence. Exit status 1 if any check fails. Statistics
use fixed seeds and are held to five standard errors.
"""

import json
import math
import sys

sys.dont_write_bytecode = True
import model  # noqa: E402
from effects_noise import QUIET, THRESHOLD, check_even, check_share, frames_of, targets_of  # noqa: E402
from model import ego, sensor, suite_of, thing  # noqa: E402
from sizes import quick  # noqa: E402

FRAMES = quick(5000, 12000)
C_MPS = 299792458


def radar(name, **changes):
    """A radar without noise, to which a spot 40 m ahead is 4 times as strong as the threshold."""
    return sensor(name, **{**QUIET, "range_max_m": 300, "calibration_ercs": 0.5, "calibration_range_m": 80,
                           "phase_reference": "centre", "angle_estimator": "ratio", **changes})


def spot(name, x, y=0.0, **rest):
    return thing(name, "spot", x, y, **rest)


def run(bench, text, frames=()):
    return model.parsed(bench.fused(text, frames))


def receive(bench, frames, sensors, effects="all", source=""):
    """The output of the whole chain, with its cells and its account."""
    path = bench.write_suite(suite_of(*sensors))
    return run(bench, f"{source}glint-extract | glint-ideal --sensors {path} --sections account,cells --effects {effects}"
                      " | glint-sensor | glint-noise", frames)


def cells_by_leader(frame):
    return {(one["sensor"], one["members"][0]["object"]): one for one in frame["cells"]}


def check_switch(bench, frames, sensors, effect):
    """auto and all give the same bytes; switched off, the effect is gone; labels name it exactly where it
    changed a value."""
    everything = receive(bench, frames, sensors)
    auto = receive(bench, frames, sensors, "auto")
    without = receive(bench, frames, sensors, f"all,-{effect}")
    for one in everything + auto:
        one["sensors"].pop("effects")
    bench.check(auto == everything, f"{effect}: auto and all differ")
    labelled = 0
    for one, other in zip(everything, without):
        bench.check(not any(effect in cell.get("effects", []) for cell in other["cells"]), f"{effect} is not off")
        plain = cells_by_leader(other)
        for key, cell in cells_by_leader(one).items():
            marked = effect in cell.pop("effects", [])
            labelled += marked
            plain.get(key, {}).pop("effects", None)
            bench.check(key not in plain or marked == (cell != plain[key]), f"{effect}: label of {key} is {marked}")
        for target in one["targets"]:
            whose = (target["sensor"], target["contributors"][0]["object"])
            bench.check(effect not in target.get("effects", []) or whose in cells_by_leader(one), f"label of {whose}")
    bench.check(labelled > 0, f"{effect}: nothing has the label")
    return everything, without


def amplitudes_db(frames, name):
    return [one["amplitude_db"] for one in targets_of(frames, name)]


# ---- weather ----------------------------------------------------------------------------------

RADARS = [radar("v77", carrier_hz=76.5e9), radar("v24", carrier_hz=24.125e9),
          radar("h77", carrier_hz=76.5e9, polarization="horizontal")]
# MODEL 14.15, there and back: sensor, weather, range, decibels.
WEATHER = [("v77", {"rain_mmph": 25}, 100, 2.190804), ("v24", {"rain_mmph": 25}, 100, 0.614704),
           ("v77", {"rain_mmph": 50}, 250, 8.948216), ("v77", {"fog_gpm3": 0.5}, 100, 0.311546),
           ("h77", {"rain_mmph": 25}, 100, 0.2 * 1.125295 * 25 ** 0.718767),
           ("v77", {"rain_mmph": 25, "fog_gpm3": 0.5}, 100, 2.190804 + 0.311546),
           ("v24", {"snow_mmph": 10}, 250, 0.038146), ("v77", {"snow_mmph": 10}, 100, 1.189630)]


def weather(bench):
    """Weather may come from the frame's conditions, from a scenario's and from options."""
    sensors = [dict(one, calibration_range_m=800) for one in RADARS]
    path = bench.scratch / "weather.json"
    for name, conditions, range_m, expected in WEATHER:
        frames = frames_of([spot("a", range_m)], 1)
        dry = amplitudes_db(receive(bench, frames, sensors), name)
        scene = {"origin": "A test.", "ego": "ego", "rate_hz": 10, "duration_s": 0,
                 "objects": [{"id": "ego", "class": "car"}, {"id": "a", "class": "spot", "x_m": range_m}]}
        path.write_text(json.dumps(scene))
        words = f"--conditions '{json.dumps(conditions)}'"
        wet = {"options": receive(bench, [], sensors, source=f"glint-traffic {path} {words} | ")}
        path.write_text(json.dumps({**scene, "conditions": conditions}))
        wet["scenario"] = receive(bench, [], sensors, source=f"glint-traffic {path} | ")
        wet["frame"] = receive(bench, [dict(frames[0], conditions=conditions)], sensors)
        for where, out in wet.items():
            lost = dry[0] - amplitudes_db(out, name)[0]
            bench.check(abs(lost - expected) < 5e-6, f"{conditions} of the {where}, {name} at {range_m} m: {lost} dB")
            label = targets_of(out, name)[0]
            bench.check({key.split("_")[0] for key in conditions} <= set(label.get("effects", [])), f"{label}")
            bench.check(label["contributors"][0]["range_m"] == range_m, "the label is not exact")


def weather_loses(bench):
    """50 mm/h take 8.948216 dB of an echo that is 8.9 or 9 dB above the threshold at 250 m."""
    frames = [dict(one, conditions={"rain_mmph": 50, "fog_gpm3": 0.01}) for one in frames_of([spot("a", 250)], 3)]
    sensors = [radar(f"above{above}", carrier_hz=76.5e9, calibration_range_m=250 * 10 ** (above / 40))
               for above in (8.9, 9.0)]
    for effect in ("rain", "fog"):
        out, without = check_switch(bench, frames, sensors, effect)
        bench.check(len(targets_of(out, "above9.0")) == 3 and not targets_of(out, "above8.9"), f"{effect}: in the list")
        kept = effect == "rain"
        bench.check(len(targets_of(without, "above8.9")) == 3 * kept, f"{effect}: not off")
        lost = [one["shortfall_db"] for frame in out for group in frame["lost"]
                if group["reason"] == "below_threshold" for one in group["echoes"]]
        fog = 2 * 0.25 * 0.01 * 3.115457
        bench.check(len(lost) == 3 and all(abs(one - 0.048216 - fog) < 2e-6 for one in lost), f"shortfall {lost}")


# ---- fluctuation ------------------------------------------------------------------------------

LAWS = {"swerling_1": (-2.506816, 5.570043), "swerling_3": (-1.174171, 3.487723), "log_normal": (-1.338734, 3.41)}


def distribution(law, power):
    """Maps power to values that are even over (0, 1) if the power has this law; to 1 where the log-normal law
    is cut."""
    if law == "swerling_1":
        return 1 - math.exp(-power)
    if law == "swerling_3":
        return 1 - (1 + 2 * power) * math.exp(-2 * power)
    deviations = (10 * math.log10(power) + 1.338734) / 3.41
    return min((1 + math.erf(deviations / math.sqrt(2))) / (1 + math.erf(3 / math.sqrt(2))), 1)


def fluctuation(bench):
    """MODEL 14.14: mean and deviation in decibels; scans, objects and sensors vary on their own."""
    frames = frames_of([spot("a", 40), spot("b", 50)], FRAMES)
    sensors = [radar(law, fluctuation=law, calibration_range_m=8e5) for law in LAWS]
    sensors += [radar("same", fluctuation="swerling_1", calibration_range_m=8e5), radar("steady", calibration_range_m=8e5)]
    out = receive(bench, frames, sensors)

    def powers(name, place):
        return [10 ** (one["amplitude_db"] / 10) / (THRESHOLD * (8e5 / place) ** 2) ** 2 for one in targets_of(out, name)
                if one["contributors"][0]["range_m"] == place]

    bench.check(all(abs(one - 1) < 1e-9 for one in powers("steady", 40)), "a steady target varies")
    for law, (mean, deviation) in LAWS.items():
        drawn = powers(law, 40)
        decibels = [10 * math.log10(one) for one in drawn]
        found = sum(decibels) / FRAMES
        spread = math.sqrt(sum((one - found) ** 2 for one in decibels) / FRAMES)
        cut = 0.002 if law == "log_normal" else 0
        bench.check(len(drawn) == FRAMES, f"{law}: {len(drawn)} targets")
        bench.check(abs(found - mean) < 5 * deviation / math.sqrt(FRAMES) + cut, f"{law}: mean {found} dB")
        bench.check(abs(spread - deviation) < 5 * 1.1 * deviation / math.sqrt(FRAMES) + 5 * cut, f"{law}: {spread} dB")
        shares = [distribution(law, one) for one in drawn]
        if law == "log_normal":  # which is cut at three sigma
            shares = [one / 0.998650101 for one in shares if one < 0.99865]
        check_even(bench, shares, law)
        bench.check(all("fluctuation" in one["effects"] for one in targets_of(out, law)), f"{law}: not in the label")
    one = powers("swerling_1", 40)
    for other, what in ((powers("same", 40), "sensors"), (powers("swerling_1", 50), "objects"), (one[1:], "scans")):
        shared = sum((x - 1) * (y - 1) for x, y in zip(one, other)) / FRAMES
        bench.check(abs(shared) < 5 / math.sqrt(FRAMES), f"two {what} are correlated: {shared}")
    halves = receive(bench, frames[:99], sensors) + receive(bench, frames[99:200], sensors)
    bench.check(halves == out[:200], "shards joined are not the whole")
    few = "visibility,fluctuation,merging,superposition"
    bench.check([one["amplitude_db"] for frame in receive(bench, frames[:200], sensors, few)
                 for one in frame["targets"]] == [one["amplitude_db"] for frame in out[:200]
                                                  for one in frame["targets"]], "without other effects, other draws")
    check_switch(bench, frames[:200], sensors, "fluctuation")


def detection(bench):
    """MODEL 14.14: one look, false alarms of 1e-4; the final threshold is the only one."""
    published = {6: (0.092480, 0.157384, 0.140198), 10: (0.616136, 0.432876, 0.491042),
                 15: (0.999910, 0.754026, 0.876107)}
    ratio = -math.log(1e-4)
    laws = ["none", "swerling_1", "swerling_3"]
    expected = {f"{law}_{db}": chance for db, row in published.items() for law, chance in zip(laws, row)}
    sensors = [radar(f"{law}_{db}", fluctuation=law, calibration_range_m=10 * (10 ** (db / 10) / ratio) ** 0.25,
                     pointer_sigma=THRESHOLD / math.sqrt(ratio), final_threshold=True)
               for db in published for law in laws]
    frames = frames_of([spot("a", 10)], FRAMES)
    out = receive(bench, frames, sensors, "all,-threshold")
    for name, chance in expected.items():
        check_share(bench, len(targets_of(out, name)), FRAMES, chance, f"{name}: detected")


# ---- levels -----------------------------------------------------------------------------------


def levels(bench):
    """MODEL 14.22: mean and deviation over bodies; a body that stays in place keeps its level in every scan, and
    with all of its parts the level of a neighbouring place."""
    widths = {"constant": {"level_constant_db": 5}, "slow": {"level_slow_db": 4}, "fast": {"level_fast_db": 3},
              "all": {"level_constant_db": 5, "level_slow_db": 4, "level_fast_db": 3, "level_keeps": "median"}}
    sensors = [radar(name, calibration_range_m=8e5, **width) for name, width in widths.items()]
    things = [dict(spot(f"o{i}", 40), travelled_m=20 * i) for i in range(100)]
    frames = [dict(one, scene=f"s{i}", frame=0) for i, one in enumerate(frames_of(things, 200))]
    out = receive(bench, frames, sensors, "all,-merging")
    for name, width in widths.items():
        deviation = math.sqrt(sum(value * value for key, value in width.items() if key.endswith("_db")))
        decibels = [20 * math.log10(one["cell_amplitude"] / (THRESHOLD * (8e5 / 40) ** 2)) for one in targets_of(out, name)]
        count, mean = len(decibels), sum(decibels) / len(decibels)
        expected = 0 if name == "all" else -math.log(10) / 20 * deviation ** 2
        spread = math.sqrt(sum((one - mean) ** 2 for one in decibels) / count)
        bench.check(count == 20000, f"{name}: {count} targets")
        bench.check(abs(mean - expected) < 5 * deviation / math.sqrt(count), f"{name}: mean {mean} dB")
        bench.check(abs(spread / deviation - 1) < 5 / math.sqrt(2 * count), f"{name}: {spread} dB")
        bench.check(all("level" in one["effects"] for one in targets_of(out, name)), f"{name}: not in the label")
    still = frames_of([spot("a", 40), spot("b", 60)], 60)
    for name in widths:
        found = {(one["cell_range_m"], one["cell_amplitude"]) for one in targets_of(receive(bench, still, sensors), name)}
        bench.check(len(found) == 2, f"{name}: a standing body has {len(found) - 1} levels")
    walk = [dict(one, objects=[dict(thing, travelled_m=2 * i, x_m=thing["x_m"] + 0.04 * i) if thing["id"] == "a" else thing
                               for thing in one["objects"]]) for i, one in enumerate(still)]
    moved = receive(bench, walk, sensors)
    halves = receive(bench, walk[:20], sensors) + receive(bench, walk[20:], sensors)
    bench.check(halves == moved, "shards joined are not the whole")
    check_switch(bench, walk, sensors, "level")


# ---- ambiguity --------------------------------------------------------------------------------


def ambiguity(bench):
    """MODEL 14.16: alias(45; 24.5) = -4, alias(-60; 24.5) = -11; ranges are told apart up to 59.958492 m at
    2.5 MHz."""
    rates = {45: -4, -60: -11, 24: 24, -24.5: -24.5, 24.5: -24.5, 0: 0}
    things = [spot(f"v{rate}", 20 + i, velocity=(rate, 0)) for i, rate in enumerate(rates)]
    ranges = {10: 10, 59: 59, 100: 100 - 59.958492, 135: 135 - 2 * 59.958492}
    things += [spot(f"r{range_m}", range_m, velocity=(1, 0)) for range_m in ranges]
    sensors = [radar("rate", unambiguous_rate_mps=24.5), radar("range", unambiguous_range_m=59.9584916),
               radar("plain"), radar("both", unambiguous_rate_mps=24.5, unambiguous_range_m=59.9584916)]
    frames = frames_of(things, 2)
    out, without = check_switch(bench, frames, [dict(one, calibration_range_m=8e4) for one in sensors], "ambiguity")
    by_name = {(one["sensor"], one["contributors"][0]["object"]): one for one in out[0]["targets"]}
    off = {(one["sensor"], one["contributors"][0]["object"]): one for one in without[0]["targets"]}
    bench.check(len(by_name) == 4 * len(things) == len(off), f"{len(by_name)} targets")
    for (name, what), one in by_name.items():
        true, label = float(what[1:]), one["contributors"][0]
        folded_rate = rates[true] if what[0] == "v" and name in ("rate", "both") else label["range_rate_mps"]
        folded_range = ranges[true] if what[0] == "r" and name in ("range", "both") else label["range_m"]
        bench.check(abs(one["range_rate_mps"] - folded_rate) < 1e-12, f"{name}: {what} at {one['range_rate_mps']} m/s")
        bench.check(abs(one["range_m"] - folded_range) < 1e-6, f"{name}: {what} at {one['range_m']} m")
        bench.check(label["range_m" if what[0] == "r" else "range_rate_mps"] == true, "the label is not the true one")
        bench.check(one["amplitude_db"] == off[name, what]["amplitude_db"], "folding changes the amplitude")
        changed = one["range_m"] != label["range_m"] or one["range_rate_mps"] != label["range_rate_mps"]
        bench.check(changed == ("ambiguity" in one.get("effects", [])), f"{name}: label of {what}")
    bench.check(sum("ambiguity" in one.get("effects", []) for one in by_name.values()) == 10, "not ten folded")


def folded_together(bench):
    """Two things 60 m apart share a cell if ranges fold at 60 m."""
    frames = frames_of([spot("near", 40), spot("far", 100.05)], 1)
    out = receive(bench, frames, [radar("s", unambiguous_range_m=60)])
    target = out[0]["targets"][0]
    label = {one["object"]: one for one in target["contributors"]}
    bench.check(len(out[0]["targets"]) == 1 and set(label) == {"near", "far"}, f"{out[0]['targets']}")
    bench.check(label["far"]["range_m"] == 100.05 and {"ambiguity", "merging"} <= set(target["effects"]), "its label")
    bench.check(abs(target["range_m"] - 40 - 0.05 * label["far"]["weight"]) < 1e-9, f"at {target['range_m']} m")
    bench.check(abs(label["near"]["weight"] / label["far"]["weight"] - (100.05 / 40) ** 2) < 1e-9, "its weights")


# ---- interference -----------------------------------------------------------------------------

RECEIVER = {"carrier_hz": 76.5e9, "range_max_m": 199, "cell_range_m": 1, "receiver_bandwidth_hz": 1e7, "noise_figure_db": 12,
            "antenna_gain_dbi": 20, "chirp_slope_hzps": 7.5e12, "chirp_s": 2e-5}


def interferer(name="other", slope=-7.5e12, hits=1.0):
    return {"object": name, "eirp_dbm": 33, "slope_hzps": slope, "hit_share": hits}


def disturbed(objects, interferers, count=1):
    return [dict(one, conditions={"interferers": interferers}) for one in frames_of(objects, count)]


def floor_db(frame):
    return 10 * math.log10(1 + frame["cells"][0].get("interference", 0))


def floor(bench):
    """MODEL 14.17: 40.8748 dB in band, 29.1192 and 16.2088 dB with other slopes, half the power without an image
    band; ratios add."""
    objects = [spot("other", 50), spot("a", 40)]
    cases = [([interferer(slope=7.5e12)], 10 * math.log10(1 + 10 ** 4.08748)), ([interferer()], 29.1192),
             ([interferer(hits=0.05)], 16.2088), ([interferer(hits=0)], 0), ([interferer("gone")], 0),
             ([interferer("ego")], 0), ([interferer(), interferer()], 10 * math.log10(2 * 10 ** 2.91192 - 1)),
             ([interferer("gone"), interferer(hits=0.05)], 16.2088)]
    sensors = [radar("s", **RECEIVER, calibration_range_m=1e4)]
    deaf = [dict(sensors[0], receiver_bandwidth_hz=None)]
    deaf[0].pop("receiver_bandwidth_hz")
    for others, expected in cases:
        out = receive(bench, disturbed(objects, others), sensors)[0]
        bench.check(len(out["cells"]) == 2 and abs(floor_db(out) - expected) < 6e-5, f"{others}: {floor_db(out)} dB")
        marked = [("interference" in one.get("effects", [])) == (expected > 0) for one in out["cells"] + out["targets"]]
        bench.check(all(marked), f"{others}: label")
        bench.check(floor_db(receive(bench, disturbed(objects, others), deaf)[0]) == 0, "a deaf radar hears")
    for sampling, expected in (("real", 29.1192), ("complex", 26.1142)):
        out = receive(bench, disturbed(objects, [interferer()]), [dict(sensors[0], if_sampling=sampling)])[0]
        bench.check(abs(floor_db(out) - expected) < 6e-5, f"{sampling} samples: {floor_db(out)} dB")
    aside = math.radians(30)
    u = math.pi / 2 * math.sin(aside)
    gain_db = 10 * math.log10(math.sin(u) / u * math.cos(aside) * math.cos(u))
    away = [spot("other", 50 * math.cos(aside), 50 * math.sin(aside)), spot("a", 40)]
    out = receive(bench, disturbed(away, [interferer(slope=7.5e12)]), sensors)[0]
    expected = 10 * math.log10(1 + 10 ** ((40.8748 + gain_db) / 10))
    bench.check(abs(floor_db(out) - expected) < 6e-5, f"{floor_db(out)} dB at 30 degrees")
    for place in ((-50, 0), (0, 50)):
        out = receive(bench, disturbed([spot("other", *place), spot("a", 40)], [interferer()]), sensors)[0]
        bench.check(floor_db(out) == 0, f"heard from {place}, out of view")


def threshold(bench):
    """The threshold rises with the noise: an echo that was 12.0412 dB above it is lost by the rest of the
    rise."""
    objects = [spot("other", 50), spot("a", 40)]
    above = 20 * math.log10(4)
    for hits, rise in ((1, 29.1192), (0.05, 16.2088)):
        frames = disturbed(objects, [interferer(hits=hits)], 3)
        out = receive(bench, frames, [radar("s", **RECEIVER)])
        lost = {one["object"]: one["shortfall_db"] for group in out[0]["lost"] if group["reason"] == "below_threshold"
                for one in group["echoes"]}
        bench.check(abs(lost.get("a", 0) - (rise - above)) < 6e-5 and not out[0]["targets"], f"{hits}: lost {lost}")
    loud = [radar("s", **RECEIVER, calibration_range_m=80 * 10 ** (16.3 / 40)), radar("unfit")]
    weak = disturbed(objects, [interferer(hits=0.05)], 3)
    out, without = check_switch(bench, weak, loud, "interference")
    bench.check({one["contributors"][0]["object"] for one in targets_of(out, "s")} == {"other", "a"}, "not above it")
    final = [dict(loud[0], final_threshold=True, calibration_range_m=80)]
    late = receive(bench, weak, final, "all,-threshold")
    reasons = {group["reason"] for group in late[0]["lost"]}
    bench.check(not late[0]["targets"] and "below_final_threshold" in reasons, f"final threshold: {reasons}")


def noise(bench):
    """Interference raises the noise on pointers, and so on the angle, and by signal to noise on range, in the
    same draws."""
    objects = [spot("other", 50), spot("a", 40)]
    noisy = radar("s", **RECEIVER, pointer_sigma=1e-4 * THRESHOLD, sigma_law="by_snr", calibration_range_m=800)
    frames = disturbed(objects, [interferer(hits=0.05)], 50)
    rise = 10 ** (16.2088 / 20)
    loud, quiet = receive(bench, frames, [noisy]), receive(bench, frames, [noisy], "all,-interference")
    for one, other in zip(targets_of(loud, "s"), targets_of(quiet, "s")):
        for key, tolerance in (("range_m", 1e-4), ("range_rate_mps", 1e-4), ("azimuth_rad", 1e-2)):
            factor = (one[key] - one["cell_" + key]) / (other[key] - other["cell_" + key])
            bench.check(abs(factor / rise - 1) < tolerance, f"{key}: noise times {factor}, expected {rise}")
    bench.check(len(targets_of(loud, "s")) == 100 == len(targets_of(quiet, "s")), "not two targets a frame")


# ---- coherence --------------------------------------------------------------------------------

FADES = {-10: 0.143566, -20: 0.045053}


def fades(frames, single):
    """Sum pointers in decibels to the mean power of two such echoes."""
    return [10 * math.log10(max(one["sum_re"] ** 2 + one["sum_im"] ** 2, 1e-30) / (2 * single ** 2))
            for frame in frames for one in frame["cells"] if len(one["members"]) == 2]


def coherence(bench):
    """MODEL 14.18: two equal echoes in one cell, over phases that are drawn or that all pass by once."""
    wave = C_MPS / 76.5e9
    together = frames_of([spot("a", 40), spot("b", 40), spot("alone", 60)], FRAMES)
    passing = [dict(one, objects=[ego(), spot("a", 40), spot("b", 40 + wave / 2 * i / FRAMES), spot("alone", 60)])
               for i, one in enumerate(together)]
    single = 4 * THRESHOLD
    for phase, frames in (("random", together), ("by_path", passing)):
        radars = [radar("s", carrier_hz=76.5e9, cell_phase=phase, calibration_range_m=80)]
        out = receive(bench, frames, radars)
        depths = fades(out, single)
        bench.check(len(depths) == FRAMES, f"{phase}: {len(depths)} cells of two")
        for depth, chance in FADES.items():
            found = sum(one < depth for one in depths) / FRAMES
            slack = 5 * math.sqrt(chance / FRAMES) if phase == "random" else 3 / FRAMES + 2e-4
            bench.check(abs(found - chance) < slack, f"{phase}: {found} below {depth} dB, expected {chance}")
        bench.check(all(abs(one["cells"][0]["amplitude"] - 2 * single) < 1e-3 for one in out), "the bound is another")
        check_switch(bench, frames[:50], radars, "coherence")
        bench.check(all("coherence" not in one.get("effects", []) for frame in out for one in frame["targets"]
                        if one["contributors"][0]["object"] == "alone"), "a lone echo is labelled")
    repeated = receive(bench, [together[0], together[7]], [radar("s", carrier_hz=76.5e9, cell_phase="by_path")])
    sums = [[(one["sum_re"], one["sum_im"]) for one in frame["cells"]] for frame in repeated]
    bench.check(sums[0] == sums[1], "what stands still fades")


def coherence_loses(bench):
    """Pairs are lost below the final threshold as often as they fade by 10 dB."""
    frames = frames_of([spot("a", 40), spot("b", 40)], FRAMES)
    reach = 40 * math.sqrt(math.sqrt(0.5) * 10 ** 0.5)
    out = receive(bench, frames, [radar("s", cell_phase="random", final_threshold=True, calibration_range_m=reach)])
    lost = sum(group["reason"] == "below_final_threshold" for frame in out for group in frame["lost"])
    check_share(bench, lost, FRAMES, FADES[-10], "lost in fades of 10 dB")
    bench.check(lost + sum(len(frame["targets"]) for frame in out) == FRAMES, "not accounted for")


def planned(bench):
    """glint-plan prints every described effect as simulated, and the others as off."""
    radars = [radar("s", **RECEIVER, fluctuation="swerling_1", cell_phase="random", unambiguous_range_m=30)]
    frames = [dict(one, conditions={"rain_mmph": 1, "fog_gpm3": 0.1, "interferers": [interferer()]})
              for one in frames_of([spot("other", 50)], 3)]
    suite = bench.write_suite(suite_of(*radars))
    for effects, told in (("auto", "on in 3 of 3 scans"), ("none", "off")):
        lines = bench.fused(f"glint-plan --all --sensors {suite} --effects {effects}", frames).splitlines()
        for name in ("fluctuation", "rain", "fog", "ambiguity", "interference", "coherence"):
            found = [line for line in lines if line.startswith(f"# {name} ")]
            bench.check(sum(line.split(None, 2)[2].startswith(told) for line in found) == 1, f"{name}: {found}")


CHECKS = [
    ("weather attenuates as published", weather),
    ("what rain takes below the threshold is lost by as much", weather_loses),
    ("echoes fluctuate by their law, each on its own", fluctuation),
    ("bodies have levels by their widths, and keep them", levels),
    ("fluctuating echoes are detected as often as published", detection),
    ("rates and ranges fold where they should", ambiguity),
    ("what folds onto another shares its cell", folded_together),
    ("other radars raise the noise as published", floor),
    ("the threshold rises with the noise", threshold),
    ("noise rises on targets", noise),
    ("two echoes of one cell fade as published", coherence),
    ("who fades out is lost", coherence_loses),
    ("the plan tells of all six", planned),
]


def prepare(bench):
    model.add_shipped_vehicles(bench)
    model.add_vehicles(bench)


if __name__ == "__main__":
    model.run(__doc__, prepare, CHECKS)
