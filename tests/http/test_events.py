# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers as Server-Sent Events: progress, then the result or a problem."""
import json
import signal
import socket

import pytest

from conftest import CHEAP, COSTLY, ENDLESS, FORCED, IMPOSSIBLE, PATIENCE, PATH
from test_load import ONE_WORKER, held, wait_metric

BRIEF = {**ENDLESS, "points": 12}
EVENTS = {"Accept": "text/event-stream"}


def events(response):
    """[(event, data)] of a whole stream."""
    assert response.status_code == 200, response.text
    assert response.headers["Content-Type"] == "text/event-stream"
    assert response.headers["Cache-Control"] == "no-store"
    found = []
    blocks = response.text.split("\n\n")
    assert blocks.pop() == ""
    for block in blocks:
        event, data = block.split("\n")
        assert event.startswith("event: ") and data.startswith("data: ")
        found.append((event[7:], data[6:]))
    return found


def open_events(strumd, body, path=FORCED):
    """A connection that has asked for events."""
    text = json.dumps(body).encode()
    connection = strumd.connect()
    connection.sendall(b"POST %s HTTP/1.1\r\nHost: localhost\r\nAccept: text/event-stream\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n%s" % (
        path.encode(), len(text), text))
    return connection


def read_until(connection, mark):
    got = b""
    while mark not in got:
        piece = connection.recv(65536)
        assert piece, got
        got += piece
    return got


def test_progress_then_the_result(start_strumd):
    strumd = start_strumd()
    *told, (event, data) = events(strumd.post(BRIEF, FORCED, headers=EVENTS))
    assert event == "result" and told
    for event, progress in told:
        assert event == "progress"
        progress = json.loads(progress)
        assert 1 <= progress["evaluations"] <= 12 and progress["text"]
    assert strumd.metric("solves_total") == 1
    plain = strumd.post(BRIEF, FORCED)
    assert plain.headers["Cache-Status"] == "strum; hit" and plain.text == data
    # what is stored, by these bytes or by others, is a result at once
    assert events(strumd.post(BRIEF, FORCED, headers=EVENTS)) == [("result", data)]
    other_bytes = json.dumps(BRIEF, indent=3)
    assert events(strumd.request("POST", FORCED, data=other_bytes, headers={**EVENTS, "Content-Type": "application/json"})) == [("result", data)]
    assert strumd.metric("solves_total") == 1


@pytest.mark.parametrize("body", [CHEAP, COSTLY], ids=["at once", "by a worker"])
def test_without_progress_there_is_the_result(start_strumd, body):
    strumd = start_strumd()
    (event, data), = events(strumd.post(body, headers={"Accept": "application/json;q=0.5, text/event-stream"}))
    assert event == "result" and data == strumd.post(body).text


def test_query_streams_too(start_strumd):
    strumd = start_strumd()
    *told, (event, data) = events(strumd.request("QUERY", FORCED, json=BRIEF, headers=EVENTS))
    assert told and event == "result" and data == strumd.post(BRIEF, FORCED).text
    assert events(strumd.request("QUERY", FORCED, json=BRIEF, headers=EVENTS)) == [("result", data)]
    # its ETag is that of the answer, which a stream is not: it is sent whole
    known = {"If-None-Match": strumd.post(BRIEF, FORCED).headers["ETag"]}
    assert events(strumd.request("QUERY", FORCED, json=BRIEF, headers=EVENTS | known)) == [("result", data)]
    assert strumd.request("QUERY", FORCED, json=BRIEF, headers=known).status_code == 304


def test_get_does_not_stream(strumd):
    answer = strumd.request("GET", headers=EVENTS, params=CHEAP)
    assert answer.headers["Content-Type"] == "application/json" and answer.status_code == 200


def test_refusals_before_the_stream_keep_their_status(start_strumd):
    strumd = start_strumd()
    for body, status in (({"sag_parameter": 2}, 400), ({"span_m": 100, "length_m": 90}, 422)):
        answer = strumd.post(body, headers=EVENTS)
        assert answer.status_code == status and answer.headers["Content-Type"] == "application/problem+json"


