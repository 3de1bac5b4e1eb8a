#include "ArchiveDialog.h"
#include "GuiTest.h"

#include <fstream>

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDir>
#include <QElapsedTimer>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QProgressDialog>
#include <QPushButton>
#include <QRegularExpression>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTableView>
#include <QTimer>
#include <QTreeWidget>

#include "../../../Modules/Imaging/Testing/TestDicom.h"
#include "../../../Modules/Network/Testing/TestServers.h"
#include "../../../Modules/Volume/Testing/SyntheticHead.h"
#include "ExchangeController.h"
#include "FaceCheck.h"
#include "PseudonymsDialog.h"
#include "SendDialog.h"
#include "Theme.h"
#include "petrous/Library/PseudonymMap.h"
#include "petrous/Network/DicomNode.h"
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
  static scene::Case ballWithMr()
  {
    scene::Case value = ballCase("ball");
    scene::ImagePart mr = value.ct;
    mr.name = "T2";
    value.mr.push_back(mr);
    return value;
  }
  /// Its CT's, which can be masked, and its MR's, which cannot.
  static FaceCheck facesOfBoth()
  {
    FaceCheck faces;
    faces.images = {{"the CT", "", ""}, {"MR 'T2'", "T2", "MR 'T2': it looks away"}};
    return faces;
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
  void skipWithoutOrthanc()
  {
    if (!network::test::Orthanc::installed())
      GTEST_SKIP() << "Orthanc (package orthanc) is not installed";
  }
  /// A node "pacs" where nobody listens; its port.
  int addSilentNode()
  {
    network::Node node;
    node.name = "pacs";
    node.host = "127.0.0.1";
    node.port = network::test::freePort();
    node.aeTitle = "PACS";
    network::NodeList(libraryFolder()).add(node);
    return node.port;
  }
  /// Sends the open case, all that is proposed; returns what the box says if it fails, else
  /// nothing.
  QString send()
  {
    struct State
    {
      QString why;
      bool asked = false, over = false;
    };
    const auto state = std::make_shared<State>(); // what polls for dialogs outlives this function
    onDialog(
        [state](QDialog& dialog)
        {
          if (state->over)
            return true;
          if (auto* box = qobject_cast<QMessageBox*>(&dialog))
          {
            state->why = box->text();
            box->accept();
            return true;
          }
          if (dialog.objectName() == "sendCase")
          {
            state->asked = true;
            button(dialog, "primary").click();
          }
          return false;
        });
    menu("sendOpenCase");
    EXPECT_TRUE(state->asked);
    EXPECT_TRUE(waitFor([&] { return (report() || !state->why.isEmpty()) && !window().busy(); }));
    state->over = true;
    return state->why;
  }
  void cancelWork()
  {
    auto* progress = window().findChild<QProgressDialog*>("importProgress");
    ASSERT_TRUE(progress);
    progress->findChild<QPushButton*>()->click();
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
  const network::test::Certificate own(folder(), "own");
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
        QTest::keyClick(dialog.findChild<QLineEdit*>("nodeHost"), Qt::Key_Return);
        EXPECT_TRUE(dialog.isVisible());
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
        button(dialog, "keepNode").click();
        EXPECT_TRUE(told().contains("is not there")) << told().toStdString();
        EXPECT_FALSE(network::NodeList(libraryFolder()).at("pacs").tls) << "as it was";
        type(dialog, "nodeCertificate", own.certificate().c_str());
        type(dialog, "nodeKey", own.key().c_str());
        type(dialog, "nodeOwnTitle", "EAR");
        type(dialog, "nodeCertifiedName", "pacs.example");
        EXPECT_FALSE(dialog.findChild<QLineEdit*>("nodeMoveHost")->isEnabled());
        dialog.findChild<QSpinBox*>("nodeMovePort")->setValue(11113);
        EXPECT_TRUE(dialog.findChild<QLineEdit*>("nodeMoveHost")->isEnabled());
        type(dialog, "nodeMoveHost", "10.0.0.7");
        button(dialog, "keepNode").click();
        const network::Node changed = network::NodeList(libraryFolder()).at("pacs");
        EXPECT_TRUE(changed.tls && changed.tls->key == own.key());
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
  scene::Case ball = ballCase("ball");
  ball.ct.patient.name = std::string(64, 'a'); // of a patient who is not called Ball
  ball.ct.patient.nameParts = {std::string(64, 'b')};
  library().save(ball);
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
  EXPECT_TRUE(reportHead().contains("by the case “ball”")) << reportHead().toStdString();
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
        type(dialog, "receiveCaseName", "BAL");
        button(dialog, "receiveSearch").click();
        auto* found = dialog.findChild<QTreeWidget*>("receiveFound");
        EXPECT_TRUE(waitFor(
            [&] {
              return found->topLevelItemCount() == 1 && found->topLevelItem(0)->childCount() == 3;
            }));
        keepPicture(dialog, "receive");
        EXPECT_EQ(found->topLevelItem(0)->text(0), "Case “ball”");
        EXPECT_TRUE(found->topLevelItem(0)->text(1).startsWith("PETROUS-"));
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

// Both sides show certificates. Without the right ones, nothing is sent, and why is told.
TEST_F(Exchange, CertificatesDecideWhetherACaseIsSent)
{
  skipWithoutOrthanc();
  if (IsSkipped())
    return;
  saveBall("ball");
  const network::test::Certificate own(folder(), "server"), client(folder(), "client"),
      stranger(folder(), "stranger");
  const network::test::Orthanc orthanc(folder(), {&own, &client, 0, 0});
  network::NodeList nodes(libraryFolder());
  const auto set = [&](const std::function<void(network::Node&)>& change)
  {
    network::Node node = orthanc.node();
    change(node);
    if (!nodes.nodes().empty())
      nodes.remove(node.name);
    nodes.add(node);
  };
  const auto kept = [&]
  {
    return std::count_if(fs::recursive_directory_iterator(orthanc.storage()), {},
                         [](const auto& entry) // named by a UUID
                         { return entry.path().filename().string().size() == 36; });
  };
  openWindow("ball");
  const auto before = kept();
  set([&](network::Node& node) { node.tls->authority = stranger.certificate(); });
  QString why = send();
  EXPECT_TRUE(why.contains("orthanc") && why.contains("certificate")) << why.toStdString();
  set([&](network::Node& node)
      { node.tls->certificate = stranger.certificate(), node.tls->key = stranger.key(); });
  why = send();
  EXPECT_TRUE(why.contains("orthanc")) << why.toStdString();
  set([&](network::Node& node) { node.aeTitle = "NOBODY"; });
  why = send();
  EXPECT_TRUE(why.contains("NOBODY")) << why.toStdString();
  EXPECT_EQ(kept(), before);
  EXPECT_TRUE(isOpen("ball"));
  set([](network::Node&) {});
  EXPECT_EQ(send(), QString());
  EXPECT_TRUE(reportHead().contains("has all of them")) << reportHead().toStdString();
  EXPECT_GT(kept(), before);
}

// While the node is silent in the middle of it. What it has by then is not sent again.
TEST_F(Exchange, SendingIsCancelledAndGoesOn)
{
  skipWithoutOrthanc();
  if (IsSkipped())
    return;
  saveBall("ball");
  const network::test::Orthanc orthanc(folder(), {});
  using Proxy = network::test::BreakingProxy;
  const Proxy proxy(orthanc.node().port, 250000, Proxy::Fault::Stall, 1);
  network::Node node = orthanc.node();
  node.port = proxy.port();
  network::NodeList(libraryFolder()).add(node);
  openWindow("ball");
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "sendCase")
          return false;
        button(dialog, "primary").click();
        return true;
      });
  menu("sendOpenCase");
  ASSERT_TRUE(waitFor([&] { return proxy.stalled(); }));
  EXPECT_TRUE(window().busy());
  cancelWork();
  ASSERT_TRUE(waitFor([&] { return !window().busy(); }));
  EXPECT_FALSE(report());
  EXPECT_EQ(window().findChild<QMessageBox*>(), nullptr) << "who cancels is told nothing";
  EXPECT_TRUE(isOpen("ball"));
  EXPECT_EQ(send(), QString());
  EXPECT_TRUE(reportHead().contains("were there already")) << reportHead().toStdString();
  EXPECT_TRUE(reportHead().contains("has all of them")) << reportHead().toStdString();
}

