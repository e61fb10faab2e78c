# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of the dashboard: what they are, how they are sent. What they do is for tests/browser."""
import gzip
import hashlib
import html
import json
import re
import subprocess
import sys

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


ADDRESS = "http://127.0.0.1:8080"
RUNNERS = {"curl": ["bash", "-euo", "pipefail", "-c"], "get": ["bash", "-c"], "python": [sys.executable, "-c"],
           "javascript": ["node", "--input-type=module", "-e"]}


def snippets(text):
    """kind -> lines to copy of a page."""
    found = re.findall(r'<code class="asks (\w+)">(.*?)</code>', text, re.S)
    assert len(dict(found)) == len(found)
    return {kind: html.unescape(lines) for kind, lines in found}


def run(kind, lines, strumd, folder=None):
    """What the lines print, asked of this daemon as the page's script has it."""
    assert ADDRESS in lines
    done = subprocess.run([*RUNNERS[kind], lines.replace(ADDRESS, strumd.url)], capture_output=True, timeout=300, text=True, cwd=folder)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_the_lines_of_the_batch_page_run(strumd):
    lines = snippets(strumd.get("/docs/batch").text)
    printed = {kind: [json.loads(line) for line in run(kind, lines[kind], strumd).splitlines()] for kind in ("curl", "python", "javascript")}
    assert printed["curl"] == printed["python"] == printed["javascript"]
    assert [line["id"] for line in printed["curl"]] == ["long", "short"]
    for line in printed["curl"]:
        whole = strumd.get(f"/v1/results/{line['key']}").json()
        assert line["fields"] == {"/result/in_plane/0/frequency_Hz": whole["result"]["in_plane"][0]["frequency_Hz"]}


def test_the_lines_of_the_results_page_run(strumd, tmp_path):
    lines = snippets(strumd.get("/docs/results").text)
    key = run("python", lines["python"], strumd).split()
    assert key[:2] == ["200", "304"] and re.fullmatch("[0-9a-f]{64}", key[2])
    assert run("javascript", lines["javascript"], strumd).split() == ["200", "true"]
    assert f"again at /v1/results/{key[2]}" in run("curl", lines["curl"], strumd, tmp_path)


def test_the_address_in_the_lines_is_that_of_the_script(strumd):
    assert f"'{ADDRESS}'" in strumd.get("/assets/address.js").text


@pytest.mark.parametrize("stiffness", ["1e8", "1e6"])
def test_the_table_of_other_programs_has_our_numbers(strumd, stiffness):
    row, = [line for line in (ROOT / "doc/other_programs.md").read_text(encoding="utf-8").splitlines() if line.startswith(f"| strum, {stiffness} N")]
    told = [float(number) for number in re.findall(r"\d+\.\d+", row)]
    request = {"span_m": 100, "unstretched_length_m": 110, "mass_kg_per_m": 2, "axial_stiffness_N": float(stiffness), "modes": 2}
    result = strumd.post(request).json()["result"]
    live = [result["out_of_plane"][0]["frequency_Hz"], *(mode["frequency_Hz"] for mode in result["in_plane"]),
            result["geometry"]["horizontal_tension_N"], result["geometry"]["tension_1_N"]]
    assert told == pytest.approx(live, rel=4e-6) and len(told) == 5


def test_pages_of_the_docs_folder_are_served(strumd):
    for name, wanted in (("other-programs", ["MoorPy", "MoorDyn", "slenderpy", "OrcaFlex", "SHEAR7", "CalculiX"]), ("clients", ["orval"])):
        text = strumd.get(f"/docs/{name}").text
        assert f'href="/docs/{name}"' in strumd.get("/docs").text
        for word in wanted:
            assert re.search(f'<h2 id="[^"]*">{word}' if name == "other-programs" else word, text), word
        source = (ROOT / f"doc/{name.replace('-', '_')}.md").read_text(encoding="utf-8")
        tables = source.split("\n| ---")
        assert text.count("<table") == len(tables) - 1 and "| ---" not in text and "**" not in text and "`" not in text
        assert text.count("<li>") == sum(line.startswith("- ") for line in source.splitlines())


PAGES = [f"/docs/{path[4:].replace('/', '-')}" for path, item in CONTRACT["paths"].items() if "x-query" in item]


@pytest.mark.parametrize("path", PAGES)
def test_the_worked_example_of_a_page_runs(strumd, path):
    """The curl line as it stands gives the answer that stands below it; test_openapi.py holds both against values from elsewhere."""
    text = strumd.get(path).text
    lines = snippets(text)
    assert set(lines) >= {"curl", "python", "javascript"}
    # where an example has nested fields only a body can hold it
    assert "get" not in lines or "get" in CONTRACT["paths"][f"/v1/{path[6:].replace('-', '/', 1)}"]
    live = json.loads(run("curl", lines["curl"], strumd))
    assert "get" not in lines or json.loads(run("get", lines["get"], strumd)) == live
    for kind in ("python", "javascript"):
        assert json.loads(run(kind, lines[kind], strumd)) == live["result"]
    shown = json.loads(html.unescape(re.search(r"The whole answer</summary>\s*<pre[^>]*><code>(.*?)</code>", text, re.S)[1]))
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
    assert 'href="/docs/batch"' in index and 'href="/docs/results"' in index
