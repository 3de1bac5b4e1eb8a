#include "SegmentPanel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <QStandardItemModel>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "Application.h"
#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{
using presenters::SegmentEditor;
using presenters::SegmentValues;

constexpr int kImageName = Qt::UserRole + 1; // of the source images, without why not
constexpr double kTubeRadius = 0.6;          // mm, until another one is entered
constexpr int kLeastPointRows = 6;           // of the nerve's list, as many as are usually clicked
constexpr int kMostPointRows = 12;           // then it scrolls
constexpr int kNarrowButton = 34;            // px
constexpr int kPreviewAfter = 300;           // ms; a shorter preview needs no progress

// Two widgets in a row; the label's key goes to the first.
void addRow(QFormLayout& form, const QString& text, QWidget* first, QWidget* second)
{
  auto* label = new QLabel(text);
  label->setBuddy(first);
  form.addRow(label, rowOf({first, second}));
}

QLabel* dimLabel(const QString& text)
{
  auto* label = new QLabel(text);
  label->setObjectName("dim");
  wrapWords(*label);
  label->setTextFormat(Qt::PlainText);
  return label;
}

QString draftText(const SegmentEditor& editor)
{
  const std::uint64_t voxels = editor.voxels();
  if (voxels == 0)
    return editor.tool() == SegmentEditor::Tool::Grow && editor.hasStrokes()
               ? SegmentPanel::tr("Strokes; nothing grown yet")
               : SegmentPanel::tr("Nothing yet");
  return SegmentPanel::tr("%1  (%2 voxels)").arg(volumeText(editor.volume())).arg(voxels);
}
} // namespace

SegmentPanel::SegmentPanel(SegmentEditor& editor, const std::vector<QAction*>& tools,
                           QWidget* parent)
  : Panel(parent)
  , m_editor(editor)
  , m_name(new QLineEdit)
  , m_edit(new QPushButton(tr("Edit…")))
  , m_editable(new QMenu(m_edit))
  , m_source(choiceBox("segmentSource", tr("The image that threshold, growing and the nerve tool "
                                           "read; an MR once it is registered")))
  , m_pages(new QStackedWidget)
  , m_shown(new QLabel)
  , m_volume(new QLabel)
  , m_line(new QLabel)
  , m_remark(new QLabel)
  , m_note(new QLabel)
  , m_pieces(new QLabel)
  , m_progress(new QProgressBar)
{
  auto* inside = new QWidget;
  auto* layout = new QVBoxLayout(inside);
  layout->setContentsMargins(10, 8, 10, 8);
  layout->setSpacing(6);
  addHead(*layout);
  addTools(*layout, tools);
  addPages(*layout);
  layout->addStretch(1);
  layOutPanel(*this, inside, addFoot());
  m_previewLater.setSingleShot(true);
  m_previewLater.setInterval(kPreviewAfter);
  connect(&m_previewLater, &QTimer::timeout, this,
          [this]
          {
            m_showsPreview = true;
            refresh();
          });
  say({});
  refresh();
}

