#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""docs.py OPENAPI.yaml INDEX.html FOLDER PAGE.md...: the reference as static pages, one an endpoint, and the pages of doc/.

A generator of our own, because the packaged viewers of OpenAPI weigh 0.9 to 3.6 MB each, need inline styles that our
content security policy forbids, and show neither units nor "one of these groups" as a table.
"""
import json
import pathlib
import re
import sys
from html import escape

import yaml

import markdown
import snippets

PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title} - strum</title>
<link rel="icon" href="/assets/icon.svg">
<link rel="stylesheet" href="/assets/style.css">
<script type="module" src="/assets/theme.js"></script>
<script type="module" src="/assets/address.js"></script>
</head>
<body>
<header class="bar"><a class="brand" href="/">strum</a>
<nav aria-label="Site"><a href="/">Dashboard</a><a href="/docs">Reference</a><a href="/openapi.json">OpenAPI</a></nav>
<button id="theme" type="button" class="quiet">Dark</button></header>
<div class="reader">
<nav class="contents" aria-label="Reference">{contents}</nav>
<main>{body}</main>
</div>
</body>
</html>
"""


def name_of(path):
    """The page's name: /v1/catenary/frequencies -> catenary-frequencies."""
    return re.sub(r"^/v1/", "", path).replace("/", "-")


def prose(text):
    """Paragraphs, lists and `code` of the contract's descriptions."""
    out = []
    for block in re.split(r"\n\s*\n", text.strip()):
        if block.lstrip().startswith("* "):
            items = re.split(r"\n\s*\* ", "\n" + block.strip())[1:]
            out.append("<ul>" + "".join(f"<li>{code(item)}</li>" for item in items) + "</ul>")
        else:
            out.append(f"<p>{code(block)}</p>")
    return "".join(out)


def code(text):
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(text.strip(), quote=False))


def number(value):
    return f"{value:g}".replace("e+0", "e").replace("e+", "e").replace("e-0", "e-")


def value_range(schema):
    """The range in words; "" where there is none."""
    if "enum" in schema:
        return " | ".join(map(str, schema["enum"]))
    if "const" in schema:
        return json.dumps(schema["const"])
    if "maxLength" in schema:
        return f"a name: up to {schema['maxLength']} letters, digits, _"
    parts = [f"{sign} {number(schema[key])}" for key, sign in
             (("exclusiveMinimum", ">"), ("minimum", "≥"), ("exclusiveMaximum", "<"), ("maximum", "≤")) if key in schema]
    if "oneOf" in schema:
        words = [value_range(one) if "const" in one or one.get("type") == "number" else "{" + ", ".join(one["properties"]) + "}"
                 for one in schema["oneOf"] if "const" in one or one.get("type") in ("number", "object")]
        return " or ".join(filter(None, words))
    if "minItems" in schema or "maxItems" in schema:
        low, high = schema.get("minItems", 0), schema.get("maxItems", "")
        parts.append(f"{low} to {high} items" if high else f"at least {low} item{'s' if low > 1 else ''}")
    if "items" in schema and "type" in schema["items"] and schema["items"]["type"] in ("number", "integer"):
        inner = value_range(schema["items"])
        parts += [f"each {inner}"] if inner else []
    return ", ".join(parts)


def kind_of(schema):
    if "oneOf" in schema and "type" not in schema:
        kinds = list(dict.fromkeys(kind_of(one) for one in schema["oneOf"]))
        return " or ".join(kinds)
    if schema.get("type") == "array":
        return "list of " + (kind_of(schema["items"]) if "type" in schema["items"] else "objects") + "s" * (
            "type" in schema["items"] and not kind_of(schema["items"]).endswith("s"))
    if "const" in schema or "enum" in schema:
        return "choice"
    return {"boolean": "flag", "string": "text"}.get(schema.get("type", "object"), schema.get("type", "object"))


