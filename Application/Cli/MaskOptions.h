#pragma once

#include <string>

#include "Context.h"
#include "petrous/Scene/ImageMask.h"

namespace petrous::cli
{

/// --mask-face, --mask-ears and --roi of what hands images on.
struct MaskOptions
{
  bool face = false, ears = false;
  std::string roi;

  /// Throws UsageError.
  scene::ImageMask mask() const;
};

void addMaskOptions(CLI::App& command, MaskOptions& options);

} // namespace petrous::cli
