#include "PseudonymsDialog.h"

#include <utility>

#include <QApplication>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSortFilterProxyModel>
#include <QStackedWidget>
#include <QTableView>
#include <QVBoxLayout>

#include "Application.h"
#include "PanelLayout.h"
#include "Passphrase.h"
#include "PathRow.h"
#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{

QString kindText(const std::string& kind)
{
  return kind == "patient"  ? PseudonymsModel::tr("patient")
         : kind == "study"  ? PseudonymsModel::tr("study")
         : kind == "series" ? PseudonymsModel::tr("series")
                            : words(kind);
}

QPushButton* button(const char* name, const QString& text, const QString& tip)
{
  auto* one = new QPushButton(text);
  one->setObjectName(name);
  one->setToolTip(tip);
  one->setAutoDefault(false);
  return one;
}

} // namespace

void PseudonymsModel::show(const library::PseudonymMap* map)
{
  beginResetModel();
  m_map = map;
  endResetModel();
}

int PseudonymsModel::rowCount(const QModelIndex& parent) const
{
  return parent.isValid() || !m_map ? 0 : static_cast<int>(m_map->entries().size());
}

int PseudonymsModel::columnCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : 3;
}

QVariant PseudonymsModel::data(const QModelIndex& index, int role) const
{
  if (!index.isValid() || role != Qt::DisplayRole)
    return {};
  const library::Pseudonym& entry = m_map->entries()[static_cast<std::size_t>(index.row())];
  return index.column() == 0   ? kindText(entry.kind)
         : index.column() == 1 ? words(entry.pseudonym)
                               : words(entry.identity);
}

QVariant PseudonymsModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole)
    return QAbstractTableModel::headerData(section, orientation, role);
  return section == 0 ? tr("What") : section == 1 ? tr("Pseudonym") : tr("Who or which it is");
}

PseudonymsDialog::PseudonymsDialog(std::chrono::milliseconds lockAfter, QWidget* parent)
  : QDialog(parent)
  , m_lockAfter(lockAfter)
  , m_found(new QSortFilterProxyModel(this))
  , m_pages(new QStackedWidget)
  , m_outcome(new QLabel)
{
  setObjectName("pseudonyms");
  setWindowTitle(tr("Pseudonyms"));
  m_found->setSourceModel(&m_entries);
  m_found->setFilterCaseSensitivity(Qt::CaseInsensitive);
  m_found->setSortCaseSensitivity(Qt::CaseInsensitive);
  m_found->setFilterKeyColumn(-1);
  m_outcome->setObjectName("pseudonymsOutcome");
  m_outcome->setTextFormat(Qt::PlainText);
  wrapWords(*m_outcome, 2);
  m_pages->addWidget(lockedPage());
  m_pages->addWidget(openPage());
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  buttons->button(QDialogButtonBox::Close)->setAutoDefault(false);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(m_pages, 1);
  layout->addWidget(m_outcome);
  layout->addWidget(buttons);
  resizeOnScreen(*this, {860, 520});

  m_idle.setSingleShot(true);
  connect(&m_idle, &QTimer::timeout, this,
          [this] { lock(tr("Locked, as nothing was typed or clicked for a while.")); });
  connect(&m_work, &BackgroundWork::failed, this,
          [this](const QString& why)
          {
            m_entries.show(m_map.get());
            say(why);
            if (!m_map) // disabled while it was tried
              m_passphrase->setFocus();
          });
  QApplication::instance()->installEventFilter(this);
  say({});
}

PseudonymsDialog::~PseudonymsDialog()
{
  QApplication::instance()->removeEventFilter(this);
  lock({});
}

QWidget* PseudonymsDialog::lockedPage()
{
  auto* page = new QWidget;
  m_file = new PathRow("pseudonymsFile", PathRow::Kind::File, tr("File of the pseudonyms"));
  m_passphrase = passphraseLine("pseudonymsPassphrase");
  m_open = button("primary", tr("&Open"), {});
  m_open->setDefault(true);
  auto* text = new QLabel(
      tr("The file was made by De-identify DICOM files, with Remember who is behind the "
         "pseudonyms. What is in it names patients: it is shown here only, until this window is "
         "closed or locked."));
  text->setObjectName("dim");
  wrapWords(*text);
  auto* form = new QFormLayout;
  form->addRow(tr("&File:"), m_file);
  form->addRow(tr("&Passphrase:"), m_passphrase);
  auto* row = new QHBoxLayout;
  row->addStretch();
  row->addWidget(m_open);
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(text);
  layout->addLayout(form);
  layout->addLayout(row);
  layout->addStretch();
  connect(m_open, &QPushButton::clicked, this, &PseudonymsDialog::open);
  connect(m_file, &PathRow::changed, this, &PseudonymsDialog::update);
  connect(m_passphrase, &QLineEdit::textChanged, this, &PseudonymsDialog::update);
  connect(m_passphrase, &QLineEdit::returnPressed, this, &PseudonymsDialog::open);
  return page;
}

