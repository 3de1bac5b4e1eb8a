#pragma once

#include <QAbstractTableModel>

#include "petrous/Presenters/RegistrationSession.h"

namespace petrous::workstation
{

/// The landmark pairs of a registration as rows: number, the two points, and the residual.
class LandmarkModel : public QAbstractTableModel
{
  Q_OBJECT
public:
  enum Column
  {
    Number,
    Ct,
    Mr,
    Residual,
    ColumnCount
  };

  explicit LandmarkModel(presenters::RegistrationSession& session, QObject* parent = nullptr);

  void refresh(); ///< rows or the MR's registration changed

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

private:
  presenters::RegistrationSession& m_session;
  int m_rows = 0;
};

} // namespace petrous::workstation
