"""`dashpot explain`: the text, and the JSON that other programs read."""
import json
import math
import os
import random
import re
import subprocess
import unittest

from dashpot_command import DASHPOT, FIG_5, KELVIN, MAXWELL, PANTOGRAPH, SOURCE, CommandTest, network

NAMES = ["paper", "zero-frequency", "quietest-passive", "velocity-free", "largest-observer", "virtual"]
NUMBER, TEXT = (int, float), str
SEED = 20090911


class Changes(CommandTest):
    """--name and --set: the network as if its file said so."""

    TUNED = """{ "dashpot": 1, "name": "tuned", "parameters": { "K": { "value": "100 N/m", "tunable": true, "min": 10, "max": 1000 }, "B": 5 },
        "network": { "parallel": [ { "spring": "K", "name": "K1" }, { "damper": "B", "name": "B1" }, { "spring": 7, "name": "K2" } ] } }"""

    def explained(self, *arguments):
        return json.loads(self.dashpot("explain", *arguments, "--json", "--no-advice").stdout)

    def test_set(self):
        """Fails if --set does not change the element or the parameter that it names, in its unit, the last of two for
        one."""
        self.write("tuned.json", self.TUNED)
        for words, stiffness in {"K=200": 207, "K2=0.2 kN/m": 300, "K1=3": 10}.items():
            self.assertEqual(self.explained("tuned.json", "--set", words)["static_stiffness"], stiffness)
        found = self.explained("tuned.json", "--set", "B=8", "--set", "K=20", "--set", "K=30")
        self.assertEqual((found["static_stiffness"], found["feedthrough_damping"]), (37, 8))

    def test_set_leaves_no_parameter_unused(self):
        """Fails if --set, which takes the place of what used a parameter, is answered by a warning about that
        parameter's place."""
        self.write("pad.json", network('{ "spring": "2 * E", "name": "fat" }', "pad",
                                       '"parameters": { "E": "30 N/m", "F": "2 N/m" },'))
        self.assertIn("'F' is not used", self.dashpot("explain", "pad.json", "--name", "other").stderr)
        self.assertNotIn("[unused-parameter]", self.dashpot("explain", "pad.json", "--set", "fat=200 N/m").stderr)

    def test_set_that_does_not_fit(self):
        """Fails if a name that nothing has, or a value that the file could not hold, is taken, or is refused without
        what would do."""
        self.write("tuned.json", self.TUNED)
        told = self.refused("explain", "tuned.json", "--set", "K3=1", code="set-unknown-name").stderr
        self.assertIn("'K' is the nearest name", told)
        self.write("unnamed.json", KELVIN)
        told = self.refused("explain", "unnamed.json", "--set", "spring_1=3", code="set-unknown-name").stderr
        self.assertIn('"name"', told)
        for words in ["K1", "=3", "K1="]:
            self.refused("explain", "tuned.json", "--set", words, code="set-malformed")
        told = self.refused("explain", "tuned.json", "--set", "K=2000", code="tunable-out-of-range").stderr
        self.assertIn("tuned.json: --set K=2000: error:", told)
        self.assertNotIn(" | ", told)  # no line of the file says so
        told = self.refused("explain", "tuned.json", "--name", "a b", code="name-form").stderr
        self.assertIn('tuned.json: --name "a b": error:', told)
        told = json.loads(self.dashpot("explain", "tuned.json", "--name", "a b", "--diagnostics", "json",
                                       status=1).stderr)
        self.assertEqual((told[0]["file"], told[0]["line"]), ("tuned.json", None))
        self.assertTrue(told[0]["message"].startswith('--name "a b": network name'), told)
        self.refused("explain", "tuned.json", "--set", "B=2 N/m", code="parameter-of-wrong-unit")
        self.refused("explain", "tuned.json", "--set", "K1=-2", code="negative-stiffness")

    def test_a_table_is_no_network(self):
        """Fails if a table is refused as malformed JSON, or standard input without the name that it is read by."""
        self.write("motion.csv", "time,position\n0,0\n0.001,0\n")
        told = self.refused("explain", "motion.csv", code="table-instead-of-network").stderr
        self.assertIn("'simulate --input'", told)
        self.assertIn("'/dev/stdin'", self.refused("explain", "-", code="cannot-read-file").stderr)

    def test_name(self):
        """Fails if --name is not that of the file and the class, if what is emitted so is not certified under it, or if
        two networks get one."""
        self.write("kelvin.json", KELVIN)
        self.dashpot("compile", "kelvin.json", "--name", "soft", "-o", "out", "--certificate", "out/soft.json")
        self.assertIn("class soft", (self.folder / "out/soft.hpp").read_text())
        self.dashpot("verify", "out/soft.json", "out/soft.hpp", "--allow-uncertified")
        self.refused("compile", "kelvin.json", "--name", "2 soft", code="name-form")
        self.refused("compile", "kelvin.json", FIG_5, "--name", "soft", code="name-of-several", status=2)


class BehindAContact(CommandTest):
    def explained(self, structure):
        self.write("behind.json", network(structure, "behind", '"contact": { "at": "1 mm" },'))
        return re.sub(r"\s+", " ", self.dashpot("explain", "behind.json").stdout)

    def test_why_the_brake_does_nothing(self):
        """Fails if b = 0 behind a contact goes unexplained, or is explained where the brake has something to do."""
        said = self.explained('{ "series": [ { "spring": 50 }, { "damper": 5 } ] }')
        self.assertIn("why b is 0 with a contact b is at most the feedthrough damping, and that is 0 here", said)
        self.assertIn("without 'contact' it could take up to 5 N s/m", said)
        said = self.explained('{ "parallel": [ { "spring": 50 }, { "damper": 5 } ] }')
        self.assertNotIn("why b is 0", said)
        said = re.sub(r"\s+", " ", self.dashpot("explain", "behind.json", "--decomposition", "virtual").stdout)
        self.assertIn("why b is 0 'virtual' leaves everything to the motor; another --decomposition gives the brake up "
                      "to 5 N s/m", said)


