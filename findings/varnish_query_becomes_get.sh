#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Varnish told to cache QUERY asks the server GET, without the question, and gives its answer to every question.
#
# QUERY (RFC 10008) is safe, and its answer may be stored under the request's content. Varnish 7.1 stands before a server that answers with
#   the method and the content that reached it.
# One would guess: `if (req.method == "QUERY") { return (hash); }` in vcl_recv, as for any method that is to be cached, has QUERY asked and
#   stored; at worst the content has to be added to the hash.
# What happens: what is fetched to be stored is fetched with GET: the server sees GET with neither content nor Content-Length. Whatever it
#   says, 200 included, is stored and given to the next QUERY with another content, and to a GET. With std.cache_req_body() the content
#   arrives, but the method is GET all the same, and the second question still gets the first one's answer.
#   Left alone, Varnish 7.1 pipes QUERY, since it does not know it: the server is asked properly, but the client's connection ends with each
#   answer, and a server that closes leaves the client without a status, where a GET has a 503.
# What follows: return (pass) for QUERY: the server is asked properly, and the connection stays.
# Seen with varnish 7.1.1-2+deb12u1 (Debian 12), curl 7.88.1, node 20.20.2, on 2026-11-28.
#
# Needs gcc (Varnish compiles its rules), node, curl and apt-get. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
place=$(mktemp -d)
running=()
trap 'kill "${running[@]}" 2>/dev/null; wait; rm -rf "$place"' EXIT
(cd "$place" && apt-get download -qq -o APT::Sandbox::User=root varnish=7.1.1-2+deb12u1 libvarnishapi3=7.1.1-2+deb12u1 >&2) || exit 2
for package in "$place"/*.deb; do dpkg-deb -x "$package" "$place"; done
usr=$place/usr
libraries=$usr/lib/x86_64-linux-gnu

cat >"$place/server.mjs" <<'SERVER'
import { createServer } from 'node:http';
createServer((request, response) => {
  let content = '';
  request.on('data', (part) => { content += part; }).on('end', () => {
    if (request.url === '/close') request.socket.destroy();
    else response.writeHead(200, { 'Cache-Control': 'max-age=60' }).end(`${request.method} ${content || '-'}`);
  });
}).listen(0, '127.0.0.1', function ready() { console.log(this.address().port); });
SERVER
node "$place/server.mjs" >"$place/port" &
running+=($!)
for ((i = 0; i < 100; i++)); do [ -s "$place/port" ] && break || sleep 0.1; done
server=$(cat "$place/port")

varnish() { # varnish NAME RULES: starts one, its port in $port
    port=$(node -e 'const s = require("net").createServer().listen(0, "127.0.0.1", () => { console.log(s.address().port); s.close(); })')
    printf 'vcl 4.1;\nimport std;\nbackend b { .host = "127.0.0.1"; .port = "%s"; }\nsub vcl_recv { %s }\n' "$server" "$2" >"$place/$1.vcl"
    LD_LIBRARY_PATH=$libraries "$usr/sbin/varnishd" -F -j none -a "127.0.0.1:$port" -f "$place/$1.vcl" -n "$place/$1" -s malloc,16m \
        -p "vmod_path=$libraries/varnish/vmods" >"$place/$1.log" 2>&1 &
    running+=($!)
    for ((i = 0; i < 200; i++)); do curl -s -o "$place/first" "http://127.0.0.1:$port/ready" && return || sleep 0.1; done
    cat "$place/$1.log" >&2 && exit 2
}
ask() { curl -s -X "$1" ${2:+--data "$2"} "http://127.0.0.1:$port${3:-/question}"; }
status=0
expect() { # expect WHAT WANTED GOT
    [ "$2" = "$3" ] || status=1
    echo "  $1: $3$([ "$2" = "$3" ] || echo ": CHANGED, was $2")"
}
echo "$(LD_LIBRARY_PATH=$libraries "$usr/sbin/varnishd" -V 2>&1 | grep -o 'varnish-[0-9.]*' | head -1), what reached the server:"
varnish hash 'if (req.method == "QUERY") { return (hash); }'
expect "hash, QUERY one" "GET -" "$(ask QUERY one)"
expect "hash, QUERY two" "GET -" "$(ask QUERY two)"
expect "hash, GET" "GET -" "$(ask GET '')"
varnish body 'if (req.method == "QUERY") { std.cache_req_body(64KB); return (hash); }'
expect "hash and content, QUERY one" "GET one" "$(ask QUERY one)"
expect "hash and content, QUERY two" "GET one" "$(ask QUERY two)"
expect "hash and content, GET" "GET one" "$(ask GET '')"
varnish alone ''
expect "left alone, QUERY one" "QUERY one" "$(ask QUERY one)"
expect "left alone, QUERY two" "QUERY two" "$(ask QUERY two)"
expect "left alone, the client's connection" close "$(curl -si -X QUERY --data one "http://127.0.0.1:$port/a" | tr -d '\r' |
    sed -n 's/^Connection: //p')"
code() { curl -s -o "$place/body" -w '%{http_code}' "$@" "http://127.0.0.1:$port/close" || true; }
expect "the server closes, GET" 503 "$(code)"
expect "the server closes, QUERY" 000 "$(code -X QUERY --data one)"
varnish passed 'if (req.method == "QUERY") { return (pass); }'
expect "passed, QUERY one" "QUERY one" "$(ask QUERY one)"
expect "passed, QUERY two" "QUERY two" "$(ask QUERY two)"
expect "passed, the client's connection" keep-alive "$(curl -si -X QUERY --data one "http://127.0.0.1:$port/a" | tr -d '\r' |
    sed -n 's/^Connection: //p')"
exit "$status"
