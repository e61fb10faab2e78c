/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contract as its readers read it: validators, linters, and generators of clients, whose clients then ask a live
 * daemon. STRUMD names the program. */
import assert from 'node:assert/strict';
import { execFile, spawn } from 'node:child_process';
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { promisify } from 'node:util';
import { validate } from '@hyperjump/json-schema/openapi-3-1';
import '@hyperjump/json-schema/openapi-3-2';
import { build } from 'esbuild';

const HERE = new URL('.', import.meta.url).pathname;
const PROGRAM = process.env.STRUMD ?? join(HERE, '../../build/src/strumd');
const MADE = join(HERE, 'made');
const CLIENTS = ['openapi-fetch', 'hey-api', 'orval'];
const PATH = '/v1/catenary/frequencies';
const CABLE = { span_m: 100, length_m: 101, modes: 3 };
const CHAIN = { tension_N: 5000, modes: 2, components: [{ type: 'cable', length_m: 20, mass_kg_per_m: 1 }, { type: 'point_mass', mass_kg: 3 },
  { type: 'cable', length_m: 20, mass_kg_per_m: 1 }] };
/* Nobody is told that the tests ran, nor asked for a newer version. */
const QUIET = { ...process.env, REDOCLY_TELEMETRY: 'off', REDOCLY_SUPPRESS_UPDATE_NOTICE: 'true', NO_COLOR: '1' };
let daemon;

function startDaemon() {
  const child = spawn(PROGRAM, ['--listen', '127.0.0.1:0'], { stdio: ['ignore', 'ignore', 'pipe'] });
  return new Promise((done, fail) => {
    let said = '';
    child.stderr.on('data', (data) => {
      said += data;
      const line = said.split('\n').find((one) => one.includes('"listening"'));
      if (line) done({ address: `http://127.0.0.1:${JSON.parse(line.slice(line.indexOf('{'))).port}`, child });
    });
    child.on('exit', () => fail(new Error(`strumd ended: ${said}`)));
  });
}

/* Runs a tool of node_modules; its output counts when it fails. */
async function tool(name, ...words) {
  try {
    return (await promisify(execFile)(join(HERE, 'node_modules/.bin', name), words, { cwd: HERE, env: QUIET, maxBuffer: 1 << 26 })).stdout;
  } catch (error) {
    throw new Error(`${name} ${words.join(' ')}: ${error.code}\n${error.stdout}\n${error.stderr}`.slice(0, 20000));
  }
}

const served = async (path) => (await fetch(daemon.address + path)).text();
const post = async (path, body) =>
  (await fetch(daemon.address + path, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body) })).json();

before(async () => {
  daemon = await startDaemon();
  rmSync(MADE, { recursive: true, force: true });
  mkdirSync(MADE);
  for (const name of ['openapi.json', 'openapi-3.2.json']) writeFileSync(join(MADE, name), await served(`/${name}`));
});

after(() => daemon.child.kill());

for (const [version, file] of [['3.1', 'openapi.json'], ['3.2', 'openapi-3.2.json']]) {
  test(`/${file} is what the schema of OpenAPI ${version} says`, async () => {
    const document = JSON.parse(readFileSync(join(MADE, file), 'utf8'));
    const schema = `https://spec.openapis.org/oas/${version}/schema-base`;
    const good = await validate(schema, document, 'BASIC');
    assert.ok(good.valid, JSON.stringify(good.errors?.slice(0, 20), null, 1));
    /* A validator that takes everything would pass too: the fault that once was in the document. */
    document.paths['/readyz'].get.responses['200'].description = true;
    assert.equal((await validate(schema, document)).valid, false);
  });
}

test('@redocly/cli has nothing to say', async () => {
  const { totals } = JSON.parse(await tool('redocly', 'lint', 'made/openapi.json', '--extends=recommended', '--format=json'));
  assert.deepEqual({ errors: totals.errors, warnings: totals.warnings }, { errors: 0, warnings: 0 });
});

test('@stoplight/spectral-cli has nothing to say', async () => {
  await tool('spectral', 'lint', 'made/openapi.json', '--ruleset', 'spectral.yaml', '--fail-severity', 'hint');
});

test('clients are generated and compile strictly', async () => {
  /* Without that option a field that has a default must be given, and one of another group too: nothing would compile. */
  await tool('openapi-typescript', 'made/openapi.json', '--default-non-nullable', 'false', '--output', 'made/openapi-fetch/schema.ts');
  await tool('openapi-ts', '--input', './made/openapi.json', '--output', './made/hey-api');
  await tool('orval', '--input', 'made/openapi.json', '--output', 'made/orval/api.ts', '--client', 'fetch');
  for (const name of CLIENTS) cpSync(join(HERE, `${name}.ts`), join(MADE, name, 'ask.ts'));
  await tool('tsc', '--project', '.');
});

for (const name of CLIENTS) {
  test(`the client of ${name} asks by POST and by GET`, async () => {
    const outfile = join(MADE, name, 'ask.mjs');
    await build({ entryPoints: [join(MADE, name, 'ask.ts')], outfile, bundle: true, format: 'esm', platform: 'node', logLevel: 'error' });
    const plain = globalThis.fetch;
    const got = await import(outfile).then(({ ask }) => ask(daemon.address)).finally(() => { globalThis.fetch = plain; });
    const expected = await post(PATH, CABLE);
    assert.equal(expected.result.in_plane.length, 3);
    assert.deepEqual(got.posted, expected);
    assert.equal(got.first, expected.result.in_plane[0].frequency_ratio);
    assert.deepEqual(got.got, expected);
    assert.deepEqual(got.forced, await post('/v1/forced/tension', { sag_parameter: 0.9, frequency_ratios: [0.5, 1, 2] }));
    assert.deepEqual(got.chain, await post('/v1/taut/modes', CHAIN));
    assert.match(got.refused, /does not reach/);
    assert.equal(got.faulty, '/modes');
    assert.deepEqual(JSON.parse(got.lines), await post(PATH, { sag_parameter: 0.9 }));
  });
}

test('every endpoint takes in GET what its parameters say, one by one', async () => {
  const { paths } = JSON.parse(readFileSync(join(MADE, 'openapi.json'), 'utf8'));
  const asked = Object.entries(paths).filter(([, item]) => item['x-query'] && item.get);
  assert.ok(asked.length >= 4);
  for (const [path, item] of asked) {
    const own = item.get.parameters.filter((one) => one.in === 'query');
    assert.ok(own.length >= 2, path);
    for (const one of own) {
      const value = [one.example].flat().join(',');
      const answer = await (await fetch(`${daemon.address}${path}?${new URLSearchParams({ [one.name]: value })}`)).json();
      /* What is wrong with it is that other fields are missing or exclude it, never its own name or form. */
      for (const fault of answer.errors ?? []) {
        assert.ok(!/^unknown|^expected|query string/.test(fault.detail), `${path} ${one.name}=${value}: ${JSON.stringify(fault)}`);
      }
    }
  }
});
