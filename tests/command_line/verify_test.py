"""`dashpot compile --certificate` and `dashpot verify`."""
import concurrent.futures
import json
import random
import re
import unittest

from dashpot_command import FIG_5, INPUT_REFUSED, KELVIN, PANTOGRAPH, SOURCE, CommandTest, network

SEED = 20090911
BOARD = SOURCE / "runtime/devices/board_mps2.json"
TWENTY = SOURCE / "tests/responses/networks/twenty_branches.json"
BRIDGE = SOURCE / "networks/paper/bridge.json"
KELVINS = SOURCE / "networks/paper/generalised_kelvin_two.json"

# One law of each shape: with and without a device, both schemes and scalars, every state input, rolled and straight.
LAWS = [
    [FIG_5], [BRIDGE, "--rate", "3000"], [TWENTY], [FIG_5, "--scalar", "float"],
    [FIG_5, "--scheme", "backward-euler"], [FIG_5, "--state-input", "velocity"],
    [KELVINS, "--scheme", "backward-euler", "--state-input", "nodal"],
    [FIG_5, "--device", BOARD], [FIG_5, "--device", PANTOGRAPH], [FIG_5, "--device", BOARD, "--scalar", "float"],
    [FIG_5, "--decomposition", "2.5"], [FIG_5, "--scalar", "float", "--rate", "100000"], [TWENTY, "--vector", "avx512"],
]

PAPER = SOURCE / "networks/paper"
# Friction beside a chain of two slips, which are solved together; the chain also touches the tool by a Maxwell element.
COUPLED = """{ "parallel": [ { "spring": 40 }, { "series": [ { "spring": 300 }, { "damper": 4 }, { "parallel": [ { "slip": 0.3 },
    { "series": [ { "spring": 120 }, { "slip": 0.1 } ] }, { "damper": 0.7 } ] } ] } ] }"""

# One law of each shape with slips or a contact: closed form, rolled, with modes, gated, compensated, coupled, pushed.
SLIP_LAWS = [
    [PAPER / "visco_elasto_plastic.json"], [PAPER / "visco_elasto_plastic_organ.json"], [PAPER / "maxwell_slip_ten.json"],
    [PAPER / "virtual_wall.json", "--constant-time"], [SOURCE / "networks/tissues/needle_in_liver.json"], ["coupled.json"],
    [PAPER / "visco_elasto_plastic.json", "--device", PANTOGRAPH, "--decomposition", "velocity-free"],
    [PAPER / "visco_elasto_plastic_organ.json", "--device", BOARD], [PAPER / "virtual_wall.json", "--device", BOARD],
    ["coupled.json", "--scheme", "backward-euler"], ["coupled.json", "--scalar", "float"],
    [PAPER / "visco_elasto_plastic_organ.json", "--scalar", "float", "--decomposition", "compensated"],
]


def changed_digit(text, place, chance):
    """The text with the digit at `place` changed to another one."""
    others = [digit for digit in "0123456789" if digit != text[place]]
    return text[:place] + chance.choice(others) + text[place + 1:]


def digits_of_code(header):
    """Where the digits stand that are neither banner nor digest."""
    start = header.index("#pragma once")
    digest = re.search(r"device_digest = .*", header)
    return [i for i in range(start, len(header)) if header[i].isdigit() and not digest.start() <= i < digest.end()]


