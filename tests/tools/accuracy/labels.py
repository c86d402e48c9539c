"""Labels of points of a diagram, placed so that none covers another label, a point or a bar."""
import math

TALL = 1.25  # of a line of text, in parts of the size of its font
# Letters by their width in DejaVu Sans, one of the widest fonts that a browser may take; in hundredths.
WIDTHS = {28: "Iijl'", 32: " .,", 34: ":;/|\\", 36: "f-", 39: "()[]t\"", 42: "r", 50: "_°*", 53: "sz", 55: "c", 58: "Lk",
          60: "FPTYvxy", 62: "Eaeo", 70: "ABCKRSVXZ", 75: "HNU", 79: "DGOQ", 82: "w", 84: "<>=+−±~^#", 87: "M", 95: "%&",
          99: "Wm@"}
WIDTH_OF = {letter: width / 100 for width, letters in WIDTHS.items() for letter in letters}


class Box:
    """A rectangle in pixels; y grows upwards."""

    def __init__(self, left, right, low, high):
        self.left, self.right, self.low, self.high = left, right, low, high

    def meets(self, other):
        return (self.left < other.right and other.left < self.right
                and self.low < other.high and other.low < self.high)

    def within(self, other):
        return (other.left <= self.left and self.right <= other.right
                and other.low <= self.low and self.high <= other.high)


def text_box(text, x, y, anchor, size):
    """Of a text whose middle height is y, and whose start, middle or end is x."""
    width = size * sum(WIDTH_OF.get(letter, 0.64) for letter in text)
    left = x - {"start": 0, "middle": width / 2, "end": width}[anchor]
    return Box(left, left + width, y - TALL * size / 2, y + TALL * size / 2)


def candidates(x, y):
    """Places around a point, near ones first: to the right, left, above, below and between."""
    for away in range(8, 160, 8):
        for eighth in (0, 4, 2, 6, 1, 3, 5, 7):
            angle = eighth * math.pi / 4
            across = math.cos(angle)
            anchor = "middle" if abs(across) < 0.1 else "start" if across > 0 else "end"
            yield x + away * across, y + away * math.sin(angle), anchor


def placed(points, panel, bars, size):
    """For each point (x, y, text) the place of its label: x, y, anchor. bars are boxes to keep clear."""
    taken = bars + [Box(x - 4, x + 4, y - 4, y + 4) for x, y, _ in points]
    found = []
    for x, y, text in points:
        for place in candidates(x, y):
            box = text_box(text, *place, size)
            if box.within(panel) and not any(box.meets(other) for other in taken):
                break
        else:
            raise ValueError(f"no room for the label {text}")
        taken.append(box)
        found.append(place)
    return found
