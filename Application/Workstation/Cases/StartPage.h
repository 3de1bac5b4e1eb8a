#pragma once

#include <QWidget>

namespace petrous::workstation
{

/// Shown before a case is open: ways to begin.
class StartPage : public QWidget
{
  Q_OBJECT
public:
  explicit StartPage(QWidget* parent = nullptr);

signals:
  void openFolderAsked();
  void openCaseAsked();
  void restoreAsked();
  void sampleAsked();
};

} // namespace petrous::workstation
