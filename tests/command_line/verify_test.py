"""`dashpot compile --certificate` and `dashpot verify`."""
import concurrent.futures
import json
import math
import os
import random
import re
import subprocess
import unittest

from dashpot_command import DASHPOT, FIG_5, INPUT_REFUSED, KELVIN, PANTOGRAPH, SOURCE, CommandTest, codes, network

SEED = 20090911
IS_LONG = os.environ.get("DASHPOT_LONG") == "1"  # else a part of the cases, still some of each law
MOST_HEADERS, MOST_CONSTANTS = (200, 100) if IS_LONG else (25, 25)  # of which a digit is changed
BOARD = SOURCE / "runtime/devices/board_mps2.json"
TWENTY = SOURCE / "tests/responses/networks/twenty_branches.json"
BRIDGE = SOURCE / "networks/paper/bridge.json"
KELVINS = SOURCE / "networks/paper/generalised_kelvin_two.json"
KELVIN_FOUR = SOURCE / "networks/paper/generalised_kelvin_four.json"

# Two relaxations of one rate, which are one mode, and a third.
EQUAL = """{"parallel": [{"series": [{"spring": 10}, {"damper": 1}]}, {"series": [{"spring": 20}, {"damper": 2}]},
    {"series": [{"spring": 5}, {"damper": 3}]}]}"""

# One law of each shape: with and without a device, both schemes and scalars, every state input, rolled and straight,
# modes of one rate.
LAWS = [
    [FIG_5], [BRIDGE, "--rate", "3000"], [TWENTY], [FIG_5, "--scalar", "float"],
    [FIG_5, "--scheme", "backward-euler"], [FIG_5, "--state-input", "velocity"],
    [KELVINS, "--scheme", "backward-euler", "--state-input", "nodal"],
    [FIG_5, "--device", BOARD], [FIG_5, "--device", PANTOGRAPH], [FIG_5, "--device", BOARD, "--scalar", "float"],
    [FIG_5, "--decomposition", "2.5"], [FIG_5, "--scalar", "float", "--rate", "100000"], [TWENTY, "--vector", "avx512"],
    [TWENTY, "--batch"],
    ["equal.json"],
]

PAPER = SOURCE / "networks/paper"
# Friction beside a chain of two slips, which are solved together; the chain also touches the tool by a Maxwell element.
COUPLED = """{ "parallel": [ { "spring": 40 }, { "series": [ { "spring": 300 }, { "damper": 4 }, { "parallel": [ { "slip": 0.3 },
    { "series": [ { "spring": 120 }, { "slip": 0.1 } ] }, { "damper": 0.7 } ] } ] } ] }"""

# Slips with dampers beside them, coupled and in a chain.
DAMPED = """{ "parallel": [ { "damper": 0.5 }, { "series": [ { "parallel": [ { "damper": 2 }, { "series": [ { "spring": 300 }, { "slip": 1 } ] } ] },
    { "parallel": [ { "slip": 0.4 }, { "damper": 3 } ] } ] },
    { "series": [ { "spring": 1000 }, { "parallel": [ { "slip": 0.4 }, { "damper": 3 } ] }, { "parallel": [ { "slip": 0.2 }, { "damper": 5 } ] } ] } ] }"""

# A damper beside a slip alone, and one more that the law keeps; and one beside a slip, a spring and a second slip.
FREED = ['{"series": [{"spring": 1000}, {"parallel": [{"slip": 0.4}, {"damper": 3}]}, {"damper": 7}]}',
         """{"series": [{"spring": 500}, {"parallel": [{"slip": 0.4}, {"series": [{"spring": 500}, {"slip": 0.1}]}, {"damper": 3},
    {"spring": 20}]}]}"""]

# One law of each shape with slips or a contact: closed form, rolled, with modes, gated, steady, ramped, coupled,
# pushed.
SLIP_LAWS = [
    [PAPER / "visco_elasto_plastic.json"], [PAPER / "visco_elasto_plastic_organ.json"],
    [PAPER / "maxwell_slip_ten.json"],
    [PAPER / "virtual_wall.json", "--constant-time"], [SOURCE / "networks/tissues/needle_in_liver.json"],
    ["coupled.json"],
    [PAPER / "visco_elasto_plastic.json", "--device", PANTOGRAPH, "--decomposition", "velocity-free"],
    [PAPER / "visco_elasto_plastic_organ.json", "--device", BOARD], [PAPER / "virtual_wall.json", "--device", BOARD],
    ["coupled.json", "--scheme", "backward-euler"], ["coupled.json", "--scalar", "float"],
    [PAPER / "visco_elasto_plastic_organ.json", "--scalar", "float", "--decomposition", "ramped"],
    *[[file, "--decomposition", law] for file in ("damped.json", "touched.json") for law in ("gated", "ramped")],
    ["damped.json", "--decomposition", "steady"],
    ["damped_loop.json", "--decomposition", "gated"], ["damped_loop.json", "--decomposition", "ramped"],
    ["damped_loop.json", "--decomposition", "steady"],
    *[[f"freed_{i}.json", "--decomposition", "gated"] for i in range(len(FREED))],
    ["damped.json", "--device", BOARD, "--decomposition", "steady"],
    ["damped.json", "--device", BOARD, "--decomposition", "gated"],
]

# Slips in no tree: with a mode that two of them share, and such a part behind a contact, beside a tree, and with modes
# of one rate.
LOOP = """{"spring": 5, "nodes": ["tool", "p"], "name": "a"}, {"spring": 7, "nodes": ["tool", "q"], "name": "b"},
    {"spring": 3, "nodes": ["p", "q"], "name": "c"}, {"slip": 1, "nodes": ["p", "ground"], "name": "d"},
    {"slip": 2, "nodes": ["q", "ground"], "name": "e"}, {"spring": 11, "nodes": ["p", "r"], "name": "f"},
    {"damper": 13, "nodes": ["r", "q"], "name": "g"}, {"spring": 1.5, "nodes": ["r", "tool"], "name": "h"}"""
BESIDE = """{"spring": 3, "nodes": ["tool", "w"], "name": "i"}, {"damper": 0.5, "nodes": ["w", "ground"], "name": "j"},
    {"spring": 90, "nodes": ["tool", "x"], "name": "k"}, {"slip": 0.4, "nodes": ["x", "ground"], "name": "l"},
    {"spring": 8, "nodes": ["tool", "ground"], "name": "m"}, {"damper": 0.7, "nodes": ["tool", "ground"], "name": "n"}"""
# More inner nodes between two slips than slips have ends.
DEEP = ", ".join([f'{{"spring": {10 + 7 * i}, "nodes": ["d{i}", "d{i + 1}"], "name": "w{i}"}}, {{"damper": '
                  f'{1 + 0.3 * i}, "nodes": ["d{i}", "{end}"], "name": "v{i}"}}'
                  for i, end in enumerate(("p", "tool", "q", "ground", "q"))] +
                 ['{"spring": 17, "nodes": ["d5", "p"], "name": "w5"}'])
