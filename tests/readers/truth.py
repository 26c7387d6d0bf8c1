"""What the sample skeletons are, and how a reader's result is compared with it: exactly."""
import pathlib
import sys


class Graph:
    """points: list of (x, y, z); radii: list of float, or None; edges: set of (i, j), i < j."""

    def __init__(self, points, edges, radii=None):
        self.points = [tuple(float(c) for c in p) for p in points]
        self.edges = {(min(i, j), max(i, j)) for i, j in edges}
        self.radii = None if radii is None else [float(r) for r in radii]

    def by_coordinates(self):
        """Nodes and edges without their numbers."""
        edges = {tuple(sorted((self.points[i], self.points[j]))) for i, j in self.edges}
        return sorted(self.points), edges


def read_truth(path):
    points, radii, edges = [], [], []
    for line in path.read_text().splitlines():
        kind, *values = line.split()
        if kind == "node":
            points.append([float.fromhex(v) for v in values[:3]])
            radii.append(None if values[3] == "none" else float.fromhex(values[3]))
        else:
            edges.append([int(v) for v in values])
    return Graph(points, edges, None if None in radii else radii)


def samples(folder):
    found = sorted(pathlib.Path(folder).glob("*.truth"))
    assert found, f"no samples in {folder}"
    return [(path.stem, read_truth(path)) for path in found]


def expect(same, message):
    if not same:
        sys.exit(f"FAILED: {message}")


def expect_same(name, found, truth, with_radii=True):
    expect(len(found.points) == len(truth.points),
           f"{name}: {len(found.points)} nodes, {len(truth.points)} written")
    expect(len(found.edges) == len(truth.edges),
           f"{name}: {len(found.edges)} edges, {len(truth.edges)} written")
    expect(found.points == truth.points, f"{name}: coordinates differ")
    expect(found.edges == truth.edges, f"{name}: edges differ")
    if with_radii:
        expect(found.radii == truth.radii, f"{name}: radii differ")


def module(name, package):
    """Imports it, or has ctest report the test as skipped."""
    import importlib
    try:
        return importlib.import_module(name)
    except ImportError as error:
        print(f"SKIPPED: {error}; apt install {package}")
        sys.exit(77)
