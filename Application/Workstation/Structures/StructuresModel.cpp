#include "StructuresModel.h"

#include <utility>

#include <QColor>
#include <QPainter>
#include <QPixmap>

#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/Placement.h"

namespace petrous::workstation
{

namespace
{
QColor colorOf(const appearance::StructureAppearance& look)
{
  return QColor::fromRgbF(double(look.color[0]), double(look.color[1]), double(look.color[2]));
}

QPixmap swatch(const appearance::StructureAppearance& look)
{
  QPixmap pixmap(12, 12);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QColor(0, 0, 0, 160));
  painter.setBrush(colorOf(look));
  painter.drawRoundedRect(QRectF(0.5, 0.5, 11.0, 11.0), 3.0, 3.0);
  return pixmap;
}

using appearance::StructureProperty;

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

StructuresModel::StructuresModel(presenters::WorkstationModel& model, QObject* parent)
  : QAbstractTableModel(parent)
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

QString StructuresModel::countText() const
{
  std::size_t structures = 0, meshes = 0, shown = 0;
  for (const Row& row : m_rows)
  {
    ++(row.isMesh ? meshes : structures);
    shown += row.look.shown;
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
  for (const auto& part : value.labels)
  {
    const std::string missing = scene::placementOf(value, part).missing;
    for (const auto& structure : part.structures)
      rows.push_back({structure.name, structure.volume, false, false, 0, structure.look, missing});
  }
  for (const auto& mesh : value.meshes)
    if (!scene::findStructure(value, mesh.name))
    {
      Row row{mesh.name, 0.0, true, true, 0, mesh.look, scene::placementOf(value, mesh).missing};
      if (const Measured* measured = measuredOf(mesh))
      {
        row.volume = measured->measure.volume.value_or(0.0);
        row.isBeingMeasured = false;
        row.openEdges = measured->measure.openEdges;
      }
      rows.push_back(std::move(row));
    }
  return rows;
}

std::string StructuresModel::nameAt(const QModelIndex& index) const
{
  return index.isValid() && index.row() < rowCount()
             ? m_rows[static_cast<std::size_t>(index.row())].name
             : std::string();
}

QModelIndex StructuresModel::rowOf(const std::string& name) const
{
  for (int row = 0; row < rowCount(); ++row)
    if (m_rows[static_cast<std::size_t>(row)].name == name)
      return index(row, Name);
  return {};
}

appearance::StructureAppearance StructuresModel::lookAt(const QModelIndex& index) const
{
  return index.isValid() && index.row() < rowCount()
             ? m_rows[static_cast<std::size_t>(index.row())].look
             : appearance::StructureAppearance();
}

void StructuresModel::caseChanged()
{
  beginResetModel();
  m_rows = rows();
  endResetModel();
  measureMeshes();
}

void StructuresModel::appearanceChanged()
{
  auto next = rows();
  if (next.size() != m_rows.size())
    return caseChanged();
  m_rows = std::move(next);
  if (!m_rows.empty())
    emit dataChanged(index(0, 0), index(rowCount() - 1, columnCount() - 1));
  measureMeshes();
}

int StructuresModel::rowCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int StructuresModel::columnCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : FirstProperty + static_cast<int>(columns().size());
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
        return reason.empty() ? QString() : tr("Not felt: %1").arg(words(reason));
      }
      catch (const core::Error& error)
      {
        return words(error.what());
      }
  return {};
}

QString StructuresModel::primary() const
{
  return m_model.hasCase() ? presenters::primaryName(m_model.value()) : "CT";
}

QVariant StructuresModel::data(const QModelIndex& index, int role) const
{
  if (!index.isValid() || index.row() >= rowCount())
    return {};
  const Row& row = m_rows[static_cast<std::size_t>(index.row())];
  switch (index.column())
  {
  case Name:
    if (role == Qt::DisplayRole)
    {
      const QString name = words(row.name).replace('_', ' ');
      return row.missing.empty() ? name : tr("%1 (not on the %2)").arg(name, primary());
    }
    if (role == Qt::DecorationRole)
      return swatch(row.look);
    if (role == Qt::ToolTipRole && !row.missing.empty())
      return tr("%1 is nowhere on the %2, and neither drawn nor felt nor warned of: %3")
          .arg(words(row.name), primary(), windowText(words(row.missing)));
    if (role == Qt::ToolTipRole)
      return row.look.solid ? words(row.name)
                            : tr("%1 (a space without tissue)").arg(words(row.name));
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
      return tr("%1 mm³").arg(row.volume, 0, 'f',
                              row.volume < 10.0    ? 2
                              : row.volume < 100.0 ? 1
                                                   : 0);
    if (role == Qt::TextAlignmentRole)
      return int(Qt::AlignRight | Qt::AlignVCenter);
    if (role == Qt::ToolTipRole)
      return tr("Volume, mm³");
    return {};
  default:
    return propertyData(row, propertyAt(index.column()), role);
  }
}

QVariant StructuresModel::propertyData(const Row& row, const StructureProperty& property,
                                       int role) const
{
  if (property.isNumber())
  {
    if (role == Qt::EditRole)
      return numberOf(row.look, property);
    if (role == Qt::DisplayRole)
      return isOff(row.look, property)
                 ? QString::fromUtf8("–")
                 : QString("%1 %2").arg(words(toString(row.look, property)), property.range.unit);
    if (role == Qt::TextAlignmentRole)
      return int(Qt::AlignRight | Qt::AlignVCenter);
    return {};
  }
  const auto flag = std::get<StructureProperty::Flag>(property.member);
  if (role == Qt::ToolTipRole && flag == &appearance::StructureAppearance::touchable && row.isMesh)
    return untouchableText(row.name);
  if (role == Qt::CheckStateRole)
    return row.look.*flag ? Qt::Checked : Qt::Unchecked;
  return {};
}

QVariant StructuresModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (orientation != Qt::Horizontal)
    return {};
  if (section < 0 || section >= columnCount())
    return {};
  const bool isProperty = section >= FirstProperty;
  if (role == Qt::DisplayRole)
    return tr(isProperty        ? propertyAt(section).column.title
              : section == Name ? "Structure"
                                : "Volume");
  if (role == Qt::ToolTipRole)
    return tr(isProperty        ? propertyAt(section).column.tip
              : section == Name ? "Name and colour"
                                : "Volume, mm³");
  const bool isNumber = isProperty ? propertyAt(section).isNumber() : section == VolumeColumn;
  if (role == Qt::TextAlignmentRole)
    return int((isNumber ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
  return {};
}

Qt::ItemFlags StructuresModel::flags(const QModelIndex& index) const
{
  if (!index.isValid())
    return Qt::NoItemFlags;
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
  if (index.column() >= FirstProperty)
    flags |= propertyAt(index.column()).isNumber() ? Qt::ItemIsEditable : Qt::ItemIsUserCheckable;
  return flags;
}

bool StructuresModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
  if (!index.isValid() || index.column() < FirstProperty || m_model.drilling())
    return false;
  const StructureProperty& property = propertyAt(index.column());
  Row& row = m_rows[static_cast<std::size_t>(index.row())];
  if (role == Qt::EditRole && property.isNumber() && property.accepts(value.toDouble()))
    setNumber(row.look, property, value.toDouble());
  else if (role == Qt::CheckStateRole && !property.isNumber())
    row.look.*std::get<StructureProperty::Flag>(property.member) = value.toInt() == Qt::Checked;
  else
    return false;
  m_model.setLook(row.name, row.look);
  emit dataChanged(index, index);
  return true;
}

} // namespace petrous::workstation
