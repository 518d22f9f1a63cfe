#!/usr/bin/env python3
"""Plants seeded faults in compiler/ and runtime/, one at a time, and reports which of them the tests miss.

  tests/mutation/plant_faults.py --work FOLDER [--count 200] [--seed 1] [--jobs 2] [--record FILE]

Works on clones of the last commit in FOLDER, one for each job, never on this tree. A fault that does not compile, or
that leaves the machine code as it was, is no fault: the next one takes its place. Tests of the room next to the fault
come first, then all others; the first red one ends the search. Faults that the quick tests leave open are planted again
at the end, for the slow ones. What is found out is appended to the record, a JSON object a line, and a run that is
started again goes on behind it."""
import argparse
import concurrent.futures
import dataclasses
import hashlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import threading
import time

from faults import Fault, drawn

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ["compiler", "runtime"]
# The first tests to look at a file: programs of unit/, by the beginning of its path. The longest that fits counts.
NEAREST = {
    "compiler/source": ["front_end_test", "diagnostics_test"],
    "compiler/syntax": ["front_end_test", "diagnostics_test"],
    "compiler/network": ["front_end_test", "diagnostics_test"],
    "compiler/linear": ["linear_test"],
    "compiler/decompose": ["decompose_test", "slips_test", "contact_test"],
    "compiler/discretise": ["discretise_test", "slips_test", "contact_test", "tunables_test"],
    "compiler/certify": ["certify_test", "passivity_test"],
    "compiler/verify": ["certify_test"],
    "compiler/emit": ["emit_test", "generated_test"],
    "compiler/report": ["report_unit_test"],
    "compiler": ["generated_test"],
    "runtime/include/dashpot/slip": ["slips_test", "contact_test"],
    "runtime/include/dashpot/tunable": ["tunables_test"],
    "runtime/include/dashpot/exponential": ["tunables_test"],
    "runtime/include/dashpot/estimators": ["estimators_test"],
    "runtime/include/dashpot/energy": ["energy_test"],
    "runtime/include/dashpot/servo": ["servo_test"],
    "runtime/include/dashpot": ["energy_test", "servo_test"],
    "runtime/servo": ["servo_test"],
    "runtime/devices/simulated": ["simulated_test"],
    "runtime/devices/board": ["board_test", "board_realtime_test"],
}
# Of all tests, those that see the compiler's whole work in a second or two; and those that compile much of what it
# emits, or draw.
FIRST = "^golden|^generated|^diagnostics|^command_line"
SLOW = ("^Agreement|^Points|^StrictCompile|^TunableEmission|^Subnormal|^Firmware|^paper|^Eva|Differential|^SlipHolds|"
        "^run_command")
# Tests against the clock, which other work makes red; and those that build or draw everything once more, minutes each.
# What only these would find counts as missed.
LEFT_OUT = "RealClock|^package.In|^report.browser"
SECONDS = 900  # no test program takes a third of it: a fault that makes one hang is found


