"""Smooths a noisy sphere, its north held fixed, and says what happened; with matplotlib it leaves a picture.

    PYTHONPATH=build/python python3 samples/python/example.py [PICTURE.png]
"""

import sys

import numpy as np

import seamflow

# A sphere of quads with triangles at the poles, and noise.
rows, columns = 40, 80
latitude, longitude = np.meshgrid(np.linspace(0, np.pi, rows)[1:-1], np.arange(columns) * 2 * np.pi / columns)
ring = np.stack([np.sin(latitude) * np.cos(longitude), np.sin(latitude) * np.sin(longitude), np.cos(latitude)], axis=2)
V = np.concatenate([ring.transpose(1, 0, 2).reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]])
V *= 1 + 0.01 * np.random.default_rng(1).normal(size=(len(V), 1))
grid = np.arange((rows - 2) * columns).reshape(rows - 2, columns)
right = np.roll(grid, -1, axis=1)
F = list(np.stack([grid[:-1], grid[1:], right[1:], right[:-1]], axis=2).reshape(-1, 4))
F += [[len(V) - 2, a, b] for a, b in zip(grid[0], right[0])]
F += [[len(V) - 1, b, a] for a, b in zip(grid[-1], right[-1])]

north = V[:, 2] > 0.7
smoothed, report = seamflow.smooth(
    V, F, radius="4%", steps=3, laplacian="virtual-refinement", fixed=north,
    progress=lambda state: print(f"\r{state.phase} {100 * state.fraction:3.0f} %", end=""),
)
print()
for name in ("before", "after"):
    surface = report["surface"][name]
    print(f"{name:7} area {surface['area']:.3f}, roughness {surface['roughness_rms']:.2f}°")
for remark in report["remarks"]:
    print(remark["text"])

try:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection
except ImportError:
    print("Without matplotlib there is no picture.")
    sys.exit()


def shades(points):
    """Grey values of the faces in a light from above."""
    normals = np.array([np.cross(points[f[1]] - points[f[0]], points[f[2]] - points[f[0]]) for f in F])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return [str(shade) for shade in 0.2 + 0.75 * np.clip(normals @ [0.48, -0.6, 0.64], 0, 1)]


figure, axes = pyplot.subplots(1, 2, figsize=(10, 5), subplot_kw={"projection": "3d"})
for axis, points, title in zip(axes, (V, smoothed), ("before", "after, the north held fixed")):
    axis.add_collection3d(Poly3DCollection([points[face] for face in F], facecolors=shades(points)))
    axis.set(title=title, xlim=(-0.7, 0.7), ylim=(-0.7, 0.7), zlim=(-0.7, 0.7), box_aspect=(1, 1, 1))
    axis.set_axis_off()
picture = sys.argv[1] if len(sys.argv) > 1 else "sphere.png"
figure.savefig(picture, dpi=120)
print(f"{picture} shows both.")
