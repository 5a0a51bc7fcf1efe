"""The wheel that pip makes: it brings all that it takes, and runs with nothing but Python and NumPy.

    python3 wheel_test.py WORK

WORK keeps what was compiled for the next time.
"""

import base64
import csv
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import unittest
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = pathlib.Path(sys.argv[1]).resolve()
OF_SYSTEM = re.compile(r"(ld-linux.*|lib(c|m|dl|rt|pthread))\.so\.\d+")
MOST_BYTES = 20e6


def call(*words, **more):
    """What a command prints, without the variables of this process."""
    environment = {"PATH": os.environ["PATH"], "PYTHONPATH": str(WORK / "site"), "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True, cwd=WORK,
                          env=environment, **more).stdout


def python(*words):
    return call(sys.executable, *words)


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        WORK.mkdir(exist_ok=True)
        for folder in ("site", "wheels"):
            subprocess.run(["rm", "-rf", WORK / folder], check=True)
        # As the presets, so that ccache knows what they have compiled.
        os.environ["CMAKE_ARGS"] = "-DSEAMFLOW_WARNINGS_AS_ERRORS=ON"
        pip = [sys.executable, "-m", "pip", "--no-cache-dir", "--disable-pip-version-check"]
        subprocess.run([*pip, "wheel", ROOT, "--wheel-dir", WORK / "wheels", "--no-deps", "--no-index",
                        "--config-settings", f"build-dir={WORK / 'build'}"], check=True)
        cls.path, = (WORK / "wheels").iterdir()
        subprocess.run([*pip, "install", cls.path, "--target", WORK / "site", "--no-deps", "--no-index"], check=True)

    def test_name_size_and_record(self):
        self.assertRegex(self.path.name, r"^seamflow-\d+\.\d+\.\d+-cp\d+-cp\d+-manylinux_2_\d+_[a-z0-9_]+\.whl$")
        self.assertLess(self.path.stat().st_size, MOST_BYTES)
        with zipfile.ZipFile(self.path) as wheel:
            names = wheel.namelist()
            self.assertEqual(len(names), len(set(names)))
            record, = (name for name in names if name.endswith("/RECORD"))
            rows = list(csv.reader(wheel.read(record).decode().splitlines()))
            self.assertEqual([row[0] for row in rows], names)
            for name, digest, size in rows:
                content = wheel.read(name)
                if name != record:
                    expected = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
                    self.assertEqual((digest, size), (f"sha256={expected}", str(len(content))), name)
            tag = re.search(r"^Tag: (.*)$", wheel.read(record.replace("RECORD", "WHEEL")).decode(), re.M)[1]
        self.assertTrue(self.path.name.endswith(f"-{tag}.whl"))

    def test_brings_all_but_the_c_library_and_nothing_under_the_gpl(self):
        binaries = [path for path in (WORK / "site" / "seamflow").rglob("*") if ".so" in path.name]
        brought = {path.name for path in binaries}
        for path in binaries:
            needed = re.findall(r"\(NEEDED\).*\[(.*)\]", call("readelf", "-d", path))
            self.assertTrue(needed)
            for library in needed:
                self.assertTrue(library in brought or OF_SYSTEM.fullmatch(library), f"{path} needs {library}")
                self.assertNotRegex(library, "cholmod|umfpack|blas|lapack")
            newest = max(int(minor) for minor in re.findall(rb"\0GLIBC_2\.(\d+)(?=[.\0])", path.read_bytes()))
            self.assertLessEqual(newest, int(re.search(r"manylinux_2_(\d+)_", self.path.name)[1]))
        licences = {path.stem for path in (WORK / "site").glob("seamflow-*.dist-info/licenses/*")}
        self.assertIn("LICENSE", licences)
        if pathlib.Path("/var/lib/dpkg/status").exists():
            self.assertTrue(any(name.startswith("libtbb") for name in licences), licences)

    def test_its_own_libraries_are_loaded(self):
        maps = python("-c", "import seamflow; print(open('/proc/self/maps').read())")
        site = str(WORK / "site" / "seamflow")
        for library in ("libtbb", "libmetis", "libfmt", "libamd", "libcamd", "libsuitesparseconfig", "libz",
                        "libxxhash"):
            loaded = set(re.findall(rf"/\S*/{library}\.so\S*", maps))
            # Python's own zlib may be there already.
            self.assertTrue(loaded, library)
            if library != "libz":
                self.assertTrue(all(path.startswith(site) for path in loaded), loaded)

    def test_brings_a_runtime_for_machines_without(self):
        maps = python("-c", """
import sys
class Missing:
    def find_spec(self, name, path=None, target=None):
        if name == "seamflow._core" and self in sys.meta_path:
            sys.meta_path.remove(self)
            raise ImportError("libstdc++.so.6: cannot open shared object file")
sys.meta_path.insert(0, Missing())
import seamflow
print(open("/proc/self/maps").read())
""")
        self.assertIn(f"{WORK}/site/seamflow/runtime/libstdc++.so.6", maps)
        self.assertNotRegex(maps, r"/usr/lib\S*/libstdc\+\+")

    def test_programs(self):
        version = python("-m", "seamflow", "--version")
        self.assertIn("MIT licence", version)
        self.assertEqual(python("-c", "import seamflow; print(seamflow.__license__)"), "MIT\n")
        python("-m", "seamflow", "generate", "noisy-sphere", "ball.ply", "--vertices", "2000")
        python("-m", "seamflow", "smooth", "ball.ply", "smooth.ply", "--radius", "2%", "--report", "report.json")
        self.assertIn("V_mean", python("-m", "seamflow", "compare", "ball.ply", "smooth.ply"))
        self.assertIn("2000", python("-m", "seamflow", "inspect", "smooth.ply"))
        for words, status in (([], 2), (["polish"], 2), (["smooth"], 2), (["smooth", "none.ply", "x.ply"], 3),
                              (["smooth", "ball.ply", "x.ply", "--factorisation", "umfpack", "--radius", "2%"], 2)):
            with self.assertRaises(subprocess.CalledProcessError) as raised:
                python("-m", "seamflow", *words)
            self.assertEqual(raised.exception.returncode, status, words)
        self.assertEqual(call(WORK / "site" / "bin" / "seamflow", "--version"), version)

    def test_every_factorisation_that_there_is(self):
        self.assertEqual(python("-c", """
import numpy as np, seamflow
n = 40
x, y = np.meshgrid(np.arange(n), np.arange(n))
V = np.column_stack([x.ravel(), y.ravel(), np.sin(x.ravel()) * np.cos(y.ravel())]).astype(float)
i = (np.arange(n - 1)[:, None] + n * np.arange(n - 1)).ravel()
F = np.column_stack([i, i + 1, i + n + 1, i + n])
options = dict(laplacian="ptackova-velho", time_step=0.1, subdomains=4, approach="sweep")
results = [seamflow.smooth(V, F, factorisation=f, **options)[0] for f in ("auto", "own")]
print(np.abs(results[0] - V).max() > 0.01, np.abs(results[0] - results[1]).max() < 1e-12)
"""), "True True\n")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
