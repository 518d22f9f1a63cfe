#!/usr/bin/env python3
"""maps_table.py DASHPOT: instructions a step behind a map, emitted and as somebody writes it who knows the map.

Hertz' contact before a spring, a damper and one relaxation, with the map's root of a root; the same network without a
curve; and the paper's Kelvin element along both axes of a five-bar arm, with the C library's sine and cosine. Both make
the same commands: that is checked first. Counted by callgrind, of a function that calls the law's step and keeps what
it answers, with the functions that the step calls; g++ -O2.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
ARM = SOURCE / "runtime/devices/pantograph_2dof.json"
STEPS = 1000
KELVIN = {"parallel": [{"spring": "400 N/m"}, {"damper": "2 N s/m"},
                       {"series": [{"spring": "200 N/m"}, {"damper": "40 N s/m"}]}]}
HERTZ = {"power": 1.5, "force": "2 N", "at": "5 mm"}

# What both programs of one axis begin with: 1 kHz, states below 6e-61 are 0, and NaN and infinity leave them alone.
HAND = """#include <cmath>
#include <dashpot/command.hpp>
struct by_hand {
  double force = 0, last = 0;
  static inline const double decay = std::exp(-200.0 / 40 * 1e-3), drive = 40 / 1e-3 * (1 - decay);
  dashpot::command<double> step(double u, double v) {
    BEHIND
    const double change = w - last, mode = decay * (std::abs(force) > 6e-61 ? force : 0) + drive * change;
    const double m = tangent * (400 * w + mode);
    if (!std::isfinite(m + v)) return {brake, 0};
    last = w, force = mode;
    return {brake, m};
  }
};
"""
ON_CURVE = """static const double scale = std::sqrt(4 * (2 / std::pow(5e-3, 1.5)) / (5 * 400));
    const double size = std::abs(u), root = std::sqrt(std::sqrt(size)), w = std::copysign(scale * size * root, u);
    const double tangent = 1.25 * scale * root, brake = 2 * tangent * tangent;"""
STRAIGHT = "const double w = u, tangent = 1, brake = 2;"

# The tip from the elbows, the Jacobian from its inverse, whose rows are d_i/(d_i . E_i'); B* = B J^T J.
ARM_BY_HAND = """#include <algorithm>
#include <cmath>
#include <dashpot/command.hpp>
struct by_hand {
  double last[2] = {};
  dashpot::commands<double, 2, 2> step(const double (&q)[2], const double (&v)[2]) {
    constexpr double l1 = 63e-3, l2 = 75e-3, base = 25e-3, k = 100, b = 1, most = MOST, added = ADDED;
    const double c[] = {std::cos(q[0]), std::cos(q[1])}, s[] = {std::sin(q[0]), std::sin(q[1])};
    const double ex[] = {l1 * c[0] - base / 2, l1 * c[1] + base / 2}, ey[] = {l1 * s[0], l1 * s[1]};
    const double ax = ex[1] - ex[0], ay = ey[1] - ey[0], reach = std::sqrt(l2 * l2 / (ax * ax + ay * ay) - 0.25);
    const double x = ex[0] + ax / 2 - ay * reach, y = ey[0] + ay / 2 + ax * reach;
    double row[2][2];
    for (int i = 0; i < 2; ++i) {
      const double dx = x - ex[i], dy = y - ey[i], by = l1 * (dy * c[i] - dx * s[i]);
      row[i][0] = dx / by, row[i][1] = dy / by;
    }
    const double det = row[0][0] * row[1][1] - row[0][1] * row[1][0];
    const double j[2][2] = {{row[1][1] / det, -row[0][1] / det}, {-row[1][0] / det, row[0][0] / det}};
    const double fx = k * x, fy = k * (y - 100e-3);
    const double b11 = b * (j[0][0] * j[0][0] + j[1][0] * j[1][0]), b22 = b * (j[0][1] * j[0][1] + j[1][1] * j[1][1]),
                 b12 = b * (j[0][0] * j[0][1] + j[1][0] * j[1][1]);
    const double d[] = {std::min(b11, most), std::min(b22, most)};
    const double t[] = {j[0][0] * fx + j[1][0] * fy + (b11 - d[0]) * v[0] + b12 * v[1],
                        j[0][1] * fx + j[1][1] * fy + b12 * v[0] + (b22 - d[1]) * v[1]};
    if (!std::isfinite(t[0] + t[1] + v[0] + v[1])) return {{last[0], last[1]}, {0, 0}};
    last[0] = d[0] + added, last[1] = d[1] + added;
    return {{last[0], last[1]}, {t[0], t[1]}};
  }
};
"""
ONE_AXIS = """
CLASS law;
static dashpot::command<double> now;
extern "C" [[gnu::noinline]] void one_step(double u, double v) { now = law.step(u, v); }
int main() {
  for (int n = 0; n < STEPS; ++n) one_step(4e-3 * std::sin(0.01 * n), 1e-3), std::printf("%.17g %.17g\\n", now.damping, now.force);
}
"""
TWO_AXES = """
CLASS law;
static dashpot::commands<double, 2, 2> now;
extern "C" [[gnu::noinline]] void one_step(double a, double b) {
  const double q[] = {a, b}, v[] = {0.1, -0.2};
  now = law.step(q, v);
}
int main() {
  for (int n = 0; n < STEPS; ++n) {
    one_step(1.9 + 0.1 * std::sin(0.01 * n), 1.2 + 0.1 * std::cos(0.013 * n));
    std::printf("%.17g %.17g %.17g %.17g\\n", now.damping[0], now.damping[1], now.torque[0], now.torque[1]);
  }
}
"""


def ran(*command, **more):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, **more)
    if done.returncode != 0:
        sys.exit(f"{command}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


class Program:
    """A law with a main() around it: what it answers, and what a step takes."""

    def __init__(self, folder, law, name, body):
        source = folder / "law.cpp"
        source.write_text("#include <cmath>\n#include <cstdio>\n" + law +
                          body.replace("CLASS", name).replace("STEPS", str(STEPS)))
        program = folder / "law"
        ran("g++", "-std=c++20", "-O2", "-ffp-contract=off", "-I", SOURCE / "runtime/include", "-I", folder, source,
            "-o", program)
        self.answers = [float(number) for number in ran(program).split()]
        said = ran("valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out", "--toggle-collect=one_step",
                   program)
        self.instructions = int(re.search(r"Collected : (\d+)", said)[1]) / STEPS


def row(what, emitted, by_hand, within):
    """`within`: of the largest answer, what both may be apart by, brakes and motors."""
    kinds = len(emitted.answers) // STEPS
    for kind in range(kinds):
        pairs = list(zip(emitted.answers[kind::kinds], by_hand.answers[kind::kinds]))
        allowed = within[2 * kind // kinds]
        if max(abs(x - y) for x, y in pairs) > allowed * max(abs(y) for _, y in pairs):
            sys.exit(f"{what}: emitted and by hand are two laws")
    print(f"| {what} | {emitted.instructions:.0f} | {by_hand.instructions:.0f} | "
          f"{emitted.instructions / by_hand.instructions:.2f} |")


def main():
    dashpot = pathlib.Path(sys.argv[1]).resolve()
    print("| instructions a step | emitted | by hand | ratio |\n| --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def emitted(network, *options):
            ran(dashpot, "compile", network, *options, "-o", folder)

        for what, static, behind, within in [
                ("a Kelvin and a Maxwell element", None, STRAIGHT, (1e-12, 1e-12)),
                # Where the curve begins a straight slope stands for a fourth root: the tool passes there quickly.
                ("the same behind Hertz' curve", HERTZ, ON_CURVE, (0.1, 0.05))]:
            law = {"dashpot": 1, "name": "solid", "network": KELVIN, **({"static": static} if static else {})}
            (folder / "solid.json").write_text(json.dumps(law))
            emitted(folder / "solid.json", "--decomposition", "velocity-free")
            row(what, Program(folder, '#include "solid.hpp"\n', "dashpot::generated::solid", ONE_AXIS),
                Program(folder, HAND.replace("BEHIND", behind), "by_hand", ONE_AXIS), within)
        emitted(SOURCE / "networks/axes/kelvin_field.json", "--device", ARM)
        header = (folder / "kelvin_field.hpp").read_text()
        most, added = (re.search(rf" {name}_damping_1 = ([^;]+);", header)[1] for name in ["most", "added"])
        row("Kelvin elements along both axes of a five-bar",
            Program(folder, '#include "kelvin_field.hpp"\n', "dashpot::generated::kelvin_field", TWO_AXES),
            Program(folder, ARM_BY_HAND.replace("MOST", most).replace("ADDED", added), "by_hand", TWO_AXES),
            (1e-11, 1e-11))


if __name__ == "__main__":
    main()
