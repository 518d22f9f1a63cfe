"""Exit status, help and diagnostics of every command: 0 done, 1 input refused, 2 command line wrong, 3 a defect."""
import json
import re
import subprocess
import unittest

from dashpot_command import (BROKEN, COMMAND_LINE_WRONG, DASHPOT, FIG_5, INPUT_REFUSED, KELVIN, PANTOGRAPH, SOURCE,
                             CommandTest, codes,
                             network)

LINEAR_DEVICE = """{ "dashpot_device": 1, "name": "slide", "source": "none", "motion": "translation",
  "loop": { "rate": "1 kHz", "jitter": "50 us", "delay_samples": 0, "band": ["0.1 Hz", "30 Hz"], "missed_deadlines_allowed": 3 },
  "encoder": { "resolution": "10 um", "quantiser": "floor", "range": ["-0.1 m", "0.1 m"], "max_speed": "3 m/s" },
  "velocity": { "estimator": "butterworth", "order": 4, "cutoff": "120 Hz" },
  "motor": { "max_torque": "10 N" },
  "mechanics": { "inertia": "0.1 kg", "damping": "0.1 N s/m", "coulomb_friction": "0.1 N" } }
"""
COMMANDS = ["check", "explain", "compile", "simulate", "report"]


class Help(CommandTest):
    def test_every_command_explains_itself(self):
        """Fails if --help of a command is missing, fails, or leaves out the choices that all commands share."""
        for command in COMMANDS:
            done = self.dashpot(command, "--help")
            self.assertEqual(done.stderr, "")
            for option in ["FILE" if command == "check" else "NETWORK", "--device", "--rate", "--scheme",
                           "--state-input", "--decomposition", "--scalar",
                           "--tolerance", "--diagnostics", "faithful", "paper", "backward-euler", "nodal", "float"]:
                self.assertIn(option, done.stdout, command)

    def test_the_whole_lists_its_commands(self):
        """Fails if a command cannot be found out from the program itself."""
        done = self.dashpot("--help")
        for command in COMMANDS:
            self.assertRegex(done.stdout, rf"(?m)^  {command} ")

    def test_compile_names_its_own_options(self):
        """Fails if an option of the compile command is not described."""
        text = self.dashpot("compile", "--help").stdout
        for option in ["-o,--output", "--target", "--with-test", "--print", "--depfile", "--templates"]:
            self.assertIn(option, text)

    def test_help_is_a_command_too(self):
        """Fails if what other programs answer to `help` is refused here."""
        self.assertEqual(self.dashpot("help", "compile").stdout, self.dashpot("compile", "--help").stdout)
        self.assertEqual(self.dashpot("help").stdout, self.dashpot("--help").stdout)

    def test_rates_have_units(self):
        """Fails if a rate with its unit is refused, or read as another one."""
        plain = self.dashpot("explain", FIG_5, "--rate", "2000").stdout
        for rate in ["2kHz", "2 kHz", "2000Hz", "0.002 MHz"]:
            self.assertEqual(self.dashpot("explain", FIG_5, "--rate", rate).stdout, plain)

    def test_version(self):
        """Fails if the program does not say what it is, and which formats and targets it knows."""
        self.assertRegex(self.dashpot("--version").stdout,
                         r"^dashpot \d+\.\d+\.\d+\nreads:   network 1, device 1, [^\n]*"
                         r"abaqus[^\n]*\nwrites:  network 1, [^\n]*\ntargets: cpp, c99[^\n]*\n$")


