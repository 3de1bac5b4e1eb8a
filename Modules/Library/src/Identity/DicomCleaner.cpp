#include <dcmtk/config/osconfig.h> // before any other header of DCMTK

#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/oflog/oflog.h>

#include "DicomCleaner.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <mutex>
#include <type_traits>
#include <vector>

#include <fcntl.h>
#include <iconv.h>
#include <unistd.h>

#include "FaceSlices.h"
#include "PixelMetadata.h"
#include "Vocabulary.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Core/WriteAll.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::library
{

namespace
{

using Dates = DeidentificationOptions::Dates;

constexpr const char* kDummyText = "Anonymized";

std::uint32_t tagOf(const DcmTagKey& key)
{
  return std::uint32_t{key.getGroup()} << 16 | key.getElement();
}

std::string hexOf(unsigned value)
{
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text(4, '0');
  for (int n = 3; n >= 0; --n, value >>= 4U)
    text[static_cast<std::size_t>(n)] = kDigits[value & 15U];
  return text;
}

std::string pathOf(const DcmTagKey& key)
{
  return "(" + hexOf(key.getGroup()) + "," + hexOf(key.getElement()) + ")";
}

struct DictionaryEntry
{
  DcmEVR vr = EVR_UNKNOWN;
  std::string name;
  int values = 1; ///< at most; -1: any number
};

/// Of the standard's dictionary only.
DictionaryEntry dictionaryEntry(const DcmTagKey& key)
{
  DictionaryEntry found;
  const DcmDataDictionary& dictionary = dcmDataDict.rdlock();
  if (const DcmDictEntry* entry = dictionary.findEntry(key, nullptr))
  {
    found.vr = entry->getEVR();
    found.name = entry->getTagName();
    found.values = entry->getVMMax();
  }
  dcmDataDict.rdunlock();
  return found;
}

bool isText(DcmEVR vr)
{
  switch (vr)
  {
  case EVR_LO:
  case EVR_SH:
  case EVR_ST:
  case EVR_LT:
  case EVR_UT:
  case EVR_UC:
  case EVR_UR:
    return true;
  default:
    return false;
  }
}

bool isString(DcmEVR vr)
{
  switch (vr)
  {
  case EVR_AE:
  case EVR_AS:
  case EVR_CS:
  case EVR_DA:
  case EVR_DS:
  case EVR_DT:
  case EVR_IS:
  case EVR_PN:
  case EVR_TM:
  case EVR_UI:
    return true;
  default:
    return isText(vr);
  }
}

bool isNumber(DcmEVR vr)
{
  switch (vr)
  {
  case EVR_US:
  case EVR_SS:
  case EVR_UL:
  case EVR_SL:
  case EVR_UV:
  case EVR_SV:
  case EVR_FL:
  case EVR_FD:
  case EVR_AT:
    return true;
  default:
    return false;
  }
}

bool isBytes(DcmEVR vr)
{
  switch (vr)
  {
  case EVR_OB:
  case EVR_OW:
  case EVR_OF:
  case EVR_OD:
  case EVR_OL:
  case EVR_OV:
  case EVR_PixelData:
    return true;
  default:
    return false;
  }
}

// The VR in the file is one that the dictionary permits for this attribute.
bool agrees(DcmEVR file, DcmEVR dictionary)
{
  switch (dictionary)
  {
  case EVR_xs:
    return file == EVR_US || file == EVR_SS || file == EVR_xs;
  case EVR_lt:
    return file == EVR_US || file == EVR_SS || file == EVR_OW || file == EVR_lt;
  case EVR_ox:
  case EVR_px:
    return isBytes(file) || file == EVR_ox || file == EVR_px;
  case EVR_up:
    return file == EVR_UL || file == EVR_up;
  default:
    return file == dictionary;
  }
}

// Bytes that are voxels, lookup tables or geometry.
bool areNeededBytes(std::uint32_t tag)
{
  switch (tag)
  {
  case 0x7fe00010: // Pixel Data
  case 0x7fe00008: // Float Pixel Data
  case 0x7fe00009: // Double Float Pixel Data
  case 0x00283006: // LUT Data
  case 0x00281201: // palette lookup tables
  case 0x00281202:
  case 0x00281203:
  case 0x00660016: // Point Coordinates Data
  case 0x00660021: // Vector Coordinate Data
  case 0x00660040: // Long Primitive Point Index List
  case 0x00660041: // Long Triangle Point Index List
  case 0x00660042: // Long Edge Point Index List
    return true;
  default:
    return false;
  }
}

// What a device is and runs: kept with its identity only, as anything can be written there.
bool describesDevice(std::uint32_t tag)
{
  switch (tag)
  {
  case 0x00081090: // Manufacturer's Model Name
  case 0x00180024: // Sequence Name
  case 0x00181020: // Software Versions
  case 0x00181160: // Filter Type
  case 0x00181210: // Convolution Kernel
  case 0x00181250: // Receive Coil Name
  case 0x00181251: // Transmit Coil Name
  case 0x00189005: // Pulse Sequence Name
    return true;
  default:
    return false;
  }
}

// UIDs of the standard in PS3.6 that are newer than the toolkit.
bool isWellKnownUid(const std::string& uid)
{
  static const std::set<std::string> kNewer{
      "1.2.840.10008.5.1.4.1.1.66.7", // Label Map Segmentation
      "1.2.840.10008.5.1.4.1.1.66.8", // Height Map Segmentation
      "1.2.840.10008.5.1.4.1.1.2.3",  // Photon-Counting CT (draft)
      "1.2.840.10008.1.2.4.201",      "1.2.840.10008.1.2.4.202", "1.2.840.10008.1.2.4.203"};
  return dcmFindNameOfUID(uid.c_str()) != nullptr || kNewer.count(uid) > 0;
}

/// Up to the first NUL, without padding.
std::string valueOf(DcmElement& element)
{
  char* text = nullptr;
  Uint32 count = 0;
  if (element.getString(text, count).bad() || !text)
    return {};
  std::string value(text, ::strnlen(text, count));
  const std::size_t last = value.find_last_not_of(' ');
  return value.substr(0, last == std::string::npos ? 0 : last + 1);
}

std::string valueOf(DcmItem& item, const DcmTagKey& key)
{
  DcmElement* element = nullptr;
  return item.findAndGetElement(key, element).good() && element && isString(element->getVR())
             ? valueOf(*element)
             : std::string();
}

std::string withoutPadding(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

std::vector<std::string> split(const std::string& text)
{
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == '\\')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

template <typename Change>
std::string eachPart(const std::string& text, Change change)
{
  std::string whole;
  bool isFirst = true;
  for (const std::string& part : split(text))
  {
    whole += (isFirst ? "" : "\\") + change(part);
    isFirst = false;
  }
  return whole;
}

bool hasOnly(const std::string& text, const char* allowed)
{
  return text.find_first_not_of(allowed) == std::string::npos;
}

// Days since 1 January 1970 of the proleptic Gregorian calendar, and back (H. Hinnant, "chrono-
// Compatible Low-Level Date Algorithms", 2013).
long daysOf(long y, long m, long d)
{
  y -= m <= 2 ? 1 : 0;
  const long era = (y >= 0 ? y : y - 399) / 400;
  const long yearOfEra = y - era * 400;
  const long dayOfYear = (153 * (m + (m > 2 ? -3 : 9)) + 2) / 5 + d - 1;
  return era * 146097 + yearOfEra * 365 + yearOfEra / 4 - yearOfEra / 100 + dayOfYear - 719468;
}

std::string dateOf(long days)
{
  days += 719468;
  const long era = (days >= 0 ? days : days - 146096) / 146097;
  const long dayOfEra = days - era * 146097;
  const long yearOfEra = (dayOfEra - dayOfEra / 1460 + dayOfEra / 36524 - dayOfEra / 146096) / 365;
  const long dayOfYear = dayOfEra - (365 * yearOfEra + yearOfEra / 4 - yearOfEra / 100);
  const long part = (5 * dayOfYear + 2) / 153;
  const long day = dayOfYear - (153 * part + 2) / 5 + 1;
  const long month = part < 10 ? part + 3 : part - 9;
  const long year = yearOfEra + era * 400 + (month <= 2 ? 1 : 0);
  std::string text = std::to_string(year * 10000 + month * 100 + day);
  return std::string(text.size() < 8 ? 8 - text.size() : 0, '0') + text;
}

// YYYYMMDD with whatever follows; empty if it is not a date.
std::string shifted(const std::string& value, int daysEarlier)
{
  const std::string date = value.substr(0, 8);
  if (date.size() < 8 || !hasOnly(date, "0123456789") || !hasOnly(value, "0123456789.+-"))
    return {};
  const long year = std::stol(date.substr(0, 4)), month = std::stol(date.substr(4, 2)),
             day = std::stol(date.substr(6, 2));
  if (year < 1 || month < 1 || month > 12 || day < 1 || day > 31)
    return {};
  return dateOf(daysOf(year, month, day) - daysEarlier) + value.substr(8);
}

// Letters of other character sets fold their case in ways of their own, and a name in one set has
// other bytes in another: such text cannot be compared with the patient's name.
bool isPlainText(const std::string& text)
{
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c < 0x7f; });
}

bool isDigits(const std::string& text, std::size_t from, std::size_t count)
{
  return text.size() >= from + count && hasOnly(text.substr(from, count), "0123456789");
}

// HH[MM[SS[.FFFFFF]]], or with colons as in ACR-NEMA.
bool isTime(std::string text)
{
  if (text.size() >= 8 && text[2] == ':' && text[5] == ':')
    text = text.substr(0, 2) + text.substr(3, 2) + text.substr(6);
  const std::size_t whole = std::min(text.find('.'), text.size());
  if ((whole != 2 && whole != 4 && whole != 6) || !isDigits(text, 0, whole))
    return false;
  const std::size_t fraction = text.size() > whole ? text.size() - whole - 1 : 0;
  return text.substr(0, 2) < "24" && (whole < 4 || text.substr(2, 2) < "60") &&
         (whole < 6 || text.substr(4, 2) < "61") && fraction <= 6 &&
         isDigits(text, text.size() - fraction, fraction);
}

bool isDate(const std::string& text)
{
  return text.size() == 8 && isDigits(text, 0, 8) && text.substr(4, 2) >= "01" &&
         text.substr(4, 2) <= "12" && text.substr(6) >= "01" && text.substr(6) <= "31";
}

// &ZZXX
bool isZone(const std::string& text)
{
  return text.size() == 5 && (text[0] == '+' || text[0] == '-') && isDigits(text, 1, 4) &&
         text.substr(1, 2) <= "14" && text.substr(3) < "60";
}

// YYYY[MM[DD[HH[MM[SS[.F]]]]]][&ZZXX]
bool isDateTime(std::string text)
{
  const std::size_t sign = text.find_first_of("+-");
  if (sign != std::string::npos)
  {
    if (!isZone(text.substr(sign)))
      return false;
    text = text.substr(0, sign);
  }
  if (text.size() == 4 || text.size() == 6)
    return isDate(text + (text.size() == 4 ? "0101" : "01"));
  return isDate(text.substr(0, 8)) && (text.size() == 8 || isTime(text.substr(8)));
}

// DS, or IS without fraction and exponent; longer than 16 bytes as many programs write it.
bool isDecimal(std::string text, bool isWhole)
{
  constexpr std::size_t kLongest = 32, kMostDigits = 12;
  text.erase(0, text.find_first_not_of(' '));
  std::size_t at = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0, digits = 0;
  const auto pass = [&]
  {
    for (; isDigits(text, at, 1); ++at)
      ++digits;
  };
  pass();
  if (!isWhole && at < text.size() && text[at] == '.')
  {
    ++at;
    pass();
  }
  if (digits == 0 || text.size() > kLongest || (isWhole && digits > kMostDigits))
    return false;
  if (!isWhole && at < text.size() && (text[at] == 'e' || text[at] == 'E'))
  {
    ++at;
    if (at < text.size() && (text[at] == '+' || text[at] == '-'))
      ++at;
    digits = 0;
    pass();
    if (digits == 0 || digits > 3)
      return false;
  }
  return at == text.size();
}

// One value of a string VR has the form of PS3.5 6.2. Text: any.
bool hasFormOf(DcmEVR vr, const std::string& value)
{
  if (value.empty())
    return true;
  switch (vr)
  {
  case EVR_DA: // with points: ACR-NEMA
    return isDate(value) || (value.size() == 10 && value[4] == '.' && value[7] == '.' &&
                             isDate(value.substr(0, 4) + value.substr(5, 2) + value.substr(8)));
  case EVR_TM:
    return isTime(value);
  case EVR_DT:
    return isDateTime(value);
  case EVR_AS:
    return value.size() == 4 && isDigits(value, 0, 3) && hasOnly(value.substr(3), "DWMY");
  case EVR_DS:
    return isDecimal(value, false);
  case EVR_IS:
    return isDecimal(value, true);
  case EVR_CS:
    return value.size() <= 16 && hasOnly(value, "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 _");
  case EVR_AE:
    return value.size() <= 16;
  default:
    return true;
  }
}

std::string textIn(const void* bytes, std::size_t count)
{
  std::string text(static_cast<const char*>(bytes), count);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\0'))
    text.pop_back();
  return text;
}

bool isLetter(char c)
{
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

constexpr std::size_t kTellingBytes = 6;

// Whether a real number is too large or too small for a quantity of an image, as most are whose
// bytes are text. The last byte of a double has the exponent (IEEE 754, little endian): a blank, a
// digit or a sign before it in ASCII stands for less than 2^-95, a letter from 'D' on for 2^65 and
// more.
bool isImplausible(double value)
{
  constexpr double kLeast = 1e-25, kMost = 1e15;
  return std::abs(value) > kMost || (value != 0.0 && std::abs(value) < kLeast);
}

// Numbers whose bytes are those of a name.
bool areLetters(const std::string& text)
{
  const auto isOfName = [](char c)
  { return isLetter(c) || (c != '\0' && std::strchr("^ -,.'", c) != nullptr); };
  return text.size() >= kTellingBytes && std::all_of(text.begin(), text.end(), isOfName);
}

bool isPrinted(const std::string& text)
{
  return std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return c >= 0x20 && c != 0x7f; });
}

