#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include <QObject>
#include <QPointF>

#include "petrous/Presenters/MeasurementEditor.h"

class QAction;
class QActionGroup;
class QKeyEvent;
class QMenu;
class QMouseEvent;
class QWidget;

namespace petrous::workstation
{

class BackgroundWork;
class MeasurePanel;
class SliceColumn;
class ThreeDView;

/// Measuring in the open case: tools as actions, points set by clicks in the slices and on the
/// surface in the 3D view, handles that are dragged there, the panel with the list.
class MeasureController : public QObject
{
  Q_OBJECT
public:
  /// `window`: parent of dialogs. All must outlive this.
  MeasureController(presenters::WorkstationModel& model, SliceColumn& slices, ThreeDView& view,
                    QWidget& window);
  ~MeasureController() override;

  MeasurePanel* panel() { return m_panel; }
  QMenu* menu() { return m_menu; }

  void caseChanged(); ///< or closed
  void partsChanged();
  void measurementsChanged(); ///< of the model

  /// A tool is in use: the left button and undo are its.
  bool active() const;
  void leaveTool();
  bool hasPoints() const; ///< of what is being measured
  bool canUndo() const;
  bool canRedo() const;
  QString undoText() const;
  QString redoText() const;
  void undo();
  void redo();

  /// Whether another tool has the 3D view, which then has no handles.
  std::function<bool()> viewTaken;

signals:
  void toolTaken();    ///< of drill and segmenting, which must be put away
  void stateChanged(); ///< what can be undone
  void changed();      ///< measurements: to be saved
  void statusMessage(const QString& line);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  using Tool = presenters::MeasurementEditor::Tool;

  void addActions();
  void connectSlices();
  void connectPanel();
  void keepPoints();
  void choose(Tool tool);
  void set(const Eigen::Vector3d& patient);
  void announce(std::size_t before);
  void compute(presenters::MeasurementEditor::Work work);
  void hoverInSlice(const Eigen::Vector3d& patient);
  bool attempt(const std::function<void()>& what);
  void refresh();
  void draw();
  void goTo(std::size_t measurement);
  void exportCsv();
  void copy(std::optional<std::size_t> measurement);
  void measureStructure(const std::string& structure, const std::string& other);
  bool handleMouse(QMouseEvent& event);
  bool handleKey(QKeyEvent& event, bool only);
  std::optional<std::array<std::size_t, 2>> handleAt(const QPointF& position) const;

  presenters::WorkstationModel& m_model;
  SliceColumn& m_slices;
  ThreeDView& m_view;
  QWidget& m_window;
  presenters::MeasurementEditor m_editor;
  std::unique_ptr<BackgroundWork> m_work;      ///< dimensions of structures
  std::unique_ptr<BackgroundWork> m_computing; ///< the editor's
  QMenu* m_menu;
  QActionGroup* m_tools;
  QAction* m_finish;
  QAction* m_showAll;
  QAction* m_hideAll;
  QAction* m_export;
  MeasurePanel* m_panel;
  std::optional<Eigen::Vector3d> m_pressed; ///< in a slice, where a distance may begin
  std::optional<Eigen::Vector3d> m_dragged;
  double m_apart = 0.0;                                ///< mm, from which on a drag is one
  Eigen::Vector3d m_facing = Eigen::Vector3d::UnitZ(); ///< normal of that slice
  std::optional<QPointF> m_clicked;                    ///< in the 3D view
  bool m_holdsHandle = false;                          ///< in the 3D view
  bool m_swallowsRelease = false;                      ///< of a double click there
  bool m_hoversInView = false;
};

} // namespace petrous::workstation
