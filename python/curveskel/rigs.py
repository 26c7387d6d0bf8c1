"""Rigs: joints and skin weights."""

import json
import os
import pathlib
import warnings

import numpy

from . import _core
from .errors import CertificateWarning, UsageError
from .inputs import counted, flag, is_path, listening, path_of, soup_of, warn_of
from .skeleton import Skeleton, read


class _KeptRig:
    """All of a rig that goes through pickle: arrays, names and the report."""

    def __init__(self, made):
        self.joints, self.parents = numpy.array(made.joints), numpy.array(made.parents)
        self.names, self.roles = made.names, made.roles
        self._weights, self._report = made.weights(), made.report()

    def __setstate__(self, state):
        self.__dict__.update(state)
        for values in (self.joints, self.parents):
            values.flags.writeable = False

    def weights(self):
        return tuple(values.copy() for values in self._weights)

    def report(self):
        return self._report


class Rig:
    """Joints that move a surface, as `rig` makes them. Arrays are views, and read-only.

    It can be copied and pickled. What comes out of pickle has all but `save`, which needs the
    surface.
    """

    def __init__(self, made):
        self._made = made

    @property
    def joints(self):
        """(j, 3) float64: places, in the units of the surface; each joint's parent before it."""
        return self._made.joints

    @property
    def parents(self):
        """(j,) int32: the joint that each hangs from; -1 = a root."""
        return self._made.parents

    @property
    def names(self):
        """A list of j strings."""
        return self._made.names

    @property
    def roles(self):
        """A list of j strings: what each joint is in the body ("hips"); "" = nothing known."""
        return self._made.roles or [""] * len(self.joints)

    @property
    def weights(self):
        """scipy.sparse.csr_matrix, (v, j) float32: rows of sum 1, four joints at most."""
        import scipy.sparse

        data, indices, indptr = self._made.weights()
        return scipy.sparse.csr_matrix((data, indices, indptr),
                                       shape=(len(indptr) - 1, len(self.joints)))

    @property
    def report(self):
        """A dict: plan, roles, parts, joints, checks of the weights, as `rig --report`."""
        return json.loads(self._made.report())

    @property
    def plan(self):
        """How the body is built.

        "humanoid", "quadruped", "bird", "biped-with-tail", "fish" or "other"; "none" where no plan
        was made: with `root`, `joints`, `keep_rig` or plan="none".
        """
        return self.report["plan"]

    def save(self, path, *, vrm_name="", vrm_author="", vrm_licence=""):
        """Writes the rig in the format of the extension, any of `curveskel rig`.

        GLB of a surface that is from a glTF file or an OBJ with materials is that file itself with
        the rig in it. Pictures of `.usda` go to a folder beside it. VRM needs the three texts, but
        for those that a VRM 1.0 file says whose rig is kept. Warns of what is lost. Raises
        UsageError, InputError or OutputError.
        """
        path = pathlib.Path(path_of(path, "path"))
        if isinstance(self._made, _KeptRig):
            raise UsageError("files of rigs have the surface in them, which a rig that was pickled "
                             "has not; save it before, or make it again")
        warn_of(self._made.save(path, path.suffix.lower().lstrip("."), vrm_name, vrm_author,
                                vrm_licence), 2)

    def __copy__(self):
        return self  # as nothing of it changes

    def __deepcopy__(self, memo):
        return self

    def __reduce__(self):
        kept = isinstance(self._made, _KeptRig)
        return Rig, (self._made if kept else _KeptRig(self._made),)

    def __repr__(self):
        return f"<curveskel.Rig: {counted(len(self.joints), 'joint')}, {self.plan}>"


def rig(mesh, *, skeleton=None, joints=None, keep_rig=False, as_shown=False, threads=0,
        time_limit=0, progress=None, **options):
    """Joints and skin weights for a surface, as `curveskel rig` makes them.

    mesh: as of `extract`; a path lets `Rig.save` edit the file itself.
    skeleton: rig this one, a Skeleton of the same surface or a path, instead of extracting one.
    joints: a path to a rig: its joints get new weights, and no others are made.
    keep_rig: the same with the joints that the glTF, FBX or COLLADA file itself has.
    as_shown: a glTF, FBX or COLLADA file whose old joints rest in another pose than they were bound
        in is rigged as viewers show it, not as it was bound; so it is with joints of its own.
    threads, time_limit, progress: as of `extract`.
    options: the program's, with _ for -: bone_length, components, detail, ends (False for
        --no-ends), fair, follow, front, ground_root, joint_budget, least_handle,
        least_sheet, merge_overlapping, min_size, names, plan, pose, root, softness, up, wrap,
        wrap_gap.

    Options that would have no effect are a UsageError. What the program warns of is a UserWarning,
    a certificate that does not hold a CertificateWarning. Raises UsageError, InputError,
    DeviceError or SolverError.
    """
    keep_rig = flag(keep_rig, "keep_rig")
    as_shown = flag(as_shown, "as_shown")
    if joints is not None and (keep_rig or skeleton is not None):
        raise UsageError(f"joints and {'keep_rig' if keep_rig else 'skeleton'} exclude each other")
    if keep_rig and as_shown:
        raise UsageError("keep_rig and as_shown exclude each other")
    if is_path(skeleton):
        skeleton = read(skeleton)
    if skeleton is not None and not isinstance(skeleton, Skeleton):
        raise UsageError(f"skeleton: needs a Skeleton or a path, not {type(skeleton).__name__}")
    if joints is not None:
        joints = path_of(joints, "joints")
    if is_path(mesh) and joints is not None and os.path.exists(mesh) and os.path.exists(joints):
        as_shown = as_shown or os.path.samefile(mesh, joints)
    with listening(progress, time_limit) as listener:
        as_bound = not (as_shown or keep_rig)
        soup = soup_of(mesh, listener, as_bound=as_bound)
        made = _core.rig(soup, as_bound, keep_rig, None if skeleton is None else skeleton._graph,
                         joints, dict(options, threads=threads), listener)
    if made.shortcomings:
        warnings.warn("the certificate failed: " + made.shortcomings, CertificateWarning,
                      stacklevel=2)
    warn_of(made.findings, 2)
    return Rig(made)
