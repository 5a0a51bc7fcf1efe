"""The Python package, beside the programs: python3 python_test.py SMOOTH GENERATE, with the package on PYTHONPATH."""

import copy
import importlib.util
import inspect
import json
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings
from types import SimpleNamespace

import numpy as np

import seamflow

SMOOTH, GENERATE = sys.argv[1:3]
CUBE = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
SIDES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def read_obj(path):
    vertices, faces = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return np.array(vertices), faces


class WithFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def generate(self, *words):
        path = self.folder / "input.obj"
        subprocess.run([GENERATE, words[0], path, *words[1:]], check=True, stdout=subprocess.DEVNULL)
        return read_obj(path)

    def smooth_file(self, *words):
        command = [SMOOTH, self.folder / "input.obj", self.folder / "output.obj", *words]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        return read_obj(self.folder / "output.obj")[0]


class Fields(unittest.TestCase):
    """What lives on a surface that stays."""

    def setUp(self):
        x, y = np.meshgrid(np.linspace(0, 1, 30), np.linspace(0, 1, 30))
        self.V = np.c_[x.ravel(), y.ravel(), 0.1 * x.ravel() ** 2]
        i = np.arange(900).reshape(30, 30)
        self.F = np.c_[i[:-1, :-1].ravel(), i[:-1, 1:].ravel(), i[1:, 1:].ravel(), i[1:, :-1].ravel()]
        self.fields = np.random.default_rng(1).standard_normal((900, 5))

    def test_columns(self):
        smooth, report = seamflow.diffuse(self.V, self.F, self.fields, fwhm=0.2)
        self.assertEqual(smooth.shape, (900, 5))
        self.assertLess(smooth.std(), 0.3 * self.fields.std())
        self.assertLess(abs(report["fwhm"] - 0.2), 0.03)
        self.assertEqual(report["without_data"], 0)
        one, _ = seamflow.diffuse(self.V, self.F, self.fields[:, 3].astype(np.float32), fwhm=0.2,
                                  laplacian="virtual-refinement")
        self.assertEqual((one.shape, one.dtype), ((900,), np.float32))
        np.testing.assert_allclose(one, smooth[:, 3], atol=1e-6)
        constant, _ = seamflow.diffuse(self.V, self.F, np.full(900, 0.1), radius="5%", steps=2)
        np.testing.assert_array_equal(constant, 0.1)
        for keywords, steps in ({}, 10), ({"steps": 4}, 4):
            _, report = seamflow.diffuse(self.V, self.F, self.fields, fwhm=0.2, **keywords)
            time_of_kernel = 0.2**2 / (16 * np.log(2))
            self.assertAlmostEqual((steps - 1) * report["time_step"], time_of_kernel, places=12)

    def test_missed_tolerance(self):
        with self.assertWarnsRegex(RuntimeWarning, "missed in 2 steps"):
            seamflow.diffuse(self.V, self.F, self.fields, radius=0.1, steps=2, converge=1e-40, approach="cg")

    def test_no_data_and_what_stays(self):
        self.fields[5, 0] = np.nan
        smooth, report = seamflow.diffuse(self.V, self.F, self.fields, radius=0.1, fixed=[400, 401])
        self.assertEqual(np.flatnonzero(np.isnan(smooth)).tolist(), [25])
        np.testing.assert_array_equal(smooth[[400, 401]], self.fields[[400, 401]])
        self.assertEqual((report["without_data"], report["filled"]), (1, 0))
        filled, report = seamflow.diffuse(self.V, self.F, self.fields, radius=0.1, fill=True)
        self.assertTrue(np.isfinite(filled).all())
        self.assertEqual(report["filled"], 1)
        fixed, _ = seamflow.diffuse(self.V, self.F, self.fields[:, 1], radius=0.1, boundary="fixed")
        np.testing.assert_array_equal(fixed[:30], self.fields[:30, 1])

    def test_given_sub_meshes(self):
        labels = (np.arange(841) % 29) // 10
        given, _ = seamflow.diffuse(self.V, self.F, self.fields, radius=0.1, labels=labels, approach="converged")
        cut, _ = seamflow.diffuse(self.V, self.F, self.fields, radius=0.1, subdomains=3, approach="converged")
        whole, _ = seamflow.diffuse(self.V, self.F, self.fields, radius=0.1, approach="undecomposed")
        self.assertTrue((given != cut).any())
        np.testing.assert_allclose(given, whole, atol=1e-6)
        with self.assertRaisesRegex(ValueError, "labels"):
            seamflow.diffuse(self.V, self.F, self.fields, radius=0.1, labels=labels[:5])

    def test_edges_stay(self):
        step = np.where(self.V[:, 0] > 0.5, 100.0, 0.0)
        kept, _ = seamflow.diffuse(self.V, self.F, step, radius=0.1, keep_edges=5)
        plain, _ = seamflow.diffuse(self.V, self.F, step, radius=0.1)
        self.assertLess(abs(kept - step).max(), 5)
        self.assertGreater(abs(plain - step).max(), 30)

    def test_distances(self):
        self.V[:, 2] = 0
        distance = seamflow.geodesic_distance(self.V, self.F, [0])
        np.testing.assert_allclose(distance, np.hypot(self.V[:, 0], self.V[:, 1]), atol=0.06)
        mask = np.zeros(900, bool)
        mask[0] = True
        np.testing.assert_array_equal(seamflow.geodesic_distance(self.V, self.F, mask, threads=1), distance)
        np.testing.assert_array_equal(seamflow.geodesic_distance(self.V, self.F, 0), distance)
        geodesics = seamflow.Geodesics(self.V, self.F, threads=2)
        for sources in ([400], [0], mask.astype(int), [7, 800]):
            np.testing.assert_array_equal(geodesics.distance(sources),
                                          seamflow.geodesic_distance(self.V, self.F, sources))
        np.testing.assert_array_equal(geodesics.distance(mask.astype(int)), distance)

    def test_range(self):
        V = self.V * [1, 0.1, 0]
        share = (np.arange(900) % 7 == 0).astype(float)
        for steps in (1, 20):
            smooth, _ = seamflow.diffuse(V, self.F, share, fwhm=0.02, steps=steps)
            self.assertGreaterEqual(smooth.min(), 0)
            self.assertLessEqual(smooth.max(), 1)

    def test_refusals(self):
        for keywords, words in (
            ({}, "needs one amount"),
            ({"fwhm": 1, "radius": 1}, "needs one amount"),
            ({"fwhm": 1, "preset": "scan"}, "no preset"),
            ({"fwhm": 1, "within": 0.1}, "no within"),
            ({"fwhm": 1, "region": np.ones(900)}, "no region"),
            ({"fwhm": 1, "progress": print}, "no progress"),
            ({"fwhm": 1, "keep_edges": 0}, "keep_edges is 0, but"),
            ({"fwhm": 1, "boundary": "open"}, "free or fixed"),
            ({"fwhm": 1, "approach": "sweep"}, "sweeps"),
        ):
            with self.subTest(keywords), self.assertRaisesRegex(ValueError, words):
                seamflow.diffuse(self.V, self.F, self.fields, **keywords)
        with self.assertRaisesRegex(ValueError, "7 rows"):
            seamflow.diffuse(self.V, self.F, self.fields[:7], fwhm=1)
        with self.assertRaisesRegex(ValueError, "sources names vertex 900"):
            seamflow.geodesic_distance(self.V, self.F, [900])
        with self.assertRaisesRegex(ValueError, "needs sources"):
            seamflow.geodesic_distance(self.V, self.F)


