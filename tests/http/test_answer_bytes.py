# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers have a largest size: what asks for more is refused, before any work where that is known."""
import json

import pytest

from conftest import PATH

FORCED, INCLINED = "/v1/forced/tension", "/v1/inclined/modes"
LARGE = [
    (PATH, {"chi_1": -0.5, "chi_2": 1, "modes": 200, "shape_points": 1000}, "/shape_points"),
    (PATH, {"span_m": 100, "length_m": 110, "modes": 150, "shape_points": 900, "eta_normal": 0.1}, "/shape_points"),
    (INCLINED, {"epsilon": 0.18, "inclination_deg": 20, "lambda_squared": 38, "modes": 200, "shape_points": 1000},
     "/shape_points"),
    ("/v1/taut/modes", {"tension_N": 100, "components": [{"type": "cable", "length_m": 10, "mass_kg_per_m": 1}],
                        "modes": 200, "shape_points": 2000}, "/shape_points"),
    ("/v1/taut/modes", {"tension_N": 100, "components": [{"type": "cable", "length_m": 10, "mass_kg_per_m": 1,
                                                          "drag_N_s_per_m2": 0.1}],
                        "modes": 200, "shape_points": 1000}, "/shape_points"),
    (FORCED, {"sag_parameter": 0.9, "frequency_ratios": [2], "profiles_at": [0.1 + i / 50 for i in range(100)],
              "profile_points": 2000}, "/profiles_at"),
]


@pytest.mark.parametrize("path, body, pointer", LARGE)
def test_what_is_known_to_be_too_large_is_a_fault_of_the_request(strumd, path, body, pointer):
    answer = strumd.post(body, path=path)
    assert answer.status_code == 400, answer.text[:500]
    assert [error["pointer"] for error in answer.json()["errors"]] == [pointer]
    assert "16777216" in answer.text


@pytest.mark.parametrize("path, body, pointer", LARGE)
def test_the_estimate_is_never_above_the_size(start_strumd, path, body, pointer):
    """At the limit from which a request is accepted, its answer has more than that."""
    small = dict(body)
    small.update({"modes": 4, "shape_points": 50} if "modes" in body else
                 {"profiles_at": body["profiles_at"][:4], "profile_points": 50})
    size = len(start_strumd().post(small, path=path).content)
    low = start_strumd("--answer-bytes", str(size // 4))
    assert low.post(small, path=path).status_code == 400
    exact = start_strumd("--answer-bytes", str(size))
    assert exact.post(small, path=path).status_code == 200


def test_what_only_solving_tells_is_refused_then(start_strumd):
    strumd = start_strumd("--answer-bytes", "4K")
    body = {"sag_parameter": 0.9, "modes": 60}
    answer = strumd.post(body)
    assert answer.status_code == 422
    assert "4096 bytes" in answer.json()["detail"]
    assert strumd.post({"sag_parameter": 0.9, "modes": 2}).status_code == 200
    again = strumd.post(body)
    assert again.status_code == 422


def test_items_of_a_batch_are_bounded_too(start_strumd):
    strumd = start_strumd("--answer-bytes", "4K")
    items = [{"path": PATH, "request": request} for request in
             ({"sag_parameter": 0.9, "modes": 2}, {"sag_parameter": 0.9, "modes": 60},
              {"sag_parameter": 0.9, "modes": 2, "shape_points": 500}, {"sag_parameter": 0.8, "modes": 2})]
    answer = strumd.request("POST", "/v1/batch", data=json.dumps(items), headers={"Content-Type": "application/json"})
    assert answer.status_code == 200, answer.text[:500]
    text = answer.text
    assert text.count('"result":') == 2
    assert "more than 4096 bytes" in text and "/shape_points" in text
