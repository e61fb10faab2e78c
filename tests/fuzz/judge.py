# SPDX-License-Identifier: GPL-3.0-or-later
"""A judge of JSON Schema, fast enough for tens of thousands of answers.

It compiles the schemas of the contract to functions once; python3-jsonschema, which reads the schema anew for every
value, takes fifty times as long. It knows the keywords that the contract uses and refuses to compile any other, so
that nothing is silently not checked. tests/fuzz/ask compares it with python3-jsonschema on a sample of every run.
"""
import math
import re

ANNOTATIONS = {"title", "description", "examples", "default", "format", "deprecated"}  # and all x-...
TYPES = {
    "object": lambda v: isinstance(v, dict), "array": lambda v: isinstance(v, list),
    "string": lambda v: isinstance(v, str), "boolean": lambda v: isinstance(v, bool), "null": lambda v: v is None,
    "number": lambda v: isinstance(v, (int, float)) and not isinstance(v, bool),
    "integer": lambda v: (isinstance(v, int) and not isinstance(v, bool)) or (isinstance(v, float) and v.is_integer()),
}
BOUNDS = {
    "minimum": lambda v, bound: v >= bound, "maximum": lambda v, bound: v <= bound,
    "exclusiveMinimum": lambda v, bound: v > bound, "exclusiveMaximum": lambda v, bound: v < bound,
}
SIZES = {
    "minItems": (list, lambda v, bound: len(v) >= bound), "maxItems": (list, lambda v, bound: len(v) <= bound),
    "maxLength": (str, lambda v, bound: len(v) <= bound), "minLength": (str, lambda v, bound: len(v) >= bound),
    "minProperties": (dict, lambda v, bound: len(v) >= bound),
}


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def same(one, other):
    """Equal as JSON: 1 is 1.0, but true is not 1."""
    return one == other and isinstance(one, bool) == isinstance(other, bool)


