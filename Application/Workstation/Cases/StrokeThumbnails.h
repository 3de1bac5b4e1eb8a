#pragma once

#include <functional>
#include <map>
#include <vector>

#include <QImage>
#include <QObject>
#include <QTimer>

#include "BackgroundWork.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

/// Pictures of the states of the open case's dissection (presenters::drawStates), drawn in a
/// separate thread while nothing else goes on, and kept until the scene looks different. Only those
/// are drawn that were asked for last.
class StrokeThumbnails : public QObject
{
  Q_OBJECT
public:
  static constexpr int kWidth = 88, kHeight = 66; ///< px

  /// `delay`: ms without a new request before some are drawn; negative: never drawn.
  StrokeThumbnails(presenters::WorkstationModel& model, int delay, QObject* parent = nullptr);

  /// Whether nothing else goes on. What is being drawn is given up when it becomes false, and drawn
  /// later.
  std::function<bool()> isIdle;
  /// From which states without a view of their own are seen.
  std::function<core::CameraPose()> camera;

  /// Of the device's pixels; null: not drawn yet.
  QImage of(std::size_t state) const;
  void want(std::vector<std::size_t> states); ///< in this order; replaces what was wanted before
  void clear();                               ///< they look different, or another case is open

  bool busy() const noexcept { return m_work.busy(); }

signals:
  void drawn(quint64 state);

private:
  void look();
  void draw();

  presenters::WorkstationModel& m_model;
  const int m_delay;
  std::map<std::size_t, QImage> m_images;
  std::vector<std::size_t> m_wanted;
  QTimer m_timer;
  int m_waited = 0; // ms, since the last request
  BackgroundWork m_work;
};

} // namespace petrous::workstation
