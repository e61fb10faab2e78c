# SPDX-License-Identifier: GPL-3.0-or-later
"""A question as lines to copy: for a shell, for Python, for JavaScript. They hold the address HOST, in whose place the page
(address.js) puts the daemon's own; tests/http/test_pages.py runs each of them."""
import json
import pprint
import shlex
import urllib.parse
from html import escape

HOST = "http://127.0.0.1:8080"


def python_text(value, indent):
    """A Python literal over several lines where it is long."""
    return pprint.pformat(value, width=100, sort_dicts=False).replace("\n", "\n" + " " * indent)


def javascript_text(value, indent):
    flat = json.dumps(value, ensure_ascii=False)
    return flat if len(flat) < 100 else json.dumps(value, ensure_ascii=False, indent=2).replace("\n", "\n" + " " * indent)


def word(value):
    return ",".join(map(word, value)) if isinstance(value, list) else json.dumps(value).strip('"')


def curl(path, body):
    return f"curl -s --json {shlex.quote(json.dumps(body))} {HOST}{path}"


def curl_get(path, body):
    query = urllib.parse.urlencode({name: word(value) for name, value in body.items()}, safe=",")
    return f"curl -s {shlex.quote(f'{HOST}{path}?{query}')}"


def python(path, body):
    return f"""import json
import requests

request = {python_text(body, 10)}
answer = requests.post("{HOST}{path}", json=request)
if not answer.ok:
    raise SystemExit(json.dumps(answer.json(), indent=1))  # "errors" names each faulty field
print(json.dumps(answer.json()["result"], indent=1))"""


def javascript(path, body):
    return f"""const request = {javascript_text(body, 0)};
const answer = await fetch("{HOST}{path}", {{
  method: "POST",
  headers: {{ "Content-Type": "application/json" }},
  body: JSON.stringify(request),
}});
const said = await answer.json();
if (!answer.ok) throw new Error(JSON.stringify(said)); // "errors" names each faulty field
console.log(JSON.stringify(said.result, null, 1));"""


def shown(kind, text):
    return f'<pre tabindex="0"><code class="asks {kind}">{escape(text, quote=False)}</code></pre>'


def of_question(path, body, by_query):
    """All ways to ask one question."""
    ways = [("In a shell", shown("curl", curl(path, body)))]
    if by_query and not any(isinstance(value, dict) or (isinstance(value, list) and any(isinstance(one, dict) for one in value))
                            for value in body.values()):
        ways.append(("By GET", shown("get", curl_get(path, body))))
    folded = [("In Python", shown("python", python(path, body))), ("In JavaScript", shown("javascript", javascript(path, body)))]
    return "".join(f"<h3>{title}</h3>{text}" for title, text in ways) + "".join(
        f"<details><summary>{title}</summary>{text}</details>" for title, text in folded)


BATCH = "/v1/batch"


def of_batch(items):
    lines = "\n".join(json.dumps(item) for item in items)
    shell = f"""curl -sN -H 'Content-Type: application/x-ndjson' --data-binary @- {HOST}{BATCH} <<'END'
{lines}
END"""
    script = f"""import json
import requests

items = {python_text(items, 8)}
with requests.post("{HOST}{BATCH}", json=items, stream=True) as answers:
    answers.raise_for_status()
    for line in answers.iter_lines():  # each as soon as it is ready
        line = json.loads(line)
        if "status" in line:
            print(line["index"], line["detail"], line.get("errors"))
        else:
            print(json.dumps(line))"""
    page = f"""const items = {javascript_text(items, 0)};
const answers = await fetch("{HOST}{BATCH}", {{
  method: "POST",
  headers: {{ "Content-Type": "application/json" }},
  body: JSON.stringify(items),
}});
if (!answers.ok) throw new Error(await answers.text());
for (const line of (await answers.text()).trimEnd().split("\\n")) {{
  const {{ index, status, detail, ...answer }} = JSON.parse(line);
  console.log(status ? `${{index}} ${{detail}}` : JSON.stringify(answer));
}}"""
    return (f"<h3>In a shell</h3>{shown('curl', shell)}<h3>In Python</h3>{shown('python', script)}"
            f"<h3>In JavaScript</h3>{shown('javascript', page)}")


def of_result(path, body):
    shell = f"""link=$(curl -s -o first.json -w '%header{{content-location}}' --json {shlex.quote(json.dumps(body))} {HOST}{path})
curl -s "{HOST}$link" | cmp - first.json && echo "the same bytes, again at $link\""""
    script = f"""import requests

request = {python_text(body, 10)}
first = requests.post("{HOST}{path}", json=request)
again = requests.get("{HOST}" + first.headers["Content-Location"])
assert again.content == first.content
known = requests.get(again.url, headers={{"If-None-Match": first.headers["ETag"]}})
print(again.status_code, known.status_code, first.json()["meta"]["key"])  # 200 304 and the key"""
    page = f"""const first = await fetch("{HOST}{path}", {{
  method: "POST",
  headers: {{ "Content-Type": "application/json" }},
  body: JSON.stringify({javascript_text(body, 2)}),
}});
const {{ meta }} = await first.json();
const again = await fetch(`{HOST}/v1/results/${{meta.key}}`);
console.log(again.status, (await again.json()).meta.key === meta.key); // 200 true; 404 once it is no longer kept"""
    return (f"<h3>In a shell</h3>{shown('curl', shell)}<h3>In Python</h3>{shown('python', script)}"
            f"<h3>In JavaScript</h3>{shown('javascript', page)}")