void SegmentPanel::addHead(QVBoxLayout& layout)
{
  m_name->setObjectName("segmentName");
  m_name->setPlaceholderText(tr("Name, such as sigmoid sinus"));
  m_name->setToolTip(tr("What the structure is called; its colour and behaviour follow from it"));
  m_name->setMaxLength(100);
  connect(m_name, &QLineEdit::textEdited, this,
          [this](const QString& text) { m_editor.setName(bytes(text.trimmed())); });
  m_edit->setObjectName("segmentEdit");
  m_edit->setToolTip(tr("Take a structure of the case as the draft, to change it"));
  m_edit->setMenu(m_editable);
  connect(m_editable, &QMenu::aboutToShow, this,
          [this]
          {
            m_editable->clear();
            for (const std::string& name : m_editor.editable())
              connect(m_editable->addAction(shownName(name)), &QAction::triggered, this,
                      [this, name] { emit editAsked(words(name)); });
            if (m_editable->isEmpty())
              m_editable->addAction(tr("The case has no structure on the %1").arg(imageName("ct")))
                  ->setEnabled(false);
          });
  m_bound.add(
      m_source, [this] { return m_source->findData(words(m_editor.source())); },
      [this](int row) { takeSource(bytes(m_source->itemData(row).toString())); });
  auto* form = new QFormLayout;
  addRow(*form, tr("Stru&cture"), m_name, m_edit);
  form->addRow(tr("&Image"), m_source);
  layout.addLayout(form);
  m_shown->setObjectName("segmentShown");
  wrapWords(*m_shown);
  m_shown->setTextFormat(Qt::PlainText);
  m_shown->setStyleSheet(kWarningStyle);
  m_showSource = button({}, "segmentShowSource", tr("The slices show what the tools work on"));
  m_takeShown = button({}, "segmentTakeShown", tr("The tools work on what the slices show"));
  connect(m_showSource, &QPushButton::clicked, this,
          [this] { emit imageWanted(words(m_editor.source())); });
  connect(m_takeShown, &QPushButton::clicked, this,
          [this] { takeSource(m_editor.shownInstead()); });
  layout.addWidget(m_shown);
  layout.addLayout(rowOf({m_showSource, m_takeShown}));
}

QString SegmentPanel::imageName(const std::string& source) const
{
  return phrase(m_editor.sourceName(source));
}

// The slices show it from now on.
void SegmentPanel::takeSource(const std::string& source)
{
  say({});
  try
  {
    m_editor.setSource(source);
    emit imageWanted(words(m_editor.source()));
  }
  catch (const std::exception& error)
  {
    complain(toString(error));
  }
}

void SegmentPanel::addTools(QVBoxLayout& layout, const std::vector<QAction*>& tools)
{
  layout.addLayout(toolGrid(tools, "segmentTool"));
}

void SegmentPanel::change(const std::function<void(Values&)>& what)
{
  Values values = m_editor.values();
  what(values);
  m_editor.setValues(values);
}

QWidget* SegmentPanel::page(const QString& help, const std::function<void(QFormLayout&)>& fill,
                            const QString& step)
{
  auto* whole = new QWidget;
  auto* layout = new QVBoxLayout(whole);
  layout->setContentsMargins(0, 4, 0, 0);
  layout->setSpacing(6);
  layout->addWidget(dimLabel(help));
  auto* form = new QFormLayout;
  if (fill)
    fill(*form);
  layout->addLayout(form);
  if (!step.isEmpty())
  {
    auto* apply = button(step, "segmentStep", tr("One step, which can be undone (Shift+Return)"));
    connect(apply, &QPushButton::clicked, this, &SegmentPanel::stepAsked);
    m_steps.push_back(apply);
    layout->addWidget(apply);
  }
  layout->addStretch(1);
  return whole;
}

void SegmentPanel::addRange(QFormLayout& form, const char* lower, const char* upper)
{
  auto* low = m_bound.add(
      numberBox(lower, tr("The least intensity that belongs to it"), {-1e5, 1e5}),
      [this] { return m_editor.values().lower; },
      [this](double value) { change([=](Values& values) { values.lower = value; }); },
      Bindings::kSettle);
  auto* high = m_bound.add(
      numberBox(upper, tr("The greatest intensity that belongs to it"), {-1e5, 1e5}),
      [this] { return m_editor.values().upper; },
      [this](double value) { change([=](Values& values) { values.upper = value; }); },
      Bindings::kSettle);
  high->setAccessibleName(tr("Upper limit"));
  m_ranges.push_back(low);
  m_ranges.push_back(high);
  addRow(form, tr("Ra&nge"), low, high);
}

