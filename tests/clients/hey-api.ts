// SPDX-License-Identifier: GPL-3.0-or-later
// Questions by the client that @hey-api/openapi-ts made.
import { batch, catenaryFrequencies, catenaryFrequenciesByQuery, forcedTensionByQuery, tautModes } from './sdk.gen';
import { client } from './client.gen';
import type { CatenaryFrequenciesRequest } from './types.gen';

export async function ask(daemon: string) {
  client.setConfig({ baseUrl: daemon });
  const cable: CatenaryFrequenciesRequest = { span_m: 100, length_m: 101, modes: 3 };
  const posted = await catenaryFrequencies({ body: cable, throwOnError: true });
  const first: number | undefined = posted.data.result.in_plane?.[0]?.frequency_ratio;
  const got = await catenaryFrequenciesByQuery({ query: { span_m: 100, length_m: 101, modes: 3 }, throwOnError: true });
  const forced = await forcedTensionByQuery({ query: { sag_parameter: 0.9, frequency_ratios: [0.5, 1, 2] }, throwOnError: true });
  const refused = await catenaryFrequencies({ body: { span_m: 100, length_m: 90 } });
  const faulty = await catenaryFrequenciesByQuery({ query: { sag_parameter: 0.9, modes: 0 } });
  const chain = await tautModes({ throwOnError: true,
    body: { tension_N: 5000, modes: 2, components: [{ type: 'cable', length_m: 20, mass_kg_per_m: 1 }, { type: 'point_mass', mass_kg: 3 },
      { type: 'cable', length_m: 20, mass_kg_per_m: 1 }] } });
  const lines = await batch({ body: [{ path: '/v1/catenary/frequencies', request: { sag_parameter: 0.9 } }], parseAs: 'text', throwOnError: true });
  return { posted: posted.data, first, got: got.data, forced: forced.data, refused: refused.error?.detail,
    faulty: faulty.error?.errors?.[0]?.pointer, chain: chain.data, lines: String(lines.data) };
}

// @ts-expect-error: a name that no field has
export const typo: CatenaryFrequenciesRequest = { span_m: 100, lenght_m: 101, length_m: 101 };
// @ts-expect-error: no length
export const none: CatenaryFrequenciesRequest = { span_m: 100, modes: 3 };
