# SPDX-License-Identifier: GPL-3.0-or-later
"""tests/cases/run against a server that gives prepared answers: right ones must pass, wrong ones must fail."""
import base64
import copy
import http.server
import json
import pathlib
import subprocess
import threading

import pytest

RUNNER = pathlib.Path(__file__).parent.parent / "cases" / "run"
ANSWER = {
    "request": {"modes": 2},
    "result": {
        "modes": [{"f": 2.0, "d": 0.5, "symmetry": "symmetric"}, {"f": 3.0, "d": 0.25, "symmetry": "none"}],
        "shape": [{"u": 0.0, "v": -2.0}, {"u": 0.5, "v": 1.0}],
        "entries": [{"re": 1.0, "im": -1.0}, {"re": 0.0, "im": 2.0}],
        "flag": True,
        "overdamped": [],
    },
    "warnings": [],
    "meta": {"key": "k", "solver": "s", "theory": "t"},
}
PROBLEM = {"type": "about:blank", "title": "Bad Request", "status": 400, "detail": "two fields are wrong",
           "errors": [{"pointer": "/a", "detail": "unknown; did you mean b?"}, {"pointer": "/c/0", "detail": "above 5"}]}


@pytest.fixture
def server():
    """Answers every POST with what `reply` holds, and keeps the bodies it was sent."""
    class Handler(http.server.BaseHTTPRequestHandler):
        def do_POST(self):
            status, kind, body = server.reply
            server.bodies.append(self.rfile.read(int(self.headers["Content-Length"])))
            self.send_response(status)
            self.send_header("Content-Type", kind)
            self.end_headers()
            self.wfile.write(body if isinstance(body, bytes) else json.dumps(body).encode())

        def log_message(self, *_):
            pass

    server = http.server.HTTPServer(("127.0.0.1", 0), Handler)
    server.bodies = []
    server.reply = (200, "application/json", ANSWER)
    thread = threading.Thread(target=server.serve_forever, args=(0.01,))
    thread.start()
    yield server
    server.shutdown()
    thread.join()
    server.server_close()


@pytest.fixture
def run(server, tmp_path):
    """Runs one case (or a list of cases) and says whether the runner passed it, checking its last line."""
    def run(case, *options, **file):
        cases = case if isinstance(case, list) else [case]
        cases = [{"id": str(k), "family": "f", "request": {}, **one} for k, one in enumerate(cases)]
        path = tmp_path / "file.json"
        path.write_text(json.dumps({"endpoint": "/v1/x", "title": "t", "source": "s", **file, "cases": cases}))
        done = subprocess.run([RUNNER, f"http://127.0.0.1:{server.server_port}", path, *options],
                              capture_output=True, text=True)
        assert not done.stderr, done.stderr
        last = done.stdout.splitlines()[-1]
        assert (done.returncode == 0) == last.endswith(" 0 failed")
        return last
    return run


