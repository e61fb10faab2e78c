# SPDX-License-Identifier: GPL-3.0-or-later
"""doc/misuses.md as data, and back: `python3 tests/http/misuses.py URL` writes the texts of the daemon at URL into it.

An entry of the list is a heading, a line `POST path`, the request in a fence, and the texts that come as quotes.
"""
import json
import pathlib
import re
import sys

DOCUMENT = pathlib.Path(__file__).resolve().parents[2] / "doc/misuses.md"
ENTRY = re.compile(r"### (.+)\n\n`POST (\S+)`\n\n```json\n(.+?)\n```\n\n((?:> .*\n(?:\n|\Z)?)*)")


def entries():
    """(title, path, request, texts) of each entry."""
    text = DOCUMENT.read_text(encoding="utf-8")
    found = [(title, path, json.loads(body), re.findall(r"^> (.*)$", quotes, re.M))
             for title, path, body, quotes in ENTRY.findall(text)]
    assert len(found) == text.count("\n### "), "an entry of doc/misuses.md cannot be read"
    return found


def texts_of(answer):
    """What an answer says beside its figures: warnings, or what is wrong and where."""
    if "errors" in answer or "status" in answer:
        return [answer["detail"]] + [f"{error['pointer']}: {error['detail']}" for error in answer.get("errors", [])]
    return answer["warnings"]


def rewrite(ask):
    """The document with the texts that `ask(path, request)` answers."""
    def entry(match):
        title, path, body, _ = match.groups()
        quotes = "\n".join(f"> {text}\n" for text in texts_of(ask(path, json.loads(body))))
        return f"### {title}\n\n`POST {path}`\n\n```json\n{body}\n```\n\n{quotes}\n"
    return ENTRY.sub(entry, DOCUMENT.read_text(encoding="utf-8")).rstrip("\n") + "\n"


if __name__ == "__main__":
    import requests
    DOCUMENT.write_text(rewrite(lambda path, body: requests.post(sys.argv[1] + path, json=body, timeout=60).json()),
                        encoding="utf-8")
