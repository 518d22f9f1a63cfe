"""Networks of two axes: fields that turn and their gate, maps over a grid, brakes beyond two by the rule
'non-injecting'."""
import json
import math
import re
import unittest

import axes_test
from axes_test import LINK, PANTOGRAPH, PERIOD, jacobian_of, joints_of, tip_of
from dashpot_command import INPUT_REFUSED, CommandTest

BRAKE = {"kind": "eddy_current", "max_damping": "14 mN m s/rad", "tolerance": "5 %"}
FAR = {"name": "far", "map": {"wall": {"through": [0, 0], "normal": [0, 1]}}, "network": {"spring": "10 N/m"},
       "contact": {"at": "0 mm"}}


def field_of(name, damping, turning, ports=(FAR,)):
    return {"dashpot": 1, "axes": 2, "name": name, "ports": list(ports),
            "field": {"viscous": [[damping, turning], [-turning, damping]]}}


def prompt_arm(**changes):
    """PANTOGRAPH in the middle of its workspace, whose brakes and motors follow at once, in time."""
    arm = json.loads(PANTOGRAPH.read_text())
    del arm["motors"]["amplifier_lag"], arm["loop"]["jitter"]
    arm["kinematics"]["workspace"] = {"x": ["-12 mm", "12 mm"], "y": ["90 mm", "110 mm"]}
    arm["velocity"] = {"estimator": "backward_difference", "window": 4}
    arm["brakes"] = [{"along": [1, 0], **BRAKE}, {"along": [0, 1], **BRAKE}]
    arm["assumed"] = []
    arm.update(changes)
    return arm


def in_the_middle(count):
    """Along a figure of two sines, up to 0.2 m/s, as joint positions."""
    return [joints_of(0.01 * math.sin(17 * t), 0.1 + 0.008 * math.sin(11 * t + 1))
            for t in (PERIOD * k for k in range(count))]


def wanted_at(q, field):
    """Jᵀ A J, by rows."""
    columns = jacobian_of(q)
    return [[sum(columns[i][k] * field[k][m] * columns[j][m] for k in range(2) for m in range(2)) for j in range(2)]
            for i in range(2)]