// A reception that was cancelled goes on with what is missing; then it is imported.
TEST_F(Exchange, ReceivingIsCancelledAndGoesOn)
{
  skipWithoutOrthanc();
  if (IsSkipped())
    return;
  saveBall("ball");
  const network::test::Orthanc orthanc(folder(), {});
  presenters::SendParts parts;
  parts.ct = parts.labels = parts.scene = true;
  presenters::sendCase(library(), "ball", orthanc.node(), parts);
  using Proxy = network::test::BreakingProxy;
  const Proxy proxy(orthanc.node().port, 250000, Proxy::Fault::Stall, 1);
  network::Node node = orthanc.node();
  node.port = proxy.port();
  network::NodeList(libraryFolder()).add(node);
  openWindow("ball");
  const auto receive = [&]
  {
    bool chosen = false;
    onDialog(
        [&](QDialog& dialog)
        {
          if (dialog.objectName() != "receive")
            return false;
          dialog.findChild<QCheckBox*>("receiveDated")->setChecked(true);
          button(dialog, "receiveSearch").click();
          auto* found = dialog.findChild<QTreeWidget*>("receiveFound");
          EXPECT_TRUE(waitFor(
              [&] {
                return found->topLevelItemCount() == 1 && found->topLevelItem(0)->childCount() == 3;
              }));
          for (int n = 0; n < 3; ++n)
          {
            auto* series = found->topLevelItem(0)->child(n);
            series->setCheckState(0, series->text(4) == "CT" ? Qt::Checked : Qt::Unchecked);
          }
          chosen = true;
          button(dialog, "primary").click();
          return true;
        });
    menu("receiveCase");
    EXPECT_TRUE(chosen);
  };
  receive();
  ASSERT_TRUE(waitFor([&] { return proxy.stalled(); }));
  cancelWork();
  ASSERT_TRUE(waitFor([&] { return !window().busy(); }));
  EXPECT_EQ(library().list().size(), 1u);
  EXPECT_TRUE(isOpen("ball"));

  QSignalSpy told(window().findChild<ExchangeController*>(), &ExchangeController::statusMessage);
  receive();
  ASSERT_TRUE(waitFor([&] { return !told.isEmpty(); }));
  const QString line = told.first().first().toString();
  EXPECT_TRUE(line.contains("64 objects") && line.contains("were there already"))
      << line.toStdString();
  ASSERT_TRUE(isOpen("received"));
  EXPECT_EQ(window().model().value().ct.geometry.dims(), (core::Index3{64, 64, 64}));
}