class Json(CommandTest):
    def explained(self, *arguments):
        return json.loads(self.dashpot("explain", *arguments, "--json", "--no-advice").stdout)

    def test_schema(self):
        """Fails if a key that other programs rely on is missing or of another type."""
        found = self.explained(FIG_5)
        for key, kind in {"static_stiffness": NUMBER, "feedthrough_damping": NUMBER, "zero_frequency_damping": NUMBER,
                          "modes": list, "candidates": list, "chosen": TEXT}.items():
            self.assertIsInstance(found[key], kind, key)
        for mode in found["modes"]:
            self.assertIsInstance(mode["stiffness"], NUMBER)
            self.assertIsInstance(mode["relaxation_rate"], NUMBER)
        for candidate in found["candidates"]:
            for key, kind in {"name": TEXT, "damping": NUMBER, "state_input": TEXT, "velocity_gain": NUMBER}.items():
                self.assertIsInstance(candidate[key], kind, key)
            for key in ["extra_damping_any_delay", "minimum_damping"]:
                self.assertIsInstance(candidate[key], (*NUMBER, type(None)), key)
            self.assertIn(candidate["certified"], [True, False, None])
            self.assertIn(candidate["state_input"], ["position", "velocity", "nodal"])

    def test_numbers_of_fig_5(self):
        """Fails if the canonical form of the paper's example is not that of its elements, in SI."""
        found = self.explained(FIG_5)
        self.assertEqual(found["static_stiffness"], 5)
        self.assertEqual(found["feedthrough_damping"], 0)
        self.assertEqual(found["zero_frequency_damping"], 11)
        self.assertEqual([mode["stiffness"] for mode in found["modes"]], [10, 12])
        self.assertEqual([mode["relaxation_rate"] for mode in found["modes"]], [10 / 6, 12 / 5])
        self.assertEqual([candidate["name"] for candidate in found["candidates"]], NAMES)
        self.assertEqual([candidate["damping"] for candidate in found["candidates"]], [11, 11, 5.5, 0, 11, 0])
        self.assertEqual(found["chosen"], "paper")

    def test_a_given_damping_is_the_choice(self):
        """Fails if a number on the command line is not among the candidates, or is not chosen."""
        found = self.explained(FIG_5, "--decomposition", "3.5")
        self.assertEqual(found["candidates"][-1]["damping"], 3.5)
        self.assertEqual(found["chosen"], found["candidates"][-1]["name"])

    def test_a_given_damping_has_its_digits(self):
        """Fails if what was given cannot be told from another of the candidates by its b."""
        rows = self.dashpot("explain", FIG_5, "--decomposition", "11.0000001").stdout.splitlines()
        given = [row.split() for row in rows if row.startswith("11.0000001 ")]
        self.assertEqual(given[0][:2], ["11.0000001", "11.0000001"])

    def test_very_many_modes(self):
        """Fails if the text of a network with very many modes waits for its Kelvin form, or one with few lacks it."""
        for count, listed in [(20, True), (501, False)]:
            branches = ", ".join(f'{{ "series": [ {{ "spring": 1 }}, {{ "damper": {2 + i / 7} }} ] }}'
                                 for i in range(count))
            self.write("many.json", network(f'{{ "parallel": [ {branches} ] }}'))
            said = self.dashpot("explain", "many.json").stdout
            self.assertEqual("Kelvin element" in said, listed)
            self.assertEqual(f"of {count} modes, left to --json" in said, not listed)

    def test_numbers_with_a_device(self):
        """Fails if figures for a device ignore its brake: 2.8 N s/m at 50 mm is all it has."""
        found = self.explained(FIG_5, "--device", PANTOGRAPH)
        self.assertEqual(found["device"], "pantograph_brake_2009")
        self.assertEqual(found["rate"], 10000)
        for candidate in found["candidates"]:
            self.assertLessEqual(candidate["damping"], 2.8 * (1 + 1e-12))

    def test_the_default_on_a_device_is_faithful(self):
        """Fails if the paper's rule is still the default on a device, where Fig. 5's network feels like another one, or
        if the choice is not within what it allows itself, moves over no assumed value, or is not explained in words."""
        found = self.explained(FIG_5, "--device", PANTOGRAPH)
        candidates = {candidate["name"]: candidate for candidate in found["candidates"]}
        faithful, paper, choice = candidates["faithful"], candidates["paper"], found["choice"]
        self.assertEqual(found["chosen"], "faithful")
        self.assertGreater(paper["largest_error"], 13)
        self.assertLess(faithful["damping"], 0.01)
        self.assertLessEqual(faithful["largest_error"], max(0.05, 1.05 * choice["least_error"]) * (1 + 1e-9))
        self.assertTrue(faithful["certified"])
        self.assertLess(choice["over_assumed"]["least_damping"], faithful["damping"])
        self.assertGreater(choice["over_assumed"]["most_damping"], faithful["damping"])
        for words in ["With the paper's rule",
                      "The brake has little to do: only 0 N s/m of the network's damping act at the tool",
                      "off by up to 20 %"]:
            self.assertIn(words, choice["in_words"])
        text = self.dashpot("explain", FIG_5, "--device", PANTOGRAPH).stdout
        self.assertIn(choice["in_words"], " ".join(text.split()))

    def test_no_line_is_too_wide(self):
        """Fails if a terminal of 100 columns breaks the lines, or a word is lost where explain itself breaks them."""
        networks = sorted((SOURCE / "networks").glob("*/*.json"))
        on_device = networks
        if os.environ.get("DASHPOT_LONG") != "1":  # else one of each shape, and some more
            shapes = ["paper/virtual_wall", "paper/visco_elasto_plastic", "tunable/standard_solid_tunable",
                      "static/sphere_on_gel",
                      "tissues/needle_in_liver"]
            others = [path for path in networks if not re.search("organ|slip_ten|layers", path.stem)]  # the slowest
            on_device = [SOURCE / f"networks/{shape}.json" for shape in shapes]
            on_device.append(random.Random(SEED).choice(others))
        for path in [FIG_5, *networks]:
            for device in [[], ["--device", PANTOGRAPH]] if path in [FIG_5, *on_device] else [[]]:
                done = subprocess.run([DASHPOT, "explain", path, *device, "--legend", "--no-advice"],
                                      capture_output=True, text=True)
                for line in done.stdout.splitlines():
                    self.assertTrue(len(line) <= 100 or " " not in line.strip(), f"{path}: {line}")

    def test_equal_candidates_are_listed_once(self):
        """Fails if rows that say the same of two names come back, or a name is lost."""
        text = self.dashpot("explain", FIG_5).stdout
        rows = re.findall(r"(?m)^([a-z-]+) +[0-9.e+-]+  (?:position|velocity|nodal) ", text)
        self.assertEqual(rows, ["paper", "quietest-passive", "velocity-free"])
        self.assertRegex(text,
                         r"the same +zero-frequency as paper, largest-observer as paper, virtual as velocity-free\n")
        for name in NAMES:
            self.assertRegex(text, rf"(?m)^  {name} ")

    def test_the_legend_explains_every_column(self):
        """Fails if a column of the table has no line in --legend."""
        text = self.dashpot("explain", FIG_5, "--device", PANTOGRAPH, "--legend").stdout
        for column in ["b", "states driven by", "velocity gain", "any-delay extra", "minimum damping", "noise",
                       "error"]:
            self.assertRegex(text, rf"(?m)^{column}  +[a-z]")

    def test_the_tolerance_is_kept(self):
        """Fails if --tolerance does not reach the choice: with more of it the brake may do more, up to what passivity
        then lacks."""
        dampings = []
        for tolerance in ["10%", "15 %", "0.2"]:
            found = self.explained(FIG_5, "--device", PANTOGRAPH, "--tolerance", tolerance)
            (faithful,) = (c for c in found["candidates"] if c["name"] == "faithful")
            self.assertAlmostEqual(faithful["largest_error"], found["choice"]["tolerance"], delta=1e-6)
            dampings.append(faithful["damping"])
        found = self.explained(FIG_5, "--device", PANTOGRAPH, "--tolerance", "0.4")
        (faithful,) = (c for c in found["candidates"] if c["name"] == "faithful")
        self.assertLess(faithful["largest_error"], 0.4)
        self.assertEqual(faithful["minimum_damping"], 0)
        self.assertAlmostEqual(found["certificate"]["needed_damping"], found["certificate"]["assured_damping"],
                               delta=0.005 * found["certificate"]["needed_damping"])
        self.assertEqual([*dampings, faithful["damping"]], sorted({*dampings, faithful["damping"]}))

    def test_the_old_name_of_the_papers_rule(self):
        """Fails if scripts that ask for the paper's rule by its old name stop working."""
        self.assertEqual(self.explained(FIG_5, "--device", PANTOGRAPH, "--decomposition", "most-dissipative"),
                         self.explained(FIG_5, "--device", PANTOGRAPH, "--decomposition", "paper"))

    def test_an_error_comes_with_a_remedy_that_holds(self):
        """Fails if a choice that is the tissue no more is not reported, or if what is suggested instead does not do
        it."""
        done = self.dashpot("explain", FIG_5, "--device", PANTOGRAPH, "--decomposition", "paper", "--state-input",
                            "velocity")
        self.assertIn("[felt-error]", done.stderr)
        options, error = re.search(r"with '(--.*)' it deviates by up to ([0-9.]+) %", done.stderr).groups()
        found = self.explained(FIG_5, "--device", PANTOGRAPH, "--state-input", "velocity", *options.split())
        (chosen,) = (c for c in found["candidates"] if c["name"] == found["chosen"])
        self.assertEqual(f"{100 * chosen['largest_error']:.3g}", error)

    def test_a_default_that_is_not_the_tissue_is_told(self):
        """Fails if the error of the default is not reported, or if a device with the suggested change errs by anything
        else."""
        said = self.dashpot("explain", FIG_5, "--device", PANTOGRAPH).stderr
        error = float(re.search(r"with 'faithful' the felt force deviates from the network's by up to (\S+) % in the "
                                "band", said).group(1))
        told = re.search(r"(\S+) % without the amplifier's lag", said).group(1)
        self.assertLess(float(told), 0.9 * error)
        device = json.loads(PANTOGRAPH.read_text())
        del device["assumed"], device["motor"]["amplifier_lag"]
        prompt = self.write("prompt.json", json.dumps(device))
        found = self.explained(FIG_5, "--device", prompt)
        (chosen,) = (c for c in found["candidates"] if c["name"] == found["chosen"])
        self.assertEqual(f"{100 * chosen['largest_error']:.3g}", told)
        self.assertNotIn("[felt-error]", self.dashpot("explain", FIG_5, "--device", prompt).stderr)

    def skin_on_paddle(self, **motor):
        """A network all behind one slip, and a paddle whose brake gives a thirtieth of its damping."""
        self.write("skin.json", network(
            '{ "series": [ { "parallel": [ { "spring": 400 }, { "damper": 1.2 } ] }, { "parallel": [ { "slip": 0.4, '
            '"name": "fascia" }, '
            '{ "spring": 60 } ] }, { "parallel": [ { "spring": 150 }, { "series": [ { "spring": 200 }, { "damper": 20 '
            '} ] } ] } ] }', "skin"))
        self.write("paddle.json", json.dumps({
            "dashpot_device": 1, "name": "paddle", "motion": "rotation", "arm_radius": "80 mm",
            "loop": {"rate": "2 kHz", "jitter": "50 us", "delay_samples": 1},
            "encoder": {"counts_per_turn": 12000, "range": ["-0.7 rad", "0.7 rad"], "max_speed": "30 rad/s"},
            "velocity": {"estimator": "backward_difference", "window": 10}, "motor": {"max_torque": "0.144 N m"} |
            motor,
            "brake": {"kind": "eddy_current", "max_damping": "4 mN m s/rad"}}))
        return 0.004 / 0.08**2

    SKIN_OVER_FASCIA = network("""{ "series": [
        { "parallel": [ { "spring": 900 }, { "damper": 3 } ] },
        { "parallel": [ { "spring": 300 }, { "series": [ { "spring": 250 }, { "damper": 20 } ] },
                        { "series": [ { "slip": 0.4, "name": "fascia" }, { "spring": 1500 } ] } ] } ] }""", "skin")
    STAGE = {"dashpot_device": 1, "name": "stage", "motion": "translation",
             "loop": {"rate": "20 kHz", "jitter": "10 us", "delay_samples": 1},
             "encoder": {"resolution": "2 um", "range": ["-20 mm", "20 mm"], "max_speed": "1 m/s"},
             "velocity": {"estimator": "backward_difference", "window": 10},
             "motor": {"max_torque": "8 N", "saturation_allowed": "0.2 s"},
             "brake": {"kind": "eddy_current", "max_damping": "6 N s/m", "coil_lag": "4 ms", "safe_damping": "6 N s/m"},
             "mechanics": {"inertia": "120 g", "damping": "0.8 N s/m"}}

    def felt_where_slips_give_way(self, *arguments):
        """The error that the warning names [%], and all that is said."""
        said = self.dashpot("explain", *arguments).stderr
        return float(re.search(r"where slips yield, the felt force deviates from the network's by up to (\S+) % in the "
                               "test motions", said).group(1)), said

    def test_where_slips_give_way_another_choice_is_named(self):
        """Fails if a law that was asked for errs without a warning, or if the choice that is said to err less does
        not."""
        self.write("skin.json", self.SKIN_OVER_FASCIA)
        self.write("stage.json", json.dumps(self.STAGE))
        arguments = ["skin.json", "--device", "stage.json"]
        error, said = self.felt_where_slips_give_way(*arguments, "--decomposition", "velocity-free")
        options, told = re.search(r"with '(--.*)' it deviates by up to (\S+) % in these motions", said).groups()
        self.assertLess(float(told), 0.9 * error)
        self.assertEqual(self.felt_where_slips_give_way(*arguments, *options.split())[0], float(told))

    def test_where_slips_give_way_another_rate_is_named(self):
        """Fails if a rate that is said to err less does not, on a slow device without other faults that cost more."""
        self.write("skin.json", self.SKIN_OVER_FASCIA)
        device = json.loads(PANTOGRAPH.read_text())
        del device["assumed"], device["motor"]["amplifier_lag"]
        device["loop"].update(rate="2 kHz", delay_samples=0)
        device["encoder"]["counts_per_turn"] = 2**24
        device["brake"].update(tolerance="0 %", residual_damping="0 N m s/rad", coil_lag="0 s")
        self.write("slow.json", json.dumps(device))
        error, said = self.felt_where_slips_give_way("skin.json", "--device", "slow.json")
        rate, told = re.search(r"at a rate of (\S+) Hz the felt error would be up to (\S+) %", said).groups()
        self.assertLess(float(told), 0.9 * error)
        device["loop"]["rate"] = f"{rate} Hz"
        self.write("faster.json", json.dumps(device))
        self.assertEqual(self.felt_where_slips_give_way("skin.json", "--device", "faster.json")[0], float(told))

    def test_where_slips_give_way_a_value_of_the_device_is_named(self):
        """Fails if a device with the suggested change does not err by what was predicted."""
        device = json.loads(PANTOGRAPH.read_text())
        network_file = SOURCE / "networks/paper/visco_elasto_plastic.json"
        error, said = self.felt_where_slips_give_way(network_file, "--device", PANTOGRAPH)
        told = float(re.search(r"(\S+) % without the brake's tolerance", said).group(1))
        self.assertLess(told, 0.9 * error)
        device["brake"]["tolerance"] = "0 %"
        self.write("exact.json", json.dumps(device))
        self.assertEqual(self.felt_where_slips_give_way(network_file, "--device", "exact.json")[0], told)

    def test_what_is_compared_has_the_numbers_of_its_row(self):
        """Fails if the words compare a choice behind slips with a candidate that was weighed before the law behind them
        was chosen."""
        self.write("needle.json", network("""{ "parallel": [ { "damper": 1 }, { "series": [ { "slip": 0.4, "name": "skin" }, { "spring": 400 } ] },
          { "series": [ { "slip": 0.8, "name": "capsule" }, { "parallel": [ { "spring": 300 }, { "damper": 0.5 } ] } ] } ] }""", "needle"))
        self.write("handle.json", json.dumps({
            "dashpot_device": 1, "name": "handle", "motion": "rotation", "arm_radius": "60 mm",
            "loop": {"rate": "2 kHz", "delay_samples": 1, "band": ["0.1 Hz", "30 Hz"]},
            "encoder": {"counts_per_turn": 20000},
            "velocity": {"estimator": "backward_difference", "window": 8},
            "motor": {"torque_constant": "0.24 N m/A", "max_torque": "0.6 N m", "amplifier_lag": "0.3 ms"},
            "brake": {"kind": "eddy_current", "max_damping": "10 mN m s/rad",
                      "damping_per_current_squared": "1.5 mN m s/(rad A^2)", "tolerance": "10 %",
                      "coil_lag": "4 ms"},
            "mechanics": {"inertia": "0.3 g m^2", "damping": "200 uN m s/rad", "coulomb_friction": "5 mN m"}}))
        found = self.explained("needle.json", "--device", "handle.json")
        (paper,) = (c for c in found["candidates"] if c["name"] == "paper")
        told = re.search(r"the paper's rule, b = 1 N s/m, the felt error is (\S+) %, (\S+) N s/m have to be added",
                         found["choice"]["in_words"]).groups()
        self.assertEqual(told, (f"{100 * paper['largest_error']:.3g}", f"{paper['minimum_damping']:.3g}"))
        asked = self.explained("needle.json", "--device", "handle.json", "--decomposition", "paper")
        (paper,) = (c for c in asked["candidates"] if c["name"] == "paper")
        self.assertIn(f"position {paper['minimum_damping']:.4g} N s/m, {100 * paper['largest_error']:.4g} %",
                      asked["reason"])

    def test_behind_slips_no_more_is_added_than_is_missing(self):
        """Fails if more is added to the brake than the minimum damping that is reported; what is added is felt."""
        self.write("needle.json", """{ "dashpot": 1, "name": "needle", "network": { "parallel": [ { "damper": 0.41 }, { "spring": 18.5 },
          { "series": [ { "spring": 65.6 }, { "damper": 5.25 } ] }, { "series": [ { "slip": 0.75 }, { "spring": 1500 } ] } ] } }""")
        device = json.loads(PANTOGRAPH.read_text())
        device["loop"].update(rate="2 kHz", jitter="40 us", delay_samples=1)
        device["velocity"] = {"estimator": "backward_difference", "window": 2}
        device["brake"].update(max_damping="20 mN m s/rad")
        self.write("late.json", json.dumps(device))
        done = self.dashpot("explain", "needle.json", "--device", "late.json", "--json")
        row = next(row for row in json.loads(done.stdout)["candidates"] if row["name"] == "faithful")
        self.assertGreater(row["minimum_damping"], 0)
        told = self.dashpot("explain", "needle.json", "--device", "late.json").stdout
        added = float(re.search(r"(\S+) N s/m of the brake's command are for passivity", told).group(1))
        self.assertAlmostEqual(added, row["minimum_damping"], delta=1e-5 * added)

    def test_what_is_proved_at_the_motors_limit_is_told(self):
        """Fails if a choice, or damping of the device's own, that is said to be proved at the motor's limit is not."""
        proved = "that is passive with the"
        done = self.dashpot("explain", FIG_5, "--device", PANTOGRAPH)
        self.assertNotIn(proved, " ".join(done.stdout.split()))
        options = re.search(r"'(--.*)' has been tried and is proved there too", done.stderr).group(1)
        self.assertIn(proved,
                      " ".join(self.dashpot("explain", FIG_5, "--device", PANTOGRAPH, *options.split()).stdout.split()))
        device = json.loads(PANTOGRAPH.read_text())
        device["mechanics"]["damping"] = re.search(r'"damping": "(.*)" in "mechanics"', done.stderr).group(1)
        self.write("damped.json", json.dumps(device))
        self.assertIn(proved, " ".join(self.dashpot("explain", FIG_5, "--device", "damped.json").stdout.split()))
        found = self.explained(FIG_5, "--device", "damped.json")
        (chosen,) = (c for c in found["candidates"] if c["name"] == found["chosen"])
        told = re.search(r'in "mechanics" of the device file; the felt error would be up to (\S+) %',
                         done.stderr).group(1)
        self.assertEqual(f"{100 * chosen['largest_error']:.3g}", told)

    def test_a_contact_shows_what_its_certificate_says(self):
        """Fails if the row of the choice, or its words, say of a certified contact that nothing is proved of it."""
        self.write("liver.json", network(
            '{ "parallel": [ { "spring": "46.4 N/m" }, { "series": [ { "damper": "0.292 N s/m" }, { "spring": "78.8 '
            'N/m" } ] } ] }',
            "liver", '"contact": { "at": 0 },'))
        self.write("stage.json", json.dumps(self.STAGE))
        found = self.explained("liver.json", "--device", "stage.json")
        self.assertTrue(found["certificate"]["certified"])
        (chosen,) = (c for c in found["candidates"] if c["name"] == found["chosen"])
        self.assertEqual(chosen["minimum_damping"], found["certificate"]["minimum_damping"])
        self.assertTrue(found["choice"]["certified"])
        self.assertNotIn("is certified", found["choice"]["in_words"])

    def test_rows_of_fixed_values_are_told(self):
        """Fails if rows of a network with tunable parameters pass for what the law with set() needs, or are compared
        with it."""
        file = SOURCE / "networks/tunable/second_order_maxwell_tunable.json"
        told = self.dashpot("explain", file, "--device", PANTOGRAPH).stdout
        self.assertIn("\nrows with *           ", told)
        self.assertRegex(told, r"\nfaithful +[0-9].*\npaper\* +[0-9]")
        self.assertNotIn("\nnote: ", told)
        self.assertNotIn("With the paper's rule", told)
        self.assertNotIn("\nrows with", self.dashpot("explain", FIG_5, "--device", PANTOGRAPH).stdout)

    LATE = {"dashpot_device": 1, "name": "late", "motion": "translation",
            "loop": {"rate": "2 kHz", "delay_samples": 1, "band": ["0.1 Hz", "20 Hz"]},
            "encoder": {"resolution": "12 um"},
            "velocity": {"estimator": "backward_difference", "window": 8}, "motor": {"amplifier_lag": "0.3 ms"},
            "brake": {"kind": "eddy_current", "max_damping": "2.8 N s/m", "tolerance": "8 %"},
            "mechanics": {"damping": "0.06 N s/m"}}
    TUNED = network(
        '{ "parallel": [ { "spring": "k0" }, { "damper": 1.5 }, '
        '{ "series": [ { "spring": 320 }, { "damper": 20 } ] } ] }',
        "tuned", '"parameters": { "k0": { "value": "100 N/m", "tunable": true, "min": "50 N/m", "max": "300 N/m" } },')
    PAD = network(
        '{ "parallel": [ { "spring": 100 }, { "damper": 0.6 }, '
        '{ "series": [ { "spring": 160 }, { "damper": 20 } ] } ] }', "pad")

    def chosen_row(self, *arguments):
        found = self.explained(*arguments)
        (chosen,) = (c for c in found["candidates"] if c["name"] == found["chosen"])
        return chosen, found

    def test_the_chosen_row_is_of_its_certificate(self):
        """Fails if the row of the choice of a network with tunable parameters says another damping than its
        certificate, on a device or on an ideal one."""
        self.write("late.json", json.dumps(self.LATE))
        self.write("tuned.json", self.TUNED)
        friction = SOURCE / "networks/tunable/friction_tunable.json"
        for arguments in [("tuned.json", "--device", "late.json"),
                          ("tuned.json", "--device", "late.json", "--decomposition", "1.3"),
                          (friction,), (friction, "--device", "late.json")]:
            chosen, found = self.chosen_row(*arguments)
            self.assertGreater(found["certificate"]["minimum_damping"], 0, arguments)
            self.assertEqual(chosen["minimum_damping"], found["certificate"]["minimum_damping"], arguments)

    def test_a_choice_over_ranges_is_the_best_of_several(self):
        """Fails if for tunable parameters another damping is certified and errs noticeably less than the one that is
        chosen."""
        self.write("late.json", json.dumps(self.LATE))
        self.write("tuned.json", self.TUNED)
        chosen, found = self.chosen_row("tuned.json", "--device", "late.json")
        self.assertIn(" that was tried ", found["choice"]["in_words"])
        for damping in ["0.4", "0.8", "1", "1.2", "1.3", "1.5"]:
            other, _ = self.chosen_row("tuned.json", "--device", "late.json", "--decomposition", damping)
            if other["certified"]:
                self.assertLess(0.9 * chosen["largest_error"], other["largest_error"], damping)

    def test_changes_of_the_device_are_listed(self):
        """Fails if a shorter window or a faster loop is not reported, or a listed change does not bring what was
        predicted, or not the best is first."""
        self.write("late.json", json.dumps(self.LATE))
        self.write("pad.json", self.PAD)
        said = self.dashpot("explain", "pad.json", "--device", "late.json").stderr
        listed = re.search(r"would bring the felt error down: to (.*)", said).group(1)
        errors = [float(error) for error in re.findall(r"(\S+) % (?:with|at)", listed)]
        self.assertEqual(errors, sorted(errors))
        error, noise = re.search(r'(\S+) % with a "window" of 4 \(where the motor\'s noise is (\S+) N', listed).groups()
        rate_error, rate = re.search(r"(\S+) % at a rate of (\S+) Hz", listed).groups()
        for section, change, told in [("velocity", {"window": 4}, error), ("loop", {"rate": f"{rate} Hz"}, rate_error)]:
            self.write("other.json", json.dumps(self.LATE | {section: self.LATE[section] | change}))
            chosen, _ = self.chosen_row("pad.json", "--device", "other.json")
            self.assertEqual(f"{100 * chosen['largest_error']:.3g}", told)
            if section == "velocity":
                self.assertEqual(f"{chosen['motor_noise']:.3g}", noise)

    def test_no_filter_beyond_half_the_rate_is_tried(self):
        """Fails if twice the filter's cutoff is tried where no filter has it, which ends the command in a defect."""
        self.write("damper.json", json.dumps({"dashpot": 1, "name": "damper", "network": {"damper": "B"},
                                              "parameters": {"B": {"value": 2, "tunable": True, "min": 0, "max": 10}}}))
        for order, cutoff in [(2, 250), (2, 300), (4, 450)]:
            self.write("filtered.json", json.dumps({
                "dashpot_device": 1, "name": "filtered", "loop": {"rate": 1000},
                "velocity": {"estimator": "butterworth", "order": order, "cutoff": cutoff},
                "brake": {"kind": "eddy_current", "max_damping": 30, "tolerance": 0.2}}))
            said = self.dashpot("check", "damper.json", "--device", "filtered.json").stderr
            self.assertIn("[felt-error]", said)
            self.assertNotIn('"cutoff"', said)

    def test_notes_say_what_they_cost(self):
        """Fails if a choice that needs less damping, or is quieter, is praised without what it errs by."""
        self.write("late.json", json.dumps(self.LATE))
        self.write("pad.json", self.PAD)
        text = " ".join(self.dashpot("explain", "pad.json", "--device", "late.json").stdout.split())
        _, found = self.chosen_row("pad.json", "--device", "late.json")
        notes = re.findall(r"note: '(\S+)' would need (?:.*?), with a felt error of (\S+) % instead of", text)
        self.assertEqual(text.count("note: '"), len(notes))
        self.assertTrue(notes)
        for name, error in notes:
            (row,) = (c for c in found["candidates"] if c["name"] == name)
            self.assertAlmostEqual(100 * row["largest_error"], float(error), delta=0.01 * float(error))

    def test_what_the_brake_is_told(self):
        """Fails if what passivity adds to b is not stated beside it, or is not what the law commands the brake."""
        self.write("late.json", json.dumps(self.LATE))
        self.write("pad.json", self.PAD)
        chosen, found = self.chosen_row("pad.json", "--device", "late.json")
        text = self.dashpot("explain", "pad.json", "--device", "late.json").stdout
        told, added = re.search(r"\nbrake command +(\S+) N s/m, of which (\S+) are for passivity; the brake can make "
                                r"2.8\n", text).groups()
        self.assertGreater(float(added), 0)
        self.assertEqual(f"{found['certificate']['added_damping']:.4g}", added)
        self.assertAlmostEqual(chosen["damping"] + float(added), float(told), delta=1e-3 * float(told))

    def test_another_state_input_is_named(self):
        """Fails if for a damping that was asked for the state input that needs less hides one that errs less."""
        self.write("late.json", json.dumps(self.LATE))
        self.write("pad.json", self.PAD)
        arguments = ["pad.json", "--device", "late.json", "--decomposition", "0.25"]
        chosen, _ = self.chosen_row(*arguments)
        options, error = re.search(r"with '(--state-input \S+)' it deviates by up to (\S+) %",
                                   self.dashpot("explain", *arguments).stderr).groups()
        other, _ = self.chosen_row(*arguments, *options.split())
        self.assertEqual(f"{100 * other['largest_error']:.3g}", error)
        self.assertLess(other["largest_error"], 0.9 * chosen["largest_error"])

    def test_an_error_is_told_of_what_is_not_certified_too(self):
        """Fails if what is felt errs without a warning where the law is not certified either."""
        self.write("late.json",
                   json.dumps({key: value for key, value in self.LATE.items() if key not in ("brake", "mechanics")}))
        self.write("pad.json", self.PAD)
        chosen, found = self.chosen_row("pad.json", "--device", "late.json")
        self.assertFalse(found["certificate"]["certified"])
        self.assertGreater(chosen["largest_error"], 0.06)
        self.assertIn("[felt-error]", self.dashpot("explain", "pad.json", "--device", "late.json").stderr)

    def test_a_brake_that_would_do_is_written_whole(self):
        """Fails if the brake that is suggested for a device without one is refused, or does not suffice, when it is
        written as suggested."""
        device = {key: value for key, value in self.LATE.items() if key not in ("brake", "mechanics")}
        self.write("late.json", json.dumps(device))
        self.write("pad.json", self.PAD)
        told = self.refused("compile", "pad.json", "--device", "late.json", code="not-certified").stderr
        device |= json.loads("{" + re.search(r'would be enough: ("brake": \{.*?\}) of the device file',
                                             told).group(1) + "}")
        self.write("braked.json", json.dumps(device))
        self.assertTrue(self.explained("pad.json", "--device", "braked.json")["certificate"]["certified"])

    def test_the_lag_alone_is_left_out_where_that_is_enough(self):
        """Fails if more own damping is asked for than a device needs that is as prompt as the note says."""
        device = {"dashpot_device": 1, "name": "rig", "motion": "translation",
                  "loop": {"rate": "2 kHz", "delay_samples": 1},
                  "encoder": {"resolution": "2 um", "range": ["-30 mm", "30 mm"], "max_speed": "0.5 m/s"},
                  "velocity": {"estimator": "backward_difference", "window": 8},
                  "motor": {"max_torque": "12 N", "amplifier_lag": "0.3 ms", "slew": "3 kN/s"},
                  "brake": {"kind": "eddy_current", "max_damping": "8 N s/m", "tolerance": "8 %"},
                  "mechanics": {"damping": "0.05 N s/m"}}
        self.write("rig.json", json.dumps(device))
        told = self.dashpot("compile", SOURCE / "networks/paper/bridge.json", "--device", "rig.json", "-o",
                            "out").stderr
        self.assertIn('the device would be good enough if its motor\'s amplifier had no lag ("amplifier_lag")', told)
        del device["motor"]["amplifier_lag"]
        self.write("prompt.json", json.dumps(device))
        self.assertTrue(self.explained(SOURCE / "networks/paper/bridge.json", "--device",
                                       "prompt.json")["certificate"]["certified"])

    def test_slips_leave_the_brake_room_for_passivity(self):
        """Fails if a law behind slips takes all of the brake, so that the default is refused or certified only without
        it."""
        brake = self.skin_on_paddle()
        for choice in ([], ["--decomposition", "steady"], ["--decomposition", "ramped"]):
            found = self.explained("skin.json", "--device", "paddle.json", *choice)
            self.assertTrue(found["certificate"]["certified"], choice)
            self.assertLessEqual(found["certificate"]["needed_damping"], brake * (1 + 1e-9))
        told = self.dashpot("compile", "skin.json", "--device", "paddle.json").stderr
        self.assertIn("[felt-error-behind-slips]", told)
        self.assertNotIn("[felt-error-behind-slips]", self.dashpot("compile", "skin.json").stderr)

    def test_a_refused_choice_names_one_that_would_do(self):
        """Fails if a decomposition that is asked for and refused goes without the one that is certified on the same
        device."""
        self.skin_on_paddle(amplifier_lag="0.3 ms")
        asked = ["skin.json", "--device", "paddle.json", "--decomposition", "0.3"]
        done = self.refused("compile", *asked, code="not-certified")
        options, damping = re.search(r"note: '(--.*)' would be enough: it is certified, with b = ([0-9.]+) N s/m",
                                     done.stderr).groups()
        found = self.explained("skin.json", "--device", "paddle.json", *options.split())
        (chosen,) = (c for c in found["candidates"] if c["name"] == found["chosen"])
        self.assertEqual(f"{chosen['damping']:.4g}", damping)
        self.dashpot("compile", "skin.json", "--device", "paddle.json", *options.split(), "-o", "out")

    def test_every_number_is_finite(self):
        """Fails if a network at the edge (no spring, no damper, zero values) gives what JSON cannot hold."""
        edges = ['{ "spring": 3 }', '{ "damper": 3 }', '{ "spring": 0 }', '{ "damper": 0 }',
                 '{ "series": [ { "spring": 1e-300 }, { "damper": 1e300 } ] }',
                 '{ "series": [ { "spring": 1e300 }, { "damper": 1e-300 } ] }']
        for number, edge in enumerate(edges):
            self.write(f"{number}.json", network(edge))
            for device in [[], ["--device", PANTOGRAPH]]:
                text = self.dashpot("explain", f"{number}.json", "--json", "--no-advice", *device).stdout
                json.loads(text, parse_constant=lambda word: self.fail(f"{word} in {edge}"))
                self.assertNotIn("null,\n      \"relaxation_rate\"", text)

    def test_units(self):
        """Fails if a number of the JSON has no unit of its motion, or a parameter none."""
        self.write("rotary.json", KELVIN.replace('"name"', '"motion": "rotation", "name"', 1))
        self.assertEqual(self.explained("rotary.json")["units"]["stiffness"], "N m/rad")
        found = self.explained(SOURCE / "networks/tunable/second_order_maxwell_tunable.json")
        self.assertEqual(found["units"]["damping"], "N s/m")
        self.assertEqual([t["unit"] for t in found["tunables"]], ["N/m", "N s/m"])

    def test_json_alone_on_standard_output(self):
        """Fails if warnings mix with the JSON."""
        self.write("fast.json", network('{ "series": [ { "spring": 1e6 }, { "damper": 1 } ] }'))
        done = self.dashpot("explain", "fast.json", "--json")
        json.loads(done.stdout)
        self.assertIn("[fast-relaxation]", done.stderr)

    def test_regimes_of_slips(self):
        """Fails if a regime of Fig. 10 is missing, or gives the brake another damping than theory says: B1 alone is at
        the tool, B2 = 0.8 joins it while the slip gives way, or at all times where nothing is to switch."""
        fig_10 = SOURCE / "networks/paper/visco_elasto_plastic.json"
        steady = self.explained(fig_10)
        self.assertEqual([regime["damping"] for regime in steady["regimes"]], [0.8, 0.8])
        (component,) = steady["slip_laws"]
        self.assertEqual(component["chosen"], "steady")
        for law in component["laws"]:
            self.assertGreaterEqual(law["largest_error"], max(law["peak_error"], law["rms_error"]))
        self.assertLess(component["laws"][0]["largest_error"], 1e-12)
        found = self.explained(fig_10, "--decomposition", "gated")
        self.assertEqual(found["feedthrough_damping"], 2.5)
        self.assertEqual([regime["stuck"] for regime in found["regimes"]], [["Y"], []])
        self.assertEqual([regime["sliding"] for regime in found["regimes"]], [[], ["Y"]])
        self.assertEqual([regime["damping"] for regime in found["regimes"]], [0, 0.8])
        self.assertEqual([regime["feedthrough_damping"] for regime in found["regimes"]], [0, 0])
        for regime in found["regimes"]:
            self.assertLessEqual(set(found["candidates"][0]) - set(regime), {"state_inputs"})
        (component,) = found["slip_laws"]
        self.assertEqual(component["regimes"], 2)
        self.assertEqual([law["name"] for law in component["laws"]], ["velocity-free", "steady", "ramped", "gated"])
        self.assertEqual(component["chosen"], "gated")
        self.assertEqual([law["peak_error"] for law in component["laws"]], [None] * 4)
        self.assertEqual(self.explained(FIG_5)["regimes"], [])


    def test_regimes_relax(self):
        """Fails if a regime does not tell what relaxes in it: the branch behind a slip while that holds, of a contact
        what it touches."""
        branch = '{ "series": [ { "spring": 40 }, { "damper": 8 } ] }'
        slip = f'{{ "series": [ {{ "slip": 1 }}, {{ "parallel": [ {{ "spring": 20 }}, {branch} ] }} ] }}'
        for structure, surface in [(slip, ""), (branch, '"contact": { "at": 0 },')]:
            self.write("sample.json", network(structure, more=surface))
            held, left = self.explained("sample.json")["regimes"]
            self.assertEqual((held["modes"], left["modes"]), ([{"stiffness": 40, "relaxation_rate": 5}], []))

    def test_regimes_of_coupled_slips(self):
        """Fails if slips that are coupled, in no tree, or behind a contact have no regimes, or the tool that is free
        none."""
        bridge = """{ "dashpot": 1, "name": "bridge", MORE "elements": [
          { "damper": 2, "nodes": ["tool", "a"] }, { "damper": 3, "nodes": ["tool", "b"] }, { "slip": 0.2, "nodes": ["a", "b"] },
          { "damper": 4, "nodes": ["a", "ground"] }, { "damper": 1, "nodes": ["b", "ground"] } ] }"""
        self.write("bridge.json", bridge.replace("MORE", ""))
        regimes = self.explained("bridge.json")["regimes"]
        self.assertEqual([regime["stuck"] for regime in regimes], [["slip_3"], []])
        for regime, damping in zip(regimes, [2.5, 8 / 6 + 3 / 4]):
            self.assertAlmostEqual(regime["damping"], damping, delta=1e-15)
        self.assertEqual([regime["name"] for regime in regimes], ["velocity-free"] * 2)
        self.write("touched.json", bridge.replace("MORE", '"contact": { "at": 0 },'))
        regimes = self.explained("touched.json")["regimes"]
        self.assertEqual([(regime["component"], regime["name"]) for regime in regimes],
                         [("slip_3", "velocity-free")] * 2 + [("contact", "touching"), ("contact", "free")])
        for regime, damping in zip(regimes, [2.5, 8 / 6 + 3 / 4, 0, 0], strict=True):
            self.assertAlmostEqual(regime["damping"], damping, delta=1e-15)
        candidate = self.explained("touched.json")["candidates"][0]
        for regime in regimes:
            self.assertLessEqual(set(candidate) - set(regime), {"state_inputs"})


