# SPDX-License-Identifier: GPL-3.0-or-later
"""POST /v1/batch: answers in order as they are ready, errors in place, bounded, fair, cancelled."""
import itertools
import json
import pathlib
import signal
import time

import pytest

from conftest import CHEAP, COSTLY, ENDLESS, FORCED, PATIENCE, PATH, PROGRAM
from test_events import read_until
from test_load import ONE_WORKER, answers_of, ask, costly, held, wait_metric

JSON, LINES = {"Content-Type": "application/json"}, {"Content-Type": "application/x-ndjson"}


# A sanitizer keeps what was freed.
SANITIZED = any(mark in pathlib.Path(PROGRAM).read_bytes() for mark in (b"__asan_init", b"__tsan_init"))


def resident(strumd):
    return int(pathlib.Path(f"/proc/{strumd.process.pid}/statm").read_text().split()[1]) * 4096


def cheap(number):
    return {**CHEAP, "sag_parameter": 0.1 + 0.00001 * number}


def item(request, path=PATH):
    return {"path": path, "request": request}


def post_batch(strumd, items, lines=False):
    body = "".join(json.dumps(i) + "\n" for i in items) if lines else json.dumps(items)
    return strumd.request("POST", "/v1/batch", data=body.encode(), headers=LINES if lines else JSON)


def answers(response):
    assert response.status_code == 200, response.text
    assert response.headers["Content-Type"] == "application/x-ndjson"
    lines = response.content.decode().split("\n")
    assert lines.pop() == ""
    return lines


def open_batch(strumd, items):
    """A connection over which a batch was sent."""
    body = json.dumps(items).encode()
    connection = strumd.connect()
    connection.sendall(b"POST /v1/batch HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n%s" % (len(body), body))
    return connection


def read_slowly(strumd, items, pieces):
    """Takes 4 KiB twenty times a second, so many times, of a batch; whether the daemon still sends after that."""
    with open_batch(strumd, items) as connection:
        for number in range(pieces):
            connection.recv(4096)
            time.sleep(0.05)
            if number % 10 == 0 and strumd.metric("requests_busy") == 1:  # who asks for the metrics
                return False
        return True


def test_who_reads_a_batch_too_slowly_is_cut(start_strumd):
    """Each piece is taken in time; by the rate of all together the client may be too slow."""
    items = [item({**CHEAP, "modes": 40, "shape_points": 100, "sag_parameter": 0.5 + 0.001 * n}) for n in range(100)]  # 50 MB
    flags = ("--request-timeout-s", "2", "--batch-body-bytes", "1M")
    assert read_slowly(start_strumd(*flags, "--stream-bytes-per-s", "0"), items, 160)
    assert not read_slowly(start_strumd(*flags, "--stream-bytes-per-s", "100M"), items, 1200)


@pytest.mark.parametrize("lines", [False, True], ids=["array", "lines"])
@pytest.mark.parametrize("flags", [(), ("--workers", "1"), ("--workers", "3", "--event-threads", "2")])
def test_answers_are_those_of_single_requests_in_order(start_strumd, lines, flags):
    strumd = start_strumd(*flags)
    requests_ = [CHEAP, COSTLY, costly(3), CHEAP, {"modes": 2, "sag_parameter": 0.3}, costly(4)] + [
        cheap(n) for n in range(200)]
    items = [item(r) for r in requests_] + [item({"sag_parameter": 0.9, "frequency_ratios": [1]}, FORCED)]
    got = answers(post_batch(strumd, items, lines))
    assert len(got) == len(items)
    for number in [0, 1, 2, 3, 4, 5, 6, 100, 205]:
        assert got[number] == strumd.post(requests_[number]).text
    assert got[-1] == strumd.post(items[-1]["request"], FORCED).text
    assert strumd.metric("solves_total") == len(items) - 1  # CHEAP is there twice
    # again: all are stored
    assert answers(post_batch(strumd, items, lines)) == got
    assert strumd.metric("solves_total") == len(items) - 1


