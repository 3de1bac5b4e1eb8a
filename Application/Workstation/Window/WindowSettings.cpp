#include "WindowSettings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "Theme.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Presenters/Background.h"

namespace petrous::workstation
{

namespace
{

using rendering::StereoMode;

// Stored by name: numbers would change with the enumeration.
constexpr std::array<std::pair<StereoMode, const char*>, 5> kModes{{
    {StereoMode::None, "off"},
    {StereoMode::SideBySide, "side-by-side"},
    {StereoMode::Interleaved, "interleaved"},
    {StereoMode::Anaglyph, "anaglyph"},
    {StereoMode::QuadBuffer, "quad-buffer"},
}};

using BurrKind = dissection::Burr::Kind;

constexpr std::array<std::pair<BurrKind, const char*>, 2> kKinds{{
    {BurrKind::Cutting, "cutting"},
    {BurrKind::Diamond, "diamond"},
}};

constexpr const char* kBackground = "light/background";

QString keyOf(const std::string& hand, const char* what)
{
  return QString("hand-%1/%2").arg(QString::fromStdString(hand), what);
}

} // namespace

WindowSettings::WindowSettings(const QString& file)
  : m_file(file.isEmpty()
               ? QSettings(QSettings::IniFormat, QSettings::UserScope, "petrous", "workstation")
                     .fileName()
               : file,
           QSettings::IniFormat)
{
}

std::optional<double> WindowSettings::number(const QString& key) const
{
  bool sound = false;
  const double value = m_file.value(key).toDouble(&sound);
  return sound && std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

void WindowSettings::restore(presenters::ViewSettings& view, bool quadBuffer) const
{
  if (const auto falloff = number("light/falloff_mm"))
    view.setFalloff(*falloff);
  if (const auto wetness = number("light/wetness"))
    view.setWetness(*wetness);
  view.setShadows(m_file.value("light/shadows").toBool());
  if (const auto exposure = number("light/exposure_ev"))
    view.setExposure(*exposure);
  view.setToneCurve(m_file.value("light/tone_curve").toBool());
  if (const auto edges = number("light/edges"))
    view.setEdges(*edges);
  if (const auto grain = number("light/grain"))
    view.setGrain(*grain);
  view.setExitSurfaces(m_file.value("light/exit_surfaces").toBool());
  if (const auto color = presenters::parseBackground(bytes(m_file.value(kBackground).toString())))
    view.setBackground(*color);
  view.setEyeSeparation(number("stereo/eye_separation_mm"));
  view.setConvergence(number("stereo/convergence_mm"));
  const QString mode = m_file.value("stereo/mode").toString();
  for (const auto& [value, name] : kModes)
    if (mode == name && (quadBuffer || value != StereoMode::QuadBuffer))
      view.setStereo(value);
}

void WindowSettings::keep(const presenters::ViewSettings& view)
{
  m_file.setValue("light/falloff_mm", view.light().falloff);
  m_file.setValue("light/wetness", view.light().wetness);
  m_file.setValue("light/shadows", view.light().shadows);
  m_file.setValue("light/exposure_ev", view.light().exposure);
  m_file.setValue("light/tone_curve", view.light().toneCurve);
  m_file.setValue("light/edges", view.light().edges);
  m_file.setValue("light/grain", view.light().grain);
  m_file.setValue("light/exit_surfaces", view.light().exitSurfaces);
  m_file.setValue(kBackground, words(presenters::backgroundText(view.background())));
  for (const auto& [value, name] : kModes)
    if (value == view.stereo())
      m_file.setValue("stereo/mode", name);
  const auto length = [this](const QString& key, const std::optional<double>& value)
  { value ? m_file.setValue(key, *value) : m_file.remove(key); };
  length("stereo/eye_separation_mm", view.rig().eyeSeparation);
  length("stereo/convergence_mm", view.rig().convergence);
}

std::optional<double> WindowSettings::thrust() const
{
  return number("hand/thrust_n");
}

bool WindowSettings::leftHand() const
{
  return m_file.value("hand/left", false).toBool();
}

void WindowSettings::keepLeftHand(bool isLeft)
{
  m_file.setValue("hand/left", isLeft);
}

bool WindowSettings::burrAlone() const
{
  return m_file.value("hand/burr_alone", false).toBool();
}

void WindowSettings::keepBurrAlone(bool alone)
{
  m_file.setValue("hand/burr_alone", alone);
}

void WindowSettings::keepThrust(double newtons)
{
  m_file.setValue("hand/thrust_n", newtons);
}

std::pair<QString, QString> WindowSettings::instrument() const
{
  return {m_file.value("instrument/file").toString(), m_file.value("instrument/axis").toString()};
}

void WindowSettings::keepInstrument(const QString& file, const QString& axis)
{
  m_file.setValue("instrument/file", file);
  m_file.setValue("instrument/axis", axis);
}

std::optional<dissection::Burr> WindowSettings::burr() const
{
  const auto diameter = number("burr/diameter_mm");
  const auto rpm = number("burr/rpm");
  const QString kind = m_file.value("burr/kind").toString();
  if (!diameter || !(*diameter > 0.0) || !rpm || !(*rpm > 0.0))
    return std::nullopt;
  for (const auto& [value, name] : kKinds)
    if (kind == name)
    {
      dissection::Burr burr;
      burr.diameter = *diameter;
      burr.kind = value;
      burr.rpm = *rpm;
      if (const std::string own = m_file.value("burr/name").toString().toStdString();
          dissection::isCatalogueName(own))
        setName(burr, own);
      return burr;
    }
  return std::nullopt;
}

void WindowSettings::keepBurr(const dissection::Burr& burr)
{
  m_file.setValue("burr/diameter_mm", burr.diameter);
  m_file.setValue("burr/rpm", burr.rpm);
  m_file.setValue("burr/name", QString::fromStdString(nameOf(burr)));
  for (const auto& [value, name] : kKinds)
    if (value == burr.kind)
      m_file.setValue("burr/kind", name);
}

std::optional<double> WindowSettings::scale(const std::string& hand) const
{
  return number(keyOf(hand, "scale"));
}

std::optional<double> WindowSettings::forceLimit(const std::string& hand) const
{
  return number(keyOf(hand, "force_limit_n"));
}

void WindowSettings::keepScale(const std::string& hand, double scale)
{
  m_file.setValue(keyOf(hand, "scale"), scale);
}

void WindowSettings::keepForceLimit(const std::string& hand, double newtons)
{
  m_file.setValue(keyOf(hand, "force_limit_n"), newtons);
}

bool WindowSettings::panelShown(const QString& panel, bool usual) const
{
  const QString kept = m_file.value("panels/" + panel).toString();
  return kept.isEmpty() ? usual : kept == "shown";
}

presenters::ViewArrangement WindowSettings::arrangement() const
{
  presenters::ViewArrangement arrangement;
  for (int n = 0; n < 5; ++n)
  {
    const auto layout = static_cast<presenters::ViewLayout>(n);
    arrangement.setLayout(layout);
    const QString key = QString("views/%1_split_%2").arg(nameOf(layout));
    // Twice: one that is clamped by its neighbour's usual place comes right after it.
    for (int round = 0; round < 2; ++round)
      for (std::size_t split = 0; split < arrangement.splits().size(); ++split)
        if (const auto at = number(key.arg(split)); at)
          arrangement.moveSplit(split, *at);
  }
  const auto layout =
      presenters::parseViewLayout(m_file.value("views/layout").toString().toStdString());
  arrangement.setLayout(layout.value_or(presenters::ViewLayout::Beside));
  const int large = m_file.value("views/large_slice", 1).toInt();
  if (large >= 1 && large <= 3)
    arrangement.setLarge(static_cast<presenters::ViewPane>(large));
  return arrangement;
}

void WindowSettings::keepArrangement(const presenters::ViewArrangement& arrangement)
{
  const QString name = nameOf(arrangement.layout());
  m_file.setValue("views/layout", name);
  m_file.setValue("views/large_slice", static_cast<int>(arrangement.large()));
  for (std::size_t split = 0; split < arrangement.splits().size(); ++split)
    m_file.setValue(QString("views/%1_split_%2").arg(name).arg(split), arrangement.splits()[split]);
}

bool WindowSettings::zoomTogether() const
{
  return m_file.value("views/zoom_together", false).toBool();
}

void WindowSettings::keepZoomTogether(bool together)
{
  m_file.setValue("views/zoom_together", together);
}

bool WindowSettings::zoomWithScene() const
{
  return m_file.value("views/zoom_with_scene", false).toBool();
}

void WindowSettings::keepZoomWithScene(bool with)
{
  m_file.setValue("views/zoom_with_scene", with);
}

// A list of triples: a name may have any characters, which a key may not.
std::vector<presenters::NamedWindow> WindowSettings::greyWindows(const QString& kind) const
{
  std::vector<presenters::NamedWindow> windows;
  const QVariantList list = m_file.value("windows/" + kind).toList();
  for (int n = 0; n + 2 < list.size(); n += 3)
  {
    const presenters::GreyWindow window{list[n + 1].toDouble(), list[n + 2].toDouble()};
    if (std::isfinite(window.width) && window.width > 0.0 && std::isfinite(window.level))
      windows.push_back({list[n].toString().toStdString(), window});
  }
  return windows;
}

void WindowSettings::keepGreyWindow(const QString& kind, const presenters::NamedWindow& window)
{
  forgetGreyWindow(kind, window.name);
  QVariantList list = m_file.value("windows/" + kind).toList();
  list << QString::fromStdString(window.name) << window.window.width << window.window.level;
  m_file.setValue("windows/" + kind, list);
}

void WindowSettings::forgetGreyWindow(const QString& kind, const std::string& name)
{
  QVariantList list;
  for (const presenters::NamedWindow& one : greyWindows(kind))
    if (one.name != name)
      list << QString::fromStdString(one.name) << one.window.width << one.window.level;
  m_file.setValue("windows/" + kind, list);
}

QString WindowSettings::language() const
{
  return m_file.value("look/language").toString();
}

void WindowSettings::keepLanguage(const QString& code)
{
  if (code.isEmpty())
    m_file.remove("look/language");
  else
    m_file.setValue("look/language", code);
}

Theme WindowSettings::theme() const
{
  Theme theme;
  if (m_file.value("look/theme").toString() == "light")
    theme.scheme = ColorScheme::Light;
  if (const auto scale = number("look/font_scale"))
    theme.fontScale = std::clamp(*scale, Theme::kMinScale, Theme::kMaxScale);
  return theme;
}

void WindowSettings::keepTheme(const Theme& theme)
{
  m_file.setValue("look/theme", theme.scheme == ColorScheme::Light ? "light" : "dark");
  m_file.setValue("look/font_scale", theme.fontScale);
}

std::string WindowSettings::lastCase() const
{
  return m_file.value("library/last_case").toString().toStdString();
}

// At once: a program that is killed opens it again.
void WindowSettings::keepLastCase(const std::string& id)
{
  m_file.setValue("library/last_case", QString::fromStdString(id));
  m_file.sync();
}

bool WindowSettings::thumbnails() const
{
  return m_file.value("library/thumbnails").toString() != "off";
}

void WindowSettings::keepThumbnails(bool drawn)
{
  m_file.setValue("library/thumbnails", drawn ? "on" : "off");
}

bool WindowSettings::drillSound() const
{
  return m_file.value("sound/drill").toString() == "on";
}

void WindowSettings::keepDrillSound(bool heard)
{
  m_file.setValue("sound/drill", heard ? "on" : "off");
}

void WindowSettings::keepPanelShown(const QString& panel, bool shown)
{
  m_file.setValue("panels/" + panel, shown ? "shown" : "hidden");
}

std::vector<std::pair<QString, QSize>> WindowSettings::panelsInFront() const
{
  std::vector<std::pair<QString, QSize>> panels;
  const QVariantList list = m_file.value("panels/in_front").toList();
  for (int n = 0; n + 2 < list.size(); n += 3)
    panels.emplace_back(list[n].toString(), QSize(list[n + 1].toInt(), list[n + 2].toInt()));
  return panels;
}

void WindowSettings::keepPanelsInFront(const std::vector<std::pair<QString, QSize>>& panels)
{
  QVariantList list;
  for (const auto& [name, size] : panels)
    list << name << size.width() << size.height();
  m_file.setValue("panels/in_front", list);
  m_file.sync();
}

} // namespace petrous::workstation
