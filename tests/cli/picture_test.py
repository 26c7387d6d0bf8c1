"""Pictures that extract writes: the library's, whatever stands beside the program."""

import os
import pathlib
import shutil
import subprocess
import unittest

from program import PROGRAM, Y, CommandLineTest, Result, default_signals


class Picture(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.place = self.folder / "bin"
        self.place.mkdir()
        self.program = shutil.copy(PROGRAM, self.place / "curveskel")

    def draw(self, name):
        result = Result(subprocess.Popen(
            [self.program, "extract", Y, "-o", self.folder / name],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            preexec_fn=default_signals))
        self.assertEqual(result.code, 0, result.err)
        return (self.folder / name).read_bytes()

    def test_is_the_same_with_and_without_a_viewer_beside_the_program(self):
        alone = self.draw("x.png")
        self.assertTrue(alone.startswith(b"\x89PNG"))
        viewer = self.place / "curveskel-view"
        installed = pathlib.Path(PROGRAM).with_name("curveskel-view")
        if installed.exists():
            os.symlink(installed, viewer)
            self.assertEqual(self.draw("y.png"), alone)
            viewer.unlink()
        viewer.write_text(f"#!/bin/sh\ntouch {self.folder}/started\n")
        viewer.chmod(0o755)
        self.assertEqual(self.draw("z.png"), alone)
        self.assertFalse((self.folder / "started").exists())


if __name__ == "__main__":
    unittest.main()
