"""Surfaces as callers give them, and progress and limits as they want them."""

import atexit
import contextlib
import math
import operator
import os
import re
import threading
import time
import warnings

import numpy

from . import _core
from .errors import SolverError, UsageError


MOST_THREADS = _core.most_threads


# A daemon thread that wakes while the interpreter is taken down ends the process by an abort, so
# the work of such threads is ended before.
_at_work = set()
_has_ended = threading.Event()
_LONGEST_WAIT = 5.0  # seconds at exit: work looks ten times a second


@atexit.register
def _end_work():
    _has_ended.set()
    latest = time.monotonic() + _LONGEST_WAIT
    while _at_work and time.monotonic() < latest:
        time.sleep(0.01)


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_at_work.clear)


class _Listener:
    """What the core tells of its work, and asks whether its time is over."""

    def __init__(self, tell, limit):
        self.tell = tell or (lambda stage, fraction: None)
        self._limit = limit
        self._end = time.monotonic() + limit if limit else math.inf

    def look(self):
        if _has_ended.is_set():
            raise SystemExit  # threads end by it without a word
        if time.monotonic() >= self._end:
            raise SolverError(f"the time limit of {self._limit:g} s was reached; allow more, or "
                              "decimate the surface first")


@contextlib.contextmanager
def listening(progress, time_limit=0):
    """The listener for the core.

    progress: a callable (stage, fraction); True moves a tqdm bar, if there is tqdm; None.
    time_limit: seconds from now; 0 = none. Raises UsageError for another value.
    """
    try:
        seconds = float(time_limit)
    except (TypeError, ValueError):
        seconds = math.nan
    if not 0 <= seconds <= 1e9:
        raise UsageError(f"time_limit: needs seconds, 0 (none) to 1e9, not {time_limit!r}")
    if progress and progress is not True and not callable(progress):
        raise UsageError(f"progress: needs a callable, True or None, not {progress!r}")
    if progress is not True:
        with _working(_Listener(progress, seconds)) as listener:
            yield listener
        return
    try:
        from tqdm.auto import tqdm
    except ImportError:
        with _working(_Listener(None, seconds)) as listener:
            yield listener
        return
    with tqdm(total=1.0, bar_format="{desc}: {percentage:3.0f}% {bar} {elapsed}") as bar:

        def show(stage, fraction):
            bar.set_description_str(stage)
            bar.n = fraction
            bar.refresh()

        with _working(_Listener(show, seconds)) as listener:
            yield listener


@contextlib.contextmanager
def _working(listener):
    _at_work.add(listener)
    try:
        listener.look()
        yield listener
    finally:
        _at_work.discard(listener)


def index(value, name, least, most):
    """A whole number in its range; raises UsageError for anything else."""
    try:
        number = operator.index(value)
    except TypeError:
        number = None
    if number is None or not least <= number <= most:
        raise UsageError(f"{name}: needs a whole number, {least} to {most}, not {value!r}")
    return number


def flag(value, name):
    """True or False; raises UsageError for anything else, as "no" would count as True."""
    if isinstance(value, (bool, numpy.bool_)) or (isinstance(value, int) and value in (0, 1)):
        return bool(value)
    raise UsageError(f"{name}: needs True or False, not {value!r}")


def is_path(given):
    """True of what names a file."""
    return isinstance(given, (str, bytes, os.PathLike))


def path_of(path, name):
    """A path as text, as the core takes it; raises UsageError for what is none."""
    try:
        text = os.fsdecode(path)
    except TypeError as error:
        raise UsageError(f"{name}: needs a path, not {type(path).__name__}") from error
    if "\0" in text:
        raise UsageError(f"{name}: needs a path, which has no NUL in it, not {text!r}")
    return text


def counted(count, one, many=None):
    """'1 node', '2 nodes'."""
    return f"{count} {one if count == 1 else many or one + 's'}"


def warn_of(findings, stacklevel):
    """Warns of what the program warns of, options named as Python has them."""
    for finding in findings:
        finding = re.sub(r"--([a-z-]+)", lambda name: name[1].replace("-", "_"), finding)
        warnings.warn(finding, UserWarning, stacklevel=stacklevel + 1)


def array_of(values, name, dtype=None):
    """As numpy.asarray; raises UsageError where something would be lost without a word."""
    if numpy.ma.is_masked(values):
        raise UsageError(f"{name}: found {numpy.ma.count_masked(values)} masked values, needed "
                         "none; leave their rows out, or fill them (a vertex with NaN loses its "
                         "faces)")
    values = numpy.asarray(values)
    if values.dtype.kind in "cSU" and dtype is not None:
        raise UsageError(f"{name}: needs real numbers, not {values.dtype}")
    return values if dtype is None else numpy.ascontiguousarray(values, dtype=dtype)


