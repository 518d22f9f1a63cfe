"""Where a fault can be planted in a C++ file of this project, and what it would look like.

Kinds: an operator, a constant, a sign, a bound. Binary operators are told from templates and references by the blanks
that the house style sets around them."""
import dataclasses
import pathlib
import random
import re


@dataclasses.dataclass(frozen=True)
class Fault:
    file: str    # relative to the project
    line: int    # from 1
    column: int  # from 1
    kind: str
    before: str
    after: str

    def planted_in(self, text):
        lines = text.split("\n")
        line = lines[self.line - 1]
        assert line[self.column - 1:].startswith(self.before), self
        lines[self.line - 1] = line[:self.column - 1] + self.after + line[self.column - 1 + len(self.before):]
        return "\n".join(lines)


SWAPPED = {
    "operator": {" * ": " / ", " / ": " * ", " && ": " || ", " || ": " && ", " == ": " != ", " != ": " == ", "++": "--",
                 " *= ": " /= ", " |= ": " &= "},
    "sign": {" + ": " - ", " - ": " + ", " += ": " -= ", " -= ": " += "},
    "bound": {" < ": " <= ", " <= ": " < ", " > ": " >= ", " >= ": " > ", "std::min": "std::max",
              "std::max": "std::min"},
}
NEGATION = re.compile(r"(?<=[(,=?:{] )-(?=[\w(])|(?<=[({])-(?=[\w(])|(?<=return )-(?=[\w(])|(?<=[(\s])!(?=[\w(:])")
NUMBER = re.compile(r"(?<![\w.\"'])\d+(?:\.\d*)?(?:e[+-]?\d+)?(?:u|f)?(?![\w.\"'])")
# A comment, a string or a character: nothing in them is code.
HIDDEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.*?)\)"|"(?:\\.|[^"\\\n])*"|(?<!\d)\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
# Lines that are checked, or used, by the build and not by a test.
NOT_RUN = re.compile(r"^\s*(#|template|using |static_assert|namespace|friend )|\boperator\b")


def blanked(text):
    """The text with everything hidden replaced by blanks, place by place."""
    return HIDDEN.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def faults_in(file, text):
    found = []
    for number, line in enumerate(blanked(text).split("\n"), 1):
        if NOT_RUN.search(line):
            continue
        for kind, pairs in SWAPPED.items():
            for before, after in pairs.items():
                for match in re.finditer(re.escape(before), line):
                    found.append(Fault(file, number, match.start() + 1, kind, before, after))
        for match in NEGATION.finditer(line):
            found.append(Fault(file, number, match.start() + 1, "sign", match.group(), ""))
        for match in NUMBER.finditer(line):
            found.append(Fault(file, number, match.start() + 1, "constant", match.group(), other_number(match.group())))
    return found


def other_number(text):
    """One more of an integer; half as much again of another, so that no tolerance swallows it."""
    digits = text.rstrip("uf")
    suffix = text[len(digits):]
    if digits.isdigit():
        return str(int(digits) + 1) + suffix
    return repr(1.5 * float(digits) if float(digits) != 0 else 1.0) + suffix


def drawn(root, folders, seed):
    """All faults in the order in which they are to be planted: kinds in turn, and within a kind every place as
    likely."""
    root = pathlib.Path(root)
    kinds = {}
    for folder in folders:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".cpp", ".hpp"):
                for fault in faults_in(path.relative_to(root).as_posix(), path.read_text()):
                    kinds.setdefault(fault.kind, []).append(fault)
    draw = random.Random(seed)
    for faults in kinds.values():
        draw.shuffle(faults)
    while any(kinds.values()):
        for kind in sorted(kinds):
            if kinds[kind]:
                yield kinds[kind].pop()
