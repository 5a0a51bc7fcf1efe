"""Which mutants are made of a small program, and what each of them does: python3 maker_test.py COMPILER."""

import collections
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from find_mutants import choose_mutants, find_mutants, rewritten

COMPILER = sys.argv.pop(1)
ROOT = Path(__file__).resolve().parents[2]
SMALL = "tests/data/mutants/small.cpp"
COUNTS = {"comparison": 5, "condition": 5, "forgotten update": 4, "left-out call": 10, "logic": 1, "off by one": 14,
          "sign": 8, "swapped arguments": 2, "wrong neighbour": 4}


def run_sh(*arguments):
    return subprocess.run([ROOT / "tests/mutants/run.sh", *arguments], capture_output=True, text=True, check=False)


def built(folder, numbered):
    """The small program with these mutants."""
    source, asked, program = Path(folder, "small.cpp"), Path(folder, "mutant.o"), Path(folder, "small")
    source.write_bytes(rewritten((ROOT / SMALL).read_bytes(), numbered))
    compiler = [COMPILER, "-std=c++20", "-w", f"-I{ROOT}", "-include", f"{ROOT}/tests/mutants/mutant.h"]
    if not asked.exists():
        subprocess.run([*compiler, "-c", f"{ROOT}/tests/mutants/mutant.cpp", "-o", asked], check=True)
    subprocess.run([*compiler, source, asked, "-o", program], check=True)
    return program


def printed(program, seconds=None, **environment):
    """Nothing if it takes longer."""
    try:
        return subprocess.run([program], env=os.environ | environment, stdout=subprocess.PIPE, timeout=seconds,
                              check=False).stdout
    except subprocess.TimeoutExpired:
        return None


def apart(mutants):
    """Those of one line are in different dictionaries; the numbers are the same in each."""
    groups = []
    for mutant in mutants:
        group = next((g for g in groups if not any(mutant.lines & m.lines for m in g.values())), None)
        if group is None:
            groups.append(group := {})
        group[len(group)] = mutant
    return groups


class Maker(unittest.TestCase):
    def test_of_each_operator_there_are_as_many_as_there_should_be(self):
        mutants = find_mutants(ROOT, SMALL)
        self.assertEqual(collections.Counter(m.operator for m in mutants), COUNTS)
        lines = (ROOT / SMALL).read_text().splitlines()
        first = lines.index("    int operator[](int i) const { return values[static_cast<unsigned>(i)] + low; }") + 1
        self.assertEqual(min(m.line for m in mutants), first)
        self.assertNotIn(lines.index("    if constexpr (std::is_signed_v<Value> && sizeof(Value) == 4)") + 1,
                         {m.line for m in mutants})

    def test_each_mutant_alone_changes_what_the_program_prints(self):
        with tempfile.TemporaryDirectory() as folder:
            unchanged = printed(built(folder, {}))
            for place, numbered in enumerate(apart(find_mutants(ROOT, SMALL))):
                program, reached = built(folder, numbered), Path(folder, f"reached{place}")
                self.assertEqual(printed(program, SEAMFLOW_MUTANTS_REACHED=str(reached)), unchanged)
                self.assertEqual(sorted(map(int, reached.read_text().split())), list(numbered))
                for number, mutant in numbered.items():
                    self.assertNotEqual(printed(program, 2, SEAMFLOW_MUTANT=str(number)), unchanged, str(mutant))

    def test_the_seed_chooses_and_no_two_are_on_one_line(self):
        chosen = choose_mutants(ROOT, [SMALL], 3, 1000)
        self.assertEqual(chosen, choose_mutants(ROOT, [SMALL], 3, 1000))
        lines = [line for mutant in chosen for line in mutant.lines]
        self.assertEqual(len(lines), len(set(lines)))
        self.assertGreaterEqual(set(lines), {m.line for m in find_mutants(ROOT, SMALL)})
        self.assertNotEqual(chosen, choose_mutants(ROOT, [SMALL], 4, 1000))
        self.assertEqual(len(choose_mutants(ROOT, [SMALL], 3, 5)), 5)

    def test_the_command(self):
        listed = run_sh("--list", "--seed", "3", "--count", "2", SMALL)
        self.assertEqual(listed.returncode, 0)
        self.assertEqual(listed.stdout.splitlines(), [str(m) for m in choose_mutants(ROOT, [SMALL], 3, 2)])
        self.assertEqual(run_sh("--help").returncode, 0)
        for wrong in (["--sead", "3"], ["--seed", "x"], ["--count", "0"], ["no/such.cpp"], ["/"]):
            self.assertEqual(run_sh(*wrong).returncode, 2, wrong)


if __name__ == "__main__":
    unittest.main()
