# SPDX-License-Identifier: GPL-3.0-or-later
"""Two ways of asking the same: frequencies in Hz, rad/s, s or the report's ratio, equal bodies by one entry, and so on. Their
answers are the same but for the echo and roundings of what was converted."""
import math

import pytest


def ask(strumd, path, request):
    response = strumd.post(request, path)
    assert response.status_code == 200, response.text
    return response.json()


def apart(one, other, place=""):
    """The largest relative difference of two results, which have the same members."""
    assert type(one) is type(other) or {type(one), type(other)} <= {int, float}, place
    if isinstance(one, dict):
        assert one.keys() == other.keys(), place
        return max((apart(one[name], other[name], f"{place}/{name}") for name in one if name != "evaluations"), default=0)
    if isinstance(one, list):
        assert len(one) == len(other), place
        return max((apart(a, b, f"{place}/{i}") for i, (a, b) in enumerate(zip(one, other))), default=0)
    if isinstance(one, (int, float)) and not isinstance(one, bool):
        return abs(one - other) / max(abs(one), 1e-9)
    assert one == other, place
    return 0


def same(strumd, path, first, *others, relative=1e-12):
    expected = ask(strumd, path, first)["result"]
    for other in others:
        answer = ask(strumd, path, other)
        assert apart(expected, answer["result"]) <= relative, other
        again = ask(strumd, path, answer["request"])  # the echo is the same question
        assert again["meta"]["key"] == answer["meta"]["key"]


CABLE = {"span_m": 100, "rise_m": 10, "length_m": 110, "mass_kg_per_m": 2, "axial_stiffness_N": 1e6}
CHAIN = {"tension_N": 5000, "components": [{"type": "cable", "length_m": 30, "mass_kg_per_m": 2},
                                           {"type": "point_mass", "mass_kg": 20},
                                           {"type": "cable", "length_m": 20, "mass_kg_per_m": 2}]}
FORCED, MODES, MATRIX = "/v1/forced/tension", "/v1/taut/modes", "/v1/taut/matrix"
ABSORBER, INCLINED, CATENARY = "/v1/absorber/optimize", "/v1/inclined/modes", "/v1/catenary/frequencies"


def test_forced_frequencies(strumd):
    first = ask(strumd, FORCED, CABLE | {"frequency_ratios": [1, 2.5]})["result"]
    unit = first["curve"][0]["angular_frequency_rad_per_s"]
    at = [unit, 2.5 * unit]
    same(strumd, FORCED, CABLE | {"frequency_ratios": [1, 2.5], "profiles_at": [2.5]},
         CABLE | {"frequencies_Hz": [w / 2 / math.pi for w in at], "profiles_at": [2.5]},
         CABLE | {"angular_frequencies_rad_per_s": at, "profiles_at_Hz": [at[1] / 2 / math.pi]},
         CABLE | {"periods_s": [2 * math.pi / w for w in at], "profiles_at_s": [2 * math.pi / at[1]]},
         CABLE | {"frequency_ratios": [1, 2.5], "profiles_at_rad_per_s": [at[1]]})
    same(strumd, FORCED, CABLE | {"frequency_ratio_min": 1, "frequency_ratio_max": 2.5, "points": 4},
         CABLE | {"frequency_min_Hz": at[0] / 2 / math.pi, "frequency_max_Hz": at[1] / 2 / math.pi, "points": 4},
         CABLE | {"angular_frequency_min_rad_per_s": at[0], "angular_frequency_max_rad_per_s": at[1], "points": 4},
         CABLE | {"period_min_s": 2 * math.pi / at[1], "period_max_s": 2 * math.pi / at[0], "points": 4})


@pytest.mark.parametrize("path, more", [
    (MODES, {}), (ABSORBER, {"variables": [{"name": "c", "min": 10, "max": 200}], "max_evaluations": 200})])
def test_bands(strumd, path, more):
    chain = {**CHAIN, "components": list(CHAIN["components"])}
    if more:
        chain["components"][1] = {"type": "damper", "damping_N_s_per_m": {"variable": "c"}}
    low, high = 2 * math.pi * .25, 2 * math.pi * 2
    same(strumd, path, {**chain, **more, "band_rad_per_s": [low, high]}, {**chain, **more, "band_Hz": [.25, 2]},
         {**chain, **more, "band_s": [.5, 4]})


def test_matrices(strumd):
    same(strumd, MATRIX, CHAIN | {"angular_frequencies": [math.pi, 3]},
         CHAIN | {"frequencies_Hz": [.5, 3 / 2 / math.pi]}, CHAIN | {"angular_frequencies_rad_per_s": [math.pi, 3]},
         CHAIN | {"periods_s": [2, 2 * math.pi / 3]})


STAY = {"mass_kg_per_m": 51.6, "axial_stiffness_N": 1.2069e9}


@pytest.mark.parametrize("figure", [{"sag_max_m": 15}, {"sag_mid_m": 15}, {"tension_end_1_N": 3e5}, {"tension_end_2_N": 2e5},
                                    {"tension_end_2_N": 2e5, "branch": "slack"}, {"horizontal_tension_N": 2e5},
                                    {"tension_parallel_to_chord_N": 3e5}, {"catenary_parameter_m": 700}])
