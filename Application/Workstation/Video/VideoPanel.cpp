#include "VideoPanel.h"

#include <algorithm>
#include <utility>

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QTableWidget>
#include <QTimer>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "PanelLayout.h"
#include "Theme.h"
#include "VideoPicture.h"
#include "WindowTexts.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/VideoEditor.h"

namespace petrous::workstation
{

namespace
{

enum BookmarkColumn
{
  BookmarkName,
  BookmarkTime,
  BookmarkStroke,
  BookmarkColumns
};

QToolButton* buttonOf(QAction* action, const char* name)
{
  auto* button = new QToolButton;
  button->setDefaultAction(action);
  button->setObjectName(name);
  button->setFocusPolicy(Qt::TabFocus);
  return button;
}

// Narrower than a push button.
QToolButton* narrow(const QString& text, const char* name, const QString& tip)
{
  auto* button = new QToolButton;
  button->setText(text);
  button->setObjectName(name);
  button->setToolTip(tip);
  button->setFocusPolicy(Qt::TabFocus);
  return button;
}

} // namespace

VideoPanel::VideoPanel(const presenters::WorkstationModel& model, presenters::VideoEditor& editor,
                       const Actions& actions, QWidget* parent)
  : Panel(parent)
  , m_model(model)
  , m_editor(editor)
  , m_videos(choiceBox("videoChoice", tr("The attached video that is shown")))
  , m_picture(new VideoPicture)
  , m_place(new QSlider(Qt::Horizontal))
  , m_time(new QLabel)
  , m_fault(new QLabel)
  , m_bookmarks(new QTreeWidget)
  , m_pairs(new QTableWidget)
  , m_camera(new QLabel)
  , m_overlay(new QCheckBox(tr("&Over the 3D view")))
  , m_opacity(percentSlider("stillOpacity", tr("Opacity of the still over the 3D view")))
{
  auto* attach = narrow(tr("&Attach…"), "videoAttach",
                        tr("A video goes with the case, copied or linked (Case > Attach…)"));
  m_videos->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  m_videos->setMinimumContentsLength(8);
  auto* top = new QHBoxLayout;
  top->addWidget(m_videos, 1);
  top->addWidget(attach);

  m_place->setObjectName("videoPlace");
  m_place->setAccessibleName(tr("Place in the video"));
  m_place->setToolTip(tr("Place in the video"));
  m_place->setPageStep(10000);
  m_place->setSingleStep(1000);
  m_time->setObjectName("videoTime");
  auto* row = new QHBoxLayout;
  row->addWidget(buttonOf(actions.back, "videoBack"));
  row->addWidget(buttonOf(actions.play, "videoPlay"));
  row->addWidget(buttonOf(actions.forth, "videoForth"));
  row->addWidget(m_place, 1);
  row->addWidget(m_time);
  m_fault->setObjectName("videoFault");
  wrapWords(*m_fault);
  m_fault->setTextFormat(Qt::PlainText);
  m_fault->hide();

  auto* whole = new QWidget;
  auto* layout = new QVBoxLayout(whole);
  layout->setContentsMargins(10, 8, 10, 8);
  layout->addLayout(top);
  layout->addWidget(m_picture, 3);
  layout->addLayout(row);
  layout->addWidget(m_fault);
  addBookmarks(*layout, actions);
  addStill(*layout, actions);
  layOutPanel(*this, whole, new QWidget);

  connect(attach, &QToolButton::clicked, this, &VideoPanel::attachAsked);
  connect(m_videos, qOverload<int>(&QComboBox::activated), this,
          [this](int at) { emit videoChosen(m_videos->itemData(at).toString()); });
  connect(m_place, &QSlider::valueChanged, this,
          [this](int at)
          {
            if (!m_refreshing)
              emit seekAsked(at);
          });
  refresh();
}

void VideoPanel::addBookmarks(QVBoxLayout& layout, const Actions& actions)
{
  m_bookmarks->setObjectName("bookmarks");
  m_bookmarks->setAccessibleName(tr("Bookmarks"));
  m_bookmarks->setColumnCount(BookmarkColumns);
  m_bookmarks->setHeaderLabels({tr("Bookmark"), tr("Time"), tr("After stroke")});
  m_bookmarks->setRootIsDecorated(false);
  m_bookmarks->setUniformRowHeights(true);
  m_bookmarks->setSelectionMode(QAbstractItemView::ExtendedSelection);
  m_bookmarks->setEditTriggers(QAbstractItemView::EditKeyPressed |
                               QAbstractItemView::SelectedClicked);
  m_bookmarks->setToolTip(tr("Return or a double click goes there; where a bookmark is tied to a "
                             "stroke, the dissection is shown as it is after it"));
  m_bookmarks->header()->setSectionResizeMode(BookmarkName, QHeaderView::Stretch);
  m_bookmarks->header()->setSectionResizeMode(BookmarkTime, QHeaderView::ResizeToContents);
  m_bookmarks->header()->setSectionResizeMode(BookmarkStroke, QHeaderView::ResizeToContents);
  m_bookmarks->header()->setStretchLastSection(false);
  m_bookmarks->setMinimumHeight(70);
  keepKeysInEditors(*m_bookmarks);

  auto* move = narrow(tr("&Move here"), "bookmarkMove", tr("To the frame that is seen"));
  auto* tie = narrow(tr("&Tie"), "bookmarkTie", tr("To the last stroke, or from any stroke"));
  auto* remove = narrow(tr("&Remove"), "bookmarkRemove", tr("Takes the bookmark out"));
  m_ofBookmark = {move, tie, remove};
  auto* row = new QHBoxLayout;
  row->addWidget(buttonOf(actions.bookmark, "bookmarkAdd"));
  for (QToolButton* one : m_ofBookmark)
    row->addWidget(one);
  row->addWidget(buttonOf(actions.loop, "videoLoop"));
  row->addStretch(1);
  layout.addWidget(m_bookmarks, 1);
  layout.addLayout(row);

  // The selected one: after Ctrl and a click the current one may be another.
  const auto chosen = [this]
  {
    const auto rows = chosenBookmarks();
    return rows.size() == 1 ? static_cast<int>(rows.front()) : -1;
  };
  connect(move, &QToolButton::clicked, this, [=] { emit moveAsked(chosen()); });
  connect(tie, &QToolButton::clicked, this, [=] { emit tieAsked(chosen()); });
  connect(remove, &QToolButton::clicked, this, [=] { emit bookmarkRemovalAsked(chosen()); });
  connect(m_bookmarks, &QTreeWidget::itemActivated, this,
          [this](QTreeWidgetItem* item)
          { emit bookmarkActivated(m_bookmarks->indexOfTopLevelItem(item)); });
  connect(m_bookmarks, &QTreeWidget::itemSelectionChanged, this, &VideoPanel::enableBookmarks);
  connect(m_bookmarks, &QTreeWidget::itemChanged, this,
          [this](QTreeWidgetItem* item, int column)
          {
            if (m_refreshing || column != BookmarkName)
              return;
            // The list is made anew, which an item in the midst of its change would not survive.
            const int at = m_bookmarks->indexOfTopLevelItem(item);
            QTimer::singleShot(0, this,
                               [this, at, name = item->text(BookmarkName)]
                               { emit bookmarkRenamed(at, name); });
          });
}

void VideoPanel::addStill(QVBoxLayout& layout, const Actions& actions)
{
  m_pairs->setObjectName("stillPairs");
  m_pairs->setAccessibleName(tr("Landmarks of the still"));
  m_pairs->setColumnCount(2);
  m_pairs->setHorizontalHeaderLabels({tr("Patient, mm"), tr("Residual")});
  m_pairs->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  m_pairs->horizontalHeader()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  m_pairs->verticalHeader()->setDefaultSectionSize(22);
  m_pairs->setSelectionBehavior(QAbstractItemView::SelectRows);
  m_pairs->setSelectionMode(QAbstractItemView::SingleSelection);
  m_pairs->setEditTriggers(QAbstractItemView::NoEditTriggers);
  m_pairs->setMinimumHeight(70);
  m_removePair = narrow(tr("Re&move"), "pairRemove", tr("The landmark that is chosen"));
  m_removeStill = narrow(tr("Remove all"), "stillRemove", tr("All landmarks of this still"));
  auto* angle = m_bound.add(
      numberBox("stillAngle",
                tr("Vertical angle of view, if it is known: then four landmarks are enough"),
                {0.0, 120.0, tr("°"), 2, 0.0, tr("to be found")}),
      [this]
      {
        const auto* still = m_editor.still();
        return still ? still->viewAngle.value_or(0.0) : 0.0;
      },
      [this](double degrees) { emit angleSet(degrees); });
  m_bound.add(
      m_opacity, [this] { return m_editor.still() ? percent(m_editor.still()->opacity) : 50; },
      [this](int shown) { emit opacitySet(shown / 100.0); }, Bindings::kSettle);
  m_overlay->setObjectName("stillOverlayShown");
  m_overlay->setToolTip(tr("The still lies over the 3D view while that is the still's own view"));
  m_camera->setObjectName("stillCamera");
  wrapWords(*m_camera);
  m_camera->setTextFormat(Qt::PlainText);

  auto* box = new QGroupBox(tr("Where the still was taken from"));
  auto* within = new QVBoxLayout(box);
  auto* first = new QHBoxLayout;
  first->addWidget(buttonOf(actions.pair, "pairAdd"));
  first->addWidget(m_removePair);
  first->addWidget(m_removeStill);
  first->addStretch(1);
  auto* second = new QHBoxLayout;
  auto* label = new QLabel(tr("An&gle of view"));
  label->setBuddy(angle);
  second->addWidget(label);
  second->addWidget(angle);
  second->addStretch(1);
  auto* third = new QHBoxLayout;
  third->addWidget(buttonOf(actions.view, "stillView"));
  third->addWidget(m_overlay);
  third->addWidget(m_opacity, 1);
  within->addWidget(m_pairs, 1);
  within->addLayout(first);
  within->addLayout(second);
  within->addWidget(m_camera);
  within->addLayout(third);
  layout.addWidget(box, 1);

  connect(m_removePair, &QToolButton::clicked, this,
          [this] { emit pairRemovalAsked(m_pairs->currentRow()); });
  connect(m_removeStill, &QToolButton::clicked, this, &VideoPanel::stillRemovalAsked);
  connect(m_overlay, &QCheckBox::toggled, this,
          [this](bool on)
          {
            if (!m_refreshing)
              emit overlayAsked(on);
          });
}

void VideoPanel::caseChanged()
{
  if (onCaseChanged)
    onCaseChanged();
}

void VideoPanel::stateChanged()
{
  if (onStateChanged)
    onStateChanged();
}

void VideoPanel::attachmentsChanged()
{
  if (onAttachmentsChanged)
    onAttachmentsChanged();
}

void VideoPanel::setDuration(qint64 milliseconds)
{
  m_duration = milliseconds;
  const QSignalBlocker quiet(m_place);
  m_place->setRange(0, static_cast<int>(std::clamp<qint64>(milliseconds, 0, 2000000000)));
}

void VideoPanel::setPlace(std::int64_t nanoseconds)
{
  if (m_duration > 0 && nanoseconds / 1000000 > m_duration) // it states too little
    setDuration(nanoseconds / 1000000);
  const QSignalBlocker quiet(m_place);
  if (!m_place->isSliderDown())
    m_place->setValue(static_cast<int>(nanoseconds / 1000000));
  m_time->setText(numberText(presenters::timeText(nanoseconds)) +
                  (m_duration > 0 ? " / " + numberText(presenters::timeText(m_duration * 1000000))
                                  : QString()));
}

void VideoPanel::setOpening(bool isOpening)
{
  m_isOpening = isOpening;
  refresh();
}

void VideoPanel::say(const QString& text)
{
  m_fault->setText(text);
  m_fault->setVisible(!text.isEmpty());
}

void VideoPanel::setOver(bool isOver)
{
  m_refreshing = true;
  m_overlay->setChecked(isOver);
  m_refreshing = false;
}

std::vector<std::size_t> VideoPanel::chosenBookmarks() const
{
  std::vector<std::size_t> rows;
  for (int n = 0; n < m_bookmarks->topLevelItemCount(); ++n)
    if (m_bookmarks->topLevelItem(n)->isSelected())
      rows.push_back(static_cast<std::size_t>(n));
  return rows;
}

void VideoPanel::refresh()
{
  m_refreshing = true;
  refreshVideos();
  refreshBookmarks();
  refreshStill();
  m_bound.refresh();
  m_refreshing = false;
}

void VideoPanel::refreshAnew()
{
  m_bookmarksShown = QStringList(QString());
  refresh();
}

void VideoPanel::refreshVideos()
{
  const std::vector<std::string> names = m_editor.videos();
  QStringList shown{names.empty() ? tr("No video is attached") : tr("No video")};
  for (const std::string& name : names)
    shown += words(name);
  if (shown != m_namesShown)
  {
    m_namesShown = shown;
    m_videos->clear();
    for (int n = 0; n < shown.size(); ++n)
      m_videos->addItem(shown[n], n == 0 ? QString() : shown[n]);
  }
  m_videos->setCurrentIndex(std::max(m_videos->findData(words(m_editor.video())), 0));
  m_videos->setEnabled(!names.empty() && video::isSupported());
  if (!video::isSupported())
    m_picture->setText(
        tr("Video support was not built: this program was built without GStreamer."));
  else if (m_isOpening)
    m_picture->setText(tr("The video is being opened…"));
  else
    m_picture->setText(names.empty() ? tr("Attach a video of the operation, copied or as a link.")
                                     : tr("Choose a video above."));
  m_place->setEnabled(m_editor.time().has_value());
  if (!m_editor.time())
    m_time->clear();
}

void VideoPanel::refreshBookmarks()
{
  const auto& all = m_editor.notes().bookmarks;
  // They stay chosen by their names, which no others have; one that got another name, by its place.
  std::vector<std::size_t> chosen;
  if (std::exchange(m_bookmarksOf, m_editor.video()) == m_editor.video())
    for (const std::size_t row : chosenBookmarks())
    {
      const std::string name =
          bytes(m_bookmarks->topLevelItem(static_cast<int>(row))->text(BookmarkName));
      const auto named = std::find_if(all.begin(), all.end(),
                                      [&name](const auto& one) { return one.name == name; });
      if (named != all.end())
        chosen.push_back(static_cast<std::size_t>(named - all.begin()));
      else if (static_cast<int>(all.size()) == m_bookmarks->topLevelItemCount())
        chosen.push_back(row);
    }
  const auto here = m_editor.bookmarkHere();
  QStringList shown;
  for (std::size_t n = 0; n < all.size(); ++n)
  {
    const std::size_t stroke = m_editor.strokeOf(n);
    shown += {words(all[n].name), numberText(presenters::timeText(all[n].time)),
              stroke > 0              ? QString::number(stroke)
              : all[n].stroke.empty() ? QString::fromUtf8("–")
                                      : tr("gone"),
              here == n ? "here" : ""};
  }
  if (shown == m_bookmarksShown)
    return enableBookmarks();
  m_bookmarksShown = shown;
  m_bookmarks->clear();
  for (std::size_t n = 0; n < all.size(); ++n)
  {
    auto* item = new QTreeWidgetItem(m_bookmarks);
    item->setFlags(item->flags() | Qt::ItemIsEditable);
    for (int column = 0; column < BookmarkColumns; ++column)
      item->setText(column, shown[4 * static_cast<int>(n) + column]);
    if (here == n)
    {
      QFont bold = item->font(BookmarkName);
      bold.setBold(true);
      item->setFont(BookmarkName, bold);
    }
    if (std::find(chosen.begin(), chosen.end(), n) != chosen.end())
      item->setSelected(true);
  }
  if (!chosen.empty() && chosen.back() < all.size())
    m_bookmarks->setCurrentItem(m_bookmarks->topLevelItem(static_cast<int>(chosen.back())), 0,
                                QItemSelectionModel::Current);
  enableBookmarks();
}

void VideoPanel::enableBookmarks()
{
  const bool isOne = m_editor.time() && chosenBookmarks().size() == 1;
  for (QToolButton* one : m_ofBookmark)
    one->setEnabled(isOne);
}

void VideoPanel::refreshStill()
{
  const auto* still = m_editor.still();
  const auto& fit = m_editor.fit();
  const int row = m_pairs->currentRow();
  m_pairs->setRowCount(still ? static_cast<int>(still->landmarks.size()) : 0);
  std::vector<StillMark> marks;
  for (std::size_t n = 0; still && n < still->landmarks.size(); ++n)
  {
    const auto& one = still->landmarks[n];
    StillMark mark{one.still, std::nullopt, false};
    QString residual = QString::fromUtf8("–");
    if (fit && n < fit->pose.residuals.size())
    {
      mark.isBad = std::find(fit->bad.begin(), fit->bad.end(), n) != fit->bad.end();
      mark.seenAt = presenters::seenAt(fit->pose.camera, still->size, one.patient);
      residual = tr("%1 px").arg(numberText(fit->pose.residuals[n], 1));
      if (mark.isBad)
        residual = tr("%1, does not fit").arg(residual);
    }
    marks.push_back(mark);
    const auto cell = [this, n](int column, const QString& text, bool isBad)
    {
      auto* item = new QTableWidgetItem(text);
      if (isBad)
        item->setForeground(warningColor());
      m_pairs->setItem(static_cast<int>(n), column, item);
    };
    cell(0,
         numberText(core::fixedText(one.patient.x(), 1) + ", " +
                    core::fixedText(one.patient.y(), 1) + ", " +
                    core::fixedText(one.patient.z(), 1)),
         mark.isBad);
    cell(1, residual, mark.isBad);
  }
  if (row >= 0 && row < m_pairs->rowCount())
    m_pairs->setCurrentCell(row, 0);
  m_picture->setMarks(marks, m_editor.mark());
  const bool has = still && !still->landmarks.empty();
  m_removePair->setEnabled(has);
  m_removeStill->setEnabled(still != nullptr);
  m_overlay->setEnabled(still && still->camera);
  m_opacity->setEnabled(still && still->camera);
  m_camera->setText(stillText());
}

QString VideoPanel::stillText() const
{
  if (!m_editor.time())
    return {};
  const auto* still = m_editor.still();
  const std::size_t count = still ? still->landmarks.size() : 0;
  if (m_editor.mark())
    return tr("Now the same point of the patient: click it in the 3D view or a slice, then Add the "
              "landmark (Ctrl+U).");
  if (m_editor.isFitting())
    return tr("The camera is being sought…");
  if (!m_editor.problem().empty())
    return sentence(words(m_editor.problem()));
  const auto& fit = m_editor.fit();
  if (!fit)
  {
    const std::size_t needed =
        still ? presenters::landmarksNeeded(*still) : presenters::landmarksNeeded({});
    return tr("Click a point in the still, then the same point of the patient. %1 of at least %2 "
              "landmarks are set.")
        .arg(count)
        .arg(needed);
  }
  const auto& pose = fit->pose;
  QStringList lines;
  lines += tr("Residual %1 px, %2 mm at the landmarks (rms). Uncertainty (standard deviation): "
              "%3° of direction, %4 mm of the camera's place.")
               .arg(numberText(pose.rms, 1), numberText(pose.rmsAtLandmarks, 2),
                    numberText(pose.rotationSigma, 2), numberText(pose.positionSigma, 1));
  if (pose.viewAngleSigma > 0.0)
    lines += tr("Angle of view %1° ± %2°.")
                 .arg(numberText(pose.camera.viewAngle, 2), numberText(pose.viewAngleSigma, 2));
  if (!fit->bad.empty())
  {
    QStringList bad;
    for (const std::size_t n : fit->bad)
      bad += QString::number(n + 1);
    lines += tr("Left out, as it does not fit the others: landmark %1. Set it anew or remove it.")
                 .arg(bad.join(", "));
  }
  if (fit->isPoor)
    lines += tr("The landmarks do not fit each other; which one is wrong more landmarks would "
                "tell.");
  if (pose.ambiguous)
    lines += tr("Another view explains the landmarks nearly as well: add landmarks of other depth, "
                "and look whether the still fits.");
  return lines.join(' ');
}

} // namespace petrous::workstation
