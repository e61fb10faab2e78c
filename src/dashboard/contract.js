/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contract of the daemon, as the page needs it: one entry an endpoint. */

function resolver(contract) {
  return function resolve(node) {
    if (!node || !node.$ref) return node;
    const { $ref, ...beside } = node;
    const target = $ref.split('/').slice(1).reduce((at, token) => at[token], contract);
    return { ...resolve(target), ...beside };
  };
}

function describe(path, item, resolve) {
  const content = item.post.requestBody.content['application/json'];
  const words = path.slice(4).split('/');
  return {
    path,
    name: words.join('-'),
    tab: words.join(' ').replace(/^./, (letter) => letter.toUpperCase()),
    summary: item.post.summary,
    description: item.post.description ?? '',
    schema: resolve(content.schema),
    examples: Object.values(content.examples ?? {}).map(resolve).map(({ summary, value }) => ({ title: summary, request: value })),
    byQuery: Boolean(item.get),
  };
}

export async function loadContract() {
  const answer = await fetch('/openapi.json');
  if (!answer.ok) throw new Error(`the contract could not be read: ${answer.status}`);
  const contract = await answer.json();
  const resolve = resolver(contract);
  return Object.entries(contract.paths)
    .filter(([, item]) => item['x-query'])
    .map(([path, item]) => describe(path, item, resolve));
}
