#include "ReplayPanel.h"

#include <algorithm>
#include <cmath>

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPainter>
#include <QPixmap>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QSlider>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "Bind.h"
#include "Language.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{

constexpr std::pair<double, const char*> kSpeeds[] = {
    {0.25, "¼ ×"}, {0.5, "½ ×"}, {1.0, "1 ×"}, {2.0, "2 ×"}, {4.0, "4 ×"}};
constexpr int kUsualSpeed = 2; // index

QLabel* wrapped(const char* name)
{
  auto* label = new QLabel;
  label->setObjectName(name);
  wrapWords(*label);
  label->setTextFormat(Qt::PlainText);
  label->hide();
  return label;
}

void say(QLabel& label, const QString& text)
{
  label.setText(text);
  label.setVisible(!text.isEmpty());
}

QTreeWidget* table(const char* name, const QString& accessible, const QStringList& columns)
{
  auto* list = new QTreeWidget;
  list->setObjectName(name);
  list->setAccessibleName(accessible);
  list->setColumnCount(columns.size());
  list->setHeaderLabels(columns);
  list->setRootIsDecorated(false);
  list->setUniformRowHeights(true);
  list->header()->setStretchLastSection(false);
  list->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  for (int n = 1; n < columns.size(); ++n)
    list->header()->setSectionResizeMode(n, QHeaderView::ResizeToContents);
  list->setMinimumHeight(70);
  return list;
}

// "1:02.5"
QString clockText(double seconds)
{
  const auto tenths = static_cast<long long>(std::max(seconds, 0.0) * 10.0 + 0.5);
  return QString("%1:%2%3%4")
      .arg(tenths / 600)
      .arg(tenths / 10 % 60, 2, 10, QChar('0'))
      .arg(numberLocale().decimalPoint())
      .arg(tenths % 10);
}

QString fixed(double value, int decimals, const QString& unit)
{
  return numberText(value, decimals) + " " + unit;
}

} // namespace

/// Force on the hand over the time of a recording; where the burr turned, the ground is lit.
class ForceCourse : public QWidget
{
public:
  ForceCourse()
  {
    setObjectName("replayForce");
    setToolTip(ReplayPanel::tr("Force on the hand over time, N; the ground is lighter while the "
                               "burr turned, and the line is the time that is shown"));
    setAccessibleName(ReplayPanel::tr("Force over time"));
  }

  void setReview(const presenters::SessionReview* review)
  {
    m_review = review;
    m_curve = {};
    update();
  }
  void setTime(double seconds)
  {
    m_time = seconds;
    update();
  }

  QSize sizeHint() const override { return {260, 84}; }
  QSize minimumSizeHint() const override { return {120, 60}; }

protected:
  void paintEvent(QPaintEvent*) override
  {
    if (m_curve.size() != size() * devicePixelRatioF())
      drawCurve();
    QPainter painter(this);
    painter.drawPixmap(0, 0, m_curve);
    if (!m_review || m_review->course.empty() || m_review->metrics.duration <= 0.0)
      return;
    const QRectF area = this->area();
    const double x = area.left() + area.width() * m_time / m_review->metrics.duration;
    painter.setPen(QColor("#ffffff"));
    painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
  }

private:
  QRectF area() const { return QRectF(rect()).adjusted(4.0, 16.0, -4.0, -4.0); }

  // All but the time that is shown: an hour has 360,000 samples.
  void drawCurve()
  {
    m_curve = QPixmap(size() * devicePixelRatioF());
    m_curve.setDevicePixelRatio(devicePixelRatioF());
    QPainter painter(&m_curve);
    painter.fillRect(rect(), QColor("#14171b"));
    painter.setPen(QColor("#2e343c"));
    painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
    if (!m_review || m_review->course.empty() || m_review->metrics.duration <= 0.0)
      return;
    const QRectF area = this->area();
    const double most = std::max(m_review->metrics.maxForce, 0.1); // N
    const auto xOf = [&](double time)
    { return area.left() + area.width() * time / m_review->metrics.duration; };
    // The greatest force of each column of pixels.
    const int columns = std::max(static_cast<int>(area.width()), 1);
    std::vector<double> force(static_cast<std::size_t>(columns), 0.0);
    const auto& course = m_review->course;
    for (std::size_t n = 0; n < course.size(); ++n)
    {
      const int at =
          std::clamp(static_cast<int>(xOf(course[n].time) - area.left()), 0, columns - 1);
      auto& column = force[static_cast<std::size_t>(at)];
      column = std::max(column, course[n].force);
      if (course[n].drilling && n + 1 < course.size())
        painter.fillRect(QRectF(xOf(course[n].time), area.top(),
                                std::max(xOf(course[n + 1].time) - xOf(course[n].time), 1.0),
                                area.height()),
                         QColor("#262c34"));
    }
    painter.setPen(QColor("#62b0ec"));
    for (int at = 0; at < columns; ++at)
      if (const double high = force[static_cast<std::size_t>(at)]; high > 0.0)
        painter.drawLine(QPointF(area.left() + at, area.bottom()),
                         QPointF(area.left() + at, area.bottom() - area.height() * high / most));
    painter.setPen(QColor("#9aa4af"));
    painter.drawText(QPointF(6.0, 12.0), fixed(most, 1, ReplayPanel::tr("N")));
  }

