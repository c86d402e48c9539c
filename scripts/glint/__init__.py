"""Frames of glint in Python. All names are those of frames.py, which also works alone, copied as glint.py; so
`glint.frames` is its function. The folders beside it have what the programs of scripts/ are made of."""
from glint.frames import *  # noqa: F403
