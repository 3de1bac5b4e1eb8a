#pragma once

#include <functional>

#include <QObject>

#include "petrous/Presenters/WorkstationModel.h"

class QWidget;

namespace petrous::workstation
{

class CaseDocumentController;
class ExchangeController;
class SharePanel;
class ThreeDView;

/// What is made of the open case for others to look at: report, pictures, films; and the one place
/// from which all that leaves is reached. Written in a separate thread, from a copy of the case as
/// it is shown.
class ShareController : public QObject
{
  Q_OBJECT
public:
  /// `window` is the parent of dialogs.
  ShareController(presenters::WorkstationModel& model, CaseDocumentController& keeper,
                  ExchangeController& exchange, ThreeDView& view, QWidget& window);

  SharePanel* panel() const noexcept { return m_panel; } ///< owned by the window that takes it

  void report();
  void printPicture();
  void film();

  std::function<void()> releaseTool; ///< ends an open stroke
  std::function<void()> collectView; ///< hands the present view to the case
  /// Shows a file with the program that the user has for it; false: there is none.
  std::function<bool(const QString& file)> openFile;

signals:
  void statusMessage(const QString& line); ///< for the status bar

private:
  bool mayBegin();
  scene::Case shown(); ///< the case with its present view
  void done(const std::filesystem::path& file, const QString& what, bool opens,
            const QString& more = {});

  presenters::WorkstationModel& m_model;
  CaseDocumentController& m_keeper;
  ThreeDView& m_view;
  QWidget& m_window;
  SharePanel* m_panel;
};

} // namespace petrous::workstation
