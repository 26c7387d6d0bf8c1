"""Pictures that extract writes: by the viewer where it stands beside the program and can draw, by
the library otherwise."""

import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

from program import PROGRAM, TORUS, Y, CommandLineTest, Result, default_signals

VIEWER = pathlib.Path(PROGRAM).with_name("curveskel-view")


class Picture(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.place = self.folder / "bin"
        self.place.mkdir()
        self.program = shutil.copy(PROGRAM, self.place / "curveskel")
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()

    def viewer(self, text):
        """What stands beside the program instead of the viewer."""
        file = self.place / "curveskel-view"
        file.write_text("#!/bin/sh\n" + text)
        file.chmod(0o755)

    def start(self, name, *arguments, program=None):
        return subprocess.Popen(
            [program or self.program, "extract", *map(str, arguments), "-o", self.folder / name],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            env={**os.environ, "TMPDIR": str(self.temporary)}, preexec_fn=default_signals)

    def draw(self, name, mesh=Y, **options):
        result = Result(self.start(name, mesh, **options))
        self.assertEqual(result.code, 0, result.err)
        self.assertEqual(list(self.temporary.iterdir()), [])
        return (self.folder / name).read_bytes(), result.err

    def test_is_the_viewers_where_it_is_installed(self):
        drawn, _ = self.draw("x.png", program=PROGRAM)
        self.draw("x.json", program=PROGRAM)
        subprocess.run([VIEWER, Y, self.folder / "x.json", "--two-sides", "--size", "1600x1200",
                        "--screenshot", self.folder / "y.png"], check=True, capture_output=True)
        self.assertEqual(drawn, (self.folder / "y.png").read_bytes())

    def test_is_the_librarys_without_it(self):
        alone, said = self.draw("x.png")
        self.assertTrue(alone.startswith(b"\x89PNG"))
        self.assertNotIn("OpenGL", said)
        self.assertNotEqual(alone, self.draw("y.png", program=PROGRAM)[0])

    def test_says_why_the_viewer_could_not(self):
        alone, _ = self.draw("x.png")
        self.viewer("echo 'curveskel: no OpenGL here' >&2; exit 4")
        drawn, said = self.draw("y.png")
        self.assertEqual(drawn, alone)
        self.assertIn("picture drawn without OpenGL: curveskel: no OpenGL here\n", said)

    def test_does_not_need_one_that_cannot_be_started(self):
        alone, _ = self.draw("x.png")
        (self.place / "curveskel-view").write_text("nothing that runs")
        self.assertEqual(self.draw("y.png")[0], alone)

    def test_ends_with_the_program(self):
        self.viewer(f"echo $$ >{self.folder}/pid; exec sleep 100")
        process = self.start("x.png", TORUS)
        end = time.monotonic() + 60
        while not (self.folder / "pid").exists() or not (self.folder / "pid").read_text():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        result = Result(process)
        self.assertEqual(result.code, 130, result.err)
        self.assertFalse((self.folder / "x.png").exists())
        self.assertEqual(list(self.temporary.iterdir()), [])
        with self.assertRaises(ProcessLookupError):
            os.kill(int((self.folder / "pid").read_text()), 0)

    def test_other_formats_do_not_start_it(self):
        self.viewer(f"touch {self.folder}/started")
        self.draw("x.svg")
        self.draw("x.obj")
        self.assertFalse((self.folder / "started").exists())


if __name__ == "__main__":
    unittest.main()
