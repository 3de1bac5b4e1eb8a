#pragma once

#include "Panels.h"

class QPushButton;
class QTreeWidget;

namespace petrous::workstation
{

/// List of the case's attachments, with what can be done to them.
class AttachmentsPanel : public Panel
{
  Q_OBJECT
public:
  explicit AttachmentsPanel(const presenters::WorkstationModel& model, QWidget* parent = nullptr);

  void caseChanged() override;
  void attachmentsChanged() override;
  QWidget* mainControl() override;

signals:
  void attachAsked();
  void screenshotAsked();
  void recordingAsked(); ///< attach the last one
  void extractAsked(const QString& name);
  void noteAsked(const QString& name);
  void removalAsked(const QString& name);

private:
  QString chosen() const;
  void enable();

  const presenters::WorkstationModel& m_model;
  QTreeWidget* m_list;
  QPushButton* m_recording;
  std::vector<QPushButton*> m_ofOne;
};

} // namespace petrous::workstation