// Received images whose header states 12 bits of 16, with a pixel of 5000: asked as for a folder.
TEST_F(Exchange, ReceivedBitsThatMakeNoSenseAreAskedAbout)
{
  skipWithoutOrthanc();
  if (IsSkipped())
    return;
  const network::test::Orthanc orthanc(folder(), {});
  network::store(orthanc.node(), writeUndeclaredBits(folder() / "odd"));
  network::NodeList(libraryFolder()).add(orthanc.node());
  openWindow();
  QString why;
  onDialog(
      [&](QDialog& dialog)
      {
        if (auto* box = qobject_cast<QMessageBox*>(&dialog))
        {
          why = box->objectName() + ": " + box->text() + ' ' + box->informativeText();
          for (QAbstractButton* one : box->buttons())
            if (one->text().remove('&').contains("Keep the bits"))
            {
              one->click();
              return true;
            }
          box->reject();
          return true;
        }
        if (dialog.objectName() != "receive")
          return false;
        type(dialog, "receiveId", "PHANTOM");
        button(dialog, "receiveSearch").click();
        auto* found = dialog.findChild<QTreeWidget*>("receiveFound");
        EXPECT_TRUE(waitFor(
            [&] {
              return found->topLevelItemCount() == 1 && found->topLevelItem(0)->childCount() == 1;
            }));
        button(dialog, "primary").click();
        return false; // the bits are asked about
      });
  menu("receiveCase");
  ASSERT_TRUE(isOpen("received")) << why.toStdString();
  EXPECT_TRUE(why.startsWith("askBits")) << why.toStdString();
  EXPECT_EQ(window().model().value().ct.range.max, 5000.0);
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
        return false; // the name is asked for
      });
  menu("receiveCase");
  ASSERT_TRUE(isOpen("ball again"));
  EXPECT_TRUE(asked.contains("“ball”") && asked.contains("ball 2")) << asked.toStdString();
  EXPECT_EQ(library().open("ball").ct.object, library().open("ball again").ct.object);
}

