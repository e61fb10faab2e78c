# SPDX-License-Identifier: GPL-3.0-or-later
"""What README.md shows is what a newcomer gets: its requests are sent, its answers compared."""
import json
import re

import pytest

from conftest import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```(\w+)\n(.*?)```", README, re.S)
CURLS = re.findall(r"curl -s --json '(.*?)' http://127\.0\.0\.1:8080(/\S+)", README)
DIGITS = 1e-12  # the README prints 13 digits


def lies_in(shown, answer, where=""):
    """Where the answer differs from what is shown of it; members that are not shown do not count."""
    if isinstance(shown, dict):
        return [fault for key in shown for fault in
                (lies_in(shown[key], answer[key], f"{where}/{key}") if key in answer else [f"{where}/{key}: missing"])]
    if isinstance(shown, list):
        if len(shown) != len(answer):
            return [f"{where}: {len(answer)} items"]
        return [fault for k, (a, b) in enumerate(zip(shown, answer)) for fault in lies_in(a, b, f"{where}/{k}")]
    same = abs(shown - answer) <= DIGITS * abs(shown) if isinstance(shown, float) else shown == answer
    return [] if same else [f"{where}: {answer!r} instead of {shown!r}"]


def test_the_first_answer_is_the_one_shown(strumd):
    shown, = [json.loads(text) for language, text in BLOCKS if language == "json"]
    body, path = CURLS[0]
    assert lies_in(shown, strumd.post(json.loads(body), path=path).json()) == []


def test_the_faulty_request_is_told_of_its_faults(strumd):
    body, path = CURLS[1]
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


@pytest.mark.parametrize("program", ["deploy/run", "tests/run", "tests/cases/run", "api/update"])
def test_programs_named_can_be_run(program):
    assert program in README
    assert (ROOT / program).stat().st_mode & 0o111
