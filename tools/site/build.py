"""The book as a site of static pages.

    build.py OUT [--explorer PAGE] [--rust FOLDER] [--python FOLDER] [--notebooks FOLDER]

Every page of `docs`, of the root and of the recomputed paper and every notebook becomes an HTML page in OUT, with contents, search and a
dark theme; files of the project that a page links to are copied. PAGE is the explorer of the front page, the folders hold the pages of
the crates that `cargo doc` wrote, those of the package that `python_pages.py` wrote, and the notebooks that `notebooks.py` ran: without
that one they have no outputs. Nothing on the site asks another server for anything. Ends with 1 where a link or an anchor leads nowhere.
"""

import argparse
import html
import json
import posixpath
import re
import shutil
import sys
from pathlib import Path
from urllib.parse import unquote, urlsplit

import notebooks
from markdown_it import MarkdownIt

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
# Pages of the root, with their places on the site.
OF_ROOT = {"README.md": "readme.html", "ARCHITECTURE.md": "architecture.html", "CHANGELOG.md": "changelog.html", "CONTRIBUTING.md": "contributing.html", "SECURITY.md": "security.html", "python/README.md": "python-package.html"}
# Pages of the recomputed figures of the paper.
RESULTS = "validation/paper/results"
# The page of the front page.
EXPLORER = "explorer/index.html"
# The first pages of the interfaces for programs; the first two folders are theirs.
INTERFACES = {"Rust": "api/rust/railcrack/index.html", "Python": "api/python/railcrack.html"}
# Headings of the contents, by the beginning of the places below them.
GROUPS = {"how-to/": "How to", "python/notebooks/": "Notebooks", "python/": "Python", "dev/": "For developers"}
# Files that a page may show as text are copied; folders become a list of theirs.
FILES = "files"


def slug(text, seen):
    """The anchor of a heading, as forges make it."""
    kept = re.sub(r"[^\w\- ]", "", text.strip().lower()).replace(" ", "-")
    count = seen.get(kept, 0)
    seen[kept] = count + 1
    return f"{kept}-{count}" if count else kept


def pages():
    """Every page: its path in the project and its place on the site."""
    found = {Path(path): place for path, place in OF_ROOT.items()}
    for path in sorted((ROOT / RESULTS).glob("*.md")):
        found[path.relative_to(ROOT)] = f"paper/{path.stem}.html"
    for path in sorted((ROOT / "docs").rglob("*.md")):
        inner = path.relative_to(ROOT / "docs")
        place = "book.html" if inner == Path("README.md") else str(inner.with_suffix(".html")).replace("README.html", "index.html")
        found[path.relative_to(ROOT)] = place
    for path in sorted(notebooks.SOURCES.glob("*.ipynb")):
        found[path.relative_to(ROOT)] = f"python/notebooks/{path.stem}.html"
    return found


def plain(heading):
    """The text of a heading."""
    return "".join(child.content for child in heading.children if child.type in ("text", "code_inline"))


