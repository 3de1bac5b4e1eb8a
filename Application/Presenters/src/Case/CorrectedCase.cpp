#include "petrous/Presenters/CorrectedCase.h"

#include <algorithm>
#include <utility>

#include "CorrectAxes.h"
#include "petrous/Presenters/ProvenanceText.h"
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
    throw core::InvalidParameter("axes: LPS leaves them as they are; say where what the file calls "
                                 "left, posterior and superior really points, such as RPS");
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
    const auto labels = part.labels.get();
    part.labels = std::make_shared<const volume::LabelMap>(
        volume::onGrid(*labels, axes.applied(labels->voxels->geometry(), center)));
    part.object.clear();
    part.moved = {};
    part.drawnOn = std::string();
    part.provenance.axes = axes * part.provenance.axes;
    note(part.notes);
  }
  for (scene::MeshPart& part : next.meshes)
  {
    progress.check("correcting the axes");
    core::TriangleMesh mesh = *part.mesh.get();
    correctAxes(mesh, axes, center);
    part.mesh = std::make_shared<const core::TriangleMesh>(std::move(mesh));
    part.object.clear();
    part.moved = {};
    part.touch = {};
    note(part.notes);
  }
  return next;
}

} // namespace petrous::presenters
