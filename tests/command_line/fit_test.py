"""dashpot fit: what it reads, writes, reports and refuses, and that what it writes is what runs."""
import csv
import json
import math
import os
import re
import shlex
import subprocess
import unittest

from dashpot_command import COMMAND_LINE_WRONG, DASHPOT, FIG_5, INPUT_REFUSED, SOURCE, CommandTest

RECORDINGS = SOURCE / "networks/tissues/measured"
ADHESIVE = [RECORDINGS / f"soft_adhesive/shear_relaxation_{rate}.csv" for rate in (1, 2, 5)]
TITIN = [RECORDINGS / f"skeletal_muscle/AvgRelaxed_{ramp}s.csv" for ramp in ("0.1", "1", "10", "100")]
MUSCLE = ["--columns", "time=Time:s,strain=L-0.95,stress=F:kPa,deviation=SD:kPa",
          "--geometry", "column:area=1mm^2,length=10mm"]


def sines(t):
    return 2e-3 * math.sin(2 * t) + 5e-4 * math.sin(17 * t)


def triangles(t):
    """Slow and fast by turns, and never still."""
    phase = t % 2 if t % 8 < 4 else 4 * t % 2
    return 1e-3 * (phase if phase < 1 else 2 - phase)


def recording(rows=400, period=0.005, header="time [s],position [mm],force [N]", motion=sines, first=0, late=0):
    """A Zener body, 100 N/m beside 150 N/m with 0.3 s, by its exact recursion; its force `late` by so many rows."""
    table, q, last, decay = [], 0.0, 0.0, math.exp(-period / 0.3)
    share = (1 - decay) * 0.3 / period
    for i in range(rows):
        u = motion(i * period)
        q = decay * q + share * (u - last)
        last = u
        table.append((i * period, 1e3 * u, 100 * u + 150 * q))
    lines = [f"{table[i][0]:.3f},{table[i][1]!r},{table[max(0, i - late)][2]!r}" for i in range(first, rows)]
    return "\n".join([header, *lines]) + "\n"


def approach(force_after_lift_off=0.0, noise=0.004, origin=0.0):
    """A Zener body whose surface is at 2.6 mm: the tool comes from 0, presses to 6.6 mm, holds, and goes back faster
    than the body. In the rows after it has left, a force of one's own. Its noise is that of an even distribution. The
    positions that are written count from elsewhere, by `origin` [mm]."""
    h, surface, relaxation = 0.01, 2.6e-3, 0.4
    decay, q, last, rows, seed = math.exp(-h / relaxation), 0.0, 0.0, [], 7
    share, has_left = (1 - decay) * relaxation / h, False
    for i in range(1100):
        t = i * h
        x = 2e-3 * t if t < 3.3 else 6.6e-3 if t < 9 else max(0.0, 6.6e-3 - 20e-3 * (t - 9))
        u = x - surface
        force = 0.0
        if u > 0 and not has_left:
            q, last = decay * q + share * 250 * (u - last), u
            force = 150 * u + q
            has_left = force < 0
        seed = 16807 * seed % 2147483647
        force = max(0.0, force) + (force_after_lift_off if has_left
                                   else 0) + noise * math.sqrt(12) * (seed / 2147483647 - 0.5)
        rows.append(f"{t:.2f},{origin + 1e3 * x:.5f},{force:.6f}")
    return "\n".join(["time [s],position [mm],force [N]", *rows]) + "\n"


