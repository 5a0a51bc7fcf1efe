#!/usr/bin/env python3
"""Draws the curves and surfaces of `figures` from the tables and meshes in the folder of this file.

    python3 draw.py [NAME…]     NAME: of a table, such as texture [all]
    python3 draw.py --check     ends with status 0 if it can draw, else with 1, without words

Needs Matplotlib 3.6 or newer (Debian: python3-matplotlib). The same data gives the same files, byte for byte, with the
same version of Matplotlib.
"""

import sys

# What lies among the results is no module.
if __name__ == "__main__" and not (sys.flags.isolated or getattr(sys.flags, "safe_path", False)):
    del sys.path[0]

import contextlib
import csv
import io
import os
import pathlib

ONLY_CHECK = __name__ == "__main__" and sys.argv[1:] == ["--check"]
if ONLY_CHECK:
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)

MISSING = "draw.py needs Matplotlib 3.6 or newer: apt-get install python3-matplotlib gives it to /usr/bin/python3"

try:
    import numpy as np
except ImportError:
    sys.exit(MISSING)

# Curves.
PANEL = (3.3, 2.8)  # inches
GREY = "#6b757f"  # legible on light and on dark pages
STYLE = {"font.size": 9, "axes.titlesize": 9, "axes.titlelocation": "left", "axes.spines.left": False,
         "axes.spines.right": False, "axes.spines.top": False, "axes.edgecolor": GREY, "axes.labelcolor": GREY,
         "axes.titlecolor": GREY, "text.color": GREY, "xtick.color": GREY, "ytick.color": GREY, "ytick.major.size": 0,
         "ytick.minor.size": 0, "figure.constrained_layout.h_pad": 0.08, "figure.constrained_layout.w_pad": 0.08,
         "axes.grid": True, "axes.grid.axis": "y", "grid.color": GREY, "grid.alpha": 0.3, "grid.linewidth": 0.6,
         "lines.linewidth": 1.4, "legend.frameon": False, "svg.hashsalt": "figures"}
COLOURS = {"V": "#2f78b7", "H": "#c8702a"}
DASHES = {"max": ":", "rms": "--", "mean": "-"}
LAPLACIANS = {"fujiwara": (r"$\Delta_F$", "#2f78b7"), "alexa-wardetzky": (r"$\Delta_A$", "#2c8a57"),
              "ptackova-velho": (r"$\Delta_P$", "#c8702a")}
CONDITIONS = {"adapted-robin": "adapted Robin", "adapted-ventcell": "adapted Ventcell", "schwarz": "Schwarz"}
WAYS = {("plain", "adapted-robin"): "the paper's method", ("default", "adapted-robin"): "the library's defaults",
        ("plain", "schwarz"): "alternating Schwarz"}

# Surfaces.
WIDTH = 640  # pixels
MARGIN = 0.03  # of the width
LEVELS = 16  # lines of equal height
LINE = 0.14  # their width, of the distance from one to the next
DARK = 0.5  # their brightness
LAMPS = np.array([[-0.45, -0.65, 0.75], [0.75, 0.2, 0.5]])  # directions in the picture, the third towards the eye
POWERS = np.array([0.5, 0.2])  # of the lamps
PIECE = 48  # pixels: the longest edge, as it is seen, of what is put in the order of depth
SHADE = 0.46  # the brightness without a lamp
RAINBOW = np.array([[0, 0, 1], [0, 1, 1], [0, 1, 0], [1, 1, 0], [1, 0, 0]], float)
PARTS = np.array([[217, 143, 78], [109, 159, 198], [154, 125, 156]]) / 255  # the third: the overlap

NUMBERS = {"char": "i1", "uchar": "u1", "short": "<i2", "ushort": "<u2", "int": "<i4", "uint": "<u4",
           "float": "<f4", "double": "<f8"}


def read_ply(path):
    """The columns of the vertices and of the faces of a binary PLY file as the programs write it. A column of lists is
    a list of arrays."""
    head, body = pathlib.Path(path).read_bytes().split(b"end_header\n", 1)
    lines = [line.split() for line in head.decode().splitlines()]
    if ["format", "binary_little_endian", "1.0"] not in lines:
        sys.exit(f"{path}: is not a binary PLY file in little-endian order")
    counts, properties = {}, {}
    for line in lines:
        if line and line[0] == "element":
            element = line[1]
            counts[element], properties[element] = int(line[2]), []
        elif line and line[0] == "property":
            properties[element].append(line[1:])
    vertex = np.frombuffer(body, [(name, NUMBERS[number]) for number, name in properties["vertex"]], counts["vertex"])
    offset = vertex.nbytes
    face = {words[-1]: [] for words in properties["face"]}

    def read(number, count):
        nonlocal offset
        values = np.frombuffer(body, NUMBERS[number], count, offset)
        offset += values.nbytes
        return values

    for _ in range(counts["face"]):
        for *is_list, number, name in properties["face"]:
            face[name].append(read(number, read(is_list[1], 1)[0]) if is_list else read(number, 1)[0])
    return vertex, face


