"""`dashpot run --motion` with two axes: what is felt of a recorded motion of the joints on a described arm."""
import csv
import io
import json
import math
import unittest

from axes_test import FIELD, PANTOGRAPH, jacobian_of, joints_of, tip_of
from dashpot_command import COMMAND_LINE_WRONG, INPUT_REFUSED, CommandTest

COLUMNS = ["time", "q1", "q2", "estimate_1", "estimate_2", "felt_torque_1", "felt_torque_2", "closed_form_1",
           "closed_form_2",
           "damping_1", "damping_2", "torque_1", "torque_2", "tip_x", "tip_y", "felt_x", "felt_y", "closed_form_x",
           "closed_form_y"]
KELVIN = {"parallel": [{"spring": "100 N/m"}, {"damper": "1 N s/m"}]}
SOLID = {"parallel": [{"spring": "40 N/m"}, {"damper": "0.7 N s/m"},
                      {"series": [{"spring": "90 N/m"}, {"damper": "4 N s/m"}]}]}


def along(motion, step):
    """A motion of the tip as rows of the joints, of a second."""
    return [(k * step, *joints_of(*motion(k * step))) for k in range(round(1 / step) + 1)]


def round_the_middle(t):
    return 0.012 * math.sin(2 * math.pi * t), 0.095 + 0.01 * math.sin(4 * math.pi * t)


def table(rows, names="time,q1,q2"):
    return names + "\n" + "".join(",".join(f"{value:.12g}" for value in row) + "\n" for row in rows)


