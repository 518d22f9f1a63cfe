#!/usr/bin/env python3
"""compile_table.py BUILD_FOLDER [--repetitions 9]: what compiling takes, over the size of the network, and how it
grows.

Stages are `dashpot compile --timings json`; `command` is the whole process; `object` is `g++ -O2 -c` of a file that
includes the header: both in processor time. Medians [ms]. An exponent p says that the time grows like size^p: the slope
of log(time) over log(size), by least squares over the larger half of the sizes.
"""
import argparse
import json
import math
import pathlib
import random
import resource
import statistics
import subprocess
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
COLUMNS = ["files", "front end", "normal form", "decomposition", "discretisation", "certificate", "emission", "command",
           "object"]


def branches(count):
    """A spring beside Maxwell elements whose relaxation times differ."""
    parts = [{"spring": 5}] + [{"series": [{"damper": (i + 1) / 8}, {"spring": 12}]} for i in range(count)]
    return {"dashpot": 1, "name": "sample", "network": {"parallel": parts}}


def graph(nodes):
    """Inner nodes, each tied to an earlier one and to a random one: springs and dampers in turn. Equal for equal
    sizes."""
    chance = random.Random(nodes)
    names = ["tool", "ground"] + [f"n{i}" for i in range(nodes)]
    elements = []
    for i in range(2, len(names)):
        for other in {names[chance.randrange(i)], names[chance.randrange(i)]}:
            elements.append({chance.choice(["spring", "damper"]): chance.uniform(1, 100), "nodes": [names[i], other]})
            elements.append({chance.choice(["spring", "damper"]): chance.uniform(1, 100), "nodes": [names[i], other]})
    elements.append({"spring": 5, "nodes": ["tool", "ground"]})
    return {"dashpot": 1, "name": "sample", "elements": elements}


def timed(command):
    """Processor time of the command and its children, which other work on the machine does not stretch much, and
    standard error."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stderr


def measured(dashpot, network, repetitions):
    """{column: median in ms}"""
    samples = {column: [] for column in COLUMNS}
    with tempfile.TemporaryDirectory() as folder:
        name = network["name"]
        (pathlib.Path(folder) / "network.json").write_text(json.dumps(network))
        (pathlib.Path(folder) / "unit.cpp").write_text(f'#include "{name}.hpp"\ndashpot::generated::{name} law;\n'
                                                       "dashpot::command<double> step(double u, double v) { return "
                                                       "law.step(u, v); }\n")
        for _ in range(repetitions):
            seconds, said = timed([dashpot, "compile", f"{folder}/network.json", "--timings", "json", "-o", folder])
            samples["command"].append(seconds)
            timings = json.loads(next(line for line in said.splitlines() if line.startswith('{"timings"')))["timings"]
            for stage in COLUMNS[:-2]:
                samples[stage].append(timings[stage])
            samples["object"].append(timed(["g++", "-std=c++17", "-O2", "-c", f"{folder}/unit.cpp",
                                            f"-I{SOURCE}/runtime/include", "-o", f"{folder}/unit.o"])[0])
    return {column: 1000 * statistics.median(values) for column, values in samples.items()}


def exponent(points):
    points = sorted(points)[len(points) // 2:]
    xs, ys = [math.log(n) for n, _ in points], [math.log(t) for _, t in points]
    mx, my = statistics.mean(xs), statistics.mean(ys)
    return sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx) ** 2 for x in xs)


def print_family(title, sizes, make, dashpot, repetitions):
    rows = {size: measured(dashpot, make(size), repetitions) for size in sizes}
    print(f"\n| {title} | " + " | ".join(COLUMNS) + " |\n" + "| --- " * (len(COLUMNS) + 1) + "|")
    for size, row in rows.items():
        print(f"| {size} | " + " | ".join(f"{row[column]:.2f}" for column in COLUMNS) + " |")
    if isinstance(next(iter(sizes)), int):
        print("| exponent | " + " | ".join(f"{exponent([(n, row[c]) for n, row in rows.items()]):.2f}"
                                           for c in COLUMNS) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--repetitions", type=int, default=9)
    options = parser.parse_args()
    dashpot = options.build / "compiler/dashpot"
    paper = {path.stem: json.loads(path.read_text()) for path in sorted((SOURCE / "networks/paper").glob("*.json"))}
    print_family("of the paper", paper, paper.get, dashpot, options.repetitions)
    print_family("branches", [1, 2, 8, 32, 64, 128, 256, 512, 1024], branches, dashpot, options.repetitions)
    print_family("nodes of a graph", [5, 10, 20, 40, 80], graph, dashpot, options.repetitions)


if __name__ == "__main__":
    main()
