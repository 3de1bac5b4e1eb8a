#include "GuiTest.h"

#include <fstream>

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QSpinBox>
#include <QTreeWidget>

#include "../../../Modules/Imaging/Testing/TestDicom.h"
#include "../../../Modules/Network/Testing/TestServers.h"
#include "Theme.h"
#include "petrous/Library/PseudonymMap.h"
#include "petrous/Network/NodeList.h"
#include "petrous/Presenters/CaseTransfer.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

namespace fs = std::filesystem;

class Exchange : public GuiTest
{
protected:
  fs::path libraryFolder() const { return folder() / "library"; }
  void menu(const char* name) { window().findChild<QAction*>(name)->trigger(); }
  QDialog* report() { return window().findChild<QDialog*>("report"); }
  QString reportHead() { return report()->findChild<QLabel*>("reportHead")->text(); }
  QString reportText() { return report()->findChild<QPlainTextEdit*>("reportText")->toPlainText(); }
  static void type(QDialog& dialog, const char* name, const QString& text)
  {
    auto* line = dialog.findChild<QLineEdit*>(name);
    ASSERT_TRUE(line) << name;
    line->setText(text);
  }
  static QPushButton& button(QDialog& dialog, const char* name)
  {
    return *dialog.findChild<QPushButton*>(name);
  }
  void keepPicture(QDialog& dialog, const char* name)
  {
    const QString pictures = qEnvironmentVariable("PETROUS_GUI_PICTURES");
    if (!pictures.isEmpty()) // for visual inspection
      dialog.grab().save(QString("%1/%2.png").arg(pictures, name));
  }
  bool isOpen(const char* name)
  {
    return waitFor(
        [&]
        {
          return window().model().hasCase() && window().model().value().name == name &&
                 !window().busy();
        });
  }
};

} // namespace

// Added, changed, called without an answer, removed; TLS needs certificate and key together.
TEST_F(Exchange, NodesAreKeptWithTheLibrary)
{
  saveBall("ball");
  openWindow("ball");
  const int port = network::test::freePort(); // nobody listens there
  QString outcome;
  bool done = false;
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "nodes")
          return false;
        const auto told = [&] { return dialog.findChild<QLabel*>("nodeOutcome")->text(); };
        EXPECT_FALSE(button(dialog, "keepNode").isEnabled());
        type(dialog, "nodeName", "pacs");
        type(dialog, "nodeHost", "127.0.0.1:104");
        type(dialog, "nodeTitle", "PACS");
        dialog.findChild<QSpinBox*>("nodePort")->setValue(port);
        button(dialog, "keepNode").click();
        EXPECT_TRUE(told().contains("without a port")) << told().toStdString();
        type(dialog, "nodeHost", "127.0.0.1");
        button(dialog, "keepNode").click();
        EXPECT_EQ(network::NodeList(libraryFolder()).at("pacs").port, port);

        button(dialog, "testNode").click();
        EXPECT_TRUE(waitFor([&] { return !told().isEmpty() && !told().contains("Calling"); }));
        EXPECT_TRUE(told().contains("pacs")) << told().toStdString();
        EXPECT_FALSE(told().contains(" ms")) << told().toStdString();

        dialog.findChild<QCheckBox*>("nodeTls")->setChecked(true);
        type(dialog, "nodeCertificate", "/somewhere/own.pem");
        button(dialog, "keepNode").click();
        EXPECT_TRUE(told().contains("together")) << told().toStdString();
        EXPECT_FALSE(network::NodeList(libraryFolder()).at("pacs").tls) << "as it was";
        type(dialog, "nodeKey", "/somewhere/own.key");
        type(dialog, "nodeOwnTitle", "EAR");
        type(dialog, "nodeCertifiedName", "pacs.example");
        EXPECT_FALSE(dialog.findChild<QLineEdit*>("nodeMoveHost")->isEnabled());
        dialog.findChild<QSpinBox*>("nodeMovePort")->setValue(11113);
        EXPECT_TRUE(dialog.findChild<QLineEdit*>("nodeMoveHost")->isEnabled());
        type(dialog, "nodeMoveHost", "10.0.0.7");
        button(dialog, "keepNode").click();
        const network::Node changed = network::NodeList(libraryFolder()).at("pacs");
        EXPECT_TRUE(changed.tls && changed.tls->key == "/somewhere/own.key");
        EXPECT_EQ(changed.callingAeTitle, "EAR");
        EXPECT_EQ(changed.tls->name, "pacs.example");
        EXPECT_EQ(changed.moveHost, "10.0.0.7");
        keepPicture(dialog, "nodes");
        button(dialog, "removeNode").click();
        EXPECT_TRUE(network::NodeList(libraryFolder()).nodes().empty());
        done = true;
        dialog.reject();
        return true;
      });
  menu("editNodes");
  EXPECT_TRUE(done);
}

