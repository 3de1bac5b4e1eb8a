#include "FileHelpers.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <system_error>

#include <unistd.h>

#include <gdcmTrace.h>
#include <itkObjectFactory.h>
#include <itkOutputWindow.h>

#include "petrous/Core/InputFile.h"
#include "petrous/Core/Log.h"

namespace petrous::imaging
{

namespace
{

/// "nan" and "inf" are not accepted.
template <class T>
std::optional<T> finite(const std::optional<T>& value)
{
  return value && std::isfinite(*value) ? value : std::nullopt;
}

class LogWindow : public itk::OutputWindow
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(LogWindow);
  using Self = LogWindow;
  using Superclass = itk::OutputWindow;
  using Pointer = itk::SmartPointer<Self>;
  itkFactorylessNewMacro(Self);
  itkTypeMacro(LogWindow, OutputWindow);

  void DisplayText(const char* text) override { log(core::log::Level::Info, text); }
  void DisplayErrorText(const char* text) override { log(core::log::Level::Error, text); }
  void DisplayWarningText(const char* text) override { log(core::log::Level::Warning, text); }
  void DisplayGenericOutputText(const char* text) override { DisplayText(text); }
  void DisplayDebugText(const char* text) override { log(core::log::Level::Debug, text); }

protected:
  LogWindow() = default;

private:
  static void log(core::log::Level level, const char* text)
  {
    core::log::foreign(level, "ITK", text ? text : "");
  }
};

bool isSpace(char c)
{
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

} // namespace

void logToolkitMessages()
{
  itk::OutputWindow::SetInstance(LogWindow::New());
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
}

void fail(FileError::Reason reason, const std::filesystem::path& path, const std::string& text,
          core::Fault fault)
{
  std::string name = path.string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c < 32 || c == 127; }, '?');
  throw FileError(reason, name + ": " + text, fault);
}

std::string lowerName(const std::filesystem::path& path)
{
  std::string name = path.filename().string();
  for (char& c : name)
    if (c >= 'A' && c <= 'Z')
      c = static_cast<char>(c - 'A' + 'a');
  return name;
}

bool endsWith(std::string_view text, std::string_view end)
{
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

namespace
{

// Throws for an empty file.
core::InputFile opened(const std::filesystem::path& path)
try
{
  core::InputFile file(path);
  if (file.size() == 0)
    fail(FileError::Reason::Unreadable, path, "is empty; copy it again from where it came");
  return file;
}
catch (const core::InputFileError& error)
{
  using Reason = core::InputFileError::Reason;
  std::error_code ignored;
  if (error.reason == Reason::NotFound)
    fail(FileError::Reason::NotFound, path, "there is no such file; check the name");
  if (error.reason == Reason::NotRegular && std::filesystem::is_directory(path, ignored))
    fail(FileError::Reason::NotFound, path, "is a folder; name a file in it");
  if (error.reason == Reason::NotRegular)
    fail(FileError::Reason::Unreadable, path, "is not an ordinary file; name one that may be read");
  fail(FileError::Reason::Unreadable, path, "may not be opened; allow reading it");
}

} // namespace

std::optional<double> paddingIn(std::string_view text)
{
  const std::string start = std::string(kPaddingKey) + "=";
  return text.substr(0, start.size()) == start ? parseDouble(trimmed(text.substr(start.size())))
                                               : std::nullopt;
}

std::uintmax_t checkedFileSize(const std::filesystem::path& path)
{
  return opened(path).size();
}

std::string readWholeFile(const std::filesystem::path& path, const core::Progress& progress)
{
  constexpr std::uintmax_t kMaxWhole = std::uintmax_t{4} << 30;
  constexpr std::size_t kPart = std::size_t{16} << 20;
  const core::InputFile file = opened(path);
  const std::uintmax_t size = file.size();
  if (size > kMaxWhole)
    fail(FileError::Reason::Unsupported, path,
         "is " + roughText(static_cast<double>(size) / 1e9) +
             " GB large; a file of this kind is read up to 4.3 GB");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  for (std::size_t done = 0; done < bytes.size();)
  {
    progress.report(static_cast<double>(done) / static_cast<double>(size), "reading file");
    const ssize_t got = pread(file.descriptor(), &bytes[done], std::min(kPart, bytes.size() - done),
                              static_cast<off_t>(done));
    if (got <= 0 && !(got < 0 && errno == EINTR))
      fail(FileError::Reason::Unreadable, path, "broke off while it was read; check the disk");
    done += static_cast<std::size_t>(std::max<ssize_t>(got, 0));
  }
  return bytes;
}

std::string readBytes(const std::filesystem::path& path, std::uintmax_t limit)
try
{
  return opened(path).read(limit);
}
catch (const core::InputFileError&)
{
  fail(FileError::Reason::Unreadable, path, "broke off while it was read; check the disk");
}

std::filesystem::path detachedFile(const std::filesystem::path& header, const std::string& name,
                                   std::vector<std::string>& notes)
{
  const std::filesystem::path file = header.parent_path() / name;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    fail(FileError::Reason::NotFound, header,
         "is a header whose file of voxels is not there; keep both in one folder");
  // Absolute paths and those upwards are allowed, as in teem and MetaIO. Files may be links.
  const auto folderOf = [&error](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path).parent_path(), error);
  };
  const std::filesystem::path within = folderOf(file).lexically_relative(folderOf(header));
  const std::string note =
      "names a file of voxels that lies outside the folder of the header; check "
      "that it is the one that belongs to it";
  if ((within.empty() || *within.begin() == "..") &&
      std::find(notes.begin(), notes.end(), note) == notes.end())
    notes.push_back(note);
  return file;
}

std::string roughText(double value)
{
  return core::plainText(value, 4);
}

std::string dimsText(const std::vector<std::uint64_t>& dims)
{
  std::string text;
  for (const std::uint64_t n : dims)
    text += (text.empty() ? "" : " x ") + std::to_string(n);
  return text;
}

std::optional<double> parseDouble(std::string_view text)
{
  return finite(core::parseDouble(text));
}

std::optional<float> parseFloat(std::string_view text)
{
  return finite(core::parseFloat(text));
}

std::optional<std::int64_t> parseInteger(std::string_view text)
{
  if (!text.empty() && text.front() == '+')
    text.remove_prefix(1);
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end ? std::optional(value) : std::nullopt;
}

std::string_view trimmed(std::string_view text)
{
  while (!text.empty() && isSpace(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && isSpace(text.back()))
    text.remove_suffix(1);
  return text;
}

std::string_view takeWord(std::string_view& text)
{
  while (!text.empty() && isSpace(text.front()))
    text.remove_prefix(1);
  std::size_t length = 0;
  while (length < text.size() && !isSpace(text[length]))
    ++length;
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(length);
  return word;
}

std::string_view takeLine(std::string_view& text)
{
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (!line.empty() && line.back() == '\r')
    line.remove_suffix(1);
  return line;
}

} // namespace petrous::imaging