  const presenters::SessionReview* m_review = nullptr;
  double m_time = 0.0; // s
  QPixmap m_curve;
};

ReplayPanel::ReplayPanel(QAction& play, QWidget* parent)
  : Panel(parent)
  , m_recordings(choiceBox("replayChoice", tr("Recordings of this case: those in the library's "
                                              "folder, and attached ones")))
  , m_place(new QSlider(Qt::Horizontal))
  , m_time(new QLabel)
  , m_now(new QLabel)
  , m_said(wrapped("replaySaid"))
  , m_speed(choiceBox("replaySpeed", tr("How fast it is played")))
  , m_ghost(new QCheckBox(tr("&Ghost of the tool")))
  , m_withDrill(new QCheckBox(tr("&Start with my drill")))
  , m_force(new ForceCourse)
  , m_parts(table("replayParts", tr("Recordings of the operation"),
                  {tr("Recording"), tr("Time"), tr("Drilling"), tr("Path"), tr("Drilled")}))
  , m_metrics(table("replayMetrics", tr("Metrics of the recording"), {tr("Metric"), tr("Value")}))
  , m_structures(table("replayStructures", tr("Structures in the recording"),
                       {tr("Structure"), tr("Nearest"), tr("Drilled")}))
  , m_note(wrapped("replayNote"))
  , m_export(
        button(tr("E&xport…"), "replayExport", tr("Metrics, or place and force over time, as CSV")))
{
  auto* open = button(tr("&Open…"), "replayOpen", tr("A recording from a file (*.ticks)"));
  m_recordings->setAccessibleName(tr("Recording"));
  m_recordings->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  m_recordings->setMinimumContentsLength(8);
  auto* top = new QHBoxLayout;
  top->addWidget(m_recordings, 1);
  top->addWidget(open);

  auto* playButton = new QToolButton;
  playButton->setDefaultAction(&play);
  playButton->setObjectName("replayPlay");
  playButton->setFocusPolicy(Qt::TabFocus);
  m_place->setObjectName("replayPlace");
  m_place->setAccessibleName(tr("Time in the recording"));
  m_place->setToolTip(tr("Time in the recording: arrow keys by a second, page keys by ten"));
  m_place->setSingleStep(1000);
  m_place->setPageStep(10000);
  m_time->setObjectName("replayTime");
  for (const auto& [factor, text] : kSpeeds)
    m_speed->addItem(QString::fromUtf8(text), factor);
  m_speed->setCurrentIndex(kUsualSpeed);
  auto* row = new QHBoxLayout;
  row->addWidget(playButton);
  row->addWidget(m_place, 1);
  row->addWidget(m_time);

  m_ghost->setObjectName("replayGhost");
  m_ghost->setToolTip(
      tr("The recorded tool in the 3D view, as a wire frame beside the tool in use"));
  m_ghost->setChecked(true);
  m_withDrill->setObjectName("replayWithDrill");
  m_withDrill->setToolTip(
      tr("The recording begins as soon as your burr drills: your stroke beside the recorded one"));
  auto* choices = new QHBoxLayout;
  choices->addWidget(m_ghost);
  choices->addWidget(m_withDrill);
  choices->addStretch(1);
  choices->addWidget(m_speed);
  m_now->setObjectName("replayNow");
  m_structures->setToolTip(tr("How near the burr came to the structure, 0 where it reached it, and "
                              "what was drilled of it"));
  auto* foot = new QHBoxLayout;
  foot->addStretch(1);
  foot->addWidget(m_export);

  auto* whole = new QWidget;
  auto* layout = new QVBoxLayout(whole);
  layout->setContentsMargins(10, 8, 10, 8);
  layout->addLayout(top);
  layout->addWidget(m_said);
  layout->addLayout(row);
  layout->addLayout(choices);
  layout->addWidget(m_force);
  layout->addWidget(m_now);
  layout->addWidget(m_parts, 1);
  layout->addWidget(m_metrics, 2);
  layout->addWidget(m_structures, 2);
  layout->addWidget(m_note);
  layout->addLayout(foot);
  layOutPanel(*this, whole, new QWidget);

  connect(open, &QPushButton::clicked, this, &ReplayPanel::openAsked);
  connect(m_export, &QPushButton::clicked, this, &ReplayPanel::exportAsked);
  connect(m_ghost, &QCheckBox::toggled, this, &ReplayPanel::ghostAsked);
  connect(m_recordings, qOverload<int>(&QComboBox::activated), this, &ReplayPanel::recordingChosen);
  m_parts->setToolTip(
      tr("An operation has a recording for each burr. The tables below are those of "
         "the line that is chosen, which the time goes to"));
  m_parts->hide();
  connect(m_parts, &QTreeWidget::currentItemChanged, this,
          [this](const QTreeWidgetItem* item)
          {
            if (m_refreshing || !item || !m_review)
              return;
            showMetrics();
            if (const int at = m_parts->indexOfTopLevelItem(const_cast<QTreeWidgetItem*>(item));
                at > 0)
              emit seekAsked(static_cast<int>(
                  std::lround(1000.0 * m_review->parts[static_cast<std::size_t>(at - 1)].begin)));
          });
  connect(m_place, &QSlider::valueChanged, this,
          [this](int at)
          {
            if (!m_refreshing)
              emit seekAsked(at);
          });
  setReview(nullptr);
}

