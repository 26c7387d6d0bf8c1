"""`import curveskel`: the same results as the program's, as arrays, tables and exceptions."""

import copy
import csv
import ctypes
import json
import math
import os
import pathlib
import pickle
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

import numpy

import curveskel
from installed import has

PROGRAM = os.environ["CURVESKEL_PROGRAM"]
MESHES = pathlib.Path(os.environ["CURVESKEL_SOURCE_DIR"]) / "meshes"
Y = MESHES / "y.off"
TORUS = MESHES / "torus.off"


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def by_program(self, mesh, extension):
        output = self.folder / f"program.{extension}"
        subprocess.run([PROGRAM, "extract", mesh, "-o", output, "-q"], check=True)
        return output


class Files(Folder):
    def test_every_format_has_the_bytes_of_the_program(self):
        for mesh in (Y, TORUS):
            skeleton = curveskel.extract(str(mesh))
            for extension in ("obj", "ply", "cgal", "swc", "vtp", "csv", "graphml", "json", "svg"):
                with self.subTest(mesh=mesh.name, extension=extension):
                    output = self.folder / f"module.{extension}"
                    skeleton.save(output)
                    self.assertEqual(output.read_bytes(),
                                     self.by_program(mesh, extension).read_bytes())

    def test_what_is_read_is_what_was_saved(self):
        skeleton = curveskel.extract(Y)
        for extension in ("ply", "json", "vtp"):
            skeleton.save(self.folder / f"y.{extension}")
            again = curveskel.read(self.folder / f"y.{extension}")
            numpy.testing.assert_array_equal(again.vertices, skeleton.vertices)
            numpy.testing.assert_array_equal(again.edges, skeleton.edges)
            numpy.testing.assert_array_equal(again.radii, skeleton.radii)
            self.assertIsNone(again.ok)
            again.to_swc(self.folder / "again.swc")
            self.assertEqual(len(curveskel.read(self.folder / "again.swc").vertices),
                             len(skeleton.vertices))

    def test_a_failure_leaves_no_file(self):
        skeleton = curveskel.extract(Y)
        with self.assertRaises(curveskel.UsageError):
            skeleton.save(self.folder / "y.bones")
        with self.assertRaises(curveskel.OutputError):
            skeleton.save(self.folder / "no folder" / "y.ply")
        skeleton.save(self.folder / "y.json")
        with self.assertRaises(curveskel.OutputError):
            curveskel.read(self.folder / "y.json").save(self.folder / "y.png")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["y.json"])


