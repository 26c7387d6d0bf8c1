"""The same branch in another pose, another subject, a later step of growth."""

import numpy

from . import _core
from .errors import UsageError
from .inputs import MOST_THREADS, counted, flag, index, listening
from .skeleton import Skeleton, extracted, warn_or_fail


class Match:
    """Which branch, junction and vertex of one skeleton is which in another; see `match`."""

    def __init__(self, table, junctions, vertices, by_vertices, a, b):
        self._table = table
        #: (k, 2) int32: nodes of paired junctions.
        self.junctions = numpy.array(junctions, dtype=numpy.int32).reshape(-1, 2)
        #: (v,) int32: of each vertex given with A the vertex given with B, -1 = none.
        self.vertices = vertices
        #: bool: both have the same faces, whose vertices told the branches.
        self.by_vertices = by_vertices
        #: The two skeletons.
        self.a, self.b = a, b

    @property
    def branches(self):
        """DataFrame: a, b (numbers of branches), reversed, ambiguous (another is as like to a)."""
        import pandas

        return pandas.DataFrame(self._table)

    @property
    def alone(self):
        """Two lists: branches of A, and of B, without a partner."""
        return tuple([number for number in range(len(skeleton.branch_nodes))
                      if number not in set(self._table[side])]
                     for side, skeleton in (("a", self.a), ("b", self.b)))

    def __repr__(self):
        of_a, of_b = self.alone
        return (f"<curveskel.Match: {counted(len(self._table['a']), 'pair')} of branches, "
                f"{sum(self._table['ambiguous'])} ambiguous, {len(of_a)} and {len(of_b)} alone>")


def match(a, b, *, by_shape=False, threads=0, time_limit=0, progress=None, **options):
    """Which branch, junction and vertex of A is which in B.

    a, b: skeletons that `extract` made, or surfaces as it takes them.
    by_shape: compare shapes alone, also where A and B have the same faces, whose vertices are
        taken for the same.
    threads, time_limit, progress: as of `extract`; the limit is for all of it.
    options: those of `extract`, for what is extracted here.

    Raises UsageError for a skeleton that was read from a file or pickled, and what `extract` raises.
    """
    sides = []
    by_shape = flag(by_shape, "by_shape")
    threads = index(threads, "threads", 0, MOST_THREADS)
    with listening(progress, time_limit) as listener:
        for side in (a, b):
            if not isinstance(side, Skeleton):
                side = extracted(side, listener, dict(options, threads=threads))
                warn_or_fail(side, False, 2)
            if not hasattr(side._extraction, "picture"):  # of a file, or pickled
                raise UsageError("match: needs skeletons with their surfaces, as extract makes them; "
                                 "of one from a file or a pickle give the surface instead")
            sides.append(side)
        found = _core.match(sides[0]._extraction, sides[1]._extraction, by_shape, threads,
                            listener)
    return Match(*found, *sides)
