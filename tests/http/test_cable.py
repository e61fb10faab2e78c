# SPDX-License-Identifier: GPL-3.0-or-later
"""The cable as it hangs, over HTTP: one cable however it is written, and answers that can be asked again."""
import json

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


def test_a_batch_has_the_same_bytes(strumd):
    items = [{"path": path, "request": question} for path, question in QUESTIONS[:3]]
    lines = strumd.post(items, "/v1/batch").content.splitlines()
    assert [json.loads(line)["meta"]["key"] for line in lines] == [
        strumd.post(question, path).json()["meta"]["key"] for path, question in QUESTIONS[:3]]


def test_too_large_a_shape_is_refused_before_the_work(start_strumd):
    strumd = start_strumd("--answer-bytes", "1M")
    refused = strumd.post({**STAY, "modes": 100, "shape_points": 2000}, MODES)
    assert refused.status_code == 400 and refused.json()["errors"][0]["pointer"] == "/shape_points", refused.text
