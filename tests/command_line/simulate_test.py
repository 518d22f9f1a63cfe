"""`dashpot simulate`: the table it reads, the table it writes, and the rates that fit together."""
import csv
import io
import math
import re
import struct
import unittest

from dashpot_command import (COMMAND_LINE_WRONG, FIG_5, INPUT_REFUSED, KELVIN, MAXWELL, PANTOGRAPH, SOURCE, CommandTest,
                             codes,
                             network)

COLUMNS = "time,position,velocity,force,damping,motor_force"


def table(rows, header="time,position"):
    return header + "\n" + "".join(",".join(map(str, row)) + "\n" for row in rows)


def ramp(samples, rate=1000, speed=1.0):
    return [(n / rate, speed * n / rate) for n in range(samples)]


class SimulateTest(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("kelvin.json", KELVIN)
        self.write("maxwell.json", MAXWELL)

    def simulated(self, name, text, *arguments):
        """The rows written for the input `text`, each a dictionary of floats."""
        self.write("motion.csv", text)
        done = self.dashpot("simulate", name, "--input", "motion.csv", *arguments)
        header = done.stdout.split("\n", 1)[0]
        self.assertEqual(header, COLUMNS)
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(io.StringIO(done.stdout))]

    def refuses(self, text, code, *arguments, status=INPUT_REFUSED):
        self.write("motion.csv", text)
        return self.refused("simulate", "kelvin.json", "--input", "motion.csv", *arguments, code=code, status=status)


class Output(SimulateTest):
    def test_force_is_what_brake_and_motor_make(self):
        """Fails if the force is not damping · velocity + motor force to the last bit, in any row."""
        rows = self.simulated(FIG_5, table(ramp(50)))
        self.assertEqual(len(rows), 50)
        for row in rows:
            self.assertEqual(row["force"], row["damping"] * row["velocity"] + row["motor_force"])

    def test_time_and_position_come_back(self):
        """Fails if rows are lost, reordered or rounded."""
        motion = [(0.1 * n, math.sin(n)) for n in range(20)]
        rows = self.simulated("kelvin.json", table(motion))
        self.assertEqual([(row["time"], row["position"]) for row in rows], motion)

    def test_ramp_of_a_maxwell_element(self):
        """Fails if f = r B (1 − e^{−λt}) does not come out at the samples."""
        rows = self.simulated("maxwell.json", table(ramp(400)))
        for n, row in enumerate(rows[1:], start=1):
            self.assertAlmostEqual(row["force"], 5 * (1 - math.exp(-10 * n / 1000)), delta=5e-12)

    def test_a_file_instead(self):
        """Fails if -o writes other bytes than standard output gets, or something beside the file."""
        self.write("motion.csv", table(ramp(5)))
        shown = self.dashpot("simulate", "kelvin.json", "--input", "motion.csv").stdout
        done = self.dashpot("simulate", "kelvin.json", "--input", "motion.csv", "-o", "forces.csv")
        self.assertEqual((done.stdout, (self.folder / "forces.csv").read_text()), ("", shown))
        self.refused("simulate", "kelvin.json", "--input", "motion.csv", "-o", "motion.csv/forces.csv",
                     code="cannot-write-file")

    def test_float(self):
        """Fails if a float law is run, added up or written in double."""
        rows = self.simulated(FIG_5, table(ramp(50)), "--scalar", "float")
        as_float = lambda value: struct.unpack("f", struct.pack("f", value))[0]
        for row in rows:
            damping, velocity, motor = [as_float(row[column]) for column in ["damping", "velocity", "motor_force"]]
            self.assertEqual(as_float(row["force"]), as_float(as_float(damping * velocity) + motor))
            for column in ["position", "velocity", "damping", "motor_force", "force"]:
                # Nine digits tell any two floats apart; more are those of a double.
                self.assertEqual(row[column], float(f"{row[column]:.9g}"), column)
        exact = self.simulated(FIG_5, table(ramp(50)))
        self.assertLess(max(abs(a["force"] - b["force"]) for a, b in zip(rows, exact)), 1e-5)
        self.assertNotEqual([row["force"] for row in rows], [row["force"] for row in exact])


