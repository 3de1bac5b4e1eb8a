#pragma once

#include <QWidget>

class QVBoxLayout;

namespace petrous::workstation
{

class Banner;

/// Banners above the views. They have space reserved in the layout; while a tool is in use that
/// space is fixed, and new banners overlay the views: otherwise a view would move under a resting
/// pointer.
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

  QVBoxLayout* m_layout;
  QWidget* m_room;
  bool m_held = false;
};

} // namespace petrous::workstation
