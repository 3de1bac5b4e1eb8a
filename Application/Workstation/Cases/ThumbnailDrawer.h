#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include "BackgroundWork.h"
#include "petrous/Library/Library.h"

namespace petrous::workstation
{

/// Draws the thumbnails of cases (presenters::thumbnailOf: bone and structures, never a face) in a
/// separate thread, one at a time, while nothing else goes on: that of a case that was saved, and
/// those of listed cases that need one (library::needsThumbnail). A case whose thumbnail cannot be
/// drawn is left without one, silently, until it is saved again.
class ThumbnailDrawer : public QObject
{
  Q_OBJECT
public:
  /// `library`: that of the window now. `delay`: ms without a new request before one is drawn;
  /// negative: never drawn.
  ThumbnailDrawer(std::function<library::Library()> library, int delay, QObject* parent = nullptr);

  /// Whether nothing else goes on; asked repeatedly while there is something to draw. What is being
  /// drawn is cancelled when it becomes false, and drawn later.
  std::function<bool()> isIdle;

  void setEnabled(bool enabled); ///< off: nothing is drawn, and what was asked for is forgotten
  bool enabled() const noexcept { return m_enabled; }

  void caseSaved(const std::string& name);
  void caseSeen(const library::CaseSummary& summary);

  bool busy() const noexcept { return m_work.busy(); }

signals:
  void drawn(const QString& id); ///< of the case

private:
  void ask(const std::string& name, bool first);
  void look();
  void examine();
  void draw();

  std::function<library::Library()> m_library;
  int m_delay;
  bool m_enabled = true;
  std::vector<std::string> m_wanted;          ///< names of cases, the next one first
  std::string m_current;                      ///< the one being drawn
  std::vector<library::CaseSummary> m_listed; ///< may need one, which their files tell
  std::set<std::string> m_seen; ///< id and time of change of those that were looked at
  QElapsedTimer m_asked;
  QTimer m_timer;
  BackgroundWork m_work;
};

} // namespace petrous::workstation
