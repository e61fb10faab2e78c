# SPDX-License-Identifier: GPL-3.0-or-later
"""tests/tally must not lose a failure: every way in which a runner can end badly is a failed case."""
import pathlib
import subprocess

TALLY = pathlib.Path(__file__).parent.parent / "tally"


def tally(folder, steps):
    """Runs tests/tally over {step: (status, report or None)}; its exit status and last line."""
    for step, (status, report) in steps.items():
        (folder / f"{step}.status").write_text(f"{status}\n")
        if report is not None:
            (folder / f"{step}.xml").write_text(report)
    done = subprocess.run([TALLY, folder], capture_output=True, text=True)
    return done.returncode, done.stdout.splitlines()[-1]


def junit(**cases):
    body = "".join(f'<testcase classname="c" name="{name}">{inside}</testcase>' for name, inside in cases.items())
    return f"<testsuites><testsuite>{body}</testsuite></testsuites>"


def test_counts_cases_of_all_runners(tmp_path):
    steps = {"build.release": (0, None), "unit.release": (0, junit(a="", b="")), "http.sanitized": (0, junit(a=""))}
    assert tally(tmp_path, steps) == (0, "3 passed, 0 failed")


def test_a_case_in_two_variants_counts_once_and_fails_when_one_fails(tmp_path):
    steps = {"unit.release": (1, junit(a="<failure/>", b="")), "unit.sanitized": (0, junit(a="", b=""))}
    assert tally(tmp_path, steps) == (1, "1 passed, 1 failed")


def test_an_error_is_a_failure(tmp_path):
    assert tally(tmp_path, {"http.sanitized": (1, junit(a="<error/>", b=""))}) == (1, "1 passed, 1 failed")


def test_a_bad_end_after_good_cases_is_a_failure(tmp_path):
    assert tally(tmp_path, {"unit.sanitized": (1, junit(a=""))}) == (1, "1 passed, 1 failed")


def test_a_sanitizer_report_is_a_failure(tmp_path):
    assert tally(tmp_path, {"unit.sanitized": ("sanitizer", junit(a=""))}) == (1, "1 passed, 1 failed")


def test_a_runner_without_report_is_a_failure(tmp_path):
    assert tally(tmp_path, {"http.sanitized": (0, None)}) == (1, "0 passed, 1 failed")


def test_a_broken_report_is_a_failure(tmp_path):
    assert tally(tmp_path, {"http.sanitized": (139, "<testsuites>")}) == (1, "0 passed, 1 failed")


def test_a_runner_that_ran_nothing_is_a_failure(tmp_path):
    assert tally(tmp_path, {"http.sanitized": (0, junit())}) == (1, "0 passed, 1 failed")


def test_a_failed_build_is_a_failure(tmp_path):
    assert tally(tmp_path, {"build.release": (1, None)}) == (1, "0 passed, 1 failed")


def test_skipped_cases_do_not_count_as_passed(tmp_path):
    assert tally(tmp_path, {"http.sanitized": (0, junit(a="<skipped/>", b=""))}) == (0, "1 passed, 0 failed")


def test_nothing_at_all_is_a_failure(tmp_path):
    assert tally(tmp_path, {}) == (1, "0 passed, 0 failed")