STAR = ", ".join([f'{{"spring": 10, "nodes": ["tool", "p{i}"], "name": "s{i}"}}, {{"slip": {i}, "nodes": ["p{i}", '
                  f'"ground"], "name": "y{i}"}},'
                  f'{{"spring": 5, "nodes": ["p{i}", "q{i}"], "name": "t{i}"}}, {{"damper": 2, "nodes": ["q{i}", "c"], '
                  f'"name": "b{i}"}},'
                  f'{{"spring": 1, "nodes": ["q{i}", "c"], "name": "u{i}"}}' for i in (1, 2, 3)])

# Parameters of every place: in slips' yield forces and springs, in Maxwell elements, in a mesh, beside fixed modes,
# behind a contact.
TUNED = """{"spring": "k", "nodes": ["tool", "p"], "name": "a"}, {"damper": "b", "nodes": ["p", "ground"], "name": "c"},
    {"spring": 60, "nodes": ["tool", "q"], "name": "d"}, {"damper": "b", "nodes": ["tool", "q"], "name": "e"},
    {"damper": 2.5, "nodes": ["q", "r"], "name": "f"}, {"spring": "k", "nodes": ["r", "ground"], "name": "g"},
    {"spring": 7, "nodes": ["r", "ground"], "name": "h"}, {"spring": 31, "nodes": ["tool", "w"], "name": "i"},
    {"damper": 0.9, "nodes": ["w", "ground"], "name": "j"}, {"spring": 440, "nodes": ["tool", "x"], "name": "l"},
    {"slip": "y", "nodes": ["x", "z"], "name": "m"}, {"slip": 0.3, "nodes": ["x", "z"], "name": "n"},
    {"slip": 1.1, "nodes": ["z", "ground"], "name": "o"}, {"damper": 0.2, "nodes": ["x", "ground"], "name": "s"}"""
BOX = """{"k": {"value": 120, "min": 10, "max": 400, "tunable": true}, "b": {"value": 1.5, "min": 0.25, "max": 6, "tunable": true},
    "y": {"value": 0.7, "min": 0.1, "max": 2, "tunable": true}}"""


def of_elements(elements, name, more=""):
    return f'{{"dashpot": 1, "name": "{name}", "motion": "translation", {more} "elements": [{elements}]}}'


OTHER_LAWS = [
    ["loop.json"], ["loop.json", "--scheme", "backward-euler", "--device", PANTOGRAPH],
    ["loop.json", "--scalar", "float"],
    ["loops.json", "--device", BOARD], ["deep_loop.json"], ["pushed_loop.json"], ["star.json"],
    [PAPER / "visco_elasto_plastic_organ.json", "--scheme", "backward-euler", "--state-input", "nodal"],
    ["loops.json", "--scheme", "backward-euler", "--state-input", "nodal"],
    [SOURCE / "networks/tunable/friction_tunable.json", "--device", BOARD],
    [SOURCE / "networks/tunable/second_order_maxwell_tunable.json"],
    [SOURCE / "networks/tunable/standard_solid_tunable.json", "--device", PANTOGRAPH, "--scalar", "float"],
    [SOURCE / "networks/tunable/standard_solid_tunable.json", "--device", BOARD, "--constant-time"],
    [SOURCE / "networks/tunable/second_order_maxwell_tunable.json", "--constant-time", "--batch"],
    ["tuned.json", "--device", BOARD, "--decomposition", "1.25"], ["tuned.json", "--scheme", "backward-euler"],
    ["pushed_tuned.json"],
    ["tuned.json", "--rate", "1"],
    [SOURCE / "networks/tunable/layers_tunable.json", "--device", PANTOGRAPH],
    [SOURCE / "networks/tunable/layers_tunable.json", "--scheme", "backward-euler", "--scalar", "float"],
]


# Networks with tunable parameters whose brake is told what passivity adds, and little else: one on each device.
TUNED_ON_DEVICES = [[SOURCE / f"networks/tunable/{name}_tunable.json", "--device",
                     SOURCE / f"runtime/devices/{device}.json"]
                    for of, devices in [("springpot", ("board_mps2", "phantom_shorted_motor")),
                                        ("second_order_maxwell", ("pantograph_brake_2009", "phantom_single_motor"))]
                    for device in devices
                    for name in (("springpot", "second_order_maxwell") if IS_LONG else (of,))]

# A relaxation that is over within a sample, one of almost no force, a surface with nothing behind it, and dampers far
# apart.
EXTREMES = {"quick": '{"series": [{"spring": 1}, {"damper": 2e-5}]}',
            "faint": '{"series": [{"spring": 1e-30}, {"damper": 1e-30}]}',
            "nothing": '{"damper": 0}'}
APART = """{"damper": 0.5915, "nodes": ["a", "ground"]}, {"damper": 703802019830.2926, "nodes": ["b", "tool"]}, {"damper": 0.8827, "nodes": ["c", "ground"]},
    {"spring": 2541.0, "nodes": ["c", "b"]}, {"spring": 2.413, "nodes": ["tool", "a"]}, {"damper": 57.22, "nodes": ["ground", "b"]},
    {"slip": 0.5, "nodes": ["tool", "b"]}, {"spring": 113.9, "nodes": ["tool", "a"]}"""
EXTREME_LAWS = [["quick.json"], ["quick.json", "--state-input", "velocity"],
                ["quick.json", "--state-input", "velocity", "--rate", "0.1"],
                ["faint.json", "--scalar", "float"], ["nothing.json"],
                ["apart.json", "--decomposition", "velocity-free"]]


def changed_digit(text, place, chance):
    """The text with the digit at `place` changed to another one."""
    others = [digit for digit in "0123456789" if digit != text[place]]
    return text[:place] + chance.choice(others) + text[place + 1:]


def numbers_of(text):
    """Where the numbers of the scalar's type stand in a constant's values, without float's suffix."""
    text = re.sub(r"//.*", lambda remark: " " * len(remark.group()), text)
    return [(m.start(), m.end()) for m in re.finditer(r"(?<![\w.])-?\d+(?:\.\d*(?:e[-+]?\d+)?|e[-+]?\d+)", text)]


def digits_of_code(header):
    """Where the digits stand that are neither banner nor digest."""
    start = header.index("#pragma once")
    digest = re.search(r"device_digest = .*", header)
    return [i for i in range(start, len(header)) if header[i].isdigit() and not digest.start() <= i < digest.end()]


