"""Smooths polygonal surface meshes by mean curvature flow: seamflow.smooth(V, F, radius="1%")."""

import difflib
import inspect
import json
import numbers
import warnings
from typing import NamedTuple

import numpy as np

try:
    from . import _core
except ImportError:
    # The wheel brings the C++ runtime for machines that have none, or an older one.
    import ctypes
    import pathlib

    for _path in sorted((pathlib.Path(__file__).parent / "runtime").glob("lib*")):
        ctypes.CDLL(str(_path))
    from . import _core

__all__ = ["Flow", "Geodesics", "Progress", "diffuse", "geodesic_distance", "smooth"]
__version__ = _core.version
__license__ = _core.licence

_OPTIONS = {name.replace("-", "_"): (name, kind.split(":")[0], *rest) for name, kind, *rest in _core.options()}


class Progress(NamedTuple):
    """How far a flow is."""

    phase: str
    """"cut", "analyse", "step", or "reference" in a step of the undecomposed flow that reference=True asks for."""
    step: int
    """The step that is being taken, from 1; 0 before the first one."""
    steps: int
    """How many there are to be."""
    fraction: float
    """The part of the whole that is done, from 0 to 1."""


def smooth(V, F=None, *, fixed=None, labels=None, edges=None, attach_weights=None, region=None,
           progress=None, **options):
    """Smooths a mesh by mean curvature flow; with the same options the result has the same bits as that of the program
    `smooth`. Without an amount it finds the noise of each place and removes it.

    V: positions, (#V, 3), of which a copy is smoothed; or, without F, a mesh of trimesh, meshio, Open3D, VTK or
        PyVista, or a surface of nibabel (GIFTI). The mesh stays as it is.
    F: faces, (#F, 3) or (#F, 4) and so on, with the vertices of each numbered from 0; or a list of polygons.
    fixed: vertices that stay where they are, as a mask (#V, bool; or whole numbers, 0 and 1 alone) or by their numbers.
    labels: the sub-mesh of every face, (#F,), at least 0.
    edges: edges that are kept, however little they bend, by their vertices, (#E, 2); with keep_edges or without an amount.
    attach_weights: how strongly each vertex is pulled back to where it was, (#V,), in 1/length².
    region: the strength of the flow at each vertex, (#V,), from 0 (it stays) to 1, or a mask of those that move.
    progress: called with a Progress a few times a second, in the calling thread; what it raises stops the flow.

    Returns the positions, in the type of V (float32, or else float64), and a dict with what `smooth --report` writes,
    and with "labels", a list of the sub-mesh of every face. json.dumps takes it.

    Raises ValueError for a mesh or an option that cannot be used, TypeError for a keyword that there is not,
    RuntimeError where the computation fails, MemoryError, and KeyboardInterrupt after Ctrl-C, which stops the flow.
    Warns (RuntimeWarning) where steps have missed the tolerance that converge asks for.

    The other keywords are the options of the program, with underscores for hyphens: a number or the text that the
    program takes, True for those without a value.
    """
    mesh, single = _arguments(V, F, options, fixed, labels, edges, attach_weights, region)

    def tell(*state):
        progress(Progress(*state))

    positions, parts, report, missed = _core.run(*mesh, progress and tell)
    if missed:
        warnings.warn(missed, RuntimeWarning, stacklevel=2)
    return positions.astype(np.float32 if single else np.float64, copy=False), _report(report, parts)


