# SPDX-License-Identifier: GPL-3.0-or-later
"""The contract, api/openapi.yaml, against the field tables and a running daemon."""
import importlib.machinery
import importlib.util
import json
import pathlib
import subprocess
import sys
import urllib.parse

import pytest
import yaml
from jsonschema import Draft202012Validator, RefResolver

from conftest import PROGRAM, ROOT
from published import publish

BUILD = pathlib.Path(PROGRAM).resolve().parents[1]
SOURCE = yaml.safe_load((ROOT / "api/openapi.yaml").read_text(encoding="utf-8"))
# What clients read: answers are held against it.
CONTRACT = publish(SOURCE, "3.1")
EXAMPLES = sorted((ROOT / "api/examples").glob("*.json"))
CASE_FILES = sorted((ROOT / "tests/cases").glob("*.json"))
JSON = {"Content-Type": "application/json"}


def load(path):
    return json.loads(path.read_text(encoding="utf-8"))


def script(path):
    """A script without .py, as a module."""
    loader = importlib.machinery.SourceFileLoader(path.name, str(path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(path.name, loader))
    writes, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    try:
        loader.exec_module(module)
    finally:
        sys.dont_write_bytecode = writes
    return module


CASES = script(ROOT / "tests/cases/run")


def resolve(node, contract=CONTRACT):
    while "$ref" in node:
        node = RefResolver("", contract).resolve(node["$ref"])[1]
    return node


def faults(schema, value):
    judge = Draft202012Validator(schema, resolver=RefResolver("", CONTRACT))
    return [f"/{'/'.join(map(str, e.absolute_path))}: {e.message[:300]}" for e in judge.iter_errors(value)]


def operation(method, path):
    return CONTRACT["paths"][path][method.lower()]


def check(method, path, response):
    """Is this answer what the contract says of the operation? Its document, if it has one."""
    known = operation(method, path)["responses"]
    said = resolve(known.get(str(response.status_code), known["default"]))
    for name, header in said.get("headers", {}).items():
        if name in response.headers:
            assert not faults(resolve(header)["schema"], response.headers[name]), (name, response.headers[name])
    if "content" not in said:
        assert not response.content
        return None
    kind = response.headers["Content-Type"].split(";")[0]
    assert kind in said["content"], f"{response.status_code} with {kind}"
    document = response.json() if kind.endswith("json") else response.text
    assert not faults(said["content"][kind]["schema"], document)
    return document


# ------------------------------------------------------------------------------------ the document itself

def every(node, key, path=""):
    """Every value of `key` in the contract, with its place."""
    if isinstance(node, dict):
        if key in node:
            yield path, node[key]
        for name, inner in node.items():
            yield from every(inner, key, f"{path}/{name}")
    elif isinstance(node, list):
        for i, inner in enumerate(node):
            yield from every(inner, key, f"{path}/{i}")


def test_request_schemas_follow_the_tables():
    done = subprocess.run([ROOT / "api/update", "--check", BUILD], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def keep_the_parameters(parameters, request):
    """A query parameter for every field of the table that is no object and no list of them, with its type and range."""
    said = {one["name"]: one for one in map(resolve, parameters) if one["in"] == "query"}
    kinds = {name: json.dumps(field) for name, field in request["properties"].items()}
    assert set(said) == {name for name, kind in kinds.items() if '"properties"' not in kind}
    for name, one in said.items():
        field = request["properties"][name]
        for key in ("type", "minimum", "exclusiveMinimum", "maximum", "exclusiveMaximum", "enum", "default", "items", "oneOf"):
            assert one["schema"].get(key) == field.get(key), (name, key)
        assert one.get("required", False) == (name in request.get("required", []))
        assert one.get("explode", True) == (field.get("type") != "array")
        assert not faults(one["schema"], one["example"]), name


def test_every_endpoint_is_in_the_contract():
    tables = json.loads(subprocess.run([BUILD / "api/schemas"], check=True, capture_output=True).stdout)
    assert tables
    for path, table in tables.items():
        body = operation("post", path)["requestBody"]["content"]["application/json"]["schema"]
        assert body == {"$ref": f"#/components/schemas/{table['name']}"}
        assert operation("x-query", path)["requestBody"] == operation("post", path)["requestBody"]
        assert ("get" in CONTRACT["paths"][path]) == table["query"]
        if table["query"]:
            keep_the_parameters(operation("get", path)["parameters"], table["request"])
        examples = [load(example) for example in EXAMPLES]
        assert path in [example["endpoint"] for example in examples], f"no example of {path}"


def test_the_daemon_serves_what_the_contract_names(strumd):
    served = strumd.get("/no/such/path").json()["detail"]
    for path in CONTRACT["paths"]:
        assert path in served
    listed = served.split("known paths: ")[1].split(", ")
    assert set(listed) == set(CONTRACT["paths"])


def nulls(node, path=""):
    items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for name, inner in items:
        yield from [f"{path}/{name}"] if inner is None else nulls(inner, f"{path}/{name}")


def test_the_source_has_no_member_without_a_value():
    """An unquoted comma in a flow mapping makes one."""
    assert not list(nulls(SOURCE))


@pytest.mark.parametrize("version", ["3.1", "3.2"])
def test_the_contract_is_whole(version):
    contract = publish(SOURCE, version)
    assert contract["openapi"] == f"{version}.0"
    for place, reference in every(contract, "$ref"):
        assert reference.startswith("#/"), place
        resolve({"$ref": reference}, contract)
    for name, schema in contract["components"]["schemas"].items():
        Draft202012Validator.check_schema(schema)
        assert schema.get("type") or schema.get("oneOf") or schema.get("anyOf"), name
    names = [name for _, name in every(contract["paths"], "operationId")]
    assert len(names) == len(set(names))
    used = {reference for _, reference in every(contract, "$ref")}
    for kind in ("parameters", "headers", "responses", "schemas", "examples"):
        for name in contract["components"][kind]:
            assert f"#/components/{kind}/{name}" in used, f"{kind}/{name} is not used"


@pytest.mark.parametrize("version", ["3.1", "3.2"])
def test_no_object_is_any_object(version):
    """Generators type {type: object} as an object without members."""
    def objects(node, place):
        items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
        if isinstance(node, dict) and node.get("type") == "object":
            yield place, node
        for name, inner in items:
            if name not in ("examples", "example"):
                yield from objects(inner, f"{place}/{name}")
    found = list(objects(publish(SOURCE, version), ""))
    assert len(found) > 100
    for place, node in found:
        assert set(node) & {"properties", "additionalProperties", "allOf"}, place


def test_the_query_operation_of_3_2():
    newer = publish(SOURCE, "3.2")
    for path, item in CONTRACT["paths"].items():
        assert ("query" in newer["paths"][path]) == ("x-query" in item) and "x-query" not in newer["paths"][path]
        if "x-query" in item:
            query = newer["paths"][path]["query"]
            assert {**query, "responses": None} == {**item["x-query"], "responses": None}
            assert "itemSchema" in query["responses"]["200"]["content"]["text/event-stream"]
            for method in ("post", "x-query"):
                assert "text/event-stream" in item[method]["responses"]["200"]["content"]


def test_published_schemas_hold_what_the_source_holds(strumd):
    """Alternatives were given types: they must not have come to mean something else."""
    for name, schema in REQUESTS.items():
        judges = [Draft202012Validator({"$ref": f"#/components/schemas/{name}"}, resolver=RefResolver("", document))
                  for document in (SOURCE, CONTRACT)]
        examples = [load(path)["request"] for path in EXAMPLES if load(path)["endpoint"].removeprefix("/v1/").replace("/", "_") in name]
        singles = [{field: said["examples"][0]} for field, said in schema["properties"].items()]
        pairs = [{**one, **other} for one in singles for other in singles]
        for request in examples + singles + pairs + [{**e, **one} for e in examples for one in singles]:
            assert judges[0].is_valid(request) == judges[1].is_valid(request), (name, request)


def fields_of(schema, place=""):
    """Every field of a request, those of nested objects and lists too, with its place."""
    for part in schema.get("allOf", []) + schema.get("oneOf", []) + ([schema["items"]] if "items" in schema else []):
        yield from fields_of(part, place)
    for name, field in schema.get("properties", {}).items():
        if isinstance(field, dict) and "const" not in field:
            yield f"{place}/{name}", field
            yield from fields_of(field, f"{place}/{name}")


REQUESTS = {name: schema for name, schema in SOURCE["components"]["schemas"].items() if name.endswith("_request")}
# what these stand for says which unit and range they have
ANY_NUMBER = ("variable", "scale", "offset", "re", "im", "min", "max")


@pytest.mark.parametrize("name", REQUESTS)
def test_every_field_has_unit_range_and_example(name):
    fields = list(fields_of(REQUESTS[name]))
    assert fields
    for place, field in fields:
        assert field["description"], place
        example, = field["examples"]
        assert not faults(field, example), place
        if "default" in field:
            assert not faults(field, field["default"]), place
        numbers = [one for one in [field, *field.get("oneOf", []), field.get("items", {})] if one.get("type") in ("number", "integer")]
        if not numbers or place.split("/")[-1] in ANY_NUMBER:
            continue
        if numbers[0].get("type") == "number" and field.get("type") != "array":
            assert field["x-unit"], place
        for one in numbers:
            assert {"minimum", "exclusiveMinimum"} & set(one) and {"maximum", "exclusiveMaximum"} & set(one), place


def test_the_judge_refuses_what_is_wrong():
    """A judge that takes everything would pass every test below."""
    example = next(load(e) for e in EXAMPLES if "catenary_frequencies" in str(e))
    schema = operation("post", example["endpoint"])["responses"]["200"]["content"]["application/json"]["schema"]
    good = example["answer"]
    assert not faults(schema, good)
    for wrong in ({**good, "extra": 1}, {**good, "result": {}}, {**good, "meta": {}}, {**good, "warnings": [1]},
                  {**good, "request": {**good["request"], "modes": 0}}):
        assert faults(schema, wrong)
    for _, modes in every(good, "frequency_ratio"):
        assert modes > 0
    deeper = json.loads(json.dumps(good))
    deeper["result"]["in_plane"][0]["frequency"] = 1
    assert faults(schema, deeper)


# --------------------------------------------------------------------------------------------- live answers

def same_structure(one, other, place=""):
    """The places at which two documents differ in more than values."""
    if isinstance(one, dict) and isinstance(other, dict):
        if list(one) != list(other):
            return [f"{place}: {list(one)} and {list(other)}"]
        return [fault for name in one for fault in same_structure(one[name], other[name], f"{place}/{name}")]
    if isinstance(one, list) and isinstance(other, list):
        if len(one) != len(other):
            return [f"{place}: {len(one)} and {len(other)} items"]
        pairs = enumerate(zip(one, other))
        return [fault for i, (a, b) in pairs for fault in same_structure(a, b, f"{place}/{i}")]
    number = (int, float)
    same = type(one) is type(other) or (type(one) in number and type(other) in number)
    return [] if same else [f"{place}: {one!r} and {other!r}"]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_are_what_they_say(strumd, path):
    example = load(path)
    live = check("post", example["endpoint"], strumd.post(example["request"], example["endpoint"]))
    assert not same_structure(example["answer"], live)
    assert example["expect"]
    # the printed answer and the live one, both against values from elsewhere
    for answer in (example["answer"], live):
        for expect in example["expect"]:
            tolerant = {**example.get("tolerance", {}), **expect}
            assert CASES.check_expectation(answer, tolerant) == []


CATENARY, FORCED, INCLINED = "/v1/catenary/frequencies", "/v1/forced/tension", "/v1/inclined/modes"
TAUT, MATRIX = "/v1/taut/modes", "/v1/taut/matrix"
CABLE = {"type": "cable", "length_m": 20, "mass_kg_per_m": 1}
HANGING = {"type": "hanging_absorber", "mass_kg": 5, "stiffness_N_per_m": 68.45, "damping_N_s_per_m": 60}
ABSORBER = {"type": "inline_absorber", "links": 2 * [{"left_m": .2, "right_m": .2, "mass_kg": 9, "inertia_kg_m2": .12}],
            "joints": [{"spring_arm_m": .03, "damper_arm_m": .03, "stiffness_N_per_m": 10, "damping_N_s_per_m": "infinite"}]}
EVERY_PART = [
    CABLE, {"type": "point_mass", "mass_kg": 3}, {**CABLE, "drag_N_s_per_m2": .1, "tension_N": 4900}, HANGING, CABLE, ABSORBER,
    {"type": "varying_cable", "length_m": 9, "mass_kg_per_m": 1, "tension_left_N": 5000, "tension_right_N": 6000},
    {"type": "lump", "length_m": 1, "mass_kg": 2, "centre_m": .3, "radius_of_gyration_m": .2, "tension_N": 6000},
    {"type": "bar", "length_m": 1, "mass_kg": 2}, {"type": "sphere", "diameter_m": 1, "mass_kg": 2},
    {"type": "cone", "height_m": 1, "base_radius_m": .5, "mass_kg": 2, "apex": "right", "tension_left_N": 5000, "tension_right_N": 5100},
    {"type": "spring", "stiffness_N_per_m": 100}, {"type": "damper", "damping_N_s_per_m": 3}, {"type": "inerter", "inertance_kg": 1},
    {"type": "support", "length_m": 1, "pivot_m": .5, "inertia_kg_m2": .1}, CABLE]
VARIATIONS = [
    (CATENARY, {"sag_parameter": 0.9}),
    (CATENARY, {"rise_to_span": 0.5, "sag_parameter": 0.7, "shape_points": 5}),
    (CATENARY, {"xi_1": 0.05, "xi_2": 4, "plane": "in_plane", "modes": 1}),
    (CATENARY, {"chi_1": -1, "chi_2": 0.5, "plane": "out_of_plane", "verify": True}),
    (CATENARY, {"sag_parameter": 0.9, "eta_tangential": 0.1, "eta_normal": 0.4, "shape_points": 3, "verify": True}),
    (CATENARY, {"sag_parameter": 0.9, "eta_tangential": 8, "eta_normal": 8}),
    (CATENARY, {"sag_parameter": 0.5, "method": "rayleigh", "plane": "both", "verify": True}),
    (CATENARY, {"span_m": 100, "rise_m": -20, "length_m": 120, "verify": True}),
    (CATENARY, {"span_m": 100, "length_m": 120, "mass_kg_per_m": 2, "weight_N_per_m": 10, "added_mass_kg_per_m": 1,
                "eta_normal": 0.5, "shape_points": 4}),
    (CATENARY, {"span_m": 100, "unstretched_length_m": 99, "axial_stiffness_N": 1e7, "mass_kg_per_m": 3,
                "shape_points": 2}),
    (CATENARY, {"span_m": 100, "length_m": 101, "axial_stiffness_N": 1e7, "mass_kg_per_m": 3,
                "weight_N_per_m": 4000}),
    (FORCED, {"sag_parameter": 0.9, "frequency_ratio_min": 0, "frequency_ratio_max": 5, "points": 11, "verify": True}),
    (FORCED, {"sag_parameter": 0.9, "eta_normal": 0.3, "frequency_ratios": [0, 1, 2], "profiles_at": [1, 2],
              "profile_points": 3, "normal_displacement": 0.02, "out_of_plane_displacement": 0.01}),
    (FORCED, {"span_m": 100, "length_m": 110, "mass_kg_per_m": 2, "tangential_displacement_m": 0.5,
              "frequency_ratio_min": 1, "frequency_ratio_max": 4, "points": 3, "profiles_at": [0, 1.5]}),
    # no motion given: one way of giving it, not two; a profile of one place
    (FORCED, {"span_m": 100, "length_m": 110, "frequency_ratios": [0.7], "profiles_at": [0.7], "profile_chi": [0]}),
    (FORCED, {"sag_parameter": 0.8, "frequency_ratios": [1.1], "profiles_at": [1.1], "profile_points": 2, "harmonics": [
        {"multiple": 1, "tangential": 0.01}, {"multiple": 3, "normal": 0.002, "phase_deg": 30}]}),
    (FORCED, {"span_m": 100, "length_m": 110, "mass_kg_per_m": 2, "eta_normal": 0.2, "frequency_ratios": [0.7, 2],
              "harmonics": [{"multiple": 1, "tangential": 0.01}, {"multiple": 2, "tangential": 0.005}]}),
    (TAUT, {"tension_N": 5000, "components": EVERY_PART, "shape_points": 4, "verify": True}),
    (TAUT, {"tension_N": 5000, "components": [CABLE, ABSORBER, CABLE], "right_end": "free", "shape_points": 3, "verify": True}),
    (TAUT, {"tension_N": 5000, "components": [CABLE], "left_end": "free", "right_end": "free", "mode_numbers": [1, 2, 7]}),
    (TAUT, {"tension_N": 5000, "components": [CABLE, HANGING, CABLE], "band_rad_per_s": [0.5, 30], "method": "muller"}),
    (MATRIX, {"tension_N": 5000, "components": EVERY_PART, "angular_frequencies": [3, {"re": 1, "im": 2}]}),
    (INCLINED, {"epsilon": 0.2, "inclination_deg": 30, "lambda_squared": 40, "compare": True, "verify": True}),
    (INCLINED, {"epsilon": 0.2, "inclination_deg": 0, "lambda_squared": 0.4, "inextensible": False, "modes": 8,
                "model": "airy", "airy_expansion": "tangent", "shape_points": 3, "verify": True}),
    (INCLINED, {"epsilon": 1.5, "inclination_deg": 60, "inextensible": True, "mass_ratio": 0.8, "compare": True}),
    (INCLINED, {"length_m": 500, "horizontal_tension_N": 8e5, "mass_kg_per_m": 18, "axial_stiffness_N": 1.5e8,
                "inclination_deg": 10, "statics": "elastic", "shape_points": 2, "compare": True}),
    (INCLINED, {"length_m": 500, "tension_N": 8e5, "mass_kg_per_m": 18, "weight_N_per_m": 150, "lambda_squared": 2,
                "inclination_deg": 45, "model": "asymptotic", "verify": True}),
    (INCLINED, {"epsilon": 0.4, "inclination_deg": 20, "lambda_squared": 38, "model": "irvine", "shape_points": 5}),
]


def query_string(request):
    def word(value):
        return ",".join(map(word, value)) if isinstance(value, list) else json.dumps(value).strip('"')
    return "?" + urllib.parse.urlencode({name: word(value) for name, value in request.items()})


@pytest.mark.parametrize("path, request_", VARIATIONS, ids=lambda value: "-".join(value) if isinstance(value, dict) else "")
def test_answers_keep_the_contract(strumd, path, request_):
    response = strumd.post(request_, path)
    answer = check("post", path, response)
    assert response.status_code == 200
    # the echo is a request too: the same one
    again = strumd.post(answer["request"], path)
    assert again.content == response.content
    by_method = strumd.request("QUERY", path, json=request_)
    check("x-query", path, by_method)
    assert by_method.content == response.content
    if "harmonics" not in request_ and "get" in CONTRACT["paths"][path]:
        by_query = strumd.get(path + query_string(request_))
        check("get", path, by_query)
        assert by_query.content == response.content
    stored = strumd.get(response.headers["Content-Location"])
    check("get", "/v1/results/{key}", stored)
    assert stored.content == response.content
    unchanged = strumd.get(response.headers["Content-Location"], headers={"If-None-Match": response.headers["ETag"]})
    assert unchanged.status_code == 304
    check("get", "/v1/results/{key}", unchanged)


REFUSALS = [
    (b"", 400), (b"[]", 400), (b"{", 400), (b'{"sag_parameter": 1e400}', 400), (b'{"sag_parameter": 2, "span": 1}', 400),
    (b'{"span_m": 100, "length_m": 90}', 422), (b"[" * 100, 413), (b"[" + b"0," * 30000 + b"0]", 413),
]


@pytest.mark.parametrize("body, status", REFUSALS, ids=lambda value: str(value)[:40])
def test_refusals_keep_the_contract(strumd, body, status):
    path = "/v1/catenary/frequencies"
    response = strumd.request("POST", path, data=body, headers=JSON)
    assert response.status_code == status
    problem = check("post", path, response)
    assert problem["status"] == status and problem["title"] and problem["detail"]


def test_a_list_may_be_one_parameter_or_several(strumd):
    expected = strumd.post({"sag_parameter": 0.9, "frequency_ratios": [0.5, 1, 2]}, FORCED)
    assert expected.status_code == 200
    for words in ("frequency_ratios=0.5,1,2", "frequency_ratios=0.5&frequency_ratios=1&frequency_ratios=2",
                  "frequency_ratios=0.5%2C1&frequency_ratios=2"):
        assert strumd.get(f"{FORCED}?sag_parameter=0.9&{words}").content == expected.content
    many = "&".join(f"frequency_ratios={n}" for n in range(65))
    refused = strumd.get(f"{FORCED}?sag_parameter=0.9&{many}")
    assert refused.status_code == 400 and "separated by commas" in refused.json()["detail"]
    twice = strumd.get(f"{FORCED}?sag_parameter=0.9&sag_parameter=0.8&frequency_ratios=1").json()
    assert twice["errors"] == [{"pointer": "/sag_parameter", "detail": "given more than once"}]


def test_other_refusals_keep_the_contract(strumd):
    path = "/v1/catenary/frequencies"
    check("post", path, strumd.request("POST", path, data=b"x", headers={"Content-Type": "text/plain"}))
    check("get", path, strumd.get(path))
    check("get", path, strumd.get(path + "?sag_parameter=+1"))
    check("get", "/v1/results/{key}", strumd.get("/v1/results/0"))
    assert strumd.get("/v1/results/" + "0" * 64).status_code == 404
    check("get", "/v1/results/{key}", strumd.get("/v1/results/" + "0" * 64))
    check("get", "/version", strumd.request("DELETE", "/version"))


@pytest.mark.parametrize("path", ["/livez", "/readyz", "/version", "/metrics", "/", "/docs", "/openapi.json", "/openapi-3.2.json"])
def test_pages_keep_the_contract(strumd, path):
    response = strumd.get(path)
    assert response.status_code == 200
    check("get", path, response)


def test_batches_keep_the_contract(strumd):
    said = operation("post", "/v1/batch")
    example = said["requestBody"]["content"]["application/json"]["examples"]["two"]["value"]
    items = example + [{"path": CATENARY, "request": {"modes": 0}}, {"path": "/v1"}, 1]
    for kind, body in (("application/json", json.dumps(items)), ("application/x-ndjson", "\n".join(map(json.dumps, items)))):
        response = strumd.request("POST", "/v1/batch", data=body, headers={"Content-Type": kind})
        assert response.status_code == 200
        lines = [json.loads(line) for line in response.text.splitlines()]
        for line in lines:
            assert not faults(said["responses"]["200"]["content"]["application/x-ndjson"]["schema"], line)
        assert [line.get("index") for line in lines] == [None, None, 2, 3, 4]
    examples = said["requestBody"]["content"]["application/json"]["examples"]
    for one in examples.values():
        assert not faults(said["requestBody"]["content"]["application/json"]["schema"], one["value"])
    chosen = examples["chosen"]["value"] + [{"path": CATENARY, "request": {"sag_parameter": 0.9}, "id": 3}] + [
        {"path": CATENARY, "request": {"sag_parameter": 0.9}, "id": "x", "fields": ["/result/nothing"]}]
    lines = [json.loads(line) for line in strumd.post(chosen, "/v1/batch").text.splitlines()]
    assert [line["id"] for line in lines] == ["long", "short", 3, "x"] and lines[0]["fields"] != lines[1]["fields"]
    for line in lines:
        assert not faults(said["responses"]["200"]["content"]["application/x-ndjson"]["schema"], line)
    check("post", "/v1/batch", strumd.request("POST", "/v1/batch", data=b"{}", headers=JSON))


@pytest.mark.parametrize("path", CASE_FILES, ids=lambda path: path.stem)
def test_answers_to_all_cases_keep_the_contract(strumd, path):
    """tests/cases knows what the values are; here only the form counts."""
    document = load(path)
    for case in document["cases"]:
        endpoint = case.get("endpoint", document["endpoint"])
        response = strumd.request("POST", endpoint, data=CASES.body_of(case), headers=JSON)
        check("post", endpoint, response)
        request = case.get("request")
        if response.status_code == 200 and isinstance(request, dict):
            name = operation("post", endpoint)["requestBody"]["content"]["application/json"]["schema"]
            assert not faults(name, request), case["id"]
