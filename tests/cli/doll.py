"""A character for tests: two materials with pictures of every use, shape keys, a hat on a joint, a
stand that moves, animations."""

import base64
import math
import struct
import zlib

from glb import KINDS, Gltf


def picture(shade):
    """A PNG of one pixel."""
    def chunk(name, data):
        return (struct.pack(">I", len(data)) + name + data
                + struct.pack(">I", zlib.crc32(name + data)))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(bytes([0, shade, shade, shade]))) + chunk(b"IEND", b""))


def doll(path):
    """A rigged file of one mesh with all that a character has; names are no identifiers, and
    alike."""
    gltf = Gltf(path)
    j = gltf.json
    body = next(k for k, node in enumerate(j["nodes"]) if "mesh" in node)
    (primitive,) = j["meshes"][j["nodes"][body]["mesh"]]["primitives"]
    points = gltf.rows(primitive["attributes"]["POSITION"])
    primitive["attributes"]["TEXCOORD_0"] = gltf.add(
        [(k % 7 / 7, k % 5 / 8) for k in range(len(points))], "VEC2")
    primitive["attributes"]["TEXCOORD_1"] = gltf.add(
        [(k % 3 / 4, k % 11 / 16) for k in range(len(points))], "VEC2")
    primitive["targets"] = [
        {"POSITION": gltf.add([row(k) for k in range(len(points))], "VEC3")}
        for row in (lambda k: (0, .25 * (k % 4 == 0), 0), lambda k: (-.5 * (k == 3), 0, 0))]
    indices = j["accessors"][primitive["indices"]]
    half = indices["count"] // 6 * 3
    second = dict(indices, count=indices["count"] - half,
                  byteOffset=indices.get("byteOffset", 0)
                  + half * struct.calcsize(KINDS[indices["componentType"]]))
    indices["count"] = half
    for one in (indices, second):
        one.pop("min", None), one.pop("max", None)
    j["accessors"].append(second)
    mesh = j["meshes"][j["nodes"][body]["mesh"]]
    mesh["primitives"].append(dict(primitive, indices=len(j["accessors"]) - 1, material=1))
    primitive["material"] = 0
    mesh.update(weights=[0.25, 0], extras={"targetNames": ["Lächeln", "1 blink"]})
    j["nodes"][body]["name"] = 'body "1"'
    add_looks(gltf)
    add_parts(gltf, primitive)
    return gltf


def add_looks(gltf):
    j = gltf.json
    j["images"] = [
        {"bufferView": gltf.add_view(picture(10)), "mimeType": "image/png", "name": "skin/a"},
        {"uri": "data:image/png;base64," + base64.b64encode(picture(20)).decode(),
         "name": "Skin a"},
        {"bufferView": gltf.add_view(picture(30)), "mimeType": "image/png", "name": "skin/a"}]
    j["samplers"] = [{"wrapS": 33071, "wrapT": 33648}]
    j["textures"] = [{"source": 0, "sampler": 0}, {"source": 1}, {"source": 2}]
    j["materials"] = [
        {"name": "skin", "doubleSided": True, "alphaMode": "MASK", "alphaCutoff": 0.25,
         "pbrMetallicRoughness": {
             "baseColorFactor": [1, 0.5, 0.25, 1],
             "baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform": {
                 "offset": [0.25, 0.5], "rotation": math.pi / 6, "scale": [2, 3]}}},
             "metallicRoughnessTexture": {"index": 1, "texCoord": 1},
             "metallicFactor": 0.5, "roughnessFactor": 0.75},
         "normalTexture": {"index": 2, "scale": 0.5},
         "occlusionTexture": {"index": 1, "strength": 0.75},
         "emissiveTexture": {"index": 2}, "emissiveFactor": [0.5, 0.5, 0.5]},
        {"name": "skin", "alphaMode": "BLEND",
         "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 0.5],
                                  "metallicFactor": 0.125, "roughnessFactor": 0.25}}]
    j["extensionsUsed"] = ["KHR_texture_transform"]


def add_parts(gltf, body):
    """A hat on a joint, a stand that moves, and animations of these, joints and shapes."""
    j = gltf.json
    part = {key: body[key] for key in ("attributes", "indices", "material")}
    part["attributes"] = {key: body["attributes"][key] for key in ("POSITION", "NORMAL")
                          if key in body["attributes"]}
    j["meshes"].append({"name": "hat", "primitives": [part]})
    number = len(j["meshes"]) - 1
    joint = j["skins"][-1]["joints"][1]
    hat, holder, stand = range(len(j["nodes"]), len(j["nodes"]) + 3)
    j["nodes"] += [
        {"name": "hat", "mesh": number, "translation": [0, 3, 0], "scale": [.25, .25, .25]},
        {"name": "1st holder", "children": [stand], "rotation": [0, math.sin(.5), 0,
                                                                 math.cos(.5)]},
        {"name": "stand", "mesh": number, "translation": [9, 0, 0]}]
    j["nodes"][joint].setdefault("children", []).append(hat)
    j["scenes"][0]["nodes"].append(holder)

    def channel(animation, node, path, times, rows, shape, between="LINEAR"):
        animation["samplers"].append({"input": gltf.add(times, "SCALAR"),
                                      "output": gltf.add(rows, shape),
                                      "interpolation": between})
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1,
                                      "target": {"node": node, "path": path}})

    walk, jump = ({"name": name, "samplers": [], "channels": []} for name in ("Walk 1", "jump"))
    body_node = gltf.node('body "1"')
    turns = [(0, 0, math.sin(a), math.cos(a)) for a in (0.1, 0.4, -0.9)]
    channel(walk, joint, "rotation", [0, 0.5, 1], turns, "VEC4")
    channel(walk, body_node, "weights", [0, 1], [0.5, 0, 0, 1], "SCALAR")
    channel(walk, stand, "translation", [0, 1], [(9, 0, 0), (9, 2, 0)], "VEC3")
    channel(jump, joint, "translation", [0, 2], [(0, 1, 0), (0, 3, 0)], "VEC3", "STEP")
    j["animations"] = [walk, jump]
