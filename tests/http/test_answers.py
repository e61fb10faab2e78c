# SPDX-License-Identifier: GPL-3.0-or-later
"""One parameter set, one answer: methods, keys, conditions and headers."""
import json
import re

import pytest

from conftest import CHEAP, COSTLY, PATH, ROOT, split_answers

QUERY_STRING = "?rise_to_span=0&sag_parameter=0.9&modes=6"
JSON = {"Content-Type": "application/json"}


def key_of(answer):
    assert answer.status_code in (200, 304), answer.text
    return re.fullmatch(r'"([0-9a-f]{64})"', answer.headers["ETag"]).group(1)


def problem(answer, status):
    assert answer.status_code == status, answer.text
    assert answer.headers["Content-Type"] == "application/problem+json"
    document = answer.json()
    assert document["status"] == status
    assert document["detail"]
    return document


def test_post_query_and_get_are_one_answer(strumd):
    answers = [strumd.post(CHEAP), strumd.request("QUERY", json=CHEAP), strumd.get(PATH + QUERY_STRING),
               # written otherwise: order, spelling of numbers, a default named or not
               strumd.request("POST", data=b'{ "modes": 6.0, "sag_parameter": 9e-1 }', headers=JSON),
               strumd.get(PATH + "?modes=6&sag_parameter=.9e0")]
    assert [answer.status_code for answer in answers] == [200] * 4 + [answers[4].status_code]
    assert len({answer.content for answer in answers[:4]}) == 1
    assert len({key_of(answer) for answer in answers[:4]}) == 1
    assert answers[0].json()["meta"]["key"] == key_of(answers[0])
    # ".9e0" is no JSON number; whether a query string may say so is the schema's: it is either the same or refused
    assert answers[4].status_code == 400 or answers[4].content == answers[0].content


def test_another_question_has_another_key(strumd):
    assert key_of(strumd.post(CHEAP)) != key_of(strumd.post({**CHEAP, "modes": 5}))


def test_head_is_get_without_its_body(strumd):
    get, head = strumd.get(PATH + QUERY_STRING), strumd.request("HEAD", PATH + QUERY_STRING)
    assert head.status_code == 200 and head.content == b""
    for name in ("ETag", "Content-Length", "Content-Type", "Content-Location", "Cache-Control"):
        assert head.headers[name] == get.headers[name]


def test_the_first_is_a_miss_and_the_next_a_hit(start_strumd):
    strumd = start_strumd()
    first, second = strumd.post(CHEAP), strumd.post(CHEAP)
    assert first.headers["Cache-Status"] == "strum; fwd=miss; stored"
    assert second.headers["Cache-Status"] == "strum; hit"
    assert strumd.get(PATH + QUERY_STRING).headers["Cache-Status"] == "strum; hit"
    assert first.content == second.content
    assert re.fullmatch(r"read;dur=\d+\.\d{3}, queue;dur=\d+\.\d{3}, solve;dur=\d+\.\d{3}, cpu;dur=\d+\.\d{3}, "
                        r"estimate;dur=\d+\.\d{3}",
                        first.headers["Server-Timing"])
    assert strumd.metric("solves_total") == 1
    assert strumd.metric("cache_misses_total") == 1
    assert strumd.metric("cache_hits_total") == 2


@pytest.mark.parametrize("body", [CHEAP, COSTLY], ids=["cheap", "costly"])
def test_headers_of_an_answer(start_strumd, body):
    strumd = start_strumd()
    for _ in range(2):
        posted = strumd.post(body)
        assert posted.headers["Content-Type"] == "application/json"
        assert posted.headers["Content-Location"] == "/v1/results/" + key_of(posted)
        assert posted.headers["Cache-Control"] == "no-cache"
    # a question's own address may have another answer after an upgrade; a key never has
    question, kept = strumd.request("QUERY", json=body), strumd.get(posted.headers["Content-Location"])
    assert question.headers["Cache-Control"] == "no-cache"
    assert kept.headers["Cache-Control"] == "public, max-age=31536000, immutable"
    assert "Vary" not in question.headers and "Vary" not in kept.headers


