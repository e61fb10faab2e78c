/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A daemon and a browser for the tests. STRUMD names the program, CHROMIUM the browser, SHOTS where screenshots go. */
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { chromium } from 'playwright-core';

const ROOT = new URL('../..', import.meta.url).pathname;
const PROGRAM = process.env.STRUMD ?? join(ROOT, 'build/src/strumd');
const SHOTS = process.env.SHOTS ?? join(ROOT, 'build-test/screenshots');
const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const FLAGS = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--disable-sync'];

async function startDaemon() {
  const process_ = spawn(PROGRAM, ['--listen', '127.0.0.1:0'], { stdio: ['ignore', 'ignore', 'pipe'] });
  const address = await new Promise((done, fail) => {
    let said = '';
    process_.stderr.on('data', (data) => {
      said += data;
      const line = said.split('\n').find((one) => one.includes('"listening"'));
      if (line) done(`http://127.0.0.1:${JSON.parse(line.slice(line.indexOf('{'))).port}`);
    });
    process_.on('exit', () => fail(new Error(`strumd ended: ${said}`)));
  });
  return { address, process: process_ };
}

export async function makeBed() {
  mkdirSync(SHOTS, { recursive: true });
  const daemon = await startDaemon();
  const profile = mkdtempSync(join(tmpdir(), 'strum-browser-'));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: FLAGS, viewport: { width: 1400, height: 1000 }, acceptDownloads: true });
  context.setDefaultTimeout(60000);
  const faults = [];

  /* A page on which every error and every request to anybody else is a fault. */
  async function open(path, options = {}) {
    const page = await context.newPage();
    page.on('pageerror', (error) => faults.push(`${path}: ${error.stack}`));
    page.on('console', (message) => {
      /* A refused question is the browser's to mention; the page explains it at the field, or asks again where the daemon is busy. */
      if (['error', 'warning'].includes(message.type()) && !/status of (4\d\d|503)/.test(message.text())) faults.push(`${path}: ${message.text()}`);
    });
    page.on('request', (request) => {
      if (!/^(data|blob):/.test(request.url()) && !request.url().startsWith(daemon.address)) faults.push(`${path}: asks ${request.url()}`);
    });
    if (options.dark) await page.emulateMedia({ colorScheme: 'dark' });
    if (options.width) await page.setViewportSize({ width: options.width, height: options.height ?? 900 });
    await page.goto(daemon.address + path);
    return page;
  }
  return {
    address: daemon.address,
    context,
    open,
    shot: (page, name) => page.screenshot({ path: join(SHOTS, `${name}.png`), fullPage: true }),
    noFaults() {
      assert.deepEqual(faults.splice(0), []);
    },
    async end() {
      await context.close();
      rmSync(profile, { recursive: true, force: true });
      daemon.process.removeAllListeners('exit');
      const ended = new Promise((done) => { daemon.process.on('exit', done); });
      daemon.process.kill('SIGTERM');
      assert.equal(await ended, 0);
    },
  };
}

/* Serious findings of axe-core, in light and in dark; evaluated, since the page's policy forbids foreign scripts. */
export async function accessibility(page) {
  await page.evaluate(AXE);
  const serious = [];
  for (const colorScheme of ['dark', 'light']) {
    await page.emulateMedia({ colorScheme });
    const found = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ['violations'] }));
    serious.push(...found.violations.filter((one) => ['serious', 'critical'].includes(one.impact))
      .map((one) => `${colorScheme}: ${one.id}: ${one.nodes.slice(0, 3).map((node) => `${node.html} ${node.failureSummary}`).join('\n')}`));
  }
  return serious;
}

export async function answered(page) {
  await page.locator('.status', { hasText: 'Answered' }).waitFor();
}

/* The address bar holds the view a moment after the answer: all that follows an answer is then under way. */
export async function settled(page) {
  await answered(page);
  await page.locator('.tables h2').waitFor();
}

/* Chromium drops, without a word, the eleventh download that a frame begins within a second, and a page loaded anew keeps its frame
 * with the count: findings/chromium_download_burst.sh. Only another page begins at nought. A test that asks one page for more would
 * pass on a slow machine and wait in vain on a fast one: it is stopped on both. */
const DOWNLOADS = 10;
const downloads = new WeakMap();

/* What a click saves. An error of the page ends the wait for a download that then does not come. */
export async function saved(page, click) {
  const begun = (downloads.get(page) ?? 0) + 1;
  assert.ok(begun <= DOWNLOADS, `more than ${DOWNLOADS} downloads of one page: open another`);
  downloads.set(page, begun);
  let fail;
  const fault = new Promise((done, refuse) => { fail = refuse; });
  page.on('pageerror', fail);
  try {
    const [download] = await Promise.race([fault, Promise.all([page.waitForEvent('download'), click()])]);
    return { name: download.suggestedFilename(), data: readFileSync(await download.path()) };
  } finally {
    page.off('pageerror', fail);
  }
}

/* How many different colours a canvas shows: 1 is an empty one. */
export function coloursOf(canvas) {
  return canvas.evaluate((node) => {
    const { data } = node.getContext('2d').getImageData(0, 0, node.width, node.height);
    return new Set(new Uint32Array(data.buffer)).size;
  });
}
