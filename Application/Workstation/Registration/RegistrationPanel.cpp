#include "RegistrationPanel.h"

#include <QComboBox>
#include <QDateTime>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSlider>
#include <QVBoxLayout>

#include "Application.h"
#include "Bind.h"
#include "FittedBox.h"
#include "FoldBox.h"
#include "HandlesBox.h"
#include "LandmarksBox.h"
#include "MetricCurve.h"
#include "PanelLayout.h"
#include "RegistrationTargetBox.h"
#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{
using presenters::OverlayMode;

constexpr int kOff = -1;

QLabel* heading(const QString& text)
{
  auto* label = new QLabel("<b>" + text + "</b>");
  label->setTextFormat(Qt::RichText);
  label->setContentsMargins(0, 6, 0, 0);
  return label;
}

// What the status line omits.
QString errorText(const scene::ImagePart& mr)
{
  if (!mr.registered || !mr.registration)
    return {};
  QString text;
  if (const auto& error = mr.registration->error)
    text = RegistrationPanel::tr("Median error %1 mm, largest %2 mm")
               .arg(numberText(error->median, 2))
               .arg(numberText(error->max, 2));
  const QString why = phrase(mr.registration->text);
  return text.isEmpty() || why.isEmpty() ? text + why : text + "\n" + why;
}

// A doubtful state is highlighted.
QString stateStyle(const scene::ImagePart* mr)
{
  const bool good = mr && mr->registered && mr->registration &&
                    mr->registration->verdict == scene::Registration::Verdict::Good;
  return mr && mr->registered && !good ? QString(kWarningStyle) : QString();
}

} // namespace

RegistrationPanel::RegistrationPanel(presenters::RegistrationSession& session, QWidget* parent)
  : Panel(parent)
  , m_session(session)
  , m_mr(new QComboBox)
  , m_state(new QLabel)
  , m_error(new QLabel)
  , m_line(new QLabel)
  , m_aim(new RegistrationTargetBox(session))
  , m_handles(new HandlesBox(session))
  , m_points(new LandmarksBox(session))
{
  m_mr->setObjectName("registrationMr");
  m_mr->setAccessibleName(tr("MR"));
  m_mr->setToolTip(tr("The MR that is registered and shown over the slices"));
  m_state->setObjectName("registrationState");
  m_line->setObjectName("registrationLine");
  m_error->setObjectName("dim");
  for (QLabel* label : {m_state, m_error, m_line})
  {
    wrapWords(*label);
    label->setTextFormat(Qt::PlainText);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  }
  m_bound.add(
      m_mr, [this] { return m_mr->findText(words(m_session.mr())); },
      [this](int row)
      {
        m_session.choose(bytes(m_mr->itemText(row)));
        say({});
        refresh();
        emit mrChosen();
      });
  auto* inside = new QWidget;
  auto* layout = new QVBoxLayout(inside);
  layout->setContentsMargins(10, 8, 10, 8);
  layout->setSpacing(5);
  layout->addWidget(m_mr);
  layout->addWidget(m_state);
  layout->addWidget(m_error);
  addSteps(*layout);
  addSeeing(*layout);
  addRunning(*layout);
  layout->addWidget(m_pointsFold = new FoldBox(tr("By pairs of points"), "pointsFold", m_points));
  layout->addWidget(m_handFold = new FoldBox(tr("By hand"), "handFold", m_handles));
  layout->addStretch(1);
  m_pointsFold->setOther(m_handFold);
  m_handFold->setOther(m_pointsFold);
  connect(m_points, &LandmarksBox::pointAsked, this, &RegistrationPanel::pointAsked);
  connect(m_points, &LandmarksBox::fitAsked, this, &RegistrationPanel::landmarksAsked);
  connect(m_aim, &RegistrationTargetBox::chosen, this, &RegistrationPanel::aimChosen);
  connect(m_points, &LandmarksBox::changed, this, &RegistrationPanel::landmarksChanged);
  connect(m_handles, &HandlesBox::attempted, this, &RegistrationPanel::say);
  layOutPanel(*this, inside, signOff());
  setOverlay(std::nullopt, 0.5);
  setRunning(false);
  say({});
}

void RegistrationPanel::addSteps(QVBoxLayout& layout)
{
  m_undo = button(tr("Undo"), "undoMr", {});
  m_redo = button(tr("Redo"), "redoMr", {});
  m_remove = button(tr("Unregister"), "unregister", {});
  connect(m_undo, &QPushButton::clicked, this, [this] { m_session.undo(); });
  connect(m_redo, &QPushButton::clicked, this, [this] { m_session.redo(); });
  connect(m_remove, &QPushButton::clicked, this, [this] { m_session.unregister(); });
  layout.addLayout(rowOf({m_undo, m_redo, m_remove}));
}

