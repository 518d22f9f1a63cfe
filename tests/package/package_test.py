"""Builds a user's project against dashpot, as a user would: in the source tree, and from an installed one.

    python3 package_test.py InTree|InTreeWithCompiler|Installed|Cross [-v]

The environment names what ctest knows: DASHPOT_SOURCE (this repository), DASHPOT_BUILD (where it is built),
DASHPOT_PREFIX (where it is installed), CMAKE_COMMAND, and the compiler to use in CXX.
"""
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import tempfile
import unittest
import zipfile

CMAKE = os.environ["CMAKE_COMMAND"]
PYTHON = "/usr/bin/python3"  # with NumPy
SOURCE = pathlib.Path(os.environ["DASHPOT_SOURCE"])
BUILD = pathlib.Path(os.environ["DASHPOT_BUILD"])
PREFIX = pathlib.Path(os.environ["DASHPOT_PREFIX"])
CONSUMER = SOURCE / "tests/package/consumer"
OWN_DEPENDENCIES = ["Eigen3", "nlohmann_json", "fmt", "CLI11", "Boost", "OpenSSL"]
COMPILING_A_LAW = "Compiling network"


class Project:
    """A copy of the consumer with a build folder of its own."""

    def __init__(self, folder, options):
        self.folder = pathlib.Path(folder)
        shutil.copytree(CONSUMER, self.folder, dirs_exist_ok=True)
        shutil.copytree(SOURCE / "templates", self.folder / "templates",
                        ignore=lambda _, names: [n for n in names if not n.endswith(".in")])
        self.build_folder = self.folder / "build"
        self.run(CMAKE, "-G", "Ninja", "-S", self.folder, "-B", self.build_folder,
                 "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON",
                 f"-DPAPER_SOLID={SOURCE / 'networks/paper/second_order_maxwell.json'}",
                 f"-DOWN_LOOP={SOURCE / 'runtime/examples/own_loop.cpp'}", *options)

    def run(self, *command, **more):
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True, **more)
        assert done.returncode == 0, f"{command} failed:\n{done.stdout}{done.stderr}"
        return done.stdout

    def build(self, target="press"):
        return self.run(CMAKE, "--build", self.build_folder, "--target", target)

    def refused_build(self, target="all"):
        done = subprocess.run([CMAKE, "--build", self.build_folder, "--target", target], capture_output=True, text=True)
        assert done.returncode != 0, f"built what cannot be built:\n{done.stdout}"
        return done.stdout + done.stderr

    def press(self):
        """What the program prints: the device and period it was compiled for, and the commands of both tissues."""
        printed = self.run(self.build_folder / "press", input=motion(1))
        heading, *rows = printed.splitlines()
        return heading, [tuple(float(number) for number in row.split(",")) for row in rows]

    def replace(self, file, old, new):
        path = self.folder / file
        text = path.read_text()
        assert old in text, f"{file} does not say {old}"
        path.write_text(text.replace(old, new))


def motion(rate):
    """Rows time,position,velocity: in, back and held, at velocities that are no round binary numbers."""
    rows, position = [], 0.0
    for i in range(120):
        velocity = 0.1 if i < 50 else -0.07 if i < 80 else 0.0
        position += velocity * 1e-3
        rows.append(f"{i / rate!r},{position!r},{velocity!r}\n")
    return "".join(rows)


def simulate(dashpot, project, network, rate, *choices):
    """The commands that `dashpot simulate` computes: an account of the law that no emitted code takes part in."""
    csv = project.folder / f"{network}.csv"
    csv.write_text("time,position,velocity\n" + motion(rate))
    printed = project.run(dashpot, "simulate", project.folder / f"{network}.json", "--input", csv, *choices)
    return [tuple(float(number) for number in row.split(",")[4:]) for row in printed.splitlines()[1:]]


def single(number):
    """The float nearest to a decimal number: what the digits of a float printed by simulate stand for."""
    return struct.unpack("f", struct.pack("f", number))[0]


