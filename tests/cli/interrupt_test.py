"""Ctrl-C: a prompt end, exit code 130 and no partial file, in every stage."""

import pathlib
import signal
import tempfile
import time
import unittest

from program import CommandLineTest, Result, start, write_torus


class Interrupt(CommandLineTest):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        # At full resolution this takes minutes.
        cls.mesh = write_torus(pathlib.Path(folder.name) / "torus.ply", 1500, 400)

    def interrupted(self, process, after):
        # The first stage has begun.
        self.assertEqual(process.stderr.readline(), b"read ...\n")
        time.sleep(after)
        self.assertIsNone(process.poll(), "ended before it could be interrupted")
        process.send_signal(signal.SIGINT)
        began = time.monotonic()
        result = Result(process)
        self.assertEqual(result.code, 130, result.err)
        self.assertIn("curveskel: interrupted\n", result.err)
        return time.monotonic() - began

    def test_ends_extract_in_every_stage(self):
        for after in (0, 0.2, 0.5, 1, 2, 4):
            process = start("extract", self.mesh, "-o", "x.obj", "-o", "x.png", "--report", "x.json",
                            "--resolution", "full", cwd=self.folder)
            # Within a second on an idle machine; the allowance is for one that is not.
            self.assertLess(self.interrupted(process, after), 10)
            self.assertEqual(self.files(), [])

    def test_ends_contract(self):
        process = start("contract", self.mesh, "-o", "x.ply", cwd=self.folder)
        self.assertLess(self.interrupted(process, 2), 10)
        self.assertEqual(self.files(), [])

    def test_ends_a_write_to_a_pipe_that_nobody_reads(self):
        small = write_torus(self.folder / "torus.ply", 300, 100)
        process = start("extract", small, "-o", "-", "--format", "json", cwd=self.folder)
        for line in process.stderr:
            if line == b"write ...\n":
                break
        time.sleep(1)
        self.assertIsNone(process.poll(), "all of it went into the pipe")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=10), 130)
        Result(process)

    def test_leaves_an_old_output_as_it_was(self):
        old = self.folder / "x.obj"
        old.write_text("old")
        process = start("extract", self.mesh, "-o", old, "--resolution", "full")
        self.interrupted(process, 1)
        self.assertEqual(old.read_text(), "old")


if __name__ == "__main__":
    unittest.main()
