#pragma once

#include <QObject>

class QApplication;

namespace petrous::workstation
{

/// Numbers use a decimal point whatever the session's locale: in the window as in command output,
/// files and the distances beside the burr. Qt applies the session's locale to the C library too;
/// this resets LC_NUMERIC, for the libraries that follow it. A comma typed into a number field
/// becomes a point.
class DecimalPoint : public QObject
{
public:
  /// Create after the application, which owns it, and before the first widget.
  explicit DecimalPoint(QApplication& application);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

} // namespace petrous::workstation