class Start(SimulateTest):
    def test_a_first_position_that_is_not_zero(self):
        """Fails if it is not the end of a ramp over the period before, with no velocity in the first row."""
        first = self.simulated("maxwell.json", table([(0, 0.25), (0.001, 0.25)]))[0]
        self.assertEqual(first["velocity"], 0)
        answer = 50 * (1 - math.exp(-0.01)) / 0.01
        self.assertAlmostEqual(first["force"], answer * 0.25, delta=1e-12)

    def test_one_row(self):
        """Fails if a single sample, which has no period, is not taken at the default rate or the one asked for."""
        self.assertEqual(len(self.simulated("maxwell.json", table([(0, 0.25)]))), 1)
        slow, = self.simulated("maxwell.json", table([(0, 0.25)]), "--rate", "10")
        self.assertAlmostEqual(slow["force"], 0.25 * 50 * (1 - math.exp(-1)), delta=1e-12)

    def test_time_may_start_anywhere(self):
        """Fails if only the differences of time do not count."""
        late = [(time + 100, position) for time, position in ramp(20)]
        self.assertEqual([row["force"] for row in self.simulated("maxwell.json", table(late))],
                         [row["force"] for row in self.simulated("maxwell.json", table(ramp(20)))])


class Velocity(SimulateTest):
    def test_the_slope_by_default(self):
        """Fails if velocity is not the slope since the sample before."""
        rows = self.simulated("kelvin.json", table([(0, 0), (0.5, 1), (1, -2)]))
        self.assertEqual([row["velocity"] for row in rows], [0, 2, -6])

    def test_a_column_instead(self):
        """Fails if a measured velocity is ignored."""
        rows = self.simulated("kelvin.json", table([(0, 0, 7), (0.5, 1, 8)], "time,position,velocity"))
        self.assertEqual([row["velocity"] for row in rows], [7, 8])
        self.assertEqual([row["force"] for row in rows], [35, 140])

    def test_columns_with_units(self):
        """Fails if what the loop logs cannot be simulated."""
        rows = self.simulated("kelvin.json", table([(0, 7, 0), (1, 8, 0.5)], "time [s],position [m],velocity [m/s]"))
        self.assertEqual([row["velocity"] for row in rows], [0, 0.5])

    def test_columns_in_any_order_among_others(self):
        """Fails if columns are found by place rather than by name."""
        rows = self.simulated("kelvin.json", table([(9, 7, 0, 0), (9, 8, 1, 0.5)], "force,velocity,position,time"))
        self.assertEqual([row["force"] for row in rows], [35, 140])


