#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Core/RigidTransform.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::volume
{

/// A set of cubic cells along the patient axes (LPS, mm).
class CellSet
{
public:
  /// Covers the box with cells of `edge` mm; empty.
  CellSet(const core::PatientBox& box, double edge);

  const core::Index3& dims() const noexcept { return m_dims; }
  double edge() const noexcept { return m_edge; }
  Eigen::Vector3d center(int i, int j, int k) const noexcept
  {
    return m_lower + m_edge * Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5);
  }
  std::size_t index(int i, int j, int k) const noexcept
  {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(m_dims[0]) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(m_dims[1]) * static_cast<std::size_t>(k));
  }
  std::vector<std::uint8_t>& cells() noexcept { return m_cells; } ///< first axis fastest
  const std::vector<std::uint8_t>& cells() const noexcept { return m_cells; }

  bool find(const Eigen::Vector3d& patient, std::size_t& cell) const noexcept; ///< false: outside
  void add(const Eigen::Vector3d& patient) noexcept; ///< nothing happens outside the box
  bool contains(const Eigen::Vector3d& patient) const noexcept;
  /// Adds all cells that are closer than `distance` mm to one of the set (and some more: cubes are
  /// added, not balls).
  void grow(double distance);
  bool empty() const noexcept;

private:
  Eigen::Vector3d m_lower;
  double m_edge;
  core::Index3 m_dims;
  std::vector<std::uint8_t> m_cells;
};

/// Intensities that tell the head from the air around it.
struct SkinScale
{
  double threshold = -300.0; ///< surface of the skin
  double air = -1000.0;      ///< what replaces the face
  bool isAirKnown = true;    ///< false: `air` is the background as findFace measures it (MR)
};

/// From the histogram: -300 and -1000 HU, or their equivalents (suggestScale); of an MR the
/// threshold of suggestMrScale. Reads every voxel.
SkinScale skinScale(const IntensityVolume& image, bool isMr);

/// The face's skin is what lies at least so far in front of the plane that takes its place, mm.
constexpr double kFaceDepth = 10.0;

/// Where a face is: a function of patient coordinates, so that it serves for every image in the
/// same space, whatever its grid. In the head's own axes (q = axes (p - F): x to its left, y to its
/// back, z up) it is all that lies in front of a plane,
///
///   y < reach + tilt z
///
/// from below the chin to the forehead, the air in front included. F is the tip of the nose, and
/// the plane is parallel to the profile from chin to brow. Where it is and how the head is turned
/// holds no likeness.
struct FaceRegion
{
  Eigen::Vector3d front{0.0, 0.0, 0.0};               ///< F, LPS mm
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(); ///< the head's from the patient's
  double tilt = 0.0;                                  ///< dy/dz of the profile
  double reach = 0.0;                  ///< mm; 50 for an adult's head, less for a smaller one
  double lower = 0.0, upper = 0.0;     ///< z at which it ends, mm
  double depth = 0.0;                  ///< median distance of the face's skin to the plane, mm
  double air = 0.0;                    ///< what replaces it
  std::shared_ptr<const CellSet> ears; ///< along `axes`; or nullptr

  /// How far in front of the plane a point lies, along the head's y; mm.
  double inFront(const Eigen::Vector3d& patient) const noexcept;
  bool covers(const Eigen::Vector3d& patient) const noexcept;
  double turn() const noexcept; ///< of the head's front to the patient's, degrees
};

struct FaceFinding
{
  enum class Kind
  {
    Face,     ///< can be recognised: `region`
    Part,     ///< the profile, or a strip of the face, with air before it: `region`
    None,     ///< not within the image
    Masked,   ///< the front of the head is flat, as maskFace leaves it
    Doubtful, ///< there is skin as of a face, but where the head looks cannot be told
  };
  Kind kind = Kind::None;
  std::string text; ///< why there is none, or none that can be masked; of a part, what it is
  FaceRegion region;
  std::vector<Eigen::Vector3d> skin; ///< points of the face's skin, in columns of 2 mm

  bool canBeMasked() const noexcept { return kind == Kind::Face || kind == Kind::Part; }
};

/// Looks for a face. The head is the largest connected component above the threshold on cells of 2
/// mm. How it is turned (up to some 80 degrees about its axis, 40 to its shoulder) follows from the
/// plane that mirrors its surface on itself, and from the tip of the nose, which must lie on that
/// plane: it is what stands out most from what is 24 mm beside it on both sides. Its skin is seen
/// from the front where at least 6 mm of air precede it within the image. It is a face if its skin
/// is at least 60 mm wide, 30 mm high, 30 cm^2 large and not flat, and a part of one if it is
/// smaller, but the foremost of the head is skin. Any orientation and spacing of the grid. `ears`:
/// the auricles too, parts at the sides of the head thinner than 16 mm. Throws CancelledError.
FaceFinding findFace(const IntensityVolume& image, const SkinScale& scale, bool ears = false,
                     const core::Progress& progress = {});

struct MaskedImage
{
  std::shared_ptr<const IntensityVolume> image;
  std::size_t changed = 0; ///< voxels that have another value than before
  std::size_t kept = 0;    ///< voxels of the region that stay, as `keep` contains them
};

/// The image with `air` in place of all voxels in the region that are not in `keep` (nullptr:
/// nothing). Everything else is unchanged to the bit. Throws CancelledError.
MaskedImage maskFace(const IntensityVolume& image, const FaceRegion& region, const CellSet* keep,
                     const core::Progress& progress = {});

/// The same for all that lies outside a box in another patient space B; X_BI takes the image's
/// patient points there.
MaskedImage maskOutside(const IntensityVolume& image, const core::PatientBox& box,
                        const core::RigidTransform& boxFromImage, double air, const CellSet* keep,
                        const core::Progress& progress = {});

} // namespace petrous::volume
