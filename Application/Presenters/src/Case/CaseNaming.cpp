#include "petrous/Presenters/CaseNaming.h"

#include <algorithm>

#include "petrous/Imaging/ImageFile.h"

namespace petrous::presenters
{

namespace
{

constexpr std::size_t kMaxLength = 90; // bytes; leaves room for a number appended

bool isContinuation(char c)
{
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

// Whether valid UTF-8 (checks lead and continuation bytes only).
bool isUtf8(const std::string& text)
{
  for (std::size_t n = 0; n < text.size();)
  {
    const auto lead = static_cast<unsigned char>(text[n]);
    const std::size_t length = lead < 0x80 ? 1 : lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if ((lead >= 0x80 && lead < 0xC2) || lead > 0xF4 || n + length > text.size())
      return false;
    for (std::size_t k = 1; k < length; ++k)
      if (!isContinuation(text[n + k]))
        return false;
    n += length;
  }
  return true;
}

void removeEnding(std::string& name)
{
  for (const std::string ending : {".nii.gz", ".nii", ".nrrd", ".nhdr", ".mha", ".mhd", ".dcm"})
  {
    if (name.size() <= ending.size())
      continue;
    std::string tail = name.substr(name.size() - ending.size());
    std::transform(tail.begin(), tail.end(), tail.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (tail == ending)
    {
      name.resize(name.size() - ending.size());
      return;
    }
  }
}

} // namespace

std::string caseNameFrom(const std::filesystem::path& source)
{
  const auto path = source.lexically_normal();
  std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
  removeEnding(name);
  if (!isUtf8(name))
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
  if (name.size() > kMaxLength)
  {
    std::size_t end = kMaxLength;
    while (end > 0 && isContinuation(name[end]))
      --end;
    name.resize(end);
  }
  const auto first = name.find_first_not_of(" .-");
  const auto last = name.find_last_not_of(" .");
  if (first == std::string::npos || last == std::string::npos)
    return "case";
  return name.substr(first, last - first + 1);
}

std::string freeCaseName(const library::Library& library, const std::string& name)
{
  std::string free = name;
  for (int n = 2; library.contains(free); ++n)
    free = name + " " + std::to_string(n);
  return free;
}

bool namesCase(const library::Library& library, const std::string& text)
{
  const auto cases = library.list();
  return std::any_of(cases.begin(), cases.end(),
                     [&text](const library::CaseSummary& one) { return one.name == text; });
}

} // namespace petrous::presenters
