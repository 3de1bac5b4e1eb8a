#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace petrous::scene
{

struct Case;
struct VideoNotes;

/// A file that belongs to a case: embedded, as an object of the library, or a link to a file
/// outside of it.
struct Attachment
{
  enum class Kind
  {
    Recording,  ///< of the tool (.ticks)
    Screenshot, ///< PNG
    Video,      ///< film or sound; may show or name the patient
    Document    ///< PDF
  };
  static constexpr std::size_t kMax = 1000; ///< of a case

  Kind kind = Kind::Document;
  std::string name;        ///< valid for a file; unique in the case, whatever the case of letters
  std::string date;        ///< on which it was attached, ISO 8601: "2026-03-31"; or empty
  std::string note;        ///< as Description::note
  std::string stroke;      ///< object of the stroke to which it belongs; empty: none
  std::string object;      ///< its name in the library; empty: a link, or not stored yet
  std::string link;        ///< absolute path of the linked file; empty: embedded
  std::string sha256;      ///< of the linked file, hexadecimal
  std::uint64_t bytes = 0; ///< of the file
  /// Of a video: its bookmarks and stills (VideoNotes.h). nullptr: none.
  std::shared_ptr<const VideoNotes> video;

  /// Of one that is not stored yet, either: where its content is taken from by the next save. Not
  /// in the manifest.
  std::filesystem::path source;
  std::shared_ptr<const std::vector<std::uint8_t>> content;
};

const char* nameOf(Attachment::Kind kind) noexcept; ///< "recording", ...
/// Throws InvalidParameter for another name.
Attachment::Kind attachmentKindFrom(const std::string& name);

/// Throws InvalidParameter unless the name can be that of a file on every system, as checkCaseName.
void checkAttachmentName(const std::string& name);

/// Throws InvalidParameter naming the first attachment or field that is invalid.
void checkAttachments(const std::vector<Attachment>& attachments);

/// The attachment of this name, whatever the case of its letters. Throws InvalidParameter listing
/// those that there are.
Attachment& findAttachment(Case& value, const std::string& name);
const Attachment& findAttachment(const Case& value, const std::string& name);

/// The name, or if it is taken the first free one of "stem (2).ending", ...
std::string freeAttachmentName(const Case& value, const std::string& name);

/// The number of the stroke, from 1, to which it belongs; 0: none, or one that is gone.
std::size_t strokeOf(const Case& value, const Attachment& attachment);

} // namespace petrous::scene
