#pragma once

#include <functional>

#include <QFrame>
#include <QWidget>

class QBoxLayout;
class QLabel;
class QScrollArea;
class QVBoxLayout;

namespace petrous::workstation
{

class Banner;

/// Banners above the views. They have space reserved in the layout; while a tool is in use that
/// space is fixed, and new banners overlay the views: otherwise a view would move under a resting
/// pointer. They scroll where they are higher than a share of that widget, or would make it higher.
class BannerStack : public QWidget
{
  Q_OBJECT
public:
  /// `over`: the widget at whose upper edge it is placed.
  explicit BannerStack(QWidget& over);

  void add(Banner* banner);
  QWidget* room() const { return m_room; } ///< for the layout of `over`, above the views
  void setHeld(bool held);                 ///< a tool is in use

signals:
  void covers(int pixels); ///< height of the views covered, from the top; emitted on each resize

protected:
  bool event(QEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void place();
  int heightFor(int across) const; // of all banners, pixels
  int most() const;

  QScrollArea* m_scroll;
  QWidget* m_inside;
  QVBoxLayout* m_layout;
  QWidget* m_room;
  bool m_held = false;
};

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
  /// `shown`: what of it is shown where that is less, as of many lines; the tooltip has all.
  void setText(const QString& text, const QString& shown);
  QString text() const;
  QString shownText() const; ///< long words elided in the middle; the tooltip has the full text

  /// Adds a button at the right; `name` is the object name. `act` may hide the banner.
  void addButton(const QString& name, const QString& text, const std::function<void()>& act);
  void setButtonVisible(const QString& name, bool visible);

signals:
  void dismissed(); ///< by a button that had the keyboard focus

private:
  QLabel* m_text;
  QString m_whole;
  QBoxLayout* m_layout;
};

} // namespace petrous::workstation
