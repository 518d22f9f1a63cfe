#!/usr/bin/env python3
"""Every sentence about safety, where it stands, and the test that holds it: the table in tests/realtime/README.md."""
import argparse
import glob
import os
import re
import unittest

ARGUMENTS = None


def read(*path):
    with open(os.path.join(ARGUMENTS.root, *path), encoding="utf-8") as stream:
        return stream.read()


def plain(text):
    """On one line, without the marks of a comment."""
    return " ".join(re.sub(r"^\s*(//|\*(?!\*)) ?", "", line) for line in text.splitlines()).replace("  ", " ")


def squeezed(text):
    return re.sub(r"\s+", " ", plain(text)).strip()


def rows():
    for line in read("tests", "realtime", "README.md").splitlines():
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if len(cells) == 3 and cells[0] not in ("sentence", "---"):
            yield cells[0], cells[1].strip("`"), re.findall(r"`([^`]+)`", cells[2])


def tests():
    found = set()
    for path in glob.glob(os.path.join(ARGUMENTS.root, "tests", "**", "*"), recursive=True):
        if path.endswith(".cpp"):
            with open(path, encoding="utf-8") as stream:
                found |= {".".join(names) for names in re.findall(r"^TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)",
                                                                  stream.read(), re.M)}
        elif path.endswith("_test.py"):
            with open(path, encoding="utf-8") as stream:
                found |= set(re.findall(r"def (test_\w+)", stream.read()))
    return found


class Promises(unittest.TestCase):
    def test_every_sentence_stands_where_it_is_said_to(self):
        """Fails if a promise is changed without a look at the tests that hold it."""
        for sentence, page, _ in rows():
            with self.subTest(sentence=sentence):
                self.assertIn(squeezed(sentence), squeezed(read(page)), page)

    def test_every_test_exists(self):
        """Fails if a test that holds a promise is taken away or called otherwise."""
        known = tests()
        self.assertGreater(len(list(rows())), 20)
        for sentence, _, names in rows():
            with self.subTest(sentence=sentence):
                self.assertTrue(names)
                self.assertEqual(set(names) - known, set())

    def test_no_sentence_about_safety_is_left_out(self):
        """Fails if a README promises that something is safe, stops or goes safe, and no test is named for it."""
        said = [squeezed(sentence) for sentence, _, _ in rows()]
        for point in re.findall(r"^\* (.*?)(?=^\* |^$)", read("runtime", "README.md").split("## What the loop does")[1],
                                re.M | re.S):
            with self.subTest(point=squeezed(point)[:60]):
                self.assertTrue(any(sentence in squeezed(point) for sentence in said))


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", required=True)
    ARGUMENTS, rest = parser.parse_known_args()
    unittest.main(argv=["promises_test.py", *rest])
