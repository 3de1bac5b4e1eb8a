#include "ConfidentialityProfile.h"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "AddedTermsTable.h"
#include "ConfidentialityTable.h"
#include "DefinedTermsTable.h"
#include "SafePrivateTable.h"

namespace petrous::library
{

namespace
{

constexpr std::uint32_t kPatientId = 0x00100020;

std::vector<std::string> split(const std::string& text, char at)
{
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);)
    parts.push_back(part);
  return parts;
}

std::uint32_t hex(const std::string& text)
{
  return static_cast<std::uint32_t>(std::stoul(text, nullptr, 16));
}

// Curves (50xx) and overlays (60xx) are removed as groups.
bool isCurveOrOverlay(std::uint32_t tag)
{
  const std::uint32_t page = tag >> 24;
  return page == 0x50 || page == 0x60;
}

// Where the type of an attribute requires more than the first of its actions, PS3.3 (A.3, A.4,
// A.21, A.38, A.36, A.51, A.19).
// Verified in GDCM's copy of PS3.3: the types below, but for two that are from knowledge, Protocol
// Name of an enhanced image (C.8.13.1, C.8.15.2) and Operators' Name of a structure set (C.8.8.1).
DeidAction requiredBy(IodKind iod, std::uint32_t tag)
{
  switch (iod)
  {
  case IodKind::Enhanced:
    switch (tag)
    {
    case 0x0008002a: // Acquisition DateTime, 1C
    case 0x00080023: // Content Date, 1
    case 0x00080033: // Content Time, 1
    case 0x00081111: // Referenced Performed Procedure Step Sequence, 1C
    case 0x00181000: // Device Serial Number, 1
    case 0x00181030: // Protocol Name, 1C
    case 0x00180010:
      return DeidAction::Dummy;
    default:
      break;
    }
    break;
  case IodKind::Pet:
    switch (tag)
    {
    case 0x00080021: // Series Date, 1
    case 0x00080031: // Series Time, 1
      return DeidAction::Dummy;
    case 0x00080022: // Acquisition Date, 2
    case 0x00080032: // Acquisition Time, 2
      return DeidAction::Empty;
    default:
      break;
    }
    break;
  case IodKind::StructureSet:
    if (tag == 0x00081070 || tag == 0x300e0008) // Operators' Name, 2; Reviewer Name, 2C
      return DeidAction::Empty;
    break;
  case IodKind::Plain:
  case IodKind::Other:
    break;
  }
  return tag == 0x00400555 ? DeidAction::Empty : DeidAction::Unlisted; // Acquisition Context, 2
}

DeidAction actionOf(char code)
{
  switch (code)
  {
  case 'Z':
    return DeidAction::Empty;
  case 'D':
    return DeidAction::Dummy;
  case 'U':
    return DeidAction::NewUid;
  default:
    return DeidAction::Remove;
  }
}

} // namespace

IodKind iodKindOf(const std::string& sopClass)
{
  static const std::unordered_map<std::string, IodKind> kKinds{
      {"1.2.840.10008.5.1.4.1.1.2", IodKind::Plain},           // CT
      {"1.2.840.10008.5.1.4.1.1.4", IodKind::Plain},           // MR
      {"1.2.840.10008.5.1.4.1.1.2.1", IodKind::Enhanced},      // Enhanced CT
      {"1.2.840.10008.5.1.4.1.1.2.2", IodKind::Enhanced},      // Legacy Converted Enhanced CT
      {"1.2.840.10008.5.1.4.1.1.4.1", IodKind::Enhanced},      // Enhanced MR
      {"1.2.840.10008.5.1.4.1.1.4.4", IodKind::Enhanced},      // Legacy Converted Enhanced MR
      {"1.2.840.10008.5.1.4.1.1.66.4", IodKind::Enhanced},     // Segmentation
      {"1.2.840.10008.5.1.4.1.1.128", IodKind::Pet},           // PET
      {"1.2.840.10008.5.1.4.1.1.481.3", IodKind::StructureSet} // RT Structure Set
  };
  const auto found = kKinds.find(sopClass);
  return found == kKinds.end() ? IodKind::Other : found->second;
}