class SameBits(WithFolder):
    """Every number of the result is that of the program."""

    def test_options(self):
        V, F = self.generate("noisy-sphere", "--vertices", "2000", "--noise", "0.3")
        for keywords, words in (
            ({}, []),
            ({"radius": "1%"}, ["--radius", "1%"]),
            ({"radius": "2%", "subdomains": 6, "plain": False}, ["--radius", "2%", "--subdomains", "6"]),
            ({"time_step_edges": 3, "steps": np.int32(2)}, ["--time-step-edges", "3", "--steps", "2"]),
            (
                {"time_step": np.float64(0.1) / 30, "laplacian": "virtual-refinement", "subdomains": 5},
                ["--time-step", repr(0.1 / 30), "--laplacian", "virtual-refinement", "--subdomains", "5"],
            ),
            (
                {"plain": True, "no_correction": True, "q": None, "radius": 0.1, "subdomains": 3},
                ["--plain", "--no-correction", "--radius", "0.1", "--subdomains", "3"],
            ),
            ({"preset": "fair", "converge": 1e-8}, ["--preset", "fair", "--converge", "1e-8"]),
        ):
            with self.subTest(keywords=keywords):
                smoothed, report = seamflow.smooth(V, np.array(F), **keywords)
                np.testing.assert_array_equal(smoothed, self.smooth_file(*words))
                self.assertEqual(report["vertices"], len(V))
                self.assertEqual(max(report["labels"]) + 1, report["subdomains"])

    def test_polygons_and_arrays(self):
        V, F = self.generate("mixed", "--vertices", "1500")
        self.assertGreater(len({len(face) for face in F}), 2)
        numbers = [700, 3, 41, 3]
        mask = np.zeros(len(V), bool)
        mask[numbers] = True
        labels = np.arange(len(F)) * 4 // len(F)
        weights = np.linspace(0, 2, len(V))
        for name, lines in (("fix", numbers), ("labels", labels), ("weights", [repr(w) for w in weights.tolist()])):
            (self.folder / name).write_text("".join(f"{line}\n" for line in lines))
        fixed = self.smooth_file("--radius", "3%", "--fix", self.folder / "fix")
        for keyword, value in (("fixed", mask), ("fixed", numbers), ("fix", mask), ("fixed", mask.astype(np.uint8))):
            smoothed, _ = seamflow.smooth(V, F, radius="3%", **{keyword: value})
            np.testing.assert_array_equal(smoothed, fixed)
        np.testing.assert_array_equal(fixed[mask], V[mask])
        cut, report = seamflow.smooth(V, F, radius="3%", labels=labels.astype(np.uint8))
        np.testing.assert_array_equal(cut, self.smooth_file("--radius", "3%", "--labels", self.folder / "labels"))
        self.assertEqual(report["subdomains"], 4)
        edges = [[face[0], face[1]] for face in F[:9]]
        (self.folder / "edges").write_text("".join(f"{v} {w}\n" for v, w in edges))
        kept, _ = seamflow.smooth(V, F, preset="cad", edges=edges)
        np.testing.assert_array_equal(kept, self.smooth_file("--edges", self.folder / "edges"))
        attached, _ = seamflow.smooth(V, F, radius="3%", attach_weights=weights)
        words = ["--radius", "3%", "--attach-weights", self.folder / "weights"]
        np.testing.assert_array_equal(attached, self.smooth_file(*words))

    def test_step_by_step(self):
        V, F = self.generate("noisy-sphere", "--vertices", "2000", "--noise", "0.3")
        F = np.array(F)
        for keywords in (
            {"radius": "2%", "steps": 3},
            {"time_step_edges": 2, "steps": 3, "flow": "linear"},
            {"time_step_edges": 2, "steps": 3, "converge": 1e-9, "subdomains": 5, "fixed": [3, 5]},
        ):
            with self.subTest(keywords=keywords):
                expected, report = seamflow.smooth(V.astype(np.float32), F, **keywords)
                flow = seamflow.Flow(V.astype(np.float32), F, **keywords)
                np.testing.assert_array_equal(flow.positions, V.astype(np.float32))
                flow.step()
                self.assertEqual(flow.n_steps, 1)
                self.assertEqual(len(flow.report()["steps"]), 1)
                flow.step(2)
                self.assertEqual(flow.positions.dtype, np.float32)
                np.testing.assert_array_equal(flow.positions, expected)
                own = flow.report()
                self.assertEqual(set(own), set(report))
                for name in ("surface", "remarks", "labels", "choices"):
                    self.assertEqual(own[name], report[name])
                flow.step()
                self.assertEqual(flow.n_steps, 4)
        with self.assertRaisesRegex(ValueError, "n is -1, but has to be a whole number"):
            flow.step(-1)
        with self.assertRaisesRegex(ValueError, "n is 1.5, but has to be a whole number"):
            flow.step(1.5)
        with self.assertRaisesRegex(ValueError, "flow linear takes none"):
            seamflow.Flow(V, F, radius="1%", flow="linear", approach="sweep")
        with self.assertRaisesRegex(ValueError, "^mesh: "):
            seamflow.Flow(V[:5], F, radius="1%")
        with self.assertRaisesRegex(ValueError, "by an amount that is given: give radius, or call smooth"):
            seamflow.Flow(V, F)
        with self.assertRaisesRegex(TypeError, "Flow has no progress"):
            seamflow.Flow(V, F, radius="1%", progress=print)
        with self.assertRaisesRegex(TypeError, "did you mean radius"):
            seamflow.Flow(V, F, radios="1%")
        for copied in (copy.copy, copy.deepcopy, pickle.dumps):
            with self.assertRaisesRegex(TypeError, "a Flow cannot be copied or pickled"):
                copied(flow)
        with self.assertRaisesRegex(ValueError, "read-only"):
            flow.positions[0] = 0
        with seamflow.Flow(V, F, time_step_edges=1) as flow:
            flow.step()
            self.assertEqual(flow.n_steps, 1)
        for n in (0, 1):
            with self.assertRaisesRegex(ValueError, "ended with its with block"):
                flow.step(n)
        flow = seamflow.Flow(V, F, time_step_edges=30, converge=1e-100, subdomains=20)
        flow.step()
        with self.assertWarnsRegex(RuntimeWarning, "the tolerance 1e-100 was missed in 1 step"):
            flow.report()

    def test_changes_between_steps(self):
        V, F = self.generate("noisy-sphere", "--vertices", "3000", "--noise", "0.3")
        F = np.array(F)
        region = np.arange(700, 900)
        mask = np.zeros(len(V), dtype=bool)
        mask[region] = True
        options = {"time_step_edges": 20, "steps": 3, "flow": "linear", "converge": 1e-11, "subdomains": 8}
        flow = seamflow.Flow(V, F, **options)
        flow.hold(region)
        flow.step(3)
        expected, _ = seamflow.smooth(V, F, fixed=region, **options)
        np.testing.assert_allclose(flow.positions, expected, atol=1e-8)
        np.testing.assert_array_equal(flow.positions[region], V[region])
        to = V[region] * 1.1
        flow.move(mask, to)
        np.testing.assert_array_equal(flow.positions[region], to)
        flow.step()
        np.testing.assert_array_equal(flow.positions[region], to)
        flow.release(mask)
        flow.step()
        self.assertGreater(np.abs(flow.positions[region] - to).max(), 1e-3)
        attached = seamflow.Flow(V, F, attach_weights=np.full(len(V), 5.0), **options)
        attached.attach(region, 500.0)
        attached.step(3)
        expected, _ = seamflow.smooth(V, F, attach_weights=np.where(mask, 500.0, 5.0), **options)
        np.testing.assert_allclose(attached.positions, expected, atol=1e-8)
        for wrong, message in (
            (lambda: flow.hold([len(V)]), f"vertices names vertex {len(V)}, but the mesh has {len(V)}"),
            (lambda: flow.hold([0.5]), "mask or numbers of vertices"),
            (lambda: flow.hold(mask[:-1].astype(int)), r"names vertex . \d+ times: .* as vertices.astype\(bool\)"),
            (lambda: flow.hold(mask.astype(int) + 1), r"names vertex . \d+ times"),
            (lambda: flow.hold(mask[:5]), rf"mask or numbers of vertices, \({len(V)},\), but is bool, \(5,\)"),
            (lambda: flow.move(region, to[:5]), "to has to be real numbers"),
            (lambda: flow.attach(region, 1.0), "only a flow with an attachment"),
            (lambda: attached.attach(region, -1.0), "must be at least 0"),
            (lambda: seamflow.Flow(V, F, time_step_edges=1, approach="cg").hold(region), "converged"),
        ):
            with self.assertRaisesRegex(ValueError, message):
                wrong()

    def test_types(self):
        V, F = self.generate("noisy-sphere", "--vertices", "500")
        F = np.array(F)
        single = V.astype(np.float32)
        expected, _ = seamflow.smooth(single.astype(np.float64), F, radius="2%")
        smoothed, _ = seamflow.smooth(single, F.astype(np.int32), radius="2%")
        self.assertEqual(smoothed.dtype, np.float32)
        np.testing.assert_array_equal(smoothed, expected.astype(np.float32))
        before = V.copy()
        for vertices, faces in ((V, F.astype(np.int32)), (V.tolist(), F.tolist()), (np.asfortranarray(V), F[:, ::1])):
            smoothed, _ = seamflow.smooth(vertices, faces, radius="2%")
            self.assertEqual(smoothed.dtype, np.float64)
            np.testing.assert_array_equal(smoothed, seamflow.smooth(V, F, radius="2%")[0])
        np.testing.assert_array_equal(V, before)
        for faces in (F.astype(np.float64), F.astype(np.float32), [[float(v) for v in face] for face in F]):
            np.testing.assert_array_equal(seamflow.smooth(V, faces, radius="2%")[0], smoothed)
        # Few small numbers are numbers, whatever their type.
        for numbers in (np.array([1, 0], np.uint8), np.array([2, 3, 2], np.uint8)):
            held, _ = seamflow.smooth(V, F, radius="2%", fixed=numbers)
            np.testing.assert_array_equal(held, seamflow.smooth(V, F, radius="2%", fixed=numbers.astype(int))[0])

    def test_report_and_signature(self):
        V, F = np.array(CUBE, float), SIDES
        _, report = seamflow.smooth(V, F, radius=0.5)
        self.assertEqual(json.loads(json.dumps(report)), report)
        self.assertEqual(len(report["labels"]), len(F))
        keywords = inspect.signature(seamflow.smooth).parameters
        for keyword in ("V", "F", "fixed", "labels", "radius", "keep_edges", "threads", "converge"):
            self.assertIn(keyword, keywords)
        self.assertNotIn("options", keywords)

    def test_mesh_objects(self):
        V, F = np.array(CUBE, float), SIDES
        expected, _ = seamflow.smooth(V, F, radius=0.5)
        self.assertLess(np.abs(expected - 0.5).max(), 0.5)
        quads = SimpleNamespace(type="quad", data=np.array(F))
        edges = SimpleNamespace(type="line", data=np.array([[0, 1]]))
        for mesh in (
            SimpleNamespace(vertices=V, faces=np.array(F)),
            SimpleNamespace(points=V, cells=[edges, quads]),
            SimpleNamespace(points=V, cells=[SimpleNamespace(type="quad", data=np.array([face])) for face in F]),
        ):
            np.testing.assert_array_equal(seamflow.smooth(mesh, radius=0.5)[0], expected)
        with self.assertRaisesRegex(ValueError, "cells of type tetra"):
            seamflow.smooth(SimpleNamespace(points=V, cells=[SimpleNamespace(type="tetra", data=np.array(F))]))


