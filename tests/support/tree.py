"""The files of the tree, whether it came by git or from a tar file."""
import fnmatch
import os
import re

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def files(pattern="*"):
    """Paths from the root, in order, without what git, make and Python write."""
    found = []
    for folder, folders, names in os.walk(ROOT):
        if folder == ROOT:
            folders[:] = [name for name in folders if not re.fullmatch(r"build(-.*)?", name)]
        folders[:] = [name for name in folders if name not in (".git", "__pycache__")]
        found += [os.path.relpath(os.path.join(folder, name), ROOT) for name in names if name != ".git"]
    return sorted(fnmatch.filter(found, pattern))
