#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <set>

#include "ObjectChecks.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::library
{

/// What copies of a Library share.
struct LibraryState
{
  using StandIns = std::set<std::weak_ptr<const volume::IntensityVolume>,
                            std::owner_less<std::weak_ptr<const volume::IntensityVolume>>>;

  /// Shared by the cases that were opened, too.
  std::shared_ptr<ObjectChecks> checks = std::make_shared<ObjectChecks>();
  std::function<void(double)> waiting; ///< Library::onWait
  bool noticesOpeners = false;         ///< Library::noticeOpeners
  std::mutex mutex;                    ///< of what follows
  StandIns standIns;                   ///< Library::standInForCt
};

} // namespace petrous::library
