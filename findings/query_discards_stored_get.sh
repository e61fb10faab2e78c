#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# HAProxy and undici throw a stored answer to GET away when somebody asks QUERY at the same place.
#
# GET, stored for a minute; then QUERY (RFC 10008) of the same URL with content; then GET again.
# One would guess: QUERY is safe, it changes nothing, so that what is stored for GET stays. Caches that do not know QUERY let it through.
# What happens: they let it through, and HAProxy 2.6 and undici's cache interceptor do more: the stored answer to GET is gone, and the
#   server is asked again. RFC 9111 tells a cache to do so after a method whose safety it does not know, so that it is right for both, and
#   every QUERY costs the next GET. Varnish 7.1, which does not know QUERY either, keeps the answer.
# What follows: answer QUERY at another path than what is to be stored for GET. A query string of its own is enough.
# Seen with haproxy 2.6.12-1+deb12u4, varnish 7.1.1-2+deb12u1 (Debian 12), undici 7.30.2, node 20.20.2, on 2026-11-28.
#
# Needs gcc (Varnish compiles its rules), node, npm, curl and apt-get. Exit status: 0 as described, 1 it has changed, 2 not to be tried.
set -euo pipefail
place=$(mktemp -d)
running=()
trap 'kill "${running[@]}" 2>/dev/null; wait; rm -rf "$place"' EXIT
(cd "$place" && apt-get download -qq -o APT::Sandbox::User=root haproxy=2.6.12-1+deb12u4 libopentracing1 libopentracing-c-wrapper0 \
    liblua5.3-0 varnish=7.1.1-2+deb12u1 libvarnishapi3=7.1.1-2+deb12u1 >&2) || exit 2
for package in "$place"/*.deb; do dpkg-deb -x "$package" "$place"; done
npm install --prefix "$place" --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=error undici@7.30.2 >&2 || exit 2
usr=$place/usr
export LD_LIBRARY_PATH=$usr/lib/x86_64-linux-gnu

cat >"$place/server.mjs" <<'SERVER'
import { createServer } from 'node:http';
let count = 0;
createServer((request, response) => {
  request.resume().on('end', () => response.writeHead(200, { 'Cache-Control': 'max-age=60' }).end(`${++count}`));
}).listen(0, '127.0.0.1', function ready() { console.log(this.address().port); });
SERVER
cat >"$place/undici.mjs" <<'CLIENT'
import { Agent, interceptors, request } from 'undici';
const dispatcher = new Agent().compose(interceptors.cache());
const ask = async (method, path, body) => (await request(process.argv[2] + path, { method, body, dispatcher })).body.text();
const said = [];
for (const [method, path] of [['GET', '/q'], ['GET', '/q'], ['QUERY', '/q?other'], ['GET', '/q'], ['QUERY', '/q'], ['GET', '/q']]) {
  said.push(await ask(method, path, method === 'GET' ? undefined : 'question'));
}
console.log(said.join(' '));
CLIENT
free() { node -e 'const s = require("net").createServer().listen(0, "127.0.0.1", () => { console.log(s.address().port); s.close(); })'; }
node "$place/server.mjs" >"$place/port" &
running+=($!)
for ((i = 0; i < 100; i++)); do [ -s "$place/port" ] && break || sleep 0.1; done
server=127.0.0.1:$(cat "$place/port")
haproxy=127.0.0.1:$(free)
cat >"$place/haproxy.cfg" <<CONF
defaults
    mode http
    timeout client 5s
    timeout server 5s
    timeout connect 2s
cache answers
    total-max-size 4
    max-age 60
frontend all
    bind $haproxy
    default_backend b
backend b
    http-request cache-use answers
    http-response cache-store answers
    server s $server
CONF
"$usr/sbin/haproxy" -db -f "$place/haproxy.cfg" >"$place/haproxy.log" 2>&1 &
running+=($!)
varnish=127.0.0.1:$(free)
printf 'vcl 4.1;\nbackend b { .host = "127.0.0.1"; .port = "%s"; }\n' "${server#*:}" >"$place/rules.vcl"
"$usr/sbin/varnishd" -F -j none -a "$varnish" -f "$place/rules.vcl" -n "$place/varnish" -s malloc,16m >"$place/varnish.log" 2>&1 &
running+=($!)
for address in "$haproxy" "$varnish"; do
    for ((i = 0; i < 200; i++)); do curl -s -o "$place/first" "http://$address/ready" && break || sleep 0.1; done
done

status=0
# The server numbers its answers. Asked: GET, GET, QUERY with a query string of its own, GET, QUERY at the same place, GET.
judge() { # judge NAME LOST NUMBERS: the last GET has another number than the first if LOST, the two between have the first one's
    local first second third last
    read -r first second _ third _ last <<<"$3"
    local lost=no as=
    [ "$last" = "$first" ] || lost=yes
    [ "$lost $second $third" = "$2 $first $first" ] || { as=": CHANGED" && status=1; }
    echo "  $1: answers $3: the stored GET is $([ "$lost" = yes ] && echo lost || echo kept)$as"
}
through() { # through ADDRESS: the six answers
    local get=(curl -s "http://$1/q") query=(curl -s -X QUERY --data question)
    echo "$("${get[@]}") $("${get[@]}") $("${query[@]}" "http://$1/q?other") $("${get[@]}") $("${query[@]}" "http://$1/q") $("${get[@]}")"
}
echo "GET, GET, QUERY elsewhere, GET, QUERY at the same place, GET:"
judge "$("$usr/sbin/haproxy" -v | grep -o 'version [0-9.]*' | sed 's/version/HAProxy/')" yes "$(through "$haproxy")"
judge "undici 7.30.2" yes "$(node "$place/undici.mjs" "http://$server")"
judge "Varnish 7.1.1" no "$(through "$varnish")"
exit "$status"
