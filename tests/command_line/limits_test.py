"""The limits that networks/README.md states: what lies at them is taken, what lies beyond is refused with the
number."""
import json
import re
import unittest

from dashpot_command import COMMAND_LINE_WRONG, INPUT_REFUSED, KELVIN, SOURCE, CommandTest, codes, network

LARGEST_FILE = 16 << 20  # [bytes]


def nested(levels):
    """A network file of so many levels of lists and objects: series in parallel in series."""
    inner = '{ "spring": 1 }'
    for level in range((levels - 2) // 2):  # an object and a list each; around them the file, in them an element
        inner = f'{{ "{("series", "parallel")[level % 2]}": [ {inner}, {{ "damper": 1 }} ] }}'
    return network(inner)


def levels_of(value):
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else []
    return isinstance(value, (dict, list)) + max(map(levels_of, inner), default=0)


def parallel_springs(count):
    return network('{ "parallel": [ ' + ", ".join(['{ "spring": 1 }'] * count) + " ] }")


def ladder(inner_nodes):
    ends = ["tool"] + [f"n{i}" for i in range(inner_nodes)]
    rungs = [{"spring": 1, "nodes": [a, b]} for a, b in zip(ends, ends[1:])] + [{"damper": 1, "nodes": [end, "ground"]}
                                                                                for end in ends[1:]]
    return json.dumps({"dashpot": 1, "name": "ladder", "elements": rungs})


def device(**sections):
    return json.dumps({"dashpot_device": 1, "name": "arm", "motion": "translation", "loop": {"rate": 1000},
                       "encoder": {"resolution": 1e-5},
                       **sections})


class Limits(CommandTest):
    def setUp(self):
        super().setUp()
        self.write("kelvin.json", KELVIN)

    def taken(self, text):
        self.dashpot("check", self.write("taken.json", text))

    def refuses(self, text, code):
        done = self.refused("check", self.write("refused.json", text), code=code)
        return done.stderr

    def test_files(self):
        """Fails if any file that a command reads may fill the memory."""
        self.dashpot("compile", "kelvin.json", "-o", "out", "--certificate", "certificate.json")
        whole = KELVIN + " " * (LARGEST_FILE - len(KELVIN))
        self.taken(whole)
        self.write("large", whole + " ")
        for command in [["check", "large"], ["compile", "kelvin.json", "--device", "large"],
                        ["simulate", "kelvin.json", "--input", "large"],
                        ["verify", "large", "out/kelvin.hpp"], ["verify", "certificate.json", "large"]]:
            self.assertIn("is larger than 16 MiB", self.refused(*command, code="file-too-large").stderr)

    def test_depth(self):
        """Fails if a file can take the stack of its reader, or one within the limit is refused."""
        deepest, beyond = nested(100), nested(102)
        self.assertEqual([levels_of(json.loads(text)) for text in (deepest, beyond)], [100, 102])
        self.taken(deepest)
        self.assertIn("more than 100 levels", self.refuses(beyond, "too-deep"))

    def test_elements_and_values(self):
        """Fails if more elements or values than stated pass, or as many are refused."""
        self.taken(parallel_springs(20000))
        self.assertIn("20001 elements; at most 20000", self.refuses(parallel_springs(20001), "too-many-elements"))
        self.assertIn("more than 500000 values", self.refuses('{ "dashpot": 1, "name": "sample", "network": [' +
                                                              "1," * 500000 + "1] }", "too-many-values"))

    def test_numbers(self):
        """Fails if a number that no double holds becomes another one."""
        self.taken(network('{ "spring": 1.7e308 }'))
        self.taken(network('{ "spring": 2.3e-308 }'))
        self.refuses(network('{ "spring": 1.8e308 }'), "number-too-large")
        self.refuses(network('{ "spring": 1e-400 }'), "number-too-small")

    def test_names(self):
        """Fails if a network's name, which names files, may be longer than file systems allow."""
        self.taken(network('{ "spring": 1 }', "n" * 200))
        self.assertIn("at most 200", self.refuses(network('{ "spring": 1 }', "n" * 201), "name-too-long"))

    def test_parts(self):
        """Fails if a part is eliminated that takes minutes."""
        self.assertIn("401 inner nodes; at most 400", self.refuses(ladder(401), "part-too-large"))

    def test_rates(self):
        """Fails if the command line, a device, and a motion mean different limits by a rate."""
        for rate in ["1e-6", "1e9"]:
            self.dashpot("compile", "kelvin.json", "--rate", rate, "-o", "out")
            arm = self.write("arm.json", device(loop={"rate": float(rate)}))
            self.dashpot("compile", "kelvin.json", "--device", arm, "--uncertified", "--no-advice", "-o", "out")
        for rate in ["0.9e-6", "1.1e9"]:
            told = self.dashpot("compile", "kelvin.json", "--rate", rate, status=COMMAND_LINE_WRONG).stderr
            self.assertIn("from 1e-06 to 1e+09 is expected", told)
            self.refused("compile", "kelvin.json", "--device",
                         self.write("arm.json", device(loop={"rate": float(rate)})), code="device-limit")
        self.refused("simulate", "kelvin.json", "--input", self.write("motion.csv", "time,position\n0,0\n0.9e-9,0\n"),
                     code="csv-rate-too-high")

    def test_devices(self):
        """Fails if what a certificate multiplies can leave the doubles, or a bound takes minutes."""
        within = {"loop": {"rate": 1000, "jitter": 1e6, "delay_samples": 64},
                  "encoder": {"resolution": 1e-5, "max_speed": 1e9}, "motor": {"amplifier_lag": 1e6},
                  "velocity": {"estimator": "least_squares", "window": 256},
                  "brake": {"kind": "eddy_current", "max_damping": 1, "coil_lag": 1e6, "critical_speed": 1e-9}}
        self.dashpot("check", "kelvin.json", "--device", self.write("within.json", device(**within)))
        for section, key, value, code in [("loop", "delay_samples", 65, "device-limit"),
                                          ("encoder", "max_speed", 1.1e9, "device-limit"),
                                          ("motor", "amplifier_lag", 1.1e6, "device-limit"),
                                          ("loop", "jitter", 1.1e6, "device-limit"),
                                          ("brake", "coil_lag", 1.1e6, "device-limit"),
                                          ("velocity", "window", 257, "estimator-setting"),
                                          ("brake", "critical_speed", 0.9e-9, "device-limit"),
                                          ("brake", "critical_speed", 1.1e9, "device-limit")]:
            with self.subTest(key=key, value=value):
                beyond = self.write("beyond.json", device(**{**within, section: {**within[section], key: value}}))
                told = self.refused("check", "kelvin.json", "--device", beyond, code=code).stderr
                # such a coil is warned of, too
                errors = "\n".join(line for line in told.splitlines() if ": error: " in line)
                self.assertEqual(codes(errors), [code])

    def test_every_message_of_the_table(self):
        """Fails if the table names a message that there is not, so that a reader looks for it in vain."""
        table = (SOURCE / "networks/README.md").read_text().split("### Limits")[1].split("Where a network")[0]
        known = re.sub(r"\s+", " ", (SOURCE / "compiler/source/diagnostics.def").read_text()).replace("( ", "(")
        named = re.findall(r"`([a-z0-9-]+)`", re.sub(r"`verify`", "", table))
        self.assertGreater(len(named), 15)
        for code in named:
            self.assertIn(f"DASHPOT_DIAGNOSTIC({code.replace('-', '_')}, error", known)


if __name__ == "__main__":
    unittest.main()
