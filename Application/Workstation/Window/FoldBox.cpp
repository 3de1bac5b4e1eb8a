#include "FoldBox.h"

#include <QToolButton>
#include <QVBoxLayout>

namespace petrous::workstation
{

FoldBox::FoldBox(const QString& title, const char* name, QWidget* inside, QWidget* parent)
  : QWidget(parent)
  , m_heading(new QToolButton)
  , m_inside(inside)
{
  m_heading->setObjectName(name);
  m_heading->setText(title);
  m_heading->setToolTip(tr("Shows or hides what belongs to it"));
  m_heading->setCheckable(true);
  m_heading->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  m_heading->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  m_heading->setStyleSheet("QToolButton { border: none; background: none; font-weight: bold; "
                           "text-align: left; padding: 5px 0; }");
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(4);
  layout->addWidget(m_heading);
  layout->addWidget(m_inside);
  connect(m_heading, &QToolButton::toggled, this,
          [this](bool open)
          {
            m_heading->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
            m_inside->setVisible(open);
            if (open && m_other)
              m_other->setOpen(false);
          });
  m_heading->setArrowType(Qt::RightArrow);
  m_inside->hide();
}

QString FoldBox::title() const
{
  return m_heading->text();
}

bool FoldBox::isOpen() const
{
  return m_heading->isChecked();
}

void FoldBox::setOpen(bool open)
{
  m_heading->setChecked(open);
}

} // namespace petrous::workstation
