#include "petrous/Presenters/MeasurementEditor.h"

#include <algorithm>
#include <utility>

#include "NamedOccupancy.h"
#include "Notify.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/Measuring.h"

namespace petrous::presenters
{

namespace
{

using Eigen::Vector3d;
using scene::Measurement;
using Kind = Measurement::Kind;
using Tool = MeasurementEditor::Tool;

Kind kindOf(Tool tool)
{
  switch (tool)
  {
  case Tool::Distance:
    return Kind::Distance;
  case Tool::Along:
    return Kind::Length;
  case Tool::Angle:
    return Kind::Angle;
  case Tool::Area:
    return Kind::Area;
  case Tool::Thickness:
    return Kind::Thickness;
  case Tool::None:
  case Tool::Mark:
    break;
  }
  return Kind::Mark;
}

bool isOpenEnded(Tool tool)
{
  return tool == Tool::Along || tool == Tool::Area;
}

std::string described(const Measurement& measurement)
{
  return std::string("'") + measurement.name + "'";
}

} // namespace

const char* nameOf(Tool tool) noexcept
{
  constexpr const char* kNames[] = {"None",  "Mark", "Distance",      "Along a structure",
                                    "Angle", "Area", "Wall thickness"};
  return kNames[static_cast<std::size_t>(tool)];
}

MeasurementEditor::MeasurementEditor(WorkstationModel& model)
  : m_model(model)
{
}

void MeasurementEditor::tell() const
{
  notify(events.changed);
}

void MeasurementEditor::caseChanged()
{
  m_tool = Tool::None;
  m_points.clear();
  m_hover.reset();
  m_chosen.reset();
  m_dragged.reset();
  m_lines.clear();
  tell();
}

void MeasurementEditor::partsChanged()
{
  m_lines.clear();
  tell();
}

const std::vector<Measurement>& MeasurementEditor::all() const
{
  static const std::vector<Measurement> kNone;
  return m_model.hasCase() ? m_model.value().measurements : kNone;
}

void MeasurementEditor::setTool(Tool tool)
{
  if (!m_model.hasCase())
    tool = Tool::None;
  if (tool == m_tool && m_points.empty())
    return;
  m_tool = tool;
  m_points.clear();
  m_hover.reset();
  tell();
}

std::string MeasurementEditor::hint() const
{
  const bool first = m_points.empty();
  switch (m_tool)
  {
  case Tool::None:
    break;
  case Tool::Mark:
    return "Click a place in a slice, or on the surface in the 3D view.";
  case Tool::Distance:
    return first ? "Click the first point, or drag from it to the second."
                 : "Click the second point.";
  case Tool::Along:
    return first ? "Click where it begins: in a nerve or canal of the case, or anywhere."
           : m_points.size() == 1 ? "Click where it ends in the same structure, or the next point "
                                    "of a line of your own."
                                  : "Click the next point; Return or a double click ends the line.";
  case Tool::Angle:
    return first                  ? "Click a point on the first leg."
           : m_points.size() == 1 ? "Click the vertex."
                                  : "Click a point on the second leg.";
  case Tool::Area:
    return first          ? "Click the first corner."
           : !canFinish() ? "Click the next corner."
                          : "Click the next corner; Return or a double click closes the polygon.";
  case Tool::Thickness:
    return "Click the surface of the wall.";
  }
  return {};
}

std::optional<Measurement> MeasurementEditor::draft() const
{
  if (m_points.empty())
    return std::nullopt;
  Measurement draft;
  draft.kind = kindOf(m_tool);
  draft.points = m_points;
  draft.image = m_image;
  if (m_hover && draft.points.size() < scene::pointsOf(draft.kind).most)
    draft.points.push_back(*m_hover);
  return draft;
}

void MeasurementEditor::hover(const std::optional<Vector3d>& patient)
{
  if (m_points.empty())
  {
    m_hover.reset();
    return;
  }
  m_hover = patient;
  notify(events.hovered);
}

void MeasurementEditor::drop()
{
  m_points.clear();
  m_hover.reset();
  tell();
}

bool MeasurementEditor::canFinish() const
{
  return isOpenEnded(m_tool) && m_points.size() >= scene::pointsOf(kindOf(m_tool)).least;
}

void MeasurementEditor::set(const Vector3d& patient)
{
  if (m_tool == Tool::None || !m_model.hasCase())
    return;
  if (m_tool == Tool::Thickness)
    return add(thicknessAt(patient));
  // A double click ends what has any number of points; its second click is none.
  if (!m_points.empty() && (m_points.back() - patient).norm() < 1e-6)
    return;
  m_points.push_back(patient);
  if (m_tool == Tool::Along && m_points.size() == 2)
    if (auto along = alongTheStructure())
      return add(std::move(*along));
  const Kind kind = kindOf(m_tool);
  if (m_points.size() < scene::pointsOf(kind).most)
    return tell();
  finish();
  if (m_points.empty())
    return;
  Measurement made;
  made.kind = kind;
  made.points = m_points;
  made.image = m_image;
  add(std::move(made));
}

void MeasurementEditor::finish()
{
  if (!canFinish())
    return;
  Measurement made;
  made.kind = kindOf(m_tool);
  made.points = m_points;
  made.image = m_image;
  add(std::move(made));
}

Measurement MeasurementEditor::thicknessAt(const Vector3d& patient)
{
  if (!m_model.ready())
    throw core::InvalidParameter("The case is still being prepared; then walls can be measured.");
  const auto wall = m_model.readWall(patient);
  if (!wall)
    throw core::InvalidParameter("There is no surface within 3 mm; click on one.");
  if (!wall->along)
    throw core::InvalidParameter("The wall is thicker than 30 mm here: nothing lies behind it.");
  Measurement thickness;
  thickness.kind = Kind::Thickness;
  thickness.points = {wall->surface, wall->along->point, wall->shortest->point};
  thickness.structure = wall->along->behind;
  return thickness;
}

const CentreLine* MeasurementEditor::lineOf(const std::string& structure, std::string& image)
{
  const auto known = m_lines.find(structure);
  if (known == m_lines.end())
  {
    Line& line = m_lines[structure];
    const scene::StructureOccupancy occupancy =
        namedOccupancy(m_model.value(), structure, "length");
    line.image = occupancy.mr;
    if (const auto share = occupancy.make())
      line.line = centreLine(*share);
  }
  const Line& line = m_lines[structure];
  image = line.image;
  return line.line ? &*line.line : nullptr;
}

const CentreLine* MeasurementEditor::lineAt(const Vector3d& patient, std::string& structure,
                                            std::string& image)
{
  structure = m_model.structureAt(patient);
  return structure.empty() ? nullptr : lineOf(structure, image);
}

// If both points are in one tube.
std::optional<Measurement> MeasurementEditor::alongTheStructure()
{
  std::string structure, image;
  if (m_model.structureAt(m_points[0]) != m_model.structureAt(m_points[1]))
    return std::nullopt; // before a centre line is computed
  const CentreLine* line = lineAt(m_points[0], structure, image);
  if (!line)
    return std::nullopt;
  Measurement along;
  along.kind = Kind::Length;
  along.structure = structure;
  along.image = image;
  along.points = partOf(*line, m_points[0], m_points[1]);
  return along;
}

void MeasurementEditor::add(Measurement measurement)
{
  const std::string base = measurement.kind == Kind::Length && !measurement.structure.empty()
                               ? "length of " + measurement.structure
                           : measurement.kind == Kind::Thickness && !measurement.structure.empty()
                               ? "bone over " + measurement.structure
                               : scene::nameOf(measurement.kind);
  std::string name = core::utf8Prefix(base, Measurement::kLongestName - 10);
  std::replace(name.begin(), name.end(), '_', ' ');
  if (name == scene::nameOf(measurement.kind))
    name += " 1";
  // "distance 1", "distance 2", ...
  std::vector<Measurement> next = all();
  if (name.size() > 2 && name.substr(name.size() - 2) == " 1")
  {
    const std::string stem = name.substr(0, name.size() - 2);
    for (int n = 1; scene::freeMeasurementName(next, name) != name; ++n)
      name = stem + " " + std::to_string(n + 1);
  }
  measurement.name = scene::freeMeasurementName(next, name);
  const std::string text = described(measurement);
  next.push_back(std::move(measurement));
  scene::checkMeasurements(next); // before the points are dropped
  m_points.clear();
  m_hover.reset();
  m_chosen = next.size() - 1;
  change(text, std::move(next));
}

void MeasurementEditor::change(const std::string& text, std::vector<Measurement> next)
{
  if (next == all())
    return;
  auto before = all();
  store(std::move(next));
  record(text, std::move(before));
  tell();
}

void MeasurementEditor::store(std::vector<Measurement> next)
{
  m_storing = true;
  try
  {
    m_model.setMeasurements(std::move(next));
  }
  catch (...)
  {
    m_storing = false;
    throw;
  }
  m_storing = false;
}

void MeasurementEditor::record(const std::string& text, std::vector<Measurement> before)
{
  const auto back = [&model = m_model](std::vector<Measurement> list)
  { return [&model, list = std::move(list)] { model.setMeasurements(list); }; };
  m_model.edits().did({text, {}, back(std::move(before)), back(all())});
}

void MeasurementEditor::measurementsChanged()
{
  if (m_storing)
    return;
  m_chosen.reset();
  tell();
}

bool MeasurementEditor::isHandle(const Measurement& measurement, std::size_t point)
{
  if (measurement.kind == Kind::Thickness)
    return point == 0;
  return measurement.kind != Kind::Length || measurement.structure.empty() || point == 0 ||
         point + 1 == measurement.points.size();
}

void MeasurementEditor::take(std::size_t measurement, std::size_t point)
{
  if (measurement >= all().size() || point >= all()[measurement].points.size())
    return;
  m_dragged = Drag{measurement, point, all()};
  m_chosen = measurement;
  tell();
}

void MeasurementEditor::drag(const Vector3d& patient)
{
  if (!m_dragged || m_dragged->measurement >= all().size())
    return;
  std::vector<Measurement> next = m_dragged->before;
  Measurement& moved = next[m_dragged->measurement];
  if (moved.kind == Kind::Thickness)
  {
    Measurement again;
    try
    {
      again = thicknessAt(patient);
    }
    catch (const core::InvalidParameter&) // there is no wall under the pointer: as it was
    {
      return;
    }
    moved.points = again.points;
    moved.structure = again.structure;
  }
  else if (moved.kind == Kind::Length && !moved.structure.empty())
  {
    const bool front = m_dragged->point == 0;
    std::string image;
    const CentreLine* line = nullptr;
    if (scene::kindOfPart(m_model.value(), moved.structure))
      line = lineOf(moved.structure, image);
    if (!line)
      return;
    moved.points = front ? partOf(*line, patient, moved.points.back())
                         : partOf(*line, moved.points.front(), patient);
  }
  else
    moved.points[m_dragged->point] = patient;
  store(std::move(next));
  tell();
}

void MeasurementEditor::release()
{
  if (!m_dragged)
    return;
  const Drag done = *std::exchange(m_dragged, std::nullopt);
  if (done.before == all() || done.measurement >= all().size())
    return tell();
  record("move " + described(all()[done.measurement]), done.before);
  tell();
}

void MeasurementEditor::rename(std::size_t measurement, const std::string& name)
{
  if (measurement >= all().size())
    return;
  std::vector<Measurement> next = all();
  const std::string before = next[measurement].name;
  next[measurement].name = name;
  change("rename '" + before + "'", std::move(next));
}

void MeasurementEditor::remove(std::size_t measurement)
{
  if (measurement >= all().size())
    return;
  std::vector<Measurement> next = all();
  const std::string text = "remove " + described(next[measurement]);
  next.erase(next.begin() + static_cast<std::ptrdiff_t>(measurement));
  m_chosen.reset();
  change(text, std::move(next));
}

void MeasurementEditor::setShown(std::size_t measurement, bool shown)
{
  if (measurement >= all().size())
    return;
  std::vector<Measurement> next = all();
  next[measurement].shown = shown;
  const std::string text = (shown ? "show " : "hide ") + described(next[measurement]);
  change(text, std::move(next));
}

void MeasurementEditor::setAllShown(bool shown)
{
  std::vector<Measurement> next = all();
  for (Measurement& one : next)
    one.shown = shown;
  change(shown ? "show all measurements" : "hide all measurements", std::move(next));
}

void MeasurementEditor::choose(std::optional<std::size_t> measurement)
{
  if (measurement && *measurement >= all().size())
    measurement.reset();
  if (measurement == m_chosen)
    return;
  m_chosen = measurement;
  tell();
}

std::string MeasurementEditor::undoText() const
{
  return m_points.empty() ? m_model.undoText() : "the last point";
}

std::string MeasurementEditor::redoText() const
{
  return canRedo() ? m_model.redoText() : std::string();
}

void MeasurementEditor::undo()
{
  if (m_points.empty())
    return m_model.undo();
  m_points.pop_back();
  tell();
}

void MeasurementEditor::redo()
{
  if (canRedo())
    m_model.redo();
}

} // namespace petrous::presenters
