# SPDX-License-Identifier: GPL-3.0-or-later
"""Equal keys mean equal bytes, whatever processor the daemon runs on.

OpenBLAS chooses its code by the core type, glibc by the instructions that it finds: variables of theirs let one machine
behave as several.
"""
import concurrent.futures
import itertools
import json
import pathlib

import pytest

from conftest import PATH, PROGRAM, ROOT, Strumd
from test_batch import SANITIZED

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


@pytest.mark.skipif(SANITIZED, reason="sanitizers take address space without end")
@pytest.mark.parametrize("megabytes", [300, 400, 500, 700])
def test_little_address_space_ends_no_daemon(tmp_path, megabytes):
    """Each thread that multiplies wants a buffer of 128 MB; those that get none share one."""
    program = tmp_path / "strumd"
    program.write_text(f'#!/bin/sh\nulimit -v {megabytes * 1000}\nexec "{PROGRAM}" "$@"\n', encoding="utf-8")
    program.chmod(0o755)
    daemon = Strumd("--workers", "4", "--inline-us", "0", program=str(program))
    try:
        damped = [{"rise_to_span": 0.1, "sag_parameter": 0.5 + 0.01 * k, "modes": 20, "eta_normal": 0.3} for k in range(8)]
        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            codes = [r.status_code for r in pool.map(lambda request: daemon.post(request, path=PATH), damped)]
        assert set(codes) <= {200, 503}, codes  # 503: out of memory, and said so
        assert megabytes < 500 or 200 in codes, codes
        assert daemon.get("/livez").status_code == 200
    finally:
        daemon.clean_up()
