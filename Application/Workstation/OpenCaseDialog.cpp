#include "OpenCaseDialog.h"

#include <QDateTime>
#include <QDialogButtonBox>
#include <QHeaderView>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "Theme.h"

namespace petrous::workstation
{

OpenCaseDialog::OpenCaseDialog(const library::Library& library, QWidget* parent)
  : QDialog(parent)
  , m_list(new QTreeWidget)
{
  setWindowTitle(tr("Open case"));
  resize(680, 380);
  m_list->setRootIsDecorated(false);
  m_list->setHeaderLabels({tr("Case"), tr("Changed"), tr("Voxels"), tr("Structures"), tr("Strokes"),
                           tr("Removed mm³")});
  for (const auto& summary : library.list())
  {
    auto* item = new QTreeWidgetItem(m_list);
    item->setText(0, words(summary.name));
    const auto changed = QDateTime::fromString(words(summary.modified), Qt::ISODate).toLocalTime();
    item->setText(1, changed.toString("yyyy-MM-dd HH:mm"));
    if (summary.damaged)
    {
      item->setText(2, tr("damaged"));
      item->setDisabled(true);
      continue;
    }
    item->setText(
        2, QString("%1 × %2 × %3").arg(summary.dims[0]).arg(summary.dims[1]).arg(summary.dims[2]));
    item->setText(3, QString::number(summary.structures));
    item->setText(4, QString::number(summary.strokes));
    item->setText(5, QString::number(summary.removed, 'f', 1));
    for (int column = 2; column < 6; ++column)
      item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  }
  m_list->sortItems(1, Qt::DescendingOrder);
  m_list->setCurrentItem(m_list->topLevelItem(0));
  m_list->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  m_list->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  m_list->header()->setStretchLastSection(false);

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(m_list, &QTreeWidget::itemActivated, this, &QDialog::accept);
  const auto update = [this, buttons]
  { buttons->button(QDialogButtonBox::Open)->setEnabled(!chosen().empty()); };
  connect(m_list, &QTreeWidget::currentItemChanged, this, update);
  update();
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(m_list);
  layout->addWidget(buttons);
}

std::string OpenCaseDialog::chosen() const
{
  const QTreeWidgetItem* item = m_list->currentItem();
  return item && !item->isDisabled() ? bytes(item->text(0)) : std::string();
}

} // namespace petrous::workstation
