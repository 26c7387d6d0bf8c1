"""The add-on in Blender: what it makes of the user's own objects without a window, and how its
buttons behave in one. Skipped where there is no Blender (Debian package blender), the window where
there is no screen (Debian package xvfb). The laws that run inside Blender are in addon/."""

import ast
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["CURVESKEL_SOURCE_DIR"])
PROGRAM = pathlib.Path(os.environ["CURVESKEL_PROGRAM"])
ZIP = pathlib.Path(os.environ["CURVESKEL_ADDON"])  # as the build makes it
LAWS = SOURCE / "tests" / "blender" / "addon"
FIND_LAWS = f"import sys; sys.dont_write_bytecode = True; sys.path.append({str(LAWS)!r})"

PYTHON_MODULE = "__version__ = 'of the Python module'\n"  # as python3-curveskel, in its stead


def capped_bar():
    """Half of a bar along x, from 0 to 4, open at 0: rings of eight and a cap."""
    import math
    rings = [(0.4 * k, 0.5) for k in range(10)] + [(3.8, 0.35)]
    lines, faces = [], []
    for x, radius in rings:
        lines += [f"{x} {radius * math.cos(k * math.pi / 4)} {radius * math.sin(k * math.pi / 4)}"
                  for k in range(8)]
    for ring in range(len(rings) - 1):
        for k in range(8):
            a, b = 8 * ring + k, 8 * ring + (k + 1) % 8
            faces += [(a, b, b + 8), (a, b + 8, a + 8)]
    last = 8 * (len(rings) - 1)
    lines.append("4 0 0")
    faces += [(last + k, last + (k + 1) % 8, len(lines) - 1) for k in range(8)]
    return off_text(lines, faces)


def off_text(lines, faces):
    return "\n".join(["OFF", f"{len(lines)} {len(faces)} 0", *lines,
                      *(f"3 {a} {b} {c}" for a, b, c in faces)]) + "\n"


OCTAHEDRON = off_text(
    ["0.1 0 0", "-0.1 0 0", "0 0.1 0", "0 -0.1 0", "0 0 0.1", "0 0 -0.1"],
    [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)])


@unittest.skipUnless(shutil.which("blender"), "needs Blender: install the Debian package blender")
class AddOn(unittest.TestCase):
    def run_in_blender(self, laws, before=("--background",), with_screen=()):
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            shutil.copy(ZIP, folder / "curveskel.zip")
            (folder / "half.off").write_text(capped_bar())
            (folder / "button.off").write_text(OCTAHEDRON)
            (folder / "tmp").mkdir()
            (folder / "scripts").mkdir()
            (folder / "modules" / "curveskel").mkdir(parents=True)
            (folder / "modules" / "curveskel" / "__init__.py").write_text(PYTHON_MODULE)
            # Blender takes the first python3 in the path for its own.
            environment = {**os.environ, "TMPDIR": str(folder / "tmp"),
                           "BLENDER_USER_SCRIPTS": str(folder / "scripts"),
                           "BLENDER_USER_CONFIG": str(folder / "config"),
                           "PYTHONPATH": str(folder / "modules"),
                           "PATH": f"{PROGRAM.parent}:/usr/local/bin:/usr/bin:/bin"}
            done = subprocess.run(
                [*with_screen, shutil.which("blender"), *before, "--python-exit-code", "1",
                 "--python-expr", FIND_LAWS, "--python", LAWS / f"{laws}.py", "--", folder, SOURCE],
                capture_output=True, text=True, stdin=subprocess.DEVNULL, env=environment,
                check=False, timeout=300)
            self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr[-3000:])
            return done.stdout

    def test_stands_beside_the_python_module(self):
        self.run_in_blender("python_module")

    def test_rigs_the_users_own_objects(self):
        self.run_in_blender("rig")

    def test_weights_leave_the_bones_alone(self):
        self.run_in_blender("weights")

    def test_half_a_body_with_a_mirror_is_whole(self):
        self.run_in_blender("mirror")

    def test_objects_stay_where_and_whose_they_are(self):
        self.run_in_blender("parents")

    def test_data_that_others_have_is_left_to_them(self):
        self.run_in_blender("shared_data")

    def test_rig_again_replaces_what_rig_made(self):
        self.run_in_blender("again")

    def test_bones_lie_along_their_limbs(self):
        self.run_in_blender("tails")

    def test_skeleton_comes_as_curves_with_radii(self):
        self.run_in_blender("skeleton")

    def test_what_the_program_warns_of_is_said(self):
        said = self.run_in_blender("warnings")
        for words in (", 1 warning\n", "Warning: no quadruped, which was asked for", ", 2 warnings\n",
                      "Warning: the names mixamo have no words for the plan quadruped",
                      "Warning: 1 of 2: the names mixamo have no words for the plan other",
                      "Warning: 2 of 2: no quadruped, which was asked for",
                      "lie within the box of the surface; move or turn the armature into",
                      ": scale the armature so\n"):
            self.assertIn(words, said)
        for words in ("--", "json", "glTF", "in.obj"):
            self.assertNotIn(words, said)

    def test_the_head_is_where_the_body_looks(self):
        self.run_in_blender("front")

    def test_failures_are_said_and_leave_nothing(self):
        self.run_in_blender("failures")

    def test_what_was_edited_meanwhile_is_refused(self):
        self.run_in_blender("meanwhile")

    @unittest.skipUnless(shutil.which("xvfb-run"), "needs a screen: install the Debian package xvfb")
    def test_buttons_run_and_end_in_a_window(self):
        self.run_in_blender("window", ("--factory-startup", "--enable-event-simulate"),
                            ("xvfb-run", "-a", "-s", "-screen 0 1280x800x24"))


class Words(unittest.TestCase):
    def test_are_those_of_the_panel(self):
        sys.path.insert(0, str(SOURCE / "blender" / "curveskel_addon"))
        import program
        for said, here in (
                ("in.obj: found a flat drawing; give it thickness (--least-sheet 0.01 does so with "
                 "sheets of a hundredth and more; Blender: the Solidify modifier) or close it first",
                 "found a flat drawing; give it thickness (the Solidify modifier) or close it first"),
                ("give another --up or --front", "give another Up or Front"),
                ("--front -y needs a plan, and --plan none makes none",
                 "Front -y needs a plan, and Plan none makes none"),
                ("another shape; choose a narrower --wrap-gap, or --wrap never", "another shape"),
                ("is large; choose a wider --wrap-gap, or decimate the surface first",
                 "is large; decimate the surface first"),
                ("in this order? (--wrap all takes what encloses them all)", "in this order?")):
            self.assertEqual(program.in_blender(said), here)


class Panel(unittest.TestCase):
    def choices(self, name):
        """The first words of the lists in panel.py."""
        tree = ast.parse((SOURCE / "blender" / "curveskel_addon" / "panel.py").read_text())
        for statement in tree.body:
            if isinstance(statement, ast.Assign) and statement.targets[0].id == name:
                return [pair[0] for pair in ast.literal_eval(statement.value.generators[0].iter)]
        self.fail(name)

    def test_offers_what_the_program_knows(self):
        for name, option in (("PLANS", "--plan"), ("NAMES", "--names")):
            said = subprocess.run([PROGRAM, "rig", "in.obj", "-o", "out.json", option, "unheard-of"],
                                  capture_output=True, text=True, check=False).stderr
            known = said.split("is none of: ")[1].split("\n")[0].split(", ")
            self.assertEqual(sorted(self.choices(name)), sorted(known))


if __name__ == "__main__":
    unittest.main()
