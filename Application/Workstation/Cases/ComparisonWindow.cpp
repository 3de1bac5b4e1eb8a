#include "ComparisonWindow.h"

#include <cmath>
#include <set>

#include <QCheckBox>
#include <QCloseEvent>
#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QSignalBlocker>
#include <QSplitter>
#include <QTableWidget>
#include <QVBoxLayout>

#include "Bind.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{

using presenters::ComparedApproach;

QString colored(const std::array<float, 3>& color, const QString& text)
{
  return QString("<span style=\"color:%1\">■</span> %2")
      .arg(QColor::fromRgbF(double{color[0]}, double{color[1]}, double{color[2]}).name(),
           text.toHtmlEscaped());
}

QString found(const std::map<std::string, double>& values, const std::string& name, int decimals,
              const QString& unit)
{
  const auto at = values.find(name);
  return at == values.end() ? QString::fromUtf8("–")
                            : numberText(at->second, decimals) + ' ' + unit;
}

QString distanceText(const ComparedApproach& side, const std::string& name,
                     const std::optional<double>& uncertainty)
{
  const auto at = side.distances.find(name);
  if (at == side.distances.end())
    return QString::fromUtf8("–");
  const QString number = numberText(at->second, 2);
  if (!uncertainty)
    return at->second > 0.0 ? ComparisonWindow::tr("%1 mm, uncertainty unknown").arg(number)
                            : ComparisonWindow::tr("reached, uncertainty unknown");
  const QString error = numberText(*uncertainty, 2);
  return at->second > 0.0 ? ComparisonWindow::tr("%1 ± %2 mm").arg(number, error)
                          : ComparisonWindow::tr("reached (± %1 mm)").arg(error);
}

std::set<std::string> namesOf(const std::map<std::string, double>& a,
                              const std::map<std::string, double>& b)
{
  std::set<std::string> names;
  for (const auto* values : {&a, &b})
    for (const auto& [name, value] : *values)
      names.insert(name);
  return names;
}

} // namespace

ComparisonWindow::ComparisonWindow(QWidget* parent)
  : QWidget(parent, Qt::Window)
  , m_choices{new QComboBox, new QComboBox}
  , m_views{new ThreeDView, new ThreeDView}
  , m_difference(new QCheckBox(tr("&Difference in colours")))
  , m_legend(new QLabel)
  , m_fault(new QLabel)
  , m_again(new QPushButton(tr("&Compare again")))
  , m_progress(new QProgressBar)
  , m_cancel(new QPushButton(tr("Cancel")))
  , m_table(new QTableWidget)
{
  setObjectName("comparison");
  setWindowTitle(tr("Approaches compared — Petrous"));
  for (std::size_t n = 0; n < m_choices.size(); ++n)
  {
    m_choices[n]->setObjectName(n == 0 ? "firstApproach" : "secondApproach");
    m_choices[n]->setAccessibleName(n == 0 ? tr("First approach") : tr("Second approach"));
    m_choices[n]->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    connect(m_choices[n], qOverload<int>(&QComboBox::activated), this,
            [this]
            {
              emit approachesChosen(m_choices[0]->currentData().toString(),
                                    m_choices[1]->currentData().toString());
            });
    m_views[n]->setObjectName(n == 0 ? "firstView" : "secondView");
    connect(m_views[n], &ThreeDView::cameraMoved, this,
            [this, other = m_views[1 - n]](const core::CameraPose& camera)
            {
              if (m_isTurning)
                return;
              const QScopedValueRollback<bool> turning(m_isTurning, true);
              other->setCamera(camera);
            });
  }
  m_difference->setObjectName("showDifference");
  m_difference->setToolTip(
      tr("What one of them removed, or both, in colours: here in one picture, and in the slices"));
  connect(m_difference, &QCheckBox::toggled, this,
          [this](bool on)
          {
            draw();
            emit differenceToggled(on);
          });
  m_legend->setTextFormat(Qt::RichText);
  m_fault->setTextFormat(Qt::PlainText);
  wrapWords(*m_fault);
  m_fault->setStyleSheet(kWarningStyle);
  m_again->setObjectName("compareAgain");
  m_again->setToolTip(tr("Compares the two approaches once more"));
  connect(m_again, &QPushButton::clicked, this, &ComparisonWindow::againAsked);
  m_progress->setRange(0, 100);
  m_progress->setFormat(tr("Comparing, %p %"));
  m_cancel->setObjectName("cancelComparison");
  m_cancel->setToolTip(tr("Stops comparing; the approaches stay as they are"));
  connect(m_cancel, &QPushButton::clicked, this, &ComparisonWindow::cancelAsked);
  m_table->setObjectName("comparisonTable");
  m_table->setAccessibleName(tr("The approaches in numbers"));
  m_table->setColumnCount(3);
  m_table->verticalHeader()->hide();
  m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
  m_table->setAlternatingRowColors(true);
  m_table->setShowGrid(false);
  m_table->horizontalHeader()->setSectionResizeMode(QHeaderView::Stretch);

  auto* head = new QHBoxLayout;
  head->addWidget(m_choices[0]);
  head->addWidget(new QLabel(tr("and")));
  head->addWidget(m_choices[1]);
  head->addSpacing(16);
  head->addWidget(m_difference);
  head->addWidget(m_legend);
  head->addStretch(1);
  auto* work = new QHBoxLayout;
  work->addWidget(m_fault, 1);
  work->addWidget(m_again);
  work->addWidget(m_progress, 1);
  work->addWidget(m_cancel);
  auto* pictures = new QSplitter(Qt::Horizontal);
  pictures->setChildrenCollapsible(false);
  auto* whole = new QSplitter(Qt::Vertical);
  for (ThreeDView* view : m_views)
    pictures->addWidget(view);
  whole->addWidget(pictures);
  whole->addWidget(m_table);
  whole->setStretchFactor(0, 3);
  whole->setStretchFactor(1, 1);
  whole->setSizes({600, 240}); // the hints of tables are large
  whole->setChildrenCollapsible(false);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->addLayout(head);
  layout->addLayout(work);
  layout->addWidget(whole, 1);
  showWork(false, {});
  resizeOnScreen(*this, {1240, 860});
}

