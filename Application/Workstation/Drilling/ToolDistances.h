#pragma once

#include <functional>

#include <QElapsedTimer>
#include <QObject>

#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

/// Measures what is near the tool, once a frame for all who show it: warnings and panels.
class ToolDistances : public QObject
{
  Q_OBJECT
public:
  explicit ToolDistances(presenters::WorkstationModel& model, QObject* parent = nullptr);

  /// Whether someone shows all that is near, and not only what is warned of.
  std::function<bool()> isWideWanted = [] { return false; };

  /// At X_PT.
  void toolMoved(const presenters::MeasuredTool& tool, const haptics::Pose& pose);
  void toolGone(); ///< it was put away

signals:
  void measured(const presenters::ToolSurroundings& near);

private:
  presenters::WorkstationModel& m_model;
  QElapsedTimer m_sinceAsked, m_sinceWide;
  qint64 m_wideTook = 0; // ms
};

} // namespace petrous::workstation
