"""Networks of two axes in the commands that take them: the emitted code and simulate to the bit, closed forms,
energy."""
import json
import math
import random
import re
import shutil
import struct
import subprocess
import unittest

from dashpot_command import COMMAND_LINE_WRONG, INPUT_REFUSED, SOURCE, CommandTest

FIELD, BALL, WALL = (SOURCE / f"networks/axes/{name}.json" for name in ["kelvin_field", "soft_ball", "viscous_wall"])
PANTOGRAPH = SOURCE / "runtime/devices/pantograph_2dof.json"
ONE_AXIS = SOURCE / "runtime/devices/pantograph_brake_2009.json"
LINK, DISTAL, BASE = 0.063, 0.075, 0.025  # of PANTOGRAPH [m]
# A tenth of the area of its workspace, which is searched in a third of the time.
NEAR = {"x": ["-12 mm", "12 mm"], "y": ["90 mm", "105 mm"]}
PERIOD = 1e-4
ADVISING = ("check", "compile", "explain", "report", "run")

# Reads rows of q1, q2, v1, v2 and writes what the law answers; then its energy and what a refused sample gets.
DRIVER = r"""
#include "%(name)s.hpp"
#include <cstdio>
#include <limits>
int main() {
  using law_type = dashpot::generated::%(name)s;
  using scalar = law_type::scalar;
  law_type law;
  law.reset();
  double row[4];
  while (std::scanf("%%lf %%lf %%lf %%lf", row, row + 1, row + 2, row + 3) == 4) {
    const scalar q[2] = {scalar(row[0]), scalar(row[1])}, v[2] = {scalar(row[2]), scalar(row[3])};
    const auto now = law.step(q, v);
    for (const scalar damping : now.damping) std::printf("%%.17g ", double(damping));
    std::printf("%%.17g %%.17g %%.17g\n", double(now.torque[0]), double(now.torque[1]), double(law.stored_energy()));
  }
  const scalar none = std::numeric_limits<scalar>::quiet_NaN(), q[2] = {none, 1}, v[2] = {0, 0};
  const auto refused = law.step(q, v);
  for (const scalar damping : refused.damping) std::printf("%%.17g ", double(damping));
  std::printf("%%.17g %%.17g %%.17g\n", double(refused.torque[0]), double(refused.torque[1]), double(law.stored_energy()));
}
"""


def near(device):
    """A five-bar's file with NEAR for its workspace, for tests in which it does not matter how far the arm goes."""
    arm = json.loads(device.read_text())
    arm["kinematics"]["workspace"] = NEAR
    return json.dumps(arm)


def tip_of(q):
    """Where two circles about the elbows meet, on the side of positive y: no formula of the compiler's."""
    left = (LINK * math.cos(q[0]) - BASE / 2, LINK * math.sin(q[0]))
    right = (LINK * math.cos(q[1]) + BASE / 2, LINK * math.sin(q[1]))
    apart = math.hypot(right[0] - left[0], right[1] - left[1])
    to_tip = math.atan2(right[1] - left[1], right[0] - left[0]) + math.acos(apart / 2 / DISTAL)
    return left[0] + DISTAL * math.cos(to_tip), left[1] + DISTAL * math.sin(to_tip)


def jacobian_of(q):
    """By Richardson's extrapolation of differences: good to about 1e-10 of the links."""
    def difference(j, h):
        ahead, behind = list(q), list(q)
        ahead[j] += h
        behind[j] -= h
        return [(a - b) / (2 * h) for a, b in zip(tip_of(ahead), tip_of(behind))]
    columns = [[(4 * fine - coarse) / 3 for fine, coarse in zip(difference(j, 5e-4), difference(j, 1e-3))]
               for j in range(2)]
    return columns


def joints_of(x, y):
    """By the law of cosines, elbows outward."""
    joints = []
    for side in (-1, 1):
        dx, dy = x - side * BASE / 2, y
        r = math.hypot(dx, dy)
        inner = math.acos((r * r + LINK * LINK - DISTAL * DISTAL) / (2 * r * LINK))
        joints.append(math.atan2(dy, dx) - side * inner)
    return joints


def motion_in_joints(count, seed):
    """A random walk of the tip through the workspace, as joint positions."""
    draw = random.Random(seed)
    x, y, vx, vy, rows = 0.0, 0.1, 0.0, 0.0, []
    for _ in range(count):
        vx, vy = (min(max(0.999 * v + draw.gauss(0, 0.05), -0.6), 0.6) for v in (vx, vy))
        x, y = x + PERIOD * vx, y + PERIOD * vy
        if abs(x) > 0.038:
            x, vx = math.copysign(0.038, x), -vx
        if not 0.072 < y < 0.118:
            y, vy = min(max(y, 0.072), 0.118), -vy
        rows.append(joints_of(x, y))
    return rows