class Copy:
    """A clone with a build of its own, which takes one processor."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder).resolve()
        self.build = self.folder / "build" / "release"
        if not self.folder.exists():
            self.folder.parent.mkdir(parents=True, exist_ok=True)
            subprocess.run(["git", "clone", "--quiet", "--local", str(ROOT), str(self.folder)], check=True)
        subprocess.run(["git", "checkout", "--quiet", "--", "."], cwd=self.folder, check=True)

    def prepare(self):
        # A linker that is quick, and compiled code from a cache: most of what is built for a fault is what was built
        # for another.
        quick = ["-DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=gold"] if shutil.which("ld.gold") else []
        cache = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        self.must("cmake", "--preset", "release", "-DDASHPOT_BUILD_BENCHMARKS=OFF", *quick, *cache)
        self.must(*self.building())

    def building(self, *targets):
        return ["ninja", "-C", str(self.build), "-j1", *targets]

    def must(self, *command):
        if not self.succeeds(*command, seconds=None):
            sys.exit(f"without any fault this fails: {' '.join(command)}")

    def succeeds(self, *command, seconds=SECONDS):
        """Whether it ends well in time; everything that it started ends with it."""
        self.output = self.folder / "build" / "last_output"
        self.output.parent.mkdir(exist_ok=True)
        with open(self.output, "w") as output:
            process = subprocess.Popen(command, cwd=self.folder, stdout=output, stderr=subprocess.STDOUT,
                                       start_new_session=True)
            try:
                return process.wait(seconds) == 0
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                return False

    def passes(self, *chosen):
        return self.succeeds("ctest", "--test-dir", str(self.build), "--stop-on-failure", *chosen, seconds=2 * SECONDS)

    def program(self, name):
        found = [path for path in self.build.rglob(name) if path.is_file()]
        return found[0] if found else None

    def machine_code(self, file):
        """A digest of what `file` is compiled to; None for a header, which is part of many."""
        objects = list(self.build.glob(f"{file.split('/')[0]}/**/{file.split('/', 1)[1]}.o"))
        return hashlib.sha256(objects[0].read_bytes()).hexdigest() if len(objects) == 1 else None


def nearest(file):
    fitting = [prefix for prefix in NEAREST if file.startswith(prefix)]
    return NEAREST[max(fitting, key=len)] if fitting else []


def first_failure(output):
    lines = [line for line in output.read_text(errors="replace").splitlines() if "[  FAILED  ]" in line
             or "***" in line]
    return lines[0].strip() if lines else "ended early or late"


def judged(copy, fault, tests):
    """What `tests` says of the copy with the fault in it."""
    path = copy.folder / fault.file
    sound = path.read_text()
    before = copy.machine_code(fault.file)
    path.write_text(fault.planted_in(sound))
    try:
        return tests(copy, fault, before)
    finally:
        path.write_text(sound)


def quick_tests(copy, fault, sound_code):
    """'found' and by what, 'open', or why it is no fault."""
    near = nearest(fault.file)
    if near and not copy.succeeds(*copy.building(near[0])):
        return "does not compile", ""
    if sound_code is not None and copy.machine_code(fault.file) == sound_code:
        return "same machine code", ""
    for name in near:
        if not copy.succeeds(*copy.building(name)):
            return "found", f"the build of {name}"
        if not copy.succeeds(str(copy.program(name)), "--gtest_brief=1", "--gtest_fail_fast"):
            return "found", f"{name}: {first_failure(copy.output)}"
    if not copy.succeeds(*copy.building("dashpot", "generated_test", "diagnostics_test")):
        return "found", "the build of the compiler"
    if not copy.passes("-R", FIRST):
        return "found", first_failure(copy.output)
    if not copy.succeeds(*copy.building()):
        return "found", "the build of all tests"
    if not copy.passes("-E", f"{FIRST}|{SLOW}|{LEFT_OUT}"):
        return "found", first_failure(copy.output)
    return "open", ""


def slow_tests(copy, fault, sound_code):
    """'found' and by what, or 'missed'."""
    if not copy.succeeds(*copy.building()):
        return "found", "the build of all tests"
    return ("missed", "") if copy.passes("-R", SLOW) else ("found", first_failure(copy.output))


class Search:
    """The faults drawn, handed out one at a time, and what became of each."""

    def __init__(self, count, record):
        self.count, self.record, self.lock = count, record, threading.Lock()
        self.verdicts, self.planted = {}, set()
        for line in record.read_text().splitlines() if record.exists() else []:
            entry = json.loads(line)
            self.verdicts[Fault(*(entry[field.name] for field in dataclasses.fields(Fault)))] = entry["verdict"]

    def judged(self, *verdicts):
        return sum(verdict in verdicts for verdict in self.verdicts.values())

    def next_of(self, faults):
        with self.lock:
            if self.judged("found", "missed", "open") + len(self.planted - self.verdicts.keys()) >= self.count:
                return None
            fault = next(fault for fault in faults if fault not in self.verdicts)
            self.planted.add(fault)
            return fault

    def next_open(self):
        with self.lock:
            fault = next((fault for fault, verdict in self.verdicts.items() if verdict == "open"
                          and fault not in self.planted), None)
            if fault:
                self.planted.add(fault)
            return fault

    def tell(self, fault, verdict, by, seconds):
        with self.lock:
            self.planted.remove(fault)
            self.verdicts[fault] = verdict
            with open(self.record, "a") as record:
                record.write(json.dumps({**fault.__dict__, "verdict": verdict, "by": by, "seconds": seconds}) + "\n")
            print(f"{fault.file}:{fault.line}:{fault.column}: '{fault.before}' -> '{fault.after}': {verdict} {by}",
                  flush=True)

    def run_in(self, copy, faults):
        copy.prepare()
        for next_fault, tests in ((lambda: self.next_of(faults), quick_tests), (self.next_open, slow_tests)):
            while fault := next_fault():
                start = time.monotonic()
                self.tell(fault, *judged(copy, fault, tests), round(time.monotonic() - start))

    def summary(self):
        found, missed, other = self.judged("found"), self.judged("missed"), self.judged("open")
        none = len(self.verdicts) - found - missed - other
        return f"{found} of {found + missed + other} found, {missed} missed; {none} were no faults"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--work", required=True, type=pathlib.Path,
                         help="folder of the clones; made where it is not there")
    options.add_argument("--count", type=int, default=200)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--jobs", type=int, default=2)
    options.add_argument("--record", type=pathlib.Path, default=pathlib.Path("faults.jsonl"))
    given = options.parse_args()

    search = Search(given.count, given.record)
    copies = [Copy(given.work / str(number)) for number in range(given.jobs)]
    faults = drawn(copies[0].folder, FOLDERS, given.seed)
    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        for ended in [pool.submit(search.run_in, copy, faults) for copy in copies]:
            ended.result()
    print(search.summary())


if __name__ == "__main__":
    main()
