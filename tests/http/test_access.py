# SPDX-License-Identifier: GPL-3.0-or-later
"""Bearer tokens: who may ask, and that tokens are told to nobody."""
import pathlib
import signal
import threading

import pytest
import requests

from conftest import CHEAP, PATH
from test_program import run

ONE, TWO = "first-token-0123456789abcdef", "c2Vjb25kLXRva2VuLTAxMjM0NTY3ODk="


@pytest.fixture
def token_file(tmp_path):
    file = tmp_path / "tokens"
    file.write_text(f"# who: the tests\n\n{ONE}\n{TWO}  \r\n")
    return str(file)


def bearer(token, scheme="Bearer"):
    return {"Authorization": f"{scheme} {token}"}


def test_only_known_tokens_are_let_in(start_strumd, token_file):
    strumd = start_strumd("--token-file", token_file)
    for headers in (bearer(ONE), bearer(TWO), bearer(ONE, "bearer"), bearer(" " + TWO)):
        assert strumd.post(CHEAP, headers=headers).status_code == 200
    key = strumd.post(CHEAP, headers=bearer(ONE)).headers["Content-Location"]
    wrong = [{}, bearer(""), bearer(ONE[:-1]), bearer(ONE + "0"), bearer(ONE.upper()), bearer(ONE, "Basic"),
             bearer(ONE, "Bearer:"), bearer("# who: the tests"), {"Authorization": ONE}, {"Authorization": "Bearer"},
             {"X-Authorization": f"Bearer {ONE}"}]
    for headers in wrong:
        # stored or not, read or not: nothing is told
        for answer in (strumd.post(CHEAP, headers=headers), strumd.get(key, headers=headers),
                       strumd.get("/metrics", headers=headers), strumd.get("/", headers=headers),
                       strumd.post([], "/v1/batch", headers=headers), strumd.get("/nothing", headers=headers),
                       strumd.post({**CHEAP, "modes": -1}, headers={**headers, "Accept": "text/event-stream"})):
            assert answer.status_code == 401, headers
            assert answer.headers["WWW-Authenticate"] == 'Bearer realm="strum"'
            assert answer.headers["Content-Type"] == "application/problem+json"
            assert answer.json()["status"] == 401 and "result" not in answer.text


def test_with_tokens_nothing_is_public(start_strumd, token_file):
    strumd = start_strumd("--token-file", token_file)
    for _ in range(2):  # solved, then stored
        answer = strumd.post(CHEAP, headers=bearer(ONE))
        assert answer.headers["Cache-Control"] == "private, no-cache"
    for headers in (bearer(ONE), {**bearer(ONE), "If-None-Match": answer.headers["ETag"]}):
        kept = strumd.get(answer.headers["Content-Location"], headers=headers)
        assert kept.headers["Cache-Control"] == "private, max-age=31536000, immutable"


def test_probes_and_preflights_need_none(start_strumd, token_file):
    strumd = start_strumd("--token-file", token_file, "--cors-origins", "https://a.example")
    assert strumd.get("/livez").status_code == strumd.get("/readyz").status_code == 200
    asked = {"Origin": "https://a.example", "Access-Control-Request-Method": "POST",
             "Access-Control-Request-Headers": "authorization"}
    before = strumd.request("OPTIONS", headers=asked)
    assert before.status_code == 204
    assert "Authorization" in before.headers["Access-Control-Allow-Headers"]
    # a page of that origin may read why it was refused; one of another may not
    assert strumd.post(CHEAP, headers=asked).headers["Access-Control-Allow-Origin"] == "https://a.example"
    assert "Access-Control-Allow-Origin" not in strumd.post(CHEAP, headers={"Origin": "https://b.example"}).headers


def test_no_token_is_logged(start_strumd, token_file):
    strumd = start_strumd("--token-file", token_file, "--log-requests", "all")
    for token in (ONE, "not-a-known-token-at-all"):
        strumd.post(CHEAP, headers=bearer(token))
        strumd.get(f"/nothing?token={token}", headers=bearer(token))
    strumd.end()
    strumd.wait_log("stopped")
    assert len([line for line in strumd.log if line["event"] == "request"]) == 4
    assert ONE not in str(strumd.log) and "not-a-known-token" not in str(strumd.log)


def test_with_tokens_other_machines_are_let_in(start_strumd, token_file):
    strumd = start_strumd("--listen", "0.0.0.0:0", "--token-file", token_file)
    url = f"http://127.0.0.1:{strumd.port}"
    assert requests.post(url + PATH, json=CHEAP, headers=bearer(TWO)).status_code == 200
    assert requests.post(url + PATH, json=CHEAP).status_code == 401


@pytest.mark.parametrize("text, word", [
    (None, "No such file"), ("", "no token"), ("# nothing\n", "no token"), ("short\n", ":1: a token has at least 16"),
    (f"{ONE}\n\nshort\n", ":3: "), (f"{ONE}\n" * 1025, ":1025: more than")])
def test_files_that_are_no_good(tmp_path, text, word):
    file = tmp_path / "tokens"
    if text is not None:
        file.write_text(text)
    refused = run("--listen", "127.0.0.1:0", "--token-file", str(file))
    assert refused.returncode == 1 and word in refused.stderr and ONE not in refused.stderr