class Check(CommandTest):
    def test_takes_devices_and_motions_too(self):
        """Fails if a device file or a motion cannot be checked on its own, or is said to be fine where it is not."""
        self.write("motion.csv", "time,position\n0,0\n0.001,0.1\n0.002,0.2\n")
        self.write("late.csv", "time,position\n0,0\n0.001,0.1\n0.0005,0.2\n")
        self.write("broken_device.json", '{ "dashpot_device": 1, "name": "none" }')
        self.assertEqual(self.dashpot("check", FIG_5, PANTOGRAPH, "motion.csv").stderr, "")
        self.refused("check", FIG_5, "late.csv", code="csv-time-not-rising")
        rows = "0,0\n0.001,0.1\n0.002,0.2\n"
        for header in ["t [s],x [mm]", "t,x_mm", "time [s],displacement [mm]", "# Zeit,Weg"]:
            self.assertEqual(self.dashpot("check", self.write("motion.csv", header + "\n" + rows)).stderr, "", header)
        for title in ["F", "Load cell (kgf)", "M [N m]"]:
            table = self.write("forces.csv", f"t,x_mm,{title}\n0,0,0\n0.001,0.1,1\n0.002,0.2,2\n")
            self.assertIn("[recording-", self.dashpot("check", table, status=INPUT_REFUSED).stderr, title)
        self.refused("check", "broken_device.json", code="missing-key")


    def test_a_surface_beyond_reach(self):
        """Fails if a surface that the tool can never touch is compiled without a warning, or one within reach is warned
        of."""
        self.write("slide.json", LINEAR_DEVICE)
        for at, warned in [("150 mm", True), ("90 mm", False)]:
            self.write("tissue.json",
                       '{ "dashpot": 1, "name": "tissue", "contact": { "at": "%s" }, '
                       '"network": { "spring": "5 N/m" } }' % at)
            said = self.dashpot("check", "tissue.json", "--device", "slide.json").stderr
            self.assertEqual("[surface-out-of-reach]" in said, warned, said)
        self.assertNotIn("[surface-out-of-reach]", self.dashpot("check", "tissue.json").stderr)

    def test_a_rest_beyond_reach(self):
        """Fails if a network whose rest the tool never comes to is compiled without a warning, or one behind a surface
        within reach is warned of."""
        self.write("slide.json", LINEAR_DEVICE.replace('"-0.1 m"', '"10 mm"'))
        for contact, warned in [("", True), ('"contact": { "at": "50 mm" },', False)]:
            self.write("tissue.json", network('{ "spring": "5 N/m" }', more=contact))
            said = self.dashpot("check", "tissue.json", "--device", "slide.json").stderr
            self.assertEqual("[rest-out-of-reach]" in said, warned, said)


