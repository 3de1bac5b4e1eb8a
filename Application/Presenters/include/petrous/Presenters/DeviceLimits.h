#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace petrous::presenters
{

/// The largest stiffness of a coupling that this user's devices bear, as measured by
/// `petrous device-test --keep`: a JSON file of this machine,
/// {"SERVER": {DEVICE: {"max_stiffness_n_per_mm": K}}}. DEVICE is the name that the server
/// describes, with the serial number where it knows one. Before, {"SERVER": {"device": DEVICE,
/// ...}}.

/// $XDG_CONFIG_HOME/petrous/device-limits.json, else below ~/.config; empty: no home folder.
std::filesystem::path deviceLimitsFile();

/// N/mm, at most twice `described`, the server's limit: a measurement of a minute in one hand must
/// not undo it. 0 where the server describes none.
double boundedStiffness(double measured, double described) noexcept;

/// N/mm, for a device that `device-test` has not measured: a quarter of what its server describes,
/// at most 0.5; from 0.4 on at least 0.2, below it half. Data sheets state the limit of the device
/// itself, without the delay of a connection; this is stable up to 8 ms of it (record 55).
double untestedStiffness(double described) noexcept;

/// N/mm, felt at the device, bounded; nothing where the file has none for this server and device,
/// or cannot be read.
std::optional<double> keptStiffness(const std::filesystem::path& file, const std::string& server,
                                    const std::string& device, double described);

/// Other entries stay; a file that is not one of these is put aside as "FILE.damaged". Throws
/// core::OutputFileError, or InvalidParameter unless 0 < stiffness <= 20.
void keepStiffness(const std::filesystem::path& file, const std::string& server,
                   const std::string& device, double stiffness);

} // namespace petrous::presenters
