# SPDX-License-Identifier: GPL-3.0-or-later
"""A log that nobody reads, and one that is not there."""
import json
import os
import re
import signal
import subprocess

import pytest
import requests

from conftest import PATIENCE, PROGRAM


def begin(where, **arguments):
    """A daemon whose address is known beforehand: its log is not read by us."""
    return subprocess.Popen([PROGRAM, "--listen", where, "--log-requests", "all", "--drain-timeout-s", "5"], **arguments)


def first_line(fd):
    line = b""
    while not line.endswith(b"\n"):
        line += os.read(fd, 1)
    return json.loads(line)


def test_a_reader_that_stalls_stops_nothing():
    """Lines are dropped and counted; those that are read are whole, in order, and say how many are missing."""
    reader, writer = os.pipe()
    with begin("127.0.0.1:0", stderr=writer) as daemon, requests.Session() as session:
        os.close(writer)
        url = f"http://{first_line(reader)['address']}"
        sent = 0
        while True:
            for _ in range(200):
                answer = session.get(f"{url}/{90 * 'a'}", timeout=PATIENCE,
                                     headers={"X-Request-Id": f"{sent:070}", "traceparent": f"00-{32 * 'a'}-{16 * 'b'}-01"})
                assert answer.status_code == 404
                sent += 1
            metrics = session.get(f"{url}/metrics", timeout=PATIENCE, headers={"X-Request-Id": f"{sent:070}"}).text
            sent += 1
            dropped = int(re.search(r"^strum_log_lines_dropped_total (\d+)$", metrics, re.M)[1])
            if dropped > 100:
                break
            assert sent < 20000, "nothing is dropped, and nothing was held up: where do lines go?"
        with os.fdopen(reader, encoding="utf-8") as log:
            lines, known = [], 0
            while known < sent:  # written, or confessed: then there is room again
                lines.append(json.loads(log.readline()))
                known += lines[-1].get("count", lines[-1]["event"] == "request")
            daemon.send_signal(signal.SIGTERM)
            lines += map(json.loads, log)  # ends when the daemon has
        assert daemon.wait(PATIENCE) == 0
    ids = [int(line["id"]) for line in lines if line["event"] == "request"]
    missing = sum(line["count"] for line in lines if line["event"] == "log lines dropped")
    assert ids == sorted(ids) and ids[0] == 0
    assert missing >= dropped > 0 and len(ids) + missing == sent
    assert lines[-1]["event"] == "stopped"


def test_it_ends_although_nobody_reads():
    reader, writer = os.pipe()
    with begin("127.0.0.1:0", stderr=writer) as daemon:
        os.close(writer)
        url = f"http://{first_line(reader)['address']}"
        with requests.Session() as session:
            for number in range(1500):
                assert session.get(f"{url}/livez", timeout=PATIENCE, headers={"X-Request-Id": f"{number:070}"}).status_code == 200
        daemon.send_signal(signal.SIGTERM)
        assert daemon.wait(PATIENCE) == 0
    os.close(reader)


def test_a_pipe_without_a_reader_does_not_end_it():
    reader, writer = os.pipe()
    with begin("127.0.0.1:0", stderr=writer) as daemon:
        os.close(writer)
        url = f"http://{first_line(reader)['address']}"
        os.close(reader)
        for _ in range(3):
            assert requests.get(f"{url}/livez", timeout=PATIENCE).status_code == 200
        daemon.send_signal(signal.SIGTERM)
        assert daemon.wait(PATIENCE) == 0


def listens(pid):
    """Whether the process is the daemon and has a socket of its own: until then it is bash, whose numbers are not
    redirected yet, and which may itself ask a name service through a socket."""
    if not os.path.samefile(f"/proc/{pid}/exe", PROGRAM):
        return False
    for fd in os.listdir(f"/proc/{pid}/fd"):
        try:
            if int(fd) > 2 and os.readlink(f"/proc/{pid}/fd/{fd}").startswith("socket:"):
                return True
        except FileNotFoundError:
            pass
    return False


@pytest.mark.parametrize("closed", ["0<&-", "1>&-", "2>&-", "0<&- 1>&- 2>&-"])
def test_closed_descriptors_are_not_taken_for_connections(tmp_path, closed):
    """Were number 2 free, the first socket would get it, and the log would go to a client."""
    command = ["bash", "-c", f'exec "$0" --listen 127.0.0.1:0 --log-requests all {closed}', PROGRAM]
    with subprocess.Popen(command) as daemon:
        try:
            while not listens(daemon.pid):
                assert daemon.poll() is None
            for fd, word in enumerate(("0<", "1>", "2>")):
                if word in closed:
                    assert os.readlink(f"/proc/{daemon.pid}/fd/{fd}") == "/dev/null", fd
        finally:
            daemon.terminate()
        assert daemon.wait(PATIENCE) == 0
