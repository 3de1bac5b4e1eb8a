#include "StructuresModel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <QApplication>
#include <QColor>
#include <QPainter>
#include <QPainterPath>
#include <QPalette>
#include <QPixmap>

#include "NearbyModel.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/NearbyStructures.h"
#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/Placement.h"

namespace petrous::workstation
{

namespace
{
constexpr int kSwatch = 12; // px

QColor colorOf(const appearance::StructureAppearance& look)
{
  return QColor::fromRgbF(double(look.color[0]), double(look.color[1]), double(look.color[2]));
}

using appearance::StructureProperty;

// In place of the title of a column of check boxes: an eye, a ball pressed on a surface, a burr.
QPixmap flagIcon(const StructureProperty& property)
{
  constexpr int kSize = 16; // px, of a small icon of the style
  const QColor color = qApp->palette().color(QPalette::ButtonText);
  return pixmapOf(QString("flag-%1-%2").arg(property.key, color.name()), kSize,
                  [&](QPainter& painter)
                  {
                    painter.setPen(QPen(color, 1.4, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
                    const std::string name = property.key;
                    QPainterPath path;
                    if (name == "shown")
                    {
                      path.moveTo(1.0, 8.0);
                      path.quadTo(8.0, 0.5, 15.0, 8.0);
                      path.quadTo(8.0, 15.5, 1.0, 8.0);
                      painter.drawPath(path);
                      painter.setBrush(color);
                      painter.drawEllipse(QPointF(8.0, 8.0), 1.6, 1.6);
                    }
                    else if (name == "touchable")
                    {
                      path.moveTo(1.0, 10.0);
                      path.lineTo(3.0, 10.0);
                      path.cubicTo(5.0, 10.0, 5.0, 14.5, 8.0, 14.5);
                      path.cubicTo(11.0, 14.5, 11.0, 10.0, 13.0, 10.0);
                      path.lineTo(15.0, 10.0);
                      painter.drawPath(path);
                      painter.setBrush(color);
                      painter.drawEllipse(QPointF(8.0, 7.5), 3.5, 3.5);
                    }
                    else
                    {
                      painter.drawEllipse(QPointF(5.5, 10.5), 4.0, 4.0);
                      painter.drawLine(QPointF(3.0, 8.0), QPointF(8.0, 13.0)); // flutes
                      painter.drawLine(QPointF(2.5, 11.5), QPointF(4.5, 13.5));
                      painter.drawLine(QPointF(6.5, 7.5), QPointF(8.5, 9.5));
                      painter.setPen(QPen(color, 2.2, Qt::SolidLine, Qt::RoundCap));
                      painter.drawLine(QPointF(9.0, 7.0), QPointF(14.5, 1.5)); // shaft
                    }
                  });
}

// The properties with a column.
const std::vector<const StructureProperty*>& columns()
{
  static const auto all = []
  {
    std::vector<const StructureProperty*> found;
    for (const StructureProperty& property : appearance::kStructureProperties)
      if (property.column.title)
        found.push_back(&property);
    return found;
  }();
  return all;
}

using presenters::StructureKind;

const char* titleOfKind(StructureKind kind)
{
  switch (kind)
  {
  case StructureKind::Nerve:
    return QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel", "Nerves");
  case StructureKind::Vessel:
    return QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel", "Vessels");
  case StructureKind::Ossicle:
    return QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel", "Ossicles");
  case StructureKind::InnerEar:
    return QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel", "Inner ear");
  case StructureKind::Dura:
    return QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel", "Dura");
  case StructureKind::Lumen:
    return QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel", "Lumens");
  case StructureKind::Mesh:
    return QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel", "Meshes");
  case StructureKind::Bone:
  case StructureKind::SoftTissue:
  case StructureKind::Other:
    break;
  }
  return QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel", "Other structures");
}

// Titles and tips of appearance::kStructureProperties, which knows no Qt, as lupdate finds them.
[[maybe_unused]] constexpr const char* kPropertyTexts[] = {
    QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel", "Show"),
    QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel",
                      "Drawn in 3D and outlined in the slices"),
    QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel", "Touch"),
    QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel",
                      "Felt by the burr: part of the tissue it rests on"),
    QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel", "Drill"),
    QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel",
                      "Taken by the drill; without the mark the drill leaves it whole"),
    QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel", "Warn"),
    QT_TRANSLATE_NOOP("petrous::workstation::StructuresModel",
                      "How near a burr may come before it is warned of, mm; 0: no warning. Double "
                      "click to change"),
};

// Rows of their own, above those of the kinds.
constexpr std::size_t kSingleRows = 2;

bool isSingle(StructureKind kind)
{
  return kind == StructureKind::Bone || kind == StructureKind::SoftTissue;
}

// What bone has not: it is what is touched, drilled and not warned of. Soft tissue is air to that.
bool isOfBone(const StructureProperty& property)
{
  return std::string(property.key) == "shown";
}

bool isFlag(const StructureProperty& property)
{
  return std::holds_alternative<StructureProperty::Flag>(property.member);
}

const StructureProperty& propertyAt(int column)
{
  return *columns()[static_cast<std::size_t>(column - StructuresModel::FirstProperty)];
}
} // namespace