class Flow:
    """The flow of smooth(), taken step by step:

        flow = seamflow.Flow(V, F, radius="1%", flow="linear")
        flow.step()
        show(flow.positions)

    Between steps it keeps what the next one can use: with flow="linear" the factorisation, so that a step after the
    first is one solution. After `steps` steps the positions have the same bits as those of smooth(). The arguments are
    those of smooth() except progress; more steps than `steps` may be taken. Ctrl-C raises KeyboardInterrupt after the
    step that is being taken; the flow can go on. `with seamflow.Flow(...) as flow:` frees its memory at the end of the
    block.
    """

    def __init__(self, V, F=None, *, fixed=None, labels=None, edges=None, attach_weights=None, region=None,
                 **options):
        if "progress" in options:
            raise TypeError("Flow has no progress: take its steps one by one")
        mesh, self._single = _arguments(V, F, options, fixed, labels, edges, attach_weights, region)
        self._begun = _core.Flow(*mesh)
        self._count = len(mesh[0])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._begun = None

    def __reduce_ex__(self, protocol):
        raise TypeError("a Flow cannot be copied or pickled, as it holds factorisations: begin another one, from "
                        "positions if it is to go on from here")

    @property
    def _flow(self):
        if self._begun is None:
            raise ValueError("the flow has ended with its with block: begin a new one")
        return self._begun

    def step(self, n=1):
        """Takes n steps. After an error no further step can be taken."""
        if not isinstance(n, (int, np.integer)) or n < 0:
            raise ValueError(f"n is {n!r}, but has to be a whole number of steps from 0")
        flow = self._flow
        # Signals are heard between steps.
        for _ in range(n):
            flow.step(1)

    def hold(self, vertices):
        """Holds vertices (a mask or numbers) where they are. This and the following need flow="linear" or
        approach="converged"; only the sub-meshes with such vertices are made anew."""
        self._flow.hold(self._numbers(vertices), True)

    def release(self, vertices):
        """Lets vertices move again that were held since the flow began."""
        self._flow.hold(self._numbers(vertices), False)

    def move(self, vertices, to):
        """Puts vertices elsewhere, to (#vertices, 3), fixed ones, too. A linear flow goes on as if it had begun with them
        there. Mean curvature flows can do so however they are solved."""
        numbers = self._numbers(vertices)
        to = np.asarray(to)
        if to.shape != (len(numbers), 3) or to.dtype.kind not in "fiu":
            raise ValueError(f"to has to be real numbers, ({len(numbers)}, 3), but is {to.dtype}, {to.shape}")
        self._flow.move(numbers, np.ascontiguousarray(to, dtype=np.float64))

    def attach(self, vertices, weights):
        """Changes attach_weights of vertices, one for each, in 1/length²."""
        numbers = self._numbers(vertices)
        weights = np.broadcast_to(np.asarray(weights, dtype=np.float64), (len(numbers),))
        self._flow.attach(numbers, np.ascontiguousarray(weights))

    def _numbers(self, vertices):
        return _vertex_numbers("vertices", vertices, self._count)

    @property
    def n_steps(self):
        """How many steps were taken."""
        return self._flow.n_steps()

    @property
    def positions(self):
        """The positions after the last step, (#V, 3), in the type of V (float32, or else float64). They cannot be
        written, which would not move the flow: see move()."""
        positions = self._flow.positions().astype(np.float32 if self._single else np.float64, copy=False)
        positions.flags.writeable = False
        return positions

    def report(self):
        """The dict of smooth() on the steps so far. Warns as smooth() does."""
        _, parts, report, missed = self._flow.result()
        if missed:
            warnings.warn(missed, RuntimeWarning, stacklevel=2)
        return _report(report, parts)