// What stays here is no reason against masking what goes.
TEST_F(Exchange, FaultsAreToldOfImagesThatAreSentAlone)
{
  const scene::Case value = ballWithMr();
  const FaceCheck faces = facesOfBoth();
  network::Node node;
  node.name = "pacs";
  SendDialog dialog(value, library(), faces, {node});
  const auto report = [&dialog]
  { return dialog.findChild<QPlainTextEdit*>("sendReport")->toPlainText(); };
  const auto tick = [&dialog](const char* name, bool on)
  { dialog.findChild<QCheckBox*>(name)->setChecked(on); };
  tick("sendMaskFace", true);
  EXPECT_TRUE(report().contains("looks away")) << report().toStdString();
  tick("sendScene", false);
  EXPECT_TRUE(report().contains("looks away")) << report().toStdString();
  tick("sendMr", false);
  EXPECT_FALSE(report().contains("looks away")) << report().toStdString();
  EXPECT_FALSE(report().contains("T2")) << report().toStdString();
  EXPECT_TRUE(report().contains("masked in the CT")) << report().toStdString();
  tick("sendScene", true); // which has all images
  EXPECT_TRUE(report().contains("looks away")) << report().toStdString();
  EXPECT_FALSE(presenters::isSent(value, {}, ""));
  EXPECT_TRUE(dialog.facesLeft().isEmpty()) << "masked";
  tick("sendMaskFace", false);
  EXPECT_TRUE(dialog.facesLeft().join(' ').contains("face was left in the CT:"));

  FaceCheck unknown;
  unknown.isKnown = false;
  SendDialog blind(value, library(), unknown, {node});
  blind.findChild<QCheckBox*>("sendMaskFace")->setChecked(false);
  EXPECT_TRUE(blind.facesLeft().join(' ').contains("is not known"));
  for (const char* image : {"sendCt", "sendMr", "sendScene"})
    blind.findChild<QCheckBox*>(image)->setChecked(false);
  EXPECT_TRUE(blind.facesLeft().isEmpty()) << "no image leaves";
}

// The dialog has a case of its own.
TEST_F(Exchange, TheCaseMayBeClosedWhileItIsOfferedToANode)
{
  saveBall("ball");
  addSilentNode();
  openWindow("ball");
  bool isShown = false;
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "sendCase")
          return false;
        isShown = true;
        auto* report = dialog.findChild<QPlainTextEdit*>("sendReport");
        auto* scene = dialog.findChild<QCheckBox*>("sendScene");
        const QString before = report->toPlainText();
        EXPECT_TRUE(before.contains("'ball'") && before.contains("nerve")) << before.toStdString();
        action("Close the case")->trigger();
        EXPECT_FALSE(window().model().hasCase());
        scene->setChecked(false);
        scene->setChecked(true);
        EXPECT_EQ(report->toPlainText(), before);
        dialog.reject();
        return true;
      });
  menu("sendOpenCase");
  EXPECT_TRUE(isShown);
}

// No event loop runs then that would tell what was found.
TEST_F(Exchange, LookingForFacesEndsWithTheProgram)
{
  const scene::Case value = ballCase("ball");
  QWidget parent;
  EXPECT_FALSE(lookForFaces(value, parent).isCancelled);
  bool isCancelled = false;
  QTimer::singleShot(0, &parent,
                     [&]
                     {
                       QCoreApplication::quit();
                       isCancelled = lookForFaces(value, parent).isCancelled;
                     });
  QCoreApplication::exec();
  EXPECT_TRUE(isCancelled);
}

