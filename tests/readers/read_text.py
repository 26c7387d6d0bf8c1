"""Plain readers, straight from the formats' descriptions: SWC, CSV, CGAL polylines, PLY, OBJ; the
pictures through an XML parser and zlib."""
import base64
import collections
import csv
import math
import pathlib
import struct
import sys
import xml.etree.ElementTree
import zlib

from truth import Graph, expect, expect_same, samples


def check_swc(path, truth):
    lines = path.read_text().splitlines()
    rows = [line.split() for line in lines if line and not line.startswith("#")]
    cuts = [[int(v) for v in line.split()[2:]] for line in lines if line.startswith("# cut ")]
    no_radius = [int(v) for line in lines if line.startswith("# no radius") for v in line.split()[3:]]
    points, radii, edges, seen = [], [], [], set()
    for row in rows:
        expect(len(row) == 7, f"{path.name}: {len(row)} columns")
        sample, kind, parent = int(row[0]), int(row[1]), int(row[6])
        radius = float(row[5])
        expect(sample == len(points) + 1, f"{path.name}: ids do not count from 1")
        expect(kind >= 0, f"{path.name}: type {kind}")
        expect(radius > 0, f"{path.name}: radius {radius} of {sample}")
        expect(parent == -1 or parent in seen, f"{path.name}: {sample} before its parent {parent}")
        seen.add(sample)
        points.append([float(v) for v in row[2:5]])
        radii.append(0.0 if sample in no_radius else radius)
        if parent != -1:
            edges.append((parent - 1, sample - 1))
    whole = Graph(points, edges + [(a - 1, b - 1) for a, b in cuts])
    expect(len(whole.edges) == len(edges) + len(cuts), f"{path.name}: a cut repeats an edge")
    expect(whole.by_coordinates() == truth.by_coordinates(), f"{path.name}: graph differs")
    if truth.radii is not None:
        of_point = dict(zip(truth.points, truth.radii))
        for point, radius in zip(whole.points, radii):
            expect(of_point[point] == radius, f"{path.name}: radius at {point}")


def check_csv(path, truth):
    degree = collections.Counter(i for edge in truth.edges for i in edge)
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    nodes_inside, length = 0, 0.0
    for k, row in enumerate(rows):
        expect(int(row["branch"]) == k, f"{path.name}: branch {row['branch']}")
        start, end = int(row["start"]), int(row["end"])
        for node, side in ((start, "start"), (end, "end")):
            found = tuple(float(row[f"{side}_{c}"]) for c in "xyz")
            expect(found == truth.points[node], f"{path.name}: {side} of branch {k}")
            expect(degree[node] != 2 or start == end, f"{path.name}: branch {k} ends at degree 2")
        nodes_inside += int(row["nodes"]) - 1
        length += float(row["length"])
        if truth.radii is None:
            expect(row["mean_radius"] == "", f"{path.name}: a mean of no radii")
        else:
            expect(min(truth.radii) <= float(row["mean_radius"]) * (1 + 1e-12)
                   <= max(truth.radii) * (1 + 1e-9), f"{path.name}: mean radius of branch {k}")
    expect(nodes_inside == len(truth.edges), f"{path.name}: {nodes_inside} edges in all branches")
    expected = math.fsum(math.dist(truth.points[i], truth.points[j]) for i, j in truth.edges)
    expect(math.isclose(length, expected, rel_tol=1e-12), f"{path.name}: length {length}")


def check_polylines(path, truth):
    number, edges = {}, []
    for line in path.read_text().splitlines():
        count, *values = line.split()
        values = [float(v) for v in values]
        expect(len(values) == 3 * int(count), f"{path.name}: {len(values)} numbers, {count} points")
        chain = [number.setdefault(tuple(values[k:k + 3]), len(number))
                 for k in range(0, len(values), 3)]
        edges += zip(chain, chain[1:])
    expect(Graph(number, edges).by_coordinates() == truth.by_coordinates(),
           f"{path.name}: graph differs")


def read_ply(path):
    header, body = path.read_text().split("end_header\n")
    counts = [line.split() for line in header.splitlines() if line.startswith("element")]
    vertices, edges = int(counts[0][2]), int(counts[1][2])
    rows = [[float(v) for v in line.split()] for line in body.splitlines()]
    expect(len(rows) == vertices + edges, f"{path.name}: {len(rows)} rows")
    has_radii = "property double radius" in header
    return Graph([row[:3] for row in rows[:vertices]],
                 [(int(row[0]), int(row[1])) for row in rows[vertices:]],
                 [row[3] for row in rows[:vertices]] if has_radii else None)


def read_obj(path):
    rows = [line.split() for line in path.read_text().splitlines()]
    lines = [row for row in rows if row[0] == "l"]
    expect(all(len(row) == 3 for row in lines), f"{path.name}: a line of more than two vertices")
    return Graph([[float(v) for v in row[1:]] for row in rows if row[0] == "v"],
                 [(int(row[1]) - 1, int(row[2]) - 1) for row in lines])


def check_png(name, data):
    expect(data[:8] == b"\x89PNG\r\n\x1a\n", f"{name}: signature")
    at, pixels, size = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        crc, = struct.unpack(">I", data[at + 8 + length:at + 12 + length])
        expect(crc == zlib.crc32(kind + body), f"{name}: checksum of {kind}")
        if kind == b"IHDR":
            size = struct.unpack(">II", body[:8])
        if kind == b"IDAT":
            pixels += body
        at += 12 + length
    expect(size == (1600, 1200), f"{name}: {size} pixels")
    expect(len(zlib.decompress(pixels)) == 1200 * (1 + 3 * 1600), f"{name}: rows")


def check_svg(path, edges):
    root = xml.etree.ElementTree.parse(path).getroot()
    space = "{http://www.w3.org/2000/svg}"
    expect(root.tag == space + "svg", f"{path.name}: {root.tag}")
    image = root.find(space + "image").get("{http://www.w3.org/1999/xlink}href")
    check_png(path.name, base64.b64decode(image.removeprefix("data:image/png;base64,")))
    lines = len(list(root.iter(space + "line")))
    expect(lines >= 2 * edges, f"{path.name}: {lines} lines for {edges} edges in two views")


folder = pathlib.Path(sys.argv[1])
for name, truth in samples(folder):
    check_swc(folder / f"{name}.swc", truth)
    check_csv(folder / f"{name}.csv", truth)
    check_polylines(folder / f"{name}.cgal", truth)
    expect_same(f"{name}.ply", read_ply(folder / f"{name}.ply"), truth)
    expect_same(f"{name}.obj", read_obj(folder / f"{name}.obj"), truth, with_radii=False)
check_png("tripod.png", (folder / "tripod.png").read_bytes())
check_svg(folder / "tripod.svg", 4)
