#!/usr/bin/python3
"""Scores of anybody's skeletons of the surfaces of truth_set.

usage: score.py TRUTH SKELETONS [--csv FILE.csv]

SKELETONS is a folder with NAME.EXT for each NAME.off of TRUTH, EXT any of the formats that
curveskel reads (ply, obj, cgal, swc, vtp, json, graphml); run it by `./run python`. Printed is a row
for each family and version, and one for all; --csv writes a row for each surface. A surface without
a skeleton counts as wrong topology, nothing found, and is left out of the means of distances.
docs/truth.md defines the columns.
"""

import csv
import pathlib
import sys

import numpy

import curveskel

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


def samples(skeleton, radii, step):
    """Points along the edges, with radii."""
    places, sizes = [numpy.asarray(skeleton.vertices)], [radii]
    for a, b in numpy.asarray(skeleton.edges):
        length = numpy.linalg.norm(skeleton.vertices[b] - skeleton.vertices[a])
        share = numpy.linspace(0, 1, max(2, int(numpy.ceil(length / step)) + 1))[1:-1]
        places.append((1 - share[:, None]) * skeleton.vertices[a] +
                      share[:, None] * skeleton.vertices[b])
        sizes.append((1 - share) * radii[a] + share * radii[b])
    return numpy.concatenate(places), numpy.concatenate(sizes)


def nearest(points, others):
    """Distance to, and number of, the nearest of the others."""
    distance, number = numpy.empty(len(points)), numpy.empty(len(points), dtype=int)
    for begin in range(0, len(points), 512):
        block = ((points[begin:begin + 512, None, :] - others[None, :, :]) ** 2).sum(axis=2)
        number[begin:begin + 512] = block.argmin(axis=1)
        distance[begin:begin + 512] = numpy.sqrt(block.min(axis=1))
    return distance, number


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
    nodes = numpy.asarray(skeleton.vertices)
    own_radii = numpy.asarray(skeleton.radii)
    if len(own_radii) == 0:  # then the nearest vertex tells
        own_radii, _ = nearest(nodes, surface)
    ours, radii = samples(skeleton, own_radii, step)
    theirs, true_radii = samples(truth, numpy.asarray(truth.radii), step)
    there, number = nearest(ours, theirs)
    back, _ = nearest(theirs, ours)
    row["hausdorff"] = max(there.max(), back.max()) / size
    row["mean_distance"] = (there.mean() + back.mean()) / 2 / size
    row["radius_error"] = numpy.median(numpy.abs(radii - true_radii[number]) / true_radii[number])
    for name, test in (("tips", lambda degree: degree == 1), ("junctions", lambda degree: degree > 2)):
        mine, true = test(degrees(skeleton)), test(degrees(truth))
        row[f"{name}_found"] = found(truth.vertices[true], numpy.asarray(truth.radii)[true],
                                     skeleton.vertices[mine])
        row[f"{name}_true"], row[f"{name}_ours"] = int(true.sum()), int(mine.sum())
    row["reconstruction"] = reconstruction(surface, ours, radii, size)
    return row


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


def share(rows, count, of):
    total = sum(row[of] for row in rows)
    return 100 * sum(row[count] for row in rows) / total if total else float("nan")


def table_row(title, rows):
    known = [row for row in rows if not numpy.isnan(row["hausdorff"])]

    def mean(column):
        values = [row[column] for row in known if not numpy.isnan(row[column])]
        return numpy.mean(values) if values else float("nan")

    return (f"| {title} | {len(rows)} | {100 * sum(row['topology'] for row in rows) / len(rows):.1f} "
            f"| {share(rows, 'tips_found', 'tips_true'):.1f} "
            f"/ {share(rows, 'tips_found', 'tips_ours'):.1f} "
            f"| {share(rows, 'junctions_found', 'junctions_true'):.1f} "
            f"/ {share(rows, 'junctions_found', 'junctions_ours'):.1f} "
            f"| {mean('hausdorff'):.4f} | {mean('mean_distance'):.4f} "
            f"| {100 * mean('radius_error'):.1f} | {mean('reconstruction'):.4f} |")


def main():
    arguments = sys.argv[1:]
    table = None
    if "--csv" in arguments:
        at = arguments.index("--csv")
        table = arguments[at + 1]
        del arguments[at:at + 2]
    truth_folder, skeletons = map(pathlib.Path, arguments)
    with open(truth_folder / "INDEX.csv", newline="") as file:
        members = list(csv.DictReader(file))
    rows = []
    for member in members:
        name = member["name"]
        surface, _ = read_off(truth_folder / f"{name}.off")
        truth = curveskel.read(truth_folder / f"{name}.truth.ply")
        skeleton = skeleton_in(skeletons, name)
        empty = skeleton is None or len(skeleton.edges) == 0
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
