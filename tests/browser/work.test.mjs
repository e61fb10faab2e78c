/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a person does: asks, is put right, compares, cites, comes back by a link, by keyboard alone. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import { accessibility, answered, makeBed, saved, settled } from './bed.mjs';

let bed;
before(async () => { bed = await makeBed(); });
after(() => bed.end());

const field = (page, name) => page.locator(`[data-field="${name}"] input[type="text"]`).first();

/* The catenary's own closed form gives the span's parameter; the ratio is Gale's, recomputed with 220 bits:
 * tests/cases/gale_table_B-3.json, h/b = 0, sag parameter 0.9679. */
const RATIO = 6.6655371502987847;

test('a new user finds, sees and cites a first frequency', async () => {
  const page = await bed.open('/');
  await settled(page);
  await field(page, 'span_m').fill('100');
  await field(page, 'length_m').fill(String(100 / 0.9679));
  await page.waitForFunction(() => document.querySelector('.tables')?.textContent.includes('6.66554'));
  const json = await saved(page, () => page.locator('.cite').getByRole('button', { name: 'JSON' }).click());
  const answer = JSON.parse(json.data);
  assert.ok(Math.abs(answer.result.in_plane[0].frequency_ratio / RATIO - 1) < 1e-10);
  const shown = await page.locator('.figure-of .value').first().textContent();
  assert.equal(parseFloat(shown), Number(answer.result.in_plane[0].frequency_Hz.toPrecision(6)));
  await page.getByText('Cite, repeat, check').click();
  const address = await page.locator('a.address').getAttribute('href');
  assert.equal(address, `/v1/results/${answer.meta.key}`);
  const curl = await page.locator('.cite code.curl').textContent();
  const [, body, url] = curl.match(/^curl -s --json '(.*)' (\S+)$/);
  const repeated = await fetch(url, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body });
  assert.deepEqual(await repeated.json(), answer);
  const citation = await page.locator('.citation').textContent();
  for (const part of [answer.meta.key, `solver number ${answer.meta.solver_number}`, curl]) assert.ok(citation.includes(part), part);
  await page.close();
  bed.noFaults();
});

test('a faulty field is explained where it stands', async () => {
  const page = await bed.open('/');
  await settled(page);
  await field(page, 'modes').fill('500');
  await field(page, 'span_m').fill('wide');
  const modes = page.locator('[data-field="modes"]');
  /* Each change is a question of its own, and the first answer knows of one fault only. */
  await page.locator('.trouble li').nth(1).waitFor();
  assert.match(await modes.locator('.fault').textContent(), /200/);
  assert.equal(await field(page, 'modes').getAttribute('aria-invalid'), 'true');
  assert.ok((await field(page, 'modes').getAttribute('aria-describedby')).includes(await modes.locator('.fault').getAttribute('id')));
  assert.match(await page.locator('[data-field="span_m"] .fault').textContent(), /number/);
  assert.equal(await page.locator('.trouble li').count(), 2);
  assert.deepEqual(await accessibility(page), []);
  await field(page, 'modes').fill('3');
  await field(page, 'span_m').fill('100');
  await page.locator('.trouble').waitFor({ state: 'hidden' });
  assert.equal(await modes.locator('.fault').isVisible(), false);
  await page.close();
  bed.noFaults();
});

test('only what is missing is called needed', async () => {
  const page = await bed.open('/');
  await settled(page);
  assert.equal(await page.locator('.needed:visible').count(), 0);
  await field(page, 'span_m').fill('');
  assert.equal(await page.locator('[data-field="span_m"] .needed').isVisible(), true);
  assert.equal(await field(page, 'span_m').getAttribute('placeholder'), 'e.g. 100');
  await page.close();
  bed.noFaults();
});

test('what a question gives stands open, the rest is folded away', async () => {
  const page = await bed.open('/');
  await settled(page);
  assert.equal(await field(page, 'mass_kg_per_m').isVisible(), true);
  assert.equal(await field(page, 'weight_N_per_m').isVisible(), false);
  await page.getByText(/^More: /).click();
  assert.equal(await field(page, 'weight_N_per_m').isVisible(), true);
  await page.close();
  bed.noFaults();
});

test('the branches of a sweep bear their optimum, and without one the page says what would', async () => {
  const page = await bed.open('/#/absorber/optimize');
  await settled(page);
  const figure = page.locator('[data-figure="damping_ratio"]');
  const csv = await saved(page, () => figure.getByRole('button', { name: 'CSV' }).click());
  const [head, first] = csv.data.toString().split('\r\n').map((line) => line.split(','));
  const at = head.indexOf('"optimum: R"');
  /* Levesque's cable with a hanging absorber: an independent program's optimum, api/examples/absorber_optimize.json. */
  assert.ok(Math.abs(first[at] / 15.73092312736357 - 1) < 1e-6);
  const loss = 0.2203533452362748;
  assert.ok(Math.abs(first[at + 1] / (loss / Math.hypot(1, loss)) - 1) < 1e-8);
  await page.locator('[data-field="sweep"] [data-field="variable"] input').fill('');
  await page.locator('[data-field="sweep"] [data-field="points"] input').first().fill('');
  await page.getByText('A sweep over one of the variables').waitFor();
  await page.close();
  bed.noFaults();
});

