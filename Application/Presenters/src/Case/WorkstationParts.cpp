#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "EditGroups.h"
#include "LookEdits.h"
#include "Notify.h"
#include "RecordedParts.h"
#include "SameLabels.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/CorrectedCase.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Scene/FreeName.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Scene/ReferenceFrames.h"

// WorkstationModel: parts of the open case are added, removed, brought back and renamed.
namespace petrous::presenters
{

namespace
{

// The appearances of a case, with the names of their parts; no other can be called as the first
// two.
template <class Case, class Act>
void forEachLook(Case& value, const Act& act)
{
  act("ct", value.boneLook);
  act(scene::kSoftTissue, value.softTissue);
  for (auto& part : value.labels)
    for (auto& structure : part.structures)
      act(structure.name, structure.look);
  for (auto& mesh : value.meshes)
    act(mesh.name, mesh.look);
}

// Whether what a look draws of an image's values is as the removal of the MR that it read left it.
// Of structures and bone, which keep their points, colours may have changed.
bool isAsLeft(const std::string& part, const appearance::StructureAppearance& look,
              appearance::StructureAppearance read)
{
  const bool isSoftTissue = part == scene::kSoftTissue;
  if (isSoftTissue)
    appearance::readPrimaryImage(read);
  else
    read.sourceImage.clear();
  if (look.sourceImage != read.sourceImage || look.relative != read.relative ||
      look.transfer.has_value() != read.transfer.has_value())
    return false;
  if (!look.transfer || isSoftTissue)
    return look.transfer == read.transfer;
  const auto& points = look.transfer->points();
  const auto& before = read.transfer->points();
  return std::equal(points.begin(), points.end(), before.begin(), before.end(),
                    [](const auto& a, const auto& b) { return a.value == b.value; });
}

template <class Parts>
std::size_t indexOf(const Parts& parts, const std::string& name)
{
  return static_cast<std::size_t>(std::find_if(parts.begin(), parts.end(),
                                               [&name](const auto& part)
                                               { return part.name == name; }) -
                                  parts.begin());
}

// The left-out part at `index`, which is about to be removed: as the library has it.
template <class Part, class Whole>
void forgetLeftOut(std::vector<Part>& parts, std::size_t index, Whole& whole)
{
  for (auto part = parts.begin(); part != parts.end();)
  {
    if (part->index == index)
    {
      whole = part->whole;
      part = parts.erase(part);
      continue;
    }
    part->index -= part->index > index;
    ++part;
  }
}

template <class T>
void makeRoom(std::vector<LeftOut::Part<T>>& parts, std::size_t index)
{
  for (auto& part : parts)
    part.index += part.index >= index;
}

template <class Parts, class At>
std::size_t putBack(Parts& parts, At& removed)
{
  const std::size_t index = std::min(removed.index, parts.size());
  parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(index), std::move(removed.part));
  return index;
}

} // namespace

