#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <QObject>
#include <QTimer>

#include "petrous/Presenters/SegmentEditor.h"
#include "petrous/Rendering/SceneContents.h"

class QAction;
class QActionGroup;
class QMenu;

namespace petrous::workstation
{

class BackgroundWork;
class SegmentPanel;
class SliceColumn;

/// Segmenting in the open case: tools as actions, drawing in the slices, what is computed in the
/// background, and the question before a draft is lost.
class SegmentController : public QObject
{
  Q_OBJECT
public:
  /// `window`: parent of dialogs. All must outlive this.
  SegmentController(presenters::WorkstationModel& model, SliceColumn& slices, QWidget& window);
  ~SegmentController() override;

  SegmentPanel* panel() { return m_panel; }
  QMenu* menu() { return m_menu; }

  /// Return, Shift+Return and Esc are the draft's there; elsewhere they belong to what is typed.
  void addKeysTo(QWidget& widget);

  void caseChanged(); ///< or closed
  void strokeEnded(); ///< which is undone before what was created
  void partsChanged();
  void mrMoved();
  void setShown(const presenters::ShownImages& shown); ///< in the slices

  /// A tool is in use: left button, undo and brush size are its.
  bool active() const;
  void leaveTool(); ///< the draft stays
  bool canUndo() const;
  bool canRedo() const;
  bool canUndoStep() const; ///< of the draft
  bool canRedoStep() const;
  QString undoText() const; ///< as SegmentEditor's
  QString redoText() const;
  void undo();
  void redo();
  bool hasBrush() const;
  void stepBrush(int steps);

  /// Before the case is left: asks what becomes of a draft. False: the user wants to stay.
  bool mayLeave();
  bool busy() const;

signals:
  void toolTaken();        ///< of the drill, which must be put away
  void stateChanged();     ///< what can be undone
  void structureCreated(); ///< or changed, or undone: to be saved
  void statusMessage(const QString& line);
  void imageWanted(const QString& image); ///< "ct" or an MR, in the slices
  void viewFocusAsked();                  ///< a structure was created from the panel
  /// Preview in the 3D view; without triangles: none.
  void surfaceChanged(const petrous::rendering::MeshContents& surface);

private:
  using Tool = presenters::SegmentEditor::Tool;

  void addTools();
  void connectPanel();
  void connectSlices();
  void choose(Tool tool);
  void changed();
  void drawing();
  void askWork();
  void run(presenters::SegmentEditor::Work work, bool step);
  void awaitStep();
  bool finish(presenters::SegmentEditor::Work work);
  void edit(const std::string& structure);
  void step();
  void create();
  void createAtLast();
  void discard();
  void escape();
  bool attempt(const std::function<void()>& what);
  void showSurface();

  presenters::WorkstationModel& m_model;
  SliceColumn& m_slices;
  QWidget& m_window;
  presenters::SegmentEditor m_editor;
  QMenu* m_menu;
  QActionGroup* m_tools;
  QAction* m_step;
  QAction* m_create;
  QAction* m_escape;
  SegmentPanel* m_panel;
  std::unique_ptr<BackgroundWork> m_work;
  std::unique_ptr<BackgroundWork> m_surfaceWork;
  QTimer m_surfaceLater;
  QString m_created;      ///< what was said of the last structure that was created
  std::string m_createAs; ///< once the preview is done; empty: not
  bool m_asking = false;
};

} // namespace petrous::workstation