class Consumer:
    """What holds in either tree. The project is built once; each test changes it and begins with it as it was."""

    @classmethod
    def setUpClass(cls):
        folder = cls.enterClassContext(tempfile.TemporaryDirectory(prefix="consumer"))
        cls.project = Project(f"{folder}/project", cls.options())
        cls.first_build = cls.project.build()
        cls.as_built = f"{folder}/as_built"
        shutil.copytree(cls.project.folder, cls.as_built, symlinks=True)

    def setUp(self):
        # In the same place, since its files name it, and with the times at which they were written.
        self.addCleanup(shutil.copytree, self.as_built, self.project.folder, symlinks=True)
        self.addCleanup(shutil.rmtree, self.project.folder)

    # Fails if what a user's build runs is not the law of the network, device and choices that the build names.
    def check_commands(self):
        heading, rows = self.project.press()
        self.assertEqual(heading, "# training_arm, 0.00050000000000000001 s")
        fine = simulate(self.dashpot(), self.project, "tissue", 2000, "--device", self.project.folder / "arm.json")
        coarse = simulate(self.dashpot(), self.project, "coarse_tissue", 200, "--scheme", "backward-euler",
                          "--state-input", "velocity", "--decomposition", "virtual", "--scalar", "float")
        self.assertEqual([row[:2] for row in rows], fine)
        self.assertEqual([row[2:] for row in rows], [tuple(map(single, row)) for row in coarse])

    # Fails if FMU leaves out the unit, makes one of another law, or says that it is elsewhere.
    def check_unit(self):
        with zipfile.ZipFile((self.project.build_folder / "unit.txt").read_text()) as unit:
            self.assertIn("sources/coarse_tissue.c", unit.namelist())
            self.assertIn('fixedInternalStepSize="0.005"', unit.read("modelDescription.xml").decode())
            self.assertIn("scheme: backward-euler at 200 Hz, float", unit.read("sources/coarse_tissue.c").decode())
        self.project.build("all")
        self.assertTrue((self.project.build_folder / "unlinked/unlinked_tissue.fmu").exists())

    # Fails if PYTHON or WASM leaves something out, makes another law, or says that it is elsewhere.
    def check_others(self):
        rows = [tuple(float(number) for number in row.split(",")[1:]) for row in motion(200).splitlines()]
        coarse = simulate(self.dashpot(), self.project, "coarse_tissue", 200, "--scheme", "backward-euler",
                          "--state-input", "velocity", "--decomposition", "virtual", "--scalar", "float")
        package = (self.project.build_folder / "package.txt").read_text()
        script = f"import coarse_tissue\nlaw = coarse_tissue.Law()\nfor row in {rows}: print(*law.step(*row), sep=',')"
        told = self.project.run(PYTHON, "-B", "-c", script, env={**os.environ, "PYTHONPATH": package})
        module = (self.project.build_folder / "module.txt").read_text()
        script = (f"import {{ load }} from {json.dumps(module)};"
                  f"const law = await load();"
                  f"for (const [position, velocity] of {json.dumps(rows)}) {{"
                  f" const now = law.step(position, velocity); console.log(`${{now.damping}},${{now.force}}`); }}")
        run = self.project.run("node", "--input-type=module", "-e", script)
        for printed in [told, run]:
            commands = [tuple(single(float(number)) for number in row.split(",")) for row in printed.splitlines()]
            self.assertEqual(commands, [tuple(map(single, row)) for row in coarse])

    # Fails if a build with nothing to do does something.
    def check_rest(self):
        self.assertEqual(self.first_build.count(COMPILING_A_LAW), 2)
        self.assertIn("no work to do", self.project.build())


