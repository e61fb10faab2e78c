# SPDX-License-Identifier: GPL-3.0-or-later
"""/v1/validation against the case files themselves: the daemon's own comparison, compared again here."""
import json
import pathlib

import pytest

CASES = sorted((pathlib.Path(__file__).resolve().parents[1] / "cases").glob("*.json"))
PATH = "/v1/validation"


def all_cases():
    for path in CASES:
        document = json.loads(path.read_text(encoding="utf-8"))
        for case in document["cases"]:
            yield {"endpoint": document["endpoint"], "source": document["source"], **case}


def result(strumd, **request):
    answer = strumd.post(request, PATH)
    assert answer.status_code == 200, answer.text
    return answer.json()["result"]


def as_complex(value):
    return complex(value["re"], value["im"]) if isinstance(value, dict) else value


@pytest.mark.parametrize("family", ["gale/table B-3", "gale/table C-2", "sergev_iwan/table 1", "catenary/refused/range",
                                    "catenary/overdamped", "catenary/mode_shape", "inclined/refused/missing"])
def test_a_family_as_its_file_has_it(strumd, family):
    name = "".join(c if c.isalnum() else "_" for c in family)
    said = result(strumd, family=name, values=True)
    wanted = {case["id"]: case for case in all_cases() if case["family"] == family}
    assert {case["case"] for case in said["cases"]} == set(wanted)
    assert said["totals"]["cases"] == said["totals"]["passed"] == len(wanted) and said["totals"]["failed"] == 0
    for case in said["cases"]:
        assert case["source"] == wanted[case["case"]]["source"]
        numbers = [e for e in wanted[case["case"]].get("expect", []) if "values" in e]
        for expect in numbers:
            rows = [row for row in case["compared"] if row["pointer"] == expect["pointer"]]
            assert [as_complex(row["expected"]) for row in rows] == \
                [complex(*one) if isinstance(one, list) else one for one in expect["values"]]
            for row, printed in zip(rows, expect.get("printed", [])):
                assert (row["printed"], row["verdict"]) == (printed["value"], printed["verdict"])
        for row in case.get("compared", []):
            if "difference" in row and "tolerance" in row and not any("up_to_scale" in e for e in wanted[case["case"]]["expect"]):
                off = abs(as_complex(row["computed"]) - as_complex(row["expected"]))
                assert abs(off - row["difference"]) <= 1e-15 * max(1, abs(as_complex(row["expected"])))
                assert row["holds"] == (off <= row["tolerance"])


def test_filters(strumd):
    cases = list(all_cases())
    for report, start in (("sergev_iwan", "sergev_iwan"),):
        said = result(strumd, report=report)
        assert {case["report"] for case in said["cases"]} == {report}
        assert said["totals"]["cases"] == sum(case["family"].startswith(start) for case in cases)
    said = result(strumd, endpoint="taut_matrix")
    assert said["totals"]["cases"] == sum(case["endpoint"] == "/v1/taut/matrix" for case in cases)
    assert strumd.get(PATH + "?endpoint=taut_matrix").json()["result"] == said
    for unknown in ({"family": "no_such"}, {"endpoint": "validation"}):
        assert strumd.post(unknown, PATH).status_code == 422


def test_values_are_listed_where_asked(strumd):
    assert not any("compared" in case for case in result(strumd, family="gale_table_B_3")["cases"])
    assert all(case["compared"] for case in result(strumd, family="gale_table_B_3", values=True)["cases"])
