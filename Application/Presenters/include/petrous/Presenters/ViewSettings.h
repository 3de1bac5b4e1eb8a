#pragma once

#include <functional>
#include <optional>
#include <string>

#include "petrous/Rendering/SceneContents.h"
#include "petrous/Rendering/Stereo.h"
#include "petrous/Scene/ViewState.h"

namespace petrous::presenters
{

/// How the window renders a scene: lamp and stereo, as a case was saved with, else as the user has
/// them, and the background, which is the user's alone. Without Qt; not thread-safe.
class ViewSettings
{
public:
  static constexpr double kFarthestFalloff = 1000.0; ///< mm

  /// Each may be empty. Called after a change, only if something changed.
  struct Events
  {
    std::function<void()> lightChanged;
    std::function<void()> stereoChanged;
    std::function<void()> backgroundChanged;
  };
  Events events;

  const rendering::LightSettings& light() const noexcept { return m_light; }
  void setFalloff(double millimetres); ///< 0: none; clamped to 0 to kFarthestFalloff
  void setWetness(double wetness);     ///< clamped to 0 to 1
  void setShadows(bool on);
  void setExposure(double exposure); ///< EV, clamped to +-ViewState::Light::kMaxExposure
  void setToneCurve(bool on);
  void setEdges(double edges); ///< clamped to 0 to 1
  void setGrain(double grain); ///< of cut bone, clamped to 0 to 1
  void setExitSurfaces(bool on);

  rendering::StereoMode stereo() const noexcept { return m_stereo; }
  const rendering::StereoRig& rig() const noexcept { return m_rig; }
  void setStereo(rendering::StereoMode mode);
  /// mm, clamped to StereoRig's limits; none: a microscope's angle, converging at the focal point.
  void setEyeSeparation(std::optional<double> millimetres);
  void setConvergence(std::optional<double> millimetres);

  const rendering::BackgroundColor& background() const noexcept { return m_background; }
  void setBackground(const rendering::BackgroundColor& color); ///< clamped to 0 to 1

  /// What a case was saved with; values beyond the limits are clamped. `quadBuffer`: the driver
  /// supports that mode; otherwise it leaves the mode as it is.
  void take(const scene::ViewState& view, bool quadBuffer);
  void take(const ViewSettings& other); ///< its values
  scene::ViewState::Light lightState() const;
  void setLight(const scene::ViewState::Light& light); ///< clamped, as by the setters
  scene::ViewState::Stereo stereoState() const;

private:
  rendering::LightSettings m_light;
  rendering::StereoMode m_stereo = rendering::StereoMode::None;
  rendering::StereoRig m_rig;
  rendering::BackgroundColor m_background = rendering::kDefaultBackground;
};

/// A change of the background, for the menu of undo.
std::string backgroundEdit();

/// A change of the lamp, likewise.
struct LightEdit
{
  std::string what;          ///< "exposure"; "light" if it is more than one property
  bool isContinuous = false; ///< of a number, which a slider may move in steps
};
LightEdit lightEdit(const scene::ViewState::Light& before, const scene::ViewState::Light& after);

} // namespace petrous::presenters
