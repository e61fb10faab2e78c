# SPDX-License-Identifier: GPL-3.0-or-later
"""What an answer echoes or derives, posted back, gives the same answer."""
import json
import math
import pathlib

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = {p.stem: json.loads(p.read_text(encoding="utf-8")) for p in sorted((ROOT / "api/examples").glob("*.json"))}
CATENARY, INCLINED = "/v1/catenary/frequencies", "/v1/inclined/modes"


def post(strumd, path, request):
    response = strumd.request("POST", path, json=request)
    assert response.status_code == 200, (request, response.text)
    return response.json()


@pytest.mark.parametrize("name", [name for name in EXAMPLES if name != "validation"])
def test_the_echo(strumd, name):
    example = EXAMPLES[name]
    first = post(strumd, example["endpoint"], example["request"])
    again = post(strumd, example["endpoint"], first["request"])
    assert (again["request"], again["result"], again["warnings"]) == (first["request"], first["result"], first["warnings"])
    assert again["meta"]["key"] == first["meta"]["key"]


def frequencies(answer):
    return [m["frequency_Hz"] for plane in ("in_plane", "out_of_plane", "modes") for m in answer["result"].get(plane, [])]


def same(first, again, where, relative):
    assert again["result"][where]["horizontal_tension_N"] == pytest.approx(first["result"][where]["horizontal_tension_N"], rel=relative)
    assert frequencies(again) == pytest.approx(frequencies(first), rel=relative)


SPAN = {"span_m": 300, "rise_m": 120, "mass_kg_per_m": 20}
DERIVED = {"horizontal_tension_N": "horizontal_tension_N", "tension_1_N": "tension_end_1_N", "tension_2_N": "tension_end_2_N",
           "a_m": "catenary_parameter_m", "sag_m": "sag_max_m"}


@pytest.mark.parametrize("member", DERIVED)
@pytest.mark.parametrize("more", [{"length_m": 330}, {"length_m": 330, "flexibility": 1e-3},
                                  {"unstretched_length_m": 330, "axial_stiffness_N": 3e8}], ids=["stiff", "flexible", "elastic"])
def test_figures_of_a_suspended_cable(strumd, more, member):
    first = post(strumd, CATENARY, {**SPAN, **more})
    kept = {k: v for k, v in more.items() if not k.endswith("length_m")}
    again = post(strumd, CATENARY, {**SPAN, **kept, DERIVED[member]: first["result"]["geometry"][member]})
    same(first, again, "geometry", 1e-12)


@pytest.mark.parametrize("pair", [("chi_1", "chi_2"), ("xi_1", "xi_2")])
@pytest.mark.parametrize("request_", [{"rise_to_span": 0.4, "sag_parameter": 0.9, "flexibility": 0.01}, {"chi_1": -0.5, "chi_2": 1}])
def test_dimensionless_figures(strumd, request_, pair):
    first = post(strumd, CATENARY, request_)["result"]
    shape = {key: first["geometry"][key] for key in (*pair, "flexibility")}
    again = post(strumd, CATENARY, shape)["result"]
    for plane in ("in_plane", "out_of_plane"):
        assert [m["frequency_ratio"] for m in again[plane]] == pytest.approx([m["frequency_ratio"] for m in first[plane]], rel=1e-12)


# Two conventions of "per metre": weight along the cable is spread otherwise, a difference of strain times sag.
@pytest.mark.parametrize("given, asked", [("length_m", "unstretched_length_m"), ("unstretched_length_m", "length_m")])
@pytest.mark.parametrize("more", [{}, {"weight_N_per_m": 150, "added_mass_kg_per_m": 5}], ids=["air", "water"])
def test_stretched_and_unstretched(strumd, given, asked, more):
    base = {**SPAN, "axial_stiffness_N": 3e8, **more}
    first = post(strumd, CATENARY, {**base, given: 330})
    g = first["result"]["geometry"]
    assert g["length_m"] > g["unstretched_length_m"]
    mass = g["mass_per_unstretched_length_kg_per_m" if asked == "unstretched_length_m" else "mass_per_stretched_length_kg_per_m"]
    scaled = {key: base[key] * mass / 20 for key in ("weight_N_per_m", "added_mass_kg_per_m") if key in base}
    again = post(strumd, CATENARY, {**base, **scaled, "mass_kg_per_m": mass, asked: g[asked]})
    same(first, again, "geometry", 1e-5)


