#include "petrous/Presenters/MeasurementEditor.h"

#include <algorithm>
#include <utility>

#include "NamedOccupancy.h"
#include "Notify.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/Measuring.h"
#include "petrous/Scene/CaseField.h"

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

/// A copy of the case in which walls are read, in one thread at a time.
struct MeasurementEditor::Wall
{
  Wall(scene::Case copy, const core::Progress& progress)
    : value(std::move(copy))
    , field(scene::regionalTissueField(value, progress))
    , probe(value, field)
  {
  }
  scene::Case value;
  volume::TissueField field;
  PointProbe probe;
};

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
  giveUp();
  m_tool = Tool::None;
  forgetPoints();
  m_chosen.reset();
  hearNames();
  m_dragged.reset();
  m_lines.clear();
  m_wall.reset();
  tell();
}

void MeasurementEditor::partsChanged()
{
  giveUp();
  endDrag();
  m_lines.clear();
  m_wall.reset();
  tell();
}

// Nothing of it is applied any more.
void MeasurementEditor::giveUp()
{
  if (!m_computing)
    return;
  m_computing = false;
  if (inBackground)
    inBackground({});
}

void MeasurementEditor::run(Work work)
{
  if (!inBackground)
    return work({})();
  m_computing = true;
  inBackground(
      [this, work = std::move(work)](const core::Progress& progress) -> Apply
      {
        return [this, apply = work(progress)]
        {
          m_computing = false;
          apply();
        };
      });
  tell();
}

void MeasurementEditor::workEnded()
{
  m_computing = false;
  if (m_dragged)
    dragOn();
  tell();
}

void MeasurementEditor::forgetPoints()
{
  m_points.clear();
  m_images.clear();
  m_noLine.clear();
  m_hover.reset();
}

Measurement MeasurementEditor::pointsAs(Kind kind) const
{
  Measurement made;
  made.kind = kind;
  made.points = m_points;
  scene::setImages(made, m_images);
  return made;
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
  giveUp();
  endDrag();
  m_tool = tool;
  forgetPoints();
  if (tool != Tool::Thickness)
    m_wall.reset(); // a copy of the case, which a drill would have to leave alone
  tell();
}

std::string MeasurementEditor::hint() const
{
  const bool first = m_points.empty();
  if (m_computing)
    return m_tool == Tool::Along
               ? "The centre line is being computed; another click goes on with a "
                 "line of your own."
               : "It is being measured.";
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
                                  : m_noLine + "Click the next point; Return or a double click "
                                               "ends the line.";
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
  Measurement draft = pointsAs(kindOf(m_tool));
  if (m_hover && draft.points.size() < scene::pointsOf(draft.kind).most)
  {
    draft.points.push_back(*m_hover);
    std::vector<std::string> images = m_images;
    images.push_back(m_image);
    scene::setImages(draft, std::move(images));
  }
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
  giveUp();
  endDrag();
  forgetPoints();
  tell();
}

bool MeasurementEditor::canFinish() const
{
  return isOpenEnded(m_tool) && !m_computing &&
         m_points.size() >= scene::pointsOf(kindOf(m_tool)).least;
}

void MeasurementEditor::set(const Vector3d& patient)
{
  if (m_tool == Tool::None || !m_model.hasCase())
    return;
  endDrag();
  if (m_tool == Tool::Thickness)
    return run(wallWork(patient, [this](const Measurement& thickness) { add(thickness); }));
  // A double click ends what has any number of points; its second click is none.
  if (!m_points.empty() && (m_points.back() - patient).norm() < 1e-6)
    return;
  giveUp(); // the line goes on through points
  m_points.push_back(patient);
  m_images.push_back(m_image);
  m_noLine.clear();
  if (m_tool == Tool::Along && m_points.size() == 2)
    if (const std::string structure = m_model.structureAt(m_points[0]);
        !structure.empty() && m_model.structureAt(m_points[1]) == structure)
    {
      if (m_lines.count(structure) > 0)
        return measureAlong(structure);
      return run(lineWork(structure, [this, structure] { measureAlong(structure); }));
    }
  const Kind kind = kindOf(m_tool);
  if (m_points.size() < scene::pointsOf(kind).most)
    return tell();
  add(pointsAs(kind));
}