class InTree(Consumer, unittest.TestCase):
    """dashpot as a subdirectory of the user's project, which names a compiler that is built already."""

    @classmethod
    def options(cls):
        return [f"-DDASHPOT_SOURCE={SOURCE}", f"-DDASHPOT_COMPILER={cls.dashpot()}"]

    @classmethod
    def dashpot(cls):
        return PREFIX / "bin/dashpot"

    def test_commands_and_rest(self):
        self.check_commands()
        self.check_unit()
        self.check_others()
        self.check_rest()

    # Fails if a compiler that is not there is found out by a build that stops at the first law.
    def test_compiler_that_is_not_there(self):
        done = subprocess.run([CMAKE, "-S", self.project.folder, "-B", self.project.build_folder,
                               "-DDASHPOT_COMPILER=/nowhere/dashpot"], capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("DASHPOT_COMPILER is '/nowhere/dashpot'; a file that is there is expected", done.stderr)


class InTreeWithCompiler(unittest.TestCase):
    """dashpot as a subdirectory of the user's project, where nothing is built yet. What would be built is named, not
    built: the very commands that have built this compiler."""

    # Those of the outer build, so that commands can be compared.
    CHOICES = ["CMAKE_BUILD_TYPE", "CMAKE_CXX_COMPILER_LAUNCHER", "CMAKE_CXX_FLAGS", "CMAKE_CXX_FLAGS_DEBUG",
               "CMAKE_CXX_FLAGS_RELEASE", "CMAKE_CXX_FLAGS_RELWITHDEBINFO", "CMAKE_EXE_LINKER_FLAGS",
               "CMAKE_UNITY_BUILD", "CMAKE_UNITY_BUILD_BATCH_SIZE", "DASHPOT_PRECOMPILE", "DASHPOT_SANITIZE",
               "DASHPOT_WARNINGS_AS_ERRORS"]

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="consumer")
        cls.addClassCleanup(folder.cleanup)
        cache = (BUILD / "CMakeCache.txt").read_text()
        chosen = [match.group() for name in cls.CHOICES
                  for match in re.finditer(rf"^{name}:\w+=.*$", cache, re.MULTILINE)]
        cls.project = Project(folder.name, [f"-DDASHPOT_SOURCE={SOURCE}", *(f"-D{choice}" for choice in chosen)])

    def commands(self, build_folder, within):
        """What compiles and links the compiler, in words that do not say where."""
        listed = subprocess.run(["ninja", "-C", str(build_folder), "-t", "commands", f"{within}compiler/dashpot"],
                                capture_output=True, text=True, check=True).stdout
        here = f"{build_folder}/{within}".rstrip("/")
        return [line.replace(f"cd {build_folder} ", f"cd {here} ").replace(here, "BUILD").replace(f" {within}", " ")
                    .replace("=" + within, "=") for line in listed.splitlines()]

    # Fails if a user's build compiles dashpot in another way than the build that is tested here.
    def test_same_commands(self):
        expected = self.commands(BUILD, "")
        self.assertGreater(sum(" -c " in line for line in expected), 20)
        self.assertEqual(self.commands(self.project.build_folder, "dashpot/"), expected)

    # Fails if a law would be compiled before the compiler is there.
    def test_compiler_first(self):
        told = self.project.run("ninja", "-C", self.project.build_folder, "-n", "press")
        self.assertLess(told.index("Linking CXX executable dashpot/compiler/dashpot"), told.index(COMPILING_A_LAW))


