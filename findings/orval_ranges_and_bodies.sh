#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# orval writes a TypeScript that does not parse where a response is "4XX", and sends no Content-Type where a body has two.
#
# "4XX" is OpenAPI's word for a range of statuses. One would guess: it is left out, or becomes a union.
# What happens: `status: 4XX`, and tsc stops at the file. Linters ask for just such an entry (redocly: operation-4xx-response); one named
#   status ("400") is fine. Where a body may be application/json or application/x-ndjson, the function sends JSON.stringify(body) without
#   a Content-Type, for which fetch says text/plain: a server that looks at it answers 415. The option headers is the way round.
# What follows: name statuses one by one; with orval pass { headers: { 'Content-Type': 'application/json' } } to POST /v1/batch.
# Seen with orval 7.13.2 and typescript 5.9.3, node 20.20.2, on 2026-11-28.
#
# Needs node and npm. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
npm install --prefix "$place" --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=error \
    orval@7.13.2 typescript@5.9.3 >&2 || exit 2
cd "$place"

contract() { # contract STATUS MORE: an operation that refuses by STATUS, its body of MORE types
    cat <<CONTRACT
{"openapi": "3.1.0", "info": {"title": "t", "version": "1"}, "paths": {"/ask": {"post": {"operationId": "ask",
 "requestBody": {"required": true, "content": {"application/json": {"schema": {"type": "array", "items": {"type": "number"}}}$2}},
 "responses": {"200": {"description": "d", "content": {"application/json": {"schema": {"type": "number"}}}},
               "$1": {"description": "d", "content": {"application/json": {"schema": {"type": "string"}}}}}}}}}
CONTRACT
}
generate() { # generate NAME STATUS MORE
    contract "$2" "$3" >"$1.json"
    node_modules/.bin/orval --input "./$1.json" --output "./$1.ts" --client fetch >/dev/null 2>&1 || exit 2
}
# errors of the parser have numbers below 2000
parses() {
    node_modules/.bin/tsc --noEmit --skipLibCheck "$1.ts" >said || true
    grep -q 'error TS1[0-9][0-9][0-9]:' said && echo fails || echo parses
}
types() { grep -c "'Content-Type': 'application/json'" "$1.ts" || true; }

generate range 4XX ''
generate status 400 ''
generate two 400 ', "application/x-ndjson": {"schema": {"type": "number"}}'
found="range $(parses range), status $(parses status); Content-Type with one type of body $(types status), with two $(types two)"
echo "$found"
[ "$found" = "range fails, status parses; Content-Type with one type of body 1, with two 0" ] && exit 0
echo "  CHANGED"
exit 1
