#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Chromium's limit of ten downloads a second outlives a reload of the page.
#
# Each download here is the click of a link with the attribute `download`, as pages export files.
# One would guess: a page may start as many as it likes, or the user is asked; what is refused is told (an error, a line in the
#   console, an event); and a page that is loaded anew begins with a clean slate.
# What happens: the eleventh within a second of the first is dropped. Nothing tells of it: no download, no error, no console line. The
#   count belongs to the frame, not to the document: a reload, and even about:blank and back, go on counting. Another tab counts anew, and
#   so does a page of another site in the same tab; a second's pause ends the count.
# What follows for a test: one that reloads its page "to be allowed more downloads" passes where the page loads slowly, and waits in vain
#   for its eleventh download where it loads fast.
# Seen with Chromium 156.0.8078.108 (Debian 12), playwright-core 1.61.1, on 2026-11-28.
#
# Needs node, npm and Debian's chromium (CHROMIUM names another). Exit status: 0 as described, 1 it has changed, 2 it could not be tried.
set -euo pipefail
browser=${CHROMIUM:-/usr/bin/chromium}
[ -x "$browser" ] || { echo "no $browser: apt-get install chromium" >&2 && exit 2; }
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
npm install --prefix "$place" --ignore-scripts --no-audit --no-fund --no-update-notifier --loglevel=error playwright-core@1.61.1 >&2 || exit 2

cat >"$place/try.mjs" <<'TRY'
import { createServer } from 'node:http';
import { chromium } from 'playwright-core';

const FILES = 12;
const page_ = '<!doctype html><title>downloads</title><link rel="icon" href="data:,"><p>a page';
const server = createServer((request, response) => response.writeHead(200, { 'Content-Type': 'text/html' }).end(page_));
await new Promise((done) => { server.listen(0, '127.0.0.1', done); });
const here = `http://127.0.0.1:${server.address().port}/`;
const elsewhere = here.replace('127.0.0.1', 'localhost');
const context = await chromium.launchPersistentContext('', {
  executablePath: process.argv[2], args: ['--headless', '--no-sandbox', '--disable-gpu'], acceptDownloads: true });

/* Half of the files, something between, the other half. Every one has begun, or never will, when one of a fresh tab has. */
async function attempt(between) {
  let page = await context.newPage();
  const begun = [];
  const said = [];
  const watch = (one) => {
    one.on('download', (download) => begun.push(download.suggestedFilename()));
    one.on('console', (message) => said.push(message.text()));
    one.on('pageerror', (error) => said.push(error.message));
  };
  watch(page);
  await page.goto(here);
  const began = performance.now();
  for (let i = 0; i < FILES; i += 1) {
    if (i === FILES / 2) {
      const next = await between(page);
      if (next) watch(page = next);
    }
    await page.evaluate((name) => {
      const link = Object.assign(document.createElement('a'), { href: URL.createObjectURL(new Blob([name])), download: name });
      document.body.append(link);
      link.click();
      link.remove();
    }, `file${i}`);
  }
  const ms = Math.round(performance.now() - began);
  const last = await context.newPage();
  await last.goto(here);
  await Promise.all([last.waitForEvent('download'), last.evaluate(() => {
    document.body.append(Object.assign(document.createElement('a'), { href: 'data:,x', download: 'last' }));
    document.querySelector('a').click();
  })]);
  await last.close();
  await page.close();
  return { begun: begun.length, ms, said };
}

const cases = [
  ['nothing between', 10, () => undefined],
  ['a reload between', 10, async (page) => { await page.reload(); }],
  ['about:blank and back between', 10, async (page) => { await page.goto('about:blank'); await page.goto(here); }],
  ['another site between', 12, async (page) => { await page.goto(elsewhere); }],
  ['another tab between', 12, async () => { const page = await context.newPage(); await page.goto(here); return page; }],
  ['more than a second between', 12, async (page) => { await page.waitForTimeout(1500); }],
];
console.log(`Chromium ${context.browser().version()}, ${FILES} downloads of one tab at once:`);
let status = 0;
for (const [name, expected, between] of cases) {
  const { begun, ms, said } = await attempt(between);
  const slow = expected === 10 && ms > 900;
  const as = begun === expected && said.length === 0;
  if (slow) status = Math.max(status, 2);
  else if (!as) status = 1;
  console.log(`  ${name}: ${begun} begun in ${ms} ms, ${said.length ? `said: ${said.join('; ')}` : 'nothing said'}${slow ? ': TOO SLOW TO TELL' : as ? '' : `: CHANGED, was ${expected}`}`);
}
await context.close();
server.close();
process.exitCode = status;
TRY
node "$place/try.mjs" "$browser"
