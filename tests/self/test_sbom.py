# SPDX-License-Identifier: GPL-3.0-or-later
"""deploy/sbom: all that strumd is loaded with is in its bill of materials, under the version that is installed."""
import hashlib
import json
import os
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("STRUMD", str(ROOT / "build/src/strumd"))


def test_the_bill_names_what_is_loaded():
    text = subprocess.check_output([ROOT / "deploy/sbom", PROGRAM])
    assert subprocess.check_output([ROOT / "deploy/sbom", PROGRAM]) == text
    bill = json.loads(text)
    assert (bill["bomFormat"], bill["specVersion"]) == ("CycloneDX", "1.5")
    assert re.fullmatch(r"urn:uuid:[0-9a-f]{8}-([0-9a-f]{4}-){3}[0-9a-f]{12}", bill["serialNumber"])
    root = bill["metadata"]["component"]
    assert root["hashes"][0]["content"] == hashlib.sha256(pathlib.Path(PROGRAM).read_bytes()).hexdigest()
    assert subprocess.check_output([PROGRAM, "--version"], text=True).split()[1] == root["version"]

    libraries = [component for component in bill["components"] if component["purl"].startswith("pkg:deb/")]
    files = {file["name"]: file["hashes"][0]["content"] for library in libraries for file in library["components"]}
    loaded = re.findall(r"(/\S+) \(0x", subprocess.check_output(["ldd", PROGRAM], text=True))
    assert len(loaded) > 10
    assert {str(pathlib.Path(path).resolve()) for path in loaded} == set(files)
    for path, digest in files.items():
        assert hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest() == digest
    for library in libraries:
        version = subprocess.check_output(["dpkg-query", "-W", "-f", "${Version}\n", library["name"]], text=True).split()[0]
        assert library["version"] == version
    scripts = [component["name"] for component in bill["components"] if component["purl"].startswith("pkg:npm/")]
    assert scripts == (["uplot"] if b"/assets/uPlot.js" in pathlib.Path(PROGRAM).read_bytes() else [])

    references = {component["bom-ref"] for component in [root, *bill["components"]]}
    assert len(references) == len(bill["components"]) + 1
    assert {entry["ref"] for entry in bill["dependencies"]} <= references
    assert all(set(entry["dependsOn"]) <= references for entry in bill["dependencies"])
    (ours,) = (entry["dependsOn"] for entry in bill["dependencies"] if entry["ref"] == root["bom-ref"])
    assert any("libmicrohttpd12@" in needed for needed in ours)
