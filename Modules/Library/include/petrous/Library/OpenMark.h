#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace petrous::library
{

/// Tells other programs that this one has a case open: a file in the library's folder `open`, which
/// names process and computer, and which is locked until the process ends, however it ends. It
/// forbids nothing: a save over another one is refused by the case's revision.
class OpenMark
{
public:
  /// `id`: Case::id. Where the folder cannot be written nothing is marked.
  OpenMark(const std::filesystem::path& library, std::string id);
  ~OpenMark();
  OpenMark(const OpenMark&) = delete;
  OpenMark& operator=(const OpenMark&) = delete;

  const std::string& id() const noexcept { return m_id; }

private:
  std::string m_id;
  std::filesystem::path m_path;
  int m_descriptor = -1;
};

/// A program that has a case open.
struct Opener
{
  long process = 0;
  std::string computer;
};

/// Other processes that have the case of this ID open. Marks that were left by killed ones are
/// removed. Never throws but std::bad_alloc.
std::vector<Opener> openersOf(const std::filesystem::path& library, const std::string& id);

/// Likewise, that have any case of the library open.
std::vector<Opener> openersOfAny(const std::filesystem::path& library);

/// "process 4711 on 'or-2', process 4 on 'ward'"; empty: there are none.
std::string toString(const std::vector<Opener>& openers);

/// Removes all marks that were left by killed processes.
void removeStaleMarks(const std::filesystem::path& library) noexcept;

} // namespace petrous::library
