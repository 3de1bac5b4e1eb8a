"""Takes a case the whole way: create, drill, branch, archive, restore in a second library, send to a
DICOM node (Orthanc, where it is installed), receive in a third library, open. Compares the pictures
to the pixel, the voxels to the bit, the history, the whole manifest and the attachments to the byte,
in every library; and reads what left the
program by independent readers: the parts of the archive by zipfile, gzip and numpy, the exported
files by nibabel and pydicom, what the node keeps by pydicom and dciodvfy.

whole_way.py PETROUS [FOLDER] [--ct DICOM_FOLDER --roi x0,x1,y0,y1,z0,z1 | --data REAL_DATA]

FOLDER is new or empty, and keeps what was made; without it, nothing is kept. Without --ct the case
is the program's sample patient, with MR and structures; with --data a part of the head CT
in that folder of real data. Prints a line for each step; exit 0: everything is equal; 1: something
is not, which is said; 77: Python lacks numpy, or the folder the CT."""
import argparse
import gzip
import json
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import zipfile

try:
    import numpy as np
except ImportError:
    print("numpy is not installed")
    sys.exit(77)

ORTHANC = "/usr/sbin/Orthanc"
REAL_CT, REAL_ROI = "ct_head_vhm/vhm_1080-1245", "150,330,150,330,1090,1190"
wrong = []


def check(holds, text):
    print(("ok     " if holds else "WRONG  ") + text, flush=True)
    if not holds:
        wrong.append(text)


class Petrous:
    """The program with one library."""

    def __init__(self, program, library):
        self.program, self.library = program, library

    def __call__(self, *words):
        command = [self.program, *map(str, words), "--library", str(self.library), "--json"]
        done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL)
        if done.returncode != 0:
            raise SystemExit("petrous %s: exit %d: %s" % (" ".join(map(str, words)),
                                                          done.returncode, done.stderr))
        return json.loads(done.stdout)


def write_path(file, start, end):
    """A straight path from start to end (LPS mm), drilling all the way, one second."""
    back = np.subtract(start, end)
    back = back / np.linalg.norm(back)
    q = np.array([1.0 + back[2], -back[1], back[0], 0.0])
    q = np.array([0.0, 1.0, 0.0, 0.0]) if q[0] < 1e-6 else q / np.linalg.norm(q)
    rows = ["t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill"]
    for t, at, drill in ((0, start, 1), (1, end, 0)):
        rows.append(",".join(map(repr, [t, *map(float, at), *map(float, q), drill])))
    file.write_text("\n".join(rows) + "\n")
    return file


def create(petrous, folder, ct, roi):
    """A case with two approaches."""
    if ct:
        petrous("new", "ear", "--ct", ct, *(["--roi", roi] if roi else []))
        petrous("segment", "ear", "dense bone", "--threshold", "700,3000")
    else:
        patient = folder / "patient"
        petrous("sample", patient, "--dims", "64,64,60", "--spacing", "1.0")
        petrous("new", "ear", "--ct", patient / "ct", "--mr", "T2=%s" % (patient / "mr"), "--labels",
                patient / "labels.seg.nrrd", "--mesh", "carotid=%s" %
                (patient / "meshes" / "carotid_artery.obj"))
        petrous("register", "ear", "--mr", "T2")
    petrous("describe", "ear", "--tag", "whole way", "--diagnosis", "otosclerosis", "--side", "left",
            "--note", "first line\nsecond line")
    info = petrous("info", "ear")["ct"]
    half = 0.5 * np.array(info["dims"]) * info["spacing_mm"]
    centre = np.array(info["origin_mm"]) + half
    # From outside to the middle, from the side on which the volume lies.
    side = np.array([np.copysign(half[0] + 10.0, centre[0]), 0.0, 0.0])
    for n, shift in enumerate((0.0, 6.0)):
        start, end = centre + side + [0, shift, 0], centre + [0, shift, 0]
        done = petrous("drill", "ear", "--diameter", "6", "--path",
                       write_path(folder / ("path%d.csv" % n), start, end))
        check(done["removed_mm3"] > 1.0, "drilled %.1f mm3" % done["removed_mm3"])
    petrous("undo", "ear")
    petrous("branch", "ear", "behind", "--from", "0")
    petrous("drill", "ear", "--diameter", "4", "--path",
            write_path(folder / "path2.csv", centre + side + [0, 0, 8], centre + [0, 0, 8]))
    petrous("appearance", "ear", "--iso", "345.25")
    look(petrous, folder, centre, side, bool(ct))
    attach(petrous, folder)


