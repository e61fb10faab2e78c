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
