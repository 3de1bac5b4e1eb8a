#include "DeviceTestDialog.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include <QDialogButtonBox>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QStringList>
#include <QVBoxLayout>

#include "Application.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Core/Error.h"
#include "petrous/Devices/ServedDevice.h"
#include "petrous/Presenters/DeviceLimits.h"
#include "petrous/Presenters/DeviceTestRun.h"

namespace petrous::workstation
{

using devices::DeviceCheck;
using devices::ServedDevice;
using devices::ServerError;

namespace
{

constexpr int kSteps = 1000;                          // of the bar
constexpr auto kReleasedIn = std::chrono::seconds(3); // by who had the device
constexpr auto kAskAgain = std::chrono::milliseconds(100);

QString axisText(const DeviceCheck::Axis& axis, const QString& name)
{
  if (!axis.follows)
    return DeviceTestDialog::tr("%1: the handle does not follow the force. Do not use the device.")
        .arg(name);
  const QString stable = numberText(axis.stable, 2);
  if (axis.faulted)
    return DeviceTestDialog::tr("%1: stable up to %2 N/mm, a fault at %3")
        .arg(name, stable, numberText(axis.limit, 2));
  if (axis.limit > 0.0)
    return DeviceTestDialog::tr("%1: stable up to %2 N/mm, oscillates at %3")
        .arg(name, stable, numberText(axis.limit, 2));
  return DeviceTestDialog::tr("%1: stable up to %2 N/mm").arg(name, stable);
}

} // namespace

DeviceTestDialog::DeviceTestDialog(presenters::DeviceSources sources, presenters::InputDevice input,
                                   QWidget* parent, const DeviceCheck::Options& options)
  : QDialog(parent)
  , m_sources(std::move(sources))
  , m_input(std::move(input))
  , m_options(options)
  , m_advice(new QLabel)
  , m_progress(new QProgressBar)
  , m_result(new QLabel)
  , m_start(new QPushButton)
  , m_keep(new QPushButton(tr("&Keep this stiffness")))
{
  setObjectName("deviceTest");
  setWindowTitle(tr("Test of %1").arg(words(m_input.name)));
  auto* about = new QLabel(
      tr("This takes about a minute. First move the handle through all of its workspace and press "
         "its buttons. Then hold it lightly in the middle and keep it still: it is pushed along "
         "each axis, with 0.5 N, and held by a spring that becomes stiffer."));
  for (QLabel* label : {about, m_advice, m_result})
    wrapWords(*label);
  m_advice->setObjectName("deviceTestAdvice");
  m_result->setObjectName("deviceTestResult");
  m_result->setTextInteractionFlags(Qt::TextSelectableByMouse);
  m_progress->setObjectName("deviceTestProgress");
  m_progress->setRange(0, kSteps);
  m_start->setObjectName("deviceTestStart");
  m_keep->setObjectName("deviceTestKeep");
  m_keep->setToolTip(tr("Bone is then rendered with at most that stiffness on this device"));
  m_keep->setEnabled(false);

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  buttons->addButton(m_start, QDialogButtonBox::ActionRole);
  buttons->addButton(m_keep, QDialogButtonBox::ActionRole);
  auto* layout = new QVBoxLayout(this);
  for (QWidget* widget : std::initializer_list<QWidget*>{about, m_advice, m_progress, m_result})
    layout->addWidget(widget);
  layout->addStretch();
  layout->addWidget(buttons);
  resize(520, 380);

  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(m_start, &QPushButton::clicked, this, &DeviceTestDialog::startOrStop);
  connect(m_keep, &QPushButton::clicked, this, &DeviceTestDialog::keep);
  connect(&m_work, &BackgroundWork::progressed, this,
          [this](double fraction, const QString& text, const QString& left)
          {
            m_progress->setFormat(withTimeLeft("%p%", left));
            m_progress->setValue(static_cast<int>(kSteps * fraction));
            m_advice->setText(sentence(text));
          });
  connect(&m_work, &BackgroundWork::failed, this,
          [this](const QString& why) { say(sentence(why)); });
  connect(&m_work, &BackgroundWork::cancelled, this, [this] { say(tr("Stopped")); });
  say({});
}

DeviceTestDialog::~DeviceTestDialog()
{
  m_work.drop();
}

void DeviceTestDialog::say(const QString& text)
{
  m_result->setText(text);
  m_start->setText(m_work.busy() ? tr("&Stop") : tr("S&tart"));
  if (!m_work.busy())
  {
    m_advice->clear();
    m_progress->reset();
  }
}

void DeviceTestDialog::startOrStop()
{
  if (m_work.busy())
    return m_work.cancel();
  m_keep->setEnabled(false);
  m_proposed = 0.0;
  m_work.start([this](const core::Progress& progress) -> BackgroundWork::Reply
               { return [this, outcome = test(progress)] { showOutcome(outcome); }; });
  say({});
}

DeviceTestDialog::Outcome DeviceTestDialog::test(const core::Progress& progress) const
{
  ServedDevice::Options server;
  server.name = m_input.name;
  server.command = {m_input.program.string()};
  server.wanted = [&progress]
  {
    progress.check("device test");
    return true;
  };
  server.waits = [&progress](const std::string& text) { progress.report(0.0, text); };
  const auto end = std::chrono::steady_clock::now() + kReleasedIn;
  std::unique_ptr<ServedDevice> device;
  while (!device)
    try
    {
      device = std::make_unique<ServedDevice>(server);
    }
    catch (const ServerError& error)
    {
      if (error.reason() != ServerError::Reason::InUse || std::chrono::steady_clock::now() > end)
        throw;
      std::this_thread::sleep_for(kAskAgain);
    }
  Outcome outcome;
  outcome.description = device->description();
  outcome.result = presenters::testDevice(
      *device, m_options,
      [&progress](const DeviceCheck& check)
      { progress.report(check.progress(), presenters::deviceTestAdvice(check)); });
  return outcome;
}

void DeviceTestDialog::showOutcome(const Outcome& outcome)
{
  const DeviceCheck::Result& result = outcome.result;
  const haptics::DeviceDescription& description = outcome.description;
  m_device = description.name;
  QStringList lines;
  const Eigen::Vector3d size = result.highest - result.lowest;
  lines << tr("Workspace %1 × %2 × %3 mm, %4 readings/s")
               .arg(numberText(size.x(), 0), numberText(size.y(), 0), numberText(size.z(), 0),
                    numberText(result.rate, 0));
  if (result.faults > 0)
    lines << (result.faults == 1 ? tr("The device reported a fault once")
                                 : tr("The device reported a fault %1 times").arg(result.faults));
  if (!result.problem.empty())
    lines << sentence(phrase(result.problem));
  else if (!description.givesForce)
    lines << tr("It gives no force.");
  else
  {
    const QString axes[] = {tr("Right"), tr("Up"), tr("To the user")};
    for (std::size_t i = 0; i < 3; ++i)
      lines << axisText(result.axes[i], axes[i]);
    m_proposed = presenters::boundedStiffness(result.proposed, description.maxStiffness);
    lines << (m_proposed > 0.0 ? tr("Proposed: %1 N/mm").arg(numberText(m_proposed, 2))
                               : tr("No stiffness is proposed."));
  }
  say(lines.join('\n'));
  m_progress->setValue(kSteps);
  m_keep->setEnabled(m_proposed > 0.0 && !m_sources.limits.empty());
}

void DeviceTestDialog::keep()
{
  m_keep->setEnabled(false);
  try
  {
    presenters::keepStiffness(m_sources.limits, m_input.name, m_device, m_proposed);
    say(m_result->text() + '\n' + tr("Kept for this device"));
  }
  catch (const core::Error& error)
  {
    say(m_result->text() + '\n' + sentence(toString(error)));
  }
}

} // namespace petrous::workstation
