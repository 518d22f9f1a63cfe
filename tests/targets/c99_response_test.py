"""What `--target c99 --with-test` writes: a program in C that tests a law against the closed forms of its network.

The environment names DASHPOT, DASHPOT_SOURCE, GCC and CLANG.
"""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["DASHPOT_SOURCE"])
DASHPOT = os.environ["DASHPOT"]
IS_LONG = os.environ.get("DASHPOT_LONG") == "1"
COMPILERS = [os.environ["GCC"], os.environ["CLANG"]]
STRICT = ["-std=c99", "-O2" if IS_LONG else "-O1", "-ffp-contract=off", "-pedantic", "-Wall", "-Wextra",
          "-Wconversion", "-Wshadow", "-Wdouble-promotion", "-Werror"]
NETWORKS = [*sorted((SOURCE / "networks/paper").glob("*.json")),
            SOURCE / "networks/tunable/second_order_maxwell_tunable.json"]


class C99Response(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def written(self, network, *options):
        command = [DASHPOT, "compile", network, "--target", "c99", "--with-test", "-o", self.folder, *options]
        subprocess.run(command, check=True, capture_output=True)

    def ran(self, name, compiler):
        program = self.folder / "program"
        source = self.folder / f"{name}_test.c"
        built = subprocess.run([compiler, *STRICT, f"-I{self.folder}", source, "-lm", "-o", program],
                               capture_output=True, text=True)
        self.assertEqual(built.returncode, 0, f"{compiler}, {name}: {built.stderr}")
        return subprocess.run([program], capture_output=True, text=True)

    def test_laws_pass(self):
        """Fails if the test of a law that is right does not build without a warning, or does not pass."""
        device = ["--device", SOURCE / "runtime/devices/pantograph_brake_2009.json", "--uncertified", "--no-advice"]
        for options in [[], ["--scalar", "float"], device]:
            for network in NETWORKS:
                with self.subTest(network=network.stem, options=options[:2]):
                    self.written(network, *options)
                    # The second compiler reads each test once: in float and on a device only numbers are others.
                    for compiler in COMPILERS if IS_LONG or not options else COMPILERS[:1]:
                        ran = self.ran(network.stem, compiler)
                        self.assertEqual((ran.returncode, ran.stdout), (0, f"{network.stem}: passed\n"))

    def test_name_of_a_network_is_free(self):
        """Fails if a network cannot be called what the test of it calls something of its own."""
        network = SOURCE / "networks/paper/second_order_maxwell.json"
        self.written(network, "--name", "plain")
        text = (self.folder / "plain_test.c").read_text()
        declared = re.findall(r"\b(?:double|int|scalar|test_law|void) \*?([a-z]\w*)", text)
        own = {name for name in declared if not re.match("plain|test_|(main|scalar|force|velocity)$", name)}
        self.assertGreater(own, {"ramp", "rate", "value", "law"})
        for name in sorted(own):
            with self.subTest(name=name):
                self.written(network, "--name", name)
                built = subprocess.run([COMPILERS[0], "-std=c99", "-fsyntax-only", "-Werror",
                                        self.folder / f"{name}_test.c"], capture_output=True, text=True)
                self.assertEqual(built.returncode, 0, built.stderr)

    def test_wrong_law_fails(self):
        """Fails if the test passes for a law whose numbers are off by some millionths, one at a time."""
        name = "second_order_maxwell"
        self.written(SOURCE / f"networks/paper/{name}.json")
        header = self.folder / f"{name}.h"
        text = header.read_text()
        step = text[text.index(f"{name}_output("):text.index(f"int {name}_is_within(")]
        # Not those below 1e-30: what is too small to be kept.
        tiny = set(re.findall(r"\d+\.\d+e-[3-9]\d", step))
        numbers = sorted(set(re.findall(r"(?<![\w.])\d+\.\d{6,}(?:e-?\d+)?", step)) - tiny)
        self.assertGreaterEqual(len(numbers), 4)
        for number in numbers:
            header.write_text(text.replace(step, step.replace(number, repr(float(number) * (1 + 4e-6)))))
            ran = self.ran(name, COMPILERS[0])
            self.assertEqual(ran.returncode, 1, f"{number} is not looked at")
            self.assertIn(f"{name}: failed", ran.stdout)


if __name__ == "__main__":
    unittest.main()
