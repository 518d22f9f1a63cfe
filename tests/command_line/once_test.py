"""Counts, under callgrind, how often a compilation works out what the whole network is, and how often it enters each
of the compiler's folders."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

DASHPOT = os.environ["DASHPOT"]
SOURCE = pathlib.Path(os.environ["DASHPOT_SOURCE"])
NETWORKS = SOURCE / "networks"
DEVICE = SOURCE / "runtime/devices/pantograph_brake_2009.json"

# What is known of a network once it is read, and the function that finds it.
FACTS = {"what has an effect": "at_default", "normal form": "closed_normal_form", "as a tree": "series_parallel_tree",
         "static curve's map": "motion_map", "device as the network sees it": "PortDevice::of"}
# The functions by which a folder of the compiler is entered.
ENTRANCES = {"syntax": ["parse_network"], "network": ["build_network"], "linear": ["closed_normal_form"],
             "decompose": ["decompose"], "discretise": ["discretise", "discretise_tunable"], "certify": ["certify"],
             "emit": ["emit_cpp"]}


class Once(unittest.TestCase):
    def calls(self, *arguments):
        """How often each function of the compiler was called, by its name without namespace and arguments."""
        with tempfile.TemporaryDirectory() as folder:
            profile = pathlib.Path(folder) / "profile"
            done = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={profile}",
                                   DASHPOT, "compile", "--no-advice", *map(str, arguments), "-o", folder],
                                  capture_output=True, text=True, timeout=600)
            self.assertEqual(done.returncode, 0, done.stderr)
            names, calls, called = {}, {}, None
            for line in profile.read_text().splitlines():
                if function := re.match(r"(c?)fn=\((\d+)\)(?: (.*))?$", line):
                    if function[3]:
                        names[function[2]] = function[3]
                    if function[1]:
                        called = function[2]
                elif count := re.match(r"calls=(\d+)", line):
                    calls[called] = calls.get(called, 0) + int(count[1])
        total = {}
        for function, count in calls.items():
            if name := re.match(r"dashpot::compiler::([\w:]+)\(", names[function]):
                total[name[1]] = total.get(name[1], 0) + count
        return total

    def check(self, facts, *arguments):
        calls = self.calls(*arguments)
        for fact in facts:
            self.assertEqual(calls.get(FACTS[fact], 0), 1, f"{fact}: {FACTS[fact]}() of {arguments}")
        return calls

    def check_entrances(self, calls):
        for folder, functions in ENTRANCES.items():
            entered = sum(calls.get(function, 0) for function in functions)
            self.assertIn(entered, [1, 2], f"{folder}/ is entered {entered} times, by {functions}")

    # Fails if a stage finds out again what an earlier one knows, or a folder is entered more than twice.
    def test_linear_networks(self):
        for name in ["second_order_maxwell", "bridge"]:
            calls = self.check(["what has an effect", "normal form", "as a tree"], NETWORKS / f"paper/{name}.json")
            self.check_entrances(calls)

    # The tables of a tunable network have a normal form of their own, at the largest values.
    def test_tunable_network(self):
        calls = self.check(["what has an effect"], NETWORKS / "tunable/standard_solid_tunable.json")
        self.check_entrances(calls)

    def test_static_curve(self):
        self.check(["what has an effect", "normal form", "static curve's map", "device as the network sees it"],
                   NETWORKS / "static/ligament.json", "--device", DEVICE, "--uncertified")

    # Each slip's part has a tree of its own; of the whole network there is one normal form. What is behind slips, or on
    # a device, is chosen by running several laws, so that several are discretised.
    def test_slips(self):
        self.check(["what has an effect", "normal form"], NETWORKS / "paper/visco_elasto_plastic.json")


if __name__ == "__main__":
    unittest.main()
