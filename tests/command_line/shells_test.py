"""Manual pages, and what completes command lines in bash, zsh and fish: each asked through the shell itself."""
import os
import pty
import re
import select
import subprocess
import time
import unittest

from dashpot_command import COMMAND_LINE_WRONG, CommandTest

COMMANDS = ["check", "compile", "completion", "device", "explain", "export", "fit", "import", "manual", "report", "run",
            "simulate",
            "verify"]


class Completion(CommandTest):
    def setUp(self):
        super().setUp()
        for shell, name in [("bash", "dashpot.bash"), ("zsh", "_dashpot"), ("fish", "dashpot.fish")]:
            self.write(name, self.dashpot("completion", shell).stdout)
        self.write("press.json", "")
        (self.folder / "folder").mkdir()

    def in_bash(self, line):
        words = line.split(" ")
        quoted = " ".join(repr(word) for word in words)
        script = f'. ./dashpot.bash; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _dashpot; ' \
                 'printf "%s\\n" "${COMPREPLY[@]}"'
        done = subprocess.run(["bash", "--norc", "-c", script], cwd=self.folder, capture_output=True, text=True,
                              check=True)
        self.assertEqual(done.stderr, "")
        return sorted(done.stdout.split())

    def in_fish(self, line):
        script = f"source dashpot.fish; complete -C {line!r}"
        home = str(self.folder / ".home")
        environment = {**os.environ, "HOME": home, "XDG_CONFIG_HOME": home}
        done = subprocess.run(["fish", "--no-config", "-c", script], cwd=self.folder, capture_output=True, text=True,
                              check=True,
                              env=environment)
        self.assertEqual(done.stderr, "")
        return sorted(answer.split("\t")[0] for answer in done.stdout.splitlines())

    def in_zsh(self, *lines):
        """What the shell makes of each line when Tab is pressed at its end, in a terminal of its own."""
        child, terminal = pty.fork()
        if child == 0:
            os.chdir(self.folder)
            os.execvpe("zsh", ["zsh", "-f", "-i"], {**os.environ, "TERM": "dumb", "HOME": str(self.folder),
                                                    "PS1": "> "})
        said = ""

        def read(until):
            nonlocal said
            end = time.monotonic() + 30
            while until not in said:
                self.assertLess(time.monotonic(), end, f"zsh does not say {until!r}:\n{said}")
                if select.select([terminal], [], [], 1)[0]:
                    said += os.read(terminal, 65536).decode(errors="replace")
            answer, said = said, ""
            return answer

        def send(text):
            os.write(terminal, text.encode())

        try:
            send("unsetopt zle_bracketed_paste; autoload -Uz compinit; compinit -u -D; . ./_dashpot; echo re''ady\n")
            read("ready\r")
            answers = []
            for line, until in lines:
                send(line + "\t")
                answers.append(read(until))
                send("\x15")  # forgets the line
            return answers
        finally:
            send("\nexit\n")
            os.close(terminal)
            os.waitpid(child, 0)

    def test_bash(self):
        """Fails if a command, an option, a value or a file is not offered, or one is where it does not belong."""
        self.assertEqual(self.in_bash("dashpot "), COMMANDS)
        self.assertEqual(self.in_bash("dashpot comp"), ["compile", "completion"])
        self.assertIn("--json", self.in_bash("dashpot explain --"))
        self.assertNotIn("--batch", self.in_bash("dashpot explain --"))
        self.assertEqual(self.in_bash("dashpot compile --scheme "), ["backward-euler", "exact"])
        self.assertIn("c99", self.in_bash("dashpot compile press.json --target "))
        self.assertIn("quietest-passive", self.in_bash("dashpot explain --decomposition q"))
        self.assertEqual(self.in_bash("dashpot compile pr"), ["press.json"])
        self.assertEqual(self.in_bash("dashpot compile -o "), ["folder"])
        self.assertEqual(self.in_bash("dashpot explain --json pr"), ["press.json"])  # a flag takes nothing
        self.assertEqual(self.in_bash("dashpot compile --rate "), [])
        self.assertEqual(self.in_bash("dashpot completion "), ["bash", "fish", "zsh"])

    def test_fish(self):
        """Fails likewise in fish."""
        self.assertEqual(self.in_fish("dashpot comp"), ["compile", "completion"])
        self.assertEqual([word for word in self.in_fish("dashpot ") if not word.startswith("-")], COMMANDS)
        self.assertEqual(self.in_fish("dashpot compile --scheme "), ["backward-euler", "exact"])
        self.assertIn("c99", self.in_fish("dashpot compile press.json --target "))
        self.assertIn("--json", self.in_fish("dashpot explain --"))
        self.assertNotIn("--batch", self.in_fish("dashpot explain --"))
        self.assertEqual(self.in_fish("dashpot compile pr"), ["press.json"])
        self.assertEqual(self.in_fish("dashpot compile --output "), ["folder/"])
        self.assertEqual(self.in_fish("dashpot completion "), ["bash", "fish", "zsh"])

    def test_zsh(self):
        """Fails likewise in zsh."""
        self.in_zsh(("dashpot expl", "explain "), ("dashpot compile --sche", "--scheme "),
                    ("dashpot compile --scheme ba", "backward-euler"), ("dashpot compile --target c9", "c99"),
                    ("dashpot compile pr", "press.json"), ("dashpot compile -o fol", "folder/"),
                    ("dashpot completion fi", "fish"))

    def test_wrong(self):
        """Fails if a shell that is not known gets a script."""
        self.assertIn("tcsh not in {bash,zsh,fish}",
                      self.dashpot("completion", "tcsh", status=COMMAND_LINE_WRONG).stderr)


class Manual(CommandTest):
    def shown(self, *command):
        page = self.write("page.1", self.dashpot("manual", *command).stdout)
        environment = {**os.environ, "MANWIDTH": "1000", "LC_ALL": "C.UTF-8"}
        done = subprocess.run(["groff", "-man", "-Tutf8", "-rLL=1000n", "-Kutf8", "-ww", "-P-cbou", str(page)],
                              capture_output=True,
                              text=True, env=environment, check=True)
        self.assertEqual(done.stderr, "")
        return re.sub(r"\s+", " ", done.stdout.replace("\u2010", "-").replace("\u2212", "-"))

    def test_pages(self):
        """Fails if a page lacks what --help says, is no page that groff sets without a warning, or is of no command."""
        for command in COMMANDS:
            page, text = self.shown(command), self.dashpot(command, "--help").stdout
            for option in re.findall(r"^  (?:-\w,)?(--[\w-]+)", text, re.MULTILINE):
                self.assertIn(option, page)
            self.assertIn(f"dashpot-{command} - {text.splitlines()[0]}", page)
        whole = self.shown()
        for command in COMMANDS:
            self.assertIn(f"dashpot-{command}(1)", whole.replace(" (1)", "(1)"))
        self.assertIn("dashpot-check, with a hyphen, is a separate one", self.shown("check"))
        for target in ["c99", "cpp"]:
            self.assertIn(target, self.shown("compile"))
        self.assertIn("there is no command 'complie'; 'compile' is the nearest",
                      self.dashpot("manual", "complie", status=COMMAND_LINE_WRONG).stderr)

    def test_the_status_of_a_run(self):
        """Fails if the page says that nothing was written where a run ended in a fault and its log is there."""
        self.assertIn("a fault ended it", self.shown("run"))
        self.assertNotIn("a fault ended it", self.shown("fit"))


if __name__ == "__main__":
    unittest.main()
