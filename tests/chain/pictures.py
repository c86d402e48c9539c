"""Pictures of the pages: all drawn by scripts/figures, readable without colours, no text over another, no target
outside the fields of view; and a frame that scripts/figures draws has its targets where they are.

Usage: python3 tests/chain/pictures.py [PICTURE.svg ...]        exit status 1 if any check fails

The texts of an SVG are boxes here, as wide as DejaVu Sans makes them. At the width that a page gives a picture,
letters must have 11 pixels. A picture brings its own ground, as pages may be dark.
"""
import cmath
import itertools
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.dont_write_bytecode = True
sys.path[:0] = [os.path.join(ROOT, "tests", "tools", "accuracy"), os.path.join(ROOT, "tests", "support")]
import tree  # noqa: E402
from labels import Box, text_box  # noqa: E402

PAGE, HALF = 830, 415  # pixels of a picture by itself, and of one of two in a table
SMALLEST = 11  # pixels of a font, where it is shown
KEY = 60  # pixels that a key of marks takes at the top
BOLD = 1.12  # times as wide as plain letters
failed = False


def check(good, text):
    global failed
    if not good:
        failed = True
        print(f"pictures: {text}")


def pictures_of_pages():
    """{picture: (page, its width there)}, paths from the root, by the narrowest place."""
    found = {}
    for page in tree.files("*.md"):
        with open(os.path.join(ROOT, page), encoding="utf-8") as file:
            lines = file.readlines()
        for line in lines:
            for path in re.findall(r"!\[[^]]*\]\(([^)]+)\)|<img[^>]*src=\"([^\"]+)\"", line):
                picture = os.path.normpath(os.path.join(os.path.dirname(page), "".join(path)))
                place = page, HALF if line.startswith("|") else PAGE
                found[picture] = min(found.get(picture, place), place, key=lambda one: one[1])
    return found


def moved(transform, place):
    """A place after the translation of a transform, and whether the transform turns."""
    for x, y in re.findall(r"translate\(([-\d.]+),([-\d.]+)\)", transform):
        place = place[0] + float(x), place[1] + float(y)
    return place, "rotate" in transform


def texts(root):
    """(text, box, size of the font) of every text; y grows downwards."""
    def walk(node, place, turned, style):
        style = style | {key: node.get(key) for key in ("font-size", "text-anchor", "font-weight") if node.get(key)}
        place, turns = moved(node.get("transform", ""), place)
        turned = turned or turns
        if node is not root and node.tag.endswith("}svg"):
            place = place[0] + float(node.get("x")), place[1] + float(node.get("y"))
        if node.tag.endswith("}text"):
            words = "".join(node.itertext()).strip()
            size = float(style["font-size"].removesuffix("px"))
            bold = style.get("font-weight") == "bold" or {"strong", "title"} & set(node.get("class", "").split())
            middle = {"inside", "name"} & set(node.get("class", "").split())
            anchor = "middle" if middle else style.get("text-anchor", "start")
            box = text_box(words, 0, 0, anchor, size * (BOLD if bold else 1))
            box.low, box.high = -0.5 * size, 0.5 * size
            if turned:
                box = Box(box.low, box.high, -box.right, -box.left)
            x = place[0] + float(node.get("x", 0))
            y = place[1] + float(node.get("y", 0)) - (0 if turned else 0.35 * size)
            if words:
                yield words, Box(x + box.left, x + box.right, y + box.low, y + box.high), size
        for child in node:
            yield from walk(child, place, turned, style)
    return list(walk(root, (0.0, 0.0), False, {"font-size": "16"}))


def fill_of(node, root):
    """The fill of a node by light: its own, or that of its class in the picture's style."""
    styles = "".join(style.text for style in root.iter() if style.tag.endswith("}style"))
    of_class = re.search(r"\.%s\{fill:([^;}]+)" % re.escape(node.get("class", "")), styles)
    return node.get("fill", of_class.group(1) if of_class else "").lower()


def colours_of_marks(root):
    """{mark of gnuplot: its colours}, but for pale greys and what is nearly black."""
    found = {}
    for node in root.iter():
        colour = re.match(r"rgb\(\s*(\d+),\s*(\d+),\s*(\d+)\)", node.get("color", ""))
        if node.tag.endswith("}use") and colour:
            channels = tuple(map(int, colour.groups()))
            if max(channels) - min(channels) > 30:
                found.setdefault(node.get("{http://www.w3.org/1999/xlink}href"), set()).add(channels)
    return found


def corners(polygon):
    return [tuple(map(float, pair.split(","))) for pair in polygon.get("points").split()]


def holds(polygon, x, y):
    """Does a line to the right of the place cross the polygon an odd number of times?"""
    crossed = 0
    for (x1, y1), (x2, y2) in zip(polygon, polygon[1:] + polygon[:1]):
        crossed += (y1 > y) != (y2 > y) and x < x1 + (y - y1) * (x2 - x1) / (y2 - y1)
    return crossed % 2 == 1


