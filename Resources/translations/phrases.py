"""The phrases of the presenters and modules, for the German window and report: the texts of their
sources as they are put together with +, with "%1" where a name or a path is put in, "%#1" where a
number is and "%~1" where another text of the program is. Each value of `condition ? a : b` makes a
phrase. See Documentation/adr/0030-german-below-the-window.md.
"""
import json
import pathlib
import re
import xml.etree.ElementTree

TREE = pathlib.Path(__file__).resolve().parent.parent.parent
TOKEN = re.compile(r'''
    (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<raw>R"(?P<tag>[^()\s\\]{0,16})\((?P<body>.*?)\)(?P=tag)")
  | (?P<string>(?:u8)?"(?:[^"\\\n]|\\.)*")
  | (?P<char>'(?:[^'\\]|\\.)+')
  | (?P<number>\d[\w.']*)
  | (?P<word>[A-Za-z_]\w*)
  | (?P<directive>^[ \t]*\#(?:[^\n]*\\\n)*[^\n]*)
  | (?P<mark>::|->|\+\+|--|\+=|==|!=|<=|>=|&&|\|\||<<|[^\s])
''', re.X | re.S | re.M)
ESCAPES = {"n": "\n", "t": "\t", '"': '"', "\\": "\\", "'": "'", "0": "\0", "r": "\r", "?": "?"}
STRING_OR_NOTHING = ([], ["std", "::", "string"], ["std", "::", "string_view"])
CLOSING = {"(": ")", "[": "]", "{": "}"}
SEPARATORS = {",", ";", "return", "throw", "=", "+=", "<<", "&&", "||", "==", "!=", "<=", ">=",
              "else", "case", "default", "<", ">"}
# Whose value is a text of the program and not a name or a number.
TEXT_OF_PROGRAM = re.compile(
    r"what|[tT]exts?$|[wW]ords?$|why|reason|problem|refusal|refused|message|note|describe|remark|"
    r"advice|kind|verb|explan|hint|said|say|question|phrase|missing|effect|limit|cause|range|unit|"
    r"[nN]amed$|wanted|listed|joined|^list|possible|expected|counted|plural|many|states|"
    r"[tT]oString|verdict|fault|field|doubts|remedy|about|instead|decimation|goesOn|^is$|primary|kSides|^ours$|"
    r"^others$|^code$")
NOT_TEXT = re.compile(
    r"^(to_string|fixedText|generalText|plainText|lengthText|exactText|string|filename|size|name|path|"
    r"pathText|hexText)$")
# Functions that give a number, perhaps with its unit.
NUMBERS = {"to_string", "fixedText", "generalText", "plainText", "lengthText", "exactText", "decimals", "fixed",
           "percent", "millimetres", "gigabytes", "seconds", "roughText"}


def unescaped(literal):
    def one(match):
        text = match.group(1)
        if text[0] == "x":
            return bytes([int(text[1:], 16)]).decode("latin-1")
        if text[0] in "uU":
            return chr(int(text[1:], 16))
        return ESCAPES.get(text, text)
    body = literal[literal.index('"') + 1:-1]
    body = re.sub(r"(?:\\x[0-9a-fA-F]{2})+", lambda m: bytes.fromhex(
        m.group(0).replace("\\x", "")).decode("utf-8", "replace"), body)
    return re.sub(r"\\(x[0-9a-fA-F]{2}|u[0-9a-fA-F]{4}|U[0-9a-fA-F]{8}|.)", one, body, flags=re.S)


class Literal(str):
    pass


class Group(list):
    """What is between brackets."""
    def __init__(self, opening):
        super().__init__()
        self.opening = opening


def tree(source):
    root = Group("")
    stack = [root]
    for match in TOKEN.finditer(source):
        kind = match.lastgroup
        if kind in ("comment", "directive"):
            continue
        if match.group("raw"):
            stack[-1].append("RAW")
            continue
        if kind == "string":
            text = unescaped(match.group("string"))
            if stack[-1] and isinstance(stack[-1][-1], Literal):
                stack[-1][-1] = Literal(stack[-1][-1] + text)
            else:
                stack[-1].append(Literal(text))
            continue
        token = match.group(0)
        if token in CLOSING:
            group = Group(token)
            stack[-1].append(group)
            stack.append(group)
        elif token in CLOSING.values() and len(stack) > 1:
            stack.pop()
        else:
            stack[-1].append(token)
    return root


