# SPDX-License-Identifier: GPL-3.0-or-later
"""The edges of HTTP/1.1, by bytes on a socket: what our own guard refuses, and the limits."""
import concurrent.futures
import resource
import time

import pytest

from conftest import CHEAP, PATH, read_answers, split_answers

BODY = b'{"sag_parameter":0.9}'
SECOND = b"GET /livez HTTP/1.1\r\nHost: localhost\r\n\r\n"


def post(*headers, body=BODY, host=b"Host: localhost\r\n", version=b"1.1"):
    if not any(header.startswith(b"Content-Type") for header in headers):
        headers = (b"Content-Type: application/json", *headers)
    return b"POST " + PATH.encode() + b" HTTP/" + version + b"\r\n" + host + b"".join(h + b"\r\n" for h in headers) + \
        b"\r\n" + body


def length(size=len(BODY)):
    return b"Content-Length: %d" % size


CHUNKED = b"%x\r\n%s\r\n0\r\n\r\n" % (len(BODY), BODY)

# name: (bytes, the status, whether the connection must be closed so that what follows is never a request)
EDGES = {
    "a plain one": (post(length()), 200, False),
    "chunked": (post(b"Transfer-Encoding: chunked", body=CHUNKED), 200, False),
    "Chunked": (post(b"Transfer-Encoding: Chunked", body=CHUNKED), 200, False),
    "no Host in 1.0": (post(length(), host=b"", version=b"1.0"), 200, True),
    "length and chunked": (post(length(), b"Transfer-Encoding: chunked", body=CHUNKED), 400, True),
    "unknown coding": (post(b"Transfer-Encoding: gzip", body=CHUNKED), 501, True),
    "coding twice": (post(b"Transfer-Encoding: chunked", b"Transfer-Encoding: chunked", body=CHUNKED), 400, True),
    "chunked in 1.0": (post(b"Transfer-Encoding: chunked", body=CHUNKED, version=b"1.0"), 400, True),
    "a length twice": (post(length(), length()), 400, True),
    "no Host": (post(length(), host=b""), 400, True),
    "two Hosts": (post(length(), host=b"Host: localhost\r\nHost: b\r\n"), 400, True),
    "strange header name": (post(length(), b"X(A): a"), 400, True),
    "NUL in the path": (b"GET /livez%00/b HTTP/1.1\r\nHost: localhost\r\n\r\n", 404, False),
    "NUL in a parameter": (b"GET " + PATH.encode() + b"?modes=6%00 HTTP/1.1\r\nHost: localhost\r\n\r\n", 400, False),
    "encoded path": (b"GET /%6civez HTTP/1.1\r\nHost: localhost\r\n\r\n", 200, False),
    "broken encoding": (b"GET /livez%zz HTTP/1.1\r\nHost: localhost\r\n\r\n", 404, False),
    "dots": (b"GET /x/../livez HTTP/1.1\r\nHost: localhost\r\n\r\n", 404, False),
    "method in lower case": (b"get /livez HTTP/1.1\r\nHost: localhost\r\n\r\n", 501, False),
    "OPTIONS *": (b"OPTIONS * HTTP/1.1\r\nHost: localhost\r\n\r\n", 204, False),
    "GET *": (b"GET * HTTP/1.1\r\nHost: localhost\r\n\r\n", 404, False),
    "a URL": (b"GET http://localhost/livez HTTP/1.1\r\nHost: localhost\r\n\r\n", 200, False),
    "a URL of a strange case": (b"GET HTTPS://LocalHost:1/livez HTTP/1.1\r\nHost: localhost\r\n\r\n", 200, False),
    "a URL without a path": (b"OPTIONS http://localhost HTTP/1.1\r\nHost: localhost\r\n\r\n", 204, False),
    "a URL with parameters and no path": (b"GET http://localhost?a HTTP/1.1\r\nHost: localhost\r\n\r\n", 200, False),
    "a URL without Host": (b"GET http://localhost/livez HTTP/1.1\r\n\r\n", 400, True),
    "a URL without a host": (b"GET http:///livez HTTP/1.1\r\nHost: localhost\r\n\r\n", 400, False),
    "a URL with a port alone": (b"GET http://:80/livez HTTP/1.1\r\nHost: localhost\r\n\r\n", 400, False),
    "a URL with a user": (b"GET http://me@localhost/livez HTTP/1.1\r\nHost: localhost\r\n\r\n", 400, False),
    "a URL with a long host": (b"GET http://" + 256 * b"a" + b"/livez HTTP/1.1\r\nHost: localhost\r\n\r\n", 400, False),
    "a URL of another scheme": (b"GET ftp://localhost/livez HTTP/1.1\r\nHost: localhost\r\n\r\n", 404, False),
    "two requests at once": (SECOND, 200, False),
    "body over the limit": (post(length(65537), body=b""), 413, True),
    "body far over the limit": (post(length(10**12), body=b""), 413, True),
    "over the limit, asked before": (post(length(65537), b"Expect: 100-continue", body=b""), 413, True),
    "wrong type, asked before": (post(length(), b"Content-Type: a/b", b"Expect: 100-continue", body=b""), 415, True),
}