def check_targets_in_view(name, root):
    """Every target of a drawn scene lies in a shaded field of view; the key is above the scene."""
    views = [corners(node) for node in root if node.get("class") == "beam"]
    stars = [corners(node) for node in root if node.get("class") in ("left", "ghost")]
    places = [[sum(axis) / len(star) for axis in zip(*star)] for star in stars]
    places += [(float(node.get("cx")), float(node.get("cy"))) for node in root if node.get("class") == "right"]
    places = [(x, y) for x, y in places if y > KEY]
    check(not views or places, f"{name} shows a field of view and no target")
    for x, y in places if views else []:
        check(any(holds(view, x, y) for view in views), f"{name}: a target at {x:.0f}, {y:.0f} lies in no field of view")


def check_picture(path, shown):
    """shown: how wide a page makes the picture."""
    name = os.path.basename(path)
    root = xml.parse(path).getroot()
    width, height = (float(root.get(side)) for side in ("width", "height"))
    title = root.find("{http://www.w3.org/2000/svg}title")
    check(title is not None and len(title.text.split()) > 3, f"{name} has no title that says what it shows")
    ground = [node for node in root.iter() if node.tag.endswith("}rect") or node.tag.endswith("}polygon")]
    check(ground and fill_of(ground[0], root) in ("#fff", "#ffffff"), f"{name} has no ground of its own")
    for mark, colours in colours_of_marks(root).items():
        check(len(colours) == 1, f"{name}: colour alone tells {len(colours)} kinds of {mark}")
    check_targets_in_view(name, root)
    found = texts(root)
    check(len(found) > 0, f"{name} has no text")
    for number, (text, box, size) in enumerate(found):
        check(box.within(Box(2, width - 2, 2, height - 2)), f'{name}: "{text}" reaches over the edge')
        check(size * min(1, shown / width) >= SMALLEST, f'{name}: "{text}" has letters of {size:g} px in {width:g}')
        for other, its, _ in found[:number]:
            check(not box.meets(its), f'{name}: "{text}" lies over "{other}"')


def check_frame(pipeline, number):
    """scripts/figures --frame: the marks of each sensor, stars and circles, are as far apart as its targets are."""
    glint = os.path.join(ROOT, "build", "bin", "glint")
    lines = subprocess.run([glint, os.path.join(ROOT, "pipelines", pipeline + ".sh")], stdout=subprocess.PIPE, check=True).stdout
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "frame.svg")
        subprocess.run([os.path.join(ROOT, "scripts", "figures"), "--frame", str(number), "-o", path], input=lines, check=True)
        root = xml.parse(path).getroot()
    frame = next(one for one in map(json.loads, lines.splitlines()) if one["frame"] == number)
    title = root.find("{http://www.w3.org/2000/svg}title").text
    check(f'{frame["scene"]}, frame {number} at {frame["time_s"]:g} s' in title, f"{pipeline}: the title {title!r} names another frame")
    marks = {"left": [tuple(sum(axis) / 10 for axis in zip(*corners(node))) for node in root.iter() if node.get("class") == "left"],
             "right": [(float(node.get("cx")), float(node.get("cy"))) for node in root.iter() if node.get("class") == "right"]}
    metres = next(float(re.search(r"v6h([\d.]+)v-6", node.get("d"))[1]) for node in root.iter() if "v6h" in node.get("d", ""))
    scale = metres / next(int(node.text.split()[0]) for node in root.iter() if re.fullmatch(r"\d+ m", node.text or ""))
    for sensor, places in marks.items():
        targets = [one for one in frame["targets"] if one["sensor"] == sensor]
        check(len(places) == len(targets) + 1, f"{pipeline}: {len(places)} marks of {sensor}, one of them in the key, for {len(targets)} targets")
        for (place, one), (other, two) in itertools.combinations(zip(places, targets), 2):
            expected = abs(cmath.rect(one["range_m"], one["azimuth_rad"]) - cmath.rect(two["range_m"], two["azimuth_rad"]))
            check(abs(math.dist(place, other) - scale * expected) < 0.3, f"{pipeline}: two targets of {sensor} are {expected:.2f} m apart")


def main(paths):
    for path in paths:
        check_picture(path, PAGE)
    if not paths:
        drawn = subprocess.run([os.path.join(ROOT, "scripts", "figures"), "--list"], stdout=subprocess.PIPE, text=True,
                               check=True).stdout.split()
        shown = pictures_of_pages()
        for path in sorted(shown.keys() - set(drawn)):
            check(False, f"{shown[path][0]} shows {path}, which scripts/figures does not draw")
        for path in sorted(set(drawn) - shown.keys()):
            check(False, f"no page shows {path}")
        for path in sorted(set(tree.files("*.svg")) - set(drawn)):
            check(False, f"{path} is a picture that scripts/figures does not draw")
        check_frame("two-vehicles", 1)
        check_frame("intersection", 40)
        for path in drawn:
            check_picture(os.path.join(ROOT, path), shown[path][1] if path in shown else PAGE)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