void WorkstationModel::takeParts(const scene::Case& before, scene::Case with)
{
  if (!m_case)
    return;
  // What has one of the names by now, and what was added, stay two parts.
  auto names = scene::partNames(*m_case);
  const auto rename = [&names](std::string& name)
  {
    name = scene::freeName(name,
                           [&names](const std::string& taken)
                           {
                             return std::any_of(names.begin(), names.end(),
                                                [read = scene::asRead(taken)](const auto& one)
                                                { return scene::asRead(one) == read; });
                           });
    names.push_back(name);
  };
  std::map<std::string, std::string> images; // added MR: their names here
  for (std::size_t n = before.mr.size(); n < with.mr.size(); ++n)
  {
    std::string& name = images[with.mr[n].name];
    name = with.mr[n].name;
    rename(name);
    with.mr[n].name = name;
  }
  const auto follow = [&images](std::string& drawnOn)
  {
    if (const auto found = images.find(drawnOn); found != images.end())
      drawnOn = found->second;
  };
  for (scene::LabelPart& part : with.labels)
    if (part.drawnOn)
      follow(*part.drawnOn);
  for (scene::MeshPart& mesh : with.meshes)
    follow(mesh.drawnOn);
  // Another MR may have the grid of a map. The maps may be others by now, or in another order.
  for (std::size_t n = 0; n < std::min(before.labels.size(), with.labels.size()); ++n)
    for (scene::LabelPart& part : m_case->labels)
      if (part.object == before.labels[n].object &&
          part.labels.peek() == before.labels[n].labels.peek() &&
          part.drawnOn == before.labels[n].drawnOn)
      {
        part.drawnOn = with.labels[n].drawnOn;
        const auto& notes = with.labels[n].notes; // those that say so come last
        part.notes.insert(part.notes.end(),
                          notes.begin() + static_cast<std::ptrdiff_t>(std::min(
                                              before.labels[n].notes.size(), notes.size())),
                          notes.end());
      }
  forgetTissue();
  const auto append = [](auto& parts, auto& more, std::size_t from)
  {
    for (std::size_t n = from; n < more.size(); ++n)
      parts.push_back(std::move(more[n]));
  };
  for (std::size_t n = before.labels.size(); n < with.labels.size(); ++n)
    for (scene::StructurePart& structure : with.labels[n].structures)
      rename(structure.name);
  for (std::size_t n = before.meshes.size(); n < with.meshes.size(); ++n)
    rename(with.meshes[n].name);
  std::vector<std::string> added;
  for (std::size_t n = before.mr.size(); n < with.mr.size(); ++n)
    added.push_back(with.mr[n].name);
  for (std::size_t n = before.labels.size(); n < with.labels.size(); ++n)
    for (const scene::StructurePart& structure : with.labels[n].structures)
      added.push_back(structure.name);
  for (std::size_t n = before.meshes.size(); n < with.meshes.size(); ++n)
    added.push_back(with.meshes[n].name);
  append(m_case->mr, with.mr, before.mr.size());
  append(m_case->labels, with.labels, before.labels.size());
  append(m_case->meshes, with.meshes, before.meshes.size());
  append(m_case->origins, with.origins, before.origins.size());
  partsMoved();
  recordAddition(added);
}

// What was drawn on an added MR goes before it, and comes back after it.
void WorkstationModel::recordAddition(const std::vector<std::string>& names)
{
  if (names.empty())
    return;
  const auto removals = std::make_shared<std::vector<std::uint64_t>>();
  recordEdit({names.size() == 1 ? "addition of " + shownName(names.front())
                                : "addition of " + std::to_string(names.size()) + " parts",
              {},
              [this, names, removals]
              {
                removals->clear();
                try
                {
                  for (auto name = names.rbegin(); name != names.rend(); ++name)
                  {
                    takeOut(*name, m_removals + 1);
                    removals->push_back(++m_removals);
                  }
                }
                catch (const core::Error&) // without effect
                {
                  for (auto removal = removals->rbegin(); removal != removals->rend(); ++removal)
                    bringBack(*removal);
                  throw;
                }
              },
              [this, removals]
              {
                for (auto removal = removals->rbegin(); removal != removals->rend(); ++removal)
                  bringBack(*removal);
              },
              true});
}

// The case's parts are others; what was derived from its tissue is gone.
void WorkstationModel::partsMoved(Drawn drawn)
{
  m_nearby.reset();
  const bool wasLoaded = m_loaded;
  const bool wasDrawable = m_drawable;
  waitForParts();
  if (drawn != Drawn::Nothing && wasLoaded && !m_loaded)
  {
    m_loaded = true;
    m_drawable = wasDrawable && drawn == Drawn::Still;
  }
  notify(events.partsChanged);
  setUnsaved(true);
  notify(events.preparationWanted);
}

void WorkstationModel::removePart(const std::string& name)
{
  if (!m_case || drilling())
    return;
  const std::uint64_t removal = ++m_removals;
  takeOut(name, removal);
  recordEdit({"removal of " + shownName(name),
              {},
              [this, removal] { bringBack(removal); },
              [this, name, removal] { takeOut(name, removal); },
              true});
}

