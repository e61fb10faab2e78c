# SPDX-License-Identifier: GPL-3.0-or-later
"""A shared store: by a real redis-server that is full, stopped, paused, or holds what it should not."""
import hashlib
import json
import pathlib
import re
import signal
import struct
import subprocess
import threading
import time

import pytest

from conftest import COSTLY, FORCED, IMPOSSIBLE, PATIENCE, PROGRAM, ROOT, reserve_port
from test_batch import answers, item, post_batch
from test_load import answers_of, as_bytes, ask, costly, held, wait_metric

FOUND = "strum-store; hit, strum; fwd=miss; stored"
ALL = ("--inline-us", "0", "--store-timeout-ms", "60000")  # everything is shared, however slow this machine is
# Version, solver number, numerics of this machine, and build: a digest of the program after its length.
BYTES = pathlib.Path(PROGRAM).read_bytes()
NUMBER, = re.findall(r"^solver_number = (\d+)$", (ROOT / "meson.build").read_text(encoding="utf-8"), re.M)
VERSION = subprocess.check_output([PROGRAM, "--version"], text=True).split()[1]
BUILD = hashlib.sha256(struct.pack("<Q", len(BYTES)) + BYTES).hexdigest()[:16]


def solver_of(response):
    return f"{VERSION}-{NUMBER}-{response.json()['meta']['numerics']}-{BUILD}"


def name_of(response):
    return f"strum:{solver_of(response)}:{key_of(response)}"


class Redis:
    """A redis-server on a socket of its own that keeps nothing on disk."""

    def __init__(self, folder, *options):
        self.folder, self.options = folder, options
        self.path = folder / "redis.sock"
        self.flags = ("--store", f"unix:{self.path}")
        self.start()

    def start(self):
        self.process = subprocess.Popen(
            ["redis-server", "--port", "0", "--unixsocket", self.path, "--save", "", "--appendonly", "no", "--dir",
             self.folder, "--logfile", self.folder / "redis.log", *self.options])
        end = time.monotonic() + PATIENCE
        while self.ask("PING").strip() not in (b"PONG", b"NOAUTH Authentication required."):
            assert self.process.poll() is None and time.monotonic() < end, (self.folder / "redis.log").read_text()

    def ask(self, *words, value=None):
        """The reply; `value` becomes the last word."""
        command = ["redis-cli", "-s", self.path, "--raw", *(["-x"] if value is not None else []), *map(str, words)]
        return subprocess.run(command, input=value or b"", capture_output=True).stdout.removesuffix(b"\n")

    def keys(self):
        return sorted(self.ask("KEYS", "*").decode().split())

    def end(self, number=signal.SIGTERM):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGCONT)
            self.process.send_signal(number)
            self.process.wait(PATIENCE)


@pytest.fixture
def start_redis(tmp_path):
    started = []

    def start(*options):
        folder = tmp_path / f"redis{len(started)}"
        folder.mkdir()
        started.append(Redis(folder, *options))
        return started[-1]
    yield start
    for store in started:
        store.end()


@pytest.fixture
def redis(start_redis):
    return start_redis()


def fill(strumd, questions):
    """The answers, when they are in the store: that is after they were sent."""
    before = strumd.metric("store_writes_total")
    responses = [strumd.post(question) for question in questions]
    assert [response.status_code for response in responses] == [200] * len(responses)
    wait_metric(strumd, "store_writes_total", before + len(responses))
    return responses


def key_of(response):
    return response.json()["meta"]["key"]


# ---- a cold daemon answers from it ----

def test_a_cold_daemon_answers_from_the_store(start_strumd, redis):
    questions = [costly(number) for number in range(1, 6)]
    warm = start_strumd(*redis.flags, *ALL)
    first = fill(warm, questions)
    assert warm.metric("store_misses_total") == warm.metric("solves_total") == 5
    assert {response.headers["Cache-Status"] for response in first} == {"strum; fwd=miss; stored"}
    assert redis.keys() == sorted(name_of(response) for response in first)

    cold = start_strumd(*redis.flags, *ALL)
    assert cold.metric("store_away") == 1  # nobody has asked it yet
    for question, expected in zip(questions, first):
        for status in (FOUND, "strum; hit"):
            answer = cold.post(question)
            assert (answer.status_code, answer.headers["Cache-Status"]) == (200, status)
            assert answer.content == expected.content and answer.headers["ETag"] == expected.headers["ETag"]
            assert ("store;dur=" in answer.headers.get("Server-Timing", "")) == (status == FOUND)
    assert cold.metric("solves_total") == 0
    assert (cold.metric("store_hits_total"), cold.metric("store_misses_total"), cold.metric("store_away")) == (5, 0, 0)
    assert cold.wait_log("store")["detail"] == "the shared store answers"


