#pragma once

#include <QElapsedTimer>
#include <QObject>

#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

/// What the surgeon must see at once while a burr is in the hand, whatever panels are open:
/// structures that are touched, injured or within their warning distance.
class BurrWarnings : public QObject
{
  Q_OBJECT
public:
  explicit BurrWarnings(presenters::WorkstationModel& model, QObject* parent = nullptr);

  /// Where the burr is: its centre, patient LPS mm, and its radius, mm.
  void burrMoved(const Eigen::Vector3d& center, double radius);
  void burrGone(); ///< it was laid down

signals:
  /// Some lines (presenters::warningsOf), or why there are none; empty: nothing. When it changes.
  void warned(const QString& lines);

private:
  void warn(const QString& lines);

  presenters::WorkstationModel& m_model;
  QElapsedTimer m_sinceAsked;
  QString m_warned;
};

} // namespace petrous::workstation
