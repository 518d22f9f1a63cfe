"""What --target wasm writes: the law's bits in Node.js and in Chromium, types that hold, and clear refusals.

The environment names what ctest knows: DASHPOT, DASHPOT_SOURCE, NODE and TSC.
"""
import base64
import csv
import functools
import http.server
import json
import math
import os
import pathlib
import random
import re
import struct
import subprocess
import sys
import tempfile
import threading
import unittest

SOURCE = pathlib.Path(os.environ["DASHPOT_SOURCE"])
sys.path.insert(0, str(SOURCE / "tests/report"))
from browser import Browser  # noqa: E402

DASHPOT, NODE, TSC = os.environ["DASHPOT"], os.environ["NODE"], os.environ["TSC"]
FIG_5 = SOURCE / "networks/paper/second_order_maxwell.json"
SLIPS = SOURCE / "networks/paper/maxwell_slip_ten.json"
TUNABLE = SOURCE / "networks/tunable/second_order_maxwell_tunable.json"
PANTOGRAPH = SOURCE / "runtime/devices/pantograph_brake_2009.json"
COLUMNS = {"velocity": "velocity", "force": "force", "damping": "damping", "motorForce": "motor_force"}

# Does the same in Node.js and in a page.
PLAY = """
async function play(address, input) {
  const module = await import(address);
  const law = await module.load();
  const once = law.simulate(Float64Array.from(input.position), input.velocity, { values: input.values });
  law.reset(0);
  const steps = input.position.slice(0, 50).map((p, k) => law.step(p, once.velocity[k]));
  const result = { name: module.name, rate: module.rate, device: module.device, parameters: module.parameters, steps };
  for (const key of ['velocity', 'force', 'damping', 'motorForce']) result[key] = Array.from(once[key]);
  return result;
}
"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


class WasmTest(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def dashpot(self, *words, status=0, **environment):
        done = subprocess.run([DASHPOT, *map(str, words)], capture_output=True, text=True,
                              env={**os.environ, **environment})
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def node(self, text):
        script = self.folder / "script.mjs"
        script.write_text(text)
        done = subprocess.run([NODE, str(script)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def motion(self, rows=300, seed=4):
        chance = random.Random(seed)
        position = [1e-4]  # the first row has no row before it
        while len(position) < rows:
            step = chance.gauss(0, 1) * 10 ** chance.uniform(-7, -4) if len(position) % 50 < 40 else 0
            position.append(position[-1] + step)
        return position

    def simulated(self, network, columns, *choices):
        table = self.folder / "motion.csv"
        with open(table, "w") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(columns)
            writer.writerows(zip(*(map(repr, values) for values in columns.values())))
        rows = list(csv.DictReader(self.dashpot("simulate", network, "--input", table, *choices).stdout.splitlines()))
        return {name: [float(row[name]) for row in rows] for name in rows[0]}


class Bits(WasmTest):
    def check(self, network, *choices, only_compile=(), values=None, velocity=False):
        """What Node.js computes, compared with what the compiler's own account of the law prints."""
        self.dashpot("compile", network, "--target", "wasm", "-o", self.folder / "laws", *choices, *only_compile)
        name = json.loads(network.read_text())["name"]
        motion = {"position": self.motion(), "velocity": self.motion(seed=9) if velocity else None, "values": values
                  or {}}
        played = json.loads(self.node(f"{PLAY}\nconsole.log(JSON.stringify(await play('./laws/{name}/index.js', "
                                      f"{json.dumps(motion)})));"))
        self.assertEqual(played["name"], name)
        columns = {"time": [k / played["rate"] for k in range(len(motion["position"]))], "position": motion["position"],
                   **motion["values"]}
        if velocity:
            columns["velocity"] = motion["velocity"]
        wanted = self.simulated(network, columns, *choices)
        exact = (lambda v: struct.unpack("f", struct.pack("f", v))[0]) if "float" in choices else float
        for key, column in COLUMNS.items():
            self.assertEqual(list(map(exact, played[key])), list(map(exact, wanted[column])), f"{name} {key}")
        self.assertGreater(max(map(abs, played["force"])), 0)
        if not values:
            for k, step in enumerate(played["steps"]):
                self.assertEqual((step["damping"], step["force"]), (played["damping"][k], played["motorForce"][k]))
        return name, motion, played

    def test_node(self):
        """Fails if a bit differs from what `dashpot simulate` computes, in double or in float, with slips, tunables or
        a device."""
        parameters = json.loads(TUNABLE.read_text())["parameters"]
        chance = random.Random(2)
        values = {}
        for name in (name for name, parameter in parameters.items() if isinstance(parameter, dict)
                     and parameter.get("tunable")):
            low, high = (float(parameters[name][end].split()[0]) for end in ("min", "max"))
            values[name] = [v for v in (chance.uniform(low, high) for _ in range(15)) for _ in range(20)]
        self.assertTrue(values)
        for scalar in ["double", "float"]:
            self.check(FIG_5, "--scalar", scalar)
            self.check(SLIPS, "--scalar", scalar, velocity=True)
            self.check(TUNABLE, "--scalar", scalar, values=values)
        _, _, played = self.check(FIG_5, "--device", PANTOGRAPH, only_compile=["--uncertified"])
        self.assertEqual((played["device"], played["rate"]), ("pantograph_brake_2009", 10000))

    def test_chromium(self):
        """Fails if a page does not get what Node.js gets, number by number."""
        name, motion, played = self.check(FIG_5)
        (self.folder / "index.html").write_text(f"<!doctype html><title>law</title><script>{PLAY}</script>")
        handler = functools.partial(Quiet, directory=str(self.folder))
        with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            with Browser() as browser:
                browser.visit(f"http://127.0.0.1:{server.server_port}/index.html")
                shown = browser.run(f"return play('/laws/{name}/index.js', arguments[0]).then(JSON.stringify)", motion)
            server.shutdown()
        self.assertEqual(json.loads(shown), played)

    def test_module_of_the_report(self):
        """Fails if what a report computes with is another module."""
        self.dashpot("compile", FIG_5, "--target", "wasm", "-o", self.folder)
        self.dashpot("report", FIG_5, "-o", self.folder / "page.html")
        encoded = re.search(r'"module":"([A-Za-z0-9+/=]+)"', (self.folder / "page.html").read_text())[1]
        self.assertEqual(base64.b64decode(encoded),
                         (self.folder / "second_order_maxwell/second_order_maxwell.wasm").read_bytes())


