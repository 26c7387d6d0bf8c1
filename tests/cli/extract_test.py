"""curveskel extract."""

import json
import os
import pty
import re
import subprocess
import time
import unittest

from program import LINKED_RINGS, MESHES, TORUS, Y, CommandLineTest, Result, default_signals, run, start, write_torus
from program import PROGRAM

FORMATS = ["obj", "ply", "cgal", "swc", "vtp", "csv", "graphml", "json", "svg", "png"]


class Outputs(CommandLineTest):
    def test_every_format_at_once(self):
        outputs = [word for name in FORMATS for word in ("-o", f"y.{name}")]
        self.run_ok("extract", Y, *outputs, cwd=self.folder)
        self.assertEqual(self.files(), sorted(f"y.{name}" for name in FORMATS))
        for name in FORMATS:
            self.assertGreater((self.folder / f"y.{name}").stat().st_size, 0)

    def test_extension_in_capitals(self):
        self.run_ok("extract", Y, "-o", "Y.OBJ", cwd=self.folder)
        self.assertIn(b"\nv ", (self.folder / "Y.OBJ").read_bytes())

    def test_standard_output_has_the_file_and_nothing_else(self):
        for name in FORMATS:
            self.run_ok("extract", Y, "-o", f"y.{name}", cwd=self.folder)
            result = self.run_ok("extract", Y, "-o", "-", "--format", name)
            self.assertEqual(result.out, (self.folder / f"y.{name}").read_bytes(), name)
            self.assertIn("certificate", result.err)

    def test_a_reader_that_goes_away_is_an_output_fault(self):
        process = start("extract", Y, "-o", "-", "--format", "png")
        process.stdout.close()
        process.stdout = None
        self.assertEqual(Result(process).code, 6)

    def test_an_old_file_is_replaced(self):
        old = self.folder / "y.obj"
        old.write_text("old")
        self.run_ok("extract", Y, "-o", old)
        self.assertNotIn("old", old.read_text())


class Levels(CommandLineTest):
    SPOT = MESHES / "free" / "spot-3k.obj"

    def branches(self, name):
        skeleton = json.loads((self.folder / name).read_text())
        edges = {tuple(sorted(tuple(skeleton["nodes"][end]) for end in edge))
                 for edge in skeleton["edges"]}
        return skeleton["branches"], edges

    def test_are_written_each_in_a_file_of_its_own(self):
        self.run_ok("extract", self.SPOT, "-o", "cow.json", "--levels", "3", cwd=self.folder)
        self.assertEqual(self.files(), ["cow.1.json", "cow.2.json", "cow.3.json"])
        _, finer = self.branches("cow.1.json")
        for level in ("cow.2.json", "cow.3.json"):
            _, coarser = self.branches(level)
            self.assertLess(coarser, finer)
            finer = coarser

    # Each had the certificate and the counts of the finest, and the report names of no file.
    def test_have_their_own_certificates(self):
        self.run_ok("extract", self.SPOT, "-o", "cow.json", "--levels", "3", "--report",
                    "report.json", cwd=self.folder)
        written = json.loads((self.folder / "report.json").read_text())["outputs"]
        self.assertEqual(written, ["cow.1.json", "cow.2.json", "cow.3.json"])
        for number, name in enumerate(written, 1):
            level = json.loads((self.folder / name).read_text())
            self.assertEqual(level["level"]["number"], number)
            self.assertEqual(level["skeleton"], {"nodes": len(level["nodes"]),
                                                 "edges": len(level["edges"])})
            self.run_ok("evaluate", self.SPOT, name, "--json", "own.json", cwd=self.folder)
            own = json.loads((self.folder / "own.json").read_text())["certificate"]
            for key in ("tips", "junctions", "length", "coverage", "inside_fraction"):
                self.assertAlmostEqual(level["certificate"][key], own[key], 9, name + " " + key)

    def test_detail_without_embedding_is_said_to_have_no_effect(self):
        done = self.run_ok("extract", Y, "-o", "y.obj", "--embed", "none", "--detail", "0",
                           cwd=self.folder)
        self.assertIn("--detail has no effect", done.err)

    def test_less_detail_is_a_part_of_more(self):
        finer = None
        for detail in ("0.5", "0.3", "0.1", "0"):
            self.run_ok("extract", self.SPOT, "-o", "cow.json", "--detail", detail, cwd=self.folder)
            branches, edges = self.branches("cow.json")
            if finer is not None:
                self.assertLessEqual(edges, finer)
            finer = edges
            for branch in branches:
                self.assertEqual(branch["life"] is None, branch["parent"] is None)

    def test_need_files(self):
        self.refused(2, "extract", Y, "-o", "-", "--format", "obj", "--levels", "2",
                     says=["--levels"])


