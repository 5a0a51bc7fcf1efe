"""Makes mutants, builds all of them into one copy of the tree, and counts those that the tests notice; see run.sh."""

import argparse
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from find_mutants import choose_mutants, rewritten

ROOT = Path(__file__).resolve().parents[2]
TREE = ROOT / "build-mutants"
LOG = TREE / "build" / "mutants.log"
# Of each test, its time and the numbers of the mutants that it reaches.
REACHED = TREE / "build" / "reached.txt"
LIBRARIES = ["partition", "solvers", "engine"]
UNIT_TESTS = r"(partition|solvers|engine|distributed)\.(?!mpi_)"
PROGRAM_TESTS = r"samples\.(?!.*(interruption|in_browser|python|wheel))"
# Of one process, for a mutant may take all memory there is.
MOST_BYTES = 8 << 30


# ---- the copy of the tree

def tree_files(root):
    """Those that are not built, as paths in it."""
    for folder, folders, files in os.walk(root):
        if Path(folder) == root:
            folders[:] = [f for f in folders if not re.match(r"\.git$|\.cache$|build$|build-|output$", f)]
        yield from (str(Path(folder, f).relative_to(root)) for f in files)


def write_copy(numbered):
    """Brings the copy up to date, with these mutants in it. Files that are as they should be are not touched."""
    library = "partition/CMakeLists.txt"
    more = "\ntarget_sources(seamflow_partition PRIVATE ${PROJECT_SOURCE_DIR}/tests/mutants/mutant.cpp)\n"
    changed = {library: (ROOT / library).read_bytes() + more.encode()}
    for path in {m.path for m in numbered.values()}:
        changed[path] = rewritten((ROOT / path).read_bytes(), {n: m for n, m in numbered.items() if m.path == path})
    paths = set(tree_files(ROOT))
    for path in paths:
        content = changed[path] if path in changed else (ROOT / path).read_bytes()
        copy = TREE / path
        if not copy.is_file() or copy.read_bytes() != content:
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(content)
            shutil.copymode(ROOT / path, copy)
    for path in set(tree_files(TREE)) - paths:
        (TREE / path).unlink()


# ---- the build

def succeeds(*command):
    """Whether a command in the copy does; its output is in the log."""
    LOG.parent.mkdir(exist_ok=True)
    with LOG.open("wb") as file:
        return subprocess.run(command, cwd=TREE, stdout=file, stderr=subprocess.STDOUT, check=False).returncode == 0


def builds(targets):
    """Whether all of them do; of those that do not, the log has all errors."""
    return succeeds(
        "cmake", "--preset", "release", "-DSEAMFLOW_BUILD_SAMPLES=ON", "-DSEAMFLOW_BUILD_TESTS=ON",
        "-DSEAMFLOW_PAGE=OFF", "-DSEAMFLOW_PYTHON=OFF", "-DSEAMFLOW_WARNINGS_AS_ERRORS=OFF",
        "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", f"-DCMAKE_CXX_FLAGS=-w -include {TREE}/tests/mutants/mutant.h"
    ) and succeeds("cmake", "--build", "build", "--parallel", str(os.cpu_count()), "--target", *targets, "--", "-k0")


def wrong_mutants(numbered):
    """The numbers of those on lines with errors in the log; if there are none, on lines that the log names beside."""
    errors, others = set(), set()
    for line in LOG.read_text(errors="replace").splitlines():
        for name, number in re.findall(r"([\w./-]+):(\d+)[:,]", line):
            if not line.startswith(("In file included", "       ")):
                places = errors if " error: " in line else others
                places.add((os.path.relpath(TREE / "build" / name, TREE), int(number)))
    for places in (errors, others):
        wrong = {n for n, m in numbered.items() if any((m.path, line) in places for line in m.lines)}
        if wrong:
            return wrong
    sys.exit(f"The copy of the tree does not build, and no mutant is the reason: see {LOG}")


def build(numbered, targets):
    """Builds the copy with all mutants but those that do not compile. @returns the others, by their numbers."""
    write_copy(numbered)
    while not builds(targets):
        wrong = wrong_mutants(numbered)
        numbered = {n: m for n, m in numbered.items() if n not in wrong}
        write_copy(numbered)
    return numbered


# ---- the tests

@dataclass
class Test:
    name: str
    command: list
    properties: dict
    seconds: float = 0.0
    reached: set = field(default_factory=set)


def list_tests(pattern):
    listed = json.loads(subprocess.run(["ctest", "--test-dir", "build", "--show-only=json-v1"], cwd=TREE, check=True,
                                       capture_output=True).stdout)
    return [Test(t["name"], t["command"] + ["--abort-after=1"] * t["command"][0].endswith("_tests"),
                 {p["name"]: p["value"] for p in t["properties"]})
            for t in listed["tests"] if re.match(pattern, t["name"])]


def passes(test, seconds, **environment):
    """Whether a test ends well within so many seconds."""
    environment |= dict(e.split("=", 1) for e in test.properties.get("ENVIRONMENT", []))
    limits = ["prlimit", f"--data={MOST_BYTES}", "timeout", "--signal=KILL", str(seconds)]
    ended = subprocess.run(limits + test.command, cwd=test.properties["WORKING_DIRECTORY"],
                           env=os.environ | environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                           stderr=subprocess.DEVNULL, check=False)
    return ended.returncode in (0, test.properties.get("SKIP_RETURN_CODE"))


