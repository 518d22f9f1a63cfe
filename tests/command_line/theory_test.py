"""The theorem behind the storage functions of sampled loops, in Coq, and instances of it: `compile --proof`."""
import json
import os
import re
import subprocess
import unittest

from dashpot_command import COMMAND_LINE_WRONG, FIG_5, PANTOGRAPH, SOURCE, CommandTest

THEORY = SOURCE / "compiler/certify/proof"
IS_LONG = os.environ.get("DASHPOT_LONG") == "1"
# Without lag by both inputs of the states, with delay, lag and filter, behind a lag for holds of many lengths, and of
# commands that act later than their samples.
LAWS = [[FIG_5], [SOURCE / "networks/paper/bridge.json", "--state-input", "velocity"],
        [FIG_5, "--device", "punctual.json"],
        [SOURCE / "networks/paper/kelvin.json", "--device", "late.json"], [FIG_5, "--device", "writing.json"]]
# Of Coq's real numbers, and no others.
AXIOMS = {"ClassicalDedekindReals.sig_forall_dec", "ClassicalDedekindReals.sig_not_dec",
          "FunctionalExtensionality.functional_extensionality_dep"}
# The library of integrals uses the excluded middle as well.
INTEGRALS = AXIOMS | {"Classical_Prop.classic"}
THEOREMS = {
    "Loop": ["nothing_is_extracted", "sound_if_accepted"],
    "Slips": ["nothing_is_extracted", "nothing_is_extracted_when_late", "relaxing_holds", "relaxing_follows",
              "at_once_holds",
              "at_once_follows", "behind_holds", "behind_follows", "elements_take_in", "slip_takes_in",
              "sliding_holds"],
    "Clamp": ["nothing_is_extracted_from_a_clipped_force", "clips_at_limit"]}
ON_INTEGRALS = {"Hold": ["lagging_hold", "least_dissipation_of_shorter_holds"]}


class TheoryTest(CommandTest):
    def coqc(self, name, text, accepted=True):
        self.write(name, text)
        done = subprocess.run(["coqc", "-R", ".", "Dashpot", name], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode == 0, accepted, done.stdout[-2000:] + done.stderr[-2000:])
        return done.stdout

    def assert_no_more_axioms(self, printed, axioms):
        found = set(re.findall(r"^([\w.']+)\s*(?::|$)", printed, re.M)) - {"Axioms"}
        self.assertTrue(found)
        self.assertLessEqual(found, axioms)

    # If this failed, the theorem would not be proved, or rest on more than it is said to; a law's instance would not be
    # accepted, or one with a hundred-thousandth less damping would be.
    def test_theory_and_instances(self):
        for name in ("Forms.v", "Loop.v", "Hold.v", "Sums.v", "Slips.v", "Clamp.v"):
            self.coqc(name, (THEORY / name).read_text())
        for name, theorems, axioms in (("Theorems.v", THEOREMS, AXIOMS), ("Integrals.v", ON_INTEGRALS, INTEGRALS)):
            # What several rest on is what their tuple rests on: Coq then goes through its library once.
            named = ", ".join(f"@{file}.{theorem}" for file, names in theorems.items() for theorem in names)
            printed = self.coqc(name, f"Require {' '.join(theorems)}.\nDefinition all := ({named}).\n"
                                      "Print Assumptions all.\n")
            self.assertEqual(len(re.findall("^Axioms:$", printed, re.M)), 1)
            self.assert_no_more_axioms(printed, axioms)
        device = json.loads(PANTOGRAPH.read_text())
        late = device | {"velocity": {"estimator": "backward_difference", "window": 1}}
        self.write("late.json", json.dumps(late | {"loop": device["loop"] | {"delay_samples": 0}}))
        self.write("punctual.json", json.dumps(device | {"loop": device["loop"] | {"jitter": "0 s"}}))
        writing = device | {"loop": device["loop"] | {"write_delay": ["5 us", "30 us"]}, "motor": dict(device["motor"])}
        del writing["motor"]["amplifier_lag"]
        self.write("writing.json",
                   json.dumps(writing |
                              {"assumed": [key for key in device["assumed"] if key != "motor.amplifier_lag"]}))
        for number, law in enumerate(LAWS):
            with self.subTest(law=law):
                self.dashpot("compile", *law, "--proof", "law.v")
                text = (self.folder / "law.v").read_text()
                # Of the six parts that the holds are taken in, those of which least is asked are one here.
                self.assertEqual(text.count("gamma :="), 2 if "late.json" in law else 1)
                self.assert_no_more_axioms(self.coqc(f"Law{number}.v", text), AXIOMS)
                if number not in ((0, len(LAWS) - 1) if IS_LONG else (0,)): continue
                lowered = re.sub(r"beta := 0x([0-9a-f]+)", lambda beta: f"beta := {int(beta[1], 16) * 99999 // 100000}",
                                 text)
                self.assertNotEqual(lowered, text)
                self.coqc("Lowered.v", lowered, accepted=False)

    # If this failed, a law without a storage function would leave an empty proof behind.
    def test_nothing_to_prove(self):
        refused = self.refused("compile", SOURCE / "networks/paper/visco_elasto_plastic.json", "--proof", "law.v",
                               code="no-storage-function")
        self.assertIn("note: it has the slip '", refused.stderr)
        self.refused("compile", FIG_5, SOURCE / "networks/paper/kelvin.json", "--proof", "law.v",
                     code="certificate-of-several", status=COMMAND_LINE_WRONG)
        self.assertEqual(self.files(), [])
        device = json.loads(PANTOGRAPH.read_text())
        device["velocity"] = {"estimator": "foaw", "window": 8}
        device["motor"].pop("amplifier_lag")
        device["assumed"].remove("motor.amplifier_lag")
        adaptive = self.write("adaptive.json", json.dumps(device))
        self.refused("compile", FIG_5, "--device", adaptive, "--uncertified", "--decomposition", "paper", "--proof",
                     "law.v",
                     code="no-storage-function")


if __name__ == "__main__":
    unittest.main()
