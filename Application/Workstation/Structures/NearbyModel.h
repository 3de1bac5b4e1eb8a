#pragma once

#include <vector>

#include <QAbstractTableModel>

#include "petrous/Presenters/NearbyStructures.h"

namespace petrous::workstation
{

/// "1.8 mm ± 0.3"
QString distanceOf(const presenters::NearbyStructure& structure);

/// The structures near the tool as rows. Danger is shown by a sign and in words, not by colour
/// alone.
class NearbyModel : public QAbstractTableModel
{
  Q_OBJECT
public:
  enum Column
  {
    Name,     ///< with the sign
    Distance, ///< "1.8 mm ± 0.3"
    Note,     ///< "clear", "within 2.0 mm", "touched", "0.42 mm³ taken"
    ColumnCount
  };

  using QAbstractTableModel::QAbstractTableModel;

  void show(std::vector<presenters::NearbyStructure> structures);

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
  std::vector<presenters::NearbyStructure> m_rows;
};

} // namespace petrous::workstation