@pytest.mark.parametrize("name", EDGES)
def test_edge(strumd, name):
    sent, status, closed = EDGES[name]
    # A second request on the connection tells whether it was closed, and that the first one's end was seen right.
    answers = split_answers(strumd.raw(sent, b"" if closed else SECOND, wait=True if closed else 2))
    assert [got for got, _, _ in answers] == [status] if closed else [status, 200]
    if status >= 400:
        assert answers[0][1]["content-type"] == "application/problem+json"
        assert b'"status":%d' % status in answers[0][2]
    if closed:
        assert answers[0][1]["connection"] == "close"
    else:
        assert answers[1][2] == b'{"status":"alive"}'


def test_expect_continue(strumd):
    with strumd.connect() as connection:
        connection.sendall(post(length(), b"Expect: 100-continue", body=b""))
        assert connection.recv(100).startswith(b"HTTP/1.1 100 ")
        connection.sendall(BODY)
        assert connection.recv(100).startswith(b"HTTP/1.1 200 ")


def test_a_chunked_body_over_the_limit(strumd):
    chunk = b"2710\r\n" + b" " * 10000 + b"\r\n"
    answers = split_answers(strumd.raw(post(b"Transfer-Encoding: chunked", body=chunk * 10 + b"0\r\n\r\n")))
    assert [status for status, _, _ in answers] == [413]
    # one that never ends is cut
    assert split_answers(strumd.raw(post(b"Transfer-Encoding: chunked", body=chunk * 400))) == []
    assert strumd.get("/livez").status_code == 200


def test_a_body_at_the_limit(start_strumd):
    strumd = start_strumd("--body-bytes", "1000")
    body = BODY + b" " * (1000 - len(BODY))
    assert split_answers(strumd.raw(post(length(1000), body=body), wait=1))[0][0] == 200
    assert split_answers(strumd.raw(post(length(1001), body=body + b" ")))[0][0] == 413
    chunks = b"3e8\r\n" + body + b"\r\n"
    te = b"Transfer-Encoding: chunked"
    assert split_answers(strumd.raw(post(te, body=chunks + b"0\r\n\r\n"), wait=1))[0][0] == 200
    assert split_answers(strumd.raw(post(te, body=chunks + b"1\r\n \r\n0\r\n\r\n")))[0][0] == 413


