#include "HandlesBox.h"

#include <QComboBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>

#include "Application.h"
#include "PanelLayout.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

HandlesBox::HandlesBox(presenters::RegistrationSession& session, QWidget* parent)
  : QWidget(parent)
  , m_session(session)
  , m_step(new QComboBox)
  , m_moved(new QLabel)
{
  m_step->setObjectName("nudgeStep");
  m_step->setAccessibleName(tr("Step"));
  m_step->addItem(tr("0.1 mm, 0.1°"), 0.1);
  m_step->addItem(tr("1 mm, 1°"), 1.0);
  m_step->setToolTip(
      tr("What a press of a button below moves or turns the MR. In a slice: Alt+arrow "
         "moves it in the slice, Alt+Page up and down turn it; with Shift by the "
         "larger step"));
  m_moved->setObjectName("dim");
  wrapWords(*m_moved);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(4);
  grid->addWidget(new QLabel(tr("Step")), 0, 0);
  grid->addWidget(m_step, 0, 1, 1, 3);
  // The MR overlay moves in the button's direction.
  addHandle(*grid, 1, 0,
            {"◀ R", "L ▶", tr("Moves the MR to the patient's right"),
             tr("Moves the MR to the patient's left"), Eigen::Vector3d::UnitX(), false});
  addHandle(*grid, 2, 0,
            {"A", "P", tr("Moves the MR to the front"), tr("Moves the MR to the back"),
             Eigen::Vector3d::UnitY(), false});
  addHandle(*grid, 3, 0,
            {"I ▼", "▲ S", tr("Moves the MR towards the feet"), tr("Moves the MR towards the head"),
             Eigen::Vector3d::UnitZ(), false});
  addHandle(*grid, 1, 2,
            {"↺ pitch", "pitch ↻",
             tr("Turns the MR about the crosshair, against the clock for who looks to the left"),
             tr("Turns the MR about the crosshair, with the clock for who looks to the left"),
             Eigen::Vector3d::UnitX(), true});
  addHandle(*grid, 2, 2,
            {"↺ roll", "roll ↻",
             tr("Turns the MR about the crosshair, against the clock for who looks to the back"),
             tr("Turns the MR about the crosshair, with the clock for who looks to the back"),
             Eigen::Vector3d::UnitY(), true});
  addHandle(*grid, 3, 2,
            {"↺ yaw", "yaw ↻",
             tr("Turns the MR about the crosshair, against the clock for who looks to the head"),
             tr("Turns the MR about the crosshair, with the clock for who looks to the head"),
             Eigen::Vector3d::UnitZ(), true});
  auto* here = new QPushButton(tr("Middle to the crosshair"));
  here->setObjectName("bringMiddle");
  here->setToolTip(tr("The MR's middle goes to the crosshair: for images that lie far apart"));
  connect(here, &QPushButton::clicked, this,
          [this] { attempt([this] { m_session.bringMiddleHere(); }); });
  grid->addWidget(here, 4, 0, 1, 2);
  grid->addWidget(m_moved, 4, 2, 1, 2);
}

void HandlesBox::addHandle(QGridLayout& grid, int row, int column, const Handle& handle)
{
  const auto button = [&](const char* text, const QString& tip, int at, double sign)
  {
    auto* result = new QPushButton(QString::fromUtf8(text));
    result->setAutoRepeat(true);
    result->setObjectName(QString("handle%1%2").arg(row).arg(at));
    result->setToolTip(tip);
    result->setAccessibleName(tip);
    connect(result, &QPushButton::clicked, this, [this, handle, sign] { apply(handle, sign); });
    grid.addWidget(result, row, at);
  };
  button(handle.less, handle.lessTip, column, -1.0);
  button(handle.more, handle.moreTip, column + 1, 1.0);
}

void HandlesBox::apply(const Handle& handle, double sign)
{
  const double step = sign * m_step->currentData().toDouble();
  attempt(
      [&]
      {
        handle.turns ? m_session.turn(handle.direction, step)
                     : m_session.shift(step * handle.direction);
      });
}

void HandlesBox::attempt(const std::function<void()>& move)
{
  QString why;
  guarded(move, [&why](const QString& fault) { why = fault; });
  emit attempted(why);
}

void HandlesBox::refresh()
{
  const auto moved = m_session.movedByHand();
  m_moved->setText(moved.shift > 1e-6 || moved.turn > 1e-6
                       ? tr("By hand: %1 mm at the crosshair, %2°")
                             .arg(numberText(moved.shift, 1))
                             .arg(numberText(moved.turn, 1))
                       : tr("Not moved by hand"));
}

} // namespace petrous::workstation