def test_a_question_is_revalidated_in_one_round_trip(start_strumd):
    strumd = start_strumd()
    for _ in range(2):  # solved, then stored
        got = strumd.get(PATH + QUERY_STRING)
        assert got.headers["Cache-Control"] == "no-cache"
        again = strumd.get(PATH + QUERY_STRING, headers={"If-None-Match": got.headers["ETag"]})
        assert (again.status_code, again.headers["Cache-Control"]) == (304, "no-cache")
    kept = strumd.get(got.headers["Content-Location"], headers={"If-None-Match": got.headers["ETag"]})
    assert (kept.status_code, kept.headers["Cache-Control"]) == (304, "public, max-age=31536000, immutable")


def test_an_answer_is_there_again_under_its_key(strumd):
    posted = strumd.post(CHEAP)
    again = strumd.get(posted.headers["Content-Location"])
    assert again.content == posted.content and key_of(again) == key_of(posted)
    assert again.headers["Cache-Status"] == "strum; hit"
    assert again.headers["Content-Location"] == posted.headers["Content-Location"]


def test_keys_that_are_none_or_unknown(strumd):
    problem(strumd.get("/v1/results/" + "0" * 64), 404)
    for bad in ("", "0" * 63, "0" * 65, "G" * 64, key_of(strumd.post(CHEAP)).upper() + "A", "a" * 63 + "/", "%30" * 65):
        problem(strumd.get("/v1/results/" + bad), 400)
    assert strumd.request("POST", "/v1/results/" + "0" * 64, json={}).status_code == 405


@pytest.mark.parametrize("tags, status", [
    ('"{key}"', 304), ('W/"{key}"', 304), ("*", 304), ('"a", W/"b", "{key}"', 304), ('"a","{key}" , "b"', 304),
    ('"a"', 200), ("{key}", 200), ('"{key}x"', 200), ('"x{key}"', 200), ("", 200), ('""', 200), ('"{key}', 200)])
@pytest.mark.parametrize("method", ["POST", "QUERY", "GET", "HEAD", "result"])
def test_if_none_match(strumd, method, tags, status):
    key = key_of(strumd.post(CHEAP))
    headers = {"If-None-Match": tags.format(key=key)}
    if method == "result":
        answer = strumd.get("/v1/results/" + key, headers=headers)
    elif method in ("POST", "QUERY"):
        answer = strumd.request(method, json=CHEAP, headers=headers)
    else:
        answer = strumd.request(method, PATH + QUERY_STRING, headers=headers)
    assert answer.status_code == status
    assert key_of(answer) == key
    if status == 304:
        assert answer.content == b"" and "Content-Type" not in answer.headers
        assert answer.headers["Cache-Control"] and answer.headers["Content-Location"]


def test_refusals_are_problems_and_not_kept(start_strumd):
    strumd = start_strumd()
    for _ in range(2):
        problem(strumd.post({**CHEAP, "modes": -1}), 400)
        problem(strumd.request("POST", data=b"{", headers=JSON), 400)
        problem(strumd.request("POST", data=b"", headers=JSON), 400)
        problem(strumd.get(PATH + "?sag_parameter=2"), 400)
    pointers = [error["pointer"] for error in
                strumd.post({"rise_to_span": "x", "sag_parameter": 7, "modse": 1}).json()["errors"]]
    assert sorted(pointers) == ["/modse", "/rise_to_span", "/sag_parameter"]
    assert strumd.metric("cache_entries") == 0
    assert strumd.metric("solves_total") == 0


def test_unknown_paths_name_the_known(strumd):
    document = problem(strumd.get("/v1/catenary/frequncies"), 404)
    assert f"did you mean {PATH}" in document["detail"]
    for path in (PATH, "/v1/results/{key}", "/livez", "/readyz", "/version", "/metrics"):
        assert path in document["detail"]
    for path in ("/v1", "/livez/", PATH + "/", "/v1//catenary/frequencies", "/LIVEZ"):
        problem(strumd.get(path), 404)
    problem(strumd.post(CHEAP, "/v1/nothing"), 404)


