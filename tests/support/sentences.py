"""Runs tests whose names are the sentences that they prove."""
import tempfile


def prove(tests, chosen=()):
    """Runs each test in a folder of its own and prints its sentence; chosen: the names of tests, all if empty."""
    for test in tests:
        if chosen and test.__name__ not in chosen:
            continue
        with tempfile.TemporaryDirectory() as folder:
            test(folder)
        print("ok      ", test.__name__.replace("_", " "), flush=True)
