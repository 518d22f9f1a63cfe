"""Every source and header of the compiler and the runtime includes, directly or not, what declares the project's own
names that it uses. ./check compiles several sources at once, where one can lean on what another includes.

The text is read, not compiled: it takes seconds for all files and finds nine in ten of the includes whose removal the
compiler refuses. A name that a member or a local variable has as well is passed over. one_by_one_test.py compiles.
"""
import functools
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("compiler", "runtime")
NOT_CODE = re.compile(r'R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|//[^\n]*|/\*.*?\*/'
                      r"|^#[^\n]*", re.DOTALL | re.MULTILINE)
INCLUDED = re.compile(r'^#include [<"]([^>"]+)[>"]', re.MULTILINE)
# What a file declares for others begins its line.
TYPE = re.compile(r"^(?:(?:struct|class|union|enum(?: class)?) |using )(\w+)\b(?! *::)", re.MULTILINE)
CONSTANT = re.compile(r"^(?:inline |static |extern )*(?:constexpr|const) [\w:<>,&* ]+?[ &*](\w+)"
                      r"(?:\[[^\]]*\])?(?: =|\{|;)", re.MULTILINE)
FUNCTION = re.compile(r"^(?!return\b|using\b|namespace\b)[A-Za-z_][\w:<>,&*\[\] ]*?[ &*>](\w+)\(", re.MULTILINE)
# A name that is used: alone or behind the project's namespaces, not a member; and what follows it.
USED = re.compile(r"(?<![\w.:>])(?:dashpot(?:_check)?::(?:\w+::)*)?([A-Za-z_]\w+)\b( *[(<]?)")
# A member, a variable, a parameter: a name behind a type.
NEARER = re.compile(r"(?:[\w>&*\].] *[ &*](?=\w+ *[({=;,):>\[])|, (?=\w+\{))(\w+)")
ENUMERATORS = re.compile(r"\benum [^{;]*\{([^}]*)\}")
OF_LIBRARIES = {"abs", "acos", "atan2", "cos", "exp", "hypot", "log", "max", "min", "sin", "sqrt", "write"}


@functools.cache
def code_of(path):
    return NOT_CODE.sub(lambda found: "\n" * found.group().count("\n"), path.read_text())


@functools.cache
def own_files():
    return tuple(path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*"))
                 if path.suffix in (".hpp", ".cpp", ".h"))


@functools.cache
def by_ending():
    """Every ending of a file's path, to the files that have it."""
    found = {}
    for path in own_files():
        parts = path.relative_to(ROOT).parts
        for first in range(len(parts)):
            found.setdefault("/".join(parts[first:]), []).append(path)
    return found


@functools.cache
def includes_of(path):
    return frozenset(target for name in INCLUDED.findall(path.read_text()) for target in by_ending().get(name, ()))


def reached_from(path):
    """The file and all that it includes, directly or by what it includes."""
    reached, ahead = set(), [path]
    while ahead:
        file = ahead.pop()
        if file not in reached:
            reached.add(file)
            ahead += includes_of(file)
    return reached


@functools.cache
def declared_in(path):
    """Types and constants, and functions, that the file declares for others."""
    code = code_of(path)
    return frozenset(TYPE.findall(code) + CONSTANT.findall(code)), frozenset(FUNCTION.findall(code))


@functools.cache
def nearer_in(path):
    code = re.sub(r"\b(?:return|throw|case|else)\b", ";", code_of(path))
    return frozenset(NEARER.findall(code)).union(*(re.findall(r"\w+", names) for names in ENUMERATORS.findall(code)))


@functools.cache
def declarations():
    """Each name, to the files that declare it."""
    found = {}
    for path in own_files():
        if path.suffix == ".cpp":
            continue
        for name in (declared_in(path)[0] | declared_in(path)[1]) - OF_LIBRARIES:
            found.setdefault(name, set()).add(path)
    return found


def missing_in(path):
    """(name, line, files that declare it) of each own name that the file uses and does not reach."""
    reached = reached_from(path)
    nearer = frozenset().union(*(nearer_in(file) for file in reached))
    missing, code, seen = [], code_of(path), set()
    for found in USED.finditer(code):
        name = found[1]
        files = declarations().get(name)
        if files is None or name in seen or files & reached or name in nearer:
            continue
        is_plain = name.isalpha() and name.islower()  # as many local names are
        if (is_plain or not any(name in declared_in(file)[0] for file in files)) and found[2].strip() != "(":
            continue
        seen.add(name)
        missing.append((name, code.count("\n", 0, found.start()) + 1, sorted(files)))
    return missing


class Includes(unittest.TestCase):
    # Fails if a file uses one of the project's names without including, by whatever way, what declares it.
    def test_each_file_reaches_the_names_that_it_uses(self):
        self.assertGreater(len(own_files()), 700)
        for path in own_files():
            with self.subTest(path.relative_to(ROOT)):
                told = [f"line {line}: {name}, of {' or '.join(str(file.relative_to(ROOT)) for file in files)}"
                        for name, line, files in missing_in(path)]
                self.assertEqual(told, [])


if __name__ == "__main__":
    unittest.main()
