#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# @hey-api/openapi-ts takes an alternative without `type` for any object, and asks for nothing of it.
#
# "Either a, or b and c" is oneOf: [{required: [a]}, {required: [b, c]}] in an allOf beside the properties.
# One would guess: a union that asks for a, or for b and c.
# What happens: each alternative becomes { [key: string]: unknown }, and { b: 1 } compiles, which no server takes. With `type: object` and
#   the members' types in each alternative the union is right, and that is refused.
# What follows: a contract repeats types in its alternatives.
# Seen with @hey-api/openapi-ts 0.85.2 and typescript 5.9.3, node 20.20.2, on 2026-11-28.
#
# Needs node and npm. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
npm install --prefix "$place" --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=error \
    @hey-api/openapi-ts@0.85.2 typescript@5.9.3 >&2 || exit 2
cd "$place"

cat >contract.json <<'CONTRACT'
{"openapi": "3.1.0", "info": {"title": "t", "version": "1"},
 "paths": {"/ask": {"post": {"operationId": "ask", "responses": {"204": {"description": "d"}}, "requestBody": {"content": {"application/json": {
   "schema": {"oneOf": [{"$ref": "#/components/schemas/bare"}, {"$ref": "#/components/schemas/typed"}]}}}}}}},
 "components": {"schemas": {
  "bare": {"type": "object", "properties": {"a": {"type": "number"}, "b": {"type": "number"}, "c": {"type": "number"}},
           "additionalProperties": false, "allOf": [{"oneOf": [{"required": ["a"]}, {"required": ["b", "c"]}]}]},
  "typed": {"type": "object", "properties": {"a": {"type": "number"}, "b": {"type": "number"}, "c": {"type": "number"}},
            "additionalProperties": false, "allOf": [{"oneOf": [
              {"type": "object", "properties": {"a": {"type": "number"}}, "required": ["a"]},
              {"type": "object", "properties": {"b": {"type": "number"}, "c": {"type": "number"}}, "required": ["b", "c"]}]}]}}}}
CONTRACT
node_modules/.bin/openapi-ts --input ./contract.json --output ./made --plugins @hey-api/typescript >/dev/null 2>&1 || exit 2
cat >use.ts <<'USE'
import type { Bare, Typed } from './made/types.gen';
export const one: Bare = { b: 1 };
export const two: Bare = { a: 1, lenght: 2 };
export const three: Typed = { b: 1 };
export const four: Typed = { a: 1, lenght: 2 };
export const good: [Typed, Typed] = [{ a: 1 }, { b: 1, c: 2 }];
USE
refused=$(node_modules/.bin/tsc --strict --noEmit --moduleResolution bundler --module esnext use.ts | grep -o '^use.ts([0-9]*' | grep -o '[0-9]*' | tr '\n' ' ' || true)
echo "refused lines: $refused(2, 3: bare alternatives, a member short and a misspelt one; 4, 5: the same with types)"
[ "$refused" = "3 4 5 " ] && exit 0
echo "  CHANGED"
exit 1