def test_a_hangup_reads_the_tokens_again(start_strumd, token_file):
    """While others ask with a token that stays."""
    strumd = start_strumd("--token-file", token_file)
    file = pathlib.Path(token_file)
    three, kept = "third-token-0123456789abcdef", []
    ended = threading.Event()

    def press():
        while not ended.is_set():
            kept.append(strumd.post(CHEAP, headers=bearer(TWO)).status_code)
    client = threading.Thread(target=press)
    client.start()
    try:
        for text, known in ((f"{TWO}\n{three}\n", (False, True)), ("short\n", (False, True)), (f"{ONE}\n{TWO}\n", (True, False))):
            before = len([line for line in strumd.log if line["event"] == "reload"])
            file.write_text(text)
            strumd.process.send_signal(signal.SIGHUP)
            while len([line for line in strumd.log if line["event"] == "reload"]) == before:
                assert strumd.process.poll() is None
            assert tuple(strumd.post(CHEAP, headers=bearer(token)).status_code == 200 for token in (ONE, three)) == known
    finally:
        ended.set()
        client.join()
    assert set(kept) == {200}
    assert [line["level"] for line in strumd.log if line["event"] == "reload"] == ["info", "error", "info"]
    assert "short" not in str(strumd.log)


def cookie_of(answer):
    return answer.headers["Set-Cookie"].split(";")[0]


HTML = {"Accept": "text/html,application/xhtml+xml,*/*;q=0.8"}


def test_a_browser_logs_in(start_strumd, token_file):
    strumd = start_strumd("--token-file", token_file)
    for path in ("/", "/docs", PATH + "?sag_parameter=0.9"):
        asked = strumd.get(path, headers=HTML)
        assert asked.status_code == 401 and asked.headers["Content-Type"].startswith("text/html")
        assert 'action="/login"' in asked.text and "form-action 'self'" in asked.headers["Content-Security-Policy"]
    refused = strumd.request("POST", "/login", data={"token": ONE + "0"}, allow_redirects=False)
    assert refused.status_code == 401 and "not known" in refused.text and "Set-Cookie" not in refused.headers
    assert ONE not in refused.text
    for token in (ONE, TWO):  # the second has a "+" or "=" to be encoded
        done = strumd.request("POST", "/login", data={"token": token, "to": "/"}, allow_redirects=False,
                              headers={"Origin": strumd.url, "Sec-Fetch-Site": "same-origin"})
        assert (done.status_code, done.headers["Location"], done.headers["Cache-Control"]) == (303, "/", "no-store")
        for word in ("HttpOnly", "SameSite=Strict", "Path=/"):
            assert word in done.headers["Set-Cookie"].split("; ")
        assert "Secure" not in done.headers["Set-Cookie"] and token not in done.headers["Set-Cookie"]
        cookie = {"Cookie": "a=b; " + cookie_of(done) + "; c=d"}
        answer = strumd.post(CHEAP, headers=cookie)
        assert answer.status_code == 200 and answer.headers["Cache-Control"] == "private, no-cache"
        assert strumd.get("/", headers={**HTML, **cookie}).status_code in (200, 404)  # 404: built without its pages
        # a token that is wrong is not mended by a cookie
        assert strumd.post(CHEAP, headers={**cookie, **bearer("wrong")}).status_code == 401
    left = strumd.request("POST", "/login", data={}, allow_redirects=False,
                          headers={"Content-Type": "application/x-www-form-urlencoded"})
    assert left.status_code == 303 and "strum=;" in left.headers["Set-Cookie"] and "Max-Age=0" in left.headers["Set-Cookie"]


def test_only_cookies_of_known_tokens_are_let_in(start_strumd, token_file):
    strumd, other = start_strumd("--token-file", token_file), start_strumd("--token-file", token_file)
    good = cookie_of(strumd.request("POST", "/login", data={"token": ONE}, allow_redirects=False))
    assert other.post(CHEAP, headers={"Cookie": good}).status_code == 200  # any replica knows it
    value = good.removeprefix("strum=")
    for bad in ("strum=", f"strum={ONE}", f"strum={value[:-1]}", f"strum={value}0", f"strum={value.upper()}", f"Strum={value}",
                f"xstrum={value}", f"a=strum={value}", value, "strum=" + 64 * "0"):
        assert strumd.post(CHEAP, headers={"Cookie": bad}).status_code == 401, bad
    assert strumd.post(CHEAP, headers=bearer(value)).status_code == 401
    # a token that goes takes its cookie along
    pathlib.Path(token_file).write_text(f"{TWO}\n")
    strumd.process.send_signal(signal.SIGHUP)
    strumd.wait_log("reload")
    assert strumd.post(CHEAP, headers={"Cookie": good}).status_code == 401


def test_the_login_is_for_our_own_form_only(start_strumd, token_file):
    strumd = start_strumd("--token-file", token_file)
    for headers in ({"Origin": "https://evil.example"}, {"Origin": "null"}, {"Sec-Fetch-Site": "cross-site"}, {"Host": "evil.example"}):
        assert strumd.request("POST", "/login", data={"token": ONE}, headers=headers, allow_redirects=False).status_code == 403
    assert strumd.post({"token": ONE}, "/login", allow_redirects=False).status_code == 415
    hostile = ("//evil.example", "https://evil.example/", '"><script>', "/nothing", "/docs/../x")
    for to in hostile:
        done = strumd.request("POST", "/login", data={"token": ONE, "to": to}, allow_redirects=False)
        assert done.headers["Location"] == "/", to
        again = strumd.request("POST", "/login", data={"token": "wrong", "to": to})
        assert to not in again.text
    assert '"><x>' not in strumd.get('/docs/"><x>', headers=HTML).text
    # behind a proxy that speaks TLS the cookie goes by TLS alone
    tls = strumd.request("POST", "/login", data={"token": ONE}, headers={"Origin": f"https://{strumd.address}"}, allow_redirects=False)
    assert tls.status_code == 303 and "Secure" in tls.headers["Set-Cookie"].split("; ")


def test_without_tokens_there_is_nothing_to_log_in_to(strumd):
    assert strumd.get("/login", allow_redirects=False).headers["Location"] == "/"
    assert strumd.request("POST", "/login", data={"token": ONE}, allow_redirects=False).status_code == 303
