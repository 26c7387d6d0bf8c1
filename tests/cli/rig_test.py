"""curveskel rig."""

import json
import os
import struct
import unittest
import xml.etree.ElementTree
import zipfile

from program import LINKED_RINGS, MESHES, TORUS, Y, CommandLineTest, run

USAGE = 2


class Rig(CommandLineTest):
    def rig(self, output, *arguments, mesh=Y):
        result = self.run_ok("rig", mesh, "-o", output, *arguments, cwd=self.folder)
        return (self.folder / output).read_bytes(), result

    def glb(self, data):
        """The JSON of a GLB, whose header must be right."""
        self.assertEqual(data[:4], b"glTF")
        version, length, size = struct.unpack_from("<3I", data, 4)
        self.assertEqual((version, length), (2, len(data)))
        return json.loads(data[20:20 + size])

    def vertices(self, scene):
        primitive = scene["meshes"][0]["primitives"][0]
        return scene["accessors"][primitive["attributes"]["POSITION"]]["count"]

    def test_writes_both_formats_and_says_how_many_joints(self):
        result = self.run_ok("rig", Y, "-o", "y.glb", "-o", "y.gltf", cwd=self.folder)
        self.assertEqual(self.files(), ["y.glb", "y.gltf"])
        binary = self.glb((self.folder / "y.glb").read_bytes())
        text = json.loads((self.folder / "y.gltf").read_text())
        given = int(Y.read_text().split("\n", 2)[1].split()[0])
        for scene in (binary, text):
            joints = scene["skins"][0]["joints"]
            self.assertIn(f"rig: {len(joints)} joints, ", result.out.decode())
            names = [scene["nodes"][joint]["name"] for joint in joints]
            self.assertEqual(len([name for name in names if "_end" in name]), 3)
            self.assertEqual(self.vertices(scene), given)
        self.assertIn("wrote y.glb\nwrote y.gltf\n", result.out.decode())

    def test_the_same_bytes_each_time_and_on_any_number_of_threads(self):
        for mesh in (Y, LINKED_RINGS):
            data = self.rig("x.glb", mesh=mesh)[0]
            for arguments in ((), ("--threads", "1"), ("--threads", "3")):
                self.assertEqual(self.rig("x.glb", *arguments, mesh=mesh)[0], data)

    def test_of_the_skeleton_that_extract_gives_is_the_same(self):
        for mesh in (Y, TORUS, LINKED_RINGS):
            self.run_ok("extract", mesh, "-o", "x.json", cwd=self.folder)
            self.assertEqual(self.rig("given.glb", "--skeleton", "x.json", mesh=mesh)[0],
                             self.rig("given.glb", mesh=mesh)[0])

    def test_of_a_skeleton_without_vertices_has_the_same_joints(self):
        self.run_ok("extract", Y, "-o", "x.swc", "-o", "x.json", cwd=self.folder)
        counts = [len(self.glb(self.rig("x.glb", "--skeleton", name)[0])["skins"][0]["joints"])
                  for name in ("x.swc", "x.json")]
        self.assertEqual(counts[0], counts[1])

    def test_of_another_surface_s_skeleton_is_refused(self):
        self.run_ok("extract", TORUS, "-o", "x.json", cwd=self.folder)
        self.refused(3, "rig", Y, "-o", "y.glb", "--skeleton", "x.json",
                     says=["x.json", "a node for each of", "extract it again"], cwd=self.folder)

    def test_of_a_skeleton_that_leaves_the_surface_says_so(self):
        self.run_ok("extract", Y, "-o", "y.obj", cwd=self.folder)
        lines = (self.folder / "y.obj").read_text().splitlines()
        half = [line if not line.startswith("v ") else
                f"v {' '.join(str(float(x) * 0.6 + 2) for x in line.split()[1:3])} {line.split()[3]}"
                for line in lines]
        (self.folder / "half.obj").write_text("\n".join(half) + "\n")
        result = self.run_ok("rig", Y, "-o", "y.glb", "--skeleton", "half.obj", cwd=self.folder)
        self.assertRegex(result.err, r"warning: [0-9.]+ % of the length of the skeleton given")
        result = self.run_ok("rig", Y, "-o", "y.glb", "--skeleton", "y.obj", cwd=self.folder)
        self.assertNotIn("warning", result.err)

    def test_a_skeleton_for_joints_is_called_one(self):
        self.run_ok("extract", Y, "-o", "y.json", cwd=self.folder)
        self.refused(3, "rig", Y, "-o", "y.glb", "--joints", "y.json", cwd=self.folder,
                     says=["a skeleton's nodes", "--skeleton"])

    def test_of_a_skeleton_without_vertices_has_the_same_plan(self):
        spot = MESHES / "free" / "spot-3k.obj"
        self.run_ok("extract", spot, "-o", "s.json", "-o", "s.ply", "-o", "s.swc", "-q",
                    cwd=self.folder)
        for name in ("s.json", "s.ply", "s.swc"):
            result = self.run_ok("rig", spot, "--skeleton", name, "-o", "x.glb", cwd=self.folder)
            self.assertIn("plan: quadruped", result.out.decode(), name)

    def test_of_joints_in_too_small_a_unit_says_so(self):
        self.run_ok("rig", Y, "-o", "j.json", "-q", cwd=self.folder)
        rig = json.loads((self.folder / "j.json").read_text())
        for factor, warned in ((1, False), (0.01, True)):
            for joint in rig["joints"]:
                joint["position"] = [factor * x for x in joint["position"]]
            (self.folder / "t.json").write_text(json.dumps(rig))
            result = self.run_ok("rig", Y, "--joints", "t.json", "-o", "x.glb", cwd=self.folder)
            self.assertEqual("times 100" in result.err, warned, result.err)

    def test_options_change_the_joints_and_the_weights(self):
        data = self.rig("x.glb")[0]
        few = self.glb(data)["skins"][0]["joints"]
        many = self.glb(self.rig("x.glb", "--bone-length", "1.5")[0])["skins"][0]["joints"]
        self.assertGreater(len(many), 1.5 * len(few))
        softer = self.rig("x.glb", "--softness", "3")[0]
        self.assertEqual(len(softer), len(data))
        self.assertNotEqual(softer, data)
        self.assertEqual(self.glb(softer)["nodes"], self.glb(data)["nodes"])

    def test_a_wanted_root_is_the_root_of_all(self):
        self.run_ok("extract", LINKED_RINGS, "-o", "x.json", cwd=self.folder)
        nodes = json.loads((self.folder / "x.json").read_text())["nodes"]
        for root in (0, len(nodes) - 1):
            scene = self.glb(self.rig("x.glb", "--root", str(root), mesh=LINKED_RINGS)[0])
            self.assertEqual(len(scene["nodes"][0]["children"]), 1)
            joint = scene["nodes"][scene["nodes"][0]["children"][0]]
            self.assertEqual(joint["name"], "root")
            for found, wanted in zip(joint["translation"], nodes[root]):
                self.assertAlmostEqual(found, wanted, places=9)

    def test_a_root_that_is_no_node_is_named(self):
        self.refused(USAGE, "rig", Y, "-o", "y.glb", "--root", "999999",
                     says=["root 999999, needed one of the", "nodes"], cwd=self.folder)

    def test_a_file_whose_look_is_not_read_is_said_to_lose_it(self):
        words = "are not taken from such a file"
        corners = [(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2)]
        faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
        numbers = lambda rows: " ".join(str(number) for row in rows for number in row)
        (self.folder / "y.vtk").write_text(
            "# vtk DataFile Version 3.0\ny\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n"
            f"{numbers(corners)}\nPOLYGONS 4 16\n{numbers((3, *face) for face in faces)}\n")
        (self.folder / "y2.VTK").write_text((self.folder / "y.vtk").read_text())
        for name in ("y.vtk", "y2.VTK"):
            self.assertIn(words, self.run_ok("rig", name, "-o", "z.glb", cwd=self.folder).err)
        quiet = self.run_ok("rig", "y.vtk", "-o", "z.glb", "--bare", cwd=self.folder).err
        self.assertNotIn(words, quiet)

    def test_the_look_of_fbx_is_read(self):
        self.run_ok("fair", Y, "--iterations", "0", "-o", "y.obj", cwd=self.folder)
        surface = (self.folder / "y.obj").read_text()
        (self.folder / "y.mtl").write_text("newmtl skin\nKd .5 .25 .125\n")
        (self.folder / "y.obj").write_text("mtllib y.mtl\nusemtl skin\n" + surface)
        for name, materials in (("y.obj", ["skin"]), (Y, [])):
            self.run_ok("rig", name, "-o", "y.fbx", cwd=self.folder)
            said = self.run_ok("rig", "y.fbx", "-o", "z.glb", cwd=self.folder).err
            self.assertNotIn("warning", said)
            found = self.glb((self.folder / "z.glb").read_bytes()).get("materials", [])
            self.assertEqual([material["name"] for material in found], materials)
            for material in found:
                self.assertEqual(material["pbrMetallicRoughness"]["metallicFactor"], 0)

    def test_another_extension_is_a_usage_error_that_lists_the_formats(self):
        for name in ("y.x3d", "y.obj", "y"):
            self.refused(2, "rig", Y, "-o", name, says=["glb", "gltf"], cwd=self.folder)
        self.refused(2, "rig", Y, says=["--output"], cwd=self.folder)
        self.refused(2, "rig", Y, "-o", "y.glb", "--softness", "0", says=["--softness"],
                     cwd=self.folder)

    def test_a_folder_as_an_output_is_refused_at_once(self):
        (self.folder / "d.usda").mkdir()
        self.refused(6, "rig", "missing.gltf", "-o", "d.usda", cwd=self.folder,
                     says=["is a folder", "name another"])

    def test_all_formats_at_once_have_the_same_joints(self):
        names = ["y.json", "y.txt", "y.bvh", "y.usda", "y.npz", "y.glb"]
        self.run_ok("rig", Y, *(word for name in names for word in ("-o", name)), cwd=self.folder)
        joints = [joint["name"] for joint
                  in json.loads((self.folder / "y.json").read_text())["joints"]]
        moving = [name for name in joints if "_end" not in name]
        for name, marks in (("y.txt", "joints {} "), ("y.bvh", " {}\n"), ("y.usda", "{}\"")):
            text = (self.folder / name).read_text()
            for joint in moving:
                written = joint.replace(".", "_") if name.endswith(".usda") else joint
                self.assertTrue(marks.format(written) in text, f"{written} in {name}")
        with zipfile.ZipFile(self.folder / "y.npz") as archive:
            self.assertIsNone(archive.testzip())
            self.assertIn("weights.npy", archive.namelist())
        found = self.glb((self.folder / "y.glb").read_bytes())
        self.assertEqual(sorted(node["name"] for node in found["nodes"][2:]), sorted(joints))

    def test_somebodys_joints_get_weights(self):
        self.run_ok("rig", Y, "-o", "own.json", "-o", "own.txt", "-o", "own.glb", cwd=self.folder)
        own = json.loads((self.folder / "own.json").read_text())
        for name in ("own.json", "own.txt", "own.glb"):
            self.run_ok("rig", Y, "--joints", name, "-o", "given.json", cwd=self.folder)
            given = json.loads((self.folder / "given.json").read_text())
            self.assertEqual(given["vertices"], own["vertices"])
            for joint, same in zip(sorted(given["joints"], key=lambda joint: joint["name"]),
                                   sorted(own["joints"], key=lambda joint: joint["name"])):
                self.assertEqual(joint["name"], same["name"])
                for found, wanted in zip(joint["position"], same["position"]):
                    self.assertAlmostEqual(found, wanted, places=5)
            for weights in given["weights"]["values"]:
                self.assertAlmostEqual(sum(weights), 1, places=5)

    def test_joints_that_are_not_of_the_surface_are_refused(self):
        far = {"joints": [{"name": "far", "parent": -1, "position": [1000, 0, 0]}]}
        (self.folder / "far.json").write_text(json.dumps(far))
        self.refused(3, "rig", Y, "--joints", "far.json", "-o", "x.glb", cwd=self.folder,
                     says=["far.json", "none of 1 joints", "coordinates"])
        self.refused(3, "rig", Y, "--joints", Y, "-o", "x.glb", cwd=self.folder,
                     says=[Y.name, "no joint"])
        self.refused(2, "rig", Y, "--joints", "far.json", "--keep-rig", "-o", "x.glb",
                     cwd=self.folder, says=["--joints", "--keep-rig"])

    def test_a_rig_is_kept_wherever_its_joints_lie(self):
        corners = " ".join(f"{x} {y} {z}" for x in (0, 1) for y in (0, 1) for z in (0, 1))
        faces = "0 1 3 2 4 6 7 5 0 4 5 1 2 3 7 6 0 2 6 4 1 5 7 3"
        (self.folder / "crate.dae").write_text(f"""<?xml version="1.0"?>
            <COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
            <asset><up_axis>Y_UP</up_axis></asset>
            <library_geometries><geometry id="g"><mesh>
            <source id="p"><float_array id="a" count="24">{corners}</float_array>
            <technique_common><accessor source="#a" count="8" stride="3"><param name="X"
            type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
            </technique_common></source>
            <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
            <polylist count="6"><input semantic="VERTEX" source="#v" offset="0"/>
            <vcount>4 4 4 4 4 4</vcount><p>{faces}</p></polylist></mesh></geometry>
            </library_geometries><library_visual_scenes><visual_scene id="s">
            <node id="rope" name="rope" type="JOINT"><translate>0 9 0</translate></node>
            <node id="m"><instance_geometry url="#g"/></node></visual_scene>
            </library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>""")
        self.run_ok("rig", "crate.dae", "--keep-rig", "-o", "kept.json", cwd=self.folder)
        kept = json.loads((self.folder / "kept.json").read_text())
        self.assertEqual([(joint["name"], joint["position"]) for joint in kept["joints"]],
                         [("rope", [0, 9, 0])])
        self.assertEqual({row[0] for row in kept["weights"]["values"]}, {1})
        self.refused(3, "rig", Y, "--joints", "crate.dae", "-o", "x.glb", cwd=self.folder,
                     says=["none of 1 joints"])

    def test_what_would_have_no_effect_on_a_rig_is_refused(self):
        self.refused(2, "rig", Y, "-o", "y.glb", "--vrm-name", "Y", cwd=self.folder,
                     says=["--vrm-name", ".vrm"])
        self.refused(2, "rig", Y, "-o", "y.glb", "--root", "3", "--plan", "humanoid",
                     cwd=self.folder, says=["--root 3", "--plan humanoid", "leave out"])
        self.run_ok("rig", Y, "-o", "y.glb", "--root", "3", "--plan", "none", cwd=self.folder)
        self.run_ok("rig", Y, "-o", "joints.json", cwd=self.folder)
        self.refused(2, "rig", Y, "-o", "y.glb", "--joints", "joints.json", "--pose", "t",
                     cwd=self.folder, says=["--pose", "--joints"])

    def test_a_vrm_is_of_a_human_that_somebody_has_made(self):
        self.refused(2, "rig", Y, "-o", "y.vrm", cwd=self.folder,
                     says=["--vrm-name", "--vrm-author", "--vrm-licence"])
        self.refused(3, "rig", Y, "-o", "y.vrm", "--vrm-name", "Y", "--vrm-author", "a person",
                     "--vrm-licence", "https://vrm.dev/licenses/1.0/", cwd=self.folder,
                     says=["hips", "--plan", ".glb"])
        self.assertFalse((self.folder / "y.vrm").exists())

    def test_advice_goes_with_the_options_that_were_given(self):
        """They excluded the --plan that they were told to give."""
        vrm = ("--vrm-name", "Y", "--vrm-author", "a person", "--vrm-licence",
               "https://vrm.dev/licenses/1.0/")
        self.run_ok("rig", Y, "-o", "y.glb", "-o", "y.json", cwd=self.folder)
        for mesh, given, option in ((Y, ("--joints", "y.json"), "--joints"),
                                    ("y.glb", ("--keep-rig",), "--keep-rig")):
            result = self.refused(3, "rig", mesh, *given, "-o", "x.vrm", *vrm, cwd=self.folder,
                                  says=["the role hips", "leave out " + option])
            self.assertNotIn("--plan", result.err)
        # Here or before anything is read.
        result = run("rig", Y, "--joints", "y.json", "--pose", "t", "-o", "x.glb", cwd=self.folder)
        self.assertIn(result.code, (2, 3), result.err)
        self.assertNotIn("--plan", result.err)

    def test_a_skeleton_or_a_rig_for_a_surface_is_called_one(self):
        self.run_ok("extract", Y, *(word for name in ("s.json", "s.ply", "s.obj", "s.vtp", "s.swc")
                                    for word in ("-o", name)), cwd=self.folder)
        self.run_ok("rig", Y, "-o", "r.json", "-o", "r.usdz", cwd=self.folder)
        for name, words in (("s.json", "a skeleton of curveskel"), ("s.ply", "a skeleton or a drawing"),
                            ("s.obj", "a skeleton or a drawing"), ("s.vtp", "a skeleton or a drawing"),
                            ("s.swc", "a skeleton file (swc)"), ("r.json", "a rig of curveskel"), ("r.usdz", "a USD scene")):
            self.refused(3, "extract", name, "-o", "x.obj", says=[name, words], cwd=self.folder)

    def test_what_is_no_surface_is_refused(self):
        self.refused(3, "rig", "nowhere.off", "-o", "x.glb", says=["nowhere.off"],
                     cwd=self.folder)
        (self.folder / "cloud.off").write_text("OFF\n4 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n")
        self.refused(3, "rig", "cloud.off", "-o", "x.glb", says=["cloud.off"], cwd=self.folder)
        self.refused(3, "rig", Y, "-o", "x.glb", "--skeleton", "nowhere.json",
                     says=["nowhere.json"], cwd=self.folder)

    def test_quiet_prints_nothing(self):
        result = self.rig("y.glb", "-q")[1]
        self.assertEqual((result.out, result.err), (b"", ""))

    def test_names_of_files_need_not_be_utf8(self):
        mesh = os.fsdecode(b"caf\xe9.off")
        (self.folder / mesh).write_bytes(Y.read_bytes())
        scene = self.glb(self.rig("x.glb", "-q", mesh=mesh)[0])
        self.assertEqual(scene["meshes"][0]["name"],
                         "caf\N{REPLACEMENT CHARACTER}")

    def test_texts_are_utf8_whatever_the_name_of_the_file(self):
        """Names from old archives are Latin-1, Shift-JIS or anything; even control characters."""
        for name in (b"caf\xe9.off", b"\x83\x82.off", b"\xff\x01 --> <&.off"):
            mesh = os.fsdecode(name)
            (self.folder / mesh).write_bytes(Y.read_bytes())
            skeletons = [f"s.{format}" for format in
                         ("obj", "ply", "cgal", "swc", "vtp", "csv", "graphml", "json", "svg")]
            tables = ["--html", "s.html", "--report", "s.report.json", "--profiles", "p.csv",
                      "--labelled", "l.vtp", "-o", "l.labelled.glb"]
            wanted = [word for output in skeletons for word in ("-o", output)]
            self.run_ok("extract", mesh, *wanted, *tables, "-q", cwd=self.folder)
            self.run_ok("match", mesh, mesh, "-o", "m.json", "-q", cwd=self.folder)
            rigs = ["r.gltf", "r.usda", "r.bvh", "r.json", "r.txt"]
            for rig in rigs:
                self.run_ok("rig", mesh, "-o", rig, "--report", "r.report.json", "-q", cwd=self.folder)
            texts = {output: (self.folder / output).read_bytes().decode("utf-8")
                     for output in (*skeletons, "s.html", "s.report.json", "p.csv", "l.vtp",
                                    "m.json", *rigs, "r.report.json") if output != "s.ply"}
            for output, text in texts.items():
                if output.endswith((".json", ".gltf")):
                    json.loads(text)
                if output.endswith((".vtp", ".graphml", ".svg")):
                    xml.etree.ElementTree.fromstring(text)

    def test_a_rig_is_a_surface_that_can_be_rigged(self):
        self.rig("y.glb")
        first = self.glb((self.folder / "y.glb").read_bytes())
        second = self.glb(self.rig("again.glb", mesh="y.glb")[0])
        self.assertEqual(self.vertices(second), self.vertices(first))
        self.assertEqual(len(second["skins"][0]["joints"]), len(first["skins"][0]["joints"]))

    def test_left_is_where_x_is_smaller_in_a_vrm_0_file(self):
        def sides(mesh):
            scene = self.glb(self.rig("x.glb", mesh=mesh)[0])
            names = [node.get("name", "") for node in scene["nodes"]]
            return [name[-2:] for name in names if name.endswith((".L", ".R"))]

        header, counts, *rows = Y.read_text().split("\n")
        vertices = int(counts.split()[0])
        rows[:vertices] = [" ".join(row.split()[1:] + row.split()[:1]) for row in rows[:vertices]]
        (self.folder / "turned.off").write_text("\n".join([header, counts, *rows]))
        self.rig("y.gltf", mesh="turned.off")  # its mirror plane is x = 0
        scene = json.loads((self.folder / "y.gltf").read_text())
        plain = sides("y.gltf")
        self.assertGreater(len(plain), 1)
        swapped = [{".L": ".R", ".R": ".L"}[side] for side in plain]
        for name, expected in (("VRM", swapped), ("VRMC_vrm", plain)):
            scene["extensions"] = {name: {"specVersion": "0.0"}}
            (self.folder / "y.vrm").write_text(json.dumps(scene))
            self.assertEqual(sides("y.vrm"), expected)


if __name__ == "__main__":
    unittest.main()