FAULTS = [
    (item({**CHEAP, "modes": 0}), 400, ["/request/modes"]),
    (item({**CHEAP, "mode": 1, "sag_parameter": 7}), 400, ["/request/mode", "/request/sag_parameter"]),
    (item({"span_m": 100, "length_m": 90}), 422, None),
    (item(CHEAP, "/v1/catenary/frequenzies"), 400, ["/path"]),
    (item(CHEAP, "/v1/batch"), 400, ["/path"]),
    ({"path": PATH}, 400, ["/request"]),
    ({"request": CHEAP}, 400, ["/path"]),
    ({**item(CHEAP), "more": 1}, 400, ["/more"]),
    (item(7), 400, ["/request"]),
    (item([CHEAP]), 400, ["/request"]),
    (3, 400, [""]), ("text", 400, [""]), (None, 400, [""]), ([item(CHEAP)], 400, [""]), ({}, 400, ["/path", "/request"]),
]


@pytest.mark.parametrize("lines", [False, True], ids=["array", "lines"])
def test_errors_stand_in_place(strumd, lines):
    items = list(itertools.chain.from_iterable((item(cheap(n)), fault) for n, (fault, _, _) in enumerate(FAULTS)))
    got = answers(post_batch(strumd, items, lines))
    assert len(got) == 2 * len(FAULTS)
    for n, (fault, status, pointers) in enumerate(FAULTS):
        assert got[2 * n] == strumd.post(cheap(n)).text
        problem = json.loads(got[2 * n + 1])
        assert (problem["index"], problem["status"]) == (2 * n + 1, status), fault
        assert problem["title"] and problem["detail"]
        if pointers is not None:
            assert sorted(error["pointer"] for error in problem["errors"]) == pointers, fault


RESULT = "/result/in_plane/0/frequency_ratio"


def reached(document, pointer):
    """RFC 6901, by hand."""
    for token in pointer.split("/")[1:]:
        token = token.replace("~1", "/").replace("~0", "~")
        document = document[int(token)] if isinstance(document, list) else document[token]
    return document


@pytest.mark.parametrize("lines", [False, True], ids=["array", "lines"])
def test_an_item_may_have_an_id(strumd, lines):
    ids = ["a", "b \"quoted\" \u00fc", 0, -7, 2**53 - 1, "x" * 128]
    items = [{**item(cheap(n % 2)), "id": name} for n, name in enumerate(ids)]
    for _ in range(2):  # solved, then stored
        got = answers(post_batch(strumd, items, lines))
        for n, (name, line) in enumerate(zip(ids, got)):
            assert next(iter(json.loads(line))) == "id" and json.loads(line)["id"] == name
            plain = strumd.post(cheap(n % 2)).text
            assert line == '{"id":' + json.dumps(name, ensure_ascii=False) + "," + plain[1:]
    faulty, = answers(post_batch(strumd, [{**item({**CHEAP, "modes": 0}), "id": "it"}], lines))
    assert list(json.loads(faulty))[:2] == ["index", "id"] and json.loads(faulty)["id"] == "it"


@pytest.mark.parametrize("lines", [False, True], ids=["array", "lines"])
def test_fields_choose_what_comes_back(strumd, lines):
    plain = strumd.post(CHEAP)
    whole = plain.json()
    pointers = ["", "/result", RESULT, "/result/in_plane", "/result/in_plane/5", "/result/geometry/chi_1", "/warnings", "/meta/theory",
                "/request/plane", "/result/out_of_plane/2/symmetry", "/request/verify"]
    items = [{**item(CHEAP), "fields": [one]} for one in pointers] + [{**item(CHEAP), "id": "all", "fields": pointers[::-1]}, item(CHEAP)]
    for _ in range(2):
        got = answers(post_batch(strumd, items, lines))
        for one, line in zip(pointers, got):
            line = json.loads(line)
            assert line == {"fields": {one: reached(whole, one)}, "warnings": whole["warnings"], "key": whole["meta"]["key"]}
        last = json.loads(got[-2])
        assert list(last) == ["id", "fields", "warnings", "key"] and list(last["fields"]) == pointers[::-1]
        assert last["fields"] == {one: reached(whole, one) for one in pointers}
        assert got[-1] == plain.text
    # the bytes of the answer, to the last digit
    assert f'{{"fields":{{"{RESULT}":{json.dumps(reached(whole, RESULT))}}},' in got[2]