void ComparisonWindow::setApproaches(const std::vector<std::string>& names,
                                     const std::array<std::string, 2>& chosen)
{
  for (std::size_t n = 0; n < m_choices.size(); ++n)
  {
    const QSignalBlocker blocker(m_choices[n]);
    m_choices[n]->clear();
    for (const std::string& name : names)
      m_choices[n]->addItem(approachName(name), words(name));
    m_choices[n]->setCurrentIndex(m_choices[n]->findData(words(chosen[n])));
  }
  m_table->setHorizontalHeaderLabels(
      {tr("Quantity"), approachName(chosen[0]), approachName(chosen[1])});
}

void ComparisonWindow::setStamp(const QString& text)
{
  m_stamp = text;
  stampViews();
}

// A picture names the approach that it shows; of both in one, the legend tells.
void ComparisonWindow::stampViews()
{
  for (std::size_t n = 0; n < m_views.size(); ++n)
  {
    QStringList parts;
    if (m_comparison && !showsDifference())
      parts += approachName(m_comparison->sides[n].name);
    if (!m_stamp.isEmpty())
      parts += m_stamp;
    m_views[n]->setStamp(parts.join(QString::fromUtf8(" · ")));
  }
}

void ComparisonWindow::setCamera(const core::CameraPose& camera)
{
  m_views[0]->setCamera(camera);
}

void ComparisonWindow::setProgress(double fraction, const QString& left)
{
  m_progress->setFormat(withTimeLeft(tr("Comparing, %p %"), left));
  m_progress->setValue(percent(fraction));
  showWork(true, {});
}

void ComparisonWindow::fail(const QString& why)
{
  showWork(false, why);
}

void ComparisonWindow::stop()
{
  showWork(false, tr("Comparing was stopped."));
}

// Views without a picture yet say why they are black.
void ComparisonWindow::showWork(bool working, const QString& fault)
{
  m_progress->setVisible(working);
  m_cancel->setVisible(working);
  m_fault->setText(fault);
  m_fault->setVisible(!fault.isEmpty());
  m_again->setVisible(!fault.isEmpty());
  QStringList notes;
  if (!m_comparison)
    notes += working ? tr("Comparing; the picture comes after that") : tr("Not compared");
  for (ThreeDView* view : m_views)
    view->setNotes(notes);
}

