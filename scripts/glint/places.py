"""Where glint lies: in its source tree; in share/glint of an installation, which has the same folders but for build/; or in
the folder `installed` of the package, which is an installation in a wheel."""
import os

PACKAGE = os.path.dirname(os.path.realpath(__file__))
WHEEL = os.path.join(PACKAGE, "installed")
ROOT = os.path.join(WHEEL, "share/glint") if os.path.exists(WHEEL) else os.path.dirname(os.path.dirname(PACKAGE))
DATA, SCHEMAS, SCRIPTS = (os.path.join(ROOT, name) for name in ("data", "schemas", "scripts"))
IS_INSTALLED = not os.path.exists(os.path.join(ROOT, "Makefile"))
BIN = os.path.normpath(os.path.join(ROOT, "../../bin" if IS_INSTALLED else os.environ.get("BUILD", "build") + "/bin"))
GLINT = os.path.join(BIN, "glint")