def test_warnings_come_unasked(strumd):
    request = {"tension_N": 1600, "modes": 30, "components": [
        {"type": "cable", "length_m": 5.5, "mass_kg_per_m": 2}, {"type": "damper", "damping_N_s_per_m": 360.127},
        {"type": "cable", "length_m": 104.5, "mass_kg_per_m": 2}]}
    whole = strumd.post(request, "/v1/taut/modes").json()
    assert whole["warnings"]
    line, = answers(post_batch(strumd, [{**item(request, "/v1/taut/modes"), "fields": ["/result/modes/0/frequency_Hz"]}], False))
    assert json.loads(line)["warnings"] == whole["warnings"]


FIELD_FAULTS = [
    ({"id": ""}, 400, ["/id"]), ({"id": "x" * 129}, 400, ["/id"]), ({"id": 1.5}, 400, ["/id"]), ({"id": 2**53}, 400, ["/id"]),
    ({"id": None}, 400, ["/id"]), ({"id": [1]}, 400, ["/id"]), ({"id": True}, 400, ["/id"]),
    ({"fields": []}, 400, ["/fields"]), ({"fields": {}}, 400, ["/fields"]), ({"fields": "/result"}, 400, ["/fields"]),
    ({"fields": [f"/{n}" for n in range(65)]}, 400, ["/fields"]), ({"fields": ["result"]}, 400, ["/fields/0"]),
    ({"fields": ["/a~2", "/result", "/a~"]}, 400, ["/fields/0", "/fields/2"]), ({"fields": ["/" + "x" * 256]}, 400, ["/fields/0"]),
    ({"fields": ["/result", "/result"]}, 400, ["/fields/1"]), ({"fields": [1, None, ["/result"]]}, 400, ["/fields/0", "/fields/1", "/fields/2"]),
    ({"id": False, "fields": ["x"], "request": {**CHEAP, "modes": 0}}, 400, ["/fields/0", "/id"]),
    ({"fields": [RESULT, "/result/in_planes", "/result/in_plane/6", "/result/in_plane/00", "/result/in_plane/-"]}, 422,
     ["/fields/1", "/fields/2", "/fields/3", "/fields/4"]),
    ({"fields": ["/meta/key/0", "/", "/result/", "/x/y/z"]}, 422, ["/fields/0", "/fields/1", "/fields/2", "/fields/3"]),
    ({"fields": ["/a/b" * 64]}, 422, ["/fields/0"]),
]


@pytest.mark.parametrize("more, status, pointers", FIELD_FAULTS, ids=lambda value: str(value)[:40])
def test_faults_of_ids_and_fields_are_named(strumd, more, status, pointers):
    before, line, after = answers(post_batch(strumd, [item(CHEAP), {**item(CHEAP), **more}, item(CHEAP)], False))
    problem = json.loads(line)
    assert (problem["index"], problem["status"]) == (1, status)
    assert sorted(error["pointer"] for error in problem["errors"]) == pointers
    assert before == after == strumd.post(CHEAP).text


def test_what_is_there_instead_is_said(strumd):
    fields = ["/result/in_planes", "/result/in_plane/9", "/meta/key/0", "/x"]
    line, = answers(post_batch(strumd, [{**item(CHEAP), "id": 3, "fields": fields}], False))
    told = [error["detail"] for error in json.loads(line)["errors"]]
    assert told == ["the answer has no /result/in_planes; /result has geometry, in_plane, out_of_plane",
                    "the answer has no /result/in_plane/9; /result/in_plane is a list of 6 items, from 0",
                    "the answer has no /meta/key/0; /meta/key has nothing below it",
                    "the answer has no /x; the answer has request, result, warnings, meta"]


def test_a_late_item_says_its_id(start_strumd):
    strumd = start_strumd(*ONE_WORKER, "--solve-timeout-s", "1")
    got = [json.loads(line) for line in answers(post_batch(strumd, [{**item(ENDLESS, FORCED), "id": "late", "fields": ["/result"]},
                                                                    {**item(CHEAP), "id": "next", "fields": [RESULT]}], False))]
    assert (got[0]["index"], got[0]["id"], got[0]["status"]) == (0, "late", 503)
    assert got[1]["id"] == "next" and list(got[1]["fields"]) == [RESULT]


