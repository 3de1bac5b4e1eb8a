#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Scene/Description.h"

namespace petrous::cli
{

/// A row of a table of cases: what `petrous batch` is to do with one of them. Every path is
/// absolute.
struct BatchRow
{
  std::size_t line = 0; ///< of the file, counted from 1; the first of the row's lines
  std::string name;     ///< of the case
  std::optional<presenters::CaseSources> sources; ///< none: the case is in the library already
  bool registers = false;                         ///< every MR that is not registered yet
  std::filesystem::path archive;                  ///< empty: none
  std::string node;                               ///< to send to; empty: none
  /// Of what is archived and sent, as the options of these commands.
  bool masksFace = false, withoutNotes = false, withVideos = false, withDocuments = false;
  /// Of the description: what is not given stays; tags are added.
  std::optional<std::string> note, diagnosis, procedure, date;
  std::optional<scene::Side> side;
  std::vector<std::string> tags;

  /// What is wrong with the row by itself, one line; it cannot be done. Empty: nothing.
  std::string problem;

  /// SHA-256 of what the row says of the case's parts and of its description: the row is another
  /// one for a step if what that step needs is changed, and not if anything else is.
  std::string buildKey, describeKey;

  bool describes() const { return note || diagnosis || procedure || date || side || !tags.empty(); }
  /// Sets what is given. Throws InvalidParameter (checkDescription).
  void describe(scene::Description& description) const;
};

/// A table of cases, as spreadsheets write them.
///
/// CSV [RFC 4180] in UTF-8, with or without a byte order mark; the delimiter is the comma,
/// semicolon or tab that the first row has most of, or that a line "sep=;" names. The first row
/// names the columns (kBatchColumns) in any order and case. Rows of blank cells are skipped.
/// Several values in a cell are separated by '|'. Relative paths start at the table's folder.
struct BatchTable
{
  std::vector<BatchRow> rows;
  char delimiter = ',';
  bool hasByteOrderMark = false;
};

/// What a table may have, with a word on each, for help texts.
std::string batchColumns();

/// `text` with the columns in place of the options of commands that say the same: 'mesh_axes' for
/// --mesh-axes.
std::string withColumns(const std::string& text);

/// Throws InvalidParameter "FILE, line N: ..." for what makes the table as a whole unclear: unknown
/// or repeated columns, an open quote, more cells than columns, text that is not UTF-8. What is
/// wrong with the values of one row is that row's `problem`.
BatchTable readBatchTable(const std::filesystem::path& file);

} // namespace petrous::cli
