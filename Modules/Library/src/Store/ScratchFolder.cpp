#include "petrous/Library/ScratchFolder.h"

#include <string>

#include <stdlib.h>

#include "petrous/Core/Error.h"

namespace petrous::library
{

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder()
{
  const std::string begin = "petrous-transfer-";
  std::error_code ignored;
  const fs::path parent = fs::temp_directory_path(ignored);
  removeAbandoned(parent, [&begin](const fs::path& path)
                  { return path.filename().string().rfind(begin, 0) == 0; });
  constexpr int kAttempts = 10;
  for (int n = 0; n < kAttempts && (!m_lock || !m_lock->isThere()); ++n)
  {
    std::string name = (parent / (begin + "XXXXXX")).string();
    if (!::mkdtemp(name.data()))
      throw core::Error(core::Fault::Refused,
                        name + ": cannot be created; is the disk full, or TMPDIR wrong?");
    m_path = name;
    m_lock = std::make_unique<OwnerLock>(m_path);
  }
  if (!m_lock->isThere())
    throw core::Error(core::Fault::Refused,
                      parent.string() + ": folders that are made there are gone at once; is TMPDIR "
                                        "right?");
}

ScratchFolder::~ScratchFolder()
{
  std::error_code ignored;
  fs::remove_all(m_path, ignored);
}

} // namespace petrous::library