def test_methods(strumd):
    for method in ("PUT", "PATCH", "DELETE"):
        answer = strumd.request(method, json=CHEAP)
        problem(answer, 405)
        assert answer.headers["Allow"] == "GET, HEAD, POST, QUERY, OPTIONS"
    answer = strumd.request("POST", "/livez")
    problem(answer, 405)
    assert answer.headers["Allow"] == "GET, HEAD, OPTIONS"
    for method in ("post", "BREW"):
        assert strumd.raw(f"{method} {PATH} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode(), wait=1).startswith(b"HTTP/1.1 501 ")


def test_options(strumd):
    answer = strumd.request("OPTIONS")
    assert answer.status_code == 204 and answer.content == b""
    assert answer.headers["Allow"] == "GET, HEAD, POST, QUERY, OPTIONS"
    assert answer.headers["Accept-Query"] == "application/json"
    assert strumd.request("OPTIONS", "/livez").headers["Allow"] == "GET, HEAD, OPTIONS"
    problem(strumd.request("OPTIONS", "/nothing"), 404)


@pytest.mark.parametrize("kind, status", [
    ("application/json", 200), ("application/json; charset=utf-8", 200), ("Application/JSON ;x=y", 200),
    ("application/x-www-form-urlencoded", 415), ("text/plain", 415), ("application/jsonl", 415),
    ("application/json-patch+json", 415), ("application/json x", 415), ("", 415)])
@pytest.mark.parametrize("method", ["POST", "QUERY"])
def test_content_types(strumd, method, kind, status):
    answer = strumd.request(method, data=b'{"sag_parameter": 0.9}', headers={"Content-Type": kind})
    assert answer.status_code == status
    if status != 200:
        problem(answer, status)


def test_a_content_type_is_needed(strumd):
    """Without one a page of any site could have a browser send the body unasked."""
    for method in ("POST", "QUERY"):
        answer = strumd.request(method, data=b'{"sag_parameter":0.9}')
        problem(answer, 415)
        assert "--json" in answer.json()["detail"] and "Content-Type: application/json" in answer.json()["detail"]
    problem(strumd.request("POST", "/v1/batch", data=b"[]"), 415)
    form = strumd.request("POST", data=b'{"sag_parameter":0.9}', headers={"Content-Type": "application/x-www-form-urlencoded"})
    assert "curl" in form.json()["detail"]  # this is what curl -d says


def test_fields_stand_in_one_place(strumd):
    for method in ("POST", "QUERY"):
        problem(strumd.request(method, PATH + "?modes=3", json=CHEAP), 400)
    problem(strumd.request("GET", PATH + QUERY_STRING, data=b"{}", headers=JSON), 400)


def test_request_ids(strumd):
    for answer in (strumd.post(CHEAP, headers={"X-Request-Id": "abc-1.2:3"}),
                   strumd.get("/nothing", headers={"X-Request-Id": "abc-1.2:3"})):
        assert answer.headers["X-Request-Id"] == "abc-1.2:3"
    for bad in ("x" * 200, "a b", 'a"b'):
        assert strumd.get("/livez", headers={"X-Request-Id": bad}).headers["X-Request-Id"] != bad
    made = {strumd.get("/livez").headers["X-Request-Id"] for _ in range(5)}
    assert len(made) == 5


def test_other_origins_are_told_nothing_by_default(strumd):
    answer = strumd.post(CHEAP, headers={"Origin": "https://a.example"})
    assert answer.status_code == 403
    assert not [name for name in answer.headers if name.lower().startswith("access-control")]
    assert "Vary" not in answer.headers


def test_other_origins_that_are_listed(start_strumd):
    strumd = start_strumd("--cors-origins", "https://a.example, https://b.example")
    for _ in range(2):
        answer = strumd.post(CHEAP, headers={"Origin": "https://b.example"})
        assert answer.headers["Access-Control-Allow-Origin"] == "https://b.example"
        assert "ETag" in answer.headers["Access-Control-Expose-Headers"]
        assert answer.headers["Vary"] == "Origin"
    assert strumd.post(CHEAP).headers["Vary"] == "Origin"
    for stranger in ("https://c.example", "https://a.exampl", "https://a.example.c", "null", ""):
        answer = strumd.post(CHEAP, headers={"Origin": stranger})
        assert answer.status_code == 403
        assert "Access-Control-Allow-Origin" not in answer.headers
    asked = {"Origin": "https://a.example", "Access-Control-Request-Method": "POST"}
    before = strumd.request("OPTIONS", headers=asked)
    assert before.status_code == 204
    assert before.headers["Access-Control-Allow-Origin"] == "https://a.example"
    assert "QUERY" in before.headers["Access-Control-Allow-Methods"]
    assert "Content-Type" in before.headers["Access-Control-Allow-Headers"]
    # what is refused must be readable too
    assert strumd.post({}, "/nothing", headers=asked).headers["Access-Control-Allow-Origin"] == "https://a.example"


def test_any_origin(start_strumd):
    strumd = start_strumd("--cors-origins", "*")
    answer = strumd.post(CHEAP, headers={"Origin": "https://a.example"})
    assert answer.headers["Access-Control-Allow-Origin"] == "https://a.example"


def test_a_connection_is_kept_over_hits_misses_and_refusals(strumd):
    body = b'{"sag_parameter":0.77}'
    post = b"POST %s HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n%s" % (PATH.encode(), len(body), body)
    get = b"GET %s HTTP/1.1\r\nHost: localhost\r\n\r\n"
    answers = split_answers(strumd.raw(post + get % b"/nothing" + post + get % b"/livez", wait=4))
    assert [status for status, _, _ in answers] == [200, 404, 200, 200]
    assert answers[0][2] == answers[2][2]


def test_pages(strumd):
    assert strumd.get("/livez").json() == {"status": "alive"}
    assert strumd.get("/readyz").json()["status"] == "ready"
    version = strumd.get("/version").json()
    assert version["name"] == "strumd" and re.fullmatch(r"[0-9a-f]{12}|unknown", version["commit"])
    assert re.fullmatch(r"\d+\.\d+\.\d+", version["version"])
    assert re.fullmatch(r"\d+\.\d+\.\d+", version["solver"])
    example = json.loads((ROOT / "api/examples/taut_matrix.json").read_text(encoding="utf-8"))
    assert version["solver_number"] == example["answer"]["meta"]["solver_number"]
    assert re.fullmatch("[0-9a-f]{16}", version["numerics"])
    assert version["numerics"] == strumd.post(example["request"], example["endpoint"]).json()["meta"]["numerics"]
    metrics = strumd.get("/metrics")
    assert metrics.headers["Content-Type"].startswith("text/plain; version=0.0.4")
    names = [line.split()[2] for line in metrics.text.splitlines() if line.startswith("# TYPE ")]
    assert len(names) == len(set(names))
    for line in metrics.text.splitlines():
        assert line.startswith("# ") or re.fullmatch(r'strum_\w+(\{(\w+="[^"]*",?)+\})? \d+(\.\d{6})?', line), line


@pytest.mark.parametrize("path, body", [
    # the heaviest and the lightest cable there is: their weight follows from what was sent
    (PATH, {"span_m": 644, "length_m": 644.0448778912543, "gravity_m_per_s2": 571.85, "mass_kg_per_m": 1e6}),
    (PATH, {"span_m": 100, "length_m": 110, "gravity_m_per_s2": 1e4, "mass_kg_per_m": 1e6}),
    (PATH, {"span_m": 100, "length_m": 110, "gravity_m_per_s2": 1e-9, "mass_kg_per_m": 1e-9}),
    ("/v1/forced/tension", {"span_m": 100, "length_m": 110, "gravity_m_per_s2": 1e4, "mass_kg_per_m": 1e6,
                            "frequency_ratios": [1]}),
    ("/v1/inclined/modes", {"length_m": 1e7, "mass_kg_per_m": 1e6, "tension_N": 1e12, "inclination_deg": 0,
                            "inextensible": True}),
])
def test_an_echoed_request_is_the_same_question(strumd, path, body):
    answer = strumd.post(body, path=path)
    again = strumd.post(answer.json()["request"], path=path)
    assert again.status_code == 200, again.text
    assert key_of(again) == key_of(answer)


def test_a_304_has_the_length_of_the_200_or_none(strumd):
    """RFC 9110 8.6: no other, and no body; the connection goes on."""
    first = strumd.post(CHEAP)
    for path in (first.headers["Content-Location"], f"{PATH}?sag_parameter=0.9&modes=6"):
        whole = strumd.get(path)
        ask = f"GET {path} HTTP/1.1\r\nHost: localhost\r\nIf-None-Match: {whole.headers['ETag']}\r\n\r\n".encode()
        answers = split_answers(strumd.raw(ask, ask, b"GET /livez HTTP/1.1\r\nHost: localhost\r\n\r\n", wait=3))
        assert [status for status, _, _ in answers] == [304, 304, 200]
        for _, headers, _ in answers[:2]:
            assert headers.get("content-length", whole.headers["Content-Length"]) == whole.headers["Content-Length"]
        assert answers[2][2] == b'{"status":"alive"}'