class AxesMotion(CommandTest):
    def network(self, *ports, **more):
        named = [{"name": f"p{i}", **port} for i, port in enumerate(ports)]
        return self.write("net.json", json.dumps({"dashpot": 1, "axes": 2, "name": "net", "ports": named, **more}))

    def device(self, kind="five_bar", rate="2 kHz", **changes):
        """An arm without imperfection but for `changes` of its sections."""
        arm = {"five_bar": {"kind": "five_bar", "links": ["63 mm", "75 mm"], "base": "25 mm"},
               "cartesian": {"kind": "cartesian"}}[kind]
        turns = kind != "cartesian"
        told = {"dashpot_device": 1, "axes": 2, "name": "arm",
                "kinematics": arm | {"workspace": {"x": ["-40 mm", "40 mm"], "y": ["70 mm", "120 mm"]}},
                "loop": {"rate": rate},
                "velocity": {"estimator": "backward_difference", "window": 1}, "motors": {},
                "brakes": [{"along": direction, "kind": "eddy_current", "max_damping": "50 mN m s/rad" if turns
                            else "50 N s/m"}
                           for direction in ([1, 0], [0, 1])],
                "mechanics": {"link_masses": ["20 g", "15 g"], "damping": "10 mN m s/rad"} if turns else
                             {"inertia": [["0.1 kg", "0 kg"], ["0 kg", "0.1 kg"]], "damping": "20 N s/m"}}
        for section, more in changes.items():
            told[section] = [one | more for one in told[section]] if section == "brakes" else \
                told[section] | more if section in told and section != "velocity" else more
        return self.write("device.json", json.dumps(told))

    def played(self, net, device, motion, *choices):
        self.write("motion.csv", motion)
        told = json.loads(self.dashpot("run", net, "--device", device, "--motion", "motion.csv", "-o", "felt.csv",
                                       "--json", *choices).stdout)
        rows = list(csv.reader(io.StringIO((self.folder / "felt.csv").read_text())))
        self.assertEqual(rows[0], COLUMNS)
        return [dict(zip(COLUMNS, map(float, row))) for row in rows[1:]], told

    def test_the_network_at_the_joints(self):
        """Fails if what the network and the field oppose to the joints is not what their closed forms give at the
        tip."""
        centre, viscous = (0.0, 0.14), [[1.5, 0.4], [0.4, 0.8]]
        net = self.network({"map": {"ball": {"centre": ["0 mm", "140 mm"], "radius": "30 mm"}}, "network": KELVIN},
                           {"map": {"along": [3, 4]}, "network": KELVIN},
                           field={"viscous": [["1.5 N s/m", "0.4 N s/m"], ["0.4 N s/m", "0.8 N s/m"]]})
        recorded = along(round_the_middle, 0.01)
        rows, _ = self.played(net, self.device(), table(recorded))
        self.assertEqual(len(rows), 2001)
        for row in rows[7::93]:
            k = int(row["time"] * 100 + 1e-9)
            share = row["time"] * 100 - k
            before, after = recorded[k][1:], recorded[k + 1][1:]
            q = [a + share * (b - a) for a, b in zip(before, after)]
            v = [(b - a) * 100 for a, b in zip(before, after)]
            tip, columns = tip_of(q), jacobian_of(q)
            moves = [columns[0][i] * v[0] + columns[1][i] * v[1] for i in range(2)]
            distance = math.hypot(tip[0] - centre[0], tip[1] - centre[1])
            toward = [(c - x) / distance for c, x in zip(centre, tip)]
            force = [sum(a * b for a, b in zip(line, moves)) for line in viscous]
            for w, gradient in ((0.03 - distance, toward), (0.6 * tip[0] + 0.8 * tip[1], (0.6, 0.8))):
                pushed = 100 * w + gradient[0] * moves[0] + gradient[1] * moves[1]
                force = [f + g * pushed for f, g in zip(force, gradient)]
            for name, value in zip(("q1", "q2", "tip_x", "tip_y", "closed_form_x", "closed_form_y"),
                                   (*q, *tip, *force)):
                self.assertAlmostEqual(row[name], value, delta=1e-7)  # of the differences that the Jacobian is made of
            for j in (0, 1):
                self.assertAlmostEqual(row[f"closed_form_{j + 1}"], columns[j][0] * force[0] + columns[j][1] * force[1],
                                       delta=1e-8)

    def test_relaxations(self):
        """Fails if a network that relaxes is driven by something else than how far the tip goes into its map."""
        # On straight axes the way along a direction is straight between rows: closed form. Round a ball it is bent:
        # quadrature.
        points = [(0.0, 0.0, 0.09), (0.25, 0.004, 0.09), (0.5, 0.004, 0.1), (0.75, 0.001, 0.1)]
        net = self.network({"map": {"along": [3, 4]}, "network": SOLID})
        rows, _ = self.played(net, self.device("cartesian"), table(points))
        speeds = [(0, 0.25, 0.6 * 0.016), (0.25, 0.5, 0.8 * 0.04), (0.5, 0.75, -0.6 * 0.012)]
        for row in rows[:-1:37]:
            t = row["time"]
            u = 0.8 * 0.09 + sum(v * (min(t, end) - start) for start, end, v in speeds if t > start)
            v = next(v for start, end, v in speeds if t < end)
            inside = 0.0
            for start, end, speed in speeds:
                if t > start: inside = 4 * speed + (inside - 4 * speed) * math.exp(-90 / 4 * (min(t, end) - start))
            force = 40 * u + 0.7 * v + inside
            self.assertAlmostEqual(row["closed_form_1"], 0.6 * force, delta=1e-9)
            self.assertAlmostEqual(row["closed_form_2"], 0.8 * force, delta=1e-9)
        net = self.network({"map": {"ball": {"centre": ["0 mm", "140 mm"], "radius": "30 mm"}}, "network": SOLID})
        recorded = along(round_the_middle, 0.02)
        rows, _ = self.played(net, self.device(), table(recorded))
        inside, steps = 0.0, 40  # of a sample of the loop; the rule of midpoints
        depth = lambda t: 0.03 - math.dist(tip_of([a + (t * 50 - int(t * 50)) * (b - a)
                                                   for a, b in zip(recorded[int(t * 50)][1:],
                                                                   recorded[int(t * 50) + 1][1:])]), (0, 0.14))
        for k in range(400):
            for i in range(steps):
                a, b = depth((k + i / steps) / 2000 + 1e-12), depth((k + (i + 1) / steps) / 2000 - 1e-12)
                decay = math.exp(-90 / 4 / 2000 / steps)
                inside = inside * decay + 4 * (b - a) * 2000 * steps * (1 - decay)
            if k % 40 != 33: continue
            row, t = rows[k + 1], (k + 1) / 2000
            speed = (depth(t + 1e-6) - depth(t - 1e-6)) / 2e-6
            self.assertAlmostEqual(math.hypot(row["closed_form_x"], row["closed_form_y"]),
                                   abs(40 * depth(t) + 0.7 * speed + inside), delta=1e-5)

    def test_a_device_without_imperfection(self):
        """Fails if what is felt on an exact arm is off by more than the motors' hold, or is not what is summed up."""
        net = self.network({"map": {"ball": {"centre": ["0 mm", "140 mm"], "radius": "50 mm"}}, "network": SOLID})
        shares = []
        for rate in (2000, 8000):
            rows, told = self.played(net, self.device(rate=f"{rate} Hz"), table(along(round_the_middle, 1 / rate)))
            shares.append(told["tip"]["error"]["rms_share"])
            for j in ("1", "2"):
                off = [row["felt_torque_" + j] - row["closed_form_" + j] for row in rows]
                error = told["joints"][int(j) - 1]["error"]
                self.assertAlmostEqual(error["peak"], max(map(abs, off)), delta=1e-15)
                self.assertAlmostEqual(error["rms"], math.sqrt(sum(d * d for d in off) / len(off)), delta=1e-15)
            at_tip = max(math.hypot(row["felt_x"] - row["closed_form_x"], row["felt_y"] - row["closed_form_y"])
                         for row in rows)
            self.assertAlmostEqual(told["tip"]["error"]["peak"], at_tip, delta=1e-12)
        self.assertLess(shares[0], 0.02)
        self.assertLess(shares[1], shares[0] / 2)

    def test_each_imperfection_is_felt(self):
        """Fails if encoders, estimators, delay, amplifiers, coils or limits take no part in what is felt."""
        net = self.network({"map": {"ball": {"centre": ["0 mm", "140 mm"], "radius": "50 mm"}}, "network": KELVIN})
        motion = table(along(round_the_middle, 1 / 2000))
        _, exact = self.played(net, self.device(), motion)
        changes = {"encoder": {"encoders": {"counts_per_turn": 256}}, "delay": {"loop": {"delay_samples": 20}},
                   "estimator": {"velocity": {"estimator": "butterworth", "order": 4, "cutoff": "20 Hz"}},
                   "amplifier": {"motors": {"amplifier_lag": "15 ms"}}, "coil": {"brakes": {"coil_lag": "50 ms"}},
                   "limit": {"motors": {"max_torque": "20 mN m"}}}
        for name, change in changes.items():
            with self.subTest(name=name):
                _, told = self.played(net, self.device(**change), motion)
                self.assertGreater(told["tip"]["error"]["rms"], 2 * exact["tip"]["error"]["rms"])
                self.assertEqual(told["limited_samples"] > 0, name == "limit")

    def test_damping_for_passivity_is_no_part_of_the_network(self):
        """Fails if damping that is added to the brakes counts as the network's, or is not reported."""
        net = self.network({"map": {"along": [1, 0]}, "network": {"spring": "200 N/m"}})
        device = self.device("cartesian", mechanics={"damping": "0 N s/m"}, encoders={"max_speed": "1 m/s"})
        rows, told = self.played(net, device,
                                 table([(k / 2000, 0.005 * math.sin(2 * math.pi * k / 2000), 0.095)
                                        for k in range(2001)]))
        added = told["brakes"][0]["for_passivity"]
        self.assertGreater(added, 0)
        for row in rows[200:1800:77]:
            self.assertAlmostEqual(row["closed_form_1"], 200 * row["q1"], delta=1e-9)
            past = 200 * 0.005 * math.sin(2 * math.pi * (row["time"] - 0.5 / 2000))
            speed = 0.01 * math.pi * math.cos(2 * math.pi * row["time"])
            # The staircase of the motor is felt as the mean of two steps.
            self.assertAlmostEqual(row["felt_torque_1"], past + added * speed, delta=1e-4)
        said = self.dashpot("run", net, "--device", device, "--motion", "motion.csv", "-o", "felt.csv").stdout
        self.assertIn(f"; {added:.4g} of it are for passivity alone\n", said)
        for words in ("net on arm: 2001 samples at 2000 Hz, brakes by the rule diagonal\n", "brake 2 is told ",
                      "the network's force on joint 1: rms ",
                      "felt error at the tip: rms ", "energy: ", "log: felt.csv"):
            self.assertIn(words, said)

    def test_a_contact(self):
        """Fails if a port with a contact is compared with one that holds the tool, or that it does not touch."""
        net = self.network({"map": {"wall": {"through": [0, "95 mm"], "normal": [0, -1]}}, "network": KELVIN,
                            "contact": {"at": "0 mm"}})
        rows, told = self.played(net, self.device(),
                                 table(along(lambda t: (0, 0.095 - 0.008 * math.cos(2 * math.pi * t)), 0.001)))
        for row in rows[3::71]:
            depth, speed = row["tip_y"] - 0.095, 0.016 * math.pi * math.sin(2 * math.pi * row["time"])
            wanted = max(0.0, 100 * depth + speed) if depth > 0 else 0.0
            self.assertAlmostEqual(row["closed_form_y"], wanted, delta=2e-3)  # of straight pieces of 1 ms
        self.assertLess(told["tip"]["error"]["rms_share"], 0.1)

    def test_energy(self):
        """Fails if the energy that is reported is not what motors and brakes have taken: a field takes what it
        takes."""
        net = self.network({"map": {"along": [1, 0]}, "network": {"damper": "1 N s/m"}},
                           {"map": {"along": [0, 1]}, "network": {"damper": "1 N s/m"}})
        _, told = self.played(net, self.device(), table(along(round_the_middle, 1 / 2000)))
        # ∫ v² dt over a second of 12 mm at 1 Hz and 10 mm at 2 Hz. Couplings are the motors', from estimates half a
        # sample late.
        wanted = (0.012 * 2 * math.pi) ** 2 / 2 + (0.01 * 4 * math.pi) ** 2 / 2
        self.assertAlmostEqual(told["energy"]["taken"] / wanted, 1, delta=0.01)
        self.assertGreaterEqual(told["energy"]["lowest"], 0)

    def test_columns(self):
        """Fails if joints in degrees, in another order or among other columns are played as another motion."""
        net = self.network({"map": {"along": [1, 0]}, "network": KELVIN})
        recorded = along(round_the_middle, 0.005)
        first = self.played(net, self.device(), table(recorded))
        degrees = [(7, 1000 * t, math.degrees(b), math.degrees(a)) for t, a, b in recorded]
        second = self.played(net, self.device(), "# by the rig\n" + table(degrees, "trial,t [ms],q2 [deg],q1 (deg)"))
        for one, other in zip(first[0], second[0]):
            self.assertAlmostEqual(one["felt_torque_1"], other["felt_torque_1"], delta=1e-7)
        # What it has written it plays again.
        again = self.played(net, self.device(), (self.folder / "felt.csv").read_text())
        self.assertAlmostEqual(again[1]["joints"][0]["force"]["rms"], second[1]["joints"][0]["force"]["rms"],
                               delta=1e-9)

    def test_the_same_run(self):
        """Fails if a run is not the same from the same seed, or single precision is another law."""
        motion = table(along(round_the_middle, 0.01))
        self.played(FIELD, PANTOGRAPH, motion)
        first = (self.folder / "felt.csv").read_bytes()
        _, double = self.played(FIELD, PANTOGRAPH, motion)
        self.assertEqual(first, (self.folder / "felt.csv").read_bytes())
        self.played(FIELD, PANTOGRAPH, motion, "--seed", "7")
        self.assertNotEqual(first, (self.folder / "felt.csv").read_bytes())
        _, single = self.played(FIELD, PANTOGRAPH, motion, "--scalar", "float")
        self.assertAlmostEqual(single["tip"]["error"]["rms_share"], double["tip"]["error"]["rms_share"], delta=0.01)

    def test_nothing_to_be_relative_to(self):
        """Fails if an error is called none where the force that it would be a share of is 0 throughout."""
        net = self.network({"map": {"along": [1, 0]}, "network": KELVIN})
        device = self.device("cartesian", motors={"noise": "10 mN"})
        _, told = self.played(net, device, table([(0, 0, 0.095), (0.1, 0, 0.095)]))
        for error in (told["joints"][0]["error"], told["joints"][1]["error"], told["tip"]["error"]):
            self.assertGreater(error["rms"], 0)
            self.assertEqual((error["rms_share"], error["peak_share"]), (None, None))
        said = self.dashpot("run", net, "--device", device, "--motion", "motion.csv", "-o", "felt.csv").stdout
        self.assertRegex(said, r"error of what joint 2 feels: rms [\d.]+ N, peak [\d.]+ N\n")

    def test_forces_beyond_all_numbers(self):
        """Fails if what overflows is told as a number."""
        net = self.network({"map": {"along": [1, 0]}, "network": KELVIN})
        self.write("motion.csv", table([(0, 0, 0.095), (0.001, 1e308, 0.095), (0.002, -1e308, 0.095)]))
        told = self.refused("run", net, "--device", self.device("cartesian"), "--motion", "motion.csv", "-o",
                            "felt.csv", code="answer-not-finite").stderr
        self.assertIn("at 0 s the force overflows: the position is 0 and the velocity ", told)
        self.assertNotIn("felt.csv", self.files())

    def test_refusals(self):
        """Fails if a recording that makes no motion of the arm is played, or refused without its place."""
        net = self.network({"map": {"along": [1, 0]}, "network": KELVIN})
        run = ["run", net, "--device", self.device(), "--motion", "motion.csv"]
        q1, q2 = joints_of(0, 0.095)
        self.write("motion.csv", table([(0, q1, q2), (0.1, q1, q2), (0.2, 3.1, 0.05)]))
        self.assertIn("motion.csv:4:1: error: cannot start 'arm': its links do not meet with the joints at 3.1 and "
                      "0.05 rad",
                      self.refused(*run, code="cannot-start-device").stderr)
        self.write("motion.csv", table([(0, 10, 10), (0.1, 10, 10)], "time,q1 [mm],q2 [mm]"))
        self.assertIn("motion.csv:1:", self.refused(*run, code="csv-other-motion").stderr)
        self.write("motion.csv", "time,q1,q2\n0,1,1\n0.1,a,1\n")
        self.assertIn("motion.csv:3:", self.refused(*run, code="csv-not-a-number").stderr)
        self.write("motion.csv", table(along(lambda t: (0.045 * math.sin(2 * math.pi * t), 0.095), 0.01)))
        self.assertIn("from -45 to 45, beyond the device's range of -40 to 40 mm in x of the tip",
                      self.dashpot(*run, "-o", "felt.csv").stderr)
        self.write("motion.csv", table([(0, q1, q2), (0.1, q1, q2 + 0.01), (0.2, q1, q2)]))
        slow = self.device(encoders={"max_speed": "0.09 rad/s"})
        self.assertIn("warning: from 0 s joint 2 goes at 0.1 rad/s, faster than the device's 0.09 rad/s; its "
                      "servo loop would go safe there [motion-too-fast]",
                      self.dashpot("run", net, "--device", slow, "--motion", "motion.csv", "-o", "felt.csv").stderr)
        self.device()
        self.assertNotIn("[motion-too-fast]", self.dashpot(*run, "-o", "felt.csv").stderr)
        for more in (["--hand", "firm"], ["--for", "1"]):
            self.refused(*run, *more, code="not-with-motion", status=COMMAND_LINE_WRONG)
        self.refused(*run, "-o", "motion.csv", code="would-overwrite-input", status=COMMAND_LINE_WRONG)
        self.dashpot(*run[:-1], "absent.csv", status=INPUT_REFUSED)


if __name__ == "__main__":
    unittest.main()