ConfidentialityProfile::ConfidentialityProfile()
{
  std::istringstream table{std::string(kConfidentialityTable)};
  for (std::string line; std::getline(table, line);)
  {
    if (line.empty() || line[0] == '#')
    {
      if (m_edition.empty() && line.size() > 2)
        m_edition = line.substr(2, line.rfind(':') - 2);
      continue;
    }
    const auto columns = split(line, '\t');
    if (columns[0].find_first_not_of("0123456789abcdef") != std::string::npos)
      continue; // curves, overlays, private: by rule
    Row row;
    row.basic = columns[1];
    row.basic.erase(std::remove(row.basic.begin(), row.basic.end(), '/'), row.basic.end());
    for (const std::string& option : split(columns[2], ','))
    {
      const auto is = [&option](std::string_view name)
      { return option.compare(0, option.find('='), name) == 0; };
      const char code = option.back();
      if (is("dates"))
        row.dates = code;
      else if (is("shifted"))
        row.shifted = code;
      else if (is("device"))
        row.device = code;
      else if (is("patient"))
        row.patient = code;
      else if (is("descriptors"))
        row.descriptors = code;
    }
    m_rows.emplace(hex(columns[0]), row);
  }
  std::istringstream safe{std::string(kSafePrivateTable)};
  for (std::string line; std::getline(safe, line);)
  {
    if (line.empty() || line[0] == '#')
      continue;
    const auto columns = split(line, '\t');
    for (const std::string& element : split(columns[2], ' '))
      m_safe[columns[0]][hex(columns[1]) << 16 | hex(element.substr(0, 2))] = element.substr(3);
  }
  for (const std::string_view source : {kDefinedTermsTable, kAddedTermsTable})
  {
    std::istringstream terms{std::string(source)};
    for (std::string line; std::getline(terms, line);)
    {
      if (line.empty() || line[0] == '#')
        continue;
      const auto columns = split(line, '\t');
      auto& known = m_terms[columns[0] == "any" ? 0 : hex(columns[0])];
      for (std::string& term : split(columns[1], '|'))
        known.insert(std::move(term));
    }
  }
}

bool ConfidentialityProfile::isDefinedTerm(std::uint32_t tag, const std::string& value) const
{
  constexpr std::uint32_t kImageType = 0x00080008, kFrameType = 0x00089007;
  for (const std::uint32_t list : {tag == kFrameType ? kImageType : tag, std::uint32_t{0}})
    if (const auto terms = m_terms.find(list); terms != m_terms.end() && terms->second.count(value))
      return true;
  return false;
}

DeidAction ConfidentialityProfile::action(std::uint32_t tag, IodKind iod, bool nested,
                                          const DeidentificationOptions& options) const
{
  if (isCurveOrOverlay(tag))
    return DeidAction::Remove;
  const auto found = m_rows.find(tag);
  if (found == m_rows.end())
    return DeidAction::Unlisted;
  const Row& row = found->second;
  const auto optional = [](char code) {
    return code == 'K' ? DeidAction::Keep : code == 'C' ? DeidAction::Clean : DeidAction::Unlisted;
  };
  std::vector<DeidAction> chosen;
  if (options.dates == DeidentificationOptions::Dates::Keep)
    chosen.push_back(optional(row.dates));
  if (options.dates == DeidentificationOptions::Dates::Shift && row.shifted != 0)
    chosen.push_back(DeidAction::Shift);
  if (options.retainDevice)
    chosen.push_back(optional(row.device));
  if (options.retainPatientCharacteristics)
    chosen.push_back(optional(row.patient));
  if (options.cleanDescriptors)
    chosen.push_back(optional(row.descriptors));
  // An attribute of two options: what changes more wins (a date of a device is shifted).
  for (const DeidAction wanted : {DeidAction::Shift, DeidAction::Clean, DeidAction::Keep})
    if (std::find(chosen.begin(), chosen.end(), wanted) != chosen.end())
      return wanted;

  if (row.basic.find('U') != std::string::npos)
    return DeidAction::NewUid;
  if (row.basic.size() == 1)
    return actionOf(row.basic[0]);
  if (tag == kPatientId)
    return DeidAction::Dummy;
  if (nested || iod == IodKind::Other)
    return actionOf(row.basic.back());
  const DeidAction required = requiredBy(iod, tag);
  return required == DeidAction::Unlisted ? actionOf(row.basic.front()) : required;
}

std::string ConfidentialityProfile::safePrivateVr(const std::string& creator, std::uint16_t group,
                                                  std::uint16_t element) const
{
  const auto found = m_safe.find(creator);
  if (found == m_safe.end())
    return {};
  const auto entry = found->second.find(std::uint32_t{group} << 16 | element);
  return entry == found->second.end() ? std::string() : entry->second;
}

} // namespace petrous::library