void ReplayPanel::caseChanged()
{
  if (onCaseChanged)
    onCaseChanged();
}

void ReplayPanel::partsChanged()
{
  if (onPartsChanged)
    onPartsChanged();
}

void ReplayPanel::attachmentsChanged()
{
  if (onRecordingsChanged)
    onRecordingsChanged();
}

void ReplayPanel::toolMoved(const presenters::MeasuredTool& /*tool*/, const haptics::Pose& /*pose*/)
{
  if (onToolMoved)
    onToolMoved();
}

void ReplayPanel::toolGone()
{
  if (onToolMoved)
    onToolMoved();
}

double ReplayPanel::speed() const
{
  return m_speed->currentData().toDouble();
}

bool ReplayPanel::showsGhost() const
{
  return m_ghost->isChecked();
}

bool ReplayPanel::startsWithDrill() const
{
  return m_withDrill->isChecked();
}

void ReplayPanel::say(const QString& text)
{
  workstation::say(*m_said, text);
}

void ReplayPanel::setRecordings(const QStringList& names, int current)
{
  m_recordings->clear();
  m_recordings->setPlaceholderText(names.isEmpty() ? tr("No recording yet")
                                                   : tr("Choose a recording"));
  m_recordings->addItems(names);
  m_recordings->setCurrentIndex(current);
  m_recordings->setEnabled(!names.isEmpty());
}

void ReplayPanel::setReview(const presenters::OperationReview* review)
{
  m_review = review;
  m_force->setReview(review);
  {
    const QScopedValueRollback<bool> refreshing(m_refreshing, true);
    m_place->setRange(0, review ? static_cast<int>(std::lround(1000.0 * review->metrics.duration))
                                : 0);
  }
  for (QWidget* one : {static_cast<QWidget*>(m_place), static_cast<QWidget*>(m_export)})
    one->setEnabled(review != nullptr);
  showParts();
  showMetrics();
  setTime(0.0);
}

void ReplayPanel::setTime(double seconds)
{
  const QScopedValueRollback<bool> refreshing(m_refreshing, true);
  m_place->setValue(static_cast<int>(std::lround(1000.0 * seconds)));
  m_force->setTime(seconds);
  const double duration = m_review ? m_review->metrics.duration : 0.0;
  m_time->setText(clockText(seconds) + " / " + clockText(duration));
  const auto tool = m_review ? presenters::toolAt(m_review->course, seconds) : std::nullopt;
  m_now->setText(tool ? (tool->drilling ? tr("Force %1 N, thrust %2 N, drilling")
                                        : tr("Force %1 N, thrust %2 N"))
                            .arg(numberText(tool->force, 2), numberText(tool->thrust, 2))
                      : QString(" "));
}

