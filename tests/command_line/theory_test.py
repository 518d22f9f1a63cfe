"""The theorem behind the storage functions of sampled loops, in Coq."""
import re
import subprocess
import unittest

from dashpot_command import SOURCE, CommandTest

THEORY = SOURCE / "compiler/certify/proof"
# Of Coq's real numbers, and no others.
AXIOMS = {"ClassicalDedekindReals.sig_forall_dec", "ClassicalDedekindReals.sig_not_dec",
          "FunctionalExtensionality.functional_extensionality_dep"}
# The library of integrals uses the excluded middle as well.
INTEGRALS = AXIOMS | {"Classical_Prop.classic"}
CERTIFICATES = "Require Import Loop.\nPrint Assumptions nothing_is_extracted.\nPrint Assumptions sound_if_accepted.\n"
HOLDS = "Require Import Hold.\nPrint Assumptions lagging_hold.\nPrint Assumptions least_dissipation_of_shorter_holds.\n"


class TheoryTest(CommandTest):
    def coqc(self, name, text, accepted=True):
        self.write(name, text)
        done = subprocess.run(["coqc", "-R", ".", "Dashpot", name], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode == 0, accepted, done.stdout[-2000:] + done.stderr[-2000:])
        return done.stdout

    def assert_no_more_axioms(self, printed, axioms):
        found = set(re.findall(r"^([A-Za-z_.]+)\s*(?::|$)", printed, re.M)) - {"Axioms"}
        self.assertTrue(found)
        self.assertLessEqual(found, axioms)

    # The theorem would not be proved, or rest on more than it is said to.
    def test_theory(self):
        for name in ("Forms.v", "Loop.v", "Hold.v"):
            self.coqc(name, (THEORY / name).read_text())
        self.assert_no_more_axioms(self.coqc("Certificates.v", CERTIFICATES), AXIOMS)
        self.assert_no_more_axioms(self.coqc("Holds.v", HOLDS), INTEGRALS)


if __name__ == "__main__":
    unittest.main()