def needs(module):
    """Leaves out a test where a package is missing, saying so."""
    return unittest.skipUnless(importlib.util.find_spec(module), f"{module} is not installed")


class ObjectsOfOtherPackages(unittest.TestCase):
    """Each is smoothed, gets its positions back by the line in python.md, and then has them."""

    TRIANGLES = np.array([face[:3] for face in SIDES] + [[face[0], *face[2:]] for face in SIDES], np.int32)

    def setUp(self):
        self.V = np.array(CUBE, np.float32) + np.float32(0.125)
        self.expected = {kind: seamflow.smooth(self.V.astype(kind), self.TRIANGLES, radius=0.5)[0]
                         for kind in (np.float32, np.float64)}
        self.assertGreater(np.abs(self.expected[np.float64] - self.V).max(), 0.05)

    def smoothed(self, mesh, kind):
        V2, report = seamflow.smooth(mesh, radius=0.5)
        self.assertEqual(V2.dtype, kind)
        self.assertEqual(len(report["labels"]), 12)
        np.testing.assert_array_equal(V2, self.expected[kind])
        return V2

    @needs("open3d")
    def test_open3d(self):
        import open3d

        mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(self.V.astype(float)),
                                            open3d.utility.Vector3iVector(self.TRIANGLES))
        V2 = self.smoothed(mesh, np.float64)
        np.testing.assert_array_equal(np.asarray(mesh.vertices), self.V)
        mesh.vertices = open3d.utility.Vector3dVector(V2)
        np.testing.assert_array_equal(np.asarray(mesh.vertices), V2)

    @needs("open3d")
    def test_open3d_tensors(self):
        import open3d

        mesh = open3d.t.geometry.TriangleMesh(open3d.core.Tensor(self.V), open3d.core.Tensor(self.TRIANGLES))
        V2 = self.smoothed(mesh, np.float32)
        mesh.vertex["positions"] = open3d.core.Tensor(V2)
        np.testing.assert_array_equal(mesh.vertex["positions"].numpy(), V2)

    @staticmethod
    def poly_data(V, faces):
        import vtk
        from vtk.util.numpy_support import numpy_to_vtk

        mesh = vtk.vtkPolyData()
        points = vtk.vtkPoints()
        points.SetData(numpy_to_vtk(V, deep=True))
        mesh.SetPoints(points)
        lines, cells = vtk.vtkCellArray(), vtk.vtkCellArray()
        lines.InsertNextCell(2, [0, 1])
        mesh.SetLines(lines)
        for face in faces:
            cells.InsertNextCell(len(face), [int(v) for v in face])
        mesh.SetPolys(cells)
        return mesh

    @needs("vtk")
    def test_vtk(self):
        from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

        for kind in (np.float32, np.float64):
            mesh = self.poly_data(self.V.astype(kind), self.TRIANGLES)
            V2 = self.smoothed(mesh, kind)
            mesh.GetPoints().SetData(numpy_to_vtk(V2, deep=True))
            np.testing.assert_array_equal(vtk_to_numpy(mesh.GetPoints().GetData()), V2)

    @needs("vtk")
    def test_vtk_polygons(self):
        mixed = [list(SIDES[0][:3]), [SIDES[0][0], *SIDES[0][2:]], *[list(face) for face in SIDES[1:]]]
        V = self.V.astype(float)
        for faces in (mixed, SIDES):
            np.testing.assert_array_equal(seamflow.smooth(self.poly_data(V, faces), radius=0.5)[0],
                                          seamflow.smooth(V, [list(face) for face in faces], radius=0.5)[0])
        with self.assertRaisesRegex(ValueError, "no faces"):
            seamflow.smooth(self.poly_data(V, []), radius=0.5)
        strips = self.poly_data(V, SIDES)
        strips.SetStrips(strips.GetPolys())
        with self.assertRaisesRegex(ValueError, "vtkTriangleFilter"):
            seamflow.smooth(strips, radius=0.5)

    @needs("pyvista")
    def test_pyvista(self):
        import pyvista

        mesh = pyvista.PolyData(self.V, np.insert(self.TRIANGLES, 0, 3, axis=1).ravel())
        V2 = self.smoothed(mesh, np.float32)
        mesh.points = V2
        np.testing.assert_array_equal(mesh.points, V2)

    @needs("nibabel")
    def test_nibabel(self):
        from nibabel.gifti import GiftiDataArray, GiftiImage

        surface = GiftiImage(darrays=[GiftiDataArray(self.V, intent="NIFTI_INTENT_POINTSET"),
                                      GiftiDataArray(self.TRIANGLES, intent="NIFTI_INTENT_TRIANGLE")])
        V2 = self.smoothed(surface, np.float32)
        surface.get_arrays_from_intent("NIFTI_INTENT_POINTSET")[0].data = V2
        np.testing.assert_array_equal(surface.agg_data("pointset"), V2)

        columns = np.stack([self.V[:, 0], self.V[:, 1] ** 2], axis=-1)
        arrays = [GiftiDataArray(np.ascontiguousarray(column), intent="NIFTI_INTENT_SHAPE") for column in columns.T]
        for data, fields in ((GiftiImage(darrays=arrays), columns), (GiftiImage(darrays=arrays[1:]), columns[:, 1])):
            expected, _ = seamflow.diffuse(V2, self.TRIANGLES, fields, fwhm=0.5)
            smooth, _ = seamflow.diffuse(surface, None, data, fwhm=0.5)
            np.testing.assert_array_equal(smooth, expected)
            self.assertGreater(np.abs(smooth - fields).max(), 0.01)
        with self.assertRaisesRegex(ValueError, "0 arrays of intent NIFTI_INTENT_POINTSET"):
            seamflow.smooth(data, radius=0.5)


