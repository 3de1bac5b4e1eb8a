#include "DrillBar.h"

#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QToolButton>

namespace petrous::workstation
{

DrillBar::DrillBar(QWidget* parent)
  : QToolBar(tr("Drill"), parent)
  , m_drill(new QAction(tr("Drill"), this))
  , m_diameter(new QDoubleSpinBox)
  , m_kind(new QComboBox)
  , m_feed(new QDoubleSpinBox)
{
  setObjectName("drillBar");
  setMovable(false);
  m_drill->setCheckable(true);
  m_drill->setShortcut(Qt::Key_D);
  m_drill->setToolTip(tr("Drill mode (D): the left button, or Space, drills where the burr lies.\n"
                         "Without it a drag turns the patient."));
  addAction(m_drill);
  widgetForAction(m_drill)->setObjectName("drillButton");

  m_diameter->setRange(1.0, 7.0);
  m_diameter->setSingleStep(0.5);
  m_diameter->setDecimals(1);
  m_diameter->setValue(4.0);
  m_diameter->setSuffix(tr(" mm"));
  m_diameter->setObjectName("burrDiameter");
  m_diameter->setToolTip(tr("Diameter of the burr, mm ([ smaller, ] larger)"));
  m_kind->addItem(tr("Cutting"), static_cast<int>(dissection::Burr::Kind::Cutting));
  m_kind->addItem(tr("Diamond"), static_cast<int>(dissection::Burr::Kind::Diamond));
  m_kind->setObjectName("burrKind");
  m_kind->setToolTip(tr("Kind of the burr; it is kept with the stroke"));
  m_feed->setRange(0.0, 20.0);
  m_feed->setSingleStep(0.5);
  m_feed->setDecimals(1);
  m_feed->setValue(2.0);
  m_feed->setSuffix(tr(" mm/s"));
  m_feed->setObjectName("feedRate");
  m_feed->setToolTip(tr("How fast the burr goes into the bone while the drill is on, mm/s"));

  const auto addNamed = [this](const QString& name, QWidget* widget)
  {
    auto* label = new QLabel(name);
    label->setObjectName("dim");
    label->setContentsMargins(8, 0, 2, 0);
    addWidget(label);
    addWidget(widget);
  };
  addNamed(tr("Burr"), m_diameter);
  addWidget(m_kind);
  addNamed(tr("Feed"), m_feed);
  connect(m_diameter, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          &DrillBar::burrChanged);
}

void DrillBar::stepDiameter(int steps)
{
  m_diameter->stepBy(steps);
}

dissection::Burr DrillBar::burr() const
{
  dissection::Burr burr;
  burr.diameter = m_diameter->value();
  burr.kind = static_cast<dissection::Burr::Kind>(m_kind->currentData().toInt());
  return burr;
}

double DrillBar::feed() const
{
  return m_feed->value();
}

} // namespace petrous::workstation
