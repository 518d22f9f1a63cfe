#!/usr/bin/env python3
"""`dashpot run` and `dashpot device` as a user types them. No time is asserted: machines here are shared."""
import argparse
import csv
import glob
import json
import math
import os
import resource
import select
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ARGUMENTS = None


def command(*words):
    """Without the search for what would help, which takes longer than a run and has its own tests."""
    return [ARGUMENTS.dashpot, *words, *(["--no-advice"] if words[0] == "run" else [])]


def dashpot(*words, environment=None, folder=None):
    return subprocess.run(command(*words), capture_output=True, text=True, cwd=folder,
                          env={**os.environ, **(environment or {})}, timeout=300)


def network(name):
    return os.path.join(ARGUMENTS.root, "networks", name + ".json")


def device(name):
    return os.path.join(ARGUMENTS.root, "runtime", "devices", name + ".json")


class Run(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.log = os.path.join(self.folder.name, "log.csv")

    def run_fast(self, network_name, device_name, *more, log=None):
        return dashpot("run", network(network_name), "--device", device(device_name), "--for", "1", "--fast", "--log",
                       log or self.log, *more)

    def test_every_device_file_can_be_run(self):
        """Fails if a shipped device file describes something that cannot be simulated, or that faults under a hand."""
        for name in ("pantograph_brake_2009", "phantom_single_motor", "phantom_shorted_motor", "board_mps2"):
            with self.subTest(device=name):
                result = self.run_fast("paper/kelvin", name)
                self.assertEqual(result.returncode, 0, result.stderr + result.stdout)
                self.assertIn("device left safe", result.stdout)
        result = self.run_fast("axes/kelvin_field", "arm_board_mps2")
        self.assertEqual(result.returncode, 0, result.stderr + result.stdout)
        self.assertIn("device left safe", result.stdout)

    def test_log_holds_every_period_with_its_units(self):
        """Fails if the log loses rows, or no longer names its columns."""
        self.assertEqual(self.run_fast("paper/kelvin", "phantom_shorted_motor").returncode, 0)
        with open(self.log, newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual([int(row["period"]) for row in rows], list(range(1000)))
        self.assertGreater(max(float(row["position [m]"]) for row in rows), 1e-4)
        stiffness = 100.0  # of networks/paper/kelvin.json [N/m]
        velocity_gain = 2.0 - 0.6  # what the brake does not reach [N·s/m]
        for row in rows:
            made = stiffness * float(row["position [m]"]) + velocity_gain * float(row["velocity [m/s]"])
            self.assertAlmostEqual(float(row["motor_force [N]"]), made, delta=1e-12)

    def test_a_value_from_the_command_line(self):
        """Fails if --set does not reach the law that drives the device, or if the energy is reported without whose it
        is."""
        result = self.run_fast("paper/kelvin", "phantom_shorted_motor", "--set", "K=250")
        self.assertRegex(result.stdout, r"energy +[-0-9.e]+ J that motor and brake took from the tool")
        with open(self.log, newline="") as stream:
            rows = list(csv.DictReader(stream))
        for row in rows:
            made = 250.0 * float(row["position [m]"]) + (2.0 - 0.6) * float(row["velocity [m/s]"])
            self.assertAlmostEqual(float(row["motor_force [N]"]), made, delta=1e-12)

    def test_who_reads_along_sees_no_fault_where_none_was(self):
        """Fails if the line that is printed while the loop runs counts faults that nobody had, or leaves out how it
        ended."""
        result = dashpot("run", network("paper/kelvin"), "--device", device("phantom_shorted_motor"), "--for", "2.5",
                         "--fast", "--log", self.log)
        lines = [line for line in result.stdout.splitlines() if " Hz  late " in line]
        self.assertEqual([line.split(" s ")[0].strip() for line in lines], ["1.0", "2.0", "2.5"], result.stdout)
        for line in lines:
            self.assertTrue(line.endswith("faults 0"), line)

    def test_simulated_time_is_repeatable(self):
        """Fails if anything but the seed decides a simulated run."""
        logs = [os.path.join(self.folder.name, name) for name in ("a.csv", "b.csv")]
        for log in logs:
            self.assertEqual(self.run_fast("tissues/human_liver_normal", "pantograph_brake_2009", "--seed", "7",
                                           log=log).returncode, 0)
        with open(logs[0], "rb") as first, open(logs[1], "rb") as second:
            self.assertEqual(first.read(), second.read())

    def test_what_is_not_certified_is_said_before_it_is_driven(self):
        """Fails if a law that its device may not hold is driven without a warning, or one that it holds is warned
        of."""
        for network_name, device_name, code in [("paper/kelvin", "phantom_single_motor", "drives-uncertified"),
                                                ("paper/virtual_wall", "pantograph_brake_2009", "nothing-proved"),
                                                ("paper/kelvin", "board_mps2", None)]:
            told = self.run_fast(network_name, device_name).stderr
            self.assertEqual([found for found in ("drives-uncertified", "nothing-proved") if f"[{found}]" in told],
                             [code] if code else [], told)
            if code:
                self.assertLess(told.index(f"[{code}]"), told.index(": running"))
                self.assertEqual(told.count("warning:"),
                                 len(set(line for line in told.splitlines() if "warning:" in line)))
        array = self.run_fast("paper/kelvin", "phantom_single_motor", "--diagnostics=json").stderr
        self.assertIn("drives-uncertified", [found["code"] for found in json.loads(array[array.index("["):])])

    def test_interrupt_leaves_the_device_safe(self):
        """Fails if Ctrl-C ends the program before the device has the safe command."""
        with open(device("phantom_shorted_motor")) as stream:
            patient = json.load(stream)
        patient["loop"]["missed_deadlines_allowed"] = 1_000_000  # a busy machine is no fault of the loop's
        path = os.path.join(self.folder.name, "patient.json")
        with open(path, "w") as stream:
            json.dump(patient, stream)
        process = subprocess.Popen(command("run", network("paper/kelvin"), "--device", path, "--log", self.log),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        first = process.stdout.readline()  # the loop is running from here on
        self.assertIn("Hz", first)
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0, output + errors)
        self.assertIn("device left safe", output)

    def test_nobody_reads_along(self):
        """Fails if the end of whoever reads what `run` prints ends the program before the device has the safe
        command."""
        process = subprocess.Popen(command("run", network("paper/kelvin"), "--device", device("phantom_shorted_motor"),
                                           "--for", "3", "--fast", "--log", self.log),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        process.stdout.close()
        errors = process.stderr.read()
        process.stderr.close()
        self.assertEqual(process.wait(60), 1, errors)
        self.assertIn("cannot write 'standard output': Broken pipe [cannot-write-file]", errors)
        with open(self.log, newline="") as stream:
            self.assertEqual(len(list(csv.DictReader(stream))), 3000)

    def test_interrupt_leaves_no_folder(self):
        """Fails if Ctrl-C while the emitted code is compiled leaves the compiler at work, or its folder behind."""
        slow, temporary = os.path.join(self.folder.name, "slow"), os.path.join(self.folder.name, "temporary")
        with open(slow, "w") as script:
            script.write("#!/bin/sh\nexec sleep 300\n")
        os.chmod(slow, 0o755)
        os.mkdir(temporary)
        process = subprocess.Popen(command("run", network("paper/kelvin"), "--device", device("phantom_shorted_motor"),
                                           "--for", "1", "--fast", "--log", self.log),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   start_new_session=True, env={**os.environ, "CXX": slow, "TMPDIR": temporary})
        while not glob.glob(os.path.join(temporary, "*", "compiler.log")):  # there as soon as the compiler is
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        os.killpg(process.pid, signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, -signal.SIGINT)
        self.assertEqual(os.listdir(temporary), [])

    def test_duration_beyond_counting_is_refused(self):
        """Fails if a run without end is asked for and ends at once, without a period and without a word."""
        for duration in ("1e17", "1e300"):
            result = dashpot("run", network("paper/kelvin"), "--device", device("phantom_shorted_motor"), "--for",
                             duration, "--fast", "--log", self.log)
            self.assertEqual(result.returncode, 2, result.stdout)
            self.assertIn(f"'{duration}' is longer than 30 years; without --for it runs until Ctrl-C", result.stderr)
            self.assertFalse(os.path.exists(self.log))

    def test_log_at_the_largest_file_leaves_the_board_safe(self):
        """Fails if a limit on the size of files ends the process in the middle of a run, with the motor on."""
        peer, port = self.start_peer()
        process = self.start_on(port, "--log", self.log)
        self.assertIn("Hz", process.stdout.readline())
        _, hard = resource.prlimit(process.pid, resource.RLIMIT_FSIZE)
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (1000, hard))
        self.assertIn("Hz", process.stdout.readline())  # a second later it still runs
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 1, output + errors)
        self.assertIn(f"cannot write '{self.log}': File too large", errors)
        self.assertIn("device left safe", output)
        self.assertEqual(peer.stdout.readline(), "left with torque 0, damping 5\n")

    def test_two_interrupts_end_a_run_whose_log_nobody_reads(self):
        """Fails if an unread pipe keeps the program from ending, or the second Ctrl-C comes before the device is
        safe."""
        peer, port = self.start_peer()
        unread, log = os.pipe()
        self.addCleanup(os.close, unread)
        process = self.start_on(port, "--log", f"/dev/fd/{log}", pass_fds=(log,))
        while select.select([], [log], [], 0)[1]:  # until the pipe is full
            self.assertIsNone(process.poll())
            time.sleep(0.05)
        os.close(log)
        time.sleep(2)  # a full pipe still takes some rows; meanwhile there are more than that
        process.send_signal(signal.SIGINT)
        time.sleep(1.5)
        self.assertIsNone(process.poll(), "it waits for its log")
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, -signal.SIGINT)
        self.assertEqual(peer.stdout.readline(), "left with torque 0, damping 5\n")

    def start_on(self, port, *more, **how):
        return subprocess.Popen(command("run", network("paper/kelvin"), "--device", device("board_mps2"),
                                        "--port", port, *more),
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **how)

    def test_compiler_that_fails_is_told_and_nothing_is_written(self):
        """Fails if a missing or failing system compiler is silent, or leaves a log behind."""
        for compiler in ("false", "/no/such/compiler"):
            result = dashpot("run", network("paper/kelvin"), "--device", device("phantom_shorted_motor"), "--for", "1",
                             "--fast", "--log", self.log, environment={"CXX": compiler})
            self.assertEqual(result.returncode, 1)
            self.assertIn("[system-compiler-failed]", result.stderr)
            self.assertIn("CXX names another than c++", result.stderr)
            self.assertFalse(os.path.exists(self.log))

    def test_temporary_folder_that_cannot_be_used(self):
        """Fails if a TMPDIR that is missing, no folder or not writable counts as a defect, or files go elsewhere than
        there."""
        file = os.path.join(self.folder.name, "file")
        open(file, "w").close()
        for chosen, reason in (("/no/such/folder", "No such file or directory"), (file, "Not a directory"),
                               ("/proc", "No such file or directory")):
            work = os.path.join(self.folder.name, "work")
            os.makedirs(work, exist_ok=True)
            result = dashpot("run", network("paper/kelvin"), "--device", device("phantom_shorted_motor"), "--for", "1",
                             "--fast",
                             "--log", self.log, environment={"TMPDIR": chosen}, folder=work)
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertIn(
                f"error: cannot make a folder in '{chosen}': {reason} [cannot-make-folder]\nnote: TMPDIR names",
                result.stderr)
            page = os.path.join(self.folder.name, "page.html")
            result = dashpot("report", network("paper/kelvin"), "-o", page, environment={"TMPDIR": chosen}, folder=work)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(f"no live response: no folder can be made in '{chosen}': {reason} [no-live-response]\nnote: "
                          f"TMPDIR names", result.stderr)
            self.assertTrue(os.path.exists(page))
            self.assertEqual(os.listdir(work), [])

    def test_log_in_a_new_folder(self):
        """Fails if `run` asks for a folder that other commands make, or says of no folder why there is no log."""
        log = os.path.join(self.folder.name, "of_today", "first", "log.csv")
        self.assertEqual(self.run_fast("paper/kelvin", "phantom_shorted_motor", log=log).returncode, 0)
        self.assertTrue(os.path.exists(log))
        result = self.run_fast("paper/kelvin", "phantom_shorted_motor", log=os.path.join(log, "log.csv"))
        self.assertEqual(result.returncode, 1)
        self.assertIn("log.csv/log.csv': Not a directory [cannot-write-file]", result.stderr)

    def test_log_that_cannot_be_written(self):
        """Fails if a log that a full disk cuts off is reported to people only, or named as if it were whole."""
        result = self.run_fast("paper/kelvin", "phantom_shorted_motor", "--diagnostics", "json", log="/dev/full")
        self.assertEqual(result.returncode, 1)
        errors = [told for told in json.loads(result.stderr[result.stderr.index("["):]) if told["severity"] == "error"]
        self.assertEqual([(told["code"], told["message"]) for told in errors],
                         [("cannot-write-file", "cannot write '/dev/full': No space left on device")])
        self.assertNotIn("log: ", result.stdout)
        self.assertIn("device left safe", result.stdout)

    def run_within(self, low, high, *more, network_name="paper/kelvin"):
        """The positions [m] of a run on a device with that encoder range [mm]."""
        with open(device("phantom_shorted_motor")) as stream:
            described = json.load(stream)
        described["encoder"]["range"] = [f"{low} mm", f"{high} mm"]
        path = os.path.join(self.folder.name, "device.json")
        with open(path, "w") as stream:
            json.dump(described, stream)
        result = dashpot("run", network(network_name), "--device", path, "--for", "5", "--fast", "--log", self.log,
                         *more)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        with open(self.log, newline="") as stream:
            return [float(row["position [m]"]) for row in csv.DictReader(stream)]

    def test_hand_stays_within_the_encoder(self):
        """Fails if a range that lies to one side of 0 leaves the hand unmoved, throws the tool out of it, or starts
        with loaded springs without need."""
        for low, high, hands in ((0, 50, ("relaxed", "firm", "stiff")), (-50, 0, ("relaxed", "firm", "stiff")),
                                 (-2, 50, ("relaxed", "stiff"))):
            for hand in hands:
                with self.subTest(low=low, high=high, hand=hand):
                    positions = self.run_within(low, high, "--hand", hand)
                    self.assertLess(abs(positions[0]), 1e-9)
                    later = positions[len(positions) // 2:]
                    self.assertGreater(max(later) - min(later), 2e-3)
        positions = self.run_within(10, 50, "--hand", "stiff", network_name="paper/maxwell_damper_at_tool")
        self.assertAlmostEqual(positions[0], 0.030, delta=1e-4)
        self.assertGreater(max(positions) - min(positions), 2e-3)

    def test_hand_swings_about_rest_where_it_can(self):
        """Fails if ranges that hold 0 well inside move the swing away from where the network is at rest."""
        for low, high in ((-120, 120), (-20, 50), (-3, 3)):
            positions = self.run_within(low, high, "--hand", "stiff")
            self.assertLess(min(positions), -1e-4)
            self.assertLess(abs(max(positions) + min(positions)), 0.2 * (max(positions) - min(positions)))

    def test_float_model_runs(self):
        """Fails if a model in single precision cannot be loaded."""
        result = self.run_fast("paper/second_order_maxwell", "board_mps2", "--scalar", "float")
        self.assertEqual(result.returncode, 0, result.stderr + result.stdout)

    def test_device_is_required(self):
        """Fails if `run` starts without knowing on what."""
        self.assertEqual(dashpot("run", network("paper/kelvin")).returncode, 2)

    def start_peer(self, *more):
        """A board that knows nothing but the protocol's page, and its port."""
        socket_path = os.path.join(self.folder.name, "board.sock")
        peer = subprocess.Popen([sys.executable, os.path.join(ARGUMENTS.root, "tests/realtime/board/peer.py"), "--unix",
                                 socket_path, *more], stdout=subprocess.PIPE, text=True)
        self.addCleanup(peer.stdout.close)
        self.addCleanup(peer.wait)
        self.addCleanup(peer.kill)
        for _ in range(200):
            if os.path.exists(socket_path):
                break
            time.sleep(0.05)
        return peer, "unix:" + socket_path

    def test_board_on_a_socket(self):
        """Fails if `run --port` does not serve a board that knows nothing but the protocol's page."""
        _, port = self.start_peer()
        result = dashpot("run", network("paper/kelvin"), "--device", device("board_mps2"), "--for", "2", "--port", port,
                         "--log", self.log)
        self.assertIn("device left safe", result.stdout, result.stderr)
        with open(self.log, newline="") as stream:
            moved = {row["position [m]"] for row in csv.DictReader(stream)}
        self.assertGreater(len(moved), 10)

    def test_interrupt_leaves_the_board_safe(self):
        """Fails if after Ctrl-C the board itself does not have the safe command, whatever `run` says."""
        peer, port = self.start_peer()
        process = subprocess.Popen(command("run", network("paper/kelvin"), "--device", device("board_mps2"),
                                    "--port", port, "--log", self.log),
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for _ in range(2):  # the second line comes after a second of running
            self.assertIn("Hz", process.stdout.readline())
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=60)
        self.assertIn("device left safe", output, errors)
        self.assertEqual(peer.stdout.readline(), "left with torque 0, damping 5\n")
        with open(self.log, newline="") as stream:
            self.assertTrue(any(float(row["motor_torque [N]"]) != 0 for row in csv.DictReader(stream)))

    def test_arm_on_a_socket(self):
        """Fails if `run --port` does not serve a board of two axes, joint by joint, or does not leave all of it
        safe."""
        peer, port = self.start_peer("--arm")
        result = dashpot("run", network("axes/kelvin_field"), "--device", device("arm_board_mps2"), "--for", "1",
                         "--port", port,
                         "--log", self.log)
        self.assertIn("device left safe", result.stdout, result.stderr)
        self.assertEqual(peer.stdout.readline(), "left with torque 0, 0, damping 0.004, 0.005, 0, 0\n")
        with open(self.log, newline="") as stream:
            rows = [row for row in csv.DictReader(stream) if row["state"] == "running"]
        for joint, first in ((1, 24384), (2, 8384)):
            counts = {round(float(row[f"q{joint} [rad]"]) * 65536 / (2 * math.pi)) - first for row in rows[10:]}
            self.assertGreater(len(counts), 10)
            self.assertTrue(all(0 <= moved <= 500 for moved in counts), counts)
            self.assertTrue(any(float(row[f"motor_torque_{joint} [N m]"]) != 0 for row in rows))
            for row in rows[10:]:
                self.assertAlmostEqual(float(row[f"motor_torque_{joint} [N m]"]), -float(row[f"torque_{joint} [N m]"]),
                                       delta=1e-9)
                self.assertGreater(float(row[f"damping_{joint} [N m s/rad]"]), 0)

    def test_board_of_other_axes(self):
        """Fails if a board that has not as many axes as the device is driven, or the user is left to guess why not."""
        peer, port = self.start_peer("--arm")
        result = dashpot("run", network("paper/kelvin"), "--device", device("board_mps2"), "--for", "1", "--port", port,
                         "--log", self.log)
        self.assertEqual(result.returncode, 1)
        self.assertIn(f"'{port}': the board has two axes, the device file one [cannot-start-device]", result.stderr)
        self.assertIn("left with torque 0", peer.stdout.readline())
        self.assertFalse(os.path.exists(self.log))

    def test_nobody_at_the_port(self):
        """Fails if a port without a board hangs or passes for one."""
        result = dashpot("run", network("paper/kelvin"), "--device", device("board_mps2"), "--for", "1", "--port",
                         "unix:" + os.path.join(self.folder.name, "nobody.sock"), "--log", self.log)
        self.assertEqual(result.returncode, 1)
        self.assertIn("[cannot-start-device]", result.stderr)
        self.assertFalse(os.path.exists(self.log))


class Blade(unittest.TestCase):
    WORDS = ("--blade", "1.59 mm", "--pole-length", "20 mm", "--pole-width", "20 mm", "--field", "1 T")

    def fill(self, *more):
        return dashpot("device", device("pantograph_brake_2009"), *self.WORDS, *more)

    def test_damping_of_a_square_pole(self):
        """Fails if (3) or the return path's half for a square pole is computed wrongly."""
        filled = json.loads(self.fill("--current", "2 A").stdout)
        with open(device("pantograph_brake_2009")) as stream:
            before = json.load(stream)
        damping = 0.5 * 1.59e-3 * 0.02 * 0.02 * 1.0**2 / 28.2e-9 * 0.05**2  # α d l w B²/ρ r²
        number, unit = filled["brake"]["max_damping"].split(" ", 1)
        self.assertEqual(unit, "N m s/rad")
        self.assertTrue(math.isclose(float(number), damping, rel_tol=1e-5))
        number, unit = filled["brake"]["damping_per_current_squared"].split(" ", 1)
        self.assertTrue(math.isclose(float(number), damping / 4, rel_tol=1e-5))
        for key in ("max_damping", "damping_per_current_squared"):
            before["brake"][key] = filled["brake"][key]
        self.assertTrue(filled["source"].startswith(before.pop("source") +
                                                    "; brake.max_damping by 'dashpot device' from a blade of 1.59 mm"))
        del filled["source"]
        before["assumed"].append("brake.max_damping")
        self.assertEqual(filled, before)

    def test_what_was_said_of_the_brake_before(self):
        """Fails if a constant of another brake, by which the new one would take another current, is left beside its
        damping."""
        filled = json.loads(self.fill().stdout)
        self.assertNotIn("damping_per_current_squared", filled["brake"])
        self.assertNotIn("brake.damping_per_current_squared", filled["assumed"])
        self.assertIn("is left out", filled["source"])

    def test_a_formula_is_no_measurement(self):
        """Fails if what the formula says of a brake stands as if it had been measured, or is listed twice."""
        path = os.path.join(tempfile.mkdtemp(), "measured.json")
        with open(device("pantograph_brake_2009")) as stream:
            measured = json.load(stream)
        del measured["assumed"]
        for assumed in (None, ["brake.max_damping"]):
            with open(path, "w") as stream:
                json.dump(measured if assumed is None else {**measured, "assumed": assumed}, stream)
            result = dashpot("device", path, *self.WORDS, "--current", "2 A")
            self.assertEqual(json.loads(result.stdout)["assumed"],
                             ["brake.max_damping", "brake.damping_per_current_squared"])

    def test_correction_and_radius_can_be_given(self):
        """Fails if what the user states is overruled."""
        filled = json.loads(self.fill("--correction", "1", "--radius", "100 mm", "--resistivity", "1e-7 ohm m").stdout)
        damping = 1.59e-3 * 0.02 * 0.02 / 1e-7 * 0.1**2
        self.assertTrue(math.isclose(float(filled["brake"]["max_damping"].split()[0]), damping, rel_tol=1e-5))

    def test_numbers_that_make_no_brake(self):
        """Fails if a file is written whose brake is infinite or none, which no command then reads."""
        for words in (("--field", "1e200 T"), ("--field", "1e-200 T"), ("--field", "1 T", "--radius", "1e-200 m"),
                      ("--field", "1 T", "--current", "1e-200 A"), ("--field", "1 T", "--current", "1e200 A")):
            result = dashpot("device", device("pantograph_brake_2009"), *self.WORDS[:-2], *words)
            self.assertEqual(result.returncode, 1, words)
            self.assertIn("[blade-beyond-numbers]", result.stderr)
            self.assertEqual(result.stdout, "")

    def test_wrong_unit_is_refused(self):
        """Fails if a quantity of another kind is taken for a thickness."""
        result = dashpot("device", device("pantograph_brake_2009"), "--blade", "1.59 N", *self.WORDS[2:])
        self.assertEqual(result.returncode, 1)
        self.assertIn("[wrong-unit]", result.stderr)
        self.assertEqual(result.stdout, "")

    def test_file_that_is_written_names_the_device(self):
        """Fails if two devices have one name, so that a header compiled for one claims the other."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "my_rig.json")
            self.assertEqual(self.fill("-o", path).returncode, 0)
            with open(path) as stream:
                self.assertEqual(json.load(stream)["name"], "my_rig")
        self.assertEqual(json.loads(self.fill().stdout)["name"], "pantograph_brake_2009")

    def test_blade_that_the_rest_does_not_fit_is_refused(self):
        """Fails if a device file is written that no other command takes."""
        with open(device("pantograph_brake_2009")) as stream:
            told = json.load(stream)
        told["brake"] |= {"max_damping": "1 N m s/rad", "safe_damping": "0.5 N m s/rad"}
        with tempfile.TemporaryDirectory() as folder:
            path, output = os.path.join(folder, "strong.json"), os.path.join(folder, "filled.json")
            with open(path, "w") as stream:
                json.dump(told, stream)
            result = dashpot("device", path, *self.WORDS, "-o", output)
            self.assertEqual(result.returncode, 1)
            self.assertIn("strong.json with this blade", result.stderr)
            self.assertIn("[damping-above-brake]", result.stderr)
            self.assertFalse(os.path.exists(output))

    def test_device_without_brake_is_refused(self):
        """Fails if a brake is invented."""
        result = dashpot("device", device("phantom_single_motor"), *self.WORDS)
        self.assertEqual(result.returncode, 1)
        self.assertIn("[brake-missing]", result.stderr)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--dashpot", required=True)
    parser.add_argument("--root", required=True)
    ARGUMENTS, rest = parser.parse_known_args()
    unittest.main(argv=[sys.argv[0], *rest])
