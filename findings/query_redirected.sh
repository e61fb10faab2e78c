#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A redirected QUERY arrives in five ways, in two of them as a QUERY that asks nothing.
#
# QUERY (RFC 10008) with content, answered with 301, 302, 303, 307 or 308 to another place on the same server.
# One would guess: 303 turns it into GET; all the others repeat method and content, since only POST was ever turned into GET by 301 and 302.
# What happens: fetch, axios and got do that. curl -L with -X QUERY repeats QUERY on 301, 302 and 303, but without the content: the server
#   is asked an empty question. Python's requests does so on 301 alone; on 302 it asks GET. superagent asks GET on both. needle asks GET on
#   all five, 307 and 308 too, where the method must not change. None of them says anything.
# What follows: a service that is moved behind a redirect should answer QUERY with 308 (or 307), and refuse a QUERY without content.
# Seen with curl 7.88.1 and python3-requests 2.28.1 (Debian 12), superagent 10.4.2, needle 3.5.0, axios 1.21.1, got 14.6.6 and the fetch of
#   node 20.20.2, on 2026-11-28.
#
# Needs Debian 12's python3-requests and curl, node and npm. Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
/usr/bin/python3 -c 'import requests' || { echo "apt-get install python3-requests" >&2 && exit 2; }
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
npm install --prefix "$place" --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=error \
    superagent@10.4.2 needle@3.5.0 axios@1.21.1 got@14.6.6 >&2 || exit 2

cat >"$place/try.mjs" <<'TRY'
import { execFile } from 'node:child_process';
import { createServer } from 'node:http';
import { promisify } from 'node:util';
import axios from 'axios';
import got from 'got';
import needle from 'needle';
import superagent from 'superagent';

const server = createServer((request, response) => {
  let content = '';
  request.on('data', (part) => { content += part; }).on('end', () => {
    const code = Number(request.url.slice(1));
    if (code) response.writeHead(code, { Location: '/' }).end();
    else response.writeHead(200, { 'Content-Type': 'text/plain' }).end(content ? `${request.method}+content` : request.method);
  });
});
await new Promise((done) => { server.listen(0, '127.0.0.1', done); });
const run = async (...command) => (await promisify(execFile)(command[0], command.slice(1))).stdout.trim();
const body = '{"span_m": 100}';
const headers = { 'Content-Type': 'application/json' };
const python = 'import sys, requests; print(requests.request("QUERY", sys.argv[1], data=sys.argv[2]).text)';
const clients = {
  fetch: async (url) => (await fetch(url, { method: 'QUERY', body, headers })).text(),
  axios: async (url) => (await axios({ url, method: 'QUERY', data: body, headers })).data,
  got: async (url) => (await got(url, { method: 'QUERY', body, headers })).body,
  curl: (url) => run('curl', '-s', '-L', '-X', 'QUERY', '--data', body, url),
  requests: (url) => run('/usr/bin/python3', '-c', python, url, body),
  superagent: async (url) => (await superagent('QUERY', url).set(headers).send(body)).text,
  needle: async (url) => String((await needle('query', url, body, { headers, follow_max: 2 })).body),
};
const same = 'QUERY+content';
const wanted = {
  fetch: [same, same, 'GET', same, same],
  axios: [same, same, 'GET', same, same],
  got: [same, same, 'GET', same, same],
  curl: ['QUERY', 'QUERY', 'QUERY', same, same],
  requests: ['QUERY', 'GET', 'GET', same, same],
  superagent: ['GET', 'GET', 'GET', same, same],
  needle: ['GET', 'GET', 'GET', 'GET', 'GET'],
};
const curl = (await run('curl', '--version')).split(' ', 2).join(' ');
console.log(`${curl}, node ${process.versions.node}; QUERY with content after 301, 302, 303, 307, 308:`);
for (const [name, ask] of Object.entries(clients)) {
  const arrived = [];
  for (const code of [301, 302, 303, 307, 308]) arrived.push(await ask(`http://127.0.0.1:${server.address().port}/${code}`));
  const as = arrived.join() === wanted[name].join();
  if (!as) process.exitCode = 1;
  console.log(`  ${name}: ${arrived.join(', ')}${as ? '' : `: CHANGED, was ${wanted[name].join(', ')}`}`);
}
server.closeAllConnections();
server.close();
TRY
node "$place/try.mjs"
