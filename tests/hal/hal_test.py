"""Runs emitted components in LinuxCNC's HAL as a normal user, on threads of this machine, without its real time.

The environment names DASHPOT (the executable), DASHPOT_SOURCE (this repository) and CC.
"""
import json
import os
import pathlib
import re
import struct
import tempfile
import unittest

from session import Session, told

DASHPOT, CC = os.environ["DASHPOT"], os.environ["CC"]
SOURCE = pathlib.Path(os.environ["DASHPOT_SOURCE"])
ROWS = 3000

# Networks, options, and what they are called here, where nothing else is called so.
RIG = SOURCE / "examples/linuxcnc"
LAWS = [("paper/second_order_maxwell", [], "dp_test_maxwell"),
        ("paper/second_order_maxwell", ["--scalar", "float"], "dp_test_float"),
        ("paper/visco_elasto_plastic", [], "dp_test_slips"),
        ("tunable/standard_solid_tunable", [], "dp_test_tunable")]
LAWS += [(f"paper/{path.stem}", [], f"dp_test_paper_{i}")
         for i, path in enumerate(sorted((SOURCE / "networks/paper").glob("*.json")))]
AT_ONCE = 8  # as many as one sampler has pins for
BRAKE = "dp_test_brake"


def as_float(number):
    return struct.unpack("f", struct.pack("f", number))[0]


