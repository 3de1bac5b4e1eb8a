#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace petrous::presenters
{

/// The largest stiffness of a coupling that this user's devices bear, as measured by
/// `petrous device-test --keep`: a JSON file of this machine,
/// {"SERVER": {"device": NAME, "max_stiffness_n_per_mm": K}}.

/// $XDG_CONFIG_HOME/petrous/device-limits.json, else below ~/.config; empty: no home folder.
std::filesystem::path deviceLimitsFile();

/// N/mm, felt at the device; nothing where the file has none for this server and device, or cannot
/// be read.
std::optional<double> keptStiffness(const std::filesystem::path& file, const std::string& server,
                                    const std::string& device);

/// Other entries stay; a file that is not one of these is replaced. Throws core::OutputFileError,
/// or InvalidParameter unless 0 < stiffness <= 20.
void keepStiffness(const std::filesystem::path& file, const std::string& server,
                   const std::string& device, double stiffness);

} // namespace petrous::presenters
