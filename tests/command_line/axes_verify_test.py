"""`dashpot compile --certificate` and `dashpot verify` with networks of two axes."""
import json
import math
import re
import unittest

from axes_test import BALL, BASE, DISTAL, FIELD, LINK, PANTOGRAPH, WALL, joints_of, near, tip_of
from dashpot_command import FIG_5, INPUT_REFUSED, SOURCE, CommandTest
from verify_test import numbers_of

LONGEST = 1.5e-4  # T_max of PANTOGRAPH [s]
SERIAL = {"kind": "serial", "links": ["80 mm", "70 mm"],
          "workspace": {"x": ["-40 mm", "40 mm"], "y": ["80 mm", "120 mm"]}}

# Ports with modes, with slips, behind a line and behind a cavity.
MIXED = """{ "dashpot": 1, "axes": 2, "name": "mixed", "ports": [
  { "name": "half", "map": { "wall": { "through": [0, "115 mm"], "normal": [0.3, -1] } },
    "network": { "parallel": [ { "spring": "150 N/m" }, { "series": [ { "spring": "70 N/m" }, { "damper": "3 N s/m" } ] },
                               { "series": [ { "spring": "90 N/m" }, { "damper": "0.4 N s/m" } ] } ] }, "contact": { "at": "0 mm" } },
  { "name": "half_line", "map": { "line": { "through": [0, "60 mm"], "direction": [1, 0.1], "radius": "20 mm" } },
    "network": { "parallel": [ { "spring": "33 N/m" }, { "series": [ { "spring": "80 N/m" }, { "slip": "0.2 N" } ] } ] } },
  { "name": "hollow", "map": { "cavity": { "centre": ["1 mm", "40 mm"], "radius": "60 mm" } },
    "network": { "spring": "40 N/m" }, "contact": { "at": "0 mm" } } ] }"""


def next_to(literal, away):
    """The literal of the next double, above or below."""
    return repr(math.nextafter(float(literal), away))


def constants_of(header):
    """Every constant of the class: its name, and where its number stands."""
    return [(m[1], m.start(2), m.end(2)) for m in re.finditer(r"static constexpr scalar (\w+) = (-?[\d.e+-]+);",
                                                              header)]