GOOD, BAD = "1 passed, 0 failed", "0 passed, 1 failed"
EXPECTATIONS = [
    # what is expected of ANSWER, and whether it is so
    ({"pointer": "/result/modes/0/f", "value": 2.0000001, "relative": 1e-7}, GOOD),
    ({"pointer": "/result/modes/0/f", "value": 2.0000001, "relative": 1e-8}, BAD),
    ({"pointer": "/result/modes/0/f", "value": 2.1, "absolute": 0.11}, GOOD),
    ({"pointer": "/result/modes/0/f", "value": 2.1, "absolute": 0.09}, BAD),
    ({"pointer": "/result/modes/0/f", "value": 2}, GOOD),
    ({"pointer": "/result/modes/0/f", "value": 2.0000000000000004}, BAD),
    ({"pointer": "/result/modes/2/f", "value": 2, "relative": 1}, BAD),
    ({"pointer": "/result/modes/0/nothing", "value": 2, "relative": 1}, BAD),
    ({"pointer": "/result/modes/0/symmetry", "value": 2, "relative": 1}, BAD),
    ({"pointer": "/result/modes/0/symmetry", "value": "symmetric"}, GOOD),
    ({"pointer": "/result/modes/0/symmetry", "value": "antisymmetric"}, BAD),
    ({"pointer": "/result/flag", "value": True}, GOOD),
    ({"pointer": "/result/flag", "value": 1}, BAD),
    ({"pointer": "/result/flag", "value": 1, "relative": 1}, BAD),
    ({"pointer": "/result/modes/*/f", "values": [2, 3], "relative": 1e-15}, GOOD),
    ({"pointer": "/result/modes/*/f", "values": [3, 2], "relative": 1e-15}, BAD),
    ({"pointer": "/result/modes/*/f", "values": [2], "relative": 1e-15}, BAD),
    ({"pointer": "/result/modes/*/f", "values": [2, 3, 4], "relative": 1e-15}, BAD),
    ({"pointer": "/result/modes/*/symmetry", "values": ["symmetric", "none"]}, GOOD),
    ({"pointer": "/result/shape/*/v", "values": [-2.02, 1.02], "of_largest": 0.011}, GOOD),
    ({"pointer": "/result/shape/*/v", "values": [-2.02, 1.03], "of_largest": 0.011}, BAD),
    # complex numbers: the distance counts, relative to the magnitude
    ({"pointer": "/result/modes/*", "members": ["d", "f"], "values": [[0.5, 2], [0.25, 3.0001]], "relative": 1e-4}, GOOD),
    ({"pointer": "/result/modes/*", "members": ["d", "f"], "values": [[0.5, 2], [0.2501, 3.0003]], "relative": 1e-4}, BAD),
    ({"pointer": "/result/entries/*", "values": [[1, -1], {"re": 0, "im": 2}], "relative": 1e-15}, GOOD),
    ({"pointer": "/result/entries/*", "values": [[1, 1], [0, 2]], "relative": 1e-15}, BAD),
    # sets: any order, each beside another answer, further answers allowed
    ({"pointer": "/result/modes/*", "members": ["d", "f"], "matches": [[0.25, 3], [0.5, 2]], "relative": 1e-9}, GOOD),
    ({"pointer": "/result/modes/*", "members": ["d", "f"], "matches": [[0.25, 3]], "relative": 1e-9}, GOOD),
    ({"pointer": "/result/modes/*", "members": ["d", "f"], "matches": [[0.5, 2], [0.5, 2]], "relative": 1e-9}, BAD),
    ({"pointer": "/result/modes/*", "members": ["d", "f"], "matches": [[-0.5, 2]], "relative": 1e-9}, BAD),
    # one common factor
    ({"up_to_scale": [{"pointer": "/result/shape/*/u", "values": [0, -1], "of_largest": 1e-9},
                      {"pointer": "/result/shape/*/v", "values": [4, -2], "of_largest": 1e-9}]}, GOOD),
    ({"up_to_scale": [{"pointer": "/result/shape/*/u", "values": [0, 1], "of_largest": 1e-9},
                      {"pointer": "/result/shape/*/v", "values": [4, -2], "of_largest": 1e-9}]}, BAD),
    ({"up_to_scale": [{"pointer": "/result/shape/*/v", "values": [4, -2, 0], "of_largest": 1e-9}]}, BAD),
    ({"pointer": "/result/overdamped", "count": 0}, GOOD),
    ({"pointer": "/result/modes", "count": 1}, BAD),
    ({"pointer": "/result/modes/0/d", "below": 0.6}, GOOD),
    ({"pointer": "/result/modes/0/d", "below": 0.5}, BAD),
    ({"pointer": "/result/modes/0/d", "above": 0.4, "below": 0.45}, BAD),
    ({"pointer": "/result/modes/0/symmetry", "below": 1}, BAD),
    ({"pointer": "/result/modes/0/shape", "absent": True}, GOOD),
    ({"pointer": "/result/modes/0/f", "absent": True}, BAD),
    ({"pointer": "/result/modes/0/f"}, BAD),
    # printed values beside the right one
    ({"pointer": "/result/modes/0/f", "value": 2, "printed": {"value": "2.0", "verdict": "rounded"}}, GOOD),
    ({"pointer": "/result/modes/0/f", "value": 2, "printed": {"value": "2.1", "verdict": "rounded"}}, BAD),
    ({"pointer": "/result/modes/0/f", "value": 2, "printed": {"value": "2.1", "verdict": "last digit"}}, GOOD),
    ({"pointer": "/result/modes/0/f", "value": 2, "printed": {"value": "2.2", "verdict": "last digit"}}, BAD),
    ({"pointer": "/result/modes/0/f", "value": 2, "printed": {"value": "2.5", "verdict": "wrong", "why": "typo"}}, GOOD),
    ({"pointer": "/result/modes/0/f", "value": 2, "printed": {"value": "2.5", "verdict": "wrong"}}, BAD),
    ({"pointer": "/result/modes/0/f", "value": 2, "printed": {"value": "2.0", "verdict": "wrong", "why": "typo"}}, BAD),
    ({"pointer": "/result/modes/0/f", "value": 2, "printed": {"value": "2.5", "verdict": "fine"}}, BAD),
    ({"pointer": "/result/modes/*/f", "values": [2, 3],
      "printed": [{"value": "2", "verdict": "rounded"}, {"value": "3.3", "verdict": "from rounded input", "there": 3.26}]}, GOOD),
    ({"pointer": "/result/modes/*/f", "values": [2, 3],
      "printed": [{"value": "2", "verdict": "rounded"}, {"value": "3.3", "verdict": "from rounded input", "there": 3.1}]}, BAD),
]


@pytest.mark.parametrize("expect, outcome", EXPECTATIONS)
def test_expectation(run, expect, outcome):
    assert run({"expect": [expect]}) == outcome