void WorkstationModel::takeOut(const std::string& name, std::uint64_t removal)
{
  scene::Case next = *m_case;
  RemovedPart removed;
  removed.name = name;
  removed.id = removal;
  // The one that scene::removePart takes, where parts of an older case have one name.
  std::size_t labelsAt = 0, meshAt = 0;
  for (std::size_t n = 0; n < next.labels.size() && !removed.labels; ++n)
    if (const std::size_t at = indexOf(next.labels[n].structures, name);
        at < next.labels[n].structures.size())
    {
      labelsAt = n;
      removed.labels = {n, next.labels[n]};
      removed.labels->part.structures = {next.labels[n].structures[at]};
      removed.structure = at;
      removed.wasAlone = next.labels[n].structures.size() == 1;
    }
  if (const std::size_t at = indexOf(next.meshes, name); at < next.meshes.size() && !removed.labels)
  {
    meshAt = at;
    removed.mesh = {at, next.meshes[at]};
  }
  if (const std::size_t at = indexOf(next.mr, name);
      at < next.mr.size() && !removed.labels && !removed.mesh)
  {
    removed.mr = {at, next.mr[at]};
    forEachLook(next,
                [&](const std::string& part, const appearance::StructureAppearance& look)
                {
                  if (look.sourceImage == name)
                    removed.readers.push_back({part, look});
                });
  }
  const std::vector<scene::Measurement> before = next.measurements;
  const bool areLabelsChanged = removed.labels.has_value();
  scene::removePart(next, name);
  for (std::size_t n = 0; n < before.size(); ++n)
    if (before[n] != next.measurements[n])
      removed.measured.push_back(before[n].name);

  forgetTissue();
  for (LeftOut& parts : m_leftOut)
  {
    if (removed.labels && removed.wasAlone)
      forgetLeftOut(parts.labels, labelsAt, removed.labels->part.labels);
    if (removed.mesh)
      forgetLeftOut(parts.meshes, meshAt, removed.mesh->part.mesh);
  }
  m_case->mr = std::move(next.mr);
  m_case->labels = std::move(next.labels);
  m_case->meshes = std::move(next.meshes);
  m_case->boneLook = next.boneLook;
  m_case->softTissue = next.softTissue;
  m_removed.push_back(std::move(removed));
  m_partsMoved = true;
  if (m_assembly.thicknessOver() == name)
    m_assembly.showThickness({});
  partsMoved(areLabelsChanged ? Drawn::UntilPrepared : Drawn::Still);
  setMeasurements(std::move(next.measurements));
}

std::string WorkstationModel::removedPart() const
{
  return m_removed.empty() ? std::string() : m_removed.back().name;
}

void WorkstationModel::restorePart()
{
  if (!m_case || drilling() || m_removed.empty())
    return;
  const std::string name = m_removed.back().name;
  const std::uint64_t removal = m_removed.back().id;
  const std::vector<PartLook> readers = m_removed.back().readers;
  bringBack(removal);
  recordEdit({"return of " + shownName(name),
              {},
              [this, name, removal, readers]
              {
                takeOut(name, removal);
                // Those that were edited, and are undone next, read it again with the removal.
                std::vector<PartLook>& present = m_removed.back().readers;
                for (const PartLook& reader : readers)
                  if (std::none_of(present.begin(), present.end(),
                                   [&reader](const PartLook& one)
                                   { return one.part == reader.part; }))
                    present.push_back(reader);
              },
              [this, removal] { bringBack(removal); },
              true});
}

