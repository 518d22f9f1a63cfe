"""Plays emitted units for co-simulation, and holds them against the FMI standard.

The environment names DASHPOT (the executable), DASHPOT_SOURCE (this repository), CC and CLANG.
"""
import copy
import ctypes
import os
import pathlib
import platform
import random
import struct
import subprocess
import tempfile
import unittest

from importer import DISCARD, ERROR, OK, WARNING, Fmu, Instance
from standard import FUNCTIONS, description_breaches

DASHPOT, CC, CLANG = os.environ["DASHPOT"], os.environ["CC"], os.environ["CLANG"]
SOURCE = pathlib.Path(os.environ["DASHPOT_SOURCE"])
ROWS = 3000
PERIOD = 0.001

# Networks, options, and what they are called here.
LAWS = {"linear": ("paper/second_order_maxwell", []), "narrow": ("paper/second_order_maxwell", ["--scalar", "float"]),
        "slips": ("paper/visco_elasto_plastic", []), "turning": ("TURNING", []),
        "tunable": ("tunable/standard_solid_tunable", []),
        "rubbing": ("tunable/friction_tunable", ["--scalar", "float"])}
TURNING = '{ "dashpot": 1, "name": "turning", "motion": "rotation", ' \
          '"network": { "parallel": [ { "spring": "2 N m/rad" }, { "damper": "0.1 N m s/rad" } ] } }'


