"""The figures of a data sheet: each has its unit in its name, and may be given in other units and as full or half angle."""
import difflib
import json
import math

DEGREE = math.pi / 180
# Endings of names, and the factor to the unit in which figures are read.
UNITS = {"_m": 1, "_mm": 1e-3, "_deg": DEGREE, "_mps": 1, "_kmh": 1 / 3.6, "_ghz": 1e9, "_ms": 1e-3, "_db": 1, "_dbsm": 1,
         "_wavelengths": 1}
# Every figure, by the name under which the script reads it; others() has its other spellings.
NAMES = """name origin document sources extends radars scans members
    vehicle_length_m vehicle_width_m ahead_of_middle_m behind_front_bumper_m ahead_of_rear_bumper_m left_of_middle_m
    inside_left_side_m inside_right_side_m height_m yaw_left_deg
    carrier_ghz cycle_ms latency_ms range_min_m range_max_m range_limits view_full_width_deg range_unambiguous_m
    range_resolution_m speed_resolution_mps azimuth_resolution_deg
    receding_max_mps approaching_max_mps speed_max_mps
    range_accuracy_m speed_accuracy_mps azimuth_accuracy_deg azimuth_accuracies accuracy_snr_db
    beam_two_way_full_width_deg elevation_one_way_full_width_deg gains
    transmit_positions_wavelengths receive_positions_wavelengths
    false_alarm_rate false_alarms_per_scan detected_dbsm detected_object detected_at_m detection_probability fluctuation
    range_step_m speed_step_mps azimuth_step_deg list_limit list_order""".split()
WORDS = ("detected_object", "fluctuation", "list_order", "members")  # are no numbers


class Refused(Exception):
    """What is wrong with a sheet, in a sentence."""


# Other spellings of a figure: an ending, what may stand in its place, and the factor to the value under the first name.
SPELLINGS = (("_resolution_m", "_cell_m", 0.5), ("_resolution_mps", "_cell_mps", 0.5), ("_mps", "_kmh", 1),
             ("_two_way_full_width_deg", "_one_way_full_width_deg", math.sqrt(0.5)), ("_full_width_deg", "_half_width_deg", 2),
             ("yaw_left_deg", "yaw_right_deg", -1))


def others(name):
    """All spellings of a figure, each with the factor to the value under its first name."""
    spelled = [(name, 1)]
    for ending, unlike, factor in SPELLINGS:
        spelled += [(one.removesuffix(ending) + unlike, old * factor) for one, old in spelled if one.endswith(ending)]
    return spelled


KNOWN = {spelling for name in NAMES for spelling, _ in others(name)}


def scale(name):
    return next((factor for ending, factor in UNITS.items() if name.endswith(ending)), 1)


def check_names(part, path=""):
    """Refuses a member that no figure has."""
    for name, value in part.items():
        if name not in KNOWN:
            near = difflib.get_close_matches(name, KNOWN, 1)
            raise Refused(f"{path}{name}: unknown figure" + (f"; did you mean {near[0]}?" if near else ""))
        for i, one in enumerate(value if name in ("radars", "scans") else []):
            check_names(one, f"{path}{name}[{i}].")


class Figures:
    """Of one scan: those of the sheet, of the radar and of the scan, the nearest first."""

    def __init__(self, scan, sheet, *parts):
        self.scan, self.document = scan, sheet.get("document", "the data sheet")
        self.values, self.sources, self.used = {}, {}, set()
        for part in (sheet, *parts):
            for name in part:
                for other, _ in others(name):
                    self.values.pop(other, None)
            self.values |= {name: value for name, value in part.items() if name not in (
                "name", "origin", "document", "sources", "extends", "radars", "scans")}
            self.sources |= part.get("sources", {})

    def __contains__(self, name):
        return any(spelling in self.values for spelling, _ in others(name))

    def take(self, name):
        """The value of a figure in m, rad, m/s, s or Hz; None if the sheet does not have it. A figure without a unit is as it is."""
        if name in WORDS:
            self.used.add(name)
            return self.values.get(name)
        given = [(spelling, self.number(spelling) * factor) for spelling, factor in others(name) if spelling in self.values]
        for spelling, value in given[1:]:
            if abs(value - given[0][1]) > 1e-3 * abs(value):
                raise Refused(f"{self.scan}: {given[0][0]} {self.values[given[0][0]]} and {spelling} {self.values[spelling]} "
                              "contradict each other")
        return given[0][1] if given else None

    def number(self, name):
        self.used.add(name)
        value = self.values[name]
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise Refused(f"{self.scan}: {name} is {json.dumps(value)}; expected a number")
        return value * scale(name)

    def places(self, name):
        """Places of elements, a list of numbers; [] if the sheet does not have them."""
        self.used.add(name)
        return self.values.get(name, [])

    def first(self, *names):
        """The first of these figures that the sheet has, and its value."""
        return next(((name, value) for name in names if (value := self.take(name)) is not None), None)

    def rows(self, name, *columns):
        """Rows of a figure over azimuth: (azimuth in rad, value), ascending; the value is that of the first column it has."""
        self.used.add(name)
        found = []
        for i, row in enumerate(self.values.get(name, [])):
            given = [column for column in columns if column in row]
            if sorted(row) != sorted(["azimuth_deg", *given]) or len(given) != 1:
                raise Refused(f"{self.scan}: {name}[{i}] has {', '.join(row)}; expected azimuth_deg and one of {', '.join(columns)}")
            factor = 2 if given[0] == "one_way_db" else 1
            found.append((row["azimuth_deg"] * DEGREE, row[given[0]] * scale(given[0]) * factor))
            if i > 0 and found[i][0] <= found[i - 1][0]:
                raise Refused(f"{self.scan}: {name}[{i}].azimuth_deg {row['azimuth_deg']} does not ascend")
        return found

    def source(self, names):
        """Where figures come from, as a suite says it; and why they are guessed, or None."""
        spelled = [spelling for name in names for spelling, _ in others(name) if spelling in self.values]
        texts = list(dict.fromkeys(self.sources.get(name, self.document) for name in spelled))
        figures = ", ".join(f"{name} {self.values[name]}" if not isinstance(self.values[name], list) else name for name in spelled)
        guessed = any(text.startswith("assumed") for text in texts)
        return f"[{'A' if guessed else 'F'}] {figures}: {'; '.join(texts)}", "; ".join(texts) if guessed else None

    def check_used(self, scan):
        """Refuses a figure that nothing has read: the script knows no use for it beside the others."""
        left = sorted(self.values.keys() - self.used)
        if left:
            raise Refused(f"{scan}: {', '.join(left)}: not used beside the other figures")
