#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# nginx sends a request of a method it has never heard of to a second server, after the first may have carried it out.
#
# Two servers in an upstream, of which the first takes the request and closes without an answer.
# One would guess: proxy_next_upstream repeats what may be repeated. POST is not repeated, as the manual says of methods that are not
#   idempotent ("POST, LOCK, PATCH"), and a method that nginx does not know may be anything, so that it is not repeated either.
# What happens: the three named are all that is spared. Any other word of capitals, a RENDER or a SETTLE of one's own, is sent again, with
#   its content, to the next server, as GET is. For QUERY (RFC 10008), which is safe and which nginx 1.22 does not know either, that is
#   right, by luck. It can be stored by no setting: proxy_cache_methods takes GET, HEAD and POST.
# What follows: behind nginx a method of one's own must be idempotent, or `proxy_next_upstream off` stand for it.
# Seen with nginx 1.22.1-9+deb12u11 (Debian 12), curl 7.88.1, on 2026-11-28.
#
# Needs curl, python3 and apt-get. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
place=$(mktemp -d)
running=()
trap 'kill "${running[@]}" 2>/dev/null; wait; rm -rf "$place"' EXIT
(cd "$place" && apt-get download -qq -o APT::Sandbox::User=root nginx=1.22.1-9+deb12u11 libpcre2-8-0 libssl3 zlib1g libcrypt1 >&2) || exit 2
for package in "$place"/*.deb; do dpkg-deb -x "$package" "$place"; done
export LD_LIBRARY_PATH=$place/usr/lib/x86_64-linux-gnu:$place/lib/x86_64-linux-gnu

cat >"$place/server.py" <<'SERVER'
import socket
import sys
# Takes a request with its content, writes its first line, and closes. One socket stands for both servers.
listening = socket.create_server(("127.0.0.1", 0))
print(listening.getsockname()[1], flush=True)
while True:
    connection, _ = listening.accept()
    got = b""
    while b"\r\n\r\n" not in got or not got.endswith(b"question"):
        part = connection.recv(65536)
        if not part:
            break
        got += part
    if got:
        print(got.split(b" ", 1)[0].decode(), got.endswith(b"question"), flush=True)
    connection.close()
SERVER
python3 "$place/server.py" >"$place/seen" &
running+=($!)
for ((i = 0; i < 100; i++)); do [ -s "$place/seen" ] && break || sleep 0.1; done
server=$(head -1 "$place/seen")
port=$(python3 -c 'import socket; s = socket.create_server(("127.0.0.1", 0)); print(s.getsockname()[1])')
configuration() { # configuration NAME METHODS: nginx before the two servers
    cat >"$place/$1.conf" <<CONF
daemon off; master_process off; pid $place/pid; error_log $place/error.log;
events {}
http {
    access_log off;
    client_body_temp_path $place/a; proxy_temp_path $place/b; fastcgi_temp_path $place/c; uwsgi_temp_path $place/d; scgi_temp_path $place/e;
    proxy_cache_path $place/cache keys_zone=answers:1m;
    upstream both { server 127.0.0.1:$server max_fails=0; server 127.0.0.1:$server max_fails=0; }
    server {
        listen 127.0.0.1:$port;
        location / { proxy_pass http://both; proxy_cache answers; proxy_cache_methods $2; }
    }
}
CONF
}
nginx=$place/usr/sbin/nginx
configuration usual "GET HEAD"
"$nginx" -c "$place/usual.conf" 2>"$place/log" &
running+=($!)
for ((i = 0; i < 100; i++)); do (: <"/dev/tcp/127.0.0.1/$port") 2>"$place/no" && break || sleep 0.1; done
"$nginx" -v 2>&1
status=0
expect() { # expect TIMES METHOD: sent so often, each time with its content
    local before times
    before=$(wc -l <"$place/seen")
    curl -s -o "$place/answer" -X "$2" --data question "http://127.0.0.1:$port/" || true
    sleep 0.2
    times=$(tail -n +"$((before + 1))" "$place/seen" | grep -c "^$2 True" || true)
    [ "$times" = "$1" ] || status=1
    echo "  $2: sent $times time(s)$([ "$times" = "$1" ] || echo ": CHANGED, was $1")"
}
for method in POST LOCK PATCH; do expect 1 "$method"; done
for method in PUT DELETE QUERY RENDER SETTLE; do expect 2 "$method"; done
configuration query "GET HEAD QUERY"
if ! "$nginx" -t -c "$place/query.conf" 2>"$place/log" && grep -q 'invalid value "QUERY"' "$place/log"; then
    echo "  proxy_cache_methods QUERY: refused"
else
    echo "  proxy_cache_methods QUERY: CHANGED, was refused" && status=1
fi
exit "$status"
