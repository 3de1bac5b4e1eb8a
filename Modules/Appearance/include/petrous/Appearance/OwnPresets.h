#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "petrous/Appearance/StructureAppearance.h"

namespace petrous::appearance
{

/// The presets that users of a library saved: presets.json in its folder, with entries as those of
/// the built-in catalogue. Read anew by each call, as other programs may change it.
///
/// A preset's sourceImage says whose values its transfer function has, kOfCt or kOfMr; empty: they
/// are mapped to any CT (relative), there are none, or an older version saved it and did not say.
class OwnPresets
{
public:
  static constexpr const char* kOfCt = "ct";
  static constexpr const char* kOfMr = "mr";

  explicit OwnPresets(const std::filesystem::path& folder);

  /// In the order of their names; none without the file. Throws InvalidParameter naming the file
  /// and the invalid entry, InputFileError.
  std::vector<StructureAppearance> all() const;

  /// One of these, or else StructurePresets::preset. Throws InvalidParameter listing the presets,
  /// only those that `isListed` takes if it is given.
  StructureAppearance
  preset(const std::string& name,
         const std::function<bool(const StructureAppearance&)>& isListed = {}) const;

  /// Saves an appearance under a name, without flags and the name of its source image; replaces the
  /// one that has it. `isPrimaryMr`: an MR is what a look without a source image reads. Returns the
  /// preset. Throws as checkName and all, OutputFileError.
  StructureAppearance save(const StructureAppearance& look, const std::string& name,
                           bool isPrimaryMr = false) const;

  /// Throws InvalidParameter if there is none of this name, and as all; OutputFileError.
  void remove(const std::string& name) const;

  /// Throws InvalidParameter unless the name has 1 to 60 bytes of UTF-8 without control characters,
  /// no space at either end, and is not that of a built-in preset.
  static void checkName(const std::string& name);

private:
  void write(const std::vector<StructureAppearance>& presets) const;

  std::filesystem::path m_file;
};

} // namespace petrous::appearance