class Judge:
    """faults(reference, value): "" where the value is what the schema says, otherwise the first fault."""

    def __init__(self, document):
        self.document = document
        self.compiled = {}

    def resolve(self, node):
        while isinstance(node, dict) and "$ref" in node and len(node) == 1:
            at = self.document
            for part in node["$ref"].lstrip("#/").split("/"):
                at = at[part.replace("~1", "/").replace("~0", "~")]
            node = at
        return node

    def fault(self, schema, value):
        return self.check(schema)(value, "")

    def check(self, schema):
        """The function (value, place) -> fault or "" of a schema."""
        known = self.compiled.get(id(schema))
        if known is None:
            # a schema that refers to itself finds this while it is being compiled; the schema is kept, so that no
            # other one gets its id
            self.compiled[id(schema)] = (lambda value, place: self.compiled[id(schema)][0](value, place)), schema
            known = self.compiled[id(schema)] = self.compile(schema), schema
        return known[0]

    def compile(self, schema):
        if schema is True:
            return lambda value, place: ""
        if schema is False:
            return lambda value, place: f"{place}: must not be there"
        rest = {key for key in schema if key not in ANNOTATIONS and not key.startswith("x-")}
        checks = []
        for key, make in self.makers().items():
            if key in rest:
                rest.remove(key)
                checks.append(make(schema[key], schema))
        rest -= {"unevaluatedProperties"}
        if rest:
            raise ValueError(f"the judge does not know {sorted(rest)}")
        if "unevaluatedProperties" in schema:
            checks.append(self.unevaluated(schema))

        def check(value, place):
            for one in checks:
                found = one(value, place)
                if found:
                    return found
            return ""
        return check

    def makers(self):
        plain = {
            "type": self.type, "enum": self.enum, "const": lambda c, _: self.enum([c], _), "pattern": self.pattern,
            "items": self.items, "properties": self.properties, "required": self.required,
            "additionalProperties": self.additional, "dependentRequired": self.dependent, "$ref": self.reference,
            "uniqueItems": self.unique, "not": self.none_of,
            "allOf": self.all_of, "oneOf": lambda parts, _: self.some_of(parts, {1}),
            "anyOf": lambda parts, _: self.some_of(parts, set(range(1, len(parts) + 1))),
        }
        for name, holds in BOUNDS.items():
            plain[name] = lambda bound, _, name=name, holds=holds: (
                lambda v, place: f"{place}: {v!r} breaks {name} {bound}" if is_number(v) and not holds(v, bound) else "")
        for name, (kind, holds) in SIZES.items():
            plain[name] = lambda bound, _, name=name, kind=kind, holds=holds: (
                lambda v, place: f"{place}: breaks {name} {bound}" if isinstance(v, kind) and not holds(v, bound) else "")
        return plain

    @staticmethod
    def type(names, _):
        tests = [TYPES[name] for name in ([names] if isinstance(names, str) else names)]
        return lambda v, place: "" if any(test(v) for test in tests) else f"{place}: {v!r:.80} is no {names}"

    @staticmethod
    def enum(choices, _):
        return lambda v, place: "" if any(same(v, c) for c in choices) else f"{place}: {v!r:.80} is none of {choices}"

    @staticmethod
    def pattern(text, _):
        match = re.compile(text).search
        return lambda v, place: f"{place}: {v!r:.80} is not {text}" if isinstance(v, str) and not match(v) else ""

    @staticmethod
    def unique(wanted, _):
        def check(value, place):
            twice = wanted and isinstance(value, list) and any(same(a, b) for i, a in enumerate(value) for b in value[:i])
            return f"{place}: an item twice" if twice else ""
        return check

    def none_of(self, schema, _):
        inner = self.check(schema)
        return lambda value, place: "" if inner(value, place) else f"{place}: is what it must not be"

    def items(self, schema, _):
        inner = self.check(schema)

        def check(value, place):
            if isinstance(value, list):
                for i, item in enumerate(value):
                    found = inner(item, f"{place}/{i}")
                    if found:
                        return found
            return ""
        return check

    def properties(self, fields, _):
        inner = {name: self.check(schema) for name, schema in fields.items()}

        def check(value, place):
            if isinstance(value, dict):
                for name, item in value.items():
                    found = inner[name](item, f"{place}/{name}") if name in inner else ""
                    if found:
                        return found
            return ""
        return check

    @staticmethod
    def required(names, _):
        def check(value, place):
            missing = [name for name in names if name not in value] if isinstance(value, dict) else []
            return f"{place}: without {missing}" if missing else ""
        return check

    def additional(self, schema, owner):
        named = set(owner.get("properties", ()))
        inner = self.check(schema)

        def check(value, place):
            if isinstance(value, dict):
                for name in value.keys() - named:
                    found = inner(value[name], f"{place}/{name}")
                    if found:
                        return found
            return ""
        return check

    @staticmethod
    def dependent(needs, _):
        def check(value, place):
            if isinstance(value, dict):
                for name, others in needs.items():
                    missing = [other for other in others if other not in value] if name in value else []
                    if missing:
                        return f"{place}: {name} without {missing}"
            return ""
        return check

    def reference(self, name, _):
        target = self.resolve({"$ref": name})
        return lambda value, place: self.check(target)(value, place)

    def all_of(self, parts, _):
        inner = [self.check(part) for part in parts]
        return lambda value, place: next(filter(None, (one(value, place) for one in inner)), "")

    def some_of(self, parts, counts):
        inner = [self.check(part) for part in parts]

        def check(value, place):
            found = [one(value, place) for one in inner]
            return "" if found.count("") in counts else f"{place}: {found.count('')} of {len(found)} ways fit ({'; '.join(found):.300})"
        return check

    def unevaluated(self, schema):
        inner = self.check(schema["unevaluatedProperties"])

        def check(value, place):
            if isinstance(value, dict):
                for name in value.keys() - self.seen(schema, value):
                    found = inner(value[name], f"{place}/{name}")
                    if found:
                        return found
            return ""
        return check

    def seen(self, schema, value):
        """The members of an object that a schema (or a part of it that fits) speaks of."""
        if not isinstance(schema, dict):
            return set()
        names = set(schema.get("properties", ())) & value.keys()
        if "additionalProperties" in schema:
            names |= value.keys()
        if "$ref" in schema:
            names |= self.seen(self.resolve({"$ref": schema["$ref"]}), value)
        for part in schema.get("allOf", ()):
            names |= self.seen(part, value)
        for part in [*schema.get("oneOf", ()), *schema.get("anyOf", ())]:
            if not self.check(part)(value, ""):
                names |= self.seen(part, value)
        return names


def not_finite(value):
    """The place of a number that JSON cannot hold, or ""."""
    if isinstance(value, float):
        return "" if math.isfinite(value) else "/"
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return next((f"/{name}{found}" for name, item in inner for found in [not_finite(item)] if found), "")
