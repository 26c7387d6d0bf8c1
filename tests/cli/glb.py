"""GLB files as numbers: read, added to, and evaluated as a viewer shows them."""

import json
import struct

KINDS = {5121: "B", 5123: "H", 5125: "I", 5126: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
IDENTITY = [[float(i == j) for j in range(4)] for i in range(4)]


class Gltf:
    """A GLB file that can be added to."""

    def __init__(self, path):
        data = path.read_bytes()
        (length,) = struct.unpack_from("<I", data, 12)
        self.json, self.numbers = json.loads(data[20:20 + length]), data[28 + length:]

    def rows(self, number):
        accessor = self.json["accessors"][number]
        view = self.json["bufferViews"][accessor["bufferView"]]
        kind, width = KINDS[accessor["componentType"]], WIDTHS[accessor["type"]]
        size = struct.calcsize(kind) * width
        begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride", size)
        scale = {"B": 255, "H": 65535}.get(kind, 1) if accessor.get("normalized") else 1
        return [tuple(x / scale for x in
                      struct.unpack_from(f"<{width}{kind}", self.numbers, begin + k * stride))
                for k in range(accessor["count"])]

    def add_view(self, data):
        self.numbers += b"\0" * (-len(self.numbers) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.numbers),
                                         "byteLength": len(data)})
        self.numbers += data
        return len(self.json["bufferViews"]) - 1

    def add(self, rows, shape):
        flat = [x for row in rows for x in (row if isinstance(row, tuple) else (row,))]
        accessor = {"bufferView": self.add_view(struct.pack(f"<{len(flat)}f", *flat)),
                    "componentType": 5126, "type": shape, "count": len(flat) // WIDTHS[shape]}
        if shape in ("SCALAR", "VEC3"):
            columns = list(zip(*[iter(flat)] * WIDTHS[shape]))
            accessor["min"] = [min(column) for column in zip(*columns)]
            accessor["max"] = [max(column) for column in zip(*columns)]
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def write(self, path):
        self.numbers += b"\0" * (-len(self.numbers) % 4)
        self.json["buffers"][0]["byteLength"] = len(self.numbers)
        body = json.dumps(self.json).encode()
        body += b" " * (-len(body) % 4)
        path.write_bytes(b"glTF" + struct.pack("<III", 2, 28 + len(body) + len(self.numbers),
                                               len(body))
                         + b"JSON" + body + struct.pack("<I", len(self.numbers)) + b"BIN\0"
                         + self.numbers)

    def node(self, name):
        return next(k for k, node in enumerate(self.json["nodes"]) if node.get("name") == name)


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def inverse(matrix):
    """By Gauss and Jordan."""
    rows = [list(row) + [float(i == j) for j in range(4)] for i, row in enumerate(matrix)]
    for i in range(4):
        pivot = max(range(i, 4), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [x / rows[i][i] for x in rows[i]]
        for k in range(4):
            if k != i:
                rows[k] = [x - rows[k][i] * y for x, y in zip(rows[k], rows[i])]
    return [row[4:] for row in rows]


def moved(point, matrix):
    """A row of a point times a matrix."""
    return tuple(sum(x * matrix[i][j] for i, x in enumerate((*point, 1))) for j in range(3))


def frame(node):
    """Of a node in its parent, for rows."""
    if "matrix" in node:
        return [node["matrix"][4 * i:4 * i + 4] for i in range(4)]
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    turn = [[1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
            [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
            [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)]]
    scale = node.get("scale", (1, 1, 1))
    return [[*(s * t for t in row), 0] for s, row in zip(scale, turn)] + [
        [*node.get("translation", (0, 0, 0)), 1]]


def frames(gltf):
    """Of every node in the scene."""
    found = {}

    def place(number, above):
        found[number] = product(frame(gltf.json["nodes"][number]), above)
        for child in gltf.json["nodes"][number].get("children", []):
            place(child, found[number])
    for root in gltf.json["scenes"][0]["nodes"]:
        place(root, IDENTITY)
    return found


def shown(gltf, number):
    """The vertices of the first primitive of a node's mesh where the scene shows them."""
    node, world = gltf.json["nodes"][number], frames(gltf)
    attributes = gltf.json["meshes"][node["mesh"]]["primitives"][0]["attributes"]
    points = gltf.rows(attributes["POSITION"])
    if "skin" not in node:
        return [moved(point, world[number]) for point in points]
    skin = gltf.json["skins"][node["skin"]]
    binds = gltf.rows(skin["inverseBindMatrices"])
    moves = [product([bind[4 * i:4 * i + 4] for i in range(4)], world[joint])
             for bind, joint in zip(binds, skin["joints"])]
    result = []
    for point, joints, weights in zip(points, gltf.rows(attributes["JOINTS_0"]),
                                      gltf.rows(attributes["WEIGHTS_0"])):
        places = [(w, moved(point, moves[int(j)])) for j, w in zip(joints, weights) if w]
        result.append(tuple(sum(w * place[k] for w, place in places) for k in range(3)))
    return result
