/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Questions to start from, from the reports. The contract's own examples stand after them. */

const segment = (length, more = {}) => ({ type: 'cable', length_m: length, mass_kg_per_m: 1, ...more });
const link = (mass, inertia) => ({ left_m: 0.2, right_m: 0.2, mass_kg: mass, inertia_kg_m2: inertia });
const inline = (mass, inertia, damping) => ({ type: 'inline_absorber', links: [link(mass, inertia), link(mass, inertia)],
  joints: [{ spring_arm_m: 0.03, damper_arm_m: 0.03, stiffness_N_per_m: 10, damping_N_s_per_m: damping }] });
const hanging = (stiffness, damping) => ({ type: 'hanging_absorber', mass_kg: 5, stiffness_N_per_m: stiffness, damping_N_s_per_m: damping });
/* In SI what the report gives in inches and pounds: five spans of 0.8763 m, four masses of 2.67 g. */
const sergev = Array.from({ length: 9 }, (_, i) => (i % 2 ? { type: 'point_mass', mass_kg: 0.00267068423802 }
  : { type: 'cable', length_m: 0.8763, mass_kg_per_m: 0.0041703705579855645 }));

const riser = (length, mass, weight) => ({ length_m: length, mass_kg_per_m: mass, weight_N_per_m: weight, axial_stiffness_N: 362000000 });
const volturn = { span_m: 779.6, rise_m: 186, length_m: 850, mass_kg_per_m: 685, weight_N_per_m: 5844.118, added_mass_kg_per_m: 73.2, axial_stiffness_N: 3270000000, bed: {} };