class WrongCommandLine(CommandTest):
    def wrong(self, *arguments, mentions=""):
        done = self.dashpot(*arguments, status=COMMAND_LINE_WRONG)
        self.assertEqual(done.stdout, "")
        self.assertIn(mentions, done.stderr)

    def test_of_the_command(self):
        """Fails if a missing or unknown command or option counts as refused input, or passes."""
        self.wrong()
        self.wrong("complie", FIG_5, mentions="'compile' is the nearest")
        self.wrong("export", FIG_5, "--to", "0", mentions="'0' is not one of abaqus")
        self.wrong("fit", "none.csv", "--modes", "-1", mentions="--modes")
        self.wrong("draw", FIG_5, mentions="commands are check, compile")
        self.wrong("help", "complie", mentions="'compile' is the nearest")
        self.wrong("explain", FIG_5, "--rate", "1 kilo", mentions="as 1000 or 1kHz")
        self.wrong("compile")
        self.wrong("compile", FIG_5, "--fast-math", mentions="--fast-math")
        self.wrong("check", FIG_5, "--rat", "5", mentions="'check' has no option '--rat'; '--rate' is the nearest")
        self.wrong("explain", FIG_5, "--devic=arm.json", mentions="'--device' is the nearest")
        self.wrong("run", FIG_5, "--device", PANTOGRAPH, "--duration", "3", mentions="'run' has no option '--duration'")
        self.wrong("explain", FIG_5, "-o", "solid.txt", mentions="'explain' has no option '-o'")
        self.wrong("check", FIG_5, "-rate", "5", mentions="'check' has no option '-rate'; '--rate' is the nearest")
        for flag in ("--no-advice=true", "--no-advice="):
            self.wrong("check", FIG_5, flag, mentions="'--no-advice' takes no value")
        self.wrong("--rate", "1000", "check", FIG_5,
                   mentions="'--rate' stands where a command should; options come after the command")
        self.wrong("check", FIG_5, "--decomposition", "papr", mentions="'paper' is the nearest")
        self.wrong("explain", FIG_5, FIG_5)
        self.wrong("simulate", FIG_5, mentions="--input")
        self.wrong("report", FIG_5, mentions="--output")

    def test_of_a_choice(self):
        """Fails if a value that no network can make sense of is accepted or rounded to one that it can."""
        for rate in ["0", "-1000", "fast", "nan", "inf", "1e10", "1e-7", "", "1000 rpm", "0x10"]:
            self.wrong("check", FIG_5, "--rate", rate)
        for damping in ["most", "-1", "nan", "inf", "1e999", "5 N s/m", "", "0x1p3"]:
            self.wrong("check", FIG_5, "--decomposition", damping)
        self.wrong("check", FIG_5, "--scheme", "euler", mentions="backward-euler")
        for duration in ["nan", "inf", "0", "-1", "soon"]:
            self.wrong("run", FIG_5, "--device", PANTOGRAPH, "--for", duration, mentions="seconds")
        for seed in ["-1", "18446744073709551616", "1.5", "1e3", "+1", "0x10", "luck", ""]:
            self.wrong("run", FIG_5, "--device", PANTOGRAPH, "--seed", seed,
                       mentions=f"'{seed}' is no seed; a whole number from 0 to 18446744073709551615 is expected")
        self.wrong("check", FIG_5, "--state-input", "force", mentions="force")
        self.wrong("check", FIG_5, "--scalar", "half", mentions="half")
        self.wrong("check", FIG_5, "--diagnostics", "xml", mentions="xml")
        self.wrong("compile", FIG_5, "--target", "cobol",
                   mentions="there is no target 'cobol'; targets are cpp, c99, hal, fmi2, fmi3")
        self.wrong("compile", FIG_5, "--target", "c98", mentions="'c99' is the nearest")
        self.wrong("compile", FIG_5, "--print", "everything", mentions="everything")
        for option in ["--certificate", "--proof"]:  # which would be written, and --print writes nothing
            self.wrong("compile", FIG_5, "--print", "law", option, "told", mentions=option)

    def test_of_files_that_would_be_overwritten(self):
        """Fails if a network, a device or a motion can be lost to the output of the same command."""
        self.write("n.json", KELVIN)
        self.write("m.csv", "time,position\n0,0\n0.001,0\n")
        self.write("kelvin.hpp", KELVIN)
        for arguments in [("compile", "n.json", "--depfile", "./n.json"),
                          ("compile", "n.json", "--certificate", "./n.json"),
                          ("compile", "kelvin.hpp"), ("simulate", "n.json", "--input", "m.csv", "-o", "m.csv"),
                          ("run", "n.json", "--device", PANTOGRAPH, "--log", "n.json", "--for", "0.1")]:
            self.refused(*arguments, code="would-overwrite-input", status=COMMAND_LINE_WRONG)
        for input in ["n.json", "kelvin.hpp"]:
            self.assertEqual((self.folder / input).read_text(), KELVIN)
        (self.folder / "here").symlink_to(".")
        for second in ["--certificate", "--depfile"]:
            for place in ["out/./kelvin.hpp", "here/out/kelvin.hpp"]:
                self.refused("compile", "n.json", "-o", "out", second, place, code="same-output")
        self.assertFalse((self.folder / "out").exists())

    def test_of_choices_that_exclude_each_other(self):
        """Fails if nodal states are taken with the exact scheme, or refused without the remedy."""
        for command in ["check", "explain", "compile"]:
            done = self.refused(command, FIG_5, "--state-input", "nodal", code="nodal-needs-backward-euler",
                                status=COMMAND_LINE_WRONG)
            self.assertIn("--scheme backward-euler", done.stderr)
        self.dashpot("check", FIG_5, "--state-input", "nodal", "--scheme", "backward-euler")

    def test_of_simulated_time_without_an_end(self):
        """Fails if a run that no clock holds back is begun without an end: its log fills the disk."""
        done = self.refused("run", FIG_5, "--device", PANTOGRAPH, "--fast", code="fast-without-end",
                            status=COMMAND_LINE_WRONG)
        self.assertIn("--for SECONDS", done.stderr)
        self.assertEqual(self.files(), [])

    def test_of_a_board_that_is_to_be_simulated(self):
        """Fails if a choice that only the simulated device has is dropped without a warning where a board is driven."""
        for option in [["--fast"], ["--hand", "relaxed"], ["--seed", "0"]]:
            done = self.refused("run", FIG_5, "--device", PANTOGRAPH, "--port", "unix:absent.sock", "--for", "1",
                                *option,
                                code="simulated-device-only", status=COMMAND_LINE_WRONG)
            self.assertIn(f"error: {option[0]} cannot be combined with --port", done.stderr)
        self.assertEqual(self.files(), [])

    def test_of_a_port_without_a_name(self):
        """Fails if a run waits on a pseudo-terminal whose other end nobody can open, or the help offers one."""
        told = self.dashpot("run", FIG_5, "--device", PANTOGRAPH, "--port", "pty:", status=COMMAND_LINE_WRONG).stderr
        self.assertIn("[port-without-other-end]", told)
        self.assertNotIn("pty:", self.dashpot("run", "--help").stdout)

    def test_of_a_rate_that_the_device_has_not(self):
        """Fails if --rate overrules the loop that the device really runs."""
        self.refused("check", FIG_5, "--device", PANTOGRAPH, "--rate", "1000", code="device-rate-contradicts",
                     status=COMMAND_LINE_WRONG)
        self.dashpot("check", FIG_5, "--device", PANTOGRAPH, "--rate", "10000")


