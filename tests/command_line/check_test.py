"""`dashpot-check`: what it accepts, and that it accepts nothing false."""
import cmath
import json
import math
import os
import random
import re
import subprocess
import unittest

from dashpot_command import FIG_5, SOURCE, CommandTest

CHECK = os.environ["DASHPOT_CHECK"]
PAPER = SOURCE / "networks/paper"
SEED = 20090911

# Straight and rolled, position and velocity driven, nodal, in single precision by every scheme of the states.
LAWS = [[FIG_5], [PAPER / "kelvin.json"], [PAPER / "bridge.json", "--rate", "3000"], [PAPER / "generalised_kelvin_four.json"],
        [FIG_5, "--state-input", "velocity"], [FIG_5, "--scalar", "float"], [FIG_5, "--scalar", "float", "--rate", "100000"],
        [PAPER / "generalised_kelvin_two.json", "--scheme", "backward-euler", "--state-input", "nodal"],
        [SOURCE / "tests/responses/networks/twenty_branches.json"]]

# Edits of the code around the constants, each of which makes another law of it or one that is not known.
CODE = [("position_change = position - last_position_", "position_change = position + last_position_"),
        ("last_position_ = sampled_position_;", "last_position_ = sampled_position_change_;"),
        ("return {damping, force};", "return {damping, force + force};"), ("using scalar = double", "using scalar = int"),
        ("unsigned set(const parameters&) noexcept { return 0; }", "unsigned set(const parameters&) noexcept { relaxed_force_ = 1; return 0; }"),
        ("#pragma once", "#pragma once\n#define position velocity"), ("  void update() noexcept {", "  void update() noexcept {\n    relaxed_force_ = 3;"),
        ("scalar last_position_ = 0;", "scalar last_position_ = 0; static inline int more = 0;")]


def largest_need(header):
    """The largest S(θ) on a grid, of a straight law on an ideal device, from the constants in its text."""
    constants = {name: float(value) for name, value in re.findall(r"constexpr scalar (\w+) = (\S+);", header)}
    period, most = constants["sample_period"], 0
    modes = [name[:-5] for name in constants if name.endswith("_decay")]
    for i in range(1, 4001):
        w = cmath.exp(-1j * math.pi * (i / 4000) ** 3)
        answer = constants.get("step_stiffness", 0) + constants.get("velocity_gain", 0) / period
        for mode in modes:
            drive = constants.get(mode + "gain", 0) + constants.get(mode + "velocity_drive", 0) / period
            answer += drive * w / (1 - constants[mode + "decay"] * w)
        most = max(most, period * (constants.get("static_stiffness", 0) / 2 - (w * answer).real))
    return most


class CheckTest(CommandTest):
    def compiled(self, arguments):
        self.dashpot("compile", *arguments, "--certificate", "law.json")
        header = next(self.folder.glob("*.hpp"))
        text = header.read_text()
        header.unlink()
        return text, json.loads((self.folder / "law.json").read_text())

    def accepts(self, header, certificate):
        files = [self.write("checked.hpp", header), self.write("checked.json", json.dumps(certificate))]
        done = subprocess.run([CHECK, *files], capture_output=True, text=True, timeout=60)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        self.assertIn("not proved" if done.returncode else "proved: with a damping", done.stdout)
        return done.returncode == 0

    # A law that the compiler certifies would not be proved by the program that shares nothing with it.
    def test_every_form(self):
        for law in LAWS:
            with self.subTest(law=law):
                header, certificate = self.compiled(law)
                self.assertTrue(certificate["passivity"]["certified"])
                self.assertTrue(self.accepts(header, certificate))

    # A law that is not linear would be proved by what is for linear laws.
    def test_slips_are_not_proved_here(self):
        self.assertFalse(self.accepts(*self.compiled([PAPER / "visco_elasto_plastic.json"])))

    # A millionth less damping than is proved would be proved, or code that does something else.
    def test_less_damping_and_other_code(self):
        header, certificate = self.compiled([FIG_5])
        lowered = json.loads(json.dumps(certificate))
        lowered["storage"]["damping"] *= 1 - 1e-6
        self.assertFalse(self.accepts(header, lowered))
        for old, new in CODE:
            self.assertIn(old, header)
            self.assertFalse(self.accepts(header.replace(old, new, 1), certificate), new)

    # An edited number, by an ulp or by a lot, would be accepted though more damping is needed than is stated.
    def test_edited_numbers(self):
        chance = random.Random(SEED)
        header, certificate = self.compiled([FIG_5])
        places = [m for m in re.finditer(r"constexpr scalar (?!damping|threshold|added|half)\w+ = (-?[\d.e-]+);", header) if "weight" not in m[0]]
        accepted = 0
        for _ in range(1000 if os.environ.get("DASHPOT_LONG") else 40):
            edited, stated = header, json.loads(json.dumps(certificate))
            if chance.random() < 0.6:
                place = chance.choice(places)
                value = float(place[1])
                other = math.nextafter(value, chance.choice((-1, 1)) * math.inf) if chance.random() < 0.5 else value * (1 + chance.choice((-1, 1)) * 10 ** chance.uniform(-12, 0))
                edited = header[:place.start(1)] + repr(other) + header[place.end(1):]
            else:
                row = chance.choice(stated["storage"]["matrix"])
                place = chance.randrange(len(row))
                row[place] = math.nextafter(row[place], math.inf) if chance.random() < 0.5 else row[place] * (1 + chance.uniform(-1, 1) * 10 ** chance.uniform(-12, 0))
            if self.accepts(edited, stated):
                accepted += 1
                self.assertLessEqual(largest_need(edited), stated["storage"]["damping"], (SEED, edited))
        self.assertGreater(accepted, 0)


if __name__ == "__main__":
    unittest.main()
