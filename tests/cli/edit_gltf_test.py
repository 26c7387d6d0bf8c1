"""Rigs in the input's own glTF file: what a user's file keeps. The collection's characters are
there with CURVESKEL_COLLECTION."""

import json
import math
import os
import pathlib
import struct
import unittest

from program import MESHES, Y, CommandLineTest

# What an edit may change; everything else of the JSON stays as it is.
TOUCHED = {"nodes", "meshes", "scenes", "skins", "animations", "buffers", "accessors",
           "bufferViews", "asset"}


def chunks(path):
    """The JSON and the numbers of a GLB file."""
    data = path.read_bytes()
    assert data[:4] == b"glTF" and struct.unpack_from("<I", data, 8)[0] == len(data)
    (length,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20:20 + length]), data[28 + length:]


def write_glb(path, text, numbers):
    body = json.dumps(text).encode()
    body += b" " * (-len(body) % 4)
    path.write_bytes(b"glTF" + struct.pack("<III", 2, 28 + len(body) + len(numbers), len(body))
                     + b"JSON" + body + struct.pack("<I", len(numbers)) + b"BIN\0" + numbers)


def farthest(a, b):
    """The largest distance of a vertex of one OBJ file from that of the same number in another."""
    places = [[tuple(map(float, line.split()[1:4])) for line in path.read_text().splitlines()
               if line.startswith("v ")] for path in (a, b)]
    assert len(places[0]) == len(places[1])
    return max(map(math.dist, *places))


def characters():
    folder = os.environ.get("CURVESKEL_COLLECTION")
    return sorted((pathlib.Path(folder) / "characters").glob("*.glb")) if folder else []


def without_weights(meshes):
    return [{**mesh, "primitives": [
        {**primitive, "attributes": {name: accessor
                                     for name, accessor in primitive["attributes"].items()
                                     if not name.startswith(("JOINTS_", "WEIGHTS_"))}}
        for primitive in mesh["primitives"]]} for mesh in meshes]