class VertexMap(CommandLineTest):
    def test_indexes_the_vertices_of_the_file(self):
        # Unused vertices in front: everything moves by three.
        lines = TORUS.read_text().splitlines()
        counts = next(i for i, line in enumerate(lines) if line[:1].isdigit())
        vertices, faces, _ = map(int, lines[counts].split())
        body = [line for line in lines[counts + 1:] if line.strip() and line[0] != "#"]
        moved = [" ".join([n, *(str(int(v) + 3) for v in corners)])
                 for n, *corners in (line.split() for line in body[vertices:])]
        mesh = self.folder / "moved.off"
        mesh.write_text("\n".join(["OFF", f"{vertices + 3} {faces} 0", *["9 9 9"] * 3,
                                   *body[:vertices], *moved]) + "\n")
        self.run_ok("extract", mesh, "-o", "moved.json", cwd=self.folder)
        self.run_ok("extract", TORUS, "-o", "torus.json", cwd=self.folder)
        found = json.loads((self.folder / "moved.json").read_text())
        plain = json.loads((self.folder / "torus.json").read_text())
        self.assertEqual(found["node_of_vertex"], [-1, -1, -1] + plain["node_of_vertex"])
        self.assertEqual(found["nodes"], plain["nodes"])
        self.assertEqual(set(plain["node_of_vertex"]) - set(range(len(plain["nodes"]))), set())


class Report(CommandLineTest):
    def test_seconds_are_those_of_the_clock_and_threads_those_used(self):
        for threads in (0, 1, 3):
            began = time.monotonic()
            text = self.run_ok("extract", LINKED_RINGS, "-o", "x.obj", "--report", "r.json",
                               "--threads", threads, cwd=self.folder).out.decode()
            taken = time.monotonic() - began
            report = json.loads((self.folder / "r.json").read_text())
            said = float(re.search(r"^([0-9.]+) s \(summed over components: read", text,
                                   re.MULTILINE).group(1))
            self.assertLessEqual(report["seconds"], taken)
            self.assertLessEqual(said, taken + 0.01)
            self.assertGreaterEqual(said, report["seconds"] - 0.01)
            self.assertEqual(report["threads"], threads or report["threads"])
            self.assertGreater(report["threads"], 0)
            if threads == 1:
                stages = sum(stage["seconds"] for stage in report["times"])
                self.assertLessEqual(stages, report["seconds"])

    def test_says_what_was_done(self):
        self.run_ok("extract", LINKED_RINGS, "-o", "rings.obj", "--report", "report.json",
                    "--flow", "paper", "--detail", "0.25", cwd=self.folder)
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(report["input"]["file"], "linked-rings.off")
        self.assertEqual(report["parameters"]["contraction"]["flow"], "paper")
        self.assertEqual(report["parameters"]["embed"]["detail"], 0.25)
        self.assertEqual(len(report["components"]), 2)
        for component in report["components"]:
            ratios = [step["area_ratio"] for step in component["contraction"]]
            self.assertEqual(ratios, sorted(ratios, reverse=True))
            self.assertGreater(len(ratios), 0)
        self.assertEqual(report["certificate"]["components"], 2)
        self.assertEqual(report["certificate"]["cycle_rank"], 2)
        self.assertTrue(report["certificate"]["topology_correct"])
        self.assertEqual([stage["stage"] for stage in report["times"]][:2], ["read", "repair"])
        self.assertGreater(report["peak_memory_bytes"], 1000000)
        self.assertEqual(report["outputs"], ["rings.obj"])

    def test_has_every_parameter_and_the_documents_every_key(self):
        self.run_ok("extract", Y, "-o", "y.json", "--report", "report.json", "--fair", "1",
                    cwd=self.folder)
        self.run_ok("rig", Y, "-o", "y.glb", "--report", "rig.json", cwd=self.folder)
        report = json.loads((self.folder / "report.json").read_text())
        of_run = {"threads", "program_cache"}
        for stage, header in (("contraction", "contract"), ("fair", "fair"),
                              ("embed", "advanced/embed"), ("surgery", "advanced/surgery"),
                              ("certificate", "certificate"), ("repair", "repair")):
            text = (MESHES.parent / "include" / "curveskel" / f"{header}.hpp").read_text()
            options = re.search(r"struct \w+Options {(.*?)\n};", text, re.DOTALL).group(1)
            names = set(re.findall(r"^  [\w:]+ (\w+)(?: = [^;]+)?;", options, re.MULTILINE))
            self.assertGreater(len(names), 2, stage)
            self.assertEqual(names - of_run - set(report["parameters"][stage]), set(), stage)
        documented = (MESHES.parent / "docs" / "formats.md").read_text()
        for name in ("report.json", "rig.json", "y.json"):
            for key in json.loads((self.folder / name).read_text()):
                self.assertIn(f"`{key}`", documented, name)


