#include "LabelTable.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include <nlohmann/json.hpp>

#include "DicomItem.h"
#include "FileHelpers.h"
#include "petrous/Core/AsciiCase.h"

namespace petrous::imaging
{

namespace
{

constexpr std::int64_t kLargestIndex = 65535;
constexpr std::size_t kMissing = static_cast<std::size_t>(-1);

/// Entries so far, with the line of each index.
class Entries
{
public:
  explicit Entries(LabelTable& table)
    : m_table(table)
  {
  }

  void problem(std::size_t line, const std::string& what)
  {
    m_table.problems.push_back((line == 0 ? "it " : "line " + std::to_string(line) + " ") + what);
  }

  void add(std::size_t line, std::int64_t index, volume::Segment segment)
  {
    // FreeSurfer's own table ends with a marker that no voxel can have.
    if (index == 999999 && segment.name == "SUSPICIOUS")
      return;
    if (index < 0 || index > kLargestIndex)
      return problem(line, "gives the index " + std::to_string(index) +
                               "; an index is a whole number from 0 to 65535");
    if (index == 0)
      return; // background
    if (segment.name.empty())
      return problem(line, "gives index " + std::to_string(index) + " no name");
    const auto [before, isNew] = m_lines.emplace(index, line);
    if (!isNew)
      return problem(
          line, "gives index " + std::to_string(index) + " a second name" +
                    (line == 0 ? std::string()
                               : " (the first is in line " + std::to_string(before->second) + ")") +
                    "; each index has one");
    segment.index = static_cast<std::uint16_t>(index);
    m_table.segments.push_back(std::move(segment));
  }

private:
  LabelTable& m_table;
  std::map<std::int64_t, std::size_t> m_lines;
};

/// Takes a name in quotes. A quote within it is written \" or "", and one that neither white space
/// nor the end follows is a part of it; a backslash before another one, \\, is one.
bool takeQuoted(std::string_view& line, std::string& name)
{
  if (line.empty() || line.front() != '"')
    return false;
  std::string text;
  for (std::size_t n = 1; n < line.size(); ++n)
  {
    const char next = n + 1 < line.size() ? line[n + 1] : ' ';
    if (line[n] == '\\' && (next == '"' || next == '\\') &&
        !(next == '"' && trimmed(line.substr(n + 2)).empty()))
      text += line[++n];
    else if (line[n] == '"' && next == '"')
      text += line[++n];
    else if (line[n] == '"' && (next == ' ' || next == '\t'))
    {
      name = trimmed(text);
      line.remove_prefix(std::min(n + 1, line.size()));
      return true;
    }
    else
      text += line[n];
  }
  return false;
}

std::vector<std::string_view> wordsIn(std::string_view line)
{
  std::vector<std::string_view> words;
  for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line))
    words.push_back(word);
  return words;
}

float byteColor(double value)
{
  return static_cast<float>(std::clamp(value / 255.0, 0.0, 1.0));
}

/// 3D Slicer and FreeSurfer: index name r g b [a] (0 to 255).
struct WordEntry
{
  std::size_t line = 0;
  std::int64_t index = 0;
  bool isQuoted = false;
  std::string name; ///< in quotes
  std::string_view rest;
  std::vector<std::string_view> words; ///< of `rest`
  std::size_t numbers = 0;             ///< of `words`, at the end

  double fromEnd(std::size_t n) const { return *parseDouble(words[words.size() - n]); }

  /// Four numbers behind a name without quotes: the first may belong to the name ("nerve 7").
  bool isAmbiguous() const { return !isQuoted && numbers == 4 && words.size() > 4; }
  /// Whether that number may be one: 1 to 99, as structures are numbered.
  bool mayEndInNumber() const
  {
    const double value = fromEnd(4);
    return value == std::floor(value) && value >= 1.0 && value <= 99.0;
  }
};

WordEntry wordEntry(std::string_view line)
{
  WordEntry entry;
  entry.rest = trimmed(line);
  entry.isQuoted = takeQuoted(entry.rest, entry.name);
  entry.words = wordsIn(entry.rest);
  while (entry.numbers < entry.words.size() && entry.numbers < 5 &&
         parseDouble(entry.words[entry.words.size() - 1 - entry.numbers]).has_value())
    ++entry.numbers;
  return entry;
}