@pytest.mark.parametrize("text, statuses", [
    (b'[{"path":1}{"path":2},3]', [400, 400]),          # a comma is missing
    (b'[nul, {"a":1e999}, "\xff", [[1]], {"a":1,"a":2}]', [400] * 5),
    (b'[1,]', [400, 400]), (b'[,]', [400, 400]),
    (b'["a]", "b,\\"]", {"]": "}"}, [","]]', [400] * 4),   # what stands in strings ends nothing
    (b"[" * 40 + b"]" * 40, [413]),
])
def test_what_is_no_json_is_refused_in_place(strumd, text, statuses):
    response = strumd.request("POST", "/v1/batch", data=text, headers=JSON)
    problems = [json.loads(line) for line in answers(response)]
    assert [problem["status"] for problem in problems] == statuses
    assert [problem["index"] for problem in problems] == list(range(len(statuses)))


@pytest.mark.parametrize("text", [b"", b" ", b"{}", b"[", b"]", b"[1", b"1]", b"[1]]", b"[1] [2]", b"[1}", b'["a]', b"[{]",
                                  b"[[1]"])
def test_what_is_no_array_is_refused(strumd, text):
    response = strumd.request("POST", "/v1/batch", data=text, headers=JSON)
    assert response.status_code == 400 and response.json()["detail"]


def test_no_items(strumd):
    for text, headers in ((b"[]", JSON), (b" [ \n] ", JSON), (b"", LINES), (b"\n \n\r\n", LINES)):
        assert answers(strumd.request("POST", "/v1/batch", data=text, headers=headers)) == []


def test_lines_of_all_kinds(strumd):
    one = json.dumps(item(CHEAP)).encode()
    body = one + b"\r\n\n  \n" + one + b"\n{\n" + one  # no line end after the last
    got = answers(strumd.request("POST", "/v1/batch", data=body, headers=LINES))
    assert got[0] == got[1] == got[3] and json.loads(got[2])["index"] == 2


def test_how_it_may_be_asked(start_strumd):
    strumd = start_strumd()
    assert strumd.get("/v1/batch").status_code == 405
    assert strumd.request("QUERY", "/v1/batch", json=[]).status_code == 405
    assert strumd.request("OPTIONS", "/v1/batch").headers["Allow"] == "POST, OPTIONS"
    wrong = strumd.request("POST", "/v1/batch", data=b"[]", headers={"Content-Type": "text/plain"})
    assert wrong.status_code == 415 and "x-ndjson" in wrong.json()["detail"]
    assert strumd.request("POST", PATH, data=b"{}", headers=LINES).status_code == 415


def test_limits(start_strumd):
    strumd = start_strumd("--batch-items", "10", "--batch-body-bytes", "2000", "--batches", "1", "--body-bytes", "256")
    assert len(answers(post_batch(strumd, [item(CHEAP)] * 10))) == 10
    assert post_batch(strumd, [1] * 11).status_code == 413
    assert post_batch(strumd, [1] * 11, lines=True).status_code == 413
    assert post_batch(strumd, ["a" * 2000]).status_code == 413
    with open_batch(strumd, [item(ENDLESS, FORCED)]):
        wait_metric(strumd, "workers_busy", 1)
        refused = post_batch(strumd, [])
        assert refused.status_code == 503 and refused.headers["Retry-After"]
    wait_metric(strumd, "workers_busy", 0)
    assert answers(post_batch(strumd, [])) == []


def test_thousands_of_items(start_strumd):
    """Bounded memory: what is not stored and not read is not computed."""
    strumd = start_strumd("--cache-bytes", "0")
    items = [item({**cheap(n), "shape_points": 50}) for n in range(4000)]
    connection = open_batch(strumd, items)
    connection.settimeout(PATIENCE)
    read_until(connection, b"\n{")
    # the client stops reading: only what the sockets and the window hold is computed
    last = -1
    while (solved := strumd.metric("solves_total")) != last:
        last = solved
        time.sleep(0.3)
    assert solved < 4000
    connection.close()
    wait_metric(strumd, "requests_busy", 1)
    before = resident(strumd)
    got = answers(post_batch(strumd, [item(cheap(n)) for n in range(8000)]))
    assert len(got) == 8000 and all('"result"' in line for line in got)
    if not SANITIZED:
        assert resident(strumd) - before < 32 << 20