class Rate(SimulateTest):
    def test_is_taken_from_the_file(self):
        """Fails if the law runs at another period than the rows: the answer to one row's ramp shows it."""
        for rate in [5, 30, 1000, 44100]:
            row = self.simulated("maxwell.json", table(ramp(3, rate)))[1]
            self.assertAlmostEqual(row["force"], 5 * (1 - math.exp(-10 / rate)), delta=1e-11)

    def test_rounded_times(self):
        """Fails if times cut to whole picoseconds are no uniform period, or the law runs at the cut one."""
        rows = [(f"{n / 3000:.12f}", f"{n / 3000:.17g}") for n in range(3000)]
        answer = self.simulated("maxwell.json", table(rows))[-1]["force"]
        self.assertAlmostEqual(answer, 5 * (1 - math.exp(-10 * 2999 / 3000)), delta=1e-11)

    def test_times_in_microseconds(self):
        """Fails if times at 3 kHz, written in whole microseconds, are refused, or the law runs at another rate than
        they mean."""
        answer = 5 * (1 - math.exp(-10 * 2999 / 3000))
        for written in ["{:.6f}", "{:.6e}", "{:.5e}", "{:.7g}"]:
            rows = [(written.format(n / 3000), f"{n / 3000:.17g}") for n in range(3000)]
            self.assertAlmostEqual(self.simulated("maxwell.json", table(rows))[-1]["force"], answer, delta=1e-11)
            self.assertEqual(len(self.simulated("maxwell.json", table(rows), "--rate", "3000")), 3000)
            self.refuses(table(rows), "csv-rate-contradicts", "--rate", "3001", status=COMMAND_LINE_WRONG)
        cut = [(f"{n * 1000000 // 44100 * 1e-6:.6f}", 0) for n in range(4410)]
        self.assertEqual(len(self.simulated("maxwell.json", table(cut), "--rate", "44100")), 4410)

    def test_rounding_hides_nothing_else(self):
        """Fails if a missing row, a rate that changes, or a time that is off by more than its rounding passes for
        rounded times."""
        micro = [round(n * 1e6 / 3000) for n in range(300)]

        def refusal(times, code="csv-not-uniform"):
            return self.refuses(table([(f"{time / 1e6:.6f}", 0) for time in times]), code).stderr

        told = refusal(micro[:200] + micro[201:])
        self.assertTrue(told.startswith("motion.csv:202:1: error: row follows after 0.000667 s; a uniform period of "
                                        "0.000333 s"), told)
        self.assertIn("times if their last digit, 1e-06 s here, is at most 0.1 of a period", told)
        refusal([time + 4 * (n == 150) for n, time in enumerate(micro)])
        self.refuses(table([(f"{(time + 4 * (n == 150)) / 1e6:.5e}", 0) for n, time in enumerate(micro)]),
                     "csv-not-uniform")
        told = refusal([333 * n + max(0, n - 150) for n in range(300)], "csv-drifts")
        self.assertRegex(told,
                         r"motion\.csv:\d+:1: error: row is at 0\.\d+ s; rows at a uniform period of 0\.000333\d* s "
                         r"have it at 0\.")
        told = self.refuses(table([(f"{n / 300:.3f}", 0) for n in range(30)]), "csv-not-uniform").stderr
        self.assertIn("last digit, 0.001 s here", told)

    def test_times_since_an_epoch(self):
        """Fails if times so late that a double rounds them to 0.1 us make a law of another rate."""
        rows = [(f"{1_700_000_000 + n / 1000:.6f}", n / 1000) for n in range(5001)]
        answer = self.simulated("maxwell.json", table(rows))[-1]["force"]
        self.assertAlmostEqual(answer, 5 * (1 - math.exp(-50)), delta=5e-10)

    def test_agreement_is_no_contradiction(self):
        """Fails if the rate that the file has anyway may not be given."""
        self.simulated("kelvin.json", table(ramp(10)), "--rate", "1000")
        self.simulated("kelvin.json", table(ramp(10, 10000)), "--device", PANTOGRAPH)

    def test_says_that_it_is_the_law_alone(self):
        """Fails if the forces of a law that is compiled for a device could be taken for what the device makes."""
        self.write("motion.csv", table(ramp(10, 10000)))
        on_device = ["simulate", "kelvin.json", "--input", "motion.csv", "--device", PANTOGRAPH]
        self.assertIn("this is the law alone", self.dashpot(*on_device).stderr)
        self.assertEqual(self.dashpot(*on_device[:-2]).stderr, "")

    def test_contradictions_are_wrong_command_lines(self):
        """Fails if a file is run through a law of another rate."""
        self.refuses(table(ramp(10)), "csv-rate-contradicts", "--rate", "2000", status=COMMAND_LINE_WRONG)
        self.refuses(table(ramp(10)), "csv-rate-contradicts", "--device", PANTOGRAPH, status=COMMAND_LINE_WRONG)
        self.refuses(table(ramp(10)), "device-rate-contradicts", "--device", PANTOGRAPH, "--rate", "1000",
                     status=COMMAND_LINE_WRONG)