void SegmentPanel::addBrush(QFormLayout& form, const char* radius, const char* shape,
                            const char* within)
{
  form.addRow(tr("Ra&dius"),
              m_bound.add(
                  numberBox(radius, tr("Of the ball, or disk (A or [ smaller, S or ] larger)"),
                            {0.1, 20.0, tr(" mm"), 1, 0.1}),
                  [this] { return m_editor.values().brush; },
                  [this](double mm) { change([=](Values& values) { values.brush = mm; }); }));
  auto* ball = choiceBox(shape, tr("A ball reaches into the slices beside; a disk stays in the "
                                   "slice"));
  ball->addItem(tr("ball"));
  ball->addItem(tr("disk in the slice"));
  form.addRow(tr("S&hape"),
              m_bound.add(
                  ball, [this] { return m_editor.values().ball ? 0 : 1; },
                  [this](int row) { change([=](Values& values) { values.ball = row == 0; }); }));
  if (within)
    form.addRow({}, m_bound.add(
                        checkBox(tr("&Only intensities in this range"), within,
                                 tr("The brush leaves other voxels as they are")),
                        [this] { return m_editor.values().within; },
                        [this](bool on) { change([=](Values& values) { values.within = on; }); }));
}

void SegmentPanel::addPages(QVBoxLayout& layout)
{
  // In the order of SegmentEditor::Tool.
  m_pages->addWidget(page(tr("Choose a tool. It works in the slices with the left button; with "
                             "Shift the left button moves the crosshair. Esc puts it away, and "
                             "the draft stays."),
                          {}, {}));
  m_pages->addWidget(page(
      tr("All voxels of these intensities; the slices show it at once."),
      [this](QFormLayout& form)
      {
        addRange(form, "segmentLower", "segmentUpper");
        auto* propose =
            button(tr("&Propose"), "segmentPropose", tr("Range from the image's histogram"));
        connect(propose, &QPushButton::clicked, this, [this] { m_editor.proposeRange(); });
        form.addRow({}, propose);
        form.addRow({}, m_bound.add(
                            checkBox(tr("Connected to a clic&ked point"), "segmentConnected",
                                     tr("Only what hangs together with the points that you click")),
                            [this] { return m_editor.values().connected; },
                            [this](bool on)
                            { change([=](Values& values) { values.connected = on; }); }));
        auto* combine = choiceBox("segmentCombine", tr("What becomes of what is there already"));
        combine->addItems({tr("replaces the draft"), tr("is added to it"),
                           tr("limits it: only what is in both")});
        form.addRow(tr("Resul&t"),
                    m_bound.add(
                        combine, [this] { return static_cast<int>(m_editor.values().combine); },
                        [this](int row) {
                          change([=](Values& values)
                                 { values.combine = static_cast<Values::Combine>(row); });
                        }));
      },
      tr("Apply the threshold")));
  for (const bool erase : {false, true})
    m_pages->addWidget(page(
        erase ? tr("Drag in a slice to erase.") : tr("Drag in a slice to paint."),
        [this, erase](QFormLayout& form)
        {
          addBrush(form, erase ? "eraseRadius" : "paintRadius", erase ? "eraseShape" : "paintShape",
                   erase ? "eraseWithin" : "paintWithin");
          addRange(form, erase ? "eraseLower" : "paintLower", erase ? "eraseUpper" : "paintUpper");
        },
        {}));
  m_pages->addWidget(page(
      tr("Removes what does not hang together with the rest. Click a part in a slice to keep that "
         "alone."),
      [this](QFormLayout& form)
      {
        auto* keep = choiceBox("islandsKeep", tr("Which connected parts stay"));
        keep->addItems({tr("the largest"), tr("all of at least")});
        form.addRow(tr("&Keep"), m_bound.add(
                                     keep, [this] { return m_editor.values().largest ? 0 : 1; },
                                     [this](int row) {
                                       change([=](Values& values) { values.largest = row == 0; });
                                     }));
        m_smallest = m_bound.add(
            numberBox("islandsSmallest", tr("Smaller parts are removed"),
                      {0.01, 1e6, tr(" mm³"), 2}),
            [this] { return m_editor.values().smallest; },
            [this](double value) { change([=](Values& values) { values.smallest = value; }); });
        form.addRow(tr("Si&ze"), m_smallest);
      },
      tr("Remove islands")));
  m_pages->addWidget(page(
      tr("Moves the whole surface outwards, or with a minus inwards."),
      [this](QFormLayout& form)
      {
        form.addRow(tr("&Margin"), m_bound.add(
                                       numberBox("marginWidth", tr("How far; below 0: inwards"),
                                                 {-20.0, 20.0, tr(" mm"), 2, 0.1}),
                                       [this] { return m_editor.values().margin; },
                                       [this](double mm)
                                       { change([=](Values& values) { values.margin = mm; }); }));
      },
      tr("Apply the margin")));
  m_pages->addWidget(page(
      tr("Rounds the surface and removes what is thinner than the width."),
      [this](QFormLayout& form)
      {
        form.addRow(tr("&Width"),
                    m_bound.add(
                        numberBox("smoothingWidth", tr("Details of this size are smoothed"),
                                  {0.05, 10.0, tr(" mm"), 2, 0.1}),
                        [this] { return m_editor.values().smoothing; },
                        [this](double mm)
                        { change([=](Values& values) { values.smoothing = mm; }); }));
      },
      tr("Smooth")));
  m_pages->addWidget(page(tr("Paint the structure in some slices of one view, with a disk; this "
                             "makes the slices between them. What was painted stays."),
                          {}, tr("Fill between slices")));
  m_pages->addWidget(page(
      tr("Paint some strokes inside the structure and some beside it; the rest is decided by the "
         "image."),
      [this](QFormLayout& form)
      {
        auto* inside = choiceBox("growSide", tr("What the next stroke marks"));
        inside->addItems({tr("inside the structure"), tr("beside it")});
        form.addRow(tr("Stro&kes"), m_bound.add(
                                        inside, [this] { return m_editor.values().inside ? 0 : 1; },
                                        [this](int row) {
                                          change([=](Values& values) { values.inside = row == 0; });
                                        }));
        addBrush(form, "growRadius", "growShape", nullptr);
      },
      tr("Grow from the strokes")));
  m_pages->addWidget(nervePage());
  layout.addWidget(m_pages);
}

