# SPDX-License-Identifier: GPL-3.0-or-later
"""deploy/nginx/strum.conf by a real nginx before two daemons: repeats find their answer, faulty framing does not pass."""
import json
import re
import socket
import subprocess
import threading
import time

import pytest
import requests

from conftest import CHEAP, PATIENCE, PATH, ROOT, read_answers, reserve_port, split_answers

CONFIG = ROOT / "deploy/nginx/strum.conf"
MAIN = """daemon off;
worker_processes 1;
pid {folder}/nginx.pid;
error_log {folder}/error.log;
{user}
events {{ worker_connections 256; }}
http {{
    access_log off;
    client_body_temp_path {folder}/t1; proxy_temp_path {folder}/t2; fastcgi_temp_path {folder}/t3;
    uwsgi_temp_path {folder}/t4; scgi_temp_path {folder}/t5;
    {strum}
}}
"""


class Proxy:
    """nginx with the shipped file; only its addresses are others."""

    def __init__(self, folder, replicas):
        self.replicas = replicas
        with reserve_port() as reserved:
            self.port = reserved.getsockname()[1]
            self.start(folder)

    def start(self, folder):
        self.url = f"http://127.0.0.1:{self.port}"
        text, count = re.subn(r"listen 8080;", f"listen 127.0.0.1:{self.port};", CONFIG.read_text())
        assert count == 1
        for number, replica in enumerate(self.replicas, start=8081):
            text, count = re.subn(rf"127\.0\.0\.1:{number}\b", f"127.0.0.1:{replica.port}", text)
            assert count == 2
        # nginx refuses the line where it is not root, and would otherwise want the user that the package makes
        user = "user root;" if subprocess.check_output(["id", "-u"]).strip() == b"0" else ""
        (folder / "nginx.conf").write_text(MAIN.format(folder=folder, strum=text, user=user))
        self.error_log = folder / "error.log"
        command = ["nginx", "-c", folder / "nginx.conf", "-p", folder, "-e", self.error_log]
        checked = subprocess.run([*command, "-t"], capture_output=True, text=True)
        assert checked.returncode == 0, checked.stderr
        self.process = subprocess.Popen(command)
        end = time.monotonic() + PATIENCE
        while True:
            try:
                self.connect().close()
                break
            except OSError:
                assert self.process.poll() is None and time.monotonic() < end, self.error_log.read_text()

    def connect(self):
        return socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE)

    def request(self, method, body=None, path=PATH, **arguments):
        return requests.request(method, self.url + path, json=body, timeout=PATIENCE, **arguments)

    def metric(self, name):
        return [replica.metric(name) for replica in self.replicas]


@pytest.fixture
def proxy(start_strumd, tmp_path):
    proxied = Proxy(tmp_path, [start_strumd(), start_strumd()])
    yield proxied
    proxied.process.terminate()
    assert proxied.process.wait(PATIENCE) == 0


def question(number):
    return {**CHEAP, "sag_parameter": 0.5 + 0.001 * number}


def test_a_repeated_question_goes_to_the_replica_that_has_its_answer(proxy):
    for _ in range(5):
        for number in range(40):
            assert proxy.request("POST", question(number)).status_code == 200
    assert sum(proxy.metric("solves_total")) == 40
    assert sum(proxy.metric("cache_hits_total")) == 160
    assert min(proxy.metric("solves_total")) > 0


def test_query_and_post_share_an_answer_and_large_bodies_are_hashed_too(proxy):
    for number in range(10):
        body = json.dumps(question(number)).encode() + b" " * 60000
        for method in ("POST", "QUERY", "POST"):
            answer = proxy.request(method, data=body, headers={"Content-Type": "application/json"})
            assert answer.status_code == 200
    assert sum(proxy.metric("solves_total")) == 10
    assert min(proxy.metric("solves_total")) > 0


def test_a_chunked_body_is_hashed_as_any_other(proxy):
    for number in range(10):
        body = json.dumps(question(number)).encode()
        for data in (body, iter([body[:5], body[5:]])):
            answer = proxy.request("POST", data=data, headers={"Content-Type": "application/json"})
            assert answer.status_code == 200
    assert sum(proxy.metric("solves_total")) == 10


def test_get_keeps_its_replica(proxy):
    for number in range(20):
        for status in ("strum; fwd=miss; stored", "strum; hit"):
            answer = proxy.request("GET", path=f"{PATH}?sag_parameter={0.5 + 0.001 * number}")
            assert (answer.status_code, answer.headers["Cache-Status"]) == (200, status)


def test_an_answer_is_found_by_its_key_wherever_it_lies(proxy):
    for number in range(20):
        first = proxy.request("POST", question(number))
        again = proxy.request("GET", path=first.headers["Content-Location"])
        assert again.status_code == 200 and again.content == first.content
    assert proxy.request("GET", path="/v1/results/" + "0" * 64).status_code == 404


BODY = b'{"sag_parameter":0.9}'


def post(*headers, body=BODY, first=b"POST " + PATH.encode() + b" HTTP/1.1", host=b"Host: localhost\r\n"):
    return first + b"\r\nContent-Type: application/json\r\n" + host + b"".join(header + b"\r\n" for header in headers) + b"\r\n" + body


