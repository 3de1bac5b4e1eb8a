#pragma once

#include <vector>

#include <QColor>
#include <QFrame>
#include <QTimer>

class QGridLayout;
class QToolButton;

namespace petrous::workstation
{

/// Colours to choose from, as a pop-up: one click, or arrows and Return. A colour that the pointer
/// was moved to and rests on is previewed until it leaves, and so is one that arrows gave the focus
/// until that goes. "More colours…" opens Qt's dialog, which previews likewise. Deletes itself.
class ColorChooser : public QFrame
{
  Q_OBJECT
public:
  explicit ColorChooser(const QColor& present, QWidget* parent);

  void open(const QPoint& global); ///< near this point, on the screen

signals:
  void previewed(const QColor& color); ///< invalid: none any more; on change
  void chosen(const QColor& color);
  void cancelled();

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

private:
  void add(const QColor& color, const QString& name);
  void preview(const QColor& color);
  void finish(const QColor& color); ///< invalid: cancelled
  void askMore();
  void moveFocus(int by);

  QColor m_present;
  QGridLayout* m_grid;
  QTimer m_rest;    // the pointer's
  QColor m_wanted;  // once it rests; invalid: none
  QColor m_focused; // by arrows; invalid: none
  QColor m_tried;   // previewed; invalid: none
  std::vector<QToolButton*> m_buttons;
  bool m_isFinished = false;
  bool m_asks = false;
};

} // namespace petrous::workstation
