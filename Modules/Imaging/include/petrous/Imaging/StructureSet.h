#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/Progress.h"
#include "petrous/Imaging/FileError.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/PatientKey.h"

namespace petrous::imaging
{

/// A DICOM RT structure set (PS3.3 A.19.3): structures as planar contours in patient space.
struct StructureSet
{
  struct Roi
  {
    std::string name;
    std::array<float, 3> color{}; ///< 0 to 1; black if the file has none
    std::string meaning;          ///< RT ROI Interpreted Type, or its code's meaning; may be empty
    volume::SegmentCodes codes;   ///< RT ROI Identification Code as the type, and the algorithm
    /// Closed contours, patient LPS mm; the last point is not the first again.
    std::vector<std::vector<Eigen::Vector3d>> contours;
    std::size_t otherContours = 0; ///< points and open contours, which enclose nothing
    /// mm, Contour Slab Thickness (3006,0044), or NaN where contours state several; 0: not stated.
    double slabThickness = 0.0;
    /// mm, between the planes on which every section of the structure is drawn: Spacing Between
    /// Slices of Source Pixel Planes Characteristics (3006,004A); 0: not stated.
    double planeSpacing = 0.0;
    /// Contours that lie where their Contour Offset Vector (3006,0045) puts them, and by how much
    /// at most, mm.
    std::size_t movedContours = 0;
    double movedBy = 0.0;
    /// Contours with such a vector and no slab, for which PS3.3 C.8.8.6.2 makes it zero.
    std::size_t ignoredOffsets = 0;
  };
  std::vector<Roi> rois;
  std::string frameOfReferenceUid; ///< identifies the patient's study: not to be shown
  PatientKey patient = {};
};

/// Whether a file is an RT structure set, whatever its name.
bool isStructureSet(const std::filesystem::path& path);

/// Throws FileError, CancelledError.
StructureSet readStructureSet(const std::filesystem::path& path,
                              const core::Progress& progress = {});

/// The structures as voxels of `grid`, that of the image on which they were drawn. `path` names the
/// file in errors.
///
/// A contour stands for a slab: as thick as the structure's contours are apart, and where there is
/// one plane only, as the file states (`planeSpacing`, else `slabThickness`; a fifth of a slice to
/// five), else one slice. Beside gaps and at the ends `planeSpacing` counts, if the distances of
/// the planes are whole multiples of it, and the least is five of it at most. Contours of one plane
/// enclose what an odd number of them surrounds. The share of each voxel that lies within is
/// computed (32 lines a row of voxels, exact along them), and as many voxels as the shares amount
/// to, those with the largest, are the structure: its volume is that of its contours to half a
/// voxel. A contour that encloses less than a voxel keeps the one with the largest share.
/// Overlapping structures lie in several maps.
///
/// Planes may be across any axis of the grid. Throws FileError (Unsupported) if all structures with
/// contours are oblique to it, or if none has a contour, Unreadable if the voxels need more than
/// `memory` bytes (0: what the machine has left); CancelledError.
LoadedLabels labelsOf(const StructureSet& set, const core::GridGeometry& grid,
                      const std::filesystem::path& path, const core::Progress& progress = {},
                      std::uint64_t memory = 0);

/// mm^3, of the slabs of a structure's contours as labelsOf places them, before they become voxels;
/// 0 where they are oblique to the grid.
double contourVolume(const StructureSet::Roi& roi, const core::GridGeometry& grid);

} // namespace petrous::imaging
