#pragma once

#include <QWidget>

namespace petrous::workstation
{

/// What the window shows before there is a case: how to begin.
class StartPage : public QWidget
{
  Q_OBJECT
public:
  explicit StartPage(QWidget* parent = nullptr);

signals:
  void openFolderAsked();
  void openCaseAsked();
  void sampleAsked();
};

} // namespace petrous::workstation