void MeasurementEditor::finish()
{
  if (canFinish())
    add(pointsAs(kindOf(m_tool)));
}

MeasurementEditor::Work MeasurementEditor::wallWork(const Vector3d& patient,
                                                    std::function<void(const Measurement&)> apply)
{
  if (!m_model.ready())
    throw core::InvalidParameter("The case is still being prepared; then walls can be measured.");
  if (m_wallOf != m_model.tissueChanges())
    m_wall.reset();
  return [this, patient, apply = std::move(apply), wall = m_wall,
          copy = m_wall ? scene::Case() : m_model.value(),
          of = m_model.tissueChanges()](const core::Progress& progress) mutable -> Apply
  {
    if (!wall)
      wall = std::make_shared<Wall>(std::move(copy), progress.part(0.0, 0.5));
    const auto reading = wall->probe.wall(patient, progress.part(0.5, 1.0));
    if (!reading)
      throw core::InvalidParameter("There is no surface within 3 mm; click on one.");
    if (!reading->along)
      throw core::InvalidParameter("The wall is thicker than 30 mm here: nothing lies behind it.");
    Measurement thickness;
    thickness.kind = Kind::Thickness;
    thickness.points = {reading->surface, reading->along->point, reading->shortest->point};
    thickness.structure = reading->along->behind;
    return [this, wall, of, apply, thickness]
    {
      m_wall = wall;
      m_wallOf = of;
      apply(thickness);
    };
  };
}

MeasurementEditor::Work MeasurementEditor::lineWork(const std::string& structure, Apply apply)
{
  return [this, structure, apply = std::move(apply),
          value = m_model.presentable()](const core::Progress& progress) -> Apply
  {
    Line line;
    const scene::StructureOccupancy occupancy =
        namedOccupancy(value, structure, "length", progress.part(0.0, 0.3));
    line.image = occupancy.mr;
    line.why = "it encloses nothing";
    progress.check("centre line");
    if (const auto share = occupancy.make())
      line.line = centreLine(*share, progress.part(0.3, 1.0), &line.why);
    return [this, structure, line = std::move(line), apply]
    {
      m_lines[structure] = line;
      apply();
    };
  };
}

void MeasurementEditor::measureAlong(const std::string& structure)
{
  const Line& known = m_lines[structure];
  if (m_points.size() != 2)
    return;
  if (!known.line)
  {
    m_noLine = "'" + structure + "' has no centre line: " + known.why + ". ";
    return tell();
  }
  Measurement along;
  along.kind = Kind::Length;
  along.structure = structure;
  along.image = known.image;
  along.points = partOf(*known.line, m_points[0], m_points[1]);
  add(std::move(along));
}

void MeasurementEditor::add(Measurement measurement)
{
  const std::string base = measurement.kind == Kind::Length && !measurement.structure.empty()
                               ? "length of " + measurement.structure
                           : measurement.kind == Kind::Thickness && !measurement.structure.empty()
                               ? "bone over " + measurement.structure
                               : scene::nameOf(measurement.kind);
  const std::string own = inLanguage ? inLanguage(base) : base;
  std::string name = shownName(core::utf8Prefix(own, Measurement::kLongestName - 10));
  if (base == scene::nameOf(measurement.kind))
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
  scene::setReadings(m_model.value(), measurement);
  next.push_back(std::move(measurement));
  scene::checkMeasurements(next); // before the points are dropped
  forgetPoints();
  m_chosen = next.size() - 1;
  change(text, std::move(next));
}

void MeasurementEditor::change(const std::string& text, std::vector<Measurement> next)
{
  if (m_dragged) // else it would bring back what it began with
  {
    giveUp();
    endDrag();
  }
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
  hearNames();
}

