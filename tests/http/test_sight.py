# SPDX-License-Identifier: GPL-3.0-or-later
"""What those who run it see: latency and work in /metrics, trace headers, sampled log lines."""
import re

import pytest

from conftest import CHEAP, COSTLY, FORCED, IMPOSSIBLE, PATH

TRACE = "00-4bf92f3577b34da6a3ce929d0e0e4736-00f067aa0ba902b7-01"


def histogram(strumd, route):
    """(bounds and how many were at most so slow, in order; their count; the sum of their seconds)"""
    text = strumd.get("/metrics").text
    buckets = [(float(bound), int(count)) for bound, count in re.findall(
        rf'^strum_request_seconds_bucket{{route="{route}",le="([^"]+)"}} (\d+)$', text, re.M)]
    count, total = (float(re.search(rf'^strum_request_seconds_{name}{{route="{route}"}} (\S+)$', text, re.M).group(1))
                    for name in ("count", "sum"))
    return buckets, count, total


def test_latency_is_counted_by_route(start_strumd):
    strumd = start_strumd("--inline-us", "0")
    assert '"/v1/catenary' not in strumd.get("/metrics").text
    answers = [strumd.post(body) for body in (CHEAP, CHEAP, COSTLY, {"sag_parameter": 3})]
    assert [answer.status_code for answer in answers] == [200, 200, 200, 400]
    buckets, count, total = histogram(strumd, PATH)
    bounds, counts = zip(*buckets)
    assert bounds[0] == 1e-4 and bounds[-2:] == (10, float("inf")) and list(bounds) == sorted(bounds)
    assert list(counts) == sorted(counts) and counts[-1] == count == 4
    # what was solved took at least as long as the endpoint says it took
    solving = sum(float(re.search(r"solve;dur=([\d.]+)", answer.headers["Server-Timing"]).group(1))
                  for answer in (answers[0], answers[2])) / 1000
    assert total >= solving > 0


def test_work_is_counted(start_strumd):
    strumd = start_strumd()
    body = {"sag_parameter": 0.9, "frequency_ratio_min": 0, "frequency_ratio_max": 5, "points": 12, "eta_normal": 0.1,
            "harmonics": [{"multiple": 1, "tangential": 0.01}]}
    assert strumd.post(body, FORCED).status_code == 200
    assert strumd.metric("solve_steps_total") > 0 and strumd.metric("solve_failures_total") == 0
    assert float(re.search(r"^strum_solve_seconds_total (\S+)$", strumd.get("/metrics").text, re.M).group(1)) > 0
    assert strumd.post(IMPOSSIBLE, FORCED).status_code == 422
    assert strumd.metric("solve_failures_total") == 1


def test_a_trace_is_passed_through(start_strumd):
    strumd = start_strumd("--log-requests", "all")
    for _ in range(2):  # solved, and from the store
        assert strumd.post(CHEAP, headers={"traceparent": TRACE}).headers["traceparent"] == TRACE
    assert strumd.post({}, headers={"traceparent": TRACE}).headers["traceparent"] == TRACE
    strumd.end()
    strumd.wait_log("stopped")
    assert [line["traceparent"] for line in strumd.log if line["event"] == "request"] == [TRACE] * 3


@pytest.mark.parametrize("strange", [TRACE[:-1], TRACE + "0", TRACE.upper(), TRACE.replace("-", "_"), "00-x", ""])
def test_a_strange_trace_is_not(start_strumd, strange):
    answer = start_strumd().post(CHEAP, headers={"traceparent": strange})
    assert answer.status_code == 200 and "traceparent" not in answer.headers


def test_what_goes_well_may_be_sampled(start_strumd):
    strumd = start_strumd("--log-requests", "all", "--log-sample", "10")
    for _ in range(30):
        strumd.post(CHEAP)
        strumd.post({"sag_parameter": 3})
    strumd.end()
    strumd.wait_log("stopped")
    statuses = [line["status"] for line in strumd.log if line["event"] == "request"]
    assert statuses.count(200) == 3 and statuses.count(400) == 30
