#!/usr/bin/env python3
"""Makes the pictures of samples/gallery.md: before | after, each by the one command that stands beside it.

    samples/gallery/make_gallery.py [--programs build/bin] [--out samples/gallery/pictures] [NAME…]

Needs the programs, NumPy, and ../figures/draw.py. All meshes are generated, so that anybody gets the same pictures.
"""

import argparse
import pathlib
import shlex
import subprocess
import sys
import tempfile
import zlib

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "figures"))
sys.dont_write_bytecode = True
from draw import read_ply  # noqa: E402

HALF = 400  # pixels: the width of each of the two pictures
SAMPLES = 2  # along each side of a pixel
MOST_BYTES = 150_000  # of a picture
PAGE = pathlib.Path(__file__).parent.parent / "gallery.md"
RAMP = np.array([[48, 59, 142], [42, 129, 171], [94, 187, 142], [228, 208, 96], [206, 80, 62]], float)
CLAY = np.array([206, 190, 164], float)
HIGHLIGHT = np.array([120, 160, 200], float)
MISSING = np.array([150, 150, 150], float)


class Mesh:
    """A binary PLY file as the programs write it: columns of the vertices, lists of corners, columns of the faces."""

    def __init__(self, path):
        self.vertex, columns = read_ply(path)
        corners = columns.pop("vertex_indices")
        self.points = np.stack([self.vertex[c] for c in "xyz"], axis=1).astype(float)
        self.triangles = np.array([(f[0], f[k], f[k + 1]) for f in corners for k in range(1, len(f) - 1)], int)
        self.face_of = np.repeat(np.arange(len(corners)), [len(face) - 2 for face in corners])
        self.face = {name: np.array(column) for name, column in columns.items()}

    @classmethod
    def of(cls, points, triangles):
        """A mesh without further columns."""
        mesh = cls.__new__(cls)
        mesh.points, mesh.triangles = points, triangles
        return mesh

    def write(self, path, **columns):
        """The positions and triangles, with further columns of the vertices."""
        names = ["x", "y", "z", *columns]
        vertex = np.empty(len(self.points), [(name, "<f8") for name in names])
        for name, values in zip(names, [*self.points.T, *columns.values()]):
            vertex[name] = values
        face = np.empty(len(self.triangles), [("n", "u1"), ("corners", "<i4", 3)])
        face["n"], face["corners"] = 3, self.triangles
        head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(vertex)}"]
        head += [f"property double {name}" for name in names]
        head += [f"element face {len(face)}", "property list uchar int vertex_indices", "end_header", ""]
        pathlib.Path(path).write_bytes("\n".join(head).encode() + vertex.tobytes() + face.tobytes())


def ramp(values, low, high):
    """#V by 3 colours; grey where there is no value."""
    place = np.clip((np.nan_to_num(values) - low) / (high - low), 0, 1) * (len(RAMP) - 1)
    first = np.minimum(place.astype(int), len(RAMP) - 2)
    colours = RAMP[first] + (place - first)[:, None] * (RAMP[first + 1] - RAMP[first])
    return np.where(np.isnan(values)[:, None], MISSING, colours)


def voxel_faces(mask, spacing):
    """The faces of voxels between inside and outside, each as two triangles, turned outwards."""
    mask = np.pad(mask, 1)
    quads = []
    for axis in range(3):
        change = np.diff(mask.astype(int), axis=axis)
        second, third = np.eye(3, dtype=int)[(axis + 1) % 3], np.eye(3, dtype=int)[(axis + 2) % 3]
        for sign, around in (-1, (0, second, second + third, third)), (1, (0, third, second + third, second)):
            corner = np.argwhere(change == sign) + np.eye(3, dtype=int)[axis]
            quads.append(np.stack([corner + step for step in around], axis=1))
    places, corners = np.unique(np.concatenate(quads).reshape(-1, 3), axis=0, return_inverse=True)
    corners = corners.reshape(-1, 4)
    return Mesh.of(places * np.array(spacing), np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]))


def height_grid(heights, spacing):
    n, m = heights.shape
    x, y = np.meshgrid(spacing * np.arange(n), spacing * np.arange(m), indexing="ij")
    at = np.arange(n * m).reshape(n, m)
    a, b, c, d = at[:-1, :-1].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel(), at[:-1, 1:].ravel()
    return Mesh.of(np.stack([x, y, heights], axis=-1).reshape(-1, 3).astype(float),
                   np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]))


