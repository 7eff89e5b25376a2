"""What is asked of every page: well-formed, unique ids, links that lead somewhere, labels, headings."""

from __future__ import annotations

from html.parser import HTMLParser

VOID = {"meta", "br", "wbr", "link", "img", "input", "hr"}


class Markup(HTMLParser):
    """Reads a page and keeps what is asked of it; `faults` says what is wrong."""

    def __init__(self, text):
        super().__init__()
        self.stack, self.ids, self.hrefs, self.headings, self.faults = [], [], [], [], []
        self.words = []
        self.tables = []
        self.feed(text)
        self.close()
        self.faults += [f"<{tag}> is never closed" for tag in self.stack]

    def handle_starttag(self, tag, attributes):
        self._seen(tag, dict(attributes))
        if tag not in VOID:
            self.stack.append(tag)

    def handle_startendtag(self, tag, attributes):
        self._seen(tag, dict(attributes))

    def handle_endtag(self, tag):
        if not self.stack or self.stack.pop() != tag:
            self.faults.append(f"</{tag}> closes what is not open, at {self.getpos()}")

    def handle_data(self, data):
        if self.stack and self.stack[-1] not in ("style", "script"):
            self.words.append(data)

    def _seen(self, tag, attributes):
        self.ids += [attributes["id"]] if "id" in attributes else []
        self.hrefs += [attributes["href"]] if "href" in attributes else []
        if tag in ("h1", "h2", "h3", "h4"):
            self.headings.append(int(tag[1]))
        hidden = attributes.get("aria-hidden") == "true" or "svg" in self.stack
        if tag in ("svg", "img") and not (hidden or attributes.get("aria-label") or attributes.get("alt")):
            self.faults.append(f"<{tag}> without a label, at {self.getpos()}")
        if tag == "th" and attributes.get("scope") not in ("row", "col"):
            self.faults.append(f"<th> without a scope, at {self.getpos()}")
        if tag == "script":
            self.faults.append("a script")
        if tag == "table":
            self.tables.append(0)
        if tag == "th" and self.tables:
            self.tables[-1] += 1

    @property
    def text(self):
        return " ".join(" ".join(self.words).split())


def faults(text):
    """Everything that is wrong with a page; an empty list for a good one."""
    made = Markup(text)
    found = list(made.faults)
    found += [f"the id {name} is there twice" for name in sorted(set(made.ids)) if made.ids.count(name) > 1]
    targets = {href[1:] for href in made.hrefs if href.startswith("#")}
    found += [f"#{name} leads nowhere" for name in sorted(targets - set(made.ids))]
    found += [f"{href} leads outside" for href in made.hrefs if href.startswith(("http:", "https:", "//"))]
    if made.headings[:1] != [1] or made.headings.count(1) != 1:
        found.append("a page has one first heading")
    found += [f"h{b} after h{a}" for a, b in zip(made.headings, made.headings[1:], strict=False) if b > a + 1]
    found += ["a table without headers" for count in made.tables if not count]
    return found