void RegistrationPanel::addSeeing(QVBoxLayout& layout)
{
  m_overlay = new FittedBox;
  m_overlay->setObjectName("overlayMode");
  m_overlay->addItem({}, kOff);
  m_overlay->addItem(tr("Blend"), static_cast<int>(OverlayMode::Blend));
  m_overlay->addItem({}, static_cast<int>(OverlayMode::Edges));
  m_overlay->addItem(tr("Checkerboard"), static_cast<int>(OverlayMode::Checker));
  m_bound.add(
      m_overlay,
      [this]
      { return m_overlay->findData(m_overlayMode ? static_cast<int>(*m_overlayMode) : kOff); },
      [this](int row)
      {
        const int mode = m_overlay->itemData(row).toInt();
        emit overlayChosen(mode == kOff ? std::nullopt
                                        : std::optional(static_cast<OverlayMode>(mode)));
      });
  m_opacity = m_bound.add(
      percentSlider("overlayOpacity", tr("Opacity of the MR in the blend")),
      [this] { return percent(m_overlayOpacity); },
      [this](int percent) { emit opacityChosen(0.01 * percent); });
  auto* form = new QFormLayout;
  form->addRow(tr("&Slices show"), m_overlay);
  form->addRow(tr("MR &opacity"), m_opacity);
  m_opacityLabel = form->labelForField(m_opacity);
  layout.addLayout(form);
}

void RegistrationPanel::addRunning(QVBoxLayout& layout)
{
  layout.addWidget(heading(tr("By mutual information")));
  m_register = button(tr("&Register"), "register", {});
  m_refine = button(tr("Re&fine"), "refine",
                    tr("The same from where the MR lies now, without a search: after points or the "
                       "hand"));
  m_cancel =
      button(tr("Cancel"), "cancelRegistration", tr("Stops; what was reached by then can be kept"));
  connect(m_register, &QPushButton::clicked, this, &RegistrationPanel::registerAsked);
  connect(m_refine, &QPushButton::clicked, this, &RegistrationPanel::refineAsked);
  connect(m_cancel, &QPushButton::clicked, this, &RegistrationPanel::cancelAsked);
  layout.addWidget(m_aim);
  layout.addLayout(rowOf({m_register, m_refine, m_cancel}));
  m_progress = new QProgressBar;
  m_progress->setObjectName("registrationProgress");
  m_progress->setRange(0, 1000);
  m_curve = new MetricCurve;
  m_metric = new QLabel;
  m_metric->setObjectName("liveMetric");
  layout.addWidget(m_progress);
  layout.addWidget(m_curve);
  layout.addWidget(m_metric);
  layout.addWidget(m_line);
}

QWidget* RegistrationPanel::signOff()
{
  auto* box = new QWidget;
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(10, 4, 10, 8);
  layout->setSpacing(5);
  layout->addWidget(heading(tr("Sign-off")));
  m_name = new QLineEdit;
  m_name->setObjectName("signName");
  m_name->setAccessibleName(tr("The surgeon's name"));
  m_name->setPlaceholderText(tr("The surgeon's name"));
  m_name->setMaxLength(100);
  m_sign = button(tr("Sign"), "sign",
                  tr("I have looked at it and accept how the MR lies; void once it moves"));
  connect(m_name, &QLineEdit::textChanged, this, &RegistrationPanel::enable);
  connect(m_name, &QLineEdit::returnPressed, this, &RegistrationPanel::sign);
  connect(m_sign, &QPushButton::clicked, this, &RegistrationPanel::sign);
  layout->addLayout(rowOf({m_name, m_sign}));
  return box;
}

void RegistrationPanel::openPoints()
{
  m_pointsFold->setOpen(true);
}

void RegistrationPanel::openHand()
{
  m_handFold->setOpen(true);
}

void RegistrationPanel::showEvent(QShowEvent* event)
{
  QWidget::showEvent(event);
  emit shown();
}

void RegistrationPanel::hideEvent(QHideEvent* event)
{
  QWidget::hideEvent(event);
  emit hidden();
}

void RegistrationPanel::attempt(const std::function<void()>& what)
{
  say({});
  try
  {
    what();
  }
  catch (const std::exception& error)
  {
    say(toString(error));
  }
}

void RegistrationPanel::sign()
{
  const QString who = m_name->text().trimmed();
  if (who.isEmpty() || !m_sign->isEnabled())
    return;
  attempt(
      [&] {
        m_session.signOff(bytes(who), bytes(QDateTime::currentDateTimeUtc().toString(Qt::ISODate)));
      });
  m_name->clear(); // the next user types their own
}

