#pragma once

#include <QObject>

#include "petrous/Presenters/NearbyStructures.h"

namespace petrous::workstation
{

/// What the surgeon must see at once while using a burr or an instrument, whatever panels are open:
/// structures that are touched, injured or within their warning distance.
class ToolWarnings : public QObject
{
  Q_OBJECT
public:
  explicit ToolWarnings(QObject* parent = nullptr);

  void show(const presenters::ToolSurroundings& near);
  void toolGone(); ///< it was put away

signals:
  /// Lines of text (presenters::warningsOf), or why there are none; empty: nothing. Emitted on
  /// change.
  void warned(const QString& lines);
  void alarmed(bool near); ///< whether they are of a structure; on change

private:
  void warn(const QString& lines, bool near = false);

  QString m_warned;
  bool m_alarmed = false;
};

} // namespace petrous::workstation
