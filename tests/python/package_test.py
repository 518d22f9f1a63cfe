"""What --target python writes: the law's bits, no copies, and what it does with what it cannot take."""
import math
import re
import subprocess
import sys
import tracemalloc
import unittest
import warnings

import numpy

from emitted import DASHPOT, FIG_5, NETWORKS, PANTOGRAPH, TUNABLE, PackageTest, dashpot, motion

COLUMNS = ["velocity", "force", "damping", "motor_force"]
SLIPS = '{ "dashpot": 1, "name": "slipping", "network": { "parallel": [ { "spring": 200 }, { "damper": 3 }, ' \
        '{ "series": [ { "spring": 900 }, { "slip": 0.4 } ] } ] } }'


class Bits(PackageTest):
    def check(self, network, *choices, velocity=False, values=None, only_compile=()):
        module = self.emitted(network, *choices, *only_compile)
        position = motion()
        columns = {"time": numpy.arange(len(position)) / module.RATE, "position": position}
        if velocity:
            columns["velocity"] = motion(seed=8)
        wanted = self.simulated(network, {**columns, **(values or {})}, *choices)
        response = module.Law().simulate(position, columns.get("velocity"), values=values)
        # shortest digits of a float are not those of a double
        exact = numpy.float32 if module.SCALAR == "float" else numpy.float64
        for name in COLUMNS:
            numpy.testing.assert_array_equal(exact(getattr(response, name)), exact(wanted[name]), f"{network} {name}")
        self.assertGreater(numpy.max(numpy.abs(response.force)), 0)

    def test_paper(self):
        """Fails if a bit of the paper's networks differs from what `dashpot simulate` computes, in double or in
        float."""
        for network in sorted((NETWORKS / "paper").glob("*.json")):
            self.check(network)
        for name in ["second_order_maxwell", "maxwell_slip_ten", "virtual_wall"]:
            self.check(NETWORKS / f"paper/{name}.json", "--scalar", "float")

    def test_slips(self):
        """Fails likewise for a network with a slip."""
        slips = self.folder / "slips.json"
        slips.write_text(SLIPS)
        for scalar in ["double", "float"]:
            self.check(slips, "--scalar", scalar, velocity=True)

    def test_tunables(self):
        """Fails if parameters that change while it runs reach the law later, earlier or other than a column's do."""
        module = self.emitted(TUNABLE)
        random = numpy.random.default_rng(3)
        values = {}
        for name, parameter in module.parameters.items():
            steps = random.uniform(parameter.min, parameter.max, 20)
            values[name] = numpy.repeat(steps, 20)
        for scalar in ["double", "float"]:
            self.check(TUNABLE, "--scalar", scalar, values=values)

    def test_device(self):
        """Fails if the law is not that of the device, at its rate, or does not say so."""
        self.check(FIG_5, "--device", PANTOGRAPH, only_compile=["--uncertified"])
        module = self.emitted(FIG_5, "--device", PANTOGRAPH, "--uncertified")
        self.assertEqual((module.DEVICE, module.RATE), ("pantograph_brake_2009", 10000))
        self.assertTrue(module.DEVICE_DIGEST)
        self.assertIs(module.IS_CERTIFIED, True)
        self.assertIs(self.emitted(NETWORKS / "paper/virtual_wall.json").IS_CERTIFIED, False)


