#include "NrrdHeader.h"

#include <algorithm>

#include "FileHelpers.h"

namespace petrous::imaging
{

namespace
{

constexpr std::uintmax_t kLargestHeader = std::uintmax_t{16} << 20;

std::string vectorText(const Eigen::Vector3d& v)
{
  return "(" + exactText(v[0]) + "," + exactText(v[1]) + "," + exactText(v[2]) + ")";
}

const std::string* find(const std::vector<std::pair<std::string, std::string>>& list,
                        const std::string& name)
{
  const auto at = std::find_if(list.begin(), list.end(),
                               [&name](const auto& entry) { return entry.first == name; });
  return at == list.end() ? nullptr : &at->second;
}

std::string unescaped(std::string_view text)
{
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    if (text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == 'n' || text[i + 1] == '\\'))
      result += text[++i] == 'n' ? '\n' : '\\';
    else
      result += text[i];
  }
  return result;
}

} // namespace

std::string nrrdHeaderText(const core::GridGeometry& geometry, const std::string& type,
                           const std::string& encoding, std::size_t layers)
{
  const auto& n = geometry.dims();
  const Eigen::Matrix3d& step = geometry.patientFromVoxelLinear();
  const bool isList = layers != 1;
  return "NRRD0004\n"
         "# Complete NRRD file format specification at:\n"
         "# http://teem.sourceforge.net/nrrd/format.html\n"
         "type: " +
         type + "\ndimension: " + (isList ? "4" : "3") +
         "\nspace: left-posterior-superior\nsizes: " +
         (isList ? std::to_string(layers) + " " : "") + std::to_string(n[0]) + " " +
         std::to_string(n[1]) + " " + std::to_string(n[2]) +
         "\nspace directions: " + (isList ? "none " : "") + vectorText(step.col(0)) + " " +
         vectorText(step.col(1)) + " " + vectorText(step.col(2)) +
         "\nkinds: " + (isList ? "list " : "") +
         "domain domain domain\nspace units: \"mm\" \"mm\" \"mm\"\nendian: little\n"
         "encoding: " +
         encoding + "\nspace origin: " + vectorText(geometry.origin()) + "\n";
}

std::string nrrdKeyText(const std::string& key, const std::string& value)
{
  std::string line = key + ":=";
  for (const char c : value)
  {
    if (c == '\n')
      line += "\\n";
    else if (c == '\\')
      line += "\\\\";
    else if (c != '\r')
      line += c;
  }
  return line + "\n";
}

const std::string* NrrdHeader::field(const std::string& name) const
{
  return find(fields, name);
}

const std::string* NrrdHeader::key(const std::string& name) const
{
  const auto at = byName.find(name);
  return at == byName.end() ? nullptr : &keys[at->second].second;
}

NrrdHeader readNrrdHeader(const std::filesystem::path& path)
{
  if (readBytes(path, 7) != "NRRD000")
    failFormat(path, "NRRD");
  // Headers are short; even with many structures and colours below a few hundred KiB.
  const std::uintmax_t size = checkedFileSize(path);
  std::string bytes;
  std::size_t end = std::string::npos;
  std::size_t skip = 0;
  for (std::uintmax_t part = 4096; end == std::string::npos; part *= 8)
  {
    bytes = readBytes(path, part);
    const std::size_t unixEnd = bytes.find("\n\n");
    const std::size_t dosEnd = bytes.find("\n\r\n");
    end = std::min(unixEnd, dosEnd);
    skip = unixEnd <= dosEnd ? 2 : 3;
    if (end == std::string::npos && (part >= size || part >= kLargestHeader))
      break;
  }
  NrrdHeader header;
  header.dataOffset = end == std::string::npos ? bytes.size() : end + skip;
  const bool detached = endsWith(lowerName(path), ".nhdr");
  if (end == std::string::npos && (!detached || size > kLargestHeader))
    fail(FileError::Reason::Unreadable, path,
         "its NRRD header does not end; copy it again from where it came");

  std::string_view text = std::string_view(bytes).substr(0, std::min(end, bytes.size()));
  takeLine(text);
  while (!text.empty())
  {
    const std::string_view line = takeLine(text);
    if (line.empty() || line.front() == '#')
      continue;
    // Names of data files follow "data file: LIST" to the end of the header, one a line.
    if (const std::string* list = header.field("data file"); list && list->rfind("LIST", 0) == 0)
    {
      header.dataFiles.emplace_back(trimmed(line));
      continue;
    }
    // A key contains no colon; a key/value pair differs from a field by ":=".
    const std::size_t colon = line.find(':');
    const bool pair = colon != line.npos && colon + 1 < line.size() && line[colon + 1] == '=';
    if (pair)
    {
      header.keys.emplace_back(line.substr(0, colon), unescaped(line.substr(colon + 2)));
      header.byName.emplace(header.keys.back().first,
                            header.keys.size() - 1); // the first of equals
      continue;
    }
    if (colon == line.npos)
      fail(FileError::Reason::Unreadable, path,
           "its NRRD header has a line that is not a field; copy it again from where it came");
    std::string name(trimmed(line.substr(0, colon)));
    for (char& c : name)
      if (c >= 'A' && c <= 'Z')
        c = static_cast<char>(c - 'A' + 'a');
    if (name == "datafile")
      name = "data file";
    const std::string value(trimmed(line.substr(colon + 1)));
    if (const std::string* other = header.field(name); other && *other != value)
      fail(FileError::Reason::Unreadable, path,
           "its NRRD header has a field twice, with another value each; export it again");
    header.fields.emplace_back(name, value);
  }
  return header;
}

} // namespace petrous::imaging
