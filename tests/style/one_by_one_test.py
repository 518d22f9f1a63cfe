"""A source of the compiler and the runtime can be compiled by itself, as most presets do, without what another source
of its unity build includes. Six are compiled, other ones whenever any source changes; with DASHPOT_LONG all, and
those of the tests as well. includes_test.py reads all of them each time."""
import argparse
import hashlib
import json
import os
import pathlib
import random
import re
import shlex
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
WITH_VALUE = {"-o", "-MT", "-MF"}
SAMPLE = 4


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


def sample_of(compilations):
    """Drawn by what all the sources say: the same ones from the same tree."""
    digest = hashlib.sha256(b"".join(source.read_bytes() for _, _, source in compilations)).hexdigest()
    return random.Random(digest).sample(compilations, SAMPLE)


class OneByOne(unittest.TestCase):
    commands = None

    def compilations(self, folders):
        """(command, folder, source) of each source in these folders that the build compiles beside others."""
        found = []
        for entry in json.loads(self.commands.read_text()):
            unity = pathlib.Path(entry["file"])
            if re.fullmatch(r"unity_\d+_cxx\.cxx", unity.name):
                command = looked_through(entry["command"], unity)
                found += [(command, entry["directory"], source) for source in map(pathlib.Path, sources_of(unity))
                          if any(source.is_relative_to(folder) for folder in folders)]
        return sorted(found, key=lambda compilation: compilation[2])

    # Fails if a source names what it does not include.
    def test_each_source_is_complete(self):
        everything = bool(os.environ.get("DASHPOT_LONG"))
        compilations = self.compilations([ROOT / "compiler", ROOT / "runtime"] + [ROOT / "tests"] * everything)
        self.assertGreater(len(compilations), 300)
        for command, folder, source in compilations if everything else sample_of(compilations):
            with self.subTest(source.relative_to(ROOT)):
                done = subprocess.run([*command, str(source)], cwd=folder, capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--commands", type=pathlib.Path, required=True, help="compile_commands.json of a unity build")
    known, others = parser.parse_known_args()
    OneByOne.commands = known.commands
    unittest.main(argv=[sys.argv[0], *others])
