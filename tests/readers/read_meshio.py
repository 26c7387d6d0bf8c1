"""meshio reads the vertices of .obj; its PLY reader refuses edges, of .vtp it has none."""
import pathlib
import sys

from truth import expect, module, samples

meshio = module("meshio", "python3-meshio")

folder = pathlib.Path(sys.argv[1])
for name, truth in samples(folder):
    points = meshio.read(folder / f"{name}.obj").points
    expect([tuple(p) for p in points] == truth.points, f"{name}.obj: coordinates differ")
