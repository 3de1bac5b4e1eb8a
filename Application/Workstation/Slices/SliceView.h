#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <QImage>
#include <QTimer>
#include <QWidget>

#include "SliceMarks.h"
#include "petrous/Core/AxesCorrection.h"
#include "petrous/Presenters/BoxHandles.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/SlicePlanes.h"
#include "petrous/Presenters/SlicePresenter.h"
#include "petrous/Volume/ImageProvenance.h"

namespace petrous::workstation
{

/// A tool that works in the slices with the left button.
struct SliceTool
{
  double radius = 0.0;   ///< mm, of the ball that follows the pointer; 0: none is drawn
  QColor color;          ///< of its outline
  bool measures = false; ///< leaves handles of measurements to be dragged
};

/// A box whose edges and corners can be dragged in the slices.
struct SliceBox
{
  presenters::HandledBox handled;
  bool moves = false;      ///< dragged inside, all of it moves
  bool dims = false;       ///< what is outside
  bool shiftMoves = false; ///< dragged with Shift inside or by an edge, all of it moves
};

/// A clipping plane, whose line can be dragged in the slices.
struct SliceCut
{
  scene::ViewState::Clipping::Plane plane;
  QString reading; ///< while it is dragged
};

/// What a tool shows in the slices besides its draft.
struct SliceDrawing
{
  std::vector<SliceMark> marks;
  std::vector<Eigen::Vector3d> curve; ///< patient LPS mm
  QColor color;                       ///< of the curve
};

/// "MIP 5 mm".
QString slabText(const presenters::Slab& slab);

/// One slice with its crosshair, orientation letters, scale bar and read-out; painted, no OpenGL.
///
/// Left drag moves the crosshair, the wheel scrolls, right drag sets the grey window, a right click
/// asks for a menu, Ctrl+wheel zooms, middle drag pans. Ctrl+left drag turns the other two planes
/// about the crosshair, Ctrl+arrow keys those or the slice itself. With a tool the left button is
/// the tool's, and with Shift it moves the crosshair. A thick slab is drawn coarse first and then
/// finer, in parts between other events. A double click asks to enlarge the view. Alt+arrow and
/// Alt+Page up or down translate and rotate an MR overlay. A box is dragged by its edges and
/// corners, with Shift as a whole; the line of a clipping plane as a whole, or by an end, which
/// turns it.
class SliceView : public QWidget
{
  Q_OBJECT
public:
  explicit SliceView(presenters::SliceOrientation orientation, QWidget* parent = nullptr);

  /// Another case, or another appearance of it. nullptr: nothing to show.
  void setPresenter(std::shared_ptr<const presenters::SlicePresenter> presenter,
                    const core::GridGeometry& grid);
  void fit(); ///< the whole slice
  /// Zooms in on a box of the patient that is much smaller than the image, unless that was done.
  void frame(const core::PatientBox& box);
  void setPlane(const scene::ViewState::Slices::Plane& plane); ///< zoom, at most 40, and offset
  scene::ViewState::Slices::Plane plane() const { return {m_zoom, m_offset}; }
  const presenters::GreyWindow& greyWindow() const noexcept { return m_window; } ///< of the CT
  void setPlanes(const presenters::SlicePlanes& planes); ///< its own and the other two
  void setSlab(const presenters::Slab& slab);
  void setScale(double mmPerPixel); ///< within the limits of the zoom; the crosshair stays in place
  bool isFine() const { return !m_stale && !m_sampling; } ///< drawn, at full resolution
  /// Pans, by the least, where it moves within the plane to where it is not seen, unless it is
  /// dragged here.
  void setCrosshair(const Eigen::Vector3d& patient);
  void revealCrosshair(); ///< likewise, wherever it is
  void setGreyWindow(const presenters::GreyWindow& window);
  void setIntensityDisplay(const presenters::IntensityDisplay& display); ///< of the CT
  void setReadout(const QString& text); ///< values under the crosshair
  const QString& readout() const noexcept { return m_readout; }
  /// nullptr: CT alone. `alone`: how its intensities are displayed where no other's are seen; the
  /// grey window is its own then.
  void setOverlay(std::shared_ptr<const presenters::SliceOverlay> overlay,
                  const std::optional<presenters::IntensityDisplay>& alone);
  void setNotice(const QString& text); ///< a note on what is shown
  void setCovered(int pixels);         ///< as ThreeDView
  void setMarks(std::vector<SliceMark> marks);
  void setInterpolated(std::vector<volume::SliceRange> slices); ///< of the grid
  void setRegion(double edge); ///< edge of the cube about the crosshair to fit in, mm; 0: none
  void maskChanged(const core::PatientBox& box);
  void setTool(const std::optional<SliceTool>& tool);
  void setDrawing(SliceDrawing drawing);
  void setMeasures(std::vector<DrawnMeasure> measures);
  void setBox(const std::optional<SliceBox>& box);
  /// The letters are those of the patient where the image lies as a file states it that is wrong.
  void setCorrection(const core::AxesCorrection& axes);
  void setCuts(std::vector<SliceCut> cuts);
  /// What is being segmented; nullptr: nothing.
  void setDraft(std::shared_ptr<const presenters::DraftLayer> draft);
  void draftChanged(const core::PatientBox& box); ///< its voxels, in this box
  /// Below the draft: where two dissections differ. nullptr: nothing.
  void setDifference(std::shared_ptr<const presenters::DraftLayer> difference);

