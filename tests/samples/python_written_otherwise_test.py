"""Every call of the Python package over ways in which the same surface can be written: python3 FILE, with the package on
PYTHONPATH."""

import unittest

import numpy as np

import seamflow

SIDE = 13


class Surface:
    """A sheet of quads with a crease and some noise, or the same written otherwise."""

    def __init__(self):
        x, y = np.meshgrid(np.arange(SIDE, dtype=float), np.arange(SIDE, dtype=float))
        noise = np.random.default_rng(1).uniform(-0.2, 0.2, SIDE * SIDE)
        self.V = np.column_stack([x.ravel(), y.ravel(), 0.7 * abs(x.ravel() - 5.2) + noise])
        corner = np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
        self.F = np.stack([corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]], -1).reshape(-1, 4)
        self.of = np.arange(len(self.V))  # for each vertex, the one that it stands for
        self.of_face = np.arange(len(self.F))
        self.scale = 1.0
        self.numbers = np.asarray  # how sets of vertices are written

    def renumbered(self):
        order = np.random.default_rng(2).permutation(len(self.V))
        self.V, self.of = self.V[order], self.of[order]
        self.F = np.argsort(order)[self.F]

    def faces_reordered(self):
        order = np.random.default_rng(3).permutation(len(self.F))
        self.F, self.of_face = np.roll(self.F[order], 1, axis=1), self.of_face[order]

    def in_thousandths(self):
        self.V, self.scale = 1000.0 * self.V, 1000.0

    def with_seams(self):
        copied = np.unique(self.F[self.F % SIDE == 6])
        number = {v: len(self.V) + i for i, v in enumerate(copied)}
        right = self.V[self.F, 0].mean(axis=1) > 6
        self.F = np.array([[number.get(v, v) if r else v for v in face] for face, r in zip(self.F, right)])
        self.V, self.of = np.vstack([self.V, self.V[copied]]), np.append(self.of, self.of[copied])

    def with_seams_copies_first(self):
        self.with_seams()
        self.V, self.of, self.F = self.V[::-1].copy(), self.of[::-1], len(self.V) - 1 - self.F

    def as_lists(self):
        self.V, self.F = self.V.tolist(), self.F.tolist()

    def as_other_arrays(self):
        self.V = np.asfortranarray(self.V)
        self.F = np.repeat(self.F.astype(np.uint16), 2, axis=0)[::2]

    def with_masks(self):
        def mask(vertices):
            is_in = np.zeros(len(self.V), bool)
            is_in[vertices] = True
            return is_in

        self.numbers = mask

    def with_masks_of_bytes(self):
        self.with_masks()
        as_bool = self.numbers
        self.numbers = lambda vertices: as_bool(vertices).astype(np.uint8)

    def vertices(self, originals):
        """One of each vertex, the last of its copies."""
        last = {v: i for i, v in enumerate(self.of)}
        return np.sort([last[v] for v in originals])

    def edges(self):
        """Those of every fifth face along its row."""
        of_face = [[(v, f[i - 1]) for i, v in enumerate(f)] for f in self.F]
        return [edge for f, edges in zip(self.of_face, of_face) if f % 5 == 0 for edge in edges
                if abs(int(self.of[edge[0]]) - int(self.of[edge[1]])) == 1]


INSIDE = [v for v in range(20, SIDE * SIDE - 20, 5) if 0 < v % SIDE < SIDE - 1] + [6 + 4 * SIDE, 6 + 7 * SIDE]


def flow_changed(s, change, **options):
    flow = seamflow.Flow(s.V, s.F, time_step=s.scale**2, converge=1e-12, **options)
    flow.step()
    change(flow, s.vertices(INSIDE))
    flow.step()
    return flow.positions / s.scale


def moved(flow, s, v):
    to = flow.positions[v] + [0.0, 0.0, 0.1 * s.scale]
    flow.move(s.numbers(v), to)


def smooth(s, **options):
    options = {"time_step": s.scale**2, "steps": 2, "converge": 1e-12} | options
    return seamflow.smooth(s.V, s.F, **options)[0] / s.scale


def field(s):
    values = np.sin(np.arange(SIDE * SIDE) * 0.37)
    return values[s.of]


CALLS = {
    "smooth": smooth,
    "smooth, radius": lambda s: smooth(s, time_step=None, radius=2.0 * s.scale),
    "smooth, fixed": lambda s: smooth(s, fixed=s.numbers(s.vertices(INSIDE))),
    "smooth, labels": lambda s: smooth(s, labels=s.of_face % 12 // 4, approach="sweep", coloring="label", converge=None),
    "smooth, attach_weights": lambda s: smooth(s, attach_weights=0.3 * (s.of % 4) / s.scale**2),
    "smooth, region": lambda s: smooth(s, region=s.of % SIDE / SIDE),
    "smooth, within": lambda s: smooth(s, within=0.1 * s.scale),
    "smooth, edges": lambda s: smooth(s, converge=None, keep_edges=60, edges=s.edges()),
    "Flow.hold": lambda s: flow_changed(s, lambda flow, v: (flow.hold(s.numbers(v)), flow.step(),
                                                            flow.release(s.numbers(s.vertices(INSIDE[::2]))))),
    "Flow.move": lambda s: flow_changed(s, lambda flow, v: moved(flow, s, v), flow="linear"),
    "Flow.attach": lambda s: flow_changed(s, lambda flow, v: flow.attach(s.numbers(v), 0.5 / s.scale**2),
                                          attach=3.0 * s.scale),
    "diffuse": lambda s: seamflow.diffuse(s.V, s.F, field(s), fwhm=2.0 * s.scale)[0],
    "diffuse, fixed": lambda s: seamflow.diffuse(s.V, s.F, field(s), fwhm=2.0 * s.scale,
                                                 fixed=s.numbers(s.vertices(INSIDE)))[0],
    "geodesic_distance": lambda s: seamflow.geodesic_distance(s.V, s.F, s.numbers(s.vertices(INSIDE[:4]))) / s.scale,
}

WRITINGS = ["renumbered", "faces_reordered", "in_thousandths", "with_seams", "with_seams_copies_first", "as_lists",
            "as_other_arrays", "with_masks", "with_masks_of_bytes"]


class WrittenOtherwise(unittest.TestCase):
    def test_calls(self):
        for name, call in CALLS.items():
            expected = call(Surface())
            self.assertTrue(np.isfinite(expected).all())
            for writing in WRITINGS:
                with self.subTest(call=name, writing=writing):
                    surface = Surface()
                    getattr(surface, writing)()
                    np.testing.assert_allclose(call(surface), expected[surface.of], atol=1e-6)


if __name__ == "__main__":
    unittest.main()
