"""Pictures by gnuplot, which gives every SVG the title "Gnuplot"."""
import subprocess
from xml.sax.saxutils import escape


def draw(terminal, commands, path, title):
    """Runs the commands for an SVG at a path, on a white ground; terminal has its size and font."""
    head = f'set terminal svg {terminal} background "#ffffff"\n'
    text = subprocess.check_output(["gnuplot", "-d"], input=head + commands, encoding="utf-8")
    with open(path, "w", encoding="utf-8", newline="\n") as file:
        file.write(text.replace("<title>Gnuplot</title>", f"<title>{escape(title)}</title>", 1))