class Installed(Consumer, unittest.TestCase):
    """dashpot found by find_package, in a folder that it was not installed to but moved to, without its
    dependencies."""

    @classmethod
    def setUpClass(cls):
        cls.prefix = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="moved"))) / "prefix"
        shutil.copytree(PREFIX, cls.prefix)
        super().setUpClass()

    @classmethod
    def options(cls):
        hidden = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in OWN_DEPENDENCIES]
        return [f"-DCMAKE_PREFIX_PATH={cls.prefix}", *hidden]

    @classmethod
    def dashpot(cls):
        return cls.prefix / "bin/dashpot"

    def test_commands(self):
        self.check_commands()
        self.check_unit()
        self.check_others()

    def test_rest(self):
        self.check_rest()

    # Fails if fused multiply-add could change the bits of a law in a user's build.
    def test_no_contraction(self):
        commands = (self.project.build_folder / "compile_commands.json").read_text()
        # press, press_surface, press_in_c and in_c_test, tissue_test, own_loop
        self.assertEqual(commands.count("-ffp-contract=off"), 6)

    # Fails if a servo loop cannot be linked, or if emitted tests are not built, not registered, or do not pass.
    def test_everything_else(self):
        self.project.build("all")
        self.assertRegex(self.project.run("ctest", "--test-dir", self.project.build_folder), "100% tests passed")

    # Fails if registers, constant time or points are asked for in vain.
    def test_options_of_the_law(self):
        self.project.build("press_surface")
        law = (self.project.build_folder / "surface/surface.hpp").read_text()
        self.assertIn("alignas(32) static constexpr scalar mode_gain[32]", law)  # whole registers, and rounds of four
        self.assertIn("#include <dashpot/branch_free.hpp>", law)
        self.assertIn("class surface_batch", (self.project.build_folder / "surface/surface_batch.hpp").read_text())
        self.project.run(self.project.build_folder / "press_surface")

    # Fails if a law in C is another, or does not know the device that it was compiled for.
    def test_law_in_c(self):
        self.project.build("press_in_c")
        told, *rows = self.project.run(self.project.build_folder / "press_in_c", input=motion(1)).splitlines()
        self.assertEqual(told, "# training_arm: certified")
        fine = simulate(self.dashpot(), self.project, "tissue", 2000, "--device", self.project.folder / "arm.json")
        self.assertEqual([tuple(float(number) for number in row.split(",")) for row in rows], fine)

    # Fails if a law that lacks damping is made unasked, or not though asked; or if its certificate is not that of its
    # header.
    def test_uncertified(self):
        self.project.build("hard_law")
        folder = self.project.build_folder
        verify = [self.dashpot(), "verify", folder / "hard_certificate.json", folder / "hard/hard.hpp"]
        self.assertEqual(subprocess.run(verify, capture_output=True).returncode, 1)
        self.project.run(*verify, "--allow-uncertified")
        self.project.replace("CMakeLists.txt", "UNCERTIFIED ", "")
        self.assertIn("[not-certified]", self.project.refused_build("hard_law"))
        self.assertFalse((folder / "hard").exists())

    # Fails if a target or a name that cannot be is taken.
    def test_what_cannot_be_made(self):
        for old, new, said in [("TARGET c99", "TARGET c89", "TARGET is 'c89'; cpp or c99 is expected"),
                               ("NAME tissue_in_c", "NAME 2nd",
                                "NAME is '2nd'; a name that a class can have is expected")]:
            self.project.replace("CMakeLists.txt", old, new)
            self.assertIn(said, " ".join(self.project.refused_build().split()))
            self.project.replace("CMakeLists.txt", new, old)

    # Fails if who builds without CMake does not find the headers, the loop, or the networks.
    def test_pkg_config(self):
        places = [path.parent for path in self.prefix.rglob("dashpot.pc")]
        self.assertEqual(len(places), 1)
        environment = dict(os.environ, PKG_CONFIG_PATH=str(places[0]))
        ask = lambda *words: self.project.run("pkg-config", *words, env=environment).split()
        self.project.build("paper_solid_law")
        program = self.project.folder / "without_cmake"
        self.project.run(os.environ.get("CXX", "c++"), "-std=c++17", "-I", self.project.build_folder / "paper_solid",
                         SOURCE / "runtime/examples/own_loop.cpp", *ask("--cflags", "--libs", "dashpot-servo"), "-o",
                         program)
        self.project.run(program)
        for room, file in [("networks", "paper/kelvin.json"), ("devices", "board_mps2.json"), ("firmware", "main.cpp")]:
            folder, = ask(f"--variable={room}dir", "dashpot")
            self.assertTrue((pathlib.Path(folder) / file).exists(), folder)

    # Fails if a change of the network's values does not reach the program.
    def test_changed_network(self):
        before = self.project.press()
        self.project.replace("tissue.json", "40 N/m", "80 N/m")
        self.assertEqual(self.project.build().count(COMPILING_A_LAW), 1)
        self.assertNotEqual(before, self.project.press())

    # Fails if a network that takes another name leaves the build looking for the old header.
    def test_renamed_network(self):
        self.project.replace("tissue.json", '"tissue"', '"liver"')
        self.project.replace("press.cpp", "<tissue.hpp>", "<liver.hpp>")
        self.project.replace("press.cpp", "generated::tissue", "generated::liver")
        before = self.project.press()
        self.project.build()
        self.assertEqual(before, self.project.press())
        self.assertFalse((self.project.build_folder / "tissue/tissue.hpp").exists())  # else a program may go on with it

    # Fails if a law goes on being certified for a device that has changed.
    def test_changed_device(self):
        self.project.replace("arm.json", "training_arm", "longer_arm")
        self.assertEqual(self.project.build().count(COMPILING_A_LAW), 1)
        self.assertTrue(self.project.press()[0].startswith("# longer_arm"))

    # Fails if laws of an old compiler survive a new one.
    def test_changed_compiler(self):
        was = self.dashpot().stat()
        self.addCleanup(os.utime, self.dashpot(), ns=(was.st_atime_ns, was.st_mtime_ns))
        self.dashpot().touch()
        self.assertEqual(self.project.build().count(COMPILING_A_LAW), 2)

    # Fails if a user's own template is not looked at again when it changes.
    def test_changed_template(self):
        self.project.replace("templates/network.hpp.in", "#pragma once", "#pragma once\n// for the training arm")
        self.assertEqual(self.project.build().count(COMPILING_A_LAW), 1)
        self.assertIn("// for the training arm", (self.project.build_folder / "tissue/tissue.hpp").read_text())

    # Fails if the compiler's message does not reach the user, or if a repaired network does not build.
    def test_refused_network(self):
        self.project.replace("tissue.json", "6 N s/m", "-6 N s/m")
        self.assertRegex(self.project.refused_build(), r"tissue\.json:6:\d+: error: .*\[negative-damping\]")
        self.project.replace("tissue.json", "-6 N s/m", "6 N s/m")
        self.project.build()

    # Fails if a file that is no JSON is reported by anything but the compiler, in its own words and with the place.
    def test_unreadable_network(self):
        self.project.replace("tissue.json", '"dashpot": 1,', '"dashpot": 1')
        self.assertRegex(self.project.refused_build(), r"tissue\.json:\d+:\d+: error: ")

    # Fails if an option that is misspelt, or lacks its value, is passed over in silence.
    def test_misspelt_option(self):
        self.project.replace("CMakeLists.txt", "RATE 200", "RAET 200")
        self.assertIn("RAET", self.project.refused_build())

    # Fails if an installed text file remembers the machine it was built on.
    def test_no_trace_of_the_build(self):
        for path in self.prefix.rglob("*"):
            if path.suffix in {".cmake", ".hpp", ".json"}:
                self.assertNotRegex(path.read_text(), re.escape(str(SOURCE)), path)


