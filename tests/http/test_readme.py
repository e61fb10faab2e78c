# SPDX-License-Identifier: GPL-3.0-or-later
"""What README.md shows is what a newcomer gets: its requests are sent, its answers compared to the last digit shown."""
import decimal
import json
import re

import pytest

from conftest import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```(\w+)\n(.*?)```", README, re.S)
CURL = re.compile(r"curl -s --json '(.*?)'\s+http://127\.0\.0\.1:8080(/\S+)", re.S)
CURLS = CURL.findall(README)
# a question is followed by its answer
SHOWN = [(CURL.findall(question)[-1], answer) for (_, question), (language, answer) in zip(BLOCKS, BLOCKS[1:])
         if language == "json" and CURL.search(question)]


def lies_in(shown, answer, where=""):
    """Where the answer differs from what is shown of it; members that are not shown do not count."""
    if isinstance(shown, dict):
        return [fault for key in shown for fault in
                (lies_in(shown[key], answer[key], f"{where}/{key}") if key in answer else [f"{where}/{key}: missing"])]
    if isinstance(shown, list):
        if len(shown) != len(answer):
            return [f"{where}: {len(answer)} items"]
        return [fault for k, (a, b) in enumerate(zip(shown, answer)) for fault in lies_in(a, b, f"{where}/{k}")]
    if isinstance(shown, decimal.Decimal):
        same = decimal.Decimal(repr(answer)).quantize(shown) == shown
    else:
        same = shown == answer
    return [] if same else [f"{where}: {answer!r} instead of {shown!s}"]


def test_digits_count():
    """A comparison that takes everything would pass below."""
    shown = json.loads('{"a": [0.21620, {"b": "x"}]}', parse_float=decimal.Decimal)
    assert lies_in(shown, {"a": [0.216204999, {"b": "x", "c": 1}]}) == []
    for wrong in (0.2161949, 0.216206):
        assert lies_in(shown, {"a": [wrong, {"b": "x"}]})
    assert lies_in(shown, {"a": [0.2162, {"b": "y"}]}) and lies_in(shown, {"a": [0.2162]})


def test_five_questions_have_answers():
    assert len({path for (_, path), _ in SHOWN}) >= 5


@pytest.mark.parametrize("question, shown", SHOWN, ids=[path for (_, path), _ in SHOWN])
def test_an_answer_is_the_one_shown(strumd, question, shown):
    body, path = question
    answer = strumd.request("POST", path, data=body, headers={"Content-Type": "application/json"})
    assert answer.status_code == 200, answer.text
    assert lies_in(json.loads(shown, parse_float=decimal.Decimal), answer.json()) == []


def test_the_parabola_is_as_wrong_as_it_says(strumd):
    said, = re.findall(r"(\d+) % too\s+high", README)
    body, path = CURLS[0]
    first = strumd.post({**json.loads(body), "compare": True}, path=path).json()["result"]["comparison"]["in_plane"][0]
    assert round(100 * first["shallow_cable_difference"]) == int(said)


def test_the_faulty_request_is_told_of_its_faults(strumd):
    body, path = CURLS[-1]
    answer = strumd.post(json.loads(body), path=path)
    assert answer.status_code == 400
    faults = {error["pointer"]: error["detail"] for error in answer.json()["errors"]}
    assert "length_m" in faults["/lenght_m"] and "/modes" in faults


def test_the_link_for_a_browser_answers_the_same(strumd):
    link, = re.findall(r"<http://127\.0\.0\.1:8080(/v1/\S+)>", README)
    body = {**json.loads(CURLS[0][0]), "modes": 6}
    del body["mass_kg_per_m"]
    assert strumd.get(link).json() == strumd.post(body).json()


def test_every_folder_of_the_table_is_there():
    folders = re.findall(r"^\| `(\S+/)` \|", README, re.M)
    assert len(folders) >= 8
    assert [folder for folder in folders if not (ROOT / folder).is_dir()] == []


@pytest.mark.parametrize("program", ["deploy/run", "tests/run", "tests/cases/run", "tests/cases/report", "api/update"])
def test_programs_named_can_be_run(program):
    assert program in README + (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    assert (ROOT / program).stat().st_mode & 0o111