class Package(PackageTest):
    def test_is_self_contained(self):
        """Fails if the package needs a file that is not in it, or leaves one beside it."""
        dashpot("compile", FIG_5, "--target", "python", "-o", self.folder)
        written = sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*") if path.is_file())
        self.assertEqual(written, [f"second_order_maxwell/{name}" for name in
                                   ["__init__.py", "explain.json", "law.c", "law.so", "second_order_maxwell.h"]])

    def test_explain(self):
        """Fails if the dictionary is not what `dashpot explain --json` says."""
        import json
        for choices in [[], ["--device", str(PANTOGRAPH), "--uncertified"]]:
            module = self.emitted(FIG_5, *choices)
            self.assertEqual(module.explain(), json.loads(dashpot("explain", FIG_5, "--json",
                                                                  *[c for c in choices
                                                                    if c != "--uncertified"]).stdout))

    def test_steps(self):
        """Fails if single steps, runs in pieces, copies and resets are not the run as a whole."""
        module = self.emitted(FIG_5)
        position = motion(100)
        whole = module.Law().simulate(position)
        law = module.Law()
        for row, (place, velocity) in enumerate(zip(position, whole.velocity)):
            self.assertEqual(law.step(place, velocity), (whole.damping[row], whole.motor_force[row]))
        energy = law.stored_energy
        self.assertGreater(energy, 0)
        other = law.copy()
        law.reset(1.0)
        self.assertEqual(other.stored_energy, energy)
        law.reset()
        first = law.simulate(position[:50], whole.velocity[:50])
        second = law.simulate(position[50:], whole.velocity[50:], start=None)
        numpy.testing.assert_array_equal(numpy.concatenate([first.force, second.force]), whole.force)
        self.assertEqual(law.stored_energy, energy)
        self.assertEqual(law.kept_share, 1)
        self.assertEqual(law.step(math.nan, 0).force, 0)
        self.assertEqual(law.stored_energy, energy)

    def test_no_copies(self):
        """Fails if an array is copied that could be read where it is: a column of a table, every other row, floats."""
        module = self.emitted(FIG_5)
        rows = 200000
        table = numpy.zeros((rows, 3))
        table[:, 1] = motion(rows)
        single = numpy.float32(table[:, 1])
        law = module.Law()
        for position, velocity in [(table[:, 1], None), (table[:, 1], table[:, 2]), (table[::2, 1], table[::2, 2]),
                                   (table[::-1, 1], None), (single, single[::-1]),
                                   (numpy.ascontiguousarray(table[:, 1]), numpy.ascontiguousarray(table[:, 2]))]:
            for out in [None, law.simulate(position, velocity)]:
                tracemalloc.start()
                response = law.simulate(position, velocity, out=out)
                _, peak = tracemalloc.get_traced_memory()
                tracemalloc.stop()
                self.assertLess(peak, (0 if out else 4 * 8 * len(position)) + 20000)
                if out:
                    self.assertIs(response, out)
            alone = module.Law().simulate(numpy.array(position, numpy.float64),
                                          None if velocity is None else numpy.array(velocity, numpy.float64))
            numpy.testing.assert_array_equal(response.force, alone.force)
        numpy.testing.assert_array_equal(law.simulate([0, 1, 2]).velocity, [0, 1000, 1000])

    def test_set(self):
        """Fails if set() changes what it is not asked to change, or changes anything where it refuses."""
        module = self.emitted(TUNABLE)
        law = module.Law()
        first = {name: parameter.value for name, parameter in module.parameters.items()}
        self.assertEqual(law.parameters, first)
        name, *others = first
        parameter = module.parameters[name]
        law.set(**{name: parameter.max})
        self.assertEqual(law.parameters, {**first, name: parameter.max})
        law.reset()
        self.assertEqual(law.parameters[name], parameter.max)
        for wrong in [parameter.max * 1.01, parameter.min - 1, math.nan, math.inf]:
            with self.assertRaisesRegex(ValueError, re.escape(f"{name} is from {parameter.min:g} to")):
                law.set(**{others[0]: module.parameters[others[0]].min, name: wrong})
        self.assertEqual(law.parameters, {**first, name: parameter.max})
        with self.assertRaisesRegex(TypeError, "has no parameter 'elasticity'; it has " + name):
            law.set(elasticity=1)
        with self.assertRaises(TypeError):
            law.set(**{name: "soft"})
        with self.assertRaisesRegex(ValueError, f"{name} is from"):
            law.simulate(numpy.zeros(3), values={name: [parameter.min, parameter.max, math.nan]})
        for scalar in ["double", "float"]:
            module = self.emitted(TUNABLE, "--scalar", scalar)
            for name, parameter in module.parameters.items():  # both ends are in
                module.Law().set(**{name: parameter.min})
                module.Law().set(**{name: parameter.max})
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                with self.assertRaisesRegex(ValueError, f"{name} is from"):
                    module.Law().set(**{name: 1e300})

    def test_a_parameter_called_self(self):
        """Fails if a parameter that is called like Python's first argument cannot be set."""
        network = self.folder / "own.json"
        network.write_text('{ "dashpot": 1, "name": "own", "network": { "spring": "self" }, "parameters": { "self": '
                           '{ "value": "2 N/m", "tunable": true, "min": "1 N/m", "max": "3 N/m" } } }')
        law = self.emitted(network).Law()
        law.set(self=2.5)
        self.assertEqual(law.parameters, {"self": 2.5})

    def test_wrong_arrays(self):
        """Fails if rows that do not fit are read or written beyond their end, or NaN passes for a number."""
        law = self.emitted(FIG_5).Law()
        with self.assertRaisesRegex(ValueError, "position has 2 dimensions"):
            law.simulate(numpy.zeros((3, 2)))
        with self.assertRaisesRegex(ValueError, "velocity has 2 rows, and position 3"):
            law.simulate(numpy.zeros(3), numpy.zeros(2))
        with self.assertRaises((ValueError, TypeError)):
            law.simulate(["here", "there"])
        good = law.simulate(numpy.zeros(3))
        for wrong in [numpy.zeros(2), numpy.zeros(6)[::2], numpy.zeros(3, numpy.float32), [0.0] * 3]:
            with self.assertRaisesRegex(ValueError, "out.force is no writable array of 3 float64"):
                law.simulate(numpy.zeros(3), out=good._replace(force=wrong))
        position = numpy.zeros(3)
        with self.assertRaisesRegex(ValueError, "out.damping shares memory"):
            law.simulate(position, out=good._replace(damping=position))
        self.assertEqual(len(law.simulate([]).force), 0)
        with self.assertRaisesRegex(TypeError, "none of its numbers is tunable"):
            law.set(k=1)

    def test_two_laws_in_one_program(self):
        """Fails if packages with the same functions in their libraries call each other's."""
        one, other = self.emitted(FIG_5), self.emitted(FIG_5, "--set", "K1=1", "--name", "softer")
        self.assertNotEqual(one.Law().simulate([0, 1e-3])[1][1], other.Law().simulate([0, 1e-3])[1][1])


