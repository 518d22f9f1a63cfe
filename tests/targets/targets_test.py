"""One motion through every target: each command of each law has the bits that `dashpot simulate` prints.

What is compared is the whole product of NETWORKS, both scalars and all targets; nothing is left out. The boards are a
Cortex-M4F and a Cortex-M7, played by QEMU, each in float and in double (which the M4F computes without an instruction
for it). LinuxCNC's components run in sessions of halrun itself, as many laws at a time as its sampler has pins for.

The environment names DASHPOT, DASHPOT_SOURCE, DASHPOT_TARGETS (what ctest runs, separated by commas), GXX, GCC, NODE
and ARM_GXX.
"""
import csv
import functools
import importlib
import json
import math
import os
import pathlib
import random
import re
import struct
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["DASHPOT_SOURCE"])
for room in ["support", "fmi", "hal"]:
    sys.path.insert(0, str(SOURCE / "tests" / room))
from cortex_m import PROCESSORS, compiling, linking, printed  # noqa: E402
from importer import OK, Fmu, Instance  # noqa: E402
from session import PINS_AT_MOST, Session  # noqa: E402

DASHPOT, GXX, GCC = os.environ["DASHPOT"], os.environ["GXX"], os.environ["GCC"]
NODE, ARM_GXX = os.environ["NODE"], os.environ["ARM_GXX"]

# The paper's, four of them with slips or a contact, two whose parameters change on the way, two behind static curves.
NETWORKS = sorted((SOURCE / "networks/paper").glob("*.json"))
NETWORKS += [SOURCE / f"networks/tunable/{name}.json" for name in ["friction_tunable", "second_order_maxwell_tunable"]]
NETWORKS += [SOURCE / f"networks/static/{name}.json" for name in ["ligament", "sphere_on_gel"]]
NAMES = [network.stem for network in NETWORKS]
SCALARS = {"double": "d", "float": "f"}
ROWS, PERIOD = 400, 0.001
# From these rows on; all values before are those of the file.
CHANGES = {"friction_tunable": {130: {"yield": 0.4, "presliding": 4321.5, "drag": 3.3},
                                260: {"yield": 2.7, "presliding": 700.1, "drag": 0.0}},
           "second_order_maxwell_tunable": {130: {"K1": 77.7, "B2": 1.3}, 260: {"K1": 0.9, "B2": 17.1}}}
IS_LONG = os.environ.get("DASHPOT_LONG") == "1"
HOST_FLAGS = ["-O2" if IS_LONG else "-O1", "-ffp-contract=off", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion",
              "-Wsign-conversion", "-Wshadow", "-Wdouble-promotion", "-Werror"]


def motion():
    """Into tissue and out of it, across where slips begin to slide, with steps of all sizes and rests; velocities are
    an estimate."""
    chance, position, rows = random.Random(18), 0.0, [(0.0, 0.0)]
    for n in range(1, ROWS):
        before = position
        if n % 50 < 40:
            position = 4e-3 * math.sin(n / 35) + chance.uniform(-1, 1) * 10 ** chance.uniform(-9, -3.5)
        rows.append((position, (position - before) / PERIOD * chance.uniform(0.8, 1.2)))
    return rows


MOTION = motion()


def ran(*command, **more):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=200, **more)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout[:4000]}{done.stderr[:4000]}")
    return done.stdout


def bits(damping, force, scalar):
    """As text, of numbers that Python holds as doubles."""
    return " ".join(struct.pack(f">{SCALARS[scalar]}", value).hex() for value in (damping, force))


def values_by_row(name):
    """Of each parameter, its value in every row."""
    changes = CHANGES.get(name, {})
    parameters = json.loads((SOURCE / f"networks/tunable/{name}.json").read_text())["parameters"] if changes else {}
    values = {}
    for parameter, declared in parameters.items():
        number, unit = declared["value"].split(maxsplit=1)
        now, column = float(number) * (1000 if unit.startswith("k") else 1), []
        for n in range(ROWS):
            now = changes.get(n, {}).get(parameter, now)
            column.append(now)
        values[parameter] = column
    return values