class AxesTest(CommandTest):

    def dashpot(self, *arguments, advice=False, **more):
        """Without the search for what would help, unless that is asked for."""
        leave_out = ["--no-advice"] if arguments[0] in ADVISING and not advice else []
        return super().dashpot(*arguments, *leave_out, **more)

    def compile(self, network, *options):
        name = json.loads(network.read_text())["name"]
        self.dashpot("compile", network, "--uncertified", *options)
        self.write("driver.cpp", DRIVER % {"name": name})
        subprocess.run([shutil.which("g++") or "c++", "-std=c++17", "-O1", "-ffp-contract=off", "-Wall", "-Wextra",
                        "-Werror",
                        "-I", SOURCE / "runtime/include", "-I", ".", "driver.cpp", "-o", name], cwd=self.folder,
                       check=True)
        return self.folder / name

    def answers(self, program, rows):
        done = subprocess.run([program], input="".join(" ".join(map(repr, row)) + "\n" for row in rows), text=True,
                              capture_output=True, check=True)
        return [[float(word) for word in line.split()] for line in done.stdout.splitlines()]

    def rows(self, joints):
        """With slopes since the sample before as estimates."""
        before = [joints[0]] + joints[:-1]
        return [[*q, *((a - b) / PERIOD for a, b in zip(q, last))] for q, last in zip(joints, before)]

    def simulated(self, network, rows, *options):
        lines = [f"{i / 10000},{','.join(map(repr, row))}" for i, row in enumerate(rows)]
        self.write("motion.csv", "time,q1,q2,v1,v2\n" + "\n".join(lines) + "\n")
        text = self.dashpot("simulate", network, "--input", "motion.csv", *options).stdout.splitlines()
        self.assertEqual(text[0], "time,q1,q2,v1,v2,damping_1,damping_2,torque_1,torque_2")
        return [[float(word) for word in line.split(",")[5:]] for line in text[1:]]

    # If this fails, simulate shows something else than what runs on the device.
    def test_simulate_and_the_emitted_code_agree_to_the_bit(self):
        rows = self.rows(motion_in_joints(400, 1))
        single = lambda values: [struct.pack("f", value) for value in values]
        for network in (FIELD, BALL, WALL):
            for device in (["--device", PANTOGRAPH], ["--rate", "10000"]):
                # Each compilation takes a second: float once with the arm, and once without.
                for scalar in ("double", "float") if network == BALL else ("double",):
                    with self.subTest(network=network.stem, device=device, scalar=scalar):
                        same = single if scalar == "float" else list
                        program = self.compile(network, *device, "--scalar", scalar)
                        told = [same(row[:4]) for row in self.answers(program, rows)[:-1]]
                        self.assertEqual([same(row)
                                          for row in self.simulated(network, rows, *device, "--scalar", scalar)], told)

    # If this fails, simulate tells velocities and forces that are no numbers as if they were.
    def test_simulate_refuses_forces_beyond_all_numbers(self):
        for position, velocity in ((1e308, "inf"), (-1e308, "-inf")):
            self.write("motion.csv", f"time,q1,q2\n0,1,1\n0.0001,1,{position}\n")
            told = self.refused("simulate", FIELD, "--device", PANTOGRAPH, "--input", "motion.csv",
                                code="answer-not-finite").stderr
            self.assertIn(f"at 0.0001 s the force overflows: the position is {position:.4g} and the velocity "
                          f"{velocity};", told)

    # If this fails, a constant that reset() alone reads is not in the header: springs between two walls need no zero in
    # a sample.
    def test_two_walls_without_dampers(self):
        walls = [{"name": name, "map": {"wall": {"through": [0, f"{at} mm"], "normal": [0, side]}},
                  "contact": {"at": "0 mm"},
                  "network": {"spring": "150 N/m"}} for name, at, side in [("near", 94, 1), ("far", 96, -1)]]
        network = self.write("walls.json", json.dumps({"dashpot": 1, "axes": 2, "name": "walls", "ports": walls}))
        rows = self.rows(motion_in_joints(400, 3))
        told = [row[:4] for row in self.answers(self.compile(network, "--device", PANTOGRAPH), rows)[:-1]]
        self.assertTrue(any(abs(row[2]) > 1e-3 for row in told))
        self.assertEqual(self.simulated(network, rows, "--device", PANTOGRAPH), told)

    # If this fails, forces or dampings are not those of springs and dampers at the tip of the arm.
    def test_a_kelvin_field_is_one(self):
        rows = [[*q, 0.3, -0.2] for q in motion_in_joints(200, 2)]
        answers = self.answers(self.compile(FIELD, "--device", self.write("near.json", near(PANTOGRAPH))), rows)
        for (q1, q2, v1, v2), (d1, d2, t1, t2, stored) in zip(rows, answers):
            x, y = tip_of([q1, q2])
            first, second = jacobian_of([q1, q2])
            pull = [100 * x, 100 * (y - 0.1)]
            inner = lambda a, b: a[0] * b[0] + a[1] * b[1]
            added = [d1 - inner(first, first), d2 - inner(second, second)]
            # The differences are good to 1e-10 of links of 0.1 m, forces are up to 5 N.
            self.assertAlmostEqual(t1, inner(first, pull) + inner(first, second) * v2, delta=1e-9)
            self.assertAlmostEqual(t2, inner(second, pull) + inner(first, second) * v1, delta=1e-9)
            self.assertAlmostEqual(stored, 50 * (x * x + (y - 0.1) ** 2), delta=1e-12)
            for extra in added:
                self.assertGreater(extra, -1e-9)

    # If this fails, a ball pulls the tool along as it slides round it, which gives power for ever.
    def test_a_ball_has_no_tangential_force(self):
        rate, speed, radius = 10000, 10.0, 0.028
        rows = []
        for i in range(2000):
            angle = speed * i / rate
            rows.append([radius * math.sin(angle), 0.14 - radius * math.cos(angle),
                         speed * radius * math.cos(angle), speed * radius * math.sin(angle)])
        answers = self.answers(self.compile(BALL, "--rate", str(rate)), rows)
        for (x, y, vx, vy), (d1, d2, fx, fy, _) in zip(rows, answers[:-1]):
            # The brakes damp along x and y, and the motors what couples them.
            force = [fx + d1 * vx, fy + d2 * vy]
            tangential = (force[0] * (0.14 - y) + force[1] * x) / radius
            self.assertLess(abs(tangential), 1e-12 * math.hypot(*force) + 1e-15)
            self.assertLess(force[0] * x + force[1] * (y - 0.14), 0.0)

    # If this fails, some motion gets more work out of the law than was put in: between samples the motors hold their
    # torque, and the brakes turn at least (1 - tolerance) D dq^2/T_max into heat.
    def test_no_motion_gains_energy(self):
        tolerance, longest, own = 0.05, 1.5e-4, 50e-6
        for network in (FIELD, BALL, WALL):
            program = self.compile(network, "--device", PANTOGRAPH)
            for seed in range(3, 9):
                joints = motion_in_joints(3000, seed)
                if seed % 2:  # to and fro at half the rate, the hardest that there is
                    joints = [[a + (-1) ** i * 5e-4, b - (-1) ** i * 5e-4] for i, (a, b) in enumerate(joints)]
                rows = [[*q, 0.0, 0.0] for q in joints]  # an estimate that never comes
                answers = self.answers(program, rows)[:-1]
                work, paid = 0.0, 0.0
                for now, then, (d1, d2, t1, t2, _) in zip(joints, joints[1:], answers):
                    dq = [b - a for a, b in zip(now, then)]
                    heat = sum(((1 - tolerance) * d + own) * x * x / longest for d, x in zip((d1, d2), dq))
                    work += t1 * dq[0] + t2 * dq[1] + heat
                    paid += abs(t1 * dq[0]) + abs(t2 * dq[1]) + heat
                gained = answers[-2][4] - answers[0][4] - work
                self.assertLess(gained, 1e-12 * paid, f"{network.stem}, seed {seed}")

    # If this fails, a NaN or infinite sample moves the springs, or leaves the motors on.
    def test_a_refused_sample_changes_nothing(self):
        for network in (FIELD, BALL):
            *_, last, refused = self.answers(self.compile(network, "--device", PANTOGRAPH),
                                             self.rows(motion_in_joints(50, 9)))
            self.assertEqual(refused, [*last[:2], 0, 0, last[4]])

    # If this fails, a step of the simplest field costs more than a controller has time for.
    def test_a_kelvin_field_is_cheap(self):
        arm = json.loads(PANTOGRAPH.read_text())
        arm["kinematics"] = {"kind": "parallelogram", "links": ["100 mm", "100 mm"],
                             "workspace": {"x": ["-40 mm", "40 mm"], "y": ["90 mm", "150 mm"]}}
        arm["encoders"], arm["assumed"] = arm["encoders"][0], []
        del arm["encoders"]["range"]
        self.write("arm.json", json.dumps(arm))
        for device in ("arm.json", PANTOGRAPH):
            cost = json.loads(self.dashpot("explain", FIELD, "--device", device, "--json").stdout)["operations"]
            self.assertLessEqual(cost["output"] + cost["update"], 150)

    # If this fails, a law that knows the ranges of its joints is another one, or knows them for nothing.
    def test_ranges_of_joints_change_nothing_but_the_cost(self):
        around = [(0.02 * math.cos(0.01 * k), 0.095 + 0.02 * math.sin(0.017 * k)) for k in range(400)]
        links = {"links": ["63 mm", "75 mm"], "workspace": {"x": ["-20 mm", "20 mm"], "y": ["75 mm", "115 mm"]}}

        def of_links(x, y):  # of the two links, the elbow to the right
            far = math.hypot(x, y)
            first = math.atan2(y, x) - math.acos((far * far + LINK * LINK - DISTAL * DISTAL) / (2 * far * LINK))
            return first, math.atan2(y - LINK * math.sin(first), x - LINK * math.cos(first))
        # Ranges about every kind of middle: whole eighths of a turn, even and odd, of both signs, and the sum of two.
        for kind, joints, ranges in [
                ("five_bar", joints_of, [(50, 220), (-40, 130)]), ("five_bar", joints_of, [(80, 185), (0, 180)]),
                ("parallelogram", lambda x, y: list(of_links(x, y)), [(-60, 80), (60, 220)]),
                ("serial", lambda x, y: [of_links(x, y)[0], of_links(x, y)[1] - of_links(x, y)[0]],
                 [(0, 70), (60, 150)])]:
            arm = json.loads(PANTOGRAPH.read_text()) | {"assumed": []}
            arm["kinematics"] = {"kind": kind, **links} | ({"base": "25 mm"} if kind == "five_bar" else {})
            rows = self.rows([joints(x, y) for x, y in around])
            for low, high, at in [(*ranges[j], math.degrees(row[j])) for row in rows for j in range(2)]:
                self.assertTrue(low < at < high, (kind, at))
            answers, costs = [], []
            for stated in (None, ranges):
                for one, limits in zip(arm["encoders"], ranges):
                    one.pop("range", None)
                    if stated:
                        one["range"] = [f"{limit} deg" for limit in limits]
                self.write("arm.json", json.dumps(arm))
                answers.append(self.simulated(FIELD, rows, "--device", "arm.json"))
                cost = json.loads(self.dashpot("explain", FIELD, "--device", "arm.json", "--json").stdout)["operations"]
                costs.append(cost["output"])
            with self.subTest(kind=kind, ranges=ranges):
                self.assertLess(costs[1], costs[0] - 8)
                largest = [max(abs(row[i]) for row in answers[0]) for i in range(4)]
                for row, other in zip(*answers):
                    for i in range(4):
                        self.assertAlmostEqual(row[i], other[i], delta=2e-14 * largest[i])  # a hundred roundings

    # If this fails, a law computes wrong angles within its workspace, since the ranges that are stated leave it.
    def test_ranges_that_the_workspace_leaves_are_not_used(self):
        rows, answers = self.rows(motion_in_joints(100, 4)), []
        for first, second in [(None, None), (["100 deg", "150 deg"], ["10 deg", "60 deg"]),
                              (["410 deg", "580 deg"], ["-400 deg", "-230 deg"])]:
            arm = json.loads(PANTOGRAPH.read_text()) | {"assumed": []}
            for encoder, limits in zip(arm["encoders"], (first, second)):
                encoder.update({"range": limits}) if limits else encoder.pop("range")
            self.write("arm.json", json.dumps(arm))
            answers.append(self.simulated(FIELD, rows, "--device", "arm.json"))
        self.assertEqual(answers[1], answers[0])
        self.assertEqual(answers[2], answers[0])

    # If this fails, the damping that a brake has without current is counted in full where it fades with speed.
    def test_residual_damping_fades_with_speed(self):
        network = self.write("springs.json", json.dumps({"dashpot": 1, "axes": 2, "name": "springs", "ports": [
            {"name": name, "map": {"along": along}, "network": {"spring": "1000 N/m"}}
            for name, along in (("x", [1, 0]), ("y", [0, 1]))]}))
        told = {}
        for critical in (None, "0.05 m/s"):
            brakes = [{"along": along, "kind": "eddy_current", "max_damping": "5 N s/m",
                       "residual_damping": "0.3 N s/m",
                       **({"critical_speed": critical} if critical else {})} for along in ([1, 0], [0, 1])]
            self.write("arm.json", json.dumps({
                "dashpot_device": 1, "axes": 2, "name": "arm", "loop": {"rate": "1 kHz"},
                "encoders": {"max_speed": "1 m/s"}, "motors": {},
                "kinematics": {"kind": "cartesian", "workspace": {"x": ["-50 mm", "50 mm"], "y": ["-50 mm", "50 mm"]}},
                "brakes": brakes,
                "mechanics": {"damping": "0 N s/m", "inertia": [["0.1 kg", "0 kg"], ["0 kg", "0.1 kg"]]}}))
            told[critical] = json.loads(self.dashpot("explain", network, "--device", "arm.json",
                                                     "--json").stdout)["missing_damping"]
        # KT/2 for each spring, less what is left of 0.3 N s/m at 20 times the critical speed.
        self.assertAlmostEqual(told[None], 0.5 - 0.3, delta=1e-9)
        self.assertAlmostEqual(told["0.05 m/s"], 0.5 - 0.3 / 401, delta=1e-9)

    # If this fails, explain promises something else of more brakes than an isotropic field gets of them.
    def test_explain_tells_what_more_brakes_would_make(self):
        arm = json.loads(PANTOGRAPH.read_text())
        arm["kinematics"]["workspace"]["y"] = ["70 mm", "110 mm"]
        for brake in arm["brakes"]: brake["max_damping"] = "1 N m s/rad"
        arm["assumed"] = []
        self.write("arm.json", json.dumps(arm))
        told = json.loads(self.dashpot("explain", FIELD, "--device", "arm.json", "--json").stdout)["more_brakes"]
        self.assertEqual([more["along"] for more in told], [[[1, -1]], [[1, 1]], [[1, -1], [1, 1]]])
        # The table of theory, section 12, for 63/75/25 mm and this workspace.
        for more, (median, least) in zip(told, ((1, 0.732), (0.867, 0.652), (1, 1))):
            self.assertAlmostEqual(more["share"]["median"], median, delta=0.003)
            # It is least in a corner, of which 40 x 40 places see the next one: a little more.
            self.assertGreater(more["share"]["worst"], least - 0.003)
            self.assertLess(more["share"]["worst"], least + 0.015)
        self.assertNotIn("on this arm two brakes", self.dashpot("explain", FIELD, "--device", "arm.json").stdout)
        arm["kinematics"] = {"kind": "parallelogram", "links": ["80 mm", "80 mm"],
                             "workspace": arm["kinematics"]["workspace"]}
        arm["brakes"] = [{**brake, "along": along} for brake, along in zip(arm["brakes"], ([1, -1], [1, 1]))]
        self.write("arm.json", json.dumps(arm))
        self.assertIn("two brakes, on q1 - q2 and on q1 + q2, make every damping",
                      self.dashpot("explain", FIELD, "--device", "arm.json").stdout)
        told = json.loads(self.dashpot("explain", FIELD, "--device", "arm.json", "--json").stdout)
        share = next(one["share"] for one in told["candidates"] if one["name"] == "non-injecting")
        self.assertAlmostEqual(share["worst"], 1, delta=1e-6)

    # If this fails, explain does not mention ports, brakes or what is proved.
    def test_explain_tells_ports_shares_and_certificate(self):
        told = json.loads(self.dashpot("explain", FIELD, "--device", PANTOGRAPH, "--json").stdout)
        self.assertEqual([port["name"] for port in told["ports"]], ["across", "out"])
        self.assertEqual((told["axes"], told["chosen"], told["certified"]), (2, "diagonal", True))
        non_injecting = next(c for c in told["candidates"] if c["name"] == "non-injecting")["share"]
        # Of an isotropic field 1/(1 + |c|), c the cosine between the columns of J, at the centres of 40 x 40 parts; the
        # field is told with 1e-9 more.
        shares = []
        for i in range(40):
            for j in range(40):
                first, second = jacobian_of(joints_of(-0.04 + (i + 0.5) * 0.002, 0.07 + (j + 0.5) * 0.00125))
                c = (first[0] * second[0] + first[1] * second[1]) / math.hypot(*first) / math.hypot(*second)
                shares.append(1 / (1 + abs(c)))
        self.assertAlmostEqual(non_injecting["mean"], sum(shares) / len(shares), delta=1e-7)
        self.assertAlmostEqual(non_injecting["worst"], min(shares), delta=1e-7)
        text = self.dashpot("explain", FIELD, "--device", PANTOGRAPH).stdout
        for words in ["across", "wall", "certified for any motion in the workspace", "lag of the motors' amplifiers",
                      "operations before"]:
            self.assertIn(words, " ".join(text.split()))
        self.assertTrue(all(len(line) <= 100 for line in text.splitlines()), text)
        with_legend = self.dashpot("explain", FIELD, "--device", PANTOGRAPH, "--legend").stdout
        self.assertTrue(all(len(line) <= 100 for line in with_legend.splitlines()), with_legend)
        for name in ["map", "b", "k0", "b∞", "modes", "rule", "in all directions", "in the worst one", "at",
                     "delay-proof",
                     *(candidate["name"] for candidate in told["candidates"])]:
            self.assertIn(name, text)
            self.assertRegex(with_legend, rf"(?m)^{name} {{{22 - len(name)}}}\S")

    # If this fails, more is called certified than the bounds cover, or nothing is; or brakes are told to give more than
    # they have.
    def test_what_is_certified_is_covered(self):
        arm = json.loads(PANTOGRAPH.read_text())
        del arm["motors"]["amplifier_lag"]
        arm["assumed"].remove("motors.amplifier_lag")
        self.write("prompt.json", json.dumps(arm))
        slow = json.loads(PANTOGRAPH.read_text())
        slow["motors"]["slew"] = "100 N m/s"
        self.write("slow.json", json.dumps(slow))
        thick = json.loads(FIELD.read_text())
        thick["parameters"]["B"] = "4 N s/m"
        self.write("thick.json", json.dumps(thick))
        springs = json.loads(FIELD.read_text())
        for port in springs["ports"]:
            port["network"] = {"spring": "K"}
        del springs["parameters"]["B"]
        self.write("springs.json", json.dumps(springs))
        told = lambda network, device: json.loads(self.dashpot("explain", network, "--device", device, "--json").stdout)
        prompt, late, dry = told(FIELD, "prompt.json"), told(FIELD, PANTOGRAPH), told("springs.json", PANTOGRAPH)
        for said in (prompt, late, dry):
            self.assertTrue(said["certified"])
            self.assertGreaterEqual(min(said["added_damping"]), 0.95 * said["missing_damping"] * LINK ** 2)
        self.assertEqual(prompt["damping_for_lag"], 0)
        self.assertAlmostEqual(prompt["damping_for_estimates"], late["damping_for_estimates"], delta=1e-3)
        self.assertEqual(dry["damping_for_estimates"], 0)
        self.assertGreater(late["damping_for_lag"], 0)
        for network, device, reason in ((FIELD, "slow.json", "slew"),
                                        ("thick.json", PANTOGRAPH, "more than its brakes"),
                                        (WALL, PANTOGRAPH,
                                         "the end of the contact is computed from the estimated velocity")):
            text = " ".join(self.dashpot("explain", network, "--device", device).stdout.split())
            self.assertIn("not certified", text)
            self.assertIn(reason, text)
        refused = self.dashpot("compile", "thick.json", "--device", PANTOGRAPH, status=INPUT_REFUSED,
                               advice=True).stderr
        self.assertIn("[axes-not-certified]", refused)
        # What the refusal asks for is enough.
        stiff = json.loads(PANTOGRAPH.read_text())
        stiff["mechanics"]["damping"] = json.loads(re.search(r'would be enough: "damping": (\[.*?\]) in "mechanics"',
                                                             refused)[1])
        self.write("stiff.json", json.dumps(stiff))
        self.dashpot("compile", "thick.json", "--device", "stiff.json", "-o", "out")
        # And hardly more: the search halves what is missing four times, and rounds up to three digits.
        own = [float(number) for number in re.search(r"of their own, in place of (\S+) and (\S+), would be enough",
                                                     " ".join(refused.split())).groups()]
        enough = [float(damping.split()[0]) for damping in stiff["mechanics"]["damping"]]
        stiff["mechanics"]["damping"] = [f"{least + 0.85 * (most - least)} N m s/rad"
                                         for least, most in zip(own, enough)]
        self.write("stiff.json", json.dumps(stiff))
        self.dashpot("compile", "thick.json", "--device", "stiff.json", "-o", "out", status=INPUT_REFUSED)
        self.assertIn("N·m·s/rad of damping are missing at the joints, more than its brakes have left", refused)

    def test_brakes_that_would_do(self):
        """Fails if a refusal of two axes does not suggest stronger brakes that would do, or suggests some that would
        not, or far more than is needed."""
        device = json.loads(PANTOGRAPH.read_text())
        network = {"dashpot": 1, "axes": 2, "name": "groove", "ports": [
            {"name": "across", "map": {"along": [1, 0]},
             "network": {"parallel": [{"spring": "150 N/m"}, {"damper": "1 N s/m"}]}}]}
        self.write("groove.json", json.dumps(network))

        def compiled(limits, status=0, **more):
            for brake, limit in zip(device["brakes"], limits):
                brake["max_damping"] = f"{limit} N m s/rad"
            self.write("device.json", json.dumps(device))
            return self.dashpot("compile", "groove.json", "--device", "device.json", "-o", "out", status=status,
                                **more).stderr

        refused = compiled([2.5e-3] * len(device["brakes"]), INPUT_REFUSED, advice=True)
        self.assertIn("[axes-not-certified]", refused)
        told = re.search(r"note: brakes of (.*) N m s/rad, in place of .*, would be enough: ",
                         " ".join(refused.split()))
        limits = [float(limit) for limit in told[1].split(" and ")]
        compiled(limits)
        # The search halves a factor of two four times, and two digits are told.
        compiled([0.8 * limit for limit in limits], INPUT_REFUSED)

    def test_the_steps_of_the_encoders(self):
        """Fails if explain reports less of what the encoders' steps change at the joints than they do somewhere, or far
        more, or nothing of the friction that takes it."""
        ball = {"name": "ball", "map": {"ball": {"centre": [0, "40 mm"], "radius": "90 mm"}},
                "network": {"spring": "400 N/m"}}
        network = self.write("ball.json",
                             json.dumps({"dashpot": 1, "axes": 2, "name": "round_spring", "ports": [ball]}))
        told = json.loads(self.dashpot("explain", network, "--device", PANTOGRAPH, "--json").stdout)["torque_of_steps"]
        half = math.pi / 65536

        def torque(q):
            (x, y), columns = tip_of(q), jacobian_of(q)
            away = math.hypot(x, y - 0.04)
            push = 400 * (0.09 - away)
            return [push * (-x * column[0] - (y - 0.04) * column[1]) / away for column in columns]

        most = [0, 0]
        for x in (-0.04, -0.02, 0, 0.02, 0.04):
            for y in (0.07, 0.095, 0.12):
                q = joints_of(x, y)
                for signs in ((1, 1), (1, -1)):
                    there, here = torque([a + sign * half for a, sign in zip(q, signs)]), torque(q)
                    most = [max(m, abs(a - b)) for m, a, b in zip(most, there, here)]
        for j in range(2):
            self.assertLess(most[j], told[j])
            # norms of both joints together, force and bend each at its own worst place
            self.assertGreater(most[j], 0.5 * told[j])
        words = lambda device: " ".join(self.dashpot("explain", network, "--device", device).stdout.split())
        self.assertIn("friction of 0.001 and 0.001 N m there takes what that gives, a brake none of it a step takes",
                      words(PANTOGRAPH))
        arm = json.loads(PANTOGRAPH.read_text())
        arm["mechanics"]["coulomb_friction"] = "10 uN m"
        self.write("smooth.json", json.dumps(arm))
        beyond = float(re.search(r"what is beyond can give the hand (\S+) and", words("smooth.json"))[1])
        self.assertAlmostEqual(beyond, told[0] - 1e-5, delta=0.005 * told[0])
        slip = {**ball, "network": {"series": [{"slip": "1 N"}, {"spring": "400 N/m"}]}}
        self.write("ball.json", json.dumps({"dashpot": 1, "axes": 2, "name": "round_slip", "ports": [slip]}))
        self.assertIn("encoder steps: the energy that they bring in by the motors is not bounded, and not counted",
                      words(PANTOGRAPH))

    def test_what_cannot_be_bounded_is_told_as_it_is(self):
        """Fails if a bound beyond all numbers is printed as one, or forces are blamed where it is the way that the
        joints go."""
        field = json.loads(FIELD.read_text())
        field["parameters"]["B"] = "1e300 N s/m"
        self.write("endless.json", json.dumps(field))
        told = self.dashpot("explain", "endless.json", "--device", PANTOGRAPH).stdout
        self.assertNotRegex(told, r"\b(inf|nan)\b")
        self.assertIn("more damping at the joints than can be computed", " ".join(told.split()))
        arm = json.loads(PANTOGRAPH.read_text())
        for encoder in arm["encoders"]:
            encoder["max_speed"] = "6000 rad/s"
        self.write("fast.json", json.dumps(arm))
        told = " ".join(self.dashpot("explain", FIELD, "--device", "fast.json").stdout.split())
        self.assertIn("the joints may go on, at the encoders' \"max_speed\", to where the arm does not reach", told)
        self.assertNotIn("bounds no force", told)

    def test_what_is_added_is_told_at_the_tip(self):
        """Fails if damping that is added to the brakes is not what the hand feels of it where it feels most."""
        text = " ".join(self.dashpot("explain", FIELD, "--device", PANTOGRAPH).stdout.split())
        told = float(re.search(r"felt at the tip as up to (\S+) N s/m more", text)[1])
        added = json.loads(self.dashpot("explain", FIELD, "--device", PANTOGRAPH, "--json").stdout)["added_damping"]
        (left, right), (low, high) = ([float(end.split()[0]) * 1e-3 for end in side]
                                      for side in json.loads(
                                          PANTOGRAPH.read_text())["kinematics"]["workspace"].values())
        draw, felt = random.Random(5), []
        while len(felt) < 4000:
            q = [draw.uniform(math.pi / 2, 1.2 * math.pi), draw.uniform(-0.2 * math.pi, math.pi / 2)]
            try:
                x, y = tip_of(q)
            except ValueError:  # the arm does not reach from elbow to elbow
                continue
            # Both elbows outwards, as the arm is built.
            outwards = math.atan2(y, x + BASE / 2) < q[0] and q[1] < math.atan2(y, x - BASE / 2)
            if not (outwards and left <= x <= right and low <= y <= high):
                continue
            (a, c), (b, d) = jacobian_of(q)
            determinant = a * d - b * c
            turns = [(d / determinant, -b / determinant), (-c / determinant, a / determinant)]  # of J⁻¹, by rows
            xx, xy, yy = (sum(damping * turn[i] * turn[j] for damping, turn in zip(added, turns))
                          for i, j in ((0, 0), (0, 1), (1, 1)))
            felt.append((xx + yy) / 2 + math.hypot((xx - yy) / 2, xy))
        # Three digits are told, of a grid that reaches into the corners.
        self.assertLessEqual(max(felt), 1.006 * told)
        self.assertGreater(max(felt), 0.8 * told)

    def test_which_ports_can_be_certified(self):
        """Fails if the note on ports that can be certified says so of one that is not, or leaves one out, or if `check`
        does not say of them what `compile` says."""
        prompt = json.loads(PANTOGRAPH.read_text())
        del prompt["motors"]["amplifier_lag"]
        prompt["assumed"].remove("motors.amplifier_lag")
        prompt["mechanics"]["damping"] = "0.1 N m s/rad"  # more than any of these needs
        late = json.loads(json.dumps(prompt))
        late["motors"]["amplifier_lag"] = "0.3 ms"
        writing = json.loads(json.dumps(prompt))
        writing["loop"]["write_delay"] = ["0 us", "30 us"]
        spring, damper, slip = {"spring": "150 N/m"}, {"damper": "0.5 N s/m"}, {"slip": "1 N"}
        side_by_side, relaxing = {"parallel": [spring, damper]}, {"parallel": [spring, {"series": [spring, damper]}]}
        sliding = {"series": [slip, spring]}
        for device, contact, network, is_certified in (
                (writing, False, side_by_side, True), (writing, True, side_by_side, False),
                (late, False, side_by_side, True), (late, False, relaxing, False), (prompt, False, relaxing, False),
                (late, True, side_by_side, False), (prompt, True, side_by_side, True), (late, True, relaxing, True),
                (late, False, sliding, True), (late, False, {"parallel": [sliding, damper]}, True),
                (late, True, sliding, True), (prompt, True, {"parallel": [sliding, damper]}, False),
                (prompt, False, {"series": [slip, side_by_side]}, False)):
            port = {"name": "floor", "map": {"wall": {"through": [0, "110 mm"], "normal": [0, 1]}}, "network": network}
            if contact:
                port["contact"] = {"at": 0}
            self.write("device.json", json.dumps(device))
            self.write("floor.json", json.dumps({"dashpot": 1, "axes": 2, "name": "soft_floor", "ports": [port]}))
            with self.subTest(network=network, contact=contact, late=device is late, writing=device is writing):
                told = self.dashpot("compile", "floor.json", "--device", "device.json", "-o", "out").stderr
                self.assertEqual("note: a port can be certified if: " in told, not is_certified)
                self.assertEqual("[nothing-proved]" in told, not is_certified)
                self.assertEqual(self.dashpot("check", "floor.json", "--device", "device.json").stderr, told)

    def test_what_the_springs_held_is_no_gain(self):
        """Fails if energy that comes out of springs that are pressed when a run begins is reported as energy that came
        from nowhere."""
        self.write("floor.json", json.dumps({"dashpot": 1, "axes": 2, "name": "soft_floor", "ports": [
            {"name": "floor", "map": {"wall": {"through": [0, "110 mm"], "normal": [0, 1]}},
             "network": {"spring": "150 N/m"}}]}))
        # In the middle of the workspace the wall is pressed by 15 mm.
        told = self.dashpot("run", "floor.json", "--device", PANTOGRAPH, "--fast", "--for", "1").stdout
        lowest, held = re.search(r"never below (\S+) J: below zero, but the springs held (\S+) J when the run began",
                                 told).groups()
        self.assertAlmostEqual(float(held), 0.5 * 150 * 0.015 ** 2, delta=1e-4)
        self.assertLess(float(lowest), 0)
        self.assertGreaterEqual(float(lowest), -float(held))

    # If this fails, a command for one axis takes a file of two axes for one of its own, or refuses it without help.
    def test_a_force_that_turns_at_once_is_refused(self):
        """Fails if a map may have its peak where the arm goes, but for a cavity that is touched on its inside only."""
        def map_of(**kind):
            network = json.loads(BALL.read_text())
            network["ports"][0]["map"] = kind
            self.write("peak.json", json.dumps(network))
            return "peak.json", "--device", PANTOGRAPH
        for inside in ({"ball": {"centre": ["0 mm", "100 mm"], "radius": "5 mm"}},
                       {"line": {"through": ["0 mm", "0 mm"], "direction": [0.1, 1], "radius": "5 mm"}}):
            self.assertIn("[map-not-differentiable]",
                          self.dashpot("explain", *map_of(**inside), status=INPUT_REFUSED).stderr)
        self.dashpot("explain", *map_of(cavity={"centre": ["0 mm", "95 mm"], "radius": "20 mm"}))
        self.dashpot("explain", *map_of(line={"through": ["0 mm", "160 mm"], "direction": [1, 0], "radius": "50 mm"}))

    # If this fails, a law of two axes does not run on its device, or does not run as it computes.
    def test_a_law_runs_on_its_simulated_arm(self):
        run = ["run", FIELD, "--device", PANTOGRAPH, "--fast", "--for", "0.2", "--hand", "firm", "--seed", "7"]
        done = self.dashpot(*run, "-o", "run.csv")
        for words in ("2000 served", "faults    none", "range     the tip from ", "device left safe", "log: run.csv"):
            self.assertIn(words, done.stdout)
        self.assertNotIn("[nothing-proved]", done.stderr)
        uncertified = self.dashpot("run", BALL, "--device", PANTOGRAPH, "--fast", "--for", "0.01")
        self.assertIn("[nothing-proved]", uncertified.stderr)
        self.assertIn("note: a port can be certified if: ", uncertified.stderr)
        weak = json.loads(PANTOGRAPH.read_text())
        for brake in weak["brakes"]:
            brake.update(max_damping="3 mN m s/rad")
        self.write("weak.json", json.dumps(weak))
        self.assertIn("[lacks-damping]", self.dashpot("run", FIELD, "--device", "weak.json", "--fast", "--for",
                                                      "0.01").stderr)
        self.write("slow.csv", "time,q1,q2\n" + "".join(f"{i / 1000},1,1\n" for i in range(5)))
        told = self.refused("simulate", FIELD, "--device", PANTOGRAPH, "--input", "slow.csv",
                            code="csv-rate-contradicts",
                            status=COMMAND_LINE_WRONG).stderr
        self.assertIn("'dashpot run --motion' plays a recording of any rate", told)
        lines = (self.folder / "run.csv").read_text().splitlines()
        names = [name.split(" ")[0] for name in lines[0].split(",")]
        table = [dict(zip(names, line.split(","))) for line in lines[1:]]
        self.assertEqual(len(table), 2000)
        read = lambda row, *columns: [float(row[column]) for column in columns]
        rows = [read(row, "q1", "q2", "v1", "v2") for row in table]
        x, y = zip(*(tip_of(row[:2]) for row in rows))
        self.assertLess(math.hypot(x[0], y[0] - 0.095), 1e-4)  # the middle of the workspace, to an encoder's step
        self.assertGreater(max(x) - min(x), 1e-3)
        for row, told in zip(table, self.answers(self.compile(FIELD, "--device", PANTOGRAPH), rows)):
            self.assertEqual(read(row, "damping_1", "damping_2", "torque_1", "torque_2", "stored_energy")[:4], told[:4])
            for j in ("1", "2"):  # within what motors and brakes can do
                wanted, sent = read(row, "torque_" + j, "motor_torque_" + j)
                self.assertEqual(sent, min(max(-wanted, -0.1), 0.1))
                wanted, sent = read(row, "damping_" + j, "brake_damping_" + j)
                self.assertEqual(sent, min(wanted, 0.014))
        self.dashpot(*run, "-o", "again.csv")
        self.assertEqual((self.folder / "again.csv").read_bytes(), (self.folder / "run.csv").read_bytes())

    # If this fails, joints in degrees, in another order or among other columns are simulated as another motion.
    def test_units_and_order_of_joints(self):
        joints, arm = motion_in_joints(50, 2), self.write("near.json", near(PANTOGRAPH))
        simulated = lambda names, rows: [[float(word) for word in line.split(",")[1:]] for line in self.dashpot(
            "simulate", FIELD, "--device", arm, "--input", self.write("motion.csv", names + "\n" + "".join(
                ",".join(map(repr, row)) + "\n" for row in rows))).stdout.splitlines()[1:]]
        plain = simulated("time,q1,q2", [[i * PERIOD, *q] for i, q in enumerate(joints)])
        other = simulated("# of the rig\ntrial,q2 [deg],t [ms],q1 (deg)",
                          [[7, math.degrees(b), 1e3 * i * PERIOD, math.degrees(a)] for i, (a, b) in enumerate(joints)])
        for one, same in zip(plain, other, strict=True):
            for a, b in zip(one, same):
                self.assertAlmostEqual(a, b, delta=1e-8 * (1 + abs(a)))
        for header, code in (("time,q1", "axes-csv-columns"), ("time,q1,q2,q2", "axes-csv-columns"),
                             ("time,q1,q2,v1", "axes-csv-columns"),
                             ("time,q1 [N],q2", "recording-wrong-unit"),
                             ("time,q1 [rad],q2 [mm]", "recording-wrong-unit"),
                             ("time,q1 [mm],q2 [mm]", "csv-other-motion")):
            self.write("bad.csv", f"{header}\n" + "0,1,1,1"[:2 * header.count(",") + 1] + "\n")
            refused = self.refused("simulate", FIELD, "--device", arm, "--input", "bad.csv", code=code)
            self.assertIn("bad.csv:1:", refused.stderr)

    # If this fails, a loop of one's own has other numbers than the device's file, or takes a law for another's.
    def test_a_device_is_written_as_code(self):
        self.dashpot("device", PANTOGRAPH, "--target", "cpp", "-o", "arm.hpp")
        self.dashpot("compile", FIELD, "--device", PANTOGRAPH, "--uncertified")
        self.write("facts.cpp", r"""
#include "arm.hpp"
#include "kelvin_field.hpp"
#include <cstdio>
#include <cstring>
int main() {
  using device = dashpot::devices::pantograph_2dof;
  constexpr dashpot::arm_description arm = device::description();
  static_assert(arm.geometry.kind == dashpot::arm_kind::five_bar && arm.brake_count == 2);
  std::printf("%d %g %g %g %g %g %g\n", std::strcmp(dashpot::generated::kelvin_field::certified_for::device_digest, device::digest),
              arm.geometry.base, arm.geometry.workspace_high[1], arm.joints[1].encoder.max_speed,
              arm.joints[0].mechanics.coulomb_friction, arm.brakes[1].brake.coil_lag, arm.brakes[1].along[1]);
  std::printf("%g %g %g\n", arm.link_masses[0], arm.link_masses[1], arm.joints[1].loop.jitter);
}
""")
        subprocess.run([shutil.which("g++") or "c++", "-std=c++17", "-Wall", "-Wextra", "-Werror", "-I",
                        SOURCE / "runtime/include",
                        "-I", ".", "facts.cpp", "-o", "facts"], cwd=self.folder, check=True)
        told = subprocess.run([self.folder / "facts"], text=True, capture_output=True, check=True).stdout
        self.assertEqual(told, "0 0.025 0.12 30 0.001 0.002 1\n0.02 0.015 5e-05\n")

    def test_what_knows_one_axis_says_so(self):
        self.assertIn("[several-axes]", self.dashpot("export", "--to", "generic", FIELD, status=INPUT_REFUSED).stderr)
        self.assertIn("[axes-differ]", self.dashpot("report", FIELD, "--device", ONE_AXIS, "-o", "a.html",
                                                    status=INPUT_REFUSED).stderr)
        self.assertIn("[device-of-several-axes]",
                      self.dashpot("device", PANTOGRAPH, "--target", "c99", "-o", ".", status=INPUT_REFUSED).stderr)
        self.assertIn("'unix:none': No such file or directory [cannot-start-device]",
                      self.dashpot("run", FIELD, "--device", PANTOGRAPH, "--port", "unix:none",
                                   status=INPUT_REFUSED).stderr)
        self.assertIn("[axes-differ]", self.dashpot("run", FIELD, "--device", ONE_AXIS, status=INPUT_REFUSED).stderr)
        for target in ("hal", "fmi2", "fmi3", "python", "wasm"):
            self.assertIn("[target-on-two-axes]",
                          self.dashpot("compile", FIELD, "--target", target, status=None).stderr, target)
        self.assertIn("[option-on-two-axes]", self.dashpot("compile", FIELD, "--batch", status=INPUT_REFUSED).stderr)
        kelvin = SOURCE / "networks/paper/kelvin.json"
        for network, device in ((FIELD, ONE_AXIS), (kelvin, PANTOGRAPH)):
            self.assertIn("[axes-differ]", self.dashpot("explain", network, "--device", device,
                                                        status=INPUT_REFUSED).stderr)
        refused = self.dashpot("compile", FIELD, "--decomposition", "velocity-free", status=INPUT_REFUSED).stderr
        self.assertIn("[rule-of-brakes]", refused)
        refused = self.dashpot("compile", FIELD, "--state-input", "velocity", status=INPUT_REFUSED).stderr
        self.assertIn("[ports-follow-position]", refused)
        self.write("motion.csv", "time,x,y\n0,0,0\n")
        self.assertIn("[axes-csv-columns]", self.dashpot("simulate", FIELD, "--input", "motion.csv",
                                                         status=INPUT_REFUSED).stderr)
        self.dashpot("check", FIELD, BALL, WALL, PANTOGRAPH)


if __name__ == "__main__":
    unittest.main()
