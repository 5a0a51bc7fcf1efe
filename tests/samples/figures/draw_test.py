"""The curves and surfaces of `figures`: python3 draw_test.py FIGURES"""

import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

FIGURES = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(pathlib.Path(__file__).parents[3] / "samples" / "figures"))

import draw  # noqa: E402


def setUpModule():
    draw.use_style()


def row(laplacian, conditions, step, **more):
    """Of a table, as a file has it."""
    made = {"figure": "wavy-cylinder", "laplacian": laplacian, "conditions": conditions, "subdomains": 2, "step": step,
            "options": "plain", "cut": "none" if conditions == "undecomposed" else "lower half in z", "dt": 0.05,
            "area": 60, "leading": 0, "authors_v_mean": "nan", "authors_v_max": "nan"}
    made.update({f"{q}_{kind}": 0.01 * step for q in "vh" for kind in ("mean", "rms", "max")})
    return {name: str(value) for name, value in {**made, **more}.items()}


def wavy_rows(steps=5):
    flows = [("fujiwara", "undecomposed"), ("fujiwara", "adapted-robin"), ("ptackova-velho", "adapted-robin"),
             ("fujiwara", "schwarz"), ("ptackova-velho", "schwarz")]
    return [row(*flow, step) for flow in flows for step in range(1, steps + 1)]


def many_rows():
    rows = [row("fujiwara", "undecomposed", step, subdomains=1) for step in (1, 2)]
    for number in (2, 4, 8, 16, 32):
        for options in ("plain", "default"):
            rows += [row("fujiwara", "adapted-robin", step, subdomains=number, options=options,
                         cut=f"METIS, {number} parts") for step in (1, 2)]
    return rows


def lines_of(panel):
    return {line.get_label(): line for line in panel.get_lines()}


class Curves(unittest.TestCase):
    def test_a_panel_for_each_decomposed_flow(self):
        panels = draw.curves_by_step(wavy_rows()).axes
        self.assertEqual([panel.get_title(loc="left") for panel in panels],
                         [rf"$\Delta_{symbol}$ in two sub-meshes, {conditions}"
                          for conditions in ("adapted Robin", "Schwarz") for symbol in "FP"])
        for panel in panels:
            self.assertEqual(set(lines_of(panel)),
                             {rf"${q}_\mathrm{{{kind}}}$" for q in "VH" for kind in ("max", "RMS", "mean")})
            self.assertEqual(panel.get_xlabel(), "step")
            self.assertEqual(panel.get_yscale(), "log")
            np.testing.assert_allclose(lines_of(panel)[r"$V_\mathrm{max}$"].get_xdata(), range(1, 6))
            np.testing.assert_allclose(lines_of(panel)[r"$H_\mathrm{mean}$"].get_ydata(), 0.01 * np.arange(1, 6))
        self.assertEqual(panels[0].get_ylabel(), "distance / mean edge length")

    def test_the_legend_has_every_curve_once(self):
        figure = draw.curves_by_step(wavy_rows())
        explained = [text.get_text() for text in figure.legends[0].get_texts()]
        self.assertEqual(sorted(explained), sorted(lines_of(figure.axes[0])))

    def test_a_legend_wider_than_the_plot_is_seen_whole(self):
        rows = [row("fujiwara", "adapted-robin", step, authors_v_mean="0.2", authors_v_max="1") for step in range(1, 6)]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.svg"
            draw.save(draw.curves_by_step(rows), path)
            points = float(re.search(r'width="([0-9.]+)pt"', path.read_text())[1])
        self.assertGreater(points, 1.2 * 72 * draw.PANEL[0])

    def test_the_authors_numbers_are_marked_on_their_mesh(self):
        rows = wavy_rows()
        for one in rows:
            if one["conditions"] != "undecomposed":
                # Of Schwarz the largest distances are not known.
                one["authors_v_mean"], one["authors_v_max"] = "0.2", "nan" if one["conditions"] == "schwarz" else "5e4"
        figure = draw.curves_by_step(rows)
        marks = [line for panel in figure.axes for label, line in lines_of(panel).items() if "authors" in label]
        self.assertEqual(len(marks), 4)
        self.assertEqual(sum(np.isfinite(mark.get_ydata()).sum() for mark in marks), 6)
        for mark in marks:
            np.testing.assert_allclose(mark.get_xdata(), 5)
        # However far they are from ours.
        self.assertEqual(figure.axes[0].get_ylim()[1], 1e5)
        self.assertEqual(sum("authors" in text.get_text() for text in figure.legends[0].get_texts()), 1)

    def test_a_gap_where_there_is_no_number(self):
        rows = wavy_rows()
        rows[7]["v_mean"], rows[8]["v_mean"] = "nan", "0"
        ys = lines_of(draw.curves_by_step(rows).axes[0])[r"$V_\mathrm{mean}$"].get_ydata()
        self.assertEqual([math.isnan(y) for y in ys], [False, False, True, True, False])

    def test_none_without_two_steps_or_a_decomposed_flow(self):
        self.assertIsNone(draw.curves_by_step(wavy_rows(steps=1)))
        self.assertIsNone(draw.curves_by_step(wavy_rows()[:5]))

    def test_many_sub_meshes_have_a_panel_for_each_way_of_taking_steps(self):
        for curves, mesh in (draw.curves_over_number, "wavy-cylinder"), (draw.curves_over_width, "all meshes"):
            panels = curves(many_rows()).axes
            self.assertEqual([panel.get_title(loc="left") for panel in panels],
                             [f"{mesh}, the paper's method", f"{mesh}, the library's defaults"])
            for panel in panels:
                lines = lines_of(panel)
                self.assertEqual(set(lines), {rf"$\Delta_F$, $V_\mathrm{{{kind}}}$" for kind in ("mean", "max")})
                for line in lines.values():
                    np.testing.assert_allclose(line.get_ydata(), [0.02] * 5)
        numbers = lines.popitem()[1].get_xdata()
        np.testing.assert_allclose(numbers, np.sqrt(0.05 * np.array([2, 4, 8, 16, 32]) / 60))

    def test_a_flow_with_many_sub_meshes_that_ended_early_leaves_a_gap(self):
        # After its first step, and before.
        for step in 1, 0:
            rows = [one for one in many_rows()
                    if (one["subdomains"], one["options"]) != ("8", "default") or int(one["step"]) <= step]
            for curves in draw.curves_over_number, draw.curves_over_width:
                lines = [line for panel in curves(rows).axes for line in panel.get_lines()]
                self.assertEqual([np.isnan(line.get_ydata()).tolist() for line in lines],
                                 2 * [[False] * 5] + 2 * [[False, False, True, False, False]])

    def test_flows_with_many_sub_meshes_may_all_have_ended_early(self):
        rows = [one for one in many_rows() if one["conditions"] == "undecomposed" or one["step"] == "1"]
        self.assertEqual(draw.curves_over_number(rows).axes, [])