// Numbers that have no other bytes than text has, in any character set; real numbers may, too.
bool mayBeText(const std::string& text)
{
  const auto letters = std::count_if(text.begin(), text.end(), isLetter);
  return text.size() >= kTellingBytes && isPrinted(text) &&
         2 * static_cast<std::size_t>(letters) >= text.size();
}

// Whether text of Latin-1 has a word of five letters or more, at least three of them different, or
// is nothing but words, each in capitals or in small letters after the first. One letter over and
// over is a fraction's: "UUUUUU" of thirds, "ffffff" of tenths.
bool hasWordsOfLatin1(const std::string& text)
{
  constexpr std::size_t kLong = 5;
  constexpr std::size_t kDifferent = 3;
  const auto isCapital = [](unsigned char c)
  { return (c >= 'A' && c <= 'Z') || (c >= 0xc0 && c <= 0xde && c != 0xd7); }; // a times sign
  const auto isSmall = [](unsigned char c)
  { return (c >= 'a' && c <= 'z') || (c >= 0xdf && c != 0xf7); }; // a division sign
  const auto run = [&text](std::size_t from, const auto& is)
  {
    const auto start = text.begin() + static_cast<std::ptrdiff_t>(from);
    return static_cast<std::size_t>(std::find_if_not(start, text.end(), is) - start);
  };
  bool isAll = true;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t capitals = run(at, isCapital);
    const std::size_t small = run(at + capitals, isSmall);
    // The last capital of several begins a word of small letters.
    const std::size_t word =
        small == 0 ? capitals : std::max(capitals, small + (capitals > 0 ? 1 : 0));
    const auto start = text.begin() + static_cast<std::ptrdiff_t>(at);
    const std::set<char> letters(start, start + static_cast<std::ptrdiff_t>(capitals + small));
    if (word >= kLong && letters.size() >= kDifferent)
      return true;
    at += capitals + small;
    isAll = isAll && (capitals < 2 || small == 0);
    // Between two words, and around all of them.
    const std::size_t between =
        run(at, [](unsigned char c) { return c != '\0' && std::strchr("^ -,.'", c) != nullptr; });
    isAll = isAll && (between > 0 || at == text.size());
    at += std::max<std::size_t>(between, word == 0 ? 1 : 0);
  }
  return isAll;
}

// Values of the safe private attributes of VR CS, LO and SH: a ratio, anatomical directions, GE's
// pulse sequences, ELSCINT's acquisition types.
bool isSafePrivateTerm(const std::string& value)
{
  static const std::set<std::string> kTerms{
      "BODY",      "HEAD",     "NONE",     "DIRECTIONAL", "ISOTROPIC", "BMATRIX", "SLICES",
      "HELIX",     "HELICAL",  "AXIAL",    "SCOUT",       "FH",        "AP",      "RL",
      "I",         "O",        "P",        "M",           "S",         "FGRE",    "EFGRE3D",
      "3DGRASS",   "FSE-XL",   "FRFSE-XL", "SSFSE",       "FSPGR",     "3DFSPGR", "3DFIESTA",
      "3DFIESTAC", "FIESTA-C", "3DFSE",    "EPI2",        "EPI2AS",    "EPI2IS",  "PROPELLER"};
  return kTerms.count(value) > 0 || (value.size() <= 12 && hasOnly(value, "0123456789.:/-"));
}

const char* dummyOf(DcmEVR vr)
{
  switch (vr)
  {
  case EVR_DA:
    return "19000101";
  case EVR_DT:
    return "19000101000000";
  case EVR_TM:
    return "000000";
  case EVR_AS:
    return "000Y";
  case EVR_DS:
  case EVR_IS:
    return "0";
  case EVR_AE:
  case EVR_CS:
    return "ANONYMIZED";
  case EVR_UR:
    return "urn:anonymized";
  default:
    return kDummyText;
  }
}

std::string firstOf(DcmItem& item, const std::vector<DcmTagKey>& keys)
{
  for (const DcmTagKey& key : keys)
    if (std::string value = valueOf(item, key); !value.empty())
      return value;
  return {};
}

// Hospitals number their patients alike: an ID is unique with its issuer only (PS3.3 C.7.1.1).
std::string patientOf(DcmItem& dataSet)
{
  const std::string issuer = valueOf(dataSet, DCM_IssuerOfPatientID);
  const std::string id = valueOf(dataSet, DCM_PatientID);
  if (!id.empty())
    return issuer.empty() ? id : id + "\n" + issuer;
  return firstOf(dataSet, {DCM_PatientName, DCM_StudyInstanceUID});
}

// One file on its way through.
class FileCleaner
{
public:
  FileCleaner(DicomCleaner& cleaner, const DeidentificationOptions& options,
              const PseudonymKey& key, DcmDataset& dataSet)
    : m_cleaner(cleaner)
    , m_options(options)
    , m_key(key)
    , m_iod(iodKindOf(valueOf(dataSet, DCM_SOPClassUID)))
    , m_patient(patientOf(dataSet))
  {
    collect(dataSet);
  }

  void clean(DcmItem& item, const std::string& path = {})
  {
    keepPrivate(item, path);
    for (unsigned long n = 0; n < item.card();)
    {
      DcmElement* element = item.getElement(n);
      if (tagOf(element->getTag()) >> 16 & 1U) // private, already decided
      {
        ++n;
        continue;
      }
      if (cleaned(item, *element, path))
        ++n;
      else
        delete item.remove(element);
    }
  }

  const std::string& patient() const { return m_patient; }

  /// What was done beside the attributes of the data set.
  void noteBeside(const std::string& attribute, const std::string& name, const std::string& action,
                  bool stays)
  {
    auto& done = m_cleaner.done[{attribute, action}];
    done.name = name;
    done.action = action;
    done.stays = stays;
    ++done.files;
  }

private:
  void note(const std::string& path, const DcmElement& element, const std::string& name,
            const std::string& action, bool stays)
  {
    const std::string whole = path + pathOf(element.getTag());
    if (!m_noted.insert(whole + action).second)
      return;
    auto& done = m_cleaner.done[{whole, action}];
    done.name = name;
    done.action = action;
    done.stays = stays;
    ++done.files;
  }

