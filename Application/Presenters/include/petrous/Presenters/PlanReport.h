#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Rendering/SceneContents.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

enum class ReportLanguage
{
  English,
  German
};

/// What a report of a plan is made of.
struct ReportOptions
{
  /// The branch that is reported: its name, or its number from 1 in `petrous branch --list`; empty:
  /// the present one.
  std::string approach;
  ReportLanguage language = ReportLanguage::English;
  /// Names as they were typed, the note, and who signed registrations: for who keeps it at home.
  bool keepIdentity = false;
  bool withDate = true;    ///< of the planned operation
  std::string made;        ///< ISO 8601 date that the report bears; empty: none
  std::string version;     ///< of the program
  int pictureWidth = 1200; ///< pixels of the 3-D pictures
  int sliceWidth = 360;
  rendering::BackgroundColor background = rendering::kDefaultBackground; ///< of the 3-D pictures
  /// Whether a typed text may identify the patient (IdentityText); such a text is withheld unless
  /// `keepIdentity`. Null: every typed text is.
  std::function<bool(const std::string&)> mayIdentify;
  /// The same of a sentence of the program. Null: as `mayIdentify`.
  std::function<bool(const std::string&)> mayIdentifySentence = {};
  /// Whether a typed text has the field's own words alone, and need not be read for names. Null:
  /// none has.
  std::function<bool(const std::string&)> isOfField = {};
};

/// A cell of a table: text to read and, of a number, its value without rounding in the column's
/// unit.
struct ReportCell
{
  std::string text;
  std::optional<double> value = {};
  std::optional<double> uncertainty = {};
  bool isNumber = false; ///< aligned to the right
  bool isWarning = false;
  /// Of a structure, shown before its name, of which underscores are written as spaces.
  std::optional<std::array<float, 3>> color = {};
};

struct ReportTable
{
  std::vector<std::string> columns;
  std::vector<std::vector<ReportCell>> rows;
};

struct ReportPicture
{
  std::string caption;
  std::vector<std::uint8_t> png;
  int width = 0; ///< pixels
  int height = 0;
  int inRow = 2; ///< pictures side by side
  /// Above the row that begins with this picture; empty: it goes on in the row before, if there is
  /// room.
  std::string heading = {};
};

/// In this order: text, pictures, table.
struct ReportSection
{
  std::string id; ///< "distances", "strokes", ...: the same in every language
  std::string title;
  std::vector<std::string> paragraphs = {};
  std::vector<ReportPicture> pictures = {};
  ReportTable table = {};
  std::vector<std::string> remarks = {}; ///< beneath the table, in small letters
};

/// A plan as it is put on paper, ready for any writer; holds nothing of who the patient is unless
/// that was asked for.
struct PlanReport
{
  ReportLanguage language = ReportLanguage::English;
  std::string title;
  std::string name; ///< of the case, or a pseudonym
  std::string side;
  std::string stamp;    ///< of every page: name, side, planned date
  std::string colophon; ///< program, date, and what it is not
  std::string pageOf;   ///< "Page %1 of %2"
  std::vector<std::pair<std::string, std::string>> facts; ///< at its head
  std::vector<ReportSection> sections;
  /// Typed texts that it has as they are, and that are not of the field's words alone: "'a', 'b'".
  std::string keptTexts;
  std::vector<std::string> mayIdentify; ///< what of it may tell who the patient is, a sentence each
};

/// The one place where a report's contents are put together, for window and command alike. The
/// values are those of the other functions and commands: measurements of quantitiesOf, structures
/// of dimensionsOf, distances of dissectionDistances. `value` has its dissection loaded; it is a
/// copy, which is taken to the reported approach. Pictures are drawn off-screen, on any thread;
/// without OpenGL the report says so in their place. Throws InvalidParameter for an approach that
/// there is not, CancelledError, and what loading the case's parts throws.
PlanReport planReport(scene::Case value, const ReportOptions& options,
                      const core::Progress& progress = {});

/// One self-contained file: pictures as data URIs, no script, nothing from elsewhere. A number's
/// cell has its value and uncertainty, unrounded, as data-value and data-uncertainty.
std::string htmlOf(const PlanReport& report);

/// A cell's text as it is written.
std::string shownText(const ReportCell& cell);

/// "base64" of RFC 4648.
std::string base64(const std::vector<std::uint8_t>& bytes);

/// The text with &, <, > and quotes as entities.
std::string escapedHtml(const std::string& text);

} // namespace petrous::presenters
