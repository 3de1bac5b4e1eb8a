#include "RegistrationTargetBox.h"

#include <algorithm>

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QSpinBox>

#include "Theme.h"
#include "WindowTexts.h"

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
}

void RegistrationTargetBox::addChoice(const QString& label, QComboBox* box)
{
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(12);
  m_form->addRow(label, box);
}

void RegistrationTargetBox::addOnto()
{
  m_onto = choiceBox("registrationOnto", {});
  addChoice(tr("Fits t&o"), m_onto);
  m_bound.add(
      m_onto, [this] { return std::max(0, m_onto->findData(words(m_session.aim().onto))); },
      [this](int row)
      { choose([&](Aim& aim) { aim.onto = bytes(m_onto->itemData(row).toString()); }); });
}

void RegistrationTargetBox::addStart()
{
  m_start = choiceBox("registrationStart",
                      tr("Register looks around this place, 40 mm and 40° far; images of one frame "
                         "of reference begin where that puts them"));
  m_start->addItem(tr("as the files say"));
  m_start->addItem(tr("middle on middle"));
  m_start->addItem(tr("where the MR lies now"));
  addChoice(tr("S&tart"), m_start);
  m_bound.add(
      m_start, [this] { return static_cast<int>(m_session.aim().start); },
      [this](int row) { choose([row](Aim& aim) { aim.start = static_cast<Aim::Start>(row); }); });
}

void RegistrationTargetBox::addBox()
{
  auto* box = m_box = new QSpinBox;
  box->setObjectName("registrationBox");
  box->setRange(kWhole, kLargestBox);
  box->setSingleStep(10);
  box->setSuffix(tr(" mm about the crosshair"));
  m_form->addRow(tr("Re&gion"), box);
  m_bound.add(
      box,
      [this] { return m_session.aim().box > 0.0 ? static_cast<int>(m_session.aim().box) : kWhole; },
      [this](int mm) { choose([mm](Aim& aim) { aim.box = mm > kWhole ? mm : 0.0; }); });
}

void RegistrationTargetBox::addPlace()
{
  m_place = choiceBox("registrationPlace",
                      tr("Where the error is stated. The middle ear: an ossicle, or else the "
                         "tympanic cavity or the inner ear; without these the centre of what both "
                         "images show"));
  m_place->setMaxVisibleItems(12);
  m_place->setStyleSheet("QComboBox { combobox-popup: 0; }"); // else some styles show all of them
  addChoice(tr("Error &at"), m_place);
  m_placeNote = new QLabel;
  m_placeNote->setObjectName("registrationPlaceNote");
  m_placeNote->setWordWrap(true);
  m_placeNote->setTextFormat(Qt::PlainText);
  m_placeNote->setStyleSheet(kWarningStyle);
  m_form->addRow(m_placeNote);
  m_bound.add(
      m_place,
      [this]
      {
        const Aim& aim = m_session.aim();
        return aim.place == Aim::Place::Structure ? m_place->findData(words(aim.structure))
                                                  : static_cast<int>(aim.place);
      },
      [this](int row)
      {
        choose(
            [&](Aim& aim)
            {
              const bool structure = row >= kFirstStructure;
              aim.place = structure ? Aim::Place::Structure : static_cast<Aim::Place>(row);
              aim.structure = structure ? bytes(m_place->itemData(row).toString()) : std::string();
            });
      });
}

void RegistrationTargetBox::fillPlaces()
{
  QStringList names;
  for (const std::string& name : m_session.placeNames())
    names << words(name);
  std::sort(names.begin(), names.end(),
            [](const QString& a, const QString& b)
            { return QString::localeAwareCompare(shownName(bytes(a)), shownName(bytes(b))) < 0; });
  QStringList shown;
  for (int n = kFirstStructure; n < m_place->count(); ++n)
    shown << m_place->itemData(n).toString();
  if (names == shown && m_place->count() >= kFirstStructure)
    return;
  m_place->clear();
  m_place->addItem(tr("the middle ear"));
  m_place->addItem(tr("the crosshair"));
  for (const QString& name : names)
    m_place->addItem(shownName(bytes(name)), name);
}

void RegistrationTargetBox::refresh()
{
  m_session.setAim(m_session.aim());
  const QString primary = words(m_session.primary());
  m_onto->setToolTip(
      tr("A diffusion image finds more to hold on to in the T2 of the same session, and comes to "
         "the %1 through that, once it is registered itself")
          .arg(primary));
  m_box->setToolTip(tr("What of the %1 counts: all of it, or a box of this edge about the "
                       "crosshair, as for one ear where the jaw or neck has moved")
                        .arg(primary));
  m_bound.quietly(
      [&]
      {
        m_box->setSpecialValueText(tr("the whole %1").arg(primary));
        m_onto->clear();
        m_onto->addItem(tr("the %1").arg(primary));
        for (const std::string& name : m_session.ontoNames())
          m_onto->addItem(words(name), words(name));
        fillPlaces();
      });
  const bool choice = m_onto->count() > 1;
  m_onto->setVisible(choice);
  m_form->labelForField(m_onto)->setVisible(choice);
  showPlaceNote();
  m_bound.refresh();
}

void RegistrationTargetBox::showPlaceNote()
{
  const QString note = sentence(capitalized(phrase(m_session.placeNote())));
  m_placeNote->setText(note);
  m_placeNote->setVisible(!note.isEmpty());
}

void RegistrationTargetBox::choose(const std::function<void(Aim&)>& change)
{
  Aim aim = m_session.aim();
  change(aim);
  m_session.setAim(aim);
  showPlaceNote();
  emit chosen();
}

} // namespace petrous::workstation
