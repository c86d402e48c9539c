"""Rate and time left of a script's work, in one line on stderr.

The line is that of glint's own programs (lib/run/progress.h): it appears where stderr is a terminal and the work
has lasted for a second, and is gone at the end.

    for scene in Progress("scenes").over(scenes): ...
    for scene in Progress("scenes").over(scenes, cost=lambda scene: 0.1 * scene.objects): ...
    progress = Progress("runs", 100); progress.step(); say("one is done"); progress.end()

The time left follows from the number of items, or from what they cost where they differ: seconds on some machine. While
an item with a cost is at work, the line changes every second. Work inside it draws no line; if it has costs of its own,
it tells its share of the item. A part of scripts/test tells it to the whole (GLINT_PROGRESS).
"""
import os
import sys
import threading
import time

BAR_WIDTH, LINE_WIDTH = 24, 72
QUIET_S, PAUSE_S = 1, 0.2


def line_width():
    """Columns of the line; the last one of a terminal stays free, as a cursor beside it may stand in the next line."""
    try:
        columns = os.get_terminal_size(sys.stderr.fileno()).columns
    except OSError:
        columns = 0
    return columns - 1 if 0 < columns <= LINE_WIDTH else LINE_WIDTH


def told_file():
    """The file to which this process tells its share, or None: what it starts is no part of the whole."""
    process, _, path = os.environ.pop("GLINT_PROGRESS", "").partition(" ")
    return path if process in (str(os.getppid()), str(os.getpid())) else None


TOLD = told_file()


def line_of(unit, count, elapsed_s, share):
    share, rate = min(share, 1), count / elapsed_s
    left_s = round(elapsed_s / share - elapsed_s)
    return (f"[{'#' * int(BAR_WIDTH * share):{BAR_WIDTH}}] {int(100 * share):3} %, {rate:.{int(rate < 10)}f} {unit}/s, "
            f"{left_s // 3600}:{left_s // 60 % 60:02}:{left_s % 60:02} left")


def left_s(costs, done, spent_s, running_s, share=0):
    """The time left of items with these costs, of which so many took spent_s, and the next has run for running_s and is
    done to that share (0: unknown). The costs alone say it at first; a hundredth of them counts as kept. An item that
    runs for longer than it should counts, too, and is thought to last for a quarter of its time yet."""
    whole, ready, next_cost = sum(costs), sum(costs[:done]), costs[done] if done < len(costs) else 0
    kept = whole / 100
    pace = (kept + spent_s) / (kept + ready)
    late = share == 0 and running_s > next_cost * pace
    if share > 0 or late:
        pace = (kept + spent_s + running_s) / (kept + ready + (1 if late else share) * next_cost)
    rest = (1 - share) * next_cost * pace if share > 0 else max(next_cost * pace - running_s, running_s / 4)
    return rest + pace * (whole - ready - next_cost)


class Progress:
    standing, lock = False, threading.Lock()  # whether the terminal shows a line, whoever's it is
    whole = None  # the work with costs of which others are a part

    def __init__(self, unit, expected=0):
        self.unit, self.expected, self.count, self.whole = unit, expected, 0, Progress.whole
        self.begin = time.monotonic()
        self.next = self.begin + QUIET_S if sys.stderr.isatty() and not self.whole else None

    def step(self, count=1, share=None):
        """Adds to the count; share is the part that is done, if it is another than that of what was expected."""
        with Progress.lock:
            self.count += count
            now = time.monotonic()
            share = self.count / self.expected if share is None else share
            if self.next is None or now < self.next or share <= 0:
                return
            self.next = now + PAUSE_S
            self._draw(now, share)

    def _draw(self, now, share):
        line = line_of(self.unit, self.count, now - self.begin, share)
        print(f"\r{line:{line_width()}.{line_width()}}", end="", file=sys.stderr, flush=True)
        Progress.standing = True

    @staticmethod
    def end():
        """Takes the line away; the next step brings it back."""
        with Progress.lock:
            if Progress.standing:
                print(f"\r{'':{line_width()}}\r", end="", file=sys.stderr, flush=True)
            Progress.standing = False

    def over(self, items, expected=None, cost=None):
        """The items, each counted when the next one is asked for; cost gives the seconds of one."""
        if cost:
            yield from self._over_costs([*items], cost)
            return
        self.expected = len(items) if expected is None else expected
        try:
            for item in items:
                yield item
                self.step()
        finally:
            self.end()

    def _over_costs(self, items, cost):
        self.costs, self.inner, self.last = [cost(item) for item in items], 0, self.begin
        ended, outer = threading.Event(), self.whole
        ticker = threading.Thread(target=self._tick, args=(ended,), daemon=True)
        if self.next is not None or self.whole or TOLD:
            ticker.start()
        try:
            for item in items:
                Progress.whole = self
                yield item
                with Progress.lock:
                    self.count, self.inner, self.last = self.count + 1, 0, time.monotonic()
        finally:
            Progress.whole = outer
            ended.set()
            if ticker.is_alive():
                ticker.join()
            self.end()

    def _tick(self, ended):
        while not ended.wait(1):
            with Progress.lock:
                now = time.monotonic()
                left = left_s(self.costs, self.count, self.last - self.begin, now - self.last, self.inner)
                self._tell(now, (now - self.begin) / (now - self.begin + left))

    def _tell(self, now, share):
        if self.whole:
            self.whole.inner = share
        elif TOLD:
            with open(TOLD, "w", encoding="ascii") as file:
                file.write(f"{share:.4f}\n")
        if self.next is not None:
            self._draw(now, share)


def say(text):
    """Prints a line where the line of progress stands."""
    Progress.end()
    print(text, flush=True)
