# SPDX-License-Identifier: GPL-3.0-or-later
"""Cheap and costly questions beside each other: who waits for whom, and what the daemon tells of it."""
import contextlib
import json
import math
import re
import socket
import time

from conftest import CHEAP, ENDLESS, FORCED
from test_batch import answers, item, open_batch, post_batch
from test_events import open_events, read_until
from test_load import answers_of, ask, wait_metric


def lane(strumd, name, metric="lane_seconds"):
    found = re.search(rf'^strum_{metric}{{lane="{name}"}} (\S+)$', strumd.get("/metrics").text, re.M)
    return float(found.group(1))


def timing(response):
    """Server-Timing in milliseconds."""
    return {name: float(ms) for name, ms in re.findall(r"(\w+);dur=([\d.]+)", response.headers["Server-Timing"])}


def endless(number):
    return {**ENDLESS, "points": 9000 + number}


@contextlib.contextmanager
def busy(strumd, count):
    """So many workers are at work without end, inside."""
    with contextlib.ExitStack() as stack:
        for connection in ask(strumd, [endless(n) for n in range(count)], FORCED):
            stack.enter_context(connection)
        wait_metric(strumd, "workers_busy", count)
        yield
    wait_metric(strumd, "workers_busy", 0)


def test_cheap_questions_do_not_wait_for_costly_ones(start_strumd):
    """Every worker has work without end, more waits: cheap questions that were never asked are answered."""
    strumd = start_strumd("--workers", "1", "--queue-depth", "3", "--inline-us", "0")
    with busy(strumd, 1):
        waiting = ask(strumd, [endless(100 + n) for n in range(4)], FORCED)
        wait_metric(strumd, "queue_refused_total", 1)
        for n in range(20):
            answer = strumd.post({**CHEAP, "sag_parameter": 0.5 + 0.01 * n})
            assert answer.status_code == 200 and answer.headers["Cache-Status"] == "strum; fwd=miss; stored"
        for connection in waiting:
            connection.close()


def test_long_questions_leave_a_worker_to_others(start_strumd):
    strumd = start_strumd("--workers", "2", "--cheap-us", "0", "--inline-us", "0")
    with busy(strumd, 1):
        second, = ask(strumd, [endless(100)], FORCED)
        wait_metric(strumd, "queue_depth", 1)
        assert strumd.post(CHEAP).status_code == 200  # not cheap by these settings
        wait_metric(strumd, "workers_busy", 1)
        assert lane(strumd, "long", "lane_jobs") == 1
        second.close()


def test_retry_after_follows_from_the_queue(start_strumd):
    strumd = start_strumd("--workers", "1", "--queue-depth", "2", "--retry-after-s", "3", "--solve-timeout-s", "5000")
    with busy(strumd, 1):
        waiting = ask(strumd, [endless(100 + n) for n in range(2)], FORCED)
        wait_metric(strumd, "queue_depth", 2)
        refused = strumd.post(endless(200), FORCED)
        assert refused.status_code == 503
        assert int(refused.headers["Retry-After"]) == math.ceil(lane(strumd, "long")) > 3
        for connection in waiting:
            connection.close()
    # nothing waits: what is named is the setting
    wait_metric(strumd, "queue_depth", 0)
    with busy(strumd, 1):
        assert strumd.get("/readyz").json()["backlog_s"] == 0


def test_retry_after_is_at_most_the_time_that_anyone_waits(start_strumd):
    strumd = start_strumd("--workers", "1", "--queue-depth", "2", "--solve-timeout-s", "30")
    with busy(strumd, 1):
        waiting = ask(strumd, [endless(100 + n) for n in range(2)], FORCED)
        wait_metric(strumd, "queue_depth", 2)
        assert strumd.post(endless(200), FORCED).headers["Retry-After"] == "30"
        for connection in waiting:
            connection.close()


def test_abandoned_work_is_seen(start_strumd):
    strumd = start_strumd("--workers", "1")
    ready = strumd.get("/readyz").json()
    assert ready == {"status": "ready", "workers": 2, "working": 0, "backlog_s": 0, "abandoned": 0, "abandoned_s": 0}
    with busy(strumd, 1):
        leaving, = ask(strumd, [endless(100)], FORCED)
        wait_metric(strumd, "queue_depth", 1)
        leaving.close()
        wait_metric(strumd, "abandoned", 1)
        ready = strumd.get("/readyz").json()
        assert ready["abandoned"] == 1 and ready["working"] == 1 and ready["backlog_s"] > 0
        ages = []
        while len(ages) < 2 or ages[-1] <= ages[0]:  # it grows
            ages.append(strumd.get("/readyz").json()["abandoned_s"])
        assert re.search(r"^strum_abandoned_seconds \d+\.\d{6}$", strumd.get("/metrics").text, re.M)
    wait_metric(strumd, "abandoned", 0)
    assert strumd.get("/readyz").json()["abandoned_s"] == 0


def test_the_estimate_is_told(start_strumd):
    strumd = start_strumd()
    told = timing(strumd.post({**CHEAP, "sag_parameter": 0.7}))
    assert set(told) == {"read", "queue", "solve", "cpu", "estimate"}
    assert 0 < told["cpu"] <= told["solve"] + 0.01 and told["estimate"] > 0


