"""Programs for bare micro-controllers that QEMU plays with -icount shift=0, where an instruction takes a nanosecond."""
import pathlib
import subprocess

SOURCE = pathlib.Path(__file__).resolve().parents[2]
FIRMWARE = SOURCE / "runtime/devices/board/firmware"
# Options for arm-none-eabi-g++, and QEMU's machine.
PROCESSORS = {"cortex_m4f": (["-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16"], "mps2-an386"),
              "cortex_m7": (["-mcpu=cortex-m7", "-mfpu=fpv5-d16"], "mps2-an500")}
FLAGS = ["-O2", "-ffreestanding", "-ffp-contract=off", "-mthumb", "-mfloat-abi=hard"]
FLAGS_CXX = ["-std=c++17", "-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics"]


def compiling(processor, *folders):
    """Words behind arm-none-eabi-g++, with these folders of headers, the runtime's, and those of the tests."""
    return [*FLAGS, *FLAGS_CXX, *PROCESSORS[processor][0],
            *(f"-I{folder}" for folder in [*folders, SOURCE / "runtime/include", SOURCE / "tests"])]


def linking(source, program):
    """Words behind those of compiling(): one source as a program for QEMU's boards."""
    return ["-nostdlib", "-nostartfiles", "-T", FIRMWARE / "mps2_an386.ld", source, FIRMWARE / "startup.cpp", "-lc",
            "-lgcc", "-o", program]


def printed(program, machine, timeout=100):
    """What it prints over semihosting until it ends."""
    return subprocess.run(
        ["qemu-system-arm", "-M", machine, "-nographic", "-monitor", "none", "-serial", "none", "-chardev",
         "stdio,id=s0",
         "-semihosting-config", "enable=on,target=native,chardev=s0", "-icount", "shift=0", "-kernel", str(program)],
        capture_output=True, text=True, timeout=timeout, check=True).stdout
