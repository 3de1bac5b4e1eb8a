#include "petrous/Presenters/FolderIdentity.h"

#include <algorithm>
#include <memory>

#include "petrous/Core/Error.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Library/PseudonymMap.h"

namespace petrous::presenters
{

namespace fs = std::filesystem;

void refuseWithin(const fs::path& file, const fs::path& input, const std::string& what)
{
  const fs::path in = fs::weakly_canonical(input);
  const fs::path other = fs::weakly_canonical(file);
  if (std::mismatch(in.begin(), in.end(), other.begin(), other.end()).first == in.end())
    throw core::Error(core::Fault::Refused, file.string() + ": the " + what + " would lie in " +
                                                input.string() +
                                                ", which is never changed; give it another place");
}

library::DeidentificationResult deidentifyFolder(const DeidentifyRequest& request,
                                                 const std::string& passphrase,
                                                 const core::Progress& progress)
{
  std::error_code error;
  if (!request.replace && fs::is_regular_file(request.output, error))
    throw core::Error(core::Fault::Refused,
                      request.output.string() +
                          ": is there already; name another file, or allow it to be replaced "
                          "(--replace)");
  library::refuseOverwriting(request.output, request.library);
  if (!request.map.empty())
    library::refuseOverwriting(request.map, request.library);
  std::unique_ptr<library::PseudonymMap> map;
  if (!request.map.empty())
  {
    refuseWithin(request.map, request.input, "map");
    map = std::make_unique<library::PseudonymMap>(request.map, passphrase);
    map->save();
  }
  const library::PseudonymKey once;
  return library::deidentify(request.input, request.output, request.options,
                             map ? map->key() : once, progress,
                             [&map](const std::vector<library::Pseudonym>& pseudonyms)
                             {
                               if (!map)
                                 return;
                               map->add(pseudonyms);
                               map->save();
                             });
}

void wipe(std::string& secret) noexcept
{
  volatile char* bytes = secret.empty() ? nullptr : &secret[0];
  for (std::size_t n = 0; n < secret.size(); ++n)
    bytes[n] = 0;
  secret.clear();
}

} // namespace petrous::presenters
