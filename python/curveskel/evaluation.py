"""The certificate of anybody's skeleton, and two skeletons beside each other."""

from . import _core
from .graphs import graph_of
from .inputs import listening, soup_of


def evaluate(mesh, skeleton, *, against=None, threads=0, time_limit=0, progress=None, **options):
    """The certificate of any skeleton of a surface: a dict, as `Skeleton.certificate`.

    mesh, threads, time_limit, progress: as of `extract`.
    skeleton: a Skeleton, a path to a skeleton file, a pair of arrays, nodes (n, 3) and edges
        (m, 2), an object with `vertices` and `edges`, as skeletor's, or a networkx graph whose
        nodes have x, y and z, or pos.
    against: another one, to compare with, as `curveskel evaluate --against`.
    options: those of repair: components, least_handle, least_sheet, merge_overlapping, min_size,
        wrap, wrap_gap.

    With `against` the dict has an entry of that name, a dict: hausdorff_distance and mean_distance
    between the two, over the diagonal of the surface's bounding box; where_both_run has of `this`
    and of the `other` the share_of_length that lies there, and the centredness_median of it.
    Raises UsageError, InputError or SolverError.
    """
    graph = graph_of(skeleton, "skeleton")
    other = None if against is None else graph_of(against, "against")
    with listening(progress, time_limit) as listener:
        return _core.evaluate(soup_of(mesh, listener), graph, other, dict(options, threads=threads),
                              listener)