class Seams(unittest.TestCase):
    def test_weld(self):
        V = np.array(CUBE, float)[np.array(SIDES).ravel()]
        F = np.arange(24).reshape(6, 4)
        joined, report = seamflow.smooth(V, F, radius=0.5)
        expected, _ = seamflow.smooth(np.array(CUBE, float), SIDES, radius=0.5)
        # Vertices are numbered otherwise.
        np.testing.assert_allclose(joined, expected[np.array(SIDES).ravel()], rtol=1e-12)
        self.assertIn("24 vertices along seams", " ".join(remark["text"] for remark in report["remarks"]))
        apart, _ = seamflow.smooth(V, F, radius=0.5, weld="never")
        np.testing.assert_array_equal(apart, V)
        V[0] += 1e-6
        near, _ = seamflow.smooth(V, F, radius=0.5, weld="0.01%")
        np.testing.assert_allclose(near, joined, atol=1e-5)


class WrongInput(unittest.TestCase):
    def test_sentences(self):
        V = np.array(CUBE, float)
        nan = V.copy()
        nan[5, 1] = np.nan
        for error, sentence, arguments, keywords in (
            (ValueError, r'^radius: "wide" is neither a positive length', (V, SIDES), {"radius": "wide"}),
            (ValueError, r'^steps: "-1" is not a whole number', (V, SIDES), {"steps": -1}),
            (ValueError, r'"cubic" is not one of fujiwara', (V, SIDES), {"laplacian": "cubic"}),
            (ValueError, "radius", (V, SIDES), {"radius": 1, "time_step": 1}),
            (ValueError, "^overlap is for conditions schwarz", (V, SIDES), {"overlap": 2, "radius": 1}),
            (ValueError, "fix holds some", (V, SIDES), {"fixed": [0], "rescale": "area", "radius": 1}),
            (ValueError, "labels", (V, SIDES), {"labels": [0] * 6, "subdomains": 2, "radius": 1}),
            (TypeError, r"no keyword radios, did you mean radius\?", (V, SIDES), {"radios": 1}),
            (TypeError, "no keyword qqqqqq; there are .*labels.*radius", (V, SIDES), {"qqqqqq": 1}),
            (ValueError, "threads is 65537, but must be at least 0 and at most 1024", (V, SIDES), {"threads": 65537, "radius": 1}),
            (ValueError, "F has to be whole numbers", (V, np.array(SIDES) + 0.5), {"radius": 1}),
            (ValueError, "face 1 .* list of whole numbers", (V, [[0, 1, 2], [0.5, 1, 2]]), {"radius": 1}),
            (ValueError, "F has to be whole numbers", (V, np.array(SIDES) * np.nan), {"radius": 1}),
            (ValueError, rf"face 2 .* names vertex {2**64 - 1}, which no mesh has",
             (V, np.array([[0, 1, 3], [0, 1, 2], [0, 2**64 - 1, 1]], np.uint64)), {"radius": 1}),
            (ValueError, rf"face 1 .* names vertex {2**63}, which no mesh has",
             (V, [np.array([0, 1, 3, 2], np.int64), np.array([0, 2**63, 1], np.uint64)]), {"radius": 1}),
            (ValueError, r"F has to have a face in each row, but is \(3, 12\), .* the mesh, 8: transpose F",
             (V, np.array([[q[0], q[k], q[k + 1]] for q in SIDES for k in (1, 2)]).T), {"radius": 1}),
            (TypeError, "no keyword fix_property", (V, SIDES), {"fix_property": "a"}),
            (TypeError, "plain is True or False", (V, SIDES), {"plain": 1}),
            (TypeError, "radius is a number or a text", (V, SIDES), {"radius": [1]}),
            (TypeError, "within is a number, three numbers or a text", (V, SIDES), {"within": [1, 1]}),
            (ValueError, "is neither a positive length", (V, SIDES), {"within": [1, 1, 0]}),
            (TypeError, "fixed and fix are the same", (V, SIDES), {"fixed": [0], "fix": [0]}),
            (ValueError, "fixed names vertex 8, but the mesh has 8", (V, SIDES), {"fixed": [8]}),
            (ValueError, r"fixed has to be a mask .*\(8,\), but is bool, \(7,\)", (V, SIDES), {"fixed": [True] * 7}),
            (ValueError, r"labels has to be .*\(6,\)", (V, SIDES), {"labels": [0] * 5}),
            (ValueError, r"labels\[1\] is -1", (V, SIDES), {"labels": [0, -1, 0, 0, 0, 0]}),
            (ValueError, "edges has to be pairs", (V, SIDES), {"keep_edges": 30, "edges": [0, 1]}),
            (ValueError, "edges has to name vertices from 0 to 7", (V, SIDES), {"keep_edges": 30, "edges": [[0, 8]]}),
            (ValueError, r"attach_weights\[2\] is nan", (V, SIDES), {"attach_weights": [0, 1, np.nan, 0, 0, 0, 0, 0]}),
            (ValueError, r"V has to be real numbers, \(#V, 3\), but is float64, \(8, 2\)", (V[:, :2], SIDES), {}),
            (ValueError, "mesh: vertex 5 .* not a finite number", (nan, SIDES), {}),
            (ValueError, "F has no faces", (V, []), {}),
            (ValueError, "fixed has 0 or 7 for each vertex: give a mask as fixed.astype", (V, SIDES), {"fixed": [0, 7] * 4}),
            (ValueError, "mesh: has no vertices", (np.zeros((0, 3)), []), {}),
            (ValueError, "mesh: face 1 .* names vertex 8, but the mesh has 8", (V, [[0, 1, 2], [0, 8, 1]]), {}),
            (ValueError, f"mesh: face 1 .* names vertex {2**40}", (V, np.array([[0, 1, 2], [0, 1, 2**40]])), {}),
            (ValueError, "mesh: face 0 .* names vertex -1", (V, [[0, 1, -1]]), {}),
            (ValueError, "mesh: face 0 .* has 2 corners", (V, [[0, 1]]), {}),
            (ValueError, "face 1 .* list of whole numbers", (V, [[0, 1, 2], [0, 1, 2.5]]), {}),
            (ValueError, "the mesh has no size to measure a radius by", (np.zeros((3, 3)), [[0, 1, 2]]), {"radius": "1%"}),
            (TypeError, "V and F are needed, or a mesh", (V,), {}),
        ):
            with self.subTest(sentence=sentence):
                with self.assertRaisesRegex(error, sentence):
                    seamflow.smooth(*arguments, **keywords)


