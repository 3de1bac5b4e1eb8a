#pragma once

#include <QWidget>

class QToolButton;

namespace petrous::workstation
{

/// A heading that shows or hides what is below it.
class FoldBox : public QWidget
{
  Q_OBJECT
public:
  /// Takes `inside`; folded to begin with. `name`: of the heading, for tests and style.
  FoldBox(const QString& title, const char* name, QWidget* inside, QWidget* parent = nullptr);

  bool isOpen() const;
  void setOpen(bool open);
  void setOther(FoldBox* other) { m_other = other; } ///< which folds when this one opens

private:
  QToolButton* m_heading;
  QWidget* m_inside;
  FoldBox* m_other = nullptr;
};

} // namespace petrous::workstation