int StructuresModel::columnOf(const std::string& key)
{
  for (std::size_t n = 0; n < columns().size(); ++n)
    if (columns()[n]->key == key)
      return FirstProperty + static_cast<int>(n);
  return -1;
}

QString StructuresModel::idleText(const appearance::StructureAppearance& look,
                                  const StructureProperty& property)
{
  const std::string key = property.key;
  return !look.solid && (key == "touchable" || key == "stiffness_n_per_mm")
             ? tr("Not felt: %1").arg(phrase("it is a space without tissue"))
             : QString();
}

StructuresModel::StructuresModel(presenters::WorkstationModel& model, QObject* parent)
  : QAbstractItemModel(parent)
  , m_model(model)
{
}

const StructuresModel::Measured* StructuresModel::measuredOf(const scene::MeshPart& part) const
{
  const auto found = m_measured.find(part.name);
  if (found == m_measured.end() || m_measuredOf != m_model.shownAs())
    return nullptr;
  const auto mesh = part.mesh.peek(); // another one may have its name now
  return found->second.mesh == mesh || !mesh ? &found->second : nullptr;
}

// Those that were not yet, one after another: a task under way is let go on.
void StructuresModel::measureMeshes()
{
  if (!m_model.hasCase() || m_work.busy())
    return;
  if (m_measuredOf != m_model.shownAs())
    m_measured.clear();
  m_measuredOf = m_model.shownAs();
  std::vector<std::pair<std::string, core::Lazy<core::TriangleMesh>>> meshes;
  for (const auto& part : m_model.value().meshes)
    if (!measuredOf(part) && !scene::findStructure(m_model.value(), part.name))
      meshes.emplace_back(part.name, part.mesh);
  if (meshes.empty())
    return;
  m_work.start(
      [this, meshes = std::move(meshes),
       shownAs = m_measuredOf](const core::Progress& progress) -> BackgroundWork::Reply
      {
        Measures done;
        for (const auto& [name, lazy] : meshes)
        {
          progress.check("measuring meshes");
          try
          {
            const auto mesh = lazy.get();
            done[name] = {mesh, mesh ? volume::measure(*mesh) : volume::MeshMeasure()};
          }
          catch (const core::Error&) // said where the case was opened
          {
            done[name] = {};
          }
        }
        return [this, done, shownAs]
        {
          if (shownAs == m_measuredOf)
            for (const auto& [name, measured] : done)
              m_measured[name] = measured;
          appearanceChanged();
        };
      });
}

void StructuresModel::setFound(const QModelIndex& kind, std::optional<std::size_t> found)
{
  const Kind* one = kindAt(kind);
  if (!one || one->found == found)
    return;
  m_kinds[static_cast<std::size_t>(one - m_kinds.data())].found = found;
  emit dataChanged(kind, kind);
}

