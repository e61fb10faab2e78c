/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The proof: totals, and every value compared in one table. */

export const validation = {
  slow: true,
  headline: ({ result: { totals } }) => [
    { label: 'cases that hold', value: totals.passed, unit: `of ${totals.cases}`, more: `${totals.values} values compared` },
    { label: 'cases that fail', value: totals.failed, unit: '', more: totals.failed ? 'listed first below' : '' },
  ],
  pictures({ result }) {
    const used = result.cases.filter((one) => one.tolerance > 0 && one.largest_difference > 0);
    if (!used.length) return [];
    return [{ kind: 'chart', key: 'margin', name: 'validation-margin', title: 'How much of the tolerance each case uses', x: { label: 'case' }, y: { label: 'difference over tolerance', log: true },
      series: [{ label: 'worst value', x: used.map((one, i) => i + 1), y: used.map((one) => one.largest_difference / one.tolerance), pointsOnly: true }], note: 'All below 1 hold. A difference of exactly 0 is not drawn.' }];
  },
  tables({ totals, families, cases }) {
    const flat = cases.flatMap((one) => (one.compared ?? []).map((row) => ({ case: one.case, ...row })));
    const short = cases.map(({ compared, ...one }) => one).sort((a, b) => Number(a.passed) - Number(b.passed));
    return { totals, families, cases: short, ...(flat.length ? { values_compared: flat.sort((a, b) => Number(a.holds) - Number(b.holds)) } : {}) };
  },
  sweeps: [],
};