def test_the_unstretched_length_of_the_cable_of_line_design(strumd):
    """H = 35,316 N and w = 17.658 N/m (a = 2000 m) over 500 m: INT ds/(1 + T/EA) by Simpson's rule, 500.81 m."""
    request = {"span_m": 500, "length_m": 4000 * math.sinh(0.125), "mass_kg_per_m": 17.658 / 9.80665, "axial_stiffness_N": 3.6e7}
    geometry = post(strumd, CATENARY, {**request, "modes": 1})["result"]["geometry"]
    assert geometry["horizontal_tension_N"] == pytest.approx(35316, rel=1e-9)
    parts = 200
    values = [c / (1 + 35316 * c / 3.6e7) for c in (math.cosh(0.25 * i / parts - 0.125) for i in range(parts + 1))]
    simpson = (values[0] + values[-1] + 4 * sum(values[1:-1:2]) + 2 * sum(values[2:-1:2])) * 2000 * 0.25 / parts / 3
    assert geometry["unstretched_length_m"] == pytest.approx(simpson, rel=1e-12)
    assert simpson == pytest.approx(500.81, abs=1e-3)


STAY = {"length_m": 1000, "mass_kg_per_m": 40, "weight_N_per_m": 200, "added_mass_kg_per_m": 15, "inclination_deg": 30,
        "tension_N": 1e6, "axial_stiffness_N": 4e8, "modes": 3}


@pytest.mark.parametrize("statics", ["inextensible", "elastic"])
@pytest.mark.parametrize("member", ["horizontal_tension_N", "tension_N", "axial_stiffness_N", "lambda_squared"])
def test_figures_of_an_inclined_cable(strumd, member, statics):
    first = post(strumd, INCLINED, {**STAY, "statics": statics})
    request = {**STAY, "statics": statics, member: first["result"]["statics"][member]}
    if member == "horizontal_tension_N":
        del request["tension_N"]
    if member == "lambda_squared":
        del request["axial_stiffness_N"]
    same(first, post(strumd, INCLINED, request), "statics", 1e-12)


def test_dimensionless_figures_of_an_inclined_cable(strumd):
    first = post(strumd, INCLINED, STAY)["result"]
    kept = {key: first["statics"][key] for key in ("epsilon", "lambda_squared", "mass_ratio")}
    again = post(strumd, INCLINED, {**kept, "inclination_deg": 30, "modes": 3})["result"]
    assert [m["kl_over_pi"] for m in again["modes"]] == pytest.approx([m["kl_over_pi"] for m in first["modes"]], rel=1e-12)


def test_an_optimum_posted_back_as_the_chain(strumd):
    example = EXAMPLES["absorber_optimize"]
    best = post(strumd, example["endpoint"], example["request"])["result"]
    put = {f'{{"variable": "{name}"}}': repr(value) for name, value in best["optimum"].items()}
    text = json.dumps({key: example["request"][key] for key in ("tension_N", "components")})
    for name, value in put.items():
        text = text.replace(name, value)
    modes = [m["mode"] for m in best["modes"]]
    again = post(strumd, "/v1/taut/modes", {**json.loads(text), "mode_numbers": modes})["result"]
    key = "damping_ratio"
    found = {m["mode"]: m[key] for m in again["modes"] if "mode" in m}
    assert [found[m] for m in modes] == pytest.approx([m[key] for m in best["modes"]], rel=1e-9)
