#pragma once

#include <QObject>

#include "petrous/Presenters/WorkstationModel.h"

class QAction;
class QMenu;
class QWidget;

namespace petrous::workstation
{

class CaseDocumentController;
class LibraryPanel;
class ThumbnailDrawer;

/// The library panel and the Library menu: what `petrous library` does with cases and with the
/// library as a whole.
class LibraryController : public QObject
{
  Q_OBJECT
public:
  /// `window` is the parent of dialogs; `drawAfter`: see ThumbnailDrawer.
  LibraryController(presenters::WorkstationModel& model, CaseDocumentController& keeper,
                    QWidget& window, int drawAfter);

  LibraryPanel* panel() const { return m_panel; }
  QMenu* menu() const { return m_menu; }
  ThumbnailDrawer* thumbnails() const { return m_thumbnails; }
  QAction* drawThumbnails() const { return m_draw; } ///< checkable

  void refresh(); ///< the panel

signals:
  void panelWanted();
  void restoreAsked();
  void statusMessage(const QString& line); ///< for the status bar

private:
  void fillMenu();
  void connectPanel();
  void rename(const std::string& name);
  void copy(const std::string& name);
  void copyOpen(const std::string& to);
  void remove(const std::string& name);
  void describe(const std::string& name);
  void askDescription(const std::string& name, const scene::Description& before);
  void makePicture(const std::string& name);
  void verify();
  void collect();
  void repair();

  presenters::WorkstationModel& m_model;
  CaseDocumentController& m_keeper;
  QWidget& m_window;
  LibraryPanel* m_panel;
  QMenu* m_menu;
  ThumbnailDrawer* m_thumbnails;
  QAction* m_draw = nullptr;
};

} // namespace petrous::workstation
