"""Packages that `dashpot compile --target python` writes, for the tests of this room.

The environment names what ctest knows: DASHPOT (the executable) and DASHPOT_SOURCE (this repository).
"""
import csv
import importlib
import itertools
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy

DASHPOT = os.environ["DASHPOT"]
SOURCE = pathlib.Path(os.environ["DASHPOT_SOURCE"])
NETWORKS = SOURCE / "networks"
FIG_5 = NETWORKS / "paper/second_order_maxwell.json"
TUNABLE = NETWORKS / "tunable/second_order_maxwell_tunable.json"
PANTOGRAPH = SOURCE / "runtime/devices/pantograph_brake_2009.json"
_numbers = itertools.count()


def dashpot(*words, status=0, **environment):
    done = subprocess.run([DASHPOT, *map(str, words)], capture_output=True, text=True,
                          env={**os.environ, **environment})
    assert done.returncode == status, f"dashpot {words} ended with {done.returncode}:\n{done.stderr}"
    return done


class PackageTest(unittest.TestCase):
    """Each test in a folder of its own."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def emitted(self, network, *choices):
        """The imported package of a network."""
        parent = self.folder / f"emitted{next(_numbers)}"
        dashpot("compile", network, "--target", "python", "-o", parent, *choices)
        (package,) = parent.iterdir()
        sys.path.insert(0, str(parent))
        self.addCleanup(sys.path.remove, str(parent))
        sys.modules.pop(package.name, None)
        importlib.invalidate_caches()
        module = importlib.import_module(package.name)
        del sys.modules[package.name]
        self.assertEqual(pathlib.Path(module.__file__), package / "__init__.py")
        return module

    def simulated(self, network, columns, *choices):
        """What the compiler's own account of the law prints, as columns."""
        table = self.folder / f"motion{next(_numbers)}.csv"
        with open(table, "w") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(columns)
            writer.writerows(zip(*(map(repr, map(float, values)) for values in columns.values())))
        printed = dashpot("simulate", network, "--input", table, *choices).stdout
        rows = list(csv.DictReader(printed.splitlines()))
        return {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}


def motion(rows=400, size=2e-3, seed=5):
    """Moves of all sizes, rests and ways back, as a recording has them."""
    random = numpy.random.default_rng(seed)
    steps = random.standard_normal(rows) * 10 ** random.uniform(-7, -4, rows)
    steps[rows // 3:rows // 2] = 0
    return numpy.cumsum(steps) + size * numpy.sin(numpy.linspace(0, 9, rows)) * (numpy.arange(rows) > 20)
