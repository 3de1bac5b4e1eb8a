#pragma once

#include <QObject>
#include <QPointer>
#include <QTimer>
#include <QVariant>

class QAbstractSpinBox;
class QApplication;

namespace petrous::workstation
{

/// Numbers of the window are those of its language (numberLocale), whatever the session's locale;
/// those of files and of command output have a point. Qt applies the session's locale to the C
/// library too; this resets LC_NUMERIC, for the libraries that follow it. In a number field with
/// decimals comma and point are the same key, typed or pasted.
///
/// A number that a field cannot take never becomes another one by losing characters: the field goes
/// back to what it had, says what is possible, also in the status bar of its window, is marked for
/// some seconds (property "refused"), and takes no more of that number until it is left by the
/// mouse, or Return, Tab, an arrow or a deleting key is pressed. What is said goes with the next
/// number that it takes. The Return or Tab that ends a
/// refused number leaves the focus in the field, with all of its text selected; the next one leaves
/// it.
class DecimalPoint : public QObject
{
  Q_OBJECT
public:
  /// Create after the application, which owns it, and before the first widget.
  explicit DecimalPoint(QApplication& application);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  bool typed(QAbstractSpinBox& box, const QString& text);
  void refuse(QAbstractSpinBox& box, const QString& what);
  void mark(QAbstractSpinBox& box, bool refused);
  void unmark();
  void mended(QAbstractSpinBox& box);

  QPointer<QAbstractSpinBox> m_box; ///< in which a number is being typed
  QVariant m_before;                ///< its value before that
  bool m_isRest = false;            ///< it was refused, and what follows is its rest
  QPointer<QAbstractSpinBox> m_marked;
  QTimer m_marks; ///< until the mark goes
  QString m_said; ///< of the last refusal
};

} // namespace petrous::workstation
