#pragma once

#include "Panels.h"

class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace petrous::workstation
{

/// All that can leave a case: report, pictures and films; each object for other programs; the whole
/// by archive or to a node, of which the identity report is shown before.
class SharePanel : public Panel
{
  Q_OBJECT
public:
  explicit SharePanel(presenters::WorkstationModel& model, QWidget* parent = nullptr);

  void caseChanged() override;
  QWidget* mainControl() override;

signals:
  void reportAsked();
  void pictureAsked();
  void filmAsked();
  /// presenters::ExportOptions::what and part.
  void exportAsked(const QString& what, const QString& part);
  void archiveAsked();
  void sendAsked();

private:
  void enable();
  void exportChosen();

  presenters::WorkstationModel& m_model;
  QTreeWidget* m_objects;
  QPushButton* m_export;
  std::vector<QPushButton*> m_ofCase;
};

} // namespace petrous::workstation
