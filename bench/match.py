#!/usr/bin/python3
"""Branches that `curveskel.match` pairs right: usage: match.py COLLECTION [--by-vertices] [NAME...]

Each surface against itself rotated, noised, decimated and subdivided, and each character in
COLLECTION/characters against itself in the poses of its clips in COLLECTION/clips (linear blend
skinning by the artist's weights). Two branches are the same if each has most of the other's
vertices, and half of those that either has; of these pairs the share that is found is printed, and
the share that is after a rotation of the surface onto itself and said to be ambiguous.
Shapes alone are compared, unless `--by-vertices` is among the arguments.
Run it with `./run python bench/match.py ../shared/meshes`.
"""

import json
import pathlib
import struct
import sys
import time
import warnings

import numpy

import curveskel

warnings.simplefilter("ignore")
BY_SHAPE = "--by-vertices" not in sys.argv


class Glb:
    kinds = {5121: numpy.uint8, 5123: numpy.uint16, 5125: numpy.uint32, 5126: numpy.float32}
    widths = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}

    def __init__(self, path):
        data = path.read_bytes()
        length = struct.unpack("<I", data[12:16])[0]
        self.json = json.loads(data[20:20 + length])
        self.bytes = data[28 + length:]
        self.names = [node.get("name") for node in self.json["nodes"]]

    def array(self, number):
        accessor = self.json["accessors"][number]
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind = numpy.dtype(self.kinds[accessor["componentType"]])
        width = self.widths[accessor["type"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride", width * kind.itemsize)
        return numpy.ndarray((accessor["count"], width), kind, self.bytes, start,
                             (stride, kind.itemsize)).astype(float)

    def worlds(self, turns):
        """World matrices; `turns` has other rotations for some nodes."""
        worlds = {}

        def walk(number, above):
            worlds[number] = above @ self.local(number, turns.get(number))
            for child in self.json["nodes"][number].get("children", []):
                walk(child, worlds[number])

        for root in self.json["scenes"][self.json.get("scene", 0)]["nodes"]:
            walk(root, numpy.eye(4))
        return worlds

    def local(self, number, turn):
        node = self.json["nodes"][number]
        if "matrix" in node:
            return numpy.array(node["matrix"]).reshape(4, 4).T
        x, y, z, w = numpy.array(node.get("rotation", [0, 0, 0, 1]) if turn is None else turn)
        matrix = numpy.eye(4)
        matrix[:3, :3] = numpy.array(
            [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
             [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
             [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
        matrix[:3, :3] *= numpy.array(node.get("scale", [1, 1, 1]))
        matrix[:3, 3] = node.get("translation", [0, 0, 0])
        return matrix

    def posed(self, turns):
        """Vertices of all skinned primitives, and triangles."""
        worlds = self.worlds(turns)
        vertices, faces, count = [], [], 0
        for number, node in enumerate(self.json["nodes"]):
            if "mesh" not in node or "skin" not in node:
                continue
            skin = self.json["skins"][node["skin"]]
            inverse = self.array(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
            moves = numpy.array([worlds[joint] @ inverse[k]
                                 for k, joint in enumerate(skin["joints"])])
            for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
                attributes = primitive["attributes"]
                places = self.array(attributes["POSITION"])
                weights = self.array(attributes["WEIGHTS_0"])
                if weights.max() > 1.5:
                    weights /= weights.max()
                weights /= weights.sum(axis=1, keepdims=True)
                matrices = numpy.einsum("vk,vkij->vij", weights,
                                        moves[self.array(attributes["JOINTS_0"]).astype(int)])
                homogeneous = numpy.column_stack([places, numpy.ones(len(places))])
                vertices.append(numpy.einsum("vij,vj->vi", matrices, homogeneous)[:, :3])
                faces.append(self.array(primitive["indices"]).astype(int).reshape(-1, 3) + count)
                count += len(places)
        return numpy.concatenate(vertices), numpy.concatenate(faces)

    def turns_at(self, animation, share):
        """By name of node, its rotation at a share of the clip's length."""
        turns = {}
        for channel in animation["channels"]:
            if channel["target"]["path"] != "rotation":
                continue
            sampler = animation["samplers"][channel["sampler"]]
            values = self.array(sampler["output"])
            if sampler.get("interpolation") == "CUBICSPLINE":
                values = values[1::3]
            turn = values[min(len(values) - 1, int(share * len(values)))]
            turns[self.names[channel["target"]["node"]]] = turn / numpy.linalg.norm(turn)
        return turns


def symmetry(match, mesh_a, positions_b, to_b, turn):
    """Where the match sends each vertex of A, if that is a rotation of A onto itself, else None.

    `turn` takes A to B but for small changes; to_b: of each vertex of A that of B.
    """
    from scipy.spatial import cKDTree

    places, faces = mesh_a
    known = match.vertices >= 0
    size = numpy.linalg.norm(numpy.ptp(places, axis=0))
    back = positions_b[match.vertices[known]] @ turn
    here = places[known]
    keep = numpy.ones(len(here), bool)
    for _ in range(10):
        middles = here[keep].mean(axis=0), back[keep].mean(axis=0)
        u, _, v = numpy.linalg.svd((back[keep] - middles[1]).T @ (here[keep] - middles[0]))
        rotation = u @ numpy.diag([1, 1, numpy.linalg.det(u @ v)]) @ v
        off = numpy.linalg.norm((here - middles[0]) @ rotation.T + middles[1] - back, axis=1)
        keep = off <= numpy.quantile(off, 0.7)
    moved = (places - middles[0]) @ rotation.T + middles[1]
    distances, nearest = cKDTree(places).query(moved)
    edges = numpy.linalg.norm(numpy.diff(places[faces[:, :2]], axis=1), axis=2)
    if numpy.quantile(distances, 0.95) > 0.002 * size + numpy.median(edges):
        return None
    return to_b[nearest]


def in_both(match, labels_a, labels_b):
    """Branch of B by branch of A: each has most of the other's vertices, and half of all."""
    known = (labels_a >= 0) & (labels_b >= 0)
    shared = numpy.zeros((len(match.a.branch_nodes), len(match.b.branch_nodes)))
    numpy.add.at(shared, (labels_a[known], labels_b[known]), 1)
    of_a, of_b = shared.sum(axis=1), shared.sum(axis=0)
    same = {}
    for a in numpy.flatnonzero(of_a):
        b = int(shared[a].argmax())
        overlap = shared[a, b] / (of_a[a] + of_b[b] - shared[a, b])
        if shared[:, b].argmax() == a and overlap >= 0.5:
            same[int(a)] = b
    return same


class Score:
    """Counts of branches that are in both."""

    def __init__(self):
        self.there = self.right = self.symmetric = self.misled = 0

    def add(self, match, same, turned):
        """same, turned: truth, and truth after a turn of A onto itself."""
        partner = dict(zip(match.branches.a, match.branches.b))
        ambiguous = dict(zip(match.branches.a, match.branches.ambiguous))
        for a, b in same.items():
            right = partner.get(a) == b
            said = ambiguous.get(a, False)
            self.there += 1
            self.right += right
            self.symmetric += not right and said and a in partner and turned.get(a) == partner[a]
            self.misled += not right and not said
        return self

    def __iadd__(self, other):
        for name, value in vars(other).items():
            setattr(self, name, getattr(self, name) + value)
        return self

    def __str__(self):
        return (f"{self.right:4d} right, {self.symmetric:3d} turned by a symmetry and said to be "
                f"ambiguous, {self.misled:3d} wrong unsaid of {self.there:4d}")


def rotation(seed):
    turn, _ = numpy.linalg.qr(numpy.random.default_rng(seed).normal(size=(3, 3)))
    return turn * numpy.sign(numpy.linalg.det(turn))


def subdivided(vertices, faces):
    """One step of Loop's scheme of a closed surface; the old vertices come first."""
    edges = numpy.sort(numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), 1)
    unique, number = numpy.unique(edges, axis=0, return_inverse=True)
    number = number.reshape(3, -1).T + len(vertices)
    opposite = numpy.zeros((len(unique), 3))
    numpy.add.at(opposite, number.T.ravel() - len(vertices),
                 vertices[numpy.concatenate([faces[:, 2], faces[:, 0], faces[:, 1]])])
    middles = 0.375 * vertices[unique].sum(axis=1) + 0.125 * opposite
    sums, degree = numpy.zeros_like(vertices), numpy.zeros(len(vertices))
    for a, b in ((0, 1), (1, 0)):
        numpy.add.at(sums, unique[:, a], vertices[unique[:, b]])
        numpy.add.at(degree, unique[:, a], 1)
    degree = numpy.maximum(degree, 1)
    beta = (0.625 - (0.375 + 0.25 * numpy.cos(2 * numpy.pi / degree)) ** 2) / degree
    moved = (1 - degree * beta)[:, None] * vertices + beta[:, None] * sums
    a, b, c = faces.T
    ab, bc, ca = number.T
    triangles = numpy.concatenate([numpy.stack(corners, 1) for corners in
                                   ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))])
    return numpy.concatenate([moved, middles]), triangles


def decimated(vertices, faces, step):
    """Vertices merged in the cells of a grid, and what becomes of each."""
    size = numpy.linalg.norm(numpy.ptp(vertices, axis=0)) * step
    _, cell = numpy.unique(numpy.floor(vertices / size), axis=0, return_inverse=True)
    cell = cell.ravel()
    places = numpy.zeros((cell.max() + 1, 3))
    counts = numpy.bincount(cell)
    numpy.add.at(places, cell, vertices)
    merged = cell[faces]
    keep = (merged[:, 0] != merged[:, 1]) & (merged[:, 1] != merged[:, 2]) & (
        merged[:, 2] != merged[:, 0])
    return places / counts[:, None], merged[keep], cell


def changes(vertices, faces):
    """Name, rotation, surface, and of each old vertex that of the new surface."""
    same = numpy.arange(len(vertices))
    size = numpy.linalg.norm(numpy.ptp(vertices, axis=0))
    yield "rotated", rotation(1), (vertices @ rotation(1).T, faces), same
    noise = numpy.random.default_rng(2).normal(size=vertices.shape) * 0.001 * size
    yield "noised", rotation(3), (vertices @ rotation(3).T + noise, faces), same
    if len(vertices) < 60000:
        places, triangles = subdivided(vertices, faces)
        yield "subdivided", rotation(4), (places @ rotation(4).T, triangles), same
    places, triangles, cell = decimated(vertices, faces, 0.008)
    yield "decimated", rotation(5), (places @ rotation(5).T, triangles), cell


def report(name, change, a, surface, to_b, turn=None, mesh_a=None):
    """turn, mesh_a: None if the surface is posed."""
    score = Score()
    try:
        b = curveskel.extract(surface)
    except curveskel.Error as error:
        print(f"{name:24} {change:14} refused: {str(error)[:60]}")
        return score
    begin = time.time()
    match = curveskel.match(a, b, by_shape=BY_SHAPE)
    seconds = time.time() - begin
    labels_a, labels_b = a.vertex_labels(), b.vertex_labels()
    by_turn = None if turn is None else symmetry(match, mesh_a, surface[0], to_b, turn)
    score.add(match, in_both(match, labels_a, labels_b[to_b]),
              {} if by_turn is None else in_both(match, labels_a, labels_b[by_turn]))
    known = match.vertices >= 0
    far = numpy.linalg.norm(numpy.asarray(surface[0])[match.vertices[known]] -
                            numpy.asarray(surface[0])[to_b[known]], axis=1)
    size = numpy.linalg.norm(numpy.ptp(numpy.asarray(surface[0]), axis=0))
    print(f"{name:24} {change:14} {score}, {len(a.branch_nodes):4d} and {len(b.branch_nodes):4d} "
          f"branches, vertices {numpy.median(far) / size:.4f} D off, {seconds:.2f} s", flush=True)
    return score


def main():
    collection = pathlib.Path(sys.argv[1])
    names = [name for name in sys.argv[2:] if name != "--by-vertices"]
    totals = {}
    for path in sorted(collection.glob("*.*")):
        if path.suffix not in (".ply", ".obj", ".off") or "neuron" in path.name:
            continue
        if names and not any(name in path.name for name in names):
            continue
        a = curveskel.extract(path)
        vertices, faces = a.mesh
        a = curveskel.extract((vertices, faces))
        mesh = numpy.array(vertices), numpy.array(faces)
        for change, turn, surface, to_b in changes(*mesh):
            totals.setdefault(change, Score())
            totals[change] += report(path.stem, change, a, surface, to_b, turn, mesh)
    clips = {"bird": "bird-animations", "fox": "fox-animations", "human": "human-sample",
             "kaiju": "kaiju-animations"}
    for path in sorted((collection / "characters").glob("*.glb")):
        if names and not any(name in path.name for name in names):
            continue
        clip = clips.get(path.stem.split("-")[0])
        if clip is None:
            continue
        character = Glb(path)
        clip = Glb(collection / "clips" / f"{clip}.glb")
        rest = character.posed({})
        a = curveskel.extract(rest)
        for animation in clip.json["animations"]:
            for share in (0.3, 0.7):
                turns = {character.names.index(name): turn
                         for name, turn in clip.turns_at(animation, share).items()
                         if name in character.names}
                places, faces = character.posed(turns)
                for how, surface in (("posed", (places, faces)),
                                     ("posed, turned", (places @ rotation(7).T, faces))):
                    kind = f"{how} {path.stem}"
                    totals.setdefault(kind, Score())
                    totals[kind] += report(kind, f"{animation['name'][:10]} {share}", a, surface,
                                           numpy.arange(len(rest[0])))
    for change, score in list(totals.items()):
        kind = change.rsplit(" ", 1)[0] if change.startswith("posed") else "by themselves"
        totals.setdefault("all " + kind, Score())
        totals["all " + kind] += score
    for change, score in totals.items():
        share = 100 / max(1, score.there)
        print(f"{change:24} {score}: {share * score.right:.1f} % right, "
              f"{share * (score.right + score.symmetric):.1f} % with the symmetries")


if __name__ == "__main__":
    main()
