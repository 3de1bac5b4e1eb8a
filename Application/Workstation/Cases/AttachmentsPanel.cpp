#include "AttachmentsPanel.h"

#include <QGridLayout>
#include <QHeaderView>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "Bind.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Library/Attachments.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

namespace
{

enum Column
{
  Name,
  Kind,
  Note,
  Columns
};

QString kindText(scene::Attachment::Kind kind)
{
  switch (kind)
  {
  case scene::Attachment::Kind::Recording:
    return AttachmentsPanel::tr("Recording");
  case scene::Attachment::Kind::Screenshot:
    return AttachmentsPanel::tr("Picture");
  case scene::Attachment::Kind::Video:
    return AttachmentsPanel::tr("Video");
  case scene::Attachment::Kind::Document:
    break;
  }
  return AttachmentsPanel::tr("Document");
}

} // namespace

AttachmentsPanel::AttachmentsPanel(const presenters::WorkstationModel& model, QWidget* parent)
  : Panel(parent)
  , m_model(model)
  , m_list(new QTreeWidget)
{
  m_list->setObjectName("attachments");
  m_list->setAccessibleName(tr("Attachments"));
  m_list->setColumnCount(Columns);
  m_list->setHeaderLabels({tr("Name"), tr("Kind"), tr("Date and note")});
  m_list->setRootIsDecorated(false);
  m_list->setUniformRowHeights(true);
  m_list->header()->setSectionResizeMode(Name, QHeaderView::ResizeToContents);
  m_list->header()->setSectionResizeMode(Kind, QHeaderView::ResizeToContents);
  connect(m_list, &QTreeWidget::itemSelectionChanged, this, &AttachmentsPanel::enable);

  auto* attach = button(tr("&Attach…"), "attachFile", tr("A file goes with the case"));
  auto* screenshot = button(tr("&Screenshot"), "attachScreenshot", tr("Attaches the 3D picture"));
  m_recording = button(tr("&Recording"), "attachRecording",
                       tr("Attaches the last recording of the tool (Drill > Record session…)"));
  auto* extract = button(tr("Save &file…"), "extractAttachment", tr("Writes it to a file"));
  auto* note = button(tr("&Note…"), "noteAttachment", tr("What there is to say of it"));
  auto* remove = button(tr("Re&move"), "removeAttachment", tr("Takes it out of the case"));
  m_ofOne = {extract, note, remove};
  auto* buttons = new QGridLayout;
  int place = 0;
  for (QPushButton* one : {attach, screenshot, m_recording, extract, note, remove})
  {
    buttons->addWidget(one, place / 3, place % 3);
    ++place;
  }
  connect(attach, &QPushButton::clicked, this, &AttachmentsPanel::attachAsked);
  connect(screenshot, &QPushButton::clicked, this, &AttachmentsPanel::screenshotAsked);
  connect(m_recording, &QPushButton::clicked, this, &AttachmentsPanel::recordingAsked);
  connect(extract, &QPushButton::clicked, this, [this] { emit extractAsked(chosen()); });
  connect(note, &QPushButton::clicked, this, [this] { emit noteAsked(chosen()); });
  connect(remove, &QPushButton::clicked, this, [this] { emit removalAsked(chosen()); });

  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(10, 10, 10, 10);
  layout->addWidget(m_list, 1);
  layout->addLayout(buttons);
  enable();
}

QWidget* AttachmentsPanel::mainControl()
{
  return m_list;
}

void AttachmentsPanel::caseChanged()
{
  attachmentsChanged();
}

void AttachmentsPanel::attachmentsChanged()
{
  const QString before = chosen();
  m_list->clear();
  if (m_model.hasCase())
    for (const scene::Attachment& one : m_model.value().attachments)
    {
      auto* item = new QTreeWidgetItem(m_list);
      const QString name = words(one.name);
      item->setText(Name, name);
      item->setText(Kind, one.link.empty() ? kindText(one.kind)
                                           : tr("%1, linked").arg(kindText(one.kind)));
      item->setText(Note, (words(one.date) + "  " + words(one.note).section('\n', 0, 0)).trimmed());
      QString tip = words(one.note);
      if (!one.link.empty())
        tip = (words(one.link) + "\n" + tip).trimmed();
      if (!one.object.empty() || !one.link.empty())
        if (const std::string problem = library::attachmentProblem(m_model.library(), one);
            !problem.empty())
        {
          item->setText(Kind, tr("%1, its file is %2").arg(item->text(Kind), phrase(problem)));
          item->setForeground(Kind, warningColor());
        }
      item->setToolTip(Note, tip);
      item->setToolTip(Name, name);
      if (name == before)
        m_list->setCurrentItem(item);
    }
  enable();
}

QString AttachmentsPanel::chosen() const
{
  const QTreeWidgetItem* item = m_list->currentItem();
  return item && item->isSelected() ? item->text(Name) : QString();
}

void AttachmentsPanel::enable()
{
  for (QPushButton* one : m_ofOne)
    one->setEnabled(!chosen().isEmpty());
  m_recording->setEnabled(m_model.hasCase() && !m_model.lastRecording().empty());
}

} // namespace petrous::workstation