class AxesFieldsTest(CommandTest):
    compile, answers, rows, simulated = (getattr(axes_test.AxesTest, name)
                                         for name in ("compile", "answers", "rows", "simulated"))

    def explained(self, network, *options):
        return json.loads(self.dashpot("explain", network, *options, "--json").stdout)

    def text_of(self, network, *options):
        return " ".join(self.dashpot("explain", network, *options).stdout.split())

    # If this fails, the gate keeps back what the brakes pay for, or brakes and motors make another field.
    def test_a_field_that_turns_is_made_whole(self):
        self.write("prompt.json", json.dumps(prompt_arm()))
        network = self.write("turning.json", json.dumps(field_of("turning", 1.5, 0.7)))
        said = self.text_of(network, "--device", "prompt.json")
        self.assertIn("a torque limiter (gate)", said)
        self.assertIn("100 % of it on average", said)
        told = self.explained(network, "--device", "prompt.json")
        self.assertTrue(told["certified"])
        self.assertEqual(told["damping_for_estimates"], 0)
        self.assertEqual(told["gate"]["least"], 1)
        rows = self.rows(in_the_middle(4000))
        answers = self.simulated(network, rows, "--device", "prompt.json")
        added = told["added_damping"]
        for row, answer in list(zip(rows, answers))[3000::50]:
            wanted = wanted_at(row[:2], [[1.5, 0.7], [-0.7, 1.5]])
            for j in range(2):
                felt = (answer[j] - added[j]) * row[2 + j] + answer[2 + j]
                due = wanted[j][0] * row[2] + wanted[j][1] * row[3]
                self.assertAlmostEqual(felt, due, delta=1e-10 * (abs(row[2]) + abs(row[3])))

    # If this fails, simulate shows something else than what runs on the device, or states of the gate do not outlive a
    # sample.
    def test_simulate_and_the_emitted_gate_agree_to_the_bit(self):
        self.write("prompt.json", json.dumps(prompt_arm()))
        network = self.write("turning.json", json.dumps(field_of("turning", 1.5, 1.4)))
        rows = self.rows(in_the_middle(400))
        told = [row[:4] for row in self.answers(self.compile(network, "--device", "prompt.json"), rows)[:-1]]
        self.assertEqual(self.simulated(network, rows, "--device", "prompt.json"), told)
        self.assertNotEqual(told[5][2], told[399][2])

    # If this fails, more of a field passes than the brakes' own share of it pays for: both couplings at once, at any
    # sample.
    def test_the_gate_limits_what_turns_too_much(self):
        self.write("prompt.json", json.dumps(prompt_arm()))
        network = self.write("turning.json", json.dumps(field_of("turning", 0.5, 5)))
        told = self.explained(network, "--device", "prompt.json")
        self.assertLess(told["gate"]["least"], 0.15)
        self.assertTrue(told["certified"])
        # A unit velocity of one joint alone shows the coupling of the other.
        joints = in_the_middle(3000)
        passed = [self.simulated(network, [[*q, *v] for q in joints], "--device", "prompt.json")
                  for v in ((1, 0), (0, 1))]
        for first, second in list(zip(*passed))[2000::20]:
            brakes = [first[j] - told["added_damping"][j] for j in range(2)]
            couplings = [second[2], first[3]]
            # (2/ω) d1 2ω d2 bounds the product of both sums, whatever ω; dampings change by less than 1 % within a
            # window.
            self.assertLessEqual((abs(couplings[0]) + abs(couplings[1])) ** 2,
                                 4 * brakes[0] * brakes[1] * 0.95 ** 2 * 1.01)
            self.assertGreater(abs(couplings[0]) + abs(couplings[1]), 0.5 * math.sqrt(brakes[0] * brakes[1]))

    # If this fails, a device whose brakes or motors are late is told to have a gate, or nothing pays for what turns.
    def test_late_devices_have_damping_added(self):
        arm = prompt_arm()
        late = json.loads(PANTOGRAPH.read_text())
        slow_brakes = prompt_arm(brakes=[{"along": [1, 0], **BRAKE, "coil_lag": "2 ms"}, {"along": [0, 1], **BRAKE}])
        adaptive = prompt_arm(velocity={"estimator": "foaw", "window": 16})
        three = prompt_arm(brakes=[*arm["brakes"], {"along": [1, -1], **BRAKE}])
        straight = self.write("straight.json", json.dumps(field_of("straight", 0.6, 0)))
        turning = self.write("turning.json", json.dumps(field_of("turning", 0.6, 0.3)))
        for device, reason, options in ((late, "brakes follow their commands late", []),
                                        (slow_brakes, "brakes follow their commands late", []),
                                        (adaptive, "velocity estimator remembers", []),
                                        (three, "more than two brakes", []),
                                        (arm, "by this rule", ["--decomposition", "virtual"])):
            with self.subTest(reason=reason):
                self.write("device.json", json.dumps(device))
                self.assertIn("no torque limiter (gate) keeps it to what the brakes dissipate, because",
                              self.text_of(turning, "--device", "device.json", *options))
                self.assertIn(reason, self.text_of(turning, "--device", "device.json", *options))
                told, other = (self.explained(network, "--device", "device.json", *options)
                               for network in (turning, straight))
                self.assertIsNone(told["gate"])
                self.assertGreater(told["damping_for_estimates"], other["damping_for_estimates"] + 0.3 * 0.8 * 0.95)
        # |σ| = 0.3 |det J| over the square of the link, times T/h; the largest det J of the workspace by 40 x 40
        # places.
        largest = 0
        for i in range(41):
            for k in range(41):
                first, second = jacobian_of(joints_of(-0.04 + i * 0.002, 0.07 + k * 0.00125))
                largest = max(largest, abs(first[0] * second[1] - first[1] * second[0]))
        self.write("device.json", json.dumps(late))
        told, other = (self.explained(network, "--device", "device.json") for network in (turning, straight))
        paid = told["damping_for_estimates"] - other["damping_for_estimates"]
        self.assertGreaterEqual(paid * LINK ** 2, 1.5 * 0.3 * largest * 0.999)
        self.assertLess(paid * LINK ** 2, 1.5 * 0.3 * largest * 1.1)

    def test_late_commands_have_a_gate(self):
        """Fails if a gate is refused where commands act late, or keeps no more for them, or verify takes one that does
        not."""
        writing = prompt_arm()
        writing["loop"]["write_delay"] = ["10 us", "20 us"]
        network = self.write("turning.json", json.dumps(field_of("turning", 1.5, 0.7)))
        kept = {}
        for name, arm in (("prompt", prompt_arm()), ("writing", writing)):
            self.write(f"{name}.json", json.dumps(arm))
            self.assertTrue(self.explained(network, "--device", f"{name}.json")["certified"])
            self.compile(network, "--device", f"{name}.json", "--certificate", f"{name}_certificate.json")
            header = (self.folder / "turning.hpp").read_text()
            self.dashpot("verify", f"{name}_certificate.json", "turning.hpp")
            kept[name] = [float(re.search(rf"scalar gate_{one} = ([\d.e+-]+);", header)[1])
                          for one in ("reserve", "recovery", "factor_1")]
        # Of the mean of four differences Σ |e_j| (j − 1) is 1.5, and one more where commands are late; 1e-6 is for
        # rounding.
        for name, due in (("prompt", 1.5), ("writing", 2.5)):
            self.assertAlmostEqual(kept[name][0] / kept[name][1], due, delta=1e-5)
        # h/T: a hold lasts as much longer as writes are apart. ω is of what the brakes make, and hardly another.
        self.assertAlmostEqual(kept["writing"][2] / kept["prompt"][2], 100 / 110, delta=0.01)
        edited = header.replace(f"gate_reserve = {kept['writing'][0]!r};",
                                f"gate_reserve = {1.5 * kept['writing'][1]!r};")
        self.assertNotEqual(edited, header)
        self.write("edited.hpp", edited)
        stated = json.loads((self.folder / "writing_certificate.json").read_text())
        stated["constants"]["gate_reserve"] = [1.5 * kept["writing"][1]]
        self.write("edited.json", json.dumps(stated))
        refused = self.dashpot("verify", "edited.json", "edited.hpp", status=INPUT_REFUSED).stderr
        self.assertIn("'gate_reserve' is", refused)

    def test_where_no_device_is_named_there_is_no_workspace(self):
        """Fails if explain prints a workspace where there is no device."""
        network = self.write("turning.json", json.dumps(field_of("turning", 1.5, 5)))
        said = self.text_of(network)
        self.assertIn("on average over the field, while", said)
        self.assertEqual(said.count("workspace"), said.count("and so no workspace"))

    # If this fails, a field over a grid is not what lies between its knots, or brakes and motors do not make all of it.
    def test_a_field_over_a_grid(self):
        self.write("prompt.json", json.dumps(prompt_arm()))
        xs, ys = [-0.008, 0.0, 0.008], [0.094, 0.1]

        def written(name, matrix):
            grid = {"x": xs, "y": ys, "viscous": [[matrix(x, y) for x in xs] for y in ys]}
            return self.write(f"{name}.json",
                              json.dumps({"dashpot": 1, "axes": 2, "name": name, "ports": [FAR],
                                          "field": {"grid": grid}}))

        def between(matrix, x, y):
            """Means of the knots, weighed by how near they are; beyond them the nearest."""
            near = lambda knots, u: [max(0, 1 - abs(min(max(u, knots[0]), knots[-1]) - knot) / (knots[1] - knots[0]))
                                     for knot in knots]
            return [[sum(a * b * matrix(p, q)[i][j] for a, p in zip(near(xs, x), xs) for b, q in zip(near(ys, y), ys))
                     for j in range(2)] for i in range(2)]

        alike = lambda x, y: [[0.8 + 50 * abs(x), 0], [0, 0.8 + 50 * abs(x)]]
        leaning = lambda x, y: [[1.2 + 20 * x, 0.3 - 40 * (y - 0.1)], [0.3 - 40 * (y - 0.1), 0.9 + 80 * abs(y - 0.1)]]
        turning = lambda x, y: [[1.2 + 20 * x, 0.5 + 30 * x], [-0.5 - 30 * x, 1.2 + 20 * x]]
        rows = self.rows(in_the_middle(4000))
        for name, matrix, gated in (("alike", alike, False), ("leaning", leaning, False), ("turning", turning, True)):
            with self.subTest(field=name):
                network = written(name, matrix)
                self.assertIn("viscous field over a grid of 3 x 2 knots",
                              self.text_of(network, "--device", "prompt.json"))
                told = self.explained(network, "--device", "prompt.json")
                self.assertTrue(told["certified"])
                self.assertEqual(told["gate"] is not None, gated)
                for knots, due in zip((told["viscous"]["x"], told["viscous"]["y"]), (xs, ys)):
                    for knot, at in zip(knots, due):
                        self.assertAlmostEqual(knot, at, delta=1e-15)
                answers = self.simulated(network, rows, "--device", "prompt.json")
                for row, answer in list(zip(rows, answers))[3000::25]:
                    wanted = wanted_at(row[:2], between(matrix, *tip_of(row[:2])))
                    for j in range(2):
                        felt = (answer[j] - told["added_damping"][j]) * row[2 + j] + answer[2 + j]
                        self.assertAlmostEqual(felt, wanted[j][0] * row[2] + wanted[j][1] * row[3],
                                               delta=1e-10 * (abs(row[2]) + abs(row[3])))
                program = self.compile(network, "--device", "prompt.json", "--certificate", f"{name}_certificate.json")
                self.assertEqual([row[:4] for row in self.answers(program, rows)[:-1]], answers)
                self.dashpot("verify", f"{name}_certificate.json", f"{name}.hpp")
        # A table's number, changed in header and certificate.
        header, stated = (self.folder / "alike.hpp").read_text(), json.loads(
            (self.folder / "alike_certificate.json").read_text())
        for table in ("field_11", "field_11_by_x", "field_corner_x", "field_column"):
            changed = [*stated["constants"][table]]
            changed[-1] += 1e-5 * (abs(changed[-1]) + 0.01) if table != "field_column" else -1
            self.write("edited.hpp", re.sub(rf"({table}\[\d+\] = ){{[^}}]*}}",
                                            lambda found: f"{found[1]}{{{', '.join(map(repr, changed))}}}", header))
            self.write("edited.json", json.dumps({**stated, "constants": {**stated["constants"], table: changed}}))
            refused = self.dashpot("verify", "edited.json", "edited.hpp", status=INPUT_REFUSED).stderr
            self.assertRegex(refused, rf"place \d+ of '{table}' is .* recomputed")

    # If this fails, a value that cannot be read counts as none, and the part that it belongs to is left out.
    def test_no_value_is_lost(self):
        whole = [["1 N s/m", 0], [0, "1 N s/m"]]
        for text in ("2*B", "x N s/m", "O.5 N s/m", "NaN N s/m", "B"):
            spoiled = [[text, 0], [0, "1 N s/m"]]
            for field in ({"viscous": spoiled},
                          {"grid": {"x": [0, "1 mm"], "y": [0, "1 mm"],
                                    "viscous": [[whole, whole], [whole, spoiled]]}}):
                with self.subTest(text=text, grid="grid" in field):
                    self.write("bad.json", json.dumps({"dashpot": 1, "axes": 2, "name": "bad",
                                                       "parameters": {"B": "1 N s/m"}, "ports": [FAR], "field": field}))
                    self.assertRegex(self.dashpot("check", "bad.json", status=INPUT_REFUSED).stderr,
                                     r"error: .*\n.*1 \|")
        ball = {"name": "bad", "map": {"ball": {"centre": [0, "60 mm"], "radius": "2*R"}},
                "network": {"spring": "10 N/m"}, "contact": {"at": 0}}
        self.write("bad.json",
                   json.dumps({"dashpot": 1, "axes": 2, "name": "lost", "parameters": {"R": "1 mm"}, "ports": [ball]}))
        self.refused("check", "bad.json", code="malformed-quantity")
        arm = prompt_arm()
        for section, key, text in (("loop", "jitter", "2*T"), ("motors", "amplifier_lag", "2*tau"),
                                   ("brakes", "tolerance", "2*e"), ("mechanics", "damping", "Q uN m s/rad")):
            spoiled = json.loads(json.dumps(arm))
            for part in spoiled[section] if section == "brakes" else [spoiled[section]]: part[key] = text
            with self.subTest(key=key):
                self.write("arm.json", json.dumps(spoiled))
                self.refused("check", self.write("field.json", json.dumps(field_of("field", 1.0, 0))), "--device",
                             "arm.json", code="malformed-quantity")

    # If this fails, a grid that cannot be one, or whose field gives power at a knot, is taken.
    def test_grids_of_fields_that_are_refused(self):
        one = [["1 N s/m", 0], [0, "1 N s/m"]]
        good = {"x": [0, "10 mm"], "y": [0, "10 mm"], "viscous": [[one, one], [one, one]]}
        for change, code in (({"viscous": [[one, one], [one]]}, "grid-rows"), ({"viscous": [[one, one]]}, "grid-rows"),
                             ({"viscous": [[one, one], [one, [["1 N s/m", "3 N s/m"], ["1 N s/m", "1 N s/m"]]]]},
                              "field-not-passive"),
                             ({"x": [0, "10 mm", "15 mm"], "viscous": [[one, one, one], [one, one, one]]},
                              "grid-spacing"),
                             ({"x": [0], "viscous": [[one], [one]]}, "grid-size"),
                             ({"viscous": [[one, one], 5]}, "wrong-type"),
                             ({"viscous": [[one, one], [one, "1 N s/m"]]}, "not-a-list-of"),
                             ({"values": []}, "unknown-key")):
            with self.subTest(code=code, change=change):
                self.write("bad.json", json.dumps({"dashpot": 1, "axes": 2, "name": "bad", "ports": [FAR],
                                                   "field": {"grid": {**good, **change}}}))
                self.refused("check", "bad.json", code=code)
        for step in (1e308, 1e-300):
            self.write("bad.json", json.dumps({"dashpot": 1, "axes": 2, "name": "bad", "ports": [FAR],
                                               "field": {"grid": {**good, "x": [-step, step]}}}))
            self.refused("check", "bad.json", code="grid-spacing")
        self.write("bad.json",
                   json.dumps({"dashpot": 1, "axes": 2, "name": "bad", "ports": [FAR],
                               "field": {"grid": good, "viscous": one}}))
        self.refused("check", "bad.json", code="two-kinds-at-once")

    # If this fails, a header whose gate lets more pass is taken for the one that was certified.
    def test_verify_reads_the_gate(self):
        self.write("prompt.json", json.dumps(prompt_arm()))
        network = self.write("turning.json", json.dumps(field_of("turning", 1.5, 0.7)))
        self.dashpot("compile", network, "--device", "prompt.json", "--certificate", "certificate.json")
        header = (self.folder / "turning.hpp").read_text()
        self.dashpot("verify", "certificate.json", "turning.hpp")
        # Changed against the promise, which the device alone tells, whatever the compiler has chosen.
        for name, by in (("gate_factor_1", 1.01), ("gate_recovery", 1.01), ("gate_reserve", 0.99)):
            found = re.search(rf"scalar {name} = ([\d.e+-]+);", header)
            edited = header[:found.start(1)] + repr(float(found[1]) * by) + header[found.end(1):]
            stated = json.loads((self.folder / "certificate.json").read_text())
            stated["constants"][name] = [float(found[1]) * by]
            self.write("edited.hpp", edited)
            self.write("edited.json", json.dumps(stated))
            refused = self.dashpot("verify", "edited.json", "edited.hpp", status=INPUT_REFUSED).stderr
            self.assertRegex(refused, rf"'{'gate_reserve' if name == 'gate_recovery' else name}' is .* at (most|least)")
            self.assertEqual(refused.count("[constant-wrong]"), 1)
            self.assertNotIn("[unknown-constant]", refused)
        # And if the promise is kept, but by a number other than the compiler's.
        found = re.search(r"scalar gate_factor_1 = ([\d.e+-]+);", header)
        stated = json.loads((self.folder / "certificate.json").read_text())
        stated["constants"]["gate_factor_1"] = [0.99 * float(found[1])]
        self.write("edited.hpp", header[:found.start(1)] + repr(0.99 * float(found[1])) + header[found.end(1):])
        self.write("edited.json", json.dumps(stated))
        refused = self.dashpot("verify", "edited.json", "edited.hpp", status=INPUT_REFUSED).stderr
        self.assertRegex(refused, r"'gate_factor_1' is .* recomputed from the network it is")
        self.assertEqual(refused.count("[constant-wrong]"), 1)
        self.assertNotIn("[unknown-constant]", refused)

    # If this fails, a table says something else than the plane or the ball that it was made of.
    def test_grids_are_what_they_were_made_of(self):
        self.write("prompt.json", json.dumps(prompt_arm()))
        places = lambda low, step, count: [low + step * i for i in range(count)]
        network = {"parallel": [{"spring": "150 N/m"}, {"series": [{"spring": "100 N/m"}, {"damper": "20 N s/m"}]}]}

        def port_of(map):
            return {"name": "body", "map": map, "network": network, "contact": {"at": "0 mm"}}

        def written(name, map):
            return self.write(f"{name}.json",
                              json.dumps({"dashpot": 1, "axes": 2, "name": name, "ports": [port_of(map)]}))

        def grid_of(depth, xs, ys):
            return {"grid": {"x": xs, "y": ys, "values": [[depth(x, y) for x in xs] for y in ys]}}

        # Beyond the last row and column a plane goes on as a plane.
        flat = grid_of(lambda x, y: 0.6 * x + 0.8 * (y - 0.095), places(-0.03, 0.01, 6), places(0.08, 0.005, 5))
        rows = self.rows(in_the_middle(2500))
        wall = {"wall": {"through": [0, "95 mm"], "normal": [-0.6, -0.8]}}
        by_grid, by_wall = (self.simulated(written(name, map), rows, "--device", "prompt.json")
                            for name, map in (("flat", flat), ("plane", wall)))
        for one, other in zip(by_grid, by_wall):
            for a, b in zip(one[2:], other[2:]):
                self.assertAlmostEqual(a, b, delta=1e-13)
        self.assertTrue(any(abs(one[2]) > 1e-3 for one in by_wall))
        ball = grid_of(lambda x, y: 0.04 - math.hypot(x, y - 0.06), places(-0.04, 0.0025, 33), places(0.07, 0.0025, 21))
        round_map = {"ball": {"centre": [0, "60 mm"], "radius": "40 mm"}}
        by_grid, by_ball = (self.simulated(written(name, map), rows, "--device", "prompt.json")
                            for name, map in (("bumps", ball), ("round", round_map)))
        largest = max(abs(one[2]) for one in by_ball)
        self.assertGreater(largest, 1e-3)
        for one, other in zip(by_grid, by_ball):
            for a, b in zip(one[2:], other[2:]):
                self.assertAlmostEqual(a, b, delta=2e-3 * largest)
        # Certified, compiled, to the bit, and verified.
        told, exact = (self.explained(f"{name}.json", "--device", "prompt.json") for name in ("bumps", "round"))
        self.assertTrue(told["certified"])
        self.assertAlmostEqual(told["needed_damping"], exact["needed_damping"], delta=0.1 * exact["needed_damping"])
        answers = [row[:4] for row in self.answers(self.compile(self.folder / "bumps.json", "--device", "prompt.json"),
                                                   rows)[:-1]]
        self.assertEqual(answers, by_grid)
        for name, scalar in (("bumps", "double"), ("flat", "float")):
            self.dashpot("compile", f"{name}.json", "--device", "prompt.json", "--scalar", scalar, "--certificate",
                         "certificate.json")
            self.dashpot("verify", "certificate.json", f"{name}.hpp")
        header = (self.folder / "flat.hpp").read_text()
        for table in ("body_map_s1_t0", "body_map_corner_x", "body_map_row"):
            found = re.search(rf"{table}\[\d+\] = {{[^}}]*?([1-9][\d.]*)", header)
            self.write("edited.hpp", header[:found.start(1)] + "7.5" + header[found.end(1):])
            self.dashpot("verify", "certificate.json", "edited.hpp", status=INPUT_REFUSED)

    # If this fails, with three or four brakes the motors bring energy in, or brakes make less than they can.
    def test_more_brakes_without_injection(self):
        along = {"difference": [1, -1], "sum": [1, 1]}
        network = self.write("field.json", json.dumps(field_of("field", 1.0, 0)))
        rows = [[*q, 1.0, 0.0] for q in in_the_middle(400)]
        for limit, names in (("14 mN m s/rad", ["difference"]), ("14 mN m s/rad", ["difference", "sum"]),
                             ("2 mN m s/rad", ["difference"]),
                             ("1 mN m s/rad", ["difference", "sum"])):
            brakes = [{**BRAKE, "max_damping": limit, "along": a}
                      for a in ([1, 0], [0, 1], *(along[name] for name in names))]
            with self.subTest(limit=limit, names=names):
                self.write("arm.json", json.dumps(prompt_arm(brakes=brakes)))
                told = self.explained(network, "--device", "arm.json", "--decomposition", "non-injecting")
                lines = [f"{i / 10000},{','.join(map(repr, row))}" for i, row in enumerate(rows)]
                self.write("motion.csv", "time,q1,q2,v1,v2\n" + "\n".join(lines) + "\n")
                text = self.dashpot("simulate", network, "--input", "motion.csv", "--device", "arm.json",
                                    "--decomposition", "non-injecting").stdout
                exact = 0
                for row, line in list(zip(rows, text.splitlines()[1:]))[::10]:
                    answer = [float(word) for word in line.split(",")[5:]]
                    dampings = [d - a for d, a in zip(answer, told["added_damping"])]
                    wanted = wanted_at(row[:2], [[1, 0], [0, 1]])
                    rest = [[wanted[i][j] - sum(d * b["along"][i] * b["along"][j] for d, b in zip(dampings, brakes))
                             for j in range(2)]
                            for i in range(2)]
                    size = wanted[0][0] + wanted[1][1]
                    for d in dampings:
                        self.assertGreaterEqual(d, -1e-12 * size)
                    # The motors make the rest, which takes power in every direction.
                    self.assertAlmostEqual(answer[-2], rest[0][0], delta=1e-8 * size)
                    self.assertAlmostEqual(answer[-1], rest[1][0], delta=1e-8 * size)
                    middle, apart = (rest[0][0] + rest[1][1]) / 2, math.hypot((rest[0][0] - rest[1][1]) / 2, rest[0][1])
                    self.assertGreaterEqual(middle - apart, -1e-8 * size)
                    exact += middle + apart < 1e-7 * size
                if limit == "14 mN m s/rad" and "sum" in names:
                    self.assertEqual(exact, len(rows) / 10)


if __name__ == "__main__":
    unittest.main()
