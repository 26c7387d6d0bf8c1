#!/usr/bin/env python3
"""usage: rig_truth.py PROGRAM FOLDER [OPTION...]

How near the joints of `curveskel rig` (with these options) are to those that people have placed: for
each NAME.joints.json of FOLDER with a surface NAME.ply or NAME.obj beside it. Distances are over the
diagonal of the surface's joints; of the people's joints only those inside the surface count, and
none of faces, toes and helpers.
"""
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile

ASIDE = ("toe", "tongue", "orbicularis", "oris", "levator", "risorius", "eye", "temporalis", "jaw",
         "special")
NEAR = 0.03


def joints_of(glb):
    """Where the joints of a rig are: what its inverse bind matrices, which turn and shift, take to
    the origin."""
    data = glb.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    file = json.loads(data[20:20 + length])
    binds = file["accessors"][file["skins"][0]["inverseBindMatrices"]]
    start = 28 + length + file["bufferViews"][binds["bufferView"]]["byteOffset"]
    places = []
    for joint in range(binds["count"]):
        matrix = struct.unpack_from("<16f", data, start + 64 * joint)  # by columns
        shift = matrix[12:15]
        places.append([-sum(matrix[4 * axis + k] * shift[k] for k in range(3))
                       for axis in range(3)])
    return places


def people_joints(file):
    joints = json.loads(file.read_text())["joints"]
    return [joint["position"] for joint in joints if joint.get("inside", True)
            and not any(word in joint["name"].lower() for word in ASIDE)]


def nearest(points, others, diagonal):
    return [min(math.dist(point, other) for other in others) / diagonal for point in points]


def mean(values):
    return sum(values) / len(values)


def main(program, folder, *options):
    print("| surface | joints | people's | of theirs to ours / D | within 3 % | of ours to theirs |")
    print("|---|---|---|---|---|---|")
    for truth in sorted(pathlib.Path(folder).glob("*.joints.json")):
        stem = truth.name.removesuffix(".joints.json")
        meshes = [truth.with_name(stem + end) for end in (".ply", ".obj")]
        mesh = next((file for file in meshes if file.exists()), None)
        theirs = people_joints(truth)
        if mesh is None or not theirs:
            print(f"{stem}: skipped, no surface or no joint inside it", file=sys.stderr)
            continue
        with tempfile.TemporaryDirectory() as place:
            rig = pathlib.Path(place) / "rig.glb"
            subprocess.run([program, "rig", mesh, "-o", rig, "-q", *options], check=True)
            ours = joints_of(rig)
        diagonal = math.dist(*([pick(point[axis] for point in ours) for axis in range(3)]
                               for pick in (min, max)))
        away = nearest(theirs, ours, diagonal)
        back = nearest(ours, theirs, diagonal)
        print(f"| {stem} | {len(ours)} | {len(theirs)} | {mean(away):.4f} "
              f"| {mean([a < NEAR for a in away]):.2f} | {mean(back):.4f} |")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