class Site:
    def __init__(self, out, explorer, interfaces, executed):
        self.out, self.explorer, self.interfaces, self.executed = out, explorer, interfaces, executed
        self.pages = pages()
        self.faults = []
        self.anchors = {}
        self.links = []
        self.index = []
        self.copied = {}
        self.titles = {}
        self.markdown = MarkdownIt("commonmark", {"html": True}).enable(["table", "strikethrough"])

    # ---- Links ----

    def target(self, source, link):
        """Where `link` on the page `source` of the project leads on the site."""
        parts = urlsplit(link)
        if parts.scheme or link.startswith("//"):
            return link
        here = self.pages[source]
        if not parts.path:
            self.links.append((source, here, parts.fragment))
            return link
        path = Path(posixpath.normpath((source.parent / unquote(parts.path)).as_posix()))
        if path in self.pages:
            place = self.pages[path]
        elif (ROOT / path).is_file():
            place = self.copy(path)
        elif (ROOT / path).is_dir():
            place = self.listing(path)
        else:
            self.faults.append(f"{source}: {link} leads nowhere")
            return link
        self.links.append((source, place, parts.fragment))
        relative = posixpath.relpath(place, posixpath.dirname(here) or ".")
        return relative + (f"#{parts.fragment}" if parts.fragment else "")

    def copy(self, path):
        if path not in self.copied:
            place = path.relative_to("docs").as_posix() if path.parts[0] == "docs" else f"{FILES}/{path.as_posix()}"
            # A browser shows these as text.
            if path.suffix in (".toml", ".csv", ".rs", "") and path.parts[0] != "docs":
                place += ".txt"
            (self.out / place).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(ROOT / path, self.out / place)
            self.copied[path] = place
        return self.copied[path]

    def listing(self, folder):
        place = f"{FILES}/{folder.as_posix()}/index.html"
        if folder not in self.copied:
            self.copied[folder] = place
            items = []
            for path in sorted((ROOT / folder).iterdir()):
                if path.is_file():
                    own = self.copy(path.relative_to(ROOT))
                    items.append(f'<li><a href="{posixpath.relpath(own, posixpath.dirname(place))}">{html.escape(path.name)}</a></li>')
            self.write(place, folder.as_posix(), f"<h1>{html.escape(folder.as_posix())}</h1>\n<ul>{''.join(items)}</ul>")
        return place

    # ---- Pages ----

    def parse(self, source):
        if source.suffix == ".ipynb":
            return list(notebooks.tokens(self.executed / source.name, self.markdown))
        return self.markdown.parse((ROOT / source).read_text())

    def render(self, source, tokens):
        """HTML of a page; its sections go into the index."""
        place, seen, anchors = self.pages[source], {}, set()
        title, heading, anchor, words = None, None, "", []
        sections = []
        for i, token in enumerate(tokens):
            if token.type == "heading_open":
                text = plain(tokens[i + 1])
                own = slug(text, seen)
                token.attrSet("id", own)
                anchors.add(own)
                sections.append((heading, anchor, words))
                title = title or text
                heading, anchor, words = text, own if token.tag != "h1" else "", []
            elif token.type == "inline":
                for child in token.children:
                    if child.type == "link_open":
                        child.attrSet("href", self.target(source, child.attrGet("href")))
                    elif child.type == "image":
                        child.attrSet("src", self.target(source, child.attrGet("src")))
                        child.attrSet("loading", "lazy")
                words.append(" ".join(child.content for child in token.children if child.content))
            elif token.type in ("fence", "code_block"):
                words.append(token.content)
        sections.append((heading, anchor, words))
        self.anchors[place] = anchors
        for heading, anchor, words in sections:
            text = re.sub(r"\s+", " ", " ".join(words)).strip()
            if heading and text:
                self.index.append({"page": place, "anchor": anchor, "title": title, "heading": heading, "text": text})
        body = self.markdown.renderer.render(tokens, self.markdown.options, {})
        body = re.sub(r'<(h[2-4]) id="([^"]*)">(.*?)</\1>', r'<\1 id="\2"><a class="own" href="#\2">\3</a></\1>', body)
        if source.suffix == ".ipynb":
            body += f'<p><a href="{posixpath.relpath(self.copy(source), posixpath.dirname(place))}">The notebook as a file</a></p>\n'
        # A heading with a link of its own keeps it.
        body = re.sub(r'<a class="own" href="#[^"]*">((?:(?!</h).)*<a .*?)</a>(</h[2-4]>)', r"\1\2", body)
        return body.replace("<table>", '<div class="table"><table>').replace("</table>", "</table></div>")

    def contents(self, place):
        """The list of pages, the one at `place` marked."""
        groups = {name: [] for name in ["", "How to", "Python", "Notebooks", "For developers"]}
        for own in self.order:
            groups[next((name for start, name in GROUPS.items() if own.startswith(start)), "")].append(own)
        parts = []
        base = posixpath.dirname(place) or "."
        for name, own in groups.items():
            def item(page):
                mark = ' aria-current="page"' if page == place else ""
                return f'<li><a href="{posixpath.relpath(page, base)}"{mark}>{html.escape(self.titles[page])}</a></li>'

            items = "".join(item(page) for page in own)
            parts.append((f"<h2>{name}</h2>" if name else "") + f"<ul>{items}</ul>")
        items = [f'<li><a href="{posixpath.relpath(page, base)}">{name}</a></li>' for name, (_, page) in self.interfaces.items()]
        api = f'<h2>API</h2><ul>{"".join(items)}</ul>' if items else ""
        return "".join(parts) + api

    def write(self, place, title, body, wide=False):
        base = posixpath.relpath(".", posixpath.dirname(place) or ".")
        base = "" if base == "." else f"{base}/"
        explorer = f'<a href="{base}{EXPLORER}">Explorer</a> ' if self.explorer else ""
        page = f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<link rel="icon" href="data:,">