def is_literal(token):
    return isinstance(token, Literal)


def split(tokens, mark):
    parts = [[]]
    for token in tokens:
        if not isinstance(token, (Group, Literal)) and token == mark:
            parts.append([])
        else:
            parts[-1].append(token)
    return parts


def is_mark(token):
    return not isinstance(token, (Group, Literal))


def ternary(tokens):
    """Condition and the two values of `condition ? a : b`, or None."""
    depth, at = 0, None
    for n, token in enumerate(tokens):
        if not is_mark(token):
            continue
        if token == "?":
            depth += 1
            at = n if at is None else at
        elif token == ":" and depth:
            depth -= 1
            if depth == 0:
                return spelled(tokens[:at]), tokens[at + 1:n], tokens[n + 1:]
    return None


def flat(tokens):
    for token in tokens:
        if isinstance(token, Group):
            yield from flat(token)
        else:
            yield token


def words_of(tokens):
    return [t for t in flat(tokens) if not isinstance(t, Literal) and re.match(r"[A-Za-z_]", t)]


class Argument:
    def __init__(self, mark):
        self.mark = mark  # "": a name, "#": a number, "~": a text of the program


def spelled(tokens):
    return " ".join(f"({spelled(t)})" if isinstance(t, Group) else t for t in tokens)


def values(tokens):
    """Ways the expression can read: each the choices that lead to it, and a list of literals and
    arguments; None: no text."""
    choice = ternary(tokens)
    if choice:
        condition, *branches = choice
        ways = []
        for is_first, branch in zip((True, False), branches):
            of = values(branch) or [({}, [Argument("~")])]
            ways += [({**choices, condition: is_first}, pieces) for choices, pieces in of
                     if choices.get(condition, is_first) == is_first]
        return ways
    each = []
    for operand in split(tokens, "+"):
        if not operand:
            return None
        if len(operand) == 1 and is_literal(operand[0]):
            each.append([({}, [operand[0]])])
            continue
        inner = operand[-1]
        if isinstance(inner, Group) and inner.opening in "({" and operand[:-1] in STRING_OR_NOTHING:
            if not inner:
                each.append([({}, [])])
                continue
            of = None if "," in [t for t in inner if is_mark(t)] else values(list(inner))
            if of:
                each.append(of)
                continue
        names = words_of(operand)
        is_text = any(is_literal(t) and re.search("[a-z]{3}", t) for t in flat(operand)) or (
            not any(NOT_TEXT.match(n) for n in names) and
            any(TEXT_OF_PROGRAM.search(n) for n in names))
        is_number = (1 < len(operand) < 5 and isinstance(operand[-1], Group)
                     and is_mark(operand[-2]) and operand[-2] in NUMBERS)
        each.append([({}, [Argument("#" if is_number else "~" if is_text else "")])])
    ways = [({}, [])]
    for options in each:
        ways = [({**before, **choices}, pieces + more)
                for before, pieces in ways for choices, more in options
                if all(before.get(condition, value) == value
                       for condition, value in choices.items())]
        if len(ways) > 48:
            return None
    return ways


def pattern(way):
    text, count = "", 0
    previous_argument = False
    for piece in way:
        if isinstance(piece, Argument):
            if previous_argument:
                text = re.sub(r"%[#~]?(\d+)$", lambda m: "%~" + m.group(1), text)
                continue
            count += 1
            text += "%" + piece.mark + str(count)
            previous_argument = True
        elif piece:
            text += piece
            previous_argument = False
    # The place of an error is a phrase with its preposition.
    return re.sub(r"\(p95\) at %[#~]?(\d+)", r"(p95) %~\1", text)


SKIPPED_CALLS = re.compile(r"^(info|debug|warning|error|trace|write|record)$")


def collect(group, found, callee=None):
    """The texts in what is between brackets and in all brackets within."""
    segment = []

    def finish():
        nonlocal segment
        tokens, segment = segment, []
        if not tokens:
            return
        if any(is_literal(t) for t in flat(tokens)):
            take(tokens, found)

    for token in group:
        if not isinstance(token, (Group, Literal)) and token in SEPARATORS:
            finish()
        else:
            segment.append(token)
    finish()


