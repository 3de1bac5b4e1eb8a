#include "petrous/Dissection/Catalogues.h"

#include "petrous/Core/InputFile.h"

namespace petrous::dissection
{

namespace
{

constexpr std::uintmax_t kLargest = 16U << 20; // bytes

template <typename Catalogue>
Catalogue catalogueFrom(const std::filesystem::path& file)
{
  return file.empty() ? Catalogue::builtIn()
                      : Catalogue(core::readFile(file, kLargest), file.string());
}

} // namespace

Catalogues Catalogues::builtIn()
{
  return read({}, {});
}

Catalogues Catalogues::read(const std::filesystem::path& materials,
                            const std::filesystem::path& burrs)
{
  Catalogues result{catalogueFrom<MaterialCatalogue>(materials),
                    catalogueFrom<BurrCatalogue>(burrs)};
  try
  {
    checkPairs(result.materials, result.burrs);
  }
  catch (const core::InvalidParameter& error)
  {
    const std::string source = !materials.empty() ? materials.string()
                               : !burrs.empty()   ? burrs.string()
                                                  : "materials.json";
    throw core::InvalidParameter(source + ": " + error.what());
  }
  return result;
}

Catalogues Catalogues::in(const std::filesystem::path& folder)
{
  const auto there = [&folder](const char* name)
  {
    std::error_code none;
    const auto file = folder / name;
    return std::filesystem::exists(file, none) ? file : std::filesystem::path();
  };
  return read(there("materials.json"), there("burrs.json"));
}

} // namespace petrous::dissection