def test_one_bad_expectation_among_good_ones_fails(run):
    good, bad = EXPECTATIONS[0][0], EXPECTATIONS[1][0]
    assert run([{"expect": [good, bad, good]}, {"expect": [good]}]) == "1 passed, 1 failed"


def test_tolerance_of_the_file_holds_where_the_case_states_none(run):
    near = {"expect": [{"pointer": "/result/modes/0/f", "value": 2.0000001}]}
    assert run(near, tolerance={"relative": 1e-7}) == GOOD
    assert run(near, tolerance={"relative": 1e-8}) == BAD


def test_a_case_without_expectation_fails(run):
    assert run({"expect": []}) == BAD


@pytest.mark.parametrize("reply", [
    (400, "application/problem+json", PROBLEM),
    (200, "text/html", ANSWER),
    (200, "application/json", b"<html>"),
    (200, "application/json", json.dumps(ANSWER).replace("2.0", "NaN").encode()),
    (200, "application/json", [1]),
    (200, "application/json", {**ANSWER, "result": None}),
    (200, "application/json", {"result": ANSWER["result"]}),
])
def test_a_malformed_answer_fails(run, server, reply):
    expect = {"pointer": "/result/modes/0/f", "value": 2, "relative": 1e-12}
    assert run({"expect": [expect]}) == GOOD
    server.reply = reply
    assert run({"expect": [expect]}) == BAD


REFUSED = {"status": 400, "errors": [{"pointer": "/a", "says": "did you mean b"}, {"pointer": "/c/0"}]}


def test_refusal(run, server):
    assert run(REFUSED) == BAD
    server.reply = (400, "application/problem+json", PROBLEM)
    assert run(REFUSED) == GOOD
    assert run({"status": 400, "detail": "two fields"}) == GOOD
    assert run({"status": 400, "detail": "three fields"}) == BAD
    assert run({**REFUSED, "status": 422}) == BAD
    assert run({**REFUSED, "errors": REFUSED["errors"][:1]}) == BAD
    assert run({**REFUSED, "errors": REFUSED["errors"] + [{"pointer": "/d"}]}) == BAD
    assert run({**REFUSED, "errors": [{"pointer": "/a", "says": "missing"}, {"pointer": "/c/0"}]}) == BAD


@pytest.mark.parametrize("change", [{"status": 422}, {"title": None}, {"errors": []}, {"errors": [{"pointer": "/a"}]}])
def test_an_incomplete_problem_fails(run, server, change):
    problem = copy.deepcopy(PROBLEM) | change
    server.reply = (400, "application/problem+json", {k: v for k, v in problem.items() if v is not None})
    assert run(REFUSED) == BAD


def test_a_problem_of_another_type_fails(run, server):
    server.reply = (400, "application/json", PROBLEM)
    assert run(REFUSED) == BAD


def test_bodies_are_sent_as_written(run, server):
    server.reply = (400, "application/problem+json", PROBLEM)
    run([{**REFUSED, "request": {"modes": 2}}, {**REFUSED, "body": '{"a": 01}'},
         {**REFUSED, "body_base64": base64.b64encode(b'{"\xff"}').decode()}])
    assert server.bodies == [b'{"modes": 2}', b'{"a": 01}', b'{"\xff"}']


def test_families_are_chosen(run):
    good, bad = EXPECTATIONS[0][0], EXPECTATIONS[1][0]
    cases = [{"family": "cable/a", "expect": [good]}, {"family": "cable/b", "expect": [bad]}]
    assert run(cases, "--family", "a$") == GOOD
    assert run(cases, "--family", "cable") == "1 passed, 1 failed"


def test_no_server_fails(tmp_path):
    path = tmp_path / "file.json"
    path.write_text(json.dumps({"endpoint": "/", "title": "t", "source": "s", "cases": [
        {"id": "0", "family": "f", "request": {}, "expect": [EXPECTATIONS[0][0]]}]}))
    done = subprocess.run([RUNNER, "http://127.0.0.1:1", path], capture_output=True, text=True)
    assert done.returncode == 1 and done.stdout.splitlines()[-1] == BAD


def test_no_case_and_the_same_name_twice_are_refused(tmp_path, server):
    path = tmp_path / "file.json"
    case = {"id": "0", "family": "f", "request": {}, "expect": [EXPECTATIONS[0][0]]}
    for cases in ([], [case, case]):
        path.write_text(json.dumps({"endpoint": "/", "title": "t", "source": "s", "cases": cases}))
        assert subprocess.run([RUNNER, f"http://127.0.0.1:{server.server_port}", path], capture_output=True).returncode == 1


def test_junit_report_names_every_case(run, tmp_path):
    good, bad = EXPECTATIONS[0][0], EXPECTATIONS[1][0]
    run([{"expect": [good]}, {"expect": [bad]}], "--junit", tmp_path / "report.xml")
    report = (tmp_path / "report.xml").read_text()
    assert report.count("<testcase") == 2 and report.count("<failure") == 1
