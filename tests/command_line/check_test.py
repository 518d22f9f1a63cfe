"""`dashpot-check`: what it accepts, and that it accepts nothing false."""
import cmath
import json
import math
import os
import random
import re
import subprocess
import unittest

from dashpot_command import FIG_5, INPUT_REFUSED, PANTOGRAPH, SOURCE, CommandTest, network

CHECK = os.environ["DASHPOT_CHECK"]
PAPER = SOURCE / "networks/paper"
TWENTY = SOURCE / "tests/responses/networks/twenty_branches.json"
SEED = 20090911
LONG = os.environ.get("DASHPOT_LONG") == "1"

# Straight and rolled, position and velocity driven, nodal, in single precision by every scheme of the states, on a
# device with delay, lag, filter and a motor's limit, and by the hold certificate.
LAWS = [[FIG_5], [PAPER / "bridge.json", "--rate", "3000"], [FIG_5, "--state-input", "velocity"],
        [FIG_5, "--scalar", "float"], [FIG_5, "--scalar", "float", "--rate", "100000"],
        [PAPER / "generalised_kelvin_two.json", "--scheme", "backward-euler", "--state-input", "nodal"],
        [PAPER / "kelvin.json"], [FIG_5, "--decomposition", "virtual", "--state-input", "velocity"],
        [PAPER / "maxwell_damper_at_tool.json", "--state-input", "velocity"],
        [TWENTY], [TWENTY, "--vector", "avx512"], [TWENTY, "--scalar", "float"],
        [TWENTY, "--scalar", "float", "--rate", "100000"], [FIG_5, "--device", PANTOGRAPH],
        [TWENTY, "--device", PANTOGRAPH, "--state-input", "velocity"],
        [FIG_5, "--device", SOURCE / "runtime/devices/phantom_single_motor.json"]]
GENERATED = SOURCE / "generated"
# The options, other than the defaults, with which the headers of a folder in generated/ are made.
FORMS = {"forms/backward_euler": ["--scheme", "backward-euler"],
         "forms/nodal": ["--scheme", "backward-euler", "--state-input", "nodal"],
         "forms/velocity": ["--state-input", "velocity"], "forms/float_delta": ["--scalar", "float"],
         "forms/float_compensated": ["--scalar", "float", "--rate", "100000"],
         "forms/rolled_avx512": ["--vector", "avx512"],
         "forms/constant_time": ["--constant-time"]}

# Edits of the code around the constants, each of which makes another law of it or one that is not known.
CODE = [("position_change = position - last_position_", "position_change = position + last_position_"),
        ("last_position_ = sampled_position_;", "last_position_ = sampled_position_change_;"),
        ("return {damping, force};", "return {damping, force + force};"),
        ("using scalar = double", "using scalar = int"),
        ("return {damping, force};", ""), ("scalar position, scalar velocity", "scalar velocity, scalar position"),
        ("unsigned set(const parameters&) noexcept { return 0; }",
         "unsigned set(const parameters&) noexcept { relaxed_force_ = 1; return 0; }"),
        ("#pragma once", "#pragma once\n#define position velocity"), ("#pragma once", "#pragma once /* */"),
        ("  void update() noexcept {", "  void update() noexcept {\n    B2_K2_force_ = 3;"),
        ("    relaxed_force_ = 0;", "    relaxed_force_ = 7;"),
        ("scalar relaxed_force_ = 0;", "scalar relaxed_force_ = 2;"),
        ("scalar last_position_ = 0;", "scalar last_position_ = 0; static inline int more = 0;"),
        ("scalar static_stiffness = 5.0;", "scalar static_stiffness = 050.0;"),
        ("scalar static_stiffness = 5.0;", "scalar static_stiffness = 5.0f;"),
        ("B2_K2_decay, B2_K2_force_,", "B1_K1_decay, B2_K2_force_,"),
        ('device = "ideal";', 'device = "//"; static inline int more = 0;'),
        ('device = "ideal";', 'device = R"(\n//)"; static inline int more = 0;\n"";'),
        # What hides an argument, lasts for one call alone, drops a fraction, or returns, stops or assigns where a guard
        # would stand.
        ("  scalar last_position_ = 0;", "  scalar last_position_ = 0;\n  scalar velocity = 0;"),
        ("    const scalar position_change =", "    scalar more = 0;\n    const scalar position_change ="),
        ("    const scalar position_change =",
         "    static constexpr bool velocity_gain = true;\n    const scalar position_change ="),
        ("    const scalar position_change =", "    using scalar = int;\n    const scalar position_change ="),
        ("    const scalar position_change =", "    using vector = int;\n    const scalar position_change ="),
        ("static constexpr scalar velocity_gain", "static constexpr unsigned velocity_gain"),
        ("  scalar last_position_ = 0;", "  unsigned last_position_ = 0;"),
        ("    return {damping, force};", "    return {damping, force + force};\n    return {damping, force};"),
        ("    sampled_ = true;\n", ""), ("    if (!sampled_) return;\n    sampled_ = false;",
                                         "    sampled_ = false;\n    if (!sampled_) return;"),
        ("all_finite(force)", "all_finite(force) || (true)"), ("all_finite(force)", "all_finite(relaxed_force_ = 7)")]
