#include "DrillBar.h"

#include <cmath>
#include <initializer_list>
#include <map>
#include <string>

#include <QAction>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QToolButton>

#include "Bind.h"
#include "Commands.h"
#include "DiameterBox.h"
#include "FittedBox.h"
#include "Theme.h"
#include "petrous/Dissection/BurrName.h"

namespace petrous::workstation
{

namespace
{
constexpr int kNameWidth = 120; // px

/// Of the burrs that come with the program; other names are shown as they are.
QString titleOf(const dissection::BurrModel& burr)
{
  if (const auto usual = dissection::parseBurrKind(burr.name))
    return *usual == dissection::Burr::Kind::Diamond ? DrillBar::tr("Diamond")
                                                     : DrillBar::tr("Cutting");
  const std::map<std::string, QString> known{
      {"diamond-coarse", DrillBar::tr("Diamond, coarse")},
      {"diamond-medium", DrillBar::tr("Diamond, medium")},
      {"diamond-fine", DrillBar::tr("Diamond, fine")},
      {"diamond-extra-fine", DrillBar::tr("Diamond, extra fine")},
      {"cutting-rake-6", DrillBar::tr("Cutting, rake -6°")},
      {"cutting-rake-25", DrillBar::tr("Cutting, rake -25°")}};
  const auto found = known.find(burr.name);
  return found != known.end() ? found->second : words(burr.name);
}
} // namespace

DrillBar::DrillBar(QWidget* parent)
  : QToolBar(tr("Drill"), parent)
  , m_drill(new QAction(tr("Drill"), this))
  , m_pointer(new QAction(tr("Pointer"), this))
  , m_instrument(new QAction(tr("I&nstrument"), this))
  , m_wheel(new QAction(tr("By wheel"), this))
  , m_diameter(new DiameterBox)
  , m_kind(new FittedBox) // the longest would push a device's numbers out of a narrow window
  , m_speed(new QSpinBox)
  , m_thrust(numberBox(
        "thrust",
        tr("How hard a hand without force (mouse, SpaceMouse) presses the burr on "
           "the tissue, N: the harder, the faster it goes in.\nThe wheel changes it while the "
           "burr drills, 0.5 N a notch, with Shift a fifth of it. While Shift is held, it is "
           "twice as large"),
        {0.1, 10.0, tr(" N"), 1, 0.1}))
{
  setObjectName("drillBar");
  setMovable(false);
  m_drill->setCheckable(true);
  m_drill->setShortcut(Qt::Key_D);
  m_drill->setToolTip(
      tr("Drill mode (D): the left button, or Space, drills where the burr lies.\n"
         "Let go, it lifts by a millimetre and rests there: the handpiece has no weight, "
         "and X holds it in place.\nWithout it a drag turns the patient."));
  addAction(m_drill);
  widgetForAction(m_drill)->setObjectName("drillButton");
  m_pointer->setCheckable(true);
  m_pointer->setShortcut(Qt::Key_P);
  m_pointer->setToolTip(
      tr("Pointer (P): touches and cuts nothing; reads the image, structure and the "
         "distance to the nearest surface at its tip"));
  addAction(m_pointer);
  widgetForAction(m_pointer)->setObjectName("pointerButton");

  m_instrument->setCheckable(true);
  m_instrument->setShortcut(Qt::Key_I);
  m_instrument->setIconText(tr("Instrument"));
  m_instrumentTip =
      tr("Pick, dissector or curette from a file (I): the left button, or Space, presses it on the "
         "tissue, and it removes nothing");
  m_instrument->setToolTip(m_instrumentTip);
  auto* button = new QToolButton;
  button->setObjectName("instrumentButton");
  button->setDefaultAction(m_instrument);
  m_instrumentButton = addWidget(button);
  m_instrumentButton->setVisible(false); // a device's settings need the room

  m_diameter->setSuffix(tr(" mm"));
  m_diameter->setObjectName("burrDiameter");
  m_diameter->setToolTip(
      tr("Diameter of the burr, mm, of those that are sold (A or [ smaller, S or ] larger)"));
  m_kind->setObjectName("burrKind");
  offerBurrs();
  offerDiameters();
  m_kind->setToolTip(tr("Kind of the burr: a cutting burr takes several times as much in the same "
                        "time as a diamond one, and a fine diamond the least. More burrs: Drill > "
                        "Materials and burrs…"));
  m_speed->setRange(10, 100);
  m_speed->setSingleStep(5);
  m_speed->setValue(60);
  m_speed->setSuffix(tr(" krpm"));
  m_speed->setObjectName("spindleSpeed");
  m_speed->setToolTip(tr("Speed of the spindle, thousands of turns a minute: the faster it turns, "
                         "the faster the burr goes in"));
  m_thrust->setValue(kUsualThrust);
  m_wheel->setCheckable(true);
  m_wheel->setShortcut(Qt::Key_M);
  m_wheel->setToolTip(
      tr("The wheel moves the burr in depth, 0.25 mm a notch, with Shift a fifth of "
         "it (M); how far it is wanted in the tissue is how hard it presses, 1 N for "
         "a mm.\nWithout it the burr lies on the tissue and is pressed with the "
         "thrust. Ctrl with the wheel zooms."));

  const auto addNamed = [this](const QString& name, QWidget* widget)
  {
    auto* label = new QLabel(name);
    label->setObjectName("dim");
    label->setContentsMargins(8, 0, 2, 0);
    label->setBuddy(widget); // its name for a screen reader
    addWidget(label);
    addWidget(widget);
  };
  addNamed(tr("Burr"), m_diameter);
  m_kind->setAccessibleName(tr("Kind of the burr"));
  addWidget(m_kind);
  m_speed->setAccessibleName(tr("Speed of the spindle"));
  addWidget(m_speed);
  addNamed(tr("Thrust"), m_thrust);
  addAction(m_wheel);
  widgetForAction(m_wheel)->setObjectName("wheelButton");
  m_wanted = burr();
  connect(m_diameter, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &DrillBar::choose);
  connect(m_kind, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this]
          {
            m_wanted = burr();
            {
              const QSignalBlocker once(m_diameter);
              offerDiameters();
            }
            choose();
          });
  connect(m_speed, qOverload<int>(&QSpinBox::valueChanged), this,
          [this]
          {
            m_wanted.rpm = burr().rpm; // the burr is still the one that was wanted
            emit burrChanged();
            emit burrChosen();
          });
  connect(m_thrust, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
          &DrillBar::pressChanged);
  connect(m_wheel, &QAction::toggled, this, &DrillBar::pressChanged);
}

