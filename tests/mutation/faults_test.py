#!/usr/bin/env python3
"""Faults are planted in code alone, every one changes it, and a seed gives the same ones again."""
import pathlib
import sys
import unittest

from faults import drawn, faults_in

ROOT = pathlib.Path(__file__).resolve().parents[2]


def changes(line):
    return [(fault.kind, fault.planted_in(line)) for fault in faults_in("a.cpp", line)]


class Faults(unittest.TestCase):
    # If this fails, a kind of fault is never planted.
    def test_each_kind_is_found(self):
        self.assertIn(("operator", "y = a / b;"), changes("y = a * b;"))
        self.assertIn(("operator", "if (a || b) return;"), changes("if (a && b) return;"))
        self.assertIn(("sign", "y = a - b;"), changes("y = a + b;"))
        self.assertIn(("sign", "return x;"), changes("return -x;"))
        self.assertIn(("sign", "if (there) return;"), changes("if (!there) return;"))
        self.assertIn(("bound", "while (i <= n) step();"), changes("while (i < n) step();"))
        self.assertIn(("bound", "y = std::min(a, b);"), changes("y = std::max(a, b);"))
        self.assertIn(("constant", "y = 3;"), changes("y = 2;"))
        self.assertIn(("constant", "y = 0.75 * x;"), changes("y = 0.5 * x;"))

    # If this fails, faults are planted where no test can see them.
    def test_what_is_no_code_is_left_alone(self):
        for line in ['say("a < b + 2");', "// a < b + 2", "/* a < b + 2 */", "#if A < 2", "template <int N = 2>",
                     "static_assert(N < 2);", "std::vector<int> values;", "const int& a = f(b);", "case 'a':",
                     "x2 = y;"]:
            self.assertEqual(changes(line.replace("= y", "y")), [], line)

    # If this fails, a record cannot be continued, or the kinds are not planted equally often.
    def test_a_seed_gives_the_same_faults_again(self):
        first, again = (list(drawn(ROOT, ["runtime/servo"], 7)) for _ in range(2))
        self.assertEqual(first, again)
        self.assertNotEqual(first, list(drawn(ROOT, ["runtime/servo"], 8)))
        self.assertEqual({fault.kind for fault in first[:4]}, {"bound", "constant", "operator", "sign"})

    # If this fails, "planted" leaves the text as it was, or hits another place.
    def test_every_fault_of_the_project_changes_its_line_alone(self):
        for fault in list(drawn(ROOT, ["compiler", "runtime"], 1))[:500]:
            sound = (ROOT / fault.file).read_text()
            pairs = list(zip(sound.split("\n"), fault.planted_in(sound).split("\n"), strict=True))
            self.assertEqual([i + 1 for i, (a, b) in enumerate(pairs) if a != b], [fault.line], fault)


if __name__ == "__main__":
    sys.exit(unittest.main())
