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

/// State and shading at a point of the scene's tissue: the definitions of OpticalModel.h, evaluated
/// from the voxels in double precision. Requires a CT. Pure and thread-safe.
class TissueOptics
{
public:
  /// Air, soft tissue, bone, or structure i as kBone + 1 + i.
  using State = int;
  static constexpr State kSoft = -2;
  static constexpr State kAir = -1;
  static constexpr State kBone = 0;

  struct Place
  {
    State state = kAir;
    double margin = 0.0; ///< distance of f (and the occupancy) to another state, >= 0
  };

  struct Surface
  {
    Eigen::Vector3d color; ///< RGB
    double opacity = 1.0;
    bool isLit = true; ///< otherwise the colour is displayed as it is
  };

  /// Throws RenderingError BadContents if the contents are inconsistent: no CT, a mask on another
  /// grid, labels without voxels, a missing material, or one that reads a missing second image.
  /// `sample`: whose light it is, see optics::asideOf.
  explicit TissueOptics(const SceneContents& contents, int sample = -1);

  Place at(const Eigen::Vector3d& patient) const;

  /// Bone or a structure.
  static bool isSolid(State state) { return state >= kBone; }

  /// Whether the transition between two states is a surface.
  bool isSurface(State from, State to) const;

  /// Material of a state; not for air.
  const appearance::Material& materialOf(State state) const;

  /// Cosine of the light inside the tissue of a state; `ray`: unit.
  double facingIn(State state, const Eigen::Vector3d& patient, const Eigen::Vector3d& ray) const;

  /// Input of a material's transfer function at a point.
  double intensity(const appearance::Material& material, const Eigen::Vector3d& patient) const;

  /// What crop box and clipping planes show of the soft tissue that they cut off.
  std::optional<Surface> softSection(const Eigen::Vector3d& patient) const;

  /// Normal of the surface at the transition between two states; zero: facing the camera.
  Eigen::Vector3d normalAt(const Eigen::Vector3d& patient, State from, State to) const;

  /// Surface at distance t along the ray, at the transition between two states. `face`: normal of
  /// the face that cuts the tissue off there; zero: facing the camera. `focus`: see lightAt.
  Surface surfaceAt(const PixelRay& ray, double t, State from, State to,
                    const std::optional<Eigen::Vector3d>& face, const optics::Seen& seen = {},
                    double focus = 0.0) const;

  const volume::TissueField& field() const noexcept { return m_field; }
  const LightSettings& light() const noexcept { return m_light; }

private:
  double occupancyAt(const Eigen::Vector3d& patient) const;
  std::size_t indexAt(const Eigen::Vector3d& patient) const;
  double depthIn(std::size_t index, const Eigen::Vector3d& voxel) const;
  volume::StructureChoice structureAt(const Eigen::Vector3d& patient) const;
  std::size_t indexOfVoxel(const Eigen::Vector3d& voxel) const;
  const appearance::Material& surfaceMaterial(const Eigen::Vector3d& patient) const;
  const appearance::Material& surfaceMaterial(const Eigen::Vector3d& patient, State from,
                                              State to) const;
  std::optional<std::array<double, 3>> overlayAt(const Eigen::Vector3d& patient) const;
  Surface sectionAt(const Eigen::Vector3d& patient, double opacity) const;
  bool isSmooth(const Eigen::Vector3d& patient) const;
  bool isCut(const Eigen::Vector3d& patient) const;
  std::optional<Eigen::Vector3d> ctGradientAt(const Eigen::Vector3d& patient, State from,
                                              State to) const;
  Eigen::Vector3d gradientAside(const Eigen::Vector3d& patient) const;
  Eigen::Vector3d occupancyNormal(const Eigen::Vector3d& patient) const;
  Eigen::Vector3d borderNormal(const Eigen::Vector3d& patient, std::size_t index) const;

  std::shared_ptr<const volume::IntensityVolume> m_ct;
  std::shared_ptr<const volume::Volume<float>> m_occupancy;
  std::shared_ptr<const volume::Volume<std::uint8_t>> m_index;
  std::shared_ptr<const volume::Volume<std::uint8_t>> m_borders;
  SecondImage m_second, m_third;
  std::vector<appearance::Material> m_materials;
  std::optional<appearance::Material> m_softTissue; ///< if it has any opacity
  std::shared_ptr<const volume::CutMask> m_mask;
  double m_iso;
  bool m_boneShown;
  LightSettings m_light;
  ThicknessOverlay m_thickness;
  std::optional<SectionWindow> m_section;
  volume::TissueField m_field;
  Eigen::Vector3d m_aside; // voxels
};

} // namespace petrous::rendering
