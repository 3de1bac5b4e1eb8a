#include "petrous/Presenters/AppearanceEditor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "petrous/Appearance/AppearanceMaterial.h"
#include "petrous/Appearance/DistinctColors.h"
#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Presenters/BoneOpacity.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Volume/IntensityScale.h"

namespace petrous::presenters
{

using appearance::ControlPoint;
using appearance::StructureAppearance;
using appearance::TransferFunction;

namespace
{

constexpr double kArrowSteps = 10.0;   // of IntensityDisplay, a key press
constexpr double kUsualAir = -1024.0;  // HU
constexpr double kUsualMost = 3071.0;  // HU, of 12 bits
constexpr double kRare = 0.02;         // share of values beyond a fitted function, at either end
constexpr float kDarkShade = 0.75F;    // of the two of a function that is fitted from one colour
constexpr float kBrightShade = 0.35F;  // towards white
constexpr const char* kOpenColor = ""; // no word of it is in the catalogue: "other"

AppearanceEditor::Part partOf(const std::string& name, const StructureAppearance& look,
                              const volume::IntensityScale& scale)
{
  AppearanceEditor::Part part;
  part.name = name;
  part.look = look;
  StructureAppearance read = look;
  if (!look.solid)
    read.sourceImage.clear(); // lumenMaterial
  part.transfer = materialOf(read, scale).transfer;
  if (look.transfer && (read.sourceImage.empty() || !look.relative))
    part.points = part.transfer.points();
  return part;
}

// As it is edited: without the factor and the foot of softTissueMaterial.
AppearanceEditor::Part softTissueOf(const scene::Case& value)
{
  auto part = partOf(AppearanceEditor::kSoftTissue, value.softTissue, softTissueScale(value));
  if (part.points.empty())
    part.transfer = TransferFunction::constant(value.softTissue.color, 0.0F); // not drawn
  return part;
}

bool readsMr(const scene::Case& value, const StructureAppearance& look)
{
  return !look.sourceImage.empty() || value.ct.modality == scene::Modality::Mr;
}

// Values of an MR mean nothing in a CT, nor those of a CT in an MR.
void checkValues(const scene::Case& value, const StructureAppearance& look,
                 const StructureAppearance& preset)
{
  const bool ofMr = preset.sourceImage == appearance::OwnPresets::kOfMr;
  if (!ofMr && preset.sourceImage != appearance::OwnPresets::kOfCt)
    return;
  const std::string mr = look.solid ? look.sourceImage : std::string(); // as lumenMaterial reads
  if (ofMr == (!mr.empty() || value.ct.modality == scene::Modality::Mr))
    return;
  throw core::InvalidParameter("preset '" + preset.preset + "' has values of " +
                               (ofMr ? "an MR" : "a CT") + ", which mean nothing in the " +
                               (mr.empty() ? primaryName(value) : "MR '" + mr + "'") +
                               "; choose another image to be read first");
}

// The mean of its points, by their opacities.
std::array<float, 3> colorOf(const TransferFunction& function)
{
  std::array<float, 3> sum{};
  float weight = 0.0F;
  for (const ControlPoint& point : function.points())
  {
    weight += point.opacity;
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += point.opacity * point.color[c];
  }
  for (float& channel : sum)
    channel /= std::max(weight, 1e-6F);
  return sum;
}

StructureAppearance withFunctionOfMr(StructureAppearance look,
                                     const volume::IntensityHistogram& histogram)
{
  volume::IntensityScale scale = volume::suggestMrScale(histogram);
  scale.iso = volume::mrNoiseCeiling(histogram);
  look.transfer = appearance::softTissueOfMr(scale);
  look.color = colorOf(*look.transfer);
  look.relative = false;
  return look;
}

StructureAppearance withPoints(StructureAppearance look, std::vector<ControlPoint> points)
{
  if (points.empty())
    look.transfer.reset();
  else
    look.transfer = TransferFunction(std::move(points));
  look.relative = false;
  return look;
}

// nullptr: none of this name has a transfer function.
const StructureAppearance* lookOf(const scene::Case& value, const std::string& part)
{
  if (part == AppearanceEditor::kBone)
    return &value.boneLook;
  if (part == AppearanceEditor::kSoftTissue)
    return &value.softTissue;
  const scene::StructurePart* structure = scene::findStructure(value, part);
  return structure ? &structure->look : nullptr;
}

float opacityOf(const TransferFunction::Optics& optics)
{
  const double opacity = -std::expm1(-optics.extinction);
  return static_cast<float>(std::clamp(opacity, 0.0, 1.0));
}

} // namespace

double OpacityAxis::height(double opacity) noexcept
{
  const double o = std::clamp(opacity, 0.0, 1.0);
  return o <= kLeast ? kBand * o / kLeast
                     : kBand + (1.0 - kBand) * (1.0 - std::log10(o) / std::log10(kLeast));
}

double OpacityAxis::opacity(double height) noexcept
{
  const double h = std::clamp(height, 0.0, 1.0);
  return h <= kBand ? kLeast * h / kBand
                    : std::pow(10.0, std::log10(kLeast) * (1.0 - (h - kBand) / (1.0 - kBand)));
}

double OpacityAxis::rounded(double opacity) noexcept
{
  constexpr double kSmallest = 1e-4;
  const double o = std::clamp(opacity, 0.0, 1.0);
  if (o < 0.5 * kSmallest)
    return 0.0;
  const double unit = std::max(std::pow(10.0, std::floor(std::log10(o)) - 2.0), kSmallest);
  const double places = std::round(1.0 / unit);
  return std::min(std::round(o * places) / places, 1.0);
}

std::string AppearanceEditor::Axis::number(double value) const
{
  IntensityDisplay display;
  display.decimals = decimals;
  return display.number(value);
}

std::string AppearanceEditor::Axis::text(double value) const
{
  return number(value) + (unit.empty() ? "" : " " + unit);
}

double AppearanceEditor::Axis::rounded(double value) const
{
  const double places = std::pow(10.0, decimals);
  return std::round(value * places) / places;
}

AppearanceEditor::AppearanceEditor(WorkstationModel& model)
  : m_model(model)
{
}

void AppearanceEditor::refresh()
{
  const bool isSameCase = m_model.hasCase() && m_shownAs == m_model.shownAs();
  const std::string name = isSameCase && selected() ? selected()->name : std::string();
  if (!isSameCase)
  {
    m_point.reset();
    m_histograms = {};
  }
  m_parts.clear();
  m_selected = 0;
  m_shownAs = m_model.shownAs();
  if (!m_model.hasCase())
    return;
  const scene::Case& value = m_model.value();
  const volume::IntensityScale scale = value.intensityScale();
  m_parts.push_back(partOf(kBone, value.boneLook, scale));
  m_parts.push_back(softTissueOf(value));
  for (const scene::LabelPart& labels : value.labels)
    for (const scene::StructurePart& structure : labels.structures)
      m_parts.push_back(partOf(structure.name, structure.look, scale));
  for (std::size_t n = 0; n < m_parts.size(); ++n)
    if (m_parts[n].name == name)
      m_selected = n;
  if (m_parts[m_selected].name != name ||
      (m_point && *m_point >= m_parts[m_selected].points.size()))
    m_point.reset();
}

void AppearanceEditor::renamed(const std::string& from, const std::string& to)
{
  for (Part& part : m_parts)
    if (part.name == from)
      part.name = to;
}

const AppearanceEditor::Part* AppearanceEditor::selected() const noexcept
{
  return m_selected < m_parts.size() ? &m_parts[m_selected] : nullptr;
}

void AppearanceEditor::select(const std::string& part)
{
  for (std::size_t n = 0; n < m_parts.size(); ++n)
    if (m_parts[n].name == part && n != m_selected)
    {
      m_selected = n;
      m_point.reset();
      return;
    }
}

void AppearanceEditor::selectNext(int step)
{
  const std::vector<const Part*> there = onAxis();
  const auto at = std::find(there.begin(), there.end(), selected());
  if (at == there.end())
    return;
  const auto size = static_cast<std::ptrdiff_t>(there.size());
  const std::ptrdiff_t next = ((at - there.begin() + step) % size + size) % size;
  select(there[static_cast<std::size_t>(next)]->name);
}

void AppearanceEditor::selectPoint(std::optional<std::size_t> point)
{
  if (!point || (selected() && *point < selected()->points.size()))
    m_point = point;
}

std::vector<const AppearanceEditor::Part*> AppearanceEditor::onAxis() const
{
  std::vector<const Part*> there;
  const auto imageOf = [](const Part& part)
  { return part.look.solid ? part.look.sourceImage : std::string(); };
  for (const Part& part : m_parts)
    if (&part == selected() || (part.look.shown && imageOf(part) == imageOf(*selected())))
      there.push_back(&part);
  return there;
}

AppearanceEditor::Axis AppearanceEditor::axis() const
{
  Axis axis;
  if (!selected())
    return axis;
  const scene::Case& value = m_model.value();
  const scene::ImagePart* mr =
      selected()->look.solid ? scene::findMr(value, selected()->look.sourceImage) : nullptr;
  const IntensityDisplay display = mr ? displayOf(*mr) : displayOf(value);
  axis.image = mr ? mr->name : primaryName(value);
  axis.unit = display.hounsfield ? "HU" : "";
  axis.decimals = display.decimals;
  axis.step = kArrowSteps * display.step;
  axis.gap = std::pow(10.0, -display.decimals);
  axis.least = display.least;
  axis.most = display.most;
  if (display.hounsfield)
  {
    axis.least = std::min(axis.least, std::max(value.ct.range.min, kUsualAir));
    axis.most = std::max(axis.most, std::min(value.ct.range.max, kUsualMost));
  }
  for (const Part* part : onAxis())
    if (!part->points.empty())
    {
      axis.least = std::min(axis.least, part->points.front().value);
      axis.most = std::max(axis.most, part->points.back().value);
    }
  return axis;
}

void AppearanceEditor::set(const StructureAppearance& look)
{
  const std::string name = selected()->name; // the model's events may call refresh
  if (name == kBone)
    m_model.setBoneLook(look);
  else
    m_model.setLook(name, look);
  refresh();
}

void AppearanceEditor::setPoints(std::vector<ControlPoint> points)
{
  set(withPoints(selected()->look, std::move(points)));
}

bool AppearanceEditor::addPoint(double value, std::optional<double> opacity)
{
  if (!selected() || !std::isfinite(value) || m_model.drilling())
    return false;
  const Axis scale = axis();
  value = scale.rounded(value);
  std::vector<ControlPoint> points = selected()->points;
  const auto at = std::find_if(points.begin(), points.end(),
                               [value](const ControlPoint& point) { return point.value >= value; });
  const auto index = static_cast<std::size_t>(at - points.begin());
  for (const std::size_t near : {index, index - 1})
    if (near < points.size() && std::abs(points[near].value - value) < scale.gap)
    {
      m_point = near;
      return false;
    }
  const TransferFunction::Optics optics = selected()->transfer.at(value);
  ControlPoint point;
  point.value = value;
  for (std::size_t c = 0; c < 3; ++c)
    point.color[c] = static_cast<float>(optics.color[c]);
  point.opacity = opacity ? static_cast<float>(std::clamp(*opacity, 0.0, 1.0)) : opacityOf(optics);
  point.specular = static_cast<float>(optics.specular);
  points.insert(at, point);
  setPoints(std::move(points));
  m_point = index;
  return true;
}

bool AppearanceEditor::addPointAfterSelected()
{
  if (!selected())
    return false;
  const std::vector<ControlPoint>& points = selected()->points;
  const Axis scale = axis();
  if (points.empty())
    return addPoint(0.5 * (scale.least + scale.most));
  const std::size_t at = m_point.value_or(points.size() - 1);
  if (at + 1 < points.size())
    return addPoint(0.5 * (points[at].value + points[at + 1].value));
  return addPoint(points[at].value + 0.05 * (scale.most - scale.least));
}

void AppearanceEditor::setPoint(const ControlPoint& wanted)
{
  if (!selected() || !m_point || !std::isfinite(wanted.value))
    return;
  const std::size_t at = *m_point;
  std::vector<ControlPoint> points = selected()->points;
  ControlPoint point = wanted;
  const auto unit = [](float x) { return std::isfinite(x) ? std::clamp(x, 0.0F, 1.0F) : 0.0F; };
  point.opacity = unit(point.opacity);
  point.specular = unit(point.specular);
  for (float& component : point.color)
    component = unit(component);
  if (point.value != points[at].value)
  {
    const Axis scale = axis();
    point.value = scale.rounded(point.value);
    if (at > 0)
      point.value = std::max(point.value, points[at - 1].value + scale.gap);
    if (at + 1 < points.size())
      point.value = std::min(point.value, points[at + 1].value - scale.gap);
    if ((at > 0 && !(point.value > points[at - 1].value)) ||
        (at + 1 < points.size() && !(point.value < points[at + 1].value)))
      point.value = points[at].value; // no room
  }
  points[at] = point;
  setPoints(std::move(points));
}

void AppearanceEditor::removePoint()
{
  if (!selected() || !m_point || m_model.drilling())
    return;
  std::vector<ControlPoint> points = selected()->points;
  const std::size_t at = *m_point;
  points.erase(points.begin() + static_cast<std::ptrdiff_t>(at));
  const std::size_t left = points.size();
  m_point.reset();
  setPoints(std::move(points));
  if (left > 0)
    m_point = std::min(at, left - 1);
}

void AppearanceEditor::setColor(const std::array<float, 3>& color)
{
  if (!selected())
    return;
  if (m_point)
  {
    ControlPoint point = selected()->points[*m_point];
    point.color = color;
    return setPoint(point);
  }
  StructureAppearance look = selected()->look;
  appearance::setColor(look, color);
  set(look);
}

std::array<float, 3> AppearanceEditor::color() const
{
  if (!selected())
    return {};
  return m_point ? selected()->points[*m_point].color : selected()->look.color;
}

void AppearanceEditor::setSurfaceOpacity(double opacity)
{
  if (!selected())
    return;
  if (selected()->name == kBone)
    return set(withOpacity(selected()->look, opacity));
  StructureAppearance look = selected()->look;
  look.opacity = static_cast<float>(std::clamp(opacity, 0.0, 1.0));
  set(look);
}

std::vector<AppearanceEditor::Preset> AppearanceEditor::presets() const
{
  std::vector<Preset> presets;
  for (StructureAppearance& look : appearance::StructurePresets::builtIn().all())
    presets.push_back({std::move(look), false});
  for (StructureAppearance& look : appearance::OwnPresets(m_model.library().folder()).all())
    presets.push_back({std::move(look), true});
  return presets;
}

bool AppearanceEditor::canHave(const Preset& preset) const
{
  return selected() && canBeLookOf(m_model.value(), selected()->name, preset.look);
}

void AppearanceEditor::applyPreset(const std::string& name)
{
  if (!selected())
    return;
  const appearance::OwnPresets presets(m_model.library().folder());
  const auto preset = presetFor(m_model.value(), selected()->name, presets, name);
  const StructureAppearance look = withPreset(m_model.value(), selected()->name, preset);
  m_point.reset();
  set(look);
}

void AppearanceEditor::savePreset(const std::string& name)
{
  if (selected())
    appearance::OwnPresets(m_model.library().folder())
        .save(selected()->look, name, m_model.value().ct.modality == scene::Modality::Mr);
}

void AppearanceEditor::deletePreset(const std::string& name)
{
  appearance::OwnPresets(m_model.library().folder()).remove(name);
}

void AppearanceEditor::reset()
{
  if (!selected())
    return;
  const StructureAppearance before = selected()->look;
  const auto preset = appearance::OwnPresets(m_model.library().folder()).preset(before.preset);
  StructureAppearance look = withPreset(m_model.value(), selected()->name, preset);
  if (preset.preset == appearance::StructurePresets::builtIn().lookFor(kOpenColor).preset)
    appearance::setColor(look, before.color);
  m_point.reset();
  set(look);
}

std::string AppearanceEditor::json() const
{
  return selected() ? selected()->transfer.toJson() : std::string();
}

void AppearanceEditor::setJson(const std::string& text)
{
  std::vector<ControlPoint> points = TransferFunction::fromJson(text).points();
  if (!selected())
    return;
  m_point.reset();
  setPoints(std::move(points));
}

void AppearanceEditor::clearPoints()
{
  if (!selected())
    return;
  m_point.reset();
  setPoints({});
}

std::vector<AppearanceEditor::Source> AppearanceEditor::sources() const
{
  std::vector<Source> sources;
  if (!m_model.hasCase())
    return sources;
  sources.push_back({});
  for (const scene::ImagePart& mr : m_model.value().mr)
    sources.push_back({mr.name, mr.registered});
  return sources;
}

std::string AppearanceEditor::sourceFixed() const
{
  return selected() && !selected()->look.solid
             ? std::string("A lumen tints the bone around it and reads the ") +
                   primaryName(m_model.value())
             : std::string();
}

void AppearanceEditor::setSource(const std::string& image)
{
  if (!selected() || !sourceFixed().empty() || selected()->look.sourceImage == image ||
      (!image.empty() && !scene::findMr(m_model.value(), image)))
    return;
  StructureAppearance look = selected()->look;
  if (selected()->name == kSoftTissue)
    look = softTissueReading(m_model.value(), image, m_histograms.image(image));
  else
    look.sourceImage = image;
  m_point.reset();
  set(look);
}

std::string AppearanceEditor::notice() const
{
  if (selected() && selected()->name == kSoftTissue)
  {
    const std::string why = softTissueMissing(m_model.value());
    return why.empty() ? why : "Soft tissue is not drawn: " + why;
  }
  if (!selected() || !selected()->look.solid || selected()->look.sourceImage.empty())
    return {};
  const StructureAppearance& look = selected()->look;
  const scene::ImagePart* mr = scene::findMr(m_model.value(), look.sourceImage);
  if (!mr || !mr->registered)
    return "'" + look.sourceImage + "' is not registered: drawn in one colour until it is";
  if (!look.transfer || look.relative)
    return "Presets are made for CT: drawn in one colour until it has points in values of '" +
           look.sourceImage + "'";
  return mrMissing(m_model.value(), look.sourceImage);
}

std::string AppearanceEditor::estimate() const
{
  return selected() && selected()->name == kSoftTissue ? softTissueEstimate(m_model.value())
                                                       : std::string();
}

AppearanceHistograms::Histogram AppearanceEditor::imageHistogram() const
{
  return selected() ? m_histograms.image(selected()->look.solid ? selected()->look.sourceImage
                                                                : std::string())
                    : nullptr;
}

AppearanceHistograms::Histogram AppearanceEditor::insideHistogram() const
{
  return selected() && selected()->name != kBone
             ? m_histograms.within(m_model.value(), selected()->name)
             : nullptr;
}

bool AppearanceEditor::canFit() const
{
  if (!selected() || !selected()->look.solid)
    return false;
  const bool isSoftTissue = selected()->name == kSoftTissue;
  if (isSoftTissue && !readsMr(m_model.value(), selected()->look))
    return false;
  const auto histogram =
      isSoftTissue || selected()->name == kBone ? imageHistogram() : insideHistogram();
  return histogram && histogram->count() > 0;
}

void AppearanceEditor::fit()
{
  if (!canFit())
    return;
  const scene::Case& value = m_model.value();
  if (selected()->name == kSoftTissue)
  {
    m_point.reset();
    return set(withFunctionOfMr(selected()->look, *imageHistogram()));
  }
  const bool isBone = selected()->name == kBone;
  const bool isOfSurface = isBone && selected()->look.sourceImage.empty();
  const StructureAppearance look = fitted(selected()->look, value.intensityScale(),
                                          isBone ? *imageHistogram() : *insideHistogram(),
                                          isOfSurface ? std::optional(value.iso) : std::nullopt);
  m_point.reset();
  set(look);
}

std::function<AppearanceHistograms(const core::Progress&)> AppearanceEditor::beginCounting()
{
  if (m_isCounting || !m_model.hasCase() || !m_model.loaded())
    return {};
  auto counting = m_histograms.counting(m_model.value());
  m_isCounting = static_cast<bool>(counting);
  return counting;
}

void AppearanceEditor::counted(AppearanceHistograms done, std::uint64_t of)
{
  m_isCounting = false;
  if (m_model.hasCase() && of == m_model.shownAs())
    m_histograms.take(std::move(done));
}

void AppearanceEditor::notCounted()
{
  m_isCounting = false;
}

void AppearanceEditor::dropHistograms()
{
  m_histograms = {};
}

StructureAppearance softTissueReading(const scene::Case& value, const std::string& image,
                                      AppearanceHistograms::Histogram histogram)
{
  StructureAppearance look = value.softTissue;
  if (image == look.sourceImage)
    return look;
  if (image.empty())
  {
    appearance::readPrimaryImage(look);
    return look;
  }
  const scene::ImagePart* mr = scene::findMr(value, image);
  const auto volume = mr ? mr->volume.get() : nullptr;
  if (!volume)
    throw core::InvalidParameter("the case has no MR '" + image + "'");
  look.sourceImage = image;
  if (!histogram)
    histogram = std::make_shared<const volume::IntensityHistogram>(*volume);
  return withFunctionOfMr(std::move(look), *histogram);
}

bool canBeLookOf(const scene::Case& value, const std::string& part,
                 const StructureAppearance& preset)
{
  return preset.solid || !(scene::meansBone(value, part) || scene::meansSoftTissue(value, part));
}

StructureAppearance presetFor(const scene::Case& value, const std::string& part,
                              const appearance::OwnPresets& presets, const std::string& name)
{
  return presets.preset(name, [&](const StructureAppearance& preset)
                        { return canBeLookOf(value, part, preset); });
}

StructureAppearance withPreset(const scene::Case& value, const std::string& part,
                               const StructureAppearance& preset)
{
  const bool isBone = scene::meansBone(value, part);
  const bool isSoftTissue = scene::meansSoftTissue(value, part);
  if (!canBeLookOf(value, part, preset))
    throw core::InvalidParameter("preset '" + preset.preset +
                                 "' is that of a lumen and cannot be the look of " +
                                 (isBone ? "bone" : "soft tissue"));
  const scene::StructurePart* structure =
      isBone || isSoftTissue ? nullptr : scene::findStructure(value, part);
  StructureAppearance look = isSoftTissue ? value.softTissue : value.boneLook;
  if (structure)
    look = structure->look;
  else if (!isBone && !isSoftTissue)
    for (const scene::MeshPart& mesh : value.meshes)
      if (mesh.name == part)
        look = mesh.look;
  (isSoftTissue ? appearance::applySoftTissuePreset : appearance::applyPreset)(look, preset);
  checkValues(value, look, preset);
  if (preset.preset != appearance::StructurePresets::builtIn().lookFor(kOpenColor).preset)
    return look;
  std::vector<std::array<float, 3>> taken;
  for (const scene::LabelPart& labels : value.labels)
    for (const scene::StructurePart& one : labels.structures)
      if (one.name != part)
        taken.push_back(one.look.color);
  for (const scene::MeshPart& mesh : value.meshes)
    if (mesh.name != part)
      taken.push_back(mesh.look.color);
  appearance::setColor(look, appearance::DistinctColors(taken).next());
  return look;
}

StructureAppearance fitted(const StructureAppearance& look, const volume::IntensityScale& scale,
                           const volume::IntensityHistogram& histogram, std::optional<double> above)
{
  if (histogram.count() == 0)
    throw core::InvalidParameter("the image has no values there");
  const auto percentile = [&](double share)
  { return above ? histogram.percentile(share, *above) : histogram.percentile(share); };
  const double low = percentile(kRare);
  double high = percentile(1.0 - kRare);
  if (!(high > low))
    high = low + histogram.binWidth();
  const AppearanceEditor::Part part = partOf({}, look, scale);
  std::vector<ControlPoint> points = part.points;
  if (points.size() < 2)
  {
    const TransferFunction::Optics optics = part.transfer.at(low);
    ControlPoint dark{low, {}, opacityOf(optics), static_cast<float>(optics.specular)};
    ControlPoint bright = dark;
    bright.value = high;
    for (std::size_t c = 0; c < 3; ++c)
    {
      const auto color = static_cast<float>(optics.color[c]);
      dark.color[c] = kDarkShade * color;
      bright.color[c] = color + kBrightShade * (1.0F - color);
    }
    return withPoints(look, {dark, bright});
  }
  const double first = points.front().value;
  const double last = points.back().value;
  for (ControlPoint& point : points)
    point.value = low + (point.value - first) * (high - low) / (last - first);
  return withPoints(look, std::move(points));
}

StructureAppearance fitted(const scene::Case& value, const std::string& part,
                           const core::Progress& progress)
{
  const bool isBone = scene::meansBone(value, part);
  const bool isSoftTissue = scene::meansSoftTissue(value, part);
  const StructureAppearance* look = lookOf(value, isBone         ? AppearanceEditor::kBone
                                                  : isSoftTissue ? AppearanceEditor::kSoftTissue
                                                                 : part);
  if (!look)
    throw core::InvalidParameter("'" + part + "' is a mesh and reads no image");
  if (!look->solid)
    throw core::InvalidParameter("'" + part + "' is a lumen and reads the bone around it");
  if (isSoftTissue && !readsMr(value, *look))
    throw core::InvalidParameter("soft tissue of a CT is not fitted; apply a preset, whose values "
                                 "follow the image's scale");
  AppearanceHistograms histograms;
  if (const auto counting = histograms.counting(value))
    histograms.take(counting(progress));
  const auto histogram =
      isBone || isSoftTissue ? histograms.image(look->sourceImage) : histograms.within(value, part);
  if (!histogram || histogram->count() == 0)
    throw core::InvalidParameter("'" + part + "' has no voxel in the image that it reads");
  if (isSoftTissue)
    return withFunctionOfMr(*look, *histogram);
  const bool isOfSurface = isBone && look->sourceImage.empty();
  return fitted(*look, value.intensityScale(), *histogram,
                isOfSurface ? std::optional(value.iso) : std::nullopt);
}

} // namespace petrous::presenters