def skip_call(tokens, n):
    """Whether the group at n is an index or the arguments of a log line."""
    group = tokens[n]
    if group.opening == "[":
        return n > 0
    before = [t for t in tokens[max(0, n - 4):n] if isinstance(t, str)]
    return bool(before) and "log" in before and SKIPPED_CALLS.match(before[-1]) is not None


def take(tokens, found):
    ways = values(tokens)
    for _, way in ways or []:
        if any(is_literal(p) and p for p in way):
            found.append(pattern(way))
    # and what the brackets within have on their own
    for n, token in enumerate(tokens):
        if isinstance(token, Group) and not skip_call(tokens, n):
            inside_plain = token.opening == "(" and (n == 0 or tokens[n - 1] in ("+", "string"))
            if inside_plain and ways:
                for t in flat_groups(token):
                    collect(t, found)
            else:
                collect(token, found)


def flat_groups(group):
    for token in group:
        if isinstance(token, Group):
            yield token


def texts(source):
    found = []
    collect(tree(source), found)
    return found


# What the window throws and says of its progress itself; its other texts go through tr().
SAYS = {"InvalidParameter", "report", "check"}


def said(group, found, is_saying=lambda before: before[-1] in SAYS):
    for n, token in enumerate(group):
        if isinstance(token, Group):
            before = [t if is_mark(t) else "" for t in ["", "", "", *group[max(0, n - 3):n]]]
            (collect(token, found) if is_saying(before) else said(token, found, is_saying))


def is_progress(before):
    """Whether what is in the brackets after these tokens is said of a progress, where one word is a
    text."""
    return before[-1] == "report" and before[-2] in (".", "->")


# As undo names what is changed in an appearance (lookEdit).
NOUN = re.compile(r'\.called\("([^"]+)"\)')


def appearances():
    table = TREE / "Modules/Appearance/include/petrous/Appearance/StructureProperties.h"
    for noun in [*NOUN.findall(table.read_text(encoding="utf-8")), "appearance"]:
        yield from (f"{noun} of %1", f"{noun} of bone", f"{noun} of tissue")