/// Whether the comments of a table name the columns r, g, b, and then a (opacity).
std::optional<bool> statedOpacity(std::string_view text)
{
  while (!text.empty())
  {
    const std::string_view line = trimmed(takeLine(text));
    if (line.empty() || line.front() != '#')
      continue;
    std::vector<std::string> words;
    for (const std::string_view word : wordsIn(line))
    {
      std::string plain;
      for (const char c : word)
        if (std::isalpha(static_cast<unsigned char>(c)) != 0)
          plain += core::asciiLower(c);
      if (!plain.empty())
        words.push_back(std::move(plain));
    }
    for (std::size_t n = 0; n + 2 < words.size(); ++n)
      if ((words[n] == "r" && words[n + 1] == "g" && words[n + 2] == "b") ||
          (words[n] == "red" && words[n + 1] == "green" && words[n + 2] == "blue"))
        return n + 3 < words.size() &&
               (words[n + 3] == "a" || words[n + 3] == "alpha" || words[n + 3] == "opacity");
  }
  return std::nullopt;
}

/// Whether names that a number ends were read with it: the table has no column of opacity. Without
/// names of columns that is so if entries have no fourth number, or if the last numbers are no
/// opacity: not the same in all entries, or 0 in all. A number above 255 is no colour anyway.
bool namesEndInNumbers(const std::vector<WordEntry>& entries, std::optional<bool> stated)
{
  if (stated)
    return !*stated;
  bool areNumbered = true;
  bool isMixed = false;
  std::vector<double> last;
  for (const WordEntry& entry : entries)
    if (entry.isAmbiguous() && entry.index != 0)
    {
      areNumbered = areNumbered && entry.mayEndInNumber();
      last.push_back(entry.fromEnd(1));
    }
    else if (entry.numbers == 3)
      isMixed = true;
    else if (entry.numbers > 3 && entry.index != 0)
      return false; // with an opacity for sure
  if (last.empty() || isMixed)
    return isMixed;
  const bool areEqual = std::all_of(last.begin(), last.end(),
                                    [&last](double value) { return value == last.front(); });
  return areNumbered && (!areEqual || last.front() == 0.0);
}

std::optional<volume::Segment> slicerEntry(const WordEntry& entry, bool isNumbered)
{
  const std::vector<std::string_view>& words = entry.words;
  std::size_t numbers = std::min<std::size_t>(entry.numbers, 4); // of the colour
  if (numbers == 4 && !entry.isQuoted &&
      ((isNumbered && (entry.numbers > 4 || entry.mayEndInNumber())) ||
       (entry.isAmbiguous() && entry.fromEnd(4) > 255.0)))
    numbers = 3;
  const std::size_t first = words.size() - numbers;
  if (numbers < 3 || (entry.isQuoted ? first != 0 : first == 0))
    return std::nullopt;
  if (first > 0 && core::parseDouble(words[first - 1]).has_value() && entry.numbers < 4)
    return std::nullopt; // "nan", a colour and no part of the name
  volume::Segment segment;
  segment.name =
      entry.isQuoted
          ? entry.name
          : std::string(words[0].data(),
                        static_cast<std::size_t>(words[first - 1].data() - words[0].data()) +
                            words[first - 1].size());
  for (std::size_t c = 0; c < 3; ++c)
    segment.color[c] = byteColor(*parseDouble(words[first + c]));
  return segment;
}

/// ITK-SNAP: index r g b opacity visible mesh "name".
std::optional<volume::Segment> snapEntry(std::string_view line)
{
  volume::Segment segment;
  for (std::size_t column = 0; column < 6; ++column)
  {
    const auto value = parseDouble(takeWord(line));
    if (!value)
      return std::nullopt;
    if (column < 3)
      segment.color[column] = byteColor(*value);
  }
  line = trimmed(line);
  if (!takeQuoted(line, segment.name) || !trimmed(line).empty())
    return std::nullopt;
  return segment;
}

