"""How much a test does. The run of scripts/test without --all sets GLINT_TEST_QUICK: what is drawn at random is drawn less
often there, so that all parts together take minutes."""
import os


def quick(less, usual):
    """The number of draws, frames or cases: fewer in the quick run."""
    return less if "GLINT_TEST_QUICK" in os.environ else usual