class MotorLimits(CommandTest):
    """A wall of 1 kN/m at 1 kHz, at most 50 mm from where it is at rest, pressed at 0.5 m/s at most."""

    def explained(self, network="wall.json", choice="velocity-free", **motor):
        self.write("wall.json", '{ "dashpot": 1, "name": "wall", "network": { "spring": "1 kN/m" } }')
        self.write("slip.json",
                   '{ "dashpot": 1, "name": "slip", '
                   '"network": { "series": [{ "spring": "1 kN/m" }, { "slip": "9 N" }] } }')
        device = {"dashpot_device": 1, "name": "slewing", "motion": "translation", "loop": {"rate": "1 kHz"},
                  "encoder": {"resolution": "1 um", "range": ["-10 mm", "40 mm"], "max_speed": "0.5 m/s"},
                  "velocity": {"estimator": "backward_difference", "window": 4}, "motor": motor,
                  "brake": {"kind": "eddy_current", "max_damping": "20 N s/m"},
                  "mechanics": {"damping": "0.5 N s/m", "inertia": "50 g"}}
        self.write("slewing.json", json.dumps(device))
        arguments = [network, "--device", "slewing.json", "--decomposition", choice]
        self.text = self.dashpot("explain", *arguments, "--no-advice").stdout
        return json.loads(self.dashpot("explain", *arguments, "--json", "--no-advice").stdout)

    def test_a_limit_that_never_binds(self):
        """Fails if what the motor can make anyway is said to be cut, or the largest force is not k R."""
        limits = self.explained(max_torque="51 N")["motor_limits"]
        self.assertAlmostEqual(limits["largest_force"], 50, delta=1e-9)
        self.assertAlmostEqual(limits["slew_needed"], 500, delta=1e-8)
        self.assertEqual((limits["rule"], limits["covered"], limits["needed_damping"]), ("none", True, None))
        self.assertIn("largest force: the law asks for up to 50 N within the encoder's range; the motor gives 51 N\n",
                      self.text)
        self.assertNotIn("at the motor's limit", self.text)

    def test_a_motor_that_clips(self):
        """Fails if a limit costs a wall more damping than K T/2, which it needs anyway."""
        found = self.explained(max_torque="8 N")
        limits = found["motor_limits"]
        self.assertEqual((limits["rule"], limits["covered"]), ("clamps", True))
        self.assertAlmostEqual(limits["needed_damping"], 0.5, delta=1e-9)
        self.assertLess(found["certificate"]["added_damping"], 1e-15)  # K T rounded up
        self.assertIn("at the motor's limit: the motor clips; that is passive with the 0.5 N s/m", self.text)

    def test_a_slew_that_is_enough_costs_damping(self):
        """Fails if a slewing motor is taken for one that follows at once: K T/2 and K T √(σ/3ρ)."""
        found = self.explained(max_torque="8 N", slew="2 kN/s")
        needed = 0.5 + 1000e-3 * (500 / 6000) ** 0.5
        self.assertAlmostEqual(found["certificate"]["needed_damping"], needed, delta=1e-9)
        self.assertTrue(found["certificate"]["certified"])
        self.assertEqual((found["motor_limits"]["rule"], found["motor_limits"]["covered"]), ("clamps", True))
        self.assertIn("slew: 500 N/s are enough for any motion within range and speed, the motor has 2000 N/s\n",
                      self.text)

    def test_a_discontinuity_is_covered_by_spare_damping(self):
        """Fails if the largest force that may vanish is not that of the spare damping: F0 (1 + 3/2N + ...) = 6 rho
        x/K."""
        found = self.explained(choice="virtual", slew="2 kN/s")
        self.assertEqual(found["motor_limits"]["largest_discontinuity"], 0)
        device = json.loads((self.folder / "slewing.json").read_text())
        device["mechanics"]["damping"] = "2.7886751345948 N s/m"
        self.write("damped.json", json.dumps(device))
        damped = json.loads(self.dashpot("explain", "wall.json", "--device", "damped.json", "--decomposition",
                                         "virtual", "--json", "--no-advice").stdout)
        force = damped["motor_limits"]["largest_discontinuity"]
        steps = force / 2
        self.assertAlmostEqual(force * (1 + 1.5 / steps + (0.5 + 3 ** 0.5 / 36) / steps ** 2), 24, delta=1e-6)

    def test_a_slew_that_is_too_little(self):
        """Fails if a law is certified on a motor that cannot follow it, or does not shed there."""
        found = self.explained(slew="499 N/s")
        self.assertEqual((found["motor_limits"]["rule"], found["motor_limits"]["covered"]), ("sheds", False))
        self.assertFalse(found["certificate"]["certified"])
        self.assertIn("may have to change 1.002 times as fast as its slew lets it", found["certificate"]["reason"])

    def test_a_slew_that_would_do_is_told(self):
        """Fails if the suggested slew is not enough, or if nothing is said where only a motor without one would do."""
        compiled = ["compile", "wall.json", "--device", "slewing.json", "--decomposition", "velocity-free", "-o", "out"]
        self.explained(slew="499 N/s")
        slew = re.search(r'"slew": "(\S+ N/s)" in "motor" of the device file, in place of 499;',
                         self.dashpot(*compiled).stderr).group(1)
        self.assertLess(float(slew.split()[0]), 510)
        self.assertTrue(self.explained(slew=slew)["certificate"]["certified"])
        self.explained(slew="2 kN/s", amplifier_lag="0.2 ms")
        self.assertIn('the device would be good enough if its motor\'s force could change at once ("slew")',
                      self.dashpot(*compiled).stderr)
        self.assertTrue(self.explained(amplifier_lag="0.2 ms")["certificate"]["certified"])
        # A contact, whose force jumps; `explain` says who tells.
        self.write("touch.json",
                   json.dumps({"dashpot": 1, "name": "touch", "contact": {"at": "0 mm"},
                               "network": {"spring": "200 N/m"}}))
        self.explained("touch.json", slew="2 kN/s")
        asked = ["touch.json", "--device", "slewing.json"]
        self.assertIn('the device would be good enough if its motor\'s force could change at once ("slew")',
                      self.dashpot("compile", *asked, "-o", "out").stderr)
        self.assertIn("'dashpot compile' and 'dashpot check' say what would be enough",
                      self.dashpot("explain", *asked).stderr)
        self.assertTrue(self.explained("touch.json")["certificate"]["certified"])
        self.assertNotIn("would be ", self.dashpot("explain", *asked).stderr)

    def test_slips_shed(self):
        """Fails if a network with slips clips where its motor gives less than they hold, or its header does not say
        so."""
        limits = self.explained("slip.json", max_torque="8 N")["motor_limits"]
        self.assertEqual((limits["rule"], limits["covered"]), ("sheds", True))
        self.dashpot("compile", "slip.json", "--device", "slewing.json", "--decomposition", "velocity-free",
                     "--certificate", "slip_certificate.json")
        header = (self.folder / "slip.hpp").read_text()
        self.assertIn("scalar kept_share() const noexcept", header)
        self.assertIn("// at the motor's limit: the law scales all its forces down", header)
        self.dashpot("verify", "slip_certificate.json", "slip.hpp")

    def test_emitted_code_sheds_as_simulate_does(self):
        """Fails if a header, in either timing, or C99 sheds otherwise than the law that simulate runs, or not at
        all."""
        self.explained("slip.json", max_torque="5 N", slew="400 N/s")
        choices = ["slip.json", "--device", "slewing.json", "--decomposition", "velocity-free"]
        rows = [(k * 1e-3, 0.02 * math.sin(0.006 * k) + 0.003 * math.sin(0.05 * k)) for k in range(1000)]
        velocities = [0.0] + [(b[1] - a[1]) / 1e-3 for a, b in zip(rows, rows[1:], strict=False)]
        motion = "".join(f"{t!r},{p!r},{v!r}\n" for (t, p), v in zip(rows, velocities, strict=True))
        self.write("motion.csv", "time,position,velocity\n" + motion)
        ran = self.dashpot("simulate", *choices, "--input", "motion.csv").stdout.splitlines()[1:]
        expected = [float(row.split(",")[5]) for row in ran]
        self.assertLessEqual(max(map(abs, expected)), 5)

        def driver(header, begin, step, share):
            return f"""#include <stdio.h>
                #include "{header}"
                int main(void) {{
                  double t, p, v;
                  int shed = 0;
                  {begin}
                  while (scanf("%lf,%lf,%lf", &t, &p, &v) == 3) {{
                    {step}
                    shed += {share} < 1;
                    printf("%.17g\\n", c.force);
                  }}
                  fprintf(stderr, "%d", shed);
                  return 0;
                }}\n"""
        self.write("m.cpp", driver("slip.hpp", "dashpot::generated::slip m; m.reset(0);",
                                   "const auto c = m.step(p, v);", "m.kept_share()"))
        self.write("m.c", driver("slip.h", "slip m; slip_reset(&m, 0);",
                                 "const dashpot_command c = slip_step(&m, p, v);", "m.sampled_share"))
        cpp, c = [os.environ.get("CXX", "c++"), "-std=c++17", "m.cpp"], [os.environ.get("CC", "cc"), "-std=c99", "m.c"]
        for options, compiler in [([], cpp), (["--constant-time"], cpp), (["--target", "c99"], c)]:
            self.dashpot("compile", *choices, *options)
            subprocess.run([*compiler, "-O1", "-ffp-contract=off", f"-I{SOURCE}/runtime/include", "-o", "m"],
                           cwd=self.folder, check=True)
            done = subprocess.run(["./m"], input=motion, cwd=self.folder, capture_output=True, text=True, check=True)
            self.assertEqual([float(line) for line in done.stdout.split()], expected, options)
            self.assertGreater(int(done.stderr), 20)

    def test_a_header_says_nothing_of_a_limit_that_cannot_bind(self):
        """Fails if a law is changed by a limit that it never reaches."""
        headers = []
        for motor in [{"max_torque": "51 N"}, {}]:
            self.explained(**motor)
            self.dashpot("compile", "wall.json", "--device", "slewing.json", "--decomposition", "velocity-free")
            headers.append(re.sub(r'device_digest = "[0-9a-f]*"', "", (self.folder / "wall.hpp").read_text()))
        self.assertEqual(*headers)


class Text(CommandTest):
    def test_names_every_candidate_and_the_choice(self):
        """Fails if the text for people leaves out a candidate, its damping or the reason."""
        self.write("maxwell.json", MAXWELL)
        text = self.dashpot("explain", "maxwell.json").stdout
        for name in NAMES:
            self.assertRegex(text, rf"(?m)^ *{name} ")
        self.assertRegex(text, r"(?m)^chosen +paper")
        self.assertRegex(text, r"(?m)^paper +5 ")

    def test_units_follow_the_motion(self):
        """Fails if a rotary network is explained in newtons and metres."""
        self.write("rotary.json", KELVIN.replace('"name"', '"motion": "rotation", "name"', 1))
        text = self.dashpot("explain", "rotary.json").stdout
        self.assertIn("N m/rad", text)
        self.assertIn("N m s/rad", text)
        self.assertNotRegex(text, r"N/m\b")


if __name__ == "__main__":
    unittest.main()
