#pragma once

#include <QWidget>

class QToolButton;

namespace petrous::workstation
{

/// A collapsible section.
class FoldBox : public QWidget
{
  Q_OBJECT
public:
  /// Takes ownership of `inside`; initially collapsed. `name`: object name of the heading, for
  /// tests and style.
  FoldBox(const QString& title, const char* name, QWidget* inside, QWidget* parent = nullptr);

  QString title() const;
  bool isOpen() const;
  void setOpen(bool open);
  void setOther(FoldBox* other) { m_other = other; } ///< collapses when this one expands

private:
  QToolButton* m_heading;
  QWidget* m_inside;
  FoldBox* m_other = nullptr;
};

} // namespace petrous::workstation
