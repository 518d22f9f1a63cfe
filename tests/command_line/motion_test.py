"""`dashpot run --motion`: what is felt of a recorded motion on a described device."""
import csv
import io
import json
import math
import re
import unittest

from dashpot_command import COMMAND_LINE_WRONG, FIG_5, INPUT_REFUSED, KELVIN, PANTOGRAPH, SOURCE, CommandTest, network

COLUMNS = ["time", "position", "estimate", "felt_force", "closed_form", "damping", "motor_force"]
TUNABLE = SOURCE / "networks/tunable/friction_tunable.json"
SOLID = '{ "parallel": [ { "spring": 40 }, { "damper": 0.7 }, { "series": [ { "spring": 90 }, { "damper": 4 } ] }, ' \
        '{ "series": [ { "spring": 300 }, { "damper": 1 } ] } ] }'
FRICTION = '{ "parallel": [ { "spring": 40 }, { "series": [ { "spring": 2000 }, { "slip": 0.3 } ] } ] }'


def table(rows, names="time,position"):
    return names + "\n" + "".join(",".join(f"{value:.9g}" for value in row) + "\n" for row in rows)


def sine(rate, seconds=1.0, amplitude=0.003, frequency=2.0):
    return [(k / rate, amplitude * (1 - math.cos(2 * math.pi * frequency * k / rate)))
            for k in range(int(seconds * rate) + 1)]


