# SPDX-License-Identifier: GPL-3.0-or-later
"""Starts the daemon for tests that talk to it.

The program is the one that the variable STRUMD names (default: build/src/strumd of this tree). Fixtures:
`strumd`, one daemon with default settings shared by the tests of a module, and `start_strumd`, which starts
one with the flags given and ends it after the test. Both give a Strumd.
"""
import json
import os
import pathlib
import signal
import socket
import subprocess
import threading

import pytest
import requests

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("STRUMD", str(ROOT / "build/src/strumd"))
PATIENCE = 60  # seconds: never waited for where all is well, whatever the sanitizer or the load

PATH = "/v1/catenary/frequencies"
CHEAP = {"rise_to_span": 0, "sag_parameter": 0.9, "modes": 6}
COSTLY = {"rise_to_span": 0, "sag_parameter": 0.9, "modes": 40}

FORCED = "/v1/forced/tension"
# Minutes of work for a worker that tells how far it is and ends when nobody waits any more.
ENDLESS = {"sag_parameter": 0.9, "frequency_ratio_min": 0, "frequency_ratio_max": 5, "points": 10000, "eta_normal": 0.1,
           "harmonics": [{"multiple": n, "tangential": 0.01} for n in range(1, 17)]}
# What only the mechanics find to be impossible: more modes below this frequency than are answered.
IMPOSSIBLE = {"sag_parameter": 0.9, "frequency_ratios": [500]}


class Strumd:
    """A running daemon: `url`, `port`, `process`, and `log`, its lines so far as dictionaries."""

    def __init__(self, *flags, environment=None, listening=None, program=PROGRAM):
        """`listening`: a socket to pass, as systemd does it."""
        self.log = []
        command = [program, *(flags if any(f.startswith("--listen") for f in flags) else ("--listen", "127.0.0.1:0", *flags))]
        if listening:
            command = ["bash", "-c", f'LISTEN_FDS=1 LISTEN_PID=$$ exec "$0" "$@" 3<&{listening.fileno()}', *command]
        self.process = subprocess.Popen(
            command, stderr=subprocess.PIPE, text=True, env={**os.environ, **(environment or {})},
            pass_fds=[listening.fileno()] if listening else [])
        self._lines = threading.Condition()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        line = self.wait_log("listening")
        self.address, self.port = line["address"], line["port"]
        self.url = f"http://{self.address}"

    def _read(self):
        for line in self.process.stderr:
            with self._lines:
                try:
                    self.log.append(json.loads(line))
                except ValueError:
                    self.log.append({"event": "not JSON", "text": line})
                self._lines.notify_all()
        with self._lines:
            self.log.append({"event": "end of log"})
            self._lines.notify_all()

    def wait_log(self, event):
        """The first line of that event, when it is there."""
        def found():
            return [line for line in self.log if line["event"] in (event, "end of log")]
        with self._lines:
            assert self._lines.wait_for(found, PATIENCE), f"no {event} within {PATIENCE} s: {self.log}"
        assert found()[0]["event"] == event, self.log
        return found()[0]

    def request(self, method, path=PATH, **arguments):
        return requests.request(method, self.url + path, timeout=PATIENCE, **arguments)

    def get(self, path, **arguments):
        return self.request("GET", path, **arguments)

    def post(self, body, path=PATH, **arguments):
        return self.request("POST", path, json=body, **arguments)

    def raw(self, *pieces, wait=True):
        """Sends bytes over a connection of its own; returns all that comes until the daemon closes it, or
        until the last complete answer when `wait` is a number of answers."""
        with self.connect() as connection:
            try:
                for piece in pieces:
                    connection.sendall(piece)
            except (BrokenPipeError, ConnectionResetError):
                pass
            return read_answers(connection, wait)

    def connect(self):
        return socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE)

    def metric(self, name):
        """The sum of a metric over its labels."""
        values = [line.rsplit(" ", 1)[1] for line in self.get("/metrics").text.splitlines()
                  if line.startswith((f"strum_{name} ", f"strum_{name}{{"))]
        return sum(map(int, values))

    def end(self, number=signal.SIGTERM):
        """Sends a signal; returns the exit status."""
        self.process.send_signal(number)
        return self.process.wait(PATIENCE)

    def clean_up(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            try:
                self.process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self.process.kill()
                raise
        self._reader.join()
        self.process.stderr.close()
        strange = [line for line in self.log if line["event"] == "not JSON"]
        assert not strange, strange


def reserve_port():
    """A bound socket that does not listen. For a server that cannot choose its port itself: while this is open, nobody
    else is given the port, and a server that sets SO_REUSEADDR may listen there."""
    reserved = socket.socket()
    reserved.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    reserved.bind(("127.0.0.1", 0))
    return reserved


def read_answers(connection, wait=True):
    """Reads until the end of the stream, or until `wait` answers are complete."""
    got = b""
    while wait is True or len(split_answers(got)) < wait:
        try:
            piece = connection.recv(65536)
        except ConnectionResetError:
            break
        if not piece:
            break
        got += piece
    return got


def split_answers(stream):
    """The complete answers in a stream: [(status, headers, body)]."""
    answers = []
    while b"\r\n\r\n" in stream:
        head, rest = stream.split(b"\r\n\r\n", 1)
        lines = head.decode("latin1").split("\r\n")
        headers = {name.lower(): value.strip() for name, value in (line.split(":", 1) for line in lines[1:])}
        status = int(lines[0].split()[1])
        length = 0 if status in (100, 204, 304) else int(headers.get("content-length", 0))
        if len(rest) < length:
            break
        answers.append((status, headers, rest[:length]))
        stream = rest[length:]
    return answers


@pytest.fixture
def start_strumd():
    started = []

    def start(*flags, **arguments):
        started.append(Strumd(*flags, **arguments))
        return started[-1]
    yield start
    for daemon in started:
        daemon.clean_up()


@pytest.fixture(scope="module")
def strumd():
    daemon = Strumd()
    yield daemon
    daemon.clean_up()
