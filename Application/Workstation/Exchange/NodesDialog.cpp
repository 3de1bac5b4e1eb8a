#include "NodesDialog.h"

#include <chrono>

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSpinBox>
#include <QVBoxLayout>

#include "Application.h"
#include "PanelLayout.h"
#include "PathRow.h"
#include "Theme.h"
#include "WindowTexts.h"

namespace petrous::workstation
{

namespace
{

constexpr int kHighestPort = 65535;

QSpinBox* portBox(const char* name, int lowest)
{
  auto* box = new QSpinBox;
  box->setObjectName(name);
  box->setRange(lowest, kHighestPort);
  box->setGroupSeparatorShown(false);
  return box;
}

QLineEdit* line(const char* name, const QString& tip)
{
  auto* edit = new QLineEdit;
  edit->setObjectName(name);
  edit->setToolTip(tip);
  return edit;
}

} // namespace

NodesDialog::NodesDialog(std::filesystem::path library, QWidget* parent)
  : QDialog(parent)
  , m_library(std::move(library))
  , m_list(new QListWidget)
  , m_name(line("nodeName", tr("Your name for the node")))
  , m_host(line("nodeHost", tr("Name or IPv4 address of the computer, without a port")))
  , m_port(portBox("nodePort", 1))
  , m_title(line("nodeTitle", tr("By which the node is called: 1 to 16 characters. Whoever runs "
                                 "the node knows it")))
  , m_own(line("nodeOwnTitle", tr("By which the node knows this computer: it has to be entered "
                                  "there")))
  , m_movePort(portBox("nodeMovePort", 0))
  , m_moveHost(line("nodeMoveHost", tr("Name or IPv4 address of the computer from which the node "
                                       "sends by C-MOVE; * for any. Nobody else is let in")))
  , m_tls(new QCheckBox(tr("&Encrypted (TLS 1.2 or later)")))
  , m_certifiedName(line("nodeCertifiedName",
                         tr("Name or IP address in the node's certificate, where it is not the "
                            "host; * if any of the trusted certificates will do, as where the "
                            "node's own is the only one")))
  , m_authority(new PathRow("nodeAuthority", PathRow::Kind::File, tr("Certificates to trust")))
  , m_certificate(
        new PathRow("nodeCertificate", PathRow::Kind::File, tr("Certificate of this computer")))
  , m_key(new PathRow("nodeKey", PathRow::Kind::File, tr("Key of that certificate")))
  , m_outcome(new QLabel)
{
  setObjectName("nodes");
  setWindowTitle(tr("DICOM nodes"));
  layOut();
  connect(m_list, &QListWidget::currentTextChanged, this,
          [this](const QString& name)
          {
            attempt(
                [&]
                {
                  const network::NodeList nodes(m_library);
                  if (!name.isEmpty())
                    show(nodes.at(bytes(name)));
                });
          });
  connect(&m_work, &BackgroundWork::failed, this, [this](const QString& why) { say(why); });
  connect(&m_work, &BackgroundWork::cancelled, this, [this] { say(tr("Stopped")); });
  network::Node fresh;
  fresh.aeTitle = "";
  show(fresh);
  fill({});
  check();
}

NodesDialog::~NodesDialog()
{
  m_work.drop();
}

void NodesDialog::layOut()
{
  m_list->setObjectName("nodeList");
  m_list->setAccessibleName(tr("Nodes"));
  m_list->setMaximumWidth(180);
  m_tls->setObjectName("nodeTls");
  m_tls->setToolTip(tr("The node's certificate is always verified, and must be of its host, or of "
                       "the name below"));
  m_certifiedName->setPlaceholderText(tr("the host"));
  m_moveHost->setPlaceholderText(tr("the host"));
  m_movePort->setSpecialValueText(tr("not needed (C-GET)"));
  m_movePort->setToolTip(
      tr("For a node without C-GET: the port at which this computer listens for what the node "
         "sends by C-MOVE. The node must know your AE title at this computer and port"));
  m_authority->setPlaceholder(tr("those of the system"));
  m_certificate->setPlaceholder(tr("none; only if the node wants one"));
  m_key->setPlaceholder(tr("PEM, without a passphrase"));
  m_outcome->setObjectName("nodeOutcome");
  m_outcome->setTextFormat(Qt::PlainText);
  wrapWords(*m_outcome, 3);
  m_outcome->setAlignment(Qt::AlignTop);
  m_outcome->setTextInteractionFlags(Qt::TextSelectableByMouse);

  auto* form = new QFormLayout;
  form->addRow(tr("&Name:"), m_name);
  form->addRow(tr("&Host:"), m_host);
  form->addRow(tr("&Port:"), m_port);
  form->addRow(tr("&AE title:"), m_title);
  form->addRow(tr("&Your AE title:"), m_own);
  form->addRow(tr("Port for C-&MOVE:"), m_movePort);
  form->addRow(tr("C-MOVE &from:"), m_moveHost);
  form->addRow({}, m_tls);
  form->addRow(tr("&Trusted certificates:"), m_authority);
  form->addRow(tr("Name &in its certificate:"), m_certifiedName);
  form->addRow(tr("Y&our certificate:"), m_certificate);
  form->addRow(tr("Your &key:"), m_key);

  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  const auto add = [&](const char* name, const QString& text, const QString& tip)
  {
    auto* button = buttons->addButton(text, QDialogButtonBox::ActionRole);
    button->setObjectName(name);
    button->setToolTip(tip);
    button->setAutoDefault(false);
    return button;
  };
  m_keep = add("keepNode", tr("A&dd"), tr("Keeps the node in the library, without any secret"));
  m_keep->setDefault(true); // Return in a field
  buttons->button(QDialogButtonBox::Close)->setAutoDefault(false);
  m_test = add("testNode", tr("Te&st"), tr("Calls the node (C-ECHO), kept or not"));
  m_remove = add("removeNode", tr("&Remove"), tr("Takes the node out of the list"));
  connect(m_keep, &QPushButton::clicked, this, &NodesDialog::keep);
  connect(m_test, &QPushButton::clicked, this, &NodesDialog::test);
  connect(m_remove, &QPushButton::clicked, this, &NodesDialog::remove);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  for (QLineEdit* edit : {m_name, m_host, m_title, m_own})
    connect(edit, &QLineEdit::textChanged, this, &NodesDialog::check);
  connect(m_tls, &QCheckBox::toggled, this, &NodesDialog::check);
  connect(m_movePort, qOverload<int>(&QSpinBox::valueChanged), this, &NodesDialog::check);

  auto* across = new QHBoxLayout;
  across->addWidget(m_list);
  across->addLayout(form, 1);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(across, 1);
  layout->addWidget(m_outcome);
  layout->addWidget(buttons);
  resize(720, 460);
}

std::string NodesDialog::chosen() const
{
  return m_list->currentItem() ? bytes(m_list->currentItem()->text()) : std::string();
}

void NodesDialog::fill(const std::string& current)
{
  attempt(
      [&]
      {
        m_list->clear();
        const network::NodeList nodes(m_library);
        for (const network::Node& node : nodes.nodes())
        {
          auto* item = new QListWidgetItem(words(node.name), m_list);
          item->setToolTip(QString("%1 %2 %3:%4")
                               .arg(words(node.aeTitle), tr("at"), words(node.host))
                               .arg(node.port));
          if (node.name == current)
            m_list->setCurrentItem(item);
        }
        if (m_list->count() > 0 && !m_list->currentItem())
          m_list->setCurrentRow(0);
      });
  check();
}

void NodesDialog::show(const network::Node& node)
{
  m_name->setText(words(node.name));
  m_host->setText(words(node.host));
  m_port->setValue(node.port);
  m_title->setText(words(node.aeTitle));
  m_own->setText(words(node.callingAeTitle));
  m_movePort->setValue(node.movePort);
  m_moveHost->setText(words(node.moveHost));
  m_tls->setChecked(node.tls.has_value());
  const network::TlsFiles files = node.tls.value_or(network::TlsFiles{});
  m_authority->setText(words(files.authority));
  m_certifiedName->setText(words(files.name));
  m_certificate->setText(words(files.certificate));
  m_key->setText(words(files.key));
  check();
}

network::Node NodesDialog::typed() const
{
  network::Node node;
  node.name = bytes(m_name->text().trimmed());
  node.host = bytes(m_host->text().trimmed());
  node.port = m_port->value();
  node.aeTitle = bytes(m_title->text().trimmed());
  node.callingAeTitle = bytes(m_own->text().trimmed());
  node.movePort = m_movePort->value();
  node.moveHost = bytes(m_moveHost->text().trimmed());
  if (m_tls->isChecked())
    node.tls = network::TlsFiles{m_authority->path().string(), m_certificate->path().string(),
                                 m_key->path().string(), bytes(m_certifiedName->text().trimmed())};
  return node;
}

void NodesDialog::check()
{
  for (PathRow* row : {m_authority, m_certificate, m_key})
    row->setEnabled(m_tls->isChecked());
  m_certifiedName->setEnabled(m_tls->isChecked());
  m_moveHost->setEnabled(m_movePort->value() > 0);
  const QString name = m_name->text().trimmed();
  const bool known = !name.isEmpty() && !m_list->findItems(name, Qt::MatchExactly).isEmpty();
  const bool complete = !name.isEmpty() && !m_host->text().trimmed().isEmpty() &&
                        !m_title->text().trimmed().isEmpty() && !m_own->text().trimmed().isEmpty();
  m_keep->setText(known ? tr("&Change") : tr("A&dd"));
  m_keep->setEnabled(complete);
  m_test->setEnabled(complete);
  m_remove->setEnabled(known);
}

void NodesDialog::attempt(const std::function<void()>& change)
{
  try
  {
    change();
  }
  catch (const std::exception& error)
  {
    say(toString(error));
  }
}

void NodesDialog::say(const QString& text)
{
  m_outcome->setText(windowText(text));
  m_test->setText(m_work.busy() ? tr("&Stop") : tr("Te&st"));
}

// A changed node replaces the one of its name.
void NodesDialog::keep()
{
  attempt(
      [this]
      {
        const network::Node node = typed();
        network::checkNode(node);
        network::checkTlsFiles(node);
        network::NodeList nodes(m_library);
        const bool known = !m_list->findItems(words(node.name), Qt::MatchExactly).isEmpty();
        if (known)
          nodes.replace(node);
        else
          nodes.add(node);
        fill(node.name);
        say(known ? tr("“%1” is changed.").arg(words(node.name))
                  : tr("“%1” is kept. Test calls it.").arg(words(node.name)));
      });
}

void NodesDialog::test()
{
  if (m_work.busy())
    return m_work.cancel();
  attempt(
      [this]
      {
        const network::Node node = typed();
        network::checkNode(node);
        m_work.start(
            [this, node](const core::Progress& progress) -> BackgroundWork::Reply
            {
              const auto start = std::chrono::steady_clock::now();
              network::echo(node, progress);
              const auto time = std::chrono::duration_cast<std::chrono::milliseconds>(
                  std::chrono::steady_clock::now() - start);
              return [this, name = node.name, ms = time.count()]
              { say(tr("“%1” answers, after %2 ms.").arg(words(name)).arg(ms)); };
            });
        say(tr("Calling “%1”…").arg(words(node.name)));
      });
}

void NodesDialog::remove()
{
  attempt(
      [this]
      {
        const std::string name = bytes(m_name->text().trimmed());
        network::NodeList nodes(m_library);
        const network::Node removed = nodes.at(name);
        nodes.remove(name);
        fill({});
        show(removed);
        say(tr("“%1” is removed. To take it back, press Add now.").arg(words(name)));
      });
}

} // namespace petrous::workstation
