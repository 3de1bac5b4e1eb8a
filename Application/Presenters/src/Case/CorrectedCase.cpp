#include "petrous/Presenters/CorrectedCase.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "CorrectAxes.h"
#include "RecordedParts.h"
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

[[noreturn]] void failIdentity()
{
  throw core::InvalidParameter("axes: LPS leaves them as they are; say where what the file calls "
                               "left, posterior and superior really points, such as RPS");
}

// The map that holds a structure; nullptr: none.
scene::LabelPart* mapOf(scene::Case& value, const std::string& structure)
{
  for (scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& one : part.structures)
      if (one.name == structure)
        return &part;
  return nullptr;
}

void correctMap(scene::LabelPart& part, const core::AxesCorrection& axes,
                const Eigen::Vector3d& center)
{
  const auto labels = part.labels.get();
  part.labels = std::make_shared<const volume::LabelMap>(
      volume::onGrid(*labels, axes.applied(labels->voxels->geometry(), center)));
  part.object.clear();
  part.moved = {};
  part.provenance.axes = axes * part.provenance.axes;
}

void correctMesh(scene::MeshPart& part, const core::AxesCorrection& axes,
                 const Eigen::Vector3d& center)
{
  core::TriangleMesh mesh = *part.mesh.get();
  correctAxes(mesh, axes, center);
  part.mesh = std::make_shared<const core::TriangleMesh>(std::move(mesh));
  part.object.clear();
  part.moved = {};
  part.touch = {};
}

void correctMr(scene::Case& value, const std::string& name, const core::AxesCorrection& axes)
{
  scene::ImagePart& mr = *std::find_if(value.mr.begin(), value.mr.end(),
                                       [&name](const auto& one) { return one.name == name; });
  const std::string before = followedNote(mr);
  // Before the grid moves, by which a map without a statement is known to be drawn on it.
  std::vector<scene::LabelPart*> maps;
  for (scene::LabelPart& part : value.labels)
    if (scene::placementOf(value, part).drawnOn == name)
      maps.push_back(&part);
  correctAxes(mr, axes);
  mr.object.clear();
  const Eigen::Vector3d center = mr.geometry.center();
  const auto note = [&](std::vector<std::string>& notes)
  {
    forget(notes, before);
    if (!mr.provenance.axes.isIdentity())
      notes.push_back(followedNote(mr));
  };
  std::map<std::shared_ptr<const volume::LabelMap>, core::Lazy<volume::LabelMap>> made;
  for (scene::LabelPart* part : maps)
  {
    // Structures of one map may be in several parts.
    const auto drawn = part->labels.get();
    correctMap(*part, axes, center);
    part->labels = made.emplace(drawn, part->labels).first->second;
    part->drawnOn = name;
    note(part->notes);
  }
  for (scene::MeshPart& part : value.meshes)
    if (part.drawnOn == name)
    {
      correctMesh(part, axes, center);
      note(part.notes);
    }
  scene::removeRegistration(value, name);
}

} // namespace

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
  const Eigen::Vector3d center = next.ct.geometry.center();
  const auto note = [&](std::vector<std::string>& notes)
  {
    forget(notes, followedNote(value.ct));
    if (!next.ct.provenance.axes.isIdentity())
      notes.push_back(followedNote(next.ct));
  };
  for (scene::LabelPart& part : next.labels)
  {
    progress.check("correcting the axes");
    correctMap(part, axes, center);
    part.drawnOn = std::string();
    note(part.notes);
  }
  for (scene::MeshPart& part : next.meshes)
  {
    progress.check("correcting the axes");
    correctMesh(part, axes, center);
    note(part.notes);
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

AxesFollowers axesFollowers(const scene::Case& value, const std::string& part)
{
  AxesFollowers followers;
  if (const scene::ImagePart* mr = scene::findMr(value, part))
  {
    followers.parts = scene::drawnOnMr(value, part);
    for (const scene::ImagePart& one : value.mr)
      if (one.registered && scene::liesThrough(value, one.name, mr->name))
        followers.unregistered.push_back(one.name);
    return followers;
  }
  for (const scene::MeshPart& mesh : value.meshes)
    if (mesh.name == part)
      return followers;
  for (const scene::LabelPart& map : value.labels)
  {
    const auto& all = map.structures;
    if (std::none_of(all.begin(), all.end(), [&](const auto& one) { return one.name == part; }))
      continue;
    for (const scene::StructurePart& one : all)
      if (one.name != part)
        followers.parts.push_back(one.name);
    return followers;
  }
  throw core::InvalidParameter("the case has no MR, structure or mesh '" + part +
                               "' whose axes could be corrected");
}

void correctPart(scene::Case& value, const std::string& part, const core::AxesCorrection& axes)
{
  if (axes.isIdentity())
    failIdentity();
  std::vector<std::string> moved = axesFollowers(value, part).parts;
  moved.push_back(part);
  for (const std::string& one : moved)
    if (isRecorded(value, one))
      throw core::Error(core::Fault::Refused,
                        "'" + one +
                            "' keeps its axes: strokes of this case record what was removed from "
                            "it where it lies");
  scene::Case next = value;
  if (scene::findMr(next, part))
    correctMr(next, part, axes);
  else if (scene::MeshPart* mesh = scene::findMesh(next, part))
  {
    const scene::ImagePart* mr = scene::findMr(next, mesh->drawnOn);
    correctMesh(*mesh, axes, (mr ? *mr : next.ct).geometry.center());
    const std::string note = correctedAxesText(axes);
    const auto noted = std::find(mesh->notes.begin(), mesh->notes.end(), note);
    if (noted != mesh->notes.end() && (axes * axes).isIdentity())
      mesh->notes.erase(noted); // it is as before
    else
      mesh->notes.push_back(note);
  }
  else
  {
    const auto drawn = mapOf(next, part)->labels.get();
    core::Lazy<volume::LabelMap> made;
    for (scene::LabelPart& map : next.labels)
    {
      if (map.labels.peek() != drawn)
        continue;
      forget(map.notes, correctedAxesText(map.provenance.axes));
      // About the middle of the image on which it was drawn, as the builder of a case does, so that
      // what lies on parts of its grid keeps its place among the rest.
      const auto on = scene::placementOf(next, map).drawnOn;
      const scene::ImagePart* mr = scene::findMr(next, on);
      forget(map.notes, followedNote(next.ct));
      if (mr)
        forget(map.notes, followedNote(*mr));
      correctMap(map, axes, (mr ? *mr : next.ct).geometry.center());
      if (!made)
        made = map.labels;
      map.labels = made;
      if (!map.provenance.axes.isIdentity())
        map.notes.push_back(correctedAxesText(map.provenance.axes));
    }
  }
  for (const std::string& name : movedNames(value, next))
    scene::forgetStructure(next.measurements, name);
  value = std::move(next);
}

} // namespace petrous::presenters
