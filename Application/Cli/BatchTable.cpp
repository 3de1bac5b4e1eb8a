#include "BatchTable.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string_view>

#include "Context.h"
#include "Numbers.h"
#include "petrous/Core/CsvTable.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/ObjectStore.h"
#include "petrous/Scene/Case.h"
#include "petrous/Scene/FreeName.h"

namespace petrous::cli
{

namespace fs = std::filesystem;

namespace
{

constexpr std::uintmax_t kLargestTable = std::uintmax_t{1} << 26;
constexpr const char* kByteOrderMark = "\xef\xbb\xbf";

/// Which step a column is for: what it is keyed by.
enum class Step
{
  None,
  Build,
  Describe
};

struct Column
{
  const char* name;
  Step step;
  const char* text;
};

constexpr std::array<Column, 41> kColumns{{
    {"name", Step::None, "the case's name (needed)"},
    {"folder", Step::Build, "CT: DICOM folder or image file; blank: the case is there already"},
    {"series", Step::Build, "which series of the folder: UID or UID#VOLUME; of a file #VOLUME"},
    {"modality", Step::Build, "CT or MR, if the file does not say"},
    {"ct_frame", Step::Build, "lps or ras, if an image file does not say which side is left"},
    {"mr_frame", Step::Build, "likewise, of the MR"},
    {"mr_roi", Step::Build, "x0,x1,y0,y1,z0,z1 in LPS mm of each MR"},
    {"labels_frame", Step::Build, "likewise, of the labels that do not have the CT's grid"},
    {"ct_axes", Step::Build, "where the axes L, P, S that its file states really point, as RPS"},
    {"mr_axes", Step::Build, "likewise, of the MR"},
    {"labels_axes", Step::Build, "likewise, of the labels; blank: with their image"},
    {"ct_unit", Step::Build, "mm, cm, m or um, if an image file states none or a wrong one"},
    {"mr_unit", Step::Build, "likewise, of the MR"},
    {"labels_unit", Step::Build, "likewise, of the labels"},
    {"labels_as_they_lie", Step::Build,
     "yes or no: add labels on another grid than a repaired CT where they lie"},
    {"bits", Step::Build, "stored or allocated, where bits of DICOM pixels are not declared"},
    {"roi", Step::Build, "x0,x1,y0,y1,z0,z1 in patient LPS mm"},
    {"repair", Step::Build, "yes or no: resample tilted, uneven or gapped slices"},
    {"mr", Step::Build, "[NAME=]PATH[#UID[#VOLUME]], several with |"},
    {"other_patient", Step::Build, "yes or no: add an MR or structures that state another patient"},
    {"labels", Step::Build, "[NAME=]FILE[@MR], several with |"},
    {"skip_taken", Step::Build, "yes or no: leave out structures whose names are taken"},
    {"rename_taken", Step::Build, "yes or no: number those whose names are taken, meshes too"},
    {"label_names", Step::Build, "table of the names of the labels"},
    {"meshes", Step::Build, "[NAME=]FILE[@MR], several with |"},
    {"mesh_frame", Step::Build, "lps or ras, if the meshes' files do not say"},
    {"mesh_axes", Step::Build, "as ct_axes, of the meshes; LPS: they lie where they belong"},
    {"mesh_unit", Step::Build, "mm, cm, m, um or inch, if the meshes' files do not say"},
    {"mesh_parts", Step::Build, "yes or no: each object of a mesh file is a structure of its own"},
    {"tags", Step::Describe, "several with |"},
    {"note", Step::Describe, "free text"},
    {"diagnosis", Step::Describe, "a line"},
    {"procedure", Step::Describe, "a line"},
    {"side", Step::Describe, "left, right, both or unknown"},
    {"date", Step::Describe, "of the planned operation, YYYY-MM-DD"},
    {"register", Step::None, "yes or no: every MR that is not registered"},
    {"archive", Step::None, "file NAME.petrous, or a folder"},
    {"mask_face", Step::None, "yes or no: air in place of the face in what is archived and sent"},
    {"without_notes", Step::None, "yes or no: the note stays"},
    {"with_videos", Step::None, "yes or no: attached videos go along"},
    {"with_documents", Step::None, "yes or no: attached PDFs go along"},
}};
constexpr const char* kSend = "send"; // the last one, a node

std::string trimmed(const std::string& text)
{
  constexpr const char* kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  return first == text.npos ? std::string()
                            : text.substr(first, text.find_last_not_of(kBlank) + 1 - first);
}

std::string lower(const std::string& text)
{
  return CLI::detail::to_lower(text);
}

[[noreturn]] void refuse(const fs::path& file, std::size_t line, const std::string& what)
{
  throw core::InvalidParameter(core::printable(file) + ", line " + std::to_string(line) + ": " +
                               what);
}

using core::CsvRow;

bool isBlank(const CsvRow& row)
{
  return std::all_of(row.cells.begin(), row.cells.end(),
                     [](const std::string& cell) { return cell.empty(); });
}

std::vector<std::string> split(const std::string& cell)
{
  std::vector<std::string> values;
  for (std::size_t from = 0; from <= cell.size();)
  {
    const std::size_t to = std::min(cell.find('|', from), cell.size());
    if (std::string value = trimmed(cell.substr(from, to - from)); !value.empty())
      values.push_back(std::move(value));
    from = to + 1;
  }
  return values;
}

bool isYes(const std::string& column, const std::string& cell)
{
  const std::string text = lower(cell);
  for (const char* yes : {"yes", "y", "true", "1", "ja", "wahr"})
    if (text == yes)
      return true;
  for (const char* no : {"", "no", "n", "false", "0", "nein", "falsch"})
    if (text == no)
      return false;
  throw core::InvalidParameter("'" + column + "' is yes or no, not '" + cell + "'");
}

/// Cells of a row by column.
using Cells = std::map<std::string, std::string>;

std::string keyOf(const Cells& cells, Step step, const fs::path& folder)
{
  // The table's folder is what relative paths mean.
  std::string text = step == Step::Build ? folder.string() : std::string();
  for (const Column& column : kColumns)
    if (const auto cell = cells.find(column.name);
        cell != cells.end() && (column.step == step || cell->first == "name"))
      text += '\0' + cell->first + '\0' + cell->second;
  return library::sha256Of(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

class RowReader
{
public:
  RowReader(fs::path folder, Cells cells)
    : m_folder(std::move(folder))
    , m_cells(std::move(cells))
  {
  }

  void read(BatchRow& row) const
  {
    row.name = cell("name");
    if (row.name.empty())
      throw core::InvalidParameter("the row has no name; every case needs one");
    scene::checkCaseName(row.name);
    row.buildKey = keyOf(m_cells, Step::Build, m_folder);
    row.describeKey = keyOf(m_cells, Step::Describe, m_folder);
    if (!cell("folder").empty())
      row.sources = sources();
    else
      for (const Column& column : kColumns)
        if (column.step == Step::Build && !cell(column.name).empty())
          throw core::InvalidParameter(std::string("'") + column.name +
                                       "' goes with 'folder', which is blank");
    row.registers = isYes("register", cell("register"));
    row.node = cell(kSend);
    if (const std::string& archive = cell("archive"); !archive.empty())
    {
      row.archive = at(archive);
      if (!row.archive.has_filename() || fs::is_directory(row.archive))
        row.archive /= row.name + library::kArchiveEnding;
    }
    for (const auto& [column, chosen] :
         {std::pair("mask_face", &row.masksFace), std::pair("without_notes", &row.withoutNotes),
          std::pair("with_videos", &row.withVideos),
          std::pair("with_documents", &row.withDocuments)})
    {
      *chosen = isYes(column, cell(column));
      if (*chosen && row.archive.empty() && row.node.empty())
        throw core::InvalidParameter(std::string("'") + column +
                                     "' goes with 'archive' or 'send', which are blank");
    }
    const auto given = [this](const char* column) -> std::optional<std::string>
    { return cell(column).empty() ? std::nullopt : std::optional(cell(column)); };
    row.tags = split(cell("tags"));
    row.note = given("note");
    if (row.note)
      row.note->erase(std::remove(row.note->begin(), row.note->end(), '\r'), row.note->end());
    row.diagnosis = given("diagnosis");
    row.procedure = given("procedure");
    row.date = given("date");
    if (!cell("side").empty())
      row.side = scene::sideFromName(lower(cell("side")));
    scene::Description check;
    row.describe(check);
  }

private:
  const std::string& cell(const std::string& column) const
  {
    static const std::string none;
    const auto found = m_cells.find(column);
    return found == m_cells.end() ? none : found->second;
  }

  fs::path at(const fs::path& path) const { return (m_folder / path).lexically_normal(); }

  std::vector<presenters::PartSource>
  parts(const char* column,
        const std::function<presenters::PartSource(const std::string&)>& parse) const
  {
    std::vector<presenters::PartSource> result;
    for (const std::string& text : split(cell(column)))
    {
      // A whole path wins over NAME=PATH, also where it is relative.
      std::error_code error;
      result.push_back(parse(fs::exists(at(text), error) ? at(text).string() : text));
      result.back().path = at(result.back().path);
    }
    return result;
  }

  // Whether a column says RAS (else LPS); nullopt: it is blank.
  std::optional<bool> frame(const std::string& column) const
  {
    const std::string text = lower(cell(column));
    if (!text.empty() && text != "lps" && text != "ras")
      throw core::InvalidParameter("'" + column + "' is lps or ras, not '" + cell(column) + "'");
    return text.empty() ? std::nullopt : std::optional<bool>(text == "ras");
  }

  // nullopt: the column is blank.
  std::optional<core::AxesCorrection> axes(const std::string& column) const
  {
    if (cell(column).empty())
      return std::nullopt;
    try
    {
      return parseAxes(cell(column), "'" + column + "'");
    }
    catch (const UsageError& error)
    {
      throw core::InvalidParameter(error.what());
    }
  }

  // Of several texts one; empty: it is blank.
  std::string oneOf(const std::string& column, const std::vector<std::string>& texts) const
  {
    const std::string text = lower(cell(column));
    if (!text.empty() && std::find(texts.begin(), texts.end(), text) == texts.end())
    {
      std::string all;
      for (const std::string& one : texts)
        all += (all.empty() ? "" : one == texts.back() ? " or " : ", ") + one;
      throw core::InvalidParameter("'" + column + "' is " + all + ", not '" + cell(column) + "'");
    }
    return text;
  }

  // A unit of length in mm.
  std::optional<double> unit(const std::string& column,
                             const std::vector<std::string>& units = {"mm", "cm", "m", "um", "nm",
                                                                      "inch"}) const
  {
    const std::string text = oneOf(column, units);
    return text.empty() ? std::nullopt : std::optional<double>(millimetresOf(text));
  }

  // A box in mm; nullopt: the column is blank.
  std::optional<core::PatientBox> box(const std::string& column) const
  {
    if (cell(column).empty())
      return std::nullopt;
    try
    {
      return parseBox(cell(column), "'" + column + "'");
    }
    catch (const UsageError& error)
    {
      throw core::InvalidParameter(error.what());
    }
  }

  presenters::CaseSources sources() const
  {
    presenters::CaseSources sources;
    sources.ct = at(cell("folder"));
    sources.series = cell("series");
    sources.repair = isYes("repair", cell("repair"));
    const std::string modality = lower(cell("modality"));
    if (!modality.empty() && modality != "ct" && modality != "mr")
      throw core::InvalidParameter("'modality' is CT or MR, not '" + cell("modality") + "'");
    sources.modality = modality == "mr"   ? scene::Modality::Mr
                       : modality == "ct" ? scene::Modality::Ct
                                          : scene::Modality::Unknown;
    sources.assumeRas = frame("ct_frame");
    sources.axes = axes("ct_axes").value_or(core::AxesCorrection());
    sources.unit = unit("ct_unit");
    sources.undeclaredBits = undeclaredBitsOf(oneOf("bits", {"stored", "allocated"}));
    sources.roi = box("roi");
    sources.parts.mr = parts("mr", presenters::PartSource::parseSeries);
    for (presenters::PartSource& mr : sources.parts.mr)
    {
      mr.repair = sources.repair;
      mr.roi = box("mr_roi");
      mr.assumeRas = frame("mr_frame");
      mr.axes = axes("mr_axes");
      mr.unit = unit("mr_unit");
      mr.undeclaredBits = sources.undeclaredBits;
      mr.isOtherPatient = isYes("other_patient", cell("other_patient"));
    }
    sources.parts.labels = parts("labels", presenters::PartSource::parseDrawn);
    for (presenters::PartSource& labels : sources.parts.labels)
    {
      labels.assumeRas = frame("labels_frame");
      labels.axes = axes("labels_axes");
      labels.unit = unit("labels_unit");
      labels.asTheyLie = isYes("labels_as_they_lie", cell("labels_as_they_lie"));
      labels.isOtherPatient = isYes("other_patient", cell("other_patient"));
      labels.skipsTaken = isYes("skip_taken", cell("skip_taken"));
      labels.numbersTaken = isYes("rename_taken", cell("rename_taken"));
    }
    if (isYes("skip_taken", cell("skip_taken")) && isYes("rename_taken", cell("rename_taken")))
      throw core::InvalidParameter("'skip_taken' and 'rename_taken' exclude each other");
    if (!cell("label_names").empty())
      sources.parts.labelNames = at(cell("label_names"));
    if (!cell("label_names").empty() && sources.parts.labels.empty())
      throw core::InvalidParameter("'label_names' goes with 'labels', which is blank");
    sources.parts.meshes = parts("meshes", presenters::PartSource::parseDrawn);
    if (isYes("mesh_parts", cell("mesh_parts")) && sources.parts.meshes.empty())
      throw core::InvalidParameter("'mesh_parts' goes with 'meshes', which is blank");
    for (const char* column : {"mesh_frame", "mesh_axes", "mesh_unit"})
      if (!cell(column).empty() && sources.parts.meshes.empty())
        throw core::InvalidParameter(std::string("'") + column +
                                     "' goes with 'meshes', which is blank");
    for (presenters::PartSource& mesh : sources.parts.meshes)
    {
      mesh.isRas = frame("mesh_frame");
      mesh.axes = axes("mesh_axes");
      mesh.unit = unit("mesh_unit", {"mm", "cm", "m", "um", "inch"});
      mesh.isPerObject = isYes("mesh_parts", cell("mesh_parts"));
      mesh.skipsTaken = isYes("skip_taken", cell("skip_taken"));
      mesh.numbersTaken = isYes("rename_taken", cell("rename_taken"));
    }
    return sources;
  }

  fs::path m_folder;
  Cells m_cells;
};

std::vector<std::string> columnNames()
{
  std::vector<std::string> names;
  for (const Column& column : kColumns)
    names.emplace_back(column.name);
  names.emplace_back(kSend);
  return names;
}

// Names of the columns, "" for those without one.
std::vector<std::string> readHeader(const fs::path& file, const CsvRow& row)
{
  const std::vector<std::string> known = columnNames();
  std::vector<std::string> header;
  for (const std::string& cell : row.cells)
  {
    std::string name = lower(cell);
    std::replace(name.begin(), name.end(), ' ', '_');
    if (!name.empty() && std::find(known.begin(), known.end(), name) == known.end())
      refuse(file, row.line,
             "there is no column '" + cell + "'; columns are " + CLI::detail::join(known, ", "));
    if (!name.empty() && std::find(header.begin(), header.end(), name) != header.end())
      refuse(file, row.line, "column '" + name + "' is there twice");
    header.push_back(std::move(name));
  }
  if (std::find(header.begin(), header.end(), "name") == header.end())
    refuse(file, row.line,
           "there is no column 'name'; the first row names the columns, which are " +
               CLI::detail::join(known, ", "));
  return header;
}

void refuseOtherEncodings(const fs::path& file, std::string_view text)
{
  constexpr const char* kSaveAs = "save the table as 'CSV UTF-8'";
  if (text.substr(0, 2) == "\xff\xfe" || text.substr(0, 2) == "\xfe\xff")
    throw core::InvalidParameter(core::printable(file) + ": is UTF-16; " + kSaveAs);
  if (core::isUtf8(text) && text.find('\0') == text.npos)
    return;
  std::size_t line = 1;
  for (std::string_view rest = text; !rest.empty(); ++line)
  {
    const std::string_view one = rest.substr(0, rest.find('\n'));
    if (!core::isUtf8(one) || one.find('\0') != one.npos)
      break;
    rest.remove_prefix(std::min(one.size() + 1, rest.size()));
  }
  refuse(file, line, std::string("is not UTF-8 text; ") + kSaveAs);
}

} // namespace

void BatchRow::describe(scene::Description& description) const
{
  scene::Description next = description;
  const auto set = [](std::string& to, const std::optional<std::string>& from)
  {
    if (from)
      to = *from;
  };
  set(next.note, note);
  set(next.diagnosis, diagnosis);
  set(next.procedure, procedure);
  set(next.date, date);
  next.side = side.value_or(next.side);
  for (const std::string& tag : tags)
    if (std::none_of(next.tags.begin(), next.tags.end(),
                     [wanted = scene::lowerCase(tag)](const std::string& one)
                     { return scene::lowerCase(one) == wanted; }))
      next.tags.push_back(tag);
  scene::checkDescription(next);
  description = std::move(next);
}

std::string batchColumns()
{
  std::string text = "Columns of the table (" + std::string("name is needed, others as wanted):\n");
  for (const Column& column : kColumns)
    text += "  " + std::string(column.name) + ": " + column.text + "\n";
  return text + "  " + kSend + ": a DICOM node, see 'petrous nodes'\n";
}

std::string withColumns(const std::string& text)
{
  const std::vector<std::string> columns = columnNames();
  std::string result;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t from = std::min(text.find("--", at), text.size());
    result += text.substr(at, from - at);
    const std::size_t end =
        std::min(text.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", from), text.size());
    const std::string option = text.substr(from, end - from);
    std::string column = option.substr(std::min<std::size_t>(2, option.size()));
    std::replace(column.begin(), column.end(), '-', '_');
    const bool isWord = from == 0 || text[from - 1] == ' ' || text[from - 1] == '(';
    const bool isColumn = std::find(columns.begin(), columns.end(), column) != columns.end();
    result += isWord && isColumn ? "'" + column + "'" : option;
    at = end;
  }
  return result;
}

BatchTable readBatchTable(const fs::path& file)
{
  const std::string whole = core::readFile(file, kLargestTable);
  refuseOtherEncodings(file, whole);
  std::string_view text = whole;
  BatchTable table;
  table.hasByteOrderMark = text.rfind(kByteOrderMark, 0) == 0;
  if (table.hasByteOrderMark)
    text.remove_prefix(3);
  std::size_t line = 1;
  table.delimiter = core::csvDelimiter(text);
  if (text.size() > 4 && lower(std::string(text.substr(0, 4))) == "sep=")
  {
    table.delimiter = text[4];
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    ++line;
  }
  const std::vector<CsvRow> rows =
      core::csvRows(text, core::printable(file), table.delimiter, line);
  const auto first = std::find_if_not(rows.begin(), rows.end(), isBlank);
  if (first == rows.end())
    throw core::InvalidParameter(core::printable(file) + ": is empty; the first row names the "
                                                         "columns");
  const std::vector<std::string> header = readHeader(file, *first);
  const fs::path folder = fs::absolute(file).parent_path().lexically_normal();
  std::map<std::string, std::size_t> builtIn; // by name as it reads, the row that builds the case
  std::map<fs::path, std::size_t> archivedIn; // and that writes an archive
  for (auto row = first + 1; row != rows.end(); ++row)
  {
    if (isBlank(*row))
      continue;
    Cells cells;
    for (std::size_t n = 0; n < row->cells.size(); ++n)
      if (const std::string& cell = row->cells[n]; !cell.empty())
      {
        if (n >= header.size())
          refuse(file, row->line,
                 "has more cells than there are columns; put quotes around a cell that holds a '" +
                     std::string(1, table.delimiter) + "'");
        if (header[n].empty())
          refuse(file, first->line, "column " + std::to_string(n + 1) + " has no name");
        cells[header[n]] = cell;
      }
    BatchRow next;
    next.line = row->line;
    try
    {
      RowReader(folder, std::move(cells)).read(next);
      if (next.sources)
        if (const auto [other, isNew] = builtIn.emplace(scene::asRead(next.name), next.line);
            !isNew)
          throw core::InvalidParameter("case '" + next.name + "' is built by line " +
                                       std::to_string(other->second) +
                                       " already; give it another name, or leave 'folder' blank");
      if (!next.archive.empty())
        if (const auto [other, isNew] = archivedIn.emplace(next.archive, next.line); !isNew)
          throw core::InvalidParameter("the archive is written by line " +
                                       std::to_string(other->second) +
                                       " already; give it another name");
    }
    catch (const core::InvalidParameter& error)
    {
      next.problem = error.what();
    }
    table.rows.push_back(std::move(next));
  }
  if (table.rows.empty())
    throw core::InvalidParameter(core::printable(file) + ": has no row after the header");
  return table;
}

} // namespace petrous::cli
