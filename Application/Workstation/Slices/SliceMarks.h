#pragma once

#include <vector>

#include <QColor>
#include <QPointF>
#include <QRectF>
#include <QString>

#include "petrous/Presenters/BoxHandles.h"
#include "petrous/Presenters/ClippingHandles.h"
#include "petrous/Presenters/SliceGeometry.h"

class QPainter;

namespace petrous::workstation
{

/// A numbered point, shown in slices near it.
struct SliceMark
{
  Eigen::Vector3d patient; ///< LPS mm
  QString name;
  QColor color;
};

/// Marks within a millimetre of the slice, which contains `at` (patient, LPS mm).
void paintMarks(QPainter& painter, const std::vector<SliceMark>& marks,
                const presenters::SliceGeometry& slice, const Eigen::Vector3d& at);

/// A curve of patient points (LPS mm), projected onto the slice: full where it runs within a
/// millimetre of it, fading out to 4 mm.
void paintCurve(QPainter& painter, const std::vector<Eigen::Vector3d>& points, const QColor& color,
                const presenters::SliceGeometry& slice, const Eigen::Vector3d& at);

/// A mark or measurement as it is drawn, in slices and in the 3D view.
struct DrawnMeasure
{
  /// Of its handles in the 3D view: points of measurements, faces of a box, its middle, the tip of
  /// a line.
  enum class Form
  {
    Dot,
    Square,
    Diamond,
    Arrow
  };
  std::size_t index = 0;               ///< of the case's measurements
  std::vector<Eigen::Vector3d> points; ///< of its line, patient LPS mm
  bool closed = false;
  std::vector<std::size_t> handles; ///< the points that can be dragged
  QString label;                    ///< name and value
  QColor color;
  bool chosen = false;
  bool draft = false; ///< being set; no handle can be taken
  Form form = Form::Dot;
};

/// Full where it lies within a millimetre of the slice, which contains `at`, and faint elsewhere up
/// to 15 mm; the label where a handle lies in the slice, or the middle does. `beyond`: mm on both
/// sides that are seen as the slice, as in a slab. Labels lie neither on each other nor on `taken`,
/// places of other texts.
void paintMeasures(QPainter& painter, const std::vector<DrawnMeasure>& measures,
                   const presenters::SliceGeometry& slice, const Eigen::Vector3d& at,
                   double beyond = 0.0, std::vector<QRectF> taken = {});

/// Whether a point counts as lying in the slice.
bool isInSlice(const Eigen::Vector3d& point, const presenters::SliceGeometry& slice,
               const Eigen::Vector3d& at, double beyond = 0.0);

/// Intersection of the slice with a cube of this edge (mm) centred at `at`.
void paintCube(QPainter& painter, double edge, const presenters::SliceGeometry& slice,
               const Eigen::Vector3d& at);

/// Outline and handles of a box, dashed where the slice lies beside it, and its size in the slice.
/// `dims`: what is outside is dark. The size lies on none of `taken`, places of other texts;
/// returns its own, which is null where there is none.
QRectF paintBox(QPainter& painter, const presenters::HandledBox& box, bool dims,
                const presenters::SliceGeometry& slice, const std::vector<QRectF>& taken);

/// Where a clipping plane cuts the slice, with short lines to the side that stays, and the ends by
/// which it is turned.
void paintCut(QPainter& painter, const scene::ViewState::Clipping::Plane& plane,
              const presenters::SliceGeometry& slice);

/// What is told of something that is dragged, beside the pointer; it lies on none of `taken` where
/// there is room, and is whole, in lines where the picture is narrow. Returns its place.
QRectF paintReading(QPainter& painter, const QString& text, const QPointF& pointer,
                    const QColor& color, const std::vector<QRectF>& taken);

/// In the painter's font, readable on bone and on air alike.
void drawText(QPainter& painter, const QPointF& baseline, const QString& text, const QColor& color);

} // namespace petrous::workstation