# Sources without phrases: words that are looked for, formats, and errors that only a defect of the
# program causes.
WITHOUT = set("""
    BurrShell Catalogue CheckedParameters ClippedRegion ConstrainedProxy ContactQp
    DicomWriter DistanceField ForceDisplay ForceLimits GlProgram GoneNames HapticField
    HeaderCache IdentityText IntensityHistogram IntensityVolume LabelField LabelMap
    LabelPriority LevelImage Log NotedProvenance OccupancyGrid PassivityGuard
    Pedal PedalledDevice Phantom PhantomShapes PixelRays PointProxy PointerDevice
    PointerToolController RateControl RayCaster RayShader RayView ReferenceRayCaster
    RemovalDepthSolver RemovalLaw RenderQuality ReportHtml ReportWords SamplePatient SceneCheck
    SegmentationWriter Servo ServoParameters ServoThread SnapshotBuffer SpscRing
    Stereo StructurePresets SurfaceDistance SurfaceGeometry SweptSphereCut
    TissueBricks TissueField TissueOptics TissueResistance ToolInteraction ToolView
    ViewArrangement Volume VolumeMapper VtkVolume
""".split())
# Of these the sources have single words, which are not told from names and codes otherwise.
SHORT = {" ".join(word.split()) for word in """
    Axial | Coronal | Sagittal | back | feet | front | head | changed | unreadable | %#1 (%#2 images) | %#1 empty | %#1 meshes | %#1 mm ± %#2 | %#1 mm ± %2 | %#1 parts | %#1
    slices | %#1 stroke | %#1 strokes | %#1 structures | %#1 to %#2 | %#1 to %~2 | %#1 x %#2 x
    %#3 voxels | %1 '%2' (%3, %#4 slices) | %1 '%2' (%3, %4 slices) | %1 (%#2 images) | %1 (%2
    images) | %1 (%2, %#3 slices) | %1 (%2, %3 slices) | %1 empty | %1 meshes | %1 mm ± %#2 | %1
    mm ± %2 | %1 parts | %1 slices | %1 stroke | %1 strokes | %1 structures | %1 x %2 x %3
    voxels | %~1 interpolated | %~1 mm ± %#2 | %~1 mm ± %2 | Along a structure | Angle | Area |
    Axial | Bone | Coronal | Distance | MR '%1' | Mark | None | Sagittal | angle | appearance |
    area | background | cancelled | case | closed | color | create | create %1 | cutting | damaged | diamond
    | difference %1 | dimensions | dissected | distance | document | doubtful | drilled |
    edges | emptied | empty | encrypted | exposure | failed | good | gradient %#1 | gradient %1 | grain | growing | half |
    hand | hide %1 | hide %~1 | image | islands | iso | kept | label %#1 | label %1 | labels |
    landmarks | left | length | margin | mark | mark %#1 | mark %1 | mask | mesh | metadata | missing |
    move %~1 | nerve | node | none | ok | one | opacity | other | point | points | position |
    preset | read | recording | redoing | refused | remove %~1 | removed | repairable | repeat
    %#1 | repeat %1 | resampling | right | screenshot | series | set aside | shadows | show %1 | show %~1
    | side | skipped | slices | smoothing | stroke | structure | structure %#1 | structure %1 |
    structures | study | surface | the CT | the MR '%1' | thickness | thickness along the normal
    | threshold | tilt %#1 | tilt %1 | tissue | to '%1' | transfer | tube | undoing | unknown | unread |
    video | view | volume | wall | wetness | withheld | rigid | patient ID | above 0 GPa | above 0 HV |
    within -60 to 60 degrees
""".split("|")}
# Found, and no phrases: words of formats, parts of phrases, errors that only a defect causes.
NOT_PHRASES = set(r"""
Petrous. %~1
Petrous, %1. %~2
Petrous %1. %~2
Petrous %1, %2. %~3
SpaceMouse Plus XT
SpaceNavigator for Notebooks
the largest speed must be above 0 mm/s
the largest angular speed must be above 0 rad/s
the reach must be above 0 mm
readings must be stale after more than 0 s
the quaternion's tolerance must be above 0
at least 1 good reading is needed
Another volume of the series goes on for %~1 before the first slice of this one and ; the stack has no gap, but its ends may be missing. Look whether all of the skull base that is needed is there.
Another volume of the series goes on for  and %~1 beyond its last slice; the stack has no gap, but its ends may be missing. Look whether all of the skull base that is needed is there.
Another volume of the series goes on for  and ; the stack has no gap, but its ends may be missing. Look whether all of the skull base that is needed is there.
Another volume of the series goes on for ; the stack has no gap, but its ends may be missing. Look whether all of the skull base that is needed is there.
is missing from the files and was
are missing and were
files are written in host byte order
label map: no voxels given to write
label layers: none given to write, or on different grids
Segment%#1_
TerminologyEntry:Segmentation category and type - DICOM master list~%~1~%~2~%~3~Anatomic codes - DICOM master list~%~4~%~5|
Binary labelmap|
Binary labelmap
space directions
space origin
domain domain domain
data file
line skip
The seed at
The range of
The region has
The region reaches
byte skip
unsigned short
signed char
unsigned char
short int
signed short
signed short int
unsigned short int
signed int
unsigned int
long long
long long int
signed long long
signed long long int
unsigned long long
unsigned long long int
space units
old min
archive %1
more is
more are
video%1
Petrous scene
petrous-scene creator
phantom: the noise must be 0 to 1000
scanning the phantom
labelling the phantom
labels %1 %2
""".strip("\n").split("\n"))
# Put together in steps, which a reading of single expressions does not see.
ASSEMBLED = [
    "%1 touched (± %#2 mm)",
    "under 0.01 mm³",
    *(f"{did} {what}" for did in ("show", "hide") for what in ("bone", "tissue")),
    "view '%1'",
    "removal of view '%1'",
    "at (%#1, %#2, %#3)",
    "at the middle of '%1'",
    "at the centre of the %~1",
    "at the centre of what both images show",
]
ENDS = " ,;:"


