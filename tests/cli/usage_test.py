"""What the program says when it is asked, and when it is asked wrongly."""

import gzip
import os
import resource
import shutil
import subprocess
import unittest

from program import PROGRAM, TORUS, Y, CommandLineTest, run

USAGE, INPUT, DEVICE, OUTPUT = 2, 3, 4, 6


class Help(CommandLineTest):
    def test_names_every_verb_and_exit_code(self):
        text = self.run_ok("--help").out.decode()
        for word in ("extract", "contract", "evaluate", "devices", "Exit codes", "130"):
            self.assertIn(word, text)

    def test_of_a_verb_shows_defaults_and_names(self):
        text = self.run_ok("extract", "--help").out.decode()
        for word in ("--flow NAME=medial", "--solver NAME=auto", "--resolution N|full=8000",
                     "--detail N=0.5", "--fair N=0", "--threads N=0", "graphml", "cholesky"):
            self.assertIn(word, text)

    def test_of_strict_names_all_that_it_makes_an_error(self):
        for verb in ("extract", "evaluate"):
            text = " ".join(self.run_ok(verb, "--help").out.decode().split())
            for word in ("leaves the surface", "half-way through a limb", "not made of tubes",
                         "another shape"):
                self.assertIn(word, text)

    def test_version(self):
        self.assertRegex(self.run_ok("--version").out.decode(), r"^curveskel \d+\.\d+\.\d+\n$")


class View(CommandLineTest):
    def test_says_how_to_get_the_window_where_it_is_not_installed(self):
        alone = shutil.copy(PROGRAM, self.folder / "curveskel")
        result = subprocess.run([alone, "view", Y], capture_output=True, text=True)
        self.assertEqual(result.returncode, DEVICE, result.stderr)
        for word in ("curveskel-view", "./run view"):
            self.assertIn(word, result.stderr)


