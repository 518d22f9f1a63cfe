"""`dashpot import`, `export` and `explain --as`: relaxation functions to and from other programs."""
import json
import unittest

from dashpot_command import COMMAND_LINE_WRONG, FIG_5, INPUT_REFUSED, KELVIN, CommandTest, network

SERIES = network('{ "prony": "1.2 kN/m", "of": "instantaneous", "name": "liver", "terms": [ '
                 '{ "weight": 0.4, "time": "0.1 s" }, { "weight": 0.25, "time": "3 s" } ] }', "organ")
FORMATS = {"abaqus": ["--stiffness", "1.2 kN/m"], "ansys": ["--stiffness", "1.2 kN/m"],
           "febio": ["--stiffness", "1.2 kN/m"], "ls-dyna": ["--modulus", "1 N/m"],
           "generic": ["--stiffness", "1.2 kN/m", "--of", "instantaneous"]}


def form(command, path):
    """Static stiffness and modes of a network."""
    found = json.loads(command.dashpot("explain", path, "--json").stdout)
    return [found["static_stiffness"], found["feedthrough_damping"],
            *(mode[key] for mode in found["modes"] for key in ("stiffness", "relaxation_rate"))]


class Exchange(CommandTest):
    def expect_close(self, found, given, tolerance, what):
        self.assertEqual(len(found), len(given), what)
        for x, y in zip(found, given):
            self.assertLessEqual(abs(x - y), tolerance * max(abs(y), 1), f"{what}: {found} instead of {given}")

    def test_there_and_back(self):
        """Fails if a network that is exported and imported again is another one."""
        given = form(self, self.write("liver.json", SERIES))
        for name, scale in FORMATS.items():
            self.dashpot("export", "liver.json", "--to", name, "-o", f"liver.{name}")
            self.dashpot("import", f"liver.{name}", "--from", name, *scale, "-o", f"{name}.json")
            self.expect_close(form(self, f"{name}.json"), given, 1e-12, name)
            self.dashpot("import", f"liver.{name}", "--from", name, "-o", f"{name}_alone.json")
            self.expect_close(form(self, f"{name}_alone.json"), given, 1e-12,
                              f"{name}, by what the file says of itself")
            self.dashpot("compile", f"{name}.json", "-o", "emitted")

    def test_a_table_says_itself_what_it_is(self):
        """Fails if what is exported as a table can be imported only by who remembers what its weights are shares of, or
        if what the table says is taken against the command line."""
        given = form(self, self.write("liver.json", SERIES))
        self.dashpot("export", "liver.json", "--to", "generic", "-o", "liver.csv")
        self.dashpot("import", "liver.csv", "--from", "generic", "-o", "again.json")
        self.expect_close(form(self, "again.json"), given, 1e-12, "as the table says")
        self.dashpot("import", "liver.csv", "--from", "generic", "--stiffness", "2.4 kN/m", "-o", "twice.json")
        self.expect_close(form(self, "twice.json")[0:1], [2 * given[0]], 1e-12, "with another stiffness")
        self.refused("import", "liver.csv", "--from", "generic", "--of", "long-term", code="prony-scale-missing",
                     status=COMMAND_LINE_WRONG)
        self.write("odd.csv", "# of: instantaneous\n# stiffness: 3 s\nweight,time\n0.4,0.1\n")
        self.refused("import", "odd.csv", "--from", "generic", code="wrong-unit", status=COMMAND_LINE_WRONG)

    def test_a_network_that_rotates_comes_back(self):
        """Fails if the series of a network that rotates cannot be imported, or comes back as one that translates."""
        self.write("knob.json", network('{ "prony": 1.2, "of": "instantaneous", "terms": [ '
                                        '{ "weight": 0.4, "time": "0.1 s" } ] }', "knob", '"motion": "rotation",'))
        given = form(self, "knob.json")
        for name in FORMATS:
            self.dashpot("export", "knob.json", "--to", name, "-o", f"knob.{name}")
            self.dashpot("import", f"knob.{name}", "--from", name, "-o", f"{name}.json")
            self.expect_close(form(self, f"{name}.json"), given, 1e-12, name)
            self.assertEqual(json.loads((self.folder / f"{name}.json").read_text())["motion"], "rotation")
        self.refused("import", "knob.abaqus", "--from", "abaqus", "--stiffness", "1.2 N m", code="wrong-unit",
                     status=COMMAND_LINE_WRONG)

    def test_remarks_that_contradict_each_other_are_none(self):
        """Fails if a material is given the stiffness of another one that stands before it in the same file."""
        text = ""
        for name, stiffness in (("liver", "1200 N/m"), ("fat", "50 N/m")):
            text += (f"** stiffness: {stiffness}\n*Material, name={name}\n*Viscoelastic, time=PRONY\n0.4, 0., 0.1\n")
        self.write("both.inp", text)
        self.refused("import", "both.inp", "--from", "abaqus", "--material", "fat", code="prony-scale-missing",
                     status=COMMAND_LINE_WRONG)
        self.write("alike.inp", text.replace("1200 N/m", "50 N/m"))
        self.dashpot("import", "alike.inp", "--from", "abaqus", "--material", "fat", "-o", "fat.json")
        self.expect_close(form(self, "fat.json")[0:1], [30], 1e-12, "the same remark of both")

    def test_a_table_of_a_spreadsheet(self):
        """Fails if a byte order mark hides the first column's name, or what the first line says."""
        self.write("sheet.csv", "\ufeffweight,time\n0.4,0.1\n")
        self.dashpot("import", "sheet.csv", "--from", "generic", "--stiffness", "10 N/m", "--of", "instantaneous",
                     "-o", "sheet.json")
        self.expect_close(form(self, "sheet.json"), [6, 0, 4, 10], 1e-12, "sheet")
        self.write("deck.inp", "\ufeff** stiffness: 10 N/m\n*Viscoelastic, time=PRONY\n0.4, 0., 0.1\n")
        self.dashpot("import", "deck.inp", "--from", "abaqus", "-o", "deck.json")
        self.expect_close(form(self, "deck.json"), [6, 0, 4, 10], 1e-12, "deck")

    def test_units_of_the_file(self):
        """Fails if times in milliseconds are taken for seconds, or a modulus for a stiffness."""
        self.write("deck.k", "*MAT_GENERAL_VISCOELASTIC\n7,1e-6,2.19\n,\n120.,0.\n40.,0.01\n")
        self.dashpot("import", "deck.k", "--from", "ls-dyna", "--modulus", "24 mN/m", "--time-unit", "ms", "--name",
                     "fat",
                     "-o", "fat.json")
        self.expect_close(form(self, "fat.json"), [120 * 0.024, 0, 40 * 0.024, 10], 1e-12, "fat")

    def test_what_is_missing_is_asked_for(self):
        """Fails if a guess takes the place of what no file says, or a half-read file is written."""
        self.write("deck.inp", "*Viscoelastic, time=PRONY\n0.4, 0., 0.1\n")
        asked = self.refused("import", "deck.inp", "--from", "abaqus", "-o", "x.json", code="prony-scale-missing",
                             status=COMMAND_LINE_WRONG)
        self.assertIn('--stiffness "1.2 kN/m"', asked.stderr)
        self.write("table.csv", "weight,time\n0.4,0.1\n")
        self.refused("import", "table.csv", "--from", "generic", "--stiffness", "1 N/m",
                     code="prony-convention-missing")
        self.refused("import", "deck.inp", "--from", "abaqus", "--stiffness", "5 N", code="wrong-unit",
                     status=COMMAND_LINE_WRONG)
        self.dashpot("import", "deck.inp", "--from", "nastran", status=COMMAND_LINE_WRONG)
        self.write("active.inp", "*Viscoelastic, time=PRONY\n0.7, 0., 0.1\n0.4, 0., 1.\n")
        active = self.refused("import", "active.inp", "--from", "abaqus", "--stiffness", "1 N/m", "-o", "x.json",
                              code="prony-sum-above-one")
        self.assertIn("the nearest passive series", active.stderr)
        self.assertNotIn("x.json", self.files())

    def test_what_is_no_series_is_not_exported(self):
        """Fails if a damper at the tool, a slip or a contact is left out without a message."""
        for text in (KELVIN, network('{ "spring": 3 }'),
                     network('{ "series": [ { "slip": 1 }, { "spring": 3 } ] }'),
                     network('{ "series": [ { "damper": 1 }, { "spring": 3 } ] }', more='"contact": { "at": 0 },')):
            self.write("network.json", text)
            self.refused("export", "network.json", "--to", "abaqus", "-o", "deck.inp", code="not-exported")
            self.assertEqual(self.files(), ["network.json"])

    def test_more_terms_than_the_program_holds(self):
        """Fails if terms are written that the other program has no place for, or a series that just fits is refused."""
        for format, solid, most in (("febio", True, 6), ("ls-dyna", True, 17), ("ls-dyna", False, 18)):
            for count in (most, most + 1):
                branches = ", ".join(f'{{ "series": [ {{ "spring": {10 + i} }}, {{ "damper": {2.0 ** i} }} ] }}'
                                     for i in range(count))
                spring = '{ "spring": 3 }, ' if solid else ""
                self.write("network.json", network(f'{{ "parallel": [ {spring}{branches} ] }}'))
                words = ["export", "network.json", "--to", format, "-o", "deck"]
                if count == most:
                    self.dashpot(*words)
                    (self.folder / "deck").unlink()
                    continue
                told = self.refused(*words, code="prony-too-many-terms").stderr
                self.assertIn(f"a series of {count} terms; a material of {format} holds {most} at most", told)
                self.assertEqual(self.files(), ["network.json"])

    def test_forms(self):
        """Fails if the Maxwell, Kelvin or Prony form of a network is not the same network."""
        given = form(self, FIG_5)
        for name in ("maxwell", "kelvin", "prony"):
            self.write(f"{name}.json", self.dashpot("explain", FIG_5, "--as", name).stdout)
            self.expect_close(form(self, f"{name}.json"), given, 1e-12, name)

    def test_forms_that_there_are_not(self):
        """Fails if a network with slips, or one with a damper at the tool, is exported in a form that it does not
        have."""
        self.write("slip.json", network('{ "series": [ { "slip": 1 }, { "spring": 3 } ] }'))
        self.refused("explain", "slip.json", "--as", "kelvin", code="no-linear-form")
        self.write("kelvin.json", KELVIN)
        self.refused("explain", "kelvin.json", "--as", "prony", code="not-exported", status=INPUT_REFUSED)


if __name__ == "__main__":
    unittest.main()