QWidget* PseudonymsDialog::openPage()
{
  auto* page = new QWidget;
  m_search = new QLineEdit;
  m_search->setObjectName("pseudonymsSearch");
  m_search->setPlaceholderText(tr("Find a pseudonym, a patient or a UID"));
  m_search->setAccessibleName(tr("Find"));
  m_search->setClearButtonEnabled(true);
  m_table = new QTableView;
  m_table->setObjectName("pseudonymsTable");
  m_table->setAccessibleName(tr("Pseudonyms"));
  m_table->setModel(m_found);
  m_table->setSortingEnabled(true);
  m_table->sortByColumn(0, Qt::AscendingOrder);
  m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
  m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  m_table->setTabKeyNavigation(false);
  m_table->setWordWrap(false);
  m_table->setTextElideMode(Qt::ElideMiddle);
  m_table->verticalHeader()->hide();
  m_table->horizontalHeader()->setSectionResizeMode(QHeaderView::Interactive);
  m_table->horizontalHeader()->setStretchLastSection(true);
  m_table->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  const auto widthOf = [this](const QString& text)
  {
    constexpr int kBeside = 12; // px
    return m_table->fontMetrics().horizontalAdvance(text) + kBeside;
  };
  m_table->setColumnWidth(0, widthOf(QString(12, '0')));
  m_table->setColumnWidth(1, widthOf(QString(44, '0'))); // of a UID
  m_take = button("pseudonymsImport", tr("&Take in…"),
                  tr("The pseudonyms of another such file come to this one"));
  m_copy = button("pseudonymsExport", tr("&Copy…"),
                  tr("The whole map to another file, encrypted under a passphrase of its own"));
  m_change = button("pseudonymsChange", tr("C&hange the passphrase…"), {});
  m_lock = button("pseudonymsLock", tr("&Lock"), tr("Closes the map; this window stays"));
  auto* row = new QHBoxLayout;
  for (QPushButton* one : {m_take, m_copy, m_change})
    row->addWidget(one);
  row->addStretch();
  row->addWidget(m_lock);
  auto* layout = new QVBoxLayout(page);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(m_search);
  layout->addWidget(m_table, 1);
  layout->addLayout(row);
  connect(m_search, &QLineEdit::textChanged, m_found, &QSortFilterProxyModel::setFilterFixedString);
  connect(m_search, &QLineEdit::textChanged, this, [this] { say({}); });
  connect(m_take, &QPushButton::clicked, this, &PseudonymsDialog::take);
  connect(m_copy, &QPushButton::clicked, this, &PseudonymsDialog::copy);
  connect(m_change, &QPushButton::clicked, this, &PseudonymsDialog::change);
  connect(m_lock, &QPushButton::clicked, this, [this] { lock({}); });
  return page;
}

void PseudonymsDialog::done(int result)
{
  lock({});
  QDialog::done(result);
}

bool PseudonymsDialog::eventFilter(QObject* watched, QEvent* event)
{
  switch (event->type())
  {
  case QEvent::KeyPress:
  case QEvent::MouseButtonPress:
  case QEvent::MouseMove:
  case QEvent::Wheel:
    if (m_map)
      m_idle.start(m_lockAfter);
    break;
  default:
    break;
  }
  return QDialog::eventFilter(watched, event);
}

// In the worker thread, as deriving the key takes about a second by intent.
void PseudonymsDialog::open()
{
  if (!m_open->isEnabled())
    return;
  const std::filesystem::path file = m_file->path();
  m_work.start(
      [this, file,
       secret = takePassphrase(*m_passphrase)](const core::Progress&) -> BackgroundWork::Reply
      {
        auto map = std::make_shared<library::PseudonymMap>(file, *secret);
        return [this, map]
        {
          m_map = map;
          m_entries.show(map.get());
          m_pages->setCurrentIndex(1);
          m_search->setFocus();
          m_idle.start(m_lockAfter);
          say({});
        };
      });
  say(tr("Opening…"));
}

void PseudonymsDialog::lock(const QString& why)
{
  m_work.drop();
  m_idle.stop();
  if (m_asked)
    m_asked->reject();
  m_search->clear();
  m_entries.show(nullptr);
  m_map.reset();
  clearPassphrase(*m_passphrase);
  m_pages->setCurrentIndex(0);
  m_passphrase->setFocus();
  say(why);
}

