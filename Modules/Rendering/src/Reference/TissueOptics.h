#pragma once

#include <array>
#include <optional>
#include <vector>

#include "OpticalModel.h"
#include "petrous/Rendering/PixelRays.h"
#include "petrous/Rendering/SceneContents.h"
#include "petrous/Volume/LabelBorders.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::rendering
{

/// What a point of the scene's tissue is and how it is lit: the definitions of OpticalModel.h, read
/// from the voxels themselves in double precision. Needs a CT. Pure and thread-safe.
class TissueOptics
{
public:
  /// Air, bone, or structure i as kBone + 1 + i.
  using State = int;
  static constexpr State kAir = -1;
  static constexpr State kBone = 0;

  struct Place
  {
    State state = kAir;
    double margin = 0.0; ///< how far f (and the occupancy) are from another state than this one, >= 0
  };

  struct Surface
  {
    Eigen::Vector3d color; ///< lit, RGB
    double opacity = 1.0;
  };

  /// Throws RenderingError BadContents where the contents contradict themselves: no CT, a mask on
  /// another grid, labels without voxels, a material that is missing or that reads a second image
  /// which is not there.
  explicit TissueOptics(const SceneContents& contents);

  Place at(const Eigen::Vector3d& patient) const;

  /// Whether the step from one state to another is a surface.
  static bool isSurface(State from, State to);

  /// What fills a state; not for air.
  const appearance::Material& materialOf(State state) const;

  /// What a material's transfer function reads at a point.
  double intensity(const appearance::Material& material, const Eigen::Vector3d& patient) const;

  /// The surface that a ray meets at distance t, going from one state to another. `face`: the
  /// normal of the face that cuts the tissue off there; zero for one that looks at the eye.
  Surface surfaceAt(const PixelRay& ray, double t, State from, State to,
                    const std::optional<Eigen::Vector3d>& face) const;

  const volume::TissueField& field() const noexcept { return m_field; }
  const LightSettings& light() const noexcept { return m_light; }

private:
  double occupancyAt(const Eigen::Vector3d& patient) const;
  std::size_t indexAt(const Eigen::Vector3d& patient) const;
  double depthIn(std::size_t index, const Eigen::Vector3d& voxel) const;
  volume::StructureChoice structureAt(const Eigen::Vector3d& patient) const;
  std::size_t indexOfVoxel(const Eigen::Vector3d& voxel) const;
  const appearance::Material& surfaceMaterial(const Eigen::Vector3d& patient) const;
  std::optional<std::array<double, 3>> overlayAt(const Eigen::Vector3d& patient) const;
  Eigen::Vector3d occupancyNormal(const Eigen::Vector3d& patient) const;
  Eigen::Vector3d borderNormal(const Eigen::Vector3d& patient, std::size_t index) const;

  std::shared_ptr<const volume::IntensityVolume> m_ct;
  std::shared_ptr<const volume::Volume<float>> m_occupancy;
  std::shared_ptr<const volume::Volume<std::uint8_t>> m_index;
  std::shared_ptr<const volume::Volume<std::uint8_t>> m_borders;
  SecondImage m_second;
  std::vector<appearance::Material> m_materials;
  LightSettings m_light;
  ThicknessOverlay m_thickness;
  volume::TissueField m_field;
};

} // namespace petrous::rendering