def note_reached(test, longest):
    """Runs a test without a mutant, and notes its time and the mutants that it reaches. @returns whether it passes."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "reached")
        begin = time.monotonic()
        passed = passes(test, longest, SEAMFLOW_MUTANT="-1", SEAMFLOW_MUTANTS_REACHED=str(file))
        test.seconds = time.monotonic() - begin
        if passed and file.is_file():
            test.reached = {int(n) for n in file.read_text().split()}
    return passed


def verdict_on(number, mutant, tests):
    """Runs the tests that reach a mutant until one fails: the one of its source first, then the fastest."""
    own = f".{Path(mutant.path).stem}_test"
    reaching = sorted((t for t in tests if number in t.reached), key=lambda t: (not t.name.endswith(own), t.seconds))
    for test in reaching:
        if not passes(test, 20 + 10 * test.seconds, SEAMFLOW_MUTANT=str(number)):
            return f"noticed by {test.name}"
    return f"survives {len(reaching)} tests that reach it" if reaching else "survives, for no test reaches it"


def judge(built, tests, longest):
    """@returns what becomes of each mutant, by their numbers."""
    verdicts = {}
    with ThreadPoolExecutor(os.cpu_count()) as pool, REACHED.open("w", encoding="utf-8") as record:
        for test, passed in zip(tests, pool.map(lambda t: note_reached(t, longest), tests)):
            print(test.name, f"{test.seconds:.1f} s", *sorted(test.reached), file=record, flush=True)
            if not passed:
                reason = "takes too long" if test.seconds >= longest else "fails without a mutant"
                print(f"{test.name} {reason}, and is left out.", flush=True)
        for number, verdict in zip(built, pool.map(lambda n: verdict_on(n, built[n], tests), built)):
            verdicts[number] = verdict
            print(f"{built[number]}: {verdict}", flush=True)
    return verdicts


# ---- the command

def source_files(names):
    """The sources that are named, and those in folders that are, sorted."""
    found = set()
    for path in (ROOT / name for name in names):
        inside = [path] if path.is_file() else (p for p in path.rglob("*") if p.suffix in (".h", ".cpp"))
        found |= {str(p.resolve().relative_to(ROOT)) for p in inside}
    return sorted(found)


def parsed_arguments():
    parser = argparse.ArgumentParser(prog="tests/mutants/run.sh", allow_abbrev=False,
                                     description="Makes mutants, and counts those that the tests notice.")
    parser.add_argument("--seed", type=int, default=1, help="chooses the mutants, the same ones each time")
    parser.add_argument("--count", type=int, default=30, help="how many are made")
    parser.add_argument("--least", type=float, default=85, help="the percentage to notice, or the exit status is 1")
    parser.add_argument("--longest", type=float, default=3600, help="leaves out tests that take more seconds")
    parser.add_argument("--programs", action="store_true", help="runs the tests of the programs, too")
    parser.add_argument("--list", action="store_true", help="prints the mutants, and builds nothing")
    parser.add_argument("files", nargs="*", default=LIBRARIES, metavar="FILE",
                        help=f"a source or a folder in the tree; by default {', '.join(LIBRARIES)}")
    arguments = parser.parse_args()
    if not 1 <= arguments.count <= 10000:
        parser.error("--count is from 1 to 10000")
    for name in arguments.files:
        if not (ROOT / name).resolve().is_relative_to(ROOT) or not source_files([name]):
            parser.error(f"there are no sources {name}")
    return arguments


def report(n_made, built, verdicts, least):
    """Prints survivors and score. @returns whether enough mutants are noticed."""
    survivors = [n for n in built if verdicts[n].startswith("survives")]
    for mutant, verdict in ((built[n], verdicts[n]) for n in survivors):
        line = (ROOT / mutant.path).read_text(encoding="utf-8").splitlines()[mutant.line - 1].strip()
        print(f"\n{mutant}\n    {line}\n    {verdict}")
    score = 100.0 * (len(built) - len(survivors)) / len(built)
    print(f"\n{n_made - len(built)} of {n_made} mutants do not compile, and do not count.")
    print(f"Score: {score:.0f} % of {len(built)} mutants are noticed; {least:g} % are wanted.")
    return score >= least


def main():
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    arguments = parsed_arguments()
    made = dict(enumerate(choose_mutants(ROOT, source_files(arguments.files), arguments.seed, arguments.count)))
    if arguments.list:
        print(*made.values(), sep="\n")
        return 0
    built = build(made, ["all"] if arguments.programs else [f"{t}_tests" for t in [*LIBRARIES, "distributed"]])
    if not built:
        sys.exit("There are no mutants that compile.")
    tests = list_tests(f"{UNIT_TESTS}|{PROGRAM_TESTS}" if arguments.programs else UNIT_TESTS)
    verdicts = judge(built, tests, arguments.longest)
    return 0 if report(len(made), built, verdicts, arguments.least) else 1


if __name__ == "__main__":
    sys.exit(main())