def look(petrous, folder, centre, side, is_real):
    """A view in numbers that only doubles hold, with all its parts."""
    (folder / "camera.json").write_text(json.dumps({
        "position_mm": (centre + 3.7 * side + [1 / 3, 2 / 7, 0.1]).tolist(),
        "focal_point_mm": (centre + [0, 0, 1 / 9]).tolist(), "view_up": [0.1, 0.2, 1.1],
        "view_angle_deg": 100 / 3}))
    point = ",".join(map(repr, map(float, centre - 4.1 * np.sign(side))))
    petrous("view", "ear", "--camera", folder / "camera.json", "--at", point, "--window",
            "1234.5678901234567,0.1", "--zoom", "axial=3.3333333333333335", "--zoom",
            "sagittal=1.1", "--light-falloff", "333.3333333333333", "--wetness", "0.1",
            "--eye-separation", "17.7", "--convergence", "222.2222222222222", "--clip",
            ",".join(map(repr, map(float, [*centre, 0, 0.6, 0.8]))), "--burr", "diamond",
            "--diameter", "3", "--rpm", "55555.5", "--thrust", "2.2",
            *([] if is_real else ["--overlay", "T2", "--opacity", "0.3"]))


def attach(petrous, folder):
    """A file of each kind; the PNG has been drawn, and what it says of its author is lost."""
    petrous("render", "ear", "--size", "80x60", "--plain", "--out", folder / "view.png")
    (folder / "tool.ticks").write_bytes(b"PTRTICK\n" + bytes(range(256)) * 40)
    (folder / "plan.pdf").write_bytes(b"%PDF-1.7\n" + bytes(range(256)))
    (folder / "film.mp4").write_bytes(b"\0\0\0\x18ftypmp42" + bytes(range(256)) * 100)
    for name in ("view.png", "tool.ticks", "plan.pdf"):
        petrous("attach", "ear", folder / name, "--name", name, "--note",
                "of %s\nsecond line" % name, "--stroke", 2)
    done = petrous("attach", "ear", folder / "film.mp4")
    check(done["attachment"]["kind"] == "video", "a video is attached")


def state(petrous, name, out):
    """All that a user can see of a case: pictures and voxels of each branch, values, history."""
    out.mkdir(parents=True)
    seen = {}
    history = petrous("history", name)
    history.pop("case")
    for stroke in history["strokes"]:
        stroke.pop("started_at")
    info = petrous("info", name)
    for own in ("case", "resources", "disk"):
        info.pop(own, None)
    described = petrous("describe", name)["description"]
    for one in petrous("attachments", name)["attachments"]:
        if one["kind"] == "video":  # stays at home
            continue
        file = out / one["name"]
        petrous("attachments", name, "--extract", one["name"], file)
        seen["attachment " + one["name"]] = file.read_bytes()
    for plane in ("axial", "coronal", "sagittal"):
        picture = out / (plane + ".png")
        petrous("slice", name, "--plane", plane, "--size", "160x120", "--out", picture)
        seen["slice " + plane] = picture.read_bytes()
    current = history["branch"]
    for branch in [b["name"] for b in history["branches"] if b["name"] != current] + [current]:
        petrous("branch", name, branch)
        picture = out / ("%s.png" % branch)
        petrous("render", name, "--size", "160x120", "--out", picture)
        seen["picture of " + branch] = picture.read_bytes()
        for what in ("dissected", "mask"):
            file = out / ("%s-%s.nrrd" % (branch, what))
            petrous("export", name, "--what", what, "--out", file)
            seen["%s voxels of %s" % (what, branch)] = file.read_bytes()
    seen["manifest"] = manifest(petrous, name)  # after the branches, whose cameras are kept
    whats = ["ct", "labels"] + (["mr"] if info["mr"] else [])
    for what in whats:
        file = out / (what + (".seg.nrrd" if what == "labels" else ".nrrd"))
        petrous("export", name, "--what", what, "--out", file)
        seen[what + " voxels"] = file.read_bytes()
    seen.update({"history": history, "info": info, "description": described})
    return seen


def manifest(petrous, name):
    """All of a case that is not voxels: but for its name, id, and what stays at home."""
    whole = json.loads((petrous.library / "cases" / (name + ".json")).read_text())
    for own in ("name", "id", "revision", "sha256"):
        whole.pop(own)
    # Of another library's salt.
    for image in [whole["ct"], *whole["mr"]]:
        image.pop("frame_of_reference_salted_sha256", None)
        image.pop("patient_salted_sha256", None)
        image.pop("salt_id", None)
    whole["attachments"] = [one for one in whole["attachments"] if one["kind"] != "video"]
    for one in whole["attachments"]:
        one.pop("date", None)
    for stroke in whole["dissection"]["strokes"]:
        stroke.pop("started_at")
    return whole