class RefusedInput(CommandTest):
    def test_files_that_cannot_be_read(self):
        """Fails if a missing file, a folder or a missing device is anything but input that is refused."""
        self.refused("check", "absent.json", code="cannot-read-file")
        self.refused("check", self.folder, code="cannot-read-file")
        self.refused("check", FIG_5, "--device", "absent.json", code="cannot-read-file")
        self.refused("simulate", FIG_5, "--input", "absent.csv", code="cannot-read-file")

    def test_files_of_the_other_kind(self):
        """Fails if network and device files can be swapped unnoticed."""
        self.refused("explain", PANTOGRAPH, code="device-instead-of-network")
        self.refused("check", FIG_5, "--device", FIG_5, code="network-instead-of-device")
        two_axes = self.refused("device", SOURCE / "runtime/devices/pantograph_2dof.json", "--target", "c99",
                                code="device-of-several-axes")
        self.assertIn("'report'", two_axes.stderr)
        self.dashpot("compile", FIG_5, "-o", ".", "--certificate", "proof.json")
        done = self.refused("check", "proof.json", code="certificate-instead-of-file")
        self.assertEqual(codes(done.stderr), ["certificate-instead-of-file"])

    def test_devices_that_do_not_fit(self):
        """Fails if a rotary network is given to a device that moves along a line."""
        self.write("rotary.json", network('{ "damper": 1 }', more='"motion": "rotation",'))
        self.write("linear.json", LINEAR_DEVICE)
        self.refused("check", "rotary.json", "--device", "linear.json", code="motion-mismatch")
        self.dashpot("explain", "rotary.json", "--device", PANTOGRAPH)
        self.dashpot("explain", FIG_5, "--device", "linear.json")

    def test_all_problems_of_all_networks(self):
        """Fails if check stops at the first bad file, or lets a good one hide a bad one."""
        self.write("broken.json", BROKEN)
        self.write("worse.json", network('{ "series": [] }'))
        done = self.refused("check", "broken.json", FIG_5, "worse.json", code="negative-stiffness")
        self.assertEqual(codes(done.stderr), ["negative-stiffness", "empty-group"])

    def test_warnings_are_no_refusal(self):
        """Fails if a network that only gives rise to a warning is refused, or the warning is swallowed."""
        self.write("fast.json", network('{ "series": [ { "spring": 1e6 }, { "damper": 1 } ] }'))
        self.assertEqual(codes(self.dashpot("check", "fast.json").stderr), ["fast-relaxation"])

    def test_fast_relaxations_are_counted(self):
        """Fails if relaxations that a loop is too slow for are reported otherwise than by the fastest, and how many
        they are."""
        for count in (1, 2, 3):
            branches = ", ".join(f'{{ "series": [ {{ "spring": 1e6 }}, {{ "damper": {10**i} }} ] }}'
                                 for i in range(count))
            self.write("fast.json", network(f'{{ "parallel": [ {branches} ] }}'))
            told = self.dashpot("check", "fast.json").stderr
            self.assertEqual(told.count("[fast-relaxation]"), 1)
            self.assertEqual(f"note: in all {count} relaxations are that short\n" in told, count > 1, told)
            self.assertEqual(told.count("that short"), int(count > 1))

    def test_silence_where_all_is_well(self):
        """Fails if check says anything about a good network."""
        self.write("kelvin.json", KELVIN)
        done = self.dashpot("check", "kelvin.json", FIG_5)
        self.assertEqual((done.stdout, done.stderr), ("", ""))


