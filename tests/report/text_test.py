"""What the pages of `dashpot report` say, as text, compared with what they said when somebody last looked.

    python3 text_test.py --dashpot build/compiler/dashpot [--update]

Each file of texts/ is the page of one network of each shape without its style, scripts and live part: a line for each
block of the page, labels of drawings and plots included, curves not. A difference is shown as a diff and fails;
--update writes them anew.
"""
import html.parser
import os
import pathlib
import re
import subprocess
import sys
import tempfile

TEXTS = pathlib.Path(__file__).parent / "texts"
SOURCE = TEXTS.parents[2]
sys.path.insert(0, str(SOURCE / "tests/golden"))
import recorded

PANTOGRAPH = "runtime/devices/pantograph_brake_2009.json"
BLOCKS = {"p", "h1", "h2", "h3", "h4", "tr", "li", "dt", "figcaption", "svg", "section", "header", "option"}
BETWEEN = {"td", "th", "dd", "text"}
LEFT_OUT = {"style", "script", "footer"}
EMPTY = {"meta", "link", "input", "br", "img"}


class Text(html.parser.HTMLParser):
    """Collects the page's words into lines."""

    def __init__(self):
        super().__init__()
        self.text = ""
        self._skipped = 0  # depth below what is left out

    def handle_starttag(self, tag, attributes):
        if tag in EMPTY:
            return
        if self._skipped or tag in LEFT_OUT or (tag == "section" and dict(attributes)["id"] == "live"):
            self._skipped += 1
        elif tag in BLOCKS or (tag == "math" and "display" in dict(attributes)):
            self.text += "\n"
        elif tag in BETWEEN:
            self.text += " | "

    def handle_endtag(self, tag):
        self._skipped -= self._skipped > 0

    def handle_data(self, data):
        if not self._skipped:
            self.text += data.replace("\n", " ")


def text_of(page):
    reader = Text()
    reader.feed(page)
    lines = (re.sub(r" +", " ", line).strip() for line in reader.text.split("\n"))
    return "".join(line + "\n" for line in lines if line)


def wanted():
    """From the name of each text to the arguments behind `dashpot report`."""
    of_one_axis = [path for path in sorted(SOURCE.glob("networks/*/*.json")) if path.parent.name != "axes"]
    networks = recorded.one_a_shape(sorted(SOURCE.glob("networks/paper/*.json")) + of_one_axis)
    arguments = {path.stem: [path.relative_to(SOURCE)] for path in networks}
    for path in sorted(SOURCE.glob("networks/axes/*.json")):
        arguments[path.stem] = [path.relative_to(SOURCE), "--device", "runtime/devices/pantograph_2dof.json"]
    return {**arguments, "with_a_device": ["networks/paper/second_order_maxwell.json", "--device", PANTOGRAPH]}


def page_of(dashpot, arguments):
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "report.html"
        # The live part is left out anyway, and the compiler for it takes longer than everything else.
        subprocess.run([dashpot, "report", *map(str, arguments), "-o", page], cwd=SOURCE, check=True,
                       stderr=subprocess.DEVNULL,
                       timeout=60, env={**os.environ, "DASHPOT_CLANG": "/nowhere"})
        return page.read_text()


def texts_of(dashpot):
    return {name: text_of(page_of(dashpot, arguments)) for name, arguments in wanted().items()}


if __name__ == "__main__":
    sys.exit(recorded.main(__doc__, TEXTS, texts_of))