class View:
    """Obliquely from above, in parallel projection: the same for both pictures."""

    def __init__(self, points, turn, height=0.55):
        eye = np.array([np.cos(turn), np.sin(turn), height])
        eye /= np.linalg.norm(eye)
        right = np.cross([0, 0, 1], eye)
        right /= np.linalg.norm(right)
        self.axes = np.stack([right, np.cross(right, eye), eye], axis=1)
        seen = points @ self.axes
        self.low, extent = seen.min(0), np.ptp(seen, axis=0)
        margin = 0.04 * extent[0]
        self.scale = SAMPLES * HALF / (extent[0] + 2 * margin)
        self.low = self.low - margin
        self.size = (SAMPLES * HALF, SAMPLES * int(np.ceil(self.scale * (extent[1] + 2 * margin) / SAMPLES)))

    def draw(self, mesh, colours, of_faces=False, paint=None):
        """@param colours #V by 3, or a row for each triangle. @param paint makes colours of these at each pixel."""
        seen = (mesh.points @ self.axes - self.low) * self.scale
        width, height = self.size
        depth = np.full((height, width), -np.inf)
        image = np.full((height, width, 3), 255.0)
        a, b, c = (seen[mesh.triangles[:, k]] for k in range(3))
        normals = np.cross(b - a, c - a)
        normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
        normals *= np.where(normals[:, 2:] < 0, -1, 1)
        lamps = np.array([[-0.45, -0.65, 0.75], [0.75, 0.2, 0.5]])
        lamps /= np.linalg.norm(lamps, axis=1)[:, None]
        light = 0.42 + np.maximum(normals @ lamps.T, 0) @ np.array([0.52, 0.2])
        for t in range(len(mesh.triangles)):
            corners = np.stack([a[t], b[t], c[t]])
            x0, y0 = np.maximum(np.floor(corners.min(0)[:2]).astype(int), 0)
            x1, y1 = np.minimum(np.ceil(corners.max(0)[:2]).astype(int) + 1, (width, height))
            u, w = corners[1] - corners[0], corners[2] - corners[0]
            area = u[0] * w[1] - u[1] * w[0]
            if x0 >= x1 or y0 >= y1 or area == 0:
                continue
            x, y = np.arange(x0, x1) + 0.5 - corners[0, 0], (np.arange(y0, y1) + 0.5 - corners[0, 1])[:, None]
            second, third = (x * w[1] - y * w[0]) / area, (y * u[0] - x * u[1]) / area
            z = corners[0, 2] + second * u[2] + third * w[2]
            part = depth[y0:y1, x0:x1]
            nearer = (second >= 0) & (third >= 0) & (second + third <= 1) & (z > part)
            part[nearer] = z[nearer]
            if of_faces:
                colour = np.broadcast_to(colours[t], (nearer.sum(), 3))
            else:
                at = colours[mesh.triangles[t]]
                colour = at[0] + second[nearer, None] * (at[1] - at[0]) + third[nearer, None] * (at[2] - at[0])
                colour = paint(colour) if paint else colour
            image[y0:y1, x0:x1][nearer] = np.minimum(light[t] * colour, 255)
        return image.reshape(height // SAMPLES, SAMPLES, HALF, SAMPLES, 3).mean(axis=(1, 3))


def write_png(path, image):
    """In steps of four shades: half the bytes."""
    pixels = (np.round(image / 4) * 4).clip(0, 255).astype(np.uint8)
    rows = pixels.astype(np.int16)
    rows[:, 1:] -= pixels[:, :-1]
    lines = np.concatenate([np.ones((len(rows), 1), np.uint8), rows.astype(np.uint8).reshape(len(rows), -1)], axis=1)

    def chunk(kind, data):
        checked = kind + data
        return len(data).to_bytes(4, "big") + checked + zlib.crc32(checked).to_bytes(4, "big")

    size = image.shape[1].to_bytes(4, "big") + image.shape[0].to_bytes(4, "big")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size + b"\x08\x02\x00\x00\x00") +
                     chunk(b"IDAT", zlib.compress(lines.tobytes(), 9)) + chunk(b"IEND", b""))


