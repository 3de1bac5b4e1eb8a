#pragma once

#include <string>
#include <vector>

#include <QAbstractTableModel>

#include "petrous/Library/Library.h"

namespace petrous::workstation
{

/// The cases of a library as a table, a line each.
class CasesModel : public QAbstractTableModel
{
  Q_OBJECT
public:
  enum Column
  {
    Name,
    Changed,
    Structures,
    Strokes,
    Removed,
    Voxels,
    ColumnCount
  };

  using QAbstractTableModel::QAbstractTableModel;

  /// The cases found by a search; `open` is the name of the open one, or empty.
  void setCases(std::vector<library::CaseSummary> cases, const std::string& open);

  /// Of a valid row.
  const library::CaseSummary& at(int row) const { return m_cases[static_cast<std::size_t>(row)]; }
  int rowOf(const std::string& name) const; ///< -1: there is none

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  void sort(int column, Qt::SortOrder order) override;

private:
  void sortCases();

  std::vector<library::CaseSummary> m_cases;
  std::string m_open;
  int m_column = Changed;
  Qt::SortOrder m_order = Qt::DescendingOrder;
};

/// A time of the library (UTC, ISO 8601) for the user: local, to the minute.
QString localTime(const std::string& utc);

} // namespace petrous::workstation
