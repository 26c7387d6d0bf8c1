"""Graphs of other libraries, from skeletons and back."""

import numpy

from . import _core
from .errors import Error, UsageError
from .inputs import array_of, is_path, path_of


def to_networkx(skeleton):
    """See `Skeleton.to_networkx`."""
    import networkx

    graph = networkx.Graph()
    for node, (x, y, z) in enumerate(skeleton.vertices.tolist()):
        graph.add_node(node, x=x, y=y, z=z)
    for name, values in (("radius", skeleton.radii), ("life", skeleton.lives)):
        if len(values):
            networkx.set_node_attributes(graph, dict(enumerate(values.tolist())), name)
    ends = skeleton.vertices[skeleton.edges]
    lengths = numpy.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    for (a, b), length in zip(skeleton.edges.tolist(), lengths.tolist()):
        graph.add_edge(a, b, length=length)
    table = skeleton._graph.branch_table(-1)
    for branch, nodes in enumerate(skeleton.branch_nodes):
        values = {"branch": branch}
        for name in ("life", "parent", "merge"):
            value = table[name][branch]
            if value is not None and value == value:  # not NaN
                values[name] = value
        for a, b in zip(nodes[:-1].tolist(), nodes[1:].tolist()):
            graph.edges[a, b].update(values)
    return graph


def to_trimesh(skeleton):
    """See `Skeleton.to_trimesh`."""
    from trimesh.path import Path3D
    from trimesh.path.entities import Line

    return Path3D(entities=[Line(nodes) for nodes in skeleton.branch_nodes],
                  vertices=numpy.array(skeleton.vertices), process=False)


def to_pyvista(skeleton):
    """See `Skeleton.to_pyvista`."""
    import pyvista

    branches = skeleton.branch_nodes
    data = pyvista.PolyData(numpy.array(skeleton.vertices))
    data.lines = numpy.concatenate(
        [numpy.concatenate(([len(nodes)], nodes)) for nodes in branches]
    ) if branches else numpy.empty(0, dtype=int)
    data.cell_data["branch"] = numpy.arange(len(branches))
    for name, values in (("radius", skeleton.radii), ("life", skeleton.lives)):
        if len(values):
            data.point_data[name] = numpy.array(values)
    return data


def _place_of(node, values):
    if all(name in values for name in "xyz"):
        return [values[name] for name in "xyz"]
    if "pos" in values:
        return values["pos"]
    raise UsageError(f"node {node!r} of the graph has no x, y and z, nor pos")


def _arrays_of_networkx(graph):
    """Places and edges; loops from a node to itself are left out, as in files."""
    number = {node: row for row, node in enumerate(graph.nodes)}
    nodes = [_place_of(node, values) for node, values in graph.nodes(data=True)]
    edges = [(number[a], number[b]) for a, b in graph.edges() if a != b]
    return (numpy.array(nodes, dtype=numpy.float64).reshape(len(nodes), -1),
            numpy.array(edges, dtype=numpy.int64).reshape(-1, 2))


def graph_of(skeleton, name):
    """Anybody's skeleton as the core takes it.

    skeleton: a Skeleton, a path, a pair (nodes, edges), an object with `vertices` and `edges`, or a
        networkx graph whose nodes have x, y and z, or pos.
    name: of the argument, for messages.

    Raises UsageError or InputError.
    """
    if is_path(skeleton):
        return _core.read_skeleton(path_of(skeleton, name))
    if hasattr(skeleton, "_graph"):
        return skeleton._graph
    try:
        if hasattr(skeleton, "nodes") and hasattr(skeleton, "adj"):
            nodes, edges = _arrays_of_networkx(skeleton)
        elif hasattr(skeleton, "vertices") and hasattr(skeleton, "edges"):
            nodes, edges = skeleton.vertices, skeleton.edges
        else:
            nodes, edges = skeleton
        nodes = array_of(nodes, "nodes", numpy.float64)
        edges = array_of(edges, "edges")
        if not edges.size:
            edges = numpy.empty((0, 2), dtype=numpy.int64)
        if nodes.ndim != 2 or nodes.shape[1] != 3:
            raise UsageError(f"nodes: needs shape (n, 3), not {nodes.shape}")
        if not numpy.issubdtype(edges.dtype, numpy.integer):
            raise UsageError(f"edges: needs integers, not {edges.dtype}")
        return _core.skeleton_of_arrays(nodes, edges.astype(numpy.int64))
    except (TypeError, ValueError) as error:
        if isinstance(error, Error):
            raise
        raise UsageError(f"{name}: needs a Skeleton, a path, a pair (nodes, edges) or a networkx "
                         f"graph, not {type(skeleton).__name__}") from error