@functools.cache
def simulated(name, scalar, scale=1):
    values = values_by_row(name)
    with tempfile.TemporaryDirectory() as folder:
        table = pathlib.Path(folder) / "motion.csv"
        lines = [[n * PERIOD, *(scale * number for number in MOTION[n]), *(column[n] for column in values.values())]
                 for n in range(ROWS)]
        table.write_text("\n".join([",".join(["time", "position", "velocity", *values]),
                                    *(",".join(map(repr, line)) for line in lines)]) + "\n")
        answer = ran(DASHPOT, "simulate", NETWORKS[NAMES.index(name)], "--input", table, "--scalar", scalar)
    return [bits(float(row["damping"]), float(row["motor_force"]), scalar)
            for row in csv.DictReader(answer.splitlines())]


class Targets(unittest.TestCase):

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def emitted(self, target, scalar):
        folder = self.folder / scalar
        ran(DASHPOT, "compile", *NETWORKS, "--target", target, "--scalar", scalar, "-o", folder)
        return folder

    def expect_bits(self, found):
        """`found[name, scalar]` are the commands of one law, as text."""
        self.assertEqual(sorted(found), sorted((name, scalar) for name in NAMES for scalar in SCALARS))
        wrong = []
        for (name, scalar), commands in found.items():
            expected = simulated(name, scalar)
            self.assertEqual(len(commands), ROWS, name)
            differing = [n for n in range(ROWS) if commands[n] != expected[n]]
            if differing:
                n = differing[0]
                wrong.append(f"{name} in {scalar}: {len(differing)} of {ROWS} commands differ, first in row {n}: "
                             f"{commands[n]} "
                             f"instead of {expected[n]}")
        self.assertEqual(wrong, [], "\n" + "\n".join(wrong))
        print(f"{len(found)} laws, {len(found) * ROWS} of {len(found) * ROWS} commands equal")

    def of_text(self, text, scalar):
        """Lines of a name and of its commands' bits."""
        found = {}
        for line in text.splitlines():
            if line in NAMES:
                now = found[line, scalar] = []
            else:
                now.append(line)
        return found

    def tables(self):
        """The motion as arrays, in C and in C++."""
        hexed = lambda numbers: ", ".join(number.hex() for number in numbers)
        return "".join(f"static const double {name}[{ROWS}] = {{{hexed(column)}}};\n"
                       for name, column in zip(["positions", "velocities"], zip(*MOTION)))

    def played_in_cpp(self, folder):
        """Writes what the programs in C++ include."""
        text = "// The laws of this test, one after the other.\n#pragma once\n"
        text += "".join(f'#include "{name}.hpp"\n' for name in NAMES)
        text += f"namespace dashpot::testing {{\n{self.tables()}" + """
template <class Law, class Change, class Say>
void play(Change change, Say say) {
  using scalar = typename Law::scalar;
  Law law;
  law.reset(0);
  for (int n = 0; n < ROWS; ++n) {
    change(law, n);
    const auto now = law.step(scalar(positions[n]), scalar(velocities[n]));
    say(now.damping, now.force);
  }
}

template <class Name, class Say>
void play_all(Name named, Say say) {
""".replace("ROWS", str(ROWS))
        for name in NAMES:
            change = "".join(f"    if (n == {n}) law.set({{" +
                             ", ".join(f"scalar({value.hex()})" for value in values.values()) + "});\n"
                             for n, values in CHANGES.get(name, {}).items())
            head = "auto& law, int n" if change else "auto&, int"
            scalar = "    using scalar = typename std::remove_reference_t<decltype(law)>::scalar;\n" if change else ""
            text += f'  named("{name}");\n  play<generated::{name}>([]({head}) {{\n{scalar}{change}  }}, say);\n'
        text = text.replace("#pragma once\n", "#pragma once\n#include <type_traits>\n")
        (folder / "played_laws.hpp").write_text(text + "}\n}\n")

    def test_cpp(self):
        """Fails if a class in C++ answers a row otherwise than `simulate`, by one bit."""
        found = {}
        for scalar in SCALARS:
            folder = self.emitted("cpp", scalar)
            self.played_in_cpp(folder)
            ran(GXX, "-std=c++17", *HOST_FLAGS, f"-I{folder}", f"-I{SOURCE}/runtime/include",
                SOURCE / "tests/targets/host.cpp", "-o", folder / "play")
            found |= self.of_text(ran(folder / "play"), scalar)
        self.expect_bits(found)

    def test_c99(self):
        """Fails if a law in C answers a row otherwise than `simulate`, by one bit."""
        found = {}
        for scalar in SCALARS:
            folder = self.emitted("c99", scalar)
            text = "#include <stdio.h>\n" + "".join(f'#include "{name}.h"\n' for name in NAMES)
            text += self.tables() + "int main(void) {\n"
            for name in NAMES:
                text += f'  puts("{name}");\n  {{\n    {name} law;\n' \
                        f"    {name}_init(&law);\n    {name}_reset(&law, 0);\n" \
                        f"    for (int n = 0; n < {ROWS}; ++n) {{\n"
                for n, values in CHANGES.get(name, {}).items():
                    text += f"      if (n == {n}) {{\n" \
                            f"        {name}_parameters wanted = {name}_parameters_at_first();\n"
                    text += "".join(f"        wanted.{key} = ({scalar}){value.hex()};\n"
                                    for key, value in values.items())
                    text += f"        {name}_set(&law, &wanted);\n      }}\n"
                text += f"      const dashpot_command now = {name}_step(&law, ({scalar})positions[n], " \
                        f"({scalar})velocities[n]);\n" \
                        '      printf("%a %a\\n", now.damping, now.force);\n    }\n  }\n'
            (folder / "play.c").write_text(text + "  return 0;\n}\n")
            ran(GCC, "-std=c99", *HOST_FLAGS, folder / "play.c", "-o", folder / "play")
            for law, commands in self.of_text(ran(folder / "play"), scalar).items():
                found[law] = [bits(*map(float.fromhex, line.split()), scalar) for line in commands]
        self.expect_bits(found)

    def test_hal(self):
        """Fails if a component of LinuxCNC in a session of halrun answers a row otherwise than `simulate`, by one
        bit."""
        names = {}
        for scalar in SCALARS:
            for name, network in zip(NAMES, NETWORKS):
                component = f"dp_bits_{scalar}_{NAMES.index(name)}"  # called as nothing of LinuxCNC is
                ran(DASHPOT, "compile", network, "--name", component, "--target", "hal", "--scalar", scalar,
                    cwd=self.folder)
                ran("halcompile", "--compile", f"{component}.comp", cwd=self.folder)
                names[name, scalar] = component
        columns = {(name, parameter): column for name in NAMES for parameter, column in values_by_row(name).items()}
        rows = [[*MOTION[n], *(column[n] for column in columns.values())] for n in range(ROWS)]
        (self.folder / "motion.txt").write_text("".join(" ".join(map(repr, row)) + "\n" for row in rows))
        session = Session(self.folder, GCC, names.values())
        self.addCleanup(session.close)
        found, laws = {}, list(names)
        at_once = PINS_AT_MOST // 2
        for first in range(0, len(laws), at_once):
            together = laws[first:first + at_once]
            sampled = "f" * (2 * len(together))
            lines = ["loadrt threads name1=servo period1=1000000",
                     f"loadrt streamer depth={2 * ROWS} cfg={'f' * len(rows[0])}",
                     f"loadrt sampler depth={4 * ROWS} cfg={sampled}", "net u streamer.0.pin.0",
                     "net v streamer.0.pin.1",
                     *(f"net {parameter}-{name} streamer.0.pin.{i}" for i, (name, parameter) in enumerate(columns, 2)),
                     "addf streamer.0 servo"]
            for i, (name, scalar) in enumerate(together):
                pins = names[name, scalar].replace("_", "-") + ".0"
                lines += [f"loadrt {names[name, scalar]}", f"net u => {pins}.position", f"net v => {pins}.velocity",
                          f"net b{i} {pins}.damping => sampler.0.pin.{2 * i}",
                          f"net f{i} {pins}.force => sampler.0.pin.{2 * i + 1}",
                          *(f"net {key}-{law} => {pins}.{key}" for law, key in columns if law == name),
                          f"setp {pins}.enable 1", f"addf {pins}.output servo", f"addf {pins}.update servo"]
            lines += ["addf sampler.0 servo", "loadusr -w halstreamer motion.txt", "start",
                      f"loadusr -w ./read_samples samples.txt {ROWS} {sampled}"]
            session.run(lines)
            samples = [line.split() for line in (self.folder / "samples.txt").read_text().splitlines()]
            numbers = [int(sample[0]) for sample in samples]
            self.assertEqual(numbers, list(range(numbers[0], numbers[0] + ROWS)))
            for i, law in enumerate(together):
                found[law] = [bits(*map(float.fromhex, sample[1 + 2 * i:3 + 2 * i]), law[1]) for sample in samples]
        self.expect_bits(found)

    def fmi(self, version):
        found = {}
        for scalar in SCALARS:
            folder = self.emitted(f"fmi{version}", scalar)
            for name in NAMES:
                unit = Instance(Fmu(folder / f"{name}.fmu", folder / name))
                self.assertEqual(unit.begin(), OK, unit.said)
                values, commands = values_by_row(name), []
                for n, (position, velocity) in enumerate(MOTION):
                    self.assertEqual(unit.set(position=position, velocity=velocity,
                                              **{key: column[n] for key, column in values.items()}), OK)
                    self.assertEqual(unit.step(n * PERIOD, PERIOD), OK, unit.said)
                    commands.append(bits(*unit.get("damping", "force"), scalar))
                unit.free()
                found[name, scalar] = commands
        self.expect_bits(found)

    def test_fmi2(self):
        """Fails if a unit for co-simulation answers a row otherwise than `simulate`, by one bit."""
        self.fmi(2)

    def test_fmi3(self):
        """Fails if a unit for co-simulation answers a row otherwise than `simulate`, by one bit."""
        self.fmi(3)

    def test_python(self):
        """Fails if a package for Python answers a row otherwise than `simulate`, by one bit."""
        found = {}
        for scalar in SCALARS:
            folder = self.emitted("python", scalar)
            sys.path.insert(0, str(folder))
            for name in NAMES:
                sys.modules.pop(name, None)
                importlib.invalidate_caches()
                module = importlib.import_module(name)
                self.assertEqual(pathlib.Path(module.__file__).parents[1], folder)
                law, commands = module.Law(), []
                for n, row in enumerate(MOTION):
                    if n in CHANGES.get(name, {}):
                        law.set(**CHANGES[name][n])
                    commands.append(bits(*law.step(*row), scalar))
                found[name, scalar] = commands
            sys.path.remove(str(folder))
        self.expect_bits(found)

    def test_wasm(self):
        """Fails if a module for JavaScript answers a row in Node.js otherwise than `simulate`, by one bit."""
        script = """
          const motion = MOTION, changes = CHANGES;
          for (const name of NAMES) {
            const law = await (await import(`./${name}/index.js`)).load();
            const answer = new Float64Array(2 * motion.length);
            for (const [n, [position, velocity]] of motion.entries()) {
              const values = changes[name]?.[n];
              if (values) law.set(values);
              const now = law.step(position, velocity);
              answer.set([now.damping, now.force], 2 * n);
            }
            console.log(Buffer.from(answer.buffer).toString('hex'));
          }
        """
        for word, value in [("MOTION", MOTION), ("CHANGES", CHANGES), ("NAMES", NAMES)]:
            script = script.replace(word, json.dumps(value))
        found = {}
        for scalar in SCALARS:
            folder = self.emitted("wasm", scalar)
            (folder / "play.mjs").write_text(script)
            for name, line in zip(NAMES, ran(NODE, "play.mjs", cwd=folder).splitlines(), strict=True):
                found[name, scalar] = [bits(*pair, scalar) for pair in struct.iter_unpack("=2d", bytes.fromhex(line))]
        self.expect_bits(found)

    def board(self, processor):
        found = {}
        for scalar in SCALARS:
            folder = self.emitted("cpp", scalar)
            self.played_in_cpp(folder)
            ran(ARM_GXX, *compiling(processor, folder), "-Wall", "-Wextra", "-Werror",
                *linking(SOURCE / "tests/targets/board.cpp", folder / "play.elf"))
            found |= self.of_text(printed(folder / "play.elf", PROCESSORS[processor][1]), scalar)
        self.expect_bits(found)

    def test_cortex_m4f(self):
        """Fails if a class on a Cortex-M4F, which has floats in hardware alone, answers a row otherwise than
        `simulate`, by one bit."""
        self.board("cortex_m4f")

    def test_cortex_m7(self):
        """Fails if a class on a Cortex-M7 answers a row otherwise than `simulate`, by one bit."""
        self.board("cortex_m7")


