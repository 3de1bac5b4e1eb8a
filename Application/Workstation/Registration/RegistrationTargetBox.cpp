#include "RegistrationTargetBox.h"

#include <algorithm>

#include <QAbstractItemView>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QScrollBar>
#include <QSpinBox>
#include <QStyleOptionComboBox>
#include <QStylePainter>

#include "PanelLayout.h"
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
constexpr int kWidestList = 600;   // px

// Of names, which often differ at their ends: what has no room is elided in its middle.
class NameBox : public QComboBox
{
public:
  using QComboBox::QComboBox;

  void showPopup() override
  {
    constexpr int kBeside = 16; // px, margins and frame
    view()->setTextElideMode(Qt::ElideMiddle);
    int wanted = 0;
    for (int row = 0; row < count(); ++row)
      wanted = std::max(wanted, view()->fontMetrics().horizontalAdvance(itemText(row)));
    wanted += kBeside + view()->verticalScrollBar()->sizeHint().width();
    view()->setMinimumWidth(std::min(wanted, kWidestList));
    QComboBox::showPopup();
  }

protected:
  void paintEvent(QPaintEvent*) override
  {
    QStyleOptionComboBox option;
    initStyleOption(&option);
    const int room =
        style()
            ->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, this)
            .width() -
        2; // px, which the style leaves beside the text
    option.currentText = fontMetrics().elidedText(currentText(), Qt::ElideMiddle, room);
    QStylePainter painter(this);
    painter.drawComplexControl(QStyle::CC_ComboBox, option);
    painter.drawControl(QStyle::CE_ComboBoxLabel, option);
  }
};

// What tells a place from another one whose name is alike.
QString detailOf(const presenters::PlaceChoice& place)
{
  QStringList details;
  if (place.isMesh)
    details += RegistrationTargetBox::tr("mesh");
  if (!place.drawnOn.empty())
    details += RegistrationTargetBox::tr("drawn on %1").arg(words(place.drawnOn));
  if (place.volume > 0.0)
    details += numberText(presenters::cubicMillimetres(place.volume));
  return details.join(", ");
}
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
  m_place = new NameBox;
  m_place->setObjectName("registrationPlace");
  m_place->setMaxVisibleItems(12);
  m_place->setStyleSheet("QComboBox { combobox-popup: 0; }"); // else some styles show all of them
  addChoice(tr("Error &at"), m_place);
  m_placeNote = new QLabel;
  m_placeNote->setObjectName("registrationPlaceNote");
  wrapWords(*m_placeNote);
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
  auto places = m_session.placeChoices();
  std::sort(places.begin(), places.end(),
            [](const presenters::PlaceChoice& a, const presenters::PlaceChoice& b)
            { return QString::localeAwareCompare(shownName(a.name), shownName(b.name)) < 0; });
  while (m_place->count() > static_cast<int>(places.size()) + kFirstStructure)
    m_place->removeItem(m_place->count() - 1);
  if (m_place->count() == 0)
    m_place->addItems({tr("the middle ear"), tr("the crosshair")});
  for (std::size_t n = 0; n < places.size(); ++n)
  {
    const presenters::PlaceChoice& place = places[n];
    const int row = kFirstStructure + static_cast<int>(n);
    const QString name = shownName(place.name);
    const QString detail = detailOf(place);
    const QString whole = detail.isEmpty() ? name : tr("%1 (%2)").arg(name, detail);
    if (row == m_place->count())
      m_place->addItem(QString());
    m_place->setItemText(row, place.isAlike ? whole : name);
    m_place->setItemData(row, words(place.name));
    m_place->setItemData(row, whole, Qt::ToolTipRole);
  }
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
  m_bound.refresh();
  showPlaceNote();
}

void RegistrationTargetBox::showPlaceNote()
{
  m_place->setToolTip(tr("Where the error is stated. The middle ear: an ossicle, or else the "
                         "tympanic cavity or the inner ear; without these the centre of what both "
                         "images show") +
                      '\n' + tr("Chosen: %1").arg(m_place->currentText()));
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
