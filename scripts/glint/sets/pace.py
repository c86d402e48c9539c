"""Progress of a run of make: the frames made of each shard, in a file that its processes share."""
import array
import contextlib
import os
import sys
import time

from glint.progress import PAUSE_S, QUIET_S, line_of, line_width

PATH = "work/begun"  # doubles: begin of the run, frames to make, and frames made of each shard
HEAD = 2


def begin(layout, left):
    """The content of the file when the shards `left` are still to be made."""
    return array.array("d", [time.time(), sum(layout["shards"][part]["frames"] for part in left), *[0] * len(layout["shards"])])


def clear():
    """Clears the line of progress."""
    if sys.stderr.isatty():
        print(f"\r{'':{line_width()}}\r", end="", file=sys.stderr, flush=True)


class Pace:
    """The progress of one process, and the line of progress of all."""

    def __init__(self, folder, part, frames):
        self.path, self.slot, self.frames, self.made, self.next_s = os.path.join(folder, PATH), part + HEAD, frames, 0, 0

    def add(self, lines):
        if not sys.stderr.isatty():
            return
        self.made += lines.count(b"\n")
        if time.monotonic() >= self.next_s:
            self.show(min(self.made, self.frames))

    def end(self):
        """Counts all frames that were expected of the shard as made."""
        self.show(self.frames)

    def show(self, made):
        self.next_s = time.monotonic() + PAUSE_S
        if not sys.stderr.isatty():
            return
        with contextlib.suppress(OSError), open(self.path, "r+b", buffering=0) as file:  # without make there is none
            os.pwrite(file.fileno(), array.array("d", [made]), self.slot * 8)
            begun_s, expected, *by_shard = array.array("d", file.read())
            elapsed_s, count = time.time() - begun_s, sum(by_shard)
            if elapsed_s >= QUIET_S and count > 0:
                line, width = line_of("frames", count, elapsed_s, count / expected), line_width()
                print(f"\r{line:{width}.{width}}", end="", file=sys.stderr, flush=True)