class Diagnostics(CommandTest):
    def test_text_is_what_editors_parse(self):
        """Fails if a diagnostic does not start with file, line and column, or does not show the place."""
        self.write("broken.json", BROKEN)
        lines = self.dashpot("check", "broken.json", status=INPUT_REFUSED).stderr.splitlines()
        self.assertRegex(lines[0], r"^broken\.json:1:\d+: error: .* \[negative-stiffness\]$")
        column = int(lines[0].split(":")[2])
        self.assertEqual(BROKEN[column - 1:column + 7], '"-1 N/m"')
        self.assertEqual(re.sub("[^~^]", "", lines[2]), "^" + "~" * 7)

    def test_every_message_names_its_network(self):
        """Fails if one cannot tell which of several networks a message is about."""
        self.write("kelvin.json", KELVIN)
        self.write("tuned.json", network('{ "spring": "K" }', "tuned",
                                         '"parameters": { "K": { "value": 1, "min": 0, "max": 2, "tunable": true } },'))
        single = SOURCE / "runtime/devices/phantom_single_motor.json"
        sliding = json.loads(PANTOGRAPH.read_text())
        sliding["velocity"] = {"estimator": "super_twisting", "acceleration": "50 rad/s^2"}
        self.write("sliding.json", json.dumps(sliding))
        for code, arguments in [("damping-capped", ["kelvin.json", "--device", single, "--decomposition", "paper"]),
                                ("injects-power", ["kelvin.json", "--decomposition", "9"]),
                                ("tunable-needs-position", ["tuned.json", "--state-input", "velocity"]),
                                ("velocity-input-drifts", ["kelvin.json", "--device", "sliding.json", "--state-input",
                                                           "velocity"]),
                                ("not-certified", ["kelvin.json", "--device", single])]:
            done = subprocess.run([DASHPOT, "compile", FIG_5, *arguments], cwd=self.folder, capture_output=True,
                                  text=True)
            self.assertRegex(done.stderr, rf"(?m)^{arguments[0]}:1:\d+: (error|warning): .* \[{code}\]$")

    def test_json_is_one_array(self):
        """Fails if --diagnostics=json mixes with text, misses a key or counts places from elsewhere than 1."""
        self.write("broken.json", BROKEN)
        for command in [["check"], ["explain"], ["compile"]]:
            done = self.dashpot(*command, "broken.json", "--diagnostics=json", status=INPUT_REFUSED)
            self.assertEqual(done.stdout, "")
            found, = json.loads(done.stderr)
            self.assertEqual({key: found[key] for key in ["file", "line", "severity", "code", "notes"]},
                             {"file": "broken.json", "line": 1, "severity": "error", "code": "negative-stiffness",
                              "notes": []})
            self.assertEqual(BROKEN[found["column"] - 1:found["end_column"] - 1], '"-1 N/m"')

    def test_json_has_the_severities_of_text(self):
        """Fails if a note that stands alone passes for a warning, or a warning for an error."""
        explain = ["explain", FIG_5, "--device", SOURCE / "runtime/devices/phantom_single_motor.json"]
        in_text = re.findall(r"(?m)^(?:\S+: )?(error|warning|note): .* \[(\S+)\]$", self.dashpot(*explain).stderr)
        in_json = json.loads(self.dashpot(*explain, "--diagnostics", "json").stderr)
        self.assertIn(("note", "compile-says-what-would-do"), in_text)
        self.assertIn("warning", [severity for severity, code in in_text])
        self.assertEqual([(told["severity"], told["code"]) for told in in_json], in_text)

    def test_json_without_a_place(self):
        """Fails if a diagnostic that belongs to no file claims one."""
        found, = json.loads(self.dashpot("check", "absent.json", "--diagnostics=json", status=INPUT_REFUSED).stderr)
        self.assertEqual([found[key] for key in ["file", "line", "column"]], [None, None, None])

    def test_json_where_there_is_nothing_to_say(self):
        """Fails if a tool that reads the array gets nothing instead of an empty one."""
        self.assertEqual(json.loads(self.dashpot("check", FIG_5, "--diagnostics=json").stderr), [])
        for wrong in [["chekc", FIG_5], ["check"], ["check", FIG_5, "--rate", "fast"], ["check", FIG_5, "--nonsense"]]:
            found, = json.loads(self.dashpot(*wrong, "--diagnostics", "json", status=COMMAND_LINE_WRONG).stderr)
            self.assertEqual((found["severity"], found["code"], found["line"]), ("error", "command-line", None))
            self.assertTrue(found["message"])