  /// The displayed slice; requires a presenter.
  presenters::SliceGeometry slice() const;

signals:
  void enlargeAsked(petrous::presenters::SliceOrientation slice); ///< a double click
  void crosshairMoved(const Eigen::Vector3d& patient);
  void zoomed(); ///< by the user
  /// The other two planes about its normal, clockwise.
  void turnOthersAsked(petrous::presenters::SliceOrientation slice, double degrees);
  void tiltAsked(petrous::presenters::SliceOrientation slice, double right, double down);
  void menuAsked(const QPoint& global);
  void greyWindowChanged(const petrous::presenters::GreyWindow& window);
  void pointed(const Eigen::Vector3d& patient);
  void moveAsked(const Eigen::Vector3d& millimetres); ///< of the MR over the CT
  void turnAsked(const Eigen::Vector3d& axis, double degrees);
  /// With a tool: where the left button went down, was dragged to, and that it was released. Where
  /// it measures, in a slab of the brightest or darkest at the depth of what is seen; so are
  /// handles.
  void toolPressed(const Eigen::Vector3d& patient, petrous::presenters::SliceOrientation plane);
  void toolDragged(const Eigen::Vector3d& patient);
  void toolReleased();
  void toolDoubleClicked();
  /// A handle of a measurement was taken, with a tool only if that measures; dragged to; let go.
  void handleTaken(std::size_t measurement, std::size_t point);
  void handleDragged(const Eigen::Vector3d& patient);
  void handleReleased();
  /// Faces of the box were taken, at a point; dragged to; let go. No tool has the left button then.
  void boxTaken(const petrous::presenters::BoxFaces& faces, const Eigen::Vector3d& patient);
  void boxDragged(const Eigen::Vector3d& patient);
  void boxReleased();
  void boxResetAsked(); ///< a double click on an edge
  /// Likewise the line of a clipping plane, by its number, in the slice that it cuts.
  void cutTaken(std::size_t plane, petrous::presenters::CutPart part,
                const Eigen::Vector3d& patient, petrous::presenters::SliceOrientation slice);
  void cutDragged(const Eigen::Vector3d& patient);
  void cutReleased();

protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

private:
  Eigen::Vector3d patientAt(const QPointF& position) const;
  Eigen::Vector3d shownAt(const QPointF& position) const;   // at the depth that a projection shows
  Eigen::Vector3d pointedAt(const QPointF& position) const; // which of them, by the tool
  double shownReach() const; // mm from the slice, of what counts as lying in it, beyond it
  void scroll(int slices);
  void zoom(double factor);
  void putCrosshairAt(const Eigen::Vector2d& pixel);
  void pointCrosshair(const QPointF& position);
  void pan();
  void applyZoom(double zoom);
  void stale();
  void recolour(); // of the same samples
  void draw();
  presenters::SliceGeometry sharpSlice() const; // slice() in pixels of the screen
  void drawCoarse();
  void refine();
  double samplesOf(const presenters::SliceGeometry& picture) const; // that a picture takes
  const presenters::SliceAxes& axes() const { return m_planes.axes(m_orientation); }
  bool turnPlanes(const QKeyEvent& event);
  double angleAt(const QPointF& position) const; // about the crosshair, degrees, clockwise
  void paintCrosshair(QPainter& painter) const;
  struct EdgeText;
  std::vector<EdgeText> edgeTexts(const QFont& base) const;
  void paintScaleBar(QPainter& painter) const;
  void paintTool(QPainter& painter) const;
  void paintInterpolated(QPainter& painter) const;
  bool showsInterpolated() const;
  bool moveMr(const QKeyEvent& event);
  const presenters::GreyWindow& seenWindow() const; // of what is seen: the CT, or an MR alone
  const presenters::IntensityDisplay& intensityDisplay() const; // likewise
  struct Handle
  {
    std::size_t measurement, point;
  };
  std::optional<Handle> handleAt(const QPointF& position) const;
  presenters::BoxFaces facesAt(const QPointF& position) const;
  bool takeBox(const QPointF& position, bool whole);
  struct Cut
  {
    std::size_t plane;
    presenters::CutPart part;
  };
  std::optional<Cut> cutAt(const QPointF& position) const;
  bool takeCut(const QPointF& position);
  void paintCutReading(QPainter& painter, std::vector<QRectF>& taken) const;
  void showCursorAt(const QPointF& position);