// To a node and back, with what leaves shown before; the case that returns is the same.
TEST_F(Exchange, ACaseGoesToANodeAndComesBack)
{
  if (!network::test::Orthanc::installed())
    GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  saveBall("ball");
  const network::test::Orthanc orthanc(folder(), {});
  network::NodeList(libraryFolder()).add(orthanc.node());
  openWindow("ball");
  drill(300);
  const double removed = window().model().value().removedVolume();
  bool shown = false;
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "sendCase")
          return false;
        const QString text = dialog.findChild<QPlainTextEdit*>("sendReport")->toPlainText();
        EXPECT_TRUE(text.contains("nerve") && text.contains("'ball'")) << text.toStdString();
        EXPECT_FALSE(dialog.findChild<QCheckBox*>("sendMr")->isEnabled()) << "it has none";
        for (const char* what : {"sendCt", "sendLabels", "sendScene"})
          dialog.findChild<QCheckBox*>(what)->setChecked(false);
        EXPECT_FALSE(button(dialog, "primary").isEnabled());
        for (const char* what : {"sendCt", "sendLabels", "sendScene"})
          dialog.findChild<QCheckBox*>(what)->setChecked(true);
        keepPicture(dialog, "send");
        shown = true;
        button(dialog, "primary").click();
        return true;
      });
  menu("sendOpenCase");
  ASSERT_TRUE(shown);
  ASSERT_TRUE(waitFor([&] { return report() && !window().busy(); }));
  EXPECT_TRUE(reportHead().contains("has all of them")) << reportHead().toStdString();
  const auto sums =
      QRegularExpression("(\\d+) objects, \\d+\\.\\d MB in \\d+\\.\\d s").match(reportHead());
  ASSERT_TRUE(sums.hasMatch()) << reportHead().toStdString();
  int objects = 0;
  for (const network::Study& study : network::findStudies(orthanc.node(), {}))
    for (const network::Series& series : network::findSeries(orthanc.node(), study.uid))
      objects += series.instances;
  EXPECT_EQ(sums.captured(1).toInt(), objects) << reportHead().toStdString();
  report()->close();
  library().rename("ball", "original");
  closeWindow();

  openWindow("original");
  bool chosen = false;
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "receive")
          return false;
        button(dialog, "receiveSearch").click();
        EXPECT_TRUE(dialog.findChild<QLabel*>("receiveOutcome")->text().contains("ID"))
            << "not everything that a PACS has";
        type(dialog, "receiveId", "ANONYMOUS");
        button(dialog, "receiveSearch").click();
        auto* found = dialog.findChild<QTreeWidget*>("receiveFound");
        EXPECT_TRUE(waitFor(
            [&] {
              return found->topLevelItemCount() == 1 && found->topLevelItem(0)->childCount() == 3;
            }));
        keepPicture(dialog, "receive");
        EXPECT_TRUE(button(dialog, "primary").isEnabled()) << "the scene is proposed";
        chosen = true;
        button(dialog, "primary").click();
        return true;
      });
  menu("receiveCase");
  ASSERT_TRUE(chosen);
  ASSERT_TRUE(isOpen("ball"));
  EXPECT_NEAR(window().model().value().removedVolume(), removed, 1e-9);
  EXPECT_EQ(library().open("ball").ct.object, library().open("original").ct.object);
}

