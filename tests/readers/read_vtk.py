"""VTK reads .vtp, .obj and .ply, and writes .vtp in all its ways for the program to read (foreign-*)."""
import pathlib
import sys

from truth import Graph, expect, expect_same, module, samples

vtk = module("vtkmodules.all", "python3-vtk9")


def graph_of(data):
    points = [data.GetPoint(p) for p in range(data.GetNumberOfPoints())]
    edges, ids = [], vtk.vtkIdList()
    lines = data.GetLines()
    lines.InitTraversal()
    while lines.GetNextCell(ids):
        chain = [ids.GetId(k) for k in range(ids.GetNumberOfIds())]
        edges += zip(chain, chain[1:])
    array = data.GetPointData().GetArray("radius")
    radii = array and [array.GetValue(k) for k in range(array.GetNumberOfTuples())]
    return Graph(points, edges, radii)


def read(reader, path):
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def write_variants(folder, name, data):
    modes = {"ascii": "SetDataModeToAscii", "binary": "SetDataModeToBinary",
             "appended": "SetDataModeToAppended"}
    for mode, set_mode in modes.items():
        for variant in ("plain", "zlib", "big-endian", "wide-header", "raw"):
            if variant == "raw" and mode != "appended":
                continue
            writer = vtk.vtkXMLPolyDataWriter()
            writer.SetFileName(str(folder / f"foreign-{name}-{mode}-{variant}.vtp"))
            writer.SetInputData(data)
            getattr(writer, set_mode)()
            writer.SetCompressorTypeToNone()
            if variant == "zlib":
                writer.SetCompressorTypeToZLib()
                writer.SetBlockSize(64)
            if variant == "big-endian":
                writer.SetByteOrderToBigEndian()
            if variant == "wide-header":
                writer.SetHeaderTypeToUInt64()
            if variant == "raw":
                writer.EncodeAppendedDataOff()
            expect(writer.Write() == 1, f"VTK could not write {writer.GetFileName()}")


def expect_close(name, found, truth):
    for p, q in zip(found.points, truth.points, strict=True):
        for a, b in zip(p, q):
            expect(abs(a - b) <= 1e-7 * abs(b), f"{name}: {p} is not {q}")


folder = pathlib.Path(sys.argv[1])
for name, truth in samples(folder):
    data = read(vtk.vtkXMLPolyDataReader(), folder / f"{name}.vtp")
    expect_same(f"{name}.vtp", graph_of(data), truth)
    isolated = len(truth.points) - len({i for edge in truth.edges for i in edge})
    expect(data.GetNumberOfVerts() == isolated, f"{name}.vtp: isolated nodes are no vertex cells")
    write_variants(folder, name, data)

    # These two keep single precision; the PLY reader passes over edges and radii.
    found = graph_of(read(vtk.vtkOBJReader(), folder / f"{name}.obj"))
    expect(found.edges == truth.edges, f"{name}.obj: edges differ")
    expect_close(f"{name}.obj", found, truth)
    expect_close(f"{name}.ply", graph_of(read(vtk.vtkPLYReader(), folder / f"{name}.ply")), truth)