class Running(WithFolder):
    def setUp(self):
        super().setUp()
        self.V, self.F = self.generate("noisy-sphere", "--vertices", "2000")

    def test_progress(self):
        heard = []
        seamflow.smooth(self.V, self.F, radius="1%", steps=4, progress=heard.append)
        self.assertEqual(heard[0], seamflow.Progress("cut", 0, 4, 0.0))
        self.assertEqual((heard[-1].step, heard[-1].steps, heard[-1].fraction), (4, 4, 1.0))
        self.assertEqual(heard, sorted(heard, key=lambda progress: progress.fraction))

    def test_what_progress_raises(self):
        class Enough(Exception):
            pass

        def stop(progress):
            if progress.step == 2:
                raise Enough(threading.current_thread() is threading.main_thread())

        with self.assertRaisesRegex(Enough, "True"):
            seamflow.smooth(self.V, self.F, time_step_edges=0.01, steps=1_000_000_000, progress=stop)

    def test_a_computation_that_fails(self):
        with self.assertRaisesRegex(RuntimeError, r"step \d+, sub-mesh \d+, vertex \d+ would move by"):
            seamflow.smooth(self.V, self.F, time_step_edges=30, steps=60, subdomains=20, plain=True, no_correction=True)

    def test_a_tolerance_that_is_missed(self):
        with self.assertWarnsRegex(RuntimeWarning, "the tolerance 1e-100 was missed in 2 steps"):
            seamflow.smooth(self.V, self.F, time_step_edges=2, steps=2, subdomains=12, converge=1e-100)

    def test_keyboard_interrupt(self):
        # Sent by a thread that runs only where the flow has let go of the GIL.
        for keywords in ({}, {"subdomains": 4}):
            timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            with self.assertRaises(KeyboardInterrupt):
                seamflow.smooth(self.V, self.F, time_step_edges=0.01, steps=1_000_000_000, **keywords)
            timer.join()
        seamflow.smooth(self.V, self.F, radius="1%")

    def test_keyboard_interrupt_of_flow(self):
        flow = seamflow.Flow(self.V, self.F, time_step_edges=0.01)
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            flow.step(1_000_000_000)
        timer.join()
        taken = flow.n_steps
        self.assertGreater(taken, 0)
        flow.step()
        self.assertEqual(flow.n_steps, taken + 1)
        expected = seamflow.Flow(self.V, self.F, time_step_edges=0.01)
        expected.step(taken + 1)
        np.testing.assert_array_equal(flow.positions, expected.positions)

    def test_keyboard_interrupt_of_fields(self):
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            seamflow.diffuse(self.V, self.F, self.V, time_step_edges=0.01, steps=1_000_000_000)
        timer.join()
        # Long enough that a signal is heard in the middle, and not at the end.
        V = np.array([[x, y, 0] for x in range(400) for y in range(400)], float)
        first = np.arange(160000).reshape(400, 400)[:-1, :-1].reshape(-1, 1)
        F = first + [0, 400, 401, 1]
        heard = []
        before = signal.signal(signal.SIGINT, lambda *_: heard.append(time.monotonic()))
        try:
            timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            begin = time.monotonic()
            seamflow.geodesic_distance(V, F, [0])
            end = time.monotonic()
            timer.join()
        finally:
            signal.signal(signal.SIGINT, before)
        self.assertEqual(len(heard), 1)
        self.assertLess(heard[0], 0.5 * (begin + end))