def test_who_asks_for_events_gets_them(start_strumd, redis):
    body = fill(start_strumd(*redis.flags, *ALL), [costly(1)])[0].text
    cold = start_strumd(*redis.flags, *ALL)
    told = cold.post(costly(1), headers={"Accept": "text/event-stream"}).text
    assert told.endswith(f"event: result\ndata: {body}\n\n")
    assert cold.metric("solves_total") == 0


def test_who_waits_for_the_same_is_told_the_same(start_strumd, redis):
    first, = fill(start_strumd(*redis.flags, *ALL), [COSTLY])
    cold = start_strumd(*redis.flags, *ALL, "--workers", "1", "--cheap-us", "0")
    with held(cold):
        connections = ask(cold, [COSTLY] * 20)
        wait_metric(cold, "cache_joins_total", 19)
    told = answers_of(connections)
    assert {(status, body) for status, _, body in told} == {(200, first.content)}
    assert sorted(headers["cache-status"] for _, headers, _ in told) == (
        ["strum-store; hit, strum; fwd=miss; collapsed"] * 19 + [FOUND])
    assert cold.metric("store_hits_total") == 1 and cold.metric("solves_total") == 0


def test_a_batch_is_answered_from_the_store(start_strumd, redis):
    items = [item(costly(number)) for number in range(1, 9)]
    warm = start_strumd(*redis.flags, *ALL)
    answers(post_batch(warm, items[:1]))  # finds out that the store is there: no worker waits for another that does
    wait_metric(warm, "store_writes_total", 1)
    first = answers(post_batch(warm, items))
    wait_metric(warm, "store_writes_total", 8)
    cold = start_strumd(*redis.flags, *ALL)
    assert answers(post_batch(cold, items[:1])) == first[:1]  # finds out that the store is there
    assert answers(post_batch(cold, items)) == first
    assert cold.metric("solves_total") == 0 and cold.metric("store_hits_total") == 8


def test_an_answer_is_found_by_its_key(start_strumd, redis):
    first, = fill(start_strumd(*redis.flags, *ALL), [COSTLY])
    place = first.headers["Content-Location"]
    cold = start_strumd(*redis.flags, *ALL)
    for status in (FOUND, "strum; hit"):
        answer = cold.get(place)
        assert (answer.status_code, answer.headers["Cache-Status"], answer.content) == (200, status, first.content)
        assert answer.headers["Cache-Control"] == "public, max-age=31536000, immutable"
    assert cold.post(COSTLY).headers["Cache-Status"] == "strum; hit"
    colder = start_strumd(*redis.flags, *ALL)
    assert colder.get(place, headers={"If-None-Match": first.headers["ETag"]}).status_code == 304
    head = start_strumd(*redis.flags, *ALL).request("HEAD", place)
    assert (head.status_code, int(head.headers["Content-Length"]), head.content) == (200, len(first.content), b"")
    unknown = cold.get("/v1/results/" + "0" * 64)
    assert unknown.status_code == 404 and unknown.headers["Content-Type"] == "application/problem+json"
    assert cold.metric("solves_total") == 0


def test_who_asks_by_a_key_does_not_answer_for_who_asks_the_question(start_strumd, redis):
    """Both wait for one worker; nothing is stored: 404 for the one, the answer for the other."""
    key = key_of(start_strumd().post(COSTLY))
    strumd = start_strumd(*redis.flags, *ALL, "--workers", "1", "--cheap-us", "0", "--queue-depth", "10")
    by_key = b"GET /v1/results/%s HTTP/1.1\r\nHost: localhost\r\n\r\n" % key.encode()
    with held(strumd, 2):
        connections = [strumd.connect() for _ in range(3)]
        for connection, request in zip(connections, (by_key, as_bytes(COSTLY), by_key)):
            connection.sendall(request)
        wait_metric(strumd, "cache_joins_total", 1)
    assert [status for status, _, _ in answers_of(connections)] == [404, 200, 404]


def test_what_is_cheap_or_refused_is_not_shared(start_strumd, redis):
    strumd = start_strumd(*redis.flags, "--inline-us", "1000000")
    assert strumd.post(COSTLY).status_code == 200
    assert post_batch(strumd, [item(costly(3))]).status_code == 200
    assert strumd.metric("store_errors_total") == strumd.metric("store_misses_total") == 0
    strumd = start_strumd(*redis.flags, *ALL)
    assert strumd.post(IMPOSSIBLE, FORCED).status_code == 422
    assert redis.keys() == []