LENGTH = b"Content-Length: %d" % len(BODY)
CHUNKED = b"%x\r\n%s\r\n0\r\n\r\n" % (len(BODY), BODY)
SINS = {
    "length and chunked": post(LENGTH, b"Transfer-Encoding: chunked", body=CHUNKED),
    "unknown coding": post(b"Transfer-Encoding: gzip", body=CHUNKED),
    "a length twice": post(LENGTH, LENGTH),
    "no Host": post(LENGTH, host=b""),
    "two Hosts": post(LENGTH, host=b"Host: localhost\r\nHost: b\r\n"),
    "NUL in the path": b"GET /livez%00/b HTTP/1.1\r\nHost: localhost\r\n\r\n",
    "method in lower case": b"get /livez HTTP/1.1\r\nHost: localhost\r\n\r\n",
}


@pytest.fixture(scope="module")
def shared_proxy(strumd, tmp_path_factory):
    proxied = Proxy(tmp_path_factory.mktemp("nginx"), [strumd, strumd])
    yield proxied
    proxied.process.terminate()
    assert proxied.process.wait(PATIENCE) == 0


def sum_of_requests(strumd):
    """Requests of others: asking for the metrics counts itself."""
    return sum(int(line.rsplit(" ", 1)[1]) for line in strumd.get("/metrics").text.splitlines()
               if line.startswith("strum_requests_total{") and "/metrics" not in line)


@pytest.mark.parametrize("name", SINS)
def test_faulty_framing_does_not_pass(shared_proxy, strumd, name):
    before = sum_of_requests(strumd)
    with shared_proxy.connect() as connection:
        connection.sendall(SINS[name])
        answers = split_answers(read_answers(connection))
    assert len(answers) == 1 and answers[0][0] in (400, 413, 501, 505), answers
    assert sum_of_requests(strumd) == before


def test_what_passes_is_written_anew(shared_proxy, strumd):
    """A strange header name, which strumd refuses, is dropped."""
    with shared_proxy.connect() as connection:
        connection.sendall(b"GET /livez HTTP/1.1\r\nHost: a\r\nX(A): b\r\nConnection: close\r\n\r\n")
        (status, _, body), = split_answers(read_answers(connection))
    assert (status, body) == (200, b'{"status":"alive"}')


def test_who_drips_into_nginx_is_not_seen_by_strumd(shared_proxy, strumd):
    before = sum_of_requests(strumd)
    with shared_proxy.connect() as connection:
        connection.sendall(post(b"Content-Length: 1000"))
        assert shared_proxy.request("POST", CHEAP).status_code == 200
        assert sum_of_requests(strumd) == before + 1
        assert strumd.metric("requests_busy") == 1  # the one that asks


def test_refusals_keep_their_form(shared_proxy):
    too_large = shared_proxy.request("POST", data=b" " * 70000, headers={"Content-Type": "application/json"})
    faulty = shared_proxy.request("POST", {"modes": 0})
    for answer, status in ((too_large, 413), (faulty, 400)):
        assert answer.status_code == status
        assert answer.headers["Content-Type"] == "application/problem+json"
        assert answer.json()["status"] == status


def test_metrics_are_for_this_machine_only(shared_proxy):
    assert shared_proxy.request("GET", path="/metrics").status_code == 200
    for path in (b"/metrics", b"/readyz"):
        with socket.create_connection(("127.0.0.1", shared_proxy.port), PATIENCE, ("127.0.0.2", 0)) as elsewhere:
            elsewhere.sendall(b"GET " + path + b" HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
            assert split_answers(read_answers(elsewhere))[0][0] == 403


def test_a_replica_that_goes_is_not_missed(proxy):
    for number in range(20):
        assert proxy.request("POST", question(number)).status_code == 200
    gone, left = proxy.replicas
    gone.process.kill()
    gone.process.wait(PATIENCE)
    for number in range(40):
        assert proxy.request("POST", question(number)).status_code == 200
        assert proxy.request("GET", path=f"{PATH}?sag_parameter={0.5 + 0.001 * number}").status_code == 200
        assert proxy.request("QUERY", question(number)).status_code == 200
    assert left.end() == 0
    answer = proxy.request("POST", question(1))
    assert answer.status_code == 503 and answer.headers["Retry-After"] == "1"
    assert answer.headers["Content-Type"] == "application/problem+json"


class Mortal:
    """A replica that reads a request whole and goes without a word: `asked` counts them."""

    def __init__(self):
        self.asked = 0
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self.serve, daemon=True).start()

    def serve(self):
        while True:
            try:
                connection, _ = self.listener.accept()
            except OSError:
                return
            with connection:
                got = connection.recv(65536)
                while b"\r\n\r\n" not in got or (b"sag_parameter" not in got):
                    got += connection.recv(65536)
                self.asked += 1


@pytest.mark.parametrize("method", ["POST", "GET", "HEAD", "QUERY"])
def test_a_request_that_ended_a_replica_is_not_sent_to_the_next(tmp_path, method):
    replicas = [Mortal(), Mortal()]
    proxied = Proxy(tmp_path, replicas)
    try:
        reads = method in ("GET", "HEAD")
        answer = proxied.request(method, None if reads else CHEAP, PATH + "?sag_parameter=0.9" if reads else PATH)
        assert answer.status_code == 503 and answer.headers["Retry-After"] == "1"
        assert sum(replica.asked for replica in replicas) == 1
    finally:
        proxied.process.terminate()
        assert proxied.process.wait(PATIENCE) == 0
        for replica in replicas:
            replica.listener.close()
