#pragma once

#include <QWidget>

class QVBoxLayout;

namespace petrous::workstation
{

class Banner;

/// Banners above the pictures. They have room of their own there; while a tool is in the hand that
/// room stays as it is, and what comes then lies over the pictures: a picture that is pushed down
/// would slip under a pointer that rests.
class BannerStack : public QWidget
{
  Q_OBJECT
public:
  /// `over`: at whose upper edge it lies.
  explicit BannerStack(QWidget& over);

  void add(Banner* banner);
  QWidget* room() const { return m_room; } ///< for the layout of `over`, above the pictures
  void setHeld(bool held);                 ///< a tool is in the hand

signals:
  void covers(int pixels); ///< of the pictures, from above; at each change of sizes

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