QWidget* SegmentPanel::nervePage()
{
  QWidget* whole = page(
      tr("Click along the nerve from one end, four to six points; a click between two points is "
         "put "
         "between them. Drag a point in a slice to move it."),
      [this](QFormLayout& form)
      {
        m_points = new QTreeWidget;
        m_points->setObjectName("nervePoints");
        m_points->setAccessibleName(tr("Points along the nerve"));
        m_points->setRootIsDecorated(false);
        m_points->setAllColumnsShowFocus(true);
        m_points->setHeaderLabels({tr("#"), tr("To the path"), tr("What the scan shows here")});
        m_points->header()->setStretchLastSection(true);
        m_points->setUniformRowHeights(true);
        m_points->setToolTip(tr("The crosshair goes to the chosen point. Delete removes it; Alt+Up "
                                "and Alt+Down change its place along the nerve"));
        const auto choose = [this]
        {
          if (const int row = chosenPoint(); row >= 0)
            emit pointChosen(m_editor.tubePoints()[static_cast<std::size_t>(row)].patient);
        };
        connect(m_points, &QTreeWidget::itemClicked, this, choose);
        connect(m_points, &QTreeWidget::currentItemChanged, this,
                [this, choose]
                {
                  if (m_points->hasFocus()) // else it was not the user's choice
                    choose();
                  enablePoints();
                });
        form.addRow(m_points);
        m_removePoint = button(tr("Remove"), "removeNervePoint", tr("The chosen point (Delete)"));
        m_movePoint = button(tr("To the crosshair"), "moveNervePoint",
                             tr("Moves the chosen point to the crosshair"));
        m_pointUp = button(QString::fromUtf8("↑"), "nervePointUp",
                           tr("The chosen point earlier along the nerve (Alt+Up)"));
        m_pointDown = button(QString::fromUtf8("↓"), "nervePointDown",
                             tr("The chosen point later along the nerve (Alt+Down)"));
        for (QPushButton* narrow : {m_pointUp, m_pointDown})
          narrow->setMaximumWidth(kNarrowButton);
        const auto remove = [this]
        {
          if (const int row = chosenPoint(); row >= 0)
            m_editor.removeTubePoint(static_cast<std::size_t>(row));
        };
        const auto reorder = [this](int by)
        {
          const int row = chosenPoint();
          if (row < 0 || row + by < 0 || row + by >= m_points->topLevelItemCount())
            return;
          m_points->setCurrentItem(m_points->topLevelItem(row + by));
          m_editor.reorderTubePoint(static_cast<std::size_t>(row),
                                    static_cast<std::size_t>(row + by));
        };
        connect(m_removePoint, &QPushButton::clicked, this, remove);
        connect(m_movePoint, &QPushButton::clicked, this,
                [this] { emit pointToCrosshairAsked(chosenPoint()); });
        connect(m_pointUp, &QPushButton::clicked, this, [reorder] { reorder(-1); });
        connect(m_pointDown, &QPushButton::clicked, this, [reorder] { reorder(1); });
        const auto key = [this](int keys, auto what)
        {
          auto* action = new QAction(m_points);
          action->setShortcut(keys);
          action->setShortcutContext(Qt::WidgetShortcut);
          connect(action, &QAction::triggered, this, what);
          m_points->addAction(action);
        };
        key(Qt::Key_Delete, remove);
        key(Qt::ALT + Qt::Key_Up, [reorder] { reorder(-1); });
        key(Qt::ALT + Qt::Key_Down, [reorder] { reorder(1); });
        form.addRow(rowOf({m_removePoint, m_movePoint, m_pointUp, m_pointDown}));
        auto* estimated = checkBox(tr("&estimated"), "nerveEstimate",
                                   tr("From the image, along the path; else one everywhere"));
        m_bound.add(
            estimated, [this] { return !m_editor.values().tubeRadius; },
            [this](bool on)
            {
              const double radius = std::round(100.0 * shownRadius()) / 100.0; // as it is shown
              change([=](Values& values)
                     { values.tubeRadius = on ? std::nullopt : std::optional(radius); });
            });
        auto* radius = m_bound.add(
            numberBox("nerveRadius", tr("Of the tube, everywhere"), {0.1, 5.0, tr(" mm"), 2, 0.05}),
            [this] { return shownRadius(); },
            [this](double mm) { change([=](Values& values) { values.tubeRadius = mm; }); });
        addRow(form, tr("Ra&dius"), radius, estimated);
      },
      tr("Add the tube to the draft"));
  return whole;
}

