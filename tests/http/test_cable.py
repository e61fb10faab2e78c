# SPDX-License-Identifier: GPL-3.0-or-later
"""The cable as it hangs, over HTTP: one cable however it is written, and answers that can be asked again."""
import json
import math
import random

import pytest

STATICS, MODES = "/v1/cable/statics", "/v1/cable/modes"
STAY = {"span_m": 300, "rise_m": 120, "mass_kg_per_m": 51.6, "axial_stiffness_N": 1206900000, "tension_end_2_N": 200000}
CHAIN = {"sections": [{"chain": {"nominal_diameter_m": .14}, "length_m": 600}, {"diameter_m": .14, "mass_kg_per_m": 22,
         "axial_stiffness_N": 5e7, "layers": [{"thickness_m": .01, "density_kg_per_m3": 1325}]}],
         "fluid_density_kg_per_m3": 1025, "span_m": 700, "rise_m": 150, "bed": {"friction_coefficient": .5},
         "horizontal_tension_N": 800000}
EVERYTHING = {"span_m": 80, "rise_m": 80, "statics": "flexible", "end_1": {"rotation": "clamped"},
              "end_2": {"rotational_stiffness_N_m_per_rad": 400},
              "sections": [{"length_m": 50, "mass_kg_per_m": 2, "axial_stiffness_N": 1.2e6, "bending_stiffness_N_m2": 150},
                           {"length_m": 66, "mass_kg_per_m": 3, "axial_stiffness_N": 1.6e6, "bending_stiffness_N_m2": 260}],
              "attachments": [
                  {"type": "damper", "position_m": 3, "damping_N_s_per_m": 350},
                  {"type": "spring", "position_m": 3, "stiffness_N_per_m": 40, "direction_deg": 30},
                  {"type": "inerter", "position_m": 3, "inertance_kg": 3, "direction": "all"},
                  {"type": "point_mass", "position_m": 30, "mass_kg": 2, "repeat": {"count": 3, "spacing_m": 5}},
                  {"type": "hanging_absorber", "position_m": 60, "mass_kg": 6, "stiffness_N_per_m": 45, "damping_N_s_per_m": 4,
                   "direction": "vertical"},
                  {"type": "force", "position_m": 85, "force_x_N": 60}, {"type": "tension_jump", "position_m": 90, "jump_N": 100}]}
ROW = {"span_m": 100, "length_m": 100.5, "mass_kg_per_m": 2, "axial_stiffness_N": 1e7, "spans": 3, "hanger": {"length_m": 2}}
QUESTIONS = [(STATICS, STAY), (STATICS, {**STAY, "branch": "slack", "shape_points": 3}), (STATICS, CHAIN), (STATICS, EVERYTHING),
             (STATICS, {**STAY, "temperature_change_K": 30, "expansion_per_K": 1.2e-5, "taken_in_m": .1}),
             (MODES, {**STAY, "modes": 2, "shape_points": 3, "compare": True}),
             (MODES, {**EVERYTHING, "modes": 2, "plane": "in_plane", "compare": True, "shape_points": 2}),
             (MODES, {**ROW, "modes": 2}), (MODES, {**CHAIN, "modes": 2, "contact": "sliding"})]


@pytest.mark.parametrize("path, question", QUESTIONS, ids=range(len(QUESTIONS)))
def test_what_is_echoed_has_the_same_answer(strumd, path, question):
    first = strumd.post(question, path)
    assert first.status_code == 200, first.text
    again = strumd.post(first.json()["request"], path)
    assert again.content == first.content and again.headers["ETag"] == first.headers["ETag"]


def test_one_section_may_be_asked_by_get(strumd):
    for path, more in ((STATICS, {"shape_points": 3}), (MODES, {"modes": 2, "plane": "in_plane"})):
        posted = strumd.post({**STAY, **more}, path)
        got = strumd.get(path + "?" + "&".join(f"{name}={value}" for name, value in {**STAY, **more}.items()))
        assert posted.status_code == got.status_code == 200, got.text
        assert posted.content == got.content
    refused = strumd.get(STATICS + "?span_m=1&length_m=2&mass_kg_per_m=1&bed=1")
    assert refused.status_code == 400 and refused.json()["errors"][0]["pointer"] == "/bed"


@pytest.mark.parametrize("question", [STAY, CHAIN, EVERYTHING], ids=["stay", "chain", "everything"])
def test_the_sections_of_an_answer_may_be_posted(strumd, question):
    """With the lengths that were found, the same cable hangs."""
    first = strumd.post(question, STATICS).json()
    kept = {name: first["request"][name] for name in ("rise_m", "bed", "attachments", "end_1", "end_2", "statics")
            if name in first["request"]}
    again = strumd.post({**kept, "span_m": question["span_m"], "sections": first["result"]["sections"]}, STATICS)
    assert again.status_code == 200, again.text
    for name in ("tension_end_1_N", "tension_end_2_N", "length_m", "lying_m"):
        expected = first["result"]["statics"][name]
        assert again.json()["result"]["statics"][name] == pytest.approx(expected, rel=1e-10, abs=1e-7)


def test_a_section_in_two_is_the_same_cable(strumd):
    whole = {"length_m": 101, "mass_kg_per_m": 2, "axial_stiffness_N": 1e6, "bending_stiffness_N_m2": 50}
    parts = [{**whole, "length_m": length} for length in (31.5, 69.5)]
    one = strumd.post({"span_m": 100, "modes": 4, **whole}, MODES).json()["result"]
    two = strumd.post({"span_m": 100, "modes": 4, "sections": parts}, MODES).json()["result"]
    for plane in ("in_plane", "out_of_plane"):
        assert [mode["frequency_Hz"] for mode in two[plane]] == pytest.approx([mode["frequency_Hz"] for mode in one[plane]], rel=1e-11)


