"""`rig`, `match`, `fair` and `contract` of the module beside the program's verbs, and the stubs."""

import ast
import copy
import inspect
import json
import os
import pathlib
import pickle
import subprocess
import tempfile
import unittest
import warnings

import numpy

import curveskel
from installed import has

PROGRAM = os.environ["CURVESKEL_PROGRAM"]
SOURCE = pathlib.Path(os.environ["CURVESKEL_SOURCE_DIR"])
MESHES = SOURCE / "meshes"
Y = MESHES / "y.off"
TORUS = MESHES / "torus.off"


def places_in(path):
    """Vertices of a binary PLY file of doubles."""
    head, _, content = path.read_bytes().partition(b"end_header\n")
    count = int(head.split(b"element vertex ")[1].split()[0])
    return numpy.frombuffer(content, "<f8", 3 * count).reshape(-1, 3)


class Verbs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def program(self, *arguments):
        subprocess.run([PROGRAM, *map(str, arguments), "-q"], check=True)

    def test_fair_is_the_program_s(self):
        self.program("fair", Y, "-o", self.folder / "y.ply", "--iterations", 5, "--rings", 2,
                     "--local-solver", "qr")
        vertices, faces = curveskel.fair(Y, iterations=5, rings=2, local_solver="qr")
        numpy.testing.assert_array_equal(vertices, places_in(self.folder / "y.ply"))
        again, same = curveskel.fair((curveskel.extract(Y).mesh[0], faces), iterations=0)
        numpy.testing.assert_array_equal(same, faces)
        self.assertEqual(again.shape, vertices.shape)
        for wrong in ({"ring": 2}, {"rings": 2, "local_solver": "closed"}, {"precision": "half"},
                      {"method": "cpu", "local_solver": "closed"}, {"time_limit": -1}):
            with self.assertRaises(curveskel.UsageError, msg=wrong):
                curveskel.fair(Y, **wrong)
        numpy.testing.assert_array_equal(curveskel.fair(Y, precision="double", time_limit=60)[0],
                                         curveskel.fair(Y)[0])
        with self.assertRaisesRegex(curveskel.SolverError, "time limit"):
            curveskel.contract(MESHES / "free" / "humanoid-10k.ply.gz", time_limit=1e-3)

    def test_contract_is_the_program_s(self):
        for mesh in (Y, MESHES / "linked-rings.off"):
            self.program("contract", mesh, "-o", self.folder / "c.ply", "--iterations", 7)
            vertices, faces, steps = curveskel.contract(mesh, iterations=7)
            numpy.testing.assert_array_equal(vertices, places_in(self.folder / "c.ply"))
            self.assertEqual(len(steps["area_ratio"]), len(steps["component"]))
            for component in set(steps["component"]):
                areas = [area for area, of in zip(steps["area_ratio"], steps["component"])
                         if of == component]
                self.assertEqual(areas, sorted(areas, reverse=True))

    @unittest.skipUnless(has("scipy"), "no scipy")
    def test_rig_is_the_program_s(self):
        human = MESHES / "free" / "humanoid-10k.ply.gz"
        for options, arguments in (({"front": "-x"}, ("--front=-x",)),
                                   ({"front": "-x", "names": "mixamo", "ends": False},
                                    ("--front=-x", "--names", "mixamo", "--no-ends"))):
            self.program("rig", human, "-o", self.folder / "h.json", "-o", self.folder / "h.glb",
                         *arguments)
            rig = curveskel.rig(human, **options)
            expected = json.loads((self.folder / "h.json").read_text())
            rig.save(self.folder / "m.json")
            rig.save(self.folder / "m.glb")
            for extension in ("json", "glb"):
                self.assertEqual((self.folder / f"m.{extension}").read_bytes(),
                                 (self.folder / f"h.{extension}").read_bytes())
            self.assertEqual(rig.plan, "humanoid")
            self.assertEqual(rig.names, [joint["name"] for joint in expected["joints"]])
            weights = rig.weights
            self.assertEqual(weights.shape[1], len(rig.joints))
            numpy.testing.assert_allclose(weights.sum(axis=1), 1, atol=1e-5)
            self.assertTrue((rig.parents < numpy.arange(len(rig.parents))).all())
            self.assertIn("hips", rig.roles)
        with self.assertRaises(curveskel.UsageError):
            curveskel.rig(Y, plan="centaur")
        with self.assertRaises(curveskel.UsageError):
            rig.save(self.folder / "h.vrm")

    def test_a_rig_without_a_plan_says_none(self):
        made = curveskel.rig(Y, names="neutral")
        made.save(self.folder / "y.json")
        self.assertEqual(made.plan, "other")
        for options in ({"plan": "none"}, {"root": 0}, {"joints": self.folder / "y.json"}):
            self.assertEqual(curveskel.rig(Y, **options).plan, "none")

    def test_a_rig_for_a_skeleton_is_told_where_it_goes(self):
        rig = curveskel.rig(Y)
        rig.save(self.folder / "rig.json")
        with self.assertRaisesRegex(curveskel.InputError, r"curveskel\.rig\(joints=\.\.\.\) takes rigs"):
            curveskel.read(self.folder / "rig.json")
        given = curveskel.rig(Y, joints=self.folder / "rig.json")
        with self.assertRaisesRegex(curveskel.InputError, "leave out joints") as caught:
            given.save(self.folder / "y.vrm", vrm_name="Y", vrm_author="a",
                       vrm_licence="https://vrm.dev/licenses/1.0/")
        self.assertNotIn("plan", str(caught.exception))

    def test_counts_of_one_have_a_singular(self):
        one = curveskel.read(self.saved("1.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"))
        self.assertIn("2 nodes, 1 edge, 1 branch", repr(one))

    def saved(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def test_pictures_of_usd_go_where_the_program_puts_them(self):
        """A pyramid with a picture on it, a TGA of one pixel."""
        corners = ["0 0 0", "1 0 0", "1 0 1", "0 0 1", "0.5 4 0.5"]
        faces = ["1/1 2/2 3/3 4/4", *(f"{a}/{a} 5/1 {b}/{b}" for a, b in
                                      ((2, 1), (3, 2), (4, 3), (1, 4)))]
        lines = ["mtllib p.mtl", *(f"v {corner}" for corner in corners),
                 "vt 0 0", "vt 1 0", "vt 1 1", "vt 0 1", "usemtl skin", *(f"f {f}" for f in faces)]
        (self.folder / "p.obj").write_text("\n".join(lines) + "\n")
        (self.folder / "p.mtl").write_text("newmtl skin\nmap_Kd skin.tga\n")
        (self.folder / "skin.tga").write_bytes(
            bytes([0, 0, 2] + [0] * 9 + [1, 0, 1, 0, 24, 0, 1, 2, 3]))
        made = []
        for folder in ("program", "python"):
            (self.folder / folder).mkdir()
            output = self.folder / folder / "a.usda"
            if folder == "program":
                self.program("rig", self.folder / "p.obj", "-o", output)
            else:
                curveskel.rig(self.folder / "p.obj").save(output)
            made.append((output.read_bytes(),
                         (output.parent / "a_textures" / "skin.png").read_bytes()))
        self.assertEqual(*made)

    def test_rig_of_a_file_as_it_is_shown_or_as_it_was_bound(self):
        rex = MESHES / "free" / "rigs" / "quaternius-trex-1k.glb"  # rests as it runs
        made = []
        for as_shown, arguments in ((False, ()), (True, ("--as-shown",))):
            self.program("rig", rex, "-o", self.folder / "r.glb", *arguments)
            curveskel.rig(rex, as_shown=as_shown).save(self.folder / "m.glb")
            made.append((self.folder / "m.glb").read_bytes())
            self.assertEqual(made[-1], (self.folder / "r.glb").read_bytes())
        self.assertNotEqual(*made)

    @unittest.skipUnless(has("scipy"), "no scipy")
    def test_rig_takes_a_skeleton_or_joints(self):
        skeleton = curveskel.extract(Y)
        skeleton.save(self.folder / "y.json")
        self.program("rig", Y, "--skeleton", self.folder / "y.json", "-o", self.folder / "r.json")
        rig = curveskel.rig(Y, skeleton=skeleton)
        rig.save(self.folder / "m.json")
        self.assertEqual((self.folder / "m.json").read_bytes(),
                         (self.folder / "r.json").read_bytes())
        again = curveskel.rig(Y, joints=self.folder / "r.json")
        numpy.testing.assert_allclose(again.joints, rig.joints)
        with self.assertRaises(curveskel.UsageError):
            curveskel.rig(Y, skeleton=skeleton, joints=self.folder / "r.json")

    def test_rig_refuses_what_the_program_refuses(self):
        skeleton = curveskel.extract(Y)
        rex = MESHES / "free" / "rigs" / "quaternius-trex-1k.glb"
        for mesh, options in ((Y, {"skeleton": skeleton, "detail": 0.2}),
                              (Y, {"skeleton": skeleton, "fair": 3}),
                              *((rex, {"joints": rex, name: value}) for name, value in (
                                  ("names", "vrm"), ("plan", "bird"), ("root", 3), ("follow", 2),
                                  ("bone_length", 3), ("joint_budget", 9))),
                              (rex, {"keep_rig": True, "joints": rex}),
                              (rex, {"keep_rig": True, "as_shown": True}),
                              (rex, {"keep_rig": True, "ends": False}),
                              (rex, {"keep_rig": True, "pose": "t"}),
                              (curveskel.extract(Y).mesh, {"keep_rig": True}),
                              (Y, {"root": 999999}), (Y, {"root": -5})):
            with self.assertRaises(curveskel.UsageError, msg=options):
                curveskel.rig(mesh, **options)
        with self.assertRaises(curveskel.InputError):
            curveskel.rig(Y, skeleton=curveskel.extract(TORUS))

    def test_messages_name_the_keyword(self):
        for keyword, call in (("min_size", lambda: curveskel.extract(Y, min_size=2)),
                              ("fair", lambda: curveskel.extract(Y, fair=-1)),
                              ("fair", lambda: curveskel.rig(Y, fair=-1)),
                              ("min_size", lambda: curveskel.rig(Y, min_size=2)),
                              ("min_size", lambda: curveskel.contract(Y, min_size=2)),
                              ("iterations", lambda: curveskel.contract(Y, iterations=-1)),
                              ("iterations", lambda: curveskel.contract(Y, iterations=0)),
                              ("iterations", lambda: curveskel.fair(Y, iterations=-1)),
                              ("rings", lambda: curveskel.fair(Y, rings=0)),
                              ("least_sheet", lambda: curveskel.extract(Y, least_sheet=2)),
                              ("bone_length", lambda: curveskel.rig(Y, bone_length=-1)),
                              ("follow", lambda: curveskel.rig(Y, follow=-1)),
                              ("softness", lambda: curveskel.rig(Y, softness=-1)),
                              ("joint_budget", lambda: curveskel.rig(Y, joint_budget=-1)),
                              ("bone_length", lambda: curveskel.rig(Y, bone_length=0.4)),
                              ("softness", lambda: curveskel.rig(Y, softness=21)),
                              ("joint_budget", lambda: curveskel.rig(Y, joint_budget=1000001))):
            with self.assertRaisesRegex(curveskel.UsageError, f"^{keyword} is -?[0-9]", msg=keyword):
                call()

    def test_no_message_names_an_option_of_the_program(self):
        skeleton, rig = curveskel.extract(Y), curveskel.rig(Y)
        meta = {"vrm_name": "a", "vrm_author": "b"}
        flat = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], [[0, 1, 2], [2, 1, 3]])
        for keyword, call in (("vrm_licence", lambda: rig.save(self.folder / "a.vrm")),
                              ("vrm_licence", lambda: rig.save(self.folder / "a.vrm", **meta,
                                                               vrm_licence="none")),
                              ("least_sheet", lambda: curveskel.extract(flat, wrap="never")),
                              ("spacing", lambda: skeleton.profiles("fine")),
                              ("threads", lambda: skeleton.profiles(threads="all")),
                              ("threads", lambda: curveskel.match(skeleton, skeleton, threads=-1)),
                              ("progress", lambda: curveskel.extract(Y, progress=3))):
            with self.assertRaises(curveskel.Error, msg=keyword) as raised:
                call()
            self.assertIn(keyword, str(raised.exception))
            self.assertNotIn("--", str(raised.exception))

    @unittest.skipUnless(has("scipy"), "no scipy")
    def test_a_rig_goes_through_pickle_and_copies(self):
        rig = curveskel.rig(MESHES / "free" / "humanoid-10k.ply.gz", front="-x")
        self.assertIs(copy.deepcopy(rig), rig)
        again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(rig))))
        for name in ("joints", "parents"):
            numpy.testing.assert_array_equal(getattr(again, name), getattr(rig, name))
            self.assertFalse(getattr(again, name).flags.writeable)
        self.assertEqual((again.names, again.roles, again.report, again.plan),
                         (rig.names, rig.roles, rig.report, rig.plan))
        self.assertEqual((again.weights != rig.weights).nnz, 0)
        with self.assertRaisesRegex(curveskel.UsageError, "pickled"):
            again.save(self.folder / "again.glb")

    def test_what_is_no_path_is_told_so(self):
        rig = curveskel.rig(Y)
        skeleton = curveskel.extract(Y)
        for name, call in (("joints", lambda: curveskel.rig(Y, joints=([[0, 0, 0]], [-1]))),
                           ("joints", lambda: curveskel.rig(Y, joints="a\0b")),
                           ("mesh", lambda: curveskel.extract("a\0b.obj")),
                           ("skeleton", lambda: curveskel.evaluate(Y, "a\0b.obj")),
                           ("path", lambda: curveskel.read("a\0b.obj")),
                           ("path", lambda: curveskel.read(3)),
                           ("path", lambda: skeleton.save("a\0b.obj")),
                           ("path", lambda: skeleton.save(3)),
                           ("path", lambda: skeleton.save_html(3)),
                           ("path", lambda: rig.save("a\0b.glb"))):
            with self.assertRaisesRegex(curveskel.UsageError, f"^{name}: needs a path", msg=name):
                call()

    def test_a_slip_does_not_overwrite_another_file(self):
        skeleton = curveskel.extract(Y)
        mesh = self.folder / "mesh.obj"
        mesh.write_text("v 0 0 0\n")
        for save, extension in ((skeleton.save_html, ".html"), (skeleton.to_swc, ".swc")):
            with self.assertRaisesRegex(curveskel.UsageError, "mesh.obj: .* ends in " + extension):
                save(mesh)
            save(self.folder / ("x" + extension.upper()))
        self.assertEqual(mesh.read_text(), "v 0 0 0\n")

    def test_a_detail_without_effect_is_warned_of(self):
        for options, count in (({"embed": "none", "detail": 0.3}, 1), ({"embed": "none"}, 0),
                               ({"detail": 0.3}, 0), ({"preset": "paper", "detail": 0.3}, 1)):
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                curveskel.extract(TORUS, **options)
            idle = [one for one in caught if "detail has no effect" in str(one.message)]
            self.assertEqual(len(idle), count, options)
            for one in idle:
                self.assertEqual(one.filename, __file__)

    def test_rig_warns_as_the_program_does(self):
        human = MESHES / "free" / "humanoid-10k.ply.gz"
        (self.folder / "far.json").write_text(json.dumps({"joints": [
            {"name": str(k), "parent": k - 1, "position": [0.1 if k == 0 else 50.0, 0, 0]}
            for k in range(5)]}))
        vertices, faces = map(numpy.array, curveskel.extract(Y).mesh)
        plate = numpy.array([[x, y, z] for z in (0, 0.2) for y in (0, 9) for x in (0, 10)])
        sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]]
        for mesh, options, words in ((Y, {"plan": "humanoid"}, "humanoid|limbs|pair"),
                                     (Y, {"names": "mixamo"}, "no words for the plan other"),
                                     (Y, {"joints": self.folder / "far.json"}, "1 of 5 joints")):
            with self.assertWarnsRegex(UserWarning, words, msg=options):
                curveskel.rig(mesh, **options)
        with self.assertWarnsRegex(curveskel.CertificateWarning, "made of tubes"):
            curveskel.rig((plate, sides))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            rig = curveskel.rig(human, front="-x")
            curveskel.rig((vertices, faces))
        with self.assertWarnsRegex(UserWarning, "VRM's figures"):
            rig.save(self.folder / "h.vrm", vrm_name="a", vrm_author="b",
                     vrm_licence="https://vrm.dev/licenses/1.0/")

    def test_a_rig_that_is_kept_is_the_program_s(self):
        rex = MESHES / "free" / "rigs" / "quaternius-trex-1k.glb"
        self.program("rig", rex, "--keep-rig", "-o", self.folder / "r.glb")
        curveskel.rig(rex, keep_rig=True).save(self.folder / "m.glb")
        self.assertEqual((self.folder / "m.glb").read_bytes(),
                         (self.folder / "r.glb").read_bytes())

    @unittest.skipUnless(has("pandas"), "no pandas")
    def test_match_is_the_program_s_and_knows_a_turned_surface(self):
        vertices, faces = map(numpy.array, curveskel.extract(MESHES / "double-torus.off").mesh)
        turn = numpy.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])
        found = curveskel.match((vertices, faces), (vertices @ turn.T + 3, faces), by_shape=True)
        self.assertEqual(found.alone, ([], []))
        self.assertFalse(found.by_vertices)
        spot = MESHES / "free" / "spot-3k.obj"
        a = curveskel.extract(spot)
        moved = (numpy.array(a.mesh[0]) @ turn.T, numpy.array(a.mesh[1]))
        match = curveskel.match(a, moved, by_shape=True)
        self.assertEqual(match.alone, ([], []))
        self.assertFalse(match.branches.ambiguous.any())
        self.assertEqual(len(match.junctions), len(a.junctions))
        self.program("match", spot, spot, "--by-shape", "-o", self.folder / "m.json")
        written = json.loads((self.folder / "m.json").read_text())
        self.assertEqual(written["by"], "shape")
        again = curveskel.match(spot, spot, by_shape=True)
        self.assertEqual([pair["b"] for pair in written["branches"]], again.branches.b.tolist())
        self.assertEqual(written["vertices"], again.vertices.tolist())
        self.assertEqual(again.branches.a.tolist(), again.branches.b.tolist())
        self.assertGreater((again.vertices == numpy.arange(len(again.vertices))).mean(), 0.9)
        same = curveskel.match(a, moved)
        self.assertTrue(same.by_vertices)
        self.assertEqual(same.alone, ([], []))
        numpy.testing.assert_array_equal(same.vertices, numpy.arange(len(same.vertices)))
        self.program("match", spot, spot, "-o", self.folder / "m.json")
        written = json.loads((self.folder / "m.json").read_text())
        self.assertEqual(written["by"], "vertices")
        self.assertEqual(written["vertices"], same.vertices.tolist())
        a.save(self.folder / "a.json")
        with self.assertRaises(curveskel.UsageError):
            curveskel.match(curveskel.read(self.folder / "a.json"), a)

    def test_the_stubs_have_the_public_names(self):
        stubs = ast.parse((SOURCE / "python" / "curveskel" / "__init__.pyi").read_text())
        known = {node.name: node for node in stubs.body
                 if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        aliases = {target.id for node in stubs.body if isinstance(node, ast.Assign)
                   for target in node.targets}
        self.assertTrue(all(name[0] == "_" for name in aliases), "what can't be imported is private")
        for name in curveskel.__all__:
            self.assertIn(name, known)
            if not isinstance(known[name], ast.ClassDef) or name.endswith(("Error", "Warning")):
                continue
            there = {member for member in vars(getattr(curveskel, name)) if member[0] != "_"}
            stubbed = {node.name for node in known[name].body
                       if isinstance(node, ast.FunctionDef) and node.name[0] != "_"}
            self.assertEqual(there, stubbed, name)
            source = pathlib.Path(inspect.getsourcefile(getattr(curveskel, name))).read_text()
            of_class = next(node for node in ast.walk(ast.parse(source))
                            if isinstance(node, ast.ClassDef) and node.name == name)
            kept = {node.attr for node in ast.walk(of_class) if isinstance(node, ast.Attribute)
                    and isinstance(node.ctx, ast.Store) and node.attr[0] != "_"
                    and isinstance(node.value, ast.Name) and node.value.id == "self"}
            annotated = {node.target.id for node in known[name].body
                         if isinstance(node, ast.AnnAssign)}
            self.assertEqual(kept, annotated, name)

    def test_the_stubs_have_the_parameters(self):
        stubs = ast.parse((SOURCE / "python" / "curveskel" / "__init__.pyi").read_text())

        def compare(there, stub):
            arguments = stub.args
            names = [one.arg for one in (*arguments.args, *arguments.kwonlyargs,
                                         *filter(None, [arguments.kwarg]))]
            self.assertEqual(list(inspect.signature(there).parameters), names, stub.name)

        for node in stubs.body:
            there = getattr(curveskel, node.name) if hasattr(node, "name") and (
                node.name in curveskel.__all__) else None
            if isinstance(node, ast.FunctionDef):
                compare(there, node)
            for member in node.body if there and isinstance(node, ast.ClassDef) else ():
                if isinstance(member, ast.FunctionDef) and not member.decorator_list:
                    compare(getattr(there, member.name), member)


if __name__ == "__main__":
    unittest.main()