class Hal(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        (cls.folder / f"{BRAKE}.comp").write_text(
            (RIG / "brake_current.comp").read_text().replace("brake_current", BRAKE))
        told("halcompile", "--compile", f"{BRAKE}.comp", cwd=cls.folder)
        for network, options, name in LAWS:
            told(DASHPOT, "compile", SOURCE / f"networks/{network}.json", "--name", name, "--target", "hal", *options,
                 cwd=cls.folder)
            told("halcompile", "--compile", f"{name}.comp", cwd=cls.folder)
        cls.hal = Session(cls.folder, CC, [BRAKE] + [name for _, _, name in LAWS])
        cls.addClassCleanup(cls.hal.close)

    def run_hal(self, lines):
        return self.hal.run(lines)

    def simulated(self, network, options, motion):
        told(DASHPOT, "simulate", SOURCE / f"networks/{network}.json", "--input", motion, "-o", "simulated.csv",
             *options, cwd=self.folder)
        text = (self.folder / "simulated.csv").read_text()
        header, *rows = [line.split(",") for line in text.splitlines()]
        damping, force = header.index("damping"), header.index("motor_force")
        return [(float(row[damping]), float(row[force])) for row in rows]

    def test_same_bits_as_simulate(self):
        """Fails if one of 3000 consecutive samples of siggen, ddt and the laws on one thread differs from `simulate` in
        a bit."""
        for first in range(0, len(LAWS), AT_ONCE):
            self.expect_same_bits(LAWS[first:first + AT_ONCE])

    def expect_same_bits(self, laws):
        pin_count = 3 + 2 * len(laws)  # position, velocity, a parameter, and the commands
        lines = ["loadrt threads name1=servo period1=1000000", "loadrt siggen num_chan=2", "loadrt ddt",
                 f"loadrt sampler depth=8000 cfg={'f' * pin_count}",
                 "net u siggen.0.sine => ddt.0.in sampler.0.pin.0", "net v ddt.0.out => sampler.0.pin.1",
                 "net k siggen.1.sine => sampler.0.pin.2", "setp siggen.1.offset 400", "setp siggen.1.amplitude 300",
                 "setp siggen.1.frequency 0.9",
                 "addf siggen.0.update servo", "addf siggen.1.update servo", "addf ddt.0 servo"]
        for i, (_, _, name) in enumerate(laws):
            pins = name.replace("_", "-") + ".0"
            lines += [f"loadrt {name}", f"net u => {pins}.position", f"net v => {pins}.velocity",
                      f"net b{i} {pins}.damping => sampler.0.pin.{3 + 2 * i}",
                      f"net f{i} {pins}.force => sampler.0.pin.{4 + 2 * i}",
                      f"addf {pins}.output servo", f"setp {pins}.enable 1"]
            if name.endswith("tunable"):
                lines.append(f"net k => {pins}.K1")
            if i != 1:  # the other leaves to output() what it would do
                lines.append(f"addf {pins}.update servo")
        lines += ["addf sampler.0 servo", "setp siggen.0.amplitude 0", "setp siggen.0.frequency 1.7", "start",
                  "loadusr -w sleep 0.25",
                  "setp siggen.0.amplitude 0.004", f"loadusr -w ./read_samples samples.txt {ROWS} {'f' * pin_count}"]
        self.run_hal(lines)
        rows = [line.split() for line in (self.folder / "samples.txt").read_text().splitlines()]
        numbers = [int(row[0]) for row in rows]
        self.assertEqual(numbers, list(range(numbers[0], numbers[0] + ROWS)))
        samples = [[float.fromhex(word) for word in row[1:]] for row in rows]
        self.assertGreater(max(row[0] for row in samples), 0.0039)
        self.assertGreater(max(row[1] for row in samples), 0.04)
        self.assertGreater(max(row[2] for row in samples), 690)
        (self.folder / "motion.csv").write_text(
            "time,position,velocity,K1\n" + "".join(f"{k / 1000!r},{row[0]!r},{row[1]!r},{row[2]!r}\n"
                                                    for k, row in enumerate(samples)))
        for i, (network, options, name) in enumerate(laws):
            narrowed = as_float if "float" in options else float
            expected = [tuple(map(narrowed, row)) for row in self.simulated(network, options, "motion.csv")]
            found = [tuple(row[3 + 2 * i:5 + 2 * i]) for row in samples]
            self.assertEqual(sum(a == b for a, b in zip(found, expected, strict=True)), ROWS, name)
            self.assertGreater(max(abs(force) + damping for damping, force in found), 0.01)

    def outputs(self, name, *pins):
        return [f"getp {name.replace('_', '-')}.0.{pin}" for pin in pins]

    def values(self, told):
        """What getp has printed: bits as they are, numbers as numbers."""
        found = []
        for line in told.splitlines():
            if line in ("TRUE", "FALSE"):
                found.append(line)
            elif re.fullmatch(r"0x[0-9A-Fa-f]+", line):
                found.append(int(line, 16))
            elif re.fullmatch(r"-?[0-9.]+(e[-+]?[0-9]+)?|-?inf|-?nan", line):
                found.append(float(line))
        return found

    def test_faults(self):
        """Fails if a thread of another period, NaN or infinity moves the motor, or a fault goes while enable holds."""
        name = LAWS[0][2]
        pins = name.replace("_", "-") + ".0"
        watched = ("fault", "fault-code", "force", "damping")
        for period, position, code in [(500000, "0.001", 1), (1000000, "nan", 2), (1000000, "0.001", 0)]:
            out = self.run_hal(
                [f"loadrt threads name1=servo period1={period}", f"loadrt {name}", f"addf {pins}.output servo",
                 f"addf {pins}.update servo",
                 f"setp {pins}.safe-damping 3", f"setp {pins}.position {position}", "start", "loadusr -w sleep 0.25",
                 *self.outputs(name, *watched),
                 f"setp {pins}.enable 1", "loadusr -w sleep 0.25", *self.outputs(name, *watched),
                 f"setp {pins}.position 0.002", "loadusr -w sleep 0.25", *self.outputs(name, "fault-code"),
                 f"setp {pins}.enable 0", "loadusr -w sleep 0.25", *self.outputs(name, *watched)])
            words = self.values(out)
            safe = ["FALSE", 0, 0, 3]
            self.assertEqual(words[:4], safe, out)
            if code:
                self.assertEqual(words[4:9], ["TRUE", code, 0, 3, code], out)
                self.assertIn({1: f"period is {period} ns; the law is one for 1000000 ns",
                               2: "is no finite number"}[code], out)
            else:
                self.assertEqual(words[4:6] + [words[7]], ["FALSE", 0, 11], out)
                self.assertGreater(words[6], 0.001)
            self.assertEqual(words[-4:], safe, out)

    def test_begins_at_rest_where_the_tool_is(self):
        """Fails if what the law felt before, or a position that was NaN while `enable` was false, is felt as a kick
        when `enable` becomes true."""
        name = LAWS[0][2]
        pins = name.replace("_", "-") + ".0"
        def sampled(position, enable):
            """Both at once for the next sample, and time for some hundred more."""
            return ["stop", f"setp {pins}.position {position}", f"setp {pins}.enable {enable}", "start",
                    "loadusr -w sleep 0.25"]
        watched = self.outputs(name, "fault-code", "force")
        out = self.run_hal(
            ["loadrt threads name1=servo period1=1000000", f"loadrt {name}", f"addf {pins}.output servo",
             f"addf {pins}.update servo", *sampled(0, 1), *sampled("nan", 1), *watched, *sampled("nan", 0),
             *sampled(0.02, 1), *watched, *sampled(0.02, 0), *sampled("nan", 1), *watched, *sampled("nan", 0),
             *sampled(0.04, 0), *sampled(0.06, 1), *watched])
        static_stiffness = 5  # N/m, of the spring that is in parallel with all others
        self.assertEqual(self.values(out),
                         [2, 0, 0, 0.02 * static_stiffness, 2, 0, 0, 0.06 * static_stiffness], out)

    def test_the_example(self):
        """Fails if the rig of examples/linuxcnc does not start, its tool rests, or its currents are not those of force
        and damping."""
        rig = (RIG / "rig.hal").read_text()
        for old, new in [("second_order_maxwell", LAWS[0][2]), ("brake_current", BRAKE)]:
            self.assertIn(f"loadrt {old}", rig)
            rig = rig.replace(old, new).replace(old.replace("_", "-"), new.replace("_", "-"))
        watched = ["gets tool-position", "gets wanted-force", "gets motor-current", "gets wanted-damping",
                   "gets brake-coil"]
        lines = [rig, "loadusr -w sleep 0.4", "stop", *watched, *self.outputs(LAWS[0][2], "fault", "enable"),
                 *self.outputs(BRAKE, "saturated"), "start", f"setp {BRAKE.replace('_', '-')}.0.max-current 0.5",
                 "loadusr -w sleep 0.25",
                 "stop", "gets brake-coil", *self.outputs(BRAKE, "saturated")]
        position, force, current, damping, coil, *rest = self.values(self.run_hal(lines))
        self.assertGreater(position, 1e-4)
        self.assertGreater(abs(force), 1e-4)
        self.assertLessEqual(abs(current + force / 4), 2e-6)  # six digits are printed
        self.assertEqual(damping, 11)
        self.assertLessEqual(abs(coil - (11 / 12) ** 0.5), 1e-6)
        self.assertEqual(rest, ["FALSE", "TRUE", "FALSE", 0.5, "TRUE"])

    def test_the_manual_page_names_every_pin(self):
        """Fails if the component's manual page cannot be made, or says nothing of a pin."""
        name = LAWS[0][2]
        told("halcompile", "--document", "-o", "page.9", f"{name}.comp", cwd=self.folder)
        page = (self.folder / "page.9").read_text()
        for pin in ["position", "velocity", "enable", "damping", "force", "fault", "fault-code", "safe-damping",
                    "output", "update"]:
            self.assertIn(pin, page)

    def test_quotes_and_backslashes_of_a_network(self):
        """Fails if a quote or a backslash in a network's title or source ends a string of the component, or is not
        what the manual page says."""
        name = "dp_test_quotes"
        quoted = 'a "b", a \\ and """c"'
        network = {"dashpot": 1, "name": name, "title": quoted, "source": quoted, "network": {"spring": "5 N/m"}}
        (self.folder / "quotes.json").write_text(json.dumps(network))
        told(DASHPOT, "compile", "quotes.json", "--target", "hal", cwd=self.folder)
        told("halcompile", "--compile", f"{name}.comp", cwd=self.folder)
        told("halcompile", "--document", "-o", "quotes.9", f"{name}.comp", cwd=self.folder)
        lines = (self.folder / "quotes.9").read_text().splitlines()
        in_roff = quoted.replace("\\", "\\\\")
        self.assertIn(f"{name} \\- {in_roff}", lines)
        self.assertIn(f"source: {in_roff}", lines)


if __name__ == "__main__":
    unittest.main()