class WrongArguments(CommandLineTest):
    def test_list_the_right_verbs(self):
        for arguments in ((), ("extrakt", TORUS)):
            self.refused(USAGE, *arguments, says=["extract", "contract", "evaluate", "devices"])

    def test_list_the_right_options(self):
        self.refused(USAGE, "extract", TORUS, "-o", "x.obj", "--flwo", "medial",
                     says=["--flwo", "--flow is"], cwd=self.folder)
        result = self.refused(USAGE, "extract", TORUS, "-o", "x.obj", "--unheard-of", "medial",
                              says=["--unheard-of", "--flow", "--resolution"], cwd=self.folder)
        self.assertNotIn(", ,", result.err)

    def test_take_one_surface(self):
        self.refused(USAGE, "extract", TORUS, TORUS, "-o", "x.obj", says=["one surface", "batch"],
                     cwd=self.folder)

    def test_list_the_right_flows(self):
        for verb, output in (("extract", "x.obj"), ("contract", "x.ply")):
            self.refused(USAGE, verb, TORUS, "-o", output, "--flow", "papre",
                         says=["papre", "medial", "paper"], cwd=self.folder)

    def test_list_the_right_solvers(self):
        self.refused(USAGE, "extract", TORUS, "-o", "x.obj", "--solver", "qr",
                     says=["auto", "cholesky", "sparse-qr"], cwd=self.folder)

    def test_list_the_right_formats(self):
        formats = ["obj", "ply", "cgal", "swc", "vtp", "csv", "graphml", "json", "svg", "png"]
        for output in ("x.xyz", "x", ".obj"):
            self.refused(USAGE, "extract", TORUS, "-o", output, says=formats, cwd=self.folder)
        self.refused(USAGE, "extract", TORUS, "-o", "-", "--format", "xyz", says=formats)
        for output in ("x.glb", "x.gltf", "x.xyz", "x"):
            self.refused(USAGE, "fair", "no.off", "-o", output, says=["obj, off, ply, stl"],
                         cwd=self.folder)
            self.refused(USAGE, "contract", "no.off", "-o", output, says=["ply"], cwd=self.folder)
        self.refused(USAGE, "extract", TORUS, "-o", "-", says=["--format"] + formats)

    def test_numbers_out_of_range_name_the_range(self):
        for option, value, word in (("--detail", "1.5", "from 0 to 1"), ("--detail", "x", "x"),
                                    ("--resolution", "0", "full"), ("--resolution", "few", "full"),
                                    ("--resolution", "3", "from 1500 up"),
                                    ("--resolution", "1499", "from 1500 up"),
                                    ("--threads", "-1", "from 0"), ("--fair", "2.5", "2.5")):
            self.refused(USAGE, "extract", TORUS, "-o", "x.obj", option, value,
                         says=[option, word], cwd=self.folder)

    def test_given_twice_or_without_a_value(self):
        self.refused(USAGE, "extract", Y, "-o", "a.ply", "--detail", "0", "--detail", "1",
                     cwd=self.folder, says=["--detail: needed once, given 2 times"])
        self.refused(USAGE, "extract", Y, "-o", "a.ply", "--html", cwd=self.folder,
                     says=["--html: needs a value, FILE.html"])

    def test_that_contradict_each_other(self):
        self.refused(USAGE, "extract", TORUS, says=["--output"])
        self.refused(USAGE, "extract", "-o", "x.obj", says=["MESH"])
        self.refused(USAGE, "extract", TORUS, "-o", "x.obj", "-o", "./x.obj", says=["twice"],
                     cwd=self.folder)
        self.refused(USAGE, "extract", TORUS, "-o", "x.obj", "--format", "obj", says=["--format"],
                     cwd=self.folder)
        self.refused(USAGE, "extract", TORUS, "-o", "x.json", "--report", "x.json",
                     says=["twice"], cwd=self.folder)
        for arguments in (("extract", TORUS, "-o", "x.obj"), ("rig", TORUS, "-o", "x.glb"),
                          ("contract", TORUS, "-o", "x.ply"), ("evaluate", TORUS, "x.obj")):
            self.refused(USAGE, *arguments, "--wrap-gap", "0.01", "--wrap", "never",
                         says=["--wrap-gap", "--wrap never"], cwd=self.folder)
        self.run_ok("extract", TORUS, "-o", "x.obj", "--wrap", "never", "--wrap-gap", "0",
                    cwd=self.folder)

    def test_a_file_of_one_format_has_its_extension(self):
        (self.folder / "theirs.obj").write_bytes(Y.read_bytes())
        self.run_ok("extract", Y, "-o", "y.obj", cwd=self.folder)
        self.run_ok("rig", Y, "-o", "y.glb", cwd=self.folder)
        for option, extension in (("--report", ".json"), ("--html", ".html"),
                                  ("--profiles", ".csv"), ("--junctions", ".csv")):
            for name in ("theirs.obj", "x.ply", "x", extension[1:]):
                self.refused(USAGE, "extract", Y, "-o", "x.obj", option, name, cwd=self.folder,
                             says=[name, option, "ends in " + extension])
            self.run_ok("extract", Y, "-o", "x.obj", option, "x" + extension.upper(),
                        cwd=self.folder)
            self.run_ok("extract", Y, "-o", "x.obj", option, "/dev/null", cwd=self.folder)
        for arguments in (("rig", Y, "-o", "x.glb", "--report"), ("evaluate", Y, "y.obj", "--json"),
                          ("evaluate", "y.glb", "--rig-truth", "y.glb", "--json"),
                          ("match", Y, Y, "-o")):
            self.refused(USAGE, *arguments, "theirs.obj", cwd=self.folder,
                         says=["theirs.obj", "ends in .json"])
        self.assertEqual((self.folder / "theirs.obj").read_bytes(), Y.read_bytes())

    def test_never_overwrite_the_input(self):
        mesh = self.folder / "mesh.ply"
        mesh.write_bytes(TORUS.read_bytes())
        self.refused(USAGE, "extract", mesh, "-o", "mesh.ply", says=["input"], cwd=self.folder)
        self.refused(USAGE, "contract", mesh, "-o", mesh, says=["input"])
        self.assertEqual(mesh.read_bytes(), TORUS.read_bytes())


    def test_a_name_that_begins_with_a_dash(self):
        (self.folder / "-x.off").write_bytes(Y.read_bytes())
        self.refused(USAGE, "extract", "-x.off", "-o", "x.obj", says=["write ./-x.off"],
                     cwd=self.folder)
        self.run_ok("extract", "./-x.off", "-o", "x.obj", cwd=self.folder)

    def test_never_overwrite_any_other_input(self):
        self.run_ok("extract", Y, "-o", "one.json", "-o", "other.json", cwd=self.folder)
        self.run_ok("rig", Y, "-o", "joints.json", "-o", "rigged.glb", cwd=self.folder)
        frame = self.folder / "frames" / "0003.ply"
        frame.parent.mkdir()
        self.run_ok("fair", TORUS, "-o", frame)
        before = {path: path.read_bytes() for path in self.folder.rglob("*.*")}
        for arguments in (
                ("evaluate", Y, "one.json", "--json", "one.json"),
                ("evaluate", Y, "one.json", "--against", "other.json", "--json", "other.json"),
                ("evaluate", "rigged.glb", "--rig-truth", "joints.json", "--json", "joints.json"),
                ("rig", Y, "--joints", "joints.json", "-o", "joints.json"),
                ("rig", Y, "--joints", "rigged.glb", "-o", "rigged.glb"),
                ("rig", Y, "--skeleton", "one.json", "-o", "x.glb", "--report", "one.json"),
                ("contract", frame, "-o", "x.ply", "--frames", "frames"),
                ("contract", TORUS, "-o", "frames/0000.ply", "--frames", "frames")):
            self.refused(USAGE, *arguments, says=["name another"], cwd=self.folder)
        self.assertEqual({path: path.read_bytes() for path in self.folder.rglob("*.*")}, before)