def is_phrase(text):
    if any(ord(letter) < 32 and letter != "\n" for letter in text):
        return False  # bytes of a file
    if text in NOT_PHRASES:
        return False
    if text in SHORT:
        return True
    plain = re.sub(r"%[#~]?\d+", " X ", text)
    if not re.search(r"[a-z]{3}", plain) or "\n" in text:
        return False
    if re.search(r"[{}<>=#]|gl_", plain) and not re.search(r"[a-z]+ [a-z]+ [a-z]+", text):
        return False
    return bool(re.search(r"[a-z]{2,}[,;:.')”]* +[a-zX('%“]|^(by|at|of|in|on|and|or) X", plain))


def sources():
    for folder in (TREE / "Application" / "Presenters", *sorted((TREE / "Modules").iterdir())):
        for file in sorted(folder.rglob("*")):
            if (file.suffix in (".cpp", ".h", ".cxx") and file.stem not in WITHOUT
                    and not {"Testing", "Benchmarks"} & set(file.parts)):
                yield folder.name, file


def phrases():
    """Pairs of folder and phrase, each phrase once; without the words of the report, which has its
    own table of them."""
    report = set(texts((TREE / "Application" / "Presenters" / "src" / "Share" /
                        "ReportWords.cpp").read_text(encoding="utf-8")))
    found = {}
    for folder, file in sources():
        for text in texts(file.read_text(encoding="utf-8")):
            text = text.strip(ENDS)
            if is_phrase(text) and not (file.stem == "PlanReport" and text in report):
                found.setdefault(text, folder)
    for file in sorted((TREE / "Application" / "Workstation").rglob("*.cpp")):
        if "Testing" not in file.parts:
            of_window = []
            said(tree(file.read_text(encoding="utf-8")), of_window)
            for text in of_window:
                if is_phrase(text.strip(ENDS)):
                    found.setdefault(text.strip(ENDS), "Workstation")
    for folder in ("Application/Presenters", "Application/Workstation", "Modules"):
        for file in sorted((TREE / folder).rglob("*.cpp")):
            of_progress = []
            if not {"Testing", "Benchmarks"} & set(file.parts):
                said(tree(file.read_text(encoding="utf-8")), of_progress, is_progress)
            for text in of_progress:
                if re.search(r"[a-z]{3}", text):
                    found.setdefault(text.strip(ENDS), "Progress")
    for text in (*ASSEMBLED, *appearances()):
        found.setdefault(text, "Assembled")
    for material in json.loads((TREE / "Resources" / "materials.json").read_text())["materials"]:
        found.setdefault(material["title"], "Materials")
        found.setdefault(material["certainty"], "Materials")
        found.setdefault(material["status"], "Materials")
    for burr in json.loads((TREE / "Resources" / "burrs.json").read_text())["burrs"]:
        found.setdefault(burr["certainty"], "Materials")
        found.setdefault(burr["status"], "Materials")
    for tissue in json.loads((TREE / "Resources" / "soft-tissues.json").read_text(encoding="utf-8"))["soft_tissues"]:
        for key in ("title", "certainty", "status"):
            found.setdefault(tissue[key], "Materials")
    return [(folder, text) for text, folder in found.items()]


def update(file):
    """Brings phrases_*.ts up to the sources; new phrases are unfinished."""
    known = {}
    if file.exists():
        for message in xml.etree.ElementTree.parse(file).iter("message"):
            translation = message.find("translation")
            if not translation.get("type"):
                known[message.findtext("source")] = translation.text or ""
    escaped = lambda text: (text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;"))
    lines = ['<?xml version="1.0" encoding="utf-8"?>', "<!DOCTYPE TS>",
             '<TS version="2.1" language="de" sourcelanguage="en">']
    by_folder = {}
    for folder, text in phrases():
        by_folder.setdefault(folder, []).append(text)
    for folder, all_of_it in by_folder.items():
        lines += ["<context>", f"    <name>{folder}</name>"]
        for text in all_of_it:
            other = known.get(text)
            lines += ["    <message>", f"        <source>{escaped(text)}</source>",
                      f"        <translation>{escaped(other)}</translation>" if other else
                      '        <translation type="unfinished"></translation>', "    </message>"]
        lines.append("</context>")
    file.write_text("\n".join([*lines, "</TS>", ""]), encoding="utf-8")
