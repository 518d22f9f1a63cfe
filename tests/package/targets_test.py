"""What the target dashpot_installed builds is all that an installation copies.

DASHPOT_BUILD names a build folder of Ninja.
"""
import os
import pathlib
import re
import subprocess
import unittest

BUILD = pathlib.Path(os.environ["DASHPOT_BUILD"])
INSTALLED = re.compile(r'TYPE (?:STATIC_LIBRARY|EXECUTABLE) FILES "([^"]+)"')


class InstalledTargetTest(unittest.TestCase):

    # If this fails, `./try --install` finds a file missing that nothing has built.
    def test_every_installed_program_and_library_is_built(self):
        commands = subprocess.run(["ninja", "-C", BUILD, "-t", "commands", "dashpot_installed"],
                                  check=True, capture_output=True, text=True).stdout.split()
        built = {(BUILD / word).resolve() for word in commands}
        installed = {pathlib.Path(file).resolve() for script in BUILD.rglob("cmake_install.cmake")
                     for file in INSTALLED.findall(script.read_text())}
        self.assertGreater(len(installed), 4)
        self.assertEqual(sorted(installed - built), [])


if __name__ == "__main__":
    unittest.main()
