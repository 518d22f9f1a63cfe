"""What `dashpot compile` writes, and when it writes nothing."""
import json
import os
import re
import resource
import signal
import subprocess
import time
import unittest

from dashpot_command import (BROKEN, COMMAND_LINE_WRONG, DASHPOT, FIG_5, INPUT_REFUSED, KELVIN, MAXWELL, PANTOGRAPH,
                             SOURCE, CommandTest, network)

# Two slips that meet at an inner node with the spring between them.
COUPLED = """{ "series": [ { "parallel": [ { "slip": 1 }, { "spring": 50 } ] }, { "parallel": [ { "slip": 2 }, { "spring": 70 } ] },
             { "spring": 90 } ] }"""


class Files(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("kelvin.json", KELVIN)
        self.write("maxwell.json", MAXWELL)
        self.write("broken.json", BROKEN)

    def test_one_header_a_network(self):
        """Fails if a header is missing, is named otherwise than its network, or comes with anything else."""
        done = self.dashpot("compile", "kelvin.json", "maxwell.json", "-o", "out")
        self.assertEqual(self.files("out"), ["kelvin.hpp", "maxwell.hpp"])
        self.assertEqual((done.stdout, done.stderr), ("", ""))
        self.assertIn("class kelvin {", (self.folder / "out/kelvin.hpp").read_text())

    def test_arithmetic_without_numbers_that_are_none(self):
        """Fails if a header is compiled where a check for NaN is always passed, so that one such input stays in the
        states for ever."""
        self.dashpot("compile", "kelvin.json")
        self.write("main.cpp",
                   '#include "kelvin.hpp"\n'
                   'int main() { dashpot::generated::kelvin law; return law.step(0, 0).force != 0; }\n')
        for flags, status in [([], 0), (["-ffast-math"], 1), (["-ffinite-math-only"], 1), (["-Ofast"], 1),
                              (["-fno-math-errno"], 0)]:
            with self.subTest(flags=flags):
                done = subprocess.run([os.environ.get("CXX", "c++"), "-std=c++17", "-fsyntax-only",
                                       f"-I{SOURCE}/runtime/include", *flags, "main.cpp"],
                                      cwd=self.folder, capture_output=True, text=True)
                self.assertEqual(done.returncode != 0, bool(status), done.stderr)
                self.assertEqual("dashpot needs IEEE arithmetic" in done.stderr, bool(status))

    def test_the_current_folder_by_default(self):
        """Fails if output without -o goes anywhere but here."""
        self.dashpot("compile", FIG_5)
        self.assertIn("second_order_maxwell.hpp", self.files())

    def test_with_test(self):
        """Fails if --with-test does not write a test that includes the header beside it."""
        self.dashpot("compile", "kelvin.json", "--with-test", "-o", "out")
        self.assertEqual(self.files("out"), ["kelvin.hpp", "kelvin_test.cpp"])
        self.assertIn('#include "kelvin.hpp"', (self.folder / "out/kelvin_test.cpp").read_text())

    def test_a_test_without_motion(self):
        """Fails if a test that plays no motion does not say so and why, where it is made and in itself; or one that
        plays one does."""
        slipping = SOURCE / "networks/paper/visco_elasto_plastic.json"
        for target, ending in (("cpp", "cpp"), ("c99", "c")):
            done = self.dashpot("compile", slipping, "--name", "slipping", "--target", target, "--with-test", "-o",
                                "out")
            self.assertIn("note: the test of 'slipping' checks no force along a motion, because with slips",
                          done.stderr)
            head = " ".join((self.folder / f"out/slipping_test.{ending}").read_text().replace("// ", "").split(
                "#include")[0].split())
            self.assertIn("at rest, and with NaN and infinite samples. No force along a motion is checked, because "
                          "with slips", head)
            done = self.dashpot("compile", "kelvin.json", "--target", target, "--with-test", "-o", "out")
            self.assertNotIn("checks no force along a motion", done.stderr)
            self.assertIn("against the closed forms", (self.folder / f"out/kelvin_test.{ending}").read_text())

    def test_the_scalar(self):
        """Fails if --scalar does not reach the code."""
        for scalar in ["double", "float"]:
            self.dashpot("compile", "kelvin.json", "--scalar", scalar)
            self.assertIn(f"using scalar = {scalar};", (self.folder / "kelvin.hpp").read_text())

    def test_the_registers(self):
        """Fails if --vector does not reach the code of a loop, or an unknown machine passes."""
        branches = ", ".join(f'{{ "series": [ {{ "spring": {i} }}, {{ "damper": 1 }} ] }}' for i in range(1, 13))
        self.write("many.json", network(f'{{ "parallel": [ {branches} ] }}', "many"))
        for registers, layout in [("none", "sums in 4 parts"), ("sse2", "16 bytes; sums in 8"),
                                  ("neon", "16 bytes; sums in 8"),
                                  ("avx2", "32 bytes, -mavx2; sums in 16"),
                                  ("avx512", "64 bytes, -mavx512f; sums in 32")]:
            self.dashpot("compile", "many.json", "--vector", registers)
            self.assertIn(layout, (self.folder / "many.hpp").read_text())
        self.dashpot("compile", "many.json", "--vector", "mmx", status=COMMAND_LINE_WRONG)

    def test_constant_time(self):
        """Fails if --constant-time does not reach the code, or laws whose steps have loops of their own pass."""
        self.dashpot("compile", "kelvin.json", "--constant-time")
        self.assertIn("branch_free", (self.folder / "kelvin.hpp").read_text())
        self.write("coupled.json", network(COUPLED, "coupled"))
        refused = self.refused("compile", "coupled.json", "--constant-time", code="step-of-coupled-slips")
        self.assertRegex(refused.stderr, "without --constant-time a step takes at most [1-9][0-9]* operations")
        layers = SOURCE / "networks/tunable/layers_tunable.json"
        refused = self.refused("compile", layers, "--constant-time", code="step-of-coupled-slips")
        self.assertRegex(refused.stderr, "without --constant-time a step takes at most [1-9][0-9]* operations")
        for tunable in ["standard_solid_tunable", "friction_tunable"]:
            self.dashpot("compile", SOURCE / f"networks/tunable/{tunable}.json", "--constant-time")
            self.assertIn("branch_free", (self.folder / f"{tunable}.hpp").read_text())

    def test_batch(self):
        """Fails if --batch does not write its class beside the single one, of whatever law."""
        self.dashpot("compile", "kelvin.json", "--batch", "-o", "out")
        self.assertEqual(self.files("out"), ["kelvin.hpp", "kelvin_batch.hpp"])
        refused = self.dashpot("compile", "kelvin.json", "--batch=7", status=COMMAND_LINE_WRONG)
        self.assertIn("'--batch' takes no value", refused.stderr)
        self.assertIn("class kelvin_batch {", (self.folder / "out/kelvin_batch.hpp").read_text())
        self.write("coupled.json", network(COUPLED, "coupled"))
        for file in ["coupled.json", SOURCE / "networks/tunable/layers_tunable.json"]:
            self.dashpot("compile", file, "--batch")

    def test_names_of_c99(self):
        """Fails if a network may be called, in C, as a function is that a header of C99 declares."""
        headers = ("assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdarg "
                   "stdbool stddef stdint stdio stdlib string tgmath time wchar wctype")
        self.write("all.c", "".join(f"#include <{header}.h>\n" for header in headers.split()))
        subprocess.run(["gcc", "-std=c99", "-fsyntax-only", "-aux-info", "all.txt", "all.c"], cwd=self.folder,
                       check=True)
        declared = set(re.findall(r" \*?([a-z]\w*) \(", (self.folder / "all.txt").read_text())) - {"void"}
        self.assertGreater(len(declared), 400)
        words = sorted(declared | {"main", "restrict", "stdin", "double_t", "I"})
        for word in words:
            self.write(f"{word}.json", network('{ "spring": 1 }', word))
        told = self.refused("compile", *(f"{word}.json" for word in words), "--target", "c99", "-o", "out",
                            code="name-is-word-of-c").stderr
        self.assertEqual(set(words) - set(re.findall(r"network name '(\w+)' is reserved by C", told)), set())
        self.dashpot("compile", "exp.json", "-o", "out")

    def test_c99_of_a_zeroed_structure(self):
        """Fails if a structure that is all zero, reset or set without _init() before, has no parameters."""
        self.dashpot("compile", SOURCE / "networks/tunable/standard_solid_tunable.json", "--target", "c99", "-o", ".")
        self.write("begin.c", """#include <stdio.h>
#include "standard_solid_tunable.h"
typedef standard_solid_tunable law;
static law begun, reset, set;
static void play(law *self) {
  for (int k = 1; k < 5; ++k) {
    const dashpot_command c = standard_solid_tunable_step(self, k * 1e-3, 0.0);
    printf("%.17g %.17g\\n", c.damping, c.force);
  }
}
int main(void) {
  standard_solid_tunable_parameters wanted = standard_solid_tunable_parameters_at_first();
  standard_solid_tunable_init(&begun);
  standard_solid_tunable_reset(&reset, 0);
  play(&begun);
  play(&reset);
  wanted.K1 = 700;
  standard_solid_tunable_init(&begun);
  standard_solid_tunable_set(&begun, &wanted);
  standard_solid_tunable_set(&set, &wanted);
  standard_solid_tunable_reset(&set, 0.01);
  standard_solid_tunable_reset(&begun, 0.01);
  play(&begun);
  play(&set);
  return 0;
}
""")
        subprocess.run(["gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off", "begin.c", "-o",
                        "begin"], cwd=self.folder, check=True)
        lines = subprocess.run(["./begin"], cwd=self.folder, check=True, capture_output=True,
                               text=True).stdout.split("\n")
        self.assertEqual(lines[0:4], lines[4:8])
        self.assertEqual(lines[8:12], lines[12:16])
        self.assertNotEqual(lines[0:4], lines[8:12])

    def test_test_of_mixed_schemes(self):
        """Fails if the test that is written with a law holds elements by backward Euler to the exact scheme."""
        self.write("mix.json", json.dumps({
            "dashpot": 1, "name": "mix",
            "parameters": {"k": {"value": "500 N/m", "tunable": True, "min": "0 N/m", "max": "1700 N/m"}},
            "network": {"parallel": [
                {"series": [{"damper": 2}, {"parallel": [{"damper": 6}, {"spring": "k"}]}]}, {"damper": 20}]}}))
        self.dashpot("compile", "mix.json", "--target", "c99", "--with-test", "-o", ".")
        header = " ".join((self.folder / "mix.h").read_text().replace("//", " ").split())
        self.assertIn("is answered exactly, except the elements listed below under 'backward Euler'", header)
        subprocess.run(["gcc", "-std=c99", "-ffp-contract=off", "mix_test.c", "-lm", "-o", "mix"], cwd=self.folder,
                       check=True)
        subprocess.run(["./mix"], cwd=self.folder, check=True, capture_output=True)

    def test_c99(self):
        """Fails if --target c99 writes anything but one header in C, or what it has nothing for passes without a
        message."""
        self.dashpot("compile", "kelvin.json", "--target", "c99", "-o", "out")
        self.assertEqual(self.files("out"), ["kelvin.h"])
        header = (self.folder / "out/kelvin.h").read_text()
        for declared in ["typedef struct kelvin {", "static inline void kelvin_reset(kelvin *self, double position) {",
                         "static inline dashpot_command kelvin_output(kelvin *self, double position, "
                         "double velocity) {",
                         "static inline void kelvin_update(kelvin *self) {",
                         "static inline dashpot_command kelvin_step(kelvin *self, double position, double velocity) {",
                         "static inline double kelvin_stored_energy(const kelvin *self) {"]:
            self.assertIn(declared, header)
        self.assertNotIn("#include", header)
        for file in ["standard_solid_tunable", "friction_tunable", "layers_tunable"]:
            self.dashpot("compile", SOURCE / f"networks/tunable/{file}.json", "--target", "c99", "-o", "out")
            header = (self.folder / f"out/{file}.h").read_text()
            self.assertIn(f"unsigned {file}_set({file} *self, const {file}_parameters *wanted) {{", header)
            self.assertEqual(header.count("#if"), 3, "two include guards, and the check for IEEE arithmetic")
        self.write("word.json", json.dumps({
            "dashpot": 1, "name": "word", "network": {"spring": "restrict"},
            "parameters": {"restrict": {"value": "2 N/m", "tunable": True, "min": "1 N/m", "max": "3 N/m"}}}))
        self.dashpot("compile", "word.json", "--target", "c99", "-o", "out")
        header = (self.folder / "out/word.h").read_text()
        self.assertIn("  double restrict_;  // 1 to 3 [N/m]", header)
        self.assertIn('if (i == 0) return "restrict";', header)
        tunable = {"value": "2 N/m", "tunable": True, "min": "1 N/m", "max": "3 N/m"}
        self.write("words.json", json.dumps({
            "dashpot": 1, "name": "words", "network": {"parallel": [{"spring": "restrict"}, {"spring": "restrict_"}]},
            "parameters": {"restrict": tunable, "restrict_": tunable}}))
        self.dashpot("compile", "words.json", "--target", "c99", "-o", "out")
        header = (self.folder / "out/words.h").read_text()
        for line in ["  double restrict_2;  // 1 to 3 [N/m]", "  double restrict_;  // 1 to 3 [N/m]",
                     "values[2] = {wanted->restrict_2, wanted->restrict_};"]:
            self.assertIn(line, header)
        self.write("restrict.json", network('{ "spring": 1 }', "restrict"))
        self.dashpot("compile", "restrict.json")
        for option in [["--batch"], ["--constant-time"], ["--certificate", "c.json"]]:
            done = self.dashpot("compile", "kelvin.json", "--target", "c99", *option, status=COMMAND_LINE_WRONG)
            self.assertIn(f"--target c99 does not support {option[0]}", done.stderr)
            self.assertIn("note: --target cpp supports it", done.stderr)

    def test_functions_of_c99(self):
        """Fails if an element's value, a local number in C, hides a function that the same lines call."""
        for word in ["dashpot_all_finite", "dashpot_flush_below", "dashpot_clamp_to", "dashpot_command",
                     "hidden_square_root", "hidden_mean_decay"]:
            self.write("hidden.json", json.dumps({
                "dashpot": 1, "name": "hidden",
                "parameters": {"K": {"value": "20 N/m", "tunable": True, "min": "0 N/m", "max": "100 N/m"}},
                "network": {"parallel": [
                    {"spring": "100 N/m", "name": word}, {"series": [{"spring": "K"}, {"slip": "1 N"}]},
                    {"series": [{"spring": "K"}, {"damper": "1 N s/m"}]}]}}))
            self.dashpot("compile", "hidden.json", "--target", "c99")
            strict = ["gcc", "-std=c99", "-Wall", "-Wextra", "-Wshadow", "-Wno-unused-function", "-Werror"]
            built = subprocess.run([*strict, "-fsyntax-only", "-x", "c", "hidden.h"], cwd=self.folder, text=True,
                                   capture_output=True, check=False)
            self.assertEqual(built.stderr, "", word)

    def test_names_with_an_underscore_behind(self):
        """Fails if emitted code calls something by a word or a macro since an underscore is behind it in the file."""
        for word in ["long_", "NULL_", "M_PI_"]:
            self.write("under.json", json.dumps({
                "dashpot": 1, "name": "under",
                "parameters": {word: {"value": "20 N/m", "tunable": True, "min": "0 N/m", "max": "100 N/m"}},
                "network": {"parallel": [
                    {"spring": word}, {"spring": "100 N/m", "name": "class_"},
                    {"series": [{"spring": "5 N/m", "name": "int_"}, {"damper": 1}]}]}}))
            self.dashpot("compile", "under.json", "--target", "c99")
            self.dashpot("compile", "under.json")
            self.write("under.c", "#include <math.h>\n#include <stdio.h>\n#include <under.h>\n")
            self.write("under.cpp", "#include <cmath>\n#include <cstdio>\n#include <under.hpp>\n")
            for compiler in (["gcc", "-std=gnu99", "under.c"],
                             ["g++", "-std=gnu++17", f"-I{SOURCE}/runtime/include", "under.cpp"]):
                built = subprocess.run([*compiler, "-fsyntax-only", "-Wall", "-Werror", "-I."], cwd=self.folder,
                                       text=True, capture_output=True, check=False)
                self.assertEqual(built.stderr, "", word)

    def test_hal(self):
        """Fails if --target hal writes anything but one component, or one that takes the place of another or has no
        room for its pins."""
        self.dashpot("compile", "kelvin.json", "--target", "hal", "-o", "out")
        self.assertEqual(self.files("out"), ["kelvin.comp"])
        component = (self.folder / "out/kelvin.comp").read_text()
        for declared in ['component kelvin "kelvin";', "pin in float position", "pin out float damping",
                         "pin out float force",
                         "pin in bit enable = 0", "pin out bit fault", "typedef struct law_kelvin {"]:
            self.assertIn(declared, component)
        self.dashpot("compile", "kelvin.json", "--target", "hal", "--name", "restrict")
        told = self.refused("compile", "kelvin.json", "--target", "hal", "--name", "siggen", code="name-kept-by")
        self.assertIn("'siggen' is reserved by a component of LinuxCNC", told.stderr)
        longest = "k" * (47 - len(".0.safe-damping"))
        self.dashpot("compile", "kelvin.json", "--target", "hal", "--name", longest)
        self.assertIn("HAL takes at most 47",
                      self.refused("compile", "kelvin.json", "--target", "hal", "--name", longest + "k",
                                   code="name-too-long-for").stderr)

    def test_parameters_with_names_of_a_target(self):
        """Fails if a tunable parameter passes for a pin or a variable that is there already."""
        for name in ["fault", "fperiod", "fault_", "safe_damping_", "restrict", "enable"]:
            tunable = (f'"parameters": {{ "{name}": {{ "value": "100 N/m", "tunable": true, '
                       '"min": "50 N/m", "max": "200 N/m" } },')
            self.write("tunable.json", network(f'{{ "spring": "{name}" }}', "soft", tunable))
            self.refused("compile", "tunable.json", "--target", "hal", code="parameter-name-kept-by")
        self.write("tunable.json", network('{ "spring": "time" }', "soft", tunable.replace("enable", "time")))
        for target in ["fmi2", "fmi3"]:
            self.refused("compile", "tunable.json", "--target", target, code="parameter-name-kept-by")

    def test_the_timings(self):
        """Fails if --timings leaves a stage out, changes what is written, or is printed where output belongs."""
        stages = ["files", "front end", "normal form", "decomposition", "discretisation", "certificate", "advice",
                  "emission", "total"]
        self.dashpot("compile", "kelvin.json", "maxwell.json", "-o", "untimed")
        text = self.dashpot("compile", "kelvin.json", "maxwell.json", "--timings", "text", "-o", "timed")
        self.assertEqual([line[:16].rstrip() for line in text.stderr.splitlines()], stages)
        self.assertEqual(text.stdout, "")
        for name in ["kelvin.hpp", "maxwell.hpp"]:
            self.assertEqual((self.folder / "timed" / name).read_text(), (self.folder / "untimed" / name).read_text())
        timings = json.loads(self.dashpot("compile", "kelvin.json", "--timings", "json").stderr)["timings"]
        self.assertEqual(list(timings), stages)
        self.assertAlmostEqual(timings.pop("total"), sum(timings.values()), delta=1e-12)

    def test_the_timings_of_two_axes(self):
        """Fails if a stage that two axes or several ports go through too is counted under another."""
        two_axes = SOURCE / "networks/axes/kelvin_field.json"
        for networks in ([two_axes], ["ports.json"]):
            self.write("ports.json", json.dumps({"dashpot": 1, "name": "ports", "ports": [
                {"name": "left", "network": {"spring": 20}}, {"name": "right", "network": {"damper": 0.5}}]}))
            told = self.dashpot("compile", *networks, "--timings", "json", "-o", "timed").stderr
            timings = json.loads(next(line for line in told.splitlines() if line.startswith("{")))["timings"]
            for stage in ["front end", "normal form", "decomposition", "discretisation", "certificate", "emission"]:
                self.assertGreater(timings[stage], 0, stage)

    def test_the_rate(self):
        """Fails if the period in the code is not that of --rate, or of the device."""
        self.dashpot("compile", "kelvin.json", "--rate", "4000")
        self.assertIn("sample_period = 0.00025;", (self.folder / "kelvin.hpp").read_text())
        self.dashpot("compile", "kelvin.json", "--device", PANTOGRAPH, "--uncertified")
        self.assertIn("sample_period = 0.0001;", (self.folder / "kelvin.hpp").read_text())

    def test_no_advice(self):
        """Fails if without advice anything but notes is left out, or the search for what would help goes on."""
        single = SOURCE / "runtime/devices/phantom_single_motor.json"
        field = [SOURCE / "networks/axes/kelvin_field.json", "--set", "B=4 N s/m",
                 "--device", SOURCE / "runtime/devices/pantograph_2dof.json"]
        for words in [["compile", FIG_5, "--device", PANTOGRAPH, "--decomposition", "paper"],  # errs more than need be
                      ["compile", "kelvin.json", "--device", single],  # lacks damping
                      ["compile", "kelvin.json", "--device", single, "--uncertified"],
                      ["compile", *field],
                      ["check", "kelvin.json", "--device", single],
                      ["run", "kelvin.json", "--device", single, "--fast", "--for", "0.01"],
                      ["report", FIG_5, "--device", PANTOGRAPH, "--decomposition", "paper", "-o", "page.html"],
                      ["explain", FIG_5, "--device", PANTOGRAPH, "--decomposition", "paper"],
                      ["explain", "kelvin.json", "--device", single]]:  # says which commands do
            with self.subTest(words=words):
                advised = self.dashpot(*words, status=None)
                written = {name: (self.folder / name).read_bytes() for name in self.files()}
                brief = self.dashpot(*words, "--no-advice", status=None)
                self.assertEqual((brief.returncode, brief.stdout), (advised.returncode, advised.stdout))
                self.assertEqual({name: (self.folder / name).read_bytes() for name in self.files()}, written)
                self.assertRegex(advised.stderr, "would |it deviates by")
                self.assertNotRegex(brief.stderr, "would |it deviates by")
                said = [[line for line in done.stderr.splitlines() if re.search("(error|warning): ", line)]
                        for done in (advised, brief)]
                self.assertTrue(said[0])
                self.assertEqual(*said)

    def test_nothing_is_written_unless_everything_succeeds(self):
        """Fails if one bad network among several leaves files behind, or harms those of an earlier run."""
        self.dashpot("compile", "kelvin.json", "-o", "out")
        before = (self.folder / "out/kelvin.hpp").read_bytes()
        self.refused("compile", "kelvin.json", "broken.json", "maxwell.json", "--rate", "500", "-o", "out", "--depfile",
                     "out/d", code="negative-stiffness")
        self.assertEqual(self.files("out"), ["kelvin.hpp"])
        self.assertEqual((self.folder / "out/kelvin.hpp").read_bytes(), before)

    def test_nothing_is_written_when_one_place_is_taken(self):
        """Fails if a folder in the place of the second file leaves the first one half done."""
        (self.folder / "out/maxwell.hpp").mkdir(parents=True)
        self.refused("compile", "kelvin.json", "maxwell.json", "-o", "out", code="cannot-write-file")
        # else a folder of that name would be there
        for options in [["-o", "law.hpp"], ["-o", "law.h", "--target", "c99"]]:
            self.refused("compile", "kelvin.json", *options, code="output-like-a-file")
            self.assertFalse((self.folder / options[1]).exists())
        (self.folder / "made.hpp").mkdir()
        self.dashpot("compile", "kelvin.json", "-o", "made.hpp")
        self.assertEqual(self.files("out"), [])

    def test_files_are_replaced_whole(self):
        """Fails if somebody who reads the old header meanwhile sees it change under their eyes."""
        self.dashpot("compile", "kelvin.json")
        header, kept = self.folder / "kelvin.hpp", self.folder / "kept.hpp"
        os.link(header, kept)
        before = kept.read_bytes()
        self.dashpot("compile", "kelvin.json", "--rate", "4000")
        self.assertEqual(kept.read_bytes(), before)
        self.assertNotEqual(header.read_bytes(), before)
        self.assertEqual([name for name in self.files() if ".new" in name], [])

    def test_a_folder_that_cannot_be_written(self):
        """Fails if an output folder that is none is a defect, or passes."""
        self.write("a_file", "")
        for folder in ["a_file", "a_file/below", "/proc/dashpot"]:
            self.refused("compile", "kelvin.json", "-o", folder, code="cannot-write-file")

    def test_a_depfile_that_cannot_be_written(self):
        """Fails if headers are written although the whole does not succeed."""
        self.refused("compile", "kelvin.json", "-o", "out", "--depfile", "kelvin.json/d", code="cannot-write-file")
        self.assertEqual(self.files("out"), [])

    def test_what_the_system_says(self):
        """Fails if a full disk, a file in the place of a folder or a folder in the place of a file are reported
        alike."""
        (self.folder / "folder").mkdir()
        for target, reason in [("/dev/full", "No space left on device"), ("kelvin.json/c", "Not a directory"),
                               ("folder", "Is a directory")]:
            told = self.refused("compile", "kelvin.json", "-o", "out", "--certificate", target,
                                code="cannot-write-file").stderr
            self.assertIn(f"cannot write '{target}': {reason} [cannot-write-file]", told)

    def test_a_certificate_that_cannot_be_written(self):
        """Fails if a header is left whose certificate is not written, or takes the place of one that has its own."""
        for target in ["/dev/full", "kelvin.json/c", "."]:
            self.refused("compile", "kelvin.json", "-o", "out", "--certificate", target, code="cannot-write-file")
            self.assertEqual(self.files("out"), [])
        self.dashpot("compile", "kelvin.json", "-o", "out", "--certificate", "c.json")
        before = (self.folder / "out/kelvin.hpp").read_bytes()
        self.refused("compile", "kelvin.json", "-o", "out", "--rate", "4000", "--certificate", "/dev/full",
                     code="cannot-write-file")
        self.assertEqual((self.folder / "out/kelvin.hpp").read_bytes(), before)
        self.assertEqual(self.files("out"), ["kelvin.hpp"])

    def test_a_file_that_may_not_grow(self):
        """Fails if a limit on the size of files ends the command without a word, or leaves a part of a file."""
        def narrow():
            resource.setrlimit(resource.RLIMIT_FSIZE, (1024, 1024))

        for arguments in (["compile", "-o", "out"], ["compile", "--target", "python", "-o", "out"],
                          ["report", "-o", "out/page.html"]):
            done = subprocess.run([DASHPOT, *arguments, "kelvin.json"], cwd=self.folder, preexec_fn=narrow,
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, INPUT_REFUSED, done.stderr)
            self.assertIn("File too large [cannot-write-file]", done.stderr)
            self.assertFalse((self.folder / "out").exists())

    def test_an_interrupt_leaves_nothing_unfinished(self):
        """Fails if a file that nobody asked for stays behind where writing is interrupted."""
        os.mkfifo(self.folder / "pipe")
        for signal_number in [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]:
            waiting = subprocess.Popen([DASHPOT, "compile", "kelvin.json", "-o", "out", "--certificate", "pipe"],
                                       cwd=self.folder)
            self.addCleanup(waiting.kill)
            while not self.files("out"):  # then the certificate waits for somebody who reads the pipe
                self.assertIsNone(waiting.poll())
                time.sleep(0.01)
            self.assertEqual(self.files("out"), [f"kelvin.hpp.new{waiting.pid}"])
            waiting.send_signal(signal_number)
            self.assertEqual(waiting.wait(60), -signal_number)
            self.assertEqual(self.files("out"), [])

    def test_two_networks_of_one_name(self):
        """Fails if one header silently takes the place of another."""
        self.write("other.json", KELVIN)
        self.refused("compile", "kelvin.json", "other.json", code="same-output")
        self.assertNotIn("kelvin.hpp", self.files())

    def test_own_templates(self):
        """Fails if --templates is ignored, or a folder without templates passes."""
        for template in ["network.hpp.in", "network_test.cpp.in", "batch.hpp.in"]:
            text = (SOURCE / "templates" / template).read_text()
            self.write(f"own/{template}", text.replace("#pragma once", "#pragma once  // ours"))
        self.dashpot("compile", "kelvin.json", "--templates", "own", "--batch")
        for header in ["kelvin.hpp", "kelvin_batch.hpp"]:
            self.assertIn("#pragma once  // ours", (self.folder / header).read_text())
        (self.folder / "empty").mkdir()
        self.refused("compile", "kelvin.json", "--templates", "empty", code="cannot-read-file")


class Repetition(CommandTest):
    def compiled(self, *arguments, cwd):
        self.dashpot("compile", *arguments, "--with-test", cwd=cwd)
        return {path.name: path.read_bytes() for path in cwd.glob("second_order_maxwell*")}

    def test_equal_input_gives_equal_bytes(self):
        """Fails if dates, paths, the working folder or a run before find their way into the code."""
        first, second = self.folder / "first", self.folder / "deeper/second"
        first.mkdir()
        second.mkdir(parents=True)
        (second / "copy.json").write_bytes(FIG_5.read_bytes())
        output = self.compiled(FIG_5, cwd=first)
        self.assertEqual(len(output), 2)
        self.assertEqual(self.compiled(FIG_5, cwd=first), output)
        self.assertEqual(self.compiled("copy.json", cwd=second), output)
        for text in output.values():
            self.assertNotIn(str(self.folder).encode(), text)
            self.assertNotIn(str(SOURCE).encode(), text)

    def test_the_locale_does_not_matter(self):
        """Fails if numbers are written with the user's decimal comma."""
        plain = self.compiled(FIG_5, cwd=self.folder)
        for locale in ["de_DE.UTF-8", "C", "POSIX"]:
            self.dashpot("compile", FIG_5, env={**os.environ, "LC_ALL": locale})
            self.assertEqual((self.folder / "second_order_maxwell.hpp").read_bytes(), plain["second_order_maxwell.hpp"])


class Print(CommandTest):
    def test_every_stage(self):
        """Fails if a stage cannot be shown, or showing it writes files."""
        for stage, word in {"network": "spring K1", "linear": "relaxation rate", "decomposition": "chosen",
                            "law": "static_stiffness", "certificate": "certificate"}.items():
            self.assertIn(word, self.dashpot("compile", FIG_5, "--print", stage).stdout)
        self.assertEqual(self.files(), [])

    def test_nothing_is_shown_of_a_refused_network(self):
        """Fails if a tool that reads the stage gets half of it."""
        self.write("broken.json", BROKEN)
        self.refused("compile", FIG_5, "broken.json", "--print", "linear", code="negative-stiffness")


def rule_of(depfile):
    """Targets and prerequisites of a makefile with one rule, with make's escapes resolved."""
    targets, prerequisites = depfile.read_text().replace("\\\n", " ").split(": ", 1)
    words = [text.replace("\\ ", "\0").replace("\\#", "#").replace("$$", "$").split()
             for text in (targets, prerequisites)]
    return [[word.replace("\0", " ") for word in side] for side in words]


class Depfile(CommandTest):
    def test_names_what_the_output_depends_on(self):
        """Fails if a change of network, device or template does not lead to a new header."""
        self.write("kelvin.json", KELVIN)
        self.dashpot("compile", "kelvin.json", FIG_5, "--device", PANTOGRAPH, "--templates", SOURCE / "templates",
                     "--uncertified", "--with-test", "-o", "out", "--depfile", "out/dashpot.d")
        targets, prerequisites = rule_of(self.folder / "out/dashpot.d")
        self.assertEqual(targets, ["out/kelvin.hpp", "out/kelvin_test.cpp", "out/second_order_maxwell.hpp",
                                   "out/second_order_maxwell_test.cpp"])
        self.assertEqual(prerequisites, ["kelvin.json", str(FIG_5), str(PANTOGRAPH),
                                         str(SOURCE / "templates/network.hpp.in"),
                                         str(SOURCE / "templates/network_test.cpp.in")])

    def test_names_the_templates_of_two_axes(self):
        """Fails if a change of the template of a law of two axes does not lead to a new header, or that of another
        always does."""
        field = SOURCE / "networks/axes/kelvin_field.json"
        for target, shapes in [("cpp", ["axes.hpp.in", "axes_test.cpp.in"]), ("c99", ["axes.h.in"])]:
            self.dashpot("compile", field, "--templates", SOURCE / "templates", "--target", target, "-o", "out",
                         "--depfile", "d")
            self.assertEqual(rule_of(self.folder / "d")[1],
                             [str(field), *(str(SOURCE / "templates" / shape) for shape in shapes)])

    def test_make_understands_it(self):
        """Fails if make does not rebuild when a network with a difficult name changes, or rebuilds when nothing did."""
        self.write("my $ tissue #1.json", KELVIN)
        self.dashpot("compile", "my $ tissue #1.json", "-o", "out put", "--depfile", "d")
        self.write("Makefile", "include d\nout\\ put/kelvin.hpp:\n\t@echo rebuild\n")
        make = ["make", "-s", "-f", "Makefile", "out put/kelvin.hpp"]
        run = lambda: subprocess.run(make, cwd=self.folder, capture_output=True, text=True)
        os.utime(self.folder / "my $ tissue #1.json", (1, 1))
        self.assertNotIn("rebuild", run().stdout)
        os.utime(self.folder / "out put/kelvin.hpp", (0, 0))
        done = run()
        self.assertIn("rebuild", done.stdout, done.stderr)


if __name__ == "__main__":
    unittest.main()