void WorkstationModel::bringBack(std::uint64_t removal)
{
  const auto found =
      std::find_if(m_removed.begin(), m_removed.end(),
                   [removal](const RemovedPart& removed) { return removed.id == removal; });
  if (found == m_removed.end())
    throw core::InvalidParameter("what was taken out is in the case again");
  RemovedPart& removed = *found;
  const auto names = scene::partNames(*m_case);
  if (std::find(names.begin(), names.end(), removed.name) != names.end())
    throw core::InvalidParameter("'" + removed.name +
                                 "' cannot come back: another part has its name now; rename that "
                                 "one first");
  for (const std::string& mr :
       {removed.labels ? removed.labels->part.drawnOn.value_or(std::string()) : std::string(),
        removed.mesh ? removed.mesh->part.drawnOn : std::string()})
    if (!mr.empty() && !scene::findMr(*m_case, mr))
      throw core::InvalidParameter("'" + removed.name + "' cannot come back: the MR '" + mr +
                                   "' on which it was drawn is not in the case any more");
  forgetTissue();
  const bool isLabel = removed.labels.has_value();
  const bool isRead = (!removed.labels || removed.labels->part.labels.peek()) &&
                      (!removed.mesh || removed.mesh->part.mesh.peek());
  if (removed.mr)
  {
    putBack(m_case->mr, *removed.mr);
    for (scene::LabelPart& part : m_case->labels)
      for (scene::StructurePart& structure : part.structures)
        for (scene::MrReading& reading : structure.readings)
          reading.isGone = reading.isGone && reading.mr != removed.name;
    forEachLook(*m_case,
                [&](const std::string& part, appearance::StructureAppearance& look)
                {
                  for (const PartLook& reader : removed.readers)
                  {
                    if (reader.part != part || !isAsLeft(part, look, reader.look))
                      continue;
                    look.sourceImage = removed.name;
                    if (part != scene::kSoftTissue)
                      continue;
                    look.preset = reader.look.preset;
                    look.color = reader.look.color;
                    look.transfer = reader.look.transfer;
                    look.relative = reader.look.relative;
                  }
                });
  }
  if (removed.labels)
  {
    scene::LabelPart& part = removed.labels->part;
    const auto rest =
        std::find_if(m_case->labels.begin(), m_case->labels.end(),
                     [&part](const scene::LabelPart& one) { return haveSameLabels(one, part); });
    if (!removed.wasAlone && rest != m_case->labels.end())
    {
      const std::size_t at = std::min(removed.structure, rest->structures.size());
      rest->structures.insert(rest->structures.begin() + static_cast<std::ptrdiff_t>(at),
                              part.structures.front());
    }
    else
    {
      const std::size_t at = putBack(m_case->labels, *removed.labels);
      for (LeftOut& parts : m_leftOut)
        makeRoom(parts.labels, at);
    }
  }
  if (removed.mesh)
  {
    const std::size_t at = putBack(m_case->meshes, *removed.mesh);
    for (LeftOut& parts : m_leftOut)
      makeRoom(parts.meshes, at);
  }
  auto measurements = m_case->measurements;
  scene::recallStructure(measurements, removed.name, removed.measured);
  m_removed.erase(found);
  m_partsMoved = true;
  partsMoved(!isRead ? Drawn::Nothing : isLabel ? Drawn::UntilPrepared : Drawn::Still);
  setMeasurements(std::move(measurements));
}

// What was taken out may come back, to the map or the MR whose axes are others then.
void WorkstationModel::correctAxes(const std::string& part, const core::AxesCorrection& axes)
{
  if (!m_case || drilling())
    return;
  const AxesPart corrected = axesPart(*m_case, part); // and no namesake that was taken out
  scene::Case next = *m_case;
  for (const RemovedPart& removed : m_removed)
  {
    if (removed.labels)
      next.labels.push_back(removed.labels->part);
    if (removed.mesh)
      next.meshes.push_back(removed.mesh->part);
  }
  scene::Case present = next; // shares what is read
  correctPart(next, corrected, axes);
  PlacedParts before, after;
  for (std::size_t n = 0; n < next.mr.size(); ++n)
    if (next.mr[n].provenance.axes != present.mr[n].provenance.axes)
    {
      before.mr.push_back(present.mr[n]);
      after.mr.push_back(next.mr[n]);
    }
  const auto places = scene::mrPlaces(present);
  for (const scene::MrPlace& place : scene::mrPlaces(next))
    for (const scene::MrPlace& was : places)
      if (was.name == place.name && was.registered != place.registered)
      {
        before.places.push_back(was);
        after.places.push_back(place);
      }
  const auto addMoved = [](auto PlacedParts::*kind, auto data, auto& from, auto& to,
                           PlacedParts& placed, PlacedParts& moved)
  {
    for (std::size_t n = 0; n < to.size(); ++n)
      if ((from[n].*data).peek() != (to[n].*data).peek())
      {
        (placed.*kind).push_back(from[n]);
        (moved.*kind).push_back(to[n]);
      }
  };
  addMoved(&PlacedParts::labels, &scene::LabelPart::labels, present.labels, next.labels, before,
           after);
  addMoved(&PlacedParts::meshes, &scene::MeshPart::mesh, present.meshes, next.meshes, before,
           after);
  for (const LeftOut& parts : m_leftOut)
  {
    const auto isLeftOut = [](const auto& left, const auto& of, const auto& with, auto data)
    {
      return std::any_of(
          left.begin(), left.end(),
          [&](const auto& one)
          { return (of.at(one.index).*data).peek() != (with.at(one.index).*data).peek(); });
    };
    if (isLeftOut(parts.labels, present.labels, next.labels, &scene::LabelPart::labels) ||
        isLeftOut(parts.meshes, present.meshes, next.meshes, &scene::MeshPart::mesh))
      throw core::Error(core::Fault::Refused, "'" + part +
                                                  "' keeps its axes: what goes with it could not "
                                                  "be read");
  }
  // What was measured by them lies where they were; what follows what was taken out as well.
  const std::size_t structures = m_case->labels.size(), meshes = m_case->meshes.size();
  for (scene::Case* one : {&present, &next})
  {
    one->labels.resize(std::min(structures, one->labels.size()));
    one->meshes.resize(std::min(meshes, one->meshes.size()));
  }
  const std::vector<std::string> moved = movedNames(present, next);
  std::map<std::uint64_t, std::vector<std::string>> ofRemoved;
  for (const RemovedPart& removed : m_removed)
  {
    const auto isMoved = [](const auto& data, const auto& parts, auto kind)
    {
      return std::any_of(parts.begin(), parts.end(),
                         [&](const auto& one) { return (one.*kind).peek() == data.peek(); });
    };
    if ((removed.labels &&
         isMoved(removed.labels->part.labels, before.labels, &scene::LabelPart::labels)) ||
        (removed.mesh && isMoved(removed.mesh->part.mesh, before.meshes, &scene::MeshPart::mesh)))
      ofRemoved[removed.id] = removed.measured;
  }
  const auto measured =
      std::make_shared<std::vector<std::pair<std::string, std::vector<std::string>>>>();
  const auto place = [this, before, after, moved, ofRemoved, measured]
  {
    placeParts(before, after);
    for (RemovedPart& removed : m_removed)
      if (ofRemoved.count(removed.id) > 0)
        removed.measured.clear();
    measured->clear();
    auto measurements = m_case->measurements;
    for (const std::string& name : moved)
      measured->emplace_back(name, scene::forgetStructure(measurements, name));
    setMeasurements(std::move(measurements));
  };
  place();
  recordEdit({"axes of " + shownName(part),
              {},
              [this, before, after, ofRemoved, measured]
              {
                placeParts(after, before);
                for (RemovedPart& removed : m_removed)
                  if (const auto was = ofRemoved.find(removed.id); was != ofRemoved.end())
                    removed.measured = was->second;
                auto measurements = m_case->measurements;
                for (const auto& [name, which] : *measured)
                  scene::recallStructure(measurements, name, which);
                setMeasurements(std::move(measurements));
              },
              place,
              true,
              after.mr.empty() ? "" : kMrAxes});
}