class Fit(CommandTest):
    def fit(self, *arguments, **more):
        return self.dashpot("fit", *arguments, **more)

    def told(self, *arguments):
        return json.loads(self.fit(*arguments, "--json").stdout)

    def test_writes_what_runs(self):
        """Fails if the file does not simulate to the answer that was reported, or its emitted code to other bits."""
        self.write("zener.csv", recording())
        told = self.told("zener.csv", "-o", "zener.json")
        self.assertEqual([element["name"] for element in told["elements"]], ["K0", "K1", "B1"])
        for element, value in zip(told["elements"], (100, 150, 45)):
            self.assertAlmostEqual(element["value"] / value, 1, places=4)
        self.dashpot("check", "zener.json")
        rows = list(csv.DictReader(recording(header="time,position,force").splitlines()))
        self.write("motion.csv", "time,position\n" +
                   "".join(f"{r['time']},{float(r['position']) / 1e3!r}\n" for r in rows))
        self.dashpot("simulate", "zener.json", "--input", "motion.csv", "-o", "forces.csv")
        forces = [float(r["force"]) for r in csv.DictReader((self.folder / "forces.csv").read_text().splitlines())]
        left = [a - float(r["force"]) for a, r in zip(forces, rows)]
        rms = math.sqrt(sum(x * x for x in left) / len(left))
        peak = max(map(abs, forces))
        self.assertLess(abs(rms - told["rms"]), 1e-9 * peak)
        self.dashpot("compile", "zener.json", "--rate", "200", "-o", ".")
        self.write("main.cpp", """#include <cstdio>
#include "zener.hpp"
int main() {
  dashpot::generated::zener tissue;
  double t, u, last = 0;
  bool first = true;
  std::scanf("%*[^\\n]");
  while (std::scanf("%lf,%lf", &t, &u) == 2) {
    const double v = first ? 0 : (u - last) * 200;
    first = false;
    last = u;
    const auto c = tissue.step(u, v);
    std::printf("%.17g\\n", c.damping * v + c.force);
  }
}
""")
        subprocess.run([os.environ.get("CXX", "c++"), "-std=c++17", "-O1", "-ffp-contract=off",
                        f"-I{SOURCE}/runtime/include", "main.cpp",
                        "-o", "main"], cwd=self.folder, check=True)
        with (self.folder / "motion.csv").open() as motion:
            printed = subprocess.run(["./main"], cwd=self.folder, stdin=motion, capture_output=True, text=True,
                                     check=True)
        self.assertEqual([float(line) for line in printed.stdout.split()], forces)

    def test_tells_its_own_record(self):
        """Fails if the file does not say what it was fitted to, and how well."""
        self.write("zener.csv", recording())
        self.fit("zener.csv", "-o", "zener.json")
        file = json.loads((self.folder / "zener.json").read_text())
        self.assertIn("zener.csv", file["source"])
        self.assertEqual(file["fit"]["recordings"][0]["rows"], 400)
        self.assertRegex(file["fit"]["recordings"][0]["digest"], "^[0-9a-f]{64}$")
        self.assertEqual(set(file["valid"]), {"rate", "displacement", "frequency"})
        again = (self.folder / "zener.json").read_bytes()
        self.fit("zener.csv", "-o", "zener.json")
        self.assertEqual((self.folder / "zener.json").read_bytes(), again)

    def test_asks_with_the_answer(self):
        """Fails if a question does not come with a command line that answers it."""
        self.write("bare.csv", recording(header="t,x,f"))
        done = self.dashpot("fit", "bare.csv", "-o", "bare.json", status=INPUT_REFUSED)
        self.assertIn("[recording-unit-missing]", done.stderr)
        self.assertIn("dashpot fit bare.csv -o bare.json --columns time=t:s,position=x:mm,force=f:N", done.stderr)
        self.assertEqual(self.files(), ["bare.csv"])
        self.fit("bare.csv", "-o", "bare.json", "--columns", "time=t:s,position=x:mm,force=f:N")
        done = self.dashpot("fit", TITIN[0], "--columns", "time=Time:s,strain=L-0.95,stress=F:kPa",
                            status=INPUT_REFUSED)
        self.assertIn("[recording-without-geometry]", done.stderr)
        (answer,) = re.findall(r"note: .*, write: dashpot (.*)", done.stderr)
        self.assertIn("--columns time=Time:s,strain=L-0.95,stress=F:kPa --geometry", answer)
        self.dashpot(*shlex.split(answer))

    def test_answers_where_a_name_cannot_be_shown(self):
        """Fails if the answer to a question calls a column in another encoding by a name that finds nothing."""
        self.write("latin.csv", recording(header="time [s],position [mm],Kräft [N]").encode("latin-1"))
        done = self.dashpot("fit", "latin.csv", "-o", "latin.json", status=INPUT_REFUSED)
        (answer,) = re.findall(r"note: .*, write: dashpot (.*)", done.stderr)
        self.assertIn("position=position [mm],force=3'", answer)
        self.dashpot(*shlex.split(answer))

    def test_a_zero_that_is_moved_by_little(self):
        """Fails if the sign of an exponent is read as that in front of a number."""
        self.write("zener.csv", recording())
        told = [self.told("zener.csv", "--columns", f"time=time,position=position{zero},force=force")["elements"]
                for zero in ("-0.00001", "-1e-5", "-1E-05")]
        self.assertEqual(told[0], told[1])
        self.assertEqual(told[0], told[2])

    def test_a_size_that_is_not_there(self):
        """Fails if the warning says that the size with the least BIC is taken, and another one is."""
        self.write("creep.csv", "time [s],compliance [mm/N]\n0.1,10\n1,11\n10,20\n100,30\n1000,33\n")
        for words in (["--tolerance", "1e-9%"], ["--modes", "9"]):
            done = self.fit("creep.csv", *words, "--json")
            self.assertIn("[fit-size-not-met]", done.stderr)
            sizes = json.loads(done.stdout)["sizes"]
            taken = [size["criterion"] for size in sizes if size["chosen"]]
            self.assertEqual(taken, [min(size["criterion"] for size in sizes if size["parameters"] <= 3)])

    def test_says_how_a_size_was_chosen(self):
        """Fails if another size is marked than that of which the text says that it is taken."""
        self.write("zener.csv", recording())
        self.write("creep.csv", "time [s],compliance [mm/N]\n0.1,10\n1,11\n10,20\n100,30\n1000,33\n")
        for words, text, most in (
                (["zener.csv"], "The size with the least BIC (Bayesian information criterion) is taken (*)\n", 99),
                (["creep.csv", "--tolerance", "1e-9%"], "The size with the least BIC", 3),
                (["zener.csv", "--modes", "0"], "Of what was asked for the size with the least BIC", 2),
                (["zener.csv", "--tolerance", "90%"], "Of what was asked for the size with the fewest elements", 2),
                (["creep.csv"], "is taken (*), but none whose parameters are too many for so few rows (-)\n", 3)):
            with self.subTest(words):
                self.assertIn(text, self.fit(*words).stdout)
                sizes = self.told(*words)["sizes"]
                taken = [size["criterion"] for size in sizes if size["chosen"]]
                self.assertEqual(taken, [min(size["criterion"] for size in sizes if size["parameters"] <= most)])

    def test_several_files(self):
        """Fails if slips, gains, a file held out or a page are not there in the end."""
        told = self.told(*ADHESIVE, "--slips", "2", "--modes", "2", "--gain-per-file", "-o", "adhesive.json",
                         "--report", "adhesive.html")
        self.assertLess(told["rms"], 0.045)
        self.assertEqual(len(told["files"]), 3)
        self.assertTrue(all(file["left_out_rms"] for file in told["files"]))
        page = (self.folder / "adhesive.html").read_text()
        for part in ("Data and model", "What is left", "Spectrum", "by the number of parameters", "cannot tell"):
            self.assertIn(part, page)
        self.assertNotIn("http", page.replace("http-equiv", ""))
        # Folders belong to the command: titles of figures are as narrow as those.
        for part, is_there in ((">shear_relaxation_1.csv<", True), ("fitted, with bootstrap", True),
                               ("<th>95 %</th>", False)):
            self.assertEqual(part in page, is_there, part)
        files = [recording["file"]
                 for recording in json.loads((self.folder / "adhesive.json").read_text())["fit"]["recordings"]]
        self.assertEqual(files, [path.name for path in ADHESIVE])
        self.dashpot("compile", "adhesive.json", "-o", ".")
        held = self.told(*ADHESIVE[:2], "--hold-out", ADHESIVE[2])
        self.assertEqual(len(held["held_out"]), 1)
        self.assertGreater(held["held_out"][0]["rms"], held["rms"])

    def test_says_what_cannot_be_known(self):
        """Fails if a fit hides that its floor is above the noise, or that no file goes back."""
        done = self.fit(*ADHESIVE, "--slips", "2", "--modes", "2")
        self.assertIn("[fit-no-intervals]", done.stderr)
        self.assertIn("[fit-slips-or-softening]", done.stderr)
        self.assertIn("[fit-assumed-start]", done.stderr)
        self.assertIn("[fit-floor-above-noise]", self.fit(*ADHESIVE).stderr)
        self.assertIn("no linear network has an rms below", done.stdout)
        # Forces late by half a row: 2e-4 of the force cannot be fitted, far above the noise, and mean nothing.
        header, *rows = recording(rows=12000, period=0.00025, motion=lambda t: 2e-3 * math.sin(2 * t),
                                  late=2).splitlines()
        self.write("nearly_exact.csv", "\n".join([header, *rows[::4]]) + "\n")
        self.assertNotIn("[fit-floor-above-noise]", self.fit("nearly_exact.csv").stderr)
        ramp = "time [s],position [mm],force [N]\n" + "".join(f"{i},{i / 10},{i / 10 + (i % 3) / 100}\n"
                                                              for i in range(200))
        self.write("ramp.csv", ramp)
        done = self.fit("ramp.csv")
        self.assertIn("[fit-loading-only]", done.stderr)
        self.assertIn("[fit-one-rate]", done.stderr)

    def test_every_message_has_a_recording(self):
        """Fails if a message of a fit is provoked by nothing, or a recording no longer provokes its own."""
        self.write("zener.csv", recording())
        self.write("moving.csv", recording(first=100))
        self.write("late.csv", recording(late=8))
        self.write("approach.csv", approach())
        self.write("sticks.csv", approach(force_after_lift_off=-0.3))
        self.write("triangles.csv", recording(rows=1600, period=0.01, motion=triangles))
        self.write("ramp.csv", "time [s],position [mm],force [N]\n" +
                   "".join(f"{i},{i},{i + i % 3}\n" for i in range(200)))
        self.write("slow.csv", "time [s],modulus [N/m]\n" + "".join(
            f"{0.1 * 1.2 ** i!r},{100 + 50 * math.exp(-0.1 * 1.2 ** i / 5000)!r}\n" for i in range(38)))
        # A force at twice the frequency of the motion: no spring, damper or slip makes it.
        self.write("nothing.csv", "time [s],position [mm],force [N]\n" + "".join(
            f"{i / 100},{math.sin(i * math.pi / 50):.9g},{math.cos(i * math.pi / 25) - 1:.9g}\n" for i in range(401)))
        self.write("sliding.json", """{ "dashpot": 1, "name": "sliding", "network": { "parallel": [
            { "spring": "100 N/m" },
            { "series": [ { "spring": "400 N/m" }, { "parallel": [ { "slip": "0.3 N" }, { "damper": "20 N s/m" } ] } ] } ] } }""")
        self.write("motion.csv", "time,position\n" + "".join(f"{i / 200},{sines(i / 200)!r}\n" for i in range(1200)))
        self.dashpot("simulate", "sliding.json", "--input", "motion.csv", "-o", "sliding.csv")
        polymer = [RECORDINGS / "polymer/time_user_master.csv", "--relaxation", "--weight", "relative", "--modes", "38",
                   "--geometry", "column:area=1mm^2,length=1mm"]
        brain = [RECORDINGS / "brain/brain_relax_amedieu2004.csv", "--relaxation", "--modes", "2",
                 "--columns", "time=t:s,modulus=relax_normalised:N/m"]
        provoked = {"fit-wrong-quantity", "fit-choices-contradict"}  # see test_refuses
        for words, told in (
                (["nothing.csv"], {"fit-nothing-resists"}),
                (["zener.csv", "--contact", "9 mm"], {"fit-surface-beyond"}),
                (["zener.csv", "--modes", "9"], {"fit-size-not-met"}),
                (["zener.csv", "zener.csv", "--tare"], {"fit-offsets-absorb"}),
                (["moving.csv"], {"fit-in-motion"}),
                (["late.csv"], {"fit-late-force"}),
                (["approach.csv"], {"fit-untouched", "fit-floor-above-noise"}),
                (["sticks.csv", "--contact", "2.6 mm"], {"fit-left-out-pushes"}),
                (["triangles.csv"], {"fit-no-hold"}),
                (["zener.csv", "--shape", "power"], {"fit-shape-is-straight"}),
                (["ramp.csv"], {"fit-loading-only", "fit-one-rate"}),
                (["slow.csv", "--relaxation"], {"fit-slower-than-record"}),
                (["sliding.csv", "--columns", "time=time:s,position=position:m,force=force:N", "--slips", "viscous"],
                 {"fit-not-exact-in-simulate"}),
                (polymer, {"fit-beyond-reach", "fit-ill-conditioned"}),
                (brain, {"fit-faster-than-step", "fit-few-rows"}),
                (ADHESIVE, {"fit-floor-above-noise", "fit-assumed-start"}),
                ([*ADHESIVE, "--slips", "2", "--modes", "2", "--gain-per-file"],
                 {"fit-left-above-noise", "fit-slips-or-softening", "fit-no-intervals", "fit-unstable-left-out",
                  "fit-gains-fitted"})):
            with self.subTest(words[0]):
                is_refused = words == ["nothing.csv"] or "9 mm" in words
                done = self.fit(*words, status=INPUT_REFUSED if is_refused else 0)
                said = set(re.findall(r"\[(fit-[a-z-]+)\]$", done.stderr, re.MULTILINE))
                self.assertLessEqual(told, said)
                provoked |= said
        every = re.findall(r"DASHPOT_DIAGNOSTIC\(\s*(fit_\w+),\s*(?:error|warning)",
                           (SOURCE / "compiler/source/diagnostics.def").read_text())
        # No recording is known that six more columns do not certify.
        self.assertEqual({name.replace("_", "-") for name in every} - provoked, {"fit-floor-not-certified"})

    def test_units_and_names_that_are_overruled(self):
        """Fails if --columns overrules the unit of a header without a word, if a file's name that no law may have stops
        a fit, or if such a --name is refused only after the fit."""
        rows = "\n".join(f"{i},{2 / (i + 1) + 1}" for i in range(40))
        self.write("relax.csv", "time [s],stiffness [N/m]\n" + rows + "\n")
        asked = ["relax.csv", "--relaxation", "--columns"]
        told = self.fit(*asked, "time=time:s,modulus=stiffness:N/mm").stderr
        self.assertIn("column 'stiffness [N/m]' is in 'N/m' by its header, and in 'N/mm' by --columns, which counts "
                      "[recording-unit-overruled]", told)
        self.assertNotIn("[recording-unit-overruled]",
                         self.fit(*asked, "time=time:s,modulus=stiffness:N/m", "-o", "step.json").stderr)
        self.assertEqual(json.loads((self.folder / "step.json").read_text())["name"], "step_1")
        told = self.fit("absent.csv", "--name", "step", status=COMMAND_LINE_WRONG).stderr
        self.assertIn("[name-is-member]", told)
        self.assertIn("note: write 'step_1'", told)

    def test_material(self):
        """Fails if the geometry is not what turns stress and strain into force and displacement."""
        one = self.told(*TITIN, *MUSCLE)
        double = [word.replace("1mm^2", "2mm^2") for word in MUSCLE]
        two = self.told(*TITIN, *double)
        self.assertAlmostEqual(two["rms"] / one["rms"], 2, places=3)
        self.fit(*TITIN, *MUSCLE, "-o", "muscle.json")
        self.assertIn("a column, f = E A u/L", (self.folder / "muscle.json").read_text())
        self.fit(RECORDINGS / "brain/brain_relax_amedieu2004.csv", "--relaxation", "--columns",
                 "time=t:s,modulus=relax_normalised",
                 "--scale", "1kPa", "--geometry", "punch:radius=5mm", "--modes", "2", "-o", "brain.json")
        self.dashpot("check", "brain.json")

    def test_tissue_that_stiffens(self):
        """Fails if a curve that the recordings show is not found, reported, written and compiled, or what was tried is
        not shown."""
        rows = "".join(f"{i / 100},{x!r},{2 * (math.exp(3 * x) - 1) / (math.exp(6) - 1) + 1e-3 * math.sin(37 * i)!r}\n"
                       for i in range(400) for x in [1 - math.cos(i / 40)])
        self.write("stiff.csv", "time [s],position [mm],force [N]\n" + rows)
        done = self.fit("stiff.csv", "--shape", "auto", "--elastic", "-o", "stiff.json", "--report", "stiff.html")
        self.assertRegex(done.stdout, r"\* exponential +2 ")
        self.assertRegex(done.stdout, r"  straight +1 ")
        self.assertIn("static curve, exponential, at rest", done.stdout)
        self.assertNotIn("[fit-floor-above-noise]", done.stderr)
        self.assertIn("Behind a static curve, exponential: rate", (self.folder / "stiff.html").read_text())
        network = json.loads((self.folder / "stiff.json").read_text())
        self.assertEqual(set(network["static"]), {"exponential", "force", "at"})
        self.assertEqual(set(network["fit"]["intervals"]), {"rate", "force", "K0"})
        told = self.told("stiff.csv", "--shape", "exponential", "--elastic")
        low, high = told["static"]["values"][0]["interval"]
        self.assertTrue(low < 3000 < high)
        self.assertAlmostEqual(told["static"]["values"][1]["value"], 2, delta=2e-3)
        self.dashpot("compile", "stiff.json", "-o", ".")
        self.assertIn("[fit-floor-above-noise]", self.fit("stiff.csv").stderr)
        table = self.told("stiff.csv", "--shape", "table", "--elastic")["static"]
        self.assertEqual((table["kind"], table["is"]), ("table", "equilibrium"))
        self.assertIn(len(table["values"]), (4, 8, 16))

    def test_what_is_left_of_networks_with_slips(self):
        """Fails if a fit with slips that leaves much more than noise, as behind a surface that is looked for without
        them, says nothing; or if one that leaves noise alone is warned of."""
        self.write("slip.json", """{"dashpot": 1, "name": "slip", "contact": {"at": "0.7 mm"}, "network": {"parallel": [
            {"spring": 200}, {"series": [{"damper": 45}, {"spring": 150}]},
            {"series": [{"slip": 0.1}, {"spring": 600}]}]}}""")
        way = [(0, 0), (0.5, 0), (1, 4), (3, 4), (3.5, 2), (5, 2), (5.2, 5), (8, 5), (9, 0), (12, 0)]
        position, rows = [], []
        for i in range(3000):
            t = 0.004 * i
            (t0, u0), (t1, u1) = next(pair for pair in zip(way, way[1:]) if t < pair[1][0])
            position.append(1e-3 * (u0 + (u1 - u0) * (t - t0) / (t1 - t0)))
            rows.append(f"{t:.3f},{position[-1]!r}\n")
        self.write("way.csv", "time,position\n" + "".join(rows))
        self.dashpot("simulate", "slip.json", "--input", "way.csv", "-o", "out.csv")
        seed, rows = 7, []
        for i, row in enumerate(csv.DictReader((self.folder / "out.csv").read_text().splitlines())):
            seed = 16807 * seed % 2147483647
            force = float(row["force"]) + 1e-3 * math.sqrt(12) * (seed / 2147483647 - 0.5)
            rows.append(f"{0.004 * i:.3f},{position[i]!r},{force!r}\n")
        self.write("slip.csv", "time [s],position [m],force [N]\n" + "".join(rows))
        found = self.fit("slip.csv", "--slips", "auto", "--contact", "find").stderr
        self.assertIn("[fit-left-above-noise]", found)
        self.assertIn("--contact POSITION", found)
        self.assertNotIn("fit-left-above-noise", self.fit("slip.csv", "--slips", "auto", "--contact", "0.7mm").stderr)

    def test_what_turns(self):
        """Fails if a spectrum, a relaxation or creep of a tool that turns is taken for one that is shifted or for a
        material's; if columns of both are taken together; or if of two files it is told the wrong way round."""
        spectrum = "".join(f"{w},{5 + 2 * w * w / (1 + w * w)!r},{2 * w / (1 + w * w)!r}\n"
                           for w in (0.1, 0.5, 1, 2, 9))
        times = [0.1 * i for i in range(60)]
        relaxation = "".join(f"{t},{5 + 2 * math.exp(-t)!r}\n" for t in times)
        creep = "".join(f"{t},{0.5 - 0.2 * math.exp(-t)!r}\n" for t in times)
        for header, rows, words in (("omega [rad/s],storage [N m/rad],loss [N m/rad]\n", spectrum, []),
                                    ("time [s],modulus [N m/rad]\n", relaxation, ["--relaxation"]),
                                    ("time [s],compliance [rad/(N m)]\n", creep, ["--creep"])):
            self.write("turned.csv", header + rows)
            self.fit("turned.csv", *words, "-o", "turned.json")
            self.assertEqual(json.loads((self.folder / "turned.json").read_text())["motion"], "rotation", header)
        rows = "".join(f"{t},{1e-3 * math.sin(t)!r},{math.sin(t)!r}\n" for t in times)
        for header, told in (
                ("time [s],angle [rad],force [N]", "column 'force [N]' in 'N'; a force that goes with 'angle [rad]' is "
                 "expected in a unit such as 'N m'"),
                ("time [s],position [m],torque [N m]", "column 'torque [N m]' in 'N m'; a force that goes with "
                 "'position [m]' is expected in a unit such as 'N'"),
                ("omega [rad/s],storage [N m/rad],loss [N/m]", "a loss that goes with 'storage [N m/rad]' is expected "
                 "in a unit such as 'N m/rad'"),
                ("omega [rad/s],storage [Pa],loss [N/m]", "a loss that goes with 'storage [Pa]' is expected in a unit "
                 "such as 'Pa'")):
            self.write("mixed.csv", f"{header}\n{rows}")
            done = self.fit("mixed.csv", status=INPUT_REFUSED)
            self.assertIn("[recording-wrong-unit]", done.stderr, header)
            self.assertIn(told, done.stderr)
        self.write("turns.csv", f"time [s],angle [rad],torque [N m]\n{rows}")
        self.write("shifts.csv", f"time [s],position [m],force [N]\n{rows}")
        self.assertIn("'turns.csv' is a rotation, 'shifts.csv' a translation",
                      self.fit("turns.csv", "shifts.csv", status=INPUT_REFUSED).stderr)
        self.assertIn("'shifts.csv' is a translation, 'turns.csv' a rotation",
                      self.fit("shifts.csv", "--hold-out", "turns.csv", status=INPUT_REFUSED).stderr)

    def test_slips_behind_a_curve(self):
        """Fails if what is written is another network than what was fitted: springs behind slips are in the force of a
        static curve where it is the force at once, and are not where it is that at rest."""
        def stiffening(spring, slips):
            offsets, rows, seed = [0.0] * len(slips), [], 7
            for i in range(1500):
                # Seldom near 0, where a law's map rounds off the corner that a power has.
                u = 0.5e-3 * (i > 0) + 4.5e-3 * math.sin(0.025 * i) ** 2 * (0.3 + 0.7 * i / 1500)
                w, slope, force = 5e-3 * (u / 5e-3) ** 1.5, 1.5 * math.sqrt(u / 5e-3), 0.0
                for k, (stiffness, limit) in enumerate(slips):
                    offsets[k] = min(max(offsets[k], w - limit / stiffness), w + limit / stiffness)
                    force += stiffness * (w - offsets[k])
                seed = 16807 * seed % 2147483647
                noise = 1e-3 * math.sqrt(12) * (seed / 2147483647 - 0.5)
                rows.append(f"{i / 100},{u!r},{slope * (spring * w + force) + noise!r}\n")
            return "time [s],position [m],force [N]\n" + "".join(rows)

        def left_by(network, recording):
            self.dashpot("simulate", network, "--input", recording, "-o", "out.csv")
            with open(self.folder / recording) as recorded, open(self.folder / "out.csv") as simulated:
                pairs = list(zip(csv.DictReader(recorded), csv.DictReader(simulated)))
            self.assertEqual(len(pairs), 1500)
            left = [float(a["force [N]"]) - float(b["force"]) for a, b in pairs]
            return math.sqrt(sum(e * e for e in left) / len(left))

        self.write("one.csv", stiffening(200, [(400, 0.15)]))
        told = self.told("one.csv", "--shape", "power", "--slips", "auto", "-o", "one.json")
        self.assertLess(told["rms"], 1.1e-3)
        self.assertLess(left_by("one.json", "one.csv"), 1.1e-3)
        self.write("two.csv", stiffening(0, [(400, 0.3), (300, 0.7)]))
        for shape in ("power", "table", "auto"):
            told = self.told("two.csv", "--shape", shape, "--slips", "2", "-o", f"{shape}.json")
            self.assertAlmostEqual(left_by(f"{shape}.json", "two.csv"), told["rms"], delta=1e-3)

    def test_refuses(self):
        """Fails if a choice that makes no sense, or is not there yet, passes."""
        self.write("zener.csv", recording())
        for words, code in (
                (["--shape", "power", "--control", "force"], "fit-choices-contradict"),
                (["--shape", "auto", "--relaxation"], "fit-choices-contradict"),
                (["--elastic", "--creep"], "fit-choices-contradict"),
                (["--elastic", "--modes", "2"], "fit-choices-contradict"),
                (["--elastic", "--slips", "auto"], "fit-choices-contradict"),
                (["--columns", "thyme=t:s"], "columns-malformed"), (["--columns", "time"], "columns-malformed"),
                (["--geometry", "cube:edge=1mm"], "geometry-malformed"),
                (["--geometry", "punch:radius=1s"], "geometry-malformed"),
                (["--geometry", "needle:radius=2mm,length=1mm,outer=1mm"], "geometry-malformed"),
                (["--scale", "much"], "fit-wrong-quantity"), (["--tolerance", "1mm"], "fit-wrong-quantity"),
                (["--tolerance", "0"], "fit-wrong-quantity"), (["--contact", "2N"], "fit-wrong-quantity"),
                (["--force-delay", "2mm"], "fit-wrong-quantity"), (["--slips", "many"], "fit-wrong-quantity"),
                (["--relaxation", "--creep"], "fit-choices-contradict"),
                (["--gain-per-file"], "fit-choices-contradict"),
                (["--slips", "auto", "--control", "force"], "fit-choices-contradict"),
                (["--springpots", "auto", "--control", "force"], "fit-choices-contradict")):
            done = self.dashpot("fit", "zener.csv", *words, status=COMMAND_LINE_WRONG)
            self.assertIn(f"[{code}]", done.stderr, words)
        self.dashpot("fit", status=COMMAND_LINE_WRONG)
        self.dashpot("fit", "zener.csv", "--weight", "some", status=COMMAND_LINE_WRONG)
        self.dashpot("fit", "zener.csv", "--shape", "sphere", status=COMMAND_LINE_WRONG)
        spectrum = self.write("spectrum.csv", "omega [rad/s],storage [N/m],loss [N/m]\n1,1,1\n2,2,1\n3,3,1\n")
        self.assertIn("--shape with a spectrum",
                      self.dashpot("fit", spectrum, "--shape", "auto", status=COMMAND_LINE_WRONG).stderr)
        self.dashpot("fit", "zener.csv", "-o", "zener.csv", status=COMMAND_LINE_WRONG)
        self.assertIn("[cannot-read-file]", self.dashpot("fit", "none.csv", status=INPUT_REFUSED).stderr)
        self.assertIn("[recordings-differ]", self.dashpot(
            "fit", "zener.csv", self.write("s.csv", "omega [rad/s],storage [N/m],loss [N/m]\n1,1,1\n2,2,1\n3,3,1\n"),
            status=INPUT_REFUSED).stderr)

    def test_a_spectrum_of_the_other_sign(self):
        """Fails if losses that are negative, as with time as exp(-iwt), are fitted, or the command line that turns them
        does not."""
        self.write("turned.csv", "frequency [Hz],storage [N/m],loss [N/m]\n" + "".join(
            f"{w / (2 * math.pi)!r},{G.real!r},{-G.imag!r}\n"
            for w in (0.1 * 1.3 ** i for i in range(30)) for G in [100 + 150 * 0.3j * w / (1 + 0.3j * w)]))
        told = self.refused("fit", "turned.csv", "-o", "zener.json", code="recording-signs").stderr
        answer = re.search(r"this turns the sign of loss: dashpot (.*?)(?: \[[a-z-]+\])?$", told, re.MULTILINE)[1]
        self.dashpot(*answer.split())
        found = json.loads((self.folder / "zener.json").read_text())["fit"]
        self.assertGreater(found["r_squared"], 0.999999)

    def test_what_only_a_motion_has(self):
        """Fails if an option that is about positions and forces over time crashes on a relaxation, creep or a spectrum,
        or is passed over in silence there; or if that is another error once the header has said what the recording
        is."""
        self.write("relaxation.csv", "time [s],modulus [N/m]\n0.01,1500\n0.1,1300\n1,1100\n10,1000\n")
        self.write("creep.csv", "time [s],compliance [m/N]\n0.01,0.1\n0.1,0.12\n1,0.15\n10,0.16\n")
        self.write("spectrum.csv", "omega [rad/s],storage [N/m],loss [N/m]\n1,1,1\n2,2,1\n3,3,1\n")
        kinds = [("relaxation.csv", [], "a relaxation"), ("relaxation.csv", ["--relaxation"], "--relaxation"),
                 ("creep.csv", [], "creep"), ("creep.csv", ["--creep"], "--creep"),
                 ("spectrum.csv", [], "a spectrum")]
        for option in self.ONLY_OF_A_MOTION:
            for name, words, other in kinds:
                if option[0] == "--control" and "creep" in other: continue
                done = self.dashpot("fit", name, *words, *option, "-o", "not.json", status=COMMAND_LINE_WRONG)
                self.assertRegex(done.stderr, rf"{option[0]}( force)? with {other}: .*\[fit-choices-contradict\]")
        done = self.dashpot("fit", "creep.csv", "--springpots", "auto", status=COMMAND_LINE_WRONG)
        self.assertIn("--springpots auto with creep: ", done.stderr)
        self.assertNotIn("not.json", self.files())

    # Controlled forces are what creep is.
    ONLY_OF_A_MOTION = (["--contact", "1mm"], ["--contact", "find"], ["--shape", "auto"], ["--elastic"],
                        ["--slips", "auto"], ["--tare"], ["--force-delay", "5ms"], ["--start", "moving"],
                        ["--control", "force"])

    def test_weights_that_are_not_there(self):
        """Fails if rows are said to be weighed by a deviation that no column has, or one of the force weighs
        positions."""
        self.write("zener.csv", recording())
        header, *rows = recording().splitlines()
        self.write("measured.csv", "\n".join([header + ",sd [mN]", *(row + ",1" for row in rows)]) + "\n")
        weighed = ["--weight", "deviation"]
        for words, other in ((["zener.csv"], "'zener.csv': it has no column"),
                             (["measured.csv", "zener.csv"], "'zener.csv': it has no column"),
                             (["measured.csv", "--hold-out", "zener.csv"], "'zener.csv': it has no column"),
                             (["measured.csv", "--control", "force"], "--control force: ")):
            done = self.dashpot("fit", *words, *weighed, status=COMMAND_LINE_WRONG)
            self.assertIn(f"--weight deviation with {other}", done.stderr)
            self.assertIn("[fit-choices-contradict]", done.stderr)
        self.assertIn("K1 150", self.fit("measured.csv", *weighed).stdout)

    def test_losses_are_weighed_by_their_deviation(self):
        """Fails if the deviation of a spectrum weighs its storages alone: here every third row is wrong, and said to
        be."""
        spectrum = [(w, 100 + 150 * 0.3j * w / (1 + 0.3j * w)) for w in (0.1 * 1.3 ** i for i in range(30))]
        self.write("doubted.csv", "omega [rad/s],storage [N/m],loss [N/m],sd [N/m]\n" + "".join(
            f"{w!r},{G.real!r},{G.imag + (200 if i % 3 == 0 else 0)!r},{1e6 if i % 3 == 0 else 1}\n"
            for i, (w, G) in enumerate(spectrum)))
        for element, value in zip(self.told("doubted.csv", "--weight", "deviation")["elements"], (100, 150, 45),
                                  strict=True):
            self.assertAlmostEqual(element["value"] / value, 1, places=3)

    def test_advice_that_suits_a_relaxation(self):
        """Fails if a relaxation that no network explains is told to try what only a motion has."""
        self.write("waves.csv", "time [s],modulus [N/m]\n" + "".join(
            f"{i / 100!r},{100 + 20 * math.sin(i / 12)!r}\n" for i in range(400)))
        told = self.fit("waves.csv").stderr
        self.assertIn("[fit-floor-above-noise]", told)
        self.assertIn("note: --gain-per-file takes", told)
        for option in ("--contact", "--slips", "--shape", "--tare"): self.assertNotIn(option, told)

    def test_network_and_page_in_one_file(self):
        """Fails if a network and its page are written over each other, or over what was there."""
        self.write("zener.csv", recording())
        (self.folder / "here").symlink_to(".")
        for page in ("zener.json", "./zener.json", "here/zener.json"):
            self.write("zener.json", "kept")
            done = self.dashpot("fit", "zener.csv", "-o", "zener.json", "--report", page, status=COMMAND_LINE_WRONG)
            self.assertIn("[same-output]", done.stderr)
            self.assertEqual((self.folder / "zener.json").read_text(), "kept")
        done = self.dashpot("fit", "zener.csv", "-o", "new.json", "--report", "here/new.json",
                            status=COMMAND_LINE_WRONG)
        self.assertIn("[same-output]", done.stderr)

    def test_the_same_recording_twice(self):
        """Fails if one recording counts twice, or is held out of itself, without a word; or if another one is taken for
        it."""
        self.write("zener.csv", recording())
        self.write("copy.csv", recording())
        self.write("other.csv", recording() + "\n")
        said = self.dashpot("fit", "zener.csv", "copy.csv").stderr
        self.assertIn("'copy.csv' is the same as 'zener.csv'", said)
        self.assertIn("[recording-twice]", said)
        self.assertIn("[recording-held-out-fitted]", self.dashpot("fit", "zener.csv", "--hold-out", "copy.csv").stderr)
        self.assertNotIn("byte for byte", self.dashpot("fit", "zener.csv", "other.csv").stderr)

    def test_a_delay_longer_than_the_recording(self):
        """Fails if a force is moved beyond the ends of its recording, where nothing is known of it."""
        self.write("zener.csv", recording())
        self.assertIn("[recording-delay-too-long]",
                      self.dashpot("fit", "zener.csv", "--force-delay", "1000 s", status=INPUT_REFUSED).stderr)

    def test_check_reads_what_is_there(self):
        """Fails if check takes a recording or a device for a broken network, or a broken recording for a sound one."""
        self.write("zener.csv", recording())
        self.write("falls.csv", recording() + "0,0,0\n")
        done = self.dashpot("check", "zener.csv", SOURCE / "runtime/devices/board_mps2.json", FIG_5)
        self.assertEqual(done.stdout + done.stderr, "")
        self.refused("check", "zener.csv", "falls.csv", code="recording-time-falls")
        done = self.dashpot("check", TITIN[0], status=INPUT_REFUSED)
        self.assertIn(f"dashpot check {TITIN[0]} --columns time=Time:s,", done.stderr)
        self.write("device.json", '{ "dashpot_device": 1, "name": "arm", "loop": { "rate": "10 m" } }')
        done = self.dashpot("check", "device.json", status=INPUT_REFUSED)
        self.assertNotIn("[device-instead-of-network]", done.stderr)

    def test_check_takes_what_fit_takes_to_read(self):
        """Fails if check does not take columns or a geometry, or refuses a recording that wants nothing else."""
        self.write("relax.csv", "time [s],modulus [kPa]\n0,3\n1,2\n2,1.5\n3,1.2\n")
        done = self.dashpot("check", "relax.csv")
        self.assertIn("'relax.csv' reads well", done.stderr)
        self.assertIn("[recording-awaits-geometry]", done.stderr)
        self.write("motion.csv", "t,x_mm\n0,0\n0.001,0.1\n0.002,0.2\n")
        self.assertEqual(self.dashpot("check", "relax.csv", "motion.csv", "--geometry", "punch:radius=4mm").stderr, "")
        self.refused("fit", "relax.csv", "-o", "not.json", code="recording-without-geometry")
        self.write("bare.csv", "0,3\n1,2\n2,1.5\n3,1.2\n")
        done = self.dashpot("check", "bare.csv", "--no-header", "--columns", "time=1:s,modulus=2:N/m")
        self.assertEqual(done.stderr, "")
        self.write("bad.csv", "time [s],modulus [kPa]\n0,3\n1,x\n2,1.5\n3,1.2\n")
        self.assertNotIn("reads well", self.refused("check", "bad.csv", code="recording-not-a-number").stderr)
        done = self.dashpot("check", "relax.csv", "--geometry", "cube", status=COMMAND_LINE_WRONG)
        self.assertIn("[geometry-malformed]", done.stderr)

    def test_a_table_after_a_step_is_told_by_its_header(self):
        """Fails if a modulus or a compliance over time has to be asked for, or is then read as anything else."""
        times = [0.01 * 1.2 ** i for i in range(40)]
        relaxing = [(t, 100 + 150 * math.exp(-t / 0.3)) for t in times]
        creeping = [(t, 1 / 100 - (1 / 100 - 1 / 250) * math.exp(-t / 0.75)) for t in times]
        for option, header, rows in [("--relaxation", "modulus [N/m]", relaxing),
                                     ("--creep", "compliance [m/N]", creeping)]:
            self.write("table.csv", f"time [s],{header}\n" + "".join(f"{t!r},{value!r}\n" for t, value in rows))
            done = self.dashpot("check", "table.csv")
            self.assertEqual(done.stdout + done.stderr, "")
            self.fit("table.csv", "--name", "body", "-o", "plain.json")
            self.fit("table.csv", "--name", "body", option, "-o", "asked.json")
            plain, asked = ((self.folder / name).read_text() for name in ["plain.json", "asked.json"])
            self.assertEqual(plain.replace("plain.json", ""), asked.replace(f"{option} ", "").replace("asked.json", ""))
            self.refused("fit", "table.csv", "--columns", "time=time", "-o", "not.json",
                         code="recording-column-missing")

    def test_a_unit_that_is_not_known(self):
        """Fails if a row of units with one that is not known is taken for names, whose units are then made up."""
        rows = recording().splitlines()[1:]
        for units, column, unit in (("fortnights,mm,mN", "Time", "fortnights"), ("min,mm,gf", "Force", "gf")):
            self.write("units.csv", "\n".join(["Time,Displacement,Force", units, *rows]) + "\n")
            done = self.refused("fit", "units.csv", "-o", "not.json", code="recording-wrong-unit")
            self.assertIn(f"column '{column}' in '{unit}'", done.stderr)
            for made_up in ("=mm", "=mN", "=min", "=gf", "=fortnights", "[recording-answer]"):
                self.assertNotIn(made_up, done.stderr)
        # All of them at once.
        self.write("units.csv", "\n".join(["time [s],position [foo],force [stones]", *rows]) + "\n")
        told = self.refused("fit", "units.csv", "-o", "not.json", code="recording-wrong-unit").stderr
        for unit in ("foo", "stones"): self.assertIn(f"in '{unit}'", told)
        self.assertIn("has to be converted first", told)

    def test_an_empty_last_field(self):
        """Fails if a row whose last field is empty is said to be short of it; or a row that only ends with a comma is
        refused."""
        rows = recording().splitlines()
        self.write("open.csv", "\n".join(rows[:50] + [rows[50].rsplit(",", 1)[0] + ","] + rows[51:]) + "\n")
        done = self.refused("fit", "open.csv", "-o", "not.json", code="recording-not-a-number")
        self.assertIn("force", done.stderr)
        self.assertNotIn("[recording-field-count]", done.stderr)
        self.write("commas.csv", "\n".join([rows[0]] + [row + "," for row in rows[1:]]) + "\n")
        self.fit("commas.csv")

    def test_a_surface_is_told(self):
        """Fails if it is not said where the surface was found, and how many rows are without touch."""
        self.write("touched.json", """{ "dashpot": 1, "name": "touched", "contact": { "at": "0.5 mm" }, "network": { "parallel": [
            { "spring": "300 N/m" }, { "series": [ { "spring": "200 N/m" }, { "damper": "100 N s/m" } ] } ] } }""")
        ends = [(0, 0), (2, 2e-3), (4, 2e-3), (4.2, 0), (5, 0)]

        def way(t):
            (a, x), (b, y) = next(pair for pair in zip(ends, ends[1:]) if t <= pair[1][0])
            return x + (y - x) * (t - a) / (b - a)
        self.write("motion.csv", "time,position\n" + "".join(f"{i / 100},{way(i / 100)!r}\n" for i in range(501)))
        self.dashpot("simulate", "touched.json", "--input", "motion.csv", "-o", "touched.csv")
        columns = ["touched.csv", "--columns", "time=time:s,position=position:m,force=force:N"]
        done = self.fit(*columns, "--contact", "find", "-o", "fitted.json")
        self.assertRegex(done.stdout, r"surface found at (500|499\.\d|500\.\d) um")
        self.assertRegex(done.stdout, r"\d+ of the rows are left out: there the tool moves back faster than the tissue")
        self.assertGreater(json.loads((self.folder / "fitted.json").read_text())["fit"]["recordings"][0]["free_rows"],
                           5)
        told = self.told(*columns, "--contact", "0.5 mm")
        self.assertEqual(told["contact"], {"at": 5e-4, "found": False})
        for element, value in zip(told["elements"], (300, 200, 100), strict=True):
            self.assertAlmostEqual(element["value"] / value, 1, places=4)

    def test_a_surface_far_from_zero(self):
        """Fails if the surface is looked for from 0 on, and not where the tool goes: far from 0 there are a few places
        then, or none, to try. The numbers are those of the machine's axis, and say nothing of the tissue."""
        for origin in (0, 30, 60, 100, 150, -156):
            self.write("far.csv", approach(origin=origin))
            for words in ([], ["--shape", "auto"]) if abs(origin) > 100 else ([],):
                at = self.told("far.csv", "--contact", "find", *words)["contact"]["at"]
                self.assertAlmostEqual(at, 1e-3 * (origin + 2.6), delta=0.01e-3, msg=(origin, words))

    def test_a_surface_beyond_the_way(self):
        """Fails if a surface that no tool has reached is fitted behind, which took forever with a shape; or if it is
        not said how far the tool went."""
        self.write("approach.csv", approach())
        for words in ([], ["--shape", "auto"], ["--elastic"]):
            for surface in ("6.6 mm", "2 m"):
                done = self.refused("fit", "approach.csv", "--contact", surface, *words, code="fit-surface-beyond")
                self.assertIn("which go from 0 m to 6.6 mm", done.stderr)
                self.assertIn("note: --contact find looks for the surface", done.stderr)

    def test_a_tool_that_presses_backwards(self):
        """Fails if rows of a tool that presses towards falling positions, which a surface takes for no touch, are left
        out without a word; or if what would turn them is not told, or does not."""
        header, *rows = approach(origin=150).splitlines()
        self.write("back.csv", "\n".join([header, *(re.sub(r",(-?)", lambda m: "," + ("" if m[1] else "-"), row)
                                                    for row in rows)]) + "\n")
        turned = "position=-position,force=-force"
        for surface in ("find", "-152.6 mm"):
            done = self.refused("fit", "back.csv", f"--contact={surface}", "-o", "back.json", code="recording-signs")
            self.assertIn("the force is negative, and the tool presses towards falling positions", done.stderr)
            self.assertIn(f"--columns time=time,{turned}", done.stderr)
        at = self.told("back.csv", "--contact", "find", "--columns", turned)["contact"]["at"]
        self.assertAlmostEqual(at, 152.6e-3, delta=0.01e-3)
        self.fit("back.csv")

    def test_a_tool_that_comes_from_in_front(self):
        """Fails if a recording that begins in front of the tissue is fitted as if it touched, and nobody hears of
        it."""
        self.write("approach.csv", approach())
        self.write("zener.csv", recording())
        for words in ([], ["--shape", "auto"]):
            done = self.fit("approach.csv", *words)
            self.assertRegex(done.stderr,
                             "in 'approach.csv' the force stays at its noise while the tool goes from "
                             r"0 m to 2\.6\d* mm")
            self.assertIn("note: --contact find looks for the surface", done.stderr)
        self.assertNotIn("[fit-untouched]", self.fit("approach.csv", "--contact", "find").stderr)
        self.assertNotIn("[fit-untouched]", self.fit("zener.csv").stderr)

    def test_what_is_not_known(self):
        """Fails if a value that the rows do not decide at all has an interval beyond what a double holds, in the
        answer, the file or the page. A table that begins in front of the tissue has such forces."""
        self.write("approach.csv", approach())
        done = self.fit("approach.csv", "--shape", "table", "--elastic", "-o", "table.json", "--report", "table.html")
        self.assertRegex(done.stdout, r"force at \S+ \w+ \S+ \w*N, 95 %: not known, not to a factor of a million\n")
        self.assertRegex(done.stdout, r"force at 6\.6 mm \S+ m?N, 95 %: \S+ m?N … ")
        self.assertIn("(95 %: not known)", (self.folder / "table.html").read_text())
        intervals = json.loads((self.folder / "table.json").read_text())["fit"]["intervals"]
        told = self.told("approach.csv", "--shape", "table", "--elastic")["static"]["values"]
        self.assertEqual([value["name"] in intervals for value in told],
                         [value["interval"] is not None for value in told])
        for text in (done.stdout, (self.folder / "table.json").read_text(), (self.folder / "table.html").read_text()):
            self.assertNotRegex(text, r"\bnan\b|\binf\b")

    def test_a_few_rows(self):
        """Fails if rows are worth more samples than there are, which makes intervals of nothing."""
        rows = ["0,0,0", "0.1,1,0.1", "0.2,2,0.22", "0.3,3,0.3", "0.4,4,0.41", "0.5,5,0.5", "0.6,6,0.61", "0.7,7,0.7"]
        for count in (3, 5, 8):
            self.write("few.csv", "\n".join(["time [s],position [mm],force [N]", *rows[:count]]) + "\n")
            told = self.told("few.csv")
            self.assertEqual(told["effective_samples"], count)
            self.assertEqual(told["files"][0]["effective_samples"], count)
            is_known = count >= told["parameters"] + 5
            self.assertEqual("[fit-no-intervals]" in self.fit("few.csv").stderr, not is_known)
            for element in told["elements"]: self.assertEqual(element["interval"] is not None, is_known)

    def test_a_few_rows_of_a_spectrum(self):
        """Fails if storage and loss of a row are told as two rows."""
        self.write("few.csv", "frequency [Hz],storage [N/m],loss [N/m]\n0.1,10,0.2\n1,11,1\n10,20,5\n")
        self.assertIn("warning: 3 rows for 3 parameters do not decide", self.fit("few.csv").stderr)

    def test_a_surface_that_is_not_left(self):
        """Fails if rows are left out that carry a force, and R² alone is reported; or if rows without force are
        blamed."""
        self.write("leaves.csv", approach())
        self.write("sticks.csv", approach(force_after_lift_off=-0.3))
        surface = ["--contact", "2.6 mm"]
        self.assertNotIn("[fit-left-out-pushes]", self.fit("leaves.csv", *surface).stderr)
        done = self.fit("sticks.csv", *surface, "--report", "sticks.html")
        self.assertRegex(done.stderr, r"of 'sticks.csv' that are left out, the force is up to 3\d\d(\.\d+)? mN")
        told = self.told("sticks.csv", *surface)["files"][0]
        self.assertGreater(told["free_rms"], 0.1)
        self.assertGreater(told["r_squared"], 0.999)
        page = (self.folder / "sticks.html").read_text()
        for part in ("<dt>surface, given</dt><dd>2.6 mm</dd>", f"{told['free_rows']} of {told['rows']} rows left out",
                     '<span class="key aside dots">left out</span>'):
            self.assertIn(part, page)

    def test_sizes_behind_a_surface(self):
        """Fails if sizes, effective samples and floor are reported of a surface that the chosen network does not
        leave."""
        self.write("approach.csv", approach())
        told = self.told("approach.csv", "--contact", "find")
        chosen = min(told["sizes"], key=lambda entry: entry["criterion"])
        self.assertLess(chosen["rms"], 1.02 * told["rms"])
        self.assertGreater(told["effective_samples"], 0.5 * sum(file["effective_samples"] for file in told["files"]))

    def test_a_line_without_end(self):
        """Fails if a line is read for as long as it lasts."""
        self.write("endless.csv", "time [s],position [mm],force [N]\n" + "1" * (3 << 20))
        done = self.dashpot("fit", "endless.csv", status=INPUT_REFUSED)
        self.assertIn("line 2 of 'endless.csv' is longer than 1 MiB", done.stderr)
        self.assertIn("[recording-line-too-long]", done.stderr)

    @unittest.skipUnless(os.environ.get("DASHPOT_LONG") == "1", "360 MB are written and read; with DASHPOT_LONG=1")
    def test_memory(self):
        """Fails if a million rows of forty columns take more than 1 GB: those that are not needed are not kept."""
        others = ",0.123456" * 37
        header, *rows = recording(1_000_000, 0.001).splitlines()
        with (self.folder / "large.csv").open("w") as file:
            file.write(header + "".join(f",c{i} [V]" for i in range(37)) + "\n")
            file.writelines(f"{row}{others}\n" for row in rows)
        with subprocess.Popen([DASHPOT, "fit", "large.csv"], cwd=self.folder, stdout=subprocess.DEVNULL) as run:
            _, status, used = os.wait4(run.pid, 0)
            run.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(run.returncode, 0)
        self.assertLess(used.ru_maxrss, 1_000_000)  # [kB]

    def test_larger_than_other_files(self):
        """Fails if a recording above the 16 MiB of other files is refused."""
        rows = recording(400).splitlines()
        wide = rows[0] + "".join(f",c{i} [V]" for i in range(400)) + "\n" + "\n".join(row + ",0.123456789" * 400
                                                                                      for row in rows[1:]) + "\n"
        text = wide + "".join(f"{2 + i / 200:.3f},0,0" + ",0.123456789" * 400 + "\n" for i in range(3500))
        self.assertGreater(len(text), 16 << 20)
        self.write("wide.csv", text)
        self.fit("wide.csv")


if __name__ == "__main__":
    unittest.main()