def test_an_event_stream_that_waits_says_so(start_strumd):
    """A queue event soon, then a comment in each silence of 10 s."""
    strumd = start_strumd("--workers", "1")
    with busy(strumd, 1):
        begun = time.monotonic()
        connection = open_events(strumd, endless(100))
        got = read_until(connection, b"event: queue\n")
        got += read_until(connection, b": still at it\n\n")
        assert time.monotonic() - begun >= 10
        told = re.search(rb'event: queue\ndata: (\{.*\})\n\n', got).group(1)
        assert json.loads(told)["waiting"] == 1 and json.loads(told)["backlog_s"] > 0
        connection.close()


def test_who_asks_again_for_an_abandoned_question_joins_it(start_strumd):
    """It waits for the one worker when its client leaves; it is asked again, and solved once."""
    strumd = start_strumd("--workers", "1", "--cheap-us", "0", "--inline-us", "0")
    with busy(strumd, 1):
        leaving, = ask(strumd, [CHEAP])
        wait_metric(strumd, "queue_depth", 1)
        leaving.close()
        wait_metric(strumd, "abandoned", 1)
        again, = ask(strumd, [CHEAP])
        wait_metric(strumd, "cache_joins_total", 1)
        assert strumd.metric("abandoned") == 0 and strumd.metric("flights") == 2
    (status, headers, _), = answers_of([again])
    assert status == 200 and headers["cache-status"] == "strum; fwd=miss; collapsed"
    assert strumd.metric("solves_total") == 1


def test_answers_that_nobody_reads_hold_solves_up(start_strumd):
    """What is not read counts as memory: another question waits until there is room, stored answers still come."""
    strumd = start_strumd("--memory-bytes", "24M", "--cache-bytes", "100K", "--request-timeout-s", "60")
    assert strumd.post(CHEAP).status_code == 200
    large = {"sag_parameter": 0.9, "frequency_ratios": [1], "profile_points": 2000}  # over 8 MB, more than sockets hold
    questions = [{**large, "profiles_at": [0.01 * n + 0.001 * which for n in range(50)]} for which in range(2)]
    unread, = ask(strumd, questions[:1], FORCED)
    wait_metric(strumd, "solves_total", 2)
    wait_metric(strumd, "workers_busy", 0)  # what the solve held is free
    assert 8e6 < strumd.metric("memory_bytes") < strumd.metric("memory_limit_bytes") == 24 << 20
    waiting, = ask(strumd, questions[1:], FORCED)
    wait_metric(strumd, "lane_jobs", 1)
    assert strumd.post(CHEAP).headers["Cache-Status"] == "strum; hit"
    assert strumd.metric("workers_busy") == 0 and strumd.metric("lane_jobs") == 1
    unread.close()
    assert answers_of([waiting])[0][0] == 200
    wait_metric(strumd, "memory_bytes", 0)


def test_no_solve_takes_the_memory_of_others(start_strumd):
    """A question of minutes is estimated at more than there is, or at little: neither keeps others out."""
    strumd = start_strumd("--memory-bytes", "64M", "--workers", "2")
    large = {"chi_1": -12.5, "chi_2": 12.5, "modes": 200, "verify": True}
    with busy(strumd, 1):
        held, = ask(strumd, [large])
        wait_metric(strumd, "flights", 2)
        for n in range(20):
            assert strumd.post({**CHEAP, "sag_parameter": 0.5 + 0.01 * n}).status_code == 200
        held.close()


def test_a_body_without_memory_is_refused(start_strumd):
    strumd = start_strumd("--memory-bytes", "20000")
    refused = strumd.request("POST", "/v1/batch", data=b"[" + b" " * 30000 + b"]", headers={"Content-Type": "application/json"})
    assert refused.status_code == 503 and refused.headers["Retry-After"] and "memory" in refused.json()["detail"]
    wait_metric(strumd, "memory_bytes", 0)


def test_a_batch_takes_a_slot_when_its_body_is_whole(start_strumd):
    strumd = start_strumd("--batches", "4")
    head = b"POST /v1/batch HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: 100\r\n\r\n["
    with contextlib.ExitStack() as stack:
        for _ in range(16):
            stack.enter_context(strumd.connect()).sendall(head)
        wait_metric(strumd, "requests_busy", 17)  # and who asks for the metrics
        assert answers(post_batch(strumd, [item(CHEAP)]))


def test_no_client_holds_all_slots_of_batches(start_strumd):
    strumd = start_strumd("--batches", "4")
    with contextlib.ExitStack() as stack:
        for n in range(3):
            stack.enter_context(open_batch(strumd, [item(endless(n), FORCED)]))
        wait_metric(strumd, "flights", 3)
        refused = post_batch(strumd, [item(CHEAP)])
        assert refused.status_code == 503 and refused.headers["Retry-After"]
        other = socket.create_connection(("127.0.0.1", strumd.port), 60, source_address=("127.0.0.2", 0))
        body = json.dumps([item(CHEAP)]).encode()
        other.sendall(b"POST /v1/batch HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: %d\r\n\r\n%s"
                      % (len(body), body))
        assert read_until(other, b'"result"').startswith(b"HTTP/1.1 200")
        other.close()
