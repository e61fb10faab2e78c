# SPDX-License-Identifier: GPL-3.0-or-later
"""The little of Markdown that doc/*.md uses, as HTML: headings, paragraphs, lists, tables, fences, `code`, *stress*."""
import re
from html import escape


def inline(text):
    """`code` as it stands, **strong** and *stress* outside of it."""
    out = []
    for i, part in enumerate(re.split(r"`([^`]+)`", text)):
        part = escape(part, quote=False)
        if i % 2:
            out.append(f"<code>{part}</code>")
        else:
            part = re.sub(r"\*\*(\S(?:.*?\S)?)\*\*", r"<strong>\1</strong>", part)
            out.append(re.sub(r"(?<!\w)\*(\S(?:.*?\S)?)\*(?!\w)", r"<em>\1</em>", part))
    return "".join(out)


def cells(line):
    return [cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]


def table(lines, caption):
    head, rows = cells(lines[0]), [cells(line) for line in lines[2:]]
    said = "".join(f'<th scope="col">{inline(cell)}</th>' for cell in head)
    body = "".join(f'<tr><th scope="row">{inline(row[0])}</th>' + "".join(f"<td>{inline(cell)}</td>" for cell in row[1:]) + "</tr>"
                   for row in rows)
    return (f'<div class="wide" tabindex="0" role="region" aria-label="{escape(caption)}"><table class="fields"><thead><tr>{said}</tr>'
            f"</thead><tbody>{body}</tbody></table></div>")


def listed(lines):
    items = re.split(r"\n[-*] ", "\n" + "\n".join(lines))[1:]
    return "<ul>" + "".join(f"<li>{inline(' '.join(item.split()))}</li>" for item in items) + "</ul>"


def html_of(text):
    """(title, body): the body without the title, which is a page's own. A fence has no empty line."""
    title, out, caption, tables = "", [], "", 0
    for block in re.split(r"\n\s*\n", text.strip()):
        lines = block.strip("\n").splitlines()
        if lines[0].startswith("# "):
            title = lines[0][2:]
        elif lines[0].startswith("## "):
            caption, tables = lines[0][3:], 0
            name = re.sub(r"\W+", "-", caption.lower()).strip("-")
            out.append(f'<h2 id="{name}">{inline(caption)}</h2>')
        elif lines[0].startswith("```"):
            out.append(f'<pre tabindex="0"><code>{escape(chr(10).join(lines[1:-1]), quote=False)}</code></pre>')
        elif lines[0].startswith("|"):
            tables += 1
            out.append(table(lines, f"{caption} {tables}" if tables > 1 else caption))
        elif lines[0].startswith(("- ", "* ")):
            out.append(listed(lines))
        else:
            out.append(f"<p>{inline(' '.join(line.strip() for line in lines))}</p>")
    return title, "".join(out)
