#include "SeriesDialog.h"

#include <algorithm>

#include <QCheckBox>
#include <QComboBox>
#include <QDate>
#include <QDialogButtonBox>
#include <QEvent>
#include <QFile>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "AxesDialog.h"
#include "Language.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

using presenters::Content;
using presenters::SeriesContent;

namespace
{

enum Column
{
  Series,
  More, // what tells series of one description apart: never scrolled out of sight
  Images,
  Voxel,
  Taken,
  VerdictColumn,
  Axes, // a QComboBox
  Columns
};

// "20200131 1205" as "2020-01-31 12:05"; other formats unchanged.
QString takenIn(const QString& text)
{
  const QStringList parts = text.split(' ');
  const QDate day = QDate::fromString(parts.front(), "yyyyMMdd");
  if (!day.isValid())
    return text;
  const QTime time = parts.size() > 1 ? QTime::fromString(parts[1], "HHmm") : QTime();
  return day.toString(Qt::ISODate) + (time.isValid() ? time.toString(" HH:mm") : QString());
}

// What parts beside the series have to do with its images.
QString placeText(const SeriesContent& part, const std::vector<SeriesContent>& all)
{
  if (part.isDicom)
    return SeriesDialog::tr("structures");
  if (part.content == Content::Mesh)
    return SeriesDialog::tr("surface");
  const auto image = std::find_if(all.begin(), all.end(),
                                  [&part](const SeriesContent& one)
                                  { return !part.image.empty() && one.selector == part.image; });
  if (image == all.end())
    return SeriesDialog::tr("structures on another grid");
  const QString kind = image->modality.empty() ? SeriesDialog::tr("image") : words(image->modality);
  const bool isOneOfSeveral =
      std::count_if(all.begin(), all.end(),
                    [image](const SeriesContent& one)
                    { return one.files.empty() && one.modality == image->modality; }) > 1;
  return isOneOfSeveral && !image->description.empty()
             ? SeriesDialog::tr("structures on the grid of the %1 “%2”")
                   .arg(kind, words(image->description))
             : SeriesDialog::tr("structures on the grid of the %1").arg(kind);
}

QString verdictText(const SeriesContent& series)
{
  switch (series.verdict)
  {
  case imaging::Verdict::Ok:
    return SeriesDialog::tr("sound");
  case imaging::Verdict::Repairable:
    return SeriesDialog::tr("needs repair");
  case imaging::Verdict::Refused:
    break;
  }
  return SeriesDialog::tr("cannot be used");
}

void fillLine(QTreeWidgetItem& line, const SeriesContent& series,
              const std::vector<SeriesContent>& all)
{
  const bool isPart = !series.files.empty();
  const auto spacing = [&series](Eigen::Index axis)
  { return numberLocale().toString(series.spacing[axis], 'g', 3); };
  const QString description = series.description.empty() ? SeriesDialog::tr("without a description")
                                                         : words(series.description);
  line.setText(Series, (words(series.modality) + "  " + description).trimmed());
  if (!isPart)
    line.setText(Images, QString::number(series.slices));
  line.setTextAlignment(Images, Qt::AlignRight | Qt::AlignVCenter);
  if (series.spacing[0] > 0.0)
    line.setText(Voxel,
                 SeriesDialog::tr("%1 × %2 × %3 mm").arg(spacing(0), spacing(1), spacing(2)));
  line.setText(Taken, takenIn(words(series.taken)));
  QStringList more;
  for (const std::string& one : {series.patientPosition, series.kernel})
    if (!one.empty())
      more += phrase(one);
  if (!series.folder.empty())
    more += (series.isBeside ? SeriesDialog::tr("beside it in “%1”") : SeriesDialog::tr("in “%1”"))
                .arg(QFile::decodeName(series.folder.c_str()));
  if (isPart)
    more += words(series.what);
  line.setText(More, more.join(", "));
  line.setText(VerdictColumn, isPart ? placeText(series, all) : verdictText(series));
  QStringList why;
  for (const imaging::Finding& finding : series.findings)
    why += phrase(finding.text);
  constexpr std::size_t kPaths = 6; // in a tool tip
  for (std::size_t n = 0; n < series.files.size() && n <= kPaths; ++n)
    why += n == kPaths ? QString::fromUtf8("…") : QFile::decodeName(series.files[n].c_str());
  for (int column = 0; column < Columns; ++column)
    line.setToolTip(column, why.isEmpty() ? line.text(column) : why.join('\n'));
  if (series.verdict == imaging::Verdict::Refused)
    line.setDisabled(true);
  else
    line.setCheckState(Series, Qt::Unchecked);
}

} // namespace