def diffuse(V, F=None, fields=None, *, fwhm=None, keep_edges=None, fill=False, boundary="free", fixed=None, labels=None,
            **options):
    """Smooths fields on a surface by its heat equation, while the surface stays. All columns share one factorisation.

    V, F: as for smooth(); with a mesh in place of V, F is None.
    fields: values at the vertices, (#V,) or (#V, n), or data of nibabel (GIFTI), a column for each array. NaN is no
        data: such vertices take no part and stay NaN.
    fwhm: full width at half maximum of the smoothing, a length or "2%" of the diagonal; or give radius, time_step or
        time_step_edges. With fwhm, steps is 10 unless it is given.
    keep_edges: differences of fields well above this stay (Perona and Malik); all columns count together.
    fill: gives vertices without data the harmonic extension of the others.
    boundary: "free": nothing flows across it; "fixed": values there stay.
    fixed: vertices whose values stay, as a mask or by their numbers.
    labels: as for smooth(), the sub-mesh of each face, in place of a cut.

    Returns the fields, in the type of `fields` (float32, or else float64), and a dict: "fwhm", the width that was
    reached, as white noise shows (None without fwhm), "time_step", "without_data", "filled", "remarks".

    The other keywords are those options of smooth() that concern how steps are solved: laplacian ("virtual-refinement"
    unless told otherwise), steps, converge, approach, threads, weld and so on. Raises as smooth().
    """
    values = np.asarray(_of_gifti(fields) if hasattr(fields, "darrays") else fields)
    if values.ndim not in (1, 2) or values.dtype.kind not in "fiu":
        raise ValueError(f"fields has to be real numbers, (#V,) or (#V, n), but is {values.dtype}, {values.shape}")
    if boundary not in ("free", "fixed"):
        raise ValueError(f"boundary is free or fixed, not {boundary!r}")
    if keep_edges is not None and not keep_edges > 0:
        raise ValueError(f"keep_edges is {keep_edges!r}, but has to be a positive difference of fields")
    for name, value in options.items():
        moves_surface = name in _OPTIONS and _OPTIONS[name][-1]
        if value is not None and (moves_surface or name in ("region", "edges", "attach_weights", "progress")):
            raise ValueError(f"diffuse has no {name}: the surface stays")
    amounts = [fwhm, *(options.get(name) for name in ("radius", "time_step", "time_step_edges"))]
    if sum(amount is not None for amount in amounts) != 1:
        raise ValueError("diffuse needs one amount: give fwhm, radius, time_step or time_step_edges")
    if fwhm is not None and options.get("steps") is None:
        options["steps"] = 10
    if options.get("laplacian") is None:
        options["laplacian"] = "virtual-refinement"
    (V, corners, offsets, (texts, _), arrays), _ = _arguments(V, F, options, fixed, labels, None, None, None)
    if len(values) != len(V):
        raise ValueError(f"fields has {len(values)} rows, but the mesh has {len(V)} vertices")
    result, reached, without_data, filled, time_step, remarks, missed = _core.diffuse(
        V, corners, offsets, (texts, []), *arrays[:2], np.ascontiguousarray(values.reshape(len(V), -1), dtype=np.float64),
        ("" if fwhm is None else str(fwhm), 0.0 if keep_edges is None else float(keep_edges), bool(fill), boundary == "free"))
    if missed:
        warnings.warn(f"the tolerance was missed in {missed} steps", RuntimeWarning, stacklevel=2)
    report = {"fwhm": reached, "time_step": time_step, "without_data": without_data, "filled": filled,
              "remarks": remarks}
    return result.reshape(values.shape).astype(np.float32 if values.dtype == np.float32 else np.float64), report


class Geodesics:
    """Distances along a surface by the heat method, from one set of vertices after the other with one factorisation:

        geodesics = seamflow.Geodesics(V, F)
        distances = [geodesics.distance(v) for v in landmarks]

    V, F: as for smooth(); with a mesh in place of V, F is None.
    """

    def __init__(self, V, F=None, *, threads=0):
        (V, corners, offsets, _, _), _ = _arguments(V, F, {}, None, None, None, None, None)
        self._geodesics = _core.Geodesics(V, corners, offsets, threads)
        self._count = len(V)

    def distance(self, sources):
        """The distance of each vertex from the nearest source, (#V,): infinite where the surface does not lead.

        sources: vertices to measure from, as a mask or by their numbers.
        """
        return self._geodesics.distance(_vertex_numbers("sources", np.atleast_1d(sources), self._count))


def geodesic_distance(V, F=None, sources=None, *, threads=0):
    """Geodesics(V, F, threads=threads).distance(sources), for one set of vertices alone."""
    if sources is None:
        raise ValueError("geodesic_distance needs sources: the vertices to measure from")
    return Geodesics(V, F, threads=threads).distance(sources)


def _report(text, parts):
    report = json.loads(text)
    for of_files in ("input", "output"):
        del report[of_files]
    report["labels"] = parts.tolist()
    return report


