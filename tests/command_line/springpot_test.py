"""Springpots whose stiffness changes while they run: a ladder whose springs and dampers all follow one parameter."""
import csv
import io
import math
import os
import re
import subprocess
import unittest

from dashpot_command import SOURCE, CommandTest

NETWORK = SOURCE / "networks/tunable/springpot_tunable.json"
RATE = 1000

DRIVER = """#include <cstdio>
#include "springpot_tunable.hpp"
int main() {
  dashpot::generated::springpot_tunable tissue;
  double t, u, k, last = 0;
  bool first = true;
  std::scanf("%*[^\\n]");
  while (std::scanf("%lf,%lf,%lf", &t, &u, &k) == 3) {
    tissue.set({k});
    const double v = first ? 0 : (u - last) * 1000;
    first = false;
    last = u;
    const auto c = tissue.step(u, v);
    std::printf("%.17g\\n", c.damping * v + c.force);
  }
}
"""


def motion(stiffness, rows=1500):
    """Two sines; `stiffness` of each row's time."""
    lines = ["time,position,K"]
    for i in range(rows):
        t = i / RATE
        lines.append(f"{t!r},{2e-3 * math.sin(5 * t) + 1e-3 * math.sin(31 * t)!r},{stiffness(t)!r}")
    return "\n".join(lines) + "\n"


class Springpot(CommandTest):
    def forces(self, network, text):
        self.write("motion.csv", text)
        done = self.dashpot("simulate", network, "--input", "motion.csv")
        return [float(row["force"]) for row in csv.DictReader(io.StringIO(done.stdout))]

    def constant(self, stiffness):
        text = NETWORK.read_text().replace(
            '"K": { "value": "120 N/m", "tunable": true, "min": "0 N/m", "max": "400 N/m" }',
            f'"K": "{stiffness} N/m"')
        return self.write("constant.json", text)

    def test_is_the_springpot_of_its_value(self):
        """Fails if a value set from the first row on gives another springpot than a file that states it."""
        for stiffness in (0.0, 55.0, 120.0, 400.0):
            with self.subTest(stiffness):
                text = motion(lambda t: stiffness)
                tuned, stated = self.forces(NETWORK, text), self.forces(self.constant(stiffness), text)
                peak = max(map(abs, stated))
                # Decays are worked out in double while it runs, and in extended precision where nothing changes.
                self.assertLess(max(abs(a - b) for a, b in zip(tuned, stated, strict=True)), 1e-10 * peak)

    def test_emitted_code_is_what_simulate_runs(self):
        """Fails if the emitted class answers other bits than simulate while the stiffness changes."""
        text = motion(lambda t: 200 + 190 * math.sin(2 * t))
        forces = self.forces(NETWORK, text)
        self.dashpot("compile", NETWORK, "--rate", RATE, "-o", ".")
        self.write("main.cpp", DRIVER)
        subprocess.run([os.environ.get("CXX", "c++"), "-std=c++17", "-O1", "-ffp-contract=off",
                        f"-I{SOURCE}/runtime/include", "main.cpp", "-o", "main"], cwd=self.folder, check=True)
        printed = subprocess.run(["./main"], cwd=self.folder, input=text, capture_output=True, text=True, check=True)
        self.assertEqual([float(line) for line in printed.stdout.split()], forces)

    def test_certificate_is_verified(self):
        """Fails if the shares of the parameter in the header are not what the checker works out, or one of them may
        be."""
        self.dashpot("compile", NETWORK, "--rate", RATE, "-o", ".", "--certificate", "certificate.json")
        header = self.folder / "springpot_tunable.hpp"
        self.dashpot("verify", "certificate.json", header, "--allow-uncertified")
        text = header.read_text()
        place = re.search(r"_share = \d+\.\d", text).end()
        digit = "1" if text[place] != "1" else "2"
        header.write_text(text[:place] + digit + text[place + 1:])
        self.refused("verify", "certificate.json", header, "--allow-uncertified", code="constant-wrong")

    def test_stiffness_alone_may_be_tunable(self):
        """Fails if a tunable exponent, time, band or error passes."""
        text = NETWORK.read_text()
        for was, now in (('0.3, "time"', '"K", "time"'), ('"1 s"', '"K"'), ('"0.1 Hz"', '"K"'), ('"2 %"', '"K"')):
            with self.subTest(was):
                self.write("bad.json", text.replace(was, now))
                done = self.dashpot("check", "bad.json", status=1)
                self.assertIn("[parameter-of-wrong-unit]", done.stderr)


if __name__ == "__main__":
    unittest.main()
