"""Makes the wheel that `pip install .` installs (PEP 517, PEP 427): CMake builds the package and installs it into a
folder, and what lies there is what the wheel has."""

import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
METADATA = """\
Metadata-Version: 2.1
Name: seamflow
Version: {version}
Summary: Mean curvature flow of large polygonal meshes, cut into many sub-meshes
Requires-Python: >=3.9
Requires-Dist: numpy
"""
WHEEL = """\
Wheel-Version: 1.0
Generator: seamflow
Root-Is-Purelib: false
Tag: {tag}
"""


def run(*command):
    subprocess.run([str(word) for word in command], check=True)


def build_package(build, target):
    run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_SHARED_LIBS=OFF",
        "-DSEAMFLOW_BUILD_TESTS=OFF", "-DSEAMFLOW_PAGE=OFF", "-DSEAMFLOW_PYTHON=REQUIRED", "-DSEAMFLOW_PYTHON_DIR=.",
        f"-DPython_EXECUTABLE={sys.executable}")
    run("cmake", "--build", build, "--target", "seamflow_python")
    run("cmake", "--install", build, "--component", "python", "--prefix", target)


def describe():
    """The tag of the wheel, the name of the folder of its metadata, and the files in there."""
    version = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    tag = f"{python}-{python}-{platform}"
    return tag, f"seamflow-{version}.dist-info", {
        "METADATA": METADATA.format(version=version).encode(),
        "WHEEL": WHEEL.format(tag=tag).encode(),
    }


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Nothing needs to be built for that."""
    _, info, files = describe()
    folder = pathlib.Path(metadata_directory) / info
    folder.mkdir()
    for name, content in files.items():
        (folder / name).write_bytes(content)
    return info


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Builds outside the tree."""
    tag, info, metadata = describe()
    name = f"{info.removesuffix('.dist-info')}-{tag}.whl"
    with tempfile.TemporaryDirectory() as folder:
        package = pathlib.Path(folder) / "package"
        build_package(pathlib.Path(folder) / "build", package)
        paths = sorted(path for path in package.rglob("*") if path.is_file())
        files = {path.relative_to(package).as_posix(): path.read_bytes() for path in paths}
    for of_metadata, content in metadata.items():
        files[f"{info}/{of_metadata}"] = content
    record = []
    for path, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record.append(f"{path},sha256={digest},{len(content)}\n")
    files[f"{info}/RECORD"] = ("".join(record) + f"{info}/RECORD,,\n").encode()
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, content in files.items():
            wheel.writestr(path, content)
    return name