  // Words that name people and places, from anywhere in the file.
  void collect(DcmItem& item)
  {
    for (unsigned long n = 0; n < item.card(); ++n)
    {
      DcmElement* element = item.getElement(n);
      if (auto* sequence = dynamic_cast<DcmSequenceOfItems*>(element); sequence)
      {
        if (element->getVR() != EVR_SQ)
          continue;
        for (unsigned long i = 0; i < sequence->card(); ++i)
          collect(*sequence->getItem(i));
        continue;
      }
      switch (tagOf(element->getTag()))
      {
      case 0x00080050: // Accession Number
      case 0x00080080: // Institution Name
      case 0x00080081: // Institution Address
      case 0x00081010: // Station Name
      case 0x00081040: // Institutional Department Name
      case 0x00100020: // Patient ID
      case 0x00100021: // Issuer of Patient ID
      case 0x00100030: // Patient's Birth Date
      case 0x00101000: // Other Patient IDs
      case 0x00101040: // Patient's Address
      case 0x00102154: // Patient's Telephone Numbers
      case 0x00181000: // Device Serial Number
      case 0x00200010: // Study ID
        m_words.add(valueOf(*element));
        if (const std::uint32_t tag = tagOf(element->getTag());
            tag >> 16 == 0x0010 || tag == 0x00080050 || tag == 0x00200010)
          for (const std::string& one : split(valueOf(*element)))
            m_people.addIdentifier(one);
        break;
      default:
        if (element->getVR() == EVR_PN)
        {
          m_words.add(valueOf(*element));
          // An operator's "MR" does not forbid that word.
          if (tagOf(element->getTag()) >> 16 == 0x0010)
            m_people.addName(valueOf(*element));
          else
            m_people.add(valueOf(*element));
        }
      }
    }
  }

  // Removes private elements but for safe ones, and blocks of which none remains.
  void keepPrivate(DcmItem& item, const std::string& path)
  {
    std::map<std::uint32_t, std::string> creators; // group << 16 | block
    for (unsigned long n = 0; n < item.card(); ++n)
    {
      DcmElement* element = item.getElement(n);
      const DcmTag& tag = element->getTag();
      if ((tag.getGroup() & 1) != 0 && tag.getElement() >= 0x10 && tag.getElement() <= 0xff)
        creators[std::uint32_t{tag.getGroup()} << 16 | tag.getElement()] = valueOf(*element);
    }
    std::set<std::uint32_t> used;
    for (unsigned long n = item.card(); n-- > 0;)
    {
      DcmElement* element = item.getElement(n);
      const DcmTag tag = element->getTag();
      if ((tag.getGroup() & 1) == 0)
        continue;
      const std::uint32_t block =
          std::uint32_t{tag.getGroup()} << 16 | static_cast<std::uint32_t>(tag.getElement() >> 8);
      const auto creator = creators.find(block);
      if (tag.getElement() >= 0x10 && tag.getElement() <= 0xff)
      {
        if (used.count(tagOf(tag)) > 0)
        {
          element->putString(creators[tagOf(tag)].c_str());
          note(path, *element, "Private Creator", "kept: block of safe private attributes", true);
          continue;
        }
      }
      else if (m_options.retainSafePrivate && creator != creators.end() &&
               isCleanPrivate(*element,
                              m_cleaner.profile.safePrivateVr(creator->second, tag.getGroup(),
                                                              tag.getElement() & 0xff)))
      {
        used.insert(block);
        note(path, *element, creator->second, "kept: safe private attribute", true);
        continue;
      }
      const bool isCreator = tag.getElement() <= 0xff;
      note(path, *element, isCreator ? "Private Creator" : "Private", "removed: private", false);
      delete item.remove(element);
    }
  }

  // What the list says of it holds, also if the file has no VR (UN).
  bool isCleanPrivate(DcmElement& element, const std::string& listedVr)
  {
    if (listedVr.empty())
      return false;
    const DcmEVR listed = DcmVR(listedVr.c_str()).getEVR(), own = element.getVR();
    const bool isUnknown = own == EVR_UN || own == EVR_UNKNOWN || own == EVR_UNKNOWN2B;
    const DcmEVR vr = isUnknown ? EVR_UN : own;
    std::string value;
    if (isUnknown)
    {
      Uint8* bytes = nullptr;
      if (element.getUint8Array(bytes).bad() || !bytes)
        return false;
      value.assign(reinterpret_cast<const char*>(bytes), element.getLength());
    }
    else if (vr != listed)
      return false;
    if (isNumber(listed))
    {
      constexpr std::size_t kMatrix = 9 * 8;
      return element.getLength() <= kMatrix &&
             (vr == listed ? arePlainNumbers(element) : arePlainNumbers(value, listed));
    }
    if (vr != EVR_UN)
      value = valueOf(element);
    while (!value.empty() && (value.back() == ' ' || value.back() == '\0'))
      value.pop_back();
    if (value.find('\0') != std::string::npos)
      return false;
    const auto parts = split(value);
    const bool isClean =
        std::all_of(parts.begin(), parts.end(),
                    [&](const std::string& part)
                    {
                      return listed == EVR_DS || listed == EVR_IS
                                 ? hasFormOf(listed, part) && !m_people.isIdentifier(part)
                                 : isTechnique(part) ||
                                       (isSafePrivateTerm(part) && !m_people.isIdentifier(part));
                    });
    return isClean && (vr == EVR_UN || keepString(element, true));
  }

  // A coded string whose words are all of anatomy and technique, and none the patient's.
  bool isTechnique(const std::string& value) const
  {
    std::string spaced = value;
    std::replace(spaced.begin(), spaced.end(), '_', ' ');
    return hasFormOf(EVR_CS, value) && reducedToVocabulary(spaced, m_people) == spaced;
  }

  // A value of VR CS that cannot name a person.
  bool isCodedTerm(std::uint32_t tag, const std::string& value) const
  {
    if (m_cleaner.profile.isDefinedTerm(tag, value))
      return true;
    switch (tag)
    {
    case 0x00200020: // Patient Orientation
      return value.size() <= 3 && hasOnly(value, "APLRHF");
    case 0x0008010f: // Context Identifier
    case 0x0040db00: // Template Identifier
      return value.size() <= 5 && isDigits(value, 0, value.size()) && !m_people.isIdentifier(value);
    default:
      return isTechnique(value);
    }
  }

  // What an option keeps has the form of its VR, and no word of the patient's.
  bool mayStay(DcmElement& element, std::uint32_t tag) const
  {
    constexpr std::uint32_t kZone = 0x00080201; // Timezone Offset From UTC, of VR SH
    const DcmEVR vr = element.getVR();
    if (!isString(vr))
      return false;
    const auto parts = split(valueOf(element));
    return std::all_of(
        parts.begin(), parts.end(),
        [&](const std::string& part)
        {
          if (part.empty())
            return true;
          if (vr == EVR_CS)
            return isCodedTerm(tag, withoutPadding(part));
          return tag == kZone
                     ? isZone(part)
                     : hasFormOf(vr, part) &&
                           !(isText(vr) && (!isPlainText(part) || m_people.hasWord(part))) &&
                           !((vr == EVR_DS || vr == EVR_IS) && m_people.isIdentifier(part));
        });
  }

  // Neither text nor an identifier of the patient.
  template <class Number>
  bool arePlain(const Number* values, std::size_t length) const
  {
    const std::string text = textIn(values, length);
    const Number* end = values + length / sizeof(Number);
    if (areLetters(text) || (isPrinted(text) && m_people.hasWord(text)))
      return false;
    // So are the bytes of one double in 400 of 0 to 1000, and of one pair of floats in 75: rather a
    // number less than a name more.
    if (mayBeText(text) &&
        (std::is_integral_v<Number> || core::isUtf8(text) || hasWordsOfLatin1(text) ||
         std::any_of(values, end,
                     [](Number value) { return isImplausible(static_cast<double>(value)); })))
      return false;
    return std::none_of(values, end,
                        [this](Number value)
                        { return m_people.isIdentifier(static_cast<double>(value)); });
  }

  // And with no bytes after the last whole one, which no reader shows.
  bool arePlainNumbers(DcmElement& element) const
  {
    const std::size_t width = DcmVR(element.getVR()).getValueWidth();
    const std::size_t length = element.getLength();
    if (width > 1 && length % width != 0)
      return false;
    const auto arePlain = [&](const auto* values) { return this->arePlain(values, length); };
    Uint16* u16 = nullptr;
    Sint16* s16 = nullptr;
    Uint32* u32 = nullptr;
    Sint32* s32 = nullptr;
    Float32* f32 = nullptr;
    Float64* f64 = nullptr;
    Uint64* u64 = nullptr;
    Sint64* s64 = nullptr;
    switch (element.getVR())
    {
    case EVR_US:
    case EVR_xs:
    case EVR_AT:
      return element.getUint16Array(u16).bad() || !u16 || arePlain(u16);
    case EVR_SS:
      return element.getSint16Array(s16).bad() || !s16 || arePlain(s16);
    case EVR_UL:
      return element.getUint32Array(u32).bad() || !u32 || arePlain(u32);
    case EVR_SL:
      return element.getSint32Array(s32).bad() || !s32 || arePlain(s32);
    case EVR_FL:
      return element.getFloat32Array(f32).bad() || !f32 || arePlain(f32);
    case EVR_FD:
      return element.getFloat64Array(f64).bad() || !f64 || arePlain(f64);
    case EVR_UV:
      return length <= width && (element.getUint64Array(u64).bad() || !u64 || arePlain(u64));
    case EVR_SV:
      return length <= width && (element.getSint64Array(s64).bad() || !s64 || arePlain(s64));
    default:
      return false;
    }
  }

