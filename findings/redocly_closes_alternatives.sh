#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# redocly lint calls right examples wrong where an alternative of an object says `type: object`.
#
# In JSON Schema an object is open unless it says otherwise; an alternative in an allOf names the members that it is about, not all.
# One would guess: an example that every validator of JSON Schema takes is taken.
# What happens: for examples (rule no-invalid-media-type-examples, part of "recommended") every schema with type: object and without
#   unevaluatedProperties counts as closed, the alternatives too: each member of the example beyond theirs is a warning, 1,530 of them on
#   strumd's contract. unevaluatedProperties: true in the alternative says what JSON Schema says by itself, and the warnings are gone;
#   in an object that is closed by unevaluatedProperties: false that would open it, so there the alternative has to name every member.
# What follows: an alternative says either unevaluatedProperties: true, or all members.
# Seen with @redocly/cli 1.34.20, node 20.20.2, on 2026-11-28.
#
# Needs node and npm. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
npm install --prefix "$place" --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=error @redocly/cli@1.34.20 >&2 || exit 2
cd "$place"
export REDOCLY_TELEMETRY=off REDOCLY_SUPPRESS_UPDATE_NOTICE=true

warnings() { # warnings MORE: of a contract whose alternatives say MORE
    cat >contract.json <<CONTRACT
{"openapi": "3.1.0", "info": {"title": "t", "version": "1", "license": {"name": "n", "identifier": "MIT"}}, "servers": [{"url": "/"}], "security": [],
 "paths": {"/ask": {"post": {"operationId": "ask", "summary": "s", "responses": {"200": {"description": "d"}, "400": {"description": "d"}},
  "requestBody": {"content": {"application/json": {"example": {"a": 1, "x": 2}, "schema": {
   "type": "object", "properties": {"a": {"type": "number"}, "b": {"type": "number"}, "x": {"type": "number"}}, "additionalProperties": false,
   "allOf": [{"oneOf": [{"type": "object", "properties": {"a": {"type": "number"}}, "required": ["a"]$1},
                        {"type": "object", "properties": {"b": {"type": "number"}}, "required": ["b"]$1}]}]}}}}}}}}
CONTRACT
    node_modules/.bin/redocly lint contract.json --extends=recommended --format=json 2>/dev/null |
        node -e 'const s = require("fs").readFileSync(0, "utf8"); console.log(JSON.parse(s.slice(s.indexOf("{"))).problems.filter((one) => /examples/.test(one.ruleId)).length)'
}
bare=$(warnings '') opened=$(warnings ', "unevaluatedProperties": true')
echo "warnings about the example: $bare with type: object alone, $opened with unevaluatedProperties: true"
[ "$bare" -gt 0 ] && [ "$opened" -eq 0 ] && exit 0
echo "  CHANGED"
exit 1
