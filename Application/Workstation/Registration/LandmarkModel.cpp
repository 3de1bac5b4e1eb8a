#include "LandmarkModel.h"

#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Core/PositionText.h"

namespace petrous::workstation
{

LandmarkModel::LandmarkModel(presenters::RegistrationSession& session, QObject* parent)
  : QAbstractTableModel(parent)
  , m_session(session)
{
}

void LandmarkModel::refresh()
{
  const int rows = static_cast<int>(m_session.landmarks().rows().size());
  if (rows != m_rows)
  {
    beginResetModel();
    m_rows = rows;
    endResetModel();
  }
  else if (m_rows > 0)
    emit dataChanged(index(0, 0), index(m_rows - 1, ColumnCount - 1));
}

int LandmarkModel::rowCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : m_rows;
}

int LandmarkModel::columnCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : ColumnCount;
}

QVariant LandmarkModel::data(const QModelIndex& index, int role) const
{
  if (!index.isValid() || index.row() >= m_rows)
    return {};
  if (role == Qt::TextAlignmentRole && index.column() == Residual)
    return QVariant(Qt::AlignRight | Qt::AlignVCenter);
  if (role != Qt::DisplayRole && role != Qt::ToolTipRole) // the tooltip shows elided text
    return {};
  const auto row = static_cast<std::size_t>(index.row());
  const auto& landmark = m_session.landmarks().rows()[row];
  switch (index.column())
  {
  case Number:
    return index.row() + 1;
  case Ct:
    return numberText(core::positionText(landmark.ct));
  case Mr:
    return landmark.mr ? numberText(core::positionText(*landmark.mr)) : tr("show it in the MR");
  case Residual:
    break;
  }
  const auto left = m_session.part()
                        ? m_session.landmarks().residual(row, m_session.part()->mrFromCt)
                        : std::nullopt;
  return left ? tr("%1 mm").arg(numberText(*left, 2)) : QString();
}

QVariant LandmarkModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole)
    return {};
  switch (section)
  {
  case Number:
    return tr("#");
  case Ct:
    return tr("In the %1").arg(words(m_session.primary()));
  case Mr:
    return tr("In the MR");
  case Residual:
    return tr("Apart");
  default:
    return {};
  }
}

} // namespace petrous::workstation
