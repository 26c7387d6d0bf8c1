#!/usr/bin/python3
"""Scores of anybody's skeletons of the surfaces of truth_set.

usage: score.py TRUTH SKELETONS [--csv FILE.csv]

SKELETONS is a folder with NAME.EXT for each NAME.off of TRUTH, EXT any of the formats that
curveskel reads (ply, obj, cgal, swc, vtp, json, graphml); run it by `./run python`. Printed is a row
for each family and version, and one for all; --csv writes a row for each surface. A surface without
a skeleton counts as wrong topology, nothing found, and is left out of the means of distances.
docs/truth.md defines the columns.
"""

import argparse
import csv
import pathlib
import sys

try:
    import numpy

    import curveskel
except ImportError as missing:
    print(f"usage: ./run python score.py TRUTH SKELETONS [--csv FILE.csv] (found {missing})",
          file=sys.stderr)
    sys.exit(2)

EXTENSIONS = ("ply", "obj", "cgal", "swc", "vtp", "json", "graphml")


def read_off(path):
    words = path.read_text().split()
    vertices, faces = int(words[1]), int(words[2])
    places = numpy.array(words[4:4 + 3 * vertices], dtype=float).reshape(-1, 3)
    corners = numpy.array(words[4 + 3 * vertices:4 + 3 * vertices + 4 * faces],
                          dtype=int).reshape(-1, 4)
    return places, corners[:, 1:]


def degrees(skeleton):
    return numpy.bincount(numpy.asarray(skeleton.edges).ravel(), minlength=len(skeleton.vertices))


def topology(skeleton):
    """Components and cycle rank."""
    parent = list(range(len(skeleton.vertices)))

    def root(node):
        while parent[node] != node:
            parent[node] = parent[parent[node]]
            node = parent[node]
        return node

    for a, b in skeleton.edges:
        parent[root(int(a))] = root(int(b))
    components = len({root(node) for node in range(len(parent))})
    return components, len(skeleton.edges) - len(parent) + components


def ends(skeleton):
    """Both ends of each edge; those of a node without edges, which has none, are the node twice."""
    nodes, edges = numpy.asarray(skeleton.vertices), numpy.asarray(skeleton.edges).reshape(-1, 2)
    alone = numpy.flatnonzero(numpy.bincount(edges.ravel(), minlength=len(nodes)) == 0)
    return nodes, numpy.vstack([edges, numpy.stack([alone, alone], axis=1)])


def samples(skeleton, radii, step):
    """Points with radii and weights: the nodes, of weight 0, and the middles of equal pieces of each
    edge, `step` long at most, of their lengths."""
    nodes, edges = ends(skeleton)
    places, sizes, weights = [nodes], [radii], [numpy.zeros(len(nodes))]
    for a, b in edges:
        length = numpy.linalg.norm(nodes[b] - nodes[a])
        pieces = max(1, int(numpy.ceil(length / step)))
        share = (numpy.arange(pieces) + 0.5) / pieces
        places.append((1 - share[:, None]) * nodes[a] + share[:, None] * nodes[b])
        sizes.append((1 - share) * radii[a] + share * radii[b])
        weights.append(numpy.full(pieces, length / pieces))
    return numpy.concatenate(places), numpy.concatenate(sizes), numpy.concatenate(weights)


def to_curve(points, skeleton, radii):
    """Distance of points to a curve's edges, and the radius at the nearest place."""
    nodes, edges = ends(skeleton)
    start, along = nodes[edges[:, 0]], nodes[edges[:, 1]] - nodes[edges[:, 0]]
    square = numpy.maximum((along ** 2).sum(axis=1), 1e-300)
    distance, radius = numpy.empty(len(points)), numpy.empty(len(points))
    for begin in range(0, len(points), 512):
        block = points[begin:begin + 512, None, :] - start[None, :, :]
        share = numpy.clip((block * along).sum(axis=2) / square, 0, 1)
        apart = ((block - share[:, :, None] * along) ** 2).sum(axis=2)
        edge = apart.argmin(axis=1)
        rows = numpy.arange(len(edge))
        share = share[rows, edge]
        distance[begin:begin + 512] = numpy.sqrt(apart[rows, edge])
        radius[begin:begin + 512] = ((1 - share) * radii[edges[edge, 0]] +
                                     share * radii[edges[edge, 1]])
    return distance, radius


def weighted_median(values, weights):
    order = numpy.argsort(values, kind="stable")
    sums = numpy.cumsum(weights[order])
    return values[order[numpy.searchsorted(sums, sums[-1] / 2)]]


def nearest(points, others):
    """Distance to the nearest of the others."""
    distance = numpy.empty(len(points))
    for begin in range(0, len(points), 512):
        block = ((points[begin:begin + 512, None, :] - others[None, :, :]) ** 2).sum(axis=2)
        distance[begin:begin + 512] = numpy.sqrt(block.min(axis=1))
    return distance


def found(truth, truth_radii, others):
    """Places of the truth with one of the others within their radius, each taken once."""
    if len(truth) == 0 or len(others) == 0:
        return 0
    distance = numpy.linalg.norm(truth[:, None, :] - others[None, :, :], axis=2)
    pairs = sorted((distance[i, k], i, k) for i in range(len(truth)) for k in range(len(others))
                   if distance[i, k] <= truth_radii[i])
    of_truth, of_others = set(), set()
    for _, i, k in pairs:
        if i not in of_truth and k not in of_others:
            of_truth.add(i)
            of_others.add(k)
    return len(of_truth)