const presets = {
  '/v1/catenary/frequencies': [
    ['A 100 m span with 110 m of cable', { span_m: 100, length_m: 110, mass_kg_per_m: 2 }],
    ['Gale, Table B-3: level, sag parameter 0.7', { rise_to_span: 0, sag_parameter: 0.7, modes: 6 }],
    ['Gale, Table B-3: level and taut, sag parameter 0.9679', { rise_to_span: 0, sag_parameter: 0.9679, modes: 6 }],
    ['Gale, Figure 3.4: supports at h/b = 0.5', { rise_to_span: 0.5, sag_parameter: 0.7, modes: 6 }],
    ['Gale, Figure 3.6: steep, h/b = 2', { rise_to_span: 2, sag_parameter: 0.5, modes: 6 }],
    ['Damped, checked by the second method', { sag_parameter: 0.9, eta_tangential: 0.1, eta_normal: 0.4, verify: true }],
    ['Elastic: 300 m span, steel rope', { span_m: 300, unstretched_length_m: 301, axial_stiffness_N: 4e7, mass_kg_per_m: 3.2 }],
  ],
  '/v1/forced/tension': [
    ['Gale, Figure 3.14: level, sag parameter 0.9', { rise_to_span: 0, sag_parameter: 0.9, frequency_ratio_min: 0.1, frequency_ratio_max: 10, points: 700 }],
    ['Gale, Figure 3.15: h/b = 0.5, sag parameter 0.7', { rise_to_span: 0.5, sag_parameter: 0.7, frequency_ratio_min: 0.1, frequency_ratio_max: 8, points: 700 }],
    ['Gale, Figure 3.16: profile at ratio 2', { rise_to_span: 0, sag_parameter: 0.9, frequency_ratio_min: 1, frequency_ratio_max: 6, points: 400, profiles_at: [2], profile_points: 161 }],
    ['Gale, Figure 3.17: on both sides of the first resonance', { sag_parameter: 0.7, frequency_ratio_min: 0.8, frequency_ratio_max: 2, points: 300, profiles_at: [1.32, 1.36], profile_points: 161 }],
    ['Damped', { sag_parameter: 0.9, eta_normal: 0.3, frequency_ratio_min: 0.1, frequency_ratio_max: 10, points: 500 }],
    ['A mooring line of 110 m: its end moves by half a metre', { span_m: 100, length_m: 110, mass_kg_per_m: 2, tangential_displacement_m: 0.5, frequency_ratio_min: 0.1, frequency_ratio_max: 6, points: 500 }],
  ],
  '/v1/inclined/modes': [
    ['Grinfogel: at the first crossover, inclined by 30 degrees', { epsilon: 0.1, inclination_deg: 30, lambda_squared: 39.5, modes: 6 }],
    ['Level, at the first crossover', { epsilon: 0.1, inclination_deg: 0, lambda_squared: 39.5, modes: 6 }],
    ['Steep and heavy', { epsilon: 0.5, inclination_deg: 60, lambda_squared: 100, modes: 6 }],
  ],
  '/v1/cable/statics': [
    ['A mooring line on its bed (VolturnUS-S)', volturn],
    ['A lazy wave on the bed, with a buoyant middle', { span_m: 350, rise_m: 180, bed: {}, sections: [riser(150, 25, 140), riser(80, 59, -450), riser(440, 25, 140)] }],
    ['A stay by its upper tension', { span_m: 300, rise_m: 120, mass_kg_per_m: 51.6, axial_stiffness_N: 1206900000, tension_end_2_N: 200000 }],
    ['A conductor, strung at 35 kN, 75 K warmer', { span_m: 500, mass_kg_per_m: 1.8, axial_stiffness_N: 36024000, horizontal_tension_N: 35316, temperature_change_K: 75, expansion_per_K: 0.000023 }],
  ],
  '/v1/cable/modes': [
    ['A stay with sag, bending stiffness and a damper', { span_m: 153.43199, rise_m: 88.584, tension_parallel_to_chord_N: 1165200, mass_kg_per_m: 51.6, axial_stiffness_N: 1206900000, bending_stiffness_N_m2: 724426,
      end_1: { rotation: 'clamped' }, end_2: { rotation: 'clamped' }, attachments: [{ type: 'damper', position_m: 3.54336, damping_N_s_per_m: 123521 }], plane: 'in_plane', modes: 4 }],
    ['A mooring line on its bed (VolturnUS-S)', { ...volturn, modes: 4 }],
    ['A line with a marker ball', { span_m: 500, length_m: 500.8, mass_kg_per_m: 1.8, axial_stiffness_N: 36024000, modes: 4, attachments: [{ type: 'point_mass', position_m: 250.4, mass_kg: 50 }] }],
  ],
  '/v1/taut/modes': [
    ['Sergev and Iwan, Table 1, case 1: four equal masses', { tension_N: 26.466918610799972, components: sergev, modes: 8 }],
    ['A 50 m cable alone (Levesque, 4.5)', { tension_N: 5000, components: [segment(50)], modes: 6 }],
    ['Levesque: in-line absorber at mid-span', { tension_N: 5000, components: [segment(25), inline(9, 0.12, 170000), segment(25)], modes: 8 }],
    ['Levesque: hanging absorber at mid-span', { tension_N: 5000, components: [segment(25), hanging(68.45, 15), segment(25)], modes: 6 }],
  ],
  '/v1/taut/matrix': [
    ['Levesque, Figure 3-2: t12 of the cable with an undamped absorber', { tension_N: 5000, components: [segment(25), inline(9, 0.12, 0), segment(25)],
      angular_frequencies: Array.from({ length: 240 }, (_, i) => Number((0.25 * (i + 1)).toFixed(2))) }],
  ],
  '/v1/validation': [
    ['Gale, Table B-3, every value', { family: 'gale_table_B_3', values: true }],
    ['Levesque, the printed values', { report: 'levesque', family: 'levesque', values: true }],
    ['Sergev and Iwan', { report: 'sergev_iwan', values: true }],
    ['All reports, every case (takes seconds)', {}],
  ],
  '/v1/identify/tension': [
    ['A 98 mm stay, ten frequencies: tension and bending stiffness', { frequencies_Hz: [0.43, 0.857, 1.286, 1.71, 2.143, 2.578, 3.012, 3.443, 3.883, 4.322],
      mode_numbers: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10], frequency_standard_deviation_Hz: 0.002, length_m: 177.168, mass_kg_per_m: 51.6,
      ends: { rotation: 'clamped' }, unknowns: ['tension', 'bending_stiffness'], compare: true }],
    ['Five lines of a spectrum: which modes are they?', { frequencies_Hz: [0.855, 1.285, 1.71, 2.58, 3.006], frequency_standard_deviation_Hz: 0.002,
      length_m: 177.168, mass_kg_per_m: 51.6, bending_stiffness_N_m2: 724426.26, ends: { rotation: 'clamped' } }],
    ['In plane: one frequency, three tensions', { frequencies_Hz: [0.4758476461416981], mode_numbers: [1], plane: 'in_plane', length_m: 150,
      mass_kg_per_m: 55, weight_N_per_m: 539.36575, axial_stiffness_N: 334455239.7 }],
    ['A guy by the time of its pulse', { pulse_time_s: 7.5, pulses: 10, length_m: 30.48, mass_kg_per_m: 0.336920316824147 }],
  ],
  '/v1/absorber/optimize': [
    ['Hanging absorber at mid-span: the best damping for a band', { tension_N: 5000, components: [segment(25), hanging(68.45, { variable: 'R' }), segment(25)],
      variables: [{ name: 'R', min: 0.1, max: 200 }], band_rad_per_s: [0.5, 7], required: { diameter_m: 0.03 }, sweep: { variable: 'R', points: 80 } }],
    ['The same, stiffness free too', { tension_N: 5000, components: [segment(25), hanging({ variable: 'k' }, { variable: 'R' }), segment(25)],
      variables: [{ name: 'R', min: 0.1, max: 200 }, { name: 'k', min: 1, max: 300 }], band_rad_per_s: [0.5, 7], sweep: { variable: 'R', points: 80 } }],
    ['Levesque: in-line absorber, damping for mode 3', { tension_N: 5000, components: [segment(25), inline(9, 0.12, { variable: 'R' }), segment(25)],
      variables: [{ name: 'R', min: 1000, max: 2000000 }], modes: [3], sweep: { variable: 'R', points: 80 } }],
  ],
};

export function presetsOf(path) {
  return (presets[path] ?? []).map(([title, request]) => ({ title, request }));
}
