"""Where glint lies: in its source tree, or in share/glint of an installation, which has the same folders but for build/."""
import os

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
DATA, SCHEMAS, SCRIPTS = (os.path.join(ROOT, name) for name in ("data", "schemas", "scripts"))
IS_INSTALLED = not os.path.exists(os.path.join(ROOT, "Makefile"))
BIN = os.path.normpath(os.path.join(ROOT, "../../bin" if IS_INSTALLED else os.environ.get("BUILD", "build") + "/bin"))
GLINT = os.path.join(BIN, "glint")
