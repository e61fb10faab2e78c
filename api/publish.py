#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""publish.py OPENAPI.yaml 3.1.json 3.2.json: the contract as the daemon serves it, once as OpenAPI 3.1, once as 3.2.

openapi.yaml is written for people: it says once what holds for every endpoint. Generators of clients read word by word,
so that what follows from the schemas is said here in full:

* a query parameter for each field that GET takes;
* the alternatives of "one of these groups" with the types of their fields: most generators type an alternative by its
  own properties only, and take one without `type` for any object;
* event streams among the contents of an answer;
* which request and which answer an item of a batch has;
* in 3.2 the QUERY operation, which 3.1 has no word for, and the items of streams.
"""
import json
import re
import sys

import yaml

EVENTS, LINES, JSON = "text/event-stream", "application/x-ndjson", "application/json"
SCHEMAS = "#/components/schemas/"
# An alternative does not close the object it is part of; linters that close every object by default are told so.
OPEN = {"unevaluatedProperties": True}
# Of a field, what is said beside its parameter and not again in the parameter's schema.
BESIDE = ("description", "examples", "x-unit", "x-ascending")


class Contract:
    """The document under way."""

    def __init__(self, document):
        self.document = document
        self.schemas = self.document["components"]["schemas"]
        # path -> its item, of the endpoints
        self.asked = {path: item for path, item in self.document["paths"].items() if "x-query" in item}

    def named(self, reference):
        return self.schemas[reference["$ref"].removeprefix(SCHEMAS)]

    def request_of(self, path):
        return self.asked[path]["post"]["requestBody"]["content"][JSON]["schema"]

    def answer_of(self, path):
        return self.asked[path]["post"]["responses"]["200"]["content"][JSON]["schema"]


# ---- query parameters ----

def nested(schema):
    """May it not stand in a query string?"""
    if schema.get("type") == "array":
        items = schema["items"]
        return items.get("type") == "object" or "allOf" in items or any("properties" in one for one in items.get("oneOf", []))
    return schema.get("type") == "object" or "allOf" in schema


def parameter(name, field, required):
    """The query parameter of a field. A list is one parameter, its items separated by commas."""
    said = {"name": name, "in": "query", "description": field["description"]}
    if required:
        said["required"] = True
    schema = {key: value for key, value in field.items() if key not in BESIDE}
    if field.get("type") == "array":
        said |= {"style": "form", "explode": False}
    said["schema"] = schema
    example = field.get("examples", [])[:1]
    if example:
        said["example"] = example[0]
    for key in ("x-unit", "x-ascending"):
        if key in field:
            said[key] = field[key]
    return said


def group_words(schema):
    """What parameters cannot say of one another."""
    lines = []
    for group in schema.get("allOf", []):
        ways = "; ".join(f"`{one['title']}`" for one in group["oneOf"])
        lines.append(f"* {group['title']}: exactly one of {ways}")
    if not lines:
        return ""
    return "\n\nParameters that exclude one another ([name] may be left out, +name is needed with the group):\n\n" + "\n".join(lines)


def give_parameters(contract):
    for path, item in contract.asked.items():
        if "get" not in item:
            continue
        schema = contract.named(contract.request_of(path))
        required = schema.get("required", [])
        fields = {name: field for name, field in schema["properties"].items() if not nested(field)}
        left = [f"`{name}`" for name in schema["properties"] if name not in fields]
        said = "Each field of the request is a query parameter of its own name"
        said += f", but {' and '.join(left)}, which only a body can hold." if left else "."
        get = item["get"]
        get["description"] = said + group_words(schema)
        get["parameters"] = ([parameter(name, field, name in required) for name, field in fields.items()]
                             + [one for one in get["parameters"] if one.get("in") != "query"])


# ---- schemas ----

def plain_type(field):
    """A field's type without its words and range, which stand beside: enough to type an alternative by."""
    if not isinstance(field, dict):
        return field
    plain = {key: field[key] for key in ("$ref", "type", "const", "enum", "required", "additionalProperties") if key in field}
    if "items" in field:
        plain["items"] = plain_type(field["items"])
    if "properties" in field:
        plain["properties"] = {name: plain_type(inner) for name, inner in field["properties"].items()}
    for key in ("oneOf", "allOf"):
        if key in field:
            plain[key] = [plain_type(one) for one in field[key]]
    return plain


def type_way(way, fields, opened, grouped=frozenset()):
    """An alternative with the types of its fields. `fields` are those of the object it belongs to, `grouped` those of the
    group's: where an alternative has none of its own, another field of the object keeps it from being any object."""
    said = way.get("properties", {})
    named = fields if not opened else re.findall(r"[A-Za-z_]\w*", way.get("title", "")) + way.get("required", [])
    own = [name for name in named if name in fields and name not in said]
    properties = {name: plain_type(fields[name]) for name in own}
    properties |= {name: plain_type(fields[name]) if here is True else here for name, here in said.items()}
    if not any(properties.values()):
        other = next((name for name in fields if name not in grouped), None)
        properties |= {other: plain_type(fields[other])} if other else {}
    typed = {**way, "type": "object", **opened, "properties": properties}
    if "anyOf" in typed:
        # in an allOf: openapi-typescript takes an anyOf beside properties for another possibility
        typed["allOf"] = [{"anyOf": [type_way(one, fields, opened) for one in typed.pop("anyOf")]}]
    return typed


def bare(ways):
    """Alternatives that only say which fields are there."""
    return all(set(way) & {"required", "properties", "anyOf", "title"} and not set(way) & {"$ref", "type", "oneOf", "const"}
               for way in ways)


