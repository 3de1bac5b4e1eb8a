#pragma once

#include <map>
#include <memory>
#include <string>

#include "ReceiveDialog.h"
#include "petrous/Imaging/SeriesGeometry.h"
#include "petrous/Library/ScratchFolder.h"
#include "petrous/Presenters/WorkstationModel.h"
#include <QObject>

class QMenu;
class QWidget;

namespace petrous::workstation
{

class CaseDocumentController;

/// What leaves and what comes: DICOM nodes, sending and receiving, de-identification of folders.
class ExchangeController : public QObject
{
  Q_OBJECT
public:
  /// Adds its entries to `menu`; `window` is the parent of dialogs.
  ExchangeController(presenters::WorkstationModel& model, CaseDocumentController& keeper,
                     QMenu& menu, QWidget& window);

  void send(const std::string& name); ///< a case of the library

signals:
  void statusMessage(const QString& line); ///< for the status bar

private:
  std::vector<network::Node> nodes(); ///< asks for one where there is none; empty: none wanted
  void editNodes();
  /// To send it. A copy: it may be closed while that is asked.
  void offer(scene::Case value, const std::vector<network::Node>& nodes);
  void receive();
  /// `name`: of the new case; empty: that of the scene. Asked for where it is taken. `bits`: of a
  /// study whose images a case is built of after all; asked for where they are unclear.
  void receiveScene(const ReceiveDialog::Choice& choice, const std::string& name,
                    imaging::UndeclaredBits bits = imaging::UndeclaredBits::Refuse);
  void receiveUnderOtherName(const ReceiveDialog::Choice& choice, const std::string& taken);
  void receiveImages(const ReceiveDialog::Choice& choice);
  QString arriving(const std::string& study);
  void deidentify();
  void refuse(const QString& why);

  presenters::WorkstationModel& m_model;
  CaseDocumentController& m_keeper;
  QWidget& m_window;
  /// By study: what arrived of it, so that a transfer that was cut goes on. It may identify the
  /// patient: gone with the next study, and when the window closes.
  std::map<std::string, std::unique_ptr<library::ScratchFolder>> m_arrived;
};

} // namespace petrous::workstation
