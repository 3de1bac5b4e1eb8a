#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <QString>

#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

/// "-0.3", in German "-0,3"; never "-0.0".
QString numberText(double value, int decimals);
/// A text of numbers and units alone, with a point, as the window's language has it: "0,25 mm",
/// "0,5; 12,0" for "0.5, 12.0".
QString numberText(const std::string& text);
QString boxSizeText(const Eigen::Vector3d& millimetres); ///< "40.0 × 38.0 × 30.0 mm"
QString cutAwayText(); ///< why a click in the 3D view means nothing

/// "12.34 mm³", with decimals as its size deserves.
QString volumeText(double cubicMillimetres);

/// A part's name as it is shown everywhere: presenters::shownName.
QString shownName(const std::string& part);

/// A case's name as lists show it: scene::withVisible.
QString caseName(const std::string& name);

/// Names of the user's, "left ear, right ear".
QString listed(const std::vector<std::string>& names);

/// An approach's name as it is shown: the first one's in the user's language, until it is renamed.
QString approachName(const std::string& name);

/// "7.5 s", "1 min 15 s".
QString durationText(double seconds);

/// What was drilled so far. `drilling`: a stroke is open, whose volume is known when it is closed.
QString removedText(const scene::Case& value, bool drilling);

/// What a stroke removed; "Nothing was cut" for nullptr.
QString strokeText(const dissection::Stroke* stroke);

/// A message of what lies below the window in the window's language, with what to do in the window
/// in place of what it says to do with the command.
QString windowText(const QString& text);

/// The same of a text of the program that holds no more than names of the user's; of a name alone,
/// words().
QString phrase(const std::string& text);

/// How dates are written: as ISO 8601 writes them, or as the window's language does.
QString dateFormat();
/// A date of ISO 8601 so; what is no date stays as it is.
QString dateText(const std::string& iso);

/// Name patterns of the files that hold such contents (imaging::kMesh, ...), for a file dialog.
QString patternsOf(unsigned contents);

/// A file or folder as Qt names it, for the file system.
std::filesystem::path pathOf(const QString& file);

/// With a capital letter at its beginning.
QString capitalized(const QString& text);
/// "Reading… · about 20 s left"; `text` alone while it is not known how much is left.
QString withTimeLeft(const QString& text, const QString& left);
/// Adds a full stop if there is none.
QString sentence(const QString& text);

/// Description of the program, as rich text.
QString aboutText();

} // namespace petrous::workstation
