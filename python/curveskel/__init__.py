"""Curve skeletons of triangle surfaces.

    import curveskel
    skeleton = curveskel.extract("horse.ply")
    skeleton.vertices, skeleton.edges, skeleton.radii     # numpy arrays
    skeleton.branches                                     # pandas.DataFrame

The functions do what the program `curveskel` does, with the same results. numpy is needed; pandas,
networkx, trimesh and tqdm are imported when asked for.
"""

from . import _core
from .errors import (CertificateWarning, DeviceError, Error, InputError, OutputError, SolverError,
                     UsageError)
from .evaluation import evaluate
from .matching import Match, match
from .rigs import Rig, rig
from .skeleton import Skeleton, extract, read
from .surfaces import contract, fair, read_surface

__version__ = _core.program_and_version().split()[-1]
__all__ = ["CertificateWarning", "DeviceError", "Error", "InputError", "Match", "OutputError", "Rig",
           "Skeleton", "SolverError", "UsageError", "contract", "evaluate", "extract", "fair",
           "match", "read", "read_surface", "rig"]