double SegmentPanel::shownRadius() const
{
  const auto given = m_editor.values().tubeRadius;
  return given ? *given : m_editor.shownRadius().value_or(kTubeRadius);
}

QWidget* SegmentPanel::addFoot()
{
  auto* box = new QWidget;
  auto* layout = new QVBoxLayout(box);
  layout->setContentsMargins(10, 4, 10, 8);
  layout->setSpacing(5);
  m_remark->setObjectName("segmentRemark");
  m_line->setObjectName("segmentLine");
  m_note->setObjectName("segmentNote");
  for (QLabel* label : {m_remark, m_note, m_line})
  {
    wrapWords(*label);
    label->setTextFormat(Qt::PlainText);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  }
  m_remark->setStyleSheet(kWarningStyle);
  m_volume->setObjectName("segmentVolume");
  m_volume->setToolTip(tr("Volume of the structure as it is now, with the preview"));
  m_progress->setObjectName("segmentProgress");
  m_progress->setRange(0, 1000);
  m_cancel =
      button(tr("Stop"), "segmentCancel", tr("Ends what is being computed; the draft stays"));
  m_undo = button(tr("Undo"), "segmentUndo", tr("The last step (Ctrl+Z while a tool is in use)"));
  m_redo = button(tr("Redo"), "segmentRedo", tr("Again (Ctrl+Shift+Z while a tool is in use)"));
  m_create = button(tr("Create structure"), "segmentCreate",
                    tr("The draft becomes a structure of the case (Return)"));
  m_discard = button(tr("Discard"), "segmentDiscard", tr("Drops the draft (Esc without a tool)"));
  connect(m_cancel, &QPushButton::clicked, this, &SegmentPanel::cancelAsked);
  connect(m_undo, &QPushButton::clicked, this, &SegmentPanel::undoAsked);
  connect(m_redo, &QPushButton::clicked, this, &SegmentPanel::redoAsked);
  connect(m_create, &QPushButton::clicked, this, &SegmentPanel::createAsked);
  connect(m_discard, &QPushButton::clicked, this, &SegmentPanel::discardAsked);
  layout->addWidget(m_note);
  layout->addWidget(m_remark);
  layout->addWidget(m_line);
  m_pieces->setObjectName("segmentPieces");
  wrapWords(*m_pieces);
  m_keepLargest =
      button(tr("Keep the largest"), "segmentKeepLargest", tr("Removes the other pieces; a step"));
  m_keepLargest->setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
  connect(m_keepLargest, &QPushButton::clicked, this, [this] { m_editor.keepLargest(); });
  layout->addLayout(rowOf({m_pieces, m_keepLargest}));
  layout->addLayout(rowOf({m_progress, m_cancel}));
  layout->addLayout(rowOf({m_volume, m_undo, m_redo}));
  layout->addLayout(rowOf({m_create, m_discard}));
  return box;
}

