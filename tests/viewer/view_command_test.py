"""curveskel view without a window: what it writes, what it refuses."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import time
import unittest

import numpy
from PIL import Image

SOURCE = pathlib.Path(os.environ["CURVESKEL_SOURCE_DIR"])
sys.path.insert(0, str(SOURCE / "tests" / "cli"))
from program import LINKED_RINGS, TORUS, Y, CommandLineTest, Result, run, start  # noqa: E402

USAGE, INPUT, DEVICE, OUTPUT = 2, 3, 4, 6
SHEET = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"


def pixels(file):
    """height x width x RGBA."""
    with Image.open(file) as picture:
        assert picture.format == "PNG" and picture.mode == "RGBA", (picture.format, picture.mode)
        return numpy.asarray(picture).astype(int)


def runs(profile):
    """Lengths of the stretches that are true."""
    edges = numpy.flatnonzero(numpy.diff(numpy.concatenate([[0], profile.astype(int), [0]])))
    return list(edges[1::2] - edges[::2])


class ViewTest(CommandLineTest):
    def picture(self, *arguments, size="160x100", name="picture.png", **options):
        file = self.folder / name
        self.run_ok("view", *arguments, "--size", size, "--screenshot", file, **options)
        return pixels(file)

    def skeleton(self, surface=Y, name="skeleton.json"):
        file = self.folder / name
        self.run_ok("extract", surface, "-o", file)
        return file

    def assert_differ(self, first, second):
        self.assertGreater(numpy.abs(first - second).max(), 20)


class Options(ViewTest):
    def test_preset_surgery_and_embedding_change_the_curve(self):
        usual = self.picture(Y)
        for options in (("--preset", "paper"), ("--surgery", "cgal", "--embed", "none")):
            self.assert_differ(usual, self.picture(Y, *options))
        overridden = self.picture(Y, "--embed", "own", "--preset", "default")
        numpy.testing.assert_array_equal(usual, overridden)

    def test_version(self):
        self.assertRegex(self.run_ok("view", "--version").out.decode(),
                         r"^curveskel \d+\.\d+\.\d+\n$")

    def test_unknown_presets_are_refused(self):
        self.refused(USAGE, "view", Y, "--screenshot", "x.png", "--preset", "nonsense",
                     says=["default", "paper"], cwd=self.folder)


    def test_without_effect_are_refused(self):
        out = ("--screenshot", self.folder / "x.png")
        for words in (["--joint", "root"], ["--colour", "weight"], ["--colour", "role"],
                      ["--colour", "part"]):
            with self.subTest(words):
                self.refused(USAGE, "view", Y, *words, *out, says=[words[0], "--stage rig"])
        self.refused(USAGE, "view", Y, "--turn", "a:1,2,3", *out, says=["--turn needs a rig"])
        self.refused(USAGE, "view", "-", *out, says=["no standard input", "name a file"])
        self.refused(USAGE, "view", Y, "--no-run", "--stage", "skeleton", *out, says=["--no-run"])
        rig = self.folder / "y.glb"
        self.run_ok("rig", Y, "-o", rig)
        for colour in ("role", "part"):
            self.refused(USAGE, "view", rig, "--colour", colour, *out,
                         says=[f"--colour {colour} needs a rig that is made", "--stage rig"])
        self.refused(USAGE, "view", Y, "--frame-times", self.folder / "times.csv", *out,
                     says=["--frame-times is for the window"])
        self.refused(USAGE, "view", Y, "--never-coarse", *out,
                     says=["--never-coarse is for the window"])
        self.refused(USAGE, "view", Y, "--frames", 3, *out, says=["--frames", "--turntable"])
        self.refused(USAGE, "view", Y, "--vrm-name", "a", *out, says=["--vrm-name", "the window"])


class Outputs(ViewTest):
    def test_that_cannot_be_written_are_refused_before_anything_runs(self):
        no_folder = self.folder / "nowhere" / "x.png"
        missing = self.folder / "missing.off"  # would be refused if it were read first
        self.refused(OUTPUT, "view", missing, "--screenshot", no_folder, says=["no folder"])
        self.refused(DEVICE, "view", missing, "--size", "16384x16384", "--screenshot",
                     self.folder / "x.png", says=["make it smaller"])

    def test_are_named(self):
        file = self.folder / "x.png"
        frames = self.folder / "frames"
        result = self.run_ok("view", Y, "--no-run", "--size", "16x10", "--screenshot", file,
                             "--turntable", frames, "--frames", 3)
        self.assertEqual(result.out.decode(), f"wrote {file}\nwrote 3 pictures to {frames}\n")


class Screenshot(ViewTest):
    def test_of_a_surface_a_skeleton_or_both(self):
        skeleton = self.skeleton()
        of = {"surface": (Y, "--no-run"), "extracted": (Y,), "skeleton": (skeleton,),
              "both": (Y, skeleton)}
        found = {name: self.picture(*arguments) for name, arguments in of.items()}
        for name in ("surface", "skeleton"):
            self.assert_differ(found[name], found["extracted"])
        self.assert_differ(found["surface"], found["skeleton"])
        numpy.testing.assert_array_equal(found["both"], found["extracted"])

    def test_of_the_skeleton_of_a_rig_has_no_bones_unless_they_are_asked_for(self):
        rig = self.folder / "y.glb"
        self.run_ok("rig", Y, "-o", rig, "--bare")
        options = ("--stage", "skeleton", "--colour", "plain", "--surface", "hidden")
        curve = self.picture(rig, *options)
        numpy.testing.assert_array_equal(curve, self.picture(rig, *options, "--no-bones"))
        self.assert_differ(curve, self.picture(rig, *options, "--joint", "root"))

    def test_needs_no_display(self):
        without = {name: value for name, value in os.environ.items()
                   if name not in ("DISPLAY", "WAYLAND_DISPLAY", "XDG_RUNTIME_DIR")}
        self.picture(TORUS, "--no-run", env=without)

    def test_has_the_size_asked_for(self):
        for width, height in ((1, 1), (7, 300), (333, 2), (641, 359)):
            found = self.picture(TORUS, "--no-run", size=f"{width}x{height}")
            self.assertEqual(found.shape, (height, width, 4))

    def test_is_opaque(self):
        for theme in ("light", "dark"):
            found = self.picture(TORUS, "--theme", theme)
            self.assertEqual(found[..., 3].min(), 255)

    def test_without_a_background(self):
        for style in ("transparent", "opaque", "wireframe", "hidden"):
            alpha = self.picture(TORUS, "--transparent", "--surface", style)[..., 3]
            for border in (alpha[0], alpha[-1], alpha[:, 0], alpha[:, -1]):
                self.assertEqual(border.max(), 0, style)
            self.assertGreater(alpha.max(), 200, style)

    def test_gives_the_same_bytes_again(self):
        for name in ("first.png", "second.png"):
            self.picture(LINKED_RINGS, "--colour", "node", "--edges", name=name)
        self.assertEqual((self.folder / "first.png").read_bytes(),
                         (self.folder / "second.png").read_bytes())

    def test_replaces_an_old_one(self):
        (self.folder / "picture.png").write_text("old")
        self.picture(TORUS, "--no-run")

    def test_from_two_sides_has_room_for_both(self):
        # A flat ring: round from its best side, thin at a right angle to it.
        for size in ("300x200", "200x300"):
            seen = self.picture(TORUS, "--two-sides", "--transparent", "--skeleton", "hidden",
                                size=size)[..., 3] > 0
            for border in (seen[0], seen[-1], seen[:, 0], seen[:, -1]):
                self.assertFalse(border.any())
            split = [axis for axis in (0, 1) if len(runs(seen.any(axis=axis))) == 2]
            self.assertEqual(len(split), 1, "beside or below each other")
            first, second = runs(seen.any(axis=split[0]))
            self.assertGreater(max(first, second), 1.5 * min(first, second))

    def test_from_two_sides_needs_a_surface(self):
        self.refused(INPUT, "view", self.skeleton(), "--two-sides", "--screenshot",
                     self.folder / "x.png", says=["--two-sides needs a surface"])
        self.refused(USAGE, "view", TORUS, "--two-sides", says=["--two-sides is for --screenshot"])

    def test_options_make_a_difference(self):
        plain = self.picture(Y)
        for words in (["--surface", "opaque"], ["--surface", "wireframe"], ["--surface", "hidden"],
                      ["--skeleton", "balls"], ["--skeleton", "hidden"], ["--theme", "dark"],
                      ["--colour", "radius"], ["--colour", "branch"], ["--edges"],
                      ["--skeleton-colour", "node"], ["--camera", "left"],
                      ["--camera", "20,10,1.5"], ["--opacity", "0.9"], ["--thickness", "4"],
                      ["--detail", "0", "--skeleton", "balls"]):
            with self.subTest(words):
                self.assert_differ(self.picture(Y, *words), plain)


class Stages(ViewTest):
    def test_differ(self):
        stages = ("input", "contraction:1", "contraction:3", "contraction", "skeleton", "rig")
        found = [self.picture(LINKED_RINGS, "--stage", stage) for stage in stages]
        for i, one in enumerate(found):
            for other in found[:i]:
                self.assert_differ(one, other)

    def test_skeleton_is_the_last(self):
        numpy.testing.assert_array_equal(self.picture(Y, "--stage", "skeleton"), self.picture(Y))

    def test_input_is_what_no_run_shows(self):
        numpy.testing.assert_array_equal(self.picture(Y, "--stage", "input"),
                                         self.picture(Y, "--no-run"))

    def test_rig_of_a_given_skeleton_is_that_of_the_extracted_one(self):
        extracted = self.folder / "y.json"
        self.run_ok("extract", Y, "-o", extracted)
        rig = self.picture(Y, "--stage", "rig")
        numpy.testing.assert_array_equal(self.picture(Y, extracted, "--stage", "rig"), rig)
        self.assert_differ(self.picture(Y, "--stage", "rig", "--joint", "root"), rig)

    def test_rig_of_a_given_skeleton_has_the_root_that_it_names(self):
        extracted = self.skeleton()
        usual = self.picture(Y, extracted, "--stage", "rig", "--joint", "root")
        skeleton = json.loads(extracted.read_text())
        skeleton["root"] = len(skeleton["nodes"]) - 1
        extracted.write_text(json.dumps(skeleton))
        rooted = self.picture(Y, extracted, "--stage", "rig", "--joint", "root")
        self.assert_differ(rooted, usual)

    def test_a_second_rig_beside_the_files_own_is_said(self):
        own = self.folder / "y.glb"
        self.run_ok("rig", Y, "-o", own)
        says = "the file has a rig, which is shown without --stage rig"
        out = self.folder / "picture.png"
        for file, is_said in ((own, True), (Y, False)):
            done = self.run_ok("view", file, "--stage", "rig", "--screenshot", out)
            self.assertEqual(says in done.err, is_said, file)
        self.assertNotIn(says, self.run_ok("view", own, "--screenshot", out).err)

    def test_a_rig_has_joints_in_sheets_unless_told_otherwise(self):
        head, counts, *lines = pathlib.Path(Y).read_text().splitlines()
        vertices, faces = map(int, counts.split()[:2])
        wing = ["7.1 -2 0", "12 -2 0", "12 2 0", "7.1 2 0"]
        file = self.folder / "wing.off"
        file.write_text("\n".join(
            [head, f"{vertices + 4} {faces + 1} 0", *lines[:vertices], *wing,
             *lines[vertices:vertices + faces],
             "4 " + " ".join(str(vertices + i) for i in range(4)), ""]))
        rig = self.picture(file, "--stage", "rig")
        bare = self.picture(file, "--least-sheet", "0", "--stage", "rig")
        self.assert_differ(rig, bare)
        numpy.testing.assert_array_equal(
            self.picture(file, "--stage", "rig", "--least-sheet", "0"), bare)
        numpy.testing.assert_array_equal(
            self.picture(file, "--stage", "rig", "--least-sheet", "0.1"), rig)

    def test_that_never_come_are_refused(self):
        skeleton = self.skeleton()
        out = self.folder / "out.png"
        for files, stage in (((Y,), "fairing"), ((Y,), "contraction:999"),
                             ((skeleton,), "contraction:1")):
            with self.subTest(stage, files=files):
                self.refused(INPUT, "view", *files, "--stage", stage, "--screenshot", out,
                             says=[stage.split(":")[0]])
        for stage in ("contraction:1", "skeleton"):
            self.refused(USAGE, "view", Y, "--no-run", "--stage", stage, "--screenshot", out,
                         says=["--no-run", stage.split(":")[0]])

    def test_of_fairing_show_every_component(self):
        def reach(*words):
            alpha = self.picture(LINKED_RINGS, "--transparent", *words)[..., 3]
            return numpy.array([[axis.min(), axis.max()] for axis in numpy.nonzero(alpha)])

        for iteration in (0, 2):
            faired = reach("--fair", 2, "--stage", f"fairing:{iteration}")
            self.assertLessEqual(numpy.abs(faired - reach("--no-run")).max(), 3)

    def test_of_fairing_come_where_it_is_asked_for(self):
        self.assert_differ(self.picture(Y, "--fair", 3, "--stage", "fairing:3"),
                           self.picture(Y, "--fair", 3))


class Framing(ViewTest):
    """What is shown lies within the picture."""

    def shown(self, *arguments):
        alpha = self.picture(*arguments, "--transparent")[..., 3]
        border = max(alpha[0].max(), alpha[-1].max(), alpha[:, 0].max(), alpha[:, -1].max())
        self.assertEqual(border, 0, arguments)
        rows, columns = numpy.nonzero(alpha)
        self.assertGreater(len(rows), 0, arguments)
        return max(numpy.ptp(rows) / alpha.shape[0], numpy.ptp(columns) / alpha.shape[1])

    def test_fills_the_picture(self):
        for mesh in (Y, TORUS, LINKED_RINGS):
            for camera in ("best", "front", "left", "top", "35,20", "0,90", "0,-90"):
                for words in ((), ("--orthographic",)):
                    self.assertGreater(
                        self.shown(mesh, "--no-run", "--camera", camera, *words), 0.6)

    def test_of_a_skeleton_alone_has_room_for_its_balls(self):
        ball = self.folder / "ball.off"
        subprocess.run([os.environ["CURVESKEL_SHAPES"], "sphere", ball], check=True,
                       stdout=subprocess.DEVNULL)
        for mesh in (Y, TORUS, ball):
            share = self.shown(self.skeleton(mesh), "--skeleton", "balls")
            self.assertGreater(share, 0.6)


class Camera(ViewTest):
    def test_from_above_is_the_top(self):
        low, high = (self.picture(TORUS, "--no-run", "--camera", f"0,{elevation}")
                     for elevation in (0, 90))
        self.assert_differ(low, high)
        numpy.testing.assert_array_equal(
            high, self.picture(TORUS, "--no-run", "--camera", "0,120"))

    def test_zoom_leaves_the_glass_as_thick(self):
        # The middle of a ball is as thick from any distance.
        ball = self.folder / "ball.off"
        subprocess.run([os.environ["CURVESKEL_SHAPES"], "sphere", ball], check=True,
                       stdout=subprocess.DEVNULL)
        middle = [self.picture(ball, "--no-run", "--orthographic", "--opacity", "0.2",
                               "--transparent", "--camera", f"0,0,{zoom}")[50, 80]
                  for zoom in (1, 12)]
        self.assertLess(abs(middle[0][3] - middle[1][3]), 4)


class Turntable(ViewTest):
    def test_writes_as_many_pictures_as_asked_for(self):
        for frames in (1, 5):
            folder = self.folder / f"frames-{frames}" / "deep"
            self.run_ok("view", Y, "--no-run", "--turntable", folder, "--frames", frames,
                        "--size", "160x100")
            names = sorted(file.name for file in folder.iterdir())
            self.assertEqual(names, [f"{i:04}.png" for i in range(frames)])
            for name in names:
                self.assertEqual(pixels(folder / name).shape, (100, 160, 4))

    def test_turns_all_around_within_the_picture(self):
        folder = self.folder / "turning"
        self.run_ok("view", Y, "--no-run", "--turntable", folder, "--frames", 8, "--size",
                    "160x100", "--transparent", "--camera", "10,30")
        found = [pixels(file) for file in sorted(folder.iterdir())]
        for i, one in enumerate(found):
            for border in (one[0], one[-1], one[:, 0], one[:, -1]):
                self.assertEqual(border[..., 3].max(), 0, f"frame {i}")
            self.assert_differ(one, found[i - 1])

    def test_that_is_stopped_says_what_it_wrote(self):
        for signal_or_limit in (True, False):
            folder = self.folder / f"stopped-{signal_or_limit}"
            limit = () if signal_or_limit else ("--time-limit", 4)
            process = start("view", Y, "--no-run", "--turntable", folder, "--frames", 10000,
                            "--size", "640x400", *limit)
            while signal_or_limit and not (folder / "0001.png").exists():
                self.assertIsNone(process.poll())
                time.sleep(0.01)
            if signal_or_limit:
                process.send_signal(signal.SIGINT)
            result = Result(process)
            count = len(list(folder.iterdir())) if folder.exists() else 0
            self.assertEqual(result.code, 130 if signal_or_limit else 5)
            if count > 0:
                self.assertIn(f"{count} file{'s were' if count > 1 else ' was'} written before",
                              result.err)

    def test_begins_like_the_screenshot(self):
        # One frame is nothing but the screenshot about the middle of the shape's box.
        for camera in ("best", "left", "0,0,2"):
            folder = self.folder / camera
            still = self.picture(TORUS, "--turntable", folder, "--frames", 1, "--camera", camera)
            first = pixels(folder / "0000.png")
            self.assertLess(numpy.abs(first - still).mean(), 1.5, camera)


class Refused(ViewTest):
    def refuses(self, code, *arguments, says=()):
        self.refused(code, "view", *arguments, "--screenshot", self.folder / "out.png", says=says)

    def test_sizes(self):
        for size in ("320", "320x", "x200", "0x200", "320x-1", "320x200x3", "99999x10", "axb", ""):
            self.refuses(USAGE, Y, "--size", size, says=["--size", "WIDTHxHEIGHT"])

    def test_cameras(self):
        for camera in ("up", "30", "30,", "30,20,0", "a,b", "", "nan,0"):
            self.refuses(USAGE, Y, f"--camera={camera}", says=["--camera", "best", "AZIMUTH"])

    def test_stages(self):
        for stage in ("embed", "contract", "contraction:", "contraction:-1", "contraction:x",
                      "input:3", "skeleton:1", "fair", ""):
            self.refuses(USAGE, Y, "--stage", stage, says=["--stage", "contraction[:K]"])

    def test_looks(self):
        for words in (["--surface", "glass"], ["--theme", "grey"], ["--colour", "red"],
                      ["--map", "jet"], ["--opacity", "2"], ["--frames", "0"]):
            self.refuses(USAGE, Y, *words, says=[words[0]])

    def test_a_picture_of_nothing(self):
        self.refuses(USAGE)

    def test_files_that_are_missing_or_no_shape(self):
        self.refuses(INPUT, self.folder / "missing.off", says=["missing.off"])
        empty = self.folder / "empty.off"
        empty.write_text("")
        self.refuses(INPUT, empty, says=["empty.off"])
        self.refuses(INPUT, Y, empty, says=["empty.off"])

    def test_two_of_a_kind(self):
        self.refuses(INPUT, Y, TORUS, says=[Y.name, TORUS.name])
        skeleton = self.skeleton()
        self.refuses(INPUT, skeleton, skeleton, says=[skeleton.name])

    def test_what_encloses_nothing_as_extract_does(self):
        sheet = self.folder / "sheet.off"
        sheet.write_text(SHEET)
        self.refuses(INPUT, sheet, says=["sheet.off"])
        self.refused(INPUT, "extract", sheet, "-o", self.folder / "out.obj")
        self.picture(sheet, "--no-run")

    def test_places_that_cannot_be_written_to(self):
        file = self.folder / "file"
        file.write_text("kept")
        taken = self.folder / "folder.png"
        taken.mkdir()
        for out in (self.folder / "missing" / "out.png", taken):
            self.refused(OUTPUT, "view", Y, "--no-run", "--size", "16x10", "--screenshot", out,
                         says=[str(out)])
        for out in (file, file / "below", "/proc/none"):
            self.refused(OUTPUT, "view", Y, "--no-run", "--size", "16x10", "--turntable", out,
                         says=[str(out)])
        self.assertEqual(file.read_text(), "kept")

    def test_a_disk_that_is_full(self):
        full = self.folder / "full.png"
        full.symlink_to("/dev/full")
        self.refused(OUTPUT, "view", Y, "--no-run", "--size", "16x10", "--screenshot", full)

    def test_pictures_that_are_no_png(self):
        for out in ("x.jpg", "x.svg", "x"):
            self.refused(USAGE, "view", "missing.off", "--screenshot", out, says=[out, "png"],
                         cwd=self.folder)
        self.picture(Y, "--no-run", name="picture.PNG")


if __name__ == "__main__":
    unittest.main()