class DeviceAsCode(CommandTest):
    def test_a_file_or_standard_output(self):
        """Fails if a law and the description that is written of its device do not carry one digest."""
        self.dashpot("compile", FIG_5, "--device", PANTOGRAPH, "--uncertified", "--no-advice", "-o", ".")
        digest, = re.findall(r'device_digest = "([0-9a-f]+)"', (self.folder / "second_order_maxwell.hpp").read_text())
        for target, name in [("cpp", "device.hpp"), ("c99", "device.h")]:
            printed = self.dashpot("device", PANTOGRAPH, "--target", target).stdout
            self.dashpot("device", PANTOGRAPH, "--target", target, "-o", name)
            self.assertEqual((self.folder / name).read_text(), printed)
            self.assertIn(f'digest = "{digest}"', printed)

    def test_what_contradicts(self):
        """Fails if half of what a blade needs is taken, or a device both written and filled in."""
        blade = ["--blade", "1 mm", "--pole-length", "20 mm", "--pole-width", "20 mm", "--field", "1 T"]
        for words, said in [(blade[:-2], "requires --field"), (["--radius", "1 mm"], "--radius requires --blade"),
                            (["--target", "cpp", *blade], "excludes"), (["--target", "c89"], "c89 not in {cpp,c99}")]:
            done = self.dashpot("device", PANTOGRAPH, *words, "-o", "out.hpp", status=COMMAND_LINE_WRONG)
            self.assertIn(said, done.stderr)
            self.assertFalse((self.folder / "out.hpp").exists())

    def test_as_it_is(self):
        """Fails if what is printed of a device, of one axis or two, is no file of the same one, or a broken one is
        printed."""
        for device in (PANTOGRAPH, SOURCE / "runtime/devices/pantograph_2dof.json"):
            printed = self.dashpot("device", device).stdout
            self.assertEqual(json.loads(printed), json.loads(device.read_text()))
        self.write("broken.json", '{ "dashpot_device": 1, "name": "none" }')
        self.assertEqual(self.dashpot("device", "broken.json", status=INPUT_REFUSED).stdout, "")

    def test_its_own_file_is_spared(self):
        """Fails if a device file can be lost to the code that is written of it, or to a device with another brake, or
        half a file is left."""
        self.write("slide.json", LINEAR_DEVICE)
        blade = ["--blade", "1 mm", "--pole-length", "20 mm", "--pole-width", "20 mm", "--field", "1 T"]
        for words in (["--target", "cpp"], blade):
            done = self.dashpot("device", "slide.json", *words, "-o", "slide.json", status=COMMAND_LINE_WRONG)
            self.assertIn("[would-overwrite-input]", done.stderr)
            self.assertEqual((self.folder / "slide.json").read_text(), LINEAR_DEVICE)
        done = self.dashpot("device", "slide.json", "--target", "cpp", "-o", "slide.json/x.hpp", status=INPUT_REFUSED)
        self.assertIn("[cannot-write-file]", done.stderr)