class Described(unittest.TestCase):
    def test_every_option_of_the_program(self):
        text = subprocess.run([SMOOTH, "--help-all"], check=True, capture_output=True, text=True).stdout
        stub = (pathlib.Path(seamflow.__file__).parent / "__init__.pyi").read_text()
        compile(stub, "__init__.pyi", "exec")
        of_files = {"help", "help-all", "version", "every-step", "parts", "report", "csv", "trace", "task-graph", "html", "checkpoint"}
        of_files |= {"checkpoint-every", "quiet", "verbose", "fix", "fix-property", "attach-property", "keep-gaps"}
        of_files |= {"edges", "edges-from-file", "region-property"}
        # Of the functions for fields.
        of_files |= {"fields", "fwhm", "fill", "keep-field-edges", "from", "out-dir"}
        headings = [line.strip().split("  ")[0] for line in text.splitlines() if line.strip().startswith("--")]
        named = {word.strip(",")[2:] for heading in headings for word in heading.split() if word.startswith("--")} - of_files
        self.assertGreater(len(named), 30)
        for name in named:
            keyword = name.replace("-", "_")
            self.assertIn(f"    {keyword}:", seamflow.smooth.__doc__)
            self.assertIn(f"    {keyword}: ", stub)


if __name__ == "__main__":
    warnings.simplefilter("error")
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
