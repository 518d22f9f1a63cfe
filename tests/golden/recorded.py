"""Texts that were reviewed once, each in a file of a folder, compared with what they are now.

A difference is shown as a diff and fails; --update writes them anew, for review in the version control's own diff.
"""
import argparse
import difflib
import json
import pathlib
import sys

# Of a network file: what its text says, but not what it is.
WORDS = {"name", "title", "source", "nodes"}


def shape(value):
    """A network file without its numbers and names."""
    if isinstance(value, dict):
        return tuple(sorted((key, shape(inner)) for key, inner in value.items() if key not in WORDS))
    return tuple(map(shape, value)) if isinstance(value, list) else ()


def one_a_shape(networks):
    """The first network file of each shape: of the others the same is said with other numbers, and those are in
    generated/."""
    return list({shape(json.loads(path.read_text())): path for path in reversed(networks)}.values())[::-1]


def differs(folder, name, text):
    path = folder / f"{name}.txt"
    recorded = path.read_text() if path.exists() else ""
    diff = difflib.unified_diff(recorded.splitlines(True), text.splitlines(True), f"recorded/{path.name}",
                                f"now/{path.name}")
    sys.stdout.writelines(diff)
    return text != recorded


def record(folder, texts):
    folder.mkdir(exist_ok=True)
    for path in folder.glob("*.txt"):
        if path.stem not in texts:
            path.unlink()
    for name, text in texts.items():
        (folder / f"{name}.txt").write_text(text)


def compare(folder, texts):
    """Whether all are as recorded, and nothing else is there."""
    left_over = sorted({path.stem for path in folder.glob("*.txt")} - set(texts))
    for name in left_over:
        print(f"{folder.name}/{name}.txt belongs to nothing")
    changed = [name for name, text in texts.items() if differs(folder, name, text)]
    if changed or left_over:
        print("if this is meant, run this test again with --update and review the change")
    return not changed and not left_over


def main(description, folder, texts_of):
    """`texts_of` makes, of the path of the executable, a dictionary from names to texts. Returns the exit status."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dashpot", type=pathlib.Path, required=True)
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()
    texts = texts_of(options.dashpot.resolve())
    if options.update:
        record(folder, texts)
        return 0
    return 0 if compare(folder, texts) else 1
