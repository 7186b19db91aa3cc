#!/usr/bin/env python3
"""Chooses the segment cases that the tests carry: segment_cases.py ALL.json tests/common/segment_cases.json

Deterministic. Every tag is a group, and groups take turns until the file is full: in each, first the cases that show
something new (a kind, variant, duty, angle, range or window, alone or beside others), then the others evenly spread.
One case a line, so that changes can be read.
"""
import json
import sys

MOST_BYTES = 400_000


def features(case):
    """What a case exercises; a set of strings."""
    found = {f"widgets {len(case['widgets'])}"}
    for widget in case["widgets"]:
        kind = widget["type"] + " " + widget.get("variant", "")
        if widget.get("duty", 1.0) < 1.0:
            kind += "tents"
        found.add(" ".join([kind] + [part for part in ("angle", "box", "window") if widget.get(part)]))
        if widget["amax"] == 0.0:
            found.add(f"{kind} empty")
        found.add(kind)
        if len(case["widgets"]) > 1:
            found.add(f"{kind} among others")
    return found


def by_novelty(group):
    """The group's cases, those with new features first, then the others from the whole length of it."""
    seen, first, rest = set(), [], []
    for case in group:
        new = features(case) - seen
        (first if new else rest).append(case)
        seen |= new
    # Van der Corput's order: every beginning of it is spread evenly.
    spread = sorted(range(len(rest)), key=lambda i: (int(f"{i:016b}"[::-1], 2), i))
    return first + [rest[i] for i in spread]


def line(case):
    return json.dumps(case, separators=(",", ":"))


def main(source, target):
    with open(source, encoding="utf-8") as file:
        cases = json.load(file)["cases"]
    groups = {}
    for case in cases:
        groups.setdefault("+".join(case["tags"]), []).append(case)
    queues = [by_novelty(groups[name]) for name in sorted(groups)]
    chosen, size = [], len('{"cases":[\n\n]}\n')
    for turn in range(max(map(len, queues))):
        for queue in queues:
            if turn < len(queue):
                bytes_of_case = len(line(queue[turn])) + 2
                if size + bytes_of_case <= MOST_BYTES:
                    chosen.append(queue[turn])
                    size += bytes_of_case
    chosen.sort(key=lambda case: case["id"])
    with open(target, "w", encoding="utf-8") as file:
        file.write('{"cases":[\n' + ",\n".join(map(line, chosen)) + "\n]}\n")
    print(f"{len(chosen)} of {len(cases)} cases, {size} bytes")


if __name__ == "__main__":
    main(*sys.argv[1:])
