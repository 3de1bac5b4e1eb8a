#include "ColorChooser.h"

#include <algorithm>

#include <QColorDialog>
#include <QGridLayout>
#include <QGuiApplication>
#include <QKeyEvent>
#include <QPixmap>
#include <QPushButton>
#include <QScreen>
#include <QToolButton>
#include <QVBoxLayout>

#include "Bind.h"
#include "Theme.h"
#include "petrous/Appearance/StructurePresets.h"

namespace petrous::workstation
{

namespace
{
constexpr int kColumns = 8;
constexpr int kCell = 20;  // px
constexpr int kRest = 250; // ms before a colour under the pointer is previewed, or is no more
} // namespace

ColorChooser::ColorChooser(const QColor& present, QWidget* parent)
  : QFrame(parent, Qt::Popup)
  , m_present(present)
  , m_grid(new QGridLayout)
  , m_rest(this)
{
  setObjectName("colorChooser");
  setAttribute(Qt::WA_DeleteOnClose);
  setFrameShape(QFrame::StyledPanel);
  setAccessibleName(tr("Colours"));
  m_grid->setSpacing(2);
  const auto presets = appearance::StructurePresets::builtIn();
  for (const auto& look : presets.all())
    add(QColor::fromRgbF(double(look.color[0]), double(look.color[1]), double(look.color[2])),
        words(look.preset));
  while (m_buttons.size() % kColumns != 0)
  {
    const int grey = 255 - 255 * static_cast<int>(m_buttons.size() % kColumns) / kColumns;
    add(QColor(grey, grey, grey), {});
  }
  for (const auto& [saturation, value] : {std::pair(110, 255), {200, 240}, {255, 170}})
    for (int hue = 0; hue < kColumns; ++hue)
      add(QColor::fromHsv(360 * hue / kColumns, saturation, value), {});
  auto* more = button(tr("More colours…"), "moreColors", tr("Any colour, also by its numbers"));
  more->installEventFilter(this);
  connect(more, &QPushButton::clicked, this, &ColorChooser::askMore);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 6, 6);
  layout->addLayout(m_grid);
  layout->addWidget(more);
  m_rest.setSingleShot(true);
  m_rest.setInterval(kRest);
  connect(&m_rest, &QTimer::timeout, this, [this] { preview(m_wanted); });
}

void ColorChooser::add(const QColor& color, const QString& name)
{
  auto* cell = new QToolButton;
  cell->setIcon(swatch(color, kCell));
  cell->setIconSize({kCell, kCell});
  cell->setStyleSheet("QToolButton { padding: 1px; }");
  cell->setToolTip(name.isEmpty() ? color.name() : name);
  cell->setAccessibleName(name.isEmpty() ? color.name() : name + ' ' + color.name());
  cell->setProperty("color", color);
  cell->setMouseTracking(true);
  cell->installEventFilter(this);
  connect(cell, &QToolButton::clicked, this, [this, color] { finish(color); });
  const int n = static_cast<int>(m_buttons.size());
  m_grid->addWidget(cell, n / kColumns, n % kColumns);
  m_buttons.push_back(cell);
}

void ColorChooser::open(const QPoint& global)
{
  adjustSize();
  QRect place(global, sizeHint());
  if (const QScreen* screen = QGuiApplication::screenAt(global))
  {
    const QRect room = screen->availableGeometry();
    place.moveRight(std::min(place.right(), room.right()));
    place.moveBottom(std::min(place.bottom(), room.bottom()));
  }
  move(place.topLeft());
  show();
  m_buttons.front()->setFocus(Qt::PopupFocusReason);
}

void ColorChooser::preview(const QColor& color)
{
  if (!m_isFinished && color != m_tried)
    emit previewed(m_tried = color);
}

void ColorChooser::finish(const QColor& color)
{
  if (m_isFinished)
    return;
  m_isFinished = true;
  m_rest.stop();
  if (color.isValid())
    emit chosen(color);
  else
    emit cancelled();
  close();
}

bool ColorChooser::eventFilter(QObject* watched, QEvent* event)
{
  const QColor color = watched->property("color").value<QColor>();
  // Not Enter: the pop-up opens beneath the pointer.
  if (event->type() == QEvent::MouseMove)
  {
    m_wanted = color;
    m_rest.start();
  }
  else if (event->type() == QEvent::Leave)
  {
    m_wanted = m_focused;
    m_rest.start(); // it may go on to another colour
  }
  else if (event->type() == QEvent::FocusIn &&
           static_cast<QFocusEvent*>(event)->reason() != Qt::PopupFocusReason)
  {
    m_rest.stop();
    preview(m_focused = color);
  }
  else if (event->type() == QEvent::KeyPress && color.isValid())
    switch (static_cast<QKeyEvent*>(event)->key())
    {
    case Qt::Key_Left:
      moveFocus(-1);
      return true;
    case Qt::Key_Right:
      moveFocus(1);
      return true;
    case Qt::Key_Up:
      moveFocus(-kColumns);
      return true;
    case Qt::Key_Down:
      moveFocus(kColumns);
      return true;
    case Qt::Key_Return:
    case Qt::Key_Enter:
      finish(color);
      return true;
    default:
      break;
    }
  return QFrame::eventFilter(watched, event);
}

void ColorChooser::moveFocus(int by)
{
  const auto found = std::find(m_buttons.begin(), m_buttons.end(), focusWidget());
  const auto next = (found - m_buttons.begin()) + by;
  if (next >= 0 && next < static_cast<std::ptrdiff_t>(m_buttons.size()))
    m_buttons[static_cast<std::size_t>(next)]->setFocus(Qt::OtherFocusReason);
}

void ColorChooser::keyPressEvent(QKeyEvent* event)
{
  if (event->key() == Qt::Key_Escape)
    return finish({});
  QFrame::keyPressEvent(event);
}

// Also where the user clicks beside it.
void ColorChooser::closeEvent(QCloseEvent* event)
{
  if (!m_asks)
    finish({});
  QFrame::closeEvent(event);
}

void ColorChooser::askMore()
{
  m_asks = true;
  m_rest.stop();
  preview({}); // the dialog begins with the present one
  setAttribute(Qt::WA_DeleteOnClose, false);
  hide();
  auto* dialog = new QColorDialog(m_present, parentWidget());
  dialog->setObjectName("colorDialog");
  dialog->setOption(QColorDialog::DontUseNativeDialog);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QColorDialog::currentColorChanged, this, &ColorChooser::preview);
  connect(dialog, &QDialog::finished, this,
          [this, dialog](int result)
          {
            finish(result == QDialog::Accepted ? dialog->currentColor() : QColor());
            deleteLater();
          });
  dialog->open();
}

} // namespace petrous::workstation
