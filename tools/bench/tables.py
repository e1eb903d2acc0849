#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Turns the raw results of rhmap_bench --json into the tables of doc/benchmark.md.

    tools/bench/tables.py bench.json                          # to the terminal
    tools/bench/tables.py bench.json --into doc/benchmark.md  # in place of the tables there
"""
import argparse
import json
import pathlib
import statistics

START = "<!-- tables.py: start -->\n"
END = "<!-- tables.py: end -->\n"


def time_text(seconds):
    """Three digits in the unit that fits."""
    for limit, factor, unit in ((1e-6, 1e9, "ns"), (1e-3, 1e6, "µs"), (1, 1e3, "ms")):
        if seconds < limit:
            return f"{three_digits(seconds * factor)} {unit}"
    return f"{three_digits(seconds)} s"


def three_digits(number):
    return f"{number:.0f}" if number >= 100 else f"{number:.3g}"


def ratio_text(ratio):
    return f"{ratio:.0f}" if ratio >= 100 else f"{ratio:.1f}" if ratio >= 10 else f"{ratio:.2f}"


def time_table(rows):
    """One line a benchmark, three columns a resolution."""
    resolutions = list(dict.fromkeys(row["resolution"] for row in rows))
    names = list(dict.fromkeys((row["name"], row["per"]) for row in rows))
    found = {(row["resolution"], row["name"]): row for row in rows}
    head = ["benchmark", "time a"] + [f"{what} {r} m" for r in resolutions for what in ("OctoMap", "rhmap", "ratio")]
    lines = [line(head), line(["---", "---"] + ["---:"] * (len(head) - 2))]
    for name, per in names:
        cells = [name, per]
        for resolution in resolutions:
            row = found.get((resolution, name))
            if row is None:
                cells += ["", "", ""]
                continue
            octomap, rhmap = statistics.median(row["octomap"]), statistics.median(row["rhmap"])
            mark = "" if row["same_answers"] else " (the answers differ)"
            cells += [time_text(octomap), time_text(rhmap), ratio_text(octomap / rhmap) + mark]
        lines.append(line(cells))
    return lines


def memory_table(rows):
    lines = [line(["map", "nodes", "OctoMap", "rhmap", "ratio"]), line(["---"] + ["---:"] * 4)]
    for row in rows:
        lines.append(
            line(
                [
                    row["map"],
                    f"{row['nodes']:,}",
                    f"{row['octomap'] / 1e6:.1f} MB",
                    f"{row['rhmap'] / 1e6:.1f} MB",
                    ratio_text(row["octomap"] / row["rhmap"]),
                ]
            )
        )
    return lines


def threads_table(rows):
    head = ["insertPointCloud", "1 thread", "threads", "time", "ratio", "maps apart"]
    lines = [line(head), line(["---"] + ["---:"] * 5)]
    for row in rows:
        one, several, apart = (statistics.median(row[which]) for which in ("one", "several", "apart"))
        mark = "" if row["same_answers"] else " (the maps differ)"
        lines.append(
            line(
                [
                    f"{row['resolution']} m",
                    time_text(one),
                    str(row["threads"]),
                    time_text(several),
                    ratio_text(one / several) + mark,
                    ratio_text(one / apart),
                ]
            )
        )
    return lines


def line(cells):
    return "| " + " | ".join(cells) + " |"


def tables(results):
    text = [
        f"{results['processor']}, g++ {results['compiler']}, one thread; {results['scans']} scans in the map "
        f"({results['variant_scans']} for the other ways to insert), rays up to {results['max_range']:g} m, "
        f"medians of {results['rounds']} rounds.",
        "",
    ]
    text += time_table(results["benchmarks"])
    if results["memory"]:
        text += ["", "Resident memory of the map:", ""] + memory_table(results["memory"])
    if results["threads"]:
        title = "A scan by several threads, by the clock on the wall, and what as many threads reach with a map each:"
        text += ["", title, ""] + threads_table(results["threads"])
    return "\n".join(text) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path, help="file of rhmap_bench --json")
    parser.add_argument("--into", type=pathlib.Path, help="Markdown file with the marks of this script")
    arguments = parser.parse_args()
    text = tables(json.loads(arguments.results.read_text(encoding="utf-8")))
    if arguments.into is None:
        print(text, end="")
        return
    document = arguments.into.read_text(encoding="utf-8")
    if START not in document or END not in document:
        parser.error(f"{arguments.into} has no lines {START.strip()} and {END.strip()}")
    before, rest = document.split(START, 1)
    after = rest.split(END, 1)[1]
    arguments.into.write_text(f"{before}{START}\n{text}\n{END}{after}", encoding="utf-8")


if __name__ == "__main__":
    main()
