/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A JUnit report for tests/tally: Debian 12's node has a test runner, but not this reporter. */
const SUITE = process.env.SUITE ?? 'browser';
const escape = (text) => String(text).replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c])
  .replace(/[^\x09\x0a\x0d\x20-\uffff]/g, '');

export default async function* junit(events) {
  yield `<testsuite name="${SUITE}">\n`;
  for await (const { type, data } of events) {
    if ((type !== 'test:pass' && type !== 'test:fail') || data.details?.type === 'suite' || data.name.endsWith('.mjs')) continue;
    const why = type === 'test:fail' ? `<failure>${escape(data.details.error?.cause?.stack ?? data.details.error)}</failure>`
      : data.skip !== undefined ? '<skipped/>' : '';
    yield `<testcase classname="${SUITE}" name="${escape(data.name)}">${why}</testcase>\n`;
  }
  yield '</testsuite>\n';
}