class Table(SimulateTest):
    def test_ends_of_lines_do_not_matter(self):
        """Fails if a table from another system, or one that was cut by hand, gives other numbers."""
        text = table(ramp(5))
        plain = self.simulated("kelvin.json", text)
        for variant in [text.replace("\n", "\r\n"), text.rstrip("\n"), text + "\n\n", "\ufeff" + text,
                        text.replace(",", " , "), text.replace("time", '"time"')]:
            self.assertEqual(self.simulated("kelvin.json", variant), plain, repr(variant[:40]))

    def test_units_names_and_separators(self):
        """Fails if a recording in other units, under other names, with other separators or with lines in front gives
        other forces, or if a unit that does not fit is taken."""
        rows = [(n, (7 * n) % 40) for n in range(60)]  # [ms], [mm]
        plain = self.simulated("kelvin.json", table([(f"{t / 1000:.3f}", repr(u * 1e-3)) for t, u in rows]))
        lines = {"time [ms],position [mm]": ",", "t [ms];x_mm": ";", "elapsed time/ms\tdepth (mm)": "\t",
                 "# t[ms] disp[mm]": " ", "time [ms] | position [mm]": "|"}
        for header, separator in lines.items():
            text = header + "\n" + "".join(f"{t}{separator}{u}\n" for t, u in rows)
            for before in ["", "#\n# rig no. 3\nby hand, twice\n"]:
                found = self.simulated("kelvin.json", before + text)
                self.assertEqual([row["position"] for row in found], [row["position"] for row in plain], header)
                self.assertEqual([row["force"] for row in found], [row["force"] for row in plain], header)
        found = self.simulated("kelvin.json", "time;position\nms;mm\n" + "".join(f"{t},0;{u},0\n" for t, u in rows))
        self.assertEqual([row["force"] for row in found], [row["force"] for row in plain])
        slow = self.simulated("kelvin.json",
                              table([(n, 0, 60) for n in range(3)], "time [ms],position [mm],velocity [mm/min]"))
        self.assertEqual(slow[0]["velocity"], 60 * (1 / 60000))
        self.refuses(table([(0, "1e308")], "time,position [Tm]"), "number-too-large")
        self.refuses(table([(0, 0)], "time,position [N]"), "recording-wrong-unit")
        self.refuses(table([(0, 0)], "time [mm],position"), "recording-wrong-unit")
        told = self.refuses(table([(0, 0), (0.001, 1)], "time,position [deg]"), "csv-other-motion").stderr
        self.assertTrue(told.startswith(
            "motion.csv:1:6: error: the motion is in radians; the network's tool moves in metres"), told)

    def test_a_unit_that_is_left_out(self):
        """Fails if millimetres beside milliseconds are taken for metres without a word, or a table without units is
        warned of."""
        warning = "motion.csv:1:11: warning: column 'position' has no unit, while that of time has 'ms'"
        headers = {"time [ms],position": True, "time,position": False, "time [ms],position [mm]": False}
        for header, warned in headers.items():
            self.write("motion.csv", table([(0, 0), (1, 1)], header))
            told = self.dashpot("simulate", "kelvin.json", "--input", "motion.csv").stderr
            self.assertEqual(warning in told, warned, told)

    def test_missing_columns(self):
        """Fails if a table without time or position is given a meaning; both are named where both are missing."""
        self.refuses(table([(0, 0)], "time,where"), "csv-missing-column")
        self.refuses(table([(0, 0)], "when,position"), "csv-missing-column")
        done = self.refuses(table([(0, 0)], "when,where"), "csv-missing-column")
        self.assertEqual(codes(done.stderr), ["csv-missing-column"] * 2)
        names = re.findall(r"'([^']+)'", " ".join(re.findall("its name may also be (.*) \\[", done.stderr)))
        listed = (SOURCE / "networks/README.md").read_text().replace(" ", "").replace("\n", "")
        self.assertGreater(len(names), 15)
        for name in names:
            self.assertIn(f"`{name}`", listed)

    def test_units_that_do_not_fit(self):
        """Fails if a column that is there is called missing, or dropped without a word, for its unit."""
        for header, column in {"time,position [in]": "position [in]", "time [fortnights],position": "time [fortnights]",
                               "time,position [N]": "position [N]"}.items():
            told = self.refuses(table([(0, 0), (0.001, 1)], header), "recording-wrong-unit").stderr
            self.assertIn(f"column '{column}' in ", told)
        self.refuses(table([(0, 0, 0)], "time,position,velocity [m]"), "recording-wrong-unit")
        self.refuses("\ufefftime,position\n0,\0\n", "recording-not-text")

    def test_lines_that_end_as_on_old_machines(self):
        """Fails if carriage returns alone do not end lines."""
        self.assertEqual(self.simulated("kelvin.json", table(ramp(5)).replace("\n", "\r")),
                         self.simulated("kelvin.json", table(ramp(5))))

    def test_forces_beyond_all_numbers(self):
        """Fails if an infinite force is written as an answer."""
        self.refuses(table([(0, 0), (0.001, 1e308), (0.002, -1e308)]), "answer-not-finite")

    def test_its_own_answers_are_motions(self):
        """Fails if `check` refuses what `simulate` writes and reads."""
        self.write("motion.csv", table(ramp(5)))
        self.write("answer.csv", self.dashpot("simulate", "kelvin.json", "--input", "motion.csv").stdout)
        self.dashpot("check", "answer.csv")
        self.write("joints.csv", "time,q1,q2\n0,0,0\n0.001,0,0\n")
        self.dashpot("check", "joints.csv")

    def test_a_column_twice(self):
        """Fails if one of two columns of the same name is taken without a warning."""
        self.refuses(table([(0, 0, 1)], "time,position,position"), "csv-column-twice")

    def test_nothing_to_simulate(self):
        """Fails if an empty table is anything but refused."""
        for text in ["", "\n", "time,position\n", "time,position"]:
            self.refuses(text, "csv-empty")

    def test_rows_of_other_lengths(self):
        """Fails if a row with a field too few or too many is read as if it fitted."""
        self.refuses("time,position\n0,0\n0.001\n", "csv-field-count")
        self.refuses("time,position\n0,0\n0.001,1,2\n", "csv-field-count")

    def test_cells_that_are_no_numbers(self):
        """Fails if text, an empty cell, half a number or what is not finite is read as a number."""
        for cell in ["deep", "", "1.5mm", "nan", "inf", "-inf", "+nan", "+-1", "++1", "+", "0x1p3", "1,5"]:
            code = "csv-field-count" if cell == "1,5" else "csv-not-a-number"
            self.refuses(f"time,position\n0,0\n0.001,{cell}\n", code)
        self.refuses("time,position,velocity\n0,0,x\n", "csv-not-a-number")

    def test_numbers_that_no_double_holds(self):
        """Fails if a number that is finite, and yet beyond a double, is taken for another, or reported as not
        finite."""
        for cell, code in [("1e999", "number-too-large"), ("-1e999", "number-too-large"),
                           ("1e-400", "number-too-small"), ("-1e-400", "number-too-small")]:
            told = self.refuses(f"time,position\n0,0\n0.001,{cell}\n", code).stderr
            self.assertTrue(told.startswith(f"motion.csv:3:7: error: '{cell}' is "), told)
            self.assertNotIn("finite", told)
            self.assertEqual(codes(told), [code])

    def test_numbers_with_a_plus_sign(self):
        """Fails if a motion may not write what a network may."""
        self.assertEqual(self.simulated("kelvin.json", "time,position\n+0,+1\n+1e-3,+.5e+0\n"),
                         self.simulated("kelvin.json", "time,position\n0,1\n1e-3,.5\n"))

    def test_periods_that_differ(self):
        """Fails if a gap is taken for a uniform period."""
        done = self.refuses("time,position\n0,0\n0.001,0\n0.002,0\n0.004,0\n", "csv-not-uniform")
        self.assertTrue(done.stderr.startswith("motion.csv:5:1: error:"), done.stderr)
        self.refuses("time,position\n0,0\n0.001,0\n0.002,0\n0.003000003,0\n", "csv-not-uniform")

    def test_a_whole_number_of_digits(self):
        """Fails if one time that is off by a digit passes for rounded where the period is a whole number of digits, so
        that rounding moves all times alike; or if it is refused where the period is none."""
        for start in [0, 17]:
            for digits in [5, 6, 7, 8]:
                times = [n / 1000 + start + (n == 2) * 10**-digits for n in range(6)]
                self.refuses(table([(f"{time:.{digits}f}", 0) for time in times]), "csv-drifts")
        self.assertEqual(len(self.simulated("kelvin.json", table([(f"{n / 80:.3f}", 0) for n in range(9)]))), 9)
        halves = table([(time, 0) for time in ["0.038", "0.050", "0.062", "0.075", "0.088"]])
        self.assertEqual(len(self.simulated("kelvin.json", halves)), 5)

    def test_times_that_do_not_rise(self):
        """Fails if time that falls or stands still passes, is not reported as that, or more digits are asked for where
        none would help."""
        for rows, line, found, before in [([0.002, 0.001, 0], 3, "0.001", "0.002"),
                                          ([0, 0.001, 0.0005, 0.002], 4, "0.0005", "0.001"),
                                          ([0, 0.001, 0.005, 0.004], 5, "0.004", "0.005")]:
            told = self.refuses(table([(time, 0) for time in rows]), "csv-time-not-rising").stderr
            self.assertTrue(told.startswith(f"motion.csv:{line}:1: error: row is at {found} s, the one before at "
                                            f"{before} s; times that rise"), told)
            self.assertNotIn("digits", told)
        for rows in ("0,0\n0,0\n0,0\n", "0,0\n0,1\n"):
            self.assertNotIn("digit", self.refuses("time,position\n" + rows, "csv-time-not-rising").stderr)
        told = self.refuses(table([(f"{n / 3000:.3f}", 0) for n in range(30)]), "csv-time-not-rising").stderr
        self.assertTrue(told.startswith("motion.csv:3:1: error: row is at 0 s, the one before at 0 s"), told)
        self.assertIn("last digit, 0.001 s here", told)
        self.assertIn("write times with more digits", told)

    def test_a_period_that_no_loop_has(self):
        """Fails if rows so close, or so far apart, that their rate is beyond --rate's own limits pass."""
        self.refuses("time,position\n0,0\n1e-300,0\n", "csv-rate-too-high")
        told = self.refuses("time,position\n0,0\n1e10,0\n", "csv-rate-too-low").stderr
        self.assertIn("rows come at 1e-10 Hz; at least 1e-06 Hz is expected", told)
        self.assertEqual(len(self.simulated("kelvin.json", "time,position\n0,0\n1e6,0\n")), 2)


