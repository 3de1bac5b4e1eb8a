#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/FaceMask.h"

namespace petrous::volume
{

enum Cell : std::uint8_t
{
  kAirCell = 0,
  kTissue = 1,
  kOutside = 2,
  kHead = 4
};

/// A head on cells along axes of its own: at = axes * patient.
struct HeadCells
{
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  CellSet cells;
  std::size_t count = 0;             ///< of the head
  std::vector<Eigen::Vector3d> hull; ///< corners of a box around it; empty: there is no head
};

/// The image's tissue on cells of at least 2 mm, and the head: the largest component of it (of 6
/// neighbours), down to the shoulders. What is below is outside.
HeadCells headCells(const IntensityVolume& image, const SkinScale& scale,
                    const Eigen::Matrix3d& axes, const core::Progress& progress);

/// Seen from the front: y of the first tissue in each column of cells, along the head's axes, mm;
/// NaN where there is none, or no air before it within the image.
struct FrontMap
{
  int width = 0, height = 0;
  double edge = 0.0;
  Eigen::Vector3d lower{0.0, 0.0, 0.0}; ///< centre of the first column; y of no meaning
  std::vector<double> y;

  double& at(int i, int k) { return y[static_cast<std::size_t>(i + width * k)]; }
  double at(int i, int k) const { return y[static_cast<std::size_t>(i + width * k)]; }
  double x(int i) const { return lower[0] + edge * i; }
  double z(int k) const { return lower[2] + edge * k; }

  template <class Visit>
  void forEach(const Visit& visit) const
  {
    for (int k = 0; k < height; ++k)
      for (int i = 0; i < width; ++i)
        if (std::isfinite(at(i, k)))
          visit(i, k, at(i, k));
  }
};

struct Front
{
  FrontMap skin;
  FrontMap cutOff; ///< where tissue begins with the image; lower bounds of the skin's place
};

/// Along `axes`. To a fraction of a voxel with the image, else to a cell.
Front frontOf(const HeadCells& head, const IntensityVolume* image, double threshold,
              const Eigen::Matrix3d& axes);

struct Nose
{
  Eigen::Vector3d tip; ///< along the head's axes
  double out;          ///< how far its ridge stands out from what is beside it, mm
  double skew;         ///< difference of what is beside it, mm
};

/// The nose stands out from the cheeks on both sides more than anything else does, however the head
/// is held; its tip is the foremost of that. nullopt where nothing does. `middle`: only within 12
/// mm of this x; `near`: only within 25 mm of this z.
std::optional<Nose> noseOf(const FrontMap& skin, std::optional<double> middle = {},
                           std::optional<double> near = {});

} // namespace petrous::volume