  // Of an attribute without a VR (UN): little endian (PS3.5 6.2.2).
  template <class Number>
  bool arePlainIn(const std::string& bytes) const
  {
    std::vector<Number> values(bytes.size() / sizeof(Number));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(Number));
    return bytes.size() % sizeof(Number) == 0 && arePlain(values.data(), bytes.size());
  }

  bool arePlainNumbers(const std::string& bytes, DcmEVR listed) const
  {
    switch (listed)
    {
    case EVR_US:
    case EVR_AT:
      return arePlainIn<Uint16>(bytes);
    case EVR_SS:
      return arePlainIn<Sint16>(bytes);
    case EVR_UL:
      return arePlainIn<Uint32>(bytes);
    case EVR_SL:
      return arePlainIn<Sint32>(bytes);
    case EVR_FL:
      return arePlainIn<Float32>(bytes);
    case EVR_FD:
      return arePlainIn<Float64>(bytes);
    default:
      return false;
    }
  }

  std::string vocabularyOf(const std::string& text) const
  {
    return eachPart(text, [this](const std::string& part)
                    { return reducedToVocabulary(part, m_people); });
  }

  // Writes the value anew, so that nothing after a NUL remains.
  static bool keepString(DcmElement& element, bool wanted)
  {
    return wanted && element.putString(valueOf(element).c_str()).good();
  }

  std::string newUids(const std::string& value)
  {
    return eachPart(value, [this](const std::string& uid)
                    { return uid.empty() || isWellKnownUid(uid) ? uid : m_key.uid(uid); });
  }

  // False: to be removed.
  bool cleaned(DcmItem& item, DcmElement& element, const std::string& path)
  {
    const DcmTagKey key = element.getTag();
    const std::uint32_t tag = tagOf(key);
    const DictionaryEntry entry = dictionaryEntry(key);
    const std::string& name = entry.name;
    const auto remove = [&](const std::string& why)
    {
      note(path, element, name, "removed" + why, false);
      return false;
    };
    // UN of undefined length holds items, whatever the dictionary says of the attribute.
    if ((dynamic_cast<DcmSequenceOfItems*>(&element) != nullptr) != (element.getVR() == EVR_SQ))
      return remove(": items in place of a value, or the reverse");
    DeidAction action = m_cleaner.profile.action(tag, m_iod, !path.empty(), m_options);
    const bool isMisplaced =
        key.getGroup() < 4 || (key.getGroup() < 8 && action == DeidAction::Unlisted);
    if (isMisplaced || key.getElement() == 0)
      return remove(key.getElement() == 0 ? ": group length"
                                          : ": command or file meta information");
    if (action == DeidAction::Unlisted)
      return cleanedUnlisted(item, element, entry, path);
    const DcmEVR vr = element.getVR();
    if (action == DeidAction::Keep)
    {
      if (vr == EVR_SQ)
        return recursed(element, path, name, "kept by option, cleaned within");
      if (!agrees(vr, entry.vr) ||
          (isNumber(vr) ? !arePlainNumbers(element) : !keepString(element, mayStay(element, tag))))
        action = basicAction(tag, path);
      else
      {
        note(path, element, name, "kept by option", true);
        return true;
      }
    }
    if (action == DeidAction::Shift)
    {
      if (vr == EVR_SQ)
        return recursed(element, path, name, "kept by option, cleaned within");
      if ((vr == EVR_DA || vr == EVR_DT) && agrees(vr, entry.vr))
        return shiftedDates(element, path, name);
      if (vr == EVR_TM || tag == 0x00080201)
        return keptTime(element, path, name);
      action = basicAction(tag, path);
    }
    if (action == DeidAction::Clean)
    {
      if (vr == EVR_SQ)
        return recursed(element, path, name, "kept by option, cleaned within");
      const std::string rest = isText(vr) ? vocabularyOf(valueOf(element)) : std::string();
      if (!rest.empty() && !hasOnly(rest, "\\"))
      {
        element.putString(rest.c_str());
        note(path, element, name, "cleaned: words of the vocabulary stay", true);
        return true;
      }
      action = basicAction(tag, path);
    }
    switch (action)
    {
    case DeidAction::NewUid:
      if (vr == EVR_SQ)
        return recursed(element, path, name, "kept, UIDs replaced");
      if (vr != EVR_UI)
        return remove(": not a UID");
      element.putString(newUids(valueOf(element)).c_str());
      note(path, element, name, "replaced by a new UID", false);
      return true;
    case DeidAction::Empty:
      makeEmpty(element);
      note(path, element, name, "emptied", false);
      return true;
    case DeidAction::Dummy:
      if (!madeDummy(element, tag, entry.vr))
        return remove("");
      note(path, element, name,
           tag == 0x00100020 ? "replaced by a pseudonym" : "replaced by a dummy", false);
      return true;
    default:
      return remove("");
    }
  }

  DeidAction basicAction(std::uint32_t tag, const std::string& path) const
  {
    return m_cleaner.profile.action(tag, m_iod, !path.empty(), {});
  }

  bool shiftedDates(DcmElement& element, const std::string& path, const std::string& name)
  {
    const int days = m_key.daysEarlier(m_patient);
    const DcmEVR vr = element.getVR();
    bool sound = true;
    const std::string dates = eachPart(valueOf(element),
                                       [&](const std::string& value)
                                       {
                                         const std::string date =
                                             value.empty() || !hasFormOf(vr, value)
                                                 ? std::string()
                                                 : shifted(value, days);
                                         sound = sound && (value.empty() || !date.empty());
                                         return date;
                                       });
    element.putString(sound ? dates.c_str() : dummyOf(element.getVR()));
    note(path, element, name, sound ? "date shifted" : "replaced by a dummy", sound);
    return true;
  }

  bool keptTime(DcmElement& element, const std::string& path, const std::string& name)
  {
    if (!keepString(element, mayStay(element, tagOf(element.getTag()))))
    {
      note(path, element, name, "removed: not a time", false);
      return false;
    }
    note(path, element, name, "kept by option", true);
    return true;
  }

  bool recursed(DcmElement& element, const std::string& path, const std::string& name,
                const std::string& why)
  {
    auto& sequence = dynamic_cast<DcmSequenceOfItems&>(element);
    note(path, element, name, why, true);
    for (unsigned long n = 0; n < sequence.card(); ++n)
      clean(*sequence.getItem(n), path + pathOf(element.getTag()) + "/");
    return true;
  }

  static void makeEmpty(DcmElement& element)
  {
    if (auto* sequence = dynamic_cast<DcmSequenceOfItems*>(&element); sequence)
      while (sequence->card() > 0)
        delete sequence->remove(0UL);
    else
      element.clear();
  }

  // Sequences: the same elements, each with a dummy.
  bool madeDummy(DcmElement& element, std::uint32_t tag, DcmEVR expected)
  {
    const DcmEVR vr = element.getVR();
    if (vr == EVR_SQ)
    {
      auto& sequence = dynamic_cast<DcmSequenceOfItems&>(element);
      for (unsigned long n = 0; n < sequence.card(); ++n)
      {
        DcmItem& inner = *sequence.getItem(n);
        for (unsigned long i = 0; i < inner.card();)
        {
          DcmElement* one = inner.getElement(i);
          const DcmTagKey key = one->getTag();
          const bool isKnown = key.getGroup() >= 8 && (key.getGroup() & 1) == 0 &&
                               key.getElement() != 0 && key.getGroup() >> 8 != 0x60 &&
                               key.getGroup() >> 8 != 0x50 &&
                               agrees(one->getVR(), dictionaryEntry(key).vr);
          if (isKnown && madeDummy(*one, tagOf(key), one->getVR()))
            ++i;
          else
            delete inner.remove(one);
        }
      }
      return true;
    }
    if (vr != expected && !agrees(vr, expected))
      return false;
    if (tag == 0x00100020)
    {
      const std::string pseudonym = m_key.patient(m_patient);
      return element.putString(pseudonym.c_str()).good();
    }
    if (vr == EVR_UI)
    {
      const std::string uids = newUids(valueOf(element));
      return element.putString((uids.empty() ? m_key.uid("") : uids).c_str()).good();
    }
    if (isString(vr))
      return element.putString(dummyOf(vr)).good();
    if (vr == EVR_OB || vr == EVR_UN)
    {
      const Uint8 nothing[2] = {0, 0};
      return element.putUint8Array(nothing, 2).good();
    }
    if (vr == EVR_US)
    {
      const Uint16 nothing = 0;
      return element.putUint16Array(&nothing, 1).good();
    }
    return false;
  }

  bool cleanedUnlisted(DcmItem& item, DcmElement& element, const DictionaryEntry& entry,
                       const std::string& path)
  {
    const std::uint32_t tag = tagOf(element.getTag());
    const DcmEVR vr = element.getVR();
    const auto done = [&](const char* what, bool stays)
    {
      note(path, element, entry.name, what, stays);
      return stays;
    };
    if (entry.vr == EVR_UNKNOWN)
      return done("removed: not in the standard's dictionary", false);
    if (!agrees(vr, entry.vr) && !(vr == EVR_SQ && entry.vr == EVR_SQ))
      return done("removed: not of the attribute's VR", false);
    if (vr == EVR_SQ)
      return recursed(element, path, entry.name, "kept, cleaned within");
    if (isNumber(vr))
    {
      const bool tooMany = entry.values > 0 &&
                           element.getNumberOfValues() > static_cast<unsigned long>(entry.values);
      return !tooMany && arePlainNumbers(element)
                 ? done("kept: number", true)
                 : done("removed: more values than it may have, or text in place of numbers",
                        false);
    }
    if (isBytes(vr))
      return areNeededBytes(tag) ? done("kept: voxels or geometry", true)
                                 : done("removed: bytes that are not needed", false);
    const std::string value = valueOf(element);
    switch (vr)
    {
    case EVR_UI:
    {
      const std::string uids = newUids(value);
      element.putString(uids.c_str());
      if (uids == value)
        return done("kept: UID of the standard", true);
      note(path, element, entry.name, "replaced by a new UID", false);
      return true;
    }
    case EVR_DS:
    case EVR_IS:
    {
      const auto parts = split(value);
      const bool isSound = (entry.values != 1 || parts.size() == 1) &&
                           std::all_of(parts.begin(), parts.end(),
                                       [&](const std::string& part) {
                                         return hasFormOf(vr, part) && !m_people.isIdentifier(part);
                                       });
      if (keepString(element, isSound))
        return done("kept: number", true);
      makeEmpty(element);
      note(path, element, entry.name, "emptied: not a number, or an identifier of the patient",
           false);
      return true;
    }
    case EVR_CS:
    {
      // Each value has its place (Image Type): a dummy takes that of one that does not stay.
      bool isChanged = false;
      const std::string rest = eachPart(value,
                                        [&](const std::string& padded)
                                        {
                                          const std::string part = withoutPadding(padded);
                                          if (part.empty() || isCodedTerm(tag, part))
                                            return part;
                                          isChanged = true;
                                          return std::string(dummyOf(EVR_CS));
                                        });
      if (isChanged && tag == 0x00080005) // Specific Character Set: what is written is ASCII
        return done("removed: not a defined term", false);
      element.putString(rest.c_str());
      note(path, element, entry.name,
           isChanged ? "coded string: a dummy for what is no defined term"
                     : "kept: defined terms, or words of the vocabulary",
           !isChanged);
      return true;
    }
    case EVR_DA:
    case EVR_DT:
      if (m_options.dates == Dates::Shift)
        return shiftedDates(element, path, entry.name);
      break;
    case EVR_TM:
      if (m_options.dates == Dates::Shift)
        return keptTime(element, path, entry.name);
      break;
    default:
      break;
    }
    const bool isDateOrTime = vr == EVR_DA || vr == EVR_DT || vr == EVR_TM;
    if (isDateOrTime && m_options.dates == Dates::Keep &&
        keepString(element, mayStay(element, tag)))
      return done("kept by option", true);
    if (value.empty())
    {
      makeEmpty(element);
      return done("kept: empty", true);
    }
    if (tag == 0x00080070 && isKnownManufacturer(value)) // Manufacturer
      return keepString(element, true) && done("kept: known manufacturer", true);
    if (isTechnical(item, tag, value))
      return keepString(element, true) && done("kept: code or unit of a known form", true);
    if (m_options.retainDevice && describesDevice(tag) && isPlainText(value) &&
        !m_words.foundIn(value) && !m_people.hasWord(value))
      return keepString(element, true) && done("kept by option", true);
    if (isText(vr))
    {
      const std::string rest = vocabularyOf(value);
      if (!rest.empty() && !hasOnly(rest, "\\"))
      {
        element.putString(rest.c_str());
        return done("cleaned: words of the vocabulary stay", true);
      }
    }
    element.putString(dummyOf(vr));
    note(path, element, entry.name, "replaced by a dummy", false);
    return true;
  }

  // By its form: nuclei, types of rescaling, names of kernels, codes of schemes that are published.
  bool isTechnical(DcmItem& item, std::uint32_t tag, const std::string& value)
  {
    constexpr const char* kDigits = "0123456789";
    static const std::set<std::string> kNumbered{"DCM", "SCT", "FMA", "LN", "MDC", "UMLS"};
    static const std::set<std::string> kLettered{"SRT", "SNM3", "RADLEX", "NCIt", "UCUM"};
    static const std::set<std::string> kNuclei{"1H",  "3HE",  "7LI", "13C",
                                               "19F", "23NA", "31P", "129XE"};
    static const std::set<std::string> kRescaled{"OD", "HU",  "US",     "MGML", "Z_EFF",
                                                 "ED", "EDW", "HU_MOD", "PCT"};
    switch (tag)
    {
    case 0x00080102: // Coding Scheme Designator
      return kNumbered.count(value) + kLettered.count(value) > 0;
    case 0x00080103: // Coding Scheme Version
      return value.size() <= 8 && hasOnly(value, "0123456789.") && !m_people.isIdentifier(value);
    case 0x00080100: // Code Value
    {
      const std::string scheme = valueOf(item, DCM_CodingSchemeDesignator);
      if (m_people.isIdentifier(value))
        return false;
      if (kNumbered.count(scheme) > 0)
        return value.size() <= 16 && hasOnly(value, "0123456789-");
      constexpr std::size_t kLongest = 10;
      return kLettered.count(scheme) > 0 && value.size() <= kLongest && !m_words.foundIn(value) &&
             (scheme == "UCUM" ? value.size() <= 6
                               : value.find_first_of(kDigits) != std::string::npos &&
                                     hasOnly(value, "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-"));
    }
    case 0x00180085: // Imaged Nucleus
      return kNuclei.count(value) > 0;
    case 0x00281054: // Rescale Type
    case 0x00283004: // Modality LUT Type
      return kRescaled.count(value) > 0;
    case 0x00181210: // Convolution Kernel
      break;
    default:
      return false;
    }
    // Up to two letters, two digits, one letter (H60s, Br64h, FC81), or a number.
    const auto parts = split(value);
    return !m_words.foundIn(value) &&
           std::all_of(parts.begin(), parts.end(),
                       [&](const std::string& part)
                       {
                         const std::size_t digit = part.find_first_of(kDigits);
                         const std::size_t end = part.find_first_not_of(kDigits, digit);
                         return digit != std::string::npos && part.size() <= 5 && digit <= 2 &&
                                (end == std::string::npos || end + 1 == part.size());
                       });
  }

  DicomCleaner& m_cleaner;
  const DeidentificationOptions& m_options;
  const PseudonymKey& m_key;
  IodKind m_iod;
  std::string m_patient;  ///< what tells patients apart
  IdentityWords m_words;  ///< of people, places, devices and visits
  IdentityWords m_people; ///< of people, and the patient's and the visit's identifiers
  std::set<std::string> m_noted;
};

