"""Builds the manual and checks that each link and picture in it resolves, and that it needs no network.

    manual.py PETROUS DOCUMENTATION    builds it with that program's reference of its commands
    manual.py --self-test              whether the check sees each fault

Exit code 77: sphinx or its Markdown is not installed.
"""
import html.parser
import pathlib
import re
import subprocess
import sys
import tempfile
import urllib.parse

SPHINX = pathlib.Path("/usr/bin/sphinx-build")
# Attributes that a browser loads by itself.
LOADED = {("img", "src"), ("script", "src"), ("link", "href"), ("source", "src"), ("iframe", "src")}


class Page(html.parser.HTMLParser):
    def __init__(self, file):
        super().__init__()
        self.anchors, self.links, self.loads = set(), [], []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)
            elif (tag, name) in LOADED:
                self.loads.append(value)
            elif tag == "a" and name == "href":
                self.links.append(value)


def faults(folder):
    """In words, of all pages below the folder."""
    folder = folder.resolve()
    pages = {file: Page(file) for file in sorted(folder.rglob("*.html"))}
    found = [] if pages else ["no page"]

    def check(file, link, external):
        parts = urllib.parse.urlsplit(link)
        where = f"{file.relative_to(folder)}: {link}: "
        if parts.scheme == "data" and not external:
            return
        if parts.scheme or parts.netloc:
            if not external or parts.scheme not in ("http", "https", "mailto"):
                found.append(where + "is loaded from elsewhere")
            return
        target = file if not parts.path else (file.parent / urllib.parse.unquote(parts.path))
        target = target.resolve()
        if folder not in target.parents or not target.is_file():
            found.append(where + "there is no such file")
        elif parts.fragment and target in pages:
            if urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                found.append(where + "there is no such place")

    for file, page in pages.items():
        for link in page.links:
            if link not in ("#", ""):
                check(file, link, True)
        for link in page.loads:
            check(file, link, False)
    for style in folder.rglob("*.css"):
        text = style.read_text(encoding="utf-8")
        for target in re.findall(r"(?:url\(|@import)\s*['\"]?([^'\")\s;]+)", text):
            if re.match(r"https?:|/", target):
                found.append(f"{style.relative_to(folder)}: {target}: is loaded from elsewhere")
    return found


def self_test():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        good = '<a href="b.html#there">1</a><a href="https://example.org">2</a><img src="c%20d.png">'
        (folder / "b.html").write_text('<h1 id="there">x</h1><a href="#there">y</a>')
        (folder / "c d.png").write_bytes(b"")
        (folder / "a.html").write_text(good)
        assert faults(folder) == [], faults(folder)
        for bad in (
            '<a href="c.html">1</a>',
            '<a href="b.html#nowhere">1</a>',
            '<a href="#nowhere">1</a>',
            '<a href="../outside.html">1</a>',
            '<img src="none.png">',
            '<script src="https://cdn.example.org/x.js"></script>',
            '<link rel="stylesheet" href="//fonts.example.org/x.css">',
        ):
            (folder / "a.html").write_text(bad)
            assert len(faults(folder)) == 1, (bad, faults(folder))
        (folder / "a.html").write_text(good)
        (folder / "s.css").write_text('@import "https://fonts.example.org/x.css"; p { background: url(a.png) }')
        assert len(faults(folder)) == 1, faults(folder)


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    petrous, documentation = sys.argv[1:]
    modules = [sys.executable, "-c", "import sphinx, myst_parser"]
    if not SPHINX.exists() or subprocess.run(modules, stderr=subprocess.DEVNULL).returncode:
        print("skipped: python3-sphinx or python3-myst-parser is not installed")
        return 77
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        quiet = ["--quiet", "--log-level", "off"]
        subprocess.run([petrous, "reference", "markdown", work, *quiet], check=True)
        source = pathlib.Path(documentation) / "manual"
        done = subprocess.run(
            [SPHINX, "-q", "-W", "--keep-going", "-d", work / "trees", source, work / "html"]
            + ["-D", f"petrous_reference={work / 'petrous.md'}"]
        )
        if done.returncode:
            return 1
        found = faults(work / "html")
        print("\n".join(found))
        index = work / "html" / "searchindex.js"
        return 1 if found or not index.is_file() else 0


sys.exit(main())
