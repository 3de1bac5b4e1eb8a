#pragma once

#include <QObject>

class QApplication;

namespace petrous::workstation
{

/// Numbers have a decimal point, whatever the session's language: in the window as in the command's
/// answers, files and the distances beside the burr. Qt takes over the session's locale for the C
/// library too; this takes LC_NUMERIC back, for the libraries that follow it. A comma that is typed
/// into a number's box becomes the point.
class DecimalPoint : public QObject
{
public:
  /// After the application, which owns it, and before the first widget.
  explicit DecimalPoint(QApplication& application);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

} // namespace petrous::workstation
