#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""cases.py OUTPUT.c WORK_FILE CASES.json...: the table of cases.h.

What a case states for a file, a list or by several tolerances is spelled out here, so that the program has only to
compare: every expected number gets the distance that it allows, or null where it must be exactly the same.
"""
import base64
import json
import pathlib
import sys

TOLERANCES = ("absolute", "relative", "of_largest")
REPORTS = (("sergev_iwan", "sergev_iwan"), ("inclined", "grinfogel"), ("grinfogel", "grinfogel"), ("gale", "gale"),
           ("catenary", "gale"), ("forced", "gale"), ("cable", "general"), ("identify", "general"))


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def size(want):
    """The magnitude of an expected number, real or complex; None of anything else."""
    if is_number(want):
        return abs(want)
    parts = [want.get("re"), want.get("im")] if isinstance(want, dict) else want
    if isinstance(parts, list) and len(parts) == 2 and all(map(is_number, parts)):
        return abs(complex(*parts))
    return None


def spelled(want):
    return {"re": want[0], "im": want[1]} if isinstance(want, list) and size(want) is not None else want


def allowed(expect, want, largest):
    if size(want) is None or not any(name in expect for name in TOLERANCES):
        return None
    return max(expect[name] * factor for name, factor in zip(TOLERANCES, (1, size(want), largest)) if name in expect)


def check(expect, kind):
    """One check: {"kind", "pointer", "want", "allowed", "members"?, "printed"?}."""
    want = expect[kind]
    wants = want if kind in ("values", "matches") else [want]
    largest = max([size(one) or 0 for one in wants], default=0) if "of_largest" in expect else 0
    printed = expect.get("printed", [])
    return {
        "kind": kind, "pointer": expect["pointer"], "want": [spelled(one) if kind != "count" else one for one in wants],
        "allowed": [allowed(expect, one, largest) for one in wants],
        **({"members": expect["members"]} if "members" in expect else {}),
        **({"printed": printed if isinstance(printed, list) else [printed]} if printed else {}),
    }


def expectation(case, tolerance):
    if "status" in case:
        errors = case.get("errors")
        return {"status": case["status"], **({"errors": [error["pointer"] for error in errors]} if errors is not None else {})}
    checks = []
    for expect in case["expect"]:
        for part in expect.get("up_to_scale", [expect]):
            if not set(TOLERANCES) & set(part):
                part.update(tolerance)
        if "up_to_scale" in expect:
            checks.append({"kind": "up_to_scale", "parts": [check(part, "values") for part in expect["up_to_scale"]]})
        checks += [check(expect, kind) for kind in ("value", "values", "matches", "count", "below", "above", "absent")
                   if kind in expect]
    return {"checks": checks}


def report_of(family):
    return next((report for start, report in REPORTS if family.startswith(start)), "levesque")


def body_of(case):
    if "body_base64" in case:
        return base64.b64decode(case["body_base64"])
    return case["body"].encode() if "body" in case else json.dumps(case["request"]).encode()


def main():
    table, work = map(pathlib.Path, sys.argv[1:3])
    cases = []
    for file in sorted(map(pathlib.Path, sys.argv[3:])):
        document = json.loads(file.read_text(encoding="utf-8"))
        for case in document["cases"]:
            expect = json.dumps(expectation(case, document.get("tolerance", {})), ensure_ascii=False)
            texts = (report_of(case["family"]), case["family"], case["id"], case.get("endpoint", document["endpoint"]),
                     case.get("source", document["source"]))
            cases.append((*[text.encode() for text in texts], body_of(case), expect.encode()))
    first = {}
    for i, case in enumerate(cases):
        first.setdefault(case[1], i)
    cases.sort(key=lambda case: first[case[1]])

    blob, places = bytearray(), {}

    def place(data):
        if data not in places:
            places[data] = len(blob)
            blob.extend(data + b"\0")
        return f"blob + {places[data]}"

    rows = [f"    {{{', '.join(map(place, case[:6]))}, {len(case[5])}, {place(case[6])}}}," for case in cases]
    work.write_bytes(blob)
    table.write_text(f"""#include "validation/cases.h"

#define blob validation_blob
extern const char blob[];
__asm__(".pushsection .rodata\\n.global validation_blob\\nvalidation_blob:\\n"
        ".incbin \\"{work.resolve()}\\"\\n.popsection");

const validation_case validation_cases[] = {{
""" + "\n".join(rows) + "\n    {.report = NULL}};\n", encoding="utf-8")


if __name__ == "__main__":
    main()