void SegmentPanel::focusName()
{
  m_name->setFocus();
  m_name->selectAll();
}

void SegmentPanel::setProgress(double fraction, const QString& text, const QString& left)
{
  m_progress->setValue(static_cast<int>(std::lround(1000.0 * fraction)));
  m_progress->setFormat(withTimeLeft(text, left));
}

void SegmentPanel::complain(const QString& line)
{
  say(line);
  m_complains = true;
}

void SegmentPanel::withdraw(const QString& line)
{
  if (!line.isEmpty() && m_line->text() == line)
    say({});
}

void SegmentPanel::say(const QString& line)
{
  m_complains = false;
  m_line->setText(line);
  m_line->setVisible(!line.isEmpty());
}

void SegmentPanel::caseChanged()
{
  m_bound.drop();
  say({});
  refresh();
}

// What is being typed, and what was said of the structure that was created, stays.
void SegmentPanel::partsChanged()
{
  refresh();
}

void SegmentPanel::appearanceChanged()
{
  refresh();
}

void SegmentPanel::showSources()
{
  const auto sources = m_editor.sources();
  QStringList names, shown;
  for (const auto& source : sources)
    names << imageName(source.name) + words(source.name) + phrase(source.why);
  for (int n = 0; n < m_source->count(); ++n)
    shown << m_source->itemData(n, kImageName).toString() + m_source->itemData(n).toString() +
                 m_source->itemData(n, Qt::ToolTipRole).toString();
  if (names == shown)
    return;
  m_bound.quietly(
      [&]
      {
        m_source->clear();
        for (const auto& source : sources)
        {
          const QString name = imageName(source.name);
          m_source->addItem(source.why.empty() ? name : tr("%1 (%2)").arg(name, phrase(source.why)),
                            words(source.name));
          const int row = m_source->count() - 1;
          m_source->setItemData(row, name, kImageName);
          m_source->setItemData(row, phrase(source.why), Qt::ToolTipRole);
          static_cast<QStandardItemModel*>(m_source->model())
              ->item(row)
              ->setEnabled(source.why.empty());
        }
      });
}