def save(figure, path):
    """Whole or not at all, without date and version. Ends the program if that fails."""
    nothing = {"svg": {"Date": None, "Creator": None}, "png": {"Software": None}}
    content = io.BytesIO()
    kind = path.suffix[1:]
    # A legend may be wider than its plot.
    figure.savefig(content, format=kind, transparent=True, metadata=nothing[kind],
                   bbox_inches="tight" if kind == "svg" else None)
    part = path.with_name(path.name + ".part")
    try:
        part.write_bytes(content.getvalue())
        part.replace(path)
    except OSError as error:
        with contextlib.suppress(OSError):
            part.unlink()
        sys.exit(f"{path}: cannot be written: {error.strerror}")


# ----------------------------------------------------------------------------------------------------------- curves


def flows_of(rows):
    """The rows of each flow, step by step."""
    flows = {}
    for row in rows:
        flows.setdefault(tuple(row[c] for c in ("figure", "laplacian", "conditions", "cut", "options")), []).append(row)
    return list(flows.values())


def label_of(quantity, kind):
    return rf"${quantity}_\mathrm{{{kind if kind != 'rms' else 'RMS'}}}$"


class Plot:
    """Panels with curves of distances, all on the same logarithmic axis, and a legend below."""

    def __init__(self, n, columns, note=""):
        from matplotlib.figure import Figure

        n_rows = max(-(-n // columns), 1)
        below = 0.7 if note else 0.5
        width, height = PANEL[0] * columns, PANEL[1] * n_rows + below
        self.figure = Figure((width, height), layout="constrained")
        self.figure.get_layout_engine().set(rect=(0, below / height, 1, 1 - below / height))
        grid = self.figure.subplots(n_rows, columns, sharey=True, squeeze=False)
        self.panels = list(grid.flat)
        for panel in self.panels[n:]:
            panel.remove()
        for panel in self.panels[:n]:
            panel.set_yscale("log")
            panel.tick_params(labelleft=True)
        for panel in grid[:, 0]:
            panel.set_ylabel("distance / mean edge length")
        self.figure.text(0.5, 0.05 / height, note, ha="center", va="bottom")
        self.place_of_legend = 0.5, (below - 0.5) / height
        self.values, self.legend = [1.0, 10.0], {}

    def add(self, panel, x, y, label, **style):
        """A gap where y is no positive number."""
        y = np.array(y, float)
        y[~(np.isfinite(y) & (y > 0))] = np.nan
        self.values.extend(y[~np.isnan(y)])
        self.legend.setdefault(label, panel.plot(x, y, label=label, **style)[0])

    def finished(self):
        low, high = np.floor(np.log10(min(self.values))), np.ceil(np.log10(max(self.values)))
        self.panels[0].set_ylim(10.0**low, 10.0**high)
        self.figure.legend(handles=list(self.legend.values()), ncols=max(-(-len(self.legend) // 2), 1),
                           loc="lower center", bbox_to_anchor=self.place_of_legend)
        return self.figure


def curves_by_step(rows):
    """For each decomposed flow a panel with V and H, and on the authors' own mesh the results of their code at the end.
    None if no flow is decomposed or has two steps."""
    flows = [flow for flow in flows_of(rows) if flow[0]["conditions"] != "undecomposed"]
    steps = max(int(row["step"]) for row in rows)
    if steps < 2 or not flows:
        return None
    plot = Plot(len(flows), len(flows) if len(flows) <= 3 else (len(flows) + 1) // 2)
    for panel, flow in zip(plot.panels, flows):
        first = flow[0]
        panel.set(title=f"{LAPLACIANS[first['laplacian']][0]} in two sub-meshes, {CONDITIONS[first['conditions']]}",
                  xlabel="step", xlim=(0.5, steps + 0.5))
        panel.xaxis.get_major_locator().set_params(integer=True)
        for kind, dashes in DASHES.items():
            for quantity, colour in COLOURS.items():
                plot.add(panel, [int(row["step"]) for row in flow], [row[f"{quantity.lower()}_{kind}"] for row in flow],
                         label_of(quantity, kind), color=colour, linestyle=dashes)
        theirs = [float(first[f"authors_v_{kind}"]) for kind in ("mean", "max")]
        if np.isfinite(theirs).any():
            plot.add(panel, [steps, steps], theirs, rf"the authors' {label_of('V', 'mean')}, {label_of('V', 'max')}",
                     color="#b02a50", marker="D", fillstyle="none", linestyle="")
    return plot.finished()


def curves_of_many(rows, x_of, panel_of, **axis):
    """V_mean and V_max after the last step over what x_of says of a row, in the panel that panel_of names. There is a
    curve for each figure and Laplacian."""
    steps, cuts, curves = {}, {}, {}
    for row in rows:
        steps[row["figure"]] = max(steps.get(row["figure"], 0), int(row["step"]))
    for flow in flows_of(rows):
        row = flow[-1]
        if row["conditions"] == "undecomposed":
            continue
        figure, cut = row["figure"], row["cut"]
        cuts.setdefault(figure, {})[cut] = int(row["subdomains"])
        title = panel_of(figure, WAYS[row["options"], row["conditions"]])
        if int(row["step"]) == steps[figure]:
            curves.setdefault((title, figure, row["laplacian"]), {})[cut] = row
    titles = list(dict.fromkeys(title for title, *_ in curves))
    plot = Plot(len(titles), 3,
                "Distances from the undecomposed flow after the last step; a gap where a flow ended early.")
    panels = dict(zip(titles, plot.panels))
    for (title, figure, laplacian), ends in curves.items():
        symbol, colour = LAPLACIANS[laplacian]
        points = [ends.get(cut) for cut in sorted(cuts[figure], key=cuts[figure].get)]
        for kind in ("mean", "max"):
            plot.add(panels[title], [x_of(row) if row else np.nan for row in points],
                     [row[f"v_{kind}"] if row else np.nan for row in points], f"{symbol}, {label_of('V', kind)}",
                     color=colour, linestyle=DASHES[kind])
    for title, panel in panels.items():
        panel.set(title=title, xscale="log", **axis)
    return plot


def curves_over_number(rows):
    """A panel for each figure and each way of taking steps."""
    plot = curves_of_many(rows, lambda row: int(row["subdomains"]), lambda figure, way: f"{figure}, {way}",
                          xlabel="sub-meshes", xlim=(1.7, 38))
    for panel in plot.figure.axes:
        panel.minorticks_off()
        panel.set_xticks([2, 4, 8, 16, 32], [2, 4, 8, 16, 32])
    return plot.finished()


def curves_over_width(rows):
    """A panel for each way of taking steps. The width of a sub-mesh is the root of its area."""
    plot = curves_of_many(rows, lambda row: np.sqrt(float(row["dt"]) * int(row["subdomains"]) / float(row["area"])),
                          lambda figure, way: f"all meshes, {way}", xlabel=r"$\sqrt{dt}$ / width of a sub-mesh",
                          xlim=(0.003, 2))
    return plot.finished()


# --------------------------------------------------------------------------------------------------------- surfaces


class View:
    """Obliquely from above, in parallel projection: the same for all pictures of a figure."""

    def __init__(self, points):
        """@param points fill the picture."""
        extent = np.ptp(points, axis=0)
        small, middle, large = np.argsort(extent, kind="stable")
        # The usual upward direction: along a long surface, across a flat one, else z.
        up = large if extent[large] > 1.6 * extent[middle] else small if extent[small] < 0.6 * extent[middle] else 2
        eye = np.roll([0.62, 0.62, -1.0], up) / np.linalg.norm([0.62, 0.62, 1.0])
        right = np.cross(np.eye(3)[up], eye)
        right /= np.linalg.norm(right)
        self.axes = np.stack([right, np.cross(right, eye), eye], axis=1)
        seen = points @ self.axes
        low, (across, down) = seen.min(0), np.ptp(seen, axis=0)[:2]
        self.scale = (1 - 2 * MARGIN) * WIDTH / max(across, 0.7 * down, 1e-300)
        self.size = WIDTH, int(self.scale * down + 2 * MARGIN * WIDTH)
        self.corner = low - [(WIDTH / self.scale - across) / 2, (self.size[1] / self.scale - down) / 2, 0]

    def seen(self, points):
        """In pixels to the right and downwards; the third coordinate grows towards the eye."""
        return (points @ self.axes - self.corner) * self.scale


def triangles_of(values, faces):
    """The triangles of which a surface consists, #T by 3 rows of the vertices' values, and the face of each. A face of
    more corners is a fan around its centre."""
    triangles, face_of = [np.empty((0, 3, values.shape[1]))], [np.empty(0, int)]
    sizes = np.array([len(face) for face in faces])
    for n in np.unique(sizes):
        which = np.flatnonzero(sizes == n)
        corners = values[np.array([faces[f] for f in which])]
        if n == 3:
            triangles.append(corners)
            face_of.append(which)
            continue
        centres = np.repeat(corners.mean(axis=1, keepdims=True), n, axis=1)
        fans = np.stack([centres, corners, np.roll(corners, -1, axis=1)], axis=2)
        triangles.append(fans.reshape(-1, 3, values.shape[1]))
        face_of.append(np.repeat(which, n))
    return np.concatenate(triangles), np.concatenate(face_of)


def pieces_of(corners, heights, size):
    """Triangles cut along their longest edges until none is long, so that those whose centres are nearer to the eye are
    nearer as a whole. What is outside the picture or infinitely far is left out.
    @returns corners and heights of the pieces, and the triangle of each."""
    pieces, of = np.concatenate([corners, heights[..., None]], axis=2), np.arange(len(corners))
    usable = (np.abs(pieces) < 1e12).all(axis=(1, 2))
    pieces, of = pieces[usable], of[usable]
    finished = [(pieces[:0], of[:0])]
    while len(pieces):
        flat = pieces[..., :2]
        is_seen = (flat.max(axis=1) > 0).all(axis=1) & (flat.min(axis=1) < size).all(axis=1)
        pieces, of = pieces[is_seen], of[is_seen]
        lengths = np.linalg.norm((np.roll(pieces, -1, axis=1) - pieces)[..., :2], axis=2)
        is_long = lengths.max(axis=1) > PIECE
        finished.append((pieces[~is_long], of[~is_long]))
        first = lengths[is_long].argmax(axis=1)
        pieces, of = pieces[is_long], of[is_long]
        a, b, c = (np.take_along_axis(pieces, ((first + k) % 3)[:, None, None], axis=1)[:, 0] for k in range(3))
        middle = (a + b) / 2
        pieces = np.concatenate([np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])
        of = np.concatenate([of, of])
    pieces, of = (np.concatenate(parts) for parts in zip(*finished))
    return pieces[..., :3], pieces[..., 3], of


def brightness(corners):
    """Lit by lamps over the viewer's shoulder, each triangle flat, both sides alike."""
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    normals *= np.where(normals[:, 2:] < 0, -1, 1)
    lamps = LAMPS / np.linalg.norm(LAMPS, axis=1, keepdims=True)
    return SHADE + np.maximum(normals @ lamps.T, 0) @ POWERS


def rainbow(values):
    place = np.clip(values, 0, 1) * (len(RAINBOW) - 1)
    return np.stack([np.interp(place, np.arange(len(RAINBOW)), channel) for channel in RAINBOW.T], axis=1)


def lines_of_height(corners, heights):
    """The parts of triangles that lines of equal height cover: polygons of five corners, and the triangle of each."""
    order = np.argsort(heights, axis=1)
    corners, heights = np.take_along_axis(corners, order[:, :, None], 1), np.take_along_axis(heights, order, 1)
    polygons, owners = [], []
    for level in range(LEVELS + 1):
        low, high = (level - LINE / 2) / LEVELS, (level + LINE / 2) / LEVELS
        owner = np.flatnonzero((heights[:, 0] < high) & (heights[:, 2] > low))
        c, (h0, h1, h2) = corners[owner], heights[owner].T

        def between(height, a, b, ha, hb):
            part = np.clip((height - ha) / np.maximum(hb - ha, 1e-300), 0, 1)
            return c[:, a] + part[:, None] * (c[:, b] - c[:, a])

        def on_long_edge(height):
            return between(height, 0, 2, h0, h2)

        def on_short_edges(height):
            return np.where((height < h1)[:, None], between(height, 0, 1, h0, h1), between(height, 1, 2, h1, h2))

        low, high = np.clip(low, h0, h2), np.clip(high, h0, h2)
        polygons.append(np.stack([on_long_edge(low), on_long_edge(high), on_short_edges(high),
                                  on_short_edges(np.clip(h1, low, high)), on_short_edges(low)], axis=1))
        owners.append(owner)
    return np.concatenate(polygons), np.concatenate(owners)


def surface(view, values, faces, colours=None):
    """A picture of a surface.
    @param values x, y, z and the height of each vertex, from 0 to 1: a texture, with lines of equal height.
    @param colours of the faces, instead of the texture."""
    from matplotlib.collections import PolyCollection
    from matplotlib.figure import Figure

    width, height = view.size
    triangles, face_of = triangles_of(values, faces)
    with np.errstate(invalid="ignore"):
        corners, heights, owner = pieces_of(view.seen(triangles[..., :3]), triangles[..., 3], view.size)
    light, depth, flat = brightness(corners)[:, None], corners[..., 2].mean(axis=1), corners[..., :2]
    polygons = flat[:, [0, 1, 2, 2, 2]]
    if colours is None:
        lines, owner = lines_of_height(flat, heights)
        polygons = np.concatenate([polygons, lines])
        plain = rainbow(heights.mean(axis=1)) * light
        shown, depth = np.concatenate([plain, DARK * plain[owner]]), np.concatenate([depth, depth[owner]])
    else:
        shown = colours[face_of[owner]] * light
    order = np.argsort(depth, kind="stable")
    figure = Figure((width / 100, height / 100), dpi=100)
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, width), ylim=(height, 0))
    axes.set_axis_off()
    # Edges in the colour of their triangle close the gaps between triangles.
    axes.add_collection(PolyCollection(polygons[order], facecolors=np.minimum(shown, 1)[order], edgecolors="face",
                                       linewidths=0.5), autolim=False)
    return figure


def with_overlap(faces, labels, leading):
    """2 for the faces that share a vertex with the sub-mesh that solves first, which it grows by; else the label."""
    touched = np.unique(np.concatenate([face for face, label in zip(faces, labels) if label == leading] or [[]]))
    touches = np.array([np.isin(face, touched).any() for face in faces])
    return np.where(touches & (labels != leading), 2, labels)


def surfaces(folder, name, rows):
    """The pictures of a figure by name: the input, the last state of each flow, and where the mesh is cut in two its
    sub-meshes, each in a colour, and the one that solves first alone."""

    def values_of(vertex):
        height = vertex["height"]
        height = (height - low) / (high - low) if high > low else np.zeros(len(vertex))
        return np.stack([vertex["x"], vertex["y"], vertex["z"], height], axis=1)

    vertex, face = read_ply(folder / f"{name}-input.ply")
    faces = face["vertex_indices"]
    used = np.unique(np.concatenate(faces))
    low, high = vertex["height"][used].min(), vertex["height"][used].max()
    values = values_of(vertex)
    view = View(values[used, :3])
    for path in sorted(folder.glob(f"{name}-*.ply")):
        vertex, face = read_ply(path)
        if "height" in vertex.dtype.names:
            yield path.stem, surface(view, values_of(vertex), face["vertex_indices"])
    if not (folder / f"{name}-cut.txt").exists():
        return
    labels = np.loadtxt(folder / f"{name}-cut.txt", int)
    cut = [row for row in rows if row["leading"]]
    leading = int(cut[-1]["leading"]) if cut else 0
    yield f"{name}-part", surface(view, values, [face for face, label in zip(faces, labels) if label == leading])
    if all(row["conditions"] in ("undecomposed", "schwarz") for row in rows):
        labels = with_overlap(faces, labels, leading)
    yield f"{name}-cut", surface(view, values, faces, PARTS[labels])


# ------------------------------------------------------------------------------------------------------------- all


def use_style():
    """The same on all machines."""
    import matplotlib

    matplotlib.rcdefaults()
    matplotlib.rcParams.update(STYLE)


def draw(folder, name):
    """All curves and surfaces of a table."""
    use_style()
    with open(folder / f"{name}.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    if any(row["cut"].startswith("METIS") for row in rows):
        save(curves_over_number(rows), folder / f"{name}-curves.svg")
        save(curves_over_width(rows), folder / f"{name}-width.svg")
        return
    for title, picture in surfaces(folder, name, rows):
        save(picture, folder / f"{title}.png")
    curves = curves_by_step(rows) if rows else None
    if curves:
        save(curves, folder / f"{name}-curves.svg")


def tables(folder):
    """The names of the tables of flows."""
    for path in sorted(folder.glob("*.csv")):
        if path.is_file():
            with open(path, "rb") as file:
                if file.readline().startswith(b"figure,mesh,"):
                    yield path.stem


def main():
    folder = pathlib.Path(__file__).parent
    # Matplotlib refuses to start with a name that it does not know, and none is needed.
    os.environ.pop("MPLBACKEND", None)
    try:
        import matplotlib.layout_engine  # noqa: F401
    except ImportError:
        sys.exit(MISSING)
    if ONLY_CHECK:
        return
    there_are = list(tables(folder))
    for name in sys.argv[1:] or there_are:
        if name not in there_are:
            sys.exit(f"there is no table {name}.csv in {folder}")
        draw(folder, name)


if __name__ == "__main__":
    main()
