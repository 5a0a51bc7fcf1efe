"""Makes the wheel that `pip install .` installs (PEP 517, PEP 427): CMake builds the package and installs it into a
folder, and what lies there is what the wheel has, with the texts of the licences of what it brings. Nothing in there is
under the GPL. `--config-settings build-dir=FOLDER` keeps what was compiled for the next time; the environment variable
CMAKE_ARGS has further options of CMake."""

import base64
import hashlib
import os
import pathlib
import re
import shlex
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
License: MIT
Requires-Python: >=3.9
Requires-Dist: numpy
"""
WHEEL = """\
Wheel-Version: 1.0
Generator: seamflow
Root-Is-Purelib: false
Tag: {tag}
"""
SCRIPTS = """\
[console_scripts]
seamflow = seamflow.__main__:main
"""
# Debian's packages of the headers that are compiled into the module.
HEADER_PACKAGES = ["libeigen3-dev", "libcli11-dev", "nlohmann-json3-dev", "pybind11-dev"]


def run(*command):
    subprocess.run([str(word) for word in command], check=True)


def build_package(build, target):
    run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_SHARED_LIBS=OFF",
        "-DSEAMFLOW_BUILD_TESTS=OFF", "-DSEAMFLOW_PAGE=OFF", "-DSEAMFLOW_PYTHON=REQUIRED", "-DSEAMFLOW_PYTHON_DIR=.",
        "-DSEAMFLOW_GPL=OFF", "-DSEAMFLOW_PYTHON_BUNDLE=ON",
        f"-DPython_EXECUTABLE={sys.executable}", *shlex.split(os.environ.get("CMAKE_ARGS", "")))
    run("cmake", "--build", build, "--target", "seamflow_python")
    run("cmake", "--install", build, "--component", "python", "--prefix", target, "--strip")


def platform():
    """The oldest systems on which the wheel runs are those with the C library of this one (PEP 600)."""
    machine = re.sub(r"[-.]", "_", sysconfig.get_platform())
    try:
        library, version = os.confstr("CS_GNU_LIBC_VERSION").split()
    except (AttributeError, OSError, ValueError):
        return machine
    return machine.replace("linux", f"manylinux_{version.replace('.', '_')}", 1) if library == "glibc" else machine


def licences(libraries):
    """The texts of licences: ours, and those of Debian's packages with these libraries and with the headers used."""
    packages = set(HEADER_PACKAGES)
    for library in libraries:
        found = subprocess.run(["dpkg-query", "-S", f"*/{sysconfig.get_config_var('MULTIARCH')}/{library.name}"], capture_output=True, text=True, check=False)
        packages.update(line.split(":")[0] for line in found.stdout.splitlines())
    texts = {package: pathlib.Path("/usr/share/doc", package, "copyright") for package in packages}
    return {f"licenses/{package}.txt": text.read_bytes() for package, text in sorted(texts.items()) if text.is_file()}


def describe():
    """The tag of the wheel, the name of the folder of its metadata, and the files in there."""
    version = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{python}-{python}-{platform()}"
    return tag, f"seamflow-{version}.dist-info", {
        "METADATA": METADATA.format(version=version).encode(),
        "WHEEL": WHEEL.format(tag=tag).encode(),
        "entry_points.txt": SCRIPTS.encode(),
        "licenses/LICENSE": (ROOT / "LICENSE").read_bytes(),
    }


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Nothing needs to be built for that."""
    _, info, files = describe()
    folder = pathlib.Path(metadata_directory) / info
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
    return info


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Builds outside the tree, unless told otherwise."""
    tag, info, metadata = describe()
    name = f"{info.removesuffix('.dist-info')}-{tag}.whl"
    with tempfile.TemporaryDirectory() as folder:
        package = pathlib.Path(folder).resolve() / "package"
        build_package((config_settings or {}).get("build-dir", pathlib.Path(folder) / "build"), package)
        # Of libraries what the loader looks for: the links, which a wheel cannot have.
        linked = {path.resolve() for path in package.rglob("*") if path.is_symlink()}
        paths = sorted(path for path in package.rglob("*") if path.is_file() and path not in linked)
        files = {path.relative_to(package).as_posix(): path.read_bytes() for path in paths}
        metadata.update(licences([path for path in paths if ".so" in path.name]))
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
