# SPDX-License-Identifier: GPL-3.0-or-later
"""Equal keys mean equal bytes, whatever processor the daemon runs on.

OpenBLAS chooses its code by the core type, glibc by the instructions that it finds: variables of theirs let one machine
behave as several.
"""
import itertools
import json
import pathlib

import pytest

from conftest import ROOT, Strumd

FLAGS = set(next((line.split(":")[1].split() for line in pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
                  if line.startswith("flags")), []))
# Each with what a processor must have to run it.
MACHINES = {
    "as it is": ({}, set()),
    "Prescott": ({"OPENBLAS_CORETYPE": "Prescott"}, {"pni"}),
    "Nehalem": ({"OPENBLAS_CORETYPE": "Nehalem"}, {"sse4_2"}),
    "Sandybridge": ({"OPENBLAS_CORETYPE": "Sandybridge"}, {"avx"}),
    "Haswell": ({"OPENBLAS_CORETYPE": "Haswell"}, {"avx2", "fma"}),
    "no fused multiply-add": ({"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"}, {"fma"}),
}
FILES = ("catenary_in_plane", "catenary_elastic", "catenary_refused", "forced_tension", "inclined_full", "inclined_refused",
         "taut_damped", "taut_refused")


def questions():
    for name in FILES:
        table = json.loads((ROOT / f"tests/cases/{name}.json").read_text(encoding="utf-8"))
        for case in [case for case in table["cases"] if "request" in case][:8]:
            yield table["endpoint"], case["request"]


def test_equal_keys_mean_equal_bytes_on_every_machine():
    if not {"pni", "avx"} <= FLAGS:
        pytest.skip("this processor cannot play others")
    answers, numerics = {}, {}
    for name, (environment, needs) in MACHINES.items():
        if not needs <= FLAGS:
            continue
        daemon = Strumd(environment=environment)
        try:
            numerics[name] = daemon.get("/version").json()["numerics"]
            answers[name] = [daemon.post(request, path=path) for path, request in questions()]
        finally:
            daemon.clean_up()
    assert len(set(numerics.values())) >= 3, numerics
    differing = 0
    for (one, first), (other, second) in itertools.combinations(answers.items(), 2):
        for a, b in zip(first, second):
            assert a.status_code == b.status_code, (one, other, a.text, b.text)
            if a.status_code != 200:
                continue
            same_key = a.json()["meta"]["key"] == b.json()["meta"]["key"]
            assert same_key == (numerics[one] == numerics[other])
            if same_key:
                assert a.content == b.content, (one, other)
            differing += {**a.json(), "meta": 0} != {**b.json(), "meta": 0}
    assert differing > 20  # what the digest is for