/// The cells of a row; quotes around a cell are taken off, and a doubled one in it is one.
std::vector<std::string> cellsOf(std::string_view line, char delimiter, bool& isQuoted)
{
  std::vector<std::string> cells(1);
  isQuoted = false;
  for (std::size_t n = 0; n < line.size(); ++n)
  {
    const char c = line[n];
    if (c == '"' && isQuoted && n + 1 < line.size() && line[n + 1] == '"')
    {
      cells.back() += c;
      ++n;
    }
    else if (c == '"' && (isQuoted || trimmed(cells.back()).empty()))
      isQuoted = !isQuoted;
    else if (c == delimiter && !isQuoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  for (std::string& cell : cells)
    cell = std::string(trimmed(cell));
  return cells;
}

std::vector<std::string> cellsOf(std::string_view line, char delimiter)
{
  bool isQuoted = false;
  return cellsOf(line, delimiter, isQuoted);
}

std::optional<double> cellNumber(std::string cell)
{
  std::replace(cell.begin(), cell.end(), ',', '.');
  return parseDouble(cell);
}

std::optional<std::int64_t> cellIndex(const std::string& cell)
{
  const auto number = cellNumber(cell); // "3.0" too, as tables of floats are written
  if (!number || *number != std::floor(*number) || std::abs(*number) > 1e15)
    return std::nullopt;
  return static_cast<std::int64_t>(*number);
}

/// Which cell of a row is what.
struct Columns
{
  char delimiter = '\0'; ///< 0: not such a table
  bool hasHeader = false;
  std::size_t index = kMissing, name = kMissing, color = kMissing;
  /// Another column that may be the index just as well, as where rows are numbered; and both
  /// titles.
  std::size_t otherIndex = kMissing;
  std::string indexTitle, otherTitle;
  std::array<std::size_t, 3> channels{kMissing, kMissing, kMissing};
};

/// Whether a line is a row of its own: with an index in its place, and all cells.
bool isRow(std::string_view line, const Columns& columns)
{
  bool isQuoted = false;
  const std::vector<std::string> cells = cellsOf(line, columns.delimiter, isQuoted);
  std::size_t last = std::max(columns.index, columns.name);
  for (const std::size_t column :
       {columns.color, columns.channels[0], columns.channels[1], columns.channels[2]})
    last = column == kMissing ? last : std::max(last, column);
  return !isQuoted && cells.size() > last && cellIndex(cells[columns.index]);
}

/// The cells of a line of `text`, and of the lines after it that a quoted cell goes on in, as
/// spreadsheets write a line break; adds those to `number`. nullopt: a quote is not closed, before
/// a row of its own or at all.
std::optional<std::vector<std::string>> takeCells(std::string_view line, std::string_view& text,
                                                  const Columns& columns, std::size_t& number)
{
  const char delimiter = columns.delimiter;
  bool isQuoted = false;
  std::vector<std::string> cells = cellsOf(line, delimiter, isQuoted);
  constexpr std::size_t kLongestRow = 1 << 16; // bytes; longer is a quote that nobody closed
  std::string_view rest = text;
  std::size_t more = 0;
  for (std::string row(line); isQuoted && !rest.empty() && row.size() < kLongestRow; ++more)
  {
    const std::string_view next = takeLine(rest);
    if (isRow(next, columns))
      return std::nullopt;
    row += ' ';
    row += next;
    if (next.find('"') == next.npos)
      continue;
    cells = cellsOf(row, delimiter, isQuoted);
  }
  if (isQuoted)
    return std::nullopt;
  text = rest;
  number += more;
  return cells;
}

/// Letters and digits of a header cell, in lower case.
std::string plainHeader(const std::string& cell)
{
  std::string plain;
  for (const char c : cell)
    if (const auto letter = static_cast<unsigned char>(c); std::isalnum(letter) != 0 || c == '#')
      plain += core::asciiLower(c);
  return plain;
}

std::size_t columnNamed(const std::vector<std::string>& header,
                        std::initializer_list<const char*> names)
{
  for (const char* name : names)
    for (std::size_t n = 0; n < header.size(); ++n)
      if (header[n] == name)
        return n;
  return kMissing;
}

bool readHeader(const std::vector<std::string>& cells, Columns& columns)
{
  std::vector<std::string> header;
  std::transform(cells.begin(), cells.end(), std::back_inserter(header), plainHeader);
  columns.index = columnNamed(header, {"labelvalue", "labelindex", "labelid", "labelnumber"});
  const bool isNamed = columns.index != kMissing;
  const std::initializer_list<const char*> numbers{"index", "value", "id", "idx", "number",
                                                   "no",    "nr",    "#",  "key"};
  if (!isNamed)
    columns.index = columnNamed(header, numbers);
  columns.name = columnNamed(header, {"name", "labelname", "structure", "structurename", "segment",
                                      "segmentname", "anatomy", "description", "text"});
  const std::size_t label = columnNamed(header, {"label"});
  if (columns.index == kMissing)
    columns.index = label;
  else if (columns.name == kMissing)
    columns.name = label;
  if (!isNamed && columns.index != kMissing)
    for (std::size_t n = 0; n < header.size() && columns.otherIndex == kMissing; ++n)
      if (n != columns.index && n != columns.name &&
          (n == label || columnNamed({header[n]}, numbers) == 0))
      {
        columns.otherIndex = n;
        columns.indexTitle = cells[columns.index];
        columns.otherTitle = cells[n];
      }
  columns.channels = {columnNamed(header, {"r", "red", "colorr"}),
                      columnNamed(header, {"g", "green", "colorg"}),
                      columnNamed(header, {"b", "blue", "colorb"})};
  columns.color = columnNamed(header, {"color", "colour", "rgb", "hex", "hexcolor"});
  return columns.index != kMissing && columns.name != kMissing && columns.index != columns.name;
}

/// The columns by the first row that is no comment; a header may stand behind '#'.
Columns columnsOf(std::string_view text)
{
  while (!text.empty())
  {
    std::string_view line = trimmed(takeLine(text));
    const bool isComment = !line.empty() && line.front() == '#';
    if (isComment)
      line.remove_prefix(1);
    if (trimmed(line).empty())
      continue;
    for (const char delimiter : {'\t', ';', ','})
    {
      bool isQuoted = false;
      std::vector<std::string> cells = cellsOf(line, delimiter, isQuoted);
      Columns columns;
      columns.delimiter = delimiter;
      if (isQuoted) // a name of several lines
      {
        Columns named = columns;
        named.index = 0;
        named.name = 1;
        std::string_view rest = text;
        std::size_t number = 0;
        cells = takeCells(line, rest, named, number).value_or(cells);
      }
      if (cells.size() < 2)
        continue;
      columns.hasHeader = readHeader(cells, columns);
      if (columns.hasHeader)
        return columns;
      if (isComment || !cellIndex(cells[0]))
        continue;
      columns = {};
      columns.delimiter = delimiter;
      columns.index = 0;
      columns.name = 1;
      if (cells.size() >= 5 && cellNumber(cells[2]))
        columns.channels = {2, 3, 4};
      else if (cells.size() >= 3)
        columns.color = 2;
      // "1<tab>255 .." of ITK-SNAP has no name in its second cell.
      if (!cellNumber(cells[1]))
        return columns;
    }
    if (!isComment)
      return {};
  }
  return {};
}

/// "#rrggbb", with or without '#'; or three numbers. In 0 to 255.
bool readColor(const std::string& cell, std::array<double, 3>& color)
{
  std::string_view digits = cell;
  if (!digits.empty() && digits.front() == '#')
    digits.remove_prefix(1);
  if (digits.size() == 6 && std::all_of(digits.begin(), digits.end(),
                                        [](unsigned char c) { return std::isxdigit(c) != 0; }))
  {
    for (std::size_t c = 0; c < 3; ++c)
      color[c] = std::stoi(std::string(digits.substr(2 * c, 2)), nullptr, 16);
    return true;
  }
  std::string plain = cell;
  for (char& c : plain)
    if (std::string_view("()[],;").find(c) != std::string_view::npos)
      c = ' ';
  const std::vector<std::string_view> words = wordsIn(plain);
  for (std::size_t c = 0; c < 3; ++c)
  {
    const auto value = c < words.size() ? parseDouble(words[c]) : std::nullopt;
    if (!value)
      return false;
    color[c] = *value;
  }
  return true;
}

void readRows(std::string_view text, const Columns& columns, Entries& entries, LabelTable& table)
{
  std::vector<std::array<double, 3>> colors; // of the segments added, as written
  double largest = 0.0;
  bool isFirst = columns.hasHeader;
  bool areNumbers = columns.otherIndex != kMissing; // the cells of that column
  std::optional<std::pair<std::size_t, std::string>> contradiction;
  for (std::size_t number = 1; !text.empty(); ++number)
  {
    std::string_view line = takeLine(text);
    if (trimmed(line).empty())
      continue;
    if (isFirst) // the header, which may stand behind '#' below other comments
    {
      std::string_view head = trimmed(line);
      if (head.front() == '#')
        head.remove_prefix(1);
      Columns again;
      isFirst = !readHeader(cellsOf(head, columns.delimiter), again);
      continue;
    }
    if (trimmed(line).front() == '#')
      continue;
    const std::size_t first = number;
    const auto row = takeCells(line, text, columns, number);
    if (!row)
    {
      entries.problem(first, "opens a quote that is not closed");
      return;
    }
    const std::vector<std::string>& cells = *row;
    if (std::all_of(cells.begin(), cells.end(),
                    [](const std::string& cell) { return cell.empty(); }))
      continue; // as spreadsheets end a sheet
    const auto cell = [&cells](std::size_t column)
    { return column < cells.size() ? cells[column] : std::string(); };
    const auto index = cellIndex(cell(columns.index));
    if (!index)
    {
      entries.problem(first, "gives an index that is not a whole number from 0 to 65535");
      continue;
    }
    if (columns.otherIndex != kMissing)
    {
      const auto other = parseInteger(cell(columns.otherIndex));
      areNumbers = areNumbers && other;
      if (other && *other != *index && !contradiction)
        contradiction = {first, "gives the index " + std::to_string(*index) + " in column '" +
                                    columns.indexTitle + "' and " + std::to_string(*other) +
                                    " in column '" + columns.otherTitle +
                                    "'; keep the one that the voxels have"};
    }
    volume::Segment segment;
    segment.name = cell(columns.name);
    std::array<double, 3> color{};
    bool isBad = false;
    if (columns.channels[0] != kMissing && columns.channels[1] != kMissing &&
        columns.channels[2] != kMissing)
      for (std::size_t c = 0; c < 3; ++c)
      {
        const std::string& text_ = cell(columns.channels[c]);
        const auto value = text_.empty() ? std::optional(0.0) : cellNumber(text_);
        isBad = isBad || !value;
        color[c] = value.value_or(0.0);
      }
    else if (const std::string text_ = cell(columns.color); !text_.empty())
      isBad = !readColor(text_, color);
    for (const double channel : color)
      isBad = isBad || !(channel >= 0.0 && channel <= 255.0);
    if (isBad)
    {
      entries.problem(first, "gives a colour that is neither three numbers from 0 to 255 (or 0 to "
                             "1) nor #rrggbb");
      continue;
    }
    const std::size_t before = table.segments.size();
    entries.add(first, *index, std::move(segment));
    if (table.segments.size() == before)
      continue;
    colors.push_back(color);
    largest = std::max({largest, color[0], color[1], color[2]});
  }
  if (areNumbers && contradiction)
    entries.problem(contradiction->first, contradiction->second);
  const double scale = largest > 1.0 ? 255.0 : 1.0;
  for (std::size_t n = 0; n < colors.size(); ++n)
    for (std::size_t c = 0; c < 3; ++c)
      table.segments[n].color[c] = static_cast<float>(colors[n][c] / scale);
}

void readWordLines(std::string_view whole, Entries& entries, LabelTable& table)
{
  const auto forEachEntry = [whole](const auto& visit)
  {
    std::string_view text = whole;
    for (std::size_t number = 1; !text.empty(); ++number)
    {
      std::string_view line = trimmed(takeLine(text));
      if (line.empty() || line.front() == '#')
        continue;
      const auto index = parseInteger(takeWord(line));
      visit(number, index, line);
    }
  };
  std::vector<WordEntry> words; // of 3D Slicer and FreeSurfer
  forEachEntry(
      [&](std::size_t number, const auto& index, std::string_view line)
      {
        if (!index || snapEntry(line))
          return;
        words.push_back(wordEntry(line));
        words.back().line = number;
        words.back().index = *index;
      });
  const bool isNumbered = namesEndInNumbers(words, statedOpacity(whole));
  std::string example; // of a name that would be another with an opacity
  std::size_t next = 0;
  forEachEntry(
      [&](std::size_t number, const auto& index, std::string_view line)
      {
        if (!index)
          return entries.problem(number,
                                 "does not start with an index; an entry is index, name, r, g, b");
        const bool isWords = next < words.size() && words[next].line == number;
        auto segment = isWords ? slicerEntry(words[next], isNumbered) : snapEntry(line);
        if (!segment)
          entries.problem(number, "is no entry; it needs index, name and the colour r, g, b");
        else
        {
          if (isWords && isNumbered && words[next].isAmbiguous() && example.empty() && *index != 0)
            example = segment->name;
          entries.add(number, *index, std::move(*segment));
        }
        next += isWords ? 1 : 0;
      });
  if (!example.empty())
    table.notes.push_back("the table of names has no column of opacity, so a number before the "
                          "colour was read as part of the name ('" +
                          example + "')");
}

/// The line of the `occurrence`th "key": of a JSON text, from 1; 0: it is written otherwise.
std::size_t lineOfKey(std::string_view text, const std::string& key, int occurrence = 1)
{
  const std::string quoted = nlohmann::json(key).dump();
  for (std::size_t at = text.find(quoted); at != text.npos; at = text.find(quoted, at + 1))
  {
    const std::size_t next = text.find_first_not_of(" \t\r\n", at + quoted.size());
    if (next != text.npos && text[next] == ':' && --occurrence == 0)
      return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + at, '\n'));
  }
  return 0;
}

