"""Laws of two axes in C: the bits of the class in C++, and nothing that firmware or a strict compiler would miss."""
import json
import math
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

import axes_test
from axes_fields_test import BRAKE, field_of, prompt_arm
from axes_test import BALL, FIELD, PANTOGRAPH, WALL, motion_in_joints, near, tip_of
from dashpot_command import DASHPOT, SOURCE, CommandTest

sys.path.insert(0, str(SOURCE / "tests/support"))
from cortex_m import PROCESSORS, compiling, linking, printed  # noqa: E402

BOARD = SOURCE / "runtime/devices/arm_board_mps2.json"
STRICT = ["-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Wsign-conversion", "-Wshadow",
          "-Wdouble-promotion", "-Werror", "-ffp-contract=off"]

# Reads rows of q1, q2, v1, v2 and writes what the law answers, in turn by step() and by its two phases, with its
# energy; every 70th row is where it is reset to.
BODY = r"""
#include <stdio.h>
int main(void) {
  double row[4];
  int n = 0, i;
  BEGIN
  printf("%a %d %d %s %d\n", (double)PERIOD, ROTATES, DELAY, DIGEST, CERTIFIED);
  for (i = 0; i < BRAKES; ++i) printf("%a\n", (double)ADDED(i));
  for (i = 0; i < 2; ++i) printf("%s\n", ESTIMATOR(i));
  for (; scanf("%lf %lf %lf %lf", row, row + 1, row + 2, row + 3) == 4; ++n) {
    const SCALAR q[2] = {(SCALAR)row[0], (SCALAR)row[1]}, v[2] = {(SCALAR)row[2], (SCALAR)row[3]};
    COMMANDS now;
    if (n % 70 == 69) RESET(q);
    if (n % 2 == 0) {
      now = STEP(q, v);
    } else {
      now = OUTPUT(q, v);
      UPDATE();
    }
    for (i = 0; i < BRAKES; ++i) printf("%a ", (double)now.damping[i]);
    printf("%a %a %a\n", (double)now.torque[0], (double)now.torque[1], (double)ENERGY());
  }
  return 0;
}
"""
IN_CPP = {"BEGIN": "LAW law; law.reset();", "PERIOD": "LAW::sample_period",
          "ROTATES": "(LAW::port_motion == dashpot::motion::rotation)",
          "DELAY": "int(LAW::certified_for::loop_delay)", "DIGEST": "LAW::certified_for::device_digest",
          "CERTIFIED": "LAW::certified_for::is_certified", "BRAKES": "LAW::brakes", "ADDED(i)": "LAW::added_damping[i]",
          "ESTIMATOR(i)": "LAW::certified_for::estimator[i]",
          "COMMANDS": "dashpot::commands<LAW::scalar, 2, LAW::brakes>",
          "RESET(q)": "law.reset(q)", "STEP(q, v)": "law.step(q, v)", "OUTPUT(q, v)": "law.output(q, v)",
          "UPDATE()": "law.update()",
          "ENERGY()": "law.stored_energy()", "SCALAR": "LAW::scalar", "LAW": "dashpot::generated::NAME"}
IN_C = {"BEGIN": "NAME law; NAME_init(&law);", "PERIOD": "NAME_sample_period()", "ROTATES": "NAME_is_rotation()",
        "DELAY": "(int)NAME_loop_delay()", "DIGEST": "NAME_device_digest()", "CERTIFIED": "NAME_is_certified()",
        "BRAKES": "NAME_brakes",
        "ADDED(i)": "NAME_added_damping(i)", "ESTIMATOR(i)": "NAME_estimator(i)", "COMMANDS": "NAME_commands",
        "RESET(q)": "NAME_reset(&law, q)", "STEP(q, v)": "NAME_step(&law, q, v)",
        "OUTPUT(q, v)": "NAME_output(&law, q, v)",
        "UPDATE()": "NAME_update(&law)", "ENERGY()": "NAME_stored_energy(&law)"}
