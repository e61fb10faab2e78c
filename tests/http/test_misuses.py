# SPDX-License-Identifier: GPL-3.0-or-later
"""doc/misuses.md: each request gets exactly the texts that stand there, and their numbers are right."""
import math
import re

import pytest

from misuses import entries, texts_of

ENTRIES = entries()
BY_TITLE = {title: (path, request, texts) for title, path, request, texts in ENTRIES}


@pytest.mark.parametrize("title", BY_TITLE)
def test_the_texts_that_come(strumd, title):
    path, request, texts = BY_TITLE[title]
    assert texts, "a misuse without a word"
    assert texts_of(strumd.request("POST", path, json=request).json()) == texts


def numbers(text):
    return [float(n) for n in re.findall(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?", text)]


def test_lambda_squared_of_a_steel_wire():
    """Irvine's parameter of the shallow cable, from its length alone: length = span + span^3/(24 a^2)."""
    _, r, texts = BY_TITLE["A taut wire without axial stiffness"]
    span, a = r["span_m"], math.sqrt(r["span_m"] ** 3 / 24 / (r["length_m"] - r["span_m"]))
    tension = r["mass_kg_per_m"] * 9.80665 * a
    steel = 2.00e11 / 7850 * r["mass_kg_per_m"]
    lambda_squared = (span / a) ** 2 * steel / tension
    needed, limit, stiffness, given = numbers(texts[0].split("within 1 % from an axial_stiffness_N of")[1])[:4]
    assert (limit, stiffness, given) == (471, pytest.approx(steel, rel=5e-3), pytest.approx(lambda_squared, rel=5e-3))
    assert needed == pytest.approx(470.916 * tension / (span / a) ** 2, rel=5e-3)


def test_the_stiffness_that_is_named_moves_the_mode_by_one_percent(strumd):
    path, r, texts = BY_TITLE["A taut wire without axial stiffness"]
    needed = numbers(texts[0].split("within 1 % from an axial_stiffness_N of")[1])[0]

    def symmetric(stiffness):
        answer = strumd.request("POST", path, json={**r, "modes": 3, **stiffness}).json()
        return next(m["frequency_Hz"] for m in answer["result"]["in_plane"] if m["symmetry"] == "symmetric")
    shift = 1 - symmetric({"axial_stiffness_N": needed}) / symmetric({})
    assert shift == pytest.approx(0.01, rel=0.005)


@pytest.mark.parametrize("request_, fits", [
    ({"span_m": 100, "length_m": 110, "mass_kg_per_m": 2}, True),
    ({"span_m": 100, "length_m": 100.1, "mass_kg_per_m": 2, "axial_stiffness_N": 3e7}, True),
    ({"span_m": 100, "length_m": 100.1, "mass_kg_per_m": 2, "plane": "out_of_plane"}, True),
    ({"span_m": 100, "length_m": 100.1, "mass_kg_per_m": 2}, False),
    ({"sag_parameter": 0.999}, True)])
def test_no_word_where_nothing_bites(strumd, request_, fits):
    answer = strumd.request("POST", "/v1/catenary/frequencies", json={**request_, "modes": 1}).json()
    assert (answer["warnings"] == []) == fits, answer["warnings"]
