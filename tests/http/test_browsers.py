# SPDX-License-Identifier: GPL-3.0-or-later
"""A browser on this machine may be told to ask by any page it shows: who may, and who may not."""
import pytest

from conftest import CHEAP, PATH, read_answers, split_answers

FOREIGN = "https://evil.example"


def ask(daemon, host, method=b"GET", path=PATH.encode() + b"?sag_parameter=0.9", extra=b""):
    with daemon.connect() as connection:
        connection.sendall(method + b" " + path + b" HTTP/1.1\r\nHost: " + host.encode() + b"\r\n" + extra + b"\r\n")
        return split_answers(read_answers(connection, 1))[0]


OURS = ["localhost", "localhost:8080", "LocalHost", "127.0.0.1", "127.0.0.1:1", "127.1.2.3:80", "[::1]", "[::1]:8080"]
OTHERS = ["evil.example", "evil.example:8080", "localhost.evil.example", "127.0.0.1.evil.example", "10.0.0.1", "0.0.0.0",
          "localhost:8080@evil.example", "[::2]", "[::1", "localhost:x", "evil.example:127.0.0.1"]


@pytest.mark.parametrize("host", OURS)
def test_names_of_this_machine(strumd, host):
    assert ask(strumd, host)[0] == 200


@pytest.mark.parametrize("host", OTHERS)
def test_other_names_are_refused_on_loopback(strumd, host):
    """A site may have its own name resolved to 127.0.0.1, and then is of one origin with us."""
    status, headers, body = ask(strumd, host)
    assert status == 403 and headers["content-type"] == "application/problem+json"
    assert b"allowed_hosts" in body
    assert ask(strumd, host, path=b"/")[0] == 403
    assert ask(strumd, host, path=b"/livez")[0] == 200  # probes by any name


def test_a_url_as_the_target_is_where_it_says(strumd):
    """What Host says then does not count (RFC 9112 3.2.2): neither to let in nor to keep out."""
    query = PATH.encode() + b"?sag_parameter=0.9"
    for scheme in (b"http", b"https"):
        for host in OURS:
            status, _, body = ask(strumd, "evil.example", path=scheme + b"://" + host.encode() + query)
            assert status == 200 and body == ask(strumd, "localhost", path=query)[2]
        for host in set(OTHERS) - {"localhost:8080@evil.example"}:
            assert ask(strumd, "localhost", path=scheme + b"://" + host.encode() + query)[0] == 403, host
    assert ask(strumd, "localhost", path=b"http://localhost:8080@evil.example" + query)[0] == 400
    own = b"Origin: http://evil.example\r\n"
    assert ask(strumd, "evil.example", path=b"http://localhost" + query, extra=own)[0] == 403


def test_a_url_as_the_target_and_the_names_allowed(start_strumd):
    strumd = start_strumd("--allowed-hosts", "cables.example")
    for host, status in ((b"cables.example", 200), (b"cables.example:443", 200), (b"evil.example", 403)):
        assert ask(strumd, "cables.example", path=b"http://" + host + PATH.encode() + b"?sag_parameter=0.9")[0] == status
        assert ask(strumd, "cables.example", b"OPTIONS", path=b"http://" + host)[0] == (204 if status == 200 else 403)


def test_names_that_are_allowed(start_strumd):
    strumd = start_strumd("--allowed-hosts", "cables.example, other.example")
    for host, status in (("cables.example", 200), ("Cables.Example:443", 200), ("other.example:1", 200), ("localhost", 200),
                         ("x.cables.example", 403), ("cables.example.evil", 403)):
        assert ask(strumd, host)[0] == status, host
    assert ask(start_strumd("--allowed-hosts", "*"), "anything.example")[0] == 200


def test_elsewhere_any_name_is_taken_unless_some_are_named(start_strumd):
    assert ask(start_strumd("--listen", "0.0.0.0:0", "--allow-non-loopback"), "anything.example")[0] == 200
    named = start_strumd("--listen", "0.0.0.0:0", "--allow-non-loopback", "--allowed-hosts", "cables.example")
    assert ask(named, "cables.example")[0] == 200 and ask(named, "anything.example")[0] == 403


def test_foreign_pages_are_refused(strumd):
    own = f"http://{strumd.address}"
    for origin, status in ((own, 200), (f"https://{strumd.address}", 200), (FOREIGN, 403), ("null", 403), ("http://127.0.0.1:1", 403),
                           ("http://localhost", 403), ("", 403), (own + ".evil.example", 403)):
        for answer in (strumd.post(CHEAP, headers={"Origin": origin}), strumd.get(PATH + "?sag_parameter=0.9", headers={"Origin": origin}),
                       strumd.request("QUERY", json=CHEAP, headers={"Origin": origin})):
            assert answer.status_code == status, origin
            assert "Access-Control-Allow-Origin" not in answer.headers
    batch = strumd.post([{"path": PATH, "request": CHEAP}], "/v1/batch", headers={"Origin": FOREIGN})
    assert batch.status_code == 403 and batch.headers["Content-Type"] == "application/problem+json"


def test_ports_that_go_without_saying(strumd):
    assert ask(strumd, "localhost", extra=b"Origin: http://localhost:80\r\n")[0] == 200
    assert ask(strumd, "localhost:443", extra=b"Origin: https://localhost\r\n")[0] == 200
    assert ask(strumd, "localhost", extra=b"Origin: http://localhost:8000\r\n")[0] == 403


def test_what_another_site_has_a_browser_fetch_is_refused(strumd):
    """An image or a script needs no Origin, and no answer that can be read: the question alone would be work."""
    cross = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "no-cors", "Sec-Fetch-Dest": "image"}
    assert strumd.get(PATH + "?sag_parameter=0.9", headers=cross).status_code == 403
    assert strumd.get("/metrics", headers=cross).status_code == 403
    assert strumd.get("/version", headers={"Sec-Fetch-Site": "cross-site"}).status_code == 403
    for site in ("same-origin", "none"):
        assert strumd.get(PATH + "?sag_parameter=0.9", headers={**cross, "Sec-Fetch-Site": site}).status_code == 200
    # a link may be followed to what is there already, but not to a question
    link = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "navigate", "Sec-Fetch-Dest": "document"}
    assert strumd.get("/version", headers=link).status_code == 200
    assert strumd.get("/version", headers={**link, "Sec-Fetch-Dest": "iframe"}).status_code == 403
    assert strumd.get(PATH + "?sag_parameter=0.9", headers=link).status_code == 403


def test_origins_that_are_allowed(start_strumd):
    cross = {"Sec-Fetch-Site": "cross-site", "Sec-Fetch-Mode": "cors"}
    strumd = start_strumd("--cors-origins", "https://a.example")
    assert strumd.post(CHEAP, headers={**cross, "Origin": "https://a.example"}).status_code == 200
    assert strumd.post(CHEAP, headers={**cross, "Origin": FOREIGN}).status_code == 403
    assert start_strumd("--cors-origins", "*").post(CHEAP, headers={**cross, "Origin": FOREIGN}).status_code == 200