# What an object file with all of the law's functions would be linked with.
ALL_OF_IT = r"""
void begin(NAME *law, const SCALAR *q) { NAME_init(law); NAME_reset(law, q); }
NAME_commands first(NAME *law, const SCALAR *q, const SCALAR *v) { return NAME_output(law, q, v); }
void then(NAME *law) { NAME_update(law); }
NAME_commands both(NAME *law, const SCALAR *q, const SCALAR *v) { return NAME_step(law, q, v); }
SCALAR energy(const NAME *law) { return NAME_stored_energy(law) + NAME_added_damping(1); }
const char *estimator(int joint) { return NAME_estimator(joint); }
"""

# The same on a bare board, of rows that are part of the program: the bits of all commands.
ON_BOARD = r"""
#include <cstring>
#include "NAME.h"
#include "support/semihosting.hpp"
namespace {
const SCALAR rows[][4] = {ROWS};
void say(SCALAR value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof value);
  dashpot::testing::print_number(bits, 16, 2 * sizeof value);
  dashpot::testing::print(" ");
}
}
int main() {
  NAME law;
  NAME_init(&law);
  for (const auto& row : rows) {
    const NAME_commands now = NAME_step(&law, row, row + 2);
    for (const SCALAR damping : now.damping) say(damping);
    for (const SCALAR torque : now.torque) say(torque);
    dashpot::testing::print("\n");
  }
  dashpot::testing::end_program();
  return 0;
}
"""

# Slips that meet, in a port that relaxes, and a contact that is touched and left, within a few millimetres of (0, 95
# mm).
SLIPPING = {"dashpot": 1, "axes": 2, "name": "slipping", "ports": [
    {"name": "table", "map": {"along": [1, 0.3]}, "network": {"parallel": [
        {"series": [{"spring": "500 N/m"},
                    {"parallel": [{"slip": "0.5 N"}, {"series": [{"spring": "300 N/m"}, {"slip": "0.2 N"}]}]}]},
        {"series": [{"spring": "80 N/m"}, {"damper": "2 N s/m"}]}]}},
    {"name": "ball", "map": {"ball": {"centre": [0, "130 mm"], "radius": "35 mm"}}, "contact": {"at": "0 mm"},
     "network": {"parallel": [{"spring": "150 N/m"}, {"damper": "0.5 N s/m"}]}}]}