# A name that means another thing in a loop than after it, where `kept` is what it says before.
SHADOWED = [("    const vector sampled_position_change =",
             "    const scalar kept = KEPT;\n    const vector sampled_position_change ="),
            ("        vector::put(mode_force_, j, vector::at(mode_gain",
             "        const vector kept = 1;\n        vector::put(mode_force_, j, vector::at(mode_gain"),
            ("last_position_ = sampled_position_;", "last_position_ = sampled_position_ * kept;")]
# Edits of a certificate, each of which makes a false statement of it, or a proof of none.
FALSE = {"less is needed": lambda c: c["passivity"].update(needed_damping=c["passivity"]["needed_damping"] *
                                                           (1 - 1e-7)),
         "the hold certificate": lambda c: c["passivity"].update(proof="hold"),
         "more is assured": lambda c: c["passivity"].update(assured_damping=c["passivity"]["assured_damping"] *
                                                            (1 + 1e-9)),
         "no storage function": lambda c: c.update(storage=None),
         "a shorter period": lambda c: c["loop"].update(sample_period=0.0009),
         "jitter": lambda c: c["loop"].update(jitter=1e-6), "a lag": lambda c: c["loop"].update(amplifier_lag=1e-5),
         "a late command": lambda c: c["loop"].update(write_latest=1e-6),
         "a delay": lambda c: c["loop"].update(delay_samples=1),
         "a cut delay": lambda c: c["loop"].update(delay_samples=c["loop"]["delay_samples"] + 0.5),
         "a wrapped delay": lambda c: c["loop"].update(delay_samples=c["loop"]["delay_samples"] + 2**32),
         "a filter": lambda c: c["loop"].update(estimator="kalman"),
         "another rate": lambda c: c["loop"].update(estimator_coefficients=[999.9]),
         "a row less": lambda c: c["storage"]["matrix"].pop(),
         "a short row": lambda c: c["storage"]["matrix"][-1].pop(),
         "a negative P": lambda c: c["storage"]["matrix"][0].__setitem__(0, -1e9)}


NUMBER = r"-?\d[\d.]*(?:e[-+]?\d+)?"
# Of a straight law, a rolled one, one that follows the estimate, one of springs and dampers alone, and one on a device
# with a filter, delay, lag and jitter.
EDITED = [[FIG_5], [TWENTY], [FIG_5, "--state-input", "velocity"], [PAPER / "kelvin.json"],
          [FIG_5, "--device", PANTOGRAPH]]


