#pragma once

#include <QObject>

#include "petrous/Presenters/SlicePlanes.h"
#include "petrous/Presenters/SlicePresenter.h"

class QAction;
class QActionGroup;
class QMenu;
class QWidget;

namespace petrous::presenters
{
class WorkstationModel;
}

namespace petrous::workstation
{

class SliceColumn;
class SlicesPanel;
class ThreeDView;
class WindowSettings;

/// Planes, slabs, grey windows and zoom of the slices: their menu, keys and panel.
class SliceController : public QObject
{
  Q_OBJECT
public:
  /// All must outlive this.
  SliceController(presenters::WorkstationModel& model, ThreeDView& view, SliceColumn& slices,
                  WindowSettings& kept, QWidget& window);

  SlicesPanel* panel() const noexcept { return m_panel; } ///< owned by the window that takes it
  QMenu* menu() const noexcept { return m_menu; }         ///< also of a right click on a slice

  using Kind = presenters::SlicePlanes::Kind;
  void setPlanes(Kind kind, scene::Side side = scene::Side::Unknown);
  void setSlab(const presenters::Slab& slab);
  const presenters::Slab& slab() const;
  void toolMoved();            ///< planes along it follow
  void setCaseOpen(bool open); ///< disables what needs a case
  bool isZoomTogether() const;
  bool isZoomWithScene() const;
  void setZoomTogether(bool on);
  void setZoomWithScene(bool on);

signals:
  void statusMessage(const QString& line);

private:
  void makeMenu(QWidget& window);
  void addPlanes();
  void addWindows();
  void fillWindows();
  void addSlabs();
  void addZoom();
  void showState();
  void stepSlab(int step);
  void nextProjection();
  void followScene();

  presenters::WorkstationModel& m_model;
  ThreeDView& m_view;
  SliceColumn& m_slices;
  WindowSettings& m_kept;
  presenters::Slab m_lastSlab{5.0, presenters::Projection::Maximum}; ///< when it is off
  QMenu* m_menu;
  QMenu* m_windows = nullptr;
  QActionGroup* m_planes = nullptr;
  QActionGroup* m_slabs = nullptr;
  QAction* m_zoomTogether = nullptr;
  QAction* m_zoomWithScene = nullptr;
  SlicesPanel* m_panel = nullptr;
};

} // namespace petrous::workstation