class Frames(CommandLineTest):
    def test_of_an_earlier_run_are_told_of(self):
        for count, warned in ((5, False), (3, True), (5, False)):
            result = self.run_ok("contract", TORUS, "-o", "x.ply", "--frames", "frames",
                                 "--iterations", count, cwd=self.folder)
            self.assertEqual("earlier run" in result.err, warned, result.err)


class WrongFiles(CommandLineTest):
    def test_a_missing_surface_is_an_input_fault(self):
        (self.folder / "skeleton.obj").write_text("v 0 0 0\nv 1 0 0\nl 1 2\n")
        for arguments in (("extract", "no.off", "-o", "x.obj"), ("contract", "no.off", "-o", "x.ply"),
                          ("evaluate", "no.off", "skeleton.obj"), ("evaluate", TORUS, "no.off")):
            self.refused(INPUT, *arguments, says=["no.off"], cwd=self.folder)

    def test_an_empty_file_is_told_of_what_it_lacks(self):
        (self.folder / "empty.obj").write_bytes(b"")
        self.refused(INPUT, "extract", "empty.obj", "-o", "x.ply", cwd=self.folder,
                     says=["0 bytes, needed a surface"])
        self.refused(INPUT, "evaluate", TORUS, "empty.obj", cwd=self.folder,
                     says=["0 bytes, needed a skeleton"])
        self.refused(INPUT, "rig", TORUS, "--joints", "empty.obj", "-o", "x.glb", cwd=self.folder,
                     says=["0 bytes, needed joints"])

    def test_a_directory_and_an_unreadable_file_are_input_faults(self):
        (self.folder / "folder.off").mkdir()
        self.refused(INPUT, "extract", "folder.off", "-o", "x.obj", says=["directory"],
                     cwd=self.folder)
        secret = self.folder / "secret.off"
        secret.write_text("OFF\n")
        secret.chmod(0)
        if not os.access(secret, os.R_OK):
            self.refused(INPUT, "extract", secret, "-o", "x.obj", says=["secret.off"],
                         cwd=self.folder)

    def test_a_file_that_unzips_to_more_than_the_memory_is_an_input_fault(self):
        packed = bytearray(gzip.compress(os.urandom(3 << 20)))
        packed[-4:] = (0xF0000000).to_bytes(4, "little")  # the size that it claims
        (self.folder / "bomb.ply.gz").write_bytes(packed)

        def with_little_memory():
            resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))

        result = run("extract", "bomb.ply.gz", "-o", "x.obj", cwd=self.folder,
                     preexec_fn=with_little_memory)
        self.assertEqual(result.code, INPUT, result.err)
        self.assertIn("memory left", result.err)

    def test_a_missing_folder_is_an_output_fault_before_any_work(self):
        self.refused(OUTPUT, "extract", TORUS, "-o", "no/x.obj", says=["no"], cwd=self.folder)

    def test_one_output_that_fails_is_an_output_fault(self):
        (self.folder / "x.obj").mkdir()
        self.refused(OUTPUT, "extract", TORUS, "-o", "x.obj", says=["x.obj"], cwd=self.folder)

    def test_a_full_disk_is_an_output_fault(self):
        with open("/dev/full", "wb") as full:
            result = run("extract", Y, "-o", "-", "--format", "obj", stdout=full)
            self.assertEqual(result.code, OUTPUT, result.err)
            self.assertIn("No space left", result.err)


if __name__ == "__main__":
    unittest.main()
