#!/usr/bin/env python3
"""Fits the decision between noise and shape (solvers/denoising/noise_evidence.h) to places of known surfaces.

    fit_noise.py add LABEL NAME MESH    measures places of a mesh and appends them to noise_or_shape.csv
    fit_noise.py fit                    writes solvers/denoising/noise_weights.h, and says which meshes are misjudged
    fit_noise.py draw PICTURE           draws the evidence of all meshes (needs matplotlib)

Labels: shape (a clean surface), noise (independent at neighbouring vertices, also on a surface with relief), alike
(noise that was made alike at neighbours), scan (the noise of a scanner). It needs numpy, and for new meshes the
program noise_features (cmake --build build --target noise_features). See noise_or_shape.md.
"""

import pathlib
import subprocess
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
DATA = HERE / "noise_or_shape.csv"
WEIGHTS = ROOT / "solvers/denoising/noise_weights.h"
PLACES = "6"
# Of each feature: whether more of it speaks for noise or against it. A feature that would say the contrary is left out.
AGAINST_SHAPE = np.array([1, -1, -1, 1, -1, -1, -1, 1])
NO_SIGNS = np.zeros(8)
# Which labels speak for each kind of noise, and which against it.
MODELS = {
    "weights_of_independent_noise": (("noise",), ("shape",), AGAINST_SHAPE),
    "weights_of_correlated_noise": (("alike", "scan"), ("shape",), AGAINST_SHAPE),
    "weights_of_correlated_against_independent_noise": (("alike", "scan"), ("noise",), NO_SIGNS),
}
# How many meshes each side counts as.
MESHES_OF_SIDE = 100.0
# Of the squares of weights of normalised features, relative to one mesh.
RIDGE = 0.1


def read():
    """Labels, names and features (n by 8) of all places."""
    rows = [line.split(",") for line in DATA.read_text().splitlines()[1:]]
    return (
        np.array([row[0] for row in rows]),
        np.array([row[1] for row in rows]),
        np.array([row[2:] for row in rows], float),
    )


def add(label, name, mesh):
    found = subprocess.run(
        [ROOT / "build/bin/noise_features", mesh, PLACES], capture_output=True, text=True, check=True
    ).stdout
    with DATA.open("a") as data:
        data.writelines(f"{label},{name},{place}\n" for place in found.split())


def logistic_regression(features, is_noise, weights):
    """Newton's method for the weighted, regularised likelihood: a constant and one weight for each feature."""
    middle, width = features.mean(0), features.std(0)
    x = np.column_stack([np.ones(len(features)), (features - middle) / width])
    ridge = np.diag([0.0] + [RIDGE] * features.shape[1])
    beta = np.zeros(x.shape[1])
    for _ in range(100):
        p = 1.0 / (1.0 + np.exp(-np.clip(x @ beta, -500, 500)))
        gradient = x.T @ (weights * (is_noise - p)) - ridge @ beta
        hessian = (x * (weights * p * (1.0 - p))[:, None]).T @ x + ridge
        step = np.linalg.solve(hessian, gradient)
        beta += step
        if np.abs(step).max() < 1e-9:
            break
    slopes = beta[1:] / width
    return beta[0] - slopes @ middle, slopes


def signed_regression(features, is_noise, weights, signs):
    """The same with slopes of the right signs only."""
    used = np.arange(features.shape[1])
    while True:
        constant, slopes = logistic_regression(features[:, used], is_noise, weights)
        right = slopes * signs[used] >= 0
        if right.all():
            break
        used = used[right]
    all_slopes = np.zeros(features.shape[1])
    all_slopes[used] = slopes
    return constant, all_slopes


def fitted(labels, names, features):
    """The constant and the weights of each model. Both sides count alike, on each side all labels, and so all meshes."""
    models = {}
    for model, (yes, no, signs) in MODELS.items():
        used = np.isin(labels, yes + no)
        is_noise = np.isin(labels[used], yes)
        _, mesh, count = np.unique(names[used], return_inverse=True, return_counts=True)
        weights = 1.0 / count[mesh]
        for side in (yes, no):
            for label in side:
                of_label = labels[used] == label
                weights[of_label] *= MESHES_OF_SIDE / (len(side) * weights[of_label].sum())
        models[model] = signed_regression(features[used], is_noise.astype(float), weights, signs)
    return models


def evidence(model, features):
    return model[0] + features @ model[1]


def report(models, labels, names, features):
    for model, (yes, no, _) in MODELS.items():
        e = evidence(models[model], features)
        for label in yes + no:
            # As the library does, by the lower quartile of all places.
            found = {n: np.quantile(e[(names == n) & (labels == label)], 0.25) for n in sorted(set(names[labels == label]))}
            wrong = [f"{n} ({quartile:.1f})" for n, quartile in found.items() if (quartile > 0) != (label in yes)]
            print(f"{model}: {label}: {len(wrong)} of {len(found)} meshes misjudged", *wrong)


def write(models):
    lines = [
        "#pragma once\n",
        "#include <array>\n",
        "namespace seamflow {\n",
        "/// Of a logistic regression: what each of the noise_features adds to the logarithm of the odds.",
        "struct NoiseWeights {",
        "    float constant = 0.0F;",
        "    std::array<float, 8> of_features{};",
        "};\n",
        "// Written by samples/training/fit_noise.py.",
    ]
    for name, (constant, slopes) in models.items():
        numbers = [f"{x:.4g}" for x in (constant, *slopes)]
        numbers = [x + ("F" if "." in x or "e" in x else ".0F") for x in numbers]
        lines.append(f"inline constexpr NoiseWeights {name}{{\n    {numbers[0]}, {{{', '.join(numbers[1:])}}}}};")
    WEIGHTS.write_text("\n".join(lines) + "\n\n}  // namespace seamflow\n")


def draw(models, labels, names, features, picture):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, len(models), figsize=(18, 5))
    for axis, (model, weights) in zip(axes, models.items()):
        e = evidence(weights, features)
        for row, label in enumerate(sorted(set(labels))):
            axis.plot(e[labels == label], row + 0.7 * np.random.default_rng(1).random((labels == label).sum()), ".",
                      markersize=2, label=label)
        axis.axvline(0.0, color="black", linewidth=0.8)
        axis.set_xlabel(f"evidence, {model[11:].replace('_', ' ')}")
        axis.set_yticks(np.arange(len(set(labels))) + 0.35, sorted(set(labels)))
    figure.tight_layout()
    figure.savefig(picture, dpi=120)


def main():
    if len(sys.argv) == 5 and sys.argv[1] == "add":
        return add(*sys.argv[2:])
    if sys.argv[1:2] not in (["fit"], ["draw"]) or len(sys.argv) != {"fit": 2, "draw": 3}[sys.argv[1]]:
        sys.exit(__doc__)
    data = read()
    models = fitted(*data)
    report(models, *data)
    return write(models) if sys.argv[1] == "fit" else draw(models, *data, sys.argv[2])


if __name__ == "__main__":
    main()
