"""A picture as SVG: marks at places in metres, and words beside them in pixels; for light and dark pages."""
import math
import os

from glint.places import DATA

with open(os.path.join(DATA, "figures", "style.css"), encoding="utf-8") as file:
    STYLE = file.read().rstrip()


class Drawing:
    """An SVG of places in metres as the observer sees them, and of words beside them in pixels."""

    def __init__(self, size, scale, x_m, y_m, upright=False):
        """The place x_m, y_m is at the left upper corner; scale is in pixels to the metre. upright: places are metres
        ahead and to the left, and ahead is up."""
        self.size, self.scale, self.corner, self.parts, self.upright = size, scale, (x_m, y_m), [], upright

    def at(self, place):
        if self.upright:
            place = -place[1], place[0]
        return (self.scale * (place[0] - self.corner[0]), self.scale * (self.corner[1] - place[1]))

    def add(self, text):
        self.parts.append(text)

    def line(self, start, end, kind):
        (x1, y1), (x2, y2) = self.at(start), self.at(end)
        self.add(f'<line class="{kind}" x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}"/>')

    def points(self, places):
        return " ".join(f"{x:.1f},{y:.1f}" for x, y in map(self.at, places))

    def polygon(self, places, kind):
        self.add(f'<polygon class="{kind}" points="{self.points(places)}"/>')

    def curve(self, places, kind):
        self.add(f'<polyline class="{kind}" fill="none" points="{self.points(places)}"/>')

    def arrow(self, start, end):
        (x1, y1), (x2, y2) = self.at(start), self.at(end)
        turn = math.atan2(y1 - y2, x1 - x2)
        barbs = [f"{x2 + 10 * math.cos(turn + side):.1f} {y2 + 10 * math.sin(turn + side):.1f}" for side in (-0.4, 0.4)]
        self.add(f'<path class="arrow" fill="none" d="M{x1:.1f} {y1:.1f}L{x2:.1f} {y2:.1f}L{barbs[0]}M{x2:.1f} {y2:.1f}L{barbs[1]}"/>')

    def star(self, x, y, kind, size=10, tips=5, inner=0.42):
        """A star whose inner corners are so far out, as a share of its tips."""
        corners = [(size if corner % 2 == 0 else inner * size, math.pi * corner / tips - math.pi / 2) for corner in range(2 * tips)]
        points = " ".join(f"{x + r * math.cos(a):.1f},{y + r * math.sin(a):.1f}" for r, a in corners)
        self.add(f'<polygon class="{kind}" points="{points}"/>')

    def circle(self, x, y, kind, size):
        self.add(f'<circle class="{kind}" cx="{x:.1f}" cy="{y:.1f}" r="{size}"/>')

    def cross(self, x, y):
        self.add(f'<path class="lost" d="M{x - 4:.1f} {y - 4:.1f}l8 8m0-8l-8 8"/>')

    def word(self, text, x, y, kind="", anchor="start"):
        self.add(f'<text class="{kind}" x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{text}</text>')

    def note(self, place, lines, x, y, kind="", anchor="start"):
        """Words beside a place on the canvas, with a line to what they are about."""
        to_x, to_y = self.at(place)
        from_x = x - 6 if anchor == "start" else x + 6
        self.add(f'<line class="pointer" x1="{from_x:.1f}" y1="{y - 5:.1f}" x2="{to_x:.1f}" y2="{to_y:.1f}"/>')
        for number, text in enumerate(lines):
            self.word(text, x, y + 18 * number, f"{kind} strong" if number == 0 else "quiet", anchor)

    def inset(self, near, x, y):
        """Another drawing in a frame, and a frame around what it shows of this one."""
        (left, top), size = self.at(near.corner), [side / near.scale * self.scale for side in near.size]
        self.add(f'<rect class="frame" x="{left:.1f}" y="{top:.1f}" width="{size[0]:.1f}" height="{size[1]:.1f}"/>')
        for end in (0, 1):
            self.add(f'<line class="pointer" x1="{x + end * near.size[0]}" y1="{y}" '
                     f'x2="{left + end * size[0]:.1f}" y2="{top + size[1]:.1f}"/>')
        self.put(near, x, y)
        self.add(f'<rect class="frame" x="{x}" y="{y}" width="{near.size[0]}" height="{near.size[1]}"/>')

    def put(self, other, x, y):
        """Another drawing at a place on the canvas."""
        self.add(f'<svg x="{x}" y="{y}" width="{other.size[0]}" height="{other.size[1]}">'
                 f'<rect class="paper" width="100%" height="100%"/>')
        self.parts += other.parts
        self.add("</svg>")

    def save(self, path, title):
        width, height = self.size
        with open(path, "w", encoding="utf-8", newline="\n") as out:
            out.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}"'
                      f' viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="14" role="img">\n'
                      f'<title>{title}</title>\n<style>{STYLE}</style>\n<rect class="paper" width="{width}" height="{height}"/>\n'
                      + "\n".join(self.parts) + "\n</svg>\n")


def draw_metres(drawing, metres, x=16):
    """A scale near the lower edge."""
    y = drawing.size[1] - 14
    drawing.add(f'<path class="pointer" fill="none" d="M{x} {y - 6}v6h{drawing.scale * metres:g}v-6"/>')
    drawing.word(f"{metres} m", x + 6, y - 5, "quiet")
