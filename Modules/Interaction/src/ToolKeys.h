#pragma once

#include <string>

namespace petrous::interaction
{

class PointerToolController;

/// Keys that act while held, with the pointer as the device.
enum class ToolKey
{
  None,
  Drill, ///< space, while held
  Freeze ///< c, while held
};

/// sym: VTK's name of a key in lower case ("left", "prior", "w").
ToolKey heldKey(const std::string& sym);

/// Arrows or WASD nudge, page up and down change the depth, q and e turn the shaft about the line
/// of sight, r and f tilt it, m changes the mode, home resets the nudge. Returns false and does
/// nothing for any other key.
bool pressKey(PointerToolController& aim, const std::string& sym, bool fine);

/// Whether heldKey or pressKey handles the key.
bool isToolKey(const std::string& sym);

} // namespace petrous::interaction
