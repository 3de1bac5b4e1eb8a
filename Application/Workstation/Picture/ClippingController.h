#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <QObject>
#include <QPointF>
#include <QPointer>

#include "petrous/Presenters/BoxHandles.h"
#include "petrous/Presenters/ClippingHandles.h"
#include "petrous/Presenters/WorkstationModel.h"

class QMouseEvent;
class QWidget;

namespace petrous::workstation
{

class CropBoxDialog;
class SliceColumn;
class ThreeDView;
class WindowActions;

/// What is cut away from the picture of the open case: the clipping plane and the crop box, whose
/// line or edges are dragged in the slices, and arrow or faces in the 3D view. Each drag is a step
/// of undo. While a tool is in use all is shown, and there are no handles.
class ClippingController : public QObject
{
  Q_OBJECT
public:
  /// `window`: parent of the dialog. All must outlive this.
  ClippingController(presenters::WorkstationModel& model, SliceColumn& slices, ThreeDView& view,
                     WindowActions& actions, QWidget& window);
  ~ClippingController() override;

  void caseChanged(); ///< or closed
  void refresh();     ///< the clipping, or whether the view is taken, may have changed

  /// In which the keys turn the plane; nullopt: in the 3D view, about its vertical.
  std::function<std::optional<presenters::SliceOrientation>()> focusedSlice;
  /// Whether a tool other than the drill's has the clicks in the 3D view, which then has no
  /// handles.
  std::function<bool()> viewTaken;

signals:
  void statusMessage(const QString& line);

protected:
  bool eventFilter(QObject* watched, QEvent* event) override; ///< of the 3D view

private:
  using Clipping = scene::ViewState::Clipping;

  void cutHere();
  void showBox(bool shown);
  void enterBox();
  void change(const Clipping& clipping, const std::string& continues = {});
  void record(const Clipping& before, const std::string& continues = {});
  void setCrop(const std::optional<core::IndexBox>& crop);
  void movePlanes(double step);
  void turnPlanes(double degrees);
  void takeCut(std::size_t plane, presenters::CutPart part, const Eigen::Vector3d& from,
               presenters::SliceOrientation slice);
  void beginDrag(std::function<Clipping(const Eigen::Vector3d& patient)> drag);
  void drag(const Eigen::Vector3d& patient);
  void endDrag();
  void tellSize();
  bool handleMouse(const QMouseEvent& event);
  /// What can be dragged in the 3D view: where it stands, along which line, and to what.
  struct Handle
  {
    Eigen::Vector3d at;                       ///< patient LPS mm
    std::optional<Eigen::Vector3d> direction; ///< unit; none: across the line of sight
    double arrow = 0.0;                       ///< mm, of the arrow that ends there; 0: none
    QString alongSight;                       ///< why it cannot be dragged along the line of sight
    std::function<Clipping(const Eigen::Vector3d& step)> dragged; ///< mm
    std::function<QString()> reading;                             ///< while it is dragged
  };
  /// `whole`: what is dragged of the box moves all of it.
  std::vector<Handle> handles(bool whole = false) const;
  Handle handleOf(const presenters::FaceHandle& face, bool whole) const;
  Handle handleOfMiddle() const;
  Handle handleOfPlane(std::size_t plane) const;
  QString readPlane(std::size_t plane, const Clipping& before) const;
  QString readTurn(std::size_t plane, const Clipping& before) const;
  /// Those under the pointer, the nearest first: numbers among `all`.
  std::vector<std::size_t> handlesAt(const std::vector<Handle>& all, const QPointF& position) const;
  /// Of a handle that was taken at `at`: where the pointer drags it.
  std::optional<Eigen::Vector3d> draggedTo(const Handle& handle, const Eigen::Vector3d& at,
                                           const QPointF& position) const;
  bool takeHandle(const QPointF& position, bool whole);
  bool toolHasView() const;
  bool hasHandles() const; ///< in the 3D view
  bool showsBox() const;

  presenters::WorkstationModel& m_model;
  SliceColumn& m_slices;
  ThreeDView& m_view;
  WindowActions& m_actions;
  QWidget& m_window;
  QPointer<CropBoxDialog> m_dialog;
  Clipping m_before; ///< the drag
  std::function<Clipping(const Eigen::Vector3d& patient)> m_drag;
  /// In the 3D view.
  struct Held
  {
    std::size_t number; ///< among the handles
    Handle handle;      ///< as it was taken
  };
  std::optional<Held> m_held;
  /// In a slice.
  struct HeldCut
  {
    std::size_t plane;
    std::function<QString()> reading;
  };
  std::optional<HeldCut> m_heldCut;
  std::optional<QPointF> m_pressed; ///< until it is dragged
};

} // namespace petrous::workstation
