#pragma once

#include <QElapsedTimer>
#include <QWidget>

#include "petrous/Presenters/WorkstationModel.h"

class QLabel;

namespace petrous::workstation
{

class NearbyModel;

/// What a planner wants to know while drilling: structures near the burr, those injured, and what
/// was removed. Asks the model only while it is seen.
class NearbyPanel : public QWidget
{
  Q_OBJECT
public:
  explicit NearbyPanel(presenters::WorkstationModel& model, QWidget* parent = nullptr);

  void caseChanged();
  void stateChanged(); ///< strokes

  /// Where the burr is: its centre, patient LPS mm, and its radius, mm.
  void burrMoved(const Eigen::Vector3d& center, double radius);
  void burrGone(); ///< it was laid down

  const NearbyModel& structures() const { return *m_structures; }

protected:
  void hideEvent(QHideEvent* event) override;
  void showEvent(QShowEvent* event) override;

private:
  void say(const QString& line);
  void showRemoved();

  presenters::WorkstationModel& m_model;
  NearbyModel* m_structures;
  QLabel* m_removed;
  QLabel* m_line;
  QElapsedTimer m_sinceAsked;
  bool m_hasBurr = false; // in the hand
};

} // namespace petrous::workstation
