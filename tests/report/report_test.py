"""Clicks through the pages that `dashpot report` writes.

The environment names what ctest knows: DASHPOT (the executable) and DASHPOT_SOURCE (this repository).
"""
import csv
import io
import itertools
import json
import math
import os
import pathlib
import re
import struct
import subprocess
import tempfile
import unittest

from browser import Browser

DASHPOT = os.environ["DASHPOT"]
SOURCE = pathlib.Path(os.environ["DASHPOT_SOURCE"])
# a page is of one axis
NETWORKS = sorted(path for path in SOURCE.glob("networks/*/*.json") if path.parent.name != "axes")
IS_LONG = os.environ.get("DASHPOT_LONG") == "1"
TUNABLE = sorted(SOURCE.glob("networks/tunable/*.json"))
FIG_5 = SOURCE / "networks/paper/second_order_maxwell.json"
PANTOGRAPH = SOURCE / "runtime/devices/pantograph_brake_2009.json"
MOST_BYTES = 300_000

FIG_10 = """{ "dashpot": 1, "name": "fig_10", "title": "Spring before a slip beside a damper", "network": { "parallel": [
    { "damper": "2 N s/m", "name": "B1" },
    { "series": [ { "spring": "200 N/m", "name": "K" },
                  { "parallel": [ { "slip": "0.3 N", "name": "Y" }, { "damper": "5 N s/m", "name": "B2" } ] } ] } ] } }"""
BEHIND = """{ "dashpot": 1, "name": "behind", "contact": { "at": "5 mm" }, "comment": "Made to be looked at.",
    "network": { "parallel": [ { "spring": "50 N/m", "name": "K0", "comment": [ "Stiff <b>", "and steady" ] },
                               { "series": [ { "spring": "200 N/m", "name": "K1" }, { "slip": "0.2 N", "name": "Y1" } ] } ] } }"""
RING = "networks/tunable/layers_tunable.json"
COUPLED = """{ "dashpot": 1, "name": "coupled", "network": { "parallel": [
    { "spring": "50 N/m", "name": "K0" },
    { "series": [ { "spring": "200 N/m", "name": "K1" },
                  { "parallel": [ { "slip": "0.2 N", "name": "Y1" }, { "damper": "3 N s/m", "name": "B1" } ] },
                  { "parallel": [ { "slip": "0.3 N", "name": "Y2" }, { "spring": "80 N/m", "name": "K2" } ] } ] } ] } }"""
HOSTILE = """{ "dashpot": 1, "name": "hostile", "title": "</title><script>document.title='taken'</script>&amp;",
    "source": "\\"><img src=x onerror=alert(1)> {{name}}", "network": { "parallel": [ { "spring": 100 }, { "damper": 5 } ] } }"""
ROTARY = """{ "dashpot": 1, "name": "rotary", "motion": "rotation", "network": { "parallel": [
    { "spring": "20 mN m/rad", "name": "K" }, { "series": [ { "spring": "80 mN m/rad" }, { "damper": "4 mN m s/rad" } ] } ] } }"""
LONE = '{ "dashpot": 1, "name": "lone_%s", "network": { "%s": 5 } }'

# What the page hands out for download, as text.
DOWNLOADED = """
  const create = URL.createObjectURL;
  let blob = null;
  URL.createObjectURL = (given) => { blob = given; return create(given); };
  document.getElementById('download').click();
  URL.createObjectURL = create;
  return blob.text();"""
DOWNLOADED_FELT = DOWNLOADED.replace("'download'", "'download-felt'")
DATA = "return JSON.parse(document.getElementById('data').textContent)"
# Keys, as the protocol names them.
TAB, END, HOME = "\ue004", "\ue010", "\ue011"
# The page has shown a response, or says what is wrong.
SETTLED = "return document.getElementById('status').textContent"


# What gives a page another part or another control.
FEATURES = {"contact", "elements", "parameters", "rotation", "slip", "tunable", "valid"}


def features(network):
    """Those of FEATURES that a network file has."""
    def words(value):
        if isinstance(value, dict):
            return set(value).union(*map(words, value.values()))
        return set().union(*map(words, value)) if isinstance(value, list) else {value}
    return frozenset(FEATURES & words(json.loads(network.read_text())))


def pairs(network):
    """Of its features, those that it has together; of a network without any, that it has none."""
    own = features(network)
    return set(itertools.combinations_with_replacement(sorted(own), 2)) or {"none"}


def covering(networks):
    """Few of them that have, together, all pairs of features that any has."""
    chosen, left = [], set().union(*map(pairs, networks))
    while left:
        chosen.append(max(networks, key=lambda network: len(pairs(network) & left)))
        left -= pairs(chosen[-1])
    return chosen


