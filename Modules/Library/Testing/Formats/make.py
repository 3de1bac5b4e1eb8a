"""Writes the files of this folder: a case in each format of manifest, journal, index and archive,
after the definitions in Documentation/adr/0003-disk-format.md, with none of the program's code.

make.py [FOLDER]     needs the program zstd (package zstd)"""
import base64
import gzip
import hashlib
import json
import pathlib
import sqlite3
import struct
import subprocess
import sys
import zipfile
import zlib

DIMS, SPACING, ORIGIN = (8, 7, 6), (0.5, 0.75, 1.0), (10.0, -20.0, 30.0)
MR_DIMS, MR_SPACING = (4, 5, 3), (2.0, 2.0, 2.0)
MR_FROM_CT = {"quaternion_wxyz": [1, 0, 0, 0], "translation_mm": [1, 2, 3]}
objects = {}


def sha256(data):
    return hashlib.sha256(data).hexdigest()


def put(data, ending):
    name = sha256(data) + "." + ending
    objects[name] = data
    return name


def header(kind, dims, spacing, encoding):
    vector = ["(%g,0,0)" % spacing[0], "(0,%g,0)" % spacing[1], "(0,0,%g)" % spacing[2]]
    return ("NRRD0004\ntype: %s\ndimension: 3\nspace: left-posterior-superior\nsizes: %d %d %d\n"
            "space directions: %s\nkinds: domain domain domain\nendian: little\nencoding: %s\n"
            "space origin: (%g,%g,%g)\n" % ((kind,) + tuple(dims) + (" ".join(vector), encoding) + ORIGIN))


def image(dims, spacing, value):
    """Raw; the voxels begin at a multiple of 4096 bytes."""
    head = (header("short", dims, spacing, "raw") + "petrous_spacing:=%g %g %g\n" % spacing +
            "petrous_direction:=1 0 0 0 1 0 0 0 1\n")
    room = -(len(head) + 3) % 4096
    voxels = [value(i, j, k) for k in range(dims[2]) for j in range(dims[1]) for i in range(dims[0])]
    return put((head + "#" + " " * room + "\n\n").encode() + struct.pack("<%dh" % len(voxels), *voxels),
               "nrrd")


def labels(dims, spacing, index, name, inside):
    head = header("unsigned short", dims, spacing, "gzip") + "".join(
        "Segment0_%s:=%s\n" % pair for pair in (
            ("ID", "Segment_1"), ("Name", name), ("LabelValue", index), ("Layer", 0),
            ("Color", "1 1 0"), ("Extent", "0 %d 0 %d 0 %d" % tuple(n - 1 for n in dims))))
    voxels = [index if (i, j, k) in inside else 0
              for k in range(dims[2]) for j in range(dims[1]) for i in range(dims[0])]
    return put((head + "\n").encode() + gzip.compress(struct.pack("<%dH" % len(voxels), *voxels), mtime=0),
               "seg.nrrd")


def stroke_bytes(removed):
    """`removed`: {(i, j, k): before minus after}, all in the first brick of 16 x 16 x 16."""
    differences = [0] * 4096
    for (i, j, k), difference in removed.items():
        differences[i + 16 * (j + 16 * k)] = difference
    raw = b"PSTK" + struct.pack("<4I", 1, 16, 1, 0)
    raw += bytes(d & 255 for d in differences) + bytes(d >> 8 for d in differences)
    return subprocess.run(["zstd", "-q", "-3", "--no-check", "--stream-size=%d" % len(raw), "-c"], input=raw,
                          capture_output=True, check=True).stdout


CT = image(DIMS, SPACING, lambda i, j, k: 100 + i + 10 * j + 100 * k)
MR = image(MR_DIMS, MR_SPACING, lambda i, j, k: 5 * i + j * k)
NERVE = labels(DIMS, SPACING, 3, "nerve", {(1, 2, 3), (2, 2, 3)})
TUMOUR = labels(MR_DIMS, MR_SPACING, 1, "tumour", {(2, 2, 1)})
MESH = put(b"v 11 -19 31\nv 12 -19 31\nv 11 -18 31\nv 11 -19 32\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", "obj")
TOOL = put(b"v 0 0 0\nv 1 1 60\nv -1 1 60\nv -1 -1 60\nv 1 -1 60\nf 1 3 2\nf 1 4 3\nf 1 5 4\nf 1 2 5\nf 2 3 4\n"
           b"f 2 4 5\n", "obj")
REMOVED = [{(2, 3, 4): 65535, (3, 3, 4): 1000}, {(5, 6, 1): 30000}, {(3, 3, 4): 64535}]
STROKES = [put(stroke_bytes(one), "stroke") for one in REMOVED]
NOTE = put(b"%PDF-1.4\n%%EOF\n", "pdf")


def grid(dims, spacing):
    return {"dims": list(dims), "spacing_mm": list(spacing), "origin_mm": list(ORIGIN),
            "direction": [1, 0, 0, 0, 1, 0, 0, 0, 1]}


def look(preset, **more):
    return dict({"preset": preset, "color": [0.25, 0.5, 0.75], "opacity": 0.5,
                 "flags": "shown,touchable", "priority": 40, "solid": True}, **more)


