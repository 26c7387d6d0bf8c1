#!/usr/bin/env python3
"""usage: rig_truth.py PROGRAM FOLDER [OPTION...]

How near the rigs of `curveskel rig` (with these options) are to those that people have made.

Each NAME.glb of FOLDER that has a rig: a new rig beside the old one, as `curveskel evaluate
--rig-truth` compares them (docs/numbers.md). Lengths in percent of the longest side of the box.

Each NAME.joints.json of FOLDER with a surface NAME.ply or NAME.obj beside it: joints alone.
Distances are over the diagonal of the surface's joints; of the people's joints only those inside the
surface count, and none of faces, toes and helpers. Then how well the life of a branch with a tip
tells whether people put a joint in it: the share of pairs, one with a joint and one without, in
which that with the joint has the longer life (AUC).
"""
import collections
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import time

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


def has_rig(glb):
    data = glb.read_bytes()
    (length,) = struct.unpack_from("<I", data, 12)
    return bool(json.loads(data[20:20 + length]).get("skins"))


def compared(program, character, options):
    """The comparison with the character's own rig, and the seconds that the rig took."""
    with tempfile.TemporaryDirectory() as place:
        rig = pathlib.Path(place) / "rig.glb"
        begin = time.monotonic()
        subprocess.run([program, "rig", character, "-o", rig, "-q", *options], check=True,
                       stderr=subprocess.DEVNULL)
        seconds = time.monotonic() - begin
        found = subprocess.run(
            [program, "evaluate", rig, "--rig-truth", character, "--json", "-", "-q"], check=True,
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return json.loads(found.stdout), seconds


def numbers_of(program, character, options):
    made, seconds = compared(program, character, options)
    nothing = math.nan
    return {
        "joints": made["joints"],
        "artist's": made["truth_joints"],
        "joints to joints": 100 * made["joints_to_joints"],
        "to bones": 100 * made["joints_to_bones"],
        "bones to bones": 100 * made["bones_to_bones"],
        "precision 5 %": made["by_size"]["precision"],
        "recall 5 %": made["by_size"]["recall"],
        "overlap, thickness": made["by_thickness"]["overlap"],
        "root": 100 * made["root_distance"],
        "poses": 100 * made["poses"].get("mean_distance", nothing),
        "shared": made["poses"].get("shared", nothing),
        "seconds": seconds,
    }


def print_rigs(program, characters, options):
    rows = {}
    for character in characters:
        rows[character.stem] = numbers_of(program, character, options)
    names = list(next(iter(rows.values())))
    print("| character | " + " | ".join(names) + " |")
    print("|" + "---|" * (len(names) + 1))
    rows["**mean**"] = {
        name: mean([row[name] for row in rows.values() if not math.isnan(row[name])] or [math.nan])
        for name in names}
    for stem, row in rows.items():
        cells = [f"{value}" if isinstance(value, int) else f"{value:.2f}" for value in row.values()]
        print(f"| {stem} | " + " | ".join(cells) + " |")


def surface_of(truth):
    """The surface beside NAME.joints.json, or None."""
    stem = truth.name.removesuffix(".joints.json")
    meshes = [truth.with_name(stem + end) for end in (".ply", ".obj")]
    return next((file for file in meshes if file.exists()), None)


def print_joints(program, truths, options):
    print("| surface | joints | people's | of theirs to ours / D | within 3 % | of ours to theirs |")
    print("|---|---|---|---|---|---|")
    for truth in truths:
        stem = truth.name.removesuffix(".joints.json")
        mesh = surface_of(truth)
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


def tip_branches(program, mesh, detail, joints):
    """(life, whether a joint lies in it) of each branch with a tip.

    A joint lies in the branch of its nearest node, but for the branch's inner end, if the node's
    ball half as large again holds it.
    """
    made = subprocess.run(
        [program, "extract", mesh, "-o", "-", "--format", "json", "--detail", str(detail), "-q"],
        check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    skeleton = json.loads(made.stdout)
    degree = collections.Counter(node for edge in skeleton["edges"] for node in edge)
    holds = set()
    for joint in joints:
        node = min(range(len(skeleton["nodes"])),
                   key=lambda k: math.dist(skeleton["nodes"][k], joint))
        if math.dist(skeleton["nodes"][node], joint) < 1.5 * skeleton["radii"][node]:
            holds.add(node)
    for branch in skeleton["branches"]:
        own = [node for node in branch["nodes"] if degree[node] < 3]
        if any(degree[node] == 1 for node in own) and branch["life"] is not None:
            yield branch["life"], not holds.isdisjoint(own)


def print_lives(program, surfaces):
    for detail in (0.5, 1):
        lives = {True: [], False: []}
        for mesh, joints in surfaces:
            for life, held in tip_branches(program, mesh, detail, joints):
                lives[held].append(life)
        pairs = [(a > b) + 0.5 * (a == b) for a in lives[True] for b in lives[False]]
        print(f"Lives at --detail {detail}: {len(lives[True])} branches with a tip hold a joint, "
              f"{len(lives[False])} do not, AUC {mean(pairs):.3f}" if pairs else "no pairs")


def main(program, folder, *options):
    folder = pathlib.Path(folder)
    characters = [file for file in sorted(folder.glob("*.glb")) if has_rig(file)]
    truths = sorted(folder.glob("*.joints.json"))
    if not characters and not truths:
        sys.exit(f"{folder}: neither a NAME.glb with a rig nor a NAME.joints.json")
    if characters:
        print_rigs(program, characters, options)
    if truths:
        print_joints(program, truths, options)
        surfaces = [(surface_of(truth), people_joints(truth)) for truth in truths]
        print_lives(program, [(mesh, joints) for mesh, joints in surfaces if mesh and joints])


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
