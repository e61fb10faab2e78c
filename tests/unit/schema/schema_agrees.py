#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""schema_agrees.py SCHEMA_LINES: the JSON Schema that a table describes itself by and the reader
of the same table must take and refuse the same documents.

Documents are made at random (seeded) from each table's schema: mostly right values, now and then
a wrong one, at every level. python3-jsonschema is the judge.
"""

import copy
import json
import random
import subprocess
import sys

from jsonschema import Draft202012Validator, validators
from jsonschema.exceptions import ValidationError

WRONG = [None, True, False, 0, -1, 1e300, 2.5, "", "1", "infinite", "both", [], [1], [2, 1], {}, {"type": "cable"}]


def ascending(validator, wanted, value, schema):
    """What draft 2020-12 cannot say: x-ascending."""
    numbers = [v for v in value if isinstance(v, (int, float))] if isinstance(value, list) else []
    if wanted and any(a >= b for a, b in zip(numbers, numbers[1:])):
        yield ValidationError("not ascending")


Judge = validators.extend(Draft202012Validator, {"x-ascending": ascending})


def number(rng, schema):
    ends = [schema[k] for k in ("minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum") if k in schema]
    low, high = (min(ends), max(ends)) if len(ends) == 2 else (min(ends + [0]), max(ends + [0]) + 10)
    value = (low + high) / 2
    if rng.random() < 20 * rng.wrong:
        value = rng.choice(ends + [low, high, low + 1, low - 1, high + 1, rng.uniform(low, high)])
    if schema.get("type") == "integer" and rng.random() < 1 - rng.wrong:
        value = float(int(value)) if rng.random() < 0.5 else int(value)
    return value


def document(rng, schema):
    """A value that is near what the schema wants; how near, is the document's own chance."""
    if rng.random() < rng.wrong:
        return rng.choice(WRONG)
    for word in ("oneOf", "anyOf", "allOf"):
        if word in schema and schema.get("type") != "object":
            return document(rng, rng.choice(schema[word]))
    if "const" in schema:
        return schema["const"]
    if "enum" in schema:
        return rng.choice(schema["enum"])
    kind = schema["type"]
    if kind in ("number", "integer"):
        return number(rng, schema)
    if kind == "boolean":
        return rng.random() < 0.5
    if kind == "string":
        return rng.choice(["x", "R_1", "_", "a" * 63] if rng.random() > 5 * rng.wrong else ["1x", "a" * 64, "é", "x y"])
    if kind == "array":
        least, most = schema.get("minItems", 0), schema.get("maxItems", 3)
        size = rng.choice([least, min(least + 1, most)] if rng.random() > 5 * rng.wrong else [most, most + 1, max(least - 1, 0)])
        items = [document(rng, schema["items"]) for _ in range(min(size, 9))]
        if schema.get("x-ascending") and rng.random() > rng.wrong and all(type(i) in (int, float) for i in items):
            items.sort()
        return items
    return members(rng, schema)


def members(rng, schema):
    properties = schema["properties"]
    chosen = {n for n in schema.get("required", []) if rng.random() > rng.wrong}
    for groups in schema.get("allOf", []):
        for one in [rng.choice(groups["oneOf"])] + ([rng.choice(groups["oneOf"])] if rng.random() < rng.wrong else []):
            optional = [w.strip("[]+") for w in one["title"].split() if w.strip("[]+") in properties]
            chosen |= {n for n in one.get("required", []) if rng.random() > rng.wrong}
            chosen |= {n for n in optional if rng.random() < 0.3}
    grouped = {n for g in schema.get("allOf", []) for o in g["oneOf"] for n, allowed in o.get("properties", {}).items() if not allowed}
    chosen |= {n for n in properties if n not in grouped and rng.random() < 0.3}
    chosen |= {n for n in sorted(grouped) if rng.random() < rng.wrong}
    value = {n: document(rng, properties[n]) for n in sorted(chosen)}
    if rng.random() < rng.wrong:
        value[rng.choice(["unknown", "Type", ""])] = 1
    return value


def compare(tool, name, count):
    described = subprocess.run([tool, "describe", name], check=True, capture_output=True, text=True).stdout
    schema = json.loads(described)
    Draft202012Validator.check_schema(schema)
    judge = Judge(schema)
    rng = random.Random(name)
    documents = []
    for _ in range(count):
        rng.wrong = rng.choice([0, 0.002, 0.01, 0.05])
        documents.append(document(rng, schema))
    lines = "".join(json.dumps(d) + "\n" for d in documents)
    answers = subprocess.run([tool, "read", name], check=True, input=lines, capture_output=True, text=True).stdout.split()
    assert len(answers) == count
    bad = 0
    for one, answer in zip(documents, answers):
        faults = [e.message for e in judge.iter_errors(copy.deepcopy(one))]
        if (answer == "1") != (not faults):
            bad += 1
            if bad <= 5:
                print(f"{name}: reader says {answer}, schema says {faults[:3]}: {json.dumps(one)}")
    taken = answers.count("1")
    print(f"{name}: {count} documents, {taken} taken, {bad} disagreements")
    # Both kinds must be there in number, or the comparison says little.
    return bad == 0 and count * 0.2 < taken < count * 0.8


if __name__ == "__main__":
    results = [compare(sys.argv[1], name, 3000) for name in ("cable", "chain", "chain_variables")]
    sys.exit(0 if all(results) else 1)
