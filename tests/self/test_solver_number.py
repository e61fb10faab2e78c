# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers that change take a new solver number, and so new keys.

solver_numbers.json records, for every solver number there was, the key and a digest of the answer of each example (of number 1, from before the record, the keys only).
"""
import importlib.machinery
import importlib.util
import json
import os
import pathlib
import platform
import re

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECORD = json.loads((ROOT / "tests/self/solver_numbers.json").read_text(encoding="utf-8"))
EXAMPLES = {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted((ROOT / "api/examples").glob("*.json"))}
NUMBER, = re.findall(r"^solver_number = (\d+)$", (ROOT / "meson.build").read_text(encoding="utf-8"), re.M)
RAISE = (f"the answer changed while solver_number is {NUMBER}: raise it in meson.build, note the change in CHANGELOG.md,"
         " build, and run api/update --answers STRUMD, then api/update BUILD_FOLDER")

loader = importlib.machinery.SourceFileLoader("update", str(ROOT / "api/update"))
update = importlib.util.module_from_spec(importlib.util.spec_from_loader("update", loader))
loader.exec_module(update)


@pytest.fixture(scope="module")
def url():
    with update.daemon(os.environ["STRUMD"]) as address:
        yield address


def test_the_number_is_recorded_and_the_newest():
    assert max(map(int, RECORD)) == int(NUMBER), RAISE


@pytest.mark.skipif(platform.machine() != "x86_64", reason="the last digits recorded are those of x86-64")
@pytest.mark.parametrize("name", EXAMPLES)
def test_an_answer_is_the_one_of_its_number(url, name):
    text = update.ask(url, EXAMPLES[name])
    assert update.mark(text) == RECORD[NUMBER][name], RAISE
    assert json.loads(text) == EXAMPLES[name]["answer"], "run api/update --answers STRUMD, then api/update BUILD_FOLDER"
    assert json.loads(text)["meta"]["solver_number"] == int(NUMBER)


def test_a_changed_digit_or_warning_is_seen():
    text = '{"request":{},"result":{"a":1.25},"warnings":[],"meta":{"key":"k"}}'
    assert update.mark(text) != update.mark(text.replace("1.25", "1.26"))
    assert update.mark(text) != update.mark(text.replace("[]", '["w"]'))
    assert update.mark(text) == update.mark(text.replace('{"key":"k"}', '{"key":"k","more":1}'))


def test_no_two_numbers_share_a_key():
    keys = [mark["key"] for marks in RECORD.values() for mark in marks.values()]
    assert len(keys) == len(set(keys))
