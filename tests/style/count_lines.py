#!/usr/bin/env python3
"""Counts lines of code, and the lines that decide by the kind of a network, in one commit or side by side in two.

    tests/style/count_lines.py [BEFORE] [AFTER] [--list tunable|contact|networked]

Both default to the files as they are now. Counted are the .cpp, .hpp and .def files of compiler/ and runtime/,
formatted by the .clang-format of today, whatever they looked like in their commit, so that a line means the same before
and after. A line of code holds more than blanks and comments. A line decides by a kind of network if it has a condition
(if, while, ?:, &&, ||, get_if, holds_alternative) and a name that tells the kind, strings and comments aside. That is a
measure, not a proof: a name that is chosen badly escapes it, and one condition over two lines counts twice.
"""
import argparse
import io
import pathlib
import re
import subprocess
import sys
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("compiler", "runtime")
SUFFIXES = (".cpp", ".hpp", ".def")

KINDS = {
    "tunable": re.compile(r"tunable", re.IGNORECASE),
    "contact": re.compile(r"contact|touched|touching|surface", re.IGNORECASE),
    "networked": re.compile(r"networked|coupl(ed|ing)|slip_?network|\bnetworks\b|\bmeshed", re.IGNORECASE),
}
CONDITION = re.compile(r"\bif\b|\?|&&|\|\||\bwhile\b|\bget_if\b|\bholds_alternative\b")
RAW_STRING = re.compile(r'R"(\w*)\(.*?\)\1"', re.DOTALL)
STRING = re.compile(r'"(?:\\.|[^"\\\n])*"')
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def files_of(commit):
    """Paths and texts: of a commit, or of the files as they are if none is named."""
    if commit is None:
        for folder in FOLDERS:
            for path in sorted((ROOT / folder).rglob("*")):
                if path.suffix in SUFFIXES:
                    yield path.relative_to(ROOT).as_posix(), path.read_text()
        return
    archive = subprocess.run(["git", "-C", ROOT, "archive", commit, *FOLDERS], capture_output=True)
    if archive.returncode != 0:
        sys.exit(f"git knows no commit '{commit}' with {' and '.join(FOLDERS)}: {archive.stderr.decode().strip()}")
    with tarfile.open(fileobj=io.BytesIO(archive.stdout)) as tar:
        for member in tar:
            if member.isfile() and member.name.endswith(SUFFIXES):
                yield member.name, tar.extractfile(member).read().decode()


def formatted(files):
    """The same paths with their texts as clang-format leaves them."""
    with tempfile.TemporaryDirectory(prefix="count_lines") as name:
        folder = pathlib.Path(name)
        for path, text in files:
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(text)
        paths = sorted(path for path in folder.rglob("*") if path.is_file())
        subprocess.run(["clang-format", "-i", f"--style=file:{ROOT / '.clang-format'}", *paths], check=True)
        return {path.relative_to(folder).as_posix(): path.read_text() for path in paths}


def code_lines(text):
    """Its lines with line numbers from 1, without comments and what stands in strings; empty ones left out."""
    def keep_lines(match):
        return '""' + "\n" * match.group().count("\n")
    text = RAW_STRING.sub(keep_lines, text)
    text = re.sub(rf"({STRING.pattern})|({COMMENT.pattern})",
                  lambda m: '""' if m.group(1) else "\n" * m.group().count("\n"), text, flags=re.DOTALL)
    return [(number, line.strip()) for number, line in enumerate(text.split("\n"), 1) if line.strip()]


def deciding_lines(files, kind):
    return [(path, number, line) for path, text in files.items() for number, line in code_lines(text)
            if CONDITION.search(line) and KINDS[kind].search(line)]


def counts(files):
    result = {}
    for folder in FOLDERS:
        result[f"lines of code in {folder}/"] = sum(
            len(code_lines(text)) for path, text in files.items() if path.startswith(f"{folder}/"))
    result["lines of code"] = sum(result.values())
    for kind in KINDS:
        lines = deciding_lines(files, kind)
        result[f"conditional lines on '{kind}'"] = len(lines)
        result[f"  files with one, '{kind}'"] = len({path for path, _, _ in lines})
    return result


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("before", nargs="?")
    arguments.add_argument("after", nargs="?")
    arguments.add_argument("--list", choices=KINDS, help="print the lines instead, of the first commit")
    given = arguments.parse_args()
    before = formatted(files_of(given.before))
    if given.list:
        for path, number, line in deciding_lines(before, given.list):
            print(f"{path}:{number}: {line}")
        return
    first, second = counts(before), counts(formatted(files_of(given.after))) if given.before else None
    for name, count in first.items():
        print(f"{name:38}{count:8}" + (f"{second[name]:8}{second[name] - count:+8}" if second else ""))


if __name__ == "__main__":
    main()
