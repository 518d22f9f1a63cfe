"""Tests the runner of README blocks itself: a block that does not do what it says is to be found.

    python3 run_blocks_test.py PREFIX
"""
import pathlib
import sys
import tempfile
import unittest

from run_blocks import Failure, check_links, run_readme

PREFIX = sys.argv.pop()

SPRING = '''
```json
{ "dashpot": 1, "name": "one_spring", "network": { "spring": "2 N/m", "name": "K" } }
```
'''
PROGRAM = '''
```cpp
#include <cstdio>
#include "one_spring.hpp"
int main() { std::printf("%g N\\n", dashpot::generated::one_spring{}.step(3, 0).force); }
```
'''


class RunBlocks(unittest.TestCase):

    # Fails if good blocks are refused: a network, a program against what is emitted, its output, a quotation, a
    # command.
    def test_runs_good_blocks(self):
        text = (SPRING + PROGRAM + "```text\n6 N\n```\n```cpp\nclass one_spring {\n…\nprivate:\n```\n"
                "```sh\nls main\n```\n")
        self.assertEqual(run_readme(text.replace("private:", " private:"), PREFIX), 5)

    def assert_refused(self, text, reason):
        with self.assertRaisesRegex(Failure, reason):
            run_readme(text, PREFIX)

    # Fails if a README may show a network that the compiler refuses.
    def test_refuses_bad_networks(self):
        self.assert_refused(SPRING.replace("2 N/m", "2 N"), r"(?s)line 2: json: .*one_spring.json:1:")

    # Fails if a README may show a program that does not compile, or one that fails.
    def test_refuses_bad_programs(self):
        self.assert_refused(SPRING + PROGRAM.replace(".force", ".power"), "(?s)line 6: cpp: .*power")
        self.assert_refused("```cpp\nint main() { return 1; }\n```", "line 1: cpp: ./main")

    # Fails if a README may show a program in C that is none, or what is none of C99.
    def test_refuses_bad_c(self):
        emit = SPRING + "```sh\ndashpot compile one_spring.json --target c99 -o emitted\n```\n"
        program = """```c
#include <stdio.h>
#include <one_spring.h>
int main(void) {
  one_spring law;
  one_spring_reset(&law, 0.0);
  printf("%g N\\n", one_spring_step(&law, 3.0, 0.0).force);
  return 0;
}
```
"""
        self.assertEqual(run_readme(emit + program + "```text\n6 N\n```", PREFIX), 4)
        self.assert_refused(emit + program.replace(".force", ".power"), "(?s)c: .*power")
        self.assert_refused(emit + program.replace("one_spring law;", "one_spring law = {};"), "(?s)c: .*empty")

    # Fails if a README may promise other output than is printed.
    def test_refuses_other_output(self):
        self.assert_refused(SPRING + PROGRAM + "```text\n7 N\n```", "text: the block before printed\n6 N")

    # Fails if a README may quote what no emitted header says, or in another order.
    def test_refuses_misquotations(self):
        self.assert_refused(SPRING + "```cpp\nclass two_springs {\n```", "no emitted header")
        self.assert_refused(SPRING + "```cpp\n private:\nclass one_spring {\n```", "no emitted header")

    # Fails if a command may fail, or any part of a pipe.
    def test_refuses_failing_commands(self):
        self.assert_refused("```sh\nfalse | true\n```", "line 1: sh")

    # Fails if blocks can hide from the test.
    def test_refuses_what_it_cannot_run(self):
        self.assert_refused("```\nls\n```", "language ''")
        self.assert_refused("```python\nls\n```", "language 'python'")
        self.assert_refused("  ```sh\nls\n```\n", "fence")
        self.assert_refused("```sh\nls\n", "fence")

    # Fails if a page may send its reader to a file or a heading that is not there.
    def test_refuses_links_that_lead_nowhere(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "other.md").write_text("# Words, and `code`\n```sh\n# no heading\n```\n")
            check_links("## Here\n[a](other.md) [b](other.md#words-and-code) [c](#here) [d](https://example.org/x#y)",
                        folder)
            for link in ("another.md", "other.md#no-heading", "#there"):
                with self.assertRaisesRegex(Failure, f"link to '{link}'"):
                    check_links(f"# Here\n[a]({link})", folder)

    # Fails if a page may show a `./try` that the real one would not understand.
    def test_try_takes_the_options_of_the_real_one(self):
        run_readme("```sh\n./try --install ~/dashpot\n~/dashpot/bin/dashpot --version\n```\n", PREFIX)
        self.assert_refused("```sh\n./try --instal ~/dashpot\n```\n", "line 1: sh")


if __name__ == "__main__":
    unittest.main()