// Structures hold the face of the CT, and so the MR's goes along, too.
TEST_F(Exchange, AnArchiveWithFacesThatCannotBeMaskedIsNoDefault)
{
  scene::Case value = ballCase("head");
  value.ct.geometry =
      volume::test::gridOver(volume::test::headBox(), Eigen::Vector3d::Constant(3.0));
  const auto scan = [&value](bool asMr)
  {
    return std::make_shared<const volume::IntensityVolume>(
        volume::test::scanned(volume::test::SyntheticHead(), value.ct.geometry, asMr));
  };
  value.ct.volume = scan(false);
  value.ct.range = value.ct.volume.get()->range();
  value.dissection = dissection::Dissection(value.ct.geometry);
  scene::ImagePart mr;
  mr.name = "T2";
  mr.modality = scene::Modality::Mr;
  mr.geometry = value.ct.geometry;
  mr.volume = scan(true);
  mr.range = mr.volume.get()->range();
  value.mr.push_back(mr);
  auto voxels = volume::makeZeroVolume<std::uint16_t>(value.ct.geometry);
  const core::IndexBox held = value.ct.geometry.boxCovering({-60, -110, -80}, {60, -60, 60});
  for (int k = held.lower[2]; k < held.upper[2]; ++k)
    for (int j = held.lower[1]; j < held.upper[1]; ++j)
      for (int i = held.lower[0]; i < held.upper[0]; ++i)
        voxels->at(i, j, k) = 1;
  volume::Segment segment;
  segment.name = "soft tissue";
  segment.index = 1;
  auto map = volume::makeLabelMap(std::move(voxels), {segment});
  scene::LabelPart part;
  part.drawnOn = "";
  part.structures.push_back({"soft tissue", 1, map.segments.front().voxels, 1.0, {}});
  part.labels = std::make_shared<const volume::LabelMap>(std::move(map));
  value.labels = {part};
  library().save(value);
  openWindow("head");
  const QString file = QString::fromStdString((folder() / "head.petrous").string());
  QString told, report;
  bool goesByDefault = true;
  onDialog(
      [&](QDialog& dialog)
      {
        if (auto* box = qobject_cast<QMessageBox*>(&dialog))
        {
          EXPECT_EQ(box->objectName(), "archiveFace");
          told = box->text();
          goesByDefault = box->defaultButton() != box->button(QMessageBox::Cancel);
          box->reject();
          return false; // the dialog is still there
        }
        if (dialog.objectName() != "archiveCase")
          return false;
        if (!told.isEmpty())
        {
          dialog.reject();
          return true;
        }
        if (!report.isEmpty())
          return false; // the face is about to be asked about
        const auto* mask = dialog.findChild<QCheckBox*>("archiveMaskFace");
        EXPECT_FALSE(mask->isEnabled());
        EXPECT_FALSE(mask->isChecked());
        report = dialog.findChild<QPlainTextEdit*>("archiveReport")->toPlainText();
        type(dialog, "archiveFile", file);
        QTimer::singleShot(0, &button(dialog, "primary"), &QPushButton::click);
        return false;
      });
  action(QString::fromUtf8("Archive…"))->trigger();
  EXPECT_FALSE(goesByDefault);
  // The dialog and the question say the same of each image.
  for (const QString& text : {report, told})
  {
    EXPECT_TRUE(text.contains("the face was left in the CT", Qt::CaseInsensitive))
        << text.toStdString();
    EXPECT_TRUE(text.contains("it cannot be masked")) << text.toStdString();
    EXPECT_TRUE(text.contains("soft tissue")) << "why: " << text.toStdString();
    EXPECT_FALSE(text.contains("It can be masked", Qt::CaseInsensitive)) << text.toStdString();
  }
  EXPECT_FALSE(fs::exists(folder() / "head.petrous"));
}