test('absorbers and matrices are compared with what was kept', async () => {
  for (const [path, key, label] of [['/absorber/optimize', 'damping_ratio', 'kept 1, mode 1'], ['/taut/matrix', 't12', 'kept 1']]) {
    const page = await bed.open(`/#${path}`);
    await settled(page);
    await page.getByRole('button', { name: 'Keep to compare' }).click();
    await page.locator(`[data-figure="${key}"] .u-legend`, { hasText: label }).waitFor();
    await page.close();
  }
  const page = await bed.open('/#/validation');
  await settled(page);
  assert.equal(await page.getByRole('button', { name: 'Keep to compare' }).count(), 0);
  await page.close();
  bed.noFaults();
});

test('a family of cases opens from its name, with every value', async () => {
  const page = await bed.open(`/#/validation?${encodeURIComponent('{"r":{"report":"sergev_iwan"}}')}`);
  await settled(page);
  await page.getByRole('button', { name: 'sergev_iwan/table 1' }).click();
  await page.locator('.tables caption', { hasText: 'values compared' }).or(page.locator('.tables summary', { hasText: 'values compared' })).first().waitFor();
  assert.equal(await page.locator('[data-field="family"] input').inputValue(), 'sergev_iwan_table_1');
  await page.close();
  bed.noFaults();
});

/* The files of the page, as they come over the wire; the answers that follow are as large as the question. */
test('the first load is small, and measured', async () => {
  const page = await bed.context.newPage();
  const session = await bed.context.newCDPSession(page);
  await session.send('Network.enable');
  await session.send('Network.setCacheDisabled', { cacheDisabled: true });
  const answers = new Set();
  let bytes = 0;
  let files = 0;
  session.on('Network.requestWillBeSent', ({ requestId, request }) => { if (new URL(request.url).pathname.startsWith('/v1/')) answers.add(requestId); });
  session.on('Network.loadingFinished', ({ requestId, encodedDataLength }) => {
    if (answers.has(requestId)) return;
    bytes += encodedDataLength;
    files += 1;
  });
  await page.goto(bed.address);
  await answered(page);
  const ms = await page.evaluate(() => performance.now());
  await page.close();
  console.log(`first load: ${Math.round(bytes / 1000)} kB in ${files} files, the first answer after ${Math.round(ms)} ms`);
  const [, told] = readFileSync(new URL('../../README.md', import.meta.url), 'utf8').match(/\| (\d+) kB in \d+ files/);
  assert.ok(Math.abs(bytes / 1000 / told - 1) < 0.1, `${bytes} bytes in ${files} files; README.md says ${told} kB`);
});

test('an impossible cable is explained', async () => {
  const page = await bed.open('/');
  await settled(page);
  await field(page, 'length_m').fill('90');
  await page.locator('.trouble', { hasText: 'There is no answer' }).waitFor();
  await bed.shot(page, 'impossible');
  await page.close();
  bed.noFaults();
});

test('a slider asks again as it moves', async () => {
  const page = await bed.open('/');
  await settled(page);
  const before_ = await page.locator('.figure-of .value').first().textContent();
  await page.locator('[data-field="length_m"] input[type="range"]').evaluate((slider) => {
    slider.value = 150;
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  });
  await page.waitForFunction((old) => document.querySelector('.figure-of .value').textContent !== old, before_);
  assert.notEqual(await field(page, 'length_m').inputValue(), '110');
  await page.close();
  bed.noFaults();
});

test('alternatives show their own fields only, and name what they need elsewhere', async () => {
  const page = await bed.open('/');
  await settled(page);
  const choice = page.locator('fieldset.group select').first();
  await choice.selectOption({ label: 'sag parameter' });
  assert.equal(await page.locator('[data-field="span_m"]').isVisible(), false);
  assert.equal(await page.locator('[data-field="sag_parameter"]').isVisible(), true);
  await field(page, 'sag_parameter').fill('0.7');
  await page.locator('.figure-of .value', { hasText: 'g/a' }).first().waitFor();
  await choice.selectOption({ label: 'span, unstretched length' });
  await page.locator('fieldset.group select:has(option:text-is("axial stiffness"))').first().selectOption({ label: 'axial stiffness' });
  await field(page, 'axial_stiffness_N').fill('');
  assert.equal(await page.locator('[data-field="axial_stiffness_N"] .needed').isVisible(), true);
  await page.close();
  bed.noFaults();
});

