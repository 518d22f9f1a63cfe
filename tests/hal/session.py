"""Sessions of LinuxCNC's HAL as a normal user, on threads of this machine, without its real time."""
import os
import pathlib
import shutil
import subprocess

MODULES = pathlib.Path("/usr/lib/linuxcnc/modules")
READER = pathlib.Path(__file__).parent / "read_samples.c"
PINS_AT_MOST = 21  # of one sampler or streamer


def told(*command, **more):
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=120, **more)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


class Session:
    """With the modules NAME.so of a folder, to which it adds the program read_samples. close() takes the modules away
    again.

    Modules can be loaded from LinuxCNC's own folder only: root puts them there for the time of the session; anybody
    else sees a folder of their own there, in a namespace.
    """

    def __init__(self, folder, cc, modules):
        self.folder, self.is_root, self.installed = folder, os.geteuid() == 0, []
        folder.chmod(0o777)
        told(cc, "-DULAPI", "-D_GNU_SOURCE", "-I/usr/include/linuxcnc", READER, "-llinuxcnchal", "-o", "read_samples",
             cwd=folder)
        (folder / "read_samples").chmod(0o755)
        if not self.is_root:
            shutil.copytree(MODULES, folder / "modules")
        try:
            for name in modules:
                place = (MODULES if self.is_root else folder / "modules") / f"{name}.so"
                self.installed.append(place)
                shutil.copy(folder / f"{name}.so", place)
        except OSError:
            self.close()
            raise

    def close(self):
        if self.is_root:
            for place in self.installed:
                place.unlink(missing_ok=True)

    def run(self, lines):
        """What halrun says to these lines."""
        (self.folder / "test.hal").write_text("\n".join(lines) + "\n")
        variables = [f"HOME={self.folder}", f"RTAPI_FIFO_PATH={self.folder}/fifo"]
        run = ["env", "-C", str(self.folder), *variables, "halrun", "-f", "test.hal"]
        if self.is_root:
            return told("runuser", "-u", "nobody", "--", *run)
        bind = f"mount --bind '{self.folder}/modules' {MODULES} && exec unshare --user --map-user=1000 \"$@\""
        return told("unshare", "--user", "--map-root-user", "--mount", "sh", "-c", bind, "sh", *run)
