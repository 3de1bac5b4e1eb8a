#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <map>
#include <sstream>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "../../Imaging/Testing/TestDicom.h"
#include "ConfidentialityProfile.h"
#include "ConfidentialityTable.h"
#include "DefinedTermsTable.h"
#include "PixelMetadata.h"
#include "Vocabulary.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/Deidentification.h"
#include "petrous/Library/OwnerLock.h"
#include "petrous/Library/PseudonymMap.h"

namespace petrous::library
{

namespace
{

namespace fs = std::filesystem;
using Dates = DeidentificationOptions::Dates;
using imaging::test::TemporaryFolder;
using imaging::test::TestSlice;

constexpr std::uint32_t kItem = 0xfffee000, kItemEnd = 0xfffee00d, kSequenceEnd = 0xfffee0dd;

/// Implicit VR little endian, as PS3.5 has it, written and read without any library.
std::string little(std::uint32_t value, int bytes)
{
  std::string out;
  for (int n = 0; n < bytes; ++n)
    out += static_cast<char>(value >> 8 * n & 0xffU);
  return out;
}

std::string tagBytes(std::uint32_t tag)
{
  return little(tag >> 16, 2) + little(tag & 0xffff, 2);
}

std::string element(std::uint32_t tag, std::string value)
{
  if (value.size() % 2 != 0)
    value += ' ';
  return tagBytes(tag) + little(static_cast<std::uint32_t>(value.size()), 4) + value;
}

std::string sequence(std::uint32_t tag, const std::string& item)
{
  return element(tag, tagBytes(kItem) + little(static_cast<std::uint32_t>(item.size()), 4) + item);
}

std::string unsignedShort(std::uint32_t tag, std::uint32_t value)
{
  return element(tag, little(value, 2));
}

/// "00080050" or "00081115/00080050" to value; sequences have the value "SQ".
using Elements = std::map<std::string, std::string>;

std::string hexOf(std::uint32_t tag)
{
  char text[9];
  std::snprintf(text, sizeof text, "%08x", tag);
  return text;
}

std::size_t parse(const std::string& bytes, std::size_t at, const std::string& path,
                  Elements& found)
{
  const auto number = [&bytes](std::size_t from, int count)
  {
    std::uint32_t value = 0;
    for (int n = count; n-- > 0;)
      value = value << 8 | static_cast<unsigned char>(bytes.at(from + n));
    return value;
  };
  while (at + 8 <= bytes.size())
  {
    const std::uint32_t tag = number(at, 2) << 16 | number(at + 2, 2), length = number(at + 4, 4);
    at += 8;
    if (tag == kItemEnd || tag == kSequenceEnd)
      return at;
    if (tag == kItem)
    {
      at = parse(bytes, at, path, found);
      continue;
    }
    if (length == 0xffffffff)
    {
      found[path + hexOf(tag)] = "SQ";
      at = parse(bytes, at, path + hexOf(tag) + "/", found);
      continue;
    }
    std::string value = bytes.substr(at, length);
    while (!value.empty() && (value.back() == ' ' || value.back() == '\0'))
      value.pop_back();
    found[path + hexOf(tag)] = value;
    at += length;
  }
  return at;
}

Elements elementsOf(const fs::path& file)
{
  const std::string bytes = core::readFile(file);
  EXPECT_EQ(bytes.substr(0, 132), std::string(128, '\0') + "DICM");
  std::uint32_t length = 0; // of group 2, which is explicit
  for (int n = 4; n-- > 0;)
    length = length << 8 | static_cast<unsigned char>(bytes.at(140 + n));
  Elements found;
  parse(bytes, 144 + length, "", found);
  return found;
}

struct Given
{
  std::string sopClass = "1.2.840.10008.5.1.4.1.1.2";
  std::string body;     ///< elements in any order
  std::string preamble; ///< up to 128 bytes
  std::string meta;     ///< explicit elements of group 2
  std::string trailer;
  std::string instance = "1.2.3.4.5";
  std::string pixels = std::string(32, '\1'); ///< of 4 x 4
  std::string modality = "CT";
  int bitsStored = 16;
};

void write(const fs::path& file, const Given& given)
{
  TestSlice meta;
  std::string group;
  meta.element(group, 0x00020010, "UI", "1.2.840.10008.1.2");
  std::string preamble = given.preamble;
  preamble.resize(128, '\0');
  fs::create_directories(file.parent_path());
  imaging::test::writeText(
      file, preamble + "DICM" + group + given.meta + element(0x00080016, given.sopClass) +
                element(0x00080018, given.instance) + element(0x00080060, given.modality) +
                given.body + element(0x0020000d, "1.2.3.8") + element(0x0020000e, "1.2.3.9") +
                unsignedShort(0x00280002, 1) + unsignedShort(0x00280010, 4) +
                unsignedShort(0x00280011, 4) + unsignedShort(0x00280100, 16) +
                unsignedShort(0x00280101, static_cast<std::uint32_t>(given.bitsStored)) +
                unsignedShort(0x00280102, static_cast<std::uint32_t>(given.bitsStored - 1)) +
                unsignedShort(0x00280103, 0) + element(0x7fe00010, given.pixels) + given.trailer);
}

Given withBody(const std::string& body)
{
  Given given;
  given.body = body;
  return given;
}

Given ofClass(const std::string& sopClass, const std::string& modality = "CT")
{
  Given given;
  given.sopClass = sopClass;
  given.modality = modality;
  return given;
}

DeidentificationOptions withDates(Dates dates)
{
  DeidentificationOptions options;
  options.dates = dates;
  return options;
}

struct TableRow
{
  std::uint32_t tag = 0;
  std::string action, name;
};

// Read by itself, not by ConfidentialityProfile.
std::vector<TableRow> tableRows()
{
  std::vector<TableRow> rows;
  std::istringstream table{std::string(kConfidentialityTable)};
  for (std::string line; std::getline(table, line);)
  {
    if (line.empty() || line[0] == '#')
      continue;
    std::istringstream columns(line);
    std::string tag, action, options, name;
    std::getline(columns, tag, '\t');
    std::getline(columns, action, '\t');
    std::getline(columns, options, '\t');
    std::getline(columns, name, '\t');
    if (tag == "odd")
      tag = "00091001";
    for (char& c : tag)
      c = c == 'x' ? '0' : c;
    rows.push_back({static_cast<std::uint32_t>(std::stoul(tag, nullptr, 16)), action, name});
  }
  return rows;
}

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool isSequence(const TableRow& row)
{
  return endsWith(row.name, "Sequence") || endsWith(row.name, "Sequence (Trial)");
}

bool isUid(const TableRow& row)
{
  return endsWith(row.name, "UID") || endsWith(row.name, "UIDs") || row.action == "U";
}

std::string planted(const TableRow& row, int n)
{
  if (isSequence(row))
    return sequence(row.tag, element(0x00080104, "PLANT" + std::to_string(n)) +
                                 element(0x00081155, "1.2.77." + std::to_string(n)));
  return element(row.tag, (isUid(row) ? "1.2.77." : "PLANT") + std::to_string(n));
}

class Deidentification : public ::testing::Test
{
protected:
  DeidentificationResult run(const DeidentificationOptions& options = {})
  {
    return deidentify(in, out, options, key);
  }

  Elements cleaned(const std::string& body, const DeidentificationOptions& options = {})
  {
    write(in / "a.dcm", withBody(body));
    fs::remove_all(out);
    report = run(options).report;
    return elementsOf(out / "series-001-CT" / "00001.dcm");
  }

