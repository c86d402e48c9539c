"""Rate and time left of a script's work, in one line on stderr.

The line is that of glint's own programs (lib/run/progress.h): it appears where stderr is a terminal and the work
has lasted for a second, and is gone at the end.

    for scene in Progress("scenes").over(scenes): ...
    progress = Progress("runs", 100); progress.step(); say("one is done"); progress.end()
"""
import sys
import threading
import time

BAR_WIDTH, LINE_WIDTH = 24, 72
QUIET_S, PAUSE_S = 1, 0.2


def line_of(unit, count, elapsed_s, share):
    share, rate = min(share, 1), count / elapsed_s
    left_s = round(elapsed_s / share - elapsed_s)
    return (f"[{'#' * int(BAR_WIDTH * share):{BAR_WIDTH}}] {int(100 * share):3} %, {rate:.{int(rate < 10)}f} {unit}/s, "
            f"{left_s // 3600}:{left_s // 60 % 60:02}:{left_s % 60:02} left")


class Progress:
    standing, lock = False, threading.Lock()  # whether the terminal shows a line, whoever's it is

    def __init__(self, unit, expected=0):
        self.unit, self.expected, self.count = unit, expected, 0
        self.begin = time.monotonic()
        self.next = self.begin + QUIET_S if sys.stderr.isatty() else None

    def step(self, count=1, share=None):
        """Adds to the count; share is the part that is done, if it is another than that of what was expected."""
        with Progress.lock:
            self.count += count
            now = time.monotonic()
            share = self.count / self.expected if share is None else share
            if self.next is None or now < self.next or share <= 0:
                return
            self.next = now + PAUSE_S
            line = line_of(self.unit, self.count, now - self.begin, share)
            print(f"\r{line:{LINE_WIDTH}}", end="", file=sys.stderr, flush=True)
            Progress.standing = True

    @staticmethod
    def end():
        """Takes the line away; the next step brings it back."""
        with Progress.lock:
            if Progress.standing:
                print(f"\r{'':{LINE_WIDTH}}\r", end="", file=sys.stderr, flush=True)
            Progress.standing = False

    def over(self, items, expected=None):
        """The items, each counted when the next one is asked for."""
        self.expected = len(items) if expected is None else expected
        try:
            for item in items:
                yield item
                self.step()
        finally:
            self.end()


def say(text):
    """Prints a line where the line of progress stands."""
    Progress.end()
    print(text, flush=True)
