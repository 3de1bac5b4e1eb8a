#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/Progress.h"

#include "Component.h"
#include "GridFromAffine.h"
#include "NiftiHeader.h"
#include "NrrdHeader.h"
#include "VoxelStream.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/ImageGrid.h"

namespace petrous::imaging
{

/// What helps where label files need more memory than is free: they are read whole.
inline constexpr const char* kCutLabels = "export only the part of it around its structures";

/// A NIfTI, NRRD or MetaImage file with a validated header: the file is large enough for its
/// dimensions, and its axes are perpendicular. Text from the file never reaches a message. All
/// members throw FileError.
class VoxelSource
{
public:
  /// `advice`: what helps where its voxels need more memory than is free, as of requireMemory.
  explicit VoxelSource(const std::filesystem::path& path,
                       const char* advice = "give a region of interest");

  /// Volumes of one grid that the file holds: its fourth axis, or of a NRRD a first one of kind
  /// "list" or "time".
  std::size_t volumes() const noexcept { return m_volumes; }
  /// Of several, the one that is read: 1 for the first. Notes it.
  void select(std::size_t volume);
  /// Throws unless there is one volume, or one was selected.
  void requireOneVolume(bool canBeNamed) const;

  const core::GridGeometry& geometry() const noexcept { return *m_geometry; }
  Component component() const noexcept { return rescaled() ? Component::Float : m_stored; }
  /// Numbers per voxel: above 1 for vectors, colours, and the layers of a segmentation.
  std::size_t components() const noexcept { return m_components; }
  /// Whether integers were converted to float by a rescale slope and intercept.
  bool rescaled() const noexcept { return m_slope != 0.0; }
  std::vector<std::string> notes() const;
  /// Whether the file leaves open which side of the patient is left, so that RAS (true) or LPS
  /// (false) axes were assumed; nullopt: it states it.
  const std::optional<bool>& assumedRas() const noexcept { return m_assumedRas; }
  /// Places the voxels by these axes instead, if the file leaves it open.
  void assume(bool isRas);
  /// Settles a side that is left open: as `isRas` says, else as loadLabels; notes it. Whether it is
  /// settled, or was stated.
  bool settleSide(const std::optional<bool>& isRas, const std::vector<ImageGrid>& images);
  /// The unit of length, if what the file states or leaves open makes it no head, ear or specimen.
  const UnitDoubt& unitDoubt() const noexcept { return m_unitDoubt; }
  /// Settles it: as `unit` (mm) says, which a file without doubt follows too, else by the grid of
  /// an image; notes it. Whether it is settled. Before the side. Until then the voxels lie in the
  /// file's unit, wherever that puts them.
  bool settleUnit(const std::optional<double>& unit, const std::vector<ImageGrid>& images);
  /// Of a NIfTI that places itself twice (sform and qform): takes the place by which its grid is
  /// that of one of the images, and notes it; where neither is, how far both are from the first.
  /// After the unit.
  void settlePlacement(const std::vector<ImageGrid>& images);
  /// Takes the file's unit all the same. Throws FileError (NoGeometry) where the size or the place
  /// cannot be true in it.
  void takeFileUnit();
  /// The value of voxels outside the scanned field, as this program's files keep it.
  const std::optional<double>& padding() const noexcept { return m_padding; }
  /// Whether this program wrote it as an image in Hounsfield units.
  bool isHounsfield() const noexcept { return m_isHounsfield; }
  /// The text header of a NRRD; nullopt for other formats.
  const std::optional<NrrdHeader>& nrrd() const noexcept { return m_nrrd; }

  /// The voxels of a box, components interleaved, first axis fastest. Reads no more than the box if
  /// the format allows it, and keeps no more.
  std::shared_ptr<void> read(const core::IndexBox& box, const core::Progress& progress) const;

  /// Calls visit(k, values) for one slice after the other along the third axis, components
  /// interleaved, until it returns false; the values are valid during the call. Keeps one slice,
  /// except of text. Of every `step` slices only the first is visited, and the others are not read
  /// unless the file is compressed or text.
  void forEachSlice(const std::function<bool(int k, const void* values)>& visit,
                    const core::Progress& progress, int step = 1) const;

  // Of the table of formats, called by the constructor.
  void openNifti();
  void openNrrd();
  void openMeta();

private:
  void countVolumes();
  void place(const Eigen::Matrix3d& linear, const Eigen::Vector3d& origin, const LengthUnit& unit);
  std::string unitNote() const;
  void scaleTo(double unit, bool isUnitKnown = true);
  long double voxelBytes() const;
  void checkRoom();
  void noteSurplus(std::uint64_t bytes);
  void readText(const core::IndexBox& box, void* out, const core::Progress& progress) const;
  void readList(const core::IndexBox& box, void* out, const core::Progress& progress) const;
  void takeFromList(const void* voxels, std::size_t count, void* out) const;
  std::shared_ptr<void> rescaledCopy(const void* stored, std::size_t count,
                                     const core::Progress& progress) const;

  std::filesystem::path m_path;
  std::string m_advice;
  std::vector<std::uint64_t> m_dims;
  std::optional<core::GridGeometry> m_geometry;
  VoxelPlace m_place;
  bool m_swapped = false;                ///< big-endian
  bool m_isText = false;                 ///< decimal numbers
  Component m_stored = Component::Int16; ///< before rescaling
  std::size_t m_components = 1;
  std::size_t m_volumes = 1;
  std::optional<std::size_t> m_volume; ///< selected; 0 for the first
  std::size_t m_listed = 1;            ///< volumes whose voxels are interleaved, if one is selected
  double m_slope = 0.0;                ///< 0: no rescaling
  double m_intercept = 0.0;
  LengthUnit m_unit;     ///< of the file
  double m_taken = 1.0;  ///< mm, in which it is read
  std::string m_unitWhy; ///< of m_taken, if it was settled
  /// As GridFromAffine.h, in that unit.
  Eigen::Matrix3d m_linear = Eigen::Matrix3d::Identity();
  Eigen::Vector3d m_origin = Eigen::Vector3d::Zero();
  /// Of a NIfTI that states two, in that unit: how far they are apart, the one that is not used,
  /// and why the other is.
  double m_apart = 0.0;
  std::optional<NiftiPlacement> m_other;
  bool m_isQform = false;
  bool m_isSformOfTemplate = false;
  std::string m_whyPlacement;
  UnitDoubt m_unitDoubt;
  std::optional<bool> m_assumedRas;
  std::optional<double> m_padding;
  bool m_isHounsfield = false;
  std::vector<std::string> m_notes;
  std::vector<std::string> m_placeNotes; ///< by the unit that was taken
  std::optional<NrrdHeader> m_nrrd;
  std::uintmax_t m_dataBytes = 0; ///< bytes on disk that hold the voxels
};

} // namespace petrous::imaging