SeriesDialog::SeriesDialog(const presenters::SourceContent& source, bool hasCase, QWidget* parent)
  : QDialog(parent)
  , m_series(source.series)
  , m_hasCase(hasCase)
  , m_list(new QTreeWidget)
  , m_region(new QCheckBox(tr("Choose a &region of each image first")))
  , m_advice(new QLabel)
{
  setObjectName("chooseSeries");
  setWindowTitle(tr("Which series?"));
  const auto path = source.path.lexically_normal();
  auto* title = new QLabel(
      tr("“%1” holds more than one series or volume, or structures beside it. A CT begins a case; "
         "MRs, structures and meshes go with it, or come to the open case.")
          .arg(QFile::decodeName(
              (path.has_filename() ? path : path.parent_path()).filename().c_str())));
  title->setTextFormat(Qt::PlainText);
  wrapWords(*title);
  m_list->setObjectName("series");
  m_list->setRootIsDecorated(false);
  m_list->setAlternatingRowColors(true);
  m_list->setHeaderLabels({tr("Series"), tr("Position, kernel, folder"), tr("Images"), tr("Voxel"),
                           tr("Taken"), tr("Geometry"), tr("Axes")});
  for (const SeriesContent& series : m_series)
  {
    auto* line = new QTreeWidgetItem(m_list);
    fillLine(*line, series, m_series);
    if (!line->isDisabled())
      addAxes(*line, series);
  }
  constexpr int kWidest = 420; // px, of a column; longer texts are in its tooltip
  m_list->header()->setStretchLastSection(false);
  m_list->header()->setMaximumSectionSize(kWidest);
  m_list->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  m_region->setObjectName("wantsRegion");
  m_region->setToolTip(tr("Only that region is read: a whole head then takes no more memory than "
                          "the ear alone"));
  m_advice->setObjectName("dim");
  wrapWords(*m_advice);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel);
  m_open = buttons->button(QDialogButtonBox::Open);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(m_list, &QTreeWidget::itemChanged, this,
          [this](QTreeWidgetItem* item)
          {
            keepOneCt(*item);
            check();
          });
  connect(m_list, &QTreeWidget::itemDoubleClicked, this,
          [this](QTreeWidgetItem* item)
          {
            if (item->isDisabled())
              return;
            for (int n = 0; n < m_list->topLevelItemCount(); ++n)
              if (auto* other = m_list->topLevelItem(n); !other->isDisabled())
                other->setCheckState(Series, other == item ? Qt::Checked : Qt::Unchecked);
            if (m_open->isEnabled())
              accept();
          });
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(title);
  layout->addWidget(m_list, 1);
  layout->addWidget(m_advice);
  layout->addWidget(m_region);
  layout->addWidget(buttons);
  proposeTicks();
  check();
  ensurePolished();
  m_list->header()->resizeSections(QHeaderView::ResizeToContents);
  const QMargins margins = layout->contentsMargins();
  const int around = margins.left() + margins.right() + 2 * m_list->frameWidth() +
                     m_list->verticalScrollBar()->sizeHint().width();
  resizeOnScreen(*this, {std::max(860, m_list->header()->length() + around), 380});
}

// What was drawn on an image follows its axes unless it is said to lie where it belongs.
void SeriesDialog::addAxes(QTreeWidgetItem& line, const SeriesContent& series)
{
  auto* axes = new QComboBox;
  axes->setAccessibleName(tr("Axes"));
  axes->setToolTip(
      tr("For a file that states wrong axes. What else can be wrong, and how the image "
         "then looks, is in Case > Correct the axes…"));
  if (series.content == Content::Labels || series.content == Content::Mesh)
  {
    axes->addItem(tr("as its image"));
    axes->setItemData(0, tr("It follows a correction of the image on which it was drawn"),
                      Qt::ToolTipRole);
    axes->addItem(tr("as the file states"), words(core::AxesCorrection().letters()));
    axes->setItemData(1, tr("It lies where it belongs, whatever is wrong with its image"),
                      Qt::ToolTipRole);
  }
  else
    axes->addItem(tr("as the file states"));
  for (const CommonCorrection& common : commonCorrections())
  {
    axes->addItem(QString(common.text).remove('&'), words(common.axes.letters()));
    axes->setItemData(axes->count() - 1, common.tip, Qt::ToolTipRole);
  }
  axes->setFocusPolicy(Qt::StrongFocus);
  axes->installEventFilter(this);
  m_list->setItemWidget(&line, Axes, axes);
}

