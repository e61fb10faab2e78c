/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The proof: totals, and every value compared in one table. */

export const validation = {
  slow: true,
  single: true,
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
    /* A source that all cases of a family share stands with the family. */
    const sources = new Map(families.map(({ family }) => [family, new Set(cases.filter((one) => one.family === family).map((one) => one.source))]));
    const shared = (family) => (sources.get(family)?.size === 1 ? [...sources.get(family)][0] : undefined);
    const flat = cases.flatMap((one) => (one.compared ?? []).map(({ pointer, item, kind, ...row }) => (
      { case: one.case, value: `${pointer.replace('/result/', '')}${item === undefined ? '' : ` ${item}`}`, ...row })));
    const short = cases.map(({ compared, source, ...one }) => ({ ...one, ...(shared(one.family) ? {} : { source }) }))
      .sort((a, b) => Number(a.passed) - Number(b.passed));
    const named = families.map((one) => ({ ...one, ...(shared(one.family) ? { source: shared(one.family) } : {}) }));
    return { totals, families: named, cases: short, ...(flat.length ? { values_compared: flat.sort((a, b) => Number(a.holds) - Number(b.holds)) } : {}) };
  },
  /* A family's name opens it: every value of its cases. */
  opens: (column, row) => (column === 'family' && row.cases !== undefined ? { family: row.family.replace(/[^A-Za-z0-9]/g, '_'), values: true } : null),
  sweeps: [],
};