class Motion(CommandTest):
    def device(self, **changes):
        """A paddle without imperfection but for `changes` of its sections."""
        told = {"dashpot_device": 1, "name": "paddle", "motion": "translation", "loop": {"rate": "2 kHz"},
                "velocity": {"estimator": "backward_difference", "window": 1}, "motor": {},
                "brake": {"kind": "eddy_current", "max_damping": "50 N s/m"},
                "mechanics": {"inertia": "0.2 kg", "damping": "20 N s/m"}}
        for section, more in changes.items():
            told[section] = told[section] | more if section in told and section != "velocity" else more
        return self.write("device.json", json.dumps(told))

    def played(self, net, device, motion, *choices):
        """Rows of the file, and what is printed, as JSON."""
        self.write("motion.csv", motion)
        told = json.loads(self.dashpot("run", net, "--device", device, "--motion", "motion.csv", "-o", "felt.csv",
                                       "--json", *choices).stdout)
        rows = list(csv.reader(io.StringIO((self.folder / "felt.csv").read_text())))
        self.assertEqual(rows[0], COLUMNS)
        return [dict(zip(COLUMNS, map(float, row))) for row in rows[1:]], told

    def test_brake_that_rises_late(self):
        """Fails if a law is certified although its motor takes out of the brake's command what a lagging coil does not
        make yet: a hand that moves whenever a parameter has raised that command, and rests until it has fallen, then
        gets energy out of it."""
        net = self.write("law.json", json.dumps({
            "dashpot": 1, "name": "law",
            "parameters": {"B": {"value": "8 N s/m", "tunable": True, "min": "0.5 N s/m", "max": "8 N s/m"}},
            "network": {"parallel": [{"series": [{"spring": 500}, {"damper": "B"}]}, {"spring": 20}]}}))
        rows, position = [], 0.0
        for k in range(2601):
            strokes, at = divmod(k, 130)
            rows.append((k / 1000, position, 8 if at < 15 else 0.5))
            if at < 15:
                position += -0.9e-3 if strokes % 2 else 0.9e-3
        motion = table(rows, "time,position,B")
        needed = {}
        for lag in ["0 ms", "20 ms"]:
            device = self.device(loop={"rate": "1 kHz"}, brake={"max_damping": "12 N s/m", "coil_lag": lag},
                                 mechanics={"damping": "0.5 N s/m"})
            for choice in [("--decomposition", "paper"), ()]:
                told = self.played(net, device, motion, *choice)[1]
                stated = json.loads(self.dashpot("explain", net, "--device", device, "--json", *choice).stdout)
                self.assertTrue(stated["certificate"]["certified"])
                self.assertGreater(told["energy"]["lowest"], -1e-9, (lag, choice))
                needed[lag, choice] = stated["certificate"]["needed_damping"]
        paper = ("--decomposition", "paper")
        # The motor may take out 8 N s/m while the brake still makes 0.5: what is needed grows by the difference.
        self.assertAlmostEqual(needed["20 ms", paper] - needed["0 ms", paper], 7.5, places=6)

    def test_closed_form(self):
        """Fails if the network's force along a recorded motion is not that of its relaxations, at whatever rate it was
        recorded."""
        net = self.write("solid.json", network(SOLID, "solid"))
        points = [(0.0, 0.0), (0.25, 0.004), (0.5, 0.004), (0.75, 0.001)]
        rows, _ = self.played(net, self.device(), table(points))
        self.assertEqual(len(rows), 1501)
        slope = lambda t: 0.016 if t < 0.25 else 0 if t < 0.5 else -0.012
        for row in rows[:-1:37]:
            t = row["time"]
            u = 0.016 * t if t < 0.25 else 0.004 if t < 0.5 else 0.004 - 0.012 * (t - 0.5)
            force = 40 * u + 0.7 * slope(t)
            for rate, damping in [(90 / 4, 4), (300, 1)]:
                inside = 0.0
                for start, end, v in [(0, 0.25, 0.016), (0.25, 0.5, 0), (0.5, 0.75, -0.012)]:
                    if t > start:
                        inside = damping * v + (inside - damping * v) * math.exp(-rate * (min(t, end) - start))
                force += inside
            self.assertAlmostEqual(row["position"], u, delta=1e-9)
            self.assertAlmostEqual(row["closed_form"], force, delta=1e-9)

    def test_a_device_without_imperfection(self):
        """Fails if what is felt on an exact device is off by more than half a sample of the motor's hold."""
        net = self.write("solid.json", network(SOLID, "solid"))
        errors = []
        for rate in (2000, 8000):
            rows, told = self.played(net, self.device(loop={"rate": f"{rate} Hz"}), table(sine(rate)),
                                     "--decomposition", "velocity-free", "--state-input", "position")
            errors.append(told["error"]["rms_share"])
            differences = [row["felt_force"] - row["closed_form"] for row in rows]
            added = max(abs(value) for value in differences)
            self.assertAlmostEqual(told["error"]["peak"], added, delta=1e-12 * added)
            self.assertAlmostEqual(told["error"]["rms"], math.sqrt(sum(d * d for d in differences) / len(rows)),
                                   delta=1e-12)
            self.assertAlmostEqual(told["force"]["peak"], max(abs(row["closed_form"]) for row in rows), delta=1e-12)
        self.assertLess(errors[0], 0.02)
        self.assertLess(errors[1], errors[0] / 2)

    def test_each_imperfection_is_felt(self):
        """Fails if encoder, estimator, delay, amplifier or coil takes no part in what is felt."""
        net = self.write("solid.json", network(SOLID, "solid"))
        choices = ["--decomposition", "3"]
        _, exact = self.played(net, self.device(), table(sine(2000)), *choices)
        changes = {"encoder": {"encoder": {"resolution": "0.5 mm"}},
                   "estimator": {"velocity": {"estimator": "butterworth", "order": 4, "cutoff": "20 Hz"}},
                   "delay": {"loop": {"delay_samples": 20}}, "amplifier": {"motor": {"amplifier_lag": "15 ms"}},
                   "coil": {"brake": {"coil_lag": "200 ms"}}, "limit": {"motor": {"max_torque": "0.05 N"}}}
        for name, change in changes.items():
            with self.subTest(name=name):
                device = self.device(**change)
                more = ["--decomposition", "0"] if name == "limit" else choices
                _, told = self.played(net, device, table(sine(2000)), *more)
                # A coil has settled before the motion begins, and b does not change: it is the one that is not felt.
                if name == "coil": self.assertAlmostEqual(told["error"]["rms"], exact["error"]["rms"],
                                                          delta=1e-3 * exact["force"]["rms"])
                else: self.assertGreater(told["error"]["rms"], 2 * exact["error"]["rms"])

    def test_what_the_brake_and_the_motor_do(self):
        """Fails if the brake's command, what of it is there for passivity, or forces that the motor cannot make are not
        reported."""
        net = self.write("spring.json", network('{ "spring": 200 }', "spring"))
        device = self.device(mechanics={"damping": "0 N s/m"}, motor={"max_torque": "1 N"})
        rows, told = self.played(net, device, table(sine(2000)), "--decomposition", "velocity-free")
        damping = [row["damping"] for row in rows]
        self.assertGreater(damping[0], 0)
        self.assertEqual((told["brake"]["most"], told["brake"]["for_passivity"]), (damping[0], damping[0]))
        self.assertAlmostEqual(told["brake"]["mean"], damping[0], delta=1e-12)
        # 200 N/m times up to 6 mm are more than 1 N for a third of the time; where a law sheds, it has less to make on
        # the way back.
        self.assertGreater(told["limited_samples"], 0.1 * len(rows))
        printed = self.dashpot("run", net, "--device", device, "--motion", "motion.csv", "-o", "felt.csv",
                               "--decomposition",
                               "velocity-free").stdout
        self.assertIn(f"the brake's command is {damping[0]:.4g} N s/m on average, {damping[0]:.4g} at most; "
                      f"{damping[0]:.4g} of it are for passivity alone\n", printed)
        self.assertIn(f"the motor's limits: reached in {told['limited_samples']} samples of {len(rows)}; ", printed)
        _, strong = self.played(net, self.device(), table(sine(2000)), "--decomposition", "velocity-free")
        self.assertEqual(strong["limited_samples"], 0)

    def test_a_late_spring(self):
        """Fails if a spring n samples late is not felt as the spring that it was n and a half samples ago."""
        net = self.write("spring.json", network('{ "spring": 200 }', "spring"))
        for delay in (0, 3):
            rows, _ = self.played(net, self.device(loop={"delay_samples": delay}, motor={"max_torque": "100 N"}),
                                  table(sine(2000)), "--decomposition", "velocity-free")
            for row in rows[100:1900:83]:
                past = row["time"] - (delay + 0.5) / 2000
                # The staircase is felt as the mean of two steps, and damping is added for passivity.
                wanted = 200 * 0.003 * (1 - math.cos(
                    4 * math.pi * past)) + row["damping"] * 0.003 * 4 * math.pi * math.sin(4 * math.pi * row["time"])
                self.assertAlmostEqual(row["felt_force"], wanted, delta=2e-3 * (1 + abs(wanted)))

    def test_slips_and_tunables(self):
        """Fails if what is no linear network has no force of its own to compare with, or another one."""
        net = self.write("friction.json", network(FRICTION, "friction"))
        rows, told = self.played(net, self.device(), table(sine(500)))
        for row in rows[300:450:10]:  # pressing: the slip slides
            self.assertAlmostEqual(row["closed_form"], 40 * row["position"] + 0.3, delta=2e-3)
        self.assertLess(told["error"]["rms_share"], 0.1)
        recorded = [(t, u, 0.2 if t < 0.5 else 1.0) for t, u in sine(500)]
        name = next(p for p, v in json.loads(TUNABLE.read_text())["parameters"].items() if v.get("tunable"))
        still, _ = self.played(TUNABLE, self.device(), table(sine(500)))
        changed, _ = self.played(TUNABLE, self.device(), table(recorded, f"time,position,{name}"))
        self.assertNotEqual([row["closed_form"] for row in still], [row["closed_form"] for row in changed])

    def soft(self):
        """A spring that can be made softer."""
        return self.write("soft.json", """{"dashpot": 1, "name": "soft", "network": {"spring": "K"}, "parameters":
            {"K": {"value": "100 N/m", "min": "10 N/m", "max": "200 N/m", "tunable": true}}}""")

    def test_a_column_is_told_of_once(self):
        """Fails if a misspelt column of values is told of the law on the device and again of the network's own."""
        self.write("motion.csv", table([(k / 2000, 0.01, 49) for k in range(40)], "time,position,k"))
        told = self.dashpot("run", self.soft(), "--device", self.device(), "--motion", "motion.csv").stderr
        self.assertEqual(told.count("[csv-misspelt-tunable]"), 1, told)

    def test_values_of_the_first_row(self):
        """Fails if the network's own force begins with other values than the first row sets, as the device does."""
        motion = table([(k / 2000, 0.01, 49) for k in range(40)], "time,position,K")
        rows, _ = self.played(self.soft(), self.device(), motion)
        self.assertAlmostEqual(rows[0]["motor_force"], 0.7)  # of a softer spring F √(k′/k), all energy that there is
        self.assertAlmostEqual(rows[0]["closed_form"], rows[0]["motor_force"], delta=1e-15)

    def test_a_static_curve(self):
        """Fails if a network behind a static curve is compared with the straight one that stands in its file."""
        net = self.write("curve.json",
                         network(SOLID, "curve", '"static": { "power": 1.5, "force": "2 N", "at": "10 mm" }, '
                                                 '"valid": { "displacement": "10 mm", "rate": "50 mm/s" },'))
        seconds, depth = 20, 0.008
        held = [(k / 100, depth * min(k / 100, 1)) for k in range(100 * seconds + 1)]
        rows, told = self.played(net, self.device(), table(held))
        # Held for longer than any relaxation it answers with its curve, to the 1e-3 of the map's cubics.
        self.assertAlmostEqual(rows[-1]["closed_form"], 2 * 0.8 ** 1.5, delta=2e-3)
        self.assertAlmostEqual(rows[-1]["felt_force"], rows[-1]["closed_form"], delta=0.02)
        self.assertLess(told["error"]["rms_share"], 0.1)

    def test_slips_behind_a_static_curve(self):
        """Fails if the error that is reported of slips behind a static curve leaves out the curve, or the damping that
        the curve needs for passivity, or if it depends on where the surface lies."""
        device = self.device(loop={"delay_samples": 1}, encoder={"resolution": "2 um"},
                             mechanics={"damping": "0.8 N s/m"},
                             velocity={"estimator": "backward_difference", "window": 4},
                             brake={"max_damping": "10 N s/m", "coil_lag": "2 ms"})
        friction = '{ "parallel": [ { "spring": 150 }, { "series": [ { "spring": 800 }, { "slip": 0.3 } ] } ] }'
        curve = ('"static": { "exponential": "200 1/m", "force": "2 N", "at": "10 mm" }, '
                 '"valid": { "displacement": "12 mm", "rate": "1 m/s" },')
        told = {}
        for surface in ["", "0 mm", "1 mm"]:
            contact = f'"contact": {{ "at": "{surface}" }}, ' if surface else ""
            net = self.write("curve.json", network(friction, "curve", curve + contact))
            said = re.sub(r"\s+", " ", self.dashpot("check", net, "--device", device).stderr)
            found = re.search(r"worst of these motions is a sine of ([\d.]+) Hz and ±([\d.]+) m, with ([\d.]+) %", said)
            self.assertIsNotNone(found, said)
            frequency, amplitude, error = told[surface] = tuple(map(float, found.groups()))
            at = 0.001 if surface == "1 mm" else 0.0
            motion = [(k / 8000, at + amplitude * math.sin(2 * math.pi * frequency * k / 8000)) for k in range(1001)]
            rows, _ = self.played(net, device, table(motion))
            # Inside the record: at its ends the tool jumps from rest to full speed and back.
            forces = [(row["felt_force"], row["closed_form"]) for row in rows[2:-2]]
            rms = lambda values: math.sqrt(sum(v * v for v in values) / len(values))
            measured = 100 * max(max(abs(f - c) for f, c in forces) / max(abs(c) for _, c in forces),
                                 rms([f - c for f, c in forces]) / rms([c for _, c in forces]))
            # The runs begin with such a jump too, and are looked at four times a sample: they err by more, not by much.
            self.assertLess(measured, 1.05 * error, surface)
            self.assertGreater(measured, 0.5 * error, surface)
        self.assertEqual(told["0 mm"], told["1 mm"])

    def test_a_rotation_on_a_device_with_an_arm(self):
        """Fails if a network that rotates is led by the arm of a device that has one: the joint is then its tool."""
        knob = self.write("knob.json",
                          json.dumps({"dashpot": 1, "name": "knob", "motion": "rotation", "network": {"parallel": [
            {"spring": "20 mN m/rad"}, {"damper": "0.5 mN m s/rad"}]}}))
        swing = table([(k / 500, 0.3 * (1 - math.cos(4 * math.pi * k / 500))) for k in range(501)])
        told = {"dashpot_device": 1, "name": "rig", "motion": "rotation", "loop": {"rate": "2 kHz"},
                "encoder": {"counts_per_turn": 16000, "range": ["-60 deg", "60 deg"]},
                "velocity": {"estimator": "backward_difference", "window": 4}, "motor": {"max_torque": "0.25 N m"},
                "brake": {"kind": "eddy_current", "max_damping": "10 mN m s/rad"},
                "mechanics": {"inertia": "0.15 g m^2"}}
        bare = self.write("bare.json", json.dumps(told))
        arm = self.write("arm.json", json.dumps({**told, "arm_radius": "60 mm"}))
        rows, without = self.played(knob, bare, swing)
        same, with_arm = self.played(knob, arm, swing)
        self.assertEqual(rows, same)
        self.assertEqual(with_arm["error"], without["error"])
        self.assertAlmostEqual(max(row["position"] for row in same), 0.6, delta=1e-6)
        # A hand, too: it holds the joint.
        runs = [self.dashpot("run", knob, "--device", device, "--fast", "--for", "1", "--hand", "firm", "-o",
                             f"{name}.csv").stdout
                for name, device in (("bare_run", bare), ("arm_run", arm))]
        self.assertEqual(*[(self.folder / f"{name}.csv").read_text().split("\n", 1)[1:]
                           for name in ("bare_run", "arm_run")])
        self.assertIn("left safe", runs[1])

    def test_another_rate(self):
        """Fails if a motion's rate has to be the device's, or changes what is felt of the same straight lines."""
        net = self.write("kelvin.json", KELVIN)
        coarse = [(k / 4, 0.001 * (k % 2)) for k in range(9)]
        fine = [(k / 64, 0.001 * (1 - abs((k / 16) % 2 - 1))) for k in range(129)]
        results = [self.played(net, self.device(), table(rows))[0] for rows in (coarse, fine)]
        for one, other in zip(*results):
            self.assertAlmostEqual(one["felt_force"], other["felt_force"], delta=1e-8)
            self.assertAlmostEqual(one["closed_form"], other["closed_form"], delta=1e-8)
        self.assertEqual(*map(len, results))

    def test_times_since_an_epoch(self):
        """Fails if times so late that a double rounds them lose the last row, or make another motion of it."""
        net = self.write("solid.json", network(SOLID, "solid"))
        positions = [0.003 * math.sin(0.05 * k) for k in range(100)]
        told = [self.played(net, self.device(), "time,position\n" + "".join(
            f"{start + k / 1000:.3f},{position}\n" for k, position in enumerate(positions)))
            for start in (0, 1_700_000_000)]
        self.assertEqual(told[0][1]["samples"], 199)
        self.assertEqual(told[0], told[1])

    def test_nothing_to_be_relative_to(self):
        """Fails if an error is called none where the force that it would be a share of is 0 throughout."""
        net = self.write("kelvin.json", KELVIN)
        device = self.device(motor={"noise": "10 mN"})
        _, told = self.played(net, device, table([(0, 0), (0.1, 0), (0.2, 0)]))
        self.assertEqual(told["force"], {"rms": 0, "peak": 0})
        self.assertGreater(told["error"]["rms"], 0)
        self.assertEqual((told["error"]["rms_share"], told["error"]["peak_share"]), (None, None))
        said = self.dashpot("run", net, "--device", device, "--motion", "motion.csv", "-o", "felt.csv").stdout
        self.assertRegex(said, r"felt error: rms [\d.]+ N, peak [\d.]+ N\n")

    def test_a_structure_that_gives(self):
        """Fails if a motion of the tool is played on a device whose shaft it does not tell, as its page says."""
        self.write("motion.csv", table(sine(250)))
        soft = self.device(mechanics={"mode": {"frequency": "50 Hz", "mass": "0.1 kg"}})
        self.assertIn("does not say how a structure that gives moves the shaft",
                      self.refused("run", self.write("kelvin.json", KELVIN), "--device", soft, "--motion", "motion.csv",
                                   code="cannot-start-device").stderr)

    def test_a_mean_is_no_more_than_the_most(self):
        """Fails if rounding makes a brake on average stronger than it ever is."""
        for damping in (0.1, 0.7, 1.3):
            net = self.write("damper.json", network(f'{{ "damper": {damping} }}', "damper"))
            _, told = self.played(net, self.device(), table(sine(2000)))
            self.assertEqual(told["brake"]["mean"], told["brake"]["most"])

    def test_forces_beyond_all_numbers(self):
        """Fails if what overflows is told as a number, in the file or in what is summed up of it."""
        net = self.write("kelvin.json", KELVIN)
        for position in (1e308, 1e200):
            self.write("motion.csv", table([(0, 0), (0.001, position), (0.002, -position)]))
            told = self.refused("run", net, "--device", self.device(), "--motion", "motion.csv", "-o", "felt.csv",
                                code="answer-not-finite")
            self.assertIn("at 0 s the force overflows: the position is 0 and the velocity ", told.stderr)
            self.assertNotIn("felt.csv", self.files())

    def test_a_motion_faster_than_the_device_allows(self):
        """Fails if a motion on which the loop would go safe is played without a word, or another warned of."""
        net = self.write("kelvin.json", KELVIN)
        self.write("motion.csv", table([(0, 0), (0.1, 0.001), (0.2, -0.002), (0.3, -0.002)]))
        run = ["run", net, "--motion", "motion.csv", "-o", "felt.csv", "--device"]
        self.assertIn("motion.csv:1:1: warning: from 0.1 s the motion goes at -0.03 m/s, faster than the device's 0.02 "
                      "m/s; its servo loop would go safe there [motion-too-fast]",
                      self.dashpot(*run, self.device(encoder={"max_speed": "20 mm/s"})).stderr)
        for more in ({"encoder": {"max_speed": "31 mm/s"}}, {}):
            self.assertNotIn("[motion-too-fast]", self.dashpot(*run, self.device(**more)).stderr)

    def test_what_is_printed_and_written(self):
        """Fails if the errors are not reported, the file is not where it is said to be, or a run is not the same from
        the same seed."""
        self.write("motion.csv", table(sine(250)))
        done = self.dashpot("run", FIG_5, "--device", PANTOGRAPH, "--motion", "motion.csv")
        for words in ["10001 samples at 10000 Hz", "felt error: rms ", "energy: ",
                      "log: second_order_maxwell_run.csv"]:
            self.assertIn(words, done.stdout)
        first = (self.folder / "second_order_maxwell_run.csv").read_text()
        self.dashpot("run", FIG_5, "--device", PANTOGRAPH, "--motion", "motion.csv", "-o", "again.csv")
        self.assertEqual(first, (self.folder / "again.csv").read_text())
        self.dashpot("run", FIG_5, "--device", PANTOGRAPH, "--motion", "motion.csv", "-o", "again.csv", "--seed", "7")
        self.assertNotEqual(first, (self.folder / "again.csv").read_text())

    def test_energy(self):
        """Fails if the energy that is reported is not what the device has taken: a spring whose force is held for a
        period gives back k Δu²/2 in each more than it took, and a damper takes what it takes."""
        rows = sine(2000)
        travel = sum((b[1] - a[1]) ** 2 for a, b in zip(rows, rows[1:]))
        net = self.write("spring.json", network('{ "spring": 3000 }', "spring"))
        _, told = self.played(net, self.device(), table(rows), "--decomposition", "velocity-free")
        self.assertAlmostEqual(told["energy"]["taken"] / (-1500 * travel), 1, delta=1e-6)
        self.assertLess(told["energy"]["lowest"], -1499 * travel)
        net = self.write("damper.json", network('{ "damper": 4 }', "damper"))
        _, told = self.played(net, self.device(), table(rows))
        # The simulated shaft takes steps of its own, which round the corners between rows.
        self.assertAlmostEqual(told["energy"]["taken"] / (4 * travel * 2000), 1, delta=1e-4)
        self.assertEqual(told["energy"]["lowest"], 0)

    def test_a_start_that_is_loaded(self):
        """Fails if what the network holds as the motion begins is not reported, so that giving it out passes for energy
        made."""
        rows = [(k / 2000, 0.004 if k < 200 else max(0.0, 0.004 - 0.01 * (k - 200) / 2000)) for k in range(1200)]
        net = self.write("spring.json", network('{ "spring": 3000 }', "spring"))
        _, told = self.played(net, self.device(), table(rows), "--decomposition", "velocity-free")
        self.assertAlmostEqual(told["energy"]["stored_at_start"], 3000 * 0.004**2 / 2, delta=1e-9)
        self.assertLess(told["energy"]["lowest"], -0.02)
        said = self.dashpot("run", net, "--device", "device.json", "--motion", "motion.csv", "-o", "felt.csv").stdout
        self.assertIn("the network held 0.024 J as the motion began", said)

    def test_a_motion_beyond_what_the_network_is_valid_for(self):
        """Fails if run is silent where simulate warns."""
        net = self.write("valid.json", network('{ "spring": 30 }', "valid",
                                               '"valid": { "displacement": ["0 mm", "1 mm"], "rate": ["0 m/s", "1 '
                                               'mm/s"] },'))
        self.write("motion.csv", table(sine(2000)))
        played = self.dashpot("run", net, "--device", self.device(), "--motion", "motion.csv", "-o", "felt.csv").stderr
        simulated = self.dashpot("simulate", net, "--input", "motion.csv").stderr
        for said in [played, simulated]:
            self.assertEqual(said.count("[outside-valid-range]"), 2)
        self.assertEqual(re.findall("warning: (.*) .outside-valid-range", played),
                         re.findall("warning: (.*) .outside-valid-range", simulated))

    def test_refusals(self):
        """Fails if a command line that means nothing is taken, a bad recording played, or a motion out of reach not
        warned of."""
        self.write("motion.csv", table(sine(250)))
        net = self.write("kelvin.json", KELVIN)
        run = ["run", net, "--device", self.device()]
        for more in (["--hand", "firm"], ["--for", "1"], ["--port", "pty:"]):
            self.refused(*run, "--motion", "motion.csv", *more, code="not-with-motion", status=COMMAND_LINE_WRONG)
        self.refused(*run, "--json", code="motion-only", status=COMMAND_LINE_WRONG)
        self.refused(*run, "--motion", "motion.csv", "-o", "motion.csv", code="would-overwrite-input",
                     status=COMMAND_LINE_WRONG)
        self.write("bad.csv", "time,position\n0,0\n0.1,a\n")
        self.dashpot(*run, "--motion", "bad.csv", status=INPUT_REFUSED)
        self.dashpot(*run, "--motion", "absent.csv", status=INPUT_REFUSED)
        short = self.device(encoder={"range": ["-1 mm", "1 mm"]})
        self.assertIn("[motion-beyond-encoder]",
                      self.dashpot("run", net, "--device", short, "--motion", "motion.csv").stderr)

    def test_simulate_is_the_law_alone(self):
        """Fails if simulate lets one think that its numbers are what is felt on the device."""
        self.write("motion.csv", table(sine(2000)))
        net = self.write("kelvin.json", KELVIN)
        self.assertIn("'dashpot run --motion' shows what is felt",
                      self.dashpot("simulate", net, "--device", self.device(), "--input", "motion.csv").stderr)
        self.assertEqual(self.dashpot("simulate", net, "--input", "motion.csv").stderr, "")
        self.write("slow.csv", table(sine(250)))
        told = self.refused("simulate", net, "--device", self.device(), "--input", "slow.csv",
                            code="csv-rate-contradicts", status=COMMAND_LINE_WRONG)
        self.assertIn("'dashpot run --motion' plays a recording of any rate", told.stderr)


if __name__ == "__main__":
    unittest.main()
