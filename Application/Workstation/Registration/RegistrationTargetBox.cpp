#include "RegistrationTargetBox.h"

#include <algorithm>

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QScopedValueRollback>
#include <QSpinBox>

#include "Theme.h"

namespace petrous::workstation
{

namespace
{
using Aim = presenters::RegistrationAim;

constexpr int kWhole = 10; // mm; shown as text
constexpr int kLargestBox = 250;
constexpr int kFirstStructure = 2; // row of m_place
} // namespace

RegistrationTargetBox::RegistrationTargetBox(presenters::RegistrationSession& session,
                                             QWidget* parent)
  : QWidget(parent)
  , m_session(session)
  , m_form(new QFormLayout(this))
{
  m_form->setContentsMargins(0, 0, 0, 0);
  m_form->setVerticalSpacing(4);
  addOnto();
  addStart();
  addBox();
  addPlace();
  m_showing = false;
}

QComboBox* RegistrationTargetBox::addChoice(const QString& label, const char* name,
                                            const QString& tip)
{
  auto* box = new QComboBox;
  box->setObjectName(name);
  box->setToolTip(tip);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(12);
  m_form->addRow(label, box);
  connect(box, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &RegistrationTargetBox::choose);
  return box;
}

void RegistrationTargetBox::addOnto()
{
  m_onto = addChoice(tr("Fits t&o"), "registrationOnto",
                     tr("A diffusion image finds more to hold on to in the T2 of the same session, "
                        "and comes to the CT through that, once it is registered itself"));
}

void RegistrationTargetBox::addStart()
{
  m_start = addChoice(tr("S&tart"), "registrationStart",
                      tr("Register looks around this place, 40 mm and 40° far; images of one frame "
                         "of reference begin where that puts them"));
  m_start->addItem(tr("as the files say"));
  m_start->addItem(tr("middle on middle"));
  m_start->addItem(tr("where the MR lies now"));
}

void RegistrationTargetBox::addBox()
{
  m_box = new QSpinBox;
  m_box->setObjectName("registrationBox");
  m_box->setRange(kWhole, kLargestBox);
  m_box->setSingleStep(10);
  m_box->setSuffix(tr(" mm about the crosshair"));
  m_box->setSpecialValueText(tr("the whole CT"));
  m_box->setToolTip(tr("What of the CT counts: all of it, or a box of this edge about the "
                       "crosshair, as for one ear where the jaw or neck has moved"));
  m_form->addRow(tr("Re&gion"), m_box);
  connect(m_box, qOverload<int>(&QSpinBox::valueChanged), this, &RegistrationTargetBox::choose);
}

void RegistrationTargetBox::addPlace()
{
  m_place = addChoice(tr("Error &at"), "registrationPlace",
                      tr("Where the error is stated. The middle ear: an ossicle, or else the "
                         "tympanic cavity or the inner ear; without these the centre of what both "
                         "images show"));
}

void RegistrationTargetBox::fillPlaces()
{
  QStringList names;
  for (const std::string& name : m_session.placeNames())
    names << words(name);
  QStringList shown;
  for (int n = kFirstStructure; n < m_place->count(); ++n)
    shown << m_place->itemData(n).toString();
  if (names == shown && m_place->count() >= kFirstStructure)
    return;
  m_place->clear();
  m_place->addItem(tr("the middle ear"));
  m_place->addItem(tr("the crosshair"));
  for (const QString& name : names)
    m_place->addItem(QString(name).replace('_', ' '), name);
}

void RegistrationTargetBox::refresh()
{
  const QScopedValueRollback<bool> showing(m_showing, true);
  m_session.setAim(m_session.aim());
  const Aim& aim = m_session.aim();
  m_onto->clear();
  m_onto->addItem(tr("the CT"));
  for (const std::string& name : m_session.ontoNames())
    m_onto->addItem(words(name), words(name));
  m_onto->setCurrentIndex(std::max(0, m_onto->findData(words(aim.onto))));
  const bool choice = m_onto->count() > 1;
  m_onto->setVisible(choice);
  m_form->labelForField(m_onto)->setVisible(choice);
  m_start->setCurrentIndex(static_cast<int>(aim.start));
  m_box->setValue(aim.box > 0.0 ? static_cast<int>(aim.box) : kWhole);
  fillPlaces();
  m_place->setCurrentIndex(aim.place == Aim::Place::Structure
                               ? m_place->findData(words(aim.structure))
                               : static_cast<int>(aim.place));
}

void RegistrationTargetBox::choose()
{
  if (m_showing)
    return;
  Aim aim;
  aim.onto = bytes(m_onto->currentData().toString());
  aim.start = static_cast<Aim::Start>(m_start->currentIndex());
  aim.box = m_box->value() > kWhole ? m_box->value() : 0.0;
  if (m_place->currentIndex() >= kFirstStructure)
  {
    aim.place = Aim::Place::Structure;
    aim.structure = bytes(m_place->currentData().toString());
  }
  else
    aim.place = static_cast<Aim::Place>(m_place->currentIndex());
  m_session.setAim(aim);
  emit chosen();
}

} // namespace petrous::workstation
