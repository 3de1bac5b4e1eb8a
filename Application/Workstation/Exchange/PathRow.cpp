#include "PathRow.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPushButton>

#include "HintedLine.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

PathRow::PathRow(const char* name, Kind kind, const QString& title, QWidget* parent)
  : QWidget(parent)
  , m_kind(kind)
  , m_title(title)
  , m_line(new HintedLine)
{
  m_line->setObjectName(name);
  m_line->setAccessibleName(title);
  auto* choose = new QPushButton(tr("Browse…"));
  choose->setAutoDefault(false);
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(m_line, 1);
  layout->addWidget(choose);
  setFocusProxy(m_line);
  connect(choose, &QPushButton::clicked, this, &PathRow::browse);
  connect(m_line, &QLineEdit::textChanged, this, &PathRow::changed);
}

QString PathRow::text() const
{
  const QString text = m_line->text().trimmed();
  return text.isEmpty() ? text : QDir::cleanPath(text);
}

std::filesystem::path PathRow::path() const
{
  return pathOf(text());
}

void PathRow::setText(const QString& text)
{
  m_line->setText(text);
}

void PathRow::setPlaceholder(const QString& text)
{
  m_line->setPlaceholderText(text);
}

void PathRow::browse()
{
  const QString start = text().isEmpty() ? QDir::homePath() : QFileInfo(text()).absolutePath();
  QString chosen;
  if (m_kind == Kind::File)
    chosen = QFileDialog::getOpenFileName(this, m_title, start);
  else if (m_kind == Kind::Folder)
    chosen = QFileDialog::getExistingDirectory(this, m_title, start);
  else
    chosen = QFileDialog::getSaveFileName(this, m_title, start, {}, nullptr,
                                          QFileDialog::DontConfirmOverwrite);
  if (!chosen.isEmpty())
    m_line->setText(chosen);
}

} // namespace petrous::workstation