class Tunables(SimulateTest):
    NETWORK = """{ "dashpot": 1, "name": "tuned", "parameters": {
      "K": { "value": 100, "tunable": true, "min": 10, "max": 400 },
      "B": { "value": 2, "tunable": true, "min": 0, "max": 5 } },
      "network": { "parallel": [ { "spring": "K" }, { "damper": "B" } ] } }"""

    def setUp(self):
        super().setUp()
        self.write("tuned.json", self.NETWORK)

    def test_columns_give_values(self):
        """Fails if a column that is called like a tunable does not set it from that row on, or the brake does not
        follow."""
        rows = self.simulated("tuned.json",
                              table([(0, 0, 100, 2), (0.001, 0, 100, 5), (0.002, 0.01, 200, 5), (0.003, 0.02, 200, 1)],
                                    "time,position,K,B"))
        self.assertEqual([row["damping"] for row in rows], [2, 5, 5, 1])
        for row, force in zip(rows, [0, 0, 2, 4]):
            self.assertAlmostEqual(row["motor_force"], force, delta=1e-15)

    def test_columns_have_units(self):
        """Fails if the unit of a tunable's column is not heeded, beside its name or below it, or one of anything else
        is read."""
        motion, expected = [(0, 0, 0.1), (0.001, 0, 0.1), (0.002, 0.01, 0.2)], [0, 0, 2]
        for header in ["time,position,K [N/mm]", "time,position,K (N/mm)", "time,position,K_N/mm",
                       "time,position,K\ns,m,N/mm",
                       "time,position,K\n(sec),(m),(N/mm)"]:
            rows = self.simulated("tuned.json", table(motion, header))
            for row, force in zip(rows, expected, strict=True):
                self.assertAlmostEqual(row["motor_force"], force, delta=1e-14, msg=header)
        for header in ["time,position,K [N s/m]", "time,position,K [furlong]"]:
            self.write("motion.csv", table(motion, header))
            self.refused("simulate", "tuned.json", "--input", "motion.csv", code="recording-wrong-unit")
        self.write("motion.csv", table(motion, "time,position,k"))
        told = self.dashpot("simulate", "tuned.json", "--input", "motion.csv").stderr
        self.assertIn("column 'k' is not read; the tunable nearest by name is 'K'", told)

    def test_columns_may_be_missing(self):
        """Fails if a tunable without a column is not at its own value, or none at all changes the law."""
        motion = ramp(20)
        plain = self.simulated("tuned.json", table(motion))
        self.assertEqual(self.simulated("tuned.json", table([(*row, 2) for row in motion], "time,position,B")), plain)
        self.assertAlmostEqual(plain[-1]["motor_force"], 100 * motion[-1][1], delta=1e-14)

    def test_elements_called_like_numbers_of_the_law(self):
        """Fails if an element that is called like one of the law's own numbers takes its place."""
        def pushed(name):
            damper = f'{{ "damper": 2, "name": "{name}" }}'
            self.write("pushed.json", self.NETWORK.replace('{ "damper": "B" }',
                                                           damper).replace('"network":',
                                                                           '"contact": { "at": 0.002 }, "network":'))
            return self.simulated("pushed.json", table([(0.001 * i, 0.01 * math.sin(0.1 * i)) for i in range(80)]))

        plain = pushed("skin")
        self.assertGreater(max(abs(row["motor_force"]) for row in plain), 0.1)
        for name in ["none", "surface_at", "encoder_step", "zero", "one", "minus_one", "rate", "no_damping"]:
            self.assertEqual(pushed(name), plain, name)

    def test_values_beyond_the_range(self):
        """Fails if a value beyond its range is taken as it is, or clamped without a warning, or warned of in every
        row."""
        self.write("motion.csv", table([(0, 0, 1000), (0.001, 0.01, 1000), (0.002, 0.01, 1)], "time,position,K"))
        done = self.dashpot("simulate", "tuned.json", "--input", "motion.csv")
        self.assertEqual(done.stderr.count("[outside-tunable-range]"), 1)
        self.assertIn("tunable 'K' is 1000 N/m at 0 s; its range is 10 to 400, and its bound is taken", done.stderr)
        forces = [float(row["motor_force"]) for row in csv.DictReader(io.StringIO(done.stdout))]
        self.assertAlmostEqual(forces[1], 400 * 0.01, delta=1e-14)
        self.assertGreaterEqual(forces[2], 10 * 0.01)

    def test_a_slip_whose_yield_force_is_taken_away(self):
        """Fails if a yield force may not be tuned down to zero, or there holds anything but the share of its greatest
        that is stated."""
        text = self.NETWORK.replace('{ "damper": "B" }',
                                    '{ "series": [ { "slip": "B" }, { "spring": 1000 } ] }').replace(
                                        '{ "spring": "K" }, ', "")
        self.write("friction.json", text)
        for scalar, share in [("double", 2**-24), ("float", 2**-10)]:
            rows = self.simulated("friction.json", table([(n / 1000, n / 1000, 0) for n in range(20)],
                                                         "time,position,B"), "--scalar", scalar)
            self.assertEqual(rows[-1]["force"], 5 * share)
        self.write("never.json", text.replace('"min": 0, "max": 5',
                                              '"min": 0, "max": 0').replace('"value": 2', '"value": 0'))
        self.refused("check", "never.json", code="zero-yield")

    def test_cells_that_are_no_numbers(self):
        """Fails if a value that is no finite number reaches the law, or the column of another network is asked for
        numbers."""
        for cell in ["stiff", "", "nan", "inf"]:
            self.write("motion.csv", table([(0, 0, cell)], "time,position,K"))
            self.refused("simulate", "tuned.json", "--input", "motion.csv", code="csv-not-a-number")
            self.dashpot("simulate", "kelvin.json", "--input", "motion.csv")

        self.write("motion.csv", table([(0, 0, "1e999")], "time,position,K"))
        self.refused("simulate", "tuned.json", "--input", "motion.csv", code="number-too-large")

    def test_a_column_twice(self):
        """Fails if one of two columns that are called like a tunable is taken without a warning, or columns that nobody
        reads are minded."""
        self.write("motion.csv", table([(0, 0, 100, 1, 300, 7)], "time,position,K,note,K,note"))
        told = self.refused("simulate", "tuned.json", "--input", "motion.csv", code="csv-column-twice").stderr
        self.assertTrue(told.startswith("motion.csv:1:22: error: column 'K' is there twice"), told)
        self.assertEqual(codes(told), ["csv-column-twice"])
        self.dashpot("simulate", "kelvin.json", "--input", "motion.csv")

    def test_a_name_that_a_motion_has_itself(self):
        """Fails if a tunable that no column can ever set is simulated without a warning, or refused where no motion is
        read."""
        self.write("tuned.json", self.NETWORK.replace('"K"', '"time"'))
        self.write("motion.csv", table(ramp(3)))
        told = self.refused("simulate", "tuned.json", "--input", "motion.csv", code="tunable-named-as-column").stderr
        self.assertTrue(told.startswith(
            "tuned.json:2:15: error: tunable 'time' is called like a column of the motion itself"), told)
        self.dashpot("compile", "tuned.json")

    def test_behind_a_contact(self):
        """Fails if a wall whose stiffness is a slider pulls the tool back, or is felt before it is reached."""
        self.write("wall.json", self.NETWORK.replace('"network"', '"contact": { "at": 0 }, "network"'))
        rows = self.simulated("wall.json", table([(0.001 * n, position, 400 if n % 2 else 10, 2) for n, position in
                                                  enumerate([-0.02, -0.01, 0.01, 0.02, 0.01, 0, -0.01])],
                                                 "time,position,K,B"))
        self.assertEqual([row["force"] for row in rows[:2]], [0, 0])
        self.assertGreater(min(row["force"] for row in rows[2:4]), 0)
        self.assertEqual(min(row["force"] for row in rows), 0)
        self.assertEqual([row["damping"] for row in rows[-1:]], [0])


