"""The package that cpack makes, installed in a root that holds the packages it depends on and nothing else, and tried
there.

    python3 debian_test.py [-v]

The environment names what ctest knows: DASHPOT_SOURCE (this repository), DASHPOT_BUILD (where it is built), CPACK. The
root is made of the files that the distribution's packages have on this machine, so nothing is fetched; dpkg decides
whether they are enough.
"""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["DASHPOT_SOURCE"])
BUILD = pathlib.Path(os.environ["DASHPOT_BUILD"])
AS_ROOT = [] if os.geteuid() == 0 else ["unshare", "--map-root-user"]


def run(*command, status=0, **more):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, **more)
    assert done.returncode == status, f"{command} ended with {done.returncode}:\n{done.stdout}{done.stderr}"
    return done.stdout + done.stderr


def installed_status():
    """What dpkg knows of each package here, by name and by what it provides."""
    known = {}
    for record in pathlib.Path("/var/lib/dpkg/status").read_text().split("\n\n"):
        fields = dict(re.findall(r"^([\w-]+): (.*)$", record, re.MULTILINE))
        if fields.get("Status") == "install ok installed":
            for name in [fields["Package"], *re.findall(r"[\w.+-]+(?= \(=|,|$)", fields.get("Provides", ""))]:
                known.setdefault(name, (fields, record))
    return known


def needed(depends, known):
    """The packages, as dpkg's records, that satisfy these and what they depend on."""
    found, waiting = {}, [depends]
    while waiting:
        for choice in filter(None, re.split(r",\s*", waiting.pop())):
            names = [re.match(r"[\w.+-]+", alternative)[0] for alternative in re.split(r"\s*\|\s*", choice)]
            name = next((name for name in names if name in known), None)
            assert name, f"nothing here is {choice}"
            fields, record = known[name]
            if fields["Package"] not in found:
                found[fields["Package"]] = (fields, record)
                waiting += [fields.get("Depends", ""), fields.get("Pre-Depends", "")]
    return found


class Root:
    """A system that has these packages, for dpkg to install others in."""

    def __init__(self, folder, packages):
        self.folder = pathlib.Path(folder)
        for name in ["bin", "sbin", "lib", "lib64"]:
            (self.folder / "usr" / name).mkdir(parents=True)
            (self.folder / name).symlink_to(f"usr/{name}")
        for name in ["info", "updates", "triggers"]:
            (self.folder / "var/lib/dpkg" / name).mkdir(parents=True)
        for name in ["dev", "proc", "tmp"]:
            (self.folder / name).mkdir()
        (self.folder / "dev/null").touch()
        (self.folder / "var/lib/dpkg/available").touch()
        (self.folder / "var/lib/dpkg/status").write_text("".join(record.strip() + "\n\n"
                                                                 for _, record in packages.values()))
        for fields, _ in packages.values():
            lists = [f"{fields['Package']}:{fields['Architecture']}", fields["Package"]]
            path = next(path for path in (pathlib.Path(f"/var/lib/dpkg/info/{name}.list") for name in lists)
                        if path.exists())
            shutil.copy(path, self.folder / "var/lib/dpkg/info")
            for file in path.read_text().splitlines():
                self._copy(pathlib.Path(file))
        self._choose_alternatives()

    def _copy(self, file):
        there = self.folder / file.relative_to("/")
        if file.is_symlink() or file.is_file():
            there.parent.mkdir(parents=True, exist_ok=True)
            if not os.path.lexists(there):
                shutil.copy2(file, there, follow_symlinks=False)

    def _choose_alternatives(self):
        """Links that packages make when they are installed, where one of several serves: libblas.so.3 for instance."""
        for record in pathlib.Path("/var/lib/dpkg/alternatives").iterdir():
            choice = pathlib.Path("/etc/alternatives") / record.name
            link = pathlib.Path(record.read_text().splitlines()[1])
            if choice.is_symlink() and os.path.lexists(self.folder / os.readlink(choice).lstrip("/")):
                self._copy(choice)
                self._copy(link)

    def dpkg(self, *words, **more):
        """Of the machine outside, as if that root were all there is. It must find nothing to run in there."""
        return run(*AS_ROOT, "dpkg", f"--root={self.folder}", "--force-script-chrootless", *words, **more)

    def within(self, *command, **more):
        return run(*AS_ROOT, "chroot", self.folder, *command, env={"PATH": "/usr/bin:/usr/sbin"}, **more)

    def files(self):
        return {path.relative_to(self.folder) for path in self.folder.rglob("*")
                if not path.is_relative_to(self.folder / "var/lib/dpkg")}