class Complete(unittest.TestCase):

    def test_no_target_is_left_out(self):
        """Fails if a target that the compiler knows, or a board, has no test here, is not run by ctest, or has no row
        in the README."""
        text = ran(DASHPOT, "compile", "--help")
        known = re.findall(r"^  (\w+) +NAME", text[text.index("Targets:"):], re.MULTILINE)
        wanted = sorted([*known, *PROCESSORS])
        self.assertGreater(len(known), 6)
        self.assertEqual(sorted(name.removeprefix("test_") for name in vars(Targets) if name.startswith("test_")),
                         wanted)
        self.assertEqual(sorted(os.environ["DASHPOT_TARGETS"].split(",")), wanted)
        rows = re.findall(r"^\| .* \| `dashpot compile NETWORK(.*?)` \|", (SOURCE / "README.md").read_text(),
                          re.MULTILINE)
        self.assertLessEqual({"" if target == "cpp" else f" --target {target}" for target in known}, set(rows))
        self.assertLessEqual({" --scalar float", " --scalar double"}, set(rows))  # the boards

    def test_the_motion_says_something(self):
        """Fails if the motion leaves a law at rest, never slides a slip or leaves the wall, or a change of parameters
        changes nothing."""
        for name in NAMES:
            commands = simulated(name, "double")
            self.assertGreater(len(set(commands)), ROWS // 4, name)
        for name in NAMES:
            network = json.loads(NETWORKS[NAMES.index(name)].read_text())
            forces, twice = ([struct.unpack(">d", bytes.fromhex(command.split()[1]))[0]
                              for command in simulated(name, "double", scale)] for scale in (1, 2))
            beyond = max(abs(double - 2 * force) for force, double in zip(forces, twice)) / max(map(abs, twice))
            if '"slip"' in json.dumps(network):
                self.assertGreater(beyond, 0.1, name)  # it is slid
        self.assertEqual({command.split()[0] for command in simulated("virtual_wall", "double")},
                         {"0" * 16, struct.pack(">d", 5).hex()})
        for name in list(CHANGES):
            changed = simulated(name, "double")
            simulated.cache_clear()
            kept = CHANGES.pop(name)
            unchanged = simulated(name, "double")
            simulated.cache_clear()
            CHANGES[name] = kept
            self.assertEqual(changed[:130], unchanged[:130])
            self.assertNotEqual(changed[131:260], unchanged[131:260])


if __name__ == "__main__":
    unittest.main()
