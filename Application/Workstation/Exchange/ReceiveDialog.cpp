#include "ReceiveDialog.h"

#include <algorithm>

#include <QCheckBox>
#include <QComboBox>
#include <QDate>
#include <QDateEdit>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTreeWidget>
#include <QVBoxLayout>

#include "PanelLayout.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Network/SceneObjects.h"

namespace petrous::workstation
{

namespace
{

constexpr std::size_t kMaxShown = 1000;
constexpr int kUid = Qt::UserRole; // of column 0
constexpr int kIsScene = Qt::UserRole + 1;
constexpr int kIsListed = Qt::UserRole + 2; // of a study: its series are there

QString nameText(const std::string& name)
{
  return words(name).replace('^', ' ').simplified();
}

QString dayText(const std::string& date)
{
  const QDate day = QDate::fromString(words(date), "yyyyMMdd");
  return day.isValid() ? day.toString(dateFormat()) : words(date);
}

QString countText(int count)
{
  return count < 0 ? QString() : QString::number(count);
}

} // namespace

ReceiveDialog::ReceiveDialog(const std::vector<network::Node>& nodes,
                             const library::Library& library, QWidget* parent)
  : QDialog(parent)
  , m_nodes(nodes)
  , m_library(library)
  , m_node(new QComboBox)
  , m_case(new QLineEdit)
  , m_id(new QLineEdit)
  , m_name(new QLineEdit)
  , m_dated(new QCheckBox(tr("&Between")))
  , m_from(new QDateEdit(QDate::currentDate().addMonths(-1)))
  , m_to(new QDateEdit(QDate::currentDate()))
  , m_modality(new QComboBox)
  , m_found(new QTreeWidget)
  , m_outcome(new QLabel)
{
  setObjectName("receive");
  setWindowTitle(tr("Receive from a node"));
  m_node->setObjectName("receiveNode");
  for (const network::Node& node : nodes)
    m_node->addItem(words(node.name));
  m_case->setObjectName("receiveCaseName");
  m_case->setPlaceholderText(tr("of a case that was sent by Petrous"));
  m_case->setToolTip(tr("A part of the name is enough; * stands for any text"));
  m_id->setObjectName("receiveId");
  m_id->setToolTip(tr("* stands for any text"));
  m_name->setObjectName("receiveName");
  m_name->setPlaceholderText(tr("family name, or family^given"));
  m_name->setToolTip(tr("The beginning is enough; * stands for any text"));
  m_dated->setObjectName("receiveDated");
  for (QDateEdit* date : {m_from, m_to})
  {
    date->setDisplayFormat(dateFormat());
    date->setCalendarPopup(true);
    date->setEnabled(false);
    connect(m_dated, &QCheckBox::toggled, date, &QWidget::setEnabled);
  }
  m_modality->addItem(tr("any"), QString());
  for (const char* modality : {"CT", "MR", "OT"})
    m_modality->addItem(QString(modality) == "OT" ? tr("OT (Petrous scenes)") : modality, modality);
  m_found->setObjectName("receiveFound");
  m_found->setAccessibleName(tr("Patients and series that were found"));
  m_found->setHeaderLabels({tr("Case, patient, or series"), tr("ID"), tr("Date"), tr("Description"),
                            tr("Modality"), tr("Images")});
  m_found->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  m_found->header()->setStretchLastSection(false);
  m_found->header()->setSectionResizeMode(3, QHeaderView::Stretch);
  m_outcome->setObjectName("receiveOutcome");
  m_outcome->setTextFormat(Qt::PlainText);
  wrapWords(*m_outcome);

  auto* dates = new QHBoxLayout;
  dates->addWidget(m_dated);
  dates->addWidget(m_from);
  dates->addWidget(new QLabel(tr("and")));
  dates->addWidget(m_to);
  dates->addStretch();
  auto* form = new QFormLayout;
  form->addRow(tr("&Node:"), m_node);
  form->addRow(tr("C&ase:"), m_case);
  form->addRow(tr("Patient &ID:"), m_id);
  form->addRow(tr("Pa&tient name:"), m_name);
  form->addRow(tr("Study date:"), dates);
  form->addRow(tr("&Modality:"), m_modality);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  m_search = buttons->addButton(tr("&Search"), QDialogButtonBox::ActionRole);
  m_search->setObjectName("receiveSearch");
  m_search->setDefault(true);
  m_receive = buttons->addButton(tr("&Receive"), QDialogButtonBox::AcceptRole);
  m_receive->setObjectName("primary");
  m_receive->setAutoDefault(false);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(m_search, &QPushButton::clicked, this, &ReceiveDialog::search);
  connect(m_node, qOverload<int>(&QComboBox::currentIndexChanged), this,
          [this]
          {
            m_found->clear(); // another node has others
            say({});
          });
  connect(m_found, &QTreeWidget::itemExpanded, this, &ReceiveDialog::listSeries);
  connect(m_found, &QTreeWidget::itemChanged, this, &ReceiveDialog::update);
  connect(&m_work, &BackgroundWork::failed, this, &ReceiveDialog::say);
  connect(&m_work, &BackgroundWork::cancelled, this, [this] { say(tr("Stopped")); });
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(form);
  layout->addWidget(m_found, 1);
  layout->addWidget(m_outcome);
  layout->addWidget(buttons);
  resize(820, 560);
  // Cases have a patient each, who is nobody.
  const auto caseAlone = [this]
  {
    const bool isCase = !m_case->text().trimmed().isEmpty();
    m_id->setEnabled(!isCase);
    m_name->setEnabled(!isCase);
    m_dated->setEnabled(!isCase);
    for (QDateEdit* date : {m_from, m_to})
      date->setEnabled(!isCase && m_dated->isChecked());
  };
  connect(m_case, &QLineEdit::textChanged, this, caseAlone);
  say(tr("Search as it is for all cases of Petrous, or give the name of a case, or the patient's "
         "ID, name or a date. Open a study to see its series."));
}

ReceiveDialog::~ReceiveDialog()
{
  m_work.drop();
}

network::Node ReceiveDialog::node() const
{
  return m_nodes.at(static_cast<std::size_t>(m_node->currentIndex()));
}

presenters::StudySearch ReceiveDialog::wanted() const
{
  presenters::StudySearch search;
  search.caseName = bytes(m_case->text().trimmed());
  network::StudyFilter& filter = search.filter;
  filter.modality = bytes(m_modality->currentData().toString());
  if (!search.caseName.empty())
    return search;
  filter.patientId = bytes(m_id->text().trimmed());
  filter.patientName = bytes(m_name->text().trimmed());
  if (!filter.patientName.empty() && filter.patientName.find('*') == std::string::npos)
    filter.patientName += '*';
  if (m_dated->isChecked())
  {
    filter.from = bytes(m_from->date().toString("yyyyMMdd"));
    filter.to = bytes(m_to->date().toString("yyyyMMdd"));
  }
  return search;
}

void ReceiveDialog::begin(const QString& text, BackgroundWork::Work work)
{
  m_work.start(std::move(work));
  say(text);
}

void ReceiveDialog::say(const QString& text)
{
  m_outcome->setText(windowText(text));
  m_search->setText(m_work.busy() ? tr("&Stop") : tr("&Search"));
  m_node->setEnabled(!m_work.busy());
  update();
}

void ReceiveDialog::search()
{
  if (m_work.busy())
    return m_work.cancel();
  const presenters::StudySearch search = wanted();
  if (!search.filter.from.empty() && search.filter.from > search.filter.to)
    return say(tr("The first date is after the last one."));
  m_found->clear();
  begin(tr("Asking “%1”…").arg(words(node().name)),
        [this, node = node(), search,
         library = m_library](const core::Progress& progress) -> BackgroundWork::Reply
        {
          return [this, found = presenters::searchStudies(node, search, library, progress)]
          { show(found); };
        });
}

void ReceiveDialog::show(const presenters::FoundStudies& found)
{
  const std::vector<presenters::FoundStudy>& studies = found.studies;
  std::vector<presenters::FoundStudy> latest = studies;
  std::stable_sort(latest.begin(), latest.end(),
                   [](const presenters::FoundStudy& a, const presenters::FoundStudy& b) {
                     return std::make_pair(a.study.date, b.caseName) >
                            std::make_pair(b.study.date, a.caseName);
                   });
  latest.resize(std::min(latest.size(), kMaxShown));
  QList<QTreeWidgetItem*> items;
  for (const auto& [study, isCase, caseName, otherName] : latest)
  {
    const QString who =
        !otherName.empty()
            ? tr("Case “%1”, there of the patient %2").arg(words(caseName), nameText(otherName))
        : !caseName.empty() ? tr("Case “%1”").arg(words(caseName))
        : isCase            ? tr("Case, name not told")
                            : nameText(study.patientName);
    auto* item = new QTreeWidgetItem(
        QStringList{who, words(study.patientId), dayText(study.date), words(study.description),
                    words(study.modalities).replace('\\', ", "), countText(study.instances)});
    item->setData(0, kUid, words(study.uid));
    item->setToolTip(0, tr("Study %1").arg(words(study.uid))); // as who sent it was told
    item->setChildIndicatorPolicy(QTreeWidgetItem::ShowIndicator);
    item->setFlags(item->flags() & ~Qt::ItemIsUserCheckable);
    items += item;
  }
  m_found->addTopLevelItems(items);
  QString outcome =
      studies.empty() ? tr("“%1” has no such study.").arg(words(node().name))
      : studies.size() > kMaxShown
          ? tr("%1 studies; the latest %2 are shown. Give more of the patient, or fewer days.")
                .arg(studies.size())
                .arg(kMaxShown)
      : studies.size() == 1 ? tr("1 study")
                            : tr("%1 studies").arg(studies.size());
  for (const std::string& note : found.notes)
    outcome += '\n' + phrase(note);
  say(outcome);
  if (studies.size() == 1)
    m_found->topLevelItem(0)->setExpanded(true);
}

// Asked of the node when a study is opened.
void ReceiveDialog::listSeries(QTreeWidgetItem* study)
{
  if (study->parent() || study->data(0, kIsListed).toBool())
    return;
  if (m_work.busy())
    return study->setExpanded(false);
  const QString uid = study->data(0, kUid).toString();
  begin(tr("Asking “%1” for the series…").arg(words(node().name)),
        [this, node = node(), uid](const core::Progress& progress) -> BackgroundWork::Reply
        {
          return [this, uid, series = network::findSeries(node, bytes(uid), progress)]
          {
            QTreeWidgetItem* above = nullptr;
            for (int n = 0; n < m_found->topLevelItemCount(); ++n)
              if (m_found->topLevelItem(n)->data(0, kUid).toString() == uid)
                above = m_found->topLevelItem(n);
            if (!above)
              return;
            const QSignalBlocker blocked(m_found); // each change looks at all rows
            above->setData(0, kIsListed, true);
            const auto scenes = network::scenesAmong(series);
            const bool hasScene = !scenes.empty();
            for (const network::Series& one : series)
            {
              const bool isScene = std::any_of(scenes.begin(), scenes.end(),
                                               [&one](const network::Series& scene)
                                               { return scene.uid == one.uid; });
              const bool isImage =
                  one.modality == "CT" || one.modality == "MR" || one.modality == "SEG";
              if (isScene && one.number != scenes.front().number)
                continue; // replaced by a later one
              auto* item = new QTreeWidgetItem(
                  above, {isScene ? tr("Petrous case") : tr("Series %1").arg(one.number),
                          {},
                          {},
                          words(one.description),
                          words(one.modality),
                          countText(one.instances)});
              item->setData(0, kUid, words(one.uid));
              item->setData(0, kIsScene, isScene);
              const bool chosen = hasScene ? isScene : isImage && series.size() == 1;
              item->setCheckState(0, chosen ? Qt::Checked : Qt::Unchecked);
              item->setDisabled(!isScene && !isImage);
            }
            say(hasScene ? tr("The study holds a case of Petrous: it comes as it was sent.")
                         : tr("Tick the series to receive; they are then imported as a folder "
                              "of DICOM is."));
          };
        });
}

ReceiveDialog::Choice ReceiveDialog::choice() const
{
  Choice choice;
  choice.node = node();
  for (int n = 0; n < m_found->topLevelItemCount(); ++n)
  {
    const QTreeWidgetItem* study = m_found->topLevelItem(n);
    for (int s = 0; s < study->childCount(); ++s)
    {
      const QTreeWidgetItem* series = study->child(s);
      if (series->checkState(0) != Qt::Checked || series->isDisabled())
        continue;
      const std::string uid = bytes(study->data(0, kUid).toString());
      if (!choice.study.empty() && choice.study != uid)
        return {}; // of one study only
      choice.study = uid;
      choice.scene = choice.scene || series->data(0, kIsScene).toBool();
      choice.series.push_back(bytes(series->data(0, kUid).toString()));
    }
  }
  if (choice.scene && choice.series.size() > 1)
    return {};
  return choice;
}

void ReceiveDialog::update()
{
  m_receive->setEnabled(!m_work.busy() && !choice().study.empty());
  m_receive->setToolTip(tr("Series of one study, or a case of Petrous"));
}

} // namespace petrous::workstation