void readJson(std::string_view text, Entries& entries)
{
  using nlohmann::json;
  const char* const right = "; {\"1\": \"name\"} or {\"name\": 1} would be right";
  json document;
  std::vector<std::set<std::string>> keys; // of the objects that are open
  std::optional<std::string> twice;
  const auto note = [&](int, json::parse_event_t event, json& parsed)
  {
    if (event == json::parse_event_t::object_start)
      keys.emplace_back();
    else if (event == json::parse_event_t::object_end)
      keys.pop_back();
    else if (event == json::parse_event_t::key && !twice &&
             !keys.back().insert(parsed.get<std::string>()).second)
      twice = parsed.get<std::string>();
    return true;
  };
  try
  {
    document = json::parse(text, note);
  }
  catch (const json::parse_error& error)
  {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
    return entries.problem(line, std::string("is not valid JSON") + right);
  }
  catch (const json::exception&) // of a number beyond double
  {
    return entries.problem(0, std::string("has a number that is beyond all that is read") + right);
  }
  const auto inner = document.find("labels");
  const json& map = inner != document.end() && inner->is_object() ? *inner : document;
  std::vector<std::pair<std::int64_t, volume::Segment>> found;
  for (const auto& [key, value] : map.items())
  {
    volume::Segment segment;
    std::optional<std::int64_t> index;
    if (value.is_string())
    {
      index = parseInteger(key);
      segment.name = value.get<std::string>();
    }
    else if (value.is_number_integer())
    {
      index = value.get<std::int64_t>();
      segment.name = key;
    }
    if (!index) // such files lie beside images for other reasons: all or nothing
      return entries.problem(lineOfKey(text, key),
                             std::string("is no entry of a table of names") + right);
    found.emplace_back(*index, std::move(segment));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [index, segment] : found)
  {
    std::size_t line = lineOfKey(text, segment.name);
    if (line == 0)
      line = lineOfKey(text, std::to_string(index));
    entries.add(line, index, std::move(segment));
  }
  if (twice)
    entries.problem(lineOfKey(text, *twice, 2),
                    "gives '" + *twice +
                        "' a second time; each name has one index, and each "
                        "index one name");
}

} // namespace

