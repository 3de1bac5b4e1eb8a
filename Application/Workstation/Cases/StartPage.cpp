#include "StartPage.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include <QApplication>
#include <QFile>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QListView>
#include <QPainter>
#include <QPushButton>
#include <QStyledItemDelegate>
#include <QVBoxLayout>

#include "Application.h"
#include "CasesModel.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Library/CaseSearch.h"
#include "petrous/Presenters/WorkstationModel.h"

namespace petrous::workstation
{

namespace
{

constexpr std::size_t kRecent = 12;
constexpr QSize kPicture{128, 96}; // px
constexpr QSize kTile{372, 116};   // px
constexpr int kMargin = 10;        // px

/// A case as a tile: its picture, and beside it the name, side and planned date, when it was
/// changed, and its tags.
class CaseTile : public QStyledItemDelegate
{
public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override { return kTile; }

  void paint(QPainter* painter, const QStyleOptionViewItem& option,
             const QModelIndex& index) const override
  {
    const auto& one = static_cast<const CasesModel&>(*index.model()).at(index.row());
    const bool chosen = (option.state & QStyle::State_Selected) != 0;
    const QPalette& palette = option.palette;
    const QRect tile = option.rect.adjusted(3, 3, -3, -3);
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setBrush(palette.color(QPalette::Base));
    const bool marked = chosen && (option.state & QStyle::State_HasFocus) != 0;
    painter->setPen(QPen(palette.color(marked   ? QPalette::Link
                                       : chosen ? QPalette::Highlight
                                                : QPalette::Button),
                         marked ? 2.0 : 1.0));
    painter->drawRoundedRect(QRectF(tile).adjusted(0.5, 0.5, -0.5, -0.5), 5.0, 5.0);
    const QRect frame(tile.topLeft() + QPoint(6, 7), kPicture);
    painter->fillRect(frame, palette.color(QPalette::AlternateBase));
    const auto picture = index.data(Qt::DecorationRole).value<QPixmap>();
    painter->drawPixmap(
        frame.center() - QPoint(picture.width() / 2, picture.height() / 2) + QPoint(1, 1), picture);

    QRect text = tile.adjusted(kPicture.width() + 6 + kMargin, 8, -kMargin, -6);
    const auto line = [&](const QString& what, const QFont& font, const QColor& color)
    {
      if (what.isEmpty())
        return;
      painter->setFont(font);
      painter->setPen(color);
      const QFontMetrics metrics(font);
      painter->drawText(text, Qt::AlignLeft | Qt::AlignTop | Qt::TextSingleLine,
                        metrics.elidedText(what, Qt::ElideRight, text.width()));
      text.setTop(text.top() + metrics.lineSpacing() + 3);
    };
    QFont bold = option.font;
    bold.setBold(true);
    const QColor dim = palette.color(QPalette::PlaceholderText);
    line(caseName(one.name), bold, palette.color(QPalette::WindowText));
    line(operationText(one), option.font, palette.color(QPalette::WindowText));
    line(StartPage::tr("changed %1").arg(localTime(one.modified)), option.font, dim);
    line(listed(one.description.tags), option.font, dim);
    painter->restore();
  }
};

} // namespace

StartPage::StartPage(const presenters::WorkstationModel& model, QWidget* parent)
  : QWidget(parent)
  , m_model(model)
  , m_cases(new CasesModel(this))
  , m_heading(new QLabel(tr("Recent cases")))
  , m_trouble(new QLabel)
  , m_busy(new QLabel)
  , m_recent(new QListView)
{
  auto* title = new QLabel(tr("Drop a folder of DICOM here, or choose File > Open DICOM…"));
  title->setObjectName("big");
  title->setAlignment(Qt::AlignCenter);
  wrapWords(*title);
  auto* more = new QLabel(tr("A CT of the temporal bone becomes a case at once. NRRD, NIfTI and "
                             "MetaImage files work too.\nNothing leaves this computer."));
  more->setObjectName("dim");
  more->setAlignment(Qt::AlignCenter);
  wrapWords(*more);

  auto* sample = new QPushButton(tr("Make the sample patient"));
  sample->setObjectName("primary");
  sample->setToolTip(tr("Computes an artificial right temporal bone (0.3 mm voxels) and opens it"));
  auto* folder = new QPushButton(tr("Open DICOM…"));
  folder->setToolTip(tr("A folder of CT slices: a new case"));
  auto* known = new QPushButton(tr("Open case…"));
  known->setToolTip(tr("The list of all cases, with a search"));
  auto* archive = new QPushButton(tr("Restore…"));
  archive->setObjectName("restoreArchive");
  archive->setToolTip(tr("Brings the case of an archive (.petrous) to the library and opens it"));
  connect(archive, &QPushButton::clicked, this, &StartPage::restoreAsked);
  connect(sample, &QPushButton::clicked, this, &StartPage::sampleAsked);
  connect(folder, &QPushButton::clicked, this, &StartPage::openFolderAsked);
  connect(known, &QPushButton::clicked, this, &StartPage::openCaseAsked);
  m_begin = sample;

  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(10);
  buttons->addStretch();
  buttons->addWidget(folder);
  buttons->addWidget(known);
  buttons->addWidget(archive);
  buttons->addWidget(sample);
  buttons->addStretch();
  auto* place = new QFrame;
  place->setObjectName("dropPlace");
  auto* inside = new QVBoxLayout(place);
  inside->setContentsMargins(20, 22, 20, 22);
  inside->setSpacing(14);
  inside->addWidget(title);
  inside->addWidget(more);
  inside->addLayout(buttons);

  m_cases->setPictureSize(kPicture);
  m_cases->library = [this] { return m_model.library(); };
  connect(&m_work, &BackgroundWork::failed, this,
          [this](const QString& why)
          {
            m_listed = {};
            showCases({});
            tell(tr("The cases cannot be listed: %1").arg(sentence(why)));
          });
  m_place = place;
  m_busy->setObjectName("startBusy");
  m_busy->setAlignment(Qt::AlignCenter);
  m_busy->setTextFormat(Qt::PlainText);
  m_busy->hide();
  m_heading->setObjectName("big");
  m_recent->setObjectName("recentCases");
  m_recent->setAccessibleName(tr("Recent cases"));
  m_recent->setModel(m_cases);
  m_recent->setItemDelegate(new CaseTile(m_recent));
  m_recent->setViewMode(QListView::IconMode);
  m_recent->setMovement(QListView::Static);
  m_recent->setResizeMode(QListView::Adjust);
  m_recent->setGridSize(kTile);
  m_recent->setUniformItemSizes(true);
  m_recent->setFrameShape(QFrame::NoFrame);
  m_recent->viewport()->setAutoFillBackground(false);
  m_recent->setAcceptDrops(false);
  m_recent->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  m_recent->setTabKeyNavigation(false);
  connect(m_recent, &QListView::activated, this,
          [this](const QModelIndex& index) { open(index.row()); }); // a double click, Enter
  m_trouble->setObjectName("recentTrouble");
  m_trouble->setTextFormat(Qt::PlainText);
  wrapWords(*m_trouble);
  m_trouble->setStyleSheet(kWarningStyle);
  m_trouble->hide();
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(24, 20, 24, 12);
  layout->setSpacing(12);
  layout->addStretch(1);
  layout->addWidget(place);
  layout->addWidget(m_busy);
  layout->addWidget(m_heading);
  layout->addWidget(m_trouble);
  layout->addWidget(m_recent, 8);
  layout->addStretch(1);
  setTabOrder(m_recent, folder);
}

void StartPage::onSeen(std::function<void(const library::CaseSummary&)> seen)
{
  m_cases->seen = std::move(seen);
}

void StartPage::pictureDrawn(const std::string& id)
{
  m_cases->pictureDrawn(id);
}

void StartPage::refresh()
{
  if (isVisible())
    list();
}

void StartPage::showEvent(QShowEvent* event)
{
  QWidget::showEvent(event);
  m_takesFocus = true;
  (m_recent->isHidden() ? m_begin : m_recent)->setFocus();
  list();
}

// A medium may have been taken away, or another program deleted the case, since it was listed.
void StartPage::open(int row)
{
  if (row < 0 || row >= m_cases->rowCount())
    return;
  const std::string name = m_cases->at(row).name;
  m_listed = [this, name]
  {
    if (m_cases->rowOf(name) >= 0)
      return emit caseAsked(words(name));
    const std::filesystem::path& folder = m_model.library().folder();
    const QString place = QFile::decodeName(folder.c_str());
    tell(std::filesystem::exists(folder)
             ? tr("The case “%1” is no longer in the library %2.").arg(caseName(name), place)
             : tr("The case “%1” cannot be opened: the folder %2 is gone. Is its disk connected?")
                   .arg(caseName(name), place));
  };
  list();
}

// The focus waits here, as it would otherwise go on to the window's numbers.
void StartPage::setBusy(const QString& what)
{
  const bool isBusy = !what.isEmpty();
  m_busy->setText(what);
  m_busy->setVisible(isBusy);
  if (isBusy && focusWidget() && focusWidget()->hasFocus())
    setFocus();
  m_place->setEnabled(!isBusy);
  m_recent->setEnabled(!isBusy);
  if (!isBusy && hasFocus())
    (m_recent->isHidden() ? m_begin : m_recent)->setFocus();
}

void StartPage::tell(const QString& trouble)
{
  m_trouble->setText(trouble);
  m_trouble->setVisible(!trouble.isEmpty());
}

void StartPage::list()
{
  m_work.replace(
      [this, library = m_model.library()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        std::set<std::string> tags;
        auto cases = library::searchCases(library, {}, tags, progress);
        cases.erase(std::remove_if(cases.begin(), cases.end(),
                                   [](const library::CaseSummary& one) { return one.damaged; }),
                    cases.end());
        std::stable_sort(cases.begin(), cases.end(),
                         [](const auto& a, const auto& b) { return a.modified > b.modified; });
        cases.resize(std::min(cases.size(), kRecent));
        return [this, cases = std::move(cases)]
        {
          showCases(cases);
          if (const auto listed = std::exchange(m_listed, {}))
            listed();
        };
      });
}

void StartPage::showCases(std::vector<library::CaseSummary> cases)
{
  tell({});
  const bool takesFocus = std::exchange(m_takesFocus, false) &&
                          (m_begin->hasFocus() || m_recent->hasFocus() || !focusWidget());
  m_cases->setCases(std::move(cases), {});
  const bool any = m_cases->rowCount() > 0;
  m_heading->setVisible(any);
  m_recent->setVisible(any);
  if (any)
    m_recent->setCurrentIndex(m_cases->index(0, 0));
  if (takesFocus)
    (any ? m_recent : m_begin)->setFocus();
}

} // namespace petrous::workstation