class StandardOutput(CommandTest):
    def test_a_dash(self):
        """Fails if '-' is a file or a folder of that name where it can be standard output, or without a word."""
        self.write("motion.csv", "time,position\n0,0\n0.001,0\n")
        for command in [["device", PANTOGRAPH, "--target", "cpp"], ["export", FIG_5, "--to", "generic"],
                        ["simulate", FIG_5, "--input", "motion.csv"]]:
            self.assertEqual(self.dashpot(*command, "-o", "-").stdout, self.dashpot(*command).stdout)
        self.assertTrue(self.dashpot("report", FIG_5, "-o", "-").stdout.startswith("<!doctype html>"))
        for command in [["compile", FIG_5, "-o"], ["fit", "motion.csv", "-o"], ["fit", "motion.csv", "--report"],
                        ["run", FIG_5, "--device", PANTOGRAPH, "--for", "0.1", "--log"],
                        ["compile", FIG_5, "--depfile"], ["compile", FIG_5, "--certificate"],
                        ["compile", FIG_5, "--proof"]]:
            done = self.refused(*command, "-", code="output-is-dash", status=COMMAND_LINE_WRONG)
            self.assertIn("'./-'", done.stderr)
        self.assertEqual(self.files(), ["motion.csv"])
        self.dashpot("compile", FIG_5, "-o", "-", "--print", "law")

    def test_a_full_disk_is_reported(self):
        """Fails if results are lost without a word when standard output cannot take them."""
        self.write("motion.csv", "time,position\n0,0\n0.001,0\n")
        self.dashpot("compile", FIG_5, "--certificate", "c.json")
        blade = ["--blade", "1 mm", "--pole-length", "20 mm", "--pole-width", "20 mm", "--field", "1 T"]
        for command in [["explain", FIG_5], ["explain", FIG_5, "--json"], ["compile", FIG_5, "--print", "law"],
                        ["--version"], ["--help"],
                        ["compile", "--help"], ["simulate", FIG_5, "--input", "motion.csv"],
                        ["verify", "c.json", "second_order_maxwell.hpp"],
                        ["device", PANTOGRAPH, *blade], ["run", FIG_5, "--device", PANTOGRAPH, "--fast", "--for", "5"]]:
            with open("/dev/full", "w") as full:
                done = subprocess.run([DASHPOT, *map(str, command)], stdout=full, stderr=subprocess.PIPE, text=True,
                                      cwd=self.folder)
            self.assertEqual(done.returncode, INPUT_REFUSED, (command, done.stderr))
            self.assertIn("cannot write 'standard output': No space left on device [cannot-write-file]", done.stderr)


if __name__ == "__main__":
    unittest.main()
