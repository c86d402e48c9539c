"""The figures of a data sheet: each has its unit in its name, and may be given in other units and as full or half angle."""
import difflib
import json
import math
import re

DEGREE = math.pi / 180
# Endings of names, and the factor to the unit in which figures are read.
UNITS = {"_m": 1, "_cm": 1e-2, "_mm": 1e-3, "_deg": DEGREE, "_mps": 1, "_kmh": 1 / 3.6, "_mph": 0.44704, "_ghz": 1e9, "_ms": 1e-3,
         "_percent": 1e-2}
# Figures that are numbers, by the name under which the script reads them, with their least and greatest value.
NUMBERS = """vehicle_length_m 0.5 50  vehicle_width_m 0.5 10  height_m 0.01 20  yaw_left_deg -180 180
    ahead_of_middle_m -50 50  behind_front_bumper_m -50 50  ahead_of_rear_bumper_m -50 50
    left_of_middle_m -10 10  inside_left_side_m -10 10  inside_right_side_m -10 10
    carrier_ghz 1 1000  cycle_ms 0.1 1e6  update_rate_hz 1e-3 1e4  latency_ms 0 1e4
    range_min_m 0 1e5  range_max_m 0.1 1e5  range_unambiguous_m 0.1 1e6  view_full_width_deg 0.1 180
    range_resolution_m 1e-4 1e4  speed_resolution_mps 1e-4 1e3  azimuth_resolution_deg 0.01 180
    receding_max_mps 0.1 1e4  approaching_max_mps 0.1 1e4  speed_max_mps 0.1 1e4
    range_accuracy_m 0 1e3  range_accuracy_percent 0 100  speed_accuracy_mps 0 1e3  azimuth_accuracy_deg 1e-4 90  accuracy_snr_db -20 100
    beam_two_way_full_width_deg 0.1 360  elevation_one_way_full_width_deg 0.2 180
    elevation_view_full_width_deg 0.1 180  elevation_accuracy_deg 1e-4 90  elevation_resolution_deg 0.01 180  elevation_step_deg 0 90
    false_alarm_rate 1e-15 0.1  false_alarms_per_scan 1e-9 1e4
    detected_dbsm -60 60  detected_at_m 0.1 1e5  detection_probability 0.01 0.9999
    range_step_m 0 1e3  speed_step_mps 0 1e3  azimuth_step_deg 0 90  list_limit 0 1e6""".split()
BOUNDS = {name: (float(low), float(high)) for name, low, high in zip(NUMBERS[::3], NUMBERS[1::3], NUMBERS[2::3])}
DETECTION = {"dbsm": "detected_dbsm", "at_m": "detected_at_m", "probability": "detection_probability"}  # as columns, and as figures
COLUMNS = {"azimuth_deg": (-180, 180), "range_max_m": (1e-3, 1e5), "accuracy_deg": (1e-4, 90), "one_way_db": (-200, 100),
           "two_way_db": (-200, 100)}
WORDS = {"detected_object": ("car", "truck", "motorcycle", "pedestrian"), "fluctuation": ("none", "swerling_1", "swerling_3"),
         "list_order": ("strongest", "nearest")}
LISTS = ("detections", "range_limits", "azimuth_accuracies", "gains", "transmit_positions_wavelengths", "receive_positions_wavelengths")
# What is no figure, with the levels on which it may stand.
LEVELS = ("the sheet", "a radar", "a scan")
ABOUT = {"origin": LEVELS[:1], "document": LEVELS[:1], "extends": LEVELS[:1], "vehicles": LEVELS[:1], "radars": LEVELS[:1],
         "scans": LEVELS[1:2], "name": LEVELS[1:], "sources": LEVELS, "members": LEVELS}


class Refused(ValueError):
    """What is wrong with a sheet, in a sentence."""


# Other spellings of a figure: an ending, what may stand in its place, and the factor to the value under the first name.
SPELLINGS = (("_resolution_m", "_cell_m", 0.5), ("_resolution_mps", "_cell_mps", 0.5), ("_mps", "_kmh", 1), ("_mps", "_mph", 1),
             ("_m", "_cm", 1), ("_two_way_full_width_deg", "_one_way_full_width_deg", math.sqrt(0.5)),
             ("_full_width_deg", "_half_width_deg", 2), ("yaw_left_deg", "yaw_right_deg", -1))