bool PseudonymsDialog::ask(const QString& title, const QString& text, bool fresh, QString* file,
                           Secret& secret)
{
  QDialog dialog(this);
  dialog.setObjectName("pseudonymsAsk");
  dialog.setWindowTitle(title);
  auto* about = new QLabel(text);
  wrapWords(*about);
  auto* path =
      new PathRow("otherFile", fresh ? PathRow::Kind::NewFile : PathRow::Kind::File, title);
  auto* first = passphraseLine("otherPassphrase");
  auto* second = passphraseLine("otherPassphraseAgain");
  auto* advice = new QLabel;
  advice->setObjectName("dim");
  advice->setTextFormat(Qt::PlainText);
  auto* form = new QFormLayout;
  if (file)
    form->addRow(tr("&File:"), path);
  form->addRow(tr("&Passphrase:"), first);
  if (fresh)
    form->addRow(tr("Once &more:"), second);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
  QPushButton* accept = buttons->button(QDialogButtonBox::Ok);
  connect(buttons, &QDialogButtonBox::accepted, &dialog, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, &dialog, &QDialog::reject);
  const auto check = [=]
  {
    const bool isThere = QFileInfo::exists(path->text());
    QString why;
    if (file && (path->text().isEmpty() || QFileInfo(path->text()).isDir()))
      why = tr("Choose the file.");
    else if (file && fresh && isThere)
      why = tr("That file is there already; give the copy a new name.");
    else if (file && !fresh && !isThere)
      why = tr("There is no such file.");
    else if (first->text().toUtf8().size() < kShortestPassphrase)
      why = tr("The passphrase must have at least %1 characters.").arg(kShortestPassphrase);
    else if (fresh && first->text() != second->text())
      why = tr("Type the same passphrase once more. Who forgets it cannot find out who is who.");
    advice->setText(why);
    accept->setEnabled(why.isEmpty());
  };
  connect(path, &PathRow::changed, &dialog, check);
  connect(first, &QLineEdit::textChanged, &dialog, check);
  connect(second, &QLineEdit::textChanged, &dialog, check);
  auto* layout = new QVBoxLayout(&dialog);
  layout->addWidget(about);
  layout->addLayout(form);
  layout->addWidget(advice);
  layout->addWidget(buttons);
  if (!file)
    path->setParent(&dialog), path->hide();
  if (!fresh)
    second->setParent(&dialog), second->hide();
  dialog.resize(600, 0);
  check();
  m_asked = &dialog;
  const bool wanted = dialog.exec() == QDialog::Accepted && m_map;
  if (wanted)
  {
    secret = takePassphrase(*first);
    if (file)
      *file = path->text();
  }
  clearPassphrase(*first);
  clearPassphrase(*second);
  return wanted;
}

void PseudonymsDialog::work(const QString& text, MapWork task)
{
  m_work.start([map = m_map, task = std::move(task)](const core::Progress&) -> BackgroundWork::Reply
               { return task(*map); });
  say(text);
}

// The table reads the map: it is empty while the map changes.
void PseudonymsDialog::take()
{
  QString file;
  Secret secret;
  if (!ask(tr("Take in another map"),
           tr("The pseudonyms of another file of this kind come to this one; that stays as it is."),
           false, &file, secret))
    return;
  const std::filesystem::path path = pathOf(file);
  m_entries.show(nullptr);
  work(tr("Opening…"),
       [this, path, secret](library::PseudonymMap& map) -> BackgroundWork::Reply
       {
         const library::PseudonymMap other(path, *secret);
         const std::size_t added = map.takeIn(other.entries());
         const bool hasOtherKey = other.key().bytes() != map.key().bytes();
         return [this, &map, added, hasOtherKey]
         {
           m_entries.show(&map);
           say((added == 1 ? tr("1 pseudonym is new.") : tr("%1 pseudonyms are new.").arg(added)) +
               (hasOtherKey ? ' ' + tr("The other map has a key of its own: new files of these "
                                       "patients get other pseudonyms than those.")
                            : QString()));
         };
       });
}

void PseudonymsDialog::copy()
{
  QString file;
  Secret secret;
  if (!ask(tr("Copy of the map"),
           tr("The whole map, with the key by which pseudonyms are made, under a passphrase of its "
              "own: a copy to keep, or for another computer of this house."),
           true, &file, secret))
    return;
  const std::filesystem::path path = pathOf(file);
  work(tr("Writing…"),
       [this, path, secret, file](library::PseudonymMap& map) -> BackgroundWork::Reply
       {
         map.saveCopy(path, *secret);
         return [this, file] { say(tr("Copied to %1").arg(file)); };
       });
}

void PseudonymsDialog::change()
{
  Secret secret;
  if (!ask(tr("Change the passphrase"),
           tr("From now on the file is opened by this passphrase. Copies keep theirs."), true,
           nullptr, secret))
    return;
  work(tr("Writing…"),
       [this, secret](library::PseudonymMap& map) -> BackgroundWork::Reply
       {
         map.changePassphrase(*secret);
         return [this] { say(tr("The passphrase is changed.")); };
       });
}

void PseudonymsDialog::say(const QString& text)
{
  const int count = m_found->rowCount();
  m_outcome->setText(!text.isEmpty() ? windowText(text)
                     : !m_map        ? QString()
                     : count == 1    ? tr("1 entry")
                                     : tr("%1 entries").arg(count));
  update();
}

void PseudonymsDialog::update()
{
  const bool busy = m_work.busy();
  m_open->setEnabled(!busy && !m_map && QFileInfo(m_file->text()).isFile() &&
                     m_passphrase->text().toUtf8().size() >= kShortestPassphrase);
  m_file->setEnabled(!busy);
  m_passphrase->setEnabled(!busy);
  for (QPushButton* one : {m_take, m_copy, m_change})
    one->setEnabled(!busy && m_map);
}

} // namespace petrous::workstation