def test_who_leaves_ends_it(start_strumd):
    strumd = start_strumd("--workers", "2")
    connection = open_batch(strumd, [item(CHEAP)] + [item({**ENDLESS, "points": 9000 + n}, FORCED) for n in range(20)])
    read_until(connection, b"\n")
    wait_metric(strumd, "lane_jobs", 19)  # they wait: one worker is for others
    wait_metric(strumd, "workers_busy", 1)
    connection.close()
    wait_metric(strumd, "workers_busy", 0)
    wait_metric(strumd, "requests_busy", 1)
    assert strumd.metric("solves_total") == 1 and strumd.metric("flights") == 0
    assert strumd.metric("cancels_total") == 20  # one of them at work, the others waited for their turn


def test_who_leaves_does_not_end_what_others_wait_for(start_strumd):
    strumd = start_strumd(*ONE_WORKER)
    shared = [costly(n) for n in range(20)]
    with held(strumd):
        connection = open_batch(strumd, [item(r) for r in shared])
        others = ask(strumd, shared)
        wait_metric(strumd, "flights", 21)
        wait_metric(strumd, "requests_busy", 23)  # one of them asks for the metrics
        connection.close()
        wait_metric(strumd, "requests_busy", 22)
    assert {status for status, _, _ in answers_of(others)} == {200}
    wait_metric(strumd, "flights", 0)
    assert strumd.metric("solves_total") == 20


@pytest.mark.parametrize("workers", ["1", "2"])
def test_others_are_served_beside_batches(start_strumd, workers):
    """Batches without end of costly items, a short queue: still no other client is refused."""
    strumd = start_strumd("--workers", workers, "--queue-depth", "2")
    batches = [open_batch(strumd, [item(costly(0.1 * b + 0.00001 * n)) for n in range(9000)]) for b in range(4)]
    while strumd.metric("solves_total") == 0:
        pass
    for n in range(10):
        assert strumd.post({**COSTLY, "sag_parameter": 0.4 + 0.001 * n}).status_code == 200
        assert strumd.metric("queue_refused_total") == 0
    solved = strumd.metric("solves_total")
    for connection in batches:
        connection.close()
    # had the others waited behind the batches, all of these would have been solved
    assert solved < 36010


def test_a_batch_is_cut_short_with_a_word(start_strumd):
    strumd = start_strumd(*ONE_WORKER, "--solve-timeout-s", "0.5")
    got = answers(post_batch(strumd, [item(CHEAP), item(ENDLESS, FORCED), item(CHEAP)]))
    assert len(got) == 3
    assert json.loads(got[1])["index"] == 1 and "solve_timeout_s" in got[1]
    wait_metric(strumd, "workers_busy", 0)


def test_a_batch_goes_on_without_an_item_that_takes_too_long(start_strumd):
    strumd = start_strumd(*ONE_WORKER, "--solve-timeout-s", "0.5")
    got = [json.loads(line) for line in answers(post_batch(
        strumd, [item(CHEAP), item(ENDLESS, FORCED)] + [item(cheap(n)) for n in range(1000)]))]
    assert len(got) == 1002
    assert (got[1]["index"], got[1]["status"]) == (1, 503) and "solve_timeout_s" in got[1]["detail"]
    for line in got[:1] + got[2:]:
        # a slow machine may need longer for one of them
        assert "result" in line or "solve_timeout_s" in line["detail"]
    assert sum("result" in line for line in got) > 900
    wait_metric(strumd, "workers_busy", 0)


@pytest.mark.parametrize("signals", [1, 2])
def test_the_way_out(start_strumd, signals):
    strumd = start_strumd(*ONE_WORKER)
    items = [item(CHEAP)] + [item(costly(n)) for n in range(20)]
    if signals == 2:  # more than the window holds wait behind it
        items += [item(ENDLESS, FORCED)] + [item(cheap(n)) for n in range(1000)]
    connection = open_batch(strumd, items)
    got = read_until(connection, b'"result"')
    for _ in range(signals):
        strumd.process.send_signal(signal.SIGTERM)
        strumd.wait_log("draining")
    got += read_until(connection, b"\r\n0\r\n\r\n")
    # a client that counts lines misses none
    assert got.count(b'"result":') + got.count(b'{"index":') == len(items)
    assert got.count(b'"result":') == 21 if signals == 1 else b"shutting down" in got
    assert strumd.process.wait(PATIENCE) == signals - 1
    connection.close()
