# SPDX-License-Identifier: GPL-3.0-or-later
"""deploy/: its files agree with the program that they run."""
import json
import os
import pathlib
import re
import subprocess

import pytest
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
DEPLOY = ROOT / "deploy"
PROGRAM = os.environ.get("STRUMD", str(ROOT / "build/src/strumd"))


def check_settings(environment=None, *flags):
    # --check-config would also open files that only the machine has that they are for.
    done = subprocess.run([PROGRAM, "--print-config", *flags], env=environment or {}, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def units(folder):
    """The units, with a program that is there."""
    for unit in ("strumd.service", "strumd.socket"):
        text = (DEPLOY / "systemd" / unit).read_text().replace("/usr/local/bin/strumd", PROGRAM)
        (folder / unit).write_text(text)
    return folder / "strumd.service", folder / "strumd.socket"


def exposure(service):
    rated = subprocess.run(["systemd-analyze", "security", "--offline=true", "--no-pager", service], capture_output=True,
                           text=True)
    return float(re.search(r"Overall exposure level for \S+: ([\d.]+)", rated.stdout).group(1))


def test_units_are_well_formed(tmp_path):
    checked = subprocess.run(["systemd-analyze", "verify", "--man=no", *units(tmp_path)], capture_output=True, text=True)
    assert (checked.returncode, checked.stderr) == (0, "")


def test_a_fault_in_a_unit_is_noticed(tmp_path):
    service, _ = units(tmp_path)
    service.write_text(service.read_text().replace("ProtectHome=yes", "ProtectHoem=yes"))
    checked = subprocess.run(["systemd-analyze", "verify", "--man=no", service], capture_output=True, text=True)
    assert "ProtectHoem" in checked.stderr


def test_the_service_is_confined(tmp_path):
    service, _ = units(tmp_path)
    assert exposure(service) <= 0.5
    loosened = tmp_path / "loosened.service"
    drop_ins = sorted((DEPLOY / "systemd/strumd.service.d").glob("*.conf"))
    assert drop_ins
    loosened.write_text(service.read_text() + "".join(drop_in.read_text() for drop_in in drop_ins))
    assert exposure(loosened) <= 1.1


def test_the_service_waits_for_the_drain():
    text = (DEPLOY / "systemd/strumd.service").read_text()
    printed = subprocess.check_output([PROGRAM, "--print-config"], env={}, text=True)
    drain = float(re.search(r"drain_timeout_s = ([\d.]+)", printed).group(1))
    assert float(re.search(r"TimeoutStopSec=(\d+)", text).group(1)) >= drain + 5
    pod = load("deployment.yaml")["spec"]["template"]["spec"]
    rest = int(pod["containers"][0]["lifecycle"]["preStop"]["exec"]["command"][1])
    assert pod["terminationGracePeriodSeconds"] >= drain + rest + 5


def test_settings_are_known():
    check_settings(None, "--config", str(DEPLOY / "systemd/strumd.conf"))
    for drop_in in (DEPLOY / "systemd/strumd.service.d").glob("*.conf"):
        check_settings(dict(re.findall(r"^(?:# )?Environment=(STRUM_\w+)=(\S+)", drop_in.read_text(), re.M)))
    container = load("deployment.yaml")["spec"]["template"]["spec"]["containers"][0]
    check_settings({entry["name"]: entry["value"] for entry in container["env"]})
    dockerfile = (DEPLOY / "container/Dockerfile").read_text()
    check_settings(dict(re.findall(r"(STRUM_[A-Z_]+)=(\S+)", re.search(r"^ENV (.*)$", dockerfile, re.M).group(1))))


def packages_of(program):
    """The Debian packages of the libraries that the program names."""
    needed = re.findall(r"NEEDED.*\[(lib.*)\]", subprocess.check_output(["readelf", "-d", program], text=True))
    paths = dict(re.findall(r"(\S+) => (\S+)", subprocess.check_output(["ldd", program], text=True)))
    for library in needed:
        path = pathlib.Path(paths[library])
        for candidate in (path.resolve(), path, pathlib.Path("/usr") / path.relative_to("/")):
            owner = subprocess.run(["dpkg-query", "-S", candidate], capture_output=True, text=True)
            if owner.returncode == 0:
                yield owner.stdout.split(":")[0]
                break
        else:
            raise AssertionError(f"no package has {path}")


def test_the_image_has_every_library():
    text = (DEPLOY / "container/Dockerfile").read_text()
    second = text.split("\nFROM ${BASE}\n")[1]
    assert set(packages_of(PROGRAM)) - {"libc6"} <= set(re.findall(r"\blib[\w.+-]+", second))


def load(name):
    return yaml.safe_load((DEPLOY / "kubernetes" / name).read_text())


def test_cluster_files_agree():
    kustomization = load("kustomization.yaml")
    assert sorted(kustomization["resources"]) == sorted(
        file.name for file in (DEPLOY / "kubernetes").iterdir() if file.name != "kustomization.yaml")
    objects = [load(name) for name in kustomization["resources"]]
    assert all({"apiVersion", "kind", "metadata"} <= set(document) for document in objects)
    (labels,) = (entry["pairs"] for entry in kustomization["labels"])
    for name, path in (("disruption.yaml", "selector"), ("network.yaml", "podSelector")):
        assert load(name)["spec"][path]["matchLabels"] == labels
    container = load("deployment.yaml")["spec"]["template"]["spec"]["containers"][0]
    ports = {port["name"] for port in container["ports"]}
    assert {port["targetPort"] for port in load("service.yaml")["spec"]["ports"]} <= ports
    assert container["image"] == kustomization["images"][0]["name"]
    metric = load("autoscaling.yaml")["spec"]["metrics"][0]["pods"]["metric"]["name"]
    assert f'"{metric.removeprefix("strum_")}"' in (ROOT / "src/http/service/metrics.c").read_text()


@pytest.mark.parametrize("probe", ["startupProbe", "livenessProbe", "readinessProbe"])
def test_probes_are_routes(probe):
    container = load("deployment.yaml")["spec"]["template"]["spec"]["containers"][0]
    assert f'{{.path = "{container[probe]["httpGet"]["path"]}",' in (ROOT / "src/http/api/api.c").read_text()


def test_the_proxy_hashes_as_the_ingress_does():
    hashed = re.search(r"hash (\S+) consistent", (DEPLOY / "nginx/strum.conf").read_text()).group(1)
    assert load("ingress.yaml")["metadata"]["annotations"]["nginx.ingress.kubernetes.io/upstream-hash-by"] == hashed


def test_the_dashboard_shows_metrics_that_there_are():
    dashboard = json.loads((DEPLOY / "grafana/strum.json").read_text())
    expressions = [target["expr"] for panel in dashboard["panels"] for target in panel["targets"]]
    source = (ROOT / "src/http/service/metrics.c").read_text()
    there = set(re.findall(r'"([a-z_]+)", "(?:counter|gauge)"', source)) | {"requests_total", "build_info"}
    there |= {"request_seconds_bucket", "solve_seconds_total"}
    shown = {name for expression in expressions for name in re.findall(r"strum_([a-z_]+)", expression)}
    assert shown and shown <= there
    assert len({panel["id"] for panel in dashboard["panels"]}) == len(dashboard["panels"])


DOCKER = """#!/bin/bash
echo "$*" >>"$0.log"
case "$*" in
*inspect*debian:12-slim) echo debian@sha256:%s ;;
*inspect*) echo registry.example/strum@sha256:%s ;;
esac
""" % (64 * "a", 64 * "b")


def test_the_image_is_named_by_digest(tmp_path):
    docker, file = tmp_path / "docker", tmp_path / "kustomization.yaml"
    docker.write_text(DOCKER)
    docker.chmod(0o755)
    file.write_text((DEPLOY / "kubernetes/kustomization.yaml").read_text())
    for _ in range(2):  # a digest is replaced as a tag is
        subprocess.run([DEPLOY / "image", "registry.example/strum:0.1.0", file], env={**os.environ, "DOCKER": str(docker)}, check=True)
    (image,) = yaml.safe_load(file.read_text())["images"]
    assert image == {"name": "strum", "newName": "registry.example/strum", "digest": "sha256:" + 64 * "b"}
    build = next(line for line in (tmp_path / "docker.log").read_text().splitlines() if line.startswith("build "))
    assert f"--build-arg BASE=debian@sha256:{64 * 'a'} " in build
    # what the argument is for: both stages stand on it, and nothing else
    text = (DEPLOY / "container/Dockerfile").read_text()
    assert re.findall(r"^FROM (\S+)", text, re.M) == ["${BASE}", "${BASE}"] and text.index("ARG BASE=") < text.index("FROM ")