def compare(there, here, where):
    check(there.keys() == here.keys(), where + ": the same things are there")
    for what in here:
        check(there.get(what) == here[what], "%s: %s" % (where, what))


def read_nrrd(data):
    """Header and voxels, [k, j, i], of a raw or gzip NRRD."""
    head, body = data.split(b"\n\n", 1)
    fields = dict(line.split(": ", 1) for line in head.decode().splitlines()
                  if ": " in line and not line.startswith("#"))
    if fields["encoding"] == "gzip":
        body = gzip.decompress(body)
    kinds = {"short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2", "uchar": "u1",
             "uint8": "u1", "unsigned char": "u1", "unsigned short": "u2", "float": "f4",
             "int": "i4", "signed char": "i1", "int8": "i1", "double": "f8"}
    order = "<" if fields.get("endian", "little") == "little" else ">"
    voxels = np.frombuffer(body, order + kinds[fields["type"]])
    return fields, voxels.reshape([int(n) for n in fields["sizes"].split()][::-1])


def check_archive(archive, seen):
    """The parts as another program unzips them."""
    with zipfile.ZipFile(archive) as parts:
        check(parts.testzip() is None, "zipfile finds the archive sound")
        names = parts.namelist()
        voxels = read_nrrd(parts.read("ct.nrrd"))[1]
        check(np.array_equal(voxels, read_nrrd(seen["ct voxels"])[1]),
              "ct.nrrd of the archive is the CT to the bit, by numpy")
        for what in ("labels/", "strokes/"):
            check(any(n.startswith(what) for n in names), "the archive has " + what)
        for name in names:
            if name.startswith("labels/"):
                data = parts.read(name)
                check(read_nrrd(data)[1].any() and b"\nSegment0_Name:=" in data.split(b"\n\n")[0],
                      "%s has voxels and names" % name)


def check_exports(petrous, name, seen, out):
    """NIfTI by nibabel and DICOM by pydicom hold the voxels of the CT, at their places."""
    fields, ct = read_nrrd(seen["ct voxels"])
    origin = np.array([float(n) for n in fields["space origin"].strip("()").split(",")])
    axes = np.array([[float(n) for n in axis.strip("()").split(",")]
                     for axis in fields["space directions"].split()])
    far = [n - 1 for n in ct.shape[::-1]]
    corner = origin + np.array(far) @ axes  # LPS, of the last voxel
    try:
        import nibabel
        petrous("export", name, "--what", "ct", "--out", out / "ct.nii.gz")
        image = nibabel.load(out / "ct.nii.gz")
        check(np.array_equal(np.asanyarray(image.dataobj), ct.T), "ct.nii.gz by nibabel: voxels")
        there = nibabel.affines.apply_affine(image.affine, far) * [-1, -1, 1]
        check(np.allclose(there, corner, atol=1e-3), "ct.nii.gz by nibabel: place")
    except ImportError:
        print("skip   nibabel is not installed")
    try:
        import pydicom
    except ImportError:
        print("skip   pydicom is not installed")
        return
    petrous("export", name, "--what", "ct", "--out", str(out / "ct") + "/")
    slices = sorted((pydicom.dcmread(f) for f in (out / "ct").iterdir()),
                    key=lambda s: np.dot(s.ImagePositionPatient, axes[2]))
    stack = np.array([s.pixel_array * float(s.RescaleSlope) + float(s.RescaleIntercept)
                      for s in slices])
    check(np.array_equal(stack, ct), "DICOM series by pydicom: voxels")
    check(np.allclose(np.array(slices[0].ImagePositionPatient, float), origin, atol=1e-3),
          "DICOM series by pydicom: place")


def check_node(storage):
    """What the node keeps: valid, and nobody's."""
    objects = [f for f in storage.rglob("*") if f.is_file() and f.stat().st_size > 132
               and f.open("rb").read(132)[128:] == b"DICM"]
    check(len(objects) > 10, "the node keeps %d objects" % len(objects))
    try:
        import pydicom
        said = set()
        for file in objects:
            data = pydicom.dcmread(file, stop_before_pixels=True)
            said.add((data.get("PatientIdentityRemoved", ""), str(data.get("PatientBirthDate", ""))))
        check(all(removed in ("YES", "") and not birth for removed, birth in said),
              "no object at the node has a birth date (pydicom)")
    except ImportError:
        print("skip   pydicom is not installed")
    if shutil.which("dciodvfy"):
        errors = 0
        for file in objects:
            done = subprocess.run(["dciodvfy", str(file)], capture_output=True, text=True)
            errors += "Error" in done.stderr + done.stdout
        check(errors == 0, "dciodvfy finds no error in %d objects" % len(objects))
    else:
        print("skip   dciodvfy (package dicom3tools) is not installed")