  presenters::SliceOrientation m_orientation;
  std::shared_ptr<const presenters::SlicePresenter> m_presenter;
  core::GridGeometry m_grid;
  Eigen::Vector3d m_crosshair = Eigen::Vector3d::Zero();
  Eigen::Vector3d m_offset = Eigen::Vector3d::Zero(); // of the picture's centre, in the plane, mm
  double m_zoom = 1.0;
  presenters::GreyWindow m_window;
  presenters::IntensityDisplay m_display;
  std::shared_ptr<const presenters::SliceOverlay> m_overlay;
  std::optional<presenters::IntensityDisplay> m_overlayAlone; // none: the CT is seen, too
  QString m_notice;
  int m_covered = 0; // px, from the upper edge
  std::vector<SliceMark> m_marks;
  std::vector<volume::SliceRange> m_interpolated;
  double m_region = 0.0;
  QString m_readout;
  presenters::SlicePlanes m_planes;
  presenters::Slab m_slab;
  /// What the picture is drawn of: the slice, or coarser than it.
  struct Drawn
  {
    presenters::SliceGeometry picture;
    presenters::SliceSamples samples;
  };
  std::optional<Drawn> m_drawn;
  /// A finer one that is being sampled.
  struct Sampling
  {
    presenters::SliceGeometry picture;
    std::unique_ptr<presenters::SlabSampling> ct, mr;
  };
  std::optional<Sampling> m_sampling;
  QTimer m_refine;
  QImage m_image;
  QRectF m_imageRect;      // where it is painted
  bool m_stale = true;     // samples
  bool m_isPale = false;   // colours
  bool m_reveals = false;  // the crosshair, when it is painted next: in the size that it has then
  bool m_pointing = false; // the crosshair is being put to the pointer
  QPointF m_dragged;
  bool m_turning = false; // the other planes, with the left button
  bool m_mayMenu = false; // the right button went down and was not dragged
  std::shared_ptr<const presenters::DraftLayer> m_draft;
  std::shared_ptr<const presenters::DraftLayer> m_difference;
  std::optional<SliceTool> m_tool;
  SliceDrawing m_drawing;
  std::optional<QPointF> m_pointer; // where the tool's ball is drawn
  bool m_toolDown = false;
  bool m_handleDown = false;
  std::optional<QPointF> m_pressed; // what is held, until it is dragged
  std::vector<DrawnMeasure> m_measures;
  std::optional<SliceBox> m_box;
  core::AxesCorrection m_correction;
  bool m_boxDown = false;
  std::vector<SliceCut> m_cuts;
  bool m_cutDown = false;
};

} // namespace petrous::workstation
