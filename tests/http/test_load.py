# SPDX-License-Identifier: GPL-3.0-or-later
"""Many at once: one flight for equal questions, a bounded queue, those who leave, and the way out.

The daemon has one worker here, and `held` keeps it busy for as long as a test wants: nothing depends on how long
an answer takes.
"""
import contextlib
import signal
import time
from concurrent.futures import ThreadPoolExecutor

import pytest
import requests

from conftest import CHEAP, COSTLY, ENDLESS, FORCED, IMPOSSIBLE, PATIENCE, PATH, read_answers, split_answers

ONE_WORKER = ("--workers", "1", "--queue-depth", "1000", "--cheap-us", "0")


def costly(number):
    """Questions that differ, each for a worker."""
    return {**COSTLY, "sag_parameter": 0.9 - 0.001 * number}


def as_bytes(body, path=PATH):
    prepared = requests.Request("POST", "http://a" + path, json=body).prepare()
    return b"POST %s HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n%s" % (
        path.encode(), len(prepared.body), prepared.body)


def ask(strumd, bodies, path=PATH):
    """Sends each over a connection of its own, all before any answer is read."""
    connections = [strumd.connect() for _ in bodies]
    for connection, body in zip(connections, bodies):
        connection.sendall(as_bytes(body, path))
    return connections


@contextlib.contextmanager
def held(strumd, waiting=0):
    """The one worker has work without end inside, and is let go after: its client leaves. Where questions were asked
    inside, `waiting` flights must have begun before that."""
    wait_metric(strumd, "workers_busy", 0)
    holder, = ask(strumd, [ENDLESS], FORCED)
    with holder:
        wait_metric(strumd, "workers_busy", 1)
        yield holder
        if waiting:
            wait_metric(strumd, "flights", waiting + 1)


def answers_of(connections):
    """The one answer on each: (status, headers, body)."""
    answers = []
    for connection in connections:
        with connection:
            got = split_answers(read_answers(connection, 1))
            assert len(got) == 1, got
            answers.append(got[0])
    return answers


def wait_metric(strumd, name, value):
    end = time.monotonic() + PATIENCE
    while strumd.metric(name) != value:
        assert time.monotonic() < end, strumd.get("/metrics").text


@pytest.mark.parametrize("threads", ["1", "3"])
def test_equal_questions_at_once_are_solved_once(start_strumd, threads):
    strumd = start_strumd(*ONE_WORKER, "--event-threads", threads)
    with held(strumd):
        equal = ask(strumd, [COSTLY] * 100)
        wait_metric(strumd, "cache_joins_total", 99)
    answers = answers_of(equal)
    assert {status for status, _, _ in answers} == {200}
    assert len({body for _, _, body in answers}) == 1
    assert strumd.metric("solves_total") == 1
    assert strumd.metric("cache_misses_total") == 2  # the other is who held the worker
    assert strumd.metric("cache_hits_total") == 0
    told = [headers["cache-status"] for _, headers, _ in answers]
    assert sorted(told) == ["strum; fwd=miss; collapsed"] * 99 + ["strum; fwd=miss; stored"]


def test_a_refusal_reaches_all_who_wait(start_strumd):
    """A worker finds that there is no such answer: every one who waits is told."""
    strumd = start_strumd(*ONE_WORKER)
    with held(strumd, 1):
        connections = ask(strumd, [IMPOSSIBLE] * 20, FORCED)
    answers = answers_of(connections)
    assert len({(status, body) for status, _, body in answers}) == 1
    assert answers[0][0] == 422
    assert {headers["content-type"] for _, headers, _ in answers} == {"application/problem+json"}
    assert strumd.metric("cache_entries") == 0


