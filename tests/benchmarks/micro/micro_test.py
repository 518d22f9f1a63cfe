#!/usr/bin/env python3
"""micro_test.py PROCESSOR MACHINE PROGRAM.elf HOST_PROGRAM: a board against this machine, bit for bit.

Prints "instructions per step" for each law; the numbers are not asserted.
"""
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from cortex_m import printed  # noqa: E402


def main():
    processor, machine, program, host = sys.argv[1:]
    board = [line.split() for line in printed(program, machine).splitlines()]
    expected = [line.split() for line in subprocess.run([host], capture_output=True, text=True,
                                                        check=True).stdout.splitlines()]
    different = [name for (name, trace, _), twin in zip(board, expected, strict=True) if [name, trace] != twin]
    for name, _, instructions in board:
        print(f"instructions per step on {processor}, {name}: {instructions}")
    if different:
        sys.exit(f"{processor} and this machine disagree on {', '.join(different)}")


if __name__ == "__main__":
    main()