// Parts are found by their data: their names and places in the case may be others.
void WorkstationModel::placeParts(const PlacedParts& from, const PlacedParts& to)
{
  const auto forEach = [this](auto kind, auto list, const auto& act)
  {
    for (auto& part : (*m_case).*list)
      act(part);
    for (RemovedPart& removed : m_removed)
      if (auto& one = removed.*kind)
        act(one->part);
  };
  std::size_t found = 0;
  for (std::size_t n = 0; n < to.mr.size(); ++n)
    for (scene::ImagePart& mr : m_case->mr)
      if (mr.volume.peek() == from.mr[n].volume.peek())
      {
        mr.geometry = to.mr[n].geometry;
        mr.volume = to.mr[n].volume;
        mr.object = to.mr[n].object;
        mr.provenance.axes = to.mr[n].provenance.axes;
        mr.notes = to.mr[n].notes;
        ++found;
      }
  for (std::size_t n = 0; n < to.labels.size(); ++n)
    forEach(&RemovedPart::labels, &scene::Case::labels,
            [&, was = from.labels[n].labels.peek()](scene::LabelPart& part)
            {
              if (part.labels.peek() != was)
                return;
              if (to.labels[n].drawnOn != from.labels[n].drawnOn) // an older case's, by the grid
                part.drawnOn = to.labels[n].drawnOn;
              part.labels = to.labels[n].labels;
              part.object = to.labels[n].object;
              part.provenance.axes = to.labels[n].provenance.axes;
              part.notes = to.labels[n].notes;
              part.moved = {};
              ++found;
            });
  for (std::size_t n = 0; n < to.meshes.size(); ++n)
    forEach(&RemovedPart::mesh, &scene::Case::meshes,
            [&, was = from.meshes[n].mesh.peek()](scene::MeshPart& part)
            {
              if (part.mesh.peek() != was)
                return;
              part.mesh = to.meshes[n].mesh;
              part.object = to.meshes[n].object;
              part.notes = to.meshes[n].notes;
              part.moved = {};
              part.touch = {};
              ++found;
            });
  if (found == 0)
    throw core::InvalidParameter("the axes stay: what was corrected was replaced since");
  forgetTissue(); // an MR may be felt, too
  scene::layAs(*m_case, to.places);
  m_partsMoved = true;
  if (to.labels.empty() && to.meshes.empty())
    partsMoved(Drawn::Still);
  else
    labelsChanged();
  if (!to.mr.empty())
    notify(events.mrMoved);
}

