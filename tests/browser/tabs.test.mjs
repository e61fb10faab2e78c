/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every tab: it answers, draws, exports, is accessible, and asks nobody else. */
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { accessibility, coloursOf, makeBed, saved, settled } from './bed.mjs';

let bed;
let paths;
before(async () => {
  bed = await makeBed();
  const contract = await (await fetch(`${bed.address}/openapi.json`)).json();
  paths = Object.keys(contract.paths).filter((path) => contract.paths[path].post && contract.paths[path]['x-query']);
});
after(() => bed.end());

/* Endpoints that draw, and what each must at least show. */
const FIGURES = {
  '/v1/catenary/frequencies': ['motion', 'sag', 'compare'],
  '/v1/forced/tension': ['curve', 'motion', 'profiles'],
  '/v1/inclined/modes': ['motion', 'crossover', 'hybrid', 'amplification', 'compare'],
  '/v1/cable/statics': ['shape', 'tension'],
  '/v1/cable/modes': ['motion', 'shape', 'compare'],
  '/v1/taut/modes': ['motion', 'compare'],
  '/v1/taut/matrix': ['t12'],
  '/v1/absorber/optimize': ['damping_ratio', 'angular_frequency_rad_per_s'],
  '/v1/validation': ['margin'],
};

test('every endpoint of the contract has a tab', async () => {
  const page = await bed.open('/');
  await settled(page);
  assert.equal(await page.getByRole('tab').count(), paths.length);
  await page.close();
  bed.noFaults();
});

async function checkFigures(page, path) {
  for (const key of FIGURES[path] ?? []) {
    const figure = page.locator(`[data-figure="${key}"]`);
    await figure.locator('canvas').first().waitFor();
    await page.waitForFunction((name) => document.querySelector(`[data-figure="${name}"] canvas`)?.width > 0, key);
    assert.ok(await coloursOf(figure.locator('canvas').first()) > 3, `${path}: ${key} is empty`);
  }
}

async function drawn(path) {
  const page = await bed.open(`/#${path.slice(3)}`);
  await settled(page);
  await checkFigures(page, path);
  return page;
}

/* The exports of three figures, and the JSON, are as many downloads as one page may be asked for. */
async function checkExports(path) {
  let page = await drawn(path);
  const count = await page.locator('.figures figure').count();
  for (let i = 0; i < count; i += 1) {
    if (i > 0 && i % 3 === 0) {
      await page.close();
      page = await drawn(path);
    }
    const figure = page.locator('.figures figure').nth(i);
    await figure.waitFor();
    const png = await saved(page, () => figure.getByRole('button', { name: 'PNG' }).click());
    assert.equal(png.data.subarray(1, 4).toString(), 'PNG', path);
    const svg = await saved(page, () => figure.getByRole('button', { name: 'SVG' }).click());
    assert.match(svg.data.toString(), /^<svg .*(<path d="M[\d.]+ [\d.]+L|<circle )/s, path);
    assert.doesNotMatch(svg.data.toString(), /NaN|undefined/);
    const csv = await saved(page, () => figure.getByRole('button', { name: 'CSV' }).click());
    assert.ok(csv.data.toString().split('\r\n').length > 2, `${path}: ${csv.name} is empty`);
    assert.doesNotMatch(csv.data.toString(), /NaN|undefined/);
  }
  const json = await saved(page, () => page.locator('.cite').getByRole('button', { name: 'JSON' }).click());
  const answer = JSON.parse(json.data);
  assert.deepEqual(Object.keys(answer), ['request', 'result', 'warnings', 'meta']);
  return { page, answer };
}

test('each tab answers, draws, exports and is accessible', async (t) => {
  for (const path of paths) {
    await t.test(path, async () => {
      const { page, answer } = await checkExports(path);
      const again = await (await fetch(`${bed.address}/v1/results/${answer.meta.key}`)).json();
      assert.deepEqual(again, answer);
      await bed.shot(page, path.slice(4).replaceAll('/', '-'));
      assert.deepEqual(await accessibility(page), []);
      await page.close();
      bed.noFaults();
    });
  }
});

test('every preset is answered', async (t) => {
  for (const path of paths) {
    await t.test(`presets of ${path}`, async () => {
      const page = await bed.open(`/#${path.slice(3)}`);
      await settled(page);
      const presets = page.locator('.preset select');
      const count = await presets.locator('option').count();
      for (let i = 1; i < count; i += 1) {
        const asked = page.waitForResponse((response) => response.url() === bed.address + path);
        await presets.selectOption({ index: i });
        assert.equal((await asked).status(), 200, await presets.locator('option').nth(i).textContent());
      }
      await settled(page);
      assert.equal(await page.locator('.trouble').isVisible(), false);
      await page.close();
      bed.noFaults();
    });
  }
});

test('dark and narrow, each tab stays accessible and within its width', async (t) => {
  for (const path of paths) {
    await t.test(`dark and narrow: ${path}`, async () => {
      const page = await bed.open(`/#${path.slice(3)}`, { dark: true, width: 390 });
      await settled(page);
      await checkFigures(page, path);
      await bed.shot(page, `${path.slice(4).replaceAll('/', '-')}-narrow-dark`);
      assert.deepEqual(await accessibility(page), []);
      const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(over <= 0, `${over} pixels too wide`);
      await page.close();
      bed.noFaults();
    });
  }
});

test('the reference is accessible', async (t) => {
  for (const path of ['/docs', ...paths.map((one) => `/docs/${one.slice(4).replaceAll('/', '-')}`)]) {
    await t.test(`reference: ${path}`, async () => {
      const page = await bed.open(path);
      await bed.shot(page, path.slice(1).replaceAll('/', '-'));
      assert.deepEqual(await accessibility(page), []);
      await page.close();
      bed.noFaults();
    });
  }
});