def others(name):
    """All spellings of a figure, each with the factor to the value under its first name."""
    spelled = [(name, 1)]
    for ending, unlike, factor in SPELLINGS:
        spelled += [(one.removesuffix(ending) + unlike, old * factor) for one, old in spelled if one.endswith(ending)]
    return spelled


FIRST = {spelling: name for name in (*BOUNDS, *WORDS, *LISTS) for spelling, _ in others(name)}


def scale(name):
    return next((factor for ending, factor in UNITS.items() if name.endswith(ending)), 1)


def number(path, value, low, high):
    """The value, if it is a number from low to high."""
    good = isinstance(value, (int, float)) and not isinstance(value, bool) and low <= value <= high
    expect(path, value, good, f"a number from {low:g} to {high:g}")
    return value


def expect(path, value, good, words):
    if not good:
        raise Refused(f"{path} is {json.dumps(value)}; expected {words}")


def check_known(path, name):
    if name not in FIRST:
        near = difflib.get_close_matches(name, [*FIRST, *ABOUT], 1)
        raise Refused(f"{path}{name}: unknown figure" + (f"; did you mean {near[0]}?" if near else ""))


def check_names(part, path=""):
    """Refuses members that no figure has, and members that are no figures but of another kind or level."""
    expect(path.rstrip(".") or "the sheet", part, isinstance(part, dict), "an object of figures")
    for name, value in part.items():
        where = path + name
        if name not in ABOUT:
            check_known(path, name)
        elif LEVELS[path.count(".")] not in ABOUT[name]:
            raise Refused(f"{where}: expected only in {' or '.join(ABOUT[name])}, not in {LEVELS[path.count('.')]}")
        elif name in ("radars", "scans"):
            expect(where, value, isinstance(value, list) and value, "a list of one or more objects")
            for i, one in enumerate(value):
                check_names(one, f"{where}[{i}].")
        elif name == "sources":
            expect(where, value, isinstance(value, dict), "an object of texts")
            for figure, text in value.items():
                check_known(where + ".", figure)
                expect(f"{where}.{figure}", text, isinstance(text, str) and len(text) < 240, "a text of at most 239 letters")
        elif name == "members":
            expect(where, value, isinstance(value, dict) and value and "name" not in value, "an object of members other than name")
        else:
            expect(where, value, isinstance(value, str) and 0 < len(value) < 240, "a text of 1 to 239 letters")
            expect(where, value, name != "name" or re.fullmatch(r"[\w-]+", value), "letters, digits, _ and -")