class Verify(CommandTest):
    laws = {}  # header and certificate of what several tests look at

    def setUp(self):
        super().setUp()
        self.write("coupled.json", network(COUPLED, "coupled"))
        contact = '"contact": { "at": 0.0125 },'
        self.write("loop.json", of_elements(LOOP, "loop"))
        self.write("loops.json", of_elements(f"{LOOP}, {BESIDE}", "loops"))
        self.write("deep_loop.json", of_elements(f"{LOOP}, {DEEP}", "deep_loop"))
        self.write("pushed_loop.json", of_elements(f"{LOOP}, {BESIDE}", "pushed_loop", contact))
        self.write("star.json", of_elements(STAR, "star"))
        self.write("tuned.json", of_elements(TUNED, "tuned", f'"parameters": {BOX},'))
        self.write("pushed_tuned.json", of_elements(TUNED, "pushed_tuned", f'{contact} "parameters": {BOX},'))
        self.write("damped_loop.json", of_elements(f'{LOOP}, {{ "damper": 0.5, "nodes": ["p", "ground"] }}',
                                                   "damped_loop"))
        self.write("equal.json", network(EQUAL, "equal"))
        self.write("damped.json", network(DAMPED, "damped"))
        for i, freed in enumerate(FREED):
            self.write(f"freed_{i}.json", network(freed, f"freed_{i}"))
        self.write("apart.json", of_elements(APART, "apart"))
        for name, extreme in EXTREMES.items():
            self.write(f"{name}.json", network(extreme, name, '"contact": { "at": -0.003 },' if name == "nothing"
                                               else ""))
        self.write("touched.json", network(DAMPED, "touched", '"contact": { "at": 0 },'))

    def emitted(self, law, folder):
        """Header and certificate of a law, as text."""
        self.dashpot("compile", *law, "--uncertified", "--no-advice", "-o", folder,
                     "--certificate", self.folder / folder / "certificate.json")
        # NAME.hpp is before NAME_batch.hpp
        header = min((self.folder / folder).glob("*.hpp"), key=lambda path: len(path.name))
        return header.read_text(), (self.folder / folder / "certificate.json").read_text()

    def emitted_once(self, law, folder):
        """The same for all tests, of files that setUp() writes or of the project's own."""
        key = tuple(map(str, law))
        if key not in self.laws:
            self.laws[key] = self.emitted(law, folder)
        return self.laws[key]

    def verify(self, header, certificate, name, status=0):
        self.write(f"{name}.hpp", header)
        self.write(f"{name}.json", certificate)
        return self.dashpot("verify", f"{name}.json", f"{name}.hpp", "--allow-uncertified", status=status)

    def test_every_shape_of_law(self):
        """Fails if a sound header is refused, or one is passed whose constants are another network's."""
        for i, law in enumerate(LAWS + SLIP_LAWS + OTHER_LAWS + TUNED_ON_DEVICES + EXTREME_LAWS):
            with self.subTest(law=law):
                header, certificate = self.emitted_once(law, f"law_{i}")
                self.assertIn("correctly rounded", self.verify(header, certificate, f"sound_{i}").stdout)

    def test_every_number_and_sentence_of_the_banner(self):
        """Fails if a banner passes that says anything else than what is so of the network, or says less."""
        chance = random.Random(SEED + 20)
        laws = [[FIG_5], [FIG_5, "--device", BOARD], [FIG_5, "--device", PANTOGRAPH],
                [PAPER / "visco_elasto_plastic_organ.json", "--device", BOARD],
                [SOURCE / "networks/tunable/friction_tunable.json", "--device", BOARD]]
        told_before = set()  # sentences but for their numbers: each kind is forged in one law at least
        for i, law in enumerate(laws):
            header, certificate = self.emitted_once(law, f"law_{i}")
            self.verify(header, certificate, "sound")
            code = header.index("#pragma once")
            banner = header[:code]
            version = re.search(r"Written by dashpot (\S+) from", banner)
            sentences = [line for line in banner.splitlines() if line.strip("/ ")]
            kinds = [re.sub(r"[0-9][0-9.e+-]*", "0", sentence) for sentence in sentences]
            forged = [header.replace(sentence + "\n", "", 1) for sentence, kind in zip(sentences, kinds)
                      if IS_LONG or kind not in told_before]
            told_before.update(kinds)
            forged.append(re.sub("(not )?certified( for a[^:]*)?:", "certified for any device:", header, count=1))
            if IS_LONG or i == 0:
                forged += [header[code:], "// Another banner.\n\n// Of two remarks.\n" + header[code:],
                           header.replace("// scheme: ", "// scheme:  ", 1), "\n" + header]
            digits = [at for at in range(code) if banner[at].isdigit() and not version.start(1) <= at < version.end(1)]
            forged += [changed_digit(header, at, chance) for at in chance.sample(digits, 20 if IS_LONG else 4)]
            for number, text in enumerate(forged):
                with self.subTest(law=law, number=number):
                    told = self.verify(text, certificate, f"forged_{i}_{number}", status=INPUT_REFUSED).stderr
                    self.assertRegex(told, r"\[(banner|code)-differs\]")
                    self.assertIn("here 'dashpot compile' writes '", told)
            self.verify(header[:version.start(1)] + "0.0.77" + header[version.end(1):], certificate, "elsewhere")

    def test_what_is_not_certified(self):
        """Fails if a sound header of a law that is not certified passes unasked, or passes for certified; or its
        missing damping is not reported."""
        self.write("kelvin.json", KELVIN)
        bare = json.loads(BOARD.read_text())
        bare["velocity"] = {"estimator": "super_twisting", "acceleration": "50 m/s^2"}
        bare["brake"].update(max_damping="1 N s/m", safe_damping="1 N s/m")
        self.write("bare.json", json.dumps(bare))
        self.write("spring.json", network('{ "spring": 3000 }', "spring"))
        single = SOURCE / "runtime/devices/phantom_single_motor.json"
        for i, (law, missing) in enumerate([(["kelvin.json", "--device", "bare.json"], None),
                                            (["kelvin.json", "--device", single], True), (["spring.json"], True)]):
            with self.subTest(law=law):
                header, certificate = self.emitted(law, f"law_{i}")
                self.write("c.json", certificate)
                self.write("h.hpp", header)
                told = self.refused("verify", "c.json", "h.hpp", code="verified-uncertified").stderr
                self.assertIn("--allow-uncertified accepts it nevertheless", told)
                passivity = json.loads(certificate)["passivity"]
                self.assertEqual((passivity["certified"], passivity["grade"]), (False, "not certified"))
                if missing:
                    number = passivity["needed_damping"] - passivity["assured_damping"]
                    self.assertAlmostEqual(float(re.search(r"(\S+) is missing", told).group(1)) / number, 1, delta=1e-5)
                done = self.dashpot("verify", "c.json", "h.hpp", "--allow-uncertified")
                self.assertTrue(done.stdout.endswith("; not certified\n"), done.stdout)

    def test_grades(self):
        """Fails if header, certificate or verify's word call certified under jitter what is proved for a constant
        period only, or the other way round."""
        device = json.loads(BOARD.read_text())
        constant = "certified for a constant period only"
        cases = [("0 s", "0.5 ms", "certified"), ("0.2 ms", "0.1 ms", "certified"), ("0.2 ms", "0.9 ms", "certified"),
                 ("0.2 ms", "0 s", constant)]
        for lag, jitter, grade in cases:
            with self.subTest(lag=lag, jitter=jitter):
                device["motor"]["amplifier_lag"], device["loop"]["jitter"] = lag, jitter
                self.write("device.json", json.dumps(device))
                header, certificate = self.emitted([KELVIN_FOUR, "--device", "device.json"], "law")
                passivity, is_constant = json.loads(certificate)["passivity"], grade == constant
                self.assertEqual((passivity["certified"], passivity["grade"], passivity["constant_period_only"]),
                                 (True, grade, is_constant))
                banner = re.sub(r"\s*\n//\s*", " ", header[:header.index("#pragma once")])
                self.assertIn(f"{constant}: any motion, samples at" if is_constant else "certified for any motion",
                              banner)
                self.assertEqual("any jitter up to" in banner, not is_constant)
                self.assertTrue(self.verify(header, certificate, "graded").stdout.endswith(f"; {grade}\n"))
                self.write("law.hpp", header)
                self.write("law.json", certificate)
                checked = subprocess.run([os.environ["DASHPOT_CHECK"], "law.hpp", "law.json"], cwd=self.folder,
                                         capture_output=True, text=True)
                self.assertEqual((checked.returncode, "of one length" in checked.stdout), (0, is_constant),
                                 checked.stdout)
                told = json.loads(self.dashpot("explain", KELVIN_FOUR, "--device", "device.json",
                                               "--json").stdout)["certificate"]
                self.assertEqual((told["grade"], told["constant_period_only"]), (grade, is_constant))
        device["motor"]["amplifier_lag"], device["loop"]["jitter"] = "0.2 ms", "1 ms"
        self.write("device.json", json.dumps(device))
        header, certificate = self.emitted([KELVIN_FOUR, "--device", "device.json"], "at_once")
        self.assertIn("not certified: the amplifier lags, and the jitter is a sample or more",
                      re.sub(r"\s*\n//\s*", " ", header))
        self.assertEqual(json.loads(certificate)["passivity"]["grade"], "not certified")

    def test_code_in_the_banner(self):
        """Fails if code in front of a header's own is taken for a part of its banner, however it is written there."""
        header, certificate = self.emitted([FIG_5], "law")
        for i, line in enumerate(["#define relaxed(t, d, f, g) relaxed(t, d, f, -(g))", " int impostor;",
                                  "/**/ int impostor;", "// \\", "// \\ ", "// \\\t", "// ??/",
                                  "// \r#define relaxed wrong", "//\r"]):
            with self.subTest(line=line):
                changed = header.replace("#pragma once", line + "\n#pragma once")
                told = self.verify(changed, certificate, f"front_{i}", status=INPUT_REFUSED).stderr
                self.assertIn("[code-differs]", told)
                self.assertIn("here 'dashpot compile' writes '#pragma once'", told)

    def test_code_that_is_none(self):
        """Fails if a declaration without a name ends more than this header."""
        header, certificate = self.emitted([FIG_5], "law")
        for i, line in enumerate(["static constexpr scalar ] = 1.0;", "static constexpr scalar = 1.0;",
                                  "static constexpr scalar x[", "static constexpr  = scalar"]):
            self.verify(header.replace("static constexpr scalar damping", line + "\n  static constexpr scalar damping"),
                        certificate, f"none_{i}",
                        status=INPUT_REFUSED)

    def test_another_device(self):
        """Fails if a header passes that names another device to the servo loop, or says more in that line."""
        header, certificate = self.emitted([FIG_5, "--device", BOARD], "law")
        digest = re.search(r'device_digest = "[0-9a-f]+";', header).group()
        for i, other in enumerate(['device_digest = "0123456789abcdef";', digest + " int impostor;"]):
            self.verify(header.replace(digest, other), certificate, f"other_{i}", status=INPUT_REFUSED)

    def test_place_of_other_code(self):
        """Fails if code that differs is not shown in its place, in a header of either kind, with what belongs there."""
        for kind in ([], ["--constant-time"]):
            header, certificate = self.emitted([FIG_5, *kind], f"law_{len(kind)}")
            told = self.verify(header.replace("B2_K2_force_ + B1_K1_force_", "B2_K2_force_ - B1_K1_force_"),
                               certificate, f"minus_{len(kind)}",
                               status=INPUT_REFUSED).stderr
            line = 1 + header[:header.index("B2_K2_force_ + B1_K1_force_")].count("\n")
            self.assertIn(f"minus_{len(kind)}.hpp:{line}:", told)
            self.assertRegex(told, r"writes '.*B2_K2_force_ \+ B1_K1_force_")
            told = self.verify(header + "\n", certificate, f"longer_{len(kind)}", status=INPUT_REFUSED).stderr
            self.assertIn(f"longer_{len(kind)}.hpp:{1 + header.count(chr(10))}:", told)
            self.assertIn("writes 'the end of the file'", told)

    def test_line_ends_of_another_system(self):
        """Fails if a header with CR LF at the ends of its lines, as git may write them, is refused, or hides a
        change."""
        header, certificate = self.emitted([FIG_5], "law")
        self.assertIn("correctly rounded", self.verify(header.replace("\n", "\r\n"), certificate, "dos").stdout)
        once = "#pragma once\r\n"
        for i, (text, other) in enumerate([("force_ + ", "force_ - "), ("\r\n", "\n"), (once, once + "\r\n")]):
            changed = other.join(header.replace("\n", "\r\n").rsplit(text, 1))
            self.assertIn("-differs]", self.verify(changed, certificate, f"dos_{i}", status=INPUT_REFUSED).stderr)

    def test_many_points(self):
        """Fails if a sound header of many points is refused, or one passed whose code or constants are another's."""
        header, certificate = self.emitted([TWENTY, "--batch"], "law")
        points = (self.folder / "law" / "twenty_branches_batch.hpp").read_text()
        self.assertIn("correctly rounded", self.verify(points, certificate, "points").stdout)
        layers = SOURCE / "networks/tunable/layers_tunable.json"
        for name, law in [("coupled", "coupled.json"), ("layers_tunable", layers)]:
            _, of_slips = self.emitted([law, "--batch"], name)
            slipping = (self.folder / name / f"{name}_batch.hpp").read_text()
            self.assertIn("correctly rounded", self.verify(slipping, of_slips, f"{name}_points").stdout)
        place = numbers_of(points[:points.index("storage_size")])[-1][1] - 1
        others = [points.replace(" + ", " - ", 1), changed_digit(points, place, random.Random(SEED)),
                  points.replace("states = ", "states = 1", 1)]
        for i, other in enumerate(others):
            self.assertTrue(other != points, i)
            self.assertIn("[code-differs]", self.verify(other, certificate, f"points_{i}", status=INPUT_REFUSED).stderr)
        certificate = json.dumps(json.loads(certificate) |
                                 {"constants": json.loads(self.emitted([FIG_5], "other")[1])["constants"]})
        self.verify(points, certificate, "another", status=INPUT_REFUSED)

    def test_everything_that_is_told(self):
        """Fails if a value of a certificate can be another one, or be missing, or one be there that means nothing."""
        _, certificate = self.emitted([FIG_5, "--device", BOARD], "law")
        header = (self.folder / "law" / "second_order_maxwell.hpp").read_text()
        told = json.loads(certificate)

        def leaves(value, path):
            for key in value if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else []:
                yield from leaves(value[key], [*path, key])
            if not isinstance(value, (dict, list)):
                yield path, value

        def others(value):
            if isinstance(value, bool): return [not value]
            if isinstance(value, str): return [value + "0"]
            return [1] if value is None else [value * 1.0001 + (1e-6 if value == 0 else 0)]

        # Of a law without a rolled loop there is nothing that a guard could be in turn.
        free = ("version", "network_file", "device_file"), ("binding_frequency", "guards_each_sample")
        places = [(path, value) for path, value in leaves(told, []) if path[0] not in free[0]]
        entries = [place for place in places if place[0][0] == "storage"]  # hundreds alike: some of them
        places = [place for place in places if place[0][0] != "storage"] + entries[:: max(1, len(entries) // 8)]
        self.assertGreater(len(places), 80)
        changes = [(path, other) for path, value in places if path[-1] not in free[1] for other in others(value)]
        changes += [(["version"], 1), (["passivity", "binding_frequency"], "often")]
        changes += [(path, None) for path, _ in places if isinstance(path[-1], str)
                    and path[-1] not in free[1]] + [(["loop", "more"], 1), (["elements", 0, "slip"], 1)]

        def accepts(number):
            path, other = changes[number]
            changed = json.loads(certificate)
            inside = changed
            for key in path[:-1]:
                inside = inside[key]
            if other is None and path[-1] in inside: del inside[path[-1]]
            else: inside[path[-1]] = other
            self.write(f"told_{number}.json", json.dumps(changed))
            return subprocess.run([DASHPOT, "verify", "--allow-uncertified", f"told_{number}.json",
                                   "law/second_order_maxwell.hpp"], cwd=self.folder,
                                  capture_output=True).returncode != INPUT_REFUSED

        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            passed = list(pool.map(accepts, range(len(changes))))
        self.assertEqual([changes[i] for i in range(len(changes)) if passed[i]], [])
        self.verify(header, certificate, "unchanged")
        told["version"] = "0.0.1"
        told["passivity"]["binding_frequency"] *= 1.5
        self.verify(header, json.dumps(told), "elsewhere")

    def test_what_is_just_enough(self):
        """Fails if a brake that gives exactly what is needed is found wanting, when compiling or when verifying."""
        def kelvin(damping):
            self.write("just.json", network(f'{{ "parallel": [ {{ "spring": 100 }}, {{ "damper": {damping!r} }} ] }}',
                                            "just"))
            header, certificate = self.emitted(["just.json"], "just")
            return header, certificate, json.loads(certificate)["passivity"]

        needed = kelvin(1.0)[2]["needed_damping"]
        header, certificate, passivity = kelvin(needed)
        self.assertEqual((passivity["needed_damping"], passivity["assured_damping"], passivity["certified"]),
                         (needed, needed, True))
        self.verify(header, certificate, "just_enough")

    def mutants(self, count, chance, consistently, laws=LAWS):
        laws = [self.emitted_once(law, f"law_{i}") for i, law in enumerate(laws)]
        for number in range(count):
            header, certificate = laws[number % len(laws)]
            if not consistently:
                yield number, changed_digit(header, chance.choice(digits_of_code(header)), chance), certificate
                continue
            constants = [c for c in re.finditer(r"static constexpr [^;=]*\bscalar>? (\w+)(?:\[\d*\])? = ([^;]*);",
                                                header) if numbers_of(c.group(2))]
            constant = chance.choice(constants)
            start, end = chance.choice(numbers_of(constant.group(2)))
            places = [i for i in range(constant.start(2) + start, constant.start(2) + end) if header[i].isdigit()]
            changed = changed_digit(header, chance.choice(places), chance)
            text = changed[constant.start(2):constant.end(2)]
            told = json.loads(certificate)
            told["constants"][constant.group(1)] = [float(text[start:end]) for start, end in numbers_of(text)]
            value = told["constants"][constant.group(1)][0]
            if constant.group(1) == "damping":
                told["law"]["brake_command"] = value
            if constant.group(1) == "added_damping":
                told["law"]["added_damping"] = value
            yield number, changed, json.dumps(told)

    def expect_all_found(self, mutants):
        """What is said of each."""
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            verified = [pool.submit(self.verify, header, certificate, f"mutant_{number}", INPUT_REFUSED)
                        for number, header, certificate in mutants]
            return [done.result().stderr for done in verified]

    def expect_recomputed(self, told):
        """Wrong constants are not found only because compiling once more gives others."""
        found = sum(any(code in text for code in ["constant-of-nothing", "constant-wrong", "unknown-constant"])
                    for text in told)
        self.assertGreaterEqual(found, 0.9 * len(told))  # a digit may make it another of the network's own constants

    def test_single_digits_of_headers(self):
        """Fails if a header with a single digit changed passes for the one that was emitted."""
        self.expect_all_found(self.mutants(MOST_HEADERS, random.Random(SEED), consistently=False))

    def test_single_digits_of_header_and_certificate(self):
        """Fails if a wrong constant passes because the certificate has the same mistake."""
        self.expect_all_found(self.mutants(MOST_CONSTANTS, random.Random(SEED + 1), consistently=True))

    def test_single_digits_of_headers_with_slips(self):
        """Fails if a header of a law with slips or a contact with a single digit changed passes."""
        self.expect_all_found(self.mutants(MOST_HEADERS, random.Random(SEED + 2), False, SLIP_LAWS))

    def test_single_digits_of_header_and_certificate_with_slips(self):
        """Fails if a wrong constant of such a law passes because the certificate has the same mistake, or is not
        recomputed."""
        self.expect_recomputed(self.expect_all_found(self.mutants(MOST_CONSTANTS, random.Random(SEED + 3), True,
                                                                  SLIP_LAWS)))

    def test_single_digits_of_headers_with_loops_and_tunables(self):
        """Fails if a header with a single digit changed passes, of slips in no tree, of nodal states beside slips, or
        of tunable parameters."""
        self.expect_all_found(self.mutants(MOST_HEADERS, random.Random(SEED + 4), False, OTHER_LAWS))

    def test_single_digits_of_header_and_certificate_with_loops_and_tunables(self):
        """Fails if a wrong constant of such a law passes because the certificate has the same mistake, or is not
        recomputed."""
        self.expect_recomputed(self.expect_all_found(self.mutants(MOST_CONSTANTS, random.Random(SEED + 5), True,
                                                                  OTHER_LAWS)))

    def test_what_slips_and_blocks_keep_at_least(self):
        """Fails if one unit in the last place more or less passes for what a block or a slip keeps at least while
        parameters change."""
        refused = 0
        for law in (["tuned.json"], ["pushed_tuned.json"], [SOURCE / "networks/tunable/layers_tunable.json"]):
            header, certificate = self.emitted(law, f"law_{refused}")
            for constant in re.finditer(r"static constexpr scalar (\w+_least_(?:answer|yield)) = ([^;]+);", header):
                name, least = constant.group(1), float(constant.group(2))
                for other in (math.nextafter(least, 0), math.nextafter(least, math.inf)):
                    told = json.loads(certificate)
                    told["constants"][name] = [other]
                    changed = header[:constant.start(2)] + repr(other) + header[constant.end(2):]
                    words = self.verify(changed, json.dumps(told), f"least_{refused}", INPUT_REFUSED).stderr
                    self.assertIn(f"'{name}' is", words)
                    refused += 1
        self.assertGreaterEqual(refused, 18)

    def test_messages_name_a_constant_as_the_header_does(self):
        """Fails if a wrong constant is reported without its port's name, or the place of a list without the list."""
        ports = [{"name": "left", "network": {"parallel": [{"spring": 5}, {"series": [{"slip": 2}, {"spring": 11}]}]}},
                 {"name": "right", "network": {"spring": 7}}]
        self.write("two.json", json.dumps({"name": "two", "dashpot": 1, "ports": ports}))
        for law, pattern, told in (
                ("two.json", r"(left_static_stiffness = )[^;]+", "'left_static_stiffness'"),
                ("two.json", r"(right_static_stiffness = )[^;]+", "'right_static_stiffness'"),
                ("coupled.json", r"(slip_part::slip, [^}]*, )[^,}]+", r"place \d+ of 'coupled_\w+'")):
            header, certificate = self.emitted([law], law.removesuffix(".json"))
            changed, count = re.subn(pattern, r"\g<1>0.125", header, count=1)
            self.assertEqual(count, 1, law)
            words = self.verify(changed, certificate, "changed", INPUT_REFUSED).stderr
            self.assertRegex(words, told + r" is 0\.125; recomputed")

    def test_what_is_no_certificate(self):
        """Fails if another file in the place of a certificate or a header is taken for one."""
        header, certificate = self.emitted([FIG_5], "law")
        self.write("header.hpp", header)
        self.write("certificate.json", certificate)
        self.refused("verify", FIG_5, "header.hpp", code="no-certificate")
        swapped = self.refused("verify", "header.hpp", "certificate.json", code="no-certificate").stderr
        self.assertIn("takes the certificate first, then the header", swapped)
        self.refused("verify", "certificate.json", FIG_5, code="no-emitted-header")
        wrong = json.loads(certificate)
        wrong["network_file"] = KELVIN
        self.write("wrong.json", json.dumps(wrong))
        self.refused("verify", "wrong.json", "header.hpp", code="unknown-constant")
        other, _ = self.emitted([FIG_5, "--device", BOARD, "--uncertified"], "other")
        self.write("other.hpp", other)
        apart = "they were not written together: the header is of device 'board_mps2'"
        told = self.refused("verify", "certificate.json", "other.hpp", code="certificate-disagrees").stderr
        self.assertIn(apart, told)
        self.assertNotIn(apart, self.refused("verify", "wrong.json", "header.hpp", code="unknown-constant").stderr)
        self.assertNotIn("the header is of network", told)
        other, _ = self.emitted([PAPER / "kelvin.json"], "kelvin")
        self.write("other.hpp", other)
        self.assertIn("the header is of network 'kelvin', the certificate of network 'second_order_maxwell'",
                      self.refused("verify", "certificate.json", "other.hpp", code="certificate-disagrees").stderr)
        self.write("shorter.hpp", re.sub(r".*scalar static_stiffness = .*\n", "", header))
        self.refused("verify", "certificate.json", "shorter.hpp", code="constant-missing")
        told = json.loads(certificate)
        told["passivity"]["needed_damping"] *= 1.5
        self.write("more.json", json.dumps(told))
        self.refused("verify", "more.json", "header.hpp", code="bound-wrong")
        header, certificate = self.emitted([PAPER / "visco_elasto_plastic.json"], "slips")
        self.write("soft.hpp", re.sub(r"(trial_by_change = )1000", r"\g<1>1001", header))
        self.write("slips.json", certificate)
        self.refused("verify", "slips.json", "soft.hpp", code="constant-wrong")

    def test_where_a_certificate_is_none(self):
        """Fails if what is wrong with a certificate has no place, no remedy, or the words of a library."""
        header, certificate = self.emitted([FIG_5], "law")
        for change, expected in [
            (lambda text: text[:text.index('"scheme"')], "no certificate: the end of the file where"),
            (lambda text: text.replace('"position"', "5"),
             "no certificate: 'state_input' is a number; a string is expected"),
            (lambda text: text.replace('"exact"', '"exactly"'),
             "no certificate: 'scheme' is 'exactly'; one of exact, backward-euler is expected"),
            (lambda text: text.replace('"rate"', '"rates"'), "no certificate: 'law' has no key 'rate'"),
            (lambda text: re.sub('"rate": [^,]*', '"rate": 0', text),
             "no certificate: 'rate' is '0'; 1e-06 to 1000000000 is expected"),
            (lambda text: text.replace('"passivity": {', '"passivity": 5, "other": {'),
             "no certificate: 'passivity' is a number; an object is expected"),
            (lambda text: text.replace('"certified": ', '"certified": 0.'), "no certificate: "),
            (lambda text: text.replace('"dashpot_certificate": 1', '"dashpot_certificate": 2'),
             "no certificate: format is 2; this compiler reads format 1"),
            (lambda text: re.sub(r'"static_stiffness": \[[^]]*\]', '"static_stiffness": ["5"]', text),
             "no certificate: 'static_stiffness' is a string; a number is expected"),
            (lambda text: "[]", "is a list; an object is expected"), (lambda text: "", "the end of the file where")]:
            told = self.verify(header, change(certificate), "unclosed", INPUT_REFUSED).stderr
            self.assertRegex(told, r"\Aunclosed\.json:\d+:\d+: error: .*\[no-certificate\]\n")
            self.assertEqual(told.count("error:"), 1)
            self.assertIn(expected, told)
            self.assertIn("note: 'dashpot compile --certificate' writes one", told)

    def test_what_is_wrong_with_the_network_in_a_certificate(self):
        """Fails if a certificate is refused because of its network, and nothing says what is wrong with that."""
        header, certificate = self.emitted([FIG_5], "law")
        for network_text, told in [(network('{ "spring": -1 }'), "[negative-stiffness]"), ("{", "[unexpected-token]"),
                                   (network('{ "parallel": [ { "spring": 1 }, { "spring": 1e-30 } ] }'),
                                    "[values-far-apart]")]:
            changed = json.loads(certificate)
            changed["network_file"] = network_text
            self.assertIn(told, self.verify(header, json.dumps(changed), "changed", INPUT_REFUSED).stderr)

    def test_the_gain_of_the_encoders_error(self):
        """Fails if another gain than that of the law passes, or none where there is one: linear, with an estimate,
        slips, a contact, slips in no tree, parameters."""
        laws = [[FIG_5], [FIG_5, "--device", BOARD], [FIG_5, "--device", PANTOGRAPH, "--decomposition", "2.5"],
                [PAPER / "maxwell_slip_ten.json", "--device", PANTOGRAPH],
                [PAPER / "virtual_wall.json", "--device", BOARD], ["loops.json", "--device", PANTOGRAPH],
                [SOURCE / "networks/tunable/second_order_maxwell_tunable.json", "--device", PANTOGRAPH]]
        for i, law in enumerate(laws):
            with self.subTest(law=law):
                header, certificate = self.emitted_once(law, f"law_{i}")
                for wrong in (1 - 1e-7, 1 + 1e-7, None):
                    told = json.loads(certificate)
                    gain = told["passivity"]["quantisation_gain"]
                    self.assertGreater(gain, 0)
                    told["passivity"]["quantisation_gain"] = gain and wrong and gain * wrong
                    self.assertIn("quantisation", self.verify(header, json.dumps(told), f"gain_{i}",
                                                              INPUT_REFUSED).stderr)

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
        self.write("large.json", told["network_file"])
        warning = self.dashpot("compile", "large.json", "--certificate", "large_certificate.json", "-o", "large").stderr
        self.assertIn("'dashpot verify', which takes at most 200, will refuse it [certificate-beyond-verify]", warning)

    def test_one_network_a_certificate(self):
        """Fails if a certificate is written that speaks of the last of several networks only."""
        self.write("kelvin.json", KELVIN)
        self.refused("compile", "kelvin.json", FIG_5, "--certificate", "c.json", code="certificate-of-several",
                     status=2)


class Certified(CommandTest):
    def test_missing_damping_is_refused_with_what_would_do(self):
        """Fails if a law that its device cannot hold is written without being asked for, or without a remedy, or if
        `check` takes it."""
        self.write("kelvin.json", KELVIN)
        single = SOURCE / "runtime/devices/phantom_single_motor.json"
        done = self.refused("compile", "kelvin.json", "--device", single, code="not-certified")
        for remedy in ["a brake of", "times all stiffnesses and dampings of the network would be enough",
                       "--uncertified"]:
            self.assertIn(remedy, done.stderr)
        self.assertEqual(self.files(), ["kelvin.json"])
        self.assertEqual(self.refused("check", "kelvin.json", "--device", single, code="not-certified").stderr,
                         done.stderr)
        self.assertEqual(self.files(), ["kelvin.json"])
        self.dashpot("compile", "kelvin.json", "--device", single, "--uncertified")
        self.assertIn("passivity: not certified", (self.folder / "kelvin.hpp").read_text())

    def test_every_law_without_a_certificate_is_warned_of(self):
        """Fails if a law that is not certified is written without a word, on a device or without one, asked for or not,
        or without the number that is missing."""
        self.write("spring.json", network('{ "spring": 3000 }', "spring"))
        self.write("kelvin.json", KELVIN)
        single = SOURCE / "runtime/devices/phantom_single_motor.json"
        told = self.dashpot("compile", "spring.json").stderr
        self.assertIn("[lacks-damping]", told)
        self.assertIn("on an ideal device: 1.5 N s/m of damping are needed, 0 is guaranteed, 1.5 is missing", told)
        told = self.dashpot("compile", "kelvin.json", "--device", single, "--uncertified", "--certificate",
                            "c.json").stderr
        self.assertIn("[lacks-damping]", told)
        passivity = json.loads((self.folder / "c.json").read_text())["passivity"]
        missing = float(re.search(r"(\S+) is missing", told).group(1))
        self.assertAlmostEqual(missing / (passivity["needed_damping"] - passivity["assured_damping"]), 1, delta=1e-5)
        self.write("touch.json", network('{ "spring": 500 }', "touch", '"contact": { "at": 0 },'))
        told = self.dashpot("compile", "touch.json", "--device", BOARD).stderr
        self.assertRegex(told, r"leaves a free tool alone.*; \S+ N s/m of damping are needed, \S+ is guaranteed, "
                         r"\S+ is missing \[nothing-proved\]")
        self.assertEqual(self.dashpot("check", "touch.json", "--device", BOARD).stderr, told)
        self.assertEqual(self.dashpot("compile", "kelvin.json").stderr, "")

    def test_every_remedy_as_it_is_told(self):
        """Fails if a brake, a share, a rate, a jitter or an estimator that is said to do would not, typed as it is
        printed: for a linear network, one with a slip at the tool, and one whose brake follows its slip."""
        skin = ["parallel", ["spring", 400], ["damper", 3]]
        muscle = [["spring", 900], ["series", ["damper", 12], ["spring", 600]]]
        layers = {"linear": ["series", skin, ["parallel", *muscle]],
                  "following": ["series", skin, ["parallel", *muscle, ["slip", 0.3]]],
                  "rubbing": ["parallel", ["spring", 300], ["series", ["damper", 2], ["spring", 150]],
                              ["series", ["slip", 0.5], ["spring", 800]]]}

        def written(tree, share):
            kind, *inside = tree
            if kind in ("series", "parallel"): return {kind: [written(child, share) for child in inside]}
            return {kind: inside[0] * (1 if kind == "slip" else share)}

        def refusal(name, share=1.0, brake=None, rate=None, jitter=None, estimator=None, status=0):
            device = json.loads((SOURCE / "runtime/devices/phantom_shorted_motor.json").read_text())
            device["brake"]["safe_damping"] = "0.1 N s/m"
            if brake: device["brake"]["max_damping"] = brake
            if rate: device["loop"]["rate"] = rate
            if jitter: device["loop"]["jitter"] = jitter
            if estimator: device["velocity"] = json.loads(f"{{{estimator}}}")
            self.write("device.json", json.dumps(device))
            self.write("layers.json", network(json.dumps(written(layers[name], share)), "layers"))
            return self.dashpot("compile", "layers.json", "--device", "device.json", "--decomposition", "paper",
                                status=status).stderr

        found = set()
        more = os.environ.get("DASHPOT_LONG") == "1"
        for name, brakes in {"linear": ["0.6 N s/m", "0.75 N s/m"] if more else ["0.75 N s/m"],
                             "following": ["0.6 N s/m"],
                             "rubbing": ["0.6 N s/m", "1.2 N s/m"] if more else ["0.6 N s/m"]}.items():
            for brake in brakes:
                with self.subTest(name=name, brake=brake):
                    told = refusal(name, brake=brake, status=INPUT_REFUSED)
                    self.assertIn("[not-certified]", told)
                    needs, gives = re.search(
                        r"needs (\S+) N s/m of damping to be passive on device '.*'; only (\S+) is guaranteed",
                        told).groups()
                    self.assertLessEqual(float(gives), float(needs))
                    for kind, words in {"brake": r"a brake of (\S+ N s/m) at the tool",
                                        "share": r"(\S+) times all stiffnesses", "rate": r"a loop at (\S+ Hz) would",
                                        "jitter": r'"jitter": "(\S+ ms)" in',
                                        "estimator": r'would be enough: "velocity": \{ (.*) \} in'}.items():
                        if remedy := re.search(words, told):
                            found.add((name, kind))
                            refusal(name, **({"brake": brake} | {kind: float(remedy.group(1)) if kind == "share"
                                                                 else remedy.group(1)}))
        # Where the brake follows its slip, the slip leaves it the room that the proof needs.
        for brake in ["5 N s/m", "7 N s/m", "7.17 N s/m"]: refusal("following", brake=brake)
        self.assertLessEqual({"brake", "share", "rate"}, {kind for _, kind in found})
        # A brake that would do for the linear one ruins its feel, which the others do not.
        self.assertEqual({name for name, kind in found if kind == "brake"}, {"following", "rubbing"})

    def test_what_is_not_written_by_default_is_written_by_no_other_choice(self):
        """Fails if the default choice, which uses what a brake has to its end, is refused where a choice with less
        damping is certified: the proof needs a little more than the search has asked for."""
        compiled = 0
        stiffnesses = [500, 700, 1000, 1500, 2000, 3000, 4000, 4500, 5000, 5500, 6000, 6500, 7000]
        for device in ["pantograph_brake_2009", "phantom_shorted_motor"]:
            for stiffness in stiffnesses if IS_LONG else stiffnesses[1::2]:
                net = self.write("hard.json", network(f'{{ "spring": {stiffness} }}', "hard"))
                run = ["compile", net, "--device", SOURCE / f"runtime/devices/{device}.json"]
                virtual = self.dashpot(*run, "--decomposition", "virtual", status=None)
                if virtual.returncode == 0:
                    compiled += 1
                    self.assertLessEqual(set(codes(self.dashpot(*run).stderr)), {"felt-error"})
        self.assertGreater(compiled, 10 if IS_LONG else 4)

    def test_what_a_device_file_would_have_to_say(self):
        """Fails if what a note says to write into a device file does not do there: a stronger brake at a joint, more
        damping of the device itself, and a loop that is not late."""
        def compiled(device, net, status=0):
            self.write("device.json", json.dumps(device))
            return self.dashpot("compile", net, "--device", "device.json", status=status).stderr

        hard = self.write("hard.json", network('{ "spring": 9000 }', "hard"))
        arm = json.loads((SOURCE / "runtime/devices/pantograph_brake_2009.json").read_text())
        told = compiled(arm, hard, INPUT_REFUSED)
        arm["brake"]["max_damping"] = re.search(r'"max_damping": "(\S+ N m s/rad)" in "brake"', told).group(1)
        self.assertEqual(compiled(arm, hard), "")

        wall = self.write("wall.json", network('{ "parallel": [ { "spring": 600 }, { "damper": 2 } ] }', "wall",
                                               '"contact": { "at": 0 },'))
        tip = json.loads((SOURCE / "runtime/devices/phantom_shorted_motor.json").read_text())
        told = compiled(tip, wall)
        self.assertIn("[nothing-proved]", told)
        # The delay does not stand in the way.
        self.assertIn('would be enough if its motor\'s amplifier had no lag ("amplifier_lag"): "damping"', told)
        damping = re.search(r'"damping": "(\S+ N s/m)" in "mechanics"', told).group(1)
        del tip["motor"]["amplifier_lag"]
        tip["assumed"].remove("motor.amplifier_lag")
        told = compiled(tip, wall)
        self.assertIn(f'"damping": "{damping}" in "mechanics"', told)
        self.assertNotIn("enough if", told)
        tip["mechanics"]["damping"] = damping
        self.assertEqual(codes(compiled(tip, wall)), ["felt-error"])
        tip["motor"]["amplifier_lag"] = "0.2 ms"
        self.assertIn(
            'note: the device would be good enough if its motor\'s amplifier had no lag ("amplifier_lag"); the felt '
            'error would be up to ',
            compiled(tip, wall))

    def test_a_loop_that_is_not_late_as_a_remedy(self):
        """Fails if a refusal does not say what a loop that is not late would do, in the order of what is felt, or does
        not say that all it has to offer ruins the feel, or offers what does beside what does not."""
        net = self.write("late.json", network('{ "parallel": [ { "spring": 2500 }, { "damper": 4 } ] }', "late"))

        def told(status=0, **loop):
            device = {"dashpot_device": 1, "name": "rig", "motion": "translation", "loop": {"rate": "2 kHz"} | loop,
                      "velocity": {"estimator": "backward_difference", "window": 4}, "motor": {},
                      "brake": {"kind": "eddy_current", "max_damping": "3 N s/m"}, "mechanics": {"inertia": "0.2 kg"}}
            self.write("device.json", json.dumps(device))
            return self.dashpot("compile", net, "--device", "device.json", "--decomposition", "virtual", "-o", "out",
                                status=status).stderr

        refused = told(INPUT_REFUSED, delay_samples=3)
        self.assertIn('the device would be good enough if its loop had no delay ("delay_samples")', refused)
        errors = [float(error) for error in re.findall(r"felt error would be up to (\S+) %", refused)]
        self.assertGreater(len(errors), 1)
        self.assertEqual(errors, sorted(errors))
        self.assertEqual("would ruin the feel" in refused, errors[0] > 50)
        told()

        net = self.write("late.json", network('{ "parallel": [ { "spring": 500 }, { "damper": 4 } ] }', "late"))
        some = told(INPUT_REFUSED, delay_samples=3)  # there are three more, with 57 to 64 %
        errors = [float(error) for error in re.findall(r"felt error would be up to (\S+) %", some)]
        self.assertEqual(errors, [error for error in errors if error <= 50])
        self.assertGreater(len(errors), 0)
        self.assertNotIn("would ruin the feel", some)

    def test_a_faster_loop_as_a_remedy(self):
        """Fails if a rate is not offered where it would do."""
        self.write("stiff.json", network('{ "parallel": [ { "spring": 30000 }, { "damper": 5 } ] }', "stiff"))
        done = self.refused("compile", "stiff.json", "--device", BOARD, code="not-certified")
        self.assertIn("a loop at ", done.stderr)

    def test_less_jitter_as_a_remedy(self):
        """Fails if a jitter is not offered where it would do, or would not do as it is offered."""
        device = json.loads((SOURCE / "runtime/devices/phantom_shorted_motor.json").read_text())
        law = ["compile", SOURCE / "networks/paper/kelvin.json", "--device", "device.json"]
        self.write("device.json", json.dumps(device))
        told = self.refused(*law, code="not-certified").stderr
        device["loop"]["jitter"] = re.search(r'"jitter": "(\S+ ms)" in "loop"', told).group(1)
        self.write("device.json", json.dumps(device))
        self.dashpot(*law)

    def test_what_would_do_for_tunables(self):
        """Fails if a box that its device cannot hold is refused without a brake, a share and a rate that would do, or
        if one of them would not."""
        elements = ('{"spring": "k", "nodes": ["tool", "p"]}, {"damper": "b", "nodes": ["p", "ground"]}, '
                    '{"spring": SCALE, "nodes": ["tool", "ground"]}')
        box = ('{"k": {"value": FIRST, "min": 0, "max": SECOND, "tunable": true}, '
               '"b": {"value": THIRD, "min": 0, "max": FOURTH, "tunable": true}}')

        def written(share):
            text = of_elements(elements, "tuned", f'"parameters": {box},')
            for word, value in [("SCALE", 3000), ("FIRST", 2000), ("SECOND", 90000), ("THIRD", 20), ("FOURTH", 60)]:
                text = text.replace(word, repr(value * share))
            self.write("tuned.json", text)

        punctual = json.loads(BOARD.read_text())
        punctual["loop"].update(jitter="0 s", delay_samples=0)
        self.write("punctual.json", json.dumps(punctual))
        written(1)
        done = self.refused("compile", "tuned.json", "--device", "punctual.json", code="not-certified").stderr
        brake, unit = re.search(r"a brake of ([0-9.e+]+) (N s/m) at the tool", done).groups()
        share, rate = [float(re.search(words, done).group(1))
                       for words in (r"([0-9.e-]+) times all stiffnesses", r"a loop at ([0-9.e+]+) Hz")]
        told = json.loads(json.dumps(punctual))
        told["brake"]["max_damping"] = f"{float(brake) * 1.001} {unit}"
        self.write("stronger.json", json.dumps(told))
        self.dashpot("compile", "tuned.json", "--device", "stronger.json")
        told = json.loads(json.dumps(punctual))
        told["loop"]["rate"] = f"{rate} Hz"
        self.write("faster.json", json.dumps(told))
        self.dashpot("compile", "tuned.json", "--device", "faster.json")
        written(share * 0.99)
        self.dashpot("compile", "tuned.json", "--device", "punctual.json")

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
        self.dashpot("compile", FIG_5, "--device", BOARD, "--decomposition", "paper", "--certificate", "c.json")
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
