#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace petrous::testing
{

/// The readers of files that others wrote, each fed with bytes as if they were such a file. Shared
/// by the fuzzing targets and by the test that replays their corpus. Uses a temporary folder.
class HostileReaders
{
public:
  HostileReaders();
  ~HostileReaders();
  HostileReaders(const HostileReaders&) = delete;
  HostileReaders& operator=(const HostileReaders&) = delete;

  /// The folders of the corpus: "nifti", "nrrd", ...
  static std::vector<std::string> names();

  /// Whether the reader accepted the bytes. Its refusals (core::Error) are caught, and must be one
  /// line; anything else that it throws is not.
  bool accepts(const std::string& reader, std::string_view bytes) const;

private:
  std::filesystem::path put(const char* name, std::string_view bytes) const;

  std::filesystem::path m_folder;
};

} // namespace petrous::testing