class Validity(SimulateTest):
    def test_leaving_the_valid_range_is_said_once(self):
        """Fails if a motion beyond what the tissue was measured for is not reported, or is said in every row."""
        self.write("valid.json",
                   network('{ "spring": 3 }', more='"valid": { "displacement": "5 mm", "rate": "0.5 m/s" },'))
        self.write("motion.csv", table(ramp(50)))
        done = self.dashpot("simulate", "valid.json", "--input", "motion.csv")
        self.assertEqual(codes(done.stderr), ["outside-valid-range"] * 2)
        self.write("motion.csv", table(ramp(5, speed=0.1)))
        self.assertEqual(self.dashpot("simulate", "valid.json", "--input", "motion.csv").stderr, "")

    def test_rest_is_within_any_range_of_rates(self):
        """Fails if a motion is blamed for its rests, or a number in the warning has no unit."""
        self.write("valid.json", network('{ "spring": 3 }', more='"valid": { "rate": ["0.5 m/s", "2 m/s"] },'))
        self.write("motion.csv", table([(0, 0), (0.001, 0.001), (0.002, 0.001)]))
        self.assertEqual(self.dashpot("simulate", "valid.json", "--input", "motion.csv").stderr, "")
        self.write("motion.csv", table([(0, 0), (0.001, 0.003), (0.002, 0.003)]))
        self.assertIn("rate is 3 m/s at 0.001 s",
                      self.dashpot("simulate", "valid.json", "--input", "motion.csv").stderr)


if __name__ == "__main__":
    unittest.main()