void DrillBar::setBurrs(const dissection::BurrCatalogue& burrs)
{
  const dissection::Burr before = burr();
  m_burrs = burrs;
  {
    const QSignalBlocker kind(m_kind);
    const QSignalBlocker diameter(m_diameter);
    offerBurrs();
    select(m_wanted);
    offerDiameters();
  }
  if (const auto now = burr(); nameOf(now) != nameOf(before) || now.diameter != before.diameter)
    emit burrChanged();
}

void DrillBar::choose()
{
  m_wanted = burr();
  emit burrChanged();
  emit burrChosen();
}

void DrillBar::offerBurrs()
{
  m_kind->clear();
  for (const dissection::BurrModel& one : m_burrs.all())
  {
    const QString kind =
        one.kind == dissection::Burr::Kind::Diamond ? tr("Diamond burr") : tr("Cutting burr");
    m_kind->addItem(titleOf(one), words(one.name));
    m_kind->setItemData(m_kind->count() - 1, kind, Qt::ToolTipRole);
  }
}

void DrillBar::select(const dissection::Burr& burr)
{
  const dissection::BurrModel* own = m_burrs.find(nameOf(burr));
  const dissection::BurrModel& model =
      own && own->kind == burr.kind ? *own : m_burrs.model(burr.kind);
  m_kind->setCurrentIndex(m_kind->findData(words(model.name)));
  m_kind->updateGeometry(); // also where its signals are blocked
}

void DrillBar::offerDiameters()
{
  m_diameter->setDiameters(m_burrs.model(burr()).diameters, m_wanted.diameter);
}

void DrillBar::stepDiameter(int steps)
{
  m_diameter->stepBy(steps);
}

void DrillBar::nextBurr()
{
  m_kind->setCurrentIndex((m_kind->currentIndex() + 1) % m_kind->count());
}

dissection::Burr DrillBar::burr() const
{
  dissection::Burr burr;
  burr.diameter = m_diameter->value();
  setModel(burr, m_burrs.model(bytes(m_kind->currentData().toString())));
  burr.rpm = 1000.0 * m_speed->value();
  return burr;
}

void DrillBar::setBurr(const dissection::Burr& burr)
{
  {
    const QSignalBlocker kind(m_kind);
    const QSignalBlocker diameter(m_diameter);
    const QSignalBlocker speed(m_speed);
    m_wanted = burr;
    select(burr);
    offerDiameters();
    m_speed->setValue(static_cast<int>(std::lround(burr.rpm / 1000.0)));
  }
  emit burrChanged();
}

void DrillBar::setInstrument(const QString& name)
{
  const QString shown =
      fontMetrics().elidedText(name, Qt::ElideMiddle, kNameWidth).replace('&', "&&");
  m_instrument->setIconText(name.isEmpty() ? tr("Instrument") : shown);
  m_instrumentButton->setVisible(!name.isEmpty());
  m_instrument->setToolTip(name.isEmpty() ? m_instrumentTip : name + '\n' + m_instrumentTip);
  for (QWidget* widget : std::initializer_list<QWidget*>{m_diameter, m_kind, m_speed})
    widget->setEnabled(name.isEmpty());
}

QString DrillBar::insteadText() const
{
  if (nameOf(burr()) == nameOf(m_wanted))
    return {};
  return tr("This library has no burr “%1”; “%2” is taken in its place (Drill > Materials and "
            "burrs…)")
      .arg(words(nameOf(m_wanted)), m_kind->currentText());
}

void DrillBar::setThrust(double newtons)
{
  m_thrust->setValue(newtons);
}

void DrillBar::setPresses(bool byWheel, bool byThrust)
{
  enable(*m_wheel, byWheel, tr("The hand on the device moves the burr in depth"));
  enable(*m_thrust, byThrust, tr("The hand on the device presses the burr itself"));
}

double DrillBar::thrust() const
{
  return m_thrust->value();
}

} // namespace petrous::workstation