def wanted(expect):
    """An expected value of an example, or a few of a list, as text."""
    names = ", ".join(expect.get("members", []))
    shown = expect["value"] if "value" in expect else expect["values"]
    more = len(shown) - 6 if isinstance(shown, list) else 0
    text = json.dumps(shown[:6])[1:-1] + (f", and {more} more" if more > 0 else "") if isinstance(shown, list) else json.dumps(shown)
    return f"{names}: {text}" if names else text


class Reference:
    def __init__(self, contract, more):
        self.contract = contract
        self.more = more  # (name, title, body) of pages that are no endpoint's
        self.asked = {path: item for path, item in contract["paths"].items() if "x-query" in item}

    def resolve(self, node):
        while "$ref" in node:
            target = self.contract
            for token in node["$ref"].split("/")[1:]:
                target = target.get(token, {})  # not written yet: api/update needs a build first
            node = {**target, **{key: value for key, value in node.items() if key != "$ref"}}
        return node

    def members(self, schema):
        """name -> schema of an object, with what allOf, oneOf and anyOf bring in."""
        schema, found = self.resolve(schema), {}
        for part in schema.get("allOf", []) + schema.get("oneOf", []) + schema.get("anyOf", []):
            found.update(self.members(part))
        found.update(schema.get("properties", {}))
        return {name: inner for name, inner in found.items() if isinstance(inner, dict)}

    def inner(self, schema):
        """(lead, object schema) of what a member holds."""
        schema = self.resolve(schema)
        if schema.get("type") == "array":
            items = self.resolve(schema["items"])
            if items.get("type") == "object" or "allOf" in items:
                return [("", items)]
            if any("properties" in self.resolve(one) for one in items.get("oneOf", [])) and "title" in items["oneOf"][0]:
                return [(one["title"], self.resolve(one)) for one in items["oneOf"]]
            return []
        if self.members(schema) and schema.get("type", "object") == "object" and set(self.members(schema)) != {"re", "im"}:
            return [("", schema)]
        return []

    def rows(self, schema, needed, asked, depth=0):
        schema = self.resolve(schema)
        required = set(schema.get("required", []))
        for name, member in self.members(schema).items():
            member = self.resolve(member)
            default = member.get("default")
            shown = needed if name in required else "" if default is None else json.dumps(default)
            # Whole objects and lists of them have their example field by field, in the rows below; what may stand
            # for a number is the same everywhere, and is told once.
            inside, number_too = self.inner(member), any(one.get("type") == "number" for one in member.get("oneOf", []))
            example = "" if inside and not number_too else "".join(json.dumps(one) for one in member.get("examples", []))
            yield (f'<tr><th scope="row" class="deep{depth}"><code>{escape(name)}</code></th><td>{escape(kind_of(member))}</td>'
                   f'<td>{escape(member.get("x-unit", ""))}</td><td>{escape(value_range(member))}</td><td>{escape(shown)}</td>'
                   + f'<td>{escape(example)}</td>' * asked + f'<td>{code(member.get("description", ""))}</td></tr>')
            if depth >= 4 or (number_too and tuple(self.members(member)) in self.told):
                continue
            self.told |= {tuple(self.members(member))} if number_too else set()
            for lead, inner in inside:
                if lead:
                    yield (f'<tr><th scope="row" class="deep{depth + 1}"><code>type: {escape(lead)}</code></th>'
                           f'<td colspan="{4 + asked}"></td><td>{code(inner.get("description", ""))}</td></tr>')
                yield from self.rows(inner, needed, asked, depth + 1 + bool(lead))

    def table(self, schema, caption, last, needed, asked=False):
        self.told = set()
        return (f'<div class="wide" tabindex="0" role="region" aria-label="{escape(caption)}"><table class="fields{" asked" * asked}">'
                f'<caption>{escape(caption)}</caption><thead><tr><th scope="col">field</th><th scope="col">kind</th>'
                f'<th scope="col">unit</th><th scope="col">range</th><th scope="col">{last}</th>'
                + '<th scope="col">example</th>' * asked +
                f'<th scope="col">meaning</th></tr></thead><tbody>{"".join(self.rows(schema, needed, asked))}</tbody></table></div>')

    def groups(self, schema):
        out = []
        for group in schema.get("allOf", []):
            ways = "".join(f"<li><code>{escape(one['title'])}</code></li>" for one in group["oneOf"])
            out.append(f"<p>{escape(group['title'])}: exactly one of these groups</p><ul>{ways}</ul>")
        note = "<p class='note'>[name] may be left out; +name is needed with the group.</p>" if out else ""
        return "".join(out) + note

    def endpoint(self, path, item):
        post = item["post"]
        content = post["requestBody"]["content"]["application/json"]
        schema = self.resolve(content["schema"])
        answer = post["responses"]["200"]["content"]["application/json"]
        asked, answered = ([self.resolve(one).get("value", {}) for one in part.get("examples", {}).values()] or [{}]
                           for part in (content, answer))
        example = self.resolve(next(iter(content["examples"].values())))
        expected = "".join(f'<tr><th scope="row"><code>{escape(one["pointer"])}</code></th><td>{escape(wanted(one))}</td></tr>'
                           for one in example.get("x-expect", []))
        ways = snippets.of_question(path, asked[0], "get" in item)
        result = self.members(answer["schema"]).get("result", {})
        verbs = ["POST", "QUERY"] + ["GET"] * ("get" in item)
        return f"""<h1>{escape(post["summary"])}</h1>
<p class="path">{" ".join(f"<code>{verb}</code>" for verb in verbs)} <code>{escape(path)}</code>
<a class="action" href="/#{escape(path[3:])}">Try it</a></p>
{prose(post["description"])}
<h2 id="theory">Theory</h2>{prose(post.get("x-theory", ""))}
<p>Every answer names what it used in <code>meta.theory</code>; the one below: {escape(answered[0].get("meta", {}).get("theory", ""))}.</p>
<h2 id="request">Request</h2>{self.groups(schema)}{self.table(schema, "Fields of the request", "default", "needed", True)}
<h2 id="example">Worked example</h2><p>{escape(example.get("summary", ""))}.</p>
{ways}
<p>The tests send it and hold the answer against these values: {escape(example.get("description", ""))}.</p>
<div class="wide" tabindex="0" role="region" aria-label="Expected values"><table class="expected"><thead><tr><th scope="col">in the answer</th>
<th scope="col">expected</th></tr></thead><tbody>{expected}</tbody></table></div>
<details><summary>The whole answer</summary>
<pre tabindex="0"><code>{escape(json.dumps(answered[0], indent=2), quote=False)}</code></pre></details>
<h2 id="answer">Answer</h2><p>Around it <code>request</code>, <code>warnings</code> and <code>meta</code>.</p>
{self.table(result, "Fields of result", "there", "always")}
<h2 id="errors">Refusals</h2><p>As <code>application/problem+json</code>, every faulty field by its JSON pointer.</p>
<ul>{self.refusals(post)}</ul>"""

    def refusals(self, operation):
        return "".join(f"<li><code>{status}</code> {code(self.resolve(one)['description'])}</li>"
                       for status, one in operation["responses"].items() if status != "200")

    def batch(self):
        """Not a question, but what holds many: items, lines, and how to send and read them."""
        post = self.contract["paths"]["/v1/batch"]["post"]
        schemas, content = self.contract["components"]["schemas"], post["requestBody"]["content"]["application/json"]
        items = content["examples"]["chosen"]["value"]
        tables = "".join(f'<h3>{title}</h3>{self.table(schemas[name], title, "there", "always")}' for title, name in (
            ("An answer", "batch_answer"), ("What was chosen of an answer", "batch_fields"), ("A refusal", "batch_problem")))
        return f"""<h1>{escape(post["summary"])}</h1>
<p class="path"><code>POST</code> <code>/v1/batch</code></p>
{prose(post["description"])}
<h2 id="example">Two cables, one figure of each</h2>{snippets.of_batch(items)}
<h2 id="items">An item</h2>{self.table(schemas["batch_item"], "Members of an item", "default", "needed")}
<h2 id="lines">A line of the answer</h2>{tables}
<h2 id="errors">Refusals of the whole</h2><ul>{self.refusals(post)}</ul>"""

    def results(self):
        get = self.contract["paths"]["/v1/results/{key}"]["get"]
        path, item = next(iter(self.asked.items()))
        example = self.resolve(next(iter(item["post"]["requestBody"]["content"]["application/json"]["examples"].values())))
        headers = "".join(f'<tr><th scope="row"><code>{name}</code></th><td>{code(self.resolve(one)["description"])}</td></tr>'
                          for name, one in get["responses"]["200"]["headers"].items())
        return f"""<h1>{escape(get["summary"])}</h1>
<p class="path"><code>GET</code> <code>/v1/results/{{key}}</code></p>
{prose(get["description"])}
<p>The key is <code>meta.key</code> of an answer, and its <code>ETag</code>; <code>Content-Location</code> has the whole path.
A key is the SHA-256 of the question in its canonical form, the solver's number and the machine's numerics: it never names two
answers, and who asks the same question of the same solver again gets the same one.</p>
<h2 id="example">Ask, and fetch it again</h2>{snippets.of_result(path, example["value"])}
<h2 id="headers">Headers</h2><table class="list"><tbody>{headers}</tbody></table>
<h2 id="errors">Refusals</h2><ul>{self.refusals(get)}</ul>"""

    def index(self):
        info = self.contract["info"]
        asked = "".join(f'<tr><th scope="row"><a href="/docs/{name_of(path)}"><code>{escape(path)}</code></a></th>'
                        f'<td>{escape(item["post"]["summary"])}</td></tr>' for path, item in self.asked.items())
        own = {"/v1/batch": "/docs/batch", "/v1/results/{key}": "/docs/results"}

        def named(path):
            text = f"<code>{escape(path)}</code>"
            return f'<a href="{own[path]}">{text}</a>' if path in own else text
        rest = "".join(f'<tr><th scope="row">{named(path)}</th><td>{escape(next(iter(item.values()))["summary"])}</td></tr>'
                       for path, item in self.contract["paths"].items() if path not in self.asked)
        return f"""<h1>Reference</h1><p class="lead">{escape(info["summary"])}, version {escape(info["version"])}.</p>
<h2>Questions</h2><table class="list"><tbody>{asked}</tbody></table>
<h2>Everything else</h2><table class="list"><tbody>{rest}</tbody></table>
<h2>More</h2><ul>{"".join(f'<li><a href="/docs/{name}">{escape(title)}</a></li>' for name, title, _ in self.more)}</ul>
<h2>Rules for all of them</h2>{prose(info["description"])}"""

    def page(self, title, body, here):
        links = [("/docs", "Overview")] + [(f"/docs/{name_of(path)}", path[4:]) for path in self.asked]
        links += [("/docs/batch", "batch"), ("/docs/results", "results")] + [(f"/docs/{name}", title) for name, title, _ in self.more]
        contents = "".join(f'<a href="{to}"{" aria-current=page" * (to == here)}>{escape(text)}</a>' for to, text in links)
        return PAGE.format(title=escape(title), body=body, contents=contents)


def main():
    source, index, folder, *texts = map(pathlib.Path, sys.argv[1:])
    more = [(text.stem.replace("_", "-"), *markdown.html_of(text.read_text(encoding="utf-8"))) for text in texts]
    reference = Reference(yaml.safe_load(source.read_text(encoding="utf-8")), more)
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.html"):
        old.unlink()

    def write(name, title, body):
        (folder / f"{name}.html").write_text(reference.page(title, body, f"/docs/{name}"), encoding="utf-8")
    index.write_text(reference.page("Reference", reference.index(), "/docs"), encoding="utf-8")
    for path, item in reference.asked.items():
        write(name_of(path), item["post"]["summary"], reference.endpoint(path, item))
    write("batch", "Many requests in one", reference.batch())
    write("results", "An answer again, by its key", reference.results())
    for name, title, body in more:
        write(name, title, f"<h1>{escape(title)}</h1>{body}")


if __name__ == "__main__":
    main()
