"""The page of `dashpot report` for networks of two axes: its maps, read back from the drawing, against closed forms and `explain`."""
import json
import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

DASHPOT = os.environ["DASHPOT"]
SOURCE = pathlib.Path(os.environ["DASHPOT_SOURCE"])
FIELD, BALL, WALL = (SOURCE / f"networks/axes/{name}.json" for name in ["kelvin_field", "soft_ball", "viscous_wall"])
PANTOGRAPH = SOURCE / "runtime/devices/pantograph_2dof.json"


class Map:
    """A drawing of the page, in millimetres."""

    def __init__(self, figure):
        self.title = re.search("<figcaption>(.*?)</figcaption>", figure).group(1)
        self.note = re.search('<p class="note">(.*?)</p>', figure).group(1)
        self.svg = ElementTree.fromstring(re.search("<svg.*</svg>", figure, re.DOTALL).group(0))
        at = lambda name, across: [(float(text.get("x" if across else "y")) - (0 if across else 4), float(text.text.replace("−", "-")))
                                   for text in self.svg.findall("text") if text.get("class") == name]
        frame = float(re.match(r"M[\d.]+ [\d.]+V([\d.]+)", self.of("frame")[0].get("d")).group(1))
        across = [tick for tick, text in zip(at("tick", True), (t for t in self.svg.findall("text") if t.get("class") == "tick"))
                  if abs(float(text.get("y")) - frame - 17) < 0.1]
        up = at("tick y", False)
        self.scale = (across[-1][0] - across[0][0]) / (across[-1][1] - across[0][1])
        self.origin = across[0][0] - self.scale * across[0][1], up[0][0] + self.scale * up[0][1]

    def of(self, name):
        return [one for one in self.svg if one.get("class") == name]

    def place(self, x, y):
        return (x - self.origin[0]) / self.scale, (self.origin[1] - y) / self.scale

    def pieces(self, name):
        """Pairs of ends of all straight lines of a kind."""
        found = []
        for path in self.of(name):
            for x, y, end_x, end_y in re.findall(r"M([\d.-]+) ([\d.-]+)L([\d.-]+) ([\d.-]+)", path.get("d")):
                found.append((self.place(float(x), float(y)), self.place(float(end_x), float(end_y))))
        return found


