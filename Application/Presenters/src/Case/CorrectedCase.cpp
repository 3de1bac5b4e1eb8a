#include "petrous/Presenters/CorrectedCase.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "CorrectAxes.h"
#include "RecordedParts.h"
#include "SameLabels.h"
#include "petrous/Presenters/ProvenanceText.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Scene/RemoveMr.h"
#include "petrous/Volume/OnGrid.h"

namespace petrous::presenters
{

namespace
{

// By where they lie and not by name, as names may be there twice in an older case.
void leaveMrsBehind(scene::Case& value)
{
  const auto leave = [&value](auto& parts)
  {
    parts.erase(std::remove_if(parts.begin(), parts.end(),
                               [&value](const auto& part)
                               { return !scene::placementOf(value, part).drawnOn.empty(); }),
                parts.end());
  };
  leave(value.labels);
  leave(value.meshes);
  while (!value.mr.empty())
    scene::removeMr(value, std::string(value.mr.back().name));
}

void forget(std::vector<std::string>& notes, const std::string& note)
{
  notes.erase(std::remove(notes.begin(), notes.end(), note), notes.end());
}

// The correction that a note states as correctedAxesText or followedNote.
std::optional<core::AxesCorrection> statedBy(const std::string& note)
{
  constexpr std::size_t kLetters = 3;
  const std::size_t at = note.rfind('(');
  if (at == std::string::npos)
    return std::nullopt;
  try
  {
    const auto axes = core::AxesCorrection::parse(note.substr(at + 1, kLetters));
    scene::ImagePart image; // whatever its name was
    image.provenance.axes = axes;
    std::string follows = followedNote(image);
    follows.erase(0, follows.find("' as "));
    const bool isFollowing =
        note.size() > follows.size() &&
        note.compare(note.size() - follows.size(), follows.size(), follows) == 0;
    return isFollowing || note == correctedAxesText(axes) ? std::optional(axes) : std::nullopt;
  }
  catch (const core::InvalidParameter&)
  {
    return std::nullopt; // something else in brackets
  }
}

// All that the notes of a mesh state, which keeps no provenance.
core::AxesCorrection statedBy(const std::vector<std::string>& notes)
{
  core::AxesCorrection axes;
  for (const std::string& note : notes)
    axes = statedBy(note).value_or(core::AxesCorrection()) * axes;
  return axes;
}

// In place of what they stated: the axes of what was drawn on an image.
void noteAxes(std::vector<std::string>& notes, const core::AxesCorrection& axes,
              const scene::ImagePart& image)
{
  notes.erase(std::remove_if(notes.begin(), notes.end(),
                             [](const std::string& note) { return statedBy(note).has_value(); }),
              notes.end());
  if (!axes.isIdentity())
    notes.push_back(axes == image.provenance.axes ? followedNote(image) : correctedAxesText(axes));
}

[[noreturn]] void failIdentity()
{
  throw core::InvalidParameter("axes: LPS leaves them as they are; say where what the file calls "
                               "left, posterior and superior really points, such as RPS");
}

// The structures of a map may be in several parts: all that lie on the one that holds a structure.
std::vector<const scene::LabelPart*> mapOf(const scene::Case& value, const std::string& structure)
{
  const auto& all = value.labels;
  const auto holder =
      std::find_if(all.begin(), all.end(),
                   [&structure](const scene::LabelPart& map)
                   {
                     return std::any_of(map.structures.begin(), map.structures.end(),
                                        [&](const auto& one) { return one.name == structure; });
                   });
  std::vector<const scene::LabelPart*> parts;
  if (holder == all.end())
    return parts;
  const std::string on = scene::placementOf(value, *holder).drawnOn;
  for (const scene::LabelPart& map : all)
    if (haveSameLabels(map, *holder) && scene::placementOf(value, map).drawnOn == on)
      parts.push_back(&map);
  return parts;
}

// An older case does not say on which of several MRs of one grid a map was drawn. As soon as the
// grid of one is another, it would be taken to be of the others.
void checkPlaceKnown(const scene::Case& value, const AxesPart& corrected)
{
  for (const scene::LabelPart& map : value.labels)
  {
    if (map.drawnOn || value.mr.size() < 2 || map.structures.empty())
      continue;
    const auto mrs = scene::mrWithGrid(value, map.labels.get()->voxels->geometry());
    if (mrs.size() < 2)
      continue;
    const std::string why = scene::placementOf(value, map).missing;
    if (corrected.kind == AxesPart::Kind::Mr &&
        std::find(mrs.begin(), mrs.end(), corrected.name) != mrs.end())
      throw core::Error(core::Fault::Refused, "'" + corrected.name + "' keeps its axes: whether '" +
                                                  map.structures.front().name +
                                                  "' goes with it is not known: " + why);
    if (corrected.kind == AxesPart::Kind::Structure &&
        std::any_of(map.structures.begin(), map.structures.end(),
                    [&](const auto& one) { return one.name == corrected.name; }))
      throw core::Error(core::Fault::Refused, "'" + corrected.name + "' keeps its axes: " + why);
  }
}

// `image`: on which it was drawn, as it is by now.
void correctMap(scene::LabelPart& part, const core::AxesCorrection& axes,
                const scene::ImagePart& image)
{
  const auto labels = part.labels.get();
  part.labels = std::make_shared<const volume::LabelMap>(
      volume::onGrid(*labels, axes.applied(labels->voxels->geometry(), image.geometry.center())));
  part.object.clear();
  part.moved = {};
  part.provenance.axes = axes * part.provenance.axes;
  noteAxes(part.notes, part.provenance.axes, image);
}

void correctMesh(scene::MeshPart& part, const core::AxesCorrection& axes,
                 const scene::ImagePart& image)
{
  core::TriangleMesh mesh = *part.mesh.get();
  correctAxes(mesh, axes, image.geometry.center());
  part.mesh = std::make_shared<const core::TriangleMesh>(std::move(mesh));
  part.object.clear();
  part.moved = {};
  part.touch = {};
  noteAxes(part.notes, axes * statedBy(part.notes), image);
}

void correctMr(scene::Case& value, const std::string& name, const core::AxesCorrection& axes)
{
  scene::ImagePart& mr = *std::find_if(value.mr.begin(), value.mr.end(),
                                       [&name](const auto& one) { return one.name == name; });
  // Before the grid moves, by which a map without a statement is known to be drawn on it.
  std::vector<scene::LabelPart*> maps;
  for (scene::LabelPart& part : value.labels)
    if (scene::placementOf(value, part).drawnOn == name)
      maps.push_back(&part);
  correctAxes(mr, axes);
  mr.object.clear();
  std::map<std::shared_ptr<const volume::LabelMap>, core::Lazy<volume::LabelMap>> made;
  for (scene::LabelPart* part : maps)
  {
    // Structures of one map may be in several parts.
    const auto drawn = part->labels.get();
    correctMap(*part, axes, mr);
    part->labels = made.emplace(drawn, part->labels).first->second;
    part->drawnOn = name;
  }
  for (scene::MeshPart& part : value.meshes)
    if (part.drawnOn == name)
      correctMesh(part, axes, mr);
  scene::removeRegistration(value, name);
}

void correctMeshPart(scene::Case& value, const std::string& name, const core::AxesCorrection& axes)
{
  scene::MeshPart& mesh = *scene::findMesh(value, name);
  correctMesh(mesh, axes, imageDrawnOn(value, mesh.drawnOn));
}

void correctStructure(scene::Case& value, const std::string& name, const core::AxesCorrection& axes)
{
  const std::vector<const scene::LabelPart*> maps = mapOf(value, name);
  // About the middle of the image on which it was drawn, as the builder of a case does, so that
  // what lies on parts of its grid keeps its place among the rest.
  const std::string on = scene::placementOf(value, *maps.front()).drawnOn;
  std::map<std::shared_ptr<const volume::LabelMap>, core::Lazy<volume::LabelMap>> made;
  for (scene::LabelPart& map : value.labels)
  {
    if (std::find(maps.begin(), maps.end(), &map) == maps.end())
      continue;
    const auto drawn = map.labels.get();
    correctMap(map, axes, imageDrawnOn(value, on));
    map.drawnOn = on; // which an older case knows by the grid alone
    map.labels = made.emplace(drawn, map.labels).first->second;
  }
}

} // namespace

const scene::ImagePart& imageDrawnOn(const scene::Case& value, const std::string& drawnOn)
{
  const scene::ImagePart* mr = scene::findMr(value, drawnOn);
  return mr ? *mr : value.ct;
}

std::string followedNote(const scene::ImagePart& image)
{
  return "lies in the space of '" + image.name +
         "' as its file states it, and follows the correction of its axes (" +
         image.provenance.axes.letters() + ")";
}

void correctAxes(scene::ImagePart& image, const core::AxesCorrection& axes)
{
  if (axes.isIdentity())
    return;
  forget(image.notes, correctedAxesText(image.provenance.axes));
  image.geometry = axes.applied(image.geometry);
  image.volume = volume::onGrid(image.volume.get(), image.geometry);
  image.provenance.axes = axes * image.provenance.axes;
  if (!image.provenance.axes.isIdentity())
    image.notes.push_back(correctedAxesText(image.provenance.axes));
}

void correctAxes(core::TriangleMesh& mesh, const core::AxesCorrection& axes,
                 const Eigen::Vector3d& center)
{
  const Eigen::Matrix3d matrix = axes.matrix();
  for (Eigen::Vector3f& vertex : mesh.vertices)
    vertex = (center + matrix * (vertex.cast<double>() - center)).cast<float>();
  if (axes.isMirroring())
    for (auto& triangle : mesh.triangles)
      std::swap(triangle[1], triangle[2]);
}

LeftBehind leftBehind(const scene::Case& value)
{
  LeftBehind left;
  for (const scene::ImagePart& mr : value.mr)
  {
    left.mr.push_back(mr.name);
    const std::vector<std::string> drawn = scene::drawnOnMr(value, mr.name);
    left.drawnOnMr.insert(left.drawnOnMr.end(), drawn.begin(), drawn.end());
  }
  left.strokes = value.dissection.strokes().size();
  left.measurements = value.measurements.size();
  left.attachments = value.attachments.size();
  left.savedViews = value.view.saved.size();
  return left;
}

scene::Case correctedCase(const scene::Case& value, const core::AxesCorrection& axes,
                          const std::string& name, const core::Progress& progress)
{
  if (axes.isIdentity())
    failIdentity();
  scene::checkCaseName(name);
  scene::Case next = value;
  leaveMrsBehind(next);
  next.name = name;
  next.id.clear();
  next.revision = 0;
  next.camera.reset();
  next.view = {};
  next.description.side = scene::Side::Unknown;
  next.attachments.clear();
  next.measurements.clear();
  next.origins.clear();
  next.dissection = {};
  next.derived = nullptr;
  correctAxes(next.ct, axes);
  next.ct.object.clear();
  for (scene::LabelPart& part : next.labels)
  {
    progress.check("correcting the axes");
    correctMap(part, axes, next.ct);
    part.drawnOn = std::string();
  }
  for (scene::MeshPart& part : next.meshes)
  {
    progress.check("correcting the axes");
    correctMesh(part, axes, next.ct);
  }
  return next;
}

std::vector<std::string> movedNames(const scene::Case& before, const scene::Case& after)
{
  std::vector<std::string> names;
  for (std::size_t n = 0; n < before.labels.size(); ++n)
    if (before.labels[n].labels.peek() != after.labels[n].labels.peek())
      for (const scene::StructurePart& one : before.labels[n].structures)
        names.push_back(one.name);
  for (std::size_t n = 0; n < before.meshes.size(); ++n)
    if (before.meshes[n].mesh.peek() != after.meshes[n].mesh.peek())
      names.push_back(before.meshes[n].name);
  return names;
}

AxesPart axesPart(const scene::Case& value, const std::string& name)
{
  if (scene::findMr(value, name))
    return {AxesPart::Kind::Mr, name};
  if (scene::findStructure(value, name))
    return {AxesPart::Kind::Structure, name};
  if (std::any_of(value.meshes.begin(), value.meshes.end(),
                  [&name](const scene::MeshPart& mesh) { return mesh.name == name; }))
    return {AxesPart::Kind::Mesh, name};
  throw core::InvalidParameter("the case has no MR, structure or mesh '" + name +
                               "' whose axes could be corrected");
}

AxesFollowers axesFollowers(const scene::Case& value, const AxesPart& part)
{
  AxesFollowers followers;
  if (part.kind == AxesPart::Kind::Mr)
  {
    followers.parts = scene::drawnOnMr(value, part.name);
    for (const scene::ImagePart& one : value.mr)
      if (one.registered && scene::liesThrough(value, one.name, part.name))
        followers.unregistered.push_back(one.name);
  }
  if (part.kind == AxesPart::Kind::Structure)
    for (const scene::LabelPart* const map : mapOf(value, part.name))
      for (const scene::StructurePart& one : map->structures)
        if (one.name != part.name)
          followers.parts.push_back(one.name);
  return followers;
}

void correctPart(scene::Case& value, const AxesPart& part, const core::AxesCorrection& axes)
{
  if (axes.isIdentity())
    failIdentity();
  std::vector<std::string> moved = axesFollowers(value, part).parts;
  moved.push_back(part.name);
  for (const std::string& one : moved)
    if (isRecorded(value, one))
      throw core::Error(core::Fault::Refused,
                        "'" + one +
                            "' keeps its axes: strokes of this case record what was removed from "
                            "it where it lies");
  checkPlaceKnown(value, part);
  scene::Case next = value;
  switch (part.kind)
  {
  case AxesPart::Kind::Mr:
    correctMr(next, part.name, axes);
    break;
  case AxesPart::Kind::Mesh:
    correctMeshPart(next, part.name, axes);
    break;
  case AxesPart::Kind::Structure:
    correctStructure(next, part.name, axes);
    break;
  }
  for (const std::string& name : movedNames(value, next))
    scene::forgetStructure(next.measurements, name);
  value = std::move(next);
}

} // namespace petrous::presenters
