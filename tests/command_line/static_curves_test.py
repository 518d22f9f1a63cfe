"""Static curves in every command that compiles a network."""
import json
import math
import os
import re
import unittest

from dashpot_command import INPUT_REFUSED, SOURCE, CommandTest

SPHERE, SKIN, LIGAMENT = (SOURCE / f"networks/static/{name}.json"
                          for name in ["sphere_on_gel", "skin_in_contact", "ligament"])
IS_LONG = os.environ.get("DASHPOT_LONG") == "1"
TRAINER = SOURCE / "examples/breast_palpation/device.json"
KNEE = SOURCE / "examples/knee_ligament/device.json"
PANTOGRAPH = SOURCE / "runtime/devices/pantograph_brake_2009.json"
CONE = {"dashpot": 1, "name": "cone", "static": {"power": 2, "force": "1 N", "at": "5 mm"},
        "network": {"parallel": [{"spring": "300 N/m"}, {"series": [{"spring": "200 N/m"}, {"damper": "30 N s/m"}]}]}}


class StaticCurvesTest(CommandTest):

    # If this fails, what is felt at rest is not the curve of the file.
    def test_simulate_settles_on_the_curve(self):
        rows = ["time,position"] + [f"{i / 1000},{min(i, 300) * 1e-5 + 2e-3}" for i in range(20000)]
        self.write("motion.csv", "\n".join(rows) + "\n")
        answer = self.dashpot("simulate", SKIN, "--input", "motion.csv").stdout.splitlines()
        force = float(answer[-1].split(",")[answer[0].split(",").index("force")])
        # 3 mm beyond the surface, of a curve up to 1.47 N, met to 0.05 %
        self.assertAlmostEqual(force, 0.27, delta=1e-3)

    def test_a_curve_at_once_has_its_slips_stuck(self):
        """Fails if a step within one sample is not answered by the curve at once where springs are behind slips too; or
        if verify makes the map of other springs."""
        curve = {"power": 2, "force": "2 N", "at": "5 mm", "is": "instantaneous"}
        tree = {"parallel": [{"spring": "400 N/m"}, {"series": [{"slip": "100 N"}, {"spring": "200 N/m"}]}]}
        netlist = [{"spring": "400 N/m", "nodes": ["tool", "ground"]}, {"spring": "300 N/m", "nodes": ["tool", "a"]},
                   {"spring": "100 N/m", "nodes": ["tool", "b"]}, {"slip": "100 N", "nodes": ["a", "b"]},
                   {"spring": "200 N/m", "nodes": ["a", "ground"]}, {"spring": "500 N/m", "nodes": ["b", "ground"]}]
        self.write("motion.csv", "time,position\n0,0\n0.001,0.005\n")
        for name, structure in [("tree", {"network": tree}), ("bridge", {"elements": netlist}),
                                ("alone", {"network": tree["parallel"][1]})]:
            with self.subTest(network=name):
                self.write(f"{name}.json", json.dumps({"dashpot": 1, "name": name, "static": curve, **structure}))
                answer = self.dashpot("simulate", f"{name}.json", "--input", "motion.csv").stdout.splitlines()
                self.assertAlmostEqual(float(answer[-1].split(",")[3]), 2, delta=1e-12)
                self.dashpot("compile", f"{name}.json", "--certificate", "law.json")
                self.dashpot("verify", "law.json", f"{name}.hpp", "--allow-uncertified")

    # If this fails, explain does not tell what is compiled.
    def test_explain_tells_curve_and_map(self):
        text = self.dashpot("explain", SPHERE, "--legend").stdout
        for words in ["power 1.5", "cubics up to 0.006 m", "seen through it", "quasi-linear law"]:
            self.assertIn(words, text)
        told = json.loads(self.dashpot("explain", SPHERE, "--json", "--no-advice").stdout)["static"]
        self.assertEqual((told["stiffness"], told["reach"], told["begins"]), (400, 0.006, 0))
        self.assertLess(told["largest_error"], 5e-4)
        # w'^2 = f^2/(2 k E) is 5/4 c sqrt(u)/k of Hertz' curve.
        c = 4 / 3 * 50e3 / 0.75 * math.sqrt(0.01)
        self.assertAlmostEqual(told["largest_scale"], 1.25 * c * math.sqrt(0.006) / 400, places=6)
        self.assertIsNone(json.loads(self.dashpot("explain", SOURCE / "networks/paper/kelvin.json",
                                                  "--json").stdout)["static"])

    def test_a_contact_lets_go_where_it_says(self):
        """Fails if the gap behind which a contact lets go is reported as it is behind the curve's map, and not as it is
        at the tool; or if another reason than the curve is given for a force without a bound."""
        flat = {"dashpot": 1, "name": "flat", "network": {"spring": "100 N/m"}, "contact": {"at": "0 mm"}}
        hertz = {**flat, "name": "hertz", "static": {"power": 1.5, "force": "1 N", "at": "5 mm"}}
        gaps = []
        for network, words in ((flat, "one step of the encoder"),
                               (hertz, "as far along the stretched position as one step of the encoder")):
            self.write("network.json", json.dumps(network))
            told = " ".join(self.dashpot("explain", "network.json", "--device", TRAINER).stdout.split())
            gaps.append(float(re.search(rf"from a gap of (\S+) m on, {words}", told)[1]))
        # w is a multiple of u^5/4, and so steepest at 5 mm; of which the first cubic is a rough picture.
        self.assertAlmostEqual(math.log2(gaps[1] / (1.25 * 5e-3 ** 0.25 * gaps[0]) ** 0.8), 0, delta=1)
        self.assertIn("no bound is proved on the force that the law asks for", told)
        self.assertIn("because it has a static curve", told)

    # If this fails, a law behind a curve is not certified where it was, or verify does not know it again.
    def test_certified_laws_are_verified(self):
        for network, device, name in [(SKIN, TRAINER, "skin_in_contact"), (SPHERE, TRAINER, "sphere_on_gel"),
                                      (LIGAMENT, KNEE, "ligament")]:
            with self.subTest(name):
                self.dashpot("compile", network, "--device", device, "--certificate", "law.json", "--uncertified",
                             "--no-advice")
                certificate = json.loads((self.folder / "law.json").read_text())["passivity"]
                done = self.dashpot("verify", "law.json", f"{name}.hpp", status=None)
                self.assertEqual(done.returncode == 0, certificate["certified"], done.stdout + done.stderr)
                again = self.dashpot("verify", "law.json", f"{name}.hpp", "--allow-uncertified").stdout
                self.assertIn("recomputed from the network in 100 digits; banner and code are those of the network",
                              again)
        self.dashpot("compile", SKIN, "--device", TRAINER, "--certificate", "law.json")
        self.assertTrue(json.loads((self.folder / "law.json").read_text())["passivity"]["certified"])

    # If this fails, a law that cannot be certified ends in a defect, or in the advice to scale what the curve alone
    # says.
    def test_a_curve_that_needs_too_much_is_refused(self):
        self.write("cone.json", json.dumps(CONE))
        refused = self.dashpot("compile", "cone.json", "--device", PANTOGRAPH, status=INPUT_REFUSED).stderr
        self.assertIn("[not-certified]", refused)
        # A brake that is enough ruins the feel.
        self.assertIn('good enough if its loop had no delay ("delay_samples")', refused)
        self.assertNotIn("of its stiffness", refused)
        # Faster, the jitter is a sample, and nothing is known of the lag.
        self.assertNotIn("Hz would be enough", refused)

    # If this fails, the table promises of a candidate what it does not keep when it is chosen.
    def test_candidates_need_what_they_need_when_chosen(self):
        self.write("cone.json", json.dumps(CONE))
        for network, devices in [("cone.json", [PANTOGRAPH, TRAINER]), (LIGAMENT, [KNEE]),
                                 (SKIN, [PANTOGRAPH, TRAINER])]:
            for device in devices if IS_LONG else devices[:1]:
                told = self.dashpot("explain", network, "--device", device, "--json")
                for row in json.loads(told.stdout)["candidates"]:
                    own = json.loads(self.dashpot("explain", network, "--device", device, "--json", "--decomposition",
                                                  row["name"]).stdout)
                    chosen = next(c for c in own["candidates"] if c["name"] == row["name"])
                    with self.subTest(network=network, device=device, candidate=row["name"]):
                        if row["minimum_damping"] is None or chosen["minimum_damping"] is None:
                            self.assertEqual(row["minimum_damping"], chosen["minimum_damping"])
                        else:
                            self.assertAlmostEqual(row["minimum_damping"], chosen["minimum_damping"],
                                                   delta=1e-6 * (1 + row["minimum_damping"]))

    # If this fails, a wrong number in a table of the map passes.
    def test_every_table_is_recomputed(self):
        self.dashpot("compile", SKIN, "--certificate", "law.json")
        header, certificate = (self.folder / "skin_in_contact.hpp").read_text(), (self.folder / "law.json").read_text()
        for table in ["cell_begins", "map_a", "map_b", "map_c", "map_e"]:
            numbers = re.search(rf" {table}\[\d+\] = {{(.*?)}};", header, re.DOTALL).group(1)
            place, number = next((i, n) for i, n in enumerate(re.split(r",\s+", numbers)) if i > 30
                                 and abs(float(n)) > 1e-12)
            wrong = json.loads(certificate)
            wrong["constants"][table][place] = math.nextafter(float(number), math.inf)
            replaced = numbers.replace(number, repr(wrong["constants"][table][place]), 1)
            self.assertNotEqual(replaced, numbers)
            self.write("wrong.json", json.dumps(wrong, indent=2))
            self.write("wrong.hpp", header.replace(numbers, replaced))
            done = self.dashpot("verify", "wrong.json", "wrong.hpp", "--allow-uncertified", status=INPUT_REFUSED)
            self.assertIn(f"'{table}'", done.stderr)

    # If this fails, a page with a static curve is not written, or shows closed forms of another law.
    def test_report_shows_the_curve(self):
        self.dashpot("report", SPHERE, "-o", "page.html")
        page = (self.folder / "page.html").read_text()
        self.assertIn("Force at rest", page)
        self.assertIn("emitted map", page)
        self.assertNotIn("Hysteresis</h2>", page)

    # If this fails, a header of many points with a wrong number in it passes, or one without is refused.
    def test_many_points_are_verified(self):
        self.dashpot("compile", SKIN, "--batch", "--certificate", "law.json")
        points = (self.folder / "skin_in_contact_batch.hpp").read_text()
        verify = ["verify", "law.json", "skin_in_contact_batch.hpp", "--allow-uncertified"]
        self.assertIn("banner and code are those of the network", self.dashpot(*verify).stdout)
        number = re.search(r" map_b\[\d+\] = {(?:[^,]+,\s+){20}([^,]+),", points).group(1)
        self.write("skin_in_contact_batch.hpp", points.replace(number, repr(math.nextafter(float(number), 0)), 1))
        self.assertIn("[code-differs]", self.dashpot(*verify, status=INPUT_REFUSED).stderr)

    # If this fails, a law's own test passes a law of another curve, or fails one of its own.
    def test_with_test_holds_the_law_to_its_curve(self):
        instantaneous = {**CONE, "static": {**CONE["static"], "is": "instantaneous"}}
        self.write("cone.json", json.dumps(CONE))
        self.write("at_once.json", json.dumps({**instantaneous, "name": "at_once"}))
        for network, name, device in [(SPHERE, "sphere_on_gel", TRAINER), (SKIN, "skin_in_contact", TRAINER),
                                      (LIGAMENT, "ligament", KNEE), ("cone.json", "cone", None),
                                      ("at_once.json", "at_once", None)]:
            on_device = ["--device", device, "--uncertified", "--no-advice"]
            for choices in [[], on_device if device else ["--scalar", "float"]]:
                with self.subTest(network=name, choices=choices):
                    self.dashpot("compile", network, "--target", "c99", "--with-test", *choices)
                    self.assertIn("passed", self.run_in_c(name))
                    self.assertIn("rest, sample", self.failed_in_c(name, " tangent * ", " 1.01 * tangent * "))

    # If this fails, a step behind a curve may relax as another network does, be felt by another share, meet another
    # brake, or be off by a millionth of a number of the map.
    def test_with_test_steps_along_the_curve(self):
        for network, name, wrong in [(SPHERE, "sphere_on_gel", "brake after a jump"), (SKIN, "skin_in_contact", "")]:
            with self.subTest(network=name):
                done = self.dashpot("compile", network, "--target", "c99", "--with-test")
                self.assertNotIn("checks no force along a motion", done.stderr)
                self.assertIn("passed", self.run_in_c(name))
                header = (self.folder / f"{name}.h").read_text()
                numbers = re.search(r" map_b\[\d+\] = {(.*?)}", header, re.DOTALL).group(1)
                middle = re.split(r",\s+", numbers)[(numbers.count(",") + 1) // 2]
                self.assertIn("jump", self.failed_in_c(name, middle, repr(float(middle) * (1 + 1e-6))))
                decay = re.search(r"decay\w* = ([\d.e-]+)", header).group(1)
                self.assertIn("after a jump", self.failed_in_c(name, decay, repr(float(decay) * (1 - 1e-6))))
                if wrong:
                    self.assertIn(wrong, self.failed_in_c(name, "tangent_squared *", "1.001 * tangent_squared *"))
        self.dashpot("compile", SPHERE, "--device", TRAINER, "--uncertified", "--no-advice", "--target", "c99",
                     "--with-test")
        self.assertIn("passed", self.run_in_c("sphere_on_gel"))

    # If this fails, a command does not take parameters behind a curve, or one claims a proof that there is not.
    def test_parameters_behind_a_curve(self):
        tunable = {**CONE, "name": "tunable_cone", "contact": {"at": "1 mm"},
                   "parameters": {"K": {"value": "300 N/m", "tunable": True, "min": "100 N/m", "max": "900 N/m"},
                                  "tangent": {"value": "30 N s/m", "tunable": True, "min": "10 N s/m",
                                              "max": "90 N s/m"}},
                   "network": {"parallel": [{"spring": "K"}, {"series": [{"spring": "200 N/m"}, {"damper": "tangent"}]},
                                            {"damper": "1 N s/m"}]}}
        self.write("cone.json", json.dumps(tunable))
        rows = ["time,position,K"] + [f"{i / 1000},{min(i, 300) * 1e-5},{300 if i < 6000 else 600}"
                                      for i in range(12000)]
        self.write("motion.csv", "\n".join(rows) + "\n")
        answer = [row.split(",") for row in self.dashpot("simulate", "cone.json", "--input",
                                                         "motion.csv").stdout.splitlines()]
        column = answer[0].index("force")
        self.assertAlmostEqual(float(answer[6000][column]), 0.16, delta=1e-3)  # (2/5)^2 N, 2 mm deep
        self.dashpot("run", "cone.json", "--device", TRAINER, "--for", "0.2", "--fast")
        self.dashpot("check", "cone.json")
        told = json.loads(self.dashpot("explain", "cone.json", "--json", "--no-advice").stdout)
        self.assertEqual(told["static"]["stiffness"], 300)
        self.dashpot("report", "cone.json", "-o", "page.html")
        self.assertIn("emitted map", (self.folder / "page.html").read_text())
        for options in [["--batch"], ["--device", TRAINER]]:
            with self.subTest(options=options[:1]):
                told = self.dashpot("compile", "cone.json", *options, "--certificate", "law.json").stderr
                self.assertRegex(told, "not certified .*(a contact, and parameters that change|no device states)")
                header = "tunable_cone_batch.hpp" if "--batch" in options else "tunable_cone.hpp"
                self.assertFalse(json.loads((self.folder / "law.json").read_text())["passivity"]["certified"])
                verify = ["verify", "law.json", header, "--allow-uncertified"]
                self.assertIn("banner and code are those of the network", self.dashpot(*verify).stdout)
                text = (self.folder / header).read_text()
                number = re.search(r" map_b\[\d+\] = {(?:[^,]+,\s+){20}([^,]+),", text).group(1)
                self.write(header, text.replace(number, repr(math.nextafter(float(number), 0)), 1))
                self.dashpot(*verify, status=INPUT_REFUSED)
        self.dashpot("compile", "cone.json", "--target", "c99", "--with-test")
        self.assertIn("passed", self.run_in_c("tunable_cone"))

    # If this fails, a command does not know that a law behind a curve is certified over the ranges of its parameters,
    # or verify believes other numbers.
    def test_parameters_behind_a_curve_are_certified(self):
        tunable = {**CONE, "name": "tunable_cone",
                   "parameters": {"K": {"value": "300 N/m", "tunable": True, "min": "100 N/m", "max": "600 N/m"},
                                  "B": {"value": "30 N s/m", "tunable": True, "min": "10 N s/m", "max": "90 N s/m"}},
                   "network": {"parallel": [{"spring": "K"}, {"series": [{"spring": "200 N/m"}, {"damper": "B"}]}]}}
        self.write("cone.json", json.dumps(tunable))
        self.write("rig.json", json.dumps({
            "dashpot_device": 1, "name": "rig", "motion": "translation",
            "loop": {"rate": "1 kHz", "band": ["0.1 Hz", "20 Hz"]},
            "encoder": {"resolution": "1 um", "range": ["-6 mm", "6 mm"], "max_speed": "50 mm/s"},
            "velocity": {"estimator": "backward_difference", "window": 4}, "motor": {"max_torque": "20 N"},
            "brake": {"kind": "eddy_current", "max_damping": "100 N s/m"}, "mechanics": {"inertia": "0.1 kg"}}))
        on_rig = ["cone.json", "--device", "rig.json"]
        explained = " ".join(self.dashpot("explain", *on_rig).stdout.split())
        self.assertIn("passivity: certified for any motion, any values within their ranges and any changes of them",
                      explained)
        self.assertNotIn("not certified", self.dashpot("check", *on_rig).stderr)
        for options in [[], ["--constant-time"]]:
            with self.subTest(options=options):
                self.dashpot("compile", *on_rig, *options, "--certificate", "law.json")
                self.assertIn("; certified", self.dashpot("verify", "law.json", "tunable_cone.hpp").stdout)
                text = (self.folder / "tunable_cone.hpp").read_text()
                change = re.search(r"{true, ([^,]+),|largest_change = ([^;]+);", text)
                number = next(group for group in change.groups() if group)
                self.write("tunable_cone.hpp", text.replace(number, repr(float(number) / 2), 1))
                self.dashpot("verify", "law.json", "tunable_cone.hpp", status=INPUT_REFUSED)
        stated = json.loads((self.folder / "law.json").read_text())
        stated["passivity"]["needed_damping"] *= 0.9
        self.write("law.json", json.dumps(stated))
        self.dashpot("compile", *on_rig)
        self.dashpot("verify", "law.json", "tunable_cone.hpp", status=INPUT_REFUSED)

    # If this fails, what a slip holds costs nothing where the curve bends: a tool that trembles there, pulled by it,
    # would gain.
    def test_what_slips_hold_costs_damping_where_the_curve_bends(self):
        self.write("rig.json", json.dumps({
            "dashpot_device": 1, "name": "rig", "motion": "translation",
            "loop": {"rate": "1 kHz", "band": ["0.1 Hz", "20 Hz"]},
            "encoder": {"resolution": "1 um", "range": ["-6 mm", "6 mm"], "max_speed": "50 mm/s"},
            "velocity": {"estimator": "backward_difference", "window": 4}, "motor": {},
            "mechanics": {"inertia": "0.1 kg", "damping": "900 N s/m"}}))
        needed = {}
        for holds in (1, 2, 4):
            self.write("curve.json", json.dumps({
                "dashpot": 1, "name": "curve", "static": {"exponential": "300 1/m", "force": "1 N", "at": "6 mm"},
                "network": {"parallel": [{"spring": 200}, {"series": [{"spring": 20}, {"slip": holds}]}]}}))
            told = json.loads(self.dashpot("explain", "curve.json", "--device", "rig.json", "--json",
                                           "--no-advice").stdout)
            self.assertTrue(told["certificate"]["certified"])
            needed[holds] = told["certificate"]["needed_damping"]
        # w'' of w = sqrt(2 E/k) at 6 mm, by differences; what is held over a millisecond costs half of it for each
        # newton.
        bend = self.bend_of_exponential(1, 300, 6e-3, 200)
        for fewer, more in ((1, 2), (2, 4)):
            self.assertGreater(needed[more] - needed[fewer], 0.9 * (more - fewer) * bend / 2 * 1e-3)

    def bend_of_exponential(self, force, shape, at, stiffness):
        factor = force / math.expm1(shape * at)

        def w(u):
            return math.sqrt(2 * factor / stiffness * (math.expm1(shape * u) / shape - u))
        h = 1e-5
        return (w(at) - 2 * w(at - h) + w(at - 2 * h)) / h ** 2

    # If this fails, slips are felt with another slope than explain allows, or it allows far more than there is.
    def test_how_far_the_slope_is_off_is_told(self):
        power, force, at, stiffness, holds = 1.5, 4, 6e-3, 170, 0.2
        self.write("flat.json", json.dumps({
            "dashpot": 1, "name": "flat", "static": {"power": power, "force": force, "at": at},
            "network": {"parallel": [{"spring": stiffness}, {"series": [{"spring": 2e5}, {"slip": holds}]}]}}))
        rows = [k * 1e-6 for k in range(2000)]
        self.write("motion.csv", "time,position\n" + "".join(f"{k / 1000},{u:.17g}\n" for k, u in enumerate(rows)))
        answer = self.dashpot("simulate", "flat.json", "--input", "motion.csv").stdout.splitlines()
        column = answer[0].split(",").index("force")
        told = json.loads(self.dashpot("explain", "flat.json", "--json", "--no-advice").stdout)["static"]
        steepest = told["largest_scale"] ** 0.5
        worst = 0
        for u, row in list(zip(rows, answer[1:]))[20:]:  # the slip has given way
            curve = force * (u / at) ** power
            slope = curve / (stiffness * math.sqrt(2 * curve * u / (power + 1) / stiffness))
            off = abs((float(row.split(",")[column]) - curve) / holds - slope) / steepest
            allowed = told["largest_error"] * force / holds / steepest
            self.assertLessEqual(off, 1.02 * told["slope_error"] + allowed)  # looked at in 64 places of two cells
            if u > told["slope_unsure_until"] * 1.05:
                self.assertLess(off, 0.01 + allowed)
            worst = max(worst, off)
        self.assertGreater(worst, 0.5 * told["slope_error"])

    # If this fails, something is written of a static curve that does not hold it.
    def test_what_takes_no_curve_says_so(self):
        self.refused("export", SKIN, "--to", "generic", code="not-exported")
        for form in ("kelvin", "maxwell", "prony"):
            self.assertIn("a static curve", self.refused("explain", LIGAMENT, "--as", form, code="not-exported"
                                                         if form == "prony" else "no-linear-form").stderr)
        self.assertEqual(self.files(), [])


if __name__ == "__main__":
    unittest.main()
