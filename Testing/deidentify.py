"""Checks `petrous deidentify` with pydicom: each attribute of PS3.15 Table E.1-1, at the top level,
in nested and in private sequences.

deidentify.py PETROUS TABLE.tsv FOLDER    prints one line for each wrong attribute; exit 1 if any"""
import pathlib
import re
import subprocess
import sys

import pydicom
from pydicom.dataelem import DataElement
from pydicom.dataset import Dataset, FileMetaDataset
from pydicom.datadict import dictionary_VR
from pydicom.sequence import Sequence
from pydicom.uid import CTImageStorage, ExplicitVRLittleEndian

PLANTS = {"DA": "19310517", "DT": "19310517101112", "TM": "101112.131", "AS": "077Y",
          "DS": "77.125", "IS": "77125", "UI": "1.2.77125.77"}
BYTES = ("OB", "OW", "OF", "OD", "OL", "OV", "UN", "OB or OW")


def plant(tag, n):
    """An element with a value that must not stay, or None if pydicom cannot write it."""
    try:
        vr = dictionary_VR(tag)
    except KeyError:
        return None  # newer than this pydicom: the test in C++ has it
    if vr == "SQ":
        item = Dataset()
        item.add_new(0x00080104, "LO", "PLANT%d" % n)
        item.add_new(0x00081155, "UI", "1.2.77125.%d" % n)
        return DataElement(tag, vr, Sequence([item]))
    if vr in BYTES:
        return DataElement(tag, "OB" if " " in vr else vr, b"PLANT%03d" % n)
    if vr in ("US", "SS", "UL", "SL"):
        return DataElement(tag, vr, 7712)
    text = PLANTS.get(vr, "PLANT%d" % n)
    return DataElement(tag, vr, text + ".%d" % n if vr == "UI" else text)


def without_uids(written):
    """What is left without the new UIDs, whose random digits may hold a plant by chance."""
    return re.sub(rb"2\.25\.[0-9]{1,39}", b"2.25", written)


def is_right(action, planted, found):
    """Whether the action of the table was done."""
    if found is None:
        return "X" in action
    text = without_uids(str(found).encode()).decode()
    if "PLANT" in text or "77125" in text or "19310517" in text or found == planted:
        return False
    if found.VR == "SQ":
        return any(c in action for c in "ZDU")
    if found.is_empty:
        return "Z" in action
    return "D" in action or ("U" in action and str(found.value).startswith("2.25."))


def image():
    data = Dataset()
    data.SOPClassUID, data.SOPInstanceUID = CTImageStorage, "1.2.77125.1"
    data.StudyInstanceUID, data.SeriesInstanceUID = "1.2.77125.2", "1.2.77125.3"
    data.Modality, data.Rows, data.Columns, data.SamplesPerPixel = "CT", 4, 4, 1
    data.PhotometricInterpretation = "MONOCHROME2"
    data.BitsAllocated, data.BitsStored, data.HighBit, data.PixelRepresentation = 16, 16, 15, 0
    data.PixelData = bytes(32)
    data.is_little_endian, data.is_implicit_VR = True, False
    data.file_meta = FileMetaDataset()
    data.file_meta.TransferSyntaxUID = ExplicitVRLittleEndian
    data.file_meta.MediaStorageSOPClassUID = CTImageStorage
    data.file_meta.MediaStorageSOPInstanceUID = data.SOPInstanceUID
    return data


def main(program, table, folder):
    rows = [line.rstrip("\n").split("\t") for line in open(table) if not line.startswith("#")]
    folder = pathlib.Path(folder)
    wrong = checked = 0
    for place in ("top", "nested", "private"):
        data, target = image(), Dataset()
        planted = {}
        for n, (tag, action, _, name) in enumerate(rows):
            number = 0x00091001 if tag == "odd" else int(tag.replace("x", "0"), 16)
            if number >> 16 < 8 or tag == "odd":
                continue
            element = plant(number, n)
            if element is None or (place == "top" and number in data):
                continue
            target.add(element)
            planted[number] = (action, element, name)
        if place == "top":
            data.update(target)
        elif place == "nested":
            inner = Dataset()
            inner.add_new(0x00081199, "SQ", Sequence([target]))
            data.add_new(0x00081115, "SQ", Sequence([inner]))
        else:
            data.private_block(0x0009, "ACME", create=True).add_new(2, "SQ", Sequence([target]))
        source, result = folder / (place + ".dcm"), folder / (place + "-out.dcm")
        data.save_as(source, write_like_original=False)
        subprocess.run([program, "deidentify", source, result, "--library", folder / "library"],
                       check=True, stdout=subprocess.DEVNULL)
        out = pydicom.dcmread(result)
        written = without_uids(result.read_bytes())
        for text in (b"PLANT", b"77125", b"19310517"):
            if text in written:
                wrong += 1
                print(place, "holds", text)
        if place == "private":
            if any(element.tag.is_private for element in out):
                wrong += 1
                print("a private attribute stays")
            continue
        there = out if place == "top" else out[0x00081115][0][0x00081199][0]
        for number, (action, element, name) in planted.items():
            checked += 1
            if not is_right(action, element, there.get(number)):
                wrong += 1
                print(place, "%08x" % number, name, action, there.get(number))
    print(checked, "attributes checked,", wrong, "wrong")
    return 1 if wrong or checked < 1000 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
