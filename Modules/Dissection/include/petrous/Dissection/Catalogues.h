#pragma once

#include <filesystem>

#include "petrous/Dissection/BurrCatalogue.h"
#include "petrous/Dissection/MaterialCatalogue.h"

namespace petrous::dissection
{

/// Materials and burrs that go with each other.
struct Catalogues
{
  MaterialCatalogue materials;
  BurrCatalogue burrs;

  /// What the program carries.
  static Catalogues builtIn();

  /// From these files; an empty path stands for what the program carries. Throws InvalidParameter
  /// that names the file, what is wrong and what would be right: a file that cannot be read, an
  /// entry, or a pair of material and burr that is out of the removal law's domain.
  static Catalogues read(const std::filesystem::path& materials,
                         const std::filesystem::path& burrs);

  /// From materials.json and burrs.json in a folder, as far as they are there.
  static Catalogues in(const std::filesystem::path& folder);
};

} // namespace petrous::dissection