def test_a_full_queue_refuses_with_its_status(start_strumd):
    strumd = start_strumd("--workers", "1", "--queue-depth", "1")
    with held(strumd):
        asked = [open_events(strumd, COSTLY | {"sag_parameter": 0.5 + 0.1 * n}, PATH) for n in range(2)]
        wait_metric(strumd, "queue_refused_total", 1)
    heads = sorted(read_until(connection, b"\r\n\r\n").split(b"\r\n")[0] for connection in asked)
    assert heads == [b"HTTP/1.1 200 OK", b"HTTP/1.1 503 Service Unavailable"]
    for connection in asked:
        connection.close()


def test_a_refusal_by_a_worker_is_a_problem(start_strumd):
    strumd = start_strumd(*ONE_WORKER)
    with held(strumd, 1):
        connection = open_events(strumd, IMPOSSIBLE)
        got = read_until(connection, b"\r\n\r\n")
    with connection:
        got += read_until(connection, b"0\r\n\r\n")
    assert got.startswith(b"HTTP/1.1 200 ") and b"event: problem\ndata: {" in got and b'"status":422' in got


def test_who_leaves_ends_the_work(start_strumd):
    strumd = start_strumd(*ONE_WORKER)
    connection = open_events(strumd, ENDLESS)
    read_until(connection, b"event: progress")
    assert strumd.metric("workers_busy") == 1
    connection.close()
    wait_metric(strumd, "cancels_total", 1)
    wait_metric(strumd, "workers_busy", 0)
    assert strumd.metric("solves_total") == 0 and strumd.metric("flights") == 0


def test_who_leaves_does_not_end_it_for_others(start_strumd):
    strumd = start_strumd(*ONE_WORKER)
    body = {**ENDLESS, "points": 50}
    leaving, staying = open_events(strumd, body), open_events(strumd, body)
    read_until(leaving, b"event: progress")
    read_until(staying, b"event: progress")
    leaving.close()
    assert b"event: result\ndata: {" in read_until(staying, b"0\r\n\r\n")
    staying.close()
    assert strumd.metric("cancels_total") == 0 and strumd.metric("solves_total") == 1


def test_who_waits_too_long_gets_a_problem(start_strumd):
    strumd = start_strumd(*ONE_WORKER, "--solve-timeout-s", "0.3")
    *told, (event, data) = events(strumd.post(ENDLESS, FORCED, headers=EVENTS))
    # a slow machine may have told nothing by then
    assert {name for name, _ in told} <= {"progress"} and event == "problem"
    assert json.loads(data)["status"] == 503 and "solve_timeout_s" in data
    wait_metric(strumd, "workers_busy", 0)
    assert strumd.metric("cancels_total") == 1


@pytest.mark.parametrize("signals", [1, 2])
def test_the_way_out(start_strumd, signals):
    """One signal: it is finished. Two: what is under way is a problem, and nothing aborts."""
    strumd = start_strumd(*ONE_WORKER)
    connection = open_events(strumd, {**ENDLESS, "points": 10000 if signals == 2 else 12})
    got = read_until(connection, b"event: progress")
    for _ in range(signals):
        strumd.process.send_signal(signal.SIGTERM)
        strumd.wait_log("draining")
    if b"0\r\n\r\n" not in got[-5:]:
        got += read_until(connection, b"0\r\n\r\n")
    connection.close()
    assert (b"event: result" if signals == 1 else b"shutting down") in got
    assert strumd.process.wait(PATIENCE) == signals - 1


def test_clients_that_read_nothing_are_cut(start_strumd):
    """The answer is larger than what sockets hold; who does not take it is cut after request_timeout_s."""
    strumd = start_strumd("--request-timeout-s", "1")
    large = {"sag_parameter": 0.9, "frequency_ratios": [1], "profile_points": 2000,
             "profiles_at": [0.01 * n for n in range(50)]}
    size = len(strumd.post(large, FORCED).content)
    assert size > 8e6
    connection = open_events(strumd, large)
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
    wait_metric(strumd, "requests_busy", 2)
    wait_metric(strumd, "requests_busy", 1)  # the one that asks
    connection.close()