def _arguments(V, F, options, fixed, labels, edges, attach_weights, region):
    """Positions, corners, offsets, keywords and arrays as the module takes them; and whether V is in single precision."""
    if F is None:
        V, F = _of_mesh(V)
    V = np.asarray(V)
    if V.ndim != 2 or V.shape[1] != 3 or V.dtype.kind not in "fiu":
        raise ValueError(f"V has to be real numbers, (#V, 3), but is {V.dtype}, {V.shape}")
    if isinstance(F, np.ndarray) and F.ndim == 2 and F.shape[1] > len(V) >= 3:
        raise ValueError(f"F has to have a face in each row, but is {F.shape}, and a face has no more vertices than "
                         f"the mesh, {len(V)}: transpose F")
    corners, offsets = _faces(F)
    if len(offsets) == 1 and len(V) > 0:
        raise ValueError("F has no faces: give one at least")
    if "fix" in options:
        if fixed is not None:
            raise TypeError("fixed and fix are the same: leave one of them out")
        fixed = options.pop("fix")
    texts = [text for name, value in options.items() for text in _texts(name, value)]
    arrays = []
    names = []
    for name, convert, kind, value, count in (
        ("fix", lambda value, count: np.unique(_vertex_numbers("fixed", value, count)), np.int32, fixed, len(V)),
        ("labels", _labels, np.int32, labels, len(offsets) - 1),
        ("edges", _edges, np.int32, edges, len(V)),
        ("attach-weights", _weights, np.float64, attach_weights, len(V)),
        ("region", _strengths, np.float64, region, len(V)),
    ):
        array = [] if value is None else convert(value, count)
        arrays.append(np.ascontiguousarray(array, dtype=kind))
        if value is not None:
            # So that the options are checked against each other.
            names.append(f"--{name}")

    return ((np.ascontiguousarray(V, dtype=np.float64), corners, offsets, (texts, names), tuple(arrays)),
            V.dtype == np.float32)


def _describe_options():
    lines = []
    for keyword, (_, kind, text, is_flag, _) in _OPTIONS.items():
        told = text.replace("\n", "\n        ")
        lines.append(f"    {keyword}: {'bool' if is_flag else kind}\n        {told}")
    return "\n".join(lines)


def _signature(function):
    """That of a function with the keywords of all options."""
    own = [p for p in inspect.signature(function).parameters.values() if p.kind is not p.VAR_KEYWORD]
    further = [inspect.Parameter(keyword, inspect.Parameter.KEYWORD_ONLY, default=None) for keyword in _OPTIONS]
    return inspect.Signature(own + further)


smooth.__signature__ = _signature(smooth)
Flow.__init__.__signature__ = _signature(Flow.__init__)
if smooth.__doc__:
    smooth.__doc__ += "\n" + _describe_options() + "\n"


def _of_mesh(mesh):
    """Positions and faces of an object that has them."""
    for attribute, read in (("GetPolys", _of_vtk), ("darrays", _of_gifti_surface), ("triangle", _of_tensors)):
        if hasattr(mesh, attribute):
            return read(mesh)
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return mesh.vertices, mesh.faces
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):
        return mesh.vertices, np.asarray(mesh.triangles)
    if not hasattr(mesh, "points") or not hasattr(mesh, "cells"):
        raise TypeError("V and F are needed, or a mesh of trimesh, meshio, Open3D, VTK, PyVista or nibabel: one with "
                        ".vertices and .faces, for example")
    blocks = [(block.type, block.data) for block in mesh.cells if block.type not in ("vertex", "line")]
    for kind, _ in blocks:
        if kind not in ("triangle", "quad") and not kind.startswith("polygon"):
            raise ValueError(f"the mesh has cells of type {kind}: only triangle, quad and polygon are faces")
    if len(blocks) == 1:
        return mesh.points, blocks[0][1]
    return mesh.points, [face for _, data in blocks for face in data]


