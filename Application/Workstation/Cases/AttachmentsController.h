#pragma once

#include <functional>

#include <QObject>

#include "BackgroundWork.h"
#include "petrous/Presenters/WorkstationModel.h"

class QWidget;

namespace petrous::workstation
{

class AttachmentsPanel;
class ThreeDView;

/// Attachments of the open case: `petrous attach` and `petrous attachments`, the window's own
/// picture, and the last recording of the tool.
class AttachmentsController : public QObject
{
  Q_OBJECT
public:
  /// `window` is the parent of dialogs. All must outlive this.
  AttachmentsController(presenters::WorkstationModel& model, ThreeDView& view, QWidget& window);

  AttachmentsPanel* panel() const { return m_panel; } ///< owned by the window that takes it

  /// A file, or a link to one, that the user chooses. False: none was chosen.
  bool attach();

  QString taking() const; ///< name of the file that is being read into the case; empty: none
  void stop();            ///< and waits

signals:
  void changed(); ///< the case has other attachments and is unsaved
  void panelWanted();
  void statusMessage(const QString& line);

private:
  bool take(const std::filesystem::path& file, bool isLink);
  void add(scene::Attachment attachment);
  void attachScreenshot();
  void attachRecording();
  void extract(const std::string& name);
  void changeNote(const std::string& name);
  void remove(const std::string& name);
  void change(const std::function<void()>& what);

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  QWidget& m_window;
  AttachmentsPanel* m_panel;
  BackgroundWork m_work;
  QString m_taking; // what it reads into the case; empty: it writes
};

} // namespace petrous::workstation
