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

    def test_a_surface_that_is_read_is_the_one_of_which_a_skeleton_was_given(self):
        mixed = self.folder / "mixed.off"
        mixed.write_text("OFF\n5 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.5 1\n4 3 2 1 0\n"
                         "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n")
        for file in (Y, TORUS, mixed):
            vertices, faces = curveskel.read_surface(file)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                given, given_faces = curveskel.extract(file).given
            numpy.testing.assert_array_equal(vertices, given)
            self.assertEqual(len(faces), len(given_faces))
            for face, other in zip(faces, given_faces):
                numpy.testing.assert_array_equal(face, other)
        self.assertEqual(sorted(map(len, faces)), [3, 3, 3, 3, 4])
        with self.assertRaises(curveskel.InputError):
            curveskel.read_surface(self.folder / "none.ply")
        with self.assertRaises(curveskel.UsageError):
            curveskel.read_surface((vertices, faces))

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

    def test_what_is_read_and_saved_again_has_lives_and_the_same_bytes(self):
        skeleton = curveskel.extract(MESHES / "free" / "spot-3k.obj")
        for extension in ("ply", "vtp", "graphml", "json"):
            with self.subTest(extension=extension):
                skeleton.save(self.folder / f"first.{extension}")
                again = curveskel.read(self.folder / f"first.{extension}")
                numpy.testing.assert_array_equal(again.lives, skeleton.lives)
                again.save(self.folder / f"second.{extension}")
                curveskel.read(self.folder / f"second.{extension}").save(
                    self.folder / f"third.{extension}")
                self.assertEqual((self.folder / f"second.{extension}").read_bytes(),
                                 (self.folder / f"third.{extension}").read_bytes())
                if has("pandas"):
                    columns = ["life", "parent", "merge", "component"]
                    self.assertTrue(again.branches[columns].equals(skeleton.branches[columns]))

    def test_a_name_may_ask_for_the_labelled_surface_as_with_the_program(self):
        skeleton = curveskel.extract(Y)
        skeleton.save_labelled(self.folder / "y.ply")
        for name in ("labelled.ply", "y.labelled.ply"):
            skeleton.save(self.folder / name)
            self.assertEqual((self.folder / name).read_bytes(),
                             (self.folder / "y.ply").read_bytes())

    def test_levels_have_the_bytes_of_the_program(self):
        spot = MESHES / "free" / "spot-3k.obj"
        for extension in ("json", "csv"):
            subprocess.run([PROGRAM, "extract", spot, "-o", self.folder / f"s.{extension}",
                            "--levels", "4", "-q"], check=True)
        skeleton = curveskel.extract(spot)
        levels = skeleton.levels(4)
        self.assertEqual(len(levels), 4)
        for number, level in enumerate(levels, 1):
            self.assertEqual((level.level["number"], level.level["of"]), (number, 4))
            for extension in ("json", "csv"):
                level.save(self.folder / f"m.{extension}")
                self.assertEqual((self.folder / f"m.{extension}").read_bytes(),
                                 (self.folder / f"s.{number}.{extension}").read_bytes())
        skeleton.save(self.folder / "whole.ply")
        read = curveskel.read(self.folder / "whole.ply")
        for other in (read, pickle.loads(pickle.dumps(skeleton))):
            self.assertEqual([len(level.edges) for level in other.levels(4)],
                             [len(level.edges) for level in levels])
        for most in (0, 101, 2.5, "two"):
            with self.assertRaises(curveskel.UsageError):
                skeleton.levels(most)

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

    def test_polygons_of_several_sizes_go_in_as_they_come_out(self):
        text = "OFF\n12 8 0\n"
        text += "".join(f"{x} {numpy.cos(a)} {numpy.sin(a)}\n" for x in (0, 6)
                        for a in numpy.arange(6) * numpy.pi / 3)
        text += "6 5 4 3 2 1 0\n6 6 7 8 9 10 11\n"
        text += "".join(f"4 {k} {(k + 1) % 6} {6 + (k + 1) % 6} {6 + k}\n" for k in range(6))
        (self.folder / "prism.off").write_text(text)
        skeleton = curveskel.extract(self.folder / "prism.off")
        vertices, faces = skeleton.given
        self.assertEqual([len(face) for face in faces], [6, 6] + 6 * [4])
        for given in (faces, [face.tolist() for face in faces], tuple(faces),
                      numpy.array(faces, dtype=object)):
            again = curveskel.extract((vertices, given))
            numpy.testing.assert_array_equal(again.vertices, skeleton.vertices)
            self.assertEqual(len(again.face_labels()), 8)
        with self.assertRaisesRegex(curveskel.UsageError, "faces: .*not 2 as in face 8"):
            curveskel.extract((vertices, [*faces, [0, 1]]))
        with self.assertRaisesRegex(curveskel.UsageError, "list of faces"):
            curveskel.extract((vertices, [3, *faces]))

    def test_faces_of_whole_numbers_may_be_objects(self):
        places, faces = map(numpy.array, curveskel.extract(Y).mesh)
        expected = curveskel.extract((places, faces)).vertices
        objects = faces.astype(object)
        rows = numpy.empty(len(faces), dtype=object)
        for k, face in enumerate(faces.tolist()):
            rows[k] = numpy.array(face, dtype=object)
        for given in (objects, list(objects), rows, faces.astype(numpy.uint16).astype(object)):
            numpy.testing.assert_array_equal(curveskel.extract((places, given)).vertices, expected)
        for one in (0.0, True, None, "0", 2**70):
            spoilt = objects.copy()
            spoilt[7, 1] = one
            for given in (spoilt, list(spoilt)):
                with self.assertRaisesRegex(curveskel.UsageError, "faces: ", msg=repr(one)):
                    curveskel.extract((places, given))

    def test_rows_that_begin_with_their_counts_are_no_polygons(self):
        places, faces = map(numpy.array, curveskel.extract(Y).mesh)
        with_counts = numpy.column_stack((numpy.full(len(faces), 3), faces))
        for given in (with_counts, with_counts.tolist(), with_counts.astype(object)):
            with self.assertRaisesRegex(curveskel.UsageError, r"VTK.*faces\[:, 1:\]"):
                curveskel.extract((places, given))
        with self.assertRaisesRegex(curveskel.UsageError, r"reshape\(-1, 4\)"):
            curveskel.extract((places, with_counts.reshape(-1)))
        corners = numpy.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
        cube = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
        pentagons = [[4, *face] for face in cube]
        for given in (pentagons, [*pentagons[:3], *with_counts[:3].tolist()]):
            with self.assertRaisesRegex(curveskel.UsageError, "VTK"):
                curveskel.fair((corners, given))
        from_three = [face[face.index(3):] + face[:face.index(3)] if 3 in face else face
                      for face in cube]
        self.assertEqual(len(curveskel.fair((corners, from_three), iterations=0)[1]), 12)
        fan = [[3, 1, 5, 7], [3, 7, 6, 2], [2, 0, 1, 3]]  # of three quads, one begun elsewhere
        self.assertEqual(len(curveskel.fair((corners, fan), iterations=0)[1]), 6)
        self.assertEqual(len(curveskel.fair((corners, fan[:1]), iterations=0)[1]), 2)

    def test_vertices_without_a_place_lose_their_faces_as_in_a_file(self):
        places, faces = map(numpy.array, curveskel.extract(TORUS).mesh)
        unused = numpy.concatenate((places, [[numpy.nan, 0, 0]]))
        skeleton = curveskel.extract((unused, faces))
        numpy.testing.assert_array_equal(skeleton.vertices,
                                         curveskel.extract((places, faces)).vertices)
        self.assertEqual(skeleton.mesh_map[-1], -1)
        places[7, 1] = numpy.inf
        rows = "".join("v {!r} {!r} {!r}\n".format(*row) for row in places.tolist())
        rows += "".join("f {} {} {}\n".format(*row) for row in (faces + 1).tolist())
        (self.folder / "spoilt.obj").write_text(rows)
        by_file = curveskel.extract(self.folder / "spoilt.obj")
        by_arrays = curveskel.extract((places, faces))
        self.assertEqual(by_arrays.changes, by_file.changes)
        numpy.testing.assert_array_equal(by_arrays.vertices, by_file.vertices)
        numpy.testing.assert_array_equal(by_arrays.mesh_map, by_file.mesh_map)

    def test_nothing_of_an_array_is_lost_without_a_word(self):
        places, faces = map(numpy.array, curveskel.extract(Y).mesh)
        expected = curveskel.extract((places, faces))
        of_vertex = numpy.ma.masked_array(places, mask=places == places[3])
        of_face = numpy.ma.masked_array(faces, mask=faces == 3)
        nodes = numpy.ma.masked_array(expected.vertices, mask=expected.vertices > 0)
        for says, call in (
                ("vertices: found [0-9]+ masked", lambda: curveskel.extract((of_vertex, faces))),
                ("faces: found [0-9]+ masked", lambda: curveskel.extract((places, of_face))),
                ("nodes: found [0-9]+ masked",
                 lambda: curveskel.evaluate(Y, (nodes, expected.edges))),
                ("vertices: .*complex", lambda: curveskel.fair((places + 1j, faces))),
                ("vertices: .*<U", lambda: curveskel.rig((places.astype(str), faces))),
                ("mesh: .*dict", lambda: curveskel.extract({"vertices": places, "faces": faces}))):
            with self.assertRaisesRegex(curveskel.UsageError, says):
                call()
        whole = numpy.ma.masked_array(places, mask=False)
        for vertices in (whole, places.tolist(), places.astype(object), numpy.asfortranarray(places),
                         places.astype(">f8"), numpy.repeat(places, 2, axis=0)[::2]):
            found = curveskel.extract((vertices, faces))
            numpy.testing.assert_array_equal(found.vertices, expected.vertices)

    def test_the_size_of_the_surface_is_in_its_units(self):
        skeleton = curveskel.extract(Y)
        vertices, faces = skeleton.mesh
        a, b, c = (vertices[faces[:, k]] for k in range(3))
        size = skeleton.surface
        self.assertAlmostEqual(size["diagonal"], numpy.linalg.norm(numpy.ptp(vertices, axis=0)))
        self.assertAlmostEqual(size["area"],
                               numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2)
        self.assertAlmostEqual(size["volume"], numpy.einsum("ij,ij->", a, numpy.cross(b, c)) / 6)
        self.assertEqual(size, json.loads(self.by_program(Y, "json").read_text())["surface"])
        self.assertEqual(pickle.loads(pickle.dumps(skeleton)).surface, size)

    def test_labels_and_tables_are_made_once(self):
        skeleton = curveskel.extract(Y)
        self.assertIs(skeleton.vertex_labels(), skeleton.vertex_labels())
        self.assertFalse(skeleton.face_labels().flags.writeable)
        if has("pandas"):
            skeleton.branches["length"] = 0  # of a table of one's own
            self.assertTrue((skeleton.branches.length > 0).all())

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

    @unittest.skipUnless(has("networkx"), "no networkx")
    def test_networkx_writes_it_and_evaluate_takes_it(self):
        import networkx

        spot = MESHES / "free" / "spot-3k.obj"
        skeleton = curveskel.extract(spot)
        graph = skeleton.to_networkx()
        levels = json.loads(self.by_program(spot, "json").read_text())["branches"]
        for *_, data in graph.edges(data=True):
            level = levels[data["branch"]]
            self.assertEqual(data["life"], math.inf if level["life"] is None else level["life"])
            self.assertEqual(data.get("parent"), level["parent"])
            self.assertEqual(data.get("merge"), level.get("merge"))
        networkx.write_graphml(graph, self.folder / "n.graphml")
        again = curveskel.read(self.folder / "n.graphml")
        for name in ("vertices", "edges", "radii", "lives"):
            numpy.testing.assert_array_equal(getattr(again, name), getattr(skeleton, name))
        expected = curveskel.evaluate(spot, skeleton)
        self.assertEqual(curveskel.evaluate(spot, graph), expected)
        with_pos = networkx.Graph(graph.edges)
        with_pos.add_nodes_from((node, {"pos": tuple(place)})
                                for node, place in enumerate(skeleton.vertices.tolist()))
        self.assertAlmostEqual(curveskel.evaluate(spot, with_pos)["length"], expected["length"])
        with self.assertRaisesRegex(curveskel.UsageError, "node 0 .* x, y and z"):
            curveskel.evaluate(spot, networkx.path_graph(3))


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

    def test_beside_another_has_the_distances_of_the_program(self):
        skeleton = curveskel.extract(Y)
        skeleton.save(self.folder / "a.ply")
        other = (skeleton.vertices + [0, 0.02, 0], skeleton.edges)
        lines = "".join("v {!r} {!r} {!r}\n".format(*row) for row in other[0].tolist())
        lines += "".join("l {} {}\n".format(*row) for row in (skeleton.edges + 1).tolist())
        (self.folder / "b.obj").write_text(lines)
        subprocess.run([PROGRAM, "evaluate", Y, self.folder / "a.ply", "--against",
                        self.folder / "b.obj", "--json", self.folder / "e.json", "-q"], check=True)
        expected = json.loads((self.folder / "e.json").read_text())["against"]
        del expected["skeleton"]
        for against in (other, self.folder / "b.obj"):
            found = curveskel.evaluate(Y, skeleton, against=against)["against"]
            self.assertEqual(found, expected)
        self.assertLess(found["mean_distance"], 0.02 / skeleton.surface["diagonal"] + 1e-9)
        same = curveskel.evaluate(Y, other, against=other)["against"]
        self.assertLess(same["hausdorff_distance"], 1e-12)
        self.assertNotIn("against", curveskel.evaluate(Y, skeleton))

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
        alone = curveskel.evaluate(TORUS, ([[3, 0, 0]], []))
        self.assertEqual((alone["components"], alone["cycle_rank"]), (1, 0))


