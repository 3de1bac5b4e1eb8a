#include "DeviceToolBar.h"

#include <algorithm>

#include <QAbstractItemView>
#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QEvent>
#include <QLabel>
#include <QMenu>
#include <QSignalBlocker>
#include <QStandardItemModel>
#include <QToolButton>

#include "Bind.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Presenters/DeviceMapping.h"

namespace petrous::workstation
{

using presenters::DeviceMapping;
using presenters::InputDevice;

namespace
{

QString titleOf(const InputDevice& input)
{
  return input.kind == InputDevice::Kind::Mouse ? DeviceToolBar::tr("Mouse") : words(input.name);
}

} // namespace

DeviceToolBar::DeviceToolBar(QWidget* parent)
  : QToolBar(tr("Device"), parent)
  , m_choice(choiceBox("deviceChoice",
                       tr("What leads the tool: the mouse, a SpaceMouse, or a device behind a "
                          "device server. What is plugged in comes up by itself.\n"
                          "X, or the device's second button, held: the hand moves alone.")))
  , m_scale(numberBox("deviceScale",
                      tr("Millimetres that the tool goes for a millimetre of the hand"),
                      {DeviceMapping::kMinScale, DeviceMapping::kMaxScale, tr(" mm/mm"), 2, 0.05}))
  , m_limit(numberBox("forceLimit", tr("The strongest force that the device may give, N"),
                      {0.0, 200.0, tr(" N"), 1, 0.1}))
  , m_here(new QAction(tr("Bring the tool &here"), this))
  , m_test(new QAction(tr("&Test the device…"), this))
  , m_connect(new QAction(tr("&Connect a device…"), this))
{
  setObjectName("deviceBar");
  setMovable(false);
  m_choice->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  m_here->setShortcut(Qt::Key_H);
  m_here->setToolTip(
      tr("Brings the tool of a device before what is in the middle of the view (H)"));

  const auto add = [this](const QString& name, QWidget* widget)
  {
    auto* label = new QLabel(name);
    label->setObjectName("dim");
    label->setContentsMargins(8, 0, 2, 0);
    label->setBuddy(widget); // its name for a screen reader
    return std::vector<QAction*>{addWidget(label), addWidget(widget)};
  };
  add(tr("Device"), m_choice);
  m_test->setToolTip(tr("Workspace, directions of the forces, and the stiffness that it bears"));
  m_connect->setToolTip(tr("Opens the manual in the browser: which devices there are, and how they "
                           "come into this list"));
  auto* more = new QToolButton;
  more->setObjectName("deviceMore");
  more->setText("…");
  more->setToolTip(tr("Connect or test a device"));
  more->setAccessibleName(more->toolTip());
  more->setPopupMode(QToolButton::InstantPopup);
  auto* menu = new QMenu(more);
  menu->setToolTipsVisible(true);
  menu->addActions({m_connect, m_test});
  more->setMenu(menu);
  m_more = addWidget(more); // both stand in the Drill menu, too
  m_scaleParts = add(tr("Scale"), m_scale);
  m_limitParts = add(tr("At most"), m_limit);
  connect(m_choice, qOverload<int>(&QComboBox::activated), this,
          [this](int row)
          {
            const InputDevice input = m_devices[static_cast<std::size_t>(row)]; // list may change
            emit chosen(input);
          });
  connect(m_scale, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          &DeviceToolBar::mappingChanged);
  connect(m_limit, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          &DeviceToolBar::mappingChanged);
  m_choice->view()->installEventFilter(this);
  showDevices({}, InputDevice().id);
  showMapping(nullptr, 1.0, 0.0);
}

bool DeviceToolBar::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Show && watched == m_choice->view())
    emit listOpened();
  return QToolBar::eventFilter(watched, event);
}

void DeviceToolBar::showDevices(const presenters::DeviceList& found, const std::string& held)
{
  const auto is = [&held](const InputDevice& input) { return input.id == held; };
  std::vector<InputDevice> devices = found.devices;
  const auto before = std::find_if(m_devices.begin(), m_devices.end(), is);
  if (std::none_of(devices.begin(), devices.end(), is) && before != m_devices.end())
    devices.push_back(*before);
  m_devices = std::move(devices);
  m_test->setEnabled(std::any_of(m_devices.begin(), m_devices.end(),
                                 [&](const InputDevice& input) {
                                   return is(input) && input.kind == InputDevice::Kind::Server &&
                                          input.advice.empty();
                                 }));

  const QSignalBlocker quiet(m_choice);
  m_choice->clear();
  for (const InputDevice& input : m_devices)
  {
    m_choice->addItem(titleOf(input));
    const int row = m_choice->count() - 1;
    if (is(input))
      m_choice->setCurrentIndex(row);
    if (input.advice.empty())
      continue;
    m_choice->setItemData(row, phrase(input.advice), Qt::ToolTipRole);
    qobject_cast<QStandardItemModel*>(m_choice->model())->item(row)->setEnabled(false);
  }
}

void DeviceToolBar::showMapping(const haptics::DeviceDescription* device, double scale,
                                double forceLimit)
{
  const QSignalBlocker quietScale(m_scale);
  const QSignalBlocker quietLimit(m_limit);
  const bool force = device && device->givesForce;
  for (QAction* part : m_scaleParts)
    part->setVisible(device != nullptr);
  for (QAction* part : m_limitParts)
    part->setVisible(force);
  m_more->setVisible(device == nullptr); // its scale and force need the room
  m_here->setEnabled(device != nullptr);
  m_scale->setValue(scale);
  if (!force)
    return;
  m_limit->setMaximum(device->maxForce);
  m_limit->setValue(forceLimit);
}

double DeviceToolBar::scale() const
{
  return m_scale->value();
}

double DeviceToolBar::forceLimit() const
{
  return m_limit->value();
}

} // namespace petrous::workstation