def ran(*command, status=0, **more):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=120, **more)
    if done.returncode != status:
        raise AssertionError(f"{command}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def as_float(number):
    return struct.unpack("f", struct.pack("f", number))[0]


def motion():
    """Moves of all sizes and rests."""
    chance, position, rows = random.Random(3), 0.0, []
    for n in range(ROWS):
        step = chance.uniform(-1, 1) * 10 ** chance.uniform(-8, -3) if n % 40 < 30 else 0.0
        position += step
        rows.append((position, step / PERIOD))
    return rows


class Units(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        (cls.folder / "turning.json").write_text(TURNING)
        cls.units = {}
        for name, (network, options) in LAWS.items():
            for version in (2, 3):
                target = cls.folder / f"{name}{version}"
                ran(DASHPOT, "compile", cls.network(network), "--name", name, "--target", f"fmi{version}", *options,
                    "-o", target)
                cls.units[name, version] = Fmu(target / f"{name}.fmu", target / "unpacked")

    @classmethod
    def network(cls, name):
        return cls.folder / "turning.json" if name == "TURNING" else SOURCE / f"networks/{name}.json"

    def each_unit(self):
        return [(name, fmu) for (name, _), fmu in self.units.items()]

    def instance(self, fmu, **more):
        made = Instance(fmu, **more)
        if made.pointer:
            self.addCleanup(made.free)
        return made

    def started(self, fmu):
        made = self.instance(fmu)
        self.assertEqual(made.begin(), OK, made.said)
        return made

    def schedule(self, fmu):
        """For each parameter, where it is in its range from one row to the next: now and then it jumps."""
        chance, values = random.Random(5), {}
        for v in fmu.description.find("ModelVariables"):
            if v.get("causality") == "parameter":
                facts = v.find("Real") if fmu.version == 2 else v
                low, high = float(facts.get("min")), float(facts.get("max"))
                jumps = [float(facts.get("start"))] + [as_float(chance.uniform(low, high)) for _ in range(ROWS // 100)]
                values[v.get("name")] = [jumps[k // 100 + (k % 100 > 60)] for k in range(ROWS)]
        return values

    def played(self, unit, rows, first=0, values={}):
        found = []
        for k, (position, velocity) in enumerate(rows, first):
            if values:
                self.assertEqual(unit.set(**{name: column[k] for name, column in values.items()}), OK)
            self.assertEqual(unit.set(position=position, velocity=velocity), OK)
            self.assertEqual(unit.step(k * PERIOD, PERIOD), OK, unit.said)
            found.append(unit.get("damping", "force"))
        return found

    def simulated(self, name, rows, values):
        network, options = LAWS[name]
        file = self.folder / "motion.csv"
        file.write_text(",".join(["time", "position", "velocity", *values]) + "\n" + "".join(
            ",".join(map(repr, [k * PERIOD, u, v, *(column[k] for column in values.values())])) + "\n"
            for k, (u, v) in enumerate(rows)))
        ran(DASHPOT, "simulate", self.network(network), "--input", file, "-o", self.folder / "simulated.csv", *options)
        lines = [line.split(",") for line in (self.folder / "simulated.csv").read_text().splitlines()]
        columns = [lines[0].index(column) for column in ("damping", "motor_force")]
        narrowed = as_float if "float" in options else float
        return [tuple(narrowed(float(line[column])) for column in columns) for line in lines[1:]]

    def test_same_bits_as_simulate(self):
        """Fails if a unit answers one of 3000 samples otherwise than `simulate`, by one bit."""
        rows = motion()
        for name, fmu in self.each_unit():
            values = self.schedule(fmu)
            self.assertEqual(len(values), {"tunable": 1, "rubbing": 3}.get(name, 0))
            expected = self.simulated(name, rows, values)
            self.assertGreater(max(force for _, force in expected), 1e-4)
            found = self.played(self.started(fmu), rows, values=values)
            self.assertEqual(sum(a == b for a, b in zip(found, expected, strict=True)), ROWS)

    def test_the_networks_of_the_paper(self):
        """Fails if a unit of one of them breaks a rule of the standard, or a bit of it is not that of `simulate`.

        Every fourth network, in either version and scalar; tests/targets/ plays all."""
        rows = motion()[:300]
        for path in sorted((SOURCE / "networks/paper").glob("*.json"))[::4]:
            for version, scalar in [(2, "double"), (3, "float")]:
                target = self.folder / f"{path.stem}_{version}"
                options = ["--scalar", scalar]
                ran(DASHPOT, "compile", path, "--target", f"fmi{version}", *options, "-o", target)
                fmu = Fmu(target / f"{path.stem}.fmu", target / "unpacked")
                self.assertEqual(description_breaches(fmu.description), [])
                LAWS[path.stem] = (f"paper/{path.stem}", options)
                self.assertEqual(self.played(self.started(fmu), rows), self.simulated(path.stem, rows, {}), path.stem)

    def test_exports_the_standard_and_needs_no_heap(self):
        """Fails if a function of the standard is missing or another is there, or the library needs more than memcpy and
        memset."""
        for name, fmu in self.each_unit():
            lines = [line.split() for line in ran("nm", "-D", fmu.library_path).splitlines()]
            self.assertEqual({words[-1] for words in lines if words[-2] in "TBDR"}, FUNCTIONS[fmu.version])
            needed = {words[-1].split("@")[0] for words in lines if words[-2] == "U"}
            self.assertLessEqual(needed, {"memcpy", "memset"})

    def test_descriptions_keep_the_standard(self):
        """Fails if modelDescription.xml breaks a rule of the standard, or names what is not in the archive."""
        for name, fmu in self.each_unit():
            self.assertEqual(description_breaches(fmu.description), [])
            sources = [f"sources/{name}.c"] + (["sources/buildDescription.xml"] if fmu.version == 3 else [])
            library = str(fmu.library_path.relative_to(fmu.folder))
            self.assertEqual(fmu.names, sorted([library, "documentation/index.html", "modelDescription.xml", *sources]))

    def test_the_rules_see_breaches(self):
        """Fails if the rules of the test before let pass what importers refuse."""
        for version in (2, 3):
            good = self.units["linear", version].description
            def spoilt(change):
                root = copy.deepcopy(good)
                change(root)
                return description_breaches(root)
            variables = lambda root: root.find("ModelVariables")
            self.assertTrue(spoilt(lambda root: root.attrib.pop("instantiationToken" if version == 3 else "guid")))
            self.assertTrue(spoilt(lambda root: root.find("CoSimulation").set("canBeStartedTwice", "true")))
            self.assertTrue(spoilt(lambda root: variables(root)[1].set("name", "velocity")))
            self.assertTrue(spoilt(lambda root: variables(root)[3].set("variability", "continuous")))
            self.assertTrue(spoilt(lambda root: variables(root).remove(variables(root)[0])))
            self.assertTrue(spoilt(lambda root: root.find("UnitDefinitions").remove(root.find("UnitDefinitions")[0])))
            self.assertTrue(spoilt(lambda root: root.find("ModelStructure").remove(root.find("ModelStructure")[0])))
            self.assertTrue(spoilt(lambda root: root.insert(0, root.find("ModelStructure"))))

    def test_units_of_a_rotation(self):
        """Fails if a law that turns is described in metres."""
        for version in (2, 3):
            root = self.units["turning", version].description
            powers = {unit.get("name"): dict(unit[0].items()) for unit in root.iter("Unit")}
            self.assertEqual(powers, {"s": {"s": "1"}, "rad": {"rad": "1"}, "rad/s": {"rad": "1", "s": "-1"},
                                      "N m": {"kg": "1", "m": "2", "s": "-2"},
                                      "N m s/rad": {"kg": "1", "m": "2", "s": "-1", "rad": "-1"}})

    def test_steps(self):
        """Fails if a step that is no multiple of the period or begins elsewhere passes, or a refused one moves
        anything."""
        rows = motion()[:20]
        for name, fmu in self.each_unit():
            unit, other = self.started(fmu), self.started(fmu)
            self.played(unit, rows), self.played(other, rows)
            before = unit.get("damping", "force", "time")
            # where FMI 2 has an error for a step that is not carried out at all, FMI 3 has this for what leaves all as
            # it was, and may go on with other arguments
            refused = {2: (ERROR, b"logStatusError"), 3: (DISCARD, b"logStatusDiscard")}[fmu.version]
            for length in (0.00037, 0.0015):
                self.assertEqual(unit.step(0.02, length), refused[0], length)
                self.assertEqual(unit.said[-1], (*refused, "a step is a multiple of the period of the law, which is "
                                                           "0.001 s"))
            for now, length in [(0.02, 0.0), (0.02, -0.001), (0.02, float("nan")), (0.02, float("inf")),
                                (0.019, 0.001), (0.021, 0.001), (float("nan"), 0.001), (-1.0, 0.001)]:
                self.assertEqual(unit.step(now, length), ERROR, (now, length))
            self.assertEqual(unit.get("damping", "force", "time"), before)
            unit.set(position=0.002, velocity=0.01)
            self.assertEqual(unit.step(0.02, 0.003), OK, unit.said)
            self.assertEqual([unit.get("damping", "force")], self.played(other, [(0.002, 0.01)] * 3, 20)[-1:])
            self.assertEqual(unit.get("time"), (0.023,))

    def test_where_a_step_begins(self):
        """Fails if a step that begins within half a period of where the last has ended is refused, as that of a host
        whose sums of times drift, or one that begins farther away is taken."""
        for version in (2, 3):
            unit = self.instance(self.units["linear", version])
            self.assertEqual(unit.begin(2.0), OK)
            for k, off in enumerate([-0.49, 0.49, -0.49]):
                end = 2.0 + k * PERIOD
                for too_far in (-0.51, 0.51):
                    self.assertEqual(unit.step(end + too_far * PERIOD, PERIOD), ERROR)
                self.assertEqual(unit.step(end + off * PERIOD, PERIOD), OK, unit.said)

    def test_a_day_of_steps_whose_times_are_summed_up(self):
        """Fails if an importer that adds up its times is refused after a while, for their rounding."""
        unit = self.started(self.units["linear", 3])
        now, length = 0.0, 0.1
        for k in range(100_000):
            if unit.step(now, length) != OK:
                self.fail(f"step {k}: {unit.said[-1]}")
            now += length

    def test_states(self):
        """Fails if a state that is gone back to, or one that was written and read, goes on otherwise, or a foreign one
        is taken."""
        rows = motion()[:60]
        for name, fmu in self.each_unit():
            unit = self.started(fmu)
            self.played(unit, rows[:30])
            place = ctypes.c_void_p()
            self.assertEqual(unit.state("Get", ctypes.byref(place)), OK)
            expected = self.played(unit, rows[30:], 30)
            self.assertEqual(unit.state("Set", place), OK)
            self.assertEqual(self.played(unit, rows[30:], 30), expected)

            size = ctypes.c_size_t()
            name_of = {3: ("SerializedFMUStateSize", "SerializeFMUState", "DeserializeFMUState"),
                       2: ("SerializedFMUstateSize", "SerializeFMUstate", "DeSerializeFMUstate")}[fmu.version]
            self.assertEqual(unit.call(name_of[0], place, ctypes.byref(size)), OK)
            text = ctypes.create_string_buffer(size.value)
            self.assertEqual(unit.call(name_of[1], place, text, ctypes.c_size_t(size.value - 1)), ERROR)
            self.assertEqual(unit.call(name_of[1], place, text, size), OK)
            other, read = self.started(fmu), ctypes.c_void_p()
            self.assertEqual(other.call(name_of[2], text, size, ctypes.byref(read)), OK)
            self.assertEqual(other.state("Set", read), OK)
            self.assertEqual(self.played(other, rows[30:], 30), expected)
            self.assertEqual(other.call(name_of[2], text, ctypes.c_size_t(size.value - 1), ctypes.byref(read)), ERROR)
            text[0] = b"x"
            self.assertEqual(other.call(name_of[2], text, size, ctypes.byref(read)), ERROR)
            for owner, state in [(unit, place), (other, read)]:
                self.assertEqual(owner.state("Free", ctypes.byref(state)), OK)
                self.assertIsNone(state.value)

    def test_derivatives(self):
        """Fails if a linear law's derivatives are not its slopes, or others claim to have some."""
        for name, fmu in self.each_unit():
            attribute = fmu.description.find("CoSimulation").get("providesDirectionalDerivative" +
                                                                 "s" * (fmu.version == 3))
            unit = self.started(fmu)
            self.played(unit, motion()[:25])
            if name in ("slips", "tunable", "rubbing"):
                self.assertEqual(attribute, "false")
                self.assertEqual(unit.derivatives(["force"], ["position"], [1.0]), ERROR)
                continue
            self.assertEqual(attribute, "true")
            place, answers = ctypes.c_void_p(), []
            unit.state("Get", ctypes.byref(place))
            self.addCleanup(lambda unit=unit, place=place: unit.state("Free", ctypes.byref(place)))
            base = (0.001, 0.02)
            for position, velocity in [base, (base[0] + 0.5, base[1]), (base[0], base[1] + 0.5)]:
                unit.state("Set", place)
                answers += self.played(unit, [(position, velocity)], 25)
            unit.state("Set", place)
            tolerance = 1e-5 if name == "narrow" else 1e-12  # of the rounding of two forces as large as the slope
            for known, changed in [("position", answers[1]), ("velocity", answers[2])]:
                damping, force = unit.derivatives(["damping", "force"], [known], [1.0])
                self.assertEqual(damping, 0)
                slope = (changed[1] - answers[0][1]) / 0.5
                self.assertLessEqual(abs(force - slope), tolerance * max(1, abs(slope)))
                self.assertEqual(unit.derivatives(["force"], [known], [-4.0]), (-4 * force,))
            self.assertEqual(unit.derivatives(["time"], ["position"], [1.0]), ERROR)
            self.assertEqual(unit.derivatives(["force"], ["force"], [1.0]), ERROR)

    def test_derivatives_before_the_start(self):
        """Fails if in Initialization Mode, where the law rests wherever the position is set, the derivatives are others
        than those of the outputs there, as of a tool that moves within one sample."""
        for name, static_stiffness in [("linear", 5), ("narrow", 5), ("turning", 2)]:  # the spring beside all others
            for version in (2, 3):
                unit = self.instance(self.units[name, version])
                self.assertEqual(unit.enter(), OK)
                for seed in [(1.0, 0.0), (0.0, 1.0), (-4.0, 0.5)]:
                    unit.set(position=seed[0], velocity=seed[1])  # at rest at 0 the force is 0
                    self.assertEqual(unit.derivatives(["damping", "force"], ["position", "velocity"], seed),
                                     (0, unit.get("force")[0]))
                self.assertEqual(unit.derivatives(["force"], ["position"], [1.0]), (static_stiffness,))

    def test_parameters(self):
        """Fails if a parameter is taken beyond its range, what is refused moves one, or one that is set before the
        start comes late."""
        for version in (2, 3):
            unit = self.instance(self.units["tunable", version])
            self.assertEqual((unit.get("K1"), unit.set(K1=300.0), unit.get("K1")), ((200,), OK, (300,)))
            self.assertEqual(unit.enter(), OK)
            self.assertEqual(unit.set(K1=1000.0, position=0.01), WARNING)
            status, category, message = unit.said[-1]
            self.assertEqual((status, category), (WARNING, b"logStatusWarning"))
            self.assertIn("a parameter is beyond its range", message)
            self.assertEqual(unit.get("K1"), (800,))
            self.assertEqual(unit.call("ExitInitializationMode"), OK)
            at_rest = unit.get("force")[0]
            self.assertLessEqual(abs(at_rest - 0.01 / (1 / 800 + 1 / 600)), 1e-12)  # both springs in series, rounding
            self.assertEqual(unit.set(K1=float("nan")), ERROR)
            self.assertEqual(unit.get("K1"), (800,))
            self.assertEqual(unit.set(K1=1.0), WARNING)
            self.assertEqual(unit.get("K1"), (50,))
            self.assertEqual(unit.call("Reset"), OK)
            self.assertEqual(unit.get("K1"), (200,))

    def test_categories_of_messages(self):
        """Fails if a message has a category that the description does not name, one of these is refused, or another is
        taken."""
        for name, fmu in self.each_unit():
            unit = self.instance(fmu)
            named = [category.get("name").encode() for category in fmu.description.iter("Category")]
            self.assertEqual(unit.debug_logging(True, named), OK)
            self.assertEqual(unit.debug_logging(True, [b"logEvents"]), ERROR)
            self.assertEqual([said[:2] for said in unit.said], [(ERROR, b"logStatusError")])
            discards = {b"logStatusDiscard"} if fmu.version == 3 else set()
            self.assertEqual(set(named), {b"logStatusError", b"logStatusWarning"} | discards)

    def test_messages_that_are_asked_for(self):
        """Fails if a warning or a discarded step is told of to a host that has not asked for it, or not to one that
        has, or an error is kept from anyone."""
        for version in (2, 3):
            unit = self.instance(self.units["tunable", version], logging=False)
            self.assertEqual(unit.begin(), OK)
            others = [WARNING, DISCARD] if version == 3 else [WARNING]
            for on, categories, told in [(None, [], []), (True, [b"logStatusError"], []),
                                         (True, [b"logStatusWarning"], [WARNING]), (True, [], others),
                                         (False, [b"logStatusWarning"], others[1:]), (False, [], [])]:
                if on is not None:
                    self.assertEqual(unit.debug_logging(on, categories), OK)
                unit.said.clear()
                self.assertEqual(unit.set(K1=1e6), WARNING)
                self.assertEqual(unit.step(0.0, 1.5 * PERIOD), DISCARD if version == 3 else ERROR)
                self.assertEqual(unit.step(1.0, PERIOD), ERROR)
                self.assertEqual([status for status, _, _ in unit.said if status != ERROR], told)
                self.assertEqual(unit.said[-1][0], ERROR)

    def test_calls_out_of_turn(self):
        """Fails if a unit steps before its start or after its end, answers what it has not or takes NaN or infinity."""
        for name, fmu in self.each_unit():
            unit = self.instance(fmu)
            self.assertEqual(unit.step(0.0, PERIOD), ERROR)
            self.assertEqual(unit.call("ExitInitializationMode"), ERROR)
            self.assertEqual(unit.enter(2.0), OK)
            self.assertEqual(unit.enter(2.0), ERROR)
            self.assertEqual(unit.set(position=0.01), OK)
            at_rest = unit.get("force", "time")
            self.assertEqual(at_rest[1], 2.0)
            self.assertEqual(unit.call("ExitInitializationMode"), OK)
            self.assertEqual(unit.get("force"), at_rest[:1])
            self.assertEqual(unit.set(position=float("nan")), ERROR)
            self.assertEqual(unit.call("SetFloat64" if fmu.version == 3 else "SetReal", *unit.which(["force"]),
                                       (ctypes.c_double * 1)(1),
                                       *[ctypes.c_size_t(1)] * (fmu.version == 3)), ERROR)
            self.assertEqual(unit.get(99), ERROR)
            self.assertEqual(unit.step(2.0, PERIOD), OK)
            self.assertEqual(unit.get("force"), at_rest[:1])  # it has rested there
            none = (unit.which([])[0], ctypes.c_size_t(0), None) + (ctypes.c_size_t(0),) * (fmu.version == 3)
            one = unit.which([1]) + (ctypes.create_string_buffer(8),) + (ctypes.c_size_t(1),) * (fmu.version == 3)
            kind = "Int32" if fmu.version == 3 else "Integer"
            self.assertEqual([unit.call(f"Get{kind}", *none), unit.call(f"Get{kind}", *one),
                              unit.call(f"Set{kind}", *one)], [OK, ERROR, ERROR])
            self.assertEqual(unit.call("EnterEventMode"), ERROR)
            self.assertEqual(unit.call("Terminate"), OK)
            self.assertEqual(unit.step(2.0 + PERIOD, PERIOD), ERROR)
            self.assertEqual(unit.call("Reset"), OK)
            self.assertEqual(unit.begin(), OK)
            self.assertEqual(unit.get("position", "force"), (0, 0))

    def test_instances(self):
        """Fails if a unit is made with a foreign token or for another use, if places run out without a warning, or one
        is lost when freed."""
        for name, fmu in self.each_unit():
            for more in [{"token": "other"}, {"kind": "ModelExchange"}]:
                refused = self.instance(fmu, **more)
                self.assertIsNone(refused.pointer)
                self.assertEqual(refused.said[0][0], ERROR)
            for _ in range(3):
                made = [Instance(fmu) for _ in range(16)]
                self.assertTrue(all(one.pointer for one in made))
                refused = Instance(fmu)
                self.assertIsNone(refused.pointer)
                self.assertIn("all places for instances are taken", refused.said[0][2])
                for one in made:
                    one.free()

    def test_names_of_instances(self):
        """Fails if a message does not say from which instance it comes, where there are two, or a name that is longer
        than its place is cut within a character or written beyond it."""
        fmu = self.units["linear", 2]
        for name, said in [(b"left", b"left"), (b"right", b"right"), (b"x" * 1000, b"x" * 255),
                           (("x" + "ä" * 200).encode(), ("x" + "ä" * 127).encode()),
                           (("ä" * 200).encode(), ("ä" * 127).encode()), (b"\x80" * 300, b"")]:
            unit = self.instance(fmu, name=name)
            self.assertEqual(unit.step(0.0, PERIOD), ERROR)
            self.assertEqual(unit.speakers, [said])

    def test_the_source_inside(self):
        """Fails if the source in the archive does not compile where the strictest read it, or makes a library of other
        bits, also where multiplications and additions can be one."""
        strict = "-std=c99 -pedantic -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Werror".split()
        strict += ["-O2", "-fPIC", "-shared"]
        strict += ["-Wno-unused-function", "-Wno-unused-const-variable"]  # what is for others in the law's header
        rows = motion()[:300]
        for name, fmu in self.each_unit():
            if fmu.version == 2 and name != "linear":
                continue  # what both versions have in common is read in the other
            expected = self.played(self.started(fmu), rows)
            library = fmu.folder / "own.so"
            ran(CLANG, *strict, fmu.folder / f"sources/{name}.c", "-o", library)
            if platform.machine() == "x86_64":  # whose processors have both in one only where that is asked for
                for compiler in (CLANG, CC):
                    ran(compiler, "-O2", "-mfma", "-fPIC", "-shared", fmu.folder / f"sources/{name}.c", "-o", library)
                    self.assertNotIn("vfm", ran("objdump", "-d", library))
            ran(CC, *strict, fmu.folder / f"sources/{name}.c", "-o", library)
            fmu = copy.copy(fmu)
            fmu.library = ctypes.CDLL(str(library))
            self.assertEqual(self.played(self.started(fmu), rows), expected)

    def test_equal_input_gives_equal_bytes(self):
        """Fails if an archive depends on when or where it was made."""
        for version in (2, 3):
            ran(DASHPOT, "compile", self.network("paper/second_order_maxwell"), "--name", "linear", "--target",
                f"fmi{version}", "-o",
                self.folder / "again", env={**os.environ, "TZ": "Asia/Tokyo"})
            self.assertEqual((self.folder / "again/linear.fmu").read_bytes(),
                             (self.folder / f"linear{version}/linear.fmu").read_bytes())

    def test_what_cannot_be_made(self):
        """Fails if a compiler that is missing or fails, or a folder that cannot be written to, leaves a file or no
        reason."""
        for version in (2, 3):
            command = [DASHPOT, "compile", self.network("paper/second_order_maxwell"), "--target", f"fmi{version}",
                       "-o", self.folder / "none"]
            told = ran(*command, status=1, env={**os.environ, "CC": "no-such-compiler"})
            self.assertIn("'no-such-compiler' does not compile the emitted code: cannot be started "
                          "[system-compiler-failed]", told)
            self.assertIn("CC names another than cc", told)
            self.assertIn("[system-compiler-failed]", ran(*command, status=1, env={**os.environ, "CC": "false"}))
            told = ran(*command, status=1, env={**os.environ, "CC": f"{CC} -m32"})
            self.assertIn("cannot be started; one program's name is expected, without options", told)
            told = ran(*command, status=1, env={**os.environ, "CC": "true"})
            self.assertIn("'true' does not compile the emitted code: it ends without an error and without a library "
                          "[system-compiler-failed]", told)
            self.assertFalse((self.folder / "none").exists())
            told = ran(*command[:-1], "/dev/null/none", status=1)
            self.assertIn("[cannot-write-file]", told)
            self.assertIn("--target fmi", ran(*command, "--batch", status=2))


if __name__ == "__main__":
    unittest.main()