@pytest.mark.parametrize("flags, least, most", [((), 2592000 - 3600, 2592000), (("--store-expiry-s", "100"), 1, 100),
                                                (("--store-expiry-s", "0"), -1, -1)])
def test_expiry(start_strumd, redis, flags, least, most):
    fill(start_strumd(*redis.flags, *ALL, *flags), [COSTLY])
    key, = redis.keys()
    assert least <= int(redis.ask("TTL", key)) <= most


def test_other_addresses(start_strumd, start_redis):
    with reserve_port() as reserved:
        port = reserved.getsockname()[1]
        redis = start_redis("--port", str(port), "--bind", "127.0.0.1")
    fill(start_strumd("--store", f"127.0.0.1:{port}", *ALL), [COSTLY])
    for host in ("127.0.0.1", "localhost"):
        cold = start_strumd("--store", f"{host}:{port}", *ALL)
        assert cold.post(COSTLY).headers["Cache-Status"] == FOUND
    assert len(redis.keys()) == 1


# ---- lies ----

def test_what_was_changed_is_solved_anew_and_overwritten(start_strumd, redis):
    first, other = fill(start_strumd(*redis.flags, *ALL), [costly(1), costly(2)])
    key, other_key = name_of(first), name_of(other)
    good, other_value = redis.ask("GET", key), redis.ask("GET", other_key)
    assert first.content in good
    forged = good.replace(b'"frequency_ratio":', b'"frequency_ratio":9', 1)
    assert forged != good
    for value in (forged, good[:-1], good + b"}", good[:20], b"", other_value, first.content, b"\0" * 5000000):
        assert redis.ask("SET", key, value=value) == b"OK"
        cold = start_strumd(*redis.flags, *ALL)
        answer, = fill(cold, [costly(1)])
        assert (answer.content, answer.headers["Cache-Status"]) == (first.content, "strum; fwd=miss; stored")
        assert (cold.metric("store_rejected_total"), cold.metric("solves_total"), cold.metric("store_away")) == (1, 1, 0)
        assert redis.ask("GET", key) == good
    # by its key it is then not there
    redis.ask("SET", key, value=forged)
    assert start_strumd(*redis.flags, *ALL).get(first.headers["Content-Location"]).status_code == 404
    # something that is no value at all
    redis.ask("DEL", key)
    redis.ask("RPUSH", key, "a", "list")
    assert start_strumd(*redis.flags, *ALL).post(costly(1)).content == first.content


def test_another_solver_s_answers_are_not_looked_at(start_strumd, redis):
    first, = fill(start_strumd(*redis.flags, *ALL), [COSTLY])
    key, = redis.keys()
    redis.ask("RENAME", key, key.replace(solver_of(first), "0.1.0-1-0123456789abcdef-0123456789abcdef"))
    cold = start_strumd(*redis.flags, *ALL)
    assert fill(cold, [COSTLY])[0].content == first.content
    assert (cold.metric("store_misses_total"), cold.metric("store_rejected_total"), cold.metric("solves_total")) == (1, 0, 1)


def test_only_who_knows_the_secret_is_believed(start_strumd, redis, tmp_path):
    for name in ("ours", "theirs"):
        (tmp_path / name).write_text(f"{name}: a secret of many letters\n")
    ours, theirs = (("--store-secret-file", str(tmp_path / name)) for name in ("ours", "theirs"))
    for writer in ((), theirs, ours):
        redis.ask("FLUSHALL")
        first, = fill(start_strumd(*redis.flags, *ALL, *writer), [COSTLY])
        reader = start_strumd(*redis.flags, *ALL, *ours)
        assert reader.post(COSTLY).content == first.content
        wait_metric(reader, "store_writes_total", writer != ours)  # what it solved anew
        assert (reader.metric("store_hits_total"), reader.metric("store_rejected_total")) == (
            (1, 0) if writer == ours else (0, 1))


def test_a_password(start_strumd, start_redis, tmp_path):
    redis = start_redis("--requirepass", "a password of theirs")
    (tmp_path / "right").write_text("a password of theirs\n")
    (tmp_path / "wrong").write_text("a password of ours\n")
    for flags, said in (((), "NOAUTH"), (("--store-password-file", str(tmp_path / "wrong")), "WRONGPASS")):
        strumd = start_strumd(*redis.flags, *ALL, *flags)
        assert strumd.post(COSTLY).status_code == 200
        assert said in strumd.wait_log("store away")["detail"]
    right = ("--store-password-file", str(tmp_path / "right"))
    fill(start_strumd(*redis.flags, *ALL, *right), [COSTLY])
    assert start_strumd(*redis.flags, *ALL, *right).post(COSTLY).headers["Cache-Status"] == FOUND