class SameBytes(CommandLineTest):
    def test_twice_and_with_any_number_of_threads(self):
        mesh = write_torus(self.folder / "torus.ply", 250, 80)
        written = {}
        for run, threads in enumerate((1, 2, 2, 0)):
            outputs = [word for name in FORMATS for word in ("-o", f"{run}.{name}")]
            self.run_ok("extract", mesh, *outputs, "--threads", threads, cwd=self.folder)
            for name in FORMATS:
                data = (self.folder / f"{run}.{name}").read_bytes()
                self.assertEqual(data, written.setdefault(name, data), f"{name}, {threads} threads")


def torus_without(folder, faces, name="open.off"):
    """The torus without its last faces."""
    lines = TORUS.read_text().split("\n")
    counts = next(i for i, line in enumerate(lines) if line[:1].isdigit())
    vertices, all_faces, _ = map(int, lines[counts].split())
    body = [line for line in lines[counts + 1:] if line.strip()]
    mesh = folder / name
    mesh.write_text("\n".join(["OFF", f"{vertices} {all_faces - faces} 0", *body[:-faces]]) + "\n")
    return mesh, vertices


class Repair(CommandLineTest):
    def test_a_hole_is_closed_and_said(self):
        mesh, vertices = torus_without(self.folder, 1)
        result = self.run_ok("extract", mesh, "-o", "x.json", "--report", "r.json", "--strict",
                             cwd=self.folder)
        self.assertIn("repaired: 1 hole closed", result.out.decode())
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["repairs"]["holes_closed"], 1)
        skeleton = json.loads((self.folder / "x.json").read_text())
        self.assertEqual(len(skeleton["node_of_vertex"]), vertices)
        self.assertGreaterEqual(min(skeleton["node_of_vertex"]), 0)
        self.assertTrue(report["certificate"]["topology_correct"])

    def test_components_and_sizes_are_chosen(self):
        for arguments, components in (((), 2), (("--components", "largest"), 1),
                                      (("--components", "1"), 1), (("--components", "9"), 2),
                                      (("--min-size", "0.5"), 2)):
            self.run_ok("extract", LINKED_RINGS, "-o", "x.obj", "--report", "r.json", *arguments,
                        cwd=self.folder)
            report = json.loads((self.folder / "r.json").read_text())
            self.assertEqual(report["surface"]["components"], components, arguments)

    def test_parts_become_one_body(self):
        report = self.folder / "r.json"
        for arguments, components in (((), 2), (("--wrap", "never"), 2), (("--wrap", "all"), 2),
                                      (("--wrap", "all", "--wrap-gap", "0.25"), 1),
                                      (("--wrap", "all", "--wrap-opening", "0.25"), 1)):
            result = run("extract", LINKED_RINGS, "-o", "x.json", "--report", report, *arguments,
                         "--strict", cwd=self.folder)
            # A wrap that spans a fourth of D is no longer the shape that was given.
            self.assertEqual(result.code, 0 if components == 2 else 5, result.err)
            result = json.loads(report.read_text())
            self.assertEqual(result["certificate"]["wrap_follows"], components == 2, arguments)
            self.assertTrue(result["certificate"]["topology_correct"], arguments)
            self.assertEqual(result["surface"]["components"], components, arguments)
            self.assertEqual(result["repairs"]["wrapped_as_asked"], "all" in arguments)
            skeleton = json.loads((self.folder / "x.json").read_text())
            self.assertEqual(len(skeleton["node_of_vertex"]), result["input"]["vertices"])
            self.assertGreaterEqual(min(skeleton["node_of_vertex"]), 0)
        self.run_ok("rig", LINKED_RINGS, "-o", "x.glb", "--wrap", "all", "--wrap-gap", "0.25",
                    cwd=self.folder)
        self.refused(2, "extract", LINKED_RINGS, "-o", "x.obj", "--wrap", "some",
                     says=["never, needed, all"], cwd=self.folder)

    def test_a_wrap_gap_that_is_too_narrow_is_refused_with_one_that_is_not(self):
        self.refused(3, "extract", TORUS, "-o", "x.obj", "--wrap", "all", "--wrap-gap", "1e-5",
                     says=["1e-05", "vertices", "needed is --wrap-gap 0.00"], cwd=self.folder)

    def test_strict_asks_for_a_shape_made_of_tubes(self):
        plate = self.folder / "plate.off"
        corners = [(x, y, z) for z in (0, 0.02) for y in (0, 1) for x in (0, 1)]
        quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
        plate.write_text("OFF\n8 6 0\n" + "".join("%g %g %g\n" % p for p in corners) +
                         "".join("4 %d %d %d %d\n" % q for q in quads))
        result = self.run_ok("extract", plate, "-o", "x.obj", "--report", "r.json", cwd=self.folder)
        self.assertIn("NOT MADE OF TUBES", result.out.decode())
        certificate = json.loads((self.folder / "r.json").read_text())["certificate"]
        self.assertFalse(certificate["curve_like"])
        self.assertFalse(certificate["holds"])
        self.assertLess(certificate["tube_share"], 0.5)
        for verb in (("extract", plate, "-o", "y.obj"), ("evaluate", plate, "x.obj")):
            self.assertEqual(run(*verb, "--strict", cwd=self.folder).code, 5, verb)

    def test_a_sheet_is_refused(self):
        sheet = self.folder / "sheet.off"
        sheet.write_text("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n")
        self.refused(3, "extract", sheet, "-o", "x.obj", says=["encloses nothing", "Solidify"],
                     cwd=self.folder)

    def test_a_bent_sheet_is_refused_or_gets_a_second_side(self):
        sheet = self.folder / "bent.off"
        sheet.write_text("OFF\n6 4 0\n0 0 0\n0 1 0\n3 0 0\n3 1 0\n6 0 1\n6 1 1\n"
                         "3 0 2 3\n3 0 3 1\n3 2 4 5\n3 2 5 3\n")
        self.refused(3, "extract", sheet, "-o", "x.obj", says=["--least-sheet", "Solidify"],
                     cwd=self.folder)
        result = run("extract", sheet, "--least-sheet", "0.1", "-o", "x.obj", cwd=self.folder)
        self.assertEqual(result.code, 0, result.err)
        self.assertIn("1 open or flat part given a second side", result.err + result.out.decode())

    def test_handles_of_noise_are_named_and_cut_if_asked(self):
        neuron = MESHES / "free" / "neuron-722817260-18k.ply.gz"
        plain = run("extract", neuron, "-o", "x.obj", cwd=self.folder)
        self.assertEqual(plain.code, 0, plain.err)
        self.assertRegex(plain.out.decode(), r"15 of the 15 handles are small.*--least-handle 0\.03")
        result = run("extract", neuron, "--least-handle", "0.03", "-o", "y.obj", "--report",
                     "r.json", cwd=self.folder)
        self.assertEqual(result.code, 0, result.err)
        self.assertIn("15 small handles cut", result.out.decode())
        self.assertNotIn("--least-handle", result.out.decode())
        report = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(report["surface"]["genus"], 0)
        self.assertEqual(report["repairs"]["handles_cut"], 15)
        self.assertLess(report["repairs"]["longest_handle_loop"], 0.03)
        self.assertEqual(report["parameters"]["repair"]["least_handle"], 0.03)


