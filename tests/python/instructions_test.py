"""Many samples from Python cost what they cost in C: instructions counted by valgrind, of which no machine is
quicker or slower."""
import re
import subprocess
import sys
import unittest

from emitted import FIG_5, PackageTest, dashpot

ROWS = 200000

# The loop that somebody writes in C, with the same columns read and written.
C_LOOP = """
#include <math.h>
#include <stdlib.h>
#include "{name}.h"
int main(int count, char **words) {
  (void)words;
  enum { rows = {rows} };
  double *const u = malloc(rows * sizeof *u), *const v = malloc(rows * sizeof *v), *const f = malloc(rows * sizeof *f);
  double *const b = malloc(rows * sizeof *b), *const m = malloc(rows * sizeof *m);
  for (int k = 0; k < rows; ++k) u[k] = 1e-3 * (k % 1000) * 1e-3;
  {name} law;
  {name}_init(&law);
  for (int run = 0; run < count; ++run) {
    {name}_reset(&law, 0);
    double last = 0;
    for (int k = 0; k < rows; ++k) {
      v[k] = k == 0 ? 0 : (u[k] - last) * {name}_RATE;
      last = u[k];
      const dashpot_command now = {name}_step(&law, u[k], v[k]);
      b[k] = now.damping;
      m[k] = now.force;
      f[k] = now.damping * v[k] + now.force;
    }
  }
  return isfinite(f[rows - 1]) ? 0 : 1;
}
"""
PYTHON_LOOP = """
import sys
import numpy
import {name}
law = {name}.Law()
u = 1e-3 * (numpy.arange({rows}) % 1000) * 1e-3
for run in range(len(sys.argv)):
    response = law.simulate(u)
"""


class Instructions(PackageTest):
    def counted(self, *command):
        done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={self.folder / 'out'}",
                               *map(str, command)],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return int(re.search(r"Collected : (\d+)", done.stderr)[1])

    def one_run(self, *command):
        """Of nine runs less one: what begins and ends the program is in both, and differs by half a run in Python."""
        return (self.counted(*command, *["again"] * 8) - self.counted(*command)) / 8

    def test_a_recording(self):
        """Fails if a recording of 200,000 samples costs more than a tenth beyond the same loop in C."""
        for network in [FIG_5]:
            name = network.stem
            dashpot("compile", network, "--target", "python", "-o", self.folder)
            package = self.folder / name
            for file, text in [("loop.c", C_LOOP), ("loop.py", PYTHON_LOOP)]:
                (self.folder / file).write_text(text.replace("{name}", name).replace("{rows}", str(ROWS)))
            subprocess.run(["cc", "-std=c99", "-O2", "-ffp-contract=off", f"-D{name}_RATE=1000.0", f"-I{package}",
                            "loop.c", "-o", "loop"],
                           cwd=self.folder, check=True)
            in_c, in_python = self.one_run("./loop"), self.one_run(sys.executable, "-B", "loop.py")
            print(f"instructions per step of {name}: {in_c / ROWS:.1f} in C, {in_python / ROWS:.1f} from Python, "
                  f"{in_python / in_c:.3f} times")
            self.assertGreater(in_c, 10 * ROWS)
            self.assertLess(in_python, 1.1 * in_c)


if __name__ == "__main__":
    unittest.main()
