# SPDX-License-Identifier: GPL-3.0-or-later
"""What doc/reliability.md promises under load, as far as it can be told without a clock; tests/bench/reliability
measures the rest."""
import signal
import socket
import threading

from conftest import CHEAP, COSTLY, PATH, PATIENCE, PROGRAM, Strumd, read_answers, split_answers
from test_load import answers_of, as_bytes, ask, costly


def test_overload_refuses_the_excess_and_answers_what_is_stored(start_strumd):
    """16 connections ask new costly questions without pause of a crew that takes 4 at once."""
    strumd = start_strumd("--workers", "1", "--queue-depth", "3")
    first = strumd.post(CHEAP).content
    ended = threading.Event()
    statuses, lock = [], threading.Lock()

    def press(client):
        number = 0
        while not ended.is_set():
            number += 1
            with strumd.connect() as connection:
                connection.sendall(as_bytes({**COSTLY, "sag_parameter": 0.1 + 0.04 * client + 1e-6 * number}))
                for status, headers, _ in split_answers(read_answers(connection, 1)):
                    assert status == 200 or (status == 503 and headers["retry-after"] == "1"), (status, headers)
                    with lock:
                        statuses.append(status)
    clients = [threading.Thread(target=press, args=(client,)) for client in range(16)]
    for client in clients:
        client.start()
    try:
        while len(statuses) < 200 or 503 not in statuses:
            hit = strumd.post(CHEAP)
            assert (hit.status_code, hit.headers["Cache-Status"], hit.content) == (200, "strum; hit", first)
    finally:
        ended.set()
        for client in clients:
            client.join(PATIENCE)
    assert set(statuses) == {200, 503}
    assert strumd.metric("queue_refused_total") >= statuses.count(503) > 0


def dripping(strumd, count):
    """Connections that began a request and never end it."""
    connections = []
    for number in range(count):
        connections.append(strumd.connect())
        connections[-1].sendall(b"GET /livez HTTP/1.1\r\nX: " if number % 2 else
                                b"POST " + PATH.encode() + b" HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: 60000\r\n\r\n")
    return connections


def test_a_thousand_dripping_clients_are_cut(start_strumd):
    strumd = start_strumd("--idle-timeout-s", "3", "--request-timeout-s", "2")
    drips = dripping(strumd, 1000)
    left = set(drips)
    while left:
        assert strumd.post(CHEAP).status_code == 200
        for drip in list(left):
            try:
                drip.sendall(b"a")
                drip.settimeout(0)
                if drip.recv(1) == b"":
                    left.remove(drip)
            except BlockingIOError:
                pass
            except OSError:
                left.remove(drip)
    for drip in drips:
        drip.close()
    assert strumd.post(CHEAP).status_code == 200


def test_descriptors_run_out(tmp_path):
    """Of 64 allowed descriptors: who was accepted is answered, the rest wait until there is room, nothing is lost."""
    program = tmp_path / "strumd"
    program.write_text(f"#!/bin/sh\nulimit -n 64\nexec '{PROGRAM}' \"$@\"\n")
    program.chmod(0o755)
    strumd = Strumd("--idle-timeout-s", "60", "--request-timeout-s", "60", program=str(program))
    try:
        assert strumd.wait_log("limit")["level"] == "warning"
        idle = []
        for _ in range(100):
            idle.append(socket.create_connection(("127.0.0.1", strumd.port), timeout=PATIENCE))
            idle[-1].sendall(as_bytes(CHEAP))
        answered = 0
        while idle:  # those accepted first are answered; as they go, others get their turn
            with idle.pop(0) as connection:
                (status, _, _), = split_answers(read_answers(connection, 1))
                assert status == 200
                answered += 1
        assert answered == 100
        assert strumd.post(CHEAP).status_code == 200
        assert strumd.end() == 0
    finally:
        strumd.clean_up()


def test_kill_9_leaves_nothing_behind(start_strumd):
    """The port is free at once, the next daemon gives the same bytes, and no answer came half and looked whole."""
    strumd = start_strumd("--workers", "1", "--queue-depth", "1000")
    first = strumd.post(CHEAP).content
    under_way = ask(strumd, [costly(number) for number in range(1, 30)])
    strumd.process.kill()
    assert strumd.process.wait(PATIENCE) == -signal.SIGKILL
    for connection in under_way:
        with connection:
            assert all(status == 200 for status, _, _ in split_answers(read_answers(connection)))
    again = start_strumd("--listen", strumd.address)
    assert again.post(CHEAP).content == first
    assert [status for status, _, _ in answers_of(ask(again, [costly(number) for number in range(1, 5)]))] == [200] * 4