class Ways:
    """Types every alternative below a node of the contract."""

    def __init__(self, contract):
        self.contract = contract

    def fields(self, node):
        """name -> schema of an object, with what allOf brings in."""
        found = {}
        for part in node.get("allOf", []):
            found |= self.fields(self.contract.named(part) if "$ref" in part else part)
        return found | {name: one for name, one in node.get("properties", {}).items() if isinstance(one, dict)}

    def type_node(self, node):
        # Where an object is closed by what its parts leave over, an open part would open it: there each part has every field.
        opened = {} if "unevaluatedProperties" in node else OPEN
        for part in node.get("allOf", []):
            if "oneOf" in part and bare(part["oneOf"]):
                grouped = {name for way in part["oneOf"] for name in way.get("properties", {})}
                part["oneOf"] = [type_way(way, self.fields(node), opened, grouped) for way in part["oneOf"]]
        for key in ("oneOf", "anyOf"):
            if bare(node.get(key, [{}])) and self.fields(node):
                node.setdefault("allOf", []).append({key: [type_way(way, self.fields(node), opened) for way in node.pop(key)]})

    def type_all(self, node):
        if isinstance(node, list):
            for inner in node:
                self.type_all(inner)
        elif isinstance(node, dict):
            # the alternatives themselves are done with their object
            below = [inner for key, inner in node.items() if key not in ("examples", "example", "default")]
            if "type" in node or "allOf" in node:
                self.type_node(node)
            for inner in below:
                self.type_all(inner)


def short(path):
    return path.removeprefix("/v1/").replace("/", "_")


def type_batches(contract):
    """An item of a batch by its endpoint, and an answer by what may answer."""
    item = contract.schemas["batch_item"]
    names = []
    for path in contract.asked:
        name = f"{short(path)}_item"
        own = {"path": {"const": path, "type": "string"}, "request": contract.request_of(path)}
        contract.schemas[name] = {**item, "title": name, "description": f"A question to {path}",
                                  "properties": {**item["properties"], **own}}
        names.append(name)
    contract.schemas["batch_item"] = {
        "description": item["description"], "oneOf": [{"$ref": SCHEMAS + name} for name in names],
        "discriminator": {"propertyName": "path",
                          "mapping": {path: SCHEMAS + name for path, name in zip(contract.asked, names)}}}
    answers = [contract.answer_of(path) for path in contract.asked]
    contract.schemas["any_answer"] = {"description": "The answer of any endpoint", "anyOf": answers}
    line = contract.schemas["batch_answer"]
    for path, answer in zip(contract.asked, answers):
        own = contract.named(answer)
        contract.schemas[f"{short(path)}_line"] = {
            **own, "description": f"{line['description']}: {path}", "properties": {"id": line["properties"]["id"], **own["properties"]}}
    contract.schemas["batch_answer"] = {"description": line["description"],
                                        "anyOf": [{"$ref": f"{SCHEMAS}{short(path)}_line"} for path in contract.asked]}


# ---- streams ----

EVENT_WORDS = ("Server-Sent Events: `progress` now and then, then one event `result`, whose data is the answer, or `problem`; "
               "`queue` before, while it waits for a worker")


def give_streams(contract, version):
    for path, item in contract.asked.items():
        for method in ("post", "x-query"):
            content = item[method]["responses"]["200"]["content"]
            if version == "3.1":
                content[EVENTS] = {"schema": {"type": "string", "description": EVENT_WORDS}}
            else:
                content[EVENTS] = {"itemSchema": event_schema(contract.answer_of(path))}


def event_schema(answer):
    """An event of a stream, in the words of OpenAPI 3.2 for them: data is a string that holds JSON."""
    def event(name, data):
        return {"type": "object", "required": ["event", "data"],
                "properties": {"event": {"const": name},
                               "data": {"type": "string", "contentMediaType": JSON, "contentSchema": data}}}
    return {"description": EVENT_WORDS,
            "oneOf": [event("queue", {"$ref": SCHEMAS + "queue_event"}), event("progress", {"$ref": SCHEMAS + "progress_event"}),
                      event("result", answer), event("problem", {"$ref": SCHEMAS + "problem"})]}


def say_items(node):
    """In 3.2 what is said of lines is said of each of them."""
    if isinstance(node, list):
        for inner in node:
            say_items(inner)
        return
    if not isinstance(node, dict):
        return
    lines = node.get(LINES)
    if isinstance(lines, dict) and "schema" in lines:
        lines["itemSchema"] = lines.pop("schema")
    for inner in node.values():
        say_items(inner)


# ---- the document ----

def separate(node):
    """A copy that shares nothing: the YAML's anchors do."""
    if isinstance(node, dict):
        return {key: separate(value) for key, value in node.items()}
    if isinstance(node, list):
        return [separate(value) for value in node]
    return node


def publish(source, version="3.1"):
    """The served document of a version, from openapi.yaml as it was read."""
    contract = Contract(separate(source))
    document = contract.document
    document["openapi"] = {"3.1": "3.1.0", "3.2": "3.2.0"}[version]
    give_parameters(contract)
    give_streams(contract, version)
    type_batches(contract)
    Ways(contract).type_all(contract.schemas)
    if version == "3.1":
        for name in ("queue_event", "progress_event"):
            del contract.schemas[name]
        return document
    say_items(document["paths"])
    for item in contract.asked.values():
        item["query"] = item.pop("x-query")
    return document


def main():
    with open(sys.argv[1], encoding="utf-8") as source:
        contract = yaml.load(source, getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    for version, path in zip(("3.1", "3.2"), sys.argv[2:], strict=True):
        with open(path, "w", encoding="utf-8") as target:
            json.dump(publish(contract, version), target, ensure_ascii=False, separators=(",", ":"))


if __name__ == "__main__":
    main()