long numberIn(DcmItem& item, const DcmTagKey& key, long otherwise)
{
  Uint16 value = 0;
  return item.findAndGetUint16(key, value).good() ? static_cast<long>(value) : otherwise;
}

// Float pixel data and lookup tables have the length that their frames and descriptors state.
std::string lookupTablesAndFloats(DcmItem& item)
{
  DcmElement* element = nullptr;
  const auto lengthOf = [&](const DcmTagKey& key) -> std::uint64_t
  { return item.findAndGetElement(key, element).good() && element ? element->getLength() : 0; };
  Sint32 frames = 1;
  if (item.findAndGetSint32(DCM_NumberOfFrames, frames).bad() || frames < 1)
    frames = 1;
  const auto cells = static_cast<std::uint64_t>(numberIn(item, DCM_Rows, 0)) *
                     static_cast<std::uint64_t>(numberIn(item, DCM_Columns, 0)) *
                     static_cast<std::uint64_t>(frames);
  for (const auto& [key, width] :
       {std::pair{DCM_FloatPixelData, 4U}, std::pair{DCM_DoubleFloatPixelData, 8U}})
    if (const std::uint64_t length = lengthOf(key); length > 0 && length != cells * width)
      return "the pixel data do not match rows, columns and frames";
  for (const auto& [descriptor, data] :
       {std::pair{DCM_RedPaletteColorLookupTableDescriptor, DCM_RedPaletteColorLookupTableData},
        std::pair{DCM_GreenPaletteColorLookupTableDescriptor, DCM_GreenPaletteColorLookupTableData},
        std::pair{DCM_BluePaletteColorLookupTableDescriptor, DCM_BluePaletteColorLookupTableData},
        std::pair{DCM_LUTDescriptor, DCM_LUTData}})
  {
    constexpr std::uint64_t kMost = 65536; // written as 0
    const std::uint64_t length = lengthOf(data);
    const auto stated = static_cast<std::uint64_t>(numberIn(item, descriptor, 0));
    const std::uint64_t entries = stated == 0 ? kMost : stated;
    if (length > 0 && length != 2 * entries && length != entries + entries % 2)
      return "a lookup table is not as long as its descriptor states";
  }
  return {};
}

/// What was found beside the samples of pixel data, and cleared.
struct ClearedPixels
{
  bool hadBits = false;    ///< outside of those stored
  bool hadPadding = false; ///< bytes after the last sample
  bool hadText = false;    ///< in compressed frames
};

const char* const kPixelsDamaged = "the pixel data do not match rows, columns and frames";

StoredBits storedBitsOf(DcmItem& item)
{
  StoredBits bits;
  bits.allocated = static_cast<int>(numberIn(item, DCM_BitsAllocated, 16));
  bits.stored = static_cast<int>(numberIn(item, DCM_BitsStored, bits.allocated));
  bits.high = static_cast<int>(numberIn(item, DCM_HighBit, bits.stored - 1));
  bits.isSigned = numberIn(item, DCM_PixelRepresentation, 0) != 0;
  return bits;
}

std::string cleanNativePixels(DcmElement& element, std::uint64_t samples, std::uint64_t frames,
                              const StoredBits& bits, E_TransferSyntax syntax,
                              ClearedPixels& cleared)
{
  const std::uint64_t wanted = (samples * static_cast<std::uint64_t>(bits.allocated) + 7) / 8;
  const std::uint64_t length = element.getLength();
  // A whole frame too many is not padding: voxels are not dropped silently.
  const std::uint64_t frame = wanted / frames;
  if (samples == 0 || wanted > length || length - wanted >= std::max<std::uint64_t>(frame, 16))
    return kPixelsDamaged;
  const bool isWords = bits.allocated == 16 || element.getVR() == EVR_OW;
  Uint8* bytes = nullptr;
  if (isWords)
  {
    Uint16* words = nullptr;
    if (element.getUint16Array(words).bad() || !words)
      return kPixelsDamaged;
    bytes = reinterpret_cast<Uint8*>(words);
  }
  else if (element.getUint8Array(bytes).bad() || !bytes)
    return kPixelsDamaged;
  std::vector<Uint8> copy(bytes, bytes + wanted);
  cleared.hadPadding = cleared.hadPadding ||
                       std::any_of(bytes + wanted, bytes + length, [](Uint8 c) { return c != 0; });
  if (bits.allocated == 1)
  {
    const auto used = static_cast<unsigned>(samples % 8);
    const auto keep = static_cast<Uint8>(used == 0 ? 0xffU : (1U << used) - 1U);
    cleared.hadBits = cleared.hadBits || (copy.back() & keep) != copy.back();
    copy.back() = static_cast<Uint8>(copy.back() & keep);
  }
  else if (bits.stored != bits.allocated || bits.high + 1 != bits.stored)
  {
    // Cells of 32 bits in words of a big endian file: not in the order of this machine.
    if (!isClearable(bits) ||
        (bits.allocated == 32 && DcmXfer(syntax).getByteOrder() == EBO_BigEndian))
      return "the bits of its cells that are not stored cannot be cleared";
    if (clearUnusedBits(copy.data(), static_cast<std::size_t>(samples), bits))
      cleared.hadBits = true;
  }
  if (copy.size() % 2 != 0)
    copy.push_back(0);
  if (copy.size() == length && std::equal(copy.begin(), copy.end(), bytes))
    return {};
  if (!isWords)
    return element.putUint8Array(copy.data(), copy.size()).good() ? "" : kPixelsDamaged;
  std::vector<Uint16> words(copy.size() / 2);
  std::memcpy(words.data(), copy.data(), copy.size());
  return element.putUint16Array(words.data(), words.size()).good() ? "" : kPixelsDamaged;
}

