"""Several ports on one axis in every command that compiles a network."""
import json
import math
import os
import re
import subprocess
import unittest

from dashpot_command import INPUT_REFUSED, SOURCE, CommandTest

PAD = SOURCE / "networks/static/finger_pad.json"
RIG = {"dashpot_device": 1, "name": "rig", "motion": "translation",
       "loop": {"rate": "5 kHz", "band": ["0.1 Hz", "20 Hz"]},
       "encoder": {"resolution": "1 um", "range": ["-6 mm", "6 mm"], "max_speed": "0.2 m/s"},
       "velocity": {"estimator": "backward_difference", "window": 4}, "motor": {"max_torque": "10 N"},
       "brake": {"kind": "eddy_current", "max_damping": "10 N s/m", "tolerance": "10 %"},
       "mechanics": {"inertia": "0.1 kg", "damping": "3 N s/m"}}
KELVIN = {"parallel": [{"spring": "400 N/m"}, {"series": [{"spring": "200 N/m"}, {"damper": "20 N s/m"}]}]}


def side_by_side(*ports, **more):
    return {"dashpot": 1, "name": "both", **more, "ports": list(ports)}


class PortsTest(CommandTest):

    def setUp(self):
        super().setUp()
        self.write("rig.json", json.dumps(RIG))

    def network(self, *ports, **more):
        self.write("both.json", json.dumps(side_by_side(*ports, **more)))
        return "both.json"

    def motion(self):
        rows = ["time,position"] + [f"{k / 5000:.17g},{3e-3 * math.sin(0.01 * k):.17g}" for k in range(3000)]
        self.write("motion.csv", "\n".join(rows) + "\n")

    def forces(self, network, *more):
        answer = self.dashpot("simulate", network, "--input", "motion.csv", *more).stdout.splitlines()
        column = answer[0].split(",").index("force")
        return [float(row.split(",")[column]) for row in answer[1:]]

    # If this fails, what is felt of a file with ports is not the sum of what is felt of files with one each.
    def test_simulate_adds_up(self):
        self.motion()
        whole = json.loads(PAD.read_text())
        all_forces = self.forces(PAD)
        sums = [0.0] * len(all_forces)
        for port in whole["ports"]:
            alone = {"dashpot": 1, "parameters": whole["parameters"], "valid": whole["valid"], **port}
            self.write("alone.json", json.dumps(alone))
            sums = [x + y for x, y in zip(sums, self.forces("alone.json"))]
        largest = max(map(abs, all_forces))
        self.assertGreater(largest, 1)
        # the estimate has the rounding of a slope
        self.assertLess(max(abs(x - y) for x, y in zip(all_forces, sums)), 1e-12 * largest)

    # If this fails, friction in newtons is scaled by the curve of another port, or the curve is not met at rest.
    def test_friction_keeps_its_newtons(self):
        rows = ["time,position"] + [f"{i / 1000},{min(i, 400) * 1e-5}" for i in range(20000)]
        self.write("motion.csv", "\n".join(rows) + "\n")
        network = self.network({"name": "pad", "static": {"power": 2, "force": "1 N", "at": "4 mm"},
                                "network": {"spring": "100 N/m"}},
                               {"name": "guide", "network": {"series": [{"spring": "5 kN/m"}, {"slip": "0.25 N"}]}})
        self.assertAlmostEqual(self.forces(network)[-1], 1.25, delta=5e-4)  # of 1 N a curve is off by up to 0.05 %

    # If this fails, a certificate of ports is not what `verify` finds again.
    def test_certified_and_verified(self):
        self.dashpot("compile", PAD, "--device", "rig.json", "--certificate", "law.json")
        certificate = json.loads((self.folder / "law.json").read_text())
        self.assertTrue(certificate["passivity"]["certified"])
        self.assertEqual([port["name"] for port in certificate["ports"]], ["pad", "skin", "guide"])
        self.assertAlmostEqual(sum(port["passivity"]["needed_damping"] for port in certificate["ports"]),
                               certificate["passivity"]["needed_damping"], delta=1e-12)
        self.assertIn("; certified", self.dashpot("verify", "law.json", "finger_pad.hpp").stdout)

    # If this fails, verify refuses a right law of a port whose surface lies at 0, where no constant says so.
    def test_slips_in_one_port_are_verified_without_a_device(self):
        """Fails if a port without slips is chosen for by another rule than one with them: a certificate has one."""
        net = self.write("mixed.json", """{ "dashpot": 1, "name": "mixed", "ports": [
            { "name": "pad", "network": { "series": [ { "slip": 0.05 }, { "spring": 400 } ] } },
            { "name": "guide", "network": { "parallel": [ { "damper": 2 },
                { "series": [ { "spring": 60 }, { "damper": 1 } ] } ] } } ] }""")
        self.dashpot("compile", net, "--uncertified", "-o", ".", "--certificate", "mixed.cert.json")
        self.dashpot("verify", "mixed.cert.json", "mixed.hpp", "--allow-uncertified")

    def test_a_surface_at_zero_is_verified(self):
        network = self.network({"name": "a", "network": KELVIN, "contact": {"at": "0 mm"}},
                               {"name": "b", "network": {"spring": "300 N/m"}})
        for options in [[], ["--device", "rig.json"]]:
            self.dashpot("compile", network, *options, "--certificate", "law.json")
            self.assertIn("in 100 digits; banner and code are those of the network",
                          self.dashpot("verify", "law.json", "both.hpp", "--allow-uncertified").stdout)
        self.write("motion.csv", "time,position\n" +
                   "".join(f"{k / 5000},{min(k, 200) * 1e-5}\n" for k in range(30000)))
        self.assertAlmostEqual(self.forces(network)[-1], 2e-3 * 700, delta=1e-9)  # all but rest of what relaxed

    # If this fails, a wrong constant of some port, or of the sum, passes.
    def test_every_constant_is_recomputed(self):
        self.dashpot("compile", PAD, "--certificate", "law.json")
        header, certificate = (self.folder / "finger_pad.hpp").read_text(), json.loads(
            (self.folder / "law.json").read_text())
        changed = 0
        for name, values in list(certificate["constants"].items())[::4]:  # each takes a whole compilation
            if name in ("literals in code", "added_damping", "sample_period") or not re.search(rf"\b{name}\b", header):
                continue
            place, value = next(((i, v) for i, v in enumerate(values) if abs(v) > 1e-9), (None, 0))
            found = re.search(rf"\b{name}(\[\d+\])? = ({{[^}}]*}}|[^;]*);", header)
            if place is None or not found:
                continue
            numbers = found[2]
            near = math.nextafter(math.nextafter(value, math.inf), math.inf)
            new = re.sub(rf"(?<![\d.e-]){re.escape(repr(value))}(?![\d.e])", repr(near), numbers, count=1)
            if new == numbers:
                continue
            wrong = json.loads(json.dumps(certificate))
            wrong["constants"][name][place] = near
            self.write("wrong.json", json.dumps(wrong, indent=2))
            self.write("wrong.hpp", header.replace(found[0], found[0].replace(numbers, new), 1))
            with self.subTest(name):
                done = self.dashpot("verify", "wrong.json", "wrong.hpp", "--allow-uncertified", status=INPUT_REFUSED)
                self.assertRegex(done.stderr, r"\[(constant-wrong|constant-of-nothing|unknown-constant|code-differs)\]")
            changed += 1
        self.assertGreater(changed, 6)

    # If this fails, `verify` gives the constants of a port to another whose name begins alike.
    def test_names_that_begin_alike(self):
        def solid(of):
            return {"parallel": [{"spring": "400 N/m", "name": f"{of}K0"},
                                 {"series": [{"spring": "200 N/m", "name": f"{of}K1"},
                                                                                   {"damper": "20 N s/m",
                                                                                    "name": f"{of}B1"}]}]}
        network = self.network({"name": "a", "network": solid("b_")}, {"name": "a_b", "network": solid("")})
        self.dashpot("compile", network, "--certificate", "law.json")
        self.assertIn("in 100 digits; banner and code are those of the network",
                      self.dashpot("verify", "law.json", "both.hpp", "--allow-uncertified").stdout)

    # If this fails, --set changes an element of another port than the one that is meant, or more than one.
    def test_set_reaches_the_port_that_is_named(self):
        network = self.network({"name": "rub", "network": {"damper": "1 N s/m", "name": "mu"}},
                               {"name": "rest",
                                "network": {"parallel": [{"damper": "2 N s/m", "name": "mu"},
                                                         {"damper": "C", "name": "own"}]}},
                               parameters={"C": "4 N s/m"})

        def damping(*settings):
            return json.loads(self.dashpot("explain", network, "--json",
                                           *[f"--set={each}" for each in settings]).stdout)["damping"]
        for settings, sum_of in [([], 7), (["rub.mu=5"], 11), (["rest.mu=5"], 10), (["own=5"], 8), (["rest.own=5"], 8),
                                 (["C=5"], 8),
                                 (["rub.mu=5", "rest.mu=6"], 15)]:
            with self.subTest(settings):
                self.assertAlmostEqual(damping(*settings), sum_of, delta=1e-12)
        told = self.refused("explain", network, "--set", "mu=5", code="set-ambiguous").stderr
        self.assertIn("one of rub.mu, rest.mu is expected", told)
        self.assertIn("'rub.mu' is the nearest name",
                      self.refused("explain", network, "--set", "rub.nu=5", code="set-unknown-name").stderr)

    # If this fails, the checker by itself takes several ports for a law that it knows.
    def test_the_checker_says_what_it_does_not_know(self):
        network = self.network({"name": "a", "network": KELVIN}, {"name": "b", "network": {"spring": "50 N/m"}})
        self.dashpot("compile", network, "--certificate", "law.json")
        checked = subprocess.run([os.environ["DASHPOT_CHECK"], self.folder / "both.hpp", self.folder / "law.json"],
                                 capture_output=True, text=True)
        self.assertEqual(checked.returncode, 3)
        self.assertIn("nothing is known of slips, contacts, curves, tunables, several ports", checked.stdout +
                      checked.stderr)

    # If this fails, explain does not tell each port, its share, and the sum.
    def test_explain_tells_every_port(self):
        text = self.dashpot("explain", PAD, "--device", "rig.json", "--legend").stdout
        for words in ["port pad", "port skin", "port guide", "share of the device", "all ports together", "passivity:"]:
            self.assertIn(words, text)
        told = json.loads(self.dashpot("explain", PAD, "--device", "rig.json", "--json").stdout)
        for key in ["brake", "own_damping", "motor"]:
            self.assertAlmostEqual(sum(port["share_of_device"][key] for port in told["ports"]), 1, delta=1e-12)
        needed = sum(port["certificate"]["needed_damping"] for port in told["ports"])
        self.assertAlmostEqual(told["certificate"]["needed_damping"], needed, delta=1e-12)
        self.assertTrue(told["certificate"]["certified"])
        alone = json.loads(self.dashpot("explain", PAD, "--json").stdout)
        self.assertIsNone(alone["ports"][0]["share_of_device"])

    # If this fails, C and C++ are other laws, a law's own test passes a wrong one, or a target does not know ports.
    def test_every_target(self):
        for choices in [[], ["--device", "rig.json"]]:
            self.dashpot("compile", PAD, "--target", "c99", "--with-test", *choices)
            self.assertIn("passed", self.run_in_c("finger_pad"))
            self.assertIn("rest, sample", self.failed_in_c("finger_pad", " pad_tangent * ", " 1.01 * pad_tangent * "))
        for target in ["cpp", "hal", "fmi2", "fmi3", "wasm", "python"]:
            self.dashpot("compile", PAD, "--target", target, "-o", target)

    # If this fails, a page of several ports is not written, or leaves one out.
    def test_report_shows_every_port(self):
        self.dashpot("report", PAD, "--device", "rig.json", "-o", "page.html")
        page = (self.folder / "page.html").read_text()
        for port in ["pad", "skin", "guide"]:
            self.assertGreaterEqual(page.count(f"<h3>Port {port}</h3>"), 2)
        for title in ["Force at rest, port pad", "Force at once, port skin"]:
            self.assertIn(title, page)

    # If this fails, a motion on the simulated device is not measured against the sum, or gives energy.
    def test_run_measures_the_sum(self):
        self.motion()
        told = self.dashpot("run", "--motion", "motion.csv", PAD, "--device", "rig.json", "-o", "log.csv").stdout
        self.assertLess(float(re.search(r"rms \S+ N \((\S+) %\)", told)[1]), 5)
        self.assertIn("never below 0 J", told)

    # If this fails, a network that lacks damping is refused without a remedy.
    def test_too_little_damping_is_refused(self):
        weak = {**RIG, "mechanics": {"inertia": "0.1 kg", "damping": "0.01 N s/m"},
                "brake": {**RIG["brake"], "max_damping": "0.01 N s/m"}}
        self.write("weak.json", json.dumps(weak))
        network = self.network({"name": "one", "network": KELVIN}, {"name": "two", "network": {"spring": "3 kN/m"}})
        refused = self.dashpot("compile", network, "--device", "weak.json", status=INPUT_REFUSED).stderr
        self.assertIn("[not-certified]", refused)
        brake = re.search(r"a brake of (\S+) N s/m", refused)[1]
        self.write("strong.json", json.dumps({**weak, "brake": {**weak["brake"], "max_damping": brake + " N s/m"}}))
        self.dashpot("compile", network, "--device", "strong.json")

    # If this fails, a key that makes no sense beside ports is ignored.
    def test_what_is_refused(self):
        port = {"name": "one", "network": KELVIN}
        for network, code in [(side_by_side(port, network=KELVIN), "beside-ports"),
                              (side_by_side(port, contact={"at": 0}), "beside-ports"),
                              (side_by_side(), "no-ports"), (side_by_side({**port, "map": {"along": [1, 0]}}),
                                                             "ports-without-axes"),
                              (side_by_side(port, port), "name-taken"),
                              (side_by_side({"network": KELVIN}), "missing-key"),
                              (side_by_side({**port, "valid": {"rate": 1}}), "unknown-key"),
                              (side_by_side("one"), "wrong-type"),
                              (side_by_side({**port, "network": {"spring": "K"}},
                                            parameters={"K": {"value": "4 N/m", "tunable": True, "min": "1 N/m",
                                                              "max": "9 N/m"}}),
                               "tunable-with-ports")]:
            with self.subTest(code):
                self.write("bad.json", json.dumps(network))
                self.assertIn(f"[{code}]", self.dashpot("check", "bad.json", status=INPUT_REFUSED).stderr)
        self.write("good.json", json.dumps(side_by_side(port)))
        self.refused("compile", "good.json", "--decomposition", "3", code="damping-for-ports")
        self.assertIn("each port has a name", self.refused("check", self.network({"network": KELVIN}),
                                                           code="missing-key").stderr)
        self.assertIn("several ports", self.dashpot("export", "--to", "generic", "good.json",
                                                    status=INPUT_REFUSED).stderr)
        self.assertIn("several ports", self.dashpot("explain", "good.json", "--as", "kelvin",
                                                    status=INPUT_REFUSED).stderr)

    # If this fails, an error in the parameters of all ports is reported once for each of them.
    def test_shared_mistakes_are_told_once(self):
        self.network({"name": "one", "network": {"spring": "K"}}, {"name": "two", "network": {"spring": "K"}},
                     parameters={"K": "4 kg"},
                     valid={"rate": "1 N"})
        told = self.dashpot("check", "both.json", status=INPUT_REFUSED).stderr
        self.assertEqual(told.count("error:"), len(set(line for line in told.splitlines() if "error:" in line)))


if __name__ == "__main__":
    unittest.main()
