"""The page of `dashpot report` for networks of two axes: its maps, read back from the drawing, against closed forms and
`explain`."""
import json
import itertools
import math
import os
import pathlib
import re
import struct
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

from browser import Browser

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
        at = lambda name, across: [(float(text.get("x" if across else "y")) - (0 if across else 4),
                                    float(text.text.replace("−", "-")))
                                   for text in self.svg.findall("text") if text.get("class") == name]
        frame = float(re.match(r"M[\d.]+ [\d.]+V([\d.]+)", self.of("frame")[0].get("d")).group(1))
        across = [tick for tick, text in zip(at("tick", True),
                                             (t for t in self.svg.findall("text") if t.get("class") == "tick"))
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


class Pages(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def dashpot(self, *arguments):
        return subprocess.run([DASHPOT, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              check=True, timeout=60).stdout

    def page(self, network, *choices):
        self.dashpot("report", network, *choices, "-o", "page.html")
        return (self.folder / "page.html").read_text()

    def maps(self, page):
        return [Map(figure) for figure in re.findall("<figure>.*?</figure>", page, re.DOTALL)]


class AxesReport(Pages):
    def test_shares(self):
        """Fails if the shades of a map are not the shares that `explain` sums up, or the place of the least is
        another."""
        for network in (FIELD, WALL):
            told = {one["name"]: one["share"]
                    for one in json.loads(self.dashpot("explain", network, "--device", PANTOGRAPH,
                                                       "--json"))["candidates"]}
            drawn = [one for one in self.maps(self.page(network, "--device", PANTOGRAPH))
                     if one.title.startswith("Share of the brakes")]
            self.assertEqual([one.title for one in drawn],
                             ["Share of the brakes, diagonal (chosen)", "Share of the brakes, non-injecting"])
            for one, name in zip(drawn, ("diagonal", "non-injecting")):
                # the scale's are 10 high
                shades = [shade for shade in one.of("shade") if float(shade.get("height")) < 9.5]
                area = lambda shade: float(shade.get("width")) - 0.3
                full = max(float(text.text) for text in one.svg.findall("text") if text.get("class") == "tick" and
                           abs(float(text.get("y")) - max(float(t.get("y")) for t in one.svg.findall("text"))) < 0.1)
                mean = full * sum(area(s) * float(s.get("fill-opacity")) / 0.85
                                  for s in shades) / sum(map(area, shades))
                self.assertAlmostEqual(mean, told[name]["mean"], delta=0.025 * full)  # shades are rounded to twentieths
                self.assertEqual(len(one.of("mark")) > 0, told[name]["delay_proof"] < 1)
                dot, = one.of("place")
                for a, b in zip(one.place(float(dot.get("cx")), float(dot.get("cy"))), told[name]["worst_at"]):
                    self.assertAlmostEqual(a, 1e3 * b, delta=0.03)

    def test_the_force_of_a_ball(self):
        """Fails if arrows do not point away from a ball's centre, reach into what is free, or the surface is drawn
        elsewhere."""
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
            for shaft in re.findall(r"M([\d.]+) ([\d.]+)L([\d.]+) ([\d.]+)M[\d. ]+L[\d. ]+M[\d. ]+L[\d. ]+",
                                    path.get("d")):
                x, y, end_x, end_y = map(float, shaft)
                start, end = force.place(x, y), force.place(end_x, end_y)
                along, away = ([b - a for a, b in zip(start, end)], [a - c for a, c in zip(start, centre)])
                lengths[start] = math.hypot(*along)
                if lengths[start] < 1: continue  # a tenth of a pixel is too much of it
                self.assertGreater(along[0] * away[0] + along[1] * away[1],
                                   0.99 * math.hypot(*along) * math.hypot(*away))
                self.assertLess(math.dist(start, centre), radius)
        # 200 N/m of depth; the longest stands for what the note says.
        longest = float(re.search(r"longest arrow is ([\d.]+) N", force.note).group(1))
        most = max(lengths.values())
        self.assertGreater(len(lengths), 2)
        for start, length in lengths.items():
            if length > most / 2:
                self.assertAlmostEqual(length / most * longest, 0.2 * (radius - math.dist(start, centre)),
                                       delta=0.03 * longest)

    def test_the_arm(self):
        """Fails if links are drawn with other lengths than the arm's, or do not meet in the middle of the workspace, or
        the page leaves out what the encoders' steps bring in."""
        page = self.page(FIELD, "--device", PANTOGRAPH)
        self.assertIn("<p>Encoder steps: in what the motors make they come to no more than ", page)  # as `explain` says
        arm = self.maps(page)[0]
        links = arm.pieces("link")
        self.assertEqual([round(math.dist(*link)) for link in links], [63, 75, 63, 75])
        for link in (links[1], links[3]):
            self.assertLess(math.dist(link[1], (0, 95)), 0.2)

    def test_what_it_says(self):
        """Fails if the page hides that nothing is certified, asks for anything, or takes a name for markup."""
        page = self.page(BALL, "--device", PANTOGRAPH)
        self.assertIn("<dt>certified</dt><dd>no ", page)
        self.assertEqual(page.count("<p>Not certified, since port &#39;ball&#39;: "), 1)
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
                told["brakes"] = [{"along": [1, 0], "kind": "eddy_current", "max_damping": "5 N s/m"},
                                  {"along": [0, 1], "kind": "eddy_current", "max_damping": "5 N s/m"}]
                told["mechanics"] = {"inertia": [["0.1 kg", "0 kg"], ["0 kg", "0.1 kg"]]}
            told.pop("assumed")
            (self.folder / "device.json").write_text(json.dumps(told))
            self.assertEqual(len(self.maps(self.page(FIELD, "--device", "device.json"))), 5)

    def test_without_a_compiler_or_a_device(self):
        """Fails if a page that cannot run the law has scripts, or does not say why it cannot."""
        os.environ["DASHPOT_CLANG"] = "/nowhere/clang"
        self.addCleanup(os.environ.pop, "DASHPOT_CLANG")
        for choices, reasons in ((("--device", PANTOGRAPH), 1), ((), 0)):
            page = self.page(FIELD, *choices)
            self.assertEqual(page.count("<script"), 0)
            self.assertEqual(page.count("no clang with lld"), reasons)


# The law in the page, over rows of joint positions and velocities.
STEPPED = """
  const [rows] = arguments, bytes = Uint8Array.from(atob(data.drag.module), (c) => c.charCodeAt(0));
  return WebAssembly.instantiate(bytes).then(({ instance: { exports: law } }) => {
    law.reset(0, 0);
    return rows.map((row) => {
      law.step(...row);
      return [...data.drag.brakes.map((_, k) => law.damping(k)), law.torque(0), law.torque(1)];
    });
  });"""
# Where the tool is drawn, and its map's middle, in pixels of the window.
TOOL = """
  const tool = document.querySelector('#drag .tool').getBoundingClientRect(),
        map = document.querySelector('#drag svg').getBoundingClientRect();
  return [tool.x + tool.width / 2 - map.x - map.width / 2, tool.y + tool.height / 2 - map.y - map.height / 2];"""
# The tip as it is drawn, in metres.
TIP = """
  const tool = document.querySelector('#drag .tool'), { x, y, metre } = data.drag.frame;
  return [(tool.getAttribute('cx') - x) / metre, (y - tool.getAttribute('cy')) / metre];"""
WORKSPACE = {"x": ["-40 mm", "40 mm"], "y": ["70 mm", "120 mm"]}
FOUR_ARMS = {"serial": {"links": ["80 mm", "75 mm"]}, "parallelogram": {"links": ["80 mm", "75 mm"]},
             "five_bar": {"links": ["63 mm", "75 mm"], "base": "25 mm"}, "cartesian": {}}


def ideal_device(kind, kinematics):
    """An arm of that kind with brakes at its joints and no imperfection."""
    turns = kind != "cartesian"
    return {"dashpot_device": 1, "axes": 2, "name": "arm",
            "kinematics": {"kind": kind, **kinematics, "workspace": WORKSPACE},
            "loop": {"rate": "2 kHz"}, "velocity": {"estimator": "backward_difference", "window": 1}, "motors": {},
            "brakes": [{"along": direction, "kind": "eddy_current", "max_damping": "50 mN m s/rad" if turns
                        else "50 N s/m"}
                       for direction in ([1, 0], [0, 1])],
            "mechanics": {"link_masses": ["20 g", "15 g"], "damping": "10 mN m s/rad"} if turns else
                         {"inertia": [["0.1 kg", "0 kg"], ["0 kg", "0.1 kg"]], "damping": "20 N s/m"}}


class Dragged(Pages):
    """The page in a browser."""

    @classmethod
    def setUpClass(cls):
        cls.browser = cls.enterClassContext(Browser())

    def open(self, network, device, *choices):
        self.page(network, "--device", device, *choices)
        self.browser.open(self.folder / "page.html")
        self.wait_for(lambda: self.browser.run("return document.getElementById('felt-stored')?.textContent ?? ''"))

    def wait_for(self, what):
        for _ in range(400):
            if what(): return
        self.fail("the page does not come to rest")

    def number(self, name):
        """What the page says, as it rounds it."""
        text = self.browser.run(f"return document.getElementById('felt-{name}').textContent").replace("−", "-")
        text = re.sub("^(-?)10(?=[⁻⁰¹²³⁴⁵⁶⁷⁸⁹])", r"\g<1>1×10", text)  # 10⁻⁴ stands without its 1
        mantissa, _, power = text.partition("×10")
        return float(mantissa) * 10.0 ** int(power.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")) or 0)

    def drag(self, ways):
        """The tool by so many pixels, one way after the other, until it rests."""
        x, y = self.browser.run(TOOL)
        places = [(round(x + a), round(y + b))
                  for a, b in itertools.accumulate([(0, 0), *ways], lambda p, q: (p[0] + q[0], p[1] + q[1]))]
        before = self.browser.run(TIP)
        self.browser.drag("#drag svg", places)
        self.wait_for_rest(before)

    def wait_for_rest(self, before):
        """Somewhere else than before."""
        self.wait_for(lambda: self.browser.run(TIP) != before and self.number("speed") == 0)

    def assert_feels_the_field(self):
        """The springs of FIELD, 100 N/m about (0, 100 mm), by the three digits that are shown."""
        x, y = self.browser.run(TIP)
        for shown, wanted in (("force", 100 * math.hypot(x, y - 0.1)), ("stored", 50e3 * (x ** 2 + (y - 0.1) ** 2))):
            self.assertAlmostEqual(self.number(shown), wanted, delta=5.1e-3 * wanted + 1e-9)

    def test_the_tool_feels_the_network(self):
        """Fails if the tool does not follow, a held tip feels another force than the field's springs make, or energy is
        lost."""
        self.open(FIELD, PANTOGRAPH)
        start = self.browser.run(TIP)
        stored = self.number("stored")
        for ways in ([(0, 25)], [(40, -10), (-90, 0)], [(20, 15), (0, -30)]):
            self.drag(ways)
            self.assert_feels_the_field()
        self.assertGreater(math.dist(start, self.browser.run(TIP)), 0.003)
        hand, heat, given = map(self.number, ("hand", "heat", "given"))
        self.assertAlmostEqual(hand, heat - given, delta=5.1e-3 * (hand + heat + abs(given)))
        self.assertGreater(hand, self.number("stored") - stored)  # the field's damper took the rest
        self.browser.click("#start-over")
        self.assertEqual([self.number(name) for name in ("hand", "heat", "given")], [0, 0, 0])
        self.assertEqual((self.browser.log("browser"), self.browser.requested()), ([], []))

    def test_small_numbers_stay_whole(self):
        """Fails if a number beside the map is broken between its digits, or runs out of its column: 10⁻¹¹ in two lines
        is 10⁻¹ with a 1 below it."""
        network = self.folder / "weak.json"
        network.write_text(FIELD.read_text().replace("100 N/m", "5e-8 N/m"))
        self.open(network, PANTOGRAPH)
        shown = self.browser.run("""
          return [...document.querySelectorAll('#felt dd')].map((dd) => {
            const number = dd.querySelector('span');
            const [line, ...others] = number.getClientRects();
            return [number.textContent, others.length, line.right - dd.getBoundingClientRect().right];
          });""")
        self.assertTrue(any(re.fullmatch("−[0-9.]{4}×10⁻¹[⁰¹²]", text) for text, *_ in shown), shown)
        for text, more_lines, beyond in shown:
            self.assertEqual(more_lines, 0, text)
            self.assertLessEqual(beyond, 0, text)

    def test_the_law_is_what_simulate_runs(self):
        """Fails if the page's law is another one, in either type of numbers, of a ball, a contact that damps, or a
        field."""
        rows = []
        for k in range(300):
            q = [2.1 + 0.2 * math.sin(0.05 * k), 1.0 + 0.2 * math.cos(0.03 * k)]
            rows.append([*q, *((a - b) * 1e4 for a, b in zip(q, rows[-1][:2] if rows else q))])
        (self.folder / "motion.csv").write_text("time,q1,q2,v1,v2\n" + "".join(
            f"{k / 1e4!r}," + ",".join(map(repr, row)) + "\n" for k, row in enumerate(rows)))
        for network, scalar in ((FIELD, "double"), (BALL, "float"), (WALL, "double")):
            self.open(network, PANTOGRAPH, "--scalar", scalar)
            lines = self.dashpot("simulate", network, "--device", PANTOGRAPH, "--scalar", scalar, "--input",
                                 "motion.csv").splitlines()
            kind = {"double": "d", "float": "f"}[scalar]
            names = lines[0].split(",")
            wanted = [names.index(name) for name in names if name.startswith(("damping", "torque"))]
            pack = lambda value: struct.pack(kind, value + 0.0)  # on its way from the page −0 becomes 0
            told = [[pack(float(line.split(",")[i])) for i in wanted] for line in lines[1:]]
            self.assertEqual([[pack(value) for value in row] for row in self.browser.run(STEPPED, rows)], told)

    def test_every_arm(self):
        """Fails if the page's own kinematics of an arm are not the law's: a held tip would feel another force."""
        for kind, kinematics in FOUR_ARMS.items():
            with self.subTest(kind=kind):
                (self.folder / "arm.json").write_text(json.dumps(ideal_device(kind, kinematics)))
                self.open(FIELD, "arm.json")
                self.drag([(12, 9)])
                before = self.browser.run(TIP)
                self.browser.run("document.querySelector('#drag svg').focus()")
                self.browser.type("#drag svg", "\ue012\ue013")  # left, up
                self.wait_for_rest(before)
                self.assert_feels_the_field()


if __name__ == "__main__":
    unittest.main()