class AxesVerify(CommandTest):

    def setUp(self):
        super().setUp()
        arm = json.loads(PANTOGRAPH.read_text())
        del arm["motors"]["amplifier_lag"]
        arm["assumed"].remove("motors.amplifier_lag")
        self.write("prompt.json", json.dumps(arm))
        arm["kinematics"] = SERIAL
        self.write("serial.json", json.dumps(arm))
        self.write("near.json", near(PANTOGRAPH))
        self.write("mixed.json", MIXED)

    def compiled(self, *arguments):
        self.dashpot("compile", *arguments, "--uncertified", "--no-advice", "--certificate", "certificate.json")
        name = json.loads((self.folder / "certificate.json").read_text())["name"]
        return (self.folder / f"{name}.hpp").read_text(), (self.folder / "certificate.json").read_text()

    def verified(self, header, certificate, *options, status=0):
        self.write("read.hpp", header)
        self.write("read.json", certificate)
        return self.dashpot("verify", "read.json", "read.hpp", *options, status=status)

    def test_grids_of_ports(self):
        """Fails if the tables of a grid are not found, of a port whose name ends in '_', or if one that no code reads
        is asked for."""
        grid = {"x": [-0.02, 0, 0.02], "y": [0.09, 0.11], "values": [[0, 0.001, 0], [0.019, 0.021, 0.019]]}
        for name, network in (("a_", {"spring": 300}), ("a", {"damper": 1})):
            port = {"name": name, "map": {"grid": grid}, "network": network}
            self.write("grid.json", json.dumps({"dashpot": 1, "axes": 2, "name": "grid", "ports": [port]}))
            self.verified(*self.compiled("grid.json"), "--allow-uncertified")

    # If this fails, ports that relax cannot be certified without a contact, or `faithful` takes another b than b∞.
    def test_faithful_ports_that_relax_are_certified(self):
        relaxing = {"parallel": [{"spring": "60 N/m"}, {"damper": "0.4 N s/m"},
                                 {"series": [{"spring": "40 N/m"}, {"damper": "2 N s/m"}]}]}
        file = {"dashpot": 1, "axes": 2, "name": "relaxing", "ports": [
            {"name": "across", "map": {"along": [1, 0]}, "network": relaxing},
            {"name": "out", "map": {"along": [0, 1]}, "network": relaxing}]}
        self.write("relaxing.json", json.dumps(file))
        told = self.dashpot("compile", "relaxing.json", "--device", "near.json").stderr
        self.assertIn("[nothing-proved]", told)
        self.assertIn("--decomposition faithful", told)
        for choice, certified in (("paper", False), ("diagonal", False), ("faithful", True)):
            told = json.loads(self.dashpot("explain", "relaxing.json", "--device", "near.json",
                                           "--decomposition", choice, "--json").stdout)
            self.assertEqual(told["certified"], certified)
            self.assertEqual(told["chosen"], "diagonal")
        self.assertEqual([port["damping"] for port in told["ports"]], [0.4, 0.4])
        header, certificate = self.compiled("relaxing.json", "--device", "near.json", "--decomposition", "faithful")
        self.verified(header, certificate)
        self.assertEqual(json.loads(certificate)["law"]["decomposition"], "faithful")

    # If this fails, a header that is what its certificate says is refused, or one is called certified that is not.
    def test_sound_ones_pass(self):
        for arguments, certified in (
                ([FIELD, "--device", PANTOGRAPH], True), ([FIELD, "--device", "near.json", "--scalar", "float"], True),
                ([FIELD, "--device", "serial.json", "--decomposition", "non-injecting"], None),
                ([BALL, "--device", "prompt.json", "--scheme", "backward-euler"], None),
                ([BALL, "--device", PANTOGRAPH, "--decomposition", "virtual"], False),
                ([WALL, "--rate", "3000"], False), (["mixed.json", "--device", "prompt.json"], None),
                ([FIELD, "--device", "prompt.json", "--set", "K=120", "--name", "stiffer"], True)):
            with self.subTest(arguments=list(map(str, arguments))):
                header, certificate = self.compiled(*arguments)
                told = json.loads(certificate)["passivity"]["certified"]
                self.assertIn(certified, (told, None))
                said = self.verified(header, certificate, "--allow-uncertified").stdout
                self.assertIn("in 100 digits; banner and code are those of the network", said)
                self.assertEqual(said.rstrip().endswith("; certified"), told, said)
                if not told:
                    self.assertIn("[verified-uncertified]",
                                  self.verified(header, certificate, status=INPUT_REFUSED).stderr)

    # If this fails, a constant that is not the nearest to the network's or the device's passes, where the certificate
    # has been edited with it.
    def test_every_constant_by_one_unit_in_the_last_place(self):
        for network, device in ((FIELD, "near.json"), (BALL, "prompt.json"), ("mixed.json", "serial.json")):
            header, certificate = self.compiled(network, "--device", device)
            stated = json.loads(certificate)
            constants = constants_of(header)
            self.assertGreater(len(constants), 30)
            edited = header
            for name, begin, end in reversed(constants):
                if float(header[begin:end]) == 0:
                    continue
                literal = next_to(header[begin:end], math.inf)
                edited = edited[:begin] + literal + edited[end:]
                stated["constants"][name] = [float(literal)]
            refused = self.verified(edited, json.dumps(stated), status=INPUT_REFUSED).stderr
            self.assertNotIn("[certificate-disagrees]", refused)
            ports = [port["name"] for port in stated["ports"]]
            for name, begin, end in constants:
                if float(header[begin:end]) == 0:
                    continue
                # Of a port it is told as the port's own law calls it, and of springs and dampers alone by its kind.
                own = [name] + [re.sub(r"_\d+$", "", name[len(port) + 1:]) for port in ports
                                if name.startswith(port + "_")]
                told = re.findall(r"error: '(\w+)'", refused)
                self.assertTrue(any(one == kind or one.endswith("_" + kind) for one in own for kind in told),
                                f"{name}\n{refused}")

    # If this fails, a header passes that is not the one that the certificate was written with.
    def test_single_constants_of_the_header(self):
        header, certificate = self.compiled(FIELD, "--device", "near.json")
        at = {name: (begin, end) for name, begin, end in constants_of(header)}
        for name in ("across_static_stiffness", "sine_term_3", "base", "most_damping_1"):
            begin, end = at[name]
            edited = header[:begin] + next_to(header[begin:end], 0) + header[end:]
            self.assertIn(f"disagree about '{name}' [certificate-disagrees]",
                          self.verified(edited, certificate, status=INPUT_REFUSED).stderr)
        begin, end = next(span for span in numbers_of(header) if span[0] > header.index("added_damping[brakes]"))
        edited = header[:begin] + next_to(header[begin:end], 0) + header[end:]
        self.assertIn("'added_damping'", self.verified(edited, certificate, status=INPUT_REFUSED).stderr)
        self.assertIn("[code-differs]", self.verified(
            header.replace("x_by_q1 * across_force", "y_by_q1 * across_force", 1), certificate,
            status=INPUT_REFUSED).stderr)
        self.assertIn("[banner-differs]", self.verified(
            header.replace("certified for any motion", "certified for all motion", 1), certificate,
            status=INPUT_REFUSED).stderr)

    # If this fails, a certificate of two axes that verify refuses for its size is written without a word.
    def test_parts_that_are_too_large(self):
        network = json.loads(FIELD.read_text())
        ends = ["tool"] + [f"n{i}" for i in range(201)]
        network["ports"][0].pop("network")
        network["ports"][0]["elements"] = [{"spring": 1, "nodes": list(pair)} for pair in zip(ends, ends[1:])] + [
            {"damper": 1, "nodes": [end, "ground"]} for end in ends[1:]]
        self.write("large.json", json.dumps(network))
        said = self.dashpot("compile", "large.json", "--uncertified", "--certificate", "large.cert.json",
                            "-o", ".").stderr
        self.assertIn("'across' has a part with 201 inner nodes", said)
        self.assertIn("[certificate-beyond-verify]", said)
        self.refused("verify", "large.cert.json", "kelvin_field.hpp", code="part-too-large")

    # If this fails, a certificate may state less than is needed.
    def test_edits_of_the_stated_bounds(self):
        header, certificate = self.compiled(FIELD, "--device", "near.json")
        for key in ("needed_damping", "for_estimates", "for_lag", "missing_damping"):
            stated = json.loads(certificate)
            stated["passivity"][key] = math.nextafter(stated["passivity"][key], 0)
            self.assertIn("[bound-wrong]", self.verified(header, json.dumps(stated), status=INPUT_REFUSED).stderr, key)
        for change in (lambda c: c["passivity"].update(certified=False),
                       lambda c: c["passivity"].update(worst=[0.0, 0.1]),
                       lambda c: c["passivity"].update(weight=[0.004, 0.004]), lambda c: c["loop"].update(jitter=0.0),
                       lambda c: c["ports"][1].update(damping=1.0000000000000002), lambda c: c["ports"].pop(),
                       lambda c: c["passivity"]["added_damping"].pop(),
                       lambda c: c["law"].update(decomposition="virtual"),
                       lambda c: c.update(network_file=c["network_file"].replace("100 N/m", "101 N/m")),
                       lambda c: c.update(device_file=c["device_file"].replace('"50 us"', '"40 us"'))):
            stated = json.loads(certificate)
            change(stated)
            self.assertNotEqual(stated, json.loads(certificate))
            self.assertNotEqual(self.verified(header, json.dumps(stated), status=INPUT_REFUSED).stderr, "")

    # If this fails, the places at which the bound is looked at again need something else than springs at the tip do.
    def test_what_is_needed_at_places(self):
        header, certificate = self.compiled(FIELD, "--device", PANTOGRAPH)
        stated = json.loads(certificate)["passivity"]
        said = self.verified(header, certificate).stdout
        share, places = re.search(r"held forces need, ([\d.]+) % are needed at the worst of (\d+) places",
                                  said).groups()
        self.assertGreater(int(places), 90)
        most = 0
        step = 1e-4
        for i in range(10):
            for k in range(10):
                q = joints_of(-0.04 + 0.08 * (1e-6 + i / 9 * (1 - 2e-6)), 0.07 + 0.05 * (1e-6 + k / 9 * (1 - 2e-6)))
                at = lambda a, b: tip_of([q[0] + a * step, q[1] + b * step])
                matrix = [0, 0, 0]  # of ½ K (x² + (y − 0.1)²) the held part, and what its torque turns by: S = K/2
                turned = []
                for axis, rest in ((0, 0), (1, 0.1)):
                    w = lambda a, b: at(a, b)[axis] - rest
                    g = [(w(1, 0) - w(-1, 0)) / 2 / step, (w(0, 1) - w(0, -1)) / 2 / step]
                    hessian = [(w(1, 0) - 2 * w(0, 0) + w(-1, 0)) / step ** 2,
                               (w(1, 1) - w(1, -1) - w(-1, 1) + w(-1, -1)) / 4 / step ** 2,
                               (w(0, 1) - 2 * w(0, 0) + w(0, -1)) / step ** 2]
                    turned.append([50 * w(0, 0) * h for h in hessian])
                    matrix = [m + 50 * p for m, p in zip(matrix, (g[0] * g[0], g[0] * g[1], g[1] * g[1]))]
                xx, xy, yy = (m + sum(t[j] for t in turned) for j, m in enumerate(matrix))
                most = max(most, LONGEST * ((xx + yy) / 2 + math.hypot((xx - yy) / 2, xy)) / LINK ** 2)
        whole = stated["needed_damping"] - stated["for_estimates"] - stated["for_lag"]
        # Printed in three digits; the differences are good to 1e-6.
        self.assertAlmostEqual(float(share), 100 * most / whole, delta=0.06)
        self.assertLessEqual(float(share), 100)

    def test_late_torques_at_places(self):
        """Fails if verify looks for another need of torques that act samples late than the bound has: more, or far
        less."""
        arm = json.loads((self.folder / "prompt.json").read_text())
        arm["loop"]["delay_samples"] = 2
        for encoder in arm["encoders"]:
            encoder["max_speed"] = "1 rad/s"
        self.write("late.json", json.dumps(arm))
        header, certificate = self.compiled(FIELD, "--device", "late.json")
        share = re.search(r"held forces need, ([\d.]+) % are needed at the worst of",
                          self.verified(header, certificate).stdout)[1]
        self.assertLessEqual(float(share), 100)
        self.assertGreater(float(share), 95)  # 1 % of it is the search's; in three samples joints go 0.5 mrad

    def test_springs_that_reach_ground_round_slips(self):
        """Fails if verify asks for more than a part with slips can hold, or passes over springs that go on pulling when
        a slip has given way."""
        round_slip = lambda before, slip, beside: {"series": [
            {"spring": before}, {"parallel": [{"slip": slip}, {"spring": beside}]}]}
        for network, least in ((round_slip("1000 N/m", "10 mN", "99 N/mm"), 90),
                               (round_slip("10 N/m", "2 N", "30 N/m"), 0),
                               ({"series": [{"spring": "10 N/m"}, {"slip": "2 N"}, {"spring": "30 N/m"},
                                            {"slip": "50 mN"}]}, 0)):
            self.write("slips.json", json.dumps({"dashpot": 1, "axes": 2, "name": "slips", "ports": [
                {"name": "wall", "map": {"wall": {"through": [0, "90 mm"], "normal": [0, 1]}}, "network": network}]}))
            said = self.verified(*self.compiled("slips.json", "--device", "serial.json")).stdout
            share = float(re.search(r"held forces need, ([\d.]+) % are needed at the worst of", said)[1])
            self.assertGreater(share, least)
            self.assertLessEqual(share, 100)

    # If this fails, a contact that begins in front of where its map does is certified as if it pushed later.
    def test_surfaces_elsewhere(self):
        wall = lambda name, y, at: self.write(f"{name}.json",
                                              json.dumps({"dashpot": 1, "axes": 2, "name": name, "ports": [{
            "name": "wall", "map": {"wall": {"through": [0, f"{y} mm"], "normal": [0, -1]}},
            "network": {"spring": "300 N/m"},
            "contact": {"at": f"{at} mm"}}]}))
        needed = []
        for name, y, at in (("there", 80, 0), ("early", 110, -30), ("late", 70, 10)):
            header, certificate = self.compiled(wall(name, y, at), "--device", PANTOGRAPH)
            self.verified(header, certificate)
            needed.append(json.loads(certificate)["passivity"]["needed_damping"])
        for one in needed:
            self.assertAlmostEqual(one, needed[0], delta=0.02 * needed[0])  # each is searched to 1 %

    # If this fails, texts that do not belong together are taken for a certificate and its header.
    def test_what_is_of_one_axis(self):
        header, certificate = self.compiled(FIELD, "--device", "near.json")
        self.dashpot("compile", FIG_5, "--certificate", "one.json", "--uncertified")
        one = (self.folder / "second_order_maxwell.hpp").read_text()
        self.verified(one, certificate, status=INPUT_REFUSED)
        self.verified(header, (self.folder / "one.json").read_text(), status=INPUT_REFUSED)
        stated = json.loads(certificate)
        del stated["passivity"]["for_lag"]
        self.assertIn("[no-certificate]", self.verified(header, json.dumps(stated), status=INPUT_REFUSED).stderr)
        self.assertIn("[no-emitted-header]", self.verified("", certificate, status=INPUT_REFUSED).stderr)

    # If this fails, a user who has mixed up two compilations is told of an error in one of them, and not of the mix-up.
    def test_texts_of_two_compiles(self):
        header, _ = self.compiled(FIELD, "--rate", "1000")
        _, certificate = self.compiled(FIELD, "--device", "near.json")
        told = self.verified(header, certificate, status=INPUT_REFUSED).stderr
        self.assertIn("they were not written together: the header is of device 'ideal' with samples of 0.001 s", told)
        wrong = json.loads(certificate)
        wrong["passivity"]["needed_damping"] *= 1.5
        header, _ = self.compiled(FIELD, "--device", "near.json")
        self.assertNotIn("not written together", self.verified(header, json.dumps(wrong), status=INPUT_REFUSED).stderr)


if __name__ == "__main__":
    unittest.main()