@pytest.mark.parametrize("size", [65537, 70000, 900000])
def test_who_sends_all_before_reading_gets_the_refusal(strumd, size):
    """As many proxies do. Without care the kernel resets the connection, and the answer is lost."""
    with strumd.connect() as connection:
        connection.sendall(post(length(size), body=b""))
        for _ in range(10):  # long after the answer was sent
            time.sleep(0.05)
            connection.sendall(b" " * (size // 10))
        (status, headers, _), = split_answers(read_answers(connection))
        assert status == 413 and headers["connection"] == "close"


def test_who_never_stops_sending_is_cut(strumd):
    with strumd.connect() as connection, pytest.raises((BrokenPipeError, ConnectionResetError)):
        connection.sendall(post(length(10**12), body=b""))
        while True:
            connection.sendall(b" " * 10000)
    with strumd.connect() as slow, pytest.raises((BrokenPipeError, ConnectionResetError)):
        slow.sendall(post(length(10**12), body=b""))
        while True:
            slow.sendall(b" ")
            time.sleep(0.05)


def test_too_much_head(strumd):
    """libmicrohttpd answers these itself, in HTML."""
    long = b"a" * 20000
    assert split_answers(strumd.raw(b"GET /" + long + b" HTTP/1.1\r\nHost: localhost\r\n\r\n"))[0][0] == 414
    assert split_answers(strumd.raw(b"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + long + b"\r\n\r\n"))[0][0] == 431


def test_too_many_parameters(strumd):
    query = "&".join(f"a{i}=1" for i in range(65))
    assert strumd.get(f"{PATH}?{query}").status_code == 400
    assert strumd.get(f"{PATH}?modes").status_code == 400


@pytest.mark.parametrize("start", [b"", b"GET /livez HTTP/1.1\r\nHo", post(length(20), body=b"{")],
                         ids=["idle", "half a head", "half a body"])
def test_silent_clients_are_cut(start_strumd, start):
    strumd = start_strumd("--idle-timeout-s", "0.5", "--request-timeout-s", "0.5")
    assert strumd.raw(start) == b""


@pytest.mark.parametrize("start", [b"GET /livez HTTP/1.1\r\n", post(length(60000), body=b"")], ids=["head", "body"])
def test_dripping_clients_are_cut_and_others_are_not(start_strumd, start):
    strumd = start_strumd("--idle-timeout-s", "0.6", "--request-timeout-s", "0.5")
    with strumd.connect() as drip:
        drip.sendall(start)
        drip.settimeout(0.02)
        answered = 0
        while True:  # a byte now and then: never silent for long
            try:
                drip.sendall(b"a")
                if drip.recv(100) == b"":
                    break
            except TimeoutError:
                pass
            except (BrokenPipeError, ConnectionResetError):
                break
            answered += strumd.post(CHEAP).status_code == 200
        assert answered > 0


def test_the_connection_over_the_limit_waits_its_turn(start_strumd):
    strumd = start_strumd("--connections", "5")
    idle = [strumd.connect() for _ in range(5)]
    for connection in idle:
        connection.sendall(SECOND)
        assert split_answers(read_answers(connection, 1))[0][0] == 200
    with strumd.connect() as late:
        late.sendall(SECOND)
        idle.pop().close()
        assert split_answers(read_answers(late, 1))[0][0] == 200
    for connection in idle:
        connection.close()


def test_many_clients_that_never_ask(start_strumd):
    strumd = start_strumd("--connections", "400", "--idle-timeout-s", "5")
    idle = [strumd.connect() for _ in range(300)]
    try:
        assert strumd.post(CHEAP).status_code == 200
    finally:
        for connection in idle:
            connection.close()


def test_more_connections_than_the_limit(start_strumd):
    """At the default settings: beyond the limit clients wait; the others are answered, and all are when some have gone.
    (libmicrohttpd 0.9.75 stops for ever when its own limit is reached.)"""
    limit = 4096
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    assert hard > limit + 1000, f"{hard} descriptors do not suffice for this test"
    resource.setrlimit(resource.RLIMIT_NOFILE, (hard, hard))
    strumd = start_strumd()
    crowd = []
    try:
        with strumd.connect() as first:
            first.sendall(SECOND)
            assert split_answers(read_answers(first, 1))[0][0] == 200
            with concurrent.futures.ThreadPoolExecutor(8) as pool:  # faster than they are taken up
                crowd += pool.map(lambda _: strumd.connect(), range(limit + 800))
            first.sendall(post(length()))
            assert split_answers(read_answers(first, 1))[0][0] == 200
        for _ in range(2):
            late = crowd[-1]  # waits unaccepted until enough of the others have gone
            late.sendall(SECOND)
            while len(crowd) > 500:
                crowd.pop(0).close()
            assert split_answers(read_answers(late, 1))[0][0] == 200
            with concurrent.futures.ThreadPoolExecutor(8) as pool:
                crowd += pool.map(lambda _: strumd.connect(), range(limit))
        for connection in crowd:
            connection.close()
        assert strumd.get("/livez").status_code == 200
    finally:
        for connection in crowd:
            connection.close()
        resource.setrlimit(resource.RLIMIT_NOFILE, (soft, hard))