def stroke(n, **more):
    return dict({"object": STROKES[n], "bytes": len(objects[STROKES[n]]),
                 "started_at": "2026-01-0%dT10:00:00Z" % (n + 1), "duration_s": 1.5, "burr": "diamond",
                 "diameter_mm": 3.0, "rpm": 40000.0, "removed_mm3": 0.25 * (n + 1),
                 "structures": [{"name": "nerve", "removed_mm3": 0.125}]}, **more)


CAMERA = {"position_mm": [0, -200, 30], "focal_point_mm": [12, -18, 33], "view_up": [0, 0, 1],
          "view_angle_deg": 25}
HISTORY = {"parents": [0, 1, 1], "branch": "behind", "branches": [
    {"name": "main", "tip": 2, "position": 1}, {"name": "behind", "tip": 3, "position": 3}]}


def manifest(version):
    """A case as programs of that format wrote it, with what was new in it."""
    ct = {"name": "ct", "object": CT, "grid": grid(DIMS, SPACING), "min": 100, "max": 667,
          "notes": ["jitter of 0.02 mm"]}
    mr = {"name": "T2", "object": MR, "grid": grid(MR_DIMS, MR_SPACING), "min": 0, "max": 23, "notes": [],
          "registered": True, "mr_from_ct": MR_FROM_CT}
    nerve = {"name": "nerve", "index": 3, "voxels": 2, "volume_mm3": 0.75, "look": look("nerve")}
    tumour = {"name": "tumour", "index": 1, "voxels": 1, "volume_mm3": 8.0, "look": look("other")}
    parts = [{"object": NERVE, "structures": [nerve]}, {"object": TUMOUR, "structures": [tumour]}]
    mesh = {"name": "incus", "object": MESH, "triangles": 4, "notes": [], "look": look("bone")}
    case = {"petrous_case": version, "name": "format-%d" % version, "revision": 5, "iso_hu": 321.5,
            "dense_bone_hu": 1700.0, "ct": ct, "bone": look("bone"), "mr": [mr], "labels": parts,
            "meshes": [mesh], "camera": CAMERA}
    if version == 1:
        case["dissection"] = {"strokes": [stroke(0), stroke(1)], "applied": 1}
        return case
    case["id"] = "%032x" % version
    case["dissection"] = {"strokes": [stroke(0, camera=CAMERA), stroke(1), stroke(2, recovered=True)],
                          "history": HISTORY}
    if version >= 3:
        parts[0]["drawn_on"], parts[1]["drawn_on"] = "", "T2"
        mr["registration"] = {"method": "landmarks", "refined": False, "verdict": "doubtful",
                              "text": "by 4 landmarks"}
        for one in (ct, mr):
            one["frame_of_reference_" + ("sha256" if version == 3 else "salted_sha256")] = sha256(b"1.2.3")
    if version >= 4:
        nerve["codes"] = {"type": {"value": "56052001", "scheme": "SCT", "meaning": "Facial nerve"},
                          "algorithm": "manual"}
    if version >= 5:
        case["description"] = {"note": "two lines\nof a note", "tags": ["teaching"], "side": "left",
                               "diagnosis": "otosclerosis", "planned_on": "2026-03-31"}
        case["view"] = {"branches": {"main": CAMERA},
                        "slices": {"crosshair_mm": [12, -18, 33], "window_width": 3000, "window_level": 600}}
    if version >= 6:
        case["view"]["light"] = {"falloff_mm": 120, "wetness": 0.5}
        case["attachments"] = [{"kind": "document", "name": "plan.pdf", "bytes": len(objects[NOTE]),
                                "object": NOTE}]
    if version >= 7:
        case["view"]["saved"] = {"from above": {"camera": CAMERA}}
        case["measurements"] = [{"kind": "distance", "name": "width",
                                 "points_mm": [[10, -20, 30], [13, -16, 30]]}]
    if version >= 8:
        case["attachments"].append({
            "kind": "video", "name": "theatre.mkv", "bytes": 5, "link": "/films/theatre.mkv",
            "sha256": sha256(b"frame"), "video": {
                "bookmarks": [{"name": "antrum", "time_ns": 1234567890, "stroke": STROKES[1]}],
                "stills": [{"time_ns": 2000000000, "size": [1920, 1080], "opacity": 0.25, "view_angle_deg": 25,
                            "camera": CAMERA,
                            "landmarks": [{"patient_mm": [12, -18, 33], "still_px": [960.5, 540]}]}]}})
    if version >= 9:
        case["view"]["instrument"] = {"object": TOOL, "axis": "z+", "name": "pick.stl"}
    if version >= 10:
        case["view"]["branches"]["main"] = {
            "camera": CAMERA, "clipping": {"crop": {"lower": [0, 1, 2], "upper": [5, 6, 6]}},
            "slices": {"crosshair_mm": [11, -19, 32], "window_width": 400, "window_level": 40}}
        case["ct"]["provenance"] = {"corrected_axes": "RPS"}
        case["labels"][0]["provenance"] = {"corrected_axes": "RPS"}
    return case