class Arrays(Folder):
    def test_a_mesh_may_be_arrays_or_an_object_with_arrays(self):
        expected = curveskel.extract(Y)
        vertices, faces = expected.mesh

        class Mesh:
            pass

        mesh = Mesh()
        mesh.vertices, mesh.faces = vertices.tolist(), faces.astype(numpy.uint32)
        for given in ((vertices, faces), mesh, (vertices[:, :], faces[:, [1, 2, 0]])):
            found = curveskel.extract(given)
            numpy.testing.assert_allclose(found.certificate["length"],
                                          expected.certificate["length"], rtol=0.02)
            self.assertEqual(found.certificate["tips"], 3)

    def test_maps_are_each_others_inverse(self):
        skeleton = curveskel.extract(TORUS)
        self.assertEqual(len(skeleton.mesh_map), len(skeleton.mesh[0]))
        self.assertEqual(len(skeleton.skel_map), len(skeleton.vertices))
        for node, vertices in enumerate(skeleton.skel_map):
            self.assertTrue((skeleton.mesh_map[vertices] == node).all())
        self.assertEqual(sum(map(len, skeleton.skel_map)), (skeleton.mesh_map >= 0).sum())

    def test_maps_and_labels_are_of_the_surface_given(self):
        places, faces = numpy.array(curveskel.extract(TORUS).mesh[0]), curveskel.extract(TORUS).mesh[1]
        apart = places[faces].reshape(-1, 3), numpy.arange(3 * len(faces)).reshape(-1, 3)
        skeleton = curveskel.extract(apart)
        vertices, given = skeleton.given
        self.assertTrue((vertices == apart[0]).all() and (given == apart[1]).all())
        self.assertEqual(len(skeleton.mesh_map), len(vertices))
        self.assertEqual(len(skeleton.face_labels()), len(given))
        self.assertTrue((skeleton.mesh[0][skeleton.vertex_map] == vertices).all())

    def test_a_skeleton_goes_through_pickle_and_copies(self):
        skeleton = curveskel.extract(Y)
        for again in (pickle.loads(pickle.dumps(skeleton)), copy.deepcopy(skeleton)):
            for name in ("vertices", "edges", "radii", "lives", "mesh_map", "vertex_map"):
                self.assertTrue((getattr(again, name) == getattr(skeleton, name)).all(), name)
            self.assertEqual(again.certificate, skeleton.certificate)
            self.assertEqual(repr(again), repr(skeleton))
            self.assertTrue((again.vertex_labels() == skeleton.vertex_labels()).all())
        again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(skeleton))))
        self.assertFalse(again.mesh[0].flags.writeable)
        for of_the_surface in (again.profiles, lambda: again.save_labelled("no.ply"),
                               lambda: again.save_html("no.html"),
                               lambda: curveskel.match(again, Y)):
            with self.assertRaisesRegex(curveskel.UsageError, "extract"):
                of_the_surface()

    def test_views_outlive_the_skeleton_and_are_read_only(self):
        places = curveskel.extract(Y).vertices
        self.assertTrue(numpy.isfinite(places).all())
        self.assertFalse(places.flags.writeable)
        self.assertFalse(places.flags.owndata)

    def test_topology_is_that_of_the_surface(self):
        ring, y = curveskel.extract(TORUS), curveskel.extract(Y)
        self.assertEqual(len(ring.edges), len(ring.vertices))
        self.assertEqual(len(y.edges), len(y.vertices) - 1)
        for skeleton in (ring, y):
            self.assertTrue(skeleton.ok)
            self.assertEqual(skeleton.shortcomings, "")
            self.assertTrue(skeleton.certificate["topology_correct"])
            self.assertIn("<svg", skeleton._repr_html_())
            self.assertIn("certificate holds", repr(skeleton))

    @unittest.skipUnless(has("pandas"), "no pandas")
    def test_the_table_of_branches_is_the_program_s(self):
        import pandas

        for mesh in (Y, TORUS):
            table = curveskel.extract(mesh).branches.reset_index()
            with open(self.by_program(mesh, "csv"), newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(list(table.columns), list(rows[0]))
            self.assertEqual(len(table), len(rows))
            for (_, found), row in zip(table.iterrows(), rows):
                for name, text in row.items():
                    if name == "kind":
                        self.assertEqual(found[name], text)
                    elif text == "":
                        self.assertTrue(pandas.isna(found[name]), name)
                    else:
                        self.assertEqual(float(found[name]), float(text), name)

    @unittest.skipUnless(has("networkx"), "no networkx")
    def test_networkx_has_the_same_graph(self):
        import networkx

        skeleton = curveskel.extract(Y)
        branches = [branch for _, _, branch in skeleton.to_networkx().edges(data="branch")]
        self.assertEqual(sorted(set(branches)), list(range(len(skeleton.branch_nodes))))
        graph = curveskel.extract(TORUS).to_networkx()
        self.assertEqual(len(networkx.cycle_basis(graph)), 1)
        self.assertTrue(all(data["radius"] > 0 for _, data in graph.nodes(data=True)))
        self.assertTrue(all(data["length"] > 0 for *_, data in graph.edges(data=True)))


class Certificates(Folder):
    def test_of_an_extraction_is_found_again_from_arrays_and_from_a_file(self):
        for mesh in (Y, TORUS):
            skeleton = curveskel.extract(mesh)
            skeleton.save(self.folder / "skeleton.ply")
            for given in (skeleton, self.folder / "skeleton.ply",
                          (skeleton.vertices, skeleton.edges[::-1, ::-1])):
                found = curveskel.evaluate(mesh, given)
                self.assertTrue(found["holds"])
                for name, value in skeleton.certificate.items():
                    self.assertAlmostEqual(found[name], value, delta=0.01 * max(1, abs(value)),
                                           msg=name)

    def test_of_a_wrong_skeleton_fails(self):
        skeleton = curveskel.extract(TORUS)
        cut = curveskel.evaluate(TORUS, (skeleton.vertices, skeleton.edges[1:]))
        self.assertFalse(cut["topology_correct"])
        moved = curveskel.evaluate(TORUS, (skeleton.vertices + 10, skeleton.edges))
        self.assertEqual(moved["inside_fraction"], 0)
        for edges in ([[0, 0]], [[0, len(skeleton.vertices)]]):
            with self.assertRaises(curveskel.InputError):
                curveskel.evaluate(TORUS, (skeleton.vertices, edges))
        with self.assertRaises(curveskel.UsageError):
            curveskel.evaluate(TORUS, 7)


class Errors(Folder):
    def test_each_fault_has_its_class_and_status(self):
        for error, status, call in (
                (curveskel.UsageError, 2, lambda: curveskel.extract(Y, detail=2)),
                (curveskel.UsageError, 2, lambda: curveskel.extract(Y, flow="uphill")),
                (curveskel.UsageError, 2, lambda: curveskel.extract(Y, details=0.5)),
                (curveskel.UsageError, 2, lambda: curveskel.extract(Y, threads="two")),
                (curveskel.UsageError, 2, lambda: curveskel.extract(3)),
                (curveskel.UsageError, 2, lambda: curveskel.extract((numpy.eye(3), [[0.5] * 3]))),
                (curveskel.InputError, 3, lambda: curveskel.extract(MESHES / "none.off")),
                (curveskel.InputError, 3, lambda: curveskel.read(Y)),
                (curveskel.InputError, 3, lambda: curveskel.extract((numpy.eye(3), [[0, 1, 3]]))),
                (curveskel.InputError, 3,
                 lambda: curveskel.extract((numpy.eye(3) * math.nan, [[0, 1, 2]])))):
            with self.assertRaises(error) as caught:
                call()
            self.assertEqual(caught.exception.exit_status, status)
            self.assertIsInstance(caught.exception, curveskel.Error)
            self.assertNotEqual(str(caught.exception), "")

    def test_a_certificate_that_fails_warns_or_is_an_error(self):
        plate = numpy.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 0.01)], float)
        faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            skeleton = curveskel.extract((plate, faces))
        self.assertFalse(skeleton.ok)
        self.assertEqual([one.category for one in caught], [curveskel.CertificateWarning])
        with self.assertRaises(curveskel.SolverError):
            curveskel.extract((plate, faces), strict=True)