def test_a_full_queue_refuses_and_stored_answers_still_come(start_strumd):
    strumd = start_strumd("--workers", "1", "--queue-depth", "2", "--retry-after-s", "7", "--cheap-us", "0")
    assert strumd.post(CHEAP).status_code == 200
    with held(strumd, 2):
        connections = ask(strumd, [costly(number) for number in range(40)])
        wait_metric(strumd, "queue_refused_total", 38)
        hit = strumd.post(CHEAP)
        assert hit.status_code == 200 and hit.headers["Cache-Status"] == "strum; hit"
    answers = answers_of(connections)
    statuses = [status for status, _, _ in answers]
    assert statuses.count(200) == 2 and statuses.count(503) == 38
    for status, headers, body in answers:
        if status == 503:
            assert headers["retry-after"] == "7"
            assert headers["content-type"] == "application/problem+json"
            assert b'"status":503' in body
    # what was refused was not kept: it can be asked again
    assert strumd.post(costly(39)).status_code == 200


def test_who_leaves_is_not_solved_for(start_strumd):
    strumd = start_strumd(*ONE_WORKER)
    with held(strumd):
        before = ask(strumd, [costly(number) for number in range(1, 31)])
        wait_metric(strumd, "flights", 31)
        leaving, staying = ask(strumd, [costly(70), costly(80)])
        also_leaving, = ask(strumd, [costly(80)])
        wait_metric(strumd, "cache_joins_total", 1)
        wait_metric(strumd, "flights", 33)
        leaving.close()
        also_leaving.close()
        wait_metric(strumd, "cancels_total", 1)
    assert answers_of([staying])[0][0] == 200
    assert {status for status, _, _ in answers_of(before)} == {200}
    wait_metric(strumd, "flights", 0)
    assert strumd.metric("solves_total") == 31
    assert strumd.metric("cancels_total") == 2  # and who held the worker


def test_who_waits_too_long_is_told(start_strumd):
    strumd = start_strumd(*ONE_WORKER, "--solve-timeout-s", "0.2")
    connections = ask(strumd, [ENDLESS], FORCED) + ask(strumd, [costly(number) for number in range(50)])
    (status, headers, body), *others = answers_of(connections)
    assert (status, headers["content-type"]) == (503, "application/problem+json") and b"solve_timeout_s" in body
    # those who waited behind it were told as well, or had their turn just in time
    assert {status for status, _, _ in others} <= {200, 503}
    assert all(b"solve_timeout_s" in body for status, _, body in others if status == 503)
    wait_metric(strumd, "flights", 0)
    assert strumd.post(CHEAP).status_code == 200


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
@pytest.mark.parametrize("threads", ["1", "2"])
def test_draining_loses_nothing(start_strumd, number, threads):
    strumd = start_strumd(*ONE_WORKER, "--event-threads", threads)
    with held(strumd):
        connections = ask(strumd, [costly(number) for number in range(20)] + [costly(3)] * 5)
        wait_metric(strumd, "cache_joins_total", 5)
        wait_metric(strumd, "flights", 21)
        strumd.process.send_signal(number)
        strumd.wait_log("draining")
    answers = answers_of(connections)
    assert [status for status, _, _ in answers] == [200] * 25
    assert strumd.process.wait(PATIENCE) == 0
    assert strumd.wait_log("stopped")["level"] == "info"
    # who is answered after the signal is told that the connection ends
    assert {headers.get("connection") for _, headers, _ in answers} == {"close"}


def test_while_draining(start_strumd):
    strumd = start_strumd(*ONE_WORKER)
    kept = strumd.connect()
    kept.sendall(b"GET /readyz HTTP/1.1\r\nHost: localhost\r\n\r\n")
    assert split_answers(read_answers(kept, 1))[0][0] == 200
    with held(strumd):
        connections = ask(strumd, [costly(number) for number in range(40)])
        wait_metric(strumd, "flights", 41)
        strumd.process.send_signal(signal.SIGTERM)
        strumd.wait_log("draining")
        kept.sendall(b"GET /readyz HTTP/1.1\r\nHost: localhost\r\n\r\n")
        (status, headers, body), = split_answers(read_answers(kept))
        assert status == 503 and headers["connection"] == "close" and b"shutting down" in body
        kept.close()
        with pytest.raises(ConnectionRefusedError):
            strumd.connect()
    assert [(answer, strumd.log) for answer in answers_of(connections) if answer[0] != 200] == []
    assert strumd.process.wait(PATIENCE) == 0