void WorkstationModel::renamePart(const std::string& name, const std::string& to)
{
  if (!m_case || drilling() || name == to)
    return;
  scene::checkNewPartName(*m_case, name, to);
  rename(name, to);
  recordEdit({"name of " + shownName(to),
              {},
              [this, name, to] { rename(to, name); },
              [this, name, to] { rename(name, to); },
              true});
}

void WorkstationModel::rename(const std::string& name, const std::string& to)
{
  scene::checkPartName(to);
  const auto names = scene::partNames(*m_case);
  if (name == "ct" || std::find(names.begin(), names.end(), name) == names.end())
    throw core::InvalidParameter("the case has no part '" + name + "' that can be renamed");
  if (std::find(names.begin(), names.end(), to) != names.end())
    throw core::InvalidParameter("'" + to + "' is in the case already; take another name");
  if (isRecorded(*m_case, name))
    throw core::Error(core::Fault::Refused,
                      "'" + name +
                          "' keeps its name: strokes of this case record under it what was "
                          "removed from it");
  forgetTissue();
  const auto follow = [&](std::string& text)
  {
    if (text == name)
      text = to;
  };
  if (scene::findMr(*m_case, name))
  {
    for (scene::ImagePart& mr : m_case->mr)
    {
      follow(mr.name);
      if (mr.registration)
        follow(mr.registration->through);
    }
    const auto followReadings = [&follow](scene::LabelPart& part)
    {
      for (scene::StructurePart& structure : part.structures)
        for (scene::MrReading& reading : structure.readings)
          if (!reading.isGone)
            follow(reading.mr);
    };
    for (scene::LabelPart& part : m_case->labels)
    {
      if (part.drawnOn)
        follow(*part.drawnOn);
      followReadings(part);
    }
    for (scene::MeshPart& mesh : m_case->meshes)
      follow(mesh.drawnOn);
    for (scene::Measurement& measurement : m_case->measurements)
    {
      follow(measurement.image);
      std::for_each(measurement.images.begin(), measurement.images.end(), follow);
    }
    forEachLook(*m_case, [&](const std::string&, appearance::StructureAppearance& look)
                { follow(look.sourceImage); });
    if (auto& slices = m_case->view.slices; slices && slices->overlay)
      follow(slices->overlay->mr);
    for (RemovedPart& removed : m_removed) // may come back
    {
      if (removed.mr && removed.mr->part.registration)
        follow(removed.mr->part.registration->through);
      if (removed.labels)
      {
        if (removed.labels->part.drawnOn)
          follow(*removed.labels->part.drawnOn);
        followReadings(removed.labels->part);
        for (scene::StructurePart& structure : removed.labels->part.structures)
          follow(structure.look.sourceImage);
      }
      if (removed.mesh)
      {
        follow(removed.mesh->part.drawnOn);
        follow(removed.mesh->part.look.sourceImage);
      }
    }
  }
  for (scene::LabelPart& part : m_case->labels)
    for (scene::StructurePart& structure : part.structures)
      follow(structure.name);
  for (scene::MeshPart& mesh : m_case->meshes)
    follow(mesh.name);
  for (scene::Measurement& measurement : m_case->measurements)
    if (!measurement.structureGone)
      follow(measurement.structure);
  for (RemovedPart& removed : m_removed)
    for (PartLook& reader : removed.readers)
      follow(reader.part);
  m_assembly.renamed(name, to);
  notify(events.partRenamed, name, to);
  partsMoved(Drawn::Still);
}