class Refusals(PackageTest):
    def refused(self, *words, code, status=1, **environment):
        done = dashpot("compile", *words, "--target", "python", "-o", self.folder / "out", status=status, **environment)
        self.assertIn(code, done.stderr)
        self.assertFalse((self.folder / "out").exists(), "half-written")
        return done.stderr

    def test_names(self):
        """Fails if a package takes the place of a module that Python or NumPy imports, or of a word."""
        for name in ["numpy", "json", "lambda", "random", "None", "zoneinfo", "abc"]:
            self.refused(FIG_5, "--name", name, code="[name-is-word-of-python]")
        self.emitted(FIG_5, "--name", "numpys")
        for name in ["law", "law_step", "column", "put", "run_arrays", "values"]:  # as its own source might
            self.emitted(FIG_5, "--name", name)

    def test_compiler(self):
        """Fails if a missing or failing C compiler is not said, with what would do, or leaves files."""
        self.assertIn("CC names another", self.refused(FIG_5, code="'/nowhere/cc' does not compile", CC="/nowhere/cc"))
        for does_nothing in ("/bin/false", "/bin/true"):
            self.refused(FIG_5, code="[system-compiler-failed]", CC=does_nothing)

    def test_folder(self):
        """Fails if a folder that cannot be written is found out when something is written already."""
        (self.folder / "file").write_text("")
        done = dashpot("compile", FIG_5, "--target", "python", "-o", self.folder / "file", status=1)
        self.assertIn("[cannot-write-file]", done.stderr)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["file"])

    def test_options(self):
        """Fails if an option that the target has nothing for passes without a message."""
        for option in [["--batch"], ["--constant-time"], ["--with-test"],
                       ["--certificate", str(self.folder / "c.json")]]:
            self.assertIn(f"--target python does not support {option[0]}",
                          self.refused(FIG_5, *option, code="target", status=2))

    def test_library_of_another_machine(self):
        """Fails if a package that was carried to another machine does not say how it is built there."""
        dashpot("compile", FIG_5, "--target", "python", "-o", self.folder)
        package = self.folder / "second_order_maxwell"
        (package / "law.so").write_bytes(b"\x7fELF of another machine")
        program = [sys.executable, "-B", "-c", "import second_order_maxwell as m; print(m.Law().step(1e-3, 0).force)"]
        said = subprocess.run(program, cwd=self.folder, capture_output=True, text=True)
        self.assertNotEqual(said.returncode, 0)
        command = re.search(r"in (.*): (cc .*)$", said.stderr, re.MULTILINE)
        self.assertIn("made for the machine that dashpot ran on", said.stderr)
        subprocess.run(command[2], shell=True, cwd=command[1], check=True)
        self.assertTrue(float(subprocess.run(program, cwd=self.folder, capture_output=True, text=True,
                                             check=True).stdout))


if __name__ == "__main__":
    unittest.main()
