"""Holds every own source to .clang-format and to its 120 columns, the names of C++ tests to one style, and code
that asks of what kind an element is to one way.

    python3 format_test.py

Comments that clang-format does not wrap, and a string that nobody has broken, can be longer: they fail here, as lines
of Python do. What stands in a raw string, or in one of several lines, is left as it is written: a network in a test
reads best in its own lines.
"""
import ast
import io
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tokenize
import unicodedata
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = 120
TEST_NAME = re.compile(r"^(?:TYPED_)?TEST(?:_[FP])?\((.+?),\s*(\w+)\)", re.MULTILINE)
RAW_STRING = re.compile(r'R"(\w*)\(.*?\)\1"', re.DOTALL)


def sources():
    """C++ of the project's own, and its messages; generated/ looks as the compiler writes it."""
    return [path for folder in ("compiler", "examples", "runtime", "tests")
            for path in sorted((ROOT / folder).rglob("*"))
            if path.suffix in {".cpp", ".hpp", ".def"}]


def clang_format():
    """The distribution's version: another one breaks lines elsewhere."""
    for name in ("clang-format-14", "clang-format"):
        found = shutil.which(name)
        if found and " 14." in subprocess.run([found, "--version"], capture_output=True, text=True).stdout:
            return found
    sys.exit("the format test needs clang-format 14 (Debian: clang-format)")


def columns(line):
    """As many as an editor shows: a dot above a letter takes none of its own."""
    return sum(not unicodedata.combining(character) for character in line)


def raw_string_lines(text):
    """Numbers of the lines that hold a part of a raw string."""
    return {number for match in RAW_STRING.finditer(text)
            for number in range(text.count("\n", 0, match.start()) + 1, text.count("\n", 0, match.end()) + 2)}


def python_sources():
    return [path for folder in ("compiler", "examples", "runtime", "tests")
            for path in sorted((ROOT / folder).rglob("*.py"))]


def python_text_lines(text):
    """Numbers of the lines that hold a part of a string of several lines, but for docstrings."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    docstrings = {node.body[0].lineno for node in ast.walk(ast.parse(text))
                  if isinstance(node, documented) and isinstance(node.body[0], ast.Expr)}
    return {number for token in tokenize.generate_tokens(io.StringIO(text).readline)
            if token.type == tokenize.STRING and token.start[0] not in (token.end[0], *docstrings)
            for number in range(token.start[0], token.end[0] + 1)}


class Style(unittest.TestCase):
    # Fails if a source is not as clang-format leaves it.
    def test_format(self):
        program = clang_format()
        done = subprocess.run([program, "--dry-run", "-Werror", *sources()], cwd=ROOT, capture_output=True, text=True)
        complaints = re.findall(r"^(.+?):\d+:\d+: error:", done.stderr, re.MULTILINE)
        if done.returncode != 0 or complaints:
            files = sorted({pathlib.Path(name).resolve().relative_to(ROOT).as_posix() for name in complaints})
            self.fail(f"{len(files)} files are not as clang-format leaves them; this mends them:\n\n"
                      f"  {shlex.join([program, '-i', *files])}\n" + ("" if files else done.stderr))

    # Fails if a line has to be scrolled to be read.
    def test_columns(self):
        longer = []
        for path in [*sources(), *python_sources()]:
            text = path.read_text()
            as_written = python_text_lines(text) if path.suffix == ".py" else raw_string_lines(text)
            longer += [f"{path.relative_to(ROOT)}:{number}: {columns(line)} columns"
                       for number, line in enumerate(text.split("\n"), 1)
                       if columns(line) > COLUMNS and number not in as_written]
        self.assertEqual(longer, [], f"lines longer than {COLUMNS} columns")

    # Fails if code asks of an element's kind in a way that a new kind passes in silence.
    def test_kinds_of_elements(self):
        asked = re.compile(r"\b(?:get_if|holds_alternative|get)<\s*(?:Spring|Damper|Slip)\s*>")
        found = [path.relative_to(ROOT).as_posix() for path in sources()
                 if "tests" not in path.parts and asked.search(path.read_text())]
        self.assertEqual(found, [], "match() of compiler/network/element.hpp asks for every kind")

    # Fails if a test of C++ is called in another style: words joined by their capitals, as GoogleTest asks for.
    def test_names_of_tests(self):
        templates = sorted((ROOT / "templates").rglob("*.in"))
        names = [(path, match.group(2)) for path in [*sources(), *templates]
                 for match in TEST_NAME.finditer(path.read_text())]
        self.assertGreater(len(names), 1000)
        others = [f"{path.relative_to(ROOT)}: {name}" for path, name in names
                  if not re.fullmatch(r"[A-Z][A-Za-z0-9]*", name)]
        self.assertEqual(others, [])


if __name__ == "__main__":
    unittest.main()