def pixels(figure):
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    figure.patch.set_alpha(0)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())


class Surfaces(unittest.TestCase):
    # A large triangle below a small one, seen aslant from above.
    points = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0], [-0.2, -0.4, 0.1], [0.2, -0.4, 0.1], [0, 0, 0.1]], float)
    faces = [np.array([3, 4, 5]), np.array([0, 1, 2])]
    colours = np.array([[0.8, 0, 0], [0, 0, 0.8]])

    def image(self, points, **colours):
        values = np.column_stack([points, np.full(len(points), 0.53)])
        return pixels(draw.surface(draw.View(self.points), values, self.faces, **colours))

    def test_what_is_nearest_is_seen(self):
        image = self.image(self.points, colours=self.colours)
        self.assertEqual(image.shape[:2], draw.View(self.points).size[::-1])

        def at(point):
            x, y, _ = draw.View(self.points).seen(np.array([point]))[0]
            return image[int(y), int(x)]

        upper, lower = at([0, -0.25, 0.1]), at([0.5, -0.8, 0])
        self.assertGreater(upper[0], 100)
        self.assertLess(upper[2], 20)
        self.assertEqual(upper[3], 255)
        self.assertGreater(lower[2], 100)
        self.assertLess(lower[0], 20)
        self.assertEqual(lower[3], 255)
        self.assertEqual(image[0, 0, 3], 0)

    def test_lines_of_equal_height_are_dark(self):
        # The height of the large triangle grows from its lowest edge to its corner.
        view = draw.View(self.points)
        image = pixels(draw.surface(view, np.column_stack([self.points, (self.points[:, 1] + 1) / 2]), self.faces[1:]))

        def at(height):
            x, y, _ = view.seen(np.array([[0, 2 * height - 1, 0]]))[0]
            return image[int(y), int(x)].astype(float)

        # In the middle of the rainbow, which is green.
        line, beside = at(8 / draw.LEVELS), at(8.5 / draw.LEVELS)
        self.assertGreater(beside[1], 100)
        self.assertLess(beside[[0, 2]].max(), beside[1] / 2)
        self.assertAlmostEqual(line[1], draw.DARK * beside[1], delta=10)
        self.assertEqual((line[3], beside[3]), (255, 255))

    def test_far_and_missing_corners_do_no_harm(self):
        towards_the_eye = self.points[0] + 1e6 * draw.View(self.points).axes[:, 2]
        for far in [-1e9, -1e9, 0], [-1e200, -1e200, 0], [np.nan, -1, 0], [-np.inf, -1, 0], towards_the_eye:
            points = self.points.copy()
            points[0] = far
            self.assertEqual(self.image(points).shape, self.image(self.points).shape)
        self.assertFalse(self.image(np.full((6, 3), np.nan))[..., 3].any())
        self.assertFalse(pixels(draw.surface(draw.View(self.points), np.zeros((6, 4)), []))[..., 3].any())

    def test_the_texture_is_a_rainbow_with_lines_of_equal_height(self):
        np.testing.assert_allclose(draw.rainbow(np.array([0, 0.125, 0.5, 1, 7, -1])),
                                   [[0, 0, 1], [0, 0.5, 1], [0, 1, 0], [1, 0, 0], [1, 0, 0], [0, 0, 1]])
        corners = np.array([[[0, 0], [1, 0], [0, 1]]], float)
        polygons, owners = draw.lines_of_height(corners, np.array([[0.0, 1.0, 1.0]]))
        self.assertEqual(len(polygons), draw.LEVELS + 1)
        self.assertEqual(set(owners), {0})
        # Height is x + y here.
        for level, heights in enumerate(polygons.sum(axis=2)):
            middle, half = level / draw.LEVELS, draw.LINE / draw.LEVELS / 2
            np.testing.assert_allclose([heights.min(), heights.max()], np.clip([middle - half, middle + half], 0, 1),
                                       atol=1e-12)
        self.assertEqual(len(draw.lines_of_height(corners, np.array([[0.01, 0.02, 0.03]]))[0]), 0)

    def test_faces_of_more_corners_are_fans_around_their_centres(self):
        square = np.array([[0, 0, 0, 0], [1, 0, 0, 0], [1, 1, 0, 1], [0, 1, 0, 1]], float)
        triangles, face_of = draw.triangles_of(square, [np.array([0, 1, 2, 3]), np.array([0, 1, 2])])
        self.assertEqual(sorted(face_of), [0, 0, 0, 0, 1])
        for corners in triangles[face_of == 0]:
            np.testing.assert_allclose(corners[0], [0.5, 0.5, 0, 0.5])
        np.testing.assert_allclose(triangles[face_of == 1], [square[:3]])

    def test_an_overlap_is_the_layer_of_faces_around_the_sub_mesh_that_leads(self):
        faces = [np.array([v, v + 1, v + 12, v + 11]) for v in range(109) if v % 11 < 10]
        labels = np.repeat([0, 1], 50)
        for leading in 0, 1:
            grown = draw.with_overlap(faces, labels, leading)
            self.assertEqual(((grown == 2).sum(), (grown == leading).sum()), (10, 50))

    def test_a_picture_is_written_whole_or_not_at_all(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = draw.surface(draw.View(self.points), np.column_stack([self.points, np.zeros(6)]), self.faces)
            missing, taken = pathlib.Path(folder) / "none" / "a.png", pathlib.Path(folder) / "b.png"
            taken.mkdir()
            for path, reason in (missing, "No such file or directory"), (taken, "Is a directory"):
                with self.assertRaises(SystemExit) as end:
                    draw.save(picture, path)
                self.assertEqual(end.exception.code, f"{path}: cannot be written: {reason}")
            draw.save(picture, pathlib.Path(folder) / "a.png")
            self.assertEqual(sorted(path.name for path in pathlib.Path(folder).iterdir()), ["a.png", "b.png"])


class Results(unittest.TestCase):
    def test_figures_draws_everything_and_the_script_draws_the_same_again(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name) / "results"
            folder.mkdir()
            # What Python and Matplotlib would else find.
            for module in "csv", "matplotlib", "numpy":
                (pathlib.Path(name) / f"{module}.py").write_text("raise ValueError\n")
            subprocess.run([FIGURES, "--out", folder, "schwarz"], check=True, stdout=subprocess.DEVNULL, cwd=name,
                           env={**os.environ, "MPLBACKEND": "nonsense"})
            drawn = {path.name: path.read_bytes() for path in folder.iterdir() if path.suffix in (".png", ".svg")}
            self.assertEqual(set(drawn), {
                "schwarz-curves.svg", "schwarz-cut.png", "schwarz-input.png", "schwarz-part.png",
                "schwarz-ptackova-velho-schwarz.png", "schwarz-ptackova-velho-undecomposed.png"})
            for file, content in drawn.items():
                self.assertTrue(content.startswith(b"<?xml" if file.endswith("svg") else b"\x89PNG\r\n\x1a\n"), file)
                self.assertNotIn(b"nan", content.lower() if file.endswith("svg") else b"")
                (folder / file).unlink()
            # The whole folder, in another place, among files of others.
            moved = folder.rename(folder.with_name("results moved"))
            (moved / "csv.py").write_text("raise ValueError\n")
            (moved / "other.csv").write_text("a,b\n1,2\n")
            self.without_heights(moved / "schwarz-input.ply", moved / "schwarz-other.ply")
            subprocess.run([sys.executable, "-B", moved / "draw.py"], check=True)
            self.assertEqual({file: (moved / file).read_bytes() for file in drawn}, drawn)
            self.assertFalse((moved / "schwarz-other.png").exists())
            self.add_a_vertex_without_faces(moved / "schwarz-input.ply")
            subprocess.run([sys.executable, "-B", moved / "draw.py", "schwarz"], check=True)
            self.assertEqual({file: (moved / file).read_bytes() for file in drawn}, drawn)
            for other in "none", "other":
                ended = subprocess.run([sys.executable, "-B", moved / "draw.py", other], capture_output=True, text=True)
                self.assertEqual((ended.returncode, ended.stderr), (1, f"there is no table {other}.csv in {moved}\n"))

    def test_a_python_without_matplotlib_draws_nothing(self):
        with tempfile.TemporaryDirectory() as name:
            python = pathlib.Path(name) / "python3"
            python.write_text(f'#!/bin/sh\nexec "{sys.executable}" -S "$@"\n')
            python.chmod(0o755)
            environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
            ended = subprocess.run([FIGURES, "--out", "results", "schwarz"], check=True, capture_output=True, text=True,
                                   cwd=name, env={**environment, "PATH": name})
            self.assertIn("The pictures were not drawn", ended.stdout)
            self.assertEqual(ended.stderr, "")
            self.assertEqual(list((pathlib.Path(name) / "results").glob("*.png")), [])

    def test_a_check_says_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            # Matplotlib warns of a name that it does not know.
            (pathlib.Path(folder) / "matplotlibrc").write_text("nonsense: 1\n")
            for options, status in (["-B"], 0), (["-B", "-S"], 1):
                ended = subprocess.run([sys.executable, *options, draw.__file__, "--check"], cwd=folder,
                                       env={**os.environ, "PYTHONPATH": ""}, capture_output=True, text=True)
                self.assertEqual((ended.returncode, ended.stdout, ended.stderr), (status, "", ""))

    def test_without_matplotlib_the_script_says_what_to_install(self):
        # Python without any package, and with what stands in for NumPy alone.
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "numpy.py").write_text("def array(*_):\n    return 0\n")
            for path in "", folder:
                ended = subprocess.run([sys.executable, "-B", "-S", draw.__file__], env={"PYTHONPATH": path},
                                       capture_output=True, text=True)
                self.assertEqual((ended.returncode, ended.stderr), (1, draw.MISSING + "\n"))

    def without_heights(self, path, copy):
        head, body = path.read_bytes().split(b"end_header\n", 1)
        self.assertIn(b" height\n", head)
        copy.write_bytes(head.replace(b" height\n", b" other\n") + b"end_header\n" + body)

    def add_a_vertex_without_faces(self, path):
        """Far from the others. It changes nothing."""
        vertex, _ = draw.read_ply(path)
        head, body = path.read_bytes().split(b"end_header\n", 1)
        head = head.replace(f"element vertex {len(vertex)}".encode(), f"element vertex {len(vertex) + 1}".encode())
        far = vertex[:1].copy()
        far["x"], far["z"], far["height"] = 1000, 500, 500
        size = vertex.nbytes
        path.write_bytes(head + b"end_header\n" + body[:size] + far.tobytes() + body[size:])


if __name__ == "__main__":
    unittest.main()