class StandardInput(CommandLineTest):
    """Through a pipe, which can be read once and has no name."""

    def piped(self, content, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], input=content, capture_output=True,
                              cwd=self.folder, timeout=300)

    def test_is_a_surface_in_any_format(self):
        surfaces = [Y, MESHES / "free" / "spot-3k.obj", MESHES / "free" / "humanoid-10k.ply.gz"]
        for extension in ("ply", "stl", "om", "obj"):
            surfaces.append(self.folder / f"y.{extension}")
            self.run_ok("fair", Y, "-o", surfaces[-1], "--iterations", "0")
        for surface in surfaces:
            with self.subTest(surface=surface.name):
                self.run_ok("extract", surface, "-o", "file.ply", cwd=self.folder)
                result = self.piped(surface.read_bytes(), "extract", "-", "-o", "piped.ply",
                                    "--report", "piped.json")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertTrue(result.stdout.startswith(b"standard input: "), result.stdout)
                lines = {name: [line for line in (self.folder / name).read_text().splitlines()
                                if not line.startswith("comment ")]
                         for name in ("file.ply", "piped.ply")}
                self.assertEqual(*lines.values())
                report = json.loads((self.folder / "piped.json").read_text())
                self.assertEqual(report["input"]["file"], "standard input")

    def test_is_taken_by_every_verb(self):
        content = Y.read_bytes()
        self.run_ok("extract", Y, "-o", "y.ply", cwd=self.folder)
        for arguments in (("evaluate", "-", "y.ply", "--strict"), ("rig", "-", "-o", "r.glb"),
                          ("fair", "-", "-o", "f.ply"), ("contract", "-", "-o", "c.ply"),
                          ("match", "-", Y, "-o", "m.json")):
            result = self.piped(content, *arguments)
            self.assertEqual(result.returncode, 0, (arguments, result.stderr))
        self.assertEqual(self.piped(content, "match", "-", "-", "-o", "m.json").returncode, 2)

    def test_loses_a_look_with_a_word_and_nothing_else_with_one(self):
        """Every rig from standard input was told that it lost its materials."""
        for extension in ("ply", "stl", "obj"):
            self.run_ok("fair", Y, "-o", self.folder / f"y.{extension}", "--iterations", "0")
        plain = (self.folder / "y.ply").read_bytes()
        self.run_ok("extract", Y, "-o", "labelled.ply", "-o", "y.json", cwd=self.folder)
        for content, options, loses in ((Y.read_bytes(), (), False), (plain, (), False),
                                        ((self.folder / "y.stl").read_bytes(), (), False),
                                        ((self.folder / "labelled.ply").read_bytes(), (), True),
                                        ((self.folder / "y.obj").read_bytes(), (), True),
                                        ((self.folder / "y.obj").read_bytes(), ("--bare",), False)):
            result = self.piped(content, "rig", "-", "-o", "r.glb", *options)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(b"materials" in result.stderr, loses, (content[:40], options))

    def test_that_is_no_surface_is_refused(self):
        for content, words in ((b"", b"0 bytes"), (b"once upon a time", b"the extension of its")):
            result = self.piped(content, "extract", "-", "-o", "x.obj")
            self.assertEqual(result.returncode, 3)
            self.assertIn(words, result.stderr)