class Figures:
    """Of one scan: those of the sheet, of the radar and of the scan, the nearest first."""

    def __init__(self, scan, sheet, *parts):
        self.scan, self.document, self.extends = scan, sheet.get("document", "the data sheet"), sheet.get("extends")
        self.values, self.sources, self.members, self.used = {}, {}, {}, set()
        for part in (sheet, *parts):
            for name in part:
                for other, _ in others(name):
                    self.values.pop(other, None)
            self.values |= {name: value for name, value in part.items() if name not in ABOUT}
            self.sources |= part.get("sources", {})
            self.members |= part.get("members", {})

    def __contains__(self, name):
        return any(spelling in self.values for spelling, _ in others(name))

    def spelled(self, name):
        """The figure's name as the sheet has it."""
        return next((spelling for spelling, _ in others(name) if spelling in self.values), name)

    def told(self, name, value=None):
        """The figure's name and value as the sheet has them; beside lists and words the value that follows from them."""
        given = self.values[self.spelled(name)]
        known = isinstance(given, (int, float)) or not isinstance(value, (int, float))
        follows = "" if known else f" ({value / (DEGREE if name == 'azimuth_accuracies' else 1):.4g})"
        return self.spelled(name) + ("" if isinstance(given, list) else f" {given}") + follows

    def take(self, name):
        """The value of a figure in m, rad, m/s, s or Hz, or as it is if it has no unit; None if the sheet does not have it."""
        given = []
        for spelling, factor in others(name) if name in self else ():
            path, value, unit = f"{self.scan}: {spelling}", self.values.get(spelling), scale(spelling) * factor
            if name in WORDS:
                expect(path, value, value in WORDS[name], f"one of {', '.join(WORDS[name])}")
            elif spelling in self.values:
                value = number(path, value, *sorted(end * scale(name) / unit for end in BOUNDS[name])) * unit
            self.used.add(spelling)
            given.append((spelling, value))
        return self.agreed(*given)[1]

    def agreed(self, *given, slack=1e-3):
        """The first of some (figure, value) whose value is not None; refuses others that differ from it."""
        given = [(name, value) for name, value in given if value is not None]
        for name, value in given[1:]:
            if abs(value - given[0][1]) > slack * abs(value) + 1e-9:
                raise Refused(f"{self.scan}: {self.told(*given[0])} and {self.told(name, value)} contradict each other")
        return given[0] if given else (None, None)

    def whole(self, name, words):
        """A figure that is a list; an empty one if the sheet does not have it."""
        self.used.add(name)
        value = self.values.get(name, [])
        expect(f"{self.scan}: {name}", value, isinstance(value, list) and (value or name not in self.values), words)
        return value

    def places(self, name):
        """Places of elements, a list of numbers; [] if the sheet does not have them."""
        return [number(f"{self.scan}: {name}[{i}]", one, -1e4, 1e4) for i, one in enumerate(self.whole(name, "a list of numbers"))]

    def rows(self, name, *columns):
        """Rows of a figure over azimuth: (azimuth in rad, value), ascending; the value is that of the first column it has."""
        found = []
        for i, row in enumerate(self.whole(name, "a list of rows")):
            path, given = f"{self.scan}: {name}[{i}]", [column for column in columns if isinstance(row, dict) and column in row]
            expect(path, row, len(given) == 1 and row.keys() == {"azimuth_deg", *given}, f"azimuth_deg and one of {', '.join(columns)}")
            for column, value in row.items():
                number(f"{path}.{column}", value, *COLUMNS[column])
            found.append((row["azimuth_deg"] * DEGREE, row[given[0]] * scale(given[0]) * (2 if given[0] == "one_way_db" else 1)))
            expect(f"{path}.azimuth_deg", row["azimuth_deg"], i == 0 or found[i][0] > found[i - 1][0], "azimuths that ascend")
        return found

    def detections(self):
        """Rows of what is detected: {object or dbsm, at_m, and probability if it is stated}; [] if the sheet does not have them."""
        rows = self.whole("detections", "a list of one or two rows")
        expect(f"{self.scan}: detections", rows, len(rows) < 3, "one or two rows, which state level and slope")
        for i, row in enumerate(rows):
            path = f"{self.scan}: detections[{i}]"
            good = isinstance(row, dict) and "at_m" in row and ("object" in row) != ("dbsm" in row) and row.keys() <= {"object", *DETECTION}
            expect(path, row, good, "object or dbsm, at_m, and no more than probability beside them")
            for column, value in row.items():
                if column == "object":
                    expect(f"{path}.object", value, value in WORDS["detected_object"], f"one of {', '.join(WORDS['detected_object'])}")
                else:
                    number(f"{path}.{column}", value, *BOUNDS[DETECTION[column]])
        return rows

    def source(self, names):
        """Where figures come from, as a suite says it; and a sentence on each that is guessed."""
        texts = {name: self.sources.get(name, self.document) for name in map(self.spelled, names) if name in self.values}
        guesses = [f"{self.told(name)}: {text.removeprefix('assumed').lstrip(', ') or 'a guess'}" for name, text in texts.items()
                   if text.startswith("assumed")]
        told = f"{', '.join(map(self.told, texts))}: {'; '.join(dict.fromkeys(texts.values()))}" if texts else "not stated"
        return f"[{'A' if guesses or not texts else 'F'}] {told}", guesses