  TemporaryFolder folder;
  fs::path in = folder.path() / "in", out = folder.path() / "out";
  PseudonymKey key;
  DeidentificationReport report;
};

} // namespace

TEST_F(Deidentification, TreatsEachAttributeOfTheTableAtTheTopNestedAndInPrivateSequences)
{
  const auto rows = tableRows();
  ASSERT_EQ(rows.size(), 621U);
  std::size_t right = 0;
  for (const std::string place : {"", "00081115/", "00081115/00081199/"})
  {
    std::string body;
    int n = 0;
    for (const TableRow& row : rows)
      if (++n, row.tag >> 16 >= 8 && row.tag != 0x0020000d && row.tag != 0x0020000e &&
                   row.tag != 0x00080018)
        body += planted(row, n);
    const std::string hidden = sequence(0x00091002, body);
    if (place.size() > 9)
      body = sequence(0x00081199, body);
    if (!place.empty())
      body = sequence(0x00081115, body);
    const Elements found = cleaned(element(0x00090010, "ACME") + body + hidden);
    n = 0;
    right = 0;
    for (const TableRow& row : rows)
    {
      ++n;
      const std::string path = (row.tag >> 16 < 8 || row.tag == 0x0020000d ||
                                row.tag == 0x0020000e || row.tag == 0x00080018)
                                   ? hexOf(row.tag)
                                   : place + hexOf(row.tag);
      if (row.tag >> 16 < 8)
      {
        right += found.count(path) == 0;
        continue; // of commands, file meta and directories: not in a data set
      }
      const bool stays = found.count(path) > 0;
      const std::string value = stays ? found.at(path) : "";
      bool isRight = value.find("PLANT") == std::string::npos &&
                     value.find("1.2.77") == std::string::npos && value != "1.2.3.8";
      const auto may = [&row](char code) { return row.action.find(code) != std::string::npos; };
      const bool isNewUid = value.rfind("2.25.", 0) == 0 || value == "SQ";
      isRight = isRight &&
                ((may('X') && !stays) || (may('Z') && stays && (value.empty() || value == "SQ")) ||
                 (may('D') && stays && !(value.empty() && row.tag != 0x0072006d && isUid(row))) ||
                 (may('U') && stays && isNewUid));
      right += isRight;
      EXPECT_TRUE(isRight) << path << " " << row.name << " " << row.action << " '" << value << "'";
    }
    EXPECT_EQ(right, 621U) << place;
    for (const auto& [path, value] : found)
      EXPECT_EQ(value.find("PLANT"), std::string::npos) << path;
  }
}

TEST_F(Deidentification, LeavesNoPlantedIdentifierInAnyByteThatIsWritten)
{
  std::vector<std::string> plants;
  const auto plant = [&plants]
  {
    plants.push_back("Zq" + std::to_string(1000 + plants.size()) + "kX");
    return plants.back();
  };
  Given given;
  given.preamble = plant();
  TestSlice meta;
  meta.element(given.meta, 0x00020016, "AE", plant());
  meta.element(given.meta, 0x00020017, "AE", plant());
  meta.element(given.meta, 0x00020100, "UI", "1.2.3");
  meta.element(given.meta, 0x00020102, "OB", plant());
  const std::vector<std::uint32_t> places{
      0x00080005, 0x00080008, 0x00080050, 0x00080070, 0x00080080, 0x00080081, 0x00080090,
      0x00081010, 0x00081030, 0x0008103e, 0x00081040, 0x00081048, 0x00081070, 0x00082111,
      0x00100010, 0x00100020, 0x00100030, 0x00100040, 0x00101000, 0x00101001, 0x00101010,
      0x00101040, 0x001021b0, 0x00104000, 0x00120010, 0x00180015, 0x00180050, 0x00181000,
      0x00181030, 0x00185100, 0x00200010, 0x00200013, 0x00204000, 0x00201002, 0x00284000,
      0x00321032, 0x00380300, 0x00400275, 0x00401400, 0x0040a160, 0x00880140, 0x04000550,
      0x20300020, 0x40080115, 0x50001001, 0x50003000, 0x60000022, 0x60001500, 0x60003000,
      0x60004000, 0x00081090, 0x00180024, 0x00181250, 0x00080104, 0x00690101, 0x0018a001,
      0x00880906};
  std::string body, inner;
  for (const std::uint32_t tag : places)
  {
    const bool isItems = tag == 0x00400275 || tag == 0x04000550 || tag == 0x0018a001;
    body += isItems ? sequence(tag, element(0x00400007, plant()) + element(0x00080080, plant()))
                    : element(tag, plant());
    if (!isItems)
      inner += element(tag, plant());
  }
  body += element(0x00181020, "1.0" + std::string(1, '\0') + plant()); // after a NUL
  body += element(0x00181210, "H30 ").substr(0, 12);
  body += element(0x00290010, plant()) + element(0x00291001, plant()) +
          sequence(0x00291002, element(0x00100010, plant()));
  body += sequence(0x00081115, sequence(0x00081199, sequence(0x00082218, inner)));
  given.body = body;
  given.trailer = element(0xfffcfffc, plant());
  given.pixels = std::string(32, '\1') + plant() + " ";
  given.instance = "1.2.777777.1";
  plants.emplace_back("1.2.777777");
  plants.emplace_back("1.2.3.8");
  plants.emplace_back("SMITH");
  write(in / "SMITH" / "SMITH.dcm", given);
  ASSERT_GE(plants.size(), 50U);
  for (const auto dates : {Dates::Remove, Dates::Shift, Dates::Keep})
  {
    fs::remove_all(out);
    DeidentificationOptions options{dates, true, false, false, true, false};
    const DeidentificationReport done = run(options).report;
    std::string all = done.text();
    for (const auto& entry : fs::recursive_directory_iterator(out))
      all += entry.path().filename().string() +
             (entry.is_regular_file() ? core::readFile(entry.path()) : "");
    for (const std::string& identifier : plants)
      EXPECT_EQ(all.find(identifier), std::string::npos) << identifier;
  }
}

TEST_F(Deidentification, KeepsDefinedTermsOnlyInCodedStrings)
{
  std::istringstream table{std::string(kDefinedTermsTable)};
  std::map<std::uint32_t, std::string> terms; // the first of each attribute
  for (std::string line; std::getline(table, line);)
    if (line[0] != '#' && line.compare(0, 4, "0004") != 0)
      terms[static_cast<std::uint32_t>(std::stoul(line, nullptr, 16))] =
          line.substr(9, line.find('|') - 9);
  ASSERT_GT(terms.size(), 300U);
  for (const std::uint32_t tag : {0x00180015, 0x00200020, 0x00700080, 0x0040a491, 0x00189073})
    terms[tag] = "";
  std::string names, kept;
  for (const auto& [tag, term] : terms)
  {
    // Modality; Conversion Type and Burned In Annotation: then the file is left out
    if (tag == 0x00080060 || tag == 0x00080064 || tag == 0x00280301)
      continue;
    names += element(tag, "LINDQVIST\\A ANDERSSON\\ZQ");
    kept += element(tag, term);
  }
  for (const auto dates : {Dates::Remove, Dates::Shift, Dates::Keep})
  {
    DeidentificationOptions options{dates, true, true, true, true, false};
    cleaned(names + sequence(0x00081115, names), options);
    const std::string bytes = core::readFile(out / "series-001-CT" / "00001.dcm");
    for (const char* name : {"LINDQVIST", "ANDERSSON", "ZQ"})
      EXPECT_EQ(bytes.find(name), std::string::npos) << name;
  }
  const Elements found = cleaned(kept);
  std::size_t same = 0, removed = 0;
  for (const auto& [tag, term] : terms)
    (found.count(hexOf(tag)) > 0 && found.at(hexOf(tag)) == term ? same : removed) += 1;
  EXPECT_LT(removed, 25U) << "only those that the table removes";
  EXPECT_EQ(
      cleaned(element(0x00080008, "ORIGINAL \\PRIMARY\\AXIAL\\CT_SOM5 SPI\\DOE")).at("00080008"),
      "ORIGINAL\\PRIMARY\\AXIAL\\CT_SOM5 SPI\\ANONYMIZED");
  EXPECT_EQ(cleaned(element(0x00180015, "TEMPORAL BONE")).at("00180015"), "TEMPORAL BONE");
  EXPECT_EQ(cleaned(element(0x00200020, "L\\PH")).at("00200020"), "L\\PH");
  EXPECT_EQ(cleaned(element(0x00080005, "LINDQVIST")).count("00080005"), 0U);
  EXPECT_EQ(cleaned(element(0x00080005, "ISO_IR 192")).at("00080005"), "ISO_IR 192");
}

TEST_F(Deidentification, KeepsOnlyValuesOfTheFormOfTheirVr)
{
  const std::string doubles = "LINDQVISTAURELIA"; // two of VR FD
  const std::string names = element(0x00180050, "LINDQVIST") + element(0x00180060, "EEEE") +
                            element(0x00200013, "4711\\LINDQVIST") +
                            element(0x00189306, "LINDQVIS") + element(0x00189310, doubles) +
                            element(0x00280106, "LINDQVIST ") + element(0x00280009, "LINDQVIS") +
                            element(0x00283002, "LINDQV") + element(0x00200032, "1\\2\\LINDQVIST") +
                            element(0x00080020, "LINDQVIST") + element(0x00080030, "LINDQVIST") +
                            element(0x0008002a, "LINDQVIST") + element(0x00080201, "LINDQVIST") +
                            element(0x00101010, "LINDQVIST") + element(0x00100040, "LINDQVIST") +
                            element(0x00101020, "LINDQVIST") + element(0x00180085, "LINDQVIST") +
                            element(0x00281054, "LINDQVIST") + element(0x00540081, "LINDQVIST ") +
                            element(0x60003000, "LINDQVIST ") + element(0x50003000, "LINDQVIST ") +
                            sequence(0xfffafffa, element(0x00180050, "LINDQVIST")) +
                            element(0x00420011, "LINDQVIST ") + element(0x00281221, "LINDQVIST ") +
                            sequence(0x00880200, element(0x00180050, "LINDQVIST"));
  for (const auto dates : {Dates::Remove, Dates::Shift, Dates::Keep})
  {
    const DeidentificationOptions options{dates, true, true, true, true, false};
    cleaned(names + sequence(0x00081115, names), options);
    const std::string bytes = core::readFile(out / "series-001-CT" / "00001.dcm");
    for (const char* name : {"LINDQV", "QVIST", "AURELIA", "EEEE"})
      EXPECT_EQ(bytes.find(name), std::string::npos) << name;
  }
  const std::string sound = element(0x00180050, "0.33333333333333331") +
                            element(0x00200013, " 12") + element(0x00200032, "-1.5e+02\\+2\\.5") +
                            element(0x00080030, "101112.123456");
  const Elements found = cleaned(sound, withDates(Dates::Keep));
  EXPECT_EQ(found.at("00180050"), "0.33333333333333331");
  EXPECT_EQ(found.at("00200032"), "-1.5e+02\\+2\\.5");
  EXPECT_EQ(found.at("00080030"), "101112.123456");
  EXPECT_EQ(found.count("00200013"), 1U);
}

TEST_F(Deidentification, KnowsThePatientsNumberAndANameThatIsAWordOfTheVocabulary)
{
  DeidentificationOptions options;
  options.cleanDescriptors = true;
  const std::string patient = element(0x00100010, "Sharp^Wu") + element(0x00100020, "4711471");
  const Elements found =
      cleaned(patient + element(0x0008103e, "SHARP head Wu") + element(0x00200013, "4711471") +
                  element(0x00180050, "0.5") +
                  sequence(0x00081140, element(0x00080100, "4711471") + element(0x00080102, "SCT") +
                                           element(0x0040a123, "Wu")),
              options);
  EXPECT_EQ(found.at("0008103e"), "head");
  EXPECT_EQ(found.at("00200013"), "");
  EXPECT_EQ(found.at("00180050"), "0.5");
  for (const auto& [path, value] : found)
  {
    EXPECT_EQ(value.find("4711471"), std::string::npos) << path;
    EXPECT_NE(value, "Wu") << path;
  }
}

TEST_F(Deidentification, KnowsThePatientsNumberInAnyFormOfANumber)
{
  const std::string patient = element(0x00100020, "4711471") +
                              element(0x00101000, "OTHER\\0815815") +
                              element(0x00080050, "943-476-919");
  for (const char* form : {" 4711471", "04711471", "+4711471", "-4711471", "815815", "943476919",
                           "4711471.0", "4.711471e6", "943476919.00"})
  {
    const bool isWhole = std::string(form).find_first_of(".e") == std::string::npos;
    const Elements found = cleaned(patient + element(0x00181150, isWhole ? form : "4711471") +
                                   element(0x00180050, form) + element(0x00200013, "471147"));
    EXPECT_EQ(found.at("00181150"), "") << form;
    EXPECT_EQ(found.at("00180050"), "") << form;
    EXPECT_EQ(found.at("00200013"), "471147") << form << ": another number";
  }
  const auto real = [](double value)
  {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
  };
  const Elements binary =
      cleaned(patient + element(0x00209057, little(4711471, 4)) +
              element(0x00209128, little(471147, 4)) + element(0x00189073, real(4711471.0)) +
              element(0x00189328, real(0.1)) + element(0x00189220, real(std::nan(""))));
  EXPECT_EQ(binary.count("00209057"), 0U);
  EXPECT_EQ(binary.count("00209128"), 1U);
  EXPECT_EQ(binary.count("00189073"), 0U);
  EXPECT_EQ(binary.count("00189328"), 1U);
  EXPECT_EQ(binary.count("00189220"), 1U) << "not a number is not the patient's";
  for (const char* id :
       {"MRN4711471", "MRN 4711471/A", "0815-X-4711471", "4711471-3", "2024/4711471",
        "2024/4711471-3", "X1.4711471.2", "471-14-71", "4711_471", "12 47 11 471 5"})
    EXPECT_EQ(cleaned(element(0x00100020, id) + element(0x00200013, "4711471")).at("00200013"), "")
        << id;
  EXPECT_EQ(cleaned(element(0x00100020, "00012") + element(0x00200013, "12")).at("00200013"), "12")
      << "a short number is that of anything";
}

TEST_F(Deidentification, KeepsNoTextInPlaceOfNumbers)
{
  for (const std::string name : {"O'Brien^Mary", "M\xfcller^Hans", "M\xc3\xbcller^H.", "J. R. Doe"})
  {
    const std::string text = (name + std::string(12, ' ')).substr(0, 12);
    const Elements found =
        cleaned(element(0x00100010, name) + element(0x00189328, text.substr(0, 8)) +
                element(0x00209157, text));
    EXPECT_EQ(found.count("00189328"), 0U) << name;
    EXPECT_EQ(found.count("00209157"), 0U) << name;
  }
  // Of Revolution Time, FD; none is a word of the file.
  for (const std::string text :
       {"Zq4711kw", "Zqkw4711", "Room 12 ", "M\xfcller  ", "M\xfcller 7", "M\xc3\xbcller ",
        "Jos\xc3\xa9 Ro", "Ward 12A", "Ward 12B", "Sr. Eva\xc3", "O'Neil7\0"})
  {
    const std::string eight = (text + std::string(8, '\0')).substr(0, 8);
    EXPECT_EQ(cleaned(element(0x00189305, eight)).count("00189305"), 0U) << text;
  }
  // Object Pixel Spacing in Center of Beam, FL
  for (const std::string text : {"Room 12 ", "WARD 12A", "M\xfcller 7"})
    EXPECT_EQ(cleaned(element(0x00189404, text)).count("00189404"), 0U) << text;
  // As numbers these are neither too large nor too small for an image: 'A' to 'C' end a double of
  // 2^17 to 2^63, 'D' to 'W' a float of 2^9 to 2^49.
  for (const char* const eight :
       {"KR\xdcGER H", "M\xdcLLER A", "GR\xd6SCH C", "B\xd6HM,RAA",
        "SCH\xc4"
        "FER,",
        "J\xd6RG A B", "GO\xd1I, AB", "NOV\xc1KOV\xc1", "\xa3UKASZ A", "M\xfcller A"})
    for (const std::uint32_t tag : {0x00189305U, 0x00189404U}) // FD, FL
    {
      const std::string name = tag == 0x00189305U ? "00189305" : "00189404";
      EXPECT_EQ(cleaned(element(0x00100010, "MUELLER^ANNA") + element(tag, eight)).count(name), 0U)
          << name << ": " << eight;
    }
  // A name of the patient's that is shorter than what is told by itself
  EXPECT_EQ(cleaned(element(0x00100010, "Wong^Li") + element(0x00209057, "Wong")).count("00209057"),
            0U);
}

TEST_F(Deidentification, KeepsRealNumbers)
{
  for (const double value : {0.0, 0.1, -0.6, 1.0 / 3.0, 2.0 / 3.0, 0.35, 0.7, 1.4, 127.724321, 1e-9,
                             6.123233995736766e-17, -2.5e-20, 299792458.0, 6.02e14, 123456.789})
  {
    std::string eight(sizeof value, '\0');
    std::memcpy(eight.data(), &value, sizeof value);
    EXPECT_EQ(cleaned(element(0x00189305, eight)).count("00189305"), 1U) << value;
    const float pair[] = {static_cast<float>(value), 0.4f};
    std::memcpy(eight.data(), pair, sizeof pair);
    EXPECT_EQ(cleaned(element(0x00189404, eight)).count("00189404"), 1U) << value;
  }
  // Letters, but no words: about 2e9 as a double, 10 to 120 as floats.
  for (const std::string text : {"aB\xe9\x42"
                                 "cD\xc0\x41",
                                 "qR\xb5\x41xN\xd7\x41"})
  {
    EXPECT_EQ(cleaned(element(0x00189305, text)).count("00189305"), 1U) << text;
    EXPECT_EQ(cleaned(element(0x00189404, text)).count("00189404"), 1U) << text;
  }
}

TEST_F(Deidentification, LeavesOutLookupTablesThatHoldMoreThanTheyState)
{
  write(in / "a.dcm", {});
  write(in / "b.dcm", withBody(element(0x00281101, little(2, 2) + little(0, 2) + little(16, 2)) +
                               element(0x00281201, little(1, 2) + little(2, 2) + "LINDQVIST ")));
  EXPECT_EQ(run().leftOut.size(), 1U);
}

TEST_F(Deidentification, ReplacesUidsConsistentlyAndKeepsThoseOfTheStandard)
{
  const Elements found =
      cleaned(sequence(0x00081140, element(0x00081150, "1.2.840.10008.5.1.4.1.1.2") +
                                       element(0x00081155, "1.2.3.4.5")));
  EXPECT_EQ(found.at("00081140/00081155"), found.at("00080018"));
  EXPECT_EQ(found.at("00081140/00081150"), "1.2.840.10008.5.1.4.1.1.2");
  EXPECT_EQ(found.at("00080018"), key.uid("1.2.3.4.5"));
  EXPECT_EQ(found.at("0020000d"), key.uid("1.2.3.8"));
}

TEST_F(Deidentification, StatesItsMethod)
{
  Elements found = cleaned("");
  EXPECT_EQ(found.at("00120062"), "YES");
  EXPECT_NE(found.at("00120063").find("E.1-1"), std::string::npos);
  EXPECT_EQ(found.at("00120064/00080100"), "113100");
  EXPECT_EQ(found.at("00280303"), "REMOVED");
  found = cleaned("", withDates(Dates::Shift));
  EXPECT_EQ(found.at("00120064/00080100"), "113107") << "the last of its items";
  EXPECT_EQ(found.at("00280303"), "MODIFIED");
  EXPECT_EQ(cleaned("", withDates(Dates::Keep)).at("00280303"), "UNMODIFIED");
}

TEST_F(Deidentification, ShiftsAllDatesOfAPatientByTheSameDays)
{
  const std::string body = element(0x00080020, "20240301") + element(0x00080021, "20240229") +
                           element(0x00080030, "101112.5") + element(0x0008002a, "20240301101112") +
                           element(0x00100020, "4711");
  const Elements found = cleaned(body, withDates(Dates::Shift));
  const std::string day = found.at("00080020");
  ASSERT_EQ(day.size(), 8U);
  EXPECT_LT(day, "20240301");
  EXPECT_EQ(found.at("0008002a"), day + "101112");
  EXPECT_EQ(found.at("00080030"), "101112.5");
  EXPECT_NE(found.at("00080021"), day);
  EXPECT_EQ(found.at("00100020"), key.patient("4711"));
  EXPECT_EQ(cleaned(body, withDates(Dates::Keep)).at("00080020"), "20240301");
  EXPECT_EQ(cleaned(body).at("00080020"), "");
  EXPECT_EQ(cleaned(element(0x00080020, "1.3.2024 Doe"), withDates(Dates::Shift)).at("00080020"),
            "19000101");
}

TEST_F(Deidentification, KeepsSafePrivateAttributesOnlyOnRequest)
{
  const std::string body = element(0x00190010, "SIEMENS MR HEADER") + element(0x0019100c, "1000") +
                           element(0x00191008, "Doe") + element(0x00290010, "SIEMENS CSA HEADER") +
                           element(0x00291010, "Doe");
  const Elements none = cleaned(body);
  for (const char* tag : {"00190010", "0019100c", "00191008", "00290010", "00291010"})
    EXPECT_EQ(none.count(tag), 0U) << tag;
  DeidentificationOptions options;
  options.retainSafePrivate = true;
  const Elements safe = cleaned(body, options);
  EXPECT_EQ(safe.at("0019100c"), "1000");
  EXPECT_EQ(safe.at("00190010"), "SIEMENS MR HEADER");
  for (const char* tag : {"00191008", "00290010", "00291010"})
    EXPECT_EQ(safe.count(tag), 0U) << tag;
  // Without a VR in the file, as private attributes are in implicit VR: UN to most readers.
  const std::string reals = element(0x20050010, "Philips MR Imaging DD 001"); // (2005,xx0d): FL
  const auto stays = [&](const std::string& value)
  {
    return cleaned(element(0x00100020, "4711471") + element(0x00100010, "M\xfcller^Hans") + reals +
                       element(0x2005100d, value),
                   options)
               .count("2005100d") == 1;
  };
  const auto single = [](float value)
  {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
  };
  EXPECT_TRUE(stays(single(1.5f)));
  EXPECT_TRUE(stays(single(0.1f) + single(-3e-5f)));
  EXPECT_FALSE(stays(single(4711471.0f)));
  EXPECT_FALSE(stays("M\xfcller  "));
  EXPECT_FALSE(stays("M\xfcllerin"));
  EXPECT_FALSE(stays("Doe Jane"));
  EXPECT_FALSE(stays(std::string("Hans\0\0\0\0", 8)));
}

TEST_F(Deidentification, ReducesDescriptionsToTheVocabulary)
{
  const std::string body = element(0x0008103e, "CT temporal bone Jane Doe 0.6 mm") +
                           element(0x00181000, "SN4711") + element(0x00100040, "F");
  EXPECT_EQ(cleaned(body).count("0008103e"), 0U);
  DeidentificationOptions options;
  options.cleanDescriptors = options.retainDevice = options.retainPatientCharacteristics = true;
  const Elements found = cleaned(body, options);
  EXPECT_EQ(found.at("0008103e"), "CT temporal bone 0 6 mm");
  EXPECT_EQ(found.at("00181000"), "SN4711");
  EXPECT_EQ(found.at("00100040"), "F");
}

TEST(Vocabulary, KeepsNoNumbersThatStandTogether)
{
  IdentityWords people;
  people.addName("Sharp^Max");
  people.addIdentifier("943 476 919");
  EXPECT_EQ(reducedToVocabulary("HEAD 943 476 919", people), "HEAD");
  EXPECT_EQ(reducedToVocabulary("HEAD Max Sharp 14 03 62", people), "HEAD");
  EXPECT_EQ(reducedToVocabulary("EAR 14.03.62", people), "EAR");
  EXPECT_EQ(reducedToVocabulary("EAR 14/3", people), "EAR");
  EXPECT_EQ(reducedToVocabulary("AXIAL 3 MM", people), "AXIAL 3 MM");
}

TEST(Vocabulary, KeepsWhatNegatesTheRest)
{
  IdentityWords people;
  people.addName("Doe^Jane");
  for (const char* text : {"TUMOR NOT RESECTED", "NO TUMOR", "TUMOR NICHT LINKS"})
    EXPECT_EQ(reducedToVocabulary(text, people), text);
  EXPECT_EQ(reducedToVocabulary("Doe TUMOR not resected", people), "TUMOR not resected");
}

// Structures as TotalSegmentator, 3D Slicer and SNOMED CT name them.
TEST(Vocabulary, KnowsTheAnatomyOfTheTemporalBone)
{
  const char* const names[] = {"Cochlea",
                               "Vestibule",
                               "Labyrinth inner ear",
                               "Lateral semicircular canal",
                               "Superior semicircular canal",
                               "Posterior semicircular canal",
                               "Auditory ossicles",
                               "Malleus",
                               "Incus",
                               "Stapes",
                               "Incudostapedial joint",
                               "Sigmoid sinus",
                               "Transverse sinus",
                               "Superior petrosal sinus",
                               "Jugular bulb",
                               "Internal jugular vein",
                               "Internal carotid artery",
                               "Common carotid artery",
                               "Facial nerve",
                               "Geniculate ganglion",
                               "Chorda tympani",
                               "Greater superficial petrosal nerve",
                               "Vestibulocochlear nerve",
                               "Cochlear nerve",
                               "Glossopharyngeal nerve",
                               "Vagus nerve",
                               "Accessory nerve",
                               "Hypoglossal canal",
                               "Trigeminal nerve",
                               "Tegmen tympani",
                               "Dura mater",
                               "Middle cranial fossa",
                               "EAC",
                               "IAC",
                               "External auditory canal",
                               "Internal acoustic meatus",
                               "Endolymphatic sac",
                               "Endolymphatic duct",
                               "Vestibular aqueduct",
                               "Cochlear aqueduct",
                               "Tympanic membrane",
                               "Round window",
                               "Oval window",
                               "Basal turn",
                               "Modiolus",
                               "Scala tympani",
                               "Scala vestibuli",
                               "Promontory",
                               "Stapedius muscle",
                               "Tensor tympani muscle",
                               "Eustachian tube",
                               "Auricle",
                               "Scutum",
                               "Mastoid antrum",
                               "Aditus",
                               "Attic",
                               "Epitympanum",
                               "Facial recess",
                               "Pyramidal eminence",
                               "Arcuate eminence",
                               "Cochleariform process",
                               "Subarcuate artery",
                               "Styloid process",
                               "Stylomastoid foramen",
                               "Mastoid air cells",
                               "Petrous apex",
                               "Clivus",
                               "Zygomatic arch",
                               "Parotid gland",
                               "TMJ",
                               "Mandible",
                               "Brainstem",
                               "Cerebellum",
                               "Cerebrospinal fluid",
                               "Cochlear implant",
                               "Vestibular schwannoma",
                               "Glomus tumor"};
  for (const char* name : names)
  {
    std::istringstream words(name);
    for (std::string word; words >> word;)
      EXPECT_TRUE(isDescriptorWord(word)) << word << " of " << name;
  }
  for (const char* surname : {"Hammer", "Henle", "Koerner", "Pons", "Burr", "Meier"})
    EXPECT_FALSE(isDescriptorWord(surname)) << surname;
}

TEST_F(Deidentification, FindsTheNameInTextThatWouldStay)
{
  const std::string body = element(0x00100010, "Lindqvist^Aurelia") +
                           element(0x00180024, "se_Lindqvist") +
                           element(0x00181250, "HEAD AURELIA");
  const Elements found = cleaned(body);
  EXPECT_EQ(found.at("00180024"), "se");
  EXPECT_EQ(cleaned(element(0x00181210, "Br64h\\3")).at("00181210"), "Br64h\\3");
  EXPECT_EQ(found.at("00181250"), "HEAD");
}

TEST_F(Deidentification, LeavesOutWhatItCannotClean)
{
  write(in / "a.dcm", {});
  write(in / "b.dcm", withBody(element(0x00280301, "YES")));
  write(in / "c.dcm", ofClass("1.2.3.4.99"));
  write(in / "d.dcm", ofClass("1.2.840.10008.5.1.4.1.1.104.1"));
  write(in / "e.dcm", ofClass("1.2.840.10008.5.1.4.1.1.7", "OT"));
  imaging::test::writeText(in / "notes.txt", "Jane Doe");
  Given frames = withBody(element(0x00280008, "1A")); // of two
  frames.pixels = std::string(64, '\1');
  write(in / "f.dcm", frames);
  const DeidentificationResult done = run();
  EXPECT_EQ(done.report.filesWritten, 1U);
  EXPECT_EQ(done.leftOut.size(), 6U);
  EXPECT_EQ(done.report.text().find("notes"), std::string::npos);
  EXPECT_EQ(done.report.leftOut.at("has burned-in annotation"), 1U);
}

TEST_F(Deidentification, WarnsOfAWholeHead)
{
  const std::string head = "slices wide enough for a whole head: a face can be recognised";
  cleaned(element(0x00280030, "60\\60")); // 4 x 4 pixels
  EXPECT_EQ(report.warnings.count(head), 1U);
  cleaned(element(0x00280030, "20\\20"));
  EXPECT_EQ(report.warnings.count(head), 0U);
}

TEST_F(Deidentification, LeavesNothingWhereItIsCancelledOrRefused)
{
  write(in / "a.dcm", {});
  EXPECT_THROW(deidentify(in, in / "out", {}, key), core::Error);
  const auto token = std::make_shared<core::CancelToken>();
  const core::Progress progress([&token](double, const std::string&) { token->cancel(); }, token);
  write(in / "b.dcm", {});
  EXPECT_THROW(deidentify(in, out, {}, key, progress), core::CancelledError);
  EXPECT_THROW(deidentify(in / "a.dcm", in / "a.dcm", {}, key), core::Error);
  imaging::test::writeText(folder.path() / "t" / "x.txt", "Jane");
  EXPECT_THROW(deidentify(folder.path() / "t", out, {}, key), core::Error);
  EXPECT_FALSE(fs::exists(out));
}

TEST_F(Deidentification, KeepsVoxelsAndClearsWhatLiesBesideThem)
{
  Given given;
  given.bitsStored = 12;
  given.pixels.clear();
  for (std::uint32_t n = 0; n < 16; ++n)
    given.pixels += little(n * 100 | 0x8000U, 2); // an overlay in bit 15
  write(in / "a.dcm", given);
  run();
  std::string expected;
  for (std::uint32_t n = 0; n < 16; ++n)
    expected += little(n * 100, 2);
  std::string pixels = elementsOf(out / "series-001-CT" / "00001.dcm").at("7fe00010");
  pixels.resize(32, '\0');
  EXPECT_EQ(pixels, expected);
}

TEST(PixelMetadata, ClearsCommentsAndWhatFollowsTheImage)
{
  const auto clear = [](const std::string& text, bool& sound)
  {
    std::vector<std::uint8_t> bytes(text.begin(), text.end());
    sound = clearCodestreamMetadata(bytes.data(), bytes.size());
    return std::string(bytes.begin(), bytes.end());
  };
  bool sound = false;
  const std::string scan = std::string("\xff\xda\0\x03x", 5) + "pixels\xff" + std::string(1, '\0');
  std::string jpeg = "\xff\xd8stray" + std::string("\xff\xf0\0\x06jpg0", 8) +
                     std::string("\xff\xfe\0\x06name", 8) +
                     std::string("\xff\xe1\0\x06"
                                 "exif",
                                 8) +
                     scan + "\xff\xd9 trailing";
  std::string cleared = clear(jpeg, sound);
  EXPECT_TRUE(sound);
  EXPECT_EQ(cleared.size(), jpeg.size());
  for (const char* gone : {"name", "exif", "stray", "jpg0", "trailing"})
    EXPECT_EQ(cleared.find(gone), std::string::npos) << gone;
  EXPECT_NE(cleared.find("pixels"), std::string::npos);

  const std::string tile = std::string("\xff\x90\0\x0a\0\0\0\0\0\0\0\x01", 12) + "\xff\x93 data";
  std::string wavelet =
      "\xff\x4f" + std::string("\xff\x64\0\x08\0\x01name", 10) + tile + "\xff\xd9 trailing";
  cleared = clear(wavelet, sound);
  EXPECT_TRUE(sound);
  EXPECT_EQ(cleared.find("name"), std::string::npos);
  EXPECT_EQ(cleared.find("trailing"), std::string::npos);
  EXPECT_NE(cleared.find("data"), std::string::npos);
  clear("MPEG stream", sound);
  EXPECT_FALSE(sound);

  std::string rle =
      little(1, 4) + little(64, 4) + std::string(56, 'n') + std::string("\x03pixl") + "name";
  std::vector<std::uint8_t> bytes(rle.begin(), rle.end());
  bool hadBits = false;
  EXPECT_TRUE(clearRleMetadata(bytes.data(), bytes.size(), 4, {8, 8, 7, false}, hadBits));
  EXPECT_FALSE(hadBits);
  rle.assign(bytes.begin(), bytes.end());
  EXPECT_EQ(rle.find('n'), std::string::npos);
  EXPECT_NE(rle.find("pixl"), std::string::npos);
}

namespace
{

/// An explicit VR little endian file of 4 x 4 pixels; `body`: elements in any order.
TestSlice explicitSlice(const std::string& body)
{
  TestSlice slice;
  slice.columns = slice.rows = 4;
  slice.extra = body;
  return slice;
}

std::string explicitElement(std::uint32_t tag, const char* vr, const std::string& value)
{
  std::string out;
  TestSlice().element(out, tag, vr, value);
  return out;
}

/// VR UN of undefined length, whose content is implicit (PS3.5 6.2.2 note 2).
std::string unknownItems(std::uint32_t tag, const std::string& item)
{
  const auto undefined = little(0xffffffff, 4);
  return tagBytes(tag) + "UN" + little(0, 2) + undefined + tagBytes(kItem) + undefined + item +
         tagBytes(kItemEnd) + little(0, 4) + tagBytes(kSequenceEnd) + little(0, 4);
}

std::string allBytesBelow(const fs::path& folder)
{
  std::string all;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      all += core::readFile(entry.path());
  return all;
}

DeidentificationOptions allRetained(Dates dates)
{
  return {dates, true, true, true, true, false};
}

} // namespace

TEST(PixelMetadata, ClearsTheBitsBesideTheSampleAndNoOthers)
{
  for (const int allocated : {8, 16, 32})
    for (const int stored : {1, 5, 7, allocated - 4, allocated - 1})
      for (const int high : {stored - 1, allocated - 1})
      {
        const StoredBits bits{allocated, stored, high, false};
        const std::uint64_t mask = ((std::uint64_t{1} << stored) - 1) << (high + 1 - stored);
        std::vector<std::uint8_t> bytes;
        std::vector<std::uint64_t> values;
        for (std::uint64_t n = 0; n < 64; ++n)
        {
          values.push_back(n * 0x9e3779b97f4a7c15 >> (64 - allocated));
          for (int b = 0; b < allocated; b += 8)
            bytes.push_back(static_cast<std::uint8_t>(values.back() >> b));
        }
        ASSERT_TRUE(isClearable(bits));
        EXPECT_TRUE(clearUnusedBits(bytes.data(), values.size(), bits));
        for (std::size_t n = 0; n < values.size(); ++n)
        {
          std::uint64_t cell = 0;
          for (int b = allocated - 8; b >= 0; b -= 8)
            cell = cell << 8 | bytes[n * static_cast<std::size_t>(allocated) / 8 +
                                     static_cast<std::size_t>(b) / 8];
          EXPECT_EQ(cell, values[n] & mask) << allocated << ", " << stored << ", " << high;
        }
        EXPECT_FALSE(clearUnusedBits(bytes.data(), values.size(), bits));
      }
  EXPECT_FALSE(isClearable({24, 12, 11, false}));
  EXPECT_FALSE(isClearable({16, 12, 16, false}));
  // Signed samples of 12 bits: extended, they stay; where one is not, none says anything.
  std::vector<std::uint8_t> extended{0xff, 0xff, 0x05, 0x00}, mixed{0xff, 0xff, 0x05, 0x10};
  const std::vector<std::uint8_t> before = extended;
  EXPECT_FALSE(clearUnusedBits(extended.data(), 2, {16, 12, 11, true}));
  EXPECT_EQ(extended, before);
  EXPECT_TRUE(clearUnusedBits(mixed.data(), 2, {16, 12, 11, true}));
  EXPECT_EQ(mixed, (std::vector<std::uint8_t>{0xff, 0x0f, 0x05, 0x00}));
}

TEST(PixelMetadata, ClearsTheBitsBesideTheSampleInRle)
{
  // Two segments of 4 pixels: the high bytes as literals, the low ones as a run.
  std::string rle = little(2, 4) + little(64, 4) + little(70, 4) + std::string(52, '\0') +
                    std::string("\x03\xf1\xe2\x03\x84", 5) + std::string(1, '\0') +
                    std::string("\xfd\x77", 2);
  std::vector<std::uint8_t> bytes(rle.begin(), rle.end());
  bool hadBits = false;
  ASSERT_TRUE(clearRleMetadata(bytes.data(), bytes.size(), 4, {16, 12, 11, false}, hadBits));
  EXPECT_TRUE(hadBits);
  EXPECT_EQ(std::string(bytes.begin() + 64, bytes.begin() + 72),
            std::string("\x03\x01\x02\x03\x04\0\xfd\x77", 8));
}

TEST(PixelMetadata, ReadsThePrecisionOfACodestream)
{
  const std::string jpeg = std::string("\xff\xd8\xff\xfe\0\x04zy\xff\xc3\0\x0b\x0c", 13);
  const std::string wavelet =
      "\xff\x4f\xff\x51" + std::string(36, '\0') + std::string("\0\x02\x07\1\1\x8b\1\1", 8);
  const auto precision = [](const std::string& text)
  { return codestreamPrecision(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()); };
  EXPECT_EQ(precision(jpeg), 12);
  EXPECT_EQ(precision(wavelet), 12);
  EXPECT_EQ(precision("\xff\xd8 no frame header"), 0);
}

TEST_F(Deidentification, ClearsOverlaysInUnusedBitsOfEightAndThirtyTwo)
{
  const auto cleanedPixels = [this](TestSlice slice)
  {
    slice.slope.reset();
    slice.write(in / "a.dcm");
    fs::remove_all(out);
    report = run().report;
    return core::readFile(out / "series-001-CT" / "00001.dcm");
  };
  TestSlice eight = explicitSlice("");
  eight.bitsAllocated = 8;
  eight.bitsStored = 6;
  eight.isSigned = false;
  eight.cell = [](int i, int j) { return static_cast<std::uint32_t>(i + 4 * j) | 0xc0U; };
  std::string bytes = cleanedPixels(eight);
  for (std::size_t n = 0; n < 16; ++n)
    EXPECT_EQ(bytes[bytes.size() - 16 + n], static_cast<char>(n));
  EXPECT_NE(report.text().find("(7fe0,0010) PixelData: bits beside those stored cleared"),
            std::string::npos);
  TestSlice wide = explicitSlice("");
  wide.bitsAllocated = 32;
  wide.bitsStored = 24;
  wide.isSigned = false;
  wide.cell = [](int, int) { return 0x4a001234U; }; // J
  bytes = cleanedPixels(wide);
  EXPECT_EQ(bytes.substr(bytes.size() - 64, 4), little(0x1234, 4));
  eight.bitsStored = 8;
  cleanedPixels(eight);
  EXPECT_EQ(report.text().find("bits beside"), std::string::npos);
}

TEST_F(Deidentification, LooksIntoSequencesOfUnknownVr)
{
  const std::string plants = element(0x00100010, "LINDQVIST") + element(0x00081030, "LINDQVIST") +
                             element(0x00181030, "LINDQVIST") + element(0x00400007, "LINDQVIST");
  const std::string item =
      tagBytes(kItem) + little(static_cast<std::uint32_t>(plants.size()), 4) + plants;
  std::string body;
  for (const std::uint32_t tag :
       {0x00081032, 0x00081115, 0x00081140, 0x00091010, 0x00400275, 0x00081030, 0x00081090,
        0x00100010, 0x00180050, 0x00181150, 0x00200052, 0x00541001, 0x7fe10010})
    body += unknownItems(static_cast<std::uint32_t>(tag), plants);
  for (const std::uint32_t tag :
       {0x00082112, 0x00089215, 0x00400260, 0x00090011, 0x00081010, 0x00181020, 0x00189004})
    body += explicitElement(static_cast<std::uint32_t>(tag), "UN", item);
  explicitSlice(body).write(in / "a.dcm");
  for (const auto dates : {Dates::Remove, Dates::Shift, Dates::Keep})
  {
    fs::remove_all(out);
    const DeidentificationResult done = deidentify(in, out, allRetained(dates), key);
    EXPECT_EQ(allBytesBelow(out).find("LINDQVIST"), std::string::npos);
    EXPECT_NE(done.report.text().find("(0008,1115)/(0010,0010)"), std::string::npos)
        << "the items of UN were not looked into";
    EXPECT_NE(done.report.text().find("(0008,2112)/(0010,0010)"), std::string::npos);
    EXPECT_NE(done.report.text().find("(0008,1030) StudyDescription: removed"), std::string::npos);
  }
}

TEST_F(Deidentification, KeepsNoTextOfOtherCharacterSets)
{
  // A name in Latin-1, UTF-8 in both cases, JIS X 0208 by escape sequences, GB18030 (whose second
  // bytes are ASCII letters).
  const std::vector<std::string> names{"M\xfcLLER", "m\xc3\xbcller", "M\xc3\x9cLLER",
                                       "\x1b$B;3ED\x1b(B", "\x81\x41\x82\x42"};
  const std::vector<std::string> sets{"ISO_IR 100", "ISO_IR 192", "\\ISO 2022 IR 87", "GB18030"};
  for (const std::string& set : sets)
    for (const std::string& name : names)
    {
      std::string body = element(0x00080005, set) + element(0x00100010, "M\xc3\xbcller^Hans");
      for (const std::uint32_t tag :
           {0x00081010, 0x00081030, 0x0008103e, 0x00081090, 0x00180024, 0x00181000, 0x00181020,
            0x00181160, 0x00181210, 0x00181250, 0x00181030, 0x00102110, 0x00204000, 0x00280303})
        body += element(static_cast<std::uint32_t>(tag), "HEAD " + name);
      write(in / "a.dcm", withBody(body));
      for (const auto dates : {Dates::Remove, Dates::Keep})
      {
        fs::remove_all(out);
        deidentify(in, out, allRetained(dates), key);
        EXPECT_EQ(allBytesBelow(out).find(name), std::string::npos) << set << " " << name;
      }
    }
}

TEST_F(Deidentification, KeepsNoBytesAfterTheLastWholeNumber)
{
  const std::string body = tagBytes(0x00280009 + 0x3000000) + // not in the dictionary
                           little(8, 4) + "LINDQVIS" + tagBytes(0x00189310) + little(15, 4) +
                           std::string(8, '\1') + "QVISTAU" + tagBytes(0x00280106) + little(3, 4) +
                           "\1\2Z" + tagBytes(0x00189306) + little(13, 4) + std::string(8, '\2') +
                           "VISTA";
  write(in / "a.dcm", withBody(body));
  run();
  const std::string bytes = allBytesBelow(out);
  for (const char* rest : {"LINDQ", "QVISTAU", "\1\2Z", "VISTA"})
    EXPECT_EQ(bytes.find(rest), std::string::npos) << rest;
}

TEST_F(Deidentification, ReportsWhatWasDoneBesideTheDataSet)
{
  Given given;
  given.preamble = "Zq4711kX";
  TestSlice meta;
  for (const std::uint32_t tag : {0x00020016, 0x00020017, 0x00020018})
    meta.element(given.meta, static_cast<std::uint32_t>(tag), "AE", "Zq4712kX");
  meta.element(given.meta, 0x00020100, "UI", "1.2.77125");
  meta.element(given.meta, 0x00020102, "OB", "Zq4713kX");
  given.body = element(0x00080000, "Zq4X") + element(0x00100000, "ZqWX") +
               element(0x00080005, "Zq4714kX") + element(0x60000010, "Zq") +
               element(0x60003000, "Zq4715kX") + element(0x601e3000, "Zq4716kX") +
               element(0x50003000, "Zq4717kX") +
               sequence(0x00880200, element(0x00081030, "Zq4718kX") + unsignedShort(0x00280010, 2) +
                                        element(0x7fe00010, "Zq4719kX"));
  given.trailer = element(0xfffcfffc, "Zq4720kX");
  write(in / "a.dcm", given);
  const std::string text = run().report.text();
  const std::string bytes = allBytesBelow(out);
  for (const char* plant : {"Zq47", "Zq4X", "ZqWX", "1.2.77125"})
    EXPECT_EQ(bytes.find(plant), std::string::npos) << plant;
  for (const char* line :
       {"\npreamble : cleared", "(0002,0016)", "(0002,0017)", "(0002,0018)", "(0002,0100)",
        "(0002,0102)", "(0008,0000)", "(0010,0000)", "(0008,0005)", "(6000,3000)", "(601e,3000)",
        "(5000,3000)", "(0088,0200)", "(fffc,fffc)"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
}

// PS3.3 lets an attribute of type 2 be empty, not absent.
TEST_F(Deidentification, AddsWhatTheStandardRequiresWithoutAValue)
{
  constexpr std::uint32_t kPatientSex = 0x00100040, kKvp = 0x00180060, kLaterality = 0x00200060,
                          kImageLaterality = 0x00200062, kEchoTime = 0x00180081;
  Elements found = cleaned(element(0x00180050, "0.6") + element(0x00185100, "HFS"));
  EXPECT_EQ(found.at("00180050"), "0.6");
  EXPECT_EQ(found.at("00185100"), "HFS");
  for (const std::uint32_t tag : {kPatientSex, kKvp, kLaterality})
  {
    ASSERT_EQ(found.count(hexOf(tag)), 1U) << hexOf(tag);
    EXPECT_EQ(found.at(hexOf(tag)), "") << hexOf(tag);
  }
  EXPECT_EQ(found.count(hexOf(kEchoTime)), 0U) << "of an MR";
  EXPECT_NE(report.text().find("(0018,0060) KVP: added without a value"), std::string::npos);
  EXPECT_EQ(report.text().find("(0018,5100) PatientPosition: added"), std::string::npos);

  found = cleaned(element(0x00180015, "HEAD"));
  EXPECT_EQ(found.count(hexOf(kLaterality)), 0U) << "a head is no pair";

  found = cleaned(element(kImageLaterality, "L"));
  EXPECT_EQ(found.at(hexOf(kImageLaterality)), "L");
  EXPECT_EQ(found.count(hexOf(kLaterality)), 0U) << "one of the two only";
}

TEST_F(Deidentification, ClearsCommentsThatBeginInOneFragmentAndEndInAnother)
{
  const std::string image =
      std::string("\xff\xda\0\x03x", 5) + "pixels\xff" + std::string(1, '\0') + "\xff\xd9";
  std::string codestream = std::string("\xff\xd8\xff\xc3\0\x0b\x10\0\4\0\4\1\1\x11\0", 15) +
                           std::string("\xff\xfe\0\x12LINDQVIST AURELI", 20) + image;
  codestream.resize(codestream.size() + codestream.size() % 2, '\0');
  const auto fragment = [](const std::string& bytes)
  { return tagBytes(kItem) + little(static_cast<std::uint32_t>(bytes.size()), 4) + bytes; };
  TestSlice slice = explicitSlice("");
  slice.syntax = "1.2.840.10008.1.2.4.70";
  slice.pixels = false;
  std::string file = slice.bytes();
  file += tagBytes(0x7fe00010) + "OB" + little(0, 2) + little(0xffffffff, 4) + fragment("AURE") +
          fragment(codestream.substr(0, 24)) + fragment(codestream.substr(24)) +
          tagBytes(kSequenceEnd) + little(0, 4);
  imaging::test::writeText(in / "a.dcm", file);
  const std::string text = run().report.text();
  const std::string bytes = allBytesBelow(out);
  for (const char* plant : {"LIND", "QVIST", "AURE"})
    EXPECT_EQ(bytes.find(plant), std::string::npos) << plant;
  EXPECT_NE(bytes.find("pixels"), std::string::npos);
  EXPECT_NE(text.find("comments, application segments"), std::string::npos);
}

TEST_F(Deidentification, LeavesOutDocumentsAndCleansWhatIsNoImage)
{
  const std::string text =
      element(0x0040a040, "TEXT") + element(0x0040a160, "Aurelia Lindqvist, born 1931");
  const std::string content =
      sequence(0x0040a730, text + sequence(0x0040a730, text + element(0x0040a123, "LINDQVIST")));
  const std::string body = element(0x00100010, "LINDQVIST^AURELIA") + content;
  struct Kind
  {
    const char* sopClass;
    const char* modality;
    const char* why; ///< empty: cleaned
  };
  int n = 0;
  write(in / "image.dcm", withBody(body));
  const std::vector<Kind> kinds{{"1.2.840.10008.5.1.4.1.1.88.11", "SR", "structured document"},
                                {"1.2.840.10008.5.1.4.1.1.88.33", "SR", "structured document"},
                                {"1.2.840.10008.5.1.4.1.1.88.59", "KO", "structured document"},
                                {"1.2.840.10008.5.1.4.1.1.88.67", "SR", "structured document"},
                                {"1.2.840.10008.5.1.4.1.1.104.1", "DOC", "encapsulated document"},
                                {"1.2.840.10008.5.1.4.1.1.104.2", "DOC", "encapsulated document"},
                                {"1.2.840.10008.5.1.4.1.1.66", "OT", "raw data"},
                                {"1.2.840.10008.5.1.4.1.1.9.1.1", "ECG", "waveform"},
                                {"1.2.840.10008.5.1.4.1.1.9.4.1", "AU", "waveform"},
                                {"1.2.840.10008.5.1.4.1.1.481.3", "RTSTRUCT", ""},
                                {"1.2.840.10008.5.1.4.1.1.66.4", "SEG", ""},
                                {"1.2.840.10008.5.1.4.1.1.11.1", "PR", ""}};
  for (const Kind& kind : kinds)
  {
    Given given = ofClass(kind.sopClass, kind.modality);
    const std::string name = "LINDQVIST";
    given.body = body + element(0x00080104, name) + element(0x00620005, name) +
                 element(0x00620006, name) +
                 sequence(0x00620002, element(0x00620005, name) + element(0x00620006, name) +
                                          element(0x00620020, name)) +
                 sequence(0x30060020, element(0x30060026, name) + element(0x30060028, name)) +
                 sequence(0x30060080, element(0x30060085, name) + element(0x300600a6, name)) +
                 element(0x30060002, name) + element(0x00700080, name) + element(0x00700081, name) +
                 element(0x00700084, name) +
                 sequence(0x00700001, sequence(0x00700008, element(0x00700006, name))) +
                 sequence(0x00700060, element(0x00700068, name)) +
                 sequence(0x54000100, element(0x54001010, name + " ") + element(0x003a0020, name)) +
                 sequence(0x0040b020, element(0x00700006, name) + element(0x0040a132, "1"));
    write(in / (std::to_string(100 + n++) + ".dcm"), given);
  }
  for (const auto dates : {Dates::Remove, Dates::Shift, Dates::Keep})
  {
    fs::remove_all(out);
    const DeidentificationResult done = deidentify(in, out, allRetained(dates), key);
    const std::string bytes = allBytesBelow(out);
    for (const char* plant : {"LINDQVIST", "Lindqvist", "AURELIA", "Aurelia", "1931"})
      EXPECT_EQ(bytes.find(plant), std::string::npos) << plant;
    EXPECT_EQ(done.report.filesWritten, 4U);
    ASSERT_EQ(done.leftOut.size(), 9U);
    for (std::size_t k = 0; k < done.leftOut.size(); ++k)
      EXPECT_NE(done.leftOut[k].find(kinds[k].why), std::string::npos) << done.leftOut[k];
  }
}

TEST_F(Deidentification, TellsPatientsOfTwoHospitalsApart)
{
  const auto file = [this](const char* name, const std::string& body, const char* instance)
  {
    Given given = withBody(body + element(0x00100020, "4711"));
    given.instance = instance;
    write(in / name, given);
  };
  file("a.dcm", element(0x00100021, "NORTH") + element(0x00100010, "Doe^Jane"), "1.2.3.1");
  file("b.dcm", element(0x00100021, "SOUTH") + element(0x00100010, "Roe^Rick"), "1.2.3.2");
  DeidentificationResult done = run();
  EXPECT_EQ(done.report.patients, 2U);
  EXPECT_TRUE(done.report.text().find("may stand for two patients") == std::string::npos);
  EXPECT_NE(done.report.text().find("several pseudonyms"), std::string::npos) << "in one series";
  fs::remove_all(out);
  file("b.dcm", element(0x00100021, "NORTH") + element(0x00100010, "DOE^JANE "), "1.2.3.2");
  done = run();
  EXPECT_EQ(done.report.text().find("may stand for two patients"), std::string::npos);
  EXPECT_EQ(done.report.text().find("several pseudonyms"), std::string::npos);
  fs::remove_all(out);
  file("b.dcm", element(0x00100021, "NORTH") + element(0x00100010, "Roe^Rick"), "1.2.3.2");
  done = run();
  EXPECT_EQ(done.report.patients, 1U);
  EXPECT_NE(done.report.text().find("may stand for two patients"), std::string::npos);
}

TEST_F(Deidentification, RemovesWhatAKilledRunLeftButNothingOfARunningOne)
{
  write(in / "a.dcm", {});
  const std::string cleanedStart = std::string(128, '\0') + "DICM";
  imaging::test::writeText(folder.path() / ".petrous-0001" / "series-001-CT" / "00001.dcm", "x");
  imaging::test::writeText(folder.path() / ".petrous-0002", cleanedStart + "rest");
  imaging::test::writeText(folder.path() / ".petrous-0003", "PK of another program");
  imaging::test::writeText(folder.path() / ".petrous-0004" / "ct" / "1.dcm", "x");
  imaging::test::writeText(folder.path() / ".petrous-0005" / "series-001-MR" / "00001.dcm", "x");
  imaging::test::writeText(out / ".petrous-0006" / "series-001-CT" / "00001.dcm", "x");
  fs::create_directories(out / ".petrous-0007");
  core::OutputFile growing(folder.path() / "growing");
  growing.write(cleanedStart);
  const OwnerLock lock(folder.path() / ".petrous-0005");
  ASSERT_TRUE(lock.isThere());
  run();
  EXPECT_FALSE(fs::exists(folder.path() / ".petrous-0001"));
  EXPECT_FALSE(fs::exists(folder.path() / ".petrous-0002"));
  EXPECT_TRUE(fs::exists(folder.path() / ".petrous-0003"));
  EXPECT_TRUE(fs::exists(folder.path() / ".petrous-0004"));
  EXPECT_TRUE(fs::exists(folder.path() / ".petrous-0005"));
  EXPECT_TRUE(fs::exists(growing.temporary()));
  EXPECT_FALSE(fs::exists(out / ".petrous-0006"));
  EXPECT_FALSE(fs::exists(out / ".petrous-0007"));
  EXPECT_TRUE(fs::exists(out / "series-001-CT" / "00001.dcm"));
}

TEST_F(Deidentification, FollowsLinksToFoldersOnce)
{
  const fs::path elsewhere = folder.path() / "elsewhere";
  write(in / "a.dcm", {});
  write(elsewhere / "study" / "b.dcm", {});
  fs::create_directory_symlink(elsewhere, in / "2");
  fs::create_directory_symlink(elsewhere, in / "3");
  fs::create_directory_symlink(in, elsewhere / "study" / "back");
  fs::create_symlink(elsewhere / "none", in / "broken");
  EXPECT_EQ(run().report.filesWritten, 2U);
}

// What a stream of the C library still holds when the file is closed may find no room.
TEST_F(Deidentification, ADiskThatIsFullAtAnyByteLeavesWhatWasThere)
{
  write(in / "a.dcm", {});
  write(in / "b.dcm", {});
  const fs::path file = folder.path() / "one.dcm";
  deidentify(in / "a.dcm", file, {}, key);
  const auto size = static_cast<rlim_t>(fs::file_size(file));
  imaging::test::writeText(file, "former");
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto former = std::signal(SIGXFSZ, SIG_IGN);
  for (const rlim_t most : {rlim_t{0}, rlim_t{1}, rlim_t{200}, size / 2, size - 1})
    for (const bool isFolder : {false, true})
    {
      rlimit limit = before;
      limit.rlim_cur = most;
      ::setrlimit(RLIMIT_FSIZE, &limit);
      try
      {
        deidentify(isFolder ? in : in / "a.dcm", isFolder ? out : file, {}, key);
        ADD_FAILURE() << most << ": the disk took it";
      }
      catch (const core::OutputFileError& error)
      {
        EXPECT_EQ(error.reason, core::OutputFileError::Reason::DiskFull) << error.what();
      }
      ::setrlimit(RLIMIT_FSIZE, &before);
      EXPECT_EQ(core::readFile(file), "former");
      EXPECT_FALSE(fs::exists(out));
    }
  std::signal(SIGXFSZ, former);
  run();
  EXPECT_EQ(fs::file_size(out / "series-001-CT" / "00002.dcm"), size);
}

// The map of pseudonyms is the only way back.
TEST_F(Deidentification, GivesNamesOfAnyCharacterSetInUtf8)
{
  struct Name
  {
    const char *set, *bytes, *utf8;
  };
  // The same names as PS3.5 annexes H and K, or the code charts, have them.
  const std::vector<Name> names{
      {"ISO_IR 100", "M\xfcller^Hans", "M\xc3\xbcller^Hans"},
      {"ISO_IR 144", "\xbb\xee\xda\xdd\xd5\xe6",
       "\xd0\x9b\xd1\x8e\xd0\xba\xd0\xbd\xd0\xb5\xd1\x86"},
      {"ISO_IR 126", "\xc4\xe9\xef\xed", "\xce\x94\xce\xb9\xce\xbf\xce\xbd"},
      {"\\ISO 2022 IR 87", "Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B",
       "Yamada^Tarou=\xe5\xb1\xb1\xe7\x94\xb0^\xe5\xa4\xaa\xe9\x83\x8e"},
      {"\\ISO 2022 IR 149", "Hong^Gildong=\x1b$)C\xfb\xf3^\x1b$)C\xd1\xce\xd4\xd7",
       "Hong^Gildong=\xe6\xb4\xaa^\xe5\x90\x89\xe6\xb4\x9e"},
      {"GB18030", "Wang=\xcd\xf5", "Wang=\xe7\x8e\x8b"},
      {"ISO_IR 192", "Zo\xc3\xab", "Zo\xc3\xab"},
      {"", "Zo\xc3\xab", "Zo\xc3\xab"}, // not stated
      {"", "Zo\xeb", "Zo\xc3\xab"},
      {"ISO_IR 192", "Zo\xeb", "Zo\xc3\xab"},
  };
  for (const Name& name : names)
  {
    write(in / "a.dcm", withBody((*name.set ? element(0x00080005, name.set) : std::string()) +
                                 element(0x00100010, name.bytes)));
    fs::remove_all(out);
    const std::vector<Pseudonym> given = run().pseudonyms;
    const auto patient = std::find_if(given.begin(), given.end(),
                                      [](const auto& one) { return one.kind == "patient"; });
    ASSERT_NE(patient, given.end());
    EXPECT_EQ(patient->identity, std::string(" ") + name.utf8) << name.set;
    // Kept and read, it is known again.
    const fs::path file = folder.path() / "map";
    constexpr PseudonymMap::Cost kCheap{1, 1 << 16};
    {
      PseudonymMap map(file, "correct horse", kCheap);
      map.takeIn(given);
    }
    PseudonymMap map(file, "correct horse", kCheap);
    EXPECT_EQ(map.add(given), 0U) << name.set;
    fs::remove(file);
  }
}

TEST_F(Deidentification, GivesThePseudonymsBeforeTheOutputIsThere)
{
  write(in / "a.dcm", withBody(element(0x00100020, "4711")));
  std::vector<Pseudonym> kept;
  const auto keep = [&](const std::vector<Pseudonym>& given)
  {
    EXPECT_FALSE(fs::exists(out));
    kept = given;
  };
  deidentify(in, out, {}, key, {}, keep);
  EXPECT_EQ(kept.size(), 3U);
  fs::remove_all(out);
  kept.clear();
  deidentify(in / "a.dcm", out, {}, key, {}, keep);
  EXPECT_EQ(kept.size(), 3U);
}

} // namespace petrous::library