class AxesReport(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def dashpot(self, *arguments):
        return subprocess.run([DASHPOT, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, check=True, timeout=60).stdout

    def page(self, network, *choices):
        self.dashpot("report", network, *choices, "-o", "page.html")
        return (self.folder / "page.html").read_text()

    def maps(self, page):
        return [Map(figure) for figure in re.findall("<figure>.*?</figure>", page, re.DOTALL)]

    def test_shares(self):
        """Fails if the shades of a map are not the shares that `explain` sums up, or the place of the least is another."""
        for network in (FIELD, WALL):
            told = {one["name"]: one["share"] for one in json.loads(self.dashpot("explain", network, "--device", PANTOGRAPH, "--json"))["candidates"]}
            drawn = [one for one in self.maps(self.page(network, "--device", PANTOGRAPH)) if one.title.startswith("Share of the brakes")]
            self.assertEqual([one.title for one in drawn], ["Share of the brakes, diagonal (chosen)", "Share of the brakes, non-injecting"])
            for one, name in zip(drawn, ("diagonal", "non-injecting")):
                shades = [shade for shade in one.of("shade") if float(shade.get("height")) < 9.5]  # the scale's are 10 high
                area = lambda shade: float(shade.get("width")) - 0.3
                full = max(float(text.text) for text in one.svg.findall("text") if text.get("class") == "tick" and
                           abs(float(text.get("y")) - max(float(t.get("y")) for t in one.svg.findall("text"))) < 0.1)
                mean = full * sum(area(s) * float(s.get("fill-opacity")) / 0.85 for s in shades) / sum(map(area, shades))
                self.assertAlmostEqual(mean, told[name]["mean"], delta=0.025 * full)  # shades are rounded to twentieths
                self.assertEqual(len(one.of("mark")) > 0, told[name]["delay_proof"] < 1)
                dot, = one.of("place")
                for a, b in zip(one.place(float(dot.get("cx")), float(dot.get("cy"))), told[name]["worst_at"]):
                    self.assertAlmostEqual(a, 1e3 * b, delta=0.03)

    def test_the_force_of_a_ball(self):
        """Fails if arrows do not point away from a ball's centre, reach into what is free, or the surface is drawn elsewhere."""
        arm, force, *_ = self.maps(self.page(BALL, "--device", PANTOGRAPH))
        centre, radius = (0, 140), 30
        for drawing in (arm, force):
            pieces = drawing.pieces("surface")
            self.assertGreater(len(pieces), 15)
            for place in sum(map(list, pieces), []):
                self.assertAlmostEqual(math.dist(place, centre), radius, delta=0.1)
        lengths = {}
        for path in force.of("arrow"):
            # A shaft and the two lines of its head; a dot where there is no force.
            for shaft in re.findall(r"M([\d.]+) ([\d.]+)L([\d.]+) ([\d.]+)M[\d. ]+L[\d. ]+M[\d. ]+L[\d. ]+", path.get("d")):
                x, y, end_x, end_y = map(float, shaft)
                start, end = force.place(x, y), force.place(end_x, end_y)
                along, away = ([b - a for a, b in zip(start, end)], [a - c for a, c in zip(start, centre)])
                lengths[start] = math.hypot(*along)
                if lengths[start] < 1: continue  # a tenth of a pixel is too much of it
                self.assertGreater(along[0] * away[0] + along[1] * away[1], 0.99 * math.hypot(*along) * math.hypot(*away))
                self.assertLess(math.dist(start, centre), radius)
        # 200 N/m of depth; the longest stands for what the note says.
        longest = float(re.search(r"longest arrow is ([\d.]+) N", force.note).group(1))
        most = max(lengths.values())
        self.assertGreater(len(lengths), 2)
        for start, length in lengths.items():
            if length > most / 2:
                self.assertAlmostEqual(length / most * longest, 0.2 * (radius - math.dist(start, centre)), delta=0.03 * longest)

    def test_the_arm(self):
        """Fails if links are drawn with other lengths than the arm's, or do not meet in the middle of the workspace."""
        arm = self.maps(self.page(FIELD, "--device", PANTOGRAPH))[0]
        links = arm.pieces("link")
        self.assertEqual([round(math.dist(*link)) for link in links], [63, 75, 63, 75])
        for link in (links[1], links[3]):
            self.assertLess(math.dist(link[1], (0, 95)), 0.2)

    def test_what_it_says(self):
        """Fails if the page hides that nothing is certified, has scripts, or takes a name for markup."""
        page = self.page(BALL, "--device", PANTOGRAPH)
        self.assertIn("<dt>certified</dt><dd>no ", page)
        self.assertEqual(page.count("<p>Not certified, since port &#39;ball&#39;: "), 1)
        self.assertEqual(page.count("<script"), 0)
        self.assertEqual(re.findall(r'(?:src|href)="(?!data:)', page), [])
        self.assertLess(len(page), 200_000)
        net = json.loads(FIELD.read_text()) | {"title": "<b>&", "comment": "of <i>"}
        (self.folder / "net.json").write_text(json.dumps(net))
        page = self.page("net.json")
        self.assertIn("<h1>&lt;b&gt;&amp;</h1>", page)
        self.assertIn("of &lt;i&gt;", page)
        self.assertIn("No device is named", page)
        self.assertNotIn("<figure>", page)
        for device in ("serial", "parallelogram", "cartesian"):
            told = json.loads(PANTOGRAPH.read_text())
            told["kinematics"] |= {"kind": device, "workspace": {"x": ["-20 mm", "20 mm"], "y": ["90 mm", "115 mm"]}}
            told["kinematics"].pop("base")
            if device == "cartesian":
                told["kinematics"].pop("links")
                told["encoders"] = {"resolution": "1 um"}
                told["motors"] = {"max_torque": "5 N"}
                told["brakes"] = [{"along": [1, 0], "kind": "eddy_current", "max_damping": "5 N s/m"}, {"along": [0, 1], "kind": "eddy_current", "max_damping": "5 N s/m"}]
                told["mechanics"] = {"inertia": [["0.1 kg", "0 kg"], ["0 kg", "0.1 kg"]]}
            told.pop("assumed")
            (self.folder / "device.json").write_text(json.dumps(told))
            self.assertEqual(len(self.maps(self.page(FIELD, "--device", "device.json"))), 4)


if __name__ == "__main__":
    unittest.main()
