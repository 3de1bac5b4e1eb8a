#pragma once

#include <vector>

#include <QObject>

class QStatusBar;

namespace petrous::workstation
{

/// Gives a message of the status bar the room that it needs: permanent widgets go, the first of the
/// list first, for as long as it would be cut off otherwise. The whole message is the bar's tooltip
/// and accessible description, too.
class MessageRoom : public QObject
{
  Q_OBJECT
public:
  /// The bar is the parent. Permanent widgets of it that are not in the list stay.
  MessageRoom(QStatusBar& bar, const std::vector<QWidget*>& yielding);

  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  struct Yielding
  {
    QWidget* widget;
    int least, most; ///< widths that it has otherwise, pixels
    bool isGone = false;
  };

  void say(const QString& message);
  void arrange();

  QStatusBar& m_bar;
  std::vector<Yielding> m_yielding;
};

} // namespace petrous::workstation