class Gallery:
    def __init__(self, programs, out, folder):
        self.programs, self.out, self.folder = programs.resolve(), out, folder

    def run(self, command):
        program, *arguments = shlex.split(command)
        if program == "smooth" and f"    {command}\n" not in PAGE.read_text():
            sys.exit(f"{PAGE.name} does not have the command that makes its picture: {command}")
        print("   ", command)
        subprocess.run([self.programs / program, *arguments], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)

    def read(self, name):
        return Mesh(self.folder / name)

    def save(self, name, view, before, after):
        pictures = [view.draw(*picture) for picture in (before, after)]
        path = self.out / f"{name}.png"
        write_png(path, np.concatenate(pictures, axis=1))
        if path.stat().st_size > MOST_BYTES:
            sys.exit(f"{path} has {path.stat().st_size} bytes, more than {MOST_BYTES}")

    def clay(self, mesh):
        return mesh, np.broadcast_to(CLAY, mesh.points.shape)

    def surface(self, name, generated, smoothed, turn, height=0.55):
        self.run(generated)
        self.run(smoothed)
        before, after = self.read(shlex.split(smoothed)[1]), self.read(shlex.split(smoothed)[2])
        self.save(name, View(before.points, turn, height), self.clay(before), self.clay(after))

    def scan(self):
        self.surface("scan", "generate noisy-sphere scan.ply --vertices 20000 --amplitude 0.12 --noise 0.35",
                     "smooth scan.ply smooth.ply", -0.9)

    def part(self):
        self.surface("part", "generate gear part.ply --vertices 15000 --noise 0.3", "smooth part.ply smooth.ply", -1.1,
                     0.8)

    def knob(self):
        """A knurled band around a ball, with noise along the normals."""
        self.run("generate noisy-sphere ball.ply --vertices 20000 --amplitude 0 --noise 0")
        ball = self.read("ball.ply")
        x, y, z = ball.points.T
        angle, height = 12 * np.arctan2(y, x), 10 * np.arctanh(np.clip(z, -0.9, 0.9))
        edge = np.linalg.norm(np.diff(ball.points[ball.triangles[:, :2]], axis=1), axis=2).mean()
        band = np.clip(8 * (0.6 - np.abs(z)), 0, 1)
        knurl = 1.5 * band * (np.abs(np.sin(angle + height)) + np.abs(np.sin(angle - height)))
        noise = 0.1 * np.random.default_rng(1).standard_normal(len(x))
        ball.points *= 1 + edge * (knurl + noise)[:, None]
        ball.write(self.folder / "knob.ply")
        self.run("smooth knob.ply smooth.ply")
        after = self.read("smooth.ply")
        self.save("knob", View(ball.points, -0.9, 0.5), self.clay(ball), self.clay(after))

    def terrain(self):
        self.surface("terrain", "generate triangles terrain.ply --vertices 10000 --noise 0.5",
                     "smooth terrain.ply smooth.ply --preset terrain", -1.0, 0.7)

    def slices(self):
        """A kidney with its vessel, in slices five times as thick as pixels are wide."""
        spacing = (0.5, 0.5, 2.5)
        x, y, z = (step * (np.arange(n) - n / 2 + 0.3) for step, n in zip(spacing, (100, 80, 12)))
        x, y, z = np.meshgrid(x, y, z, indexing="ij")
        body = (x / 22) ** 2 + ((y - 3 + 0.018 * x**2) / 9.5) ** 2 + (z / 9.5) ** 2
        dent = np.exp(-((x / 6) ** 2 + ((y + 6) / 6) ** 2 + (z / 9) ** 2))
        vessel = np.hypot(x - 3 * np.sin(0.25 * y), z)
        inside = (body + dent < 1) | ((vessel < 3.1) & (np.abs(y + 8.5) < 9.5))
        self.smooth_own("slices", voxel_faces(inside, spacing), -1.15, 0.6)

    def heights(self):
        """Hills and a valley, 1 m between points, heights in whole metres."""
        x, y = np.meshgrid(np.linspace(-1, 1, 80), np.linspace(-1, 1, 80), indexing="ij")
        hills = 14 * np.exp(-((x + 0.35) ** 2 + (y - 0.35) ** 2) / 0.25)
        hills += 9 * np.exp(-((x - 0.55) ** 2 + (y + 0.05) ** 2) / 0.15)
        valley = 6 * np.exp(-((y + 0.5 - 0.25 * np.sin(2.5 * x)) ** 2) / 0.05)
        heights = np.round(hills - valley + 2 * x + 2 * np.sin(4 * y))
        self.smooth_own("heights", height_grid(heights, 1), 0.4, 0.6)

    def smooth_own(self, name, mesh, turn, height):
        mesh.write(self.folder / f"{name}.ply")
        self.run(f"smooth {name}.ply smooth.ply")
        after = self.read("smooth.ply")
        self.save(name, View(mesh.points, turn, height), self.clay(mesh), self.clay(after))

    def labels(self):
        self.run("generate bubbles cells.ply --vertices 12000")
        self.run("smooth cells.ply smooth.ply")
        before, after = self.read("cells.ply"), self.read("smooth.ply")
        cell = np.maximum(before.face["front"], before.face["back"])[before.face_of]
        colours = np.array([[0, 0, 0], [196, 120, 96], [120, 160, 200], [150, 180, 120]], float)[cell]
        self.save("labels", View(before.points, -0.9, 0.6), (before, colours, True), (after, colours, True))

    def field(self):
        self.run("generate noisy-sphere sphere.ply --vertices 6000 --amplitude 0.12 --noise 0")
        sphere = self.read("sphere.ply")
        x, y, z = sphere.points.T
        random = np.random.default_rng(1)
        values = np.sin(4 * x) + z + 0.5 * random.standard_normal(len(x))
        values[(y < -0.35) & (np.hypot(x - 0.2, z - 0.2) < 0.35)] = np.nan
        sphere.write(self.folder / "measured.ply", temperature=values)
        self.run("smooth measured.ply filled.ply --fields temperature --fwhm 8% --fill")
        after = self.read("filled.ply")
        colour = [ramp(v, -1.6, 1.6) for v in (values, after.vertex["temperature"])]
        self.save("field", View(sphere.points, -1.2, 0.4), (sphere, colour[0]), (after, colour[1]))

    def distances(self):
        self.run("generate gear part.ply --vertices 30000 --noise 0")
        part = self.read("part.ply")
        start = int(np.argmin(part.points @ [-0.3, 1, -1]))
        (self.folder / "start.txt").write_text(f"{start}\n")
        self.run("smooth part.ply distances.ply --from start.txt")
        after = self.read("distances.ply")
        distance = after.vertex["distance"] / after.vertex["distance"].max()

        def with_isolines(at):
            return ramp(at[:, 0], 0, 1) * np.where(np.abs(at * 20 % 1 - 0.5) < 0.07, 0.4, 1)

        self.save("distances", View(part.points, -1.1, 0.8), self.clay(part),
                  (after, distance[:, None], False, with_isolines))

    def region(self):
        self.run("generate noisy-sphere scan.ply --vertices 20000 --amplitude 0.12 --noise 0.35")
        before = self.read("scan.ply")
        inside = np.linalg.norm(before.points - [0.3, -0.9, 0.35], axis=1) < 0.6
        (self.folder / "region.txt").write_text("\n".join(map(str, np.flatnonzero(inside))) + "\n")
        self.run("smooth scan.ply smooth.ply --region region.txt --feather 3% --radius 4%")
        after = self.read("smooth.ply")
        colours = np.where(inside[:, None], HIGHLIGHT, CLAY)
        self.save("region", View(before.points, -1.2, 0.4), (before, colours), (after, colours))

    def cut(self):
        self.run("generate mixed waves.ply --vertices 15000 --noise 0.2")
        self.run("smooth waves.ply smooth.ply --radius 2% --subdomains 12 --parts parts.ply")
        before, parts, after = (self.read(f"{name}.ply") for name in ("waves", "parts", "smooth"))
        view = View(before.points, -1.0, 0.8)
        colours = np.stack([parts.face[c][parts.face_of] for c in ("red", "green", "blue")], axis=1).astype(float)
        self.save("cut", view, (parts, colours, True), self.clay(after))


def main():
    names = ["scan", "part", "knob", "terrain", "heights", "slices", "labels", "field", "distances", "region", "cut"]
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {' '.join(names)} [all]")
    parser.add_argument("--programs", type=pathlib.Path, default=pathlib.Path("build/bin"))
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path(__file__).parent / "pictures")
    options = parser.parse_args()
    if unknown := set(options.names) - set(names):
        parser.error(f"there is no picture {' '.join(sorted(unknown))}: {' '.join(names)}")
    for name in options.names or names:
        print(name)
        with tempfile.TemporaryDirectory() as folder:
            getattr(Gallery(options.programs, options.out, pathlib.Path(folder)), name)()


if __name__ == "__main__":
    main()
