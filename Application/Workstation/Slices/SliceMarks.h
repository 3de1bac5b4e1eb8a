#pragma once

#include <vector>

#include <QColor>
#include <QPointF>
#include <QString>

#include "petrous/Presenters/SliceGeometry.h"

class QPainter;

namespace petrous::workstation
{

/// A numbered point that slices show where they pass near it.
struct SliceMark
{
  Eigen::Vector3d patient; ///< LPS mm
  QString name;
  QColor color;
};

/// Those within a millimetre of the slice, which lies at `at` (patient, LPS mm).
void paintMarks(QPainter& painter, const std::vector<SliceMark>& marks,
                const presenters::SliceGeometry& slice, const Eigen::Vector3d& at);

/// Where a cube of this edge (mm) about `at` meets the slice through it.
void paintCube(QPainter& painter, double edge, const presenters::SliceGeometry& slice,
               const Eigen::Vector3d& at);

/// In the painter's font, readable on bone and on air alike.
void drawText(QPainter& painter, const QPointF& baseline, const QString& text, const QColor& color);

} // namespace petrous::workstation
