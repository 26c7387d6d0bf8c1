"""Skeletons as arrays and tables."""

import pathlib
import warnings

import numpy

from . import _core, graphs
from .errors import CertificateWarning, SolverError, UsageError
from .inputs import MOST_THREADS, counted, flag, index, listening, path_of, soup_of, warn_of
from .surfaces import faces_of


class _Kept:
    """What goes through pickle of an extraction: arrays, numbers and tables."""

    def __init__(self, extraction):
        for name in ("positions", "triangles", "given_positions", "given_polygons",
                     "vertex_of_input", "certificate", "holds", "shortcomings", "changes", "surface",
                     "level"):
            value = getattr(extraction, name)
            setattr(self, name, numpy.array(value) if isinstance(value, numpy.ndarray) else value)
        self._table = extraction.branch_table(-1)
        self._labels = extraction.labels()

    def __setstate__(self, state):
        self.__dict__.update(state)
        for value in state.values():
            if isinstance(value, numpy.ndarray):
                value.flags.writeable = False

    def branch_table(self, root):
        if root != -1:
            raise UsageError("orders from another root are of the surface, which a skeleton that was "
                             "pickled has not; make the table before, or extract it again")
        return self._table

    def labels(self):
        return self._labels


class Skeleton:
    """A curve skeleton: a graph of nodes with radii. Its arrays are views, and read-only.

    `extract` and `read` make it. That of a file has no surface and no certificate: `mesh`,
    `certificate` and `ok` are None.
    """

    def __init__(self, graph, extraction=None):
        self._graph = graph
        self._extraction = extraction
        self._found = {}  # what takes long, once it was asked for

    @property
    def vertices(self):
        """(n, 3) float64: places of the nodes, in the units of the surface."""
        return self._graph.nodes

    @property
    def edges(self):
        """(m, 2) int32: nodes of each edge, the lower one first; loops are kept."""
        return self._graph.edges

    @property
    def radii(self):
        """(n,) float64: distance of each node to the surface, 0 of a node outside; or (0,)."""
        return self._graph.radii

    @property
    def lives(self):
        """(n,) float64: of a tip how clearly the surface has it, without unit; or (0,)."""
        return self._graph.lives

    @property
    def mesh_map(self):
        """(v,) int32: the node that each vertex given belongs to; -1 for those left out."""
        return self._graph.node_of_vertex

    @property
    def skel_map(self):
        """A list of n int64 arrays: the vertices given that belong to each node, ascending."""
        order = numpy.argsort(self.mesh_map, kind="stable")
        bounds = numpy.searchsorted(self.mesh_map[order], numpy.arange(len(self.vertices) + 1))
        return [order[begin:end] for begin, end in zip(bounds[:-1], bounds[1:])]

    @property
    def mesh(self):
        """Vertices (v, 3) and faces (f, 3) of the surface after repair; None of a file."""
        if self._extraction is None:
            return None
        return self._extraction.positions, self._extraction.triangles

    @property
    def given(self):
        """Vertices (v, 3) and faces of the surface as it was given; None of a file.

        `mesh_map`, `vertex_labels` and `face_labels` are of these. Faces are an array (f, k), or a
        list of arrays where their numbers of corners differ.
        """
        if self._extraction is None:
            return None
        return self._extraction.given_positions, faces_of(self._extraction.given_polygons)

    @property
    def vertex_map(self):
        """(v,) int32: the vertex of `mesh` that each vertex given is, or was merged with; -1 = none."""
        return None if self._extraction is None else self._extraction.vertex_of_input

    @property
    def surface(self):
        """A dict of the surface after repair, None of a file.

        vertices, triangles, components, genus; diagonal of the bounding box, area and volume in the
        units given, their squares and cubes. Lengths of the certificate are over the diagonal.
        """
        return None if self._extraction is None else self._extraction.surface

    @property
    def level(self):
        """A dict, see `levels`: number (1 = the finest), of, least_life of the branches.

        None of a file.
        """
        return None if self._extraction is None else self._extraction.level

    def levels(self, most, *, time_limit=0, progress=None):
        """A list of Skeletons, the finest first, as `curveskel extract --levels` writes them.

        most: so many levels, 1 to 100; fewer where the lives of the branches tell fewer apart. Each
            is part of the one before; limits are the widest gaps between the lives.
        time_limit, progress: as of `extract`.

        Each has its own certificate, and nodes and branches their own numbers. Those of a skeleton
        that was pickled have neither certificate nor surface, as those of a file.
        """
        count = index(most, "most", 1, 100)
        with listening(progress, time_limit) as listener:
            if self._extraction is None or isinstance(self._extraction, _Kept):
                return [Skeleton(graph) for graph in self._graph.levels(count)]
            return [Skeleton(level.skeleton, level)
                    for level in self._extraction.levels(count, listener)]

    @property
    def certificate(self):
        """A dict of the numbers that docs/method.md defines; None of a file."""
        return None if self._extraction is None else self._extraction.certificate

    @property
    def ok(self):
        """True if the certificate holds: topology, inside, tips at the ends, a shape made of tubes."""
        return None if self._extraction is None else self._extraction.holds

    @property
    def shortcomings(self):
        """All that keeps the certificate from holding, in one line; empty if it holds."""
        return "" if self._extraction is None else self._extraction.shortcomings

    @property
    def changes(self):
        """What repair has changed, a line each."""
        return [] if self._extraction is None else self._extraction.changes

    @property
    def branch_nodes(self):
        """A list of int arrays: the nodes of each branch, ends included, as `branches` has them."""
        return [numpy.array(nodes, dtype=numpy.int32) for nodes in self._graph.branches()]

    @property
    def branches(self):
        """DataFrame, one row a branch, the columns of `curveskel extract -o OUT.csv`.

        Its first, `branch`, is the index. docs/numbers.md defines each. Lengths and radii are in
        the units of the surface.
        """
        return self.branch_table()

    def branch_table(self, root=None):
        """`branches`, with orders counted from the node `root` in its component.

        Without one they are counted from the thickest node of each component. Each call gives a
        table of its own. Raises UsageError for a root that is no node.
        """
        import pandas

        number = -1 if root is None else index(root, "root", 0, len(self.vertices) - 1)
        if ("branches", number) not in self._found:
            source = self._graph if self._extraction is None else self._extraction
            table = pandas.DataFrame(source.branch_table(number))
            self._found["branches", number] = table.astype(
                {"parent": "Int64", "strahler_order": "Int64"}).rename_axis("branch")
        return self._found["branches", number].copy()

    @property
    def junctions(self):
        """DataFrame, one row a node of three or more branches: degree, branches, angles, planarity.

        The node is the index. `angles` are degrees between the branches of each pair, in the order of
        itertools.combinations(row.branches, 2). docs/numbers.md defines each column.
        """
        import pandas

        return pandas.DataFrame(self._graph.junction_table()).set_index("node")

    def profiles(self, spacing=None, *, threads=0, time_limit=0, progress=None):
        """DataFrame of sections along each branch: place, tangent, area, perimeter, and more.

        spacing: of the sections along the branch, or the next smaller that divides it, in the
            units of the surface; None = a section at each node, as `curveskel extract --profiles`.
        threads, time_limit, progress: as of `extract`.

        docs/numbers.md defines each column. Raises UsageError of a skeleton without a surface.
        """
        import pandas

        self._need_surface("sections")
        try:
            step = 0.0 if spacing is None else float(spacing)
        except (TypeError, ValueError) as error:
            raise UsageError(f"spacing: needs a number or None, not {spacing!r}") from error
        count = index(threads, "threads", 0, MOST_THREADS)
        with listening(progress, time_limit) as listener:
            return pandas.DataFrame(self._extraction.profiles(step, count, listener))

    def vertex_labels(self):
        """(v,) int32, read-only: the branch of each vertex given; -1 = of none."""
        return self._labels()[0]

    def face_labels(self):
        """(f,) int32, read-only: the branch of each face given; -1 = of none."""
        return self._labels()[1]

    def _labels(self):
        self._need_surface("labels")
        if "labels" not in self._found:
            labels = self._extraction.labels()
            for values in labels:
                values.flags.writeable = False
            self._found["labels"] = labels
        return self._found["labels"]

    def save_labelled(self, path):
        """Writes the surface given with its branches as labels and colours: PLY, VTP or GLB."""
        self._need_surface("labelled surfaces")
        path = pathlib.Path(path_of(path, "path"))
        self._extraction.save_labelled(path, path.suffix.lower().lstrip("."))

    def save_html(self, path):
        """Writes the page of `curveskel extract --html`: the shape to turn, tables, plots."""
        self._need_surface("pages")
        self._extraction.save_page(_named(path, ".html", "a page"))

    def __copy__(self):
        return self  # as nothing of it changes

    def __deepcopy__(self, memo):
        return self

    def __reduce__(self):
        kept = self._extraction
        if kept is not None and not isinstance(kept, _Kept):
            kept = _Kept(kept)
        return Skeleton, (self._graph, kept)

    def _need_surface(self, things):
        if isinstance(self._extraction, _Kept) and things != "labels":
            raise UsageError(f"{things} are of the surface, which a skeleton that was pickled has "
                             "not; make them before, or extract it again")
        if self._extraction is None:
            raise UsageError(f"{things} are of the surface, which a skeleton from a file has not; "
                             "extract it, or use evaluate")

    def to_networkx(self):
        """networkx.Graph: x, y, z, radius, life of nodes; length, branch, life, parent, merge of edges.

        These are numbers, in the units of the surface, of edges those of their branch; what a branch
        has not is left out, a life that never ends is infinity. networkx can write it as GraphML,
        `read` reads that again, and `evaluate` takes the graph itself.
        """
        return graphs.to_networkx(self)

    def to_trimesh(self):
        """trimesh.path.Path3D, one polyline a branch."""
        return graphs.to_trimesh(self)

    def to_pyvista(self):
        """pyvista.PolyData, one polyline a branch, with `radius` and `life` of points."""
        return graphs.to_pyvista(self)

    def to_swc(self, path):
        """Writes an SWC file; loops are cut, and the cuts are comments in it."""
        self._save(_named(path, ".swc", "SWC"), "swc")

    def save(self, path):
        """Writes a file in the format of its extension, any of the program's.

        As with the program, `labelled.ply` and `NAME.labelled.ply` are the surface with its branches,
        see `save_labelled`. Of a skeleton that was extracted from a file, the bytes are those that
        the program writes. Raises UsageError or OutputError.
        """
        path = pathlib.Path(path_of(path, "path"))
        stem = pathlib.PurePath(path.stem)
        if str(stem) == "labelled" or stem.suffix == ".labelled":
            self.save_labelled(path)
        else:
            self._save(path, path.suffix.lower().lstrip("."))

    def _save(self, path, format):
        if hasattr(self._extraction, "save"):
            self._extraction.save(path, format)
        else:
            _core.save_skeleton(self._graph, path, format)

    def __repr__(self):
        counts = (f"{counted(len(self.vertices), 'node')}, {counted(len(self.edges), 'edge')}, "
                  f"{counted(len(self.branch_nodes), 'branch', 'branches')}")
        if self._extraction is None:
            return f"<curveskel.Skeleton: {counts}>"
        return f"<curveskel.Skeleton: {counts}; {self.shortcomings or 'certificate holds'}>"

    def _repr_html_(self):
        """The skeleton inside its surface, as SVG, and what `repr` says."""
        import html

        words = f"<p>{html.escape(repr(self)[1:-1])}</p>"
        if not hasattr(self._extraction, "picture"):
            return words
        picture = self._extraction.picture()
        return f"<div style='max-width:480px'>{picture[picture.index('<svg'):]}{words}</div>"