<link rel="stylesheet" href="{base}style.css">
<title>{html.escape(title)}{"" if title == "railcrack" else " · railcrack"}</title>
</head>
<body data-base="{base}"{' class="wide"' if wide else ""}>
<header class="top"><a class="home" href="{base}index.html">railcrack</a>
<input type="search" id="search" placeholder="Search the book ( / )" aria-label="Search the book">
{explorer}<a href="{base}book.html">Book</a>
<button type="button" id="theme">Theme</button>
<ul id="found" hidden></ul></header>
<div class="body">
<nav aria-label="Contents"><details class="contents"><summary>Contents</summary>{self.contents(place)}</details></nav>
<main>
{body}
</main>
</div>
<script src="{base}site.js"></script>
</body>
</html>
"""
        path = self.out / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(page)

    def build(self):
        shutil.rmtree(self.out, ignore_errors=True)
        self.out.mkdir(parents=True)
        parsed = {source: self.parse(source) for source in self.pages}
        for source, tokens in parsed.items():
            # Titles first: every page has the list of all of them.
            headings = (plain(tokens[i + 1]) for i, token in enumerate(tokens) if token.type == "heading_open")
            self.titles[self.pages[source]] = next(headings, str(source))
        first = [self.pages[path] for path in linked(ROOT / "docs/README.md", self.pages)]
        rest = [place for place in self.pages.values() if place not in first]
        self.order = list(dict.fromkeys(["book.html", *first, *rest]))
        bodies = {source: self.render(source, tokens) for source, tokens in parsed.items()}
        for source, body in bodies.items():
            self.write(self.pages[source], self.titles[self.pages[source]], body)
        for name in ["style.css", "site.js"]:
            shutil.copyfile(HERE / name, self.out / name)
        (self.out / "search-index.js").write_text(f"window.railcrackIndex = {json.dumps(self.index, ensure_ascii=False)};\n")
        if self.explorer:
            (self.out / EXPLORER).parent.mkdir(parents=True)
            shutil.copyfile(self.explorer, self.out / EXPLORER)
        for folder, page in self.interfaces.values():
            shutil.copytree(folder, self.out / "/".join(page.split("/")[:2]))
        self.write("index.html", "railcrack", FRONT if self.explorer else FRONT.replace(FRAME, ""), wide=True)

    # ---- Links of the finished site ----

    def check(self):
        """What a browser would not find: files and anchors, in the pages as they were written."""
        ids = {}

        def anchors(path):
            if path not in ids:
                ids[path] = set(re.findall(r'\bid="([^"]+)"', path.read_text(errors="replace")))
            return ids[path]

        # Links among the pages of the crates are checked by `cargo doc`.
        ours = [path for path in self.out.rglob("*.html") if path.relative_to(self.out).parts[:2] != ("api", "rust")]
        count = 0
        for page in ours:
            if page == self.out / EXPLORER:
                continue
            text = re.sub(r"(<script\b[^>]*>).*?(</script>)", r"\1\2", page.read_text(), flags=re.DOTALL)
            for link in re.findall(r'(?:href|src)="([^"]*)"', text):
                parts = urlsplit(html.unescape(link))
                if parts.scheme in ("http", "https", "mailto", "data"):
                    continue
                count += 1
                target = page if not parts.path else (page.parent / unquote(parts.path)).resolve()
                if not target.is_file():
                    self.faults.append(f"{page.relative_to(self.out)}: {link} leads nowhere")
                elif parts.fragment and target.suffix == ".html" and parts.fragment not in anchors(target):
                    self.faults.append(f"{page.relative_to(self.out)}: {link} has no such anchor")
        return len(ours), count


FRAME = f'<p><iframe src="{EXPLORER}" title="The explorer: a crack in a rail, computed in this page"></iframe></p>\n<p><a href="{EXPLORER}">The explorer on a page of its own</a>, whose address keeps what you set.</p>'
FRONT = f"""<h1>railcrack predicts the growth of rolling-contact-fatigue cracks in rails</h1>
<p>Move a slider: the crack is computed anew in this page, by the program itself. Nothing is sent anywhere.</p>
{FRAME}
<h2 id="next">Next</h2>
<ul>
<li><a href="readme.html">What railcrack is, and how to install it</a></li>
<li><a href="tutorial.html">Tutorial</a>: from the installation to a first decision on a rail</li>
<li><a href="limits.html">Limits</a>: when not to trust a result</li>
<li><a href="theory.html">Theory</a>, <a href="dev/verification.html">verification</a>, <a href="validation.html">comparison with measurements</a></li>
<li><a href="book.html">The whole book</a></li>
</ul>"""


def linked(path, known):
    """Pages that the contents of the book link to, in order."""
    for link in re.findall(r"\]\(([^)#]+\.md)", path.read_text()):
        own = Path(posixpath.normpath((path.relative_to(ROOT).parent / link).as_posix()))
        if own in known:
            yield own


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("out", type=Path)
    arguments.add_argument("--explorer", type=Path)
    for language in INTERFACES:
        arguments.add_argument(f"--{language.lower()}", type=Path)
    arguments.add_argument("--notebooks", type=Path, default=notebooks.SOURCES)
    given = arguments.parse_args()
    folders = {language: getattr(given, language.lower()) for language in INTERFACES}
    interfaces = {language: (folders[language], page) for language, page in INTERFACES.items() if folders[language]}
    site = Site(given.out.resolve(), given.explorer, interfaces, given.notebooks)
    site.build()
    count, links = site.check()
    for fault in sorted(set(site.faults)):
        print(fault, file=sys.stderr)
    size = sum(path.stat().st_size for path in site.out.rglob("*") if path.is_file())
    print(f"{count} pages, {links} links, {len(site.index)} sections in the search, {size / 1e6:.1f} MB in {given.out}")
    return 1 if site.faults else 0


if __name__ == "__main__":
    sys.exit(main())
