#pragma once

#include <functional>

#include <QFrame>

class QBoxLayout;
class QLabel;

namespace petrous::workstation
{

/// A line above the pictures that says what must be known, with what can be done about it. It waits
/// for nobody: the window goes on beneath it.
class Banner : public QFrame
{
  Q_OBJECT
public:
  enum class Kind
  {
    Notice,
    Warning
  };
  /// `name` is the object's. Hidden to begin with.
  Banner(const QString& name, Kind kind, QWidget* parent = nullptr);

  void setText(const QString& text);
  QString text() const;
  QString shownText() const; ///< long words without their middle; the tooltip has the whole

  /// A button at the right; `name` is the object's. What it does may hide the banner.
  void addButton(const QString& name, const QString& text, const std::function<void()>& act);
  void setButtonVisible(const QString& name, bool visible);

private:
  QLabel* m_text;
  QString m_whole;
  QBoxLayout* m_layout;
};

} // namespace petrous::workstation
