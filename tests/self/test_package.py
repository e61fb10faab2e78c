# SPDX-License-Identifier: GPL-3.0-or-later
"""debian/, CITATION.cff and the build agree: names, versions, files."""
import fnmatch
import json
import pathlib
import re
import subprocess

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
DEBIAN = ROOT / "debian"


def text(name):
    return (ROOT / name).read_text(encoding="utf-8")


def stanzas():
    """debian/control: a dictionary for each stanza."""
    found = []
    for stanza in re.split(r"\n\s*\n", text("debian/control").strip()):
        fields = re.findall(r"^([A-Za-z-]+):((?:.*)(?:\n[ \t].*)*)", stanza, re.M)
        assert sum(len(name) + 1 + len(value) + 1 for name, value in fields) == len(stanza) + 1, stanza
        found.append({name: value.strip() for name, value in fields})
    return found


def project():
    head = text("meson.build")
    return (re.search(r"^project\((.*?)\)", head, re.M | re.S).group(1),
            re.search(r"^library_soversion = '(\d+)'", text("src/core/meson.build"), re.M).group(1))


def version():
    return re.search(r"version: '([\d.]+)'", project()[0]).group(1)


def names(field):
    return set(re.findall(r"(?:^|,)\s*([a-z0-9][a-z0-9+.-]+)", field))


def test_versions_agree():
    assert yaml.safe_load(text("CITATION.cff"))["version"] == version()
    assert re.match(r"strum \(([\d.]+)\) ", text("debian/changelog")).group(1) == version()


def test_the_licence_is_one():
    licence = yaml.safe_load(text("CITATION.cff"))["license"]
    assert f"license: '{licence}'" in project()[0]
    assert f"License: {licence}\n" in text("debian/copyright")


def test_the_citation_is_whole():
    citation = yaml.safe_load(text("CITATION.cff"))
    assert citation["cff-version"] == "1.2.0"
    assert {"message", "title", "authors"} <= set(citation)
    reports = {(entry["authors"][0]["family-names"], entry["year"]) for entry in citation["references"]}
    assert reports == {("Gale", 1976), ("Sergev", 1980), ("Grinfogel", 1984), ("Levesque", 1997)}
    assert all({"type", "title", "institution"} <= set(entry) for entry in citation["references"])
    for entry in citation["references"]:
        assert entry["title"] in " ".join(text("README.md").split())


def test_packages_are_named_after_the_soversion():
    source, *packages = stanzas()
    assert source["Source"] == "strum"
    library = f"libstrum{project()[1]}"
    assert [package["Package"] for package in packages] == [library, "libstrum-dev", "strumd"]
    assert f"{library} (= ${{binary:Version}})" in packages[1]["Depends"]
    assert {path.stem for path in DEBIAN.glob("*.install")} == {package["Package"] for package in packages}
    assert library in text("deploy/README.md")


def test_build_dependencies_are_those_of_a_build():
    """deploy/packages, without what every package build has, and what the page, the user or meson needs."""
    wanted = {line for line in text("deploy/packages").splitlines() if line and not line.startswith("#")}
    wanted -= {"build-essential", "ninja-build", "curl", "nodejs", "npm"}
    assert names(stanzas()[0]["Build-Depends"]) - {"debhelper-compat"} == wanted


def test_every_installed_file_is_in_a_package(tmp_path):
    """What meson would install, for a library and a daemon in the folders of a Debian package."""
    subprocess.run(["meson", "setup", tmp_path / "build", ROOT, "-Ddashboard=false", "-Dtests=false",
                    "--prefix=/usr", "--libdir=lib/x86_64-linux-gnu"], check=True, capture_output=True)
    plan = json.loads(subprocess.check_output(["meson", "introspect", "--installed", tmp_path / "build"]))
    files = {path.lstrip("/") for path in plan.values()}
    assert {"usr/include/strum/" + path.name for path in (ROOT / "include/strum").glob("*.h")} <= files
    patterns = [line.split()[0] for path in DEBIAN.glob("*.install") for line in path.read_text().splitlines()]
    for path in files:
        assert any(fnmatch.fnmatch(path, pattern) for pattern in patterns), f"{path} is in no package"
    for pattern in patterns:
        assert (ROOT / pattern).exists() or any(fnmatch.fnmatch(path, pattern) for path in [
            *files, f"usr/lib/x86_64-linux-gnu/libstrum.so.{project()[1]}"]), f"{pattern}: no such file"


def test_units_come_from_deploy():
    """The rules copy them, with the program where a package has it."""
    rules = text("debian/rules")
    copied = re.findall(r"deploy/systemd/[\w.]+", rules)
    assert len(copied) == 3 and all((ROOT / file).is_file() for file in copied)
    assert "/usr/local/bin/strumd" in text("deploy/systemd/strumd.service")
    assert "usr/bin/strumd" in text("debian/strumd.install").split()
    configuration = re.search(r"--config /(\S+)/strumd.conf", text("deploy/systemd/strumd.service")).group(1)
    assert f"deploy/systemd/strumd.conf {configuration}" in text("debian/strumd.install").splitlines()
