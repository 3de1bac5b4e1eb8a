#include "petrous/Scene/Case.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <unicode/normalizer2.h>
#include <unicode/uchar.h>
#include <unicode/unistr.h>

#include "petrous/Core/AsciiCase.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Scene/Branches.h"
#include "petrous/Scene/FreeName.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Scene/PlainText.h"
#include "petrous/Scene/RemoveMr.h"

namespace petrous::scene
{

double Case::removedVolume() const
{
  return summaryOf(*this, dissection.history().position()).removed;
}

const StructurePart* findStructure(const Case& value, const std::string& name)
{
  for (const LabelPart& part : value.labels)
    for (const StructurePart& structure : part.structures)
      if (structure.name == name)
        return &structure;
  return nullptr;
}

StructurePart* findStructure(Case& value, const std::string& name)
{
  return const_cast<StructurePart*>(findStructure(static_cast<const Case&>(value), name));
}

MeshPart* findMesh(Case& value, const std::string& name)
{
  const auto found = std::find_if(value.meshes.begin(), value.meshes.end(),
                                  [&name](const MeshPart& mesh) { return mesh.name == name; });
  return found == value.meshes.end() ? nullptr : &*found;
}

const ImagePart* findMr(const Case& value, const std::string& name)
{
  const auto found = std::find_if(value.mr.begin(), value.mr.end(),
                                  [&name](const ImagePart& mr) { return mr.name == name; });
  return found == value.mr.end() ? nullptr : &*found;
}

namespace
{

bool isCalled(const Case& value, const std::string& name)
{
  return findStructure(value, name) ||
         std::any_of(value.meshes.begin(), value.meshes.end(),
                     [&name](const MeshPart& mesh) { return mesh.name == name; });
}

} // namespace

bool meansBone(const Case& value, const std::string& name)
{
  return name == "ct" || (name == "bone" && !isCalled(value, name));
}

bool meansSoftTissue(const Case& value, const std::string& name)
{
  return name == kSoftTissue || (name == "soft-tissue" && !isCalled(value, name));
}

std::vector<std::string> partNames(const Case& value)
{
  std::vector<std::string> names{"ct"};
  for (const ImagePart& mr : value.mr)
    names.push_back(mr.name);
  for (const LabelPart& part : value.labels)
    for (const StructurePart& structure : part.structures)
      names.push_back(structure.name);
  for (const MeshPart& mesh : value.meshes)
    names.push_back(mesh.name);
  return names;
}

const char* kindOfPart(const Case& value, const std::string& name)
{
  const auto isCalled = [&name](const MeshPart& mesh) { return mesh.name == name; };
  return name == "ct"                                                      ? "image"
         : findMr(value, name)                                             ? "MR"
         : findStructure(value, name)                                      ? "structure"
         : std::any_of(value.meshes.begin(), value.meshes.end(), isCalled) ? "mesh"
                                                                           : nullptr;
}

std::string caseFolded(const std::string& text)
{
  const auto unicode = icu::UnicodeString::fromUTF8(text);
  std::string folded;
  UErrorCode error = U_ZERO_ERROR;
  const icu::Normalizer2* const decomposed = icu::Normalizer2::getNFDInstance(error);
  const icu::Normalizer2* const composed = icu::Normalizer2::getNFCInstance(error);
  if (U_SUCCESS(error) && unicode.toUTF8String(folded) == text) // it is UTF-8
  {
    icu::UnicodeString small = decomposed->normalize(unicode, error).foldCase();
    folded.clear();
    composed->normalize(small, error).toUTF8String(folded);
    if (U_SUCCESS(error))
      return folded;
  }
  folded = text;
  std::transform(folded.begin(), folded.end(), folded.begin(), core::asciiLower);
  return folded;
}

std::string asRead(const std::string& name)
{
  const auto folded = icu::UnicodeString::fromUTF8(caseFolded(name));
  icu::UnicodeString read;
  bool isApart = false; // from the letter before, by blanks
  for (std::int32_t at = 0; at < folded.length(); at = folded.moveIndex32(at, 1))
  {
    const UChar32 letter = folded.char32At(at);
    if (u_isUWhiteSpace(letter) || letter == '_')
      isApart = !read.isEmpty();
    else if (!u_hasBinaryProperty(letter, UCHAR_DEFAULT_IGNORABLE_CODE_POINT))
    {
      if (std::exchange(isApart, false))
        read += static_cast<UChar>(' ');
      read += letter;
    }
  }
  std::string text;
  read.toUTF8String(text);
  return text;
}

std::string partReadAs(const Case& value, const std::string& name)
{
  if (kindOfPart(value, name))
    return name;
  const std::string read = asRead(name);
  for (const std::string& part : partNames(value))
    if (asRead(part) == read)
      return part;
  return {};
}

void checkNewPartName(const Case& value, const std::string& name, const std::string& to)
{
  checkPartName(to);
  const std::string read = asRead(to);
  for (const std::string& taken : partNames(value))
    if (taken != name && asRead(taken) == read)
      throw core::InvalidParameter("'" + taken + "' is in the case already; take another name" +
                                   (taken == to ? "" : " than '" + to + "', which reads the same"));
}

namespace
{

void readCtInsteadOf(Case& value, const std::string& image)
{
  const auto change = [&image](appearance::StructureAppearance& look)
  {
    if (look.sourceImage == image)
      look.sourceImage.clear();
  };
  change(value.boneLook);
  if (value.softTissue.sourceImage == image)
    appearance::readPrimaryImage(value.softTissue);
  for (LabelPart& part : value.labels)
    for (StructurePart& structure : part.structures)
      change(structure.look);
  for (MeshPart& mesh : value.meshes)
    change(mesh.look);
}

// Data drawn on an MR are mapped to the CT only through that MR.
void checkNothingHangsOn(const Case& value, const std::string& mr)
{
  const std::vector<std::string> names = drawnOnMr(value, mr);
  if (!names.empty())
    throw core::Error(core::Fault::Refused,
                      "MR '" + mr + "' stays: on it was drawn " + listed(names) +
                          ", which comes to the CT through it; remove that first");
}

} // namespace

void removeMr(Case& value, const std::string& name)
{
  const auto mr = std::find_if(value.mr.begin(), value.mr.end(),
                               [&name](const ImagePart& one) { return one.name == name; });
  if (mr == value.mr.end())
    throw core::InvalidParameter("the case has no MR '" + name + "'");
  checkNothingHangsOn(value, name);
  value.mr.erase(mr);
  readCtInsteadOf(value, name);
  for (LabelPart& part : value.labels)
    for (StructurePart& structure : part.structures)
      for (MrReading& reading : structure.readings)
        reading.isGone = reading.isGone || reading.mr == name;
  for (Measurement& measurement : value.measurements)
    for (MrReading& reading : measurement.readings)
      reading.isGone = reading.isGone || reading.mr == name;
  if (auto& slices = value.view.slices; slices && slices->overlay && slices->overlay->mr == name)
    slices->overlay.reset();
}

void removePart(Case& value, const std::string& name)
{
  const auto removeNamed = [&name](auto& parts)
  {
    const auto found = std::find_if(parts.begin(), parts.end(),
                                    [&name](const auto& part) { return part.name == name; });
    if (found == parts.end())
      return false;
    parts.erase(found);
    return true;
  };
  // One of the same name may remain, as label or mesh, and is followed from now on.
  const auto forget = [&]
  {
    if (!kindOfPart(value, name))
      forgetStructure(value.measurements, name);
  };
  for (auto part = value.labels.begin(); part != value.labels.end(); ++part)
    if (removeNamed(part->structures))
    {
      if (part->structures.empty())
        value.labels.erase(part);
      return forget();
    }
  if (removeNamed(value.meshes))
    return forget();
  if (findMr(value, name))
    return removeMr(value, name);
  std::string there;
  for (const std::string& part : partNames(value))
    if (part != "ct")
      there += (there.empty() ? "" : ", ") + part;
  throw core::InvalidParameter("case '" + value.name + "' has no part '" + name + "'" +
                               (name == "ct" ? " that can be removed" : "") + "; it has " +
                               (there.empty() ? "the CT alone" : there));
}

void checkBranchName(const std::string& name)
{
  if (name.empty() || name.size() > 100 || !core::isUtf8(name) || name.front() == '-' ||
      hasInvisible(name))
    throw core::InvalidParameter("the name of a branch must be 1 to 100 bytes of UTF-8 without "
                                 "control characters, characters that are not seen or a dash in "
                                 "front");
}

void checkPartName(const std::string& name)
{
  if (name.empty() || name.size() > 200 || !core::isUtf8(name) || hasInvisible(name) ||
      name == "ct" || name == kSoftTissue)
    throw core::InvalidParameter("the name of a part must be 1 to 200 bytes of UTF-8 without "
                                 "control characters or characters that are not seen, and not "
                                 "'ct' or 'ct:soft-tissue'; give one with NAME=FILE");
}

void checkPersonName(const std::string& name)
{
  if (name.size() > 100 || !core::isUtf8(name) || hasInvisible(name) ||
      name.find_first_not_of(' ') == std::string::npos)
    throw core::InvalidParameter("the name of who signs must be 1 to 100 bytes of UTF-8 without "
                                 "control characters or characters that are not seen");
}

namespace
{

void checkFileName(const std::string& name, const std::string& what)
{
  const auto bad = [](char c) { return std::string("/\\:*?\"<>|").find(c) != std::string::npos; };
  const auto ragged = [](char c) { return c == '.' || c == ' '; };
  if (!core::isUtf8(name))
    throw core::InvalidParameter(what + ": is not UTF-8; type it anew");
  if (name.empty() || name.size() > 100)
    throw core::InvalidParameter(what + ": must have 1 to 100 bytes, not " +
                                 std::to_string(name.size()));
  if (hasInvisible(name))
    throw core::InvalidParameter(what +
                                 ": must have no control characters, nor characters that are not "
                                 "seen (zero-width spaces, marks of direction); type it anew");
  if (std::any_of(name.begin(), name.end(), bad) || ragged(name.front()) || ragged(name.back()) ||
      name.front() == '-')
    throw core::InvalidParameter(
        what + " '" + name +
        "': must be a plain name without / \\ : * ? \" < > |, a dot or space at its ends, or a "
        "dash in front");
}

} // namespace

void checkCaseName(const std::string& name)
{
  checkFileName(name, "case name");
}

void checkAttachmentName(const std::string& name)
{
  checkFileName(name, "name of an attachment");
}

void saveView(Case& value, const std::string& name, const core::CameraPose& camera)
{
  ViewState view = value.view;
  ViewState::Saved& saved = view.saved[name];
  saved = {camera, view.slices, std::nullopt};
  if (saved.slices)
    saved.slices->overlay.reset();
  checkView(view);
  value.view = std::move(view);
}

ViewState::Saved presentView(const Case& value)
{
  ViewState::Saved view{value.camera, value.view.slices, value.view.clipping};
  if (view.slices)
    view.slices->overlay.reset();
  return view;
}

void showSaved(Case& value, const ViewState::Saved& saved)
{
  if (saved.camera)
    value.camera = saved.camera;
  if (saved.clipping)
    value.view.clipping = *saved.clipping;
  if (!saved.slices)
    return;
  const auto overlay = value.view.slices ? value.view.slices->overlay : std::nullopt;
  value.view.slices = saved.slices;
  value.view.slices->overlay = overlay;
}

} // namespace petrous::scene
