# SPDX-License-Identifier: GPL-3.0-or-later
"""doc/handbook.md: where the textbook formulas fail, asked of the daemon."""
import math

import pytest

CATENARY, ABSORBER = "/v1/catenary/frequencies", "/v1/absorber/optimize"


def half_span(sag):
    """mu of the level catenary of that sag over span: (cosh mu - 1)/(2 mu) = sag."""
    low, high = 1e-3, 3
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if (math.cosh(middle) - 1) / (2 * middle) < sag else (low, middle)
    return low


@pytest.mark.parametrize("sag, share", [(1 / 100, 0.9985), (1 / 20, 0.9627), (1 / 12, 0.9020), (1 / 10, 0.8639), (1 / 8, 0.8000)])
def test_the_first_crossover(strumd, sag, share):
    mu = half_span(sag)
    flexibility = (2 * mu) ** 2 / (1 + 8 * sag ** 2) / (share * 4 * math.pi ** 2)
    request = {"chi_1": -mu, "chi_2": mu, "flexibility": flexibility, "plane": "in_plane", "modes": 3, "compare": True}
    answer = strumd.request("POST", CATENARY, json=request).json()
    first = {}
    for mode in answer["result"]["in_plane"]:
        first.setdefault(mode["symmetry"], mode["frequency_ratio"])
    assert first["symmetric"] == pytest.approx(first["antisymmetric"], rel=1e-4)
    assert sum("0.864 for 1:10" in warning for warning in answer["warnings"]) == (sag > 0.05 + 1e-9)


@pytest.mark.parametrize("place, mass, formula, best, damping", [
    (0.5, 0.01, 0.980, 0.983, 0.0707), (0.1, 0.05, 0.991, 1.009, 0.0488), (0.05, 0.3, 0.986, 1.051, 0.0606)])
def test_an_absorber_near_an_anchor(strumd, place, mass, formula, best, damping):
    first = math.pi  # of a string of length, tension and mass 1
    pieces = [{"type": "cable", "length_m": length, "mass_kg_per_m": 1} for length in (place, 1 - place)]
    absorber = {"type": "hanging_absorber", "mass_kg": mass, "stiffness_N_per_m": {"variable": "k"},
                "damping_N_s_per_m": {"variable": "R"}}
    middle = mass * first ** 2
    request = {"tension_N": 1, "components": [pieces[0], absorber, pieces[1]], "modes": [1, 2],
               "variables": [{"name": "k", "min": 0.8 * middle, "max": 1.25 * middle},
                             {"name": "R", "min": 0.01 * mass * first, "max": mass * first}]}
    answer = strumd.request("POST", ABSORBER, json=request).json()
    result = answer["result"]
    assert math.sqrt(result["optimum"]["k"] / mass) / first == pytest.approx(best, abs=2e-3)
    assert result["damping_ratio"] == pytest.approx(damping, abs=2e-4)
    tuned = math.sqrt(result["closed_forms"][0]["values"]["k"] / mass) / first
    assert tuned == pytest.approx(formula, abs=1e-3)
    assert any("wrong side" in warning for warning in answer["warnings"]) == (place <= 0.1)
