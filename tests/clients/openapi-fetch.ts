// SPDX-License-Identifier: GPL-3.0-or-later
// Questions by openapi-fetch, with the types that openapi-typescript made.
import createClient from 'openapi-fetch';
import type { components, paths } from './schema';

type Request = components['schemas']['catenary_frequencies_request'];

export async function ask(daemon: string) {
  const client = createClient<paths, 'application/json' | 'application/problem+json'>({ baseUrl: daemon });
  const cable: Request = { span_m: 100, length_m: 101, modes: 3 };
  const posted = await client.POST('/v1/catenary/frequencies', { body: cable });
  if (!posted.data) throw new Error(posted.error.detail);
  const first: number | undefined = posted.data.result.in_plane?.[0]?.frequency_ratio;
  const got = await client.GET('/v1/catenary/frequencies', { params: { query: { span_m: 100, length_m: 101, modes: 3 } } });
  const forced = await client.GET('/v1/forced/tension', { params: { query: { sag_parameter: 0.9, frequency_ratios: [0.5, 1, 2] } } });
  const refused = await client.POST('/v1/catenary/frequencies', { body: { span_m: 100, length_m: 90 } });
  const faulty = await client.GET('/v1/catenary/frequencies', { params: { query: { sag_parameter: 0.9, modes: 0 } } });
  const chain = await client.POST('/v1/taut/modes', {
    body: { tension_N: 5000, modes: 2, components: [{ type: 'cable', length_m: 20, mass_kg_per_m: 1 }, { type: 'point_mass', mass_kg: 3 },
      { type: 'cable', length_m: 20, mass_kg_per_m: 1 }] } });
  const lines = await client.POST('/v1/batch', {
    body: [{ path: '/v1/catenary/frequencies', request: { sag_parameter: 0.9 } }], parseAs: 'text' });
  return { posted: posted.data, first, got: got.data, forced: forced.data, refused: refused.error?.detail,
    faulty: faulty.error?.errors?.[0]?.pointer, chain: chain.data, lines: String(lines.data) };
}

// @ts-expect-error: a name that no field has
export const typo: Request = { span_m: 100, lenght_m: 101, length_m: 101 };
// @ts-expect-error: two groups of the geometry
export const two: Request = { sag_parameter: 0.9, span_m: 100, length_m: 101 };
// @ts-expect-error: no length
export const none: Request = { span_m: 100, modes: 3 };