class Debian(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="debian")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        run(os.environ["CPACK"], "-G", "DEB", "-B", cls.folder / "made", "--config", BUILD / "CPackConfig.cmake",
            cwd=cls.folder)
        (cls.package,) = (cls.folder / "made").glob("*.deb")
        cls.about = dict(re.findall(r"^ ?([\w-]+): (.*)$", run("dpkg-deb", "--field", cls.package), re.MULTILINE))

    def test_package(self):
        """Fails if the package in a root of its own lacks what it needs, does not work there, or leaves something
        behind."""
        version = re.search(r"VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text().split("project(")[1])[1]
        self.assertEqual((self.about["Package"], self.about["Version"]), ("dashpot", version))
        self.assertIn("libc6", self.about["Depends"])
        root = Root(self.folder / "root", needed(self.about["Depends"], installed_status()))
        before = root.files()
        root.dpkg("--install", self.package)
        self.try_commands(root, version)
        self.try_files(root)
        root.dpkg("--purge", "dashpot")
        self.assertEqual({path for path in root.files() - before if path.parts[0] != "tmp"}, set())

    def try_commands(self, root, version):
        self.assertTrue(root.within("dashpot", "--version").startswith(f"dashpot {version}\n"))
        networks = sorted((root.folder / "usr/share/dashpot/networks/paper").glob("*.json"))
        self.assertGreater(len(networks), 5)
        for network in networks:
            inside = "/" + str(network.relative_to(root.folder))
            root.within("dashpot", "compile", inside, "-o", "/tmp/out", "--certificate", "/tmp/out/certificate.json")
            header = f"/tmp/out/{network.stem}.hpp"
            self.assertEqual((root.folder / header[1:]).read_bytes(),
                             (SOURCE / f"generated/paper/{network.stem}.hpp").read_bytes())
            root.within("dashpot", "verify", "/tmp/out/certificate.json", header, "--allow-uncertified")
            if network.stem in ("kelvin", "second_order_maxwell"):
                self.assertIn("proved", root.within("dashpot-check", header, "/tmp/out/certificate.json"))
        device = "/usr/share/dashpot/devices/pantograph_brake_2009.json"
        fig_5 = "/usr/share/dashpot/networks/paper/second_order_maxwell.json"
        self.assertIn("brake", root.within("dashpot", "explain", fig_5, "--device", device))
        says = f"import dashpot; print(dashpot.explain('{fig_5}')['chosen'])"
        self.assertEqual(root.within("python3", "-B", "-c", says), "paper\n")
        # There is no compiler in there, and that is what is said.
        self.assertIn("'c++' does not compile the emitted code: cannot be started",
                      root.within("dashpot", "run", fig_5, "--device", device, "--fast", "--for", "1", status=1))

    def try_files(self, root):
        share = root.folder / "usr/share"
        for name in ["dashpot", "dashpot-compile", "dashpot-fit", "dashpot-run"]:
            self.assertTrue((share / f"man/man1/{name}.1.gz").is_file(), name)
        commands = re.findall(r"^  (\w+) ", root.within("dashpot", "--help").split("Subcommands:")[1], re.MULTILINE)
        self.assertEqual(sorted(path.name for path in (share / "man/man1").glob("dashpot-*")),
                         sorted(f"dashpot-{command}.1.gz" for command in commands))
        for path, shell in [("bash-completion/completions/dashpot", "bash"), ("zsh/vendor-completions/_dashpot", "zsh"),
                            ("fish/vendor_completions.d/dashpot.fish", "fish")]:
            self.assertEqual((share / path).read_text(), root.within("dashpot", "completion", shell))
        for path in ["usr/lib/python3/dist-packages/dashpot/__init__.py", "usr/share/doc/dashpot/changelog.gz",
                     "usr/share/doc/dashpot/copyright", "usr/include/dashpot/command.hpp"]:
            self.assertTrue((root.folder / path).is_file(), path)
        self.assertTrue(list((root.folder / "usr").rglob("dashpotConfig.cmake")))

    def test_what_is_missing_is_said(self):
        """Fails if the package installs where what it depends on is not there: then the test above would say
        nothing."""
        packages = needed(self.about["Depends"], installed_status())
        lacking = {name: package for name, package in packages.items() if not name.startswith("libfmt")}
        self.assertLess(len(lacking), len(packages))
        root = Root(self.folder / "poor", lacking)
        self.assertIn("libfmt", root.dpkg("--install", self.package, status=1))


if __name__ == "__main__":
    unittest.main()