test('a link restores the view, with what was kept', async () => {
  const page = await bed.open('/');
  await settled(page);
  await page.getByRole('button', { name: 'Keep to compare' }).click();
  await field(page, 'length_m').fill('130');
  await page.waitForFunction(() => decodeURIComponent(location.hash).includes('"length_m":130'));
  await settled(page);
  const value = await page.locator('.figure-of .value').first().textContent();
  await page.locator('[data-figure="compare"] h3', { hasText: 'Cables compared' }).waitFor();
  const link = await page.evaluate(() => location.pathname + location.hash);
  const other = await bed.open(link);
  await settled(other);
  assert.equal(await other.locator('.figure-of .value').first().textContent(), value);
  assert.equal(await field(other, 'length_m').inputValue(), '130');
  assert.equal(await other.locator('.chip').count(), 1);
  await other.locator('[data-figure="compare"] h3', { hasText: 'Cables compared' }).waitFor();
  await bed.shot(other, 'compared');
  await other.close();
  await page.close();
  bed.noFaults();
});

test('a broken link opens the tab all the same', async () => {
  const page = await bed.open('/#/forced/tension?%7Bbroken');
  await settled(page);
  assert.equal(await page.getByRole('tab', { selected: true }).textContent(), 'Forced tension');
  await page.close();
  bed.noFaults();
});

test('tabs by keyboard', async () => {
  const page = await bed.open('/');
  await settled(page);
  await page.getByRole('tab', { selected: true }).focus();
  await page.keyboard.press('ArrowRight');
  assert.equal(await page.getByRole('tab', { selected: true }).textContent(), 'Forced tension');
  await answered(page);
  await page.keyboard.press('Home');
  assert.equal(await page.getByRole('tab', { selected: true }).textContent(), 'Catenary frequencies');
  await page.keyboard.press('Tab');
  assert.ok(await page.evaluate(() => document.getElementById('bench').contains(document.activeElement)));
  await page.close();
  bed.noFaults();
});

test('a slow answer can be cancelled', async () => {
  const page = await bed.open('/');
  await settled(page);
  /* The daemon is held up on its way, so that the test does not depend on how fast it is. */
  await page.route('**/v1/catenary/frequencies', () => {});
  await field(page, 'length_m').fill('120');
  await page.getByRole('button', { name: 'Cancel' }).click();
  await page.locator('.status', { hasText: 'Cancelled' }).waitFor();
  await page.unroute('**/v1/catenary/frequencies');
  await field(page, 'length_m').fill('121');
  await settled(page);
  await page.close();
  bed.noFaults();
});

test('a busy daemon is asked again', async () => {
  const page = await bed.open('/');
  await settled(page);
  let refused = 0;
  await page.route('**/v1/catenary/frequencies', (route) => {
    if (refused >= 2) return route.continue();
    refused += 1;
    return route.fulfill({ status: 503, headers: { 'Retry-After': '0' }, contentType: 'application/problem+json', body: '{"title":"busy","status":503}' });
  });
  await field(page, 'length_m').fill('140');
  await page.waitForFunction(() => decodeURIComponent(location.hash).includes('"length_m":140'));
  assert.equal(refused, 2);
  assert.equal(await page.locator('.trouble').isVisible(), false);
  await page.close();
  bed.noFaults();
});

test('a long computation tells how far it is', async () => {
  /* The stream of a long computation, sent by the test in place of the daemon's. */
  const answer = await (await fetch(`${bed.address}/v1/validation?family=levesque_table_4_1`)).json();
  const page = await bed.open('/');
  await settled(page);
  await page.route('**/v1/validation', (route) => route.fulfill({ contentType: 'text/event-stream',
    body: `event: progress\ndata: {"evaluations":7,"best":0.25,"text":"cases"}\n\nevent: result\ndata: ${JSON.stringify(answer)}\n\n` }));
  await page.getByRole('tab', { name: 'Validation' }).click();
  await page.locator('.status', { hasText: 'Answered' }).waitFor();
  assert.equal(await page.locator('.busy span').textContent(), '7 cases, best so far 0.25');
  assert.equal(await page.locator('.figure-of .value').first().textContent(), '3 of 3');
  await page.unroute('**/v1/validation');
  await page.close();
  bed.noFaults();
});

test('without a clipboard what would be copied is shown', async () => {
  const page = await bed.open('/');
  await settled(page);
  await page.evaluate(() => Object.defineProperty(navigator, 'clipboard', { value: undefined }));
  await page.getByRole('button', { name: 'Copy curl' }).click();
  await page.locator('.said', { hasText: 'the curl line is shown below' }).waitFor();
  assert.equal(await page.locator('.cite code.curl').isVisible(), true);
  await page.getByRole('button', { name: 'Copy link' }).click();
  await page.locator('.said', { hasText: 'in the address bar' }).waitFor();
  await page.close();
  bed.noFaults();
});

test('colours follow the button, and are kept', async () => {
  const page = await bed.open('/');
  await settled(page);
  await page.getByRole('button', { name: 'Switch to dark colours' }).click();
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
  await page.reload();
  await settled(page);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
  await page.getByRole('button', { name: 'Switch to light colours' }).click();
  await page.close();
  bed.noFaults();
});
