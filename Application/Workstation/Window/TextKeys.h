#pragma once

#include <QObject>

class QApplication;

namespace petrous::workstation
{

/// What is typed in a text field is entered there, whatever key of the window has the same
/// character. Qt's fields claim a character only with Shift or without a modifier; one that needs
/// AltGr ([, ], {, }, @, ~ and others on German, French and Swiss keyboards) would go to the
/// window.
class TextKeys : public QObject
{
public:
  /// The application owns it.
  explicit TextKeys(QApplication& application);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

} // namespace petrous::workstation