// The wheel scrolls the list, and changes no axes that the pointer happens to be on.
bool SeriesDialog::eventFilter(QObject* watched, QEvent* event)
{
  if (event->type() != QEvent::Wheel)
    return QDialog::eventFilter(watched, event);
  event->ignore();
  return true;
}

bool SeriesDialog::isChosen(std::size_t series) const
{
  return m_list->topLevelItem(static_cast<int>(series))->checkState(Series) == Qt::Checked;
}

std::vector<std::optional<core::AxesCorrection>> SeriesDialog::axes() const
{
  std::vector<std::optional<core::AxesCorrection>> all;
  for (std::size_t n = 0; n < m_series.size(); ++n)
    if (isChosen(n))
    {
      const auto* choice = static_cast<const QComboBox*>(
          m_list->itemWidget(m_list->topLevelItem(static_cast<int>(n)), Axes));
      const QString letters = choice->currentData().toString();
      all.push_back(letters.isEmpty()
                        ? std::nullopt
                        : std::optional(core::AxesCorrection::parse(letters.toStdString())));
    }
  return all;
}

// The only sound CT is what is most likely wanted, with the structures that lie below it on its
// grid; of several sources of structures none, as they may hold the same.
void SeriesDialog::proposeTicks()
{
  const auto tickOnly = [this](const auto& isMeant)
  {
    const auto first = std::find_if(m_series.begin(), m_series.end(), isMeant);
    if (std::count_if(m_series.begin(), m_series.end(), isMeant) != 1)
      return std::string();
    m_list->topLevelItem(static_cast<int>(first - m_series.begin()))
        ->setCheckState(Series, Qt::Checked);
    return first->selector;
  };
  const std::string ct =
      tickOnly([](const SeriesContent& series)
               { return series.content == Content::Ct && series.verdict == imaging::Verdict::Ok; });
  const auto isLabels = [](const SeriesContent& part) { return part.content == Content::Labels; };
  if (!ct.empty() && std::count_if(m_series.begin(), m_series.end(), isLabels) == 1)
    tickOnly([&](const SeriesContent& part)
             { return isLabels(part) && part.image == ct && !part.isBeside; });
}

std::vector<SeriesContent> SeriesDialog::chosen() const
{
  std::vector<SeriesContent> chosen;
  for (std::size_t n = 0; n < m_series.size(); ++n)
    if (isChosen(n))
      chosen.push_back(m_series[n]);
  return chosen;
}

bool SeriesDialog::wantsRegion() const
{
  return m_region->isEnabled() && m_region->isChecked();
}

// A tick at a CT takes it from another one.
void SeriesDialog::keepOneCt(QTreeWidgetItem& changed)
{
  const auto isCt = [this](int row)
  { return m_series[static_cast<std::size_t>(row)].content == Content::Ct; };
  const int row = m_list->indexOfTopLevelItem(&changed);
  if (row < 0 || !isCt(row) || changed.checkState(Series) != Qt::Checked)
    return;
  const QSignalBlocker quiet(m_list);
  for (int n = 0; n < m_list->topLevelItemCount(); ++n)
    if (auto* other = m_list->topLevelItem(n); n != row && isCt(n) && !other->isDisabled())
      other->setCheckState(Series, Qt::Unchecked);
}

void SeriesDialog::check()
{
  const auto all = chosen();
  const auto count = [&all](Content content)
  {
    return std::count_if(all.begin(), all.end(),
                         [content](const SeriesContent& series)
                         { return series.content == content; });
  };
  const auto cts = count(Content::Ct);
  QString advice;
  if (all.empty())
    advice =
        tr("Nothing is ticked: tick what is to be opened. Why a series cannot be used, or what "
           "its repair would change, is in its tooltip.");
  else if (cts == 0 && count(Content::Image) == 0 && !m_hasCase)
    advice = tr("No case is open, and one begins with the patient's CT; tick that, too.");
  m_advice->setText(advice);
  m_open->setEnabled(!all.empty() && advice.isEmpty());
  m_region->setEnabled(advice.isEmpty() && cts + count(Content::Mr) + count(Content::Image) > 0);
}

} // namespace petrous::workstation