def _of_vtk(mesh):
    """The polygons of a vtkPolyData, that of PyVista among them; its vertices and lines are no faces."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    if mesh.GetStrips().GetNumberOfCells() > 0:
        raise ValueError("the mesh has triangle strips: use vtkTriangleFilter first")
    if mesh.GetPoints() is None:
        raise ValueError("the mesh has no points")
    offsets, corners = (vtk_to_numpy(array()) for array in (mesh.GetPolys().GetOffsetsArray,
                                                            mesh.GetPolys().GetConnectivityArray))
    sizes = np.diff(offsets)
    same = len(sizes) > 0 and np.all(sizes == sizes[0])
    faces = corners.reshape(len(sizes), -1) if same else np.split(corners, offsets[1:-1]) if len(sizes) > 0 else []
    return vtk_to_numpy(mesh.GetPoints().GetData()), faces


def _of_tensors(mesh):
    """Those of a mesh of open3d.t."""
    return mesh.vertex["positions"].cpu().numpy(), mesh.triangle["indices"].cpu().numpy()


def _of_gifti_surface(image):
    def only(intent):
        arrays = image.get_arrays_from_intent(intent)
        if len(arrays) != 1:
            raise ValueError(f"the image has {len(arrays)} arrays of intent {intent}: a surface has one")
        return arrays[0].data

    return only("NIFTI_INTENT_POINTSET"), only("NIFTI_INTENT_TRIANGLE")


def _of_gifti(image):
    """The data arrays as columns; one alone as a list of numbers."""
    columns = [array.data for array in image.darrays]
    return columns[0] if len(columns) == 1 else np.stack(columns, axis=-1)


def _whole(array):
    """Floats that are whole numbers, which some libraries have in place of these; all else as it is."""
    if array.dtype.kind == "f" and np.all(np.abs(array) < 2**53) and np.all(array == np.floor(array)):
        return array.astype(np.int64)
    return array


def _signed(corners, face_of):
    """Corners without a sign, of 64 bits, with one; all else as it is. face_of(i): the face of corner i."""
    if corners.dtype != np.uint64:
        return corners
    beyond = np.flatnonzero(corners > np.uint64(np.iinfo(np.int64).max))
    if beyond.size > 0:
        raise ValueError(f"F: face {face_of(beyond[0])} (numbered from 0) names vertex {corners[beyond[0]]}, which no "
                         "mesh has")
    return corners.astype(np.int64)


def _faces(F):
    """The corners of all faces one after the other, and where those of each begin, and the last ends."""
    if not isinstance(F, np.ndarray) or F.ndim != 2:
        polygons = [np.asarray(face) for face in F]
        if not polygons:
            return np.zeros(0, np.int32), np.zeros(1, np.int64)
        for f, face in enumerate(polygons):
            face = polygons[f] = _whole(face)
            if face.ndim != 1 or (face.size > 0 and face.dtype.kind not in "iu"):
                raise ValueError(f"face {f} (numbered from 0) has to be a list of whole numbers, its vertices")
            polygons[f] = _signed(face, lambda _, f=f: f)
        offsets = np.zeros(len(polygons) + 1, np.int64)
        np.cumsum([len(face) for face in polygons], out=offsets[1:])
        F = np.concatenate(polygons)
    else:
        F = _whole(F)
        if F.dtype.kind not in "iu":
            raise ValueError(f"F has to be whole numbers, but is {F.dtype}")
        offsets = np.arange(len(F) + 1, dtype=np.int64) * F.shape[1]
    F = _signed(F.reshape(-1), lambda corner: np.searchsorted(offsets, corner, side="right") - 1)
    return np.ascontiguousarray(F, dtype=np.int32 if F.dtype == np.int32 else np.int64), offsets


def _array_of(name, value, count, kinds, described):
    array = np.asarray(value)
    if array.dtype.kind not in kinds or array.shape != (count,):
        raise ValueError(f"{name} has to be {described}, ({count},), but is {array.dtype}, {array.shape}")
    return array


def _edges(value, count):
    array = np.asarray(value)
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "iu":
        raise ValueError(f"edges has to be pairs of vertices, (#E, 2), but is {array.dtype}, {array.shape}")
    if array.size > 0 and not (0 <= array.min() and array.max() < count):
        raise ValueError(f"edges has to name vertices from 0 to {count - 1}, but has {array.min()} to {array.max()}")
    return array.reshape(-1)


def _vertex_numbers(name, value, count):
    """The numbers of vertices that are given so, in their order, or as a mask."""
    array = np.asarray(value)
    if array.dtype.kind == "b":
        array = np.flatnonzero(_array_of(name, array, count, "b", "a mask or numbers of vertices"))
    if array.size == 0:
        return np.zeros(0, dtype=np.int32)
    if array.ndim != 1 or array.dtype.kind not in "iu":
        raise ValueError(f"{name} has to be a mask or numbers of vertices, of shape (n,), but is {array.dtype}, "
                         f"{array.shape}")
    if len(array) == count and (count > 2 or array.dtype == np.uint8) and np.all((array == 0) | (array == 1)):
        # Numbers would be those of two vertices, again and again.
        array = np.flatnonzero(array)
    elif len(array) == count > 2 and array.min() == 0 and np.all((array == 0) | (array == array.max())):
        raise ValueError(f"{name} has 0 or {array.max()} for each vertex: give a mask as {name}.astype(bool), or the "
                         "number of each vertex once")
    wrong = array[(array < 0) | (array >= count)]
    if wrong.size > 0:
        raise ValueError(f"{name} names vertex {wrong[0]}, but the mesh has {count} vertices")
    numbers, times = np.unique(array, return_counts=True)
    if len(array) > 2 * len(numbers):
        raise ValueError(f"{name} names vertex {numbers[times.argmax()]} {times.max()} times: give the number of each "
                         f"vertex once, or a mask of {count} as {name}.astype(bool)")
    return np.ascontiguousarray(array, dtype=np.int32)


def _labels(value, count):
    labels = _array_of("labels", value, count, "iu", "whole numbers")
    wrong = np.flatnonzero((labels < 0) | (labels > np.iinfo(np.int32).max))
    if wrong.size > 0:
        raise ValueError(f"labels[{wrong[0]}] is {labels[wrong[0]]}, which is not from 0 to {np.iinfo(np.int32).max}")
    return labels


def _weights(value, count):
    weights = _array_of("attach_weights", value, count, "fiu", "numbers")
    wrong = np.flatnonzero(~np.isfinite(weights) | (weights < 0))
    if wrong.size > 0:
        raise ValueError(f"attach_weights[{wrong[0]}] is {weights[wrong[0]]}, which is not a finite number from 0")
    return weights


def _strengths(value, count):
    strengths = _array_of("region", value, count, "bfiu", "a mask or numbers from 0 to 1")
    wrong = np.flatnonzero(~((strengths >= 0) & (strengths <= 1)))
    if wrong.size > 0:
        raise ValueError(f"region[{wrong[0]}] is {strengths[wrong[0]]}, which is not a number from 0 to 1")
    return strengths


def _texts(keyword, value):
    """An option and its text; nothing where it is None or False."""
    if keyword not in _OPTIONS:
        known = sorted({*_OPTIONS, "fixed", "labels", "edges", "attach_weights", "region", "progress"})
        nearest = difflib.get_close_matches(keyword, known, 1)
        meant = f", did you mean {nearest[0]}?" if nearest else f"; there are {', '.join(known)}"
        raise TypeError(f"there is no keyword {keyword}{meant}")
    name, kind, _, is_flag, _ = _OPTIONS[keyword]
    if is_flag:
        if value is not None and not isinstance(value, (bool, np.bool_)):
            raise TypeError(f"{keyword} is True or False, not {value!r}")
        return [(f"--{name}", "")] if value else []
    if value is None:
        return []
    if isinstance(value, numbers.Number) and not isinstance(value, (bool, np.bool_)):
        # NumPy's numbers as Python's, which are written with all their digits.
        value = value.item() if isinstance(value, np.generic) else value
    elif "X,Y,Z" in kind and not isinstance(value, (str, bool, np.bool_)):
        three = np.asarray(value)
        if three.shape != (3,) or three.dtype.kind not in "fiu":
            raise TypeError(f"{keyword} is a number, three numbers or a text, not {value!r}")
        value = ",".join(str(number) for number in three.tolist())
    elif not isinstance(value, str):
        raise TypeError(f"{keyword} is a number or a text, not {value!r}")
    return [(f"--{name}", str(value))]