class Verify(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("coupled.json", network(COUPLED, "coupled"))

    def emitted(self, law, folder):
        """Header and certificate of a law, as text."""
        self.dashpot("compile", *law, "-o", folder, "--certificate", self.folder / folder / "certificate.json")
        header = next((self.folder / folder).glob("*.hpp"))
        return header.read_text(), (self.folder / folder / "certificate.json").read_text()

    def verify(self, header, certificate, name, status=0):
        self.write(f"{name}.hpp", header)
        self.write(f"{name}.json", certificate)
        return self.dashpot("verify", f"{name}.json", f"{name}.hpp", status=status)

    def test_every_shape_of_law(self):
        """Fails if a sound header is refused, or one is passed whose constants are another network's."""
        for i, law in enumerate(LAWS + SLIP_LAWS):
            with self.subTest(law=law):
                header, certificate = self.emitted(law, f"law_{i}")
                self.assertIn("nearest", self.verify(header, certificate, f"sound_{i}").stdout)

    def test_banner_and_digest_take_no_part(self):
        """Fails if a header is told by its digest rather than by its numbers."""
        header, certificate = self.emitted([FIG_5, "--device", BOARD], "law")
        header = header[header.index("#pragma once"):]
        header = re.sub(r'device_digest = "[0-9a-f]*"', 'device_digest = "0"', header)
        self.verify(header, certificate, "stripped")

    def mutants(self, count, chance, consistently, laws=LAWS):
        laws = [self.emitted(law, f"law_{i}") for i, law in enumerate(laws)]
        for number in range(count):
            header, certificate = laws[number % len(laws)]
            if not consistently:
                yield number, changed_digit(header, chance.choice(digits_of_code(header)), chance), certificate
                continue
            constants = list(re.finditer(r"static constexpr scalar (\w+) = ([^;]*);", header))
            constant = chance.choice(constants)
            places = [i for i in range(constant.start(2), constant.end(2)) if header[i].isdigit()]
            changed = changed_digit(header, chance.choice(places), chance)
            value = float(re.search(rf"scalar {constant.group(1)} = ([^;]*?)f?;", changed).group(1))
            told = json.loads(certificate)
            told["constants"][constant.group(1)] = [value]
            if constant.group(1) == "damping":
                told["law"]["brake_command"] = value
            if constant.group(1) == "added_damping":
                told["law"]["added_damping"] = value
            yield number, changed, json.dumps(told)

    def expect_all_found(self, mutants):
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            for done in [pool.submit(self.verify, header, certificate, f"mutant_{number}", INPUT_REFUSED)
                         for number, header, certificate in mutants]:
                done.result()

    def test_single_digits_of_headers(self):
        """Fails if one of 200 headers with a single digit changed passes for the one that was emitted."""
        self.expect_all_found(self.mutants(200, random.Random(SEED), consistently=False))

    def test_single_digits_of_header_and_certificate(self):
        """Fails if one of 100 wrong constants passes because the certificate has the same mistake."""
        self.expect_all_found(self.mutants(100, random.Random(SEED + 1), consistently=True))

    def test_single_digits_of_headers_with_slips(self):
        """Fails if one of 200 headers of laws with slips or a contact with a single digit changed passes."""
        self.expect_all_found(self.mutants(200, random.Random(SEED + 2), False, SLIP_LAWS))

    def test_single_digits_of_header_and_certificate_with_slips(self):
        """Fails if one of 100 wrong constants of such laws passes because the certificate has the same mistake."""
        self.expect_all_found(self.mutants(100, random.Random(SEED + 3), True, SLIP_LAWS))

    def test_what_is_no_certificate(self):
        """Fails if another file in the place of a certificate or a header is taken for one."""
        header, certificate = self.emitted([FIG_5], "law")
        self.write("header.hpp", header)
        self.write("certificate.json", certificate)
        self.refused("verify", FIG_5, "header.hpp", code="no-certificate")
        self.refused("verify", "certificate.json", FIG_5, code="no-emitted-header")
        wrong = json.loads(certificate)
        wrong["network_file"] = KELVIN
        self.write("wrong.json", json.dumps(wrong))
        self.refused("verify", "wrong.json", "header.hpp", code="unknown-constant")
        self.write("shorter.hpp", re.sub(r".*scalar static_stiffness = .*\n", "", header))
        self.refused("verify", "certificate.json", "shorter.hpp", code="constant-missing")
        told = json.loads(certificate)
        told["passivity"]["needed_damping"] *= 1.5
        self.write("more.json", json.dumps(told))
        self.refused("verify", "more.json", "header.hpp", code="bound-wrong")
        header, certificate = self.emitted([PAPER / "visco_elasto_plastic.json"], "slips")
        self.write("soft.hpp", re.sub(r"(trial_by_change = )1000", r"\g<1>1001", header))
        self.write("slips.json", certificate)
        self.refused("verify", "slips.json", "soft.hpp", code="constant-of-nothing")

    def test_numbers_of_which_nothing_follows(self):
        """Fails if a header or certificate of absurd numbers ends `verify` by itself, in place of a refusal."""
        header, certificate = self.emitted([FIG_5, "--device", PANTOGRAPH], "law")
        for number, code in [("1e308", "constant-wrong"), ("inf", "no-emitted-header"), ("nan", "no-emitted-header")]:
            absurd = re.sub(r"(scalar step_stiffness = )[^;]*", rf"\g<1>{number}", header)
            self.assertIn(code, self.verify(absurd, certificate, "absurd", INPUT_REFUSED).stderr)
        for key, value in [("rate", 0), ("rate", 1e300), ("damping", -1), ("scheme", "other"), ("decomposition", -1)]:
            told = json.loads(certificate)
            told["law"][key] = value
            self.assertIn("no-certificate", self.verify(header, json.dumps(told), "told", INPUT_REFUSED).stderr)

    def test_parts_that_are_too_large(self):
        """Fails if a certificate can ask for minutes of work, or for more memory than there is."""
        header, certificate = self.emitted([FIG_5], "law")
        told = json.loads(certificate)
        ends = ["tool"] + [f"n{i}" for i in range(201)]
        rungs = [{"spring": 1, "nodes": [a, b]} for a, b in zip(ends, ends[1:])]
        rungs += [{"damper": 1, "nodes": [end, "ground"]} for end in ends[1:]]
        told["network_file"] = json.dumps({"dashpot": 1, "name": "second_order_maxwell", "elements": rungs})
        refusal = self.verify(header, json.dumps(told), "large", INPUT_REFUSED).stderr
        self.assertIn("has 201 inner nodes; at most 200 are eliminated together [part-too-large]", refusal)

    def test_what_is_not_recomputed(self):
        """Fails if slips outside a tree, or tunable parameters, are said to be verified."""
        parts = [("spring", 5, "tool", "p"), ("spring", 7, "tool", "q"), ("spring", 3, "p", "q"), ("slip", 1, "p", "ground"), ("slip", 2, "q", "ground")]
        self.write("loop.json", json.dumps({
            "dashpot": 1, "name": "loop", "motion": "translation",
            "elements": [{kind: value, "nodes": [a, b], "name": f"e{i}"} for i, (kind, value, a, b) in enumerate(parts)]}))
        for path, name in [("loop.json", "loop"), (SOURCE / "networks/tunable/friction_tunable.json", "friction_tunable")]:
            self.dashpot("compile", path, "--certificate", f"{name}.certificate.json")
            self.refused("verify", f"{name}.certificate.json", f"{name}.hpp", code="not-recomputed")

    def test_one_network_a_certificate(self):
        """Fails if a certificate is written that speaks of the last of several networks only."""
        self.write("kelvin.json", KELVIN)
        self.refused("compile", "kelvin.json", FIG_5, "--certificate", "c.json", code="certificate-of-several", status=2)


class Certified(CommandTest):
    def test_missing_damping_is_refused_with_what_would_do(self):
        """Fails if a law that its device cannot hold is written without being asked for, or without a remedy."""
        self.write("kelvin.json", KELVIN)
        single = SOURCE / "runtime/devices/phantom_single_motor.json"
        done = self.refused("compile", "kelvin.json", "--device", single, code="not-certified")
        for remedy in ["a brake of", "of its stiffness and damping would do", "--uncertified"]:
            self.assertIn(remedy, done.stderr)
        self.assertEqual(self.files(), ["kelvin.json"])
        self.dashpot("compile", "kelvin.json", "--device", single, "--uncertified")
        self.assertIn("passivity: not certified", (self.folder / "kelvin.hpp").read_text())

    def test_a_faster_loop_as_a_remedy(self):
        """Fails if a rate is not offered where it would do."""
        self.write("stiff.json", network('{ "parallel": [ { "spring": 100000 }, { "damper": 5 } ] }', "stiff"))
        done = self.refused("compile", "stiff.json", "--device", BOARD, code="not-certified")
        self.assertIn("a loop at ", done.stderr)

    def test_estimators_without_proof(self):
        """Fails if a law whose motor follows a sliding mode is called certified, or refused."""
        self.write("kelvin.json", KELVIN)
        told = json.loads(BOARD.read_text())
        told["velocity"] = {"estimator": "super_twisting", "acceleration": "50 m/s^2"}
        told["brake"]["max_damping"] = "1 N s/m"
        told["brake"]["safe_damping"] = "1 N s/m"
        self.write("sliding.json", json.dumps(told))
        done = self.dashpot("compile", "kelvin.json", "--device", "sliding.json")
        self.assertIn("[nothing-proved]", done.stderr)
        self.assertIn("passivity: not certified", (self.folder / "kelvin.hpp").read_text())

    def test_what_is_added(self):
        """Fails if the damping that passivity needs is not in the brake's command, or not stated."""
        self.dashpot("compile", FIG_5, "--device", BOARD, "--certificate", "c.json")
        told = json.loads((self.folder / "c.json").read_text())
        header = (self.folder / "second_order_maxwell.hpp").read_text()
        added = float(re.search(r"added_damping = ([^;]*);", header).group(1))
        self.assertGreater(added, 0.1)
        self.assertEqual(added, told["law"]["added_damping"])
        self.assertEqual(float(re.search(r"scalar damping = ([^;]*);", header).group(1)), told["law"]["brake_command"])
        self.assertTrue(told["passivity"]["certified"])
        self.assertGreaterEqual(told["passivity"]["assured_damping"], told["passivity"]["needed_damping"] * (1 - 1e-15))


if __name__ == "__main__":
    unittest.main()
