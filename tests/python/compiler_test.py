"""The compiler from Python: the package `dashpot`, which is installed with the command."""
import json
import os
import unittest
import warnings

import numpy

import dashpot as library
from emitted import FIG_5, PANTOGRAPH, TUNABLE, PackageTest, dashpot, motion

ZENER = {"dashpot": 1, "name": "zener",
         "network": {"parallel": [{"spring": 100.0},
                                  {"series": [{"spring": numpy.float64(150)}, {"damper": "45 N s/m"}]}]}}


def pressed():
    """A recording of a spring and a damper, with noise."""
    t = numpy.arange(600) * 5e-3
    u = numpy.interp(t, [0, 0.5, 1, 2, 2.5, 3], [0, 0, 3e-3, 3e-3, 0, 0])
    f = 100 * u + 2 * numpy.gradient(u, t) + numpy.random.default_rng(0).normal(0, 1e-3, len(t))
    return {"time [s]": t, "position [m]": u, "force [N]": f}


def fit_of(*recordings, **options):
    """What `dashpot fit --json` says, and the network; that all is recorded at one speed is of no interest."""
    with warnings.catch_warnings(record=True):
        fit = library.fit(*recordings, **options)
    return {**fit.report, "network": fit.network["network"]}


class Compile(PackageTest):
    def test_simulate(self):
        """Fails if a network led along a motion does not give what `dashpot simulate` prints, at the motion's own
        rate."""
        tissue = library.compile(FIG_5)
        self.assertEqual((tissue.name, tissue.rate), ("second_order_maxwell", 1000))
        u = motion()
        for rate in [1000, 250, 8000]:
            t = numpy.arange(len(u)) / rate
            response, wanted = tissue.simulate(t, u), self.simulated(FIG_5, {"time": t, "position": u})
            for name, values in wanted.items():
                numpy.testing.assert_array_equal(getattr(response, name), values)
        response = tissue.simulate(t, u, velocity=numpy.ones(len(u)))
        self.assertTrue(numpy.all(response.velocity == 1))

    def test_rounded_times(self):
        """Fails if times are refused that are uniform but for the digits that they are written with, where `dashpot
        simulate` takes them, or for the type that holds them; if the rate is not the one that was meant; or if a gap
        passes as rounding, or what is so coarse that it could be one."""
        tissue = library.compile(FIG_5)
        u, k = motion(300), numpy.arange(300)
        for rate in [1000, 3000, 7000]:
            exact = tissue.simulate(k / rate, u).force
            rounded = numpy.round(k / rate, 6)
            for t in [rounded, numpy.array([float(f"{t:.5g}") for t in k / rate + 1e-6])]:
                numpy.testing.assert_array_equal(tissue.simulate(t, u).force, exact)
                numpy.testing.assert_array_equal(self.simulated(FIG_5, {"time": t, "position": u})["force"], exact)
            for t in [(k / rate).astype("f4"), rounded.astype("f4")]:
                response = tissue.simulate(t, u)
                self.assertEqual(response.time.dtype, numpy.float64)
                numpy.testing.assert_array_equal(response.force, exact)
            for t in [rounded, rounded.astype("f4")]:
                with self.assertRaisesRegex(ValueError, "but for row 200"):
                    tissue.simulate(numpy.delete(t, 200), u[1:])
        t = 1.7e9 + k / 7000  # a double's last digits are as coarse
        numpy.testing.assert_array_equal(tissue.simulate(t, u).force,
                                         self.simulated(FIG_5, {"time": t, "position": u})["force"])
        for t in [numpy.round(k / 3000, 4), (1e5 + k / 100).astype("f4")]:  # steps of 3 and 4 last digits, of 1 and 2
            with self.assertRaisesRegex(ValueError, "one period throughout"):
                tissue.simulate(t, u)
        with self.assertRaisesRegex(ValueError, "t is at .* s in row 3; at a period of 0.000333.* s that row is at"):
            tissue.simulate(numpy.round(k / 3000 - 1e-9 * k * (299 - k), 6), u)
        fixed = library.compile(FIG_5, rate=3000)
        numpy.testing.assert_array_equal(fixed.simulate(numpy.round(k / 3000, 6), u).force,
                                         fixed.law().simulate(u).force)

    def test_times_with_a_unit(self):
        """Fails if times that know their unit are read as seconds whatever that is, or what is no time is not called
        one."""
        tissue = library.compile(FIG_5)
        u, k = motion(300), numpy.arange(300)
        wanted = tissue.simulate(k / 1000, u)
        for t in [k * numpy.timedelta64(1, "ms"), k * numpy.timedelta64(1000000, "ns")]:
            response = tissue.simulate(t, u)
            numpy.testing.assert_array_equal(response.time, k / 1000)
            numpy.testing.assert_array_equal(response.force, wanted.force)
        for t in [numpy.datetime64("2026-01-01", "ms") + k, k * numpy.timedelta64(1, "M"), k * numpy.timedelta64(1)]:
            with self.assertRaisesRegex(ValueError, "t is of type .*; numbers of seconds are expected"):
                tissue.simulate(t, u)
        for wrong in [numpy.inf, -numpy.inf, numpy.nan]:
            for row in [0, 7, 299]:
                t = k / 1000
                t[row] = wrong
                with self.assertRaisesRegex(ValueError, f"t is {wrong} in row {row}; a finite time is expected"):
                    tissue.simulate(t, u)

    def test_choices(self):
        """Fails if a choice, a parameter or a device does not reach the command."""
        self.assertEqual(library.compile(FIG_5, rate=4000).law().step(0, 0).damping, 11)
        self.assertEqual(library.compile(FIG_5, decomposition=2).law().step(0, 0).damping, 2)
        self.assertEqual(library.compile(FIG_5, scalar="float").package.SCALAR, "float")
        soft, stiff = (library.compile(FIG_5, set={"K1": f"{k} N/m"}).simulate([0, 1e-3, 2e-3],
                                                                               [0, 1e-3, 1e-3]).force[-1]
                       for k in (1, 1000))
        self.assertLess(soft, stiff)
        arm = library.compile(FIG_5, device=json.loads(PANTOGRAPH.read_text()), uncertified=True)
        self.assertEqual((arm.rate, arm.package.DEVICE), (10000, "pantograph_brake_2009"))
        with self.assertRaisesRegex(ValueError, "t is at 1000 Hz, and the law is for a loop at 10000 Hz"):
            arm.simulate(numpy.arange(9) / 1000, numpy.zeros(9))

    def test_dictionaries(self):
        """Fails if a network need be a file, or what is compiled depends on which it is."""
        path = self.folder / "zener.json"
        path.write_text(json.dumps(ZENER, default=float))
        u, t = motion(50), numpy.arange(50) / 1000
        numpy.testing.assert_array_equal(library.compile(ZENER).simulate(t, u).force,
                                         library.compile(path).simulate(t, u).force)
        self.assertEqual(library.explain(ZENER), library.compile(str(path)).explain())
        self.assertEqual(library.explain(ZENER), json.loads(dashpot("explain", path, "--json").stdout))

    def test_tunables(self):
        """Fails if parameters do not reach the law, alone or as arrays."""
        tissue = library.compile(TUNABLE)
        name, parameter = next(iter(tissue.parameters.items()))
        u, t = motion(50), numpy.arange(50) / 1000
        fixed = tissue.simulate(t, u).force
        moved = tissue.simulate(t, u, values={name: numpy.linspace(parameter.min, parameter.max, 50)}).force
        self.assertGreater(numpy.max(numpy.abs(moved - fixed)), 0)
        law = tissue.law()
        law.set(**{name: parameter.max})
        self.assertEqual(law.parameters[name], parameter.max)
        with self.assertRaisesRegex(TypeError, "^second_order_maxwell_tunable has no parameter 'softness'; it has K1"):
            law.set(softness=1)

    def test_refusals(self):
        """Fails if what the command refuses is not raised in its words, or a wrong motion is taken for a right one."""
        with self.assertRaisesRegex(library.Refusal, r"negative-damping"):
            library.compile({"dashpot": 1, "name": "x", "network": {"damper": -1}})
        with self.assertRaisesRegex(library.Refusal, "nowhere.json"):
            library.explain("nowhere.json")
        with self.assertRaisesRegex(library.Refusal, "--fast-math"):
            library.compile(FIG_5, fast_math=True)
        tissue = library.compile(FIG_5)
        with self.assertRaisesRegex(ValueError, "row 3, 0.002 s after the one before"):
            tissue.simulate([0, 1e-3, 2e-3, 4e-3, 5e-3, 6e-3], numpy.zeros(6))
        for t in [[0], [[0, 1]], [1, 0], [0, 0]]:
            with self.assertRaisesRegex(ValueError, "rising times"):
                tissue.simulate(t, numpy.zeros_like(t))
        with self.assertRaisesRegex(ValueError, "u has the shape"):
            tissue.simulate([0, 1e-3], [0, 0, 0])
        before = os.environ.pop("DASHPOT")
        self.addCleanup(os.environ.__setitem__, "DASHPOT", before)
        os.environ["DASHPOT"] = "/nowhere/dashpot"
        with self.assertRaisesRegex(FileNotFoundError, "there is no command '/nowhere/dashpot'"):
            library.compile(FIG_5)

    def test_leaves_nothing(self):
        """Fails if folders stay behind when what they are for is gone."""
        before = os.environ.get("TMPDIR")
        os.environ["TMPDIR"] = str(self.folder)
        import tempfile
        tempfile.tempdir = None
        try:
            law = library.compile(FIG_5).law()
            library.explain(ZENER)
            self.assertEqual(list(self.folder.iterdir()), [])
            self.assertEqual(law.step(0, 0).damping, 11)  # outlives its network
        finally:
            os.environ.pop("TMPDIR") if before is None else os.environ.__setitem__("TMPDIR", before)
            tempfile.tempdir = None


