"""HTML pages that need nothing from outside: the frame of a page, its tables and its figures.

Words are escaped here, once: pass them as they are read.  What is HTML already is an `Html`.
"""

import base64
from collections.abc import Iterable, Sequence
from html import escape


class Html(str):
    """HTML, to be put into a page as it stands."""

    __slots__ = ()


def text(words: str) -> Html:
    """Words escaped for HTML, their numbers kept with their per cent signs.

    >>> text("x <= 2 %")
    'x ≤ 2&nbsp;%'
    """
    if isinstance(words, Html):
        return words
    kept = escape(words).replace(" %", "&nbsp;%")
    return Html(kept.replace("&lt;=", "≤").replace("&gt;=", "≥"))


def paragraphs(words: Iterable[str]) -> Html:
    r"""A ``p`` element for each.

    >>> paragraphs(["one", "a & b"])
    '<p>one</p>\n<p>a &amp; b</p>\n'
    """
    return Html("".join(f"<p>{text(part)}</p>\n" for part in words))


def figure(name: str, image: bytes | str, caption: str, alt: str) -> Html:
    """A ``figure`` element with the id `name`, and `alt` for who cannot see it.

    The image is a PNG, to be held in the page, or the address of a picture to be linked.

    >>> print(figure("f", "f.png", "A ball.", "an arc"))
    <figure id="f"><img src="f.png" alt="an arc">
    <figcaption>A ball.</figcaption></figure>
    <BLANKLINE>
    """
    if isinstance(image, bytes):
        image = f"data:image/png;base64,{base64.b64encode(image).decode('ascii')}"
    return Html(
        f'<figure id="{name}"><img src="{image}" alt="{escape(alt)}">\n'
        f"<figcaption>{text(caption)}</figcaption></figure>\n"
    )


def table(
    caption: str, heads: Sequence[str], rows: Iterable[Sequence[str]], *, numbers: bool = True
) -> Html:
    """A ``table`` element.

    The first cell of a row names it and the others are `numbers`; or else all are sentences.

    >>> print(table("Primes", ("which", "value"), [("first", "2")]))
    <table>
    <caption>Primes</caption>
    <thead><tr><th scope="col">which</th><th scope="col" class="number">value</th></tr></thead>
    <tbody>
    <tr><th scope="row">first</th><td class="number">2</td></tr>
    </tbody>
    </table>
    <BLANKLINE>
    """
    kind = ' class="number"' if numbers else ""
    name = 'th scope="row"' if numbers else "td"

    def row(first: str, *others: str) -> str:
        cells = "".join(f"<td{kind}>{text(cell)}</td>" for cell in others)
        return f"<tr><{name}>{text(first)}</{name[:2]}>{cells}</tr>\n"

    top = "".join(
        f'<th scope="col"{kind if i else ""}>{text(head)}</th>' for i, head in enumerate(heads)
    )
    return Html(
        f"<table>\n<caption>{text(caption)}</caption>\n<thead><tr>{top}</tr></thead>\n"
        f"<tbody>\n{''.join(row(*cells) for cells in rows)}</tbody>\n</table>\n"
    )


def page(title: str, body: str, *, language: str = "en", style: str = "") -> str:
    """A whole page: the title as its heading, and below it `body`, which is HTML.

    `style` is CSS beside that of all pages.

    >>> print(page("Flight", "<p>It falls.</p>").splitlines()[-3])
    <p>It falls.</p>
    """
    return f"""<!DOCTYPE html>
<html lang="{language}">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{text(title)}</title>
<style>{_STYLE}{style}</style>
</head>
<body>
<h1>{text(title)}</h1>
{body.rstrip()}
</body>
</html>
"""


_STYLE = """
body { font: 16px/1.45 system-ui, sans-serif; color: #111; max-width: 62rem; margin: 2rem auto;
  padding: 0 1rem; }
h1 { font-size: 1.6rem; line-height: 1.2; }
h2 { font-size: 1.25rem; margin-top: 2.2rem; border-bottom: 1px solid #bbb; }
figure { margin: 1.5rem 0; break-inside: avoid; }
figure img { width: 100%; max-width: 16cm; height: auto; display: block; }
figcaption { font-size: 0.92rem; margin-top: 0.3rem; max-width: 16cm; }
table { border-collapse: collapse; font-size: 0.88rem; width: 100%; }
caption { text-align: left; margin-bottom: 0.4rem; }
th, td { text-align: left; vertical-align: top; padding: 0.35rem 0.5rem;
  border-bottom: 1px solid #ccc; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.outcome { font-weight: 700; white-space: nowrap; }
.holds { color: #14532d; }
.fails { color: #9f1239; }
.domain { color: #4b5563; font-size: 0.82rem; }
thead { display: table-header-group; }
tr { break-inside: avoid; }
@media screen and (max-width: 40rem) {
  table { display: block; overflow-x: auto; font-size: 0.8rem; }
  th, td { padding: 0.3rem; }
  th.number { white-space: normal; }
}
@page { margin: 1.8cm; }
@media print {
  body { font-size: 10pt; max-width: none; margin: 0; padding: 0; }
  h2 { break-after: avoid; }
}
"""