LabelTable parseTable(std::string_view text)
{
  LabelTable table;
  Entries entries(table);
  if (text.substr(0, 2) == "\xff\xfe" || text.substr(0, 2) == "\xfe\xff")
  {
    entries.problem(0, "is text in UTF-16; save it as UTF-8");
    return table;
  }
  std::string recoded;
  if (text.substr(0, 3) == "\xef\xbb\xbf")
    text.remove_prefix(3);
  if (!core::isUtf8(text))
  {
    recoded = toUtf8(std::string(text), "ISO_IR 100");
    text = recoded;
    table.notes.push_back("the table of names is not in UTF-8 and was read as Latin-1");
  }
  if (const std::string_view start = trimmed(text); !start.empty() && start.front() == '{')
    readJson(start, entries);
  else if (const Columns columns = columnsOf(text); columns.delimiter != '\0')
    readRows(text, columns, entries, table);
  else
    readWordLines(text, entries, table);
  return table;
}

LabelTable readLabelTable(const std::filesystem::path& path)
{
  if (checkedFileSize(path) > kLargestTable)
    fail(FileError::Reason::Unsupported, path,
         "is too large for a table of names; give a colour table, a label description or a CSV");
  LabelTable table = parseTable(readBytes(path, kLargestTable));
  // A file of another kind fails in its first line, and is not to be told of one bad entry.
  if (table.segments.empty())
    fail(FileError::Reason::Unreadable, path,
         "holds no names of label values" +
             (table.problems.empty() ? std::string() : ": " + table.problems.front()) +
             "; a 3D Slicer colour table, an ITK-SNAP label description or a CSV with the columns "
             "index and name would be right");
  if (!table.problems.empty())
  {
    // "line 3 gives ..", or "it gives .." of a table without lines
    const std::string& problem = table.problems.front();
    fail(FileError::Reason::Unreadable, path,
         problem.compare(0, 3, "it ") == 0 ? problem.substr(3) : "its " + problem);
  }
  return table;
}

std::vector<volume::Segment> parseLabelTable(const std::string& text)
{
  return parseTable(text).segments;
}

} // namespace petrous::imaging
