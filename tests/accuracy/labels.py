"""Labels of points of a diagram, placed so that none covers another label, a point or a bar."""
import math

WIDE, TALL = 0.56, 1.25  # of a letter in parts of the size of its font, generously


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
    width = WIDE * size * max(len(text), 1)
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