void RegistrationPanel::caseChanged()
{
  m_bound.quietly([this] { m_mr->clear(); });
  m_name->clear();
  m_curve->clear();
  setMetric({});
  say({});
  refresh();
}

// What was typed and said stays.
void RegistrationPanel::partsChanged()
{
  refresh();
}

// What can be undone; others' steps come and go too.
void RegistrationPanel::stateChanged()
{
  showSteps();
}

void RegistrationPanel::showSteps()
{
  const bool free = m_session.part() && !m_running;
  m_undo->setEnabled(free && m_session.canUndo());
  m_redo->setEnabled(free && m_session.canRedo());
  m_undo->setToolTip(m_session.canUndo()
                         ? tr("Undo %1 (Ctrl+Alt+Z)").arg(phrase(m_session.undoText()))
                         : tr("Back to how the MR lay before (Ctrl+Alt+Z)"));
  m_redo->setToolTip(m_session.canRedo()
                         ? tr("Redo %1 (Ctrl+Alt+Y)").arg(phrase(m_session.redoText()))
                         : tr("Forth again (Ctrl+Alt+Y)"));
}

void RegistrationPanel::refresh()
{
  QStringList names;
  for (const std::string& name : m_session.mrNames())
    names << words(name);
  QStringList shown;
  for (int n = 0; n < m_mr->count(); ++n)
    shown << m_mr->itemText(n);
  if (names != shown)
    m_bound.quietly(
        [&]
        {
          m_mr->clear();
          m_mr->addItems(names);
        });
  const QString primary = words(m_session.primary());
  m_remove->setToolTip(tr("The MR has no place on the %1 any more").arg(primary));
  m_overlay->setToolTip(
      tr("How the slices show the MR (O: the next way, V: %1 or MR alone by turns)").arg(primary));
  m_register->setToolTip(tr("Looks for where the MR fits the %1, lays it there, and says how well "
                            "it lies (Ctrl+R)")
                             .arg(primary));
  m_metric->setToolTip(
      tr("Mutual information of %1 and MR as they lie now; higher is better").arg(primary));
  m_overlay->setItemText(0, tr("%1 alone").arg(primary));
  m_overlay->setItemText(2, tr("%1's edges over the MR").arg(primary));
  m_overlay->fit(m_overlay->count());
  m_bound.refresh();
  m_state->setText(m_session.part()       ? phrase(m_session.stateText())
                   : !m_session.hasCase() ? tr("Open a case first")
                   : m_session.primary() != "CT"
                       ? tr("The case has no other MR; add one with Case > Add MR…")
                       : tr("The case has no MR; add one with Case > Add MR…"));
  m_state->setStyleSheet(stateStyle(m_session.part()));
  m_error->setText(m_session.part() ? errorText(*m_session.part()) : QString());
  m_error->setVisible(!m_error->text().isEmpty());
  m_aim->refresh();
  m_handles->refresh();
  m_points->refresh();
  enable();
}

void RegistrationPanel::enable()
{
  const bool there = m_session.part() != nullptr;
  const bool free = there && !m_running;
  m_mr->setEnabled(free);
  m_overlay->setEnabled(there);
  const bool blends = m_overlayMode == OverlayMode::Blend;
  m_opacity->setEnabled(there);
  m_opacity->setVisible(blends);
  m_opacityLabel->setVisible(blends);
  m_register->setEnabled(free);
  m_refine->setEnabled(free && m_session.part()->registered);
  m_cancel->setEnabled(m_running);
  m_aim->setEnabled(free);
  m_handles->setEnabled(free);
  m_points->setEnabled(free);
  showSteps();
  m_remove->setEnabled(free && m_session.part()->registered);
  m_sign->setEnabled(free && m_session.part()->registered && !m_name->text().trimmed().isEmpty());
  m_name->setEnabled(free && m_session.part()->registered);
}

void RegistrationPanel::setOverlay(const std::optional<OverlayMode>& mode, double opacity)
{
  m_overlayMode = mode;
  m_overlayOpacity = opacity;
  m_bound.refresh();
  enable();
}

void RegistrationPanel::setRunning(bool running)
{
  m_running = running;
  m_progress->setVisible(running);
  m_progress->setValue(0);
  enable();
}

void RegistrationPanel::setProgress(double fraction, const QString& text, const QString& left)
{
  m_progress->setValue(static_cast<int>(1000.0 * fraction));
  m_progress->setFormat(withTimeLeft(text, left));
}

void RegistrationPanel::setMetric(const QString& text)
{
  m_metric->setText(text);
  m_metric->setVisible(!text.isEmpty());
}

void RegistrationPanel::say(const QString& line)
{
  m_line->setText(line);
  m_line->setVisible(!line.isEmpty());
}

} // namespace petrous::workstation