@pytest.mark.parametrize("how", ["the deadline", "a second signal"])
def test_draining_ends(start_strumd, how):
    """What is not finished in time is answered 503; nothing aborts."""
    strumd = start_strumd(*ONE_WORKER, "--drain-timeout-s", "0.1" if how == "the deadline" else "3000")
    connections = ask(strumd, [ENDLESS], FORCED)
    wait_metric(strumd, "workers_busy", 1)
    connections += ask(strumd, [costly(number) for number in range(50)])
    wait_metric(strumd, "flights", 51)
    strumd.process.send_signal(signal.SIGTERM)
    strumd.wait_log("draining")
    if how == "a second signal":
        strumd.process.send_signal(signal.SIGTERM)
    answers = answers_of(connections)
    assert [status for status, _, _ in answers] == [503] * 51
    assert all(b"shutting down" in body for _, _, body in answers)
    assert strumd.process.wait(PATIENCE) == 1
    assert strumd.wait_log("stopped")["level"] == "warning"


@pytest.mark.parametrize("threads", ["1", "3"])
def test_a_drain_under_load_breaks_no_answer(start_strumd, threads):
    """Clients that keep their connections busy are told to close; none finds its connection cut."""
    strumd = start_strumd("--event-threads", threads)
    strumd.post(CHEAP)

    def client(_):
        count = 0
        with strumd.connect() as connection:
            while True:
                connection.sendall(as_bytes(CHEAP))
                answer, = split_answers(read_answers(connection, 1))
                assert answer[0] == 200
                count += 1
                if answer[1].get("connection") == "close":
                    assert connection.recv(1) == b""
                    return count
    with ThreadPoolExecutor(16) as pool:
        counts = pool.map(client, range(16))
        wait_metric(strumd, "cache_entries", 1)
        while strumd.metric("requests_total") < 500:
            pass
        strumd.process.send_signal(signal.SIGTERM)
        assert sum(counts) > 400
    assert strumd.process.wait(PATIENCE) == 0


def test_an_idle_daemon_stops_though_clients_stay(start_strumd):
    strumd = start_strumd()
    with strumd.connect() as idle:
        assert strumd.end() == 0
        assert idle.recv(1) == b""


def test_the_store_stays_under_its_limit(start_strumd):
    limit = 1 << 20
    strumd = start_strumd("--cache-bytes", str(limit))
    for number in range(500):
        assert strumd.post({**CHEAP, "sag_parameter": 0.1 + 0.001 * number}).status_code == 200
        if number % 50 == 0:
            assert strumd.metric("cache_bytes") <= limit
    assert strumd.metric("cache_evictions_total") > 0
    assert strumd.metric("cache_bytes") <= limit
    assert strumd.metric("cache_entries") + strumd.metric("cache_evictions_total") == 500


def test_without_a_store_answers_still_come(start_strumd):
    strumd = start_strumd("--cache-bytes", "0")
    for _ in range(2):
        answer = strumd.post(CHEAP)
        assert answer.status_code == 200 and answer.headers["Cache-Status"] == "strum; fwd=miss"
    assert strumd.get(answer.headers["Content-Location"]).status_code == 404


def test_spellings_of_one_question_share_an_answer(start_strumd):
    strumd = start_strumd()
    for blanks in range(200):
        body = b'{"sag_parameter":' + b" " * blanks + b"0.9}"
        answer = strumd.request("POST", data=body, headers={"Content-Type": "application/json"})
        assert answer.status_code == 200
    assert strumd.metric("solves_total") == 1
    assert strumd.metric("cache_entries") == 1