# ---- stopped, paused, full ----

class Load(threading.Thread):
    """Asks one new question after the other."""

    def __init__(self, strumd, first):
        super().__init__(daemon=True)
        self.strumd, self.first, self.statuses, self.ended = strumd, first, [], False

    def run(self):
        while not self.ended:
            self.statuses.append(self.strumd.post({**COSTLY, "sag_parameter": self.first + 1e-6 * len(self.statuses)}).status_code)

    @staticmethod
    def count(loads):
        return sum(len(load.statuses) for load in loads)


@pytest.fixture
def load():
    """Four who ask; at the end every one of them has got every answer."""
    loads = []

    def start(strumd):
        loads.extend(Load(strumd, 0.2 + 0.1 * number) for number in range(4))
        for one in loads:
            one.start()
        return loads
    yield start
    for one in loads:
        one.ended = True
    for one in loads:
        one.join(PATIENCE)
    assert {status for one in loads for status in one.statuses} == {200}


def wait_answers(loads, number):
    wanted, end = Load.count(loads) + number, time.monotonic() + PATIENCE
    while Load.count(loads) < wanted:
        assert time.monotonic() < end


def test_a_store_that_stops_is_not_missed(start_strumd, redis, load):
    strumd = start_strumd(*redis.flags, *ALL)
    loads = load(strumd)
    for _ in range(2):
        wait_metric(strumd, "store_away", 0)
        wait_answers(loads, 20)
        redis.end(signal.SIGKILL)
        wait_metric(strumd, "store_away", 1)
        wait_answers(loads, 20)
        assert strumd.wait_log("store away")["level"] == "warning"
        redis.start()
    wait_metric(strumd, "store_away", 0)
    assert [line["event"] for line in strumd.log].count("store away") == 2


def test_a_restart_of_the_store_is_no_failure(start_strumd, redis):
    """Connections that lay idle are closed then."""
    strumd = start_strumd(*redis.flags, *ALL)
    fill(strumd, [costly(1)])
    redis.end()
    redis.start()
    fill(strumd, [costly(2)])
    assert strumd.metric("store_errors_total") == 0


def test_a_store_that_hangs_is_not_waited_for(start_strumd, redis, load):
    strumd = start_strumd(*redis.flags, "--inline-us", "0", "--store-timeout-ms", "1000")
    loads = load(strumd)
    wait_metric(strumd, "store_away", 0)
    redis.process.send_signal(signal.SIGSTOP)
    wait_metric(strumd, "store_away", 1)
    wait_answers(loads, 20)
    assert "in time" in strumd.wait_log("store away")["detail"]
    redis.process.send_signal(signal.SIGCONT)
    wait_metric(strumd, "store_away", 0)
    wait_answers(loads, 20)


def test_a_daemon_starts_and_ends_without_its_store(start_strumd, tmp_path):
    strumd = start_strumd("--store", f"unix:{tmp_path}/nobody", *ALL)
    assert strumd.get("/readyz").status_code == 200
    assert strumd.post(COSTLY).status_code == 200
    assert "No such file" in strumd.wait_log("store away")["detail"]
    assert strumd.get("/v1/results/" + "0" * 64).status_code == 404
    assert strumd.end() == 0


def test_a_store_that_is_full_still_answers(start_strumd, redis):
    first, = fill(start_strumd(*redis.flags, *ALL), [costly(1)])
    redis.ask("CONFIG", "SET", "maxmemory", "1")
    cold = start_strumd(*redis.flags, *ALL)
    assert cold.post(costly(2)).status_code == 200
    wait_metric(cold, "store_errors_total", 1)
    assert cold.post(costly(1)).headers["Cache-Status"] == FOUND
    assert cold.metric("store_away") == 0


# ---- settings ----

@pytest.mark.parametrize("flags, said", [
    (("--store", "nonsense"), 'not "nonsense"'),
    (("--store", "unix:" + "/a" * 60), "store must be"),
    (("--store", "127.0.0.1:6379", "--store-secret-file", "/nowhere/secret"), "/nowhere/secret: No such file"),
])
def test_faulty_settings_are_told(flags, said):
    done = subprocess.run([PROGRAM, "--listen", "127.0.0.1:0", *flags], capture_output=True, text=True, timeout=PATIENCE)
    assert done.returncode == 1 and said in json.loads(done.stderr)["detail"]
