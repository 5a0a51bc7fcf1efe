"""Writes __init__.pyi into the folder of the built package: its keywords are the options that the module knows.

    python3 make_stub.py FOLDER
"""

import importlib.machinery
import importlib.util
import pathlib
import sys

folder = pathlib.Path(sys.argv[1])
HEAD = '''\
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

__version__: str
__license__: str
_core: Any

class Progress(NamedTuple):
    phase: Literal["cut", "analyse", "step", "reference"]
    step: int
    steps: int
    fraction: float

'''


def type_of(kind, is_flag):
    if is_flag:
        return "bool"
    kind = kind.split(":")[0]
    if kind in ("NUMBER", "INTEGER"):
        return "float" if kind == "NUMBER" else "int"
    if "X,Y,Z" in kind:
        return "float | str | Sequence[float] | npt.NDArray[Any]"
    if kind.lower() != kind:
        return "float | str"
    return "Literal[" + ", ".join(f'"{word}"' for word in kind.split("|")) + "]"


def load_core():
    """The module alone: the package imports NumPy, which need not be there where it is built."""
    path = next(path for end in importlib.machinery.EXTENSION_SUFFIXES for path in folder.glob(f"_core{end}"))
    spec = importlib.util.spec_from_file_location("_core", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


ARGUMENTS = ["V: npt.ArrayLike | Any", "F: npt.ArrayLike | Iterable[Sequence[int]] | None = None", "*",
             "fixed: npt.ArrayLike | None = None", "labels: npt.ArrayLike | None = None",
             "edges: npt.ArrayLike | None = None", "attach_weights: npt.ArrayLike | None = None",
             "region: npt.ArrayLike | None = None"]
KEYWORDS = [(f"{name.replace('-', '_')}: {type_of(kind, is_flag)} | None = None", moves_surface)
            for name, kind, _, is_flag, moves_surface in load_core().options()]
OPTIONS = [keyword for keyword, _ in KEYWORDS]


def function(name, arguments, result, indent=""):
    return [f"{indent}def {name}(", *(f"{indent}    {argument}," for argument in arguments), f"{indent}) -> {result}: ..."]


ARRAY = "npt.NDArray[np.floating[Any]]"
lines = function("smooth", [*ARGUMENTS, "progress: Callable[[Progress], Any] | None = None", *OPTIONS],
                 f"tuple[{ARRAY}, dict[str, Any]]")
lines += ["", "class Flow:", *function("__init__", ["self", *ARGUMENTS, *OPTIONS], "None", "    ")]
lines += ["    def step(self, n: int = 1) -> None: ...", "    @property", "    def n_steps(self) -> int: ...",
          "    @property", f"    def positions(self) -> {ARRAY}: ...", "    def report(self) -> dict[str, Any]: ...",
          "    def hold(self, vertices: npt.ArrayLike) -> None: ...",
          "    def release(self, vertices: npt.ArrayLike) -> None: ...",
          "    def move(self, vertices: npt.ArrayLike, to: npt.ArrayLike) -> None: ...",
          "    def attach(self, vertices: npt.ArrayLike, weights: npt.ArrayLike) -> None: ...",
          '    def __enter__(self) -> "Flow": ...', "    def __exit__(self, *_: object) -> None: ...", ""]
MESH = ARGUMENTS[:2]
lines += function("diffuse", [*MESH, "fields: npt.ArrayLike | None = None", "*", "fwhm: float | str | None = None",
                              "keep_edges: float | None = None", "fill: bool = False",
                              'boundary: Literal["free", "fixed"] = "free"', "fixed: npt.ArrayLike | None = None",
                              "labels: npt.ArrayLike | None = None",
                              *(keyword for keyword, moves_surface in KEYWORDS
                                if not moves_surface and not keyword.startswith("boundary"))],
                  f"tuple[{ARRAY}, dict[str, Any]]")
lines += ["class Geodesics:", *function("__init__", ["self", *MESH, "*", "threads: int = 0"], "None", "    "),
          f"    def distance(self, sources: npt.ArrayLike) -> {ARRAY}: ...", ""]
lines += function("geodesic_distance", [*MESH, "sources: npt.ArrayLike | None = None", "*", "threads: int = 0"], ARRAY)
(folder / "__init__.pyi").write_text(HEAD + "\n".join(lines) + "\n")