void ReplayPanel::showParts()
{
  const QScopedValueRollback<bool> refreshing(m_refreshing, true);
  m_parts->clear();
  m_parts->setVisible(m_review && m_review->parts.size() > 1);
  if (!m_review)
    return;
  const auto add =
      [this](const QString& name, const QString& hint, const presenters::SessionReview& review)
  {
    auto* item = new QTreeWidgetItem(
        m_parts, {name, durationText(review.metrics.duration),
                  durationText(review.metrics.drilling), fixed(review.metrics.path, 0, tr("mm")),
                  review.removed ? volumeText(*review.removed) : QString::fromUtf8("–")});
    item->setToolTip(0, hint);
    for (int column = 1; column < m_parts->columnCount(); ++column)
      item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  };
  add(tr("Together"), tr("All recordings of the operation, without the pauses between them"),
      *m_review);
  for (const auto& part : m_review->parts)
    add(phrase(part.review.tool), words(part.name), part.review);
  m_parts->setCurrentItem(m_parts->topLevelItem(0));
}

const presenters::SessionReview& ReplayPanel::chosenPart() const
{
  const int row = m_parts->indexOfTopLevelItem(m_parts->currentItem());
  if (row <= 0)
    return *m_review;
  return m_review->parts[static_cast<std::size_t>(row - 1)].review;
}

void ReplayPanel::showMetrics()
{
  m_metrics->clear();
  m_structures->clear();
  workstation::say(*m_note, {});
  if (!m_review)
    return;
  const presenters::SessionReview& review = chosenPart();
  const presenters::SessionMetrics& metrics = review.metrics;
  const auto add = [this](const QString& what, const QString& value)
  {
    auto* item = new QTreeWidgetItem(m_metrics, {what, value});
    item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
    item->setToolTip(0, what);
  };
  const bool isOfSeveral = &review == m_review && m_review->parts.size() > 1;
  if (!isOfSeveral)
    add(tr("Tool"), phrase(review.tool));
  add(tr("Time"), durationText(metrics.duration));
  add(tr("Time drilling"), durationText(metrics.drilling));
  add(tr("Times the drill was switched on"), QString::number(metrics.drillStarts));
  if (review.speed)
  {
    add(tr("Mean speed drilling"), fixed(review.speed->mean, 0, tr("/min")));
    add(tr("Highest speed"), fixed(review.speed->max, 0, tr("/min")));
  }
  add(tr("Path of the burr"), fixed(metrics.path, 1, tr("mm")));
  add(tr("Path drilling"), fixed(metrics.drillingPath, 1, tr("mm")));
  add(tr("Mean force drilling"), fixed(metrics.meanForce, 2, tr("N")));
  add(tr("Largest force"), fixed(metrics.maxForce, 2, tr("N")));
  add(tr("Largest thrust"), fixed(metrics.maxThrust, 2, tr("N")));
  if (review.removed)
  {
    add(tr("Strokes"), QString::number(review.strokes));
    add(tr("Removed"), volumeText(*review.removed));
  }
  for (const auto& one : review.structures)
  {
    auto* item =
        new QTreeWidgetItem(m_structures, {shownName(one.name),
                                           !one.nearest          ? QString::fromUtf8("–")
                                           : *one.nearest <= 0.0 ? tr("reached")
                                                                 : fixed(*one.nearest, 2, tr("mm")),
                                           !one.removed          ? QString::fromUtf8("–")
                                           : *one.removed <= 0.0 ? tr("nothing")
                                                                 : volumeText(*one.removed)});
    item->setToolTip(0, shownName(one.name));
    for (int column = 1; column < 3; ++column)
      item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  }
  QStringList notes;
  if (!review.warning.empty())
    notes += sentence(capitalized(phrase(review.warning)));
  if (!review.whyUnmeasured.empty())
    notes += sentence(tr("What was drilled is not known here: the recording %1")
                          .arg(phrase(review.whyUnmeasured)));
  workstation::say(*m_note, notes.join('\n'));
}

} // namespace petrous::workstation
