#pragma once

#include <filesystem>

#include "petrous/Dissection/BurrCatalogue.h"
#include "petrous/Dissection/MaterialCatalogue.h"

namespace petrous::dissection
{

/// Compatible catalogues of materials and burrs.
struct Catalogues
{
  MaterialCatalogue materials;
  BurrCatalogue burrs;

  /// The built-in catalogues.
  static Catalogues builtIn();

  /// From these files; an empty path selects the built-in catalogue. Throws InvalidParameter naming
  /// the file, the error and what would be valid: a file that cannot be read, an entry, or a pair
  /// of material and burr outside the removal law's domain.
  static Catalogues read(const std::filesystem::path& materials,
                         const std::filesystem::path& burrs);

  /// From materials.json and burrs.json in a folder, as far as present.
  static Catalogues in(const std::filesystem::path& folder);
};

} // namespace petrous::dissection