// In the unit of the source image, within its range.
void SegmentPanel::showRange()
{
  const presenters::IntensityDisplay display = m_editor.display();
  if (display.least == m_display.least && display.most == m_display.most &&
      display.decimals == m_display.decimals && display.hounsfield == m_display.hounsfield)
    return; // setting a range would drop what is being typed
  m_display = display;
  m_bound.quietly(
      [&]
      {
        for (QDoubleSpinBox* box : m_ranges)
        {
          box->setDecimals(display.decimals);
          box->setRange(display.least, display.most);
          box->setSingleStep(10.0 * display.step);
          box->setSuffix(words(display.suffix()));
        }
      });
}

void SegmentPanel::showPoints()
{
  const auto points = m_editor.tubePoints();
  const QSignalBlocker quiet(m_points); // rows that come and go are nobody's choice
  const int chosen = chosenPoint();
  while (m_points->topLevelItemCount() > static_cast<int>(points.size()))
    delete m_points->takeTopLevelItem(m_points->topLevelItemCount() - 1);
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    const int row = static_cast<int>(n);
    if (row == m_points->topLevelItemCount())
      m_points->addTopLevelItem(new QTreeWidgetItem);
    QTreeWidgetItem* item = m_points->topLevelItem(row);
    const bool isOutside = points[n].isOutside;
    item->setText(0, QString::number(row + 1) + (isOutside ? "!" : ""));
    item->setText(1, points[n].distance ? tr("%1 mm").arg(numberText(*points[n].distance, 2))
                                        : QString::fromUtf8("–"));
    item->setText(2, phrase(points[n].problem));
    item->setToolTip(2, phrase(points[n].problem));
    const QColor warned = warningColor();
    for (int column = 0; column < 2; ++column)
      item->setForeground(column, isOutside ? QBrush(warned) : palette().text());
    item->setForeground(2, warned);
  }
  if (chosen < 0 && m_points->topLevelItemCount() > 0)
    m_points->setCurrentItem(m_points->topLevelItem(m_points->topLevelItemCount() - 1));
  m_points->resizeColumnToContents(0);
  m_points->resizeColumnToContents(1);
  m_points->setMinimumWidth(wholeWidthOf(*m_points));
  const int rows = std::clamp(m_points->topLevelItemCount(), kLeastPointRows, kMostPointRows);
  const int row = m_points->topLevelItemCount() > 0
                      ? m_points->visualItemRect(m_points->topLevelItem(0)).height()
                      : m_points->fontMetrics().height() + 4;
  m_points->setFixedHeight(m_points->header()->sizeHint().height() + rows * row +
                           2 * m_points->frameWidth());
  enablePoints();
}

int SegmentPanel::chosenPoint() const
{
  return m_points->indexOfTopLevelItem(m_points->currentItem());
}

void SegmentPanel::enablePoints()
{
  const int chosen = chosenPoint();
  m_removePoint->setEnabled(chosen >= 0);
  m_movePoint->setEnabled(chosen >= 0);
  m_pointUp->setEnabled(chosen > 0);
  m_pointDown->setEnabled(chosen >= 0 && chosen + 1 < m_points->topLevelItemCount());
}

void SegmentPanel::showVolume()
{
  m_volume->setText(draftText(m_editor));
}

// The keys of a step stop it while it is computed, and are the step's again afterwards. (A button
// that is disabled gives the focus to the next one that is not, which drops the draft.)
void SegmentPanel::showWork(bool works)
{
  m_progress->setVisible(works || m_showsPreview);
  if (works)
  {
    m_cancel->show();
    for (QPushButton* step : m_steps)
      if (step->hasFocus())
      {
        m_begun = step;
        m_cancel->setFocus();
      }
    return;
  }
  if (QPushButton* step = std::exchange(m_begun, nullptr); step && m_cancel->hasFocus())
    step->isEnabled() ? step->setFocus() : m_name->setFocus();
  m_cancel->hide();
}

