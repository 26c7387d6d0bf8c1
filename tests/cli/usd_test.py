"""Rigs as USD: a layer that is whole, has what the .glb of the same run has, and its pictures.
The collection's characters are there with CURVESKEL_COLLECTION."""

import json
import math
import os
import pathlib
import shutil
import struct
import unittest
import zipfile

import usda
from doll import doll, picture
from glb import IDENTITY, Gltf, frame, inverse, moved, product, shown
from program import Y, CommandLineTest

def deformed(mesh, skeleton):
    """What UsdSkel makes of a mesh at rest."""
    paths, world = skeleton["joints"], {}
    for path, rest in zip(paths, skeleton["restTransforms"]):
        above = path.rpartition("/")[0]
        world[path] = product(rest, world[above] if above else IDENTITY)
    moves = [product(inverse(bind), world[path])
             for path, bind in zip(paths, skeleton["bindTransforms"])]
    geometry = mesh["primvars:skel:geomBindTransform"]
    joints = mesh["primvars:skel:jointIndices"]
    weights = mesh["primvars:skel:jointWeights"]
    width = mesh.attributes["primvars:skel:jointIndices"].metadata["elementSize"]
    result = []
    for vertex, point in enumerate(mesh["points"]):
        bound = moved(point, geometry)
        rows = range(width * vertex, width * (vertex + 1))
        places = [(weights[k], moved(bound, moves[int(joints[k])])) for k in rows if weights[k]]
        result.append(tuple(sum(w * place[k] for w, place in places) for k in range(3)))
    return result


