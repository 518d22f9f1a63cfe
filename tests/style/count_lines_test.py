"""What count_lines.py takes for code and for a condition."""
import unittest

import count_lines


class CountLines(unittest.TestCase):
    # Fails if comments, blanks or the lines of a raw string count as code.
    def test_code(self):
        text = 'int a;  // if (tunable)\n\n// b\n/* c\n   d */\nint e = f(R"(\n  contact\n)");\n'
        self.assertEqual([line for _, line in count_lines.code_lines(text)], ["int a;", 'int e = f(""', ");"])

    # Fails if a line is told by its number in a file that has comments and strings of several lines.
    def test_numbers(self):
        text = '/* one\n   two */\nconst char* s = R"(\n)";\nif (law.tunable) return;\n'
        self.assertEqual([(number, line) for _, number, line in count_lines.deciding_lines({"a.cpp": text}, "tunable")],
                         [(5, "if (law.tunable) return;")])

    # Fails if a name in a string, or a name without a condition, counts as a decision, or if a real one does not.
    def test_conditions(self):
        deciding = ["if (network.contact) {", "return law.surface_at ? a : b;", "ok && touched()",
                    "std::get_if<Contact>(&part)"]
        others = ['if (name == "contact") {', "law.contact = surface;", "// if it touches a surface", "if (is_open) {"]
        files = {"a.cpp": "\n".join(deciding + others)}
        self.assertEqual([line for _, _, line in count_lines.deciding_lines(files, "contact")], deciding)


if __name__ == "__main__":
    unittest.main()