def test_inclined_beside_catenary(strumd, figure):
    """Both endpoints answer the elastic catenary, from one figure of it: statics and modes of both planes."""
    supports = {"span_m": 300, "rise_m": 120, **STAY, **figure}
    inclined = ask(strumd, INCLINED, supports | {"statics": "elastic", "plane": "both", "modes": 4})["result"]
    catenary = ask(strumd, CATENARY, supports | {"modes": 4})["result"]
    for one, other in (("modes", "in_plane"), ("out_of_plane", "out_of_plane")):
        assert [m["frequency_Hz"] for m in inclined[one]] == pytest.approx([m["frequency_Hz"] for m in catenary[other]], rel=1e-11)
    statics = inclined["statics"]
    assert (statics["span_m"], statics["rise_m"]) == pytest.approx((300, 120), rel=1e-12)
    old = {"length_m": statics["unstretched_length_m"], "tension_N": statics["tension_N"],
           "inclination_deg": math.degrees(math.atan2(120, 300)), **STAY, "statics": "elastic", "plane": "both", "modes": 4}
    again = ask(strumd, INCLINED, old)["result"]
    for plane in ("modes", "out_of_plane"):
        assert apart(again[plane], inclined[plane]) < 1e-10


def beads(count, length):
    """So many masses on a cable, one by one and by one entry."""
    piece, mass = {"type": "cable", "length_m": length, "mass_kg_per_m": 1.5}, {"type": "point_mass", "mass_kg": 3}
    rows = [[piece] + [mass, piece] * count, [piece, {**mass, "repeat": {"count": count, "spacing_m": length}}, piece],
            [{"type": "group", "components": [piece, mass], "repeat": {"count": count}}, piece]]
    return [{"tension_N": 5000, "components": row} for row in rows]


def test_repeats(strumd):
    same(strumd, MODES, *(r | {"band_Hz": [.2, 2], "shape_points": 9} for r in beads(40, 2)), relative=0)
    same(strumd, MATRIX, *(r | {"frequencies_Hz": [.3]} for r in beads(7, 2)), relative=0)
    search = {"variables": [{"name": "c", "min": 10, "max": 200}], "modes": [1], "max_evaluations": 200}
    absorber = {"type": "hanging_absorber", "mass_kg": 2, "stiffness_N_per_m": 60, "damping_N_s_per_m": {"variable": "c"}}
    same(strumd, ABSORBER, *({**r, "components": [absorber, *r["components"]], "left_end": "free", **search} for r in beads(3, 5)), relative=0)


def test_many_repeats(strumd):
    """10,000 components, and no more."""
    request = beads(4999, .1)[1] | {"mode_numbers": [1, 5000], "nodes": False}
    assert len(ask(strumd, MODES, request)["result"]["modes"]) == 2
    request["components"][1]["repeat"]["count"] = 5001
    response = strumd.post(request, MODES)
    assert response.status_code == 400
    assert [error["pointer"] for error in response.json()["errors"]] == ["/components/1/repeat/count"]


@pytest.mark.parametrize("more, pointers", [
    ({"frequency_min_Hz": 2, "frequency_max_Hz": 1}, ["/frequency_max_Hz"]),
    ({"period_min_s": 2, "period_max_s": 1}, ["/period_max_s"]),
    ({"frequencies_Hz": [1e8]}, ["/frequencies_Hz"]),
    ({"frequencies_Hz": [1], "periods_s": [1]}, ["/periods_s"]),
    ({"frequency_ratios": [1], "profiles_at_s": [1e-9]}, ["/profiles_at_s"])])
def test_refused(strumd, more, pointers):
    response = strumd.post(CABLE | more, FORCED)
    assert response.status_code == 400, response.text
    assert [error["pointer"] for error in response.json()["errors"]] == pointers, response.text


ROUND = {"diameter_m": .1, "material_density_kg_per_m3": 5000, "fluid_density_kg_per_m3": 1025, "added_mass_coefficient": 1}
AREA = math.pi / 4 * .1 ** 2
MASSES = {"mass_kg_per_m": 5000 * AREA, "weight_N_per_m": 9.80665 * (5000 - 1025) * AREA, "added_mass_kg_per_m": 1025 * AREA}


@pytest.mark.parametrize("path, more", [
    (CATENARY, {"span_m": 100, "rise_m": 20, "length_m": 110}),
    (CATENARY, {"span_m": 100, "sag_mid_m": 5, "axial_stiffness_N": 1e8}),
    (CATENARY, {"span_m": 100, "tension_end_2_N": 1e5}),
    (FORCED, {"span_m": 100, "length_m": 110, "frequencies_Hz": [.3]}),
    (INCLINED, {"length_m": 100, "tension_N": 1e5, "inclination_deg": 30, "inextensible": True}),
    (INCLINED, {"span_m": 100, "rise_m": 20, "sag_max_m": 4, "axial_stiffness_N": 1e8})])
def test_round_cable(strumd, path, more):
    same(strumd, path, more | MASSES, more | ROUND,
         more | ROUND | {"mass_kg_per_m": 5000 * AREA})


@pytest.mark.parametrize("more, pointer", [
    ({"material_density_kg_per_m3": 900}, "/fluid_density_kg_per_m3"), ({"weight_N_per_m": 1}, "/weight_N_per_m"),
    ({"mass_kg_per_m": 1}, "/mass_kg_per_m"), ({"added_mass_kg_per_m": 1}, "/added_mass_kg_per_m")])
def test_round_cable_refused(strumd, more, pointer):
    for path, cable in ((CATENARY, {"span_m": 100, "length_m": 110}),
                        (INCLINED, {"length_m": 100, "tension_N": 1e5, "inclination_deg": 30, "inextensible": True})):
        response = strumd.post(cable | ROUND | more, path)
        assert response.status_code == 400, response.text
        assert pointer in [error["pointer"] for error in response.json()["errors"]], response.text
