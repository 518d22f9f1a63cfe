"""Every section of compiler/theory.md and compiler/architecture.md that a source cites is there."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = {"theory": ROOT / "compiler/theory.md", "architecture": ROOT / "compiler/architecture.md"}
SUFFIXES = {".cpp", ".hpp", ".def", ".py", ".in", ".js"}
# "theory, section 6a", "theory's", "theory, sections 3 and 4", 'theory, section 5, "Not a tree"', over the end of a
# line too.
CITED = re.compile(r"\b(theory|architecture)(?:\.md)?(?:['’]s)?,?\s(?:sections?\s)?(\d[a-c]?(?:\([a-c]\))?)"
                   r"(?:\sand\s(\d[a-c]?))?(?:,\s\"([^\"]+)\")?", re.IGNORECASE)
LINE_ENDS = re.compile(r"\n\s*(?://|#|\*)?\s*")


def citations(text):
    """(page, section, title or None) of each citation."""
    for page, first, second, title in CITED.findall(LINE_ENDS.sub(" ", text)):
        yield page.lower(), re.sub(r"[()]", "", first), title or None
        if second:
            yield page.lower(), second, title or None


def sections(text):
    """Titles within each section: '6' has all of its own, '6a' those of its part."""
    found, number, part = {}, None, None
    for line in text.split("\n"):
        if heading := re.match(r"## (\d+)\. ", line):
            number, part = heading[1], None
            found[number] = set()
        elif heading := re.match(r"### \(([a-c])\) ", line):
            part = number + heading[1]
            found[part] = set()
        elif title := re.match(r"\*\*(.+?)[.:*]", line):
            for section in {number, part} - {None}:
                found[section].add(title[1])
    return found


class References(unittest.TestCase):
    # Fails if a comment sends its reader to a section, or to a paragraph of one, that there is not.
    def test_sections(self):
        known = {page: sections(path.read_text()) for page, path in PAGES.items()}
        wrong, count = [], 0
        for folder in ("compiler", "runtime", "templates", "tests"):
            for path in sorted((ROOT / folder).rglob("*")):
                if path.suffix not in SUFFIXES or path.name == pathlib.Path(__file__).name:
                    continue
                for page, section, title in citations(path.read_text()):
                    count += 1
                    titles = known[page].get(section)
                    if titles is None or (title is not None and title not in titles):
                        wrong.append(f"{path.relative_to(ROOT)}: {page}, section {section}" +
                                     (f', "{title}"' if title else ""))
        self.assertEqual(wrong, [])
        self.assertGreater(count, 60)

    # Fails if a citation is passed over because of how it is written.
    def test_what_a_citation_is(self):
        text = ('// (theory, section\n// 5, "Not a tree") and theory, sections 3 and 4; theory 6a: x; (theory.md, '
                'section 6(c));\n'
                "// Theory, section 5: rigid; theory section 2; architecture, section 3\n")
        self.assertEqual(list(citations(text)), [
            ("theory", "5", "Not a tree"), ("theory", "3", None), ("theory", "4", None), ("theory", "6a", None),
            ("theory", "6c", None), ("theory", "5", None), ("theory", "2", None), ("architecture", "3", None)])


if __name__ == "__main__":
    unittest.main()
