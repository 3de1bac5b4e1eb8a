#pragma once

#include <string>
#include <vector>

#include "petrous/Presenters/SlicePresenter.h"
#include "petrous/Rendering/Picture.h"

namespace petrous::cli
{

/// The slice with orientation letters, a scale bar, its plane's name and the lines of text beneath
/// that.
rendering::Picture labelled(presenters::SlicePixels pixels, const presenters::SliceGeometry& slice,
                            const std::vector<std::string>& lines);

} // namespace petrous::cli