def start_orthanc(folder):
    """Process, port and storage folder of a node on the loopback."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    storage = folder / "orthanc"
    storage.mkdir()
    (folder / "orthanc.json").write_text(json.dumps({
        "StorageDirectory": str(storage), "IndexDirectory": str(storage),
        "HttpServerEnabled": False, "DicomServerEnabled": True, "DicomAet": "ORTHANC",
        "DicomPort": port, "DicomAlwaysAllowStore": False, "DicomModalities": {"petrous": {
            "AET": "PETROUS", "Host": "127.0.0.1", "Port": 104, "AllowEcho": True, "AllowFind": True,
            "AllowStore": True, "AllowGet": True}}}))
    log = open(folder / "orthanc.log", "w")
    server = subprocess.Popen([ORTHANC, str(folder / "orthanc.json")], stdout=log, stderr=log,
                              stdin=subprocess.DEVNULL)
    for _ in range(600):
        with socket.socket() as trial:
            if trial.connect_ex(("127.0.0.1", port)) == 0:
                return server, port, storage
        if server.poll() is not None:
            break
        time.sleep(0.1)
    server.kill()
    raise SystemExit("Orthanc did not start: " + (folder / "orthanc.log").read_text()[-500:])


def main():
    with tempfile.TemporaryDirectory(prefix="petrous-whole-way-") as scratch:
        return take(pathlib.Path(scratch))


def take(scratch):
    parser = argparse.ArgumentParser()
    parser.add_argument("petrous")
    parser.add_argument("folder", type=pathlib.Path, nargs="?", default=scratch)
    parser.add_argument("--ct")
    parser.add_argument("--roi")
    parser.add_argument("--data")
    asked = parser.parse_args()
    if asked.data is not None:
        asked.ct, asked.roi = pathlib.Path(asked.data) / REAL_CT, REAL_ROI
        if not asked.data or not asked.ct.is_dir():
            print("skip   no real data: %s is not there" % asked.ct)
            return 77
    folder = asked.folder.absolute()
    folder.mkdir(parents=True, exist_ok=True)

    here = Petrous(asked.petrous, folder / "library")
    create(here, folder, asked.ct, asked.roi)
    seen = state(here, "ear", folder / "here")
    check(len(seen["history"]["strokes"]) == 3 and len(seen["history"]["branches"]) == 2,
          "two approaches, three strokes, one of them undone")
    pictures = {seen[k] for k in seen if k.startswith("picture")}
    check(len(pictures) == 2, "the approaches are seen")
    check((folder / "view.png").read_bytes() == seen["attachment view.png"],
          "a picture without metadata is attached to the byte")
    check_exports(here, "ear", seen, folder / "here")

    archive = folder / "ear.petrous"
    here("archive", "ear", archive, "--with-documents")
    check_archive(archive, seen)
    there = Petrous(asked.petrous, folder / "second")
    there("restore", archive)
    compare(state(there, "ear", folder / "there"), seen, "restored in a second library")

    if pathlib.Path(ORTHANC).exists():
        server, port, storage = start_orthanc(folder)
        try:
            node = ("nodes", "add", "pacs", "--host", "127.0.0.1", "--port", port, "--aet", "ORTHANC")
            there(*node)
            sent = there("send", "ear", "--to", "pacs", "--with-documents")
            check(sent["completed"] == sent["instances"] and sent["failed"] == 0,
                  "sent %d instances" % sent["instances"])
            third = Petrous(asked.petrous, folder / "third")
            third(*node)
            # Of a restored case it is not known that its name is not the patient's: it stays.
            third("receive", "--from", "pacs", "--study", sent["study"])
            compare(state(third, "ear", folder / "received"), seen, "received in a third library")
            check_node(storage)
            check(third("library", "verify")["damaged"] == [], "the third library verifies")
        finally:
            server.kill()
            server.wait()
    else:
        print("skip   Orthanc (package orthanc) is not installed")
    for petrous in (here, there):
        check(petrous("library", "verify")["damaged"] == [], "%s verifies" % petrous.library.name)
    print("%d wrong" % len(wrong))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
