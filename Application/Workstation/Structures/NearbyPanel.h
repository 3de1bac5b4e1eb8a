#pragma once

#include "Panels.h"
#include "petrous/Presenters/WorkstationModel.h"

class QLabel;

namespace petrous::workstation
{

class NearbyModel;

/// Structures near the burr, injured ones, and the removed volume. Shows what is near only while
/// visible.
class NearbyPanel : public Panel
{
  Q_OBJECT
public:
  explicit NearbyPanel(presenters::WorkstationModel& model, QWidget* parent = nullptr);

  void caseChanged() override;
  void stateChanged() override;
  void toolMoved(const presenters::MeasuredTool& tool, const haptics::Pose& pose) override;
  void toolGone() override;
  QWidget* mainControl() override { return nullptr; } // it is read while the tool is in use
  bool showsNear() const override { return isVisible(); }
  void toolMeasured(const presenters::ToolSurroundings& near) override;

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
  bool m_hasBurr = false; // in use
};

} // namespace petrous::workstation