void SegmentPanel::refresh()
{
  if (m_complains) // of what is otherwise now
    say({});
  showSources();
  showRange();
  showPoints();
  m_bound.refresh();
  if (bytes(m_name->text().trimmed()) != m_editor.name())
    m_name->setText(words(m_editor.name()));
  m_pages->setCurrentIndex(static_cast<int>(m_editor.tool()));
  const bool free = !m_editor.stepping();
  if (!free || !m_editor.previewPending())
  {
    m_previewLater.stop();
    m_showsPreview = false;
  }
  else if (!m_showsPreview && !m_previewLater.isActive())
    m_previewLater.start();
  showVolume();
  const QString notShown = phrase(m_editor.notShown());
  m_shown->setText(notShown);
  m_showSource->setText(tr("Show %1").arg(imageName(m_editor.source())));
  const std::string instead = m_editor.shownInstead();
  m_takeShown->setText(tr("Work on %1").arg(imageName(instead)));
  m_shown->setVisible(!notShown.isEmpty());
  m_showSource->setVisible(!notShown.isEmpty());
  m_takeShown->setVisible(!instead.empty());
  m_remark->setText(phrase(m_editor.warning()));
  m_remark->setVisible(!m_editor.warning().empty());
  m_note->setText(m_showsPreview ? tr("The preview is being computed.") : phrase(m_editor.note()));
  m_note->setVisible(!m_note->text().isEmpty());
  const auto pieces = m_editor.pieces();
  if (pieces)
    m_pieces->setText(tr("%1 pieces, %2 outside the largest")
                          .arg(pieces->count)
                          .arg(volumeText(pieces->outside)));
  m_pieces->setVisible(pieces.has_value());
  m_keepLargest->setVisible(pieces.has_value());
  if (!free)
    showWork(true);
  const std::string whyNot = m_editor.whyNotStep();
  for (QPushButton* step : m_steps)
  {
    step->setEnabled(free && whyNot.empty());
    step->setToolTip(whyNot.empty() ? tr("One step, which can be undone (Shift+Return)")
                                    : phrase(whyNot));
  }
  if (free)
    showWork(false);
  m_smallest->setEnabled(!m_editor.values().largest);
  findChild<QDoubleSpinBox*>("nerveRadius")->setEnabled(m_editor.values().tubeRadius.has_value());
  for (const char* name : {"paintLower", "paintUpper", "eraseLower", "eraseUpper"})
    findChild<QDoubleSpinBox*>(name)->setEnabled(m_editor.values().within);
  m_undo->setEnabled(free && m_editor.canUndo());
  m_redo->setEnabled(free && m_editor.canRedo());
  m_undo->setToolTip(tr("%1 (Ctrl+Z while a tool is in use)")
                         .arg(m_editor.undoText().empty()
                                  ? tr("The last step")
                                  : tr("Undo %1").arg(phrase(m_editor.undoText()))));
  m_redo->setToolTip(tr("%1 (Ctrl+Shift+Z while a tool is in use)")
                         .arg(m_editor.redoText().empty()
                                  ? tr("Again")
                                  : tr("Redo %1").arg(phrase(m_editor.redoText()))));
  const std::string why = m_editor.whyNotCreate();
  m_create->setText(m_editor.edited().empty() ? tr("Create structure") : tr("Save the changes"));
  m_create->setEnabled(free && (why.empty() || m_editor.previewPending())); // then it waits
  m_create->setToolTip(why.empty() ? tr("The draft becomes a structure of the case (Return)")
                                   : phrase(why));
  m_discard->setEnabled(m_editor.hasDraft());
  m_edit->setEnabled(free && !m_editor.hasDraft());
}

} // namespace petrous::workstation