/// Whether samples that are coded with more bits than the file states use these, or cannot be
/// decoded here. JPEG-LS cannot: DCMTK brings a CharLS of its own, with the names of the one that
/// GDCM needs and other structures, so that one program cannot have both.
bool usesBitsBeyond(DcmItem& item, const StoredBits& bits)
{
  static std::once_flag once;
  std::call_once(once, [] { DJDecoderRegistration::registerCodecs(); });
  DcmItem copy(item);
  DcmElement* element = nullptr;
  Uint8* bytes = nullptr;
  if (copy.findAndGetElement(DCM_PixelData, element).bad() || !element)
    return true;
  auto* pixels = dynamic_cast<DcmPixelData*>(element);
  DcmStack stack;
  stack.push(&copy);
  stack.push(pixels);
  if (!pixels || pixels->chooseRepresentation(EXS_LittleEndianExplicit, nullptr, stack).bad())
    return true;
  Uint16* words = nullptr;
  const bool isWords = storedBitsOf(copy).allocated == 16;
  if (isWords ? pixels->getUint16Array(words).bad() || !words
              : pixels->getUint8Array(bytes).bad() || !bytes)
    return true;
  if (isWords)
    bytes = reinterpret_cast<Uint8*>(words);
  // After decoding: as the decoder states them.
  const StoredBits now = storedBitsOf(copy);
  StoredBits stated = bits;
  stated.allocated = now.allocated;
  const std::size_t cells = pixels->getLength() / (static_cast<std::size_t>(now.allocated) / 8);
  return !isClearable(stated) || clearUnusedBits(bytes, cells, stated);
}

/// The fragments of each frame (PS3.5 A.4), without the offset table: one each; all of a single
/// frame; else each that begins a codestream begins a frame.
std::vector<std::vector<DcmPixelItem*>> framesOf(DcmPixelSequence& sequence, std::size_t frames)
{
  std::vector<std::vector<DcmPixelItem*>> found;
  const unsigned long parts = sequence.card();
  for (unsigned long n = 1; n < parts; ++n)
  {
    DcmPixelItem* part = nullptr;
    Uint8* bytes = nullptr;
    if (sequence.getItem(part, n).bad() || !part)
      return {};
    bool begins = found.empty() || parts - 1 == frames;
    if (!begins && frames > 1)
      begins = part->getLength() >= 2 && part->getUint8Array(bytes).good() && bytes &&
               bytes[0] == 0xff && (bytes[1] == 0xd8 || bytes[1] == 0x4f);
    if (begins)
      found.emplace_back();
    found.back().push_back(part);
  }
  return found.size() == frames ? found : std::vector<std::vector<DcmPixelItem*>>();
}

std::string cleanFrame(const std::vector<DcmPixelItem*>& parts, std::size_t cells,
                       const StoredBits& bits, bool isRle, bool& mayHaveBits,
                       ClearedPixels& cleared)
{
  std::vector<Uint8> whole; // comments may go on in the next fragment
  for (DcmPixelItem* part : parts)
  {
    Uint8* bytes = nullptr;
    if (part->getLength() > 0 && (part->getUint8Array(bytes).bad() || !bytes))
      return kPixelsDamaged;
    whole.insert(whole.end(), bytes, bytes + part->getLength());
  }
  const std::vector<Uint8> before = whole;
  if (isRle)
  {
    bool hadBits = false;
    if (!clearRleMetadata(whole.data(), whole.size(), cells, bits, hadBits))
      return "its RLE pixel data are damaged";
    cleared.hadBits = cleared.hadBits || hadBits;
    cleared.hadText = cleared.hadText || (!hadBits && whole != before);
  }
  else
  {
    if (!clearCodestreamMetadata(whole.data(), whole.size()))
      return "its compression cannot be checked for text";
    cleared.hadText = cleared.hadText || whole != before;
    const int precision = codestreamPrecision(whole.data(), whole.size());
    mayHaveBits = mayHaveBits || precision == 0 || precision > bits.stored;
  }
  if (whole == before)
    return {};
  std::size_t at = 0;
  for (DcmPixelItem* part : parts)
  {
    const std::size_t count = part->getLength();
    const std::vector<Uint8> copy(whole.begin() + static_cast<std::ptrdiff_t>(at),
                                  whole.begin() + static_cast<std::ptrdiff_t>(at + count));
    at += count;
    if (count > 0 && part->putUint8Array(copy.data(), copy.size()).bad())
      return kPixelsDamaged;
  }
  return {};
}

std::string cleanCompressedPixels(DcmItem& item, DcmPixelSequence& sequence, std::size_t cells,
                                  std::size_t count, const StoredBits& bits,
                                  E_TransferSyntax syntax, ClearedPixels& cleared)
{
  const auto frames = framesOf(sequence, count);
  DcmPixelItem* table = nullptr;
  if (frames.empty() || sequence.getItem(table, 0).bad() || !table)
    return "its compressed frames cannot be told apart";
  bool mayHaveBits = false;
  std::vector<Uint8> offsets;
  std::uint64_t offset = 0;
  for (const auto& parts : frames)
  {
    if (std::string why =
            cleanFrame(parts, cells, bits, syntax == EXS_RLELossless, mayHaveBits, cleared);
        !why.empty())
      return why;
    for (unsigned shift = 0; shift < 32; shift += 8)
      offsets.push_back(static_cast<Uint8>(offset >> shift & 0xffU));
    constexpr std::uint64_t kItemHeader = 8;
    for (DcmPixelItem* part : parts)
      offset += kItemHeader + part->getLength() + part->getLength() % 2;
  }
  if (mayHaveBits && usesBitsBeyond(item, bits))
    return "its compressed pixels have more bits than it states, which cannot be cleared";
  if (table->getLength() == 0)
    return {};
  if (table->getLength() != offsets.size())
    return kPixelsDamaged;
  return table->putUint8Array(offsets.data(), offsets.size()).good() ? "" : kPixelsDamaged;
}

// The item's own Pixel Data. Returns why it cannot leave.
std::string cleanPixels(DcmItem& item, E_TransferSyntax syntax, ClearedPixels& cleared)
{
  DcmElement* element = nullptr;
  if (std::string why = lookupTablesAndFloats(item); !why.empty())
    return why;
  if (item.findAndGetElement(DCM_PixelData, element).bad() || !element)
    return {};
  auto* pixels = dynamic_cast<DcmPixelData*>(element);
  Sint32 frames = 1;
  if (item.findAndGetSint32(DCM_NumberOfFrames, frames).bad() || frames < 1)
    frames = 1;
  const auto number = [&item](const DcmTagKey& key, long otherwise)
  { return static_cast<std::uint64_t>(numberIn(item, key, otherwise)); };
  const std::uint64_t cells = number(DCM_Rows, 0) * number(DCM_Columns, 0);
  const auto count = static_cast<std::uint64_t>(frames);
  const StoredBits bits = storedBitsOf(item);
  if (pixels && DcmXfer(syntax).isEncapsulated())
  {
    DcmPixelSequence* sequence = nullptr;
    pixels->getEncapsulatedRepresentation(syntax, nullptr, sequence);
    if (sequence)
      return cleanCompressedPixels(item, *sequence, static_cast<std::size_t>(cells),
                                   static_cast<std::size_t>(count), bits, syntax, cleared);
  }
  std::uint64_t samples = cells * number(DCM_SamplesPerPixel, 1) * count;
  // Two pixels share their chrominance (PS3.3 C.7.6.3.1.2).
  if (valueOf(item, DCM_PhotometricInterpretation) == "YBR_FULL_422")
    samples = cells * 2 * count;
  return cleanNativePixels(*element, samples, count, bits, syntax, cleared);
}

// In sequences as well (icons).
std::string cleanAllPixels(DcmItem& item, E_TransferSyntax syntax, bool nested,
                           ClearedPixels& cleared)
{
  if (std::string why = cleanPixels(item, syntax, cleared); !why.empty())
    return nested ? "an icon: " + why : why;
  for (unsigned long n = 0; n < item.card(); ++n)
    if (item.getElement(n)->getVR() == EVR_SQ)
      if (auto* sequence = dynamic_cast<DcmSequenceOfItems*>(item.getElement(n)); sequence)
        for (unsigned long i = 0; i < sequence->card(); ++i)
          if (std::string why = cleanAllPixels(*sequence->getItem(i), syntax, true, cleared);
              !why.empty())
            return why;
  return {};
}

/// Why a file of this SOP class cannot be de-identified; empty: it can.
std::string unsuitable(const std::string& sopClass)
{
  const std::string name = [&]
  {
    const char* known = dcmFindNameOfUID(sopClass.c_str());
    return std::string(known ? known : "");
  }();
  if (sopClass == UID_MediaStorageDirectoryStorage)
    return "a DICOMDIR, which names patients";
  if (!isWellKnownUid(sopClass))
    return "of a private SOP class";
  // Reports, key objects, procedure logs: sentences, names and dates in the content items.
  if (sopClass.rfind("1.2.840.10008.5.1.4.1.1.88.", 0) == 0)
    return "a structured document, whose text cannot be de-identified";
  if (name.rfind("Encapsulated", 0) == 0)
    return "an encapsulated document, whose text cannot be de-identified";
  // A voice is one's own, and nothing else would be left of the file without its samples.
  if (sopClass.rfind("1.2.840.10008.5.1.4.1.1.9.", 0) == 0)
    return "a waveform, whose samples may identify";
  if (name.find("RawData") != std::string::npos)
    return "raw data of a manufacturer, which may hold anything";
  return {};
}

