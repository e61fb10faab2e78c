/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Asking the daemon. */

const TRIES = 6;

function pause(ms, signal) {
  return new Promise((done, fail) => {
    const timer = setTimeout(done, ms);
    signal?.addEventListener('abort', () => {
      clearTimeout(timer);
      fail(signal.reason);
    }, { once: true });
  });
}

/* A daemon that has too much to do says when to ask again: a slider that is dragged, or a sweep, then only takes longer. */
async function send(path, request, signal, headers = {}) {
  for (let tries = 1; ; tries += 1) {
    const response = await fetch(path, {
      method: 'POST', headers: { 'Content-Type': 'application/json', ...headers }, body: JSON.stringify(request), signal });
    if (response.status !== 503 || tries === TRIES) return response;
    await pause(1000 * Number(response.headers.get('Retry-After') ?? 1), signal);
  }
}

/* {ok, answer | problem, text, ms, status}; throws only when given up or unreachable. */
export async function ask(path, request, signal) {
  const began = performance.now();
  const response = await send(path, request, signal);
  const text = await response.text();
  const ms = performance.now() - began;
  let document;
  try {
    document = JSON.parse(text);
  } catch {
    document = { title: response.statusText, status: response.status, detail: 'the answer is not JSON', errors: [] };
  }
  return response.ok
    ? { ok: true, answer: document, text, ms, status: response.status }
    : { ok: false, problem: document, text, ms, status: response.status };
}

/* The same for answers that take long: as Server-Sent Events, with `progress` called on the way. */
export async function askLive(path, request, signal, progress) {
  const began = performance.now();
  const response = await send(path, request, signal, { Accept: 'text/event-stream' });
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  const streams = response.headers.get('Content-Type')?.startsWith('text/event-stream');
  let text = '';
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    text += value;
    for (let end = text.indexOf('\n\n'); streams && end >= 0; end = text.indexOf('\n\n')) {
      const [, name, data] = text.slice(0, end).match(/^event: (\w+)\ndata: (.*)$/s) ?? [];
      text = text.slice(end + 2);
      if (name === 'progress') progress(JSON.parse(data));
      else if (name === 'result' || name === 'problem') return finished(name === 'result', data, performance.now() - began);
    }
  }
  return finished(response.ok && !streams, text, performance.now() - began);
}

function finished(ok, text, ms) {
  try {
    const document = JSON.parse(text);
    return ok ? { ok, answer: document, text, ms, status: 200 } : { ok, problem: document, text, ms, status: document.status };
  } catch {
    return { ok: false, problem: { title: 'No answer', detail: 'the answer ended early', errors: [] }, text, ms, status: 0 };
  }
}

/* Many questions, a few at a time; `each(index, result)` as they come. A refused one is left out of the picture. */
export async function askAll(path, requests, signal, each, together = 4) {
  let next = 0;
  async function work() {
    while (next < requests.length && !signal.aborted) {
      const index = next;
      next += 1;
      const result = await ask(path, requests[index], signal);
      if (!signal.aborted) each(index, result);
    }
  }
  await Promise.all(Array.from({ length: Math.min(together, requests.length) }, work));
}

export function curlOf(path, request) {
  const body = JSON.stringify(request).replaceAll("'", "'\\''");
  return `curl -s --json '${body}' ${location.origin}${path}`;
}
