#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <Eigen/Core>

#include "petrous/Core/AxesCorrection.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/PatientBox.h"
#include "petrous/Dissection/BurrCatalogue.h"
#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::cli
{

// Checks of an option's value, for CLI::Option::check: a bad one is a usage error that names option
// and value, and what would be right. Every option that is a number has one: the parser by itself
// accepts hexadecimal and octal numbers, NaN and infinity.

/// A number within `range`. CLI::Range would accept NaN.
CLI::Validator within(const core::NumberRange& range);

/// A whole number within [lower, upper], in plain decimal digits: for CLI::Option::transform. The
/// parser by itself would read 010 as 8 and 0x10 as 16, and the largest number for a larger one.
CLI::Validator wholeNumber(std::uint64_t lower, std::uint64_t upper);

/// One of these names. CLI::IsMember, with the text of the other checks.
CLI::Validator oneOf(std::vector<std::string> names);

/// Accepts everything: the choices, for the reference and for completion, of an option that is
/// checked by its command.
CLI::Validator offers(const std::vector<std::string>& names);

/// Between the choices, in the name of such a check.
constexpr char kBetweenChoices = '|';

/// A file's name that ends in one of `suffixes` (".png", case-insensitive): other programs rely on
/// it. Not CLI::ExistingFile for files to be read: a missing one is bad input, not wrong usage.
CLI::Validator endsIn(const std::vector<std::string>& suffixes);

/// Exactly `count` finite numbers separated by commas; otherwise throws UsageError naming `option`.
std::vector<double> parseNumbers(const std::string& text, std::size_t count,
                                 const std::string& option);

/// "x0,x1,y0,y1,z0,z1", minimum before maximum; otherwise throws UsageError naming `option`.
core::PatientBox parseBox(const std::string& text, const std::string& option);

/// The letters of a correction of axes ("RPS"); otherwise throws UsageError naming `option`.
core::AxesCorrection parseAxes(const std::string& text, const std::string& option);

/// Patient points, LPS mm, from a CSV file with columns x_mm, y_mm and z_mm. Throws
/// InvalidParameter naming file and line.
std::vector<Eigen::Vector3d> readPoints(const std::filesystem::path& path);

/// An integer within the range of int; otherwise throws UsageError naming `option`.
int toInt(double value, const std::string& option);

/// "800x600", plain decimal digits: 8 to 8192 pixels each; otherwise throws UsageError.
std::pair<int, int> parseSize(const std::string& text);

/// A number as text with `digits` decimals.
std::string fixed(double value, int digits);

/// Millimetres of "mm", "cm", "m", "um" or "inch".
double millimetresOf(const std::string& unit);

/// The burr that --burr names; otherwise throws UsageError naming those that there are.
dissection::BurrModel burrNamed(const std::string& name, const dissection::BurrCatalogue& burrs);

/// The burrs that come with the program, for completion; a library may have others.
std::vector<std::string> builtInBurrs();

/// What "stored", "allocated" or nothing says of --bits.
imaging::UndeclaredBits undeclaredBitsOf(const std::string& bits);

} // namespace petrous::cli