class TimeLimit(CommandLineTest):
    def test_ends_the_run_and_leaves_nothing(self):
        mesh = write_torus(self.folder / "torus.ply", 1500, 400)
        self.refused(5, "extract", mesh, "-o", "x.obj", "--resolution", "full", "--time-limit",
                     "0.5", cwd=self.folder, says=["the time limit of 0.5 s was reached, nothing was "
                                                   "written", "a coarser --resolution"])

    def test_advises_only_what_the_verb_has(self):
        mesh = write_torus(self.folder / "torus.ply", 1500, 400)
        (self.folder / "x.obj").write_text("v 0 0 0\nv 1 0 0\nl 1 2\n")
        for arguments in (("rig", mesh, "-o", "x.glb"), ("contract", mesh, "-o", "x.ply"),
                          ("fair", mesh, "-o", "x.ply", "--iterations", "1000"),
                          ("evaluate", mesh, "x.obj")):
            self.refused(5, *arguments, "--time-limit", "0.3", cwd=self.folder,
                         says=["the time limit of 0.3 s was reached, nothing was written; allow "
                               "more, or decimate the surface first\n"])

    def test_says_the_same_where_a_stage_does_not_obey(self):
        # At first CGAL does not look up for seconds, on most machines.
        for limit in ("0.5", "1"):
            self.refused(5, "rig", LINKED_RINGS, "-o", "x.glb", "--wrap", "all", "--wrap-gap",
                         "0.001", "--time-limit", limit, cwd=self.folder,
                         says=[f"the time limit of {limit} s was reached, nothing was written; "
                               "allow more, or choose a wider --wrap-gap, or decimate the "
                               "surface first\n"])

    def test_does_not_matter_when_it_is_not_reached(self):
        self.run_ok("extract", Y, "-o", "x.obj", "--time-limit", "300", cwd=self.folder)


