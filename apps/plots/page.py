"""Pieces of a report page: one HTML file that needs nothing beside itself."""

import base64
from html import escape
from pathlib import Path

CSS = """
:root { color-scheme: light; }
body { font: 15px/1.5 system-ui, "Helvetica Neue", Arial, sans-serif; color: #1d2530; background: #fff;
       max-width: 62rem; margin: 2rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.6rem; margin: 0 0 .2rem; }
h2 { font-size: 1.15rem; margin: 2.2rem 0 .6rem; border-bottom: 1px solid #d8dde3; padding-bottom: .2rem; }
p.message { margin: .2rem 0 .6rem; }
p.origin { color: #5a6673; font-size: .9rem; }
.status { display: inline-block; padding: 0 .5rem; border-radius: .25rem; background: #e4e8ec; font-size: .9rem; }
.status.converged { background: #d9efe0; color: #14532a; }
.status.bad { background: #fbdfe0; color: #7d1220; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { padding: .2rem .7rem; border-bottom: 1px solid #e6e9ec; text-align: right; white-space: nowrap; }
th { font-weight: 600; border-bottom: 2px solid #c9d0d7; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
figure { margin: 1.4rem 0; break-inside: avoid; }
figure img { max-width: 100%; height: auto; }
figcaption { color: #414b57; font-size: .9rem; }
details { margin: .8rem 0; }
summary { cursor: pointer; }
pre { background: #f5f6f8; padding: .7rem; font-size: .8rem; overflow-x: auto; }
@page { size: A4; margin: 1.4cm; }
@media print { body { max-width: none; margin: 0; padding: 0; font-size: 10pt; } details:not([open]) { display: none; }
               figure img { max-height: 19cm; } .wide { overflow: visible; } table { font-size: 7pt; }
               th, td { padding: .1rem .3rem; } }
"""


class Link(str):
    """Markup that is not to be escaped."""


def cell(value):
    """Text of a cell: a number to the digits that matter; a Link is markup already."""
    if isinstance(value, Link):
        return value
    if value is None or value != value:
        return ""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}"
    return escape(str(value))


def table(header, rows):
    """`header` and the cells of `rows`."""
    head = "".join(f"<th>{cell(name)}</th>" for name in header)
    body = "\n".join("<tr>" + "".join(f"<td>{cell(value)}</td>" for value in row) + "</tr>" for row in rows)
    return f'<div class="wide"><table><thead><tr>{head}</tr></thead>\n<tbody>{body}</tbody></table></div>'


def link(target, text):
    return Link(f'<a href="{escape(target, quote=True)}">{escape(text)}</a>')


def section(title, content):
    return f"<h2>{escape(title)}</h2>\n{content}" if content else ""


def folded(title, content):
    return f"<details><summary>{escape(title)}</summary>\n{content}\n</details>"


def figure(path, caption):
    image = base64.b64encode(Path(path).read_bytes()).decode()
    return (f'<figure><img alt="{escape(caption, quote=True)}" src="data:image/png;base64,{image}">\n'
            f"<figcaption>{escape(caption)}</figcaption></figure>")


def page(title, parts):
    body = "\n".join(part for part in parts if part)
    return (f'<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            f'<meta name="viewport" content="width=device-width, initial-scale=1">\n<title>{escape(title)}</title>\n'
            f"<style>{CSS}</style>\n</head>\n<body>\n{body}\n</body>\n</html>\n")
