#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# openapi-typescript types an object with "at least one of these members" as unknown, and fields with defaults as needed.
#
# "At least one of a and b" is, in JSON Schema, anyOf: [{required: [a]}, {required: [b]}] beside the properties.
# One would guess: the type of the properties, perhaps without the condition.
# What happens: the anyOf is taken for other possibilities beside the properties, and typed unknown: the whole object is unknown, and
#   nothing of an answer may be read under tsc --strict. The same anyOf inside an allOf, with the properties repeated in its branches, is
#   typed rightly. Apart from that, a property with a default is typed as one that must be given, in requests too, unless
#   --default-non-nullable false; where one alternative excludes such a field (type never) no request can be written at all.
# What follows: a contract that says such conditions puts them into an allOf with their properties; callers pass the option.
# Seen with openapi-typescript 7.13.0 and typescript 5.9.3, node 20.20.2, on 2026-11-28.
#
# Needs node and npm. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
npm install --prefix "$place" --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=error \
    openapi-typescript@7.13.0 typescript@5.9.3 >&2 || exit 2
cd "$place"

cat >contract.json <<'CONTRACT'
{"openapi": "3.1.0", "info": {"title": "t", "version": "1"}, "paths": {}, "components": {"schemas": {
  "beside": {"type": "object", "properties": {"a": {"type": "number"}, "b": {"type": "number"}},
             "anyOf": [{"required": ["a"]}, {"required": ["b"]}]},
  "within": {"type": "object", "properties": {"a": {"type": "number"}, "b": {"type": "number"}},
             "allOf": [{"anyOf": [{"type": "object", "properties": {"a": {"type": "number"}}, "required": ["a"]},
                                  {"type": "object", "properties": {"b": {"type": "number"}}, "required": ["b"]}]}]},
  "defaulted": {"type": "object", "properties": {"g": {"type": "number", "default": 9.80665}}}}}}
CONTRACT
cat >use.ts <<'USE'
import type { components } from './schema';
type One = components['schemas'];
declare const beside: One['beside'], within: One['within'];
export const first: number | undefined = beside.a;
export const second: number | undefined = within.a;
export const empty: One['defaulted'] = {};
export const none: One['within'] = {};
USE
compile() { # compile OPTION...: the lines of use.ts that are refused
    node_modules/.bin/openapi-typescript contract.json -o schema.ts "$@" >/dev/null || exit 2
    node_modules/.bin/tsc --strict --noEmit use.ts | grep -o '^use.ts([0-9]*' | grep -o '[0-9]*' | tr '\n' ' ' || true
}
plain=$(compile) optional=$(compile --default-non-nullable false)
echo "refused lines: ${plain}by default, ${optional}with --default-non-nullable false"
echo "  (4: a member beside anyOf, 5: the same inside an allOf, 6: nothing given where there is a default, 7: neither of two)"
[ "$plain" = "4 6 7 " ] && [ "$optional" = "4 7 " ] && exit 0
echo "  CHANGED"
exit 1