def frame(kind, text, data=b""):
    text = text.encode()
    rest = kind.encode() + struct.pack("<I", len(text)) + text + data
    return struct.pack("<Q", len(rest)) + sha256(rest).encode() + rest


def journal(version, case, isFirst):
    """One stroke after those of the case. The first programs' journals named no CT and no history."""
    strokes = case["dissection"]["strokes"]
    head = {"petrous_journal": version, "case": case["name"], "revision": 5, "strokes": len(strokes)}
    if not isFirst:
        head.update(ct=CT, strokes_sha256=sha256("".join(s["object"] + "\n" for s in strokes).encode()),
                    history=json.dumps(case["dissection"]["history"]))
    drilled = stroke(1)
    drilled["object"] = ""
    drilled["removed_mm3"] = 7.5
    return frame("J", json.dumps(head)) + frame("S", json.dumps(drilled),
                                                stroke_bytes({(0, 0, 5): 65535, (1, 0, 5): 20000}))


def index(folder, version):
    """Rows of cases that are not there, so that they would be seen."""
    file = folder / ("index-%d.sqlite" % version)
    file.unlink(missing_ok=True)
    columns = ("name TEXT PRIMARY KEY, size INTEGER, changed INTEGER, modified TEXT, nx INTEGER, "
               "ny INTEGER, nz INTEGER, structures INTEGER, strokes INTEGER, removed_mm3 REAL")
    columns += {1: "", 2: ", text TEXT"}.get(
        version, ", text TEXT, id TEXT, tags TEXT, diagnosis TEXT, procedure TEXT, side TEXT, "
                 "planned_on TEXT, has_note INTEGER")
    with sqlite3.connect(file) as database:
        database.execute("PRAGMA page_size=512")
        database.execute("CREATE TABLE cases (%s)" % columns)
        database.execute("INSERT INTO cases (name, size, changed, structures) VALUES "
                         "('format-7', 1, 1, 99), ('of nobody', 1, 1, 99)")
        database.execute("PRAGMA user_version = %d" % (0 if version == 1 else version))
    database.close()


def packed(data):
    """The same NRRD with gzip voxels, in members that state their length."""
    head, voxels = data.split(b"\n\n", 1)
    deflate = zlib.compressobj(6, zlib.DEFLATED, -15)
    body = deflate.compress(voxels) + deflate.flush()
    length = 12 + 8 + len(body) + 8
    member = (b"\x1f\x8b\x08\x04" + bytes(5) + b"\xff" + struct.pack("<H", 8) + b"PT" +
              struct.pack("<HI", 4, length) + body + struct.pack("<II", zlib.crc32(voxels), len(voxels)))
    return head.replace(b"\nencoding: raw\n", b"\nencoding: gzip\n") + b"\n\n" + member


def archive(file, version, case, isPlan=False, thumbnail=None):
    text = json.dumps(case).encode()
    entries = [("ct.nrrd", CT), ("mr/T2.nrrd", MR), ("labels/nerve.seg.nrrd", NERVE),
               ("labels/tumour.seg.nrrd", TUMOUR), ("meshes/incus.obj", MESH)]
    entries = [] if isPlan else entries
    entries += [("strokes/%04d.stroke" % (n + 1), s["object"])
                for n, s in enumerate(case["dissection"]["strokes"])]
    if "attachments" in case:
        entries.append(("attachments/plan.pdf", NOTE))
    head = {"petrous_archive": version, "case": case["name"], "plan_only": isPlan,
            "manifest_sha256": sha256(text), "library_sha256": sha256(b"another library's archive"),
            "objects": [{"object": name, "file": entry, "bytes": len(objects[name]),
                         "packed": name in (CT, MR)} for entry, name in entries]}
    if thumbnail:
        head["thumbnail_png"] = base64.b64encode(thumbnail).decode()
    with zipfile.ZipFile(file, "w") as zipped:
        def add(name, data):
            zipped.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_STORED)
        add("petrous.json", json.dumps(head))
        add("case.json", text)
        for entry, name in entries:
            add(entry, packed(objects[name]) if name in (CT, MR) else objects[name])


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    for part in ("cases", "objects"):
        (folder / part).mkdir(parents=True, exist_ok=True)
    for version in range(1, 12):
        (folder / "cases" / ("format-%d.json" % version)).write_text(json.dumps(manifest(version), indent=1))
    for name, data in objects.items():
        (folder / "objects" / name).write_bytes(data)
    (folder / "journal-first").write_bytes(journal(1, manifest(2), True))
    (folder / "journal-1").write_bytes(journal(1, manifest(7), False))
    (folder / "journal-2").write_bytes(journal(2, manifest(7), False))
    for version in (1, 2, 3, 4):
        index(folder, version)
    for version in (1, 4, 7): # of the case
        archive(folder / ("archive-1-case-%d.petrous" % version), 1, manifest(version))
    archive(folder / "archive-1-plan.petrous", 1, manifest(5), isPlan=True)
    archive(folder / "archive-2.petrous", 2, manifest(5))
    archive(folder / "archive-1-case-11.petrous", 1, manifest(11))


main()