void MeasurementEditor::hearNames()
{
  m_names.clear();
  for (const Measurement& one : all())
    m_names.push_back(one.name);
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
  if (m_dragged)
    giveUp();
  m_dragged.reset();
  if (m_chosen && *m_chosen >= m_names.size())
    m_chosen.reset();
  if (m_chosen)
  {
    // By its name, which no other one has; where that is gone and none came or went, by its place.
    const auto named =
        std::find_if(all().begin(), all().end(),
                     [name = m_names[*m_chosen]](const auto& one) { return one.name == name; });
    if (named != all().end())
      m_chosen = static_cast<std::size_t>(named - all().begin());
    else if (all().size() != m_names.size())
      m_chosen.reset();
  }
  hearNames();
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
  giveUp();
  endDrag();
  m_dragged = Drag{measurement, point, all()};
  m_chosen = measurement;
  tell();
}

// What takes long is computed for one place after another: of those between, none.
void MeasurementEditor::drag(const Vector3d& patient)
{
  if (!m_dragged || m_dragged->measurement >= all().size())
    return;
  if (m_computing)
    m_dragged->wanted = patient;
  else
    follow(patient);
}

void MeasurementEditor::dragOn()
{
  if (const auto wanted = std::exchange(m_dragged->wanted, std::nullopt))
    follow(*wanted);
  if (m_dragged && m_dragged->isReleased && !m_computing)
    endDrag();
}

void MeasurementEditor::follow(const Vector3d& patient)
{
  std::vector<Measurement> next = m_dragged->before;
  Measurement& moved = next[m_dragged->measurement];
  const auto show = [this](std::vector<Measurement> changed)
  {
    store(std::move(changed));
    tell();
  };
  if (moved.kind == Kind::Thickness)
  {
    const auto apply = [this, next, show](const Measurement& again) mutable
    {
      if (!m_dragged)
        return;
      Measurement& wall = next[m_dragged->measurement];
      wall.points = again.points;
      wall.structure = again.structure;
      wall.structureGone = false;
      show(std::move(next));
      dragOn();
    };
    // There is no wall under the pointer: as it was.
    return run(
        [this, work = wallWork(patient, apply)](const core::Progress& progress) -> Apply
        {
          try
          {
            return work(progress);
          }
          catch (const core::InvalidParameter&)
          {
            return [this]
            {
              if (m_dragged)
                dragOn();
            };
          }
        });
  }
  if (moved.kind == Kind::Length && !moved.structure.empty())
  {
    if (moved.structureGone || !scene::kindOfPart(m_model.value(), moved.structure))
      return;
    const auto known = m_lines.find(moved.structure);
    if (known == m_lines.end())
    {
      m_dragged->wanted = patient;
      return run(lineWork(moved.structure,
                          [this]
                          {
                            if (m_dragged)
                              dragOn();
                          }));
    }
    if (!known->second.line)
      return;
    moved.points = m_dragged->point == 0
                       ? partOf(*known->second.line, patient, moved.points.back())
                       : partOf(*known->second.line, moved.points.front(), patient);
    moved.image = known->second.image;
    scene::setReadings(m_model.value(), moved);
    return show(std::move(next));
  }
  std::vector<std::string> images;
  for (std::size_t n = 0; n < moved.points.size(); ++n)
    images.push_back(n == m_dragged->point ? m_image : scene::imageOf(moved, n));
  moved.points[m_dragged->point] = patient;
  scene::setImages(moved, std::move(images));
  scene::setReadings(m_model.value(), moved, m_dragged->point);
  show(std::move(next));
}

void MeasurementEditor::release()
{
  if (!m_dragged)
    return;
  m_dragged->isReleased = true;
  if (!m_computing)
    endDrag();
}

void MeasurementEditor::endDrag()
{
  if (!m_dragged)
    return;
  const Drag done = *std::exchange(m_dragged, std::nullopt);
  if (m_tool == Tool::None)
    m_wall.reset();
  if (done.before != all() && done.measurement < all().size())
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
  giveUp();
  m_points.pop_back();
  m_images.pop_back();
  m_noLine.clear();
  tell();
}

void MeasurementEditor::redo()
{
  if (canRedo())
    m_model.redo();
}

} // namespace petrous::presenters