class Errors(Folder):
    def test_each_fault_has_its_class_and_status(self):
        for error, status, call in (
                (curveskel.UsageError, 2, lambda: curveskel.extract(Y, detail=2)),
                (curveskel.UsageError, 2, lambda: curveskel.extract(Y, flow="uphill")),
                (curveskel.UsageError, 2, lambda: curveskel.extract(Y, details=0.5)),
                (curveskel.UsageError, 2, lambda: curveskel.extract(Y, threads="two")),
                (curveskel.UsageError, 2, lambda: curveskel.extract(3)),
                (curveskel.UsageError, 2, lambda: curveskel.extract(Y, time_limit=-1)),
                (curveskel.UsageError, 2, lambda: curveskel.extract(Y, time_limit="soon")),
                (curveskel.UsageError, 2, lambda: curveskel.extract(Y, surgery="none")),
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

    def test_options_of_another_type_are_told_what_is_needed(self):
        for options, needed in (
                ({"detail": "fine"}, "detail: needs a number, not 'fine'"),
                ({"threads": 1.5}, "threads: needs a whole number, not 1.5"),
                ({"merge_overlapping": "no"}, "merge_overlapping: needs True or False, not 'no'"),
                ({"wrap": True}, "wrap: needs one of: never, needed, all, not True"),
                ({"components": 1.5}, "components: needs .*largest.*, not 1.5"),
                ({"components": 0}, "components: needs .* from 1 up.*, not 0"),
                ({"components": -3}, "components: needs .* from 1 up.*, not -3"),
                ({"strict": "no"}, "strict: needs True or False, not 'no'"),
                ({"strict": None}, "strict: needs True or False, not None"),
                ({"no_merge_overlapping": True}, "needed merge_overlapping=False"),
                ({"resolution": None}, "resolution: needs .*full.*, not None")):
            with self.assertRaisesRegex(curveskel.UsageError, needed):
                curveskel.extract(Y, **options)
        for name in ("keep_rig", "as_shown"):
            with self.assertRaisesRegex(curveskel.UsageError, f"{name}: needs True or False"):
                curveskel.rig(Y, **{name: "no"})
        with self.assertRaisesRegex(curveskel.UsageError, "needed ends=False"):
            curveskel.rig(Y, no_ends=True)
        with self.assertRaisesRegex(curveskel.UsageError, "by_shape: needs True or False"):
            curveskel.match(Y, Y, by_shape="no")

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

    def test_a_time_limit_ends_each_verb(self):
        angles = numpy.arange(700) * 2 * numpy.pi / 700
        u, v = (grid.ravel() for grid in numpy.meshgrid(angles, angles, indexing="ij"))
        places = numpy.stack(((3 + numpy.cos(v)) * numpy.cos(u), (3 + numpy.cos(v)) * numpy.sin(u),
                              numpy.sin(v)), axis=1)
        at = numpy.arange(700 * 700).reshape(700, 700)
        right, up = numpy.roll(at, -1, 0), numpy.roll(at, -1, 1)
        corner = numpy.roll(right, -1, 1)
        mesh = places, numpy.stack((at, right, corner, up), axis=-1).reshape(-1, 4)
        path = [[0.0, 0, 0], [1, 0, 0]], [[0, 1]]
        for call in (lambda: curveskel.extract(mesh, time_limit=0.3),
                     lambda: curveskel.evaluate(mesh, path, time_limit=0.3),
                     lambda: curveskel.rig(mesh, time_limit=0.3),
                     lambda: curveskel.match(mesh, Y, time_limit=0.3)):
            with self.assertRaisesRegex(curveskel.SolverError, "time limit of 0.3 s"):
                call()
        seen = []
        curveskel.extract(Y, time_limit=300, progress=lambda stage, done: seen.append(stage))
        self.assertTrue(seen)

    def test_surgery_and_embedding_are_those_of_the_program(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            skeleton = curveskel.extract(Y, surgery="cgal", embed="none")
        skeleton.save(self.folder / "m.json")
        subprocess.run([PROGRAM, "extract", Y, "-o", self.folder / "p.json", "--surgery", "cgal",
                        "--embed", "none", "-q"], capture_output=True)
        self.assertEqual((self.folder / "m.json").read_bytes(),
                         (self.folder / "p.json").read_bytes())

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

    def test_a_daemon_s_work_ends_with_the_interpreter(self):
        program = ("import curveskel, os, sys, threading, time\n"
                   "def work():\n"
                   "    while True: curveskel.extract(sys.argv[1], resolution='full')\n"
                   "for _ in range(3): threading.Thread(target=work, daemon=True).start()\n"
                   "time.sleep(0.5)\n"
                   "child = os.fork()\n"  # which has neither the parent's work nor its threads
                   "if not child: curveskel.extract(sys.argv[1])\n"
                   "if child: assert os.waitpid(child, 0)[1] == 0\n")
        for _ in range(3):
            start = time.monotonic()
            child = subprocess.run([sys.executable, "-c", program, str(Y)], capture_output=True,
                                   timeout=60)
            self.assertEqual((child.returncode, child.stderr), (0, b""))
            self.assertLess(time.monotonic() - start, 30)

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