// The map stays whole: its other structures, and its object in the library, are as they were.
std::optional<scene::LabelPart> WorkstationModel::removeLabels(const std::string& structure)
{
  for (std::size_t n = 0; n < m_case->labels.size(); ++n)
  {
    auto& structures = m_case->labels[n].structures;
    const auto found = std::find_if(structures.begin(), structures.end(),
                                    [&](const auto& one) { return one.name == structure; });
    if (found == structures.end())
      continue;
    scene::LabelPart taken = m_case->labels[n];
    taken.structures = {*found};
    structures.erase(found);
    for (const LeftOut& parts : m_leftOut) // as the library has it, not the empty stand-in
      for (const auto& part : parts.labels)
        if (part.index == n)
          taken.labels = part.whole;
    if (structures.empty())
    {
      m_case->labels.erase(m_case->labels.begin() + static_cast<std::ptrdiff_t>(n));
      for (LeftOut& parts : m_leftOut)
        forgetLeftOut(parts.labels, n, taken.labels);
    }
    return taken;
  }
  return std::nullopt;
}

// It may be put back, see recallStructures; another one of its name is another.
void WorkstationModel::forgetStructure(const std::string& name, const scene::LabelPart& taken)
{
  if (scene::kindOfPart(*m_case, name))
    return;
  auto measurements = m_case->measurements;
  auto measured = scene::forgetStructure(measurements, name);
  if (measured.empty())
    return;
  m_taken.push_back({taken.labels.peek(), name, std::move(measured)});
  setMeasurements(std::move(measurements));
}

void WorkstationModel::recallStructures(const scene::LabelPart& part,
                                        const scene::LabelPart* inPlaceOf)
{
  const auto isOf = [](const TakenStructure& taken, const scene::LabelPart& one)
  {
    const auto labels = taken.labels.lock();
    return labels && labels == one.labels.peek();
  };
  auto measurements = m_case->measurements;
  for (auto taken = m_taken.begin(); taken != m_taken.end();)
  {
    const bool isBack = (isOf(*taken, part) || (inPlaceOf && isOf(*taken, *inPlaceOf))) &&
                        std::any_of(part.structures.begin(), part.structures.end(),
                                    [&](const auto& one) { return one.name == taken->name; });
    if (isBack)
      scene::recallStructure(measurements, taken->name, taken->measured);
    taken = isBack || taken->labels.expired() ? m_taken.erase(taken) : taken + 1;
  }
  setMeasurements(std::move(measurements));
}

void WorkstationModel::labelsChanged()
{
  forgetTissue();
  const std::string over = thicknessOver();
  m_assembly.showThickness({}); // measured anew
  if (scene::findStructure(*m_case, over) || scene::findMesh(*m_case, over))
    m_assembly.showThickness(over);
  partsMoved();
}

std::optional<scene::LabelPart>
WorkstationModel::addStructure(volume::LabelMap labels, const std::string& replaced,
                               const scene::MrReadings& readings, const scene::TracedTubes& tubes,
                               const std::vector<std::string>& doubts)
{
  if (!m_case)
    return std::nullopt;
  const auto before = m_case->labels;
  const auto leftOut = m_leftOut;
  auto taken = removeLabels(replaced);
  try
  {
    addStructures(*m_case, std::move(labels));
  }
  catch (...)
  {
    m_case->labels = before;
    m_leftOut = leftOut;
    throw;
  }
  for (scene::StructurePart& structure : m_case->labels.back().structures)
  {
    structure.readings = readings;
    structure.tubes = tubes;
  }
  auto& notes = m_case->labels.back().notes;
  notes.insert(notes.end(), doubts.begin(), doubts.end());
  if (taken)
  {
    scene::LabelPart& added = m_case->labels.back();
    added.provenance = taken->provenance;
    for (scene::StructurePart& structure : added.structures)
      if (structure.name == replaced ||
          keepsLook(structure.name, taken->structures.front().look.preset))
        keepIdentity(structure, taken->structures.front());
  }
  labelsChanged();
  if (taken)
    forgetStructure(replaced, *taken);
  return taken;
}

std::optional<scene::LabelPart> WorkstationModel::takeStructure(const std::string& name)
{
  auto taken = m_case ? removeLabels(name) : std::nullopt;
  if (taken)
  {
    labelsChanged();
    forgetStructure(name, *taken);
  }
  return taken;
}

void WorkstationModel::putStructure(const scene::LabelPart& part, const scene::LabelPart* inPlaceOf)
{
  if (!m_case)
    return;
  for (const scene::StructurePart& structure : part.structures)
    if (scene::findStructure(*m_case, structure.name))
      throw core::InvalidParameter("structure '" + structure.name +
                                   "' is in the case already; remove it first");
  m_case->labels.push_back(part);
  labelsChanged();
  recallStructures(part, inPlaceOf);
}

} // namespace petrous::presenters
