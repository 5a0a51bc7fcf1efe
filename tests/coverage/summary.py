"""Prints how much of each folder the tests run and lists the lines that they do not.

    summary.py REPORT LIST LEAST

REPORT: what gcovr --json writes. LIST: the file to write, a line per source file. LEAST: the percentage of all lines below
which the exit status is 1.
"""

import collections
import json
import sys


def ranges(numbers):
    """[3, 4, 5, 9] as "3-5, 9"."""
    found = []
    for number in sorted(numbers):
        if found and number == found[-1][1] + 1:
            found[-1][1] = number
        else:
            found.append([number, number])
    return ", ".join(str(a) if a == b else f"{a}-{b}" for a, b in found)


def percent(run, total):
    return 100.0 * run / total if total else 100.0


def main():
    report, listed, least = sys.argv[1], sys.argv[2], float(sys.argv[3])
    with open(report, encoding="utf-8") as file:
        sources = json.load(file)["files"]
    folders = collections.Counter()
    totals = collections.Counter()
    with open(listed, "w", encoding="utf-8") as file:
        for source in sorted(sources, key=lambda s: s["file"]):
            lines = [line for line in source["lines"] if not line["gcovr/noncode"]]
            missing = {line["line_number"] for line in lines if line["count"] == 0}
            for name in {source["file"].split("/")[0], "all"}:
                totals[name] += len(lines)
                folders[name] += len(lines) - len(missing)
            if missing:
                share = percent(len(lines) - len(missing), len(lines))
                file.write(f"{source['file']}  {share:.0f} % of {len(lines)}: {ranges(missing)}\n")
    print("\nLines that the tests run:")
    for name in [*sorted(set(totals) - {"all"}), "all"]:
        print(f"{name:10} {percent(folders[name], totals[name]):5.1f} % of {totals[name]}")
    if percent(folders["all"], totals["all"]) < least:
        sys.exit(f"That is less than {least:.0f} %.")


main()
