"""What dashpot says about the paper's networks, compared with what it said when somebody last looked.

    python3 golden_test.py --dashpot build/compiler/dashpot [--update]

Each file of transcripts/ holds command lines and their output. A difference is shown as a diff and fails; --update writes
the transcripts anew, for review in the version control's own diff.
"""
import argparse
import difflib
import pathlib
import subprocess
import sys

TRANSCRIPTS = pathlib.Path(__file__).parent / "transcripts"
SOURCE = TRANSCRIPTS.parents[2]
STAGES = ["network", "linear", "decomposition", "law"]
PANTOGRAPH = "runtime/devices/pantograph_brake_2009.json"


def of_network(path):
    """The command lines about one network: every stage, and the text for people."""
    return [["explain", path], *(["compile", path, "--print", stage] for stage in STAGES)]


def transcripts_wanted():
    """From the name of each transcript to its command lines."""
    wanted = {path.stem: of_network(path.relative_to(SOURCE)) for path in sorted(SOURCE.glob("networks/paper/*.json"))}
    fig_5 = "networks/paper/second_order_maxwell.json"
    wanted["with_a_device"] = [["explain", fig_5, "--device", PANTOGRAPH],
                               ["explain", "networks/paper/kelvin.json", "--device", PANTOGRAPH],
                               ["explain", "networks/paper/virtual_wall.json", "--device", PANTOGRAPH]]
    wanted["choices"] = [
        ["compile", fig_5, "--print", "law", "--scheme", "backward-euler", "--state-input", "nodal"],
        ["compile", fig_5, "--print", "law", "--state-input", "velocity", "--decomposition", "zero-frequency"],
        ["compile", fig_5, "--print", "law", "--scalar", "float", "--rate", "100000"],
        ["explain", fig_5, "--decomposition", "2.5"]]
    return wanted


def said(dashpot, arguments):
    done = subprocess.run([dashpot, *map(str, arguments)], cwd=SOURCE, capture_output=True, text=True, timeout=60)
    status = f"exit status {done.returncode}\n" if done.returncode != 0 else ""
    return f"$ dashpot {' '.join(map(str, arguments))}\n{done.stdout}{done.stderr}{status}\n"


def differs(name, text):
    path = TRANSCRIPTS / f"{name}.txt"
    recorded = path.read_text() if path.exists() else ""
    diff = difflib.unified_diff(recorded.splitlines(True), text.splitlines(True), f"recorded/{path.name}", f"now/{path.name}")
    sys.stdout.writelines(diff)
    return text != recorded


def record(texts):
    TRANSCRIPTS.mkdir(exist_ok=True)
    for path in TRANSCRIPTS.glob("*.txt"):
        if path.stem not in texts:
            path.unlink()
    for name, text in texts.items():
        (TRANSCRIPTS / f"{name}.txt").write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dashpot", type=pathlib.Path, required=True)
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()
    dashpot = options.dashpot.resolve()
    texts = {name: "".join(said(dashpot, line) for line in lines) for name, lines in transcripts_wanted().items()}
    if options.update:
        record(texts)
        return 0
    left_over = sorted({path.stem for path in TRANSCRIPTS.glob("*.txt")} - set(texts))
    for name in left_over:
        print(f"transcripts/{name}.txt belongs to nothing")
    changed = [name for name, text in texts.items() if differs(name, text)]
    if changed or left_over:
        print("if this is meant, run golden_test.py again with --update and review the change")
    return 1 if changed or left_over else 0


if __name__ == "__main__":
    sys.exit(main())