def wiggle(rate, with_velocity, count=700):
    """A motion with everything in it: smooth, steep, back through 0, at rest."""
    rows = ["time,position" + (",velocity" if with_velocity else "")]
    for k in range(count):
        t = k / rate
        u = 0.002 * math.sin(0.013 * k) + 0.0007 * math.sin(0.31 * k + 1) + (0.0004 if k > 400 else 0)
        rows.append(f"{t!r},{u!r}" + (f",{0.026 * rate * math.cos(0.013 * k) / 1000!r}" if with_velocity else ""))
    return "\n".join(rows) + "\n"


def columns(text, scalar):
    """Every cell as the bytes of its number: times are double, the others of the law's type."""
    rows = list(csv.reader(io.StringIO(text)))
    kind = {"double": "d", "float": "f"}[scalar]
    return [rows[0]] + [[struct.pack("d" if i == 0 else kind, float(cell)) for i, cell in enumerate(row)]
                        for row in rows[1:]]


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = cls.enterClassContext(Browser())
        cls.pages = {}  # bytes and what was said, by what was asked for

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def written(self, network, *choices, **environment):
        """Has dashpot write the page, without the search for what would help; returns where it is, and what was
        said."""
        page = self.folder / "report.html"
        done = subprocess.run([DASHPOT, "report", str(network), *map(str, choices), "--no-advice", "-o", str(page)],
                              capture_output=True, text=True, timeout=120, env={**os.environ, **environment})
        self.assertEqual(done.returncode, 0, done.stderr)
        return page, done.stderr

    def report(self, network, *choices, **environment):
        """The same, but of files that another test had a page of: equal input gives equal bytes, as is tested below."""
        files = tuple(path.read_bytes() for path in [network, *choices] if isinstance(path, pathlib.Path))
        asked = (str(network), *map(str, choices), *environment.items()), files
        if asked not in self.pages:
            page, said = self.written(network, *choices, **environment)
            self.pages[asked] = page.read_bytes(), said
        page = self.folder / "report.html"
        page.write_bytes(self.pages[asked][0])
        return page, self.pages[asked][1]

    def open(self, network, *choices):
        page, _ = self.report(network, *choices)
        self.assertLess(page.stat().st_size, MOST_BYTES)
        self.browser.open(page)
        self.wait_for("sample")

    def wait_for(self, words):
        for _ in range(200):
            if words in (said := self.browser.run(SETTLED)):
                return
        self.fail(f"the page says '{said}', not '{words}'")

    def assert_quiet(self):
        self.assertEqual(self.browser.log("browser"), [])
        self.assertEqual(self.browser.requested(), [])

    def tunables(self):
        """Name, default, least and most of each slider."""
        return self.browser.run("return JSON.parse(document.getElementById('data').textContent).live.tunables"
                                ".map((t) => [t.name, t.value, t.min, t.max])")

    def upload(self, text):
        path = self.write("motion.csv", text)
        self.browser.type("#upload", str(path))
        return path

    def click_through(self):
        for motion in ["sine", "triangle", "steps", "press"]:
            self.browser.click(f"[data-motion={motion}]")
            self.assertIn("largest force", self.browser.run(SETTLED))
        for menu in self.browser.run("return [...document.querySelectorAll('select')].map((menu) => menu.id)"):
            for i in range(self.browser.run(f"return document.getElementById('{menu}').options.length")):
                self.browser.click(f"#{menu} option:nth-child({i + 1})")
                self.assertEqual(self.browser.run("return document.querySelectorAll('#pareto canvas').length"), 1)
        for control, value in [("depth", "0.002"), ("duration", "0.7")]:
            self.enter(control, value)
            self.assertIn("largest force", self.browser.run(SETTLED))
        surface = self.browser.run(f"{DATA}.live.surface") or 0
        self.assertAlmostEqual(max(float(row[1]) for row in self.response()), surface + 0.002)
        self.browser.drag("#pad", [(-300, 0), (-100, -40), (50, 30), (200, 10)])
        self.assertIn("largest force", self.browser.run(SETTLED))
        self.hover("#pareto .u-over", "#pareto .tip", places=(15, 7))
        self.hover("#forces .u-over", "#forces .u-legend")
        self.click_through_tunables()
        self.browser.click("summary")
        self.assertTrue(self.browser.run("return document.querySelector('details').open"))
        self.assert_all_used()

    def click_through_tunables(self):
        """The keys of every slider change the force, not before the instant that is asked for, and Defaults undoes
        it."""
        if not self.tunables():
            return
        self.browser.click("[data-motion=sine]")
        untouched = self.response()
        for name, *_ in self.tunables():
            forces = [self.forces_with(name, end, untouched) for end in [END, HOME]]
            self.assertTrue(any(changed != [row[3] for row in untouched] for changed in forces), name)

    def forces_with(self, name, end, untouched):
        """With the slider at one of its ends; a friction that nothing overcomes may rise without a trace."""
        self.enter("change-at", "0.35")
        self.browser.type(f"#tunable-{name}", end)
        changed = self.response()
        self.assertEqual(changed[:350], untouched[:350], name)
        self.browser.click("#defaults")
        self.assertEqual(self.response(), untouched, name)
        return [row[3] for row in changed]

    def enter(self, control, value):
        """In place of what a field holds."""
        self.browser.run(f"document.getElementById('{control}').select()")
        self.browser.type(f"#{control}", value + TAB)

    def handed_out(self):
        """What `dashpot simulate` would write: the page's response without the parameters that it puts behind."""
        text, behind = self.browser.run(DOWNLOADED), len(self.tunables())
        return "".join(",".join(line.split(",")[:-behind or None]) + "\n" for line in text.splitlines())

    def response(self):
        """Its rows."""
        return list(csv.reader(io.StringIO(self.handed_out())))[1:]

    def hover(self, chart, says, places=(5, 3)):
        """Moves the pointer all over a chart, which says numbers; a page without it has nothing to hover over. Where
        only some points say something, it takes more places across and down to meet one."""
        box = self.browser.run(f"const part = document.querySelector('{chart}'), box = part?.getBoundingClientRect();"
                               "part?.scrollIntoView({ block: 'center' });"
                               "return box ? [box.width / 2, box.height / 2] : null")
        if box is None:
            return
        self.browser.run(f"const part = document.querySelector('{says}'); window.said = '';"
                         "new MutationObserver(() => { said += part.textContent; })"
                         ".observe(part, { attributes: true, childList: true, subtree: true, characterData: true })")
        across, down = places[0] // 2, places[1] // 2
        self.browser.move(chart, [(int(box[0] * i / (across + 1)), int(box[1] * j / (down + 1)))
                                  for j in range(-down, down + 1) for i in range(-across, across + 1)])
        self.assertRegex(self.browser.run("return said"), "[0-9]", chart)

    def assert_all_used(self):
        """No control is left that nothing above has used."""
        found = self.browser.run(
            "return [...document.querySelectorAll('button, input, select, summary, canvas#pad')]"
            ".map((e) => e.dataset.motion ?? (e.id || e.tagName))")
        known = {"press", "sine", "triangle", "steps", "upload", "download", "depth", "duration", "pad", "pareto-x",
                 "pareto-y",
                 "change-at", "defaults", "SUMMARY", "download-felt"} | {f"tunable-{name}"
                                                                         for name, *_ in self.tunables()}
        self.assertEqual(set(found) - known, set())

    def assert_simulates(self, network, *choices, rate=1000, scalar="double", motions=(False, True)):
        """Of motions without velocity, and with."""
        for with_velocity in motions:
            motion = self.upload(wiggle(rate, with_velocity))
            self.wait_for("700 samples")
            done = subprocess.run([DASHPOT, "simulate", str(network), *map(str, choices), "--input", str(motion)],
                                  capture_output=True,
                                  text=True, timeout=60, check=True)
            self.assertEqual(columns(self.handed_out(), scalar), columns(done.stdout, scalar), network)

    def test_every_network(self):
        """Fails if a page of a network in networks/ is too large, says anything on the console, asks for anything
        beyond itself, has a control that does nothing, or computes another bit than `dashpot simulate`. All controls
        are used, and motions with and without velocity, on networks with every two parts that a page has together; with
        --long, on all. Of the others every third page is opened."""
        clicked = NETWORKS if IS_LONG else covering(NETWORKS)
        opened = clicked + [network for network in NETWORKS if network not in clicked][::3]
        for network in opened:
            with self.subTest(network=network.name):
                self.open(network)
                if network in clicked:
                    self.click_through()
                self.assert_simulates(network, motions=(False, True) if network in clicked else (True,))
                self.assert_quiet()

    def click_through_felt_error(self):
        """The chart of the error names every candidate, says its error where the pointer is, and hides and shows its
        curve."""
        names = self.browser.run(f"{DATA}.felt_error.candidates.map((c) => c.name)")
        candidates = self.browser.run(f"{DATA}.pareto.candidates.map((c) => c.name)")
        self.assertEqual(sorted(", ".join(names).split(", ")), sorted(candidates))
        labels = "[...document.querySelectorAll('#felt-error .u-legend .u-series .u-label')]"
        self.assertEqual(self.browser.run(f"return {labels}.map((label) => label.textContent)"), ["frequency", *names])
        self.hover("#felt-error .u-over", "#felt-error .u-legend")
        shown = ("const canvas = document.querySelector('#felt-error canvas');"
                 "return [document.querySelectorAll('#felt-error .u-series.u-off').length, canvas.toDataURL()]")
        off, before = self.browser.run(shown)
        self.assertEqual(off, 0)
        click = (f"{labels}.find((label) => label.textContent.startsWith('paper'))"
                 ".dispatchEvent(new MouseEvent('click', { bubbles: true }))")
        redrawn = "return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done())))"
        self.browser.run(f"{click}; {redrawn}")
        off, without = self.browser.run(shown)
        self.assertEqual(off, 1)
        self.assertNotEqual(without, before)
        self.browser.run(f"{click}; {redrawn}")
        self.assertEqual(self.browser.run(shown), [0, before])

    def test_choices(self):
        """Fails if the page's law is not the one that was chosen, or its numbers are not those of its scalar type."""
        choices = {"--scheme": "backward-euler", "--decomposition": "zero-frequency", "--state-input": "velocity"}
        for name, value in choices.items():
            with self.subTest(name):
                self.open(FIG_5, name, value)
                self.assert_simulates(FIG_5, name, value)
        self.open(FIG_5, "--scalar", "float")
        self.assert_simulates(FIG_5, "--scalar", "float", scalar="float")
        self.open(FIG_5, "--device", PANTOGRAPH)
        self.click_through()
        self.click_through_felt_error()
        self.assert_simulates(FIG_5, "--device", PANTOGRAPH, rate=10000)
        self.assert_quiet()

    def test_what_is_felt(self):
        """Fails if what a page says is felt of an uploaded motion, at whatever rate it was recorded, is not what
        `dashpot run --motion` plays on the same device, for a linear network, one with slips and one with tunables."""
        device = json.loads(PANTOGRAPH.read_text())
        device["loop"]["jitter"] = "0 s"  # a page knows no chance
        arm = self.write("arm.json", json.dumps(device))
        friction = SOURCE / "networks/tunable/friction_tunable.json"
        for network, is_linear in [(FIG_5, True), (self.write("fig_10.json", FIG_10), False), (friction, False)]:
            with self.subTest(network=network.name):
                self.open(network, "--device", arm)
                motion = self.upload(wiggle(250, False, 200))
                self.wait_for("7961 samples")
                said = self.browser.run(SETTLED)
                self.assertIn("felt error on pantograph_brake_2009", said)
                self.assertEqual("against the network" in said, is_linear)
                played = self.folder / "felt.csv"
                done = subprocess.run([DASHPOT, "run", str(network), "--device", str(arm), "--motion", str(motion),
                                       "-o", str(played), "--json"],
                                      capture_output=True, text=True, timeout=120, check=True)
                here, there = [list(csv.DictReader(io.StringIO(text)))
                               for text in (self.browser.run(DOWNLOADED_FELT), played.read_text())]
                self.assertEqual((list(here[0]), len(here)), (list(there[0]), len(there)))
                peak = json.loads(done.stdout)["force"]["peak"]
                exact = {"position": 1e-9, "estimate": 1e-6, "felt_force": 1e-6 * peak, "damping": 1e-6,
                         "motor_force": 1e-6 * peak}
                for name, close in (exact | ({"closed_form": 1e-6 * peak} if is_linear else {})).items():
                    worst = max(abs(float(a[name]) - float(b[name])) for a, b in zip(here[:-1], there))
                    self.assertLess(worst, close, name)
                self.assert_quiet()

    def test_what_is_felt_begins_at_rest(self):
        """Fails if a recording that begins elsewhere than at 0 is compared with a network that is torn there from 0,
        where `dashpot run --motion` compares it with one at rest there: a network that is not linear errs then without
        an error of the device. One that is held still answers with what it bears at rest."""
        held = "time,position,velocity\n" + "".join(f"{k / 10000!r},0.006,0.1\n" for k in range(300))
        tunable = TUNABLE if IS_LONG else TUNABLE[:1]
        for network in [FIG_5, self.write("fig_10.json", FIG_10), self.write("behind.json", BEHIND), *tunable]:
            with self.subTest(network=network.name):
                self.open(network, "--device", PANTOGRAPH)
                motion = self.upload(held)
                self.wait_for("300 samples")
                played = self.folder / "felt.csv"
                subprocess.run([DASHPOT, "run", str(network), "--device", str(PANTOGRAPH), "--motion", str(motion),
                                "-o", str(played)], capture_output=True, timeout=120, check=True)
                here, there = [[float(row["closed_form"]) for row in csv.DictReader(io.StringIO(text))]
                               for text in (self.browser.run(DOWNLOADED_FELT), played.read_text())]
                self.assertEqual(len(here), len(there))
                for a, b in zip(here, there):  # both are sums of few products
                    self.assertAlmostEqual(a, b, delta=1e-14 * max(map(abs, there)))
                self.assert_quiet()

    def test_networks_with_slips(self):
        """Fails if a network with slips has no page of its own, with what is linear left out and the loops drawn."""
        for name, text in {"fig_10": FIG_10, "coupled": COUPLED}.items():
            with self.subTest(name):
                network = self.write(name + ".json", text)
                self.open(network)
                self.assertIn("three amplitudes", self.browser.run("return document.body.textContent"))
                self.assertIn("brake b", self.browser.run("return document.getElementById('regimes').textContent"))
                self.assertIn("ertified", self.browser.run("return document.getElementById('passivity').textContent"))
                for left_out in ["candidates", "agreement", "canonical"]:
                    self.assertIsNone(self.browser.run(f"return document.getElementById('{left_out}')"))
                self.assert_simulates(network)
                self.assert_quiet()

    def test_slips_on_a_device_tell_the_whole_choice(self):
        """Fails if the page of a network with slips keeps to itself, on a device, what was chosen beside the slips and
        why, how the candidates err over the band, or by how much and in which motion the law behind the slips does."""
        self.open(SOURCE / "networks/paper/visco_elasto_plastic.json", "--device", PANTOGRAPH)
        text = "return document.getElementById('{}').textContent"
        beside = self.browser.run(text.format("candidates"))
        self.assertIn("in parallel with the slips", beside)
        self.assertIn("'faithful' takes b =", beside)
        self.assertRegex(self.browser.run(text.format("regimes")),
                         r"the felt force deviates by up to [\d.]+ % of the largest force, in a (sine|drag)")
        names = ", ".join(self.browser.run(f"{DATA}.felt_error.candidates.map((c) => c.name)"))
        self.assertIn("faithful", names)
        self.assert_quiet()

    def test_every_slip_keeps_its_name(self):
        """Fails if one of several slips shares the name, the regimes or the candidates of another, or if what is said
        of a ring of slips is said of a network without."""
        rows = ("return [...document.querySelectorAll('#regimes .regimes tbody tr')]"
                ".map((row) => [...row.children].map((cell) => cell.textContent))")
        self.open(SOURCE / "networks/paper/maxwell_slip_ten.json")
        shown = self.browser.run(rows)
        for i in range(1, 11):
            self.assertIn(["–", f"Y{i}", "0", "0", "0", str(210 - 10 * i)], shown)
            self.assertIn([f"Y{i}", "–", "0", "0", "0", "0"], shown)
        self.assertIn("Y1, Y2, Y3, Y4, Y5, Y6, Y7, Y8, Y9, Y10",
                      self.browser.run("return document.querySelector('#regimes h3').textContent"))
        laws = self.browser.run("return [...document.querySelectorAll('#regimes .laws b')].map((law) => "
                                "law.textContent)")
        self.assertEqual(laws, ["velocity-free", "steady", "ramped", "gated"])
        self.open(SOURCE / RING)
        self.assertEqual(len(self.browser.run(rows)), 8)
        for left_out in ["candidates", "agreement"]:
            self.assertIsNone(self.browser.run(f"return document.getElementById('{left_out}')"))
        self.assertNotIn("Canonical form", self.browser.run("return document.body.textContent"))

    def test_the_first_response_says_something(self):
        """Fails if a page opens with a motion that does not reach the tissue, or at which no slip yields: a tenth of it
        would then answer with a tenth of the force."""
        for network in [self.write("behind.json", BEHIND), *(path for path in NETWORKS if "slip" in features(path))]:
            with self.subTest(network=network.name):
                self.open(network)
                depth = float(self.browser.run("return document.getElementById('depth').value"))
                forces = []
                for part in [1, 10]:
                    self.enter("depth", repr(depth / part))
                    forces.append(max(abs(float(row[3])) for row in self.response()))
                self.assertGreater(forces[1], 0)
                # A slip that yields answers less than tenfold, a curve beside it more.
                self.assertGreater(abs(forces[0] / (10 * forces[1]) - 1), 0.01)

    def test_comments(self):
        """Fails if what the author remarks does not reach the page, with the place that it stands at."""
        self.open(self.write("behind.json", BEHIND))
        said = self.browser.run("return [...document.querySelectorAll('#comments li')].map((line) => line.textContent)")
        self.assertEqual(said, ["Made to be looked at.", "K0 Stiff <b>", "K0 and steady"])
        self.open(FIG_5)
        self.assertIsNone(self.browser.run("return document.getElementById('comments')"))

    def test_uploads_are_read_as_simulate_reads(self):
        """Fails if the page reads another table than `dashpot simulate`, reads it otherwise, or takes one that it
        refuses: units, separators, decimals, lines in front, digits of times."""
        self.open(FIG_5)
        rows = [(k / 1000, 0.002 * math.sin(0.02 * k)) for k in range(60)]
        def table(header, line, before=""):
            return before + header + "\n" + "".join(line(t, u) + "\n" for t, u in rows)
        good = [table("time [s],position [mm]", lambda t, u: f"{t:.3f},{1000 * u!r}"),
                table("t;x (µm)", lambda t, u: f"{t:.3f};{1e6 * u!r}".replace(".", ",")),
                table("time\tdisplacement", lambda t, u: f"{1000 * t:.0f}\t{100 * u!r}",
                      "a rig, 3 runs\n\n").replace("ment\n", "ment\nms\tcm\n"),
                table("# time[ms] position[m] velocity[mm/min]", lambda t, u: f"{1000 * t:.0f}  {u!r}  7.25"),
                table("t [ms] | x [mm]", lambda t, u: f"{1000 * t:.0f} | {1000 * u!r}"),
                table("note,time,position", lambda t, u: f"a,{t:.3f},+{abs(u):.6f}"),
                table("time,position,u", lambda t, u: f"{t:.3f},{u!r},9"),
                table("time,position", lambda t, u: f"{t + 1e4:.3f},{u:.7e}"),
                "time,position\r\n0,0\r\n\r\n0.001,.5e-3\r\n0.002,\"1e-3\"\r\n"]
        for text in good:
            with self.subTest(text=text[:60]):
                motion = self.upload(text)
                self.wait_for("3 samples" if "\r" in text else "60 samples")
                done = subprocess.run([DASHPOT, "simulate", str(FIG_5), "--input", str(motion)], capture_output=True,
                                      text=True, timeout=60)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(columns(self.handed_out(), "double"), columns(done.stdout, "double"))
        bad = {"time,position [N]\n0,0\n": "column 'position [N]' in 'N'",
               "time,position [deg]\n0,0\n0.001,1\n": "the motion is in radians",
               "time,position,position [mm]\n0,0,0\n": "there twice", "t;x\n0;0\n0,001;1;2\n": "row 3 has 3 fields",
               "time [ms],position\n0,0\n1,0\n2,0\n4,0\n": "a uniform period",
               "time,position\n0,0\n0.001,1e999\n": "a finite number",
               "time,position\n0,0\n0.001,\n": "position is ''", "time,position [Tm]\n0,1e308\n0.001,0\n": "too large",
               table("time,position", lambda t, u: f"{t:.2f},{u!r}"): "times that rise",
               "time,position\n0,0\n1e10,0\n": "rows come at 10⁻¹⁰ Hz"}
        for text, said in bad.items():
            with self.subTest(said=said):
                motion = self.upload(text)
                self.wait_for(said)
                done = subprocess.run([DASHPOT, "simulate", str(FIG_5), "--input", str(motion)], capture_output=True,
                                      text=True, timeout=60)
                self.assertNotEqual(done.returncode, 0)
        self.assert_quiet()

    def test_advice_works(self):
        """Fails if the --rate that a page asks for is not one that the compiler takes, or does not let the upload
        in."""
        for period in ["0.000333", "0.0123456", "0.02"]:
            text = "time,position\n" + "".join(f"{k * float(period):.9g},{k % 7}e-4\n" for k in range(40))
            self.open(FIG_5)
            self.upload(text)
            self.wait_for("write the page again")
            rate = re.search(r"--rate ([0-9.e+-]+)", self.browser.run(SETTLED))[1]
            self.open(FIG_5, "--rate", rate)
            self.upload(text)
            self.wait_for("40 samples")

    def test_axes_that_tell_the_candidates_apart(self):
        """Fails if another pair of figures would show more of the candidates apart than the two that the scatter begins
        with."""
        for network in [FIG_5, SOURCE / "networks/tissues/swine_kidney_cortex.json"]:
            for choices in [[], ["--device", PANTOGRAPH]]:
                self.open(network, *choices)
                pareto = self.browser.run(f"{DATA}.pareto")
                values = [candidate["values"] for candidate in pareto["candidates"]]
                def apart(x, y):
                    most = [max(abs(row[i]) for row in values if row[i] is not None) or 1 for i in (x, y)]
                    points = [(row[x] / most[0], row[y] / most[1]) for row in values if None not in (row[x], row[y])]
                    return sum(math.dist(p, q) >= 0.05 for i, p in enumerate(points) for q in points[:i])
                chosen = [int(self.browser.run(f"return document.getElementById('pareto-{axis}').value"))
                          for axis in "xy"]
                count = len(pareto["figures"])
                self.assertEqual(apart(*chosen), max(apart(x, y) for x in range(count) for y in range(x + 1, count)))

    def test_legends_and_labels(self):
        """Fails if a legend says values that nobody asked for, if a label is cut off at the edge of its plot, or if a
        number has more than four digits."""
        for network, choices in [(FIG_5, ["--device", PANTOGRAPH]),
                                 (SOURCE / "networks/paper/visco_elasto_plastic_organ.json", [])]:
            self.open(network, *choices)
            for width in [1100, 390]:
                self.browser.devtools("Emulation.setDeviceMetricsOverride", width=width, height=844,
                                      deviceScaleFactor=1, mobile=False)
                self.addCleanup(self.browser.devtools, "Emulation.clearDeviceMetricsOverride")
                legends = self.browser.run("return [...document.querySelectorAll('.u-legend')].map((legend) => "
                                           "legend.innerText)")
                self.assertTrue(legends)
                self.assertFalse([text for text in legends if ":" in text or "--" in text
                                  or re.match("time|frequency", text)])
                cut = self.browser.run("""return [...document.querySelectorAll('svg.plot')].filter((plot) => plot.checkVisibility()).flatMap((plot) => {
                    const box = plot.getBoundingClientRect();
                    return [...plot.querySelectorAll('text')].filter((text) => {
                      const own = text.getBoundingClientRect();
                      return own.left < box.left - 0.5 || own.right > box.right + 0.5 || own.top < box.top - 0.5 || own.bottom > box.bottom + 0.5;
                    }).map((text) => text.textContent);
                  })""")
                self.assertEqual(cut, [])
            text = self.browser.run("return [...document.querySelectorAll('header dl, main "
                                    "section:not(#live)')].map((part) => part.innerText).join('\\n')")
            long = [number for number in re.findall(r"(?<![\w.])\d+\.\d+", text)
                    if len(number.replace(".", "").lstrip("0")) > 4]
            self.assertEqual(long, [])

    def test_tunables(self):
        """Fails if a slider's set() is not that of the law: what the page hands out, with the parameters' values beside
        the motion, is simulated anew by `dashpot simulate`, at rest, under load and with values that change at every
        sample."""
        for network in TUNABLE:
            with self.subTest(network=network.name):
                self.open(network)
                shown = self.browser.run("return [...document.querySelectorAll('#tunables label > span')].map((name) "
                                         "=> name.textContent)")
                self.assertEqual(shown, [name for name, *_ in self.tunables()])
                listed = self.browser.run("return [...document.querySelectorAll('#equations tbody tr')].map((row) => "
                                          "[...row.children].map((cell) => cell.textContent))")
                for name, *_ in self.tunables():
                    self.assertTrue(any(row[0] == name and row[-1] for row in listed), name)
                for i, (name, value, least, most) in enumerate(self.tunables()):
                    self.enter("change-at", ["0", "0.1234", "0.3"][i % 3])
                    self.browser.run(f"const slider = document.getElementById('tunable-{name}');"
                                     f"slider.value = {least + 0.83 * (most - least)!r};"
                                     "slider.dispatchEvent(new Event('input'))")
                    self.assert_simulates_again(network)
                rows = [line.split(",") for line in wiggle(1000, True).splitlines()]
                tunables = self.tunables()
                names = [name for name, *_ in tunables]
                values = [[repr(least + (most - least) * (k % 97) / 90) for _, _, least, most in tunables]
                          for k in range(len(rows) - 1)]
                self.upload("\n".join(",".join(a + b) for a, b in zip(rows, [names, *values])) + "\n")
                self.wait_for("700 samples")
                self.assert_simulates_again(network)
                self.assert_quiet()

    def assert_simulates_again(self, network):
        motion = self.write("handed_out.csv", self.browser.run(DOWNLOADED))
        done = subprocess.run([DASHPOT, "simulate", str(network), "--input", str(motion)], capture_output=True,
                              text=True, timeout=60,
                              check=True)
        self.assertEqual(columns(self.handed_out(), "double"), columns(done.stdout, "double"))

    def test_least_networks(self):
        """Fails if a lone element, which has no mode and perhaps no stiffness, breaks a page."""
        for kind in ["spring", "damper"]:
            self.open(self.write("lone.json", LONE % (kind, kind)))
            self.click_through()
            self.assert_quiet()
        self.open(self.write("rotary.json", ROTARY))
        self.assertIn("N·m·s/rad", self.browser.run("return document.body.textContent"))

    def test_the_author_s_words(self):
        """Fails if a title or a source is taken for markup, script or a placeholder."""
        self.open(self.write("hostile.json", HOSTILE))
        self.assertEqual(self.browser.run("return document.querySelector('h1').textContent"),
                         "</title><script>document.title='taken'</script>&amp;")
        self.assertIn("{{name}}", self.browser.run("return document.querySelector('.source').textContent"))
        self.assertEqual(self.browser.run("return document.images.length"), 0)
        self.assert_quiet()

    def test_motions_that_are_refused(self):
        """Fails if an upload that `dashpot simulate` refuses is taken, or is refused without a word."""
        self.open(FIG_5)
        for text, said in {"time,place\n0,1\n": "no column 'position'; its name may also be 'pos', 'displacement'",
                           "time,position\n0,0\n0.001,x\n": "a finite number is expected",
                           "time,position\n0,0\n0.001,1\n0.003,1\n0.004,1\n": "a uniform period", "": "no rows",
                           "time,position\n0,0\n0.002,1\n": "--rate 500",
                           "time,position\n0,0,0\n": "row 2 has 3 fields",
                           "time,position,time\n0,0,0\n": "there twice"}.items():
            self.upload(text)
            self.wait_for(said)
        self.assert_quiet()

    def test_phone_dark_and_paper(self):
        """Fails if a page is wider than a phone, stays light in dark mode, or is not drawn anew for paper."""
        for network in [FIG_5, SOURCE / "networks/paper/generalised_kelvin_four.json"]:
            self.open(network)
            self.browser.devtools("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=3,
                                  mobile=True)
            self.addCleanup(self.browser.devtools, "Emulation.clearDeviceMetricsOverride")
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 390)
            self.assert_cues()
            colours = []
            for scheme in ["light", "dark"]:
                self.browser.devtools("Emulation.setEmulatedMedia",
                                      features=[{"name": "prefers-color-scheme", "value": scheme}])
                colours.append(self.browser.run("return getComputedStyle(document.documentElement).backgroundColor"))
            self.assertNotEqual(*colours)
            self.browser.run("dispatchEvent(new Event('beforeprint'))")
            self.assertEqual(self.browser.run("return getComputedStyle(document.documentElement).backgroundColor"),
                             colours[0])
            self.browser.run("dispatchEvent(new Event('afterprint'))")
            self.assertGreater(len(self.browser.devtools("Page.printToPDF")["data"]), 20_000)
            self.browser.devtools("Emulation.setEmulatedMedia", features=[])
            self.assert_quiet()

    def assert_cues(self):
        """What is wider than the page says so at its edge, and no longer when it is scrolled to its end."""
        self.browser.run("dispatchEvent(new Event('resize')); return new Promise((done) => requestAnimationFrame(() => "
                         "requestAnimationFrame(() => done())))")
        wide = self.browser.run("""return Promise.all([...document.querySelectorAll('.wide')].filter((part) => part.scrollWidth > part.clientWidth + 1)
          .map(async (part) => {
            const states = [part.matches('.more-right:not(.more-left)') && getComputedStyle(part).maskImage !== 'none'];
            part.scrollLeft = part.scrollWidth;
            await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
            states.push(part.matches('.more-left:not(.more-right)'));
            part.scrollLeft = 0;
            return states.every((state) => state);
          }))""")
        self.assertTrue(wide)
        self.assertTrue(all(wide), wide)

    def test_nothing_runs_off_a_phone(self):
        """Fails if labels of candidates that agree, or a name or a source of one long word, make a page wider than a
        phone."""
        self.browser.devtools("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=1,
                              mobile=True)
        self.addCleanup(self.browser.devtools, "Emulation.clearDeviceMetricsOverride")
        examples = [SOURCE / "examples" / name for name in ["breast_palpation", "knob_on_board", "needle_in_layers",
                                                            "tunable_wall"]]
        long = FIG_10.replace('"title"',
                              f'"source": "{"source" * 20}", "title"').replace('"Y"',
                                                                               '"muscle_with_a_very_long_name_indeed"')
        pages = [(folder / "network.json", ["--device", folder / "device.json"]) for folder in examples]
        for network, choices in [*pages, (self.write("long.json", long), [])]:
            with self.subTest(network=network):
                self.open(network, *choices)
                self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), 390)

    def test_the_error_is_seen_on_a_phone(self):
        """Fails if the column of the error is beyond the edge of a phone."""
        self.open(FIG_5, "--device", PANTOGRAPH)
        self.browser.devtools("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=3,
                              mobile=True)
        self.addCleanup(self.browser.devtools, "Emulation.clearDeviceMetricsOverride")
        heads = self.browser.run("return [...document.querySelectorAll('#candidates thead th')].map((head) => "
                                 "[head.textContent, head.getBoundingClientRect().right])")
        self.assertLess([right for text, right in heads if "error" in text][0], 390 - 42)  # the edge fades

    def test_paper(self):
        """Fails if a table, a formula or a drawing is cut on paper, a control is printed, or the chart of the error is
        not there."""
        self.open(FIG_5, "--device", PANTOGRAPH)
        self.browser.devtools("Emulation.setEmulatedMedia", media="print")
        self.browser.devtools("Emulation.setDeviceMetricsOverride", width=673, height=1000, deviceScaleFactor=1,
                              mobile=False)
        self.addCleanup(self.browser.devtools, "Emulation.clearDeviceMetricsOverride")
        self.browser.run("dispatchEvent(new Event('beforeprint'))")
        self.addCleanup(self.browser.devtools, "Emulation.setEmulatedMedia", media="")
        self.assertEqual(self.browser.run("return [...document.querySelectorAll('button, select, "
                                          "input')].filter((part) => part.checkVisibility()).length"), 0)
        self.assertTrue(self.browser.run("return document.querySelector('#what-is-felt svg').checkVisibility()"))
        self.assertEqual(self.browser.run("return [...document.querySelectorAll('.wide')].filter((part) => "
                                          "getComputedStyle(part).maskImage !== 'none').length"), 0)
        beyond = self.browser.run("return [...document.querySelectorAll('main table, main math, main "
                                  "svg')].filter((part) => part.checkVisibility() &&"
                                  "part.getBoundingClientRect().right > innerWidth + 1).map((part) => "
                                  "part.outerHTML.slice(0, 80))")
        self.assertEqual(beyond, [])

    def test_without_clang(self):
        """Fails if a page is not written without clang, or promises a live response that it does not have."""
        page, said = self.report(FIG_5, DASHPOT_CLANG="/nowhere/clang++")
        self.assertIn("[no-live-response]", said)
        self.browser.open(page)
        self.assertIn("no clang", self.browser.run("return document.getElementById('live').textContent"))
        self.assertIsNone(self.browser.run("return document.getElementById('pad')"))
        self.assert_quiet()

    def test_equal_input_gives_equal_bytes(self):
        """Fails if a page holds a date, a path, or anything else that changes from one run to the next."""
        first = self.written(FIG_5)[0].read_bytes()
        self.assertEqual(first, self.written(FIG_5)[0].read_bytes())
        self.assertNotIn(str(self.folder).encode(), first)


if __name__ == "__main__":
    unittest.main()
