#!/usr/bin/env python3
"""targets_table.py DASHPOT: bytes and instructions a step of three laws, from each target that `dashpot compile` has
and on two boards.

Bytes are text and data, by `size`: of an object with one function that calls the law's step; of a component, a unit's
or a package's shared library with all that it exports; of a module for JavaScript those of the file. Instructions are
counted by callgrind, of a function that calls the law's step and keeps what it answers: of a unit it sets position and
velocity, does a step and gets both outputs; of a package for Python it is C that calls the library, a sample at a time.
On the boards QEMU counts them, beyond an empty step. A component runs in a process of LinuxCNC and a module in an
engine that compiles it: of these nothing is counted.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests/support"))
sys.path.insert(0, str(SOURCE / "tests/fmi"))
from cortex_m import FIRMWARE, PROCESSORS, compiling, linking, printed  # noqa: E402
from importer import Fmu  # noqa: E402

LAWS = {"second_order_maxwell": "paper", "visco_elasto_plastic": "paper", "second_order_maxwell_tunable": "tunable"}
STEPS = 1000
HOST = ["-O2", "-ffp-contract=off"]
DRIVER = """
  for (int n = 0; n < STEPS; ++n) one_step(1e-6 * (n % 100), 1e-4);
  return 0;
}
""".replace("STEPS", str(STEPS))
CPP = """#include "{name}.hpp"
dashpot::generated::{name} law;
dashpot::command<double> now;
extern "C" [[gnu::noinline]] void one_step(double u, double v) {{ now = law.step(u, v); }}
"""
C99 = """#include "{name}.h"
{name} law;
dashpot_command now;
__attribute__((noinline)) void one_step(double u, double v) {{ now = {name}_step(&law, u, v); }}
"""
# What is loaded, with the functions that a step calls.
LIBRARY = """#include <dlfcn.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
static void *library, *law;
static void *named(const char *name) {{
  void *const found = dlsym(library, name);
  if (found == NULL) exit(1);
  return found;
}}
{declared}
__attribute__((noinline)) void one_step(double u, double v) {{
  double answer[2];
  {step}
  if (!(answer[0] >= 0)) exit(2);
}}
static void say_nothing() {{}}
int main(void) {{
  library = dlopen("{library}", RTLD_NOW);
  if (library == NULL) return fprintf(stderr, "%s\\n", dlerror()), 1;
  {begin}
"""
PACKAGE = {"declared": "static void (*step)(void *, double, double, double *);", "step": "step(law, u, v, answer);",
           "begin": """law = malloc(((size_t (*)(void))named("dashpot_law_size"))());
  ((void (*)(void *))named("dashpot_law_init"))(law);
  step = (void (*)(void *, double, double, double *))named("dashpot_law_step");"""}
UNITS = {2: {"declared": """typedef const unsigned *refs;
static int (*set)(void *, refs, size_t, const double *), (*step)(void *, double, double, int), (*get)(void *, refs, size_t, double *);
static double now;""",
             "step": """if (set(law, (unsigned[]){INPUTS}, 2, (double[]){u, v}) || step(law, now, 1e-3, 1) || get(law, (unsigned[]){OUTPUTS}, 2, answer)) exit(3);
  now += 1e-3;""",
             "begin": """void *const calls[5] = {(void *)say_nothing, (void *)calloc, (void *)free, NULL, NULL};
  law = ((void *(*)(const char *, int, const char *, const char *, const void *, int, int))named("fmi2Instantiate"))("one", 1, "TOKEN", "", calls, 0, 0);
  set = (int (*)(void *, refs, size_t, const double *))named("fmi2SetReal");
  step = (int (*)(void *, double, double, int))named("fmi2DoStep");
  get = (int (*)(void *, refs, size_t, double *))named("fmi2GetReal");
  if (((int (*)(void *, int, double, double, int, double))named("fmi2SetupExperiment"))(law, 0, 0, 0, 0, 0)) return 4;
  if (((int (*)(void *))named("fmi2EnterInitializationMode"))(law)) return 5;
  if (((int (*)(void *))named("fmi2ExitInitializationMode"))(law)) return 6;"""},
         3: {"declared": """typedef const unsigned *refs;
static int (*set)(void *, refs, size_t, const double *, size_t), (*get)(void *, refs, size_t, double *, size_t);
static int (*step)(void *, double, double, bool, bool *, bool *, bool *, double *);
static double now;""",
             "step": """bool event, ends, early;
  double last;
  if (set(law, (unsigned[]){INPUTS}, 2, (double[]){u, v}, 2) || step(law, now, 1e-3, true, &event, &ends, &early, &last) ||
      get(law, (unsigned[]){OUTPUTS}, 2, answer, 2))
    exit(3);
  now += 1e-3;""",
             "begin": """law = ((void *(*)(const char *, const char *, const char *, bool, bool, bool, bool, refs, size_t, void *, void (*)(), void *))named(
      "fmi3InstantiateCoSimulation"))("one", "TOKEN", NULL, false, false, false, false, NULL, 0, NULL, say_nothing, NULL);
  set = (int (*)(void *, refs, size_t, const double *, size_t))named("fmi3SetFloat64");
  step = (int (*)(void *, double, double, bool, bool *, bool *, bool *, double *))named("fmi3DoStep");
  get = (int (*)(void *, refs, size_t, double *, size_t))named("fmi3GetFloat64");
  if (((int (*)(void *, bool, double, double, bool, double))named("fmi3EnterInitializationMode"))(law, false, 0, 0, false, 0)) return 5;
  if (((int (*)(void *))named("fmi3ExitInitializationMode"))(law)) return 6;"""}}
BOARD = """#include "{name}.hpp"
#include "support/board_instructions.hpp"
#include "support/semihosting.hpp"
int main() {{
  dashpot::testing::start_clock();
  dashpot::testing::print_number(dashpot::testing::instructions<dashpot::generated::{name}>(), 10, 1);
  dashpot::testing::end_program();
}}
"""


def ran(*command, **more):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, **more)
    if done.returncode != 0:
        sys.exit(f"{command}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def counted(program):
    """Instructions of one_step() and what it calls, a step."""
    with tempfile.TemporaryDirectory() as folder:
        said = ran("valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out", "--toggle-collect=one_step",
                   program)
    collected = int(re.search(r"Collected : (\d+)", said)[1])
    return f"{collected / STEPS:.0f}"


def loaded(file, tool="size"):
    text, data, *_ = ran(tool, file).splitlines()[1].split()
    return str(int(text) + int(data))


def in_language(folder, name, target):
    suffix, compiler, head = ("cpp", ["g++", "-std=c++17", f"-I{SOURCE}/runtime/include"],
                              CPP) if target == "cpp" else ("c", ["gcc", "-std=c99"], C99)
    begin = "int main() {" if target == "cpp" else f"int main(void) {{\n  {name}_init(&law);\n  {name}_reset(&law, 0);"
    (folder / f"law.{suffix}").write_text(head.format(name=name))
    (folder / f"main.{suffix}").write_text(head.format(name=name) + begin + DRIVER)
    ran(*compiler, *HOST, "-c", folder / f"law.{suffix}", "-o", folder / "law.o")
    ran(*compiler, *HOST, folder / f"main.{suffix}", "-o", folder / "main")
    return loaded(folder / "law.o"), counted(folder / "main")


def as_component(folder, name):
    ran("halcompile", "--compile", f"{name}.comp", cwd=folder)
    return loaded(folder / f"{name}.so"), "-"


def in_library(folder, library, texts):
    (folder / "main.c").write_text(LIBRARY.format(library=library, **texts) + DRIVER)
    ran("gcc", *HOST, folder / "main.c", "-ldl", "-o", folder / "main")
    return loaded(library), counted(folder / "main")


def as_unit(folder, name, version):
    unit = Fmu(folder / f"{name}.fmu", folder / "unit")
    references = lambda *names: ", ".join(str(unit.references[each]) for each in names)
    texts = {key: text.replace("TOKEN", unit.token).replace("INPUTS", references("position", "velocity"))
             .replace("OUTPUTS", references("damping", "force")) for key, text in UNITS[version].items()}
    return in_library(folder, unit.library_path, texts)


def as_package(folder, name):
    return in_library(folder, next((folder / name).rglob("*.so")), PACKAGE)


def on_board(folder, name, processor):
    options = compiling(processor, folder, FIRMWARE, SOURCE / "runtime/devices/board/include")
    (folder / "law.cpp").write_text(f'#include "{name}.hpp"\nusing law = dashpot::generated::{name};\n'
                                    "dashpot::command<law::scalar> one_step(law& now, law::scalar u, law::scalar v) { "
                                    "return now.step(u, v); }\n")
    (folder / "main.cpp").write_text(BOARD.format(name=name))
    ran("arm-none-eabi-g++", *options, "-c", folder / "law.cpp", "-o", folder / "law.o")
    ran("arm-none-eabi-g++", *options, *linking(folder / "main.cpp", folder / "play.elf"))
    return loaded(folder / "law.o", "arm-none-eabi-size"), printed(folder / "play.elf",
                                                                   PROCESSORS[processor][1]).strip()


ROWS = [("C++17", "cpp", "double", lambda *law: in_language(*law, "cpp")),
        ("C99", "c99", "double", lambda *law: in_language(*law, "c99")),
        ("LinuxCNC", "hal", "double", as_component), ("FMI 2.0", "fmi2", "double", lambda *law: as_unit(*law, 2)),
        ("FMI 3.0", "fmi3", "double", lambda *law: as_unit(*law, 3)), ("Python", "python", "double", as_package),
        ("JavaScript", "wasm", "double", lambda folder, name: (str((folder / name / f"{name}.wasm").stat().st_size),
                                                               "-")),
        ("Cortex-M4F, float", "cpp", "float", lambda *law: on_board(*law, "cortex_m4f")),
        ("Cortex-M7, double", "cpp", "double", lambda *law: on_board(*law, "cortex_m7"))]


def main():
    dashpot = pathlib.Path(sys.argv[1]).resolve()
    print("| target | " + " | ".join(f"{name}: bytes | instructions" for name in LAWS) + " |")
    print("| --- |" + " --- | --- |" * len(LAWS))
    for title, target, scalar, measure in ROWS:
        cells = []
        for name, room in LAWS.items():
            with tempfile.TemporaryDirectory() as folder:
                ran(dashpot, "compile", SOURCE / f"networks/{room}/{name}.json", "--target", target, "--scalar", scalar,
                    "-o", folder)
                cells += measure(pathlib.Path(folder), name)
        print(f"| {title} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main()
