"""The test that `--with-test` writes for a law of two axes: it passes where the header is right, and fails where it is
not."""
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

from axes_c99_test import BOARD, SLIPPING
from axes_fields_test import BRAKE, FAR, field_of, prompt_arm
from axes_test import BALL, FIELD, PANTOGRAPH, WALL, near
from dashpot_command import INPUT_REFUSED, SOURCE, CommandTest

RELAXING = {"dashpot": 1, "axes": 2, "name": "relaxing", "ports": [
    {"name": "band", "map": {"line": {"through": [0, "160 mm"], "direction": [1, 0.2], "radius": "90 mm"}},
     "network": {"parallel": [
        {"spring": "120 N/m"}, {"damper": "0.3 N s/m"}, {"series": [{"spring": "700 N/m"}, {"damper": "3 N s/m"}]}]}},
    {"name": "bowl", "map": {"grid": {"x": ["-30 mm", "-10 mm"], "y": ["80 mm", "100 mm", "120 mm"],
                                      "values": [["1 mm", "3 mm"], ["2 mm", "1 mm"], ["5 mm", "2 mm"]]}},
     "network": {"parallel": [{"spring": "90 N/m"}, {"damper": "1 N s/m"}]}}]}


STRICT = ["g++", "-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]


class AxesResponseTest(CommandTest):

    @classmethod
    def setUpClass(cls):
        """GoogleTest is read once, for all programs."""
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.precompiled = pathlib.Path(folder.name) / "precompiled.hpp"
        cls.precompiled.write_text("#include <gtest/gtest.h>\n")
        subprocess.run([*STRICT, cls.precompiled, "-o", f"{cls.precompiled}.gch"], check=True)

    def said(self, name):
        """What the test says, built as its reader would build it."""
        subprocess.run([*STRICT, "-include", self.precompiled, "-I", ".", "-I", SOURCE / "runtime/include",
                        f"{name}_test.cpp", "-lgtest", "-lgtest_main", "-o", "law_test"], cwd=self.folder, check=True)
        done = subprocess.run([self.folder / "law_test"], capture_output=True, text=True)
        self.assertEqual(done.returncode != 0, "[  FAILED  ]" in done.stdout)
        return done.stdout

    def laws(self):
        """Networks and options: every kind of arm and map, fields, slips, contacts, rules, no device; and what is
        damped."""
        gated = self.write("gated.json", json.dumps(field_of("gated", 1.5, 1.4)))
        serial = prompt_arm()
        serial["kinematics"] = {**serial["kinematics"], "kind": "serial", "links": ["80 mm", "80 mm"]}
        del serial["kinematics"]["base"]
        links = {**serial, "kinematics": {**serial["kinematics"], "kind": "parallelogram"}}
        four = prompt_arm(brakes=[{"along": along, **BRAKE} for along in ([1, 0], [0, 1], [1, 1], [1, -1])])
        varied = [[[0.5 + x + y, 0.1 * x], [0.1 * x, 0.7]] for y in (0, 1, 2) for x in (0, 1)]
        grid = {"x": ["-12 mm", "12 mm"], "y": ["90 mm", "100 mm", "110 mm"],
                "viscous": [varied[:2], varied[2:4], varied[4:]]}
        over = {"dashpot": 1, "axes": 2, "name": "over", "ports": [{**FAR, "contact": {"at": "0 mm"}}],
                "field": {"grid": grid}}
        smooth = {**over, "name": "smooth", "ports": [{key: value for key, value in FAR.items() if key != "contact"}]}
        files = {name: self.write(f"{name}.json", json.dumps(text)) for name, text in (
            ("prompt", prompt_arm()), ("serial", serial), ("links", links), ("four", four), ("relaxing", RELAXING),
            ("slipping", SLIPPING),
            ("over", over), ("smooth", smooth))}
        near_board = self.write("near_board.json", near(BOARD))
        return [(FIELD, ["--device", PANTOGRAPH], True), (WALL, ["--device", near_board], False),
                (BALL, ["--device", PANTOGRAPH], False),
                (gated, ["--device", files["prompt"]], False), (gated, ["--device", files["four"]], False),
                (files["relaxing"], ["--device", files["serial"]], True),
                (files["relaxing"], ["--device", files["prompt"], "--scheme", "backward-euler"], True),
                (files["relaxing"], ["--device", files["links"], "--decomposition", "virtual"], True),
                (files["relaxing"], ["--device", files["four"], "--decomposition", "non-injecting"], True),
                (files["slipping"], ["--device", files["four"]], False),
                (files["over"], ["--device", files["prompt"]], False),
                (files["smooth"], ["--device", files["prompt"]], True),
                (files["smooth"], ["--device", files["four"]], True), (FIELD, ["--rate", "1000"], True)]

    def test_right_headers_pass(self):
        """Fails if the bounds on rounding are too narrow for a law, or what the test expects is not what the law
        does."""
        for number, (network, options, is_damped) in enumerate(self.laws()):
            for scalar in ("double", "float") if number % 3 == 0 or os.environ.get("DASHPOT_LONG") == "1" else (
                "double",):
                with self.subTest(network=network.stem, options=options, scalar=scalar):
                    self.dashpot("compile", network, *options, "--scalar", scalar, "--uncertified", "--no-advice",
                                 "--with-test")
                    said = self.said(json.loads(network.read_text())["name"])
                    self.assertIn("[  PASSED  ]", said)
                    self.assertNotIn("[  FAILED  ]", said)
                    self.assertEqual("DampsAsItsNetwork" in said, is_damped)

    def test_wrong_headers_fail(self):
        """Fails if a test passes a law that is wrong: a part in 1e12 of a stiffness or a damping, what is left after
        reset(), what is no number."""
        name = "kelvin_field"
        self.dashpot("compile", FIELD, "--device", PANTOGRAPH, "--with-test")
        header = self.folder / f"{name}.hpp"
        right = header.read_text()
        less = re.search(r"\(wanted_11 - part_\d+\) \* v1", right)[0]
        for text, wrong, found in (
                ("across_static_stiffness = 100.0;", "across_static_stiffness = 100.0000000001;", "RestsOnItsSprings"),
                ("half_static_stiffness = 50.0;", "half_static_stiffness = 50.0000000001;", "RestsOnItsSprings"),
                ("half_base = 0.0125;", "half_base = 0.01250000000001;", "RestsOnItsSprings"),
                ("added_damping_1 = 0.00446", "added_damping_1 = 0.00447", "DampsAsItsNetwork"),
                (less, less.replace("-", "+"), "DampsAsItsNetwork"),
                ("wanted_12 * v2", "wanted_12 * v1", "DampsAsItsNetwork"),
                ("if (!dashpot::all_finite(q1, q2, v1, v2, damping_1, damping_2, torque_1, torque_2)) {",
                 "if (false) {",
                 "SurvivesNanAndInfinity")):
            with self.subTest(wrong=wrong):
                self.assertIn(text, right)
                header.write_text(right.replace(text, wrong))
                self.assertIn(f"[  FAILED  ] {name}.{found}", self.said(name))

    def test_in_c_there_is_none(self):
        self.refused("compile", FIELD, "--target", "c99", "--with-test", code="option-on-two-axes",
                     status=INPUT_REFUSED)


if __name__ == "__main__":
    unittest.main()
