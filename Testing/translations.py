"""Checks the translations: each text of the sources has one, with the same placeholders,
line ends, tags and final colon, an ampersand for a key where the English has one, and its ellipsis.

    translations.py RESOURCES    the folder `translations` there
    translations.py --self-test  whether the check sees each fault

Without lupdate the sources are not compared.
"""
import importlib.machinery
import importlib.util
import pathlib
import re
import sys
import tempfile
import xml.etree.ElementTree

# What a translation has as often as the English text.
ALIKE = {
    "placeholders": r"%(?:[L~#]?\d+|n|p)",
    "keys": r"&(?=[^\s&])",
    "ellipses": r"…|\.\.\.",
    "tags": r"<[^<>]+>",
    "line ends": r"\n",
    "file patterns": r"\*\.?\w*",
    "a colon at the end": r":\s*$",
    "space at the beginning": r"^\s+",
    "space at the end": r"\s+$",
}


def faults_of(english, german):
    return [what for what, pattern in ALIKE.items()
            if sorted(re.findall(pattern, english)) != sorted(re.findall(pattern, german))]


def messages(file):
    """(context, English, German or None if unfinished)."""
    for context in xml.etree.ElementTree.parse(file).iter("context"):
        for message in context.iter("message"):
            translation = message.find("translation")
            german = "".join(translation.itertext())
            yield (context.findtext("name"), message.findtext("source"),
                   german if german and not translation.get("type") else None)


def faults(file):
    """In words."""
    found, seen = [], set()
    for context, english, german in messages(file):
        where = f"{context}: {english!r}: "
        if (context, english) in seen:
            found.append(where + "twice")
        seen.add((context, english))
        if german is None:
            found.append(where + "unfinished")
        else:
            found += [where + f"{what} differ in {german!r}" for what in faults_of(english, german)]
    return found or ([] if seen else ["no text"])


def drift(file, updater):
    """What the sources have and the file has not, and the other way round."""
    with tempfile.TemporaryDirectory() as folder:
        fresh = pathlib.Path(folder) / file.name
        fresh.write_bytes(file.read_bytes())
        updater.update(fresh)
        now = {message[:2] for message in messages(fresh)}
    kept = {message[:2] for message in messages(file)}
    return ([f"{context}: {text!r}: not in {file.name}; run {updater.__file__}"
             for context, text in sorted(now - kept)] +
            [f"{context}: {text!r}: no longer in the sources; run {updater.__file__}"
             for context, text in sorted(kept - now)])


def load(script):
    loader = importlib.machinery.SourceFileLoader("update", str(script))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("update", loader))
    loader.exec_module(module)
    return module


def self_test():
    alike = [("&Open %1…", "%1 &öffnen…"), ("a & b:", "a & b:"), ("<b>%1</b>", "<b>%1</b>"),
             ("%1 of %2", "%2 mit %1"), ("All (*)", "Alle (*)"), (" or ", " oder ")]
    unlike = [("%1", "1"), ("%1 %2", "%1 %1"), ("&Open", "Öffnen"), ("Open", "&Öffnen"),
              ("Open…", "Öffnen"), ("Open…", "Öffnen..."), ("<b>a</b>", "<b>a<b>"), ("Name:", "Name"),
              ("Name", "Name:"), ("a\nb", "a b"), (" or ", " oder"), ("%n files", "Dateien"),
              ("Tables (*.csv)", "Tabellen (*.cvs)"), ("%~1: %2", "%1: %2")]
    found = [f"{pair}: differ" for pair in alike if faults_of(*pair)]
    found += [f"{pair}: alike" for pair in unlike if not faults_of(*pair)]
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "x.ts"
        for body, whole in [("<translation>Öffnen</translation>", True),
                            ("<translation></translation>", False),
                            ('<translation type="unfinished">Öffnen</translation>', False),
                            ('<translation type="vanished">Öffnen</translation>', False)]:
            file.write_text('<TS><context><name>C</name><message><source>Open</source>'
                            f"{body}</message></context></TS>", encoding="utf-8")
            if (not faults(file)) != whole:
                found.append(f"{body}: {faults(file)}")
    return found + phrases_test()


def phrases_test():
    """Whether phrases are those that a source puts together."""
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Resources/translations"))
    import phrases
    sources = [
        ('throw E("a " + name + " of " + std::to_string(n) + (n == 1 ? " part" : " parts") + '
         '(n == 1 ? " is" : " are") + ": " + error.what()); // "no text"',
         ["a %1 of %#2 part is: %~3", "a %1 of %#2 parts are: %~3"]),
        ('return isBad ? "it is bad" : path.string() + ": " "it is \\"good\\"";',
         ["it is bad", '%1: it is "good"']),
        ('list.push_back({std::string("one ") + two, "three"});', ["one %1", "three"]),
        ('core::log::info("not shown"); x["key of JSON"] = "shown";', ["shown"]),
    ]
    found = []
    phrases.said(phrases.tree('progress.report(0.5, "masking"); part.report(1.0, a ? "b1" : "c");'
                              'report("not"); code("nor");'), found, phrases.is_progress)
    wrong = [] if found == ["masking", "b1", "c"] else [f"of progress: {found}"]
    return wrong + [f"{source}: {phrases.texts(source)}" for source, expected in sources
                    if sorted(phrases.texts(source)) != sorted(expected)]


def main():
    if sys.argv[1:] == ["--self-test"]:
        found = self_test()
    elif len(sys.argv) == 2:
        folder = pathlib.Path(sys.argv[1]) / "translations"
        files = sorted(folder.glob("*.ts"))
        found = [] if files else [f"{folder}: no translations"]
        updater = load(folder / "update")
        for file in files:
            found += faults(file)
            if updater.LUPDATE or file.name.startswith("phrases"):
                found += drift(file, updater)
            else:
                print("lupdate is not installed: the sources are not compared")
    else:
        sys.exit(__doc__)
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
