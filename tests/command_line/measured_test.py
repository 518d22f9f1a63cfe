"""Networks with evidence: what networks/tissues/ says of where its numbers are from, and that fitting again gives
them."""
import json
import re
import shlex
import shutil
import unittest

from dashpot_command import SOURCE, CommandTest

TISSUES = SOURCE / "networks/tissues"
MEASURED = sorted((TISSUES / "measured").glob("*/*.json"))
# A source names one of these: nobody can weigh a number of which it is not known how it came here.
EVIDENCE = ("from the abstract", "from the full text", "from Table", "Fitted by dashpot fit to")
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.])")



def numbers_and_words(text):
    return [float(number) for number in NUMBER.findall(text)], NUMBER.sub("#", text)


class Measured(CommandTest):
    def fit_again(self, network):
        """The network's own command, in a copy of its folder without it."""
        folder = self.folder / network.stem
        shutil.copytree(network.parent, folder, ignore=shutil.ignore_patterns("*.json"))
        words = shlex.split(json.loads(network.read_text())["fit"]["command"])
        self.assertEqual(words[:2], ["dashpot", "fit"])
        self.dashpot(*words[1:], cwd=folder)
        return (folder / network.name).read_text()

    def test_fitting_again_gives_the_file(self):
        """Fails if a network is not what its own command makes of its own recordings; the last of four digits may
        turn."""
        self.assertGreaterEqual(len(MEASURED), 5)
        for network in MEASURED:
            with self.subTest(network.stem):
                numbers, words = numbers_and_words(network.read_text())
                again, same_words = numbers_and_words(self.fit_again(network))
                self.assertEqual(words, same_words)
                for one, other in zip(numbers, again, strict=True):
                    self.assertAlmostEqual(one, other, delta=2e-3 * abs(one))

    def test_fitted_networks_compile(self):
        """Fails if a network that was fitted is refused."""
        for network in MEASURED:
            with self.subTest(network.stem):
                self.dashpot("check", network)
                self.dashpot("compile", network, "-o", ".")

    def test_recordings_have_a_licence(self):
        """Fails if recordings ship without the licence that came with them, or are larger than a fit needs."""
        for folder in {network.parent for network in MEASURED}:
            with self.subTest(folder.name):
                told = (TISSUES / "measured/README.md").read_text()
                self.assertIn(f"`{folder.name}/`", told)
                self.assertTrue(list(folder.glob("LICENSE*")) or "seven numbers" in told and folder.name == "brain")
                self.assertLess(sum(path.stat().st_size for path in folder.iterdir()), 60_000)

    def test_every_tissue_says_how_its_numbers_came(self):
        """Fails if a tissue does not say whether it was read in a table or an abstract, or fitted here."""
        networks = sorted(TISSUES.rglob("*.json"))
        self.assertGreaterEqual(len(networks), 14)
        for network in networks:
            source = json.loads(network.read_text())["source"]
            self.assertTrue(any(words in source for words in EVIDENCE), network)


if __name__ == "__main__":
    unittest.main()
