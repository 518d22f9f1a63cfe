"""The checker in Coq (compiler/certify/proof/Loop.v) and the one in C++ (compiler/check/) on the same inequalities.

An instance of random laws on random devices carries the witnesses that Coq asks for; C++ finds its own. Where C++ does
not prove a damping there is nothing to be found, and Coq is asked with the witnesses of the damping that is enough. The
environment names WRITE_INSTANCES and DASHPOT_SOURCE; DASHPOT_LONG=1 takes 2,000 inequalities.
"""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

THEORY = pathlib.Path(os.environ["DASHPOT_SOURCE"]) / "compiler/certify/proof"
LAWS, MOST_STATES = (667, 6) if os.environ.get("DASHPOT_LONG") == "1" else (6, 4)
HEAD = "Require Import ZArith List Forms Loop.\nImport ListNotations.\nLocal Open Scope Z_scope.\n"
AT_ONCE = 30


class CheckersAgree(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def coqc(self, name, text):
        (self.folder / name).write_text(text)
        done = subprocess.run(["coqc", "-R", ".", "Dashpot", name], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])
        return done.stdout

    def definitions(self, number):
        text = (self.folder / f"{number}.v").read_text()
        return text[text.index("Definition recursion"):text.index("Theorem law_is_sound")]

    def test_same_verdicts(self):
        """Fails if one of the two checkers accepts what the other refuses."""
        told = subprocess.run([os.environ["WRITE_INSTANCES"], str(LAWS), str(MOST_STATES), self.folder],
                              check=True, capture_output=True, text=True).stdout
        asked = []
        for line in told.splitlines():
            number, whole, share, proved, written = line.split()
            self.assertEqual(proved, written, f"instance {number}, a share of {share}")
            text = self.definitions(number if proved == "1" else whole)
            if proved == "0":
                text = re.sub(r"(beta|gamma) := 0x([0-9a-f]+)",
                              lambda m: f"{m[1]} := {int(int(m[2], 16) * float(share))}", text)
            asked.append((number, share, proved == "1", text))
        for name in ("Forms.v", "Loop.v"):
            self.coqc(name, (THEORY / name).read_text())
        for begin in range(0, len(asked), AT_ONCE):
            some = asked[begin:begin + AT_ONCE]
            modules = [f"Module C{number}.\n{text}End C{number}.\nEval vm_compute in accepts C{number}.law "
                       f"C{number}.leading C{number}.of_P C{number}.of_parts.\n"
                       for number, _, _, text in some]
            verdicts = re.findall(r"= (true|false)", self.coqc("Cases.v", HEAD + "".join(modules)))
            self.assertEqual(len(verdicts), len(some))
            for (number, share, proved, _), verdict in zip(some, verdicts):
                self.assertEqual(verdict == "true", proved, f"instance {number}, a share of {share}")
        proved = sum(case[2] for case in asked)
        self.assertGreaterEqual(min(proved, len(asked) - proved), len(asked) // 5)
        print(f"{len(asked)} inequalities, {proved} of them proved by both")


if __name__ == "__main__":
    unittest.main()