// The control that masks is where its lack is told of; of an MR that cannot be masked as well.
TEST_F(Exchange, TheArchiveDialogMasksWhatItTellsOf)
{
  const scene::Case value = ballWithMr();
  const FaceCheck faces = facesOfBoth();
  ArchiveDialog dialog(value, library(), faces);
  const auto report = [&dialog]
  { return dialog.findChild<QPlainTextEdit*>("archiveReport")->toPlainText(); };
  auto* mask = dialog.findChild<QCheckBox*>("archiveMaskFace");
  ASSERT_TRUE(mask);
  EXPECT_TRUE(mask->isEnabled() && mask->isChecked());
  EXPECT_TRUE(mask->text().contains("leave out MR “T2”")) << mask->text().toStdString();
  EXPECT_TRUE(report().contains("masked in the CT")) << report().toStdString();
  EXPECT_TRUE(report().contains("looks away")) << report().toStdString();
  EXPECT_FALSE(report().contains(QRegularExpression("MR 'T2': [0-9]"))) << "it stays";
  EXPECT_TRUE(dialog.mask().face);
  EXPECT_EQ(dialog.withoutMrs(), std::vector<std::string>{"T2"});
  EXPECT_TRUE(dialog.facesLeft().isEmpty());

  mask->setChecked(false);
  EXPECT_FALSE(dialog.mask().face);
  EXPECT_TRUE(dialog.withoutMrs().empty());
  ASSERT_EQ(dialog.facesLeft().size(), 3);
  for (const QString& text : {report(), dialog.facesLeft().join('\n')})
  {
    EXPECT_TRUE(text.contains("face was left in the CT:")) << text.toStdString();
    EXPECT_TRUE(text.contains("(File > Open a region)")) << "what to do: " << text.toStdString();
    EXPECT_FALSE(text.contains("--")) << text.toStdString();
    EXPECT_TRUE(text.contains("face was left in MR 'T2'")) << text.toStdString();
    EXPECT_TRUE(text.contains("looks away")) << text.toStdString();
  }

  dialog.findChild<QCheckBox*>("archivePlan")->setChecked(true); // without images
  EXPECT_FALSE(mask->isEnabled());
  EXPECT_TRUE(dialog.facesLeft().isEmpty());
  EXPECT_FALSE(report().contains("face was left")) << report().toStdString();
}

// A node that does not answer is named, and nothing is lost.
TEST_F(Exchange, WhySendingFailsIsTold)
{
  saveBall("ball");
  const int port = addSilentNode();
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
  EXPECT_TRUE(why.contains("pacs") && why.contains(QString::number(port))) << why.toStdString();
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

namespace
{

// The window of a map with two entries.
class Pseudonyms : public Exchange
{
protected:
  static constexpr library::PseudonymMap::Cost kCheap{1, 1 << 16};
  static constexpr const char* kSecret = "one long passphrase";

  void SetUp() override
  {
    library::PseudonymMap map(file(), kSecret, kCheap);
    map.add({{"patient", "P-0815", "4711 Doe^Jane"}, {"study", "2.25.1", "1.2.3"}});
    map.save();
  }
  fs::path file() const { return folder() / "map"; }
  static int rows(QDialog& dialog)
  {
    return dialog.findChild<QTableView*>("pseudonymsTable")->model()->rowCount();
  }
  QString outcome(QDialog& dialog)
  {
    return dialog.findChild<QLabel*>("pseudonymsOutcome")->text();
  }
  void unlock(QDialog& dialog, const char* secret = kSecret)
  {
    type(dialog, "pseudonymsFile", QString::fromStdString(file().string()));
    type(dialog, "pseudonymsPassphrase", secret);
    ASSERT_TRUE(button(dialog, "primary").isEnabled());
    button(dialog, "primary").click();
    ASSERT_TRUE(waitFor([&] { return rows(dialog) > 0 || outcome(dialog).contains("cannot be"); }));
  }
  // Answers the next question for a passphrase.
  void answer(const QString& path, const QString& secret)
  {
    onDialog(
        [path, secret](QDialog& dialog)
        {
          if (dialog.objectName() != "pseudonymsAsk")
            return false;
          auto* accept = dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok);
          if (!path.isEmpty())
            type(dialog, "otherFile", path);
          EXPECT_FALSE(accept->isEnabled());
          type(dialog, "otherPassphrase", secret);
          auto* again = dialog.findChild<QLineEdit*>("otherPassphraseAgain");
          if (again->isVisible())
          {
            EXPECT_FALSE(accept->isEnabled()) << "once more";
            again->setText(secret);
          }
          EXPECT_TRUE(accept->isEnabled());
          accept->click();
          return true;
        });
  }
};

} // namespace

