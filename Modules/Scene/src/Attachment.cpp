#include "petrous/Scene/Attachment.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>

#include "petrous/Core/NumberText.h"
#include "petrous/Dissection/StrokeNumber.h"
#include "petrous/Scene/Case.h"
#include "petrous/Scene/VideoNotes.h"

namespace petrous::scene
{

namespace
{

constexpr std::array<const char*, 4> kKinds{"recording", "screenshot", "video", "document"};

void require(bool holds, const std::string& what)
{
  if (!holds)
    throw core::InvalidParameter("attachment: " + what);
}

bool isHash(const std::string& text)
{
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == text.npos;
}

void checkLink(const std::string& path)
{
  constexpr std::size_t kLongest = 4096;
  const bool isPlain =
      std::none_of(path.begin(), path.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  require(path.size() <= kLongest && path.front() == '/' && isPlain,
          "a link must be an absolute path without control characters");
}

template <class Attachments>
auto& found(Attachments& attachments, const std::string& name, const std::string& caseName)
{
  const auto at = std::find_if(attachments.begin(), attachments.end(),
                               [wanted = lowerCase(name)](const Attachment& one)
                               { return lowerCase(one.name) == wanted; });
  if (at != attachments.end())
    return *at;
  std::string there;
  for (const Attachment& one : attachments)
    there += (there.empty() ? "; it has " : ", ") + one.name;
  throw core::InvalidParameter("case '" + caseName + "' has no attachment '" + name + "'" +
                               (there.empty() ? "; it has none" : there));
}

} // namespace

const char* nameOf(Attachment::Kind kind) noexcept
{
  return kKinds[static_cast<std::size_t>(kind)];
}

Attachment::Kind attachmentKindFrom(const std::string& name)
{
  const auto* const at = std::find(kKinds.begin(), kKinds.end(), name);
  if (at == kKinds.end())
    throw core::InvalidParameter("an attachment must be a recording, a screenshot, a video or a "
                                 "document");
  return static_cast<Attachment::Kind>(std::distance(kKinds.begin(), at));
}

void checkAttachments(const std::vector<Attachment>& attachments)
{
  require(attachments.size() <= Attachment::kMax,
          "a case has at most " + std::to_string(Attachment::kMax));
  std::set<std::string> names;
  for (const Attachment& one : attachments)
  {
    checkAttachmentName(one.name);
    require(names.insert(lowerCase(one.name)).second, "two have one name");
    Description text;
    text.note = one.note;
    text.date = one.date;
    checkDescription(text);
    require(one.object.empty() || one.link.empty(), "one is embedded and a link");
    if (one.video)
    {
      require(one.kind == Attachment::Kind::Video, "bookmarks and stills are of a video");
      checkVideoNotes(*one.video);
    }
    if (one.link.empty())
      continue;
    checkLink(one.link);
    require(isHash(one.sha256), "a link must have the SHA-256 of its file");
  }
}

Attachment& findAttachment(Case& value, const std::string& name)
{
  return found(value.attachments, name, value.name);
}

const Attachment& findAttachment(const Case& value, const std::string& name)
{
  return found(value.attachments, name, value.name);
}

std::string freeAttachmentName(const Case& value, const std::string& name)
{
  const auto isTaken = [&value](const std::string& text)
  {
    return std::any_of(value.attachments.begin(), value.attachments.end(),
                       [wanted = lowerCase(text)](const Attachment& one)
                       { return lowerCase(one.name) == wanted; });
  };
  const std::size_t dot = name.find_last_of('.');
  const std::string ending = dot == name.npos || dot == 0 ? std::string() : name.substr(dot);
  const std::string stem = core::utf8Prefix(name.substr(0, name.size() - ending.size()),
                                            90 - std::min<std::size_t>(ending.size(), 60));
  std::string unused = name;
  for (int n = 2; isTaken(unused); ++n)
    unused = stem + " (" + std::to_string(n) + ")" + ending;
  return unused;
}

std::size_t strokeOf(const Case& value, const Attachment& attachment)
{
  const auto stroke = strokeWith(value, attachment.stroke);
  return stroke ? dissection::strokeNumber(*stroke) : 0;
}

} // namespace petrous::scene