// Where the library has a case of its name, another one is asked for; what another node listed is
// forgotten with it.
TEST_F(Exchange, AReceivedCaseOfATakenNameGetsAnotherOne)
{
  if (!network::test::Orthanc::installed())
    GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  saveBall("ball");
  const network::test::Orthanc orthanc(folder(), {});
  network::Node node = orthanc.node();
  network::NodeList(libraryFolder()).add(node);
  node.name = "another";
  network::NodeList(libraryFolder()).add(node);
  presenters::SendParts parts;
  parts.scene = true;
  presenters::sendCase(library(), "ball", node, parts);
  openWindow("ball");
  QString asked;
  onDialog(
      [&](QDialog& dialog)
      {
        if (auto* name = qobject_cast<QInputDialog*>(&dialog))
        {
          asked = name->labelText() + " " + name->textValue();
          name->setTextValue("ball again");
          name->accept();
          return true;
        }
        if (dialog.objectName() != "receive")
          return false;
        auto* found = dialog.findChild<QTreeWidget*>("receiveFound");
        auto* which = dialog.findChild<QComboBox*>("receiveNode");
        type(dialog, "receiveId", "ANONYMOUS");
        const auto search = [&]
        {
          button(dialog, "receiveSearch").click();
          EXPECT_FALSE(which->isEnabled()) << "while it is asked";
          EXPECT_TRUE(waitFor(
              [&] {
                return found->topLevelItemCount() == 1 && found->topLevelItem(0)->childCount() == 1;
              }));
        };
        search();
        EXPECT_TRUE(button(dialog, "primary").isEnabled());
        which->setCurrentIndex(1);
        EXPECT_EQ(found->topLevelItemCount(), 0) << "of the other node";
        EXPECT_FALSE(button(dialog, "primary").isEnabled());
        search();
        button(dialog, "primary").click();
        return true;
      });
  menu("receiveCase");
  ASSERT_TRUE(isOpen("ball again"));
  EXPECT_TRUE(asked.contains("“ball”") && asked.contains("ball 2")) << asked.toStdString();
  EXPECT_EQ(library().open("ball").ct.object, library().open("ball again").ct.object);
}

// A node that does not answer is named, and nothing is lost.
TEST_F(Exchange, WhySendingFailsIsTold)
{
  saveBall("ball");
  network::Node node;
  node.name = "pacs";
  node.host = "127.0.0.1";
  node.port = network::test::freePort();
  node.aeTitle = "PACS";
  network::NodeList(libraryFolder()).add(node);
  openWindow("ball");
  QString why;
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() == "sendCase")
          button(dialog, "primary").click();
        auto* box = qobject_cast<QMessageBox*>(&dialog);
        if (!box)
          return false;
        why = box->text();
        box->accept();
        return true;
      });
  menu("sendOpenCase");
  ASSERT_TRUE(waitFor([&] { return !why.isEmpty() && !window().busy(); }));
  EXPECT_TRUE(why.contains("pacs") && why.contains(QString::number(node.port)))
      << why.toStdString();
  EXPECT_TRUE(isOpen("ball"));
}

// With a new map: its passphrase is typed twice, and kept nowhere.
TEST_F(Exchange, AFolderIsDeidentified)
{
  const QString secret = "one long passphrase";
  const fs::path in = folder() / "in";
  fs::create_directories(in);
  imaging::test::writeSeries(in, 4);
  openWindow();
  bool done = false;
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "deidentify")
          return false;
        QPushButton& accept = button(dialog, "primary");
        EXPECT_FALSE(accept.isEnabled());
        type(dialog, "deidentifyInput", QString::fromStdString(in.string()));
        type(dialog, "deidentifyOutput", QString::fromStdString(in.string()));
        EXPECT_FALSE(accept.isEnabled()) << "not empty";
        type(dialog, "deidentifyOutput", QString::fromStdString((folder() / "out").string()));
        EXPECT_TRUE(accept.isEnabled());
        dialog.findChild<QCheckBox*>("useMap")->setChecked(true);
        type(dialog, "pseudonymMap", QString::fromStdString((folder() / "map").string()));
        type(dialog, "passphrase", "short");
        EXPECT_FALSE(accept.isEnabled());
        type(dialog, "passphrase", secret);
        EXPECT_FALSE(accept.isEnabled()) << "once more";
        type(dialog, "passphraseAgain", secret);
        EXPECT_TRUE(accept.isEnabled());
        keepPicture(dialog, "deidentify");
        done = true;
        accept.click();
        return true;
      });
  menu("deidentifyFolder");
  ASSERT_TRUE(done);
  ASSERT_TRUE(waitFor([&] { return report() && !window().busy(); }));
  EXPECT_TRUE(reportHead().contains("de-identified")) << reportHead().toStdString();
  EXPECT_TRUE(reportText().contains("(0010,0010)"));
  EXPECT_TRUE(fs::exists(folder() / "out"));
  EXPECT_FALSE(library::PseudonymMap(folder() / "map", bytes(secret)).entries().empty());
  closeWindow();
  for (const auto& entry : fs::recursive_directory_iterator(folder()))
    if (entry.is_regular_file())
    {
      std::ifstream file(entry.path(), std::ios::binary);
      const std::string all{std::istreambuf_iterator<char>(file), {}};
      EXPECT_EQ(all.find(bytes(secret)), std::string::npos) << entry.path();
    }
}
