"""Runs curveskel the way a user does; what the tests of the command line share."""

import array
import math
import os
import pathlib
import signal
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CURVESKEL_PROGRAM"]
MESHES = pathlib.Path(os.environ["CURVESKEL_SOURCE_DIR"]) / "meshes"
Y = MESHES / "y.off"
TORUS = MESHES / "torus.off"
LINKED_RINGS = MESHES / "linked-rings.off"


def default_signals():
    # A shell in the background starts its children with Ctrl-C ignored.
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def start(*arguments, **options):
    """A running program, its output and messages in pipes."""
    pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    return subprocess.Popen([PROGRAM, *map(str, arguments)],
                            **{**pipes, "preexec_fn": default_signals, **options})


class Result:
    def __init__(self, process):
        self.out, err = process.communicate(timeout=300)
        self.err = (err or b"").decode()
        self.code = process.returncode


def run(*arguments, **options):
    return Result(start(*arguments, **options))


class CommandLineTest(unittest.TestCase):
    """Each test has an empty folder of its own, `self.folder`."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def files(self):
        return sorted(path.name for path in self.folder.rglob("*"))

    def run_ok(self, *arguments, **options):
        result = run(*arguments, **options)
        self.assertEqual(result.code, 0, result.err)
        return result

    def refused(self, code, *arguments, says=(), **options):
        """The exit code, a message that has these words, no output and no file."""
        before = self.files()
        result = run(*arguments, **options)
        self.assertEqual(result.code, code, result.err)
        for word in says:
            self.assertIn(word, result.err)
        last = [line for line in result.err.splitlines() if line.startswith("curveskel: ")]
        self.assertEqual(len(last), 1, result.err)
        self.assertEqual(result.out, b"")
        self.assertEqual(self.files(), before)
        return result


def write_torus(path, around, across):
    """A binary PLY with around * across vertices, twice as many triangles."""
    positions = array.array("f")
    for i in range(around):
        u = 2 * math.pi * i / around
        for j in range(across):
            v = 2 * math.pi * j / across
            ring = 3 + math.cos(v)
            positions.extend((ring * math.cos(u), ring * math.sin(u), math.sin(v)))
    faces = bytearray()
    for i in range(around):
        row, following = i * across, (i + 1) % around * across
        corners = array.array("i")
        for j in range(across):
            k = (j + 1) % across
            corners.extend((row + j, following + j, following + k, row + j, following + k, row + k))
        raw = corners.tobytes()
        for at in range(0, len(raw), 12):
            faces += b"\x03" + raw[at:at + 12]
    header = ("ply\nformat binary_little_endian 1.0\n"
              f"element vertex {around * across}\n"
              "property float x\nproperty float y\nproperty float z\n"
              f"element face {2 * around * across}\n"
              "property list uchar int vertex_indices\nend_header\n")
    path.write_bytes(header.encode() + positions.tobytes() + bytes(faces))
    return path
