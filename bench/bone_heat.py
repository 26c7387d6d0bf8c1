#!/usr/bin/env python3
"""usage: bone_heat.py PROGRAM FOLDER

New weights for the joints that artists have placed, by `curveskel rig --keep-rig` and by Blender's
"With Automatic Weights" (bone heat), beside the artists' own weights, as `curveskel evaluate
--rig-truth` compares them (docs/numbers.md): of each NAME.glb of FOLDER how far limbs that turn come
apart, in percent of the longest side, and the sums of absolute differences of weights. Vertices
to which Blender gives no weight go with the first joint, as glTF has it. Needs Blender and NumPy.
"""
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile

TYPES = {5121: "u1", 5123: "<u2", 5126: "<f4"}


def bone_heat(character, found):
    """In Blender: the weights of each mesh with an armature, as JSON."""
    import bpy
    import numpy
    # Debian's importer of glTF asks numpy for names that its numpy has no more.
    numpy.bool, numpy.int, numpy.float, numpy.object = bool, int, float, object
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=character)
    meshes = {}
    for mesh in [thing for thing in bpy.data.objects if thing.type == "MESH"]:
        armatures = [modifier for modifier in mesh.modifiers if modifier.type == "ARMATURE"]
        if not armatures:
            continue
        armature = armatures[0].object
        for modifier in armatures:
            mesh.modifiers.remove(modifier)
        mesh.vertex_groups.clear()
        bpy.ops.object.select_all(action="DESELECT")
        mesh.select_set(True)
        armature.select_set(True)
        bpy.context.view_layer.objects.active = armature
        bpy.ops.object.parent_set(type="ARMATURE_AUTO")
        names = [group.name for group in mesh.vertex_groups]
        meshes[mesh.name] = [[(names[group.group], group.weight) for group in vertex.groups]
                             for vertex in mesh.data.vertices]
    pathlib.Path(found).write_text(json.dumps(meshes))


class Weights:
    """JOINTS_0 and WEIGHTS_0 of a GLB file, to be written over."""

    def __init__(self, path):
        data = path.read_bytes()
        (length,) = struct.unpack_from("<I", data, 12)
        self.file = json.loads(data[20:20 + length])
        self.head = data[:28 + length]
        self.buffer = bytearray(data[28 + length:])

    def rows(self, accessor):
        import numpy
        accessor = self.file["accessors"][accessor]
        view = self.file["bufferViews"][accessor["bufferView"]]
        kind = numpy.dtype(TYPES[accessor["componentType"]])
        begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        return numpy.ndarray((accessor["count"], 4), kind, self.buffer, begin,
                             (view.get("byteStride", 4 * kind.itemsize), kind.itemsize))

    def replace(self, meshes):
        """Returns the number of vertices without a weight."""
        bare = 0
        for node in self.file["nodes"]:
            if "mesh" not in node or "skin" not in node:
                continue
            skin = self.file["skins"][node["skin"]]["joints"]
            number = {self.file["nodes"][joint].get("name"): k for k, joint in enumerate(skin)}
            vertices = iter(meshes[node["name"]])
            for primitive in self.file["meshes"][node["mesh"]]["primitives"]:
                joints = self.rows(primitive["attributes"]["JOINTS_0"])
                weights = self.rows(primitive["attributes"]["WEIGHTS_0"])
                joints[:] = 0
                weights[:] = 0
                for vertex in range(len(joints)):
                    largest = sorted(next(vertices), key=lambda pair: -pair[1])[:4]
                    total = sum(weight for _, weight in largest)
                    bare += total == 0
                    weights[vertex, 0] = total == 0
                    for k, (name, weight) in enumerate(largest if total > 0 else []):
                        joints[vertex, k] = number[name]
                        weights[vertex, k] = weight / total
        return bare

    def save(self, path):
        path.write_bytes(self.head + self.buffer)


def compared(program, rig, character):
    found = subprocess.run(
        [program, "evaluate", rig, "--rig-truth", character, "--json", "-", "-q"], check=True,
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    found = json.loads(found.stdout)
    # A file that rests in another pose than it was bound in is not compared.
    return (100 * found["poses"].get("mean_distance", math.nan),
            found["weights"].get("l1", math.nan))


def main(program, folder):
    print("| character | poses | weights | Blender: poses | weights | vertices without one |")
    print("|---|---|---|---|---|---|")
    rows = []
    for character in sorted(pathlib.Path(folder).glob("*.glb")):
        with tempfile.TemporaryDirectory() as place:
            rig, heat = pathlib.Path(place) / "rig.glb", pathlib.Path(place) / "heat.json"
            subprocess.run([program, "rig", character, "--keep-rig", "-o", rig, "-q"], check=True,
                           stderr=subprocess.DEVNULL)
            ours = compared(program, rig, character)
            subprocess.run(["blender", "--background", "--python", __file__, "--", character, heat],
                           check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            weights = Weights(rig)
            bare = weights.replace(json.loads(heat.read_text()))
            weights.save(rig)
            rows.append((*ours, *compared(program, rig, character), bare))
        print(f"| {character.stem} | " + " | ".join(
            f"{value}" if isinstance(value, int) else f"{value:.2f}" for value in rows[-1]) + " |")
    print("| **mean** | " + " | ".join(
        f"{sum(column) / len(rows):.2f}" for column in list(zip(*rows))[:4]) + " | |")


if __name__ == "__main__":
    if "--background" in sys.argv:
        bone_heat(*sys.argv[sys.argv.index("--") + 1:])
    elif len(sys.argv) != 3:
        sys.exit(__doc__)
    else:
        main(*sys.argv[1:])
