# The manual: chapters (*.md here) that take their sections from Documentation/user-guide.md, so that
# each sentence is written once. Debian: python3-sphinx, python3-myst-parser, furo.
#
#   sphinx-build -W -D petrous_reference=petrous.md Documentation/manual OUT
#
# petrous_reference: the reference of all commands, as `petrous reference markdown FOLDER` writes it.
# In a chapter stands
#
#   <!-- guide: Heading -->          a section of the guide; the first words of its heading are enough
#   <!-- guide: Heading | Title -->  under another title
#   <!-- file: ../frames.md -->      a file without its first heading
#   <!-- reference -->               the reference of all commands
#
# Each section of the guide must stand in a chapter, and in one only.
import pathlib
import re
import unicodedata

from sphinx.errors import ExtensionError

project = "Petrous"
author = "Petrous developers"
copyright = "Petrous developers"
extensions = ["myst_parser"]
try:
    import furo  # noqa: F401

    html_theme = "furo"
except ImportError:
    html_theme = "alabaster"
html_title = "Petrous manual"
html_static_path = ["static"]
html_css_files = ["manual.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_use_index = False
smartquotes = False
language = "en"
myst_heading_anchors = None

here = pathlib.Path(__file__).resolve().parent
guide_file = here.parent / "user-guide.md"
directive = re.compile(r"^<!-- (guide|file|reference):?\s*(.*?)\s*-->$", re.M)
heading_line = re.compile(r"^(#{1,6}) (.*)$")


def slug(heading):
    """As GitHub forms the anchor of a heading."""
    kept = [c for c in heading.lower() if c in " -_" or unicodedata.category(c)[0] in "LN"]
    return "".join(kept).replace(" ", "-")


class Section:
    def __init__(self, heading):
        self.heading = heading
        self.lines = []
        self.anchors = [slug(heading)]


def sections(text):
    """Of levels 2 and 3; deeper headings belong to the section in which they stand."""
    found, code = [], False
    for line in text.splitlines():
        code ^= line.startswith("```")
        heading = None if code else heading_line.match(line)
        if heading and len(heading[1]) in (2, 3):
            found.append(Section(heading[2]))
        elif found:
            found[-1].lines.append(line)
    filled, anchors = [], []
    for one in found:  # the anchor of a heading without text is the section after it
        one.anchors = anchors = anchors + one.anchors
        if any(line.strip() for line in one.lines):
            filled.append(one)
            anchors = []
    return filled


def chapters():
    return {path.stem: path.read_text(encoding="utf-8") for path in sorted(here.glob("*.md"))}


def plan():
    """The sections by the chapter and the words that ask for them."""
    guide = sections(guide_file.read_text(encoding="utf-8"))
    asked = {}
    for chapter, text in chapters().items():
        for kind, value in directive.findall(text):
            if kind != "guide":
                continue
            words = value.split(" | ")[0]
            plain = [(one, one.heading.replace("`", "")) for one in guide]
            named = [one for one, heading in plain if heading == words] or [
                one for one, heading in plain if heading.startswith(words)
            ]
            if len(named) != 1:
                raise ExtensionError(f"{chapter}.md: {len(named)} sections of the guide: {words}")
            if named[0] in asked.values():
                raise ExtensionError(f"{chapter}.md: stands in another chapter too: {words}")
            asked[chapter, value] = named[0]
    lost = [one.heading for one in guide if one not in asked.values()]
    if lost:
        raise ExtensionError("sections of the guide that are in no chapter: " + "; ".join(lost))
    return asked


def adapted(text):
    """Links and pictures of a file of Documentation/, as seen from a chapter."""

    def link(match):
        mark, words, target = match.groups()
        if mark:
            return f"![{words}](../{target})"
        if "://" in target:
            return match[0]
        if target.startswith("#"):
            return f"[{words}](guide-{target[1:]})"
        if (here / target).is_file():  # a chapter
            return f"[{words}]({target})"
        if target.startswith("examples/"):
            return f"[{words}](../{target})"
        return words  # a file of the source tree

    return re.sub(r"(!?)\[([^\[\]]*)\]\(([^()\s]+)\)", link, text)


def command_in(synopsis):
    """`petrous nodes add NAME --host H` is a title too long: petrous nodes."""
    return " ".join(synopsis.split()[:2])


def section_text(section, title):
    body, synopsis = list(section.lines), []
    if section.heading.startswith("`"):
        synopsis = re.findall(r"`([^`]*)`", section.heading)
        title = title or ", ".join(dict.fromkeys(command_in(one) for one in synopsis))
    lines = [f"(guide-{anchor})=" for anchor in section.anchors]
    lines += [f"## {title or section.heading}", ""]
    if synopsis:
        lines += ["    " + one for one in synopsis] + [""]
    code = False
    for line in body:
        code ^= line.startswith("```")
        heading = None if code else heading_line.match(line)
        if heading:
            lines += [f"(guide-{slug(heading[2])})=", f"### {heading[2]}", ""]
        else:
            lines.append(line)
    return adapted("\n".join(lines)) + "\n"


def file_text(name):
    lines = (here / name).read_text(encoding="utf-8").split("\n")
    return adapted("\n".join(lines[1:]))


def read_source(app, chapter, source):
    def text(match):
        kind, value = match.groups()
        if kind == "guide":
            return section_text(asked[chapter, value], (value.split(" | ") + [""])[1])
        if kind == "file":
            app.env.note_dependency(str(here / value))
            return file_text(value)
        reference = app.config.petrous_reference
        if not reference:
            return "`petrous help COMMAND` lists the options of a command."
        app.env.note_dependency(reference)
        return pathlib.Path(reference).read_text(encoding="utf-8")

    app.env.note_dependency(str(guide_file))
    source[0] = directive.sub(text, source[0])


def complete_theme(app, error):
    """Debian's furo imports a style sheet of the machine on which it is built."""
    elsewhere = pathlib.Path("/usr/share/javascript/normalize.css/normalize.css")
    style = pathlib.Path(app.outdir) / "_static" / "styles" / "furo.css"
    if error or not style.is_file():
        return
    text = style.read_text(encoding="utf-8")
    line = "@import url(/javascript/normalize.css/normalize.css);"
    if line in text:
        own = elsewhere.read_text(encoding="utf-8") if elsewhere.is_file() else ""
        style.write_text(own + text.replace(line, ""), encoding="utf-8")


asked = plan()


def setup(app):
    app.add_config_value("petrous_reference", "", "env")
    app.connect("source-read", read_source)
    app.connect("build-finished", complete_theme)