class EditGltf(CommandLineTest):
    def check(self, source, *options):
        self.run_ok("rig", source, "-o", "out.glb", "-q", *options, cwd=self.folder)
        before, numbers = chunks(source)
        after, new_numbers = chunks(self.folder / "out.glb")
        length = before["buffers"][0]["byteLength"]
        self.assertEqual(new_numbers[:length], numbers[:length])
        for name in before.keys() - TOUCHED:
            self.assertEqual(before[name], after[name], name)
        for name in ("accessors", "bufferViews"):
            self.assertEqual(before[name], after[name][:len(before[name])])
        self.assertEqual(without_weights(before["meshes"]), without_weights(after["meshes"]))
        for mesh in after["meshes"]:
            for primitive in mesh["primitives"]:
                self.assertIn("WEIGHTS_0", primitive["attributes"])
                self.assertNotIn("WEIGHTS_1", primitive["attributes"])
        return before, after

    @unittest.skipUnless(characters(), "needs the collection's characters: "
                         "name its folder in CURVESKEL_COLLECTION")
    def test_keeps_all_of_a_character(self):
        for source in characters():
            with self.subTest(source.name):
                before, after = self.check(source)
                self.assertEqual(len(after["skins"]), 1)
                old = {before["nodes"][joint]["name"] for joint in before["skins"][0]["joints"]}
                made = {after["nodes"][joint]["name"] for joint in after["skins"][0]["joints"]}
                left = {node["name"] for node in after["nodes"]} - made
                self.assertFalse(left & old)
                # The armature that held the old joints holds the new ones, where it does not move.
                armature = next(node for node in before["nodes"] if node["name"] == "Armature")
                is_moved = not armature.keys().isdisjoint({"translation", "rotation", "scale",
                                                           "matrix"})
                holder = after["nodes"][after["skins"][0]["skeleton"]]
                self.assertEqual(holder["name"] == "Armature", not is_moved)
                self.assertEqual(len(after["nodes"]),
                                 len(before["nodes"]) + len(made) - len(old) + is_moved)

    @unittest.skipUnless(characters(), "needs the collection's characters: "
                         "name its folder in CURVESKEL_COLLECTION")
    def test_rigs_what_people_have(self):
        """Compressed files, too: their numbers are made plain."""
        folder = pathlib.Path(os.environ["CURVESKEL_COLLECTION"]) / "real"
        for source in sorted(folder.glob("*.glb")):
            with self.subTest(source.name):
                self.run_ok("rig", source, "-o", "real.glb", "-q", cwd=self.folder)
                before, after = chunks(source)[0], chunks(self.folder / "real.glb")[0]
                self.assertEqual(len(after["meshes"]), len(before["meshes"]))
                self.assertNotIn("KHR_draco_mesh_compression", after.get("extensionsUsed", []))
                for name in ("materials", "textures"):
                    self.assertEqual(before.get(name), after.get(name))

    @unittest.skipUnless(characters(), "needs the collection's characters: "
                         "name its folder in CURVESKEL_COLLECTION")
    def test_keeps_a_character_s_rig(self):
        source = characters()[0]
        before, after = self.check(source, "--keep-rig")
        for name in ("nodes", "skins", "scenes"):
            self.assertEqual(before[name], after[name])

    def test_edits_what_it_has_made(self):
        self.run_ok("rig", Y, "-o", "first.glb", cwd=self.folder)
        before, after = self.check(self.folder / "first.glb")
        self.assertEqual(len(before["nodes"]), len(after["nodes"]))  # the new rig is the old one
        before, after = self.check(self.folder / "first.glb", "--keep-rig")
        self.assertEqual(before["nodes"], after["nodes"])

    def test_writes_the_surface_alone_on_request(self):
        self.run_ok("rig", Y, "-o", "first.glb", cwd=self.folder)
        source = self.folder / "first.glb"
        text, numbers = chunks(source)
        text["extras"] = {"mine": 1}
        write_glb(source, text, numbers)
        self.run_ok("rig", source, "-o", "bare.glb", "--bare", cwd=self.folder)
        self.assertNotIn("extras", chunks(self.folder / "bare.glb")[0])
        self.check(source)
        self.assertEqual(chunks(self.folder / "out.glb")[0]["extras"], {"mine": 1})

    def test_a_rig_that_is_kept_says_how_far_it_moves_the_shape_at_rest(self):
        self.run_ok("rig", Y, "-o", "y.glb", cwd=self.folder)
        text, numbers = chunks(self.folder / "y.glb")
        result = self.run_ok("rig", "y.glb", "--keep-rig", "-o", "kept.glb", cwd=self.folder)
        self.assertNotIn("of the size", result.err)
        nodes = text["nodes"]
        joints = text["skins"][0]["joints"]
        middle = next(joint for joint in joints if nodes[joint].get("children")
                      and any(joint in nodes[other].get("children", []) for other in joints))
        x, y, z, w = nodes[middle].get("rotation", [0, 0, 0, 1])
        half = math.sqrt(0.5)  # a quarter of a turn about its x axis
        nodes[middle]["rotation"] = [half * (x + w), half * (y + z), half * (z - y), half * (w - x)]
        write_glb(self.folder / "bent.glb", text, numbers)
        result = self.run_ok("rig", "bent.glb", "--keep-rig", "-o", "kept.glb", cwd=self.folder)
        self.assertIn("% of the size; --joints", result.err)
        # The remedy.
        self.run_ok("rig", "bent.glb", "--joints", "bent.glb", "-o", "shown.glb", cwd=self.folder)
        for name in ("bent", "kept", "shown"):
            self.run_ok("fair", name + ".glb", "-o", name + ".obj", "--iterations", "0",
                        cwd=self.folder)
        self.assertLess(farthest(self.folder / "bent.obj", self.folder / "shown.obj"), 1e-5)
        self.assertGreater(farthest(self.folder / "bent.obj", self.folder / "kept.obj"), 1e-3)

    def test_keep_rig_needs_a_rig(self):
        self.refused(3, "rig", Y, "-o", "out.glb", "--keep-rig", cwd=self.folder,
                     says=["found no rig", "--keep-rig"])


if __name__ == "__main__":
    unittest.main()
