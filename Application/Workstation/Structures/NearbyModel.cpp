#include "NearbyModel.h"

#include <algorithm>

#include <QColor>
#include <QPainter>
#include <QPixmap>
#include <QPolygonF>

#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{

using presenters::NearbyStructure;
using State = NearbyStructure::State;

constexpr int kSign = 16; // px
const QColor kAmber("#e0a020");
const QColor kRed("#e04848");

bool harmed(const NearbyStructure& structure)
{
  return structure.state == State::Touched || structure.injured > 0.0;
}

// A dot in the structure's colour; a triangle with a bar if it is near; an octagon with a cross if
// it is touched or injured.
QPixmap signOf(const NearbyStructure& structure)
{
  QPixmap pixmap(kSign, kSign);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  QPen mark(QColor("#14171b"), 2.0);
  mark.setCapStyle(Qt::RoundCap);
  if (harmed(structure))
  {
    painter.setBrush(kRed);
    painter.drawPolygon(
        QPolygonF({{5, 1}, {11, 1}, {15, 5}, {15, 11}, {11, 15}, {5, 15}, {1, 11}, {1, 5}}));
    mark.setColor(Qt::white);
    painter.setPen(mark);
    painter.drawLine(QPointF(5.5, 5.5), QPointF(10.5, 10.5));
    painter.drawLine(QPointF(10.5, 5.5), QPointF(5.5, 10.5));
  }
  else if (structure.state == State::Warned)
  {
    painter.setBrush(kAmber);
    painter.drawPolygon(QPolygonF({{8, 1}, {15.5, 15}, {0.5, 15}}));
    painter.setPen(mark);
    painter.drawLine(QPointF(8.0, 6.0), QPointF(8.0, 9.5));
    painter.drawPoint(QPointF(8.0, 12.5));
  }
  else
  {
    painter.setBrush(QColor::fromRgbF(double(structure.color[0]), double(structure.color[1]),
                                      double(structure.color[2])));
    painter.drawEllipse(QRectF(4.0, 4.0, 8.0, 8.0));
  }
  return pixmap;
}

QString noteOf(const NearbyStructure& structure)
{
  QStringList notes;
  if (structure.state == State::Touched)
    notes += NearbyModel::tr("touched");
  else if (structure.state == State::Warned)
    notes += (structure.distance < structure.warning ? NearbyModel::tr("within %1 mm")
                                                     : NearbyModel::tr("maybe within %1 mm"))
                 .arg(numberText(structure.warning, 1));
  else if (!(structure.distance > 0.0)) // a lumen
    notes += NearbyModel::tr("open");
  if (structure.injured > 0.0)
    notes += NearbyModel::tr("injured, %1 taken")
                 .arg(numberText(presenters::cubicMillimetres(structure.injured)));
  if (structure.uncertainty.incomplete())
    notes += NearbyModel::tr("registration's error unknown");
  return notes.isEmpty() ? NearbyModel::tr("clear") : notes.join(", ");
}

} // namespace

QString distanceOf(const NearbyStructure& structure)
{
  return NearbyModel::tr("%1 mm ± %2")
      .arg(numberText(structure.distance, 1), numberText(structure.unsure(), 1));
}

void NearbyModel::show(std::vector<presenters::NearbyStructure> structures)
{
  if (structures.size() != m_rows.size())
  {
    beginResetModel();
    m_rows = std::move(structures);
    return endResetModel();
  }
  m_rows = std::move(structures);
  if (!m_rows.empty())
    emit dataChanged(index(0, 0), index(rowCount() - 1, ColumnCount - 1));
}

int NearbyModel::rowCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : static_cast<int>(m_rows.size());
}

int NearbyModel::columnCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : static_cast<int>(ColumnCount);
}

QVariant NearbyModel::data(const QModelIndex& index, int role) const
{
  if (!index.isValid() || index.row() >= rowCount())
    return {};
  const NearbyStructure& row = m_rows[static_cast<std::size_t>(index.row())];
  if (role == Qt::ForegroundRole && index.column() != Name)
    return harmed(row)                  ? QVariant(harmColor())
           : row.state == State::Warned ? QVariant(warningColor())
                                        : QVariant();
  if (role == Qt::ToolTipRole)
  {
    QString tip = tr("%1: %2\nIts surface is known to ±%3 mm: %4")
                      .arg(shownName(row.name))
                      .arg(noteOf(row))
                      .arg(numberText(row.uncertainty.millimetres(), 2))
                      .arg(phrase(toString(row.uncertainty)));
    if (row.sampling > 0.0)
      tip += tr("\nThe instrument is measured at points: between them it may be %1 mm nearer")
                 .arg(numberText(row.sampling, 2));
    return tip;
  }
  if (role == Qt::DecorationRole && index.column() == Name)
    return signOf(row);
  if (role == Qt::TextAlignmentRole && index.column() == Distance)
    return int(Qt::AlignRight | Qt::AlignVCenter);
  if (role != Qt::DisplayRole)
    return {};
  switch (index.column())
  {
  case Name:
    return shownName(row.name);
  case Distance:
    return distanceOf(row);
  default:
    return noteOf(row);
  }
}

QVariant NearbyModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (orientation != Qt::Horizontal || section < 0 || section >= ColumnCount)
    return {};
  if (role == Qt::DisplayRole)
    return section == Name       ? tr("Structure")
           : section == Distance ? tr("From the tool")
                                 : QString();
  if (role == Qt::ToolTipRole)
    return section == Name ? tr("The nearest first")
           : section == Distance
               ? tr("From the burr's ball, or the instrument, to the structure's surface, and how "
                    "well that is known to either side")
               : tr("Whether the tool is within the warning distance, and what was "
                    "taken");
  return {};
}

} // namespace petrous::workstation
