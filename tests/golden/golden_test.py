"""What dashpot says about networks of every shape in networks/, compared with what it said when somebody last looked.

    python3 golden_test.py --dashpot build/compiler/dashpot [--update]

Each file of transcripts/ holds command lines and their output: what `explain` says, the stages of the paper's networks,
and of every certificate the claims; the numbers that they rest on are in generated/. A difference is shown as a diff
and fails; --update writes the transcripts anew, for review in the version control's own diff.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import recorded

TRANSCRIPTS = pathlib.Path(__file__).parent / "transcripts"
SOURCE = TRANSCRIPTS.parents[2]
STAGES = ["network", "linear", "decomposition", "law"]
CERTIFICATE = "certificate.json"
CLAIMS = ["law", "passivity", "energy"]
# Networks whose choice on a device is looked at: of springs and dampers in every arrangement, bare dampers at the tool
# and not, slips, a contact, tunables.
FELT = [f"networks/{name}.json" for name in [
    "paper/second_order_maxwell", "paper/kelvin", "paper/maxwell_damper_at_tool", "paper/generalised_kelvin_two",
    "paper/bridge",
    "paper/visco_elasto_plastic", "paper/virtual_wall", "tissues/human_liver_normal", "tissues/heel_fat_pad",
    "tunable/second_order_maxwell_tunable"]]
# Of which the motor that is shorted as a brake says what it says of another.
ALIKE = [f"networks/{name}.json" for name in [
    "paper/maxwell_damper_at_tool", "paper/bridge", "tissues/human_liver_normal"]]


def of_network(path):
    """The command lines about one network: the text for people, the certificate, and of the paper's every stage."""
    if path.parent.name == "axes":
        return [["explain", path], ["explain", path, "--device", "runtime/devices/pantograph_2dof.json"]]
    stages = STAGES if path.parent.name == "paper" else []
    return [["explain", path], ["compile", path, "--certificate", CERTIFICATE],
            *(["compile", path, "--print", stage] for stage in stages)]


def transcripts_wanted():
    """From the name of each transcript to its command lines."""
    networks = recorded.one_a_shape(sorted(SOURCE.glob("networks/paper/*.json")) +
                                    sorted(SOURCE.glob("networks/*/*.json")))
    wanted = {path.stem: of_network(path.relative_to(SOURCE)) for path in networks}
    fig_5 = "networks/paper/second_order_maxwell.json"
    for device in ["pantograph_brake_2009", "phantom_shorted_motor", "board_mps2"]:
        felt = [path for path in FELT if device != "phantom_shorted_motor" or path not in ALIKE]
        wanted[f"on_{device}"] = [["explain", path, "--device", f"runtime/devices/{device}.json"] for path in felt]
    wanted["choices"] = [
        ["compile", fig_5, "--print", "law", "--scheme", "backward-euler", "--state-input", "nodal"],
        ["compile", fig_5, "--print", "law", "--state-input", "velocity", "--decomposition", "zero-frequency"],
        ["compile", fig_5, "--print", "law", "--scalar", "float", "--rate", "100000"],
        ["explain", fig_5, "--decomposition", "2.5"]]
    return wanted


def claims(path):
    """What a certificate says, without what it says it of."""
    certificate = json.loads(path.read_text())
    return json.dumps({key: certificate[key] for key in CLAIMS}, indent=2, ensure_ascii=False) + "\n"


def said(dashpot, arguments):
    if arguments[-1] == CERTIFICATE:
        with tempfile.TemporaryDirectory() as folder:
            written = pathlib.Path(folder) / CERTIFICATE
            return said(dashpot, [*arguments[:-1], written, "-o", folder]).replace(folder,
                                                                                   "FOLDER") + claims(written) + "\n"
    done = subprocess.run([dashpot, *map(str, arguments)], cwd=SOURCE, capture_output=True, text=True, timeout=180)
    status = f"exit status {done.returncode}\n" if done.returncode != 0 else ""
    return f"$ dashpot {' '.join(map(str, arguments))}\n{done.stdout}{done.stderr}{status}\n"


def texts_of(dashpot):
    return {name: "".join(said(dashpot, line) for line in lines) for name, lines in transcripts_wanted().items()}


if __name__ == "__main__":
    sys.exit(recorded.main(__doc__, TRANSCRIPTS, texts_of))
