#pragma once

#include <functional>

#include <QFrame>

class QBoxLayout;
class QLabel;

namespace petrous::workstation
{

/// A non-modal message above the views, with buttons for what can be done about it.
class Banner : public QFrame
{
  Q_OBJECT
public:
  enum class Kind
  {
    Notice,
    Warning
  };
  /// `name` is the object name. Initially hidden.
  Banner(const QString& name, Kind kind, QWidget* parent = nullptr);

  void setText(const QString& text);
  QString text() const;
  QString shownText() const; ///< long words elided in the middle; the tooltip has the full text

  /// Adds a button at the right; `name` is the object name. `act` may hide the banner.
  void addButton(const QString& name, const QString& text, const std::function<void()>& act);
  void setButtonVisible(const QString& name, bool visible);

private:
  QLabel* m_text;
  QString m_whole;
  QBoxLayout* m_layout;
};

} // namespace petrous::workstation
