// SPDX-License-Identifier: GPL-3.0-or-later
// Questions by the client that orval made. It knows no address but that of its page: fetch is told the daemon's.
import { batch, catenaryFrequencies, catenaryFrequenciesByQuery, forcedTensionByQuery, tautModes } from './api';
import type { CatenaryFrequenciesRequest } from './api';

export async function ask(daemon: string) {
  const plain = globalThis.fetch;
  globalThis.fetch = (path, options) => plain(new URL(String(path), daemon), options);
  const cable: CatenaryFrequenciesRequest = { span_m: 100, length_m: 101, modes: 3 };
  const posted = await catenaryFrequencies(cable);
  if (posted.status !== 200 || typeof posted.data === 'string') throw new Error(`status ${posted.status}`);
  const first: number | undefined = posted.data.result.in_plane?.[0]?.frequency_ratio;
  const got = await catenaryFrequenciesByQuery({ span_m: 100, length_m: 101, modes: 3 });
  const forced = await forcedTensionByQuery({ sag_parameter: 0.9, frequency_ratios: [0.5, 1, 2] });
  const refused = await catenaryFrequencies({ span_m: 100, length_m: 90 });
  const faulty = await catenaryFrequenciesByQuery({ sag_parameter: 0.9, modes: 0 });
  const chain = await tautModes({ tension_N: 5000, modes: 2, components: [{ type: 'cable', length_m: 20, mass_kg_per_m: 1 },
    { type: 'point_mass', mass_kg: 3 }, { type: 'cable', length_m: 20, mass_kg_per_m: 1 }] });
  // where a body may be of two types, it names neither
  const lines = await batch([{ path: '/v1/catenary/frequencies', request: { sag_parameter: 0.9 } }],
    { headers: { 'Content-Type': 'application/json' } });
  if (lines.status !== 200) throw new Error(lines.data.detail);
  return { posted: posted.data, first, got: got.data, forced: forced.data, chain: chain.data,
    refused: refused.status === 422 ? refused.data.detail : undefined,
    faulty: faulty.status === 400 ? faulty.data.errors?.[0]?.pointer : undefined, lines: await lines.stream.text() };
}

// @ts-expect-error: a name that no field has
export const typo: CatenaryFrequenciesRequest = { span_m: 100, lenght_m: 101, length_m: 101 };
// @ts-expect-error: no length
export const none: CatenaryFrequenciesRequest = { span_m: 100, modes: 3 };
