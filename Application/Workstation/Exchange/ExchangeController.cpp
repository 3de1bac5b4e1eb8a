#include "ExchangeController.h"

#include <chrono>

#include <QAction>
#include <QDir>
#include <QFile>
#include <QMenu>
#include <QMessageBox>

#include "Application.h"
#include "AskName.h"
#include "CaseDocumentController.h"
#include "DeidentifyDialog.h"
#include "NodesDialog.h"
#include "PseudonymsDialog.h"
#include "ReportWindow.h"
#include "SendDialog.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/CaseTransfer.h"

namespace petrous::workstation
{

namespace
{

// What arrived there, or here.
QString transferText(const network::Transfer& transfer)
{
  // arg() replaces the lowest marker.
  QString text = transfer.instances == 1
                     ? ExchangeController::tr("1 object, %1 MB in %2 s")
                     : ExchangeController::tr("%1 objects, %2 MB in %3 s").arg(transfer.instances);
  text = text.arg(numberText(1e-6 * static_cast<double>(transfer.bytes), 1))
             .arg(numberText(transfer.seconds, 1));
  if (transfer.present > 0)
    text += ExchangeController::tr(", %1 of them were there already").arg(transfer.present);
  if (transfer.warning > 0)
    text += ExchangeController::tr(", %1 with a warning of the node").arg(transfer.warning);
  return text;
}

// What the node said afterwards.
QString listedText(network::Transfer::Listed listed)
{
  switch (listed)
  {
  case network::Transfer::Listed::All:
    return ExchangeController::tr("The node was asked, and has all of them.");
  case network::Transfer::Listed::None:
    return ExchangeController::tr("The node confirmed each of them, but lists none of them (yet), "
                                  "so they could not be counted there.");
  case network::Transfer::Listed::Unanswered:
    return ExchangeController::tr("The node confirmed each of them, but did not answer when it was "
                                  "asked for them, so they could not be counted there.");
  case network::Transfer::Listed::NotOffered:
    break;
  }
  return ExchangeController::tr("The node confirmed each of them. It offers no queries, so they "
                                "could not be counted there.");
}

// How it is found again.
QString foundText(const std::string& name, const presenters::CasePatient& patient,
                  const std::string& study)
{
  if (!patient.isNameHidden())
    return ExchangeController::tr("There it is the patient %1. Receive finds it by the case “%2”.")
        .arg(words(patient.id), words(name));
  return ExchangeController::tr(
             "There it is the patient %1, without the case's name, which may be a patient's. "
             "Receive finds it by the whole name “%2” from this library, and by that ID from any; "
             "“petrous receive” finds it by the study %3.")
      .arg(words(patient.id), words(name), words(study));
}

QString lines(const std::vector<std::string>& all)
{
  QString text;
  for (const std::string& one : all)
    text += phrase(one) + '\n';
  return text;
}

} // namespace

ExchangeController::ExchangeController(presenters::WorkstationModel& model,
                                       CaseDocumentController& keeper, QMenu& menu, QWidget& window)
  : QObject(&window)
  , m_model(model)
  , m_keeper(keeper)
  , m_window(window)
{
  const auto add = [&](const char* name, const QString& text, const QString& tip, auto what)
  {
    QAction* action = menu.addAction(text);
    action->setObjectName(name);
    action->setToolTip(tip);
    action->setStatusTip(tip);
    connect(action, &QAction::triggered, this,
            [this, what]
            {
              try
              {
                what();
              }
              catch (const std::exception& error)
              {
                refuse(toString(error));
              }
            });
  };
  menu.addSeparator();
  add("sendOpenCase", tr("&Send to a node…"), tr("The open case to a DICOM node"),
      [this]
      {
        if (!m_model.hasCase())
          return refuse(tr("Open a case first, or choose one in the list (Library > Cases)."));
        send(m_model.value().name);
      });
  add("receiveCase", tr("R&eceive from a node…"),
      tr("A case, or images of a patient, from a DICOM node"), [this] { receive(); });
  add("editNodes", tr("DICOM &nodes…"), tr("Where cases are sent to and received from"),
      [this] { editNodes(); });
  menu.addSeparator();
  add("deidentifyFolder", tr("De-&identify DICOM files…"),
      tr("A folder of DICOM files without what identifies the patient"), [this] { deidentify(); });
  add("pseudonyms", tr("Pseud&onyms…"), tr("Who is behind the pseudonyms of de-identified files"),
      [this] { PseudonymsDialog(std::chrono::minutes(5), &m_window).exec(); });
}

// Returns at once; the window waits for the answer.
void ExchangeController::refuse(const QString& why)
{
  auto* box = new QMessageBox(QMessageBox::Warning, tr("Petrous"), windowText(why), QMessageBox::Ok,
                              &m_window);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setTextInteractionFlags(Qt::TextSelectableByMouse);
  box->open();
}

void ExchangeController::editNodes()
{
  NodesDialog(m_model.library().folder(), &m_window).exec();
}

std::vector<network::Node> ExchangeController::nodes()
{
  if (network::NodeList(m_model.library().folder()).nodes().empty())
    editNodes();
  return network::NodeList(m_model.library().folder()).nodes();
}

void ExchangeController::send(const std::string& which)
{
  const auto all = nodes();
  if (all.empty())
    return;
  if (m_model.hasCase() && m_model.value().name == which)
  {
    if (!m_keeper.saved())
      return emit statusMessage(tr("The case is not saved yet, so it was not sent"));
    return offer(m_model.value(), all); // a save after a conflict may have changed its name
  }
  // Opening replays what a killed program left.
  m_keeper.run(tr("Opening %1").arg(words(which)),
               [this, library = m_model.library(), which,
                all](const core::Progress&) -> BackgroundWork::Reply
               { return [this, all, value = library.open(which)] { offer(value, all); }; });
}

void ExchangeController::offer(scene::Case value, const std::vector<network::Node>& nodes)
{
  const FaceCheck faces = lookForFaces(value, m_window);
  if (faces.isCancelled)
    return;
  SendDialog dialog(value, m_model.library(), faces, nodes, &m_window);
  if (dialog.exec() != QDialog::Accepted)
    return;
  const std::string name = value.name;
  m_keeper.run(
      tr("Sending %1").arg(words(name)),
      [this, library = m_model.library(), name, node = dialog.node(), parts = dialog.parts(),
       facesLeft = dialog.facesLeft()](const core::Progress& progress) -> BackgroundWork::Reply
      {
        const auto done = presenters::sendCase(library, name, node, parts, progress);
        return [this, done, name, facesLeft, place = words(node.name)]
        {
          QString head =
              tr("“%1” is at “%2”: %3.").arg(words(name), place, transferText(done.transfer));
          head += ' ' + listedText(done.transfer.listed);
          head += ' ' + foundText(name, done.patient, done.studyUid);
          showReport(&m_window, tr("Send"), head, lines(done.notes) + facesLeft.join('\n'),
                     "petrous-send.txt", m_model.library().folder());
        };
      });
}

void ExchangeController::receive()
{
  const auto all = nodes();
  if (all.empty())
    return;
  ReceiveDialog dialog(all, m_model.library(), &m_window);
  if (dialog.exec() != QDialog::Accepted)
    return;
  const ReceiveDialog::Choice choice = dialog.choice();
  choice.scene ? receiveScene(choice, {}) : receiveImages(choice);
}

// The folder of a study on its way; what is there from before is not asked for again.
QString ExchangeController::arriving(const std::string& study)
{
  for (auto one = m_arrived.begin(); one != m_arrived.end();)
    one = one->first == study || m_keeper.busy() ? std::next(one) : m_arrived.erase(one);
  auto& folder = m_arrived[study];
  if (!folder)
    folder = std::make_unique<library::ScratchFolder>();
  return QFile::decodeName(folder->path().c_str());
}

void ExchangeController::receiveScene(const ReceiveDialog::Choice& choice, const std::string& name,
                                      imaging::UndeclaredBits bits)
{
  presenters::ReceiveRequest request;
  request.studyUid = choice.study;
  request.as = name;
  request.undeclaredBits = bits;
  request.partial = pathOf(arriving(choice.study));
  m_keeper.run(
      tr("Receiving from %1").arg(words(choice.node.name)),
      [this, library = m_model.library(), choice,
       request](const core::Progress& progress) mutable -> BackgroundWork::Reply
      {
        presenters::ReceiveSummary done;
        try
        {
          done = presenters::receiveCase(library, choice.node, request, progress);
        }
        catch (const presenters::NameTakenError& error)
        {
          return [this, choice, taken = error.name] { receiveUnderOtherName(choice, taken); };
        }
        catch (const imaging::BitsUnclearError& error)
        {
          return [this, choice, as = request.as, error]
          {
            if (const auto answer = m_keeper.askBits(error.what(), error.canKeep))
              receiveScene(choice, as, *answer);
          };
        }
        return [this, done, study = request.studyUid]
        {
          m_arrived.erase(study);
          emit statusMessage(tr("Received: %1").arg(transferText(done.transfer)));
          if (!done.notes.empty())
            showReport(
                &m_window, tr("Receive"),
                tr("“%1” is received: %2.").arg(words(done.name), transferText(done.transfer)),
                lines(done.notes), "petrous-receive.txt", m_model.library().folder());
          m_keeper.openCase(done.name);
        };
      });
}

void ExchangeController::receiveUnderOtherName(const ReceiveDialog::Choice& choice,
                                               const std::string& taken)
{
  const QString suggested = words(presenters::freeCaseName(m_model.library(), taken));
  const QString name = askName(
      m_window, tr("Receive"),
      tr("The library has a case “%1”. Name of the received one:").arg(words(taken)), suggested,
      [this](const std::string& wanted)
      { presenters::checkFreeCaseName(m_model.library(), wanted); });
  if (name.isEmpty())
    return emit statusMessage(tr("Stopped; nothing was changed"));
  receiveScene(choice, bytes(name));
}

// They are imported like a folder that is dropped.
void ExchangeController::receiveImages(const ReceiveDialog::Choice& choice)
{
  const QString folder = arriving(choice.study) + '/' + tr("received");
  m_keeper.run(tr("Receiving from %1").arg(words(choice.node.name)),
               [this, choice, folder](const core::Progress& progress) -> BackgroundWork::Reply
               {
                 const network::Transfer done = network::retrieve(
                     choice.node, choice.study, choice.series, pathOf(folder), progress);
                 return [this, done, folder]
                 {
                   emit statusMessage(tr("Received: %1").arg(transferText(done)));
                   m_keeper.open({folder});
                 };
               });
}

void ExchangeController::deidentify()
{
  DeidentifyDialog dialog(&m_window);
  if (dialog.exec() != QDialog::Accepted)
    return;
  presenters::DeidentifyRequest request = dialog.request();
  request.library = m_model.library().folder();
  m_keeper.run(
      tr("De-identifying"),
      [this, request = std::move(request), passphrase = dialog.takePassphrase()](
          const core::Progress& progress) -> BackgroundWork::Reply
      {
        const auto done = presenters::deidentifyFolder(request, *passphrase, progress);
        return [this, done, out = QFile::decodeName(request.output.c_str()),
                in = QFile::decodeName(request.input.c_str())]
        {
          QString head =
              tr("%1 files are de-identified in %2.").arg(done.report.filesWritten).arg(out);
          if (!done.leftOut.empty())
            head += ' ' + tr("%1 were left out.").arg(done.leftOut.size());
          for (const auto& [what, files] : done.report.warnings)
            head += '\n' + tr("%1 files: %2").arg(files).arg(phrase(what));
          if (!done.report.durable)
            head += '\n' + tr("The disk reported an error; check the disk.");
          showReport(&m_window, tr("De-identify"), head, phrase(done.report.text()),
                     "deidentification.txt", m_model.library().folder(), in);
        };
      });
}

} // namespace petrous::workstation
