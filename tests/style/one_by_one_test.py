"""Every source of the compiler and the runtime can be compiled by itself, as most presets do, without what another
source of its unity build includes. With DASHPOT_LONG those of the tests as well."""
import argparse
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
WITH_VALUE = {"-o", "-MT", "-MF"}


def sources_of(unity):
    return re.findall(r'^#include "(/[^"]+)"', unity.read_text(), re.MULTILINE)


def looked_through(command, unity):
    """The command that compiles a unity source, without that source, and writing nothing."""
    words, left = iter(shlex.split(command)), []
    for word in words:
        if word in WITH_VALUE:
            next(words)
        elif word not in ("-c", "-MD", str(unity)):
            left.append(word)
    return left + ["-fsyntax-only"]


class OneByOne(unittest.TestCase):
    commands = None

    # Fails if a source names what it does not include.
    def test_each_source_is_complete(self):
        folders = [ROOT / "compiler", ROOT / "runtime"] + ([ROOT / "tests"] if os.environ.get("DASHPOT_LONG") else [])
        count = 0
        for entry in json.loads(self.commands.read_text()):
            unity = pathlib.Path(entry["file"])
            if not re.fullmatch(r"unity_\d+_cxx\.cxx", unity.name):
                continue
            command = looked_through(entry["command"], unity)
            for source in sources_of(unity):
                if any(pathlib.Path(source).is_relative_to(folder) for folder in folders):
                    count += 1
                    with self.subTest(source):
                        done = subprocess.run([*command, source], cwd=entry["directory"], capture_output=True,
                                              text=True)
                        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertGreater(count, 300)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--commands", type=pathlib.Path, required=True, help="compile_commands.json of a unity build")
    known, others = parser.parse_known_args()
    OneByOne.commands = known.commands
    unittest.main(argv=[sys.argv[0], *others])