def reconstruction(surface, places, radii, size):
    """Mean distance of the surface's vertices to the boundary of the union of balls, over `size`."""
    total = 0.0
    for begin in range(0, len(surface), 512):
        block = numpy.linalg.norm(surface[begin:begin + 512, None, :] - places[None, :, :], axis=2)
        total += numpy.abs((block - radii).min(axis=1)).sum()
    return total / len(surface) / size


def score(surface, truth, skeleton):
    size = numpy.linalg.norm(numpy.ptp(surface, axis=0))
    step = 0.002 * size
    row = {"topology": topology(truth) == topology(skeleton)}
    own_radii, true_radii = numpy.asarray(skeleton.radii), numpy.asarray(truth.radii)
    if len(own_radii) == 0:  # then the nearest vertex tells
        own_radii = nearest(numpy.asarray(skeleton.vertices), surface)
    ours, radii, weights = samples(skeleton, own_radii, step)
    theirs, _, their_weights = samples(truth, true_radii, step)
    there, needed = to_curve(ours, truth, true_radii)
    back, _ = to_curve(theirs, skeleton, own_radii)
    row["hausdorff"] = max(there.max(), back.max()) / size
    row["mean_distance"] = (numpy.average(there, weights=weights) +
                            numpy.average(back, weights=their_weights)) / 2 / size
    row["radius_error"] = weighted_median(numpy.abs(radii - needed) / needed, weights)
    for name, test in (("tips", lambda degree: degree == 1), ("junctions", lambda degree: degree > 2)):
        mine, true = test(degrees(skeleton)), test(degrees(truth))
        row[f"{name}_found"] = found(truth.vertices[true], numpy.asarray(truth.radii)[true],
                                     skeleton.vertices[mine])
        row[f"{name}_true"], row[f"{name}_ours"] = int(true.sum()), int(mine.sum())
    row["reconstruction"] = reconstruction(surface, ours, radii, size)
    return row


def length(skeleton):
    nodes, edges = ends(skeleton)
    return numpy.linalg.norm(nodes[edges[:, 1]] - nodes[edges[:, 0]], axis=1).sum()


def failed(truth):
    degree = degrees(truth)
    return {"topology": False, "hausdorff": numpy.nan, "mean_distance": numpy.nan,
            "radius_error": numpy.nan, "tips_found": 0, "tips_true": int((degree == 1).sum()),
            "tips_ours": 0, "junctions_found": 0, "junctions_true": int((degree > 2).sum()),
            "junctions_ours": 0, "reconstruction": numpy.nan}


def skeleton_in(folder, name):
    for extension in EXTENSIONS:
        path = folder / f"{name}.{extension}"
        if path.exists():
            return curveskel.read(path)
    return None


def shown(value, digits):
    return "-" if numpy.isnan(value) else f"{value:.{digits}f}"


def share(rows, count, of):
    total = sum(row[of] for row in rows)
    return shown(100 * sum(row[count] for row in rows) / total if total else numpy.nan, 1)


def table_row(title, rows):
    def mean(column, digits, factor=1):
        values = [row[column] for row in rows if not numpy.isnan(row[column])]
        return shown(factor * numpy.mean(values) if values else numpy.nan, digits)

    return (f"| {title} | {len(rows)} | {100 * sum(row['topology'] for row in rows) / len(rows):.1f} "
            f"| {share(rows, 'tips_found', 'tips_true')} / {share(rows, 'tips_found', 'tips_ours')} "
            f"| {share(rows, 'junctions_found', 'junctions_true')} "
            f"/ {share(rows, 'junctions_found', 'junctions_ours')} "
            f"| {mean('hausdorff', 4)} | {mean('mean_distance', 5)} "
            f"| {mean('radius_error', 1, 100)} | {mean('reconstruction', 4)} |")


def arguments_of(words):
    """TRUTH, SKELETONS and the table's file or None; exits with 2 where that is not what was given."""
    parser = argparse.ArgumentParser(prog="score.py", description="See docs/truth.md.")
    parser.add_argument("truth", metavar="TRUTH", type=pathlib.Path)
    parser.add_argument("skeletons", metavar="SKELETONS", type=pathlib.Path)
    parser.add_argument("--csv", metavar="FILE.csv")
    found = parser.parse_args(words)
    return found.truth, found.skeletons, found.csv


def main():
    truth_folder, skeletons, table = arguments_of(sys.argv[1:])
    with open(truth_folder / "INDEX.csv", newline="") as file:
        members = list(csv.DictReader(file))
    rows = []
    for member in members:
        name = member["name"]
        surface, _ = read_off(truth_folder / f"{name}.off")
        truth = curveskel.read(truth_folder / f"{name}.truth.ply")
        skeleton = skeleton_in(skeletons, name)
        empty = skeleton is None or length(skeleton) == 0
        rows.append({**member, **(failed(truth) if empty else score(surface, truth, skeleton))})
    print("| surfaces | number | topology right, % | tips: recall / precision, % "
          "| junctions: recall / precision, % | Hausdorff, D | mean distance, D | radius error, % "
          "| reconstruction, D |")
    print("|---|---|---|---|---|---|---|---|---|")
    for key in ("family", "version"):
        for value in dict.fromkeys(row[key] for row in rows):
            print(table_row(value, [row for row in rows if row[key] == value]))
    print(table_row("all", rows))
    if table:
        with open(table, "w", newline="") as file:
            writer = csv.DictWriter(file, rows[0].keys())
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