void ComparisonWindow::setComparison(
    const rendering::SceneContents& contents,
    const std::shared_ptr<const presenters::ApproachComparison>& comparison)
{
  m_contents = contents;
  m_contents.tool.reset();
  m_comparison = comparison;
  showWork(false, {});
  draw();
  fillTable();
}

bool ComparisonWindow::showsDifference() const
{
  return m_difference->isChecked();
}

void ComparisonWindow::draw()
{
  if (!m_comparison)
    return;
  stampViews();
  const auto& sides = m_comparison->sides;
  const bool isDifference = showsDifference();
  m_views[1]->setVisible(!isDifference);
  QStringList legend;
  if (isDifference)
  {
    const auto& colors = presenters::kDifferenceColors;
    legend = QStringList{colored(colors[0], tr("only %1").arg(approachName(sides[0].name))),
                         colored(colors[1], tr("only %1").arg(approachName(sides[1].name))),
                         colored(colors[2], tr("both"))};
    rendering::SceneContents contents = m_contents;
    presenters::showDifference(contents, *m_comparison);
    m_views[0]->display().setContents(contents);
  }
  else
    for (std::size_t n = 0; n < m_views.size(); ++n)
    {
      rendering::SceneContents contents = m_contents;
      contents.mask = sides[n].mask;
      m_views[n]->display().setContents(contents);
    }
  m_legend->setText(legend.join("&nbsp;&nbsp; "));
}

void ComparisonWindow::addRow(const QString& what, const QString& first, const QString& second,
                              const QString& tip)
{
  const int row = m_table->rowCount();
  m_table->insertRow(row);
  const QString texts[] = {what, first, second};
  for (int column = 0; column < 3; ++column)
  {
    auto* item = new QTableWidgetItem(texts[column]);
    item->setTextAlignment((column == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    item->setToolTip(tip);
    m_table->setItem(row, column, item);
  }
}

void ComparisonWindow::fillTable()
{
  const auto& [a, b] = m_comparison->sides;
  m_table->setRowCount(0);
  m_table->setHorizontalHeaderLabels({tr("Quantity"), approachName(a.name), approachName(b.name)});
  const auto count = [](std::size_t strokes) { return QString::number(strokes); };
  addRow(tr("Strokes, %1 in common").arg(m_comparison->commonStrokes), count(a.strokes),
         count(b.strokes));
  addRow(tr("Drilling time"), durationText(a.drilling), durationText(b.drilling));
  addRow(tr("Removed"), volumeText(a.removed), volumeText(b.removed));
  addRow(tr("Removed there alone"), volumeText(a.only), volumeText(b.only));
  addRow(tr("Removed in both"), volumeText(m_comparison->both), volumeText(m_comparison->both));
  for (const std::string& name : namesOf(a.injured, b.injured))
    addRow(tr("Removed of %1").arg(shownName(name)), found(a.injured, name, 2, tr("mm³")),
           found(b.injured, name, 2, tr("mm³")));
  for (const std::string& name : namesOf(a.exposed, b.exposed))
    addRow(tr("Exposed of %1").arg(shownName(name)), found(a.exposed, name, 1, tr("mm²")),
           found(b.exposed, name, 1, tr("mm²")));
  for (const auto& [name, uncertainty] : m_comparison->uncertainties)
    addRow(tr("Distance to %1").arg(shownName(name)), distanceText(a, name, uncertainty),
           distanceText(b, name, uncertainty),
           tr("From the walls of what was removed to the structure's surface"));
  m_table->resizeRowsToContents();
}

void ComparisonWindow::keyPressEvent(QKeyEvent* event)
{
  if (event->key() == Qt::Key_Escape)
    close();
  else
    QWidget::keyPressEvent(event);
}

void ComparisonWindow::closeEvent(QCloseEvent* event)
{
  event->accept();
  emit closed();
}

} // namespace petrous::workstation
