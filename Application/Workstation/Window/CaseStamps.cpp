#include "CaseStamps.h"

#include <algorithm>
#include <utility>

#include <QAction>
#include <QActionGroup>
#include <QEvent>
#include <QImage>
#include <QLabel>
#include <QPainter>
#include <QPainterPath>
#include <QStringList>

#include "Banner.h"
#include "DescriptionDialog.h"
#include "SliceColumn.h"
#include "SliceView.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{

constexpr int kMostName = 260;      // px
constexpr int kSliceMargin = 5;     // px
constexpr int kOverScaleBar = 40;   // px, of a slice: its text and halo
constexpr int kLetter = 24;         // px, of the right edge, with its halo
constexpr double kOfHeight = 0.024; // a stamp's letters, of a picture

QString sideOfStamp(scene::Side side)
{
  const QString said = sideText(side);
  return said.isEmpty() ? CaseStamps::tr("side not stated") : said;
}

} // namespace

QString stampText(const presenters::CaseStamp& stamp)
{
  QStringList parts;
  if (!stamp.name.empty())
    parts += words(stamp.name);
  parts += sideOfStamp(stamp.side);
  if (!stamp.planned.empty())
    parts += CaseStamps::tr("planned %1").arg(dateText(stamp.planned));
  return parts.join(QString::fromUtf8(" · "));
}

void drawStamp(QImage& picture, const QString& text, bool isSideBySide,
               presenters::Backdrop backdrop)
{
  const bool isOnDark = backdrop == presenters::Backdrop::Dark;
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  QFont font = painter.font();
  font.setPixelSize(std::max(11, static_cast<int>(kOfHeight * picture.height())));
  const QFontMetricsF metrics(font);
  const double margin = 0.6 * font.pixelSize();
  const int views = isSideBySide ? 2 : 1;
  const double width = double(picture.width()) / views;
  const QString shown = metrics.elidedText(text, Qt::ElideLeft, width - 2.0 * margin);
  for (int n = 1; n <= views; ++n)
  {
    QPainterPath letters; // legible on bone and on the background
    letters.addText(n * width - margin - metrics.horizontalAdvance(shown),
                    margin + metrics.ascent(), font, shown);
    painter.strokePath(letters, QPen(isOnDark ? QColor(0, 0, 0, 200) : QColor(255, 255, 255, 200),
                                     0.25 * font.pixelSize()));
    painter.fillPath(letters, QColor(isOnDark ? "#f2f5f8" : "#10161e"));
  }
}

CaseStamps::CaseStamps(presenters::WorkstationModel& model, ThreeDView& view, SliceColumn& slices,
                       Banner& question, QActionGroup& sides, QObject* parent)
  : QObject(parent)
  , m_model(model)
  , m_view(view)
  , m_question(question)
  , m_sides(sides)
{
  for (SliceView* slice : slices.views())
  {
    auto* label = new QLabel(slice);
    label->setObjectName("caseStamp");
    label->setTextFormat(Qt::PlainText);
    label->setAttribute(Qt::WA_TransparentForMouseEvents);
    label->hide();
    slice->installEventFilter(this);
    m_inSlices.push_back(label);
  }
  const auto offer = [this](const char* name, const QString& text, scene::Side side)
  { m_question.addButton(name, text, [this, side] { setSide(side); }); };
  offer("sideLeft", tr("Left"), scene::Side::Left);
  offer("sideRight", tr("Right"), scene::Side::Right);
  offer("sideBoth", tr("Both"), scene::Side::Both);
  m_question.addButton("sideLater", tr("Later"), [this] { putOff(); });
  connect(&m_sides, &QActionGroup::triggered, this,
          [this](QAction* action) { setSide(static_cast<scene::Side>(action->data().toInt())); });
}

void CaseStamps::setSide(scene::Side side)
{
  m_question.hide();
  if (!m_model.hasCase() || m_model.value().description.side == side)
    return;
  m_model.setSide(side);
  stateChanged(); // also where it was refused
  emit answered();
}

void CaseStamps::putOff()
{
  m_question.hide();
  if (m_model.hasCase())
    m_putOff.insert(m_model.value().id.empty() ? m_model.value().name : m_model.value().id);
}

void CaseStamps::caseOpened()
{
  const scene::Case& value = m_model.value();
  m_asked = value.description.side;
  const bool isPutOff = m_putOff.count(value.id.empty() ? value.name : value.id) > 0;
  if (value.description.side == scene::Side::Unknown && !isPutOff)
    ask();
  else
    m_question.hide();
}

void CaseStamps::ask()
{
  m_question.setText(tr("Which side of the patient is operated on? It stands over every view and "
                        "is kept with the case (Case > Side)."));
  m_question.show();
}

void CaseStamps::doubt()
{
  const QString why = phrase(presenters::sideDoubt(m_model.value()));
  m_question.setText(why);
  m_question.setVisible(!why.isEmpty());
}

void CaseStamps::caseClosed()
{
  m_question.hide();
}

void CaseStamps::stateChanged()
{
  const bool open = m_model.hasCase();
  for (QAction* action : m_sides.actions())
    action->setChecked(open && action->data().toInt() ==
                                   static_cast<int>(m_model.value().description.side));
  // Undo may take an answer back, or give it again.
  if (const auto side = open ? m_model.value().description.side : scene::Side::Unknown;
      open && side != std::exchange(m_asked, side))
    side == scene::Side::Unknown ? caseOpened() : doubt();
  m_view.setStamp(open ? stampText(presenters::stampOf(m_model.value())) : QString());
  placeInSlices();
}

// The side is never cut off.
void CaseStamps::placeInSlices()
{
  for (QLabel* label : m_inSlices)
  {
    label->setVisible(m_model.hasCase());
    if (!m_model.hasCase())
      continue;
    const QWidget& slice = *label->parentWidget();
    const scene::Case& value = m_model.value();
    const int room = std::min(kMostName, slice.width() / 3);
    label->setText(label->fontMetrics().elidedText(words(value.name), Qt::ElideMiddle, room) +
                   QString::fromUtf8(" · ") + sideOfStamp(value.description.side));
    label->adjustSize();
    // In a low slice beside the letter of its right edge.
    const int top = slice.height() - kOverScaleBar - label->height();
    const bool isAtLetter = top < slice.height() / 2 + kLetter / 2;
    label->move(slice.width() - kSliceMargin - (isAtLetter ? kLetter : 0) - label->width(), top);
  }
}

bool CaseStamps::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() == QEvent::Resize)
    placeInSlices();
  return QObject::eventFilter(watched, event);
}

} // namespace petrous::workstation