class Messages(CommandLineTest):
    def test_one_plain_line_per_stage_where_there_is_no_terminal(self):
        lines = self.run_ok("extract", LINKED_RINGS, "-o", "x.obj", cwd=self.folder).err.splitlines()
        self.assertNotIn("\r", "".join(lines))
        stages = [line.removesuffix(" ...") for line in lines if line.endswith(" ...")]
        self.assertEqual(len(stages), len(set(stages)))
        for stage in ("read", "clean", "contract"):
            self.assertIn(stage, stages)

    def test_a_bar_per_stage_on_a_terminal(self):
        terminal, end = pty.openpty()
        process = subprocess.Popen([PROGRAM, "extract", Y, "-o", self.folder / "y.obj"],
                                   stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=end,
                                   preexec_fn=default_signals)
        os.close(end)
        seen = b""
        try:
            while chunk := os.read(terminal, 65536):
                seen += chunk
        except OSError:  # the program closed its end
            pass
        process.communicate()
        os.close(terminal)
        self.assertEqual(process.returncode, 0)
        self.assertRegex(seen, rb"\rcontract +\[=+\] 100 %|\rcontract[^\r\n]*\[=+\] 100 %|contract +\[=+\] 100 %")
        self.assertIn(b"100 %", seen)

    def test_the_summary_goes_to_standard_output(self):
        text = self.run_ok("extract", Y, "-o", "y.obj", cwd=self.folder).out.decode()
        for word in ("y.off", "certificate", "components", "length inside", "wrote y.obj"):
            self.assertIn(word, text)

    def test_quiet_says_nothing(self):
        for verb, output in (("extract", "x.obj"), ("contract", "x.ply")):
            result = self.run_ok(verb, Y, "-o", output, "--quiet", cwd=self.folder)
            self.assertEqual((result.out, result.err), (b"", ""))


if __name__ == "__main__":
    unittest.main()
