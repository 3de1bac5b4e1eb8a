#pragma once

#include <string>

namespace petrous::interaction
{

class PointerToolController;

/// What a key does while the pointer holds the tool; none of these states last beyond the key.
enum class ToolKey
{
  None,
  Drill, ///< space, while held
  Freeze ///< c, while held
};

/// sym: VTK's name of a key in lower case ("left", "prior", "w").
ToolKey heldKey(const std::string& sym);

/// Arrows or WASD nudge, page up and down change the depth, q and e turn the shaft about the line
/// of sight, r and f tilt it, m changes the mode, home takes the nudge back.
/// False, with nothing done, for any other key.
bool pressKey(PointerToolController& aim, const std::string& sym, bool fine);

/// Whether heldKey or pressKey takes it.
bool isToolKey(const std::string& sym);

} // namespace petrous::interaction
