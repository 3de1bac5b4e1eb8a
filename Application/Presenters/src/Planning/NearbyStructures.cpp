#include "petrous/Presenters/NearbyStructures.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Scene/Branches.h"

namespace petrous::presenters
{

namespace
{

constexpr double kSlack = 1e-3; // mm; what is as far as the search goes is left out

const appearance::StructureAppearance* lookOf(const scene::Case& value, const std::string& name)
{
  if (const auto* structure = scene::findStructure(value, name))
    return &structure->look;
  for (const scene::MeshPart& mesh : value.meshes)
    if (mesh.name == name)
      return &mesh.look;
  return nullptr;
}

// A warning does not depend on whether its structure is shown.
bool measured(const scene::Case& value, const std::string& name)
{
  const auto* look = lookOf(value, name);
  return look && (look->shown || look->warning > 0.0);
}

// A lumen is opened, not injured, and its proximity is reported only if a warning distance is set.
bool lumen(const appearance::StructureAppearance* look)
{
  return look && !look->solid;
}

// It may be in a warning, if the tool comes near enough.
bool warnedOf(const appearance::StructureAppearance& look)
{
  return look.warning > 0.0 || (look.shown && look.solid);
}

// nullptr if it cannot be measured. Throws CancelledError.
std::shared_ptr<const volume::SurfaceDistance> tried(const StructureSurfaces::Measurer& measurer,
                                                     const core::Progress& progress)
{
  try
  {
    return measurer(progress);
  }
  catch (const core::CancelledError&)
  {
    throw;
  }
  catch (const std::exception&) // out of memory; the others can still be measured
  {
    return nullptr;
  }
}

std::string listed(const std::vector<std::string>& names)
{
  std::string text;
  for (std::size_t n = 0; n < std::min(names.size(), kMaxWarnings); ++n)
    text += (text.empty() ? "" : ", ") + shownName(names[n]);
  if (names.size() > kMaxWarnings)
    text += " and " + std::to_string(names.size() - kMaxWarnings) + " more";
  return text;
}

} // namespace

std::string cubicMillimetres(double volume)
{
  if (volume > 0.0 && volume < 0.005)
    return "under 0.01 mm³";
  return core::fixedText(volume, 2) + " mm³";
}

std::string toString(const NearbyStructure& structure)
{
  std::string text = shownName(structure.name);
  const std::string uncertainty = core::fixedText(structure.unsure(), 1);
  if (structure.state == NearbyStructure::State::Touched)
    text += " touched (± " + uncertainty + " mm)";
  else
    text += " " + core::fixedText(0.1 * std::round(10.0 * structure.distance) + 0.0, 1) + // no -0.0
            " mm ± " + uncertainty;
  if (structure.uncertainty.incomplete())
    text += "; registration's error unknown";
  else if (const auto& error = structure.uncertainty.registration)
    text += error->place.empty()
                ? "; registration " + core::fixedText(error->p95, 1) + " mm (p95)"
                : "; registration " + core::fixedText(error->p95, 1) + " mm (p95), but " +
                      core::fixedText(error->away, 0) + " mm from here";
  return text;
}

std::string warningsOf(const std::vector<NearbyStructure>& structures)
{
  using State = NearbyStructure::State;
  std::vector<const NearbyStructure*> worst;
  for (const NearbyStructure& structure : structures)
    if (structure.state != State::Clear || structure.injured > 0.0)
      worst.push_back(&structure);
  std::stable_sort(worst.begin(), worst.end(),
                   [](const NearbyStructure* a, const NearbyStructure* b)
                   { return a->state > b->state; });
  std::string text;
  for (std::size_t n = 0; n < std::min(worst.size(), kMaxWarnings); ++n)
  {
    text += (text.empty() ? "" : "\n") + toString(*worst[n]);
    if (worst[n]->injured > 0.0)
      text += "; injured, " + cubicMillimetres(worst[n]->injured);
  }
  if (worst.size() > kMaxWarnings)
    text += "\nand " + std::to_string(worst.size() - kMaxWarnings) + " more";
  return text;
}

bool canBeWarnedOf(const scene::Case& value)
{
  const auto isWarnedOf = [](const auto& part) { return warnedOf(part.look); };
  return std::any_of(
             value.labels.begin(), value.labels.end(),
             [&](const scene::LabelPart& part)
             { return std::any_of(part.structures.begin(), part.structures.end(), isWarnedOf); }) ||
         std::any_of(value.meshes.begin(), value.meshes.end(), isWarnedOf);
}

std::string toString(const UnmeasuredStructures& structures)
{
  std::string text;
  if (!structures.pending.empty())
    text = "no warnings of " + listed(structures.pending) + " yet: still being measured";
  if (!structures.failed.empty())
    text += (text.empty() ? "" : "\n") +
            ("no warnings of " + listed(structures.failed) + ": cannot be measured");
  return text;
}

std::map<std::string, double> injuredVolumes(const scene::Case& value,
                                             const dissection::RemovedVolume& open)
{
  std::map<std::string, double> volumes;
  for (const auto& touched :
       scene::summaryOf(value, value.dissection.history().position()).structures)
    volumes[touched.name] = touched.volume;
  for (const auto& touched : open.structures)
    volumes[touched.name] += touched.volume;
  for (auto at = volumes.begin(); at != volumes.end();)
    at = lumen(lookOf(value, at->first)) ? volumes.erase(at) : std::next(at);
  return volumes;
}

NearbyStructures::NearbyStructures(const scene::Case& value)
  : m_stop(std::make_shared<core::CancelToken>())
{
  scene::Case copy = value; // shares voxels
  copy.dissection.unload(); // not needed
  m_surfaces = std::async(std::launch::async,
                          [copy = std::move(copy), progress = core::Progress(nullptr, m_stop)]
                          {
                            auto surfaces = std::make_shared<StructureSurfaces>(copy);
                            for (std::size_t n = 0; n < surfaces->count(); ++n)
                              if (measured(copy, surfaces->name(n)))
                                if (auto surface = tried(surfaces->measurer(n), progress))
                                  surfaces->take(n, std::move(surface));
                            return surfaces; // what failed is tried again by measureLater
                          });
}

NearbyStructures::~NearbyStructures()
{
  m_stop->cancel(); // the future's destructor waits
}

bool NearbyStructures::ready() const
{
  return m_surfaces.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

StructureSurfaces& NearbyStructures::surfaces() const
{
  return *m_surfaces.get();
}

// Takes over what was measured, begins with what is missing, and notes what is.
void NearbyStructures::measureLater(const scene::Case& value)
{
  StructureSurfaces& surfaces = this->surfaces();
  if (m_later.valid() && m_later.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
  {
    const auto later = std::exchange(m_later, {}); // what it throws it throws once
    for (const auto& [structure, surface] : later.get())
      if (surface)
        surfaces.take(structure, surface);
      else
        m_failed.insert(structure);
  }
  m_unmeasured = {};
  std::vector<std::pair<std::size_t, StructureSurfaces::Measurer>> missing;
  for (std::size_t n = 0; n < surfaces.count(); ++n)
  {
    if (!measured(value, surfaces.name(n)) || surfaces.isMeasured(n))
      continue;
    const bool isFailed = m_failed.count(n) > 0;
    (isFailed ? m_unmeasured.failed : m_unmeasured.pending).push_back(surfaces.name(n));
    if (!isFailed && !m_later.valid())
      missing.emplace_back(n, surfaces.measurer(n));
  }
  if (missing.empty())
    return;
  m_later = std::async(std::launch::async,
                       [missing = std::move(missing), progress = core::Progress(nullptr, m_stop)]
                       {
                         Measured result;
                         for (const auto& [structure, measurer] : missing)
                           result.emplace_back(structure, tried(measurer, progress));
                         return result;
                       });
}

std::vector<NearbyStructure> NearbyStructures::around(const scene::Case& value,
                                                      const Eigen::Vector3d& center, double radius,
                                                      double reach,
                                                      const dissection::RemovedVolume& open)
{
  haptics::Pose pose;
  pose.position = center;
  return around(value, MeasuredTool(radius), pose, reach, open);
}

std::vector<NearbyStructure> NearbyStructures::around(const scene::Case& value,
                                                      const MeasuredTool& tool,
                                                      const haptics::Pose& pose, double reach,
                                                      const dissection::RemovedVolume& open)
{
  std::vector<NearbyStructure> near;
  if (!ready())
    return near;
  measureLater(value);
  StructureSurfaces& surfaces = this->surfaces();
  const auto injured = injuredVolumes(value, open);
  for (std::size_t n = 0; n < surfaces.count(); ++n)
  {
    NearbyStructure structure;
    structure.name = surfaces.name(n);
    const auto* look = lookOf(value, structure.name);
    if (!look || !measured(value, structure.name) || !surfaces.isMeasured(n) ||
        (reach <= 0.0 && !warnedOf(*look)))
      continue;
    structure.uncertainty = surfaces.uncertainty(n);
    const double unsure = structure.uncertainty.millimetres();
    const auto taken = injured.find(structure.name);
    structure.injured = taken == injured.end() ? 0.0 : taken->second;
    const double warnedFrom = look->warning > 0.0 ? look->warning + unsure : 0.0;
    const double most =
        structure.injured > 0.0
            ? StructureSurfaces::kFar
            : std::max(reach, warnedFrom + (tool.isInstrument() ? tool.sampling() + kSlack : 0.0));
    const MeasuredTool::Distance away = tool.distance(
        pose,
        [&](const Eigen::Vector3d& patient, double far)
        { return surfaces.distance(n, patient, far); },
        most,
        [&](const Eigen::Vector3d& patient, double far)
        { return surfaces.bound(n, patient, far); });
    if (!(away.millimetres < most))
      continue;
    structure.distance = std::max(0.0, away.millimetres);
    structure.sampling = away.sampling;
    structure.color = look->color;
    structure.warning = look->warning;
    structure.state =
        lumen(look) && !(look->warning > 0.0) ? NearbyStructure::State::Clear
        : away.millimetres <= 0.0             ? NearbyStructure::State::Touched
        : look->warning > 0.0 && structure.distance - structure.unsure() < look->warning
            ? NearbyStructure::State::Warned
        // It may be reached between the points that are measured.
        : structure.distance - structure.sampling <= 0.0 ? NearbyStructure::State::Warned
                                                         : NearbyStructure::State::Clear;
    if (!look->shown && structure.state == NearbyStructure::State::Clear &&
        !(structure.injured > 0.0))
      continue;
    near.push_back(std::move(structure));
  }
  std::sort(near.begin(), near.end(),
            [](const NearbyStructure& a, const NearbyStructure& b)
            { return a.distance < b.distance || (a.distance == b.distance && a.name < b.name); });
  return near;
}

} // namespace petrous::presenters
