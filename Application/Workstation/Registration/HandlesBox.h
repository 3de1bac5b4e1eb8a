#pragma once

#include <functional>

#include <QString>
#include <QWidget>

#include "petrous/Presenters/RegistrationSession.h"

class QComboBox;
class QGridLayout;
class QLabel;

namespace petrous::workstation
{

/// Six controls that translate an MR along the patient's axes and rotate it about the crosshair.
class HandlesBox : public QWidget
{
  Q_OBJECT
public:
  explicit HandlesBox(presenters::RegistrationSession& session, QWidget* parent = nullptr);

  void refresh();

signals:
  void attempted(const QString& why); ///< why the MR was not moved; empty: it was

private:
  struct Handle
  {
    const char* less;
    const char* more;
    QString lessTip;
    QString moreTip;
    Eigen::Vector3d direction; ///< of `more`
    bool turns;
  };
  void addHandle(QGridLayout& grid, int row, int column, const Handle& handle);
  void apply(const Handle& handle, double sign);
  void attempt(const std::function<void()>& move);

  presenters::RegistrationSession& m_session;
  QComboBox* m_step;
  QLabel* m_moved;
};

} // namespace petrous::workstation
