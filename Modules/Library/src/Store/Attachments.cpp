#include "petrous/Library/Attachments.h"

#include <algorithm>
#include <cstring>
#include <string_view>

#include <libdeflate.h>

#include "AttachmentFiles.h"
#include "LibraryFolder.h"
#include "Sha256.h"
#include "petrous/Core/LocalTime.h"
#include "petrous/Library/LibraryFiles.h"

namespace petrous::library
{

namespace fs = std::filesystem;
using scene::Attachment;

namespace
{

constexpr std::size_t kHead = 256; // bytes by which a file is known

bool isVideo(std::string_view head)
{
  const auto has = [head](std::size_t at, std::string_view text)
  { return head.size() >= at + text.size() && head.substr(at, text.size()) == text; };
  using namespace std::string_view_literals;
  for (const auto& atom : {"ftyp"sv, "moov"sv, "mdat"sv, "wide"sv}) // ISO base media, QuickTime
    if (has(4, atom))
      return true;
  for (const auto& begin :
       {"\x1a\x45\xdf\xa3"sv, "OggS"sv, "\0\0\1\xba"sv, "\0\0\1\xb3"sv, "FLV\1"sv,
        "\x30\x26\xb2\x75\x8e\x66\xcf\x11"sv, "ID3"sv, "fLaC"sv}) // Matroska, Ogg, MPEG, FLV, ASF
    if (has(0, begin))
      return true;
  return (has(0, "RIFF") && (has(8, "AVI ") || has(8, "WAVE"))) || (has(0, "G") && has(188, "G")) ||
         (has(4, "G") && has(196, "G")); // MPEG-TS, with times
}

Attachment::Kind kindOf(std::string_view head, const fs::path& file)
{
  if (head.substr(0, 8) == "\x89PNG\r\n\x1a\n")
    return Attachment::Kind::Screenshot;
  if (head.substr(0, 5) == "%PDF-")
    return Attachment::Kind::Document;
  if (head.substr(0, 8) == "PTRTICK\n") // Session/RecordingFormat.h
    return Attachment::Kind::Recording;
  if (isVideo(head))
    return Attachment::Kind::Video;
  throw core::InvalidParameter(
      core::printable(file) + ": is nothing that a case takes: a recording of the tool (.ticks), "
                              "a PNG, a PDF, or a video (MP4, MOV, MKV, WebM, AVI, MPEG, WMV, FLV, "
                              "Ogg)");
}

std::string readHead(const core::InputFile& file)
{
  return file.read(std::min<std::uintmax_t>(kHead, file.size()));
}

// What follows the last dot, as the ending of an object: two to eight letters and digits, else
// "bin".
std::string objectEnding(const std::string& name)
{
  const std::size_t dot = name.find_last_of('.');
  std::string ending = dot == name.npos ? std::string() : scene::lowerCase(name.substr(dot + 1));
  const bool isPlain =
      ending.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789") == ending.npos;
  return isPlain && !ending.empty() && ending.size() <= 8 ? ending : std::string("bin");
}

// Without anything of the file's own name, which may be a patient's, but for an ending by which
// programs know such files.
std::string neutralName(Attachment::Kind kind, const fs::path& file)
{
  switch (kind)
  {
  case Attachment::Kind::Recording:
    return "recording.ticks";
  case Attachment::Kind::Screenshot:
    return "screenshot.png";
  case Attachment::Kind::Document:
    return "document.pdf";
  case Attachment::Kind::Video:
    break;
  }
  const std::string ending = scene::lowerCase(file.extension().string());
  for (const char* known :
       {".mp4", ".m4v", ".mov", ".mkv", ".webm", ".avi",  ".mpg", ".mpeg", ".ts",  ".mts", ".wmv",
        ".flv", ".ogv", ".ogg", ".mp3", ".wav",  ".flac", ".m4a", ".mka",  ".asf", ".3gp"})
    if (ending == known)
      return "video" + ending;
  return "video";
}

Attachment described(const AttachOptions& options, Attachment::Kind kind, const fs::path& file)
{
  Attachment attachment;
  attachment.kind = kind;
  attachment.name = options.name.empty() ? neutralName(kind, file) : options.name;
  attachment.note = options.note;
  attachment.date = options.date.empty() ? core::today() : options.date;
  return attachment;
}

std::uint32_t number(const std::uint8_t* from)
{
  return std::uint32_t{from[0]} << 24U | std::uint32_t{from[1]} << 16U |
         std::uint32_t{from[2]} << 8U | from[3];
}

void refuseTooLarge(const fs::path& file, std::uintmax_t bytes, std::uint64_t limit,
                    const char* instead)
{
  if (bytes > limit)
    throw core::InvalidParameter(core::printable(file) + ": is larger than the " +
                                 std::to_string(limit >> 20U) + " MB that can be attached" +
                                 instead);
}

std::vector<std::uint8_t> bytesOf(const std::string& text)
{
  return {text.begin(), text.end()};
}

} // namespace

bool isOfKind(const fs::path& file, Attachment::Kind kind)
{
  try
  {
    return kindOf(readHead(core::InputFile(file)), file) == kind;
  }
  catch (const core::InvalidParameter&)
  {
    return false;
  }
}

Attachment attachmentOf(const fs::path& file, const AttachOptions& options,
                        const core::Progress& progress)
{
  const core::InputFile opened(file); // a regular file, at the end of links
  Attachment attachment = described(options, kindOf(readHead(opened), file), file);
  attachment.bytes = opened.size();
  try
  {
    if (options.link)
    {
      attachment.link = fs::canonical(file).string();
      attachment.sha256 = copied(opened, {}, progress);
      scene::checkAttachments({attachment});
      return attachment;
    }
    refuseTooLarge(file, opened.size(), kLargestEmbedded, "; link it (--link)");
    scene::checkAttachments({attachment});
    if (attachment.kind == Attachment::Kind::Screenshot)
    {
      refuseTooLarge(file, opened.size(), kLargestPng, "");
      attachment.content =
          std::make_shared<std::vector<std::uint8_t>>(cleanedPng(bytesOf(opened.read())));
      attachment.bytes = attachment.content->size();
    }
    else
      attachment.source = fs::absolute(file);
  }
  catch (const core::InputFileError&)
  {
    throw;
  }
  catch (const core::InvalidParameter& error)
  {
    const std::string where = core::printable(file) + ": ";
    const std::string text = error.what();
    throw core::InvalidParameter(text.rfind(where, 0) == 0 ? text : where + text);
  }
  return attachment;
}

Attachment screenshotOf(std::vector<std::uint8_t> png, const AttachOptions& options)
{
  Attachment attachment = described(options, Attachment::Kind::Screenshot, {});
  attachment.content = std::make_shared<std::vector<std::uint8_t>>(cleanedPng(png));
  attachment.bytes = attachment.content->size();
  scene::checkAttachments({attachment});
  return attachment;
}

bool hasAttachment(const scene::Case& value, Attachment::Kind kind) noexcept
{
  return std::any_of(value.attachments.begin(), value.attachments.end(),
                     [kind](const Attachment& one) { return one.kind == kind; });
}

std::string attach(scene::Case& value, Attachment attachment)
{
  attachment.name = scene::freeAttachmentName(value, attachment.name);
  std::vector<Attachment> next = value.attachments;
  next.push_back(std::move(attachment));
  scene::checkAttachments(next);
  value.attachments = std::move(next);
  return value.attachments.back().name;
}

std::vector<std::uint8_t> cleanedPng(const std::vector<std::uint8_t>& png)
{
  constexpr std::size_t kAround = 12; // length, type and checksum of a chunk
  constexpr std::string_view kKept[] = {"IHDR", "PLTE", "tRNS", "gAMA",
                                        "sRGB", "pHYs", "IDAT", "IEND"};
  const auto refuse = [](const char* why)
  { throw core::InvalidParameter(std::string("the PNG ") + why); };
  if (png.size() < 8 || std::memcmp(png.data(), "\x89PNG\r\n\x1a\n", 8) != 0)
    refuse("is none");
  std::vector<std::uint8_t> cleaned(png.begin(), png.begin() + 8);
  bool hasPixels = false;
  for (std::size_t at = 8; at < png.size();)
  {
    if (png.size() - at < kAround)
      break;
    const std::size_t length = number(png.data() + at);
    if (length > png.size() - at - kAround)
      break;
    const std::string_view type(reinterpret_cast<const char*>(png.data() + at + 4), 4);
    if (libdeflate_crc32(0, png.data() + at + 4, 4 + length) !=
        number(png.data() + at + 8 + length))
      refuse("is damaged: a checksum is wrong");
    if ((at == 8) != (type == "IHDR"))
      refuse("is damaged: it does not begin with its header");
    if (std::find(std::begin(kKept), std::end(kKept), type) != std::end(kKept))
    {
      const auto* const chunk = png.data() + at;
      cleaned.insert(cleaned.end(), chunk, chunk + kAround + length);
    }
    hasPixels = hasPixels || type == "IDAT";
    at += kAround + length;
    if (type == "IEND" && hasPixels)
      return cleaned; // what follows is no part of the picture
  }
  refuse("is not whole");
  return {};
}

void storeAttachments(scene::Case& value, ObjectStore& store, const core::Progress& progress)
{
  for (Attachment& one : value.attachments)
  {
    if (!one.link.empty() ||
        (!one.object.empty() && (one.source.empty() || store.contains(one.object))))
      continue;
    const std::string ending = objectEnding(one.name);
    if (one.content)
    {
      one.object = store.add(ending, *one.content);
      one.bytes = one.content->size();
      continue;
    }
    if (one.source.empty())
      continue; // lost: its reference stays
    try
    {
      const core::InputFile file(one.source);
      refuseTooLarge(one.source, file.size(), kLargestEmbedded, "; link it");
      const std::string object = store.add(
          ending,
          [&file, &progress](const fs::path& path)
          {
            core::OutputFile out(path);
            copied(
                file, [&out](const char* bytes, std::size_t count) { out.write(bytes, count); },
                progress);
            out.commit();
          });
      if (!one.object.empty() && one.object != object) // of another library
        throw LibraryError(LibraryError::Reason::Damaged,
                           core::printable(one.source) + ": " + attachmentText(one) +
                               " is damaged: not what was stored there; remove it, or attach the "
                               "same file again");
      one.object = object;
      one.bytes = file.size();
    }
    catch (const core::InputFileError& error)
    {
      throw LibraryError(error.reason == core::InputFileError::Reason::NotFound
                             ? LibraryError::Reason::NotFound
                             : LibraryError::Reason::Damaged,
                         std::string(error.what()) + "; attachment '" + one.name +
                             "' cannot be stored: remove it, or put its file back");
    }
  }
}

std::string attachmentText(const Attachment& attachment)
{
  return "attachment '" + attachment.name + "'";
}

std::string attachmentProblem(const Library& library, const Attachment& attachment)
try
{
  const fs::path path = attachment.link.empty()
                            ? ObjectStore(library.folder() / "objects").path(attachment.object)
                            : fs::path(attachment.link);
  return core::InputFile(path).size() == attachment.bytes ? std::string() : "changed";
}
catch (const core::InputFileError& error)
{
  return error.reason == core::InputFileError::Reason::NotFound ? "missing" : "unreadable";
}
catch (const LibraryError&)
{
  return "missing";
}

std::string attachmentChange(const Library& library, const Attachment& attachment,
                             const core::Progress& progress)
try
{
  if (const std::string problem = attachmentProblem(library, attachment); !problem.empty())
    return problem;
  const std::string& known = attachment.link.empty() ? attachment.object : attachment.sha256;
  const std::string hash = copied(core::InputFile(attachmentFile(library, attachment)), {},
                                  progress, "comparing with what was attached");
  return known.compare(0, hash.size(), hash) == 0 ? std::string() : "changed";
}
catch (const core::InputFileError& error)
{
  return error.reason == core::InputFileError::Reason::NotFound ? "missing" : "unreadable";
}
catch (const LibraryError&)
{
  return "unreadable";
}

fs::path attachmentFile(const Library& library, const Attachment& attachment)
{
  if (!attachment.link.empty())
    return attachment.link;
  if (!attachment.object.empty())
    return ObjectStore(library.folder() / "objects")
        .path(attachment.object, attachmentText(attachment));
  if (attachment.source.empty())
    throw core::InvalidParameter(attachmentText(attachment) + " is not saved yet");
  return attachment.source;
}

void extractAttachment(const Library& library, const scene::Case& value,
                       const Attachment& attachment, const fs::path& out,
                       const core::Progress& progress)
try
{
  refuseOverwriting(out, library.folder());
  const std::string what = attachmentText(attachment) + " of case '" + value.name + "'";
  const bool isLink = !attachment.link.empty();
  const fs::path path =
      isLink ? fs::path(attachment.link)
             : ObjectStore(library.folder() / "objects").path(attachment.object, what);
  const core::InputFile file(path);
  const std::string remedy =
      isLink ? "the linked file is another one than was attached; put the former one back, or "
               "remove the attachment and attach this one"
             : "is damaged: not what was stored there; restore it from a copy of the library, or "
               "remove the attachment";
  const auto refuse = [&]
  {
    throw LibraryError(LibraryError::Reason::Damaged,
                       core::printable(path) + ": " + what + ": " + remedy);
  };
  if (isLink && file.size() != attachment.bytes)
    refuse();
  core::OutputFile to(out);
  const std::string hash = copied(
      file, [&to](const char* bytes, std::size_t count) { to.write(bytes, count); }, progress);
  if (hash != (isLink ? attachment.sha256 : attachment.object.substr(0, hash.size())))
    refuse();
  to.commit();
}
catch (const core::InputFileError& error)
{
  throw LibraryError(error.reason == core::InputFileError::Reason::NotFound
                         ? LibraryError::Reason::NotFound
                         : LibraryError::Reason::Damaged,
                     std::string(error.what()) + "; it belongs to attachment '" + attachment.name +
                         "' of case '" + value.name + "'");
}

} // namespace petrous::library
