"""The manual page says what --help says."""

import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from program import run

PAGE = pathlib.Path(sys.argv.pop())


def words_of(text):
    return re.findall(r"\S+", text)


def words_of_page():
    """Without requests, marks and headings."""
    lines = []
    for line in PAGE.read_text().splitlines():
        if line.startswith(".") and not line.startswith(".B "):
            continue
        lines.append(re.sub(r"^\.B |^\\&", "", line).replace("\\-", "-").replace("\\e", "\\"))
    return words_of("\n".join(lines))


def words_of_help():
    """Of the program and each verb but the viewer's, headings left out."""
    program = run("--help").out.decode()
    verbs = re.findall(r"^  ([a-z]+)  ", program.split("Subcommands:\n")[1], re.MULTILINE)
    texts = [program] + [run(verb, "--help").out.decode() for verb in verbs if verb != "view"]
    return words_of(re.sub(r"^(?:Usage: |[A-Z][a-zA-Z ]+:$)", "", "\n".join(texts),
                           flags=re.MULTILINE))


class Manual(unittest.TestCase):
    def test_every_word_of_the_help_stands_in_the_page_in_its_order(self):
        page = words_of_page()
        of_help = words_of_help()
        self.assertGreater(len(of_help), 1000)
        begin = page.index(of_help[0], page.index("-"))
        self.assertEqual(page[begin:begin + len(of_help)], of_help)

    def test_groff_understands_it(self):
        if shutil.which("groff") is None:
            self.skipTest("there is no groff")
        found = subprocess.run(["groff", "-ww", "-man", "-Tutf8", "-z", PAGE], capture_output=True)
        self.assertEqual((found.returncode, found.stderr), (0, b""))


if __name__ == "__main__":
    unittest.main()