@unittest.skipUnless(has("pandas") and has("networkx"), "no pandas, no networkx")
class Manual(Folder):
    def test_its_examples_run_in_their_order(self):
        text = (MESHES.parent / "docs" / "python.md").read_text()
        examples = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
        self.assertGreater(len(examples), 3)
        (self.folder / "meshes").symlink_to(MESHES)
        script = self.folder / "manual.py"
        script.write_text("\n".join(examples))
        result = subprocess.run([sys.executable, "-B", script], cwd=self.folder,
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)


class Running(Folder):
    def test_progress_comes_in_the_calling_thread_and_its_errors_go_out(self):
        seen = []
        curveskel.extract(Y, progress=lambda stage, done: seen.append((threading.get_ident(), done)))
        self.assertTrue(seen)
        self.assertEqual({thread for thread, _ in seen}, {threading.get_ident()})
        self.assertTrue(all(0 <= done <= 1 for _, done in seen))

        def refuse(stage, done):
            raise LookupError(stage)

        with self.assertRaises(LookupError):
            curveskel.extract(Y, progress=refuse)

    def test_other_threads_run_meanwhile(self):
        results = {}

        def work(mesh):
            results[mesh] = json.dumps(curveskel.extract(mesh).certificate)

        threads = [threading.Thread(target=work, args=(mesh,)) for mesh in (Y, TORUS)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for mesh in (Y, TORUS):
            self.assertEqual(results[mesh], json.dumps(curveskel.extract(mesh).certificate))

    def test_control_c_is_a_keyboard_interrupt(self):
        program = ("import curveskel, sys\n"
                   "def tell(stage, done): print(stage, flush=True)\n"
                   "while True: curveskel.extract(sys.argv[1], resolution='full', progress=tell)\n")
        child = subprocess.Popen(
            [sys.executable, "-c", program, str(Y)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler))
        child.stdout.readline()
        time.sleep(0.2)
        child.send_signal(signal.SIGINT)
        _, error = child.communicate(timeout=60)
        self.assertIn(b"KeyboardInterrupt", error)
        self.assertNotEqual(child.returncode, 0)

    def test_numpy_keeps_its_blas_threads(self):
        try:
            count = ctypes.CDLL("libblas.so.3").openblas_get_num_threads
        except (AttributeError, OSError):
            self.skipTest("the BLAS is not OpenBLAS")
        before = count()
        curveskel.extract(Y)
        self.assertEqual(count(), before)

    def test_the_number_of_threads_makes_no_difference(self):
        one, two = (curveskel.extract(TORUS, threads=threads) for threads in (1, 2))
        numpy.testing.assert_array_equal(one.vertices, two.vertices)
        numpy.testing.assert_array_equal(one.radii, two.radii)


if __name__ == "__main__":
    unittest.main()