TEST_F(Pseudonyms, AreShownByTheirPassphraseOnly)
{
  openWindow();
  bool done = false;
  onDialog(
      [&](QDialog& dialog)
      {
        if (dialog.objectName() != "pseudonyms")
          return false;
        EXPECT_FALSE(button(dialog, "primary").isEnabled());
        unlock(dialog, "another passphrase");
        EXPECT_EQ(rows(dialog), 0);
        EXPECT_EQ(dialog.findChild<QLineEdit*>("pseudonymsPassphrase")->text(), "");
        unlock(dialog);
        EXPECT_EQ(rows(dialog), 2);
        keepPicture(dialog, "pseudonyms");
        for (const auto& [text, count] :
             {std::pair("jane", 1), std::pair("P-08", 1), std::pair("1.2.3", 1), std::pair("x", 0)})
        {
          type(dialog, "pseudonymsSearch", text);
          EXPECT_EQ(rows(dialog), count) << text;
        }
        button(dialog, "pseudonymsLock").click();
        EXPECT_EQ(rows(dialog), 0);
        unlock(dialog);
        EXPECT_EQ(rows(dialog), 2) << "nothing is searched for any more";
        done = true;
        dialog.reject();
        EXPECT_EQ(rows(dialog), 0) << "locked when it is closed";
        return true;
      });
  menu("pseudonyms");
  ASSERT_TRUE(done);
  library::PseudonymMap(file(), kSecret, kCheap); // nobody holds it
  closeWindow();
  for (const auto& entry : fs::recursive_directory_iterator(folder()))
    if (entry.is_regular_file())
    {
      std::ifstream one(entry.path(), std::ios::binary);
      const std::string all{std::istreambuf_iterator<char>(one), {}};
      for (const char* text : {kSecret, "Doe^Jane", "P-0815"})
        EXPECT_EQ(all.find(text), std::string::npos) << entry.path();
    }
}

TEST_F(Pseudonyms, AreLockedAfterATimeWithoutInput)
{
  PseudonymsDialog dialog(std::chrono::milliseconds(1500));
  dialog.show();
  unlock(dialog);
  ASSERT_TRUE(dialog.isOpen());
  QElapsedTimer since;
  since.start();
  while (since.elapsed() < 2500) // longer than it takes, with a key now and then
  {
    QTest::keyClick(dialog.findChild<QLineEdit*>("pseudonymsSearch"), Qt::Key_Left);
    QTest::qWait(100);
    ASSERT_TRUE(dialog.isOpen());
  }
  // Also while another dialog asks for something.
  QTimer::singleShot(0, &dialog, [&] { button(dialog, "pseudonymsChange").click(); });
  EXPECT_TRUE(waitFor([&] { return !dialog.isOpen(); }));
  EXPECT_EQ(rows(dialog), 0);
  EXPECT_EQ(QApplication::activeModalWidget(), nullptr);
  EXPECT_TRUE(outcome(dialog).contains("Locked")) << outcome(dialog).toStdString();
}

TEST_F(Pseudonyms, AreCopiedTakenInAndGetAnotherPassphrase)
{
  const fs::path copy = folder() / "copy", other = folder() / "other";
  {
    library::PseudonymMap map(other, "a third passphrase", kCheap);
    map.add({{"patient", "P-4321", "4712 Roe^Richard"}, {"study", "2.25.1", "1.2.3"}});
    map.save();
  }
  openWindow();
  PseudonymsDialog dialog(std::chrono::minutes(5), &window());
  dialog.show();
  unlock(dialog);
  const auto told = [&](const char* text)
  { return waitFor([&] { return outcome(dialog).contains(text); }); };
  answer(QString::fromStdString(copy.string()), "another passphrase");
  button(dialog, "pseudonymsExport").click();
  EXPECT_TRUE(told("Copied")) << outcome(dialog).toStdString();
  answer(QString::fromStdString(other.string()), "a third passphrase");
  button(dialog, "pseudonymsImport").click();
  EXPECT_TRUE(told("1 pseudonym is new")) << outcome(dialog).toStdString();
  EXPECT_TRUE(told("key of its own"));
  EXPECT_EQ(rows(dialog), 3);
  answer({}, "a fourth passphrase");
  button(dialog, "pseudonymsChange").click();
  EXPECT_TRUE(told("is changed")) << outcome(dialog).toStdString();
  dialog.close();
  EXPECT_EQ(library::PseudonymMap(copy, "another passphrase", kCheap).entries().size(), 2u);
  EXPECT_EQ(library::PseudonymMap(file(), "a fourth passphrase", kCheap).entries().size(), 3u);
  EXPECT_THROW(library::PseudonymMap(file(), kSecret, kCheap), library::PseudonymMapError);
}