class Fit(PackageTest):
    def test_fit(self):
        """Fails if arrays are not fitted, or what is fitted is not the body that they are of."""
        t = numpy.arange(0, 4, 5e-3)
        u = numpy.minimum(t * 0.02, 3e-3)
        f = library.compile(ZENER).simulate(t, u).force + numpy.random.default_rng(1).normal(0, 1e-3, len(t))
        with warnings.catch_warnings(record=True):
            fitted = library.fit({"time [s]": t, "position [m]": u, "force [N]": f}, name="felt")
        self.assertEqual(fitted.network["name"], "felt")
        again = library.compile(fitted.network).simulate(t, u).force
        self.assertLess(numpy.max(numpy.abs(again - library.compile(ZENER).simulate(t, u).force)), 2e-3)
        self.assertAlmostEqual(fitted.report["rms"], 1e-3, delta=1e-4)  # the noise
        with self.assertRaisesRegex(ValueError, "different lengths"):
            library.fit({"time [s]": t, "force [N]": f[1:]})

    def test_names_of_columns(self):
        """Fails if a column cannot be called by what a table holds between quotes alone."""
        recording = pressed()
        wanted = fit_of(recording)["network"]
        t, u, f = recording.values()
        self.assertEqual(fit_of({"time [s]": t, "position, of the tool [m]": u, "force [N]": f},
                                columns="position=2:m")["network"], wanted)
        self.assertEqual(fit_of({'"read", by hand': f, **recording})["network"], wanted)

    def test_hold_out(self):
        """Fails if a recording that is held out is not taken as one that is fitted is, alone or among others."""
        recording = pressed()
        stiffer = {**recording, "force [N]": 1.5 * recording["force [N]"]}
        path = self.folder / "stiffer.csv"
        numpy.savetxt(path, numpy.column_stack(list(stiffer.values())), delimiter=",", header=",".join(stiffer),
                      comments="")
        wanted = fit_of(recording)
        for held_out, count in [(path, 1), (stiffer, 1), ([stiffer, path], 2), ((stiffer, stiffer), 2)]:
            report = fit_of(recording, hold_out=held_out)
            self.assertEqual(report["network"], wanted["network"])
            self.assertEqual([one["rows"] for one in report["held_out"]], [len(stiffer["time [s]"])] * count)


if __name__ == "__main__":
    unittest.main()