QString StructuresModel::countText() const
{
  std::size_t structures = 0, meshes = 0, shown = 0;
  for (const Row& row : m_rows)
  {
    if (isSingle(row.row.kind))
      continue;
    ++(row.row.kind == StructureKind::Mesh ? meshes : structures);
    shown += row.row.look.shown;
  }
  QStringList parts;
  if (structures > 0)
    parts += structures == 1 ? tr("1 structure") : tr("%1 structures").arg(structures);
  if (meshes > 0)
    parts += meshes == 1 ? tr("1 mesh") : tr("%1 meshes").arg(meshes);
  return parts.isEmpty() ? QString() : tr("%1; %2 shown").arg(parts.join(", ")).arg(shown);
}

std::vector<StructuresModel::Row> StructuresModel::rows()
{
  std::vector<Row> rows;
  if (!m_model.hasCase())
    return rows;
  const scene::Case& value = m_model.value();
  for (presenters::StructureRow& one : presenters::structureRows(value))
  {
    Row row{std::move(one)};
    row.volume = row.row.volume;
    if (row.row.kind == StructureKind::SoftTissue && row.row.look.shown)
      row.notDrawn = presenters::softTissueMissing(value);
    if (row.row.kind == StructureKind::Mesh)
    {
      row.isBeingMeasured = true;
      const auto mesh =
          std::find_if(value.meshes.begin(), value.meshes.end(),
                       [&row](const auto& part) { return part.name == row.row.part; });
      if (const Measured* measured = mesh == value.meshes.end() ? nullptr : measuredOf(*mesh))
      {
        row.volume = measured->measure.volume.value_or(0.0);
        row.isBeingMeasured = false;
        row.openEdges = measured->measure.openEdges;
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

// Top rows: bone, soft tissue, then the kinds. Of a row below a kind the internal id is the kind's
// row.
QModelIndex StructuresModel::index(int row, int column, const QModelIndex& parent) const
{
  if (!hasIndex(row, column, parent))
    return {};
  return createIndex(row, column,
                     parent.isValid() ? static_cast<quintptr>(parent.row()) : quintptr(0));
}

QModelIndex StructuresModel::parent(const QModelIndex& index) const
{
  return index.isValid() && index.internalId() > 0
             ? createIndex(static_cast<int>(index.internalId()), 0, quintptr(0))
             : QModelIndex();
}

const StructuresModel::Row* StructuresModel::at(const QModelIndex& index) const
{
  if (!index.isValid() || m_rows.empty())
    return nullptr;
  const auto row = static_cast<std::size_t>(index.row());
  if (index.internalId() == 0)
    return row < kSingleRows ? &m_rows[row] : nullptr;
  const std::size_t kind = index.internalId() - kSingleRows;
  return kind < m_kinds.size() && row < m_kinds[kind].count ? &m_rows[m_kinds[kind].first + row]
                                                            : nullptr;
}

const StructuresModel::Kind* StructuresModel::kindAt(const QModelIndex& index) const
{
  const auto row = static_cast<std::size_t>(index.row());
  return index.isValid() && index.internalId() == 0 && row >= kSingleRows &&
                 row < kSingleRows + m_kinds.size()
             ? &m_kinds[row - kSingleRows]
             : nullptr;
}

std::string StructuresModel::partAt(const QModelIndex& index) const
{
  const Row* row = at(index);
  return row ? row->row.part : std::string();
}

std::string StructuresModel::nameAt(const QModelIndex& index) const
{
  const Row* row = at(index);
  return row && !isSingle(row->row.kind) ? row->row.part : std::string();
}

QModelIndex StructuresModel::rowOf(const std::string& part) const
{
  for (std::size_t n = 0; n < std::min(kSingleRows, m_rows.size()); ++n)
    if (m_rows[n].row.part == part)
      return index(static_cast<int>(n), Name);
  for (std::size_t kind = 0; kind < m_kinds.size(); ++kind)
    for (std::size_t n = 0; n < m_kinds[kind].count; ++n)
      if (m_rows[m_kinds[kind].first + n].row.part == part)
        return index(static_cast<int>(n), Name, index(static_cast<int>(kSingleRows + kind), Name));
  return {};
}

appearance::StructureAppearance StructuresModel::lookAt(const QModelIndex& index) const
{
  const Row* row = at(index);
  return row ? row->row.look : appearance::StructureAppearance();
}

QString StructuresModel::title(const presenters::StructureRow& row) const
{
  if (row.kind == StructureKind::SoftTissue)
    return tr("Soft tissue");
  if (row.kind != StructureKind::Bone)
    return shownName(row.part);
  return m_model.hasCase() && m_model.value().ct.modality == scene::Modality::Mr ? tr("Tissue")
                                                                                 : tr("Bone");
}

QString StructuresModel::titleOf(const std::string& part) const
{
  const Row* row = at(rowOf(part));
  return row ? title(row->row) : QString();
}

QString StructuresModel::folded(const QString& text)
{
  QString plain;
  for (const QChar& c : text.normalized(QString::NormalizationForm_KD))
    if (!c.isMark())
      plain += c;
  return plain.toCaseFolded().replace(QChar(0xdf), "ss").replace('_', ' ');
}

QString StructuresModel::searchText(const QModelIndex& index) const
{
  const Row* row = at(index);
  if (!row)
    return {};
  const QString kind = isSingle(row->row.kind) ? QString() : tr(titleOfKind(row->row.kind));
  return folded(title(row->row) + ' ' + words(row->row.look.preset) + ' ' + kind);
}

void StructuresModel::caseChanged()
{
  beginResetModel();
  m_rows = rows();
  m_kinds.clear();
  for (std::size_t n = 0; n < m_rows.size(); ++n)
  {
    const StructureKind kind = m_rows[n].row.kind;
    if (isSingle(kind))
      continue;
    if (m_kinds.empty() || m_kinds.back().kind != kind)
      m_kinds.push_back({kind, n, 0});
    ++m_kinds.back().count;
  }
  endResetModel();
  measureMeshes();
}

bool StructuresModel::isOthers(const std::vector<Row>& next) const
{
  const auto isSame = [](const Row& a, const Row& b)
  { return a.row.part == b.row.part && a.row.kind == b.row.kind; };
  return next.size() != m_rows.size() ||
         !std::equal(next.begin(), next.end(), m_rows.begin(), isSame);
}

bool StructuresModel::needsRebuild()
{
  return isOthers(rows());
}

void StructuresModel::appearanceChanged()
{
  auto next = rows();
  if (isOthers(next))
    return caseChanged();
  std::vector<std::string> changed;
  for (std::size_t n = 0; n < next.size(); ++n)
  {
    next[n].near = m_rows[n].near;
    if (!(next[n].row.look == m_rows[n].row.look) || next[n].volume != m_rows[n].volume ||
        next[n].isBeingMeasured != m_rows[n].isBeingMeasured ||
        next[n].row.missing != m_rows[n].row.missing ||
        next[n].row.outdated != m_rows[n].row.outdated || next[n].notDrawn != m_rows[n].notDrawn)
      changed.push_back(next[n].row.part);
  }
  m_rows = std::move(next);
  for (const std::string& part : changed)
  {
    const QModelIndex row = rowOf(part);
    emit dataChanged(row, row.siblingAtColumn(columnCount() - 1));
    if (const QModelIndex kind = row.parent(); kind.isValid())
      emit dataChanged(kind, kind.siblingAtColumn(columnCount() - 1));
  }
  measureMeshes();
}

void StructuresModel::setNear(std::vector<presenters::NearbyStructure> structures)
{
  for (Row& row : m_rows)
  {
    QString near;
    for (const presenters::NearbyStructure& one : structures)
      if (one.name == row.row.part && !isSingle(row.row.kind))
        near = one.state == presenters::NearbyStructure::State::Touched ? tr("touched")
                                                                        : distanceOf(one);
    if (near == row.near)
      continue;
    row.near = near;
    const QModelIndex cell = rowOf(row.row.part).siblingAtColumn(Burr);
    emit dataChanged(cell, cell);
  }
}

int StructuresModel::rowCount(const QModelIndex& parent) const
{
  if (!parent.isValid())
    return m_rows.empty() ? 0 : static_cast<int>(kSingleRows + m_kinds.size());
  const Kind* kind = parent.column() == 0 ? kindAt(parent) : nullptr;
  return kind ? static_cast<int>(kind->count) : 0;
}

int StructuresModel::columnCount(const QModelIndex&) const
{
  return FirstProperty + static_cast<int>(columns().size());
}

// Why a mesh marked touchable is not; empty if it is. Evaluated for tooltips only, as it is slow.
QString StructuresModel::untouchableText(const std::string& name) const
{
  const auto& value = m_model.value();
  for (const auto& mesh : value.meshes)
    if (mesh.name == name)
      try
      {
        const std::string reason = scene::untouchable(value, mesh);
        return reason.empty() ? QString() : tr("Not felt: %1").arg(phrase(reason));
      }
      catch (const core::Error& error)
      {
        return phrase(error.what());
      }
  return {};
}

QString StructuresModel::primary() const
{
  return m_model.hasCase() ? presenters::primaryName(m_model.value()) : "CT";
}

QVariant StructuresModel::data(const QModelIndex& index, int role) const
{
  if (const Kind* kind = kindAt(index))
    return kindData(*kind, index.column(), role);
  const Row* found = at(index);
  if (!found)
    return {};
  const Row& row = *found;
  switch (index.column())
  {
  case Name:
    if (role == Qt::DisplayRole)
    {
      const QString name = title(row.row);
      if (!row.notDrawn.empty())
        return tr("%1 (not drawn)").arg(name);
      if (!row.row.outdated.empty())
        return tr("%1 (MR moved since)").arg(name);
      return row.row.missing.empty() ? name : tr("%1 (not on the %2)").arg(name, primary());
    }
    if (role == Qt::DecorationRole)
      return swatch(colorOf(row.row.look), kSwatch);
    if (role == Qt::AccessibleTextRole)
      return tr("%1, colour %2, %3")
          .arg(title(row.row), colorOf(row.row.look).name(),
               row.row.look.shown ? tr("shown") : tr("hidden"));
    if (role == Qt::ToolTipRole && !row.row.missing.empty())
      return tr("%1 is nowhere on the %2, and neither drawn nor felt nor warned of: %3")
          .arg(words(row.row.part), primary(), phrase(row.row.missing));
    if (role == Qt::ToolTipRole && !row.row.outdated.empty())
      return tr("%1 stays where it was made: %2")
          .arg(words(row.row.part), phrase(row.row.outdated));
    if (role == Qt::ToolTipRole && row.row.kind == StructureKind::Bone)
      return tr("The %1 itself, where no structure is").arg(primary());
    if (role == Qt::ToolTipRole && row.row.kind == StructureKind::SoftTissue)
    {
      const QString what =
          m_model.value().ct.modality == scene::Modality::Mr
              ? tr("What lies below the surface threshold and is no structure, in 3D alone: it is "
                   "air to the hand and the drill")
              : tr("What is neither bone nor a structure, in 3D alone: it is air to the hand and "
                   "the drill");
      return row.notDrawn.empty() ? what
                                  : what + '\n' + tr("Not drawn: %1").arg(phrase(row.notDrawn));
    }
    if (role == Qt::ToolTipRole)
      return row.row.look.solid ? words(row.row.part)
                                : tr("%1 (a space without tissue)").arg(words(row.row.part));
    return {};
  case Burr:
    if (role == Qt::DisplayRole)
      return row.near;
    if (role == Qt::TextAlignmentRole)
      return int(Qt::AlignRight | Qt::AlignVCenter);
    return {};
  case VolumeColumn:
    if (role == Qt::DisplayRole && row.isBeingMeasured)
      return QString::fromUtf8("…");
    if (role == Qt::ToolTipRole && row.isBeingMeasured)
      return tr("The mesh is being measured");
    if (role == Qt::DisplayRole && row.openEdges > 0)
      return tr("open");
    if (role == Qt::ToolTipRole && row.openEdges > 0)
      return (row.openEdges == 1 ? tr("No volume: the mesh is open, its surface ends at %1 edge")
                                 : tr("No volume: the mesh is open, its surface ends at %1 edges"))
          .arg(row.openEdges);
    if (role == Qt::DisplayRole && row.volume > 0.0)
      return tr("%1 mm³").arg(numberText(row.volume, row.volume < 10.0    ? 2
                                                     : row.volume < 100.0 ? 1
                                                                          : 0));
    if (role == Qt::TextAlignmentRole)
      return int(Qt::AlignRight | Qt::AlignVCenter);
    if (role == Qt::ToolTipRole)
    {
      const auto drilled = presenters::injuredVolumes(m_model.value());
      const auto amount = drilled.find(row.row.part);
      return amount == drilled.end()
                 ? tr("Volume, mm³")
                 : tr("Volume, mm³") + '\n' +
                       tr("Drilled: %1")
                           .arg(numberText(presenters::cubicMillimetres(amount->second)));
    }
    return {};
  default:
    return propertyData(row, propertyAt(index.column()), role);
  }
}

std::vector<const StructuresModel::Row*>
StructuresModel::changedBy(const Kind& kind, const StructureProperty& property) const
{
  std::vector<const Row*> changed;
  for (std::size_t n = kind.first; n < kind.first + kind.count; ++n)
    if (idleText(m_rows[n].row.look, property).isEmpty())
      changed.push_back(&m_rows[n]);
  return changed;
}

// How many there are, and whether they are shown, touched and drilled: all, none or some.
QVariant StructuresModel::kindData(const Kind& kind, int column, int role) const
{
  if (column == Name && role == Qt::DisplayRole)
    return kind.found ? tr("%1 (%2 of %3)")
                            .arg(tr(titleOfKind(kind.kind)))
                            .arg(*kind.found)
                            .arg(kind.count)
                      : tr("%1 (%2)").arg(tr(titleOfKind(kind.kind))).arg(kind.count);
  if (column == Name && role == Qt::ToolTipRole)
    return tr("Its check boxes are those of all of them");
  if (column < FirstProperty || !isFlag(propertyAt(column)))
    return {};
  const auto changed = changedBy(kind, propertyAt(column));
  if (role == Qt::ToolTipRole && changed.empty())
    return idleText(m_rows[kind.first].row.look, propertyAt(column));
  if (role != Qt::CheckStateRole || changed.empty())
    return {};
  const auto flag = std::get<StructureProperty::Flag>(propertyAt(column).member);
  const auto set = std::count_if(changed.begin(), changed.end(),
                                 [flag](const Row* row) { return row->row.look.*flag; });
  return set == 0                                             ? Qt::Unchecked
         : set == static_cast<std::ptrdiff_t>(changed.size()) ? Qt::Checked
                                                              : Qt::PartiallyChecked;
}

QVariant StructuresModel::propertyData(const Row& row, const StructureProperty& property,
                                       int role) const
{
  if (isSingle(row.row.kind) && !isOfBone(property))
    return {};
  if (property.isNumber())
  {
    if (role == Qt::EditRole)
      return numberOf(row.row.look, property);
    if (role == Qt::DisplayRole)
      return isOff(row.row.look, property)
                 ? QString::fromUtf8("–")
                 : QString("%1 %2").arg(phrase(toString(row.row.look, property)),
                                        property.range.unit);
    if (role == Qt::TextAlignmentRole)
      return int(Qt::AlignRight | Qt::AlignVCenter);
    return {};
  }
  const auto flag = std::get<StructureProperty::Flag>(property.member);
  if (const QString idle = idleText(row.row.look, property); !idle.isEmpty())
    return role == Qt::ToolTipRole ? QVariant(idle) : QVariant();
  if (role == Qt::ToolTipRole && flag == &appearance::StructureAppearance::touchable &&
      row.row.kind == StructureKind::Mesh)
    return untouchableText(row.row.part);
  if (role == Qt::CheckStateRole)
    return row.row.look.*flag ? Qt::Checked : Qt::Unchecked;
  return {};
}

QVariant StructuresModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (orientation != Qt::Horizontal)
    return {};
  if (section < 0 || section >= columnCount())
    return {};
  const bool isProperty = section >= FirstProperty;
  const bool isIcon = isProperty && isFlag(propertyAt(section)); // narrow in every language
  if (role == Qt::DecorationRole)
    return isIcon ? QVariant(flagIcon(propertyAt(section))) : QVariant();
  if (role == Qt::DisplayRole && isIcon)
    return {};
  if (role == Qt::DisplayRole || role == Qt::AccessibleTextRole)
    return isProperty                ? tr(propertyAt(section).column.title)
           : section == Name         ? tr("Structure")
           : section == VolumeColumn ? tr("Volume")
                                     : tr("Tool");
  if (role == Qt::ToolTipRole && isIcon)
    return tr("%1: %2").arg(tr(propertyAt(section).column.title),
                            tr(propertyAt(section).column.tip));
  if (role == Qt::ToolTipRole)
    return isProperty        ? tr(propertyAt(section).column.tip)
           : section == Name ? tr("Name and colour: click the colour to change it")
           : section == VolumeColumn
               ? tr("Volume, mm³")
               : tr("From the burr's ball, or the instrument, to the structure's surface");
  const bool isNumber = isProperty ? propertyAt(section).isNumber() : section != Name;
  if (role == Qt::TextAlignmentRole)
    return int((isNumber ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
  return {};
}

Qt::ItemFlags StructuresModel::flags(const QModelIndex& index) const
{
  if (!index.isValid())
    return Qt::NoItemFlags;
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
  if (index.column() < FirstProperty)
    return flags;
  const StructureProperty& property = propertyAt(index.column());
  const Row* row = at(index);
  if (row && isSingle(row->row.kind) && !isOfBone(property))
    return flags;
  if (row ? !idleText(row->row.look, property).isEmpty()
          : changedBy(*kindAt(index), property).empty())
    return flags;
  if (isFlag(property))
    flags |= Qt::ItemIsUserCheckable;
  else if (row)
    flags |= Qt::ItemIsEditable;
  return flags;
}

bool StructuresModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
  if (!index.isValid() || index.column() < FirstProperty || m_model.drilling())
    return false;
  const StructureProperty& property = propertyAt(index.column());
  std::vector<std::string> parts;
  if (const Kind* kind = kindAt(index))
    for (const Row* row : changedBy(*kind, property))
      parts.push_back(row->row.part);
  else if (const Row* row = at(index); row && idleText(row->row.look, property).isEmpty() &&
                                       (!isSingle(row->row.kind) || isOfBone(property)))
    parts = {row->row.part};
  const bool isNumber =
      role == Qt::EditRole && property.isNumber() && property.accepts(value.toDouble());
  if (parts.empty() || (!isNumber && (role != Qt::CheckStateRole || !isFlag(property))))
    return false;
  presenters::changeLooks(m_model, parts,
                          [&](const std::string&, appearance::StructureAppearance& look)
                          {
                            if (isNumber)
                              setNumber(look, property, value.toDouble());
                            else
                              look.*std::get<StructureProperty::Flag>(property.member) =
                                  value.toInt() == Qt::Checked;
                          });
  appearanceChanged(); // also where nobody tells us
  return true;
}

} // namespace petrous::workstation