class Usd(CommandLineTest):
    def assert_near(self, found, wanted, off=1e-5):
        self.assertEqual(len(found), len(wanted))
        for one, other in zip(found, wanted):
            self.assertLessEqual(max(abs(a - b) for a, b in zip(one, other, strict=True)), off)

    def rig(self, source, *options):
        """The layer and the .glb of one run; the layer is whole."""
        self.run_ok("rig", source, "-o", "out.usda", "-o", "out.glb", "-o", "out.usdz", "-q",
                    *options, cwd=self.folder)
        metadata, root = self.whole((self.folder / "out.usda").read_text(),
                                    lambda name: (self.folder / name).is_file())
        self.check_archive(root)
        return metadata, root, Gltf(self.folder / "out.glb")

    def check_archive(self, layer):
        archive = self.folder / "out.usdz"
        data = archive.read_bytes()
        with zipfile.ZipFile(archive) as packed:
            self.assertIsNone(packed.testzip())
            names = packed.namelist()
            self.assertTrue(names[0].endswith(".usda"))
            for entry in packed.infolist():
                self.assertEqual(entry.compress_type, zipfile.ZIP_STORED)
                self.assertEqual(entry.date_time, (1980, 1, 1, 0, 0, 0))
                name, extra = struct.unpack_from("<HH", data, entry.header_offset + 26)
                begin = entry.header_offset + 30 + name + extra
                self.assertEqual(begin % 64, 0)
                self.assertEqual(data[begin:begin + entry.file_size], packed.read(entry))
            _, root = self.whole(packed.read(names[0]).decode(), names.__contains__)
            self.assertEqual([prim.path for prim in root.all()],
                             [prim.path for prim in layer.all()])
            files = [self.assets(one) for one in (layer, root)]
            self.assertEqual(set(names[1:]), set(files[1]))
            for beside, within in zip(*files):
                self.assertEqual((self.folder / beside).read_bytes(), packed.read(within))

    @staticmethod
    def assets(root):
        return [prim["inputs:file"].removeprefix("./") for prim in root.all("Shader")
                if "inputs:file" in prim.attributes]

    def whole(self, text, is_there):
        """Parsed; all that it names is there, and rows are as many as they must be."""
        metadata, root = usda.read(text)
        self.assertEqual(metadata["defaultPrim"], root.name)
        self.assertEqual((metadata["metersPerUnit"], metadata["upAxis"]), (1, "Y"))
        self.assertEqual(root.kind, "SkelRoot")
        prims = {prim.path: prim for prim in root.all()}
        for prim in prims.values():
            for targets in prim.relations.values():
                for target in targets:
                    self.assertIn(target, prims)
            for attribute in prim.attributes.values():
                if attribute.connection:
                    path, _, output = attribute.connection.partition(".")
                    self.assertIn(output, prims[path].attributes)
        for name in self.assets(root):
            self.assertTrue(is_there(name), name)
        for mesh in root.all("Mesh"):
            self.check_mesh(mesh, prims)
        for animation in root.all("SkelAnimation"):
            self.check_animation(animation, prims)
        return metadata, root

    def check_mesh(self, mesh, prims):
        points, corners = mesh["points"], mesh["faceVertexIndices"]
        counts = mesh["faceVertexCounts"]
        self.assertEqual(sum(counts), len(corners))
        self.assertTrue(all(0 <= corner < len(points) for corner in corners))
        sizes = {"vertex": len(points), "faceVarying": len(corners)}
        for name, attribute in mesh.attributes.items():
            if "interpolation" not in attribute.metadata:
                continue
            rows = mesh.get(name + ":indices", attribute.value)
            width = attribute.metadata.get("elementSize", 1)
            self.assertEqual(len(rows), width * sizes[attribute.metadata["interpolation"]], name)
            if name + ":indices" in mesh.attributes:
                self.assertTrue(all(0 <= k < len(attribute.value) for k in rows))
        self.assert_near(mesh["extent"], [tuple(f(axis) for axis in zip(*points))
                                          for f in (min, max)], 0)
        subsets = [child for child in mesh.children if child.kind == "GeomSubset"]
        faces = [face for subset in subsets for face in subset["indices"]]
        self.assertEqual(len(set(faces)), len(faces))
        self.assertTrue(set(faces) <= set(range(len(counts))))
        if mesh.get("subsetFamily:materialBind:familyType") == "partition":
            self.assertEqual(len(faces), len(counts))
        self.assertEqual(len(mesh.get("skel:blendShapes", [])),
                         len(mesh.relations.get("skel:blendShapeTargets", [])))
        for shape in mesh.relations.get("skel:blendShapeTargets", []):
            self.assertEqual(len(prims[shape]["offsets"]), len(prims[shape]["pointIndices"]))
        if "primvars:skel:jointWeights" in mesh.attributes:
            self.check_weights(mesh, prims[mesh.relations["skel:skeleton"][0]])

    def check_weights(self, mesh, skeleton):
        joints, weights = (mesh[f"primvars:skel:joint{name}"] for name in ("Indices", "Weights"))
        width = mesh.attributes["primvars:skel:jointWeights"].metadata["elementSize"]
        for vertex in range(len(mesh["points"])):
            row = weights[width * vertex:width * (vertex + 1)]
            self.assertAlmostEqual(sum(row), 1, 5)
            self.assertEqual(row, sorted(row, reverse=True))
        self.assertTrue(all(0 <= joint < len(skeleton["joints"]) for joint in joints))
        paths = skeleton["joints"]
        for name in ("jointNames", "bindTransforms", "restTransforms"):
            self.assertEqual(len(skeleton[name]), len(paths))
        for k, path in enumerate(paths):
            above = path.rpartition("/")[0]
            self.assertTrue(not above or above in paths[:k], path)

    def check_animation(self, animation, prims):
        joints = animation.get("joints", [])
        skeleton = prims[animation.path.rpartition("/")[0]]
        self.assertTrue(set(joints) <= set(skeleton["joints"]))
        sizes = {"translations": len(joints), "rotations": len(joints), "scales": len(joints),
                 "blendShapeWeights": len(animation.get("blendShapes", []))}
        for name, size in sizes.items():
            if name not in animation.attributes:
                continue
            attribute = animation.attributes[name]
            for rows in (attribute.samples or {0: attribute.value}).values():
                self.assertEqual(len(rows), size)

    def doll(self):
        self.run_ok("rig", Y, "-o", "y.glb", "-q", cwd=self.folder)
        return doll(self.folder / "y.glb")

    def test_a_character_keeps_all_that_it_has(self):
        source = self.folder / "Döll @1.glb"
        self.doll().write(source)
        metadata, root, gltf = self.rig(source, "--keep-rig")
        (skeleton,) = root.all("Skeleton")
        j = gltf.json
        self.assertEqual(metadata["timeCodesPerSecond"], 30)
        self.assertEqual((metadata["startTimeCode"], metadata["endTimeCode"]), (0, 30))
        names = [j["nodes"][joint]["name"] for joint in j["skins"][-1]["joints"]]
        self.assertEqual(set(skeleton["jointNames"]), set(names))
        body, hat, stand = (next(mesh for mesh in root.all("Mesh") if mesh.name == name)
                            for name in ("body__1_", "hat", "stand"))
        self.assertEqual(body.metadata["displayName"], 'body "1"')
        node = gltf.node('body "1"')
        first, second = j["meshes"][j["nodes"][node]["mesh"]]["primitives"]
        points = gltf.rows(first["attributes"]["POSITION"])
        self.assert_near(body["points"], points, 1e-6)
        corners = [int(k) for one in (first, second) for (k,) in gltf.rows(one["indices"])]
        self.assertEqual(body["faceVertexIndices"], corners)
        for name, key in (("primvars:st", "TEXCOORD_0"), ("primvars:st1", "TEXCOORD_1")):
            wanted = [(u, 1 - v) for u, v in gltf.rows(first["attributes"][key])]
            self.assert_near(body[name], wanted, 1e-6)
        self.assert_near(body["normals"], gltf.rows(first["attributes"]["NORMAL"]), 1e-6)
        self.assert_near(deformed(body, skeleton), shown(gltf, node))
        self.assert_near(deformed(hat, skeleton), shown(gltf, gltf.node("hat")))
        self.assertEqual(hat.relations["skel:skeleton"], [skeleton.path])
        self.assertNotIn("skel:skeleton", stand.relations)
        self.assertEqual(stand.path, "/Model/_1st_holder/stand")
        self.check_subsets(body, len(gltf.rows(first["indices"])) // 3)
        self.check_shapes(body, skeleton, root)
        self.check_materials(root)
        self.check_motions(root, skeleton, names)

    def check_subsets(self, body, first):
        subsets = [child for child in body.children if child.kind == "GeomSubset"]
        self.assertEqual([len(subset["indices"]) for subset in subsets],
                         [first, len(body["faceVertexCounts"]) - first])
        self.assertEqual([subset.relations["material:binding"] for subset in subsets],
                         [["/Model/Materials/skin"], ["/Model/Materials/skin_2"]])
        self.assertEqual(body["doubleSided"], 1)

    def check_shapes(self, body, skeleton, root):
        self.assertEqual(body["skel:blendShapes"], ["L_cheln", "_1_blink"])
        first, second = (next(prim for prim in root.all("BlendShape") if prim.path == path)
                         for path in body.relations["skel:blendShapeTargets"])
        self.assertEqual([first.metadata["displayName"], second.metadata["displayName"]],
                         ["Lächeln", "1 blink"])
        self.assertEqual(first["pointIndices"], list(range(0, len(body["points"]), 4)))
        self.assertEqual(set(first["offsets"]), {(0, .25, 0)})
        self.assertEqual(dict(zip(second["pointIndices"], second["offsets"]))[3], (-.5, 0, 0))

    def check_materials(self, root):
        skin, plain = root.all("Material")
        self.assertEqual([skin.name, plain.name], ["skin", "skin_2"])
        self.assertEqual(plain.metadata["displayName"], "skin")
        shaders = {prim.name: prim for prim in skin.children}
        surface = shaders["Surface"]
        self.assertEqual(surface["info:id"], "UsdPreviewSurface")
        self.assertEqual(surface["inputs:opacityThreshold"], 0.25)
        wanted = {"diffuseColor": "Color.outputs:rgb", "opacity": "Color.outputs:a",
                  "roughness": "Metal_roughness.outputs:g", "metallic": "Metal_roughness.outputs:b",
                  "normal": "Normal.outputs:rgb", "occlusion": "Occlusion.outputs:r",
                  "emissiveColor": "Emission.outputs:rgb"}
        for name, output in wanted.items():
            self.assertEqual(surface.attributes["inputs:" + name].connection,
                             skin.path + "/" + output)
        numbers = {"Color": ("sRGB", (1, .5, .25, 1), None),
                   "Metal_roughness": ("raw", (1, .75, .5, 1), None),
                   "Normal": ("raw", (1, 1, 2, 1), (-.5, -.5, -1, 0)),
                   "Occlusion": ("raw", (.75, 1, 1, 1), (.25, 0, 0, 0)),
                   "Emission": ("sRGB", (.5, .5, .5, 1), None)}
        for name, (space, scale, bias) in numbers.items():
            shader = shaders[name]
            self.assertEqual((shader["inputs:sourceColorSpace"], shader["inputs:scale"],
                              shader.get("inputs:bias")), (space, scale, bias))
        self.assertEqual([shaders["Color"][f"inputs:wrap{axis}"] for axis in "ST"],
                         ["clamp", "mirror"])
        self.assertEqual([shaders["Normal"][f"inputs:wrap{axis}"] for axis in "ST"], ["repeat"] * 2)
        self.check_transform(shaders)
        files = {name: (self.folder / shaders[name]["inputs:file"]).read_bytes()
                 for name in ("Color", "Occlusion", "Normal")}
        self.assertEqual(files, {"Color": picture(10), "Occlusion": picture(20),
                                 "Normal": picture(30)})
        (other,) = plain.children
        self.assertEqual((other["inputs:diffuseColor"], other["inputs:opacity"],
                          other["inputs:roughness"], other["inputs:metallic"]),
                         ((.5, .25, .125), .5, .25, .125))

    def check_transform(self, shaders):
        """A place of the picture as glTF has it is the one that USD has, v from the other edge."""
        move = shaders["Color_transform"]
        self.assertEqual(shaders["Color"].attributes["inputs:st"].connection,
                         move.path + ".outputs:result")
        turn = math.radians(move["inputs:rotation"])
        for u, v in ((0, 0), (1, 0), (0.25, 0.75)):
            x, y = 2 * u, 3 * v
            c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
            wanted = (0.25 + c * x + s * y, 1 - (0.5 - s * x + c * y))
            x, y = (k * scale for k, scale in zip((u, 1 - v), move["inputs:scale"]))
            c, s = math.cos(turn), math.sin(turn)
            found = [k + shift for k, shift in
                     zip((c * x - s * y, s * x + c * y), move["inputs:translation"])]
            self.assert_near([found], [wanted])
        self.assertEqual(shaders["Reader_st1"]["inputs:varname"], "st1")
        self.assertTrue(shaders["Metal_roughness"].attributes["inputs:st"].connection.startswith(
            shaders["Reader_st1"].path))

    def check_motions(self, root, skeleton, names):
        walk, jump = root.all("SkelAnimation")
        self.assertEqual((walk.name, walk.metadata["displayName"], jump.name),
                         ("Walk_1", "Walk 1", "jump"))
        self.assertEqual(skeleton.relations["skel:animationSource"], [walk.path])
        number = skeleton["jointNames"].index(names[1])
        turns = walk.attributes["rotations"].samples
        self.assertEqual(set(turns) & {0, 15, 30}, {0, 15, 30})
        for code, angle in ((0, .1), (15, .4), (30, -.9), (7.5, .25)):
            before, after = (max(c for c in turns if c <= code), min(c for c in turns if c >= code))
            rows = [turns[k][number] for k in (before, after)]
            self.assertAlmostEqual(sum(row[3] for row in rows) / 2, math.sin(angle), 2)
            if code in turns:
                self.assert_near([turns[code][number]], [(math.cos(angle), 0, 0, math.sin(angle))])
        shares = walk.attributes["blendShapeWeights"].samples
        for code, row in ((0, (.5, 0)), (15, (.25, .5)), (30, (0, 1))):
            self.assert_near([shares[code]], [row])
        places = jump.attributes["translations"].samples
        self.assertAlmostEqual(places[0][number][1], 1)
        self.assertAlmostEqual(places[max(c for c in places if c < 59.999)][number][1], 1)
        self.assertAlmostEqual(places[60][number][1], 3)
        self.assertEqual(jump["blendShapeWeights"], [.25, 0])
        (stand,) = [mesh for mesh in root.all("Mesh") if mesh.name == "stand"]
        self.assert_near([stand.attributes["xformOp:translate"].samples[k] for k in (0, 15, 30)],
                         [(9, 0, 0), (9, 1, 0), (9, 2, 0)])

    def test_a_new_rig_keeps_the_look_and_the_shapes_at_rest(self):
        gltf = self.doll()
        del gltf.json["animations"]
        gltf.write(self.folder / "doll.glb")
        metadata, root, _ = self.rig("doll.glb")
        self.assertNotIn("startTimeCode", metadata)
        self.check_materials(root)
        (shapes,) = root.all("SkelAnimation")
        self.assertEqual((shapes["blendShapes"], shapes["blendShapeWeights"]),
                         (["L_cheln", "_1_blink"], [.25, 0]))

    def test_a_t_pose_is_one_of_rest_alone(self):
        gltf = self.doll()
        turned = gltf.json["nodes"][gltf.json["skins"][-1]["joints"][1]]
        turned["rotation"] = [0, 0, math.sin(.3), math.cos(.3)]
        gltf.write(self.folder / "doll.glb")
        _, root, glb = self.rig("doll.glb", "--keep-rig")
        (skeleton,) = root.all("Skeleton")
        for mesh, node in (("body__1_", 'body "1"'), ("hat", "hat")):
            (found,) = [one for one in root.all("Mesh") if one.name == mesh]
            self.assert_near(deformed(found, skeleton), shown(glb, glb.node(node)))

    def test_meshes_that_were_bound_elsewhere_stand_where_they_are_shown(self):
        """Alike but for one move: on the same skeleton; in another pose: on one of their own."""
        angle = math.sin(.2), math.cos(.2)
        moves = [("alike", lambda k: frame({"translation": [1, 2, 3], "scale": [2] * 3}), 1),
                 ("mirrored", lambda k: frame({"scale": [-1, 1, 1]}), 1),
                 ("bent", lambda k: frame({"rotation": [0, 0, *angle]}) if k == 2 else IDENTITY, 2)]
        for name, move, skeletons in moves:
            with self.subTest(name):
                gltf = self.doll()
                j = gltf.json
                skin = dict(j["skins"][-1])
                binds = gltf.rows(skin["inverseBindMatrices"])
                skin["inverseBindMatrices"] = gltf.add(
                    [tuple(x for row in product(move(k), [bind[4 * i:4 * i + 4] for i in range(4)])
                           for x in row) for k, bind in enumerate(binds)], "MAT4")
                j["skins"].append(skin)
                body = j["nodes"][gltf.node('body "1"')]
                mesh = json.loads(json.dumps(j["meshes"][body["mesh"]]))
                j["meshes"].append(mesh)
                j["nodes"].append({"name": "other", "mesh": len(j["meshes"]) - 1,
                                   "skin": len(j["skins"]) - 1})
                j["scenes"][0]["nodes"].append(len(j["nodes"]) - 1)
                gltf.write(self.folder / "doll.glb")
                _, root, glb = self.rig("doll.glb", "--keep-rig")
                self.assertEqual(len(root.all("Skeleton")), skeletons)
                places = {prim.path: prim for prim in root.all()}
                for name, node in (("body__1_", 'body "1"'), ("other", "other")):
                    (found,) = [one for one in root.all("Mesh") if one.name == name]
                    skeleton = places[found.relations["skel:skeleton"][0]]
                    self.assert_near(deformed(found, skeleton), shown(glb, glb.node(node)))

    def write_box(self, name="box.obj"):
        """Quads in two materials, seams, a TGA beside it; closed."""
        lines = ["mtllib box.mtl"]
        corners = [(x, y, z) for x in (0, 1) for y in (0, 4) for z in (0, 1)]
        lines += [f"v {x} {y} {z}" for x, y, z in corners]
        lines += [f"vt {k / 5} {k / 7}" for k in range(5)]
        quads = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
        for k, quad in enumerate(quads):
            lines.append(f"usemtl m{k % 2}")
            lines.append("f " + " ".join(f"{v}/{(v + k) % 5 + 1}" for v in quad))
        (self.folder / name).write_text("\n".join(lines) + "\n")
        (self.folder / "box.mtl").write_text("newmtl m0\nmap_Kd skin.tga\nnewmtl m1\nKd 1 0 0\n")
        (self.folder / "skin.tga").write_bytes(
            bytes([0, 0, 2] + [0] * 9) + struct.pack("<HH", 1, 1) + bytes([24, 0, 1, 2, 3]))
        return corners, quads

    def test_polygons_and_vertices_are_those_of_the_file(self):
        corners, quads = self.write_box()
        _, root, _ = self.rig("box.obj")
        (mesh,) = root.all("Mesh")
        self.assert_near(mesh["points"], corners)
        self.assertEqual(mesh["faceVertexCounts"], [4] * 6)
        self.assertEqual(mesh["faceVertexIndices"], [v - 1 for quad in quads for v in quad])
        places = mesh["primvars:st:indices"]
        for k, quad in enumerate(quads):
            for c, v in enumerate(quad):
                number = (v + k) % 5
                self.assert_near([mesh["primvars:st"][int(places[4 * k + c])]],
                                 [(number / 5, number / 7)], 1e-6)
        subsets = [child["indices"] for child in mesh.children if child.kind == "GeomSubset"]
        self.assertEqual(subsets, [[0, 2, 4], [1, 3, 5]])
        self.assertTrue((self.folder / "out_textures/skin.png").read_bytes()
                        .startswith(b"\x89PNG"))

    def test_pictures_take_nobody_s_place(self):
        self.write_box()
        place = self.folder / "a_textures/skin.png"
        place.parent.mkdir()
        place.write_bytes(b"mine")
        self.refused(6, "rig", "box.obj", "-o", "a.usda", "-o", "b.glb", "-q",
                     says=["a_textures/skin.png"], cwd=self.folder)
        self.assertEqual(place.read_bytes(), b"mine")
        place.unlink()
        self.run_ok("rig", "box.obj", "-o", "a.usda", "-q", cwd=self.folder)
        old, when = place.read_bytes(), place.stat().st_mtime_ns
        self.run_ok("rig", "box.obj", "-o", "a.usda", "-q", cwd=self.folder)
        self.assertEqual((place.read_bytes(), place.stat().st_mtime_ns), (old, when))
        place.write_bytes(b"of the file that is written anew")
        self.run_ok("rig", "box.obj", "-o", "a.usda", "-q", cwd=self.folder)
        self.assertEqual(place.read_bytes(), old)
        self.assertEqual([path.name for path in place.parent.iterdir()], ["skin.png"])

    def test_the_same_run_writes_the_same_bytes(self):
        self.doll().write(self.folder / "doll.glb")
        for folder in ("one", "two"):
            (self.folder / folder).mkdir()
            self.run_ok("rig", "doll.glb", "-o", f"{folder}/a.usda", "-o", f"{folder}/a.usdz", "-q",
                        "--threads", "1" if folder == "one" else "2", cwd=self.folder)
        for name in ("a.usda", "a.usdz"):
            self.assertEqual(*((self.folder / folder / name).read_bytes()
                               for folder in ("one", "two")))

    def test_a_picture_of_another_kind_is_named_and_left_out(self):
        gltf = self.doll()
        gltf.json["images"][0] = {"bufferView": gltf.add_view(b"RIFF\0\0\0\0WEBPVP8 " + bytes(9)),
                                  "mimeType": "image/webp", "name": "painted"}
        gltf.json["images"][2] = {"bufferView": gltf.add_view(b"\xabKTX 20\xbb" + bytes(9)),
                                  "mimeType": "image/ktx2", "name": "packed"}
        gltf.write(self.folder / "doll.glb")
        result = self.run_ok("rig", "doll.glb", "-o", "a.glb", "-o", "a.usdz", cwd=self.folder)
        self.assertIn("painted", result.err)
        self.assertIn("packed", result.err)
        with zipfile.ZipFile(self.folder / "a.usdz") as packed:
            self.assertEqual(len(packed.namelist()), 2)
            _, root = self.whole(packed.read(packed.namelist()[0]).decode(),
                                 packed.namelist().__contains__)
        skin = root.all("Material")[0].children[0]
        self.assertEqual(skin["inputs:diffuseColor"], (1, .5, .25))

    def test_colours_of_vertices_show(self):
        corners = [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1), (.5, 4, .5)]
        faces = [(0, 1, 2, 3), (1, 0, 4), (2, 1, 4), (3, 2, 4), (0, 3, 4)]
        head = ["ply", "format ascii 1.0", f"element vertex {len(corners)}",
                *(f"property float {axis}" for axis in "xyz"),
                *(f"property uchar {name}" for name in ("red", "green", "blue")),
                f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
        rows = [" ".join(map(str, (*place, 255 * (k % 2), 0, 255))) for k, place in
                enumerate(corners)]
        rows += [" ".join(map(str, (len(face), *face))) for face in faces]
        (self.folder / "p.ply").write_text("\n".join(head + rows) + "\n")
        _, root, _ = self.rig("p.ply")
        (mesh,), (material,) = root.all("Mesh"), root.all("Material")
        self.assertEqual(mesh["faceVertexCounts"], list(map(len, faces)))
        self.assertEqual(mesh["primvars:displayColor"], [(k % 2, 0, 1) for k in range(5)])
        surface, reader = material.children
        self.assertEqual(surface.attributes["inputs:diffuseColor"].connection,
                         reader.path + ".outputs:result")
        self.assertEqual(reader["inputs:varname"], "displayColor")

    def test_the_surface_alone_is_whole(self):
        for options in ((Y, "--bare"), (Y,)):
            _, root, gltf = self.rig(*options)
            (mesh,), (skeleton,) = root.all("Mesh"), root.all("Skeleton")
            node = next(k for k, node in enumerate(gltf.json["nodes"]) if "mesh" in node)
            self.assert_near(deformed(mesh, skeleton), shown(gltf, node))
            self.assertFalse(root.all("Material"))

    @unittest.skipUnless(os.environ.get("CURVESKEL_COLLECTION"),
                         "needs the collection: name its folder in CURVESKEL_COLLECTION")
    def test_the_collection_s_characters_are_whole(self):
        folder = pathlib.Path(os.environ["CURVESKEL_COLLECTION"])
        files = [*folder.glob("characters/*.glb"), *folder.glob("clips/*.glb")]
        self.assertTrue(files)
        for source in files:
            for options in ((), ("--keep-rig",)):
                with self.subTest(source.name, options=options):
                    shutil.rmtree(self.folder / "out_textures", ignore_errors=True)
                    _, root, gltf = self.rig(source, *options)
                    j = gltf.json
                    self.assertEqual(len(root.all("Material")), len(j.get("materials", [])))
                    self.assertEqual(len(set(self.assets(root))), len(j.get("images", [])))
                    shows = [node for node in j["nodes"] if "mesh" in node]
                    self.assertEqual(len(root.all("Mesh")), len(shows))
                    moves = len(j.get("animations", [])) or bool(root.all("BlendShape"))
                    self.assertEqual(len(root.all("SkelAnimation")), moves)


if __name__ == "__main__":
    unittest.main()