def estimate(loop, w, change):
    """E(z) of the velocity estimate: the difference of two samples, or Butterworth's sections of it."""
    difference = change / loop["sample_period"]
    if loop["estimator"] == "difference of two samples": return difference
    g = math.tan(math.pi * loop["cutoff"] * loop["sample_period"])
    for i in range(loop["order"] // 2):
        k = 2 * math.sin(math.pi * (loop["order"] - 1 - 2 * i) / (2 * loop["order"]))
        up, down = (1 + w) * g, change
        difference *= up ** 2 / (up ** 2 + k * up * down + down ** 2)
    return difference


def needs_at_least(header, loop):
    """Colgate & Schenkel's S(θ) at its largest on a grid, for holds of the sample period; with a lag as theory 6b has
    it."""
    constants = {}
    for name, several, values in re.findall(r"constexpr \w+ (\w+)(\[\d+\])? = \{?([^;{}]*)\}?;", header):
        constants[name] = [float(value) for value in re.findall(NUMBER, values)] if several or "." in values else []
    first = {name: values[0] for name, values in constants.items() if values}
    modes = []
    for name in constants:
        mode, _, kind = name.rpartition("_")
        if kind not in ("decay", "loss"): continue
        others = [constants.get(f"{mode}_{drive}") or [0] * len(constants[name])
                  for drive in ("gain", "velocity_drive")]
        modes += [(value if kind == "decay" else 1 - value, *drives)
                  for value, *drives in zip(constants[name], *others)]
    period, lag, most = loop["sample_period"], loop["amplifier_lag"], 0
    for i in range(1, 2001):
        angle = math.pi * (i / 2000) ** 3
        w = -1 if i == 2000 else cmath.exp(-1j * angle)
        # 1 - w, with all its digits
        change = complex(2 * math.sin(angle / 2) ** 2, 0 if i == 2000 else math.sin(angle))
        of_position, of_velocity = first.get("step_stiffness", 0), first.get("velocity_gain", 0)
        for decay, gain, drive in modes:
            of_position += gain * w / (1 - decay * w)
            of_velocity += drive * w / (1 - decay * w)
        H = first.get("static_stiffness", 0) + change * of_position + estimate(loop, w, change) * of_velocity
        H *= w ** loop["delay_samples"]
        needed = period * (change * H).real / abs(change) ** 2
        if lag:
            q = math.exp(-period / lag)
            p = (1 - q) * lag / period
            needed += p * period * (w * H / (1 - q * w)).real
            spread = p * ((1 + q) / 2 - p) * period ** 2 * abs(H / (1 - q * w)) ** 2
            needed = (needed + math.sqrt(needed ** 2 + spread)) / 2
        most = max(most, needed)
    return most


def falsehood(header, certificate):
    """What the certificate says falsely of the header, to the 1e-12 that these doubles tell apart; empty if nothing."""
    off = 1e-12
    loop, said = certificate["loop"], certificate["passivity"]
    told = {name: float(value) for name, value in re.findall(rf"constexpr \w+ (\w+) = ({NUMBER});", header)}
    if told["sample_period"] != loop["sample_period"] or told["loop_delay"] != loop["delay_samples"]:
        return "another loop"
    if said["needed_damping"] < needs_at_least(header, loop) * (1 - off): return "less is needed than S says"
    share = 1 / (1 + (loop["largest_speed"] / loop["critical_speed"]) ** 2) if loop["critical_speed"] else 1
    assured = share * ((1 - loop["brake_tolerance"]) * told["damping"] +
                       loop["residual_damping"]) + loop["device_damping"]
    if said["certified"] and assured < said["needed_damping"] * (1 - off): return "it is not there"
    return "more is assured" if said["assured_damping"] > assured * (1 + 2 * off) else ""


def numbers_of(value, path=()):
    """Where the numbers of a certificate are that are not zero, and its claims that are true or false."""
    for key, inner in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        if isinstance(inner, (dict, list)): yield from numbers_of(inner, (*path, key))
        elif isinstance(inner, (int, float)) and (inner or inner is False): yield (*path, key)


def edited_number(chance, value):
    """Another one: the next, one that is off by up to itself, or one more or less; of a claim the contrary."""
    if isinstance(value, bool): return not value
    if isinstance(value, int): return value + chance.choice((-1, 1))
    if chance.random() < 0.4: return math.nextafter(value, chance.choice((-1, 1)) * math.inf)
    return value * (1 + chance.choice((-1, 1)) * 10 ** chance.uniform(-12, 0))


class CheckTest(CommandTest):
    def compiled(self, arguments):
        self.dashpot("compile", *arguments, "--certificate", "law.json", "--uncertified", "--no-advice")
        header = next(self.folder.glob("*.hpp"))
        text = header.read_text()
        header.unlink()
        return text, json.loads((self.folder / "law.json").read_text())

    def said(self, header, certificate):
        files = [self.write("checked/law.hpp", header), self.write("checked/law.json", json.dumps(certificate))]
        done = subprocess.run([CHECK, *files], capture_output=True, text=True, timeout=60)
        begins = {0: "^proved: with a damping of ", 4: "^proved: with a damping of ", 1: "^not proved: ",
                  3: "^not proved here: "}
        self.assertIn(done.returncode, begins, done.stderr)
        self.assertRegex(done.stdout, begins[done.returncode])
        self.status = done.returncode
        return done.returncode in (0, 4), done.stdout

    def accepts(self, header, certificate):
        return self.said(header, certificate)[0]

    # If this failed, a law of a form that the compiler writes would not be proved by the program that shares nothing
    # with it.
    def test_every_form(self):
        for law in LAWS:
            with self.subTest(law=law):
                accepted, words = self.said(*self.compiled(law))
                self.assertTrue(accepted, words)

    # If this failed, a committed header of a linear law would be refused, or another be proved.
    def test_committed_headers(self):
        fig_5, told = self.compiled([FIG_5])[1], {0: 0, 3: 0, 4: 0}
        for committed in sorted(GENERATED.rglob("*.hpp")):
            folder, stem = committed.parent.relative_to(GENERATED).as_posix(), committed.stem
            with self.subTest(header=f"{folder}/{stem}"):
                if folder == "axes" or stem.endswith("_batch"):  # which have no certificate
                    is_linear, certificate = False, fig_5
                else:
                    network = next(path for path in (SOURCE / "networks" / folder / f"{stem}.json",
                                                     PAPER / f"{stem}.json",
                                                     SOURCE / "networks/tunable" / f"{stem}.json",
                                                     TWENTY.with_stem(stem)) if path.exists())
                    header, certificate = self.compiled([network, *FORMS.get(folder, [])])
                    self.assertEqual(header, committed.read_text())
                    is_linear = not (certificate["passivity"]["any_regime"] or certificate["passivity"]["any_value"]
                                     or '"static"' in network.read_text())
                _, words = self.said(committed.read_text(), certificate)
                self.assertIn(self.status, (0, 4) if is_linear else (3,), words)
                told[self.status] += 1
        said = f"The {told[0] + told[4]} with linear laws are proved, of the other {told[3]} nothing"
        self.assertIn(said, re.sub(r"\s+", " ", (GENERATED / "README.md").read_text()))

    # If this failed, the README would claim fewer lines than have to be trusted, or the checker would include something
    # of the compiler.
    def test_size_and_independence(self):
        files = sorted((SOURCE / "compiler/check").iterdir())
        lines = [line.strip() for file in files for line in file.read_text().splitlines()]
        code = [line for line in lines if line and not line.startswith("//")]
        self.assertIn(f"{len(lines)} lines in `compiler/check/`, {len(code)} without remarks and blank lines,",
                      (SOURCE / "README.md").read_text())
        for file in files:
            included = re.findall(r'(?m)^#include ["<](\S+)[">]', file.read_text())
            self.assertTrue(all(name == "check.hpp" or name.startswith(("boost/multiprecision/", "nlohmann/"))
                                or "." not in name
                                for name in included), (file, included))

    # If this failed, a text that is no header or no certificate would be proved, or a file that is not there.
    def test_other_files(self):
        header, certificate = self.compiled([FIG_5])
        for text in ("", "int main() {}", header[:len(header) // 2], header + header):
            self.assertFalse(self.accepts(text, certificate))
        for other in ({}, [], None, {"passivity": {}, "storage": {}, "loop": {}}):
            self.assertFalse(self.accepts(header, other))
        for files in ([], ["a", "b", "c"], ["missing.hpp", "missing.json"]):
            self.assertEqual(subprocess.run([CHECK, *files], capture_output=True, cwd=self.folder).returncode, 2)

    # If this failed, less damping than suffices would be called proved, or another loop, or code that does something
    # else.
    def test_false_statements(self):
        header, certificate = self.compiled([FIG_5])
        self.assertTrue(self.accepts(header, certificate))
        for what, edit in FALSE.items():
            edited = json.loads(json.dumps(certificate))
            edit(edited)
            self.assertFalse(self.accepts(header, edited), what)
        for old, new in CODE:
            self.assertIn(old, header)
            self.assertFalse(self.accepts(header.replace(old, new, 1), certificate), new)

    # If this failed, a name that a loop declares would be taken for what has that name after the loop.
    def test_scopes(self):
        header, certificate = self.compiled([TWENTY])
        for kept in "10":
            edited = header
            for old, new in SHADOWED:
                self.assertIn(old, edited)
                edited = edited.replace(old, new.replace("KEPT", kept), 1)
            self.assertEqual(self.accepts(edited, certificate), kept == "1")

    def adaptive_device(self, **edits):
        device = json.loads(PANTOGRAPH.read_text())
        device["velocity"] = {"estimator": "foaw", **edits}
        del device["motor"]["amplifier_lag"]
        device["assumed"].remove("motor.amplifier_lag")
        return self.write("adaptive.json", json.dumps(device))

    # If this failed, a motor that follows an adaptive window would be refused, or pay for it as much as without a
    # storage function; or be proved by one of the windows alone, or by those of another fit.
    def test_adaptive_window(self):
        for fit, window, most in (("end", 10, 1.4), ("best", 10, 1.35), ("end", 20, 1.9)):
            device = self.adaptive_device(fit=fit, window=window)
            for decomposition in ("zero-frequency", "faithful"):
                header, certificate = self.compiled([FIG_5, "--device", device, "--decomposition", decomposition])
                accepted, words = self.said(header, certificate)
                self.assertTrue(accepted, words)
                self.assertRegex(words, "for holds of any lengths up to 0.00015")
                gain, needed = certificate["constants"]["velocity_gain"][0], certificate["passivity"]["needed_damping"]
                constants = certificate["constants"]
                spring = constants["static_stiffness"][0] + 2 * constants["step_stiffness"][0]
                self.assertLess(needed, 1.5 * (most * abs(gain) + 3 * spring * 0.0001 / 2))
                edits = {"less": lambda c: c["passivity"].update(needed_damping=needed * 0.97),
                         "longer": lambda c: c["loop"].update(window=window + 1),
                         "later": lambda c: c["loop"].update(delay_samples=2),
                         "fit": lambda c: c["loop"].update(best_fit=fit == "end"),
                         "hold": lambda c: c["passivity"].update(proof="hold"),
                         "lag": lambda c: c["loop"].update(amplifier_lag=1e-6),
                         "one": lambda c: c["loop"]["estimator_coefficients"].pop(),
                         "other": lambda c: c["loop"]["estimator_coefficients"].reverse(),
                         "none": lambda c: c.update(storage=None)}
                for what, edit in edits.items():
                    edited = json.loads(json.dumps(certificate))
                    edit(edited)
                    self.assertFalse(self.accepts(header, edited), what)
                more = re.sub(r"(velocity_gain = -?)(\d)", r"\g<1>1\2", header)
                self.assertNotEqual(more, header)
                self.assertFalse(self.accepts(more, certificate))
                for edited in (more, header):
                    files = self.write("law.json", json.dumps(certificate)), self.write("law.hpp", edited)
                    self.dashpot("verify", "--allow-uncertified", *files, status=0 if edited == header
                                 else INPUT_REFUSED)

    # If this failed, a motor that follows a velocity over measured intervals would be refused, or be proved for other
    # intervals, for an estimate over the nominal period, later, or with less.
    def test_measured_interval(self):
        device = json.loads(PANTOGRAPH.read_text())
        device["velocity"] = {"estimator": "interval_difference"}
        with self.subTest("an amplifier that lags"): self.check_measured_interval(device)
        del device["motor"]["amplifier_lag"]
        device["assumed"].remove("motor.amplifier_lag")
        with self.subTest("no lag"): self.check_measured_interval(device)

    def check_measured_interval(self, device):
        law = [FIG_5, "--device", self.write("measured.json", json.dumps(device)), "--decomposition", "zero-frequency"]
        header, certificate = self.compiled(law)
        accepted, words = self.said(header, certificate)
        self.assertTrue(accepted, words)
        self.assertRegex(words, "for holds of any lengths up to 0.00015")
        self.assertNotEqual(certificate["constants"]["velocity_gain"][0], 0)
        needed = certificate["passivity"]["needed_damping"]
        edits = {"less": lambda c: c["passivity"].update(needed_damping=needed * 0.98),
                 "jitter": lambda c: c["loop"].update(jitter=6e-5),
                 "all": lambda c: c["loop"].update(jitter=1e-4), "later": lambda c: c["loop"].update(delay_samples=2),
                 "nominal": lambda c: c["loop"].update(estimator="backward_difference", window=1,
                                                       estimator_coefficients=[1e4]),
                 "none": lambda c: c.update(storage=None)}
        for what, edit in edits.items():
            edited = json.loads(json.dumps(certificate))
            edit(edited)
            self.assertFalse(self.accepts(header, edited), what)
        files = self.write("law.json", json.dumps(certificate)), self.write("law.hpp", header)
        self.dashpot("verify", "--allow-uncertified", *files)
        self.refused("compile", *law, "--state-input", "velocity", code="velocity-input-drifts")

    # If this failed, commands that act later than their samples would be refused, or be proved for earlier ones, for
    # fewer of them, or with less; behind a lag, under jitter and counted sample by sample too.
    def test_late_commands(self):
        prompt = json.loads(PANTOGRAPH.read_text())
        del prompt["motor"]["amplifier_lag"]
        prompt["assumed"].remove("motor.amplifier_lag")
        spring = self.write("spring.json",
                            '{"dashpot": 1, "name": "spring", "network": {"spring": "40 N/m", "name": "K"}}')
        cases = ((FIG_5, json.loads(PANTOGRAPH.read_text()), 0), (FIG_5, prompt, 0), (FIG_5, prompt, 1),
                 (spring, prompt, 0), (spring, prompt, 1))
        punctual = []
        for always in ("20 us", ["20 us", "20 us"]):  # may be said in both ways
            prompt["loop"].update(write_delay=always)
            punctual.append(self.compiled([spring, "--device",
                                           self.write("late.json", json.dumps(prompt))])[1]["passivity"])
        self.assertEqual(*punctual)
        for network, device, delays in cases:
            device["loop"].update(write_delay=["10 us", "30 us"], delay_samples=delays)
            with self.subTest(network=network, lag="amplifier_lag" in device["motor"], delays=delays):
                law = [network, "--device", self.write("late.json", json.dumps(device)), "--decomposition",
                       "zero-frequency"]
                header, certificate = self.compiled(law)
                accepted, words = self.said(header, certificate)
                self.assertTrue(accepted, words)
                self.assertRegex(words, "for holds of any lengths up to 0.00017")
                needed = certificate["passivity"]["needed_damping"]
                by_hold = certificate["passivity"]["proof"] == "hold"
                self.assertEqual(by_hold, network == spring)
                edits = {"less": lambda c: c["passivity"].update(needed_damping=needed * 0.97),
                         "later": lambda c: c["loop"].update(write_latest=3.2e-5),
                         "overtaken": lambda c: c["loop"].update(write_latest=6e-5),
                         "delayed": lambda c: c["loop"].update(delay_samples=2),
                         "sooner": lambda c: c["loop"].update(write_earliest=0),
                         "backward": lambda c: c["loop"].update(write_earliest=4e-5)}
                if not by_hold: edits["none"] = lambda c: c.update(storage=None)
                for what, edit in edits.items():
                    edited = json.loads(json.dumps(certificate))
                    edit(edited)
                    self.assertFalse(self.accepts(header, edited), what)
                files = self.write("law.json", json.dumps(certificate)), self.write("law.hpp", header)
                self.dashpot("verify", "--allow-uncertified", *files)

    # If this failed, a user who asks about a law behind a static curve would be shown a piece of code instead of a
    # reason.
    def test_static_curve(self):
        net = self.write("curve.json", network('{ "parallel": [ { "spring": 400 }, { "damper": 2 } ] }', "curve",
                                               '"static": { "power": 1.5, "force": "2 N", "at": "10 mm" }, "valid": { '
                                               '"displacement": "10 mm" },'))
        words = self.said(*self.compiled([net, "--device", PANTOGRAPH]))[1]
        self.assertEqual(self.status, 3)
        self.assertIn("curves", words)

    # If this failed, a user who asks about a law of two axes would be shown a library's message about a missing key.
    def test_two_axes(self):
        words = self.said(*self.compiled([SOURCE / "networks/axes/kelvin_field.json", "--device",
                                          SOURCE / "runtime/devices/pantograph_2dof.json"]))[1]
        self.assertEqual(self.status, 3)
        self.assertIn("two axes", words)

    # If this failed, a law that lacks damping on its device would pass for one that has it.
    def test_lacking_damping(self):
        header, certificate = self.compiled([FIG_5, "--device", SOURCE / "runtime/devices/phantom_single_motor.json"])
        self.assertIn("not proved: that as much damping is there", self.said(header, certificate)[1])
        self.assertEqual(self.status, 4)
        certificate["passivity"]["certified"] = True
        self.assertFalse(self.accepts(header, certificate))
        self.assertEqual(self.status, 1)
        certificate["passivity"].update(certified=False,
                                        minimum_damping=certificate["passivity"]["minimum_damping"] * 0.999)
        self.assertFalse(self.accepts(header, certificate))

    def verifies(self, header, certificate):
        files = [self.write("checked/law.hpp", header), self.write("checked/law.json", json.dumps(certificate))]
        return self.dashpot("verify", "--allow-uncertified", *files, status=None).returncode == 0

    # If this failed, after an edit of a number in a header or a certificate, by an ulp or by a lot, a false statement
    # would be accepted, or `verify` would let an edit pass that changes more than the last digits of a number that
    # rests on searches.
    def test_edited_numbers(self):
        chance = random.Random(SEED)
        cases = [self.compiled(law) for law in EDITED]
        accepted = refused = 0
        for i in range(1000 if LONG else 35):
            header, certificate = cases[i % len(cases)]
            stated, is_slight = json.loads(json.dumps(certificate)), False
            if chance.random() < 0.5:
                begin, end = chance.choice(list(re.finditer(r"constexpr (?:scalar|unsigned) [^=]* = ([^;]*);",
                                                            header))).span(1)
                place = chance.choice(list(re.finditer(NUMBER, header[begin:end])))
                value = json.loads(place[0])
                where = begin + place.start(), repr(edited_number(chance, value) or 1.0)
                header = header[:where[0]] + where[1] + header[begin + place.end():]
            else:
                among = list(numbers_of(stated if chance.random() < 0.5
                                        else {key: stated[key] for key in ("passivity", "loop")}))
                where = chance.choice(among)
                inner = stated
                for key in where[:-1]: inner = inner[key]
                before, inner[where[-1]] = inner[where[-1]], edited_number(chance, inner[where[-1]])
                is_slight = where[0] != "storage" and abs(inner[where[-1]] - before) <= 1e-9 * abs(before)
            if self.accepts(header, stated):
                accepted += 1
                self.assertEqual(falsehood(header, stated), "", (SEED, i, where))
            else:
                refused += 1
            self.assertTrue(is_slight or not self.verifies(header, stated), (SEED, i, where))
        self.assertGreater(accepted, 0)
        self.assertGreater(refused, 0)


if __name__ == "__main__":
    unittest.main()
