"""Runs every code block of a page, in order, in one scratch folder, and follows its links.

    python3 run_blocks.py PAGE.md PREFIX

PREFIX is where dashpot is installed. The scratch folder looks like a clone in which `./try --install ~/dashpot` has
run: it has `networks/`, `runtime/` and `examples/`, a `try` that builds nothing, since PREFIX is built, and a home with
`dashpot/` in it. What happens to a block depends on its language:

    json   a network or a device: saved under its name and compiled, without warnings passing for errors
    sh     run by bash, dashpot on the path; a command that fails fails the test
    cpp    a program: saved as main.cpp, compiled strictly against the runtime, run. Without main(): a quotation, whose
           lines must stand in this order in a header that the blocks before have emitted
    c      a program in C: saved as main.c, compiled strictly as C99, run
    cmake  saved as CMakeLists.txt, configured and built against the installed package
    text   what the block before printed; a line `…` stands for any number of lines

Any other language, or none, is an error: nothing in a page goes unread. So is a link to a file or a heading that is not
there.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
TRY = """#!/usr/bin/env bash
# Takes the options of the real one.
[[ $# == 0 || ( $# == 1 && $1 == --figures ) || ( $# == 2 && $1 == --install && -n $2 ) ]] || exit 2
"""
BLOCK = re.compile(r"^```([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
STRICT = ["-std=c++17", "-O1", "-ffp-contract=off", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow",
          "-Wdouble-promotion", "-Werror"]
PLAIN_NETWORK = {"dashpot": 1, "name": "plain", "motion": None,
                 "network": {"parallel": [{"spring": 1}, {"damper": 1}]}}


class Failure(Exception):
    pass


class Scratch:
    """The folder that the blocks of one page share, and what the last of them printed."""

    def __init__(self, folder, prefix):
        self.folder, self.prefix = pathlib.Path(folder), pathlib.Path(prefix)
        self.printed = ""
        self.environment = dict(os.environ, PATH=f"{self.prefix / 'bin'}:{os.environ['PATH']}",
                                CMAKE_PREFIX_PATH=str(self.prefix))
        for room in ("networks", "runtime", "examples"):
            (self.folder / room).symlink_to(ROOT / room)
        (self.folder / "try").write_text(TRY)
        (self.folder / "try").chmod(0o755)
        self.home = self.folder / "home"
        self.home.mkdir()
        (self.home / "dashpot").symlink_to(self.prefix.resolve())

    def run(self, *command, **variables):
        done = subprocess.run([str(part) for part in command], cwd=self.folder, env={**self.environment, **variables},
                              text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode != 0:
            raise Failure(f"{' '.join(str(part) for part in command)}\n{done.stdout}")
        self.printed = done.stdout

    def save(self, name, text):
        (self.folder / name).write_text(text)
        return name


def run_json(scratch, text):
    file = json.loads(text)
    name = scratch.save(f"{file['name']}.json", text)
    if "dashpot_device" not in file:
        scratch.run("dashpot", "compile", name, "-o", ".")
        return
    if file.get("axes", 1) > 1:
        scratch.run("dashpot", "check", name)
        return
    network = dict(PLAIN_NETWORK, motion="translation" if "arm_radius" in file else file.get("motion", "translation"))
    scratch.run("dashpot", "explain", scratch.save("plain.json", json.dumps(network)), "--device", name)


def run_sh(scratch, text):
    scratch.run("bash", "-euo", "pipefail", "-c", text, HOME=str(scratch.home))


def run_cpp(scratch, text):
    if not re.search(r"\bmain\(", text):
        check_quotation(scratch, text)
        return
    source = scratch.save("main.cpp", text)
    libraries = sorted((scratch.prefix / "lib").glob("libdashpot_*.a"))
    scratch.run(os.environ.get("CXX", "c++"), *STRICT, *os.environ.get("CXXFLAGS", "").split(), "-I",
                scratch.prefix / "include", "-I", "emitted", "-I", ".", source,
                "-Wl,--start-group", *libraries, "-Wl,--end-group", "-pthread", "-o", "main")
    scratch.run("./main")


def run_c(scratch, text):
    source = scratch.save("main.c", text)
    strict = [flag.replace("c++17", "c99") for flag in STRICT]
    scratch.run(os.environ.get("CC", "cc"), *strict, "-I", scratch.prefix / "include", "-I", "emitted", "-I", ".",
                source,
                "-o", "main")
    scratch.run("./main")


def check_quotation(scratch, text):
    headers = [path.read_text() for path in scratch.folder.rglob("*.hpp")]
    if not any(stands_in(text, header) for header in headers):
        raise Failure("no emitted header has these lines in this order")


def run_cmake(scratch, text):
    scratch.save("CMakeLists.txt", text)
    scratch.run("cmake", "-G", "Ninja", "-S", ".", "-B", "build")
    scratch.run("cmake", "--build", "build")


def run_text(scratch, text):
    if not matches(text, scratch.printed):
        raise Failure(f"the block before printed\n{scratch.printed}")


def stripped_lines(text):
    return [line.strip() for line in text.splitlines() if line.strip()]


def stands_in(quotation, text):
    """True if the lines of the quotation come in this order in the text; `…` and indentation aside."""
    lines = iter(stripped_lines(text))
    return all(wanted in lines for wanted in stripped_lines(quotation) if wanted not in ("…", "// …"))


def matches(expected, printed):
    pattern = "".join(r"(?:.*\n)*?" if line.strip() == "…" else re.escape(line.rstrip()) + r"[ \t]*\n"
                      for line in expected.splitlines())
    return re.fullmatch(pattern, printed) is not None


RUN = {"json": run_json, "sh": run_sh, "c": run_c, "cpp": run_cpp, "cmake": run_cmake, "text": run_text}


def blocks(text):
    """(line, language, text) of each fenced block."""
    for match in BLOCK.finditer(text):
        yield text.count("\n", 0, match.start()) + 1, match.group(1).strip(), match.group(2)


def anchors(text):
    """What links to headings of this page end in, as the page's readers make them."""
    without_code = BLOCK.sub("", text)
    return {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
            for heading in HEADING.findall(without_code)}


def check_links(text, folder):
    """Raises Failure for the first link of a page in `folder` that leads nowhere; pages elsewhere are left alone."""
    for target in LINK.findall(BLOCK.sub("", text)):
        if re.match(r"\w+:", target):
            continue
        file, _, anchor = target.partition("#")
        path = folder / file
        if file and not path.exists():
            raise Failure(f"link to '{target}': there is no such file")
        if anchor and anchor not in anchors(path.read_text() if file else text):
            raise Failure(f"link to '{target}': there is no such heading")


def run_readme(text, prefix):
    """The number of blocks run. Raises Failure, with the line, for the first block that does not do what it should."""
    count = 0
    with tempfile.TemporaryDirectory(prefix="readme") as folder:
        scratch = Scratch(folder, prefix)
        for line, language, block in blocks(text):
            if language not in RUN:
                raise Failure(f"line {line}: a block of language '{language}' cannot be run")
            try:
                RUN[language](scratch, block)
            except Failure as failure:
                raise Failure(f"line {line}: {language}: {failure}") from None
            count += 1
    if text.count("\n```") + text.startswith("```") != 2 * count:
        raise Failure("a fence that opens no block, or closes none")
    return count


if __name__ == "__main__":
    readme, prefix = pathlib.Path(sys.argv[1]), sys.argv[2]
    try:
        check_links(readme.read_text(), readme.parent)
        print(f"{readme.name}: {run_readme(readme.read_text(), prefix)} blocks ran")
    except Failure as failure:
        sys.exit(f"{readme}: {failure}")