class Cross(unittest.TestCase):
    """A project for a 32-bit board without an operating system, with the installed dashpot or with its sources."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="cross")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        shutil.copytree(SOURCE / "tests/package/cross", self.folder, dirs_exist_ok=True)
        for file in ("tissue.json", "arm.json"):
            shutil.copy(CONSUMER / file, self.folder)

    # A launcher such as ccache, which the tests' own build may use, is not in every `path`.
    def run_cmake(self, *words, path=os.environ["PATH"]):
        environment = {key: value for key, value in os.environ.items() if not key.endswith("_COMPILER_LAUNCHER")}
        return subprocess.run([CMAKE, *map(str, words)], capture_output=True, text=True,
                              env=dict(environment, PATH=path))

    def configure(self, *options, path=os.environ["PATH"]):
        return self.run_cmake("-G", "Ninja", "-S", self.folder, "-B", self.folder / "build",
                              f"-DCMAKE_TOOLCHAIN_FILE={self.folder / 'toolchain.cmake'}", *options, path=path)

    def check_built(self):
        done = self.run_cmake("--build", self.folder / "build")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(self.folder / "build/firmware.elf", "rb") as file:
            header = file.read(20)
        self.assertEqual((header[:5], header[18]), (b"\x7fELF\x01", 40))  # 32 bits, Arm
        undefined = subprocess.run(["arm-none-eabi-nm", "-u", str(self.folder / "build/libsteps.a")],
                                   capture_output=True,
                                   text=True, check=True).stdout.split()
        self.assertEqual({name for name in undefined if name.startswith("dashpot")}, set())

    # Fails if what is installed for this machine cannot be found where a build is for a board.
    def test_installed(self):
        done = self.configure(f"-DCMAKE_PREFIX_PATH={PREFIX}")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.check_built()

    # Fails if the sources need a compiler for the board that makes a compiler, where one for this machine is at hand.
    def test_sources(self):
        done = self.configure(f"-DDASHPOT_SOURCE={SOURCE}", path=f"{PREFIX / 'bin'}:{os.environ['PATH']}")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.check_built()

    # Fails if a build without any dashpot for this machine is not told what is missing.
    def test_no_compiler_for_this_machine(self):
        tools = self.folder / "tools"
        tools.mkdir()
        for tool in ("ninja", "arm-none-eabi-gcc", "arm-none-eabi-g++", "arm-none-eabi-ar", "arm-none-eabi-ranlib"):
            (tools / tool).symlink_to(shutil.which(tool))
        done = self.configure(f"-DDASHPOT_SOURCE={SOURCE}", "-DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF", path=str(tools))
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("no dashpot that runs on this one is found: name it with", " ".join(done.stderr.split()))


if __name__ == "__main__":
    unittest.main()
