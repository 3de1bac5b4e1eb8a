#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Library/LibraryFiles.h"

#include <algorithm>

#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Scene/FreeName.h"
#include "petrous/Scene/PlainText.h"

namespace petrous::presenters
{

namespace
{

constexpr std::size_t kMaxLength = 90; // bytes; leaves room for a number appended

} // namespace

std::string caseNameFrom(const std::filesystem::path& source)
{
  const auto path = source.lexically_normal();
  std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
  if (const imaging::FileFormat* format = imaging::formatOf(name))
    name.resize(name.size() - format->ending.size());
  if (!core::isUtf8(name))
    name.erase(std::remove_if(name.begin(), name.end(), [](char c) { return (c & 0x80) != 0; }),
               name.end());
  const std::string unwanted = "/\\:*?\"<>|";
  std::replace_if(
      name.begin(), name.end(),
      [&unwanted](char c)
      {
        const auto u = static_cast<unsigned char>(c);
        return u < 0x20 || u == 0x7f || unwanted.find(c) != std::string::npos;
      },
      ' ');
  name = core::utf8Prefix(scene::withoutInvisible(name), kMaxLength);
  const auto first = name.find_first_not_of(" .-");
  const auto last = name.find_last_not_of(" .");
  if (first == std::string::npos || last == std::string::npos)
    return "case";
  return name.substr(first, last - first + 1);
}

std::string shownName(std::string part)
{
  std::replace(part.begin(), part.end(), '_', ' ');
  return part;
}

std::string freeCaseName(const library::Library& library, const std::string& name)
{
  return scene::freeName(name, [&library](const std::string& taken)
                         { return !library::caseLike(library.folder(), taken).empty(); });
}

void checkFreeCaseName(const library::Library& library, const std::string& name)
{
  scene::checkCaseName(name);
  if (const std::string taken = library::caseLike(library.folder(), name); !taken.empty())
    throw core::InvalidParameter("the library has a case '" + taken +
                                 "' already; take another name");
}

bool namesCase(const library::Library& library, const std::string& text)
{
  const auto cases = library.list();
  return std::any_of(cases.begin(), cases.end(),
                     [&text](const library::CaseSummary& one) { return one.name == text; });
}

} // namespace petrous::presenters