def _named(path, extension, content):
    """The path; raises UsageError where it ends otherwise, as a slip would overwrite another file."""
    path = pathlib.Path(path_of(path, "path"))
    if path.suffix.lower() == extension:
        return path
    raise UsageError(f"{path}: {content} is written here, needed a name that ends in {extension}")


def extracted(mesh, listener, options):
    """The Skeleton of `extract`, whatever its certificate says."""
    extraction = _core.extract(soup_of(mesh, listener), options, listener)
    return Skeleton(extraction.skeleton, extraction)


def warn_or_fail(skeleton, strict, stacklevel):
    """Says what the program warns of, and how the certificate fails, if it does."""
    warn_of(skeleton._extraction.findings, stacklevel + 1)
    if skeleton.ok:
        return
    message = "the certificate failed: " + skeleton.shortcomings
    if strict:
        raise SolverError(message)
    warnings.warn(message, CertificateWarning, stacklevel=stacklevel + 1)


def extract(mesh, *, detail=0.5, threads=0, time_limit=0, progress=None, strict=False, **options):
    """The curve skeleton of a surface, as `curveskel extract` makes it.

    mesh: a path to a surface file; a pair of arrays, vertices (n, 3) and faces (m, 3), or (m, k)
        for polygons, or a list of faces of several sizes; or an object with `vertices` and `faces`,
        as trimesh's. Faces of vertices with NaN or infinity are dropped, as from a file.
    detail: 0 to 1, how small a branch may be: below .5 the clearer ones of the skeleton, above it
        more beside them.
    threads: at most; 0 = one per core. The result does not depend on it.
    time_limit: seconds, then it is a SolverError; 0 = none.
    progress: a callable (stage, fraction), called in this thread; True = a tqdm bar if there is one.
    strict: a certificate that does not hold is a SolverError, not a CertificateWarning.
    options: the program's, with _ for -: components, embed, fair, flow, least_handle,
        least_sheet, merge_overlapping, min_size, preset, resolution (a number or "full"), solver,
        surgery, wrap, wrap_gap. For --levels see `Skeleton.levels`.

    Holes are closed and other defects repaired first, see `Skeleton.changes`. Other threads run
    meanwhile, and Ctrl-C stops it. Raises UsageError, InputError, DeviceError or SolverError.
    """
    strict = flag(strict, "strict")
    with listening(progress, time_limit) as listener:
        skeleton = extracted(mesh, listener, dict(options, detail=detail, threads=threads))
    warn_or_fail(skeleton, strict, 2)
    return skeleton


def read(path):
    """The Skeleton in a file: OBJ, PLY, CGAL polylines, SWC, VTP, GraphML or JSON.

    Raises InputError.
    """
    return Skeleton(_core.read_skeleton(path_of(path, "path")))
