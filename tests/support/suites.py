"""Suites of data/sensors, whole: with the members that they have from the suites that they extend."""
import os
import re
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
FOLDER = os.path.join(ROOT, "data", "sensors")
sys.path.append(os.path.join(ROOT, "scripts"))
from glint.sets.documents import whole_suite  # noqa: E402


def whole(name):
    """A shipped suite by its name; its tables lie beside FOLDER."""
    return whole_suite(os.path.join(FOLDER, name + ".json"))


def extraction(sheet):
    """glint-extract with the vehicles that a printed data sheet names."""
    return (re.search(r"glint-extract --vehicles \S+", sheet) or ["glint-extract"])[0]