class AxesC99Test(CommandTest):
    simulated = axes_test.AxesTest.simulated
    compiled = []  # name, scalar, whether it is of joints, folder

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder_of_laws = pathlib.Path(folder.name)

    def laws(self):
        """Every kind of arm, maps, a gate, slips that meet, four brakes, no device; compiled once for all."""
        if not self.compiled: self.compiled += list(self.compiled_laws())
        return self.compiled

    def compiled_laws(self):
        along = [[1, 0], [0, 1], [1, 1], [1, -1]]
        gated = self.write("gated.json", json.dumps(field_of("gated", 1.5, 1.4)))
        prompt = self.write("prompt.json", json.dumps(prompt_arm()))
        slipping = self.write("slipping.json", json.dumps(SLIPPING))
        four = self.write("four.json", json.dumps(prompt_arm(brakes=[{"along": way, **BRAKE} for way in along])))
        serial = prompt_arm()
        serial["kinematics"] = {**serial["kinematics"], "kind": "serial", "links": ["80 mm", "80 mm"]}
        del serial["kinematics"]["base"]
        serial = self.write("serial.json", json.dumps(serial))
        for network, options, scalars in (
                (FIELD, ["--device", self.write("near.json", near(PANTOGRAPH))], ["double", "float"]),
                (WALL, ["--device", self.write("near_board.json", near(BOARD))], ["float"]),
                (BALL, ["--rate", "10000"], ["double", "float"]), (gated, ["--device", prompt], ["double", "float"]),
                (slipping, ["--device", four, "--decomposition", "non-injecting"], ["double", "float"]),
                (FIELD, ["--device", serial, "--decomposition", "virtual"], ["double"])):
            for scalar in scalars:
                folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder_of_laws))
                for target in ("cpp", "c99"):
                    self.dashpot("compile", network, *options, "--scalar", scalar, "--uncertified", "--no-advice",
                                 "--target", target,
                                 "-o", folder)
                yield json.loads(network.read_text())["name"], scalar, "--device" in options, folder

    def rows(self, is_at_joints):
        """Rests, jumps, NaN and infinity."""
        draw, rows, last = random.Random(4), [], None
        for n, place in enumerate(motion_in_joints(700, 6)):
            place = place if is_at_joints else list(tip_of(place))
            if n % 90 > 75:
                place = last
            rows.append([*place, *(draw.uniform(-1, 1) * 10 ** draw.uniform(-6, 0) for _ in range(2))])
            if n % 53 == 52: rows[-1][n % 4] = math.nan
            if n % 69 == 68: rows[-1][n % 3] = math.inf
            if n % 210 == 209: rows[-1][0] = -math.inf  # where it is reset to
            last = place
        return rows

    def program(self, name, words, head, folder, compiler, source, *more):
        text = head + BODY
        for word, meaning in words.items():
            text = text.replace(word, meaning)
        self.write(source, text.replace("NAME", name))
        subprocess.run([*compiler, *STRICT, "-O1", "-I", folder, source, *more], cwd=self.folder, check=True)

    def answers(self, rows):
        return subprocess.run([self.folder / "law"], input="".join(" ".join(map(repr, row)) + "\n" for row in rows),
                              text=True,
                              capture_output=True, check=True).stdout.splitlines()

    def test_c_and_cpp_agree_to_the_bit(self):
        """Fails if a law in C answers a sample, or states a fact, otherwise than the class in C++, by one bit, or does
        not compile where the strictest read it, in C or in C++."""
        seen = set()
        for name, scalar, is_at_joints, folder in self.laws():
            rows = self.rows(is_at_joints)
            self.program(name, IN_CPP, '#include "NAME.hpp"', folder, ["g++", "-std=c++17"], "law.cpp",
                         "-I", SOURCE / "runtime/include", "-o", "law")
            told = self.answers(rows)
            self.assertGreater(len(set(told)), 50, name)  # the ball is not always touched
            self.assertFalse(any(word in line for line in told[1:] for word in ("nan", "inf")))
            in_c = {**IN_C, "SCALAR": scalar}
            for compiler in (["gcc", "-std=c99"], [shutil.which("clang") or shutil.which("clang-19") or "clang-14",
                                                   "-std=c99"]):
                self.program(name, in_c, '#include "NAME.h"', folder, compiler, "law.c", "-o", "law")
                self.assertEqual(self.answers(rows), told, (name, scalar, compiler))
            self.program(name, in_c, '#include "NAME.h"', folder, ["g++", "-x", "c++", "-std=c++17"], "law.c",
                         "-fsyntax-only")
            header = (folder / f"{name}.h").read_text()
            seen |= {part for part in ("_square_root(", "_tree_step(", "gate", "dashpot_flush_below", "_brakes = 4")
                     if part in header}
        self.assertEqual(len(seen), 5, seen)

    def test_a_law_needs_nothing_but_to_copy_and_to_clear(self):
        """Fails if a law in C includes a file, or needs a library."""
        for name, scalar, _, folder in self.laws():
            self.assertNotIn("#include", (folder / f"{name}.h").read_text())
            self.write("law.c", f'#include "{name}.h"' + ALL_OF_IT.replace("NAME", name).replace("SCALAR", scalar))
            subprocess.run(["gcc", "-std=c99", "-ffreestanding", "-O2", "-fno-stack-protector", "-I", folder, "-c",
                            "law.c"],
                           cwd=self.folder, check=True)
            undefined = subprocess.run(["nm", "-u", "law.o"], cwd=self.folder, check=True, capture_output=True,
                                       text=True).stdout
            self.assertLessEqual(set(undefined.split()) - {"U"}, {"memcpy", "memmove", "memset"})

    def test_a_board_answers_as_simulate_does(self):
        """Fails if a law in C on a bare Cortex-M answers a sample otherwise than `simulate`, by one bit."""
        rows = axes_test.AxesTest.rows(self, motion_in_joints(200, 8))
        for (processor, (_, machine)), scalar, form in zip(PROCESSORS.items(), ("float", "double"), "fd"):
            told = self.simulated(WALL, rows, "--device", PANTOGRAPH, "--scalar", scalar)
            self.dashpot("compile", WALL, "--device", PANTOGRAPH, "--scalar", scalar, "--uncertified", "--no-advice",
                         "--target", "c99")
            name = json.loads(WALL.read_text())["name"]
            table = ", ".join("{" + ", ".join(f"(SCALAR){value!r}" for value in row) + "}" for row in rows)
            self.write("board.cpp", ON_BOARD.replace("ROWS", table).replace("NAME", name).replace("SCALAR", scalar))
            subprocess.run(["arm-none-eabi-g++", *compiling(processor, self.folder),
                            *linking(self.folder / "board.cpp", self.folder / "law.elf")],
                           cwd=self.folder, check=True)
            bits = [" ".join(struct.pack(f">{form}", number).hex() for number in row) for row in told]
            self.assertGreater(len(set(bits)), 100)
            self.assertEqual([line.strip() for line in printed(self.folder / "law.elf", machine).splitlines()], bits,
                             processor)

    def test_roots_are_those_of_the_runtime(self):
        """Fails if a root in C is another number than in C++, however small or large what it is of."""
        for scalar, exponents in (("float", (-149, 127)), ("double", (-1074, 1023))):
            self.dashpot("compile", FIELD, "--device", PANTOGRAPH, "--scalar", scalar, "--target", "c99")
            self.write("roots.cpp", """
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <dashpot/elementary.hpp>
#include "kelvin_field.h"
int main() {
  int differing = 0;
  for (int e = FIRST; e <= LAST; ++e)
    for (const double of_it : {1.0, 1.2345678, 1.5, 1.9999999}) {
      const SCALAR x = SCALAR(std::ldexp(of_it, e));
      differing += kelvin_field_square_root(x) != std::sqrt(x) || dashpot::square_root(x) != std::sqrt(x);
    }
  std::printf("%d", differing);
}
""".replace("FIRST", str(exponents[0])).replace("LAST", str(exponents[1])).replace("SCALAR", scalar))
            for by_steps in ([], ["-U__SSE2__"]):  # as on a processor without an instruction for it
                subprocess.run(["g++", "-std=c++17", "-ffp-contract=off", *by_steps, "-I", SOURCE / "runtime/include",
                                "-I", ".", "roots.cpp",
                                "-o", "roots"], cwd=self.folder, check=True)
                told = subprocess.run([self.folder / "roots"], capture_output=True, text=True, check=True).stdout
                self.assertEqual(told, "0", (scalar, by_steps))

    def test_the_banner_is_that_of_the_class(self):
        """Fails if the header in C says less, or something else, of the law than that in C++."""
        for name, _, _, folder in self.laws():
            cpp, c99 = ((folder / (name + suffix)).read_text().split("// Written by")[0] for suffix in (".hpp", ".h"))
            self.assertEqual(c99, cpp)
            self.assertIn("passivity", c99)

    def test_a_build_in_c(self):
        """Fails if CMake does not make a law in C of a device of two axes, or asks for a description of it that C does
        not have."""
        self.write("CMakeLists.txt", f"""
cmake_minimum_required(VERSION 3.25)
project(press LANGUAGES C)
include({SOURCE}/runtime/cmake/DashpotCompile.cmake)
dashpot_compile(field NETWORK {FIELD} DEVICE {PANTOGRAPH} TARGET c99)
add_executable(press main.c)
target_link_libraries(press PRIVATE field)
""")
        self.write("main.c",
                   '#include <kelvin_field.h>\nint main(void) {\n  kelvin_field law;\n  kelvin_field_init(&law);\n  '
                   'return law.sampled;\n}\n')
        for step in (["-S", ".", "-B", "build", f"-DDASHPOT_COMPILER={DASHPOT}"], ["--build", "build"]):
            done = subprocess.run(["cmake", *step], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(subprocess.run([self.folder / "build/press"]).returncode, 0)
        self.assertEqual([file for file in self.files("build/field") if file.endswith(".h")], ["kelvin_field.h"])

    def test_names_of_c_are_refused(self):
        """Fails if a network called by a word of C is written in C."""
        for name in ("restrict", "dashpot_field"):
            self.refused("compile", FIELD, "--name", name, "--target", "c99", code="name-is-word-of-c")


if __name__ == "__main__":
    unittest.main()