class Wrapper(WasmTest):
    def test_laws(self):
        """Fails if laws share a state, set() passes what is out of range, or rows that do not fit are taken."""
        self.dashpot("compile", TUNABLE, "--target", "wasm", "-o", self.folder)
        self.node("""
          import { deepEqual, equal, notEqual, throws } from 'node:assert/strict';
          import { readFileSync } from 'node:fs';
          import * as m from './second_order_maxwell_tunable/index.js';
          const one = await m.load(), other = await m.load();
          const name = Object.keys(m.parameters)[0], range = m.parameters[name];
          const still = other.step(0, 0).force;
          one.step(1e-3, 1);
          one.step(1e-3, 0);
          equal(other.step(0, 0).force, still);
          one.set({ [name]: range.max });
          equal(one.parameters[name], range.max);
          equal(other.parameters[name], range.value);
          for (const wrong of [range.max * 1.01, range.min - 1, NaN, Infinity, '3', undefined])
            throws(() => one.set({ [name]: wrong }), RangeError);
          throws(() => one.set({ softness: 1 }), /has no parameter 'softness'; it has/);
          equal(one.parameters[name], range.max);
          for (const wrong of [range.max * 1.01, NaN])
            throws(() => one.simulate([2e-3, 0], null, { values: { [name]: [range.min, wrong] } }), /is expected/);
          equal(one.parameters[name], range.max);
          throws(() => one.simulate([0, 1], [0]), /velocity has 1 rows, and position 2/);
          throws(() => one.simulate([0, 1], null, { values: { [name]: [1] } }), RangeError);
          notEqual(one.simulate([0, 1e-3, 2e-3]).force[2], other.simulate([0, 1e-3, 2e-3]).force[2]);
          one.reset();
          deepEqual(one.simulate([0, 1e-3, 2e-3]), other.simulate([0, 1e-3, 2e-3]));
          const whole = one.simulate([0, 1e-3, 2e-3, 2e-3]);
          one.simulate([0, 1e-3], whole.velocity.slice(0, 2));
          deepEqual(one.simulate([2e-3, 2e-3], whole.velocity.slice(2), { start: null }).force, whole.force.slice(2));
          equal(one.step(NaN, 0).force, 0);
          const bytes = readFileSync('second_order_maxwell_tunable/second_order_maxwell_tunable.wasm');
          for (const given of [bytes, new WebAssembly.Module(bytes)])
            equal((await m.load(given)).step(0, 0).damping, other.step(0, 0).damping);
        """)

    def test_device(self):
        """Fails if what is felt on a device is not there, or is there without one."""
        self.dashpot("compile", FIG_5, "--target", "wasm", "-o", self.folder, "--device", PANTOGRAPH, "--uncertified")
        felt = self.node("""
          import { load } from './second_order_maxwell/index.js';
          const law = await load();
          law.leadFrom(0);
          let now;
          for (let k = 0; k < 2000; ++k) now = law.lead(k * 1e-6, 1e-2);
          console.log(JSON.stringify(now));
        """)
        felt = json.loads(felt)
        self.assertAlmostEqual(felt["estimate"], 1e-2, delta=2e-3)
        self.assertTrue(felt["damping"] > 0 and math.isfinite(felt["feltForce"]))

    def spring(self, *choices):
        """A spring that is tunable from 0 to 1/8 N m/rad, and a damper, compiled: its force at rest is stiffness times
        position, exactly where both are powers of two."""
        network = self.folder / "spring.json"
        network.write_text(json.dumps({
            "dashpot": 1, "name": "spring", "motion": "rotation",
            "parameters": {"K": {"value": "0.0625 N m/rad", "tunable": True, "min": 0, "max": "0.125 N m/rad"}},
            "network": {"parallel": [{"spring": "K"}, {"damper": "0.001 N m s/rad"}]}}))
        self.dashpot("compile", network, "--target", "wasm", "-o", self.folder, *choices)

    def test_a_motion_keeps_what_was_set(self):
        """Fails if a motion that begins at rest elsewhere than at 0 has other parameters there than those that were
        set, or if its first values are not a change under the load that is there, as they are in Python and in C."""
        self.spring()
        self.node("""
          import { deepEqual } from 'node:assert/strict';
          import { load } from './spring/index.js';
          const law = await load(), still = new Float64Array(6).fill(0.25), forces = (force) => new Float64Array(6).fill(force);
          for (const K of [0.125, 0.03125, 0]) {
            law.reset();
            law.set({ K });
            deepEqual(law.simulate(still, null, { start: 0.25 }).force, forces(K * 0.25));
            deepEqual(law.parameters, { K });
          }
          // What is stiffer from now on gets no force from nowhere.
          deepEqual(law.simulate(still, null, { start: 0.25, values: { K: forces(0.125) } }).force, forces(0));
          deepEqual(law.parameters, { K: 0.125 });
          law.reset(0.25);
          deepEqual(law.parameters, { K: 0.0625 });
          deepEqual(law.simulate(still, null, { start: null }).force, forces(0.0625 * 0.25));
        """)

    def test_a_led_device_keeps_what_was_set(self):
        """Fails if the law on a device that is led begins with other parameters than those that were set, or what is
        felt of it in the end is not their spring's force, as exactly as the encoder shows where the tool is."""
        self.spring("--device", PANTOGRAPH, "--uncertified")
        step = 2 * math.pi / 65536  # of the pantograph's encoder [rad]
        felt = json.loads(self.node("""
          import { load } from './spring/index.js';
          const law = await load(), felt = [];
          for (const K of [0.125, 0.03125, 0]) {
            law.set({ K });
            law.leadFrom(0.25);
            let now;
            for (let k = 0; k < 3000; ++k) now = law.lead(0.25, 0);
            felt.push([K, law.parameters.K, now.feltForce]);
          }
          console.log(JSON.stringify(felt));
        """))
        for stiffness, kept, force in felt:
            self.assertEqual(kept, stiffness)
            self.assertAlmostEqual(force, stiffness * 0.25, delta=stiffness * step)

    def test_a_led_device_refuses_what_is_no_motion(self):
        """Fails if a device is led to where nothing is, or if it has noticed when that was refused."""
        self.spring("--device", PANTOGRAPH, "--uncertified")
        self.node("""
          import { deepEqual, throws } from 'node:assert/strict';
          import { load } from './spring/index.js';
          const one = await load(), other = await load();
          throws(() => one.lead(0.1, 0), { name: 'RangeError', message: 'a motion begins with leadFrom(position)' });
          one.leadFrom(0.1);
          other.leadFrom(0.1);
          for (const wrong of [NaN, Infinity, -Infinity, undefined, '0.1']) {
            throws(() => one.leadFrom(wrong), { name: 'RangeError', message: `position is ${wrong}; a finite number is expected` });
            throws(() => one.lead(wrong, 0), { name: 'RangeError', message: `position is ${wrong}; a finite number is expected` });
            throws(() => one.lead(0.1, wrong), { name: 'RangeError', message: `velocity is ${wrong}; a finite number is expected` });
            deepEqual(one.lead(0.1, 0), other.lead(0.1, 0));
          }
        """)

    def test_types(self):
        """Fails if TypeScript does not find the types, or they let through what the module throws at."""
        self.dashpot("compile", TUNABLE, "--target", "wasm", "-o", self.folder)
        self.dashpot("compile", FIG_5, "--target", "wasm", "-o", self.folder)
        good = """
          import { load, rate, parameters, type Command, type Response } from './second_order_maxwell_tunable/index.js';
          import * as fixed from './second_order_maxwell/index.js';
          const law = await load();
          const now: Command = law.step(0, 0);
          law.set({ K1: parameters.K1.max });
          const all: Response = law.simulate(new Float32Array(3), null, { start: null, values: { K1: [1, 2, 3] } });
          const sum: number = now.damping + now.force + all.force[0]! + law.parameters.K1 + rate;
          const other: fixed.Law = await fixed.load(new Uint8Array(3));
          other.reset();
          console.log(sum);
        """
        (self.folder / "package.json").write_text('{ "type": "module" }')

        wrong = ["law.set({ softness: 1 });", "other.set({ K1: 1 });", "law.step(1);", "law.leadFrom(0);",
                 "new fixed.Law();",
                 "now.torque;", "law.simulate([0], null, { values: { K1: 1 } });"]
        (self.folder / "main.ts").write_text(good + "".join(f"\n// @ts-expect-error\n{line}" for line in wrong))
        done = subprocess.run([TSC, "--strict", "--noEmit", "--target", "es2022", "--module", "node16",
                               "--moduleResolution", "node16",
                               "--lib", "es2022,dom", "main.ts"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual((done.stdout, done.returncode), ("", 0))


class Refusals(WasmTest):
    def test_compiler(self):
        """Fails if a clang that is missing is not said, with what would do, or something is written."""
        done = self.dashpot("compile", FIG_5, "--target", "wasm", "-o", self.folder / "out", status=1,
                            DASHPOT_CLANG="/nowhere/clang++")
        self.assertIn("error: no WebAssembly is made of 'second_order_maxwell': '/nowhere/clang++' cannot be started "
                      "[no-web-module]",
                      done.stderr)
        self.assertIn("DASHPOT_CLANG names another clang++", done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_package(self):
        """Fails if the package has other files than it says, or an option that it has nothing for passes without a
        message."""
        self.dashpot("compile", FIG_5, "--target", "wasm", "-o", self.folder)
        package = self.folder / "second_order_maxwell"
        self.assertEqual(sorted(path.name for path in package.iterdir()),
                         ["index.d.ts", "index.js", "package.json", "second_order_maxwell.wasm"])
        self.assertEqual(json.loads((package / "package.json").read_text())["type"], "module")
        done = self.dashpot("compile", FIG_5, "--target", "wasm", "--batch", "-o", self.folder / "out", status=2)
        self.assertIn("--target wasm does not support --batch", done.stderr)


if __name__ == "__main__":
    unittest.main()