def _as_numbers(values):
    """The same array; of integers, if it has objects all of which are whole numbers."""
    if values.dtype != object or any(isinstance(one, bool) for one in values.flat):
        return values
    try:
        numbers = [operator.index(one) for one in values.flat]
    except TypeError:
        return values
    try:
        return numpy.array(numbers, dtype=numpy.int64).reshape(values.shape)
    except OverflowError as error:
        raise UsageError(f"faces: needs numbers of vertices, not {max(numbers, key=abs)}") from error


def _refuse_counts(corners, sizes):
    """Raises UsageError for rows of VTK, which begin with the number of the corners that follow.

    The one surface of polygons that looks so has a single vertex in every face, and is open.
    """
    if len(sizes) < 2 or sizes.min() < 4:
        return
    firsts = corners[numpy.cumsum(sizes) - sizes]
    if (firsts == sizes - 1).all():
        raise UsageError(f"faces: each begins with the number of the corners after it ({firsts[0]} "
                         "in the first), as VTK's do; needed the corners alone, faces[:, 1:]. Of "
                         "polygons round this one vertex, begin one with another corner")


def _corners_of(faces):
    """Corners one face after the other, and where each face begins: an array, or a list of faces."""
    try:
        faces = array_of(faces, "faces")
    except UsageError:
        raise
    except ValueError:
        faces = list(faces)  # of several sizes
    if not isinstance(faces, list) and faces.ndim == 2:
        faces = _as_numbers(faces)
    if isinstance(faces, list) or faces.dtype == object:
        faces = [_as_numbers(numpy.asarray(face)) for face in faces]
        sizes = numpy.array([len(face) for face in faces], dtype=numpy.int64)
        corners = numpy.concatenate(faces) if faces else numpy.empty(0, dtype=numpy.int64)
    elif faces.ndim == 2:
        sizes = numpy.full(len(faces), faces.shape[1], dtype=numpy.int64)
        corners = faces.reshape(-1)
    else:
        is_flat = faces.ndim == 1 and faces.size > 0 and faces.size % 4 == 0
        hint = ("; of VTK's flat triangles give faces.reshape(-1, 4)[:, 1:]"
                if is_flat and (faces[::4] == 3).all() else "")
        raise UsageError(f"faces: needs shape (n, k), one row a face, not {faces.shape}{hint}")
    if corners.ndim != 1 or not (numpy.issubdtype(corners.dtype, numpy.integer) or not sizes.size):
        raise UsageError(f"faces: needs integers, the vertices of each face, not {corners.dtype}")
    if (sizes < 3).any():
        face = int(numpy.argmax(sizes < 3))
        raise UsageError(f"faces: needs three corners or more in each, not {sizes[face]} as in "
                         f"face {face}")
    _refuse_counts(corners, sizes)
    if corners.dtype == numpy.uint64 and corners.size and corners.max() > numpy.iinfo(int).max:
        raise UsageError(f"faces: needs numbers of vertices, not {corners.max()}")
    return corners.astype(numpy.int64), numpy.concatenate(([0], numpy.cumsum(sizes)))


def soup_of(mesh, listener, as_bound=False):
    """A path, a pair (vertices, faces), or an object that has both, as the core takes it."""
    if is_path(mesh):
        return _core.read_surface(path_of(mesh, "mesh"), as_bound, listener)
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        mesh = (mesh.vertices, mesh.faces)
    try:
        vertices, faces = () if isinstance(mesh, dict) else mesh
    except (TypeError, ValueError) as error:
        raise UsageError("mesh: needs a path, a pair (vertices, faces), or an object with "
                         f"vertices and faces, not {type(mesh).__name__}") from error
    try:
        vertices = array_of(vertices, "vertices", numpy.float64)
    except UsageError:
        raise
    except (TypeError, ValueError) as error:
        raise UsageError(f"vertices: needs numbers of shape (n, 3): {error}") from error
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise UsageError(f"vertices: needs shape (n, 3), not {vertices.shape}")
    try:
        corners, offsets = _corners_of(faces)
    except (TypeError, ValueError) as error:
        if isinstance(error, UsageError):
            raise
        raise UsageError("faces: needs an array of shape (n, k) or a list of faces, each the "
                         f"numbers of its vertices: {error}") from error
    return _core.soup_of_arrays(vertices, corners, offsets)
