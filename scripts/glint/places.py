"""Where glint lies: in its source tree, or in share/glint of an installation, which has the same folders."""
import os

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
DATA, SCHEMAS, SCRIPTS = (os.path.join(ROOT, name) for name in ("data", "schemas", "scripts"))
BIN = os.path.normpath(os.path.join(ROOT, os.environ.get("BUILD", "build"), "bin"))
GLINT = os.path.join(BIN, "glint")
