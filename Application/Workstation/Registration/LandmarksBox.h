#pragma once

#include <QWidget>

#include "petrous/Presenters/RegistrationSession.h"

class QPushButton;
class QTableView;

namespace petrous::workstation
{

class LandmarkModel;

/// Landmark pairs, picked in CT and MR.
class LandmarksBox : public QWidget
{
  Q_OBJECT
public:
  explicit LandmarksBox(presenters::RegistrationSession& session, QWidget* parent = nullptr);

  void refresh();

signals:
  void pointAsked(); ///< at the crosshair
  void fitAsked();
  void changed();

private:
  presenters::RegistrationSession& m_session;
  LandmarkModel* m_rows;
  QTableView* m_table;
  QPushButton* m_point;
  QPushButton* m_remove;
  QPushButton* m_fit;
};

} // namespace petrous::workstation