// RT structure sets, segmentations of voxels, of surfaces and as label maps, scanned surfaces.
bool isOutlines(const std::string& sopClass)
{
  for (const char* outlines : {"1.2.840.10008.5.1.4.1.1.481.3", "1.2.840.10008.5.1.4.1.1.66.4",
                               "1.2.840.10008.5.1.4.1.1.66.5", "1.2.840.10008.5.1.4.1.1.66.7",
                               "1.2.840.10008.5.1.4.1.1.68.1", "1.2.840.10008.5.1.4.1.1.68.2"})
    if (sopClass == outlines)
      return true;
  return false;
}

// A head is some 150 mm wide and 180 mm long.
bool coversAHead(DcmItem& item)
{
  constexpr double kHead = 140.0; // mm
  Float64 down = 0.0, across = 0.0;
  return item.findAndGetFloat64(DCM_PixelSpacing, down, 0, OFTrue).good() &&
         item.findAndGetFloat64(DCM_PixelSpacing, across, 1, OFTrue).good() &&
         down * static_cast<double>(numberIn(item, DCM_Rows, 0)) > kHead &&
         across * static_cast<double>(numberIn(item, DCM_Columns, 0)) > kHead;
}

// Attributes of type 2 or 2C that PS3.3 requires (A.3, A.4, C.7.1.1, C.7.2.1, C.7.3.1, C.7.4.1,
// C.7.5.1, C.7.6.2, C.8.2.1, C.8.3.1) and the data set lacks: empty, they say that the value is not
// known, which is so.
std::vector<DcmTagKey> missingOfType2(DcmItem& dataSet, const std::string& sopClass)
{
  if (iodKindOf(sopClass) == IodKind::Other)
    return {};
  std::vector<DcmTagKey> keys{DCM_PatientName, DCM_PatientID,       DCM_PatientBirthDate,
                              DCM_PatientSex,  DCM_StudyDate,       DCM_StudyTime,
                              DCM_StudyID,     DCM_AccessionNumber, DCM_ReferringPhysicianName};
  const bool isCt = sopClass == UID_CTImageStorage, isMr = sopClass == UID_MRImageStorage;
  if (isCt || isMr)
  {
    keys.insert(keys.end(), {DCM_Manufacturer, DCM_SeriesNumber, DCM_InstanceNumber,
                             DCM_PositionReferenceIndicator, DCM_SliceThickness});
    // Type 2C: of a body part that is no pair it must be absent, and of a pair it has a value.
    if (!dataSet.tagExistsWithValue(DCM_BodyPartExamined) &&
        !dataSet.tagExists(DCM_ImageLaterality))
      keys.push_back(DCM_Laterality);
    if (!dataSet.tagExists(DCM_PatientOrientationCodeSequence))
      keys.push_back(DCM_PatientPosition);
  }
  if (isCt)
    keys.insert(keys.end(), {DCM_KVP, DCM_AcquisitionNumber});
  if (isMr)
    keys.insert(keys.end(), {DCM_EchoTime, DCM_EchoTrainLength});
  keys.erase(std::remove_if(keys.begin(), keys.end(),
                            [&dataSet](const DcmTagKey& key) { return dataSet.tagExists(key); }),
             keys.end());
  return keys;
}

void putCode(DcmItem& dataSet, unsigned long number, const char* value, const char* meaning)
{
  DcmItem* item = nullptr;
  if (dataSet
          .findOrCreateSequenceItem(DCM_DeidentificationMethodCodeSequence, item,
                                    static_cast<signed long>(number))
          .bad())
    return;
  item->putAndInsertString(DCM_CodeValue, value);
  item->putAndInsertString(DCM_CodingSchemeDesignator, "DCM");
  item->putAndInsertString(DCM_CodeMeaning, meaning);
}

// PS3.3 C.7.1.1, PS3.16 CID 7050.
void putMethod(DcmDataset& dataSet, const DeidentificationOptions& options,
               const std::string& edition, bool isFaceMasked)
{
  dataSet.putAndInsertString(DCM_PatientIdentityRemoved, "YES");
  std::string method = ("Petrous: " + edition).substr(0, 64);
  if (isFaceMasked)
  {
    method += "\\RECOGNIZABLE VISUAL FEATURES masked"; // a second value
    dataSet.putAndInsertString(DCM_RecognizableVisualFeatures, "NO");
  }
  dataSet.putAndInsertString(DCM_DeidentificationMethod, method.c_str());
  delete dataSet.remove(DCM_DeidentificationMethodCodeSequence);
  unsigned long n = 0;
  putCode(dataSet, n++, "113100", "Basic Application Confidentiality Profile");
  if (isFaceMasked)
    putCode(dataSet, n++, "113102", "Clean Recognizable Visual Features Option");
  if (options.cleanDescriptors)
    putCode(dataSet, n++, "113105", "Clean Descriptors Option");
  if (options.dates == Dates::Keep)
    putCode(dataSet, n++, "113106", "Retain Longitudinal Temporal Information Full Dates Option");
  if (options.dates == Dates::Shift)
    putCode(dataSet, n++, "113107",
            "Retain Longitudinal Temporal Information Modified Dates Option");
  if (options.retainPatientCharacteristics)
    putCode(dataSet, n++, "113108", "Retain Patient Characteristics Option");
  if (options.retainDevice)
    putCode(dataSet, n++, "113109", "Retain Device Identity Option");
  if (options.retainSafePrivate)
    putCode(dataSet, n++, "113111", "Retain Safe Private Option");
  dataSet.putAndInsertString(DCM_LongitudinalTemporalInformationModified,
                             options.dates == Dates::Keep    ? "UNMODIFIED"
                             : options.dates == Dates::Shift ? "MODIFIED"
                                                             : "REMOVED");
}

// What of group 2 is not written again; that of the toolkit itself aside.
std::vector<DcmTagKey> replacedMeta(DcmItem& meta)
{
  std::vector<DcmTagKey> keys;
  for (unsigned long n = 0; n < meta.card(); ++n)
    switch (const DcmTagKey key = meta.getElement(n)->getTag(); tagOf(key))
    {
    case 0x00020000: // group length
    case 0x00020001: // version
    case 0x00020002: // SOP class and instance
    case 0x00020003:
    case 0x00020010: // transfer syntax
      break;
    default:
      keys.push_back(key);
    }
  return keys;
}

bool hasPreamble(const std::filesystem::path& path)
{
  constexpr std::size_t kPreamble = 128;
  std::string start(kPreamble + 4, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  return file && start.compare(kPreamble, 4, "DICM") == 0 &&
         start.find_first_not_of('\0') < kPreamble;
}

/// Writes a file from its start. Unlike DCMTK's own, keeps what the disk says, also at the end.
class WrittenFile : public DcmConsumer
{
public:
  explicit WrittenFile(const std::filesystem::path& path)
    : m_descriptor(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666))
    , m_error(m_descriptor < 0 ? errno : 0)
  {
    m_waiting.reserve(kBlock);
  }
  ~WrittenFile() override { close(); }
  WrittenFile(const WrittenFile&) = delete;
  WrittenFile& operator=(const WrittenFile&) = delete;

  /// Returns errno of the first failure, or 0.
  int close()
  {
    if (m_descriptor < 0)
      return m_error;
    empty();
    if (::close(m_descriptor) != 0 && errno != EINTR && m_error == 0)
      m_error = errno;
    m_descriptor = -1;
    return m_error;
  }

  OFBool good() const override { return m_error == 0; }
  OFCondition status() const override { return good() ? EC_Normal : EC_InvalidStream; }
  OFBool isFlushed() const override { return OFTrue; }
  offile_off_t avail() const override { return std::numeric_limits<offile_off_t>::max(); }
  offile_off_t write(const void* bytes, offile_off_t count) override
  {
    const auto size = static_cast<std::size_t>(count);
    if (m_waiting.size() + size > kBlock)
      empty();
    if (size >= kBlock)
      put(static_cast<const char*>(bytes), size);
    else
      m_waiting.append(static_cast<const char*>(bytes), size);
    return good() ? count : 0;
  }
  void flush() override {}

private:
  static constexpr std::size_t kBlock = std::size_t{1} << 16;

  void empty()
  {
    put(m_waiting.data(), m_waiting.size());
    m_waiting.clear();
  }

  void put(const char* bytes, std::size_t count)
  {
    if (m_error == 0)
      m_error = core::writeAll(m_descriptor, bytes, count);
  }

  int m_descriptor;
  int m_error;
  std::string m_waiting;
};

class WritingStream : public DcmOutputStream
{
public:
  explicit WritingStream(WrittenFile& file)
    : DcmOutputStream(&file)
  {
  }
};

// Throws core::OutputFileError.
void save(DcmFileFormat& content, E_TransferSyntax syntax, const std::filesystem::path& path)
{
  WrittenFile file(path);
  OFCondition saved = file.status();
  if (saved.good())
  {
    WritingStream stream(file);
    content.transferInit();
    saved = content.write(stream, syntax, EET_UndefinedLength, nullptr, EGL_withoutGL,
                          EPD_withoutPadding, 0, 0, 0, EWM_createNewMeta);
    content.transferEnd();
    stream.flush(); // what a compression holds
    if (saved.good() && !stream.isFlushed())
      saved = EC_InvalidStream;
  }
  if (const int error = file.close())
    core::throwOutputError(error, path);
  if (saved.bad())
    throw core::OutputFileError(core::OutputFileError::Reason::Failed, path, "cannot be written");
}

