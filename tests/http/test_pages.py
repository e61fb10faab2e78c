# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of the dashboard: what they are, how they are sent. What they do is for tests/browser."""
import gzip
import hashlib
import html
import json
import re
import subprocess

import pytest
import yaml

from conftest import ROOT
from published import publish

CONTRACT = yaml.safe_load((ROOT / "api/openapi.yaml").read_text(encoding="utf-8"))
OWN = sorted(path for path in (ROOT / "src/dashboard").iterdir() if path.suffix in (".js", ".css", ".svg"))


@pytest.mark.parametrize("path, version", [("/openapi.json", "3.1"), ("/openapi-3.2.json", "3.2")])
def test_the_contract_is_served_as_published(strumd, path, version):
    assert strumd.get(path).json() == publish(CONTRACT, version)


@pytest.mark.parametrize("path", OWN, ids=lambda path: path.name)
def test_files_are_served_as_they_are(strumd, path):
    plain = strumd.get(f"/assets/{path.name}", headers={"Accept-Encoding": "identity"})
    assert plain.status_code == 200 and plain.content == path.read_bytes()
    assert "Content-Encoding" not in plain.headers
    assert plain.headers["ETag"] == f'W/"{hashlib.sha256(plain.content).hexdigest()}"'


def test_compressed_for_those_who_take_it(strumd):
    for accepts, packed in (("gzip", True), ("br, gzip;q=0.5", True), ("gzip;q=0", False), ("br", False)):
        answer = strumd.get("/assets/style.css", headers={"Accept-Encoding": accepts}, stream=True)
        assert (answer.headers.get("Content-Encoding") == "gzip") == packed, accepts
        assert answer.headers["Vary"] == "Accept-Encoding"
        raw = answer.raw.read(decode_content=False)
        assert (gzip.decompress(raw) if packed else raw) == (ROOT / "src/dashboard/style.css").read_bytes()


@pytest.mark.parametrize("path", ["/", "/docs", "/docs/catenary-frequencies", "/openapi.json", "/assets/main.js"])
def test_pages_ask_nobody_else(strumd, path):
    answer = strumd.get(path)
    policy = answer.headers["Content-Security-Policy"]
    assert "default-src 'none'" in policy and "unsafe" not in policy and "http" not in policy
    assert answer.headers["X-Content-Type-Options"] == "nosniff"
    assert not re.search(r"""(?:src|href|action)=["'](?:https?:)?//""", answer.text)
    again = strumd.get(path, headers={"If-None-Match": answer.headers["ETag"]})
    assert again.status_code == 304 and not again.content
    head = strumd.request("HEAD", path)
    assert head.status_code == 200 and not head.content


PAGES = [f"/docs/{path[4:].replace('/', '-')}" for path, item in CONTRACT["paths"].items() if "x-query" in item]


@pytest.mark.parametrize("path", PAGES)
def test_the_worked_example_of_a_page_runs(strumd, path):
    """The curl line as it stands gives the answer that stands below it; test_openapi.py holds both against values from elsewhere."""
    text = strumd.get(path).text
    line = html.unescape(re.search(r'<code class="curl">(.*?)</code>', text, re.S)[1])
    assert line.count("http://127.0.0.1:8080") == 1
    done = subprocess.run(line.replace("http://127.0.0.1:8080", strumd.url), shell=True, check=True, capture_output=True, timeout=300)
    shown = json.loads(html.unescape(re.search(r"The whole answer</summary>\s*<pre[^>]*><code>(.*?)</code>", text, re.S)[1]))
    live = json.loads(done.stdout)
    assert live["request"] == shown["request"] and list(live) == list(shown) and list(live["result"]) == list(shown["result"])
    assert text.count("<tr><th") > 5 and re.search(r'id="theory">Theory</h2><p>.*?<li>', text, re.S)


def test_what_is_not_there(strumd):
    for path in ("/assets/", "/assets/../main.c", "/assets/nope.js", "/docs/nope", "/index.html", "//"):
        answer = strumd.get(path)
        assert answer.status_code == 404, path
        assert answer.headers["Content-Type"] == "application/problem+json"
    assert strumd.request("POST", "/", json={}).status_code == 405


def test_each_endpoint_has_its_reference(strumd):
    index = strumd.get("/docs").text
    for path, item in CONTRACT["paths"].items():
        if "x-query" not in item:
            continue
        page = f"/docs/{path[4:].replace('/', '-')}"
        assert f'href="{page}"' in index
        text = strumd.get(page).text
        schema = item["post"]["requestBody"]["content"]["application/json"]["schema"]["$ref"].split("/")[-1]
        for name in CONTRACT["components"]["schemas"][schema]["properties"]:
            assert f"<code>{name}</code>" in text, (page, name)
        assert f"{path}</code>" in text and "curl -s --json" in text
