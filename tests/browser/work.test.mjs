/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a person does: asks, is put right, compares, cites, comes back by a link, by keyboard alone. */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { answered, makeBed, saved, settled } from './bed.mjs';

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
  assert.ok((await page.locator('.citation').textContent()).includes(answer.meta.key));
  await page.close();
  bed.noFaults();
});

test('a faulty field is explained where it stands', async () => {
  const page = await bed.open('/');
  await settled(page);
  await field(page, 'modes').fill('500');
  await field(page, 'span_m').fill('wide');
  const modes = page.locator('[data-field="modes"]');
  await modes.locator('.fault').waitFor();
  assert.match(await modes.locator('.fault').textContent(), /200/);
  assert.equal(await field(page, 'modes').getAttribute('aria-invalid'), 'true');
  assert.ok((await field(page, 'modes').getAttribute('aria-describedby')).includes(await modes.locator('.fault').getAttribute('id')));
  assert.match(await page.locator('[data-field="span_m"] .fault').textContent(), /number/);
  assert.equal(await page.locator('.trouble li').count(), 2);
  await field(page, 'modes').fill('3');
  await field(page, 'span_m').fill('100');
  await page.locator('.trouble').waitFor({ state: 'hidden' });
  assert.equal(await modes.locator('.fault').isVisible(), false);
  await page.close();
  bed.noFaults();
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
  assert.equal(await page.locator('[data-field="mass_kg_per_m"] .needed').isVisible(), true);
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
