# SPDX-License-Identifier: GPL-3.0-or-later
"""Restart without loss: the listening socket outlives the daemon."""
import socket
import subprocess
import threading

import pytest

from conftest import CHEAP, COSTLY, PATIENCE, PROGRAM, read_answers, split_answers
from test_load import as_bytes


@pytest.fixture
def listening():
    with socket.create_server(("127.0.0.1", 0), backlog=1024) as passed:
        yield passed


class Client(threading.Thread):
    """Asks without a pause, over a connection as long as it lasts; counts answers, notes what went wrong."""

    def __init__(self, port, number):
        super().__init__()
        self.port, self.number = port, number
        self.answered, self.wrong, self.stop = 0, [], False

    def question(self):
        # hits, and now and then something to solve: at once, or by a worker
        asked = self.answered
        fresh = 0.1 + 0.8 * ((asked * 16 + self.number) % 99991) / 99991
        return as_bytes({**(COSTLY if asked % 50 == 20 else CHEAP), **({"sag_parameter": fresh} if asked % 5 == 0 else {})})

    def run(self):
        while not self.stop:
            with socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE) as connection:
                while not self.stop:
                    connection.sendall(self.question())
                    got = split_answers(read_answers(connection, 1))
                    if [status for status, _, _ in got] != [200]:
                        self.wrong.append(got)
                        break
                    self.answered += 1
                    if got[0][1].get("connection") == "close":
                        break


@pytest.mark.parametrize("overlap", [True, False], ids=["the next one first", "one after the other"])
def test_four_restarts_under_load(start_strumd, listening, overlap):
    flags = ("--queue-depth", "1000")
    strumd = start_strumd(*flags, listening=listening)
    assert strumd.port == listening.getsockname()[1]
    clients = [Client(strumd.port, number) for number in range(8)]
    for client in clients:
        client.start()
    try:
        for restart in range(1, 5):
            while sum(client.answered for client in clients) < 500 * restart:
                assert not any(client.wrong for client in clients)
            if overlap:
                following = start_strumd(*flags, listening=listening)
                assert strumd.end() == 0
                strumd = following
            else:
                assert strumd.end() == 0
                strumd = start_strumd(*flags, listening=listening)
        while sum(client.answered for client in clients) < 2500:
            pass
    finally:
        for client in clients:
            client.stop = True
        for client in clients:
            client.join()
    assert [client.wrong for client in clients] == [[]] * 8
    assert sum(client.answered for client in clients) >= 2500


def test_who_comes_while_nobody_is_there_waits(start_strumd, listening):
    strumd = start_strumd(listening=listening)
    assert strumd.end() == 0
    with strumd.connect() as connection:
        connection.sendall(as_bytes(CHEAP))
        start_strumd(listening=listening)
        assert split_answers(read_answers(connection, 1))[0][0] == 200


def test_only_our_own_listening_socket_is_taken(start_strumd):
    # meant for another process: not ours
    strumd = start_strumd(environment={"LISTEN_FDS": "1", "LISTEN_PID": "1"})
    assert strumd.get("/livez").status_code == 200
    for count, redirection in (("1", "3</dev/null"), ("1", "3<&-"), ("2", "3</dev/null")):
        done = subprocess.run(["bash", "-c", f'LISTEN_FDS={count} LISTEN_PID=$$ exec "$0" {redirection}', PROGRAM],
                              capture_output=True, text=True, timeout=PATIENCE)
        assert done.returncode == 1 and "LISTEN_FDS" in done.stderr


def test_a_passed_socket_is_guarded_like_any_other(start_strumd):
    with socket.create_server(("0.0.0.0", 0)) as passed:
        command = f'LISTEN_FDS=1 LISTEN_PID=$$ exec "$0" 3<&{passed.fileno()}'
        done = subprocess.run(["bash", "-c", command, PROGRAM], capture_output=True, text=True, timeout=PATIENCE,
                              pass_fds=[passed.fileno()])
        assert done.returncode == 1 and "allow_non_loopback" in done.stderr
        strumd = start_strumd("--allow-non-loopback", listening=passed)
        assert strumd.port == passed.getsockname()[1]