def test_mirrored_it_is_the_same_cable(strumd):
    def modes(rise, place):
        asked = {"span_m": 100, "rise_m": rise, "length_m": 112, "mass_kg_per_m": 2, "axial_stiffness_N": 1e6, "modes": 4,
                 "plane": "in_plane", "attachments": [{"type": "point_mass", "position_m": place, "mass_kg": 30},
                                                      {"type": "damper", "position_m": place, "damping_N_s_per_m": 20}]}
        return strumd.post(asked, MODES).json()["result"]["in_plane"]
    here, there = modes(40, 30), modes(-40, 82)
    for name in ("frequency_Hz", "decay_rate_per_s"):
        assert [mode[name] for mode in there] == pytest.approx([mode[name] for mode in here], rel=1e-9)


@pytest.mark.parametrize("question", [STAY, EVERYTHING, ROW, CHAIN], ids=["stay", "everything", "row", "chain"])
def test_a_second_method_agrees(strumd, question):
    said = strumd.post({**question, "modes": 3, "verify": True}, MODES).json()["result"]["verification"]
    assert said["max_relative_difference"] < 1e-10 and said["modes_found"] == said["modes_expected"] >= 6


def test_a_batch_has_the_same_bytes(strumd):
    items = [{"path": path, "request": question} for path, question in QUESTIONS[:3]]
    lines = strumd.post(items, "/v1/batch").content.splitlines()
    assert [json.loads(line)["meta"]["key"] for line in lines] == [
        strumd.post(question, path).json()["meta"]["key"] for path, question in QUESTIONS[:3]]


def test_too_large_a_shape_is_refused_before_the_work(start_strumd):
    strumd = start_strumd("--answer-bytes", "1M")
    refused = strumd.post({**STAY, "modes": 100, "shape_points": 2000}, MODES)
    assert refused.status_code == 400 and refused.json()["errors"][0]["pointer"] == "/shape_points", refused.text


def frequencies(modes):
    return [mode["frequency_Hz"] for mode in modes]


@pytest.mark.parametrize("number", range(12))
def test_bare_it_is_the_suspended_cable(strumd, number):
    """Without bodies and bending stiffness, level or inclined, stiff or elastic: /v1/catenary/frequencies."""
    rng = random.Random(f"bare {number}")
    common = {"span_m": rng.uniform(20, 500), "mass_kg_per_m": rng.uniform(.5, 50), "added_mass_kg_per_m": rng.choice([0, 3]),
              "rise_m": rng.choice([0, rng.uniform(-100, 100)]), "modes": 6}
    length = math.hypot(common["span_m"], common["rise_m"]) * (1 + 10 ** rng.uniform(-2.5, -.5))
    elastic = {"axial_stiffness_N": common["mass_kg_per_m"] * length * 10 ** rng.uniform(3, 6)} if number % 2 else {}
    known = strumd.post({**common, **elastic, "unstretched_length_m" if elastic else "length_m": length}, "/v1/catenary/frequencies")
    here = strumd.post({**common, **elastic, "length_m": length}, MODES)
    assert known.status_code == here.status_code == 200, here.text
    for plane in ("in_plane", "out_of_plane"):
        assert frequencies(here.json()["result"][plane]) == pytest.approx(frequencies(known.json()["result"][plane]), rel=1e-12)


@pytest.mark.parametrize("number", range(12))
def test_straight_it_is_the_taut_chain(strumd, number):
    """Weightless and taut, with masses, dampers and absorbers across it: /v1/taut/modes."""
    rng = random.Random(f"straight {number}")
    tension, mass = rng.uniform(1e3, 1e6), rng.uniform(.5, 20)
    lengths = [rng.uniform(5, 40) for _ in range(3)]
    damped = number % 2
    parts = [{"type": "damper", "damping_N_s_per_m": .3 * (tension * mass) ** .5} if damped
             else {"type": "point_mass", "mass_kg": rng.uniform(1, 100)},
             {"type": "hanging_absorber", "mass_kg": rng.uniform(1, 50), "stiffness_N_per_m": tension / 100,
              "damping_N_s_per_m": rng.uniform(1, 100) if damped else 0}]
    cables = [{"type": "cable", "length_m": length, "mass_kg_per_m": mass} for length in lengths]
    chain = {"tension_N": tension, "modes": 6, "components": [cables[0], parts[0], cables[1], parts[1], cables[2]]}
    places = [lengths[0], lengths[0] + lengths[1]]
    attachments = [{**part, "position_m": place, **({} if part["type"] == "damper" else {"weight_N": 0}),
                    **({} if part["type"] == "point_mass" else {"direction": "out_of_plane"})} for part, place in zip(parts, places)]
    here = strumd.post({"horizontal_tension_N": tension, "length_m": sum(lengths), "mass_kg_per_m": mass, "weight_N_per_m": 0,
                        "plane": "out_of_plane", "modes": 6, "attachments": attachments}, MODES)
    known = strumd.post(chain, "/v1/taut/modes")
    assert known.status_code == here.status_code == 200, here.text
    known = sorted((mode for mode in known.json()["result"]["modes"] if "frequency_Hz" in mode), key=lambda mode: mode["frequency_Hz"])
    here = here.json()["result"]["out_of_plane"][:len(known)]
    assert len(known) >= 5 and frequencies(here) == pytest.approx(frequencies(known[:len(here)]), rel=1e-11)
    if damped:
        assert [mode["damping_ratio"] for mode in here] == pytest.approx([mode["damping_ratio"] for mode in known], abs=1e-11)
