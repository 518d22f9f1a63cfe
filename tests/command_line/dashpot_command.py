"""The dashpot command as a shell sees it, for the tests of this room.

The environment names what ctest knows: DASHPOT (the executable) and DASHPOT_SOURCE (this repository).
"""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

DASHPOT = os.environ["DASHPOT"]
SOURCE = pathlib.Path(os.environ["DASHPOT_SOURCE"])
FIG_5 = SOURCE / "networks/paper/second_order_maxwell.json"
PANTOGRAPH = SOURCE / "runtime/devices/pantograph_brake_2009.json"

DONE, INPUT_REFUSED, COMMAND_LINE_WRONG, DEFECT = range(4)


def network(structure, name="sample", more=""):
    """A network file around `structure`, the value of its key "network"."""
    return f'{{ "dashpot": 1, "name": "{name}", {more} "network": {structure} }}\n'


KELVIN = network('{ "parallel": [ { "spring": 100 }, { "damper": 5 } ] }', "kelvin")
MAXWELL = network('{ "series": [ { "spring": 50 }, { "damper": 5 } ] }', "maxwell")
BROKEN = network('{ "spring": "-1 N/m" }', "broken")


class CommandTest(unittest.TestCase):
    """Each test in a folder of its own, which is also the working folder of the command."""
    explained_before = {}  # what `explain` says of the project's own files, which no test changes

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def files(self, folder="."):
        """Everything below, as relative paths."""
        root = self.folder / folder
        return sorted(str(path.relative_to(root)) for path in root.rglob("*") if path.is_file())

    def dashpot(self, *arguments, status=DONE, cwd=None, **more):
        words = tuple(map(str, arguments))
        own_files = [word for word in words
                     if (self.folder / word).is_relative_to(self.folder) and (self.folder / word).exists()]
        is_said_once = words[:1] == ("explain",) and not own_files and not cwd and not more
        done = self.explained_before.get(words) if is_said_once else None
        if done is None:
            done = subprocess.run([DASHPOT, *words], cwd=cwd or self.folder, capture_output=True, text=True,
                                  timeout=60, **more)
        if is_said_once:
            self.explained_before[words] = done
        if status is not None:
            self.assertEqual(done.returncode, status, f"{arguments}\n{done.stdout}{done.stderr}")
        return done

    def refused(self, *arguments, code, status=INPUT_REFUSED):
        """Runs, and expects the diagnostic [code] on standard error and nothing on standard output."""
        done = self.dashpot(*arguments, status=status)
        self.assertIn(f"[{code}]", done.stderr, arguments)
        self.assertEqual(done.stdout, "")
        return done

    def failed_in_c(self, name, right, wrong):
        """What the law's test says of its header with something wrong in it, which is put right again."""
        header = self.folder / f"{name}.h"
        text = header.read_text()
        self.assertIn(right, text)
        header.write_text(text.replace(right, wrong))
        said = self.run_in_c(name)
        header.write_text(text)
        self.assertIn("failed", said)
        return said

    def run_in_c(self, name):
        program = self.folder / "law_test"
        subprocess.run(["cc", "-std=c99", "-ffp-contract=off", "-o", program, self.folder / f"{name}_test.c", "-lm"],
                       check=True)
        return subprocess.run([program], capture_output=True, text=True).stdout


def codes(text):
    """The codes of all diagnostics in a text, in order."""
    return re.findall(r"(?m)^\S.*: (?:error|warning): .* \[([a-z0-9-]+)\]$", text)