// By iconv; empty if it is not of that set.
std::string converted(std::string text, const char* set)
{
  const iconv_t state = ::iconv_open("UTF-8", set);
  if (state == reinterpret_cast<iconv_t>(-1))
    return {};
  std::string utf8(4 * text.size() + 16, '\0');
  char *from = text.data(), *to = utf8.data();
  std::size_t left = text.size(), room = utf8.size();
  const bool isDone =
      ::iconv(state, &from, &left, &to, &room) != static_cast<std::size_t>(-1) && left == 0;
  ::iconv_close(state);
  utf8.resize(isDone ? utf8.size() - room : 0);
  return utf8;
}

// Code extensions by escape sequences (PS3.3 C.12.1.1.2), which DCMTK does not convert with the C
// library's iconv: Japanese, and Korean and Chinese, whose characters stand in the upper half.
// Empty: none of them.
std::string fromEastAsian(const std::string& text)
{
  if (text.find('\x1b') == std::string::npos)
    return {};
  for (const auto& [escape, set] : {std::pair("\x1b$)C", "EUC-KR"), std::pair("\x1b$)A", "EUC-CN")})
    if (text.find(escape) != std::string::npos)
    {
      std::string rest = text;
      for (std::size_t at = rest.find(escape); at != std::string::npos; at = rest.find(escape))
        rest.erase(at, std::strlen(escape));
      return converted(rest, set);
    }
  return converted(text, "ISO-2022-JP-2");
}

// Of a file's character set. What is not of it is taken for UTF-8, or else for Latin-1, so that no
// byte is lost.
std::string utf8Of(const std::string& text, const std::string& characterSet)
{
  if (std::string converted = fromEastAsian(text); !converted.empty())
    return converted;
  if (isPlainText(text))
    return text;
  DcmDataset item;
  if (item.putAndInsertString(DCM_SpecificCharacterSet, characterSet.c_str()).good() &&
      item.putAndInsertString(DCM_PatientName, text.c_str()).good() && item.convertToUTF8().good())
    if (std::string converted = valueOf(item, DCM_PatientName);
        !converted.empty() && core::isUtf8(converted))
      return converted;
  if (core::isUtf8(text))
    return text;
  std::string latin;
  for (const char c : text)
    if (const auto byte = static_cast<unsigned char>(c); byte < 0x80)
      latin += c;
    else
    {
      latin += static_cast<char>(0xc0U | byte >> 6U);
      latin += static_cast<char>(0x80U | (byte & 0x3fU));
    }
  return latin;
}

std::string folded(const std::string& name)
{
  std::string text;
  for (const char c : name)
    text += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c == '^' ? ' ' : c;
  return withoutPadding(text);
}

} // namespace

bool DicomCleaner::Person::differs(const Person& other) const
{
  const auto contradict = [](const std::string& a, const std::string& b)
  { return !a.empty() && !b.empty() && a != b; };
  return contradict(folded(name), folded(other.name)) || contradict(birthDate, other.birthDate);
}

DicomCleaner::DicomCleaner(const DeidentificationOptions& options, const PseudonymKey& key)
  : m_options(options)
  , m_key(key)
{
  OFLog::configure(OFLogger::OFF_LOG_LEVEL); // its messages hold values of attributes
  dcmEnableUnknownVRConversion.set(OFTrue);  // UN in place of a VR of the dictionary
  const bool isLoaded = dcmDataDict.rdlock().isDictionaryLoaded();
  dcmDataDict.rdunlock();
  if (!isLoaded)
    throw core::Error(core::Fault::Internal,
                      "the data dictionary of DCMTK is missing; install package libdcmtk17, and "
                      "unset DCMDICTPATH");
}

DicomCleaner::Outcome DicomCleaner::clean(const std::filesystem::path& input,
                                          const Placement& placed)
{
  auto file = std::make_unique<DcmFileFormat>();
  if (!imaging::canBeInflated(input) ||
      file->loadFile(input.c_str(), EXS_Unknown, EGL_noChange, DCM_MaxReadLength, ERM_autoDetect)
          .bad())
    return {"is not DICOM, or damaged", false};
  const std::string metaClass = valueOf(*file->getMetaInfo(), DCM_MediaStorageSOPClassUID);
  const std::vector<DcmTagKey> meta = replacedMeta(*file->getMetaInfo());
  std::unique_ptr<DcmDataset> dataSet(file->getAndRemoveDataset());
  file.reset(); // preamble and group 2 go with it
  if (metaClass == UID_MediaStorageDirectoryStorage)
    return {unsuitable(metaClass), true};
  const std::string sopClass = valueOf(*dataSet, DCM_SOPClassUID);
  if (sopClass.empty() || valueOf(*dataSet, DCM_SOPInstanceUID).empty())
    return {"is not DICOM, or damaged", false};
  if (std::string why = unsuitable(sopClass); !why.empty())
    return {why, true};
  const E_TransferSyntax syntax = dataSet->getOriginalXfer();

  const std::string burnedIn = valueOf(*dataSet, DCM_BurnedInAnnotation);
  const imaging::BurnedInText text = imaging::burnedInText(
      burnedIn, valueOf(*dataSet, DCM_Modality), valueOf(*dataSet, DCM_SOPClassUID),
      valueOf(*dataSet, DCM_ImageType), dataSet->tagExists(DCM_ConversionType));
  const bool states = text == imaging::BurnedInText::Stated;
  if (!m_options.keepBurnedIn && text != imaging::BurnedInText::None)
    return {states ? "has burned-in annotation" : "may have burned-in annotation", true};
  if (burnedIn != "NO" && dataSet->tagExists(DCM_PixelData))
    ++warnings[states ? "burned-in annotation is stated, and kept"
                      : "not stated to be free of burned-in annotation: look at the images"];
  const FaceSlices::File* face = faces ? faces->find(input) : nullptr;
  const bool isMasked = face && face->hasFace();
  const bool hasPixels = dataSet->tagExists(DCM_PixelData) ||
                         dataSet->tagExists(DCM_FloatPixelData) ||
                         dataSet->tagExists(DCM_DoubleFloatPixelData);
  if (faces && isOutlines(sopClass))
    return {"its contours or segments may be the skin of a face, which cannot be masked in them",
            true};
  if (faces && hasPixels)
  {
    if (!face && valueOf(*dataSet, DCM_Modality) != "RTDOSE")
      return {"its face cannot be masked: it is no slice of a CT or MR volume", true};
    if (face)
    {
      Sint32 frames = 1;
      dataSet->findAndGetSint32(DCM_NumberOfFrames, frames);
      frames = std::max(frames, Sint32{1});
      if (std::string why = unmaskable(*face, static_cast<std::size_t>(frames)); !why.empty())
        return {why, true};
      if (!isMasked)
        for (const std::string& finding : face->texts)
          ++warnings[finding];
    }
  }
  else if (coversAHead(*dataSet))
    ++warnings["slices wide enough for a whole head: a face can be recognised"];

  const std::string study = valueOf(*dataSet, DCM_StudyInstanceUID);
  const std::string series = valueOf(*dataSet, DCM_SeriesInstanceUID);
  const std::string characterSet = valueOf(*dataSet, DCM_SpecificCharacterSet);
  const std::string patientId = utf8Of(valueOf(*dataSet, DCM_PatientID), characterSet);
  const std::string patientName = utf8Of(valueOf(*dataSet, DCM_PatientName), characterSet);
  const std::string birthDate = valueOf(*dataSet, DCM_PatientBirthDate);
  const std::string newSeries = m_key.uid(series), newStudy = m_key.uid(study);

  FileCleaner cleaner(*this, m_options, m_key, *dataSet);
  cleaner.clean(*dataSet);
  ClearedPixels cleared;
  if (std::string why = cleanAllPixels(*dataSet, syntax, false, cleared); !why.empty())
    return {why, true};
  if (isMasked)
  {
    if (std::string why = maskFaceInPixels(*dataSet, *face); !why.empty())
      return {why, true};
    delete dataSet->remove(DCM_IconImageSequence); // a picture of the slice as it was
  }
  if (hasPreamble(input))
    cleaner.noteBeside("preamble", "", "cleared", false);
  for (const DcmTagKey& key : meta)
    cleaner.noteBeside(pathOf(key), dictionaryEntry(key).name,
                       "removed: file meta information is written anew", false);
  const std::string pixelData = pathOf(DCM_PixelData);
  if (cleared.hadBits)
    cleaner.noteBeside(pixelData, "PixelData",
                       "bits beside those stored cleared (overlays of old scanners)", false);
  if (cleared.hadPadding)
    cleaner.noteBeside(pixelData, "PixelData", "bytes after the last pixel cleared", false);
  if (cleared.hadText)
    cleaner.noteBeside(pixelData, "PixelData",
                       "comments, application segments and gaps of the compression cleared", false);
  for (const DcmTagKey& key : missingOfType2(*dataSet, sopClass))
    if (dataSet->insertEmptyElement(key).good())
      cleaner.noteBeside(pathOf(key), dictionaryEntry(key).name,
                         "added without a value, as the standard requires the attribute", false);
  putMethod(*dataSet, m_options, profile.edition(), isMasked);

  const std::string pseudonym = m_key.patient(cleaner.patient());
  const auto [known, isNew] = m_people.emplace(pseudonym, Person{patientName, birthDate});
  if (!isNew && known->second.differs({patientName, birthDate}))
    ++warnings["the Patient ID is that of earlier files, but name or birth date differ: one "
               "pseudonym may stand for two patients"];
  if (const std::string& first = m_patientOf.emplace(newSeries, pseudonym).first->second;
      first != pseudonym)
    ++warnings["of another patient, or of none, than earlier files of the same series, which has "
               "several pseudonyms now: look whose they are"];
  pseudonyms["patient " + pseudonym + " " + patientName] = {"patient", pseudonym,
                                                            patientId + " " + patientName};
  pseudonyms["study " + newStudy] = {"study", newStudy, study};
  pseudonyms["series " + newSeries] = {"series", newSeries, series};

  const std::filesystem::path target = placed(newSeries, valueOf(*dataSet, DCM_Modality));
  DcmFileFormat clean(dataSet.release(), OFFalse); // which owns it
  save(clean, syntax, target);
  return {};
}

} // namespace petrous::library
