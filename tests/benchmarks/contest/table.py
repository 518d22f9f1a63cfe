#!/usr/bin/env python3
"""table.py BUILD_FOLDER [--targets sse2,avx2,avx512] [--networks REGEX] [--repetitions 9]: the contest's table for this
machine.

Builds and runs the contest of each target that this processor has: equality first, then times (medians of the
repetitions, in random order within one process), then instructions under callgrind (which has no AVX-512), and the size
of each step's code.
"""
import argparse
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

import limits

MEASURES = ["chain", "throughput", "cold", "latency"]
FLAGS = {"sse2": "sse2", "avx2": "avx2", "avx512": "avx512f"}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--targets", default="sse2,avx2,avx512")
    parser.add_argument("--networks", default=".")
    parser.add_argument("--repetitions", type=int, default=9)
    return parser.parse_args()


def times(program, networks, repetitions):
    """{title: {measure: seconds}}"""
    run = subprocess.run(
        [program, f"--benchmark_repetitions={repetitions}", "--benchmark_enable_random_interleaving=true",
         "--benchmark_min_time=0.005",
         f"--benchmark_filter=^(machine|nothing|({networks}))", "--benchmark_format=json"],
        stdout=subprocess.PIPE, check=True, text=True)
    samples = {}
    for entry in json.loads(run.stdout)["benchmarks"]:
        if entry["run_type"] != "iteration":
            continue
        name = re.sub(r"/(iterations:\d+|manual_time|repeats:\d+)", "", entry["name"])
        title, measure = name.rsplit("/", 1)
        samples.setdefault(title, {}).setdefault(measure, []).append(entry["step"])
    return {title: {m: statistics.median(s) for m, s in found.items()} for title, found in samples.items()}


def instructions(program):
    """{title: instructions a step, beyond a step that does nothing}"""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={folder}/out", program, "--count"],
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
        counts = {}
        for profile in pathlib.Path(folder).iterdir():
            text = profile.read_text(errors="replace")
            title = re.search(r"^desc: Trigger: Client Request: (.+)$", text, re.M)
            total = re.search(r"^(?:totals|summary): (\d+)", text, re.M)
            if title and total:
                counts[title.group(1)] = int(total.group(1)) / 1000
    return {title: round(count - counts["nothing/nothing"]) for title, count in counts.items()}


def code_bytes(program):
    """{title: bytes of the step's own function}"""
    sizes = {}
    for line in subprocess.run(["nm", "-S", program], stdout=subprocess.PIPE, check=True,
                               text=True).stdout.splitlines():
        words = line.split()
        if len(words) == 4:
            sizes[int(words[0], 16)] = int(words[1], 16)
    found = {}
    for line in subprocess.run([program, "--places"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True,
                               text=True).stdout.splitlines():
        title, *functions = line.split("\t")
        found[title] = sum(sizes[int(place, 16)] for place in functions)
    return found


def shown(seconds):
    return f"{1e9 * seconds:.1f}" if seconds < 1e-6 else f"{1e9 * seconds:.0f}"


def print_network(network, rows, harness, machine, target, counts, sizes):
    by_hand = [title for title in rows if "/by hand" in title]
    best = {m: min(rows[title][m] for title in by_hand) for m in MEASURES}
    fewest = min((counts[title] for title in by_hand if title in counts), default=None)
    limit = limits.chain(network, machine, target)
    print(f"\n### {network}, {target}: chain at least {shown(limit)} ns, {shown(limits.harness(machine))} of them the "
          f"harness\n")
    print("| | chain [ns] | to hand | to limit | throughput [ns] | to hand | cold tick [ns] | input to command [ns] | "
          "instructions | code [bytes] |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    for title, row in sorted(rows.items(), key=lambda item: item[1]["chain"]):
        net = {m: row[m] - (harness[m] if m in ("cold", "latency") else 0) for m in MEASURES}
        count = counts.get(title)
        cells = [title.split("/", 1)[1], shown(row["chain"]), f"{row['chain'] / best['chain']:.2f}",
                 f"{row['chain'] / limit:.2f}",
                 shown(row["throughput"]), f"{row['throughput'] / best['throughput']:.2f}", f"{1e9 * net['cold']:.0f}",
                 shown(net["latency"]),
                 "–" if count is None else str(count), str(sizes.get(title, "–"))]
        print("| " + " | ".join(cells) + " |")
    if fewest is not None:
        print(f"\nFewest instructions by hand: {fewest}.")
    if not any("/Faust" in title for title in rows):
        print("\nFaust: not installed; `.ci/install benchmarks` installs it.")


def main():
    options = arguments()
    flags = re.search(r"^flags\s*:(.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.M).group(1).split()
    for target in options.targets.split(","):
        program = options.build / "tests/benchmarks/contest" / f"contest_{target}"
        if FLAGS[target] not in flags:
            print(f"\n{target}: this processor has none")
            continue
        subprocess.run(["cmake", "--build", options.build, "--target", f"contest_{target}"], stdout=sys.stderr,
                       check=True)
        found = times(program, options.networks, options.repetitions)
        counts = instructions(program) if target != "avx512" else {}
        sizes = code_bytes(program)
        machine = {m: t for m, t in found.pop("machine").items()}
        harness = found.pop("nothing/nothing")
        print(f"\n## {target}: " + ", ".join(f"{m} {1e9 * t:.2f} ns" for m, t in sorted(machine.items())))
        for network in dict.fromkeys(title.split("/", 1)[0] for title in found):
            rows = {title: row for title, row in found.items() if title.startswith(network + "/")}
            print_network(network, rows, harness, machine, target, counts, sizes)
        sys.stdout.flush()


if __name__ == "__main__":
    main()
